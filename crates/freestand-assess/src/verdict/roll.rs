//! An object that rolls on free casters, or slides on its base, before it could rock: only a stop can
//! overturn it.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::rocking::{Outcome, RockingError, RockingSummary, SideExtremes, StopReason, Until};
use freestand::sliding::{
    Clearance, Friction, PlaneMotion, PlaneSliding, Sliding, SlidingOptions, SlidingOutcome, slide,
    slide_in_plane, trip_speed_m_s,
};

use freestand_study::run::LONGEST_TAIL_S;

use crate::worlds::FloorOfWorld;

use super::capacity::{Demand, Terms};
use super::draw::Draw;
use super::object::{Gliding, Subject};
use super::response::{AxisMotion, Lost, RigidResponse, Roll, terms};

/// An object that rolls or slides in one world.
pub(super) fn rolled(
    subject: &Subject,
    gliding: &Gliding,
    draw: &Draw,
    floor: &FloorOfWorld,
) -> RigidResponse {
    let ratio = draw.friction_ratio.unwrap_or(gliding.resistance_ratio.1);
    let resistance = Friction::uniform(ratio).map_err(Lost::failed)?;
    let options = SlidingOptions {
        clearance: Clearance {
            left_m: gliding.clearance_m,
            right_m: gliding.clearance_m,
        },
        until: Until::Settled {
            at_most_s: LONGEST_TAIL_S,
        },
        ..SlidingOptions::new(resistance)
    };
    let both = under_both(&options, floor)?;
    let is_alone = subject.axes.len() == 1;
    let axes = (0..subject.axes.len()).map(|axis| {
        let (block, _) = draw
            .block(subject, axis)
            .ok_or_else(|| Lost::failed("the block is missing"))?;
        let is_x = draw.is_along_x(axis);
        // Without a width the one block stands for both directions: it moves in both.
        let is_own = |along_x: bool| is_alone || along_x == is_x;
        let roll = match &both {
            Some(found) => Roll {
                travel_m: found.peak_m,
                stop_speed_m_s: [true, false]
                    .into_iter()
                    .zip(found.stop_speeds_m_s)
                    .filter(|(along_x, _)| is_own(*along_x))
                    .filter_map(|(_, speed_m_s)| speed_m_s)
                    .reduce(f64::max),
                is_at_least: false,
            },
            None => {
                let found = slid(&options, floor, is_x)?;
                let stop_speed_m_s = found.contact.map(|(_, speed_m_s)| speed_m_s.abs());
                Roll {
                    travel_m: found.peak_m.abs(),
                    stop_speed_m_s,
                    is_at_least: true,
                }
            }
        };
        Ok(motion(
            subject,
            gliding,
            draw,
            &block,
            roll,
            ratio,
            floor.pfa_m_s2,
        ))
    });
    axes.collect()
}

/// The slide under both components of the floor; `None`: it has one.
fn under_both(
    options: &SlidingOptions,
    floor: &FloorOfWorld,
) -> Result<Option<PlaneSliding>, Lost> {
    if floor.motion.across.is_none() {
        return Ok(None);
    }
    let motion = PlaneMotion {
        x: floor.component(true),
        y: floor.component(false),
        vertical: floor.base(true).vertical,
    };
    let found = slide_in_plane(motion, options).map_err(Lost::failed)?;
    match found.free_flight_time_s {
        Some(time_s) => Err(RockingError::FreeFlight { time_s }.into()),
        None => Ok(Some(found)),
    }
}

fn slid(options: &SlidingOptions, floor: &FloorOfWorld, is_x: bool) -> Result<Sliding, Lost> {
    let found = slide(floor.base(is_x), options).map_err(Lost::failed)?;
    match found.outcome {
        SlidingOutcome::FreeFlight => Err(RockingError::FreeFlight {
            time_s: found.end_time_s,
        }
        .into()),
        SlidingOutcome::Stuck | SlidingOutcome::Slid => Ok(found),
    }
}

/// It stays upright, or its stop overturns it.
fn motion(
    subject: &Subject,
    gliding: &Gliding,
    draw: &Draw,
    block: &Block,
    roll: Roll,
    resistance_ratio: f64,
    floor_m_s2: f64,
) -> AxisMotion {
    let trips = roll
        .stop_speed_m_s
        .is_some_and(|speed_m_s| speed_m_s >= trip_speed_m_s(block, G0_M_S2));
    let rocking = RockingSummary {
        outcome: if trips {
            Outcome::Overturned
        } else {
            Outcome::NoUplift
        },
        stop: if trips {
            StopReason::Overturned
        } else {
            StopReason::Settled
        },
        peak_rotation_rad: if trips {
            std::f64::consts::FRAC_PI_2
        } else {
            0.0
        },
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
        let demand = roll
            .stop_speed_m_s
            .and_then(|speed| stop_demand(gliding, draw.mass_kg(subject)?, speed));
        // No more than its resistance gets through to it.
        let through_m_s2 = floor_m_s2.min(resistance_ratio * G0_M_S2);
        terms(
            capacity,
            demand,
            roll.stop_speed_m_s.is_none(),
            0.0,
            through_m_s2,
        )
    });
    AxisMotion {
        rocking,
        hit: None,
        strike: None,
        roll: Some(roll),
        terms,
    }
}

/// The shock of the stop, v √(k_s/m), a half-sine; an elastic stop turns the speed round. `None`:
/// its stiffness is not known.
fn stop_demand(gliding: &Gliding, mass_kg: f64, speed_m_s: f64) -> Option<Demand> {
    let omega_rad_s = (gliding.stop_stiffness_n_m? / mass_kg).sqrt();
    Some(Demand {
        edge_m_s2: speed_m_s * omega_rad_s,
        velocity_change_m_s: 2.0 * speed_m_s,
        duration_s: std::f64::consts::PI / omega_rad_s,
    })
}
