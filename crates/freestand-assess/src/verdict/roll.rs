//! An object on free casters: it rolls before it could rock, and only a stop can overturn it.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::rocking::{Outcome, RockingSummary, SideExtremes, StopReason, Until};
use freestand::sliding::{Clearance, Sliding, SlidingOptions, SlidingOutcome, slide, trip_speed_m_s};

use freestand_study::run::LONGEST_TAIL_S;

use crate::worlds::FloorOfWorld;

use super::capacity::{Demand, Terms};
use super::draw::Draw;
use super::object::{Rolling, Subject};
use super::response::{AxisMotion, RigidResponse, Roll, terms};

/// An object on free casters in one world.
pub(super) fn rolled(subject: &Subject, rolling: &Rolling, draw: &Draw, floor: &FloorOfWorld) -> RigidResponse {
    let is_alone = subject.axes.len() == 1;
    let axes = (0..subject.axes.len()).map(|axis| {
        let (block, _) = draw.block(subject, axis).ok_or_else(|| "the block is missing".to_owned())?;
        let along = slid(rolling, floor, draw.is_along_x(axis))?;
        // Without a width the one block stands for both directions: it rolls in both.
        let across = is_alone.then(|| slid(rolling, floor, !draw.is_along_x(axis))).transpose()?;
        let speed = |found: &Sliding| found.contact.map(|(_, speed_m_s)| speed_m_s.abs());
        let both = [Some(along), across];
        let roll = Roll {
            travel_m: both.iter().flatten().map(|found| found.peak_m.abs()).fold(0.0, f64::max),
            stop_speed_m_s: both.iter().flatten().filter_map(speed).reduce(f64::max),
        };
        Ok(motion(subject, rolling, draw, &block, roll, floor.pfa_m_s2))
    });
    axes.collect()
}

/// The options of every slide.
fn options(rolling: &Rolling) -> SlidingOptions {
    SlidingOptions {
        clearance: Clearance { left_m: rolling.clearance_m, right_m: rolling.clearance_m },
        until: Until::Settled { at_most_s: LONGEST_TAIL_S },
        ..SlidingOptions::new(rolling.resistance)
    }
}

fn slid(rolling: &Rolling, floor: &FloorOfWorld, is_x: bool) -> Result<Sliding, String> {
    let found = slide(floor.base(is_x), &options(rolling)).map_err(|error| error.to_string())?;
    match found.outcome {
        SlidingOutcome::FreeFlight => Err("the object leaves the floor".to_owned()),
        SlidingOutcome::Stuck | SlidingOutcome::Slid => Ok(found),
    }
}

/// It is at rest on its casters, or its stop overturns it.
fn motion(subject: &Subject, rolling: &Rolling, draw: &Draw, block: &Block, roll: Roll, floor_m_s2: f64) -> AxisMotion {
    let trips = roll.stop_speed_m_s.is_some_and(|speed_m_s| speed_m_s >= trip_speed_m_s(block, G0_M_S2));
    let rocking = RockingSummary {
        outcome: if trips { Outcome::Overturned } else { Outcome::NoUplift },
        stop: if trips { StopReason::Overturned } else { StopReason::Settled },
        peak_rotation_rad: if trips { std::f64::consts::FRAC_PI_2 } else { 0.0 },
        sides: [SideExtremes::default(); 2],
        impact_count: 0,
        wall_impact_count: 0,
        uplift_m: 0.0,
        cg_rise_m: 0.0,
    };
    let terms = subject.capacity.as_ref().and_then(|capacity| {
        if trips {
            return Some(Terms::OVERTURNED);
        }
        let demand = roll.stop_speed_m_s.and_then(|speed| stop_demand(rolling, draw.mass_kg(subject)?, speed));
        // No more than its resistance gets through the casters.
        let through_m_s2 = floor_m_s2.min(rolling.resistance.static_ratio() * G0_M_S2);
        terms(capacity, demand, roll.stop_speed_m_s.is_none(), 0.0, through_m_s2)
    });
    AxisMotion { rocking, hit: None, strike: None, roll: Some(roll), terms }
}

/// The shock of the stop, v √(k_s/m), a half-sine; an elastic stop turns the speed round. `None`:
/// its stiffness is not known.
fn stop_demand(rolling: &Rolling, mass_kg: f64, speed_m_s: f64) -> Option<Demand> {
    let omega_rad_s = (rolling.stop_stiffness_n_m? / mass_kg).sqrt();
    Some(Demand {
        edge_m_s2: speed_m_s * omega_rad_s,
        velocity_change_m_s: 2.0 * speed_m_s,
        duration_s: std::f64::consts::PI / omega_rad_s,
    })
}
