//! Worlds: complete draws of everything that is not known.
//!
//! World i = 0, 1, 2 … has random numbers of its own, so the first n worlds are the same however
//! many are made, in whatever order and on however many threads. What all objects share (the
//! ground, the building) is keyed by (seed, i), what is an object's own by (seed, i, object).

mod restitution;
mod streams;

pub use restitution::{RESTITUTION_SPREAD, restitution_at, restitution_draw};
pub use streams::{Group, WORLD_GENERATOR, object_stream, world_stream};

#[cfg(test)]
mod tests;
