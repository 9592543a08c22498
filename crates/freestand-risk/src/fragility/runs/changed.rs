//! Objects that are run as an option changes them.

use std::path::PathBuf;

use freestand::cushion::Cushion;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::{number, shortest};
use freestand_study::cushion::EdgeCushion;

use freestand_inventory::{Inventory, Item};

/// What an option changes of an object; `None`: that stays.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Change {
    /// Stiffness under one edge \[N/m\].
    pub stiffness_n_m: Option<f64>,
    /// Distance between the edges in the direction of the thickness \[m\].
    pub base_thickness_m: Option<f64>,
    /// Mass \[kg\].
    pub mass_kg: Option<f64>,
}

/// An object as an option changes it.
#[derive(Debug, Clone, PartialEq)]
pub struct ChangedObject {
    /// Of the object.
    pub id: String,
    /// Of its curves, `ID/option`.
    pub curve_id: String,
    /// What changes.
    pub change: Change,
    /// The file of the options.
    pub file: PathBuf,
    /// Its line in that file, from 1.
    pub line: usize,
}

/// An object of an inventory as an option changes it.
pub(super) fn changed_item(
    changed: &ChangedObject,
    inventory: &Inventory,
) -> Result<Item, Problem> {
    let wrong = |message: String, hint: &str| {
        Problem::value(message, hint)
            .in_file(&changed.file)
            .at_line(changed.line)
    };
    let found = inventory
        .items
        .iter()
        .find(|item| item.id == changed.id)
        .ok_or_else(|| {
            let message = format!("the inventory has no object {}", shorten(&changed.id));
            wrong(message, "correct its id, or leave out the row")
        })?;
    let Change {
        stiffness_n_m,
        base_thickness_m,
        mass_kg,
    } = changed.change;
    // Feet may reach beyond the object, but not into the wall behind it.
    let reach_m = base_thickness_m
        .zip(found.thickness_m)
        .map(|(base_m, thickness_m)| 0.5 * (base_m - thickness_m));
    if let Some((reach_m, gap_m)) = reach_m
        .zip(found.surroundings.wall_gap_m)
        .filter(|(reach, gap)| reach > gap)
    {
        let message = format!(
            "the feet of {} would reach {} m beyond it, but the wall is only {} m behind it",
            shorten(&changed.id),
            number(reach_m, 3),
            shortest(gap_m)
        );
        return Err(wrong(
            message,
            "correct base_thickness, or the gap to the wall in the inventory",
        ));
    }
    let cushion = stiffness_n_m.map(Cushion::linear).transpose();
    let cushion = cushion.map_err(|error| wrong(error.to_string(), "correct the stiffness"))?;
    let cushion = cushion.map(|cushion| EdgeCushion {
        cushion,
        pad_thickness_m: None,
        notes: Vec::new(),
    });
    Ok(Item {
        id: changed.curve_id.clone(),
        cushion: cushion.or_else(|| found.cushion.clone()),
        base_thickness_m: base_thickness_m.or(found.base_thickness_m),
        mass_kg: mass_kg.or(found.mass_kg),
        ..found.clone()
    })
}
