//! `freestand restrain`: how strongly one object, or each of a list, must be held.

use clap::Args;
use freestand_app::restrain::{Asked, Meant, Restrain, SCHEMA};
use freestand_assess::restrain::{restrain, restrain_list};
use freestand_report::restraint::{
    restrain_list_report, restrain_report, restraint_sheet, restraint_sheets, restraint_text,
    restraint_workbook, restraints_text,
};

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Calculate the force that the code asks a restraint to carry, and its anchors, on a sheet to print
///
/// The clause for parts of the place's code gives the force; the factors that are not stated are
/// assumed, and every one is printed with who says so. The formulas are those of `assess`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/restrain.txt").trim_end())]
pub(crate) struct RestrainArgs {
    #[command(flatten)]
    pub(super) request: Restrain,
}

const SHEET: &str = "restraint.html";
const WORKBOOK: &str = "restraint.xlsx";

impl Tell for Restrain {
    type Output = ();

    fn tell(
        mut meant: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let inputs = std::mem::take(&mut meant.inputs);
        let signing = meant.signing;
        match meant.asked()? {
            Asked::One(one) => {
                let mut report = restrain_report(restrain(one)?);
                let files = Files::begin(global, &inputs)?;
                report.sheet_path = files.write(SHEET, || restraint_sheet(&report, signing))?;
                files.print(printer, SCHEMA, &report, &report.warnings, || {
                    restraint_text(&report)
                })?;
            }
            Asked::List(list) => {
                let mut report = restrain_list_report(restrain_list(&list)?);
                let files = Files::begin(global, &inputs)?;
                files.table("restraint", || report.table())?;
                if files.wanted() {
                    let workbook = restraint_workbook(&report)?;
                    files.write(WORKBOOK, || workbook)?;
                }
                report.sheet_path = files.write(SHEET, || restraint_sheets(&report, signing))?;
                files.print(printer, SCHEMA, &report, &report.warnings, || {
                    restraints_text(&report)
                })?;
            }
        }
        Ok(Done::OK)
    }
}
