//! `freestand motion synth` and `match`: motions that fit a code's spectrum.

use std::path::PathBuf;

use clap::Args;
use freestand::code_spectrum::CodeSpectrum;
use freestand::motion::Motion;
use freestand::synthesis::{
    GENERATOR, MatchedMotion, Misfit, Resemblance, SynthesisError, SynthesisOptions, matched_periods_s, synthesize,
    with_pga,
};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::Dimension;
use freestand_records::formats::write_csv;
use freestand_study::inspect::{Words, record_figure};
use freestand_study::matched::{MatchMethod, match_record};
use freestand_study::matched::{MatchedPicture, matched_figure};
use freestand_study::recorded::name_of;
use freestand_study::study::{DEFAULT_MOTIONS, synthetic_name};
use rayon::prelude::*;
use serde::Serialize;

use super::motions;
use super::plot::{Target, failed, place};
use crate::args::GlobalArgs;
use crate::commands::Done;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::reading::ReadArgs;
use crate::target::{TargetArgs, TargetReport};
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
    target: TargetArgs,
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

/// How the spectrum of a record is brought to the target.
const METHODS: Choices<MatchMethod> = &[
    (MatchMethod::Wavelet, "wavelet", "Scale wavelets; keeps more of the record"),
    (MatchMethod::Fft, "fft", "Scale Fourier amplitudes at the period itself"),
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
    target: TargetArgs,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Serialize)]
struct SynthReport {
    #[serde(flatten)]
    code: TargetReport,
    seed: Option<u64>,
    generator: Option<&'static str>,
    method: &'static str,
    motions: Vec<MatchedReport>,
}

#[derive(Debug, Serialize)]
struct MatchedReport {
    name: String,
    path: Option<String>,
    dt_s: f64,
    npts: usize,
    rms_misfit_ratio: f64,
    worst_misfit_ratio: f64,
    worst_misfit_period_s: f64,
    pga_g: f64,
    target_zpa_g: f64,
    pgv_m_s: f64,
    d5_95_s: f64,
    /// The rms before the peak was brought to the code's.
    rms_misfit_before_pga_ratio: Option<f64>,
    /// Of the accelerations with those of the record.
    correlation_ratio: Option<f64>,
    /// Largest difference of the Husid curves.
    husid_difference_ratio: Option<f64>,
}

/// A motion, and what is said of it beside its misfit.
struct Made {
    matched: MatchedMotion,
    before_pga: Option<Misfit>,
    resemblance: Option<Resemblance>,
}

/// A held table has its plateau at T = 0, which is no peak acceleration.
fn check_peak(args: &PeakArgs, spectrum: &CodeSpectrum) -> Result<(), Failure> {
    match spectrum {
        CodeSpectrum::Table(table) if args.match_pga && table.first_period_s() > 0.0 => Err(Problem::new(
            ProblemKind::Value,
            format!("--match-pga: the table begins at {} s and has no peak acceleration", table.first_period_s()),
        )
        .hint("add a row with a period of 0 s, the peak acceleration, or leave --match-pga out")
        .into()),
        _ => Ok(()),
    }
}

/// With its peak brought to the target's at T = 0, if so wished.
fn with_peak(matched: MatchedMotion, args: &PeakArgs, target: impl Fn(f64) -> f64) -> Result<Made, SynthesisError> {
    if !args.match_pga {
        return Ok(Made { matched, before_pga: None, resemblance: None });
    }
    let pga_g = target(0.0);
    let after = with_pga(&matched.motion, target, pga_g)?;
    Ok(Made { matched: after, before_pga: Some(matched.misfit), resemblance: None })
}

const SCHEMA: &str = "freestand.motion-synth/1";

/// A misfit above this is said: motions for the shapes of codes lie at 3 to 5 %.
const POOR_FIT_RATIO: f64 = 0.1;

pub(crate) fn run(args: &SynthArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let asked = args.target.matched_target()?;
    check_peak(&args.peak, &asked.spectrum)?;
    let inputs = args.target.inputs();
    let files = Files::begin(global, &inputs)?;
    let seed = global.seed();
    let options = options(&args.layout)?;
    let target = |period_s| asked.spectrum.sa_g(period_s);
    // Each motion has its own stream of random numbers, so the order in which they are made does
    // not matter.
    let made: Vec<Made> = (0..args.count)
        .into_par_iter()
        .map(|index| with_peak(synthesize(target, seed, index, &options)?, &args.peak, target))
        .collect::<Result<_, SynthesisError>>()
        .map_err(not_made)?;
    draw("Synthetic motions and their target", target, &made, "synthetic-01", &files)?;
    let named = made.into_iter().enumerate().map(|(i, one)| (synthetic_name(i), one));
    let motions = written(named, &files)?;
    let report = SynthReport {
        code: TargetReport::from(&asked),
        seed: Some(seed),
        generator: Some(GENERATOR),
        method: MatchMethod::Fft.name(),
        motions,
    };
    finish(report, files, asked.warnings, printer)
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

/// A flag out of its range is the user's; everything else is not.
fn not_made(error: SynthesisError) -> Failure {
    match error {
        SynthesisError::Option { .. } => Problem::new(ProblemKind::Value, error.to_string())
            .hint("--time-step is dt_s, --shaking is shaking_s, --envelope is envelope_s")
            .into(),
        error => Failure::computation(error.to_string()),
    }
}

pub(crate) fn run_match(args: &MatchArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let asked = args.target.matched_target()?;
    check_peak(&args.peak, &asked.spectrum)?;
    let mut warnings = asked.warnings.clone();
    let read = args.read.read_one(&args.file)?;
    let files = Files::begin(global, &args.read.inputs(std::iter::once(&args.file).chain(&args.target.inputs())))?;
    let (record, target) = (&read.motion.motion, |period_s| asked.spectrum.sa_g(period_s));
    let matched = match_record(record, &asked, args.method).map_err(|problem| problem.in_file(&args.file))?;
    let mut made = with_peak(matched, &args.peak, target)
        .map_err(|error| Problem::new(ProblemKind::Value, error.to_string()).in_file(&args.file))?;
    made.resemblance = Some(Resemblance::between(record, &made.matched.motion));
    warnings.extend(read.notes);
    let name = format!("{}-matched", name_of(&args.file));
    draw("A matched record and its target", target, std::slice::from_ref(&made), &name, &files)?;
    let motions = written(std::iter::once((name, made)), &files)?;
    let report = SynthReport {
        code: TargetReport::from(&asked),
        seed: None,
        generator: None,
        method: args.method.name(),
        motions,
    };
    finish(report, files, warnings, printer)
}

/// The spectra against the target, and the first motion.
fn draw(
    title: &str,
    target: impl Fn(f64) -> f64,
    made: &[Made],
    first_name: &str,
    files: &Files,
) -> Result<(), Failure> {
    if !files.wanted() {
        return Ok(());
    }
    let motions: Vec<&Motion> = made.iter().map(|one| &one.matched.motion).collect();
    let target_sa_g: Vec<f64> = matched_periods_s().into_iter().map(target).collect();
    let picture = MatchedPicture { title, target: "the target", target_sa_g: &target_sa_g, motions: &motions };
    let mut figures = vec![("target".to_owned(), matched_figure(&picture).map_err(failed)?)];
    if let Some(first) = motions.first() {
        let words = Words { name: first_name, description: "matched to a spectrum", processing: &[] };
        figures.push((first_name.to_owned(), record_figure(words, first).map_err(failed)?));
    }
    place(&Target::Folder, figures, files, &[])?;
    Ok(())
}

fn written(named: impl Iterator<Item = (String, Made)>, files: &Files) -> Result<Vec<MatchedReport>, Failure> {
    named
        .map(|(name, made)| {
            let one = made.matched;
            let path = files.write(&format!("{name}.csv"), || write_csv(&one.motion))?;
            Ok(MatchedReport {
                name,
                path,
                dt_s: one.motion.dt_s(),
                npts: one.motion.accel_m_s2().len(),
                rms_misfit_ratio: one.misfit.rms_ratio,
                worst_misfit_ratio: one.misfit.worst_ratio,
                worst_misfit_period_s: one.misfit.worst_period_s,
                pga_g: one.misfit.pga_g,
                target_zpa_g: one.misfit.target_zpa_g,
                pgv_m_s: one.misfit.pgv_m_s,
                d5_95_s: one.misfit.d5_95_s,
                rms_misfit_before_pga_ratio: made.before_pga.map(|misfit| misfit.rms_ratio),
                correlation_ratio: made.resemblance.map(|kept| kept.correlation_ratio),
                husid_difference_ratio: made.resemblance.map(|kept| kept.husid_difference_ratio),
            })
        })
        .collect()
}

fn finish(report: SynthReport, files: Files, mut warnings: Vec<String>, printer: &Printer) -> Result<Done, Failure> {
    for one in report.motions.iter().filter(|one| one.rms_misfit_ratio > POOR_FIT_RATIO) {
        warnings.push(format!(
            "{} does not fit its target: rms misfit {} %, worst {} % at {} s",
            one.name,
            significant(100.0 * one.rms_misfit_ratio, 3),
            significant(100.0 * one.worst_misfit_ratio, 3),
            significant(one.worst_misfit_period_s, 3)
        ));
    }
    if let Some(worst) = report.motions.iter().max_by(|a, b| a.pga_g.total_cmp(&b.pga_g))
        && worst.pga_g > 1.05 * worst.target_zpa_g
    {
        warnings.push(format!(
            "the PGA of the motions reaches {} g, the spectrum at T = 0 is {} g: a record that fits the plateau cannot have so low a PGA",
            significant(worst.pga_g, 3),
            significant(worst.target_zpa_g, 3)
        ));
    }
    if let Some(before) = report.motions.first().and_then(|one| one.rms_misfit_before_pga_ratio) {
        warnings.push(format!(
            "the PGA was brought to the spectrum's by scaling half-cycles; the rms misfit of the first motion went from {} % to {} %",
            significant(100.0 * before, 2),
            significant(100.0 * report.motions[0].rms_misfit_ratio, 2)
        ));
    }
    files.finish(SCHEMA, &report, &warnings)?;
    printer.result(SCHEMA, &report, &warnings, || text(&report))?;
    Ok(Done::OK)
}

fn text(report: &SynthReport) -> String {
    let rows: Vec<Vec<String>> = report
        .motions
        .iter()
        .map(|one| {
            vec![
                one.path.clone().unwrap_or_else(|| one.name.clone()),
                significant(100.0 * one.rms_misfit_ratio, 3),
                significant(100.0 * one.worst_misfit_ratio, 3),
                significant(one.worst_misfit_period_s, 3),
                significant(one.pga_g, 3),
                significant(one.target_zpa_g, 3),
                significant(one.pgv_m_s, 3),
                significant(one.d5_95_s, 3),
            ]
        })
        .collect();
    let headings = ["motion", "rms [%]", "worst [%]", "at T [s]", "PGA [g]", "Sa(0) [g]", "PGV [m/s]", "D5-95 [s]"];
    table(&headings, &rows)
}
