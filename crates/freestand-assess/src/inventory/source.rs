//! The file of an inventory: finding its sheet and headings, and reading its rows.

use std::path::Path;

use freestand_input::file::load_up_to;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::shorten;

use super::cell::{Flow, Row};
use super::header::{self, Header, SEARCHED_ROWS, required_names};
use super::workbook::{Formulas, Merges, Workbook};
use super::{csv_file, encoding};

/// Largest file \[bytes\].
const MAX_BYTES: u64 = 512 << 20;

/// What separates the cells of a CSV.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

const TEMPLATE: &str = "freestand inventory template writes one to fill in";

/// An open file.
pub(super) struct Source {
    content: Content,
    /// The sheet, of a workbook.
    pub(super) sheet: Option<String>,
    /// The headings.
    pub(super) header: Header,
    /// Warnings.
    pub(super) warnings: Vec<String>,
}

enum Content {
    Csv { text: String, separator: u8 },
    Workbook(Box<Workbook>),
}

/// The bytes of an inventory.
///
/// # Errors
/// A file that cannot be read, or is larger than 512 MB.
pub(super) fn load(path: &Path) -> Result<Vec<u8>, Problem> {
    load_up_to(
        path,
        MAX_BYTES,
        "is larger than 512 MB, too large for an inventory",
        "split it into one file for each building",
    )
}

impl Source {
    /// Recognises the format by the content, and finds the sheet and its headings.
    ///
    /// # Errors
    /// A file that is neither CSV nor XLSX, or a sheet or headings that are not found.
    pub(super) fn open(bytes: Vec<u8>, sheet: Option<&str>) -> Result<Self, Problem> {
        if bytes.starts_with(b"PK") {
            return Self::open_workbook(bytes, sheet);
        }
        if bytes.starts_with(b"\xD0\xCF\x11\xE0") {
            return Err(Problem::new(ProblemKind::Format, "is an old workbook (.xls), or one with a password")
                .hint("save it as .xlsx without a password, or as CSV"));
        }
        if let Some(sheet) = sheet {
            return Err(Problem::new(ProblemKind::Value, format!("a CSV has no sheet \"{}\"", shorten(sheet)))
                .hint("remove `sheet`, or give a workbook (.xlsx)"));
        }
        Self::open_csv(bytes)
    }

    fn open_csv(bytes: Vec<u8>) -> Result<Self, Problem> {
        let (text, warning) = encoding::decode(bytes)?;
        let mut failure = None;
        let mut best: Option<(Header, u8)> = None;
        for separator in SEPARATORS {
            let mut rows = Vec::new();
            let read = csv_file::rows(&text, separator, &mut |row| keep(&mut rows, row));
            let found = header::find(&rows);
            if let (Err(problem), None) = (read, &failure) {
                failure = Some(problem);
            }
            if let Some(found) = found
                && best.as_ref().is_none_or(|(other, _)| other.known < found.known)
            {
                best = Some((found, separator));
            }
        }
        // A quote that is not closed hides the headings and everything else.
        let (header, separator) = best.ok_or_else(|| failure.unwrap_or_else(no_headings))?;
        Ok(Self { content: Content::Csv { text, separator }, sheet: None, header, warnings: Vec::from_iter(warning) })
    }

    fn open_workbook(bytes: Vec<u8>, wanted: Option<&str>) -> Result<Self, Problem> {
        let mut workbook = Workbook::open(bytes)?;
        let sheets = workbook.sheets();
        let listed = || {
            let names: Vec<String> = sheets.iter().take(10).map(|(name, _)| format!("\"{}\"", shorten(name))).collect();
            names.join(", ")
        };
        if let Some(wanted) = wanted {
            let Some((name, _)) = sheets.iter().find(|(name, _)| name.trim().eq_ignore_ascii_case(wanted.trim()))
            else {
                let message = format!("the workbook has no sheet \"{}\"", shorten(wanted));
                return Err(Problem::value(message, format!("its sheets: {}", listed())));
            };
            let header = find_in(&mut workbook, name)?.ok_or_else(|| {
                let mut problem = no_headings();
                problem.message = format!("sheet \"{}\": {}", shorten(name), problem.message);
                problem
            })?;
            return Ok(Self::of(workbook, name, header, Vec::new()));
        }
        let mut found: Option<(String, Header)> = None;
        let mut others = Vec::new();
        let mut hidden = Vec::new();
        for (name, is_visible) in &sheets {
            let Some(header) = find_in(&mut workbook, name)? else { continue };
            match &found {
                _ if !is_visible => hidden.push(format!("\"{}\"", shorten(name))),
                None => found = Some((name.clone(), header)),
                Some(_) => others.push(format!("\"{}\"", shorten(name))),
            }
        }
        let Some((name, header)) = found else {
            if let Some(name) = hidden.first() {
                let message = format!("only the hidden sheet {name} has the headings of an inventory");
                return Err(Problem::new(ProblemKind::Format, message).hint("name it with `sheet`, or unhide it"));
            }
            return Err(no_headings().hint(format!("sheets: {}; {TEMPLATE}", listed())));
        };
        let mut warnings = Vec::new();
        if !others.is_empty() {
            warnings.push(format!(
                "the sheet \"{}\" was read; other sheets also look like inventories: {}; to read one, name it with \
                 `sheet`",
                shorten(&name),
                others.join(", ")
            ));
        }
        Ok(Self::of(workbook, &name, header, warnings))
    }

    fn of(workbook: Workbook, sheet: &str, header: Header, warnings: Vec<String>) -> Self {
        Self { content: Content::Workbook(Box::new(workbook)), sheet: Some(sheet.to_owned()), header, warnings }
    }

    /// A warning about rows above the headings.
    pub(super) fn title_warning(&self) -> Option<String> {
        let sheet = self.sheet.as_ref().map(|sheet| format!("sheet \"{}\", ", shorten(sheet))).unwrap_or_default();
        let rows = match self.header.above {
            0 => return None,
            1 => "the row above them is".to_owned(),
            count => format!("the {count} rows above them are"),
        };
        Some(format!("{sheet}the headings are in row {}; {rows} ignored", self.header.row))
    }

    /// Whether a comma may be the decimal sign, because it does not separate cells.
    pub(super) fn has_decimal_comma(&self) -> bool {
        matches!(self.content, Content::Csv { separator, .. } if separator != b',')
    }

    /// Passes the rows below the headings to `on_row`.
    ///
    /// # Errors
    /// A file that is damaged further down.
    pub(super) fn rows(&mut self, on_row: &mut dyn FnMut(Row) -> Flow) -> Result<Formulas, Problem> {
        let last = self.header.last_row;
        let mut below = |row: Row| if row.number > last && !row.is_blank() { on_row(row) } else { Flow::More };
        match (&mut self.content, &self.sheet) {
            (Content::Csv { text, separator }, _) => {
                csv_file::rows(text, *separator, &mut below).map(|()| Formulas::default())
            }
            (Content::Workbook(workbook), Some(sheet)) => workbook.rows(sheet, &mut below),
            (Content::Workbook(_), None) => Ok(Formulas::default()),
        }
    }

    /// The merged cells of the sheet; a CSV has none.
    ///
    /// # Errors
    /// A sheet that cannot be read.
    pub(super) fn merges(&mut self) -> Result<Merges, Problem> {
        match (&mut self.content, &self.sheet) {
            (Content::Workbook(workbook), Some(sheet)) => workbook.merges(sheet),
            _ => Ok(Merges::default()),
        }
    }
}

fn keep(rows: &mut Vec<Row>, row: Row) -> Flow {
    if !row.is_blank() {
        rows.push(row);
    }
    if rows.len() < SEARCHED_ROWS { Flow::More } else { Flow::Enough }
}

fn find_in(workbook: &mut Workbook, sheet: &str) -> Result<Option<Header>, Problem> {
    let mut rows = Vec::new();
    workbook.rows(sheet, &mut |row| keep(&mut rows, row))?;
    Ok(header::find(&rows))
}

fn no_headings() -> Problem {
    let message = format!("the first {SEARCHED_ROWS} rows contain no row of headings");
    let hint = format!("an inventory needs at least the columns {}; {TEMPLATE}", required_names());
    Problem::new(ProblemKind::Format, message).hint(hint)
}
