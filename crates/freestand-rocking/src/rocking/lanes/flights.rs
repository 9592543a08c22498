//! Short flights between impacts, of several lanes at a time: each by a short series of its own, and
//! the last ones before rest by one formula (`chatter`).

use pulp::{Arch, Simd, WithSimd};

use super::chatter::{Pull, SMALL_EPSILON, Trace, count};
use super::ranks::ABREAST;
use super::shaking::Interval;
use crate::vector::{Column, Masks, Math, Numbers};

/// Largest y of a short flight: the omitted part of E cos y, the change of E times y²/2, is below
/// 1e-13 of E.
const LOW: f64 = 1e-6;

/// Largest D times the square of the duration of a short flight: the seventh term of the series,
/// (D T²)³/5040, is below 1e-16.
const SHORT: f64 = 5e-5;

/// Under the least pull alone a flight lasts 2w/E; one is certain to land within this many w/E.
const LONGEST: f64 = 2.2;

/// Where a flight that starts at the velocity `w` is certain to land within the time that is left, which
/// is the unit of time, and is low enough for a short series.
#[inline(always)]
pub(super) fn is_brief<S: Simd>(m: Math<S>, w: Numbers<S>, least: Numbers<S>) -> Masks<S> {
    m.and(
        m.gt(least, m.mul(m.splat(LONGEST), m.abs(w))),
        m.ge(m.mul(m.splat(2.0 / LONGEST * LOW), least), m.mul(w, w)),
    )
}

/// What acts on a block in flights from a surface back to it: ÿ = −(E cos y − D sin y),
/// E = a(1+ü_v/g) + s b ü_h/g, D = b(1+ü_v/g) − s a ü_h/g, in units of the step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Acting {
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) side: f64,
    /// Restitution of the landing.
    pub(super) restitution: f64,
    /// Flights stay lower than its height.
    pub(super) trace: Trace,
}

/// A lane that flies: the edge about which it starts, with the speed `w` at the part `tau` of the step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flyer {
    pub(super) lane: u32,
    pub(super) edge: usize,
    pub(super) from_wall: bool,
    pub(super) w: f64,
    pub(super) tau: f64,
}

/// Lanes with short flights in the step.
#[derive(Default)]
pub(super) struct Flights {
    flyers: Vec<Flyer>,
    w: Column<ABREAST>,
    tau: Column<ABREAST>,
    /// 1 − r; −1 where the last impacts are not to be counted by the formula.
    slowing: Column<ABREAST>,
    /// About the first edge, and about the one that takes turns with it.
    about: [Columns; 2],
    impacts: Column<ABREAST>,
    /// 1 where the block comes to rest within the step.
    rests: Column<ABREAST>,
}

#[derive(Default)]
struct Columns {
    a: Column<ABREAST>,
    b: Column<ABREAST>,
    side: Column<ABREAST>,
    restitution: Column<ABREAST>,
    height: Column<ABREAST>,
    speed: Column<ABREAST>,
}

/// Where the short flights of a lane led to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flown {
    pub(super) flyer: Flyer,
    pub(super) impacts: usize,
    /// The speed after the last impact, and the part of the step that has then passed; 0 and 1 if the
    /// block comes to rest in the step.
    pub(super) w: f64,
    pub(super) tau: f64,
    /// Largest speeds of impacts so far, about the first edge and about the other one.
    pub(super) speeds: [f64; 2],
}

impl Flights {
    pub(super) fn is_empty(&self) -> bool {
        self.flyers.is_empty()
    }

    pub(super) fn is_full(&self) -> bool {
        self.flyers.len() == ABREAST
    }

    /// Adds a lane; with `counted`, its last impacts may be counted by the formula.
    #[inline(always)]
    pub(super) fn push(&mut self, flyer: Flyer, about: [Acting; 2], counted: bool) {
        let i = self.flyers.len();
        self.flyers.push(flyer);
        (self.w[i], self.tau[i]) = (flyer.w, flyer.tau);
        self.slowing[i] = if counted {
            1.0 - about[0].restitution
        } else {
            -1.0
        };
        for (columns, acting) in self.about.iter_mut().zip(about) {
            (columns.a[i], columns.b[i]) = (acting.a, acting.b);
            columns.side[i] = acting.side;
            columns.restitution[i] = acting.restitution;
            columns.height[i] = acting.trace.height;
            columns.speed[i] = acting.trace.speed;
        }
    }

    /// Takes every lane through its short flights.
    pub(super) fn fly(&mut self, arch: Arch, ground: &Interval, rest_w: f64) {
        self.w[self.flyers.len()..].fill(0.0);
        narrow(arch).dispatch(Fly {
            flights: self,
            ground,
            rest_w,
        });
    }

    /// Where the last of the lanes has come to, which leaves.
    #[inline(always)]
    pub(super) fn pop(&mut self, ground: &Interval, rest_w: f64) -> Option<Flown> {
        let flyer = self.flyers.pop()?;
        let i = self.flyers.len();
        let mut impacts = self.impacts[i] as usize;
        let speeds = [0, 1].map(|edge| self.about[edge].speed[i]);
        let (mut w, mut tau) = (self.w[i], self.tau[i]);
        if self.rests[i] > 0.0 {
            let (u, v) = ground.at(tau);
            let pull = |edge: usize| {
                let of = &self.about[edge];
                let (a, sb) = (of.a[i], of.side[i] * of.b[i]);
                Pull {
                    now: a * v + sb * u,
                    slope: a * ground.v_change + sb * ground.u_change,
                }
            };
            let next = impacts % 2;
            let r = self.about[0].restitution[i];
            impacts += count([pull(next), pull(1 - next)], r, w, rest_w);
            (w, tau) = (0.0, 1.0);
        }
        Some(Flown {
            flyer,
            impacts,
            w,
            tau,
            speeds,
        })
    }
}

/// Vectors half as wide, where there are wider ones: seldom more than eight lanes fly at a time, and one
/// vector that is half empty takes as long as two.
fn narrow(arch: Arch) -> Arch {
    match arch {
        #[cfg(target_arch = "x86_64")]
        Arch::V4(wide) => Arch::V3(*wide),
        other => other,
    }
}

struct Fly<'a> {
    flights: &'a mut Flights,
    ground: &'a Interval,
    rest_w: f64,
}

impl WithSimd for Fly<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let lanes = self.flights.flyers.len();
        for i in 0..lanes.div_ceil(2 * S::F64_LANES) {
            self.flights
                .chain::<S>(Math(simd), self.ground, self.rest_w, i);
        }
    }
}

/// What pulls a block back over the rest of a step, about one edge.
#[derive(Clone, Copy)]
struct Pulling<S: Simd> {
    /// E and D at the start, and their changes over a step.
    e: Numbers<S>,
    e_change: Numbers<S>,
    d: Numbers<S>,
    d_change: Numbers<S>,
    /// E at the end of the step.
    e_end: Numbers<S>,
    /// An upper bound of the magnitude of D, times [`WEAK`].
    d_most: Numbers<S>,
    /// No flight is higher than this.
    height: Numbers<S>,
    /// Largest square of the speed of a flight that is low enough, under an E of 1.
    lowest: Numbers<S>,
    restitution: Numbers<S>,
}

/// A flight from the floor back to it: its duration and the speed of the impact that ends it.
struct Flight<S: Simd> {
    time: Numbers<S>,
    speed: Numbers<S>,
}

impl Columns {
    #[inline(always)]
    fn pulling<S: Simd>(
        &self,
        m: Math<S>,
        ground: &Interval,
        tau: Numbers<S>,
        i: usize,
    ) -> Pulling<S> {
        let (u_change, v_change) = (m.splat(ground.u_change), m.splat(ground.v_change));
        let u = m.fma(tau, u_change, m.splat(ground.u));
        let v = m.fma(tau, v_change, m.splat(ground.v));
        let (a, b, side) = (
            self.a.get::<S>(i),
            self.b.get::<S>(i),
            self.side.get::<S>(i),
        );
        let (sa, sb) = (m.mul(side, a), m.mul(side, b));
        let rest = m.sub(m.splat(1.0), tau);
        let height = self.height.get::<S>(i);
        let e = m.fma(a, v, m.mul(sb, u));
        let e_change = m.fma(a, v_change, m.mul(sb, u_change));
        let d = m.fnma(sa, u, m.mul(b, v));
        let d_change = m.fnma(sa, u_change, m.mul(b, v_change));
        Pulling {
            e,
            e_change,
            d,
            d_change,
            e_end: m.fma(rest, e_change, e),
            d_most: m.mul(m.splat(WEAK), m.fma(rest, m.abs(d_change), m.abs(d))),
            height,
            // y never passes w²/2E under the least pull: half of this.
            lowest: m.mul(m.splat(2.0 / LONGEST), m.smaller(m.splat(LOW), height)),
            restitution: self.restitution.get::<S>(i),
        }
    }
}

impl<S: Simd> Pulling<S> {
    /// E after a part of the step.
    #[inline(always)]
    fn e_after(&self, m: Math<S>, time: Numbers<S>) -> Numbers<S> {
        m.fma(time, self.e_change, self.e)
    }

    /// Where a flight that starts at the speed `w` is low enough, short, and certain to land within the
    /// time `left`.
    #[inline(always)]
    fn is_short(&self, m: Math<S>, w: Numbers<S>, least: Numbers<S>, left: Numbers<S>) -> Masks<S> {
        let square = m.mul(w, w);
        let brief = m.ge(m.mul(left, least), m.mul(m.splat(LONGEST), w));
        let low = m.ge(m.mul(self.lowest, least), square);
        let weak = m.ge(m.mul(least, least), m.mul(self.d_most, square));
        m.and(brief, m.and(low, weak))
    }

    /// ⅔ε, ε = E′w/E², for a flight that starts at the speed `w`.
    #[inline(always)]
    fn unevenness(&self, m: Math<S>, w: Numbers<S>, inverse: Numbers<S>) -> Numbers<S> {
        let change = m.mul(m.splat(2.0 / 3.0), self.e_change);
        m.mul(w, m.mul(change, m.mul(inverse, inverse)))
    }

    /// Nearly the duration of the flight that starts at the speed `w`: the landing under E alone, and the
    /// effect of D for a constant pull; a is ⅔ε.
    ///
    /// Under E alone it lasts (2w/E)τ with aτ² + τ = 1; the first omitted term of the series for τ is
    /// 42a⁵ < 2e-8.
    #[inline(always)]
    fn guess(
        m: Math<S>,
        w: Numbers<S>,
        d: Numbers<S>,
        inverse: Numbers<S>,
        a: Numbers<S>,
    ) -> Numbers<S> {
        let ballistic = m.mul(w, m.add(inverse, inverse));
        let of_d = m.mul(m.mul(d, m.splat(1.0 / 12.0)), m.mul(ballistic, ballistic));
        let even = m.add(m.splat(1.0), of_d);
        let square = m.mul(a, a);
        let high = m.fma(m.splat(14.0), square, m.fma(m.splat(-5.0), a, m.splat(2.0)));
        m.mul(ballistic, m.fma(square, high, m.sub(even, a)))
    }

    /// The flight that starts at the speed `w` by one step of Newton's method from its duration `x`,
    /// nearly.
    #[inline(always)]
    fn flight(
        &self,
        m: Math<S>,
        w: Numbers<S>,
        [e, d]: [Numbers<S>; 2],
        x: Numbers<S>,
    ) -> Flight<S> {
        let (e1, d1) = (self.e_change, self.d_change);
        // y/x.
        let (c0, c1) = (w, m.mul(m.splat(-0.5), e));
        let c2 = m.mul(m.sub(m.mul(d, w), e1), m.splat(1.0 / 6.0));
        let ew = m.mul(m.mul(m.splat(0.5), e), w);
        let c3 = m.mul(
            m.fma(ew, w, m.fma(d, c1, m.mul(d1, w))),
            m.splat(1.0 / 12.0),
        );
        let c4 = m.mul(
            m.fnma(ew, e, m.fma(d1, c1, m.mul(d, c2))),
            m.splat(1.0 / 20.0),
        );
        let cube = m.mul(m.mul(m.splat(0.125), e), m.mul(e, e));
        let c5 = m.mul(m.fma(d, c3, m.fma(d1, c2, cube)), m.splat(1.0 / 30.0));
        // By pairs of terms: a shorter chain than term by term.
        let square = m.mul(x, x);
        let high = m.fma(square, m.fma(x, c5, c4), m.fma(x, c3, c2));
        let value = m.fma(square, high, m.fma(x, c1, c0));
        let (s1, s2) = (m.add(c2, c2), m.mul(m.splat(3.0), c3));
        let (s3, s4) = (m.mul(m.splat(4.0), c4), m.mul(m.splat(5.0), c5));
        let high = m.fma(square, s4, m.fma(x, s3, s2));
        let slope = m.fma(square, high, m.fma(x, s1, c1));
        let step = m.div(value, slope);
        let time = m.sub(x, step);
        // At the landing y/x is zero, and dy/dx is x times the slope of y/x, which the step of
        // Newton's method has changed.
        let falling = m.fma(
            step,
            m.fma(m.add(s2, s2), x, s1),
            m.sub(m.splat(0.0), slope),
        );
        Flight {
            time,
            speed: m.mul(time, falling),
        }
    }

    /// Where all flights to rest, from the speed `w`, are certain to occur within the time `left` and to
    /// exceed no extreme; `slowing` is 1 − r.
    #[inline(always)]
    fn is_last(
        &self,
        m: Math<S>,
        w: Numbers<S>,
        least: Numbers<S>,
        [slowing, left]: [Numbers<S>; 2],
        fastest: Numbers<S>,
    ) -> Masks<S> {
        /// Largest relative change of the pull on the way to rest; it lets speeds grow by at most
        /// [`GROWTH`].
        const CHANGE: f64 = 0.3;
        /// Largest contribution of y to the pull, as a ratio.
        const PART: f64 = 1e-5;
        let grown = m.mul(m.splat(GROWTH), w);
        let square = m.mul(m.splat(0.5), m.mul(grown, grown));
        let least2 = m.mul(least, least);
        let soon = m.ge(m.mul(m.mul(least, slowing), left), m.add(grown, grown));
        let change = m.ge(
            m.mul(m.mul(m.splat(CHANGE), slowing), least2),
            m.mul(m.abs(self.e_change), w),
        );
        let part = m.ge(
            m.mul(m.splat(PART * WEAK), least2),
            m.mul(self.d_most, square),
        );
        let low = m.gt(m.mul(least, self.height), square);
        m.and(
            m.and(soon, change),
            m.and(m.and(part, low), m.gt(fastest, grown)),
        )
    }
}

/// On the way to rest speeds grow by at most this factor.
const GROWTH: f64 = 1.3;

/// D times this times w² is at most E², under the least pull, for a flight that is short in the sense of
/// [`SHORT`].
const WEAK: f64 = LONGEST * LONGEST / SHORT;

impl Flights {
    /// Takes a vector of lanes through their short flights, which set no new largest rotation.
    #[inline(always)]
    fn chain<S: Simd>(&mut self, m: Math<S>, ground: &Interval, rest_w: f64, i: usize) {
        let (zero, one) = (m.splat(0.0), m.splat(1.0));
        let (begin, slowing) = (self.tau.get::<S>(i), self.slowing.get::<S>(i));
        let rest = m.sub(one, begin);
        let [first, second] = &self.about;
        let pulling = [
            first.pulling::<S>(m, ground, begin, i),
            second.pulling::<S>(m, ground, begin, i),
        ];
        let mut speeds = [first.speed.get::<S>(i), second.speed.get::<S>(i)];
        let (mut w, mut time, mut impacts, mut rests) = (self.w.get::<S>(i), zero, zero, zero);
        let mut open = m.gt(w, m.splat(rest_w));
        let mut inverse = m.div(one, pulling[0].e);
        let mut edge = 0;
        loop {
            let (here, there) = (&pulling[edge], &pulling[1 - edge]);
            let left = m.sub(rest, time);
            let e = here.e_after(m, time);
            let least = m.smaller(e, here.e_end);
            let a = here.unevenness(m, w, inverse);
            // Most often it is the time that does not suffice.
            let soon = m.ge(
                m.mul(m.mul(least, slowing), left),
                m.mul(m.splat(2.0 * GROWTH), w),
            );
            let soon = m.and(open, soon);
            if m.any(soon) {
                let other = m.smaller(there.e_after(m, time), there.e_end);
                let within = [slowing, left];
                let last = m.and(
                    here.is_last(m, w, least, within, speeds[edge]),
                    there.is_last(m, w, other, within, speeds[1 - edge]),
                );
                let last = m.and(soon, last);
                rests = m.select(last, one, rests);
                open = m.and(open, m.not(last));
            }
            let even = m.gt(m.splat(2.0 / 3.0 * SMALL_EPSILON), m.abs(a));
            open = m.and(open, m.and(even, here.is_short(m, w, least, left)));
            if !m.any(open) {
                break;
            }
            let d = m.fma(time, here.d_change, here.d);
            let guess = Pulling::guess(m, w, d, inverse, a);
            // For the guess at the next flight. From the exact time, it would wait for one more division.
            inverse = m.div(one, there.e_after(m, m.add(time, guess)));
            let flight = here.flight(m, w, [e, d], guess);
            speeds[edge] = m.most(m.select(open, flight.speed, zero), speeds[edge]);
            w = m.select(open, m.mul(flight.speed, here.restitution), w);
            time = m.select(open, m.add(time, flight.time), time);
            impacts = m.select(open, m.add(impacts, one), impacts);
            open = m.and(open, m.gt(w, m.splat(rest_w)));
            edge = 1 - edge;
        }
        self.w.set::<S>(i, w);
        self.tau.set::<S>(i, m.add(begin, time));
        self.impacts.set::<S>(i, impacts);
        self.rests.set::<S>(i, rests);
        for (columns, speed) in self.about.iter_mut().zip(speeds) {
            columns.speed.set::<S>(i, speed);
        }
    }
}
