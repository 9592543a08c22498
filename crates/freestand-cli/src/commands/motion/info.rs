//! `freestand motion info`: what is in record files.

use clap::Args;
use freestand_app::motion::{INFO, Meant, MotionInfo};
use freestand_output::answer::Answer;
use freestand_output::figure::Figure;
use freestand_study::inspect::{InfoReport, InfoRequest, info};
use rayon::prelude::*;

use super::plot::{PlotArgs, place};
use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Column, Printer, facts_table, failed_lines, lines};

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
            text(&report, has_block)
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
            one.figure()
                .map(|figure| figure.map(|figure| (one.name.clone(), figure)))
                .transpose()
        })
        .collect();
    Ok(drawn.into_iter().collect::<Result<_, _>>()?)
}

fn text(report: &InfoReport, has_block: bool) -> String {
    let columns = if has_block {
        &COLUMNS[..]
    } else {
        &COLUMNS[..COLUMNS.len() - 3]
    };
    let text = if let [one] = report.motions.as_slice() {
        lines(&one.facts())
    } else {
        facts_table(report.motions.iter().map(Answer::facts), columns)
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
