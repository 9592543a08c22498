//! Files in, results out: quantities with units, record formats, the study as written, as meant and run, and its outputs.

pub mod assess;
pub mod building;
pub mod compliant;
pub mod cushion;
pub mod cushion_curve;
pub mod drop_test;
pub mod error;
pub mod figures;
#[cfg(test)]
mod fixture;
pub mod floor;
pub mod input;
pub mod inspect;
pub mod inventory;
pub mod law;
pub mod library;
pub mod matched;
mod options;
pub mod output;
pub mod outputs;
pub mod pair;
pub mod processing;
pub mod quantity;
pub mod recorded;
pub mod records;
pub mod report;
pub mod rerun;
pub mod resolve;
pub mod result;
pub mod rock;
pub mod run;
pub mod shape;
pub mod shock;
pub mod shock_spectrum;
pub mod simulated;
pub mod spectrum;
pub mod static_test;
pub mod statistics;
pub mod streamed;
pub mod study;
pub mod summary;
pub mod tables;
pub mod target;
pub mod validate;
pub mod vary;
pub mod virtual_laboratory;
pub mod words;

/// The design document: its examples are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../DESIGN.md")]
pub struct Design;

pub use error::{Problem, ProblemKind, StudyError};
