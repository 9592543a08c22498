//! What nobody stated about the shaking.

use super::Overrides;
use crate::building::BuildingInput;
use crate::options::{BuildingOptions, GroundOptions};
use crate::study::{Assumed, Ground};

/// What was written, and by whom.
pub(super) struct Stated<'s> {
    pub(super) ground: &'s GroundOptions,
    pub(super) building: &'s BuildingOptions,
    pub(super) overrides: &'s Overrides,
    /// A spectrum is given, with everything that belongs to it.
    pub(super) is_spectrum: bool,
    /// Nobody chose what the built-in study states.
    pub(super) is_builtin: bool,
    pub(super) place_is_assumed: bool,
    pub(super) building_is_assumed: bool,
}

impl Stated<'_> {
    fn of_ground(&self, key: &str) -> bool {
        self.is_spectrum
            || self.overrides.hazard.get(key).is_some()
            || !self.is_builtin && self.ground.target.get(key).is_some()
    }

    fn of_building(&self, key: &str) -> bool {
        let is_over = match key {
            "storeys" => self.overrides.storeys.is_some(),
            "storey_height" => self.overrides.storey_height_m.is_some(),
            _ => false,
        };
        is_over || !self.is_builtin && self.building.words.get(key).is_some()
    }
}

/// What was assumed about the ground and the building.
pub(super) fn assumed(
    ground: Option<&Ground>,
    building: Option<&BuildingInput>,
    stated: &Stated,
) -> Vec<Assumed> {
    let of_ground = ground.map(|ground| on_ground(ground, stated));
    let of_building = building.map(|building| above(building, stated));
    of_ground.into_iter().chain(of_building).flatten().collect()
}

fn on_ground(ground: &Ground, stated: &Stated) -> Vec<Assumed> {
    let mut all = Vec::new();
    if let Some(target) = ground.code_spectrum() {
        if stated.place_is_assumed {
            all.push(Assumed::Place(target.place_name()));
        }
        if target.spectrum.site_name().is_some() && !stated.of_ground("site") {
            all.push(Assumed::Site(target.site_words()));
        }
        let years = target.return_period_years();
        let years = years.filter(|_| !stated.of_ground("return_period_years"));
        all.extend(years.map(Assumed::ReturnPeriod));
    }
    if !matches!(ground, Ground::OnFloors) && !ground.has_vertical() {
        all.push(Assumed::NoVertical);
    }
    all
}

fn above(building: &BuildingInput, stated: &Stated) -> Vec<Assumed> {
    let mut all = Vec::new();
    if stated.building_is_assumed {
        all.push(Assumed::Building(building.storeys));
    }
    let has_table = !building.tables.is_empty();
    let states_height = ["storey_height", "height"]
        .into_iter()
        .any(|key| stated.of_building(key));
    let storey_height_m = building.storey_height_m.filter(|_| !states_height);
    all.extend(storey_height_m.map(Assumed::StoreyHeight));
    if !has_table && !stated.of_building("period") {
        all.push(Assumed::FirstPeriod {
            period_s: building.along.period_s(),
            from: building.period_from,
        });
    }
    let states_damping = building.tables.iter().any(|table| table.states_damping);
    if !states_damping && !stated.of_building("damping") {
        let first = building.along.modes().first();
        let ratio = first.map_or(0.0, |mode| mode.damping_ratio());
        all.push(Assumed::Damping(ratio));
    }
    if !has_table && !stated.of_building("shear_flexure") {
        all.push(Assumed::WallsAndFrames);
    }
    all
}
