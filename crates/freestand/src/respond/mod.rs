//! What an object does under the motions of its floor: the one way in which every object is asked,
//! however it is followed.
//!
//! An [`Object`] has one value for everything, and it is followed in one way; [`respond`] hands
//! blocks on rigid bases and on springs to the kernels, side by side, and everything else to its
//! solver. A [`Response`] keeps what each way tells, and its [`Outcome`] is what counts in decisions:
//! the worse of all planes.

mod error;
mod follow;
mod glide;
mod object;
mod outcome;
mod pads;
mod pulse;
mod settings;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::compliant::{CompliantWorld, rock_compliant_many};
use crate::hull::shake::{HullRocking, shake};
use crate::motion::Motion;
use crate::rocking::{Base, Restitution, RockingError, RockingSummary, rock_between};
use crate::spatial::{SpatialMotion, SpatialObject, Stack, StackPart};
use crate::wall::Walls;

pub use error::RespondError;
pub use follow::{
    HistoryOptions, PadHistory, PlaneSlideHistory, Release, RigidHistory, SlideHistory, SlidePoint,
    SpatialHistory, SpatialPoint, StackHistory, StackPoint,
};
pub use glide::Glide;
pub use object::{
    Along, Glider, Object, OnHull, Pads, Plane, Planes, RigidPlane, Shaking, Springs,
};
pub use outcome::{Outcome, Travelled};
pub use pads::{PadSummary, Tilt};
pub use settings::Settings;

/// What an object did under one motion, as its way tells it.
#[derive(Debug, Clone, PartialEq)]
pub enum Response {
    /// On a rigid base, in each plane.
    Rigid(Planes<RockingSummary>),
    /// On pads, in each plane.
    Pads(Planes<PadSummary>),
    /// How it rolled, in each plane.
    Rolled(Planes<Glide>),
    /// How it slid, in each plane.
    Slid(Planes<Glide>),
    /// In three dimensions; without a tilt its pads do not keep it upright.
    Spatial(PadSummary, Option<Tilt>),
    /// The lower body, and the one that fell first.
    Stack(PadSummary, Option<StackPart>),
    /// On the points of its hull.
    Hull(HullRocking),
}

impl Response {
    /// How the object ended.
    pub fn outcome(&self) -> Outcome {
        match self {
            Self::Rigid(planes) => {
                Outcome::of(planes.iter().map(|one| (one.outcome, one.uplift_m)))
            }
            Self::Pads(planes) => Outcome::of(planes.iter().map(|one| (one.outcome, one.lift_m))),
            Self::Rolled(planes) => Outcome::Rolled(Travelled::of(planes)),
            Self::Slid(planes) => Outcome::Slid(Travelled::of(planes)),
            Self::Spatial(body, _) | Self::Stack(body, _) => {
                Outcome::of(std::iter::once((body.outcome, body.lift_m)))
            }
            Self::Hull(body) => Outcome::on_hull(body),
        }
    }
}

/// What objects do, each under one of the motions, in their order, on the current rayon pool.
///
/// # Accuracy
/// That of each solver, as the settings ask for it: [`rock_between`], [`crate::compliant`],
/// [`crate::spatial`], [`crate::sliding`]. A response depends neither on the other objects nor on the number of threads.
///
/// # Errors
/// Of each object apart.
///
/// # Example
/// A cabinet under a pulse that lifts its edge, and the same on casters:
/// ```
/// use freestand::respond::{
///     Along, Glider, Object, Outcome, Plane, Planes, RespondError, RigidPlane, Settings, Shaking,
///     respond,
/// };
/// use freestand::{block::Block, motion::Motion, rocking::Restitution, wall::Walls};
/// use freestand::sliding::{Clearance, Friction};
/// let pulse = Motion::new(0.01, (0..100).map(|i| 4.0 * (0.0628 * f64::from(i)).sin()).collect())?;
/// let floor = Shaking { x: Some(&pulse), ..Shaking::default() };
/// let plane = Plane { along: Along::X, block: Block::uniform(1.8, 0.6)? };
/// let still = RigidPlane { plane, restitution: Restitution::Housner, walls: Walls::NONE };
/// let friction = Friction::uniform(0.02)?;
/// let (planes, clearance) = (Planes::single(plane), Clearance::default());
/// let rolling = Glider { planes, friction, clearance, yaw_rad: 0.0 };
/// let still = Object::Rigid(Planes::single(still));
/// let objects = [(still, floor), (Object::Rolls(rolling), floor)];
/// let outcomes = respond(&objects, &Settings::default()).into_iter().map(|found| Ok(found?.outcome()));
/// let outcomes: Vec<Outcome> = outcomes.collect::<Result<_, RespondError>>()?;
/// assert!(matches!(outcomes[0], Outcome::Rocked { uplift_m } if uplift_m > 0.01));
/// assert!(outcomes[1].travelled().is_some_and(|way| way.travel_m > 0.1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn respond(
    objects: &[(Object, Shaking<'_>)],
    settings: &Settings,
) -> Vec<Result<Response, RespondError>> {
    let (mut rigid, mut sprung) = (Vec::new(), Vec::new());
    let mut tasks = Vec::with_capacity(objects.len());
    for (object, shaking) in objects {
        tasks.push(match object {
            Object::Rigid(planes) => Task::Rigid(planes.map(|one| {
                rigid.push((*one, shaking.base(one.plane.along)));
                rigid.len() - 1
            })),
            Object::Springs(springs) => Task::Springs(springs.planes.map(|plane| {
                sprung.push(CompliantWorld {
                    block: plane.block,
                    mass_kg: springs.mass_kg,
                    stiffness_n_m: springs.stiffness_n_m,
                    damping_n_s_m: springs.damping_n_s_m,
                    motion: shaking.base(plane.along),
                });
                sprung.len() - 1
            })),
            Object::Pads(pads) => Task::Pads(pads, shaking),
            Object::Rolls(glider) => Task::Rolls(glider, shaking),
            Object::Slides(glider) => Task::Slides(glider, shaking),
            Object::Spatial(object, along) => Task::Spatial(object, *along, shaking),
            Object::Stack(stack, along) => Task::Stack(stack, *along, shaking),
            Object::Hull(body) => Task::Hull(body, shaking),
        });
    }
    let rigid = on_rigid_bases(&rigid, settings);
    let sprung = rock_compliant_many(&sprung, settings.gravity_m_s2);
    let done = |task: &Task<'_>| -> Result<Response, RespondError> {
        Ok(match task {
            Task::Rigid(places) => Response::Rigid(places.map(|&place| rigid[place]).all()?),
            Task::Springs(places) => {
                let of_place = |&place: &usize| PadSummary::of_springs(sprung[place].clone());
                Response::Pads(places.map(of_place).all()?)
            }
            Task::Pads(pads, shaking) => {
                let followed = |plane| PadSummary::followed(plane, &pads.base, shaking, settings);
                Response::Pads(pads.planes.map(followed).all()?)
            }
            Task::Rolls(glider, shaking) => Response::Rolled(glider.followed(shaking, settings)?),
            Task::Slides(glider, shaking) => Response::Slid(glider.followed(shaking, settings)?),
            Task::Spatial(object, along, shaking) => {
                let (body, tilt) = pads::in_space(object, *along, shaking, settings)?;
                Response::Spatial(body, tilt)
            }
            Task::Stack(stack, along, shaking) => {
                let (lower, fallen) = pads::stacked(stack, *along, shaking, settings)?;
                Response::Stack(lower, fallen)
            }
            Task::Hull(on, shaking) => {
                let motion = SpatialMotion {
                    x: shaking.x,
                    y: shaking.y,
                    vertical: shaking.vertical,
                };
                let gravity_m_s2 = settings.gravity_m_s2;
                let (body, contact) = (&on.body, &on.contact);
                Response::Hull(shake(body, contact, on.yaw_rad, &motion, gravity_m_s2)?)
            }
        })
    };
    tasks.par_iter().map(done).collect()
}

/// An object in [`respond`]; of one that a kernel follows, the places of its planes there.
enum Task<'a> {
    Rigid(Planes<usize>),
    Springs(Planes<usize>),
    Pads(&'a Pads, &'a Shaking<'a>),
    Rolls(&'a Glider, &'a Shaking<'a>),
    Slides(&'a Glider, &'a Shaking<'a>),
    Spatial(&'a SpatialObject, Along, &'a Shaking<'a>),
    Stack(&'a Stack, Along, &'a Shaking<'a>),
    Hull(&'a OnHull, &'a Shaking<'a>),
}

/// What blocks on rigid bases do, each under its own motion, in their order. Blocks under the same
/// motion stand side by side in the kernel. [`respond`] asks it for every object on a rigid base.
///
/// # Errors
/// Of each block apart: see [`rock`](crate::rocking::rock).
pub fn on_rigid_bases(
    planes: &[(RigidPlane, Base<'_>)],
    settings: &Settings,
) -> Vec<Result<RockingSummary, RockingError>> {
    let address =
        |motion: Option<&Motion>| motion.map_or(0, |motion| std::ptr::from_ref(motion).addr());
    let mut of_motion: BTreeMap<_, (Base<'_>, Vec<usize>)> = BTreeMap::new();
    for (place, (_, base)) in planes.iter().enumerate() {
        let key = [base.horizontal, base.vertical].map(address);
        of_motion
            .entry(key)
            .or_insert((*base, Vec::new()))
            .1
            .push(place);
    }
    let options = settings.rocking(Restitution::default(), Walls::NONE);
    let groups: Vec<_> = of_motion.into_values().collect();
    let found: Vec<_> = groups
        .into_par_iter()
        .map(|(base, places)| {
            let block = |&place: &usize| {
                let one = &planes[place].0;
                (one.plane.block, one.restitution, one.walls)
            };
            let blocks: Vec<_> = places.iter().map(block).collect();
            (places, rock_between(&blocks, base, &options))
        })
        .collect();
    let mut in_order: Vec<_> = found
        .into_iter()
        .flat_map(|(places, found)| places.into_iter().zip(found))
        .collect();
    in_order.sort_by_key(|(place, _)| *place);
    in_order.into_iter().map(|(_, found)| found).collect()
}
