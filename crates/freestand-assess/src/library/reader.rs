//! Cells of a library row into values, with every slip kept.

use super::Confidence;
use super::sheet::{Sheet, SheetRow};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, parse, parse_in_unit, shorten};

/// Reads one row.
pub(super) struct RowReader<'s> {
    sheet: &'s Sheet,
    row: &'s SheetRow,
    pub(super) problems: Vec<Problem>,
}

impl<'s> RowReader<'s> {
    pub(super) fn new(sheet: &'s Sheet, row: &'s SheetRow) -> Self {
        Self { sheet, row, problems: Vec::new() }
    }

    pub(super) fn note(&mut self, column: &str, message: impl std::fmt::Display, hint: impl Into<String>) {
        let problem = Problem::new(ProblemKind::Value, format!("column {column}: {message}"));
        self.problems.push(problem.at_line(self.row.line).hint(hint));
    }

    /// The text of a cell, empty where there is none.
    pub(super) fn text(&self, column: &str) -> String {
        self.sheet.cell(self.row, column).text.to_owned()
    }

    /// A text that must be there.
    pub(super) fn needed(&mut self, column: &str) -> String {
        let text = self.text(column);
        if text.is_empty() {
            self.note(column, "is empty", "every entry needs it");
        }
        text
    }

    /// A positive number in SI: bare in the unit of its column, or with a unit of its own. Empty is `None`.
    pub(super) fn positive(&mut self, column: &'static str, dimension: Dimension) -> Option<f64> {
        let cell = self.sheet.cell(self.row, column);
        if cell.text.is_empty() {
            return None;
        }
        let value = match cell.unit {
            Some(unit) => {
                parse_in_unit(cell.text, unit).or_else(|problem| parse(cell.text, dimension).map_err(|_| problem))
            }
            None => parse(cell.text, dimension),
        };
        match value {
            Ok(value) if value > 0.0 && value.is_finite() => Some(value),
            Ok(_) => {
                self.note(
                    column,
                    format!("\"{}\" is not positive", shorten(cell.text)),
                    "leave it empty where nothing is known",
                );
                None
            }
            Err(problem) => {
                self.note(column, problem.message, problem.hint.unwrap_or_default());
                None
            }
        }
    }

    /// A whole number from 1.
    pub(super) fn count(&mut self, column: &'static str) -> Option<u32> {
        let text = self.text(column);
        if text.is_empty() {
            return None;
        }
        match text.parse::<u32>() {
            Ok(count) if count > 0 => Some(count),
            _ => {
                self.note(column, format!("\"{}\" is not a count", shorten(&text)), "a whole number, at least 1");
                None
            }
        }
    }

    /// One of a few words.
    pub(super) fn word<T: Copy>(&mut self, column: &'static str, words: &[(&'static str, T)]) -> Option<T> {
        let text = self.text(column).to_lowercase();
        let found = words.iter().find(|(name, _)| *name == text).map(|(_, value)| *value);
        if found.is_none() {
            let names: Vec<&str> = words.iter().map(|(name, _)| *name).collect();
            self.note(column, format!("\"{}\" is not known", shorten(&text)), format!("one of {}", names.join(", ")));
        }
        found
    }

    /// The id: what flags and inventories name an entry by.
    pub(super) fn id(&mut self) -> String {
        let id = self.text("id").to_lowercase();
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        if id.is_empty() || !id.chars().all(is_plain) {
            let hint = "letters, digits, - _ and ., such as rack-a12";
            self.note("id", format!("\"{}\" is not an id", shorten(&id)), hint);
        }
        id
    }

    /// The confidence. What has no source with a page or a clause is recalled, whatever it would like to be.
    pub(super) fn confidence(&mut self) -> Confidence {
        let words = Confidence::ALL.map(|confidence| (confidence.name(), confidence));
        let confidence = self.word("confidence", &words).unwrap_or(Confidence::Recalled);
        let is_located = ["page", "clause"].iter().any(|column| !self.text(column).is_empty());
        let is_found = is_located && !self.text("source").is_empty();
        if confidence != Confidence::Recalled && !is_found {
            let message = format!("\"{}\" needs a source, with a page or a clause", confidence.name());
            self.note(
                "confidence",
                message,
                "say where the numbers stand, or write recalled: they are then shown and decide nothing",
            );
        }
        confidence
    }
}
