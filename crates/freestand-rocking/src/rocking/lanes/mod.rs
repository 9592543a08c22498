//! Many blocks under one motion: the kernel for spectra and inventories.
//!
//! ÿ = −x²\[(1+ü_v/g) sin φ + s (ü_h/g) cos φ\], φ = α − y, x = p h, y = sθ, in units of a step h,
//! which is a sample interval or a part of it. Moving blocks occupy lanes, sixteen side by side
//! (`ranks`), and take each step together (`tile`). Each has its own Taylor series, with series of
//! the sine and the cosine (`series`, `vector`); `degree` contains the code that is compiled for each
//! degree of the series and each vector unit, `flights` and the maxima of `shaking` for each vector unit, and all other code once. Bounds on the
//! terms of a series show which lanes certainly have no event in the step. The other lanes are
//! copied to a batch (`batch`), where landings and maxima are roots of the series, and where a block
//! goes on from an impact to the end of the step if nothing else happens in it. Otherwise it comes to
//! rest, makes short flights (`flights`) and its last impacts (`chatter`), or is taken to its next event
//! (`tile/events`). A block at rest costs nothing until the sample that lifts it, which is
//! found from maxima over spans of the motion (`shaking`, `tile/waiting`). After the motion the
//! rest of the response follows from the conservation of energy (`quiet`).
//!
//! Each lane is calculated on its own: no result depends on a neighbour. Multiplications and
//! additions are fused only where the code says so (`vector`).

mod batch;
mod chatter;
mod degree;
mod flights;
mod quiet;
mod ranks;
mod record;
mod rocker;
mod series;
mod shaking;
mod tile;
mod unroll;

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;

use super::{
    Accuracy, Base, Outcome, Restitution, RockingError, RockingModel, RockingOptions,
    RockingSummary, SideExtremes, StopReason, Until, rock, settling_steps,
};
use crate::block::{Block, Pivot};
use crate::wall::{Contact, Walls};
use degree::DEGREES;
use ranks::SIDES;
use record::{Record, State, WallRecord};
use rocker::{EdgeTerms, Rocker};
use series::{INVERSE, TERMS};
use shaking::Shaking;
use tile::Tile;

/// Largest number of blocks in a tile: enough of them have an event in the same step to fill a
/// vector, and all of them fit in the cache.
const TILE: usize = 4096;

/// A tile with fewer blocks than this is not divided among threads.
const SMALL_TILE: usize = 128;

/// The responses of many blocks to one motion of the base: [`rock`] without the histories. Results
/// are in the order of the blocks; the calculation runs on the current rayon pool.
///
/// A result does not depend on the other blocks, their order, the number of threads or the
/// processor's vector units. Cases that the kernel does not cover are calculated by [`rock`], block
/// by block: the linearised equation, an initial rotation or velocity, a fixed end
/// ([`Until::Time`]), a base that falls away, a restitution of the floor or a wall above 0.9997, a time step so long for
/// the block that it would have to be divided into more than 64 parts, a wait for rest of less
/// than two steps, and a block that may still fall at the end of the wait.
///
/// # Reference
/// Housner (1963), as for [`rock`]. Each step is a Taylor series of the exact equation, with a
/// degree that follows from the accuracy.
///
/// # Accuracy
/// [`Accuracy`] lists the measured errors. The number of impacts can be wrong where the speed after
/// one equals [`REST_OMEGA_RAD_S`](super::REST_OMEGA_RAD_S) to within rounding, and where the
/// motion amplifies errors strongly enough.
///
/// # Errors
/// Those of [`rock`], separately for each block.
///
/// # Example
/// ```
/// use freestand_rocking::{block::Block, motion::Motion, rocking::{Base, Outcome, RockingOptions, rock_many}};
/// let pulse = Motion::new(0.01, (0..100).map(|i| 4.0 * (0.0628 * f64::from(i)).sin()).collect())?;
/// let blocks = [Block::uniform(2.0, 0.3)?, Block::uniform(1.0, 0.9)?];
/// let base = Base { horizontal: Some(&pulse), vertical: None };
/// let found = rock_many(&blocks, base, &RockingOptions::default());
/// // 4 m/s² lift a block whose thickness is less than 0.41 of its height.
/// assert_ne!(found[0]?.outcome, Outcome::NoUplift);
/// assert_eq!(found[1]?.outcome, Outcome::NoUplift);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rock_many(
    blocks: &[Block],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    rock_many_on(pulp::Arch::new(), blocks, base, options)
}

/// [`rock_many`] on a chosen generation of vector units, for tests and benchmarks: the results are
/// identical to the bit on all of them.
#[doc(hidden)]
pub fn rock_many_on(
    arch: pulp::Arch,
    blocks: &[Block],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    let own = vec![(options.restitution, options.walls); blocks.len()];
    follow(arch, blocks, &own, base, options)
}

/// [`rock_many`] with a restitution and walls for each block, in place of those of `options`: for an
/// inventory, or for draws of one object.
///
/// # Errors
/// Those of [`rock_many`].
///
/// # Example
/// A wall that it touches keeps the block from tilting towards it; without one, it still moves at the end
/// of the push.
/// ```
/// use freestand_rocking::rocking::{Base, Outcome, Restitution, RockingOptions, rock_between};
/// use freestand_rocking::{block::Block, motion::Motion, wall::{Wall, Walls}};
/// let push = Motion::new(0.01, vec![4.0; 80])?;
/// let block = Block::uniform(2.0, 0.3)?;
/// let behind = Walls { left: Some(Wall::at(0.0)), ..Walls::NONE };
/// let objects = [(block, Restitution::Housner, Walls::NONE), (block, Restitution::Housner, behind)];
/// let base = Base { horizontal: Some(&push), vertical: None };
/// let found = rock_between(&objects, base, &RockingOptions::default());
/// assert_eq!(found[0].clone()?.outcome, Outcome::Unresolved);
/// assert_eq!(found[1].clone()?.outcome, Outcome::NoUplift);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rock_between(
    objects: &[(Block, Restitution, Walls)],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    let own =
        |&(block, restitution, walls): &(Block, Restitution, Walls)| (block, (restitution, walls));
    let (blocks, own): (Vec<Block>, Vec<Own>) = objects.iter().map(own).unzip();
    follow(pulp::Arch::new(), &blocks, &own, base, options)
}

/// What each block has of its own.
type Own = (Restitution, Walls);

fn follow(
    arch: pulp::Arch,
    blocks: &[Block],
    own: &[Own],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    let own = |index: usize| {
        let (restitution, walls) = own[index];
        RockingOptions {
            restitution,
            walls,
            ..*options
        }
    };
    let scalar = |index: usize| {
        rock(&blocks[index], base, &own(index)).map(|rocking| RockingSummary::from(&rocking))
    };
    let Some((shaking, wait)) = prepare(base, options) else {
        return (0..blocks.len()).into_par_iter().map(scalar).collect();
    };
    let plans: Vec<Option<(Plan, Rocker, WallRecord)>> = blocks
        .par_iter()
        .enumerate()
        .map(|(index, block)| plan(block, &shaking, &own(index)))
        .collect();
    let of_plan = |(block, planned): (usize, &Option<(Plan, Rocker, WallRecord)>)| {
        planned.map(|(plan, ..)| (plan, block))
    };
    let mut order: Vec<(Plan, usize)> = plans.iter().enumerate().filter_map(of_plan).collect();
    order.sort_unstable();
    let tiles: Vec<Vec<(Plan, usize)>> = order
        .chunk_by(|(a, _), (b, _)| a == b)
        .flat_map(tiles)
        .collect();
    let done: Vec<Vec<(Record, WallRecord)>> = tiles
        .par_iter()
        // One tile per job: a thread that has finished one takes the next.
        .with_max_len(1)
        .map(|tile| {
            let plan = tile[0].0;
            // A block of a tile has a plan.
            let (rockers, walls): (Vec<Rocker>, Vec<WallRecord>) = tile
                .iter()
                .filter_map(|(_, block)| plans[*block].map(|(_, rocker, walls)| (rocker, walls)))
                .unzip();
            let mut tile = Tile::new(
                arch,
                DEGREES[plan.degree],
                &shaking,
                &rockers,
                walls,
                plan.parts,
            );
            tile.run(wait);
            tile.records.into_iter().zip(tile.walls).collect()
        })
        .collect();
    let mut records = vec![(Record::default(), WallRecord::default()); blocks.len()];
    for (tile, done) in tiles.iter().zip(done) {
        for ((_, block), record) in tile.iter().zip(done) {
            records[*block] = record;
        }
    }
    blocks
        .par_iter()
        .enumerate()
        .zip(records)
        .zip(&plans)
        .map(|(((index, block), record), plan)| match plan {
            Some((plan, rocker, _)) if record.0.state != State::GivenUp => Ok(summary(
                block,
                rocker,
                &record,
                shaking.dt_s / plan.parts as f64,
                wait.is_some(),
            )),
            _ => scalar(index),
        })
        .collect()
}

/// Distributes the blocks of one plan over tiles in turn: neighbours on a grid take about equally
/// long, so every tile gets some fast and some slow blocks.
fn tiles(group: &[(Plan, usize)]) -> Vec<Vec<(Plan, usize)>> {
    let threads = rayon::current_num_threads();
    let even = group.len().div_ceil(TILE).next_multiple_of(threads);
    let count = even.min(group.len().div_ceil(SMALL_TILE));
    (0..count)
        .map(|first| group.iter().skip(first).step_by(count).copied().collect())
        .collect()
}

/// The motion for the kernel, and the number of intervals after it in which a block may come to
/// rest. `None`: the scalar solver calculates the responses or reports the error.
fn prepare<'a>(base: Base<'a>, options: &RockingOptions) -> Option<(Shaking<'a>, Option<usize>)> {
    if options.model == RockingModel::Linearised
        || options.initial_rotation_rad != 0.0
        || options.initial_omega_rad_s != 0.0
    {
        return None;
    }
    let wait_s = match options.until {
        Until::EndOfMotion => None,
        Until::Settled { at_most_s } => Some(at_most_s),
        Until::Time(_) => return None,
    };
    if let (Some(h), Some(v)) = (base.horizontal, base.vertical)
        && (h.dt_s() != v.dt_s() || h.accel_m_s2().len() != v.accel_m_s2().len())
    {
        return None;
    }
    if !(options.gravity_m_s2 > 0.0
        && options.gravity_m_s2.is_finite()
        && options.accuracy.is_valid())
    {
        return None;
    }
    let shaking = Shaking::new(base, options.gravity_m_s2, wait_s.is_some())?;
    let Some(wait_s) = wait_s else {
        return Some((shaking, None));
    };
    // The base comes to rest in the first interval.
    let wait = settling_steps(wait_s, shaking.dt_s) - 1.0;
    (1.0..1e9)
        .contains(&wait)
        .then_some((shaking, Some(wait as usize)))
}

/// Degree of the series, as an index into [`DEGREES`], and number of steps in an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Plan {
    degree: usize,
    parts: usize,
}

/// Largest number of steps in an interval; a block that needs more is left to the scalar solver.
const MOST_PARTS: usize = 64;

/// Restitution above which the scalar solver may decide that a block rocks for ever, because it
/// needs more than 1e5 impacts to come to rest; at this ratio that takes more than
/// 1e-9 e³⁰ = 1e4 rad/s.
const MOST_ELASTIC: f64 = 0.9997;

/// The series and the constants of a block. `None`: the scalar solver calculates the response or
/// reports the error.
fn plan(
    block: &Block,
    shaking: &Shaking,
    options: &RockingOptions,
) -> Option<(Plan, Rocker, WallRecord)> {
    let restitution = options.restitution.ratios(block).ok()?;
    if restitution.iter().any(|r| *r > MOST_ELASTIC) {
        return None;
    }
    let right = block.right_pivot();
    // Both edges are alike, unless the centre of gravity is off the middle.
    let left = if block.cg_from_left_m() == block.cg_from_right_m() {
        right
    } else {
        block.pivot()
    };
    let x = |pivot: Pivot| pivot.frequency_parameter_rad_s(options.gravity_m_s2) * shaking.dt_s;
    let fastest = x(right).max(x(left));
    let plan = steps(fastest * fastest, shaking, options.accuracy)?;
    let contacts = options.walls.contacts(block).ok()?;
    let edge = |pivot: Pivot, from_edge_m: f64, wall: Option<Contact>| {
        let x = x(pivot) / plan.parts as f64;
        let (alpha, x2) = (pivot.slenderness_angle_rad, x * x);
        let touches = wall.is_some_and(|wall| wall.touches());
        let threshold = if touches {
            f64::INFINITY
        } else {
            from_edge_m / block.cg_height_m()
        };
        let ceiling = wall.map_or(FRAC_PI_2, |wall| wall.angle_rad);
        let b = x2 * block.cg_height_m() / pivot.half_diagonal_m;
        EdgeTerms {
            alpha,
            x2,
            threshold,
            b,
            ceiling,
        }
    };
    let edges = [
        edge(right, block.cg_from_right_m(), contacts[0]),
        edge(left, block.cg_from_left_m(), contacts[1]),
    ];
    let restitutions =
        contacts.map(|contact| contact.map_or(0.0, |contact| contact.restitution_ratio));
    // A ceiling of π/2 means that there is no wall.
    let is_extreme = |contact: Contact| {
        contact.angle_rad >= FRAC_PI_2 || contact.restitution_ratio > MOST_ELASTIC
    };
    if contacts.into_iter().flatten().any(is_extreme) {
        return None;
    }
    let walls = WallRecord {
        restitution: restitutions,
        press: [0, 1].map(|side| {
            contacts[side].map_or([0.0; 2], |contact| {
                let EdgeTerms { alpha, x2, .. } = edges[side];
                let (sin, cos) = (alpha - contact.angle_rad).sin_cos();
                [-x2 * sin, -x2 * SIDES[side] * cos]
            })
        }),
        ..WallRecord::default()
    };
    Some((plan, Rocker { edges, restitution }, walls))
}

/// Upper limit of the first omitted term, relative to the acceleration. A rotation sums the
/// accelerations of hundreds of steps, whose errors mostly cancel: 300 times the truncation error
/// of a step in [`rock`], which is relative to the rotation, results in the errors that
/// [`Accuracy`] lists.
fn tolerance(accuracy: Accuracy) -> f64 {
    let tolerance = accuracy.tolerance();
    if tolerance <= Accuracy::Tight.tolerance() {
        3e-15
    } else {
        300.0 * tolerance
    }
}

/// The cheapest combination of a series and a number of steps in an interval whose first omitted
/// term is within the tolerance.
fn steps(x2: f64, shaking: &Shaking, accuracy: Accuracy) -> Option<Plan> {
    let tolerance = tolerance(accuracy);
    let mut best: Option<(f64, Plan)> = None;
    for parts in 1..=MOST_PARTS {
        if best.is_some_and(|(least, _)| least <= cost(DEGREES[0].degree, parts)) {
            break;
        }
        let c = terms(x2, shaking, parts);
        // c₂ is half of the largest acceleration.
        let Some(degree) = DEGREES
            .iter()
            .position(|d| c[d.degree + 1] <= 2.0 * c[2] * tolerance)
        else {
            continue;
        };
        let cost = cost(DEGREES[degree].degree, parts);
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, Plan { degree, parts }));
        }
    }
    best.map(|(_, plan)| plan)
}

/// Operations in an interval, in relative terms: the sums of products grow with the square of the
/// degree.
fn cost(degree: usize, parts: usize) -> f64 {
    parts as f64 * (35.0 + (degree * degree) as f64)
}

/// Estimated sizes of the terms of a step, as if the equation were linear: with |φ| ≤ 1 and a
/// velocity of x√A, cₙ₊₂ = x²(A cₙ + U cₙ₋₁)/((n+1)(n+2)), where A is the largest acceleration and
/// U its largest change over a step. Products of sines and velocities can add to the higher terms;
/// the measured errors (`tests/agreement.rs`) show that the estimate is sufficient.
fn terms(x2: f64, shaking: &Shaking, parts: usize) -> [f64; TERMS] {
    let share = 1.0 / parts as f64;
    let x2 = x2 * (share * share);
    let (level, change) = (x2 * shaking.largest, x2 * shaking.steepest * share);
    let mut c = [0.0; TERMS];
    (c[0], c[1], c[2]) = (1.0, level.sqrt(), 0.5 * level);
    for n in 3..TERMS {
        c[n] = (level * c[n - 2] + change * c[n - 3]) * (INVERSE[n - 1] * INVERSE[n]);
    }
    c
}

/// The result of a block from its [`Record`], whose velocities refer to steps of `step_s`.
fn summary(
    block: &Block,
    rocker: &Rocker,
    (record, walls): &(Record, WallRecord),
    step_s: f64,
    settle: bool,
) -> RockingSummary {
    let over = if settle {
        StopReason::Settled
    } else {
        StopReason::EndOfMotion
    };
    let (outcome, stop) = match record.state {
        State::Bouncing
        | State::Leaning {
            past_balance: true, ..
        } => (Outcome::Leaned, over),
        State::Untouched => (Outcome::NoUplift, over),
        State::Overturned => (Outcome::Overturned, StopReason::Overturned),
        // It is followed no further than the last sample.
        State::Moving
        | State::Leaning {
            past_balance: false,
            ..
        } if !settle => (Outcome::Unresolved, over),
        State::Moving => (Outcome::Rocked, StopReason::EndOfMotion),
        State::AtRest | State::GivenUp | State::Leaning { .. } => (Outcome::Rocked, over),
    };
    let sides = [0, 1].map(|side| SideExtremes {
        // No further than the wall, whatever rounding yields.
        peak_rotation_rad: record.sides[side].height.min(rocker.edges[side].ceiling),
        impact_omega_rad_s: record.sides[side].speed / step_s,
        wall_omega_rad_s: walls.speeds[side] / step_s,
    });
    let peak_rotation_rad = sides[0].peak_rotation_rad.max(sides[1].peak_rotation_rad);
    // In many grids most blocks do not uplift, and need neither a pivot nor a calculation.
    let cg_rise_m = if outcome == Outcome::NoUplift {
        0.0
    } else {
        let rise_m =
            |pivot: Pivot, side: SideExtremes| pivot.largest_rise_m(side.peak_rotation_rad);
        rise_m(block.right_pivot(), sides[0]).max(rise_m(block.pivot(), sides[1]))
    };
    RockingSummary {
        outcome,
        stop,
        peak_rotation_rad,
        sides,
        impact_count: record.impact_count,
        wall_impact_count: walls.impact_count,
        uplift_m: block.base_width_m() * peak_rotation_rad.sin(),
        cg_rise_m,
    }
}

#[cfg(test)]
mod tests;
