//! An object in as many worlds as its questions need.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use freestand::decision::{Clusters, Count, Interval, Looks, Side};
use freestand::respond::{Object, Outcome};
use freestand::worlds::Group;
use rayon::prelude::*;

use crate::result::{Probability, TooMild};
use crate::worlds::{Again, FloorOfWorld};
use freestand_input::problem::Problems;
use freestand_study::study::assessment::Spread;

use super::draw::{Change, Draw, Drawn, draw};
use super::object::{Model, Subject, Way};
use super::over_worlds::grouped;
use super::respond::responses;
use super::response::{
    AxisMotion, Lived, Lost, PadMotion, PadResponse, RigidResponse, demand_capacity, overturned,
    pads_demand_capacity,
};
use super::slip::slips;
use super::watch::{ALONE, FLOOR, GROUND, ON_PADS};
use super::{Context, Member};

/// Worlds in which pads with a curved contact law are followed: they take the solver for any law.
const CURVED_WORLDS: u32 = 80;

/// Worlds in which an object slides while it rocks, after which no more are added: they take the same
/// solver.
const SLIPPING_WORLDS: usize = CURVED_WORLDS as usize;

/// The probability of falling of a body on its hull is at most known to be below this: none of 20 histories fell in some
/// of the tests on a shake table that did (docs/validation.md).
pub(super) const MILD_HIGH: f64 = 0.08;

/// Worlds in which a body on its hull is followed, where no more of them could show that it stays.
pub(super) const HULL_WORLDS: u32 = 80;

/// The correlation between worlds with the same record and the same building, at least: the object
/// alone then makes the difference.
const SAME_SHAKING_CORRELATION: f64 = 0.75;

/// Histories of objects on pads between two looks whether to stop: half a second of two cores.
const ON_PADS_AT_ONCE: usize = 4096;

/// What is asked of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Question {
    /// Whether it falls.
    Falls,
    /// Whether a shock exceeds its tolerance; a fall does.
    Shock,
}

/// An object, perhaps with softer pads, and its worlds so far.
pub(super) struct Trial<'a> {
    pub(super) member: &'a Member<'a>,
    pub(super) subject: Subject,
    looks: Vec<u32>,
    pub(super) lived: Vec<Lived>,
    pub(super) is_done: bool,
}

impl<'a> Trial<'a> {
    pub(super) fn new(context: &Context, member: &'a Member<'a>, subject: Subject) -> Self {
        let accepted = member.accepted_ratio;
        let looks = context.looks();
        let looks = match context.worlds.records() {
            None => looks.worlds(accepted),
            Some(records) => looks.worlds_in_passes(accepted, records.max(1)),
        };
        // The settings and the inventory have refused what it refuses.
        Self {
            member,
            subject,
            looks: looks.unwrap_or_default(),
            lived: Vec::new(),
            is_done: false,
        }
    }

    /// Number of worlds.
    pub(super) fn worlds(&self) -> u32 {
        u32::try_from(self.lived.len()).unwrap_or(u32::MAX)
    }

    /// The worlds whose histories on a rigid base are complete, with their numbers.
    pub(super) fn followed(&self) -> impl Iterator<Item = (usize, &[AxisMotion])> {
        let worlds = self.lived.iter().enumerate();
        worlds.filter_map(|(i, one)| Some((i, &one.on_rigid()?.axes[..])))
    }

    /// Whether it ends leaning on a wall, in each world whose history on a rigid base is complete.
    pub(super) fn leans(&self) -> impl Iterator<Item = bool> {
        let found = self.lived.iter().filter_map(Lived::on_rigid);
        found.map(|found| found.outcome == Outcome::Leaned)
    }

    /// The worlds whose histories on pads are complete.
    pub(super) fn followed_on_pads(&self) -> impl Iterator<Item = (&Lived, &[PadMotion])> {
        let worlds = self.lived.iter();
        worlds.filter_map(|one| Some((one, &one.on_pads()?.axes[..])))
    }

    /// The largest number of worlds.
    pub(super) fn cap(&self) -> u32 {
        self.looks.last().copied().unwrap_or(0)
    }

    /// The worlds that come next.
    pub(super) fn next(&self) -> Option<Range<u32>> {
        let from = self.worlds();
        let to = self.looks.iter().copied().find(|&look| look > from)?;
        (!self.is_done).then_some(from..to)
    }

    /// Whether a model is asked.
    pub(super) fn asks(&self, context: &Context, model: Model) -> bool {
        self.subject.asks(model, context.study.assessment.compliant)
    }

    /// The models that are asked.
    pub(super) fn models(&self, context: &Context) -> impl Iterator<Item = Model> {
        [Model::Rigid, Model::Pads]
            .into_iter()
            .filter(|model| self.asks(context, *model))
    }

    /// Yes or no in a world; `None`: it could not be found. The outer `None`: it was not asked.
    pub(super) fn answer(
        &self,
        lived: &Lived,
        question: Question,
        model: Model,
    ) -> Option<Option<bool>> {
        answer(&self.subject, lived, question, model)
    }

    /// The probability by one model, with its interval.
    pub(super) fn probability(
        &self,
        context: &Context,
        question: Question,
        model: Model,
    ) -> Probability {
        let answers: Vec<Option<bool>> = self
            .lived
            .iter()
            .filter_map(|lived| self.answer(lived, question, model))
            .collect();
        let found = Self::probability_of(context, &answers);
        // A fall counts in both questions.
        Probability {
            high: found.high.max(if self.is_mild() { MILD_HIGH } else { 0.0 }),
            ..found
        }
    }

    /// Whether it is followed on its hull, and such bodies fell more often in tests.
    fn is_mild(&self) -> bool {
        matches!(self.subject.way, Way::Hull(..)) && self.subject.too_mild.is_some()
    }

    /// Whether it falls in any world on a rigid base.
    pub(super) fn falls_at_all(&self) -> bool {
        self.followed().any(|(_, axes)| overturned(axes))
    }

    /// The probability of yes, with its interval, from the answers in the worlds in their order.
    pub(super) fn probability_of(context: &Context, answers: &[Option<bool>]) -> Probability {
        let hits = |answers: &[Option<bool>]| {
            answers.iter().filter(|one| **one == Some(true)).count() as u32
        };
        let count = Count {
            worlds: answers.len() as u32,
            hits: hits(answers),
            unknown: answers.iter().filter(|one| one.is_none()).count() as u32,
        };
        let confidence = context.looks().confidence();
        let records = context.worlds.records().unwrap_or(0) as usize;
        let passes = answers.len().checked_div(records).unwrap_or(0);
        let interval = if passes == 0 {
            count.interval(confidence)
        } else {
            // World i uses record i mod n.
            let whole = &answers[..passes * records];
            let of_record = |record: usize| {
                let own: Vec<Option<bool>> = whole
                    .iter()
                    .skip(record)
                    .step_by(records)
                    .copied()
                    .collect();
                hits(&own)
            };
            let by_record: Vec<u32> = (0..records).map(of_record).collect();
            let found = Clusters::with(
                &by_record,
                count.unknown,
                passes as u32,
                context.least_correlation(),
            );
            found.map_or(
                Interval {
                    low: 0.0,
                    high: 1.0,
                },
                |clusters| clusters.interval(confidence),
            )
        };
        Probability {
            value: count.share_ratio(),
            low: interval.low,
            high: interval.high,
        }
    }

    /// Where the probability lies by all models that are asked.
    pub(super) fn side(&self, context: &Context, question: Question) -> Side {
        let side = |model| {
            side(
                self.probability(context, question, model),
                self.member.accepted_ratio,
            )
        };
        let sides: Vec<Side> = self.models(context).map(side).collect();
        Side::of_models(&sides)
    }

    /// Where the probability lies that it rolls or slides farther than it has room; open where it rocks or
    /// no room is known.
    pub(super) fn room_side(&self, context: &Context) -> Side {
        let room_m = self.subject.way.room_m();
        room_m.map_or(Side::Open, |room_m| {
            side(self.beyond(context, room_m), self.member.accepted_ratio)
        })
    }

    /// The probability that it needs more room than this on a side \[m\].
    fn beyond(&self, context: &Context, room_m: f64) -> Probability {
        let answers: Vec<Option<bool>> = self
            .lived
            .iter()
            .map(|lived| Some(self.needed_m(lived)? > room_m))
            .collect();
        Self::probability_of(context, &answers)
    }

    /// The least room that would suffice: the upper end of the probability that it needs more is below
    /// the accepted one. With too few worlds for any, the most that it needs; 0 where it rocks \[m\].
    pub(super) fn room_needed_m(&self, context: &Context) -> f64 {
        let mut rooms: Vec<f64> = self
            .lived
            .iter()
            .filter_map(|lived| self.needed_m(lived))
            .collect();
        rooms.sort_by(f64::total_cmp);
        let suffices = |room_m: f64| {
            side(self.beyond(context, room_m), self.member.accepted_ratio) == Side::Below
        };
        let least = rooms.partition_point(|&room_m| !suffices(room_m));
        rooms.get(least).or(rooms.last()).copied().unwrap_or(0.0)
    }

    /// The room that it needs on every side in a world, 0 where it rocks; `None`: that is not known \[m\].
    fn needed_m(&self, lived: &Lived) -> Option<f64> {
        let outcome = lived.on_rigid()?.outcome;
        Some(outcome.travelled().map_or(0.0, |way| way.room_m))
    }

    /// Whether worlds can still settle a question.
    pub(super) fn is_open(&self, question: Question) -> bool {
        question == Question::Falls || self.member.asks_shock && self.subject.capacity.is_some()
    }

    /// The worlds that an earlier run lived through.
    pub(super) fn resume(&mut self, context: &Context, lived: Vec<Lived>) {
        self.lived = lived;
        // Between two looks no interval is read.
        if self.looks.contains(&self.worlds()) {
            self.settle(context);
        }
    }

    /// Whether more worlds would change nothing.
    pub(super) fn is_settled(&self) -> bool {
        self.next().is_none()
    }

    /// The looks that may follow.
    pub(super) fn looks_ahead(&self) -> impl Iterator<Item = u32> {
        let worlds = self.worlds();
        self.looks
            .iter()
            .copied()
            .filter(move |look| *look > worlds)
    }

    fn settle(&mut self, context: &Context) {
        let falls = self.side(context, Question::Falls);
        let shock =
            || !self.is_open(Question::Shock) || self.side(context, Question::Shock).is_settled();
        let room = || self.subject.way.room_m().is_none() || self.room_side(context).is_settled();
        let is_answered = falls == Side::Above || (falls == Side::Below && shock() && room());
        let slipped = self
            .lived
            .iter()
            .filter(|lived| lived.slips && lived.is_for_pads())
            .count();
        let cannot_stay = self.member.accepted_ratio <= MILD_HIGH
            || self.subject.too_mild == Some(TooMild::UnseenBase)
            || self.falls_at_all();
        let is_enough = self.is_mild() && cannot_stay && self.worlds() >= HULL_WORLDS;
        self.is_done = is_answered || is_enough || slipped >= SLIPPING_WORLDS;
    }
}

pub(super) fn side(p: Probability, accepted: f64) -> Side {
    Interval {
        low: p.low,
        high: p.high,
    }
    .side(accepted)
}

/// Yes or no in a world; `None`: it could not be found. The outer `None`: it was not asked.
pub(super) fn answer(
    subject: &Subject,
    lived: &Lived,
    question: Question,
    model: Model,
) -> Option<Option<bool>> {
    // The outer question is whether the model was asked.
    let model = match model {
        Model::Rigid => lived.rigid.as_ref().map(|_| lived.answering(model))?,
        Model::Pads => model,
    };
    let outcome = match model {
        Model::Rigid => lived.rigid.as_ref()?.as_ref().map(|told| told.outcome),
        Model::Pads => lived.pads.as_ref()?.as_ref().map(|told| told.outcome),
    };
    let has_fallen = outcome.ok().and_then(Outcome::has_fallen);
    if question == Question::Falls || has_fallen != Some(false) {
        return Some(has_fallen);
    }
    let ratio = match model {
        Model::Rigid => lived
            .on_rigid()
            .and_then(|told| demand_capacity(&told.axes)),
        Model::Pads => lived
            .on_pads()
            .and_then(|told| pads_demand_capacity(&told.axes)),
    };
    // Beyond the thickness of a pad its stiffness is not known.
    let thickness_m = subject
        .body
        .as_ref()
        .and_then(|body| body.pad_thickness_m)
        .unwrap_or(f64::INFINITY);
    let compression_m = match model {
        Model::Rigid => lived
            .on_rigid()
            .iter()
            .flat_map(|told| &told.axes)
            .filter_map(|one| Some(one.hit()?.compression_m))
            .fold(0.0, f64::max),
        Model::Pads => lived
            .on_pads()
            .iter()
            .flat_map(|told| &told.axes)
            .map(|one| one.found.compression_m)
            .fold(0.0, f64::max),
    };
    let ratio = ratio.filter(|ratio| *ratio > 1.0 || compression_m <= thickness_m);
    // Where the shock is not known, the floor alone may exceed the tolerance: a shock only adds to it.
    let floor_alone = || {
        // Casters, and a base that slides, keep most of it from the object.
        let peak_m_s2 = subject
            .capacity
            .as_ref()
            .filter(|_| subject.way.glides().is_none())?
            .peak_m_s2?;
        (lived.pfa_m_s2 > peak_m_s2).then_some(true)
    };
    Some(ratio.map(|ratio| ratio > 1.0).or_else(floor_alone))
}

/// Whether it falls or exceeds its tolerance by any model, as far as that is asked.
pub(super) fn has_event(trial: &Trial, lived: &Lived) -> bool {
    let question = if trial.is_open(Question::Shock) {
        Question::Shock
    } else {
        Question::Falls
    };
    let models = [Model::Rigid, Model::Pads].into_iter();
    models
        .filter_map(|model| answer(&trial.subject, lived, question, model)?)
        .any(|yes| yes)
}

/// Adds worlds until every trial is settled or has reached its cap. What was lived stays in the trials
/// where the run is stopped.
pub(super) fn live(context: &Context, trials: &mut [Trial]) -> Result<(), Problems> {
    live_through(context, trials, None)
}

/// Called with the objects after each look.
type Tell<'t> = &'t dyn Fn(&[Trial]);

/// The same for those who want to know of each look, and of the floors.
pub(super) fn live_telling(
    context: &Context,
    trials: &mut [Trial],
    tell: Tell,
) -> Result<(), Problems> {
    live_through(context, trials, Some(tell))
}

fn live_through(
    context: &Context,
    trials: &mut [Trial],
    tell: Option<Tell>,
) -> Result<(), Problems> {
    loop {
        let next = trials
            .iter()
            .enumerate()
            .filter_map(|(place, trial)| Some((trial.next()?, place)));
        let groups = grouped(next);
        if groups.is_empty() {
            return Ok(());
        }
        for (range, places) in groups {
            live_in(context, trials, range, &places, tell.is_some())?;
        }
        trials
            .par_iter_mut()
            .filter(|trial| !trial.is_done)
            .for_each(|trial| trial.settle(context));
        if let Some(tell) = tell {
            tell(trials);
        }
    }
}

/// Adds the next worlds, which are the same ones, to the trials at these places.
pub(super) fn live_on(
    context: &Context,
    trials: &mut [Trial],
    range: Range<u32>,
    places: &[usize],
) -> Result<(), Problems> {
    live_in(context, trials, range, places, false)?;
    for &place in places {
        trials[place].settle(context);
    }
    Ok(())
}

fn live_in(
    context: &Context,
    trials: &mut [Trial],
    range: Range<u32>,
    places: &[usize],
    is_told: bool,
) -> Result<(), Problems> {
    let level = |&place: &usize| (trials[place].subject.level_ratio.to_bits(), place);
    let levels = grouped(places.iter().map(level));
    // Worlds take most of the memory of a part, so their vectors get no spare capacity.
    for &place in places {
        trials[place].lived.reserve_exact(range.len());
    }
    each_block(
        context,
        range,
        &levels,
        Change::None,
        |worlds, on_floors| {
            let standing: Vec<Standing> = on_floors
                .iter()
                .map(|&(place, floors)| Standing {
                    trial: &trials[place],
                    floors,
                    is_told,
                })
                .collect();
            let more = lived_together(context, worlds, &standing, Change::None)?;
            for (&(place, _), more) in on_floors.iter().zip(more) {
                trials[place].lived.extend(more);
            }
            Ok(())
        },
    )
}

/// Motions of floors that are held at a time, of all worlds and floors: 150 MB of two components of
/// 45 s.
const MAX_HELD: usize = 1024;

/// Worlds that are lived through together: a run that is stopped loses those that it is in.
const BLOCK: usize = 40;

/// An object that lives through its first worlds, as they are or with a change.
pub(super) struct Life<'t, 'a> {
    pub(super) trial: &'t Trial<'a>,
    pub(super) worlds: u32,
    pub(super) change: Change,
}

/// Objects in their first worlds; `tell` is called with the place of each and the worlds that come next for
/// it, in their order. Floors are calculated once for all that move in the same way.
pub(super) fn live_again(
    context: &Context,
    lives: &[Life],
    mut tell: impl FnMut(usize, Vec<Lived>),
) -> Result<(), Problems> {
    let by_floors = lives.iter().enumerate();
    let by_floors = grouped(by_floors.map(|(place, life)| (life.change.of_floors(), place)));
    for (of_floors, places) in by_floors {
        let level = |&place: &usize| (lives[place].trial.subject.level_ratio.to_bits(), place);
        let levels = grouped(places.iter().map(level));
        let most = places.iter().map(|&place| lives[place].worlds).max();
        let range = 0..most.unwrap_or(0);
        each_block(context, range, &levels, of_floors, |block, on_floors| {
            let here = on_floors
                .iter()
                .enumerate()
                .filter(|(_, (place, _))| lives[*place].worlds > block.start);
            let alike = here.map(|(among, &(place, _))| {
                let life = &lives[place];
                ((life.change, life.worlds.min(block.end)), among)
            });
            for ((change, end), together) in grouped(alike) {
                let worlds = block.start..end;
                let standing: Vec<Standing> = together
                    .iter()
                    .map(|&among| {
                        let (place, floors) = on_floors[among];
                        Standing {
                            trial: lives[place].trial,
                            floors: &floors[..worlds.len()],
                            is_told: false,
                        }
                    })
                    .collect();
                let more = lived_together(context, worlds, &standing, change)?;
                for (among, more) in together.into_iter().zip(more) {
                    tell(on_floors[among].0, more);
                }
            }
            Ok(())
        })?;
    }
    Ok(())
}

/// An object, and the motions of its floor in some worlds.
#[derive(Clone, Copy)]
struct Standing<'t, 'a> {
    trial: &'t Trial<'a>,
    floors: &'t [Arc<FloorOfWorld>],
    /// Whether somebody is told how its floors move.
    is_told: bool,
}

/// Lives through some worlds block by block, with the place of every object and the motions of its floor.
fn each_block(
    context: &Context,
    range: Range<u32>,
    levels: &[(u64, Vec<usize>)],
    change: Change,
    mut live: impl FnMut(Range<u32>, &[(usize, &[Arc<FloorOfWorld>])]) -> Result<(), Problems>,
) -> Result<(), Problems> {
    let levels_ratio: Vec<f64> = levels
        .iter()
        .map(|(bits, _)| f64::from_bits(*bits))
        .collect();
    let block = (MAX_HELD / levels.len().max(1)).clamp(1, BLOCK);
    for from in range.clone().step_by(block) {
        let worlds = from..range.end.min(from + block as u32);
        let floors = floors(context, &levels_ratio, worlds.clone(), change)?;
        let by_floor = levels.iter().zip(&floors);
        let on_floors: Vec<(usize, &[Arc<FloorOfWorld>])> = by_floor
            .flat_map(|((_, places), floors)| places.iter().map(move |&place| (place, &floors[..])))
            .collect();
        context.go_on()?;
        live(worlds, &on_floors)?;
    }
    Ok(())
}

/// Objects in some worlds, `[object][world]`.
fn lived_together(
    context: &Context,
    range: Range<u32>,
    standing: &[Standing],
    change: Change,
) -> Result<Vec<Vec<Lived>>, Problems> {
    let settings = &context.study.assessment;
    let in_world = |world: u32| -> Vec<Draw> {
        standing
            .iter()
            .map(|Standing { trial, .. }| {
                draw(settings, &trial.subject, trial.member.key, world, change)
            })
            .collect()
    };
    let draws: Vec<Vec<Draw>> = range.clone().into_par_iter().map(in_world).collect();
    let rigid: Vec<Result<Vec<Option<RigidResponse>>, Problems>> = draws
        .par_iter()
        .enumerate()
        .map(|(world, draws)| {
            context.go_on()?;
            Ok(rigid_in_world(context, standing, draws, world))
        })
        .collect();
    let rigid: Vec<Vec<Option<RigidResponse>>> = rigid.into_iter().collect::<Result<_, _>>()?;
    // [world][object]
    let slips: Vec<Vec<bool>> = rigid
        .par_iter()
        .zip(&draws)
        .enumerate()
        .map(|(world, (rigid, draws))| {
            let objects = standing.iter().zip(rigid).zip(draws);
            objects
                .map(|((Standing { trial, floors, .. }, rigid), draw)| {
                    slips(&trial.subject, draw, &floors[world], rigid.as_ref())
                })
                .collect()
        })
        .collect();
    let of_one = |Standing { trial, .. }: &Standing| match trial.subject.way {
        Way::Hull(..) => ALONE,
        _ => trial.subject.axes.len() as u64,
    };
    let effort: u64 = standing.iter().map(of_one).sum();
    context.add(effort * range.len() as u64);
    let told = standing.par_iter().filter(|one| one.is_told);
    told.flat_map(|one| one.floors).for_each(|floor| {
        floor.pfv_m_s();
    });
    let mut rigid: Vec<_> = rigid.into_iter().map(Vec::into_iter).collect();
    let of_object = |place: usize| {
        let Standing {
            floors, is_told, ..
        } = standing[place];
        let worlds = rigid.iter_mut().zip(&draws).zip(floors).zip(&slips);
        let one = worlds.map(|(((rigid, draws), floor), slips)| Lived {
            draw: draws[place],
            rigid: rigid
                .next()
                .unwrap_or_else(|| Some(Err(Lost::no_history()))),
            pads: None,
            slips: slips[place],
            pfa_m_s2: floor.pfa_m_s2,
            pfv_m_s: is_told.then(|| floor.pfv_m_s()),
        });
        one.collect()
    };
    let mut lived: Vec<Vec<Lived>> = (0..standing.len()).map(of_object).collect();
    // On pads the worlds that were lived through stay as they are.
    let is_known = |trial: &Trial| change.leaves_pads() && trial.worlds() >= range.end;
    let known = standing.iter().map(|one| one.trial).zip(&mut lived);
    for (trial, lived) in known.filter(|(trial, _)| is_known(trial)) {
        let before = &trial.lived[range.start as usize..range.end as usize];
        for (now, before) in lived.iter_mut().zip(before) {
            now.pads.clone_from(&before.pads);
        }
    }
    let is_asked = |place: usize, world: usize| {
        let (trial, lived) = (standing[place].trial, &lived[place][world]);
        // Where a group is drawn again, all that counts is whether any model has the event.
        let is_enough = change != Change::None && !lived.slips && has_event(trial, lived);
        trial.asks(context, Model::Pads) && !is_known(trial) && !is_enough
    };
    let on_pads = pads_in_worlds(context, standing, is_asked, &draws, range.start)?;
    for ((place, world), response) in on_pads {
        lived[place][world].pads = response;
    }
    for ((place, world), response) in slipped_in_worlds(context, standing, &slips, &draws)? {
        lived[place][world].pads = Some(response);
    }
    Ok(lived)
}

/// The histories with friction of the objects that slide while they rock, by the places of the object
/// and of the world.
fn slipped_in_worlds(
    context: &Context,
    standing: &[Standing],
    slips: &[Vec<bool>],
    draws: &[Vec<Draw>],
) -> Result<HashMap<(usize, usize), PadResponse>, Problems> {
    let mut jobs = Vec::new();
    for (world, (slips, draws)) in slips.iter().zip(draws).enumerate() {
        for (place, ((one, draw), slips)) in standing.iter().zip(draws).zip(slips).enumerate() {
            let Standing { trial, floors, .. } = one;
            if *slips && trial.asks(context, Model::Pads) {
                let subject = &trial.subject;
                jobs.push(((place, world), Drawn { subject, draw }, &*floors[world]));
            }
        }
    }
    let mut found = HashMap::new();
    // A run can be stopped in between: each takes a while.
    for jobs in jobs.chunks(SLIPPING_WORLDS) {
        context.go_on()?;
        context.count(jobs.iter().map(|(_, one, _)| one.subject.axes.len()).sum());
        let objects = jobs.iter().map(|&(_, one, floor)| {
            let friction_ratio = one.draw.friction_ratio;
            Ok((one.on_pads(friction_ratio)?, floor.shaking()))
        });
        let answered = jobs.iter().zip(responses(objects));
        found.extend(
            answered.map(|(&(key, one, floor), response)| (key, one.pad_response(floor, response))),
        );
    }
    Ok(found)
}

pub(super) fn floors(
    context: &Context,
    levels_ratio: &[f64],
    range: Range<u32>,
    change: Change,
) -> Result<Vec<Vec<Arc<FloorOfWorld>>>, Problems> {
    let repetition = |group: Group| u32::from(change == Change::Again(group));
    let again = Again {
        motion: repetition(Group::Motion),
        building: repetition(Group::Building),
    };
    let building = change
        .normal(Group::Building)
        .map(|normal| context.worlds.building_at(normal));
    let of_ground = GROUND * context.worlds.grounds_to_make(range.clone(), again.motion) as u64;
    let of_floors = FLOOR * (range.len() * levels_ratio.len()) as u64;
    let found = context
        .worlds
        .floors(range, levels_ratio, again, building, || context.go_on())?;
    context.add(of_ground + of_floors);
    Ok(found)
}

/// In one world, the index of its floors.
fn rigid_in_world(
    context: &Context,
    standing: &[Standing],
    draws: &[Draw],
    world: usize,
) -> Vec<Option<RigidResponse>> {
    let asked = |one: &Standing| one.trial.asks(context, Model::Rigid);
    let objects: Vec<(Drawn, &FloorOfWorld)> = standing
        .iter()
        .zip(draws)
        .filter(|(one, _)| asked(one))
        .map(|(Standing { trial, floors, .. }, draw)| {
            let subject = &trial.subject;
            (Drawn { subject, draw }, &*floors[world])
        })
        .collect();
    let rocking = objects.iter().filter(|(one, _)| one.subject.way.rocks());
    context.count(rocking.map(|(one, _)| one.subject.axes.len()).sum());
    let on_bases = objects
        .iter()
        .map(|(one, floor)| Ok((one.on_rigid_base()?, floor.shaking())));
    let mut found = objects
        .iter()
        .zip(responses(on_bases))
        .map(|((one, floor), response)| one.rigid_response(floor, response));
    standing
        .iter()
        .map(|one| asked(one).then(|| found.next()).flatten())
        .collect()
}

/// The number of a world, an object with its values there, and its floor.
type Job<'a> = (u32, Drawn<'a>, &'a FloorOfWorld);

/// Responses on pads by the places of the object and of the world.
type PadsByPlace = Vec<((usize, usize), Option<PadResponse>)>;

/// By the places of the objects and of the worlds that are asked, the responses on pads; `None` where the
/// contact law is curved and enough worlds were followed.
fn pads_in_worlds(
    context: &Context,
    standing: &[Standing],
    is_asked: impl Fn(usize, usize) -> bool,
    draws: &[Vec<Draw>],
    first: u32,
) -> Result<PadsByPlace, Problems> {
    // The worlds of one object stand side by side in the kernel: they resemble each other.
    let mut keys: Vec<(usize, usize)> = Vec::new();
    let mut jobs: Vec<Job> = Vec::new();
    for (place, Standing { trial, floors, .. }) in standing.iter().enumerate() {
        let subject = &trial.subject;
        let worlds = (first..).zip(draws).zip(*floors).enumerate();
        for (index, ((world, draws), floor)) in worlds {
            if is_asked(place, index) {
                let draw = &draws[place];
                keys.push((place, index));
                jobs.push((world, Drawn { subject, draw }, &**floor));
            }
        }
    }
    let objects: Vec<_> = jobs.par_iter().map(|job| job.1.on_pads(None)).collect();
    let (sprung, others): (Vec<_>, Vec<_>) = jobs
        .iter()
        .zip(objects)
        .enumerate()
        .partition(|(_, (_, object))| matches!(object, Ok(Object::Springs(_))));
    let mut found: Vec<Option<PadResponse>> = vec![None; jobs.len()];
    let (places, sprung): (Vec<usize>, Vec<_>) = sprung
        .into_iter()
        .map(|(place, (job, object))| (place, object.map(|object| (object, job.2.shaking()))))
        .unzip();
    let histories = |place: &usize| jobs[*place].1.subject.axes.len();
    let mut sprung = sprung.into_iter();
    for (chunk, places) in places.chunks(ON_PADS_AT_ONCE).enumerate() {
        // What can be finished within a second is not thrown away.
        if chunk > 0 {
            context.go_on()?;
        }
        let histories = places.iter().map(histories).sum();
        context.count(histories);
        let answered = responses(sprung.by_ref().take(places.len()));
        for (&place, response) in places.iter().zip(answered) {
            let (_, one, floor) = jobs[place];
            found[place] = Some(one.pad_response(floor, response));
        }
        context.add(ON_PADS * histories as u64);
    }
    let one_by_one = |(place, (job, object)): (usize, (&Job, _))| -> Result<_, Problems> {
        let &(world, one, floor) = job;
        if one.subject.way.is_slow() {
            context.count(1);
            context.add(ALONE);
            // Each takes long enough to stop between them.
            context.go_on()?;
        } else if world >= CURVED_WORLDS {
            return Ok((place, None));
        }
        let object = Result::map(object, |object| (object, floor.shaking()));
        let response = responses([object]).pop();
        Ok((
            place,
            response.map(|response| one.pad_response(floor, response)),
        ))
    };
    let others: Result<Vec<_>, _> = others.into_par_iter().map(one_by_one).collect();
    for (place, response) in others? {
        found[place] = response;
    }
    Ok(keys.into_iter().zip(found).collect())
}

impl Context<'_> {
    /// The smallest number of records that could show that an object stays; `None` where even the
    /// largest number of worlds has too few.
    pub(super) fn fewest_records(&self, accepted_ratio: f64) -> Option<u32> {
        self.looks()
            .fewest_records(accepted_ratio, self.least_correlation())
            .ok()?
    }

    /// The smallest number of independent worlds that could show that an object stays.
    pub(super) fn fewest_worlds(&self, accepted_ratio: f64) -> Option<u32> {
        self.looks().fewest_worlds(accepted_ratio).ok()
    }

    fn looks(&self) -> Looks {
        self.study.assessment.worlds.looks
    }

    /// The least correlation between worlds that use the same motion.
    fn least_correlation(&self) -> f64 {
        let Spread {
            restitution,
            stiffness,
            mass,
            geometry,
            model,
            compliant,
        } = self.study.assessment.spread;
        let spreads = [restitution, stiffness, mass, geometry, model, compliant];
        match (
            self.worlds.building_is_known(),
            spreads.iter().all(|spread| *spread == 0.0),
        ) {
            (true, true) => 1.0,
            (true, false) => SAME_SHAKING_CORRELATION,
            (false, _) => freestand::decision::LEAST_CORRELATION_RATIO,
        }
    }
}
