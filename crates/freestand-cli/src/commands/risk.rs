//! `freestand risk`: how often objects fail, what that costs, and which options pay.

use clap::Args;
use freestand_app::risk::{Meant, Risk, SCHEMA};
use freestand_output::json::document;
use freestand_report::figures::risk_figure;
use freestand_report::risk::{RiskAnswer, owners_page, risk_text, warnings};
use freestand_risk::risk;

use super::assess::watched;
use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Calculate how often objects fail, what that costs a year, and which options are worth their cost
///
/// The hazard curve says how often a year motions reach an intensity, and the fragility how likely
/// the object fails at it. Costs come from the inventory; the program assumes none, and lists those
/// that are missing. Exit status 1: an object fails more often than accepted.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/risk.txt").trim_end())]
pub(crate) struct RiskArgs {
    #[command(flatten)]
    pub(super) request: Risk,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for Risk {
    type Output = TableArgs;

    fn tell(
        meant: Meant,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let seed = Some(global.seed());
        let files = Files::with_tables(global, &meant.inputs, tables, SCHEMA, seed)?;
        // Before the fits, so that no signal is missed between them and the files.
        let stop = printer.stop();
        let report = watched(printer, |progress| risk(&meant.risk, progress))?;
        let (answer, warnings) = (RiskAnswer(&report), warnings(&report));
        if files.wanted() {
            files.table("risk", || report.table())?;
            stop.go_on()?;
            let json = document(SCHEMA, &answer, &warnings)?;
            files.write("risk.json", || json)?;
            let figure = risk_figure(&report)?;
            if let Some(figure) = &figure {
                files.drawn("risk", figure)?;
            }
            stop.go_on()?;
            files.write("report.html", || owners_page(&report, figure.as_ref()))?;
        }
        files.finish_result(SCHEMA, &warnings)?;
        printer.result(SCHEMA, &answer, &warnings, || risk_text(&report))?;
        Ok(Done {
            criterion_met: report.is_accepted(),
        })
    }
}
