//! The results of a study.

use freestand_input::words::counted;
use freestand_study::result::{Sensitivity, VariedLevel};
use freestand_study::summary::LevelSummary;

use crate::doubts::{no_result, not_varied};
use crate::table::{optional, table};

/// The levels of a study, and how long it took.
pub fn levels_text(levels: &[LevelSummary], motions: usize, seconds: f64) -> String {
    let criterion = levels.iter().any(|level| level.exceeded_objects.is_some());
    let rows: Vec<Vec<String>> = levels
        .iter()
        .map(|level| {
            let mut row = vec![
                level.level.clone(),
                optional(level.pfa_g_median, 3, ""),
                format!("{:.1} %", 100.0 * level.uplift_share),
                format!("{:.1} %", 100.0 * level.overturned_share),
                optional(level.edge_acceleration_g_median, 3, ""),
                optional(level.edge_acceleration_g_max, 3, ""),
                level.failed.to_string(),
            ];
            row.extend(level.exceeded_objects.map(|objects| objects.to_string()));
            row
        })
        .collect();
    let mut headings = vec![
        "level",
        "median PFA g",
        "uplift",
        "overturned",
        "largest median shock g",
        "largest shock g",
        "failed",
    ];
    headings.extend(criterion.then_some("objects above tolerance"));
    let histories: usize = levels.iter().map(|level| level.histories).sum();
    let (motions, histories) = (
        counted(motions, "motion"),
        counted(histories, "rocking history"),
    );
    format!(
        "{}\n{motions}, {histories}, {seconds:.1} s\n",
        table(&headings, &rows)
    )
}

/// The variations at the highest level; `vary.csv` has those of all levels.
pub fn sensitivity_text(sensitivity: &Sensitivity) -> String {
    let height = |row: &VariedLevel| row.level_ratio.unwrap_or(-1.0);
    let Some(highest) = sensitivity
        .rows
        .iter()
        .max_by(|a, b| height(a).total_cmp(&height(b)))
    else {
        return String::new();
    };
    let rows: Vec<Vec<String>> = sensitivity
        .rows
        .iter()
        .filter(|row| row.level == highest.level)
        .map(|row| {
            let changed = match &row.reason {
                _ if row.value.is_empty() => "unchanged".to_owned(),
                None => format!("{} = {}", row.parameter, row.value),
                Some(why) => format!("{} = {}: {}", row.parameter, row.value, no_result(why)),
            };
            vec![
                changed,
                optional(row.pfa_g_median, 3, ""),
                row.overturned_share
                    .map_or_else(|| "-".to_owned(), |share| format!("{:.1} %", 100.0 * share)),
                optional(row.edge_acceleration_g_median, 3, ""),
                optional(row.edge_acceleration_ratio, 3, ""),
            ]
        })
        .collect();
    let headings = [
        "changed",
        "median PFA g",
        "overturned",
        "largest median shock g",
        "shock ratio",
    ];
    let mut text = format!(
        "\n{}, one value changed at a time:\n{}",
        highest.level,
        table(&headings, &rows)
    );
    text.push_str(
        "shock ratio: sum of the median shocks divided by that of the unchanged study, without objects that overturn in either\n",
    );
    for left_out in &sensitivity.left_out {
        text.push_str(&not_varied(left_out));
        text.push('\n');
    }
    text
}
