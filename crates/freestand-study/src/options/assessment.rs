//! The keys of `[assessment]`.

use super::{Reader, Section, Written};

/// `[assessment]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct AssessmentOptions {
    pub(crate) inventory: Option<Written<String>>,
    pub(crate) sheet: Option<Written<String>>,
    pub(crate) library: Option<Written<String>>,
    pub(crate) cushion_library: Option<Written<String>>,
    pub(crate) accepted: Option<Written<f64>>,
    pub(crate) accepted_life_safety: Option<Written<f64>>,
    pub(crate) accepted_property: Option<Written<f64>>,
    pub(crate) accepted_function: Option<Written<f64>>,
    pub(crate) seed: Option<Written<u64>>,
    pub(crate) draws: Option<Written<u64>>,
    pub(crate) most_draws: Option<Written<u64>>,
    pub(crate) restitution_spread: Option<Written<f64>>,
    pub(crate) stiffness_spread: Option<Written<f64>>,
    pub(crate) mass_spread: Option<Written<f64>>,
    pub(crate) geometry_spread: Option<Written<f64>>,
    pub(crate) model_spread: Option<Written<f64>>,
    pub(crate) friction_low: Option<Written<f64>>,
    pub(crate) friction_high: Option<Written<f64>>,
    pub(crate) pad_strain: Option<Written<f64>>,
    pub(crate) pad_damping: Option<Written<f64>>,
    pub(crate) compliant: Option<Written<bool>>,
    pub(crate) screen: Option<Written<bool>>,
    pub(crate) pages: Option<Written<u64>>,
}

pub(super) fn assessment(reader: &mut Reader, table: &mut Section) -> AssessmentOptions {
    AssessmentOptions {
        inventory: table.string(reader, "inventory"),
        sheet: table.string(reader, "sheet"),
        library: table.string(reader, "library"),
        cushion_library: table.string(reader, "cushion_library"),
        accepted: table.ratio(reader, "accepted"),
        accepted_life_safety: table.ratio(reader, "accepted_life_safety"),
        accepted_property: table.ratio(reader, "accepted_property"),
        accepted_function: table.ratio(reader, "accepted_function"),
        seed: table.count(reader, "seed"),
        draws: table.count(reader, "draws"),
        most_draws: table.count(reader, "most_draws"),
        restitution_spread: table.ratio(reader, "restitution_spread"),
        stiffness_spread: table.ratio(reader, "stiffness_spread"),
        mass_spread: table.ratio(reader, "mass_spread"),
        geometry_spread: table.ratio(reader, "geometry_spread"),
        model_spread: table.ratio(reader, "model_spread"),
        friction_low: table.ratio(reader, "friction_low"),
        friction_high: table.ratio(reader, "friction_high"),
        pad_strain: table.ratio(reader, "pad_strain"),
        pad_damping: table.ratio(reader, "pad_damping"),
        compliant: table.boolean(reader, "compliant"),
        screen: table.boolean(reader, "screen"),
        pages: table.count(reader, "pages"),
    }
}
