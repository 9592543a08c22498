//! The kernel against the scalar solver, and against itself; what work both take.

mod agreement;
mod determinism;
mod edges;
mod effort;
mod extremes;
mod shape;
mod trouble;
