//! What the answer owes to its assumptions: the study again, with one value changed at a time.
//!
//! A variation is written into the study's text and resolved like any other study, so that whatever a study can say can
//! be varied, and what does not go together is refused in the same words.

mod request;

use std::path::Path;

use serde::Serialize;

use crate::error::StudyError;
use crate::rerun::with_value;
use crate::resolve::{Overrides, resolve_with};
use crate::result::StudyResult;
use crate::run::{Progress, Step, run};
use crate::study::Study;
use crate::summary::{LevelSummary, level_summary};

pub use request::{Variation, Wish, parse_wish, usual_wishes, variations};

/// One row of `vary.csv`: a level under one variation, or under the study as it is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariedLevel {
    /// The key that was changed; `base` for the study as it is.
    pub parameter: String,
    /// Its value, as a study writes it; empty for `base`.
    pub value: String,
    /// Name of the level.
    pub level: String,
    /// Height as a share of the building's, where it is known.
    pub level_ratio: Option<f64>,
    /// Median over the motions of the peak floor acceleration \[g\].
    pub pfa_g_median: Option<f64>,
    /// Share of the histories in which the object uplifts.
    pub uplift_share: Option<f64>,
    /// Share of the histories in which the object overturns.
    pub overturned_share: Option<f64>,
    /// Objects whose median over the motions is overturned.
    pub overturned_objects: Option<usize>,
    /// Largest over the objects of the median over the motions, where that is a number \[g\].
    pub edge_acceleration_g_median: Option<f64>,
    /// Largest shock of any object that survives under any motion \[g\].
    pub edge_acceleration_g_max: Option<f64>,
    /// Sum over the objects of the median shock, over the same sum of the base; of objects whose median is overturned in
    /// neither. `None` where none of them uplifts in the base.
    pub edge_acceleration_ratio: Option<f64>,
    /// How many objects these are.
    pub compared_objects: Option<usize>,
    /// Why there is no result.
    pub reason: Option<String>,
}

/// What a variation did to each level, beside the study as it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The base first, then variation by variation; in each the levels in the order of the study.
    pub rows: Vec<VariedLevel>,
    /// What could not be varied, and why: one sentence each.
    pub left_out: Vec<String>,
}

/// Runs every variation of a study whose own result is `base`. `tell` hears which one of how many begins, and what it is.
///
/// # Errors
/// A run that was stopped. A variation that the study does not allow, or that cannot be computed, is a row with its reason.
pub fn vary(
    study: &Study,
    base: &StudyResult,
    wishes: &[Wish],
    overrides: &Overrides,
    tell: &dyn Fn(usize, usize, &str),
    progress: Progress,
) -> Result<Sensitivity, StudyError> {
    let (variations, left_out) = variations(study, wishes);
    let mut rows = rows("base", "", study, base, base);
    for (index, variation) in variations.iter().enumerate() {
        tell(index, variations.len(), &variation.words());
        let varied = varied_study(study, variation, overrides).and_then(|varied| {
            let result = run(&varied, progress)?;
            Ok((varied, result))
        });
        match varied {
            Ok((varied, result)) => {
                rows.extend(self::rows(variation.key, &variation.value, &varied, &result, base));
            }
            // A stopped run stops all; what else is wrong is of this variation alone.
            Err(error) => {
                if progress(Step { stage: "variations", done: index, total: variations.len() }).is_break() {
                    return Err(error);
                }
                rows.extend(failed_rows(variation, study, &error));
            }
        }
    }
    Ok(Sensitivity { rows, left_out })
}

fn varied_study(study: &Study, variation: &Variation, overrides: &Overrides) -> Result<Study, StudyError> {
    let toml = with_value(&study.toml, variation.table, variation.key, &variation.value, variation.in_place_of)?;
    let base_dir = study.source.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
    // The seed of the command line would stand above that of the variation.
    let seed = if variation.key == "seed" { None } else { overrides.seed };
    resolve_with(&toml, study.source.as_deref(), base_dir, &Overrides { seed, ..overrides.clone() })
}

fn rows(key: &str, value: &str, study: &Study, result: &StudyResult, base: &StudyResult) -> Vec<VariedLevel> {
    let levels = result.levels.iter().zip(&base.levels);
    levels
        .map(|(level, base)| {
            let LevelSummary {
                level: name,
                level_ratio,
                pfa_g_median,
                uplift_share,
                overturned_share,
                overturned_objects,
                edge_acceleration_g_median,
                edge_acceleration_g_max,
                ..
            } = level_summary(level, study.objects.tolerance_m_s2);
            let medians = |of: &crate::result::LevelResult| -> Vec<Option<f64>> {
                of.statistics.iter().map(|s| s.as_ref().and_then(|s| s.edge_acceleration_g[1].value())).collect()
            };
            let both: Vec<(f64, f64)> =
                medians(level).into_iter().zip(medians(base)).filter_map(|(one, other)| Some((one?, other?))).collect();
            let (varied_g, base_g): (f64, f64) =
                both.iter().fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
            VariedLevel {
                parameter: key.to_owned(),
                value: value.to_owned(),
                level: name,
                level_ratio,
                pfa_g_median: pfa_g_median.is_finite().then_some(pfa_g_median),
                uplift_share: Some(uplift_share),
                overturned_share: Some(overturned_share),
                overturned_objects: Some(overturned_objects),
                edge_acceleration_g_median,
                edge_acceleration_g_max,
                edge_acceleration_ratio: (base_g > 0.0).then(|| varied_g / base_g),
                compared_objects: Some(both.len()),
                reason: None,
            }
        })
        .collect()
}

fn failed_rows(variation: &Variation, study: &Study, error: &StudyError) -> Vec<VariedLevel> {
    let reason = error.problems.first().map_or_else(|| error.to_string(), |problem| problem.message.clone());
    let row = |level: &crate::study::Level| VariedLevel {
        parameter: variation.key.to_owned(),
        value: variation.value.clone(),
        level: level.name.clone(),
        level_ratio: level.level_ratio,
        pfa_g_median: None,
        uplift_share: None,
        overturned_share: None,
        overturned_objects: None,
        edge_acceleration_g_median: None,
        edge_acceleration_g_max: None,
        edge_acceleration_ratio: None,
        compared_objects: None,
        reason: Some(reason.clone()),
    };
    study.levels.iter().map(row).collect()
}

#[cfg(test)]
mod tests;
