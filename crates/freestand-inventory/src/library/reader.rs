//! The values of a row of a library, with all of its problems.

use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, parse, parse_in_unit, shorten};

use strum::VariantArray as _;

use super::Confidence;
use super::table::{Row, Table};

/// Reads one row.
pub(super) struct RowReader<'s> {
    table: &'s Table,
    row: &'s Row,
    pub problems: Problems,
}

impl<'s> RowReader<'s> {
    pub(super) fn new(table: &'s Table, row: &'s Row) -> Self {
        Self {
            table,
            row,
            problems: Problems::default(),
        }
    }

    pub(super) fn note(
        &mut self,
        column: &str,
        message: impl std::fmt::Display,
        hint: impl Into<String>,
    ) {
        self.problems.push(
            Problem::value(format!("column {column}: {message}"), hint).at_line(self.row.line),
        );
    }

    /// The text of a cell, empty where there is none.
    pub(super) fn text(&self, column: &str) -> String {
        self.table.cell(self.row, column).text.to_owned()
    }

    /// A text that is required.
    pub(super) fn needed(&mut self, column: &str) -> String {
        let text = self.text(column);
        if text.is_empty() {
            self.note(column, "is empty", "every entry needs it");
        }
        text
    }

    /// A positive number in SI, in the unit of its column or with a unit of its own; `None` for an
    /// empty cell.
    pub(super) fn positive(&mut self, column: &'static str, dimension: Dimension) -> Option<f64> {
        let cell = self.table.cell(self.row, column);
        if cell.text.is_empty() {
            return None;
        }
        let value = match cell.unit {
            Some(unit) => parse_in_unit(cell.text, unit)
                .or_else(|problem| parse(cell.text, dimension).map_err(|_| problem)),
            None => parse(cell.text, dimension),
        };
        let (message, hint) = match value {
            Ok(value) if value > 0.0 && value.is_finite() => return Some(value),
            Ok(_) => (
                format!("must be positive, not \"{}\"", shorten(cell.text)),
                "leave it empty if the value is not known".to_owned(),
            ),
            Err(problem) => (problem.message, problem.hint.unwrap_or_default()),
        };
        self.note(column, message, hint);
        None
    }

    /// The standard deviation of a logarithm. At 2 the values scatter by a factor of 7 both ways, more than any test does:
    /// a larger one is a percentage without its sign.
    pub(super) fn beta(&mut self, column: &'static str) -> Option<f64> {
        let beta = self.positive(column, Dimension::Ratio)?;
        if beta <= 2.0 {
            return Some(beta);
        }
        let text = self.text(column);
        self.note(
            column,
            format!("must be at most 2, not \"{}\"", shorten(&text)),
            "give the standard deviation of the logarithm, such as 0.3",
        );
        None
    }

    /// A whole number, at least 1.
    pub(super) fn count(&mut self, column: &'static str) -> Option<u32> {
        let text = self.text(column);
        if text.is_empty() {
            return None;
        }
        let count = text.parse().ok().filter(|count| *count > 0);
        if count.is_none() {
            let text = shorten(&text);
            self.note(
                column,
                format!("must be a whole number, at least 1, not \"{text}\""),
                "write a count, or leave the cell empty if it is not known",
            );
        }
        count
    }

    /// One of these values, by its name.
    pub(super) fn word<T: Copy + Into<&'static str>>(
        &mut self,
        column: &'static str,
        values: &[T],
    ) -> Option<T> {
        self.one_of(column, values, T::into)
    }

    /// Some of these values, by their names, with `|` between two.
    pub(super) fn words<T: Copy + Into<&'static str>>(
        &mut self,
        column: &'static str,
        values: &[T],
    ) -> Option<Vec<T>> {
        let text = self.text(column).to_lowercase();
        let one = |word: &str| {
            let mut known = values.iter().copied();
            known.find(|value| Into::<&'static str>::into(*value) == word.trim())
        };
        let found: Option<Vec<T>> = text.split('|').map(one).collect();
        if found.is_none() {
            let names: Vec<&str> = values.iter().map(|value| (*value).into()).collect();
            let message = format!("\"{}\" has an unknown value", shorten(&text));
            let hint = format!("write some of {}, with | between two", names.join(", "));
            self.note(column, message, hint);
        }
        found
    }

    /// One of these values, with the names that `name` gives them.
    pub(super) fn one_of<T: Copy>(
        &mut self,
        column: &'static str,
        values: &[T],
        name: impl Fn(T) -> &'static str,
    ) -> Option<T> {
        let text = self.text(column).to_lowercase();
        let found = values.iter().copied().find(|value| name(*value) == text);
        if found.is_none() {
            let names: Vec<&str> = values.iter().map(|value| name(*value)).collect();
            self.note(
                column,
                format!("\"{}\" is not a known value", shorten(&text)),
                format!("write one of {}", names.join(", ")),
            );
        }
        found
    }

    /// The id, by which inventories name the entry.
    pub(super) fn id(&mut self) -> String {
        let id = self.text("id").to_lowercase();
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        if id.is_empty() || !id.chars().all(is_plain) {
            let hint = "write letters, digits, - _ and ., such as rack-a12";
            self.note("id", format!("\"{}\" is not an id", shorten(&id)), hint);
        }
        id
    }

    /// The confidence; without a source with a page or a clause it must be recalled.
    pub(super) fn confidence(&mut self) -> Confidence {
        let confidence = self.word("confidence", Confidence::VARIANTS);
        let confidence = confidence.unwrap_or(Confidence::Recalled);
        let is_located = ["page", "clause"]
            .iter()
            .any(|column| !self.text(column).is_empty());
        let is_found = is_located && !self.text("source").is_empty();
        if confidence != Confidence::Recalled && !is_found {
            let message = format!(
                "\"{}\" needs a source, with a page or a clause",
                confidence.name()
            );
            self.note(
                "confidence",
                message,
                "give the source and its page or clause, or write recalled: the entry then decides no verdict",
            );
        }
        confidence
    }
}
