//! The shock response spectrum of an acceleration.

use rayon::prelude::*;

use crate::motion::Motion;
use crate::signal::resample::MAX_LENGTH;

use super::filter::{Bank, Filter};
use super::upsample::{MAX_FACTOR, doublings};
use super::{ResponseKind, ResponsePeaks, ShockResponseError};

/// Samples per period of every oscillator: the largest sample is within 1 − cos(π/128) = 0.03 % of
/// the peak, and straight lines between samples reduce the response of a component at its own
/// frequency by (π/128)²/3 = 0.02 %.
pub const SAMPLES_PER_PERIOD: f64 = 128.0;

/// Doublings of the rate that apply even to slow oscillators: the damper transmits a little of the
/// upper end of the band, where straight lines between the samples of the motion would remove half
/// of it.
const MIN_DOUBLINGS: usize = 2;

/// Oscillators calculated at once: two of the widest vectors, four of the next.
const LANES: usize = 16;

/// How a shock response spectrum is calculated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShockSpectrumOptions {
    /// The response that the spectrum shows.
    pub kind: ResponseKind,
    /// Damping ratio ζ = 1/(2Q).
    pub damping_ratio: f64,
    /// Whether to add samples on the band-limited curve, so that every oscillator has
    /// [`SAMPLES_PER_PERIOD`]. Without them the filter of ISO 18431-4 runs over the original
    /// samples.
    pub upsample: bool,
}

impl Default for ShockSpectrumOptions {
    /// Absolute acceleration, ζ = 5 % (Q = 10), with upsampling.
    fn default() -> Self {
        Self {
            kind: ResponseKind::default(),
            damping_ratio: 0.05,
            upsample: true,
        }
    }
}

/// A shock response spectrum: one entry for each frequency, in the same order.
#[derive(Debug, Clone, PartialEq)]
pub struct ShockSpectrum {
    /// The peaks of each oscillator.
    pub peaks: Vec<ResponsePeaks>,
    /// Samples per period of each oscillator from which its peaks were taken.
    pub samples_per_period: Vec<f64>,
}

/// Shock response spectrum of a motion: oscillators at rest until it begins,
/// `ü + 2ζωu̇ + ω²u = −a`, each calculated over the motion and then, in closed form, through its
/// free decay.
///
/// Outside the motion the base is at rest; a straight line over one time step leads from zero to
/// its first sample and from its last sample to zero. Zeros before or after a motion that begins
/// and ends at zero change nothing.
///
/// **Units**: Hz in; m/s², m or m/s out, depending on [`ResponseKind`].
///
/// # Reference
/// Smallwood (1981), "An improved recursive formula for calculating shock response spectra"; ISO
/// 18431-4:2007.
///
/// # Accuracy
/// Without upsampling: the ramp-invariant filter to rounding, with peaks at the samples. With
/// upsampling: 0.05 % of the response to the band-limited curve through the samples, at any
/// frequency up to half the sampling rate that has [`SAMPLES_PER_PERIOD`] samples; 0.1 % where
/// noise fills the band up to there.
///
/// # Limitation
/// A motion contains nothing above half its sampling rate: at higher frequencies the result is the
/// response of a stiff oscillator to the content below.
///
/// # Errors
/// A frequency that is not positive, damping outside 0 ≤ ζ < 1, or responses too large for a
/// floating-point number.
///
/// # Example
/// A half-sine of 1 m/s² and 10 ms, ζ = 5 %, at fT = 1: 1.62379.
/// ```
/// use freestand::motion::Motion;
/// use freestand::shock_response::{Peak, ShockSpectrumOptions, shock_spectrum};
/// let sine = |k: u32| (std::f64::consts::PI * f64::from(k) / 1000.0).sin();
/// let pulse = Motion::new(1e-5, (0..=1000).map(sine).collect())?;
/// let spectrum = shock_spectrum(&pulse, &[100.0], ShockSpectrumOptions::default())?;
/// assert!((spectrum.peaks[0].peak(Peak::Maximax) - 1.62379).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn shock_spectrum(
    motion: &Motion,
    frequencies_hz: &[f64],
    options: ShockSpectrumOptions,
) -> Result<ShockSpectrum, ShockResponseError> {
    shock_spectrum_on(pulp::Arch::new(), motion, frequencies_hz, options)
}

/// [`shock_spectrum`] with the vector instructions of `arch`.
pub(super) fn shock_spectrum_on(
    arch: pulp::Arch,
    motion: &Motion,
    frequencies_hz: &[f64],
    options: ShockSpectrumOptions,
) -> Result<ShockSpectrum, ShockResponseError> {
    let levels: Vec<usize> = frequencies_hz
        .iter()
        .map(|&f| level(motion, f, options.upsample))
        .collect();
    let highest = levels.iter().copied().max().unwrap_or(0);
    let series = doublings(arch, motion, 1 << highest);
    // A level that could not be calculated is replaced by that of the finest available series.
    let levels: Vec<usize> = levels
        .into_iter()
        .map(|level| level.min(series.len() - 1))
        .collect();

    let mut banks: Vec<(usize, Vec<usize>)> = Vec::new();
    for (index, &level) in levels.iter().enumerate() {
        match banks
            .iter_mut()
            .rfind(|bank| bank.0 == level && bank.1.len() < LANES)
        {
            Some(bank) => bank.1.push(index),
            None => banks.push((level, vec![index])),
        }
    }
    let found: Result<Vec<Vec<ResponsePeaks>>, ShockResponseError> = banks
        .par_iter()
        .map(|(level, indices)| {
            let factor = 1usize << level;
            let frequencies: Vec<f64> =
                indices.iter().map(|&index| frequencies_hz[index]).collect();
            bank(
                arch,
                &series[*level],
                factor,
                motion.dt_s() / factor as f64,
                &frequencies,
                options,
            )
        })
        .collect();
    let mut peaks = vec![ResponsePeaks::default(); frequencies_hz.len()];
    for ((_, indices), found) in banks.iter().zip(found?) {
        for (&index, one) in indices.iter().zip(found) {
            peaks[index] = one;
        }
    }
    let per_period = |(&f, &level): (&f64, &usize)| (1usize << level) as f64 / (f * motion.dt_s());
    let samples_per_period = frequencies_hz.iter().zip(&levels).map(per_period).collect();
    Ok(ShockSpectrum {
        peaks,
        samples_per_period,
    })
}

/// Number of doublings of the rate for an oscillator; its input does not depend on the other
/// oscillators.
fn level(motion: &Motion, frequency_hz: f64, upsample: bool) -> usize {
    let (mut level, mut per_period) = (0, 1.0 / (frequency_hz * motion.dt_s()));
    let length = |level: usize| motion.accel_m_s2().len() << level;
    while upsample
        && (per_period < SAMPLES_PER_PERIOD || level < MIN_DOUBLINGS)
        && 1 << level < MAX_FACTOR
        && length(level + 1) <= MAX_LENGTH
    {
        level += 1;
        per_period *= 2.0;
    }
    level
}

/// The peaks of up to [`LANES`] oscillators under a series whose ends are `factor` steps from zero.
fn bank(
    arch: pulp::Arch,
    series: &[f64],
    factor: usize,
    step_s: f64,
    frequencies_hz: &[f64],
    options: ShockSpectrumOptions,
) -> Result<Vec<ResponsePeaks>, ShockResponseError> {
    let filters: Vec<Filter> = frequencies_hz
        .iter()
        .map(|&f| Filter::new(options.kind, f, options.damping_ratio, step_s))
        .collect::<Result<_, _>>()?;
    let mut bank = Bank::<LANES>::new(&filters);
    let ramp = |end: f64, part: usize| end * part as f64 / factor as f64;
    let (first, last) = (
        series.first().copied().unwrap_or(0.0),
        series.last().copied().unwrap_or(0.0),
    );
    let up: Vec<f64> = (1..factor).map(|part| ramp(first, part)).collect();
    let down: Vec<f64> = (1..factor).rev().map(|part| ramp(last, part)).collect();
    bank.run(arch, &up);
    bank.run(arch, series);
    let primary: Vec<(f64, f64)> = (0..filters.len()).map(|lane| bank.extremes(lane)).collect();
    bank.forget_extremes();
    bank.run(arch, &down);
    let peaks = filters
        .iter()
        .zip(primary)
        .zip(frequencies_hz)
        .enumerate()
        .map(|(lane, ((filter, primary), &f))| {
            let (most, least) = bank.extremes(lane);
            // One step after the last sample of the ramp the acceleration is zero, and w is the mode
            // itself.
            let decay = filter.decay(bank.state(lane));
            let peaks = ResponsePeaks {
                primary_positive: primary.0,
                primary_negative: 0.0 - primary.1,
                residual_positive: most.max(decay.0),
                residual_negative: 0.0 - least.min(decay.1),
            };
            let all = [
                peaks.primary_positive,
                peaks.primary_negative,
                peaks.residual_positive,
                peaks.residual_negative,
            ];
            let finite = filter.is_finite()
                && bank.state(lane).is_finite()
                && all.iter().all(|value| value.is_finite());
            if finite {
                Ok(peaks)
            } else {
                Err(ShockResponseError::Overflow { frequency_hz: f })
            }
        });
    peaks.collect()
}

#[cfg(test)]
mod tests;
