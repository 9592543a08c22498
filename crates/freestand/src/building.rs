//! A multi-storey building as a shear beam coupled with a flexural beam, and the motion of its floors.
//!
//! Uniform mass and stiffness over the height; `α = H √(GA/EI)` goes from 0 (a flexural cantilever: walls) over 1–5
//! (dual systems) and 5–20 (frames with walls) to 30 and more (nearly a shear beam: frames). Heights are fractions of
//! the total, x = 0 the ground and 1 the roof.

use crate::motion::{Motion, MotionError};
use crate::oscillator::{OscillatorError, absolute_acceleration_history_m_s2};
use std::f64::consts::PI;
use thiserror::Error;

/// Free vibration to leave after a motion, in fundamental periods: 5 % damping has decayed by e^(−π) ≈ 1/23 after ten.
pub const TAIL_PERIODS: f64 = 10.0;

/// Most modes of a [`Building`]: the fiftieth is 1/99 of the fundamental period or less, far below a record's step.
pub const MAX_MODES: usize = 50;

/// Longest fundamental period of a [`Building`] \[s\]: ten times that of the tallest tower.
pub const MAX_PERIOD_S: f64 = 100.0;

/// Why a building or its floor motion cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BuildingError {
    /// The fundamental period is not usable.
    #[error("the fundamental period must be positive and at most {MAX_PERIOD_S} s, not {period_s} s")]
    Period {
        /// The period that was given, or that of the mode that is too short.
        period_s: f64,
    },
    /// The damping is not below critical.
    #[error("the damping ratio must be at least 0 and below 1, not {damping_ratio}")]
    Damping {
        /// The damping ratio that was given.
        damping_ratio: f64,
    },
    /// The shear-flexure ratio is negative or not finite.
    #[error("the shear-flexure ratio must be at least 0 and finite, not {shear_flexure_ratio}")]
    ShearFlexure {
        /// The ratio that was given.
        shear_flexure_ratio: f64,
    },
    /// No modes, or more than [`MAX_MODES`].
    #[error("the number of modes must be 1 to {MAX_MODES}, not {modes}")]
    Modes {
        /// The number that was given.
        modes: usize,
    },
    /// A level below the ground or above the roof.
    #[error("a level is a fraction of the height, 0 to 1, not {level_ratio}")]
    Level {
        /// The level that was given.
        level_ratio: f64,
    },
    /// The floor motion is not a motion (its samples overflow).
    #[error("the floor motion is not finite: {0}")]
    Motion(#[from] MotionError),
}

/// One mode of vibration of a [`Building`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    period_s: f64,
    eigenvalue: f64,
    participation_ratio: f64,
    effective_mass_ratio: f64,
    shape: Shape,
}

impl Mode {
    /// Period of the mode \[s\].
    pub fn period_s(&self) -> f64 {
        self.period_s
    }

    /// Dimensionless eigenvalue γ: the wave number of the shape's sine over the height.
    pub fn eigenvalue(&self) -> f64 {
        self.eigenvalue
    }

    /// Participation factor `Γ = ∫φ dx / ∫φ² dx` for the shape that is 1 at the roof.
    pub fn participation_ratio(&self) -> f64 {
        self.participation_ratio
    }

    /// Share of the building's mass that acts in the mode, `(∫φ dx)² / ∫φ² dx`; all modes add up to 1.
    pub fn effective_mass_ratio(&self) -> f64 {
        self.effective_mass_ratio
    }

    /// Mode shape φ at `level_ratio` of the height: exactly 0 at the ground, 1 at the roof.
    pub fn shape_ratio(&self, level_ratio: f64) -> f64 {
        if level_ratio == 0.0 { 0.0 } else { self.shape.value(level_ratio) / self.shape.roof }
    }
}

/// A building of uniform mass and stiffness on its modes, all with the same damping.
#[derive(Debug, Clone, PartialEq)]
pub struct Building {
    damping_ratio: f64,
    shear_flexure_ratio: f64,
    modes: Vec<Mode>,
}

impl Building {
    /// A building of fundamental period `period_s` with `modes` modes.
    ///
    /// `shear_flexure_ratio` is `α = H √(GA/EI)`. Periods of the modes: `T_i/T₁ = γ₁β₁/(γ_iβ_i)`, `β² = γ² + α²`,
    /// with γ the roots of `2 + (2 + α⁴/(γ²β²)) cos γ cosh β + α²/(γβ) sin γ sinh β = 0`.
    ///
    /// # Reference
    /// Miranda and Taghavi (2005), "Approximate floor acceleration demands in multistory buildings. I: Formulation",
    /// J. Struct. Eng. 131(2).
    ///
    /// # Accuracy
    /// Eigenvalues to the last digits for every α from 0 to beyond 10⁶, participation by closed integrals. No root can
    /// be missed: each interval ((i−1)π, iπ) holds exactly one.
    ///
    /// # Limitation
    /// Linear; uniform over the height (a building much softer at its top has longer higher periods); no torsion, no
    /// soil-structure interaction; one damping ratio for all modes.
    ///
    /// # Errors
    /// A period that is not positive and finite, damping outside 0 ≤ ζ < 1, a negative or non-finite α, no mode or
    /// more than [`MAX_MODES`].
    ///
    /// # Example
    /// A shear beam's periods go as 1, 1/3, 1/5, and its roof participates with 4/π; α = 10⁶ is nearly one:
    /// ```
    /// let building = freestand::building::Building::new(2.0, 0.05, 1e6, 3)?;
    /// let [first, second, third] = building.modes() else { unreachable!() };
    /// assert!((second.period_s() - 2.0 / 3.0).abs() < 1e-5);
    /// assert!((third.period_s() - 2.0 / 5.0).abs() < 1e-5);
    /// assert!((first.participation_ratio() - 4.0 / std::f64::consts::PI).abs() < 1e-5);
    /// # Ok::<(), freestand::building::BuildingError>(())
    /// ```
    pub fn new(
        period_s: f64,
        damping_ratio: f64,
        shear_flexure_ratio: f64,
        modes: usize,
    ) -> Result<Self, BuildingError> {
        if !(period_s > 0.0 && period_s <= MAX_PERIOD_S) {
            return Err(BuildingError::Period { period_s });
        }
        if !(0.0..1.0).contains(&damping_ratio) {
            return Err(BuildingError::Damping { damping_ratio });
        }
        if !(shear_flexure_ratio >= 0.0 && shear_flexure_ratio.is_finite()) {
            return Err(BuildingError::ShearFlexure { shear_flexure_ratio });
        }
        if !(1..=MAX_MODES).contains(&modes) {
            return Err(BuildingError::Modes { modes });
        }
        let alpha = shear_flexure_ratio;
        let first = eigenvalue(alpha, 1);
        let modes = (1..=modes).map(|i| mode(period_s, alpha, first, eigenvalue(alpha, i))).collect();
        Ok(Self { damping_ratio, shear_flexure_ratio, modes })
    }

    /// The modes by falling period; at least one.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// Fundamental period T₁ \[s\].
    pub fn period_s(&self) -> f64 {
        self.modes[0].period_s
    }

    /// Damping ratio of every mode.
    pub fn damping_ratio(&self) -> f64 {
        self.damping_ratio
    }

    /// `α = H √(GA/EI)`.
    pub fn shear_flexure_ratio(&self) -> f64 {
        self.shear_flexure_ratio
    }

    /// Zeros to append to a ground motion so that the floors ring down, [`TAIL_PERIODS`]·T₁ \[s\]; for
    /// [`Motion::with_zero_tail`].
    pub fn tail_s(&self) -> f64 {
        TAIL_PERIODS * self.period_s()
    }
}

fn mode(period_s: f64, alpha: f64, first: f64, gamma: f64) -> Mode {
    let shape = Shape::new(alpha, gamma);
    let (area, square) = (shape.integral(), shape.integral_of_square());
    Mode {
        // Ratio by ratio, so that a large α does not overflow.
        period_s: period_s * (first / gamma) * (first.hypot(alpha) / gamma.hypot(alpha)),
        eigenvalue: gamma,
        participation_ratio: shape.roof * area / square,
        effective_mass_ratio: area * area / square,
        shape,
    }
}

/// The `number`-th eigenvalue (from 1), by bisection of ((number − 1)π, number·π).
///
/// Why exactly one root lies there, whatever α: divided by cosh β, the characteristic function at γ = iπ is
/// `2/cosh β + (−1)^i (2 + q²)`, which has the sign (−1)^i, so there is at least one. For α = 0 there is exactly one
/// (cos γ = −1/cosh γ), the eigenvalues move continuously with α, and none can pass through iπ.
fn eigenvalue(alpha: f64, number: usize) -> f64 {
    let (mut low, mut high) = ((number - 1) as f64 * PI, number as f64 * PI);
    let positive_below = number % 2 == 1;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if (characteristic(alpha, middle) > 0.0) == positive_below { low = middle } else { high = middle }
    }
}

/// The characteristic function divided by cosh β, so that it does not overflow; q = α²/(γβ).
fn characteristic(alpha: f64, gamma: f64) -> f64 {
    let beta = gamma.hypot(alpha);
    let q = (alpha / gamma) * (alpha / beta);
    2.0 / beta.cosh() + (2.0 + q * q) * gamma.cos() + q * gamma.sin() * beta.tanh()
}

/// `sin γx − η cos γx + P e^(β(x−1)) + Q e^(−βx)`: the textbook's sinh and cosh put together so that the growing parts,
/// which cancel, never arise (as printed they leave 1 % of error in Γ at α = 30).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shape {
    gamma: f64,
    beta: f64,
    eta: f64,
    p: f64,
    q: f64,
    roof: f64,
}

impl Shape {
    fn new(alpha: f64, gamma: f64) -> Self {
        let beta = gamma.hypot(alpha);
        let r = gamma / beta;
        let (sin, cos) = gamma.sin_cos();
        let e = (-beta).exp();
        let denominator = 0.5 * (1.0 + e * e) + r * r * cos * e;
        let eta = (r * r * sin * e + 0.5 * r * (1.0 - e * e)) / denominator;
        let p = 0.5 * r * (r * sin - r * r * cos - e) / denominator;
        let mut shape = Self { gamma, beta, eta, p, q: 0.5 * (eta + r), roof: 1.0 };
        shape.roof = shape.value(1.0);
        shape
    }

    fn value(&self, x: f64) -> f64 {
        let (sin, cos) = (self.gamma * x).sin_cos();
        sin - self.eta * cos + self.p * (self.beta * (x - 1.0)).exp() + self.q * (-self.beta * x).exp()
    }

    /// ∫φ dx over the height.
    fn integral(&self) -> f64 {
        let (sin, cos) = self.gamma.sin_cos();
        (1.0 - cos - self.eta * sin) / self.gamma + (self.p + self.q) * -(-self.beta).exp_m1() / self.beta
    }

    /// ∫φ² dx over the height: the ten products of the four terms, each in closed form.
    fn integral_of_square(&self) -> f64 {
        let Self { gamma, beta, eta, p, q, .. } = *self;
        let (sin, cos) = gamma.sin_cos();
        let e = (-beta).exp();
        let r = gamma / beta;
        let scale = 1.0 / (beta * (1.0 + r * r));
        let swing = sin * cos / (2.0 * gamma);
        let (sin_sin, cos_cos, sin_cos) = (0.5 - swing, 0.5 + swing, sin * sin / (2.0 * gamma));
        let (grow_grow, grow_fall) = (-(-2.0 * beta).exp_m1() / (2.0 * beta), e);
        let (grow_sin, grow_cos) = ((sin - r * cos + r * e) * scale, (cos + r * sin - e) * scale);
        let (fall_sin, fall_cos) = ((r - e * (sin + r * cos)) * scale, (1.0 + e * (r * sin - cos)) * scale);
        sin_sin + eta * eta * cos_cos - 2.0 * eta * sin_cos
            + (p * p + q * q) * grow_grow
            + 2.0 * p * q * grow_fall
            + 2.0 * p * (grow_sin - eta * grow_cos)
            + 2.0 * q * (fall_sin - eta * fall_cos)
    }
}

/// Motion of one floor; see [`floor_motions`].
///
/// # Errors
/// A level outside 0 to 1; samples that overflow.
///
/// # Example
/// The ground floor moves as the ground:
/// ```
/// use freestand::{building::{Building, floor_motion}, motion::Motion};
/// let ground = Motion::new(0.02, vec![0.3, -1.0, 0.7])?;
/// let building = Building::new(1.92, 0.05, 5.0, 10)?;
/// assert_eq!(floor_motion(&ground, &building, 0.0)?, ground);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn floor_motion(ground: &Motion, building: &Building, level_ratio: f64) -> Result<Motion, BuildingError> {
    check_level(level_ratio)?;
    let accel_m_s2 = floor_accelerations(ground, building, &[level_ratio])?.swap_remove(0);
    Ok(Motion::new(ground.dt_s(), accel_m_s2)?)
}

/// Absolute acceleration of several floors of a building at rest at t = 0, in the order of `levels_ratio`.
///
/// `a(x, t) = Σ Γ_iφ_i(x) A_i(t) + [1 − Σ Γ_iφ_i(x)] a_g(t)`, A_i the absolute acceleration of a modal oscillator. The
/// bracket is the quasi-static share of the modes left out: without it the floors near the ground would not move.
/// At x = 0 the ground motion itself comes back, bit for bit.
///
/// # Reference
/// Chopra, Dynamics of Structures, modal analysis with static correction; oscillators by Nigam and Jennings (1969).
///
/// # Accuracy
/// Exact in time for the modes kept. With 6 modes of a building of T₁ = 2 s the peaks of the 1940 El Centro record are
/// within 0.4 % of those of many modes from mid-height up.
///
/// # Limitation
/// As long as the ground motion: append [`Building::tail_s`] of zeros first so that the floors ring down.
///
/// # Errors
/// A level outside 0 to 1; samples that overflow.
pub fn floor_motions(ground: &Motion, building: &Building, levels_ratio: &[f64]) -> Result<Vec<Motion>, BuildingError> {
    levels_ratio.iter().try_for_each(|&level_ratio| check_level(level_ratio))?;
    let floors = floor_accelerations(ground, building, levels_ratio)?;
    floors.into_iter().map(|accel_m_s2| Ok(Motion::new(ground.dt_s(), accel_m_s2)?)).collect()
}

fn check_level(level_ratio: f64) -> Result<(), BuildingError> {
    if (0.0..=1.0).contains(&level_ratio) { Ok(()) } else { Err(BuildingError::Level { level_ratio }) }
}

fn floor_accelerations(
    ground: &Motion,
    building: &Building,
    levels_ratio: &[f64],
) -> Result<Vec<Vec<f64>>, BuildingError> {
    let share = |mode: &Mode, level: f64| mode.participation_ratio * mode.shape_ratio(level);
    let accel = ground.accel_m_s2();
    let mut floors: Vec<Vec<f64>> = levels_ratio
        .iter()
        .map(|&level| {
            let residual = 1.0 - building.modes.iter().map(|mode| share(mode, level)).sum::<f64>();
            accel.iter().map(|a| residual * a).collect()
        })
        .collect();
    for mode in &building.modes {
        let history = absolute_acceleration_history_m_s2(ground, mode.period_s, building.damping_ratio)
            .map_err(|error| oscillator_problem(error, mode.period_s))?;
        for (floor, &level) in floors.iter_mut().zip(levels_ratio).filter(|&(_, &level)| level > 0.0) {
            let share = share(mode, level);
            for (sample, absolute) in floor.iter_mut().zip(&history) {
                *sample += share * absolute;
            }
        }
    }
    Ok(floors)
}

/// The building and the motion were validated, so only a period too short for its ω² is left.
fn oscillator_problem(_: OscillatorError, period_s: f64) -> BuildingError {
    BuildingError::Period { period_s }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Row {
        alpha: f64,
        eigenvalues: [f64; 5],
        period_ratios: [f64; 4],
        participations: [f64; 5],
        at_mid_height: [f64; 5],
        masses: [f64; 5],
    }

    #[rustfmt::skip]
    // Computed with a Hermite finite-element model of 200–400 elements and the stable form of the shape.
    const TABLE: [Row; 10] = [
        Row { alpha: 0.0, eigenvalues: [1.87510, 4.69409, 7.85476, 10.99554, 14.13717],
            period_ratios: [0.15957, 0.05699, 0.02908, 0.01759], participations: [1.5660, -0.8679, 0.5089, -0.3638, 0.2829],
            at_mid_height: [0.5317, 0.6194, 0.0100, -0.2572, 0.0002], masses: [0.613, 0.188, 0.065, 0.033, 0.020] },
        Row { alpha: 1.0, eigenvalues: [1.90802, 4.71827, 7.86273, 10.99966, 14.13966],
            period_ratios: [0.18062, 0.06595, 0.03383, 0.02051], participations: [1.5524, -0.8530, 0.5073, -0.3634, 0.2828],
            at_mid_height: [0.5518, 0.6015, 0.0067, -0.2564, 0.0007], masses: [0.623, 0.180, 0.064, 0.033, 0.020] },
        Row { alpha: 2.0, eigenvalues: [1.94371, 4.78085, 7.88567, 11.01176, 14.14706],
            period_ratios: [0.21879, 0.08450, 0.04398, 0.02682], participations: [1.5164, -0.8132, 0.5024, -0.3621, 0.2823],
            at_mid_height: [0.6000, 0.5595, -0.0026, -0.2540, 0.0022], masses: [0.645, 0.160, 0.062, 0.032, 0.020] },
        Row { alpha: 5.0, eigenvalues: [1.86670, 4.98731, 8.00959, 11.08645, 14.19521],
            period_ratios: [0.28287, 0.13173, 0.07389, 0.04663], participations: [1.3943, -0.6634, 0.4668, -0.3512, 0.2782],
            at_mid_height: [0.7367, 0.4487, -0.0470, -0.2396, 0.0113], masses: [0.705, 0.115, 0.052, 0.029, 0.019] },
        Row { alpha: 10.0, eigenvalues: [1.73513, 5.04445, 8.17005, 11.24208, 14.32020],
            period_ratios: [0.31169, 0.16692, 0.10411, 0.07041], participations: [1.3147, -0.5295, 0.3858, -0.3122, 0.2599],
            at_mid_height: [0.8228, 0.3821, -0.1048, -0.2094, 0.0336], masses: [0.747, 0.096, 0.041, 0.024, 0.016] },
        Row { alpha: 20.0, eigenvalues: [1.65239, 4.93373, 8.16134, 11.33436, 14.46862],
            period_ratios: [0.32628, 0.18810, 0.12727, 0.09285], participations: [1.2846, -0.4569, 0.3043, -0.2435, 0.2097],
            at_mid_height: [0.8641, 0.3411, -0.1457, -0.1734, 0.0650], masses: [0.775, 0.090, 0.035, 0.019, 0.013] },
        Row { alpha: 30.0, eigenvalues: [1.62466, 4.86708, 8.09107, 11.29056, 14.46516],
            period_ratios: [0.32998, 0.19415, 0.13487, 0.10132], participations: [1.2784, -0.4395, 0.2788, -0.2139, 0.1798],
            at_mid_height: [0.8766, 0.3266, -0.1579, -0.1578, 0.0780], masses: [0.786, 0.089, 0.033, 0.018, 0.011] },
        Row { alpha: 50.0, eigenvalues: [1.60279, 4.80692, 8.00685, 11.20033, 14.38579],
            period_ratios: [0.33207, 0.19776, 0.13971, 0.10713], participations: [1.2751, -0.4300, 0.2638, -0.1944, 0.1572],
            at_mid_height: [0.8862, 0.3154, -0.1668, -0.1452, 0.0872], masses: [0.795, 0.089, 0.033, 0.017, 0.011] },
        Row { alpha: 100.0, eigenvalues: [1.58666, 4.75979, 7.93240, 11.10415, 14.27473],
            period_ratios: [0.33301, 0.19942, 0.14203, 0.11005], participations: [1.2737, -0.4258, 0.2570, -0.1851, 0.1456],
            at_mid_height: [0.8932, 0.3075, -0.1733, -0.1363, 0.0935], masses: [0.803, 0.089, 0.032, 0.017, 0.010] },
        Row { alpha: 650.0, eigenvalues: [1.57322, 4.71965, 7.86608, 11.01251, 14.15893],
            period_ratios: [0.33333, 0.19999, 0.14284, 0.11109], participations: [1.2733, -0.4244, 0.2547, -0.1820, 0.1416],
            at_mid_height: [0.8992, 0.3012, -0.1790, -0.1297, 0.0990], masses: [0.809, 0.090, 0.032, 0.017, 0.010] },
    ];

    #[test]
    fn modes_are_those_of_the_finite_element_model() {
        // Every tolerance is half a unit of the last printed digit.
        let near = |value: f64, want: f64, unit: f64, what: &str, alpha: f64| {
            assert!((value - want).abs() <= 0.5 * unit, "{what} at alpha {alpha}: {value}, table {want}");
        };
        for row in &TABLE {
            let building = Building::new(1.0, 0.05, row.alpha, 5).unwrap();
            for (i, mode) in building.modes().iter().enumerate() {
                near(mode.eigenvalue(), row.eigenvalues[i], 1e-5, "eigenvalue", row.alpha);
                near(mode.participation_ratio(), row.participations[i], 1e-4, "participation", row.alpha);
                let mid_height = mode.participation_ratio() * mode.shape_ratio(0.5);
                near(mid_height, row.at_mid_height[i], 1e-4, "at mid-height", row.alpha);
                near(mode.effective_mass_ratio(), row.masses[i], 1e-3, "effective mass", row.alpha);
                if i > 0 {
                    near(mode.period_s(), row.period_ratios[i - 1], 1e-5, "period ratio", row.alpha);
                }
            }
        }
    }

    #[test]
    fn closed_integrals_are_those_of_a_quadrature() {
        for alpha in [0.0, 0.3, 5.0, 30.0, 650.0] {
            let building = Building::new(1.0, 0.05, alpha, MAX_MODES).unwrap();
            for mode in building.modes() {
                // Simpson with 40 000 points: step h = 2.5e-5, error ≈ (βh)⁴/180 = 4e-10 at β = 650.
                let n = 40_000;
                let (mut area, mut square) = (0.0, 0.0);
                for k in 0..=n {
                    let weight = if k == 0 || k == n { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 } / (3.0 * n as f64);
                    let phi = mode.shape_ratio(k as f64 / n as f64);
                    area += weight * phi;
                    square += weight * phi * phi;
                }
                assert!((mode.participation_ratio() - area / square).abs() < 4e-9, "alpha {alpha}");
                assert!((mode.effective_mass_ratio() - area * area / square).abs() < 4e-9, "alpha {alpha}");
            }
        }
    }

    #[test]
    fn shapes_meet_the_boundary_conditions_for_every_alpha_and_mode() {
        for alpha in [0.0, 1e-8, 0.5, 3.0, 12.0, 80.0, 650.0, 3e4, 1e6, 1e12] {
            let building = Building::new(1.0, 0.05, alpha, MAX_MODES).unwrap();
            let mut shorter_than = f64::INFINITY;
            for mode in building.modes() {
                assert!(mode.period_s() > 0.0 && mode.period_s() < shorter_than, "alpha {alpha}");
                shorter_than = mode.period_s();
                // φ(0) as the formula gives it: four terms of order 1 to 2, and φ(1) is at least 0.7 of that.
                assert!((mode.shape.value(0.0) / mode.shape.roof).abs() < 1e-14, "alpha {alpha}");
                assert_eq!(mode.shape_ratio(1.0), 1.0);
                // Fixed at the ground: φ'(0) = γ − βQ + βP e^(−β) = 0, each term up to γ or ηβ ≈ γ.
                let Shape { gamma, beta, p, q, .. } = mode.shape;
                let slope = gamma - beta * q + beta * p * (-beta).exp();
                assert!(slope.abs() < 1e-14 * gamma, "alpha {alpha}: {slope}");
            }
            let mass: f64 = building.modes().iter().map(Mode::effective_mass_ratio).sum();
            // Missing are the modes beyond the fiftieth: Σ 2/((i − ½)π)² ≈ 2/(50π²) = 0.0041 for a shear beam, twice
            // that, 0.0081, for a flexural one; 50 closed integrals are good to 1e-12 together.
            assert!(mass < 1.0 + 1e-12 && mass > 1.0 - 0.0082, "alpha {alpha}: {mass}");
        }
    }

    fn shaking() -> Motion {
        Motion::new(0.01, (0..500).map(|k| (0.07 * k as f64).sin() * 2.0 + (0.9 * k as f64).cos()).collect()).unwrap()
    }

    #[test]
    fn the_ground_floor_is_the_ground_bit_for_bit() {
        let mut accel = shaking().accel_m_s2().to_vec();
        accel[7] = -0.0;
        let ground = Motion::new(0.01, accel).unwrap();
        let building = Building::new(2.0, 0.02, 5.0, 7).unwrap();
        let floor = floor_motion(&ground, &building, 0.0).unwrap();
        for (a, b) in floor.accel_m_s2().iter().zip(ground.accel_m_s2()) {
            assert_eq!(a.to_bits(), b.to_bits());
        }
    }

    #[test]
    fn levels_together_are_levels_one_by_one() {
        let building = Building::new(2.0, 0.02, 5.0, 7).unwrap();
        let levels_ratio = [1.0, 0.0, 0.5, 0.1];
        let together = floor_motions(&shaking(), &building, &levels_ratio).unwrap();
        for (motion, level_ratio) in together.iter().zip(levels_ratio) {
            assert_eq!(*motion, floor_motion(&shaking(), &building, level_ratio).unwrap());
        }
    }

    #[test]
    fn a_floor_of_a_rigid_building_moves_as_the_ground() {
        // T₁ = dt/1000: a mode lags the ground by 2ζT/(2π dt) ≤ 9.6e-5 of the change between samples, which is at most
        // 0.87 + 0.14 m/s² here; its own vibration is gone within a step. The shares of the modes add to below 1.2. The
        // first sample is apart: there the oscillators stand at rest.
        let building = Building::new(1e-5, 0.3, 5.0, 5).unwrap();
        let floor = floor_motion(&shaking(), &building, 0.7).unwrap();
        for (a, b) in floor.accel_m_s2().iter().zip(shaking().accel_m_s2()).skip(1) {
            assert!((a - b).abs() < 1.2e-4, "{a} {b}");
        }
    }

    #[test]
    fn what_is_not_a_building_is_refused() {
        let building = |period_s, damping, alpha, modes| Building::new(period_s, damping, alpha, modes).unwrap_err();
        assert!(matches!(building(0.0, 0.05, 5.0, 3), BuildingError::Period { .. }));
        assert!(matches!(building(1.0, 1.0, 5.0, 3), BuildingError::Damping { .. }));
        assert!(matches!(building(1.0, 0.05, -1.0, 3), BuildingError::ShearFlexure { .. }));
        assert!(matches!(building(1.0, 0.05, f64::INFINITY, 3), BuildingError::ShearFlexure { .. }));
        assert!(matches!(building(1.0, 0.05, 5.0, 0), BuildingError::Modes { modes: 0 }));
        assert!(matches!(building(1.0, 0.05, 5.0, 51), BuildingError::Modes { modes: 51 }));
        let fine = Building::new(1.0, 0.05, 5.0, 3).unwrap();
        for level_ratio in [-0.1, 1.1, f64::NAN] {
            assert!(matches!(floor_motion(&shaking(), &fine, level_ratio), Err(BuildingError::Level { .. })));
        }
    }
}
