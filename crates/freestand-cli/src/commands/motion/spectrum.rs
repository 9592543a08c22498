//! `freestand motion spectrum`: the response spectrum of a record.

use clap::Args;
use freestand_app::motion::{Meant, MotionSpectrum, SPECTRUM, SpectrumAnswer};
use freestand_report::doubts::motion_doubts;
use freestand_report::figures::spectrum_figure;
use freestand_report::motion::response_text;
use freestand_study::inspect::spectrum;

use super::info::Output;
use super::plot::place;
use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Calculate the response spectrum of a record, exact for a motion that is linear between samples
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_spectrum.txt").trim_end())]
pub(crate) struct SpectrumArgs {
    #[command(flatten)]
    pub(super) request: MotionSpectrum,
    #[command(flatten)]
    pub(super) output: Output,
}

impl Tell for MotionSpectrum {
    type Output = Output;

    fn tell(
        Meant {
            asked: (read, request),
            inputs,
        }: Self::Meant,
        output: &Output,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let target = output.plot.target(global)?;
        let report = spectrum(&read, &request)?;
        let files = Files::with_tables(global, &inputs, &output.tables, SPECTRUM, None)?;
        files.table("spectrum", || report.table())?;
        let mut plots = Vec::new();
        if let Some(target) = target {
            let figure = spectrum_figure(&report)?;
            let figures = vec![(figure.name.clone(), figure)];
            plots = place(&target, figures, &files, &inputs)?;
        }
        let document = SpectrumAnswer {
            report: &report,
            plots,
        };
        files.print(
            printer,
            SPECTRUM,
            &document,
            &motion_doubts(&report.doubts),
            || response_text(&report),
        )?;
        Ok(Done::OK)
    }
}
