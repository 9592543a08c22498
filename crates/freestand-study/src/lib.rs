//! From a study as written to its results, and the requests of single commands.

pub mod at_place;
pub mod building;
pub mod compliant;
pub mod cushion;
pub mod doubt;
pub mod drawn;
pub mod drawn_body;
pub mod floor;
pub mod hull;
pub mod inspect;
pub mod laboratory;
pub mod law;
pub mod matched;
pub mod near_fault;
mod options;
pub mod pair;
pub mod places;
pub mod provenance;
pub mod recorded;
pub mod rerun;
pub mod resolve;
pub mod restitution;
pub mod result;
pub mod rock;
pub mod run;
pub mod shape;
pub mod shock;
pub mod shock_spectrum;
pub mod simulated;
pub mod sliding;
pub mod spatial;
pub mod spectrum;
pub mod statistics;
pub mod study;
pub mod suite;
pub mod summary;
pub mod target;
pub mod unsolved;
pub mod validate;
pub mod vary;
pub mod walls;

/// The design document: its examples are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../DESIGN.md")]
pub struct Design;
