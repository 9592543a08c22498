//! Published numbers to compare ours with: code accelerations, fragilities, and the forces for a
//! restraint.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::code_spectrum::parts::{PartsQuestion, clause, floor_acceleration_g};
use freestand::fragility::{kaneko_hayashi_velocity_m_s, lognormal_probability};

use crate::restraint::components::Component;
use crate::restraint::{HeldObject, RestraintQuestion, restraint_forces};
use crate::result::{Axis, Comparison, FloorFacts, RestraintForce, reported_force};
use freestand_inventory::{Item, Rating};
use freestand_study::study::Study;

use super::Context;
use super::object::{AxisGeometry, Sizes};
use super::over_worlds::quantile;
use super::response::lifts;
use super::trial::Trial;

/// Dispersion of the FEMA P-58 fragilities of slender unanchored contents.
pub const P58_BETA: f64 = 0.5;

/// Median of those fragilities over the velocity of Kaneko and Hayashi: from 0.75 to 0.81 for all
/// nine.
pub const P58_SHARE: f64 = 0.8;

impl Context<'_> {
    /// Comparisons with published numbers.
    pub(super) fn comparisons(&self, trial: &Trial, facts: &FloorFacts) -> Vec<Comparison> {
        let mut found = Vec::new();
        if let (Some(target), Some(building)) =
            (self.study.ground.code_spectrum(), &self.study.building)
        {
            let question = PartsQuestion {
                level_ratio: facts.level_ratio,
                building_height_m: Some(building.height_m),
                building_period_s: Some(building.along.period_s()),
            };
            let code_g = floor_acceleration_g(&target.spectrum, &question);
            if let (Some(code_g), Some(clause)) = (code_g, clause(&target.spectrum)) {
                found.push(Comparison::CodeFloor {
                    code_g,
                    clause: clause.to_owned(),
                });
            }
        }
        if trial
            .lived
            .iter()
            .any(|one| one.on_rigid().is_some_and(|told| lifts(&told.axes)))
        {
            let slender = trial
                .subject
                .axes
                .iter()
                .map(|axis| kaneko_hayashi_velocity_m_s(&axis.block));
            let median_m_s = P58_SHARE * slender.fold(f64::INFINITY, f64::min);
            found.push(Comparison::FemaP58 {
                median_m_s,
                probability: lognormal_probability(facts.pfv_m_s_median, median_m_s, P58_BETA),
            });
        }
        let thresholds = trial
            .subject
            .axes
            .iter()
            .map(|axis| axis.block.pivot().slenderness_angle_rad.tan());
        found.push(Comparison::Uplift {
            threshold_g: thresholds.fold(f64::INFINITY, f64::min),
        });
        found
    }

    /// The forces for a restraint; none where the mass is not given.
    pub(super) fn restraint(&self, trial: &Trial) -> Vec<RestraintForce> {
        let member = trial.member;
        // The floor acceleration that all worlds but the accepted share do not exceed: the largest
        // grows with their number.
        let pfa = trial.lived.iter().map(|one| one.pfa_m_s2 / G0_M_S2);
        let floor_g = quantile(pfa, 1.0 - member.accepted_ratio);
        restraint_of(
            self.study,
            member.item,
            trial.subject.level_ratio,
            &trial.subject.axes,
            Some(floor_g),
        )
    }
}

/// The force \[N\] of the study's own code for the restraint of an object whose verdict is not to restrain it: its
/// assessment has none. `None`: the study has no code, or the mass or what else the object needs is not given.
pub fn code_force(study: &Study, item: &Item) -> Option<RestraintForce> {
    reported_force(&forces_by_sizes(study, item)).cloned()
}

/// The forces for the restraint of an object that is not followed; none where its mass or a size is not given.
pub(crate) fn forces_by_sizes(study: &Study, item: &Item) -> Vec<RestraintForce> {
    Sizes::of(item).map_or_else(
        |_| Vec::new(),
        |sizes| restraint_of(study, item, sizes.level_ratio, &sizes.axes, None),
    )
}

/// The forces for the restraint of an object of a list; none where its mass is not given.
fn restraint_of(
    study: &Study,
    item: &Item,
    level_ratio: f64,
    axes: &[AxisGeometry],
    floor_acceleration_g: Option<f64>,
) -> Vec<RestraintForce> {
    let Some(mass_kg) = item.mass_kg else {
        return Vec::new();
    };
    let blocks: Vec<(Axis, Block)> = axes.iter().map(|axis| (axis.axis, axis.block)).collect();
    let is_critical = item.consequences.life_safety == Some(Rating::High);
    let object = HeldObject::new(
        mass_kg,
        level_ratio,
        is_critical,
        Component::find(&item.item),
        &blocks,
    );
    restraint_forces(&RestraintQuestion::in_study(
        study,
        object,
        floor_acceleration_g,
    ))
}
