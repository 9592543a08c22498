//! `freestand inventory check`: shows how an inventory was understood.

use std::path::PathBuf;

use clap::Args;
use freestand_assess::inventory::{Inventory, Item, Reading, inspect_inventory};
use freestand_assess::library::Libraries;
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::counted;
use freestand_study::cushion::cushion_words;
use serde::Serialize;

use super::SCHEMA;
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, pairs, table};
use crate::reading::path_text;

/// Read an inventory and show how it was understood, with all its problems
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand inventory check objects.csv
  freestand inventory check register.xlsx --sheet \"Ward 3\" --json")]
pub(crate) struct CheckArgs {
    /// Inventory (CSV or XLSX)
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Sheet of the workbook [default: the first with headings of an inventory]
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
    /// Your own tolerance library (CSV); its entries replace built-in entries with the same id
    #[arg(long, value_name = "FILE.csv")]
    library: Option<PathBuf>,
    /// Your own cushion library (CSV); its entries replace built-in entries with the same id
    #[arg(long, value_name = "FILE.csv")]
    cushion_library: Option<PathBuf>,
}

/// Number of rows that are shown.
const SHOWN: usize = 10;

#[derive(Debug, Serialize)]
struct CheckReport {
    path: String,
    sha256: String,
    sheet: Option<String>,
    header_row: u32,
    counts: Counts,
    columns: Vec<ColumnReport>,
    carried: Vec<String>,
    /// The first rows, in SI.
    first_rows: Vec<RowReport>,
}

/// How many rows have each kind of value.
#[derive(Debug, Default, Serialize)]
struct Counts {
    rows: usize,
    /// The sum of the quantities of all rows.
    objects: u64,
    with_size: usize,
    with_level: usize,
    with_width: usize,
    with_mass: usize,
    with_cushion: usize,
    with_tolerance: usize,
}

#[derive(Debug, Serialize)]
struct ColumnReport {
    column: String,
    heading: String,
    name: &'static str,
    unit: Option<String>,
}

#[derive(Debug, Serialize)]
struct RowReport {
    row: u32,
    id: String,
    item: String,
    quantity: u32,
    level_ratio: Option<f64>,
    height_m: Option<f64>,
    thickness_m: Option<f64>,
    width_m: Option<f64>,
    mass_kg: Option<f64>,
    stiffness_n_m: Option<f64>,
    cushion: Option<String>,
    tolerance_m_s2: Option<f64>,
    tolerance_duration_s: Option<f64>,
    tolerance_source: Option<String>,
}

pub(crate) fn run(args: &CheckArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let files = Files::begin(global, std::slice::from_ref(&args.file))?;
    let libraries = Libraries::with_files(args.library.as_deref(), args.cushion_library.as_deref())?;
    let reading = libraries.looked_up(|lookup| inspect_inventory(&args.file, args.sheet.as_deref(), lookup))?;
    let report = report(&reading);
    files.print(printer, SCHEMA, &report, &reading.inventory.warnings, || text(&report, &reading.inventory))?;
    Ok(Done::OK)
}

fn report(reading: &Reading) -> CheckReport {
    let inventory = &reading.inventory;
    let columns = reading.columns.iter().map(|column| ColumnReport {
        column: column.letter.clone(),
        heading: column.heading.clone(),
        name: column.name,
        unit: column.unit.clone(),
    });
    CheckReport {
        path: path_text(&inventory.path),
        sha256: inventory.sha256.clone(),
        sheet: inventory.sheet.clone(),
        header_row: reading.header_row,
        counts: counts(&inventory.items),
        columns: columns.collect(),
        carried: inventory.carried.clone(),
        first_rows: inventory.items.iter().take(SHOWN).map(row).collect(),
    }
}

fn counts(items: &[Item]) -> Counts {
    let mut counts = Counts { rows: items.len(), ..Counts::default() };
    for item in items {
        counts.objects += u64::from(item.quantity);
        counts.with_size += usize::from(item.height_m.is_some() && item.thickness_m.is_some());
        counts.with_level += usize::from(item.level_ratio.is_some());
        counts.with_width += usize::from(item.width_m.is_some());
        counts.with_mass += usize::from(item.mass_kg.is_some());
        counts.with_cushion += usize::from(item.cushion.is_some());
        counts.with_tolerance += usize::from(item.tolerance.is_some());
    }
    counts
}

fn row(item: &Item) -> RowReport {
    let cushion = item.cushion.as_ref().map(|edge| &edge.cushion);
    let tolerance = item.tolerance.as_ref();
    RowReport {
        row: item.row,
        id: item.id.clone(),
        item: item.item.clone(),
        quantity: item.quantity,
        level_ratio: item.level_ratio,
        height_m: item.height_m,
        thickness_m: item.thickness_m,
        width_m: item.width_m,
        mass_kg: item.mass_kg,
        stiffness_n_m: cushion.and_then(|cushion| cushion.linear_stiffness_n_m()),
        cushion: cushion.map(cushion_words),
        tolerance_m_s2: tolerance.and_then(|tolerance| tolerance.peak_m_s2),
        tolerance_duration_s: tolerance.and_then(|tolerance| tolerance.duration_s),
        tolerance_source: tolerance.map(|tolerance| tolerance.source.clone()),
    }
}

fn text(report: &CheckReport, inventory: &Inventory) -> String {
    let counts = &report.counts;
    let of = |count: usize| format!("{count} of {}", counts.rows);
    let mut facts = vec![
        ("file", report.path.clone()),
        ("headings", format!("row {}", report.header_row)),
        ("rows", format!("{} ({})", counts.rows, counted(counts.objects as usize, "object"))),
        ("with height and thickness", of(counts.with_size)),
        ("with a level", of(counts.with_level)),
        ("with a width (both axes)", of(counts.with_width)),
        ("with a mass", of(counts.with_mass)),
        ("with a cushion", of(counts.with_cushion)),
        ("with a tolerance", of(counts.with_tolerance)),
    ];
    if let Some(sheet) = &report.sheet {
        facts.insert(1, ("sheet", sheet.clone()));
    }
    if !report.carried.is_empty() {
        facts.push(("carried through", report.carried.join(", ")));
    }
    let columns: Vec<Vec<String>> = report
        .columns
        .iter()
        .map(|one| {
            let unit = one.unit.clone().unwrap_or_default();
            vec![one.column.clone(), one.heading.clone(), one.name.to_owned(), unit]
        })
        .collect();
    let shown: Vec<Vec<String>> = inventory.items.iter().take(SHOWN).map(line).collect();
    let headings = ["row", "id", "item", "level", "height", "thickness", "width", "mass", "cushion", "tolerance"];
    let mut text = pairs(&facts);
    text += "\n";
    text += &table(&["column", "heading", "meaning", "unit"], &columns);
    text += "\n";
    text += &table(&headings, &shown);
    if inventory.items.len() > SHOWN {
        text += &format!("and {} more\n", inventory.items.len() - SHOWN);
    }
    text
}

fn line(item: &Item) -> Vec<String> {
    let value = |value: Option<f64>, dimension| value.map_or_else(|| "-".to_owned(), |v| format_si(v, dimension));
    let tolerance = item.tolerance.as_ref().and_then(|tolerance| tolerance.peak_m_s2);
    let name: String = item.item.chars().take(30).collect();
    vec![
        item.row.to_string(),
        item.id.clone(),
        name,
        value(item.level_ratio, Dimension::Ratio),
        value(item.height_m, Dimension::Length),
        value(item.thickness_m, Dimension::Length),
        value(item.width_m, Dimension::Length),
        value(item.mass_kg, Dimension::Mass),
        item.cushion.as_ref().map_or_else(|| "-".to_owned(), |edge| cushion_words(&edge.cushion)),
        value(tolerance, Dimension::Acceleration),
    ]
}
