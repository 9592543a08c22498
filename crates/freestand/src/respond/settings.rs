//! How objects are followed, whatever they are.

use crate::G0_M_S2;
use crate::compliant::{CompliantAccuracy, CompliantOptions};
use crate::motion::Motion;
use crate::rocking::{Accuracy, LONGEST_TAIL_S, Restitution, RockingModel, RockingOptions, Until};
use crate::sliding::{Clearance, Friction, SlidingOptions};
use crate::spatial::SpatialOptions;
use crate::wall::Walls;

/// How objects are followed, whatever they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The equation of motion on a rigid base.
    pub model: RockingModel,
    /// Accuracy on a rigid base.
    pub accuracy: Accuracy,
    /// Accuracy on pads, but for the kernel of [`Springs`](super::Springs), which has its own.
    pub on_pads: CompliantAccuracy,
    /// g \[m/s²\].
    pub gravity_m_s2: f64,
    /// When a history ends.
    pub until: Until,
}

/// On pads the accuracy is [`CompliantAccuracy::Fast`]. In space single histories differ from those
/// at `Standard`, distributions do not: of 40 pairs of motions a square cabinet falls in 14 against
/// 16, a bookshelf in 30 against 31, and the median tilt of the cabinet is 0.260 against 0.273; it
/// takes half of the time.
impl Default for Settings {
    fn default() -> Self {
        Self {
            model: RockingModel::default(),
            accuracy: Accuracy::default(),
            on_pads: CompliantAccuracy::Fast,
            gravity_m_s2: G0_M_S2,
            until: Until::Settled {
                at_most_s: LONGEST_TAIL_S,
            },
        }
    }
}

impl Settings {
    /// On a rigid base, from rest.
    pub fn rocking(&self, restitution: Restitution, walls: Walls) -> RockingOptions {
        RockingOptions {
            model: self.model,
            restitution,
            gravity_m_s2: self.gravity_m_s2,
            accuracy: self.accuracy,
            until: self.until,
            walls,
            ..RockingOptions::default()
        }
    }

    pub(super) fn sliding(&self, friction: Friction, clearance: Clearance) -> SlidingOptions {
        SlidingOptions {
            friction,
            clearance,
            gravity_m_s2: self.gravity_m_s2,
            until: self.until,
        }
    }

    pub(super) fn compliant(&self, motion: Option<&Motion>) -> CompliantOptions {
        CompliantOptions {
            gravity_m_s2: self.gravity_m_s2,
            accuracy: self.on_pads,
            duration_s: self.duration_s(motion),
            ..CompliantOptions::default()
        }
    }

    pub(super) fn spatial(&self, motion: Option<&Motion>) -> SpatialOptions {
        SpatialOptions {
            gravity_m_s2: self.gravity_m_s2,
            accuracy: self.on_pads,
            duration_s: self.duration_s(motion),
            ..SpatialOptions::default()
        }
    }

    /// What a solver on pads is told; `None`: it goes on until everything is at rest or down.
    pub(super) fn duration_s(&self, motion: Option<&Motion>) -> Option<f64> {
        match self.until {
            Until::EndOfMotion => motion.map(Motion::duration_s),
            Until::Time(duration_s) => Some(duration_s),
            Until::Settled { .. } => None,
        }
    }
}
