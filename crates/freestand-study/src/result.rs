//! The result of a study: one row for each object and motion, and the statistics over all motions.

use std::sync::Arc;

use freestand::building::Mode;
use freestand::motion::Motion;
use freestand::rocking::Outcome;
use freestand::spectra::{ShockCell, UpliftCell};
use freestand::synthesis::Misfit;
use freestand_records::horizontal::HorizontalMotion;
use strum::EnumCount;

use crate::study::{Level, StudyDoubt};
use crate::target::CodeParts;

/// Everything that the outputs are written from.
#[derive(Debug, Clone)]
pub struct StudyResult {
    /// The names of the motions, in the order of the study.
    pub motions: Vec<String>,
    /// The ground motions, in the same order; none where the motions of the floors are given.
    pub ground: Vec<GroundMotion>,
    /// The building's modes, in order of decreasing period.
    pub modes: Vec<Mode>,
    /// Peak accelerations of every floor; `None` where the motions of the floors are given.
    pub profile: Option<FloorProfile>,
    /// One result for each level of the study.
    pub levels: Vec<LevelResult>,
    /// The history that is drawn, if any object uplifted.
    pub history: Option<ExampleHistory>,
    /// How the result depends on the assumptions, if that was requested.
    pub sensitivity: Option<Sensitivity>,
    /// What its reader must know: assumptions and limits of validity.
    pub doubts: Vec<StudyDoubt>,
}

/// A ground motion as used.
#[derive(Debug, Clone)]
pub struct GroundMotion {
    /// Its name in the outputs.
    pub name: String,
    /// Its samples.
    pub motion: HorizontalMotion,
    /// Its vertical component, positive upward, with the same step and length; `None` if there is
    /// none.
    pub vertical: Option<Motion>,
    /// Its 5 % spectrum.
    pub spectrum: PseudoSpectrum,
    /// How well it fits its target, if it has one.
    pub misfit: Option<Misfit>,
}

/// Pseudo-accelerations over periods; of two components, the largest over all horizontal directions
/// (RotD100).
#[derive(Debug, Clone, PartialEq)]
pub struct PseudoSpectrum {
    /// Undamped periods \[s\].
    pub periods_s: Vec<f64>,
    /// Pseudo-accelerations \[m/s²\].
    pub psa_m_s2: Vec<f64>,
}

/// Peak accelerations over the height of the building.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorProfile {
    /// Every floor as a share of the height, from the ground to the roof.
    pub levels_ratio: Vec<f64>,
    /// Peak floor accelerations, `[motion][level]`; for two components, the largest in any
    /// direction \[g\].
    pub pfa_g: Vec<Vec<f64>>,
    /// Peak floor velocities, of the floor itself and not relative to the ground, in the same shape
    /// \[m/s\].
    pub pfv_m_s: Vec<Vec<f64>>,
    /// Accelerations of a rigid part at each level by the code, if the target is a code with such a
    /// clause.
    pub code: Option<CodeParts>,
}

/// What happened on one floor.
#[derive(Debug, Clone)]
pub struct LevelResult {
    /// The floor.
    pub level: Level,
    /// Floor motions, in the order of the ground motions.
    pub floors: Vec<HorizontalMotion>,
    /// Their vertical components, in the same order; `None` where there are none.
    pub verticals: Vec<Option<Arc<Motion>>>,
    /// Their spectra, at 5 % damping.
    pub spectra: Vec<PseudoSpectrum>,
    /// `responses[motion][object]`, objects in the order of [`crate::study::Objects::blocks`].
    pub responses: Vec<Vec<ObjectResponse>>,
    /// One for each object, in the same order; `None` where every history failed.
    pub statistics: Vec<Option<ObjectStatistics>>,
}

/// One object under one motion.
#[derive(Debug, Clone)]
pub enum ObjectResponse {
    /// The history was completed.
    Done {
        /// Rocking.
        uplift: UpliftCell,
        /// Shock.
        shock: ShockCell,
        /// The governing direction \[degrees from the first component\], the first if several
        /// overturn the object; `None` if motions have one component.
        direction_deg: Option<f64>,
    },
    /// The floor fell away, g + ü_v ≤ 0, where the model ends; this says when.
    FreeFlight(String),
    /// The history failed, for this reason.
    Failed(String),
}

impl ObjectResponse {
    /// The response, where it could be calculated.
    pub fn done(&self) -> Option<(&UpliftCell, &ShockCell)> {
        match self {
            Self::Done { uplift, shock, .. } => Some((uplift, shock)),
            Self::FreeFlight(_) | Self::Failed(_) => None,
        }
    }
}

/// A quantile over motions in which an overturned object ranks above every number.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ranked {
    /// A number.
    Value(f64),
    /// The quantile falls among the motions that overturn the object.
    Overturned,
    /// Every history failed.
    NoData,
}

/// One object over all motions: no uplift counts as 0, overturning as +∞.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObjectStatistics {
    /// Height \[m\].
    pub height_m: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
    /// Motions whose histories did not fail.
    pub motions: usize,
    /// Share of the motions that uplift it, including those that overturn it.
    pub uplift_share: f64,
    /// Share of the motions that overturn it.
    pub overturned_share: f64,
    /// Uplift \[m\] at 16, 50 and 84 %.
    pub uplift_m: [Ranked; 3],
    /// Shock from the uplift \[g\] at 16, 50 and 84 %.
    pub edge_acceleration_g: [Ranked; 3],
    /// Shock from the impact velocity \[g\] at 16, 50 and 84 %.
    pub edge_acceleration_impact_velocity_g: [Ranked; 3],
    /// Median shock of the motions that do not overturn the object \[g\]; `None` if there are none.
    pub edge_acceleration_survivors_g: Option<f64>,
    /// Largest shock of the motions that do not overturn the object \[g\].
    pub edge_acceleration_max_g: Option<f64>,
    /// The uplift ceiling \[g\].
    pub ceiling_g: f64,
}

/// A rocking history for the figure.
#[derive(Debug, Clone)]
pub struct ExampleHistory {
    /// Name of the level.
    pub level: String,
    /// Name of the motion.
    pub motion: String,
    /// The direction in which it rocks \[degrees from the first component\]; `None` with one
    /// component.
    pub direction_deg: Option<f64>,
    /// Height \[m\].
    pub height_m: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
    /// α \[rad\].
    pub slenderness_angle_rad: f64,
    /// How the history ended.
    pub outcome: Outcome,
    /// Times of the samples \[s\].
    pub time_s: Vec<f64>,
    /// Floor acceleration at those times \[m/s²\].
    pub accel_m_s2: Vec<f64>,
    /// θ at those times \[rad\].
    pub theta_rad: Vec<f64>,
    /// Each impact: time \[s\] and shock from its velocity \[g\].
    pub impacts: Vec<(f64, f64)>,
}

/// One row of `vary.csv`: a level under one variation, or under the unchanged study.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedLevel {
    /// The key that was changed; `base` for the unchanged study.
    pub parameter: String,
    /// Its value, as a study writes it; empty for `base`.
    pub value: String,
    /// Name of the level.
    pub level: String,
    /// Height as a share of the building's, if it is known.
    pub level_ratio: Option<f64>,
    /// Median over the motions of the peak floor acceleration \[g\].
    pub pfa_g_median: Option<f64>,
    /// Share of the histories in which the object uplifts.
    pub uplift_share: Option<f64>,
    /// Share of the histories in which the object overturns.
    pub overturned_share: Option<f64>,
    /// Objects that half or more of the motions overturn.
    pub overturned_objects: Option<usize>,
    /// Largest median shock over the motions, of all objects whose median is a number \[g\].
    pub edge_acceleration_g_median: Option<f64>,
    /// Largest shock of any history without overturning \[g\].
    pub edge_acceleration_g_max: Option<f64>,
    /// Sum of the median shocks of the objects, divided by the same sum of the base. Objects whose
    /// median is not a number in one of the two are left out. `None` if the mean in the base is
    /// below [`MIN_MEAN_G`](crate::vary::MIN_MEAN_G).
    pub edge_acceleration_ratio: Option<f64>,
    /// Number of objects in these sums.
    pub compared_objects: Option<usize>,
    /// Why there is no result.
    pub reason: Option<NoResult>,
    /// What the reader must know that the base does not have.
    pub doubts: Vec<StudyDoubt>,
}

/// Why a change has no result.
#[derive(Debug, Clone, PartialEq, Eq, EnumCount)]
pub enum NoResult {
    /// The change does not affect the model, in which this stays the same. This is a result, not a
    /// failure.
    Unchanged(Same),
    /// The study does not allow the value, or the run failed.
    Failed(String),
}

/// What stays the same where a change does not affect the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumCount)]
pub enum Same {
    /// The modes of the building.
    Modes,
    /// The objects and their cushion.
    Objects,
    /// The motions.
    Motions,
}

impl VariedLevel {
    /// A short form for tables and axes, `α₀ 20`.
    pub fn words(&self) -> String {
        let key = match self.parameter.as_str() {
            "shear_flexure" => "α₀",
            "return_period_years" => "years",
            "hazard_factor" => "Z",
            other => other,
        };
        format!("{key} {}", self.value)
    }
}

/// What each variation did to each level, compared with the unchanged study.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The unchanged study first, then change by change; in each the levels in the order of the study.
    pub rows: Vec<VariedLevel>,
    /// What could not be varied.
    pub left_out: Vec<NotVaried>,
}

/// A key that is not varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotVaried {
    /// The key.
    pub key: &'static str,
    /// Why.
    pub why: WhyNotVaried,
}

/// Why a key is not varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumCount)]
pub enum WhyNotVaried {
    /// None of its default values changes the model.
    DefaultsChangeNothing,
    /// It has no default values in such a study.
    NoDefaults,
    /// Other motions were given in place of those of the study.
    OtherMotions,
    /// The study gives the motions of the floors.
    MotionsOfFloors,
    /// The table states the damping of every mode.
    DampingOfTable,
    /// The building comes from a table.
    BuildingOfTable,
    /// Synthetic motions follow their target.
    Synthetic,
    /// Simulated motions follow their source.
    Simulated,
    /// Simulated motions are of one magnitude and distance.
    OneEarthquake,
    /// The motions are matched records, which have no seed.
    MatchedSeed,
    /// The motions are records of a suite, which have no seed.
    SuiteSeed,
    /// The factors of a suite follow its target.
    SuiteScale,
    /// Matched records follow their target.
    MatchedScale,
    /// The motions are read from files.
    Files,
}
