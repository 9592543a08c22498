//! `freestand motion synth` and `match`: motions that fit a target.

use clap::Args;
use freestand_app::motion::Meant;
use freestand_app::synth::{Match, SCHEMA, Synth};
use freestand_records::formats::write_csv;
use freestand_report::doubts::fit_doubt;
use freestand_report::figures::{Words, fit_figure, record_figure};
use freestand_report::motion::fits_text;
use freestand_report::target::FitAnswer;
use freestand_study::matched::{FitReport, FittedMotion, match_one, synth};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::Printer;

/// Make synthetic motions that fit a target: the elastic spectrum of a design code, or a table
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_synth.txt").trim_end())]
pub(crate) struct SynthArgs {
    #[command(flatten)]
    pub(super) request: Synth,
}

/// Match a record to a target: the elastic spectrum of a design code, or a table
#[derive(Debug, Args)]
#[command(after_help = include_str!("../../help/motion_match.txt").trim_end())]
pub(crate) struct MatchArgs {
    #[command(flatten)]
    pub(super) request: Match,
}

impl Tell for Synth {
    type Output = ();

    fn tell(
        Meant { asked, inputs }: Self::Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, &inputs)?;
        finish(synth(&asked)?, files, &[], printer)
    }
}

impl Tell for Match {
    type Output = ();

    fn tell(
        Meant {
            asked: (read, request),
            inputs,
        }: Self::Meant,
        (): &(),
        global: &GlobalArgs,
        printer: &Printer,
    ) -> Result<Done, Failure> {
        let files = Files::begin(global, &inputs)?;
        let one = &read.motion;
        let report = match_one(&one.motion, format!("{}-matched", one.name), &request)
            .map_err(|problem| problem.in_file(&one.path))?;
        let notes: Vec<String> = read.notes.iter().map(ToString::to_string).collect();
        finish(report, files, &notes, printer)
    }
}

/// Writes the motions, draws them with their target, and the first one by itself.
fn finish(
    mut report: FitReport,
    files: Files,
    notes: &[String],
    printer: &Printer,
) -> Result<Done, Failure> {
    for one in &mut report.motions {
        one.path = files.write(&format!("{}.csv", one.name), || write_csv(&one.motion))?;
    }
    files.figure("target", || fit_figure(&report))?;
    if let Some(FittedMotion { name, motion, .. }) = report.motions.first() {
        let words = Words {
            name,
            description: "matched to a spectrum",
            processing: &[],
        };
        files.figure(name, || record_figure(words, motion))?;
    }
    let doubts: Vec<String> = report.doubts().iter().map(fit_doubt).collect();
    let warnings = [&doubts, notes].concat();
    files.finish(SCHEMA, &FitAnswer(&report), &warnings)?;
    printer.result(SCHEMA, &FitAnswer(&report), &warnings, || {
        fits_text(&report)
    })?;
    Ok(Done::OK)
}
