//! Reading a file into an inventory.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use rayon::prelude::*;

use crate::library::Lookup;
use freestand_input::file::sha256_hex;
use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::{Dimension, UnitSystem, shorten};
use freestand_input::words::{canonical, nearest};

use super::cell::{Cell, Row, row_at};
use super::columns::{COLUMNS, Column, letters};
use super::columns_read::{ColumnRead, HeadingReport};
use super::edit::Edit;
use super::edits::{answer, edited};
use super::encoding::is_unprintable;
use super::floors::{FloorFinder, Floors};
use super::headings::{dimension, meaning};
use super::implausible::{SizeCell, confirm};
use super::item::{self, item};
use super::layout::{Header, LeftOut, Table, tables, unevaluated};
use super::mapping::{Headed, Mapping, cost_heading, written};
use super::problems::{Findings, Kind, Place, RowFindings, bad_file};
use super::scans::Scans;
use super::source::{Sheet, first_rows, load};
use super::understood::understand;
use super::used::{Evidence, Understood, Use};
use super::values::{Cells, Values};
use super::{Inventory, Item};

/// Largest number of columns that are carried through; an asset register has some dozens.
const MAX_CARRIED: usize = 256;
/// Largest number of cells that are carried through, over all rows.
const MAX_CARRIED_CELLS: usize = 20_000_000;
/// Rows that are read by one thread at a time.
const ROWS_OF_A_PART: usize = 4096;
/// Rows of which examples of cells are shown.
const SAMPLED_ROWS: usize = 200;
/// Largest number of headings that are checked for typing mistakes.
const MAX_MEANT: usize = 20;

/// How a list is to be read.
#[derive(Clone)]
pub struct ReadOptions<'a> {
    /// A sheet of a workbook; `None`: the visible one with the best headings.
    pub sheet: Option<&'a str>,
    /// What the user says about columns, floors and numbers.
    pub mapping: Option<&'a Mapping>,
    /// What is known about the floors of the building.
    pub floors: Floors,
    /// Every doubt is an error.
    pub is_strict: bool,
    /// Cells that are read otherwise than the file has them.
    pub edits: &'a [Edit],
    /// Whether the texts of cells are wanted too.
    pub wants_cells: bool,
    /// Where the entries that a list names are looked up.
    pub lookup: &'a Lookup<'a>,
}

impl<'a> ReadOptions<'a> {
    /// Everything as the list says.
    pub fn new(lookup: &'a Lookup<'a>) -> Self {
        Self {
            sheet: None,
            mapping: None,
            floors: Floors::default(),
            is_strict: false,
            edits: &[],
            wants_cells: false,
            lookup,
        }
    }
}

/// The cells of an object as they were read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellsRead {
    /// Its row, counted from 1.
    pub row: u32,
    /// The text of the cell below each heading; empty where it shows nothing.
    pub texts: Vec<String>,
}

/// An inventory, and how its file was understood.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The inventory.
    pub inventory: Inventory,
    /// The columns that freestand reads, in the order of the file.
    pub columns: Vec<ColumnRead>,
    /// The row of the headings, counted from 1.
    pub header_row: u32,
    /// The rows that are not objects.
    pub left_out: Vec<LeftOut>,
    /// A mapping file to edit, with what each heading was taken for.
    pub mapping_file: String,
    /// Every heading, with examples of its cells.
    pub headings: Vec<HeadingReport>,
    /// The cells of each object; none where they are not wanted.
    pub cells: Vec<CellsRead>,
}

/// Reads an inventory from a CSV or a workbook (XLSX), recognised by its content: every quantity in
/// SI, missing values as `None`.
///
/// Headings, units and numbers are read as `docs/inventory.md` says. A cell that cannot be read
/// costs its value, and is in [`Inventory::findings`].
///
/// # Accuracy
/// A number in a CSV and the same number in a workbook are the same f64, whatever the unit.
///
/// # Errors
/// A file that is not a list: no headings, no rows, damaged, or larger than 512 MB, 1,048,576 rows,
/// 16,384 columns, 25 million cells, or that unpacks to more than 512 MiB.
///
/// # Example
/// ```
/// use freestand_inventory::{ReadOptions, read_inventory};
/// use freestand_inventory::library::Lookup;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("objects.csv");
/// std::fs::write(&path, "Inv.-Nr.;Bezeichnung;Höhe [mm];Tiefe (cm);Gewicht\n007;Schrank;2.300;60;0,14 t\n")?;
/// let inventory = read_inventory(&path, &ReadOptions::new(&Lookup::NONE))?;
/// let cabinet = &inventory.items[0];
/// assert_eq!((cabinet.height_m, cabinet.thickness_m, cabinet.mass_kg), (Some(2.3), Some(0.6), Some(140.0)));
/// assert_eq!((cabinet.id.as_str(), cabinet.row), ("007", 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_inventory(path: &Path, options: &ReadOptions<'_>) -> Result<Inventory, Problems> {
    inspect_inventory(path, options).map(|reading| reading.inventory)
}

/// As [`read_inventory`], and reports how the file was understood.
///
/// # Errors
/// As [`read_inventory`].
pub fn inspect_inventory(path: &Path, options: &ReadOptions<'_>) -> Result<Reading, Problems> {
    parse_inventory(load(path)?, path, options)
}

/// As [`inspect_inventory`], for the bytes of a file; `path` is for messages.
///
/// # Errors
/// As [`read_inventory`].
pub fn parse_inventory(
    bytes: Vec<u8>,
    path: &Path,
    options: &ReadOptions<'_>,
) -> Result<Reading, Problems> {
    let sha256 = sha256_hex(&bytes);
    let in_file = |problem: Problem| problem.in_file(path);
    let mut sheet = Sheet::open(bytes, options.sheet, options.mapping).map_err(in_file)?;
    sheet.edit(options.edits).map_err(in_file)?;
    let mut warnings = std::mem::take(&mut sheet.warnings);
    warnings.extend(edited(options.edits));
    warnings.extend(sheet.title_warning());
    let (tables, unread_from) = tables(&sheet.rows, &sheet.header, options.mapping);
    if tables.iter().all(|table| table.body.objects.is_empty()) {
        let message = "there are no rows below the headings";
        return Err(in_file(bad_file(message, "put one object into each row")).into());
    }
    warnings.extend(sheet.formulas.warning());
    let left_out = |row: &Row| tables.iter().any(|table| table.body.leaves_out(row));
    warnings.extend(unevaluated(&sheet.rows, &left_out));
    warnings.extend(unread_from.map(|row| {
        format!("row {row} begins another table of very many: it and what follows are not read")
    }));
    let floors = match options.mapping {
        Some(mapping) => mapping.floors(&options.floors)?,
        None => options.floors.clone(),
    };
    let list = List::new(
        sheet,
        tables,
        path.parent().unwrap_or(Path::new("")),
        options,
    );
    let names = list.floor_names();
    let mut findings = Findings::new(options.is_strict);
    let mut whole = Whole::default();
    for part in &list.parts {
        let columns = &part.columns;
        for warning in columns.warnings.iter().cloned().chain(unread(columns)) {
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
        let finder = columns
            .get(Column::LevelRatio)
            .is_none()
            .then(|| FloorFinder::new(&floors, &names, columns.is_imperial, columns.is_japanese));
        whole.add(&list, part, finder.as_ref(), &mut findings);
    }
    if let Some(mapping) = options.mapping {
        let headings = list.headings().map(|(_, heading)| heading.clone());
        warnings.extend(mapping.unused(headings).iter().map(|heading| {
            format!(
                "the mapping file names the heading \"{heading}\", which the list does not have"
            )
        }));
    }
    let carried = whole.carried.len();
    for item in &mut whole.items {
        item.carried.resize(carried, String::new());
    }
    list.tell_duplicates(&mut whole.items, &mut findings);
    list.tell_unprintable(&mut whole.items, &mut findings);
    for item in &mut whole.items {
        if list.sheet.hidden.rows.binary_search(&item.row).is_ok() {
            findings.add(Kind::HiddenRow, Place::ROW, Some(item.row), "", "");
            item.doubts.push(Kind::HiddenRow);
        }
    }
    warnings.extend(list.hidden_columns());
    let cell = |item: &Item, column| list.size_cell(item, column);
    confirm(&mut whole.items, options.edits, &mut findings, &cell);
    if let [part] = list.parts.as_slice() {
        findings.answer(|finding| answer(finding, &list.sheet, &part.columns));
    }
    warnings.extend(whole.same_floors.warning());
    let (findings, notes) = findings.finish();
    warnings.extend(notes);
    let cells = match options.wants_cells {
        true => list.cells_read(),
        false => Vec::new(),
    };
    let scans = list.scans.files();
    let is_imperial = list.parts.iter().any(|part| part.columns.is_imperial);
    let left_out = list.parts.into_iter().map(|part| part.table.body.left_out);
    let mut left_out: Vec<LeftOut> = left_out.flatten().collect();
    left_out.sort_by_key(|left| left.row);
    let inventory = Inventory {
        libraries: Vec::new(),
        scans,
        path: path.to_path_buf(),
        sha256,
        sheet: list.sheet.name,
        carried: whole.carried,
        items: whole.items,
        read_with: String::new(),
        findings,
        warnings,
        units: match is_imperial {
            true => UnitSystem::Us,
            false => UnitSystem::Si,
        },
    };
    Ok(Reading {
        inventory,
        columns: whole.columns,
        header_row: list.sheet.header.row,
        left_out,
        mapping_file: written(&whole.mapped, options.mapping),
        headings: whole.headings,
        cells,
    })
}

/// A table of a list, and what its columns are.
struct Part {
    table: Table,
    columns: Understood,
}

/// A list whose columns are understood.
struct List<'a> {
    sheet: Sheet,
    parts: Vec<Part>,
    options: &'a ReadOptions<'a>,
    scans: Scans,
}

impl<'a> List<'a> {
    fn new(sheet: Sheet, tables: Vec<Table>, folder: &Path, options: &'a ReadOptions<'a>) -> Self {
        let understood = |table: Table| {
            let mut columns = understand(&Evidence {
                rows: &sheet.rows,
                header: &table.header,
                body: &table.body,
                mapping: options.mapping,
                has_semicolons: sheet.separator == Some(b';'),
            });
            bound_carried(&mut columns, table.body.objects.len());
            Part { table, columns }
        };
        let parts = tables.into_iter().map(understood).collect();
        Self {
            sheet,
            parts,
            options,
            scans: Scans::new(folder),
        }
    }

    /// The rows of the objects of a table.
    fn rows<'s>(&'s self, part: &'s Part) -> impl Iterator<Item = &'s Row> {
        part.table.body.rows(&self.sheet.rows)
    }

    /// The headings of all tables, with their columns.
    fn headings(&self) -> impl Iterator<Item = (&u32, &String)> {
        let parts = self.parts.iter();
        parts.flat_map(|part| &part.table.header.headings)
    }

    /// A warning about columns that are read and that a spreadsheet does not show.
    fn hidden_columns(&self) -> Option<String> {
        let is_hidden = |index: u32| {
            let mut hidden = self.sheet.hidden.columns.iter();
            hidden.any(|(first, last)| (*first..=*last).contains(&index))
        };
        let uses = self.parts.iter().flat_map(|part| &part.columns.uses);
        let uses = uses.map(|one| (&one.index, &one.heading));
        let costs = self
            .headings()
            .filter(|(_, heading)| cost_heading(heading, self.options.mapping).is_some());
        let read = uses.chain(costs).filter(|(index, _)| is_hidden(**index));
        let mut named: Vec<String> = read
            .map(|(index, heading)| format!("{} ({})", letters(*index as usize), shorten(heading)))
            .collect();
        named.sort_unstable();
        named.dedup();
        let named = match named.as_slice() {
            [] => return None,
            [one] => format!("{one} is"),
            all => format!("{} are", all.join(", ")),
        };
        Some(format!(
            "a spreadsheet does not show all columns that were read, as {named} hidden; show or delete them"
        ))
    }

    /// The columns of the table in which a row is.
    fn columns_of(&self, row: u32) -> Option<&Understood> {
        let after = self
            .parts
            .partition_point(|part| part.table.header.row < row);
        let part = self.parts.get(after.checked_sub(1)?)?;
        Some(&part.columns)
    }

    /// The cell of a size of an object.
    fn size_cell(&self, item: &Item, column: Column) -> Option<SizeCell> {
        let columns = self.columns_of(item.row)?;
        let row = row_at(&self.sheet.rows, item.row)?;
        let used = [column, Column::Dimensions, Column::Diameter]
            .into_iter()
            .filter_map(|column| columns.get(column));
        let mut cells = used.filter_map(|one| Some((one, row.get(one.index)?)));
        let (one, cell) = cells.find(|(_, cell)| !cell.is_blank())?;
        Some(SizeCell {
            column,
            index: one.index,
            heading: one.heading.clone(),
            row: item.row,
            text: cell.shown(),
            unit: one.unit_at(item.row),
        })
    }

    /// The texts of the cells of all objects, below the headings of the first table.
    fn cells_read(&self) -> Vec<CellsRead> {
        let headings = &self.sheet.header.headings;
        let texts = |row: &Row| CellsRead {
            row: row.number,
            texts: headings.keys().map(|index| row.shown(*index)).collect(),
        };
        let parts = self.parts.iter();
        parts.flat_map(|part| self.rows(part)).map(texts).collect()
    }

    /// The names of floors in all tables, or of sections where a table has no column of floors.
    fn floor_names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for part in &self.parts {
            match part.columns.get(Column::Floor) {
                Some(one) => {
                    let rows = self.rows(part);
                    names.extend(rows.filter_map(|row| Some(row.get(one.index)?.shown())));
                }
                None => names.extend(part.table.body.sections.iter().cloned()),
            }
        }
        names.sort_unstable();
        names.dedup();
        names
    }

    /// The objects of a table, and for each column the cells with and without a value; `finder`: `None` where
    /// the list has shares of the height.
    fn items(
        &self,
        part: &Part,
        finder: Option<&FloorFinder>,
        all_findings: &mut Findings,
    ) -> (Vec<Item>, Vec<(usize, usize)>) {
        let Part { table, columns } = part;
        let read_part = |objects: &[(usize, Option<usize>)]| {
            let mut findings = Findings::new(self.options.is_strict);
            let mut counts = vec![(0, 0); columns.uses.len()];
            let mut items = Vec::with_capacity(objects.len());
            for (place, section) in objects {
                let Some(row) = self.sheet.rows.get(*place) else {
                    continue;
                };
                let section = section.and_then(|section| table.body.sections.get(section));
                let mut cells = Cells {
                    row,
                    rows: &self.sheet.rows,
                    columns,
                    merges: &self.sheet.merges,
                    told: RowFindings::new(&mut findings),
                    is_shifted: false,
                    counts: &mut counts,
                };
                let carried = carried(&mut cells, &self.sheet, &table.header);
                let reading = item::Reading {
                    lookup: self.options.lookup,
                    floors: finder,
                    section: section.map_or("", String::as_str),
                    scans: &self.scans,
                };
                items.push(item(&mut Values::Cells(cells), &reading, carried));
            }
            (items, counts, findings)
        };
        // Parts are put together in their order: the result does not depend on the threads.
        let objects = &table.body.objects;
        let parts: Vec<_> = objects.par_chunks(ROWS_OF_A_PART).map(read_part).collect();
        let mut counts = vec![(0, 0); columns.uses.len()];
        let mut items = Vec::with_capacity(objects.len());
        for (part, part_counts, part_findings) in parts {
            items.extend(part);
            all_findings.append(part_findings);
            for (all, more) in counts.iter_mut().zip(part_counts) {
                *all = (all.0 + more.0, all.1 + more.1);
            }
        }
        (items, counts)
    }

    fn heading_reports(&self, part: &Part) -> Vec<HeadingReport> {
        let header = &part.table.header;
        let named = part.columns.headings(header).into_iter();
        let one = |(index, (heading, column, unit)): (&u32, Headed)| HeadingReport {
            column: letters(*index as usize),
            heading,
            name: column.map(Column::name),
            unit: unit.map(|unit| unit.symbol().to_owned()),
            header_row: header.row,
            samples: samples(self.rows(part), *index),
        };
        header.headings.keys().zip(named).map(one).collect()
    }

    /// Finds headings and texts with control characters, which no conversion takes: of all columns, also of those that are
    /// only carried through.
    fn tell_unprintable(&self, items: &mut [Item], findings: &mut Findings) {
        let mut rows = HashSet::new();
        let is_unreadable = |text: &str| text.chars().any(is_unprintable);
        for part in &self.parts {
            let headings = &part.table.header.headings;
            let place = |index: u32| Place {
                column: part
                    .columns
                    .uses
                    .iter()
                    .find(|one| one.index == index)
                    .map(|one| one.column),
                index: Some(index),
                heading: headings.get(&index).map(String::as_str),
            };
            for (index, heading) in headings.iter().filter(|(_, text)| is_unreadable(text)) {
                let row = Some(part.table.header.row);
                findings.add(Kind::Unprintable, place(*index), row, heading, "");
            }
            for row in self.rows(part) {
                for (index, cell) in &row.cells {
                    if let Cell::Text(text) = cell
                        && is_unreadable(text)
                    {
                        findings.add(Kind::Unprintable, place(*index), Some(row.number), text, "");
                        rows.insert(row.number);
                    }
                }
            }
        }
        for item in items.iter_mut().filter(|item| rows.contains(&item.row)) {
            item.doubts.push(Kind::Unprintable);
        }
    }

    /// Gives later rows with an id that occurred before a number: no output could tell them apart.
    fn tell_duplicates(&self, items: &mut [Item], findings: &mut Findings) {
        let mut seen: HashMap<String, u32> =
            items.iter().map(|item| (item.id.clone(), 0)).collect();
        for item in items {
            let count = seen.entry(item.id.clone()).or_insert(0);
            *count += 1;
            if *count == 1 {
                continue;
            }
            let mut number = *count;
            while seen.contains_key(&format!("{} #{number}", item.id)) {
                number += 1;
            }
            let columns = self.columns_of(item.row);
            let id = columns.and_then(|columns| columns.get(Column::Id));
            let place = id.map_or(Place::ROW, Use::place);
            findings.add(Kind::DuplicateId, place, Some(item.row), &item.id, "");
            seen.insert(item.id.clone(), number);
            item.id = format!("{} #{number}", item.id);
            seen.insert(item.id.clone(), 1);
            item.doubts.push(Kind::DuplicateId);
        }
    }
}

/// What the tables of a sheet have together.
#[derive(Default)]
struct Whole {
    items: Vec<Item>,
    columns: Vec<ColumnRead>,
    /// The headings that are carried through.
    carried: Vec<String>,
    headings: Vec<HeadingReport>,
    /// For a mapping file.
    mapped: Vec<Headed>,
    /// The headings in it.
    seen: HashSet<String>,
    same_floors: SameFloors,
}

impl Whole {
    fn add(
        &mut self,
        list: &List<'_>,
        part: &Part,
        finder: Option<&FloorFinder>,
        findings: &mut Findings,
    ) {
        let Part { table, columns } = part;
        let (mut items, counts) = list.items(part, finder, findings);
        // Columns of one heading in two tables are one.
        let above = self.carried.len();
        let mut slots = Vec::with_capacity(columns.carried.len());
        for (_, heading) in &columns.carried {
            let mut known = self.carried.iter().take(above);
            let same = known.position(|other| canonical(other) == canonical(heading));
            slots.push(same.unwrap_or(self.carried.len()));
            if same.is_none() {
                self.carried.push(heading.clone());
            }
        }
        for item in &mut items {
            let mut carried = vec![String::new(); self.carried.len()];
            for (slot, text) in slots.iter().zip(std::mem::take(&mut item.carried)) {
                carried[*slot] = text;
            }
            item.carried = carried;
            if let Some(finder) = finder {
                self.same_floors.take(item, finder);
            }
        }
        self.items.extend(items);
        self.columns
            .extend(columns_read(columns, &counts, table.header.row));
        self.headings.extend(list.heading_reports(part));
        for heading in columns.headings(&table.header) {
            if self.seen.insert(canonical(&heading.0)) {
                self.mapped.push(heading);
            }
        }
    }
}

/// The names of floors as they were first written: "Level 6", "L6" and "6" are one floor.
#[derive(Default)]
struct SameFloors {
    first: HashMap<(String, (u8, u32)), String>,
    others: Vec<(String, String)>,
}

impl SameFloors {
    fn take(&mut self, item: &mut Item, finder: &FloorFinder) {
        let Some(identity) = finder.identity(&item.floor) else {
            return;
        };
        let first = self
            .first
            .entry((item.building.clone(), identity))
            .or_insert_with(|| item.floor.clone());
        if *first != item.floor {
            let other = (item.floor.clone(), first.clone());
            if !self.others.contains(&other) && self.others.len() < MAX_MEANT {
                self.others.push(other);
            }
            item.floor.clone_from(first);
        }
    }

    fn warning(&self) -> Option<String> {
        let said: Vec<String> = self
            .others
            .iter()
            .map(|(other, first)| format!("\"{}\" is \"{}\"", shorten(other), shorten(first)))
            .collect();
        let said = said.join(", ");
        (!said.is_empty()).then(|| format!("one floor has several names in the list: {said}"))
    }
}

/// Up to five different texts of a column.
fn samples<'r>(rows: impl Iterator<Item = &'r Row>, index: u32) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for row in rows.take(SAMPLED_ROWS) {
        let text = shorten(row.shown(index).trim());
        if !text.is_empty() && !found.contains(&text) {
            found.push(text);
        }
        if found.len() == 5 {
            break;
        }
    }
    found
}

/// The headings of a list of which too few are known to read it: those of the row that looks most like
/// headings.
///
/// # Errors
/// A file that is no list at all.
pub fn inspect_headings(path: &Path, sheet: Option<&str>) -> Result<Vec<HeadingReport>, Problems> {
    let rows = first_rows(load(path)?, sheet).map_err(|problem| problem.in_file(path))?;
    let texts = |row: &Row| {
        row.cells
            .iter()
            .filter(|(_, cell)| is_heading(cell))
            .count()
    };
    // The widest row of texts that has a row below it.
    let with_below = rows.iter().take(rows.len().saturating_sub(1));
    let most = with_below.map(texts).max().unwrap_or(0);
    let at = rows.iter().position(|row| texts(row) == most);
    let found = at.and_then(|at| Some((rows.get(at)?, rows.get(at + 1..)?)));
    let Some((header, below)) = found.filter(|_| most >= 2) else {
        let message = "the first rows contain no row of texts that could be headings";
        let problem = bad_file(message, "put a heading over each column");
        return Err(problem.in_file(path).into());
    };
    let one = |(index, cell): &(u32, Cell)| {
        let text = cell.shown().trim().to_owned();
        let found = meaning(&text);
        HeadingReport {
            column: letters(*index as usize),
            name: found.as_ref().map(|found| found.column.name()),
            unit: found
                .and_then(|found| found.unit.symbol())
                .map(str::to_owned),
            header_row: header.number,
            samples: samples(below.iter(), *index),
            heading: text,
        }
    };
    let cells = header.cells.iter();
    Ok(cells
        .filter(|(_, cell)| is_heading(cell))
        .map(one)
        .collect())
}

fn is_heading(cell: &Cell) -> bool {
    matches!(cell, Cell::Text(text) if text.chars().any(char::is_alphabetic) && text.len() <= 120)
}

/// A mapping file to edit, for headings of which too few are known to read the list.
pub fn mapping_of_headings(headings: &[HeadingReport]) -> String {
    let one = |one: &HeadingReport| {
        let found = meaning(&one.heading);
        let unit = found.as_ref().and_then(|found| found.unit.stated());
        (one.heading.clone(), found.map(|found| found.column), unit)
    };
    let all: Vec<_> = headings.iter().map(one).collect();
    written(&all, None)
}

/// At most so many columns and cells are carried through as fit into memory.
fn bound_carried(columns: &mut Understood, objects: usize) {
    let most = MAX_CARRIED.min(MAX_CARRIED_CELLS / objects.max(1));
    if columns.carried.len() > most {
        let dropped = columns.carried.len() - most;
        columns.warnings.push(format!(
            "{dropped} columns that are not read are left out: at most {most} are carried through"
        ));
        columns.carried.truncate(most);
    }
}

/// Headings that are probably names with typing mistakes, and sizes that the list does not have.
fn unread(columns: &Understood) -> Vec<String> {
    let names: Vec<&str> = COLUMNS.iter().map(|spec| spec.name).collect();
    let mut said: Vec<String> = columns
        .carried
        .iter()
        .take(MAX_MEANT)
        .filter_map(|(index, heading)| {
            let words =
                canonical(heading.split(['(', '[']).next().unwrap_or_default()).replace(' ', "_");
            // Short words resemble too many names.
            let near = nearest(&words, &names)
                .filter(|_| words.chars().count() > 3 && heading.len() < 100)?;
            let place = format!("column {} ({})", letters(*index as usize), shorten(heading));
            Some(format!(
                "{place} is not read, only carried through: did you mean {near}?"
            ))
        })
        .collect();
    let has = |column: Column| columns.get(column).is_some();
    let is_known = |side: Column| has(side) || has(Column::Dimensions) || has(Column::Scan);
    let mut lacks = |what: &str| {
        said.push(format!(
            "the list has no column of {what} that is known: objects without it have no verdict"
        ));
    };
    if !is_known(Column::Height) {
        lacks("heights");
    }
    if !is_known(Column::Thickness) && !has(Column::Diameter) {
        lacks("depths (thicknesses)");
    }
    said
}

/// The cells of other columns, unchanged.
fn carried(cells: &mut Cells<'_>, sheet: &Sheet, header: &Header) -> Vec<String> {
    let row = cells.row;
    let columns = cells.columns;
    let mut carried = vec![String::new(); columns.carried.len()];
    // In a CSV a number with a decimal comma that is not in quotes moves every cell after it.
    if let (Some(width), Some(_)) = (header.width, sheet.separator)
        && row
            .cells
            .iter()
            .any(|(index, cell)| *index >= width && !cell.is_blank())
    {
        let count = row.cells.last().map_or(0, |(index, _)| index + 1);
        let detail = format!("has {count} cells for {width} headings, so its numbers are not used");
        let hint = "put cells that contain the separator in quotes, or give every column a heading";
        let (kind, findings) = (Kind::Unreadable, &mut cells.told.findings);
        findings.add(kind, Place::ROW, Some(row.number), "", &detail);
        findings.hint(kind, Place::ROW, hint);
        cells.is_shifted = true;
    }
    let mut note = |words| cells.told.findings.note(words, row.number);
    for (index, cell) in &row.cells {
        if let Ok(at) = columns
            .carried
            .binary_search_by_key(index, |(index, _)| *index)
        {
            match cell {
                Cell::Error(_) => {
                    note("an error such as #REF! in a column that is carried through");
                }
                Cell::Unevaluated | Cell::TooLong(_) => {
                    note("a cell without a value in a column that is carried through");
                }
                _ => {}
            }
            if let Some(slot) = carried.get_mut(at) {
                *slot = cell.shown();
            }
        } else if !header.headings.contains_key(index) && !cell.is_blank() && !cells.is_shifted {
            note("cells in columns without a heading are not read");
        }
    }
    carried
}

fn columns_read(
    columns: &Understood,
    counts: &[(usize, usize)],
    header_row: u32,
) -> Vec<ColumnRead> {
    let one = |(one, (values, missing)): (&Use, &(usize, usize))| {
        let has_unit = dimension(one.column).is_some_and(|dimension| dimension != Dimension::Ratio);
        ColumnRead {
            letter: letters(one.index as usize),
            heading: one.heading.clone(),
            header_row,
            name: one.column.name(),
            unit: one.unit.map(|unit| unit.symbol().to_owned()),
            unit_source: one
                .unit_source
                .map(|source| source.into())
                .or(has_unit.then_some("cell")),
            dialect: one.dialect.name(),
            values: *values,
            missing: *missing,
        }
    };
    columns.uses.iter().zip(counts).map(one).collect()
}
