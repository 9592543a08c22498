//! Takes lanes from their place in a step to their next event, several vectors of lanes at a time,
//! so that their chains of operations overlap.

#![expect(
    clippy::absurd_extreme_comparisons,
    reason = "loops are unrolled with constants, one of which is zero"
)]

use std::f64::consts::FRAC_PI_2;

use pulp::Simd;

use super::flights::is_brief;
use super::ranks::{ABREAST, Ranks};
use super::record::{Record, WallRecord};
use super::rocker::Rocker;
use super::series::{Edge, Ground, Series, Shape, TERMS};
use super::shaking::Interval;
use super::unroll::{unroll, unroll_down};
use crate::vector::{Column, Masks, Math, Numbers};

/// Number of lanes in a batch.
pub(super) const BATCH: usize = 2 * ABREAST;

pub(super) const CALM: f64 = 0.0;
pub(super) const LANDING: f64 = 1.0;
pub(super) const INTRICATE: f64 = 2.0;
/// An impact on a wall.
pub(super) const STRIKE: f64 = 3.0;

/// Without an impact, or after one that short flights or rest may follow.
pub(super) const STOPS: f64 = 0.0;
/// After an impact, with more to come in the step.
pub(super) const TURNS: f64 = 1.0;
/// At the end of the step, after an impact.
pub(super) const GOES_ON: f64 = 2.0;

/// Lanes with an event in the step.
#[derive(Default)]
pub(super) struct Batch {
    /// Whether any lane may have a wall.
    walled: bool,
    /// Whether both edges of every block are alike.
    pub(super) alike: bool,
    pub(super) y: Column<BATCH>,
    pub(super) w: Column<BATCH>,
    alpha: Column<BATCH>,
    x2: Column<BATCH>,
    pub(super) side: Column<BATCH>,
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
    pub(super) other: Other,
    /// Restitution of an impact on the wall beyond the edge.
    wall_restitution: Column<BATCH>,
    /// The speed of an impact.
    pub(super) speed: Column<BATCH>,
    /// What an impact led to: [`STOPS`], [`TURNS`] or [`GOES_ON`].
    pub(super) turn: Column<BATCH>,
}

/// What a landing needs of the other edge.
#[derive(Default)]
pub(super) struct Other {
    pub(super) alpha: Column<BATCH>,
    pub(super) x2: Column<BATCH>,
    pub(super) ceiling: Column<BATCH>,
    pub(super) best: Column<BATCH>,
    restitution: Column<BATCH>,
}

/// What is known of blocks besides their place.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub(super) rockers: &'a [Rocker],
    pub(super) records: &'a [Record],
    pub(super) walls: &'a [WallRecord],
}

impl Batch {
    /// A batch of lanes of which some may have walls, or none has.
    pub(super) fn new(walled: bool, alike: bool) -> Self {
        Self {
            walled,
            alike,
            ..Self::default()
        }
    }

    #[inline(always)]
    pub(super) fn gather(&mut self, moving: &Ranks, batch: &[u32], known: Known) {
        let mut blocks = [0; BATCH];
        for (i, &lane) in batch.iter().enumerate() {
            let (rank, place) = moving.rank(lane as usize);
            blocks[i] = rank.block[place];
            self.y[i] = rank.y[place];
            self.w[i] = rank.w[place];
            self.alpha[i] = rank.alpha[place];
            self.x2[i] = rank.x2[place];
            self.side[i] = rank.side[place];
            self.best[i] = rank.best[place];
            self.ceiling[i] = rank.ceiling[place];
            self.tau[i] = rank.tau[place];
        }
        for (i, block) in blocks.iter().enumerate().take(batch.len()) {
            let block = *block as usize;
            let edge = usize::from(self.side[i] < 0.0);
            let beyond = 1 - edge;
            let rocker = &known.rockers[block];
            if !self.alike {
                let terms = &rocker.edges[beyond];
                self.other.alpha[i] = terms.alpha;
                self.other.x2[i] = terms.x2;
                self.other.ceiling[i] = terms.ceiling;
            }
            self.other.restitution[i] = rocker.restitution[beyond];
            self.other.best[i] = known.records[block].sides[beyond].height;
            if self.walled {
                self.wall_restitution[i] = known.walls[block].restitution[edge];
            }
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
        rest_w: f64,
        lanes: usize,
    ) {
        let vectors = lanes.div_ceil(2 * S::F64_LANES);
        for i in 0..vectors {
            self.expand::<S, K>(m, ground, i);
        }
        for i in 0..vectors {
            if m.any(m.gt(self.summit.get::<S>(i), m.splat(0.0))) {
                self.climb::<S, K>(m, i);
            }
        }
        for i in 0..vectors {
            self.fall::<S, K>(m, i);
        }
        for i in 0..vectors {
            self.turn::<S, K>(m, ground, rest_w, i);
        }
    }

    /// Calculates the series of a vector of lanes and classifies the rest of the step.
    #[inline(always)]
    fn expand<S: Simd, const K: usize>(&mut self, m: Math<S>, ground: &Interval, i: usize) {
        let (zero, one, half) = (m.splat(0.0), m.splat(1.0), m.splat(0.5));
        let (y, w) = (self.y.get::<S>(i), self.w.get::<S>(i));
        let (tau, best) = (self.tau.get::<S>(i), self.best.get::<S>(i));
        let rest = m.sub(one, tau);
        let whole = Edge {
            alpha: self.alpha.get::<S>(i),
            x2: self.x2.get::<S>(i),
        };
        let (edge, local) = rest_of_step(m, ground, tau, whole, self.side.get::<S>(i));
        let (on_floor, still) = (m.ge(zero, y), m.ge(zero, m.abs(w)));
        let lifting = m.and(on_floor, still);
        // At the instant at which the threshold is passed nothing pulls the block down; a positive
        // pull is rounding.
        let ceiling = self.ceiling.get::<S>(i);
        let walled = self.walled;
        let lifted = |pull| {
            let lifted = m.select(m.and(lifting, m.gt(pull, zero)), zero, pull);
            if walled {
                // Nor does anything press it on when it leaves the wall.
                let leaving = m.and(m.ge(y, ceiling), still);
                m.select(m.and(leaving, m.gt(zero, lifted)), zero, lifted)
            } else {
                lifted
            }
        };
        let w = m.mul(w, rest);
        let series = Series::<S, K>::new::<true>(m, y, w, edge, local, lifted);

        let shape = series.shape(m);
        let Shape { bend, y1, w1, .. } = shape;
        let top = m.add(m.add(y, w), m.mul(half, bend));
        // Up to the wall, or to π/2.
        let high = m.not(m.gt(ceiling, top));
        let turning = m.and(m.ge(bend, m.abs(w)), m.gt(top, best));

        let (up, ends_up) = (m.gt(w, zero), m.gt(w1, zero));
        let leaves = m.or(up, lifting);
        let begins_above = m.select_mask(
            on_floor,
            m.select_mask(still, m.gt(series.c[2], zero), up),
            m.not(on_floor),
        );
        let ends_above = m.gt(y1, zero);
        let falls = m.gt(zero, m.add(w, bend));
        // Without a lowest point inside the step it is above the floor if it ends above.
        let no_dip = m.or(
            m.or(shape.concave, falls),
            m.or(
                m.and(shape.opens, m.not(ends_up)),
                m.and(shape.closes, leaves),
            ),
        );
        // One root if it ends below the floor: the slope does not turn down, up and down again.
        let no_wave = m.or(
            m.or(m.or(shape.concave, shape.convex), m.or(falls, shape.opens)),
            m.and(shape.closes, m.or(leaves, ends_up)),
        );
        let safe = series.stays_above(m);
        let landing = m.and(m.and(begins_above, no_wave), m.not(m.or(ends_above, safe)));
        let calm = m.or(safe, m.and(begins_above, m.and(ends_above, no_dip)));
        // Where the slope bends one way throughout it changes its sign twice at most. One change from
        // up to down is a maximum, which comes before any landing.
        let bent = m.or(shape.concave, m.or(shape.opens, shape.closes));
        let one_top = m.and(m.and(up, m.not(ends_up)), bent);
        let no_top = m.or(
            m.or(shape.convex, m.and(shape.opens, m.not(up))),
            m.or(
                m.and(shape.closes, ends_up),
                m.and(shape.concave, m.or(m.not(up), ends_up)),
            ),
        );
        let hidden = m.and(turning, m.not(m.or(one_top, no_top)));
        let simple = m.and(m.or(calm, landing), m.not(m.or(high, hidden)));
        let mut event = m.select(
            simple,
            m.select(landing, m.splat(LANDING), m.splat(CALM)),
            m.splat(INTRICATE),
        );
        if self.walled {
            let walled = m.and(high, m.gt(m.splat(FRAC_PI_2), ceiling));
            if m.any(walled) {
                let decided = m.and(m.or(calm, landing), m.not(hidden));
                let otherwise = m.select(landing, m.splat(LANDING), m.splat(CALM));
                let at_wall = at_wall::<S, K>(m, &series, &shape, ceiling, calm);
                let free = m.and(walled, m.and(decided, at_wall.clear));
                event = m.select(free, otherwise, event);
                event = m.select(m.and(walled, at_wall.returns), m.splat(CALM), event);
                event = m.select(m.and(walled, at_wall.strikes), m.splat(STRIKE), event);
            }
        }
        let summit = m.and(
            m.and(turning, one_top),
            m.not(m.ge(event, m.splat(INTRICATE))),
        );
        self.event.set::<S>(i, event);
        self.summit.set::<S>(i, m.select(summit, one, zero));
        self.rest.set::<S>(i, rest);
        unroll!(N, {
            if N <= K {
                self.c[N].set::<S>(i, series.c[N]);
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
        let x = if m.any(ends) {
            let q = self.ending::<S, K>(m, i, landing);
            m.select(ends, root::<S, K>(m, &q, ends), one)
        } else {
            one
        };
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

    /// The polynomial whose root is the event: the terms of y divided by the power of x with which it
    /// starts at zero, y, y/x or y/x²; before an impact on a wall those of d = θ_c − y, d or d/x.
    #[inline(always)]
    fn ending<S: Simd, const K: usize>(
        &self,
        m: Math<S>,
        i: usize,
        landing: Masks<S>,
    ) -> [Numbers<S>; TERMS] {
        let zero = m.splat(0.0);
        let mut q = [zero; TERMS];
        unroll!(N, {
            if N <= K {
                q[N] = self.c[N].get::<S>(i);
            }
        });
        let from_floor = m.and(landing, m.ge(zero, q[0]));
        if m.any(from_floor) {
            let lifted = m.and(from_floor, m.ge(zero, m.abs(q[1])));
            unroll!(N, {
                if N <= K {
                    let next = if N < K { q[N + 1] } else { zero };
                    let second = if N + 1 < K { q[N + 2] } else { zero };
                    q[N] = m.select(lifted, second, m.select(from_floor, next, q[N]));
                }
            });
        }
        let strikes = m.ge(self.event.get::<S>(i), m.splat(STRIKE));
        if self.walled && m.any(strikes) {
            let ceiling = self.ceiling.get::<S>(i);
            let from_wall = m.ge(q[0], ceiling);
            unroll!(N, {
                if N <= K {
                    let from = if N == 0 { ceiling } else { zero };
                    let next = if N < K { q[N + 1] } else { zero };
                    let gap = m.select(from_wall, m.sub(zero, next), m.sub(from, q[N]));
                    q[N] = m.select(strikes, gap, q[N]);
                }
            });
        }
        q
    }

    /// Takes a vector of lanes from an impact to the end of the step, where nothing else happens in it.
    #[inline(always)]
    fn turn<S: Simd, const K: usize>(
        &mut self,
        m: Math<S>,
        ground: &Interval,
        rest_w: f64,
        i: usize,
    ) {
        let (zero, one, half) = (m.splat(0.0), m.splat(1.0), m.splat(0.5));
        let event = self.event.get::<S>(i);
        let landing = m.and(m.ge(event, m.splat(LANDING)), m.ge(m.splat(LANDING), event));
        let hits = m.or(landing, m.ge(event, m.splat(STRIKE)));
        self.turn.set::<S>(i, m.splat(STOPS));
        if !m.any(hits) {
            return;
        }
        let (w, tau) = (self.w.get::<S>(i), self.tau.get::<S>(i));
        let mut toward = m.sub(zero, w);
        let mut restitution = self.other.restitution.get::<S>(i);
        if self.walled {
            toward = m.select(landing, toward, w);
            restitution = m.select(landing, restitution, self.wall_restitution.get::<S>(i));
        }
        let speed = m.select(m.gt(toward, zero), toward, zero);
        let after = m.mul(speed, restitution);
        self.speed.set::<S>(i, speed);
        let goes = m.and(hits, m.gt(after, m.splat(rest_w)));
        if !m.any(goes) {
            return;
        }

        let ceiling = self.ceiling.get::<S>(i);
        let (mut side, mut y, mut w) = (m.sub(zero, self.side.get::<S>(i)), zero, after);
        let (mut alpha, mut x2) = (self.alpha.get::<S>(i), self.x2.get::<S>(i));
        let mut limit = ceiling;
        if !self.alike {
            alpha = m.select(landing, self.other.alpha.get::<S>(i), alpha);
            x2 = m.select(landing, self.other.x2.get::<S>(i), x2);
            limit = m.select(landing, self.other.ceiling.get::<S>(i), limit);
        }
        let mut best = self.other.best.get::<S>(i);
        if self.walled {
            side = m.select(landing, side, self.side.get::<S>(i));
            y = m.select(landing, zero, ceiling);
            w = m.select(landing, after, m.sub(zero, after));
            best = m.select(landing, best, ceiling);
        }
        let (edge, local) = rest_of_step(m, ground, tau, Edge { alpha, x2 }, side);
        let rest = m.sub(one, tau);
        let local_w = m.mul(w, rest);
        let series = Series::<S, K>::new::<true>(m, y, local_w, edge, local, |pull| pull);
        // What pulls it back to where it bounced, and the change of that over the rest of the step.
        let mut pull = m.sub(zero, series.slope[2]);
        let [sin, cos] = series.start;
        let mut change = m.fma(local.v_change, sin, m.mul(local.su_change, cos));
        let mut goes = goes;
        if self.walled {
            pull = m.select(landing, pull, m.sub(zero, pull));
            change = m.select(landing, change, m.sub(zero, change));
            // Beside a wall that it touches, a landing is an impact on that, too.
            goes = m.and(goes, m.or(m.not(landing), m.gt(limit, zero)));
        }
        let least = m.smaller(pull, m.add(pull, change));
        let goes = m.and(goes, m.not(is_brief(m, local_w, least)));

        let bend = series.bend(m);
        let half_bend = m.mul(half, bend);
        let straight = m.add(y, local_w);
        let top = m.add(straight, half_bend);
        // Above the floor and below the wall or π/2 throughout; from there, too, if it leaves them.
        let above = m.gt(straight, half_bend);
        let below = m.gt(limit, top);
        let turning = m.and(m.ge(bend, m.abs(local_w)), m.gt(top, best));
        let calm = m.and(m.and(above, below), m.not(turning));
        let (mut y1, mut w1) = (series.c[K], zero);
        unroll_down!(N, {
            if N < K {
                w1 = m.add(w1, y1);
                y1 = m.add(y1, series.c[N]);
            }
        });
        let w1 = m.div(w1, rest);
        let calm = m.and(calm, m.gt(y1, zero));
        best = m.select(m.and(calm, m.gt(y1, best)), y1, best);
        if !self.alike {
            self.other.alpha.set::<S>(i, alpha);
            self.other.x2.set::<S>(i, x2);
            self.other.ceiling.set::<S>(i, limit);
        }
        self.other.best.set::<S>(i, best);
        self.side.set::<S>(i, side);
        let put = |column: &mut Column<BATCH>, end, start| {
            let now = column.get::<S>(i);
            column.set::<S>(i, m.select(goes, m.select(calm, end, start), now));
        };
        put(&mut self.y, y1, y);
        put(&mut self.w, w1, w);
        put(&mut self.tau, zero, tau);
        put(&mut self.turn, m.splat(GOES_ON), m.splat(TURNS));
    }
}

/// An edge and the base acceleration in units of what remains of a step after its part `tau`.
#[inline(always)]
fn rest_of_step<S: Simd>(
    m: Math<S>,
    ground: &Interval,
    tau: Numbers<S>,
    edge: Edge<S>,
    side: Numbers<S>,
) -> (Edge<S>, Ground<S>) {
    let (u_start, u_change) = (m.splat(ground.u), m.splat(ground.u_change));
    let (v_start, v_change) = (m.splat(ground.v), m.splat(ground.v_change));
    let rest = m.sub(m.splat(1.0), tau);
    (
        Edge {
            x2: m.mul(m.mul(rest, rest), edge.x2),
            ..edge
        },
        Ground {
            su: m.mul(side, m.fma(tau, u_change, u_start)),
            su_change: m.mul(side, m.mul(rest, u_change)),
            v: m.fma(tau, v_change, v_start),
            v_change: m.mul(rest, v_change),
        },
    )
}

/// What is certain about a wall in the rest of the step.
struct WallAhead<S: Simd> {
    /// It does not meet the wall.
    clear: Masks<S>,
    /// It leaves the wall, is pressed back to it and is on the way to it at the end.
    returns: Masks<S>,
    /// It meets the wall, and nothing before.
    strikes: Masks<S>,
}

/// What is certain about the wall beyond a step of y; `above_floor` where y stays above the floor.
#[inline(always)]
fn at_wall<S: Simd, const K: usize>(
    m: Math<S>,
    series: &Series<S, K>,
    shape: &Shape<S>,
    ceiling: Numbers<S>,
    above_floor: Masks<S>,
) -> WallAhead<S> {
    let zero = m.splat(0.0);
    let (y, w) = (series.c[0], series.c[1]);
    let &Shape {
        bend,
        y1,
        w1,
        concave,
        convex,
        opens,
        closes,
    } = shape;
    let (up, ends_up) = (m.gt(w, zero), m.gt(w1, zero));
    let below = m.gt(ceiling, y);
    let (reaches, stays_below) = (m.ge(y1, ceiling), m.gt(ceiling, y1));
    // Up throughout.
    let rises = m.and(below, m.or(m.gt(w, bend), m.and(up, convex)));
    // Up, and down at most once.
    let arches = m.and(
        m.and(below, up),
        m.or(m.or(concave, closes), m.and(opens, m.not(ends_up))),
    );
    let climbs = m.and(m.and(arches, ends_up), m.or(concave, closes));
    // Down, or down and up: highest at one of the ends.
    let sinks = m.and(
        m.not(up),
        m.or(
            m.or(m.gt(m.sub(zero, w), bend), concave),
            m.and(m.or(opens, convex), stays_below),
        ),
    );
    // Down and then up, without a landing.
    let swings = m.and(
        m.and(below, above_floor),
        m.and(m.not(up), m.or(opens, convex)),
    );
    // It leaves the wall and is pressed back to it; the curve is above its first tangent, which
    // is above the floor.
    let pressed = m.and(
        m.and(m.ge(y, ceiling), m.gt(zero, w)),
        m.and(convex, m.gt(m.add(y, w), zero)),
    );
    WallAhead {
        clear: m.or(sinks, m.and(stays_below, m.or(rises, climbs))),
        returns: m.and(pressed, stays_below),
        strikes: m.and(reaches, m.or(m.or(pressed, swings), m.or(rises, arches))),
    }
}

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
    // The first guess: the root of the parabola, closer to that of the first five terms by one step, or
    // the end of the step. From there one step takes nearly every lane to its root.
    let discriminant = m.fnma(m.mul(m.splat(4.0), q[0]), q[2], m.mul(q[1], q[1]));
    let positive = m.gt(discriminant, zero);
    let sum = m.sub(m.sqrt(m.select(positive, discriminant, one)), q[1]);
    let guess = m.div(m.add(q[0], q[0]), sum);
    let good = m.and(positive, m.and(m.gt(guess, zero), m.gt(one, guess)));
    let (mut p, mut slope, mut half_bend) = (q[4], zero, zero);
    unroll_down!(N, {
        if N < 4 {
            half_bend = m.fma(half_bend, guess, slope);
            slope = m.fma(slope, guess, p);
            p = m.fma(p, guess, q[N]);
        }
    });
    let step = m.fnma(p, half_bend, m.mul(slope, slope));
    let closer = m.sub(guess, m.div(m.mul(p, slope), step));
    let close = m.and(good, m.and(m.gt(closer, zero), m.gt(one, closer)));
    let mut x = m.select(close, closer, m.select(good, guess, one));
    let mut open = wanted;
    for _ in 0..MOST {
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
        if !m.any(open) {
            break;
        }
    }
    x
}
