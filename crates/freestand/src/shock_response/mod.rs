//! What a component inside the object feels of a shock: shock response spectra.
//!
//! A component is a damped linear oscillator on a base that moves as the shock says. Its **shock response spectrum** is
//! the largest response of such oscillators against their frequency. This is not the paper's "SRS", which is the edge
//! shock against the size of the object ([`crate::spectra`]).
//!
//! | what | where |
//! |---|---|
//! | of a measured or simulated acceleration | [`shock_spectrum`] |
//! | of a classical pulse | [`Pulse`], [`pulse_spectrum`] |
//! | of an undamped component under a half-sine, in closed form | [`half_sine_maximax_ratio`] |
//! | one half-sine against another | [`half_sine_severity_ratio`] |
//! | the half-sine that envelopes a spectrum | [`enveloping_half_sine`] |
//! | what a component of given frequency and capacity stands | [`crate::damage_boundary`] |

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

/// What is looked at in the oscillator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ResponseKind {
    /// Absolute acceleration of the component \[m/s²\]: what its data sheet is written in.
    #[default]
    AbsoluteAcceleration,
    /// Displacement relative to the base \[m\]: what its clearance and its mounts feel.
    RelativeDisplacement,
    /// Relative displacement times ω \[m/s\]: what its stress goes with.
    PseudoVelocity,
}

/// Which peak of the response.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Peak {
    /// The largest of all, either sign, during the record or after it.
    #[default]
    Maximax,
    /// The largest positive one, during the record or after it.
    Positive,
    /// The size of the largest negative one, during the record or after it.
    Negative,
    /// The largest of either sign while the record lasts.
    Primary,
    /// The largest of either sign after the record.
    Residual,
}

/// The peaks of one response, each as its size: zero where the response never has that sign.
///
/// **Units**: those of the [`ResponseKind`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ResponsePeaks {
    /// Largest positive response while the record lasts.
    pub primary_positive: f64,
    /// Largest negative one.
    pub primary_negative: f64,
    /// Largest positive response after the record.
    pub residual_positive: f64,
    /// Largest negative one.
    pub residual_negative: f64,
}

impl ResponsePeaks {
    /// The peak that is asked for.
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

/// Why there is no shock response spectrum.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ShockResponseError {
    /// A frequency that no oscillator has.
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
    /// The accelerations are so large that the response is no finite number.
    #[error("the response at {frequency_hz} Hz is too large for a number")]
    Overflow {
        /// The frequency of the oscillator.
        frequency_hz: f64,
    },
}
