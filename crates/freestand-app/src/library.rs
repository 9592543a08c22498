//! `tolerance` and `cushion`, each with `list`, `show` and `search`: entries of the two libraries.

use std::fmt::Debug;
use std::marker::PhantomData;
use std::path::PathBuf;

use freestand_input::problem::Problems;
use freestand_input::written::Written;
use freestand_inventory::library::{
    CushionEntry, CushionLibrary, ToleranceEntry, ToleranceLibrary,
};
use schemars::JsonSchema;
use serde::Serialize;

use crate::files::Files;
use crate::request::{Question, Request as _, path, reader, request};

/// One of the two libraries.
pub trait Library: Debug + Clone + Default + PartialEq + 'static {
    /// What it consists of.
    type Entry: Serialize + JsonSchema + Debug;

    /// The schema of a response.
    const SCHEMA: &str;

    /// Its built-in entries.
    fn builtin() -> freestand_inventory::library::Library<Self::Entry>;
}

/// What objects withstand.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tolerances;

/// Likely stiffnesses of pads, feet and floors.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cushions;

impl Library for Tolerances {
    type Entry = ToleranceEntry;

    const SCHEMA: &str = "freestand.tolerance/1";

    fn builtin() -> ToleranceLibrary {
        ToleranceLibrary::builtin()
    }
}

impl Library for Cushions {
    type Entry = CushionEntry;

    const SCHEMA: &str = "freestand.cushion-library/1";

    fn builtin() -> CushionLibrary {
        CushionLibrary::builtin()
    }
}

request! { question
    /// All entries of a library.
    pub struct List<L: Library> {
        /// Your own library: adds to the built-in one and replaces entries with the same id
        pub library = "FILE.csv",

        /// Which library.
        #[arg(skip)]
        pub of: PhantomData<L>,
    }
}

request! { question
    /// One entry of a library.
    pub struct Show<L: Library> {
        /// Id of the entry
        #[arg(value_name = "ID")]
        pub id: Option<Written>,
        /// Your own library: adds to the built-in one and replaces entries with the same id
        pub library = "FILE.csv",

        /// Which library.
        #[arg(skip)]
        pub of: PhantomData<L>,
    }
}

request! { question
    /// The entries of a library that contain words.
    pub struct Search<L: Library> {
        /// Words
        #[arg(value_name = "WORD")]
        pub words: Vec<Written>,
        /// Your own library: adds to the built-in one and replaces entries with the same id
        pub library = "FILE.csv",

        /// Which library.
        #[arg(skip)]
        pub of: PhantomData<L>,
    }
}

/// What is asked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Meant {
    /// The entries.
    pub wanted: Wanted,
    /// The user's own library.
    pub library: Option<PathBuf>,
}

/// Entries of a library.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Wanted {
    /// All of them.
    All,
    /// The one with this id.
    WithId(String),
    /// Those that contain all of these words.
    WithWords(Vec<String>),
}

impl<L: Library> Question for List<L> {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let library = path(&mut read, "library", files);
        let wanted = Wanted::All;
        read.problems.finish(Some(Meant { wanted, library }))
    }
}

impl<L: Library> Question for Show<L> {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        read.require("id", "no entry is named", "give the id of an entry");
        let id = read.one("id");
        let library = path(&mut read, "library", files);
        let wanted = id.map(|id| Wanted::WithId(id.to_owned()));
        read.problems
            .finish(wanted.map(|wanted| Meant { wanted, library }))
    }
}

impl<L: Library> Question for Search<L> {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        read.pass(&["words"]);
        if self.words.is_empty() {
            read.missing(&["words"], "no word is given", "give one or more words");
        }
        let is_word = |one: &Written| match one {
            Written::Text(text) => !text.trim().is_empty(),
            one => matches!(one, Written::Number(_)),
        };
        if !self.words.iter().all(is_word) {
            read.note(&["words"], "a word is empty", "give one or more words");
        }
        let library = path(&mut read, "library", files);
        let wanted = Wanted::WithWords(self.words.iter().map(Written::text).collect());
        read.problems.finish(Some(Meant { wanted, library }))
    }
}

/// Entries of a library.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Listed<'a, E> {
    /// In the order of the library.
    pub entries: Vec<&'a E>,
}
