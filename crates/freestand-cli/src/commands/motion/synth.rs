//! `freestand motion synth` and `match`: motions that fit a target.

use clap::Args;
use freestand_app::motion::Meant;
use freestand_app::synth::{Match, SCHEMA, Synth};
use freestand_output::answer::Answer as _;
use freestand_records::formats::write_csv;
use freestand_study::inspect::{Words, record_figure};
use freestand_study::matched::{FitReport, FittedMotion, match_one, synth};

use crate::args::GlobalArgs;
use crate::commands::{Done, Tell};
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Column, Printer, cells, headings, table};

/// Make synthetic motions that fit a target: the elastic spectrum of a design code, or a table
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion synth --site De --city Melbourne --count 10 --seed 1 --out motions
  freestand motion synth --hazard-factor 0.11 --return-period 2500 --count 3 --json
  freestand motion synth --code asce7 --sds 1g --sd1 0.6g --long-period 8s --out motions
  freestand motion synth --spectrum uhs.csv --beyond hold --out motions")]
pub(crate) struct SynthArgs {
    #[command(flatten)]
    pub(super) request: Synth,
}

/// Match a record to a target: the elastic spectrum of a design code, or a table
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion match record.AT2 --code as1170.4 --site De --city Melbourne --out matched
  freestand motion match record.AT2 --site De --method fft --match-pga --json")]
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
    files.figure("target", || report.figure())?;
    if let Some(FittedMotion { name, motion, .. }) = report.motions.first() {
        let words = Words {
            name,
            description: "matched to a spectrum",
            processing: &[],
        };
        files.figure(name, || record_figure(words, motion))?;
    }
    let warnings = [&report.warnings(), notes].concat();
    files.finish(SCHEMA, &report, &warnings)?;
    printer.result(SCHEMA, &report, &warnings, || text(&report))?;
    Ok(Done::OK)
}

const COLUMNS: [Column; 7] = [
    ("rms_misfit_ratio", "rms [%]", 3),
    ("worst_misfit_ratio", "worst [%]", 3),
    ("worst_misfit_period_s", "at T [s]", 3),
    ("pga_g", "PGA [g]", 3),
    ("target_zpa_g", "Sa(0) [g]", 3),
    ("pgv_m_s", "PGV [m/s]", 3),
    ("d5_95_s", "D5-95 [s]", 3),
];

fn text(report: &FitReport) -> String {
    let row = |one: &FittedMotion| {
        let name = one.path.clone().unwrap_or_else(|| one.name.clone());
        [vec![name], cells(&one.facts(), &COLUMNS)].concat()
    };
    table(
        &[&["motion"], &headings(&COLUMNS)[..]].concat(),
        &report.motions.iter().map(row).collect::<Vec<_>>(),
    )
}
