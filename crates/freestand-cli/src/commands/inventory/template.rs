//! `freestand inventory template`: an inventory to fill in.

use std::path::PathBuf;

use clap::Args;
use freestand_app::inventory::{ColumnReport, FORMATS, InventoryTemplate, TemplateReport};
use freestand_input::words::name_of;
use freestand_inventory::{COLUMNS, Target, template_csv, template_xlsx};

use super::{SCHEMA, check_place, format_of, place};
use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Write an inventory to fill in, with units and three examples; without a file, it is printed as
/// CSV
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/inventory_template.txt").trim_end())]
pub(crate) struct TemplateArgs {
    #[command(flatten)]
    pub(super) output: NewFile,
    #[command(flatten)]
    pub(super) request: InventoryTemplate,
}

/// The file that is written.
#[derive(Debug, Default, Args)]
pub(crate) struct NewFile {
    /// File to write; a name that ends in .xlsx makes it a workbook, and one that exists is replaced with
    /// --force alone
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
}

impl Tell for InventoryTemplate {
    type Output = NewFile;

    fn tell(
        format: Option<Target>,
        NewFile { file }: &NewFile,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let file = file.as_deref();
        let format = format.or(file.and_then(format_of)).unwrap_or(Target::Csv);
        check_place(format, file, global, &[])?;
        let files = Files::begin(global, &[])?;
        let bytes = match format {
            Target::Csv => template_csv()?,
            Target::Xlsx => template_xlsx()?,
        };
        let placed = place(&bytes, format, file, &files, &[])?;
        let columns = COLUMNS.iter().map(|spec| ColumnReport {
            name: spec.name,
            unit: (!spec.unit.is_empty()).then_some(spec.unit),
            required: spec.is_required,
            meaning: spec.meaning,
        });
        let report = TemplateReport {
            format: name_of(FORMATS, format),
            path: placed.path,
            columns: columns.collect(),
            text: placed.text,
        };
        files.print(printer, SCHEMA, &report, &[], || {
            super::shown(&report.text, &report.path)
        })?;
        Ok(Done::OK)
    }
}
