//! The elements: points that are pressed against a face, and how each of them holds on.

use super::pose::Pose;
use crate::compliant::pad::Pad;
use crate::space::{Vector, sum};

/// A body, or the base (`None`).
pub(super) type Owner = Option<usize>;

/// A point that is pressed against a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element<'a> {
    /// The body with the point; its place from the centre of gravity, or on the base.
    pub(super) point_of: Owner,
    pub(super) point: Vector,
    /// The radius of a rim about `point`, of which the point nearest to the face is pressed; 0 for a point.
    pub(super) rim_m: f64,
    /// The body with the face; the axis (0 to 2) of that body that is normal to it, and +1 where
    /// the face looks along the axis.
    pub(super) face_of: Owner,
    pub(super) normal: usize,
    pub(super) sign: f64,
    /// Distance of `point` from the face when all bodies are upright above unloaded cushions.
    pub(super) gap: f64,
    /// The face ends at this distance from the centre of gravity along this axis.
    pub(super) end: Option<(usize, f64)>,
    pub(super) pad: Pad<'a>,
    /// 0: a smooth face.
    pub(super) tangential_stiffness: f64,
    /// `None`: no slip.
    pub(super) friction: Option<f64>,
    /// Index of the direction of its stretch; meaningless without friction.
    pub(super) slot: usize,
    /// Units of its compression and force.
    pub(super) unit_m: f64,
    pub(super) weight_n: f64,
    pub(super) role: Role,
}

impl Element<'_> {
    /// The point that is pressed, in the axes of its body at this pose, and its distance from the face when
    /// everything is upright. Of a rim about the axis of its body it is the point nearest to the face, against
    /// the normal n: −r Qᵀn, without its part along the axis, over √(1 − n_z²).
    pub(super) fn pressed(&self, pose: &Pose) -> (Vector, f64) {
        if self.rim_m == 0.0 {
            return (self.point, self.gap);
        }
        let mut row = pose.shift[self.normal];
        row[self.normal] += 1.0;
        let out = row[0].hypot(row[1]).max(f64::MIN_POSITIVE);
        let [x, y] = [row[0], row[1]].map(|part| -self.sign * self.rim_m * part / out);
        let point = sum(&self.point, &[x, y, 0.0]);
        (
            point,
            self.gap + self.sign * (point[self.normal] - self.point[self.normal]),
        )
    }
}

/// What an element is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// A cushion on the floor.
    Base,
    /// Between two bodies.
    Interface,
    /// A wall.
    Wall,
}

/// The state of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Grip {
    /// No contact; its surface recovers from `compression_m`, at which a damped cushion was left at
    /// `since_s`.
    Open { since_s: f64, compression_m: f64 },
    /// In contact; its spring is anchored at this place on the face.
    Stick { anchor: [f64; 2] },
    /// In contact; its foot slides. The direction of its spring is part of the state.
    Slip,
    /// The point has left the face past its end, and does not return.
    Gone,
}

impl Grip {
    pub(super) const UNTOUCHED: Self = Self::Open {
        since_s: 0.0,
        compression_m: 0.0,
    };

    pub(super) fn carries(self) -> bool {
        matches!(self, Self::Stick { .. } | Self::Slip)
    }
}
