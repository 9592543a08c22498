//! A step of a history in space, as those see it who evaluate it.

use super::element::Role;
use super::equation::{Grips, LEN, Poses, State, World};
use crate::compliant::HEADROOM;
use crate::compliant::step::Step;
use crate::search::falls;

/// The cubic through the values and rates at both ends of a step reaches at least this share of a maximum within the
/// step. Error control limits the steps of a visible vibration to a third of a radian; the cubic then misses less than
/// 1e-4.
const CUBIC_NEAR: f64 = 0.98;

/// How near to the place of a maximum its search ends, as a share of the step: the value is accurate to its square.
const TOP_WITHIN: f64 = 1e-8;

/// How the bodies of a stack move at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pattern {
    /// Neither body has an edge off its support.
    Rest,
    /// Both rock, about edges on the same side.
    Same,
    /// Both rock, about edges on opposite sides.
    Opposite,
    /// The lower body rocks and carries the upper one along.
    Together,
    /// The upper body rocks alone.
    UpperAlone,
}

/// A step with everything needed to evaluate it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen<'a, 'b> {
    pub(super) world: &'a World<'b>,
    pub(super) grips: &'a Grips,
    pub(super) step: &'a Step<LEN>,
    /// The poses at its start and at its end.
    pub(super) ends: [&'a Poses; 2],
}

impl Seen<'_, '_> {
    /// How the bodies of a stack move in the middle of the step.
    pub(super) fn pattern(&self) -> Pattern {
        let is_open = |role: Role| {
            self.world
                .elements
                .iter()
                .zip(self.grips.each())
                .any(|(element, grip)| element.role == role && !grip.carries())
        };
        let middle = self.poses(0.5);
        let [lower, upper] = [middle[0], middle[1]].map(|pose| tilts(&pose.axis().0)[0]);
        match (is_open(Role::Base), is_open(Role::Interface)) {
            (false, false) => Pattern::Rest,
            (true, false) => Pattern::Together,
            (false, true) => Pattern::UpperAlone,
            (true, true) if lower * (upper - lower) >= 0.0 => Pattern::Same,
            (true, true) => Pattern::Opposite,
        }
    }

    pub(super) fn time_s(&self, share: f64) -> f64 {
        self.step.start_s + share * self.step.length_s
    }

    pub(super) fn state(&self, share: f64) -> State {
        if share == 0.0 {
            self.step.start
        } else if share == 1.0 {
            self.step.end
        } else {
            self.step.state(share)
        }
    }

    pub(super) fn poses(&self, share: f64) -> Poses {
        if share == 0.0 {
            *self.ends[0]
        } else if share == 1.0 {
            *self.ends[1]
        } else {
            self.world.poses_in(self.step, share)
        }
    }

    /// The largest value of the cubic with these values and rates at the ends; its rate is positive at the start and
    /// not at the end.
    fn top(&self, [from, to]: [(f64, f64); 2]) -> f64 {
        let [rise, fall] = [from.1, to.1].map(|rate| rate * self.step.length_s);
        let change = to.0 - from.0;
        let (bend, twist) = (3.0 * change - 2.0 * rise - fall, rise + fall - 2.0 * change);
        // rise + 2 bend s + 3 twist s² = 0, without cancellation.
        let root = (bend * bend - 3.0 * twist * rise).sqrt();
        let share = if bend > 0.0 {
            (-bend - root) / (3.0 * twist)
        } else {
            rise / (root - bend)
        };
        from.0 + share * (rise + share * (bend + share * twist))
    }

    /// The share of the step at which a value is largest, if it may exceed `best`: at an end, or
    /// where its rate falls through zero. `of` gives the value and its rate.
    pub(super) fn crest(&self, best: f64, of: impl Fn(&Poses) -> (f64, f64)) -> Option<(f64, f64)> {
        self.crest_between(best, self.ends.map(&of), of)
    }

    /// [`Seen::crest`] with the value and its rate known at both ends.
    #[inline]
    pub(super) fn crest_between(
        &self,
        best: f64,
        [from, to]: [(f64, f64); 2],
        of: impl Fn(&Poses) -> (f64, f64),
    ) -> Option<(f64, f64)> {
        let ends = from.0.max(to.0);
        if ends <= 0.0 || ends < HEADROOM * best {
            return None;
        }
        let mut most = if from.0 > to.0 {
            (0.0, from.0)
        } else {
            (1.0, to.0)
        };
        let crests = from.1 > 0.0 && to.1 <= 0.0;
        // If a value or rate is infinite, the cubic is NaN and the step is searched.
        let is_low = crests && self.top([from, to]) < CUBIC_NEAR * best;
        if crests && !is_low {
            let inside = |share: f64| of(&self.poses(share));
            let share = falls((0.0, from.1), (1.0, to.1), TOP_WITHIN, |share| {
                inside(share).1
            });
            let top = inside(share).0;
            if top > most.1 {
                most = (share, top);
            }
        }
        (most.1 > best).then_some(most)
    }
}

/// `tilt_x` and `tilt_y` of an axis; a history ends where it is horizontal, within rounding.
pub(super) fn tilts(axis: &[f64; 3]) -> [f64; 2] {
    let up = axis[2].max(0.0);
    [axis[0].atan2(up), axis[1].atan2(up)]
}
