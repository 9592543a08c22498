//! What counts in decisions: how an object ended, in the worse of its planes.

use crate::hull::shake::{HullOutcome, HullRocking};
use crate::rocking::Outcome as Rocking;

use super::glide::Glide;
use super::object::Planes;

/// How an object ended, in the worse of its planes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Outcome {
    /// No edge lifted, and it stayed where it was.
    Stood,
    /// An edge lifted, and it did not fall.
    Rocked {
        /// Largest uplift of an edge \[m\].
        uplift_m: f64,
    },
    /// It rolled on its casters, or its stop tripped it.
    Rolled(Travelled),
    /// It slid on its base, or its stop tripped it.
    Slid(Travelled),
    /// It ended leaning on a wall.
    Leaned,
    /// It fell.
    Overturned,
    /// It is neither at rest nor down at the end of its history.
    Unresolved,
}

/// How an object rolled or slid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Travelled {
    /// The largest way from where it stood, as if nothing were in the way \[m\].
    pub travel_m: f64,
    /// What it needs free on every side of it \[m\].
    pub room_m: f64,
    /// Speed at which it reached its stop; `None`: it did not \[m/s\].
    pub stop_speed_m_s: Option<f64>,
    /// Whether one component of the floor is all that is known, so that it went farther.
    pub is_at_least: bool,
    /// Whether the stop overturned it.
    pub has_tripped: bool,
}

/// A point of an elastic base that rises no more than this has not lifted \[m\]: its contacts sink by up to
/// 0.5 mm.
const LIFTED_M: f64 = 1e-3;

impl Outcome {
    /// Of an object that rocks, from how it ended in each plane and the uplift there \[m\].
    pub(super) fn of(planes: impl Iterator<Item = (Rocking, f64)> + Clone) -> Self {
        let ends = |outcome: Rocking| planes.clone().any(|one| one.0 == outcome);
        if ends(Rocking::Overturned) {
            Self::Overturned
        } else if ends(Rocking::Unresolved) {
            Self::Unresolved
        } else if ends(Rocking::Leaned) {
            Self::Leaned
        } else if ends(Rocking::Rocked) {
            Self::Rocked {
                uplift_m: planes.map(|one| one.1).fold(0.0, f64::max),
            }
        } else {
            Self::Stood
        }
    }

    /// Of a body on its hull: one that rests in another pose has fallen, and so has one that does not stand even
    /// before the floor moves.
    pub fn on_hull(body: &HullRocking) -> Self {
        match body.outcome {
            HullOutcome::Overturned | HullOutcome::Shifted(_) | HullOutcome::Unsettled => {
                Self::Overturned
            }
            HullOutcome::Leaned => Self::Leaned,
            HullOutcome::Unresolved => Self::Unresolved,
            HullOutcome::Stood if body.uplift_m > LIFTED_M => Self::Rocked {
                uplift_m: body.uplift_m,
            },
            HullOutcome::Stood => Self::Stood,
        }
    }

    /// How it rolled or slid; `None`: it rocks.
    pub fn travelled(self) -> Option<Travelled> {
        match self {
            Self::Rolled(way) | Self::Slid(way) => Some(way),
            Self::Stood
            | Self::Rocked { .. }
            | Self::Leaned
            | Self::Overturned
            | Self::Unresolved => None,
        }
    }

    /// Largest uplift of an edge, 0 where none lifted; `None`: it fell, or may still \[m\].
    pub fn uplift_m(self) -> Option<f64> {
        match self {
            Self::Rocked { uplift_m } => Some(uplift_m),
            Self::Leaned | Self::Overturned | Self::Unresolved => None,
            Self::Rolled(way) | Self::Slid(way) => (!way.has_tripped).then_some(0.0),
            Self::Stood => Some(0.0),
        }
    }

    /// Whether it has fallen over, onto the floor or against a wall: what counts in decisions.
    /// `None`: it may still fall.
    pub fn has_fallen(self) -> Option<bool> {
        match self {
            Self::Leaned | Self::Overturned => Some(true),
            Self::Rolled(way) | Self::Slid(way) => Some(way.has_tripped),
            Self::Stood | Self::Rocked { .. } => Some(false),
            Self::Unresolved => None,
        }
    }
}

impl Travelled {
    /// In all planes together.
    pub(super) fn of(planes: &Planes<Glide>) -> Self {
        let speeds_m_s = planes.iter().filter_map(|one| one.stop_speed_m_s);
        Self {
            travel_m: planes.iter().map(|one| one.travel_m).fold(0.0, f64::max),
            room_m: planes.iter().map(|one| one.room_m).fold(0.0, f64::max),
            stop_speed_m_s: speeds_m_s.reduce(f64::max),
            is_at_least: planes.iter().any(|one| one.is_at_least),
            has_tripped: planes.iter().any(|one| one.has_tripped),
        }
    }
}
