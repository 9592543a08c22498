//! What is uncertain about the building, and how an object is turned.

use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

use super::streams::{Group, object_stream, world_stream};
use super::{WorldError, within};

/// The largest standard deviation of a logarithm.
const MOST_SPREAD: f64 = 1.0;

/// How little is known of a building.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BuildingSpread {
    period: f64,
    damping: f64,
}

impl Default for BuildingSpread {
    /// 0.20 for the periods and 0.40 for the damping.
    fn default() -> Self {
        Self {
            period: 0.20,
            damping: 0.40,
        }
    }
}

/// Factors of one world for the modes of a building, for
/// [`Building::with_factors`](crate::building::Building::with_factors).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BuildingDraw {
    /// Factor of the period of every mode.
    pub period_factor: f64,
    /// Factor of the damping ratio of every mode.
    pub damping_factor: f64,
}

impl BuildingSpread {
    /// Standard deviations of ln T₁ and of the logarithm of the damping ratio.
    ///
    /// The defaults: 0.20 for a period from the formula of a code (Goel and Chopra 1997 found 0.2 to
    /// 0.3 between buildings); 0.40 for damping (coefficients of variation of 0.3 to 0.6 in records
    /// of buildings).
    ///
    /// # Errors
    /// A value outside 0 to 1.
    pub fn new(period: f64, damping: f64) -> Result<Self, WorldError> {
        within("the spread of the period", MOST_SPREAD, period)?;
        within("the spread of the damping", MOST_SPREAD, damping)?;
        Ok(Self { period, damping })
    }

    /// The factors at these numbers of standard deviations: lognormal, with a median of 1.
    pub fn at(self, period_normal: f64, damping_normal: f64) -> BuildingDraw {
        BuildingDraw {
            period_factor: (self.period * period_normal).exp(),
            damping_factor: (self.damping * damping_normal).exp(),
        }
    }

    /// The building of a world; `repetition` is 0, or 1 and more where it alone is drawn again.
    ///
    /// # Example
    /// ```
    /// use freestand::worlds::BuildingSpread;
    /// let known = BuildingSpread::new(0.0, 0.0)?.draw(1, 7, 0);
    /// assert_eq!((known.period_factor, known.damping_factor), (1.0, 1.0));
    /// # Ok::<(), freestand::worlds::WorldError>(())
    /// ```
    pub fn draw(self, seed: u64, world: u32, repetition: u32) -> BuildingDraw {
        let mut random = world_stream(seed, world, Group::Building, repetition);
        let (period, damping) = (
            StandardNormal.sample(&mut random),
            StandardNormal.sample(&mut random),
        );
        self.at(period, damping)
    }
}

/// Whether the first side of an object lies along x in a world, with a chance of ½; if not, it lies
/// along y.
pub fn is_first_side_along_x(seed: u64, world: u32, object: u64, repetition: u32) -> bool {
    object_stream(seed, world, object, Group::Orientation, repetition).next_u32() & 1 == 0
}
