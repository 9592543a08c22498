//! How an inventory is assessed: what is accepted, what is uncertain and by how much, how far one goes.

use std::path::PathBuf;

/// The settings of `[assessment]` as meant. Every default is an assumption and is reported as one.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// The inventory that the study names.
    pub inventory: Option<PathBuf>,
    /// Its sheet; `None`: the first that is one.
    pub sheet: Option<String>,
    /// The user's tolerance library, over the built-in one.
    pub library: Option<PathBuf>,
    /// The user's cushion library, over the built-in one.
    pub cushion_library: Option<PathBuf>,
    /// Probability of being overturned, or of a criterion exceeded, that is accepted.
    pub accepted: Accepted,
    /// Seed of the draws.
    pub seed: u64,
    /// Draws of the uncertain values for each motion, at first.
    pub draws: u32,
    /// Draws for each motion, at most.
    pub most_draws: u32,
    /// How uncertain the values are.
    pub spread: Spread,
    /// Friction under objects of which nobody says it, lowest and highest.
    pub friction_ratio: (f64, f64),
    /// Compression of a pad over its thickness, at most.
    pub pad_strain_ratio: f64,
    /// Damping of a pad of which only the stiffness is known, on the compliant base: a spring alone would give back what no pad does.
    pub pad_damping_ratio: f64,
    /// Whether objects near the line are tried on a compliant base.
    pub compliant: bool,
    /// Whether objects that are far from the line on the spectra of their floor get no histories of their own.
    pub screen: bool,
    /// Pages of the report: the most urgent objects.
    pub pages: usize,
}

/// The accepted probabilities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accepted {
    /// Where no consequence is rated high.
    pub other_ratio: f64,
    /// Life safety rated high.
    pub life_safety_ratio: f64,
    /// Property loss rated high.
    pub property_ratio: f64,
    /// Functional loss rated high.
    pub function_ratio: f64,
}

/// Standard deviations of the logarithms of uncertain values (about their coefficients of variation), each drawn lognormally
/// about the value of the inventory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Restitution of the motion; nothing above 0.99 is drawn.
    pub restitution: f64,
    /// Stiffness; an entry of the cushion library brings its own.
    pub stiffness: f64,
    /// Mass.
    pub mass: f64,
    /// Sides of the base and height of the centre of gravity, each on its own.
    pub geometry: f64,
    /// Eq. (5) against measurement: Table I has a coefficient of variation of 0.085, five tests of one cabinet.
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
            seed: 1,
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
