//! The forces for the design of a restraint, by the codes and by the computed floor motion, and the
//! clearance of an object without a restraint.

use freestand::G0_M_S2;
use freestand::code_spectrum::part_forces::{
    As1170_4Part, Asce7_16Part, Asce7_22Part, Eurocode8Part, Governing, Nzs1170_5Part, PartForce, as1170_4_force,
    asce7_16_force, asce7_22_force, eurocode8_force, nzs1170_5_force,
};
use freestand::code_spectrum::parts::{PartsQuestion, as1170_4_height_ratio, asce7_height_ratio, floor_acceleration_g};
use freestand::code_spectrum::{Asce7Edition, CodeSpectrum};

use crate::result::{Axis, RestraintForce};
use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;

/// An object about one axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RestraintAxis {
    /// The side that lies in the plane of motion.
    pub axis: Axis,
    /// From the anchors along one edge to the opposite edge, about which the object rotates \[m\].
    pub base_m: f64,
    /// From the centre of gravity to that opposite edge; half the base where it is central \[m\].
    pub weight_lever_m: f64,
}

/// The factors of the codes for the object; the note of every force states those that were assumed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RestraintParameters {
    /// AS 1170.4: a rigid part with a connection that is not shown to be ductile.
    pub as1170_4: As1170_4Part,
    /// ASCE 7-16: storage cabinets and laboratory equipment.
    pub asce7_16: Asce7_16Part,
    /// ASCE 7-22: the same, in a building whose ductility is not known.
    pub asce7_22: Asce7_22Part,
    /// Eurocode 8: a rigid, floor-supported cabinet with anchors.
    pub eurocode8: Eurocode8Part,
    /// NZS 1170.5: a part of short period that stays elastic.
    pub nzs1170_5: Nzs1170_5Part,
}

impl Default for RestraintParameters {
    fn default() -> Self {
        Self {
            as1170_4: As1170_4Part { amplification_ratio: 1.0, ductility_ratio: 1.0, importance_ratio: 1.0 },
            asce7_16: Asce7_16Part { amplification_ratio: 1.0, response_ratio: 2.5, importance_ratio: 1.0 },
            asce7_22: Asce7_22Part {
                resonance_ratio: 1.0,
                strength_ratio: 1.5,
                building_ductility_ratio: 1.3,
                importance_ratio: 1.0,
            },
            eurocode8: Eurocode8Part { period_ratio: 0.0, importance_ratio: 1.0, behaviour_ratio: 2.0 },
            nzs1170_5: Nzs1170_5Part { spectral_ratio: 2.0, response_ratio: 1.0, risk_ratio: 1.0 },
        }
    }
}

impl RestraintParameters {
    /// The defaults, with the importance factor of 1.5 that life safety requires.
    pub(crate) fn critical() -> Self {
        let mut parameters = Self::default();
        parameters.as1170_4.importance_ratio = 1.5;
        parameters.asce7_16.importance_ratio = 1.5;
        parameters.asce7_22.importance_ratio = 1.5;
        parameters.eurocode8.importance_ratio = 1.5;
        parameters
    }
}

/// The object, its place and the hazard.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RestraintQuestion {
    /// Mass \[kg\].
    pub mass_kg: f64,
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
    /// Largest computed acceleration of the floor \[g\].
    pub floor_acceleration_g: Option<f64>,
    /// Factors of the codes.
    pub parameters: RestraintParameters,
}

/// Height of a building that every code counts as tall \[m\].
const TALL_M: f64 = 30.0;

const RECALLED: &str = "This clause is quoted from memory: check it in your edition of the code.";

/// The forces for the design of a restraint, one for each source: AS 1170.4 section 8, ASCE 7-16
/// and 7-22 chapter 13, Eurocode 8 or NZS 1170.5 if the hazard is by that code, and the computed
/// floor acceleration times the mass.
///
/// The force acts at the centre of gravity. All anchors along one edge together carry the tension
/// T = max(0, (F h − W (1 − v) e)/b), with h the height of the centre of gravity, e the lever of
/// the weight, b the base and v the share of the weight that the clause deducts for vertical
/// shaking; the axis that needs more counts.
///
/// A code other than the study's receives the study's spectrum: kpZ Ch(0) is then Sa(0), S_DS its
/// plateau, and the note says so. There is no force for an object without mass or size.
pub(crate) fn restraint_forces(question: &RestraintQuestion) -> Vec<RestraintForce> {
    let is_positive = |value: f64| value > 0.0 && value.is_finite();
    if !is_positive(question.mass_kg) || !is_positive(question.cg_height_m) {
        return Vec::new();
    }
    let mut forces = Vec::new();
    if let Some(spectrum) = &question.spectrum {
        forces.extend(australia(question, spectrum));
        forces.extend(america(question, spectrum));
        forces.extend(europe(question, spectrum));
        forces.extend(new_zealand(question, spectrum));
    }
    forces.extend(question.floor_acceleration_g.filter(|&pfa| is_positive(pfa)).map(|pfa| {
        let formula = format!(
            "F = m × PFA with the largest computed floor acceleration, {} g; without factors for ductility or safety.",
            number(pfa, 4)
        );
        force(question, "computed floor acceleration", pfa, 0.0, &formula)
    }));
    forces
}

/// A force with the tension of its anchors.
fn force(question: &RestraintQuestion, source: &str, ratio: f64, vertical_share: f64, formula: &str) -> RestraintForce {
    let weight_n = question.mass_kg * G0_M_S2;
    let force_n = ratio * weight_n;
    let held = weight_n * (1.0 - vertical_share);
    let tension =
        |axis: &RestraintAxis| ((force_n * question.cg_height_m - held * axis.weight_lever_m) / axis.base_m).max(0.0);
    let worst = question.axes.iter().filter(|axis| axis.base_m > 0.0).max_by(|a, b| tension(a).total_cmp(&tension(b)));
    let anchors = worst.map_or_else(String::new, |axis| {
        let length = |value: f64| format_si(value, Dimension::Length);
        let weight =
            if vertical_share > 0.0 { format!("{} W", number(1.0 - vertical_share, 4)) } else { "W".to_owned() };
        format!(
            " Anchors along one edge, {}: (F × {} − {weight} × {})/{}.",
            axis.axis.name(),
            length(question.cg_height_m),
            length(axis.weight_lever_m),
            length(axis.base_m)
        )
    });
    RestraintForce {
        source: source.to_owned(),
        force_n,
        force_ratio: ratio,
        anchor_tension_n: worst.map_or(0.0, tension),
        note: format!("{formula}{anchors}"),
    }
}

/// `; the lower limit of 0.05 governs`, where a limit does.
fn governs(force: &PartForce) -> String {
    let limit = |name: &str| format!("; the {name} limit governs: {} W", number(force.force_ratio, 4));
    match force.governing {
        Governing::Formula => String::new(),
        Governing::Minimum => limit("lower"),
        Governing::Maximum => limit("upper"),
    }
}

fn place(question: &RestraintQuestion) -> (PartsQuestion, &'static str) {
    let (building_height_m, said) = match question.building_height_m {
        Some(height_m) => (height_m, ""),
        None => (TALL_M, " The height of the building was not given; 12 m or more is assumed."),
    };
    let level_ratio = question.level_ratio;
    (
        PartsQuestion {
            level_ratio,
            building_height_m: Some(building_height_m),
            building_period_s: question.building_period_s,
        },
        said,
    )
}

/// Sa(0), or Sa at the shortest period of a table.
fn ground_g(spectrum: &CodeSpectrum) -> f64 {
    spectrum.sa_g(spectrum.shortest_period_s())
}

fn australia(question: &RestraintQuestion, spectrum: &CodeSpectrum) -> Option<RestraintForce> {
    let part = question.parameters.as1170_4;
    let (place, tall) = place(question);
    let own = matches!(spectrum, CodeSpectrum::As1170_4(_));
    // a_x depends on the place alone: floor over ground acceleration of any spectrum of this code.
    let floor_g = if own {
        floor_acceleration_g(spectrum, &place)?
    } else {
        ground_g(spectrum) * as1170_4_height_ratio(place.level_ratio, place.building_height_m?)
    };
    let borrowed = if own { "" } else { " kpZ Ch(0) is taken as Sa(0) of the study's spectrum." };
    let found = as1170_4_force(floor_g, &part);
    let formula = format!(
        "F_c = kpZ Ch(0) a_x I_c a_c/R_c W, from 0.05 W to 0.5 W: {} × {} × {}/{} = {} W{}. Assumed: I_c = {}, \
         a_c = {} (rigid), R_c = {} (2.5 where the connection is shown to be ductile).{borrowed}{tall} {RECALLED}",
        number(floor_g, 4),
        number(part.importance_ratio, 3),
        number(part.amplification_ratio, 3),
        number(part.ductility_ratio, 3),
        number(found.formula_ratio, 4),
        governs(&found),
        number(part.importance_ratio, 3),
        number(part.amplification_ratio, 3),
        number(part.ductility_ratio, 3)
    );
    Some(force(question, "AS 1170.4-2007, section 8", found.force_ratio, 0.0, &formula))
}

fn america(question: &RestraintQuestion, spectrum: &CodeSpectrum) -> Vec<RestraintForce> {
    let sds_g = spectrum.plateau_g();
    let borrowed = match spectrum {
        CodeSpectrum::Asce7(_) => "",
        _ => " S_DS is taken as the plateau of the study's spectrum.",
    };
    let height = |edition| asce7_height_ratio(edition, question.level_ratio, question.building_period_s);
    let vertical_share = (0.2 * sds_g).min(1.0);
    let vertical = "0.2 S_DS of the weight is deducted; load factors are not included.";
    let (old, new) = (question.parameters.asce7_16, question.parameters.asce7_22);
    let (old_height, new_height) = (height(Asce7Edition::Asce7_16), height(Asce7Edition::Asce7_22));
    let found = asce7_16_force(sds_g, old_height, &old);
    let formula = format!(
        "F_p = 0.4 a_p S_DS (1 + 2 z/h) I_p/R_p W, from 0.3 S_DS I_p W to 1.6 S_DS I_p W: \
         0.4 × {} × {} × {} × {}/{} = {} W{}. Assumed: a_p = {}, R_p = {} (storage cabinets, laboratory equipment), \
         I_p = {}.{borrowed} {vertical} {RECALLED}",
        number(old.amplification_ratio, 3),
        number(sds_g, 4),
        number(old_height, 4),
        number(old.importance_ratio, 3),
        number(old.response_ratio, 3),
        number(found.formula_ratio, 4),
        governs(&found),
        number(old.amplification_ratio, 3),
        number(old.response_ratio, 3),
        number(old.importance_ratio, 3)
    );
    let first = force(question, "ASCE 7-16, 13.3.1", found.force_ratio, vertical_share, &formula);
    let found = asce7_22_force(sds_g, new_height, &new);
    let formula = format!(
        "F_p = 0.4 S_DS I_p (H_f/R_μ)(C_AR/R_po) W, from 0.3 S_DS I_p W to 1.6 S_DS I_p W: \
         0.4 × {} × {} × {}/{} × {}/{} = {} W{}. Assumed: R_μ = {} (the ductility of the building is not known), \
         C_AR = {}, R_po = {}, I_p = {}.{borrowed} {vertical} {RECALLED}",
        number(sds_g, 4),
        number(new.importance_ratio, 3),
        number(new_height, 4),
        number(new.building_ductility_ratio, 3),
        number(new.resonance_ratio, 3),
        number(new.strength_ratio, 3),
        number(found.formula_ratio, 4),
        governs(&found),
        number(new.building_ductility_ratio, 3),
        number(new.resonance_ratio, 3),
        number(new.strength_ratio, 3),
        number(new.importance_ratio, 3)
    );
    vec![first, force(question, "ASCE 7-22, 13.3.1", found.force_ratio, vertical_share, &formula)]
}

fn europe(question: &RestraintQuestion, spectrum: &CodeSpectrum) -> Option<RestraintForce> {
    let CodeSpectrum::Eurocode8(code) = spectrum else { return None };
    let part = question.parameters.eurocode8;
    let ground_g = code.zero_period_g();
    let found = eurocode8_force(ground_g, question.level_ratio, &part);
    let formula = format!(
        "F_a = α S [3 (1 + z/H)/(1 + (1 − T_a/T_1)²) − 0.5] γ_a/q_a W with α S = {}, z/H = {}, T_a/T_1 = {}, γ_a = {}, \
         q_a = {}: {} W{}. T_a, γ_a and q_a (anchorage of floor-supported cabinets) are assumed. {RECALLED}",
        number(ground_g, 4),
        number(question.level_ratio, 3),
        number(part.period_ratio, 3),
        number(part.importance_ratio, 3),
        number(part.behaviour_ratio, 3),
        number(found.formula_ratio, 4),
        governs(&found)
    );
    Some(force(question, "EN 1998-1:2004, 4.3.5.2", found.force_ratio, 0.0, &formula))
}

fn new_zealand(question: &RestraintQuestion, spectrum: &CodeSpectrum) -> Option<RestraintForce> {
    let CodeSpectrum::Nzs1170_5(_) = spectrum else { return None };
    let part = question.parameters.nzs1170_5;
    let (place, tall) = place(question);
    let floor_g = floor_acceleration_g(spectrum, &place)?;
    let found = nzs1170_5_force(floor_g, &part);
    let formula = format!(
        "F_ph = C(0) C_Hi C_i C_ph R_p W, at most 3.6 W: {} × {} × {} × {} = {} W{}. Assumed: C_i = {} (a period up to \
         0.75 s), C_ph = {} (elastic), R_p = {}.{tall} {RECALLED}",
        number(floor_g, 4),
        number(part.spectral_ratio, 3),
        number(part.response_ratio, 3),
        number(part.risk_ratio, 3),
        number(found.formula_ratio, 4),
        governs(&found),
        number(part.spectral_ratio, 3),
        number(part.response_ratio, 3),
        number(part.risk_ratio, 3)
    );
    Some(force(question, "NZS 1170.5:2004, section 8", found.force_ratio, 0.0, &formula))
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
