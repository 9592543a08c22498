//! What nobody stated about the shaking, in words.

use super::Overrides;
use crate::building::BuildingInput;
use crate::options::{BuildingOptions, GroundOptions};
use crate::study::{AssumedValue, Ground, StudyAssumption};
use freestand_input::words::{counted, number, percent};

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
) -> Vec<StudyAssumption> {
    let of_ground = ground
        .into_iter()
        .flat_map(|ground| on_ground(ground, stated));
    let of_building = building
        .into_iter()
        .flat_map(|building| above(building, stated));
    of_ground
        .map(|words| StudyAssumption {
            of_building: false,
            value: AssumedValue::Said(words),
        })
        .chain(of_building)
        .collect()
}

fn on_ground(ground: &Ground, stated: &Stated) -> Vec<String> {
    let mut said = Vec::new();
    if let Some(target) = ground.code_spectrum() {
        if stated.place_is_assumed {
            let place = target
                .place_name()
                .unwrap_or_else(|| "the built-in study".to_owned());
            said.push(format!("the hazard of {place}, because no place was given"));
        }
        if target.spectrum.site_name().is_some() && !stated.of_ground("site") {
            said.push(format!(
                "{}, because no site was given",
                target.site_words()
            ));
        }
        if let Some(years) = target
            .return_period_years()
            .filter(|_| !stated.of_ground("return_period_years"))
        {
            said.push(format!(
                "a return period of {years} years, because none was given"
            ));
        }
    }
    if !matches!(ground, Ground::OnFloors) && !ground.has_vertical() {
        said.push("no vertical motion".to_owned());
    }
    said
}

fn above(building: &BuildingInput, stated: &Stated) -> Vec<StudyAssumption> {
    let mut said = Vec::new();
    let plain = |words: String| StudyAssumption {
        of_building: true,
        value: AssumedValue::Said(words),
    };
    if stated.building_is_assumed {
        said.push(plain(format!(
            "a building of {}, because none was given",
            counted(building.storeys, "storey")
        )));
    }
    let has_table = !building.tables.is_empty();
    if let Some(height_m) = building.storey_height_m
        && !["storey_height", "height"]
            .into_iter()
            .any(|key| stated.of_building(key))
    {
        said.push(StudyAssumption {
            of_building: true,
            value: AssumedValue::StoreyHeight(height_m),
        });
    }
    if !has_table && !stated.of_building("period") {
        let period_s = number(building.along.period_s(), 3);
        said.push(plain(format!(
            "a first period of {period_s} s, by {}",
            building.period_note
        )));
    }
    let states_damping = building.tables.iter().any(|table| table.states_damping);
    if !states_damping && !stated.of_building("damping") {
        let ratio = building
            .along
            .modes()
            .first()
            .map_or(0.0, |mode| mode.damping_ratio());
        said.push(plain(format!(
            "{} damping of the building, which stays elastic",
            percent(ratio, 0)
        )));
    }
    if !has_table && !stated.of_building("shear_flexure") {
        said.push(plain(
            "a building of walls and frames (shear_flexure)".to_owned(),
        ));
    }
    said
}
