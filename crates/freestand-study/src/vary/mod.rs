//! What the answer owes to its assumptions: the study again, with one value changed at a time.
//!
//! A variation is written into the study's text and resolved like any other study, so that whatever a study can say can
//! be varied, and what does not go together is refused in the same words. A value that never reaches the model is not run:
//! a row of zero sensitivity would be read as one.

mod model;
mod request;

use crate::result::{Sensitivity, VariedLevel};
use std::path::Path;

use crate::rerun::with_value;
use crate::resolve::{Overrides, resolve_with};
use crate::result::StudyResult;
use crate::run::{Progress, Step, run};
use crate::study::Study;
use crate::summary::{LevelSummary, level_summary};
use freestand_input::problem::Problems;

use model::is_same_model;
pub use request::{Variation, Wish, parse_wish, usual_wishes, variations};

/// Begins the reason of a row whose value does not reach the model: that is an answer, not a failure.
pub const NOTHING_CHANGES: &str = "nothing changes";

/// Least mean shock of the compared objects in the base for a ratio \[g\]: less is no shock to speak of, and a ratio to it
/// is a number without a meaning.
pub const LEAST_MEAN_G: f64 = 0.05;

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
) -> Result<Sensitivity, Problems> {
    let (variations, mut left_out) = variations(study, wishes, overrides);
    let mut rows = rows("base", "", study, base, base);
    for (index, variation) in variations.iter().enumerate() {
        tell(index, variations.len(), &variation.words());
        match result_of(study, variation, overrides, progress) {
            Ok(Some((varied, result))) => {
                rows.extend(self::rows(variation.key, &variation.value, &varied, &result, base));
            }
            // Nobody named this value.
            Ok(None) if variation.is_usual => {}
            Ok(None) => {
                rows.extend(rows_without(variation, study, &format!("{NOTHING_CHANGES}: {}", unchanged(variation))))
            }
            // A stopped run stops all; what else is wrong is of this variation alone.
            Err(error) => {
                if progress(Step { stage: "variations", done: index, total: variations.len() }).is_break() {
                    return Err(error);
                }
                let first = error.problems.first();
                let reason = first.map_or_else(|| error.to_string(), |problem| problem.message.clone());
                rows.extend(rows_without(variation, study, &reason));
            }
        }
    }
    let mut usual: Vec<&Variation> = variations.iter().filter(|variation| variation.is_usual).collect();
    usual.dedup_by_key(|variation| variation.key);
    for Variation { key, .. } in usual.iter().filter(|usual| rows.iter().all(|row| row.parameter != usual.key)) {
        left_out.push(format!("{key} is not varied: none of its usual values changes anything here"));
    }
    Ok(Sensitivity { rows, left_out })
}

/// The study with one value changed, and its result; `None` where the value does not reach the model.
fn result_of(
    study: &Study,
    variation: &Variation,
    overrides: &Overrides,
    progress: Progress,
) -> Result<Option<(Study, StudyResult)>, Problems> {
    let varied = varied_study(study, variation, overrides)?;
    if is_same_model(study, &varied) {
        return Ok(None);
    }
    let result = run(&varied, progress)?;
    Ok(Some((varied, result)))
}

fn varied_study(study: &Study, variation: &Variation, overrides: &Overrides) -> Result<Study, Problems> {
    let toml = with_value(&study.toml, variation.table, variation.key, &variation.value, variation.in_place_of)?;
    let base_dir = study.source.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
    // The seed of the command line would stand above that of the variation.
    let seed = if variation.key == "seed" { None } else { overrides.seed };
    resolve_with(&toml, study.source.as_deref(), base_dir, &Overrides { seed, ..overrides.clone() })
}

/// What a value that does not reach the model leaves alone.
fn unchanged(variation: &Variation) -> &'static str {
    match variation.table {
        "building" => "the same modes of the building",
        "objects" => "the same objects and their cushion",
        _ => "the same spectrum and seed, or the same records",
    }
}

fn rows(key: &str, value: &str, study: &Study, result: &StudyResult, base: &StudyResult) -> Vec<VariedLevel> {
    let warnings: Vec<&str> =
        result.warnings.iter().filter(|warning| !base.warnings.contains(warning)).map(String::as_str).collect();
    let warnings = (!warnings.is_empty()).then(|| warnings.join("; "));
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
                edge_acceleration_ratio: (!both.is_empty() && base_g >= LEAST_MEAN_G * both.len() as f64)
                    .then(|| varied_g / base_g),
                compared_objects: Some(both.len()),
                reason: None,
                warnings: warnings.clone(),
            }
        })
        .collect()
}

fn rows_without(variation: &Variation, study: &Study, reason: &str) -> Vec<VariedLevel> {
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
        reason: Some(reason.to_owned()),
        warnings: None,
    };
    study.levels.iter().map(row).collect()
}

#[cfg(test)]
mod tests;
