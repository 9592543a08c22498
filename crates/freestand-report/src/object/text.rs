//! What becomes of one object.

use freestand_input::quantity::UnitSystem;
use freestand_output::answer::Answer as _;

use super::report::{ObjectReport, Scaled};
use crate::table::{lines, table};

/// The unit of uplifts, and of the headings of the table by scale.
fn scale_headings(units: UnitSystem) -> (&'static str, [&'static str; 7]) {
    let (unit, uplift) = match units {
        UnitSystem::Si => ("mm", "uplift [mm]"),
        UnitSystem::Us => ("in", "uplift [in]"),
    };
    (
        unit,
        [
            "scale",
            "median PFA [g]",
            "largest PFA [g]",
            "lift an edge",
            "overturn it",
            uplift,
            "shock [g]",
        ],
    )
}

/// A row of that table.
fn at_scale(row: &Scaled, length: &str) -> Vec<String> {
    let facts = row.facts();
    let columns = [
        ("scale_ratio", "", 0),
        ("median", "", 3),
        ("max", "", 3),
        ("motions_lifted", "", 0),
        ("motions_overturned", "", 0),
        ("uplift_m_max", length, 3),
        ("landing_acceleration_g_max", "", 3),
    ];
    columns
        .map(|(name, unit, digits)| facts.cell(name, unit, digits))
        .to_vec()
}

/// The most lines of a table below the sentence.
const MAX_ROWS: usize = 18;

/// What becomes of one object.
pub fn object_text(report: &ObjectReport, units: UnitSystem) -> String {
    let mut text = format!("{}\n\n", report.answer);
    if report.scales.is_empty() {
        text.push_str(&lines(&report.facts()));
        return text;
    }
    let (length, headings) = scale_headings(units);
    let rows: Vec<Vec<String>> = report
        .scales
        .iter()
        .take(MAX_ROWS)
        .map(|row| at_scale(row, length))
        .collect();
    text.push_str(&table(&headings, &rows));
    if report.scales.len() > MAX_ROWS {
        text.push_str(&format!(
            "and {} more: --json\n",
            report.scales.len() - MAX_ROWS
        ));
    }
    text
}
