//! The assessment of an inventory: which objects must be restrained, which want a softer pad, which may stay as they are.
//!
//! Cheaper tiers first: an object that no motion of its floor can lift is done with its threshold (tier 0); where that is asked
//! for, one that is far from the line on the uplift spectra of its floor is done with them (tier 1); every other one is followed
//! about both its axes under every motion, again and again with its uncertain values drawn anew (tier 2); one near the line is
//! tried on a compliant base (tier 3).

mod beside;
mod capacity;
pub mod csv;
mod decision;
#[cfg(test)]
mod fixture;
mod group;
mod hazard;
mod head;
mod job;
mod object;
pub mod outputs;
pub mod overview;
pub mod parquet;
mod portfolio;
pub mod report;
mod response;
pub mod restraint;
pub mod result;
mod screen;
mod second_opinion;
pub mod sources;
mod store;
pub mod table;
mod tornado;
mod uncertainty;
mod verdict;
pub mod words;
pub mod workbook;

use std::sync::atomic::{AtomicU64, Ordering};

use crate::inventory::Item;
use freestand_study::study::Study;
use group::Member;

pub use head::head;
pub use job::{Job, JobReport, SCHEMA, assess_into, inventory_of};
use result::FloorFacts;
pub use result::{Assessment, Decision};
use store::PROGRESS;

/// Why a run ended before its end.
pub(crate) const STOPPED: &str = "the run was stopped before its end";

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

/// What the assessments of all objects share.
pub(crate) struct Context<'a> {
    study: &'a Study,
    /// The motions.
    names: Vec<String>,
    /// Their keys for random numbers.
    keys: Vec<u64>,
    spectra: screen::Spectra,
    wants_to_stop: &'a (dyn Fn() -> bool + Sync),
    histories: AtomicU64,
}

impl Context<'_> {
    /// Counts histories that were followed.
    fn count(&self, histories: usize) {
        self.histories.fetch_add(histories as u64, Ordering::Relaxed);
    }
}

/// An object of which nothing is known but what its row says.
fn blank(item: &Item, accepted: (f64, &str), floor: Option<FloorFacts>) -> Assessment {
    Assessment {
        id: item.id.clone(),
        decision: Decision::NoVerdict,
        why: String::new(),
        tier: 0,
        accepted_ratio: accepted.0,
        accepted_for: accepted.1.to_owned(),
        floor,
        response: None,
        shock: None,
        capacity: None,
        p_overturn: None,
        p_exceed: None,
        draws: 0,
        sliding: None,
        softening: None,
        compliant: None,
        tornado: Vec::new(),
        restraint: Vec::new(),
        clearance_m: None,
        context: Vec::new(),
        chain: None,
        notes: notes(item),
    }
}

/// How the row was read, and what it left to assumptions.
fn notes(item: &Item) -> Vec<String> {
    let mut notes: Vec<String> = item.cushion.iter().flat_map(|edge| edge.notes.clone()).collect();
    notes.extend(item.cushion_source.iter().map(|source| format!("cushion: {source}")));
    if item.width_m.is_none() {
        notes.push("no width: looked at about one axis only".to_owned());
    }
    notes
}

impl Member<'_> {
    fn blank(&self, floor: FloorFacts) -> Assessment {
        blank(self.item, (self.accepted_ratio, self.accepted_for), Some(floor))
    }
}
