//! `freestand cushion static`: the static stiffness of a pad, from tests of force and displacement.

use clap::Args;
use freestand_app::static_test::{SCHEMA, StaticTests};
use freestand_report::cushion::{statics_doubt, statics_text};
use freestand_report::figures::static_figure;
use freestand_study::laboratory::static_curve::{StaticRequest, curve_table, static_tests};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Evaluate static tests of a pad: tangent and secant stiffness at the working load, and hysteresis
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion_static.txt").trim_end())]
pub(crate) struct StaticArgs {
    #[command(flatten)]
    pub(super) request: StaticTests,
    #[command(flatten)]
    pub(super) output: TableArgs,
}

impl Tell for StaticTests {
    type Output = TableArgs;

    fn tell(
        request: StaticRequest,
        tables: &TableArgs,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::with_tables(global, &request.files, tables, SCHEMA, None)?;
        let report = static_tests(&request)?;
        for (i, test) in report.tests.iter().enumerate() {
            files.table(&format!("curve-{:03}", i + 1), || {
                Ok(curve_table(&test.test))
            })?;
        }
        files.figure("static", || static_figure(&report))?;
        let warnings: Vec<String> = report.doubts.iter().map(statics_doubt).collect();
        files.print(printer, SCHEMA, &report, &warnings, || {
            statics_text(&report)
        })?;
        printer.failed(&report.failed);
        Ok(Done {
            criterion_met: report.failed.is_empty(),
        })
    }
}
