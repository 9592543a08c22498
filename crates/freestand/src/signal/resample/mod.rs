//! Resampling to another time step, by band-limited (sinc) interpolation.

use crate::motion::{MAX_SAMPLES, Motion, MotionError};
use rustfft::FftPlannerScalar;
use rustfft::num_complex::Complex;
use thiserror::Error;

/// Why a motion cannot be resampled.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ResampleError {
    /// The new step is not positive and finite, or longer than the motion.
    #[error(
        "the new time step must be positive and no longer than the motion ({duration_s} s), not {dt_s} s"
    )]
    Step {
        /// The time step that was requested \[s\].
        dt_s: f64,
        /// Length of the motion \[s\].
        duration_s: f64,
    },
    /// The ratio of the two time steps is not simple enough.
    #[error(
        "the ratio of the time steps {from_s} s and {to_s} s is not a ratio of whole numbers up to {MAX_TERM}"
    )]
    Ratio {
        /// The time step of the motion \[s\].
        from_s: f64,
        /// The time step that was requested \[s\].
        to_s: f64,
    },
    /// More samples than [`MAX_LENGTH`].
    #[error("{samples:.0} samples exceed the {MAX_LENGTH} that resampling can process")]
    TooLong {
        /// Number of samples.
        samples: f64,
    },
    /// The result is not a valid motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// The largest whole number in the ratio of two time steps.
const MAX_TERM: u64 = 10_000;
/// The largest number of samples of a resampled motion, also in intermediate steps: with its work
/// space a transform needs 32 bytes per value.
pub const MAX_LENGTH: usize = MAX_SAMPLES / 4;
/// Samples of each end that are mirrored beyond it.
const MIRRORED: usize = 1000;

/// The motion with `factor` samples in place of each, on the band-limited curve through its
/// samples; factors of 0 and 1 change nothing.
///
/// `a(t) = Σ aₖ sinc((t − tₖ)/dt)`. A motion is by definition linear between its samples
/// ([`Motion::upsampled`]), but a digitised record was not. Straight lines reduce its short
/// periods: a response at T < 10 dt needs this curve.
///
/// # Ends
/// The sum needs samples beyond the ends. Each end is extended by up to 1000 of its neighbours,
/// mirrored through the end point (value and slope continue) and faded smoothly to zero. A record
/// that starts or ends with a jump therefore does not ring inside; the first and last few samples
/// are those of a curve that continues smoothly.
///
/// # Reference
/// Shannon (1949), Proc. IRE 37.
///
/// # Accuracy
/// The motion's own samples keep every bit. A motion without content above its Nyquist frequency,
/// at rest at both ends, is recovered to 10⁻¹² of its peak.
///
/// # Errors
/// More than 25 million samples.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::resample::upsampled_sinc};
/// let hump = |t: f64| (-0.5 * (t - 2.0).powi(2) / 0.04).exp();
/// let coarse = Motion::new(0.1, (0..=40).map(|k| hump(0.1 * f64::from(k))).collect())?;
/// let fine = upsampled_sinc(&coarse, 4)?;
/// assert_eq!((fine.dt_s(), fine.accel_m_s2().len()), (0.025, 161));
/// // The straight line is wrong by 0.03 here.
/// assert!((fine.accel_m_s2()[81] - hump(2.025)).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn upsampled_sinc(motion: &Motion, factor: usize) -> Result<Motion, ResampleError> {
    if factor <= 1 {
        return Ok(motion.clone());
    }
    let factor = u64::try_from(factor).unwrap_or(u64::MAX);
    let samples = (motion.accel_m_s2().len() - 1) as f64 * factor as f64 + 1.0;
    interpolated(
        motion,
        motion.dt_s() / factor as f64,
        Ratio {
            up: factor,
            down: 1,
        },
        samples,
    )
}

/// The motion at another time step, finer or coarser: the band-limited curve through its samples at
/// multiples of `dt_s` \[s\] from t = 0 to the last one within the motion.
///
/// Before a change to a coarser step, everything above the new Nyquist frequency 1/(2 `dt_s`) is
/// removed, so that nothing is aliased.
///
/// # Ends, accuracy, reference
/// Those of [`upsampled_sinc`]. At a coarser step the result rings at the new Nyquist frequency
/// next to sharp peaks, as after any low-pass filter with a vertical flank.
///
/// # Errors
/// A step that is not positive or is longer than the motion, steps whose ratio is not one of whole
/// numbers up to 10 000 (to 10⁻⁹), or more than 25 million samples in an intermediate step.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::resample::resampled};
/// let hump = |t: f64| (-0.5 * (t - 2.0).powi(2) / 0.04).exp();
/// let motion = Motion::new(0.05, (0..=80).map(|k| hump(0.05 * f64::from(k))).collect())?;
/// let other = resampled(&motion, 0.08)?; // 12.5 Hz contain this hump except for 2e-10 of it
/// assert_eq!((other.dt_s(), other.accel_m_s2().len()), (0.08, 51));
/// assert!((other.accel_m_s2()[24] - hump(1.92)).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn resampled(motion: &Motion, dt_s: f64) -> Result<Motion, ResampleError> {
    let duration_s = motion.duration_s();
    // The tiny factor allows for a duration that is a whole number of steps except for its last
    // bit.
    let last = (duration_s / dt_s * (1.0 + 4.0 * f64::EPSILON)).floor();
    if !(dt_s > 0.0 && dt_s.is_finite() && last >= 1.0) {
        return Err(ResampleError::Step { dt_s, duration_s });
    }
    if dt_s == motion.dt_s() {
        return Ok(motion.clone());
    }
    let ratio = Ratio::near(motion.dt_s() / dt_s).ok_or(ResampleError::Ratio {
        from_s: motion.dt_s(),
        to_s: dt_s,
    })?;
    let samples = ((motion.accel_m_s2().len() - 1) as f64 * ratio.up as f64 / ratio.down as f64)
        .floor()
        + 1.0;
    interpolated(motion, dt_s, ratio, samples)
}

/// `up` new steps have the length of `down` old ones.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ratio {
    up: u64,
    down: u64,
}

impl Ratio {
    /// The simplest ratio within 10⁻⁹ of `value`, by its continued fraction.
    fn near(value: f64) -> Option<Self> {
        let (mut before, mut now) = ((0u64, 1u64), (1u64, 0u64));
        let mut rest = value;
        // Each convergent at least doubles every second denominator: 40 go far beyond 10 000.
        for _ in 0..40 {
            let whole = rest.floor();
            if !(0.0..=MAX_TERM as f64).contains(&whole) {
                return None;
            }
            let next = (
                whole as u64 * now.0 + before.0,
                whole as u64 * now.1 + before.1,
            );
            (before, now) = (now, next);
            if now.0 > MAX_TERM || now.1 > MAX_TERM {
                return None;
            }
            if now.0 > 0 && (now.0 as f64 / now.1 as f64 / value - 1.0).abs() <= 1e-9 {
                return Some(Self {
                    up: now.0,
                    down: now.1,
                });
            }
            rest = 1.0 / (rest - whole);
        }
        None
    }
}

/// `samples` of the band-limited curve at intervals of `dt_s`, by transforms whose lengths span the
/// same time.
fn interpolated(
    motion: &Motion,
    dt_s: f64,
    ratio: Ratio,
    samples: f64,
) -> Result<Motion, ResampleError> {
    let accel = motion.accel_m_s2();
    let mirrored = MIRRORED.min(accel.len() - 1);
    let least = accel.len() + 2 * mirrored;
    let blocks = smooth_length(least as f64 / ratio.down as f64);
    let lengths = [
        ratio.down as f64 * blocks,
        ratio.up as f64 * blocks,
        samples,
    ];
    let longest = lengths.into_iter().fold(0.0, f64::max);
    if longest > MAX_LENGTH as f64 {
        return Err(ResampleError::TooLong { samples: longest });
    }
    let (old, new, samples) = (lengths[0] as usize, lengths[1] as usize, samples as usize);
    let mut values = continued(accel, mirrored, old);
    let mut planner = FftPlannerScalar::new();
    planner.plan_fft_forward(old).process(&mut values);
    let mut values = respaced(&values, new);
    planner.plan_fft_inverse(new).process(&mut values);
    let scale = 1.0 / old as f64;
    let mut result: Vec<f64> = values
        .iter()
        .take(samples)
        .map(|value| value.re * scale)
        .collect();
    if ratio.down == 1 {
        for (value, own) in result.iter_mut().step_by(ratio.up as usize).zip(accel) {
            *value = *own;
        }
    }
    Ok(Motion::new(dt_s, result)?)
}

/// The samples, followed by the extension of their end, with the extension of their start at the
/// end of `length`, which precedes index 0 of a periodic series.
fn continued(accel: &[f64], mirrored: usize, length: usize) -> Vec<Complex<f64>> {
    let mut values = vec![Complex::default(); length];
    for (value, accel) in values.iter_mut().zip(accel) {
        value.re = *accel;
    }
    let last = accel.len() - 1;
    for k in 1..=mirrored {
        let fade = fade(k as f64 / (mirrored + 1) as f64);
        values[last + k].re = fade * (2.0 * accel[last] - accel[last - k]);
        values[length - k].re = fade * (2.0 * accel[0] - accel[k]);
    }
    values
}

/// From 1 at x = 0 to 0 at x = 1, with all its derivatives zero at both ends: it adds no relevant
/// frequencies.
fn fade(x: f64) -> f64 {
    1.0 / (1.0 + (1.0 / (1.0 - x) - 1.0 / x).exp())
}

/// The transform of `length` values that spans the same time: empty frequencies are added, or
/// frequencies are left out.
fn respaced(spectrum: &[Complex<f64>], length: usize) -> Vec<Complex<f64>> {
    let old = spectrum.len();
    let shorter = old.min(length);
    let mut values = vec![Complex::default(); length];
    let positive = shorter.div_ceil(2);
    values[..positive].copy_from_slice(&spectrum[..positive]);
    let negative = (shorter - 1) / 2;
    values[length - negative..].copy_from_slice(&spectrum[old - negative..]);
    // The Nyquist frequency of the shorter one is a single value there and a pair in the longer
    // one.
    if shorter.is_multiple_of(2) {
        let half = shorter / 2;
        if length > old {
            values[half] = 0.5 * spectrum[half];
            values[length - half] = 0.5 * spectrum[half];
        } else if length < old {
            values[half] = spectrum[half] + spectrum[old - half];
        } else {
            values[half] = spectrum[half];
        }
    }
    values
}

/// The smallest number of at least `least` without a prime factor above 5: a transform of that
/// length is fast.
fn smooth_length(least: f64) -> f64 {
    let mut best = f64::INFINITY;
    let mut five = 1.0;
    while five < 5.0 * least.max(1.0) {
        let mut three = five;
        while three < 3.0 * least.max(1.0) {
            let two = three * (least / three).log2().ceil().max(0.0).exp2();
            if two >= least {
                best = best.min(two);
            }
            three *= 3.0;
        }
        five *= 5.0;
    }
    best
}

#[cfg(test)]
mod tests;
