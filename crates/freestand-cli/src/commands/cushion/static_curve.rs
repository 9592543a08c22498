//! `freestand cushion static`: the static stiffness of a pad, from tests of force and displacement.

use std::path::PathBuf;

use clap::Args;
use freestand::identify::Toe;
use freestand_input::quantity::Dimension;
use freestand_output::facts::Facts;
use freestand_records::formats::{Sensitivity, parse_sensitivity};
use freestand_study::laboratory::static_curve::{
    StaticReport, StaticRequest, StaticsReport, curve_table, static_tests,
};
use freestand_study::laboratory::{BOUNDARIES, IMPACTORS, static_figure};

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, facts_table, failed_lines};
use crate::values::{Choices, Given, Reads, Values, choice};

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
    /// Files with tests of one pad
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Working load [default: half of the largest force]
    #[arg(long, positive = Dimension::Force)]
    load: Option<Given>,
    /// Stiffness of the frame of the machine, whose deformation is subtracted [default: rigid]
    #[arg(long, positive = Dimension::Stiffness)]
    machine_compliance: Option<Given>,
    /// What to cut off the toe of the curve [default: cut, but keep for a sphere]
    #[arg(long, value_name = "WHAT", value_parser = choice(TOES))]
    toe: Option<Toe>,
    /// Reverse the signs of force and displacement, for a press that writes compression as negative
    #[arg(long)]
    invert: bool,
    /// Sensitivity of a sensor whose column is in volts, such as "2 mV/N" or "1 V/mm"; give it
    /// once for each such sensor
    #[arg(long, value_name = "SENSITIVITY", read = parse_sensitivity)]
    sensitivity: Vec<Given<Sensitivity>>,
    /// Shape of the impactor; replaces what the files state
    #[arg(long, value_name = "SHAPE", value_parser = IMPACTORS)]
    impactor: Option<String>,
    /// Boundary of the pad; replaces what the files state
    #[arg(long, value_name = "BOUNDARY", value_parser = BOUNDARIES)]
    boundary: Option<String>,
    /// Dynamic stiffness from a drop test, to compare with the secant stiffness
    #[arg(long, positive = Dimension::Stiffness)]
    dynamic: Option<Given>,
    #[command(flatten)]
    tables: TableArgs,
}

const TOES: Choices<Toe> = &[
    (
        Toe::Slack,
        "cut",
        "The displacement before the pad is touched is cut off",
    ),
    (
        Toe::Tangent,
        "tangent",
        "All before the tangent at the working load meets zero force is cut off (ASTM D695)",
    ),
    (Toe::Keep, "keep", "The toe is kept"),
];

const SCHEMA: &str = "freestand.cushion-static/1";

pub(crate) fn run(
    args: &StaticArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let request = StaticRequest {
        files: args.files.clone(),
        load_n: values.read(&args.load),
        machine_stiffness_n_m: values.read(&args.machine_compliance),
        toe: args.toe,
        inverted: args.invert,
        impactor: args.impactor.clone(),
        boundary: args.boundary.clone(),
        sensitivities: args
            .sensitivity
            .iter()
            .filter_map(|one| values.read(&Some(one.clone())))
            .collect(),
        dynamic_stiffness_n_m: values.read(&args.dynamic),
    };
    values.finish()?;
    let files = Files::with_tables(global, &args.files, &args.tables, SCHEMA, None)?;
    let report = static_tests(&request)?;
    for (i, test) in report.tests.iter().enumerate() {
        files.table(&format!("curve-{:03}", i + 1), || {
            Ok(curve_table(&test.test))
        })?;
    }
    files.figure("static", || static_figure(&report))?;
    files.print(printer, SCHEMA, &report.facts(), &report.warnings, || {
        text(&report)
    })?;
    printer.failed(&report.failed);
    Ok(Done {
        criterion_met: report.failed.is_empty(),
    })
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
    let tests: Vec<Facts> = report.tests.iter().map(StaticReport::facts).collect();
    facts_table(&tests, &COLUMNS) + &failed_lines(&report.failed)
}
