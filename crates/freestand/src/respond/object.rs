//! An object with one value for everything, by the way in which it is followed, and what moves it.

use crate::block::Block;
use crate::compliant::CompliantBase;
use crate::motion::Motion;
use crate::rocking::{Base, Restitution};
use crate::sliding::{Clearance, Friction};
use crate::spatial::{SpatialObject, Stack};
use crate::wall::Walls;

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
