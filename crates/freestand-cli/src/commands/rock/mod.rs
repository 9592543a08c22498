//! `freestand rock`: one object under one motion.

mod compliant;

use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand::motion::Motion;
use freestand::rocking::{RockingOptions, Until};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, format_si};
use freestand_output::folder::write_file;
use freestand_study::rock::{RockReport, RockRequest, history_csv, rock};
use serde::Serialize;

use self::compliant::CompliantArgs;
use super::Done;
use super::block::{RockingArgs, ShapeArgs};
use crate::args::GlobalArgs;
use crate::cushion::CushionArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, optional, pairs, significant};
use crate::reading::{ReadArgs, VerticalArgs};
use crate::values::Values;

/// One object under one motion: rotation, uplift, impacts, overturning, shock
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A cabinet under a record, with the shock on its pads:
    freestand rock --motion record.AT2 --height \"2.3 m\" --thickness \"600 mm\" --mass \"140 kg\" --stiffness \"4380 N/mm\"
  A column of accelerations in g every 5 ms, twice as strong, history to a file:
    freestand rock --motion floor.txt --unit g --dt 5ms --scale 2 --height 1.5m --thickness 0.3m --history history.csv
  Free rocking from a tilt of 5 degrees:
    freestand rock --initial-rotation 5deg --duration 10s --height 1.5m --thickness 0.4m
  A cabinet let go on its pads, followed in time, with the trace of the landing:
    freestand rock --base compliant --cg-rise \"16 mm\" --height \"2.3 m\" --thickness \"600 mm\" --mass \"140 kg\" --stiffness \"4380 N/mm\" --law kelvin-voigt --damping 5% --out landing")]
pub(crate) struct RockArgs {
    /// Record of the base's horizontal acceleration; none: free rocking
    #[arg(long, value_name = "FILE")]
    motion: Option<PathBuf>,
    /// Record of the base's vertical acceleration, positive upward, of the same step and length
    #[arg(long, value_name = "FILE")]
    vertical: Option<PathBuf>,
    #[command(flatten)]
    vertically: VerticalArgs,
    #[command(flatten)]
    read: ReadArgs,

    /// Height of the object
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "The object")]
    height: String,
    /// Width of the object in the plane of motion
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "The object")]
    thickness: String,
    /// Mass, for the shock
    #[arg(long, value_name = "MASS", allow_hyphen_values = true, help_heading = "The object")]
    mass: Option<String>,
    /// Coefficient of friction: for the warning against sliding [default: 0.5]; on a compliant base the feet slip by it [default:
    /// they do not]
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, help_heading = "The object")]
    friction: Option<String>,
    #[command(flatten)]
    shape: ShapeArgs,
    #[command(flatten)]
    cushion: CushionArgs,

    #[command(flatten)]
    compliant: CompliantArgs,

    #[command(flatten)]
    rocking: RockingArgs,
    /// Rotation at the start, positive to the right
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, help_heading = "The rocking")]
    initial_rotation: Option<String>,
    /// Angular velocity at the start
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true, help_heading = "The rocking")]
    initial_velocity: Option<String>,
    /// Gravity [default: 1 g]
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true, help_heading = "The rocking")]
    gravity: Option<String>,
    /// When to stop [default: the last sample]; the base is still after the last sample
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, help_heading = "The rocking")]
    duration: Option<String>,
    /// File for the history (CSV)
    #[arg(long, value_name = "FILE.csv")]
    history: Option<PathBuf>,
}

pub(crate) fn run(args: &RockArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    if args.compliant.is_compliant() {
        return compliant::run(args, global, printer);
    }
    if let Some(flag) = args.compliant.given() {
        return Err(Failure::usage(format!("{flag} is of a compliant base"), "add --base compliant"));
    }
    let (request, reading) = request(args)?;
    let inputs = args.read.inputs(args.motion.iter().chain(&args.vertical).chain(args.cushion.inputs()));
    let files = Files::begin(global, &inputs)?;
    let mut report = rock(&request, args.history.is_some() || files.wanted())?;
    report.warnings.splice(0..0, reading.warnings);
    files.write("history.csv", || history_csv(&request.block, &report.history))?;
    if let Some(path) = &args.history {
        write_file(path, history_csv(&request.block, &report.history).as_bytes(), &inputs)?;
    }
    let document = Document { report: &report, processing: reading.processing };
    files.print(printer, "freestand.rock/1", &document, &report.warnings, || text(&report, &request))?;
    Ok(Done::OK)
}

#[derive(Debug, Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    report: &'a RockReport,
    processing: Vec<String>,
}

/// What is to be said about the records.
#[derive(Debug, Default)]
struct Reading {
    warnings: Vec<String>,
    processing: Vec<String>,
}

fn request(args: &RockArgs) -> Result<(RockRequest, Reading), Failure> {
    let mut values = Values::default();
    let height = values.positive("--height", Some(&args.height), Dimension::Length);
    let thickness = values.positive("--thickness", Some(&args.thickness), Dimension::Length);
    let mass = values.positive("--mass", args.mass.as_deref(), Dimension::Mass);
    let edge = args.cushion.edge(mass, &mut values)?;
    if args.cushion.is_given() && args.mass.is_none() {
        let problem = Problem::new(ProblemKind::Value, "the cushion gives a shock only with the mass of the object");
        values.push(problem.hint("add --mass, or leave the cushion out"));
    }
    let block = match (height, thickness) {
        (Some(height_m), Some(thickness_m)) => args.shape.block(height_m, thickness_m, mass, &mut values),
        _ => None,
    };
    let friction = values.positive("--friction", args.friction.as_deref(), Dimension::Ratio);
    let rotation = values.any("--initial-rotation", args.initial_rotation.as_deref(), Dimension::Angle);
    let omega = values.any("--initial-velocity", args.initial_velocity.as_deref(), Dimension::AngularVelocity);
    let gravity = values.positive("--gravity", args.gravity.as_deref(), Dimension::Acceleration);
    let duration = values.positive("--duration", args.duration.as_deref(), Dimension::Time);
    let options = RockingOptions {
        model: args.rocking.model(),
        restitution: args.rocking.restitution(&mut values),
        gravity_m_s2: gravity.unwrap_or(G0_M_S2),
        accuracy: args.rocking.accuracy(),
        initial_rotation_rad: rotation.unwrap_or(0.0),
        initial_omega_rad_s: omega.unwrap_or(0.0),
        until: duration.map_or(Until::EndOfMotion, Until::Time),
    };
    values.finish()?;
    let Some(block) = block else {
        return Err(Failure::usage("the object has no size", "give --height and --thickness"));
    };
    let no_motion = args.motion.is_none() && args.vertical.is_none();
    if no_motion {
        args.read.refuse_without_record(|_| "name the record with --motion".to_owned())?;
    }
    if no_motion && options.initial_rotation_rad == 0.0 && options.initial_omega_rad_s == 0.0 {
        return Err(Failure::usage(
            "nothing moves the object",
            "give --motion FILE, or --initial-rotation or --initial-velocity with --duration",
        ));
    }
    if no_motion && duration.is_none() {
        return Err(Failure::usage("free rocking has no end", "give --duration, for example --duration 30s"));
    }
    let mut reading = Reading::default();
    let horizontal = args.motion.as_ref().map(|path| read(&args.read, path, &mut reading)).transpose()?;
    let vertically = args.vertically.reading(&args.read);
    let vertical = args.vertical.as_ref().map(|path| read(&vertically, path, &mut reading)).transpose()?;
    Ok((RockRequest { block, horizontal, vertical, options, cushion: mass.zip(edge), friction }, reading))
}

fn read(args: &ReadArgs, path: &std::path::Path, reading: &mut Reading) -> Result<Motion, Failure> {
    let read = args.read_one(path)?;
    let named = |text: &String| format!("{}: {text}", read.motion.name);
    reading.warnings.extend(read.notes.iter().map(named));
    reading.processing.extend(read.motion.processing.iter().map(named));
    Ok(read.motion.motion)
}

fn text(report: &RockReport, request: &RockRequest) -> String {
    let seconds = |time: Option<f64>| time.map_or_else(|| "-".to_owned(), |t| format!("{t:.4} s"));
    let mut rows = vec![
        ("outcome", format!("{} ({} at {:.4} s)", report.outcome, report.stopped, report.end_time_s)),
        (
            "largest rotation",
            format!(
                "{} rad ({} of the balance angle) at {}",
                significant(report.peak_rotation_rad, 6),
                significant(report.peak_rotation_ratio, 4),
                seconds(report.peak_rotation_time_s)
            ),
        ),
        ("uplift of the edge", format_si(report.uplift_m, Dimension::Length)),
        ("rise of the centre of gravity", format_si(report.cg_rise_m, Dimension::Length)),
        ("first uplift", seconds(report.first_uplift_time_s)),
        ("impacts", report.impact_count.to_string()),
        ("passes the balance angle", seconds(report.passed_alpha_time_s)),
        ("overturns", seconds(report.overturn_time_s)),
        ("comes to rest", seconds(report.rest_time_s)),
    ];
    if request.cushion.is_some() {
        rows.push(("shock at the edge, from the uplift", optional(report.edge_acceleration_g, 4, "g")));
        rows.push((
            "shock at the edge, from the impact velocity",
            optional(report.edge_acceleration_impact_velocity_g, 4, "g"),
        ));
        rows.push(("uplift ceiling", optional(report.ceiling_g, 4, "g")));
    }
    rows.extend([
        ("uplift threshold", format!("{} g", significant(report.uplift_threshold_g, 4))),
        ("restitution", significant(report.restitution_ratio, 6)),
        ("friction needed while rocking", optional(report.friction_needed_ratio, 4, "")),
        ("friction needed in an impact", significant(report.impact_friction_needed_ratio, 4)),
        ("frequency parameter p", format!("{} rad/s", significant(report.frequency_parameter_rad_s, 6))),
    ]);
    pairs(&rows)
}
