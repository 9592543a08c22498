//! The identification of a cushion from tests: drop tests, repeated drops, static tests, and
//! virtual tests for practice.
//!
//! In a drop test a rigid mass with an accelerometer falls on a pad. [`drop_test`] finds the
//! contact, its zero line and the faults of the record, and fits the pulse of each law to the
//! samples; [`drop_tests`] does so for every drop of a record. Four textbook estimates of the stiffness, and the exponent from an identity of peak,
//! compression and velocity, are reported with the fit. A record that cannot be trusted gets flags
//! and no stiffness.
//!
//! **Signs**: accelerations are positive upward. The zero line is the mean before the contact, when
//! the mass falls freely: relative to it the reading is force over mass, whatever the coupling of
//! the sensor.

mod contact;
mod direct;
mod drop;
mod filter;
mod fit;
mod laws;
mod model;
mod pool;
mod static_curve;
mod virtual_laboratory;

pub use drop::{DropOfRecord, drop_test, drop_tests};
pub use pool::{NORMAL_975, Pooled, PooledDrop, pool_drops};
pub use static_curve::{StaticError, StaticOptions, StaticTest, Toe, static_test};
pub use virtual_laboratory::{
    VirtualDrop, VirtualDropOptions, VirtualStaticOptions, virtual_drop, virtual_static,
};

use thiserror::Error;

use crate::cushion::ContactLaw;

/// The laws that are fitted to a drop test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum FittedLaw {
    /// F = k d.
    Linear,
    /// F = K dⁿ.
    Power,
    /// F = k d + c ḋ.
    KelvinVoigt,
    /// F = K dⁿ (1 + Λḋ).
    HuntCrossley,
    /// F = K dⁿ + c ḋ: used to find the exponent of a damped pad, never chosen.
    DampedPower,
    /// F = k d + k₃ d³: a pad that hardens (k₃ > 0) or softens.
    Cubic,
    /// A curve without a formula, for pads that follow none: a table of forces.
    Tabulated,
}

impl FittedLaw {
    /// The name in flags, files and outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A fault of a drop test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Flag {
    /// No pulse exceeds the noise.
    NoPulse,
    /// The largest excursion is downward.
    UpsideDown,
    /// Too few samples before the contact for a zero line.
    NoPreTrigger,
    /// The record ends during the contact.
    CutOff,
    /// The top of the pulse is flat.
    Clipped,
    /// Fewer than 25 samples per contact.
    FewSamples,
    /// The zero line after the contact differs from the one before it by more than 0.5 % of the
    /// peak.
    ZeroShift,
    /// The zero line drifts by more than 0.5 % of the peak.
    Drift,
    /// The low-pass corner, stated or found from the pulse, times the contact time is below 6.
    Filter,
    /// The impulse of the pulse is less than m v₀, or clearly more than 2 m v₀.
    Impulse,
    /// The impact velocity of the best fit differs from the stated one.
    Velocity,
    /// The requested damped law fits only with negative damping; it is reported without damping.
    Damping,
    /// No law fits the samples.
    PoorFit,
    /// F/d from the integrated samples differs from the fit.
    Integration,
}

impl Flag {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// The source of the impact velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ImpactVelocity {
    /// From a height or a light gate, with its standard deviation.
    Known {
        /// Velocity v₀ at first contact \[m/s\].
        speed_m_s: f64,
        /// Relative standard deviation.
        error_ratio: f64,
    },
    /// From the pulse alone: the law divides the impulse into the parts before and after the
    /// largest compression.
    FromImpulse,
}

/// What is known about a drop test apart from its record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropSetup {
    /// Mass that falls \[kg\].
    pub mass_kg: f64,
    /// Its velocity at first contact.
    pub impact_velocity: ImpactVelocity,
    /// Gravity during the contact \[m/s²\].
    pub gravity_m_s2: f64,
    /// Corner of the low-pass filter before the converter \[Hz\].
    pub filter_corner_hz: Option<f64>,
    /// The only law to be fitted; `None` fits all and chooses one.
    pub law: Option<FittedLaw>,
}

/// Why a record cannot be evaluated as a drop test.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum DropError {
    /// A number that is not positive.
    #[error("the {name} must be positive, not {value}")]
    NotPositive {
        /// The name of the number.
        name: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// Too few samples.
    #[error("a drop test needs at least 20 samples, not {samples}")]
    TooShort {
        /// Number of samples.
        samples: usize,
    },
    /// A sample that is not a number.
    #[error("sample {number} is not a number")]
    NotFinite {
        /// The sample, counted from 1.
        number: usize,
    },
}

/// Stiffness from seven estimates \[N/m\]; for F = kd they all agree, and their spread is a measure
/// of the quality of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StiffnessEstimates {
    /// F/d at the largest compression of the fitted law, without its damping.
    pub fit_n_m: f64,
    /// m(a/v₀)².
    pub peak_over_velocity_n_m: f64,
    /// m(π/t_c)².
    pub contact_time_n_m: f64,
    /// m(v₀/d)².
    pub velocity_over_compression_n_m: f64,
    /// m a/d.
    pub acceleration_over_compression_n_m: f64,
    /// 2E/d², E = ∫F dd during compression.
    pub energy_n_m: f64,
    /// F/d at the largest compression from the samples integrated twice, from the first touch that their own flank
    /// shows; `None` where the flank shows none.
    pub integrated_n_m: Option<f64>,
}

impl StiffnessEstimates {
    /// (largest − smallest)/mean of the four that use peak, time and compression.
    pub fn spread_ratio(&self) -> f64 {
        let four = [
            self.peak_over_velocity_n_m,
            self.contact_time_n_m,
            self.velocity_over_compression_n_m,
            self.acceleration_over_compression_n_m,
        ];
        let most = four.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = four.iter().copied().fold(f64::INFINITY, f64::min);
        4.0 * (most - least) / four.iter().sum::<f64>()
    }
}

/// One fitted law, for comparison.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The law.
    pub law: FittedLaw,
    /// Its secant at the largest compression \[N/m\].
    pub secant_n_m: f64,
    /// Exponent n.
    pub exponent: f64,
    /// Damping ratio ζ of Kelvin–Voigt, otherwise 0.
    pub damping_ratio: f64,
    /// Root mean square of the residuals divided by the peak.
    pub residual_ratio: f64,
    /// Sum of squares in units of the noise; a law with one more parameter must reduce it by 12 to
    /// be chosen.
    pub chi_squared: f64,
}

/// The identified law.
#[derive(Debug, Clone, PartialEq)]
pub struct Identified {
    /// Its kind.
    pub chosen: FittedLaw,
    /// The law with its numbers, ready for a [`crate::cushion::Cushion`].
    pub law: ContactLaw,
    /// The estimates of its stiffness.
    pub stiffness: StiffnessEstimates,
    /// Standard deviation of ln k: noise, zero line, impact velocity, the other laws that the samples
    /// allow and, where the record cannot decide, gravity.
    pub error_ratio: f64,
    /// Tangent at the origin dF/dd of the elastic part \[N/m\]; 0 for a power law, `None` where it is infinite (n < 1).
    pub initial_stiffness_n_m: Option<f64>,
    /// k₃ of a cubic law \[N/m³\].
    pub cubic_n_m3: Option<f64>,
    /// The corner of a low-pass filter that nobody stated but the pulse shows \[Hz\].
    pub filter_corner_hz: Option<f64>,
    /// Exponent n of the power law that fits best, even where the chosen law is linear.
    pub exponent: f64,
    /// Standard deviation of the exponent.
    pub exponent_error: Option<f64>,
    /// Exponent n from a d/v₀² = (n+1)/2.
    pub exponent_by_identity: f64,
    /// Damping ratio ζ; for laws other than Kelvin–Voigt that of the Kelvin–Voigt pad with the same
    /// restitution.
    pub damping_ratio: f64,
    /// The impact velocity of the best fit \[m/s\].
    pub fitted_velocity_m_s: f64,
    /// All fitted laws.
    pub candidates: Vec<Candidate>,
    /// Whether the weight acts during the contact; `false` where the record clearly shows that it
    /// does not.
    pub has_gravity: bool,
    /// Root mean square of the residuals divided by the peak.
    pub residual_ratio: f64,
}

/// One sample of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopPoint {
    /// Time since first contact \[s\].
    pub time_s: f64,
    /// Acceleration above the zero line \[m/s²\].
    pub acceleration_m_s2: f64,
    /// Force F = m a \[N\].
    pub force_n: f64,
    /// Compression d, from the double integral over the contact alone \[m\].
    pub compression_m: f64,
    /// Rate of compression ḋ \[m/s\].
    pub speed_m_s: f64,
}

/// The results of a drop test, as far as its record allows; missing ones are `None`.
#[derive(Debug, Clone, PartialEq)]
pub struct DropTest {
    /// Impact velocity v₀ \[m/s\].
    pub impact_velocity_m_s: Option<f64>,
    /// Peak above the zero line \[m/s²\].
    pub peak_acceleration_m_s2: Option<f64>,
    /// Time from first contact until the force is zero again \[s\].
    pub contact_time_s: Option<f64>,
    /// Largest compression \[m\].
    pub max_compression_m: Option<f64>,
    /// Restitution e, from the impulse.
    pub restitution_ratio: Option<f64>,
    /// Restitution e, from the flight to the next bounce: g t/(2v₀).
    pub restitution_bounce_ratio: Option<f64>,
    /// Energy lost in the loop divided by ½mv₀².
    pub energy_lost_ratio: Option<f64>,
    /// The law; `None` where a flag rules it out.
    pub identified: Option<Identified>,
    /// Contact time divided by the sampling interval.
    pub samples_per_contact: Option<f64>,
    /// (zero line after − before)/peak.
    pub zero_shift_ratio: Option<f64>,
    /// Standard deviation before the contact divided by the peak.
    pub noise_ratio: Option<f64>,
    /// The faults of the record.
    pub flags: Vec<Flag>,
    /// The loop, point by point.
    pub points: Vec<LoopPoint>,
}

#[cfg(test)]
mod pads;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod virtual_drops;
