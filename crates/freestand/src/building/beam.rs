//! A uniform shear beam coupled with a flexural beam.
//!
//! `α = H √(GA/EI)` is 0 for a flexural cantilever (walls), 1–5 for dual systems, 5–20 for frames
//! with walls, and 30 or more for nearly a shear beam (frames). These ranges are customary, quoted
//! from memory, and not from a code.

use super::{Building, BuildingError, MAX_MODES, Mode, ModeShape, Model, check_period};
use std::f64::consts::PI;

impl Building {
    /// A uniform shear-flexure beam of fundamental period `period_s` with `modes` modes.
    ///
    /// `shear_flexure_ratio` is `α = H √(GA/EI)`. Periods of the modes: `T_i/T₁ = γ₁β₁/(γ_iβ_i)`,
    /// `β² = γ² + α²`, with γ the roots of
    /// `2 + (2 + α⁴/(γ²β²)) cos γ cosh β + α²/(γβ) sin γ sinh β = 0`.
    ///
    /// # Reference
    /// Miranda and Taghavi (2005), "Approximate floor acceleration demands in multistory buildings.
    /// I: Formulation", J. Struct. Eng. 131(2).
    ///
    /// # Accuracy
    /// Eigenvalues to the last digits for every α from 0 to beyond 10⁶; participation by closed
    /// integrals. No root can be missed: each interval ((i−1)π, iπ) contains exactly one.
    ///
    /// # Limitation
    /// Linear; uniform over the height (the higher periods of a building that is much softer at its
    /// top are longer); no torsion, no soil-structure interaction; one damping ratio for all modes
    /// (for others see [`Building::with_damping`]).
    ///
    /// # Errors
    /// A period that is not positive and finite, damping outside 0 ≤ ζ < 1, a negative or
    /// non-finite α, no modes or more than [`MAX_MODES`].
    ///
    /// # Example
    /// The periods of a shear beam are in the ratio 1 : 1/3 : 1/5, and the participation factor of
    /// its first mode is 4/π. With α = 10⁶ the beam is nearly a shear beam:
    /// ```
    /// let building = freestand::building::Building::beam(2.0, 0.05, 1e6, 3)?;
    /// let [first, second, third] = building.modes() else { unreachable!() };
    /// assert!((second.period_s() - 2.0 / 3.0).abs() < 1e-5);
    /// assert!((third.period_s() - 2.0 / 5.0).abs() < 1e-5);
    /// assert!((first.participation_ratio() - 4.0 / std::f64::consts::PI).abs() < 1e-5);
    /// # Ok::<(), freestand::building::BuildingError>(())
    /// ```
    pub fn beam(
        period_s: f64,
        damping_ratio: f64,
        shear_flexure_ratio: f64,
        modes: usize,
    ) -> Result<Self, BuildingError> {
        check_period(period_s)?;
        if !(0.0..1.0).contains(&damping_ratio) {
            return Err(BuildingError::Damping { damping_ratio });
        }
        if !(shear_flexure_ratio >= 0.0 && shear_flexure_ratio.is_finite()) {
            return Err(BuildingError::ShearFlexure {
                shear_flexure_ratio,
            });
        }
        if !(1..=MAX_MODES).contains(&modes) {
            return Err(BuildingError::Modes {
                modes,
                at_most: MAX_MODES,
            });
        }
        let alpha = shear_flexure_ratio;
        let first = eigenvalue(alpha, 1);
        let modes = (1..=modes)
            .map(|i| mode(period_s, damping_ratio, alpha, first, eigenvalue(alpha, i)))
            .collect();
        Ok(Self {
            model: Model::Beam {
                shear_flexure_ratio,
            },
            modes,
            floors_ratio: Vec::new(),
        })
    }
}

fn mode(period_s: f64, damping_ratio: f64, alpha: f64, first: f64, gamma: f64) -> Mode {
    let shape = BeamShape::new(alpha, gamma);
    let (area, square) = (shape.integral(), shape.integral_of_square());
    Mode {
        // Ratio by ratio, so that a large α does not overflow.
        period_s: period_s * (first / gamma) * (first.hypot(alpha) / gamma.hypot(alpha)),
        damping_ratio,
        participation_ratio: shape.roof * area / square,
        effective_mass_ratio: Some(area * area / square),
        shape: ModeShape::Beam(shape),
    }
}

/// The `number`-th eigenvalue (from 1), by bisection of ((number − 1)π, number·π).
///
/// There is exactly one root in the interval, for any α: divided by cosh β, the characteristic
/// function at γ = iπ is `2/cosh β + (−1)^i (2 + q²)`, which has the sign (−1)^i, so there is at
/// least one. For α = 0 there is exactly one (cos γ = −1/cosh γ), the eigenvalues change
/// continuously with α, and none can pass through iπ.
fn eigenvalue(alpha: f64, number: usize) -> f64 {
    let (mut low, mut high) = ((number - 1) as f64 * PI, number as f64 * PI);
    let positive_below = number % 2 == 1;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if (characteristic(alpha, middle) > 0.0) == positive_below {
            low = middle
        } else {
            high = middle
        }
    }
}

/// The characteristic function divided by cosh β, so that it does not overflow; q = α²/(γβ).
fn characteristic(alpha: f64, gamma: f64) -> f64 {
    let beta = gamma.hypot(alpha);
    let q = (alpha / gamma) * (alpha / beta);
    2.0 / beta.cosh() + (2.0 + q * q) * gamma.cos() + q * gamma.sin() * beta.tanh()
}

/// Shape of a mode of a uniform shear-flexure beam.
///
/// `sin γx − η cos γx + P e^(β(x−1)) + Q e^(−βx)`: the sinh and cosh of the textbook form, combined
/// so that the growing parts, which cancel, never arise (in the textbook form they cause an error
/// of 1 % in Γ at α = 30).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamShape {
    gamma: f64,
    beta: f64,
    eta: f64,
    p: f64,
    q: f64,
    roof: f64,
}

impl BeamShape {
    fn new(alpha: f64, gamma: f64) -> Self {
        let beta = gamma.hypot(alpha);
        let r = gamma / beta;
        let (sin, cos) = gamma.sin_cos();
        let e = (-beta).exp();
        let denominator = 0.5 * (1.0 + e * e) + r * r * cos * e;
        let eta = (r * r * sin * e + 0.5 * r * (1.0 - e * e)) / denominator;
        let p = 0.5 * r * (r * sin - r * r * cos - e) / denominator;
        let mut shape = Self {
            gamma,
            beta,
            eta,
            p,
            q: 0.5 * (eta + r),
            roof: 1.0,
        };
        shape.roof = shape.raw(1.0);
        shape
    }

    /// γ.
    pub(super) fn eigenvalue(&self) -> f64 {
        self.gamma
    }

    /// 1 at the roof.
    pub(super) fn value(&self, x: f64) -> f64 {
        self.raw(x) / self.roof
    }

    fn raw(&self, x: f64) -> f64 {
        let (sin, cos) = (self.gamma * x).sin_cos();
        sin - self.eta * cos
            + self.p * (self.beta * (x - 1.0)).exp()
            + self.q * (-self.beta * x).exp()
    }

    /// ∫φ dx over the height.
    fn integral(&self) -> f64 {
        let (sin, cos) = self.gamma.sin_cos();
        (1.0 - cos - self.eta * sin) / self.gamma
            + (self.p + self.q) * -(-self.beta).exp_m1() / self.beta
    }

    /// ∫φ² dx over the height: the ten products of the four terms, each in closed form.
    fn integral_of_square(&self) -> f64 {
        let Self {
            gamma,
            beta,
            eta,
            p,
            q,
            ..
        } = *self;
        let (sin, cos) = gamma.sin_cos();
        let e = (-beta).exp();
        let r = gamma / beta;
        let scale = 1.0 / (beta * (1.0 + r * r));
        let swing = sin * cos / (2.0 * gamma);
        let (sin_sin, cos_cos, sin_cos) = (0.5 - swing, 0.5 + swing, sin * sin / (2.0 * gamma));
        let (grow_grow, grow_fall) = (-(-2.0 * beta).exp_m1() / (2.0 * beta), e);
        let (grow_sin, grow_cos) = ((sin - r * cos + r * e) * scale, (cos + r * sin - e) * scale);
        let (fall_sin, fall_cos) = (
            (r - e * (sin + r * cos)) * scale,
            (1.0 + e * (r * sin - cos)) * scale,
        );
        sin_sin + eta * eta * cos_cos - 2.0 * eta * sin_cos
            + (p * p + q * q) * grow_grow
            + 2.0 * p * q * grow_fall
            + 2.0 * p * (grow_sin - eta * grow_cos)
            + 2.0 * q * (fall_sin - eta * fall_cos)
    }
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
    // From a Hermite finite-element model of 200–400 elements and the stable form of the shape.
    const TABLE: [Row; 10] = [
        Row { alpha: 0.0, eigenvalues: [1.87510, 4.69409, 7.85476, 10.99554, 14.13717],
            period_ratios: [0.15957, 0.05699, 0.02908, 0.01759],
            participations: [1.5660, -0.8679, 0.5089, -0.3638, 0.2829],
            at_mid_height: [0.5317, 0.6194, 0.0100, -0.2572, 0.0002], masses: [0.613, 0.188, 0.065, 0.033, 0.020] },
        Row { alpha: 1.0, eigenvalues: [1.90802, 4.71827, 7.86273, 10.99966, 14.13966],
            period_ratios: [0.18062, 0.06595, 0.03383, 0.02051],
            participations: [1.5524, -0.8530, 0.5073, -0.3634, 0.2828],
            at_mid_height: [0.5518, 0.6015, 0.0067, -0.2564, 0.0007], masses: [0.623, 0.180, 0.064, 0.033, 0.020] },
        Row { alpha: 2.0, eigenvalues: [1.94371, 4.78085, 7.88567, 11.01176, 14.14706],
            period_ratios: [0.21879, 0.08450, 0.04398, 0.02682],
            participations: [1.5164, -0.8132, 0.5024, -0.3621, 0.2823],
            at_mid_height: [0.6000, 0.5595, -0.0026, -0.2540, 0.0022], masses: [0.645, 0.160, 0.062, 0.032, 0.020] },
        Row { alpha: 5.0, eigenvalues: [1.86670, 4.98731, 8.00959, 11.08645, 14.19521],
            period_ratios: [0.28287, 0.13173, 0.07389, 0.04663],
            participations: [1.3943, -0.6634, 0.4668, -0.3512, 0.2782],
            at_mid_height: [0.7367, 0.4487, -0.0470, -0.2396, 0.0113], masses: [0.705, 0.115, 0.052, 0.029, 0.019] },
        Row { alpha: 10.0, eigenvalues: [1.73513, 5.04445, 8.17005, 11.24208, 14.32020],
            period_ratios: [0.31169, 0.16692, 0.10411, 0.07041],
            participations: [1.3147, -0.5295, 0.3858, -0.3122, 0.2599],
            at_mid_height: [0.8228, 0.3821, -0.1048, -0.2094, 0.0336], masses: [0.747, 0.096, 0.041, 0.024, 0.016] },
        Row { alpha: 20.0, eigenvalues: [1.65239, 4.93373, 8.16134, 11.33436, 14.46862],
            period_ratios: [0.32628, 0.18810, 0.12727, 0.09285],
            participations: [1.2846, -0.4569, 0.3043, -0.2435, 0.2097],
            at_mid_height: [0.8641, 0.3411, -0.1457, -0.1734, 0.0650], masses: [0.775, 0.090, 0.035, 0.019, 0.013] },
        Row { alpha: 30.0, eigenvalues: [1.62466, 4.86708, 8.09107, 11.29056, 14.46516],
            period_ratios: [0.32998, 0.19415, 0.13487, 0.10132],
            participations: [1.2784, -0.4395, 0.2788, -0.2139, 0.1798],
            at_mid_height: [0.8766, 0.3266, -0.1579, -0.1578, 0.0780], masses: [0.786, 0.089, 0.033, 0.018, 0.011] },
        Row { alpha: 50.0, eigenvalues: [1.60279, 4.80692, 8.00685, 11.20033, 14.38579],
            period_ratios: [0.33207, 0.19776, 0.13971, 0.10713],
            participations: [1.2751, -0.4300, 0.2638, -0.1944, 0.1572],
            at_mid_height: [0.8862, 0.3154, -0.1668, -0.1452, 0.0872], masses: [0.795, 0.089, 0.033, 0.017, 0.011] },
        Row { alpha: 100.0, eigenvalues: [1.58666, 4.75979, 7.93240, 11.10415, 14.27473],
            period_ratios: [0.33301, 0.19942, 0.14203, 0.11005],
            participations: [1.2737, -0.4258, 0.2570, -0.1851, 0.1456],
            at_mid_height: [0.8932, 0.3075, -0.1733, -0.1363, 0.0935], masses: [0.803, 0.089, 0.032, 0.017, 0.010] },
        Row { alpha: 650.0, eigenvalues: [1.57322, 4.71965, 7.86608, 11.01251, 14.15893],
            period_ratios: [0.33333, 0.19999, 0.14284, 0.11109],
            participations: [1.2733, -0.4244, 0.2547, -0.1820, 0.1416],
            at_mid_height: [0.8992, 0.3012, -0.1790, -0.1297, 0.0990], masses: [0.809, 0.090, 0.032, 0.017, 0.010] },
    ];

    #[test]
    fn modes_are_those_of_the_finite_element_model() {
        // Every tolerance is half a unit of the last printed digit.
        let near = |value: f64, want: f64, unit: f64, what: &str, alpha: f64| {
            assert!(
                (value - want).abs() <= 0.5 * unit,
                "{what} at alpha {alpha}: {value}, table {want}"
            );
        };
        for row in &TABLE {
            let building = Building::beam(1.0, 0.05, row.alpha, 5).unwrap();
            for (i, mode) in building.modes().iter().enumerate() {
                near(
                    mode.eigenvalue().unwrap(),
                    row.eigenvalues[i],
                    1e-5,
                    "eigenvalue",
                    row.alpha,
                );
                near(
                    mode.participation_ratio(),
                    row.participations[i],
                    1e-4,
                    "participation",
                    row.alpha,
                );
                let mid_height = mode.participation_ratio() * mode.shape_ratio(0.5);
                near(
                    mid_height,
                    row.at_mid_height[i],
                    1e-4,
                    "at mid-height",
                    row.alpha,
                );
                near(
                    mode.effective_mass_ratio().unwrap(),
                    row.masses[i],
                    1e-3,
                    "effective mass",
                    row.alpha,
                );
                if i > 0 {
                    near(
                        mode.period_s(),
                        row.period_ratios[i - 1],
                        1e-5,
                        "period ratio",
                        row.alpha,
                    );
                }
            }
        }
    }

    #[test]
    fn closed_integrals_are_those_of_a_quadrature() {
        for alpha in [0.0, 0.3, 5.0, 30.0, 650.0] {
            let building = Building::beam(1.0, 0.05, alpha, MAX_MODES).unwrap();
            for mode in building.modes() {
                // Simpson with 40 000 points: step h = 2.5e-5, error ≈ (βh)⁴/180 = 4e-10 at β =
                // 650.
                let n = 40_000;
                let (mut area, mut square) = (0.0, 0.0);
                for k in 0..=n {
                    let weight = if k == 0 || k == n {
                        1.0
                    } else {
                        2.0 + 2.0 * (k % 2) as f64
                    } / (3.0 * n as f64);
                    let phi = mode.shape_ratio(k as f64 / n as f64);
                    area += weight * phi;
                    square += weight * phi * phi;
                }
                assert!(
                    (mode.participation_ratio() - area / square).abs() < 4e-9,
                    "alpha {alpha}"
                );
                assert!(
                    (mode.effective_mass_ratio().unwrap() - area * area / square).abs() < 4e-9,
                    "alpha {alpha}"
                );
            }
        }
    }

    #[test]
    fn shapes_meet_the_boundary_conditions_for_every_alpha_and_mode() {
        for alpha in [0.0, 1e-8, 0.5, 3.0, 12.0, 80.0, 650.0, 3e4, 1e6, 1e12] {
            let building = Building::beam(1.0, 0.05, alpha, MAX_MODES).unwrap();
            let mut shorter_than = f64::INFINITY;
            for mode in building.modes() {
                let ModeShape::Beam(shape) = mode.shape() else {
                    unreachable!()
                };
                assert!(
                    mode.period_s() > 0.0 && mode.period_s() < shorter_than,
                    "alpha {alpha}"
                );
                shorter_than = mode.period_s();
                // φ(0) from the formula: four terms of order 1 to 2, and φ(1) is at least 0.7 of
                // that.
                assert!(shape.value(0.0).abs() < 1e-14, "alpha {alpha}");
                assert_eq!(mode.shape_ratio(1.0), 1.0);
                // Fixed at the ground: φ'(0) = γ − βQ + βP e^(−β) = 0, each term up to γ or ηβ ≈ γ.
                let BeamShape {
                    gamma, beta, p, q, ..
                } = *shape;
                let slope = gamma - beta * q + beta * p * (-beta).exp();
                assert!(slope.abs() < 1e-14 * gamma, "alpha {alpha}: {slope}");
            }
            let mass: f64 = building
                .modes()
                .iter()
                .filter_map(Mode::effective_mass_ratio)
                .sum();
            // The modes beyond the fiftieth are missing: Σ 2/((i − ½)π)² ≈ 2/(50π²) = 0.0041 for a
            // shear beam, twice that, 0.0081, for a flexural one; 50 closed integrals are accurate
            // to 1e-12 together.
            assert!(
                mass < 1.0 + 1e-12 && mass > 1.0 - 0.0082,
                "alpha {alpha}: {mass}"
            );
        }
    }

    #[test]
    fn what_is_not_a_building_is_refused() {
        let building = |period_s, damping, alpha, modes| {
            Building::beam(period_s, damping, alpha, modes).unwrap_err()
        };
        assert!(matches!(
            building(0.0, 0.05, 5.0, 3),
            BuildingError::Period { .. }
        ));
        assert!(matches!(
            building(1.0, 1.0, 5.0, 3),
            BuildingError::Damping { .. }
        ));
        assert!(matches!(
            building(1.0, 0.05, -1.0, 3),
            BuildingError::ShearFlexure { .. }
        ));
        assert!(matches!(
            building(1.0, 0.05, f64::INFINITY, 3),
            BuildingError::ShearFlexure { .. }
        ));
        assert!(matches!(
            building(1.0, 0.05, 5.0, 0),
            BuildingError::Modes { modes: 0, .. }
        ));
        assert!(matches!(
            building(1.0, 0.05, 5.0, 51),
            BuildingError::Modes {
                modes: 51,
                at_most: 50
            }
        ));
    }
}
