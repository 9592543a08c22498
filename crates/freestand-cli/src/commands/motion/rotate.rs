//! `freestand motion rotate`: the motion in another direction.

use clap::Args;
use freestand_app::motion::{FORMATS, Format};
use freestand_input::quantity::Dimension;
use freestand_records::processing::azimuth_deg;
use freestand_study::pair::{RotateRequest, read_pair, rotate};
use serde::Serialize;

use super::convert::{Converted, write};
use super::pair::{PairArgs, azimuths};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;
use crate::values::{Given, Reads, Values, choice, name_of};

/// Rotate two horizontal components to the one at another azimuth
///
/// Writes into the folder of --out; without it, the motion is printed.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion rotate record.v2 --to \"30 deg\" > record-30.csv
  freestand motion rotate north.AT2 east.AT2 --azimuths \"0 deg, 90 deg\" --to \"30 deg\" \\
    --format at2 --out rotated")]
pub(crate) struct RotateArgs {
    #[command(flatten)]
    pair: PairArgs,
    /// Azimuth of the new component, clockwise from north
    #[arg(long, any = Dimension::Angle)]
    to: Given,
    /// Azimuths of the two components [default: those stated in the files]
    #[arg(long, value_name = "ANGLE, ANGLE", read = azimuths)]
    azimuths: Option<Given<(f64, f64)>>,
    /// Format to write
    #[arg(long, value_parser = choice(FORMATS), default_value = name_of(FORMATS, Format::Csv))]
    format: Format,
}

#[derive(Debug, Serialize)]
struct RotateReport {
    azimuth_deg: f64,
    #[serde(flatten)]
    motion: Converted,
}

pub(crate) fn run(
    args: &RotateArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let to = values.read(&args.to);
    let azimuths_deg = values.read(&args.azimuths);
    let pair = args.pair.request(&mut values);
    values.finish()?;
    let read = read_pair(&pair)?;
    let azimuth_deg = to.map(azimuth_deg).unwrap_or_default();
    let turned = rotate(
        &read,
        &RotateRequest {
            azimuth_deg,
            azimuths_deg,
        },
    )?;
    let files = Files::begin(global, &args.pair.inputs())?;
    let done = &turned.processed;
    let motion = write(
        args.format,
        &files,
        (&turned.path, &turned.name),
        &done.motion,
        &done.steps,
        done.scale_ratio,
    )?;
    let report = RotateReport {
        azimuth_deg: turned.azimuth_deg,
        motion,
    };
    const SCHEMA: &str = "freestand.motion-rotate/1";
    files.finish(SCHEMA, &report, &turned.warnings)?;
    printer.result(SCHEMA, &report, &turned.warnings, || report.motion.shown())?;
    Ok(Done::OK)
}
