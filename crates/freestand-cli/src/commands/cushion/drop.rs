//! `freestand cushion drop`: from drop tests to a stiffness with its interval.

use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand::identify::FittedLaw;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, format_si, parse_positive};
use freestand_records::formats::ReadOptions;
use freestand_study::laboratory::drop_figures;
use freestand_study::laboratory::drop_test::{
    DropReport, DropRequest, DropsReport, cushion_toml, drop_tests, loop_csv,
};

use freestand_study::laboratory::virtual_test::VELOCITY_ERROR_RATIO;

use super::static_test::{Boundary, Impactor, name};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::{Failure, problem};
use crate::files::Files;
use crate::printer::{Printer, optional, pairs, print_failure, significant, table};
use crate::reading::{time_step, unit};
use crate::values::{Choices, Given, Reads, Values, choice};

/// Drop tests of a pad: stiffness with its 95 % interval, exponent and damping
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand cushion drop drop.csv --mass 0.365kg --height \"100 mm\"
  freestand cushion drop drop-*.csv --mass 0.365kg --impact-velocity \"1.40 m/s\" --out pad --json
  freestand cushion drop column.txt --unit g --dt 20us --mass 0.365kg
  freestand shock … --cushion pad/cushion.toml --pads-per-edge 2

A file has columns of time and acceleration with their units (time [ms],acceleration [g]), positive
upward, and a few milliseconds of free fall before the contact, whose mean is the zero line. Lines
such as \"# mass: 0.365 kg\", \"# height: 100 mm\", \"# impactor: flat\" or \"# boundary: glued\" before
the columns are used unless a flag replaces them.
A record that cannot give a stiffness is shown with the reasons. Drops are pooled as repeats of one
test; they must have the same impactor, boundary and mass. Otherwise the exit status is 1.")]
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
    /// Corner frequency of the low-pass filter before the converter, to check the record against
    #[arg(long, positive = Dimension::Frequency)]
    corner: Option<Given>,
    /// Fit only this law [default: the simplest one that no other clearly improves on]
    #[arg(long, value_name = "LAW", value_parser = choice(LAWS))]
    law: Option<FittedLaw>,
    /// Thickness of the pad, used in warnings only
    #[arg(long, positive = Dimension::Length)]
    pad_thickness: Option<Given>,
    /// Shape of the impactor; replaces what the files state
    #[arg(long, value_name = "SHAPE")]
    impactor: Option<Impactor>,
    /// Radius of a spherical impactor
    #[arg(long, positive = Dimension::Length)]
    sphere_radius: Option<Given>,
    /// Boundary of the pad; replaces what the files state
    #[arg(long, value_name = "BOUNDARY")]
    boundary: Option<Boundary>,
    /// Change the sign of all samples: the sensor is mounted upside down
    #[arg(long)]
    invert: bool,
    /// Unit of acceleration of a file that does not state it
    #[arg(long, value_name = "UNIT", read = unit)]
    unit: Option<Given<String>>,
    /// Time step of a file without a column of times
    #[arg(long, value_name = "TIME", read = time_step)]
    dt: Option<Given>,
    /// Column of accelerations, by name or by number (from 1)
    #[arg(long, value_name = "NAME")]
    component: Option<String>,
}

const LAWS: Choices<FittedLaw> = &[
    (FittedLaw::Linear, "linear", "F = k d"),
    (FittedLaw::Power, "power", "F = K dⁿ"),
    (FittedLaw::KelvinVoigt, "kelvin-voigt", "F = k d + c ḋ"),
    (FittedLaw::HuntCrossley, "hunt-crossley", "F = K dⁿ (1 + Λḋ)"),
];

pub(crate) fn run(args: &DropArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let request = request(args, global)?;
    let files = Files::begin(global, &args.files)?;
    let report = drop_tests(&request).map_err(Failure::Problems)?;
    for (i, test) in report.tests.iter().enumerate() {
        if let Some(test) = test.test.as_ref().filter(|test| !test.points.is_empty()) {
            files.write(&format!("loop-{:03}.csv", i + 1), || loop_csv(test))?;
        }
    }
    if let Some(toml) = cushion_toml(&report.pooled) {
        files.write("cushion.toml", || toml)?;
    }
    if files.wanted() && report.tests.iter().any(|test| test.stiffness_n_m.is_some()) {
        for figure in drop_figures(&report).map_err(|error| Failure::computation(error.to_string()))? {
            files.write(&format!("{}.svg", figure.name), || &figure.svg)?;
            files.write(&format!("{}.png", figure.name), || &figure.png)?;
        }
    }
    files.print(printer, "freestand.cushion-drop/1", &report, &report.warnings, || text(&report))?;
    let problems: Vec<Problem> = report.failed.iter().map(|one| one.problem.clone()).collect();
    if !problems.is_empty() {
        print_failure(&Failure::Problems(problems));
    }
    Ok(Done { criterion_met: report.all_gave() })
}

fn request(args: &DropArgs, global: &GlobalArgs) -> Result<DropRequest, Failure> {
    let mut values = Values::default();
    let read = ReadOptions { unit: values.read(&args.unit), dt_s: values.read(&args.dt), ..ReadOptions::default() };
    if args.impactor == Some(Impactor::Flat) && args.sphere_radius.is_some() {
        values.push(problem("--sphere-radius is given for a flat impactor", "leave one of the two out"));
    }
    // A radius says that it is a sphere.
    let impactor = args.impactor.or(args.sphere_radius.as_ref().map(|_| Impactor::Sphere));
    let request = DropRequest {
        files: args.files.clone(),
        mass_kg: values.read(&args.mass),
        height_m: values.read(&args.height),
        impact_velocity_m_s: values.read(&args.impact_velocity),
        velocity_error_ratio: values.read(&args.velocity_error).unwrap_or(VELOCITY_ERROR_RATIO),
        gravity_m_s2: values.read(&args.gravity).unwrap_or(G0_M_S2),
        filter_corner_hz: values.read(&args.corner),
        law: args.law,
        read,
        component: args.component.clone(),
        inverted: args.invert,
        impactor: name(impactor.as_ref()),
        sphere_radius_m: values.read(&args.sphere_radius),
        boundary: name(args.boundary.as_ref()),
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
            let hint = "leave height and velocity out: the pulse itself then tells the speed";
            Err(problem("more than 50 %", hint))
        }
    }
}

fn per_mm(value: f64) -> String {
    significant(value / 1e3, 5)
}

fn text(report: &DropsReport) -> String {
    let mut out = match report.tests.as_slice() {
        [one] => one_test(one),
        several => many_tests(several),
    };
    let pooled = &report.pooled;
    if let (Some(k), Some([low, high])) = (pooled.stiffness_n_m, pooled.ci95_n_m) {
        let drops = if pooled.count == 1 { "drop" } else { "drops" };
        out += &format!(
            "\nOne pad, {} {drops}: {} N/mm, 95 % interval {} to {} N/mm; {}, exponent {}\n",
            pooled.count,
            per_mm(k),
            per_mm(low),
            per_mm(high),
            pooled.law.unwrap_or("-"),
            optional(pooled.exponent, 4, "")
        );
    }
    out += &report.failed.iter().map(|one| format!("failed: {}: {}\n", one.path, one.reason)).collect::<String>();
    out
}

fn one_test(test: &DropReport) -> String {
    let si = |value: Option<f64>, dimension| value.map_or_else(|| "-".to_owned(), |v| format_si(rounded(v), dimension));
    let flags = if test.quality.flags.is_empty() { "none".to_owned() } else { test.quality.flags.join(", ") };
    let mut rows = vec![
        ("file", test.path.clone()),
        (
            "impact velocity",
            format!("{} ({})", si(test.impact_velocity_m_s, Dimension::Velocity), test.impact_velocity_source),
        ),
        ("peak acceleration", optional(test.peak_acceleration_g, 5, "g")),
        ("contact time", si(test.contact_time_s, Dimension::Time)),
        ("largest compression", si(test.max_compression_m, Dimension::Length)),
        ("restitution", optional(test.restitution_ratio, 4, "")),
    ];
    if let Some(e) = test.restitution_bounce_ratio {
        rows.push(("restitution, from the bounce", significant(e, 4)));
    }
    if let Some(k) = test.stiffness_n_m {
        let with_unit = |value: f64| format!("{} N/mm", per_mm(value));
        let interval = test.stiffness_ci95_n_m.map_or_else(String::new, |[low, high]| {
            format!(" ({} to {}), {}", per_mm(low), per_mm(high), test.law.unwrap_or("-"))
        });
        rows.extend([
            ("stiffness, fitted", with_unit(k.fit) + &interval),
            ("  m (a/v)^2", with_unit(k.peak_over_velocity)),
            ("  m (pi/tc)^2", with_unit(k.contact_time)),
            ("  m (v/d)^2", with_unit(k.velocity_over_compression)),
            ("  m a/d", with_unit(k.acceleration_over_compression)),
            ("  2E/d^2", with_unit(k.energy)),
            ("  spread of the four", optional(test.quality.spread_ratio.map(|s| 100.0 * s), 3, "%")),
            ("exponent, fitted", optional(test.exponent, 4, "")),
            ("exponent, 2ad/v^2 - 1", optional(test.exponent_by_identity, 4, "")),
            ("damping ratio", optional(test.damping_ratio, 3, "")),
        ]);
    }
    rows.extend([
        ("samples per contact", optional(test.quality.samples_per_contact, 3, "")),
        ("zero shift", optional(test.quality.zero_shift_ratio.map(|s| 100.0 * s), 2, "% of the peak")),
        ("noise", optional(test.quality.noise_ratio.map(|s| 100.0 * s), 2, "% of the peak")),
        ("left by the fit", optional(test.quality.residual_ratio.map(|s| 100.0 * s), 2, "% of the peak")),
        ("flags", flags),
    ]);
    if let Some(reason) = &test.reason {
        rows.push(("no stiffness", reason.clone()));
    }
    pairs(&rows)
}

/// Five digits are more than a test has.
fn rounded(value: f64) -> f64 {
    significant(value, 5).parse().unwrap_or(value)
}

fn many_tests(tests: &[DropReport]) -> String {
    let headings = [
        "file",
        "v0 [m/s]",
        "peak [g]",
        "tc [ms]",
        "d [mm]",
        "e",
        "k [N/mm]",
        "spread [%]",
        "law",
        "n",
        "zeta",
        "flags",
    ];
    let rows: Vec<Vec<String>> = tests
        .iter()
        .map(|test| {
            vec![
                test.path.clone(),
                optional(test.impact_velocity_m_s, 4, ""),
                optional(test.peak_acceleration_g, 4, ""),
                optional(test.contact_time_s.map(|t| 1e3 * t), 4, ""),
                optional(test.max_compression_m.map(|d| 1e3 * d), 4, ""),
                optional(test.restitution_ratio, 3, ""),
                test.stiffness_n_m.map_or_else(|| "-".to_owned(), |k| per_mm(k.fit)),
                optional(test.quality.spread_ratio.map(|s| 100.0 * s), 2, ""),
                test.law.unwrap_or("-").to_owned(),
                optional(test.exponent, 3, ""),
                optional(test.damping_ratio, 2, ""),
                if test.quality.flags.is_empty() { "-".to_owned() } else { test.quality.flags.join(",") },
            ]
        })
        .collect();
    table(&headings, &rows)
}
