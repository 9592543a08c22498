//! The position and velocity of a body, and where the state has them.

use crate::space::{Shift, Turn, UPRIGHT, Vector, cross, dot, moved, shift, sum, turned};

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

    #[inline]
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
    #[inline]
    pub(super) fn point(&self, from_cg: &Vector) -> (Vector, Vector) {
        let by_turn = moved(&self.shift, from_cg);
        let arm = sum(from_cg, &by_turn);
        (
            sum(&self.place, &by_turn),
            sum(&self.velocity, &cross(&self.omega, &arm)),
        )
    }

    /// The axis of the body that is vertical at rest, and its rate.
    #[inline]
    pub(super) fn axis(&self) -> (Vector, Vector) {
        let [x, y, z] = self.shift;
        let axis = [x[2], y[2], 1.0 + z[2]];
        (axis, cross(&self.omega, &axis))
    }

    /// The vertical part of that axis.
    #[inline]
    pub(super) fn upright(&self) -> f64 {
        1.0 + self.shift[2][2]
    }
}

/// A quantity of a point of the base as a function of its place p on it: at + x p_x + y p_y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flat {
    pub(super) at: f64,
    pub(super) x: f64,
    pub(super) y: f64,
}

impl Flat {
    #[inline]
    pub(super) fn of(self, [x, y]: [f64; 2]) -> f64 {
        // In this order nothing changes if x and y are swapped.
        self.at + (self.x * x + self.y * y)
    }

    /// The largest value up to this distance from the axis.
    #[inline]
    pub(super) fn most_within(self, reach: f64) -> f64 {
        self.at + reach * (self.x * self.x + self.y * self.y).sqrt()
    }

    /// [`Flat::least`] of four.
    pub(super) fn least_of(planes: [Self; 4], points: &[[f64; 2]]) -> [f64; 4] {
        let (xs, ys) = (planes.map(|plane| plane.x), planes.map(|plane| plane.y));
        let mut least = [f64::INFINITY; 4];
        for [x, y] in points {
            for lane in 0..4 {
                let value = xs[lane] * x + ys[lane] * y;
                least[lane] = if value < least[lane] {
                    value
                } else {
                    least[lane]
                };
            }
        }
        std::array::from_fn(|lane| planes[lane].at + least[lane])
    }

    /// The least value at these places; infinite without any.
    pub(super) fn least(self, points: &[[f64; 2]]) -> f64 {
        // In lanes, so that it is calculated in vectors.
        let mut least = [f64::INFINITY; 4];
        let (blocks, rest) = points.as_chunks::<4>();
        for block in blocks {
            for (least, [x, y]) in least.iter_mut().zip(block) {
                let value = self.x * x + self.y * y;
                *least = if value < *least { value } else { *least };
            }
        }
        let rest = rest.iter().map(|[x, y]| self.x * x + self.y * y);
        self.at + least.into_iter().chain(rest).fold(f64::INFINITY, f64::min)
    }

    #[inline]
    pub(super) fn times(self, factor: f64) -> Self {
        Self {
            at: factor * self.at,
            x: factor * self.x,
            y: factor * self.y,
        }
    }

    #[inline]
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            at: self.at + other.at,
            x: self.x + other.x,
            y: self.y + other.y,
        }
    }
}

impl Pose {
    /// Displacement of the points at the height `z` from the centre of gravity, along an axis of the floor.
    #[inline]
    pub(super) fn displacement(&self, z: f64, axis: usize) -> Flat {
        let row = &self.shift[axis];
        Flat {
            at: self.place[axis] + z * row[2],
            x: row[0],
            y: row[1],
        }
    }

    /// Upward velocity of these points: v + ω × Qp.
    #[inline]
    pub(super) fn rising(&self, z: f64) -> Flat {
        let [[_, xy, xz], [yx, _, yz], _] = self.shift;
        let (xx, yy) = (1.0 + self.shift[0][0], 1.0 + self.shift[1][1]);
        let [x, y, _] = self.omega;
        Flat {
            at: self.velocity[2] + z * (x * yz - y * xz),
            x: x * yx - y * xx,
            y: x * yy - y * xy,
        }
    }

    /// Upward acceleration of these points, relative to the base: v̇ + ω̇ × Qp + ω × (ω × Qp), with the rates of the
    /// state of the body.
    #[inline]
    pub(super) fn lifting(&self, z: f64, rates: &[f64]) -> Flat {
        let [[_, xy, xz], [yx, _, yz], [zx, zy, _]] = self.shift;
        let (xx, yy) = (1.0 + self.shift[0][0], 1.0 + self.shift[1][1]);
        let zz = 1.0 + self.shift[2][2];
        let omega = &self.omega;
        let [a, b, _] = turned(&self.shift, &vector(rates, SPIN));
        let square = dot(omega, omega);
        let of = |arm: Vector| {
            (a * arm[1] - b * arm[0]) + (omega[2] * dot(omega, &arm) - square * arm[2])
        };
        Flat {
            at: rates[VELOCITY + 2] + z * of([xz, yz, zz]),
            x: of([xx, yx, zx]),
            y: of([xy, yy, zy]),
        }
    }
}

#[inline]
pub(super) fn vector(y: &[f64], at: usize) -> Vector {
    [y[at], y[at + 1], y[at + 2]]
}
