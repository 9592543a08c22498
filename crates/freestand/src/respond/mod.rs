//! What an object does under the motions of its floor: the one way in which every object is asked,
//! however it is followed.
//!
//! An [`Object`] has one value for everything, and it is followed in one way; [`respond`] hands
//! blocks on rigid bases and on springs to the kernels, side by side, and everything else to its
//! solver. A [`Response`] keeps what each way tells, and its [`Outcome`] is what counts in decisions:
//! the worse of all planes.

mod glide;
mod pads;
mod pulse;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use rayon::prelude::*;
use thiserror::Error;

use crate::G0_M_S2;
use crate::block::Block;
use crate::compliant::{
    CompliantBase, CompliantError, CompliantSummary, CompliantWorld, rock_compliant_many,
};
use crate::motion::Motion;
use crate::rocking::{
    Base, LONGEST_TAIL_S, Outcome as Rocking, Restitution, RockingError, RockingOptions,
    RockingSummary, Until, rock_between,
};
use crate::sliding::{Clearance, Friction, SlidingError};
use crate::spatial::{SpatialObject, Stack, StackPart};
use crate::wall::Walls;

pub use glide::Glide;
pub use pads::{OnPads, Tilt};

/// The accelerations of a floor.
#[derive(Debug, Clone, Copy)]
pub struct Shaking<'a> {
    /// Along x.
    pub x: &'a Motion,
    /// Along y. `None`: one horizontal component is known. What moves in a plane moves under it in any
    /// direction, what moves in space along its x alone.
    pub y: Option<&'a Motion>,
    /// Upward.
    pub vertical: Option<&'a Motion>,
}

impl<'a> Shaking<'a> {
    /// How the base of an object moves in a plane.
    pub fn base(&self, along: Along) -> Base<'a> {
        Base {
            horizontal: Some(self.component(along)),
            vertical: self.vertical,
        }
    }

    /// One of the horizontal components; without a second one the first is both.
    pub fn component(&self, along: Along) -> &'a Motion {
        match (along, self.y) {
            (Along::Y, Some(y)) => y,
            _ => self.x,
        }
    }
}

/// A horizontal axis of the floor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Along {
    /// x.
    X,
    /// y.
    Y,
}

/// A free-standing object with one value for everything, followed in one way.
#[derive(Debug, Clone)]
pub enum Object {
    /// It rocks on a rigid base, about each of its axes apart.
    Rigid(Vec<RigidPlane>),
    /// The same on pads that are springs with dampers.
    Springs(Springs),
    /// The same on pads of any law, with friction or without.
    Pads(Pads),
    /// It rolls on casters.
    Rolls(Glider),
    /// It slides on its base before an edge could lift.
    Slides(Glider),
    /// It moves in three dimensions on its pads; its x lies along this axis of the floor.
    Spatial(SpatialObject, Along),
    /// It moves in a plane with another body on it, both on pads.
    Stack(Stack, Along),
}

/// An object in one plane of motion.
#[derive(Debug, Clone, Copy)]
pub struct Plane {
    /// The component of the floor that moves it.
    pub along: Along,
    /// The object in this plane.
    pub block: Block,
}

/// An object on a rigid base in one plane of motion.
#[derive(Debug, Clone, Copy)]
pub struct RigidPlane {
    /// The object and its direction.
    pub plane: Plane,
    /// What remains of ω in an impact.
    pub restitution: Restitution,
    /// What stands beside it.
    pub walls: Walls,
}

/// An object on springs with dampers.
#[derive(Debug, Clone)]
pub struct Springs {
    /// Each of its planes.
    pub planes: Vec<Plane>,
    /// Its mass \[kg\].
    pub mass_kg: f64,
    /// k: of the pads under one edge, upright and sideways \[N/m\].
    pub stiffness_n_m: f64,
    /// c: of the pads under one edge, upright \[N s/m\].
    pub damping_n_s_m: f64,
}

/// An object on pads of any law.
#[derive(Debug, Clone)]
pub struct Pads {
    /// Each of its planes.
    pub planes: Vec<Plane>,
    /// Its mass, and what it rests on.
    pub base: CompliantBase,
}

/// An object that rolls or slides without rocking; only a stop can overturn it.
#[derive(Debug, Clone)]
pub struct Glider {
    /// Each of its planes. A single one stands for both directions.
    pub planes: Vec<Plane>,
    /// Friction of its base, or the rolling resistance of its casters.
    pub friction: Friction,
    /// The way to a stop, on both sides of every plane.
    pub clearance: Clearance,
}

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

/// How an object ended, in the worse of its planes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// No edge lifted, and it stayed where it was.
    Stood,
    /// An edge lifted, and it did not fall.
    Rocked {
        /// Largest uplift of an edge \[m\].
        uplift_m: f64,
    },
    /// It rolled on its casters, or its stop tripped it.
    Rolled(Travelled),
    /// It slid on its base, or its stop tripped it.
    Slid(Travelled),
    /// It ended leaning on a wall.
    Leaned,
    /// It fell.
    Overturned,
}

/// How an object rolled or slid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travelled {
    /// The largest way from where it stood, as if nothing were in the way \[m\].
    pub travel_m: f64,
    /// Speed at which it reached its stop; `None`: it did not \[m/s\].
    pub stop_speed_m_s: Option<f64>,
    /// Whether one component of the floor is all that is known, so that it went farther.
    pub is_at_least: bool,
    /// Whether the stop overturned it.
    pub has_tripped: bool,
}

impl Outcome {
    /// On a rigid base, from every plane.
    pub fn on_rigid<'a>(planes: impl Iterator<Item = &'a RockingSummary> + Clone) -> Self {
        let ends = |outcome: Rocking| planes.clone().any(|one| one.outcome == outcome);
        if ends(Rocking::Overturned) {
            Self::Overturned
        } else if ends(Rocking::Leaned) {
            Self::Leaned
        } else if planes.clone().any(|one| one.outcome != Rocking::NoUplift) {
            Self::Rocked {
                uplift_m: planes.map(|one| one.uplift_m).fold(0.0, f64::max),
            }
        } else {
            Self::Stood
        }
    }

    /// On pads, from every plane or of the whole body.
    pub fn on_pads<'a>(planes: impl Iterator<Item = &'a OnPads> + Clone) -> Self {
        if planes.clone().any(|one| one.has_overturned) {
            Self::Overturned
        } else if planes.clone().any(|one| one.has_let_go) {
            Self::Rocked {
                uplift_m: planes.map(|one| one.lift_m).fold(0.0, f64::max),
            }
        } else {
            Self::Stood
        }
    }

    /// How it rolled or slid; `None`: it rocks.
    pub fn travelled(self) -> Option<Travelled> {
        match self {
            Self::Rolled(way) | Self::Slid(way) => Some(way),
            Self::Stood | Self::Rocked { .. } | Self::Leaned | Self::Overturned => None,
        }
    }

    /// Largest uplift of an edge, 0 where none lifted; `None`: it fell \[m\].
    pub fn uplift_m(self) -> Option<f64> {
        match self {
            Self::Rocked { uplift_m } => Some(uplift_m),
            Self::Leaned | Self::Overturned => None,
            Self::Rolled(way) | Self::Slid(way) => (!way.has_tripped).then_some(0.0),
            Self::Stood => Some(0.0),
        }
    }

    /// Whether it has fallen over, onto the floor or against a wall: what counts in decisions.
    pub fn has_fallen(self) -> bool {
        match self {
            Self::Leaned | Self::Overturned => true,
            Self::Rolled(way) | Self::Slid(way) => way.has_tripped,
            Self::Stood | Self::Rocked { .. } => false,
        }
    }
}

impl Response {
    /// How the object ended.
    pub fn outcome(&self) -> Outcome {
        match self {
            Self::Rigid(planes) => Outcome::on_rigid(planes.iter()),
            Self::Pads(planes) => Outcome::on_pads(planes.iter()),
            Self::Rolled(planes) => Outcome::Rolled(Glide::travelled(planes)),
            Self::Slid(planes) => Outcome::Slid(Glide::travelled(planes)),
            Self::Spatial(body, _) | Self::Stack(body, _) => {
                Outcome::on_pads(std::iter::once(body))
            }
        }
    }
}

/// Why it is not known what an object does.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RespondError {
    /// On a rigid base.
    #[error(transparent)]
    Rocking(#[from] RockingError),
    /// While it rolls or slides.
    #[error(transparent)]
    Sliding(#[from] SlidingError),
    /// On pads.
    #[error(transparent)]
    Compliant(#[from] CompliantError),
    /// Its history ended before it was certain what becomes of it.
    #[error("the object is neither at rest nor down long after the motion")]
    Unresolved,
}

impl RespondError {
    /// Whether the floor falls away, and the object flies: what no rigid base can follow.
    pub fn is_flight(&self) -> bool {
        matches!(self, Self::Rocking(RockingError::FreeFlight { .. }))
    }
}

/// An error where a history ended before it was certain what becomes of the object.
fn resolved(outcome: Rocking) -> Result<(), RespondError> {
    if outcome == Rocking::Unresolved {
        Err(RespondError::Unresolved)
    } else {
        Ok(())
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
/// use freestand::respond::{Along, Glider, Object, Outcome, Plane, RigidPlane, Shaking, respond};
/// use freestand::{block::Block, motion::Motion, rocking::Restitution, wall::Walls};
/// use freestand::sliding::{Clearance, Friction};
/// let pulse = Motion::new(0.01, (0..100).map(|i| 4.0 * (0.0628 * f64::from(i)).sin()).collect())?;
/// let floor = Shaking { x: &pulse, y: None, vertical: None };
/// let plane = Plane { along: Along::X, block: Block::uniform(1.8, 0.6)? };
/// let still = RigidPlane { plane, restitution: Restitution::Housner, walls: Walls::NONE };
/// let friction = Friction::uniform(0.02)?;
/// let rolling = Glider { planes: vec![plane], friction, clearance: Clearance::default() };
/// let objects = [(Object::Rigid(vec![still]), floor), (Object::Rolls(rolling), floor)];
/// let found = respond(&objects);
/// assert!(matches!(found[0].as_ref()?.outcome(), Outcome::Rocked { uplift_m } if uplift_m > 0.01));
/// assert!(found[1].as_ref()?.outcome().travelled().is_some_and(|way| way.travel_m > 0.1));
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
        Object::Spatial(object, along) => pads::in_space(object, *along, shaking),
        Object::Stack(stack, along) => pads::stacked(stack, *along, shaking),
    })
}
