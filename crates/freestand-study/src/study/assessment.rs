//! How an inventory is assessed: worlds, accepted probabilities, uncertainties, restraint.

use std::path::PathBuf;

use freestand::decision::Looks;
use freestand::worlds::RESTITUTION_SPREAD;

use crate::target::Target;

/// The resolved settings of `[assessment]`, `[worlds]` and `[restraint]`. Every default is an
/// assumption and is reported as one.
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
    /// What is asked of every object; `None`: what its row and its ratings ask.
    pub questions: Option<Questions>,
    /// Whether the rates of falling and of exceedance per year are calculated too.
    pub is_annual: bool,
    /// Seed of the draws.
    pub seed: u64,
    /// The worlds.
    pub worlds: WorldSettings,
    /// How uncertain the values of an object are.
    pub spread: Spread,
    /// Lowest and highest damping ratio of pads of which only the stiffness is known: in a world it
    /// lies anywhere between, its logarithm uniform.
    pub pad_damping_ratio: (f64, f64),
    /// Measured over calculated peak acceleration of an edge on the compliant base.
    pub compliant_factor: f64,
    /// Lowest and highest friction under objects for which none is given.
    pub friction_ratio: (f64, f64),
    /// Largest compression of a pad, as a share of its thickness.
    pub pad_strain_ratio: f64,
    /// Whether objects on pads are also calculated on a compliant base.
    pub compliant: bool,
    /// Whether the walls and neighbours of a list count.
    pub walls: WallUse,
    /// Whether objects with mass, pads and width move in three dimensions.
    pub dimensions: Dimensions,
    /// Largest number of objects with a page in the report: the most urgent ones.
    pub pages: usize,
    /// How forces for restraints are calculated.
    pub restraint: RestraintSettings,
    /// The code of the forces, where the motions are by no code.
    pub restraint_code: Option<Target>,
}

/// What is asked of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Questions {
    /// Whether it falls.
    Falls,
    /// Whether it falls, and whether a shock exceeds its tolerance.
    FallsAndShock,
}

impl Questions {
    /// Every value with the name that studies and inventories use.
    pub const ALL: [(&'static str, Self); 2] =
        [("falls", Self::Falls), ("falls+shock", Self::FallsAndShock)];
}

/// What becomes of the walls and neighbours of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum WallUse {
    /// They count.
    AsListed,
    /// Every object is free-standing.
    Ignore,
}

impl WallUse {
    /// Every value with the name that studies use.
    pub const ALL: [(&'static str, Self); 2] =
        [("as-listed", Self::AsListed), ("ignore", Self::Ignore)];
}

/// In how many dimensions objects move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimensions {
    /// In a plane, about one axis at a time.
    Planar,
    /// In three dimensions, where mass, pads and width are known.
    Three,
}

impl Dimensions {
    /// Every value with the name that studies use.
    pub const ALL: [(&'static str, Self); 2] = [("planar", Self::Planar), ("3d", Self::Three)];

    /// The name in studies and outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Planar => "planar",
            Self::Three => "3d",
        }
    }
}

/// The accepted probabilities, given the study's earthquake.
///
/// ASCE 7-16, tables 1.3-2 and 1.3-3, aims at 10, 5 and 2.5 % for a collapse in the rarer MCE_R, and
/// at 25, 15 and 9 % for ordinary members; at two thirds of that intensity a fall that may kill
/// should be a few times rarer (recalled). An assumption until the owner sets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accepted {
    /// Of an object without ratings.
    pub other_ratio: f64,
    /// Of an object without ratings that falls with less than [`SMALL_ITEM_J`].
    pub small_item_ratio: f64,
    /// By the rating of life safety: high, medium, low.
    pub life_safety_ratio: [f64; 3],
    /// By the rating of the loss of function.
    pub function_ratio: [f64; 3],
    /// By the rating of the loss of property.
    pub property_ratio: [f64; 3],
}

impl Accepted {
    /// One probability for all objects.
    pub const fn all(ratio: f64) -> Self {
        let ratios = [ratio; 3];
        Self {
            other_ratio: ratio,
            small_item_ratio: ratio,
            life_safety_ratio: ratios,
            function_ratio: ratios,
            property_ratio: ratios,
        }
    }
}

/// m g z_cg below which an unrated object is a small item, such as a monitor \[J\].
pub const SMALL_ITEM_J: f64 = 100.0;

/// Standard deviation of the logarithm of the building's periods where its period was measured.
pub const MEASURED_PERIOD_SPREAD: f64 = 0.05;

/// How worlds are drawn, and how many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorldSettings {
    /// Standard deviation of ln Sa at one period, before its mean over 0.2 s to 3 s is taken out.
    pub spectral_spread: f64,
    /// Standard deviation of the logarithm of the intensity.
    pub intensity_spread: f64,
    /// Correlation between the two horizontal components.
    pub component_correlation: f64,
    /// The spectrum of y divided by that of x: below 1 where the target is that of the direction
    /// with the largest response.
    pub component_ratio: f64,
    /// Horizontal components: 1 or 2.
    pub components: u32,
    /// Standard deviation of the logarithm of the building's periods.
    pub period_spread: f64,
    /// Standard deviation of the logarithm of the building's damping.
    pub damping_spread: f64,
    /// When worlds are looked at.
    pub looks: Looks,
    /// Whether it is calculated what the answers depend on; `None`: for short inventories.
    pub shares: Option<bool>,
}

/// Standard deviations of the logarithms of uncertain values of an object (roughly their
/// coefficients of variation), each drawn lognormally about the value of the inventory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Of logit L, where L = 1 − r² is the share of the energy that an impact takes.
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
    /// Peak accelerations on the compliant base against measurement.
    pub compliant: f64,
}

/// How forces for restraints are calculated; `None`: the value of each code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestraintSettings {
    /// Share of the weight that holds the object down.
    pub dead_load_ratio: f64,
    /// Ω₀: factor on the force of anchors in concrete.
    pub overstrength_ratio: Option<f64>,
    /// Amplification of the part: a_p, a_c, and C_AR where [`Self::resonance_ratio`] is `None`.
    pub amplification_ratio: Option<f64>,
    /// Reduction for the ductility of the part: R_p, R_c, q_a, and R_po where
    /// [`Self::strength_ratio`] is `None`.
    pub response_ratio: Option<f64>,
    /// C_AR of ASCE 7-22.
    pub resonance_ratio: Option<f64>,
    /// R_po of ASCE 7-22.
    pub strength_ratio: Option<f64>,
    /// R_μ of ASCE 7-22, of the building.
    pub building_ductility_ratio: Option<f64>,
    /// Importance of the part.
    pub importance_ratio: Option<f64>,
    /// Height of a bracket \[m\]; `None`: 0.9 of the object's height.
    pub bracket_height_m: Option<f64>,
    /// Distance of the anchors from the edge that they hold down, measured inwards \[m\]; `None`: it
    /// is assumed.
    pub anchor_inset_m: Option<f64>,
    /// What holds the object.
    pub bracket: Bracket,
}

/// A bracket, by its stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bracket {
    /// The object moves with the floor: its period is below 0.06 s.
    Rigid,
    /// The period of the object on it is not known.
    Flexible,
}

impl Bracket {
    /// Every value with its name.
    pub const ALL: [(&'static str, Self); 2] =
        [("rigid", Self::Rigid), ("flexible", Self::Flexible)];
}

impl Default for WorldSettings {
    fn default() -> Self {
        Self {
            spectral_spread: 0.65,
            intensity_spread: 0.15,
            component_correlation: 0.6,
            component_ratio: 1.0,
            components: 2,
            period_spread: 0.20,
            damping_spread: 0.40,
            looks: Looks::default(),
            shares: None,
        }
    }
}

impl Default for RestraintSettings {
    fn default() -> Self {
        Self {
            dead_load_ratio: 0.9,
            overstrength_ratio: None,
            amplification_ratio: None,
            response_ratio: None,
            resonance_ratio: None,
            strength_ratio: None,
            building_ductility_ratio: None,
            importance_ratio: None,
            bracket_height_m: None,
            anchor_inset_m: None,
            bracket: Bracket::Rigid,
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            inventory: None,
            sheet: None,
            library: None,
            cushion_library: None,
            accepted: Accepted {
                other_ratio: 0.10,
                small_item_ratio: 0.20,
                life_safety_ratio: [0.02, 0.05, 0.20],
                function_ratio: [0.05, 0.10, 0.20],
                property_ratio: [0.10, 0.20, 0.20],
            },
            questions: None,
            is_annual: false,
            seed: 1,
            worlds: WorldSettings::default(),
            spread: Spread {
                restitution: RESTITUTION_SPREAD,
                stiffness: 0.15,
                mass: 0.1,
                geometry: 0.02,
                model: 0.085,
                compliant: 0.15,
            },
            pad_damping_ratio: (0.05, 0.20),
            compliant_factor: 1.15,
            friction_ratio: (0.2, 0.8),
            pad_strain_ratio: 0.5,
            compliant: true,
            walls: WallUse::AsListed,
            dimensions: Dimensions::Planar,
            pages: 200,
            restraint: RestraintSettings::default(),
            restraint_code: None,
        }
    }
}
