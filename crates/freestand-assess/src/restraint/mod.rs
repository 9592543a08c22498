//! The forces for the design of a restraint, by the codes and by the computed floor motion, and the
//! clearance of an object without a restraint.

use freestand::G0_M_S2;
use freestand::code_spectrum::CodeSpectrum;
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;
use freestand_study::study::assessment::RestraintSettings;

use crate::result::{Axis, RestraintForce};

use self::sources::Source;
use self::statics::{base_shear_n, bracket, bracket_force_n, bracket_words, held_weight_ratio, worst_tension};

mod sources;
mod statics;

/// An object about one axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RestraintAxis {
    /// The side that lies in the plane of motion.
    pub axis: Axis,
    /// From the anchors along one edge to the opposite edge, about which the object rotates \[m\].
    pub base_m: f64,
    /// From the centre of gravity to either of these edges; half the base where it is central
    /// \[m\].
    pub weight_lever_m: f64,
}

impl RestraintAxis {
    /// Lever of the weight about the nearer edge \[m\]: shaking acts in both directions.
    fn least_lever_m(&self) -> f64 {
        self.weight_lever_m.min(self.base_m - self.weight_lever_m)
    }
}

/// The object, its place and the hazard.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RestraintQuestion {
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
    /// Height of the building \[m\]; `None`: a tall one is assumed.
    pub building_height_m: Option<f64>,
    /// Fundamental period of the building \[s\].
    pub building_period_s: Option<f64>,
    /// Spectrum of the study's hazard; `None`: the study has none, and no code can be applied.
    pub spectrum: Option<CodeSpectrum>,
    /// PFA_q: peak acceleration of its floor that the accepted share of the worlds exceeds, the 1 −
    /// a quantile over worlds \[g\]. Not the largest, which grows with the number of worlds.
    pub floor_acceleration_g: Option<f64>,
    /// Whether it is critical to life safety: an importance factor of 1.5 where a code has one.
    pub is_critical: bool,
    /// The keys of `[restraint]`. A factor that is stated replaces that of every code.
    pub settings: RestraintSettings,
}

/// The forces for the design of a restraint, one for each source: first the study's own code, then
/// the computed floor, then other codes for comparison.
///
/// The codes are AS 1170.4 section 8, ASCE 7-16 and 7-22 chapter 13, and Eurocode 8 or NZS 1170.5
/// if the hazard is by that code. A code other than the study's receives the study's spectrum: kpZ
/// Ch(0) is then Sa(0), S_DS its plateau, and the note says so. The computed floor gives F = m A
/// PFA_q, with A = 1 for a rigid bracket (a period below 0.06 s) and A = 2.5 for a flexible one,
/// whose period is not known.
///
/// With F at the height c of the centre of gravity, the lever e of the weight, the base B and the
/// weight H = max(0, d − v) W that holds the object down (d = 0.9 of the dead load; v = 0.2 S_DS in
/// ASCE 7, 0 elsewhere), about the axis that needs more:
///
/// | | |
/// |---|---|
/// | all anchors along one edge | T = max(0, (F c − H e)/B) |
/// | the same in concrete | T_c = max(0, (Ω₀ F c − H e)/B) |
/// | a bracket at z_b, by default 0.9 h | P = F c/z_b, in concrete Ω₀ P |
/// | the feet below it | V = F \|1 − c/z_b\| |
///
/// There is no force for an object without mass or size.
pub(crate) fn restraint_forces(question: &RestraintQuestion) -> Vec<RestraintForce> {
    let is_positive = |value: f64| value > 0.0 && value.is_finite();
    if ![question.mass_kg, question.height_m, question.cg_height_m].into_iter().all(is_positive) {
        return Vec::new();
    }
    let (own, others): (Vec<Source>, Vec<Source>) = sources::codes(question).into_iter().partition(|code| code.is_own);
    let pfa_g = question.floor_acceleration_g.filter(|&pfa_g| is_positive(pfa_g));
    let floor = pfa_g.map(|pfa_g| {
        let mut floor = sources::computed_floor(question, pfa_g);
        if let Some(code) = own.first().filter(|code| floor.force_ratio > code.force_ratio) {
            let times = number(floor.force_ratio / code.force_ratio, 3);
            floor.formula.push_str(&format!(" It is {times} times the force by {}.", code.name));
        }
        floor
    });
    let of_study = own.iter().chain(&floor).map(|source| force(question, source, false));
    of_study.chain(others.iter().map(|source| force(question, source, true))).collect()
}

/// What the force by a source asks of anchors and of a bracket.
fn force(question: &RestraintQuestion, source: &Source, is_for_comparison: bool) -> RestraintForce {
    let weight_n = question.mass_kg * G0_M_S2;
    let force_n = source.force_ratio * weight_n;
    let concrete_n = source.overstrength_ratio * force_n;
    let held_weight_ratio = held_weight_ratio(question.settings.dead_load_ratio, source.vertical_ratio);
    let held_n = held_weight_ratio * weight_n;
    let tension = |force_n: f64| worst_tension(&question.axes, force_n, question.cg_height_m, held_n);
    let (worst, worst_in_concrete) = (tension(force_n), tension(concrete_n));
    let held = bracket(question);
    let note = [
        if is_for_comparison { "For comparison, on your spectrum. " } else { "" },
        &source.formula,
        &held_words(question, source, held_weight_ratio),
        &worst.map_or_else(String::new, |(axis, _)| anchor_words(question, axis, held_weight_ratio)),
        &bracket_words(question, &held, force_n, held_n, source.overstrength_ratio),
        if source.overstrength_ratio == 1.0 { "" } else { " In concrete, Ω_0 F takes the place of F." },
    ];
    RestraintForce {
        source: source.name.to_owned(),
        force_n,
        force_ratio: source.force_ratio,
        held_weight_ratio,
        overstrength_ratio: source.overstrength_ratio,
        anchor_tension_n: worst.map_or(0.0, |(_, tension_n)| tension_n),
        anchor_tension_concrete_n: worst_in_concrete.map_or(0.0, |(_, tension_n)| tension_n),
        bracket_height_m: held.height_m,
        bracket_force_n: bracket_force_n(force_n, question.cg_height_m, held.height_m),
        bracket_force_concrete_n: bracket_force_n(concrete_n, question.cg_height_m, held.height_m),
        bracket_base_shear_n: base_shear_n(force_n, question.cg_height_m, held.height_m),
        is_for_comparison,
        note: note.concat(),
    }
}

/// ` Held down by H = (0.9 − 0.2 S_DS) W = (0.9 − 0.2) W = 0.7 W.`
fn held_words(question: &RestraintQuestion, source: &Source, held_weight_ratio: f64) -> String {
    let dead = number(question.settings.dead_load_ratio, 4);
    let held = number(held_weight_ratio, 4);
    if source.vertical_words.is_empty() {
        format!(" Held down by H = {dead} W; nothing is deducted for vertical shaking.")
    } else {
        let vertical = number(source.vertical_ratio, 4);
        format!(
            " Held down by H = max(0, {dead} − {}) W = max(0, {dead} − {vertical}) W = {held} W.",
            source.vertical_words
        )
    }
}

/// The tension of the anchors of one edge, in words.
fn anchor_words(question: &RestraintQuestion, axis: &RestraintAxis, held_weight_ratio: f64) -> String {
    let length = |value_m: f64| format_si(value_m, Dimension::Length);
    format!(
        " Anchors along one edge, {}: (F × {} − {} W × {})/{}.",
        axis.axis.name(),
        length(question.cg_height_m),
        number(held_weight_ratio, 4),
        length(axis.least_lever_m()),
        length(axis.base_m)
    )
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
    if rotation_rad > (thickness_m / height_m).atan() { height_m } else { height_m * rotation_rad.sin() }
}

#[cfg(test)]
mod tests;
