//! What stands beside our own numbers: code accelerations, other people's fragilities, forces to fix an object with.

use freestand::block::Block;
use freestand::code_spectrum::parts::{PartsQuestion, clause, floor_acceleration_g};
use freestand::fragility::{kaneko_hayashi_velocity_m_s, lognormal_probability};
use freestand::motion::Motion;
use freestand::rocking::{Base, Restitution, rock_observed};

use super::Context;
use super::decision::{LIFE_SAFETY, percent};
use super::response::{lifts, options};
use super::restraint::{RestraintAxis, RestraintParameters, RestraintQuestion, restraint_forces};
use super::result::RestraintForce;
use super::verdict::Found;
use freestand_input::words::number;

/// Dispersion of the fragilities of FEMA P-58 for slender unanchored contents.
const P58_BETA: f64 = 0.5;

/// Median of those fragilities over the velocity of Kaneko and Hayashi: all nine lie at 0.75 to 0.81 of it.
const P58_SHARE: f64 = 0.8;

/// Largest friction that the rocking takes; `None` where the history cannot be followed.
pub(super) fn friction_needed_ratio(block: &Block, motion: &Motion, restitution: Restitution) -> Option<f64> {
    let base = Base { horizontal: Some(motion), vertical: None };
    let mut most = 0.0f64;
    let done = rock_observed(block, base, &options(restitution), |segment| {
        most = most.max(segment.friction_needed_ratio());
    });
    done.ok().map(|_| most)
}

impl Context<'_> {
    /// Other people's numbers, one sentence each.
    pub(super) fn beside(&self, found: &Found) -> Vec<String> {
        let facts = &found.floor.facts;
        let mut lines = Vec::new();
        if let (Some(target), Some(building)) = (self.study.ground.code_spectrum(), &self.study.building) {
            let question = PartsQuestion {
                level_ratio: facts.level_ratio,
                building_height_m: building.height_m,
                building_period_s: Some(building.along.period_s()),
            };
            let code_g = floor_acceleration_g(&target.spectrum, &question);
            if let (Some(code_g), Some(clause)) = (code_g, clause(&target.spectrum)) {
                lines.push(format!(
                    "the code gives a rigid part on this floor {} g ({clause}); the motions have a median PFA of {} g",
                    number(code_g, 3),
                    number(facts.pfa_g_median, 3)
                ));
            }
        }
        if found.followed().any(|(_, axes)| lifts(axes)) {
            let slender = found.member.subject.axes.iter().map(|axis| kaneko_hayashi_velocity_m_s(&axis.block));
            let median_m_s = P58_SHARE * slender.fold(f64::INFINITY, f64::min);
            let p = lognormal_probability(facts.pfv_m_s_median, median_m_s, P58_BETA);
            lines.push(format!(
                "an object of this shape by the rule that FEMA P-58's medians for unanchored contents follow (0.8 of the overturning \
                 velocity of Kaneko and Hayashi, recalled; β {P58_BETA}): median PFV {} m/s, {} to overturn at this floor's median PFV of {} m/s",
                number(median_m_s, 3),
                percent(p),
                number(facts.pfv_m_s_median, 3)
            ));
        }
        let thresholds = found.member.subject.axes.iter().map(|axis| axis.block.pivot().slenderness_angle_rad.tan());
        lines.push(format!(
            "it lifts off above {} g; the hardest motion of its floor has {} g",
            number(thresholds.fold(f64::INFINITY, f64::min), 3),
            number(facts.pfa_g_max, 3)
        ));
        lines
    }

    /// The forces to fix it with; none where its mass is not known.
    pub(super) fn restraint(&self, found: &Found) -> Vec<RestraintForce> {
        let (member, facts) = (found.member, &found.floor.facts);
        let Some(mass_kg) = member.item.mass_kg else { return Vec::new() };
        let axes = member.subject.axes.iter().map(|axis| RestraintAxis {
            name: axis.axis.name().to_owned(),
            base_m: axis.block.base_width_m(),
            weight_lever_m: axis.block.cg_from_right_m(),
        });
        let building = self.study.building.as_ref();
        let is_critical = member.accepted_for == LIFE_SAFETY;
        restraint_forces(&RestraintQuestion {
            mass_kg,
            cg_height_m: member.subject.axes.first().map_or(0.0, |axis| axis.block.cg_height_m()),
            axes: axes.collect(),
            level_ratio: facts.level_ratio,
            building_height_m: building.map(|building| building.height_m),
            building_period_s: building.map(|building| building.along.period_s()),
            spectrum: self.study.ground.code_spectrum().map(|target| target.spectrum.clone()),
            floor_acceleration_g: Some(facts.pfa_g_max),
            parameters: if is_critical { RestraintParameters::critical() } else { RestraintParameters::default() },
        })
    }
}
