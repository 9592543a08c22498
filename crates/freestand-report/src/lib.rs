//! Results as people read them: sentences, tables, pages, workbooks and figures. A function takes the
//! struct that the calculation gives, and calculates nothing itself.

pub mod assessment;
pub mod cushion;
pub mod doubts;
pub mod figures;
pub mod fragility;
pub mod ground;
pub mod library;
pub mod list;
pub mod motion;
mod near_fault;
pub mod object;
pub mod place;
#[cfg(test)]
#[path = "../../freestand-output/tests/print/check.rs"]
mod print_check;
pub mod restraint;
pub mod risk;
pub mod rocking;
pub mod shock;
pub mod signature;
pub mod spectrum;
pub mod study;
mod svg;
pub mod table;
pub mod target;
pub mod validation;
