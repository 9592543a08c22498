//! The assessment of an inventory: which objects must be restrained, which want a softer pad, which may stay as they are.

pub mod csv;
#[cfg(test)]
mod fixture;
pub mod outputs;
pub mod overview;
pub mod parquet;
pub mod report;
pub mod result;
pub mod sources;
pub mod table;
pub mod words;
pub mod workbook;

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
