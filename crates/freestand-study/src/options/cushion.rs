//! The keys that describe a cushion, in `[objects]` and in a cushion file: kept as texts, each with
//! its line.

use super::Kind::{self, Number, Quantity};
use freestand_input::quantity::Dimension;

pub(super) const CUSHION_KEYS: [(&str, Kind); 13] = [
    ("stiffness", Quantity(Dimension::Stiffness)),
    ("pad_stiffness", Quantity(Dimension::Stiffness)),
    ("series_stiffness", Quantity(Dimension::Stiffness)),
    ("bottoming", Quantity(Dimension::Length)),
    ("compressions", Quantity(Dimension::Length)),
    ("forces", Quantity(Dimension::Force)),
    ("pad_thickness", Quantity(Dimension::Length)),
    ("law", Number),
    ("cushion", Number),
    ("pads_per_edge", Number),
    ("exponent", Number),
    ("damping", Number),
    ("dissipation", Number),
];
