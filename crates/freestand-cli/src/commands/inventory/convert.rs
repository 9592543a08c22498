//! `freestand inventory convert`: CSV to XLSX and back.

use std::path::PathBuf;

use clap::Args;
use freestand_assess::inventory::convert_inventory;
use serde::Serialize;

use super::{Format, SCHEMA, check_place, place};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;
use crate::reading::path_text;

/// Convert an inventory to CSV or XLSX; every cell is kept
#[derive(Debug, Args)]
#[command(after_help = "\
Writes OUTFILE, or a file into the folder of --out; without either, CSV is printed. Text that a
spreadsheet would read as a formula (= + - @) gets a leading ' in CSV, which is removed when the
file is read again.

Examples:
  freestand inventory convert objects.xlsx --to csv > objects.csv
  freestand inventory convert objects.csv --to xlsx objects.xlsx")]
pub(crate) struct ConvertArgs {
    /// Inventory (CSV or XLSX)
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// File to write
    #[arg(value_name = "OUTFILE")]
    to_file: Option<PathBuf>,
    /// Format to write
    #[arg(long, value_enum)]
    to: Format,
    /// Sheet of the workbook [default: the first with headings of an inventory]
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
}

#[derive(Debug, Serialize)]
struct ConvertReport {
    source: String,
    format: &'static str,
    path: Option<String>,
    rows: usize,
    columns: usize,
    /// The text, if it was not written to a file.
    text: Option<String>,
}

pub(crate) fn run(
    args: &ConvertArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    check_place(args.to, args.to_file.as_ref(), global)?;
    let inputs = [args.file.clone()];
    let files = Files::begin(global, &inputs)?;
    let converted = convert_inventory(&args.file, args.sheet.as_deref(), args.to.target())?;
    let placed = place(
        &converted.bytes,
        args.to,
        args.to_file.as_ref(),
        global,
        &files,
        &inputs,
    )?;
    let report = ConvertReport {
        source: path_text(&args.file),
        format: args.to.name(),
        path: placed.path,
        rows: converted.rows,
        columns: converted.columns,
        text: placed.text,
    };
    files.print(printer, SCHEMA, &report, &converted.warnings, || {
        super::shown(&report.text, &report.path)
    })?;
    Ok(Done::OK)
}
