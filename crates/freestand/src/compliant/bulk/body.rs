//! A block on two pads as the kernel sees it: everything for each kilogram, and its state of rest.

use std::f64::consts::FRAC_PI_2;

use super::CompliantWorld;
use super::stand::rocking_frequency_hz;
use crate::compliant::{
    CompliantBase, CompliantError, MAX_STEPS, equilibrium::equilibrium, not_negative, positive,
};
use crate::cushion::{ContactLaw, Cushion};
use crate::motion::Motion;

/// Longest step, as an angle of the fastest vibration of the block on both pads. Four stages leave
/// an error of x⁵/120 of the amplitude: 4e-5.
pub(super) const STEP_RAD: f64 = 0.35;

/// How far past its event a contact may change, as an angle of that vibration. A dashpot begins to
/// push at once: c v δt/m is this times 2ζ of the velocity v.
pub(super) const EVENT_RAD: f64 = 5e-4;

/// A dashpot of no damping recovers this fast \[1/s\].
const AT_ONCE: f64 = 1e12;

/// Beyond this rotation, and half of the way from the balance point to the floor, a block counts as
/// fallen \[rad\].
const FALLEN_RAD: f64 = 1.2;

#[derive(Debug, Clone, Copy)]
pub(super) struct Body {
    /// k/m and c/m of one edge.
    pub(super) spring: f64,
    pub(super) dashpot: f64,
    /// k/c: how fast a pad recovers.
    pub(super) recovery: f64,
    /// m/I_cg.
    pub(super) turning: f64,
    pub(super) gravity: f64,
    pub(super) height: f64,
    /// Left and right edge from the centre of gravity.
    pub(super) edges: [f64; 2],
    /// Longest step \[s\], and its number in a sample.
    pub(super) step_s: f64,
    pub(super) parts: usize,
    pub(super) event_s: f64,
    /// Half a period of rocking on both edges.
    pub(super) calm_s: f64,
    pub(super) fallen_rad: f64,
    pub(super) rest: Rest,
}

/// The block at rest on its pads.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rest {
    pub(super) theta: f64,
    pub(super) z: f64,
    /// From the centre of gravity to the edges.
    pub(super) arm_x: [f64; 2],
    pub(super) arm_z: [f64; 2],
    /// N/m of each edge.
    pub(super) loads: [f64; 2],
    pub(super) compressions: [f64; 2],
}

impl Body {
    pub(super) fn new(
        world: &CompliantWorld,
        motion: &Motion,
        gravity: f64,
    ) -> Result<Self, CompliantError> {
        let CompliantWorld {
            block,
            mass_kg,
            stiffness_n_m,
            damping_n_s_m,
            ..
        } = *world;
        positive("mass", mass_kg)?;
        positive("stiffness", stiffness_n_m)?;
        positive("gravity", gravity)?;
        not_negative("damping", damping_n_s_m)?;
        let stable = rocking_frequency_hz(&block, mass_kg, stiffness_n_m, gravity);
        let rest = Rest::new(world, gravity)?;
        let f_hz = stable.ok_or(CompliantError::Unstable {
            stiffness_n_m: 0.5 * stiffness_n_m * block.base_width_m().powi(2),
            needed_n_m: mass_kg * gravity * block.cg_height_m(),
        })?;
        let (spring, dashpot) = (stiffness_n_m / mass_kg, damping_n_s_m / mass_kg);
        let turning = block.gyration_radius_m().powi(-2);
        let (height, edges) = (
            block.cg_height_m(),
            [-block.cg_from_left_m(), block.cg_from_right_m()],
        );
        let fastest = fastest_rad_s(spring, dashpot, turning, height, edges);
        let steps = (motion.dt_s() * fastest / STEP_RAD).ceil().max(1.0);
        let all = steps * motion.accel_m_s2().len() as f64;
        if all.is_nan() || all > MAX_STEPS as f64 {
            return Err(CompliantError::TooManySteps {
                time_s: 0.0,
                limit: MAX_STEPS,
            });
        }
        let alpha = [block.pivot(), block.right_pivot()].map(|pivot| pivot.slenderness_angle_rad);
        Ok(Self {
            spring,
            dashpot,
            recovery: if dashpot > 0.0 {
                (spring / dashpot).min(AT_ONCE)
            } else {
                AT_ONCE
            },
            turning,
            gravity,
            height,
            edges,
            step_s: motion.dt_s() / steps,
            parts: steps as usize,
            event_s: EVENT_RAD / fastest,
            calm_s: 0.5 / f_hz,
            fallen_rad: FALLEN_RAD
                .max(0.5 * (alpha[0].max(alpha[1]) + FRAC_PI_2))
                .min(FRAC_PI_2),
            rest,
        })
    }
}

impl Rest {
    fn new(world: &CompliantWorld, gravity: f64) -> Result<Self, CompliantError> {
        let (stiffness_n_m, damping_n_s_m) = (world.stiffness_n_m, world.damping_n_s_m);
        let law = if damping_n_s_m > 0.0 {
            ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            }
        } else {
            ContactLaw::Linear { stiffness_n_m }
        };
        let cushion = Cushion::new(law).map_err(|_| CompliantError::Value {
            name: "stiffness",
            requirement: "that of a pad",
            value: stiffness_n_m,
        })?;
        let found = equilibrium(
            &world.block,
            &CompliantBase::new(world.mass_kg, cushion),
            gravity,
        )?;
        let (theta, z) = (found.rotation_rad, -found.settlement_m);
        let (sin, cos) = theta.sin_cos();
        let (height, edges) = (
            world.block.cg_height_m(),
            [-world.block.cg_from_left_m(), world.block.cg_from_right_m()],
        );
        Ok(Self {
            theta,
            z,
            arm_x: edges.map(|edge| edge * cos - height * sin),
            arm_z: edges.map(|edge| -edge * sin - height * cos),
            loads: found
                .compressions_m
                .map(|d| stiffness_n_m / world.mass_kg * d),
            compressions: found.compressions_m,
        })
    }
}

/// No vibration on both pads is faster than the root of the sum of squares of M^(−½) K M^(−½); the
/// dashpots alone are not faster than c/m takes to the place of k/m.
fn fastest_rad_s(spring: f64, dashpot: f64, turning: f64, height: f64, edges: [f64; 2]) -> f64 {
    let norm = |across: f64, up: f64| {
        let (sum, squares) = (
            edges[0] + edges[1],
            edges[0] * edges[0] + edges[1] * edges[1],
        );
        let rotation = turning * (up * squares + 2.0 * across * height * height);
        let mixed = turning * ((2.0 * across * height).powi(2) + (up * sum).powi(2));
        let (sway, bounce) = (2.0 * across, 2.0 * up);
        (sway * sway + bounce * bounce + rotation * rotation + 2.0 * mixed).sqrt()
    };
    norm(spring, spring).sqrt().max(norm(0.0, dashpot))
}
