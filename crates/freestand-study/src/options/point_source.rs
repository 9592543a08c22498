//! `point_source` of `[ground]`: kept as texts, each with its line.

use super::{Kind, read_words};
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

options! {
    /// `point_source` of `[ground]`, as written.
    PointSourceOptions(reader, table) {
        line: (usize) = table.line;
        pairs: boolean;
        /// The values of [`SOURCE_KEYS`].
        words: (Words) = read_words(reader, table, &SOURCE_KEYS);
    }
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
