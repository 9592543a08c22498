//! Some earthquakes of one object, and its history in one of them, for those who draw it.

use freestand::G0_M_S2;
use freestand::compliant::CompliantAccuracy;
use freestand::respond::{HistoryOptions, PadSummary, Pads, Plane, Settings};
use freestand::rocking::Outcome;
use freestand::spatial::SpatialMotion;
use freestand_input::problem::{Problem, Problems};
use freestand_study::drawn::{DrawnHistory, drawn, drawn_on_pads};
use freestand_study::drawn_body::drawn_body;
use freestand_study::rock::edge_landings;
use freestand_study::unsolved;
use serde::Serialize;

use super::Context;
use super::draw::Drawn;
use super::object::{Model, Way};
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
/// object neither rocks in a plane nor on its hull and no earthquake was named: then there is an answer, but
/// nothing to draw.
pub(super) fn shown(
    context: &Context,
    trial: &Trial,
    follow: &Follow,
) -> Result<Option<Shown>, Problems> {
    let model = deciding(context, trial);
    let strength = |(world, lived): (usize, &Lived)| {
        let found = in_world(lived, model)?;
        let strength = if found.outcome.has_fallen() {
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
        outcome: found.outcome.name(),
        uplift_m: (!found.outcome.has_fallen()).then_some(found.uplift_m),
        landing_acceleration_g: found.landing_g.filter(|_| !found.outcome.has_fallen()),
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
                        dimensions on cushions have no history to draw";
            Err(Problem::value("the object has no history to draw", hint).into())
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
    outcome: Outcome,
    uplift_m: f64,
    landing_g: Option<f64>,
}

fn in_world(lived: &Lived, model: Model) -> Option<InWorld> {
    let axes: Vec<InWorld> = match lived.answering(model) {
        Model::Rigid => lived
            .on_rigid()?
            .axes
            .iter()
            .enumerate()
            .map(|(axis, one)| of_rigid(axis, one, lived))
            .collect(),
        Model::Pads => lived
            .on_pads()?
            .axes
            .iter()
            .enumerate()
            .map(of_pads)
            .collect(),
    };
    let farther = |a: &InWorld, b: &InWorld| {
        a.outcome
            .has_fallen()
            .cmp(&b.outcome.has_fallen())
            .then(a.uplift_m.total_cmp(&b.uplift_m))
    };
    axes.into_iter().max_by(farther)
}

fn of_rigid(axis: usize, motion: &AxisMotion, lived: &Lived) -> InWorld {
    let landing_g = motion.hit().map(|hit| lived.draw.model * hit.larger_g());
    InWorld {
        axis,
        outcome: motion.outcome(),
        uplift_m: motion.uplift_m(),
        landing_g: landing_g.filter(|_| motion.lifts()),
    }
}

fn of_pads((axis, motion): (usize, &PadMotion)) -> InWorld {
    let PadSummary {
        outcome, lift_m, ..
    } = motion.found;
    let landing_g = motion.edge_m_s2 / G0_M_S2;
    InWorld {
        axis,
        outcome,
        uplift_m: lift_m,
        landing_g: motion.found.has_let_go().then_some(landing_g),
    }
}

/// The history of the object in a world, with the values that were drawn there; `None` if it neither
/// rocks in a plane nor on its hull.
fn history(
    context: &Context,
    trial: &Trial,
    model: Model,
    world: u32,
    axis: usize,
) -> Result<Option<DrawnHistory>, Problems> {
    let subject = &trial.subject;
    let Some(lived) = trial.lived.get(world as usize) else {
        return Ok(None);
    };
    let draw = &lived.draw;
    let one = Drawn { subject, draw };
    let floor = context.worlds.floor(world, subject.level_ratio)?;
    if let Way::Hull(body, beside) = &subject.way {
        let Some(on) = one.on_hull(body, beside.as_ref()) else {
            return Ok(None);
        };
        let shaking = floor.shaking();
        let motion = SpatialMotion {
            x: shaking.x,
            y: shaking.y,
            vertical: shaking.vertical,
        };
        let history = drawn_body(body, &on, one.drawing(body), &motion, G0_M_S2, false);
        let history = history.map_err(|error| unsolved::problem(error.into()))?;
        return Ok(Some(history));
    }
    if !subject.way.rocks() || subject.way.is_slow() {
        return Ok(None);
    }
    let how = HistoryOptions::sampled(Settings {
        on_pads: CompliantAccuracy::Standard,
        ..Settings::default()
    });
    let on_pads = || one.pads(draw.friction_ratio.filter(|_| lived.slips));
    if let (Model::Pads, Some(pads)) = (lived.answering(model), on_pads()) {
        let planes = pads.planes.about(axis);
        let Plane { along, block } = planes.one;
        let base = floor.base(along);
        let history = Pads { planes, ..pads }.follow(base, &how);
        let history = history.map_err(unsolved::problem)?;
        return Ok(Some(drawn_on_pads(&block, &history, base.horizontal)));
    }
    let Some(object) = one.rigid_plane(axis) else {
        return Ok(None);
    };
    let base = floor.base(object.plane.along);
    let history = object.follow(base, &how).map_err(unsolved::problem)?;
    let body = draw.body(subject);
    let body = body.as_ref().map(|(mass_kg, cushion)| (*mass_kg, cushion));
    let landings = edge_landings(&object.plane.block, &history.rocking, body, G0_M_S2);
    Ok(Some(drawn(&object, &history, &landings, base.horizontal)))
}
