//! Tier 1: objects that the uplift spectra of their floor decide, without histories of their own.
//!
//! The rocking of a uniform block depends on its half diagonal R and its slenderness angle α alone,
//! so that a grid of both is a spectrum for all such blocks. Between the nodes rocking is not a
//! smooth function: an object is decided here only where all sixteen nodes around it are far on the
//! same side. Its reported response is that of the nearest node, scaled to its size.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::rocking::{Outcome as RockingOutcome, Restitution, RockingSummary};
use rayon::prelude::*;

use crate::floors::Floor;

use super::group::{Member, as_stated};
use super::object::{AxisGeometry, Subject};
use super::response::{AxisMotion, MotionResponse, axis_motion, demand_capacity, overturned, rock_directions};
use super::uncertainty::{Draws, Outcome};

/// Half diagonals of the grid: from, to \[m\] and count.
const SIZES: (f64, f64, usize) = (0.15, 3.5, 17);

/// tan α of the grid: from, to and count.
const SLENDERNESSES: (f64, f64, usize) = (0.05, 1.0, 31);

/// An object is restrained where every node around it overturns in at least this share of the
/// motions more than accepted.
const CLEAR_SHARE: f64 = 0.3;

/// An object is left as it is where demand/capacity of every node around it is at most this under
/// every motion.
const CLEAR_DEMAND: f64 = 0.4;

/// Floors whose grids are kept in memory: 2 MB each with 20 motions.
const MAX_GRIDS: usize = 128;

/// The grids of the floors, made at first use.
#[derive(Debug, Default)]
pub(super) struct Spectra {
    grids: Mutex<HashMap<u64, Arc<Grid>>>,
}

/// `[node][motion]`; the slenderness varies fastest.
#[derive(Debug)]
struct Grid {
    nodes: Vec<(Block, Vec<Option<RockingSummary>>)>,
}

/// What the spectra decided: responses in place of the object's own, and one draw of each motion
/// made from them.
pub(super) struct Screened {
    pub(super) as_is: Vec<MotionResponse>,
    pub(super) draws: Draws,
}

fn node(at: (f64, f64, usize), index: usize) -> f64 {
    let (from, to, count) = at;
    from * (to / from).powf(index as f64 / (count - 1) as f64)
}

/// The place of a value between the nodes; `None` without two nodes on either side.
fn place(at: (f64, f64, usize), value: f64) -> Option<(usize, f64)> {
    let (from, to, count) = at;
    let place = (value / from).ln() / (to / from).ln() * (count - 1) as f64;
    (place >= 1.0 && place < (count - 2) as f64).then(|| (place.floor() as usize, place.fract()))
}

impl Grid {
    fn new(floor: &Floor) -> Self {
        let blocks = (0..SIZES.2).flat_map(|size| {
            (0..SLENDERNESSES.2).filter_map(move |slenderness| {
                let (radius_m, tan) = (node(SIZES, size), node(SLENDERNESSES, slenderness));
                let height_m = 2.0 * radius_m / tan.hypot(1.0);
                Block::uniform(height_m, height_m * tan).ok()
            })
        });
        let blocks: Vec<(Block, Restitution)> = blocks.map(|block| (block, Restitution::Housner)).collect();
        let by_motion: Vec<Vec<Option<RockingSummary>>> = floor
            .motions
            .par_iter()
            .map(|directions| rock_directions(&blocks, directions).into_iter().map(Result::ok).collect())
            .collect();
        let of = |node: usize| by_motion.iter().map(|motion| motion[node]).collect();
        Self { nodes: blocks.iter().enumerate().map(|(node, (block, _))| (*block, of(node))).collect() }
    }

    /// The sixteen nodes around a block, the nearest first; `None` beyond the grid.
    fn around(&self, block: &Block) -> Option<Vec<usize>> {
        let pivot = block.pivot();
        let (size, size_share) = place(SIZES, pivot.half_diagonal_m)?;
        let (slender, slender_share) = place(SLENDERNESSES, pivot.slenderness_angle_rad.tan())?;
        let index = |size: usize, slender: usize| size * SLENDERNESSES.2 + slender;
        let nearest = index(size + usize::from(size_share >= 0.5), slender + usize::from(slender_share >= 0.5));
        let all =
            (size - 1..size + 3).flat_map(|size| (slender - 1..slender + 3).map(move |slender| index(size, slender)));
        Some(std::iter::once(nearest).chain(all.filter(|&one| one != nearest)).collect())
    }
}

impl Spectra {
    fn grid(&self, floor: &Floor) -> Arc<Grid> {
        let bits = floor.facts.level_ratio.to_bits();
        let held = |grids: &HashMap<u64, Arc<Grid>>| grids.get(&bits).cloned();
        if let Some(grid) = held(&self.grids.lock().unwrap_or_else(PoisonError::into_inner)) {
            return grid;
        }
        let grid = Arc::new(Grid::new(floor));
        let mut grids = self.grids.lock().unwrap_or_else(PoisonError::into_inner);
        if grids.len() >= MAX_GRIDS {
            grids.clear();
        }
        Arc::clone(grids.entry(bits).or_insert(grid))
    }

    /// What the spectra of its floor decide; `None`: the object needs histories of its own.
    pub(super) fn screen(&self, member: &Member, floor: &Floor) -> Option<Screened> {
        let subject = &member.subject;
        let is_usual = subject.restitution == Restitution::Housner && subject.axes.iter().all(AxisGeometry::is_uniform);
        if !is_usual {
            return None;
        }
        let grid = self.grid(floor);
        let around: Vec<Vec<usize>> =
            subject.axes.iter().map(|axis| grid.around(&axis.block)).collect::<Option<_>>()?;
        // The response of each of the sixteen neighbours in turn.
        let all: Vec<Vec<MotionResponse>> =
            (0..16).map(|neighbour| responses(subject, &grid, &around, neighbour, floor)).collect();
        if !(falls(member, &all) || stays(member, &all)) {
            return None;
        }
        let as_is = all.into_iter().next()?;
        let draws = as_is.iter().map(|motion| motion.iter().map(outcome).collect()).collect();
        Some(Screened { as_is, draws })
    }
}

/// The object under every motion, with the response of one neighbour about each axis.
fn responses(
    subject: &Subject,
    grid: &Grid,
    around: &[Vec<usize>],
    neighbour: usize,
    floor: &Floor,
) -> Vec<MotionResponse> {
    let motions = 0..floor.motions.len();
    motions
        .map(|motion| {
            subject
                .axes
                .iter()
                .zip(around)
                .map(|(axis, around)| {
                    let (block, motions) = &grid.nodes[around[neighbour]];
                    let node = motions[motion].ok_or_else(|| "the history of a node failed".to_owned())?;
                    let values = subject.body.as_ref().map(as_stated);
                    axis_motion(subject, &axis.block, scaled(&node, block, &axis.block), values, floor.pfa_m_s2[motion])
                })
                .collect()
        })
        .collect()
}

/// A history of one block scaled to another: the same rotation over α, the same angular velocity
/// over p α.
fn scaled(of: &RockingSummary, node: &Block, block: &Block) -> RockingSummary {
    if of.outcome != RockingOutcome::Rocked {
        let uplift_m = if of.outcome == RockingOutcome::Overturned { block.base_width_m() } else { 0.0 };
        return RockingSummary { uplift_m, ..*of };
    }
    let (from, to) = (node.pivot(), block.pivot());
    let turn = to.slenderness_angle_rad / from.slenderness_angle_rad;
    let speed = turn * to.frequency_parameter_rad_s(G0_M_S2) / from.frequency_parameter_rad_s(G0_M_S2);
    let mut scaled = *of;
    scaled.peak_rotation_rad *= turn;
    for side in &mut scaled.sides {
        side.peak_rotation_rad *= turn;
        side.impact_omega_rad_s *= speed;
    }
    scaled.uplift_m = block.base_width_m() * scaled.peak_rotation_rad.sin();
    scaled.cg_rise_m = to.largest_rise_m(scaled.peak_rotation_rad);
    scaled
}

fn falls(member: &Member, all: &[Vec<MotionResponse>]) -> bool {
    all.iter().all(|motions| {
        let fallen = motions.iter().filter(|motion| motion.as_ref().is_ok_and(|axes| overturned(axes))).count();
        fallen as f64 >= (member.accepted_ratio + CLEAR_SHARE) * motions.len() as f64
    })
}

fn stays(member: &Member, all: &[Vec<MotionResponse>]) -> bool {
    let is_known = member.subject.capacity.as_ref().is_some_and(|capacity| capacity.decides);
    let is_far = |axes: &Vec<AxisMotion>| demand_capacity(axes).is_some_and(|ratio| ratio <= CLEAR_DEMAND);
    is_known && all.iter().flatten().all(|motion| motion.as_ref().is_ok_and(is_far))
}

fn outcome(axes: &Vec<AxisMotion>) -> Outcome {
    let mut outcome = Outcome { overturned: overturned(axes), terms: [None; 2], model: 1.0 };
    for (place, one) in outcome.terms.iter_mut().zip(axes) {
        *place = one.terms;
    }
    outcome
}
