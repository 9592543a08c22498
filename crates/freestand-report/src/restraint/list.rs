//! What `freestand restrain` answers for a list: a row for each object.

use freestand_assess::restrain::{HeldForce, HeldItem, HeldList};
use freestand_input::problem::Problem;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::number;
use freestand_inventory::console_lines;
use freestand_output::answer::Answer;
use freestand_output::facts::table;
use freestand_output::table::Table;
use freestand_output::{answer, answer_of};

use super::words::{ToConfirm, assumption, clause_words, doubt_words, not_held, to_confirm};

/// The forces of all objects of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainListReport {
    held: HeldList,
    /// What an engineer must confirm, of all objects.
    pub(super) to_confirm: Vec<ToConfirm>,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// What there is to tell of the forces of a list.
pub fn restrain_list_report(held: HeldList) -> RestrainListReport {
    let mut unread = Vec::new();
    for force in forces(&held) {
        for open in to_confirm(&force.demand) {
            if !unread.contains(&open) {
                unread.push(open);
            }
        }
    }
    let doubts = held.doubts.iter().map(doubt_words);
    RestrainListReport {
        warnings: held.warnings.iter().cloned().chain(doubts).collect(),
        to_confirm: unread,
        held,
    }
}

fn forces(held: &HeldList) -> impl Iterator<Item = &HeldForce> {
    held.objects.iter().flat_map(|one| &one.found)
}

impl RestrainListReport {
    /// Objects with a force.
    pub(super) fn held(&self) -> usize {
        forces(&self.held).count()
    }

    /// What was not stated about the hazard, a sentence each.
    pub(super) fn assumptions(&self) -> Vec<String> {
        let words = |one| assumption(one, self.held.units, 0.0);
        self.held.assumptions.iter().map(words).collect()
    }

    /// What is wrong or doubtful in the list.
    pub(super) fn problems(&self) -> Vec<String> {
        console_lines(&self.held.findings)
    }

    /// The rows in words: row, object, force, its share of the weight, tension of an edge, the same in
    /// concrete; or the reason.
    pub(super) fn lines(&self) -> impl Iterator<Item = [String; 6]> {
        let units = self.held.units;
        self.held.objects.iter().map(move |one| line(one, units))
    }

    fn rows(&self) -> impl Iterator<Item = ListRow> {
        let anchors = self.held.anchors_per_edge as f64;
        self.held.objects.iter().map(move |one| row(one, anchors))
    }

    /// The rows as `restraint.csv`.
    ///
    /// # Errors
    /// A row that has no place in a table.
    pub fn table(&self) -> Result<Table, Problem> {
        let rows: Vec<ListRow> = self.rows().collect();
        table(rows.iter().map(Answer::facts))
    }
}

answer_of!(RestrainListReport as report {
    objects: usize = report.held.objects.len();
    /// Objects with a force.
    held: usize = report.held();
    /// What was not stated about the hazard.
    assumptions: Vec<String> = report.assumptions();
    /// What an engineer must confirm.
    to_confirm: Vec<&ToConfirm> = report.to_confirm.iter().collect();
    /// What is wrong or doubtful in the list.
    problems: Vec<String> = report.problems();
    rows: Vec<ListRow> = report.rows().collect();
});

answer! {
    /// An object of the list: its force, or the reason why it has none.
    pub struct ListRow {
        id: String,
        item: String,
        row: usize,
        quantity: usize,
        level_ratio: Option<f64>,
        /// The row of the table of components of the code.
        component: Option<&'static str>,
        clause: Option<String>,
        force_n: Option<f64>,
        /// Of its weight.
        force_ratio: Option<f64>,
        acts_at_height_m: Option<f64>,
        /// The axis across which it tips.
        axis: Option<&'static str>,
        anchor_inset_m: Option<f64>,
        /// Along one edge.
        anchor_tension_n: Option<f64>,
        anchor_tension_concrete_n: Option<f64>,
        tension_of_each_n: Option<f64>,
        tension_concrete_of_each_n: Option<f64>,
        shear_of_each_n: Option<f64>,
        bracket_height_m: Option<f64>,
        bracket_force_n: Option<f64>,
        /// Why it has no force.
        reason: Option<String>,
    }
}

fn row(one: &HeldItem, anchors_per_edge: f64) -> ListRow {
    let found = one.found.as_ref().ok();
    let demand = found.map(|found| &found.demand);
    let force = demand.map(|demand| &demand.force);
    ListRow {
        id: one.id.clone(),
        item: one.item.clone(),
        row: one.row,
        quantity: one.quantity,
        level_ratio: one.level_ratio,
        component: found.and_then(|found| found.component).map(|row| row.name),
        clause: demand.map(clause_words),
        force_n: force.map(|force| force.force_n),
        force_ratio: force.map(|force| force.force_ratio),
        acts_at_height_m: found.map(|found| found.cg_height_m),
        axis: demand.and_then(|demand| Some(demand.axis.as_ref()?.axis.name())),
        anchor_inset_m: demand.map(|demand| demand.inset_m),
        anchor_tension_n: force.map(|force| force.anchor_tension_n),
        anchor_tension_concrete_n: force.map(|force| force.anchor_tension_concrete_n),
        tension_of_each_n: force.map(|force| force.anchor_tension_n / anchors_per_edge),
        tension_concrete_of_each_n: force
            .map(|force| force.anchor_tension_concrete_n / anchors_per_edge),
        shear_of_each_n: force.map(|force| force.force_n / (2.0 * anchors_per_edge)),
        bracket_height_m: force.map(|force| force.bracket_height_m),
        bracket_force_n: force.map(|force| force.bracket_force_n),
        reason: one.found.as_ref().err().map(not_held),
    }
}

fn line(one: &HeldItem, units: UnitSystem) -> [String; 6] {
    let name = if one.item.is_empty() {
        one.id.clone()
    } else {
        format!("{} {}", one.id, one.item)
    };
    let [held, share, tension, concrete] = match &one.found {
        Ok(found) => {
            let force = &found.demand.force;
            [
                units.force(force.force_n),
                number(force.force_ratio, 3),
                units.force(force.anchor_tension_n),
                units.force(force.anchor_tension_concrete_n),
            ]
        }
        Err(why) => [not_held(why), String::new(), String::new(), String::new()],
    };
    [one.row.to_string(), name, held, share, tension, concrete]
}
