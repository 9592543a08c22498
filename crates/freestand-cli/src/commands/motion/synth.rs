//! `freestand motion synth` and `match`: motions that fit a target.

use std::path::PathBuf;

use clap::Args;
use freestand::synthesis::SynthesisOptions;
use freestand_app::TargetKeys;
use freestand_app::files::Files as Sources;
use freestand_input::quantity::Dimension;
use freestand_output::answer::Answer;
use freestand_records::formats::write_csv;
use freestand_study::inspect::{Words, record_figure};
use freestand_study::matched::{
    FitReport, FittedMotion, MatchMethod, MatchRequest, SynthRequest, match_one, synth,
};
use freestand_study::recorded::name_of;
use freestand_study::study::DEFAULT_MOTIONS;
use freestand_study::target::Target;

use super::motions;
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Column, Printer, cells, headings, table};
use crate::reading::ReadArgs;
use crate::values::{Choices, Given, Reads, Values, choice};

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
    target: TargetKeys,
    /// Number of motions
    #[arg(long, value_name = "N", default_value_t = DEFAULT_MOTIONS, value_parser = motions())]
    count: u64,
    #[command(flatten)]
    layout: LayoutArgs,
    #[command(flatten)]
    peak: PeakArgs,
}

/// The motion in time.
#[derive(Debug, Args)]
#[command(next_help_heading = "The motion")]
struct LayoutArgs {
    /// Time step, at most 0.01 s [default: 0.005 s]
    #[arg(long, positive = Dimension::Time)]
    time_step: Option<Given>,
    /// Length of the shaking including its tapers, at least 10 s [default: 40 s]
    #[arg(long, positive = Dimension::Time)]
    shaking: Option<Given>,
    /// Duration of the window that shapes the noise, about equal to D5-95 [default: 10 s]
    #[arg(long, positive = Dimension::Time)]
    envelope: Option<Given>,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "The motion")]
struct PeakArgs {
    /// Scale half-cycles so that the peak acceleration is that of the target at T = 0; the fit at
    /// short periods gets worse
    #[arg(long)]
    match_pga: bool,
}

/// How the spectrum of a record is matched to the target.
const METHODS: Choices<MatchMethod> = &[
    (
        MatchMethod::Wavelet,
        "wavelet",
        "Scale wavelets; keeps more of the record",
    ),
    (
        MatchMethod::Fft,
        "fft",
        "Scale the Fourier amplitudes at each period by the misfit at that period",
    ),
];

/// Match a record to a target: the elastic spectrum of a design code, or a table
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  freestand motion match record.AT2 --code as1170.4 --site De --city Melbourne --out matched
  freestand motion match record.AT2 --site De --method fft --match-pga --json")]
pub(crate) struct MatchArgs {
    /// Record
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Method
    #[arg(long, value_parser = choice(METHODS), default_value = MatchMethod::default().name())]
    method: MatchMethod,
    #[command(flatten)]
    peak: PeakArgs,
    #[command(flatten)]
    target: TargetKeys,
    #[command(flatten)]
    read: ReadArgs,
}

impl PeakArgs {
    /// The peak acceleration of the target, if `--match-pga` is given.
    fn pga_g(&self, target: &Target) -> Result<Option<f64>, Failure> {
        Ok(self.match_pga.then(|| target.peak_g()).transpose()?)
    }
}

pub(crate) fn run(
    args: &SynthArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let target = args.target.matched(&Sources::Disk)?;
    let pga_g = args.peak.pga_g(&target)?;
    let files = Files::begin(global, &args.target.inputs(&Sources::Disk))?;
    let options = options(&args.layout)?;
    let report = synth(&SynthRequest {
        target,
        count: args.count,
        seed: global.seed(),
        options,
        pga_g,
    })?;
    finish(report, files, &[], printer)
}

fn options(args: &LayoutArgs) -> Result<SynthesisOptions, Failure> {
    let mut values = Values::default();
    let fine = SynthesisOptions::default();
    let dt_s = values.read(&args.time_step);
    let shaking_s = values.read(&args.shaking);
    let envelope_s = values.read(&args.envelope);
    values.finish()?;
    Ok(SynthesisOptions {
        dt_s: dt_s.unwrap_or(fine.dt_s),
        shaking_s: shaking_s.unwrap_or(fine.shaking_s),
        envelope_s: envelope_s.unwrap_or(fine.envelope_s),
        ..fine
    })
}

pub(crate) fn run_match(
    args: &MatchArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let target = args.target.matched(&Sources::Disk)?;
    let pga_g = args.peak.pga_g(&target)?;
    let read = args.read.read_one(&args.file, ReadArgs::read_any)?;
    let files = Files::begin(
        global,
        &args
            .read
            .inputs(std::iter::once(&args.file).chain(&args.target.inputs(&Sources::Disk))),
    )?;
    let name = format!("{}-matched", name_of(&args.file));
    let request = MatchRequest {
        target,
        record: &read.motion.motion,
        name,
        method: args.method,
        pga_g,
    };
    let report = match_one(request).map_err(|problem| problem.in_file(&args.file))?;
    let notes: Vec<String> = read.notes.iter().map(ToString::to_string).collect();
    finish(report, files, &notes, printer)
}

/// Writes the motions, draws them with their target, and the first one by itself.
fn finish(
    mut report: FitReport,
    files: Files,
    notes: &[String],
    printer: &Printer,
) -> Result<Done, Failure> {
    const SCHEMA: &str = "freestand.motion-synth/1";
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
