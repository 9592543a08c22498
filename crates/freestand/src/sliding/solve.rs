//! The sliding block, from event to event.

use super::{Clearance, Friction, Sliding, SlidingError, SlidingOptions, SlidingOutcome};
use crate::motion::Motion;
use crate::rocking::{Base, RockingError, Until};
use crate::search::bisect;

/// The slide of a block under the motion of its base.
///
/// **Units**: SI; times are counted from the first sample.
///
/// # Errors
/// Input outside the range of the model. Free flight is an outcome, not an error.
///
/// # Example
/// A floor that jumps to 0.6 g for 0.5 s, under a coefficient of friction of 0.2: the block slides
/// A g T²(A−N)/(2N) to the left. (Straight lines between samples need 1 ms for each jump.)
/// ```
/// use freestand::motion::Motion;
/// use freestand::rocking::{Base, Until};
/// use freestand::sliding::{Friction, SlidingOptions, slide};
/// let g = 9.80665;
/// let mut accel = vec![0.6 * g; 501];
/// accel.extend([0.0; 2]);
/// let motion = Motion::new(0.001, accel)?;
/// let until = Until::Settled { at_most_s: 10.0 };
/// let options = SlidingOptions { until, ..SlidingOptions::new(Friction::uniform(0.2)?) };
/// let sliding = slide(Base { horizontal: Some(&motion), vertical: None }, &options)?;
/// let exact = -0.6 * g * 0.5 * 0.5 * (0.6 - 0.2) / (2.0 * 0.2);
/// assert!((sliding.final_m - exact).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn slide(base: Base, options: &SlidingOptions) -> Result<Sliding, SlidingError> {
    slide_observed(base, options, |_| ())
}

/// [`slide`], which also passes every piece of the history to `observe` in order: one piece for each
/// sample interval, and more where an event divides it.
///
/// # Errors
/// Those of [`slide`].
pub fn slide_observed(
    base: Base,
    options: &SlidingOptions,
    observe: impl FnMut(&SlidingPiece),
) -> Result<Sliding, SlidingError> {
    options.check()?;
    let intervals = Intervals::new(base, options)?;
    Ok(Slider::new(options, observe)
        .run(&intervals, matches!(options.until, Until::Settled { .. })))
}

/// A part of a history without events: x is a cubic of time in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingPiece {
    /// Time at which it starts \[s\].
    pub start_s: f64,
    /// Its length \[s\].
    pub length_s: f64,
    /// x at its start \[m\].
    pub slide_m: f64,
    /// ẋ at its start \[m/s\].
    pub velocity_m_s: f64,
    /// ẍ at its start, 0 while the block sticks \[m/s²\].
    pub accel_m_s2: f64,
    /// Rate of ẍ \[m/s³\].
    pub jerk_m_s3: f64,
}

impl SlidingPiece {
    /// x and ẋ, `tau_s` after the start \[m, m/s\].
    pub fn state(&self, tau_s: f64) -> (f64, f64) {
        let Self {
            slide_m: x,
            velocity_m_s: v,
            accel_m_s2: a,
            jerk_m_s3: j,
            ..
        } = *self;
        (
            x + tau_s * travelled(v, a, j, tau_s),
            v + tau_s * (a + 0.5 * tau_s * j),
        )
    }
}

/// The mean velocity over `tau`.
#[inline(always)]
fn travelled(v: f64, a: f64, j: f64, tau: f64) -> f64 {
    v + tau * (0.5 * a + tau * (j / 6.0))
}

/// What is this small, relative to the motion or to the largest speed, may be rounding: some thousand roundings of
/// the times and speeds before it. A block whose speed only touches 0 sticks there, and one that stops at the
/// threshold sticks. With μ_k < μ_s it would go on otherwise, with a whole acceleration of up to (μ_s + μ_k) g, and
/// rounding must not choose.
const TIE: f64 = 1e-12;

/// One straight line of the motion: ü_h and the weight per mass, g + ü_v, at both ends.
#[derive(Debug, Clone, Copy)]
struct Interval {
    start_s: f64,
    length_s: f64,
    /// 1/length, once for all blocks.
    per_s: f64,
    u: [f64; 2],
    weight: [f64; 2],
}

/// The base acceleration as straight lines: between the samples, back to zero after the last one,
/// and at rest until the end.
struct Intervals<'a> {
    horizontal: &'a [f64],
    vertical: &'a [f64],
    samples: usize,
    dt_s: f64,
    per_s: f64,
    gravity: f64,
    end_s: f64,
}

impl<'a> Intervals<'a> {
    fn new(base: Base<'a>, options: &SlidingOptions) -> Result<Self, SlidingError> {
        base.check()?;
        let given = base.horizontal.or(base.vertical);
        let record_s = given.map_or(0.0, Motion::duration_s);
        let end_s = match options.until {
            Until::EndOfMotion => record_s,
            Until::Time(end_s) => end_s,
            Until::Settled { at_most_s } => record_s + at_most_s,
        };
        if !(end_s > 0.0 && end_s.is_finite()) {
            return Err(RockingError::Duration { duration_s: end_s }.into());
        }
        let dt_s = given.map_or(end_s, Motion::dt_s);
        Ok(Self {
            horizontal: base.horizontal.map_or(&[], Motion::accel_m_s2),
            vertical: base.vertical.map_or(&[], Motion::accel_m_s2),
            samples: given.map_or(0, |m| m.accel_m_s2().len()),
            dt_s,
            per_s: 1.0 / dt_s,
            gravity: options.gravity_m_s2,
            end_s,
        })
    }

    #[inline(always)]
    fn at(&self, i: usize) -> (f64, f64) {
        let sample = |of: &[f64]| of.get(i).copied().unwrap_or(0.0);
        (
            sample(self.horizontal),
            self.gravity + sample(self.vertical),
        )
    }

    /// Interval `i`; `None` after the end. Number `samples` is the quiet one after the motion.
    #[inline(always)]
    fn get(&self, i: usize) -> Option<Interval> {
        let start_s = i as f64 * self.dt_s;
        if start_s >= self.end_s || i > self.samples {
            return None;
        }
        let ((u, w), (u_next, w_next)) = (self.at(i), self.at(i + 1));
        let (u, weight) = ([u, u_next], [w, w_next]);
        let whole = Interval {
            start_s,
            length_s: self.dt_s,
            per_s: self.per_s,
            u,
            weight,
        };
        if i == self.samples {
            let length_s = self.end_s - start_s;
            return Some(Interval {
                length_s,
                per_s: 1.0 / length_s,
                ..whole
            });
        }
        // The end may cut an interval; rounding must not cut a last interval that is whole.
        let is_whole = (i + 1) as f64 * self.dt_s <= self.end_s;
        Some(if is_whole {
            whole
        } else {
            whole.cut(self.end_s - start_s)
        })
    }
}

impl Interval {
    /// ü_h and g + ü_v at `tau`.
    #[inline(always)]
    fn after(&self, tau: f64) -> (f64, f64) {
        if tau == 0.0 {
            // The usual case.
            return (self.u[0], self.weight[0]);
        }
        let share = tau * self.per_s;
        let at = |[from, to]: [f64; 2]| from + (to - from) * share;
        (at(self.u), at(self.weight))
    }

    /// Whether a block at rest at `tau` sticks: |ü_h| is not above the threshold by more than rounding.
    #[inline(always)]
    fn holds(&self, limit: f64, tau: f64) -> bool {
        let (u, weight) = self.after(tau);
        u.abs() <= limit * weight + self.tie()
    }

    /// What rounding may make of ü_h in it.
    #[inline(always)]
    fn tie(&self) -> f64 {
        TIE * self.u[0].abs().max(self.u[1].abs())
    }

    /// The first `length_s` of it.
    fn cut(&self, length_s: f64) -> Self {
        let (u, weight) = self.after(length_s);
        Self {
            length_s,
            per_s: 1.0 / length_s,
            u: [self.u[0], u],
            weight: [self.weight[0], weight],
            ..*self
        }
    }

    /// When the floor falls away, if it does.
    #[inline(always)]
    fn free_flight(&self) -> Option<f64> {
        let [from, to] = self.weight;
        if from <= 0.0 {
            Some(0.0)
        } else if to <= 0.0 {
            Some(self.length_s * (from / (from - to)))
        } else {
            None
        }
    }
}

/// What the block is doing.
#[derive(Debug, Clone, Copy)]
enum Phase {
    Stuck,
    /// Sliding to the right (`sense` = 1) or to the left (−1). `speed` is 0 where it has just begun.
    Sliding {
        sense: f64,
        speed: f64,
    },
}

struct Slider<F: FnMut(&SlidingPiece)> {
    friction: Friction,
    clearance: Clearance,
    phase: Phase,
    result: Sliding,
    observe: F,
}

impl<F: FnMut(&SlidingPiece)> Slider<F> {
    fn new(options: &SlidingOptions, observe: F) -> Self {
        let result = Sliding {
            outcome: SlidingOutcome::Stuck,
            end_time_s: 0.0,
            peak_m: 0.0,
            peak_time_s: None,
            final_m: 0.0,
            final_velocity_m_s: 0.0,
            path_m: 0.0,
            speed_max_m_s: 0.0,
            slide_count: 0,
            first_slide_time_s: None,
            contact: None,
        };
        Self {
            friction: options.friction,
            clearance: options.clearance,
            phase: Phase::Stuck,
            result,
            observe,
        }
    }

    fn run(mut self, intervals: &Intervals, settle: bool) -> Sliding {
        let mut index = 0;
        while let Some(interval) = intervals.get(index) {
            if settle && index >= intervals.samples && matches!(self.phase, Phase::Stuck) {
                break;
            }
            if let Some(at) = interval.free_flight() {
                if at > 0.0 {
                    self.pass(&interval.cut(at), false);
                }
                self.result.outcome = SlidingOutcome::FreeFlight;
                self.result.end_time_s = interval.start_s + at;
                break;
            }
            // The quiet interval is long; a block that settles in it ends there.
            let end_s = self.pass(&interval, settle && index >= intervals.samples);
            self.result.end_time_s = end_s;
            index += 1;
        }
        self.finish()
    }

    /// Calculates one interval, event by event, or up to the first stop if `settle`; returns the
    /// time reached.
    #[inline(always)]
    fn pass(&mut self, interval: &Interval, settle: bool) -> f64 {
        let whole_s = interval.start_s + interval.length_s;
        // A straight line cannot pass the threshold between two points that are both below it.
        let limit = self.friction.static_ratio();
        let sticks = |i: usize| interval.u[i].abs() <= limit * interval.weight[i];
        if matches!(self.phase, Phase::Stuck) && sticks(0) && sticks(1) {
            self.observe_rest(interval, 0.0, interval.length_s);
            return whole_s;
        }
        let mut tau = 0.0;
        while tau < interval.length_s {
            match self.phase {
                Phase::Stuck => {
                    let onset = onset(interval, limit, tau);
                    self.observe_rest(interval, tau, onset.map_or(interval.length_s, |(_, at)| at));
                    let Some((sense, at)) = onset else {
                        return whole_s;
                    };
                    tau = at;
                    self.phase = Phase::Sliding { sense, speed: 0.0 };
                    self.result.outcome = SlidingOutcome::Slid;
                    self.result.slide_count += 1;
                    self.result
                        .first_slide_time_s
                        .get_or_insert(interval.start_s + tau);
                }
                Phase::Sliding { sense, speed } => tau = self.advance(interval, tau, sense, speed),
            }
            if settle && matches!(self.phase, Phase::Stuck) {
                return interval.start_s + tau;
            }
        }
        whole_s
    }

    /// Slides from `tau` to the next stop or the end of the interval; returns the time reached.
    #[inline(always)]
    fn advance(&mut self, interval: &Interval, tau: f64, sense: f64, speed: f64) -> f64 {
        let [u0, u1] = interval.u;
        let [w0, w1] = interval.weight;
        let kinetic = self.friction.kinetic_ratio();
        let (u, weight) = interval.after(tau);
        let mut accel = -sense * u - kinetic * weight;
        let jerk = (-sense * (u1 - u0) - kinetic * (w1 - w0)) * interval.per_s;
        if speed == 0.0 {
            // Over the threshold the base pulls at least as strongly as friction holds; at an onset
            // with μ_k = μ_s the difference is zero, and must not be negative by rounding.
            accel = accel.max(0.0);
        }
        let rest = interval.length_s - tau;
        let least = TIE * self.result.speed_max_m_s;
        let stop = stop(speed, accel, jerk, rest, least);
        let used = stop.unwrap_or(rest);
        let before = self.result.final_m;
        let (piece, start_s) = ((speed, accel, jerk), interval.start_s + tau);
        (self.observe)(&SlidingPiece {
            start_s,
            length_s: used,
            slide_m: before,
            velocity_m_s: sense * speed,
            accel_m_s2: sense * accel,
            jerk_m_s3: sense * jerk,
        });
        let step = (used * travelled(speed, accel, jerk, used)).max(0.0);
        let after = before + sense * step;
        self.meet(before, after, sense, piece, start_s, used);
        self.result.path_m += step;
        self.result.final_m = after;
        let end_speed = (speed + used * (accel + 0.5 * used * jerk)).max(0.0);
        let mut fastest = end_speed;
        if accel > 0.0 && accel + jerk * used < 0.0 {
            // ẍ = 0 within the step; jerk < 0.
            fastest = speed - 0.5 * accel * (accel / jerk);
        }
        self.result.speed_max_m_s = self.result.speed_max_m_s.max(fastest);
        if stop.is_none() {
            self.phase = Phase::Sliding {
                sense,
                speed: end_speed,
            };
            return interval.length_s;
        }
        // Rounding may leave a stop at the instant of its onset: every step takes some time.
        let end = (tau + used).max(tau.next_up()).min(interval.length_s);
        self.note_peak(interval.start_s + end);
        self.phase = if interval.holds(self.friction.static_ratio(), end) {
            Phase::Stuck
        } else {
            Phase::Sliding {
                sense: -interval.after(end).0.signum(),
                speed: 0.0,
            }
        };
        end
    }

    /// Notes the first time at which the block reaches a clearance.
    #[inline(always)]
    fn meet(
        &mut self,
        before: f64,
        after: f64,
        sense: f64,
        piece: (f64, f64, f64),
        start_s: f64,
        used: f64,
    ) {
        let side = if sense > 0.0 {
            self.clearance.right_m
        } else {
            self.clearance.left_m
        };
        let Some(limit) = side else { return };
        let (from, to) = (sense * before, sense * after);
        if self.result.contact.is_some() || !(from <= limit && to >= limit && to > from) {
            return;
        }
        let (speed, accel, jerk) = piece;
        // The block moves one way in a step, so the cubic is monotonic.
        let at = bisect(0.0, used, |tau| {
            from + tau * travelled(speed, accel, jerk, tau) >= limit
        });
        let at = if from >= limit { 0.0 } else { at };
        let met = speed + at * (accel + 0.5 * at * jerk);
        self.result.contact = Some((start_s + at, sense * met.max(0.0)));
    }

    fn observe_rest(&mut self, interval: &Interval, from: f64, to: f64) {
        (self.observe)(&SlidingPiece {
            start_s: interval.start_s + from,
            length_s: to - from,
            slide_m: self.result.final_m,
            velocity_m_s: 0.0,
            accel_m_s2: 0.0,
            jerk_m_s3: 0.0,
        });
    }

    fn note_peak(&mut self, time_s: f64) {
        if self.result.final_m.abs() > self.result.peak_m.abs() {
            (self.result.peak_m, self.result.peak_time_s) = (self.result.final_m, Some(time_s));
        }
    }

    fn finish(mut self) -> Sliding {
        self.note_peak(self.result.end_time_s);
        if let Phase::Sliding { sense, speed } = self.phase {
            self.result.final_velocity_m_s = sense * speed;
        }
        self.result
    }
}

/// The sense in which a stuck block begins to slide within the rest of an interval, and when.
fn onset(interval: &Interval, limit: f64, tau: f64) -> Option<(f64, f64)> {
    let ((u, weight), (u_end, weight_end)) =
        (interval.after(tau), (interval.u[1], interval.weight[1]));
    let mut first: Option<(f64, f64)> = None;
    for sense in [-1.0, 1.0] {
        // How far |ü_h| is below the threshold, for a base that moves against the sense.
        let (from, to) = (
            limit * weight + sense * u,
            limit * weight_end + sense * u_end,
        );
        // At the threshold, to rounding, the block slides only where |ü_h| rises.
        let at = if from < -interval.tie() {
            tau
        } else if to < from.min(0.0) {
            tau + (interval.length_s - tau) * (from.max(0.0) / (from.max(0.0) - to))
        } else {
            continue;
        };
        if at < interval.length_s && first.is_none_or(|(_, earliest)| at < earliest) {
            first = Some((sense, at));
        }
    }
    first
}

/// The first time in (0, rest] at which speed + accel τ + jerk τ²/2, which starts at or above 0,
/// returns to 0, or down to `least`, which is 0 to rounding.
#[inline(always)]
fn stop(speed: f64, accel: f64, jerk: f64, rest: f64, least: f64) -> Option<f64> {
    let end = speed + rest * (accel + 0.5 * rest * jerk);
    // Bernstein coefficients on the interval: all positive, no root.
    if end > least && speed + 0.5 * rest * accel > 0.0 {
        return None;
    }
    let root = if speed == 0.0 {
        if jerk < 0.0 {
            -2.0 * accel / jerk
        } else {
            f64::INFINITY
        }
    } else {
        let discriminant = accel * accel - 2.0 * jerk * speed;
        if discriminant < 0.0 {
            // The speed is smallest, and touches 0, where ẍ = 0.
            let touch = -accel / jerk;
            if touch > 0.0 && speed + 0.5 * touch * accel <= least {
                touch
            } else {
                f64::INFINITY
            }
        } else if accel > 0.0 {
            // Only a falling acceleration stops it; the larger root, without cancellation.
            if jerk < 0.0 {
                (accel + discriminant.sqrt()) / -jerk
            } else {
                f64::INFINITY
            }
        } else {
            // The smaller positive root; infinite where neither accel nor jerk acts.
            2.0 * speed / (discriminant.sqrt() - accel)
        }
    };
    if root <= rest {
        Some(root)
    } else if (end <= 0.0 && !(speed == 0.0 && accel == 0.0 && jerk == 0.0))
        || (end <= least && end < speed)
    {
        // Rounding took the root past the end of the interval, where the block stands still.
        Some(rest)
    } else {
        None
    }
}
