//! Forces on restraints.

use freestand_assess::restrain::{RestrainListReport, RestrainReport, ToConfirm};
use freestand_input::keys::KeyStyle;
use freestand_output::answer::Answer as _;

use crate::table::{lines, table};

/// The forces on the restraints of a list.
pub fn restraints_text(report: &RestrainListReport) -> String {
    let headings = [
        "row",
        "object",
        "force",
        "force/weight",
        "tension of an edge",
        "in concrete",
    ];
    let cells = |row: &[String; 6]| row.each_ref().map(|cell| KeyStyle::Flag.shown(cell));
    let rows: Vec<Vec<String>> = report.lines.iter().map(|row| cells(row).to_vec()).collect();
    let mut text = table(&headings, &rows);
    text.push_str(&format!(
        "\n{} of {} objects have a force\n",
        report.held,
        report.lines.len()
    ));
    text.push_str(&open_text(&report.to_confirm, &report.assumptions));
    for problem in &report.problems {
        text.push_str(&format!("in the list: {}\n", KeyStyle::Flag.shown(problem)));
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
    let mut text = format!("{}\n\n{}\n", report.answer, lines(&report.facts()));
    let rows: Vec<Vec<String>> = report.factors.iter().map(|row| row.to_vec()).collect();
    text.push_str(&table(&["factor", "value", "who says so"], &rows));
    if !report.others.is_empty() {
        let headings = [
            "for comparison",
            "force",
            "force/weight",
            "tension of an edge",
            "in concrete",
        ];
        let rows: Vec<Vec<String>> = report.others.iter().map(|row| row.to_vec()).collect();
        text.push('\n');
        text.push_str(&table(&headings, &rows));
    }
    text.push_str(&open_text(&report.to_confirm, &report.assumptions));
    if let Some(path) = &report.sheet_path {
        text.push_str(&format!("\nto print: {path}\n"));
    }
    text
}
