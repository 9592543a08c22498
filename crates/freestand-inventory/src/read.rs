//! Reading a file into an inventory.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use rayon::prelude::*;

use crate::library::Lookup;
use freestand_input::file::sha256_hex;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, UnitSystem, shorten};
use freestand_input::words::{canonical, nearest};

use super::cell::{Cell, Row};
use super::columns::{COLUMNS, Column, letters};
use super::columns_read::{ColumnRead, HeadingReport};
use super::edit::Edit;
use super::edits::{answer, edited};
use super::floors::{FloorFinder, Floors};
use super::headings::dimension;
use super::implausible::{SizeCell, confirm};
use super::item::{self, item};
use super::layout::{Header, LeftOut, Table, tables, unevaluated};
use super::mapping::{Mapping, cost_heading};
use super::problems::{Findings, Kind, Place, RowFindings};
use super::source::{Sheet, load};
use super::understood::{Evidence, Understood, understand};
use super::units::CellUnit;
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
    /// The units of most of its columns, or of its cells where its columns have none.
    pub units: UnitSystem,
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
        let problem = Problem::new(ProblemKind::Format, "there are no rows below the headings");
        return Err(problem
            .hint("put one object into each row")
            .in_file(path)
            .into());
    }
    warnings.extend(sheet.formulas.warning());
    let left_out = |row: &Row| {
        let has = |table: &Table| {
            table
                .body
                .left_out
                .binary_search_by_key(&row.number, |left| left.row)
                .is_ok()
        };
        tables.iter().any(has)
    };
    warnings.extend(unevaluated(&sheet.rows, &left_out));
    if let Some(row) = unread_from {
        warnings.push(format!(
            "row {row} begins another table of very many: it and what follows are not read"
        ));
    }
    let floors = match options.mapping {
        Some(mapping) => mapping.floors(&options.floors)?,
        None => options.floors.clone(),
    };
    let understood: Vec<Understood> = tables
        .iter()
        .map(|table| {
            let mut columns = understand(&Evidence {
                rows: &sheet.rows,
                header: &table.header,
                body: &table.body,
                mapping: options.mapping,
                has_semicolons: sheet.separator == Some(b';'),
            });
            bound_carried(&mut columns, table.body.objects.len());
            columns
        })
        .collect();
    let names = floor_names(&sheet, &tables, &understood);
    let mut findings = Findings::new(options.is_strict);
    let mut whole = Whole::default();
    for (table, columns) in tables.iter().zip(&understood) {
        for warning in columns.warnings.iter().cloned().chain(unread(columns)) {
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
        let finder = columns
            .get(Column::LevelRatio)
            .is_none()
            .then(|| FloorFinder::new(&floors, &names, columns.is_imperial, columns.is_japanese));
        let one = ReadTable {
            sheet: &sheet,
            table,
            columns,
            finder: finder.as_ref(),
            options,
        };
        whole.add(&one, &mut findings);
    }
    if let Some(mapping) = options.mapping {
        let headings = tables
            .iter()
            .flat_map(|table| table.header.headings.values().cloned());
        for heading in mapping.unused(headings) {
            warnings.push(format!(
                "the mapping file names the heading \"{heading}\", which the list does not have"
            ));
        }
    }
    let Whole {
        mut items,
        columns: columns_read,
        carried,
        headings,
        mapped,
        same_floors,
        ..
    } = whole;
    for item in &mut items {
        item.carried.resize(carried.len(), String::new());
    }
    tell_duplicates(&mut items, &tables, &understood, &mut findings);
    for item in items
        .iter_mut()
        .filter(|item| sheet.hidden.rows.binary_search(&item.row).is_ok())
    {
        findings.add(Kind::HiddenRow, Place::ROW, Some(item.row), "", None);
        item.doubts.push(Kind::HiddenRow);
    }
    warnings.extend(hidden_columns(
        &sheet,
        &tables,
        &understood,
        options.mapping,
    ));
    let cell = |item: &Item, column: Column| size_cell(item, column, &sheet, &tables, &understood);
    confirm(&mut items, options.edits, &mut findings, &cell);
    if let ([_], [columns]) = (tables.as_slice(), understood.as_slice()) {
        findings.answer(|finding| answer(finding, &sheet, columns));
    }
    warnings.extend(same_floors.warning());
    let (findings, notes) = findings.finish();
    warnings.extend(notes);
    let cells = if options.wants_cells {
        cells_read(&sheet, &tables)
    } else {
        Vec::new()
    };
    let mut left_out: Vec<LeftOut> = tables
        .into_iter()
        .flat_map(|table| table.body.left_out)
        .collect();
    left_out.sort_by_key(|left| left.row);
    let inventory = Inventory {
        libraries: Vec::new(),
        path: path.to_path_buf(),
        sha256,
        sheet: sheet.name,
        carried,
        items,
        read_with: String::new(),
        findings,
        warnings,
    };
    Ok(Reading {
        inventory,
        columns: columns_read,
        units: if understood.iter().any(|columns| columns.is_imperial) {
            UnitSystem::Us
        } else {
            UnitSystem::Si
        },
        header_row: sheet.header.row,
        left_out,
        mapping_file: super::mapping::written(&mapped, options.mapping),
        headings,
        cells,
    })
}

/// A warning about columns that are read and that a spreadsheet does not show.
fn hidden_columns(
    sheet: &Sheet,
    tables: &[Table],
    understood: &[Understood],
    mapping: Option<&Mapping>,
) -> Option<String> {
    let is_hidden = |index: u32| {
        sheet
            .hidden
            .columns
            .iter()
            .any(|(first, last)| (*first..=*last).contains(&index))
    };
    let uses = understood
        .iter()
        .flat_map(|columns| &columns.uses)
        .map(|one| (one.index, &one.heading));
    let headings = tables
        .iter()
        .flat_map(|table| &table.header.headings)
        .map(|(index, heading)| (*index, heading));
    let costs = headings.filter(|(_, heading)| cost_heading(heading, mapping).is_some());
    let read = uses.chain(costs).filter(|(index, _)| is_hidden(*index));
    let mut named: Vec<String> = read
        .map(|(index, heading)| format!("{} ({})", letters(index as usize), shorten(heading)))
        .collect();
    named.sort_unstable();
    named.dedup();
    (!named.is_empty()).then(|| {
        format!(
            "a spreadsheet does not show all columns that were read, as {} hidden; show or delete them",
            match named.as_slice() {
                [one] => format!("{one} is"),
                all => format!("{} are", all.join(", ")),
            }
        )
    })
}

/// The columns of the table in which a row is.
fn columns_of<'a>(
    row: u32,
    tables: &[Table],
    understood: &'a [Understood],
) -> Option<&'a Understood> {
    understood.get(
        tables
            .partition_point(|table| table.header.row < row)
            .checked_sub(1)?,
    )
}

/// The cell of a size of an object.
fn size_cell(
    item: &Item,
    column: Column,
    sheet: &Sheet,
    tables: &[Table],
    understood: &[Understood],
) -> Option<SizeCell> {
    let columns = columns_of(item.row, tables, understood)?;
    let row = sheet.rows.get(
        sheet
            .rows
            .binary_search_by_key(&item.row, |row| row.number)
            .ok()?,
    )?;
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
fn cells_read(sheet: &Sheet, tables: &[Table]) -> Vec<CellsRead> {
    let texts = |row: &Row| {
        let text = |index: &u32| row.get(*index).map(Cell::shown).unwrap_or_default();
        CellsRead {
            row: row.number,
            texts: sheet.header.headings.keys().map(text).collect(),
        }
    };
    let objects = tables.iter().flat_map(|table| &table.body.objects);
    objects
        .filter_map(|(place, _)| sheet.rows.get(*place))
        .map(texts)
        .collect()
}

/// The names of floors in all tables, or of sections where a table has no column of floors.
fn floor_names(sheet: &Sheet, tables: &[Table], understood: &[Understood]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (table, columns) in tables.iter().zip(understood) {
        match columns.get(Column::Floor) {
            Some(one) => {
                let rows = table
                    .body
                    .objects
                    .iter()
                    .filter_map(|(place, _)| sheet.rows.get(*place));
                names.extend(rows.filter_map(|row| Some(row.get(one.index)?.shown())));
            }
            None => names.extend(table.body.sections.iter().cloned()),
        }
    }
    names.sort_unstable();
    names.dedup();
    names
}

/// A table with all that its rows are read with.
struct ReadTable<'a> {
    sheet: &'a Sheet,
    table: &'a Table,
    columns: &'a Understood,
    /// `None`: the list has shares of the height.
    finder: Option<&'a FloorFinder>,
    options: &'a ReadOptions<'a>,
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
    mapped: Vec<(String, Option<Column>, Option<CellUnit>)>,
    /// The headings in it.
    seen: HashSet<String>,
    same_floors: SameFloors,
}

impl Whole {
    fn add(&mut self, one: &ReadTable<'_>, findings: &mut Findings) {
        let (mut items, counts) = one.items(findings);
        // Columns of one heading in two tables are one.
        let above = self.carried.len();
        let mut slots = Vec::with_capacity(one.columns.carried.len());
        for (_, heading) in &one.columns.carried {
            let same = self
                .carried
                .iter()
                .take(above)
                .position(|other| canonical(other) == canonical(heading));
            slots.push(same.unwrap_or(self.carried.len()));
            if same.is_none() {
                self.carried.push(heading.clone());
            }
        }
        for item in &mut items {
            let mut carried = vec![String::new(); self.carried.len()];
            for (slot, text) in slots.iter().zip(std::mem::take(&mut item.carried)) {
                if let Some(place) = carried.get_mut(*slot) {
                    *place = text;
                }
            }
            item.carried = carried;
            if let Some(finder) = one.finder {
                self.same_floors.take(item, finder);
            }
        }
        self.items.extend(items);
        self.columns
            .extend(columns_read(one.columns, &counts, one.table.header.row));
        self.headings.extend(one.headings());
        for heading in one.columns.headings(&one.table.header) {
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
        (!said.is_empty()).then(|| {
            format!(
                "one floor has several names in the list: {}",
                said.join(", ")
            )
        })
    }
}

impl ReadTable<'_> {
    /// The objects, and for each column the cells with and without a value.
    fn items(&self, all_findings: &mut Findings) -> (Vec<Item>, Vec<(usize, usize)>) {
        let Self {
            sheet,
            table,
            columns,
            finder,
            options,
        } = *self;
        let body = &table.body;
        let read_part = |part: &[(usize, Option<usize>)]| {
            let mut findings = Findings::new(options.is_strict);
            let mut counts = vec![(0, 0); columns.uses.len()];
            let mut items = Vec::with_capacity(part.len());
            for (place, section) in part {
                let Some(row) = sheet.rows.get(*place) else {
                    continue;
                };
                let section = section
                    .and_then(|section| body.sections.get(section))
                    .map_or("", String::as_str);
                let mut cells = Cells {
                    row,
                    rows: &sheet.rows,
                    columns,
                    merges: &sheet.merges,
                    told: RowFindings::new(&mut findings),
                    is_shifted: false,
                    counts: &mut counts,
                };
                let carried = carried(&mut cells, sheet, &table.header);
                let reading = item::Reading {
                    lookup: options.lookup,
                    floors: finder,
                    section,
                };
                items.push(item(&mut Values::Cells(cells), &reading, carried));
            }
            (items, counts, findings)
        };
        // Parts are put together in their order: the result does not depend on the threads.
        let parts: Vec<_> = body
            .objects
            .par_chunks(ROWS_OF_A_PART)
            .map(read_part)
            .collect();
        let mut counts = vec![(0, 0); columns.uses.len()];
        let mut items = Vec::with_capacity(body.objects.len());
        for (part, part_counts, part_findings) in parts {
            items.extend(part);
            all_findings.append(part_findings);
            for ((values, missing), (more_values, more_missing)) in
                counts.iter_mut().zip(part_counts)
            {
                *values += more_values;
                *missing += more_missing;
            }
        }
        (items, counts)
    }

    fn headings(&self) -> Vec<HeadingReport> {
        let objects = &self.table.body.objects;
        let one = |(index, heading): (&u32, &String)| {
            let found = self.columns.uses.iter().find(|one| one.index == *index);
            let rows = objects
                .iter()
                .filter_map(|(place, _)| self.sheet.rows.get(*place))
                .take(SAMPLED_ROWS);
            HeadingReport {
                column: letters(*index as usize),
                heading: heading.clone(),
                name: found.map(|one| one.column.name()),
                unit: found
                    .and_then(|one| one.unit)
                    .map(|unit| unit.symbol().to_owned()),
                header_row: self.table.header.row,
                samples: samples(rows, *index),
            }
        };
        self.table.header.headings.iter().map(one).collect()
    }
}

/// Up to five different texts of a column.
fn samples<'r>(rows: impl Iterator<Item = &'r Row>, index: u32) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for row in rows {
        let text = row
            .get(index)
            .map(|cell| shorten(cell.shown().trim()))
            .unwrap_or_default();
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
    let rows =
        super::source::first_rows(load(path)?, sheet).map_err(|problem| problem.in_file(path))?;
    let texts = |row: &Row| {
        row.cells
            .iter()
            .filter(|(_, cell)| is_heading(cell))
            .count()
    };
    // The widest row of texts that has a row below it.
    let most = rows
        .iter()
        .take(rows.len().saturating_sub(1))
        .map(texts)
        .max()
        .unwrap_or(0);
    let at = rows
        .iter()
        .position(|row| texts(row) == most)
        .filter(|_| most >= 2);
    let Some((header, below)) = at.and_then(|at| Some((rows.get(at)?, rows.get(at + 1..)?))) else {
        let problem = Problem::new(
            ProblemKind::Format,
            "the first rows contain no row of texts that could be headings",
        );
        return Err(problem
            .hint("put a heading over each column")
            .in_file(path)
            .into());
    };
    let one = |(index, cell): &(u32, Cell)| {
        let text = cell.shown().trim().to_owned();
        let found = super::headings::meaning(&text);
        HeadingReport {
            column: letters(*index as usize),
            name: found.as_ref().map(|found| found.column.name()),
            unit: found
                .and_then(|found| found.unit.symbol())
                .map(str::to_owned),
            header_row: header.number,
            samples: samples(below.iter().take(SAMPLED_ROWS), *index),
            heading: text,
        }
    };
    Ok(header
        .cells
        .iter()
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
        let found = super::headings::meaning(&one.heading);
        let unit = found.as_ref().and_then(|found| found.unit.stated());
        (one.heading.clone(), found.map(|found| found.column), unit)
    };
    let all: Vec<_> = headings.iter().map(one).collect();
    super::mapping::written(&all, None)
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
    let has =
        |column: Column| columns.get(column).is_some() || columns.get(Column::Dimensions).is_some();
    let is_round = columns.get(Column::Diameter).is_some();
    for (column, what) in [
        (Column::Height, "heights"),
        (Column::Thickness, "depths (thicknesses)"),
    ] {
        let has_side = is_round && column == Column::Thickness;
        if !has(column) && !has_side {
            said.push(format!(
                "the list has no column of {what} that is known: objects without it have no verdict"
            ));
        }
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
        cells.told.findings.add(
            Kind::Unreadable,
            Place::ROW,
            Some(row.number),
            "",
            Some(detail),
        );
        let hint = "put cells that contain the separator in quotes, or give every column a heading";
        cells
            .told
            .findings
            .hint(Kind::Unreadable, Place::ROW, hint.to_owned());
        cells.is_shifted = true;
    }
    for (index, cell) in &row.cells {
        if let Ok(at) = columns
            .carried
            .binary_search_by_key(index, |(index, _)| *index)
        {
            match cell {
                Cell::Error(_) => cells.told.findings.note(
                    "an error such as #REF! in a column that is carried through",
                    row.number,
                ),
                Cell::Unevaluated | Cell::TooLong(_) => {
                    cells.told.findings.note(
                        "a cell without a value in a column that is carried through",
                        row.number,
                    );
                }
                _ => {}
            }
            if let Some(slot) = carried.get_mut(at) {
                *slot = cell.shown();
            }
        } else if !header.headings.contains_key(index) && !cell.is_blank() && !cells.is_shifted {
            cells.told.findings.note(
                "cells in columns without a heading are not read",
                row.number,
            );
        }
    }
    carried
}

/// Gives later rows with an id that occurred before a number: no output could tell them apart.
fn tell_duplicates(
    items: &mut [Item],
    tables: &[Table],
    understood: &[Understood],
    findings: &mut Findings,
) {
    let mut seen: HashMap<String, u32> = items.iter().map(|item| (item.id.clone(), 0)).collect();
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
        let id =
            columns_of(item.row, tables, understood).and_then(|columns| columns.get(Column::Id));
        let place = match id {
            Some(one) => Place {
                column: Some(Column::Id),
                index: Some(one.index),
                heading: Some(&one.heading),
            },
            None => Place::ROW,
        };
        findings.add(Kind::DuplicateId, place, Some(item.row), &item.id, None);
        seen.insert(item.id.clone(), number);
        item.id = format!("{} #{number}", item.id);
        seen.insert(item.id.clone(), 1);
        item.doubts.push(Kind::DuplicateId);
    }
}

fn columns_read(
    columns: &Understood,
    counts: &[(usize, usize)],
    header_row: u32,
) -> Vec<ColumnRead> {
    let one = |(one, (values, missing)): (&super::understood::Use, &(usize, usize))| {
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
