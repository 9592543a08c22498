//! A library of either kind: the built-in entries, and those of the user's file, which replace
//! built-in ones with the same id.

use std::cmp::Reverse;
use std::collections::HashMap;
use std::path::Path;

use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::nearest;

use super::table::{self, Column, Row, Table};

/// Origin of the built-in entries.
pub(super) const BUILT_IN: &str = "built-in";

/// Largest number of problems that are reported; the rest of the file is then not read.
const MAX_PROBLEMS: usize = 200;

/// Largest number of similar ids in the hint for an id that is not found.
const MAX_NEAREST: usize = 3;

/// The differences between the two libraries.
#[derive(Debug)]
pub(super) struct Shelf<E> {
    /// The name of the command, as in `freestand tolerance list`.
    pub name: &'static str,
    pub columns: &'static [Column],
    pub builtin: &'static [u8],
    /// The entry of a row, and the name of its file.
    pub read: fn(&Table, &Row, &str) -> Result<E, Problems>,
    pub id: fn(&E) -> &str,
    /// The texts in which words are searched.
    pub texts: fn(&E) -> Vec<&str>,
}

/// Entries with an id and a source each.
#[derive(Debug, Clone)]
pub struct Library<E: 'static> {
    shelf: &'static Shelf<E>,
    entries: Vec<E>,
    /// The user's files.
    pub inputs: Vec<InputFile>,
    /// Warnings about them.
    pub warnings: Vec<String>,
}

impl<E> Library<E> {
    /// The built-in entries.
    pub(super) fn new(shelf: &'static Shelf<E>) -> Self {
        // The table is part of the program, and a test reads it.
        let (entries, _) = shelf.entries(shelf.builtin, BUILT_IN).unwrap_or_default();
        Self {
            shelf,
            entries,
            inputs: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// The same library with the entries of a user's file, if there is one; an entry with the same
    /// id replaces the built-in one.
    ///
    /// # Errors
    /// All problems of the file, with line and column.
    pub fn with_file(mut self, path: Option<&Path>) -> Result<Self, Problems> {
        let Some(path) = path else { return Ok(self) };
        let bytes = table::load(path, self.shelf.columns)?;
        let origin = path.display().to_string();
        let in_file = |problem: Problem| problem.in_file(path);
        let read = self.shelf.entries(&bytes, &origin);
        let (entries, warnings) =
            read.map_err(|error| error.into_iter().map(in_file).collect::<Problems>())?;
        let id = self.shelf.id;
        for entry in entries {
            match self.entries.iter_mut().find(|one| id(one) == id(&entry)) {
                Some(one) => *one = entry,
                None => self.entries.push(entry),
            }
        }
        let told = warnings
            .iter()
            .map(|warning| format!("{origin}: {warning}"));
        self.warnings.extend(told);
        self.inputs.push(InputFile::new(path, &bytes));
        Ok(self)
    }

    /// All entries, the built-in ones first.
    pub fn entries(&self) -> &[E] {
        &self.entries
    }

    /// The ids of all entries.
    pub(super) fn ids(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(self.shelf.id)
    }

    /// The entry with this id, in upper or lower case.
    pub fn find(&self, id: &str) -> Option<&E> {
        let id = id.trim().to_lowercase();
        self.entries
            .iter()
            .find(|entry| (self.shelf.id)(entry) == id)
    }

    /// The entry with this id.
    ///
    /// # Errors
    /// An unknown id; the hint names similar ones.
    pub fn get(&self, id: &str) -> Result<&E, Problem> {
        self.find(id).ok_or_else(|| {
            let name = self.shelf.name;
            let message = format!("the {name} library has no entry \"{}\"", shorten(id.trim()));
            let hint = match self.nearest(id).as_slice() {
                [] => format!("freestand {name} list shows all entries"),
                near => format!(
                    "did you mean {}? freestand {name} list shows all entries",
                    near.join(", ")
                ),
            };
            Problem::value(message, hint)
        })
    }

    /// Entries in whose texts every word occurs, in upper or lower case.
    pub fn search(&self, words: &[String]) -> Vec<&E> {
        let words: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
        let has_all = |entry: &&E| {
            let texts: Vec<String> = (self.shelf.texts)(entry)
                .into_iter()
                .map(str::to_lowercase)
                .collect();
            words
                .iter()
                .all(|word| texts.iter().any(|text| text.contains(word)))
        };
        self.entries.iter().filter(has_all).collect()
    }

    /// Ids that are similar to one that is not found, three at most.
    pub(super) fn nearest(&self, id: &str) -> Vec<&str> {
        let ids: Vec<&str> = self.ids().collect();
        let wanted = id.to_lowercase();
        let mut near: Vec<&str> = nearest(&wanted, &ids).into_iter().collect();
        let words: Vec<&str> = wanted
            .split(|c: char| !c.is_alphanumeric())
            .filter(|word| word.len() > 2)
            .collect();
        let shared = |candidate: &str| {
            words
                .iter()
                .filter(|word| candidate.contains(**word))
                .count()
        };
        let mut others: Vec<&str> = ids
            .into_iter()
            .filter(|id| shared(id) > 0 && !near.contains(id))
            .collect();
        others.sort_by_key(|id| Reverse(shared(id)));
        near.extend(others);
        near.truncate(MAX_NEAREST);
        near
    }
}

impl<E> Shelf<E> {
    /// The entries of a table, and warnings about it. Every id occurs once.
    fn entries(&self, bytes: &[u8], origin: &str) -> Result<(Vec<E>, Vec<String>), Problems> {
        let table = table::read_table(bytes, self.columns)?;
        let (mut entries, mut problems, mut lines) =
            (Vec::new(), Problems::default(), HashMap::new());
        for row in &table.rows {
            let value =
                |message: String, hint: &str| Problem::value(message, hint).at_line(row.line);
            if problems.len() >= MAX_PROBLEMS {
                let message = format!(
                    "there are {MAX_PROBLEMS} problems so far; the rest of the file was not read"
                );
                problems.push(value(message, "correct these and read the file again"));
                break;
            }
            let Some(entry) = problems.keep((self.read)(&table, row, origin)) else {
                continue;
            };
            let id = (self.id)(&entry);
            if let Some(first) = lines.get(id) {
                let message = format!("column id: line {first} already has \"{id}\"");
                problems.push(value(message, "give every entry its own id"));
            } else {
                lines.insert(id.to_owned(), row.line);
                entries.push(entry);
            }
        }
        problems.finish(Some((entries, table.warnings)))
    }
}
