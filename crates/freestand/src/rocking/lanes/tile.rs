//! Blocks under one motion, interval by interval: those that move stand side by side in lanes, those at rest wait in the
//! list of the interval in which the base lifts them.

use std::f64::consts::FRAC_PI_2;

use pulp::Simd;

use super::batch::{BATCH, Batch, CALM, LANDING};
use super::chatter::{Acting, Pull, Trace, impacts_to_rest};
use super::math::Math;
use super::quiet::tail;
use super::ranks::{ABREAST, Moving, NONE, Ranks};
use super::series::{Edge, Ground, Series, TERMS};
use super::shaking::{Interval, Shaking};
use crate::polynomial::{first_root, roots, value, value_and_slope};
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

const SIDES: [f64; 2] = [1.0, -1.0];

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
    /// Blocks lifted later in this interval: part, block, edge, part of the step.
    pending: Vec<(usize, u32, u8, f64)>,
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
            let Some(tail) = tail.filter(|tail| tail.steps < (wait * self.parts) as f64) else { continue };
            let record = &mut self.records[block as usize];
            record.state = State::AtRest;
            record.impact_count += tail.impacts;
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
                let (at, block, edge, tau) = self.pending[i];
                if at == part {
                    self.start(block, usize::from(edge), 0.0, tau);
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

    /// One step of every lane; lanes with an event stay where they are and go into the queue.
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

    /// Takes up to [`BATCH`] lanes from where they are in the step to their next event, or to its end.
    #[inline(always)]
    fn events<S: Simd, const K: usize, const LINEARISED: bool>(&mut self, simd: S, step: Step, batch: &[u32]) {
        self.batch.gather(&self.moving, batch);
        self.batch.solve::<S, K, LINEARISED>(Math(simd), step.ground, batch.len());
        for (i, &lane) in batch.iter().enumerate() {
            let lane = lane as usize;
            let at = &self.batch;
            let (rank, place) = self.moving.rank_mut(lane);
            rank.best[place] = at.best.0[i];
            if at.event.0[i] == CALM {
                rank.y[place] = at.y.0[i];
                rank.w[place] = at.w.0[i];
                rank.tau[place] = 0.0;
            } else if at.event.0[i] == LANDING {
                self.land(step, lane, at.w.0[i], at.tau.0[i]);
            } else {
                let c = std::array::from_fn(|k| at.c[k].0[i]);
                self.intricate(step, lane, &c, K, at.rest.0[i]);
            }
        }
    }

    /// A step with more than one event, a maximum that is hard to find, the balance lost: by all roots of the series.
    #[inline(never)]
    fn intricate(&mut self, step: Step, lane: usize, c: &[f64; TERMS], degree: usize, rest: f64) {
        let c = &c[..=degree];
        let Moving { block, edge, best, tau, .. } = self.moving.get(lane);
        let Some(lead) = c.iter().position(|&c| c != 0.0).filter(|&k| c[k] > 0.0) else {
            // Nothing lifts it after all.
            if c.iter().all(|c| c.is_finite()) {
                self.come_to_rest(step, lane, 1.0);
            } else {
                self.records[block as usize].state = State::GivenUp;
                self.moving.leave(lane);
            }
            return;
        };
        let reach: f64 = c[lead + 1..].iter().map(|c| c.abs()).sum();
        let highest = c[lead] + reach;
        if !highest.is_finite() {
            self.records[block as usize].state = State::GivenUp;
            self.moving.leave(lane);
            return;
        }
        let impact = if c[lead] > reach { None } else { first_root(&c[lead..]) };
        let overturn = if highest < FRAC_PI_2 {
            None
        } else {
            let mut below = [0.0; TERMS];
            below.iter_mut().zip(c).for_each(|(below, c)| *below = -c);
            below[0] += FRAC_PI_2;
            first_root(&below[..c.len()])
        };
        let end = impact.unwrap_or(1.0).min(overturn.unwrap_or(1.0));
        if overturn.is_some_and(|x| x <= end) {
            let record = &mut self.records[block as usize];
            record.state = State::Overturned;
            record.sides[edge].height = FRAC_PI_2;
            self.moving.leave(lane);
            return;
        }
        let (y, w) = value_and_slope(c, end);
        let mut best = best.max(y);
        if highest > best {
            let mut slope = [0.0; TERMS];
            slope.iter_mut().zip(c.iter().enumerate().skip(1)).for_each(|(slope, (k, c))| *slope = k as f64 * c);
            roots(&slope[..c.len() - 1], &mut |x| {
                if x <= end {
                    best = best.max(value(c, x));
                }
                x < end
            });
        }
        let (rank, place) = self.moving.rank_mut(lane);
        rank.best[place] = best;
        if impact.is_some() || y <= 0.0 {
            let after = if end == 1.0 { 1.0 } else { tau + end * rest };
            self.land(step, lane, w / rest, after);
        } else {
            (rank.y[place], rank.w[place], rank.tau[place]) = (y, w / rest, 0.0);
        }
    }

    /// An impact at the velocity `w` off the edge of a lane.
    fn land(&mut self, step: Step, lane: usize, w: f64, tau: f64) {
        let Moving { block, edge, best, .. } = self.moving.get(lane);
        let rocker = &self.rockers[block as usize];
        let other = 1 - edge;
        let speed = (-w).max(0.0);
        let after = speed * rocker.restitution[other];
        let record = &mut self.records[block as usize];
        record.impact_count += 1;
        let side = &mut record.sides[edge];
        side.height = best;
        side.speed = side.speed.max(speed);
        if record.impact_count > MAX_IMPACTS {
            record.state = State::GivenUp;
            self.moving.leave(lane);
            return;
        }
        let (edge, w, tau) =
            if after > self.rest_w { self.short_flights(step, block, other, after, tau) } else { (other, after, tau) };
        if w > self.rest_w {
            self.turn(lane, edge, w, tau);
            return;
        }
        let (u, v) = step.ground.at(tau);
        let lifted = (0..2).find(|&edge| margin(rocker, edge, u, v) < 0.0);
        match lifted {
            Some(edge) => self.turn(lane, edge, 0.0, tau),
            None => self.come_to_rest(step, lane, tau),
        }
    }

    /// Goes on about `edge` from the floor.
    fn turn(&mut self, lane: usize, edge: usize, w: f64, tau: f64) {
        let block = self.moving.block(lane);
        let best = self.records[block as usize].sides[edge].height;
        // At the very end of the step the next one takes over.
        let over = tau >= 1.0;
        let tau = if over { 0.0 } else { tau };
        self.moving.set(lane, Moving { block, edge, y: 0.0, w, best, tau }, &self.rockers[block as usize]);
        if !over {
            self.again.push(lane as u32);
        }
    }

    /// Follows short flights that leave no trace but impacts: the edge, the speed and the part of the step that is over behind
    /// the last of them; a speed of zero at the end of the step where all that were left end in rest before it.
    fn short_flights(&mut self, step: Step, block: u32, edge: usize, w: f64, tau: f64) -> (usize, f64, f64) {
        let rocker = &self.rockers[block as usize];
        let record = &mut self.records[block as usize];
        let (mut edge, mut w, mut tau) = (edge, w, tau);
        let (u, v) = step.ground.at(tau);
        let (u1, v1) = (step.ground.u_change, step.ground.v_change);
        let acting_about = |edge: usize| {
            let (s, EdgeTerms { threshold, b, .. }) = (SIDES[edge], rocker.edges[edge]);
            let a = threshold * b;
            let a_of_d = if self.linearised { 0.0 } else { a };
            Acting {
                e: Pull { now: a * v + s * b * u, slope: a * v1 + s * b * u1 },
                d: Pull { now: b * v - s * a_of_d * u, slope: b * v1 - s * a_of_d * u1 },
                cosine: if self.linearised { 0.0 } else { 1.0 },
            }
        };
        let mut acting = [acting_about(edge), acting_about(1 - edge)];
        if !acting[0].is_brief(w, 1.0 - tau) {
            return (edge, w, tau);
        }
        if edge == 1 {
            acting.swap(0, 1);
        }
        while w > self.rest_w && record.impact_count < MAX_IMPACTS {
            let left = 1.0 - tau;
            let traces = [record.sides[edge], record.sides[1 - edge]];
            let ahead = [acting[edge], acting[1 - edge]];
            if !self.quiet
                && rocker.restitution[0] == rocker.restitution[1]
                && let Some(impacts) = impacts_to_rest(ahead, rocker.restitution[0], w, left, traces, self.rest_w)
            {
                record.impact_count += impacts;
                return (edge, 0.0, 1.0);
            }
            let Some(flight) = acting[edge].flight(w, left, traces[0].height) else { break };
            record.impact_count += 1;
            let side = &mut record.sides[edge];
            side.speed = side.speed.max(flight.speed);
            acting = [acting[0].after(flight.time), acting[1].after(flight.time)];
            edge = 1 - edge;
            w = flight.speed * rocker.restitution[edge];
            tau += flight.time;
        }
        (edge, w, tau)
    }

    /// A lane comes to rest in a step, and its block waits to be lifted again.
    fn come_to_rest(&mut self, step: Step, lane: usize, tau: f64) {
        let Moving { block, edge, best, .. } = self.moving.get(lane);
        let record = &mut self.records[block as usize];
        record.state = State::AtRest;
        record.sides[edge].height = best;
        self.moving.leave(lane);
        if self.quiet {
            return;
        }
        let ratio = (step.part as f64 + tau) / self.parts as f64;
        match self.lift(block, step.whole, ratio) {
            Some((edge, ratio)) => {
                let (part, tau) = self.part_of(ratio);
                if part <= step.part {
                    let lane = self.start(block, edge, 0.0, tau);
                    self.again.push(lane as u32);
                } else {
                    self.pending.push((part, block, edge as u8, tau));
                }
            }
            None => self.wait(block, step.interval + 2),
        }
    }

    fn part_of(&self, ratio: f64) -> (usize, f64) {
        let place = ratio * self.parts as f64;
        let part = (place as usize).min(self.parts - 1);
        (part, (place - part as f64).clamp(0.0, 1.0))
    }

    /// Enters a block that the base lifts from rest.
    fn start(&mut self, block: u32, edge: usize, w: f64, tau: f64) -> usize {
        let record = &mut self.records[block as usize];
        record.state = State::Moving;
        let best = record.sides[edge].height;
        let lane = self.moving.enter();
        self.moving.set(lane, Moving { block, edge, y: 0.0, w, best, tau }, &self.rockers[block as usize]);
        lane
    }

    /// Puts a block at rest into the list of the interval that ends at the first sample from `from` on that lifts it.
    fn wait(&mut self, block: u32, from: usize) {
        let thresholds = self.rockers[block as usize].edges.map(|edge| edge.threshold);
        if let Some(sample) = self.shaking.first_lift(thresholds, from) {
            let interval = sample.saturating_sub(1);
            self.lifted_next[block as usize] = std::mem::replace(&mut self.lifted_in[interval], block);
        }
    }

    /// Moves the blocks that are lifted in an interval from its list to the pending ones.
    fn lift_waiting(&mut self, interval: usize, whole: Interval) {
        let mut block = std::mem::replace(&mut self.lifted_in[interval], NONE);
        while block != NONE {
            let next = self.lifted_next[block as usize];
            match self.lift(block, whole, 0.0) {
                Some((edge, ratio)) => {
                    let (part, tau) = self.part_of(ratio);
                    self.pending.push((part, block, edge as u8, tau));
                }
                // A quotient and a product may round to either side of the threshold.
                None => self.wait(block, interval + 2),
            }
            block = next;
        }
    }

    /// The edge about which the base lifts a block at rest, and when, from a ratio of an interval on.
    fn lift(&self, block: u32, whole: Interval, from: f64) -> Option<(usize, f64)> {
        let rocker = &self.rockers[block as usize];
        let ((u, v), (u_end, v_end)) = (whole.at(from), whole.at(1.0));
        let mut first: Option<(usize, f64)> = None;
        for edge in 0..2 {
            let (now, end) = (margin(rocker, edge, u, v), margin(rocker, edge, u_end, v_end));
            let at = if now < 0.0 {
                from
            } else if end < 0.0 {
                from + (1.0 - from) * now / (now - end)
            } else {
                continue;
            };
            if at < 1.0 && first.is_none_or(|(_, earliest)| at < earliest) {
                first = Some((edge, at));
            }
        }
        first
    }
}

/// How far the base is from lifting a block about an edge: (1+ü_v/g) tan α + s ü_h/g, negative when it lifts.
fn margin(rocker: &Rocker, edge: usize, u: f64, v: f64) -> f64 {
    v * rocker.edges[edge].threshold + SIDES[edge] * u
}
