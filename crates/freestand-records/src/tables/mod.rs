//! Tables that are not motions: buildings, tests of cushions and of objects, response spectra, seismic hazard.

mod building;
mod cushion_curve;
mod damage_points;
pub mod hazard;
pub mod laboratory;
mod spectrum;

pub use building::{load_table, read_modes, read_storeys};
pub use cushion_curve::load_curve;
pub use damage_points::{DamageRow, TestMethod, load_damage_points};
pub use spectrum::{SpectrumRow, load_spectrum, parse_spectrum};
