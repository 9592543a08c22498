//! What there is to know of an object besides its decision.

use crate::reason::{Note, WithoutPads};
use crate::result::{AtWall, Decision};
use freestand_input::problem::Problems;

use super::Context;
use super::object::Way;
use super::response::{AxisMotion, Lived, Lost};
use super::trial::Trial;

/// What is left out of three dimensions and of stacks.
pub(super) fn space_notes(context: &Context, trial: &Trial) -> Result<Vec<Note>, Problems> {
    let mut notes = Vec::new();
    match &trial.subject.way {
        Way::Spatial(beside) => {
            notes.push(Note::OneRealisation);
            let floor = context.worlds.floor(0, trial.subject.level_ratio)?;
            if floor.motion.across.is_none() {
                notes.push(Note::OneComponent);
            }
            if beside.is_some() && trial.subject.capacity.is_some() {
                notes.push(Note::WallShockNotCompared);
            }
        }
        Way::Stack(_) => notes.push(Note::StackInPlane),
        Way::Hull(_, beside) => {
            notes.push(Note::OnHull);
            let item = trial.member.item;
            let is_low = |wall_m: f64| item.height_m.is_some_and(|height_m| wall_m < height_m);
            let around = &item.surroundings;
            if beside.is_none() && around.has_wall() && around.wall_height_m.is_some_and(is_low) {
                notes.push(Note::LowWall);
            }
        }
        Way::Planar | Way::Walled(_) | Way::Rolls(_) | Way::Slides(_) => {}
    }
    Ok(notes)
}

/// The largest accepted probability at which the rarest falls decide on *leave*.
const RARE_RATIO: f64 = 0.05;

/// Where *leave* rests on rare falls on the ground in synthetic worlds, which may have too few of them (docs/validation.md).
pub(super) fn lowest_tail(context: &Context, trial: &Trial, decision: Decision) -> Option<Note> {
    let is_rare = decision == Decision::Leave && trial.member.accepted_ratio <= RARE_RATIO;
    let is_synthetic = context.worlds.records().is_none();
    let is_on_ground = trial.subject.level_ratio == 0.0;
    (is_rare && is_synthetic && is_on_ground && trial.subject.way.rocks())
        .then_some(Note::LowestTail)
}

/// Why no pads answer where it slides while it rocks.
pub(super) fn without_pads(trial: &Trial) -> WithoutPads {
    match trial.subject.way {
        Way::Walled(_) => WithoutPads::BesideWall,
        _ if trial.subject.body.is_none() => WithoutPads::NotGiven,
        _ => WithoutPads::NotFollowed,
    }
}

/// Where a shock is asked, and that at the wall cannot be calculated.
pub(super) fn unknown_wall_shock(trial: &Trial, at_wall: &AtWall) -> Option<Note> {
    let is_asked = trial.subject.capacity.is_some() && at_wall.strike_share > 0.0;
    (is_asked && at_wall.acceleration_g_median.is_none()).then_some(Note::WallShockUnknown)
}

/// The histories that failed, and the worlds in which it does not stand before the floor moves or flies.
pub(super) fn failures(trial: &Trial) -> Vec<Note> {
    let of = trial.lived.len() as u32;
    let rigid = trial
        .lived
        .iter()
        .filter_map(|one| Some(one.failure()?.why()));
    let pads = trial
        .lived
        .iter()
        .filter_map(|one| one.pads.as_ref()?.as_ref().err().map(Lost::why));
    let failed = |on_pads: bool, all: Vec<&str>| {
        let why = (*all.first()?).to_owned();
        let worlds = all.len() as u32;
        Some(Note::Failed {
            on_pads,
            worlds,
            of,
            why,
        })
    };
    let mut notes: Vec<Note> = [failed(false, rigid.collect()), failed(true, pads.collect())]
        .into_iter()
        .flatten()
        .collect();
    let tips = |one: &&Lived| {
        let told = one.on_rigid();
        told.is_some_and(|told| told.axes.iter().any(AxisMotion::tips_at_rest))
    };
    let worlds = trial.lived.iter().filter(tips).count() as u32;
    if worlds > 0 {
        notes.push(Note::TipsAtRest { worlds, of });
    }
    let is_flight = |one: &&Lived| matches!(one.rigid, Some(Err(Lost::Flight(_))));
    let flights = || trial.lived.iter().filter(is_flight);
    let answered = flights().filter(|one| one.is_for_pads()).count() as u32;
    if answered > 0 {
        let worlds = answered;
        notes.push(Note::Flies { worlds, of });
    }
    let is_unknown = flights().any(|one| !one.is_for_pads());
    if is_unknown && trial.subject.way == Way::Planar && trial.subject.body.is_none() {
        notes.push(Note::FliesWithoutPads);
    }
    notes
}
