//! What an answer depends on, and what to measure first.

use crate::result::{Cause, MeasureFirst, Shares};
use freestand::decision::jansen_share;
use freestand::worlds::Group;
use freestand_input::problem::Problems;

use super::Context;
use super::draw::Change;
use super::trial::{Life, Trial, has_event, live_again};

/// Fewest worlds with the event, and without it, from which a share says anything.
const FEWEST: usize = 10;

/// Worlds in which one group is drawn again.
const MAX_WORLDS: usize = 160;

/// The 90 % point of a normal distribution.
const NORMAL_90: f64 = 1.281_551_565_544_600_4;

/// A probability within this factor of the accepted one may lie on its other side where one group
/// is known.
const NEAR_FACTOR: f64 = 4.0;

/// What may be measured.
const MEASURED: [Cause; 4] = [Cause::Building, Cause::Restitution, Cause::Pad, Cause::Body];

impl Cause {
    fn group(self) -> Group {
        match self {
            Self::Motion => Group::Motion,
            Self::Building => Group::Building,
            Self::Restitution => Group::Restitution,
            Self::Pad => Group::Pad,
            Self::Body => Group::Body,
            Self::Model => Group::Model,
        }
    }
}

/// For each trial; `None` where it is not asked or no world has the event.
pub(super) fn shares(context: &Context, trials: &[Trial]) -> Result<Vec<Option<Shares>>, Problems> {
    let mut found: Vec<Option<Shares>> = trials.iter().map(|_| None).collect();
    if !context.wants_shares {
        return Ok(found);
    }
    let mut asked: Vec<Asked> = trials
        .iter()
        .enumerate()
        .filter(|(_, trial)| is_asked(context, trial))
        .filter_map(|(place, trial)| Asked::new(place, trial))
        .collect();
    let mut wanted: Vec<(usize, Cause, Change)> = Vec::new();
    for cause in Cause::ALL {
        let changes = [
            (true, Change::Again(cause.group())),
            (false, Change::At(cause.group(), -NORMAL_90)),
            (false, Change::At(cause.group(), NORMAL_90)),
        ];
        for (place, one) in asked.iter().enumerate() {
            let is_varied = is_varied(context, one.trial, cause);
            let is_near = one.is_near && MEASURED.contains(&cause);
            let wants =
                |is_share: bool| is_varied && if is_share { one.wants_shares } else { is_near };
            let changes = changes.iter().filter(|(is_share, _)| wants(*is_share));
            wanted.extend(changes.map(|(_, change)| (place, cause, *change)));
        }
    }
    let life = |&(place, _, change): &(usize, Cause, Change)| Life {
        trial: asked[place].trial,
        worlds: u32::try_from(asked[place].own.len()).unwrap_or(u32::MAX),
        change,
    };
    let lives: Vec<Life> = wanted.iter().map(life).collect();
    let mut events: Vec<Vec<bool>> = wanted.iter().map(|_| Vec::new()).collect();
    live_again(context, &lives, |place, lived| {
        let trial = lives[place].trial;
        events[place].extend(lived.iter().map(|one| has_event(trial, one)));
    })?;
    drop(lives);
    // The two ends of a group follow each other.
    let mut low = None;
    for ((place, cause, change), events) in wanted.into_iter().zip(events) {
        let one = &mut asked[place];
        match change {
            Change::At(_, normal) if normal < 0.0 => low = Some(share(&events)),
            Change::At(..) => {
                let next = MeasureFirst {
                    cause,
                    low_ratio: low.take().unwrap_or_default(),
                    high_ratio: share(&events),
                };
                let accepted = one.trial.member.accepted_ratio;
                let crosses = (next.low_ratio > accepted) != (next.high_ratio > accepted);
                let width = |of: MeasureFirst| (of.high_ratio - of.low_ratio).abs();
                // The widest first.
                if crosses
                    && one
                        .measure_first
                        .is_none_or(|first| width(next) > width(first))
                {
                    one.measure_first = Some(next);
                }
            }
            Change::Again(_) | Change::None => {
                let pairs: Vec<(bool, bool)> = one.own.iter().copied().zip(events).collect();
                one.by_group
                    .push((cause, jansen_share(&pairs).map(|share| share.total_ratio)));
            }
        }
    }
    for Asked {
        place,
        by_group,
        measure_first,
        ..
    } in asked
    {
        found[place] = Some(Shares {
            by_group,
            measure_first,
        });
    }
    Ok(found)
}

/// A trial with the event in some of its worlds.
struct Asked<'a> {
    place: usize,
    trial: &'a Trial<'a>,
    /// Whether each of its first worlds has the event.
    own: Vec<bool>,
    wants_shares: bool,
    is_near: bool,
    by_group: Vec<(Cause, Option<f64>)>,
    /// The group whose probabilities at its 10 % and its 90 % point lie on both sides of the
    /// accepted one.
    measure_first: Option<MeasureFirst>,
}

impl<'a> Asked<'a> {
    fn new(place: usize, trial: &'a Trial<'a>) -> Option<Self> {
        let worlds = trial.lived.len().min(MAX_WORLDS);
        let own: Vec<bool> = trial.lived[..worlds]
            .iter()
            .map(|lived| has_event(trial, lived))
            .collect();
        let accepted = trial.member.accepted_ratio;
        let hits = own.iter().filter(|hit| **hit).count();
        // With friction a history takes too long for so many changes.
        let slips = trial
            .lived
            .iter()
            .any(|lived| lived.slips && lived.is_for_pads());
        (hits > 0 && !slips).then_some(Self {
            place,
            trial,
            wants_shares: has_both(hits, worlds),
            is_near: is_near(share(&own), accepted),
            own,
            by_group: Vec::new(),
            measure_first: None,
        })
    }
}

/// Whether there are enough worlds with the event and without it.
fn has_both(hits: usize, worlds: usize) -> bool {
    hits >= FEWEST && worlds - hits >= FEWEST
}

/// Whether the probability may lie on the other side of the accepted one where one group is known.
fn is_near(p: f64, accepted: f64) -> bool {
    p * NEAR_FACTOR > accepted && p < NEAR_FACTOR * accepted
}

/// How many changes are tried, and in how many worlds, of an object that has the event with this probability.
pub(super) fn changes(p: f64, accepted: f64, worlds: usize) -> (usize, usize) {
    let worlds = worlds.min(MAX_WORLDS);
    let hits = (p * worlds as f64).round() as usize;
    let of_shares = Cause::ALL.len() * usize::from(has_both(hits, worlds));
    let at_ends = 2 * MEASURED.len() * usize::from(hits > 0 && is_near(p, accepted));
    (of_shares + at_ends, worlds)
}

fn share(events: &[bool]) -> f64 {
    events.iter().filter(|hit| **hit).count() as f64 / events.len().max(1) as f64
}

/// Histories that take long are repeated only where the study says so.
fn is_asked(context: &Context, trial: &Trial) -> bool {
    !trial.subject.way.is_slow() || context.study.assessment.worlds.shares == Some(true)
}

/// What is under it counts where there are pads or a friction that is drawn.
fn is_varied(context: &Context, trial: &Trial, cause: Cause) -> bool {
    let friction = trial
        .subject
        .drawn_friction_ratio(&context.study.assessment);
    cause != Cause::Pad
        || trial.subject.body.is_some()
        || friction.is_some_and(|(low, high)| low < high)
}
