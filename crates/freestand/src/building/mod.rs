//! Linear buildings, described by their modes, and the motion of their floors.
//!
//! A [`Building`] holds modes from any source: a uniform beam in closed form ([`Building::beam`]),
//! a shear building from storey masses and stiffnesses ([`Building::shear`]), or the modes of the
//! user's own model ([`Building::from_modes`]). Heights are fractions of the total: x = 0 is the
//! ground and x = 1 the roof.

mod beam;
mod damping;
mod floors;
mod storeys;
mod table;

pub use beam::BeamShape;
pub use damping::{Damping, Rayleigh};
pub use floors::{FloorPeaks, floor_motion, floor_motions, floor_motions_and_peaks, floor_peaks};
pub use storeys::{MAX_STOREYS, Storey};
pub use table::{ModalDoubt, TableMode};

use crate::motion::MotionError;
use thiserror::Error;

/// Free vibration to keep after a motion, in fundamental periods: 5 % damping decays by e^(−π) ≈
/// 1/23 in ten periods.
pub const TAIL_PERIODS: f64 = 10.0;

/// The largest number of modes of a beam or of a table: the fiftieth mode of a beam has 1/99 of the
/// fundamental period or less, far below the time step of a record. A shear building may keep all
/// its modes.
pub const MAX_MODES: usize = 50;

/// Longest fundamental period of a [`Building`] \[s\]: ten times that of the tallest tower.
pub const MAX_PERIOD_S: f64 = 100.0;

/// The quantities of a storey that may be invalid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoreyQuantity {
    /// Mass of the floor above the storey.
    Mass,
    /// Lateral stiffness of the storey.
    Stiffness,
    /// Height of the storey.
    Height,
}

impl std::fmt::Display for StoreyQuantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Mass => "mass",
            Self::Stiffness => "stiffness",
            Self::Height => "height",
        })
    }
}

/// The values of a mode in a table that may be invalid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeQuantity {
    /// Period.
    Period,
    /// Participation factor.
    Participation,
    /// A value of the shape.
    Shape,
    /// Effective mass.
    EffectiveMass,
}

impl std::fmt::Display for ModeQuantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Period => "period",
            Self::Participation => "participation factor",
            Self::Shape => "shape",
            Self::EffectiveMass => "effective mass",
        })
    }
}

/// Why a building or its floor motion cannot be calculated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BuildingError {
    /// The fundamental period is out of range.
    #[error(
        "the fundamental period must be positive and at most {MAX_PERIOD_S} s, not {period_s} s"
    )]
    Period {
        /// The period that was given, or that of the mode that is too short.
        period_s: f64,
    },
    /// The damping ratio is negative, or the damping is not below critical.
    #[error("the damping ratio must be at least 0 and below 1, not {damping_ratio}")]
    Damping {
        /// The damping ratio that was given.
        damping_ratio: f64,
    },
    /// The damping ratio of one mode is negative, or its damping is not below critical.
    #[error("the damping ratio of mode {mode} must be at least 0 and below 1, not {damping_ratio}")]
    ModeDamping {
        /// The mode, from 1.
        mode: usize,
        /// Its damping ratio, as given or as it follows from Rayleigh damping.
        damping_ratio: f64,
    },
    /// The number of damping ratios differs from the number of modes.
    #[error("the number of damping ratios is {ratios}, but the number of modes is {modes}")]
    DampingCount {
        /// Number of ratios that were given.
        ratios: usize,
        /// Number of modes.
        modes: usize,
    },
    /// The modes of Rayleigh damping are not two existing modes with different periods.
    #[error(
        "Rayleigh damping needs two modes of different periods among the first {modes}, not {first} and {second}"
    )]
    RayleighModes {
        /// The first of the two modes, counted from 1.
        first: usize,
        /// The second of the two modes.
        second: usize,
        /// Number of modes.
        modes: usize,
    },
    /// The shear-flexure ratio is negative or not finite.
    #[error("the shear-flexure ratio must be at least 0 and finite, not {shear_flexure_ratio}")]
    ShearFlexure {
        /// The ratio that was given.
        shear_flexure_ratio: f64,
    },
    /// No modes, or too many.
    #[error("the number of modes must be 1 to {at_most}, not {modes}")]
    Modes {
        /// The number that was given.
        modes: usize,
        /// The largest number of modes of this building.
        at_most: usize,
    },
    /// Participation factors and shapes do not belong together.
    #[error(
        "participation times shape adds up to {sum_ratio:.4} at the roof; the modes of a building add up to about 1"
    )]
    RoofShare {
        /// The sum.
        sum_ratio: f64,
    },
    /// No storeys, or more than [`MAX_STOREYS`].
    #[error("the number of storeys must be 1 to {MAX_STOREYS}, not {storeys}")]
    Storeys {
        /// The number that was given.
        storeys: usize,
    },
    /// The mass, stiffness or height of a storey is not positive and finite.
    #[error("the {quantity} of storey {storey} must be positive and finite, not {value}")]
    Storey {
        /// The storey, from 1 at the ground.
        storey: usize,
        /// The invalid quantity.
        quantity: StoreyQuantity,
        /// The value that was given \[kg, N/m or m\].
        value: f64,
    },
    /// The levels of a modal table do not rise from above the ground to the roof.
    #[error(
        "floor {floor} is at {level_ratio} of the height: the levels must rise from above 0 to 1 at the last floor"
    )]
    Floor {
        /// The floor, from 1.
        floor: usize,
        /// Its level.
        level_ratio: f64,
    },
    /// A mode of a modal table does not have one value for each floor.
    #[error(
        "the number of values of mode {mode} is {values}, but the number of floors is {floors}"
    )]
    ShapeLength {
        /// The mode, from 1.
        mode: usize,
        /// Number of its values.
        values: usize,
        /// Number of floors.
        floors: usize,
    },
    /// A value of a modal table is out of range.
    #[error("the {quantity} of mode {mode} must be {expected}, not {value}")]
    ModeValue {
        /// The mode, from 1 in the order of the table.
        mode: usize,
        /// The invalid quantity.
        quantity: ModeQuantity,
        /// The requirement that it does not meet.
        expected: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A level below the ground or above the roof.
    #[error("a level must be a fraction of the height from 0 to 1, not {level_ratio}")]
    Level {
        /// The level that was given.
        level_ratio: f64,
    },
    /// The floor motion is invalid, because its samples overflow.
    #[error("the floor motion is not finite: {0}")]
    Motion(#[from] MotionError),
}

/// The source of a building's modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// A uniform shear-flexure beam.
    Beam {
        /// `α = H √(GA/EI)`.
        shear_flexure_ratio: f64,
    },
    /// Storey masses on storey springs.
    Shear {
        /// Number of storeys.
        storeys: usize,
    },
    /// The user's own modes.
    Table {
        /// Number of floors in the table.
        floors: usize,
    },
}

/// Shape of a mode over the height; 0 at the ground.
#[derive(Debug, Clone, PartialEq)]
pub enum ModeShape {
    /// The shape of a uniform beam, in closed form.
    Beam(BeamShape),
    /// Values at floors, linear between them.
    Floors(FloorShape),
}

/// A mode shape by its values at floors, linear between them and 0 at the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorShape {
    /// Rising, above 0; the last is 1.
    levels_ratio: Vec<f64>,
    values_ratio: Vec<f64>,
}

impl FloorShape {
    fn value(&self, level_ratio: f64) -> f64 {
        let above = self
            .levels_ratio
            .partition_point(|&level| level < level_ratio);
        let at = |index: usize| {
            Some((
                *self.levels_ratio.get(index)?,
                *self.values_ratio.get(index)?,
            ))
        };
        let Some((high, top)) = at(above) else {
            return self.values_ratio.last().copied().unwrap_or(0.0);
        };
        if high == level_ratio {
            return top;
        }
        let (low, bottom) = above.checked_sub(1).and_then(at).unwrap_or((0.0, 0.0));
        bottom + (top - bottom) * ((level_ratio - low) / (high - low))
    }
}

/// One mode of vibration of a [`Building`].
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    period_s: f64,
    damping_ratio: f64,
    participation_ratio: f64,
    effective_mass_ratio: Option<f64>,
    shape: ModeShape,
}

impl Mode {
    /// Period of the mode \[s\].
    pub fn period_s(&self) -> f64 {
        self.period_s
    }

    /// Damping ratio of the mode.
    pub fn damping_ratio(&self) -> f64 {
        self.damping_ratio
    }

    /// Dimensionless eigenvalue γ of a beam: the wave number of the shape's sine over the height.
    pub fn eigenvalue(&self) -> Option<f64> {
        match &self.shape {
            ModeShape::Beam(shape) => Some(shape.eigenvalue()),
            ModeShape::Floors(_) => None,
        }
    }

    /// Participation factor `Γ = ∫φ dx / ∫φ² dx` (floors: `Σ m φ / Σ m φ²`) for the normalisation
    /// of the shape.
    pub fn participation_ratio(&self) -> f64 {
        self.participation_ratio
    }

    /// Share of the building's mass that acts in the mode, `(∫φ dx)² / ∫φ² dx`; the shares of all
    /// modes add up to 1. `None` where a table does not give it.
    pub fn effective_mass_ratio(&self) -> Option<f64> {
        self.effective_mass_ratio
    }

    /// The shape.
    pub fn shape(&self) -> &ModeShape {
        &self.shape
    }

    /// Mode shape φ at `level_ratio` of the height: exactly 0 at the ground.
    ///
    /// For a beam it is 1 at the roof. For a shear building it is also 1 at the roof or, where the
    /// roof hardly moves (below 1/1000 of the largest value), 1 at the floor that moves most. For a
    /// table it is as given.
    pub fn shape_ratio(&self, level_ratio: f64) -> f64 {
        if level_ratio == 0.0 {
            return 0.0;
        }
        match &self.shape {
            ModeShape::Beam(shape) => shape.value(level_ratio),
            ModeShape::Floors(shape) => shape.value(level_ratio),
        }
    }

    /// `Γφ(x)`: the factor by which the mode's oscillator moves the level. It does not depend on
    /// the normalisation of the shape.
    pub fn share_ratio(&self, level_ratio: f64) -> f64 {
        self.participation_ratio * self.shape_ratio(level_ratio)
    }
}

/// A linear building, described by its modes.
#[derive(Debug, Clone, PartialEq)]
pub struct Building {
    model: Model,
    modes: Vec<Mode>,
    floors_ratio: Vec<f64>,
}

impl Building {
    /// The source of the modes.
    pub fn model(&self) -> Model {
        self.model
    }

    /// The modes in order of decreasing period; at least one.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// Fundamental period T₁ \[s\].
    pub fn period_s(&self) -> f64 {
        self.modes[0].period_s
    }

    /// Damping ratio of every mode; `None` where they differ.
    pub fn damping_ratio(&self) -> Option<f64> {
        let first = self.modes[0].damping_ratio;
        self.modes
            .iter()
            .all(|mode| mode.damping_ratio == first)
            .then_some(first)
    }

    /// `α = H √(GA/EI)` of a beam.
    pub fn shear_flexure_ratio(&self) -> Option<f64> {
        match self.model {
            Model::Beam {
                shear_flexure_ratio,
            } => Some(shear_flexure_ratio),
            Model::Shear { .. } | Model::Table { .. } => None,
        }
    }

    /// Levels of the floors at which the shapes are given, from the lowest above the ground to the
    /// roof; empty for a beam, whose shapes are known everywhere.
    pub fn floors_ratio(&self) -> &[f64] {
        &self.floors_ratio
    }

    /// Duration of the zeros to append to a ground motion, so that the vibration of the floors
    /// decays, [`TAIL_PERIODS`]·T₁ \[s\]; for
    /// [`Motion::with_zero_tail`](crate::motion::Motion::with_zero_tail).
    pub fn tail_s(&self) -> f64 {
        TAIL_PERIODS * self.period_s()
    }

    /// The building with other damping.
    ///
    /// # Errors
    /// See [`Damping::ratios`].
    pub fn with_damping(mut self, damping: &Damping) -> Result<Self, BuildingError> {
        let periods_s: Vec<f64> = self.modes.iter().map(Mode::period_s).collect();
        let ratios = damping.ratios(&periods_s)?;
        for (mode, ratio) in self.modes.iter_mut().zip(ratios) {
            mode.damping_ratio = ratio;
        }
        Ok(self)
    }

    /// The building with all periods multiplied by `period_factor` and all damping ratios by
    /// `damping_factor`; the shapes stay. Factors of 1 change nothing.
    ///
    /// # Errors
    /// A fundamental period above [`MAX_PERIOD_S`], a factor that is not positive and finite, or
    /// damping that is not below critical.
    ///
    /// # Example
    /// ```
    /// use freestand::building::Building;
    /// let building = Building::beam(0.65, 0.05, 5.0, 3)?.with_factors(1.2, 0.5)?;
    /// assert!((building.period_s() - 0.78).abs() < 1e-12 && building.damping_ratio() == Some(0.025));
    /// # Ok::<(), freestand::building::BuildingError>(())
    /// ```
    pub fn with_factors(
        mut self,
        period_factor: f64,
        damping_factor: f64,
    ) -> Result<Self, BuildingError> {
        for (i, mode) in self.modes.iter_mut().enumerate() {
            let (period_s, damping_ratio) = (
                mode.period_s * period_factor,
                mode.damping_ratio * damping_factor,
            );
            check_period(period_s)?;
            if !(0.0..1.0).contains(&damping_ratio) {
                return Err(BuildingError::ModeDamping {
                    mode: i + 1,
                    damping_ratio,
                });
            }
            (mode.period_s, mode.damping_ratio) = (period_s, damping_ratio);
        }
        Ok(self)
    }
}

fn check_period(period_s: f64) -> Result<(), BuildingError> {
    if period_s > 0.0 && period_s <= MAX_PERIOD_S {
        Ok(())
    } else {
        Err(BuildingError::Period { period_s })
    }
}
