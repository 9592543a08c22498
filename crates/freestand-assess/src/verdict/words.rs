//! What an assessment says of an object besides its decision.

use crate::result::{
    AtWall, InSpace, ModelAnswers, Ranked, Rolled, Slipped, Stacked, TooMild, Unstated,
};
use freestand_input::problem::Problems;
use freestand_input::quantity::UnitSystem;
use freestand_input::words::listed;
use freestand_input::words::{counted, number};
use freestand_inventory::{Casters, Surroundings};

use super::Context;
use super::decision::percent;
use super::object::Way;
use super::response::{Lived, Lost};
use super::slip::FALLS_WITH_FRICTION;
use super::trial::Trial;

/// How far it tilts and walks.
pub(super) fn space_words(in_space: &InSpace) -> String {
    match (in_space.tilt_rad_p84, in_space.walk_m_p84) {
        (Ranked::Value(tilt_rad), Ranked::Value(walk_m)) => format!(
            " In three dimensions it tilts up to {}° and its base walks up to {} mm in 84 % of the worlds.",
            number(tilt_rad.to_degrees(), 2),
            number((1e3 * walk_m).ceil(), 6)
        ),
        _ => " In three dimensions it falls in more than 16 % of the worlds.".to_owned(),
    }
}

/// Which body of a stack falls, and which begins to rock.
pub(super) fn stack_words(trial: &Trial, stacked: &Stacked) -> String {
    let falls = format!(
        " The object itself falls first in {} of {}, what stands on it in {}.",
        stacked.lower_falls,
        counted(stacked.worlds as usize, "world"),
        stacked.upper_falls
    );
    let [alone, together] =
        [stacked.threshold_upper_g, stacked.threshold_together_g].map(|g| number(g, 3));
    let begins = if stacked.threshold_upper_g < stacked.threshold_together_g {
        format!(
            " What stands on it begins to rock alone at {alone} g, both together at {together} g."
        )
    } else {
        format!(
            " Both begin to rock together at {together} g, what stands on it alone at {alone} g."
        )
    };
    falls + &begins + &left_out_words(&trial.member.item.surroundings)
}

/// What is around a stack and does not count.
fn left_out_words(around: &Surroundings) -> String {
    let left_out = [
        (around.wall_gap_m.is_some(), "wall"),
        (around.neighbour_gap_m.is_some(), "neighbours"),
        (around.casters == Some(Casters::Free), "casters"),
    ];
    let named: Vec<&str> = left_out
        .into_iter()
        .filter_map(|(is_there, name)| is_there.then_some(name))
        .collect();
    match named[..] {
        [] => String::new(),
        ["wall"] => " Its wall does not count.".to_owned(),
        _ => format!(" Its {} do not count.", listed(&named)),
    }
}

/// What is left out of three dimensions and of stacks.
pub(super) fn space_notes(context: &Context, trial: &Trial) -> Result<Vec<String>, Problems> {
    let mut notes = Vec::new();
    match &trial.subject.way {
        Way::Spatial(beside) => {
            notes.push(
                "In three dimensions a single history is one realisation: its shares and fractiles can be trusted."
                    .to_owned(),
            );
            if context.worlds.floor(0, trial.subject.level_ratio)?.motion.across.is_none() {
                notes.push("Its floor moves in one direction only: the motions have one component.".to_owned());
            }
            if trial.subject.too_mild == Some(TooMild::FeetPassWall) {
                notes.push(
                    "Its top and its face meet its wall, and its feet pass through it: it may fall more often."
                        .to_owned(),
                );
            }
            if beside.is_some() && trial.subject.capacity.is_some() {
                notes.push("The shock at its wall is not compared with its tolerance.".to_owned());
            }
        }
        Way::Stack(_) => notes.push(
            "The object and what stands on it move in the plane of the thickness, with the same pads and the same \
             friction under both. The shock is that of the object itself, and forces for a restraint leave out what \
             stands on it."
                .to_owned(),
        ),
        Way::Planar | Way::Walled(_) | Way::Rolls(_) | Way::Slides(_) => {}
    }
    Ok(notes)
}

/// Why an object is not left as it is in shaking that nobody stated.
pub(super) fn unstated_words(unstated: Unstated) -> String {
    format!(
        " But nobody stated {}: this is the answer for another one, and no verdict. Give {}.",
        unstated.words(),
        unstated.keys()
    )
}

/// How far it rolls or slides, and what a stop does.
pub(super) fn roll_words(verb: &str, rolled: &Rolled, has_wall: bool) -> String {
    let travel = format!(
        "It {verb}: up to {} in 84 % of worlds, farther in the rest",
        rolled.reach_words(UnitSystem::Si)
    );
    let Some(clearance_m) = rolled.clearance_m else {
        if has_wall {
            return format!(
                "{travel}; it may run into what stands beside it, which is not calculated."
            );
        }
        return format!(
            "{travel}; nothing in the list stops it, and nothing overturns it without a stop."
        );
    };
    let trip = number(rolled.trip_speed_m_s, 3);
    let speed = rolled
        .stop_speed_m_s_p84
        .map_or_else(String::new, |speed_m_s| {
            format!(" (up to {} m/s there in 84 %)", number(speed_m_s, 3))
        });
    format!(
        "{travel}. It reaches its clearance of {} mm in {} of them{speed}; a stop there overturns it from {trip} m/s.",
        number(1e3 * clearance_m, 6),
        percent(rolled.stop_share)
    )
}

/// Why the friction does not suffice.
fn too_little_friction(trial: &Trial, slipped: &Slipped) -> String {
    let (low, high) = trial.subject.friction_ratio.unwrap_or_default();
    let range = if low == high {
        number(low, 3)
    } else {
        format!("{} to {}", number(low, 3), number(high, 3))
    };
    format!(
        "In {} of {} its friction ({range}) is less than rocking needs",
        slipped.worlds,
        counted(trial.lived.len(), "world")
    )
}

pub(super) fn slip_words(trial: &Trial, slipped: &Slipped) -> String {
    format!(
        " {}: there it slides as well, and its pads answer for both models.",
        too_little_friction(trial, slipped)
    )
}

/// What sliding changes where no pads can answer.
pub(super) fn band_words(trial: &Trial, slipped: &Slipped, rigid: Option<ModelAnswers>) -> String {
    let why = match trial.subject.way {
        Way::Walled(_) => "beside a wall its pads are not followed",
        _ if trial.subject.body.is_none() => "its mass or its pads are not given",
        _ => "its pads are not followed",
    };
    let p = rigid.map_or(0.0, |rigid| rigid.overturn.value);
    let [low, high] = FALLS_WITH_FRICTION.map(|(friction_ratio, factor)| {
        format!(
            "{factor} times the one without, {}, at a friction of {friction_ratio}",
            percent((factor * p).min(1.0))
        )
    });
    format!(
        "{}: there it slides as well. That is not calculated, because {why}; in an audit of one object the probability \
         of falling was {low}, and {high}.",
        too_little_friction(trial, slipped)
    )
}

/// What a wall changes about an answer.
pub(super) fn beside_words(context: &Context, trial: &Trial, at_wall: &AtWall) -> String {
    let mut words = String::new();
    if at_wall.lean_share > 0.0 {
        let leaning = trial.leans().filter(|leans| *leans).count();
        words.push_str(&format!(
            " It ends leaning on its wall in {leaning} of {}, which count as falls.",
            counted(trial.followed().count(), "world")
        ));
    }
    if context.study.assessment.compliant && trial.subject.body.is_some() {
        words.push_str(" Beside a wall its pads are not followed: the rigid base alone answers.");
    }
    words
}

/// Said where a shock is asked and that at the wall cannot be calculated.
pub(super) fn unknown_wall_shock(trial: &Trial, at_wall: &AtWall) -> Option<String> {
    let is_asked = trial.subject.capacity.is_some() && at_wall.strike_share > 0.0;
    (is_asked && at_wall.acceleration_g_median.is_none())
        .then(|| "The shock at its wall is not compared with its tolerance: give wall_stiffness and mass.".to_owned())
}

pub(super) fn note_failures(trial: &Trial, notes: &mut Vec<String>) {
    let rigid = trial
        .lived
        .iter()
        .filter_map(|one| Some(one.failure()?.why()));
    let pads = trial
        .lived
        .iter()
        .filter_map(|one| one.pads.as_ref()?.as_ref().err().map(Lost::why));
    for (model, errors) in [
        ("a rigid base", rigid.collect::<Vec<_>>()),
        ("its pads", pads.collect()),
    ] {
        if let Some(first) = errors.first() {
            notes.push(format!(
                "The histories on {model} failed in {} of {} worlds ({first}); they count as exceeded in the upper \
                 end of an interval and as not exceeded in the lower.",
                errors.len(),
                trial.lived.len()
            ));
        }
    }
    let is_flight = |one: &&Lived| matches!(one.rigid, Some(Err(Lost::Flight(_))));
    let answered = trial
        .lived
        .iter()
        .filter(|one| is_flight(one) && one.is_for_pads())
        .count();
    if answered > 0 {
        notes.push(format!(
            "In {answered} of {} worlds its floor falls away (g + vertical acceleration ≤ 0), and it flies: there its \
             pads answer for both models.",
            trial.lived.len()
        ));
    }
    let unknown = trial
        .lived
        .iter()
        .filter(|one| is_flight(one) && !one.is_for_pads())
        .count();
    if unknown > 0 && trial.subject.way == Way::Planar && trial.subject.body.is_none() {
        notes.push(
            "Its pads could follow it through the air: give its mass and its pads.".to_owned(),
        );
    }
}
