//! What an answer depends on, and what to measure first.

use freestand::decision::jansen_share;
use freestand::worlds::Group;
use rayon::prelude::*;

use crate::result::{Cause, Shares};
use freestand_input::problem::Problems;

use super::Context;
use super::draw::Change;
use super::response::Lived;
use super::trial::{Model, Question, Trial, answer, lived_in};

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
    for (trial, found) in trials.iter().zip(&mut found) {
        let worlds = trial.lived.len().min(MAX_WORLDS);
        let own: Vec<bool> = trial.lived[..worlds].iter().map(|lived| has_event(trial, lived)).collect();
        let hits = own.iter().filter(|hit| **hit).count();
        if hits == 0 {
            continue;
        }
        let mut by_group = Vec::new();
        for cause in Cause::ALL {
            let share = match is_varied(trial, cause) && hits >= 10 && worlds - hits >= 10 {
                true => {
                    let again = events(context, trial, worlds, Change::Again(cause.group()))?;
                    let pairs: Vec<(bool, bool)> = own.iter().copied().zip(again).collect();
                    jansen_share(&pairs).map(|share| share.total_ratio)
                }
                false => None,
            };
            by_group.push((cause, share));
        }
        let p = hits as f64 / worlds as f64;
        let accepted = trial.member.accepted_ratio;
        let is_near = p * NEAR_FACTOR > accepted && p < NEAR_FACTOR * accepted;
        let measure_first = if is_near { measure_first(context, trial, worlds)? } else { None };
        *found = Some(Shares { by_group, measure_first });
    }
    Ok(found)
}

/// The group whose probabilities at its 10 % and its 90 % point lie on both sides of the accepted
/// one, the widest first.
fn measure_first(context: &Context, trial: &Trial, worlds: usize) -> Result<Option<(Cause, f64, f64)>, Problems> {
    let accepted = trial.member.accepted_ratio;
    let mut widest: Option<(Cause, f64, f64)> = None;
    for cause in MEASURED.into_iter().filter(|cause| is_varied(trial, *cause)) {
        let mut at = [0.0; 2];
        for (p, normal) in at.iter_mut().zip([-NORMAL_90, NORMAL_90]) {
            let events = events(context, trial, worlds, Change::At(cause.group(), normal))?;
            *p = events.iter().filter(|hit| **hit).count() as f64 / worlds as f64;
        }
        let [low, high] = at;
        let crosses = (low > accepted) != (high > accepted);
        if crosses && widest.is_none_or(|(_, from, to)| (high - low).abs() > (to - from).abs()) {
            widest = Some((cause, low, high));
        }
    }
    Ok(widest)
}

/// Pads count where there are any.
fn is_varied(trial: &Trial, cause: Cause) -> bool {
    cause != Cause::Pad || trial.subject.body.is_some()
}

fn events(context: &Context, trial: &Trial, worlds: usize, change: Change) -> Result<Vec<bool>, Problems> {
    context.go_on()?;
    let range = 0..u32::try_from(worlds).unwrap_or(u32::MAX);
    let lived = lived_in(context, trial.subject.level_ratio, range, &[trial], change)?;
    Ok(lived.into_iter().flatten().collect::<Vec<_>>().par_iter().map(|lived| has_event(trial, lived)).collect())
}

/// Whether it falls or exceeds its tolerance by any model, as far as that is asked.
fn has_event(trial: &Trial, lived: &Lived) -> bool {
    let question = if trial.is_open(Question::Shock) { Question::Shock } else { Question::Falls };
    let models = [Model::Rigid, Model::Pads].into_iter();
    models.filter_map(|model| answer(&trial.subject, lived, question, model)?).any(|yes| yes)
}
