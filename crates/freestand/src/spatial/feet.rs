//! The feet of the lowest body: they are all alike, so that those that stick
//! to it on springs and dashpots need a few sums together, however many they are.

use super::element::{Element, Grip};
use super::pose::{Flat, Pose};
use crate::compliant::pad::Pad;
use crate::space::{Vector, difference, turned};

/// The feet of the lowest body: the first elements of a world.
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
    /// Σ a² of each axis.
    anchor_squared: [f64; 2],
}

/// Far more than rounding changes a margin of the order of 1.
const ROUNDED: f64 = 1e-6;

/// A margin above this share of its unit, after it has lost `MISSED` of how deep the hull of its control points falls below the
/// ends, needs no search. Between the ends of the longest step a sine is half a percent of its amplitude below that hull at most, so `FAR`
/// suffices up to four static compressions; where vibrations are larger, the tolerance makes steps shorter.
const FAR: f64 = 0.02;
const MISSED: f64 = 0.1;

/// How often a step is halved where the hull of its control points does not tell.
const HALVINGS: usize = 2;

/// The feet, sorted by how they hold on.
#[derive(Debug, Clone, Default)]
pub(super) struct Sorted {
    pub(super) sums: Stuck,
    /// Places of those that stick, and the anchors of their springs.
    stuck: Vec<[f64; 2]>,
    anchors: Vec<[f64; 2]>,
    /// Places of those without contact above cushions that have recovered.
    open: Vec<[f64; 2]>,
    recovering: Vec<Recovering>,
}

/// A foot without contact, above a cushion that was left at `since_s`.
#[derive(Debug, Clone, Copy)]
struct Recovering {
    point: [f64; 2],
    since_s: f64,
    compression_m: f64,
}

/// What the margins of feet need of a pose: as functions of their places, displacements, how much longer a foot that
/// sticks pushes ([`Pad::pushes`]), and its force as a share of the weight.
struct Planes {
    time_s: f64,
    right: Flat,
    back: Flat,
    up: Flat,
    pushes: Flat,
    carried: Flat,
}

/// Four planes whose hull contains the cubic through values and rates at both ends of a step: its control points.
fn between([(from, leaves), (to, comes)]: [(Flat, Flat); 2], length_s: f64) -> [Flat; 4] {
    let third_s = length_s / 3.0;
    [
        from,
        from.plus(leaves.times(third_s)),
        to.plus(comes.times(-third_s)),
        to,
    ]
}

/// Whether a quantity with these control points stays above zero at all these places; `unit` is its size.
fn is_far(planes: [Flat; 4], points: &[[f64; 2]], unit: f64) -> bool {
    is_far_in(planes, points, (FAR * unit, MISSED), HALVINGS)
}

/// [`is_far`] in a part of the step; `keep` is how far at least, and as a share of what the hull falls below its ends.
fn is_far_in(planes: [Flat; 4], points: &[[f64; 2]], keep: (f64, f64), halvings: usize) -> bool {
    let [from, early, late, to] = Flat::least_of(planes, points);
    let (ends, inner) = (from.min(to), early.min(late));
    if inner.min(ends) - keep.1 * (ends - inner).max(0.0) > keep.0 {
        return true;
    }
    if ends <= keep.0 || halvings == 0 {
        return false;
    }
    // In half of a step the hull falls a quarter as deep.
    let keep = (keep.0, 4.0 * keep.1);
    let mut halves = halved(planes).into_iter();
    halves.all(|half| is_far_in(half, points, keep, halvings - 1))
}

/// The control points of both halves (de Casteljau).
fn halved([a, b, c, d]: [Flat; 4]) -> [[Flat; 4]; 2] {
    let middle = |one: Flat, other: Flat| one.plus(other).times(0.5);
    let (ab, bc, cd) = (middle(a, b), middle(b, c), middle(c, d));
    let (abc, bcd) = (middle(ab, bc), middle(bc, cd));
    let all = middle(abc, bcd);
    [[a, ab, abc, all], [all, bcd, cd, d]]
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
            self.anchor_squared[axis] += anchor * anchor;
        }
    }

    /// Σ f².
    #[inline]
    fn squares(&self, Flat { at, x, y }: Flat) -> f64 {
        at * (self.count * at + 2.0 * (x * self.x + y * self.y))
            + ((x * x * self.xx + y * y * self.yy) + 2.0 * x * y * self.xy)
    }

    /// Σ (f − a)² along an axis.
    fn stretch_squared(&self, flat: Flat, axis: usize) -> f64 {
        let by_anchor = flat.at * self.anchor[axis]
            + (flat.x * self.x_anchor[axis] + flat.y * self.y_anchor[axis]);
        self.squares(flat) - 2.0 * by_anchor + self.anchor_squared[axis]
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

    /// Sorts the feet; returns the indices of those that carry otherwise.
    pub(super) fn sort(
        &self,
        (grips, time_s): (&[Grip], f64),
        sorted: &mut Sorted,
        alone: &mut Vec<usize>,
    ) {
        sorted.sums = Stuck::default();
        sorted.stuck.clear();
        sorted.anchors.clear();
        sorted.open.clear();
        sorted.recovering.clear();
        for (index, (&point, grip)) in self.points.iter().zip(grips).enumerate() {
            match *grip {
                Grip::Stick { anchor } if self.linear.is_some() => {
                    sorted.sums.add(point, anchor);
                    sorted.stuck.push(point);
                    sorted.anchors.push(anchor);
                }
                Grip::Stick { .. } | Grip::Slip => alone.push(index),
                Grip::Open {
                    since_s,
                    compression_m,
                } => {
                    if time_s - since_s > self.pad.recovery_s(compression_m) {
                        sorted.open.push(point);
                    } else {
                        sorted.recovering.push(Recovering {
                            point,
                            since_s,
                            compression_m,
                        });
                    }
                }
                Grip::Gone => {}
            }
        }
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
        Push {
            force: [right, back, up],
            torque: difference(&[z[1], x[2], y[0]], &[y[2], z[0], x[1]]),
            dissipated_w: if c > 0.0 {
                c * stuck.squares(rising)
            } else {
                0.0
            },
        }
    }

    /// No foot is higher above its unloaded cushion than this.
    pub(super) fn highest_m(&self, pose: &Pose) -> f64 {
        pose.displacement(self.z, 2).most_within(self.reach)
    }

    /// What their margins need of a pose.
    fn planes(&self, time_s: f64, pose: &Pose) -> Planes {
        let [right, back, up] = [0, 1, 2].map(|axis| pose.displacement(self.z, axis));
        let (pushes, carried) = match self.linear {
            Some([k, c]) => {
                let carried = up
                    .times(-k / self.weight_n)
                    .plus(pose.rising(self.z).times(-c / self.weight_n));
                let pressed = up.times(-1.0 / self.unit_m);
                (if c > 0.0 { carried } else { pressed }, carried)
            }
            None => (up, up),
        };
        Planes {
            time_s,
            right,
            back,
            up,
            pushes,
            carried,
        }
    }

    /// How far a foot is from its next event; `None` if it carries otherwise than on a spring and a dashpot that stick.
    fn margin_of(&self, planes: &Planes, index: usize, grip: Grip) -> Option<f64> {
        let point = self.points[index];
        match grip {
            Grip::Gone => Some(f64::INFINITY),
            Grip::Open {
                since_s,
                compression_m,
            } => {
                let surface_m = self.pad.surface(since_s, compression_m, planes.time_s);
                Some((surface_m + planes.up.of(point)) / self.unit_m)
            }
            Grip::Stick { anchor } if self.linear.is_some() => {
                let pushes = planes.pushes.of(point);
                let Some(friction) = self.friction else {
                    return Some(pushes);
                };
                let a = planes.right.of(point) - anchor[0];
                let b = planes.back.of(point) - anchor[1];
                let tangential_n = self.tangential_stiffness * (a * a + b * b).sqrt();
                let grips = friction * planes.carried.of(point) - tangential_n / self.weight_n;
                Some(pushes.min(grips))
            }
            Grip::Stick { .. } | Grip::Slip => None,
        }
    }

    /// The least margin of the feet that stick with friction.
    fn least_grip(&self, planes: &Planes, sorted: &Sorted, friction: f64) -> f64 {
        let margin = |point: [f64; 2], anchor: [f64; 2]| {
            let a = planes.right.of(point) - anchor[0];
            let b = planes.back.of(point) - anchor[1];
            let tangential_n = self.tangential_stiffness * (a * a + b * b).sqrt();
            let grips = friction * planes.carried.of(point) - tangential_n / self.weight_n;
            let pushes = planes.pushes.of(point);
            if pushes < grips { pushes } else { grips }
        };
        // In lanes, so that it is calculated in vectors.
        let mut least = [f64::INFINITY; 4];
        let (points, last_points) = sorted.stuck.as_chunks::<4>();
        let (anchors, last_anchors) = sorted.anchors.as_chunks::<4>();
        for (points, anchors) in points.iter().zip(anchors) {
            let margins: [f64; 4] = std::array::from_fn(|lane| margin(points[lane], anchors[lane]));
            for (least, margin) in least.iter_mut().zip(margins) {
                *least = if margin < *least { margin } else { *least };
            }
        }
        let last = last_points.iter().zip(last_anchors);
        let last = last.map(|(point, anchor)| margin(*point, *anchor));
        least.into_iter().chain(last).fold(f64::INFINITY, f64::min)
    }

    /// How far the feet are from their next event, if that is less than `least`: the least of both.
    /// `of` gives it for the feet among `alone`, which carry otherwise than on a spring and a dashpot that stick.
    pub(super) fn margin(
        &self,
        (sorted, alone): (&Sorted, &[usize]),
        (time_s, pose): (f64, &Pose),
        mut least: f64,
        of: impl Fn(usize) -> f64,
    ) -> f64 {
        let planes = self.planes(time_s, pose);
        least = least.min(planes.up.least(&sorted.open) / self.unit_m);
        for foot in &sorted.recovering {
            // Its surface is no lower than the unloaded cushion.
            let height_m = planes.up.of(foot.point);
            if height_m < least * self.unit_m {
                let surface_m = self.pad.surface(foot.since_s, foot.compression_m, time_s);
                least = least.min((surface_m + height_m) / self.unit_m);
            }
        }
        least = least.min(match self.friction {
            Some(friction) => self.least_grip(&planes, sorted, friction),
            None => planes.pushes.least(&sorted.stuck),
        });
        let alone = alone.iter().take_while(|index| **index < self.len());
        alone.fold(least, |least, &index| least.min(of(index)))
    }

    /// Whether no foot has an event in a step of this length until `end_s` between two poses with their rates. All feet
    /// must stick on linear cushions without friction, or be open.
    pub(super) fn stay(
        &self,
        sorted: &Sorted,
        ends: [(&Pose, &[f64]); 2],
        (end_s, length_s): (f64, f64),
    ) -> bool {
        let (Some([k, c]), None) = (self.linear, self.friction) else {
            return false;
        };
        let z = self.z;
        let ups = ends.map(|(pose, _)| pose.displacement(z, 2));
        let risings = ends.map(|(pose, _)| pose.rising(z));
        let up = between([(ups[0], risings[0]), (ups[1], risings[1])], length_s);
        let rises = |foot: &Recovering| {
            // A surface sinks.
            let surface_m = self.pad.surface(foot.since_s, foot.compression_m, end_s);
            let sinks = up.map(|up| Flat {
                at: up.at + surface_m,
                ..up
            });
            is_far(sinks, &[foot.point], self.unit_m)
        };
        if !(is_far(up, &sorted.open, self.unit_m) && sorted.recovering.iter().all(rises)) {
            return false;
        }
        if c == 0.0 {
            return is_far(up.map(|up| up.times(-1.0)), &sorted.stuck, self.unit_m);
        }
        let force = |up: Flat, rising: Flat| up.times(-k).plus(rising.times(-c));
        let of = |end: usize| {
            let (pose, rates) = ends[end];
            let rate = force(risings[end], pose.lifting(z, rates));
            (force(ups[end], risings[end]), rate)
        };
        let forces = between([of(0), of(1)], length_s);
        is_far(forces, &sorted.stuck, self.weight_n / self.len() as f64)
    }

    /// The feet that may be past their event.
    pub(super) fn near(
        &self,
        grips: &[Grip],
        (time_s, pose): (f64, &Pose),
    ) -> impl Iterator<Item = usize> {
        let planes = self.planes(time_s, pose);
        (0..self.len()).filter(move |&index| {
            let margin = self.margin_of(&planes, index, grips[index]);
            margin.is_none_or(|margin| margin < ROUNDED)
        })
    }

    /// Energy in the springs of the feet that stick together.
    pub(super) fn stored_j(&self, stuck: &Stuck, pose: &Pose) -> f64 {
        let [right, back, up] = [0, 1, 2].map(|axis| pose.displacement(self.z, axis));
        let [k, _] = self.linear.unwrap_or_default();
        let sheared = stuck.stretch_squared(right, 0) + stuck.stretch_squared(back, 1);
        0.5 * (k * stuck.squares(up) + self.tangential_stiffness * sheared)
    }
}
