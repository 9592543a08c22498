//! `freestand cushion curve`: the stress–energy curve of a packaging cushion.

use std::path::PathBuf;

use clap::Args;
use freestand::G0_M_S2;
use freestand_input::quantity::Dimension;
use freestand_output::answer::Answer;
use freestand_study::laboratory::cushion_curve::{CurveRequest, cushion_curve};

use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, lines};
use crate::values::{Given, Reads, Values};

/// Fit a cushion curve (ASTM D1596): stress–energy fit, best load, and thickness for a limit
///
/// The file has a row for each drop: static stress mg/A, drop height, thickness and peak
/// acceleration, with units in the header. The dynamic stress is fitted as a exp(b E), where E is
/// the energy per volume of cushion, so that a few tests give the curves of all heights and
/// thicknesses.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  The curve, the best load on 50 mm for drops from 600 mm, and the smallest thickness for 40 g:
    freestand cushion curve foam.csv --drop-height 600mm --thickness 50mm --limit 40g
  The thickness for 70 kg on 0.02 m2:
    freestand cushion curve foam.csv --drop-height 600mm --mass 70kg --area \"0.02 m2\" --limit 40g")]
pub(crate) struct CurveArgs {
    /// Table of tests with a header such as "static stress [kPa],drop height [mm],thickness
    /// [mm],peak acceleration [g]"
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Drop height of the design, and of tests in a file without that column
    #[arg(long, positive = Dimension::Length)]
    drop_height: Option<Given>,
    /// Thickness of the design, and of tests in a file without that column
    #[arg(long, positive = Dimension::Length)]
    thickness: Option<Given>,
    /// Static stress of the design
    #[arg(long, positive = Dimension::Pressure, conflicts_with_all = ["mass", "area"])]
    static_stress: Option<Given>,
    /// Mass on the cushion; needs --area
    #[arg(long, positive = Dimension::Mass, requires = "area")]
    mass: Option<Given>,
    /// Area of the cushion; needs --mass
    #[arg(long, positive = Dimension::Area, requires = "mass")]
    area: Option<Given>,
    /// Peak acceleration that must not be exceeded
    #[arg(long, positive = Dimension::Acceleration)]
    limit: Option<Given>,
}

pub(crate) fn run(
    args: &CurveArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let drop_height_m = values.read(&args.drop_height);
    let thickness_m = values.read(&args.thickness);
    let stated_pa = values.read(&args.static_stress);
    let mass = values.read(&args.mass);
    let area = values.read(&args.area);
    let limit_m_s2 = values.read(&args.limit);
    values.finish()?;
    let static_stress_pa = stated_pa.or(mass.zip(area).map(|(mass, area)| mass * G0_M_S2 / area));
    let request = CurveRequest {
        drop_height_m,
        thickness_m,
        static_stress_pa,
        limit_m_s2,
    };
    let files = Files::begin(global, std::slice::from_ref(&args.file))?;
    let report = cushion_curve(&args.file, &request)?;
    files.print(
        printer,
        "freestand.cushion-curve/1",
        &report,
        &report.warnings,
        || lines(&report.facts()),
    )?;
    Ok(Done::OK)
}
