//! Writing tables of cells as CSV or as a workbook; the same cells give the same bytes.

use rust_xlsxwriter::{
    DataValidation, DocProperties, ExcelDateTime, Format, FormatAlign, FormatBorder, Workbook,
    Worksheet, XlsxError,
};

use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::Dimension;

use super::cell::{MAX_CELL_CHARS, MAX_ROWS};
use super::columns::{Column, Holds};
use super::headings::{HeadingUnit, meaning};
use super::workbook::MAX_CELLS;
use freestand_input::formula::guarded;

/// Behind headings.
const HEADER_COLOR: &str = "#DDE7F0";
/// Name of the sheet with the objects.
pub(super) const SHEET: &str = "Inventory";
/// Number of rows below the last that also have the drop-down lists.
const ROWS_TO_COME: u32 = 1000;

/// A cell to write.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Written {
    Empty,
    Text(String),
    Number(f64),
}

/// A table to write: headings, and rows with at most as many cells.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    pub headings: Vec<String>,
    pub rows: Vec<Vec<Written>>,
}

impl Written {
    /// A text, or a number if reading it back gives the same digits.
    pub(super) fn of(text: &str, may_be_number: bool) -> Self {
        if text.is_empty() {
            return Self::Empty;
        }
        match text.parse::<f64>() {
            Ok(value) if may_be_number && value.is_finite() && format!("{value}") == text => {
                Self::Number(value)
            }
            _ => Self::Text(text.to_owned()),
        }
    }
}

/// A table as CSV: commas, LF, UTF-8 without a byte-order mark. Text that a spreadsheet would take
/// for a formula gets a leading `'`.
///
/// # Errors
/// None that a user can cause.
pub(super) fn csv(table: &Table) -> Result<Vec<u8>, Problem> {
    let mut writer = csv::WriterBuilder::new()
        .flexible(true)
        .terminator(csv::Terminator::Any(b'\n'))
        .from_writer(Vec::new());
    let failed = |error: &dyn std::fmt::Display| {
        Problem::new(ProblemKind::Io, format!("cannot write the CSV: {error}"))
    };
    let width = table.headings.len();
    let headings = table.headings.iter().map(|text| guarded(text).into_owned());
    let rows = table.rows.iter().map(|row| {
        let mut cells: Vec<String> = row.iter().map(Written::in_csv).collect();
        cells.resize(width.max(cells.len()), String::new());
        cells
    });
    for cells in std::iter::once(headings.collect()).chain(rows) {
        writer
            .write_record(&cells)
            .map_err(|error| failed(&error))?;
    }
    writer.into_inner().map_err(|error| failed(&error))
}

impl Written {
    fn in_csv(&self) -> String {
        match self {
            Self::Empty => String::new(),
            Self::Text(text) => guarded(text).into_owned(),
            Self::Number(value) => format!("{value}"),
        }
    }
}

/// An empty workbook; with the current date, its bytes would differ from run to run.
pub(super) fn workbook(title: &str) -> Result<Workbook, XlsxError> {
    let mut workbook = Workbook::new();
    let created = ExcelDateTime::from_ymd(2000, 1, 1)?;
    workbook.set_properties(
        &DocProperties::new()
            .set_title(title)
            .set_creation_datetime(&created),
    );
    Ok(workbook)
}

/// The format of texts that take several lines.
pub(super) fn wrapped() -> Format {
    Format::new().set_text_wrap().set_align(FormatAlign::Top)
}

/// Fills a sheet with rows of texts below these headings, each with its width.
pub(super) fn explain<const N: usize>(
    sheet: &mut Worksheet,
    headings: [(&str, u32); N],
    rows: impl Iterator<Item = [String; N]>,
) -> Result<(), XlsxError> {
    let bold = Format::new().set_bold().set_background_color(HEADER_COLOR);
    let wrap = wrapped();
    for (column, (text, width)) in (0u16..).zip(headings) {
        sheet.write_string_with_format(0, column, text, &bold)?;
        sheet.set_column_width(column, width)?;
    }
    for (row, texts) in (1u32..).zip(rows) {
        for (column, text) in (0u16..).zip(texts) {
            sheet.write_string_with_format(row, column, text, &wrap)?;
        }
    }
    sheet.set_freeze_panes(1, 0)?;
    Ok(())
}

/// An error of rust_xlsxwriter as a problem.
pub(super) fn failed(error: &XlsxError) -> Problem {
    Problem::new(
        ProblemKind::Computation,
        format!("cannot write the workbook: {error}"),
    )
    .hint("write a CSV instead, and please report this defect")
}

/// A table as a workbook: its first sheet, followed by what `more` adds.
///
/// # Errors
/// More rows or cells than a workbook can hold, or a text that is too long for a cell.
pub(super) fn xlsx(
    table: &Table,
    more: impl FnOnce(&mut Workbook) -> Result<(), XlsxError>,
) -> Result<Vec<u8>, Problem> {
    check(table)?;
    let make = || -> Result<Vec<u8>, XlsxError> {
        let mut workbook = workbook("Inventory")?;
        fill(workbook.add_worksheet().set_name(SHEET)?, table)?;
        more(&mut workbook)?;
        workbook.save_to_buffer()
    };
    make().map_err(|error| failed(&error))
}

fn check(table: &Table) -> Result<(), Problem> {
    let refused = |message: String| {
        Err(Problem::value(
            message,
            "write a CSV instead (`to = \"csv\"`)",
        ))
    };
    if table.rows.len() >= MAX_ROWS as usize {
        return refused(format!(
            "{} rows and their headings do not fit into a sheet",
            table.rows.len()
        ));
    }
    let cells: usize = table.rows.iter().map(Vec::len).sum();
    if cells > MAX_CELLS {
        return refused(format!(
            "{cells} cells are more than the limit of {MAX_CELLS} for a workbook"
        ));
    }
    let is_long = |cell: &Written| matches!(cell, Written::Text(text) if text.chars().count() > MAX_CELL_CHARS);
    match table.rows.iter().position(|row| row.iter().any(is_long)) {
        Some(row) => refused(format!(
            "a cell of row {} has more than {MAX_CELL_CHARS} characters",
            row + 2
        )),
        None => Ok(()),
    }
}

/// The format of the cells of a column.
fn number_format(heading_text: &str) -> Option<Format> {
    let found = meaning(heading_text)?;
    let format = match found.column.spec().holds {
        _ if found.column == Column::Accepted && found.unit == HeadingUnit::None => "0.##%",
        Holds::Quantity(Dimension::Ratio) => "0.00##",
        Holds::Quantity(_) => "0.######",
        Holds::Count => "0",
        Holds::Text
        | Holds::Rating
        | Holds::Range
        | Holds::Answer
        | Holds::Casters
        | Holds::Sizes => "@",
    };
    Some(Format::new().set_num_format(format))
}

fn fill(sheet: &mut Worksheet, table: &Table) -> Result<(), XlsxError> {
    let header = wrapped()
        .set_bold()
        .set_border_bottom(FormatBorder::Thin)
        .set_background_color(HEADER_COLOR);
    let rows = u32::try_from(table.rows.len()).unwrap_or(MAX_ROWS);
    for (column, text) in (0u16..).zip(&table.headings) {
        sheet.write_string_with_format(0, column, text, &header)?;
        if let Some(format) = number_format(text) {
            sheet.set_column_format(column, &format)?;
        }
        sheet.set_column_width(column, width(table, column))?;
        if let Some(ours) = meaning(text).map(|found| found.column)
            && ours.spec().holds == Holds::Rating
        {
            let list = DataValidation::new()
                .allow_list_strings(&["H", "M", "L"])?
                .set_input_title(ours.name())?
                .set_input_message("High, medium or low; empty if not rated")?;
            let last = (rows + ROWS_TO_COME).min(MAX_ROWS - 1);
            sheet.add_data_validation(1, column, last, column, &list)?;
        }
    }
    sheet.set_row_height(0, 32)?;
    sheet.set_freeze_panes(1, 0)?;
    let formats: Vec<Option<Format>> = table
        .headings
        .iter()
        .map(|text| number_format(text))
        .collect();
    for (row, cells) in (1u32..).zip(&table.rows) {
        for ((column, cell), format) in (0u16..)
            .zip(cells)
            .zip(formats.iter().chain(std::iter::repeat(&None)))
        {
            // Never with a method that guesses the type: text that begins with = stays text.
            match (cell, format) {
                (Written::Empty, _) => continue,
                (Written::Number(value), Some(format)) => {
                    sheet.write_number_with_format(row, column, *value, format)?
                }
                (Written::Number(value), None) => sheet.write_number(row, column, *value)?,
                (Written::Text(text), Some(format)) => {
                    sheet.write_string_with_format(row, column, text, format)?
                }
                (Written::Text(text), None) => sheet.write_string(row, column, text)?,
            };
        }
    }
    Ok(())
}

/// Width for the heading and the first rows, in characters.
fn width(table: &Table, column: u16) -> u32 {
    let index = usize::from(column);
    let heading = table
        .headings
        .get(index)
        .map_or(0, |text| text.chars().count() / 2 + 4);
    let cells = table
        .rows
        .iter()
        .take(100)
        .filter_map(|row| match row.get(index)? {
            Written::Text(text) => Some(text.chars().count() + 2),
            Written::Number(value) => Some(format!("{value}").len() + 2),
            Written::Empty => None,
        });
    cells.fold(heading, usize::max).clamp(8, 48) as u32
}
