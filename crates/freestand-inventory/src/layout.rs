//! Where the headings are, and which rows below them are objects.

use std::collections::BTreeMap;

use super::cell::{Cell, Row};
use super::columns::Column;
use super::headings::{HeadingUnit, Language, Meaning, dimension, letter_meaning, meaning};
use super::mapping::Mapping;
use super::problems::named_rows;
use super::sentence::sentence_unit;
use super::units::{CellUnit, find};
use super::vocabulary::{begins_note, begins_total, is_among, is_missing};
use freestand_input::quantity::Dimension;
use freestand_input::words::canonical;

/// Number of rows, empty ones not counted, that are searched for headings.
pub(super) const SEARCHED_ROWS: usize = 100;

/// The headings as they are in the file.
#[derive(Debug, Clone)]
pub(super) struct Header {
    /// The row with the headings, counted from 1.
    pub row: u32,
    /// The last row before the objects: a second row of headings, or a row of units.
    pub last_row: u32,
    /// Every heading, by its column.
    pub headings: BTreeMap<u32, String>,
    /// What the headings mean, where that is known.
    pub meanings: BTreeMap<u32, Meaning>,
    /// Units of a row of their own, or of a heading above a group.
    pub units: BTreeMap<u32, CellUnit>,
    /// Whether the units are from a row of their own.
    pub has_unit_row: bool,
    /// Number of different known columns.
    pub known: usize,
    /// Number of rows above that are not empty.
    pub above: usize,
    /// Number of cells in the row of headings, where the file says so.
    pub width: Option<u32>,
    /// The first row of what stands above it, after the table before.
    pub first_row: u32,
}

/// Smallest number of known headings; with a size one less.
const MIN_HEADINGS: usize = 3;

pub(super) const SIZES: [Column; 5] = [
    Column::Height,
    Column::Thickness,
    Column::Width,
    Column::Dimensions,
    Column::Diameter,
];

/// Finds the headings among the first rows of a sheet: the row with the most known names.
pub(super) fn find_header(rows: &[Row], mapping: Option<&Mapping>) -> Option<Header> {
    let searched = rows.get(..SEARCHED_ROWS.min(rows.len()))?;
    let known: Vec<usize> = searched
        .iter()
        .map(|row| score(&mapped(row, mapping)))
        .collect();
    let most = known.iter().copied().max().filter(|&most| most > 0)?;
    let at = known.iter().position(|&count| count == most)?;
    header_at(rows, at, mapping)
}

/// The headings in the row at this place, and what belongs to them.
fn header_at(rows: &[Row], at: usize, mapping: Option<&Mapping>) -> Option<Header> {
    let main = rows.get(at)?;
    let mut header = Header {
        row: main.number,
        last_row: main.number,
        headings: texts(main),
        meanings: mapped(main, mapping),
        units: BTreeMap::new(),
        has_unit_row: false,
        known: 0,
        above: at,
        width: main.width,
        first_row: 0,
    };
    // Some forms have "Location" above "building, floor, room", and "Size (mm)" above "H, W, D".
    if let Some(above) = at
        .checked_sub(1)
        .and_then(|at| rows.get(at))
        .filter(|row| row.number + 1 == main.number)
    {
        header.take_group(above);
    }
    let mut next = rows.get(at + 1).filter(|row| row.number == main.number + 1);
    if let Some(below) = next.filter(|row| is_second_row(row, &header)) {
        header.last_row = below.number;
        header.headings.extend(texts(below));
        header.meanings.extend(meanings_of(below));
        next = rows
            .get(at + 2)
            .filter(|row| row.number == below.number + 1);
    }
    if let Some((row, units)) = next.and_then(|row| Some((row, unit_row(row, &header.meanings)?))) {
        header.last_row = row.number;
        header.units.extend(units);
        header.has_unit_row = true;
    }
    header.known = distinct(&header.meanings).len();
    Some(header)
}

impl Header {
    /// Fills gaps in the headings from a row of groups above, and takes the units of its groups.
    fn take_group(&mut self, above: &Row) {
        let groups = texts(above);
        for (column, text) in &groups {
            if !self.headings.contains_key(column)
                && let Some(found) = meaning(text)
            {
                self.headings.insert(*column, text.clone());
                self.meanings.insert(*column, found);
            }
        }
        let lasts: Vec<u32> = groups.keys().copied().skip(1).chain([u32::MAX]).collect();
        for ((first, text), last) in groups.iter().zip(lasts) {
            for (column, found) in self.meanings.range(*first..last) {
                let Some(dimension) =
                    dimension(found.column).filter(|_| found.unit == HeadingUnit::None)
                else {
                    continue;
                };
                let Some(inner) = text.split(['(', '[']).nth(1) else {
                    continue;
                };
                if let Ok(unit) = find(inner.trim_end_matches([')', ']', ' ']), dimension) {
                    self.units.insert(*column, unit);
                }
            }
        }
    }

    /// Adds a heading that the file does not have.
    pub(super) fn add(&mut self, column: u32, text: &str) {
        self.headings.insert(column, text.to_owned());
        self.meanings
            .extend(meaning(text).map(|found| (column, found)));
        self.width = self.width.map(|width| width.max(column + 1));
    }

    /// The heading of a column; empty: it has none.
    pub(super) fn heading(&self, column: u32) -> String {
        self.headings.get(&column).cloned().unwrap_or_default()
    }

    /// The number of known headings in a language.
    pub(super) fn spoken(&self, language: Language) -> usize {
        let all = self.meanings.values();
        all.filter(|found| found.language == language).count()
    }

    /// The unit that the row of units or the group states.
    pub(super) fn unit(&self, column: u32) -> Option<CellUnit> {
        self.units.get(&column).copied()
    }
}

fn texts(row: &Row) -> BTreeMap<u32, String> {
    let cells = row.cells.iter().filter(|(_, cell)| !cell.is_blank());
    cells
        .map(|(column, cell)| (*column, cell.shown().trim().to_owned()))
        .filter(|(_, text)| !text.is_empty())
        .collect()
}

/// What the texts of a row mean as headings.
fn meanings_of(row: &Row) -> BTreeMap<u32, Meaning> {
    let mut found: BTreeMap<u32, Meaning> = BTreeMap::new();
    for (index, cell) in &row.cells {
        if let Cell::Text(text) = cell
            && let Some(meaning) = meaning(text)
        {
            found.insert(*index, meaning);
        }
    }
    // B, T and P are sizes beside other letters for sizes only.
    let has = |column: Column| found.values().any(|meaning| meaning.column == column);
    let is_letter = |index: &u32| matches!(row.get(*index), Some(Cell::Text(text)) if text.chars().take_while(|c| c.is_alphabetic()).count() == 1);
    let sizes = found
        .iter()
        .filter(|(index, meaning)| SIZES.contains(&meaning.column) && is_letter(index))
        .count();
    let letters: Vec<(u32, Meaning)> = row
        .cells
        .iter()
        .filter(|(index, _)| !found.contains_key(index))
        .filter_map(|(index, cell)| match cell {
            Cell::Text(text) => Some((*index, letter_meaning(text)?)),
            _ => None,
        })
        .filter(|(_, meaning)| !has(meaning.column))
        .collect();
    if sizes + letters.len() >= 2 && sizes >= 1 {
        found.extend(letters);
    }
    found
}

/// What the texts of a row mean with a mapping file: its headings are known, too.
fn mapped(row: &Row, mapping: Option<&Mapping>) -> BTreeMap<u32, Meaning> {
    let mut found = meanings_of(row);
    let Some(mapping) = mapping else { return found };
    for (index, text) in texts(row) {
        let Some(one) = mapping.column(&text) else {
            continue;
        };
        found.remove(&index);
        if let Some(column) = one.column {
            found.insert(index, Meaning::mapped(column, one.unit));
        }
    }
    found
}

fn distinct(meanings: &BTreeMap<u32, Meaning>) -> Vec<Column> {
    let mut found: Vec<Column> = Vec::new();
    for meaning in meanings.values() {
        if !found.contains(&meaning.column) {
            found.push(meaning.column);
        }
    }
    found
}

/// The number of known columns of a row, 0 where there are too few for headings.
fn score(meanings: &BTreeMap<u32, Meaning>) -> usize {
    let found = distinct(meanings);
    let has_size = found.iter().any(|column| SIZES.contains(column));
    if found.len() + usize::from(has_size) >= MIN_HEADINGS {
        found.len()
    } else {
        0
    }
}

/// Whether a row below the headings contains only names of columns.
fn is_second_row(row: &Row, header: &Header) -> bool {
    let texts = texts(row);
    let is_new = texts
        .keys()
        .any(|column| !header.meanings.contains_key(column));
    texts.len() >= 2
        && is_new
        && texts
            .values()
            .all(|text| meaning(text).is_some() && text.parse::<f64>().is_err())
}

/// The units of a row that contains nothing else, except for the word "units" and words under
/// columns that are not known.
fn unit_row(row: &Row, meanings: &BTreeMap<u32, Meaning>) -> Option<BTreeMap<u32, CellUnit>> {
    const UNITS: &str = "unit units einheit einheiten unite unites unidad unidades unita 単位";
    let mut found = BTreeMap::new();
    for (column, text) in texts(row) {
        let is_filler = is_missing(&text) || is_among(&canonical(&text), UNITS);
        match meanings.get(&column) {
            Some(meaning) => {
                match dimension(meaning.column).map(|dimension| find(&text, dimension)) {
                    Some(Ok(unit)) => {
                        found.insert(column, unit);
                    }
                    _ if is_filler => {}
                    // "pcs" under a quantity, "text" under a name.
                    _ if is_unit_like(&text) && dimension(meaning.column).is_none() => {}
                    _ => return None,
                }
            }
            None if is_filler || is_unit_like(&text) => {}
            None => return None,
        }
    }
    (!found.is_empty()).then_some(found)
}

/// Whether a text could be a unit of something: short, or in brackets, and without digits.
fn is_unit_like(text: &str) -> bool {
    let is_bracketed = text.starts_with(['(', '[']) && text.ends_with([')', ']']);
    !text.chars().any(|c| c.is_ascii_digit()) && (is_bracketed || text.chars().count() <= 4)
}

/// What a row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum RowKind {
    /// The name of a section of the list.
    Section,
    /// A total of rows above.
    Total,
    /// A remark.
    Note,
    /// The headings again.
    Header,
    /// A row of units.
    Units,
}

/// A row that is not an object.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Its number in the sheet.
    pub row: u32,
    /// What it is.
    pub kind: RowKind,
    /// Its texts.
    pub text: String,
}

/// The rows below the headings.
#[derive(Debug, Default)]
pub(super) struct Body {
    /// Places of the objects in the rows, each with its section.
    pub objects: Vec<(usize, Option<usize>)>,
    /// Names of the sections.
    pub sections: Vec<String>,
    pub left_out: Vec<LeftOut>,
    /// Units that apply to a column from a row on.
    pub units: Vec<(u32, u32, CellUnit)>,
}

impl Body {
    fn leave_out(&mut self, row: &Row, kind: RowKind) {
        self.left_out.push(LeftOut {
            row: row.number,
            kind,
            text: text_of(row),
        });
    }

    /// The rows of the objects.
    pub(super) fn rows<'r>(&self, rows: &'r [Row]) -> impl Iterator<Item = &'r Row> {
        let objects = self.objects.iter();
        objects.filter_map(|(place, _)| rows.get(*place))
    }

    /// Whether a row is not an object.
    pub(super) fn leaves_out(&self, row: &Row) -> bool {
        let found = self
            .left_out
            .binary_search_by_key(&row.number, |left| left.row);
        found.is_ok()
    }
}

/// A table of a sheet: its headings, and the rows below them.
#[derive(Debug)]
pub(super) struct Table {
    pub header: Header,
    pub body: Body,
}

/// Most tables of a sheet.
const MAX_TABLES: usize = 200;

/// The tables of a sheet, one below the other: headings that differ from those above begin another one.
/// With them the row from which nothing is read, because there are too many.
pub(super) fn tables(
    rows: &[Row],
    first: &Header,
    mapping: Option<&Mapping>,
) -> (Vec<Table>, Option<u32>) {
    let mut found = Vec::new();
    let mut header = first.clone();
    loop {
        let (body, other) = body(rows, &header);
        let last = body
            .objects
            .last()
            .and_then(|(place, _)| rows.get(*place))
            .map_or(header.last_row, |row| row.number);
        found.push(Table { header, body });
        let next = other.and_then(|place| header_at(rows, place, mapping));
        match next {
            Some(next) if found.len() < MAX_TABLES => {
                header = Header {
                    first_row: last + 1,
                    ..next
                }
            }
            Some(next) => return (found, Some(next.row)),
            None => return (found, None),
        }
    }
}

/// Tells objects from sections, totals, remarks, and headings that are repeated; and the place of the
/// headings of another table.
pub(super) fn body(rows: &[Row], header: &Header) -> (Body, Option<usize>) {
    let mut body = Body::default();
    let mut other = None;
    if header.has_unit_row
        && let Some(row) = rows.iter().find(|row| row.number == header.last_row)
    {
        body.leave_out(row, RowKind::Units);
    }
    // Whether there are objects below is known from the end.
    let first = rows.partition_point(|row| row.number <= header.last_row);
    let mut kinds: Vec<(usize, Sort)> = Vec::new();
    for (place, row) in rows.iter().enumerate().skip(first) {
        match sort(row, header) {
            Sort::Other => {
                other = Some(place);
                break;
            }
            found => kinds.push((place, found)),
        }
    }
    let last_object = kinds
        .iter()
        .rfind(|(_, sort)| *sort == Sort::Object)
        .map_or(0, |(place, _)| *place);
    let mut section = None;
    for (place, sort) in kinds {
        let Some(row) = rows.get(place) else { continue };
        let kind = match sort {
            Sort::Object => {
                body.objects.push((place, section));
                continue;
            }
            Sort::Lone if place < last_object && !is_note(&text_of(row)) => {
                body.sections
                    .push(text_of(row).trim_end_matches(':').trim().to_owned());
                section = Some(body.sections.len() - 1);
                RowKind::Section
            }
            Sort::Lone | Sort::Other => RowKind::Note,
            Sort::Left(kind) => kind,
        };
        match kind {
            RowKind::Units => {
                let units = unit_row(row, &header.meanings).unwrap_or_default();
                let units = units.into_iter();
                body.units
                    .extend(units.map(|(column, unit)| (row.number, column, unit)));
            }
            // The headings again may state other units.
            RowKind::Header => {
                let stated = |(column, found): (u32, Meaning)| {
                    Some((row.number, column, found.unit.stated()?))
                };
                body.units
                    .extend(meanings_of(row).into_iter().filter_map(stated));
            }
            _ => {}
        }
        body.leave_out(row, kind);
    }
    body.left_out.sort_by_key(|left| left.row);
    (body, other)
}

/// Whether a text alone in its row is a remark, or a sentence about units, rather than the name of a section, which units
/// may follow: "Level 2 (dimensions in mm)".
fn is_note(text: &str) -> bool {
    let first = text.split(['(', ',', ';', ':']).next().unwrap_or_default();
    begins_note(text)
        || [Dimension::Length, Dimension::Mass]
            .into_iter()
            .any(|of| sentence_unit(first, of).is_some())
}

/// What a row is, before it is known whether objects follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sort {
    Object,
    /// A text alone in its row.
    Lone,
    Left(RowKind),
    /// Headings of a table with other columns.
    Other,
}

fn sort(row: &Row, header: &Header) -> Sort {
    let mut filled = row.cells.iter().filter(|(_, cell)| !cell.is_blank());
    let first = filled.next();
    let count = usize::from(first.is_some()) + filled.clone().count();
    if let (1, Some((_, cell))) = (count, first) {
        return match cell {
            Cell::Text(text) if begins_total(text) => Sort::Left(RowKind::Total),
            Cell::Text(text) if text.chars().any(char::is_alphabetic) => Sort::Lone,
            _ => Sort::Left(RowKind::Note),
        };
    }
    // Most rows of a list have a number, and neither headings nor units do.
    let is_word = |cell: &Cell| matches!(cell, Cell::Text(text) if !text.trim_start().starts_with(|c: char| c.is_ascii_digit()));
    if row.cells.iter().all(|(_, cell)| is_word(cell)) {
        if let Some(kind) = header_again(row, header) {
            return kind;
        }
        if unit_row(row, &header.meanings).is_some() {
            return Sort::Left(RowKind::Units);
        }
    }
    if first.is_some_and(|(_, cell)| matches!(cell, Cell::Text(text) if begins_total(text))) {
        let mut sizes = header
            .meanings
            .iter()
            .filter(|(_, meaning)| SIZES.contains(&meaning.column));
        let is_filled = |cell: &Cell| !cell.is_blank() && !is_missing(&cell.shown());
        if !sizes.any(|(index, _)| row.get(*index).is_some_and(is_filled)) {
            return Sort::Left(RowKind::Total);
        }
    }
    let known = row
        .cells
        .iter()
        .filter(|(index, cell)| header.meanings.contains_key(index) && !cell.is_blank())
        .count();
    if known >= 2 {
        Sort::Object
    } else {
        Sort::Left(RowKind::Note)
    }
}

/// Whether a row has the headings again, or those of another table.
fn header_again(row: &Row, header: &Header) -> Option<Sort> {
    let (mut same, mut other) = (0, 0);
    for (index, cell) in &row.cells {
        let Cell::Text(text) = cell else { return None };
        if text.trim().is_empty() {
            continue;
        }
        match header.headings.get(index) {
            Some(heading) if canonical(heading) == canonical(text) => same += 1,
            _ => match (meaning(text), header.meanings.get(index)) {
                (Some(found), Some(known)) if found.column == known.column => same += 1,
                _ => other += 1,
            },
        }
    }
    let here = meanings_of(row);
    // The same headings in another order are those of another table.
    let is_moved = |(index, found): (&u32, &Meaning)| {
        let heading = header.headings.get(index);
        let is_same_text =
            heading.is_some_and(|heading| canonical(heading) == canonical(&row.shown(*index)));
        let known = header.meanings.get(index);
        !is_same_text && known.is_none_or(|known| known.column != found.column)
    };
    let is_another = score(&here) > 0 && here.iter().any(is_moved);
    if same >= 2 && same > other {
        return Some(if is_another {
            Sort::Other
        } else {
            Sort::Left(RowKind::Header)
        });
    }
    let known = distinct(&header.meanings);
    let knows_all = here.values().all(|found| known.contains(&found.column));
    let enough = if knows_all { MIN_HEADINGS } else { 4 };
    let is_other = score(&here) >= enough && here.len() > other / 2;
    is_other.then_some(Sort::Other)
}

/// A warning about formulas without a value in rows that are no objects: they cost nothing.
pub(super) fn unevaluated(rows: &[Row], is_left_out: &dyn Fn(&Row) -> bool) -> Option<String> {
    let is_empty = |row: &&Row| {
        row.cells
            .iter()
            .any(|(_, cell)| matches!(cell, Cell::Unevaluated))
    };
    let found: Vec<u32> = rows
        .iter()
        .filter(is_empty)
        .filter(|row| is_left_out(row))
        .map(|row| row.number)
        .collect();
    let said = "formulas without a value in rows that are no objects are left empty";
    (!found.is_empty()).then(|| format!("{}: {said}", named_rows(&found, found.len())))
}

/// The texts of a row.
fn text_of(row: &Row) -> String {
    let texts: Vec<String> = row
        .cells
        .iter()
        .filter(|(_, cell)| !cell.is_blank())
        .map(|(_, cell)| cell.shown().trim().to_owned())
        .collect();
    texts.join(" | ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(lines: &[&str]) -> Vec<Row> {
        let row = |(number, line): (usize, &&str)| {
            let cells = line
                .split(',')
                .enumerate()
                .filter(|(_, text)| !text.is_empty());
            let cells = cells
                .map(|(column, text)| (column as u32, Cell::Text(text.to_owned())))
                .collect();
            Row {
                number: number as u32 + 1,
                line: None,
                cells,
                width: None,
            }
        };
        lines
            .iter()
            .enumerate()
            .map(row)
            .filter(|row| !row.is_blank())
            .collect()
    }

    #[test]
    fn headings_are_found_below_titles() {
        let found = find_header(
            &rows(&[
                "Inventory of the item store",
                "",
                "Priority: 1 high",
                "id,item,height [mm],maker",
                "a,b,1",
            ]),
            None,
        );
        let found = found.unwrap();
        assert_eq!(
            (found.row, found.last_row, found.known, found.above),
            (4, 4, 3, 2)
        );
        assert_eq!(found.headings[&3], "maker");
        assert!(find_header(&rows(&["a,b,c", "1,2,3"]), None).is_none());
        assert!(
            find_header(&rows(&["id,item"]), None).is_none()
                && find_header(&rows(&["id,height"]), None).is_some()
        );
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
            [
                "Priority,Nonstructural Item,,,,Quantity,,,",
                ",,building,floor,room,,LS,PL,FL",
                "1,rack,A,2,3,1,H,M,L",
            ],
        ] {
            let found = find_header(&rows(&lines), None).unwrap();
            assert_eq!((found.last_row, found.known), (2, 9), "{found:?}");
            assert_eq!(
                (found.headings[&2].as_str(), found.headings[&1].as_str()),
                ("building", "Nonstructural Item")
            );
        }
    }

    #[test]
    fn units_may_have_a_row_of_their_own_or_stand_above() {
        let found = find_header(
            &rows(&[
                "item,height,mass,level_ratio,x",
                "Units,mm,[kg],-,EUR",
                "rack,1800,140,1,2",
            ]),
            None,
        )
        .unwrap();
        assert_eq!((found.last_row, found.has_unit_row), (2, true));
        assert_eq!(
            [1, 2].map(|column| found.unit(column).map(CellUnit::symbol)),
            [Some("mm"), Some("kg")]
        );
        let found = find_header(&rows(&["item,height,mass", "kg,mm,mm"]), None).unwrap();
        assert!(found.units.is_empty());
        let found = find_header(
            &rows(&[
                ",,Size (cm),,",
                "id,item,H,W,D,Weight (kg)",
                "1,rack,1,2,3,4",
            ]),
            None,
        )
        .unwrap();
        assert_eq!(
            [2, 3, 4].map(|column| found.unit(column).map(CellUnit::symbol)),
            [Some("cm"); 3]
        );
    }

    #[test]
    fn rows_that_are_no_objects() {
        let all = rows(&[
            "id,item,height,mass",
            "Ward 3,,,",
            "1,rack,1800,85",
            "id,item,height,mass",
            ",Total,,85",
            "Ward 4:,,,",
            "2,cabinet,900,40",
            ",,in,lb",
            "3,shelf,30,40",
            "Measured in May,,,",
        ]);
        let header = find_header(&all, None).unwrap();
        let (body, other) = body(&all, &header);
        assert_eq!(other, None);
        let kinds: Vec<(u32, &str)> = body
            .left_out
            .iter()
            .map(|left| (left.row, <&str>::from(left.kind)))
            .collect();
        assert_eq!(
            kinds,
            [
                (2, "section"),
                (4, "header"),
                (5, "total"),
                (6, "section"),
                (8, "units"),
                (10, "note")
            ]
        );
        assert_eq!(body.sections, ["Ward 3", "Ward 4"]);
        assert_eq!(body.objects, [(2, Some(0)), (6, Some(1)), (8, Some(1))]);
        assert_eq!(body.units.len(), 2);
    }
}
