//! The keys of `[assessment]`, `[worlds]` and `[restraint]`.

use super::target::{TABLE_KEYS, TARGET_KEYS};
use super::{Kind, Reader, Section, Written, read_words};
use freestand_input::keys::Words;

options! {
    /// `[assessment]`, as written.
    AssessmentOptions(reader, table) {
        /// Keys that [worlds] has, or that its `first` and `most` stand for, each with its line.
        of_worlds: (Vec<(&'static str, usize)>) = of_worlds(reader, table);
        inventory: string;
        sheet: string;
        library: string;
        cushion_library: string;
        accepted: ratio;
        /// By consequence (life safety, function, property) and rating (high, medium, low).
        accepted_by_rating: ([[Option<Written<f64>>; 3]; 3]) =
            ACCEPTED_KEYS.map(|keys| keys.map(|key| table.ratio(reader, key)));
        questions: string;
        annual: boolean;
        seed: count;
        restitution_spread: ratio;
        stiffness_spread: ratio;
        mass_spread: ratio;
        geometry_spread: ratio;
        model_spread: ratio;
        compliant_spread: ratio;
        compliant_factor: ratio;
        friction_low: ratio;
        friction_high: ratio;
        pad_strain: ratio;
        pad_damping: ratio;
        pad_damping_low: ratio;
        pad_damping_high: ratio;
        compliant: boolean;
        walls: string;
        dimensions: string;
        pages: count;
    }
}

options! {
    /// `[worlds]`, as written.
    WorldOptions(reader, table) {
        spectral_spread: ratio;
        intensity_spread: ratio;
        component_correlation: ratio;
        component_ratio: ratio;
        components: count;
        period_spread: ratio;
        damping_spread: ratio;
        first: count;
        most: count;
        confidence: ratio;
        shares: boolean;
    }
}

options! {
    /// `[restraint]`, as written.
    RestraintOptions(reader, table) {
        /// The keys of a code.
        code: (Words) = code(reader, table);
        dead_load_ratio: ratio;
        overstrength_ratio: ratio;
        amplification_ratio: ratio;
        response_ratio: ratio;
        resonance_ratio: ratio;
        strength_ratio: ratio;
        building_ductility_ratio: ratio;
        importance_ratio: ratio;
        bracket_height_m: [quantity "bracket_height" Length];
        anchor_inset_m: [quantity "anchor_inset" Length];
        bracket: string;
    }
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

/// The keys of [worlds] that stand here, which are then known, but not among those of this table.
fn of_worlds(reader: &mut Reader, table: &mut Section) -> Vec<(&'static str, usize)> {
    let found = WORLD_KEYS
        .iter()
        .filter_map(|key| Some((*key, table.take(reader, key)?.1)))
        .collect();
    table.known.retain(|key| !WORLD_KEYS.contains(key));
    found
}

/// The keys of a code: those of a spectrum, without those of a table, which has no clause for parts.
fn code(reader: &mut Reader, table: &mut Section) -> Words {
    let is_of_code = |(key, _): &&(&str, Kind)| !TABLE_KEYS.contains(key);
    read_words(reader, table, TARGET_KEYS.iter().filter(is_of_code))
}
