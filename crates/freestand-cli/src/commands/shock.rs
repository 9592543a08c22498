//! `freestand shock`: one landing.

use clap::Args;
use freestand_app::shock::{Meant, SCHEMA, Shock};
use freestand_output::answer::Answer;
use freestand_report::figures::boundary_figure;
use freestand_report::shock::{landing_report, shock_doubt};
use freestand_report::table::lines;
use freestand_study::shock::{Verdict, shock};

use super::{Done, Tell};
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Calculate the shock of one landing: acceleration of the edge, pulse, ceiling and verdict
#[derive(Debug, Args)]
#[command(after_help = include_str!("../help/shock.txt").trim_end())]
pub(crate) struct ShockArgs {
    #[command(flatten)]
    pub(super) request: Shock,
}

impl Tell for Shock {
    type Output = ();

    fn tell(
        meant: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, &meant.inputs)?;
        let report = shock(&meant.landing)?;
        if let Some(boundary) = report.damage_boundary {
            let tests = meant.landing.boundary_tests.as_ref();
            files.figure("damage-boundary", || boundary_figure(&boundary, tests))?;
        }
        let answer = landing_report(&report);
        let warnings: Vec<String> = report.doubts.iter().map(shock_doubt).collect();
        files.print(printer, SCHEMA, &answer, &warnings, || {
            lines(&answer.facts())
        })?;
        Ok(Done {
            criterion_met: report.verdict != Verdict::Exceeded,
        })
    }
}
