//! The science of free-standing objects in an earthquake.

pub mod block;
pub mod building;
pub mod code_spectrum;
pub mod impact;
pub mod measures;
pub mod motion;
pub mod oscillator;
mod polynomial;
pub mod rocking;
pub mod shock_response;
pub mod spectra;
pub mod synthesis;

/// Standard acceleration of gravity, the unit "g" \[m/s²\].
pub const G0_M_S2: f64 = 9.80665;
