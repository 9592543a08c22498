//! `freestand cushion drop`: the stiffness of a pad, with its interval, from drop tests.

use clap::Args;
use freestand::identify::DropTest;
use freestand_app::drop_test::{DropTests, SCHEMA};
use freestand_report::cushion::{DropsAnswer, drops_doubts, drops_text};
use freestand_report::figures::drop_figures;
use freestand_study::laboratory::drop_test::{DropRequest, cushion_toml, drop_tests, loop_table};
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Evaluate drop tests of a pad: stiffness with its 95 % interval, exponent and damping
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion_drop.txt").trim_end())]
pub(crate) struct DropArgs {
    #[command(flatten)]
    pub(super) request: DropTests,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for DropTests {
    type Output = TableArgs;

    fn tell(
        request: DropRequest,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let seed = Some(request.seed);
        let files = Files::with_tables(global, &request.files, tables, SCHEMA, seed)?;
        let report = drop_tests(&request)?;
        for (i, test) in report.tests.iter().enumerate() {
            if !test.test.points.is_empty() {
                files.table(&format!("loop-{:03}", i + 1), || Ok(loop_table(&test.test)))?;
            }
        }
        if let Some(toml) = cushion_toml(&report.pooled) {
            files.write("cushion.toml", || toml)?;
        }
        if files.wanted()
            && report
                .tests
                .iter()
                .any(|test| test.test.identified.is_some())
        {
            for figure in drop_figures(&report)? {
                files.drawn(&figure.name, &figure)?;
            }
        }
        if let Some(session) = printer.session().filter(|session| session.wants_history()) {
            session.beside(&Beside {
                loops: report
                    .tests
                    .iter()
                    .map(|test| Loop::of(&test.test))
                    .collect(),
            });
        }
        let warnings = drops_doubts(&report);
        files.print(printer, SCHEMA, &DropsAnswer(&report), &warnings, || {
            drops_text(&report)
        })?;
        printer.failed(&report.failed);
        Ok(Done {
            criterion_met: report.all_gave(),
        })
    }
}

/// What goes beside the document of who wants to draw the loops.
#[derive(Debug, Serialize)]
struct Beside {
    loops: Vec<Loop>,
}

/// Force against compression, in the order of the tests.
#[derive(Debug, Serialize)]
struct Loop {
    compression_m: Vec<f64>,
    force_n: Vec<f64>,
}

impl Loop {
    fn of(test: &DropTest) -> Self {
        let (compression_m, force_n) = test
            .points
            .iter()
            .map(|point| (point.compression_m, point.force_n))
            .unzip();
        Self {
            compression_m,
            force_n,
        }
    }
}
