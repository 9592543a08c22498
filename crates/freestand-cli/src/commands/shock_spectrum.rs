//! `freestand shock-spectrum`: shock response spectra of records and of classical pulses.

use std::path::PathBuf;

use clap::Args;
use freestand::shock_response::{
    Peak, Pulse, PulseError, PulseShape, ResponseKind, ShockSpectrumOptions,
};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse, parse_grid};
use freestand_study::shock_spectrum::{
    DEFAULT_FREQUENCIES, KINDS, PEAKS, SHAPES, ShockSpectrumReport, ShockSpectrumRequest,
    acceleration_unit, pulse_shock_spectrum, recorded_shock_spectra,
};

use super::Done;
use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::files::{Files, TableArgs};
use crate::printer::{Printer, significant, table};
use crate::reading::ReadArgs;
use crate::values::{Given, Reads, Values, choice, name_of};

/// Calculate the shock response spectrum of records or of a classical pulse (ISO 18431-4)
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  A drop test with the columns time [ms] and acceleration [g]:
    freestand shock-spectrum drop.csv --out spectrum
  Pseudo-velocity after the shock, at Q = 25:
    freestand shock-spectrum drop.csv --kind pseudo-velocity --peak residual --q 25 \\
      --frequencies \"10 Hz:2 kHz:24/oct\"
  The pulse of a data sheet:
    freestand shock-spectrum --pulse half-sine --peak-acceleration \"30 g\" --duration \"11 ms\" \\
      --frequencies \"20 Hz, 45 Hz\"

Values are magnitudes: a negative peak is given without its sign. Accelerations are in the unit of
the input, displacements in m, velocities in m/s. --out writes shock_spectrum.csv and a figure.")]
// A laboratory file has columns, not components.
#[command(mut_arg("component", |arg| arg.visible_alias("column")))]
pub(crate) struct ShockSpectrumArgs {
    /// Record files
    #[arg(
        value_name = "FILE",
        required_unless_present = "pulse",
        conflicts_with = "pulse"
    )]
    files: Vec<PathBuf>,
    /// A classical pulse instead of files
    #[arg(
        long,
        value_parser = choice(SHAPES),
        requires = "peak_acceleration",
        requires = "duration",
        help_heading = "A pulse"
    )]
    pulse: Option<PulseShape>,
    /// Peak of the pulse; the spectrum has the same unit
    #[arg(long, value_name = "ACCELERATION", read = peak, requires = "pulse", help_heading = "A pulse")]
    peak_acceleration: Option<Given<(f64, &'static str)>>,
    /// Duration of the pulse
    #[arg(long, positive = Dimension::Time, requires = "pulse", help_heading = "A pulse")]
    duration: Option<Given>,
    /// Damping ratio of the oscillators [default: 5 %]
    #[arg(long, non_negative = Dimension::Ratio, conflicts_with = "q")]
    damping: Option<Given>,
    /// Quality factor Q = 1/(2 damping), instead of the damping ratio [default: 10]
    #[arg(long, positive = Dimension::Ratio)]
    q: Option<Given>,
    /// Frequencies of the oscillators: from:to:N/oct, from:to:count or a list
    #[arg(long, value_name = "GRID", read = frequencies, default_value = DEFAULT_FREQUENCIES)]
    frequencies: Given<Vec<f64>>,
    /// Response of the oscillators
    #[arg(long, value_parser = choice(KINDS), default_value = name_of(KINDS, ResponseKind::default()))]
    kind: ResponseKind,
    /// Peak of that response
    #[arg(long, value_parser = choice(PEAKS), default_value = name_of(PEAKS, Peak::default()))]
    peak: Peak,
    /// Find peaks at the samples only, not on the band-limited curve through them
    #[arg(long, conflicts_with = "pulse")]
    no_upsample: bool,
    #[command(flatten)]
    tables: TableArgs,
    #[command(flatten)]
    read: ReadArgs,
}

const SCHEMA: &str = "freestand.shock-spectrum/1";

/// What a pulse counts as in a live request: it is sampled as its stiffest oscillator needs it, which
/// is seldom more.
const PULSE_SAMPLES: usize = 1_000_000;

/// What a record counts as at least: many samples are added to a short one.
const LEAST_SAMPLES: usize = 20_000;

pub(crate) fn run(
    args: &ShockSpectrumArgs,
    global: &GlobalArgs,
    printer: &Printer,
) -> Result<Done, Failure> {
    let mut values = Values::default();
    let request = request(args, &mut values);
    let pulse = pulse(args, &mut values);
    values.finish()?;
    let stop = printer.stop();
    let go_on = || {
        if stop.wanted() {
            Err(Problem::stopped())
        } else {
            Ok(())
        }
    };
    let check = |samples: usize| match printer.session() {
        Some(session) => session.check_oscillators(request.frequencies_hz.len(), samples),
        None => Ok(()),
    };
    let inputs = args.read.inputs(&args.files);
    let (report, files) = match pulse {
        Some((pulse, unit)) => {
            args.read
                .refuse_without_record(|_| "leave it out: --pulse reads no file".to_owned())?;
            check(PULSE_SAMPLES)?;
            (
                pulse_shock_spectrum(&pulse, unit, &request, go_on)?,
                Files::with_tables(global, &[], &args.tables, SCHEMA, None)?,
            )
        }
        None => {
            let motions = args.read.read_shocks(&args.files)?;
            check(
                motions
                    .iter()
                    .map(|read| read.motion.motion.accel_m_s2().len().max(LEAST_SAMPLES))
                    .sum(),
            )?;
            (
                recorded_shock_spectra(&motions, &request, go_on)?,
                Files::with_tables(global, &inputs, &args.tables, SCHEMA, None)?,
            )
        }
    };
    files.table("shock_spectrum", || report.table())?;
    files.figure("shock_spectrum", || report.figure())?;
    files.print(printer, SCHEMA, &report, &report.warnings, || text(&report))?;
    Ok(Done::OK)
}

fn request(args: &ShockSpectrumArgs, values: &mut Values) -> ShockSpectrumRequest {
    let damping = values.read(&args.damping);
    let q = values.read(&args.q);
    let damping_ratio = damping
        .or(q.map(|q| 0.5 / q))
        .unwrap_or(ShockSpectrumOptions::default().damping_ratio);
    if damping_ratio >= 1.0 {
        let flag = if q.is_some() { "--q" } else { "--damping" };
        let message = format!("{flag}: a damping ratio of {damping_ratio} is not below 1");
        values.push(Problem::value(
            message,
            "give a damping below 100 %, or a Q above 0.5; 5 %, which is Q = 10, is usual",
        ));
    }
    let frequencies_hz = values.read(&args.frequencies).unwrap_or_default();
    ShockSpectrumRequest {
        kind: args.kind,
        peak: args.peak,
        damping_ratio,
        frequencies_hz,
        upsample: !args.no_upsample,
    }
}

fn frequencies(text: &str) -> Result<Vec<f64>, Problem> {
    let frequencies_hz = parse_grid(text, Dimension::Frequency)?;
    let hint = "give frequencies such as \"1 Hz:10 kHz:12/oct\" or \"20 Hz, 45 Hz\"";
    match frequencies_hz.iter().find(|f| **f <= 0.0) {
        Some(wrong) => Err(Problem::value(
            format!("{wrong} Hz is not above zero"),
            hint,
        )),
        None => Ok(frequencies_hz),
    }
}

/// The peak \[m/s²\] and the unit that it is given in.
fn peak(text: &str) -> Result<(f64, &'static str), Problem> {
    Ok((
        parse(text, Dimension::Acceleration)?,
        acceleration_unit(text),
    ))
}

/// The pulse and the unit that its peak is given in.
fn pulse(args: &ShockSpectrumArgs, values: &mut Values) -> Option<(Pulse, &'static str)> {
    let peak = values.read(&args.peak_acceleration);
    let duration_s = values.read(&args.duration);
    let (shape, (peak_m_s2, unit)) = (args.pulse?, peak?);
    let hint = "give a peak and a duration, such as \"30 g\" and \"11 ms\"";
    let wrong = |error: PulseError| Problem::value(error.to_string(), hint);
    let pulse = values.keep(
        "pulse",
        Pulse::new(shape, peak_m_s2, duration_s?).map_err(wrong),
    )?;
    Some((pulse, unit))
}

fn text(report: &ShockSpectrumReport) -> String {
    let mut headings = vec!["f [Hz]".to_owned()];
    headings.extend(
        report
            .spectra
            .iter()
            .map(|one| format!("{} [{}]", one.name, one.unit)),
    );
    let frequencies = report
        .spectra
        .first()
        .map_or(&[][..], |one| &one.frequencies_hz);
    let rows: Vec<Vec<String>> = frequencies
        .iter()
        .enumerate()
        .map(|(i, &f)| {
            let values = report.spectra.iter().filter_map(|one| one.values.get(i));
            std::iter::once(significant(f, 5))
                .chain(values.map(|&value| significant(value, 5)))
                .collect()
        })
        .collect();
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let mut text = table(&headings, &rows);
    for one in &report.spectra {
        if let Some(pulse) = &one.enveloping_half_sine {
            let words = |name, unit| format!("{} {unit}", pulse.cell(name, unit, 4));
            text += &format!(
                "{}: enveloped by a half-sine of {} and {}, with a velocity change of {}\n",
                one.name,
                words("peak_acceleration_g", "g"),
                words("duration_s", "ms"),
                words("velocity_change_m_s", "m/s"),
            );
        }
    }
    text
}
