//! The feet of a body that stands on the floor alone: they are all alike, so that those that stick
//! to it on springs and dashpots need a few sums together, however many they are.

use super::element::{Element, Grip};
use super::pose::{Flat, Pose};
use crate::compliant::pad::Pad;
use crate::space::{Vector, difference, turned};

/// The feet of the only body: the first elements of a world.
#[derive(Debug, Clone)]
pub(super) struct Feet<'a> {
    /// Their places on the base.
    points: Vec<[f64; 2]>,
    /// Height of all of them from the centre of gravity, and their largest distance from its axis.
    z: f64,
    reach: f64,
    pad: Pad<'a>,
    /// k and c of the law N = k d + c ḋ; `None` for other laws.
    linear: Option<[f64; 2]>,
    tangential_stiffness: f64,
    friction: Option<f64>,
    unit_m: f64,
    weight_n: f64,
}

/// The feet that stick, p from the centre of gravity and a the anchors of their springs: sums over
/// them of 1, p, ppᵀ, a and paᵀ, in the plane of the base.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stuck {
    count: f64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
    yy: f64,
    anchor: [f64; 2],
    x_anchor: [f64; 2],
    y_anchor: [f64; 2],
}

impl Stuck {
    pub(super) fn is_empty(&self) -> bool {
        self.count == 0.0
    }

    fn add(&mut self, [x, y]: [f64; 2], anchor: [f64; 2]) {
        self.count += 1.0;
        self.x += x;
        self.y += y;
        self.xx += x * x;
        self.xy += x * y;
        self.yy += y * y;
        for (axis, anchor) in anchor.into_iter().enumerate() {
            self.anchor[axis] += anchor;
            self.x_anchor[axis] += x * anchor;
            self.y_anchor[axis] += y * anchor;
        }
    }
}

/// What the feet that stick do to the body, in floor axes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Push {
    pub(super) force: Vector,
    /// About the centre of gravity.
    pub(super) torque: Vector,
    /// Power of their dashpots.
    pub(super) dissipated_w: f64,
}

impl<'a> Feet<'a> {
    /// The feet at `points` of the base, which is `z` from the centre of gravity; each is like
    /// `one`.
    pub(super) fn new(points: Vec<[f64; 2]>, z: f64, one: &Element<'a>) -> Self {
        Self {
            reach: points
                .iter()
                .map(|[x, y]| (x * x + y * y).sqrt())
                .fold(0.0, f64::max),
            points,
            z,
            pad: one.pad,
            linear: one.pad.linear(),
            tangential_stiffness: one.tangential_stiffness,
            friction: one.friction,
            unit_m: one.unit_m,
            weight_n: one.weight_n,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    /// The sums over the feet that stick, and the indices of those that carry otherwise.
    pub(super) fn sort(&self, grips: &[Grip], alone: &mut Vec<usize>) -> Stuck {
        let mut stuck = Stuck::default();
        for (index, (point, grip)) in self.points.iter().zip(grips).enumerate() {
            match grip {
                Grip::Stick { anchor } if self.linear.is_some() => stuck.add(*point, *anchor),
                Grip::Stick { .. } | Grip::Slip => alone.push(index),
                Grip::Open { .. } | Grip::Gone => {}
            }
        }
        stuck
    }

    /// What the feet that stick do to the body: with f = f₀ + Mp + k_t a of each, Σf and
    /// Σ(Qp) × f from Σ f pᵀ.
    #[inline(always)]
    pub(super) fn push(&self, stuck: &Stuck, pose: &Pose) -> Push {
        let [k, c] = self.linear.unwrap_or_default();
        let rising = pose.rising(self.z);
        let pulled =
            |axis: usize, stiffness: f64| pose.displacement(self.z, axis).times(-stiffness);
        let up = pulled(2, k).plus(rising.times(-c));
        let k_t = self.tangential_stiffness;
        let of = |flat: Flat, anchor: [f64; 3]| {
            let force =
                stuck.count * flat.at + (flat.x * stuck.x + flat.y * stuck.y) + k_t * anchor[0];
            let by_x =
                flat.at * stuck.x + (flat.x * stuck.xx + flat.y * stuck.xy) + k_t * anchor[1];
            let by_y =
                flat.at * stuck.y + (flat.x * stuck.xy + flat.y * stuck.yy) + k_t * anchor[2];
            (force, [by_x, by_y, self.z * force])
        };
        let anchors = |axis: usize| {
            [
                stuck.anchor[axis],
                stuck.x_anchor[axis],
                stuck.y_anchor[axis],
            ]
        };
        let (right, by_right) = of(pulled(0, k_t), anchors(0));
        let (back, by_back) = of(pulled(1, k_t), anchors(1));
        let (up, by_up) = of(up, [0.0; 3]);
        // Σ f (Qp)ᵀ.
        let turned = |by_place: Vector| turned(&pose.shift, &by_place);
        let (x, y, z) = (turned(by_right), turned(by_back), turned(by_up));
        let Flat { at, x: rx, y: ry } = rising;
        let squares = (rx * rx * stuck.xx + ry * ry * stuck.yy) + 2.0 * rx * ry * stuck.xy;
        Push {
            force: [right, back, up],
            torque: difference(&[z[1], x[2], y[0]], &[y[2], z[0], x[1]]),
            dissipated_w: c
                * (at * (stuck.count * at + 2.0 * (rx * stuck.x + ry * stuck.y)) + squares),
        }
    }

    /// No foot is higher above its unloaded cushion than this.
    pub(super) fn highest_m(&self, pose: &Pose) -> f64 {
        let Flat { at, x, y } = pose.displacement(self.z, 2);
        at + self.reach * (x * x + y * y).sqrt()
    }

    /// How far the feet are from their next event, if that is less than `least`: the least of both.
    /// `of` gives it for a foot that carries otherwise than on a spring and a dashpot that stick.
    pub(super) fn margin(
        &self,
        grips: &[Grip],
        (time_s, pose): (f64, &Pose),
        mut least: f64,
        of: impl Fn(usize) -> f64,
    ) -> f64 {
        let (right, back, up) = (
            pose.displacement(self.z, 0),
            pose.displacement(self.z, 1),
            pose.displacement(self.z, 2),
        );
        // How much longer a foot that sticks pushes ([`Pad::pushes`]), and its force as a share of the weight.
        let per_unit = 1.0 / self.unit_m;
        let (pushes, carried) = match self.linear {
            Some([k, c]) => {
                let carried = up
                    .times(-k / self.weight_n)
                    .plus(pose.rising(self.z).times(-c / self.weight_n));
                let pressed = up.times(-per_unit);
                (if c > 0.0 { carried } else { pressed }, carried)
            }
            None => (up, up),
        };
        for (index, (&point, grip)) in self.points.iter().zip(grips).enumerate() {
            let margin = match *grip {
                Grip::Gone => continue,
                Grip::Open {
                    since_s,
                    compression_m,
                } => {
                    // A surface that still recovers is no lower than the unloaded cushion.
                    let height = up.of(point);
                    if height * per_unit >= least {
                        continue;
                    }
                    (self.pad.surface(since_s, compression_m, time_s) + height) * per_unit
                }
                Grip::Stick { anchor } if self.linear.is_some() => match self.friction {
                    None => pushes.of(point),
                    Some(friction) => {
                        let (a, b) = (right.of(point) - anchor[0], back.of(point) - anchor[1]);
                        let tangential_n = self.tangential_stiffness * (a * a + b * b).sqrt();
                        let grips = friction * carried.of(point) - tangential_n / self.weight_n;
                        pushes.of(point).min(grips)
                    }
                },
                Grip::Stick { .. } | Grip::Slip => of(index),
            };
            least = least.min(margin);
        }
        least
    }

    /// Energy in the springs; those of feet that slip are counted with the slip.
    pub(super) fn stored_j(&self, grips: &[Grip], pose: &Pose) -> f64 {
        let (right, back, up) = (
            pose.displacement(self.z, 0),
            pose.displacement(self.z, 1),
            pose.displacement(self.z, 2),
        );
        let of = |(&point, grip): (&[f64; 2], &Grip)| {
            let sheared_j = match grip {
                Grip::Open { .. } | Grip::Gone => return 0.0,
                Grip::Slip => 0.0,
                Grip::Stick { anchor } => {
                    let (a, b) = (right.of(point) - anchor[0], back.of(point) - anchor[1]);
                    0.5 * self.tangential_stiffness * (a * a + b * b)
                }
            };
            sheared_j + self.pad.pressed_j(-up.of(point))
        };
        self.points.iter().zip(grips).map(of).sum()
    }
}
