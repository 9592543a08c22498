//! An object that rolls or slides farther than it has room, locked: locking turns rolling into
//! rocking, so the locked object lives through the same worlds before anybody is told to lock it.

use freestand::decision::Side;

use crate::result::{Braked, Decision, ShockAnswer};
use freestand_input::problem::Problems;
use freestand_inventory::ItemShape;

use super::Context;
use super::answers::answers;
use super::decision::deciding;
use super::trial::{Question, Trial, live};

/// Of each trial; `None`: it rocks, it has room enough, or it falls all the same.
pub(super) fn braked(context: &Context, trials: &[Trial]) -> Result<Vec<Option<Braked>>, Problems> {
    let mut found: Vec<Option<Braked>> = trials.iter().map(|_| None).collect();
    let places: Vec<usize> = trials
        .iter()
        .enumerate()
        .filter(|(_, trial)| is_wanted(context, trial))
        .map(|(place, _)| place)
        .collect();
    let locked = |place: &usize| {
        let trial = &trials[*place];
        let subject = trial
            .subject
            .locked(&trial.member.item.surroundings, &context.study.assessment);
        Trial::new(context, trial.member, subject)
    };
    let mut locked: Vec<Trial> = places.iter().map(locked).collect();
    live(context, &mut locked)?;
    for (place, locked) in places.into_iter().zip(locked) {
        let answers = answers(context, &locked);
        let is_hit = answers.asks_shock
            && matches!(answers.shock, ShockAnswer::Exceeded | ShockAnswer::Close);
        let stands = locked.side(context, Question::Falls) == Side::Below && !is_hit;
        found[place] = deciding(&answers, |model| Some(model.overturn)).map(|overturn| Braked {
            overturn,
            worlds: answers.worlds,
            stands,
        });
    }
    Ok(found)
}

/// It stays and has too little room.
pub(super) fn is_wanted(context: &Context, trial: &Trial) -> bool {
    trial.member.item.shape == ItemShape::Block
        && !has_room(context, trial)
        && trial.side(context, Question::Falls) == Side::Below
}

/// Whether an object goes farther than it has room too rarely to matter; one that rocks needs none.
fn has_room(context: &Context, trial: &Trial) -> bool {
    let way = &trial.subject.way;
    way.glides().is_none() || way.room_m().is_some() && trial.room_side(context) == Side::Below
}

/// The verdict of an object that would be left as it is but for its travel.
pub(super) fn decide(braked: &Braked) -> Decision {
    if braked.stands {
        Decision::Lock
    } else {
        Decision::Restrain
    }
}
