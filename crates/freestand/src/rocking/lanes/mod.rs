//! Many blocks under one motion: the kernel of spectra and portfolios.

mod math;
mod series;
mod unroll;
mod shaking;
#[allow(missing_docs)]
pub mod tile;

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::{
    Accuracy, Base, Outcome, RockingError, RockingModel, RockingOptions, RockingSummary, StopReason, Until, rock,
};
use crate::block::Block;
use math::Math;
use shaking::Shaking;
use tile::{EdgeTerms, Record, Rocker, State, Tile};

/// Blocks of a tile: their lanes stay in the first-level cache.
const TILE: usize = 2048;

/// Follows many blocks through the motion of their base: [`rock`], without the histories.
///
/// # Errors
/// Each block has its own, as [`rock`].
pub fn rock_many(
    blocks: &[Block],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    rock_many_on(pulp::Arch::new(), blocks, base, options)
}

fn rock_many_on(
    arch: pulp::Arch,
    blocks: &[Block],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<RockingSummary, RockingError>> {
    let scalar = |block: &Block| rock(block, base, options).map(|rocking| RockingSummary::from(&rocking));
    let Some((shaking, quiet_intervals)) = prepare(base, options) else {
        return blocks.par_iter().map(scalar).collect();
    };
    let plans: Vec<Option<(Plan, Rocker)>> = blocks.iter().map(|block| plan(block, &shaking, options)).collect();
    let mut order: Vec<u32> = (0..blocks.len() as u32).filter(|&i| plans[i as usize].is_some()).collect();
    order.sort_by_key(|&i| plans[i as usize].as_ref().map(|(plan, _)| *plan));
    let tiles: Vec<&[u32]> = order
        .chunk_by(|&i, &j| plans[i as usize].as_ref().map(|p| p.0) == plans[j as usize].as_ref().map(|p| p.0))
        .flat_map(|group| group.chunks(TILE))
        .collect();
    let linearised = options.model == RockingModel::Linearised;
    let done: Vec<Vec<Record>> = tiles
        .par_iter()
        .map(|tile| {
            let rockers: Vec<Rocker> = tile.iter().filter_map(|&i| plans[i as usize].as_ref().map(|p| p.1)).collect();
            let plan = plans[tile[0] as usize].as_ref().map_or(Plan { degree: 11, parts: 1 }, |p| p.0);
            let tile = Tile::new(&shaking, &rockers, plan.parts);
            arch.dispatch(Run { tile, degree: plan.degree, linearised, quiet_intervals })
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
            Some(record) if record.state != State::GivenUp => Ok(summary(block, &record, quiet_intervals > 0)),
            _ => scalar(block),
        })
        .collect()
}

/// The motion for the kernel, and how many intervals of rest follow it; `None`: the scalar solver has to do it.
fn prepare(base: Base, options: &RockingOptions) -> Option<(Shaking, usize)> {
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
    if !(options.gravity_m_s2 > 0.0 && options.gravity_m_s2.is_finite()) {
        return None;
    }
    let shaking = Shaking::new(base, options.gravity_m_s2, wait_s.is_some())?;
    let quiet = wait_s.map_or(0.0, |wait_s| (wait_s / shaking.dt_s - 1.0).floor());
    (quiet >= 0.0 && quiet < 1e9).then_some((shaking, quiet as usize))
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

fn plan(block: &Block, shaking: &Shaking, options: &RockingOptions) -> Option<(Plan, Rocker)> {
    let restitution = options.restitution.ratios(block).ok()?;
    if restitution.iter().any(|r| *r > 0.9999) {
        return None;
    }
    let pivots = [block.right_pivot(), block.pivot()];
    let from_edge = [block.cg_from_right_m(), block.cg_from_left_m()];
    let p = pivots.map(|pivot| pivot.frequency_parameter_rad_s(options.gravity_m_s2));
    let step = p[0].max(p[1]) * shaking.dt_s * shaking.largest.sqrt();
    let plan = steps(step, options.accuracy)?;
    let h = shaking.dt_s / plan.parts as f64;
    let mut edges = [EdgeTerms { a: 0.0, b: 0.0, a_of_d: 0.0, threshold: 0.0, alpha: 0.0 }; 2];
    for (i, terms) in edges.iter_mut().enumerate() {
        let f = (p[i] * h) * (p[i] * h);
        let pivot = pivots[i];
        let alpha = pivot.slenderness_angle_rad;
        *terms = if options.model == RockingModel::Linearised {
            EdgeTerms { a: f * alpha, b: f, a_of_d: 0.0, threshold: alpha, alpha }
        } else {
            let a = f * from_edge[i] / pivot.half_diagonal_m;
            let threshold = from_edge[i] / block.cg_height_m();
            EdgeTerms { a, b: f * block.cg_height_m() / pivot.half_diagonal_m, a_of_d: a, threshold, alpha }
        };
    }
    Some((plan, Rocker { edges, restitution }))
}

/// Part of the tolerance.
const SHARE: f64 = 1000.0;

/// The cheapest series and number of steps at which the first term left out, xⁿ⁺¹/(n+1)!, stays below the tolerance.
fn steps(step: f64, accuracy: Accuracy) -> Option<Plan> {
    let tolerance = accuracy.tolerance();
    let mut best: Option<(f64, Plan)> = None;
    for degree in DEGREES {
        let factorial: f64 = (4..=degree + 1).map(|n| n as f64).product();
        let power = 2 * ((degree - 2) / 2);
        let longest = (tolerance * SHARE * factorial).powf(1.0 / power as f64);
        let parts = (step / longest).ceil().max(1.0);
        // Operations of a step: half of them are sums of products, whose number grows like the square of the degree.
        let cost = parts * (35.0 + (degree * degree) as f64);
        if parts <= MOST_PARTS as f64 && best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, Plan { degree, parts: parts as usize }));
        }
    }
    best.map(|(_, plan)| plan)
}

struct Run<'a> {
    tile: Tile<'a>,
    degree: usize,
    linearised: bool,
    quiet_intervals: usize,
}

impl WithSimd for Run<'_> {
    type Output = Vec<Record>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Record> {
        let (m, quiet) = (Math(simd), self.quiet_intervals);
        match (self.linearised, self.degree) {
            (true, _) => self.tile.run::<S, 11, true>(m, quiet),
            (_, 5) => self.tile.run::<S, 5, false>(m, quiet),
            (_, 6) => self.tile.run::<S, 6, false>(m, quiet),
            (_, 7) => self.tile.run::<S, 7, false>(m, quiet),
            (_, 8) => self.tile.run::<S, 8, false>(m, quiet),
            _ => self.tile.run::<S, 11, false>(m, quiet),
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
