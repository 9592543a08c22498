//! Many blocks under one motion: the kernel of spectra and portfolios.

mod batch;
mod chatter;
mod math;
mod quiet;
mod ranks;
mod series;
mod shaking;
mod tile;
mod unroll;

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::{
    Accuracy, Base, Outcome, RockingError, RockingModel, RockingOptions, RockingSummary, StopReason, Until, rock,
};
use crate::block::Block;
use series::TERMS;
use shaking::Shaking;
use tile::{EdgeTerms, Record, Rocker, State, Tile};

/// Most blocks of a tile: enough of them have an event in the same step to fill a vector with, and all fit the cache.
const TILE: usize = 4096;

/// Blocks below which a tile is not divided among threads.
const SMALL_TILE: usize = 128;

/// Follows many blocks through the motion of their base: [`rock`], without the histories.
///
/// # Errors
/// Each block has its own, as [`rock`].
pub fn rock_many(blocks: &[Block], base: Base, options: &RockingOptions) -> Vec<Result<RockingSummary, RockingError>> {
    rock_many_on(pulp::Arch::new(), blocks, base, options)
}

fn rock_many_on(
    arch: pulp::Arch,
    blocks: &[Block],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    let scalar = |block: &Block| rock(block, base, options).map(|rocking| RockingSummary::from(&rocking));
    let Some((shaking, wait)) = prepare(base, options) else {
        return blocks.par_iter().map(scalar).collect();
    };
    let plans: Vec<Option<(Plan, Rocker)>> = blocks.par_iter().map(|block| plan(block, &shaking, options)).collect();
    let plan_of = |block: u32| plans[block as usize].as_ref().map(|(plan, _)| *plan);
    let mut order: Vec<u32> = (0..blocks.len() as u32).filter(|&block| plan_of(block).is_some()).collect();
    order.sort_by_key(|&block| plan_of(block));
    let tiles: Vec<Vec<u32>> = order.chunk_by(|&a, &b| plan_of(a) == plan_of(b)).flat_map(tiles).collect();
    let linearised = options.model == RockingModel::Linearised;
    let done: Vec<Vec<Record>> = tiles
        .par_iter()
        .map(|tile| {
            let rockers: Vec<Rocker> = tile.iter().filter_map(|&i| plans[i as usize].as_ref().map(|p| p.1)).collect();
            let plan = plan_of(tile[0]).unwrap_or(Plan { degree: series::MAX_DEGREE, parts: 1 });
            let tile = Tile::new(&shaking, &rockers, plan.parts);
            arch.dispatch(Run { tile, degree: plan.degree, linearised, wait })
        })
        .collect();
    let mut records: Vec<Option<Record>> = vec![None; blocks.len()];
    for (tile, done) in tiles.iter().zip(done) {
        for (&i, record) in tile.iter().zip(done) {
            records[i as usize] = Some(record);
        }
    }
    blocks
        .par_iter()
        .zip(records)
        .map(|(block, record)| match record {
            Some(record) if record.state != State::GivenUp => Ok(summary(block, &record, wait.is_some())),
            _ => scalar(block),
        })
        .collect()
}

/// Blocks of one plan, dealt out like cards: neighbours on a grid take about as long, and every tile gets some of each.
fn tiles(group: &[u32]) -> Vec<Vec<u32>> {
    let least = group.len().div_ceil(TILE);
    let count = rayon::current_num_threads().min(group.len() / SMALL_TILE).max(least).max(1);
    (0..count).map(|first| group.iter().skip(first).step_by(count).copied().collect()).collect()
}

/// The motion for the kernel, and how many intervals it waits behind it for a block to rest; `None`: the scalar solver has
/// to do it, or to say what is wrong.
fn prepare(base: Base, options: &RockingOptions) -> Option<(Shaking, Option<usize>)> {
    if options.initial_rotation_rad != 0.0 || options.initial_omega_rad_s != 0.0 {
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

/// Degree of the series, and steps of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Plan {
    degree: usize,
    parts: usize,
}

/// Degrees that the kernel is compiled for.
const DEGREES: [usize; 5] = [5, 6, 7, 8, 11];

/// Steps of an interval beyond which a block is followed by itself.
const MOST_PARTS: usize = 64;

/// Restitution above which impacts may go on for ever, and the scalar solver says so.
const MOST_ELASTIC: f64 = 0.9997;

fn plan(block: &Block, shaking: &Shaking, options: &RockingOptions) -> Option<(Plan, Rocker)> {
    let restitution = options.restitution.ratios(block).ok()?;
    if restitution.iter().any(|r| *r > MOST_ELASTIC) {
        return None;
    }
    let pivots = [block.right_pivot(), block.pivot()];
    let from_edge = [block.cg_from_right_m(), block.cg_from_left_m()];
    let p = pivots.map(|pivot| pivot.frequency_parameter_rad_s(options.gravity_m_s2));
    let x = p[0].max(p[1]) * shaking.dt_s;
    let plan = steps(x * x, shaking, options.accuracy)?;
    let h = shaking.dt_s / plan.parts as f64;
    let edges = [0, 1].map(|i| {
        let f = (p[i] * h) * (p[i] * h);
        let pivot = pivots[i];
        let alpha = pivot.slenderness_angle_rad;
        if options.model == RockingModel::Linearised {
            EdgeTerms { alpha, x2: f, a: f * alpha, b: f, a_of_d: 0.0, threshold: alpha }
        } else {
            let a = f * from_edge[i] / pivot.half_diagonal_m;
            let threshold = from_edge[i] / block.cg_height_m();
            EdgeTerms { alpha, x2: f, a, b: f * block.cg_height_m() / pivot.half_diagonal_m, a_of_d: a, threshold }
        }
    });
    Some((plan, Rocker { edges, restitution }))
}

/// Largest first term left out, relative to the acceleration: what a rotation may be wrong by, which is a sum of
/// accelerations. `benches/README.md` has what is reached.
fn tolerance(accuracy: Accuracy) -> f64 {
    match accuracy {
        Accuracy::Tight => 3e-15,
        given => 300.0 * given.tolerance(),
    }
}

/// The cheapest series and number of steps of an interval whose first term left out stays below the tolerance.
fn steps(x2: f64, shaking: &Shaking, accuracy: Accuracy) -> Option<Plan> {
    let tolerance = tolerance(accuracy);
    let mut best: Option<(f64, Plan)> = None;
    for degree in DEGREES {
        let Some(parts) = (1..=MOST_PARTS).find(|&parts| left_out(x2, shaking, degree, parts) <= tolerance) else {
            continue;
        };
        // Operations of a step: half of them are sums of products, whose number grows like the square of the degree.
        let cost = parts as f64 * (35.0 + (degree * degree) as f64);
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, Plan { degree, parts }));
        }
        if parts == 1 {
            break;
        }
    }
    best.map(|(_, plan)| plan)
}

/// A bound of the term of degree K + 1 in units of that of degree 2, x² ü: with |φ| ≤ 1 and a velocity of x or less,
/// cₙ₊₂ = x²(A cₙ + U cₙ₋₁)/((n+1)(n+2)) with the largest acceleration A and its largest change U over a step.
fn left_out(x2: f64, shaking: &Shaking, degree: usize, parts: usize) -> f64 {
    let parts = parts as f64;
    let x2 = x2 / (parts * parts);
    let (level, change) = (x2 * shaking.largest, x2 * shaking.steepest / parts);
    let mut c = [0.0; TERMS + 2];
    (c[0], c[1]) = (1.0, level.sqrt());
    for n in 0..=degree - 1 {
        let before = if n > 0 { change * c[n - 1] } else { 0.0 };
        c[n + 2] = (level * c[n] + before) / ((n + 1) * (n + 2)) as f64;
    }
    c[degree + 1] / level
}

struct Run<'a> {
    tile: Tile<'a>,
    degree: usize,
    linearised: bool,
    wait: Option<usize>,
}

impl WithSimd for Run<'_> {
    type Output = Vec<Record>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Record> {
        let wait = self.wait;
        match (self.linearised, self.degree) {
            (true, _) => self.tile.run::<S, 11, true>(simd, wait),
            (_, 5) => self.tile.run::<S, 5, false>(simd, wait),
            (_, 6) => self.tile.run::<S, 6, false>(simd, wait),
            (_, 7) => self.tile.run::<S, 7, false>(simd, wait),
            (_, 8) => self.tile.run::<S, 8, false>(simd, wait),
            _ => self.tile.run::<S, 11, false>(simd, wait),
        }
    }
}

fn summary(block: &Block, record: &Record, settle: bool) -> RockingSummary {
    let (outcome, stop) = match record.state {
        State::Untouched => (Outcome::NoUplift, if settle { StopReason::Settled } else { StopReason::EndOfMotion }),
        State::Overturned => (Outcome::Overturned, StopReason::Overturned),
        _ => (Outcome::Rocked, if settle { StopReason::Settled } else { StopReason::EndOfMotion }),
    };
    let peak_rotation_rad = record.sides[0].peak_rotation_rad.max(record.sides[1].peak_rotation_rad);
    let pivots = [block.right_pivot(), block.pivot()];
    let rises = pivots.iter().zip(record.sides).map(|(pivot, side)| pivot.largest_rise_m(side.peak_rotation_rad));
    RockingSummary {
        outcome,
        stop,
        peak_rotation_rad,
        sides: record.sides,
        impact_count: record.impact_count,
        uplift_m: block.base_width_m() * peak_rotation_rad.sin(),
        cg_rise_m: rises.fold(0.0, f64::max),
    }
}

#[cfg(test)]
mod tests;
