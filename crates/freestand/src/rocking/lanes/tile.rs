//! Blocks under one motion, interval by interval: those that move stand side by side in lanes, those at rest wait in the
//! list of the interval in which the base lifts them.

use std::f64::consts::FRAC_PI_2;

use pulp::Simd;

use super::math::Math;
use super::series::{Series, TERMS};
use super::shaking::{Interval, Shaking};
use super::unroll::{unroll, unroll_down};
use crate::polynomial::{first_root, roots, value, value_and_slope};
use crate::rocking::{MAX_IMPACTS, REST_OMEGA_RAD_S, SideExtremes};

/// Lanes of a batch of events, and the multiple to which lanes are filled up: the widest vector there is.
pub(super) const WIDEST: usize = 8;

/// No block, or the end of a list.
const NONE: u32 = u32::MAX;

/// A block as the kernel sees it, in units of the step: ÿ = −(E cos y − D sin y), E = a(1+ü_v/g) + s b ü_h/g,
/// D = b(1+ü_v/g) − s a ü_h/g (linearised: D = b(1+ü_v/g)).
#[derive(Debug, Clone, Copy)]
pub(super) struct Rocker {
    /// About the right edge (s = 1) and about the left one (s = −1).
    pub(super) edges: [EdgeTerms; 2],
    /// Restitution of a landing on each edge.
    pub(super) restitution: [f64; 2],
}

/// A block turning about one edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeTerms {
    /// p²h² sin α, or p²h² α.
    pub(super) a: f64,
    /// p²h² cos α, or p²h².
    pub(super) b: f64,
    /// a of D: 0 linearised.
    pub(super) a_of_d: f64,
    /// tan α, or α.
    pub(super) threshold: f64,
    pub(super) alpha: f64,
}

/// What a block has done so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Record {
    pub(super) sides: [SideExtremes; 2],
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

/// Moving blocks, one number of each kind for each.
#[derive(Debug, Default)]
struct Lanes {
    y: Vec<f64>,
    /// dy/dx over a step.
    w: Vec<f64>,
    /// 1 where the step has an event, else 0.
    event: Vec<f64>,
    a: Vec<f64>,
    b: Vec<f64>,
    /// s times `a_of_d`.
    sa: Vec<f64>,
    /// s b.
    sb: Vec<f64>,
    /// Largest y about this edge so far.
    best: Vec<f64>,
    /// The part of the step that is over.
    tau: Vec<f64>,
    block: Vec<u32>,
    edge: Vec<u8>,
    /// Lanes in use, some of them vacant.
    count: usize,
    vacant: Vec<u32>,
}

pub(super) struct Tile<'a> {
    shaking: &'a Shaking,
    rockers: &'a [Rocker],
    records: Vec<Record>,
    /// Steps of an interval.
    parts: usize,
    lanes: Lanes,
    /// Lanes with an event in the step.
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
    pub(super) fn new(shaking: &'a Shaking, rockers: &'a [Rocker], parts: usize) -> Self {
        Self {
            shaking,
            rockers,
            records: vec![Record::default(); rockers.len()],
            parts,
            lanes: Lanes::default(),
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

    /// Follows every block through the motion, and through at most `quiet_intervals` of rest behind it.
    #[inline(always)]
    pub(super) fn run<S: Simd, const K: usize, const LINEARISED: bool>(
        mut self,
        m: Math<S>,
        quiet_intervals: usize,
    ) -> Vec<Record> {
        for block in 0..self.rockers.len() as u32 {
            self.wait(block, 0);
        }
        for interval in 0..self.shaking.intervals() {
            let whole = self.shaking.interval(interval);
            self.lift_waiting(interval, whole);
            if self.lanes.count > 0 || !self.pending.is_empty() {
                self.pass::<S, K, LINEARISED>(m, interval, whole);
            }
        }
        self.quiet = true;
        let still = Interval { u: 0.0, u_change: 0.0, v: 1.0, v_change: 0.0 };
        for _ in 0..quiet_intervals {
            if self.lanes.count == 0 {
                break;
            }
            self.pass::<S, K, LINEARISED>(m, self.shaking.intervals(), still);
        }
        for lane in 0..self.lanes.count {
            let edge = usize::from(self.lanes.edge[lane]);
            let record = &mut self.records[self.lanes.block[lane] as usize];
            record.sides[edge].peak_rotation_rad = self.lanes.best[lane].max(self.lanes.y[lane]);
            if quiet_intervals > 0 {
                record.state = State::GivenUp;
            }
        }
        self.records
    }

    /// One interval, step by step.
    #[inline(always)]
    fn pass<S: Simd, const K: usize, const LINEARISED: bool>(&mut self, m: Math<S>, interval: usize, whole: Interval) {
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
            self.advance::<S, K, LINEARISED>(m, ground);
            while !self.queue.is_empty() {
                let mut queue = std::mem::take(&mut self.queue);
                for batch in queue.chunks(WIDEST) {
                    self.events::<S, K, LINEARISED>(m, step, batch);
                }
                queue.clear();
                self.queue = std::mem::replace(&mut self.again, queue);
            }
            self.lanes.close_ranks();
        }
        self.pending.clear();
    }

    /// One step of every lane; lanes with an event stay where they are and go into the queue.
    #[inline(always)]
    fn advance<S: Simd, const K: usize, const LINEARISED: bool>(&mut self, m: Math<S>, ground: Interval) {
        let (u0, u1, v0, v1) =
            (m.splat(ground.u), m.splat(ground.u_change), m.splat(ground.v), m.splat(ground.v_change));
        let (half, quarter_turn, zero, one) = (m.splat(0.5), m.splat(FRAC_PI_2), m.splat(0.0), m.splat(1.0));
        let vectors = self.lanes.count.div_ceil(S::F64_LANES);
        let lanes = &mut self.lanes;
        let (ys, _) = S::as_mut_simd_f64s(&mut lanes.y);
        let (ws, _) = S::as_mut_simd_f64s(&mut lanes.w);
        let (best, _) = S::as_simd_f64s(&lanes.best);
        let (events, _) = S::as_mut_simd_f64s(&mut lanes.event);
        let (a, _) = S::as_simd_f64s(&lanes.a);
        let (b, _) = S::as_simd_f64s(&lanes.b);
        let (sa, _) = S::as_simd_f64s(&lanes.sa);
        let (sb, _) = S::as_simd_f64s(&lanes.sb);
        let all = ys[..vectors]
            .iter_mut()
            .zip(&mut ws[..vectors])
            .zip(&mut events[..vectors])
            .zip(&best[..vectors])
            .zip(&a[..vectors])
            .zip(&b[..vectors])
            .zip(&sa[..vectors])
            .zip(&sb[..vectors]);
        for (((((((y, w), event), &best), &a), &b), &sa), &sb) in all {
            let e = [m.fma(u0, sb, m.mul(v0, a)), m.fma(u1, sb, m.mul(v1, a))];
            let d = [m.fnma(u0, sa, m.mul(v0, b)), m.fnma(u1, sa, m.mul(v1, b))];
            let series = Series::<S, K>::new::<LINEARISED>(m, *y, *w, e, d);
            let (y1, w1) = series.end(m);
            let bend = series.bend(m);
            let half_bend = m.mul(half, bend);
            let reach = m.add(m.abs(*w), half_bend);
            let top = m.add(*y, reach);
            // Above the floor throughout: too high to reach it, or going up too fast to come back.
            let above = m.or(m.gt(*y, reach), m.gt(*w, half_bend));
            let calm = m.and(above, m.gt(quarter_turn, top));
            let turning = m.and(m.ge(bend, m.abs(*w)), m.gt(top, best));
            // A maximum that may be the largest so far is an event, too.
            let uneventful = m.and(calm, m.not(turning));
            *y = m.select(uneventful, y1, *y);
            *w = m.select(uneventful, w1, *w);
            *event = m.select(uneventful, zero, one);
        }
        // Apart from the loop above: a branch there would wait for a whole step, and be wrong in every third vector.
        for i in 0..vectors {
            let event = events[i];
            if m.any(m.gt(event, zero)) {
                for (lane, flag) in pulp::bytemuck::cast_slice::<_, f64>(&[event]).iter().enumerate() {
                    if *flag != 0.0 {
                        self.queue.push((i * S::F64_LANES + lane) as u32);
                    }
                }
            }
        }
    }

    /// Takes up to [`WIDEST`] lanes from where they are in the step to their next event, or to its end.
    #[inline(always)]
    fn events<S: Simd, const K: usize, const LINEARISED: bool>(&mut self, m: Math<S>, step: Step, batch: &[u32]) {
        self.batch.gather(&self.lanes, batch);
        self.batch.solve::<S, K, LINEARISED>(m, step.ground);
        for (i, &lane) in batch.iter().enumerate() {
            let lane = lane as usize;
            let at = &self.batch;
            self.lanes.best[lane] = at.best[i];
            if at.event[i] == CALM {
                self.lanes.y[lane] = at.y[i];
                self.lanes.w[lane] = at.w[i];
                self.lanes.tau[lane] = 0.0;
            } else if at.event[i] == LANDING {
                self.land(step, lane, at.w[i], at.tau[i]);
            } else {
                let c = std::array::from_fn(|k| at.c[k][i]);
                self.intricate(step, lane, &c, K, at.rest[i]);
            }
        }
    }

    /// A step with more than one event, a maximum that is hard to find, the balance lost: by all roots of the series.
    #[inline(never)]
    fn intricate(&mut self, step: Step, lane: usize, c: &[f64; TERMS], degree: usize, rest: f64) {
        let c = &c[..=degree];
        let block = self.lanes.block[lane];
        let tau = self.lanes.tau[lane];
        let Some(lead) = c.iter().position(|&c| c != 0.0).filter(|&k| c[k] > 0.0) else {
            // Nothing lifts it after all.
            if c.iter().all(|c| c.is_finite()) {
                self.come_to_rest(step, lane, 1.0);
            } else {
                self.records[block as usize].state = State::GivenUp;
                self.lanes.leave(lane);
            }
            return;
        };
        let reach: f64 = c[lead + 1..].iter().map(|c| c.abs()).sum();
        let highest = c[lead] + reach;
        if !highest.is_finite() {
            self.records[block as usize].state = State::GivenUp;
            self.lanes.leave(lane);
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
            record.sides[usize::from(self.lanes.edge[lane])].peak_rotation_rad = FRAC_PI_2;
            self.lanes.leave(lane);
            return;
        }
        let (y, w) = value_and_slope(c, end);
        let best = &mut self.lanes.best[lane];
        if highest > *best {
            *best = best.max(y);
            let mut slope = [0.0; TERMS];
            slope.iter_mut().zip(c.iter().enumerate().skip(1)).for_each(|(slope, (k, c))| *slope = k as f64 * c);
            roots(&slope[..c.len() - 1], &mut |x| {
                if x <= end {
                    *best = best.max(value(c, x));
                }
                x < end
            });
        }
        if impact.is_some() || y <= 0.0 {
            let after = if end == 1.0 { 1.0 } else { end.mul_add(rest, tau) };
            self.land(step, lane, w / rest, after);
        } else {
            (self.lanes.y[lane], self.lanes.w[lane], self.lanes.tau[lane]) = (y, w / rest, 0.0);
        }
    }

    /// An impact at the velocity `w` off the edge of a lane.
    fn land(&mut self, step: Step, lane: usize, w: f64, tau: f64) {
        let block = self.lanes.block[lane];
        let rocker = &self.rockers[block as usize];
        let edge = usize::from(self.lanes.edge[lane]);
        let other = 1 - edge;
        let speed = (-w).max(0.0);
        let after = speed * rocker.restitution[other];
        let record = &mut self.records[block as usize];
        record.impact_count += 1;
        let side = &mut record.sides[edge];
        side.peak_rotation_rad = self.lanes.best[lane];
        side.impact_omega_rad_s = side.impact_omega_rad_s.max(speed * self.parts as f64 / self.shaking.dt_s);
        if record.impact_count > MAX_IMPACTS {
            record.state = State::GivenUp;
            self.lanes.leave(lane);
            return;
        }
        if after > self.rest_w {
            if let Some(impacts) = self.impacts_to_rest(step, block, other, after, tau) {
                self.records[block as usize].impact_count += impacts;
                self.come_to_rest(step, lane, 1.0);
            } else {
                self.turn(lane, other, after, tau);
            }
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
        let block = self.lanes.block[lane];
        let best = self.records[block as usize].sides[edge].peak_rotation_rad;
        self.lanes.set(lane, block, edge, &self.rockers[block as usize], best, w, tau);
        self.again.push(lane as u32);
    }

    /// How many impacts follow until rest, where they are certain to end within the step and to leave no trace.
    ///
    /// With E > 0 for both edges to the end of the step every flight is a parabola but for what E changes meanwhile: from w
    /// it lasts 2w/E and lands at w(1 + ⅔ E′w/E²). What is neglected, E′w/E² squared and D y/E, is below 1e-6 together.
    fn impacts_to_rest(&self, step: Step, block: u32, edge: usize, w: f64, tau: f64) -> Option<usize> {
        const SMALL: f64 = 1e-3;
        let rocker = &self.rockers[block as usize];
        let record = &self.records[block as usize];
        let [r_right, r_left] = rocker.restitution;
        let r = r_right.max(r_left);
        if self.quiet || r_right != r_left || r >= 1.0 {
            return None;
        }
        let (u, v) = step.ground.at(tau);
        let (u_end, v_end) = step.ground.at(1.0);
        let mut growth = 0.0;
        for (index, terms) in rocker.edges.iter().enumerate() {
            let s = SIDES[index];
            let (from, to) = (terms.a * v + s * terms.b * u, terms.a * v_end + s * terms.b * u_end);
            let least = from.min(to);
            let slope = terms.a * step.ground.v_change + s * terms.b * step.ground.u_change;
            let change = slope * w / (least * least);
            let highest = w * w / (2.0 * least);
            let restoring = terms.b * v.max(v_end) + terms.a * u.abs().max(u_end.abs());
            let side = &record.sides[index];
            let holds = least > 0.0
                && change.abs() <= SMALL * (1.0 - r)
                && restoring * highest <= SMALL * SMALL * least
                && 2.0 * w * (1.0 + SMALL) <= least * (1.0 - r) * (1.0 - tau)
                && highest * (1.0 + SMALL) < side.peak_rotation_rad
                && w * (1.0 + SMALL) * self.parts as f64 / self.shaking.dt_s < side.impact_omega_rad_s;
            if !holds {
                return None;
            }
            growth += change * if index == edge { 1.0 } else { r };
        }
        let growth = 2.0 / 3.0 * growth / (1.0 - r * r);
        Some((((w / self.rest_w).ln() + growth) / -r.ln()).ceil().max(1.0) as usize)
    }

    /// A lane comes to rest in a step, and its block waits to be lifted again.
    fn come_to_rest(&mut self, step: Step, lane: usize, tau: f64) {
        let block = self.lanes.block[lane];
        let record = &mut self.records[block as usize];
        record.state = State::AtRest;
        record.sides[usize::from(self.lanes.edge[lane])].peak_rotation_rad = self.lanes.best[lane];
        self.lanes.leave(lane);
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
        let best = record.sides[edge].peak_rotation_rad;
        let lane = self.lanes.enter();
        self.lanes.set(lane, block, edge, &self.rockers[block as usize], best, w, tau);
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

impl Lanes {
    /// A vacant lane.
    fn enter(&mut self) -> usize {
        if let Some(lane) = self.vacant.pop() {
            return lane as usize;
        }
        if self.count == self.y.len() {
            let size = self.count + WIDEST;
            for (numbers, vacant) in self.numbers().into_iter().zip(VACANT) {
                numbers.resize(size, vacant);
            }
            self.event.resize(size, 0.0);
            self.block.resize(size, NONE);
            self.edge.resize(size, 0);
        }
        self.count += 1;
        self.count - 1
    }

    fn numbers(&mut self) -> [&mut Vec<f64>; 8] {
        [
            &mut self.y,
            &mut self.w,
            &mut self.a,
            &mut self.b,
            &mut self.sa,
            &mut self.sb,
            &mut self.best,
            &mut self.tau,
        ]
    }

    /// A block on the floor.
    #[expect(clippy::too_many_arguments, reason = "a lane has as many numbers")]
    fn set(&mut self, lane: usize, block: u32, edge: usize, rocker: &Rocker, best: f64, w: f64, tau: f64) {
        let (terms, s) = (&rocker.edges[edge], SIDES[edge]);
        self.y[lane] = 0.0;
        self.w[lane] = w;
        self.a[lane] = terms.a;
        self.b[lane] = terms.b;
        self.sa[lane] = s * terms.a_of_d;
        self.sb[lane] = s * terms.b;
        self.best[lane] = best;
        self.tau[lane] = tau;
        self.block[lane] = block;
        self.edge[lane] = edge as u8;
    }

    fn leave(&mut self, lane: usize) {
        for (numbers, vacant) in self.numbers().into_iter().zip(VACANT) {
            numbers[lane] = vacant;
        }
        self.vacant.push(lane as u32);
    }

    /// Fills vacant lanes with the last ones.
    fn close_ranks(&mut self) {
        if self.vacant.is_empty() {
            return;
        }
        let mut vacant = std::mem::take(&mut self.vacant);
        vacant.sort_unstable_by(|a, b| b.cmp(a));
        for lane in vacant.drain(..) {
            let (lane, last) = (lane as usize, self.count - 1);
            for (numbers, vacant) in self.numbers().into_iter().zip(VACANT) {
                numbers.swap(lane, last);
                numbers[last] = vacant;
            }
            self.block.swap(lane, last);
            self.edge.swap(lane, last);
            self.count = last;
        }
        self.vacant = vacant;
    }
}

/// What stands in a vacant lane: a block that nothing moves, higher than none.
const VACANT: [f64; 8] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, f64::INFINITY, 0.0];

/// Lanes between events.
#[derive(Default)]
struct Batch {
    y: [f64; WIDEST],
    w: [f64; WIDEST],
    a: [f64; WIDEST],
    b: [f64; WIDEST],
    sa: [f64; WIDEST],
    sb: [f64; WIDEST],
    best: [f64; WIDEST],
    tau: [f64; WIDEST],
    /// The part of the step that was left.
    rest: [f64; WIDEST],
    event: [f64; WIDEST],
    c: [[f64; WIDEST]; TERMS],
}

const CALM: f64 = 0.0;
const LANDING: f64 = 1.0;
const INTRICATE: f64 = 2.0;

impl Batch {
    #[inline(always)]
    fn gather(&mut self, lanes: &Lanes, batch: &[u32]) {
        for (i, &lane) in batch.iter().enumerate() {
            let lane = lane as usize;
            self.y[i] = lanes.y[lane];
            self.w[i] = lanes.w[lane];
            self.a[i] = lanes.a[lane];
            self.b[i] = lanes.b[lane];
            self.sa[i] = lanes.sa[lane];
            self.sb[i] = lanes.sb[lane];
            self.best[i] = lanes.best[lane];
            self.tau[i] = lanes.tau[lane];
        }
        for i in batch.len()..WIDEST {
            [self.y[i], self.w[i], self.a[i], self.b[i], self.sa[i], self.sb[i], self.best[i], self.tau[i]] = VACANT;
        }
    }

    /// To the next event of each lane, or to the end of the step.
    #[inline(always)]
    fn solve<S: Simd, const K: usize, const LINEARISED: bool>(&mut self, m: Math<S>, ground: Interval) {
        let (u_start, u_change) = (m.splat(ground.u), m.splat(ground.u_change));
        let (v_start, v_change) = (m.splat(ground.v), m.splat(ground.v_change));
        let (zero, one, half) = (m.splat(0.0), m.splat(1.0), m.splat(0.5));
        for i in 0..WIDEST / S::F64_LANES {
            let read = |numbers: &[f64; WIDEST]| S::as_simd_f64s(numbers).0[i];
            let (y, w, tau, best) = (read(&self.y), read(&self.w), read(&self.tau), read(&self.best));
            let rest = m.sub(one, tau);
            let rest2 = m.mul(rest, rest);
            let [a, b, sa, sb] = [&self.a, &self.b, &self.sa, &self.sb].map(|numbers| m.mul(rest2, read(numbers)));
            let (u0, v0) = (m.fma(tau, u_change, u_start), m.fma(tau, v_change, v_start));
            let (u1, v1) = (m.mul(rest, u_change), m.mul(rest, v_change));
            let (on_floor, still) = (m.ge(zero, y), m.ge(zero, m.abs(w)));
            let lifting = m.and(on_floor, still);
            let mut e0 = m.fma(u0, sb, m.mul(v0, a));
            // At the very instant at which the threshold is passed E is zero or less, whatever rounding says.
            e0 = m.select(m.and(lifting, m.gt(e0, zero)), zero, e0);
            let e = [e0, m.fma(u1, sb, m.mul(v1, a))];
            let d = [m.fnma(u0, sa, m.mul(v0, b)), m.fnma(u1, sa, m.mul(v1, b))];
            let w = m.mul(w, rest);
            let series = Series::<S, K>::new::<LINEARISED>(m, y, w, e, d);

            let bend = series.bend(m);
            let top = m.add(y, m.add(m.abs(w), m.mul(half, bend)));
            let falling = m.not(m.gt(m.splat(FRAC_PI_2), top));
            let turning = m.and(m.ge(bend, m.abs(w)), m.gt(top, best));

            // y without the zero that it starts from: y, y/x or y/x².
            let bouncing = m.and(on_floor, m.not(still));
            let mut q = [zero; TERMS];
            unroll!(N, {
                if N <= K {
                    let next = if N < K { series.c[N + 1] } else { zero };
                    let second = if N + 1 < K { series.c[N + 2] } else { zero };
                    q[N] = m.select(lifting, second, m.select(bouncing, next, series.c[N]));
                }
            });
            let (mut beyond, mut bend_of_q, mut end) = (zero, zero, zero);
            unroll_down!(N, {
                if N >= 2 && N <= K {
                    let size = m.abs(q[N]);
                    beyond = m.add(beyond, size);
                    bend_of_q = m.fma(size, m.splat(N as f64), bend_of_q);
                    end = m.add(end, q[N]);
                }
            });
            end = m.add(m.add(end, q[1]), q[0]);
            let begins_above = m.gt(q[0], zero);
            let ends_above = m.gt(end, zero);
            // Too far from the floor, or rising too fast to come back.
            let far = m.gt(q[0], m.add(beyond, m.abs(q[1])));
            let rising = m.and(m.ge(q[0], zero), m.gt(q[1], beyond));
            // One root where y bends down all the way, or q falls all the way, and ends below the floor; none if it does not.
            let concave = series.is_concave(m);
            let falls = m.gt(zero, m.add(q[1], bend_of_q));
            let one_way = m.and(begins_above, m.or(concave, falls));
            let safe = m.or(far, rising);
            let landing = m.and(m.and(one_way, m.not(ends_above)), m.not(safe));
            let calm = m.or(safe, m.and(one_way, ends_above));
            // Where y bends down all the way it has one maximum at most, where its slope passes zero, and before a landing.
            let (_, w1) = series.end(m);
            let climbs = m.and(lifting, m.gt(q[1], bend_of_q));
            let hidden = m.and(turning, m.not(m.or(concave, climbs)));
            let simple = m.and(m.or(calm, landing), m.not(m.or(falling, hidden)));
            let landing = m.and(simple, landing);
            let summits = m.and(m.and(simple, turning), m.and(concave, m.and(m.gt(w, zero), m.gt(zero, w1))));
            if m.any(summits) {
                let (summit, _) = series.at(m, series.summit(m));
                let higher = m.and(summits, m.gt(summit, best));
                S::as_mut_simd_f64s(&mut self.best).0[i] = m.select(higher, summit, best);
            }

            let mut x = one;
            if m.any(landing) {
                x = m.select(landing, root::<S, K>(m, &q, landing), one);
            }
            let (y_end, w_end) = series.at(m, x);
            let event = m.select(landing, m.splat(LANDING), zero);
            // Rounding may take y below the floor where the root lies just behind the end of the step.
            let event = m.select(m.and(simple, m.or(landing, m.gt(y_end, zero))), event, m.splat(INTRICATE));

            let write = |numbers: &mut [f64; WIDEST], value| S::as_mut_simd_f64s(numbers).0[i] = value;
            write(&mut self.y, y_end);
            write(&mut self.w, m.div(w_end, rest));
            write(&mut self.tau, m.fma(x, rest, tau));
            write(&mut self.rest, rest);
            write(&mut self.event, event);
            unroll!(N, {
                if N <= K {
                    write(&mut self.c[N], series.c[N]);
                }
            });
        }
    }
}

/// The root in (0, 1] of a polynomial that falls all the way from above zero to zero or below it, in the lanes wanted:
/// Newton's method within a bracket. A lane that has converged stays, whatever its neighbours do.
#[inline(always)]
fn root<S: Simd, const K: usize>(m: Math<S>, q: &[S::f64s; TERMS], wanted: S::m64s) -> S::f64s {
    /// Halvings of the bracket that reach the last bit, if Newton never did.
    const MOST: usize = 60;
    let (mut low, mut high) = (m.splat(0.0), m.splat(1.0));
    // The parabola's root; without one, the middle.
    let discriminant = m.fnma(m.mul(m.splat(4.0), q[0]), q[2], m.mul(q[1], q[1]));
    let positive = m.gt(discriminant, low);
    let sum = m.sub(m.sqrt(m.select(positive, discriminant, high)), q[1]);
    let guess = m.div(m.add(q[0], q[0]), sum);
    let good = m.and(positive, m.and(m.gt(guess, low), m.gt(high, guess)));
    let mut x = m.select(good, guess, m.splat(0.5));
    let mut open = wanted;
    for _ in 0..MOST {
        let (mut p, mut slope) = (q[K], m.splat(0.0));
        unroll_down!(N, {
            if N < K {
                slope = m.fma(slope, x, p);
                p = m.fma(p, x, q[N]);
            }
        });
        let above = m.gt(p, m.splat(0.0));
        low = m.select(above, x, low);
        high = m.select(above, high, x);
        let newton = m.sub(x, m.div(p, slope));
        let inside = m.and(m.ge(newton, low), m.ge(high, newton));
        let next = m.select(inside, newton, m.mul(m.splat(0.5), m.add(low, high)));
        // Newton doubles the digits: a move in the eighth one is the last.
        let moved = m.gt(m.abs(m.sub(next, x)), m.mul(m.splat(1e-7), x));
        x = m.select(open, next, x);
        open = m.and(open, moved);
        if !m.any(open) {
            break;
        }
    }
    x
}
