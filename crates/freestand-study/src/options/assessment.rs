//! The keys of `[assessment]`, `[worlds]` and `[restraint]`.

use super::target::{TABLE_KEYS, TARGET_KEYS};
use super::{Reader, Section, Written, read_words};
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

/// `[assessment]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct AssessmentOptions {
    pub(crate) inventory: Option<Written<String>>,
    pub(crate) sheet: Option<Written<String>>,
    pub(crate) library: Option<Written<String>>,
    pub(crate) cushion_library: Option<Written<String>>,
    pub(crate) accepted: Option<Written<f64>>,
    /// By consequence (life safety, function, property) and rating (high, medium, low).
    pub(crate) accepted_by_rating: [[Option<Written<f64>>; 3]; 3],
    pub(crate) questions: Option<Written<String>>,
    pub(crate) annual: Option<Written<bool>>,
    pub(crate) seed: Option<Written<u64>>,
    pub(crate) restitution_spread: Option<Written<f64>>,
    pub(crate) stiffness_spread: Option<Written<f64>>,
    pub(crate) mass_spread: Option<Written<f64>>,
    pub(crate) geometry_spread: Option<Written<f64>>,
    pub(crate) model_spread: Option<Written<f64>>,
    pub(crate) compliant_spread: Option<Written<f64>>,
    pub(crate) compliant_factor: Option<Written<f64>>,
    pub(crate) friction_low: Option<Written<f64>>,
    pub(crate) friction_high: Option<Written<f64>>,
    pub(crate) pad_strain: Option<Written<f64>>,
    pub(crate) pad_damping: Option<Written<f64>>,
    pub(crate) pad_damping_low: Option<Written<f64>>,
    pub(crate) pad_damping_high: Option<Written<f64>>,
    pub(crate) compliant: Option<Written<bool>>,
    pub(crate) walls: Option<Written<String>>,
    pub(crate) dimensions: Option<Written<String>>,
    pub(crate) pages: Option<Written<u64>>,
    /// Keys that [worlds] has, or that its `first` and `most` stand for, each with its line.
    pub(crate) of_worlds: Vec<(&'static str, usize)>,
}

/// `[worlds]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct WorldOptions {
    pub(crate) spectral_spread: Option<Written<f64>>,
    pub(crate) intensity_spread: Option<Written<f64>>,
    pub(crate) component_correlation: Option<Written<f64>>,
    pub(crate) component_ratio: Option<Written<f64>>,
    pub(crate) components: Option<Written<u64>>,
    pub(crate) period_spread: Option<Written<f64>>,
    pub(crate) damping_spread: Option<Written<f64>>,
    pub(crate) first: Option<Written<u64>>,
    pub(crate) most: Option<Written<u64>>,
    pub(crate) confidence: Option<Written<f64>>,
    pub(crate) shares: Option<Written<bool>>,
}

/// `[restraint]`, as written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct RestraintOptions {
    pub(crate) dead_load_ratio: Option<Written<f64>>,
    pub(crate) overstrength_ratio: Option<Written<f64>>,
    pub(crate) amplification_ratio: Option<Written<f64>>,
    pub(crate) response_ratio: Option<Written<f64>>,
    pub(crate) resonance_ratio: Option<Written<f64>>,
    pub(crate) strength_ratio: Option<Written<f64>>,
    pub(crate) building_ductility_ratio: Option<Written<f64>>,
    pub(crate) importance_ratio: Option<Written<f64>>,
    pub(crate) bracket_height_m: Option<Written<f64>>,
    pub(crate) anchor_inset_m: Option<Written<f64>>,
    pub(crate) bracket: Option<Written<String>>,
    /// The keys of a code.
    pub(crate) code: Words,
}

/// The keys of accepted probabilities: life safety, function, property, each rated high, medium,
/// low. Without a rating a key stands for high.
pub(crate) const ACCEPTED_KEYS: [[&str; 3]; 3] = [
    [
        "accepted_life_safety",
        "accepted_life_safety_medium",
        "accepted_life_safety_low",
    ],
    [
        "accepted_function",
        "accepted_function_medium",
        "accepted_function_low",
    ],
    [
        "accepted_property",
        "accepted_property_medium",
        "accepted_property_low",
    ],
];

/// Keys that belong in [worlds], or that worlds have replaced.
const WORLD_KEYS: [&str; 15] = [
    "draws",
    "most_draws",
    "screen",
    "worlds",
    "spectral_spread",
    "intensity_spread",
    "component_correlation",
    "component_ratio",
    "components",
    "period_spread",
    "damping_spread",
    "first",
    "most",
    "confidence",
    "shares",
];

pub(super) fn assessment(reader: &mut Reader, table: &mut Section) -> AssessmentOptions {
    let of_worlds = WORLD_KEYS
        .iter()
        .filter_map(|key| Some((*key, table.take(reader, key)?.1)))
        .collect();
    table.known.retain(|key| !WORLD_KEYS.contains(key));
    AssessmentOptions {
        inventory: table.string(reader, "inventory"),
        sheet: table.string(reader, "sheet"),
        library: table.string(reader, "library"),
        cushion_library: table.string(reader, "cushion_library"),
        accepted: table.ratio(reader, "accepted"),
        accepted_by_rating: ACCEPTED_KEYS.map(|keys| keys.map(|key| table.ratio(reader, key))),
        questions: table.string(reader, "questions"),
        annual: table.boolean(reader, "annual"),
        seed: table.count(reader, "seed"),
        restitution_spread: table.ratio(reader, "restitution_spread"),
        stiffness_spread: table.ratio(reader, "stiffness_spread"),
        mass_spread: table.ratio(reader, "mass_spread"),
        geometry_spread: table.ratio(reader, "geometry_spread"),
        model_spread: table.ratio(reader, "model_spread"),
        compliant_spread: table.ratio(reader, "compliant_spread"),
        compliant_factor: table.ratio(reader, "compliant_factor"),
        friction_low: table.ratio(reader, "friction_low"),
        friction_high: table.ratio(reader, "friction_high"),
        pad_strain: table.ratio(reader, "pad_strain"),
        pad_damping: table.ratio(reader, "pad_damping"),
        pad_damping_low: table.ratio(reader, "pad_damping_low"),
        pad_damping_high: table.ratio(reader, "pad_damping_high"),
        compliant: table.boolean(reader, "compliant"),
        walls: table.string(reader, "walls"),
        dimensions: table.string(reader, "dimensions"),
        pages: table.count(reader, "pages"),
        of_worlds,
    }
}

pub(super) fn worlds(reader: &mut Reader, table: &mut Section) -> WorldOptions {
    WorldOptions {
        spectral_spread: table.ratio(reader, "spectral_spread"),
        intensity_spread: table.ratio(reader, "intensity_spread"),
        component_correlation: table.ratio(reader, "component_correlation"),
        component_ratio: table.ratio(reader, "component_ratio"),
        components: table.count(reader, "components"),
        period_spread: table.ratio(reader, "period_spread"),
        damping_spread: table.ratio(reader, "damping_spread"),
        first: table.count(reader, "first"),
        most: table.count(reader, "most"),
        confidence: table.ratio(reader, "confidence"),
        shares: table.boolean(reader, "shares"),
    }
}

pub(super) fn restraint(reader: &mut Reader, table: &mut Section) -> RestraintOptions {
    let mut code = Words::default();
    let keys: Vec<_> = TARGET_KEYS
        .into_iter()
        .filter(|(key, _)| !TABLE_KEYS.contains(key))
        .collect();
    read_words(reader, table, &keys, &mut code);
    RestraintOptions {
        code,
        dead_load_ratio: table.ratio(reader, "dead_load_ratio"),
        overstrength_ratio: table.ratio(reader, "overstrength_ratio"),
        amplification_ratio: table.ratio(reader, "amplification_ratio"),
        response_ratio: table.ratio(reader, "response_ratio"),
        resonance_ratio: table.ratio(reader, "resonance_ratio"),
        strength_ratio: table.ratio(reader, "strength_ratio"),
        building_ductility_ratio: table.ratio(reader, "building_ductility_ratio"),
        importance_ratio: table.ratio(reader, "importance_ratio"),
        bracket_height_m: table.quantity(reader, "bracket_height", Dimension::Length),
        anchor_inset_m: table.quantity(reader, "anchor_inset", Dimension::Length),
        bracket: table.string(reader, "bracket"),
    }
}
