//! Objects on floors whose motions are in memory: first all histories in batches, then each object
//! by itself.

use std::collections::HashMap;

use freestand::block::Block;
use freestand::rocking::{Outcome as RockingOutcome, Restitution, RockingSummary};
use rayon::prelude::*;

use crate::floors::{Floor, Floors};

use crate::inventory::Item;
use crate::result::{AcceptedFor, Assessment};
use freestand_input::problem::{Problem, Problems};
use freestand_study::study::assessment::Settings;

use super::Context;
use super::assessment::{Found, assessment};
use super::object::{Body, Subject};
use super::response::{MotionResponse, Values, axis_motion, lifts, rock_directions};
use super::screen::Screened;
use super::uncertainty::{self, Draw, Draws, Outcome, enough, key, shares};

/// An object of a group.
pub(crate) struct Member<'a> {
    pub(crate) item: &'a Item,
    pub(crate) subject: Subject,
    pub(crate) accepted_ratio: f64,
    pub(crate) accepted_for: AcceptedFor,
}

/// One value changed, for the tornado.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Variant {
    AsIs,
    RestitutionLow,
    RestitutionHigh,
    Slender,
    Squat,
}

impl Variant {
    pub(super) const CHANGED: [Self; 4] = [Self::RestitutionLow, Self::RestitutionHigh, Self::Slender, Self::Squat];

    fn blocks(self, subject: &Subject, settings: &Settings) -> Vec<(Block, Restitution)> {
        let spread = &settings.spread;
        let (restitution, sides) = match self {
            Self::AsIs => (None, 1.0),
            Self::RestitutionLow => (Some((-spread.restitution).exp()), 1.0),
            Self::RestitutionHigh => (Some(spread.restitution.exp()), 1.0),
            Self::Slender => (None, (-spread.geometry).exp()),
            Self::Squat => (None, spread.geometry.exp()),
        };
        let changed = |block: &Block| match restitution {
            None => subject.restitution,
            Some(factor) => {
                let ratio = subject.restitution.ratios(block).map_or(0.0, |ratios| ratios[0].max(ratios[1]));
                Restitution::Value(factor.min(uncertainty::max_restitution_factor(subject, block)) * ratio)
            }
        };
        subject.axes.iter().map(|axis| (axis.scaled(1.0, sides), changed(&axis.block))).collect()
    }
}

/// Assesses the members, whose floors are all in `floors`; a result does not depend on the other
/// members.
pub(crate) fn assess_group(
    context: &Context,
    floors: &Floors,
    members: &[Member],
) -> Result<Vec<Assessment>, Problems> {
    let settings = &context.study.assessment;
    let mut screened = screen_all(context, floors, members)?;
    let all: Vec<usize> = (0..members.len()).filter(|i| !screened.contains_key(i)).collect();
    let mut as_is = responses(context, floors, members, &all, Variant::AsIs)?;
    let rocking: Vec<usize> =
        all.iter().copied().filter(|&i| as_is[&i].iter().flatten().any(|axes| lifts(axes))).collect();
    let mut changed = Vec::new();
    for variant in Variant::CHANGED {
        changed.push((variant, responses(context, floors, members, &rocking, variant)?));
    }
    let uncertain: Vec<usize> =
        all.iter().copied().filter(|&i| may_lift(&members[i].subject, floors, settings)).collect();
    let mut draws = draw_all(context, floors, members, &uncertain)?;
    let mut found = Vec::with_capacity(members.len());
    for (i, member) in members.iter().enumerate() {
        let (as_is, draws, is_screened) = match screened.remove(&i) {
            Some(Screened { as_is, draws }) => (as_is, Some(draws), true),
            None => (as_is.remove(&i).unwrap_or_default(), draws.remove(&i), false),
        };
        let changed = changed.iter().filter_map(|(variant, of)| Some((*variant, of.get(&i)?.as_slice()))).collect();
        let floor = &floors[&member.subject.level_ratio.to_bits()];
        found.push(Found { member, floor, as_is, changed, draws, is_screened });
    }
    let done: Vec<Result<Assessment, Problems>> = found
        .par_iter()
        .map(|found| {
            context.go_on()?;
            Ok(assessment(context, found))
        })
        .collect();
    done.into_iter().collect()
}

/// The objects that the spectra of their floor decide, where the study asks for that.
fn screen_all(context: &Context, floors: &Floors, members: &[Member]) -> Result<HashMap<usize, Screened>, Problems> {
    if !context.study.assessment.screen {
        return Ok(HashMap::new());
    }
    // Floor by floor: the spectra of a floor are made once, on all threads.
    let all: Vec<usize> = (0..members.len()).collect();
    let mut screened = HashMap::new();
    for (floor, on_floor) in by_floor(floors, members, &all) {
        context.go_on()?;
        let found = on_floor.iter().filter_map(|&i| Some((i, context.spectra.screen(&members[i], floor)?)));
        screened.extend(found);
    }
    Ok(screened)
}

/// Whether uplift is possible in any draw: with a base five standard deviations narrower and a
/// centre of gravity as many higher than in the inventory.
fn may_lift(subject: &Subject, floors: &Floors, settings: &Settings) -> bool {
    let margin = (5.0 * settings.spread.geometry).exp();
    let Some(floor) = floors.get(&subject.level_ratio.to_bits()) else { return false };
    let pfa_m_s2 = floor.pfa_m_s2.iter().copied().fold(0.0, f64::max);
    subject.axes.iter().any(|axis| {
        let threshold =
            freestand::rocking::RockingModel::Rigid.uplift_threshold_ratio(&axis.scaled(margin, 1.0 / margin));
        pfa_m_s2 > threshold * freestand::G0_M_S2
    })
}

/// `[member] → [motion]`, for some of the members.
type Responses = HashMap<usize, Vec<MotionResponse>>;

fn responses(
    context: &Context,
    floors: &Floors,
    members: &[Member],
    which: &[usize],
    variant: Variant,
) -> Result<Responses, Problems> {
    let settings = &context.study.assessment;
    let mut of: Responses = which.iter().map(|&i| (i, Vec::new())).collect();
    for (floor, on_floor) in by_floor(floors, members, which) {
        let blocks: Vec<Vec<(Block, Restitution)>> =
            on_floor.iter().map(|&i| variant.blocks(&members[i].subject, settings)).collect();
        let flat: Vec<(Block, Restitution)> = blocks.iter().flatten().copied().collect();
        let by_motion: Vec<Result<Vec<MotionResponse>, Problems>> = floor
            .motions
            .par_iter()
            .zip(&floor.pfa_m_s2)
            .map(|(directions, &pfa_m_s2)| {
                context.go_on()?;
                let mut rocked = rock_directions(&flat, directions).into_iter();
                context.count(flat.len());
                Ok(on_floor
                    .iter()
                    .zip(&blocks)
                    .map(|(&i, blocks)| {
                        let subject = &members[i].subject;
                        let own: Vec<_> = rocked.by_ref().take(blocks.len()).collect();
                        let values = subject.body.as_ref().map(as_stated);
                        let axes = blocks.iter().zip(own);
                        axes.map(|((block, _), one)| axis_motion(subject, block, one?, values, pfa_m_s2)).collect()
                    })
                    .collect())
            })
            .collect();
        for motion in by_motion {
            for (i, response) in on_floor.iter().zip(motion?) {
                of.entry(*i).or_default().push(response);
            }
        }
    }
    Ok(of)
}

pub(super) fn as_stated(body: &Body) -> Values<'_> {
    Values { mass_kg: body.mass_kg, cushion: &body.cushion }
}

/// The members on each floor, in the order of the floors' levels.
fn by_floor<'a>(floors: &'a Floors, members: &[Member], which: &[usize]) -> Vec<(&'a Floor, Vec<usize>)> {
    let mut levels: Vec<(u64, Vec<usize>)> = Vec::new();
    for &i in which {
        let bits = members[i].subject.level_ratio.to_bits();
        match levels.iter_mut().find(|(level, _)| *level == bits) {
            Some((_, on_floor)) => on_floor.push(i),
            None => levels.push((bits, vec![i])),
        }
    }
    levels.into_iter().filter_map(|(bits, on_floor)| Some((floors.get(&bits)?.as_ref(), on_floor))).collect()
}

/// Draws until there are enough, for each object by itself.
fn draw_all(
    context: &Context,
    floors: &Floors,
    members: &[Member],
    which: &[usize],
) -> Result<HashMap<usize, Draws>, Problems> {
    let settings = &context.study.assessment;
    let mut of: HashMap<usize, Draws> = which.iter().map(|&i| (i, vec![Vec::new(); context.names.len()])).collect();
    let (mut from, mut to) = (0, settings.draws);
    let mut open = which.to_vec();
    while !open.is_empty() && from < to {
        for (floor, on_floor) in by_floor(floors, members, &open) {
            for (i, more) in draws_on(context, floor, members, &on_floor, from..to)? {
                if let Some(draws) = of.get_mut(&i) {
                    draws.iter_mut().zip(more).for_each(|(motion, more)| motion.extend(more));
                }
            }
        }
        open.retain(|i| {
            let is_enough = |by_motion: Vec<f64>| enough(&by_motion, to, members[*i].accepted_ratio);
            let Some(draws) = of.get(i) else { return false };
            !(is_enough(shares(draws, |one| one.overturned)) && is_enough(shares(draws, |one| one.exceeds())))
        });
        (from, to) = (to, (2 * to).min(settings.most_draws));
    }
    Ok(of)
}

/// Draws number `range` of the members on one floor: `[motion][draw]` of each.
fn draws_on(
    context: &Context,
    floor: &Floor,
    members: &[Member],
    on_floor: &[usize],
    range: std::ops::Range<u32>,
) -> Result<HashMap<usize, Draws>, Problems> {
    let settings = &context.study.assessment;
    let by_motion: Vec<Result<Vec<Vec<Outcome>>, Problems>> = floor
        .motions
        .par_iter()
        .enumerate()
        .map(|(motion, directions)| {
            context.go_on()?;
            let record = context.keys[motion];
            let drawn = |&i: &usize| {
                let (subject, object) = (&members[i].subject, key(&members[i].item.id));
                range.clone().map(move |index| (subject, uncertainty::draw(settings, subject, object, record, index)))
            };
            let drawn: Vec<(&Subject, Draw)> = on_floor.iter().flat_map(drawn).collect();
            let blocks = |(subject, draw): &(&Subject, Draw)| -> Vec<(Block, Restitution)> {
                (0..subject.axes.len()).filter_map(|axis| draw.block(subject, axis)).collect()
            };
            let blocks: Vec<(Block, Restitution)> = drawn.iter().flat_map(blocks).collect();
            let rocked = rock_directions(&blocks, directions);
            context.count(blocks.len());
            let mut rocked = blocks.iter().map(|(block, _)| block).zip(rocked);
            let outcomes = drawn.iter().map(|(subject, draw)| {
                let own: Vec<_> = rocked.by_ref().take(subject.axes.len()).collect();
                outcome(subject, draw, own, floor.pfa_m_s2[motion])
            });
            let outcomes: Vec<Option<Outcome>> = outcomes.collect();
            Ok(outcomes.chunks(range.len()).map(|own| own.iter().flatten().copied().collect()).collect())
        })
        .collect();
    let mut of: HashMap<usize, Draws> = on_floor.iter().map(|&i| (i, Vec::new())).collect();
    for motion in by_motion {
        for (i, outcomes) in on_floor.iter().zip(motion?) {
            of.entry(*i).or_default().push(outcomes);
        }
    }
    Ok(of)
}

/// `None` where a history failed.
fn outcome(
    subject: &Subject,
    draw: &Draw,
    rocked: Vec<(&Block, Result<RockingSummary, String>)>,
    floor_m_s2: f64,
) -> Option<Outcome> {
    let body = subject.body.as_ref().and_then(|body| {
        let cushion = body.cushion.times(draw.stiffness).ok()?;
        Some((body.mass_kg * draw.mass, cushion))
    });
    let values = body.as_ref().map(|(mass_kg, cushion)| Values { mass_kg: *mass_kg, cushion });
    let mut outcome = Outcome { overturned: false, terms: [None; 2], model: draw.model };
    for ((block, rocking), place) in rocked.into_iter().zip(&mut outcome.terms) {
        let one = axis_motion(subject, block, rocking.ok()?, values, floor_m_s2).ok()?;
        outcome.overturned |= one.rocking.outcome == RockingOutcome::Overturned;
        *place = one.terms;
    }
    Some(outcome)
}

impl Context<'_> {
    /// An error where the run is to stop.
    pub(crate) fn go_on(&self) -> Result<(), Problems> {
        if (self.wants_to_stop)() { Err(Problem::stopped().into()) } else { Ok(()) }
    }
}
