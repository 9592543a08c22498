//! Which objects of an inventory must be restrained: the inventory, the libraries of tolerances and
//! cushions, and the assessment.
//!
//! An assessment takes two calls: [`job::inventory_of`] reads the inventory; [`job::assess_into`]
//! makes the motions of its floors, gives every object its verdict and writes the tables and the
//! report.

pub mod job;
pub mod one_object;
pub mod output;
mod rank;
pub mod restrain;
mod restraint;
pub mod result;

mod accepted;
mod assumed;
mod kept_motions;
mod two_spectra;
pub mod verdict;
pub mod worlds;
