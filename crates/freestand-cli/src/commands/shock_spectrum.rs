//! `freestand shock-spectrum`: shock response spectra of records and of classical pulses.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use freestand::shock_response::{Peak, Pulse, PulseShape, ResponseKind};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::Dimension;
use freestand_study::shock_spectrum::{
    ShockSpectrumReport, ShockSpectrumRequest, acceleration_unit, pulse_shock_spectrum, recorded_shock_spectra,
};

use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::Files;
use crate::printer::{Printer, significant, table};
use crate::reading::ReadArgs;
use crate::values::Values;

/// Shock response spectrum of records or of a classical pulse (ISO 18431-4): what a component feels
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A drop test with the columns time [ms] and acceleration [g]:
    freestand shock-spectrum drop.csv --out spectrum
  Pseudo-velocity after the shock, at Q = 25:
    freestand shock-spectrum drop.csv --kind pseudo-velocity --peak residual --q 25 --frequencies \"10 Hz:2 kHz:24/oct\"
  The pulse of a data sheet:
    freestand shock-spectrum --pulse half-sine --peak-acceleration \"30 g\" --duration \"11 ms\" --frequencies \"20 Hz, 45 Hz\"

Values are sizes: negative is the size of the largest negative response. Maximax is during the record or after it.
Accelerations are in the unit of the input, displacements in m, velocities in m/s. With --out: the spectra as
shock_spectrum.csv and as a figure.")]
// The columns of a laboratory's file are columns before they are components.
#[command(mut_arg("component", |arg| arg.visible_alias("column")))]
pub(crate) struct ShockSpectrumArgs {
    /// Record files
    #[arg(value_name = "FILE", required_unless_present = "pulse", conflicts_with = "pulse")]
    files: Vec<PathBuf>,
    /// A classical pulse in place of files
    #[arg(long, value_enum, requires = "peak_acceleration", requires = "duration", help_heading = "A pulse")]
    pulse: Option<PulseShapeName>,
    /// Its peak; the spectrum is in the same unit
    #[arg(long, value_name = "ACCELERATION", allow_hyphen_values = true, requires = "pulse", help_heading = "A pulse")]
    peak_acceleration: Option<String>,
    /// Its duration
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, requires = "pulse", help_heading = "A pulse")]
    duration: Option<String>,
    /// Damping ratio of the oscillators [default: 5 %]
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, conflicts_with = "q")]
    damping: Option<String>,
    /// Quality factor Q = 1/(2 damping), in place of it [default: 10]
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true)]
    q: Option<String>,
    /// Their frequencies: from:to:N/oct, from:to:count or a list
    #[arg(long, value_name = "GRID", default_value = "1 Hz:10 kHz:12/oct", allow_hyphen_values = true)]
    frequencies: String,
    /// What is looked at in them
    #[arg(long, value_enum, default_value_t)]
    kind: KindName,
    /// Which peak of it
    #[arg(long, value_enum, default_value_t)]
    peak: PeakName,
    /// Peaks at the samples as they are, without the band-limited curve between them
    #[arg(long, conflicts_with = "pulse")]
    no_upsample: bool,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum PulseShapeName {
    /// A sin(πt/T)
    HalfSine,
    /// A sin²(πt/T)
    Haversine,
    /// From A down to 0
    InitialPeakSawtooth,
    /// From 0 up to A
    TerminalPeakSawtooth,
    /// A
    Rectangle,
    /// A, with a tenth of the duration to rise and to fall
    Trapezoid,
}

impl From<PulseShapeName> for PulseShape {
    fn from(name: PulseShapeName) -> Self {
        match name {
            PulseShapeName::HalfSine => Self::HalfSine,
            PulseShapeName::Haversine => Self::Haversine,
            PulseShapeName::InitialPeakSawtooth => Self::InitialPeakSawtooth,
            PulseShapeName::TerminalPeakSawtooth => Self::TerminalPeakSawtooth,
            PulseShapeName::Rectangle => Self::Rectangle,
            PulseShapeName::Trapezoid => Self::Trapezoid,
        }
    }
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum KindName {
    /// Acceleration of the component
    #[default]
    AbsoluteAcceleration,
    /// Its displacement against its base
    RelativeDisplacement,
    /// That displacement times ω
    PseudoVelocity,
}

impl From<KindName> for ResponseKind {
    fn from(name: KindName) -> Self {
        match name {
            KindName::AbsoluteAcceleration => Self::AbsoluteAcceleration,
            KindName::RelativeDisplacement => Self::RelativeDisplacement,
            KindName::PseudoVelocity => Self::PseudoVelocity,
        }
    }
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum PeakName {
    /// The largest of either sign, during the record or after it
    #[default]
    Maximax,
    /// The largest positive one
    Positive,
    /// The largest negative one, as its size
    Negative,
    /// The largest of either sign while the record lasts
    Primary,
    /// The largest of either sign after it
    Residual,
}

impl From<PeakName> for Peak {
    fn from(name: PeakName) -> Self {
        match name {
            PeakName::Maximax => Self::Maximax,
            PeakName::Positive => Self::Positive,
            PeakName::Negative => Self::Negative,
            PeakName::Primary => Self::Primary,
            PeakName::Residual => Self::Residual,
        }
    }
}

pub(crate) fn run(args: &ShockSpectrumArgs, global: &GlobalArgs, printer: &Printer) -> Result<Done, Failure> {
    let mut values = Values::default();
    let request = request(args, &mut values);
    let pulse = pulse(args, &mut values);
    values.finish()?;
    let inputs = args.read.inputs(&args.files);
    let (report, files) = match pulse {
        Some((pulse, unit)) => {
            args.read.refuse_without_record(|_| "a pulse is not read from a file: leave it out".to_owned())?;
            (pulse_shock_spectrum(&pulse, unit, &request)?, Files::begin(global, &[])?)
        }
        None => {
            let motions = args.read.read_shocks(&args.files)?;
            (recorded_shock_spectra(&motions, &request)?, Files::begin(global, &inputs)?)
        }
    };
    if files.wanted() {
        let (columns, figure) = (report.csv()?, report.figure());
        let figure = figure.map_err(|error| Failure::computation(error.to_string()))?;
        files.write("shock_spectrum.csv", || columns)?;
        files.write("shock_spectrum.svg", || figure.svg)?;
        files.write("shock_spectrum.png", || figure.png)?;
    }
    files.print(printer, "freestand.shock-spectrum/1", &report, &report.warnings, || text(&report))?;
    Ok(Done::OK)
}

fn request(args: &ShockSpectrumArgs, values: &mut Values) -> ShockSpectrumRequest {
    let damping = values.non_negative("--damping", args.damping.as_deref(), Dimension::Ratio);
    let q = values.positive("--q", args.q.as_deref(), Dimension::Ratio);
    let damping_ratio = damping.or(q.map(|q| 0.5 / q)).unwrap_or(0.05);
    if damping_ratio >= 1.0 {
        let flag = if q.is_some() { "--q" } else { "--damping" };
        let problem =
            Problem::new(ProblemKind::Value, format!("{flag}: a damping ratio of {damping_ratio} is not below 1"));
        values.push(problem.hint("5 % of critical is usual, Q = 10; Q must be above 0.5"));
    }
    let frequencies_hz = values.grid("--frequencies", &args.frequencies, Dimension::Frequency).unwrap_or_default();
    if let Some(wrong) = frequencies_hz.iter().find(|f| **f <= 0.0) {
        let problem = Problem::new(ProblemKind::Value, format!("--frequencies: {wrong} Hz is not above zero"));
        values.push(problem.hint("such as \"1 Hz:10 kHz:12/oct\" or \"20 Hz, 45 Hz\""));
    }
    ShockSpectrumRequest {
        kind: args.kind.into(),
        peak: args.peak.into(),
        damping_ratio,
        frequencies_hz,
        upsample: !args.no_upsample,
    }
}

/// The pulse and the unit that its peak is given in.
fn pulse(args: &ShockSpectrumArgs, values: &mut Values) -> Option<(Pulse, &'static str)> {
    let peak = values.any("--peak-acceleration", args.peak_acceleration.as_deref(), Dimension::Acceleration);
    let duration_s = values.positive("--duration", args.duration.as_deref(), Dimension::Time);
    let pulse = Pulse::new(args.pulse?.into(), peak?, duration_s?);
    let wrong = |error: freestand::shock_response::PulseError| {
        Problem::new(ProblemKind::Value, error.to_string()).hint("such as --peak-acceleration \"30 g\"")
    };
    let pulse = values.keep("--pulse", pulse.map_err(wrong))?;
    Some((pulse, acceleration_unit(args.peak_acceleration.as_deref()?)))
}

fn text(report: &ShockSpectrumReport) -> String {
    let mut headings = vec!["f [Hz]".to_owned()];
    headings.extend(report.spectra.iter().map(|one| format!("{} [{}]", one.name, one.unit)));
    let frequencies = report.spectra.first().map_or(&[][..], |one| &one.frequencies_hz);
    let rows: Vec<Vec<String>> = frequencies
        .iter()
        .enumerate()
        .map(|(i, &f)| {
            let values = report.spectra.iter().filter_map(|one| one.values.get(i));
            std::iter::once(significant(f, 5)).chain(values.map(|&value| significant(value, 5))).collect()
        })
        .collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let mut text = table(&headings, &rows);
    for one in &report.spectra {
        if let Some(pulse) = one.enveloping_half_sine {
            text += &format!(
                "{}: enveloped by a half-sine of {} g and {} ms, {} m/s\n",
                one.name,
                significant(pulse.peak_acceleration_g, 4),
                significant(1e3 * pulse.duration_s, 4),
                significant(pulse.velocity_change_m_s, 4),
            );
        }
    }
    text
}
