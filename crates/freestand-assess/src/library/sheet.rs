//! A library as a table: named columns with their units, one entry a row, everything that is wrong said at once.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, Unit, find_unit, shorten};
use freestand_input::words::nearest;

/// A library of ten thousand entries is far below this.
const LARGEST_BYTES: u64 = 8 << 20;
/// Entries beyond this are no library.
const MOST_ROWS: usize = 10_000;
const MOST_COLUMNS: usize = 200;
/// A longer header is no slip of a name of ours.
const LONGEST_NAME: usize = 60;

/// A column: its name and, of a number, its dimension and the unit of a header that states none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column {
    /// As in headers.
    pub name: &'static str,
    /// Of a number with a unit.
    pub dimension: Option<Dimension>,
    /// Whether a file must have it.
    pub needed: bool,
}

impl Column {
    pub(super) const fn text(name: &'static str) -> Self {
        Self { name, dimension: None, needed: false }
    }

    pub(super) const fn number(name: &'static str, dimension: Dimension) -> Self {
        Self { name, dimension: Some(dimension), needed: false }
    }

    pub(super) const fn needed(name: &'static str) -> Self {
        Self { name, dimension: None, needed: true }
    }
}

/// A cell: what is written, and the unit of its column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell<'a> {
    pub(super) text: &'a str,
    pub(super) unit: Option<&'static Unit>,
}

/// A row with the line that it begins on.
#[derive(Debug)]
pub(super) struct SheetRow {
    pub(super) line: usize,
    cells: Vec<String>,
}

/// A library that was read, cell by cell.
#[derive(Debug)]
pub(super) struct Sheet {
    /// Of each known column its place and unit.
    places: Vec<(&'static str, usize, Option<&'static Unit>)>,
    pub(super) rows: Vec<SheetRow>,
    pub(super) warnings: Vec<String>,
}

impl Sheet {
    /// What stands in a column of a row; empty where there is no such column.
    pub(super) fn cell<'a>(&self, row: &'a SheetRow, name: &str) -> Cell<'a> {
        let place = self.places.iter().find(|(known, ..)| *known == name);
        let text = place.and_then(|(_, at, _)| row.cells.get(*at)).map_or("", |text| text.trim());
        Cell { text, unit: place.and_then(|(.., unit)| *unit) }
    }
}

/// The bytes of a library file.
pub(super) fn load(path: &Path) -> Result<(Vec<u8>, InputFile), Problems> {
    let broken = |message: String| {
        let hint = "name a library: a CSV file with the columns that --help lists";
        Problem::new(ProblemKind::Io, message).in_file(path).hint(hint)
    };
    let file = File::open(path).map_err(|error| broken(format!("cannot open the library: {error}")))?;
    if file.metadata().is_ok_and(|facts| facts.is_dir()) {
        return Err(broken("is a folder, not a library".to_owned()).into());
    }
    let mut bytes = Vec::new();
    let read = file.take(LARGEST_BYTES + 1).read_to_end(&mut bytes);
    read.map_err(|error| broken(format!("cannot read the library: {error}")))?;
    if bytes.len() as u64 > LARGEST_BYTES {
        return Err(broken("is larger than 8 MiB, too large for a library".to_owned()).into());
    }
    let input = InputFile::new(path, &bytes);
    Ok((bytes, input))
}

/// Splits a library into its cells.
///
/// # Errors
/// What is no text, has no header or lacks a column, a row of another length, too many rows.
pub(super) fn read_sheet(bytes: &[u8], columns: &[Column]) -> Result<Sheet, Problems> {
    let format = |message: String| Problem::new(ProblemKind::Format, message);
    let text = std::str::from_utf8(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes))
        .map_err(|_| format("is not text in UTF-8".to_owned()).hint("save the table as CSV, UTF-8"))?;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .comment(Some(b'#'))
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut records = reader.records();
    let Some(header) = records.next() else {
        return Err(format("has no header".to_owned()).at_line(1).hint(header_hint(columns)).into());
    };
    let header = header.map_err(|error| csv_problem(&error))?;
    if header.len() > MOST_COLUMNS {
        let message = format!("has {} columns, no library has more than {MOST_COLUMNS}", header.len());
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
        let line = record.position().map_or(0, |position| usize::try_from(position.line()).unwrap_or(usize::MAX));
        if record.iter().all(str::is_empty) {
            continue;
        }
        if record.len() != header.len() {
            let message = format!("a row has {} cells, this one {}", header.len(), record.len());
            problems.push(format(message).at_line(line).hint("put cells with commas in quotes"));
            continue;
        }
        if rows.len() == MOST_ROWS {
            problems.push(format(format!("has more than {MOST_ROWS} entries")).at_line(line).hint("split the library"));
            break;
        }
        rows.push(SheetRow { line, cells: record.iter().map(str::to_owned).collect() });
    }
    if problems.is_empty() { Ok(Sheet { places, rows, warnings }) } else { Err(Problems { problems }) }
}

fn csv_problem(error: &csv::Error) -> Problem {
    let line = error.position().map_or(1, |position| usize::try_from(position.line()).unwrap_or(usize::MAX));
    Problem::new(ProblemKind::Format, format!("is not CSV: {error}")).at_line(line).hint("save the table as CSV, UTF-8")
}

fn header_hint(columns: &[Column]) -> String {
    let names: Vec<&str> = columns.iter().map(|column| column.name).collect();
    format!("the first line names the columns: {}", names.join(", "))
}

type Places = Vec<(&'static str, usize, Option<&'static Unit>)>;

/// Finds the known columns in the header.
fn headers(header: &csv::StringRecord, columns: &[Column]) -> (Places, Vec<Problem>, Vec<String>) {
    let (mut places, mut problems, mut warnings): (Places, Vec<Problem>, Vec<String>) = Default::default();
    let names: Vec<&str> = columns.iter().map(|column| column.name).collect();
    let mut note = |message: String, hint: String| {
        problems.push(Problem::new(ProblemKind::Format, message).at_line(1).hint(hint));
    };
    for (at, text) in header.iter().enumerate() {
        let (name, unit) = split_header(text);
        let Some(column) = columns.iter().find(|column| column.name == name) else {
            let near = Some(&name).filter(|name| name.len() <= LONGEST_NAME).and_then(|name| nearest(name, &names));
            let near = near.map_or_else(String::new, |near| format!(": did you mean {near}?"));
            warnings.push(format!("column \"{}\" is not one of a library and is left out{near}", shorten(text)));
            continue;
        };
        if places.iter().any(|(known, ..)| *known == column.name) {
            note(format!("column {} stands there twice", column.name), "keep one of them".to_owned());
            continue;
        }
        match (column.dimension, unit) {
            (Some(Dimension::Ratio) | None, None) => places.push((column.name, at, None)),
            (Some(dimension), None) => {
                let symbol = dimension.units().next().map_or("", |unit| unit.symbol);
                let hint = format!("state it in the header, such as \"{} [{symbol}]\"", column.name);
                note(format!("column {} has no unit", column.name), hint);
            }
            (None | Some(Dimension::Ratio), Some(_)) => {
                note(format!("column {} takes no unit", column.name), "leave the unit out".to_owned());
            }
            (Some(dimension), Some(unit)) => match find_unit(&unit, dimension) {
                Ok(unit) => places.push((column.name, at, Some(unit))),
                Err(problem) => {
                    note(format!("column {}: {}", column.name, problem.message), problem.hint.unwrap_or_default());
                }
            },
        }
    }
    for column in columns.iter().filter(|column| column.needed) {
        if !places.iter().any(|(known, ..)| *known == column.name) {
            note(format!("column {} is missing", column.name), header_hint(columns));
        }
    }
    (places, problems, warnings)
}

/// `Edge lift [mm]` → `edge_lift` and `mm`.
fn split_header(text: &str) -> (String, Option<String>) {
    let (name, unit) = match text.split_once(['[', '(']) {
        Some((name, unit)) => (name, Some(unit.trim_end_matches([']', ')']).trim().to_owned())),
        None => (text, None),
    };
    (name.trim().to_lowercase().replace([' ', '-'], "_"), unit.filter(|unit| !unit.is_empty()))
}
