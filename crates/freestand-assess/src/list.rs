//! The list of an assessment: where it is, how it is read, and what its study says about its floors.

use std::path::Path;

use freestand_input::problem::{Problem, Problems};
use freestand_input::words::{counted, number};
use freestand_inventory::library::{Libraries, Lookup};
use freestand_inventory::{CellsRequest, Floors, Inventory, Mapping, ReadOptions, read_inventory};
use freestand_study::study::Study;

/// Reads the inventory at `path`, or the one that the study names, with the libraries that the
/// study names.
///
/// # Errors
/// No inventory, or all problems of a library or an inventory.
pub fn inventory_of(
    study: &Study,
    path: Option<&Path>,
    request: &ListRequest,
) -> Result<Inventory, Problems> {
    let settings = &study.assessment;
    let Some(path) = path.or(settings.inventory.as_deref()) else {
        let hint = "give `inventory = \"objects.csv\"`, or put it into the table [assessment] of the study; \
                    freestand inventory template prints an inventory to fill in";
        return Err(Problem::value("there is no inventory to assess", hint).into());
    };
    let libraries = Libraries::with_files(
        settings.library.as_deref(),
        settings.cushion_library.as_deref(),
    )?;
    let mapping = request
        .cells
        .columns
        .as_deref()
        .map(Mapping::load)
        .transpose()?;
    let read = |lookup: &Lookup| {
        let options = ReadOptions {
            sheet: request.cells.sheet.as_deref().or(settings.sheet.as_deref()),
            mapping: mapping.as_ref(),
            floors: floors_of(study, request.storeys),
            is_strict: request.is_strict,
            edits: &request.cells.edits,
            wants_cells: false,
            lookup,
        };
        read_inventory(path, &options)
    };
    let mut inventory = libraries.looked_up(read)?;
    let mapped = mapping
        .as_ref()
        .map_or("", |mapping| mapping.sha256.as_str());
    let storeys = request
        .storeys
        .map_or_else(String::new, |storeys| storeys.to_string());
    inventory.read_with = format!(
        "mapping {mapped}; storeys {storeys}; anchored {}",
        request.assess_anchored
    );
    for edit in &request.cells.edits {
        inventory
            .read_with
            .push_str(&format!("; {}", serde_json::Value::from(edit.to_string())));
    }
    if request.assess_anchored {
        inventory
            .items
            .iter_mut()
            .for_each(|item| item.anchored = None);
    }
    let Libraries {
        tolerances,
        cushions,
    } = libraries;
    inventory.libraries = tolerances
        .inputs
        .into_iter()
        .chain(cushions.inputs)
        .collect();
    inventory
        .warnings
        .extend(other_storeys(study, request.storeys));
    inventory
        .warnings
        .extend(tolerances.warnings.into_iter().chain(cushions.warnings));
    Ok(inventory)
}

/// A number of storeys places floors; the building that shakes is that of the study all the same.
fn other_storeys(study: &Study, storeys: Option<usize>) -> Option<String> {
    let building = study.building.as_ref()?;
    let asked = storeys.filter(|asked| *asked != building.storeys)?;
    Some(format!(
        "`storeys = {asked}` only places the floors of the list: the building that shakes has {}, {} m high; give \
         a study with your building",
        counted(building.storeys, "storey"),
        number(building.height_m, 4)
    ))
}

/// How the list of an assessment is read, beside what the study says.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ListRequest {
    /// How its cells are read.
    pub cells: CellsRequest,
    /// Number of storeys, in place of the study's.
    pub storeys: Option<usize>,
    /// Every doubt is an error.
    pub is_strict: bool,
    /// Objects that are reported as anchored are assessed as if they were free.
    pub assess_anchored: bool,
}

/// What a study says about the floors of its building.
pub fn floors_of(study: &Study, storeys: Option<usize>) -> Floors {
    let building = study.building.as_ref();
    // Levels whose motions are given are floors by their names.
    let measured = study
        .levels
        .iter()
        .filter(|level| !level.motions.is_empty());
    let named = measured.filter_map(|level| Some((level.name.clone(), level.level_ratio?)));
    let table = study.floors.iter().flat_map(|floor| {
        floor
            .names
            .iter()
            .map(|name| (name.clone(), floor.level_ratio))
    });
    Floors {
        named: table.chain(named).collect(),
        storeys: storeys.or(building.map(|building| building.storeys)),
        height_m: building.map(|building| building.height_m),
        first_floor: study.first_floor,
    }
}
