//! A block that slides, or rolls on casters, without rocking: exact between the samples of the
//! motion.
//!
//! ẍ = −ü_h − μ_k (g+ü_v) sgn ẋ, where x is the slide, relative to the floor and positive to the
//! right. At ẋ = 0 the block sticks where |ü_h| ≤ μ_s (g+ü_v); otherwise it slides on towards
//! −sgn ü_h. The base acceleration is linear between the samples of the motion, so ẋ is a quadratic
//! and x a cubic in time: stops are roots in closed form, and nothing is stepped.
//!
//! The model holds for μ_s ≤ t/h ([`Friction::is_below_uplift`]): such a block slides before an edge
//! lifts, and the friction of a sliding block cannot lift the edge either. More friction is the
//! subject of [`crate::compliant`]. On casters the coefficient is the rolling resistance, for both
//! μ_s and μ_k.
//!
//! Event rules:
//! * **Onset** from rest where |ü_h| > μ_s (g+ü_v), at the instant at which the straight line
//!   between two samples passes that threshold. With μ_k < μ_s the acceleration jumps there.
//! * **Stop** at ẋ = 0, where the block sticks, or turns back without a pause.
//! * **Clearance**: the first time at which the slide reaches the clearance of the side towards
//!   which the block moves. The calculation goes on as if nothing were in the way.
//! * **Free flight** where g + ü_v ≤ 0: the history ends, with [`SlidingOutcome::FreeFlight`].
//!
//! # Reference
//! Shenton (1996), J. Eng. Mech. 122, 690.
//!
//! # Accuracy
//! Rounding: 1e-8 of the slide, times the amplification of an error of the motion, is kept with a
//! wide margin against histories that were solved in 160-bit arithmetic (`validation/sliding`).

mod friction;
mod plane;
mod solve;
#[cfg(test)]
mod tests;

use thiserror::Error;

use crate::G0_M_S2;
use crate::rocking::{RockingError, Until};

pub use friction::{Friction, trip_speed_m_s};
pub use plane::{PlaneMotion, PlanePoint, PlaneSliding, slide_in_plane, slide_in_plane_observed};
pub use solve::{SlidingPiece, slide, slide_observed};

/// The room beside a block: how far it may slide to each side \[m\]; `None` where nothing is in the
/// way.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Clearance {
    /// To the left, ≥ 0.
    pub left_m: Option<f64>,
    /// To the right, ≥ 0.
    pub right_m: Option<f64>,
}

/// Everything that the slide of a block depends on, except for the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingOptions {
    /// Friction, or rolling resistance.
    pub friction: Friction,
    /// The room on both sides.
    pub clearance: Clearance,
    /// g \[m/s²\].
    pub gravity_m_s2: f64,
    /// When to stop; `Settled` waits until the block sticks.
    pub until: Until,
}

impl SlidingOptions {
    /// Standard gravity, no obstacles, until the end of the motion.
    pub fn new(friction: Friction) -> Self {
        let (clearance, until) = (Clearance::default(), Until::default());
        Self {
            friction,
            clearance,
            gravity_m_s2: G0_M_S2,
            until,
        }
    }

    /// Whether gravity and clearances are numbers that the model can use.
    ///
    /// # Errors
    /// They are not.
    pub fn check(&self) -> Result<(), SlidingError> {
        let gravity_m_s2 = self.gravity_m_s2;
        if !(gravity_m_s2 > 0.0 && gravity_m_s2.is_finite()) {
            return Err(RockingError::Gravity { gravity_m_s2 }.into());
        }
        let given = [self.clearance.left_m, self.clearance.right_m];
        match given
            .into_iter()
            .flatten()
            .find(|m| !(*m >= 0.0 && m.is_finite()))
        {
            Some(clearance_m) => Err(SlidingError::Clearance { clearance_m }),
            None => Ok(()),
        }
    }
}

/// How a history ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SlidingOutcome {
    /// The block stuck throughout.
    Stuck,
    /// It slid.
    Slid,
    /// g + ü_v ≤ 0: the block left the floor, and the history ended there.
    FreeFlight,
}

impl SlidingOutcome {
    /// The name in every output: `no-uplift` for a block that stuck, `slid`, `free-flight`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stuck => "no-uplift",
            Self::Slid => "slid",
            Self::FreeFlight => crate::rocking::FREE_FLIGHT,
        }
    }
}

/// The slide of a block under a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sliding {
    /// How it ended.
    pub outcome: SlidingOutcome,
    /// Time at which the history ended \[s\].
    pub end_time_s: f64,
    /// The slide that is largest by magnitude, signed \[m\].
    pub peak_m: f64,
    /// Its time \[s\].
    pub peak_time_s: Option<f64>,
    /// x at the end \[m\].
    pub final_m: f64,
    /// ẋ at the end \[m/s\].
    pub final_velocity_m_s: f64,
    /// Length of the path, ∫|ẋ| dt \[m\].
    pub path_m: f64,
    /// Largest |ẋ| \[m/s\].
    pub speed_max_m_s: f64,
    /// Number of onsets from rest; turning back without a pause is not one.
    pub slide_count: usize,
    /// Time of the first onset \[s\].
    pub first_slide_time_s: Option<f64>,
    /// Time at which the block first reached a clearance, and ẋ there, signed \[s, m/s\].
    pub contact: Option<(f64, f64)>,
}

/// Why a slide cannot be calculated.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SlidingError {
    /// A coefficient that is negative or not finite, or μ_k > μ_s.
    #[error(
        "the coefficients of friction must be at least 0, and the kinetic one at most the static one, not \
         {kinetic_ratio} (kinetic) and {static_ratio} (static)"
    )]
    Friction {
        /// μ_s.
        static_ratio: f64,
        /// μ_k.
        kinetic_ratio: f64,
    },
    /// A clearance that is negative or not finite.
    #[error("a clearance must be at least 0 m and finite, not {clearance_m} m")]
    Clearance {
        /// The clearance that was given \[m\].
        clearance_m: f64,
    },
    /// Gravity, duration or motions that no history accepts.
    #[error(transparent)]
    Base(#[from] RockingError),
}
