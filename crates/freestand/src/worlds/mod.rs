//! Worlds: complete draws of everything that is uncertain.
//!
//! World i = 0, 1, 2 … has random numbers of its own, so the first n worlds are the same however
//! many are made, in whatever order and on however many threads. What all objects share (the
//! ground, the building) is keyed by (seed, i), what is an object's own by (seed, i, object).

mod building;
mod correlation;
mod ground;
mod pulse;
mod restitution;
mod streams;
mod wall;

pub use building::{BuildingDraw, BuildingSpread, is_first_side_along_x};
pub use correlation::spectral_correlation_ratio;
pub use ground::{
    Component, Deviation, GroundSpread, SpreadOptions, WorldDraw, WorldSpectra, world_motion,
};
pub use pulse::{
    ACCEPTED_FAULT_MAGNITUDES, FARTHEST_PULSE_M, FAULT_MAGNITUDES, MOST_FAULT_DISTANCE_M,
    NearFault, Pulses, WorldPulse, pulse_amplification_ratio, pulse_period_s, pulse_probability,
    rupture_length_km, without_pulse_ratio,
};
pub use restitution::{RESTITUTION_SPREAD, restitution_at, restitution_draw};
pub use streams::{Group, WORLD_GENERATOR, object_stream, place_among, world_stream};
pub use wall::{
    WALL_DAMPING_RATIO, WALL_STIFFNESS_RATIO, WallDraw, wall_cushion_at, wall_draw,
    wall_restitution_at,
};

use thiserror::Error;

/// Why no world can be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum WorldError {
    /// A spread or a correlation is out of its range.
    #[error("{name} must be from 0 to {most}, not {value}")]
    Range {
        /// What the number is.
        name: &'static str,
        /// The largest value that is accepted.
        most: f64,
        /// The value that was given.
        value: f64,
    },
}

fn within(name: &'static str, most: f64, value: f64) -> Result<(), WorldError> {
    if (0.0..=most).contains(&value) {
        Ok(())
    } else {
        Err(WorldError::Range { name, most, value })
    }
}

#[cfg(test)]
mod tests;
