//! The scalar solver: it follows a block from event to event through a motion.

use std::f64::consts::FRAC_PI_2;

use super::equation::{Edge, Ground, Segment, Start};
use super::{
    Base, MAX_IMPACTS, Outcome, REST_OMEGA_RAD_S, Rocking, RockingError, RockingImpact,
    RockingModel, RockingOptions, STEADY_IMPACTS, Side, SideExtremes, StopReason, Until,
    WallImpact, settling_steps,
};
use crate::block::Block;
use crate::motion::Motion;
use crate::polynomial::{first_root, roots, value};
use crate::wall::Contact;

/// The response of `block` to the motion of its base.
///
/// **Units**: SI; times are counted from the first sample.
///
/// # Reference
/// Housner (1963); the event rules are those of the module.
///
/// # Accuracy
/// The truncation error of a step is below [`super::Accuracy::tolerance`] of the rotation; events
/// are roots of the step's polynomial to double precision. How errors grow is a property of the
/// motion, not of the solver.
///
/// # Errors
/// Input outside the range of the model, and free flight.
///
/// # Example
/// Free rocking from half of the slenderness angle α: a quarter period is 1.3185044/p for α = 0.2
/// (Housner 1963).
/// ```
/// use freestand_rocking::{block::Block, rocking::{rock, Base, RockingOptions, Until}};
/// let block = Block::uniform(2.0 * 0.2f64.cos(), 2.0 * 0.2f64.sin())?;
/// let p = block.pivot().frequency_parameter_rad_s(9.80665);
/// let until = Until::Time(2.0);
/// let options = RockingOptions { initial_rotation_rad: 0.1, until, ..Default::default() };
/// let history = rock(&block, Base::default(), &options)?;
/// assert!((p * history.impacts[0].time_s - 1.3185044).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rock(block: &Block, base: Base, options: &RockingOptions) -> Result<Rocking, RockingError> {
    rock_observed(block, base, options, |_| ())
}

/// [`rock`], which also passes every segment of the history to `observe` in order.
///
/// # Errors
/// Those of [`rock`].
pub fn rock_observed(
    block: &Block,
    base: Base,
    options: &RockingOptions,
    observe: impl FnMut(&Segment),
) -> Result<Rocking, RockingError> {
    Solver::new(block, base, options, observe)?.run()
}

/// What the block is doing.
enum Phase {
    Rest,
    /// Rotating about `edges[edge]` with (y, w).
    Moving {
        edge: usize,
        y: f64,
        w: f64,
        start: Start,
    },
    /// Held by the wall beyond `edges[edge]`.
    Leaning {
        edge: usize,
    },
}

const RIGHT: usize = 0;
const LEFT: usize = 1;
const SIDES: [Side; 2] = [Side::Right, Side::Left];

struct Solver<'a, F: FnMut(&Segment)> {
    edges: [Edge; 2],
    /// Restitution of a landing on each edge.
    restitution: [f64; 2],
    intervals: Intervals<'a>,
    tolerance: f64,
    gravity_m_s2: f64,
    settle: bool,
    /// After the motion, when the base no longer moves.
    quiet: bool,
    /// Whether the block rocks practically for ever.
    steady: bool,
    /// Whether the block has met a wall since it left the floor.
    bounced: bool,
    phase: Phase,
    result: Rocking,
    observe: F,
    base_width_m: f64,
}

/// The base acceleration as straight lines: the intervals of the motion, the return to zero, and
/// the base at rest after it.
struct Intervals<'a> {
    horizontal: &'a [f64],
    vertical: &'a [f64],
    /// Number of samples; the interval that begins at the last one returns to zero.
    samples: usize,
    dt_s: f64,
    per_g: f64,
    /// Time at which the last interval ends \[s\].
    end_s: f64,
}

impl Intervals<'_> {
    fn u(&self, i: usize) -> f64 {
        self.horizontal.get(i).map_or(0.0, |a| a * self.per_g)
    }

    fn v(&self, i: usize) -> f64 {
        1.0 + self.vertical.get(i).map_or(0.0, |a| a * self.per_g)
    }

    fn start_s(&self, i: usize) -> f64 {
        i as f64 * self.dt_s
    }

    /// Whether the base rests at the end.
    fn end_at_rest(&self) -> bool {
        self.end_s >= self.start_s(self.samples)
    }

    /// Length of interval `i` and the acceleration at its start; `None` after the end.
    fn get(&self, i: usize) -> Option<(f64, Ground)> {
        let start_s = self.start_s(i);
        // After the motion there is one quiet interval, up to the end.
        if start_s >= self.end_s || i > self.samples {
            return None;
        }
        if i == self.samples {
            return Some((
                self.end_s - start_s,
                Ground {
                    u: 0.0,
                    u_slope: 0.0,
                    v: 1.0,
                    v_slope: 0.0,
                },
            ));
        }
        let (u, v) = (self.u(i), self.v(i));
        let ground = Ground {
            u,
            u_slope: (self.u(i + 1) - u) / self.dt_s,
            v,
            v_slope: (self.v(i + 1) - v) / self.dt_s,
        };
        // The end may cut an interval; rounding must not cut a last interval that is whole.
        let length_s = if self.start_s(i + 1) <= self.end_s {
            self.dt_s
        } else {
            self.end_s - start_s
        };
        Some((length_s, ground))
    }
}

impl<'a, F: FnMut(&Segment)> Solver<'a, F> {
    fn new(
        block: &Block,
        base: Base<'a>,
        options: &RockingOptions,
        observe: F,
    ) -> Result<Self, RockingError> {
        let gravity = options.gravity_m_s2;
        if !(gravity > 0.0 && gravity.is_finite()) {
            return Err(RockingError::Gravity {
                gravity_m_s2: gravity,
            });
        }
        let tolerance = options.accuracy.tolerance();
        if !options.accuracy.is_valid() {
            return Err(RockingError::Accuracy { tolerance });
        }
        let restitution = options.restitution.ratios(block)?;
        let (theta, omega) = (options.initial_rotation_rad, options.initial_omega_rad_s);
        if !(theta.abs() < FRAC_PI_2 && omega.is_finite()) {
            return Err(RockingError::InitialState {
                rotation_rad: theta,
                omega_rad_s: omega,
            });
        }
        let edge = |side: f64, pivot, x| {
            Edge::new(side, pivot, x, block.cg_height_m(), gravity, options.model)
        };
        let mut edges = [
            edge(1.0, block.right_pivot(), block.cg_from_right_m()),
            edge(-1.0, block.pivot(), block.cg_from_left_m()),
        ];
        let contacts = options.walls.contacts(block)?;
        if options.model == RockingModel::Linearised && !options.walls.is_none() {
            return Err(RockingError::LinearisedWall);
        }
        for (edge, contact) in edges.iter_mut().zip(contacts) {
            edge.wall = contact;
        }
        for (side, edge) in SIDES.into_iter().zip(&edges) {
            let rotation_rad = edge.side * theta;
            if let Some(wall) = edge.wall
                && rotation_rad > wall.angle_rad
            {
                return Err(RockingError::BeyondWall {
                    side,
                    rotation_rad,
                    contact_rad: wall.angle_rad,
                });
            }
        }
        let given = theta != 0.0 || omega != 0.0;
        let phase = if given {
            let index = if theta > 0.0 || (theta == 0.0 && omega > 0.0) {
                RIGHT
            } else {
                LEFT
            };
            let s = edges[index].side;
            Phase::Moving {
                edge: index,
                y: s * theta,
                w: s * omega,
                start: Start::Moving,
            }
        } else {
            Phase::Rest
        };
        let passed = |edge: &Edge| edge.side * theta > edge.pivot.slenderness_angle_rad;
        let mut sides = [SideExtremes::default(); 2];
        if let Phase::Moving { edge, y, .. } = phase {
            sides[edge].peak_rotation_rad = y;
        }
        Ok(Self {
            edges,
            restitution,
            intervals: Intervals::new(base, gravity, options.until)?,
            tolerance,
            gravity_m_s2: gravity,
            settle: matches!(options.until, Until::Settled { .. }),
            quiet: false,
            steady: false,
            bounced: false,
            phase,
            result: Rocking {
                outcome: if given {
                    Outcome::Rocked
                } else {
                    Outcome::NoUplift
                },
                stop: StopReason::EndOfMotion,
                end_time_s: 0.0,
                peak_rotation_rad: theta.abs(),
                sides,
                peak_rotation_time_s: given.then_some(0.0),
                uplift_m: 0.0,
                cg_rise_m: 0.0,
                first_uplift_time_s: None,
                uplift_count: 0,
                passed_alpha_time_s: edges.iter().any(passed).then_some(0.0),
                overturn_time_s: None,
                impacts: Vec::new(),
                wall_impacts: Vec::new(),
                contacts,
                leaning: false,
                rest_time_s: None,
                final_rotation_rad: 0.0,
                final_omega_rad_s: 0.0,
                at_rest: true,
                restitution_ratio: restitution[RIGHT],
                effort: super::Effort::default(),
            },
            observe,
            base_width_m: block.base_width_m(),
        })
    }

    fn run(mut self) -> Result<Rocking, RockingError> {
        let mut index = 0;
        while let Some((length_s, ground)) = self.intervals.get(index) {
            let start_s = self.intervals.start_s(index);
            if ground.v <= 0.0 {
                return Err(RockingError::FreeFlight { time_s: start_s });
            }
            let at_end = ground.after(length_s);
            if at_end.v <= 0.0 {
                return Err(RockingError::FreeFlight {
                    time_s: start_s - ground.v / ground.v_slope,
                });
            }
            if self.settle && index >= self.intervals.samples && self.stays_leaning() {
                self.result.stop = StopReason::Settled;
                break;
            }
            if matches!(self.phase, Phase::Rest) {
                if self.settle && index >= self.intervals.samples {
                    self.result.stop = StopReason::Settled;
                    break;
                }
                // A straight line cannot pass the threshold between two points that are both below
                // it.
                if self.edges.iter().all(|e| {
                    e.margin(ground.u, ground.v) >= 0.0 && e.margin(at_end.u, at_end.v) >= 0.0
                }) {
                    self.result.end_time_s = start_s + length_s;
                    index += 1;
                    continue;
                }
            }
            self.quiet = index >= self.intervals.samples;
            self.pass(start_s, length_s, ground)?;
            if self.result.overturn_time_s.is_some() || self.steady {
                break;
            }
            if self.settle && index >= self.intervals.samples && matches!(self.phase, Phase::Rest) {
                self.result.stop = StopReason::Settled;
                self.result.end_time_s = self.result.rest_time_s.unwrap_or(start_s);
                break;
            }
            if self.settle && index >= self.intervals.samples && self.stays_leaning() {
                self.result.stop = StopReason::Settled;
                self.result.end_time_s = self
                    .result
                    .wall_impacts
                    .last()
                    .map_or(start_s, |impact| impact.time_s);
                break;
            }
            index += 1;
        }
        Ok(self.finish())
    }

    /// Calculates one interval, event by event.
    fn pass(&mut self, start_s: f64, length_s: f64, ground: Ground) -> Result<(), RockingError> {
        let mut tau = 0.0;
        while tau < length_s {
            match self.phase {
                Phase::Rest => match self.uplift(ground, tau, length_s) {
                    Some((edge, at)) => {
                        tau = at;
                        self.phase = Phase::Moving {
                            edge,
                            y: 0.0,
                            w: 0.0,
                            start: Start::Lifting,
                        };
                        self.result.uplift_count += 1;
                        self.result.first_uplift_time_s.get_or_insert(start_s + tau);
                        self.result.outcome = Outcome::Rocked;
                    }
                    None => tau = length_s,
                },
                Phase::Leaning { edge } => {
                    let until = self.release(edge, ground, tau, length_s);
                    let from = std::mem::replace(&mut tau, until.unwrap_or(length_s));
                    if tau > from {
                        self.lean(edge, ground.after(from), start_s + from, tau - from)?;
                    }
                    if until.is_some() {
                        let y = self.edges[edge].ceiling();
                        self.phase = Phase::Moving {
                            edge,
                            y,
                            w: 0.0,
                            start: Start::Leaving,
                        };
                    }
                }
                // It moves towards the wall that it touches.
                Phase::Moving { edge, y, w, .. }
                    if w > 0.0
                        && self.edges[edge]
                            .wall
                            .is_some_and(|wall| y >= wall.angle_rad) =>
                {
                    self.strike(edge, w, start_s + tau, ground.after(tau))?;
                }
                Phase::Moving { edge, y, w, start } => {
                    let rest_s = length_s - tau;
                    let step_s = rest_s.min(self.edges[edge].max_step_s());
                    let segment = Segment::new(
                        self.edges[edge],
                        y,
                        w,
                        ground.after(tau),
                        self.gravity_m_s2,
                        start_s + tau,
                        step_s,
                        self.tolerance,
                        start,
                    )?;
                    let used_s = self.advance(edge, segment)?;
                    // The last step of an interval ends exactly on the sample.
                    tau = if used_s == rest_s {
                        length_s
                    } else {
                        tau + used_s
                    };
                    if self.result.overturn_time_s.is_some() || self.steady {
                        break;
                    }
                }
            }
        }
        self.result.end_time_s = self.result.overturn_time_s.unwrap_or(start_s + tau);
        Ok(())
    }

    /// The edge about which the block starts to rotate within the rest of an interval, and when.
    fn uplift(&self, ground: Ground, tau: f64, length_s: f64) -> Option<(usize, f64)> {
        let (now, end) = (ground.after(tau), ground.after(length_s));
        let mut first: Option<(usize, f64)> = None;
        for (index, edge) in self
            .edges
            .iter()
            .enumerate()
            .filter(|(_, edge)| !edge.touches_wall())
        {
            let (from, to) = (edge.margin(now.u, now.v), edge.margin(end.u, end.v));
            let at = if from < 0.0 {
                tau
            } else if to < 0.0 {
                tau + (length_s - tau) * from / (from - to)
            } else {
                continue;
            };
            if at < length_s && first.is_none_or(|(_, earliest)| at < earliest) {
                first = Some((index, at));
            }
        }
        first
    }

    /// When the wall beyond an edge no longer holds the block, within the rest of an interval.
    fn release(&self, edge: usize, ground: Ground, tau: f64, length_s: f64) -> Option<f64> {
        let (now, end) = (ground.after(tau), ground.after(length_s));
        let edge = &self.edges[edge];
        let y = edge.ceiling();
        let (from, to) = (edge.pull(y, now.u, now.v), edge.pull(y, end.u, end.v));
        let at = if from > 0.0 {
            tau
        } else if to > 0.0 {
            tau + (length_s - tau) * from / (from - to)
        } else {
            return None;
        };
        (at < length_s).then_some(at)
    }

    /// A time during which the block leans on the wall.
    fn lean(
        &mut self,
        edge: usize,
        ground: Ground,
        start_s: f64,
        step_s: f64,
    ) -> Result<(), RockingError> {
        let held = self.edges[edge];
        let (y, gravity) = (held.ceiling(), self.gravity_m_s2);
        let segment = Segment::new(
            held,
            y,
            0.0,
            ground,
            gravity,
            start_s,
            step_s,
            self.tolerance,
            Start::Held,
        )?;
        (self.observe)(&segment);
        Ok(())
    }

    /// Whether the block leans and the base at rest does not let it go.
    fn stays_leaning(&self) -> bool {
        match self.phase {
            Phase::Leaning { edge } => {
                self.edges[edge].pull(self.edges[edge].ceiling(), 0.0, 1.0) <= 0.0
            }
            Phase::Rest | Phase::Moving { .. } => false,
        }
    }

    /// Takes one step, up to its first event, and changes the phase; returns the time used.
    fn advance(&mut self, edge: usize, mut segment: Segment) -> Result<f64, RockingError> {
        let effort = &mut self.result.effort;
        effort.steps += 1;
        effort.evaluations += segment.series().len() - 2;
        let c = segment.series();
        // The first coefficient that is not zero: a block that starts from rest rises like τ, τ² or
        // τ³.
        let Some(lead) = c.iter().position(|&c| c != 0.0).filter(|&k| c[k] > 0.0) else {
            // Nothing lifts it in the end.
            self.phase = Phase::Rest;
            self.result.rest_time_s = Some(segment.start_s);
            return Ok(segment.step_s);
        };
        let reach: f64 = c.iter().skip(lead + 1).map(|c| c.abs()).sum();
        let impact = if c[lead] > reach {
            None
        } else {
            first_root(&c[lead..])
        };
        let highest = c[lead] + reach;
        let walled = segment.edge.wall.is_some();
        let ceiling = segment.edge.ceiling();
        let stop = if highest < ceiling {
            None
        } else {
            reaches(c, ceiling)
        };
        if walled && stop == Some(0.0) {
            // Without velocity at the wall, and pressed on: it leans for the rest of the step.
            let step_s = segment.step_s;
            let (ground, start_s) = (segment.ground, segment.start_s);
            self.phase = Phase::Leaning { edge };
            self.lean(edge, ground, start_s, step_s)?;
            return Ok(step_s);
        }
        let end = impact.unwrap_or(1.0).min(stop.unwrap_or(1.0));
        let (mut y, w) = segment.state(end);
        let stopped = stop.is_some_and(|x| x <= end);
        // Rounding may take y below zero where the root lies just past the end of the step.
        let landed = !stopped && (impact.is_some_and(|x| x <= end) || y <= 0.0);
        if landed {
            y = 0.0;
        } else if walled {
            y = if stopped { ceiling } else { y.min(ceiling) };
        }
        self.track_peak(edge, &segment, end, y, highest);
        segment.end_ratio = end;
        let used_s = if end == 1.0 {
            segment.step_s
        } else {
            end * segment.step_s
        };
        let time_s = segment.start_s + used_s;
        (self.observe)(&segment);

        if stopped && walled {
            self.strike(edge, w.max(0.0), time_s, segment.ground.after(used_s))?;
        } else if stopped {
            self.result.overturn_time_s = Some(time_s);
            (
                self.result.peak_rotation_rad,
                self.result.peak_rotation_time_s,
            ) = (FRAC_PI_2, Some(time_s));
            self.result.sides[edge].peak_rotation_rad = FRAC_PI_2;
            self.phase = Phase::Moving {
                edge,
                y: FRAC_PI_2,
                w,
                start: Start::Moving,
            };
        } else if landed {
            self.land(edge, w.min(0.0), time_s, segment.ground.after(used_s))?;
        } else {
            self.phase = Phase::Moving {
                edge,
                y,
                w,
                start: Start::Moving,
            };
        }
        Ok(used_s)
    }

    /// An impact at velocity `w` ≤ 0 that ends the rotation about `edge`.
    fn land(
        &mut self,
        edge: usize,
        w: f64,
        time_s: f64,
        ground: Ground,
    ) -> Result<(), RockingError> {
        let other = 1 - edge;
        let side = self.edges[edge].side;
        let mut after = -w * self.restitution[other];
        let mut next = other;
        self.bounced = false;
        if let Some(wall) = self.edges[other].wall.filter(Contact::touches) {
            // The floor, the wall and the floor again at one instant. Between two walls that it
            // touches the block stops.
            let back = after * wall.restitution_ratio;
            self.note_wall(other, after, back, time_s)?;
            after = if self.edges[edge].touches_wall() {
                0.0
            } else {
                back * self.restitution[edge]
            };
            next = edge;
        }
        let hardest = &mut self.result.sides[edge].impact_omega_rad_s;
        *hardest = hardest.max(-w);
        self.result.impacts.push(RockingImpact {
            time_s,
            omega_before_rad_s: side * w,
            omega_after_rad_s: self.edges[next].side * after,
        });
        if self.result.impacts.len() > MAX_IMPACTS {
            return Err(RockingError::TooManyImpacts {
                time_s,
                limit: MAX_IMPACTS,
            });
        }
        let loss = -self.restitution[0].max(self.restitution[1]).ln();
        self.steady = self.settle
            && self.quiet
            && (after / REST_OMEGA_RAD_S).ln() > STEADY_IMPACTS * loss
            && self.edges.iter().all(|edge| edge.swings_back(after))
            && self.has_flown_quietly();
        self.phase = if after > REST_OMEGA_RAD_S {
            Phase::Moving {
                edge: next,
                y: 0.0,
                w: after,
                start: Start::Moving,
            }
        } else if let Some(lifted) = self
            .edges
            .iter()
            .position(|e| !e.touches_wall() && e.margin(ground.u, ground.v) < 0.0)
        {
            Phase::Moving {
                edge: lifted,
                y: 0.0,
                w: 0.0,
                start: Start::Lifting,
            }
        } else {
            self.result.rest_time_s = Some(time_s);
            Phase::Rest
        };
        Ok(())
    }

    /// Whether a flight about each edge lies after the motion: no later one is higher.
    fn has_flown_quietly(&self) -> bool {
        let still_from_s = self.intervals.start_s(self.intervals.samples);
        let third_last = self.result.impacts.iter().rev().nth(2);
        third_last.is_some_and(|impact| impact.time_s >= still_from_s)
    }

    /// An impact at velocity `w` ≥ 0 on the wall beyond `edge`.
    fn strike(
        &mut self,
        edge: usize,
        w: f64,
        time_s: f64,
        ground: Ground,
    ) -> Result<(), RockingError> {
        let held = self.edges[edge];
        let ceiling = held.ceiling();
        let after = w * held.wall.map_or(0.0, |wall| wall.restitution_ratio);
        self.note_wall(edge, w, after, time_s)?;
        self.bounced = true;
        if held.touches_wall() {
            // Only a block that is given a velocity gets here: the wall throws it back to the floor.
            return self.land(edge, -after, time_s, ground);
        }
        self.phase = if after > REST_OMEGA_RAD_S {
            Phase::Moving {
                edge,
                y: ceiling,
                w: -after,
                start: Start::Moving,
            }
        } else if held.pull(ceiling, ground.u, ground.v) > 0.0 {
            Phase::Moving {
                edge,
                y: ceiling,
                w: 0.0,
                start: Start::Leaving,
            }
        } else {
            Phase::Leaning { edge }
        };
        Ok(())
    }

    /// Adds a wall impact on the side of `edge`; the speeds are towards the wall and back.
    fn note_wall(
        &mut self,
        edge: usize,
        before: f64,
        after: f64,
        time_s: f64,
    ) -> Result<(), RockingError> {
        let side = self.edges[edge].side;
        let hardest = &mut self.result.sides[edge].wall_omega_rad_s;
        *hardest = hardest.max(before);
        self.result.wall_impacts.push(WallImpact {
            time_s,
            side: SIDES[edge],
            omega_before_rad_s: side * before,
            omega_after_rad_s: -side * after,
        });
        if self.result.wall_impacts.len() > MAX_IMPACTS {
            return Err(RockingError::TooManyImpacts {
                time_s,
                limit: MAX_IMPACTS,
            });
        }
        Ok(())
    }

    /// Updates the largest |θ| and the first passage of α from a step up to its `end`, where the
    /// rotation is `y_end`.
    fn track_peak(&mut self, edge: usize, segment: &Segment, end: f64, y_end: f64, highest: f64) {
        let alpha = segment.edge.pivot.slenderness_angle_rad;
        let c = segment.series();
        if self.result.passed_alpha_time_s.is_none() && highest > alpha && c[0] <= alpha {
            let passage = first_root(&below(c, alpha)[..c.len()]).filter(|&x| x <= end);
            self.result.passed_alpha_time_s = passage.map(|x| segment.start_s + x * segment.step_s);
        }
        let best = self.result.sides[edge].peak_rotation_rad;
        if highest <= best {
            return;
        }
        let mut peak = (y_end, end);
        // A maximum inside the step, unless the rotation grows throughout.
        let slope_reach: f64 = c
            .iter()
            .enumerate()
            .skip(2)
            .map(|(k, c)| k as f64 * c.abs())
            .sum();
        if c[1] <= slope_reach {
            let mut slope = [0.0; crate::polynomial::MAX_DEGREE + 1];
            for (k, &c) in c.iter().enumerate().skip(1) {
                slope[k - 1] = k as f64 * c;
            }
            let ceiling = segment.edge.ceiling();
            roots(&slope[..c.len() - 1], &mut |x| {
                // No further than the wall, whatever rounding yields.
                let y = value(c, x).min(ceiling);
                if x <= end && y > peak.0 {
                    peak = (y, x);
                }
                x < end
            });
        }
        if peak.0 > best {
            self.result.sides[edge].peak_rotation_rad = peak.0;
        }
        if peak.0 > self.result.peak_rotation_rad {
            self.result.peak_rotation_rad = peak.0;
            self.result.peak_rotation_time_s = Some(segment.start_s + peak.1 * segment.step_s);
        }
    }

    fn finish(self) -> Rocking {
        let (edge, y, w) = match self.phase {
            Phase::Rest => (RIGHT, 0.0, 0.0),
            Phase::Moving { edge, y, w, .. } => (edge, y, w),
            Phase::Leaning { edge } => (edge, self.edges[edge].ceiling(), 0.0),
        };
        let is_followed = self.settle && self.intervals.end_at_rest();
        let about = &self.edges[edge];
        // On a base at rest no impact adds energy: too little of it to pass a balance point stays too little.
        let cannot_fall = || {
            let speed = about.landing_speed(y, w);
            let is_before = y < about.pivot.slenderness_angle_rad;
            is_followed && is_before && self.edges.iter().all(|edge| edge.swings_back(speed))
        };
        let mut result = self.result;
        if !(matches!(self.phase, Phase::Rest) || cannot_fall()) {
            result.outcome = Outcome::Unresolved;
        }
        result.at_rest = matches!(self.phase, Phase::Rest);
        result.leaning = matches!(self.phase, Phase::Leaning { .. });
        if !result.at_rest {
            (result.final_rotation_rad, result.final_omega_rad_s) =
                (about.side * y, about.side * w);
            // Long after the motion a block that bounces must not have energy enough to come back.
            let is_held =
                result.leaning || self.bounced && (!is_followed || about.stays_on_its_side(y, w));
            if is_held && y >= about.pivot.slenderness_angle_rad {
                result.outcome = Outcome::Leaned;
            }
        }
        if result.overturn_time_s.is_some() {
            result.outcome = Outcome::Overturned;
            result.stop = StopReason::Overturned;
        }
        result.uplift_m = self.base_width_m * result.peak_rotation_rad.sin();
        let rises = self
            .edges
            .iter()
            .zip(result.sides)
            .map(|(e, side)| e.pivot.largest_rise_m(side.peak_rotation_rad));
        result.cg_rise_m = rises.fold(0.0, f64::max);
        result
    }
}

/// When y reaches a limit that it does not exceed at the start; 0 where it is there and is about to.
pub(super) fn reaches(series: &[f64], limit: f64) -> Option<f64> {
    let gap = &below(series, limit)[..series.len()];
    // A block that has just left the wall is on it: a root that does not count.
    let lead = gap.iter().position(|&c| c != 0.0)?;
    if gap[lead] > 0.0 {
        first_root(&gap[lead..])
    } else {
        Some(0.0)
    }
}

/// The series of limit − y.
fn below(series: &[f64], limit: f64) -> [f64; crate::polynomial::MAX_DEGREE + 1] {
    let mut c = [0.0; crate::polynomial::MAX_DEGREE + 1];
    for (c, y) in c.iter_mut().zip(series) {
        *c = -y;
    }
    c[0] += limit;
    c
}

impl<'a> Intervals<'a> {
    fn new(base: Base<'a>, gravity: f64, until: Until) -> Result<Self, RockingError> {
        base.check()?;
        let given = base.horizontal.or(base.vertical);
        let record_s = given.map_or(0.0, Motion::duration_s);
        let end_s = match (until, given) {
            (Until::EndOfMotion, _) => record_s,
            (Until::Time(end_s), _) => end_s,
            (Until::Settled { at_most_s }, Some(motion)) if at_most_s >= motion.dt_s() => {
                let steps = (motion.accel_m_s2().len() - 1) as f64;
                (steps + settling_steps(at_most_s, motion.dt_s())) * motion.dt_s()
            }
            (Until::Settled { at_most_s }, _) => record_s + at_most_s,
        };
        if !(end_s > 0.0 && end_s.is_finite()) {
            return Err(RockingError::Duration { duration_s: end_s });
        }
        Ok(Self {
            horizontal: base.horizontal.map_or(&[], Motion::accel_m_s2),
            vertical: base.vertical.map_or(&[], Motion::accel_m_s2),
            samples: given.map_or(0, |m| m.accel_m_s2().len()),
            dt_s: given.map_or(end_s, Motion::dt_s),
            per_g: 1.0 / gravity,
            end_s,
        })
    }
}
