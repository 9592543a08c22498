//! Files in, results out: quantities with units, record formats, the study as written, as meant and run, and its outputs.

pub mod error;
mod options;
pub mod quantity;
pub mod shock;

pub use error::{Problem, ProblemKind, StudyError};
