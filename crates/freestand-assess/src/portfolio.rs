//! A whole inventory: assessed part by part, each part stored when it is done, then ranked.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use rayon::prelude::*;

use crate::kept_motions::KeptMotions;
use crate::rank::Urgency;
use crate::reason::Reason;
use crate::result::{Assessment, Decision};
use crate::two_spectra::{refuse_outcomes, worse};
use crate::verdict::{
    Context, Grouped, Member, Subject, WriteOutcomes, assess_group, blank, forces_by_sizes,
    levels_ratio,
};
pub use crate::verdict::{Estimate, TellEstimates, Watch, usual_effort};
use crate::worlds::Worlds;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_inventory::{Inventory, Item};
use freestand_output::folder::OutputFolder;
use freestand_study::run::{Progress, Stage, Step};
use freestand_study::study::Study;

use crate::store::{PROGRESS, Part, Store};

/// A finished assessment, or the finished part of one that was stopped.
pub struct Portfolio<'a> {
    inventory: &'a Inventory,
    store: Store,
    parts: Vec<Part>,
    /// The rank of each row of the inventory; further rows were not assessed.
    ranks: Vec<u32>,
    /// Objects that an earlier run finished.
    pub resumed: usize,
    /// Objects that this run assessed.
    pub computed: usize,
    /// Objects whose worlds did not suffice before it was stopped.
    pub unsettled: usize,
    /// Whether it was stopped before its end.
    pub interrupted: bool,
    /// Rocking histories that this run computed.
    pub histories: u64,
    /// Objects by decision, in the order of [`Decision::ALL`].
    pub decisions: [usize; Decision::COUNT],
    /// Objects by tier.
    pub tiers: [usize; 4],
    /// Objects with a history that failed.
    pub failed: usize,
    /// Objects that are left as they are, assessed for falling alone.
    pub only_falling: usize,
    /// The worlds that were asked.
    pub lived: Lived,
    /// The worlds of this run, where it assessed objects: their ground motions are still there.
    pub worlds: Option<Worlds<'a>>,
}

/// The files that a run keeps in its output folder until it is finished.
pub fn progress_names(parts: &[Part]) -> Vec<String> {
    Store::names(parts)
        .map(|name| format!("{}/{name}", PROGRESS))
        .collect()
}

/// Called with each object when it is finished; its rank is that among the objects which were told before
/// it.
pub type TellObject<'a> = &'a dyn Fn(&Item, usize, &Assessment);

/// Who is told of objects.
#[derive(Clone, Copy, Default)]
pub struct Tell<'a> {
    /// When they are finished.
    pub objects: Option<TellObject<'a>>,
    /// After each look at their worlds.
    pub estimates: Option<TellEstimates<'a>>,
}

/// What is kept of every world beside the results.
#[derive(Clone, Copy, Default)]
pub struct Keep<'a> {
    /// How the outcomes are written, if they are.
    pub outcomes: Option<WriteOutcomes>,
    /// Where the ground motions are kept, if they are.
    pub motions: Option<&'a Path>,
}

/// One object with its rank: 1 is the most urgent.
#[derive(Debug, Clone, PartialEq)]
pub struct Row<'a> {
    /// 1 … the number of results.
    pub rank: usize,
    /// Its row of the inventory.
    pub item: &'a Item,
    /// Its assessment.
    pub found: Assessment,
}

/// The worlds that objects lived through.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lived {
    /// The number of worlds of the object with the most.
    pub worlds: u32,
    /// The floors of the objects, in rising order: 0 ground, 1 roof.
    pub levels: Vec<f64>,
}

impl Lived {
    /// An object lived through the first `worlds` worlds on this floor.
    fn add(&mut self, worlds: u32, level_ratio: f64) {
        self.worlds = self.worlds.max(worlds);
        let place = self.levels.partition_point(|level| *level < level_ratio);
        if self.levels.get(place) != Some(&level_ratio) {
            self.levels.insert(place, level_ratio);
        }
    }
}

/// Assesses every object of `inventory` on its floor of `study`, on the current thread pool, part by
/// part. Parts that are in the store are read from it, the others are computed and stored.
///
/// The result of an object depends on its own row, the study and the seed, but not on other rows,
/// their order, the number of threads or interruptions, nor on what parts the rows are in.
///
/// # Errors
/// A motion that cannot be generated, or a folder that cannot be written. A stop is not an error:
/// the result then has the parts that were begun, and their worlds are stored for a run that goes on.
pub fn assess<'a>(
    study: &'a Study,
    inventory: &'a Inventory,
    store: Store,
    parts: Vec<Part>,
    keep: Keep,
    tell: Tell,
    progress: Progress,
) -> Result<Portfolio<'a>, Problems> {
    let total = inventory.items.len();
    let wants_to_stop = || progress(Step::asks()).is_break();
    let watch = Watch::new(study, &inventory.items, tell.estimates, progress);
    let mut portfolio = Portfolio {
        inventory,
        store,
        parts: Vec::new(),
        ranks: Vec::new(),
        resumed: 0,
        computed: 0,
        unsettled: 0,
        interrupted: false,
        histories: 0,
        decisions: [0; Decision::COUNT],
        tiers: [0; 4],
        failed: 0,
        only_falling: 0,
        lived: Lived::default(),
        worlds: None,
    };
    let alternative = study.alternative();
    refuse_outcomes(keep.outcomes.is_some(), alternative.as_ref())?;
    let mut assessor = Assessor::new(study, total, keep, &wants_to_stop, &watch)
        .beside(alternative.as_ref())
        .with_peaks_of(&inventory.items);
    let mut list = Vec::with_capacity(total);
    let mut ranked: Vec<Urgency> = Vec::new();
    for part in parts {
        let items = inventory.items.get(part.rows.clone()).unwrap_or_default();
        if wants_to_stop() {
            portfolio.interrupted = true;
            break;
        }
        let Assessed { found, state } =
            match assessor.part(&portfolio.store, &part, items, progress) {
                Err(error) if error.is_stopped() => {
                    portfolio.interrupted = true;
                    break;
                }
                found => found?,
            };
        let unsettled = found.iter().filter(|one| one.was_stopped()).count();
        portfolio.unsettled += unsettled;
        match state {
            PartState::Stored => portfolio.resumed += found.len(),
            PartState::Computed | PartState::Stopped => {
                portfolio.computed += found.len() - unsettled;
            }
        }
        portfolio.count(items, &found);
        if let Some(tell) = tell.objects {
            for (item, found) in items.iter().zip(&found) {
                let urgency = Urgency::new(item, found);
                let place = ranked.partition_point(|other| other.order(&urgency).is_lt());
                ranked.insert(place, urgency);
                tell(item, place + 1, found);
            }
        }
        list.extend(
            items
                .iter()
                .zip(&found)
                .map(|(item, found)| Urgency::new(item, found)),
        );
        portfolio.parts.push(part);
        if state == PartState::Stopped {
            portfolio.interrupted = true;
            break;
        }
    }
    portfolio.histories = assessor.histories();
    portfolio.worlds = assessor.worlds;
    portfolio.rank(list);
    Ok(portfolio)
}

/// Assesses parts of an inventory; the worlds are made for the first part that needs them.
pub struct Assessor<'a, 's> {
    study: &'a Study,
    /// Rows of the whole inventory.
    total: usize,
    keep: Keep<'s>,
    wants_to_stop: &'s (dyn Fn() -> bool + Sync),
    watch: &'s Watch<'s>,
    context: Option<Context<'s>>,
    /// The study with the other spectrum of its national annex.
    alternative: Option<&'s Study>,
    /// Its worlds.
    other: Option<Context<'s>>,
    /// The worlds, once a part needed them.
    worlds: Option<Worlds<'a>>,
    /// The floors whose peaks will be asked in every world.
    peaks_at_ratio: Arc<[f64]>,
}

/// The results of a part.
pub struct Assessed {
    /// One for each row.
    pub found: Vec<Assessment>,
    /// Where they come from.
    pub state: PartState,
}

/// Where the results of a part come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PartState {
    /// They were in the store already.
    Stored,
    /// They were calculated.
    Computed,
    /// The run was stopped before they were complete; the worlds so far are stored.
    Stopped,
}

impl<'a: 's, 's> Assessor<'a, 's> {
    /// For a study and an inventory with `total` rows.
    pub fn new(
        study: &'a Study,
        total: usize,
        keep: Keep<'s>,
        wants_to_stop: &'s (dyn Fn() -> bool + Sync),
        watch: &'s Watch<'s>,
    ) -> Self {
        let (context, worlds) = (None, None);
        Self {
            study,
            total,
            keep,
            wants_to_stop,
            watch,
            context,
            alternative: None,
            other: None,
            worlds,
            peaks_at_ratio: Arc::default(),
        }
    }

    /// For a run that states the peaks of the floors of these objects in every world.
    fn with_peaks_of(self, items: &[Item]) -> Self {
        Self {
            peaks_at_ratio: levels_ratio(items.iter()).into(),
            ..self
        }
    }

    /// With the other spectrum of a national annex beside: of each object the worse result counts.
    pub fn beside(self, alternative: Option<&'s Study>) -> Self {
        Self {
            alternative,
            ..self
        }
    }

    /// Rocking histories that were computed.
    pub fn histories(&self) -> u64 {
        self.context
            .iter()
            .chain(&self.other)
            .map(Context::histories)
            .sum()
    }

    /// A part from the store, or computed and stored.
    ///
    /// # Errors
    /// A motion that cannot be generated, a folder that cannot be written, or a stop before any object of the part
    /// had a world.
    pub fn part(
        &mut self,
        store: &Store,
        part: &Part,
        items: &[Item],
        progress: Progress,
    ) -> Result<Assessed, Problems> {
        let is_complete = self.keep.outcomes.is_none() || store.has_outcomes(part);
        let stored = store.read(part, items.iter().map(|item| item.id.as_str()));
        let stored = stored.filter(|_| is_complete);
        self.watch.begin(items, stored.is_some());
        if let Some(found) = stored {
            self.watch.end(items);
            let state = PartState::Stored;
            return Ok(Assessed { found, state });
        }
        let context = match &mut self.context {
            Some(context) => context,
            empty => {
                let worlds = shake(self.study, self.keep.motions, progress)?;
                let worlds = worlds.with_peaks_of(Arc::clone(&self.peaks_at_ratio));
                self.worlds = Some(worlds.at_intensity(1.0));
                let context = Context::new(self.study, worlds, self.total, self.wants_to_stop);
                empty.insert(context.watched(self.watch))
            }
        };
        let earlier = store.lived(part);
        let of_part = assess_part(context, items, earlier.as_deref(), self.keep.outcomes)?;
        let Grouped {
            mut found,
            rows,
            lived,
        } = of_part;
        if let Some(rows) = rows {
            store.write_outcomes(part, &rows)?;
        }
        if let Some(lived) = lived {
            store.write_stopped(part, &found, &lived)?;
            let state = PartState::Stopped;
            return Ok(Assessed { found, state });
        }
        if let Some(study) = self.alternative {
            let other = match &mut self.other {
                Some(context) => context,
                // Their motions are not kept: those of the first spectrum have the same names.
                empty => {
                    let worlds = shake(study, None, progress)?;
                    let context = Context::new(study, worlds, self.total, self.wants_to_stop);
                    empty.insert(context.watched(self.watch))
                }
            };
            let by_other = assess_part(other, items, None, None)?;
            if by_other.lived.is_some() {
                // The worlds of two spectra are not kept: the part is repeated.
                return Err(Problem::stopped().into());
            }
            let triples = items.iter().zip(found).zip(by_other.found);
            found = triples
                .map(|((item, one), by_other)| worse(item, study, one, by_other))
                .collect();
        }
        store.write(part, &found)?;
        self.watch.end(items);
        let state = PartState::Computed;
        Ok(Assessed { found, state })
    }
}

/// The worlds of a study; with `motions`, their ground motions are kept in this folder.
///
/// # Errors
/// A motion that cannot be generated, or a stop.
pub fn shake<'a>(
    study: &'a Study,
    motions: Option<&Path>,
    progress: Progress,
) -> Result<Worlds<'a>, Problems> {
    let go_on = || match progress(Step::new(Stage::GroundMotions, 0, 0)) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Problem::stopped().into()),
    };
    let worlds = Worlds::new(study, go_on)?;
    Ok(match motions {
        Some(folder) => worlds.kept_in(KeptMotions::new(folder)),
        None => worlds,
    })
}

/// One part: the objects with level and geometry in their worlds, and the others without a verdict.
fn assess_part(
    context: &Context,
    items: &[Item],
    earlier: Option<&[u8]>,
    outcomes: Option<WriteOutcomes>,
) -> Result<Grouped, Problems> {
    let settings = &context.study.assessment;
    let mut found: Vec<Option<Assessment>> = vec![None; items.len()];
    // A body that is no block takes a third of a second: how far it tilts before it falls is searched.
    let free = |item: &Item| -> Result<Option<_>, Problems> {
        context.go_on()?;
        let is_anchored = item.anchored == Some(true);
        Ok((!is_anchored).then(|| Subject::new(item, settings)))
    };
    let subjects: Vec<Result<Option<_>, Problems>> = items.par_iter().map(free).collect();
    let subjects: Vec<Option<_>> = subjects.into_iter().collect::<Result<_, Problems>>()?;
    let (mut places, mut members) = (Vec::new(), Vec::new());
    for (place, (item, subject)) in items.iter().zip(subjects).enumerate() {
        let nothing = |why| {
            Some(Assessment {
                why: vec![why],
                ..blank(item, settings)
            })
        };
        let Some(subject) = subject else {
            found[place] = Some(Assessment {
                why: vec![Reason::Anchored],
                // The force to check its anchors for: by the code alone, because nothing is simulated.
                restraint: forces_by_sizes(context.study, item),
                ..blank(item, settings)
            });
            continue;
        };
        match subject {
            Ok(subject) if context.worlds.has_floor(subject.level_ratio) => {
                places.push(place);
                members.push(Member::new(item, subject, settings));
            }
            Ok(_) => {
                found[place] = nothing(Reason::NoMotion);
            }
            Err(missing) => {
                found[place] = nothing(Reason::NotGiven(missing));
            }
        }
    }
    let grouped = assess_group(context, &members, earlier, outcomes)?;
    for (place, assessed) in places.into_iter().zip(grouped.found) {
        found[place] = Some(assessed);
    }
    Ok(Grouped {
        found: found.into_iter().flatten().collect(),
        ..grouped
    })
}

impl<'a> Portfolio<'a> {
    fn count(&mut self, items: &[Item], found: &[Assessment]) {
        for (item, one) in items.iter().zip(found) {
            if let (Some(answers), Some(level_ratio)) = (&one.answers, item.level_ratio) {
                self.lived.add(answers.worlds, level_ratio);
            }
            if let Some(place) = Decision::ALL
                .iter()
                .position(|decision| *decision == one.decision)
            {
                self.decisions[place] += 1;
            }
            if let Some(tier) = self.tiers.get_mut(usize::from(one.tier)) {
                *tier += 1;
            }
            self.only_falling += usize::from(one.is_left_for_falling_alone());
            self.failed += usize::from(one.has_failed_histories());
        }
    }

    /// Ranks the objects that were assessed, which are the first rows of the inventory.
    fn rank(&mut self, list: Vec<Urgency>) {
        let mut order: Vec<u32> = (0..list.len() as u32).collect();
        order.sort_by(|a, b| list[*a as usize].order(&list[*b as usize]));
        self.ranks = vec![0; list.len()];
        for (rank, row) in order.into_iter().enumerate() {
            self.ranks[row as usize] = rank as u32 + 1;
        }
    }

    /// The results in the order of the inventory, read part by part from where they are stored.
    pub fn rows(&self) -> impl Iterator<Item = Result<Row<'a>, Problem>> + '_ {
        self.parts.iter().flat_map(move |part| {
            let items = self
                .inventory
                .items
                .get(part.rows.clone())
                .unwrap_or_default();
            let ranks = self.ranks.get(part.rows.clone()).unwrap_or_default();
            let ids = || items.iter().map(|item| item.id.as_str());
            let found = self.store.read(part, ids());
            match found.or_else(|| self.store.read_stopped(part, ids())) {
                Some(found) => {
                    let rows = items.iter().zip(found).zip(ranks);
                    rows.map(|((item, found), rank)| {
                        Ok(Row {
                            rank: *rank as usize,
                            item,
                            found,
                        })
                    })
                    .collect::<Vec<_>>()
                }
                None => vec![Err(disappeared())],
            }
        })
    }

    /// The outcomes of each finished part.
    pub fn outcomes(&self) -> impl Iterator<Item = Result<Vec<u8>, Problem>> {
        self.parts
            .iter()
            .map(|part| self.store.outcomes(part).ok_or_else(disappeared))
    }

    /// Keeps the finished parts next to the outputs, for a run that resumes.
    pub fn keep_in(&self, folder: &OutputFolder) -> Result<(), Problem> {
        for name in Store::names(&self.parts).filter(|name| self.store.has(name)) {
            self.store
                .link(&name, &folder.place_for(&format!("{}/{name}", PROGRESS))?)?;
        }
        Ok(())
    }
}

fn disappeared() -> Problem {
    Problem::new(
        ProblemKind::Io,
        "a finished part of the assessment has disappeared",
    )
    .hint("repeat the run with `resume = true`: the missing parts are computed again")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_in_rising_order_and_once() {
        let mut lived = Lived::default();
        for (worlds, level_ratio) in [(20, 0.5), (40, 1.0), (20, 0.0), (20, 0.5), (20, 0.25)] {
            lived.add(worlds, level_ratio);
        }
        assert_eq!(
            lived,
            Lived {
                worlds: 40,
                levels: vec![0.0, 0.25, 0.5, 1.0]
            }
        );
    }
}
