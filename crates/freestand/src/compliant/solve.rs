//! The solver: it follows a block from step to step and from event to event.

use std::f64::consts::FRAC_PI_2;

use super::audit::Ledger;
use super::equation::{
    Body, DASHPOT, DRAG, Grip, LEN, Line, OMEGA, SLIP, STRETCH, State, THETA, Turn, V_X, V_Z, WORK,
    X, Z,
};
use super::equilibrium::body;
use super::step::{DORMAND_PRINCE, Step};
use super::stepper::{Found, Trial, next};
use super::tail::Tail;
use super::track::{Seen, Track};
use super::{
    CompliantBase, CompliantEffort, CompliantError, CompliantOptions, CompliantRocking, MAX_STEPS,
    PointPeaks, Start, check,
};
use crate::block::Block;
use crate::rocking::{Base, LONGEST_TAIL_S, Outcome};

/// Longest step, as an angle of the vibration on the cushions.
const LONGEST_RAD: f64 = 0.5;

/// How far past an event a step may end, as a margin: rounding.
const CLOSE: f64 = 1e-13;

/// A step of a history, as passed to an observer.
#[derive(Debug, Clone, Copy)]
pub struct Piece<'a, 'b> {
    seen: Seen<'a, 'b>,
    cg_from_left_m: f64,
}

impl Piece<'_, '_> {
    /// Start time \[s\].
    pub fn start_s(&self) -> f64 {
        self.seen.step.start_s
    }

    /// Length \[s\].
    pub fn length_s(&self) -> f64 {
        self.seen.step.length_s
    }

    /// θ and ω at a share of the step \[rad\], \[rad/s\].
    pub fn rotation(&self, share_ratio: f64) -> (f64, f64) {
        let y = self.seen.step.state(share_ratio);
        (y[THETA], y[OMEGA])
    }

    /// Displacement of the centre of gravity relative to the base, from its position upright above
    /// unloaded cushions: (to the right, upward) \[m\].
    pub fn displacement_m(&self, share_ratio: f64) -> (f64, f64) {
        let y = self.seen.step.state(share_ratio);
        (y[X], y[Z])
    }

    /// Acceleration in the inertial frame of the point `x_m` from the left edge and `z_m` above the
    /// base: (horizontal, vertical) \[m/s²\].
    pub fn acceleration_m_s2(&self, x_m: f64, z_m: f64, share_ratio: f64) -> (f64, f64) {
        self.seen.acceleration(
            x_m - self.cg_from_left_m,
            z_m - self.seen.body.cg_height,
            share_ratio,
        )
    }

    /// Force on the block and compression of a contact element, counted from the left: (to the
    /// right \[N\], upward \[N\], m).
    pub fn contact(&self, index: usize, share_ratio: f64) -> Option<(f64, f64, f64)> {
        let grip = *self.seen.grips.get(index)?;
        Some(self.seen.with_state(share_ratio, |y, turn| {
            let foot = self.seen.body.foot_turned(index, y, turn);
            let load = self.seen.body.load(grip, &foot, y[STRETCH + index]);
            (load.tangential, load.normal.max(0.0), foot.compression)
        }))
    }
}

/// The response of a block on its cushions.
///
/// # Accuracy
/// See [`CompliantAccuracy`](super::CompliantAccuracy); [`EnergyAudit`](super::EnergyAudit) shows
/// the accuracy reached.
///
/// # Limitation
/// Plane motion of a rigid block; cushions without mass and without damage.
///
/// # Errors
/// Numbers out of range, cushions that do not keep the block upright, or a history too long for its
/// stiffness.
///
/// # Example
/// The cabinet of Al Abadi et al. released from 16 mm: 3.6 g, where Eq. (5) gives 4.53 g and
/// 4.0–4.1 g was measured.
/// ```
/// use freestand::block::Block;
/// use freestand::compliant::{CompliantBase, CompliantOptions, Start, rock_compliant};
/// use freestand::cushion::Cushion;
/// use freestand::rocking::Base;
///
/// let cabinet = Block::uniform(2.3, 0.6)?;
/// let rotation_rad = cabinet.pivot().rotation_at_rise_rad(0.016).unwrap();
/// let base = CompliantBase::new(140.0, Cushion::linear(4.38e6)?);
/// let options = CompliantOptions {
///     start: Start::Tilted { rotation_rad, omega_rad_s: 0.0 },
///     duration_s: Some(0.8),
///     ..CompliantOptions::default()
/// };
/// let history = rock_compliant(&cabinet, &base, Base::default(), &options)?;
/// let first = history.touches.first().unwrap();
/// assert!((first.peak_acceleration_m_s2 / freestand::G0_M_S2 - 3.58).abs() < 0.01);
/// assert!(history.energy.residual_ratio < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rock_compliant(
    block: &Block,
    base: &CompliantBase,
    motion: Base<'_>,
    options: &CompliantOptions,
) -> Result<CompliantRocking, CompliantError> {
    rock_compliant_observed(block, base, motion, options, |_| {})
}

/// [`rock_compliant`], which also passes every step to `observe` in order.
///
/// # Errors
/// Those of [`rock_compliant`].
pub fn rock_compliant_observed(
    block: &Block,
    base: &CompliantBase,
    motion: Base<'_>,
    options: &CompliantOptions,
    mut observe: impl FnMut(&Piece<'_, '_>),
) -> Result<CompliantRocking, CompliantError> {
    follow(block, base, motion, options, &mut observe)
}

/// Compiled once, with the science, not in each crate that observes a history.
fn follow(
    block: &Block,
    base: &CompliantBase,
    motion: Base<'_>,
    options: &CompliantOptions,
    observe: &mut dyn FnMut(&Piece<'_, '_>),
) -> Result<CompliantRocking, CompliantError> {
    check(base, motion, options)?;
    let given = motion.horizontal.or(motion.vertical);
    let settled_s = || given.map(|motion| motion.duration_s() + LONGEST_TAIL_S);
    let end_s = options.duration_s.or_else(settled_s).unwrap_or(0.0);
    if !(end_s > 0.0 && end_s.is_finite()) {
        return Err(CompliantError::Duration { duration_s: end_s });
    }
    let body = body(block, base, options.gravity_m_s2);
    let start = body.beginning(options.start)?;
    let balanced = body.balanced().ok();
    let mut result = nothing_yet(options, balanced.map(|y| body.equilibrium_of(&y)));
    let mut solver = Solver::new(block, &body, options, given.is_none(), &start, observe);
    solver.begin(&mut result);
    solver.tail = tail(block, &body, balanced.as_ref(), options);
    let samples = given.map_or(0, |motion| motion.accel_m_s2().len());
    let mut index = 0;
    while solver.time_s < end_s && result.overturn_time_s.is_none() && !solver.tail.is_over {
        let (line, until_s) = Line::of([motion.horizontal, motion.vertical], index, end_s);
        if index >= samples {
            solver.tail.begin();
        }
        if line.is_still() && solver.is_resting && options.start == Start::Rest {
            // Nothing has moved it, and nothing will.
            if index >= samples && options.duration_s.is_none() {
                break;
            }
            solver.time_s = until_s;
        } else {
            solver.is_resting = false;
            solver.pass(line, until_s, &mut result)?;
        }
        index += 1;
    }
    Ok(solver.finish(block, result))
}

/// The end of a history after the motion; `balanced`: the state of rest.
fn tail(
    block: &Block,
    body: &Body<'_>,
    balanced: Option<&State>,
    options: &CompliantOptions,
) -> Tail {
    let weight_n = body.mass * body.gravity;
    let rest_j = weight_n * body.pad.cushion.static_compression_m(0.5 * weight_n);
    let stands_j = balanced.map_or(0.0, |y| {
        let energies = body.energies(&vec![Grip::Stick; body.contacts.len()], y);
        energies.potential_j + energies.stored_j
    });
    let balance_m = block
        .pivot()
        .balance_rise_m()
        .min(block.right_pivot().balance_rise_m());
    Tail::new(
        rest_j,
        stands_j,
        weight_n * balance_m,
        options.duration_s.is_none(),
    )
}

fn nothing_yet(
    options: &CompliantOptions,
    equilibrium: Option<super::Equilibrium>,
) -> CompliantRocking {
    CompliantRocking {
        outcome: Outcome::NoUplift,
        end_time_s: 0.0,
        equilibrium,
        peak_rotation_rad: 0.0,
        peak_rotation_time_s: 0.0,
        peak_uplifted_rotation_rad: 0.0,
        uplift_m: 0.0,
        cg_rise_m: 0.0,
        first_uplift_time_s: None,
        passed_alpha_time_s: None,
        overturn_time_s: None,
        touches: Vec::new(),
        bounce_count: 0,
        flight_count: 0,
        flight_time_s: 0.0,
        swings: Vec::new(),
        peak_edge_accelerations_m_s2: [0.0; 2],
        peak_edge_forces_n: [0.0; 2],
        peak_compression_m: 0.0,
        points: vec![PointPeaks::NONE; options.points_m.len()],
        friction_used_ratio: 0.0,
        slid_m: 0.0,
        final_rotation_rad: 0.0,
        final_omega_rad_s: 0.0,
        energy: super::EnergyAudit::default(),
        effort: CompliantEffort::default(),
    }
}

pub(super) struct Solver<'a, 'b, F> {
    pub(super) body: &'a Body<'b>,
    pub(super) cg_from_left_m: f64,
    pub(super) grips: Vec<Grip>,
    /// For each cushion, the two kinks of its law that enclose its compression.
    pub(super) lines: Vec<(f64, f64)>,
    pub(super) kinks_m: Vec<f64>,
    pub(super) y: State,
    pub(super) rates: State,
    pub(super) time_s: f64,
    pub(super) try_s: f64,
    /// 1/ω of the vibration on the cushions, and the corresponding units of compression, force and
    /// velocity.
    pub(super) unit_s: f64,
    pub(super) unit_m: f64,
    pub(super) sizes: State,
    pub(super) tolerance: f64,
    pub(super) is_resting: bool,
    pub(super) track: Track,
    pub(super) ledger: Ledger,
    pub(super) tail: Tail,
    pub(super) effort: CompliantEffort,
    pub(super) observe: F,
}

impl<'a, 'b, F: FnMut(&Piece<'_, '_>)> Solver<'a, 'b, F> {
    fn new(
        block: &Block,
        body: &'a Body<'b>,
        options: &CompliantOptions,
        is_free: bool,
        start: &State,
        observe: F,
    ) -> Self {
        let weight_n = body.mass * body.gravity;
        let unit_m = body.pad.cushion.static_compression_m(0.5 * weight_n);
        let unit_s = (unit_m / body.gravity).sqrt();
        let width_m = block.base_width_m();
        let mut sizes = [unit_m; LEN];
        (sizes[THETA], sizes[OMEGA]) = (unit_m / width_m, unit_m / width_m / unit_s);
        (sizes[V_X], sizes[V_Z]) = (unit_m / unit_s, unit_m / unit_s);
        for place in [WORK, DASHPOT, DRAG, SLIP] {
            sizes[place] = weight_n * unit_m;
        }
        let grips = vec![Grip::UNTOUCHED; body.contacts.len()];
        Self {
            body,
            cg_from_left_m: block.cg_from_left_m(),
            lines: vec![(f64::NEG_INFINITY, f64::INFINITY); grips.len()],
            kinks_m: body.pad.cushion.law().kinks_m(),
            y: *start,
            rates: *start,
            time_s: 0.0,
            try_s: 0.1 * unit_s,
            unit_s,
            unit_m,
            sizes,
            tolerance: options.accuracy.tolerance(),
            is_resting: true,
            track: Track::new(block, body, &options.points_m, is_free, start),
            ledger: Ledger::default(),
            tail: Tail::default(),
            effort: CompliantEffort::default(),
            grips,
            observe,
        }
    }

    /// Contacts at the start carry load without stretch.
    fn begin(&mut self, result: &mut CompliantRocking) {
        for index in 0..self.grips.len() {
            if self.body.foot(index, &self.y).compression > 0.0 {
                self.grips[index] = Grip::Stick;
                self.place_between_kinks(index);
            }
        }
        if !self.grips.iter().any(|grip| grip.carries()) {
            self.track.flies_from(0.0, result);
        }
        let rest_j = self.body.mass * self.body.gravity * self.unit_m;
        self.ledger = Ledger::open(rest_j, &self.body.energies(&self.grips, &self.y));
    }

    /// Calculates one straight segment of the motion.
    fn pass(
        &mut self,
        line: Line,
        until_s: f64,
        result: &mut CompliantRocking,
    ) -> Result<(), CompliantError> {
        self.rates = self.body.rates(&self.grips, &line, self.time_s, &self.y);
        // With Bogacki and Shampine's pair the balance of laws whose stiffness is infinite at the first touch closes to
        // 1.8e-6 of the turnover, not to 1e-6.
        let mut step = Step::new(&self.y, self.body.len(), &DORMAND_PRINCE);
        while self.time_s < until_s && result.overturn_time_s.is_none() && !self.tail.is_over {
            let rest_s = until_s - self.time_s;
            if rest_s <= 4.0 * f64::EPSILON * until_s {
                break;
            }
            let grow = self.next(&mut step, &line, rest_s)?.grow_s;
            let is_last = step.length_s == rest_s;
            self.try_s = if is_last { grow.max(self.try_s) } else { grow };
            self.accept(&line, &step, result);
            if is_last {
                self.time_s = until_s;
            }
            if self.effort.steps > MAX_STEPS {
                return Err(CompliantError::TooManySteps {
                    time_s: self.time_s,
                    limit: MAX_STEPS,
                });
            }
        }
        if result.overturn_time_s.is_none() && !self.tail.is_over {
            self.time_s = until_s;
        }
        Ok(())
    }

    /// Takes the step of this length from the present state; returns its error ratio.
    fn take(&self, step: &mut Step<LEN>, line: &Line, length_s: f64) -> f64 {
        let rates = |time_s: f64, y: &State, rates: &mut State| {
            self.body.write_rates(&self.grips, line, (time_s, y), rates);
        };
        step.take(rates, self.time_s, (&self.y, &self.rates), length_s);
        step.error_ratio(&self.sizes, self.tolerance)
    }

    /// Takes the next step.
    fn next(
        &mut self,
        step: &mut Step<LEN>,
        line: &Line,
        rest_s: f64,
    ) -> Result<Found, CompliantError> {
        let mut effort = self.effort;
        let trial = Trial {
            start_s: self.time_s,
            try_s: self.try_s,
            longest_s: LONGEST_RAD * self.unit_s,
            rest_s,
            unit_s: self.unit_s,
            near: None,
            close: CLOSE,
        };
        let take = |step: &mut Step<LEN>, length_s: f64| self.take(step, line, length_s);
        let margin = |time_s: f64, y: &State, _: f64| self.least_margin(line, time_s, y);
        let found = next(step, trial, take, |_| true, margin, &mut effort)?;
        self.effort = effort;
        Ok(found)
    }

    fn accept(&mut self, line: &Line, step: &Step<LEN>, result: &mut CompliantRocking) {
        self.effort.steps += 1;
        let ends = [Turn::of(&step.start), Turn::of(&step.end)];
        let seen = Seen {
            body: self.body,
            grips: &self.grips,
            line,
            step,
            ends,
        };
        self.track.read(&seen, result);
        (self.observe)(&Piece {
            seen,
            cg_from_left_m: self.cg_from_left_m,
        });
        (self.y, self.rates) = (step.end, *step.end_rates());
        self.time_s = step.start_s + step.length_s;
        if self.body.tangential_damping == 0.0 {
            self.settle_stretches();
        }
        let mut changed = false;
        // Changes of contacts do not turn the block.
        for index in 0..self.grips.len() {
            if self.margin(index, line, self.time_s, &self.y, &ends[1]) < 0.0 {
                self.change(index, result);
                changed = true;
            }
        }
        if changed {
            self.rates = self.body.rates(&self.grips, line, self.time_s, &self.y);
        }
        if self.y[THETA].abs() >= FRAC_PI_2 {
            result.overturn_time_s = Some(self.time_s);
        }
        self.ledger.enter(&self.body.energies(&self.grips, &self.y));
        let mut tail = self.tail;
        tail.step(self.time_s, &self.ledger, || self.is_held());
        self.tail = tail;
    }

    /// Whether all its feet carry it.
    fn is_held(&self) -> bool {
        self.grips.iter().all(|grip| grip.carries())
    }

    fn finish(mut self, block: &Block, mut result: CompliantRocking) -> CompliantRocking {
        for index in 0..self.grips.len() {
            if let Grip::Slip(_) = self.grips[index] {
                self.track
                    .slide(index, self.place(index), false, &mut result);
            }
        }
        self.track.finish(block, self.time_s, &mut result);
        (result.end_time_s, result.effort) = (self.time_s, self.effort);
        (result.final_rotation_rad, result.final_omega_rad_s) = (self.y[THETA], self.y[OMEGA]);
        result.energy = self.ledger.close();
        if result.uplift_m > 0.0 {
            let is_open = self.tail.is_open(&self.ledger);
            result.outcome = if is_open {
                Outcome::Unresolved
            } else {
                Outcome::Rocked
            };
        }
        if result.overturn_time_s.is_some() {
            result.outcome = Outcome::Overturned;
            (result.peak_rotation_rad, result.peak_rotation_time_s) = (FRAC_PI_2, self.time_s);
        }
        result
    }
}
