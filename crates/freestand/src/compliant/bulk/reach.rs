//! How far the numbers of a block may go within a sample or a stretch, by their bounds.

use pulp::Simd;

use super::Lane;
use super::body::Body;
use super::each::{each, two};
use super::linear::{BEND, Bounds, EdgeNumbers, LEVEL, Modes, SLOPE, STATES, UP, WEIGHED};
use super::look::Reached;
use crate::vector::{Masks, Math, Numbers};

/// A number in the lanes `i`: each lane has its own, or all have the same.
pub(super) trait InLanes {
    fn of<S: Simd>(&self, m: Math<S>, i: usize) -> Numbers<S>;
}

impl InLanes for Lane {
    #[inline(always)]
    fn of<S: Simd>(&self, _: Math<S>, i: usize) -> Numbers<S> {
        self.get::<S>(i)
    }
}

impl InLanes for f64 {
    #[inline(always)]
    fn of<S: Simd>(&self, m: Math<S>, _: usize) -> Numbers<S> {
        m.splat(*self)
    }
}

/// [`Modes`] and [`Bounds`].
#[derive(Debug, Clone, Default)]
pub(super) struct Reach<T> {
    into: [[T; 3]; 3],
    held: [T; 3],
    weights: [[T; WEIGHED]; 3],
}

impl Reach<f64> {
    pub(super) fn new(modes: &Modes, bounds: &Bounds) -> Self {
        Self {
            into: modes.into,
            held: modes.held,
            weights: [bounds.lost, bounds.press, bounds.up],
        }
    }
}

impl Reach<Lane> {
    /// Puts that of a world into a lane.
    pub(super) fn enter(&mut self, lane: usize, reach: &Reach<f64>) {
        let numbers = reach.into.iter().flatten().chain(&reach.held);
        let numbers = numbers.chain(reach.weights.iter().flatten());
        for (column, number) in self.columns().zip(numbers) {
            column[lane] = *number;
        }
    }

    /// Takes it out.
    pub(super) fn leave(&mut self, lane: usize) {
        self.columns().for_each(|column| column[lane] = 0.0);
    }

    fn columns(&mut self) -> impl Iterator<Item = &mut Lane> {
        let columns = self.into.iter_mut().flatten().chain(&mut self.held);
        columns.chain(self.weights.iter_mut().flatten())
    }
}

/// What is known to be reached.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Highest<T> {
    pub(super) lost: T,
    counts_to: T,
    pressed: T,
    /// Of each edge.
    peaks: [T; 2],
    /// The larger compression of both edges at rest.
    deepest: T,
}

impl Highest<f64> {
    pub(super) fn new(reached: &Reached, deepest_m: f64) -> Self {
        Self {
            lost: reached.lost,
            counts_to: reached.counts_to,
            pressed: reached.pressed,
            peaks: reached.peaks,
            deepest: deepest_m,
        }
    }

    /// The larger of each.
    pub(super) fn and(&self, other: &Self) -> Self {
        Self {
            lost: self.lost.max(other.lost),
            pressed: self.pressed.max(other.pressed),
            peaks: [0, 1].map(|edge: usize| self.peaks[edge].max(other.peaks[edge])),
            ..*self
        }
    }

    /// Whether a stretch with these bounds could find more.
    pub(super) fn is_below(&self, [lost, press, up]: &[f64; 3]) -> bool {
        let is_known = self.lost >= *lost
            && (self.lost > self.counts_to
                || self.pressed >= self.deepest + press && self.peaks[0].min(self.peaks[1]) >= *up);
        // Numbers that are none are looked at.
        !is_known
    }
}

impl Highest<Lane> {
    /// Puts that of a world into a lane.
    pub(super) fn enter(&mut self, lane: usize, highest: &Highest<f64>) {
        let numbers = [highest.lost, highest.counts_to, highest.pressed];
        let more = [highest.peaks[0], highest.peaks[1], highest.deepest];
        let numbers = numbers.into_iter().chain(more);
        for (column, number) in self.columns().into_iter().zip(numbers) {
            column[lane] = number;
        }
    }

    /// That of a lane.
    pub(super) fn of(&self, lane: usize) -> Highest<f64> {
        Highest {
            lost: self.lost[lane],
            counts_to: self.counts_to[lane],
            pressed: self.pressed[lane],
            peaks: self.peaks.each_ref().map(|column| column[lane]),
            deepest: self.deepest[lane],
        }
    }

    fn columns(&mut self) -> [&mut Lane; 6] {
        let [left, right] = &mut self.peaks;
        [
            &mut self.lost,
            &mut self.counts_to,
            &mut self.pressed,
            left,
            right,
            &mut self.deepest,
        ]
    }
}

/// What the edges do at an instant, lowered a little, so that the sample that reaches it is still looked at.
#[derive(Debug, Default)]
pub(super) struct AtOnce<T> {
    /// The part of its load that each edge has lost, by all but x and its rate.
    lost: [[T; 4]; 2],
    /// Its compression, at rest and by z and θ.
    press: [[T; 3]; 2],
    /// Its upward acceleration, by all but the rate of x.
    up: [[T; 5]; 2],
}

/// How much less: far more than rounding.
const LESS: f64 = 1.0 - 1e-9;

impl AtOnce<f64> {
    pub(super) fn new(body: &Body) -> Self {
        let edges = [0, 1].map(|edge| EdgeNumbers::new(body, edge));
        let sunk = body.rest.compressions;
        Self {
            lost: edges
                .each_ref()
                .map(|one| [1, 2, 4, 5].map(|k: usize| LESS * one.lost[k])),
            press: [0, 1].map(|edge: usize| {
                let press = &edges[edge].press;
                [sunk[edge], press[1], press[2]].map(|part| LESS * part)
            }),
            up: edges
                .each_ref()
                .map(|one| [0, 1, 2, 4, 5].map(|k: usize| LESS * one.up[k])),
        }
    }
}

impl AtOnce<Lane> {
    /// Puts that of a world into a lane.
    pub(super) fn enter(&mut self, lane: usize, of: &AtOnce<f64>) {
        let numbers = of.lost.iter().flatten();
        let numbers = numbers.chain(of.press.iter().flatten());
        let numbers = numbers.chain(of.up.iter().flatten());
        for (column, number) in self.columns().zip(numbers) {
            column[lane] = *number;
        }
    }

    /// Takes it out.
    pub(super) fn leave(&mut self, lane: usize) {
        self.columns().for_each(|column| column[lane] = 0.0);
    }

    fn columns(&mut self) -> impl Iterator<Item = &mut Lane> {
        let columns = self.lost.iter_mut().flatten();
        let columns = columns.chain(self.press.iter_mut().flatten());
        columns.chain(self.up.iter_mut().flatten())
    }
}

impl Highest<Lane> {
    /// With what the edges do at y.
    #[inline(always)]
    pub(super) fn with<S: Simd>(
        &mut self,
        m: Math<S>,
        i: usize,
        at_once: &AtOnce<Lane>,
        y: [Numbers<S>; STATES],
    ) {
        let (mut most, mut deepest) = (self.lost.get::<S>(i), self.pressed.get::<S>(i));
        for edge in 0..2 {
            let by = &at_once.lost[edge];
            let lost = m.mul(by[0].get::<S>(i), y[1]);
            let lost = m.fma(by[1].get::<S>(i), y[2], lost);
            let lost = m.fma(by[2].get::<S>(i), y[4], lost);
            most = m.larger(m.fma(by[3].get::<S>(i), y[5], lost), most);
            let by = &at_once.press[edge];
            let press = m.fma(by[1].get::<S>(i), y[1], by[0].get::<S>(i));
            deepest = m.larger(m.fma(by[2].get::<S>(i), y[2], press), deepest);
            let by = &at_once.up[edge];
            let up = m.mul(by[0].get::<S>(i), y[0]);
            let up = m.fma(by[1].get::<S>(i), y[1], up);
            let up = m.fma(by[2].get::<S>(i), y[2], up);
            let up = m.fma(by[3].get::<S>(i), y[4], up);
            let up = m.fma(by[4].get::<S>(i), y[5], up);
            let peak = self.peaks[edge].get::<S>(i);
            self.peaks[edge].set::<S>(i, m.larger(up, peak));
        }
        self.lost.set::<S>(i, most);
        self.pressed.set::<S>(i, deepest);
    }
}

/// What the base does: its horizontal acceleration at the start, and what else is weighed of it.
#[derive(Clone, Copy)]
pub(super) struct Does<S: Simd> {
    pub(super) level: Numbers<S>,
    pub(super) slope: Numbers<S>,
    /// Where there is more than one change.
    pub(super) bend: Option<Numbers<S>>,
    /// Where it moves vertically.
    pub(super) up: Option<Numbers<S>>,
}

impl<T: InLanes> Reach<T> {
    /// Whether a step could find more than is known, with y at the start and what the base does; and the bounds.
    #[inline(always)]
    pub(super) fn may_find<S: Simd>(
        &self,
        m: Math<S>,
        i: usize,
        y: [Numbers<S>; STATES],
        base: Does<S>,
        highest: &Highest<T>,
    ) -> (Masks<S>, [Numbers<S>; 3]) {
        let zero = m.splat(0.0);
        let places = each!(
            mode,
            {
                let into = &self.into[mode];
                let held = m.mul(self.held[mode].of(m, i), base.level);
                let place = m.fma(into[0].of(m, i), y[0], m.sub(zero, held));
                let place = m.fma(into[1].of(m, i), y[1], place);
                m.abs(m.fma(into[2].of(m, i), y[2], place))
            },
            0 1 2
        );
        let rates = each!(
            mode,
            {
                let into = &self.into[mode];
                let rate = m.mul(into[0].of(m, i), y[3]);
                let rate = m.fma(into[1].of(m, i), y[4], rate);
                m.abs(m.fma(into[2].of(m, i), y[5], rate))
            },
            0 1 2
        );
        let level = m.abs(base.level);
        let most = each!(
            of,
            {
                let weights = &self.weights[of];
                let mut one = m.mul(weights[LEVEL].of(m, i), level);
                let mut two = m.mul(weights[SLOPE].of(m, i), base.slope);
                if let Some(bend) = base.bend {
                    two = m.fma(weights[BEND].of(m, i), bend, two);
                }
                if let Some(up) = base.up {
                    one = m.fma(weights[UP].of(m, i), up, one);
                }
                one = m.fma(weights[0].of(m, i), places[0], one);
                two = m.fma(weights[1].of(m, i), places[1], two);
                one = m.fma(weights[2].of(m, i), places[2], one);
                two = m.fma(weights[3].of(m, i), rates[0], two);
                one = m.fma(weights[4].of(m, i), rates[1], one);
                two = m.fma(weights[5].of(m, i), rates[2], two);
                m.add(one, two)
            },
            0 1 2
        );
        let lost = highest.lost.of(m, i);
        let pressed = m.add(highest.deepest.of(m, i), most[1]);
        let pressed = m.ge(highest.pressed.of(m, i), pressed);
        let [left, right] = two!(edge, highest.peaks[edge].of(m, i));
        let up = m.ge(m.smaller(left, right), most[2]);
        // What follows from pads that pull does not count.
        let rest = m.or(m.gt(lost, highest.counts_to.of(m, i)), m.and(pressed, up));
        // Numbers that are none are looked at.
        (m.not(m.and(m.ge(lost, most[0]), rest)), most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliant::bulk::linear::{Recursion, Sample};
    use crate::compliant::bulk::look::{Look, Looking, Wanted};
    use crate::compliant::bulk::tests::{leaning, soft};

    /// What the edges do at the end of a sample is found in it, and little more than what is said before it is looked
    /// at: bodies that are pressed and turned about as much as they are at rest, each another way.
    #[test]
    fn what_edges_do_at_once_is_found() {
        let m = Math(pulp::Scalar::new());
        for body in [leaning(), soft()] {
            let step = Recursion::new(&body);
            let sample = Sample::new(&body, &step);
            let look = Look::new(&body, step);
            let mut at_once = AtOnce::<Lane>::default();
            at_once.enter(0, &AtOnce::new(&body));
            let mut looking = Looking::default();
            let mut closest = [0.0_f64; 4];
            for case in 0..400 {
                let part = |k: usize| (f64::from(case) * [0.7, 1.1, 1.9, 2.3, 3.1, 4.3][k]).sin();
                let y: [f64; STATES] = std::array::from_fn(|k| body.rest.compressions[0] * part(k));
                let mut reached = Reached {
                    counts_to: f64::INFINITY,
                    ..Reached::default()
                };
                let wanted = Wanted {
                    y,
                    horizontal: [0.0; 2],
                    vertical: [0.0; 2],
                    sample: 0,
                };
                looking.at(pulp::Arch::new(), &look, &[wanted], &mut reached);
                let still = [m.splat(0.0); 2];
                let end = sample
                    .recursion
                    .after(m, y.map(|y| m.splat(y)), still, still);
                let mut highest = Highest::<Lane>::default();
                highest.with(m, 0, &at_once, end);
                let said = highest.of(0);
                let pairs = [
                    (said.lost, reached.lost),
                    (said.pressed, reached.pressed),
                    (said.peaks[0], reached.peaks[0]),
                    (said.peaks[1], reached.peaks[1]),
                ];
                for (closest, (said, found)) in closest.iter_mut().zip(pairs) {
                    assert!(said <= found, "{case}: {said} {found}");
                    if found > 0.0 {
                        *closest = closest.max(said / found);
                    }
                }
            }
            // Some end where they reach most: there it is what is taken off on purpose.
            assert!(
                closest.iter().all(|ratio| *ratio > 1.0 - 2e-9),
                "{closest:?}"
            );
        }
    }
}
