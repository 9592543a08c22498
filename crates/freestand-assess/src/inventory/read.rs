//! Reading a file into an inventory, or reporting all of its problems.

use std::collections::HashMap;
use std::path::Path;

use crate::library::Lookup;
use freestand_input::file::sha256_hex;
use freestand_input::problem::Problems;
use freestand_input::quantity::shorten;

use super::cell::{Flow, Row};
use super::columns::Column;
use super::findings::{At, Doubt, Findings};
use super::item::{is_total, item};
use super::layout::{ColumnRead, Layout};
use super::source::{Source, load};
use super::values::{Signs, Values};
use super::{Inventory, Item};

/// Largest number of cells that are carried through, over all rows: half a gigabyte if they are
/// empty.
const MAX_CARRIED_CELLS: usize = 20_000_000;

/// An inventory, and how its file was interpreted.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The inventory.
    pub inventory: Inventory,
    /// The columns that freestand reads, in the order of the file.
    pub columns: Vec<ColumnRead>,
    /// The row of the headings, counted from 1.
    pub header_row: u32,
}

/// Reads an inventory from a CSV or a workbook (XLSX), recognised by its content: every quantity in
/// SI, missing values as `None`.
///
/// `sheet` names a sheet of a workbook; without it the first visible sheet with the headings of an
/// inventory is read. The headings may be in any order, each with its unit, and below titles. Other
/// columns are carried through.
///
/// # Accuracy
/// A number in a CSV and the same number in a workbook are the same f64, whatever the unit.
///
/// # Errors
/// All problems of the file at once, up to 200, each with its sheet, row and column and a hint. A
/// file with more than 512 MB, 1,048,576 rows, 16,384 columns or 32,767 characters in a cell, or
/// that unpacks to more than 1 GiB, is refused.
///
/// # Example
/// ```
/// use freestand_assess::inventory::read_inventory;
/// use freestand_assess::library::Lookup;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("objects.csv");
/// std::fs::write(&path, "id,item,level_ratio,height [mm],depth [cm],mass\nA1,cabinet,0.5,2300,60,0.14 t\n")?;
/// let inventory = read_inventory(&path, None, &Lookup::NONE)?;
/// let cabinet = &inventory.items[0];
/// assert_eq!((cabinet.height_m, cabinet.thickness_m, cabinet.mass_kg), (Some(2.3), Some(0.6), Some(140.0)));
/// assert_eq!((cabinet.row, cabinet.tolerance.as_ref()), (2, None));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_inventory(path: &Path, sheet: Option<&str>, lookup: &Lookup<'_>) -> Result<Inventory, Problems> {
    inspect_inventory(path, sheet, lookup).map(|reading| reading.inventory)
}

/// As [`read_inventory`], and reports how the file was interpreted.
///
/// # Errors
/// As [`read_inventory`].
pub fn inspect_inventory(path: &Path, sheet: Option<&str>, lookup: &Lookup<'_>) -> Result<Reading, Problems> {
    parse_inventory(load(path)?, path, sheet, lookup)
}

/// As [`inspect_inventory`], for the bytes of a file; `path` is for messages.
///
/// # Errors
/// As [`read_inventory`].
pub fn parse_inventory(
    bytes: Vec<u8>,
    path: &Path,
    sheet: Option<&str>,
    lookup: &Lookup<'_>,
) -> Result<Reading, Problems> {
    let sha256 = sha256_hex(&bytes);
    let in_file = |problem: freestand_input::problem::Problem| problem.in_file(path);
    let mut source = Source::open(bytes, sheet).map_err(in_file)?;
    let mut findings = Findings::new(path, source.sheet.clone());
    let mut warnings = std::mem::take(&mut source.warnings);
    warnings.extend(source.title_warning());
    let layout = Layout::new(&source.header, &mut findings, &mut warnings);
    let merges = source.merges().map_err(in_file)?;
    let has_decimal_comma = source.has_decimal_comma();
    let mut items: Vec<Item> = Vec::new();
    let (mut signs, mut carried) = (Signs::default(), 0);
    let mut is_full = false;
    let read = source.rows(&mut |row: Row| {
        let mut values = Values {
            row: &row,
            layout: &layout,
            merges: &merges,
            has_decimal_comma,
            signs: &mut signs,
            findings: &mut findings,
        };
        if is_total(&values) {
            values.doubt(Doubt::Totals);
            return Flow::More;
        }
        carried += layout.carried.len();
        is_full = carried > MAX_CARRIED_CELLS;
        if is_full {
            return Flow::Enough;
        }
        items.push(item(&mut values, lookup));
        Flow::More
    });
    match read {
        Ok(formulas) => warnings.extend(formulas.warning()),
        Err(problem) => findings.push(problem),
    }
    if is_full {
        let message = format!("the other columns have more than {MAX_CARRIED_CELLS} cells");
        findings.of_file(None, message, "remove columns that are not needed, or split the file");
    }
    if let Some(row) = signs.mixed() {
        findings.doubt(Doubt::DecimalPoint, row);
    }
    if items.is_empty() && !is_full {
        findings.of_file(source.header.line, "there are no rows below the headings", "put one object into each row");
    }
    find_duplicates(&items, &layout, &mut findings);
    warnings.extend(findings.finish()?);
    let inventory = Inventory {
        libraries: Vec::new(),
        path: path.to_path_buf(),
        sha256,
        sheet: source.sheet,
        carried: layout.carried.clone(),
        items,
        warnings,
    };
    Ok(Reading { inventory, columns: layout.columns(), header_row: source.header.row })
}

/// Reports rows with the same id: no output could tell them apart.
fn find_duplicates(items: &[Item], layout: &Layout, findings: &mut Findings<'_>) {
    let mut seen: HashMap<&str, u32> = HashMap::with_capacity(items.len());
    for item in items {
        let Some(first) = seen.insert(&item.id, item.row) else { continue };
        // The first row keeps the name, however many follow.
        seen.insert(&item.id, first);
        let message = format!("row {first} already has the id \"{}\"", shorten(&item.id));
        let hint = "give every row its own id, or remove the column: then the row number is used";
        // A row may span lines in a CSV: people look for its number.
        let at = At { row: item.row, line: None };
        match layout.place(Column::Id) {
            Some(place) => findings.of_cell(at, place.index, &place.heading, &message, Some(hint.to_owned())),
            None => findings.of_row(at, &message, hint),
        }
    }
}
