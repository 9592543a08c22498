//! Published numbers to compare ours with: code accelerations, fragilities, and the forces for a
//! restraint.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::code_spectrum::parts::{PartsQuestion, clause, floor_acceleration_g};
use freestand::fragility::{kaneko_hayashi_velocity_m_s, lognormal_probability};
use freestand::rocking::{Base, Restitution, rock_observed};

use crate::restraint::{RestraintAxis, RestraintQuestion, restraint_forces};
use crate::result::{AcceptedFor, FloorFacts, RestraintForce};
use freestand_input::words::number;

use super::Context;
use super::assessment::quantile;
use super::decision::percent;
use super::response::{lifts, options};
use super::trial::Trial;

/// Dispersion of the FEMA P-58 fragilities of slender unanchored contents.
const P58_BETA: f64 = 0.5;

/// Median of those fragilities over the velocity of Kaneko and Hayashi: from 0.75 to 0.81 for all
/// nine.
const P58_SHARE: f64 = 0.8;

/// Largest friction that the rocking needs; `None` where the history fails.
pub(super) fn friction_needed_ratio(block: &Block, base: Base, restitution: Restitution) -> Option<f64> {
    let mut largest = 0.0f64;
    let done = rock_observed(block, base, &options(restitution), |segment| {
        largest = largest.max(segment.friction_needed_ratio());
    });
    done.ok().map(|_| largest)
}

impl Context<'_> {
    /// Comparisons with published numbers, one sentence each.
    pub(super) fn comparisons(&self, trial: &Trial, facts: &FloorFacts) -> Vec<String> {
        let mut lines = Vec::new();
        if let (Some(target), Some(building)) = (self.study.ground.code_spectrum(), &self.study.building) {
            let question = PartsQuestion {
                level_ratio: facts.level_ratio,
                building_height_m: Some(building.height_m),
                building_period_s: Some(building.along.period_s()),
            };
            let code_g = floor_acceleration_g(&target.spectrum, &question);
            if let (Some(code_g), Some(clause)) = (code_g, clause(&target.spectrum)) {
                lines.push(format!(
                    "The code requires {} g for a rigid part on this floor ({clause}); the median PFA of the motions \
                     is {} g.",
                    number(code_g, 3),
                    number(facts.pfa_g_median, 3)
                ));
            }
        }
        if trial.lived.iter().any(|one| one.rigid.as_ref().is_ok_and(|axes| lifts(axes))) {
            let slender = trial.subject.axes.iter().map(|axis| kaneko_hayashi_velocity_m_s(&axis.block));
            let median_m_s = P58_SHARE * slender.fold(f64::INFINITY, f64::min);
            let p = lognormal_probability(facts.pfv_m_s_median, median_m_s, P58_BETA);
            lines.push(format!(
                "By the rule that the FEMA P-58 medians for unanchored contents follow (0.8 of the overturning \
                 velocity of Kaneko and Hayashi, recalled; β {P58_BETA}), an object of this shape has a median PFV \
                 of {} m/s. At the median PFV of this floor, {} m/s, it overturns with a probability of {}.",
                number(median_m_s, 3),
                number(facts.pfv_m_s_median, 3),
                percent(p)
            ));
        }
        let thresholds = trial.subject.axes.iter().map(|axis| axis.block.pivot().slenderness_angle_rad.tan());
        lines.push(format!(
            "Uplift begins at {} g; the largest PFA of its floor is {} g.",
            number(thresholds.fold(f64::INFINITY, f64::min), 3),
            number(facts.pfa_g_max, 3)
        ));
        lines
    }

    /// The forces for a restraint; none where the mass is not given.
    pub(super) fn restraint(&self, trial: &Trial) -> Vec<RestraintForce> {
        let member = trial.member;
        // The floor acceleration that all worlds but the accepted share do not exceed: the largest
        // grows with their number.
        let pfa = trial.lived.iter().map(|one| one.pfa_m_s2 / G0_M_S2);
        let floor_g = quantile(pfa, 1.0 - member.accepted_ratio);
        let Some(mass_kg) = member.item.mass_kg else { return Vec::new() };
        let axes = trial.subject.axes.iter().map(|axis| RestraintAxis {
            axis: axis.axis,
            base_m: axis.block.base_width_m(),
            weight_lever_m: axis.block.cg_from_right_m(),
        });
        let building = self.study.building.as_ref();
        restraint_forces(&RestraintQuestion {
            mass_kg,
            height_m: trial.subject.axes.first().map_or(0.0, |axis| axis.height_m),
            cg_height_m: trial.subject.axes.first().map_or(0.0, |axis| axis.block.cg_height_m()),
            axes: axes.collect(),
            level_ratio: trial.subject.level_ratio,
            building_height_m: building.map(|building| building.height_m),
            building_period_s: building.map(|building| building.along.period_s()),
            spectrum: self.study.ground.code_spectrum().map(|target| target.spectrum.clone()),
            floor_acceleration_g: Some(floor_g),
            is_critical: member.accepted_for == AcceptedFor::LifeSafety,
            settings: self.study.assessment.restraint,
        })
    }
}
