//! The verdict on each object: restrain it, put it on a softer pad, or leave it as it is.
//!
//! Every object lives through worlds, each one complete draw of everything that is not known
//! ([`crate::worlds`], `draw`): on a rigid base, and on its pads where it has any (`trial`). Worlds
//! are added until the interval of each probability leaves the accepted one, or there are as many
//! as could settle it. Two questions are answered apart, whether it falls and whether a shock is
//! too hard for it (`decision`); a softer pad is accepted where it would be left alone on it
//! (`softer`).

mod ahead;
mod answers;
mod assessment;
mod before_wall;
mod braked;
mod comparisons;
mod decision;
mod demand;
mod draw;
mod followed;
mod held;
mod kept;
mod nominal;
mod notes;
mod object;
mod on_pads;
mod outcomes;
mod over_worlds;
mod per_year;
mod respond;
mod response;
mod shares;
mod slip;
mod softer;
mod stiff_floor;
mod tally;
mod trial;
mod watch;

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use crate::accepted::accepted;
use crate::reason::Reason;
use crate::result::{Assessment, Decision, FallsAnswer};
use crate::worlds::Worlds;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_inventory::{Consequences, Item, Rating};
use freestand_study::study::Study;
use freestand_study::study::assessment::{Questions, Settings};

use trial::Trial;

pub(crate) use comparisons::forces_by_sizes;
pub use comparisons::{P58_BETA, P58_SHARE, code_force};
pub use decision::deciding;
pub use followed::{Follow, Shown, ShownEarthquake};
pub use held::{Effect, Grip, GripAt, Measure, NotCalculated, Restrained, Wanted, restrained};
pub use nominal::{NoShockLimits, Nominal, NominalRun, NotFollowed};
pub use object::{HULL_FRICTION_RATIO, middle};
pub(crate) use object::{Subject, round_body};
pub use outcomes::{OutcomeRow, WriteOutcomes};
pub use tally::Tally;
pub(crate) use watch::levels_ratio;
pub use watch::{Estimate, TellEstimates, Watch, usual_effort};

/// What all objects share.
pub(crate) struct Context<'a> {
    pub(crate) study: &'a Study,
    pub(crate) worlds: Worlds<'a>,
    /// Whether it is calculated what the answers depend on.
    wants_shares: bool,
    wants_to_stop: &'a (dyn Fn() -> bool + Sync),
    /// `None`: nobody is told how far it has come.
    watch: Option<&'a Watch<'a>>,
    histories: AtomicU64,
}

/// Rows of an inventory up to which it is calculated what the answers depend on, where the study
/// does not say.
const MAX_ROWS_WITH_SHARES: usize = 500;

impl<'a> Context<'a> {
    /// For an inventory of `rows`; no history is counted yet.
    pub(crate) fn new(
        study: &'a Study,
        worlds: Worlds<'a>,
        rows: usize,
        wants_to_stop: &'a (dyn Fn() -> bool + Sync),
    ) -> Self {
        let wants_shares = study
            .assessment
            .worlds
            .shares
            .unwrap_or(rows <= MAX_ROWS_WITH_SHARES);
        Self {
            study,
            worlds,
            wants_shares,
            wants_to_stop,
            watch: None,
            histories: AtomicU64::new(0),
        }
    }

    /// The same for a run that somebody watches.
    pub(crate) fn watched(self, watch: &'a Watch<'a>) -> Self {
        Self {
            watch: Some(watch),
            ..self
        }
    }

    /// The same in other worlds; no history is counted yet.
    fn in_worlds(&self, worlds: Worlds<'a>) -> Self {
        Self {
            study: self.study,
            worlds,
            wants_shares: self.wants_shares,
            wants_to_stop: self.wants_to_stop,
            watch: self.watch,
            histories: AtomicU64::default(),
        }
    }

    /// Rocking histories that were computed.
    pub(crate) fn histories(&self) -> u64 {
        self.histories.load(Ordering::Relaxed)
    }

    /// Counts histories that were computed.
    fn count(&self, histories: usize) {
        self.histories
            .fetch_add(histories as u64, Ordering::Relaxed);
    }

    /// Counts effort, for those who watch.
    fn add(&self, effort: u64) {
        if let Some(watch) = self.watch {
            watch.add(effort);
        }
    }

    /// An error where the run is to stop.
    pub(crate) fn go_on(&self) -> Result<(), Problems> {
        if (self.wants_to_stop)() {
            Err(Problem::stopped().into())
        } else {
            Ok(())
        }
    }
}

/// An object, and what is asked of it.
pub(crate) struct Member<'a> {
    pub(crate) item: &'a Item,
    pub(crate) subject: Subject,
    pub(crate) accepted_ratio: f64,
    /// Whether its verdict rests on shocks too.
    pub(crate) asks_shock: bool,
    /// Its random numbers.
    key: u64,
}

impl<'a> Member<'a> {
    pub(crate) fn new(item: &'a Item, subject: Subject, settings: &Settings) -> Self {
        let (accepted_ratio, _) = accepted(item, settings);
        let asks_shock = asks_shock(item, settings.questions);
        Self {
            item,
            subject,
            accepted_ratio,
            asks_shock,
            key: draw::key(&item.id),
        }
    }
}

/// Whether the verdict of a row rests on shocks too: as it says, as the study says, or where it has
/// a tolerance or its function or the property is rated high.
fn asks_shock(item: &Item, of_study: Option<Questions>) -> bool {
    let Consequences {
        function, property, ..
    } = item.consequences;
    let is_high = [function, property].contains(&Some(Rating::High));
    match item.questions.or(of_study) {
        Some(questions) => questions == Questions::FallsAndShock,
        None => item.tolerance.is_some() || is_high,
    }
}

/// Some objects after their worlds, in their order.
pub(crate) struct Grouped {
    /// The assessments.
    pub(crate) found: Vec<Assessment>,
    /// What happened to them in every world, as `outcomes` writes it.
    pub(crate) rows: Option<Vec<u8>>,
    /// The worlds that they lived through, where the run was stopped before the end.
    pub(crate) lived: Option<Vec<u8>>,
}

/// Assesses some objects, from the worlds on that an `earlier` run lived through. Where the run is stopped, what is
/// known so far stays.
pub(crate) fn assess_group(
    context: &Context,
    members: &[Member],
    earlier: Option<&[u8]>,
    outcomes: Option<WriteOutcomes>,
) -> Result<Grouped, Problems> {
    let mut trials = trials(context, members);
    if let Some(earlier) = earlier {
        kept::resume(context, &mut trials, earlier);
    }
    let done = lived(context, &mut trials).and_then(|()| assessed(context, &trials));
    let (found, lived) = match done {
        Err(error) if error.is_stopped() => {
            let so_far = trials.par_iter().map(|trial| so_far(context, trial));
            let found: Vec<Result<Assessment, Problems>> = so_far.collect();
            (
                found.into_iter().collect::<Result<_, _>>()?,
                Some(kept::worlds(&trials)?),
            )
        }
        done => (done?, None),
    };
    let rows = outcomes
        .map(|write| write(&mut trials.iter().flat_map(outcomes::outcomes)))
        .transpose()?;
    Ok(Grouped { found, rows, lived })
}

/// What is known of an object where the run is stopped: its verdict only where nothing that was not calculated could
/// change it.
fn so_far(context: &Context, trial: &Trial) -> Result<Assessment, Problems> {
    let stopped = Reason::Stopped {
        worlds: trial.worlds(),
    };
    if trial.lived.is_empty() {
        return Ok(Assessment {
            why: vec![stopped],
            ..blank(trial.member.item, &context.study.assessment)
        });
    }
    let mut found = assessment::assessment(context, trial, (None, None))?;
    let stays = found
        .answers
        .as_ref()
        .is_some_and(|answers| answers.falls == FallsAnswer::Stays);
    let may_change = stays
        && (softer::is_wanted(context, trial)
            || braked::is_wanted(context, trial)
            || stiff_floor::is_wanted(context, trial));
    if may_change || !trial.is_settled() {
        found.decision = Decision::NoVerdict;
        let of_answers = |why: &Reason| matches!(why, Reason::Falling { .. } | Reason::Shock(_));
        found.why.retain(of_answers);
        found.why.insert(0, stopped);
        found.restraint = Vec::new();
    }
    Ok(found)
}

/// What became of one object that is asked alone.
pub(crate) struct AssessedOne {
    /// The same as in a list.
    pub(crate) found: Assessment,
    /// What its worlds add up to.
    pub(crate) tally: Tally,
    /// Some of its earthquakes, where one is followed.
    pub(crate) shown: Option<Shown>,
}

/// The assessment of one object.
pub(crate) fn assess_one(
    context: &Context,
    member: &Member,
    follow: Option<&Follow>,
) -> Result<AssessedOne, Problems> {
    let mut trials = trials(context, std::slice::from_ref(member));
    lived(context, &mut trials)?;
    let nothing = || Problem::new(ProblemKind::Computation, "the object was not assessed");
    let trial = trials.first().ok_or_else(nothing)?;
    let tally = tally::tally(context, trial);
    let shown = follow
        .map(|follow| followed::shown(context, trial, follow))
        .transpose()?
        .flatten();
    Ok(AssessedOne {
        found: assessed(context, &trials)?.pop().ok_or_else(nothing)?,
        tally,
        shown,
    })
}

/// Objects before their first world.
fn trials<'a>(context: &Context, members: &'a [Member<'a>]) -> Vec<Trial<'a>> {
    members
        .iter()
        .map(|member| Trial::new(context, member, member.subject.clone()))
        .collect()
}

/// Objects in as many worlds as their questions need.
fn lived(context: &Context, trials: &mut [Trial]) -> Result<(), Problems> {
    trial::live_telling(context, trials, &|trials| ahead::tell(context, trials))?;
    stiff_floor::check(context, trials)
}

fn assessed(context: &Context, trials: &[Trial]) -> Result<Vec<Assessment>, Problems> {
    let softened = softer::softer(context, trials)?;
    let braked = braked::braked(context, trials)?;
    let shares = shares::shares(context, trials)?;
    let per_year = per_year::per_year(context, trials)?;
    let done: Vec<Result<Assessment, Problems>> = trials
        .par_iter()
        .zip(softened.into_par_iter().zip(braked))
        .zip(shares)
        .zip(per_year)
        .map(|(((trial, tried), shares), per_year)| {
            context.go_on()?;
            let mut assessed = assessment::assessment(context, trial, tried)?;
            (assessed.shares, assessed.per_year) = (shares, per_year);
            Ok(assessed)
        })
        .collect();
    let mut done: Vec<Assessment> = done.into_iter().collect::<Result<_, _>>()?;
    let before = before_wall::before_walls(context, trials, &done)?;
    for (assessed, before) in done.iter_mut().zip(before) {
        assessed
            .why
            .extend(before.iter().map(|_| Reason::BeforeWall));
        assessed.before_wall = before;
    }
    Ok(done)
}

/// The assessment of an object before anything is computed.
pub(crate) fn blank(item: &Item, settings: &Settings) -> Assessment {
    let (accepted_ratio, accepted_for) = accepted(item, settings);
    Assessment {
        id: item.id.clone(),
        decision: Decision::NoVerdict,
        why: Vec::new(),
        tier: 0,
        answers: None,
        model: None,
        at_wall: None,
        rolled: None,
        braked: None,
        before_wall: None,
        in_space: None,
        stacked: None,
        on_pads: None,
        shares: None,
        per_year: None,
        accepted_ratio,
        accepted_for,
        floor: None,
        response: None,
        shock: None,
        capacity: None,
        p_overturn: None,
        p_exceed: None,
        sliding: None,
        softening: None,
        restraint: Vec::new(),
        clearance_m: None,
        comparisons: Vec::new(),
        chain: None,
        notes: Vec::new(),
    }
}
