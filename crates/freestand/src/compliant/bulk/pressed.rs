//! Both edges on their pads: the exact recursion in every lane, and what it says of letting go.

use pulp::{Arch, Simd, WithSimd};

use super::LANES;
use super::body::Body;
use super::each::{each, six, two};
use super::linear::{Bounds, Recursion, STATES, Sample, WEIGHED, righting};
use crate::vector::{Column, Math, Numbers};

/// Up to here the linear equations are followed: beyond this part of its load lost by an edge, squares of the rotation
/// count for a world in which one lets go later.
pub(super) const FIRM_RATIO: f64 = 0.15;

pub(super) type Lane = Column<LANES>;

/// Worlds side by side. Rates, and what is derived from them, are those over a step.
///
/// They go from sample to sample. The steps in between are taken only where the bounds say that one of them may
/// set a new extreme: what they find changes nothing elsewhere, so a world does not depend on its neighbours.
#[derive(Debug, Default)]
pub(super) struct Pressed {
    sample: Steps,
    step: Steps,
    bounds: [[Lane; WEIGHED]; 3],
    /// [`Modes`](super::linear::Modes).
    into: [[Lane; 3]; 3],
    held: [Lane; 3],
    /// Steps of a sample, and the share of each.
    parts: Lane,
    share: Lane,
    /// k/m, c/(m h), c h/m, m/I.
    spring: Lane,
    dashpot: Lane,
    inertial: Lane,
    turning: Lane,
    /// θ̈ by x and θ.
    righting: [Lane; 2],
    arms: [Lane; 2],
    /// 1 over the load of an edge at rest, its compression, and the larger of both.
    relief: [Lane; 2],
    sunk: [Lane; 2],
    deepest: Lane,
    pub(super) y: [Lane; STATES],
    /// 1 until an edge has lost more than [`FIRM_RATIO`] of its load.
    pub(super) holds: Lane,
    /// Where the step began in which it did, and how many steps after the start of the block.
    pub(super) left: [Lane; STATES],
    pub(super) left_at: Lane,
    /// Largest part lost, compression and acceleration of each edge; the last two while both held.
    pub(super) most_lost: Lane,
    pub(super) most_pressed: Lane,
    pub(super) peak: [Lane; 2],
}

/// [`Recursion`] in every lane.
#[derive(Debug, Default)]
struct Steps {
    state: [[Lane; STATES]; STATES],
    from: [[Lane; 2]; STATES],
    to: [[Lane; 2]; STATES],
}

impl Steps {
    fn enter(&mut self, lane: usize, recursion: &Recursion) {
        for (columns, row) in self.state.iter_mut().zip(&recursion.state) {
            for (column, value) in columns.iter_mut().zip(row) {
                column[lane] = *value;
            }
        }
        let ways = [
            (&mut self.from, &recursion.from),
            (&mut self.to, &recursion.to),
        ];
        for (columns, rows) in ways {
            for (column, value) in columns.iter_mut().flatten().zip(rows.iter().flatten()) {
                column[lane] = *value;
            }
        }
    }

    fn leave(&mut self, lane: usize) {
        let columns = self.state.iter_mut().flatten();
        let ways = self.from.iter_mut().chain(&mut self.to).flatten();
        columns.chain(ways).for_each(|column| column[lane] = 0.0);
    }

    /// y after it, while the base acceleration goes from the first to the second of each way.
    #[inline(always)]
    fn after<S: Simd>(
        &self,
        m: Math<S>,
        i: usize,
        y: [Numbers<S>; STATES],
        [a, a_end]: [Numbers<S>; 2],
        vertical: Option<[Numbers<S>; 2]>,
    ) -> [Numbers<S>; STATES] {
        six!(k, {
            let row = &self.state[k];
            let mut one = m.mul(self.from[k][0].get::<S>(i), a);
            let mut two = m.mul(self.to[k][0].get::<S>(i), a_end);
            if let Some([v, v_end]) = vertical {
                one = m.fma(self.from[k][1].get::<S>(i), v, one);
                two = m.fma(self.to[k][1].get::<S>(i), v_end, two);
            }
            one = m.fma(row[0].get::<S>(i), y[0], one);
            two = m.fma(row[1].get::<S>(i), y[1], two);
            one = m.fma(row[2].get::<S>(i), y[2], one);
            two = m.fma(row[3].get::<S>(i), y[3], two);
            one = m.fma(row[4].get::<S>(i), y[4], one);
            two = m.fma(row[5].get::<S>(i), y[5], two);
            m.add(one, two)
        })
    }
}

/// What a world has reached before it enters a lane.
#[derive(Debug, Default)]
pub(super) struct Reached {
    pub(super) lost: f64,
    pub(super) pressed: f64,
    pub(super) peaks: [f64; 2],
}

impl Pressed {
    /// Puts a world into a lane, with what it has reached so far.
    pub(super) fn enter(
        &mut self,
        lane: usize,
        body: &Body,
        step: &Recursion,
        sample: &Sample,
        y: &[f64; STATES],
        reached: &Reached,
    ) {
        let h = body.step_s;
        self.step.enter(lane, step);
        self.sample.enter(lane, &sample.recursion);
        let Bounds { lost, press, up } = &sample.bounds;
        for (columns, weights) in self.bounds.iter_mut().zip([lost, press, up]) {
            for (column, weight) in columns.iter_mut().zip(weights) {
                column[lane] = *weight;
            }
        }
        for (columns, row) in self.into.iter_mut().zip(&sample.modes.into) {
            for (column, value) in columns.iter_mut().zip(row) {
                column[lane] = *value;
            }
        }
        let pairs = self.y.iter_mut().zip(y);
        for (column, value) in pairs.chain(self.held.iter_mut().zip(&sample.modes.held)) {
            column[lane] = *value;
        }
        (self.parts[lane], self.share[lane]) = (body.parts as f64, 1.0 / body.parts as f64);
        self.spring[lane] = body.spring;
        self.dashpot[lane] = body.dashpot / h;
        self.inertial[lane] = body.dashpot * h;
        self.turning[lane] = body.turning;
        for (column, value) in self.righting.iter_mut().zip(righting(body)) {
            column[lane] = value;
        }
        for edge in 0..2 {
            self.arms[edge][lane] = body.rest.arm_x[edge];
            self.relief[edge][lane] = 1.0 / body.rest.loads[edge];
            self.sunk[edge][lane] = body.rest.compressions[edge];
            self.peak[edge][lane] = reached.peaks[edge];
        }
        self.deepest[lane] = self.sunk[0][lane].max(self.sunk[1][lane]);
        self.holds[lane] = 1.0;
        self.most_lost[lane] = reached.lost;
        self.most_pressed[lane] = reached.pressed;
    }

    /// Takes a world out of a lane: zeros do nothing.
    pub(super) fn leave(&mut self, lane: usize) {
        self.step.leave(lane);
        self.sample.leave(lane);
        let bounds = self.bounds.iter_mut().flatten();
        let held = self.held.iter_mut().chain(&mut self.y);
        for column in bounds.chain(held).chain(&mut self.relief) {
            column[lane] = 0.0;
        }
        for column in [&mut self.holds, &mut self.deepest, &mut self.parts] {
            column[lane] = 0.0;
        }
    }
}

/// The base acceleration of every lane at each sample of a block of samples.
#[derive(Debug, Default)]
pub(super) struct Ground {
    pub(super) horizontal: Vec<Lane>,
    /// Empty where no lane moves vertically.
    pub(super) vertical: Vec<Lane>,
}

/// Follows all lanes through a block of samples.
pub(super) fn follow(arch: Arch, pressed: &mut Pressed, ground: &Ground) {
    arch.dispatch(Follow { pressed, ground });
}

struct Follow<'a> {
    pressed: &'a mut Pressed,
    ground: &'a Ground,
}

impl WithSimd for Follow<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let m = Math(simd);
        for i in 0..Lane::pairs::<S>() {
            self.pressed.pass(m, i, self.ground);
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

impl Pressed {
    #[inline(always)]
    fn pass<S: Simd>(&mut self, m: Math<S>, i: usize, ground: &Ground) {
        let mut y = six!(k, self.y[k].get::<S>(i));
        for (sample, ends) in ground.horizontal.windows(2).enumerate() {
            let a = [ends[0].get::<S>(i), ends[1].get::<S>(i)];
            let vertical = match ground.vertical.get(sample..) {
                Some([from, to, ..]) => Some([from.get::<S>(i), to.get::<S>(i)]),
                _ => None,
            };
            if self.may_find::<S>(m, i, y, a, vertical) {
                self.look::<S>(m, i, y, a, vertical, sample);
            }
            y = self.sample.after::<S>(m, i, y, a, vertical);
        }
        for (column, value) in self.y.iter_mut().zip(y) {
            column.set::<S>(i, value);
        }
    }

    /// Whether a step within a sample could find more in any lane than was found before.
    #[inline(always)]
    fn may_find<S: Simd>(
        &self,
        m: Math<S>,
        i: usize,
        y: [Numbers<S>; STATES],
        a: [Numbers<S>; 2],
        vertical: Option<[Numbers<S>; 2]>,
    ) -> bool {
        let zero = m.splat(0.0);
        let places = each!(
            mode,
            {
                let into = &self.into[mode];
                let held = m.mul(self.held[mode].get::<S>(i), a[0]);
                let place = m.fma(into[0].get::<S>(i), y[0], m.sub(zero, held));
                let place = m.fma(into[1].get::<S>(i), y[1], place);
                m.abs(m.fma(into[2].get::<S>(i), y[2], place))
            },
            0 1 2
        );
        let rates = each!(
            mode,
            {
                let into = &self.into[mode];
                let rate = m.mul(into[0].get::<S>(i), y[3]);
                let rate = m.fma(into[1].get::<S>(i), y[4], rate);
                m.abs(m.fma(into[2].get::<S>(i), y[5], rate))
            },
            0 1 2
        );
        let (level, change) = (m.abs(a[0]), m.abs(m.sub(a[1], a[0])));
        let most = each!(
            of,
            {
                let weights = &self.bounds[of];
                let mut one = m.mul(weights[STATES].get::<S>(i), level);
                let mut two = m.mul(weights[STATES + 1].get::<S>(i), change);
                if let Some(v) = vertical {
                    let v = m.larger(m.abs(v[0]), m.abs(v[1]));
                    one = m.fma(weights[STATES + 2].get::<S>(i), v, one);
                }
                one = m.fma(weights[0].get::<S>(i), places[0], one);
                two = m.fma(weights[1].get::<S>(i), places[1], two);
                one = m.fma(weights[2].get::<S>(i), places[2], one);
                two = m.fma(weights[3].get::<S>(i), rates[0], two);
                one = m.fma(weights[4].get::<S>(i), rates[1], one);
                two = m.fma(weights[5].get::<S>(i), rates[2], two);
                m.add(one, two)
            },
            0 1 2
        );
        let lost = self.most_lost.get::<S>(i);
        let pressed = m.add(self.deepest.get::<S>(i), most[1]);
        let pressed = m.ge(self.most_pressed.get::<S>(i), pressed);
        let up = [self.peak[0].get::<S>(i), self.peak[1].get::<S>(i)];
        let up = m.ge(m.smaller(up[0], up[1]), most[2]);
        // What follows from pads that pull does not count.
        let rest = m.or(m.gt(lost, m.splat(1.0)), m.and(pressed, up));
        // Numbers that are none are looked at.
        m.any(m.not(m.and(m.ge(lost, most[0]), rest)))
    }

    /// The steps of a sample, which is so many after the start of the block. A lane with fewer steps than others
    /// stays at the end of its last one.
    #[inline(always)]
    fn look<S: Simd>(
        &mut self,
        m: Math<S>,
        i: usize,
        mut y: [Numbers<S>; STATES],
        [a_from, a_to]: [Numbers<S>; 2],
        vertical: Option<[Numbers<S>; 2]>,
        sample: usize,
    ) {
        let (zero, one, limit) = (m.splat(0.0), m.splat(1.0), m.splat(FIRM_RATIO));
        let (parts, share) = (self.parts.get::<S>(i), self.share.get::<S>(i));
        let change = m.sub(a_to, a_from);
        let [v_from, v_to] = match vertical {
            Some(v) => v,
            None => [zero; 2],
        };
        let v_change = m.sub(v_to, v_from);
        let mut was = self.found::<S>(m, i, y, v_from);
        let mut part = zero;
        let mut goes_on = m.gt(parts, part);
        while m.any(goes_on) {
            let next = m.add(part, one);
            let (start, end) = (m.mul(part, share), m.mul(m.smaller(next, parts), share));
            let a = [m.fma(start, change, a_from), m.fma(end, change, a_from)];
            let v = [m.fma(start, v_change, v_from), m.fma(end, v_change, v_from)];
            let before = y;
            let vertical = vertical.is_some().then_some(v);
            let after = self.step.after::<S>(m, i, y, a, vertical);
            y = six!(k, m.select(goes_on, after[k], y[k]));
            let found = self.found::<S>(m, i, y, v[1]);
            let mut most = self.most_lost.get::<S>(i);
            let mut pressed = self.most_pressed.get::<S>(i);
            let mut now = zero;
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
                let deepest = m.larger(found.press[edge], inside);
                pressed = m.larger(m.add(self.sunk[edge].get::<S>(i), deepest), pressed);
            }
            was = found;
            most = m.larger(now, most);
            self.most_lost.set::<S>(i, most);
            // What follows from pads that pull does not count.
            let counts = m.ge(one, most);
            for (column, up) in self.peak.iter_mut().zip(found.up) {
                let peak = column.get::<S>(i);
                column.set::<S>(i, m.select(counts, m.larger(up, peak), peak));
            }
            let old = self.most_pressed.get::<S>(i);
            self.most_pressed
                .set::<S>(i, m.select(counts, pressed, old));
            let open = m.gt(self.holds.get::<S>(i), zero);
            let leaves = m.and(open, m.gt(now, limit));
            if m.any(leaves) {
                for (column, before) in self.left.iter_mut().zip(before) {
                    let old = column.get::<S>(i);
                    column.set::<S>(i, m.select(leaves, before, old));
                }
                let old = self.left_at.get::<S>(i);
                let step = m.fma(m.splat(sample as f64), parts, part);
                self.left_at.set::<S>(i, m.select(leaves, step, old));
                let old = self.holds.get::<S>(i);
                self.holds.set::<S>(i, m.select(leaves, zero, old));
            }
            part = next;
            goes_on = m.gt(parts, part);
        }
    }

    /// What each edge carries more than at rest, and the accelerations that follow.
    #[inline(always)]
    fn found<S: Simd>(
        &self,
        m: Math<S>,
        i: usize,
        y: [Numbers<S>; STATES],
        v: Numbers<S>,
    ) -> Found<S> {
        let zero = m.splat(0.0);
        let (spring, dashpot, inertial) = (
            self.spring.get::<S>(i),
            self.dashpot.get::<S>(i),
            self.inertial.get::<S>(i),
        );
        let arms = two!(edge, self.arms[edge].get::<S>(i));
        let press = two!(edge, m.fma(arms[edge], y[2], m.sub(zero, y[1])));
        let pressing = two!(edge, m.fma(arms[edge], y[5], m.sub(zero, y[4])));
        let load = two!(
            edge,
            m.fma(spring, press[edge], m.mul(dashpot, pressing[edge]))
        );
        let lift = m.add(load[0], load[1]);
        let couple = m.fma(arms[0], load[0], m.mul(arms[1], load[1]));
        let righting = m.fma(
            self.righting[0].get::<S>(i),
            y[0],
            m.mul(self.righting[1].get::<S>(i), y[2]),
        );
        let spin = m.fnma(self.turning.get::<S>(i), couple, righting);
        let up = two!(edge, m.fnma(arms[edge], spin, lift));
        let relief = two!(edge, m.sub(zero, self.relief[edge].get::<S>(i)));
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
        let step = Recursion::new(&body);
        let mut pressed = Box::<Pressed>::default();
        let (y, reached) = ([0.0; STATES], Reached::default());
        let sample = Sample::new(&body, &step);
        for lane in 0..LANES {
            pressed.enter(lane, &body, &step, &sample, &y, &reached);
        }
        let m = Math(pulp::Scalar::new());
        let found =
            |y: [f64; STATES], v: f64| pressed.found(m, 0, y.map(|y| m.splat(y)), m.splat(v));
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
