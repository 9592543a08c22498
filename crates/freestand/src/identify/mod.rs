//! From a test of a cushion to its law: drop tests, repeats, static tests, and virtual tests to practise on.
//!
//! In a drop test a rigid mass falls on a pad and carries an accelerometer. [`drop_test`] finds the contact, its zero line
//! and what is wrong with the record, and lays the pulse of each law through the samples; four textbook estimates and
//! the exponent identity stand beside the fit. What cannot be trusted has flags and no stiffness.
//!
//! **Signs**: accelerations are positive upward. The zero line is the mean before the contact, where the mass falls
//! freely: above it the reading is force over mass, whatever the coupling of the sensor.

mod contact;
mod drop;
mod fit;
mod model;
mod pool;
mod static_curve;
mod virtual_laboratory;

pub use drop::drop_test;
pub use pool::{NORMAL_975, Pooled, PooledDrop, pool_drops};
pub use static_curve::{StaticError, StaticOptions, StaticTest, static_test};
pub use virtual_laboratory::{VirtualDrop, VirtualDropOptions, VirtualStaticOptions, virtual_drop, virtual_static};

use thiserror::Error;

use crate::cushion::ContactLaw;

/// Which law is laid through a drop test.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FittedLaw {
    /// F = k d.
    Linear,
    /// F = K dⁿ.
    Power,
    /// F = k d + c ḋ.
    KelvinVoigt,
    /// F = K dⁿ (1 + Λḋ).
    HuntCrossley,
    /// F = K dⁿ + c ḋ: for the exponent of a damped pad, never chosen.
    DampedPower,
}

impl FittedLaw {
    /// The name in flags, files and outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Power => "power",
            Self::KelvinVoigt => "kelvin-voigt",
            Self::HuntCrossley => "hunt-crossley",
            Self::DampedPower => "damped-power",
        }
    }
}

/// What is wrong with a drop test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Flag {
    /// Nothing stands out of the noise.
    NoPulse,
    /// The largest excursion is downward.
    UpsideDown,
    /// Too few samples before the contact for a zero line.
    NoPreTrigger,
    /// The record ends within the contact.
    CutOff,
    /// The top of the pulse is flat.
    Clipped,
    /// Fewer than 25 samples per contact.
    FewSamples,
    /// The zero line after the contact is another one, by more than 0.5 % of the peak.
    ZeroShift,
    /// The zero line drifts by more than 0.5 % of the peak.
    Drift,
    /// The low-pass corner times the contact time is below 3.
    Filter,
    /// The pulse takes less than m v₀, or gives back more than it took.
    Impulse,
    /// The impact velocity that fits differs from the stated one.
    Velocity,
    /// The damped law that was asked for fits with negative damping alone; it is reported with none.
    Damping,
    /// No law lies on the samples.
    PoorFit,
}

impl Flag {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::NoPulse => "no-pulse",
            Self::UpsideDown => "upside-down",
            Self::NoPreTrigger => "no-pre-trigger",
            Self::CutOff => "cut-off",
            Self::Clipped => "clipped",
            Self::FewSamples => "few-samples",
            Self::ZeroShift => "zero-shift",
            Self::Drift => "drift",
            Self::Filter => "filter",
            Self::Impulse => "impulse",
            Self::Velocity => "velocity",
            Self::Damping => "damping",
            Self::PoorFit => "poor-fit",
        }
    }

    /// What it means, and what to do about it.
    pub fn remedy(self) -> &'static str {
        match self {
            Self::NoPulse => "no pulse stands out of the noise: check the column, the unit and the trigger",
            Self::UpsideDown => "the pulse points down: turn the sign if the sensor is mounted upside down",
            Self::NoPreTrigger => "too few samples before the contact for a zero line: set a longer pre-trigger",
            Self::CutOff => "the record ends before the contact does: record longer",
            Self::Clipped => "the top of the pulse is flat: use a larger range of the sensor or a lower drop",
            Self::FewSamples => "fewer than 25 samples per contact: sample faster",
            Self::ZeroShift => {
                "the zero line after the contact is another one: check the cable and the sensor's mounting"
            }
            Self::Drift => "the zero line drifts: let the sensor settle, or check its coupling and temperature",
            Self::Filter => "the low-pass corner is below 3 over the contact time: raise it, it takes from the peak",
            Self::Impulse => {
                "the impulse of the pulse does not fit the mass at this speed: check unit, mass and drop height"
            }
            Self::Velocity => "the pulse fits another impact velocity than the stated one: check height and guides",
            Self::Damping => {
                "the pulse gives back more than it took, so the damping is reported as none: check the zero line and the \
                 velocity, or leave the law open"
            }
            Self::PoorFit => "no law lies on the samples: look at the loop; is the pad bottoming, the plate tilting?",
        }
    }
}

/// Where the impact velocity comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ImpactVelocity {
    /// From a height or a light gate, with a standard deviation of its own \[–\].
    Known {
        /// v₀ \[m/s\].
        speed_m_s: f64,
        /// Relative standard deviation.
        error_ratio: f64,
    },
    /// From the pulse alone: the halves of the impulse before and after the deepest point, as the law divides them.
    FromImpulse,
}

/// What is known about a drop test beside its record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropSetup {
    /// Mass that falls \[kg\].
    pub mass_kg: f64,
    /// Its speed at the first touch.
    pub impact_velocity: ImpactVelocity,
    /// Gravity during the contact \[m/s²\].
    pub gravity_m_s2: f64,
    /// Corner of the low-pass filter before the converter \[Hz\].
    pub filter_corner_hz: Option<f64>,
    /// This law and no other.
    pub law: Option<FittedLaw>,
}

/// Why a record is no drop test.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum DropError {
    /// A number is not what it must be.
    #[error("the {name} must be positive, not {value}")]
    NotPositive {
        /// The number.
        name: &'static str,
        /// What it is.
        value: f64,
    },
    /// Too short for anything.
    #[error("{samples} samples are no drop test")]
    TooShort {
        /// How many there are.
        samples: usize,
    },
    /// A sample is no number.
    #[error("sample {number} is not a number")]
    NotFinite {
        /// The sample, from 1.
        number: usize,
    },
}

/// Stiffness by six ways \[N/m\]; for F = kd all agree, and their spread is the measure of the test.
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
    /// 2E/d², E = ∫F dd on the way in.
    pub energy_n_m: f64,
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

/// One law as it was fitted, for comparison.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The law.
    pub law: FittedLaw,
    /// Its secant at the largest compression \[N/m\].
    pub secant_n_m: f64,
    /// n.
    pub exponent: f64,
    /// ζ of Kelvin–Voigt, otherwise 0.
    pub damping_ratio: f64,
    /// What is left, root mean square over the peak.
    pub residual_ratio: f64,
    /// Sum of squares over the noise; a law with one more number must gain 12 to be chosen.
    pub chi_squared: f64,
}

/// The law that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Identified {
    /// Which.
    pub chosen: FittedLaw,
    /// With its numbers, ready for a [`crate::cushion::Cushion`].
    pub law: ContactLaw,
    /// Six stiffnesses.
    pub stiffness: StiffnessEstimates,
    /// Standard deviation of ln k: noise, zero line, impact velocity and, where the record cannot tell, gravity.
    pub error_ratio: f64,
    /// n of the power law that fits best, also where the chosen one is linear.
    pub exponent: f64,
    /// Its standard deviation.
    pub exponent_error: Option<f64>,
    /// n by a d/v₀² = (n+1)/2.
    pub exponent_by_identity: f64,
    /// ζ; of laws other than Kelvin–Voigt that of the linear pad with the same restitution.
    pub damping_ratio: f64,
    /// The impact velocity that fits best \[m/s\].
    pub fitted_velocity_m_s: f64,
    /// All laws.
    pub candidates: Vec<Candidate>,
    /// Whether the weight acts during the contact; `false` where the record says clearly that it does not.
    pub has_gravity: bool,
    /// Root mean square of what is left, over the peak.
    pub residual_ratio: f64,
}

/// One sample of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopPoint {
    /// Since the first touch \[s\].
    pub time_s: f64,
    /// Above the zero line \[m/s²\].
    pub acceleration_m_s2: f64,
    /// F = m a \[N\].
    pub force_n: f64,
    /// d, by integrating twice over the contact \[m\].
    pub compression_m: f64,
    /// ḋ \[m/s\].
    pub speed_m_s: f64,
}

/// A drop test as far as its record goes; what is missing is `None`.
#[derive(Debug, Clone, PartialEq)]
pub struct DropTest {
    /// v₀ \[m/s\].
    pub impact_velocity_m_s: Option<f64>,
    /// Peak above the zero line \[m/s²\].
    pub peak_acceleration_m_s2: Option<f64>,
    /// From the first touch until the force is back at zero \[s\].
    pub contact_time_s: Option<f64>,
    /// Largest compression \[m\].
    pub max_compression_m: Option<f64>,
    /// e, from the impulse.
    pub restitution_ratio: Option<f64>,
    /// e, from the flight to the next bounce: g t/(2v₀).
    pub restitution_bounce_ratio: Option<f64>,
    /// Energy lost in the loop over ½mv₀².
    pub energy_lost_ratio: Option<f64>,
    /// The law; `None` where a flag forbids it.
    pub identified: Option<Identified>,
    /// Contact time over the sampling interval.
    pub samples_per_contact: Option<f64>,
    /// (zero line after − before)/peak.
    pub zero_shift_ratio: Option<f64>,
    /// Standard deviation before the contact over the peak.
    pub noise_ratio: Option<f64>,
    /// What is wrong.
    pub flags: Vec<Flag>,
    /// The loop.
    pub points: Vec<LoopPoint>,
}

#[cfg(test)]
mod tests;
