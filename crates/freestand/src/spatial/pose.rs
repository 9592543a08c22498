//! The position and velocity of a body, and where the state has them.

use crate::space::{Shift, Turn, UPRIGHT, Vector, cross, moved, shift, sum, turned};

// Indices into the state of one body: displacement of the centre of gravity relative to the base
// and to its position upright above unloaded cushions, velocity, rotation, angular velocity in body
// axes.
pub(super) const PLACE: usize = 0;
pub(super) const VELOCITY: usize = 3;
pub(super) const TURN: usize = 6;
pub(super) const SPIN: usize = 10;
/// Entries of one body.
pub(super) const BODY: usize = 13;

/// The position and velocity of a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    pub(super) place: Vector,
    pub(super) velocity: Vector,
    pub(super) turn: Turn,
    /// Q − I.
    pub(super) shift: Shift,
    /// Angular velocity in floor axes.
    pub(super) omega: Vector,
}

impl Pose {
    pub(super) const STILL: Self = Self {
        place: [0.0; 3],
        velocity: [0.0; 3],
        turn: UPRIGHT,
        shift: [[0.0; 3]; 3],
        omega: [0.0; 3],
    };

    pub(super) fn at(y: &[f64]) -> Self {
        let turn = [y[TURN], y[TURN + 1], y[TURN + 2], y[TURN + 3]];
        let shift = shift(&turn);
        Self {
            place: vector(y, PLACE),
            velocity: vector(y, VELOCITY),
            turn,
            shift,
            omega: turned(&shift, &vector(y, SPIN)),
        }
    }

    /// Displacement and velocity of a point of the body.
    pub(super) fn point(&self, from_cg: &Vector) -> (Vector, Vector) {
        let by_turn = moved(&self.shift, from_cg);
        let arm = sum(from_cg, &by_turn);
        (
            sum(&self.place, &by_turn),
            sum(&self.velocity, &cross(&self.omega, &arm)),
        )
    }

    /// The axis of the body that is vertical at rest, and its rate.
    pub(super) fn axis(&self) -> (Vector, Vector) {
        let [x, y, z] = self.shift;
        let axis = [x[2], y[2], 1.0 + z[2]];
        (axis, cross(&self.omega, &axis))
    }

    /// The vertical part of that axis.
    pub(super) fn upright(&self) -> f64 {
        1.0 + self.shift[2][2]
    }
}

pub(super) fn vector(y: &[f64], at: usize) -> Vector {
    [y[at], y[at + 1], y[at + 2]]
}
