//! The typesetter's world: one template, one file of data, the embedded fonts, and nothing else.

use std::collections::HashSet;

use typst::diag::{FileError, FileResult, SourceDiagnostic};
use typst::foundations::{Bytes, Datetime, Duration, Smart};
use typst::syntax::{FileId, RootedPath, Source, VirtualPath, VirtualRoot};
use typst::text::{Font, FontBook};
use typst::utils::LazyHash;
use typst::{Library, LibraryExt, World};
use typst_kit::fonts::{FontStore, embedded};
use typst_layout::PagedDocument;
use typst_pdf::{PdfOptions, PdfStandard, PdfStandards, pdf};

/// How a document looks. It reads `/document.json`.
const TEMPLATE: &str = include_str!("document.typ");

/// The fonts, which take a moment to load.
pub(crate) struct Typesetter {
    library: LazyHash<Library>,
    fonts: FontStore,
    /// Code points that some font has.
    known: HashSet<u32>,
}

impl Typesetter {
    /// With the embedded fonts.
    pub(crate) fn new() -> Self {
        let mut fonts = FontStore::new();
        fonts.extend(embedded());
        let infos = (0..).map_while(|index| fonts.book().info(index));
        let known = infos.flat_map(|info| info.coverage.iter()).collect();
        Self { library: LazyHash::new(Library::default()), fonts, known }
    }

    /// Whether a font has the character.
    pub(crate) fn has(&self, c: char) -> bool {
        self.known.contains(&(c as u32))
    }

    /// The document of this data, laid out.
    ///
    /// # Errors
    /// What the typesetter says of a document that it refuses.
    pub(crate) fn document(&self, data: Vec<u8>) -> Result<PagedDocument, String> {
        let template = file("/document.typ").ok_or("the name of the template")?;
        let data_file = file("/document.json").ok_or("the name of the data")?;
        let desk = Desk {
            typesetter: self,
            template: Source::new(template, TEMPLATE.to_owned()),
            data_file,
            data: Bytes::new(data),
        };
        let document = typst::compile::<PagedDocument>(&desk).output.map_err(|problems| words(&problems));
        // What the typesetter remembers of one document is of no use to the next.
        typst::comemo::evict(0);
        document
    }

    /// The same as a PDF.
    ///
    /// # Errors
    /// What the typesetter says of a document that it refuses.
    pub(crate) fn pdf(&self, data: Vec<u8>) -> Result<Vec<u8>, String> {
        let options = PdfOptions {
            // Its default is a hash of the title: every assessment would have the same identity.
            ident: Smart::Custom(format!("{:032x}", typst::utils::hash128(&data))),
            creator: Smart::Custom(Some(concat!("freestand ", env!("CARGO_PKG_VERSION")).to_owned())),
            timestamp: None,
            page_ranges: None,
            standards: PdfStandards::new(&[PdfStandard::Ua_1]).map_err(|problem| problem.message().to_string())?,
            tagged: true,
            pretty: false,
        };
        pdf(&self.document(data)?, &options).map_err(|problems| words(&problems))
    }
}

fn file(path: &str) -> Option<FileId> {
    Some(RootedPath::new(VirtualRoot::Project, VirtualPath::new(path).ok()?).intern())
}

fn words(problems: &[SourceDiagnostic]) -> String {
    problems.iter().map(|problem| problem.message.as_str()).collect::<Vec<_>>().join("; ")
}

/// One document at work.
struct Desk<'a> {
    typesetter: &'a Typesetter,
    template: Source,
    data_file: FileId,
    data: Bytes,
}

impl World for Desk<'_> {
    fn library(&self) -> &LazyHash<Library> {
        &self.typesetter.library
    }

    fn book(&self) -> &LazyHash<FontBook> {
        self.typesetter.fonts.book()
    }

    fn main(&self) -> FileId {
        self.template.id()
    }

    fn source(&self, id: FileId) -> FileResult<Source> {
        if id == self.template.id() { Ok(self.template.clone()) } else { Err(FileError::AccessDenied) }
    }

    fn file(&self, id: FileId) -> FileResult<Bytes> {
        if id == self.data_file { Ok(self.data.clone()) } else { Err(FileError::AccessDenied) }
    }

    fn font(&self, index: usize) -> Option<Font> {
        self.typesetter.fonts.font(index)
    }

    /// None: the same assessment gives the same bytes.
    fn today(&self, _offset: Option<Duration>) -> Option<Datetime> {
        None
    }
}
