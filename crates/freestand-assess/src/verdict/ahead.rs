//! What the worlds of a part say so far, and what its objects still need, for those who watch.

use std::collections::BTreeMap;

use freestand::decision::{Count, Side};
use rayon::prelude::*;

use crate::result::Probability;

use super::Context;
use super::answers::answers;
use super::decision::deciding;
use super::object::{Model, Way};
use super::shares;
use super::softer;
use super::trial::{Question, Trial};
use super::watch::{ALONE, Estimate, FLOOR, GROUND, ON_PADS};

/// Softer pads that are usually tried, in as many worlds as the object.
const TRIED_PADS: f64 = 2.5;

/// How often floors are calculated for what answers depend on: as they are, with another motion, with another building,
/// and with both ends of its period.
const FLOORS_AGAIN: f64 = 5.0;

/// Tells what is known of objects, and what they still need.
pub(super) fn tell(context: &Context, trials: &[Trial]) {
    let Some(watch) = context.watch else { return };
    // On all threads: each object takes a dozen intervals.
    let ahead: Vec<Ahead> = trials
        .par_iter()
        .map(|trial| Ahead::of(context, trial))
        .collect();
    let of_objects: f64 = ahead.iter().map(|one| one.effort).sum();
    // All share the motions of the ground, and those on one floor its motions.
    let most = |of: fn(&Lives) -> f64| ahead.iter().map(|one| of(&one.lives)).fold(0.0, f64::max);
    let last = ahead.iter().map(|one| one.worlds).max().unwrap_or(0);
    let grounds = context.worlds.grounds_to_make(0..last, 0)
        + context
            .worlds
            .grounds_to_make(0..most(|lives| lives.again) as u32, 1);
    let mut on_floors: BTreeMap<u64, f64> = BTreeMap::new();
    for (trial, one) in trials.iter().zip(&ahead) {
        let level = trial.subject.level_ratio.to_bits();
        let most = on_floors.entry(level).or_default();
        *most = most.max(one.lives.on_its_floor());
    }
    let of_floors =
        on_floors.values().sum::<f64>() * FLOOR as f64 + (grounds as u64 * GROUND) as f64;
    let settled = ahead.iter().map(|one| one.settled).sum();
    let estimates: Vec<Estimate> = ahead.into_iter().map(|one| one.estimate).collect();
    watch.looked(settled, (of_objects + of_floors) as u64, &estimates);
}

/// What is known of an object, and what it still needs.
struct Ahead<'a> {
    /// Questions that are settled.
    settled: usize,
    /// Worlds after which it is settled.
    worlds: u32,
    lives: Lives,
    /// What it still needs, in histories in one plane on a rigid base.
    effort: f64,
    estimate: Estimate<'a>,
}

impl<'a> Ahead<'a> {
    fn of(context: &Context, trial: &Trial<'a>) -> Self {
        let worlds = expected_worlds(context, trial);
        let lives = Lives::ahead(context, trial, worlds);
        Self {
            settled: settled_questions(context, trial),
            worlds,
            effort: lives.effort(context, trial),
            lives,
            estimate: estimate(context, trial),
        }
    }
}

fn estimate<'a>(context: &Context, trial: &Trial<'a>) -> Estimate<'a> {
    let answers = answers(context, trial);
    let nothing = Probability {
        value: 0.0,
        low: 0.0,
        high: 1.0,
    };
    Estimate {
        item: trial.member.item,
        worlds: trial.worlds(),
        overturn: deciding(&answers, |model| Some(model.overturn)).unwrap_or(nothing),
        exceed: deciding(&answers, |model| model.exceed).filter(|_| trial.is_open(Question::Shock)),
        is_settled: trial.is_settled(),
    }
}

fn open_questions(trial: &Trial) -> impl Iterator<Item = Question> {
    let both = [Question::Falls, Question::Shock].into_iter();
    both.filter(|question| trial.is_open(*question))
}

/// Questions that its worlds have settled; all of them where no more are lived.
fn settled_questions(context: &Context, trial: &Trial) -> usize {
    let settled =
        |question: &Question| trial.is_settled() || trial.side(context, *question).is_settled();
    open_questions(trial).filter(settled).count()
}

/// The share of its worlds with a yes.
fn share(trial: &Trial, question: Question, model: Model) -> f64 {
    let yes = |lived: &&_| trial.answer(lived, question, model) == Some(Some(true));
    trial.lived.iter().filter(yes).count() as f64 / trial.lived.len().max(1) as f64
}

/// The worlds after which it is settled if its shares stay what they are.
fn expected_worlds(context: &Context, trial: &Trial) -> u32 {
    if trial.is_settled() {
        return trial.worlds();
    }
    let of_models = |question| {
        let models = trial.models(context);
        models.map(|model| share(trial, question, model)).collect()
    };
    let shares: Vec<Vec<f64>> = open_questions(trial).map(of_models).collect();
    let confidence = context.study.assessment.worlds.looks.confidence();
    let suffices = |worlds: &u32| {
        let side = |share: &f64| {
            let count = Count {
                worlds: *worlds,
                hits: (share * f64::from(*worlds)).round() as u32,
                unknown: 0,
            };
            count.interval(confidence).side(trial.member.accepted_ratio)
        };
        let sides = shares
            .iter()
            .map(|of_models| Side::of_models(&of_models.iter().map(side).collect::<Vec<_>>()));
        let sides: Vec<Side> = sides.collect();
        sides.first() == Some(&Side::Above) || sides.into_iter().all(Side::is_settled)
    };
    trial
        .looks_ahead()
        .find(suffices)
        .unwrap_or_else(|| trial.cap())
}

/// The effort of the object in one world.
fn in_world(context: &Context, trial: &Trial) -> f64 {
    let planes = trial.subject.axes.len() as u64;
    let effort = match trial.subject.way {
        Way::Hull(..) | Way::Spatial(_) | Way::Stack(_) => ALONE,
        _ if trial.asks(context, Model::Pads) => planes * (1 + ON_PADS),
        _ => planes,
    };
    effort as f64
}

/// How often an object is still followed, in worlds.
struct Lives {
    /// In the worlds that it lacks.
    lacking: f64,
    /// On softer pads.
    on_softer: f64,
    /// Before a wall, on a rigid base.
    before_walls: f64,
    /// For what its answers depend on: so many changes, and in how many worlds.
    changes: f64,
    again: f64,
}

impl Lives {
    /// If it needs so many worlds.
    fn ahead(context: &Context, trial: &Trial, worlds: u32) -> Self {
        let falls = trial.side(context, Question::Falls) == Side::Above;
        let question = open_questions(trial).last().unwrap_or(Question::Falls);
        let shares = trial
            .models(context)
            .map(|model| share(trial, question, model));
        let p = shares.fold(0.0, f64::max);
        let (changes, again) = match context.wants_shares && !trial.subject.way.is_slow() {
            true => shares::changes(p, trial.member.accepted_ratio, worlds as usize),
            false => (0, 0),
        };
        let worlds_if = |wanted: bool, times: f64| {
            if wanted {
                times * f64::from(worlds)
            } else {
                0.0
            }
        };
        Self {
            lacking: f64::from(worlds - trial.worlds()),
            on_softer: worlds_if(softer::is_wanted(context, trial), TRIED_PADS),
            before_walls: worlds_if(falls && trial.asks(context, Model::Rigid), 1.0),
            changes: changes as f64,
            again: if changes > 0 { again as f64 } else { 0.0 },
        }
    }

    /// Worlds in which the motions of its floor are calculated.
    fn on_its_floor(&self) -> f64 {
        self.lacking + self.on_softer + self.before_walls + FLOORS_AGAIN * self.again
    }

    fn effort(&self, context: &Context, trial: &Trial) -> f64 {
        let planes = trial.subject.axes.len() as f64;
        let followed = self.lacking + self.on_softer + self.changes * self.again;
        in_world(context, trial) * followed + 2.0 * planes * self.before_walls
    }
}
