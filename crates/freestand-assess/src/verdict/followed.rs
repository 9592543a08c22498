//! Some earthquakes of one object, and its history in one of them, for those who draw it.

use freestand::G0_M_S2;
use freestand::compliant::{CompliantBase, CompliantOptions};
use freestand::respond::rocking_options;
use freestand::rocking::{Outcome, Restitution, RockingSummary};
use freestand_input::problem::{Problem, Problems};
use freestand_study::cushion::EdgeCushion;
use freestand_study::drawn::{DrawnHistory, drawn, drawn_on_pads};
use freestand_study::rock::{RockRequest, rock};
use freestand_study::walls::WallStiffness;
use serde::Serialize;

use super::Context;
use super::object::Model;
use super::response::{AxisMotion, Lived, PadMotion};
use super::tally::deciding;
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

/// Some earthquakes of an object, and its history in one of them, by the model that decides whether it falls.
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
    /// Largest shock of a landing \[g\]; `None`: it overturns, or mass and pads are not known.
    pub landing_acceleration_g: Option<f64>,
}

/// What is shown of a trial, by the model that decides whether the object falls. `None` if the
/// object does not rock in a plane and no earthquake was named: then there is an answer, but
/// nothing to draw.
pub(super) fn shown(
    context: &Context,
    trial: &Trial,
    follow: &Follow,
) -> Result<Option<Shown>, Problems> {
    let model = deciding(context, trial);
    let strength = |(world, lived): (usize, &Lived)| {
        let found = in_world(lived, model)?;
        let strength = if found.has_fallen {
            f64::INFINITY
        } else {
            found.uplift_m
        };
        Some((strength, world as u32, found))
    };
    let mut all: Vec<(f64, u32, InWorld)> = trial
        .lived
        .iter()
        .enumerate()
        .filter_map(strength)
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let count = all.len().min(MAX_SHOWN);
    let place = |i: usize| {
        if count < 2 {
            0
        } else {
            (i * (all.len() - 1) + (count - 1) / 2) / (count - 1)
        }
    };
    let chosen: Vec<&(f64, u32, InWorld)> = (0..count).filter_map(|i| all.get(place(i))).collect();
    let earthquakes = chosen.iter().map(|(_, world, found)| ShownEarthquake {
        name: context.worlds.name(*world),
        outcome: found.outcome,
        uplift_m: (!found.has_fallen).then_some(found.uplift_m),
        landing_acceleration_g: found.landing_g.filter(|_| !found.has_fallen),
    });
    let followed = match follow {
        Follow::Telling => chosen
            .iter()
            .find(|one| one.0.is_infinite())
            .or(chosen.last())
            .copied(),
        Follow::Named(name) => all
            .iter()
            .find(|one| is_named(&context.worlds.name(one.1), name)),
    };
    if all.is_empty() && *follow == Follow::Telling {
        return Ok(None);
    }
    let Some(&(_, world, found)) = followed else {
        let names: Vec<String> = chosen
            .iter()
            .map(|one| context.worlds.name(one.1))
            .collect();
        let hint = format!("choose one of them, such as {}", names.join(", "));
        return Err(Problem::value("there is no earthquake of this name", hint).into());
    };
    match (history(context, trial, model, world, found.axis)?, follow) {
        (Some(history), _) => Ok(Some(Shown {
            earthquakes: earthquakes.collect(),
            followed: context.worlds.name(world),
            history,
        })),
        (None, Follow::Telling) => Ok(None),
        (None, Follow::Named(_)) => {
            let hint = "leave out the name of the earthquake; objects that roll or slide, stacks and objects in three \
                        dimensions have no history to draw";
            Err(Problem::value(
                "the object does not rock in a plane, so it has no history to draw",
                hint,
            )
            .into())
        }
    }
}

/// A motion that worlds use in turn is named with its world; it may be asked for without.
fn is_named(own: &str, name: &str) -> bool {
    own == name
        || own
            .strip_prefix(name)
            .is_some_and(|rest| rest.starts_with(" (world "))
}

/// What one model says of a world, about the axis that is worse.
#[derive(Debug, Clone, Copy)]
struct InWorld {
    axis: usize,
    outcome: &'static str,
    has_fallen: bool,
    uplift_m: f64,
    landing_g: Option<f64>,
}

fn in_world(lived: &Lived, model: Model) -> Option<InWorld> {
    let axes: Vec<InWorld> = match lived.answering(model) {
        Model::Rigid => lived
            .on_rigid()?
            .iter()
            .enumerate()
            .map(|(axis, one)| of_rigid(axis, one, lived))
            .collect(),
        Model::Pads => lived.on_pads()?.iter().enumerate().map(of_pads).collect(),
    };
    let farther = |a: &InWorld, b: &InWorld| {
        a.has_fallen
            .cmp(&b.has_fallen)
            .then(a.uplift_m.total_cmp(&b.uplift_m))
    };
    axes.into_iter().max_by(farther)
}

fn of_rigid(axis: usize, motion: &AxisMotion, lived: &Lived) -> InWorld {
    let RockingSummary {
        outcome, uplift_m, ..
    } = motion.rocking;
    let landing_g = motion
        .hit
        .as_ref()
        .map(|hit| lived.draw.model * hit.larger_g());
    InWorld {
        axis,
        outcome: outcome.name(),
        has_fallen: outcome.has_fallen(),
        uplift_m,
        landing_g: landing_g.filter(|_| outcome != Outcome::NoUplift),
    }
}

fn of_pads((axis, motion): (usize, &PadMotion)) -> InWorld {
    let outcome = match (motion.found.has_overturned, motion.found.has_let_go) {
        (true, _) => Outcome::Overturned,
        (false, true) => Outcome::Rocked,
        (false, false) => Outcome::NoUplift,
    };
    InWorld {
        axis,
        outcome: outcome.name(),
        has_fallen: motion.found.has_overturned,
        uplift_m: motion.found.lift_m,
        landing_g: motion
            .found
            .has_let_go
            .then_some(motion.edge_m_s2 / G0_M_S2),
    }
}

/// The history of the object in a world, with the values that were drawn there; `None` if it does
/// not rock in a plane.
fn history(
    context: &Context,
    trial: &Trial,
    model: Model,
    world: u32,
    axis: usize,
) -> Result<Option<DrawnHistory>, Problems> {
    let subject = &trial.subject;
    let Some(lived) = trial
        .lived
        .get(world as usize)
        .filter(|_| subject.way.rocks() && !subject.way.is_slow())
    else {
        return Ok(None);
    };
    let draw = &lived.draw;
    let Some((block, restitution)): Option<(_, Restitution)> = draw.block(subject, axis) else {
        return Ok(None);
    };
    let floor = context.worlds.floor(world, subject.level_ratio)?;
    let base = floor.base(draw.along(axis));
    if let (Model::Pads, Some((mass_kg, cushion))) =
        (lived.answering(model), draw.damped_body(subject))
    {
        let friction_ratio = draw.friction_ratio.filter(|_| lived.slips);
        let on_pads = CompliantBase {
            friction_ratio,
            ..CompliantBase::new(mass_kg, cushion)
        };
        return Ok(Some(drawn_on_pads(
            &block,
            &on_pads,
            base,
            &CompliantOptions::default(),
        )?));
    }
    let request = RockRequest {
        block,
        horizontal: base.horizontal.cloned(),
        vertical: base.vertical.cloned(),
        options: rocking_options(restitution, draw.walls(subject, axis)),
        cushion: draw.body(subject).map(|(mass_kg, cushion)| {
            (
                mass_kg,
                EdgeCushion {
                    cushion,
                    pad_thickness_m: None,
                    notes: Vec::new(),
                },
            )
        }),
        wall: WallStiffness::default(),
        friction: None,
    };
    let report = rock(&request, true)?;
    Ok(Some(drawn(&report, base.horizontal)))
}
