//! Takes lanes from their place in a step to their next event, several vectors of lanes at a time,
//! so that their chains of operations overlap.

#![expect(
    clippy::absurd_extreme_comparisons,
    reason = "loops are unrolled with constants, one of which is zero"
)]

use std::f64::consts::FRAC_PI_2;

use pulp::Simd;

use super::ranks::{ABREAST, Ranks};
use super::series::{Edge, Ground, Series, TERMS};
use super::shaking::Interval;
use super::unroll::{unroll, unroll_down};
use crate::vector::{Column, Masks, Math, Numbers};

/// Number of lanes in a batch.
pub(super) const BATCH: usize = 2 * ABREAST;

pub(super) const CALM: f64 = 0.0;
pub(super) const LANDING: f64 = 1.0;
pub(super) const INTRICATE: f64 = 2.0;
/// An impact on a wall.
pub(super) const STRIKE: f64 = 6.0;
/// Added to the event of a lane that is too high for it to be certain: a wall may be in the way.
const AHEAD: f64 = 3.0;

/// Lanes with an event in the step.
#[derive(Default)]
pub(super) struct Batch {
    /// Whether any lane may have a wall.
    walled: bool,
    pub(super) y: Column<BATCH>,
    pub(super) w: Column<BATCH>,
    alpha: Column<BATCH>,
    x2: Column<BATCH>,
    side: Column<BATCH>,
    pub(super) best: Column<BATCH>,
    ceiling: Column<BATCH>,
    pub(super) tau: Column<BATCH>,
    /// The part of the step that remained.
    pub(super) rest: Column<BATCH>,
    pub(super) event: Column<BATCH>,
    /// 1 where y may have its largest maximum so far inside the step.
    summit: Column<BATCH>,
    /// Terms of y.
    pub(super) c: [Column<BATCH>; TERMS],
    /// The polynomial whose root is the event: the terms of y divided by the power of x with which
    /// it starts at zero, y, y/x or y/x²; before an impact on a wall those of d = θ_c − y, d or d/x.
    q: [Column<BATCH>; TERMS],
}

impl Batch {
    /// A batch of lanes of which some may have walls, or none has.
    pub(super) fn new(walled: bool) -> Self {
        Self {
            walled,
            ..Self::default()
        }
    }

    #[inline(always)]
    pub(super) fn gather(&mut self, moving: &Ranks, batch: &[u32]) {
        for (i, &lane) in batch.iter().enumerate() {
            let (rank, place) = moving.rank(lane as usize);
            self.y[i] = rank.y[place];
            self.w[i] = rank.w[place];
            self.alpha[i] = rank.alpha[place];
            self.x2[i] = rank.x2[place];
            self.side[i] = rank.side[place];
            self.best[i] = rank.best[place];
            self.ceiling[i] = rank.ceiling[place];
            self.tau[i] = rank.tau[place];
        }
        for i in batch.len()..batch.len().next_multiple_of(ABREAST) {
            // Padding: a block that does not move and has no event.
            (self.y[i], self.w[i], self.x2[i], self.best[i], self.tau[i]) =
                (1.0, 0.0, 0.0, f64::INFINITY, 0.0);
            self.ceiling[i] = FRAC_PI_2;
        }
    }

    /// Takes each of the first `lanes` lanes to its next event, or to the end of the step.
    #[inline(always)]
    pub(super) fn solve<S: Simd, const K: usize>(
        &mut self,
        m: Math<S>,
        ground: &Interval,
        lanes: usize,
    ) {
        let vectors = lanes.div_ceil(2 * S::F64_LANES);
        for i in 0..vectors {
            self.expand::<S, K>(m, ground, i);
        }
        for i in 0..if self.walled { vectors } else { 0 } {
            let walled = m.gt(m.splat(FRAC_PI_2), self.ceiling.get::<S>(i));
            if m.any(m.and(walled, m.ge(self.event.get::<S>(i), m.splat(INTRICATE)))) {
                self.at_walls::<S, K>(m, i);
            }
        }
        for i in 0..vectors {
            if m.any(m.gt(self.summit.get::<S>(i), m.splat(0.0))) {
                self.climb::<S, K>(m, i);
            }
        }
        for i in 0..vectors {
            self.fall::<S, K>(m, i);
        }
    }

    /// Calculates the series of a vector of lanes and classifies the rest of the step.
    #[inline(always)]
    fn expand<S: Simd, const K: usize>(&mut self, m: Math<S>, ground: &Interval, i: usize) {
        let (u_start, u_change) = (m.splat(ground.u), m.splat(ground.u_change));
        let (v_start, v_change) = (m.splat(ground.v), m.splat(ground.v_change));
        let (zero, one, half) = (m.splat(0.0), m.splat(1.0), m.splat(0.5));
        let (y, w) = (self.y.get::<S>(i), self.w.get::<S>(i));
        let (tau, best) = (self.tau.get::<S>(i), self.best.get::<S>(i));
        let rest = m.sub(one, tau);
        let rest2 = m.mul(rest, rest);
        let (alpha, x2, side) = (
            self.alpha.get::<S>(i),
            self.x2.get::<S>(i),
            self.side.get::<S>(i),
        );
        let edge = Edge {
            alpha,
            x2: m.mul(rest2, x2),
        };
        let local = Ground {
            su: m.mul(side, m.fma(tau, u_change, u_start)),
            su_change: m.mul(side, m.mul(rest, u_change)),
            v: m.fma(tau, v_change, v_start),
            v_change: m.mul(rest, v_change),
        };
        let (on_floor, still) = (m.ge(zero, y), m.ge(zero, m.abs(w)));
        let lifting = m.and(on_floor, still);
        // At the instant at which the threshold is passed nothing pulls the block down; a positive
        // pull is rounding.
        let lifted = |pull| m.select(m.and(lifting, m.gt(pull, zero)), zero, pull);
        let w = m.mul(w, rest);
        let series = Series::<S, K>::new::<true>(m, y, w, edge, local, lifted);

        let bend = series.bend(m);
        let top = m.add(y, m.add(m.abs(w), m.mul(half, bend)));
        // Up to the wall, or to π/2.
        let falling = m.not(m.gt(self.ceiling.get::<S>(i), top));
        let turning = m.and(m.ge(bend, m.abs(w)), m.gt(top, best));

        // y divided by the power of x with which it starts at zero: y, y/x or y/x².
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
        // Where y is concave, or q falls, throughout the step, there is one root if it ends below
        // the floor, and none otherwise.
        let concave = series.is_concave(m);
        let falls = m.gt(zero, m.add(q[1], bend_of_q));
        let one_way = m.and(begins_above, m.or(concave, falls));
        let safe = m.or(far, rising);
        let landing = m.and(m.and(one_way, m.not(ends_above)), m.not(safe));
        let calm = m.or(safe, m.and(one_way, ends_above));
        // Where y is concave throughout it has at most one maximum, where its slope passes zero,
        // before any landing.
        let (_, w1) = series.end(m);
        let climbs = m.and(lifting, m.gt(q[1], bend_of_q));
        let hidden = m.and(turning, m.not(m.or(concave, climbs)));
        let simple = m.and(m.or(calm, landing), m.not(m.or(falling, hidden)));
        let summit = m.and(
            m.and(simple, turning),
            m.and(concave, m.and(m.gt(w, zero), m.ge(zero, w1))),
        );
        let event = m.select(landing, m.splat(LANDING), m.splat(CALM));
        // Where it is too high, and nothing else is in the way, a wall decides (`at_walls`).
        let ahead = m.select(
            m.or(simple, hidden),
            m.splat(INTRICATE),
            m.add(event, m.splat(AHEAD)),
        );
        let ahead = m.select(m.or(calm, landing), ahead, m.splat(INTRICATE));
        self.event.set::<S>(i, m.select(simple, event, ahead));
        self.summit.set::<S>(i, m.select(summit, one, zero));
        self.rest.set::<S>(i, rest);
        unroll!(N, {
            if N <= K {
                self.c[N].set::<S>(i, series.c[N]);
                self.q[N].set::<S>(i, q[N]);
            }
        });
    }

    /// Decides for a vector of lanes what is certain about a wall in the rest of the step. The other
    /// lanes are left to all roots of the series.
    #[inline(always)]
    fn at_walls<S: Simd, const K: usize>(&mut self, m: Math<S>, i: usize) {
        let zero = m.splat(0.0);
        let (ceiling, event) = (self.ceiling.get::<S>(i), self.event.get::<S>(i));
        let mut series = Series::<S, K> {
            c: [zero; TERMS],
            slope: [zero; TERMS],
        };
        unroll!(N, {
            if N <= K {
                series.c[N] = self.c[N].get::<S>(i);
                series.slope[N] = m.mul(m.splat(N as f64), series.c[N]);
            }
        });
        let (y, w) = (series.c[0], series.c[1]);
        let (y1, w1) = series.end(m);
        let (bend, concave, convex) = (series.bend(m), series.is_concave(m), series.is_convex(m));
        let open = m.and(
            m.gt(m.splat(FRAC_PI_2), ceiling),
            m.ge(event, m.splat(INTRICATE)),
        );
        let (up, below) = (m.gt(w, zero), m.gt(ceiling, y));
        let (reaches, stays_below) = (m.ge(y1, ceiling), m.gt(ceiling, y1));
        // Up throughout, or up to a maximum: one impact at most.
        let rises = m.and(below, m.or(m.gt(w, bend), m.and(up, convex)));
        let arches = m.and(below, m.and(up, concave));
        let sinks = m.and(m.ge(zero, w), m.or(m.gt(m.sub(zero, w), bend), concave));
        // It leaves the wall and is pressed back to it; the curve is above its first tangent, which
        // is above the floor.
        let pressed = m.and(
            m.and(m.ge(y, ceiling), m.gt(zero, w)),
            m.and(convex, m.gt(m.add(y, w), zero)),
        );
        let strikes = m.and(open, m.and(reaches, m.or(pressed, m.or(rises, arches))));
        let passes = m.and(stays_below, m.or(rises, m.and(arches, m.gt(w1, zero))));
        // Without an impact on the wall it is as if there were none.
        let clear = m.and(
            m.and(open, m.ge(event, m.splat(AHEAD))),
            m.or(sinks, passes),
        );
        let event = m.select(clear, m.sub(event, m.splat(AHEAD)), event);
        let event = m.select(
            m.and(open, m.and(pressed, stays_below)),
            m.splat(CALM),
            event,
        );
        self.event
            .set::<S>(i, m.select(strikes, m.splat(STRIKE), event));
        unroll!(N, {
            if N <= K {
                let from = if N == 0 { ceiling } else { zero };
                let next = if N < K { series.c[N + 1] } else { zero };
                let gap = m.select(pressed, m.sub(zero, next), m.sub(from, series.c[N]));
                self.q[N].set::<S>(i, m.select(strikes, gap, self.q[N].get::<S>(i)));
            }
        });
    }

    /// Raises the largest y to a maximum inside the step.
    #[inline(always)]
    fn climb<S: Simd, const K: usize>(&mut self, m: Math<S>, i: usize) {
        let mut slope = [m.splat(0.0); TERMS];
        unroll!(N, {
            if N < K {
                slope[N] = m.mul(m.splat((N + 1) as f64), self.c[N + 1].get::<S>(i));
            }
        });
        let wanted = m.gt(self.summit.get::<S>(i), m.splat(0.0));
        let x = root::<S, K>(m, &slope, wanted);
        let mut y = self.c[K].get::<S>(i);
        unroll_down!(N, {
            if N < K {
                y = m.fma(y, x, self.c[N].get::<S>(i));
            }
        });
        let best = self.best.get::<S>(i);
        self.best
            .set::<S>(i, m.select(m.and(wanted, m.gt(y, best)), y, best));
    }

    /// Takes a vector of lanes to the landing, to the wall, or to the end of the step.
    #[inline(always)]
    fn fall<S: Simd, const K: usize>(&mut self, m: Math<S>, i: usize) {
        let (zero, one) = (m.splat(0.0), m.splat(1.0));
        let (event, rest, tau) = (
            self.event.get::<S>(i),
            self.rest.get::<S>(i),
            self.tau.get::<S>(i),
        );
        let landing = m.and(m.ge(event, m.splat(LANDING)), m.ge(m.splat(LANDING), event));
        let ends = m.or(landing, m.ge(event, m.splat(STRIKE)));
        let mut q = [zero; TERMS];
        unroll!(N, {
            if N <= K {
                q[N] = self.q[N].get::<S>(i);
            }
        });
        let x = m.select(ends, root::<S, K>(m, &q, ends), one);
        let (mut y, mut w) = (self.c[K].get::<S>(i), zero);
        unroll_down!(N, {
            if N < K {
                w = m.fma(w, x, y);
                y = m.fma(y, x, self.c[N].get::<S>(i));
            }
        });
        // Rounding may take y below the floor where the root lies just past the end of the step.
        let event = m.select(
            m.or(m.ge(event, one), m.gt(y, zero)),
            event,
            m.splat(INTRICATE),
        );
        // A maximum exactly at the end belongs to this step.
        let best = self.best.get::<S>(i);
        self.best.set::<S>(i, m.select(m.gt(y, best), y, best));
        self.y.set::<S>(i, y);
        self.w.set::<S>(i, m.div(w, rest));
        self.tau.set::<S>(i, m.fma(x, rest, tau));
        self.event.set::<S>(i, event);
    }
}

/// Steps of Halley's method before the first check: two take nearly every lane to its root.
const STEPS: usize = 2;

/// The step of Halley's method that moves a root by at most this fraction of the root, and of the
/// distance |2p′/p″| to the place where the curve is flat, is the last: an error e becomes
/// (p″/2p′)² e³.
const LAST_MOVE: f64 = 3e-6;

/// The root in (0, 1] of a polynomial that is positive before it and not positive after it, in the
/// `wanted` lanes, by Halley's method within a bracket. A lane that has converged does not change
/// while its neighbours continue.
#[inline(always)]
fn root<S: Simd, const K: usize>(
    m: Math<S>,
    q: &[Numbers<S>; TERMS],
    wanted: Masks<S>,
) -> Numbers<S> {
    /// Largest number of steps: 60 halvings alone reduce the bracket to 2⁻⁶⁰ of a step.
    const MOST: usize = 60;
    let (zero, one, half) = (m.splat(0.0), m.splat(1.0), m.splat(0.5));
    let (mut low, mut high) = (zero, one);
    // The first guess: the root of the parabola or, without one, the end of the step.
    let discriminant = m.fnma(m.mul(m.splat(4.0), q[0]), q[2], m.mul(q[1], q[1]));
    let positive = m.gt(discriminant, zero);
    let sum = m.sub(m.sqrt(m.select(positive, discriminant, one)), q[1]);
    let guess = m.div(m.add(q[0], q[0]), sum);
    let good = m.and(positive, m.and(m.gt(guess, zero), m.gt(one, guess)));
    let mut x = m.select(good, guess, one);
    let mut open = wanted;
    for step in 1..=MOST {
        let (mut p, mut slope, mut half_bend) = (q[K], zero, zero);
        unroll_down!(N, {
            if N < K {
                half_bend = m.fma(half_bend, x, slope);
                slope = m.fma(slope, x, p);
                p = m.fma(p, x, q[N]);
            }
        });
        let above = m.gt(p, zero);
        low = m.select(above, x, low);
        high = m.select(above, high, x);
        let (square, product) = (m.mul(slope, slope), m.mul(p, half_bend));
        let halley = m.sub(x, m.div(m.mul(p, slope), m.sub(square, product)));
        // Near the top of a curve the steps are short because it is flat, not because a root is
        // near.
        let falling = m.and(m.gt(zero, slope), m.ge(m.mul(half, square), m.abs(product)));
        let inside = m.and(falling, m.and(m.ge(halley, low), m.ge(high, halley)));
        let next = m.select(inside, halley, m.mul(half, m.add(low, high)));
        let moved = m.abs(m.sub(next, x));
        let last = m.splat(LAST_MOVE);
        let near = m.and(
            m.ge(m.mul(last, x), moved),
            m.ge(m.mul(last, m.abs(slope)), m.mul(moved, m.abs(half_bend))),
        );
        let near = m.and(inside, near);
        x = m.select(open, next, x);
        open = m.and(open, m.not(near));
        if step >= STEPS && !m.any(open) {
            break;
        }
    }
    x
}
