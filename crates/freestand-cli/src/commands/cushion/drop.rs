//! `freestand cushion drop`: the stiffness of a pad, with its interval, from drop tests.

use clap::Args;
use freestand::identify::DropTest;
use freestand_app::drop_test::{DropTests, SCHEMA};
use freestand_output::answer::Answer;
use freestand_study::laboratory::drop_figures;
use freestand_study::laboratory::drop_test::{
    DropRequest, DropsReport, cushion_toml, drop_tests, loop_table,
};
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, facts_table, failed_lines, lines};

/// Evaluate drop tests of a pad: stiffness with its 95 % interval, exponent and damping
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion drop drop.csv --mass 0.365kg --height \"100 mm\"
  freestand cushion drop drop-*.csv --mass 0.365kg --impact-velocity \"1.40 m/s\" --out pad --json
  freestand cushion drop column.txt --unit g --dt 20us --mass 0.365kg
  freestand shock … --cushion pad/cushion.toml --pads-per-edge 2

A file has columns of time and acceleration with their units (time [ms],acceleration [g]),
positive upward, and a few milliseconds of free fall before the contact, whose mean is the zero
line. A column in V or mV needs the --sensitivity of the sensor. Lines such as
\"# mass: 0.365 kg\", \"# height: 100 mm\", \"# impactor: flat\" or \"# boundary: glued\" before the
columns are used unless a flag replaces them. A record that cannot give a stiffness is shown with
the reasons. Drops are pooled as repeats of one test if they have the same impactor, boundary and
mass. The exit status is 1 if a record gives no stiffness or the drops cannot be pooled.")]
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
        files.print(printer, SCHEMA, &report, &report.warnings, || text(&report))?;
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

/// The table of several tests.
const COLUMNS: [Column; 14] = [
    ("path", "file", 0),
    ("drop", "drop", 0),
    ("impact_velocity_m_s", "impact velocity [m/s]", 4),
    ("peak_acceleration_g", "peak [g]", 4),
    ("contact_time_s", "contact time [ms]", 4),
    ("max_compression_m", "compression [mm]", 4),
    ("restitution_ratio", "restitution", 3),
    ("fit", "stiffness [N/mm]", 5),
    ("integrated", "integrated [N/mm]", 4),
    ("spread_ratio", "spread [%]", 2),
    ("law", "law", 0),
    ("exponent", "exponent", 3),
    ("damping_ratio", "damping", 2),
    ("flags", "flags", 0),
];

/// Where no file has several drops, their number says nothing.
fn columns(report: &DropsReport) -> Vec<Column> {
    let is_shown = report.tests.iter().any(|test| test.drop > 1);
    COLUMNS
        .into_iter()
        .filter(|(key, ..)| is_shown || *key != "drop")
        .collect()
}

fn text(report: &DropsReport) -> String {
    let mut out = if let [one] = report.tests.as_slice() {
        lines(&one.facts())
    } else {
        facts_table(report.tests.iter().map(Answer::facts), &columns(report))
    };
    if report.pooled.pad.is_some() {
        out += &format!("\n{}", lines(&report.pooled.facts()));
    }
    out + &failed_lines(&report.failed)
}
