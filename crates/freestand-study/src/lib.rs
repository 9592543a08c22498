//! Files in, results out: quantities with units, record formats, the study as written, as meant and run, and its outputs.

pub mod error;
pub mod figures;
#[cfg(test)]
mod fixture;
pub mod report;
pub mod result;
#[cfg(test)]
mod scratch;
pub mod study;

pub use error::{Problem, ProblemKind, StudyError};
