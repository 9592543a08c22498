//! Cushion curves for packaging: peak acceleration against static stress, reduced to one
//! stress–energy curve.
//!
//! For drops of a mass m from a height h on an area A of a cushion of thickness t, the dynamic
//! stress σ = G s (G the peak acceleration in g, s = mg/A the static stress) depends only on the
//! energy per volume E = s h/t. With σ = a exp(bE): G = (a/s) exp(b s h/t), smallest at s* = t/(b
//! h), where G = a b e h/t.

use thiserror::Error;

/// σ = a exp(b E): one curve for all drop heights, thicknesses and loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressEnergy {
    /// Stress a at zero energy \[Pa\].
    pub stress_pa: f64,
    /// Exponent b \[m³/J\].
    pub exponent_m3_j: f64,
}

/// A drop of a mass on a cushion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CushionTest {
    /// s = mg/A \[Pa\].
    pub static_stress_pa: f64,
    /// h \[m\].
    pub drop_height_m: f64,
    /// t \[m\].
    pub thickness_m: f64,
    /// G \[g\].
    pub peak_acceleration_g: f64,
}

impl CushionTest {
    /// E = s h/t \[J/m³\].
    pub fn energy_j_m3(&self) -> f64 {
        self.static_stress_pa * self.drop_height_m / self.thickness_m
    }

    /// Whether every value is positive.
    pub fn is_positive(&self) -> bool {
        let Self {
            static_stress_pa,
            drop_height_m,
            thickness_m,
            peak_acceleration_g,
        } = *self;
        [
            static_stress_pa,
            drop_height_m,
            thickness_m,
            peak_acceleration_g,
        ]
        .iter()
        .all(|&size| size > 0.0 && size.is_finite())
    }
}

/// A [`StressEnergy`] from tests, and how well it describes them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressEnergyFit {
    /// The curve.
    pub curve: StressEnergy,
    /// R² of ln σ against E.
    pub r_squared_ratio: f64,
    /// Smallest and largest energy per volume among the tests \[J/m³\]; outside this range the
    /// curve is an extrapolation.
    pub energies_j_m3: (f64, f64),
    /// Number of tests.
    pub tests: usize,
}

/// Why a curve cannot be fitted to tests.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CurveError {
    /// Too few tests: two parameters need more than two tests.
    #[error("a stress-energy curve needs at least 3 tests of the cushion, not {tests}")]
    TooFew {
        /// Number of tests.
        tests: usize,
    },
    /// A test with a value that is not positive.
    #[error(
        "test {number}: static stress, drop height, thickness and peak acceleration must be positive"
    )]
    NotPositive {
        /// The test, from 1.
        number: usize,
    },
    /// All tests have the same energy.
    #[error("all tests have the same energy per volume, so they do not define a curve")]
    OneEnergy,
    /// The stress does not grow with the energy.
    #[error("the dynamic stress does not grow with the energy (b = {exponent_m3_j} m³/J)")]
    Falling {
        /// Exponent b of the fit \[m³/J\].
        exponent_m3_j: f64,
    },
}

impl StressEnergy {
    /// Least squares on ln σ = ln a + b E over tests.
    ///
    /// # Reference
    /// ASTM D1596 for the tests; Burgess (1990), Consolidation of cushion curves, for the
    /// reduction.
    ///
    /// # Errors
    /// Fewer than 3 tests, a test with a value that is not positive, tests of equal energy, or a
    /// stress that does not grow with the energy.
    pub fn fitted(tests: &[CushionTest]) -> Result<StressEnergyFit, CurveError> {
        if tests.len() < 3 {
            return Err(CurveError::TooFew { tests: tests.len() });
        }
        if let Some(index) = tests.iter().position(|test| !test.is_positive()) {
            return Err(CurveError::NotPositive { number: index + 1 });
        }
        let points: Vec<(f64, f64)> = tests
            .iter()
            .map(|test| {
                let stress_pa = test.peak_acceleration_g * test.static_stress_pa;
                (test.energy_j_m3(), stress_pa.ln())
            })
            .collect();
        let count = points.len() as f64;
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
        let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
        let (xx, yy) = (mean(&|p| (p.0 - x).powi(2)), mean(&|p| (p.1 - y).powi(2)));
        let xy = mean(&|p| (p.0 - x) * (p.1 - y));
        if xx <= (1e-9 * x).powi(2) {
            return Err(CurveError::OneEnergy);
        }
        let exponent_m3_j = xy / xx;
        if exponent_m3_j <= 0.0 {
            return Err(CurveError::Falling { exponent_m3_j });
        }
        let least = points.iter().map(|p| p.0).fold(f64::INFINITY, f64::min);
        let most = points.iter().map(|p| p.0).fold(0.0, f64::max);
        Ok(StressEnergyFit {
            curve: Self {
                stress_pa: (y - exponent_m3_j * x).exp(),
                exponent_m3_j,
            },
            r_squared_ratio: if yy > 0.0 { xy * xy / (xx * yy) } else { 1.0 },
            energies_j_m3: (least, most),
            tests: points.len(),
        })
    }

    /// G = (a/s) exp(b s h/t): peak acceleration of a drop \[g\].
    ///
    /// # Example
    /// a = 100 kPa, b = 2e-5 m³/J, from 100 mm on 20 mm, at the best static stress of 10 kPa:
    /// 27.18 g.
    /// ```
    /// use freestand::cushion::StressEnergy;
    /// let foam = StressEnergy { stress_pa: 1e5, exponent_m3_j: 2e-5 };
    /// let best = foam.best_static_stress_pa(0.1, 0.02);
    /// assert!((best - 10e3).abs() < 1e-9);
    /// assert!((foam.peak_acceleration_g(best, 0.1, 0.02) - 27.1828).abs() < 1e-4);
    /// ```
    pub fn peak_acceleration_g(
        &self,
        static_stress_pa: f64,
        drop_height_m: f64,
        thickness_m: f64,
    ) -> f64 {
        let energy_j_m3 = static_stress_pa * drop_height_m / thickness_m;
        self.stress_pa / static_stress_pa * (self.exponent_m3_j * energy_j_m3).exp()
    }

    /// s* = t/(b h): the static stress at which the peak acceleration is smallest \[Pa\].
    pub fn best_static_stress_pa(&self, drop_height_m: f64, thickness_m: f64) -> f64 {
        thickness_m / (self.exponent_m3_j * drop_height_m)
    }

    /// The smallest thickness that keeps the peak at or below `limit_g` at a given static stress:
    /// t = b s h/ln(G s/a) \[m\]. `None` where G s ≤ a: no thickness is enough, because the load is
    /// too light for this cushion (use a smaller area).
    pub fn thickness_m(
        &self,
        static_stress_pa: f64,
        drop_height_m: f64,
        limit_g: f64,
    ) -> Option<f64> {
        let growth = (limit_g * static_stress_pa / self.stress_pa).ln();
        (growth > 0.0).then(|| self.exponent_m3_j * static_stress_pa * drop_height_m / growth)
    }

    /// The optimum thickness, the smallest that any static stress allows: t = a b e h/G \[m\], at
    /// s = t/(b h) = a e/G (compare [`StressEnergy::best_static_stress_pa`]).
    pub fn optimum_thickness_m(&self, drop_height_m: f64, limit_g: f64) -> f64 {
        self.stress_pa * self.exponent_m3_j * std::f64::consts::E * drop_height_m / limit_g
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOAM: StressEnergy = StressEnergy {
        stress_pa: 80e3,
        exponent_m3_j: 1.7e-5,
    };

    fn tests_of(foam: StressEnergy) -> Vec<CushionTest> {
        let mut tests = Vec::new();
        for (h, t) in [(0.3, 0.05), (0.6, 0.05), (0.6, 0.1)] {
            for s in [2e3, 4e3, 7e3] {
                tests.push(CushionTest {
                    static_stress_pa: s,
                    drop_height_m: h,
                    thickness_m: t,
                    peak_acceleration_g: foam.peak_acceleration_g(s, h, t),
                });
            }
        }
        tests
    }

    /// Tests without noise lie on one line; only rounding remains.
    #[test]
    fn the_curve_comes_back_from_its_own_tests() {
        let fit = StressEnergy::fitted(&tests_of(FOAM)).unwrap();
        assert!((fit.curve.stress_pa / FOAM.stress_pa - 1.0).abs() < 1e-12);
        assert!((fit.curve.exponent_m3_j / FOAM.exponent_m3_j - 1.0).abs() < 1e-12);
        assert!((fit.r_squared_ratio - 1.0).abs() < 1e-12);
        assert_eq!((fit.tests, fit.energies_j_m3), (9, (12e3, 84e3)));
    }

    #[test]
    fn the_thickness_is_the_one_that_gives_the_limit() {
        let t = FOAM.thickness_m(5e3, 0.6, 40.0).unwrap();
        assert!((FOAM.peak_acceleration_g(5e3, 0.6, t) / 40.0 - 1.0).abs() < 1e-12);
        assert_eq!(FOAM.thickness_m(1e3, 0.6, 40.0), None);
        let best = FOAM.optimum_thickness_m(0.6, 40.0);
        let s = FOAM.best_static_stress_pa(0.6, best);
        assert!((FOAM.peak_acceleration_g(s, 0.6, best) / 40.0 - 1.0).abs() < 1e-12);
        for other in [0.8 * s, 1.25 * s] {
            assert!(FOAM.thickness_m(other, 0.6, 40.0).unwrap() > best);
        }
    }

    #[test]
    fn tests_that_give_no_curve_are_refused() {
        let tests = tests_of(FOAM);
        assert_eq!(
            StressEnergy::fitted(&tests[..2]),
            Err(CurveError::TooFew { tests: 2 })
        );
        let same = vec![tests[0]; 4];
        assert_eq!(StressEnergy::fitted(&same), Err(CurveError::OneEnergy));
        let mut bad = tests.clone();
        bad[3].thickness_m = 0.0;
        assert_eq!(
            StressEnergy::fitted(&bad),
            Err(CurveError::NotPositive { number: 4 })
        );
        let falling: Vec<_> = tests
            .iter()
            .map(|test| CushionTest {
                peak_acceleration_g: 1.0 / test.energy_j_m3(),
                ..*test
            })
            .collect();
        assert!(matches!(
            StressEnergy::fitted(&falling),
            Err(CurveError::Falling { .. })
        ));
    }
}
