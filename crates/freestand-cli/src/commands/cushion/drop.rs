//! `freestand cushion drop`: the stiffness of a pad, with its interval, from drop tests.

use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand::identify::{DropTest, FittedLaw};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_positive};
use freestand_output::facts::Facts;
use freestand_records::formats::{ReadOptions, Sensitivity, parse_sensitivity, parse_unit};
use freestand_records::processing::parse_step;
use freestand_study::laboratory::drop_figures;
use freestand_study::laboratory::drop_test::{
    DropReport, DropRequest, DropsReport, LAWS, cushion_toml, drop_tests, loop_table,
};

use freestand_study::laboratory::virtual_laboratory::DEFAULT_VELOCITY_ERROR_RATIO;
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, facts_table, failed_lines, lines};
use crate::values::{Given, Reads, Values, choice};
use freestand_study::laboratory::{BOUNDARIES, IMPACTORS};

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
    /// Files with drops on one pad
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Mass of the impactor
    #[arg(long, positive = Dimension::Mass)]
    mass: Option<Given>,
    /// Drop height
    #[arg(long, positive = Dimension::Length, conflicts_with = "impact_velocity")]
    height: Option<Given>,
    /// Velocity at the first touch [default: from the drop height, or from the pulse itself]
    #[arg(long, positive = Dimension::Velocity)]
    impact_velocity: Option<Given>,
    /// Standard deviation of the impact velocity, as a share of it [default: 1 %]
    #[arg(long, value_name = "RATIO", read = velocity_error)]
    velocity_error: Option<Given>,
    /// Gravity during the contact; 0 m/s2 if the zero line is not that of free fall [default: 1 g]
    #[arg(long, non_negative = Dimension::Acceleration)]
    gravity: Option<Given>,
    /// Corner frequency of the low-pass filter before the A/D converter, behind which the laws are fitted
    #[arg(long, positive = Dimension::Frequency)]
    corner: Option<Given>,
    /// Fit only this law [default: the simplest one that no other clearly improves on]
    #[arg(long, value_name = "LAW", value_parser = choice(LAWS))]
    law: Option<FittedLaw>,
    /// Thickness of the pad, used in warnings only
    #[arg(long, positive = Dimension::Length)]
    pad_thickness: Option<Given>,
    /// Shape of the impactor; replaces what the files state
    #[arg(long, value_name = "SHAPE", value_parser = IMPACTORS)]
    impactor: Option<String>,
    /// Radius of a spherical impactor
    #[arg(long, positive = Dimension::Length)]
    sphere_radius: Option<Given>,
    /// Boundary of the pad; replaces what the files state
    #[arg(long, value_name = "BOUNDARY", value_parser = BOUNDARIES)]
    boundary: Option<String>,
    /// Change the sign of all samples, for a sensor that is mounted upside down
    #[arg(long)]
    invert: bool,
    /// Unit of acceleration of a file that does not state it
    #[arg(long, value_name = "UNIT", read = parse_unit)]
    unit: Option<Given<String>>,
    /// Sensitivity of the accelerometer of a column in volts, such as "10 mV/g"
    #[arg(long, value_name = "SENSITIVITY", read = parse_sensitivity, conflicts_with = "unit")]
    sensitivity: Option<Given<Sensitivity>>,
    /// Time step of a file without a column of times
    #[arg(long, value_name = "TIME", read = parse_step)]
    dt: Option<Given>,
    /// Step to which unevenly spaced samples are interpolated on straight lines [default: they are refused]
    #[arg(long, value_name = "TIME", read = parse_step)]
    resample: Option<Given>,
    /// Column of accelerations, by name or by number (from 1)
    #[arg(long, value_name = "NAME")]
    component: Option<String>,
    #[command(flatten)]
    tables: TableArgs,
}

const SCHEMA: &str = "freestand.cushion-drop/1";

pub(crate) fn run(
    args: &DropArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let request = request(args, global)?;
    let files = Files::with_tables(
        global,
        &args.files,
        &args.tables,
        SCHEMA,
        Some(global.seed()),
    )?;
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
    files.print(printer, SCHEMA, &report.facts(), &report.warnings, || {
        text(&report)
    })?;
    printer.failed(&report.failed);
    Ok(Done {
        criterion_met: report.all_gave(),
    })
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

fn request(args: &DropArgs, global: &GlobalArgs) -> Result<DropRequest, Failure> {
    let mut values = Values::default();
    let read = ReadOptions {
        unit: values.read(&args.unit),
        sensitivity: values.read(&args.sensitivity),
        dt_s: values.read(&args.dt),
        uneven_dt_s: values.read(&args.resample),
        ..ReadOptions::default()
    };
    let request = DropRequest {
        files: args.files.clone(),
        mass_kg: values.read(&args.mass),
        height_m: values.read(&args.height),
        impact_velocity_m_s: values.read(&args.impact_velocity),
        velocity_error_ratio: values
            .read(&args.velocity_error)
            .unwrap_or(DEFAULT_VELOCITY_ERROR_RATIO),
        gravity_m_s2: values.read(&args.gravity).unwrap_or(G0_M_S2),
        filter_corner_hz: values.read(&args.corner),
        law: args.law,
        read,
        component: args.component.clone(),
        inverted: args.invert,
        impactor: args.impactor.clone(),
        sphere_radius_m: values.read(&args.sphere_radius),
        boundary: args.boundary.clone(),
        thickness_m: values.read(&args.pad_thickness),
        seed: global.seed(),
    };
    values.finish()?;
    Ok(request)
}

fn velocity_error(text: &str) -> Result<f64, Problem> {
    match parse_positive(text, Dimension::Ratio, "the value")? {
        ratio if ratio <= 0.5 => Ok(ratio),
        _ => {
            let hint = "leave --height and --impact-velocity out: the velocity is then found from the pulse";
            Err(Problem::value(
                format!("at most 50 % is accepted, not \"{text}\""),
                hint,
            ))
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
    let tests: Vec<Facts> = report.tests.iter().map(DropReport::facts).collect();
    let mut out = if let [one] = tests.as_slice() {
        lines(one)
    } else {
        facts_table(&tests, &columns(report))
    };
    if report.pooled.pad.is_some() {
        out += &format!("\n{}", lines(&report.pooled.facts()));
    }
    out + &failed_lines(&report.failed)
}
