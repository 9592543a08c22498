//! Blocks under one motion, interval by interval: those that move stand side by side in lanes, those at rest wait in the
//! list of the interval in which the base lifts them.

mod events;
mod waiting;

use std::f64::consts::FRAC_PI_2;

use pulp::Simd;

use super::batch::{BATCH, Batch};
use super::chatter::Trace;
use super::math::Math;
use super::quiet::tail;
use super::ranks::{ABREAST, Moving, NONE, Ranks};
use super::series::{Edge, Ground, Series};
use super::shaking::{Interval, Shaking};
use crate::rocking::{MAX_IMPACTS, REST_OMEGA_RAD_S};

/// A block as the kernel sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rocker {
    /// About the right edge (s = 1) and about the left one (s = −1).
    pub(super) edges: [EdgeTerms; 2],
    /// Restitution of a landing on each edge.
    pub(super) restitution: [f64; 2],
}

/// A block turning about one edge, in units of the step: ÿ = −(E cos y − D sin y), E = a(1+ü_v/g) + s b ü_h/g,
/// D = b(1+ü_v/g) − s a ü_h/g, a = x² sin α, b = x² cos α (linearised: E − D y, a = x² α, b = x², D = b(1+ü_v/g)).
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeTerms {
    pub(super) alpha: f64,
    /// p²h².
    pub(super) x2: f64,
    /// a/b: tan α, or α.
    pub(super) threshold: f64,
    pub(super) b: f64,
}

/// What a block has done so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Record {
    /// Largest rotation and speed of an impact off each edge, by the step.
    pub(super) sides: [Trace; 2],
    pub(super) impact_count: usize,
    pub(super) state: State,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum State {
    /// At rest, never lifted.
    #[default]
    Untouched,
    AtRest,
    Moving,
    Overturned,
    /// For the scalar solver.
    GivenUp,
}

/// A block that is lifted later in an interval: in which of its steps, and after what part of it.
#[derive(Debug, Clone, Copy)]
struct Lift {
    part: usize,
    block: u32,
    edge: usize,
    tau: f64,
}

pub(super) struct Tile<'a> {
    shaking: &'a Shaking,
    rockers: &'a [Rocker],
    records: Vec<Record>,
    /// Steps of an interval.
    parts: usize,
    linearised: bool,
    moving: Ranks,
    /// Places of blocks with an event in the step.
    queue: Vec<u32>,
    again: Vec<u32>,
    batch: Batch,
    /// First block that is lifted in each interval, and the next one after each block.
    lifted_in: Vec<u32>,
    lifted_next: Vec<u32>,
    pending: Vec<Lift>,
    /// Behind the record.
    quiet: bool,
    rest_w: f64,
}

/// One step of an interval.
#[derive(Clone, Copy)]
struct Step {
    interval: usize,
    whole: Interval,
    part: usize,
    ground: Interval,
}

impl<'a> Tile<'a> {
    pub(super) fn new(shaking: &'a Shaking, rockers: &'a [Rocker], parts: usize, linearised: bool) -> Self {
        Self {
            shaking,
            rockers,
            records: vec![Record::default(); rockers.len()],
            parts,
            linearised,
            moving: Ranks::default(),
            queue: Vec::new(),
            again: Vec::new(),
            batch: Batch::default(),
            lifted_in: vec![NONE; shaking.intervals()],
            lifted_next: vec![NONE; rockers.len()],
            pending: Vec::new(),
            quiet: false,
            rest_w: REST_OMEGA_RAD_S * shaking.dt_s / parts as f64,
        }
    }

    /// Follows every block through the motion, and until it rests, where there is a longest `wait`, in intervals, for it.
    #[inline(always)]
    pub(super) fn run<S: Simd, const K: usize, const LINEARISED: bool>(
        mut self,
        simd: S,
        wait: Option<usize>,
    ) -> Vec<Record> {
        for block in 0..self.rockers.len() as u32 {
            self.wait(block, 0);
        }
        for interval in 0..self.shaking.intervals() {
            let whole = self.shaking.interval(interval);
            self.lift_waiting(interval, whole);
            if !self.moving.is_empty() || !self.pending.is_empty() {
                self.pass::<S, K, LINEARISED>(simd, interval, whole);
            }
        }
        if let Some(wait) = wait {
            self.settle::<S, K, LINEARISED>(simd, wait);
        }
        for lane in 0..self.moving.count() {
            let Moving { block, edge, best, y, .. } = self.moving.get(lane);
            let record = &mut self.records[block as usize];
            record.sides[edge].height = best.max(y);
            if wait.is_some() {
                record.state = State::GivenUp;
            }
        }
        self.records
    }

    /// Follows blocks that still move behind the record, for so many intervals at most.
    #[inline(always)]
    fn settle<S: Simd, const K: usize, const LINEARISED: bool>(&mut self, simd: S, wait: usize) {
        self.quiet = true;
        for lane in 0..self.moving.count() {
            let Moving { block, edge, y, w, best, .. } = self.moving.get(lane);
            let tail = if LINEARISED { None } else { tail(&self.rockers[block as usize], edge, y, w, self.rest_w) };
            let Some(tail) = tail.filter(|tail| tail.steps < wait as f64 * self.parts as f64) else { continue };
            let record = &mut self.records[block as usize];
            record.impact_count += tail.impacts;
            record.state = if record.impact_count > MAX_IMPACTS { State::GivenUp } else { State::AtRest };
            record.sides[edge].height = best;
            for (side, tail) in record.sides.iter_mut().zip(tail.sides) {
                side.height = side.height.max(tail.height);
                side.speed = side.speed.max(tail.speed);
            }
            self.moving.leave(lane);
        }
        self.moving.close();
        let still = Interval { u: 0.0, u_change: 0.0, v: 1.0, v_change: 0.0 };
        for _ in 0..wait {
            if self.moving.is_empty() {
                break;
            }
            self.pass::<S, K, LINEARISED>(simd, self.shaking.intervals(), still);
        }
    }

    /// One interval, step by step.
    #[inline(always)]
    fn pass<S: Simd, const K: usize, const LINEARISED: bool>(&mut self, simd: S, interval: usize, whole: Interval) {
        let share = 1.0 / self.parts as f64;
        for part in 0..self.parts {
            let ground = if self.parts == 1 {
                whole
            } else {
                let (u, v) = whole.at(part as f64 * share);
                Interval { u, u_change: share * whole.u_change, v, v_change: share * whole.v_change }
            };
            let step = Step { interval, whole, part, ground };
            for i in 0..self.pending.len() {
                let lift = self.pending[i];
                if lift.part == part {
                    self.start(lift.block, lift.edge, lift.tau);
                }
            }
            if self.shaking.v.is_empty() {
                self.advance::<S, K, LINEARISED, false>(simd, ground);
            } else {
                self.advance::<S, K, LINEARISED, true>(simd, ground);
            }
            while !self.queue.is_empty() {
                let mut queue = std::mem::take(&mut self.queue);
                for batch in queue.chunks(BATCH) {
                    self.events::<S, K, LINEARISED>(simd, step, batch);
                }
                queue.clear();
                self.queue = std::mem::replace(&mut self.again, queue);
            }
            self.moving.close();
        }
        self.pending.clear();
    }

    /// One step of every lane; lanes with an event stay where they are and go into the queue. So do those that enter within
    /// the step: they lie on the floor without velocity, which is never certain to stay above it.
    #[inline(always)]
    fn advance<S: Simd, const K: usize, const LINEARISED: bool, const VERTICAL: bool>(
        &mut self,
        simd: S,
        ground: Interval,
    ) {
        let m = Math::<S, 2>(simd);
        let (u, u_change) = (m.splat(ground.u), m.splat(ground.u_change));
        let (v, v_change) = (m.splat(ground.v), m.splat(ground.v_change));
        let (half, quarter_turn, zero, one) = (m.splat(0.5), m.splat(FRAC_PI_2), m.splat(0.0), m.splat(1.0));
        for [even, odd] in self.moving.in_use() {
            for i in 0..ABREAST / S::F64_LANES {
                // A vector of each rank.
                let pair = |even: &[f64; ABREAST], odd: &[f64; ABREAST]| {
                    [S::as_simd_f64s(even).0[i], S::as_simd_f64s(odd).0[i]]
                };
                let (y, w, best) = (pair(&even.y, &odd.y), pair(&even.w, &odd.w), pair(&even.best, &odd.best));
                let (alpha, x2, side) =
                    (pair(&even.alpha, &odd.alpha), pair(&even.x2, &odd.x2), pair(&even.side, &odd.side));
                let edge = Edge { alpha, x2 };
                let local = Ground { su: m.mul(side, u), su_change: m.mul(side, u_change), v, v_change };
                let series = Series::<S, 2, K>::new::<LINEARISED, VERTICAL>(m, y, w, edge, local, |pull| pull);
                let (y1, w1) = series.end(m);
                let bend = series.bend(m);
                let half_bend = m.mul(half, bend);
                let reach = m.add(m.abs(w), half_bend);
                let top = m.add(y, reach);
                // Above the floor throughout: too high to reach it, or going up too fast to come back.
                let above = m.or(m.gt(y, reach), m.gt(w, half_bend));
                let calm = m.and(above, m.gt(quarter_turn, top));
                let turning = m.and(m.ge(bend, m.abs(w)), m.gt(top, best));
                // A maximum that may be the largest so far is an event, too.
                let uneventful = m.and(calm, m.not(turning));
                let (y, w, event) =
                    (m.select(uneventful, y1, y), m.select(uneventful, w1, w), m.select(uneventful, zero, one));
                for (k, rank) in [&mut *even, &mut *odd].into_iter().enumerate() {
                    S::as_mut_simd_f64s(&mut rank.y).0[i] = y[k];
                    S::as_mut_simd_f64s(&mut rank.w).0[i] = w[k];
                    S::as_mut_simd_f64s(&mut rank.event).0[i] = event[k];
                }
            }
        }
        // Apart from the loop above: a branch there would wait for a whole step, and be wrong in every third vector.
        for (i, rank) in self.moving.in_use().as_flattened().iter().enumerate() {
            if rank.event != [0.0; ABREAST] {
                let places = rank.event.iter().enumerate().filter(|(_, event)| **event != 0.0);
                self.queue.extend(places.map(|(lane, _)| (i * ABREAST + lane) as u32));
            }
        }
    }
}
