//! The block at rest on its cushions, and the initial state of a history.

use super::equation::{Body, LEN, OMEGA, State, THETA, V_X, V_Z, Z};
use super::pad::Pad;
use super::{CompliantBase, CompliantError, Start, not_negative, positive};
use crate::block::Block;
use crate::search::bisect;

/// A block at rest on its cushions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium {
    /// Compression under the left and the right edge \[m\].
    pub compressions_m: [f64; 2],
    /// Rotation from unequal compressions; not an uplift \[rad\].
    pub rotation_rad: f64,
    /// How far the centre of gravity is below its position above unloaded cushions \[m\].
    pub settlement_m: f64,
}

/// The equilibrium of a block on its cushions: exact for any law and any position of the centre of
/// gravity.
///
/// # Accuracy
/// Rounding: Newton's method on forces and moments.
///
/// # Errors
/// Numbers out of range, or cushions too soft to keep the block upright.
///
/// # Example
/// 140 kg on 4380 N/mm under each edge: 140 · 9.80665/(2 · 4.38e6) = 0.15673 mm.
/// ```
/// use freestand::{block::Block, compliant::{CompliantBase, equilibrium}, cushion::Cushion};
/// let base = CompliantBase::new(140.0, Cushion::linear(4.38e6)?);
/// let rest = equilibrium(&Block::uniform(2.3, 0.6)?, &base, freestand::G0_M_S2)?;
/// assert!((rest.compressions_m[0] - 0.15673e-3).abs() < 1e-8 && rest.rotation_rad == 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn equilibrium(
    block: &Block,
    base: &CompliantBase,
    gravity_m_s2: f64,
) -> Result<Equilibrium, CompliantError> {
    positive("mass", base.mass_kg)?;
    positive("gravity", gravity_m_s2)?;
    not_negative("tangential damping", base.tangential_damping_n_s_m)?;
    if !(2..=super::MAX_CONTACTS).contains(&base.contacts) {
        return Err(CompliantError::Contacts {
            contacts: base.contacts,
        });
    }
    let body = body(block, base, gravity_m_s2);
    let y = body.balanced()?;
    Ok(body.equilibrium_of(&y))
}

/// The block and its supports.
pub(super) fn body<'a>(block: &Block, base: &'a CompliantBase, gravity: f64) -> Body<'a> {
    let (left, width) = (block.cg_from_left_m(), block.base_width_m());
    let last = base.contacts - 1;
    let place = |index: usize| {
        if index == last {
            block.cg_from_right_m()
        } else {
            index as f64 / last as f64 * width - left
        }
    };
    let share = 2.0 / base.contacts as f64;
    let slope = base.normal_stiffness_n_m(gravity);
    Body {
        mass: base.mass_kg,
        inertia: base.mass_kg * block.gyration_radius_m().powi(2),
        gravity,
        cg_height: block.cg_height_m(),
        contacts: (0..base.contacts).map(place).collect(),
        pad: Pad {
            cushion: &base.cushion,
            share,
        },
        tangential_stiffness: share * base.tangential_stiffness_ratio * slope,
        tangential_damping: share * base.tangential_damping_n_s_m,
        friction: base.friction_ratio,
    }
}

/// Forces, moments and their derivatives in a position of rest.
struct Statics {
    /// Upward force in excess of the weight, and Σ r_x N.
    force: f64,
    moment: f64,
    /// −∂force/∂z, ∂force/∂θ = −∂moment/∂z, ∂moment/∂θ.
    up: f64,
    mixed: f64,
    turning: f64,
}

impl Body<'_> {
    fn weight(&self) -> f64 {
        self.mass * self.gravity
    }

    fn statics(&self, y: &State) -> Statics {
        let mut statics = Statics {
            force: -self.weight(),
            moment: 0.0,
            up: 0.0,
            mixed: 0.0,
            turning: 0.0,
        };
        for index in 0..self.contacts.len() {
            let foot = self.foot(index, y);
            if foot.compression > 0.0 {
                let normal = self.pad.push(foot.compression, 0.0);
                let slope =
                    self.pad.share * self.pad.cushion.tangent_stiffness_n_m(foot.compression);
                statics.force += normal;
                statics.moment += foot.arm_x * normal;
                statics.up += slope;
                statics.mixed += slope * foot.arm_x;
                statics.turning += slope * foot.arm_x * foot.arm_x + normal * foot.arm_z;
            }
        }
        statics
    }

    /// The position in which the weight is in equilibrium.
    pub(super) fn balanced(&self) -> Result<State, CompliantError> {
        let mut y = [0.0; LEN];
        let (left, right) = (-self.contacts[0], self.contacts[self.contacts.len() - 1]);
        let width = left + right;
        // From the forces on a block that does not rotate: each half of the cushions carries the
        // load under its edge.
        let [d_left, d_right] = [right, left].map(|arm| {
            self.pad
                .cushion
                .static_compression_m(self.weight() * arm / width)
        });
        y[THETA] = (d_right - d_left) / width;
        y[Z] = -d_left - left * y[THETA];
        let error = |s: &Statics| {
            (s.force / self.weight()).abs() + (s.moment / (self.weight() * width)).abs()
        };
        let mut statics = self.statics(&y);
        for _ in 0..NEWTON_STEPS {
            let determinant = statics.up * statics.turning - statics.mixed * statics.mixed;
            if error(&statics) == 0.0 || determinant == 0.0 || !determinant.is_finite() {
                break;
            }
            let z =
                (statics.turning * statics.force + statics.mixed * -statics.moment) / determinant;
            let theta = (statics.mixed * statics.force - statics.up * statics.moment) / determinant;
            let mut share = 1.0;
            let next = loop {
                let mut trial = y;
                trial[Z] += share * z;
                trial[THETA] += share * theta;
                let there = self.statics(&trial);
                if error(&there) < error(&statics) {
                    break Some((trial, there));
                }
                share *= 0.5;
                if share < 1e-6 {
                    break None;
                }
            };
            let Some(next) = next else { break };
            (y, statics) = next;
        }
        let holds =
            statics.up > 0.0 && statics.up * statics.turning > statics.mixed * statics.mixed;
        if holds && error(&statics) < 1e-9 {
            return Ok(y);
        }
        let needed_n_m = self.weight() * self.cg_height;
        Err(CompliantError::Unstable {
            stiffness_n_m: statics.turning + needed_n_m,
            needed_n_m,
        })
    }

    pub(super) fn equilibrium_of(&self, y: &State) -> Equilibrium {
        let at = |index: usize| self.foot(index, y).compression.max(0.0);
        Equilibrium {
            compressions_m: [at(0), at(self.contacts.len() - 1)],
            rotation_rad: y[THETA],
            settlement_m: -y[Z],
        }
    }

    /// The initial state of a history.
    pub(super) fn beginning(&self, start: Start) -> Result<State, CompliantError> {
        let mut y = [0.0; LEN];
        match start {
            Start::Rest => return self.balanced(),
            Start::Dropped { height_m } => y[Z] = height_m,
            Start::Tilted {
                rotation_rad,
                omega_rad_s,
            } => {
                let is_right = rotation_rad > 0.0 || (rotation_rad == 0.0 && omega_rad_s > 0.0);
                let pivot = if is_right { self.contacts.len() - 1 } else { 0 };
                y[THETA] = rotation_rad;
                let upright = self.foot(pivot, &y).compression;
                let alone = self
                    .pad
                    .cushion
                    .static_compression_m(self.weight() / self.pad.share);
                let lowered = |d: f64| {
                    let mut y = y;
                    y[Z] += upright - d;
                    y
                };
                let d = bisect(0.0, alone, |d| self.statics(&lowered(d)).force >= 0.0);
                y = lowered(d);
                let foot = self.foot(pivot, &y);
                y[OMEGA] = omega_rad_s;
                (y[V_X], y[V_Z]) = (-omega_rad_s * foot.arm_z, omega_rad_s * foot.arm_x);
            }
        }
        Ok(y)
    }
}

/// Newton's method doubles the number of digits in each step; laws that start steeply take a few
/// more.
const NEWTON_STEPS: usize = 200;
