//! Both edges on their pads: the exact recursion in every lane, and what it says of letting go.

use pulp::{Arch, Simd, WithSimd};

use super::LANES;
use super::body::Body;
use super::each::{each, six, two};
use super::linear::{Recursion, STATES, righting};
use crate::vector::{Column, Math, Numbers};

/// Up to here the linear equations are followed: beyond this part of its load lost by an edge, squares of the rotation
/// count for a world in which one lets go later.
pub(super) const FIRM_RATIO: f64 = 0.15;

pub(super) type Lane = Column<LANES>;

/// Worlds side by side. Rates, and what is derived from them, are those over a step.
#[derive(Debug, Default)]
pub(super) struct Pressed {
    state: [[Lane; STATES]; STATES],
    from: [[Lane; 2]; STATES],
    to: [[Lane; 2]; STATES],
    /// k/m, c/(m h), c h/m, m/I.
    spring: Lane,
    dashpot: Lane,
    inertial: Lane,
    turning: Lane,
    /// θ̈ by x and θ.
    righting: [Lane; 2],
    arms: [Lane; 2],
    /// 1 over the load of an edge at rest, and its compression.
    relief: [Lane; 2],
    sunk: [Lane; 2],
    pub(super) y: [Lane; STATES],
    /// Part of its load that an edge has lost: 1 where it lets go; and its rate.
    lost: [Lane; 2],
    losing: [Lane; 2],
    press: [Lane; 2],
    pressing: [Lane; 2],
    /// 1 until an edge has lost more than [`FIRM_RATIO`] of its load.
    pub(super) holds: Lane,
    /// Where the step began in which it did, and how many steps after the start of the block.
    pub(super) left: [Lane; STATES],
    pub(super) left_at: Lane,
    /// Largest part lost, compression and acceleration of each edge; the last two while both held.
    pub(super) most_lost: Lane,
    pub(super) most_pressed: Lane,
    pub(super) peak: [Lane; 2],
}

impl Pressed {
    /// Puts a world into a lane, with what it has reached so far.
    pub(super) fn enter(
        &mut self,
        lane: usize,
        body: &Body,
        recursion: &Recursion,
        y: &[f64; STATES],
    ) {
        let h = body.step_s;
        for (columns, row) in self.state.iter_mut().zip(&recursion.state) {
            for (column, value) in columns.iter_mut().zip(row) {
                column[lane] = *value;
            }
        }
        let ways = [
            (&mut self.from, &recursion.from),
            (&mut self.to, &recursion.to),
        ];
        for (columns, rows) in ways {
            for (column, value) in columns.iter_mut().flatten().zip(rows.iter().flatten()) {
                column[lane] = *value;
            }
        }
        for (column, value) in self.y.iter_mut().zip(y) {
            column[lane] = *value;
        }
        self.spring[lane] = body.spring;
        self.dashpot[lane] = body.dashpot / h;
        self.inertial[lane] = body.dashpot * h;
        self.turning[lane] = body.turning;
        for (column, value) in self.righting.iter_mut().zip(righting(body)) {
            column[lane] = value;
        }
        for edge in 0..2 {
            self.arms[edge][lane] = body.rest.arm_x[edge];
            self.relief[edge][lane] = 1.0 / body.rest.loads[edge];
            self.sunk[edge][lane] = body.rest.compressions[edge];
            // Nothing is interpolated over a step that was not seen.
            self.lost[edge][lane] = 0.0;
            self.losing[edge][lane] = 0.0;
            self.press[edge][lane] = 0.0;
            self.pressing[edge][lane] = 0.0;
            self.peak[edge][lane] = 0.0;
        }
        self.holds[lane] = 1.0;
        self.most_lost[lane] = 0.0;
        self.most_pressed[lane] = 0.0;
    }

    /// Takes a world out of a lane: zeros do nothing.
    pub(super) fn leave(&mut self, lane: usize) {
        for row in &mut self.state {
            for column in row {
                column[lane] = 0.0;
            }
        }
        for column in self
            .from
            .iter_mut()
            .chain(&mut self.to)
            .flatten()
            .chain(&mut self.y)
            .chain(&mut self.relief)
        {
            column[lane] = 0.0;
        }
        self.holds[lane] = 0.0;
    }
}

/// The base acceleration of every lane at each sample of a block of samples.
#[derive(Debug, Default)]
pub(super) struct Ground {
    pub(super) horizontal: Vec<Lane>,
    /// Empty where no lane moves vertically.
    pub(super) vertical: Vec<Lane>,
}

/// Follows all lanes through a block of samples, `parts` steps from one to the next.
pub(super) fn follow(arch: Arch, pressed: &mut Pressed, ground: &Ground, parts: usize) {
    arch.dispatch(Follow {
        pressed,
        ground,
        parts,
    });
}

struct Follow<'a> {
    pressed: &'a mut Pressed,
    ground: &'a Ground,
    parts: usize,
}

impl WithSimd for Follow<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let m = Math(simd);
        for i in 0..Lane::pairs::<S>() {
            self.pressed.pass(m, i, self.ground, self.parts);
        }
    }
}

/// A value in the middle of a step, from it and its rate at both ends.
#[inline(always)]
fn middle<S: Simd>(m: Math<S>, from: [Numbers<S>; 2], to: [Numbers<S>; 2]) -> Numbers<S> {
    m.fma(
        m.splat(0.125),
        m.sub(from[1], to[1]),
        m.mul(m.splat(0.5), m.add(from[0], to[0])),
    )
}

impl Pressed {
    #[inline(always)]
    fn pass<S: Simd>(&mut self, m: Math<S>, i: usize, ground: &Ground, parts: usize) {
        let (zero, one, limit) = (m.splat(0.0), m.splat(1.0), m.splat(FIRM_RATIO));
        let share = 1.0 / parts as f64;
        let moves_up = !ground.vertical.is_empty();
        let (spring, dashpot, inertial) = (
            self.spring.get::<S>(i),
            self.dashpot.get::<S>(i),
            self.inertial.get::<S>(i),
        );
        let (turning, arms) = (
            self.turning.get::<S>(i),
            [self.arms[0].get::<S>(i), self.arms[1].get::<S>(i)],
        );
        let mut y = six!(k, self.y[k].get::<S>(i));
        let mut step = 0.0;
        for (sample, ends) in ground.horizontal.windows(2).enumerate() {
            let (a_from, a_to) = (ends[0].get::<S>(i), ends[1].get::<S>(i));
            let change = m.sub(a_to, a_from);
            let (mut v_from, mut v_to) = (zero, zero);
            if let [from, to, ..] = ground.vertical.get(sample..).unwrap_or_default() {
                (v_from, v_to) = (from.get::<S>(i), to.get::<S>(i));
            }
            let v_change = m.sub(v_to, v_from);
            for part in 0..parts {
                let (start, end) = (
                    m.splat(part as f64 * share),
                    m.splat((part + 1) as f64 * share),
                );
                let (a, a_end) = (m.fma(start, change, a_from), m.fma(end, change, a_from));
                let (v, v_end) = (m.fma(start, v_change, v_from), m.fma(end, v_change, v_from));
                let before = y;
                y = six!(k, {
                    let row = &self.state[k];
                    let mut one = m.mul(self.from[k][0].get::<S>(i), a);
                    let mut two = m.mul(self.to[k][0].get::<S>(i), a_end);
                    if moves_up {
                        one = m.fma(self.from[k][1].get::<S>(i), v, one);
                        two = m.fma(self.to[k][1].get::<S>(i), v_end, two);
                    }
                    one = m.fma(row[0].get::<S>(i), before[0], one);
                    two = m.fma(row[1].get::<S>(i), before[1], two);
                    one = m.fma(row[2].get::<S>(i), before[2], one);
                    two = m.fma(row[3].get::<S>(i), before[3], two);
                    one = m.fma(row[4].get::<S>(i), before[4], one);
                    two = m.fma(row[5].get::<S>(i), before[5], two);
                    m.add(one, two)
                });
                // What each edge carries more than at rest, and the accelerations that follow.
                let press = two!(edge, m.fma(arms[edge], y[2], m.sub(zero, y[1])));
                let pressing = two!(edge, m.fma(arms[edge], y[5], m.sub(zero, y[4])));
                let load = two!(
                    edge,
                    m.fma(spring, press[edge], m.mul(dashpot, pressing[edge]))
                );
                let lift = m.add(load[0], load[1]);
                let couple = m.fma(arms[0], load[0], m.mul(arms[1], load[1]));
                let righting = m.fma(
                    self.righting[0].get::<S>(i),
                    y[0],
                    m.mul(self.righting[1].get::<S>(i), y[2]),
                );
                let spin = m.fnma(turning, couple, righting);
                let open = m.gt(self.holds.get::<S>(i), zero);
                let mut most = self.most_lost.get::<S>(i);
                let mut pressed = self.most_pressed.get::<S>(i);
                let (mut now, mut rising) = (zero, [zero; 2]);
                for edge in 0..2 {
                    // Upward in the inertial frame; relative to the base it is less by its acceleration.
                    let up = m.fnma(arms[edge], spin, lift);
                    let relief = m.sub(zero, self.relief[edge].get::<S>(i));
                    let lost = m.mul(relief, load[edge]);
                    let change = m.fnma(inertial, m.sub(up, v_end), m.mul(spring, pressing[edge]));
                    let losing = m.mul(relief, change);
                    let lost_before = [self.lost[edge].get::<S>(i), self.losing[edge].get::<S>(i)];
                    let inside = middle(m, lost_before, [lost, losing]);
                    now = m.larger(now, m.larger(lost, inside));
                    let press_before = [
                        self.press[edge].get::<S>(i),
                        self.pressing[edge].get::<S>(i),
                    ];
                    let inside = middle(m, press_before, [press[edge], pressing[edge]]);
                    let deepest = m.add(self.sunk[edge].get::<S>(i), m.larger(press[edge], inside));
                    pressed = m.larger(deepest, pressed);
                    rising[edge] = up;
                    self.lost[edge].set::<S>(i, lost);
                    self.losing[edge].set::<S>(i, losing);
                    self.press[edge].set::<S>(i, press[edge]);
                    self.pressing[edge].set::<S>(i, pressing[edge]);
                }
                most = m.larger(now, most);
                self.most_lost.set::<S>(i, most);
                // What follows from pads that pull does not count.
                let counts = m.ge(one, most);
                for (column, rising) in self.peak.iter_mut().zip(rising) {
                    let peak = column.get::<S>(i);
                    column.set::<S>(i, m.select(counts, m.larger(rising, peak), peak));
                }
                let old = self.most_pressed.get::<S>(i);
                self.most_pressed
                    .set::<S>(i, m.select(counts, pressed, old));
                let leaves = m.and(open, m.gt(now, limit));
                if m.any(leaves) {
                    for (column, before) in self.left.iter_mut().zip(before) {
                        let old = column.get::<S>(i);
                        column.set::<S>(i, m.select(leaves, before, old));
                    }
                    let old = self.left_at.get::<S>(i);
                    self.left_at
                        .set::<S>(i, m.select(leaves, m.splat(step), old));
                    let old = self.holds.get::<S>(i);
                    self.holds.set::<S>(i, m.select(leaves, zero, old));
                }
                step += 1.0;
            }
        }
        for (column, value) in self.y.iter_mut().zip(y) {
            column.set::<S>(i, value);
        }
    }
}
