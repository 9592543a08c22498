//! The wall of an object in a world: on which side it stands, how a rigid base is thrown back from it, and its
//! cushion.

use rand::RngExt;

use crate::fragility::log_uniform_draw;
use crate::wall::DEFAULT_WALL_RESTITUTION_RATIO;

use super::streams::{Group, object_stream};

/// The stiffness of a wall over that of an edge of the object, and its damping ratio ζ_w: from plasterboard on studs to
/// masonry (assumed). Both are uniform in their logarithms.
pub const WALL_STIFFNESS_RATIO: (f64, f64) = (1.0, 5.0);
/// See [`WALL_STIFFNESS_RATIO`].
pub const WALL_DAMPING_RATIO: (f64, f64) = (0.05, 0.3);

/// A wall in one world.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WallDraw {
    /// Whether it stands where θ < 0: this is the sign of the floor motion against it.
    pub is_on_left: bool,
    /// e_w, uniform from 0 to [`DEFAULT_WALL_RESTITUTION_RATIO`], the most that a passive wall
    /// returns.
    pub restitution_ratio: f64,
    /// k_w over the stiffness of an edge of the object.
    pub stiffness_ratio: f64,
    /// ζ_w = c_w/(2√(k_w m)).
    pub damping_ratio: f64,
}

/// The wall of an object in a world. `restitution` and `cushion` are the repetitions of those two groups of values:
/// the side stays as it is.
///
/// # Example
/// ```
/// use freestand::worlds::wall_draw;
/// let (first, again) = (wall_draw(1, 7, 99, 0, 0), wall_draw(1, 7, 99, 1, 0));
/// assert_eq!(first.is_on_left, again.is_on_left);
/// assert_ne!(first.restitution_ratio, again.restitution_ratio);
/// assert_eq!(first.stiffness_ratio, again.stiffness_ratio);
/// ```
pub fn wall_draw(seed: u64, world: u32, object: u64, restitution: u32, cushion: u32) -> WallDraw {
    let stream = |repetition: u32| object_stream(seed, world, object, Group::Wall, repetition);
    let is_on_left = stream(0).random::<bool>();
    let after = |repetition: u32| {
        let mut random = stream(repetition);
        let _side: bool = random.random();
        let restitution_ratio = wall_restitution_at(random.random());
        (random, restitution_ratio)
    };
    let (_, restitution_ratio) = after(restitution);
    let (mut random, _) = after(cushion);
    let mut next = |(low, high)| log_uniform_draw(&mut random, low, high);
    WallDraw {
        is_on_left,
        restitution_ratio,
        stiffness_ratio: next(WALL_STIFFNESS_RATIO),
        damping_ratio: next(WALL_DAMPING_RATIO),
    }
}

/// The restitution of a wall which a share of all walls stays below.
pub fn wall_restitution_at(share: f64) -> f64 {
    DEFAULT_WALL_RESTITUTION_RATIO * share
}

/// The stiffness ratio of a wall which a share of all walls stays below, and the damping ratio which it stays above: a
/// larger share is stiffer and less damped, as for pads.
pub fn wall_cushion_at(share: f64) -> (f64, f64) {
    let ((soft, stiff), (least, most)) = (WALL_STIFFNESS_RATIO, WALL_DAMPING_RATIO);
    (
        soft * (stiff / soft).powf(share),
        most * (least / most).powf(share),
    )
}
