//! `point_source` of `[ground]`: kept as texts, each with its line.

use super::{Kind, Reader, Section, Written, read_words};
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

/// `point_source` of `[ground]`, as written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PointSourceOptions {
    pub(crate) line: usize,
    pub(crate) pairs: Option<Written<bool>>,
    /// The values of [`SOURCE_KEYS`].
    pub(crate) words: Words,
}

const SOURCE_KEYS: [(&str, Kind); 11] = [
    ("magnitude", Kind::Number),
    ("distance", Kind::Quantity(Dimension::Length)),
    ("stress_drop", Kind::Quantity(Dimension::Pressure)),
    ("kappa", Kind::Quantity(Dimension::Time)),
    ("time_step", Kind::Quantity(Dimension::Time)),
    ("low_cut", Kind::Quantity(Dimension::Frequency)),
    ("preset", Kind::Name),
    ("source_spectrum", Kind::Name),
    ("path_duration", Kind::Name),
    ("window", Kind::Name),
    ("hard_rock", Kind::Flag),
];

pub(super) fn point_source(
    reader: &mut Reader<'_>,
    table: &mut Section<'_, '_>,
) -> Option<PointSourceOptions> {
    let mut entry = table.table(reader, "point_source")?;
    let pairs = entry.boolean(reader, "pairs");
    let mut words = Words::default();
    read_words(reader, &mut entry, &SOURCE_KEYS, &mut words);
    let line = entry.line;
    entry.finish(reader);
    Some(PointSourceOptions { line, pairs, words })
}
