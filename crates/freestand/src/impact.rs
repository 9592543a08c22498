//! The shock of one landing: from the rise of the centre of gravity to the acceleration of the
//! landing edge.
//!
//! Every scenario follows one rule: an effective mass m_eff lands on the cushion k at the velocity
//! v = ω₁d of the contact point, and a_edge = F/m_eff = v√(k/m_eff). Eqs. (5) and (8) of Al Abadi
//! et al. are this rule, each with its own m_eff; see [`ImpactModel`]. Misprints of the paper that
//! are corrected here: I₀ = (4/3)mR² (printed ¾); R_D is the angular velocity after the impact over
//! that before it; 1 − R_D² is the share of energy that is lost; stiffnesses are N/mm (printed
//! N/m).

use thiserror::Error;

use crate::block::{Block, Pivot};
use crate::cushion::{ContactLaw, Cushion};

/// What the rest of the object does while its edge lands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImpactModel {
    /// Eq. (5): the landing edge does not slip and the old pivot is unloaded; m_eff = (I_A − I_B
    /// R_D²)/d², for a uniform block m(1 − 0.1875(d/R)²).
    Paper,
    /// Eq. (8): the rotation about the old pivot is halted; m_eff = I_A/d².
    Halted,
    /// Frictionless landing edge, old pivot free; m_eff = m/(1 + x²/k_g²), for a uniform block
    /// m/(1 + 0.75(d/R)²). For comparison only.
    FreeCorner,
}

/// The landing that an object is about to make.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landing {
    /// The model that gives [`Landing::effective_mass_ratio`].
    pub model: ImpactModel,
    /// The edge about which the object rotates until the contact.
    pub pivot: Pivot,
    /// d: distance from the pivot edge to the point of contact \[m\].
    pub contact_distance_m: f64,
    /// Effective mass divided by the mass of the object, m_eff/m.
    pub effective_mass_ratio: f64,
    /// Δh from the balance point to the contact \[m\], for the scenarios in which the object falls
    /// from there.
    pub fall_from_balance_m: Option<f64>,
    block: Block,
}

/// Why a landing cannot be evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum LandingError {
    /// The gap is wider than the object is high, so that the falling object does not reach the
    /// obstacle.
    #[error(
        "the obstacle is {gap_m} m away and the object is {height_m} m high, so the object cannot reach it"
    )]
    OutOfReach {
        /// Distance to the obstacle \[m\].
        gap_m: f64,
        /// Height of the object \[m\].
        height_m: f64,
    },
}

/// The shock of one landing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Δh: rise of the centre of gravity before the landing \[m\].
    pub cg_rise_m: f64,
    /// a, Eq. (7): peak acceleration of the lumped mass dropped by Δh on the same cushion \[m/s²\].
    pub drop_acceleration_m_s2: f64,
    /// The shock a_edge, Eq. (5) or (8): peak acceleration of the landing edge \[m/s²\].
    pub edge_acceleration_m_s2: f64,
    /// v = ω₁d: velocity of the contact point just before the contact \[m/s\].
    pub edge_velocity_m_s: f64,
    /// Duration of the contact; on a spring half a period of m_eff on k, π√(m_eff/k) \[s\].
    pub pulse_duration_s: f64,
    /// Change of the velocity of the edge during the pulse, (1 + e)v; on a spring 2v \[m/s\].
    pub velocity_change_m_s: f64,
    /// Largest compression of the cushion; on a spring v√(m_eff/k) \[m\].
    pub compression_m: f64,
}

impl Landing {
    /// A rocking object lands on its other edge, Fig. 1(c) (or 1(b), halted), at d = B.
    ///
    /// A squat block (R_D < 0) cannot rock through: `Paper` then becomes `Halted`; compare
    /// [`Landing::model`].
    pub fn rocking(block: &Block, model: ImpactModel) -> Self {
        let r_d = block.landing_ratio();
        let model = if model == ImpactModel::Paper && r_d < 0.0 {
            ImpactModel::Halted
        } else {
            model
        };
        let (pivot, d) = (block.pivot(), block.base_width_m());
        let effective_mass_ratio = match model {
            ImpactModel::Paper => {
                (pivot.inertia_per_mass_m2 - block.right_pivot().inertia_per_mass_m2 * r_d * r_d)
                    / (d * d)
            }
            ImpactModel::Halted => pivot.inertia_per_mass_m2 / (d * d),
            ImpactModel::FreeCorner => {
                1.0 / (1.0 + (block.cg_from_right_m() / block.gyration_radius_m()).powi(2))
            }
        };
        Self {
            model,
            pivot,
            contact_distance_m: d,
            effective_mass_ratio,
            fall_from_balance_m: None,
            block: *block,
        }
    }

    /// The object falls over onto the floor, Fig. 1(a): halted, with d = h.
    ///
    /// The centre of gravity falls from the balance point to its distance from the side, R − t/2
    /// for a uniform block. The energy that the object still has at the balance point is not
    /// included, so this is a lower estimate.
    pub fn overturning_onto_floor(block: &Block) -> Self {
        let pivot = block.pivot();
        // When the object lies on its side, its centre of gravity is as far from the floor as it
        // was from that side.
        let lying_m =
            0.5 * block.thickness_m() - 0.5 * block.base_width_m() + block.cg_from_left_m();
        Self::halted_at(block, block.height_m(), pivot.half_diagonal_m - lying_m)
    }

    /// The object falls against an obstacle at a distance `gap_m`, Fig. 1(a): halted at the
    /// contact.
    ///
    /// Obstacle taller than the object (or `None`): θ_c = asin(gap/h), d = h. Lower, of height H_o:
    /// θ_c = atan(gap/H_o), d = √(gap² + H_o²). The object falls from the balance point only where
    /// θ_c ≥ α; otherwise [`Landing::fall_from_balance_m`] is `None`, and only the angular velocity
    /// from a rocking history gives the shock.
    ///
    /// # Errors
    /// A gap that is wider than the object is high.
    pub fn overturning_onto_obstacle(
        block: &Block,
        gap_m: f64,
        obstacle_height_m: Option<f64>,
    ) -> Result<Self, LandingError> {
        let h = block.height_m();
        let (contact_rotation_rad, d) = match obstacle_height_m {
            Some(low) if gap_m.hypot(low) < h => ((gap_m / low).atan(), gap_m.hypot(low)),
            _ if gap_m <= h => ((gap_m / h).asin(), h),
            _ => return Err(LandingError::OutOfReach { gap_m, height_m: h }),
        };
        let pivot = block.pivot();
        let beyond = contact_rotation_rad - pivot.slenderness_angle_rad;
        let mut landing = Self::halted_at(
            block,
            d,
            2.0 * pivot.half_diagonal_m * (0.5 * beyond).sin().powi(2),
        );
        if beyond < 0.0 {
            landing.fall_from_balance_m = None;
        }
        Ok(landing)
    }

    fn halted_at(block: &Block, d: f64, fall_m: f64) -> Self {
        let pivot = block.pivot();
        Self {
            model: ImpactModel::Halted,
            pivot,
            contact_distance_m: d,
            effective_mass_ratio: pivot.inertia_per_mass_m2 / (d * d),
            fall_from_balance_m: Some(fall_m),
            block: *block,
        }
    }

    /// a_edge/a: the factor of a in Eqs. (5) and (8), for a uniform block ¾(1−R_D²)^(−½)(d/R)² and
    /// ¾(d/R)².
    ///
    /// It may also be applied to a *measured* drop acceleration (same mass, same rise).
    pub fn amplification_ratio(&self) -> f64 {
        self.contact_distance_m
            / (self.pivot.inertia_per_mass_m2 * self.effective_mass_ratio).sqrt()
    }

    /// ω₁ after a fall of the centre of gravity by `cg_rise_m`: √(2 m g Δh/I) \[rad/s\].
    pub fn omega_rad_s(&self, cg_rise_m: f64, gravity_m_s2: f64) -> f64 {
        (2.0 * gravity_m_s2 * cg_rise_m / self.pivot.inertia_per_mass_m2).sqrt()
    }

    /// Δh with the energy of ω: I ω²/(2 m g) \[m\], the `impact-velocity` source.
    pub fn equivalent_rise_m(&self, omega_rad_s: f64, gravity_m_s2: f64) -> f64 {
        self.pivot.inertia_per_mass_m2 * omega_rad_s * omega_rad_s / (2.0 * gravity_m_s2)
    }

    /// The shock of this landing on a cushion (everything under the landing edge): m_eff lands at
    /// v = ω₁d, and a_edge = F_max/m_eff. On a spring these are Eqs. (5), (7) and (8).
    ///
    /// **Units**: kg, m, m/s².
    ///
    /// # Reference
    /// Al Abadi, Petrolito, Lam and Gad, Eqs. (1)–(8); see [`Cushion::land`] for other laws.
    ///
    /// # Limitation
    /// Gravity during the contact is neglected (the `1` of √(1+2kΔh/mg), 0.5 % at 10 g).
    ///
    /// # Example
    /// Test 1 of Table I, published as 10.1 g and 4.6 g (with g = 9.81 m/s²):
    /// ```
    /// use freestand::{block::Block, cushion::Cushion, impact::{ImpactModel, Landing}};
    /// let cabinet = Landing::rocking(&Block::uniform(2.3, 0.6)?, ImpactModel::Paper);
    /// let shock = cabinet.impact(140.0, &Cushion::linear(4.38e6)?, 0.016, 9.81);
    /// assert!((shock.drop_acceleration_m_s2 / 9.81 - 10.102).abs() < 5e-4);
    /// assert!((shock.edge_acceleration_m_s2 / 9.81 - 4.526).abs() < 5e-4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn impact(
        &self,
        mass_kg: f64,
        cushion: &Cushion,
        cg_rise_m: f64,
        gravity_m_s2: f64,
    ) -> Impact {
        let m_eff = self.effective_mass_ratio * mass_kg;
        let edge_velocity_m_s = self.edge_velocity_m_s(cg_rise_m, gravity_m_s2);
        let contact = cushion.land(m_eff, edge_velocity_m_s);
        let drop_velocity_m_s = (2.0 * gravity_m_s2 * cg_rise_m).sqrt();
        Impact {
            cg_rise_m,
            drop_acceleration_m_s2: cushion.peak_force_n(mass_kg, drop_velocity_m_s) / mass_kg,
            edge_acceleration_m_s2: contact.peak_force_n / m_eff,
            edge_velocity_m_s,
            pulse_duration_s: contact.duration_s,
            velocity_change_m_s: (1.0 + contact.restitution_ratio) * edge_velocity_m_s,
            compression_m: contact.compression_m,
        }
    }

    /// Only a_edge of [`Landing::impact`], which takes less work \[m/s²\].
    pub fn edge_acceleration_m_s2(
        &self,
        mass_kg: f64,
        cushion: &Cushion,
        cg_rise_m: f64,
        gravity_m_s2: f64,
    ) -> f64 {
        let m_eff = self.effective_mass_ratio * mass_kg;
        cushion.peak_force_n(m_eff, self.edge_velocity_m_s(cg_rise_m, gravity_m_s2)) / m_eff
    }

    /// v = ω₁d: velocity of the contact point after a fall of the centre of gravity by
    /// `cg_rise_m` \[m/s\].
    pub fn edge_velocity_m_s(&self, cg_rise_m: f64, gravity_m_s2: f64) -> f64 {
        self.omega_rad_s(cg_rise_m, gravity_m_s2) * self.contact_distance_m
    }

    /// The shock of this landing at an angular velocity ω₁, the `impact-velocity` source:
    /// [`Landing::impact`] at the rise with the same energy.
    pub fn impact_at_omega(
        &self,
        mass_kg: f64,
        cushion: &Cushion,
        omega_rad_s: f64,
        gravity_m_s2: f64,
    ) -> Impact {
        let rise_m = self.equivalent_rise_m(omega_rad_s, gravity_m_s2);
        self.impact(mass_kg, cushion, rise_m, gravity_m_s2)
    }

    /// The largest stiffness of a spring that keeps a_edge at or below `tolerance_m_s2` for this
    /// rise: m_eff (a/v)² \[N/m\].
    pub fn max_stiffness_n_m(
        &self,
        mass_kg: f64,
        cg_rise_m: f64,
        gravity_m_s2: f64,
        tolerance_m_s2: f64,
    ) -> f64 {
        let v = self.edge_velocity_m_s(cg_rise_m, gravity_m_s2);
        self.effective_mass_ratio * mass_kg * (tolerance_m_s2 / v).powi(2)
    }

    /// Shock elsewhere in the object, as shares of a_edge: (horizontal, vertical) at `x_m` from the
    /// old pivot and `z_m` above the base.
    ///
    /// Rocking through: vertical R_D + (1−R_D)x/B, horizontal (1−R_D)z/B, from the velocity jump of
    /// the landing edge, which does not slip. Halted: ρ/d, perpendicular to ρ, the distance from
    /// the pivot.
    ///
    /// # Limitation
    /// The object is rigid. In simulations on two springs the horizontal part of `Paper` is 1.2–1.7
    /// times this.
    pub fn shock_share_at(&self, x_m: f64, z_m: f64) -> (f64, f64) {
        let d = self.contact_distance_m;
        match self.model {
            ImpactModel::Paper => {
                let r_d = self.block.landing_ratio();
                ((1.0 - r_d) * z_m / d, r_d + (1.0 - r_d) * x_m / d)
            }
            ImpactModel::Halted => (z_m / d, x_m / d),
            ImpactModel::FreeCorner => {
                let lever = self.block.cg_from_right_m() / self.block.gyration_radius_m().powi(2);
                let at = |x: f64| 1.0 + lever * (x - self.block.cg_from_left_m());
                (
                    lever * (z_m - self.block.cg_height_m()) / at(d),
                    at(x_m) / at(d),
                )
            }
        }
    }
}

/// Thickness of a pad where none is given \[m\]: the rubber pads of Al Abadi et al., 20 mm.
pub const ASSUMED_PAD_THICKNESS_M: f64 = 0.020;

/// A stiffness per edge below this was probably given in N/m instead of N/mm \[N/m\].
pub const SUSPICIOUS_STIFFNESS_N_M: f64 = 20_000.0;

/// Coefficient of friction for the check of sliding where none is given: an assumption, not a
/// property.
pub const ASSUMED_FRICTION: f64 = 0.5;

/// Where a result is outside the range of its model.
#[derive(Debug, Clone, Copy, PartialEq, strum::EnumCount)]
pub enum ValidityWarning {
    /// The weight alone would compress the pad completely.
    StaticCompression {
        /// Compression under the weight alone, m g/k.
        compression_mm: f64,
        /// Thickness of the pad.
        limit_mm: f64,
    },
    /// A spring softer than any cushion.
    LowStiffness {
        /// Stiffness k under one edge.
        stiffness_n_mm: f64,
    },
    /// The impact compresses the pad by more than half of its thickness, where a linear law no
    /// longer holds.
    Bottoming {
        /// Peak compression.
        compression_mm: f64,
        /// Thickness of the pad.
        limit_mm: f64,
    },
    /// A Hertz law, which assumes a deep pad, on a pad that is too thin for it.
    HalfSpace {
        /// Peak compression.
        compression_mm: f64,
        /// Thickness of the pad.
        limit_mm: f64,
    },
    /// A tangent law close to its bottoming compression.
    Bottomed {
        /// Peak compression.
        compression_mm: f64,
        /// Compression d_b at which the law bottoms.
        bottoming_mm: f64,
    },
    /// More compression than the table covers.
    BeyondTable {
        /// Peak compression.
        compression_mm: f64,
    },
    /// h/t < 0.7071: the object cannot rock through an impact.
    Squat {
        /// Housner's ratio R_D, Eq. (6).
        landing_ratio: f64,
    },
    /// The motion requires more friction than is available.
    Sliding {
        /// The coefficient of friction F_x/N that is required.
        needed_ratio: f64,
        /// The coefficient of friction that is available.
        friction_ratio: f64,
        /// In an impact, and not while rocking.
        in_impact: bool,
    },
}

/// Checks of the stiffness: the weight alone compresses the pad completely, or no cushion is that
/// soft.
pub fn stiffness_warnings(
    mass_kg: f64,
    cushion: &Cushion,
    pad_thickness_m: Option<f64>,
) -> Vec<ValidityWarning> {
    let limit_mm = 1e3 * pad_thickness_m.unwrap_or(ASSUMED_PAD_THICKNESS_M);
    let compression_m = cushion.static_compression_m(mass_kg * crate::G0_M_S2);
    let compression_mm = 1e3 * compression_m;
    let mut warnings = Vec::new();
    if compression_mm > limit_mm {
        warnings.push(ValidityWarning::StaticCompression {
            compression_mm,
            limit_mm,
        });
    }
    // The stiffness of a curved law is taken as its secant under the weight.
    let stiffness_n_m = mass_kg * crate::G0_M_S2 / compression_m;
    if stiffness_n_m < SUSPICIOUS_STIFFNESS_N_M && !cushion.is_curved() {
        warnings.push(ValidityWarning::LowStiffness {
            stiffness_n_mm: 1e-3 * stiffness_n_m,
        });
    }
    warnings
}

/// Share of a pad's thickness up to which its law is assumed to hold: engineering judgement, half.
const LINEAR_SHARE: f64 = 0.5;
/// Share of a pad's thickness up to which it counts as a half-space under a Hertz contact:
/// engineering judgement, a quarter.
pub const HALF_SPACE_SHARE: f64 = 0.25;
/// Share of its bottoming compression beyond which bottoming governs a tangent law: the tangent has
/// grown to 6.3 there.
const BOTTOMED_SHARE: f64 = 0.9;

/// Checks of the compression of a cushion: it approaches the pad's thickness, leaves the half-space
/// of a Hertz law, or exceeds the law's own data. Each layer of a series is checked separately.
pub fn compression_warnings(
    compression_m: f64,
    cushion: &Cushion,
    pad_thickness_m: Option<f64>,
) -> Vec<ValidityWarning> {
    let limit_m = pad_thickness_m.unwrap_or(ASSUMED_PAD_THICKNESS_M);
    let limit_mm = 1e3 * limit_m;
    let warning = |(law, layer_m): (&ContactLaw, f64)| {
        let compression_mm = 1e3 * layer_m;
        match law {
            ContactLaw::Tangent { bottoming_m, .. } => (layer_m > BOTTOMED_SHARE * bottoming_m)
                .then_some(ValidityWarning::Bottomed {
                    compression_mm,
                    bottoming_mm: 1e3 * bottoming_m,
                }),
            ContactLaw::Tabulated { compressions_m, .. } => compressions_m
                .last()
                .is_some_and(|&last_m| layer_m > last_m)
                .then_some(ValidityWarning::BeyondTable { compression_mm }),
            ContactLaw::Power { exponent, .. } | ContactLaw::HuntCrossley { exponent, .. }
                if *exponent > 1.0 =>
            {
                (layer_m > HALF_SPACE_SHARE * limit_m).then_some(ValidityWarning::HalfSpace {
                    compression_mm,
                    limit_mm,
                })
            }
            _ => (layer_m > LINEAR_SHARE * limit_m).then_some(ValidityWarning::Bottoming {
                compression_mm,
                limit_mm,
            }),
        }
    };
    cushion
        .layers_at(compression_m)
        .into_iter()
        .filter_map(warning)
        .collect()
}

/// The coefficient of friction below which the landing edge slips in an impact: the ratio of the
/// impulses of a landing without slip, z(1−r)/(x₁ + r x₂), for a block without offset H(1−r)/(1+r)
/// with H = 2z/B.
///
/// # Example
/// H = 5, r = 0.63:
/// ```
/// let block = freestand::block::Block::uniform(2.5, 0.5)?;
/// let needed = freestand::impact::impact_friction_needed_ratio(&block, 0.63);
/// assert!((needed - 1.135).abs() < 5e-4);
/// # Ok::<(), freestand::block::BlockError>(())
/// ```
pub fn impact_friction_needed_ratio(block: &Block, restitution: f64) -> f64 {
    block.cg_height_m() * (1.0 - restitution)
        / (block.cg_from_left_m() + restitution * block.cg_from_right_m())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A uniform block with (d/R)² = x, where x = 4t²/(h²+t²).
    fn block_with(x: f64) -> Block {
        Block::uniform((4.0 / x - 1.0).sqrt(), 1.0).unwrap()
    }

    fn spring(stiffness_n_m: f64) -> Cushion {
        Cushion::linear(stiffness_n_m).unwrap()
    }

    /// Coefficients a_edge/a of Eqs. (5) and (8) and of the free corner, to the four decimals of
    /// the table.
    #[test]
    fn coefficients_of_the_three_models() {
        for (x, paper, halted, free) in [
            (0.1, 0.2765, 0.0750, 0.2839),
            (0.5, 0.6433, 0.3750, 0.7181),
            (1.0, 0.9608, 0.7500, 1.1456),
            (2.0, 1.5492, 1.5000, 1.9365),
        ] {
            for (model, expected) in [
                (ImpactModel::Paper, paper),
                (ImpactModel::Halted, halted),
                (ImpactModel::FreeCorner, free),
            ] {
                let got = Landing::rocking(&block_with(x), model).amplification_ratio();
                assert!((got - expected).abs() < 5.1e-5, "{model:?} at {x}: {got}");
            }
        }
    }

    /// Eq. (5) as printed and v√(k/m_eff) are the same number up to rounding.
    #[test]
    fn effective_mass_form_is_equation_5() {
        for (h, t) in [(2.3, 0.6), (1.0, 1.0), (3.0, 0.2), (0.8, 1.1)] {
            let block = Block::uniform(h, t).unwrap();
            let x = (t / block.pivot().half_diagonal_m).powi(2);
            let r_d = 1.0 - 0.375 * x;
            let a = (2.0 * 1e6 * 9.80665 * 0.01 / 100.0f64).sqrt();
            let eq5 = 0.75 / (1.0 - r_d * r_d).sqrt() * x * a;
            let got = Landing::rocking(&block, ImpactModel::Paper).impact(
                100.0,
                &spring(1e6),
                0.01,
                9.80665,
            );
            assert!((got.edge_acceleration_m_s2 / eq5 - 1.0).abs() < 1e-13);
            assert!((got.drop_acceleration_m_s2 / a - 1.0).abs() < 1e-13);
            // Δv = 2AT/π of a half-sine is 2 v.
            let dv = 2.0 * got.edge_acceleration_m_s2 * got.pulse_duration_s / std::f64::consts::PI;
            assert!((dv / got.velocity_change_m_s - 1.0).abs() < 1e-13);
        }
    }

    /// Another law is solved for m_eff at the edge's velocity. Inserting the drop acceleration of
    /// the lumped mass into Eq. (5) would give (a_edge/a)(v₀/v)^(2n/(n+1)) (m_eff/m)^(1/(n+1))
    /// times as much: for the cabinet 18.57 % too much at n = 1.5 and 44.06 % at n = 2.5.
    #[test]
    fn a_curved_law_is_not_put_into_equation_5() {
        let landing = Landing::rocking(&Block::uniform(2.3, 0.6).unwrap(), ImpactModel::Paper);
        for (exponent, more) in [(1.0, 0.0), (1.5, 0.1857), (2.5, 0.4406)] {
            let law = ContactLaw::Power {
                coefficient_n_mn: 3e8,
                exponent,
            };
            let impact = landing.impact(140.0, &Cushion::new(law).unwrap(), 0.016, 9.81);
            let (v, m_eff) = (
                impact.edge_velocity_m_s,
                140.0 * landing.effective_mass_ratio,
            );
            // K dⁿ at the energy of m_eff.
            let d = (0.5 * (exponent + 1.0) * m_eff * v * v / 3e8).powf(1.0 / (exponent + 1.0));
            assert!(
                (impact.edge_acceleration_m_s2 * m_eff / (3e8 * d.powf(exponent)) - 1.0).abs()
                    < 1e-12
            );
            let wrong = landing.amplification_ratio() * impact.drop_acceleration_m_s2;
            assert!(
                (wrong / impact.edge_acceleration_m_s2 - 1.0 - more).abs() < 5e-5,
                "{exponent}"
            );
        }
    }

    /// Each limit causes exactly one warning, in its own words.
    #[test]
    fn compressions_beyond_a_law_are_noticed() {
        let landing = Landing::rocking(&Block::uniform(2.3, 0.6).unwrap(), ImpactModel::Paper);
        let warnings = |law: ContactLaw| {
            let cushion = Cushion::new(law).unwrap();
            let impact = landing.impact(140.0, &cushion, 0.03, 9.81);
            compression_warnings(impact.compression_m, &cushion, Some(0.02))
        };
        let hertz = |coefficient_n_mn| ContactLaw::Power {
            coefficient_n_mn,
            exponent: 1.5,
        };
        assert!(
            warnings(ContactLaw::Linear {
                stiffness_n_m: 4.38e6
            })
            .is_empty()
        );
        assert!(matches!(
            warnings(ContactLaw::Linear { stiffness_n_m: 1e5 })[..],
            [ValidityWarning::Bottoming { .. }]
        ));
        assert!(warnings(hertz(1e9)).is_empty());
        assert!(matches!(
            warnings(hertz(2e6))[..],
            [ValidityWarning::HalfSpace { .. }]
        ));
        let tangent = ContactLaw::Tangent {
            stiffness_n_m: 4e5,
            bottoming_m: 4e-3,
        };
        assert!(matches!(
            warnings(tangent)[..],
            [ValidityWarning::Bottomed { .. }]
        ));
        let table = ContactLaw::Tabulated {
            compressions_m: vec![0.0, 1e-3],
            forces_n: vec![0.0, 4.38e3],
        };
        assert!(matches!(
            warnings(table)[..],
            [ValidityWarning::BeyondTable { .. }]
        ));
        // The pad of two layers is the one that bottoms, not the leg.
        let layers = [
            ContactLaw::Tangent {
                stiffness_n_m: 4e5,
                bottoming_m: 3e-3,
            },
            ContactLaw::Linear { stiffness_n_m: 9e6 },
        ];
        let layers = layers.map(|law| Cushion::new(law).unwrap());
        let both = Cushion::in_series(&layers).unwrap();
        assert!(matches!(
            warnings(both.law().clone())[..],
            [ValidityWarning::Bottomed { .. }]
        ));
    }

    #[test]
    fn squat_blocks_are_halted() {
        let landing = Landing::rocking(&Block::uniform(0.6, 1.0).unwrap(), ImpactModel::Paper);
        assert_eq!(landing.model, ImpactModel::Halted);
    }

    #[test]
    fn largest_stiffness_gives_the_tolerance_back() {
        let landing = Landing::rocking(&Block::uniform(2.3, 0.6).unwrap(), ImpactModel::Paper);
        let k = landing.max_stiffness_n_m(140.0, 0.02, 9.81, 30.0);
        let a = landing
            .impact(140.0, &spring(k), 0.02, 9.81)
            .edge_acceleration_m_s2;
        assert!((a / 30.0 - 1.0).abs() < 1e-13);
    }

    /// Overturning: a 2 m × 0.5 m block onto the floor, Δh = R − t/2, d = h, Eq. (8).
    #[test]
    fn overturning_scenarios_follow_equation_8() {
        let block = Block::uniform(2.0, 0.5).unwrap();
        let r = block.pivot().half_diagonal_m;
        let floor = Landing::overturning_onto_floor(&block);
        assert!((floor.fall_from_balance_m.unwrap() - (r - 0.25)).abs() < 1e-15);
        assert!((floor.amplification_ratio() - 0.75 * (2.0 / r).powi(2)).abs() < 1e-13);

        let wall = Landing::overturning_onto_obstacle(&block, 1.0, None).unwrap();
        let theta_c = 0.5f64.asin();
        let alpha = block.pivot().slenderness_angle_rad;
        assert!(
            (wall.fall_from_balance_m.unwrap() - r * (1.0 - (theta_c - alpha).cos())).abs() < 1e-14
        );
        let bench = Landing::overturning_onto_obstacle(&block, 0.6, Some(0.8)).unwrap();
        assert!((bench.contact_distance_m - 1.0).abs() < 1e-15);
        assert!((0.6f64.atan2(0.8) - alpha) > 0.0 && bench.fall_from_balance_m.unwrap() > 0.0);
        let near = Landing::overturning_onto_obstacle(&block, 0.1, None).unwrap();
        assert_eq!(near.fall_from_balance_m, None);
        assert!(Landing::overturning_onto_obstacle(&block, 2.1, None).is_err());
    }

    /// The share is (·, 1) at the landing edge, and (0, R_D) or (0, 0) at the old pivot.
    #[test]
    fn shock_in_the_object_starts_from_the_edges() {
        let block = Block::uniform(2.0, 0.5).unwrap();
        let rocking = Landing::rocking(&block, ImpactModel::Paper);
        assert_eq!(rocking.shock_share_at(0.5, 0.0), (0.0, 1.0));
        assert!((rocking.shock_share_at(0.0, 0.0).1 - block.landing_ratio()).abs() < 1e-15);
        assert!(
            (rocking.shock_share_at(0.0, 2.0).0 - (1.0 - block.landing_ratio()) * 4.0).abs()
                < 1e-14
        );
        let halted = Landing::rocking(&block, ImpactModel::Halted);
        assert_eq!(halted.shock_share_at(0.5, 2.0), (4.0, 1.0));
        let free = Landing::rocking(&block, ImpactModel::FreeCorner);
        assert_eq!(free.shock_share_at(0.5, 1.0), (0.0, 1.0));
    }

    #[test]
    fn newtons_per_metre_typed_for_newtons_per_millimetre_are_noticed() {
        assert!(stiffness_warnings(140.0, &spring(4.38e6), None).is_empty());
        assert_eq!(stiffness_warnings(140.0, &spring(4380.0), None).len(), 2);
        // 140 kg on 60 N/mm: 22.9 mm, more than an unknown pad, less than a 25 mm one.
        assert_eq!(stiffness_warnings(140.0, &spring(60e3), None).len(), 1);
        assert!(stiffness_warnings(140.0, &spring(60e3), Some(0.025)).is_empty());
    }
}
