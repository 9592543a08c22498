//! The rows of a workbook (XLSX), cell by cell; empty cells take no memory.

use std::collections::BTreeMap;
use std::io::Cursor;

use calamine::{DataRef, Dimensions, ExcelDateTime, Reader, SheetVisible, Xlsx, XlsxError};

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use super::archive;
use super::cell::{Cell, Flow, MAX_COLUMNS, MAX_ROWS, Row};
use super::columns::letters;
use super::problems::bad_file;

/// The most cells of a sheet that is read or written: they are in memory. Lists of this size take
/// 0.6 GB with 100 columns and 1.1 GB with 15.
pub(super) const MAX_CELLS: usize = 4_000_000;

/// An open workbook.
pub(super) struct Workbook {
    xlsx: Xlsx<Cursor<Vec<u8>>>,
    facts: archive::Facts,
}

/// The formulas of a sheet that have a value.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Formulas {
    /// Their number.
    pub count: usize,
    /// The cell of the first, such as `F12`.
    pub first: Option<String>,
}

impl Formulas {
    /// A warning about them.
    pub(super) fn warning(&self) -> Option<String> {
        let first = self.first.as_ref()?;
        let cells = if self.count == 1 {
            "cell contains a formula"
        } else {
            "cells contain formulas"
        };
        Some(format!(
            "{} {cells}, the first in {first}: the saved values are read",
            self.count
        ))
    }
}

fn unreadable(error: &XlsxError) -> Problem {
    let message = match error {
        XlsxError::Password => "the workbook is protected with a password".to_owned(),
        _ => format!(
            "the workbook cannot be read: {}",
            shorten(&error.to_string())
        ),
    };
    let hint =
        "open it in a spreadsheet program and save it again as .xlsx without a password, or as CSV";
    bad_file(message, hint)
}

impl Workbook {
    /// Opens a workbook after checking what it unpacks to.
    ///
    /// # Errors
    /// What [`archive::check`] refuses, and what the library cannot read.
    pub(super) fn open(bytes: Vec<u8>) -> Result<Self, Problem> {
        let facts = archive::check(&bytes)?;
        let xlsx = Xlsx::new(Cursor::new(bytes)).map_err(|error| unreadable(&error))?;
        Ok(Self { xlsx, facts })
    }

    /// The sheets in their order, and whether each is visible.
    pub(super) fn sheets(&self) -> Vec<(String, bool)> {
        let sheets = self.xlsx.sheets_metadata().iter();
        sheets
            .map(|sheet| (sheet.name.clone(), sheet.visible == SheetVisible::Visible))
            .collect()
    }

    /// Passes the rows of a sheet that are not empty to `on_row`, as long as it asks for more.
    ///
    /// # Errors
    /// A sheet that cannot be read, or whose rows are not in order. A chart has no rows.
    pub(super) fn rows(
        &mut self,
        sheet: &str,
        on_row: &mut dyn FnMut(Row) -> Flow,
    ) -> Result<Formulas, Problem> {
        let mut formulas = Formulas::default();
        let mut cells = match self.xlsx.worksheet_cells_reader(sheet) {
            Ok(cells) => cells,
            Err(XlsxError::NotAWorksheet(_)) => return Ok(formulas),
            Err(error) => return Err(unreadable(&error)),
        };
        let mut row = Row::new(0);
        while let Some(read) = cells
            .next_cell_with_formula_metadata()
            .map_err(|error| unreadable(&error))?
        {
            let (at, column) = read.pos;
            let place = || format!("{}{}", letters(column as usize), u64::from(at) + 1);
            if at >= MAX_ROWS || column >= MAX_COLUMNS {
                let message = format!("cell {} lies beyond the limits of a sheet", place());
                return Err(bad_file(message, "save the workbook again, or as CSV"));
            }
            let Some(cell) = cell(&read.value, read.formula.is_some()) else {
                continue;
            };
            if read.formula.is_some() && !matches!(cell, Cell::Unevaluated) {
                formulas.count += 1;
                formulas.first.get_or_insert_with(place);
            }
            let number = at + 1;
            if number < row.number {
                let message = format!("row {number} follows row {}", row.number);
                let hint = "the workbook is damaged: save it again, or as CSV";
                return Err(bad_file(message, hint));
            }
            if number > row.number && !row.cells.is_empty() {
                let done = std::mem::replace(&mut row, Row::new(number));
                if on_row(sorted(done)) == Flow::Enough {
                    return Ok(formulas);
                }
            }
            row.number = number;
            row.cells.push((column, cell));
        }
        if !row.cells.is_empty() {
            on_row(sorted(row));
        }
        Ok(formulas)
    }

    /// What of a sheet a spreadsheet does not show.
    pub(super) fn hidden(&self, sheet: &str) -> archive::Hidden {
        let mut hidden = self.facts.hidden(sheet).cloned().unwrap_or_default();
        hidden.rows.sort_unstable();
        hidden
    }

    /// Cells of a sheet that are merged with one before them.
    ///
    /// # Errors
    /// A sheet that cannot be read.
    pub(super) fn merges(&mut self, sheet: &str) -> Result<Merges, Problem> {
        if !self.facts.has_merges {
            return Ok(Merges::default());
        }
        let all = self
            .xlsx
            .merge_cells_by_sheet_name(sheet)
            .map_err(|error| unreadable(&error))?;
        Ok(Merges::new(&all))
    }
}

/// Sorts the cells of a row: they may be in any order, though no program writes them so.
fn sorted(mut row: Row) -> Row {
    if !row.cells.is_sorted_by_key(|(column, _)| *column) {
        row.cells.sort_by_key(|(column, _)| *column);
    }
    row.cells.dedup_by_key(|(column, _)| *column);
    row
}

/// The content of a cell; `None`: it is empty.
fn cell(value: &DataRef<'_>, is_formula: bool) -> Option<Cell> {
    let text = |text: &str| (!text.is_empty()).then(|| Cell::text(text.to_owned()));
    match value {
        DataRef::Empty => is_formula.then_some(Cell::Unevaluated),
        DataRef::String(value) => text(value),
        DataRef::SharedString(value) => text(value),
        DataRef::Int(value) => Some(Cell::Number(*value as f64)),
        DataRef::Float(value) => Some(Cell::Number(*value)),
        DataRef::Bool(value) => Some(Cell::Bool(*value)),
        DataRef::DateTime(value) => Some(Cell::Date(date(value))),
        DataRef::DateTimeIso(value) | DataRef::DurationIso(value) => {
            Some(Cell::Date(shorten(value)))
        }
        DataRef::Error(value) => Some(Cell::Error(value.to_string())),
    }
}

/// `2024-05-01`, `2024-05-01T12:30:00`, or the days of a duration.
fn date(value: &ExcelDateTime) -> String {
    if value.is_duration() {
        return format!("{} days", value.as_f64());
    }
    let (year, month, day, hour, minute, second, _) = value.to_ymd_hms_milli();
    let date = format!("{year:04}-{month:02}-{day:02}");
    if (hour, minute, second) == (0, 0, 0) {
        date
    } else {
        format!("{date}T{hour:02}:{minute:02}:{second:02}")
    }
}

/// First row, last row (from 1), and the cell with the value (row from 1, column from 0).
type Merged = (u32, u32, (u32, u32));

/// A range of merged cells: first and last row (from 1), first and last column (from 0).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct MergedRange {
    pub rows: (u32, u32),
    pub columns: (u32, u32),
}

/// Merged cells by column: their first and last row, and the cell with the value.
#[derive(Debug, Default)]
pub(super) struct Merges {
    by_column: BTreeMap<u32, Vec<Merged>>,
    /// All of them.
    pub all: Vec<MergedRange>,
}

/// Largest number of columns of merged cells that are examined in one sheet.
const MAX_MERGED_COLUMNS: usize = 1_000_000;

impl Merges {
    fn new(all: &[Dimensions]) -> Self {
        let mut by_column: BTreeMap<u32, Vec<Merged>> = BTreeMap::new();
        let mut ranges = Vec::new();
        let mut count = 0;
        for one in all {
            if count > MAX_MERGED_COLUMNS {
                break;
            }
            let rows = (one.start.0 + 1, one.end.0 + 1);
            let columns = (one.start.1, one.end.1.min(MAX_COLUMNS - 1));
            ranges.push(MergedRange { rows, columns });
            for column in columns.0..=columns.1 {
                count += 1;
                if count > MAX_MERGED_COLUMNS {
                    break;
                }
                let merged = (rows.0, rows.1, (rows.0, columns.0));
                by_column.entry(column).or_default().push(merged);
            }
        }
        for column in by_column.values_mut() {
            column.sort_unstable();
        }
        Self {
            by_column,
            all: ranges,
        }
    }

    /// The cell with the value of this one, where it is merged with another; rows count from 1,
    /// columns from 0.
    pub(super) fn top_left(&self, row: u32, column: u32) -> Option<(u32, u32)> {
        let rows = self.by_column.get(&column)?;
        // Merged cells do not overlap: only the last that begins above can include this one.
        let before = rows
            .partition_point(|(first, ..)| *first <= row)
            .checked_sub(1)?;
        let (_, last, place) = rows.get(before)?;
        (row <= *last && *place != (row, column)).then_some(*place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merged_cells_name_the_one_that_has_the_value() {
        // B2:B4 and D5:F5, counted from 0 in the file.
        let merges = Merges::new(&[
            Dimensions {
                start: (4, 3),
                end: (4, 5),
            },
            Dimensions {
                start: (1, 1),
                end: (3, 1),
            },
        ]);
        assert_eq!(merges.top_left(2, 1), None);
        assert_eq!(merges.top_left(3, 1), Some((2, 1)));
        assert_eq!(merges.top_left(4, 1), Some((2, 1)));
        assert_eq!(merges.top_left(5, 1), None);
        assert_eq!(merges.top_left(5, 5), Some((5, 3)));
        assert_eq!(merges.top_left(5, 6), None);
    }
}
