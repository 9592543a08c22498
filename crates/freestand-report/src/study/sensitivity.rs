//! What each changed value did, for programs.

use freestand_output::answer_of;
use freestand_study::result::{Sensitivity, VariedLevel};

use crate::doubts::{no_result, not_varied, study_doubts};

answer_of!(
    /// What each variation did to each level, compared with the unchanged study.
    pub(super) struct Varied<'r>(pub(super) &'r Sensitivity) as of {
    /// The unchanged study first, then change by change; in each the levels in the order of the study.
    rows: Vec<VariedRow<'_>> = of.0.rows.iter().map(VariedRow).collect();
    /// What could not be varied, and why: one sentence each.
    left_out: Vec<String> = of.0.left_out.iter().map(not_varied).collect();
});

answer_of!(
    /// A level under a change.
    pub(super) struct VariedRow<'r>(pub(super) &'r VariedLevel) as row.0 {
    /// The key that was changed; `base` for the unchanged study.
    parameter: String;
    /// Its value, as a study writes it; empty for `base`.
    value: String;
    level: String;
    /// Height as a share of the building's, if it is known.
    level_ratio: Option<f64>;
    pfa_g_median: Option<f64>;
    uplift_share: Option<f64>;
    overturned_share: Option<f64>;
    overturned_objects: Option<usize>;
    edge_acceleration_g_median: Option<f64>;
    edge_acceleration_g_max: Option<f64>;
    /// Sum of the median shocks of the objects, divided by that of the unchanged study.
    edge_acceleration_ratio: Option<f64>;
    /// Number of objects in these sums.
    compared_objects: Option<usize>;
    /// Why there is no result.
    reason: Option<String> = row.0.reason.as_ref().map(no_result);
    /// Warnings that the unchanged study does not have.
    warnings: Option<String> = joined_doubts(row.0);
});

/// What the reader of a change must know besides, in one text.
pub(super) fn joined_doubts(row: &VariedLevel) -> Option<String> {
    (!row.doubts.is_empty()).then(|| study_doubts(&row.doubts).join("; "))
}
