//! The response of a component inside the object to a shock: shock response spectra.
//!
//! A component is a damped linear oscillator whose base moves with the shock. Its **shock response
//! spectrum** is the largest response of such oscillators plotted against their frequency. This is
//! not the "SRS" of the paper, which is the shock plotted against the size of the object
//! ([`crate::spectra`]).
//!
//! | spectrum or result | function |
//! |---|---|
//! | of a measured or simulated acceleration | [`shock_spectrum`] |
//! | of a classical pulse | [`Pulse`], [`pulse_spectrum`] |
//! | of an undamped component under a half-sine, in closed form | [`half_sine_maximax_ratio`] |
//! | one half-sine relative to another | [`half_sine_severity_ratio`] |
//! | the half-sine that envelopes a spectrum | [`enveloping_half_sine`] |
//! | what a component of given frequency and capacity withstands | [`crate::damage_boundary`] |

mod envelope;
mod filter;
mod half_sine;
mod pulse;
mod spectrum;
mod upsample;

pub use envelope::enveloping_half_sine;
pub use half_sine::{HalfSine, half_sine_maximax_ratio, half_sine_severity_ratio};
pub use pulse::{Pulse, PulseError, PulseShape, pulse_spectrum};
pub use spectrum::{SAMPLES_PER_PERIOD, ShockSpectrum, ShockSpectrumOptions, shock_spectrum};

use thiserror::Error;

/// The response of the oscillator that the spectrum shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ResponseKind {
    /// Absolute acceleration of the component \[m/s²\], the quantity of its data sheet.
    #[default]
    AbsoluteAcceleration,
    /// Displacement relative to the base \[m\], which governs clearances and mounts.
    RelativeDisplacement,
    /// Relative displacement times ω \[m/s\], which is proportional to stress.
    PseudoVelocity,
}

/// The peak of the response that the spectrum shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Peak {
    /// The largest, of either sign, during the motion or after it.
    #[default]
    Maximax,
    /// The largest positive one, during the motion or after it.
    Positive,
    /// The absolute value of the largest negative one, during the motion or after it.
    Negative,
    /// The largest, of either sign, during the motion.
    Primary,
    /// The largest, of either sign, after the motion.
    Residual,
}

/// The peaks of one response as absolute values; zero where the response never has that sign.
///
/// **Units**: those of the [`ResponseKind`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ResponsePeaks {
    /// Largest positive response during the motion.
    pub primary_positive: f64,
    /// Largest negative response during the motion.
    pub primary_negative: f64,
    /// Largest positive response after the motion.
    pub residual_positive: f64,
    /// Largest negative response after the motion.
    pub residual_negative: f64,
}

impl ResponsePeaks {
    /// The requested peak.
    pub fn peak(&self, peak: Peak) -> f64 {
        let primary = self.primary_positive.max(self.primary_negative);
        let residual = self.residual_positive.max(self.residual_negative);
        match peak {
            Peak::Maximax => primary.max(residual),
            Peak::Positive => self.primary_positive.max(self.residual_positive),
            Peak::Negative => self.primary_negative.max(self.residual_negative),
            Peak::Primary => primary,
            Peak::Residual => residual,
        }
    }
}

/// Why a shock response spectrum cannot be calculated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ShockResponseError {
    /// A frequency that is not positive, or whose square is not finite.
    #[error("a frequency must be positive and its square finite, not {frequency_hz} Hz")]
    Frequency {
        /// The frequency that was given.
        frequency_hz: f64,
    },
    /// Damping outside 0 ≤ ζ < 1.
    #[error("the damping ratio must be at least 0 and below 1, not {damping_ratio}")]
    Damping {
        /// The damping ratio that was given.
        damping_ratio: f64,
    },
    /// The accelerations are so large that the response is not a finite number.
    #[error("the response at {frequency_hz} Hz is too large for a floating-point number")]
    Overflow {
        /// The frequency of the oscillator.
        frequency_hz: f64,
    },
}
