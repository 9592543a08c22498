//! The kernel against the scalar solver, and against itself.

mod agreement;
mod determinism;
mod edges;
mod extremes;
mod trouble;
