//! The key figures of each level.

use freestand::G0_M_S2;
use freestand::rocking::{Accuracy, Outcome};
use freestand_output::answer;

use crate::result::{LevelResult, ObjectResponse, Ranked, StudyResult};
use crate::statistics::ranked_quantile;
use crate::study::Study;

answer! {
    /// The key figures of one level.
    pub struct LevelSummary {
        /// Name of the level.
        level: String,
        /// Height as a share of the building's, if it is known.
        level_ratio: Option<f64>,
        /// Median over the motions of the peak floor acceleration.
        pfa_g_median: Option<f64>,
        /// Histories on this level: objects × motions.
        histories: usize,
        /// Histories that failed.
        failed: usize,
        /// Share of the histories in which the object uplifts.
        uplift_share: f64,
        /// Share of the histories in which the object overturns.
        overturned_share: f64,
        /// Objects whose median shock exceeds the study's tolerance, or that half or more of the motions overturn;
        /// missing without a tolerance.
        exceeded_objects: Option<usize>,
        /// Objects that half or more of the motions overturn.
        overturned_objects: usize,
        /// Largest shock of any history without overturning.
        edge_acceleration_g_max: Option<f64>,
        /// Largest median shock over the motions, of all objects whose median is a number.
        edge_acceleration_g_median: Option<f64>,
        /// Largest shock from the impact velocity of any history without overturning.
        edge_acceleration_impact_velocity_g_max: Option<f64>,
        /// The same median, of the shock from the impact velocity.
        edge_acceleration_impact_velocity_g_median: Option<f64>,
    }
}

/// The key figures of every level.
pub fn level_summaries(study: &Study, result: &StudyResult) -> Vec<LevelSummary> {
    result
        .levels
        .iter()
        .map(|level| level_summary(level, study.objects.tolerance_m_s2))
        .collect()
}

/// The key figures of a level; `tolerance_m_s2` is the study's.
pub fn level_summary(level: &LevelResult, tolerance_m_s2: Option<f64>) -> LevelSummary {
    let mut pfa_g: Vec<f64> = level
        .floors
        .iter()
        .map(|floor| floor.peak_m_s2() / G0_M_S2)
        .collect();
    let rows = || level.responses.iter().flatten();
    let done = || rows().filter_map(ObjectResponse::done);
    let histories = rows().count();
    let count = |holds: &dyn Fn(Outcome) -> bool| {
        done()
            .filter(|(uplift, _)| holds(uplift.rocking.outcome))
            .count()
    };
    let calculated = done().count();
    let share = |n: usize| n as f64 / calculated.max(1) as f64;
    let statistics = || level.statistics.iter().flatten();
    let largest = |values: &mut dyn Iterator<Item = f64>| values.reduce(f64::max);

    LevelSummary {
        level: level.level.name.clone(),
        level_ratio: level.level.level_ratio,
        pfa_g_median: ranked_quantile(&mut pfa_g, 0.5).value(),
        histories,
        failed: histories - calculated,
        uplift_share: share(count(&|o| o != Outcome::NoUplift)),
        overturned_share: share(count(&|o| o.has_fallen())),
        exceeded_objects: tolerance_m_s2.map(|tolerance| {
            statistics()
                .filter(|s| s.exceeds(tolerance / G0_M_S2))
                .count()
        }),
        overturned_objects: statistics()
            .filter(|s| s.edge_acceleration_g[1] == Ranked::Overturned)
            .count(),
        edge_acceleration_g_max: largest(
            &mut done().filter_map(|(_, shock)| shock.edge_acceleration_g),
        ),
        edge_acceleration_g_median: largest(
            &mut statistics().filter_map(|s| s.edge_acceleration_g[1].value()),
        ),
        edge_acceleration_impact_velocity_g_max: largest(
            &mut done().filter_map(|(_, shock)| shock.edge_acceleration_impact_velocity_g),
        ),
        edge_acceleration_impact_velocity_g_median: largest(
            &mut statistics().filter_map(|s| s.edge_acceleration_impact_velocity_g[1].value()),
        ),
    }
}

/// An accuracy in outputs.
pub fn accuracy_words(accuracy: Accuracy) -> String {
    accuracy
        .name()
        .map_or_else(|| accuracy.tolerance().to_string(), str::to_owned)
}
