//! Zero-phase Butterworth filters, and the pads that they need.

use crate::motion::{MAX_SAMPLES, Motion, MotionError};
use std::f64::consts::PI;
use thiserror::Error;

/// The highest order of a filter.
pub const MAX_ORDER: u32 = 10;

/// Why a motion cannot be filtered.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FilterError {
    /// The order is out of range.
    #[error("the order of a filter must be 1 to {MAX_ORDER}, not {order}")]
    Order {
        /// The order that was given.
        order: u32,
    },
    /// A corner frequency that this time step cannot represent.
    #[error(
        "a corner frequency must be above 0 and below {nyquist_hz} Hz, half the sampling rate, not {corner_hz} Hz"
    )]
    Corner {
        /// The corner that was given.
        corner_hz: f64,
        /// The Nyquist frequency 1/(2 dt) \[Hz\].
        nyquist_hz: f64,
    },
    /// The lower corner is not below the upper one, so that no frequency passes.
    #[error("the low cut of {low_cut_hz} Hz is not below the high cut of {high_cut_hz} Hz")]
    NoBand {
        /// Lower corner \[Hz\].
        low_cut_hz: f64,
        /// Upper corner \[Hz\].
        high_cut_hz: f64,
    },
    /// The pads make the motion too long.
    #[error(
        "with pads of {pad_s} s at both ends the motion has {samples:.0} samples, more than {MAX_SAMPLES}"
    )]
    TooLong {
        /// Length of one pad \[s\].
        pad_s: f64,
        /// Number of samples with the pads.
        samples: f64,
    },
    /// The result is not a valid motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// The frequencies that pass the filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pass {
    /// Above a corner: removes drift.
    High {
        /// The corner \[Hz\].
        low_cut_hz: f64,
    },
    /// Below a corner: removes noise.
    Low {
        /// The corner \[Hz\].
        high_cut_hz: f64,
    },
    /// Between two corners: a high-pass and a low-pass filter in sequence, as strong-motion
    /// agencies do.
    Band {
        /// Lower corner \[Hz\].
        low_cut_hz: f64,
        /// Upper corner \[Hz\].
        high_cut_hz: f64,
    },
}

/// A filtered motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Filtered {
    /// The motion with its pads.
    pub motion: Motion,
    /// Length of the pad before the original first sample \[s\]: the motion starts that much
    /// earlier. The pad after the last sample has the same length.
    pub pad_s: f64,
}

/// One second-order section, `y = b₀x + b₁x₋₁ + b₂x₋₂ − a₁y₋₁ − a₂y₋₂`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// b₀, b₁, b₂.
    pub numerator: [f64; 3],
    /// a₁, a₂; a₀ is 1.
    pub denominator: [f64; 2],
}

/// The filtered motion, without a shift in time; the pads remain part of it.
///
/// Each Butterworth filter of order n runs over the motion forwards and backwards. The phase is
/// zero and the gain is that of two passes, `1/(1 + (f_c/f)²ⁿ)` for the high-pass filter (f and f_c
/// warped by the bilinear transform): **one half at the corner**, not 1/√2.
///
/// First, zeros for 1.5 n/f_c, with f_c the lower corner, are added before and after the motion,
/// and they remain: the filter responds before the first sample as it does after the last one.
/// Without that response, velocity and displacement would have an offset.
///
/// # Reference
/// Boore (2005), "On pads and filters: processing strong-motion data", BSSA 95, 745–750; Converse
/// and Brady (1992) for the length of the pads; the bilinear transform as in Oppenheim and Schafer.
///
/// # Accuracy
/// Agrees with SciPy's `butter(…, output="sos")` and `sosfilt`: coefficients to 10⁻¹², series to
/// 10⁻¹⁰ of their peak (corners down to 10⁻³ of the sampling rate; each tenfold lower corner costs
/// two digits).
///
/// # Limitation
/// A motion that does not start and end near zero meets its pads with a jump: remove its mean or
/// baseline, and taper it.
///
/// # Errors
/// An order outside 1 to 10, a corner that is not between 0 and half the sampling rate, a lower
/// corner that is not below the upper one, or pads beyond [`MAX_SAMPLES`].
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::filter::{Pass, filtered}};
/// let spike = Motion::new(0.01, (0..=1000).map(|k| if k == 500 { 1.0 } else { 0.0 }).collect())?;
/// let out = filtered(&spike, Pass::High { low_cut_hz: 0.5 }, 4)?;
/// assert_eq!((out.pad_s, out.motion.duration_s()), (12.0, 34.0));
/// let accel = out.motion.accel_m_s2();
/// assert!((accel[1700 - 30] - accel[1700 + 30]).abs() < 1e-9); // the same before and after
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn filtered(motion: &Motion, pass: Pass, order: u32) -> Result<Filtered, FilterError> {
    let dt_s = motion.dt_s();
    let (sections, lowest_hz) = match pass {
        Pass::High { low_cut_hz } => (high_pass_sections(low_cut_hz, order, dt_s)?, low_cut_hz),
        Pass::Low { high_cut_hz } => (low_pass_sections(high_cut_hz, order, dt_s)?, high_cut_hz),
        Pass::Band {
            low_cut_hz,
            high_cut_hz,
        } => {
            let mut sections = high_pass_sections(low_cut_hz, order, dt_s)?;
            sections.extend(low_pass_sections(high_cut_hz, order, dt_s)?);
            // Not `>=`: both corners are valid here, so neither is NaN.
            if low_cut_hz >= high_cut_hz {
                return Err(FilterError::NoBand {
                    low_cut_hz,
                    high_cut_hz,
                });
            }
            (sections, low_cut_hz)
        }
    };
    let pad_s = 1.5 * f64::from(order) / lowest_hz;
    let pad = (pad_s / dt_s * (1.0 - 4.0 * f64::EPSILON)).ceil();
    let samples = motion.accel_m_s2().len() as f64 + 2.0 * pad;
    if samples > MAX_SAMPLES as f64 {
        return Err(FilterError::TooLong { pad_s, samples });
    }
    let pad = pad as usize;
    let mut values = vec![0.0; motion.accel_m_s2().len() + 2 * pad];
    values[pad..pad + motion.accel_m_s2().len()].copy_from_slice(motion.accel_m_s2());
    for section in &sections {
        section.run(values.iter_mut());
    }
    for section in &sections {
        section.run(values.iter_mut().rev());
    }
    Ok(Filtered {
        motion: Motion::new(dt_s, values)?,
        pad_s: pad as f64 * dt_s,
    })
}

impl Section {
    /// Replaces each value by the output of the section for it and the values before it, from rest
    /// (transposed direct form II).
    fn run<'a>(&self, values: impl Iterator<Item = &'a mut f64>) {
        let ([b0, b1, b2], [a1, a2]) = (self.numerator, self.denominator);
        let (mut first, mut second) = (0.0, 0.0);
        for value in values {
            let x = *value;
            let y = b0 * x + first;
            first = b1 * x - a1 * y + second;
            second = b2 * x - a2 * y;
            // The tail after the last sample would decay through subnormal numbers, which are slow
            // on many processors.
            *value = if y.abs() < f64::MIN_POSITIVE { 0.0 } else { y };
            if first.abs() < f64::MIN_POSITIVE {
                first = 0.0;
            }
            if second.abs() < f64::MIN_POSITIVE {
                second = 0.0;
            }
        }
    }
}

/// Sections of a Butterworth high-pass filter; an odd order has one section of first order, whose
/// last coefficients are zero.
///
/// # Errors
/// Those of [`filtered`].
///
/// # Example
/// ```
/// use freestand::signal::filter::high_pass_sections;
/// assert_eq!(high_pass_sections(0.1, 5, 0.01)?.len(), 3); // one of first order, two of second
/// # Ok::<(), freestand::signal::filter::FilterError>(())
/// ```
pub fn high_pass_sections(
    corner_hz: f64,
    order: u32,
    dt_s: f64,
) -> Result<Vec<Section>, FilterError> {
    let warped = warped(corner_hz, order, dt_s)?;
    Ok(sections(order, warped, |poles| match poles {
        1 => [1.0, -1.0, 0.0],
        _ => [1.0, -2.0, 1.0],
    }))
}

/// Sections of a Butterworth low-pass filter; an odd order has one section of first order, whose
/// last coefficients are zero.
///
/// # Errors
/// Those of [`filtered`].
///
/// # Example
/// The gain at zero frequency is 1:
/// ```
/// let sections = freestand::signal::filter::low_pass_sections(5.0, 3, 0.01)?;
/// let gain = |s: &freestand::signal::filter::Section| {
///     s.numerator.iter().sum::<f64>() / (1.0 + s.denominator.iter().sum::<f64>())
/// };
/// assert!((sections.iter().map(gain).product::<f64>() - 1.0).abs() < 1e-13);
/// # Ok::<(), freestand::signal::filter::FilterError>(())
/// ```
pub fn low_pass_sections(
    corner_hz: f64,
    order: u32,
    dt_s: f64,
) -> Result<Vec<Section>, FilterError> {
    let k = warped(corner_hz, order, dt_s)?;
    Ok(sections(order, k, |poles| match poles {
        1 => [k, k, 0.0],
        _ => [k * k, 2.0 * k * k, k * k],
    }))
}

/// tan(π f_c dt): the analogue corner that the bilinear transform `s = (1 − z⁻¹)/(1 + z⁻¹)` maps to
/// f_c.
fn warped(corner_hz: f64, order: u32, dt_s: f64) -> Result<f64, FilterError> {
    if !(1..=MAX_ORDER).contains(&order) {
        return Err(FilterError::Order { order });
    }
    let nyquist_hz = 0.5 / dt_s;
    if !(corner_hz > 0.0 && corner_hz < nyquist_hz) {
        return Err(FilterError::Corner {
            corner_hz,
            nyquist_hz,
        });
    }
    Ok((PI * corner_hz * dt_s).tan())
}

/// Analogue poles k·e^(±i(π/2 + φ)), φ = π (2j + 1)/(2n): `s² + 2k sin φ s + k²` for a pair,
/// `s + k` for the real one.
fn sections(order: u32, k: f64, numerator: impl Fn(u32) -> [f64; 3]) -> Vec<Section> {
    let mut list = Vec::new();
    if order % 2 == 1 {
        let scale = 1.0 / (1.0 + k);
        list.push(Section {
            numerator: numerator(1).map(|b| b * scale),
            denominator: [(k - 1.0) * scale, 0.0],
        });
    }
    for j in 0..order / 2 {
        let damping = 2.0 * (PI * f64::from(2 * j + 1) / f64::from(2 * order)).sin();
        let scale = 1.0 / (1.0 + damping * k + k * k);
        list.push(Section {
            numerator: numerator(2).map(|b| b * scale),
            denominator: [
                2.0 * (k * k - 1.0) * scale,
                (1.0 - damping * k + k * k) * scale,
            ],
        });
    }
    list
}

#[cfg(test)]
mod tests;
