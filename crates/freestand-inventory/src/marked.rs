//! A copy of the list with a note in every cell that is wrong or doubtful, and a sheet of problems.

use std::collections::BTreeMap;
use std::path::Path;

use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use rust_xlsxwriter::{Format, Note, Worksheet, XlsxError};

use super::cell::{Cell, MAX_CELL_CHARS};
use super::problems::{Finding, Severity};
use super::read::ReadOptions;
use super::source::{Sheet, load};
use super::write::{explain, failed, workbook, wrapped};

/// Most cells that are marked; a list with more has the same mistake in every row.
const MAX_MARKED: usize = 50_000;
/// Behind a cell that is wrong.
const RED: &str = "#F8B4B4";
/// Behind a cell that is doubtful.
const YELLOW: &str = "#FFF2A8";
/// Most cells of a list that is copied.
const MAX_COPIED: usize = 4_000_000;

/// The list at `path` as a workbook, as it was, with a note in every cell that `findings` name, red
/// for an error and yellow for a doubt, and a sheet of the problems.
///
/// # Errors
/// A list that cannot be read, or is too large to copy.
pub fn marked_copy(
    path: &Path,
    options: &ReadOptions<'_>,
    findings: &[Finding],
) -> Result<Vec<u8>, Problems> {
    let in_file = |problem: Problem| problem.in_file(path);
    let mut sheet = Sheet::open(load(path)?, options.sheet, options.mapping).map_err(in_file)?;
    sheet.edit(options.edits).map_err(in_file)?;
    let cells: usize = sheet.rows.iter().map(|row| row.cells.len()).sum();
    if cells > MAX_COPIED {
        let message = format!("{cells} cells are too many for a marked copy");
        return Err(in_file(Problem::value(
            message,
            "leave `out` away, and see the problems with `json`",
        ))
        .into());
    }
    Ok(copy(&sheet, findings).map_err(|error| in_file(failed(&error)))?)
}

/// The marks of a cell: the most serious, and all texts.
type Marks = BTreeMap<(u32, u32), (Severity, String)>;

fn copy(sheet: &Sheet, findings: &[Finding]) -> Result<Vec<u8>, XlsxError> {
    let mut marks: Marks = BTreeMap::new();
    for finding in findings {
        let Some(index) = finding.index else { continue };
        let text = format!(
            "{}: {}. {}",
            word(finding),
            KeyStyle::Flag.shown(&finding.message()),
            KeyStyle::Flag.shown(&finding.hint)
        );
        for row in &finding.rows {
            if marks.len() >= MAX_MARKED {
                break;
            }
            marks
                .entry((*row, index))
                .and_modify(|(severity, texts)| {
                    *severity = (*severity).min(finding.severity);
                    texts.push('\n');
                    texts.push_str(&text);
                })
                .or_insert((finding.severity, text.clone()));
        }
    }
    let mut workbook = workbook("Checked inventory")?;
    let name = sheet.name.clone().unwrap_or_else(|| "List".to_owned());
    fill(workbook.add_worksheet().set_name(&name)?, sheet, &marks)?;
    let second = if name.eq_ignore_ascii_case("problems") {
        "Problems found"
    } else {
        "Problems"
    };
    problems(workbook.add_worksheet().set_name(second)?, findings)?;
    workbook.save_to_buffer()
}

/// `Error: unreadable`.
fn word(finding: &Finding) -> String {
    let severity = match finding.severity {
        Severity::Error => "Error",
        Severity::Doubt => "Doubt",
    };
    format!("{severity} ({})", finding.kind.name())
}

fn fill(to: &mut Worksheet, sheet: &Sheet, marks: &Marks) -> Result<(), XlsxError> {
    let bold = wrapped().set_bold();
    let [red, yellow] = [RED, YELLOW].map(|color| Format::new().set_background_color(color));
    let plain = Format::new();
    // What the spreadsheet did not show is struck through.
    let [struck, struck_red, struck_yellow] =
        [&plain, &red, &yellow].map(|format| format.clone().set_font_strikethrough());
    for merged in &sheet.merges.all {
        let (first, last) = merged.rows;
        let (left, right) = merged.columns;
        if let (Ok(left), Ok(right)) = (u16::try_from(left), u16::try_from(right)) {
            let (first, last) = (first.saturating_sub(1), last.saturating_sub(1));
            // Overlaps are refused; the copy then has the cells without that merge.
            let _ = to.merge_range(first, left, last, right, "", &plain);
        }
    }
    for row in &sheet.rows {
        let at = row.number.saturating_sub(1);
        for (column, cell) in &row.cells {
            let Ok(index) = u16::try_from(*column) else {
                continue;
            };
            let mark = marks
                .get(&(row.number, *column))
                .map(|(severity, _)| *severity);
            let is_hidden = sheet.hidden.rows.binary_search(&row.number).is_ok();
            let format = match (mark, is_hidden) {
                (Some(Severity::Error), true) => &struck_red,
                (Some(Severity::Doubt), true) => &struck_yellow,
                (Some(Severity::Error), false) => &red,
                (Some(Severity::Doubt), false) => &yellow,
                (None, true) => &struck,
                (None, false) if row.number == sheet.header.row => &bold,
                (None, false) => &plain,
            };
            match cell {
                Cell::Number(value) => to.write_number_with_format(at, index, *value, format)?,
                Cell::Bool(value) => to.write_boolean_with_format(at, index, *value, format)?,
                Cell::Unevaluated | Cell::TooLong(_) => to.write_blank(at, index, format)?,
                Cell::Text(text) | Cell::Date(text) | Cell::Error(text) => {
                    let text: String = text.chars().take(MAX_CELL_CHARS).collect();
                    to.write_string_with_format(at, index, text, format)?
                }
            };
        }
    }
    // In the order of the sheet: the same list gives the same bytes.
    for ((row, column), (severity, text)) in marks {
        let Ok(index) = u16::try_from(*column) else {
            continue;
        };
        let color = match severity {
            Severity::Error => RED,
            Severity::Doubt => YELLOW,
        };
        let note = Note::new(text.chars().take(2000).collect::<String>())
            .set_author("freestand")
            .set_background_color(color);
        to.insert_note(row.saturating_sub(1), index, &note)?;
    }
    to.set_freeze_panes(sheet.header.last_row, 0)?;
    Ok(())
}

fn problems(to: &mut Worksheet, findings: &[Finding]) -> Result<(), XlsxError> {
    let headings = [
        ("Severity", 10),
        ("Kind", 18),
        ("Column", 24),
        ("Cells", 8),
        ("Where", 30),
        ("Such as", 24),
        ("What", 50),
        ("What to do", 60),
    ];
    let row = |finding: &Finding| {
        let mut places = finding.places();
        let more = if places.len() > 20 { " …" } else { "" };
        places.truncate(20);
        [
            finding.severity.name().to_owned(),
            finding.kind.name().to_owned(),
            finding.heading.as_deref().map(shorten).unwrap_or_default(),
            String::new(),
            format!("{}{more}", places.join(", ")),
            finding.examples.join(" | "),
            KeyStyle::Flag.shown(&finding.message()),
            KeyStyle::Flag.shown(&finding.hint),
        ]
    };
    explain(to, headings, findings.iter().map(row))?;
    let wrap = wrapped();
    for (row, finding) in (1u32..).zip(findings) {
        to.write_number_with_format(row, 3, finding.rows.len() as f64, &wrap)?;
    }
    Ok(())
}
