//! What a run tells while objects live through their worlds: how much of its work is done, and what the
//! worlds say so far.
//!
//! Effort is counted in histories in one plane on a rigid base, which other work is measured against
//! (benches/README.md). It is no time: what is told does not depend on the machine.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use freestand_inventory::Item;
use freestand_study::run::{Progress, Stage, Step};
use freestand_study::study::Study;
use freestand_study::study::assessment::{Dimensions, Settings};

use crate::accepted::accepted;
use crate::result::Probability;

use super::asks_shock;

/// A history in one plane on pads.
pub(super) const ON_PADS: u64 = 12;
/// A history that is followed alone, in three dimensions or of a stack.
pub(super) const ALONE: u64 = 800;
/// The ground motions of a world, and its motion of a floor.
pub(super) const GROUND: u64 = 100;
pub(super) const FLOOR: u64 = 4;

/// Worlds that an object needs, as a share of the most that it may, before any is lived. The ground moves in
/// as many as the object that needs most.
const USUAL_SHARE: f64 = 0.15;
/// How much more is done with an object than its worlds take: softer pads, what its answer depends on.
const BESIDE: f64 = 1.5;

/// An object after some of its worlds.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate<'a> {
    /// The object.
    pub item: &'a Item,
    /// Its worlds.
    pub worlds: u32,
    /// The probability that it falls, by the model that counts.
    pub overturn: Probability,
    /// The probability that its tolerance is exceeded, by the model that counts; `None`: it is not asked.
    pub exceed: Option<Probability>,
    /// Whether its worlds suffice.
    pub is_settled: bool,
}

/// Called with the objects of a part after each look at their worlds.
pub type TellEstimates<'a> = &'a (dyn Fn(&[Estimate]) + Sync);

/// Who watches a run, and how far it has come.
pub struct Watch<'a> {
    progress: Progress<'a>,
    estimates: Option<TellEstimates<'a>>,
    settings: &'a Settings,
    questions: usize,
    done: AtomicU64,
    /// Worlds whose ground motions were made; they are kept.
    worlds: AtomicU32,
    state: Mutex<State>,
}

#[derive(Debug, Clone, Copy, Default)]
struct State {
    /// Questions that are settled, of the parts before, and of this one.
    before: usize,
    now: usize,
    /// The usual effort of what is ahead, and of what is or was done.
    ahead: u64,
    begun: u64,
    /// The effort that was done and is expected until the end of this part.
    expected: u64,
}

impl<'a> Watch<'a> {
    /// For a run over these objects.
    pub fn new(
        study: &'a Study,
        items: &[Item],
        estimates: Option<TellEstimates<'a>>,
        progress: Progress<'a>,
    ) -> Self {
        let settings = &study.assessment;
        Self {
            progress,
            estimates,
            settings,
            questions: items.iter().map(|item| questions(item, settings)).sum(),
            done: AtomicU64::new(0),
            worlds: AtomicU32::new(0),
            state: Mutex::new(State {
                ahead: usual_effort(settings, items),
                ..State::default()
            }),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A part begins; one that is stored takes no effort.
    pub(crate) fn begin(&self, items: &[Item], is_stored: bool) {
        let usual = usual_effort(self.settings, items);
        let mut state = self.state();
        state.ahead = state.ahead.saturating_sub(usual);
        if !is_stored {
            state.begun += usual;
            state.expected = self.effort() + usual;
        }
        drop(state);
        self.tell();
    }

    /// All questions of a part are settled.
    pub(crate) fn end(&self, items: &[Item]) {
        let mut state = self.state();
        let asked = items.iter().map(|item| questions(item, self.settings));
        (state.before, state.now) = (state.before + asked.sum::<usize>(), 0);
        state.expected = self.effort();
        drop(state);
        self.tell();
    }

    fn effort(&self) -> u64 {
        self.done.load(Ordering::Relaxed)
    }

    /// How many of these worlds are the first with their ground motions.
    pub(super) fn new_worlds(&self, worlds: &Range<u32>) -> u32 {
        let before = self.worlds.fetch_max(worlds.end, Ordering::Relaxed);
        worlds.end.saturating_sub(before.max(worlds.start))
    }

    /// So much more is done.
    pub(super) fn add(&self, effort: u64) {
        self.done.fetch_add(effort, Ordering::Relaxed);
        self.tell();
    }

    /// Of the objects that were not assessed before this part, so many questions are settled, and this is
    /// what they still need.
    pub(super) fn looked(&self, settled: usize, left: u64, estimates: &[Estimate]) {
        let mut state = self.state();
        (state.now, state.expected) = (settled, self.effort() + left);
        drop(state);
        if let Some(tell) = self.estimates {
            tell(estimates);
        }
        self.tell();
    }

    fn tell(&self) {
        let state = *self.state();
        let (done, expected) = (self.effort(), state.expected.max(self.effort()));
        // What is ahead takes as much more or less than usual as what was begun.
        let unusual = expected as f64 / state.begun.max(1) as f64;
        let ahead = if state.begun == 0 {
            state.ahead
        } else {
            (state.ahead as f64 * unusual) as u64
        };
        // Whether the run is to stop is asked elsewhere.
        let _ = (self.progress)(Step {
            effort: Some((done, expected + ahead)),
            ..Step::new(
                Stage::Objects,
                (state.before + state.now).min(self.questions),
                self.questions,
            )
        });
    }
}

/// What is asked of an object: whether it falls, and whether a shock is too hard for it.
fn questions(item: &Item, settings: &Settings) -> usize {
    if item.anchored == Some(true) {
        return 0;
    }
    let has_shock = item.tolerance.is_some() && asks_shock(item, settings.questions);
    1 + usize::from(has_shock)
}

/// What objects usually take, in histories in one plane on a rigid base.
pub fn usual_effort(settings: &Settings, items: &[Item]) -> u64 {
    let looks = settings.worlds.looks;
    let of = |item: &Item| {
        if item.anchored == Some(true) || item.height_m.is_none() || item.thickness_m.is_none() {
            return 0.0;
        }
        let (accepted, _) = accepted(item, settings);
        let most = looks.worlds(accepted).ok();
        let most = most.and_then(|looks| looks.last().copied()).unwrap_or(0);
        let has_pads = item.mass_kg.is_some() && item.cushion.is_some();
        let planes = 1 + u64::from(item.width_m.is_some());
        let is_alone =
            item.is_followed_alone() || has_pads && settings.dimensions == Dimensions::Three;
        let in_world = match (is_alone, has_pads && settings.compliant) {
            (true, _) => ALONE,
            (false, true) => planes * (1 + ON_PADS),
            (false, false) => planes,
        };
        USUAL_SHARE * f64::from(most) * in_world as f64 * BESIDE
    };
    let worlds = (USUAL_SHARE * items.len() as f64).min(1.0) * f64::from(looks.most());
    let mut levels: Vec<u64> = items
        .iter()
        .filter_map(|item| item.level_ratio.map(f64::to_bits))
        .collect();
    levels.sort_unstable();
    levels.dedup();
    let of_floors =
        worlds * GROUND as f64 + (worlds * USUAL_SHARE) * (FLOOR * levels.len() as u64) as f64;
    (items.iter().map(of).sum::<f64>() + of_floors) as u64
}
