//! The assessment of an inventory: which objects must be restrained, which want a softer pad, which may stay as they are.
//!
//! Cheaper tiers first: an object that no motion of its floor can lift is done with its threshold (tier 0); where that is asked
//! for, one that is far from the line on the uplift spectra of its floor is done with them (tier 1); every other one is followed
//! about both its axes under every motion, again and again with its uncertain values drawn anew (tier 2); one near the line is
//! tried on a compliant base (tier 3).

mod assessment;
mod capacity;
mod comparisons;
mod decision;
mod group;
mod object;
mod response;
mod screen;
mod second_opinion;
mod tornado;
mod uncertainty;

use std::sync::atomic::{AtomicU64, Ordering};

use crate::inventory::Item;
use crate::result::{Assessment, Decision, FloorFacts};
use freestand_study::study::Study;

pub(crate) use decision::accepted;
pub(crate) use group::{Member, assess_group};
pub(crate) use object::Subject;

/// What the assessments of all objects share.
pub(crate) struct Context<'a> {
    pub(crate) study: &'a Study,
    /// The motions.
    pub(crate) names: Vec<String>,
    /// Their keys for random numbers.
    keys: Vec<u64>,
    spectra: screen::Spectra,
    wants_to_stop: &'a (dyn Fn() -> bool + Sync),
    histories: AtomicU64,
}

impl<'a> Context<'a> {
    /// Nothing is followed yet, under motions of these names.
    pub(crate) fn new(study: &'a Study, names: Vec<String>, wants_to_stop: &'a (dyn Fn() -> bool + Sync)) -> Self {
        let keys = names.iter().map(|name| uncertainty::key(name)).collect();
        Self { study, names, keys, spectra: Default::default(), wants_to_stop, histories: AtomicU64::new(0) }
    }

    /// Rocking histories that were followed.
    pub(crate) fn histories(&self) -> u64 {
        self.histories.load(Ordering::Relaxed)
    }

    /// Counts histories that were followed.
    fn count(&self, histories: usize) {
        self.histories.fetch_add(histories as u64, Ordering::Relaxed);
    }
}

/// An object of which nothing is known but what its row says.
pub(crate) fn blank(item: &Item, accepted: (f64, &str), floor: Option<FloorFacts>) -> Assessment {
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
