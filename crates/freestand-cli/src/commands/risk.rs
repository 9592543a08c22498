//! `freestand risk`: how often objects fail, what that costs, and which options pay.

use clap::Args;
use freestand_app::risk::{Meant, Risk, SCHEMA};
use freestand_output::json::document;
use freestand_risk::{owners_page, risk, risk_figure, text};

use super::assess::watched;
use super::fragility::{go_on, stopped};
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
#[command(after_help = "\
Examples:
  How often objects fail, with the hazard curve of a seismologist:
    freestand risk --fragility fragility.csv --hazard hazard.csv
  With a power law as hazard curve:
    freestand risk --fragility fragility.csv --hazard-im pgv \\
      --hazard-power \"k0=1e-4 /yr, k=2.5, reference=1 m/s\"
  With the return periods of a code, for the peak ground acceleration:
    freestand risk --fragility fragility.csv --hazard-code as1170.4 --hazard-im pga \\
      --site De --hazard-factor 0.12 --accepted \"1e-3 /yr\"
  What failures cost, and what to restrain first:
    freestand risk --outcomes outcomes.csv --hazard hazard.csv --inventory costs.csv \\
      --options options.csv --budget \"20000 AUD\" --horizon \"40 yr\" --discount \"3 %\"")]
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
        let report = watched(printer, |progress| risk(&meant.risk, progress)).map_err(stopped)?;
        if files.wanted() {
            files.table("risk", || report.table())?;
            go_on(&stop)?;
            let json = document(SCHEMA, &report, &report.warnings)?;
            files.write("risk.json", || json)?;
            let figure = risk_figure(&report)?;
            if let Some(figure) = &figure {
                files.drawn("risk", figure)?;
            }
            go_on(&stop)?;
            files.write("report.html", || owners_page(&report, figure.as_ref()))?;
        }
        files.finish_result(SCHEMA, &report.warnings)?;
        printer.result(SCHEMA, &report, &report.warnings, || text(&report))?;
        Ok(Done {
            criterion_met: report.is_accepted(),
        })
    }
}
