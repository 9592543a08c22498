//! What a horizontal force at the centre of gravity asks of anchors and of a bracket.

use super::{Footing, RestraintAxis, RestraintQuestion};

/// Height of a bracket over that of the object, where the study does not state a height.
const BRACKET_SHARE: f64 = 0.9;

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
