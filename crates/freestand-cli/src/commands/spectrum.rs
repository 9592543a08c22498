//! `freestand spectrum`: uplift and shock spectra over a grid of objects.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::impact::{ImpactModel, ValidityWarning, stiffness_warnings};
use freestand::rocking::{Base, RockingOptions};
use freestand::spectra::uplift_spectrum;
use freestand_study::output::write_file;
use freestand_study::quantity::Dimension;
use freestand_study::rock::problem;
use serde::Serialize;

use super::Done;
use super::block::RockingArgs;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, optional, significant, table};
use crate::reading::ReadArgs;
use crate::values::Values;

/// Uplift and shock spectra (URS, SRS): a grid of objects under records
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  Uplift of 64 × 64 objects:
    freestand spectrum --motion record.AT2 --heights \"0.3 m:4 m:64\" --thicknesses \"0.1 m:1 m:64\" --json
  Shock of three cabinets on their pads, two records:
    freestand spectrum --motion a.AT2 b.AT2 --heights \"1.5 m, 2 m\" --thicknesses \"300 mm, 400 mm\" \\
      --mass 150kg --stiffness \"4380 N/mm\"")]
pub(crate) struct SpectrumArgs {
    /// Records of the base's horizontal acceleration
    #[arg(long, value_name = "FILE", required = true, num_args = 1..)]
    motion: Vec<PathBuf>,
    #[command(flatten)]
    read: ReadArgs,
    /// Heights: a grid "from:to:count" or a list
    #[arg(long, value_name = "GRID", allow_hyphen_values = true, help_heading = "The objects")]
    heights: String,
    /// Thicknesses: a grid "from:to:count" or a list
    #[arg(long, value_name = "GRID", allow_hyphen_values = true, help_heading = "The objects")]
    thicknesses: String,
    /// Mass, for the shock
    #[arg(long, value_name = "MASS", allow_hyphen_values = true, requires = "stiffness", help_heading = "The objects")]
    mass: Option<String>,
    /// Stiffness of all the cushion under one edge, for the shock
    #[arg(long, value_name = "STIFFNESS", allow_hyphen_values = true, requires = "mass", help_heading = "The objects")]
    stiffness: Option<String>,
    #[command(flatten)]
    rocking: RockingArgs,
    /// File for the rows (CSV)
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
}

#[derive(Debug, Serialize)]
struct Row {
    motion: String,
    height_m: f64,
    thickness_m: f64,
    outcome: &'static str,
    peak_rotation_rad: Option<f64>,
    impact_count: Option<usize>,
    uplift_m: Option<f64>,
    cg_rise_m: Option<f64>,
    edge_acceleration_g: Option<f64>,
    edge_acceleration_impact_velocity_g: Option<f64>,
    ceiling_g: Option<f64>,
    reason: Option<String>,
}

#[derive(Debug, Serialize)]
struct Timing {
    solve_s: f64,
    block_steps: u64,
}

#[derive(Debug, Serialize)]
struct Report {
    rows: Vec<Row>,
    processing: Vec<Processed>,
    timing: Timing,
}

#[derive(Debug, Serialize)]
struct Processed {
    motion: String,
    steps: Vec<String>,
}

pub(crate) fn run(args: &SpectrumArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let heights = values.grid("--heights", &args.heights, Dimension::Length).unwrap_or_default();
    let thicknesses = values.grid("--thicknesses", &args.thicknesses, Dimension::Length).unwrap_or_default();
    let mass = values.positive("--mass", args.mass.as_deref(), Dimension::Mass);
    let stiffness = values.positive("--stiffness", args.stiffness.as_deref(), Dimension::Stiffness);
    let cushion = mass.zip(stiffness);
    let options = RockingOptions {
        model: args.rocking.model(),
        restitution: args.rocking.restitution(&mut values),
        accuracy: args.rocking.accuracy(),
        ..RockingOptions::default()
    };
    values.finish()?;
    let blocks = grid(&heights, &thicknesses)?;
    for block in &blocks {
        options.restitution.ratios(block).map_err(problem)?;
    }
    let motions = args.read.read_all(&args.motion)?;
    let files = Files::begin(global, &args.read.inputs(&args.motion))?;

    let mut warnings: Vec<String> =
        motions.iter().flat_map(|read| read.notes.iter().map(|note| format!("{}: {note}", read.motion.name))).collect();
    if let Some(block) = blocks.iter().find(|block| block.landing_ratio() < 0.0) {
        let count = blocks.iter().filter(|block| block.landing_ratio() < 0.0).count();
        let warning = ValidityWarning::Squat { landing_ratio: block.landing_ratio() };
        warnings.push(format!("{count} of {} objects: {warning}", blocks.len()));
    }
    if let Some((mass, stiffness)) = cushion {
        warnings.extend(stiffness_warnings(mass, stiffness, None).iter().map(ToString::to_string));
    }

    let start = Instant::now();
    let cells: Vec<_> = motions
        .iter()
        .map(|read| uplift_spectrum(&blocks, Base { horizontal: Some(&read.motion.motion), vertical: None }, &options))
        .collect();
    let solve_s = start.elapsed().as_secs_f64();
    let steps = |intervals: usize| (blocks.len() as u64) * (intervals as u64);
    let block_steps = motions.iter().map(|read| steps(read.motion.motion.accel_m_s2().len() - 1)).sum();

    let mut rows = Vec::with_capacity(blocks.len() * motions.len());
    for (read, cells) in motions.iter().zip(&cells) {
        for (block, cell) in blocks.iter().zip(cells) {
            let shock = cell
                .ok()
                .zip(cushion)
                .map(|(cell, (mass, stiffness))| cell.shock(mass, stiffness, ImpactModel::Paper, G0_M_S2));
            rows.push(Row {
                motion: read.motion.name.clone(),
                height_m: block.height_m(),
                thickness_m: block.thickness_m(),
                outcome: cell.map_or("failed", |cell| cell.outcome.name()),
                peak_rotation_rad: cell.ok().map(|cell| cell.peak_rotation_rad),
                impact_count: cell.ok().map(|cell| cell.impact_count),
                uplift_m: cell.ok().map(|cell| cell.uplift_m),
                cg_rise_m: cell.ok().map(|cell| cell.cg_rise_m),
                edge_acceleration_g: shock.and_then(|shock| shock.edge_acceleration_g),
                edge_acceleration_impact_velocity_g: shock.and_then(|shock| shock.edge_acceleration_impact_velocity_g),
                ceiling_g: shock.map(|shock| shock.ceiling_g),
                reason: cell.err().map(|error| error.to_string()),
            });
        }
    }
    let failed = rows.iter().filter(|row| row.reason.is_some()).count();
    if failed > 0 {
        warnings.push(format!("{failed} of {} histories could not be followed: see their `reason`", rows.len()));
    }
    if args.csv.is_some() || files.wanted() {
        let columns = freestand_study::tables::records_csv(&rows)?;
        if let Some(path) = &args.csv {
            write_file(path, &columns, &args.read.inputs(&args.motion))?;
        }
        files.write("rows.csv", || columns)?;
    }
    let processing =
        motions.into_iter().map(|read| Processed { motion: read.motion.name, steps: read.motion.processing }).collect();
    let report = Report { rows, processing, timing: Timing { solve_s, block_steps } };
    files.print(printer, "freestand.spectrum/1", &report, &warnings, || text(&report))?;
    Ok(Done { criterion_met: failed == 0 })
}

/// Every object of the grid, thickness by thickness within each height.
fn grid(heights_m: &[f64], thicknesses_m: &[f64]) -> Result<Vec<Block>, Failure> {
    if heights_m.len().saturating_mul(thicknesses_m.len()) > freestand_study::resolve::MAX_OBJECTS {
        return Err(Failure::usage(
            format!("{} × {} objects are too many", heights_m.len(), thicknesses_m.len()),
            format!("at most {} in one call", freestand_study::resolve::MAX_OBJECTS),
        ));
    }
    let pairs = heights_m.iter().flat_map(|h| thicknesses_m.iter().map(move |t| (*h, *t)));
    pairs
        .map(|(height_m, thickness_m)| {
            Block::uniform(height_m, thickness_m)
                .map_err(|error| Failure::usage(error.to_string(), "check --heights and --thicknesses"))
        })
        .collect()
}

fn text(report: &Report) -> String {
    let millimetres = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |v| significant(1e3 * v, 4));
    let rows: Vec<Vec<String>> = report
        .rows
        .iter()
        .map(|row| {
            vec![
                row.motion.clone(),
                significant(row.height_m, 4),
                significant(row.thickness_m, 4),
                row.outcome.to_owned(),
                millimetres(row.uplift_m),
                optional(row.edge_acceleration_g, 4, ""),
                optional(row.edge_acceleration_impact_velocity_g, 4, ""),
                optional(row.ceiling_g, 4, ""),
            ]
        })
        .collect();
    let headings = [
        "motion",
        "height m",
        "thickness m",
        "outcome",
        "uplift mm",
        "shock g (uplift)",
        "shock g (impact velocity)",
        "ceiling g",
    ];
    let steps = report.timing.block_steps;
    format!("{}\n{steps} block-steps in {} s\n", table(&headings, &rows), significant(report.timing.solve_s, 3))
}
