//! Files in, results out: quantities with units, record formats, the study as written, as meant and run, and its outputs.

pub mod error;
pub mod output;
pub mod quantity;
pub mod records;

pub use error::{Problem, ProblemKind, StudyError};
