//! The verdict on each object: restrain it, put it on a softer pad, or leave it as it is.
//!
//! Tier 0 decides objects that no motion of their floor can uplift, by their threshold. Tier 1,
//! which is off unless the study asks for it, decides objects whose probability is far from the
//! accepted one, by the uplift spectra of their floor. Tier 2 follows every other object about both
//! axes under every motion, with repeated draws of its uncertain values. Tier 3 repeats the motions
//! on a compliant base where the probability is near the accepted one.

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
use crate::result::{AcceptedFor, Assessment, Decision, FloorFacts};
use freestand_study::study::Study;

pub(crate) use decision::{accepted, listed};
pub(crate) use group::{Member, assess_group};
pub(crate) use object::Subject;

/// What all objects share.
pub(crate) struct Context<'a> {
    pub(crate) study: &'a Study,
    /// Names of the motions.
    pub(crate) names: Vec<String>,
    /// Their keys for random numbers.
    keys: Vec<u64>,
    spectra: screen::Spectra,
    wants_to_stop: &'a (dyn Fn() -> bool + Sync),
    histories: AtomicU64,
}

impl<'a> Context<'a> {
    /// For motions of these names; no history is counted yet.
    pub(crate) fn new(study: &'a Study, names: Vec<String>, wants_to_stop: &'a (dyn Fn() -> bool + Sync)) -> Self {
        let keys = names.iter().map(|name| uncertainty::key(name)).collect();
        Self { study, names, keys, spectra: Default::default(), wants_to_stop, histories: AtomicU64::new(0) }
    }

    /// Rocking histories that were computed.
    pub(crate) fn histories(&self) -> u64 {
        self.histories.load(Ordering::Relaxed)
    }

    /// Counts histories that were computed.
    fn count(&self, histories: usize) {
        self.histories.fetch_add(histories as u64, Ordering::Relaxed);
    }
}

/// The assessment of an object before anything is computed.
pub(crate) fn blank(item: &Item, accepted: (f64, AcceptedFor), floor: Option<FloorFacts>) -> Assessment {
    Assessment {
        id: item.id.clone(),
        decision: Decision::NoVerdict,
        why: String::new(),
        tier: 0,
        accepted_ratio: accepted.0,
        accepted_for: accepted.1,
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

/// How the row was read, and what was assumed where it is silent.
fn notes(item: &Item) -> Vec<String> {
    let mut notes: Vec<String> = item.cushion.iter().flat_map(|edge| edge.notes.clone()).collect();
    notes.extend(item.cushion_source.iter().map(|source| format!("Cushion: {source}.")));
    if item.width_m.is_none() {
        notes.push("No width is given, so rocking was computed about one axis only.".to_owned());
    }
    notes
}

impl Member<'_> {
    fn blank(&self, floor: FloorFacts) -> Assessment {
        blank(self.item, (self.accepted_ratio, self.accepted_for), Some(floor))
    }
}
