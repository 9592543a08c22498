//! `freestand inventory template`: an inventory to fill in.

use std::path::PathBuf;

use clap::Args;
use freestand_assess::inventory::{COLUMNS, template_csv, template_xlsx};
use serde::Serialize;

use super::{Format, SCHEMA, check_place, place};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Write an inventory to fill in, with units and three examples; without a file, it is printed as
/// CSV
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand inventory template > objects.csv
  freestand inventory template --xlsx objects.xlsx
  freestand inventory template --xlsx --out hospital")]
pub(crate) struct TemplateArgs {
    /// File to write; a name that ends in .xlsx makes it a workbook
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    /// Write a workbook, with a sheet that explains the columns
    #[arg(long)]
    xlsx: bool,
    /// Write CSV
    #[arg(long, conflicts_with = "xlsx")]
    csv: bool,
}

#[derive(Debug, Serialize)]
struct TemplateReport {
    format: &'static str,
    path: Option<String>,
    columns: Vec<ColumnReport>,
    /// The text, if it was not written to a file.
    text: Option<String>,
}

#[derive(Debug, Serialize)]
struct ColumnReport {
    name: &'static str,
    unit: Option<&'static str>,
    required: bool,
    meaning: &'static str,
}

pub(crate) fn run(
    args: &TemplateArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let named = args.file.as_deref().and_then(Format::of);
    let format = match (args.xlsx, args.csv) {
        (true, _) => Format::Xlsx,
        (_, true) => Format::Csv,
        _ => named.unwrap_or(Format::Csv),
    };
    check_place(format, args.file.as_ref(), global)?;
    let files = Files::begin(global, &[])?;
    let bytes = match format {
        Format::Csv => template_csv()?,
        Format::Xlsx => template_xlsx()?,
    };
    let placed = place(&bytes, format, args.file.as_ref(), global, &files, &[])?;
    let columns = COLUMNS.iter().map(|spec| ColumnReport {
        name: spec.name,
        unit: (!spec.unit.is_empty()).then_some(spec.unit),
        required: spec.is_required,
        meaning: spec.meaning,
    });
    let report = TemplateReport {
        format: format.name(),
        path: placed.path,
        columns: columns.collect(),
        text: placed.text,
    };
    files.print(printer, SCHEMA, &report, &[], || {
        super::shown(&report.text, &report.path)
    })?;
    Ok(Done::OK)
}
