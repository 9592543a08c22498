//! `freestand cushion static`: the static stiffness of a pad, from tests of force and displacement.

use clap::Args;
use freestand_app::static_test::{SCHEMA, StaticTests};
use freestand_output::answer::Answer;
use freestand_study::laboratory::static_curve::{
    StaticRequest, StaticsReport, curve_table, static_tests,
};
use freestand_study::laboratory::static_figure;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, facts_table, failed_lines};

/// Evaluate static tests of a pad: tangent and secant stiffness at the working load, and hysteresis
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion static press.csv --load \"350 N\" --machine-compliance \"50 kN/mm\"
  freestand cushion static glued.csv unglued.csv lubricated.csv --dynamic \"2190 N/mm\" \\
    --out static

A file has columns of displacement and force with their units (displacement [mm],force [N]), both
positive in compression, in the order of the test. Of several cycles, the last complete one is
evaluated. Slack before the pad is touched is cut off; the slow beginning of a pad that hardens is
kept. --toe tangent cuts along the tangent at the working load, for a linear pad on which the plate
seats itself. The ratio of dynamic to static stiffness is shown but not used.")]
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
        files.print(printer, SCHEMA, &report, &report.warnings, || text(&report))?;
        printer.failed(&report.failed);
        Ok(Done {
            criterion_met: report.failed.is_empty(),
        })
    }
}

const COLUMNS: [Column; 10] = [
    ("path", "file", 0),
    ("impactor", "impactor", 0),
    ("boundary", "boundary", 0),
    ("load_n", "load [N]", 4),
    ("tangent_stiffness_n_m", "tangent [N/mm]", 4),
    ("secant_stiffness_n_m", "secant [N/mm]", 4),
    ("hysteresis_ratio", "hysteresis [%]", 3),
    ("toe_m", "toe [mm]", 3),
    ("exponent", "exponent", 3),
    ("dynamic_over_static_ratio", "dynamic/static", 3),
];

fn text(report: &StaticsReport) -> String {
    facts_table(report.tests.iter().map(Answer::facts), &COLUMNS) + &failed_lines(&report.failed)
}
