//! Shock response spectra of records and of classical pulses: request → report.
//!
//! These are not the paper's "SRS", the shock against the size of the object ([`crate::spectrum`]).

use freestand::G0_M_S2;
use freestand::shock_response::{
    HalfSine, Peak, Pulse, PulseShape, ResponseKind, SAMPLES_PER_PERIOD, ShockResponseError,
    ShockSpectrum, ShockSpectrumOptions, enveloping_half_sine, pulse_spectrum, shock_spectrum,
};
use std::f64::consts::PI;
use std::time::Instant;

use crate::doubt::MotionDoubt;
use crate::recorded::ReadMotion;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, find_unit};
use freestand_input::words::{Choices, name_of, number};
use freestand_output::facts::{Facts, table};
use freestand_output::table::Table;
use freestand_output::{answer, answer_of};
use freestand_records::notes::{Note, NoteKind, grouped};

/// A shock response spectrum to compute.
#[derive(Debug, Clone, PartialEq)]
pub struct ShockSpectrumRequest {
    /// The response quantity.
    pub kind: ResponseKind,
    /// Which peak of it.
    pub peak: Peak,
    /// ζ.
    pub damping_ratio: f64,
    /// Frequencies of the oscillators \[Hz\].
    pub frequencies_hz: Vec<f64>,
    /// Whether to add samples for oscillators with few in a period.
    pub upsample: bool,
}

/// Frequencies of the oscillators where none are given: twelve in an octave.
pub const DEFAULT_FREQUENCIES: &str = "1 Hz:10 kHz:12/oct";

/// Shapes of pulses by name.
pub const SHAPES: Choices<PulseShape> = &[
    (PulseShape::HalfSine, "half-sine", "A sin(πt/T)"),
    (PulseShape::Haversine, "haversine", "A sin²(πt/T)"),
    (
        PulseShape::InitialPeakSawtooth,
        "initial-peak-sawtooth",
        "From A down to 0",
    ),
    (
        PulseShape::TerminalPeakSawtooth,
        "terminal-peak-sawtooth",
        "From 0 up to A",
    ),
    (PulseShape::Rectangle, "rectangle", "A"),
    (
        PulseShape::Trapezoid,
        "trapezoid",
        "A, with a tenth of the duration each to rise and to fall",
    ),
];

/// Response quantities by name.
pub const KINDS: Choices<ResponseKind> = &[
    (
        ResponseKind::AbsoluteAcceleration,
        "absolute-acceleration",
        "Acceleration of the component",
    ),
    (
        ResponseKind::RelativeDisplacement,
        "relative-displacement",
        "Displacement of the component relative to its base",
    ),
    (
        ResponseKind::PseudoVelocity,
        "pseudo-velocity",
        "Relative displacement times ω",
    ),
];

/// Peaks by name.
pub const PEAKS: Choices<Peak> = &[
    (
        Peak::Maximax,
        "maximax",
        "The largest of either sign, during the record or after it",
    ),
    (Peak::Positive, "positive", "The largest positive value"),
    (
        Peak::Negative,
        "negative",
        "The magnitude of the largest negative value",
    ),
    (
        Peak::Primary,
        "primary",
        "The largest of either sign during the record",
    ),
    (
        Peak::Residual,
        "residual",
        "The largest of either sign after the record",
    ),
];

/// One spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct OneShockSpectrum {
    /// The file; `None` for a pulse.
    pub path: Option<String>,
    /// Its name, or the shape of the pulse.
    pub name: String,
    /// Frequencies of the oscillators \[Hz\].
    pub frequencies_hz: Vec<f64>,
    /// The peaks, never negative, in [`OneShockSpectrum::unit`].
    pub values: Vec<f64>,
    /// The unit of the input for accelerations, `m` or `m/s`.
    pub unit: &'static str,
    /// Samples in a period of each oscillator, among which its peak was found.
    pub samples_per_period: Vec<f64>,
    /// Time between the samples of the input \[s\]; `None` for a pulse.
    pub dt_s: Option<f64>,
    /// Samples of the input; `None` for a pulse.
    pub samples: Option<usize>,
    /// What was done to the samples.
    pub processing: Vec<String>,
    /// The pulse, where it is one.
    pub pulse: Option<GivenPulse>,
    /// The half-sine of the smallest peak whose spectrum envelopes this one: for the maximax of the
    /// absolute acceleration.
    pub enveloping_half_sine: Option<EnvelopingPulse>,
    /// The values in SI.
    pub values_si: Vec<f64>,
}

answer_of!(OneShockSpectrum as one {
    /// The file; `null` for a pulse.
    path: Option<String>;
    /// Its name, or the shape of the pulse.
    name: String;
    frequencies_hz: Vec<f64>;
    /// The peaks, never negative, in `unit`.
    values: Vec<f64>;
    unit: &'static str;
    /// Of each oscillator.
    samples_per_period: Vec<f64>;
    /// Between the samples of the input; `null` for a pulse.
    dt_s: Option<f64>;
    /// Of the input; `null` for a pulse.
    samples: Option<usize>;
    /// What was done to the samples.
    processing: Vec<String>;
    pulse: Option<GivenPulse>;
    enveloping_half_sine: Option<EnvelopingPulse>;
});

answer! {
    /// The pulse that was given.
    pub struct GivenPulse {
        /// Its name.
        shape: &'static str,
        size: PulseSize = flat,
    }
}

answer! {
    /// A half-sine whose spectrum envelopes another.
    pub struct EnvelopingPulse {
        /// How it was chosen of all that envelope it.
        rule: &'static str,
        size: PulseSize = flat,
    }

    /// The size of a pulse.
    pub struct PulseSize of (peak_m_s2: f64, duration_s: f64, velocity_change_m_s: f64) {
        /// Its peak.
        peak_acceleration_g: f64 = peak_m_s2 / G0_M_S2;
        /// The same.
        peak_acceleration_m_s2: f64 = peak_m_s2;
        /// How long it is.
        duration_s: f64 = duration_s;
        /// Its area.
        velocity_change_m_s: f64 = velocity_change_m_s;
    }

    /// Time taken.
    pub struct Timing {
        /// By the spectra alone, without reading and writing.
        solve_s: f64,
    }
}

/// The spectra.
#[derive(Debug, Clone, PartialEq)]
pub struct ShockSpectrumReport {
    /// The response quantity.
    pub kind: &'static str,
    /// Which peak.
    pub peak: &'static str,
    /// ζ.
    pub damping_ratio: f64,
    /// Whether samples were added for oscillators with few in a period.
    pub upsample: bool,
    /// One for each file, in their order, or that of the pulse.
    pub spectra: Vec<OneShockSpectrum>,
    /// Time taken.
    pub timing: Timing,
    /// What the user should know.
    pub doubts: Vec<MotionDoubt>,
    /// What a value is.
    pub response: ResponseKind,
}

answer_of!(ShockSpectrumReport as report {
    /// The response quantity.
    kind: &'static str;
    /// Which peak.
    peak: &'static str;
    damping_ratio: f64;
    /// Q = 1/(2ζ); `null` without damping.
    quality_factor_ratio: Option<f64> = (report.damping_ratio > 0.0).then(|| 0.5 / report.damping_ratio);
    /// Whether samples were added for oscillators with few in a period.
    upsample: bool;
    /// One for each file, in their order, or that of the pulse.
    spectra: Vec<&OneShockSpectrum> = report.spectra.iter().collect();
    timing: Timing;
});

/// Frequencies between two questions whether to go on: enough that the samples that are added for
/// each group cost little beside its oscillators.
const GROUP: usize = 4096;

/// Computes the spectra of motions. `go_on` is asked between groups of frequencies.
///
/// # Errors
/// Invalid frequencies or damping, accelerations that overflow; that of `go_on`.
pub fn recorded_shock_spectra(
    motions: &[ReadMotion],
    request: &ShockSpectrumRequest,
    go_on: impl Fn() -> Result<(), Problem>,
) -> Result<ShockSpectrumReport, Problem> {
    let options = ShockSpectrumOptions {
        kind: request.kind,
        damping_ratio: request.damping_ratio,
        upsample: request.upsample,
    };
    let (mut spectra, mut notes, mut solve_s) = (Vec::new(), Vec::new(), 0.0);
    for read in motions {
        let recorded = &read.motion;
        let motion = &recorded.motion;
        let began = Instant::now();
        let mut found = ShockSpectrum {
            peaks: Vec::new(),
            samples_per_period: Vec::new(),
        };
        // The peaks of an oscillator do not depend on the others.
        for frequencies_hz in request.frequencies_hz.chunks(GROUP) {
            go_on()?;
            let part = shock_spectrum(motion, frequencies_hz, options)
                .map_err(|error| refused(error).in_file(&recorded.path))?;
            found.peaks.extend(part.peaks);
            found.samples_per_period.extend(part.samples_per_period);
        }
        go_on()?;
        solve_s += began.elapsed().as_secs_f64();
        let mut one = one(recorded.name.clone(), read.unit, &found, request)?;
        one.path = Some(recorded.path.to_string_lossy().into_owned());
        (one.dt_s, one.samples) = (Some(motion.dt_s()), Some(motion.accel_m_s2().len()));
        one.processing.clone_from(&recorded.processing);
        let all = read
            .notes
            .iter()
            .cloned()
            .chain(sampling_note(request, motion.dt_s(), &found));
        notes.extend(all.map(|note| (&recorded.name, note)));
        spectra.push(one);
    }
    let notes: Vec<String> = match motions {
        [_] => notes.iter().map(|(_, note)| note.to_string()).collect(),
        _ => grouped(notes.iter().map(|(name, note)| (name, note))),
    };
    let doubts = notes.into_iter().map(MotionDoubt::OfRecords).collect();
    Ok(report(request, spectra, solve_s, doubts))
}

/// Computes the spectrum of a pulse; `unit` is that of accelerations in the result. `go_on` is asked
/// before it and after it: its steps depend on all frequencies together.
///
/// # Errors
/// As [`recorded_shock_spectra`].
pub fn pulse_shock_spectrum(
    pulse: &Pulse,
    unit: &'static str,
    request: &ShockSpectrumRequest,
    go_on: impl Fn() -> Result<(), Problem>,
) -> Result<ShockSpectrumReport, Problem> {
    go_on()?;
    let began = Instant::now();
    let found = pulse_spectrum(
        pulse,
        &request.frequencies_hz,
        request.kind,
        request.damping_ratio,
    )
    .map_err(refused)?;
    go_on()?;
    let solve_s = began.elapsed().as_secs_f64();
    let mut one = one(
        name_of(SHAPES, pulse.shape()).to_owned(),
        unit,
        &found,
        request,
    )?;
    let (peak_m_s2, duration_s) = (pulse.peak_acceleration_m_s2(), pulse.duration_s());
    one.pulse = Some(GivenPulse {
        shape: name_of(SHAPES, pulse.shape()),
        size: PulseSize::of(peak_m_s2, duration_s, pulse.velocity_change_m_s()),
    });
    let few = found
        .samples_per_period
        .iter()
        .any(|samples| *samples < SAMPLES_PER_PERIOD);
    Ok(report(
        request,
        vec![one],
        solve_s,
        few.then_some(MotionDoubt::LongPulse).into_iter().collect(),
    ))
}

/// The unit in which a quantity such as `30 g` is written, as spelled in outputs.
pub fn acceleration_unit(text: &str) -> &'static str {
    let unit = text
        .trim()
        .trim_start_matches(|c: char| c.is_ascii_digit() || "+-.,eE_ ".contains(c));
    find_unit(unit, Dimension::Acceleration).map_or(SI_ACCELERATION, |unit| unit.symbol)
}

const SI_ACCELERATION: &str = "m/s2";

fn refused(error: ShockResponseError) -> Problem {
    let hint = match error {
        ShockResponseError::Frequency { .. } => {
            "give frequencies above zero, such as \"1 Hz:10 kHz:12/oct\""
        }
        ShockResponseError::Damping { .. } => "give damping from 0 to below 1; 5 % is Q = 10",
        ShockResponseError::Overflow { .. } => "check the unit of the accelerations",
    };
    Problem::value(error.to_string(), hint)
}

/// The chosen peaks in the unit of the input, and the half-sine that envelopes them.
fn one(
    name: String,
    input_unit: &'static str,
    found: &ShockSpectrum,
    request: &ShockSpectrumRequest,
) -> Result<OneShockSpectrum, Problem> {
    let values_si: Vec<f64> = found
        .peaks
        .iter()
        .map(|one| one.peak(request.peak))
        .collect();
    let known = find_unit(input_unit, Dimension::Acceleration).ok();
    let (unit, values) = match request.kind {
        ResponseKind::AbsoluteAcceleration => match known {
            Some(unit) => (
                unit.symbol,
                values_si.iter().map(|&value| unit.from_si(value)).collect(),
            ),
            // Counts, and units that only one file format has.
            None => (SI_ACCELERATION, values_si.clone()),
        },
        ResponseKind::RelativeDisplacement => ("m", values_si.clone()),
        ResponseKind::PseudoVelocity => ("m/s", values_si.clone()),
    };
    let enveloped =
        request.kind == ResponseKind::AbsoluteAcceleration && request.peak == Peak::Maximax;
    let enveloping = if enveloped {
        enveloping_half_sine(&request.frequencies_hz, &values_si, request.damping_ratio)
            .map_err(refused)?
    } else {
        None
    };
    Ok(OneShockSpectrum {
        path: None,
        name,
        frequencies_hz: request.frequencies_hz.clone(),
        values,
        unit,
        samples_per_period: found.samples_per_period.clone(),
        dt_s: None,
        samples: None,
        processing: Vec::new(),
        pulse: None,
        enveloping_half_sine: enveloping.map(
            |HalfSine {
                 peak_acceleration,
                 duration_s,
             }| {
                let velocity_change_m_s = 2.0 / PI * peak_acceleration * duration_s;
                EnvelopingPulse {
                    rule: "smallest-peak",
                    size: PulseSize::of(peak_acceleration, duration_s, velocity_change_m_s),
                }
            },
        ),
        values_si,
    })
}

fn report(
    request: &ShockSpectrumRequest,
    spectra: Vec<OneShockSpectrum>,
    solve_s: f64,
    doubts: Vec<MotionDoubt>,
) -> ShockSpectrumReport {
    ShockSpectrumReport {
        kind: name_of(KINDS, request.kind),
        peak: name_of(PEAKS, request.peak),
        damping_ratio: request.damping_ratio,
        upsample: request.upsample,
        spectra,
        timing: Timing { solve_s },
        doubts,
        response: request.kind,
    }
}

/// Samples in a period below which the response of an oscillator is uncertain: ISO 18431-4 requires
/// ten.
const FEW_SAMPLES: f64 = 10.0;

/// A note about frequencies above those of the record, or whose peaks lie between samples.
fn sampling_note(request: &ShockSpectrumRequest, dt_s: f64, found: &ShockSpectrum) -> Option<Note> {
    let highest_hz = request.frequencies_hz.iter().copied().fold(0.0, f64::max);
    let in_hz = |f: f64| format!("{} Hz", number(f, 4));
    if highest_hz * dt_s > 0.5 {
        let words = format!(
            "the record contains nothing above half its sampling rate, {}: oscillators of higher frequency respond \
             only to what is below",
            in_hz(0.5 / dt_s)
        );
        return Some(Note::new(NoteKind::FewSamples, words));
    }
    let least = found
        .samples_per_period
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min);
    let low_percent = 100.0 * (1.0 - (PI / least).cos());
    let low = number(low_percent, 2);
    let words = if !request.upsample && least < FEW_SAMPLES {
        let above = in_hz(1.0 / (FEW_SAMPLES * dt_s));
        format!(
            "without upsampling, peaks above {above} come from fewer than ten samples in a period and may be {low} % \
             too low"
        )
    } else if request.upsample && least < SAMPLES_PER_PERIOD {
        format!(
            "the record is too long for {SAMPLES_PER_PERIOD} samples in every period: at {} a period has {}, and \
             peaks may be {low} % too low",
            in_hz(highest_hz),
            number(least, 3)
        )
    } else {
        return None;
    };
    Some(Note::new(NoteKind::FewSamples, words))
}

impl ShockSpectrumReport {
    /// The spectra as CSV, one below the other: the columns are always the same.
    ///
    /// # Errors
    /// None in practice: see [`table`].
    pub fn table(&self) -> Result<Table, Problem> {
        let only = |kind: ResponseKind, value: f64| (self.response == kind).then_some(value);
        table(self.spectra.iter().flat_map(|one| {
            one.frequencies_hz
                .iter()
                .zip(&one.values_si)
                .map(|(&frequency_hz, &value)| {
                    Facts::default()
                        .key("name", one.name.as_str())
                        .key("frequency_hz", frequency_hz)
                        .key(
                            "absolute_acceleration_g",
                            only(ResponseKind::AbsoluteAcceleration, value / G0_M_S2),
                        )
                        .key(
                            "absolute_acceleration_m_s2",
                            only(ResponseKind::AbsoluteAcceleration, value),
                        )
                        .key(
                            "relative_displacement_m",
                            only(ResponseKind::RelativeDisplacement, value),
                        )
                        .key(
                            "pseudo_velocity_m_s",
                            only(ResponseKind::PseudoVelocity, value),
                        )
                })
        }))
    }
}

#[cfg(test)]
mod tests;
