//! Why it is not known what an object does.

use thiserror::Error;

use crate::compliant::CompliantError;
use crate::hull::HullError;
use crate::rocking::RockingError;
use crate::sliding::SlidingError;

/// Why it is not known what an object does.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RespondError {
    /// On a rigid base.
    #[error(transparent)]
    Rocking(#[from] RockingError),
    /// While it rolls or slides.
    #[error(transparent)]
    Sliding(#[from] SlidingError),
    /// On pads.
    #[error(transparent)]
    Compliant(#[from] CompliantError),
    /// On the points of its hull.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// More samples than a history may have.
    #[error("a history of {end_s} s at steps of {dt_s} s is too long")]
    TooLong {
        /// Its end, at the latest \[s\].
        end_s: f64,
        /// Its step \[s\].
        dt_s: f64,
    },
}

impl RespondError {
    /// Whether the floor falls away, and the object flies: what no rigid base can follow.
    pub fn is_flight(&self) -> bool {
        matches!(self, Self::Rocking(RockingError::FreeFlight { .. }))
    }
}
