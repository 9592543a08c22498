//! `freestand motion info`: what is in record files.

use std::path::PathBuf;

use clap::Args;
use freestand::block::Block;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use freestand_output::facts::Facts;
use freestand_output::figure::Figure;
use freestand_study::inspect::{InfoReport, InfoRequest, MotionInfo, info};
use rayon::prelude::*;

use super::plot::{PlotArgs, place};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, facts_table, failed_lines, lines};
use crate::reading::ReadArgs;
use crate::values::{Given, Reads, Values};

/// Show the content of records: peaks, intensities, durations and periods of every component
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion info record.AT2
  freestand motion info columns.txt --unit gal --dt \"0.01 s\" --plot record.svg
  freestand motion info *.AT2 --height \"2 m\" --thickness \"500 mm\" --json
  freestand motion info *.AT2 --plot --out records

Measures are those of the processed motion. In JSON, the first and last values, mean and sum are
those of the file; processed_first_values_m_s2 and processed_last_values_m_s2 are those after
processing. A file that cannot be read is listed after the others, and the exit status is 1.")]
// Components are measured without rotation: the flag is known only to be refused with a hint.
#[command(mut_arg("azimuth", |arg| arg.hide(true)))]
pub(crate) struct InfoArgs {
    /// Records
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Height of a block, to see what the motions mean to it; needs --thickness
    #[arg(long, positive = Dimension::Length, requires = "thickness")]
    height: Option<Given>,
    /// Thickness of the block, its horizontal size in the plane of rocking; needs --height
    #[arg(long, positive = Dimension::Length, requires = "height")]
    thickness: Option<Given>,
    #[command(flatten)]
    plot: PlotArgs,
    #[command(flatten)]
    tables: TableArgs,
    #[command(flatten)]
    read: ReadArgs,
}

const SCHEMA: &str = "freestand.motion-info/1";

pub(crate) fn run(
    args: &InfoArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let files = args.read.files(&args.files, &mut values);
    let block = block(args, &mut values);
    values.finish()?;
    let target = args.plot.target(global)?;
    if let Some(target) = target.as_ref().filter(|_| args.files.len() > 1) {
        target.check(args.files.len())?;
    }
    let report = info(&InfoRequest {
        files,
        block,
        keep_motions: target.is_some(),
    })?;
    let out = Files::with_tables(
        global,
        &args.read.inputs(&args.files),
        &args.tables,
        SCHEMA,
        None,
    )?;
    let mut plots = Vec::new();
    if let Some(target) = target {
        target.check(report.motions.len())?;
        plots = place(
            &target,
            figures(&report)?,
            &out,
            &args.read.inputs(&args.files),
        )?;
    }
    out.table("measures", || report.measures_table())?;
    // The figures that were written.
    let facts = report.facts().key("plots", plots);
    out.print(printer, SCHEMA, &facts, &report.warnings, || {
        text(&report, block.is_some())
    })?;
    printer.failed(&report.failed);
    Ok(Done {
        criterion_met: report.failed.is_empty(),
    })
}

fn block(args: &InfoArgs, values: &mut Values) -> Option<Block> {
    let height_m = values.read(&args.height)?;
    let thickness_m = values.read(&args.thickness)?;
    let block = Block::uniform(height_m, thickness_m);
    values.take(
        block.map_err(|error| {
            Problem::value(error.to_string(), "check the dimensions of the object")
        }),
    )
}

fn figures(report: &InfoReport) -> Result<Vec<(String, Figure)>, Failure> {
    let drawn: Vec<Result<_, _>> = report
        .motions
        .par_iter()
        .filter_map(|one| {
            one.figure()
                .map(|figure| figure.map(|figure| (one.name.clone(), figure)))
                .transpose()
        })
        .collect();
    Ok(drawn.into_iter().collect::<Result<_, _>>()?)
}

fn text(report: &InfoReport, has_block: bool) -> String {
    let motions: Vec<Facts> = report.motions.iter().map(MotionInfo::facts).collect();
    let columns = if has_block {
        &COLUMNS[..]
    } else {
        &COLUMNS[..COLUMNS.len() - 3]
    };
    let text = if let [one] = motions.as_slice() {
        lines(one)
    } else {
        facts_table(&motions, columns)
    };
    text + &failed_lines(&report.failed)
}

/// The table of several motions; the last three columns need a block.
const COLUMNS: [Column; 17] = [
    ("path", "file", 0),
    ("format", "format", 0),
    ("component", "component", 0),
    ("unit", "unit", 0),
    ("dt_s", "dt [s]", 0),
    ("npts", "npts", 0),
    ("pga_g", "PGA [g]", 4),
    ("pgv_m_s", "PGV [m/s]", 4),
    ("pgd_m", "PGD [m]", 4),
    ("arias_m_s", "Arias [m/s]", 4),
    ("cav_m_s", "CAV [m/s]", 4),
    ("d5_95_s", "D5-95 [s]", 4),
    ("housner_m", "Housner [m]", 4),
    ("mean_period_s", "mean period [s]", 4),
    ("pga_over_threshold_ratio", "PGA/(g tan α)", 4),
    ("pgv_over_threshold_ratio", "p PGV/(g tan α)", 4),
    ("time_above_threshold_s", "above [s]", 4),
];
