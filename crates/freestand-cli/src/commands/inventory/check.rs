//! `freestand inventory check`: shows how a list was understood.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_app::check_list::{CheckList, HeadingsReport, Meant, SCHEMA};
use freestand_input::keys::KeyStyle;
use freestand_input::problem::Problems;
use freestand_input::quantity::{Dimension, UnitSystem, format_si, shorten};
use freestand_input::words::counted;
use freestand_inventory::{
    CheckReport, Inventory, Item, Kind, SHOWN, check_report, console_lines, mapping_of_headings,
    senses,
};
use freestand_output::folder::write_file;
use freestand_study::cushion::cushion_words;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::files::path_text;
use crate::printer::{Printer, pairs, table};

/// Read a list of objects and show how it was understood, with all its problems
#[derive(Debug, Args)]
#[command(after_help = "\
Reads CSV, TSV and XLSX with headings in English, German, French, Spanish, Italian, Portuguese,
Turkish, Japanese or Chinese; see docs/inventory.md. Exit status: 0 no errors, 1 some cells have errors, 2 the file is not a list.

Examples:
  freestand inventory check objects.csv
  freestand inventory check register.xlsx --sheet \"Ward 3\" --storeys 6 --json
  freestand inventory check register.xlsx --out checked      (writes checked/checked.xlsx)
  freestand inventory check register.xlsx --edit \"D7=900 mm\"
  freestand inventory check register.xlsx --write-columns map.toml
  freestand inventory check register.xlsx --columns map.toml")]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(super) request: CheckList,
    #[command(flatten)]
    pub(super) output: MappingArgs,
}

/// The mapping file that is written.
#[derive(Debug, Default, Args)]
pub(crate) struct MappingArgs {
    /// Write a mapping file to edit, also where too few headings are known to read the list
    #[arg(long, value_name = "MAP.toml")]
    write_columns: Option<PathBuf>,
}

impl Tell for CheckList {
    type Output = MappingArgs;

    fn tell(
        meant: Meant,
        MappingArgs { write_columns }: &MappingArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, &meant.inputs)?;
        let write_columns = write_columns.as_deref();
        if meant.is_headings {
            return headings(&meant, write_columns, files, printer);
        }
        let unread = |problems| unread(&meant, write_columns, problems);
        let (reading, copy) = meant.reading(meant.floors()?, files.wanted(), unread)?;
        if let Some(path) = write_columns {
            write_file(path, reading.mapping_file.as_bytes(), &meant.inputs)?;
        }
        let marked_copy = match &copy {
            Some(bytes) => files.write("checked.xlsx", || bytes)?,
            None => None,
        };
        let report = check_report(&reading, marked_copy, KeyStyle::Flag);
        let inventory = &reading.inventory;
        printer.said(&console_lines(&inventory.findings));
        files.print(printer, SCHEMA, &report, &inventory.warnings, || {
            text(&report, inventory, meant.units.unwrap_or(reading.units))
        })?;
        Ok(Done {
            criterion_met: !inventory.has_errors(),
        })
    }
}

fn headings(
    meant: &Meant,
    write_columns: Option<&Path>,
    files: Files,
    printer: &Printer,
) -> Result<Done, Failure> {
    let headings = meant.headings()?;
    if let Some(path) = write_columns {
        write_file(
            path,
            mapping_of_headings(&headings).as_bytes(),
            &meant.inputs,
        )?;
    }
    let report = HeadingsReport {
        path: path_text(&meant.file),
        headings,
        senses: senses(),
    };
    let lines: Vec<Vec<String>> = report
        .headings
        .iter()
        .map(|one| {
            let name = one.name.unwrap_or("-").to_owned();
            vec![
                one.column.clone(),
                one.heading.clone(),
                name,
                one.samples.join(" | "),
            ]
        })
        .collect();
    files.print(printer, SCHEMA, &report, &[], || {
        table(&["column", "heading", "meaning", "examples"], &lines)
    })?;
    Ok(Done::OK)
}

/// A list that cannot be read, because too few of its headings are known: its mapping file is written all
/// the same, to be completed.
fn unread(meant: &Meant, write_columns: Option<&Path>, problems: Problems) -> Problems {
    let (Some(path), None) = (write_columns, &meant.cells.columns) else {
        return problems;
    };
    let Ok(headings) = meant.headings() else {
        return problems;
    };
    let mapping = mapping_of_headings(&headings);
    if let Err(unwritten) = write_file(path, mapping.as_bytes(), &meant.inputs) {
        return unwritten.into();
    }
    let unknown = headings.iter().filter(|one| one.name.is_none()).count();
    let hint = format!(
        "{} was written: put the names of {} into it, and give it as `columns`",
        path.display(),
        counted(unknown, "heading")
    );
    let problems = problems.into_iter();
    problems.map(|problem| problem.hint(hint.clone())).collect()
}

fn text(report: &CheckReport, inventory: &Inventory, units: UnitSystem) -> String {
    let counts = &report.counts;
    let of = |count: usize| format!("{count} of {}", counts.rows);
    let mut facts = vec![
        ("file", report.path.clone()),
        ("headings", format!("row {}", report.header_row)),
        (
            "rows",
            format!(
                "{} ({})",
                counts.rows,
                counted(counts.objects as usize, "object")
            ),
        ),
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
            vec![
                one.letter.clone(),
                one.heading.clone(),
                one.name.to_owned(),
                unit,
                dialect,
                values,
                missing,
            ]
        })
        .collect();
    let left_out: Vec<Vec<String>> = report
        .left_out
        .iter()
        .take(SHOWN)
        .map(|left| {
            vec![
                left.row.to_string(),
                left.kind.to_owned(),
                shorten(&left.text),
            ]
        })
        .collect();
    let shown: Vec<Vec<String>> = inventory
        .items
        .iter()
        .take(SHOWN)
        .map(|item| line(item, units))
        .collect();
    let headings = [
        "row",
        "id",
        "item",
        "level",
        "height",
        "thickness",
        "width",
        "mass",
        "cushion",
        "tolerance",
    ];
    let mut text = pairs(&facts);
    text += "\n";
    text += &table(
        &[
            "column",
            "heading",
            "meaning",
            "unit",
            "decimal sign",
            "values",
            "missing",
        ],
        &columns,
    );
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

fn line(item: &Item, units: UnitSystem) -> Vec<String> {
    let value = |value: Option<f64>, dimension| {
        value.map_or_else(
            || "-".to_owned(),
            |value| match (units, dimension) {
                (UnitSystem::Us, Dimension::Length) => units.length(value),
                (UnitSystem::Us, Dimension::Mass) => units.mass(value),
                _ => format_si(value, dimension),
            },
        )
    };
    let tolerance = item
        .tolerance
        .as_ref()
        .and_then(|tolerance| tolerance.peak_m_s2);
    let name: String = item.item.chars().take(30).collect();
    let is_hidden = item.doubts.contains(&Kind::HiddenRow);
    vec![
        if is_hidden {
            format!("{} (hidden)", item.row)
        } else {
            item.row.to_string()
        },
        item.id.clone(),
        name,
        value(item.level_ratio, Dimension::Ratio),
        value(item.height_m, Dimension::Length),
        value(item.thickness_m, Dimension::Length),
        value(item.width_m, Dimension::Length),
        value(item.mass_kg, Dimension::Mass),
        item.cushion
            .as_ref()
            .map_or_else(|| "-".to_owned(), |edge| cushion_words(&edge.cushion)),
        value(tolerance, Dimension::Acceleration),
    ]
}
