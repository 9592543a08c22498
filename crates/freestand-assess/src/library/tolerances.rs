//! The tolerance library: what is built in, and what the user's file adds and overrides.

use std::path::Path;

use super::entry::{TOLERANCE_COLUMNS, ToleranceEntry};
use super::{nearest_ids, sheet};
use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, ProblemKind, Problems};

/// What many kinds of things stand, each entry with its source.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Library {
    entries: Vec<ToleranceEntry>,
    /// The user's files.
    pub inputs: Vec<InputFile>,
    /// What is doubtful about them.
    pub warnings: Vec<String>,
}

impl Library {
    /// What is built in.
    ///
    /// # Example
    /// ```
    /// use freestand_assess::library::{Library, to_tolerance};
    /// let library = Library::builtin();
    /// let card = library.find("expansion-card-operating").and_then(to_tolerance).unwrap();
    /// assert!((card.peak_m_s2.unwrap() - 5.0 * 9.80665).abs() < 1e-12 && card.duration_s == Some(0.011));
    /// assert!(library.find("p58-bookcase-5-shelves").and_then(to_tolerance).is_none(), "a median is no tolerance");
    /// ```
    pub fn builtin() -> Self {
        // The table is part of the program; a test reads it.
        let entries = read_entries(include_bytes!("tolerance.csv"), BUILT_IN).map(|(entries, _)| entries);
        Self { entries: entries.unwrap_or_default(), ..Self::default() }
    }

    /// What is built in, with the user's library over it: an entry of the same id takes the place of ours.
    ///
    /// # Errors
    /// Everything that is wrong with the file, with line and column.
    pub fn with_file(path: &Path) -> Result<Self, Problems> {
        let mut library = Self::builtin();
        library.add_file(path)?;
        Ok(library)
    }

    /// Puts another file of the user's over what is there.
    ///
    /// # Errors
    /// As [`Self::with_file`]; the library then stays as it was.
    pub fn add_file(&mut self, path: &Path) -> Result<(), Problems> {
        let (input, warnings) = put_over(&mut self.entries, path, read_entries, |entry| &entry.id)?;
        self.warnings.extend(warnings);
        self.inputs.push(input);
        Ok(())
    }

    /// All entries, ours first.
    pub fn entries(&self) -> &[ToleranceEntry] {
        &self.entries
    }

    /// The entry of an id, in any case.
    pub fn find(&self, id: &str) -> Option<&ToleranceEntry> {
        let id = id.trim().to_lowercase();
        self.entries.iter().find(|entry| entry.id == id)
    }

    /// The entry of an id.
    ///
    /// # Errors
    /// None: the problem names what is nearest.
    pub fn get(&self, id: &str) -> Result<&ToleranceEntry, Problem> {
        self.find(id).ok_or_else(|| unknown(id, "tolerance", &self.nearest(id)))
    }

    /// Entries that have every word somewhere in id, class, kind, state, source, clause or note.
    pub fn search(&self, words: &[String]) -> Vec<&ToleranceEntry> {
        let has = |entry: &ToleranceEntry| {
            let parts = [&entry.class, &entry.source, &entry.clause, &entry.note].map(String::as_str);
            matches_all(words, &[&[&entry.id, entry.kind.name(), entry.state.name()], &parts[..]].concat())
        };
        self.entries.iter().filter(|entry| has(entry)).collect()
    }

    /// Ids that were likely meant by one that is not there, three at most.
    pub fn nearest(&self, id: &str) -> Vec<&str> {
        nearest_ids(id, &self.entries.iter().map(|entry| entry.id.as_str()).collect::<Vec<_>>())
    }
}

pub(super) const BUILT_IN: &str = "built-in";

/// Entries of a table and what is doubtful about them, from its bytes and its name.
pub(super) type ReadEntries<E> = fn(&[u8], &str) -> Result<(Vec<E>, Vec<String>), Problems>;

/// Puts the entries of a user's file over those that are known, by their ids: the file, and what is doubtful about it.
pub(super) fn put_over<E>(
    known: &mut Vec<E>,
    path: &Path,
    read: ReadEntries<E>,
    id: fn(&E) -> &str,
) -> Result<(InputFile, Vec<String>), Problems> {
    let (bytes, input) = sheet::load(path)?;
    let origin = path.display().to_string();
    let (entries, warnings) = read(&bytes, &origin).map_err(|error| in_file(error, path))?;
    for entry in entries {
        match known.iter_mut().find(|one| id(one) == id(&entry)) {
            Some(one) => *one = entry,
            None => known.push(entry),
        }
    }
    Ok((input, warnings.into_iter().map(|warning| format!("{origin}: {warning}")).collect()))
}

/// Whether every word stands in one of the texts, in any case.
pub(super) fn matches_all(words: &[String], texts: &[&str]) -> bool {
    let texts: Vec<String> = texts.iter().map(|text| text.to_lowercase()).collect();
    words.iter().map(|word| word.to_lowercase()).all(|word| texts.iter().any(|text| text.contains(&word)))
}

/// What is said of an id that is not there.
pub(super) fn unknown(id: &str, what: &str, near: &[&str]) -> Problem {
    let message = format!("no {what} \"{}\" in the library", freestand_input::quantity::shorten(id));
    let hint = match near {
        [] => format!("freestand {what} list shows all"),
        near => format!("did you mean {}? freestand {what} list shows all", near.join(", ")),
    };
    Problem::new(ProblemKind::Value, message).hint(hint)
}

pub(super) fn in_file(error: Problems, path: &Path) -> Problems {
    Problems { problems: error.problems.into_iter().map(|problem| problem.in_file(path)).collect() }
}

fn read_entries(bytes: &[u8], origin: &str) -> Result<(Vec<ToleranceEntry>, Vec<String>), Problems> {
    let sheet = sheet::read_sheet(bytes, &TOLERANCE_COLUMNS)?;
    let rows = sheet.rows.iter().map(|row| (row.line, ToleranceEntry::read(&sheet, row, origin)));
    let entries = unique(rows, |entry| &entry.id)?;
    Ok((entries, sheet.warnings))
}

/// Nobody reads more at once.
const MOST_PROBLEMS: usize = 200;

/// The entries, or everything that is wrong with them; an id may stand there once.
pub(super) fn unique<E>(
    rows: impl Iterator<Item = (usize, Result<E, Vec<Problem>>)>,
    id: impl Fn(&E) -> &String,
) -> Result<Vec<E>, Problems> {
    let (mut entries, mut problems) = (Vec::new(), Vec::new());
    let mut lines = std::collections::HashMap::new();
    for (line, row) in rows {
        if problems.len() >= MOST_PROBLEMS {
            let message = format!("{MOST_PROBLEMS} problems so far: the rest of the file was not read");
            problems.push(Problem::new(ProblemKind::Value, message).at_line(line).hint("mend these and read it again"));
            break;
        }
        match row {
            Err(found) => problems.extend(found),
            Ok(entry) => match lines.get(id(&entry)) {
                Some(first) => {
                    let message = format!("column id: \"{}\" stands in line {first} already", id(&entry));
                    problems.push(
                        Problem::new(ProblemKind::Value, message).at_line(line).hint("give each entry its own id"),
                    );
                }
                None => {
                    lines.insert(id(&entry).clone(), line);
                    entries.push(entry);
                }
            },
        }
    }
    if problems.is_empty() { Ok(entries) } else { Err(Problems { problems }) }
}
