//! The code that is compiled for each vector unit and each degree of the series.

use pulp::{Arch, Simd, WithSimd};

use super::batch::Batch;
use super::ranks::{ABREAST, Rank};
use super::series::{Edge, Ground, Series};
use super::shaking::Interval;
use crate::vector::{Column, Math};

type AdvanceRanks = fn(Arch, &mut [Rank], &Interval, &mut Vec<u32>);

/// The functions for one degree of the series; each runs on the vector unit of its `Arch`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Degree {
    pub(super) degree: usize,
    /// Takes every lane one step, without and with vertical motion, and adds the places of lanes
    /// with an event to the queue.
    pub(super) advance: [AdvanceRanks; 2],
    /// Takes each of the first lanes of a batch to its next event, or to the end of the step.
    pub(super) solve: fn(Arch, &mut Batch, &Interval, f64, usize),
}

/// Degrees that the kernel is compiled for.
pub(super) const DEGREES: [Degree; 5] = [
    Degree::of::<5>(),
    Degree::of::<6>(),
    Degree::of::<7>(),
    Degree::of::<8>(),
    Degree::of::<11>(),
];

impl Degree {
    const fn of<const K: usize>() -> Self {
        Self {
            degree: K,
            advance: [advance::<K, false>, advance::<K, true>],
            solve: solve::<K>,
        }
    }
}

fn advance<const K: usize, const VERTICAL: bool>(
    arch: Arch,
    ranks: &mut [Rank],
    ground: &Interval,
    queue: &mut Vec<u32>,
) {
    arch.dispatch(Advance::<K, VERTICAL> {
        ranks,
        ground,
        queue,
    });
}

struct Advance<'a, const K: usize, const VERTICAL: bool> {
    ranks: &'a mut [Rank],
    ground: &'a Interval,
    queue: &'a mut Vec<u32>,
}

impl<const K: usize, const VERTICAL: bool> WithSimd for Advance<'_, K, VERTICAL> {
    type Output = ();

    /// Lanes with an event do not change. Neither do lanes that enter within the step: they start
    /// on the floor without velocity, and are never certain to stay above it.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            ranks,
            ground,
            queue,
        } = self;
        let m = Math(simd);
        let (u, u_change) = (m.splat(ground.u), m.splat(ground.u_change));
        let (v, v_change) = (m.splat(ground.v), m.splat(ground.v_change));
        let (half, zero) = (m.splat(0.5), m.splat(0.0));
        for ranks in ranks.chunks_mut(RANKS) {
            let mut events = zero;
            for (place, rank) in ranks.iter_mut().enumerate() {
                let scale = m.splat(SCALES[place]);
                for i in 0..Column::<ABREAST>::pairs::<S>() {
                    let (y, w, best) = (
                        rank.y.get::<S>(i),
                        rank.w.get::<S>(i),
                        rank.best.get::<S>(i),
                    );
                    let (alpha, x2, side) = (
                        rank.alpha.get::<S>(i),
                        rank.x2.get::<S>(i),
                        rank.side.get::<S>(i),
                    );
                    let local = Ground {
                        su: m.mul(side, u),
                        su_change: m.mul(side, u_change),
                        v,
                        v_change,
                    };
                    let series = Series::<S, K>::new::<VERTICAL>(
                        m,
                        y,
                        w,
                        Edge { alpha, x2 },
                        local,
                        |pull| pull,
                    );
                    let (y1, w1) = series.end(m);
                    let bend = series.bend(m);
                    let half_bend = m.mul(half, bend);
                    // y differs from c₀ + c₁x by at most x² times half of the bend.
                    let straight = m.add(y, w);
                    let top = m.add(straight, half_bend);
                    // Above the floor and below π/2, or the wall, throughout; from there, too, if it
                    // leaves them.
                    let above = m.gt(straight, half_bend);
                    let calm = m.and(above, m.gt(rank.ceiling.get::<S>(i), top));
                    let turning = m.and(m.ge(bend, m.abs(w)), m.gt(top, best));
                    // A maximum that may be the largest so far is an event, too.
                    let uneventful = m.and(calm, m.not(turning));
                    rank.y.set::<S>(i, m.select(uneventful, y1, y));
                    rank.w.set::<S>(i, m.select(uneventful, w1, w));
                    let bits = m.mul(scale, LANE_BITS.get::<S>(i));
                    events = m.add(events, m.select(uneventful, zero, bits));
                }
            }
            ranks[0].events = m.sum(events) as u64;
        }
        // Separate from the loop above, where this branch would have to wait for a whole step.
        for (i, ranks) in ranks.chunks(RANKS).enumerate() {
            let mut events = ranks[0].events;
            while events != 0 {
                queue.push((i * RANKS * ABREAST) as u32 + events.trailing_zeros());
                events &= events - 1;
            }
        }
    }
}

/// Number of ranks with a bit for each lane in one number, which is exact as an f64, too.
const RANKS: usize = f64::MANTISSA_DIGITS as usize / ABREAST;

/// The bit of each lane of a rank.
const LANE_BITS: Column<ABREAST> = {
    let mut bits = [1.0; ABREAST];
    let mut lane = 1;
    while lane < ABREAST {
        bits[lane] = 2.0 * bits[lane - 1];
        lane += 1;
    }
    Column(bits)
};

/// The bit of the first lane of each rank.
const SCALES: [f64; RANKS] = [1.0, 65536.0, 65536.0 * 65536.0];

fn solve<const K: usize>(
    arch: Arch,
    batch: &mut Batch,
    ground: &Interval,
    rest_w: f64,
    lanes: usize,
) {
    arch.dispatch(Solve::<K> {
        batch,
        ground,
        rest_w,
        lanes,
    });
}

struct Solve<'a, const K: usize> {
    batch: &'a mut Batch,
    ground: &'a Interval,
    rest_w: f64,
    lanes: usize,
}

impl<const K: usize> WithSimd for Solve<'_, K> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.batch
            .solve::<S, K>(Math(simd), self.ground, self.rest_w, self.lanes);
    }
}
