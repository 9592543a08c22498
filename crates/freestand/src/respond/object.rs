//! An object with one value for everything, by the way in which it is followed, and what moves it.

use crate::block::Block;
use crate::compliant::CompliantBase;
use crate::hull::shake::Contact;
use crate::hull::standing::Standing;
use crate::motion::Motion;
use crate::rocking::{Base, Restitution};
use crate::sliding::{Clearance, Friction};
use crate::spatial::{SpatialObject, Stack};
use crate::wall::Walls;

/// The accelerations of a floor.
#[derive(Debug, Clone, Copy, Default)]
pub struct Shaking<'a> {
    /// Along x.
    pub x: Option<&'a Motion>,
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
            horizontal: self.component(along),
            vertical: self.vertical,
        }
    }

    /// One of its components, for their step and length, which are the same.
    pub(super) fn any(&self) -> Option<&'a Motion> {
        self.x.or(self.y).or(self.vertical)
    }

    /// One of the horizontal components; without a second one the first is both.
    pub fn component(&self, along: Along) -> Option<&'a Motion> {
        match along {
            Along::X => self.x,
            Along::Y => self.y.or(self.x),
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

/// The planes in which an object moves, each apart: one, or both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planes<T> {
    /// The first one.
    pub one: T,
    /// The other one; `None`: the first stands for both directions.
    pub other: Option<T>,
}

impl<T> Planes<T> {
    /// A single plane.
    pub fn single(one: T) -> Self {
        Self { one, other: None }
    }

    /// The first two of these; `None`: there are none.
    pub fn of(planes: impl IntoIterator<Item = T>) -> Option<Self> {
        let mut planes = planes.into_iter();
        Some(Self {
            one: planes.next()?,
            other: planes.next(),
        })
    }

    /// Each of them.
    pub fn iter(&self) -> impl Iterator<Item = &T> + Clone {
        std::iter::once(&self.one).chain(&self.other)
    }

    /// The other one alone, if `axis` is 1 and there is one, or the first.
    pub fn about(self, axis: usize) -> Self {
        let other = self.other.filter(|_| axis == 1);
        Self::single(other.unwrap_or(self.one))
    }

    /// What `of` makes of each.
    pub(super) fn map<'a, U>(&'a self, mut of: impl FnMut(&'a T) -> U) -> Planes<U> {
        Planes {
            one: of(&self.one),
            other: self.other.as_ref().map(of),
        }
    }
}

impl<T, E> Planes<Result<T, E>> {
    /// All of them, or the first error.
    pub(super) fn all(self) -> Result<Planes<T>, E> {
        Ok(Planes {
            one: self.one?,
            other: self.other.transpose()?,
        })
    }
}

impl<T> IntoIterator for Planes<T> {
    type Item = T;
    type IntoIter = std::iter::Chain<std::iter::Once<T>, std::option::IntoIter<T>>;

    fn into_iter(self) -> Self::IntoIter {
        std::iter::once(self.one).chain(self.other)
    }
}

/// A free-standing object with one value for everything, followed in one way.
#[derive(Debug, Clone)]
pub enum Object {
    /// It rocks on a rigid base, about each of its axes apart.
    Rigid(Planes<RigidPlane>),
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
    /// It moves in three dimensions on the points of its hull, on a stiff floor.
    Hull(Box<OnHull>),
}

/// A body on the points of its hull.
#[derive(Debug, Clone)]
pub struct OnHull {
    /// The body in its pose.
    pub body: Standing,
    /// How it touches the floor.
    pub contact: Contact,
    /// How far it is turned from x to y of the floor \[rad\].
    pub yaw_rad: f64,
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

impl RigidPlane {
    /// A block that moves along x.
    pub fn along_x(block: Block, restitution: Restitution, walls: Walls) -> Self {
        let along = Along::X;
        Self {
            plane: Plane { along, block },
            restitution,
            walls,
        }
    }
}

/// An object on springs with dampers.
#[derive(Debug, Clone)]
pub struct Springs {
    /// Its planes.
    pub planes: Planes<Plane>,
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
    /// Its planes.
    pub planes: Planes<Plane>,
    /// Its mass, and what it rests on.
    pub base: CompliantBase,
}

/// An object that rolls or slides without rocking; only a stop can overturn it.
#[derive(Debug, Clone)]
pub struct Glider {
    /// Its planes.
    pub planes: Planes<Plane>,
    /// Friction of its base, or the rolling resistance of its casters.
    pub friction: Friction,
    /// The way to a stop, on both sides of every plane.
    pub clearance: Clearance,
    /// How far its first plane is turned from x towards y of the floor, where both components are known; where
    /// one is, it moves along that of its plane \[rad\].
    pub yaw_rad: f64,
}
