//! How an inventory is assessed: accepted probabilities, uncertainties, effort.

use std::path::PathBuf;

/// The resolved settings of `[assessment]`. Every default is an assumption and is reported as one.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// The inventory that the study names.
    pub inventory: Option<PathBuf>,
    /// The sheet of the inventory; `None`: the first that has one.
    pub sheet: Option<String>,
    /// The user's tolerance library, which takes precedence over the built-in one.
    pub library: Option<PathBuf>,
    /// The user's cushion library, which takes precedence over the built-in one.
    pub cushion_library: Option<PathBuf>,
    /// Accepted probability of overturning or of exceeding a criterion.
    pub accepted: Accepted,
    /// Seed of the draws.
    pub seed: u64,
    /// Initial number of draws of the uncertain values for each motion.
    pub draws: u32,
    /// Largest number of draws for each motion.
    pub most_draws: u32,
    /// How uncertain the values are.
    pub spread: Spread,
    /// Lowest and highest friction under objects for which none is given.
    pub friction_ratio: (f64, f64),
    /// Largest compression of a pad, as a share of its thickness.
    pub pad_strain_ratio: f64,
    /// Damping on the compliant base of a pad of which only the stiffness is known: a spring alone
    /// would return more energy than any pad.
    pub pad_damping_ratio: f64,
    /// Whether objects with a close verdict are also computed on a compliant base.
    pub compliant: bool,
    /// Whether objects with a clear verdict by the spectra of their floor get no histories of their
    /// own.
    pub screen: bool,
    /// Largest number of objects with a page in the report: the most urgent ones.
    pub pages: usize,
}

/// The accepted probabilities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accepted {
    /// If no consequence is rated high.
    pub other_ratio: f64,
    /// If life safety is rated high.
    pub life_safety_ratio: f64,
    /// If property loss is rated high.
    pub property_ratio: f64,
    /// If functional loss is rated high.
    pub function_ratio: f64,
}

/// Standard deviations of the logarithms of uncertain values (roughly their coefficients of
/// variation), each drawn lognormally about the value of the inventory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Restitution; values above 0.99 are not drawn.
    pub restitution: f64,
    /// Stiffness; an entry of the cushion library brings its own.
    pub stiffness: f64,
    /// Mass.
    pub mass: f64,
    /// Sides of the base and height of the centre of gravity, each drawn independently.
    pub geometry: f64,
    /// Eq. (5) against measurement: Table I has a coefficient of variation of 0.085, five tests of
    /// one cabinet.
    pub model: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            inventory: None,
            sheet: None,
            library: None,
            cushion_library: None,
            accepted: Accepted { other_ratio: 0.1, life_safety_ratio: 0.1, property_ratio: 0.1, function_ratio: 0.1 },
            seed: super::DEFAULT_SEED,
            draws: 8,
            most_draws: 64,
            spread: Spread { restitution: 0.1, stiffness: 0.15, mass: 0.1, geometry: 0.02, model: 0.085 },
            friction_ratio: (0.2, 0.8),
            pad_strain_ratio: 0.5,
            pad_damping_ratio: 0.2,
            compliant: true,
            screen: false,
            pages: 200,
        }
    }
}
