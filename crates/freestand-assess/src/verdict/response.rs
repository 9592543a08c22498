//! The response of an object to one motion about each of its axes, and its demand.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::motion::Motion;
use freestand::rocking::{Base, Outcome, Restitution, RockingOptions, RockingSummary, Until, rock_each};

use freestand_study::cushion::BOTTOMED;
use freestand_study::run::LONGEST_TAIL_S;

use super::capacity::{Capacity, Demand, Terms};
use super::object::{Hit, Subject, hit};

/// One axis under one motion.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AxisMotion {
    pub(super) rocking: RockingSummary,
    /// `None`: overturned, or mass or cushion is not known.
    pub(super) hit: Option<Hit>,
    /// `None`: demand or capacity is not known.
    pub(super) terms: Option<Terms>,
}

/// The object under one motion: every axis, or why a history failed.
pub(super) type MotionResponse = Result<Vec<AxisMotion>, String>;

/// The values of one history besides the geometry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Values<'a> {
    pub(super) mass_kg: f64,
    pub(super) cushion: &'a Cushion,
}

/// The options of every history, the same as in `run`.
pub(super) fn options(subject_restitution: Restitution) -> RockingOptions {
    RockingOptions {
        restitution: subject_restitution,
        until: Until::Settled { at_most_s: LONGEST_TAIL_S },
        ..RockingOptions::default()
    }
}

/// Blocks under one motion, each in its worst direction: one that overturns it, otherwise the
/// envelope of all directions.
pub(super) fn rock_directions(
    objects: &[(Block, Restitution)],
    directions: &[Motion],
) -> Vec<Result<RockingSummary, String>> {
    let mut worst: Vec<Result<RockingSummary, String>> = Vec::new();
    for motion in directions {
        let base = Base { horizontal: Some(motion), vertical: None };
        let found = rock_each(objects, base, &options(Restitution::Housner));
        let found = found.into_iter().map(|one| one.map_err(|error| error.to_string()));
        worst = if worst.is_empty() { found.collect() } else { worst.into_iter().zip(found).map(worse).collect() };
    }
    worst
}

fn worse(
    (one, other): (Result<RockingSummary, String>, Result<RockingSummary, String>),
) -> Result<RockingSummary, String> {
    let (mut one, other) = (one?, other?);
    match (one.outcome, other.outcome) {
        (Outcome::Overturned, _) | (_, Outcome::NoUplift) => Ok(one),
        (_, Outcome::Overturned) | (Outcome::NoUplift, _) => Ok(other),
        (Outcome::Rocked, Outcome::Rocked) => {
            for (side, theirs) in one.sides.iter_mut().zip(other.sides) {
                side.peak_rotation_rad = side.peak_rotation_rad.max(theirs.peak_rotation_rad);
                side.impact_omega_rad_s = side.impact_omega_rad_s.max(theirs.impact_omega_rad_s);
            }
            one.peak_rotation_rad = one.peak_rotation_rad.max(other.peak_rotation_rad);
            one.uplift_m = one.uplift_m.max(other.uplift_m);
            one.cg_rise_m = one.cg_rise_m.max(other.cg_rise_m);
            one.impact_count = one.impact_count.max(other.impact_count);
            Ok(one)
        }
    }
}

/// Shock and demand of a history with a mass and a cushion; `None` where they are not known.
pub(super) fn axis_motion(
    subject: &Subject,
    block: &Block,
    rocking: RockingSummary,
    values: Option<Values<'_>>,
    floor_m_s2: f64,
) -> Result<AxisMotion, String> {
    let is_upright = rocking.outcome != Outcome::Overturned;
    let found = match values.filter(|_| is_upright) {
        Some(Values { mass_kg, cushion }) => {
            Some(hit(block, &rocking, mass_kg, cushion).ok_or_else(|| BOTTOMED.to_owned())?)
        }
        None => None,
    };
    let terms = subject.capacity.as_ref().and_then(|capacity| terms(capacity, &rocking, found.as_ref(), floor_m_s2));
    Ok(AxisMotion { rocking, hit: found, terms })
}

fn terms(capacity: &Capacity, rocking: &RockingSummary, hit: Option<&Hit>, floor_m_s2: f64) -> Option<Terms> {
    if rocking.outcome == Outcome::Overturned {
        return Some(Terms::OVERTURNED);
    }
    let demand = hit.map(|hit| Demand {
        edge_m_s2: hit.larger_g() * G0_M_S2,
        velocity_change_m_s: hit.velocity_change_m_s,
        duration_s: hit.duration_s,
    });
    let is_at_rest = rocking.outcome == Outcome::NoUplift;
    capacity.terms(demand, is_at_rest, rocking.uplift_m, floor_m_s2, |duration_s| capacity.severity_ratio(duration_s))
}

/// Whether any axis overturns.
pub(super) fn overturned(axes: &[AxisMotion]) -> bool {
    axes.iter().any(|one| one.rocking.outcome == Outcome::Overturned)
}

/// Whether there is uplift about any axis.
pub(super) fn lifts(axes: &[AxisMotion]) -> bool {
    axes.iter().any(|one| one.rocking.outcome != Outcome::NoUplift)
}

/// The governing axis: the one that overturns, else the one with the largest demand/capacity, else
/// shock, else rise.
pub(super) fn governing(axes: &[AxisMotion]) -> Option<(usize, &AxisMotion)> {
    let rank = |one: &AxisMotion| {
        let shock_g = one.hit.as_ref().map_or(0.0, Hit::larger_g);
        let ratio = one.terms.map_or(0.0, |terms| terms.ratio());
        (one.rocking.outcome == Outcome::Overturned, ratio, shock_g, one.rocking.cg_rise_m)
    };
    axes.iter().enumerate().reduce(|most, next| if rank(next.1) > rank(most.1) { next } else { most })
}

/// Largest number over the axes, +∞ where one overturns.
pub(super) fn ranked(axes: &[AxisMotion], number: impl Fn(&AxisMotion) -> f64) -> f64 {
    if overturned(axes) { f64::INFINITY } else { axes.iter().map(number).fold(0.0, f64::max) }
}

/// Demand/capacity about the worse axis; `None` where that of one axis is not known.
pub(super) fn demand_capacity(axes: &[AxisMotion]) -> Option<f64> {
    if overturned(axes) {
        return Some(f64::INFINITY);
    }
    axes.iter().map(|one| Some(one.terms?.ratio())).try_fold(0.0, |most: f64, ratio| Some(most.max(ratio?)))
}
