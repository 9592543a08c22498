//! The steps of samples that may set a new extreme: many samples of one world side by side.

use pulp::{Arch, Simd, WithSimd};

use super::body::Body;
use super::each::{each, six, two};
use super::linear::{Recursion, STATES, righting};
use super::{LANES, Lane};
use crate::vector::{Math, Numbers};

/// Up to here the linear equations are followed: beyond this part of its load lost by an edge, squares of the rotation
/// count for a world in which one lets go later.
pub(super) const FIRM_RATIO: f64 = 0.15;

/// How a block goes on over a step, and what its edges do. Rates, and what is derived from them, are those over a step.
#[derive(Debug, Clone)]
pub(super) struct Look {
    step: Recursion,
    parts: usize,
    /// k/m, c/(m h), c h/m, m/I.
    spring: f64,
    dashpot: f64,
    inertial: f64,
    turning: f64,
    /// θ̈ by x and θ.
    righting: [f64; 2],
    arms: [f64; 2],
    /// 1 over the load of an edge at rest, and its compression.
    relief: [f64; 2],
    sunk: [f64; 2],
}

impl Look {
    pub(super) fn new(body: &Body, step: Recursion) -> Self {
        let h = body.step_s;
        Self {
            step,
            parts: body.parts,
            spring: body.spring,
            dashpot: body.dashpot / h,
            inertial: body.dashpot * h,
            turning: body.turning,
            righting: righting(body),
            arms: body.rest.arm_x,
            relief: body.rest.loads.map(|load| 1.0 / load),
            sunk: body.rest.compressions,
        }
    }
}

/// A sample that is to be looked at: y at its start, and the base at its start and its end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted {
    pub(super) y: [f64; STATES],
    pub(super) horizontal: [f64; 2],
    pub(super) vertical: [f64; 2],
    /// Its place in the motion.
    pub(super) sample: usize,
}

/// The start of the step in which an edge first lost more than [`FIRM_RATIO`] of its load.
#[derive(Debug, Clone, Copy)]
pub(super) struct Left {
    pub(super) y: [f64; STATES],
    pub(super) sample: usize,
    pub(super) part: usize,
}

/// What a world has reached.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Reached {
    /// Largest part of its load that an edge lost.
    pub(super) lost: f64,
    /// Largest compression, and acceleration of each edge, while both held.
    pub(super) pressed: f64,
    pub(super) peaks: [f64; 2],
    pub(super) left: Option<Left>,
    /// Beyond this part lost nothing else counts: what follows from pads that pull, or from these equations where
    /// others are to follow.
    pub(super) counts_to: f64,
}

/// Samples side by side, and what is found in each.
#[derive(Debug, Default)]
pub(super) struct Looking {
    y: [Lane; STATES],
    horizontal: [Lane; 2],
    vertical: [Lane; 2],
    lost: Lane,
    pressed: Lane,
    peaks: [Lane; 2],
    /// 1 until an edge has lost more than [`FIRM_RATIO`] of its load, and the step in which it did.
    holds: Lane,
    left: [Lane; STATES],
    left_in: Lane,
}

impl Looking {
    /// Looks at samples of a world, which are in the order of their time.
    pub(super) fn at(&mut self, arch: Arch, look: &Look, wanted: &[Wanted], reached: &mut Reached) {
        for wanted in wanted.chunks(LANES) {
            for (lane, one) in wanted.iter().enumerate() {
                for (column, value) in self.y.iter_mut().zip(one.y) {
                    column[lane] = value;
                }
                for end in 0..2 {
                    self.horizontal[end][lane] = one.horizontal[end];
                    self.vertical[end][lane] = one.vertical[end];
                }
            }
            let all = All {
                looking: self,
                look,
                count: wanted.len(),
                counts_to: reached.counts_to,
            };
            arch.dispatch(all);
            for (lane, one) in wanted.iter().enumerate() {
                self.tell(lane, one.sample, reached);
            }
        }
    }

    /// What was found in a lane, after what was found before it.
    fn tell(&self, lane: usize, sample: usize, reached: &mut Reached) {
        if reached.lost <= reached.counts_to {
            reached.pressed = reached.pressed.max(self.pressed[lane]);
            for (peak, column) in reached.peaks.iter_mut().zip(&self.peaks) {
                *peak = peak.max(column[lane]);
            }
        }
        reached.lost = reached.lost.max(self.lost[lane]);
        if reached.left.is_none() && self.holds[lane] == 0.0 {
            reached.left = Some(Left {
                y: self.left.each_ref().map(|column| column[lane]),
                sample,
                part: self.left_in[lane] as usize,
            });
        }
    }
}

struct All<'a> {
    looking: &'a mut Looking,
    look: &'a Look,
    count: usize,
    counts_to: f64,
}

impl WithSimd for All<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let m = Math(simd);
        let abreast = LANES / Lane::pairs::<S>();
        for i in 0..self.count.div_ceil(abreast) {
            self.looking.follow::<S>(m, i, self.look, self.counts_to);
        }
    }
}

/// A value in the middle of a step, from it and its rate at both ends.
#[inline(always)]
fn middle<S: Simd>(m: Math<S>, from: [Numbers<S>; 2], to: [Numbers<S>; 2]) -> Numbers<S> {
    m.fma(
        m.splat(0.125),
        m.sub(from[1], to[1]),
        m.mul(m.splat(0.5), m.add(from[0], to[0])),
    )
}

/// What is found of both edges at an instant.
#[derive(Clone, Copy)]
struct Found<S: Simd> {
    /// Part of its load that an edge has lost: 1 where it lets go; and its rate.
    lost: [Numbers<S>; 2],
    losing: [Numbers<S>; 2],
    press: [Numbers<S>; 2],
    pressing: [Numbers<S>; 2],
    /// Upward in the inertial frame; relative to the base it is less by its acceleration.
    up: [Numbers<S>; 2],
}

impl Looking {
    /// The steps of a sample.
    #[inline(always)]
    fn follow<S: Simd>(&mut self, m: Math<S>, i: usize, look: &Look, counts_to: f64) {
        let (zero, limit) = (m.splat(0.0), m.splat(FIRM_RATIO));
        let counts_to = m.splat(counts_to);
        let share = 1.0 / look.parts as f64;
        let mut y = six!(k, self.y[k].get::<S>(i));
        let (a_from, a_to) = (
            self.horizontal[0].get::<S>(i),
            self.horizontal[1].get::<S>(i),
        );
        let (v_from, v_to) = (self.vertical[0].get::<S>(i), self.vertical[1].get::<S>(i));
        let (change, v_change) = (m.sub(a_to, a_from), m.sub(v_to, v_from));
        let (mut lost, mut pressed) = (zero, zero);
        let mut peaks = [zero; 2];
        let mut holds = m.splat(1.0);
        let (mut left, mut left_in) = ([zero; STATES], zero);
        let mut was = look.found::<S>(m, y, v_from);
        for part in 0..look.parts {
            let (start, end) = (
                m.splat(part as f64 * share),
                m.splat((part + 1) as f64 * share),
            );
            let a = [m.fma(start, change, a_from), m.fma(end, change, a_from)];
            let v = [m.fma(start, v_change, v_from), m.fma(end, v_change, v_from)];
            let before = y;
            y = look.step.after::<S>(m, y, a, v);
            let found = look.found::<S>(m, y, v[1]);
            let mut now = zero;
            let mut deepest = pressed;
            for edge in 0..2 {
                let inside = middle(
                    m,
                    [was.lost[edge], was.losing[edge]],
                    [found.lost[edge], found.losing[edge]],
                );
                now = m.larger(now, m.larger(found.lost[edge], inside));
                let inside = middle(
                    m,
                    [was.press[edge], was.pressing[edge]],
                    [found.press[edge], found.pressing[edge]],
                );
                let most = m.larger(found.press[edge], inside);
                deepest = m.larger(m.add(m.splat(look.sunk[edge]), most), deepest);
            }
            was = found;
            lost = m.larger(now, lost);
            let counts = m.ge(counts_to, lost);
            for (peak, up) in peaks.iter_mut().zip(found.up) {
                *peak = m.select(counts, m.larger(up, *peak), *peak);
            }
            pressed = m.select(counts, deepest, pressed);
            let leaves = m.and(m.gt(holds, zero), m.gt(now, limit));
            if m.any(leaves) {
                left = six!(k, m.select(leaves, before[k], left[k]));
                left_in = m.select(leaves, m.splat(part as f64), left_in);
                holds = m.select(leaves, zero, holds);
            }
        }
        self.lost.set::<S>(i, lost);
        self.pressed.set::<S>(i, pressed);
        for (column, peak) in self.peaks.iter_mut().zip(peaks) {
            column.set::<S>(i, peak);
        }
        self.holds.set::<S>(i, holds);
        for (column, value) in self.left.iter_mut().zip(left) {
            column.set::<S>(i, value);
        }
        self.left_in.set::<S>(i, left_in);
    }
}

impl Look {
    /// What each edge carries more than at rest, and the accelerations that follow.
    #[inline(always)]
    fn found<S: Simd>(&self, m: Math<S>, y: [Numbers<S>; STATES], v: Numbers<S>) -> Found<S> {
        let zero = m.splat(0.0);
        let (spring, dashpot, inertial) = (
            m.splat(self.spring),
            m.splat(self.dashpot),
            m.splat(self.inertial),
        );
        let arms = two!(edge, m.splat(self.arms[edge]));
        let press = two!(edge, m.fma(arms[edge], y[2], m.sub(zero, y[1])));
        let pressing = two!(edge, m.fma(arms[edge], y[5], m.sub(zero, y[4])));
        let load = two!(
            edge,
            m.fma(spring, press[edge], m.mul(dashpot, pressing[edge]))
        );
        let lift = m.add(load[0], load[1]);
        let couple = m.fma(arms[0], load[0], m.mul(arms[1], load[1]));
        let righting = m.fma(
            m.splat(self.righting[0]),
            y[0],
            m.mul(m.splat(self.righting[1]), y[2]),
        );
        let spin = m.fnma(m.splat(self.turning), couple, righting);
        let up = two!(edge, m.fnma(arms[edge], spin, lift));
        let relief = two!(edge, m.sub(zero, m.splat(self.relief[edge])));
        let change = two!(
            edge,
            m.fnma(inertial, m.sub(up[edge], v), m.mul(spring, pressing[edge]))
        );
        Found {
            lost: two!(edge, m.mul(relief[edge], load[edge])),
            losing: two!(edge, m.mul(relief[edge], change[edge])),
            press,
            pressing,
            up,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::G0_M_S2;
    use crate::compliant::bulk::linear::rates;
    use crate::compliant::bulk::tests::leaning;

    /// What is called the rate of a number is its rate, by the equations of motion.
    #[test]
    fn rates_of_what_is_found_are_rates() {
        let body = leaning();
        let look = Look::new(&body, Recursion::new(&body));
        let m = Math(pulp::Scalar::new());
        let found = |y: [f64; STATES], v: f64| look.found(m, y.map(|y| m.splat(y)), m.splat(v));
        let a = rates(&body);
        for state in 0..=STATES {
            let mut y = [0.0; STATES];
            let mut v = 0.0;
            *y.get_mut(state).unwrap_or(&mut v) = G0_M_S2;
            let mut change: [f64; STATES] =
                std::array::from_fn(|k| (0..STATES).map(|i| a[k][i] * y[i]).sum());
            change[4] += a[4][STATES + 2] * v;
            let (now, by_change) = (found(y, v), found(change, 0.0));
            for edge in 0..2 {
                for (rate, expected) in [
                    (now.losing[edge][0], by_change.lost[edge][0]),
                    (now.pressing[edge][0], by_change.press[edge][0]),
                ] {
                    // A dozen sums and products.
                    let size = expected.abs().max(1e-3);
                    assert!(
                        (rate - expected).abs() < 1e-12 * size,
                        "{state} {edge}: {rate} {expected}"
                    );
                }
            }
        }
    }
}
