//! A whole inventory: assessed part by part, each part stored when it is done, then ranked.

use std::ops::ControlFlow;
use std::path::Path;

use crate::kept_motions::KeptMotions;
use crate::output::words::listed;
use crate::output::{JsonRows, Lived, Row};
use crate::rank::Urgency;
use crate::result::{Assessment, Decision};
use crate::two_spectra::{refuse_outcomes, worse};
use crate::verdict::{Context, Member, Subject, assess_group, blank, restraint_of};
use crate::worlds::Worlds;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_inventory::{Inventory, Item};
use freestand_output::folder::OutputFolder;
use freestand_study::run::{Progress, Stage, Step};
use freestand_study::study::Study;
use serde_json::{Map, Value};

use super::store::{PROGRESS, Part, Store};

/// A finished assessment, or the finished part of one that was stopped.
pub(super) struct Portfolio<'a> {
    inventory: &'a Inventory,
    store: Store,
    parts: Vec<Part>,
    /// The rank of each row of the inventory; further rows were not assessed.
    ranks: Vec<u32>,
    /// Objects that an earlier run finished.
    pub(super) resumed: usize,
    /// Objects that this run assessed.
    pub(super) computed: usize,
    /// Whether it was stopped before its end.
    pub(super) interrupted: bool,
    /// Rocking histories that this run computed.
    pub(super) histories: u64,
    /// Objects by decision, in the order of [`Decision::ALL`].
    pub(super) decisions: [usize; Decision::COUNT],
    /// Objects by tier.
    pub(super) tiers: [usize; 4],
    /// Objects with a history that failed.
    pub(super) failed: usize,
    /// Objects that are left as they are, assessed for falling alone.
    pub(super) only_falling: usize,
    /// The worlds that were asked.
    pub(super) lived: Lived,
    /// The worlds of this run, where it assessed objects: their ground motions are still there.
    pub(super) worlds: Option<Worlds<'a>>,
}

/// The files that a run keeps in its output folder until it is finished.
pub fn progress_names(parts: &[Part]) -> Vec<String> {
    Store::names(parts)
        .map(|name| format!("{}/{name}", PROGRESS))
        .collect()
}

/// Called with the row of each object when it is finished, as it will be in `objects.csv`; its rank is
/// that among the objects which were told before it.
pub type Finished<'a> = &'a dyn Fn(&Map<String, Value>);

/// Assesses every object of `inventory` on its floor of `study`, on the current thread pool, part by
/// part. Parts that are in the store are read from it, the others are computed and stored.
///
/// The result of an object depends on its own row, the study and the seed, but not on other rows,
/// their order, the number of threads or interruptions, nor on what parts the rows are in.
///
/// # Errors
/// A motion that cannot be generated, or a folder that cannot be written. A stop is not an error:
/// the result then has the objects that were finished.
pub(super) fn assess<'a>(
    study: &'a Study,
    inventory: &'a Inventory,
    (store, parts): (Store, Vec<Part>),
    (wants_outcomes, motions): (bool, Option<&Path>),
    (progress, finished): (Progress, Option<Finished>),
) -> Result<Portfolio<'a>, Problems> {
    let total = inventory.items.len();
    let wants_to_stop = || {
        progress(Step {
            stage: None,
            done: 0,
            total: 0,
        })
        .is_break()
    };
    let mut portfolio = Portfolio {
        inventory,
        store,
        parts: Vec::new(),
        ranks: Vec::new(),
        resumed: 0,
        computed: 0,
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
    refuse_outcomes(wants_outcomes, alternative.as_ref())?;
    let mut assessor = Assessor::new((study, total), (wants_outcomes, motions), &wants_to_stop)
        .beside(alternative.as_ref());
    let mut list = Vec::with_capacity(total);
    let rows = finished.map(|tell| (JsonRows::new(inventory), tell));
    let mut ranked: Vec<Urgency> = Vec::new();
    for part in parts {
        let items = inventory.items.get(part.rows.clone()).unwrap_or_default();
        if progress(Step {
            stage: Some(Stage::Objects),
            done: part.rows.start,
            total,
        })
        .is_break()
        {
            portfolio.interrupted = true;
            break;
        }
        let found = match assessor.part(&portfolio.store, &part, items, progress) {
            Ok(Assessed {
                found,
                is_stored: true,
            }) => {
                portfolio.resumed += found.len();
                found
            }
            Ok(Assessed {
                found,
                is_stored: false,
            }) => {
                portfolio.computed += found.len();
                found
            }
            Err(error) if error.is_stopped() => {
                portfolio.interrupted = true;
                break;
            }
            Err(error) => return Err(error),
        };
        portfolio.count(items, &found);
        if let Some((rows, tell)) = &rows {
            for (item, found) in items.iter().zip(&found) {
                let urgency = Urgency::new(item, found);
                let place = ranked.partition_point(|other| other.cmp(&urgency).is_lt());
                ranked.insert(place, urgency);
                tell(&rows.row(item, place + 1, found));
            }
        }
        list.extend(
            items
                .iter()
                .zip(&found)
                .map(|(item, found)| Urgency::new(item, found)),
        );
        portfolio.parts.push(part);
    }
    portfolio.histories = assessor.histories();
    portfolio.worlds = assessor.worlds;
    portfolio.rank(list);
    Ok(portfolio)
}

/// Assesses parts of an inventory; the worlds are made for the first part that needs them.
pub(super) struct Assessor<'a, 's> {
    study: &'a Study,
    /// Rows of the whole inventory.
    total: usize,
    wants_outcomes: bool,
    /// Where the ground motions of worlds are kept, if they are.
    motions: Option<&'s Path>,
    wants_to_stop: &'s (dyn Fn() -> bool + Sync),
    context: Option<Context<'s>>,
    /// The study with the other spectrum of its national annex.
    alternative: Option<&'s Study>,
    /// Its worlds.
    other: Option<Context<'s>>,
    /// The worlds, once a part needed them.
    worlds: Option<Worlds<'a>>,
}

/// The results of a part.
pub(super) struct Assessed {
    pub(super) found: Vec<Assessment>,
    /// Whether they were in the store already.
    pub(super) is_stored: bool,
}

impl<'a: 's, 's> Assessor<'a, 's> {
    /// For a study and an inventory with `total` rows.
    pub(super) fn new(
        (study, total): (&'a Study, usize),
        (wants_outcomes, motions): (bool, Option<&'s Path>),
        wants_to_stop: &'s (dyn Fn() -> bool + Sync),
    ) -> Self {
        let (context, worlds) = (None, None);
        Self {
            study,
            total,
            wants_outcomes,
            motions,
            wants_to_stop,
            context,
            alternative: None,
            other: None,
            worlds,
        }
    }

    /// With the other spectrum of a national annex beside: of each object the worse result counts.
    pub(super) fn beside(self, alternative: Option<&'s Study>) -> Self {
        Self {
            alternative,
            ..self
        }
    }

    /// Rocking histories that were computed.
    pub(super) fn histories(&self) -> u64 {
        self.context
            .iter()
            .chain(&self.other)
            .map(Context::histories)
            .sum()
    }

    /// A part from the store, or computed and stored.
    ///
    /// # Errors
    /// A motion that cannot be generated, a folder that cannot be written, or a stop.
    pub(super) fn part(
        &mut self,
        store: &Store,
        part: &Part,
        items: &[Item],
        progress: Progress,
    ) -> Result<Assessed, Problems> {
        let is_complete = !self.wants_outcomes || store.has_outcomes(part);
        let stored = store.read(part, items.iter().map(|item| item.id.as_str()));
        if let Some(found) = stored.filter(|_| is_complete) {
            return Ok(Assessed {
                found,
                is_stored: true,
            });
        }
        let context = match &mut self.context {
            Some(context) => context,
            empty => {
                let worlds = shake(self.study, self.motions, progress)?;
                self.worlds = Some(worlds.at_intensity(1.0));
                empty.insert(Context::new(
                    self.study,
                    worlds,
                    self.total,
                    self.wants_to_stop,
                ))
            }
        };
        let mut rows = self.wants_outcomes.then(Vec::new);
        let mut found = assess_part(context, items, rows.as_mut())?;
        if let Some(study) = self.alternative {
            let other = match &mut self.other {
                Some(context) => context,
                // Their motions are not kept: those of the first spectrum have the same names.
                empty => empty.insert(Context::new(
                    study,
                    shake(study, None, progress)?,
                    self.total,
                    self.wants_to_stop,
                )),
            };
            let by_other = assess_part(other, items, None)?;
            let triples = items.iter().zip(found).zip(by_other);
            found = triples
                .map(|((item, one), by_other)| worse(item, study, one, by_other))
                .collect();
        }
        if let Some(rows) = rows {
            store.write_outcomes(part, &rows)?;
        }
        store.write(part, &found)?;
        Ok(Assessed {
            found,
            is_stored: false,
        })
    }
}

/// The worlds of a study; with `motions`, their ground motions are kept in this folder.
///
/// # Errors
/// A motion that cannot be generated, or a stop.
pub(super) fn shake<'a>(
    study: &'a Study,
    motions: Option<&Path>,
    progress: Progress,
) -> Result<Worlds<'a>, Problems> {
    let go_on = || match progress(Step {
        stage: Some(Stage::GroundMotions),
        done: 0,
        total: 0,
    }) {
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
    outcomes: Option<&mut Vec<u8>>,
) -> Result<Vec<Assessment>, Problems> {
    let settings = &context.study.assessment;
    let mut found: Vec<Option<Assessment>> = vec![None; items.len()];
    let (mut places, mut members) = (Vec::new(), Vec::new());
    for (place, item) in items.iter().enumerate() {
        let nothing = |why| {
            Some(Assessment {
                why,
                ..blank(item, settings)
            })
        };
        if item.anchored == Some(true) {
            // The force to check them for: by the code alone, because nothing is simulated.
            let restraint = Subject::new(item, settings).map_or_else(
                |_| Vec::new(),
                |held| restraint_of(context.study, item, &held, None),
            );
            let why = "Reported as anchored; its anchors were not checked.".to_owned();
            found[place] = Some(Assessment {
                why,
                restraint,
                ..blank(item, settings)
            });
            continue;
        }
        match Subject::new(item, settings) {
            Ok(subject) if context.worlds.has_floor(subject.level_ratio) => {
                places.push(place);
                members.push(Member::new(item, subject, settings));
            }
            Ok(_) => {
                found[place] = nothing(
                    "Nothing was assessed, because the study has no motion for this floor."
                        .to_owned(),
                );
            }
            Err(missing) => {
                let verb = if missing.len() == 1 { "was" } else { "were" };
                found[place] = nothing(format!(
                    "Nothing was assessed, because the {} {verb} not given.",
                    listed(&missing)
                ));
            }
        }
    }
    for (place, assessed) in places
        .into_iter()
        .zip(assess_group(context, &members, outcomes)?)
    {
        found[place] = Some(assessed);
    }
    Ok(found.into_iter().flatten().collect())
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
        order.sort_by(|a, b| list[*a as usize].cmp(&list[*b as usize]));
        self.ranks = vec![0; list.len()];
        for (rank, row) in order.into_iter().enumerate() {
            self.ranks[row as usize] = rank as u32 + 1;
        }
    }

    /// The results in the order of the inventory, read part by part from where they are stored.
    pub(super) fn rows(&self) -> impl Iterator<Item = Result<Row<'a>, Problem>> + '_ {
        self.parts.iter().flat_map(move |part| {
            let items = self
                .inventory
                .items
                .get(part.rows.clone())
                .unwrap_or_default();
            let ranks = self.ranks.get(part.rows.clone()).unwrap_or_default();
            let found = self
                .store
                .read(part, items.iter().map(|item| item.id.as_str()));
            match found {
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
    pub(super) fn outcomes(&self) -> impl Iterator<Item = Result<Vec<u8>, Problem>> {
        self.parts
            .iter()
            .map(|part| self.store.outcomes(part).ok_or_else(disappeared))
    }

    /// Keeps the finished parts next to the outputs, for a run that resumes.
    pub(super) fn keep_in(&self, folder: &OutputFolder) -> Result<(), Problem> {
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
