//! `freestand cushion curve`: the stress–energy curve of a packaging cushion.

use std::slice;

use clap::Args;
use freestand_app::cushion_curve::{CushionCurve, Meant, SCHEMA};
use freestand_output::answer::Answer;
use freestand_report::cushion::curve_doubt;
use freestand_report::table::lines;
use freestand_study::laboratory::cushion_curve::cushion_curve;

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Fit a cushion curve (ASTM D1596): stress–energy fit, best load, and thickness for a limit
///
/// The file has a row for each drop: static stress mg/A, drop height, thickness and peak
/// acceleration, with units in the header. The dynamic stress is fitted as a exp(b E), where E is
/// the energy per volume of cushion, so that a few tests give the curves of all heights and
/// thicknesses.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/cushion_curve.txt").trim_end())]
pub(crate) struct CurveArgs {
    #[command(flatten)]
    pub(super) request: CushionCurve,
}

impl Tell for CushionCurve {
    type Output = ();

    fn tell(
        Meant { file, design }: Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, slice::from_ref(&file))?;
        let report = cushion_curve(&file, &design)?;
        let warnings: Vec<String> = report.doubts.iter().map(curve_doubt).collect();
        files.print(printer, SCHEMA, &report, &warnings, || {
            lines(&report.facts())
        })?;
        Ok(Done::OK)
    }
}
