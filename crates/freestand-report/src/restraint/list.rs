//! What `freestand restrain` answers for a list: a row for each object.

use freestand_assess::restrain::{Case, HeldItem, HeldList};
use freestand_input::problem::Problem;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::number;
use freestand_inventory::console_lines;
use freestand_output::answer::Answer;
use freestand_output::facts::table;
use freestand_output::table::Table;
use freestand_output::{answer, answer_of};

use super::force::{ToConfirm, to_confirm};
use super::words::{assumption, clause_words, doubt_words, not_held, provenance};

/// The forces of all objects of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainListReport {
    pub(super) held: HeldList,
    /// Where the sheets were written; whoever writes them says so.
    pub sheet_path: Option<String>,
    /// What an engineer must confirm, of all objects.
    pub(super) to_confirm: Vec<ToConfirm>,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// What there is to tell of the forces of a list.
pub fn restrain_list_report(held: HeldList) -> RestrainListReport {
    let mut unread = Vec::new();
    for case in cases(&held) {
        for open in to_confirm(&case.own.source) {
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
        sheet_path: None,
    }
}

fn cases(held: &HeldList) -> impl Iterator<Item = &Case> {
    held.objects
        .iter()
        .flat_map(|one| one.found.iter().map(Box::as_ref))
}

impl RestrainListReport {
    /// Objects with a force.
    pub(super) fn held(&self) -> usize {
        cases(&self.held).count()
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

    /// Where the hazard was read, how far away and how far it can be trusted.
    pub(super) fn provenance(&self) -> Option<String> {
        provenance(self.held.target.as_ref())
    }

    /// Whether an anchor was chosen.
    pub(super) fn has_capacity(&self) -> bool {
        self.held.anchors.chosen.is_some()
    }

    /// The headings of [`Self::lines`].
    pub(super) fn headings(&self) -> Vec<&'static str> {
        let mut headings = vec![
            "row",
            "object",
            "force",
            "force/weight",
            "tension of an edge",
            "in concrete",
        ];
        headings.extend(self.has_capacity().then_some("demand/capacity"));
        headings
    }

    /// The rows in words: row, object, force, its share of the weight, tension of an edge, the same in
    /// concrete, and demand over capacity where an anchor was chosen; or the reason.
    pub(super) fn lines(&self) -> impl Iterator<Item = Vec<String>> {
        let (units, columns) = (self.held.units, self.headings().len());
        let objects = self.held.objects.iter();
        objects.map(move |one| {
            let mut line = line(one, units);
            line.resize(columns, String::new());
            line
        })
    }

    /// The objects as rows.
    pub(super) fn rows(&self) -> impl Iterator<Item = ListRow> {
        self.held.objects.iter().map(row)
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
    /// Where the sheets were written.
    sheet: Option<String> = report.sheet_path.clone();
});

answer! {
    /// An object of the list: its force, or the reason why it has none.
    pub struct ListRow {
        id: String,
        item: String,
        row: usize,
        quantity: usize,
        floor: Option<String>,
        room: Option<String>,
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
        /// Of one anchor in concrete: tension over capacity, and that of the shear added.
        demand_capacity_ratio: Option<f64>,
        bracket_height_m: Option<f64>,
        bracket_force_n: Option<f64>,
        /// Why it has no force.
        reason: Option<String>,
    }
}

fn row(one: &HeldItem) -> ListRow {
    let case = one.found.as_ref().ok();
    let force = case.map(|case| &case.own);
    let each = case.map(|case| case.each_anchor());
    let named = |name: &String| Some(name.clone()).filter(|name| !name.is_empty());
    ListRow {
        id: one.id.clone(),
        item: one.item.clone(),
        row: one.row,
        quantity: one.quantity,
        floor: named(&one.floor),
        room: named(&one.room),
        level_ratio: one.level_ratio,
        component: case.and_then(|case| Some(case.question.object.component?.name)),
        clause: force.map(|force| clause_words(&force.source)),
        force_n: force.map(|force| force.force_n),
        force_ratio: force.map(|force| force.force_ratio()),
        acts_at_height_m: case.map(|case| case.question.object.cg_height_m),
        axis: force.and_then(|force| Some(force.axis.as_ref()?.axis.name())),
        anchor_inset_m: force.map(|force| force.inset_m()),
        anchor_tension_n: force.map(|force| force.anchor_tension_n),
        anchor_tension_concrete_n: force.map(|force| force.anchor_tension_concrete_n),
        tension_of_each_n: each.map(|each| each.tension_n),
        tension_concrete_of_each_n: each.map(|each| each.tension_concrete_n),
        shear_of_each_n: each.map(|each| each.shear_n),
        demand_capacity_ratio: case.and_then(|case| case.demand_capacity_ratio()),
        bracket_height_m: force.map(|force| force.bracket_height_m),
        bracket_force_n: force.map(|force| force.bracket_force_n),
        reason: one.found.as_ref().err().map(not_held),
    }
}

/// The id and the name of an object.
pub(super) fn name(one: &HeldItem) -> String {
    if one.item.is_empty() {
        one.id.clone()
    } else {
        format!("{} {}", one.id, one.item)
    }
}

/// `0.62`, `1.2 (not enough)`, `0.5 (shear not compared)`.
fn ratio_words(ratio: f64, case: &Case) -> String {
    let digits = number(ratio, 3);
    let has_shear = case
        .request
        .anchors
        .chosen
        .as_ref()
        .is_some_and(|anchor| anchor.shear_n.is_some());
    match (ratio > 1.0, has_shear) {
        (true, true) => format!("{digits} (not enough)"),
        (true, false) => format!("{digits} (not enough; shear not compared)"),
        (false, true) => digits,
        (false, false) => format!("{digits} (shear not compared)"),
    }
}

fn line(one: &HeldItem, units: UnitSystem) -> Vec<String> {
    let mut line = vec![one.row.to_string(), name(one)];
    match &one.found {
        Ok(case) => {
            let force = &case.own;
            line.extend([
                units.force(force.force_n),
                number(force.force_ratio(), 3),
                units.force(force.anchor_tension_n),
                units.force(force.anchor_tension_concrete_n),
            ]);
            line.extend(
                case.demand_capacity_ratio()
                    .map(|ratio| ratio_words(ratio, case)),
            );
        }
        Err(why) => line.push(not_held(why)),
    }
    line
}
