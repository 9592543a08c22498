//! Blocks under one motion, interval by interval: moving blocks occupy lanes, and blocks at rest
//! wait in the list of the interval in which the base lifts them.

mod events;
mod waiting;

use pulp::Arch;

use super::batch::{BATCH, Batch};
use super::degree::Degree;
use super::flights::Flights;
use super::quiet::{cannot_fall, tail};
use super::ranks::{Moving, NONE, Ranks};
use super::record::{Record, State, WallRecord};
use super::rocker::{EdgeTerms, Rocker};
use super::shaking::{Interval, Shaking};
use crate::rocking::{MAX_IMPACTS, REST_OMEGA_RAD_S};

/// A block that will be lifted later in the interval: the step in which that happens, and the part
/// of the step that has then passed.
#[derive(Debug, Clone, Copy)]
struct Lift {
    part: usize,
    block: u32,
    edge: usize,
    tau: f64,
}

/// Work done by a tile, for the tests that check it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Work {
    /// Steps of moving blocks.
    pub(super) steps: usize,
    /// Batches of lanes with an event.
    pub(super) batches: usize,
    /// Lanes in these batches.
    pub(super) events: usize,
    /// Lanes that were left to all roots of the series.
    pub(super) intricate: usize,
}

pub(super) struct Tile<'a> {
    shaking: &'a Shaking<'a>,
    rockers: &'a [Rocker],
    pub(super) records: Vec<Record>,
    pub(super) walls: Vec<WallRecord>,
    pub(super) work: Work,
    /// Number of steps in an interval.
    parts: usize,
    arch: Arch,
    degree: Degree,
    moving: Ranks,
    /// Whether any block has a wall.
    walled: bool,
    /// Places of blocks with an event in the step.
    queue: Vec<u32>,
    again: Vec<u32>,
    batch: Batch,
    /// Lanes that wait for the calculation of their short flights.
    flights: Flights,
    /// Linked lists of the blocks lifted in each interval: its first block, and the next after each
    /// block.
    lifted_in: Vec<u32>,
    lifted_next: Vec<u32>,
    pending: Vec<Lift>,
    /// Whether the motion has ended.
    quiet: bool,
    rest_w: f64,
}

/// Intervals in which a lift is looked for at once.
const AHEAD: usize = 64;

/// One step of an interval.
struct Step<'a> {
    interval: usize,
    whole: &'a Interval,
    part: usize,
    ground: &'a Interval,
}

impl<'a> Tile<'a> {
    pub(super) fn new(
        arch: Arch,
        degree: Degree,
        shaking: &'a Shaking<'a>,
        rockers: &'a [Rocker],
        walls: Vec<WallRecord>,
        parts: usize,
    ) -> Self {
        let walled = rockers
            .iter()
            .any(|rocker| rocker.edges.iter().any(EdgeTerms::has_wall));
        Self {
            shaking,
            rockers,
            records: vec![Record::default(); rockers.len()],
            walls,
            work: Work::default(),
            parts,
            arch,
            degree,
            moving: Ranks::default(),
            walled,
            queue: Vec::new(),
            again: Vec::new(),
            batch: Batch::new(walled, rockers.iter().all(Rocker::is_symmetric)),
            flights: Flights::default(),
            lifted_in: vec![NONE; shaking.intervals()],
            lifted_next: vec![NONE; rockers.len()],
            pending: Vec::new(),
            quiet: false,
            rest_w: REST_OMEGA_RAD_S * shaking.dt_s / parts as f64,
        }
    }

    /// Calculates every block through the motion and, with a `wait`, until it rests, for at most
    /// that many intervals after the motion.
    pub(super) fn run(&mut self, wait: Option<usize>) {
        for block in 0..self.rockers.len() as u32 {
            self.wait(block, 0);
        }
        let mut next = 0;
        while let Some(interval) = self.busy_from(next) {
            let whole = self.shaking.interval(interval);
            self.lift_waiting(interval, &whole);
            if !self.moving.is_empty() || !self.pending.is_empty() {
                self.pass(interval, &whole);
            }
            next = interval + 1;
        }
        if let Some(wait) = wait {
            self.settle(wait);
        }
        for lane in 0..self.moving.count() {
            let Moving {
                block,
                edge,
                best,
                y,
                w,
                ..
            } = self.moving.get(lane);
            let record = &mut self.records[block as usize];
            record.sides[edge].height = best.max(y);
            let rocker = &self.rockers[block as usize];
            if record.bounced && y >= rocker.edges[edge].alpha {
                record.state = State::Bouncing;
            }
            // Whether the others fall is not known.
            if wait.is_some() && !cannot_fall(rocker, edge, y, w) {
                record.state = State::GivenUp;
            }
        }
    }

    /// The first interval, from index `from`, in which a block moves or is lifted.
    fn busy_from(&self, from: usize) -> Option<usize> {
        let ahead = self.lifted_in.get(from..).unwrap_or_default();
        if !self.moving.is_empty() {
            return (!ahead.is_empty()).then_some(from);
        }
        // Many at a time where none is lifted, which has all bits of NONE.
        let is_still = |blocks: &&[u32]| blocks.iter().fold(NONE, |all, block| all & block) == NONE;
        let still: usize = ahead
            .chunks(AHEAD)
            .take_while(is_still)
            .map(<[u32]>::len)
            .sum();
        let lifted = ahead[still..].iter().position(|block| *block != NONE)?;
        Some(from + still + lifted)
    }

    /// Calculates the blocks that still move after the motion, for at most `wait` intervals.
    fn settle(&mut self, wait: usize) {
        self.quiet = true;
        for lane in 0..self.moving.count() {
            let Moving {
                block,
                edge,
                y,
                w,
                best,
                ..
            } = self.moving.get(lane);
            let tail = tail(&self.rockers[block as usize], edge, y, w, self.rest_w);
            let Some(tail) = tail.filter(|tail| tail.steps < wait as f64 * self.parts as f64)
            else {
                continue;
            };
            let record = &mut self.records[block as usize];
            record.impact_count += tail.impacts;
            record.state = if record.impact_count > MAX_IMPACTS {
                State::GivenUp
            } else {
                State::AtRest
            };
            record.sides[edge].height = best;
            for (side, tail) in record.sides.iter_mut().zip(tail.sides) {
                side.height = side.height.max(tail.height);
                side.speed = side.speed.max(tail.speed);
            }
            self.moving.leave(lane);
        }
        self.moving.close();
        let still = Interval {
            u: 0.0,
            u_change: 0.0,
            v: 1.0,
            v_change: 0.0,
        };
        for _ in 0..wait {
            if self.moving.is_empty() {
                break;
            }
            self.pass(self.shaking.intervals(), &still);
        }
    }

    /// Calculates one interval, step by step.
    fn pass(&mut self, interval: usize, whole: &Interval) {
        let share = 1.0 / self.parts as f64;
        let advance = self.degree.advance[usize::from(!self.shaking.v.is_empty())];
        for part in 0..self.parts {
            let shared;
            let ground = if self.parts == 1 {
                whole
            } else {
                let (u, v) = whole.at(part as f64 * share);
                shared = Interval {
                    u,
                    u_change: share * whole.u_change,
                    v,
                    v_change: share * whole.v_change,
                };
                &shared
            };
            let step = Step {
                interval,
                whole,
                part,
                ground,
            };
            for i in 0..self.pending.len() {
                let lift = self.pending[i];
                if lift.part == part {
                    self.start(lift.block, lift.edge, lift.tau);
                }
            }
            self.work.steps += self.moving.count();
            advance(self.arch, self.moving.in_use(), ground, &mut self.queue);
            while !self.queue.is_empty() || !self.flights.is_empty() {
                if self.queue.is_empty() {
                    self.fly(&step);
                }
                let mut queue = std::mem::take(&mut self.queue);
                for batch in queue.chunks(BATCH) {
                    self.events(&step, batch);
                }
                queue.clear();
                self.queue = std::mem::replace(&mut self.again, queue);
            }
            self.moving.close();
        }
        self.pending.clear();
    }
}
