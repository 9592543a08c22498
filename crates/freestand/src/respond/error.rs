//! Why it is not known what an object does.

use thiserror::Error;

use crate::compliant::CompliantError;
use crate::rocking::{Outcome, RockingError};
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
    /// Its history ended before it was certain what becomes of it.
    #[error("the object is neither at rest nor down long after the motion")]
    Unresolved,
}

impl RespondError {
    /// Whether the floor falls away, and the object flies: what no rigid base can follow.
    pub fn is_flight(&self) -> bool {
        matches!(self, Self::Rocking(RockingError::FreeFlight { .. }))
    }
}

/// An error where a history ended before it was certain what becomes of the object.
pub(super) fn resolved(outcome: Outcome) -> Result<(), RespondError> {
    if outcome == Outcome::Unresolved {
        Err(RespondError::Unresolved)
    } else {
        Ok(())
    }
}
