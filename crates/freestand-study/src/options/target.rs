//! The keys of `[ground]` that describe a spectrum: kept as texts, each with its line.

use super::cushion::texts;
use super::{Reader, Section, words};
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

/// Keys with a unit: if the key ends in one, the value may be a bare number.
const QUANTITIES: [(&str, Dimension); 8] = [
    ("ground_acceleration", Dimension::Acceleration),
    ("sds", Dimension::Acceleration),
    ("sd1", Dimension::Acceleration),
    ("ss", Dimension::Acceleration),
    ("s1", Dimension::Acceleration),
    ("long_period", Dimension::Time),
    ("corner_periods", Dimension::Time),
    ("fault_distance", Dimension::Length),
];

/// Keys that hold a name.
const NAMES: [&str; 6] = ["code", "site", "city", "spectrum", "interpolation", "beyond"];

/// Keys that hold a pure number.
const NUMBERS: [&str; 8] = [
    "edition",
    "hazard_factor",
    "return_period_years",
    "spectrum_type",
    "importance_factor",
    "soil_factor",
    "fa",
    "fv",
];

pub(super) fn target(reader: &mut Reader<'_>, table: &mut Section<'_, '_>) -> Words {
    let names = NAMES.map(|key| (key, table.string(reader, key)));
    let numbers = NUMBERS.map(|key| (key, table.name_or_number(reader, key)));
    let quantities = QUANTITIES.map(|(key, dimension)| (key, texts(reader, table, key, dimension)));
    words(names.into_iter().chain(numbers).chain(quantities))
}
