//! The wall of an object in a world: on which side it stands, and how it throws the object back.

use rand::RngExt;

use crate::wall::DEFAULT_WALL_RESTITUTION_RATIO;

use super::streams::{Group, object_stream};

/// A wall in one world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallDraw {
    /// Whether it stands where θ < 0: this is the sign of the floor motion against it.
    pub is_on_left: bool,
    /// e_w, uniform from 0 to [`DEFAULT_WALL_RESTITUTION_RATIO`], the most that a passive wall
    /// returns.
    pub restitution_ratio: f64,
}

/// The wall of an object in a world. `repetition` is that of the restitution alone: the side stays
/// as it is.
///
/// # Example
/// ```
/// use freestand::worlds::wall_draw;
/// let (first, again) = (wall_draw(1, 7, 99, 0), wall_draw(1, 7, 99, 1));
/// assert_eq!(first.is_on_left, again.is_on_left);
/// assert_ne!(first.restitution_ratio, again.restitution_ratio);
/// ```
pub fn wall_draw(seed: u64, world: u32, object: u64, repetition: u32) -> WallDraw {
    let stream = |repetition: u32| object_stream(seed, world, object, Group::Wall, repetition);
    let is_on_left = stream(0).random::<bool>();
    let mut random = stream(repetition);
    let _side: bool = random.random();
    WallDraw {
        is_on_left,
        restitution_ratio: wall_restitution_at(random.random()),
    }
}

/// The restitution of a wall which a share of all walls stays below.
pub fn wall_restitution_at(share: f64) -> f64 {
    DEFAULT_WALL_RESTITUTION_RATIO * share
}
