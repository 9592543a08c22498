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
