//! `freestand motion info`: what is in record files.

use std::path::PathBuf;

use clap::Args;
use freestand::block::Block;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_output::figure::Figure;
use freestand_study::inspect::{InfoReport, InfoRequest, MotionInfo, info};
use rayon::prelude::*;
use serde::Serialize;

use super::plot::{PlotArgs, failed, place};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::{Failure, problem};
use crate::files::Files;
use crate::printer::{Printer, optional, pairs, print_failure, significant, table};
use crate::reading::ReadArgs;
use crate::values::{Given, Reads, Values};

/// The content of records: peaks, intensities, durations and periods of every component
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion info record.AT2
  freestand motion info columns.txt --unit gal --dt \"0.01 s\" --plot record.svg
  freestand motion info *.AT2 --height \"2 m\" --thickness \"500 mm\" --json
  freestand motion info *.AT2 --plot --out records

Measures are those of the processed motion. In JSON, the first and last values, mean and sum are those
of the file; processed_first_values_m_s2 and processed_last_values_m_s2 are those after processing.
A file that cannot be read is listed after the others, and the exit status is 1.")]
// Every component is measured as it is: the flag is known but refused.
#[command(mut_arg("azimuth", |arg| arg.hide(true)))]
pub(crate) struct InfoArgs {
    /// Records
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Height of a block, to see what the motions mean to it; needs --thickness
    #[arg(long, positive = Dimension::Length, requires = "thickness")]
    height: Option<Given>,
    /// Thickness of the block in the plane of motion; needs --height
    #[arg(long, positive = Dimension::Length, requires = "height")]
    thickness: Option<Given>,
    #[command(flatten)]
    plot: PlotArgs,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    report: &'a InfoReport,
    /// The pictures that were written.
    plots: Vec<String>,
}

pub(crate) fn run(args: &InfoArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let files = args.read.files(&args.files, &mut values);
    let block = block(args, &mut values);
    values.finish()?;
    let target = args.plot.target(global)?;
    if let Some(target) = target.as_ref().filter(|_| args.files.len() > 1) {
        target.check(args.files.len())?;
    }
    let report = info(&InfoRequest { files, block, keep_motions: target.is_some() }).map_err(Failure::Problems)?;
    let out = Files::begin(global, &args.read.inputs(&args.files))?;
    let mut plots = Vec::new();
    if let Some(target) = target {
        target.check(report.motions.len())?;
        plots = place(&target, figures(&report)?, &out, &args.read.inputs(&args.files))?;
    }
    if out.wanted() {
        let csv = report.measures_csv()?;
        out.write("measures.csv", || csv)?;
    }
    let document = Document { report: &report, plots };
    out.print(printer, "freestand.motion-info/1", &document, &report.warnings, || text(&report))?;
    let problems: Vec<Problem> = report.failed.iter().map(|one| one.problem.clone()).collect();
    print_failure(&Failure::Problems(problems));
    Ok(Done { criterion_met: report.failed.is_empty() })
}

fn block(args: &InfoArgs, values: &mut Values) -> Option<Block> {
    let height_m = values.read(&args.height)?;
    let thickness_m = values.read(&args.thickness)?;
    let block = Block::uniform(height_m, thickness_m);
    values.take(block.map_err(|error| problem(error.to_string(), "check the sizes of the object")))
}

fn figures(report: &InfoReport) -> Result<Vec<(String, Figure)>, Failure> {
    let drawn: Vec<Result<_, _>> = report
        .motions
        .par_iter()
        .filter_map(|one| one.figure().map(|figure| figure.map(|figure| (one.name.clone(), figure))).transpose())
        .collect();
    drawn.into_iter().collect::<Result<_, _>>().map_err(failed)
}

fn text(report: &InfoReport) -> String {
    let motions = match report.motions.as_slice() {
        [one] => one_motion(one),
        several => many_motions(several),
    };
    let failed = report.failed.iter().map(|one| format!("failed: {}: {}\n", one.path, one.reason));
    motions + &failed.collect::<String>()
}

/// One motion from top to bottom.
fn one_motion(one: &MotionInfo) -> String {
    let with = |value: f64, unit: &str| format!("{} {unit}", significant(value, 4));
    let direction = match (one.direction, one.azimuth_deg) {
        (_, Some(degrees)) => format!("{degrees} deg from north"),
        (Some(direction), None) => direction.to_owned(),
        (None, None) => "-".to_owned(),
    };
    let mut rows = vec![
        ("file", one.path.clone()),
        ("format", one.format.to_owned()),
        ("component", one.component.clone()),
        ("station", one.station.clone().unwrap_or_else(|| "-".to_owned())),
        ("direction", direction),
        ("samples", format!("{} every {} s: {}", one.npts, one.dt_s, with(one.duration_s, "s"))),
        ("unit in the file", format!("{}{}", one.unit, if one.is_raw { ", raw" } else { "" })),
        ("processing", if one.processing.is_empty() { "none".to_owned() } else { one.processing.join("; ") }),
        (
            "PGA",
            format!(
                "{} ({}) at {} s",
                with(one.pga_g, "g"),
                with(one.pga_signed_m_s2, "m/s2"),
                significant(one.pga_time_s, 4)
            ),
        ),
        ("PGV", with(one.pgv_m_s, "m/s")),
        ("PGD", with(one.pgd_m, "m")),
        ("RMS acceleration", with(one.rms_m_s2, "m/s2")),
        ("Arias intensity", with(one.arias_m_s, "m/s")),
        ("CAV", with(one.cav_m_s, "m/s")),
        ("CAV, standardised", with(one.cav_std_m_s, "m/s")),
        ("specific energy", with(one.specific_energy_density_m2_s, "m2/s")),
        ("D5-75", with(one.d5_75_s, "s")),
        ("D5-95", with(one.d5_95_s, "s")),
        ("bracketed, 0.05 g", with(one.bracketed_duration_s, "s")),
        ("uniform, 0.05 g", with(one.uniform_duration_s, "s")),
        ("Housner intensity", with(one.housner_m, "m")),
        ("ASI", with(one.asi_m_s, "m/s")),
        ("mean period", optional(one.mean_period_s, 4, "s")),
        ("predominant period", optional(one.predominant_period_s, 4, "s")),
    ];
    if one.uplift_threshold_g.is_some() {
        let excursions = one.excursions_above_threshold.unwrap_or(0);
        rows.extend([
            ("uplift at g tan a", optional(one.uplift_threshold_g, 4, "g")),
            ("PGA/(g tan a)", optional(one.pga_over_threshold_ratio, 4, "")),
            ("p PGV/(g tan a)", optional(one.pgv_over_threshold_ratio, 4, "")),
            ("time above", format!("{} in {excursions} excursions", optional(one.time_above_threshold_s, 4, "s"))),
        ]);
    }
    pairs(&rows)
}

/// Many motions, one a line.
fn many_motions(motions: &[MotionInfo]) -> String {
    let mut headings = vec![
        "file",
        "format",
        "component",
        "unit",
        "dt [s]",
        "npts",
        "PGA [g]",
        "PGV [m/s]",
        "PGD [m]",
        "Arias [m/s]",
        "CAV [m/s]",
        "D5-95 [s]",
        "SI [m]",
        "Tm [s]",
    ];
    let with_block = motions.iter().any(|one| one.uplift_threshold_g.is_some());
    if with_block {
        headings.extend(["PGA/(g tan a)", "p PGV/(g tan a)", "above [s]"]);
    }
    let rows: Vec<Vec<String>> = motions
        .iter()
        .map(|one| {
            let mut row = vec![
                one.path.clone(),
                one.format.to_owned(),
                one.component.clone(),
                one.unit.to_owned(),
                one.dt_s.to_string(),
                one.npts.to_string(),
                significant(one.pga_g, 4),
                significant(one.pgv_m_s, 4),
                significant(one.pgd_m, 4),
                significant(one.arias_m_s, 4),
                significant(one.cav_m_s, 4),
                significant(one.d5_95_s, 4),
                significant(one.housner_m, 4),
                optional(one.mean_period_s, 4, ""),
            ];
            if with_block {
                row.extend([
                    optional(one.pga_over_threshold_ratio, 4, ""),
                    optional(one.pgv_over_threshold_ratio, 4, ""),
                    optional(one.time_above_threshold_s, 4, ""),
                ]);
            }
            row
        })
        .collect();
    table(&headings, &rows)
}
