//! What the worlds of a part say so far, and what its objects still need, for those who watch.

use freestand::decision::{Count, Side};

use crate::result::Probability;

use super::Context;
use super::answers::answers;
use super::decision::deciding;
use super::object::{Model, Way};
use super::shares;
use super::softer;
use super::trial::{Question, Trial};
use super::watch::{ALONE, Estimate, FLOOR, GROUND, ON_PADS};

/// Softer pads that are usually tried.
const TRIED_PADS: f64 = 4.0;

/// Tells what is known of objects, and what they still need.
pub(super) fn tell(context: &Context, trials: &[Trial]) {
    let Some(watch) = context.watch else { return };
    let settled = trials.iter().map(|trial| settled_questions(context, trial));
    let expected: Vec<u32> = trials
        .iter()
        .map(|trial| expected_worlds(context, trial))
        .collect();
    let needed = trials.iter().zip(&expected);
    let of_objects: f64 = needed
        .map(|(trial, &worlds)| in_world(context, trial) * histories_ahead(context, trial, worlds))
        .sum();
    let now = trials.iter().map(Trial::worlds).max().unwrap_or(0);
    let most = expected.iter().copied().max().unwrap_or(0);
    let mut levels: Vec<u64> = trials
        .iter()
        .map(|trial| trial.subject.level_ratio.to_bits())
        .collect();
    levels.sort_unstable();
    levels.dedup();
    let of_floors = u64::from(most.saturating_sub(now)) * (GROUND + FLOOR * levels.len() as u64);
    let estimates: Vec<Estimate> = trials
        .iter()
        .map(|trial| estimate(context, trial))
        .collect();
    watch.looked(settled.sum(), of_objects as u64 + of_floors, &estimates);
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

/// How often it is still followed, if it needs so many worlds: in the worlds that it lacks, on softer pads,
/// and for what its answers depend on.
fn histories_ahead(context: &Context, trial: &Trial, worlds: u32) -> f64 {
    let lacking = f64::from(worlds - trial.worlds());
    let on_softer = match softer::is_wanted(context, trial) {
        true => TRIED_PADS * f64::from(worlds),
        false => 0.0,
    };
    let again = match context.wants_shares && !trial.subject.way.is_slow() {
        true => {
            let question = open_questions(trial).last().unwrap_or(Question::Falls);
            let shares = trial
                .models(context)
                .map(|model| share(trial, question, model));
            let p = shares.fold(0.0, f64::max);
            shares::changes(p, trial.member.accepted_ratio, worlds as usize) as f64
        }
        false => 0.0,
    };
    lacking + on_softer + again
}
