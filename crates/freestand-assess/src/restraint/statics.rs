//! What a horizontal force at the centre of gravity asks of anchors and of a bracket.

use freestand_input::quantity::{Dimension, format_si};
use freestand_input::words::number;

use super::{Footing, RestraintAxis, RestraintQuestion};

/// Height of a bracket over that of the object, where the study does not state a height.
const BRACKET_SHARE: f64 = 0.9;

/// Coefficient of friction with which feet that are not fixed may carry a force: an assumption, low
/// for rubber or steel on a dry floor.
pub(super) const FOOT_FRICTION_RATIO: f64 = 0.3;

/// Weight that a source lets hold the object down, over its weight: max(0, d − v), with the share d
/// of the dead load and the deduction v for vertical shaking.
///
/// # Reference
/// ASCE 7-16, 2.3.6, combination 7: 0.9 D − E_v + E_h with E_v = 0.2 S_DS D (quoted from memory).
pub(super) fn held_weight_ratio(dead_load_ratio: f64, vertical_ratio: f64) -> f64 {
    (dead_load_ratio - vertical_ratio).max(0.0)
}

/// What pulls at the anchors: a force at the centre of gravity, against the weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pulled {
    pub(super) force_n: f64,
    /// Height of the centre of gravity \[m\].
    pub(super) cg_height_m: f64,
    /// Weight that holds the object down \[N\].
    pub(super) held_n: f64,
}

/// The axis with the largest tension, and that tension \[N\]; `None` without an axis.
pub(super) fn worst_tension<'a>(
    axes: &'a [RestraintAxis],
    footing: Footing,
    pulled: &Pulled,
) -> Option<(&'a RestraintAxis, f64)> {
    let Pulled {
        force_n,
        cg_height_m,
        held_n,
    } = *pulled;
    // The largest before it is limited to 0, so that the axis does not depend on their order.
    let moment_n_m =
        |axis: &RestraintAxis| force_n * cg_height_m - held_n * axis.lever_of_weight_m(footing);
    let pull = |axis: &RestraintAxis| moment_n_m(axis) / axis.anchor_lever_m(footing);
    let usable = axes
        .iter()
        .filter(|axis| axis.anchor_lever_m(footing) > 0.0);
    usable
        .map(|axis| (axis, pull(axis)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(axis, n)| (axis, n.max(0.0)))
}

/// A bracket: the object stands on its feet, and is held at this height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Held {
    /// Height of the bracket \[m\].
    pub(super) height_m: f64,
    /// The height that the study states, where the object is lower \[m\].
    pub(super) too_high_m: Option<f64>,
}

/// The bracket of an object.
///
/// The study states one height for all objects. A lower object has its bracket at its top, and the
/// note says so: with P = F c/z_b, a bracket above the object would get too small a force.
pub(super) fn bracket(question: &RestraintQuestion) -> Held {
    match question.settings.bracket_height_m {
        Some(stated_m) if stated_m > question.object.height_m => Held {
            height_m: question.object.height_m,
            too_high_m: Some(stated_m),
        },
        Some(stated_m) => Held {
            height_m: stated_m,
            too_high_m: None,
        },
        None => Held {
            height_m: BRACKET_SHARE * question.object.height_m,
            too_high_m: None,
        },
    }
}

/// Force of a bracket \[N\]: P = F c/z_b, by moments about the feet. The weight would lower it, but
/// is not counted: until an edge lifts, its share of the moment is not determined.
pub(super) fn bracket_force_n(force_n: f64, cg_height_m: f64, bracket_height_m: f64) -> f64 {
    force_n * cg_height_m / bracket_height_m
}

/// Horizontal force at the feet beside a bracket \[N\]: V = F |1 − c/z_b|. It acts against F where
/// the bracket is above the centre of gravity, and with it where the bracket is below.
pub(super) fn base_shear_n(force_n: f64, cg_height_m: f64, bracket_height_m: f64) -> f64 {
    force_n * (1.0 - cg_height_m / bracket_height_m).abs()
}

/// A bracket and the feet below it, in words; the forces in N.
pub(super) fn bracket_words(
    question: &RestraintQuestion,
    held: &Held,
    force_n: f64,
    held_n: f64,
    overstrength_ratio: f64,
) -> String {
    let length = |value_m: f64| format_si(value_m, Dimension::Length);
    let kilonewtons = |value_n: f64| format!("{} N", number(value_n, 4));
    let (cg_height_m, height_m) = (question.object.cg_height_m, held.height_m);
    let shear_n = base_shear_n(force_n, cg_height_m, height_m);
    let friction_n = FOOT_FRICTION_RATIO * held_n;
    let limited = held.too_high_m.map_or_else(String::new, |stated_m| {
        format!(
            " The stated height, {}, is above the object: the bracket is taken at its top.",
            length(stated_m)
        )
    });
    let below = if cg_height_m > height_m {
        " The bracket is below the centre of gravity: it carries more than F, and the force at the feet is reversed. \
         Raise the bracket."
    } else {
        ""
    };
    let feet = if friction_n >= shear_n {
        format!(
            "friction with a coefficient of {FOOT_FRICTION_RATIO} carries {}: it suffices",
            kilonewtons(friction_n)
        )
    } else {
        let in_concrete = if overstrength_ratio == 1.0 {
            String::new()
        } else {
            format!(
                ", in concrete for {}",
                kilonewtons(overstrength_ratio * shear_n)
            )
        };
        format!(
            "friction with a coefficient of {FOOT_FRICTION_RATIO} carries only {}: fix the feet{in_concrete}",
            kilonewtons(friction_n)
        )
    };
    format!(
        " Or a bracket at {at}: F × {cg}/{at} = {}, the weight is not counted; at the feet F × |1 − {cg}/{at}| = \
         {}; {feet}.{limited}{below}",
        kilonewtons(bracket_force_n(force_n, cg_height_m, height_m)),
        kilonewtons(shear_n),
        at = length(height_m),
        cg = length(cg_height_m),
    )
}
