//! How the result depends on the assumptions: the study again, with one value changed at a time.
//!
//! A change takes the place of what the study states before it is resolved like any other: so any value
//! of a study can be varied, and contradictions are refused in the same words. A change that
//! does not affect the model is not run: its row would suggest that the result does not depend on
//! the value.

mod model;
mod request;

use std::path::Path;

use crate::resolve::{Overrides, resolve_with};
use crate::result::{
    NoResult, NotVaried, Same, Sensitivity, StudyResult, VariedLevel, WhyNotVaried,
};
use crate::run::{Progress, run};
use crate::study::{Study, StudyDoubt};
use crate::summary::{LevelSummary, level_summary};
use freestand_input::problem::Problems;

pub use crate::options::Change;
use model::is_same_model;
pub use request::{Variation, changes, default_variations, parse_variation};

/// A shock ratio is computed where the mean shock of the compared objects in the base is at least
/// this \[g\]: a ratio to almost no shock is meaningless.
pub const MIN_MEAN_G: f64 = 0.05;

/// Runs the study once for every changed value; `base` is its own result. `tell` is called before
/// each run with its number, the count of runs and the change in words.
///
/// # Errors
/// A run that was stopped. A change that the study does not allow, or that cannot be computed, is a
/// row with its reason.
pub fn vary(
    study: &Study,
    base: &StudyResult,
    variations: &[Variation],
    overrides: &Overrides,
    tell: &dyn Fn(usize, usize, &str),
    progress: Progress,
) -> Result<Sensitivity, Problems> {
    let (changes, mut left_out) = changes(study, variations, overrides);
    let mut rows = rows("base", "", study, base, base);
    for (index, change) in changes.iter().enumerate() {
        tell(index, changes.len(), &change.words());
        match result_of(study, change, overrides, progress) {
            Ok(Some((varied, result))) => {
                rows.extend(self::rows(
                    change.key,
                    &change.value,
                    &varied,
                    &result,
                    base,
                ));
            }
            // The user did not ask for this value.
            Ok(None) if change.is_default => {}
            Ok(None) => rows.extend(rows_without(
                change,
                study,
                &NoResult::Unchanged(unchanged(change)),
            )),
            Err(error) if error.is_stopped() => return Err(error),
            Err(error) => {
                let first = error.problems.first();
                let reason =
                    first.map_or_else(|| error.to_string(), |problem| problem.message.clone());
                rows.extend(rows_without(change, study, &NoResult::Failed(reason)));
            }
        }
    }
    let mut defaults: Vec<&Change> = changes.iter().filter(|change| change.is_default).collect();
    defaults.dedup_by_key(|change| change.key);
    for Change { key, .. } in defaults
        .iter()
        .filter(|change| rows.iter().all(|row| row.parameter != change.key))
    {
        left_out.push(NotVaried {
            key,
            why: WhyNotVaried::DefaultsChangeNothing,
        });
    }
    Ok(Sensitivity { rows, left_out })
}

/// The study with one value changed, and its result; `None` if the change does not affect the
/// model.
fn result_of(
    study: &Study,
    change: &Change,
    overrides: &Overrides,
    progress: Progress,
) -> Result<Option<(Study, StudyResult)>, Problems> {
    let varied = varied_study(study, change, overrides)?;
    if is_same_model(study, &varied) {
        return Ok(None);
    }
    let result = run(&varied, progress)?;
    Ok(Some((varied, result)))
}

fn varied_study(study: &Study, change: &Change, overrides: &Overrides) -> Result<Study, Problems> {
    let base_dir = study
        .source
        .as_deref()
        .and_then(Path::parent)
        .unwrap_or(Path::new(""));
    // An overriding seed would take precedence over the changed one.
    let seed = if change.key == "seed" {
        None
    } else {
        overrides.seed
    };
    resolve_with(
        &study.toml,
        study.source.as_deref(),
        base_dir,
        &Overrides {
            seed,
            change: Some(change.clone()),
            ..overrides.clone()
        },
    )
}

/// What stays the same where a change does not affect the model.
fn unchanged(change: &Change) -> Same {
    match change.table {
        "building" => Same::Modes,
        "objects" => Same::Objects,
        _ => Same::Motions,
    }
}

fn rows(
    key: &str,
    value: &str,
    study: &Study,
    result: &StudyResult,
    base: &StudyResult,
) -> Vec<VariedLevel> {
    let doubts = result.doubts.iter();
    let doubts: Vec<StudyDoubt> = doubts
        .filter(|doubt| !base.doubts.contains(doubt))
        .cloned()
        .collect();
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
                of.statistics
                    .iter()
                    .map(|s| s.as_ref().and_then(|s| s.edge_acceleration_g[1].value()))
                    .collect()
            };
            let both: Vec<(f64, f64)> = medians(level)
                .into_iter()
                .zip(medians(base))
                .filter_map(|(one, other)| Some((one?, other?)))
                .collect();
            let (varied_g, base_g): (f64, f64) = both
                .iter()
                .fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
            VariedLevel {
                parameter: key.to_owned(),
                value: value.to_owned(),
                level: name,
                level_ratio,
                pfa_g_median,
                uplift_share: Some(uplift_share),
                overturned_share: Some(overturned_share),
                overturned_objects: Some(overturned_objects),
                edge_acceleration_g_median,
                edge_acceleration_g_max,
                edge_acceleration_ratio: (!both.is_empty()
                    && base_g >= MIN_MEAN_G * both.len() as f64)
                    .then(|| varied_g / base_g),
                compared_objects: Some(both.len()),
                reason: None,
                doubts: doubts.clone(),
            }
        })
        .collect()
}

fn rows_without(change: &Change, study: &Study, reason: &NoResult) -> Vec<VariedLevel> {
    let row = |level: &crate::study::Level| VariedLevel {
        parameter: change.key.to_owned(),
        value: change.value.clone(),
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
        doubts: Vec::new(),
    };
    study.levels.iter().map(row).collect()
}

#[cfg(test)]
mod tests;
