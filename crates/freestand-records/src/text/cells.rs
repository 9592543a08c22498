//! Small tables with named columns, read cell by cell: cells may hold words or nothing.

use super::headings::{Heading, heading, only};
use super::lines::{Line, lines};
use super::table::quoted_cells;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, shorten};
use freestand_input::words::counted;

/// Rows of the longest table: storeys, modes, points of a curve. A file of millions is something else, and reading all
/// of it would take minutes, only to refuse it.
const MAX_ROWS: usize = 20_000;

/// A table.
pub(crate) struct Cells {
    separator: u8,
    pub(crate) headings: Vec<Heading>,
    /// Line of the headings, from 1.
    pub(crate) line: usize,
    pub(crate) rows: Vec<Row>,
    hint: &'static str,
}

/// One row: its line, and a cell for each heading.
pub(crate) struct Row {
    pub(crate) line: usize,
    cells: Vec<String>,
}

impl Row {
    pub(crate) fn text(&self, column: usize) -> &str {
        self.cells.get(column).map_or("", String::as_str)
    }
}

pub(crate) fn wrong(line: usize, message: impl Into<String>) -> Problem {
    Problem::new(ProblemKind::Format, message).at_line(line)
}

impl Cells {
    /// Reads a table; `hint` says what its headings should be.
    pub(crate) fn read(bytes: &[u8], hint: &'static str) -> Result<Self, Problem> {
        let mut rest = lines(bytes).filter(|line| !line.is_blank() && !line.is_comment());
        let header = rest
            .next()
            .ok_or_else(|| Problem::format("the file is empty", hint))?;
        let text = header.text();
        let separator = [b';', b'\t']
            .into_iter()
            .find(|byte| text.as_bytes().contains(byte))
            .unwrap_or(b',');
        let headings: Vec<Heading> = quoted_cells(&text, separator)
            .iter()
            .map(|cell| heading(cell))
            .collect();
        let mut rows = Vec::new();
        for line in rest {
            if rows.len() == MAX_ROWS {
                let message = format!("a table has at most {MAX_ROWS} rows, and more follow");
                return Err(wrong(line.number, message).hint(hint));
            }
            rows.push(row(&line, separator, headings.len())?);
        }
        if rows.is_empty() {
            return Err(wrong(header.number, "no rows follow the headings").hint(hint));
        }
        Ok(Self {
            separator,
            headings,
            line: header.number,
            rows,
            hint,
        })
    }

    /// The only column for which `is_it` holds.
    pub(crate) fn only(
        &self,
        is_it: impl Fn(&Heading) -> bool,
        what: &str,
    ) -> Result<Option<usize>, Problem> {
        only(&self.headings, self.line, is_it, what)
    }

    /// The only column of a dimension.
    pub(crate) fn needed(&self, dimension: Dimension, what: &str) -> Result<usize, Problem> {
        let found = self.only(|heading| heading.measures(dimension), what)?;
        found.ok_or_else(|| self.missing(&format!("{what} with its unit")))
    }

    /// The problem that no column holds `what`.
    pub(crate) fn missing(&self, what: &str) -> Problem {
        wrong(self.line, format!("no column holds {what}")).hint(self.hint)
    }

    /// The number in a cell, in SI if the heading has a unit.
    pub(crate) fn number(&self, row: &Row, column: usize, what: &str) -> Result<f64, Problem> {
        self.number_that(row, column, what, ("a number", |value| value.is_finite()))
    }

    /// The same for a number that must be positive.
    pub(crate) fn positive(&self, row: &Row, column: usize, what: &str) -> Result<f64, Problem> {
        self.number_that(
            row,
            column,
            what,
            ("a positive number", |value| {
                value > 0.0 && value.is_finite()
            }),
        )
    }

    fn number_that(
        &self,
        row: &Row,
        column: usize,
        what: &str,
        (kind, holds): (&str, fn(f64) -> bool),
    ) -> Result<f64, Problem> {
        let text = row.text(column);
        // Where semicolons separate the cells, a comma is a decimal sign.
        let plain = if self.separator == b';' {
            text.replace(',', ".")
        } else {
            text.to_owned()
        };
        let unit = self.headings.get(column).and_then(|heading| heading.unit);
        let value = plain
            .parse::<f64>()
            .ok()
            .map(|value| unit.map_or(value, |unit| unit.to_si(value)));
        value.filter(|value| holds(*value)).ok_or_else(|| {
            wrong(
                row.line,
                format!("the {what} is \"{}\", not {kind}", shorten(text)),
            )
            .hint("correct the cell, or make the row a comment with #")
        })
    }

    /// The same for a cell that may be empty.
    pub(crate) fn optional(
        &self,
        row: &Row,
        column: Option<usize>,
        what: &str,
    ) -> Result<Option<f64>, Problem> {
        let filled = column.filter(|&column| !row.text(column).is_empty());
        filled
            .map(|column| self.number(row, column, what))
            .transpose()
    }
}

fn row(line: &Line<'_>, separator: u8, headings: usize) -> Result<Row, Problem> {
    let cells = quoted_cells(&line.text(), separator);
    if cells.len() != headings {
        let found = counted(cells.len(), "cell");
        return Err(wrong(
            line.number,
            format!("this row has {found}, but the header has {headings}"),
        )
        .hint("write one row per line, with a cell for each heading"));
    }
    Ok(Row {
        line: line.number,
        cells,
    })
}
