//! `freestand motion info`: what is in record files.

use clap::Args;
use freestand_app::motion::{INFO, Meant, MotionInfo};
use freestand_output::figure::Figure;
use freestand_report::figures::info_figure;
use freestand_report::motion::measures_text;
use freestand_study::inspect::{InfoReport, InfoRequest, info};
use rayon::prelude::*;

use super::plot::{PlotArgs, place};
use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::Printer;

/// Show the content of records: peaks, intensities, durations and periods of every component
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_info.txt").trim_end())]
pub(crate) struct InfoArgs {
    #[command(flatten)]
    pub(super) request: MotionInfo,
    #[command(flatten)]
    pub(super) output: Output,
}

/// The files that are written.
#[derive(Debug, Default, Args)]
pub(crate) struct Output {
    #[command(flatten)]
    pub(super) plot: PlotArgs,
    #[command(flatten)]
    pub(super) tables: TableArgs,
}

impl Tell for MotionInfo {
    type Output = Output;

    fn tell(
        Meant { asked, inputs }: Meant<InfoRequest>,
        output: &Output,
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let target = output.plot.target(global)?;
        let (count, has_block) = (asked.files.paths.len(), asked.block.is_some());
        if let Some(target) = target.as_ref().filter(|_| count > 1) {
            target.check(count)?;
        }
        let mut report = info(&InfoRequest {
            keep_motions: target.is_some(),
            ..asked
        })?;
        let out = Files::with_tables(global, &inputs, &output.tables, INFO, None)?;
        if let Some(target) = target {
            target.check(report.motions.len())?;
            report.plots = place(&target, figures(&report)?, &out, &inputs)?;
        }
        out.table("measures", || report.measures_table())?;
        out.print(printer, INFO, &report, &report.warnings, || {
            measures_text(&report, has_block)
        })?;
        printer.failed(&report.failed);
        Ok(Done {
            criterion_met: report.failed.is_empty(),
        })
    }
}

fn figures(report: &InfoReport) -> Result<Vec<(String, Figure)>, Failure> {
    let drawn: Vec<Result<_, _>> = report
        .motions
        .par_iter()
        .filter_map(|one| {
            info_figure(one)
                .map(|figure| figure.map(|figure| (one.name.clone(), figure)))
                .transpose()
        })
        .collect();
    Ok(drawn.into_iter().collect::<Result<_, _>>()?)
}
