//! Reading a file into an inventory.

use std::collections::HashMap;
use std::path::Path;

use rayon::prelude::*;
use serde::Serialize;

use crate::library::Lookup;
use freestand_input::file::sha256_hex;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, shorten};
use freestand_input::words::{canonical, nearest};

use super::cell::{Cell, Row};
use super::columns::{COLUMNS, Column, letters};
use super::edits::{Edit, edited};
use super::floors::{FloorFinder, Floors};
use super::headings::dimension;
use super::item::{self, item};
use super::layout::{Body, LeftOut, body};
use super::mapping::Mapping;
use super::problems::{Findings, Kind, Place};
use super::source::{Sheet, load};
use super::understood::{Evidence, Understood, understand};
use super::values::Values;
use super::{Inventory, Item};

/// Largest number of columns that are carried through; an asset register has some dozens.
const MAX_CARRIED: usize = 256;
/// Largest number of cells that are carried through, over all rows.
const MAX_CARRIED_CELLS: usize = 20_000_000;
/// Rows that are read by one thread at a time.
const ROWS_OF_A_PART: usize = 4096;
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

/// A known column, as it was understood; the columns of the document of `freestand inventory check`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ColumnRead {
    /// Its letter in a spreadsheet: `F`.
    #[serde(rename = "column")]
    pub letter: String,
    /// Its heading in the file.
    pub heading: String,
    /// Its name in freestand.
    pub name: &'static str,
    /// The unit of its bare numbers; `None`: it has none, or each cell has its own.
    pub unit: Option<String>,
    /// Where the unit comes from: `mapping`, `heading`, `unit-row`, `sentence`, `cells`,
    /// `plausibility`, or `cell` where each cell has its own.
    pub unit_source: Option<&'static str>,
    /// The decimal sign: `point`, `comma` or `mixed`; `None`: no number needs one.
    pub dialect: Option<&'static str>,
    /// Cells with a value.
    pub values: usize,
    /// Cells that are empty or say that the value is not known.
    pub missing: usize,
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
    /// Every heading, with the letter of its column.
    pub headings: Vec<(String, String)>,
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
/// use freestand_assess::inventory::{ReadOptions, read_inventory};
/// use freestand_assess::library::Lookup;
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
pub fn parse_inventory(bytes: Vec<u8>, path: &Path, options: &ReadOptions<'_>) -> Result<Reading, Problems> {
    let sha256 = sha256_hex(&bytes);
    let in_file = |problem: Problem| problem.in_file(path);
    let mut sheet = Sheet::open(bytes, options.sheet, options.mapping).map_err(in_file)?;
    sheet.edit(options.edits).map_err(in_file)?;
    let mut warnings = std::mem::take(&mut sheet.warnings);
    warnings.extend(edited(options.edits));
    warnings.extend(sheet.title_warning());
    let body = body(&sheet.rows, &sheet.header);
    if body.objects.is_empty() {
        let problem = Problem::new(ProblemKind::Format, "there are no rows below the headings");
        return Err(problem.hint("put one object into each row").in_file(path).into());
    }
    let floors = match options.mapping {
        Some(mapping) => mapping.floors(&options.floors)?,
        None => options.floors.clone(),
    };
    let evidence = Evidence {
        rows: &sheet.rows,
        header: &sheet.header,
        body: &body,
        mapping: options.mapping,
        has_semicolons: sheet.separator == Some(b';'),
    };
    let mut columns = understand(&evidence);
    let mapping_file = columns.mapping_file(&sheet.header, options.mapping);
    bound_carried(&mut columns, body.objects.len());
    warnings.append(&mut columns.warnings);
    warnings.extend(unread(&columns));
    warnings.extend(sheet.formulas.warning());
    if let Some(row) = body.other_table {
        warnings.push(format!("row {row} begins a table with other headings: it and what follows are not read"));
    }
    let mut findings = Findings::new(options.is_strict);
    let finder = floor_finder(&floors, &columns, &sheet.rows, &body);
    let read_part = |part: &[(usize, Option<usize>)]| {
        let mut findings = Findings::new(options.is_strict);
        let mut counts = vec![(0, 0); columns.uses.len()];
        let mut items = Vec::with_capacity(part.len());
        for (place, section) in part {
            let Some(row) = sheet.rows.get(*place) else { continue };
            let section = section.and_then(|section| body.sections.get(section)).map_or("", String::as_str);
            let mut values = Values {
                row,
                rows: &sheet.rows,
                columns: &columns,
                merges: &sheet.merges,
                findings: &mut findings,
                doubts: Vec::new(),
                is_shifted: false,
                counts: &mut counts,
            };
            let carried = carried(&mut values, &sheet);
            let reading = item::Reading { lookup: options.lookup, floors: finder.as_ref(), section };
            items.push(item(&mut values, &reading, carried));
        }
        (items, counts, findings)
    };
    // Parts are put together in their order: the result does not depend on the threads.
    let parts: Vec<_> = body.objects.par_chunks(ROWS_OF_A_PART).map(read_part).collect();
    let mut counts = vec![(0, 0); columns.uses.len()];
    let mut items = Vec::with_capacity(body.objects.len());
    for (part, part_counts, part_findings) in parts {
        items.extend(part);
        findings.append(part_findings);
        for ((values, missing), (more_values, more_missing)) in counts.iter_mut().zip(part_counts) {
            *values += more_values;
            *missing += more_missing;
        }
    }
    tell_duplicates(&mut items, &columns, &mut findings);
    let (findings, notes) = findings.finish();
    warnings.extend(notes);
    let columns_read = columns_read(&columns, &counts);
    let inventory = Inventory {
        libraries: Vec::new(),
        path: path.to_path_buf(),
        sha256,
        sheet: sheet.name,
        carried: columns.carried.into_iter().map(|(_, heading)| heading).collect(),
        items,
        read_with: String::new(),
        findings,
        warnings,
    };
    let texts = |row: &Row| {
        let text = |index: &u32| row.get(*index).map(Cell::shown).unwrap_or_default();
        CellsRead { row: row.number, texts: sheet.header.headings.keys().map(text).collect() }
    };
    let objects = body.objects.iter().filter(|_| options.wants_cells);
    let cells = objects.filter_map(|(place, _)| sheet.rows.get(*place)).map(texts).collect();
    let left_out = body.left_out;
    Ok(Reading {
        inventory,
        columns: columns_read,
        header_row: sheet.header.row,
        left_out,
        mapping_file,
        headings: sheet.header.headings.iter().map(|(index, text)| (letters(*index as usize), text.clone())).collect(),
        cells,
    })
}

/// Finds floors where the list has no shares of the height.
fn floor_finder(floors: &Floors, columns: &Understood, rows: &[Row], body: &Body) -> Option<FloorFinder> {
    if columns.get(Column::LevelRatio).is_some() {
        return None;
    }
    let names = match columns.get(Column::Floor) {
        Some(one) => {
            let rows = body.objects.iter().filter_map(|(place, _)| rows.get(*place));
            let mut names: Vec<String> = rows.filter_map(|row| Some(row.get(one.index)?.shown())).collect();
            names.sort_unstable();
            names.dedup();
            names
        }
        None => body.sections.clone(),
    };
    Some(FloorFinder::new(floors, &names, columns.is_imperial, columns.is_japanese))
}

/// At most so many columns and cells are carried through as fit into memory.
fn bound_carried(columns: &mut Understood, objects: usize) {
    let most = MAX_CARRIED.min(MAX_CARRIED_CELLS / objects.max(1));
    if columns.carried.len() > most {
        let dropped = columns.carried.len() - most;
        columns
            .warnings
            .push(format!("{dropped} columns that are not read are left out: at most {most} are carried through"));
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
            let words = canonical(heading.split(['(', '[']).next().unwrap_or_default()).replace(' ', "_");
            // Short words resemble too many names.
            let near = nearest(&words, &names).filter(|_| words.chars().count() > 3 && heading.len() < 100)?;
            let place = format!("column {} ({})", letters(*index as usize), shorten(heading));
            Some(format!("{place} is not read, only carried through: did you mean {near}?"))
        })
        .collect();
    let has = |column: Column| columns.get(column).is_some() || columns.get(Column::Dimensions).is_some();
    let is_round = columns.get(Column::Diameter).is_some();
    for (column, what) in [(Column::Height, "heights"), (Column::Thickness, "depths (thicknesses)")] {
        if !has(column) && !(is_round && column == Column::Thickness) {
            said.push(format!("the list has no column of {what} that is known: objects without it have no verdict"));
        }
    }
    said
}

/// The cells of other columns, unchanged.
fn carried(values: &mut Values<'_>, sheet: &Sheet) -> Vec<String> {
    let row = values.row;
    let columns = values.columns;
    let mut carried = vec![String::new(); columns.carried.len()];
    // In a CSV a number with a decimal comma that is not in quotes moves every cell after it.
    if let (Some(width), Some(_)) = (sheet.header.width, sheet.separator)
        && row.cells.iter().any(|(index, cell)| *index >= width && !cell.is_blank())
    {
        let count = row.cells.last().map_or(0, |(index, _)| index + 1);
        let detail = format!("has {count} cells for {width} headings, so its numbers are not used");
        values.findings.add(Kind::Unreadable, Place::ROW, Some(row.number), "", Some(detail));
        let hint = "put cells that contain the separator in quotes, or give every column a heading";
        values.findings.hint(Kind::Unreadable, Place::ROW, hint.to_owned());
        values.is_shifted = true;
    }
    for (index, cell) in &row.cells {
        if let Ok(at) = columns.carried.binary_search_by_key(index, |(index, _)| *index) {
            match cell {
                Cell::Error(_) => {
                    values.findings.note("an error such as #REF! in a column that is carried through", row.number)
                }
                Cell::Unevaluated | Cell::TooLong(_) => {
                    values.findings.note("a cell without a value in a column that is carried through", row.number);
                }
                _ => {}
            }
            if let Some(slot) = carried.get_mut(at) {
                *slot = cell.shown();
            }
        } else if !sheet.header.headings.contains_key(index) && !cell.is_blank() && !values.is_shifted {
            values.findings.note("cells in columns without a heading are not read", row.number);
        }
    }
    carried
}

/// Gives later rows with an id that occurred before a number: no output could tell them apart.
fn tell_duplicates(items: &mut [Item], columns: &Understood, findings: &mut Findings) {
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
        let place = match columns.get(Column::Id) {
            Some(one) => Place { column: Some(Column::Id), index: Some(one.index), heading: Some(&one.heading) },
            None => Place::ROW,
        };
        findings.add(Kind::DuplicateId, place, Some(item.row), &item.id, None);
        seen.insert(item.id.clone(), number);
        item.id = format!("{} #{number}", item.id);
        seen.insert(item.id.clone(), 1);
        item.doubts.push(Kind::DuplicateId);
    }
}

fn columns_read(columns: &Understood, counts: &[(usize, usize)]) -> Vec<ColumnRead> {
    let one = |(one, (values, missing)): (&super::understood::Use, &(usize, usize))| {
        let has_unit = dimension(one.column).is_some_and(|dimension| dimension != Dimension::Ratio);
        ColumnRead {
            letter: letters(one.index as usize),
            heading: one.heading.clone(),
            name: one.column.name(),
            unit: one.unit.map(|unit| unit.symbol().to_owned()),
            unit_source: one.unit_source.map(|source| source.name()).or(has_unit.then_some("cell")),
            dialect: one.dialect.name(),
            values: *values,
            missing: *missing,
        }
    };
    columns.uses.iter().zip(counts).map(one).collect()
}
