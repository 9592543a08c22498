//! An object that rolls or slides farther than it has room, locked: locking turns rolling into
//! rocking, so the locked object lives through the same worlds before anybody is told to lock it.

use freestand::decision::Side;

use crate::result::{Braked, Decision, Rolled, ShockAnswer};
use freestand_input::problem::Problems;
use freestand_input::words::{counted, number};

use super::Context;
use super::answers::answers;
use super::decision::{deciding, percent};
use super::object::Way;
use super::trial::{Question, Trial, live};

/// Of each trial; `None`: it rocks, it has room enough, or it falls all the same.
pub(super) fn braked(context: &Context, trials: &[Trial]) -> Result<Vec<Option<Braked>>, Problems> {
    let mut found: Vec<Option<Braked>> = trials.iter().map(|_| None).collect();
    let is_wanted = |trial: &Trial| {
        !trial.member.item.is_round
            && !has_room(context, trial)
            && trial.side(context, Question::Falls) == Side::Below
    };
    let places: Vec<usize> = trials
        .iter()
        .enumerate()
        .filter(|(_, trial)| is_wanted(trial))
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

/// Whether an object goes farther than it has room too rarely to matter; one that rocks needs none.
fn has_room(context: &Context, trial: &Trial) -> bool {
    let way = &trial.subject.way;
    way.glides().is_none() || way.room_m().is_some() && trial.room_side(context) == Side::Below
}

/// The verdict of an object that would be left as it is but for its travel, and why.
pub(super) fn decide(
    way: &Way,
    rolled: &Rolled,
    braked: &Braked,
    accepted_ratio: f64,
) -> (Decision, String) {
    let locked = match way {
        Way::Slides(_) => "Held in its place",
        _ => "Locked",
    };
    let needed_mm = number((1e3 * rolled.clearance_needed_m).ceil(), 6);
    let has = match (way, rolled.clearance_m) {
        (_, Some(clearance_m)) => format!("Its clearance is {} mm", number(1e3 * clearance_m, 6)),
        (Way::Slides(_), None) => {
            let room_mm = way
                .room_m()
                .map_or_else(String::new, |room_m| number(1e3 * room_m, 3));
            format!("It slides farther than {room_mm} mm, the list gives no clearance")
        }
        (_, None) => "The list gives no clearance".to_owned(),
    };
    let room = format!("{has}, and it needs at least {needed_mm} mm on every side");
    let worlds = counted(braked.worlds as usize, "world");
    if braked.stands {
        let high = percent(braked.overturn.high);
        return (
            Decision::Lock,
            format!("{room}. {locked}, at most {high} fall ({worlds})."),
        );
    }
    let p = braked.overturn;
    let fate = if p.high < accepted_ratio {
        "its landings are too hard for it".to_owned()
    } else {
        let [value, low, high] = [p.value, p.low, p.high].map(percent);
        format!(
            "it falls in {value} ({} to {high}) of {worlds}",
            low.trim_end_matches(" %")
        )
    };
    (
        Decision::Restrain,
        format!(
            "{room}. Locking it is no remedy: {}, {fate}.",
            locked.to_lowercase()
        ),
    )
}
