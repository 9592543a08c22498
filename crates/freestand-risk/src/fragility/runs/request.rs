//! What is run.

use std::path::PathBuf;

use std::sync::Arc;

use freestand::block::Block;
use freestand::rocking::Restitution;
use freestand_input::file::InputFile;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_grid, shorten};
use freestand_input::words::{Choices, counted};
use freestand_study::cushion::EdgeCushion;
use freestand_study::study::Study;

use super::super::FitMethod;
use super::super::hazard::HazardSource;
use super::super::measure::{At, MEASURES, Measure};
use super::{ChangedObject, FloorMotion};
use freestand_inventory::Inventory;
use freestand_inventory::library::{Confidence, Tolerance};

/// How runs are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// Every motion is scaled up.
    Incremental,
    /// Every motion is scaled to the same intensities.
    Stripes,
    /// Every motion is used once, unscaled.
    Cloud,
}

/// Methods by name.
pub const METHODS: Choices<Method> = &[
    (
        Method::Incremental,
        "ida",
        "every motion is scaled up until it overturns the object",
    ),
    (
        Method::Stripes,
        "stripes",
        "every motion is scaled to each intensity of --scales",
    ),
    (
        Method::Cloud,
        "cloud",
        "every motion is used once, unscaled",
    ),
];

/// Scales above this are marked: a motion that is scaled so far is a poor model of a stronger
/// earthquake.
pub(super) const DOUBTFUL_SCALE: f64 = 4.0;

/// The largest scale, if the user gives none.
pub const DEFAULT_MAX_SCALE: f64 = 10.0;

/// The most measures of one request.
pub(super) const MAX_MEASURES: usize = 24;

/// Measures as a list, `pfv, sa(0.5)`.
///
/// # Errors
/// An unknown measure.
pub fn measures(text: &str) -> Result<Vec<Measure>, Problem> {
    let measure = |name: &str| {
        let parsed = Measure::parse(name);
        parsed.ok_or_else(|| {
            let message = format!("\"{}\" is not an intensity measure", shorten(name.trim()));
            Problem::value(
                message,
                format!("write some of {MEASURES}, without the units"),
            )
        })
    };
    text.split(',').map(measure).collect()
}

/// `adaptive`, or levels: factors for an incremental analysis, intensities by the first measure for
/// stripes. `from:to:count` has equal ratios, because rates fall with a power of the intensity: equal
/// steps would leave the weak motions, which cause most of a rate, between two levels.
///
/// # Errors
/// A grid that cannot be read or has a value that is not above 0, or a method that has no scales.
pub fn scales(text: &str, method: Method, first: Measure) -> Result<Option<Vec<f64>>, Problem> {
    if text.trim() == "adaptive" {
        return Ok(None);
    }
    let values = match method {
        Method::Incremental => parse_grid(text, Dimension::Ratio).map_err(|problem| {
            problem.hint("write adaptive, or factors such as \"0.5:5:10\" or \"0.5, 1, 2\"")
        })?,
        Method::Stripes => first.quantities(text)?,
        Method::Cloud => {
            let hint = "leave the scales out, or give `method = \"ida\"`";
            return Err(Problem::value("a cloud uses every motion unscaled", hint).of(&["scales"]));
        }
    };
    if values.len() > MAX_LEVELS {
        let message = format!(
            "{} are too many: each is a run of every object and motion",
            counted(values.len(), "scale")
        );
        return Err(Problem::value(message, format!("give at most {MAX_LEVELS}")).of(&["scales"]));
    }
    if let Some(bad) = values.iter().find(|value| **value <= 0.0) {
        return Err(
            Problem::value(format!("{bad} is not above 0"), "give positive values").of(&["scales"]),
        );
    }
    Ok(Some(if text.contains(':') {
        in_equal_ratios(values)
    } else {
        values
    }))
}

/// As many values between the same ends, each the same factor above the one before it.
fn in_equal_ratios(values: Vec<f64>) -> Vec<f64> {
    let [from, .., to] = *values.as_slice() else {
        return values;
    };
    let last = values.len() - 1;
    let at = |i: usize| match i {
        0 => from,
        i if i == last => to,
        i => from * (to / from).powf(i as f64 / last as f64),
    };
    (0..values.len()).map(at).collect()
}

/// One object by its numbers, under motions of its floor.
#[derive(Debug, Clone)]
pub struct GivenObject {
    /// The block.
    pub block: Block,
    /// Restitution of its impacts.
    pub restitution: Restitution,
    /// Mass \[kg\] and the cushion under one edge, for the shock.
    pub body: Option<(f64, EdgeCushion)>,
    /// What it withstands.
    pub limits: Limits,
    /// The motions.
    pub motions: Vec<FloorMotion>,
    /// Whether the object is on the ground, so that its motions are ground motions.
    pub is_on_ground: bool,
}

/// What an object withstands.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Peak acceleration of a landing \[m/s²\].
    pub peak_m_s2: Option<f64>,
    /// Duration of the half-sine with that peak \[s\].
    pub duration_s: Option<f64>,
    /// Velocity change \[m/s\].
    pub velocity_change_m_s: Option<f64>,
    /// Uplift of the free edge \[m\].
    pub edge_lift_m: Option<f64>,
}

impl Limits {
    pub(super) fn tolerance(&self) -> Tolerance {
        let Self {
            peak_m_s2,
            duration_s,
            velocity_change_m_s,
            edge_lift_m,
        } = *self;
        let (source, confidence) = ("the user".to_owned(), Confidence::Stated);
        Tolerance {
            peak_m_s2,
            duration_s,
            velocity_change_m_s,
            edge_lift_m,
            source,
            confidence,
        }
    }
}

/// The objects of runs.
#[derive(Debug, Clone)]
pub enum RunObjects {
    /// One by its numbers.
    Given(Box<GivenObject>),
    /// Those of a list on the floors of a study.
    Listed {
        /// The study.
        study: Arc<Study>,
        /// The list.
        inventory: Arc<Inventory>,
        /// How many worlds; `None`: the records of the study once each, or 40.
        worlds: Option<u32>,
        /// Objects of the list that are run as options change them, too.
        changed: Vec<ChangedObject>,
    },
}

/// The id of an object that is given by its numbers.
pub(crate) const GIVEN_ID: &str = "object";

/// Where the finished runs of an inventory are kept until the results are written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeepRuns {
    /// The folder of the results.
    pub folder: PathBuf,
    /// Whether runs of an earlier command in the same folder are used.
    pub resume: bool,
    /// Whether files in the folder that freestand did not write are replaced.
    pub force: bool,
}

/// What is run and fitted.
#[derive(Debug, Clone)]
pub struct RunsRequest {
    /// The objects.
    pub objects: RunObjects,
    /// Measures; empty: `pfv` of given motions, `pgv` of a study.
    pub measures: Vec<Measure>,
    /// Where spectral accelerations are taken; `None`: at the ground where it is known.
    pub at: Option<At>,
    /// How runs are chosen.
    pub method: Method,
    /// Scales of an incremental analysis, or intensities of stripes; `None`: adaptive.
    pub scales: Option<Vec<f64>>,
    /// The largest scale.
    pub max_scale_ratio: f64,
    /// The hazard by the first measure, for which stripes get as many intensities as its rates need.
    pub hazard: Option<HazardSource>,
    /// Longitude and latitude of the site, for a hazard file with several \[degrees\].
    pub site_deg: Option<(f64, f64)>,
    /// Whether these coordinates are those of exported objects, too.
    pub site_is_exported: bool,
    /// Rotation over α beyond which a tolerance is exceeded.
    pub rotation_ratio: Option<f64>,
    /// How limit states are fitted.
    pub fit: FitMethod,
    /// Bootstrap samples; `None`: 1000, 0: none.
    pub replicates: Option<u32>,
    /// Seed of the bootstrap.
    pub seed: u64,
    /// The files that it was made from, for the document.
    pub inputs: Vec<InputFile>,
    /// Where the finished runs of an inventory are kept; `None`: nowhere.
    pub keep: Option<KeepRuns>,
}

/// The most scales or levels of one analysis: each is a run of every object under every motion.
const MAX_LEVELS: usize = 10_000;

#[cfg(test)]
mod tests {
    use super::*;

    /// Ends as they are written, and one factor between neighbours; a list stays as it is.
    #[test]
    fn a_grid_of_levels_has_equal_ratios() {
        let levels = |text: &str| {
            scales(text, Method::Stripes, Measure::Pga)
                .unwrap()
                .unwrap()
        };
        let grid = levels("0.05 g:1.5 g:10");
        assert_eq!((grid.len(), grid[0], grid[9]), (10, 0.05, 1.5));
        let ratio = 30_f64.powf(1.0 / 9.0);
        // Rounding of two powers.
        assert!(
            grid.windows(2)
                .all(|pair| (pair[1] / pair[0] / ratio - 1.0).abs() < 1e-12),
            "{grid:?}"
        );
        assert_eq!(levels("0.1 g, 0.2 g, 0.3 g"), [0.1, 0.2, 0.3]);
        let factors = scales("0.5:2:3", Method::Incremental, Measure::Pga)
            .unwrap()
            .unwrap();
        assert_eq!(factors, [0.5, 1.0, 2.0]);
        assert!(scales("0 g:1 g:4", Method::Stripes, Measure::Pga).is_err());
    }
}
