//! Some earthquakes of one object, and its history in one of them, for those who draw it.

use freestand::rocking::{Outcome, Restitution};
use freestand::wall::Walls;
use freestand_input::problem::{Problem, Problems};
use freestand_study::cushion::EdgeCushion;
use freestand_study::drawn::{DrawnHistory, drawn};
use freestand_study::rock::{RockRequest, rock};
use freestand_study::walls::WallStiffness;
use serde::Serialize;

use super::Context;
use super::object::Hit;
use super::response::{AxisMotion, Lived, options};
use super::trial::Trial;

/// Earthquakes that are shown.
const MAX_SHOWN: usize = 10;

/// The earthquake whose history is followed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Follow {
    /// The gentlest that overturns the object; where none does, the one that turns it farthest.
    Telling,
    /// By its name.
    Named(String),
}

/// Some earthquakes of an object on a rigid floor, and its history in one of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shown {
    /// At most ten, from the gentlest to the strongest for this object.
    pub earthquakes: Vec<ShownEarthquake>,
    /// The name of the one that is followed.
    pub followed: String,
    /// Its history.
    pub history: DrawnHistory,
}

/// One earthquake of an object.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShownEarthquake {
    /// Its name.
    pub name: String,
    /// How the object ends: `no-uplift`, `rocked`, `leaned`, `overturned`.
    pub outcome: &'static str,
    /// Largest uplift of an edge; `None`: it overturns \[m\].
    pub uplift_m: Option<f64>,
    /// Largest shock of a landing, from the impact model \[g\]; `None`: it overturns, or mass and pads
    /// are not known.
    pub landing_acceleration_g: Option<f64>,
    /// Peak acceleration of the floor \[m/s²\].
    pub floor_accel_m_s2: f64,
}

/// What is shown of a trial.
pub(super) fn shown(context: &Context, trial: &Trial, follow: &Follow) -> Result<Shown, Problems> {
    let strength = |(world, lived): (usize, &Lived)| {
        let (axis, motion) = worse(lived)?;
        let has_fallen = motion.rocking.outcome.has_fallen();
        let turned = if has_fallen { f64::INFINITY } else { motion.rocking.peak_rotation_rad };
        Some((turned, world as u32, axis))
    };
    let mut all: Vec<(f64, u32, usize)> = trial.lived.iter().enumerate().filter_map(strength).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let count = all.len().min(MAX_SHOWN);
    let place = |i: usize| if count < 2 { 0 } else { (i * (all.len() - 1) + (count - 1) / 2) / (count - 1) };
    let chosen: Vec<(f64, u32, usize)> = (0..count).filter_map(|i| all.get(place(i)).copied()).collect();
    let earthquakes = chosen.iter().filter_map(|(_, world, _)| earthquake(context, trial, *world)).collect();
    let found = match follow {
        Follow::Telling => chosen.iter().find(|one| one.0.is_infinite()).or(chosen.last()),
        Follow::Named(name) => all.iter().find(|one| is_named(&context.worlds.name(one.1), name)),
    };
    let Some(&(_, world, axis)) = found else {
        let names: Vec<String> = chosen.iter().map(|one| context.worlds.name(one.1)).collect();
        let hint = format!("choose one of them, such as {}", names.join(", "));
        return Err(Problem::value("there is no earthquake of this name", hint).into());
    };
    let followed = context.worlds.name(world);
    Ok(Shown { earthquakes, followed, history: history(context, trial, world, axis)? })
}

/// A motion that worlds use in turn is named with its world; it may be asked for without.
fn is_named(own: &str, name: &str) -> bool {
    own == name || own.strip_prefix(name).is_some_and(|rest| rest.starts_with(" (world "))
}

/// The axis about which it falls, or turns farthest.
fn worse(lived: &Lived) -> Option<(usize, &AxisMotion)> {
    let axes = lived.rigid.as_ref().ok()?;
    let turned = |motion: &AxisMotion| (motion.rocking.outcome.has_fallen(), motion.rocking.peak_rotation_rad);
    let farther = |a: &(usize, &AxisMotion), b: &(usize, &AxisMotion)| {
        let (a, b) = (turned(a.1), turned(b.1));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    };
    axes.iter().enumerate().max_by(farther)
}

fn earthquake(context: &Context, trial: &Trial, world: u32) -> Option<ShownEarthquake> {
    let lived = trial.lived.get(world as usize)?;
    let rocking = &worse(lived)?.1.rocking;
    let hits = lived.rigid.iter().flatten().filter_map(|axis| axis.hit.as_ref().map(Hit::larger_g));
    let stands = !rocking.outcome.has_fallen();
    Some(ShownEarthquake {
        name: context.worlds.name(world),
        outcome: rocking.outcome.name(),
        uplift_m: stands.then_some(rocking.uplift_m),
        landing_acceleration_g: hits
            .reduce(f64::max)
            .filter(|_| stands && rocking.outcome != Outcome::NoUplift)
            .map(|shock_g| lived.draw.model * shock_g),
        floor_accel_m_s2: lived.pfa_m_s2,
    })
}

/// The object in a world, with the values that were drawn there.
fn history(context: &Context, trial: &Trial, world: u32, axis: usize) -> Result<DrawnHistory, Problems> {
    let nothing = || Problem::value("nothing rocks here", "objects on free casters have no rocking history");
    let lived = trial.lived.get(world as usize).ok_or_else(nothing)?;
    let (draw, subject) = (&lived.draw, &trial.subject);
    if subject.rolls.is_some() {
        return Err(nothing().into());
    }
    let (block, restitution): (_, Restitution) = draw.block(subject, axis).ok_or_else(nothing)?;
    let walls: Walls = draw.walls(subject, axis);
    let floor = context.worlds.floor(world, subject.level_ratio)?;
    let base = floor.base(draw.is_along_x(axis));
    let cushion = draw
        .body(subject)
        .map(|(mass_kg, cushion)| (mass_kg, EdgeCushion { cushion, pad_thickness_m: None, notes: Vec::new() }));
    let request = RockRequest {
        block,
        horizontal: base.horizontal.cloned(),
        vertical: base.vertical.cloned(),
        options: options(restitution, walls),
        cushion,
        wall: WallStiffness::default(),
        friction: None,
    };
    let report = rock(&request, true)?;
    Ok(drawn(&report, base.horizontal))
}
