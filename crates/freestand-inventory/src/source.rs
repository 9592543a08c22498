//! The file of an inventory: finding its sheet and headings, and reading its rows.

use std::path::Path;

use freestand_input::file::load_up_to;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use super::archive::Hidden;
use super::cell::{Flow, Row};
use super::layout::{Header, SEARCHED_ROWS, find_header};
use super::mapping::Mapping;
use super::problems::bad_file;
use super::workbook::{Formulas, Merges, Workbook};
use super::{csv_file, encoding, workbook};

/// Largest file \[bytes\].
const MAX_BYTES: u64 = 512 << 20;
/// Largest number of cells of a CSV that are held in memory.
const MAX_CELLS: usize = 25_000_000;

/// What separates the cells of a CSV.
const SEPARATORS: [u8; 4] = [b',', b';', b'\t', b'|'];

const TEMPLATE: &str = "freestand inventory template writes one to fill in";

/// A sheet as the file has it, and its headings.
#[derive(Debug)]
pub(super) struct Sheet {
    /// Its name, in a workbook.
    pub name: Option<String>,
    /// The rows that are not empty, in order.
    pub rows: Vec<Row>,
    pub merges: Merges,
    pub header: Header,
    /// What separates the cells, in a CSV.
    pub separator: Option<u8>,
    pub formulas: Formulas,
    /// What a spreadsheet does not show.
    pub hidden: Hidden,
    pub warnings: Vec<String>,
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

/// The first rows of a list, whatever its headings are: of the sheet, or with the separator, that gives most
/// headings of an inventory, or else most cells.
///
/// # Errors
/// A file that is neither CSV nor XLSX.
pub(super) fn first_rows(bytes: Vec<u8>, sheet: Option<&str>) -> Result<Vec<Row>, Problem> {
    let mut found: Vec<Vec<Row>> = Vec::new();
    if bytes.starts_with(b"PK") {
        let mut workbook = Workbook::open(bytes)?;
        let sheets = workbook.sheets();
        if let Some(wanted) = sheet
            && !sheets.iter().any(|(name, _)| is_named(name, wanted))
        {
            return Err(no_sheet(wanted, &sheets));
        }
        for (name, is_visible) in sheets {
            if sheet.map_or(is_visible, |wanted| is_named(&name, wanted)) {
                let mut rows = Vec::new();
                workbook.rows(&name, &mut |row| keep(&mut rows, row))?;
                found.push(rows);
            }
        }
    } else {
        refuse_sheet_of_csv(sheet)?;
        let (text, _) = encoding::decode(bytes)?;
        for separator in SEPARATORS {
            let mut rows = Vec::new();
            // With a wrong separator the quotes may be wrong, too.
            if csv_file::rows(&text, separator, &mut |row| keep(&mut rows, row)).is_ok() {
                found.push(rows);
            }
        }
    }
    let known_and_cells = |rows: &Vec<Row>| {
        let known = find_header(rows, None).map_or(0, |header| header.known);
        let cells = rows.iter().map(|row| row.cells.len()).sum::<usize>();
        (known, cells)
    };
    let best = found.into_iter().max_by_key(known_and_cells);
    Ok(best.unwrap_or_default())
}

/// Refuses a sheet that is named of a CSV.
fn refuse_sheet_of_csv(sheet: Option<&str>) -> Result<(), Problem> {
    let Some(sheet) = sheet else { return Ok(()) };
    Err(Problem::value(
        format!("a CSV has no sheet \"{}\"", shorten(sheet)),
        "remove `sheet`, or give a workbook (.xlsx)",
    ))
}

/// The problem of a workbook without the sheet that is named.
fn no_sheet(wanted: &str, sheets: &[(String, bool)]) -> Problem {
    let message = format!("the workbook has no sheet \"{}\"", shorten(wanted));
    Problem::value(message, format!("its sheets: {}", listed(sheets)))
}

/// The names of sheets.
fn listed(sheets: &[(String, bool)]) -> String {
    quoted(sheets.iter().take(10).map(|(name, _)| name))
}

impl Sheet {
    /// Recognises the format by the content, finds the sheet and its headings, and reads it.
    ///
    /// # Errors
    /// A file that is neither CSV nor XLSX, a sheet or headings that are not found, or more cells
    /// than a list has.
    pub(super) fn open(
        bytes: Vec<u8>,
        sheet: Option<&str>,
        mapping: Option<&Mapping>,
    ) -> Result<Self, Problem> {
        if bytes.starts_with(b"PK") {
            return Self::open_workbook(bytes, sheet, mapping);
        }
        if bytes.starts_with(b"\xD0\xCF\x11\xE0") {
            return Err(bad_file(
                "is an old workbook (.xls), or one with a password",
                "save it as .xlsx without a password, or as CSV",
            ));
        }
        refuse_sheet_of_csv(sheet)?;
        Self::open_csv(bytes, mapping)
    }

    fn open_csv(bytes: Vec<u8>, mapping: Option<&Mapping>) -> Result<Self, Problem> {
        let (text, warning) = encoding::decode(bytes)?;
        let mut failure = None;
        let mut best: Option<(Header, u8)> = None;
        for separator in SEPARATORS {
            let mut rows = Vec::new();
            let read = csv_file::rows(&text, separator, &mut |row| keep(&mut rows, row));
            let found = find_header(&rows, mapping);
            if let (Err(problem), None) = (read, &failure) {
                failure = Some(problem);
            }
            if let Some(found) = found
                && best
                    .as_ref()
                    .is_none_or(|(other, _)| other.known < found.known)
            {
                best = Some((found, separator));
            }
        }
        // A quote that is not closed hides the headings and everything else.
        let (header, separator) = best.ok_or_else(|| failure.unwrap_or_else(no_headings))?;
        let mut all = Collected::up_to(MAX_CELLS);
        csv_file::rows(&text, separator, &mut |row| all.take(row))?;
        let rows = all.finish()?;
        Ok(Self {
            name: None,
            rows,
            merges: Merges::default(),
            header,
            separator: Some(separator),
            formulas: Formulas::default(),
            hidden: Hidden::default(),
            warnings: Vec::from_iter(warning),
        })
    }

    fn open_workbook(
        bytes: Vec<u8>,
        wanted: Option<&str>,
        mapping: Option<&Mapping>,
    ) -> Result<Self, Problem> {
        let mut workbook = Workbook::open(bytes)?;
        let sheets = workbook.sheets();
        if let Some(wanted) = wanted {
            let Some((name, _)) = sheets.iter().find(|(name, _)| is_named(name, wanted)) else {
                return Err(no_sheet(wanted, &sheets));
            };
            let header = find_in(&mut workbook, name, mapping)?.ok_or_else(|| {
                let mut problem = no_headings();
                problem.message = format!("sheet \"{}\": {}", shorten(name), problem.message);
                problem
            })?;
            return Self::of(&mut workbook, name, header, Vec::new());
        }
        let mut found: Vec<(String, Header)> = Vec::new();
        let mut hidden = Vec::new();
        for (name, is_visible) in &sheets {
            let Some(header) = find_in(&mut workbook, name, mapping)? else {
                continue;
            };
            if *is_visible {
                found.push((name.clone(), header));
            } else {
                hidden.push(format!("\"{}\"", shorten(name)));
            }
        }
        let most = found.iter().map(|(_, header)| header.known).max();
        // The first one: an archive behind it may have more columns.
        let best = most.and_then(|most| {
            found
                .iter()
                .position(|(_, header)| 3 * header.known >= 2 * most)
        });
        let Some(best) = best else {
            if let Some(name) = hidden.first() {
                let message =
                    format!("only the hidden sheet {name} has the headings of an inventory");
                return Err(bad_file(message, "name it with `sheet`, or unhide it"));
            }
            return Err(no_headings().hint(format!("sheets: {}; {TEMPLATE}", listed(&sheets))));
        };
        let (name, header) = found.swap_remove(best);
        let others = quoted(found.iter().map(|(name, _)| name));
        let mut warnings = Vec::new();
        if !others.is_empty() {
            let name = shorten(&name);
            warnings.push(format!(
                "the sheet \"{name}\" was read; other sheets also look like inventories: {others}; to read one, name \
                 it with `sheet`"
            ));
        }
        Self::of(&mut workbook, &name, header, warnings)
    }

    fn of(
        workbook: &mut Workbook,
        name: &str,
        header: Header,
        warnings: Vec<String>,
    ) -> Result<Self, Problem> {
        let mut all = Collected::up_to(workbook::MAX_CELLS);
        let formulas = workbook.rows(name, &mut |row| all.take(row))?;
        let rows = all.finish()?;
        let merges = workbook.merges(name)?;
        let hidden = workbook.hidden(name);
        Ok(Self {
            name: Some(name.to_owned()),
            rows,
            merges,
            header,
            separator: None,
            formulas,
            hidden,
            warnings,
        })
    }

    /// A warning about rows above the headings.
    pub(super) fn title_warning(&self) -> Option<String> {
        let sheet = self
            .name
            .as_ref()
            .map(|sheet| format!("sheet \"{}\", ", shorten(sheet)))
            .unwrap_or_default();
        let rows = match self.header.above {
            0 => return None,
            1 => "the row above them is".to_owned(),
            count => format!("the {count} rows above them are"),
        };
        Some(format!(
            "{sheet}the headings are in row {}; {rows} not part of the list",
            self.header.row
        ))
    }
}

/// Names of sheets in quotation marks.
fn quoted<'n>(names: impl Iterator<Item = &'n String>) -> String {
    let quoted: Vec<String> = names.map(|name| format!("\"{}\"", shorten(name))).collect();
    quoted.join(", ")
}

fn is_named(name: &str, wanted: &str) -> bool {
    name.trim().eq_ignore_ascii_case(wanted.trim())
}

/// Rows that are not empty, up to a number of cells.
struct Collected {
    rows: Vec<Row>,
    cells: usize,
    most: usize,
}

impl Collected {
    fn up_to(most: usize) -> Self {
        Self {
            rows: Vec::new(),
            cells: 0,
            most,
        }
    }

    fn take(&mut self, row: Row) -> Flow {
        if row.is_blank() {
            return Flow::More;
        }
        self.cells += row.cells.len();
        self.rows.push(row);
        if self.cells > self.most {
            Flow::Enough
        } else {
            Flow::More
        }
    }

    fn finish(self) -> Result<Vec<Row>, Problem> {
        if self.cells > self.most {
            let message = format!(
                "the sheet has more than {} cells, too many for an inventory",
                self.most
            );
            return Err(bad_file(
                message,
                "split it into one file for each building",
            ));
        }
        Ok(self.rows)
    }
}

fn keep(rows: &mut Vec<Row>, row: Row) -> Flow {
    if !row.is_blank() {
        rows.push(row);
    }
    if rows.len() < SEARCHED_ROWS + 2 {
        Flow::More
    } else {
        Flow::Enough
    }
}

fn find_in(
    workbook: &mut Workbook,
    sheet: &str,
    mapping: Option<&Mapping>,
) -> Result<Option<Header>, Problem> {
    let mut rows = Vec::new();
    workbook.rows(sheet, &mut |row| keep(&mut rows, row))?;
    Ok(find_header(&rows, mapping))
}

fn no_headings() -> Problem {
    let message = format!("the first {SEARCHED_ROWS} rows contain no row of headings");
    let hint = format!(
        "a list needs at least three headings that are known, such as id, item, height; {TEMPLATE}; a mapping file \
         (`columns`) says what other headings mean"
    );
    bad_file(message, hint)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cell::Cell;

    /// Reading stops where there are too many cells, and not before.
    #[test]
    fn cells_are_counted() {
        let row = |number| Row {
            number,
            line: None,
            cells: vec![
                (0, Cell::Text("a".to_owned())),
                (1, Cell::Text("b".to_owned())),
            ],
            width: None,
        };
        let mut all = Collected::up_to(4);
        assert!(matches!(all.take(row(1)), Flow::More) && matches!(all.take(row(2)), Flow::More));
        assert!(matches!(all.take(row(3)), Flow::Enough));
        let problem = all.finish().unwrap_err();
        assert!(problem.message.contains("more than 4 cells"), "{problem:?}");
    }
}
