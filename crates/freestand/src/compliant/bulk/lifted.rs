//! An edge off its pad, or both: the equation of motion with exact sines, in every lane.
//!
//! Lanes have their own time: each takes steps of its own length, to the end of its sample or just
//! past the event of a contact. What happens there is done lane by lane (`world`).

use pulp::{Arch, Simd, WithSimd};

use super::Lane;
use super::body::Body;
use super::each::{each, six, two};
use crate::vector::{Masks, Math, Numbers};

/// What a lane asks for after a step; they are added.
pub(super) const CONTACT_CHANGES: [u32; 2] = [1, 2];
pub(super) const PULSE_ENDS: [u32; 2] = [4, 8];
pub(super) const SAMPLE_ENDS: u32 = 16;
pub(super) const FALLEN: u32 = 32;

/// A pad that carries less of its load at rest is not calm.
const CALM_SHARE: f64 = 0.9;

/// Worlds side by side. Displacements are those of the centre of gravity, from its place above
/// unloaded pads.
#[derive(Debug, Default)]
pub(super) struct Lifted {
    /// x, z, θ and their rates.
    pub(super) y: [Lane; 6],
    /// sin θ and cos θ: the end of a step is the start of the next one.
    turn: [Lane; 2],
    /// Where the foot of an edge took hold.
    pub(super) anchor: [Lane; 2],
    /// 1 where an edge is on its pad.
    pub(super) on: [Lane; 2],
    /// How far a pad that was left is still compressed.
    pub(super) surface: [Lane; 2],
    spring: Lane,
    dashpot: Lane,
    recovery: Lane,
    turning: Lane,
    gravity: Lane,
    height: Lane,
    edges: [Lane; 2],
    calm_load: [Lane; 2],
    longest: Lane,
    event: Lane,
    fallen: Lane,
    /// Acceleration of the base and its rate, horizontally and vertically.
    pub(super) base: [Lane; 2],
    pub(super) slope: [Lane; 2],
    /// Time to the end of the sample, and from its start.
    pub(super) rest: Lane,
    pub(super) gone: Lane,
    /// The step to take next, and the last two that were taken.
    pub(super) step: Lane,
    pub(super) taken: Lane,
    pub(super) taken_before: Lane,
    /// For so long both edges have carried.
    pub(super) calm: Lane,
    /// Upward acceleration of each edge, and how fast it presses, at the starts of this step and the last one.
    pub(super) up: [Lane; 2],
    pub(super) up_before: [Lane; 2],
    pub(super) pressing: [Lane; 2],
    pub(super) pressing_before: [Lane; 2],
    /// At the end of the step: compression, its rate, and the place of each edge.
    pub(super) press_end: [Lane; 2],
    pub(super) pressing_end: [Lane; 2],
    pub(super) place_end: [Lane; 2],
    /// 1 while the pulse of a touch lasts, and its largest acceleration.
    pub(super) pulse: [Lane; 2],
    pub(super) pulse_peak: [Lane; 2],
    pub(super) peak: [Lane; 2],
    pub(super) lift: Lane,
    pub(super) most_pressed: Lane,
    pub(super) flags: Lane,
}

impl Lifted {
    /// Puts a body into a lane; the caller sets the rest.
    pub(super) fn enter(&mut self, lane: usize, body: &Body) {
        self.spring[lane] = body.spring;
        self.dashpot[lane] = body.dashpot;
        self.recovery[lane] = body.recovery;
        self.turning[lane] = body.turning;
        self.gravity[lane] = body.gravity;
        self.height[lane] = body.height;
        self.longest[lane] = body.step_s;
        self.event[lane] = body.event_s;
        self.fallen[lane] = body.fallen_rad;
        for edge in 0..2 {
            self.edges[edge][lane] = body.edges[edge];
            self.calm_load[edge][lane] = CALM_SHARE * body.rest.loads[edge];
            self.surface[edge][lane] = 0.0;
            self.up[edge][lane] = 0.0;
            self.pulse[edge][lane] = 0.0;
            self.pulse_peak[edge][lane] = 0.0;
            self.peak[edge][lane] = 0.0;
            self.on[edge][lane] = 1.0;
        }
        self.calm[lane] = 0.0;
        self.lift[lane] = 0.0;
        self.most_pressed[lane] = 0.0;
    }

    /// Takes a world out of a lane: no step, no flags.
    pub(super) fn leave(&mut self, lane: usize) {
        let base = self.base.iter_mut().chain(&mut self.slope);
        for column in base.chain(&mut self.on) {
            column[lane] = 0.0;
        }
        for column in [
            &mut self.spring,
            &mut self.dashpot,
            &mut self.gravity,
            &mut self.step,
            &mut self.longest,
        ] {
            column[lane] = 0.0;
        }
        for column in self.surface.iter_mut().chain(&mut self.edges) {
            column[lane] = 0.0;
        }
        self.height[lane] = 0.0;
        (self.rest[lane], self.fallen[lane]) = (1.0, 1.0);
        self.place(lane, [0.0; 6]);
    }

    /// Puts the block of a lane somewhere.
    pub(super) fn place(&mut self, lane: usize, y: [f64; 6]) {
        for (column, value) in self.y.iter_mut().zip(y) {
            column[lane] = value;
        }
        let m = Math(pulp::Scalar::new());
        let (sin, cos) = m.sin_cos(m.splat(y[2]));
        (self.turn[0][lane], self.turn[1][lane]) = (sin[0], cos[0]);
    }

    /// The next step of a lane.
    pub(super) fn plan(&mut self, lane: usize) {
        let (rest, longest) = (self.rest[lane], self.longest[lane]);
        self.step[lane] = if rest <= longest {
            rest
        } else if rest < 2.0 * longest {
            0.5 * rest
        } else {
            longest
        };
    }
}

/// One step of every lane that has no event in it; one with an event takes a shorter one next time.
pub(super) fn advance(arch: Arch, lifted: &mut Lifted) {
    arch.dispatch(Advance { lifted });
}

struct Advance<'a> {
    lifted: &'a mut Lifted,
}

impl WithSimd for Advance<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let m = Math(simd);
        for i in 0..Lane::pairs::<S>() {
            self.lifted.advance(m, i);
        }
    }
}

/// The numbers of a body.
#[derive(Clone, Copy)]
struct Parts<S: Simd> {
    spring: Numbers<S>,
    dashpot: Numbers<S>,
    turning: Numbers<S>,
    gravity: Numbers<S>,
    height: Numbers<S>,
    edges: [Numbers<S>; 2],
    anchor: [Numbers<S>; 2],
    on: [Numbers<S>; 2],
}

/// Where the edges are, and what their pads would push with.
#[derive(Clone, Copy)]
struct Feet<S: Simd> {
    arm_x: [Numbers<S>; 2],
    arm_z: [Numbers<S>; 2],
    press: [Numbers<S>; 2],
    pressing: [Numbers<S>; 2],
    load: [Numbers<S>; 2],
}

#[inline(always)]
fn feet<S: Simd>(m: Math<S>, p: &Parts<S>, y: &[Numbers<S>; 6]) -> Feet<S> {
    let (sin, cos) = m.sin_cos(y[2]);
    feet_at(m, p, y, [sin, cos])
}

/// The same, with sin θ and cos θ.
#[inline(always)]
fn feet_at<S: Simd>(
    m: Math<S>,
    p: &Parts<S>,
    y: &[Numbers<S>; 6],
    [sin, cos]: [Numbers<S>; 2],
) -> Feet<S> {
    let (lean, upright) = (m.mul(p.height, sin), m.mul(p.height, cos));
    // z + c(1 − cos θ).
    let risen = m.add(y[1], m.sub(p.height, upright));
    let zero = m.splat(0.0);
    let arm_x = two!(edge, m.fma(p.edges[edge], cos, m.sub(zero, lean)));
    let fall = two!(edge, m.mul(p.edges[edge], sin));
    let arm_z = two!(edge, m.sub(m.sub(zero, fall[edge]), upright));
    let press = two!(edge, m.sub(fall[edge], risen));
    let pressing = two!(edge, m.fma(y[5], arm_x[edge], m.sub(zero, y[4])));
    let load = two!(
        edge,
        m.fma(p.spring, press[edge], m.mul(p.dashpot, pressing[edge]))
    );
    Feet {
        arm_x,
        arm_z,
        press,
        pressing,
        load,
    }
}

/// ẍ, z̈ and θ̈, relative to the base, which moves with `base`.
#[inline(always)]
fn accelerations<S: Simd>(
    m: Math<S>,
    p: &Parts<S>,
    x: Numbers<S>,
    feet: &Feet<S>,
    base: [Numbers<S>; 2],
) -> [Numbers<S>; 3] {
    let zero = m.splat(0.0);
    let load = two!(edge, m.mul(p.on[edge], feet.load[edge]));
    // Backwards.
    let stretch = two!(edge, m.sub(m.add(x, feet.arm_x[edge]), p.anchor[edge]));
    let drag = two!(edge, m.mul(m.mul(p.spring, stretch[edge]), p.on[edge]));
    let turn = two!(
        edge,
        m.fma(
            feet.arm_z[edge],
            drag[edge],
            m.mul(feet.arm_x[edge], load[edge])
        )
    );
    [
        m.sub(zero, m.add(m.add(drag[0], drag[1]), base[0])),
        m.sub(m.sub(m.add(load[0], load[1]), p.gravity), base[1]),
        m.sub(zero, m.mul(p.turning, m.add(turn[0], turn[1]))),
    ]
}

/// Upward acceleration of the edges in the inertial frame.
#[inline(always)]
fn edges_up<S: Simd>(
    m: Math<S>,
    feet: &Feet<S>,
    omega: Numbers<S>,
    bent: &[Numbers<S>; 3],
    base_up: Numbers<S>,
) -> [Numbers<S>; 2] {
    let (square, lift) = (m.mul(omega, omega), m.add(bent[1], base_up));
    two!(
        edge,
        m.fnma(
            square,
            feet.arm_z[edge],
            m.fnma(bent[2], feet.arm_x[edge], lift)
        )
    )
}

#[inline(always)]
fn pair<S: Simd>(columns: &[Lane; 2], i: usize) -> [Numbers<S>; 2] {
    [columns[0].get::<S>(i), columns[1].get::<S>(i)]
}

/// y + h ẏ.
#[inline(always)]
fn stage<S: Simd>(
    m: Math<S>,
    y: &[Numbers<S>; 6],
    h: Numbers<S>,
    rates: [Numbers<S>; 3],
    bent: [Numbers<S>; 3],
) -> [Numbers<S>; 6] {
    let rates = [rates[0], rates[1], rates[2], bent[0], bent[1], bent[2]];
    six!(k, m.fma(h, rates[k], y[k]))
}

/// a + 2b + 2c + d.
#[inline(always)]
fn mean<S: Simd>(
    m: Math<S>,
    a: Numbers<S>,
    b: Numbers<S>,
    c: Numbers<S>,
    d: Numbers<S>,
) -> Numbers<S> {
    let inner = m.add(b, c);
    m.add(m.add(a, d), m.add(inner, inner))
}

#[inline(always)]
fn flag<S: Simd>(m: Math<S>, flags: Numbers<S>, mask: Masks<S>, value: u32) -> Numbers<S> {
    m.select(mask, m.add(flags, m.splat(f64::from(value))), flags)
}

impl Lifted {
    #[inline(always)]
    fn advance<S: Simd>(&mut self, m: Math<S>, i: usize) {
        let (zero, half, one) = (m.splat(0.0), m.splat(0.5), m.splat(1.0));
        let p = Parts {
            spring: self.spring.get::<S>(i),
            dashpot: self.dashpot.get::<S>(i),
            turning: self.turning.get::<S>(i),
            gravity: self.gravity.get::<S>(i),
            height: self.height.get::<S>(i),
            edges: pair::<S>(&self.edges, i),
            anchor: pair::<S>(&self.anchor, i),
            on: pair::<S>(&self.on, i),
        };
        let (base, slope) = (pair::<S>(&self.base, i), pair::<S>(&self.slope, i));
        let (h, rest, longest) = (
            self.step.get::<S>(i),
            self.rest.get::<S>(i),
            self.longest.get::<S>(i),
        );
        let y = six!(k, self.y[k].get::<S>(i));
        let on = two!(edge, m.gt(p.on[edge], zero));

        // Runge and Kutta's four stages.
        let turn = pair::<S>(&self.turn, i);
        let start = feet_at(m, &p, &y, turn);
        let bent = accelerations(m, &p, y[0], &start, base);
        let up = edges_up(m, &start, y[5], &bent, base[1]);
        let half_h = m.mul(half, h);
        let base_half = two!(way, m.fma(half_h, slope[way], base[way]));
        let base_end = two!(way, m.fma(h, slope[way], base[way]));
        let y2 = stage(m, &y, half_h, [y[3], y[4], y[5]], bent);
        let bent2 = accelerations(m, &p, y2[0], &feet(m, &p, &y2), base_half);
        let y3 = stage(m, &y, half_h, [y2[3], y2[4], y2[5]], bent2);
        let middle = feet(m, &p, &y3);
        let bent3 = accelerations(m, &p, y3[0], &middle, base_half);
        let up_half = edges_up(m, &middle, y3[5], &bent3, base_half[1]);
        let y4 = stage(m, &y, h, [y3[3], y3[4], y3[5]], bent3);
        let bent4 = accelerations(m, &p, y4[0], &feet(m, &p, &y4), base_end);
        let sixth = m.mul(h, m.splat(1.0 / 6.0));
        let rates = [
            mean(m, y[3], y2[3], y3[3], y4[3]),
            mean(m, y[4], y2[4], y3[4], y4[4]),
            mean(m, y[5], y2[5], y3[5], y4[5]),
            mean(m, bent[0], bent2[0], bent3[0], bent4[0]),
            mean(m, bent[1], bent2[1], bent3[1], bent4[1]),
            mean(m, bent[2], bent2[2], bent3[2], bent4[2]),
        ];
        let end = six!(k, m.fma(sixth, rates[k], y[k]));
        let (sin, cos) = m.sin_cos(end[2]);
        let turn_end = [sin, cos];
        let last = feet_at(m, &p, &end, turn_end);

        // e^(−k h/c) as (e^(x/8))⁻⁸ by five terms.
        let x = m.mul(m.mul(h, self.recovery.get::<S>(i)), m.splat(0.125));
        let series = m.fma(x, m.splat(1.0 / 24.0), m.splat(1.0 / 6.0));
        let series = m.fma(m.fma(m.fma(series, x, half), x, one), x, one);
        let eighth = m.div(one, series);
        let decay = m.mul(eighth, eighth);
        let decay = m.mul(decay, decay);
        let decay = m.mul(decay, decay);

        // How far a contact is from its change, before and after, and when it passed it.
        let surface = pair::<S>(&self.surface, i);
        let sunk = two!(edge, m.mul(surface[edge], decay));
        let event = self.event.get::<S>(i);
        let (mut event_h, mut crossing) = (h, m.gt(zero, zero));
        let mut crossed = [crossing; 2];
        for edge in 0..2 {
            let before = m.mul(p.spring, m.sub(surface[edge], start.press[edge]));
            let before = m.select(on[edge], start.load[edge], before);
            let after = m.mul(p.spring, m.sub(sunk[edge], last.press[edge]));
            let after = m.select(on[edge], last.load[edge], after);
            let before = m.larger(before, zero);
            crossed[edge] = m.gt(zero, after);
            crossing = m.or(crossing, crossed[edge]);
            if m.any(crossed[edge]) {
                let at = m.mul(h, m.div(before, m.sub(before, after)));
                event_h = m.select(crossed[edge], m.smaller(at, event_h), event_h);
            }
        }
        let near = m.or(m.ge(event, m.sub(h, event_h)), m.ge(event, h));
        let accepted = m.or(m.not(crossing), near);
        let shorter = m.fma(half, event, event_h);

        // The state, or the step that was too long.
        for k in 0..6 {
            self.y[k].set::<S>(i, m.select(accepted, end[k], y[k]));
        }
        for way in 0..2 {
            self.base[way].set::<S>(i, m.select(accepted, base_end[way], base[way]));
            self.turn[way].set::<S>(i, m.select(accepted, turn_end[way], turn[way]));
        }
        let left = m.select(accepted, m.sub(rest, h), rest);
        self.rest.set::<S>(i, left);
        let gone = self.gone.get::<S>(i);
        let gone_end = m.add(gone, h);
        self.gone.set::<S>(i, m.select(accepted, gone_end, gone));
        let twice = m.add(longest, longest);
        let next = m.select(m.gt(twice, left), m.mul(half, left), longest);
        let next = m.select(m.ge(longest, left), left, next);
        self.step.set::<S>(i, m.select(accepted, next, shorter));
        let (old, older) = (self.taken.get::<S>(i), self.taken_before.get::<S>(i));
        self.taken_before
            .set::<S>(i, m.select(accepted, old, older));
        self.taken.set::<S>(i, m.select(accepted, h, old));

        // What is kept of the step.
        let mut flags = zero;
        let (mut lift, mut pressed) = (self.lift.get::<S>(i), self.most_pressed.get::<S>(i));
        let mut calm = m.gt(one, zero);
        for edge in 0..2 {
            flags = flag(
                m,
                flags,
                m.and(accepted, crossed[edge]),
                CONTACT_CHANGES[edge],
            );
            // The highest or lowest point of an edge inside the step, as under a steady acceleration.
            let (slow, fast) = (start.pressing[edge], last.pressing[edge]);
            let turns = m.and(accepted, m.gt(zero, m.mul(slow, fast)));
            let mut inside = start.press[edge];
            if m.any(turns) {
                let reach = m.div(m.mul(m.mul(half_h, slow), slow), m.sub(slow, fast));
                inside = m.add(inside, m.select(turns, reach, zero));
            }
            let outside = m.select(accepted, last.press[edge], start.press[edge]);
            lift = m.larger(m.sub(zero, m.smaller(inside, outside)), lift);
            let deepest = m.larger(inside, outside);
            pressed = m.select(on[edge], m.larger(deepest, pressed), pressed);

            let (up_before, pressing_before) =
                (self.up[edge].get::<S>(i), self.pressing[edge].get::<S>(i));
            let pulse = m.gt(self.pulse[edge].get::<S>(i), zero);
            let highest = m.larger(up[edge], up_half[edge]);
            let peak = self.peak[edge].get::<S>(i);
            let counts = m.and(accepted, on[edge]);
            self.peak[edge].set::<S>(i, m.select(counts, m.larger(highest, peak), peak));
            let peak = self.pulse_peak[edge].get::<S>(i);
            self.pulse_peak[edge].set::<S>(
                i,
                m.select(m.and(counts, pulse), m.larger(highest, peak), peak),
            );
            let ends = m.and(m.gt(up_before, zero), m.ge(zero, up[edge]));
            flags = flag(
                m,
                flags,
                m.and(m.and(accepted, pulse), ends),
                PULSE_ENDS[edge],
            );
            let old = self.up_before[edge].get::<S>(i);
            self.up_before[edge].set::<S>(i, m.select(accepted, up_before, old));
            self.up[edge].set::<S>(i, m.select(accepted, up[edge], up_before));
            let old = self.pressing_before[edge].get::<S>(i);
            self.pressing_before[edge].set::<S>(i, m.select(accepted, pressing_before, old));
            self.pressing[edge]
                .set::<S>(i, m.select(accepted, start.pressing[edge], pressing_before));

            self.press_end[edge].set::<S>(i, last.press[edge]);
            self.pressing_end[edge].set::<S>(i, last.pressing[edge]);
            self.place_end[edge].set::<S>(i, m.add(end[0], last.arm_x[edge]));
            self.surface[edge].set::<S>(i, m.select(accepted, sunk[edge], surface[edge]));
            let carries = m.gt(last.load[edge], self.calm_load[edge].get::<S>(i));
            calm = m.and(calm, m.and(on[edge], carries));
        }
        self.lift.set::<S>(i, lift);
        self.most_pressed.set::<S>(i, pressed);
        let was = self.calm.get::<S>(i);
        self.calm.set::<S>(
            i,
            m.select(accepted, m.select(calm, m.add(was, h), zero), was),
        );
        flags = flag(m, flags, m.and(accepted, m.ge(zero, left)), SAMPLE_ENDS);
        let upright = m.ge(self.fallen.get::<S>(i), m.abs(end[2]));
        flags = flag(m, flags, m.and(accepted, m.not(upright)), FALLEN);
        self.flags.set::<S>(i, flags);
    }
}
