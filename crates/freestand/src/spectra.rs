//! Uplift spectra and the shock spectra that follow from them.
//!
//! The rocking response of an object depends on its geometry, its restitution and the motion. Mass
//! and stiffness enter only afterwards, so one uplift spectrum gives the shock for any of them.

use crate::G0_M_S2;
use crate::block::Block;
use crate::cushion::Cushion;
use crate::impact::{ImpactModel, Landing};
use crate::respond::{RigidPlane, Settings, on_rigid_bases};
use crate::rocking::{Base, Outcome, RockingError, RockingSummary, SideExtremes};

/// Relative change of the motion in the test for sensitivity.
pub const PERTURBATION_RATIO: f64 = 1e-6;

/// Amplification above which a cell is sensitive: its peak rotation changes by more than 1e-5 of
/// its value when the motion changes by [`PERTURBATION_RATIO`].
pub const SENSITIVE_RATIO: f64 = 10.0;

/// Amplification, in the rotations and impacts before an object overturns, above which it is in
/// doubt whether it does: an error of 1e-6 in the motion has grown to 0.1 %.
pub const DOUBTFUL_RATIO: f64 = 1000.0;

/// One cell of an uplift spectrum: an object and its response to a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpliftCell {
    /// The object.
    pub block: Block,
    /// Its response.
    pub rocking: RockingSummary,
}

/// The shock of an [`UpliftCell`] for a given mass and cushion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShockCell {
    /// a_edge from the largest rise of the centre of gravity (the paper's source); `None` for
    /// overturned objects \[g\].
    pub edge_acceleration_g: Option<f64>,
    /// a_edge from the largest velocity before an impact; `None` for overturned objects \[g\].
    pub edge_acceleration_impact_velocity_g: Option<f64>,
    /// The `uplift` shock at the balance point: no motion can cause more without overturning \[g\].
    pub ceiling_g: f64,
}

/// A shock above this comes from a law far beyond its bottoming compression and says nothing about
/// an object \[g\].
pub const BEYOND_ALL_G: f64 = 1e6;

impl ShockCell {
    /// Whether the cushion bottoms so strongly that the shock of an object that does not overturn
    /// is unreliable.
    pub fn is_beyond_numbers(&self) -> bool {
        let shocks = [
            self.edge_acceleration_g,
            self.edge_acceleration_impact_velocity_g,
        ];
        shocks
            .iter()
            .flatten()
            .any(|shock_g| shock_g.is_nan() || *shock_g > BEYOND_ALL_G)
    }
}

/// The effect of a small error of the motion on an [`UpliftCell`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// Amplification of the error: relative change of the peak rotation divided by the relative
    /// change of the motion. `None` where no two peaks can be compared: no uplift, overturned, or
    /// another outcome under the changed motion.
    pub ratio: Option<f64>,
    /// Whether the cell is unreliable: another outcome, an amplification above [`SENSITIVE_RATIO`]
    /// in the peak rotation or in the velocities of the impacts, or, for an overturned block, above
    /// [`DOUBTFUL_RATIO`] in the rocking before it overturned.
    pub sensitive: bool,
}

/// The uplift spectrum of `base` over objects on rigid bases: one cell for each, in the same order,
/// as [`respond`](crate::respond::respond) finds it.
///
/// # Errors
/// Each cell has its own error: see [`rock`](crate::rocking::rock).
pub fn uplift_spectrum(
    objects: &[RigidPlane],
    base: Base,
    settings: &Settings,
) -> Vec<Result<UpliftCell, RockingError>> {
    let asked: Vec<_> = objects.iter().map(|one| (*one, base)).collect();
    let cell = |(object, found): (&RigidPlane, Result<RockingSummary, RockingError>)| {
        Ok(UpliftCell::new(object.plane.block, found?))
    };
    let found = on_rigid_bases(&asked, settings);
    objects.iter().zip(found).map(cell).collect()
}

/// How much the peak rotations of `cells`, the [`uplift_spectrum`] of these objects, base and
/// settings, amplify an error of the motion: |θ(1.000001 ü_h)/θ(ü_h) − 1| / 1e-6, from a second
/// spectrum under the changed horizontal motion. A cell without a history has no ratio and is not
/// sensitive.
///
/// # Limitation
/// This is a difference in one direction, for an error in the scale of the motion. Other errors may
/// be amplified more or less, and where the peak moves from one swing to another, the slope on the
/// other side differs. The solver's own error is amplified in the same way: errors of ε per step
/// leave the ratio uncertain by about ε/1e-6, and a ratio above 1e6 only says that the rotation is
/// undetermined.
pub fn uplift_sensitivity(
    objects: &[RigidPlane],
    cells: &[Result<UpliftCell, RockingError>],
    base: Base,
    settings: &Settings,
) -> Vec<Sensitivity> {
    // A motion at the end of the range of floating-point numbers cannot grow; it is reduced
    // instead, which gives the same slope.
    let changed = base.horizontal.and_then(|motion| {
        let (more, less) = (1.0 + PERTURBATION_RATIO, 1.0 - PERTURBATION_RATIO);
        motion.scaled(more).or_else(|_| motion.scaled(less)).ok()
    });
    let changed = Base {
        horizontal: changed.as_ref(),
        vertical: base.vertical,
    };
    let followed = objects.iter().zip(cells).filter(|(_, cell)| cell.is_ok());
    let followed: Vec<RigidPlane> = followed.map(|(object, _)| *object).collect();
    let mut again = uplift_spectrum(&followed, changed, settings).into_iter();
    let none = Sensitivity {
        ratio: None,
        sensitive: false,
    };
    let compared = cells.iter().map(|cell| {
        let cell = cell.as_ref().ok()?;
        Some(cell.sensitivity(again.next()?.ok().map(|again| again.rocking)))
    });
    compared
        .map(|sensitivity| sensitivity.unwrap_or(none))
        .collect()
}

impl UpliftCell {
    /// An object and its response: a summary, or the whole history (`&Rocking`).
    pub fn new(block: Block, rocking: impl Into<RockingSummary>) -> Self {
        Self {
            block,
            rocking: rocking.into(),
        }
    }

    /// The sensitivity, from the response to the changed motion.
    fn sensitivity(&self, changed: Option<RockingSummary>) -> Sensitivity {
        let Some(changed) = changed else {
            return Sensitivity {
                ratio: None,
                sensitive: true,
            };
        };
        if changed.outcome != self.rocking.outcome {
            return Sensitivity {
                ratio: None,
                sensitive: true,
            };
        }
        let amplified = |number: f64, changed: f64, of: f64| {
            if number == changed {
                0.0
            } else {
                (changed - number).abs() / of / PERTURBATION_RATIO
            }
        };
        let fastest = self.impact_omega_rad_s();
        let (mut lower, mut speed) = (0.0_f64, 0.0_f64);
        for (side, changed) in self.rocking.sides.iter().zip(changed.sides) {
            let (height, omega) = (side.peak_rotation_rad, side.impact_omega_rad_s);
            lower = lower.max(amplified(height, changed.peak_rotation_rad, height));
            speed = speed.max(amplified(omega, changed.impact_omega_rad_s, fastest));
        }
        match self.rocking.outcome {
            Outcome::NoUplift => Sensitivity {
                ratio: None,
                sensitive: false,
            },
            // Only the rocking before remains to compare: where an error has become visible in it,
            // the overturning is in doubt.
            Outcome::Overturned => Sensitivity {
                ratio: None,
                sensitive: lower.max(speed) > DOUBTFUL_RATIO,
            },
            Outcome::Rocked | Outcome::Leaned | Outcome::Unresolved => {
                let peak = self.rocking.peak_rotation_rad;
                let ratio = amplified(peak, changed.peak_rotation_rad, peak);
                // A block at the threshold that does not rise may rise under the changed motion: it
                // has no ratio, but is sensitive.
                Sensitivity {
                    ratio: Some(ratio).filter(|ratio| ratio.is_finite()),
                    sensitive: ratio.max(speed) > SENSITIVE_RATIO,
                }
            }
        }
    }

    /// Largest |ω| just before an impact \[rad/s\]; 0 without impacts.
    pub fn impact_omega_rad_s(&self) -> f64 {
        self.rocking
            .sides
            .iter()
            .fold(0.0, |most: f64, side| most.max(side.impact_omega_rad_s))
    }

    /// The shock on a cushion (everything under the landing edge): the larger of the shocks of the
    /// landings from the two edges, which are equal unless the centre of gravity is off-centre.
    pub fn shock(
        &self,
        mass_kg: f64,
        cushion: &Cushion,
        model: ImpactModel,
        gravity_m_s2: f64,
    ) -> ShockCell {
        let upright = !self.rocking.outcome.has_fallen();
        let landings = landings(&self.block, model);
        let largest = |rise_m: &dyn Fn(&Landing, SideExtremes) -> f64| {
            let shocks = landings
                .iter()
                .zip(self.rocking.sides)
                .map(|(landing, side)| {
                    let rise_m = rise_m(landing, side);
                    landing.edge_acceleration_m_s2(mass_kg, cushion, rise_m, gravity_m_s2) / G0_M_S2
                });
            shocks.fold(0.0, f64::max)
        };
        let uplift = |landing: &Landing, side: SideExtremes| {
            landing.pivot.largest_rise_m(side.peak_rotation_rad)
        };
        let velocity = |landing: &Landing, side: SideExtremes| {
            landing.equivalent_rise_m(side.impact_omega_rad_s, gravity_m_s2)
        };
        ShockCell {
            edge_acceleration_g: upright.then(|| largest(&uplift)),
            edge_acceleration_impact_velocity_g: upright.then(|| largest(&velocity)),
            ceiling_g: largest(&|landing, _| landing.pivot.balance_rise_m()),
        }
    }
}

/// The landings of a rocking block from its right edge and from its left one.
pub fn landings(block: &Block, model: ImpactModel) -> [Landing; 2] {
    [block.mirrored(), *block].map(|block| Landing::rocking(&block, model))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Motion;
    use crate::rocking::Restitution;
    use crate::wall::Walls;

    /// On a spring the shock of one landing goes with √(k/m), whatever the shape: the page shows other
    /// masses and stiffnesses without rocking again.
    #[test]
    fn shocks_follow_the_root_of_stiffness_over_mass() {
        for (height_m, thickness_m) in [(1.8, 0.4), (0.6, 0.55), (0.3, 0.9)] {
            let block = Block::uniform(height_m, thickness_m).unwrap();
            for landing in landings(&block, ImpactModel::Paper) {
                let shock = |mass_kg: f64, stiffness_n_m: f64| {
                    let cushion = Cushion::linear(stiffness_n_m).unwrap();
                    landing.edge_acceleration_m_s2(mass_kg, &cushion, 0.01, G0_M_S2)
                };
                let (one, other) = (shock(150.0, 4.38e6), shock(37.0, 9e5));
                let expected = one * (9e5 / 4.38e6 * 150.0 / 37.0_f64).sqrt();
                // Rounding of a few operations.
                assert!(
                    (other / expected - 1.0).abs() < 1e-13,
                    "{height_m} {thickness_m}: {other} {expected}"
                );
            }
        }
    }

    /// Known ceilings, for 150 kg on 4380 N/mm.
    #[test]
    fn ceiling_is_the_shock_at_the_balance_point() {
        for (thickness_m, height_m, expected) in
            [(0.2, 1.5, 1.45), (0.4, 1.5, 5.72), (0.6, 2.0, 8.32)]
        {
            let block = Block::uniform(height_m, thickness_m).unwrap();
            let still = Motion::new(0.01, vec![0.0; 3]).unwrap();
            let base = Base {
                horizontal: Some(&still),
                vertical: None,
            };
            let cells = uplift_spectrum(&[standing(block)], base, &Settings::default());
            let cell = cells[0].unwrap();
            assert_eq!(cell.rocking.outcome, Outcome::NoUplift);
            let shock = cell.shock(
                150.0,
                &Cushion::linear(4.38e6).unwrap(),
                ImpactModel::Paper,
                G0_M_S2,
            );
            // Known to two decimals.
            assert!(
                (shock.ceiling_g - expected).abs() < 5e-3,
                "{}",
                shock.ceiling_g
            );
            assert_eq!(shock.edge_acceleration_g, Some(0.0));
        }
    }

    fn standing(block: Block) -> RigidPlane {
        RigidPlane::along_x(block, Restitution::Housner, Walls::NONE)
    }

    /// A pulse of one sine of 0.4 s followed by quiet; `amplitude` in g.
    fn pulse(amplitude: f64) -> Motion {
        let sample = |i: u32| {
            let t = f64::from(i) * 0.01;
            if t < 0.4 {
                amplitude * G0_M_S2 * (std::f64::consts::TAU * t / 0.4).sin()
            } else {
                0.0
            }
        };
        Motion::new(0.01, (0..800).map(sample).collect()).unwrap()
    }

    fn under_pulse(amplitude: f64) -> (Outcome, Sensitivity) {
        let (motion, settings) = (pulse(amplitude), Settings::default());
        let base = Base {
            horizontal: Some(&motion),
            vertical: None,
        };
        let objects = [standing(Block::uniform(1.5, 0.4).unwrap())];
        let cells = uplift_spectrum(&objects, base, &settings);
        (
            cells[0].unwrap().rocking.outcome,
            uplift_sensitivity(&objects, &cells, base, &settings)[0],
        )
    }

    /// Close to overturning the block lingers at the balance point: α − θ is proportional to the
    /// square root of the distance to the critical amplitude, so the slope of the peak grows
    /// without bound.
    #[test]
    fn sensitivity_grows_towards_overturning() {
        let (mut upright, mut falls) = (0.6, 5.0);
        assert_eq!(under_pulse(upright).0, Outcome::Rocked);
        assert_eq!(under_pulse(falls).0, Outcome::Overturned);
        while falls - upright > 1e-9 {
            let middle = 0.5 * (upright + falls);
            if under_pulse(middle).0 == Outcome::Overturned {
                falls = middle
            } else {
                upright = middle
            }
        }
        let ratio = |missing: f64| {
            let (outcome, sensitivity) = under_pulse(upright * (1.0 - missing));
            assert_eq!(outcome, Outcome::Rocked);
            (sensitivity.ratio.unwrap(), sensitivity.sensitive)
        };
        let (near, nearer) = (ratio(1e-4), ratio(1e-5));
        assert!(near.1 && near.0 > SENSITIVE_RATIO && nearer.1, "{near:?}");
        // √10 = 3.16; the change itself is a twentieth of that distance, which changes the slope.
        assert!(
            (2.8..3.6).contains(&(nearer.0 / near.0)),
            "{near:?} {nearer:?}"
        );
        // A millionth more overturns it.
        let edge = under_pulse(upright * (1.0 - 0.5 * PERTURBATION_RATIO));
        assert_eq!(
            edge,
            (
                Outcome::Rocked,
                Sensitivity {
                    ratio: None,
                    sensitive: true
                }
            )
        );
    }

    #[test]
    fn sensitivity_is_moderate_elsewhere_and_absent_without_a_peak() {
        let (outcome, sensitivity) = under_pulse(0.6);
        assert_eq!(outcome, Outcome::Rocked);
        // The rotation grows from the threshold of t/h g = 0.267 g: faster than the motion, but not
        // by much.
        assert!(
            !sensitivity.sensitive && (1.0..SENSITIVE_RATIO).contains(&sensitivity.ratio.unwrap()),
            "{sensitivity:?}"
        );
        let quiet = Sensitivity {
            ratio: None,
            sensitive: false,
        };
        assert_eq!(under_pulse(0.2), (Outcome::NoUplift, quiet));
        assert_eq!(under_pulse(5.0), (Outcome::Overturned, quiet));
    }

    /// A cell without a history keeps its place.
    #[test]
    fn sensitivities_stay_beside_their_cells() {
        let motion = pulse(0.6);
        let (base, settings) = (
            Base {
                horizontal: Some(&motion),
                vertical: None,
            },
            Settings::default(),
        );
        let objects = [standing(Block::uniform(1.5, 0.4).unwrap()); 3];
        let mut cells = uplift_spectrum(&objects, base, &settings);
        let alone = uplift_sensitivity(&objects, &cells, base, &settings)[0];
        cells[1] = Err(RockingError::FreeFlight { time_s: 0.0 });
        let sensitivities = uplift_sensitivity(&objects, &cells, base, &settings);
        assert_eq!(
            sensitivities,
            [
                alone,
                Sensitivity {
                    ratio: None,
                    sensitive: false
                },
                alone
            ]
        );
    }

    /// An overturned object has no shock, and its uplift is the whole width of its base.
    #[test]
    fn overturned_cells_carry_no_shock() {
        let block = Block::uniform(2.0, 0.2).unwrap();
        let push = Motion::new(0.01, vec![0.5 * G0_M_S2; 400]).unwrap();
        let base = Base {
            horizontal: Some(&push),
            vertical: None,
        };
        let cell = uplift_spectrum(&[standing(block)], base, &Settings::default())[0].unwrap();
        assert_eq!(
            (cell.rocking.outcome, cell.rocking.uplift_m),
            (Outcome::Overturned, 0.2)
        );
        let shock = cell.shock(
            150.0,
            &Cushion::linear(4.38e6).unwrap(),
            ImpactModel::Paper,
            G0_M_S2,
        );
        assert_eq!(
            (
                shock.edge_acceleration_g,
                shock.edge_acceleration_impact_velocity_g
            ),
            (None, None)
        );
    }
}
