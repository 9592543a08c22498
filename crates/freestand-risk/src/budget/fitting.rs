//! What whoever fits a restraint must know of the object and of the restraint.

use freestand_assess::portfolio::Row;
use freestand_assess::result::RestraintForce;
use freestand_assess::verdict::code_force;
use freestand_input::quantity::UnitSystem;
use freestand_inventory::library::RestraintEntry;
use freestand_study::study::Study;

/// An object of a plan as whoever fits its restraint finds it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ToFit {
    /// Its building; empty where the list has none.
    pub building: String,
    /// Its floor; may be empty.
    pub floor: String,
    /// Its room; may be empty.
    pub room: String,
    /// Where it is in other words; may be empty.
    pub location: String,
    /// Height \[m\].
    pub height_m: Option<f64>,
    /// Smaller horizontal size \[m\].
    pub thickness_m: Option<f64>,
    /// The other horizontal size \[m\].
    pub width_m: Option<f64>,
    /// Height of its centre of gravity; `None`: at half of its height \[m\].
    pub cg_height_m: Option<f64>,
    /// Mass \[kg\].
    pub mass_kg: Option<f64>,
    /// Distance to the wall \[m\].
    pub wall_gap_m: Option<f64>,
    /// Distance of anchors from the edge that they hold down, as the study states it \[m\].
    pub anchor_inset_m: Option<f64>,
    /// The force by which its anchors are designed; `None`: not known.
    pub force: Option<RestraintForce>,
    /// The place of its study, where the hazard there is approximate.
    pub approximate_place: Option<String>,
    /// The units of its list.
    pub units: UnitSystem,
}

/// What fitting a restraint to one object takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitting {
    /// Its height over that of the object; at the base this has no meaning.
    pub height_ratio: f64,
    /// How many anchors share its force; `None`: not known.
    pub anchors: Option<u16>,
    /// Its price without work, low and high, in the currency of the plan.
    pub price: [f64; 2],
    /// Work; `None`: not known \[min\].
    pub minutes: Option<f64>,
    /// What this work costs, in the currency of the plan; `None`: not known, and not in the cost.
    pub work: Option<f64>,
    /// Where the capacity comes from; may be empty.
    pub capacity_source: String,
    /// Where the prices come from, with their year.
    pub price_source: String,
    /// What whoever fits it must know; may be empty.
    pub note: String,
}

pub(super) fn to_fit(row: &Row, study: &Study, units: UnitSystem) -> ToFit {
    let item = row.item;
    let target = study.ground.code_spectrum();
    let approximate = target.and_then(|target| target.approximate_place());
    ToFit {
        building: item.building.clone(),
        floor: item.floor.clone(),
        room: item.room.clone(),
        location: item.location.clone(),
        height_m: item.height_m,
        thickness_m: item.thickness_m,
        width_m: item.width_m,
        cg_height_m: item.cg_height_m,
        mass_kg: item.mass_kg,
        wall_gap_m: item.surroundings.wall_gap_m,
        anchor_inset_m: study.assessment.restraint.anchor_inset_m,
        force: row
            .found
            .design_force()
            .cloned()
            .or_else(|| code_force(study, item)),
        approximate_place: approximate.map(|place| place.short_name()),
        units,
    }
}

/// Of a restraint whose prices are multiplied by `converted`.
pub(super) fn fitting(entry: &RestraintEntry, converted: f64) -> Fitting {
    Fitting {
        height_ratio: entry.height_ratio,
        anchors: entry.anchors,
        price: [entry.price.0, entry.price.1].map(|price| converted * price),
        minutes: entry.fitter_minutes,
        work: entry.work().map(|work| converted * work),
        capacity_source: entry.capacity_source.clone(),
        price_source: match entry.price_year.as_str() {
            "" => entry.price_source.clone(),
            year => format!("{}, {year}", entry.price_source),
        },
        note: entry.note.clone(),
    }
}
