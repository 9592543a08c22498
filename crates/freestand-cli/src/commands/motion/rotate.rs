//! `freestand motion rotate`: the motion in another direction.

use clap::Args;
use freestand_app::motion::Meant;
use freestand_app::pair::{ROTATE, Rotate, RotateReport, Turning};
use freestand_report::doubts::motion_doubts;
use freestand_study::pair::rotate;

use super::convert::{shown, write};
use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Rotate two horizontal components to the one at another azimuth
///
/// Writes into the folder of --out; without it, the motion is printed.
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_rotate.txt").trim_end())]
pub(crate) struct RotateArgs {
    #[command(flatten)]
    pub(super) request: Rotate,
}

impl Tell for Rotate {
    type Output = ();

    fn tell(
        Meant {
            asked:
                Turning {
                    pair,
                    request,
                    format,
                },
            inputs,
        }: Self::Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let turned = rotate(&pair, &request)?;
        let files = Files::begin(global, &inputs)?;
        let done = &turned.processed;
        let motion = write(
            format,
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
        let warnings = motion_doubts(&turned.doubts);
        files.finish(ROTATE, &report, &warnings)?;
        printer.result(ROTATE, &report, &warnings, || shown(&report.motion))?;
        Ok(Done::OK)
    }
}
