//! Files in, results out: quantities with units, record formats, the study as written, as meant and run, and its outputs.

pub mod error;
pub mod figures;
#[cfg(test)]
mod fixture;
mod options;
pub mod output;
pub mod outputs;
pub mod quantity;
pub mod recorded;
pub mod records;
pub mod report;
pub mod resolve;
pub mod result;
pub mod rock;
pub mod run;
#[cfg(test)]
mod scratch;
pub mod shock;
pub mod statistics;
pub mod study;
pub mod summary;
pub mod tables;
mod words;

pub use error::{Problem, ProblemKind, StudyError};
