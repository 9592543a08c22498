//! A library as a table: named columns with units, one entry in each row, all problems reported at
//! once.

use std::path::Path;

use freestand_input::file::load_up_to;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, Unit, find_unit, shorten};
use freestand_input::words::nearest;

use crate::problems::bad_file;

/// Largest file of a library \[bytes\]; ten thousand entries need far less.
const MAX_BYTES: u64 = 8 << 20;
/// Largest number of entries.
const MAX_ROWS: usize = 10_000;
/// Largest number of columns.
const MAX_COLUMNS: usize = 200;
const SAVE_AS: &str = "save the table as CSV (UTF-8)";
/// Longest header that is checked for typing mistakes.
const MAX_NAME_CHARS: usize = 60;

/// A column: its name and, for numbers, their dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Column {
    /// Its name in headers.
    pub name: &'static str,
    /// The dimension of its numbers.
    pub dimension: Option<Dimension>,
    /// Whether a file must have it.
    pub needed: bool,
}

impl Column {
    pub(super) const fn text(name: &'static str) -> Self {
        Self {
            name,
            dimension: None,
            needed: false,
        }
    }

    pub(super) const fn number(name: &'static str, dimension: Dimension) -> Self {
        Self {
            dimension: Some(dimension),
            ..Self::text(name)
        }
    }

    pub(super) const fn needed(self) -> Self {
        Self {
            needed: true,
            ..self
        }
    }
}

/// A cell: its text, and the unit of its column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell<'a> {
    pub text: &'a str,
    pub unit: Option<&'static Unit>,
}

/// A row, and the line where it begins.
#[derive(Debug)]
pub(super) struct Row {
    pub line: usize,
    cells: Vec<String>,
}

/// A known column of a library.
#[derive(Debug)]
struct Found {
    name: &'static str,
    /// Its place in a row.
    place: usize,
    unit: Option<&'static Unit>,
}

/// A library as a table of cells.
#[derive(Debug)]
pub(super) struct Table {
    /// Each known column.
    columns: Vec<Found>,
    pub rows: Vec<Row>,
    pub warnings: Vec<String>,
}

impl Table {
    /// The cell of a row in a column; empty where the file does not have the column.
    pub(super) fn cell<'a>(&self, row: &'a Row, name: &str) -> Cell<'a> {
        let column = self.columns.iter().find(|column| column.name == name);
        let text = column
            .and_then(|column| row.cells.get(column.place))
            .map_or("", |text| text.trim());
        Cell {
            text,
            unit: column.and_then(|column| column.unit),
        }
    }
}

/// The bytes of a library file.
pub(super) fn load(path: &Path, columns: &[Column]) -> Result<Vec<u8>, Problem> {
    let hint = format!(
        "give a library: a CSV file with the columns {}",
        names(columns).join(", ")
    );
    load_up_to(
        path,
        MAX_BYTES,
        "is larger than 8 MiB, too large for a library",
        &hint,
    )
    .map_err(|problem| problem.hint(&hint))
}

/// Splits a library into its cells.
///
/// # Errors
/// A file that is not text, has no header or lacks a column, has rows of different lengths, or too
/// many rows.
pub(super) fn read_table(bytes: &[u8], columns: &[Column]) -> Result<Table, Problems> {
    let text = std::str::from_utf8(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes))
        .map_err(|_| bad_file("is not text in UTF-8", SAVE_AS))?;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .comment(Some(b'#'))
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut records = reader.records();
    let Some(header) = records.next() else {
        let problem = bad_file("has no header", header_hint(columns));
        return Err(problem.at_line(1).into());
    };
    let header = header.map_err(|error| csv_problem(&error))?;
    if header.len() > MAX_COLUMNS {
        let message = format!(
            "has {} columns; a library has at most {MAX_COLUMNS}",
            header.len()
        );
        let problem = bad_file(message, header_hint(columns));
        return Err(problem.at_line(1).into());
    }
    let (found, mut problems, warnings) = headers(&header, columns);
    let mut rows = Vec::new();
    for record in records {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                problems.push(csv_problem(&error));
                break;
            }
        };
        let line = record.position().map_or(0, line);
        if record.iter().all(str::is_empty) {
            continue;
        }
        if record.len() != header.len() {
            let message = format!(
                "this row has {} cells, but the header has {}",
                record.len(),
                header.len()
            );
            let hint = "put cells that contain commas in quotes";
            problems.push(bad_file(message, hint).at_line(line));
            continue;
        }
        if rows.len() == MAX_ROWS {
            let message = format!("has more than {MAX_ROWS} entries");
            problems.push(bad_file(message, "split the library").at_line(line));
            break;
        }
        rows.push(Row {
            line,
            cells: record.iter().map(str::to_owned).collect(),
        });
    }
    problems.finish(Some(Table {
        columns: found,
        rows,
        warnings,
    }))
}

fn line(position: &csv::Position) -> usize {
    usize::try_from(position.line()).unwrap_or(usize::MAX)
}

fn csv_problem(error: &csv::Error) -> Problem {
    bad_file(format!("is not CSV: {error}"), SAVE_AS).at_line(error.position().map_or(1, line))
}

fn names(columns: &[Column]) -> Vec<&'static str> {
    columns.iter().map(|column| column.name).collect()
}

fn header_hint(columns: &[Column]) -> String {
    format!(
        "the first line must name the columns: {}",
        names(columns).join(", ")
    )
}

/// Finds the known columns in the header.
fn headers(header: &csv::StringRecord, columns: &[Column]) -> (Vec<Found>, Problems, Vec<String>) {
    let (mut found, mut problems, mut warnings): (Vec<Found>, Problems, Vec<String>) =
        Default::default();
    let names = names(columns);
    let mut note = |column: &Column, what: &str, hint: String| {
        let message = format!("column {}{what}", column.name);
        problems.push(bad_file(message, hint).at_line(1));
    };
    for (place, text) in header.iter().enumerate() {
        let (name, unit) = split_header(text);
        let Some(column) = columns.iter().find(|column| column.name == name) else {
            let near = Some(&name)
                .filter(|name| name.len() <= MAX_NAME_CHARS)
                .and_then(|name| nearest(name, &names));
            let near = near.map_or_else(String::new, |near| format!(": did you mean {near}?"));
            warnings.push(format!(
                "column \"{}\" does not belong to a library and is ignored{near}",
                shorten(text)
            ));
            continue;
        };
        if found.iter().any(|one| one.name == column.name) {
            note(column, " occurs twice", "keep one of them".to_owned());
            continue;
        }
        let of = |unit| Found {
            name: column.name,
            place,
            unit,
        };
        match (column.dimension, unit) {
            (Some(Dimension::Ratio) | None, None) => found.push(of(None)),
            (Some(dimension), None) => {
                let symbol = dimension.units().next().map_or("", |unit| unit.symbol);
                let hint = format!(
                    "give it in the header, such as \"{} [{symbol}]\"",
                    column.name
                );
                note(column, " has no unit", hint);
            }
            (None | Some(Dimension::Ratio), Some(_)) => {
                note(
                    column,
                    " must not have a unit",
                    "remove the unit".to_owned(),
                );
            }
            (Some(dimension), Some(unit)) => match find_unit(&unit, dimension) {
                Ok(unit) => found.push(of(Some(unit))),
                Err(problem) => {
                    let hint = problem.hint.unwrap_or_default();
                    note(column, &format!(": {}", problem.message), hint);
                }
            },
        }
    }
    for column in columns.iter().filter(|column| column.needed) {
        if !found.iter().any(|one| one.name == column.name) {
            note(column, " is missing", header_hint(columns));
        }
    }
    (found, problems, warnings)
}

/// The name and the unit of a header: `Edge lift [mm]` → `edge_lift` and `mm`.
fn split_header(text: &str) -> (String, Option<String>) {
    let (name, unit) = text.split_once(['[', '(']).unwrap_or((text, ""));
    let unit = unit.trim_end_matches([']', ')']).trim();
    (
        name.trim().to_lowercase().replace([' ', '-'], "_"),
        (!unit.is_empty()).then(|| unit.to_owned()),
    )
}
