//! `point_source` of `[ground]`: kept as texts, each with its line.

use super::cushion::texts;
use super::{Reader, Section, Written, words};
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

/// `point_source` of `[ground]`, as written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PointSourceOptions {
    pub(crate) line: usize,
    pub(crate) pairs: Option<Written<bool>>,
    /// The values of [`crate::simulated::SOURCE_KEYS`].
    pub(crate) words: Words,
}

const QUANTITIES: [(&str, Dimension); 5] = [
    ("distance", Dimension::Length),
    ("stress_drop", Dimension::Pressure),
    ("kappa", Dimension::Time),
    ("time_step", Dimension::Time),
    ("low_cut", Dimension::Frequency),
];
const NAMES: [&str; 4] = ["preset", "source_spectrum", "path_duration", "window"];

pub(super) fn point_source(reader: &mut Reader<'_>, table: &mut Section<'_, '_>) -> Option<PointSourceOptions> {
    let mut entry = table.table(reader, "point_source")?;
    let pairs = entry.boolean(reader, "pairs");
    let magnitude = ("magnitude", entry.name_or_number(reader, "magnitude"));
    let quantities = QUANTITIES.map(|(key, dimension)| (key, texts(reader, &mut entry, key, dimension)));
    let names = NAMES.map(|key| (key, entry.string(reader, key)));
    let hard_rock = entry.boolean(reader, "hard_rock").map(|flag| flag.map(|flag| flag.to_string()));
    let words = words(quantities.into_iter().chain(names).chain([magnitude, ("hard_rock", hard_rock)]));
    let line = entry.line;
    entry.finish(reader);
    Some(PointSourceOptions { line, pairs, words })
}
