//! What a study gave: one row for each object and motion, and the statistics over all motions.

use std::borrow::Cow;

use freestand::building::Mode;
use freestand::measures::cumulative_trapezoid;
use freestand::motion::{Motion, MotionError};
use freestand::rocking::Outcome;
use freestand::spectra::{ShockCell, UpliftCell};
use freestand::synthesis::Misfit;

use crate::floor::CodeParts;
use crate::records::{write_csv, write_pair_csv};
use crate::study::Level;
use crate::vary::Sensitivity;

/// Everything that the outputs are written from.
#[derive(Debug, Clone)]
pub struct StudyResult {
    /// The names of the motions, in the order of the study.
    pub motions: Vec<String>,
    /// The ground motions, in the same order; none where the motions of the floors are given.
    pub ground: Vec<GroundMotion>,
    /// The building's modes, by falling period.
    pub modes: Vec<Mode>,
    /// Peak accelerations of every floor; `None` where the motions of the floors are given.
    pub profile: Option<FloorProfile>,
    /// One result for each level of the study.
    pub levels: Vec<LevelResult>,
    /// The history that is drawn, if any object uplifted.
    pub history: Option<ExampleHistory>,
    /// What the result owes to the assumptions, where that was asked for.
    pub sensitivity: Option<Sensitivity>,
    /// What the reader must know: assumptions, doubts, validity.
    pub warnings: Vec<String>,
}

/// A ground motion as it was used.
#[derive(Debug, Clone)]
pub struct GroundMotion {
    /// Its name in the outputs.
    pub name: String,
    /// Its samples.
    pub motion: HorizontalMotion,
    /// Its 5 % spectrum.
    pub spectrum: PseudoSpectrum,
    /// How well it meets its target, where it was made for or matched to one.
    pub misfit: Option<Misfit>,
}

/// A motion in the plane of the floor: one component, or two at right angles.
#[derive(Debug, Clone, PartialEq)]
pub struct HorizontalMotion {
    /// The first component, or the only one.
    pub along: Motion,
    /// The second, of the same length and time step.
    pub across: Option<Motion>,
}

impl HorizontalMotion {
    /// The component in a direction counted from the first one towards the second \[degrees\]:
    /// `a₁ cos θ + a₂ sin θ`. Without a second component, the first whatever the direction.
    ///
    /// # Errors
    /// Samples that overflow.
    pub fn in_direction(&self, direction_deg: f64) -> Result<Cow<'_, Motion>, MotionError> {
        let Some(across) = &self.across else { return Ok(Cow::Borrowed(&self.along)) };
        if direction_deg == 0.0 {
            return Ok(Cow::Borrowed(&self.along));
        }
        if direction_deg == 90.0 {
            return Ok(Cow::Borrowed(across));
        }
        let (sin, cos) = direction_deg.to_radians().sin_cos();
        let samples = self.along.accel_m_s2().iter().zip(across.accel_m_s2()).map(|(a, b)| a * cos + b * sin);
        Motion::new(self.along.dt_s(), samples.collect()).map(Cow::Owned)
    }

    /// Largest velocity, from rest by the trapezoid rule; of two components, in whatever direction it is \[m/s\].
    pub fn peak_velocity_m_s(&self) -> f64 {
        let velocity = |motion: &Motion| cumulative_trapezoid(motion.dt_s(), motion.accel_m_s2());
        let along = velocity(&self.along);
        match self.across.as_ref().map(velocity) {
            None => along.iter().fold(0.0, |peak: f64, v| peak.max(v.abs())),
            Some(across) => along.iter().zip(&across).map(|(a, b)| a.hypot(*b)).fold(0.0, f64::max),
        }
    }

    /// As a file: `time_s,accel_m_s2`, or `time_s,along_m_s2,across_m_s2`.
    pub fn csv(&self) -> String {
        match &self.across {
            None => write_csv(&self.along),
            Some(across) => write_pair_csv(&self.along, across),
        }
    }

    /// Largest acceleration at the samples; of two components, in whatever direction it is \[m/s²\].
    pub fn peak_m_s2(&self) -> f64 {
        match &self.across {
            None => self.along.peak_m_s2(),
            Some(across) => {
                let both = self.along.accel_m_s2().iter().zip(across.accel_m_s2());
                both.map(|(a, b)| a.hypot(*b)).fold(0.0, f64::max)
            }
        }
    }
}

/// Pseudo-accelerations over periods; of two components, the largest over all horizontal directions (RotD100).
#[derive(Debug, Clone, PartialEq)]
pub struct PseudoSpectrum {
    /// Undamped periods \[s\].
    pub periods_s: Vec<f64>,
    /// Pseudo-accelerations \[m/s²\].
    pub psa_m_s2: Vec<f64>,
}

/// Peak accelerations up the height of the building.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorProfile {
    /// Every floor as a share of the height, from the ground to the roof.
    pub levels_ratio: Vec<f64>,
    /// Peak floor accelerations, `[motion][level]`; of two components, in whatever direction \[g\].
    pub pfa_g: Vec<Vec<f64>>,
    /// Peak floor velocities, of the floor itself and not relative to the ground, in the same shape \[m/s\].
    pub pfv_m_s: Vec<Vec<f64>>,
    /// What a code gives a rigid part at each level, where the target is one of a code that says it.
    pub code: Option<CodeParts>,
}

/// What happened on one floor.
#[derive(Debug, Clone)]
pub struct LevelResult {
    /// The floor.
    pub level: Level,
    /// Floor motions, in the order of the ground motions.
    pub floors: Vec<HorizontalMotion>,
    /// Their spectra, at 5 % damping.
    pub spectra: Vec<PseudoSpectrum>,
    /// `responses[motion][object]`, objects in the order of [`crate::study::Objects::blocks`].
    pub responses: Vec<Vec<ObjectResponse>>,
    /// One for each object, in the same order; `None` where no motion could be followed.
    pub statistics: Vec<Option<ObjectStatistics>>,
}

/// One object under one motion.
#[derive(Debug, Clone)]
pub enum ObjectResponse {
    /// The history was followed to its end.
    Done {
        /// Rocking.
        uplift: UpliftCell,
        /// Shock.
        shock: ShockCell,
        /// The direction that governs \[degrees from the first component\], of several that overturn the first; `None` where
        /// motions have one component.
        direction_deg: Option<f64>,
    },
    /// It could not be followed; why.
    Failed(String),
}

/// A quantile over motions in which an overturned object ranks above every number.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ranked {
    /// A number.
    Value(f64),
    /// The quantile falls among the overturned.
    Overturned,
    /// No motion could be followed.
    NoData,
}

/// One object over all motions: no uplift counts as 0, overturned as +∞.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObjectStatistics {
    /// Height \[m\].
    pub height_m: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
    /// Motions that were followed.
    pub motions: usize,
    /// Share of the motions under which it uplifts (overturned ones included).
    pub uplift_share: f64,
    /// Share of the motions under which it overturns.
    pub overturned_share: f64,
    /// Uplift \[m\] at 16, 50 and 84 %.
    pub uplift_m: [Ranked; 3],
    /// Shock from the uplift \[g\] at 16, 50 and 84 %.
    pub edge_acceleration_g: [Ranked; 3],
    /// Shock from the impact velocity \[g\] at 16, 50 and 84 %.
    pub edge_acceleration_impact_velocity_g: [Ranked; 3],
    /// Median shock of the motions that the object survives \[g\]; `None` when there are none.
    pub edge_acceleration_survivors_g: Option<f64>,
    /// Largest shock of the motions that the object survives \[g\].
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
    /// The direction in which it rocks \[degrees from the first component\]; `None` with one component.
    pub direction_deg: Option<f64>,
    /// Height \[m\].
    pub height_m: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
    /// α \[rad\].
    pub slenderness_angle_rad: f64,
    /// What happened.
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
