//! Forces on restraints.

use freestand_assess::restraint::force::RestraintForce;
use freestand_input::keys::KeyStyle;
use freestand_input::words::number;
use freestand_output::answer::Answer as _;

use super::force::{ToConfirm, to_confirm};
use super::list::RestrainListReport;
use super::report::{RestrainReport, answer};
use super::words::{DESIGN_CAPACITY, assumptions, clause_words, factor_words};
use crate::table::{lines, table};

/// The forces on the restraints of a list.
pub fn restraints_text(report: &RestrainListReport) -> String {
    let cells = |row: Vec<String>| -> Vec<String> {
        row.iter().map(|cell| KeyStyle::Flag.shown(cell)).collect()
    };
    let rows: Vec<Vec<String>> = report.lines().map(cells).collect();
    let mut text = table(&report.headings(), &rows);
    text.push_str(&format!(
        "\n{} of {} objects have a force\n",
        report.held(),
        rows.len()
    ));
    if let Some(source) = report.provenance() {
        text.push_str(&format!("the hazard is from {source}\n"));
    }
    if report.has_capacity() {
        text.push_str(&format!("\n{DESIGN_CAPACITY}\n"));
    }
    text.push_str(&open_text(&report.to_confirm, &report.assumptions()));
    for problem in report.problems() {
        text.push_str(&format!(
            "in the list: {}\n",
            KeyStyle::Flag.shown(&problem)
        ));
    }
    if let Some(path) = &report.sheet_path {
        text.push_str(&format!("\nto print: {path}\n"));
    }
    text
}

/// What an engineer must confirm, and what was assumed.
fn open_text(to_confirm: &[ToConfirm], assumptions: &[String]) -> String {
    let confirm = |open: &ToConfirm| {
        let value = if open.value.is_empty() {
            String::new()
        } else {
            format!(" (used: {})", open.value)
        };
        format!("an engineer must confirm: {}{value}\n", open.what)
    };
    let mut text = String::new();
    if !to_confirm.is_empty() {
        text.push('\n');
        text.extend(to_confirm.iter().map(confirm));
    }
    if !assumptions.is_empty() {
        text.push('\n');
        text.extend(
            assumptions
                .iter()
                .map(|assumption| format!("assumed: {}\n", KeyStyle::Flag.shown(assumption))),
        );
    }
    text
}

/// The force on the restraint of one object.
pub fn restraint_text(report: &RestrainReport) -> String {
    let case = &report.case;
    let mut text = format!("{}\n\n{}\n", answer(case), lines(&report.facts()));
    let source = &case.own.source;
    let rows: Vec<Vec<String>> = source
        .factors
        .iter()
        .map(|one| factor_words(source, one).to_vec())
        .collect();
    text.push_str(&table(&["factor", "value", "who says so"], &rows));
    if !case.others.is_empty() {
        let headings = [
            "for comparison",
            "force",
            "force/weight",
            "tension of an edge",
            "in concrete",
        ];
        let units = case.request.units;
        let other = |force: &RestraintForce| {
            vec![
                clause_words(&force.source),
                units.force(force.force_n),
                number(force.force_ratio(), 3),
                units.force(force.anchor_tension_n),
                units.force(force.anchor_tension_concrete_n),
            ]
        };
        let rows: Vec<Vec<String>> = case.others.iter().map(other).collect();
        text.push('\n');
        text.push_str(&table(&headings, &rows));
    }
    if case.request.anchors.chosen.is_some() {
        text.push_str(&format!("\n{DESIGN_CAPACITY}\n"));
    }
    text.push_str(&open_text(
        &to_confirm(&case.own.source),
        &assumptions(case),
    ));
    if let Some(path) = &report.sheet_path {
        text.push_str(&format!("\nto print: {path}\n"));
    }
    text
}
