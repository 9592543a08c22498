//! `freestand inventory convert`: CSV to XLSX and back.

use std::path::PathBuf;
use std::slice;

use clap::Args;
use freestand_app::inventory::{Conversion, ConvertReport, FORMATS, InventoryConvert};
use freestand_input::words::name_of;
use freestand_inventory::convert_inventory;

use super::{SCHEMA, check_place, place};
use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::files::path_text;
use crate::printer::Printer;

/// Convert an inventory to CSV or XLSX; every cell is kept
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/inventory_convert.txt").trim_end())]
pub(crate) struct ConvertArgs {
    #[command(flatten)]
    pub(super) request: InventoryConvert,
    #[command(flatten)]
    pub(super) output: OutFile,
}

/// The file that is written.
#[derive(Debug, Default, Args)]
pub(crate) struct OutFile {
    /// File to write; one that exists is replaced with --force alone
    #[arg(value_name = "OUTFILE")]
    to_file: Option<PathBuf>,
}

impl Tell for InventoryConvert {
    type Output = OutFile;

    fn tell(
        Conversion { file, to, sheet }: Conversion,
        OutFile { to_file }: &OutFile,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let to_file = to_file.as_deref();
        let inputs = slice::from_ref(&file);
        check_place(to, to_file, global, inputs)?;
        let files = Files::begin(global, inputs)?;
        let converted = convert_inventory(&file, sheet.as_deref(), to)?;
        let placed = place(&converted.bytes, to, to_file, &files, inputs)?;
        let report = ConvertReport {
            source: path_text(&file),
            format: name_of(FORMATS, to),
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
}
