//! Fragilities.

use freestand_inventory::Inventory;
use freestand_risk::fragility::{FragilityReport, RunsReport, StudyTold};
use freestand_study::study::Study;

use crate::assessment::{head, said};
use crate::table::{Column, facts_table};

/// What is told of the study and the list of runs.
pub fn study_told(study: &Study, inventory: &Inventory) -> StudyTold {
    let told = said(study, &head::head(study, inventory));
    StudyTold {
        warnings: told.all_warnings(),
        no_study: told.no_study,
        assumed: head::silent(study, inventory),
        place_is_assumed: told.place_is_assumed,
        building_is_assumed: told.building_is_assumed,
        place_name: told.place_name,
        building_name: told.building_name,
        hazard: head::hazard(study),
        building: head::building(study),
        place: told.place,
        toml: study.toml.clone(),
    }
}

const COLUMNS: [Column; 9] = [
    ("id", "object", 0),
    ("limit_state", "limit state", 0),
    ("kind", "curve", 0),
    ("median", "median", 4),
    ("median_ci95", "95 %", 0),
    ("beta", "beta", 3),
    ("beta_ci95", "95 %", 0),
    ("lower", "none below", 4),
    ("upper", "all above", 4),
];

/// The curves by one measure, for people.
pub fn curves_text(report: &FragilityReport) -> String {
    let measure = report.table.measure.with_unit();
    format!(
        "Intensities: {measure} of the {}\n\n{}",
        report.at.name(),
        facts_table(report.rows(), &COLUMNS)
    )
}

const MEASURE_COLUMNS: [Column; 8] = [
    ("id", "object", 0),
    ("limit_state", "limit state", 0),
    ("im", "measure", 0),
    ("efficiency", "efficiency", 3),
    ("practicality", "practicality", 3),
    ("proficiency", "proficiency", 3),
    ("p_mean_period", "p mean period", 0),
    ("p_pgv_over_pga", "p PGV/PGA", 0),
];

/// Curves from runs, and how well each measure does.
pub fn runs_text(report: &RunsReport) -> String {
    let mut text = format!("{}\n", report.summary());
    for fit in &report.reports {
        text.push_str(&format!("\n{}", curves_text(fit)));
    }
    let measures = facts_table(report.measure_rows(), &MEASURE_COLUMNS);
    text.push_str(&format!("\n{measures}"));
    text
}
