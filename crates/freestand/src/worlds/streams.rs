//! Random numbers of worlds, keyed by what they are for.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use crate::fragility::draw_stream;

/// The source of the random numbers of worlds, as named in outputs.
pub const WORLD_GENERATOR: &str = "ChaCha8Rng (rand_chacha 0.10), 256-bit key of four 64-bit numbers: seed, object \
                                   (0 where all share it), world, group + 2^8 * repetition + 2^40 * (1 for an \
                                   object) + 2^41 * (draws that were refused) + 2^63; StandardNormal (rand_distr \
                                   0.6)";

/// What a draw is for. Each group has its own random numbers, so drawing one again leaves all
/// others as they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::VariantArray)]
pub enum Group {
    /// The spectra of the components of the ground motion.
    Motion,
    /// Periods and damping of the building.
    Building,
    /// Which side of an object lies along x.
    Orientation,
    /// The restitution of the rocking object.
    Restitution,
    /// Stiffness and damping of its pads.
    Pad,
    /// Its geometry and mass.
    Body,
    /// The error of the models.
    Model,
    /// The side of its wall, the restitution there and the cushion of it.
    Wall,
    /// The friction under it.
    Friction,
    /// The velocity pulse of the ground motion.
    Pulse,
    /// The capacity of a restraint.
    Restraint,
}

impl Group {
    /// Part of the key: a number once given stays.
    fn code(self) -> u64 {
        match self {
            Self::Motion => 1,
            Self::Building => 2,
            Self::Orientation => 3,
            Self::Restitution => 4,
            Self::Pad => 5,
            Self::Body => 6,
            Self::Model => 7,
            Self::Wall => 8,
            Self::Friction => 9,
            Self::Pulse => 10,
            Self::Restraint => 11,
        }
    }
}

/// Marks the keys of worlds among those of [`draw_stream`].
const OF_WORLDS: u64 = 1 << 63;
/// Marks the keys of an object: those of object 0 are not the shared ones.
const OF_OBJECT: u64 = 1 << 40;
/// The bits above that mark count the draws that were refused.
const REFUSED_SHIFT: u32 = 41;

fn purpose(group: Group, repetition: u32) -> u64 {
    OF_WORLDS | u64::from(repetition) << 8 | group.code()
}

/// The random numbers of a group that all objects of a world share. `repetition` is 0 in the world
/// itself, and 1 or more where the group is drawn again.
///
/// The key is that of [`draw_stream`], with (seed, 0, world, purpose): two keys that differ in any
/// bit give independent streams, and nothing else affects them.
///
/// # Example
/// ```
/// use freestand::fragility::lognormal_draw;
/// use freestand::worlds::{Group, world_stream};
/// let period = |world| lognormal_draw(&mut world_stream(1, world, Group::Building, 0), 1.0, 0.2);
/// assert_eq!(period(7), period(7));
/// assert_ne!(period(7), period(8));
/// ```
pub fn world_stream(seed: u64, world: u32, group: Group, repetition: u32) -> ChaCha8Rng {
    redrawn_stream(seed, world, group, repetition, 0)
}

/// The random numbers of a group of one object in a world; `object` is a number that depends on the
/// object's name alone, not on its place in a list.
pub fn object_stream(
    seed: u64,
    world: u32,
    object: u64,
    group: Group,
    repetition: u32,
) -> ChaCha8Rng {
    draw_stream(
        seed,
        object,
        u64::from(world),
        OF_OBJECT | purpose(group, repetition),
    )
}

/// As [`world_stream`], after `refused` draws of this group that were not accepted.
pub(super) fn redrawn_stream(
    seed: u64,
    world: u32,
    group: Group,
    repetition: u32,
    refused: u16,
) -> ChaCha8Rng {
    let purpose = purpose(group, repetition) | u64::from(refused) << REFUSED_SHIFT;
    draw_stream(seed, 0, u64::from(world), purpose)
}

/// A place from 0 to `count` − 1, each with the same chance to within count/2⁶⁴; 0 where there is
/// none.
pub fn place_among(random: &mut ChaCha8Rng, count: usize) -> usize {
    let place = (u128::from(random.next_u64()) * count as u128) >> 64;
    usize::try_from(place).unwrap_or(0)
}
