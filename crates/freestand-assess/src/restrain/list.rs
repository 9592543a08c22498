//! How strongly every object of a list must be held: the request of one object, row by row.

use std::path::PathBuf;

use freestand_input::problem::Problems;
use freestand_input::quantity::UnitSystem;

use super::{
    Anchors, Case, Component, ObjectKind, RestrainFactors, RestrainFloor, RestrainHazard,
    RestrainRequest, RestraintAssumption, RestraintDoubt, assumed_hazard, case_of, floor_of_list,
    restrain,
};
use crate::restraint::ASSUMED_INSET_M;
use freestand_inventory::library::Libraries;
use freestand_inventory::{
    CellsRequest, Finding, Item, Mapping, Rating, ReadOptions, inspect_inventory,
};
use freestand_study::target::Target;

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
    /// What an object is whose name is no row of the tables of ASCE 7.
    pub component: Option<String>,
    /// The anchors of each.
    pub anchors: Anchors,
    /// The units of the texts; `None`: those of the list.
    pub units: Option<UnitSystem>,
}

/// The forces of all objects of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldList {
    /// Its objects.
    pub objects: Vec<HeldItem>,
    /// The anchors of each.
    pub anchors: Anchors,
    /// The spectrum of the hazard.
    pub target: Option<Target>,
    /// The units of the texts.
    pub units: UnitSystem,
    /// What was not stated about the hazard.
    pub assumptions: Vec<RestraintAssumption>,
    /// What is wrong or doubtful in the list, by cell.
    pub findings: Vec<Finding>,
    /// The same of the list as a whole.
    pub warnings: Vec<String>,
    /// What there is to know beside the forces, once each.
    pub doubts: Vec<RestraintDoubt>,
}

/// An object of the list: its force, or the reason why it has none.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldItem {
    /// Its id.
    pub id: String,
    /// What it is.
    pub item: String,
    /// Its row in the list.
    pub row: usize,
    /// How many there are.
    pub quantity: usize,
    /// The name of its floor in the list.
    pub floor: String,
    /// Its room.
    pub room: String,
    /// Height of its floor over that of the building, where that is needed.
    pub level_ratio: Option<f64>,
    /// The force with everything that it follows from, or why there is none.
    pub found: Result<Box<Case>, NotHeld>,
}

/// Why an object has no force.
#[derive(Debug, Clone, PartialEq)]
pub enum NotHeld {
    /// It is anchored.
    Anchored,
    /// Its size or mass must be confirmed.
    Unconfirmed(Vec<String>),
    /// Another body stands on it.
    Stacked,
    /// These are not known.
    Unknown(Vec<Missing>),
    /// It cannot be calculated.
    Refused(Problems),
}

/// What a list must tell of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Missing {
    /// Its mass.
    Mass,
    /// Its height.
    Height,
    /// Its smaller horizontal size.
    Thickness,
    /// Its floor.
    Floor,
}

impl Missing {
    /// The name of its column.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// The force, moments and anchors of every object of a list; an object that has none says why.
///
/// # Errors
/// A list that cannot be read, or everything that is wrong with the request itself.
pub fn restrain_list(request: &RestrainListRequest) -> Result<HeldList, Problems> {
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
    let units = request.units.unwrap_or(reading.inventory.units);
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
        component: request.component.clone(),
        anchors: Anchors {
            // Too large a one is told of each object that it is too large for.
            inset_m: None,
            ..request.anchors.clone()
        },
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
    let probe = restrain(probe)?;
    let stated = probe.question.object.component;
    let mut assumptions = match (&request.hazard, &probe.target) {
        (RestrainHazard::Code(words), Some(target)) => assumed_hazard(words, target),
        _ => Vec::new(),
    };
    let has_inset =
        request.anchors.inset_m.is_some() || probe.question.settings.anchor_inset_m.is_some();
    let of_building = probe
        .assumptions
        .iter()
        .filter(|one| **one == RestraintAssumption::StoreyHeight);
    assumptions.extend(of_building.cloned());
    assumptions.extend((!has_inset).then_some(RestraintAssumption::Insets(ASSUMED_INSET_M)));
    let mut held = HeldList {
        objects: Vec::new(),
        anchors: request.anchors.clone(),
        target: probe.target,
        units,
        assumptions,
        findings: inventory.findings.clone(),
        warnings: inventory.warnings.clone(),
        doubts: Vec::new(),
    };
    for item in &inventory.items {
        let found = object_of(item, is_on_floor).and_then(|[mass_kg, height_m, thickness_m]| {
            let anchors = request.anchors.clone();
            let request = RestrainRequest {
                mass_kg,
                height_m,
                thickness_m,
                width_m: item.width_m,
                cg_height_m: item.cg_height_m,
                floor: at(item.level_ratio),
                anchors,
                ..like.clone()
            };
            let kind = ObjectKind {
                component: Component::find(&item.item).or(stated),
                is_critical: item.consequences.life_safety == Some(Rating::High),
                base_thickness_m: item.base_thickness_m,
                base_width_m: item.base_width_m,
            };
            case_of(request, Ok(kind))
                .map(Box::new)
                .map_err(NotHeld::Refused)
        });
        for doubt in found.iter().flat_map(|case| &case.doubts) {
            if !held.doubts.contains(doubt) {
                held.doubts.push(doubt.clone());
            }
        }
        held.objects.push(HeldItem {
            id: item.id.clone(),
            item: item.item.clone(),
            row: item.row as usize,
            quantity: item.quantity as usize,
            floor: item.floor.clone(),
            room: item.room.clone(),
            level_ratio: item.level_ratio.filter(|_| is_on_floor),
            found,
        });
    }
    Ok(held)
}

/// Mass, height and thickness of an object; or why there is no force.
fn object_of(item: &Item, is_on_floor: bool) -> Result<[f64; 3], NotHeld> {
    if item.anchored == Some(true) {
        return Err(NotHeld::Anchored);
    }
    if !item.to_confirm.is_empty() {
        return Err(NotHeld::Unconfirmed(item.to_confirm.clone()));
    }
    if item.surroundings.upper.is_some() {
        return Err(NotHeld::Stacked);
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
                (mass.is_none(), Missing::Mass),
                (height.is_none(), Missing::Height),
                (thickness.is_none(), Missing::Thickness),
                (level.is_none() && is_on_floor, Missing::Floor),
            ];
            let missing = is_missing
                .into_iter()
                .filter_map(|(is, name)| is.then_some(name));
            Err(NotHeld::Unknown(missing.collect()))
        }
    }
}
