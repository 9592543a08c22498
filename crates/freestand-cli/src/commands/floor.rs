//! `freestand floor`: how the floors of a building move.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand::building::{Building, floor_motions};
use freestand::code_spectrum::{FrameKind, fundamental_period_s};
use freestand::measures::measures;
use freestand::motion::Motion;
use freestand_study::inspect::check_upsampling;
use freestand_study::quantity::Dimension;
use freestand_study::records::write_csv;
use freestand_study::{Problem, ProblemKind};
use serde::Serialize;

use super::Done;
use crate::args::{GlobalArgs, at_least_one};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::reading::ReadArgs;
use crate::values::Values;

/// Floor motions of a building (shear-flexure beam of Miranda and Taghavi 2005) under a ground motion
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand floor --motion record.AT2 --storeys 30 --storey-height \"3.2 m\" --levels \"0.5, 1.0\" --out floors
  freestand floor --motion record.AT2 --storeys 12 --storey-height \"3 m\" --period \"1.2 s\" --json")]
pub(crate) struct FloorArgs {
    /// Ground motion
    #[arg(long, value_name = "FILE")]
    motion: PathBuf,
    /// Storeys
    #[arg(long, value_name = "N", default_value = "30", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=500))]
    storeys: u32,
    /// Height of a storey
    #[arg(long, value_name = "LENGTH", default_value = "3.2 m", allow_hyphen_values = true)]
    storey_height: String,
    /// Fundamental period [default: by AS 1170.4, from the height]
    #[arg(long, value_name = "TIME", conflicts_with = "frame", allow_hyphen_values = true)]
    period: Option<String>,
    /// Structure, for the period of AS 1170.4: steel-moment, concrete-moment, steel-braced, other [default: other]
    #[arg(long, value_name = "FRAME", value_parser = frame_kind)]
    frame: Option<FrameKind>,
    /// Damping ratio of every mode
    #[arg(long, value_name = "RATIO", default_value = "5 %", allow_hyphen_values = true)]
    damping: String,
    /// α₀ = H√(GA/EI): 0 flexural wall, 5 walls with frames, 20 and more a frame
    #[arg(long, value_name = "RATIO", default_value = "5", allow_hyphen_values = true)]
    shear_flexure: String,
    /// Modes
    #[arg(long, value_name = "N", default_value = "10", allow_negative_numbers = true)]
    modes: usize,
    /// Levels as shares of the height, 0 ground and 1 roof
    #[arg(long, value_name = "GRID", default_value = "0.5, 1.0", allow_hyphen_values = true)]
    levels: String,
    /// Zeros behind the record, in which the building rings down [default: none]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    tail: Option<String>,
    /// Look for the floors' peaks at N points in each sample interval; the ground stays linear between its samples
    #[arg(long, value_name = "N", default_value = "1", allow_negative_numbers = true, value_parser = at_least_one)]
    upsample: NonZeroUsize,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Serialize)]
struct FloorReport {
    motion: String,
    processing: Vec<String>,
    building_height_m: f64,
    damping_ratio: Option<f64>,
    shear_flexure_ratio: Option<f64>,
    pga_g: f64,
    modes: Vec<ModeReport>,
    levels: Vec<LevelReport>,
}

#[derive(Debug, Serialize)]
struct ModeReport {
    period_s: f64,
    participation_ratio: f64,
    effective_mass_ratio: Option<f64>,
}

#[derive(Debug, Serialize)]
struct LevelReport {
    level_ratio: f64,
    height_m: f64,
    pfa_g: f64,
    pfv_m_s: f64,
    path: Option<String>,
}

const SCHEMA: &str = "freestand.floor/1";

/// Most levels of one call: each is a motion in memory.
const MAX_LEVELS: usize = 1000;

pub(crate) fn run(args: &FloorArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let storey_height = values.positive("--storey-height", Some(&args.storey_height), Dimension::Length);
    let period = values.positive("--period", args.period.as_deref(), Dimension::Time);
    let damping = values.non_negative("--damping", Some(&args.damping), Dimension::Ratio);
    let shear_flexure = values.non_negative("--shear-flexure", Some(&args.shear_flexure), Dimension::Ratio);
    let tail_s = values.non_negative("--tail", args.tail.as_deref(), Dimension::Time).unwrap_or(0.0);
    let levels = values.grid("--levels", &args.levels, Dimension::Ratio).unwrap_or_default();
    if let Some(outside) = levels.iter().find(|x| !(0.0..=1.0).contains(*x)) {
        let problem = Problem::new(ProblemKind::Value, format!("--levels: {outside} is not a share of the height"));
        values.push(problem.hint("0 is the ground, 1 the roof"));
    }
    if levels.len() > MAX_LEVELS {
        let problem = Problem::new(ProblemKind::Value, format!("--levels: {} levels are too many", levels.len()));
        values.push(problem.hint(format!("at most {MAX_LEVELS} in one call")));
    }
    values.finish()?;
    let building_height_m = f64::from(args.storeys) * storey_height.unwrap_or(3.2);
    let wrong = |error: String| Failure::usage(error, "--help shows the ranges");
    let period_s = match period {
        Some(period_s) => period_s,
        None => fundamental_period_s(args.frame.unwrap_or(FrameKind::Other), building_height_m)
            .map_err(|error| wrong(error.to_string()))?,
    };
    let beam = Building::beam(period_s, damping.unwrap_or(0.05), shear_flexure.unwrap_or(5.0), args.modes)
        .map_err(|error| wrong(error.to_string()))?;
    let read = args.read.read_one(&args.motion)?;
    let ground = &with_tail(&read.motion.motion, tail_s)?;
    let factor = args.upsample.get();
    check_upsampling(factor, ground.accel_m_s2().len())?;
    let files = Files::begin(global, &args.read.inputs([&args.motion]))?;
    let failed = |error: freestand::building::BuildingError| Failure::computation(error.to_string());
    let floors = floor_motions(ground, &beam, &levels).map_err(failed)?;
    let fine = if factor == 1 {
        floors.clone()
    } else {
        floor_motions(&ground.upsampled(factor), &beam, &levels).map_err(failed)?
    };
    let later = floor_motions(&with_tail(ground, beam.tail_s())?, &beam, &levels).map_err(failed)?;

    let mut warnings = read.notes;
    let mut reports = Vec::new();
    for (i, &level_ratio) in levels.iter().enumerate() {
        warnings.extend(late_peak_warning(level_ratio, &floors[i], &later[i]));
        reports.push(LevelReport {
            level_ratio,
            height_m: level_ratio * building_height_m,
            pfa_g: fine[i].peak_m_s2() / G0_M_S2,
            pfv_m_s: measures(&fine[i]).pgv_m_s,
            path: files.write(&format!("level-{level_ratio}.csv"), || write_csv(&floors[i]))?,
        });
    }
    let report = FloorReport {
        motion: read.motion.name,
        processing: read.motion.processing,
        building_height_m,
        damping_ratio: beam.damping_ratio(),
        shear_flexure_ratio: beam.shear_flexure_ratio(),
        pga_g: ground.peak_m_s2() / G0_M_S2,
        modes: beam
            .modes()
            .iter()
            .map(|mode| ModeReport {
                period_s: mode.period_s(),
                participation_ratio: mode.participation_ratio(),
                effective_mass_ratio: mode.effective_mass_ratio(),
            })
            .collect(),
        levels: reports,
    };
    files.finish(SCHEMA, &report, &warnings)?;
    printer.result(SCHEMA, &report, &warnings, || text(&report))?;
    Ok(Done::OK)
}

/// The motion and its zeros; a tail that no memory holds is refused.
fn with_tail(motion: &Motion, tail_s: f64) -> Result<Motion, Failure> {
    motion.with_zero_tail(tail_s).map_err(|error| {
        Failure::usage(
            format!("{tail_s} s of zeros at steps of {} s: {error}", motion.dt_s()),
            "check --tail, --period and the time step of the record; ten periods of the building are enough",
        )
    })
}

fn frame_kind(name: &str) -> Result<FrameKind, String> {
    FrameKind::parse(name).ok_or_else(|| format!("known: {}", FrameKind::ALL.map(FrameKind::name).join(", ")))
}

/// The floor goes on moving when the record ends; say so where its peak is still to come.
fn late_peak_warning(level_ratio: f64, floor: &Motion, later: &Motion) -> Option<String> {
    (later.peak_m_s2() > floor.peak_m_s2()).then(|| {
        format!(
            "level {level_ratio}: the floor reaches {} g after the end of the record: let it ring down, with --tail",
            significant(later.peak_m_s2() / G0_M_S2, 4)
        )
    })
}

fn text(report: &FloorReport) -> String {
    let modes: Vec<Vec<String>> = report
        .modes
        .iter()
        .enumerate()
        .map(|(i, mode)| {
            vec![
                (i + 1).to_string(),
                significant(mode.period_s, 4),
                significant(mode.participation_ratio, 4),
                mode.effective_mass_ratio.map_or_else(|| "-".to_owned(), |ratio| significant(ratio, 4)),
            ]
        })
        .collect();
    let levels: Vec<Vec<String>> = report
        .levels
        .iter()
        .map(|level| {
            vec![
                level.level_ratio.to_string(),
                significant(level.height_m, 4),
                significant(level.pfa_g, 4),
                significant(level.pfv_m_s, 4),
                level.path.clone().unwrap_or_else(|| "-".to_owned()),
            ]
        })
        .collect();
    table(&["mode", "period [s]", "participation", "mass share"], &modes)
        + "\n"
        + &table(&["level", "height [m]", "PFA [g]", "PFV [m/s]", "file"], &levels)
}
