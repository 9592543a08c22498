//! `restraint.xlsx`: all objects of a list in one table, in the units of the person who reads it, and what
//! there is to know beside them. Text is written as text: no cell of a list becomes a formula.

use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::UnitSystem;
use rust_xlsxwriter::{
    DocProperties, ExcelDateTime, Format, FormatAlign, FormatBorder, Workbook, Worksheet, XlsxError,
};

use super::list::{ListRow, RestrainListReport};
use super::words::DESIGN_CAPACITY;

/// Characters of a text, which a cell holds in every script; the CSV has all of it.
const MAX_TEXT: usize = 16_000;

/// A cell.
enum Cell {
    Text(String),
    Number(Option<f64>),
}

/// What a number of a column is, and so its unit and its format.
#[derive(Clone, Copy)]
enum Kind {
    Text,
    Count,
    Ratio,
    Force,
    Length,
}

/// A column: its heading, its width in characters, what it is, its value in SI.
type Column = (&'static str, f64, Kind, fn(&ListRow) -> Cell);

const COLUMNS: [Column; 22] = [
    ("row", 6.0, Kind::Count, |row| number(Some(row.row as f64))),
    ("id", 14.0, Kind::Text, |row| Cell::Text(row.id.clone())),
    ("item", 30.0, Kind::Text, |row| Cell::Text(row.item.clone())),
    ("quantity", 9.0, Kind::Count, |row| {
        number(Some(row.quantity as f64))
    }),
    ("floor", 10.0, Kind::Text, |row| text(row.floor.as_deref())),
    ("room", 12.0, Kind::Text, |row| text(row.room.as_deref())),
    ("component", 12.0, Kind::Text, |row| text(row.component)),
    ("clause", 20.0, Kind::Text, |row| {
        text(row.clause.as_deref())
    }),
    ("force", 11.0, Kind::Force, |row| number(row.force_n)),
    ("force/weight", 9.0, Kind::Ratio, |row| {
        number(row.force_ratio)
    }),
    ("acts at", 10.0, Kind::Length, |row| {
        number(row.acts_at_height_m)
    }),
    ("tips across", 11.0, Kind::Text, |row| text(row.axis)),
    ("anchor inset", 10.0, Kind::Length, |row| {
        number(row.anchor_inset_m)
    }),
    ("tension along one edge", 12.0, Kind::Force, |row| {
        number(row.anchor_tension_n)
    }),
    ("the same in concrete", 12.0, Kind::Force, |row| {
        number(row.anchor_tension_concrete_n)
    }),
    ("tension of one anchor", 12.0, Kind::Force, |row| {
        number(row.tension_of_each_n)
    }),
    ("of one anchor in concrete", 12.0, Kind::Force, |row| {
        number(row.tension_concrete_of_each_n)
    }),
    ("shear of one anchor", 12.0, Kind::Force, |row| {
        number(row.shear_of_each_n)
    }),
    ("demand/capacity", 11.0, Kind::Ratio, |row| {
        number(row.demand_capacity_ratio)
    }),
    ("or a bracket at", 11.0, Kind::Length, |row| {
        number(row.bracket_height_m)
    }),
    ("force of the bracket", 12.0, Kind::Force, |row| {
        number(row.bracket_force_n)
    }),
    ("why no force", 50.0, Kind::Text, |row| {
        text(row.reason.as_deref())
    }),
];

fn number(value: Option<f64>) -> Cell {
    Cell::Number(value)
}

fn text(text: Option<&str>) -> Cell {
    Cell::Text(text.unwrap_or_default().to_owned())
}

impl Kind {
    /// A value in the unit in which it is shown.
    fn shown(self, value: f64, units: UnitSystem) -> f64 {
        match self {
            Self::Force => units.force_number(value).0,
            Self::Length => units.length_number(value).0,
            Self::Text | Self::Count | Self::Ratio => value,
        }
    }

    fn unit(self, units: UnitSystem) -> Option<&'static str> {
        match self {
            Self::Force => Some(units.force_number(0.0).1),
            Self::Length => Some(units.length_number(0.0).1),
            Self::Text | Self::Count | Self::Ratio => None,
        }
    }

    fn format(self) -> &'static str {
        match self {
            Self::Text | Self::Count => "0",
            Self::Ratio => "0.00#",
            Self::Force => "#,##0",
            Self::Length => "0.0#",
        }
    }
}

/// `restraint.xlsx`.
///
/// # Errors
/// A workbook that cannot be made, as one of more rows than a sheet has.
pub fn restraint_workbook(report: &RestrainListReport) -> Result<Vec<u8>, Problem> {
    written(report).map_err(|error| {
        Problem::new(
            ProblemKind::Io,
            format!("cannot write restraint.xlsx: {error}"),
        )
    })
}

fn written(report: &RestrainListReport) -> Result<Vec<u8>, XlsxError> {
    let mut workbook = Workbook::new();
    // With the date of a clock, two runs would give different files.
    let date = ExcelDateTime::from_ymd(2000, 1, 1)?;
    let properties = DocProperties::new().set_title("Restraints");
    workbook.set_properties(&properties.set_creation_datetime(&date));
    workbook.push_worksheet(objects(report)?);
    workbook.push_worksheet(notes(report)?);
    workbook.save_to_buffer()
}

fn objects(report: &RestrainListReport) -> Result<Worksheet, XlsxError> {
    let units = report.held.units;
    let header = Format::new()
        .set_bold()
        .set_text_wrap()
        .set_align(FormatAlign::Top)
        .set_border_bottom(FormatBorder::Medium)
        .set_background_color(0x00E8_EDF2);
    let mut sheet = Worksheet::new();
    sheet.set_name("Restraints")?;
    sheet.set_freeze_panes(1, 3)?;
    sheet.set_landscape();
    sheet.set_print_fit_to_pages(1, 0);
    sheet.set_repeat_rows(0, 0)?;
    for ((heading, width, kind, _), at) in COLUMNS.iter().zip(0..) {
        let heading = match kind.unit(units) {
            Some(unit) => format!("{heading} [{unit}]"),
            None => (*heading).to_owned(),
        };
        sheet.set_column_width(at, *width)?;
        sheet.write_string_with_format(0, at, heading, &header)?;
    }
    let mut last = 0;
    for (row, line) in report.rows().zip(1..) {
        for ((_, _, kind, value), at) in COLUMNS.iter().zip(0..) {
            match value(&row) {
                Cell::Text(text) if !text.is_empty() => {
                    sheet.write_string(line, at, fitting(&text))?;
                }
                Cell::Number(Some(value)) if value.is_finite() => {
                    let format = Format::new().set_num_format(kind.format());
                    sheet.write_number_with_format(line, at, kind.shown(value, units), &format)?;
                }
                Cell::Text(_) | Cell::Number(_) => {}
            }
        }
        last = line;
    }
    sheet.autofilter(0, 0, last.max(1), COLUMNS.len() as u16 - 1)?;
    Ok(sheet)
}

/// What was assumed, what an engineer must confirm, what is wrong in the list.
fn notes(report: &RestrainListReport) -> Result<Worksheet, XlsxError> {
    let mut sheet = Worksheet::new();
    sheet.set_name("Notes")?;
    sheet.set_column_width(0, 28)?;
    sheet.set_column_width(1, 110)?;
    let confirm = report
        .to_confirm
        .iter()
        .map(|open| match open.value.as_str() {
            "" => open.what.clone(),
            value => format!("{} (used: {value})", open.what),
        });
    let titled = |title: &'static str| move |text: String| (title, KeyStyle::Flag.shown(&text));
    let capacity = report.has_capacity().then(|| DESIGN_CAPACITY.to_owned());
    let lines = report
        .provenance()
        .into_iter()
        .map(titled("hazard"))
        .chain(report.assumptions().into_iter().map(titled("assumed")))
        .chain(capacity.into_iter().map(titled("capacity")))
        .chain(confirm.map(titled("an engineer must confirm")))
        .chain(report.warnings.iter().cloned().map(titled("warning")))
        .chain(report.problems().into_iter().map(titled("in the list")));
    for ((title, text), row) in lines.zip(0..) {
        sheet.write_string(row, 0, title)?;
        sheet.write_string(row, 1, fitting(&text))?;
    }
    Ok(sheet)
}

/// The text as far as a cell holds it, without the two characters that XML cannot hold.
fn fitting(text: &str) -> String {
    text.chars()
        .filter(|letter| !matches!(letter, '\u{fffe}' | '\u{ffff}'))
        .take(MAX_TEXT)
        .collect()
}
