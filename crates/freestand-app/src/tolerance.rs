//! `tolerance search`: entries of the tolerance library.

use std::path::PathBuf;

use clap::Args;
use freestand_input::problem::Problems;
use freestand_input::written::Written;
use serde::Deserialize;

use crate::files::Files;
use crate::request::{Question, Request as _, Unknown, one_or_many, path, reader, request};

/// What is searched.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Args)]
#[serde(default)]
#[group(skip)]
pub struct ToleranceSearch {
    /// Words
    #[arg(value_name = "WORD")]
    #[serde(deserialize_with = "one_or_many")]
    pub words: Vec<Written>,
    /// Your own library: adds to the built-in one and replaces entries with the same id
    #[arg(long, value_name = "FILE.csv")]
    pub library: Option<Written>,

    /// Keys that are not known.
    #[arg(skip)]
    #[serde(flatten)]
    pub unknown: Unknown,
}

request!(ToleranceSearch { words, library; unknown });

/// What is asked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Meant {
    /// The words, all of which an entry contains.
    pub words: Vec<String>,
    /// The user's own library.
    pub library: Option<PathBuf>,
}

impl Question for ToleranceSearch {
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
            let hint = "give words such as \"bookcase\"";
            read.note(&["words"], "a word is empty, or is none", hint);
        }
        let library = path(&mut read, "library", files);
        let meant = Meant {
            words: self.words.iter().map(Written::text).collect(),
            library,
        };
        read.problems.finish(Some(meant))
    }
}
