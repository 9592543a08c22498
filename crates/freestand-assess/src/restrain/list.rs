//! How strongly every object of a list must be held: the request of one object, row by row.

use std::path::PathBuf;

use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::UnitSystem;
use freestand_input::words::number;
use freestand_output::answer::Answer;
use freestand_output::facts::table;
use freestand_output::table::Table;
use freestand_output::{answer, answer_of};

use super::words::{ToConfirm, clause_words, to_confirm};
use super::{
    Component, ObjectKind, RestrainFactors, RestrainFloor, RestrainHazard, RestrainRequest,
    assumed_hazard, case_of, floor_of_list,
};
use freestand_input::words::listed;
use freestand_inventory::library::Libraries;
use freestand_inventory::{
    CellsRequest, Item, Mapping, Rating, ReadOptions, console_lines, inspect_inventory,
};

/// A list and what shakes it.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainListRequest {
    /// The list.
    pub list: PathBuf,
    /// How its cells are read.
    pub cells: CellsRequest,
    /// The hazard.
    pub hazard: RestrainHazard,
    /// The building; the list names the floors.
    pub floor: RestrainFloor,
    /// Factors that take the place of those of the code, and of the study.
    pub factors: RestrainFactors,
    /// Distance of the anchors from the edge that they hold down; `None`: that of the study, else
    /// assumed \[m\].
    pub anchor_inset_m: Option<f64>,
    /// Anchors along each of the two edges.
    pub anchors_per_edge: usize,
    /// The units of the texts; `None`: those of the list.
    pub units: Option<UnitSystem>,
}

/// The forces of all objects of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct RestrainListReport {
    rows: Vec<ListRow>,
    /// The same in words: row, object, force, its share of the weight, tension of an edge, the same in
    /// concrete; or the reason.
    pub lines: Vec<[String; 6]>,
    /// Objects with a force.
    pub held: usize,
    /// What was not stated about the hazard, a sentence each.
    pub assumptions: Vec<String>,
    /// What an engineer must confirm, of all objects.
    pub to_confirm: Vec<ToConfirm>,
    /// What is wrong or doubtful in the list.
    pub problems: Vec<String>,
    /// Warnings.
    pub warnings: Vec<String>,
}

answer_of!(RestrainListReport as report {
    objects: usize = report.rows.len();
    /// Objects with a force.
    held: usize = report.held;
    /// What was not stated about the hazard.
    assumptions: Vec<String> = report.assumptions.clone();
    /// What an engineer must confirm.
    to_confirm: Vec<&ToConfirm> = report.to_confirm.iter().collect();
    /// What is wrong or doubtful in the list.
    problems: Vec<String> = report.problems.clone();
    rows: Vec<ListRow> = report.rows.clone();
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

impl RestrainListReport {
    /// The rows as `restraint.csv`.
    ///
    /// # Errors
    /// A row that has no place in a table.
    pub fn table(&self) -> Result<Table, Problem> {
        table(self.rows.iter().map(Answer::facts))
    }
}

/// The force, moments and anchors of every object of a list; an object that has none says why.
///
/// # Errors
/// A list that cannot be read, or everything that is wrong with the request itself.
pub fn restrain_list(request: &RestrainListRequest) -> Result<RestrainListReport, Problems> {
    let floors = floor_of_list(&request.hazard, &request.floor)?;
    let settings = match &request.hazard {
        RestrainHazard::Study(study) => {
            [&study.assessment.library, &study.assessment.cushion_library].map(Option::as_deref)
        }
        RestrainHazard::Code(_) | RestrainHazard::FloorAcceleration(_) => [None, None],
    };
    let libraries = Libraries::with_files(settings[0], settings[1])?;
    let mapping = request
        .cells
        .columns
        .as_deref()
        .map(Mapping::load)
        .transpose()?;
    let reading = libraries.looked_up(|lookup| {
        let options = ReadOptions {
            sheet: request.cells.sheet.as_deref(),
            mapping: mapping.as_ref(),
            floors,
            edits: &request.cells.edits,
            ..ReadOptions::new(lookup)
        };
        inspect_inventory(&request.list, &options)
    })?;
    let inventory = &reading.inventory;
    let units = request.units.unwrap_or(reading.units);
    // What is wrong with the code or a factor is wrong for every object: it is told once.
    let like = RestrainRequest {
        mass_kg: 1.0,
        height_m: 1.0,
        thickness_m: 1.0,
        width_m: None,
        cg_height_m: None,
        hazard: request.hazard.clone(),
        floor: RestrainFloor {
            level_ratio: None,
            name: None,
            ..request.floor.clone()
        },
        factors: request.factors,
        component: None,
        anchor_inset_m: None,
        anchors_per_edge: request.anchors_per_edge,
        units,
        is_compared: false,
    };
    let is_on_floor = !matches!(request.hazard, RestrainHazard::FloorAcceleration(_));
    let at = |level_ratio: Option<f64>| {
        let level_ratio = level_ratio.filter(|_| is_on_floor);
        RestrainFloor {
            level_ratio,
            ..like.floor.clone()
        }
    };
    let probe = RestrainRequest {
        floor: at(Some(0.0)),
        ..like.clone()
    };
    let probe = case_of(probe, Ok(ObjectKind::default()))?;
    let assumptions = match (&request.hazard, &probe.target) {
        (RestrainHazard::Code(words), Some(target)) => assumed_hazard(words, target),
        _ => Vec::new(),
    };
    let mut report = RestrainListReport {
        rows: Vec::new(),
        lines: Vec::new(),
        held: 0,
        assumptions,
        to_confirm: Vec::new(),
        problems: console_lines(&inventory.findings),
        warnings: inventory.warnings.clone(),
    };
    for item in &inventory.items {
        let found = object_of(item, is_on_floor).and_then(|[mass_kg, height_m, thickness_m]| {
            let anchor_inset_m = request.anchor_inset_m;
            let request = RestrainRequest {
                mass_kg,
                height_m,
                thickness_m,
                width_m: item.width_m,
                cg_height_m: item.cg_height_m,
                floor: at(item.level_ratio),
                anchor_inset_m,
                ..like.clone()
            };
            let kind = ObjectKind {
                component: Component::find(&item.item),
                is_critical: item.consequences.life_safety == Some(Rating::High),
                base_thickness_m: item.base_thickness_m,
                base_width_m: item.base_width_m,
            };
            case_of(request, Ok(kind)).map_err(|problems| {
                problems
                    .into_iter()
                    .map(|problem| problem.message)
                    .collect::<Vec<_>>()
                    .join("; ")
            })
        });
        let (case, reason) = match found {
            Ok(case) => (Some(case), None),
            Err(reason) => (None, Some(reason)),
        };
        for warning in case.iter().flat_map(|case| &case.warnings) {
            if !report.warnings.contains(warning) {
                report.warnings.push(warning.clone());
            }
        }
        for open in case.iter().flat_map(|case| to_confirm(&case.own)) {
            if !report.to_confirm.contains(&open) {
                report.to_confirm.push(open);
            }
        }
        let force = case.as_ref().map(|case| &case.own.force);
        let per_anchor = |edge_n: f64| edge_n / request.anchors_per_edge as f64;
        report.held += usize::from(case.is_some());
        report.rows.push(ListRow {
            id: item.id.clone(),
            item: item.item.clone(),
            row: item.row as usize,
            quantity: item.quantity as usize,
            level_ratio: item.level_ratio.filter(|_| is_on_floor),
            component: case
                .as_ref()
                .and_then(|case| case.question.object.component)
                .map(|row| row.name),
            clause: case.as_ref().map(|case| clause_words(&case.own)),
            force_n: force.map(|force| force.force_n),
            force_ratio: force.map(|force| force.force_ratio),
            acts_at_height_m: case.as_ref().map(|case| case.question.object.cg_height_m),
            axis: case
                .as_ref()
                .and_then(|case| case.own.axis.as_ref())
                .map(|axis| axis.axis.name()),
            anchor_inset_m: case.as_ref().map(|case| case.own.inset_m),
            anchor_tension_n: force.map(|force| force.anchor_tension_n),
            anchor_tension_concrete_n: force.map(|force| force.anchor_tension_concrete_n),
            tension_of_each_n: force.map(|force| per_anchor(force.anchor_tension_n)),
            tension_concrete_of_each_n: force
                .map(|force| per_anchor(force.anchor_tension_concrete_n)),
            shear_of_each_n: case.as_ref().map(|case| case.anchor_shear_n()),
            bracket_height_m: force.map(|force| force.bracket_height_m),
            bracket_force_n: force.map(|force| force.bracket_force_n),
            reason: reason.clone(),
        });
        let [held, share, tension, concrete] = match (force, reason) {
            (Some(force), _) => [
                units.force(force.force_n),
                number(force.force_ratio, 3),
                units.force(force.anchor_tension_n),
                units.force(force.anchor_tension_concrete_n),
            ],
            (None, reason) => [
                reason.unwrap_or_default(),
                String::new(),
                String::new(),
                String::new(),
            ],
        };
        let name = if item.item.is_empty() {
            item.id.clone()
        } else {
            format!("{} {}", item.id, item.item)
        };
        report
            .lines
            .push([item.row.to_string(), name, held, share, tension, concrete]);
    }
    Ok(report)
}

/// Mass, height and thickness of an object; or why there is no force.
fn object_of(item: &Item, is_on_floor: bool) -> Result<[f64; 3], String> {
    if item.anchored == Some(true) {
        return Err("it is anchored already".to_owned());
    }
    if !item.to_confirm.is_empty() {
        return Err(format!(
            "its size or mass must be confirmed: {}",
            item.to_confirm.join(", ")
        ));
    }
    if item.surroundings.upper.is_some() {
        return Err("another body stands on it, which is not counted".to_owned());
    }
    match (
        item.mass_kg,
        item.height_m,
        item.thickness_m,
        item.level_ratio,
    ) {
        (Some(mass_kg), Some(height_m), Some(thickness_m), level)
            if level.is_some() || !is_on_floor =>
        {
            Ok([mass_kg, height_m, thickness_m])
        }
        (mass, height, thickness, level) => {
            let is_missing = [
                (mass.is_none(), "mass"),
                (height.is_none(), "height"),
                (thickness.is_none(), "thickness"),
                (level.is_none() && is_on_floor, "floor"),
            ];
            let names: Vec<&str> = is_missing
                .into_iter()
                .filter_map(|(is, name)| is.then_some(name))
                .collect();
            let verb = if names.len() == 1 { "is" } else { "are" };
            Err(format!("its {} {verb} not known", listed(&names)))
        }
    }
}
