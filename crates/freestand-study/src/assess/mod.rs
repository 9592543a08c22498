//! The assessment of an inventory: which objects must be restrained, which want a softer pad, which may stay as they are.

pub mod restraint;
pub mod result;

pub use result::{Assessment, Decision};

use crate::inventory::Item;

/// What every page of an assessment shares.
#[derive(Debug, Clone, PartialEq)]
pub struct Head {
    /// Name and value in words: the inventory and its fingerprint, the study, the hazard, the building, the motions, seed, version.
    pub facts: Vec<(String, String)>,
    /// What was assumed, one sentence each, with its source.
    pub assumptions: Vec<String>,
    /// Doubts.
    pub warnings: Vec<String>,
    /// Rows of the inventory; more than there are results where the run was interrupted.
    pub total: usize,
}

/// One object with its place in the list: 1 is the most urgent.
#[derive(Debug, Clone, PartialEq)]
pub struct Row<'a> {
    /// 1 … the number of results.
    pub rank: usize,
    /// As written.
    pub item: &'a Item,
    /// As found.
    pub found: Assessment,
}
