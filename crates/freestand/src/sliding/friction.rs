//! Friction under a rigid block: the mode in which it begins to move, an impact in which the landing
//! edge slips, and the speed at which a sliding block trips.

use super::SlidingError;
use crate::block::Block;
use crate::impact::impact_friction_needed_ratio;
use crate::rocking::RockingModel;

/// Coefficients of friction, 0 ≤ μ_k ≤ μ_s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    static_ratio: f64,
    kinetic_ratio: f64,
}

impl Friction {
    /// Friction at rest and while sliding.
    ///
    /// # Errors
    /// A coefficient that is negative or not finite, or μ_k > μ_s.
    pub fn new(static_ratio: f64, kinetic_ratio: f64) -> Result<Self, SlidingError> {
        if (0.0..=static_ratio).contains(&kinetic_ratio) && static_ratio.is_finite() {
            Ok(Self {
                static_ratio,
                kinetic_ratio,
            })
        } else {
            Err(SlidingError::Friction {
                static_ratio,
                kinetic_ratio,
            })
        }
    }

    /// One coefficient for both: also the rolling resistance of casters.
    ///
    /// # Errors
    /// As [`Friction::new`].
    pub fn uniform(ratio: f64) -> Result<Self, SlidingError> {
        Self::new(ratio, ratio)
    }

    /// μ_s.
    pub fn static_ratio(self) -> f64 {
        self.static_ratio
    }

    /// μ_k.
    pub fn kinetic_ratio(self) -> f64 {
        self.kinetic_ratio
    }

    /// Whether the block slides before an edge lifts, and so never rocks: μ_s ≤ t/h, with the
    /// smaller distance of the centre of gravity from an edge for a general block.
    pub fn is_below_uplift(self, block: &Block) -> bool {
        self.static_ratio <= RockingModel::Rigid.uplift_threshold_ratio(block)
    }
}

/// How a block on a rigid base begins to move from rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// It moves with the floor.
    Rest,
    /// It slides, and no edge lifts.
    Slide,
    /// An edge lifts, and the other one holds.
    Rock,
    /// An edge lifts, and the other one slips.
    SlideRock,
    /// The floor falls away: g + ü_v ≤ 0.
    FreeFlight,
}

impl Mode {
    /// `rest`, `slide`, `rock`, `slide-rock`, `free-flight`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::Slide => "slide",
            Self::Rock => "rock",
            Self::SlideRock => "slide-rock",
            Self::FreeFlight => crate::rocking::FREE_FLIGHT,
        }
    }
}

/// The mode in which a block leaves rest under the accelerations ü_h and g + ü_v \[m/s²\].
///
/// With A = |ü_h|/(g+ü_v) and t/h at the edge that would lift first: rest for A ≤ min(μ_s, t/h);
/// slide for μ_s < t/h and A > μ_s; rock for A > t/h and μ_s ≥ μ*(A), the friction that the start
/// of rocking takes; slide-rock otherwise. For a uniform block with H = h/t,
/// μ* = \[A(H²+4)+3H\]/\[4H²+3HA+1\]; here for any block: μ* = (A − zε)/(1 + xε) with
/// ε = (Az − x)/(I₀/m), x and z from the pivot to the centre of gravity.
///
/// # Reference
/// Shenton (1996), J. Eng. Mech. 122, 690.
///
/// # Example
/// H = 3, A = 0.5: μ* = 0.37349.
/// ```
/// use freestand::sliding::{Mode, mode_from_rest};
/// let block = freestand::block::Block::uniform(3.0, 1.0)?;
/// assert_eq!(mode_from_rest(&block, 0.3734, 0.5 * 9.81, 9.81), Mode::SlideRock);
/// assert_eq!(mode_from_rest(&block, 0.3736, 0.5 * 9.81, 9.81), Mode::Rock);
/// # Ok::<(), freestand::block::BlockError>(())
/// ```
pub fn mode_from_rest(
    block: &Block,
    static_ratio: f64,
    horizontal_m_s2: f64,
    weight_m_s2: f64,
) -> Mode {
    if weight_m_s2 <= 0.0 {
        return Mode::FreeFlight;
    }
    let a = horizontal_m_s2.abs() / weight_m_s2;
    // A base that accelerates to the right lifts the right edge: the block turns about the left one.
    let (pivot, x) = if horizontal_m_s2 > 0.0 {
        (block.pivot(), block.cg_from_left_m())
    } else {
        (block.right_pivot(), block.cg_from_right_m())
    };
    let z = block.cg_height_m();
    let uplift = x / z;
    if a <= static_ratio.min(uplift) {
        return Mode::Rest;
    }
    if a <= uplift || static_ratio < uplift {
        return Mode::Slide;
    }
    let turning = (a * z - x) / pivot.inertia_per_mass_m2;
    let needed = (a - z * turning) / (1.0 + x * turning);
    if static_ratio >= needed {
        Mode::Rock
    } else {
        Mode::SlideRock
    }
}

/// An impact of a rocking block at θ = 0 with friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionalImpact {
    /// ω⁺/ω⁻: the ratio without slip, or the smaller one with slip; at least 0.
    pub ratio: f64,
    /// Speed at which the landing edge slips, per unit of ω⁻ \[m\]; 0 without slip.
    pub slip_m: f64,
}

/// An impact on the right edge, plastic normal to the floor, with friction μ at the landing edge.
///
/// Without slip, which needs μ ≥ μ_imp ([`impact_friction_needed_ratio`]), it is Housner's
/// (1963, [`Block::landing_ratio`]). Otherwise the tangential impulse is μ times the normal one:
/// ω⁺/ω⁻ = \[k² + (μz−x₂)x₁\]/\[k² − (μz−x₂)x₂\], at least 0, and the edge slips at
/// v = z(ω⁻−ω⁺) − μ(x₂ω⁺+x₁ω⁻), with the gyration radius k, the height z of the centre of gravity
/// and its distances x₁, x₂ from the left and right edges. For a uniform block, H = h/t:
/// ω⁺/ω⁻ = \[H²−2+3μH\]/\[H²+4−3μH\].
///
/// # Reference
/// Derived here from the balance of momentum; Shenton and Jones (1991), J. Eng. Mech. 117, 2286,
/// for impacts with slip.
///
/// # Example
/// H = 3 without friction: 7/13.
/// ```
/// let block = freestand::block::Block::uniform(3.0, 1.0)?;
/// let impact = freestand::sliding::frictional_impact(&block, 0.0);
/// assert!((impact.ratio - 7.0 / 13.0).abs() < 1e-15);
/// # Ok::<(), freestand::block::BlockError>(())
/// ```
pub fn frictional_impact(block: &Block, friction_ratio: f64) -> FrictionalImpact {
    let held = block.landing_ratio().max(0.0);
    if friction_ratio >= impact_friction_needed_ratio(block, held) {
        return FrictionalImpact {
            ratio: held,
            slip_m: 0.0,
        };
    }
    let (x1, x2, z) = (
        block.cg_from_left_m(),
        block.cg_from_right_m(),
        block.cg_height_m(),
    );
    let k2 = block.gyration_radius_m().powi(2);
    let lever = friction_ratio * z - x2;
    let ratio = ((k2 + lever * x1) / (k2 - lever * x2)).max(0.0);
    FrictionalImpact {
        ratio,
        slip_m: z * (1.0 - ratio) - friction_ratio * (x2 * ratio + x1),
    }
}

/// The speed at which a sliding or rolling block that meets a low stop at its base overturns:
/// √(2gR(1−cos α)I₀/m)/z, about the edge that needs less \[m/s\]. For a uniform block
/// √\[(8/3)gR(1−cos α)\]/cos α.
///
/// It turns about the stop with ω = v z/(I₀/m), and overturns if that energy takes its centre of
/// gravity over the edge; the floor does not move meanwhile.
///
/// # Reference
/// The velocity impulse that overturns a block: Housner (1963).
///
/// # Example
/// ```
/// let block = freestand::block::Block::uniform(0.98, 0.7016)?;
/// assert!((freestand::sliding::trip_speed_m_s(&block, 9.80665) - 2.110675213666559).abs() < 1e-14);
/// # Ok::<(), freestand::block::BlockError>(())
/// ```
pub fn trip_speed_m_s(block: &Block, gravity_m_s2: f64) -> f64 {
    let speed = |pivot: crate::block::Pivot| {
        (2.0 * gravity_m_s2 * pivot.balance_rise_m() * pivot.inertia_per_mass_m2).sqrt()
            / block.cg_height_m()
    };
    speed(block.pivot()).min(speed(block.right_pivot()))
}
