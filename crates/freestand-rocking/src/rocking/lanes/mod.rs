//! Many blocks under one motion: the kernel of spectra and portfolios.
//!
//! ÿ = −x²\[(1+ü_v/g) sin φ + s (ü_h/g) cos φ\], φ = α − y, x = p h, y = sθ, in units of a step h,
//! which is a sample interval or a part of it. Blocks that move stand in lanes, sixteen abreast
//! (`ranks`), and take a step together (`tile`): one Taylor series each (`degree` has what is
//! compiled for each of its degrees and each vector unit; all else is compiled once), with sine and
//! cosine carried by the series (`series`, `vector`). Bounds of its terms tell which lanes are sure
//! to have no event; the others go to a batch (`batch`), where landings and maxima are roots of the
//! series, and from there to rest, to short flights and the last impacts (`chatter`) or back into
//! their lanes (`tile/events`). A block at rest costs nothing until the sample that lifts it, found
//! from maxima over spans of the motion (`shaking`, `tile/waiting`). Behind the record what is left
//! follows from energy (`quiet`).
//!
//! Every operation of a lane is its own: no result depends on a neighbour. What is fused is written so (`vector`).

mod batch;
mod chatter;
mod degree;
mod quiet;
mod ranks;
mod series;
mod shaking;
mod tile;
mod unroll;

use rayon::prelude::*;

use super::{
    Accuracy, Base, Outcome, Restitution, RockingError, RockingModel, RockingOptions, RockingSummary, SideExtremes,
    StopReason, Until, rock,
};
use crate::block::{Block, Pivot};
use degree::DEGREES;
use series::{INVERSE, TERMS};
use shaking::Shaking;
use tile::{EdgeTerms, Record, Rocker, State, Tile};

/// Most blocks of a tile: enough of them have an event in the same step to fill a vector with, and all fit the cache.
const TILE: usize = 4096;

/// Blocks below which a tile is not divided among threads.
const SMALL_TILE: usize = 128;

/// Follows many blocks through the motion of their base: [`rock`] without the histories, in the order of the blocks, on the
/// current rayon pool.
///
/// A result does not depend on the other blocks, their order, the number of threads or the processor's vector units. Blocks
/// that the kernel is not made for are followed by [`rock`] one by one: linearised ones, with an initial state or a fixed
/// end ([`Until::Time`]), a base that falls away, a restitution above 0.9997, steps that are long for the block (more than 64
/// parts of one would be needed), a wait for rest of less than two steps.
///
/// # Reference
/// Housner (1963), as [`rock`]. Each step is a Taylor series of the exact equation whose degree follows the accuracy.
///
/// # Accuracy
/// [`Accuracy`] has what was measured. The number of impacts can be off where the speed after one is within rounding of
/// [`REST_OMEGA_RAD_S`](super::REST_OMEGA_RAD_S), and where the motion amplifies errors that much.
///
/// # Errors
/// Each block has its own, as [`rock`].
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
pub fn rock_many(blocks: &[Block], base: Base, options: &RockingOptions) -> Vec<Result<RockingSummary, RockingError>> {
    rock_many_on(pulp::Arch::new(), blocks, base, options)
}

/// [`rock_many`] on a chosen generation of vector units, for tests and benchmarks: the results are the same bits on all.
#[doc(hidden)]
pub fn rock_many_on(
    arch: pulp::Arch,
    blocks: &[Block],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    follow(arch, blocks, &vec![options.restitution; blocks.len()], base, options)
}

/// [`rock_many`] with a restitution for each block, in place of that of `options`: a portfolio, or draws of one object.
///
/// # Errors
/// As [`rock_many`].
///
/// # Example
/// ```
/// use freestand_rocking::rocking::{Base, Restitution, RockingOptions, Until, rock_each};
/// use freestand_rocking::{block::Block, motion::Motion};
/// let push = Motion::new(0.01, vec![4.0; 8])?;
/// let block = Block::uniform(2.0, 0.3)?;
/// let objects = [(block, Restitution::Value(0.5)), (block, Restitution::Value(0.9))];
/// let base = Base { horizontal: Some(&push), vertical: None };
/// let until_rest = RockingOptions { until: Until::Settled { at_most_s: 60.0 }, ..RockingOptions::default() };
/// let found = rock_each(&objects, base, &until_rest);
/// assert!(found[0].clone()?.impact_count < found[1].clone()?.impact_count);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rock_each(
    objects: &[(Block, Restitution)],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    let (blocks, restitutions): (Vec<Block>, Vec<Restitution>) = objects.iter().copied().unzip();
    follow(pulp::Arch::new(), &blocks, &restitutions, base, options)
}

fn follow(
    arch: pulp::Arch,
    blocks: &[Block],
    restitutions: &[Restitution],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    let own = |index: usize| RockingOptions { restitution: restitutions[index], ..*options };
    let scalar = |index: usize| rock(&blocks[index], base, &own(index)).map(|rocking| RockingSummary::from(&rocking));
    let Some((shaking, wait)) = prepare(base, options) else {
        return (0..blocks.len()).into_par_iter().map(scalar).collect();
    };
    let plans: Vec<Option<(Plan, Rocker)>> =
        blocks.par_iter().enumerate().map(|(index, block)| plan(block, &shaking, &own(index))).collect();
    let of_plan = |(block, planned): (usize, &Option<(Plan, Rocker)>)| planned.map(|(plan, _)| (plan, block));
    let mut order: Vec<(Plan, usize)> = plans.iter().enumerate().filter_map(of_plan).collect();
    order.sort_unstable();
    let tiles: Vec<Vec<(Plan, usize)>> = order.chunk_by(|(a, _), (b, _)| a == b).flat_map(tiles).collect();
    let done: Vec<Vec<Record>> = tiles
        .par_iter()
        // A tile is enough for a job: a thread that is done takes the next one.
        .with_max_len(1)
        .map(|tile| {
            let plan = tile[0].0;
            // A block of a tile has a plan.
            let rockers: Vec<Rocker> =
                tile.iter().filter_map(|(_, block)| plans[*block].map(|(_, rocker)| rocker)).collect();
            let mut tile = Tile::new(arch, DEGREES[plan.degree], &shaking, &rockers, plan.parts);
            tile.run(wait);
            tile.records
        })
        .collect();
    let mut records = vec![Record::default(); blocks.len()];
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
            Some((plan, _)) if record.state != State::GivenUp => {
                Ok(summary(block, &record, shaking.dt_s / plan.parts as f64, wait.is_some()))
            }
            _ => scalar(index),
        })
        .collect()
}

/// Blocks of one plan, dealt out like cards: neighbours on a grid take about as long, and every tile gets some of each.
fn tiles(group: &[(Plan, usize)]) -> Vec<Vec<(Plan, usize)>> {
    let threads = rayon::current_num_threads();
    let even = group.len().div_ceil(TILE).next_multiple_of(threads);
    let count = even.min(group.len().div_ceil(SMALL_TILE));
    (0..count).map(|first| group.iter().skip(first).step_by(count).copied().collect()).collect()
}

/// The motion for the kernel, and how many intervals it waits behind it for a block to rest; `None`: the scalar solver has
/// to do it, or to say what is wrong.
fn prepare(base: Base, options: &RockingOptions) -> Option<(Shaking, Option<usize>)> {
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
    if !(options.gravity_m_s2 > 0.0 && options.gravity_m_s2.is_finite() && options.accuracy.is_valid()) {
        return None;
    }
    let shaking = Shaking::new(base, options.gravity_m_s2, wait_s.is_some())?;
    let Some(wait_s) = wait_s else { return Some((shaking, None)) };
    // One interval is the base's way to rest; of the last one only whole ones are followed here.
    let wait = (wait_s / shaking.dt_s - 1.0).floor();
    (1.0..1e9).contains(&wait).then_some((shaking, Some(wait as usize)))
}

/// Degree of the series, by its place in [`DEGREES`], and steps of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Plan {
    degree: usize,
    parts: usize,
}

/// Steps of an interval beyond which a block is followed by itself.
const MOST_PARTS: usize = 64;

/// Restitution above which the scalar solver may call a block one that rocks for ever: more than 1e5 impacts to rest, which
/// takes more than 1e-9 e³⁰ = 1e4 rad/s at this ratio.
const MOST_ELASTIC: f64 = 0.9997;

/// `None`: the scalar solver has to follow the block, or to say what is wrong.
fn plan(block: &Block, shaking: &Shaking, options: &RockingOptions) -> Option<(Plan, Rocker)> {
    let restitution = options.restitution.ratios(block).ok()?;
    if restitution.iter().any(|r| *r > MOST_ELASTIC) {
        return None;
    }
    let right = block.right_pivot();
    // Alike, unless the centre of gravity is off the middle.
    let left = if block.cg_from_left_m() == block.cg_from_right_m() { right } else { block.pivot() };
    let x = |pivot: Pivot| pivot.frequency_parameter_rad_s(options.gravity_m_s2) * shaking.dt_s;
    let fastest = x(right).max(x(left));
    let plan = steps(fastest * fastest, shaking, options.accuracy)?;
    let edge = |pivot: Pivot, from_edge_m: f64| {
        let x = x(pivot) / plan.parts as f64;
        let (alpha, x2) = (pivot.slenderness_angle_rad, x * x);
        let threshold = from_edge_m / block.cg_height_m();
        let b = x2 * block.cg_height_m() / pivot.half_diagonal_m;
        EdgeTerms { alpha, x2, threshold, b }
    };
    let edges = [edge(right, block.cg_from_right_m()), edge(left, block.cg_from_left_m())];
    Some((plan, Rocker { edges, restitution }))
}

/// Largest first term left out, relative to the acceleration. A rotation is a sum of accelerations of hundreds of steps,
/// whose errors mostly cancel: 300 times the truncation error of a step as [`rock`] counts it, relative to the rotation, comes
/// to what [`Accuracy`] says.
fn tolerance(accuracy: Accuracy) -> f64 {
    let tolerance = accuracy.tolerance();
    if tolerance <= Accuracy::Tight.tolerance() { 3e-15 } else { 300.0 * tolerance }
}

/// The cheapest series and number of steps of an interval whose first term left out stays below the tolerance.
fn steps(x2: f64, shaking: &Shaking, accuracy: Accuracy) -> Option<Plan> {
    let tolerance = tolerance(accuracy);
    let mut best: Option<(f64, Plan)> = None;
    for parts in 1..=MOST_PARTS {
        if best.is_some_and(|(least, _)| least <= cost(DEGREES[0].degree, parts)) {
            break;
        }
        let c = terms(x2, shaking, parts);
        // c₂ is half of the largest acceleration.
        let Some(degree) = DEGREES.iter().position(|d| c[d.degree + 1] <= 2.0 * c[2] * tolerance) else { continue };
        let cost = cost(DEGREES[degree].degree, parts);
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, Plan { degree, parts }));
        }
    }
    best.map(|(_, plan)| plan)
}

/// Operations of an interval: those that form sums of products grow like the square of the degree.
fn cost(degree: usize, parts: usize) -> f64 {
    parts as f64 * (35.0 + (degree * degree) as f64)
}

/// Sizes of the terms of a step, as of a linear equation: with |φ| ≤ 1 and a velocity of x√A,
/// cₙ₊₂ = x²(A cₙ + U cₙ₋₁)/((n+1)(n+2)) with the largest acceleration A and its largest change U over a step. An estimate, which the errors that come of it justify
/// (`tests/agreement.rs`): products of sines and velocities can add to the higher terms.
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

/// What a block did, from its record in steps of `step_s`.
fn summary(block: &Block, record: &Record, step_s: f64, settle: bool) -> RockingSummary {
    let over = if settle { StopReason::Settled } else { StopReason::EndOfMotion };
    let (outcome, stop) = match record.state {
        State::Untouched => (Outcome::NoUplift, over),
        State::Overturned => (Outcome::Overturned, StopReason::Overturned),
        State::AtRest | State::Moving | State::GivenUp => (Outcome::Rocked, over),
    };
    let sides = record
        .sides
        .map(|side| SideExtremes { peak_rotation_rad: side.height, impact_omega_rad_s: side.speed / step_s });
    let peak_rotation_rad = sides[0].peak_rotation_rad.max(sides[1].peak_rotation_rad);
    // Nothing to work out, and no pivots to find, for most blocks of many grids.
    let cg_rise_m = if outcome == Outcome::NoUplift {
        0.0
    } else {
        let rise_m = |pivot: Pivot, side: SideExtremes| pivot.largest_rise_m(side.peak_rotation_rad);
        rise_m(block.right_pivot(), sides[0]).max(rise_m(block.pivot(), sides[1]))
    };
    RockingSummary {
        outcome,
        stop,
        peak_rotation_rad,
        sides,
        impact_count: record.impact_count,
        uplift_m: block.base_width_m() * peak_rotation_rad.sin(),
        cg_rise_m,
    }
}

#[cfg(test)]
mod tests;
