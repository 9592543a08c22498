//! The length of steps, and the search for the event that ends one: for any equation of motion.

use super::step::Step;
use super::{CompliantEffort, CompliantError};
use crate::motion::Motion;

/// The longest interval between two checks for an event, as an angle of the vibration on the cushions: no contact begins
/// and ends within one.
const CHECK_RAD: f64 = 0.25;
/// A step ends at most this long after an event, as an angle of that vibration; no step is shorter.
const EVENT_RAD: f64 = 1e-12;
const SHORTEST_RAD: f64 = 1e-10;
/// A step shorter than this angle does not gain accuracy; it is lost in rounding.
const LOST_RAD: f64 = 1e-13;
/// Trial steps to locate one event; false position usually takes five.
const EVENT_TRIALS: usize = 80;

/// A straight segment of the accelerations of the base \[m/s²\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line<const D: usize> {
    pub(crate) start: [f64; D],
    /// Change per second.
    pub(crate) slope: [f64; D],
    pub(crate) start_s: f64,
}

impl<const D: usize> Line<D> {
    pub(crate) const STILL: Self = Self {
        start: [0.0; D],
        slope: [0.0; D],
        start_s: 0.0,
    };

    pub(crate) fn at(&self, time_s: f64) -> [f64; D] {
        let since = time_s - self.start_s;
        std::array::from_fn(|axis| self.start[axis] + self.slope[axis] * since)
    }

    pub(crate) fn is_still(&self) -> bool {
        self.start == [0.0; D] && self.slope == [0.0; D]
    }

    /// The segment of the base's motion that begins at sample `index`, and its end; after the last
    /// sample the base comes to rest within one time step.
    pub(crate) fn of(motions: [Option<&Motion>; D], index: usize, end_s: f64) -> (Self, f64) {
        let Some(given) = motions.into_iter().flatten().next() else {
            return (Self::STILL, end_s);
        };
        let (dt_s, samples) = (given.dt_s(), given.accel_m_s2().len());
        if index >= samples {
            return (
                Self {
                    start_s: index as f64 * dt_s,
                    ..Self::STILL
                },
                end_s,
            );
        }
        let at = |index: usize| {
            motions.map(|motion| {
                motion
                    .and_then(|motion| motion.accel_m_s2().get(index))
                    .copied()
                    .unwrap_or(0.0)
            })
        };
        let (start, end) = (at(index), at(index + 1));
        let slope = std::array::from_fn(|axis| (end[axis] - start[axis]) / dt_s);
        (
            Self {
                start,
                slope,
                start_s: index as f64 * dt_s,
            },
            ((index + 1) as f64 * dt_s).min(end_s),
        )
    }

    /// Whether two of the motions differ in time step or length.
    pub(crate) fn mismatch(motions: [Option<&Motion>; D]) -> bool {
        let mut given = motions.into_iter().flatten();
        let Some(first) = given.next() else {
            return false;
        };
        given.any(|other| {
            other.dt_s() != first.dt_s() || other.accel_m_s2().len() != first.accel_m_s2().len()
        })
    }
}

/// The step that a solver tries.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Trial {
    pub(crate) start_s: f64,
    pub(crate) try_s: f64,
    /// No step is longer.
    pub(crate) longest_s: f64,
    /// Time left until the next kink of the motion.
    pub(crate) rest_s: f64,
    /// 1/ω of the vibration on the cushions.
    pub(crate) unit_s: f64,
    /// How near to an event the interpolating polynomial is searched before new steps are taken, as a margin; `None`: not at all.
    pub(crate) near: Option<f64>,
    /// How far past an event the step may end, as a margin.
    pub(crate) close: f64,
}

/// What [`next`] found out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Found {
    /// Length to try after the step.
    pub(crate) grow_s: f64,
    pub(crate) has_event: bool,
    /// Whether an accurate step, which an event may have shortened, reached the kink of the motion.
    pub(crate) reached_kink: bool,
}

/// Takes a step that is accurate and ends no later than its first event. `take` takes a step of the given length and returns its error ratio; only where
/// `may_have_event` is a step searched; `margin` is negative past an event, and anything from its last argument on counts as much as that.
pub(crate) fn next<const N: usize>(
    step: &mut Step<N>,
    trial: Trial,
    take: impl Fn(&mut Step<N>, f64) -> f64,
    may_have_event: impl Fn(&Step<N>) -> bool,
    margin: impl Fn(f64, &[f64; N], f64) -> f64 + Copy,
    effort: &mut CompliantEffort,
) -> Result<Found, CompliantError> {
    let evaluations = step.evaluations();
    let take_one = |length_s: f64| take(step, length_s);
    let grow_s = accurate(trial, take_one, evaluations, effort)?;
    let reached_kink = step.length_s == trial.rest_s;
    let is_past = |time_s: f64, y: &[f64; N]| margin(time_s, y, 0.0) < 0.0;
    let event = may_have_event(step)
        .then(|| first_event(step, trial.unit_s, is_past))
        .flatten();
    if let Some(share) = event {
        let margin = |time_s: f64, y: &[f64; N]| margin(time_s, y, f64::INFINITY);
        let share = trial
            .near
            .map_or(share, |near| nearer(step, share, near, margin));
        // Never so short that rounding decides.
        let shortest_s = SHORTEST_RAD * trial.unit_s;
        let length_s = (share * step.length_s).max(shortest_s).min(step.length_s);
        shortened(step, length_s, trial, take, margin, effort);
    }
    Ok(Found {
        grow_s,
        has_event: event.is_some(),
        reached_kink,
    })
}

/// Takes a step that is accurate enough, and returns the length to try next. `take` takes a step of
/// the given length and returns its error ratio.
fn accurate(
    trial: Trial,
    mut take: impl FnMut(f64) -> f64,
    evaluations: usize,
    effort: &mut CompliantEffort,
) -> Result<f64, CompliantError> {
    let mut length_s = trial.try_s.min(trial.longest_s);
    if length_s >= trial.rest_s {
        length_s = trial.rest_s;
    } else if 2.0 * length_s > trial.rest_s {
        length_s = 0.5 * trial.rest_s;
    }
    loop {
        let error_ratio = take(length_s);
        effort.evaluations += evaluations;
        if error_ratio <= 1.0 {
            return Ok(grown(length_s, error_ratio, trial.longest_s));
        }
        effort.rejected += 1;
        // NaN where a trial went past the end of a bottoming cushion.
        let shrink = if error_ratio.is_finite() {
            0.9 * error_ratio.powf(-0.2)
        } else {
            0.1
        };
        length_s *= shrink.clamp(0.1, 0.9);
        if length_s < LOST_RAD * trial.unit_s {
            return Err(CompliantError::StepTooSmall {
                time_s: trial.start_s,
                step_s: length_s,
            });
        }
    }
}

/// The length to try after a step of this length and error; from `longest_s` on, any length counts as much as that.
fn grown(length_s: f64, error_ratio: f64, longest_s: f64) -> f64 {
    const MOST: f64 = 4.0;
    const SAFETY: f64 = 0.9;
    // Most steps are limited by samples and need no root. The margin is far more than its rounding.
    let wanted = (longest_s / length_s).min(MOST) * (1.0 + 1e-9);
    if error_ratio <= (SAFETY / wanted).powi(5) {
        return MOST.min(wanted) * length_s;
    }
    let growth = (SAFETY * error_ratio.powf(-0.2)).clamp(0.5, MOST);
    growth * length_s
}

/// A share of the step by which an event has passed, if there is one.
fn first_event<const N: usize>(
    step: &mut Step<N>,
    unit_s: f64,
    is_past: impl Fn(f64, &[f64; N]) -> bool,
) -> Option<f64> {
    let checks = (step.length_s / (CHECK_RAD * unit_s))
        .ceil()
        .clamp(2.0, 8.0);
    (1..=checks as u32)
        .map(|check| f64::from(check) / checks)
        .find(|&share| {
            let time_s = step.start_s + share * step.length_s;
            if share == 1.0 {
                is_past(time_s, &step.end)
            } else {
                is_past(time_s, step.look(share))
            }
        })
}

/// A share of the step just past the first event before `share`, by false position on the
/// interpolating polynomial: a close bracket for [`shortened`], without new steps. `close` is about
/// the error of the polynomial.
fn nearer<const N: usize>(
    step: &mut Step<N>,
    share: f64,
    close: f64,
    margin: impl Fn(f64, &[f64; N]) -> f64,
) -> f64 {
    let (mut low, mut low_margin) = (0.0, margin(step.start_s, &step.start));
    let (start_s, length_s) = (step.start_s, step.length_s);
    let mut at = |share: f64| margin(start_s + share * length_s, step.look(share));
    let (mut high, mut high_margin) = (share, at(share));
    let mut last_side = 0;
    for _ in 0..EVENT_TRIALS {
        if high_margin > -close || high - low < close {
            break;
        }
        // An element that has just changed may still be past its event at the start, by rounding.
        let ratio = low_margin / (low_margin - high_margin);
        let inside = if low_margin > 0.0 && ratio.is_finite() {
            ratio.clamp(1e-6, 1.0 - 1e-6)
        } else {
            0.5
        };
        let middle = low + inside * (high - low);
        let margin = at(middle);
        if margin < 0.0 {
            (high, high_margin) = (middle, margin);
            if last_side == 1 {
                low_margin *= 0.5;
            }
            last_side = 1;
        } else {
            (low, low_margin) = (middle, margin);
            if last_side == -1 {
                high_margin *= 0.5;
            }
            last_side = -1;
        }
    }
    // Past the error of the polynomial, so that the event is inside.
    (high + close).min(share)
}

/// Takes the step that ends just past the first event within `length_s`, located by false position with
/// new steps, so that nothing after the event affects it,
/// and a margin of −`close` is near enough.
fn shortened<const N: usize>(
    step: &mut Step<N>,
    length_s: f64,
    Trial { unit_s, close, .. }: Trial,
    take: impl Fn(&mut Step<N>, f64) -> f64,
    margin: impl Fn(f64, &[f64; N]) -> f64,
    effort: &mut CompliantEffort,
) {
    let shortest_s = SHORTEST_RAD * unit_s;
    let mut low_margin = margin(step.start_s, &step.start);
    let mut margin_after = |step: &mut Step<N>, length_s: f64| {
        effort.evaluations += step.evaluations();
        take(step, length_s);
        margin(step.start_s + step.length_s, &step.end)
    };
    let mut low = 0.0;
    let (mut high, mut high_margin) = (length_s, margin_after(step, length_s));
    let mut last_side = 0;
    let mut trial = None;
    for _ in 0..EVENT_TRIALS {
        if high_margin >= -close || high - low <= EVENT_RAD * unit_s || high <= shortest_s {
            break;
        }
        let ratio = low_margin / (low_margin - high_margin);
        let share = if low_margin > 0.0 && ratio.is_finite() {
            ratio.clamp(1e-6, 1.0 - 1e-6)
        } else {
            0.5
        };
        let middle = low + share * (high - low);
        if low_margin <= 0.0 && middle < shortest_s {
            break;
        }
        let trial = trial.get_or_insert_with(|| step.clone());
        let margin = margin_after(trial, middle);
        if margin < 0.0 {
            (high, high_margin) = (middle, margin);
            std::mem::swap(step, trial);
            if last_side == 1 {
                low_margin *= 0.5;
            }
            last_side = 1;
            if margin > -1e-13 {
                break;
            }
        } else {
            (low, low_margin) = (middle, margin);
            if last_side == -1 {
                high_margin *= 0.5;
            }
            last_side = -1;
        }
    }
    if step.length_s < shortest_s {
        margin_after(step, shortest_s.min(length_s));
    }
}
