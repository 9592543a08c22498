//! From CSV to XLSX and back, cell by cell, without interpreting or losing any.

use std::path::Path;

use freestand_input::problem::{Problem, Problems};

use super::cell::{Cell, Flow, Row};
use super::columns::{Heading, Holds, heading};
use super::encoding::is_unprintable;
use super::findings::{At, Findings};
use super::header::Header;
use super::source::{Source, load};
use super::values::pointed;
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
pub fn convert_inventory(path: &Path, sheet: Option<&str>, target: Target) -> Result<Converted, Problems> {
    convert_bytes(load(path)?, path, sheet, target)
}

/// As [`convert_inventory`], for the bytes of a file; `path` is for messages.
///
/// # Errors
/// As [`convert_inventory`].
pub fn convert_bytes(bytes: Vec<u8>, path: &Path, sheet: Option<&str>, target: Target) -> Result<Converted, Problems> {
    let in_file = |problem: Problem| problem.in_file(path);
    let mut source = Source::open(bytes, sheet).map_err(in_file)?;
    let mut warnings = std::mem::take(&mut source.warnings);
    warnings.extend(source.title_warning());
    let mut findings = Findings::new(path, source.sheet.clone());
    let has_decimal_comma = source.has_decimal_comma();
    let headings = headings(&source.header);
    let kinds: Vec<Kind> = headings.iter().map(|text| kind(text)).collect();
    let mut table = Table { headings, rows: Vec::new() };
    let read = source.rows(&mut |row: Row| {
        let written = written(&row, &kinds, has_decimal_comma, &table.headings, &mut findings);
        table.rows.push(written);
        Flow::More
    });
    match read {
        Ok(formulas) => warnings.extend(formulas.warning()),
        Err(problem) => findings.push(problem),
    }
    warnings.extend(findings.finish()?);
    let columns = table.rows.iter().map(Vec::len).fold(table.headings.len(), usize::max);
    table.headings.resize(columns, String::new());
    let bytes = match target {
        Target::Csv => csv(&table),
        Target::Xlsx => xlsx(&table, |_| Ok(())),
    };
    Ok(Converted { bytes: bytes.map_err(in_file)?, rows: table.rows.len(), columns, warnings })
}

/// One row of headings: units from a row of their own are appended to the names.
fn headings(header: &Header) -> Vec<String> {
    let width = header.headings.keys().last().map_or(0, |last| last + 1);
    let one = |index: u32| match (header.headings.get(&index), header.units.get(&index)) {
        (Some(text), Some(unit)) => format!("{text} [{}]", unit.symbol),
        (Some(text), None) => text.clone(),
        (None, _) => String::new(),
    };
    (0..width).map(one).collect()
}

/// How the cells of a column are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A column that freestand reads: text.
    Words,
    /// A column that freestand reads: numbers; a decimal comma becomes a point.
    Numbers,
    /// Another column.
    Carried,
}

fn kind(text: &str) -> Kind {
    match heading(text) {
        Heading::Other => Kind::Carried,
        Heading::Ours(column, _) | Heading::BadUnit(column, _) => match column.spec().holds {
            Holds::Quantity(_) | Holds::Count | Holds::Range => Kind::Numbers,
            Holds::Text | Holds::Rating => Kind::Words,
        },
    }
}

fn written(
    row: &Row,
    kinds: &[Kind],
    has_decimal_comma: bool,
    headings: &[String],
    findings: &mut Findings<'_>,
) -> Vec<Written> {
    let width = row.cells.last().map_or(0, |(column, _)| *column as usize + 1);
    let mut cells = vec![Written::Empty; width];
    for (column, cell) in &row.cells {
        let index = *column as usize;
        let kind = kinds.get(index).copied().unwrap_or(Kind::Carried);
        let one = match cell {
            Cell::Number(value) if value.is_finite() => Written::Number(*value),
            Cell::Text(text) if text.chars().any(is_unprintable) => {
                let at = At { row: row.number, line: row.line };
                let heading = headings.get(index).map_or("", String::as_str);
                let hint = "type the cell again".to_owned();
                findings.of_cell(at, *column, heading, "contains a control character, which no CSV allows", Some(hint));
                Written::Empty
            }
            // In a workbook, line endings within a cell are LF.
            Cell::Text(text) => {
                let text = text.replace("\r\n", "\n").replace('\r', "\n");
                let text = if has_decimal_comma && kind == Kind::Numbers { pointed(&text) } else { text };
                Written::of(&text, kind != Kind::Words)
            }
            Cell::Unevaluated | Cell::TooLong(_) => {
                let at = At { row: row.number, line: row.line };
                let (message, hint) = match cell {
                    Cell::TooLong(chars) => {
                        (format!("has {chars} characters, more than a cell of a spreadsheet can hold"), "shorten it")
                    }
                    _ => (
                        "is a formula without a value".to_owned(),
                        "open the workbook in a spreadsheet program and save it again",
                    ),
                };
                let heading = headings.get(index).map_or("", String::as_str);
                findings.of_cell(at, *column, heading, &message, Some(hint.to_owned()));
                Written::Empty
            }
            other => Written::of(&other.shown(), false),
        };
        if let Some(slot) = cells.get_mut(index) {
            *slot = one;
        }
    }
    cells
}
