//! Both edges on their pads: the linear equations, exact over a step in which the base acceleration
//! is a straight line.
//!
//! q = (x, z, θ) from rest, x without what the springs were stretched at the start; y = (q, h q̇)
//! of the step h. d_i = −z + r_x θ of an edge, n_i = (k d_i + c ḋ_i)/m; its spring stretches by
//! x + r_z θ. The rows are those of the equation of motion at rest, with the weight on the arms
//! that turn: −θ Σ r_z N_i.

use pulp::Simd;

use super::body::Body;
use super::each::{each, six};
use crate::vector::{Math, Numbers};

/// x, z, θ and h times their rates.
pub(super) const STATES: usize = 6;

/// What [`Bounds`] weighs: the states in [`Modes`], and of the base, each by its size, the horizontal acceleration at the
/// start, its largest change over a sample, the largest difference of two such changes that follow each other, and the
/// largest vertical acceleration.
pub(super) const WEIGHED: usize = STATES + 4;
pub(super) const LEVEL: usize = STATES;
pub(super) const SLOPE: usize = STATES + 1;
pub(super) const BEND: usize = STATES + 2;
pub(super) const UP: usize = STATES + 3;

/// The states, two accelerations of the base and their changes over the step.
const ALL: usize = STATES + 4;

pub(super) type Matrix = [[f64; ALL]; ALL];

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
    /// y at the end, with the accelerations of the base at the start and at the end, each way.
    #[inline(always)]
    pub(super) fn after<S: Simd>(
        &self,
        m: Math<S>,
        y: [Numbers<S>; STATES],
        a: [Numbers<S>; 2],
        v: [Numbers<S>; 2],
    ) -> [Numbers<S>; STATES] {
        six!(k, {
            let row = &self.state[k];
            let (from, to) = (&self.from[k], &self.to[k]);
            let mut one = m.mul(m.splat(from[0]), a[0]);
            let mut two = m.mul(m.splat(to[0]), a[1]);
            one = m.fma(m.splat(from[1]), v[0], one);
            two = m.fma(m.splat(to[1]), v[1], two);
            one = m.fma(m.splat(row[0]), y[0], one);
            two = m.fma(m.splat(row[1]), y[1], two);
            one = m.fma(m.splat(row[2]), y[2], one);
            two = m.fma(m.splat(row[3]), y[3], two);
            one = m.fma(m.splat(row[4]), y[4], one);
            two = m.fma(m.splat(row[5]), y[5], two);
            m.add(one, two)
        })
    }

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
pub(super) type Row = [f64; STATES + 1];

/// A whole sample, and what bounds the numbers of the block at all of its steps.
#[derive(Debug, Clone)]
pub(super) struct Sample {
    pub(super) recursion: Recursion,
    pub(super) modes: Modes,
    pub(super) bounds: Bounds,
}

/// Weights on the sizes of the states and of the accelerations of the base in a sample. The sums of products are no
/// smaller than what [`Look`](super::look::Look) finds at the steps of the sample and in the middle of
/// each, on either edge.
#[derive(Debug, Clone, Default)]
pub(super) struct Bounds {
    /// The part of its load that an edge loses.
    pub(super) lost: [f64; WEIGHED],
    /// The compression of a pad beyond that at rest.
    pub(super) press: [f64; WEIGHED],
    /// The upward acceleration of an edge.
    pub(super) up: [f64; WEIGHED],
}

/// The undamped modes of the block. In them forces that cancel do not count twice, so bounds are close: of the
/// position they take what differs from that which the horizontal acceleration would hold.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    /// From (x, z, θ) to the modes, and back.
    pub(super) into: [[f64; 3]; 3],
    pub(super) from: [[f64; 3]; 3],
    /// Where an acceleration of 1 would hold each.
    pub(super) held: [f64; 3],
}

impl Modes {
    fn new(body: &Body) -> Self {
        let a = rates(body);
        // θ in the length that makes the stiffness symmetric.
        let length = [1.0, 1.0, body.turning.sqrt().recip()];
        let per_s2 = (body.step_s * body.step_s).recip();
        let mut stiffness = [[0.0; 3]; 3];
        for (i, row) in stiffness.iter_mut().enumerate() {
            for (k, value) in row.iter_mut().enumerate() {
                *value = -per_s2 * length[i] * a[3 + i][k] / length[k];
            }
        }
        let (squares, vectors) = turned(stiffness);
        let into: [[f64; 3]; 3] =
            std::array::from_fn(|mode| std::array::from_fn(|k| vectors[k][mode] * length[k]));
        Self {
            into,
            from: std::array::from_fn(|k| std::array::from_fn(|mode| vectors[k][mode] / length[k])),
            held: std::array::from_fn(|mode| -into[mode][0] / squares[mode]),
        }
    }
}

/// Turns the axes until a symmetric matrix has nothing beside its diagonal: the diagonal, and the new axes in columns.
/// Jacobi's method; five rounds leave nothing but rounding.
fn turned(mut matrix: [[f64; 3]; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (p, q) in [(0, 1), (0, 2), (1, 2)].repeat(5) {
        let angle = 0.5 * f64::atan2(2.0 * matrix[p][q], matrix[p][p] - matrix[q][q]);
        let (sin, cos) = angle.sin_cos();
        let turn = |row: &mut [f64; 3]| {
            (row[p], row[q]) = (cos * row[p] + sin * row[q], cos * row[q] - sin * row[p]);
        };
        matrix.iter_mut().for_each(turn);
        axes.iter_mut().for_each(turn);
        let both = matrix[p].into_iter().zip(matrix[q]);
        for (k, (one, other)) in both.enumerate() {
            (matrix[p][k], matrix[q][k]) = (cos * one + sin * other, cos * other - sin * one);
        }
    }
    ([matrix[0][0], matrix[1][1], matrix[2][2]], axes)
}

/// What rounding may add to a number that is bounded: far more than it does.
const ROUNDING: f64 = 1.0 + 1e-9;

impl Sample {
    /// Of so many steps of a body.
    pub(super) fn new(body: &Body, step: &Recursion) -> Self {
        let parts = body.parts;
        let numbers: [_; 2] = std::array::from_fn(|edge| EdgeNumbers::new(body, edge));
        let modes = Modes::new(body);
        let mut bounds = Bounds::default();
        let mut recursion = Recursion::nothing();
        for done in 0..=parts {
            let ends = done as f64 / parts as f64;
            if done > 0 {
                recursion = recursion.and(step, (done - 1) as f64 / parts as f64, ends);
            }
            for EdgeNumbers {
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
                    let mut weights = recursion.weights(&modes, value, ends);
                    let rates = rate.map(|rate| recursion.weights(&modes, rate, ends));
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
        Self {
            recursion,
            modes,
            bounds,
        }
    }
}

impl Recursion {
    /// The sizes of what a number depends on at the end, which is at this share of the sample.
    fn weights(&self, modes: &Modes, number: &Row, ends: f64) -> [f64; WEIGHED] {
        let mut states = [0.0; STATES];
        let mut base = [
            [0.0; 2],
            [(1.0 - ends) * number[STATES], ends * number[STATES]],
        ];
        for (k, factor) in number.iter().take(STATES).enumerate() {
            for (value, before) in states.iter_mut().zip(&self.state[k]) {
                *value += factor * before;
            }
            for (way, base) in base.iter_mut().enumerate() {
                base[0] += factor * self.from[k][way];
                base[1] += factor * self.to[k][way];
            }
        }
        let [horizontal, vertical] = base;
        // A steady acceleration.
        let mut steady = horizontal[0] + horizontal[1];
        let mut all = [0.0; WEIGHED];
        for mode in 0..3 {
            let of = |states: &[f64]| (0..3).map(|k| states[k] * modes.from[k][mode]).sum::<f64>();
            let (place, rate) = (of(&states[..3]), of(&states[3..]));
            (all[mode], all[3 + mode]) = (place.abs(), rate.abs());
            steady += place * modes.held[mode];
        }
        (all[LEVEL], all[SLOPE]) = (steady.abs(), horizontal[1].abs());
        all[UP] = vertical[0].abs() + vertical[1].abs();
        all
    }
}

/// What [`Look`](super::look::Look) finds of an edge, rates over a step, from the states at that instant.
pub(super) struct EdgeNumbers {
    pub(super) lost: Row,
    losing: Row,
    pub(super) press: Row,
    pressing: Row,
    pub(super) up: Row,
}

impl EdgeNumbers {
    pub(super) fn new(body: &Body, edge: usize) -> Self {
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
                (-inertial, up),
                (inertial, vertical),
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
pub(super) fn rates(body: &Body) -> Matrix {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliant::bulk::tests::leaning;

    /// What is called the rate of a number is its rate, by the equations of motion.
    #[test]
    fn rates_of_numbers_are_rates() {
        let body = leaning();
        let a = rates(&body);
        for edge in 0..2 {
            let EdgeNumbers {
                lost,
                losing,
                press,
                pressing,
                ..
            } = EdgeNumbers::new(&body, edge);
            for (number, rate) in [(lost, losing), (press, pressing)] {
                for (state, rate) in rate.iter().enumerate() {
                    // The vertical acceleration comes after the horizontal one and its change.
                    let column = if state < STATES { state } else { STATES + 2 };
                    let expected: f64 = (0..STATES).map(|k| number[k] * a[k][column]).sum();
                    // A dozen sums and products.
                    let size = expected.abs().max(1e-3);
                    let error = (rate - expected).abs();
                    // The horizontal acceleration moves no edge upward.
                    assert_eq!(number[3], 0.0);
                    assert!(error < 1e-12 * size, "{edge} {state}: {rate} {expected}");
                }
            }
        }
    }

    /// Steps one after the other are a whole sample.
    #[test]
    fn a_sample_is_its_steps() {
        let body = leaning();
        let step = Recursion::new(&body);
        let whole = Sample::new(&body, &step).recursion;
        let (y, a) = (
            [1e-3, 2e-4, -3e-3, 1e-4, 5e-5, 2e-3],
            [[0.7, -0.2], [1.9, 0.4]],
        );
        let after = |one: &Recursion, y: [f64; STATES], a: [[f64; 2]; 2]| -> [f64; STATES] {
            std::array::from_fn(|k| {
                let state: f64 = (0..STATES).map(|i| one.state[k][i] * y[i]).sum();
                let base = |way: usize| one.from[k][way] * a[0][way] + one.to[k][way] * a[1][way];
                state + base(0) + base(1)
            })
        };
        let mut one_by_one = y;
        for part in 0..body.parts {
            let at = |done: usize| {
                let share = done as f64 / body.parts as f64;
                [0, 1].map(|way: usize| a[0][way] + share * (a[1][way] - a[0][way]))
            };
            one_by_one = after(&step, one_by_one, [at(part), at(part + 1)]);
        }
        assert!(body.parts > 1);
        for (once, steps) in after(&whole, y, a).into_iter().zip(one_by_one) {
            // Rounding of some steps with numbers of this size.
            assert!(
                (once - steps).abs() < 1e-16 * body.parts as f64,
                "{once} {steps}"
            );
        }
    }
}
