//! Which objects of an inventory must be restrained: the worlds they live through and their verdicts.
//!
//! [`list::inventory_of`] reads the inventory; [`portfolio::assess`] makes the motions of its floors and gives
//! every object its verdict, part by part.

pub mod accepted;
pub mod assumed;
pub mod axis;
pub mod capacity;
pub mod key;
pub mod list;
pub mod one_object;
pub mod portfolio;
pub mod rank;
pub mod reason;
pub mod restrain;
pub mod result;
pub mod store;
pub mod verdict;
pub mod worlds;

mod kept_motions;
pub mod restraint;
pub mod two_spectra;
