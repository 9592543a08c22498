//! The headings of an inventory: where they are, and what they mean.

use std::collections::BTreeMap;

use freestand_input::quantity::{Dimension, Unit, lookup};

use super::cell::{Cell, Row};
use super::columns::{COLUMNS, Column, Heading, Holds, canonical, heading};

/// Number of rows, empty ones not counted, that are searched for headings.
pub(super) const SEARCHED_ROWS: usize = 100;

/// Smallest number of known columns in a row of headings.
const MIN_COLUMNS: usize = 2;

/// The headings as they are in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// The first row of headings.
    pub(super) row: u32,
    /// The last row before the objects: a second row of headings, or a row of units.
    pub(super) last_row: u32,
    /// Line of the first row, where the file has lines.
    pub(super) line: Option<usize>,
    /// Every heading, by its column.
    pub(super) headings: BTreeMap<u32, String>,
    /// Units from a row of their own.
    pub(super) units: BTreeMap<u32, &'static Unit>,
    /// Number of known columns.
    pub(super) known: usize,
    /// Number of rows above that are not empty.
    pub(super) above: usize,
    /// Number of cells in the row of headings, where the file says so; the last may be empty.
    pub(super) width: Option<u32>,
}

/// Finds the headings among the first rows of a sheet: the row with the most known names.
pub(super) fn find(rows: &[Row]) -> Option<Header> {
    let known: Vec<usize> = rows.iter().map(|row| ours(row).len()).collect();
    let most = known.iter().copied().max().filter(|&most| most >= MIN_COLUMNS)?;
    let at = known.iter().position(|&count| count == most)?;
    let main = rows.get(at)?;
    let mut headings = texts(main);
    let mut header = Header {
        row: main.number,
        last_row: main.number,
        line: main.line,
        headings: BTreeMap::new(),
        units: BTreeMap::new(),
        known: 0,
        above: at,
        width: main.width,
    };
    // Some forms have "Location" above "building, floor, room", and "Risk" above "LS, PL, FL".
    let above = at.checked_sub(1).and_then(|above| rows.get(above)).filter(|row| row.number + 1 == main.number);
    if let Some(above) = above {
        let more = texts(above).into_iter().filter(|(column, text)| is_ours(text) && !headings.contains_key(column));
        let more: Vec<(u32, String)> = more.collect();
        if !more.is_empty() {
            header.row = above.number;
            header.line = above.line;
            header.above = at - 1;
            headings.extend(more);
        }
    }
    let mut next = rows.get(at + 1).filter(|row| row.number == main.number + 1);
    if let Some(below) = next.filter(|row| is_second_row(row)) {
        header.last_row = below.number;
        headings.extend(texts(below));
        next = rows.get(at + 2).filter(|row| row.number == below.number + 1);
    }
    if let Some((row, units)) = next.and_then(|row| Some((row, units(row, &headings)?))) {
        header.last_row = row.number;
        header.units = units;
    }
    header.known = headings.values().filter(|text| is_ours(text)).count();
    header.headings = headings;
    Some(header)
}

fn texts(row: &Row) -> BTreeMap<u32, String> {
    let cells = row.cells.iter().filter(|(_, cell)| !cell.is_blank());
    cells.map(|(column, cell)| (*column, cell.shown().trim().to_owned())).filter(|(_, text)| !text.is_empty()).collect()
}

fn is_ours(text: &str) -> bool {
    !matches!(heading(text), Heading::Other)
}

/// The different known columns that a row names.
fn ours(row: &Row) -> Vec<Column> {
    let mut found: Vec<Column> = Vec::new();
    for (_, cell) in &row.cells {
        if let Cell::Text(text) = cell
            && let Heading::Ours(column, _) | Heading::BadUnit(column, _) = heading(text)
            && !found.contains(&column)
        {
            found.push(column);
        }
    }
    found
}

/// Whether a row below the headings contains only names of columns.
fn is_second_row(row: &Row) -> bool {
    let texts = texts(row);
    texts.len() >= MIN_COLUMNS && texts.values().all(|text| is_ours(text))
}

/// The units of a row that contains nothing else, except for the word "units".
fn units(row: &Row, headings: &BTreeMap<u32, String>) -> Option<BTreeMap<u32, &'static Unit>> {
    let mut found = BTreeMap::new();
    for (column, text) in texts(row) {
        let bare = text.trim_matches(['[', ']', '(', ')']).trim();
        let expected = headings.get(&column).and_then(|text| match heading(text) {
            Heading::Ours(column, None) => Some(column.spec().holds),
            _ => None,
        });
        match (expected, lookup(bare)) {
            (Some(Holds::Quantity(dimension)), Some(unit)) if unit.dimension == dimension => {
                found.insert(column, unit);
            }
            _ if matches!(canonical(bare).as_str(), "" | "unit" | "units") => {}
            _ => return None,
        }
    }
    let is_any = found.values().any(|unit| unit.dimension != Dimension::Ratio);
    is_any.then_some(found)
}

/// The names of the required columns, for hints.
pub(super) fn required_names() -> String {
    let names: Vec<&str> = COLUMNS.iter().filter(|spec| spec.is_required).map(|spec| spec.name).collect();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(lines: &[&str]) -> Vec<Row> {
        let row = |(number, line): (usize, &&str)| {
            let cells = line.split(',').enumerate().filter(|(_, text)| !text.is_empty());
            let cells = cells.map(|(column, text)| (column as u32, Cell::Text(text.to_owned()))).collect();
            Row { number: number as u32 + 1, line: None, cells, width: None }
        };
        lines.iter().enumerate().map(row).filter(|row| !row.is_blank()).collect()
    }

    #[test]
    fn headings_are_found_below_titles() {
        let found =
            find(&rows(&["Inventory of the item store", "", "Priority: 1 high", "id,item,height [mm],maker", "a,b,1"]));
        let found = found.unwrap();
        assert_eq!((found.row, found.last_row, found.known, found.above), (4, 4, 3, 2));
        assert_eq!(found.headings[&3], "maker");
        assert_eq!(find(&rows(&["a,b,c", "1,2,3"])), None);
    }

    #[test]
    fn a_form_with_two_rows_of_headings() {
        // As in FEMA E-74: groups above, their parts below.
        for lines in [
            [
                "Priority,Nonstructural Item,Location,,,Quantity,Risk,,",
                ",,building,floor,room,,LS,PL,FL",
                "1,rack,A,2,3,1,H,M,L",
            ],
            ["Priority,Nonstructural Item,,,,Quantity,,,", ",,building,floor,room,,LS,PL,FL", "1,rack,A,2,3,1,H,M,L"],
        ] {
            let found = find(&rows(&lines)).unwrap();
            assert_eq!((found.row, found.last_row, found.known), (1, 2, 9), "{found:?}");
            assert_eq!((found.headings[&2].as_str(), found.headings[&1].as_str()), ("building", "Nonstructural Item"));
        }
    }

    #[test]
    fn units_may_have_a_row_of_their_own() {
        let found = find(&rows(&["item,height,mass,level_ratio,x", "Units,mm,[kg],-,", "rack,1800,140,1,2"])).unwrap();
        assert_eq!(found.last_row, 2);
        assert_eq!(
            found.units.iter().map(|(column, unit)| (*column, unit.symbol)).collect::<Vec<_>>(),
            [(1, "mm"), (2, "kg")]
        );
        let found = find(&rows(&["item,height,mass", "kg,mm,mm"])).unwrap();
        assert!(found.units.is_empty());
    }
}
