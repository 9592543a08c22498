//! The keys of `[ground]` that describe a spectrum: kept as texts, each with its line.

use super::Kind::{self, Name, Number, Quantity};
use freestand_input::quantity::Dimension;

pub(crate) const TARGET_KEYS: [(&str, Kind); 27] = [
    ("code", Name),
    ("site", Name),
    ("place", Name),
    ("city", Name),
    ("latitude", Number),
    ("longitude", Number),
    ("topography", Name),
    ("spectrum", Name),
    ("interpolation", Name),
    ("beyond", Name),
    ("edition", Number),
    ("hazard_factor", Number),
    ("return_period_years", Number),
    ("spectrum_type", Number),
    ("importance_factor", Number),
    ("soil_factor", Number),
    ("fa", Number),
    ("fv", Number),
    ("ground_acceleration", Quantity(Dimension::Acceleration)),
    ("sds", Quantity(Dimension::Acceleration)),
    ("sd1", Quantity(Dimension::Acceleration)),
    ("ss", Quantity(Dimension::Acceleration)),
    ("s1", Quantity(Dimension::Acceleration)),
    ("long_period", Quantity(Dimension::Time)),
    ("corner_periods", Quantity(Dimension::Time)),
    ("fault_distance", Quantity(Dimension::Length)),
    ("fault_magnitude", Number),
];

/// The keys among them that belong to a table of the user, which is no code.
pub(crate) const TABLE_KEYS: [&str; 3] = ["spectrum", "interpolation", "beyond"];
