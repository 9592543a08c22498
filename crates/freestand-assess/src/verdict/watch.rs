//! What a run tells while objects live through their worlds: how much of its work is done, and what the
//! worlds say so far.
//!
//! Effort is counted in histories in one plane on a rigid base, which other work is measured against
//! (benches/README.md). It is no time: what is told does not depend on the machine.

use std::sync::atomic::{AtomicU64, Ordering};
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

/// Worlds that an object needs, as a share of the most that it may, before any is lived.
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
    /// The usual effort of the motions of the ground and of floors, most of it in the first part.
    floors: u64,
    questions: usize,
    done: AtomicU64,
    state: Mutex<State>,
}

#[derive(Debug, Clone, Copy, Default)]
struct State {
    /// Questions that are settled, of the parts before, and of this one.
    before: usize,
    now: usize,
    /// The usual effort of the objects that are ahead, and of what is or was done.
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
            floors: of_floors(settings, items) as u64,
            questions: items.iter().map(|item| questions(item, settings)).sum(),
            done: AtomicU64::new(0),
            state: Mutex::new(State {
                ahead: of_objects(settings, items) as u64,
                ..State::default()
            }),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A part begins; one that is stored takes no effort.
    pub(crate) fn begin(&self, items: &[Item], is_stored: bool) {
        let usual = of_objects(self.settings, items) as u64;
        let mut state = self.state();
        state.ahead = state.ahead.saturating_sub(usual);
        if !is_stored {
            let is_first = state.begun == 0;
            let usual = usual + if is_first { self.floors } else { 0 };
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
            state.ahead + self.floors
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

/// What an assessment of these objects usually takes, in histories in one plane on a rigid base.
pub fn usual_effort(settings: &Settings, items: &[Item]) -> u64 {
    (of_objects(settings, items) + of_floors(settings, items)) as u64
}

fn of_objects(settings: &Settings, items: &[Item]) -> f64 {
    let of = |item: &Item| {
        let (accepted, _) = accepted(item, settings);
        let most = settings.worlds.looks.worlds(accepted).ok();
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
    items.iter().filter(|item| is_followed(item)).map(of).sum()
}

/// The motions of the ground and of floors. Of several objects one usually needs the most worlds that it may; each floor is
/// needed in as many as its objects.
fn of_floors(settings: &Settings, items: &[Item]) -> f64 {
    let followed = || items.iter().filter(|item| is_followed(item));
    let levels = levels_ratio(followed());
    let most = f64::from(settings.worlds.looks.most());
    let ground = (USUAL_SHARE * followed().count() as f64).min(1.0) * GROUND as f64;
    most * (ground + USUAL_SHARE * (FLOOR * levels.len() as u64) as f64)
}

/// The floors of objects, each once, from the lowest.
pub(crate) fn levels_ratio<'i>(items: impl Iterator<Item = &'i Item>) -> Vec<f64> {
    let mut levels: Vec<f64> = items.filter_map(|item| item.level_ratio).collect();
    levels.sort_unstable_by(f64::total_cmp);
    levels.dedup();
    levels
}

fn is_followed(item: &Item) -> bool {
    item.anchored != Some(true) && item.height_m.is_some() && item.thickness_m.is_some()
}
