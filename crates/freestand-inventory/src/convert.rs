//! From CSV to XLSX and back, cell by cell, without interpreting or losing any.

use std::path::Path;

use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;

use super::cell::{Cell, Row};
use super::columns::{Holds, letters};
use super::encoding::is_unprintable;
use super::headings::{HeadingUnit, meaning};
use super::layout::{Body, body, unevaluated};
use super::problems::Kind;
use super::source::{Sheet, load};
use super::understood::understand;
use super::used::Evidence;
use super::write::{Table, Written, csv, xlsx};

/// A format to convert to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Commas, UTF-8.
    Csv,
    /// A workbook.
    Xlsx,
}

/// A file that was converted.
#[derive(Debug, Clone, PartialEq)]
pub struct Converted {
    /// The converted file.
    pub bytes: Vec<u8>,
    /// Rows below the headings.
    pub rows: usize,
    /// Columns.
    pub columns: usize,
    /// What has changed.
    pub warnings: Vec<String>,
}

/// Converts an inventory; every cell is kept. Text that begins with `= + - @` gets a leading `'` in
/// CSV and is a string cell in XLSX; reading removes the `'`. The same file gives the same bytes.
///
/// # Errors
/// A file that cannot be read or has no headings of an inventory, formulas without values, cells
/// that are too long, and inventories that do not fit into a sheet.
pub fn convert_inventory(
    path: &Path,
    sheet: Option<&str>,
    target: Target,
) -> Result<Converted, Problems> {
    convert_bytes(load(path)?, path, sheet, target)
}

/// As [`convert_inventory`], for the bytes of a file; `path` is for messages.
///
/// # Errors
/// As [`convert_inventory`].
pub fn convert_bytes(
    bytes: Vec<u8>,
    path: &Path,
    sheet: Option<&str>,
    target: Target,
) -> Result<Converted, Problems> {
    let in_file = |problem: Problem| problem.in_file(path);
    let mut source = Sheet::open(bytes, sheet, None).map_err(in_file)?;
    let mut warnings = std::mem::take(&mut source.warnings);
    warnings.extend(source.title_warning());
    warnings.extend(source.formulas.warning());
    let (headings, body) = headings(&source);
    // A total that was not calculated is no object.
    warnings.extend(unevaluated(&source.rows, &|row| body.leaves_out(row)));
    let mut problems = Problems::default();
    for (column, heading) in headings.iter().enumerate() {
        if heading.chars().any(is_unprintable) {
            let place = format!("the heading of column {}", letters(column));
            problems.push(Problem::value(
                format!("{place} {}", Kind::Unprintable.words()),
                "type the cell again",
            ));
        }
    }
    let are_words: Vec<bool> = headings.iter().map(|text| holds_words(text)).collect();
    let below = source
        .rows
        .iter()
        .filter(|row| row.number > source.header.last_row);
    let rows = below
        .map(|row| {
            written(
                row,
                &are_words,
                &headings,
                body.leaves_out(row),
                &mut problems,
            )
        })
        .collect();
    let mut table = Table { headings, rows };
    problems
        .finish(Some(()))
        .map_err(|error| error.into_iter().map(in_file).collect::<Problems>())?;
    let columns = table
        .rows
        .iter()
        .map(Vec::len)
        .fold(table.headings.len(), usize::max);
    table.headings.resize(columns, String::new());
    let bytes = match target {
        Target::Csv => csv(&table),
        Target::Xlsx => xlsx(&table, |_| Ok(())),
    };
    Ok(Converted {
        bytes: bytes.map_err(in_file)?,
        rows: table.rows.len(),
        columns,
        warnings,
    })
}

/// One row of headings: units that a row of their own or a sentence beside the table states are
/// appended to the names. With them what the rows below are.
fn headings(source: &Sheet) -> (Vec<String>, Body) {
    let header = &source.header;
    let (body, _) = body(&source.rows, header);
    let evidence = Evidence {
        rows: &source.rows,
        header,
        body: &body,
        mapping: None,
        has_semicolons: false,
    };
    let understood = understand(&evidence);
    let width = header.headings.keys().last().map_or(0, |last| last + 1);
    let one = |index: u32| {
        let text = header.heading(index);
        let is_bare = meaning(&text).is_some_and(|found| found.unit == HeadingUnit::None);
        let found = understood.uses.iter().find(|one| one.index == index);
        match found.and_then(|one| one.unit.filter(|_| is_bare && one.is_unit_stated_outside())) {
            Some(unit) => format!("{text} [{}]", unit.symbol()),
            None => text,
        }
    };
    let headings = (0..width).map(one).collect();
    (headings, body)
}

/// Whether a column holds words, which stay words in a workbook.
fn holds_words(heading: &str) -> bool {
    meaning(heading).is_some_and(|found| {
        matches!(
            found.column.spec().holds,
            Holds::Text | Holds::Rating | Holds::Answer | Holds::Casters | Holds::Sizes
        )
    })
}

/// Largest number of cells that cannot be written that are listed.
const MAX_PROBLEMS: usize = 20;

fn written(
    row: &Row,
    are_words: &[bool],
    headings: &[String],
    is_left_out: bool,
    problems: &mut Problems,
) -> Vec<Written> {
    let width = row
        .cells
        .last()
        .map_or(0, |(column, _)| *column as usize + 1);
    let mut cells = vec![Written::Empty; width];
    let mut refused = |column: u32, what: String, hint: &str| {
        if problems.len() < MAX_PROBLEMS {
            let heading = headings.get(column as usize).map_or("", String::as_str);
            let place = format!(
                "row {}, column {} ({})",
                row.number,
                letters(column as usize),
                shorten(heading)
            );
            problems.push(Problem::value(format!("{place}: {what}"), hint));
        }
        Written::Empty
    };
    for (column, cell) in &row.cells {
        let index = *column as usize;
        let is_word = are_words.get(index).copied().unwrap_or(false);
        let one = match cell {
            Cell::Number(value) if value.is_finite() => Written::Number(*value),
            Cell::Text(text) if text.chars().any(is_unprintable) => refused(
                *column,
                Kind::Unprintable.words().to_owned(),
                "type the cell again",
            ),
            // In a workbook, line endings within a cell are LF.
            Cell::Text(text) => {
                let text = text.replace("\r\n", "\n").replace('\r', "\n");
                Written::of(&text, !is_word)
            }
            Cell::TooLong(chars) => {
                let what =
                    format!("has {chars} characters, more than a cell of a spreadsheet can hold");
                refused(*column, what, "shorten it")
            }
            Cell::Unevaluated if is_left_out => Written::Empty,
            Cell::Unevaluated => refused(
                *column,
                "is a formula without a value".to_owned(),
                "open the workbook in a spreadsheet program and save it again",
            ),
            other => Written::of(&other.shown(), false),
        };
        cells[index] = one;
    }
    cells
}
