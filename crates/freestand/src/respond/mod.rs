//! What an object does under the motions of its floor: the one way in which every object is asked,
//! however it is followed.
//!
//! An [`Object`] has one value for everything, and it is followed in one way; [`respond`] hands
//! blocks on rigid bases and on springs to the kernels, side by side, and everything else to its
//! solver. A [`Response`] keeps what each way tells, and its [`Outcome`] is what counts in decisions:
//! the worse of all planes.

mod error;
mod glide;
mod object;
mod outcome;
mod pads;
mod pulse;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::G0_M_S2;
use crate::compliant::{CompliantError, CompliantSummary, CompliantWorld, rock_compliant_many};
use crate::motion::Motion;
use crate::rocking::{
    Base, LONGEST_TAIL_S, Restitution, RockingError, RockingOptions, RockingSummary, Until,
    rock_between,
};
use crate::spatial::StackPart;
use crate::wall::Walls;

use error::resolved;

pub use error::RespondError;
pub use glide::Glide;
pub use object::{Along, Glider, Object, Pads, Plane, RigidPlane, Shaking, Springs};
pub use outcome::{Outcome, Travelled};
pub use pads::{OnPads, Tilt};

/// What an object did under one motion, as its way tells it.
#[derive(Debug, Clone, PartialEq)]
pub enum Response {
    /// On a rigid base, in each plane.
    Rigid(Vec<RockingSummary>),
    /// On pads, in each plane.
    Pads(Vec<OnPads>),
    /// How it rolled, in each plane.
    Rolled(Vec<Glide>),
    /// How it slid, in each plane.
    Slid(Vec<Glide>),
    /// In three dimensions; without a tilt its pads do not keep it upright.
    Spatial(OnPads, Option<Tilt>),
    /// The lower body, and the one that fell first.
    Stack(OnPads, Option<StackPart>),
}

impl Response {
    /// How the object ended.
    pub fn outcome(&self) -> Outcome {
        match self {
            Self::Rigid(planes) => Outcome::on_rigid(planes.iter()),
            Self::Pads(planes) => Outcome::on_pads(planes.iter()),
            Self::Rolled(planes) => Outcome::Rolled(Travelled::of(planes)),
            Self::Slid(planes) => Outcome::Slid(Travelled::of(planes)),
            Self::Spatial(body, _) | Self::Stack(body, _) => {
                Outcome::on_pads(std::iter::once(body))
            }
        }
    }
}

/// The options of every history on a rigid base: it goes on until the object is at rest or down.
pub fn rocking_options(restitution: Restitution, walls: Walls) -> RockingOptions {
    RockingOptions {
        restitution,
        walls,
        until: Until::Settled {
            at_most_s: LONGEST_TAIL_S,
        },
        ..RockingOptions::default()
    }
}

/// What objects do, each under one of the motions, in their order, on the current rayon pool.
///
/// # Accuracy
/// That of each solver: [`rock_between`] and [`crate::compliant`], at
/// [`CompliantAccuracy::Fast`](crate::compliant::CompliantAccuracy), [`crate::spatial`] at the same,
/// [`crate::sliding`]. A response depends neither on the other objects nor on the number of threads.
///
/// # Errors
/// Of each object apart.
///
/// # Example
/// A cabinet under a pulse that lifts its edge, and the same on casters:
/// ```
/// use freestand::respond::{
///     Along, Glider, Object, Outcome, Plane, RespondError, RigidPlane, Shaking, respond,
/// };
/// use freestand::{block::Block, motion::Motion, rocking::Restitution, wall::Walls};
/// use freestand::sliding::{Clearance, Friction};
/// let pulse = Motion::new(0.01, (0..100).map(|i| 4.0 * (0.0628 * f64::from(i)).sin()).collect())?;
/// let floor = Shaking { x: &pulse, y: None, vertical: None };
/// let plane = Plane { along: Along::X, block: Block::uniform(1.8, 0.6)? };
/// let still = RigidPlane { plane, restitution: Restitution::Housner, walls: Walls::NONE };
/// let friction = Friction::uniform(0.02)?;
/// let rolling = Glider { planes: vec![plane], friction, clearance: Clearance::default() };
/// let objects = [(Object::Rigid(vec![still]), floor), (Object::Rolls(rolling), floor)];
/// let outcomes = respond(&objects).into_iter().map(|found| Ok(found?.outcome()));
/// let outcomes: Vec<Outcome> = outcomes.collect::<Result<_, RespondError>>()?;
/// assert!(matches!(outcomes[0], Outcome::Rocked { uplift_m } if uplift_m > 0.01));
/// assert!(outcomes[1].travelled().is_some_and(|way| way.travel_m > 0.1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn respond(objects: &[(Object, Shaking<'_>)]) -> Vec<Result<Response, RespondError>> {
    let mut rocked = on_rigid(objects).into_iter();
    let mut sprung = on_springs(objects).into_iter();
    let others: Vec<_> = objects.par_iter().map(one_by_one).collect();
    let of_object = |((object, _), other): (&(Object, Shaking<'_>), Option<_>)| match object {
        Object::Rigid(planes) => {
            let found: Vec<_> = rocked.by_ref().take(planes.len()).collect();
            let found = found.into_iter().map(|one| {
                let summary = one?;
                resolved(summary.outcome).map(|()| summary)
            });
            found.collect::<Result<_, _>>().map(Response::Rigid)
        }
        Object::Springs(springs) => {
            let found: Vec<_> = sprung.by_ref().take(springs.planes.len()).collect();
            let found = found.into_iter().map(OnPads::of_springs);
            found.collect::<Result<_, _>>().map(Response::Pads)
        }
        _ => other.unwrap_or(Err(RespondError::Unresolved)),
    };
    objects.iter().zip(others).map(of_object).collect()
}

/// Blocks that rock under the same motion stand side by side in the kernel.
fn on_rigid(objects: &[(Object, Shaking<'_>)]) -> Vec<Result<RockingSummary, RockingError>> {
    let mut planes: Vec<(&RigidPlane, Base<'_>)> = Vec::new();
    for (object, shaking) in objects {
        if let Object::Rigid(own) = object {
            let base = |one: &RigidPlane| shaking.base(one.plane.along);
            planes.extend(own.iter().map(|one| (one, base(one))));
        }
    }
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
    let options = rocking_options(Restitution::Housner, Walls::NONE);
    let groups: Vec<_> = of_motion.into_values().collect();
    let found: Vec<_> = groups
        .into_par_iter()
        .map(|(base, places)| {
            let block = |&place: &usize| {
                let one = planes[place].0;
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

/// All objects on springs stand side by side in the kernel.
fn on_springs(objects: &[(Object, Shaking<'_>)]) -> Vec<Result<CompliantSummary, CompliantError>> {
    let mut worlds = Vec::new();
    for (object, shaking) in objects {
        if let Object::Springs(springs) = object {
            worlds.extend(springs.planes.iter().map(|plane| CompliantWorld {
                block: plane.block,
                mass_kg: springs.mass_kg,
                stiffness_n_m: springs.stiffness_n_m,
                damping_n_s_m: springs.damping_n_s_m,
                motion: shaking.base(plane.along),
            }));
        }
    }
    rock_compliant_many(&worlds, G0_M_S2)
}

/// What no kernel follows; `None`: a kernel does.
fn one_by_one((object, shaking): &(Object, Shaking<'_>)) -> Option<Result<Response, RespondError>> {
    Some(match object {
        Object::Rigid(_) | Object::Springs(_) => return None,
        Object::Pads(object) => {
            let planes = object.planes.iter();
            let found = planes.map(|plane| OnPads::followed(plane, &object.base, shaking));
            found.collect::<Result<_, _>>().map(Response::Pads)
        }
        Object::Rolls(glider) => glider.followed(shaking).map(Response::Rolled),
        Object::Slides(glider) => glider.followed(shaking).map(Response::Slid),
        Object::Spatial(object, along) => pads::in_space(object, *along, shaking)
            .map(|(body, tilt)| Response::Spatial(body, tilt)),
        Object::Stack(stack, along) => pads::stacked(stack, *along, shaking)
            .map(|(lower, fallen)| Response::Stack(lower, fallen)),
    })
}
