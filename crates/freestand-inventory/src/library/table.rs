//! A library as a table: named columns with units, one entry in each row, all problems reported at
//! once.

use std::path::Path;

use freestand_input::file::load_up_to;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, Unit, find_unit, shorten};
use freestand_input::words::nearest;

/// Largest file of a library \[bytes\]; ten thousand entries need far less.
const MAX_BYTES: u64 = 8 << 20;
/// Largest number of entries.
const MAX_ROWS: usize = 10_000;
/// Largest number of columns.
const MAX_COLUMNS: usize = 200;
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
            name,
            dimension: Some(dimension),
            needed: false,
        }
    }

    pub(super) const fn needed(name: &'static str) -> Self {
        Self {
            name,
            dimension: None,
            needed: true,
        }
    }
}

/// A cell: its text, and the unit of its column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell<'a> {
    pub(super) text: &'a str,
    pub(super) unit: Option<&'static Unit>,
}

/// A row, and the line where it begins.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) line: usize,
    cells: Vec<String>,
}

/// A library as a table of cells.
#[derive(Debug)]
pub(super) struct Table {
    /// The place and the unit of each known column.
    places: Vec<(&'static str, usize, Option<&'static Unit>)>,
    pub(super) rows: Vec<Row>,
    pub(super) warnings: Vec<String>,
}

impl Table {
    /// The cell of a row in a column; empty where the file does not have the column.
    pub(super) fn cell<'a>(&self, row: &'a Row, name: &str) -> Cell<'a> {
        let place = self.places.iter().find(|(known, ..)| *known == name);
        let text = place
            .and_then(|(_, at, _)| row.cells.get(*at))
            .map_or("", |text| text.trim());
        Cell {
            text,
            unit: place.and_then(|(.., unit)| *unit),
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
    let format = |message: String| Problem::new(ProblemKind::Format, message);
    let text = std::str::from_utf8(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)).map_err(
        |_| format("is not text in UTF-8".to_owned()).hint("save the table as CSV (UTF-8)"),
    )?;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .comment(Some(b'#'))
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut records = reader.records();
    let Some(header) = records.next() else {
        return Err(format("has no header".to_owned())
            .at_line(1)
            .hint(header_hint(columns))
            .into());
    };
    let header = header.map_err(|error| csv_problem(&error))?;
    if header.len() > MAX_COLUMNS {
        let message = format!(
            "has {} columns; a library has at most {MAX_COLUMNS}",
            header.len()
        );
        return Err(format(message).at_line(1).hint(header_hint(columns)).into());
    }
    let (places, mut problems, warnings) = headers(&header, columns);
    let mut rows = Vec::new();
    for record in records {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                problems.push(csv_problem(&error));
                break;
            }
        };
        let line = record.position().map_or(0, |position| {
            usize::try_from(position.line()).unwrap_or(usize::MAX)
        });
        if record.iter().all(str::is_empty) {
            continue;
        }
        if record.len() != header.len() {
            let message = format!(
                "this row has {} cells, but the header has {}",
                record.len(),
                header.len()
            );
            problems.push(
                format(message)
                    .at_line(line)
                    .hint("put cells that contain commas in quotes"),
            );
            continue;
        }
        if rows.len() == MAX_ROWS {
            problems.push(
                format(format!("has more than {MAX_ROWS} entries"))
                    .at_line(line)
                    .hint("split the library"),
            );
            break;
        }
        rows.push(Row {
            line,
            cells: record.iter().map(str::to_owned).collect(),
        });
    }
    problems.finish(Some(Table {
        places,
        rows,
        warnings,
    }))
}

fn csv_problem(error: &csv::Error) -> Problem {
    let line = error.position().map_or(1, |position| {
        usize::try_from(position.line()).unwrap_or(usize::MAX)
    });
    Problem::new(ProblemKind::Format, format!("is not CSV: {error}"))
        .at_line(line)
        .hint("save the table as CSV (UTF-8)")
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

type Places = Vec<(&'static str, usize, Option<&'static Unit>)>;

/// Finds the known columns in the header.
fn headers(header: &csv::StringRecord, columns: &[Column]) -> (Places, Problems, Vec<String>) {
    let (mut places, mut problems, mut warnings): (Places, Problems, Vec<String>) =
        Default::default();
    let names = names(columns);
    let mut note = |message: String, hint: String| {
        problems.push(
            Problem::new(ProblemKind::Format, message)
                .at_line(1)
                .hint(hint),
        );
    };
    for (at, text) in header.iter().enumerate() {
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
        if places.iter().any(|(known, ..)| *known == column.name) {
            note(
                format!("column {} occurs twice", column.name),
                "keep one of them".to_owned(),
            );
            continue;
        }
        match (column.dimension, unit) {
            (Some(Dimension::Ratio) | None, None) => places.push((column.name, at, None)),
            (Some(dimension), None) => {
                let symbol = dimension.units().next().map_or("", |unit| unit.symbol);
                let hint = format!(
                    "give it in the header, such as \"{} [{symbol}]\"",
                    column.name
                );
                note(format!("column {} has no unit", column.name), hint);
            }
            (None | Some(Dimension::Ratio), Some(_)) => {
                note(
                    format!("column {} must not have a unit", column.name),
                    "remove the unit".to_owned(),
                );
            }
            (Some(dimension), Some(unit)) => match find_unit(&unit, dimension) {
                Ok(unit) => places.push((column.name, at, Some(unit))),
                Err(problem) => {
                    note(
                        format!("column {}: {}", column.name, problem.message),
                        problem.hint.unwrap_or_default(),
                    );
                }
            },
        }
    }
    for column in columns.iter().filter(|column| column.needed) {
        if !places.iter().any(|(known, ..)| *known == column.name) {
            note(
                format!("column {} is missing", column.name),
                header_hint(columns),
            );
        }
    }
    (places, problems, warnings)
}

/// The name and the unit of a header: `Edge lift [mm]` → `edge_lift` and `mm`.
fn split_header(text: &str) -> (String, Option<String>) {
    let (name, unit) = match text.split_once(['[', '(']) {
        Some((name, unit)) => (
            name,
            Some(unit.trim_end_matches([']', ')']).trim().to_owned()),
        ),
        None => (text, None),
    };
    (
        name.trim().to_lowercase().replace([' ', '-'], "_"),
        unit.filter(|unit| !unit.is_empty()),
    )
}
