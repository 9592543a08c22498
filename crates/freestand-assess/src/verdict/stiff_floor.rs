//! Objects that touch a wall, once more in three dimensions on a stiff floor: a rigid base that rocks in one plane falls
//! too seldom there.

use freestand::decision::Side;
use freestand_input::problem::Problems;

use crate::result::TooMild;

use super::Context;
use super::trial::{Question, Trial, live};

/// It stays by its planar calculation, and touches a wall.
pub(super) fn is_wanted(context: &Context, trial: &Trial) -> bool {
    stays(context, trial) && trial.subject.on_stiff_floor(trial.member.item).is_some()
}

fn stays(context: &Context, trial: &Trial) -> bool {
    trial.side(context, Question::Falls) == Side::Below
}

/// Marks the objects that would stay by their planar calculation, but not for certain on a stiff floor.
pub(super) fn check(context: &Context, trials: &mut [Trial]) -> Result<(), Problems> {
    let again = |(place, trial): (usize, &Trial)| {
        if !stays(context, trial) {
            return None;
        }
        Some((place, trial.subject.on_stiff_floor(trial.member.item)?))
    };
    let (places, mut tried): (Vec<usize>, Vec<Trial>) = trials
        .iter()
        .enumerate()
        .filter_map(again)
        .map(|(place, subject)| {
            let member = trials[place].member;
            (place, Trial::new(context, member, subject))
        })
        .unzip();
    live(context, &mut tried)?;
    for (place, tried) in places.into_iter().zip(tried) {
        if !stays(context, &tried) {
            trials[place].subject.too_mild = Some(TooMild::TouchesWall);
        }
    }
    Ok(())
}
