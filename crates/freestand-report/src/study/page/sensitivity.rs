//! How the result depends on single values, if that was requested.

use freestand_input::keys::KeyStyle;
use freestand_input::words::{fixed, percent};
use freestand_study::result::StudyResult;
use freestand_study::result::VariedLevel;

use super::super::sensitivity::joined_doubts;
use super::{headings, or_dash};
use crate::doubts::{no_result, not_varied};
use freestand_output::html::{Cell, classed_table, list, words};
use maud::{Markup, html};

/// A table for each level; `None`: nothing was varied.
pub(super) fn sensitivity(result: &StudyResult) -> Option<Markup> {
    let sensitivity = result.sensitivity.as_ref()?;
    let headings = headings(
        ["Changed"],
        [
            "median PFA (g)",
            "overturned",
            "overturned by half of the motions",
            "largest median (g)",
            "largest shock (g)",
            "shock ratio",
            "objects compared",
        ],
    );
    let level_table = |level: &str| {
        let rows = sensitivity.rows.iter().filter(|row| row.level == level);
        let caption = format!("Level {level}");
        classed_table("glance", &caption, &[&headings], rows.map(row))
    };
    let mut remarks: Vec<String> = Vec::new();
    // A remark belongs to a variation, not to a level: it is printed once.
    for remark in sensitivity.rows.iter().filter_map(remark) {
        if !remarks.contains(&remark) {
            remarks.push(remark);
        }
    }
    remarks.extend(sensitivity.left_out.iter().map(not_varied));
    Some(html! {
        p {
            "One value of the study is changed at a time. Ratio: the sum of the median shocks of the objects, divided \
             by the same sum for the unchanged study; objects that half or more of the motions overturn in either are \
             left out. The largest median belongs to one object and decreases when that object begins to overturn."
        }
        @for level in &result.levels { (level_table(&level.level.name)) }
        @if !remarks.is_empty() { (list(remarks.iter().map(|one| KeyStyle::Flag.shown(one)))) }
    })
}

/// Why there is no result, or the additional warnings of this change.
fn remark(row: &VariedLevel) -> Option<String> {
    let why = row
        .reason
        .as_ref()
        .map(no_result)
        .or_else(|| joined_doubts(row))?;
    Some(format!("{}: {why}", row.words()))
}

fn row(row: &VariedLevel) -> [Cell; 8] {
    let value = |value: Option<f64>, digits| or_dash(value, |v| fixed(v, digits));
    let changed = if row.value.is_empty() {
        "unchanged".to_owned()
    } else {
        row.words()
    };
    [
        words(changed),
        value(row.pfa_g_median, 3),
        or_dash(row.overturned_share, |share| percent(share, 1)),
        or_dash(row.overturned_objects, |n| n.to_string()),
        value(row.edge_acceleration_g_median, 2),
        value(row.edge_acceleration_g_max, 2),
        value(row.edge_acceleration_ratio, 2),
        or_dash(row.compared_objects, |n| n.to_string()),
    ]
}
