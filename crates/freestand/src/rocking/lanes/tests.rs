//! The kernel against the scalar solver, and against itself.

#![expect(clippy::unwrap_used, reason = "a test may stop at an error")]

mod agreement;
mod determinism;
mod edges;
mod extremes;
mod trouble;
