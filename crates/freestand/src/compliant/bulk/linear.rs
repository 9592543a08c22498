//! Both edges on their pads: the linear equations, exact over a step in which the base acceleration
//! is a straight line.
//!
//! q = (x, z, θ) from rest, x without what the springs were stretched at the start; y = (q, h q̇)
//! of the step h. d_i = −z + r_x θ of an edge, n_i = (k d_i + c ḋ_i)/m; its spring stretches by
//! x + r_z θ. The rows are those of the equation of motion at rest, with the weight on the arms
//! that turn: −θ Σ r_z N_i.

use super::body::Body;

/// x, z, θ and h times their rates.
pub(super) const STATES: usize = 6;

/// The states, and the largest horizontal and vertical acceleration of the base: what [`Bounds`] weighs.
pub(super) const WEIGHED: usize = STATES + 2;

/// The states, two accelerations of the base and their changes over the step.
const ALL: usize = STATES + 4;

type Matrix = [[f64; ALL]; ALL];

/// Terms of the exponential series: with steps of a third of a radian the last one is below 1e-17.
const TERMS: i32 = 18;

/// y at the end = `state` y + `from` a(0) + `to` a(h), with the horizontal acceleration of the base and the
/// vertical one.
#[derive(Debug, Clone)]
pub(super) struct Recursion {
    pub(super) state: [[f64; STATES]; STATES],
    pub(super) from: [[f64; 2]; STATES],
    pub(super) to: [[f64; 2]; STATES],
}

impl Recursion {
    pub(super) fn new(body: &Body) -> Self {
        let exponential = exponential(&rates(body));
        let mut recursion = Self {
            state: [[0.0; STATES]; STATES],
            from: [[0.0; 2]; STATES],
            to: [[0.0; 2]; STATES],
        };
        for (i, row) in exponential.iter().take(STATES).enumerate() {
            recursion.state[i].copy_from_slice(&row[..STATES]);
            for way in 0..2 {
                let (level, change) = (row[STATES + 2 * way], row[STATES + 2 * way + 1]);
                (recursion.from[i][way], recursion.to[i][way]) = (level - change, change);
            }
        }
        recursion
    }
}

impl Recursion {
    /// Over no time at all.
    fn nothing() -> Self {
        let mut state = [[0.0; STATES]; STATES];
        for (i, row) in state.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        let (from, to) = ([[0.0; 2]; STATES], [[0.0; 2]; STATES]);
        Self { state, from, to }
    }

    /// With one more `step`, which begins and ends at these shares of the time in which the acceleration
    /// goes from a(0) to a(h).
    fn and(&self, step: &Self, begins: f64, ends: f64) -> Self {
        let mut all = Self {
            state: [[0.0; STATES]; STATES],
            ..step.clone()
        };
        for (i, through) in step.state.iter().enumerate() {
            for way in 0..2 {
                let (from, to) = (step.from[i][way], step.to[i][way]);
                all.from[i][way] = from * (1.0 - begins) + to * (1.0 - ends);
                all.to[i][way] = from * begins + to * ends;
            }
            for (k, factor) in through.iter().enumerate() {
                for (value, before) in all.state[i].iter_mut().zip(&self.state[k]) {
                    *value += factor * before;
                }
                for way in 0..2 {
                    all.from[i][way] += factor * self.from[k][way];
                    all.to[i][way] += factor * self.to[k][way];
                }
            }
        }
        all
    }
}

/// A number of the block at an instant: its part of each state, and of the vertical acceleration of the base.
type Row = [f64; STATES + 1];

/// A whole sample, and what bounds the numbers of the block at all of its steps.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    pub(super) recursion: Recursion,
    pub(super) bounds: Bounds,
}

/// Weights on the sizes of the states at the start of a sample and of the accelerations of the base in it. The
/// sums of products are no smaller than what [`Pressed`](super::pressed::Pressed) finds at the steps of the
/// sample and in the middle of each, on either edge.
#[derive(Debug, Clone, Default)]
pub(super) struct Bounds {
    /// The part of its load that an edge loses.
    pub(super) lost: [f64; WEIGHED],
    /// The compression of a pad beyond that at rest.
    pub(super) press: [f64; WEIGHED],
    /// The upward acceleration of an edge.
    pub(super) up: [f64; WEIGHED],
}

/// What rounding may add to a number that is bounded: far more than it does.
const ROUNDING: f64 = 1.0 + 1e-9;

impl Sample {
    /// Of so many steps of a body.
    pub(super) fn new(body: &Body, step: &Recursion) -> Self {
        let parts = body.parts;
        let numbers: [_; 2] = std::array::from_fn(|edge| Numbers::new(body, edge));
        let mut bounds = Bounds::default();
        let mut recursion = Recursion::nothing();
        for done in 0..=parts {
            let ends = done as f64 / parts as f64;
            if done > 0 {
                recursion = recursion.and(step, (done - 1) as f64 / parts as f64, ends);
            }
            for Numbers {
                lost,
                losing,
                press,
                pressing,
                up,
            } in &numbers
            {
                // In the middle of a step: half of the sum of both ends, and an eighth of the difference of their
                // rates.
                let of = |value: &Row, rate: Option<&Row>| {
                    let mut weights = recursion.weights(value, ends);
                    let rates = rate.map(|rate| recursion.weights(rate, ends));
                    for (weight, rate) in weights.iter_mut().zip(rates.iter().flatten()) {
                        *weight += 0.25 * rate;
                    }
                    weights
                };
                for (most, weights) in [
                    (&mut bounds.lost, of(lost, Some(losing))),
                    (&mut bounds.press, of(press, Some(pressing))),
                    (&mut bounds.up, of(up, None)),
                ] {
                    for (most, weight) in most.iter_mut().zip(weights) {
                        *most = most.max(ROUNDING * weight);
                    }
                }
            }
        }
        Self { recursion, bounds }
    }
}

impl Recursion {
    /// The sizes of what a number depends on at the end, which is at this share of the sample.
    fn weights(&self, number: &Row, ends: f64) -> [f64; WEIGHED] {
        let mut all = [0.0; WEIGHED];
        let mut base = [
            [0.0; 2],
            [(1.0 - ends) * number[STATES], ends * number[STATES]],
        ];
        for (k, factor) in number.iter().take(STATES).enumerate() {
            for (value, before) in all.iter_mut().zip(&self.state[k]) {
                *value += factor * before;
            }
            for (way, base) in base.iter_mut().enumerate() {
                base[0] += factor * self.from[k][way];
                base[1] += factor * self.to[k][way];
            }
        }
        for (value, [from, to]) in all[STATES..].iter_mut().zip(base) {
            *value = from.abs() + to.abs();
        }
        all.map(f64::abs)
    }
}

/// What [`Pressed`](super::pressed::Pressed) finds of an edge, rates over a step, from the states at that instant.
struct Numbers {
    lost: Row,
    losing: Row,
    press: Row,
    pressing: Row,
    up: Row,
}

impl Numbers {
    fn new(body: &Body, edge: usize) -> Self {
        let Body {
            spring,
            dashpot,
            turning,
            step_s: h,
            rest,
            ..
        } = *body;
        let sum = |parts: &[(f64, Row)]| {
            let mut sum = [0.0; STATES + 1];
            for (factor, row) in parts {
                for (value, part) in sum.iter_mut().zip(row) {
                    *value += factor * part;
                }
            }
            sum
        };
        let arms = rest.arm_x;
        let press = arms.map(|arm| [0.0, -1.0, arm, 0.0, 0.0, 0.0, 0.0]);
        let pressing = arms.map(|arm| [0.0, 0.0, 0.0, 0.0, -1.0, arm, 0.0]);
        let load = [0, 1].map(|i: usize| sum(&[(spring, press[i]), (dashpot / h, pressing[i])]));
        let [by_x, by_theta] = righting(body);
        let spin = sum(&[
            (1.0, [by_x, 0.0, by_theta, 0.0, 0.0, 0.0, 0.0]),
            (-turning * arms[0], load[0]),
            (-turning * arms[1], load[1]),
        ]);
        let up = sum(&[(1.0, load[0]), (1.0, load[1]), (-arms[edge], spin)]);
        let relief = -1.0 / rest.loads[edge];
        let vertical = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        let inertial = relief * dashpot * h;
        Self {
            lost: sum(&[(relief, load[edge])]),
            losing: sum(&[
                (inertial, up),
                (-inertial, vertical),
                (relief * spring, pressing[edge]),
            ]),
            press: press[edge],
            pressing: pressing[edge],
            up,
        }
    }
}

/// How θ̈ depends on x and θ, beside the loads of the edges.
pub(super) fn righting(body: &Body) -> [f64; 2] {
    let Body {
        spring,
        turning,
        rest,
        ..
    } = *body;
    let sum = rest.arm_z[0] + rest.arm_z[1];
    let squares = rest.arm_z[0] * rest.arm_z[0] + rest.arm_z[1] * rest.arm_z[1];
    let weight = rest.arm_z[0] * rest.loads[0] + rest.arm_z[1] * rest.loads[1];
    [
        -turning * spring * sum,
        -turning * (spring * squares + weight),
    ]
}

/// dy/dτ over a step from τ = 0 to 1.
fn rates(body: &Body) -> Matrix {
    let Body {
        spring,
        dashpot,
        turning,
        step_s: h,
        rest,
        ..
    } = *body;
    let mut a = [[0.0; ALL]; ALL];
    for i in 0..3 {
        a[i][3 + i] = 1.0;
    }
    let (arm_x, arm_z) = (rest.arm_x, rest.arm_z);
    a[3][0] = -2.0 * spring * h * h;
    a[3][2] = -spring * (arm_z[0] + arm_z[1]) * h * h;
    let [by_x, by_theta] = righting(body);
    (a[5][0], a[5][2]) = (by_x * h * h, by_theta * h * h);
    for arm in arm_x {
        // d_i = −z + r_x θ.
        for (place, share) in [(1, -1.0), (2, arm)] {
            let (elastic, viscous) = (spring * share * h * h, dashpot * share * h);
            for (row, part) in [(4, 1.0), (5, -turning * arm)] {
                a[row][place] += part * elastic;
                a[row][3 + place] += part * viscous;
            }
        }
    }
    for way in 0..2 {
        a[3 + way][STATES + 2 * way] = -h * h;
        a[STATES + 2 * way][STATES + 2 * way + 1] = 1.0;
    }
    a
}

/// eᴬ by its series.
fn exponential(a: &Matrix) -> Matrix {
    let mut sum = [[0.0; ALL]; ALL];
    for (i, row) in sum.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    let mut term = sum;
    for n in 1..=TERMS {
        let mut next = [[0.0; ALL]; ALL];
        for (row, from) in next.iter_mut().zip(&term) {
            for (weight, through) in from.iter().zip(a) {
                if *weight != 0.0 {
                    for (value, factor) in row.iter_mut().zip(through) {
                        *value += weight * factor;
                    }
                }
            }
            for value in row.iter_mut() {
                *value /= f64::from(n);
            }
        }
        term = next;
        for (row, add) in sum.iter_mut().zip(&term) {
            for (value, add) in row.iter_mut().zip(add) {
                *value += add;
            }
        }
    }
    sum
}
