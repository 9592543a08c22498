//! `freestand motion rotate`: the component at another azimuth.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_study::processing::{azimuth_deg, turned, with_azimuths};
use freestand_study::quantity::Dimension;
use freestand_study::words::number;
use serde::Serialize;

use super::convert::{Converted, Target};
use super::pair::{PairArgs, azimuths};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;
use crate::values::Values;

/// The component at another azimuth, of two horizontal ones: to --out, or to standard output
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion rotate record.v2 --to \"30 deg\" > record-30.csv
  freestand motion rotate north.AT2 east.AT2 --azimuths \"0 deg, 90 deg\" --to \"30 deg\" --format at2 --out turned")]
pub(crate) struct RotateArgs {
    #[command(flatten)]
    pair: PairArgs,
    /// Azimuth to turn to, clockwise from north
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    to: String,
    /// Azimuths of the two components [default: as the files state them]
    #[arg(long, value_name = "ANGLE, ANGLE", allow_hyphen_values = true)]
    azimuths: Option<String>,
    /// Format to write
    #[arg(long, value_enum, default_value = "csv")]
    format: Target,
}

#[derive(Debug, Serialize)]
struct RotateReport {
    azimuth_deg: f64,
    #[serde(flatten)]
    motion: Converted,
}

pub(crate) fn run(args: &RotateArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let to = values.any("--to", Some(&args.to), Dimension::Angle);
    let given = azimuths(args.azimuths.as_deref(), &mut values);
    values.finish()?;
    let azimuth_deg = to.map(azimuth_deg).unwrap_or_default();
    let read = args.pair.read()?;
    let (first, second) = with_azimuths(read.components()?, given)?;
    let processed = turned(first, second, azimuth_deg, &read.processing)?;
    let mut warnings = read.notes.clone();
    warnings.extend(processed.notes.iter().cloned());
    let files = Files::begin(global, &args.pair.files)?;
    let name = format!("{}-{}deg", read.name(), number(azimuth_deg.rem_euclid(360.0), 6));
    let source = args.pair.files.first().map(PathBuf::as_path).unwrap_or(Path::new(""));
    let motion = args.format.write(&files, source, &name, &processed.motion, &processed.steps)?;
    let report = RotateReport { azimuth_deg, motion };
    const SCHEMA: &str = "freestand.motion-rotate/1";
    files.finish(SCHEMA, &report, &warnings)?;
    printer.result(SCHEMA, &report, &warnings, || report.motion.shown())?;
    Ok(Done::OK)
}
