//! Friction under a rigid block, and the speed at which a sliding block trips.

use super::SlidingError;
use crate::block::Block;
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
