//! The keys of `[ground]` that say how records are read, and its `processing`: kept as texts, each
//! with its line.

use super::Kind::{self, Count, Flag, Name, Number, Quantity};
use super::{Reader, Section, add_words, read_words, within};
use freestand_input::keys::Words;
use freestand_input::quantity::Dimension;

const READING_KEYS: [(&str, Kind); 5] = [
    ("unit", Name),
    ("station_xml", Name),
    ("component", Number),
    ("scale", Number),
    ("dt", Quantity(Dimension::Time)),
];

const PROCESSING_KEYS: [(&str, Kind); 11] = [
    ("azimuth", Quantity(Dimension::Angle)),
    ("low_cut", Quantity(Dimension::Frequency)),
    ("high_cut", Quantity(Dimension::Frequency)),
    ("resample", Quantity(Dimension::Time)),
    ("scale_to", Quantity(Dimension::Acceleration)),
    ("baseline", Name),
    ("scale_to_sa", Name),
    ("scale_to_spectrum", Name),
    ("taper", Number),
    ("filter_order", Count),
    ("keep_mean", Flag),
];

/// Adds the values of these keys; returns the line of `processing`.
pub(super) fn processing(reader: &mut Reader, table: &mut Section) -> (Words, Option<usize>) {
    let mut words = read_words(reader, table, &READING_KEYS);
    let line = within(table, reader, "processing", |reader, entry| {
        add_words(reader, entry, &PROCESSING_KEYS, &mut words);
        entry.line
    });
    (words, line)
}
