//! `freestand motion synth` and `match`: motions that fit a code's spectrum.

use std::path::PathBuf;

use clap::Args;
use freestand::synthesis::{GENERATOR, MatchedMotion, SynthesisError, SynthesisOptions, match_motion, synthesize};
use freestand_study::recorded::name_of;
use freestand_study::records::write_csv;
use freestand_study::study::synthetic_name;
use freestand_study::{Problem, ProblemKind};
use rayon::prelude::*;
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::reading::ReadArgs;
use crate::target::{TargetArgs, TargetReport};

/// Synthetic motions that fit the elastic spectrum of a code, or a table
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion synth --site De --city Melbourne --count 10 --seed 1 --out motions
  freestand motion synth --hazard-factor 0.11 --return-period 2500 --count 3 --json
  freestand motion synth --code asce7 --sds 1g --sd1 0.6g --long-period 8s --out motions
  freestand motion synth --spectrum uhs.csv --beyond hold --out motions")]
pub(crate) struct SynthArgs {
    #[command(flatten)]
    target: TargetArgs,
    /// How many motions
    #[arg(long, value_name = "N", default_value = "10", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=1000))]
    count: u32,
}

/// A record matched to the elastic spectrum of a code; its phases stay
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  freestand motion match record.AT2 --code as1170.4 --site De --city Melbourne --out matched")]
pub(crate) struct MatchArgs {
    /// Record file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    target: TargetArgs,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Serialize)]
struct SynthReport {
    #[serde(flatten)]
    code: TargetReport,
    seed: Option<u64>,
    generator: Option<&'static str>,
    motions: Vec<MatchedReport>,
}

#[derive(Debug, Serialize)]
struct MatchedReport {
    name: String,
    path: Option<String>,
    dt_s: f64,
    npts: usize,
    rms_misfit_ratio: f64,
    worst_misfit_ratio: f64,
    worst_misfit_period_s: f64,
    pga_g: f64,
    target_zpa_g: f64,
    pgv_m_s: f64,
    d5_95_s: f64,
}

const SCHEMA: &str = "freestand.motion-synth/1";

pub(crate) fn run(args: &SynthArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let target = args.target.matched_target()?;
    let inputs: Vec<PathBuf> = args.target.inputs().cloned().collect();
    let files = Files::begin(global, &inputs)?;
    let seed = global.seed.unwrap_or(1);
    // Each motion has its own stream of random numbers, so the order in which they are made does not matter.
    let matched: Vec<MatchedMotion> = (0..u64::from(args.count))
        .into_par_iter()
        .map(|index| synthesize(|period_s| target.spectrum.sa_g(period_s), seed, index, &SynthesisOptions::default()))
        .collect::<Result<_, SynthesisError>>()
        .map_err(|error| Failure::computation(error.to_string()))?;
    let named = matched.into_iter().enumerate().map(|(i, one)| (synthetic_name(i), one));
    let motions = written(named, &files)?;
    let report =
        SynthReport { code: TargetReport::from(&target), seed: Some(seed), generator: Some(GENERATOR), motions };
    finish(report, files, target.warnings, printer)
}

pub(crate) fn run_match(args: &MatchArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let target = args.target.matched_target()?;
    let mut warnings = target.warnings.clone();
    let read = args.read.read_one(&args.file)?;
    let files = Files::begin(global, &args.read.inputs(std::iter::once(&args.file).chain(args.target.inputs())))?;
    let matched = match_motion(
        &read.motion.motion,
        |period_s| target.spectrum.sa_g(period_s),
        SynthesisOptions::default().passes,
    )
    .map_err(|error| {
        Problem::new(ProblemKind::Value, error.to_string())
            .in_file(&args.file)
            .hint("a record of 5 s or more with energy at all periods from 0.05 to 5 s is needed")
    })?;
    warnings.extend(read.notes);
    let motions = written(std::iter::once((format!("{}-matched", name_of(&args.file)), matched)), &files)?;
    let report = SynthReport { code: TargetReport::from(&target), seed: None, generator: None, motions };
    finish(report, files, warnings, printer)
}

fn written(named: impl Iterator<Item = (String, MatchedMotion)>, files: &Files) -> Result<Vec<MatchedReport>, Failure> {
    named
        .map(|(name, one)| {
            let path = files.write(&format!("{name}.csv"), || write_csv(&one.motion))?;
            Ok(MatchedReport {
                name,
                path,
                dt_s: one.motion.dt_s(),
                npts: one.motion.accel_m_s2().len(),
                rms_misfit_ratio: one.misfit.rms_ratio,
                worst_misfit_ratio: one.misfit.worst_ratio,
                worst_misfit_period_s: one.misfit.worst_period_s,
                pga_g: one.misfit.pga_g,
                target_zpa_g: one.misfit.target_zpa_g,
                pgv_m_s: one.misfit.pgv_m_s,
                d5_95_s: one.misfit.d5_95_s,
            })
        })
        .collect()
}

fn finish(report: SynthReport, files: Files, mut warnings: Vec<String>, printer: &Printer) -> Result<Done, Failure> {
    if let Some(worst) = report.motions.iter().max_by(|a, b| a.pga_g.total_cmp(&b.pga_g))
        && worst.pga_g > 1.05 * worst.target_zpa_g
    {
        warnings.push(format!(
            "the PGA of the motions reaches {} g, the spectrum at T = 0 is {} g: a record that fits the plateau cannot have so low a PGA",
            significant(worst.pga_g, 3),
            significant(worst.target_zpa_g, 3)
        ));
    }
    files.finish(SCHEMA, &report, &warnings)?;
    printer.result(SCHEMA, &report, &warnings, || text(&report))?;
    Ok(Done::OK)
}

fn text(report: &SynthReport) -> String {
    let rows: Vec<Vec<String>> = report
        .motions
        .iter()
        .map(|one| {
            vec![
                one.path.clone().unwrap_or_else(|| one.name.clone()),
                significant(100.0 * one.rms_misfit_ratio, 3),
                significant(100.0 * one.worst_misfit_ratio, 3),
                significant(one.worst_misfit_period_s, 3),
                significant(one.pga_g, 3),
                significant(one.target_zpa_g, 3),
                significant(one.pgv_m_s, 3),
                significant(one.d5_95_s, 3),
            ]
        })
        .collect();
    let headings = ["motion", "rms [%]", "worst [%]", "at T [s]", "PGA [g]", "Sa(0) [g]", "PGV [m/s]", "D5-95 [s]"];
    table(&headings, &rows)
}
