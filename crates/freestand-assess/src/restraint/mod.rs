//! The forces for the design of a restraint, by the codes and by the computed floor motion, and the
//! clearance of an object without a restraint.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::code_spectrum::{Asce7Edition, CodeSpectrum};
use freestand_study::study::Study;
use freestand_study::study::assessment::RestraintSettings;
use serde::{Deserialize, Serialize};

use crate::axis::Axis;

use self::components::Component;
use self::footing::{Footing, Pivot};
use self::force::{RestraintForce, design_force, reported_force};
use self::source::{Remark, Source, SourceKind};
use self::statics::{
    Pulled, base_shear_n, bracket, bracket_force_n, held_weight_ratio, worst_tension,
};

pub mod anchors;
pub mod components;
pub mod factor;
pub mod footing;
pub mod force;
pub mod source;
mod sources;
mod statics;

/// Distance of anchors from the edge where it is not stated \[m\], an assumption: the bolt of an angle
/// of 6 in. (150 mm) inside the base stands about 3 in. from its edge. Bolts outside the base have a
/// longer lever.
pub(crate) const ASSUMED_INSET_M: f64 = 0.075;

/// The largest share of the base that is assumed for that distance: at a half, the anchors of both
/// edges would meet.
pub(crate) const INSET_SHARE: f64 = 0.25;

/// Distance of the anchors from the edge of a base that they hold down \[m\]: the stated one, else
/// 75 mm, but not more than a quarter of the base.
pub fn inset_m(stated_m: Option<f64>, base_m: f64) -> f64 {
    stated_m.unwrap_or_else(|| ASSUMED_INSET_M.min(INSET_SHARE * base_m))
}

/// An object about one axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RestraintAxis {
    /// The side that lies in the plane of motion.
    pub axis: Axis,
    /// From one edge of the base to the opposite one, about which the object rotates \[m\].
    pub base_m: f64,
    /// From the centre of gravity to either of these edges; half the base where it is central
    /// \[m\].
    pub weight_lever_m: f64,
}

impl RestraintAxis {
    /// Lever of the weight about the nearer edge \[m\]: shaking acts in both directions.
    pub fn least_lever_m(&self) -> f64 {
        self.weight_lever_m.min(self.base_m - self.weight_lever_m)
    }

    /// [`inset_m`] of its base.
    pub(crate) fn inset_m(&self, stated_m: Option<f64>) -> f64 {
        inset_m(stated_m, self.base_m)
    }

    /// Lever of the anchors along one edge about the line on the other side about which the object tips
    /// \[m\]: B − a about the edge, B − 2a about the feet.
    pub fn anchor_lever_m(&self, footing: Footing) -> f64 {
        let pivot_m = self.pivot_m(footing);
        self.base_m - self.inset_m(footing.inset_m) - pivot_m
    }

    /// Lever of the weight about that line \[m\]: e about the edge, e − a about the feet.
    pub fn lever_of_weight_m(&self, footing: Footing) -> f64 {
        self.least_lever_m() - self.pivot_m(footing)
    }

    /// Distance of that line from the edge \[m\].
    fn pivot_m(&self, footing: Footing) -> f64 {
        match footing.pivot {
            Pivot::Edge => 0.0,
            Pivot::Feet => self.inset_m(footing.inset_m),
        }
    }
}

/// The object that is held.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldObject {
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Height of the object \[m\].
    pub height_m: f64,
    /// Height of the centre of gravity, at which the force acts \[m\].
    pub cg_height_m: f64,
    /// Its axes; the one that needs more tension counts.
    pub axes: Vec<RestraintAxis>,
    /// Height of its floor over that of the building.
    pub level_ratio: f64,
    /// Whether it is critical to life safety: an importance factor of 1.5 where a code has one.
    pub is_critical: bool,
    /// Its row in the tables of ASCE 7; `None`: what it is is not known.
    pub component: Option<&'static Component>,
}

impl HeldObject {
    /// The object with these blocks, one about each axis.
    pub(crate) fn new(
        mass_kg: f64,
        level_ratio: f64,
        is_critical: bool,
        component: Option<&'static Component>,
        blocks: &[(Axis, Block)],
    ) -> Self {
        let first = blocks.first().map(|(_, block)| block);
        let axis = |(axis, block): &(Axis, Block)| RestraintAxis {
            axis: *axis,
            base_m: block.base_width_m(),
            weight_lever_m: block.cg_from_right_m(),
        };
        Self {
            mass_kg,
            height_m: first.map_or(0.0, Block::height_m),
            cg_height_m: first.map_or(0.0, Block::cg_height_m),
            axes: blocks.iter().map(axis).collect(),
            level_ratio,
            is_critical,
            component,
        }
    }
}

/// The object, its place and the hazard.
#[derive(Debug, Clone, PartialEq)]
pub struct RestraintQuestion {
    /// The object.
    pub object: HeldObject,
    /// Height of the building \[m\]; `None`: a tall one is assumed.
    pub building_height_m: Option<f64>,
    /// Fundamental period of the building \[s\].
    pub building_period_s: Option<f64>,
    /// Spectrum of the hazard; `None`: there is none, and no code can be applied.
    pub spectrum: Option<CodeSpectrum>,
    /// The edition of ASCE 7 for parts, where it is not that of the spectrum.
    pub parts_edition: Option<Asce7Edition>,
    /// Peak acceleration of its floor \[g\]: PFA_q, which the accepted share of the worlds exceeds,
    /// the 1 − a quantile over worlds (not the largest, which grows with the number of worlds); or
    /// the acceleration that the user gives.
    pub floor_acceleration_g: Option<f64>,
    /// Whether the user gives that acceleration.
    pub is_floor_given: bool,
    /// The keys of `[restraint]`. A factor that is stated replaces that of every code.
    pub settings: RestraintSettings,
    /// The line about which the object tips.
    pub pivot: Pivot,
}

impl RestraintQuestion {
    /// The question for an object in the building of a study.
    pub(crate) fn in_study(
        study: &Study,
        object: HeldObject,
        floor_acceleration_g: Option<f64>,
    ) -> Self {
        let building = study.building.as_ref();
        Self {
            object,
            building_height_m: building.map(|building| building.height_m),
            building_period_s: building.map(|building| building.along.period_s()),
            spectrum: study
                .restraint_target()
                .filter(|target| target.has_parts())
                .map(|target| target.parts_spectrum().clone()),
            parts_edition: study
                .restraint_target()
                .and_then(|target| target.parts_edition),
            floor_acceleration_g,
            is_floor_given: false,
            settings: study.assessment.restraint,
            pivot: Pivot::default(),
        }
    }

    /// How the object stands on its anchors.
    pub fn footing(&self) -> Footing {
        Footing {
            inset_m: self.settings.anchor_inset_m,
            pivot: self.pivot,
        }
    }
}

/// The forces for the design of a restraint, one for each source: first by the study's own code, then by
/// the acceleration of the floor, then by other codes for comparison.
///
/// The codes are AS 1170.4 section 8, ASCE 7-16 and 7-22 chapter 13, and Eurocode 8, NTC 2018,
/// NZS 1170.5, TBDY 2018 or TS 1170.5 if the hazard is by that code. A code other than the study's receives the study's spectrum: kpZ
/// Ch(0) is then Sa(0), S_DS its plateau, and the note says so. The floor gives F = m A PFA_q, with
/// A = 1 for a rigid bracket (a period below 0.06 s) and A = 2.5 for a flexible one, whose period is
/// not known.
///
/// With F at the height c of the centre of gravity, the lever e of the weight, the base B, the distance
/// a of the anchors from the edge that they hold down and the weight H = max(0, d − v) W that holds the object down (d = 0.9 of the dead load; v = 0.2 S_DS in
/// ASCE 7, 0 elsewhere), about the axis that needs more:
///
/// | | |
/// |---|---|
/// | all anchors along one edge | T = max(0, (F c − H e)/(B − a)) |
/// | the same in concrete | T_c = max(0, (Ω₀ F c − H e)/(B − a)) |
/// | a bracket at z_b, by default 0.9 h | P = F c/z_b, in concrete Ω₀ P |
/// | the feet below it | V = F \|1 − c/z_b\| |
///
/// On feet that are the anchors ([`Pivot::Feet`]) the object tips about them: e − a and B − 2a take the
/// place of e and B − a.
///
/// There is no force for an object without mass or size.
pub fn restraint_forces(question: &RestraintQuestion) -> Vec<RestraintForce> {
    let is_positive = |value: f64| value > 0.0 && value.is_finite();
    let HeldObject {
        mass_kg,
        height_m,
        cg_height_m,
        ..
    } = question.object;
    if ![mass_kg, height_m, cg_height_m]
        .into_iter()
        .all(is_positive)
    {
        return Vec::new();
    }
    let is_own = |code: &Source| code.kind == SourceKind::OwnCode;
    let (own, others): (Vec<Source>, Vec<Source>) =
        sources::codes(question).into_iter().partition(is_own);
    let pfa_g = question
        .floor_acceleration_g
        .filter(|&pfa_g| is_positive(pfa_g));
    let floor = pfa_g.map(|pfa_g| {
        let mut floor = sources::floor(question, pfa_g);
        let ratio = floor.part.force_ratio;
        // A force of zero has no multiples.
        let is_less = |code: &&Source| code.part.force_ratio > 0.0 && code.part.force_ratio < ratio;
        if let Some(code) = own.first().filter(is_less) {
            floor.remarks.push(Remark::AboveCode {
                ratio: ratio / code.part.force_ratio,
                clause: code.clause,
            });
        }
        floor
    });
    own.into_iter()
        .chain(floor)
        .chain(others)
        .map(|source| force_by(question, source))
        .collect()
}

/// What the force by a source asks of anchors and of a bracket.
fn force_by(question: &RestraintQuestion, source: Source) -> RestraintForce {
    let object = &question.object;
    let weight_n = object.mass_kg * G0_M_S2;
    let force_n = source.part.force_ratio * weight_n;
    let concrete_n = source.overstrength_ratio() * force_n;
    let held_weight_ratio =
        held_weight_ratio(question.settings.dead_load_ratio, source.vertical_ratio);
    let held_n = held_weight_ratio * weight_n;
    let footing = question.footing();
    let tension = |force_n: f64| {
        worst_tension(
            &object.axes,
            footing,
            &Pulled {
                force_n,
                cg_height_m: object.cg_height_m,
                held_n,
            },
        )
    };
    let (worst, worst_in_concrete) = (tension(force_n), tension(concrete_n));
    let held = bracket(question);
    let most = |worst: Option<(&RestraintAxis, f64)>| worst.map_or(0.0, |(_, tension_n)| tension_n);
    RestraintForce {
        weight_n,
        cg_height_m: object.cg_height_m,
        axis: worst.map(|(axis, _)| axis.clone()),
        footing,
        force_n,
        dead_load_ratio: question.settings.dead_load_ratio,
        held_weight_ratio,
        anchor_tension_n: most(worst),
        anchor_tension_concrete_n: most(worst_in_concrete),
        bracket_height_m: held.height_m,
        too_high_bracket_m: held.too_high_m,
        bracket_force_n: bracket_force_n(force_n, object.cg_height_m, held.height_m),
        bracket_force_concrete_n: bracket_force_n(concrete_n, object.cg_height_m, held.height_m),
        bracket_base_shear_n: base_shear_n(force_n, object.cg_height_m, held.height_m),
        source,
    }
}

/// Whether the force of the code would not lift an object for which more is designed.
pub(crate) fn is_beyond_code(forces: &[RestraintForce]) -> bool {
    let design = design_force(forces);
    design.is_some_and(|design| reported_force(forces).is_some_and(|own| design != own))
}

/// Clearance that an object needs on each side while it rocks \[m\]: its highest corner moves
/// h sin θ beyond its side. Past the balance point, tan θ > t/h, it overturns and needs its height.
///
/// With the pivot at the origin the corners are (0, 0), (−t, 0), (−t, h) and (0, h). After a
/// rotation θ towards the pivot, a corner (x, z) is at x cos θ + z sin θ: the corner above the
/// pivot moves farthest, h sin θ beyond the side; on the other side the free edge draws in by t
/// (1 − cos θ).
pub(crate) fn clearance_m(height_m: f64, thickness_m: f64, rotation_rad: f64) -> f64 {
    let rotation_rad = rotation_rad.abs();
    if rotation_rad > (thickness_m / height_m).atan() {
        height_m
    } else {
        height_m * rotation_rad.sin()
    }
}

#[cfg(test)]
mod tests;
