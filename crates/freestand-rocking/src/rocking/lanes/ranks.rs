//! Moving blocks in ranks, each as wide as two vectors.

use std::f64::consts::FRAC_PI_2;

use super::rocker::Rocker;
use crate::vector::Column;

/// Number of blocks in a rank: two of the widest vectors.
pub(super) const ABREAST: usize = 16;

/// No block.
pub(super) const NONE: u32 = u32::MAX;

/// One number of each kind for every block of a rank. The numbers of a rank are adjacent in memory,
/// so that no two numbers that are used together compete for the same place in the cache.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rank {
    pub(super) y: Column<ABREAST>,
    /// dy/dx over a step.
    pub(super) w: Column<ABREAST>,
    pub(super) alpha: Column<ABREAST>,
    /// p²h².
    pub(super) x2: Column<ABREAST>,
    /// s.
    pub(super) side: Column<ABREAST>,
    /// Largest y about this edge so far.
    pub(super) best: Column<ABREAST>,
    /// The y that ends the motion about this edge: θ_c of a wall, or π/2.
    pub(super) ceiling: Column<ABREAST>,
    /// The part of the step that has passed.
    pub(super) tau: Column<ABREAST>,
    pub(super) block: [u32; ABREAST],
    /// The lanes that have an event in the step: a bit for each lane of this rank and of those after it.
    pub(super) events: u64,
}

/// The numbers of vacant places: they do not move, and no y exceeds `best`, so they have no event.
const VACANT: Rank = Rank {
    y: Column([1.0; ABREAST]),
    w: Column([0.0; ABREAST]),
    alpha: Column([0.0; ABREAST]),
    x2: Column([0.0; ABREAST]),
    side: Column([0.0; ABREAST]),
    best: Column([f64::INFINITY; ABREAST]),
    ceiling: Column([FRAC_PI_2; ABREAST]),
    events: 0,
    tau: Column([0.0; ABREAST]),
    block: [NONE; ABREAST],
};

/// Moving blocks without gaps, except for the places of blocks that left in this step.
#[derive(Debug, Default)]
pub(super) struct Ranks {
    ranks: Vec<Rank>,
    /// Number of places in use; some may be vacant.
    count: usize,
    vacant: Vec<u32>,
}

/// A moving block: its edge, rotation, velocity, largest rotation and time within the step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving {
    pub(super) block: u32,
    pub(super) edge: usize,
    pub(super) y: f64,
    pub(super) w: f64,
    pub(super) best: f64,
    pub(super) tau: f64,
}

/// s of the right edge and of the left one.
pub(super) const SIDES: [f64; 2] = [1.0, -1.0];

impl Ranks {
    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    pub(super) fn in_use(&mut self) -> &mut [Rank] {
        &mut self.ranks[..self.count.div_ceil(ABREAST)]
    }

    #[inline(always)]
    pub(super) fn rank(&self, lane: usize) -> (&Rank, usize) {
        (&self.ranks[lane / ABREAST], lane % ABREAST)
    }

    #[inline(always)]
    pub(super) fn rank_mut(&mut self, lane: usize) -> (&mut Rank, usize) {
        (&mut self.ranks[lane / ABREAST], lane % ABREAST)
    }

    #[inline(always)]
    pub(super) fn block(&self, lane: usize) -> u32 {
        let (rank, i) = self.rank(lane);
        rank.block[i]
    }

    #[inline(always)]
    pub(super) fn get(&self, lane: usize) -> Moving {
        let (rank, i) = self.rank(lane);
        let edge = usize::from(rank.side[i] < 0.0);
        Moving {
            block: rank.block[i],
            edge,
            y: rank.y[i],
            w: rank.w[i],
            best: rank.best[i],
            tau: rank.tau[i],
        }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, moving: Moving, rocker: &Rocker) {
        let (rank, i) = self.rank_mut(lane);
        let terms = &rocker.edges[moving.edge];
        rank.y[i] = moving.y;
        rank.w[i] = moving.w;
        rank.alpha[i] = terms.alpha;
        rank.x2[i] = terms.x2;
        rank.side[i] = SIDES[moving.edge];
        rank.best[i] = moving.best;
        rank.ceiling[i] = terms.ceiling;
        rank.tau[i] = moving.tau;
        rank.block[i] = moving.block;
    }

    /// Reserves a vacant place and returns it.
    pub(super) fn enter(&mut self) -> usize {
        if let Some(lane) = self.vacant.pop() {
            return lane as usize;
        }
        if self.count == self.ranks.len() * ABREAST {
            self.ranks.push(VACANT);
        }
        self.count += 1;
        self.count - 1
    }

    pub(super) fn leave(&mut self, lane: usize) {
        self.copy(None, lane);
        self.vacant.push(lane as u32);
    }

    /// Fills vacant places with the last blocks.
    pub(super) fn close(&mut self) {
        if self.vacant.is_empty() {
            return;
        }
        let mut vacant = std::mem::take(&mut self.vacant);
        vacant.sort_unstable_by(|a, b| b.cmp(a));
        for lane in vacant.drain(..) {
            self.count -= 1;
            self.copy(Some(self.count), lane as usize);
            self.copy(None, self.count);
        }
        self.vacant = vacant;
    }

    /// Copies a block to another place, or clears that place.
    fn copy(&mut self, from: Option<usize>, to: usize) {
        let (i, j) = (to % ABREAST, from.unwrap_or(0) % ABREAST);
        macro_rules! copy {
            ($($number:ident)*) => {
                $(
                    let number = from.map_or(VACANT.$number[0], |from| self.ranks[from / ABREAST].$number[j]);
                    self.ranks[to / ABREAST].$number[i] = number;
                )*
            };
        }
        copy!(y w alpha x2 side best ceiling tau block);
    }
}
