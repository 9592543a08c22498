//! `freestand inventory check`: shows how a list was understood.

use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand_assess::inventory::{
    Casters, Finding, Inventory, Item, Mapping, Rating, ReadOptions, Reading, console_lines, inspect_inventory,
    marked_copy,
};
use freestand_assess::job::floors_of;
use freestand_assess::library::Libraries;
use freestand_input::keys::KeyStyle;
use freestand_input::problem::Problems;
use freestand_input::quantity::{Dimension, format_si, shorten};
use freestand_input::words::counted;
use freestand_output::folder::write_file;
use freestand_study::cushion::cushion_words;
use freestand_study::resolve::{Overrides, load};
use serde::Serialize;

use super::SCHEMA;
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, pairs, table};
use crate::reading::path_text;

/// Read a list of objects and show how it was understood, with all its problems
#[derive(Debug, Args)]
#[command(after_help = "\
Reads CSV, TSV and XLSX with headings in English, German, French, Spanish, Italian or Japanese;
see docs/inventory.md. Exit status: 0 no errors, 1 some cells have errors, 2 the file is no list.

Examples:
  freestand inventory check objects.csv
  freestand inventory check register.xlsx --sheet \"Ward 3\" --storeys 6 --json
  freestand inventory check register.xlsx --out checked      (writes checked/checked.xlsx)
  freestand inventory check register.xlsx --write-columns map.toml
  freestand inventory check register.xlsx --columns map.toml")]
pub(crate) struct CheckArgs {
    /// List of objects (CSV, TSV or XLSX)
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Sheet of the workbook [default: the one with the best headings]
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
    /// Mapping file (TOML) that says what columns, floors and numbers mean
    #[arg(long, value_name = "MAP.toml")]
    columns: Option<PathBuf>,
    /// Write a mapping file to edit
    #[arg(long, value_name = "MAP.toml")]
    write_columns: Option<PathBuf>,
    /// Study file (TOML) whose building has the floors
    #[arg(long, value_name = "STUDY.toml")]
    study: Option<PathBuf>,
    /// Number of storeys of the building, to place floors by their numbers
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=500))]
    storeys: Option<u16>,
    /// Count every doubt as an error
    #[arg(long)]
    strict: bool,
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
    objects: Vec<ObjectReport>,
    left_out: Vec<LeftOutReport>,
    problems: Vec<ProblemReport>,
    marked_copy: Option<String>,
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
    unit_source: Option<&'static str>,
    dialect: Option<&'static str>,
    values: usize,
    missing: usize,
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

/// An object, in SI; what the list does not say is `null`.
#[derive(Debug, Serialize)]
struct ObjectReport {
    row: u32,
    section: Option<String>,
    id: String,
    item: Option<String>,
    quantity: u32,
    building: Option<String>,
    floor: Option<String>,
    room: Option<String>,
    level_ratio: Option<f64>,
    height_m: Option<f64>,
    thickness_m: Option<f64>,
    width_m: Option<f64>,
    cg_height_m: Option<f64>,
    mass_kg: Option<f64>,
    stiffness_n_m: Option<f64>,
    tolerance_g: Option<f64>,
    tolerance_duration_s: Option<f64>,
    anchored: Option<bool>,
    life_safety: Option<&'static str>,
    property: Option<&'static str>,
    function: Option<&'static str>,
    rests_on: Option<String>,
    wall_gap_m: Option<f64>,
    neighbour_gap_m: Option<f64>,
    casters: Option<&'static str>,
    clearance_m: Option<f64>,
    doubts: Vec<&'static str>,
}

#[derive(Debug, Serialize)]
struct LeftOutReport {
    row: u32,
    kind: &'static str,
    text: String,
}

#[derive(Debug, Serialize)]
struct ProblemReport {
    severity: &'static str,
    kind: &'static str,
    column: Option<&'static str>,
    heading: Option<String>,
    count: usize,
    rows: Vec<u32>,
    cells: Vec<String>,
    examples: Vec<String>,
    message: String,
    hint: String,
}

pub(crate) fn run(args: &CheckArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let inputs: Vec<PathBuf> =
        [Some(&args.file), args.columns.as_ref(), args.study.as_ref()].into_iter().flatten().cloned().collect();
    let files = Files::begin(global, &inputs)?;
    let libraries = Libraries::with_files(args.library.as_deref(), args.cushion_library.as_deref())?;
    let mapping = args.columns.as_deref().map(Mapping::load).transpose()?;
    let storeys = args.storeys.map(usize::from);
    let floors = match &args.study {
        Some(path) => floors_of(&load(path, &Overrides::default())?, storeys),
        None => freestand_assess::inventory::Floors { storeys, ..Default::default() },
    };
    let (reading, copy) = libraries.looked_up(|lookup| -> Result<_, Problems> {
        let options = ReadOptions {
            sheet: args.sheet.as_deref(),
            mapping: mapping.as_ref(),
            floors,
            is_strict: args.strict,
            lookup,
        };
        let reading = inspect_inventory(&args.file, &options)?;
        let copy =
            if files.wanted() { Some(marked_copy(&args.file, &options, &reading.inventory.findings)?) } else { None };
        Ok((reading, copy))
    })?;
    if let Some(path) = &args.write_columns {
        write_file(path, reading.mapping_file.as_bytes(), &inputs)?;
    }
    let marked_copy = match &copy {
        Some(bytes) => files.write("checked.xlsx", || bytes)?,
        None => None,
    };
    let report = report(&reading, marked_copy);
    let inventory = &reading.inventory;
    printer.said(&console_lines(&inventory.findings));
    files.print(printer, SCHEMA, &report, &inventory.warnings, || text(&report, inventory))?;
    Ok(Done { criterion_met: !inventory.has_errors() })
}

fn report(reading: &Reading, marked_copy: Option<String>) -> CheckReport {
    let inventory = &reading.inventory;
    let columns = reading.columns.iter().map(|column| ColumnReport {
        column: column.letter.clone(),
        heading: column.heading.clone(),
        name: column.name,
        unit: column.unit.clone(),
        unit_source: column.unit_source,
        dialect: column.dialect,
        values: column.values,
        missing: column.missing,
    });
    let left_out = reading.left_out.iter().map(|left| LeftOutReport {
        row: left.row,
        kind: left.kind.name(),
        text: left.text.clone(),
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
        objects: inventory.items.iter().map(object).collect(),
        left_out: left_out.collect(),
        problems: inventory.findings.iter().map(problem).collect(),
        marked_copy,
    }
}

fn problem(finding: &Finding) -> ProblemReport {
    ProblemReport {
        severity: finding.severity.name(),
        kind: finding.kind.name(),
        column: finding.column.map(|column| column.name()),
        heading: finding.heading.clone(),
        count: finding.rows.len(),
        rows: finding.rows.clone(),
        cells: finding.cells(),
        examples: finding.examples.clone(),
        message: KeyStyle::Flag.shown(&finding.message()),
        hint: KeyStyle::Flag.shown(&finding.hint),
    }
}

fn object(item: &Item) -> ObjectReport {
    let text = |text: &str| (!text.is_empty()).then(|| text.to_owned());
    let rated = |rating: Option<Rating>| rating.map(Rating::name);
    let tolerance = item.tolerance.as_ref();
    ObjectReport {
        row: item.row,
        section: text(&item.section),
        id: item.id.clone(),
        item: text(&item.item),
        quantity: item.quantity,
        building: text(&item.building),
        floor: text(&item.floor),
        room: text(&item.room),
        level_ratio: item.level_ratio,
        height_m: item.height_m,
        thickness_m: item.thickness_m,
        width_m: item.width_m,
        cg_height_m: item.cg_height_m,
        mass_kg: item.mass_kg,
        stiffness_n_m: item.cushion.as_ref().and_then(|edge| edge.cushion.linear_stiffness_n_m()),
        tolerance_g: tolerance.and_then(|tolerance| tolerance.peak_m_s2).map(|peak| peak / G0_M_S2),
        tolerance_duration_s: tolerance.and_then(|tolerance| tolerance.duration_s),
        anchored: item.anchored,
        life_safety: rated(item.consequences.life_safety),
        property: rated(item.consequences.property),
        function: rated(item.consequences.function),
        rests_on: text(&item.rests_on),
        wall_gap_m: item.surroundings.wall_gap_m,
        neighbour_gap_m: item.surroundings.neighbour_gap_m,
        casters: item.surroundings.casters.map(Casters::name),
        clearance_m: item.surroundings.clearance_m,
        doubts: item.doubts.iter().map(|kind| kind.name()).collect(),
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
            let unit = match (&one.unit, one.unit_source) {
                (Some(unit), Some("heading")) => unit.clone(),
                (Some(unit), Some(source)) => format!("{unit} ({source})"),
                (None, Some(_)) => "in each cell".to_owned(),
                _ => String::new(),
            };
            let dialect = one.dialect.unwrap_or_default().to_owned();
            let (values, missing) = (one.values.to_string(), one.missing.to_string());
            vec![one.column.clone(), one.heading.clone(), one.name.to_owned(), unit, dialect, values, missing]
        })
        .collect();
    let left_out: Vec<Vec<String>> = report
        .left_out
        .iter()
        .take(SHOWN)
        .map(|left| vec![left.row.to_string(), left.kind.to_owned(), shorten(&left.text)])
        .collect();
    let shown: Vec<Vec<String>> = inventory.items.iter().take(SHOWN).map(line).collect();
    let headings = ["row", "id", "item", "level", "height", "thickness", "width", "mass", "cushion", "tolerance"];
    let mut text = pairs(&facts);
    text += "\n";
    text += &table(&["column", "heading", "meaning", "unit", "decimal sign", "values", "missing"], &columns);
    if !left_out.is_empty() {
        text += "\nrows that are not objects\n";
        text += &table(&["row", "kind", "text"], &left_out);
        if report.left_out.len() > SHOWN {
            text += &format!("and {} more\n", report.left_out.len() - SHOWN);
        }
    }
    text += "\n";
    text += &table(&headings, &shown);
    if inventory.items.len() > SHOWN {
        text += &format!("and {} more\n", inventory.items.len() - SHOWN);
    }
    if let Some(path) = &report.marked_copy {
        text += &format!("\nmarked copy: {path}\n");
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
