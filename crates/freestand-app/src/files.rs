//! Where the files that a request names come from.

use std::path::PathBuf;
use std::sync::Arc;

use freestand_input::file::load;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::shorten;
use freestand_input::written::Written;
pub use freestand_scan::formats::is_mesh;
use freestand_scan::mesh::Mesh;
use freestand_study::recorded::ReadMotion;

/// Where the files that a request names come from.
#[derive(Debug, Clone, Default)]
pub enum Files {
    /// The disk: a name is a path.
    #[default]
    Disk,
    /// What came with the request, by name.
    Sent(Vec<Sent>),
}

/// A file that came with a request.
#[derive(Debug, Clone)]
pub struct Sent {
    /// What the request calls it.
    pub name: String,
    /// What it is.
    pub content: Content,
}

/// What came with a request.
#[derive(Debug, Clone)]
pub enum Content {
    /// A file that was put here.
    At(PathBuf),
    /// A motion that has been read, or is made of samples.
    Motion(Box<ReadMotion>),
    /// The text of a file in memory.
    Text(String),
    /// A mesh in memory.
    Mesh(Arc<Mesh>),
}

/// A scan, as far as it was read.
pub(crate) enum ScanFile {
    /// Its mesh.
    Mesh(Arc<Mesh>),
    /// The content of its file.
    Bytes(Vec<u8>),
}

impl Files {
    /// What a request calls by this name.
    ///
    /// # Errors
    /// A name that did not come with the request, where only such files are read.
    pub fn find(&self, name: &str) -> Result<Content, Problem> {
        match self {
            _ if name.trim().is_empty() => {
                let hint = "name a file";
                Err(Problem::value("no file is named", hint))
            }
            Self::Disk => Ok(Content::At(PathBuf::from(name))),
            Self::Sent(all) => all
                .iter()
                .find(|sent| sent.name == name)
                .map(|sent| sent.content.clone())
                .ok_or_else(|| not_sent(name)),
        }
    }

    /// The path of a file that a request names, if it names one that has a path.
    pub(crate) fn path_of(&self, name: Option<&Written>) -> Option<PathBuf> {
        self.path(&name?.text()).ok()
    }

    /// The scan that a request calls by this name.
    ///
    /// # Errors
    /// As [`Files::path`]; a file that cannot be read.
    pub(crate) fn scan(&self, name: &str) -> Result<ScanFile, Problem> {
        match self.find(name)? {
            Content::Mesh(mesh) => Ok(ScanFile::Mesh(mesh)),
            Content::At(path) => Ok(ScanFile::Bytes(load(&path)?)),
            Content::Text(text) => Ok(ScanFile::Bytes(text.into_bytes())),
            Content::Motion(_) => Err(not_sent(name)),
        }
    }

    /// The path of a file that a request calls by this name.
    ///
    /// # Errors
    /// As [`Files::find`]; what is no file.
    pub fn path(&self, name: &str) -> Result<PathBuf, Problem> {
        match self.find(name)? {
            Content::At(path) => Ok(path),
            Content::Motion(_) | Content::Text(_) | Content::Mesh(_) => Err(not_sent(name)),
        }
    }
}

pub(crate) fn not_sent(name: &str) -> Problem {
    let message = format!("\"{}\" is not a file of this request", shorten(name));
    Problem::new(ProblemKind::Io, message)
        .hint("send the file with the request; on the page, under \"files\"")
}
