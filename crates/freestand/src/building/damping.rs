//! Damping of the modes.

use super::BuildingError;
use std::f64::consts::TAU;

/// The damping of the modes of a building.
#[derive(Debug, Clone, PartialEq)]
pub enum Damping {
    /// One ratio for every mode.
    Uniform(f64),
    /// One ratio for each mode, in order of decreasing period.
    PerMode(Vec<f64>),
    /// Proportional to mass and stiffness, with the same ratio at two modes.
    Rayleigh {
        /// The ratio at both modes.
        damping_ratio: f64,
        /// The two modes, counted from 1.
        modes: [usize; 2],
    },
}

impl Damping {
    /// The ratio of each mode, for periods in decreasing order.
    ///
    /// # Errors
    /// A ratio outside 0 ≤ ζ < 1, also where Rayleigh damping overdamps a short mode; a number of
    /// ratios that differs from that of the modes; two modes that do not exist or have the same
    /// period.
    ///
    /// # Example
    /// Rayleigh damping of 5 % at modes 1 and 3, whose frequencies are in the ratio 1 : 4:
    /// a₁ = 0.1/5 and a₀ = 4 a₁ in units of the first frequency, so at twice the first frequency
    /// `ζ = (0.08/2 + 0.02·2)/2 = 0.04`.
    /// ```
    /// use freestand::building::Damping;
    /// let damping = Damping::Rayleigh { damping_ratio: 0.05, modes: [1, 3] };
    /// let ratios = damping.ratios(&[4.0, 2.0, 1.0])?;
    /// assert!((ratios[0] - 0.05).abs() < 1e-15 && (ratios[2] - 0.05).abs() < 1e-15);
    /// assert!((ratios[1] - 0.04).abs() < 1e-15);
    /// # Ok::<(), freestand::building::BuildingError>(())
    /// ```
    pub fn ratios(&self, periods_s: &[f64]) -> Result<Vec<f64>, BuildingError> {
        let is_one = |ratio: f64| (0.0..1.0).contains(&ratio);
        let ratios = match self {
            Self::Uniform(damping_ratio) | Self::Rayleigh { damping_ratio, .. }
                if !is_one(*damping_ratio) =>
            {
                return Err(BuildingError::Damping {
                    damping_ratio: *damping_ratio,
                });
            }
            Self::Uniform(damping_ratio) => vec![*damping_ratio; periods_s.len()],
            Self::PerMode(ratios) if ratios.len() != periods_s.len() => {
                return Err(BuildingError::DampingCount {
                    ratios: ratios.len(),
                    modes: periods_s.len(),
                });
            }
            Self::PerMode(ratios) => ratios.clone(),
            Self::Rayleigh {
                damping_ratio,
                modes: [first, second],
            } => {
                let period =
                    |mode: usize| mode.checked_sub(1).and_then(|i| periods_s.get(i)).copied();
                let wrong = BuildingError::RayleighModes {
                    first: *first,
                    second: *second,
                    modes: periods_s.len(),
                };
                let (Some(one), Some(other)) = (period(*first), period(*second)) else {
                    return Err(wrong);
                };
                if one == other {
                    return Err(wrong);
                }
                let rayleigh = Rayleigh::through(one, other, *damping_ratio);
                periods_s
                    .iter()
                    .map(|&period_s| rayleigh.damping_ratio(period_s))
                    .collect()
            }
        };
        match ratios.iter().position(|&ratio| !is_one(ratio)) {
            Some(index) => Err(BuildingError::ModeDamping {
                mode: index + 1,
                damping_ratio: ratios[index],
            }),
            None => Ok(ratios),
        }
    }
}

/// Damping proportional to mass and stiffness, `C = a₀ M + a₁ K`, so that `ζ(ω) = a₀/(2ω) + a₁ω/2`.
///
/// # Reference
/// Chopra, Dynamics of Structures, Rayleigh damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rayleigh {
    /// a₀ \[1/s\].
    pub mass_factor_per_s: f64,
    /// a₁ \[s\].
    pub stiffness_factor_s: f64,
}

impl Rayleigh {
    /// The same `damping_ratio` at two different periods: `a₀ = 2ζω₁ω₂/(ω₁ + ω₂)`,
    /// `a₁ = 2ζ/(ω₁ + ω₂)`.
    ///
    /// # Example
    /// At 1 and 3 rad/s, 10 %: a₀ = 0.15 1/s, a₁ = 0.05 s.
    /// ```
    /// use freestand::building::Rayleigh;
    /// use std::f64::consts::TAU;
    /// let rayleigh = Rayleigh::through(TAU, TAU / 3.0, 0.1);
    /// assert!((rayleigh.mass_factor_per_s - 0.15).abs() < 1e-15);
    /// assert!((rayleigh.stiffness_factor_s - 0.05).abs() < 1e-15);
    /// ```
    pub fn through(period_s: f64, other_period_s: f64, damping_ratio: f64) -> Self {
        let (one, other) = (TAU / period_s, TAU / other_period_s);
        let stiffness_factor_s = 2.0 * damping_ratio / (one + other);
        Self {
            mass_factor_per_s: stiffness_factor_s * one * other,
            stiffness_factor_s,
        }
    }

    /// ζ at a period.
    pub fn damping_ratio(&self, period_s: f64) -> f64 {
        let omega = TAU / period_s;
        0.5 * (self.mass_factor_per_s / omega + self.stiffness_factor_s * omega)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rayleigh_damping_is_least_between_its_two_modes() {
        // The smallest ratio is at √(ω₁ω₂): ζ·2√(ω₁ω₂)/(ω₁ + ω₂) = 0.05·2·3/10 for ω as 1 to 9.
        let rayleigh = Rayleigh::through(9.0, 1.0, 0.05);
        assert!((rayleigh.damping_ratio(3.0) - 0.03).abs() < 1e-16);
        assert!(rayleigh.damping_ratio(2.9) > 0.03 && rayleigh.damping_ratio(3.1) > 0.03);
    }

    #[test]
    fn what_is_no_damping_is_refused() {
        let ratios = |damping: Damping| damping.ratios(&[2.0, 1.0, 1.0, 0.001]).unwrap_err();
        let rayleigh = |damping_ratio, modes| Damping::Rayleigh {
            damping_ratio,
            modes,
        };
        assert!(matches!(
            ratios(Damping::Uniform(1.0)),
            BuildingError::Damping { .. }
        ));
        assert!(matches!(
            ratios(Damping::Uniform(f64::NAN)),
            BuildingError::Damping { .. }
        ));
        assert!(matches!(
            ratios(rayleigh(-0.1, [1, 2])),
            BuildingError::Damping { .. }
        ));
        assert!(matches!(
            ratios(Damping::PerMode(vec![0.1])),
            BuildingError::DampingCount {
                ratios: 1,
                modes: 4
            }
        ));
        let one_bad = Damping::PerMode(vec![0.1, 0.1, f64::INFINITY, 0.1]);
        assert!(matches!(
            ratios(one_bad),
            BuildingError::ModeDamping { mode: 3, .. }
        ));
        for modes in [[1, 1], [0, 1], [1, 5], [2, 3]] {
            assert!(
                matches!(
                    ratios(rayleigh(0.05, modes)),
                    BuildingError::RayleighModes { modes: 4, .. }
                ),
                "{modes:?}"
            );
        }
        // Mode 4 has 1000 times the frequency of mode 2: ζ ≈ 0.05·1000·2/3.
        assert!(matches!(
            ratios(rayleigh(0.05, [1, 2])),
            BuildingError::ModeDamping { mode: 4, .. }
        ));
    }
}
