//! A stack: an upper body on a lower one, in the plane.

use super::element::{Element, Role};
use super::equation::{Rigid, World};
use super::feet::Feet;
use super::solve::{Ended, follow};
use super::track::{BodyMotion, Patterns};
use super::{BaseLandings, Shape, SpatialOptions, SpatialPiece, SpatialStart, Support};
use crate::compliant::{CompliantEffort, CompliantError, EnergyAudit, positive, within};
use crate::rocking::{Base, Outcome};

/// A corner may pass the end of the other face by this share of the narrower body: edges are
/// rounded, and bodies of the same thickness do not lose each other when they shear by the
/// thickness of a hair.
const OVERHANG: f64 = 0.01;

/// A uniform body of a stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StackBody {
    /// Height \[m\].
    pub height_m: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
    /// Mass \[kg\].
    pub mass_kg: f64,
}

/// An upper body, centred on a lower one.
#[derive(Debug, Clone, PartialEq)]
pub struct Stack {
    /// The lower body (a pedestal, a cabinet).
    pub lower: StackBody,
    /// The upper body.
    pub upper: StackBody,
    /// What the lower body rests on.
    pub support: Support,
    /// What is between the bodies: the cushion of one edge of the narrower one.
    pub interface: Support,
}

/// The response of a stack. Rotations are `tilt_x` of the two bodies; `yaw` and `tilt_y` are 0.
#[derive(Debug, Clone, PartialEq)]
pub struct StackRocking {
    /// `Overturned` if either body falls.
    pub outcome: Outcome,
    /// The lower body.
    pub lower: BodyMotion,
    /// The upper body; its uplift is that from the lower one.
    pub upper: BodyMotion,
    /// Largest |θ_upper − θ_lower| \[rad\].
    pub peak_relative_rotation_rad: f64,
    /// The body that fell.
    pub overturned_body: Option<StackPart>,
    /// Shares of the time in each pattern.
    pub patterns: Patterns,
    /// Time at which the history ended \[s\].
    pub end_time_s: f64,
    /// How the lower body landed.
    pub landings: BaseLandings,
    /// The energy balance.
    pub energy: EnergyAudit,
    /// Work done.
    pub effort: CompliantEffort,
}

/// A body of a stack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum StackPart {
    /// The lower body.
    Lower,
    /// The upper body.
    Upper,
}

impl StackBody {
    fn check(&self) -> Result<(), CompliantError> {
        positive("height", self.height_m)?;
        positive("thickness", self.thickness_m)?;
        positive("mass", self.mass_kg)
    }

    fn rigid(&self, base_m: f64) -> Rigid {
        let shape = Shape::Plane {
            thickness_m: self.thickness_m,
            height_m: self.height_m,
        };
        let gyration_m2 = shape.gyration_m2();
        Rigid::new(self.mass_kg, gyration_m2, base_m, 0.5 * self.height_m)
    }
}

impl Stack {
    /// Acceleration of the floor at which the upper body begins to rock alone, on rigid edges,
    /// divided by gravity: min(b₂, B₁)/h₂.
    pub fn threshold_upper(&self) -> f64 {
        self.contact_m() / self.upper.height_m
    }

    /// Acceleration of the floor at which both begin to rock together, on rigid edges, divided by
    /// gravity: (m₁ + m₂)B₁/[m₁H₁ + m₂(2H₁ + h₂)].
    pub fn threshold_together(&self) -> f64 {
        let (lower, upper) = (&self.lower, &self.upper);
        let moment = lower.mass_kg * lower.height_m
            + upper.mass_kg * (2.0 * lower.height_m + upper.height_m);
        (lower.mass_kg + upper.mass_kg) * lower.thickness_m / moment
    }

    /// Distance between the two edges on which the upper body rests \[m\].
    fn contact_m(&self) -> f64 {
        self.upper.thickness_m.min(self.lower.thickness_m)
    }

    fn world(&self, gravity: f64) -> World<'_> {
        let (lower, upper) = (&self.lower, &self.upper);
        let bodies = vec![lower.rigid(0.0), upper.rigid(lower.height_m)];
        let both_n = (lower.mass_kg + upper.mass_kg) * gravity;
        let upper_n = upper.mass_kg * gravity;
        let half_m = [0.5 * lower.height_m, 0.5 * upper.height_m];
        let contact_m = 0.5 * self.contact_m();
        let mut elements = Vec::with_capacity(4);
        let mut slots = 0;
        for side in [-1.0, 1.0] {
            let foot = [0.5 * side * lower.thickness_m, 0.0, -half_m[0]];
            elements.push(self.support.element((0, foot), 1.0, both_n, slots));
            slots += usize::from(self.support.friction_ratio.is_some());
        }
        // The corners belong to the narrower body, the face to the other one.
        let upper_is_narrow = upper.thickness_m <= lower.thickness_m;
        for side in [-1.0, 1.0] {
            let x = side * contact_m;
            let (point, face_of, sign) = if upper_is_narrow {
                ((1, [x, 0.0, -half_m[1]]), 0, 1.0)
            } else {
                ((0, [x, 0.0, half_m[0]]), 1, -1.0)
            };
            let face_m = 0.5 * upper.thickness_m.max(lower.thickness_m) + OVERHANG * contact_m;
            elements.push(Element {
                face_of: Some(face_of),
                sign,
                end: Some((0, face_m)),
                role: Role::Interface,
                ..self.interface.element(point, 1.0, upper_n, slots)
            });
            slots += usize::from(self.interface.friction_ratio.is_some());
        }
        let feet_m: Vec<[f64; 2]> = elements
            .iter()
            .take(2)
            .map(|foot| [foot.point[0], foot.point[1]])
            .collect();
        let feet = elements
            .first()
            .map(|one| Feet::new(feet_m, -half_m[0], one));
        World {
            feet,
            ..World::new(bodies, elements, gravity, true)
        }
    }

    /// Returns an error if the cushions do not keep the stack upright: the energy of both rotations
    /// must be positive.
    fn stands(&self, world: &World<'_>) -> Result<(), CompliantError> {
        let (lower, upper) = (&self.lower, &self.upper);
        let base = world.righting_n_m(Role::Base, 0);
        let between = world.righting_n_m(Role::Interface, 0);
        let lower_needs = world.gravity * lower.height_m * (0.5 * lower.mass_kg + upper.mass_kg);
        let upper_needs = world.gravity * 0.5 * upper.height_m * upper.mass_kg;
        let (first, second) = (base + between - lower_needs, between - upper_needs);
        if second <= 0.0 {
            return Err(CompliantError::Unstable {
                stiffness_n_m: between,
                needed_n_m: upper_needs,
            });
        }
        if first * second <= between * between {
            // What the base would need for both.
            let needed_n_m = lower_needs + between * upper_needs / second;
            return Err(CompliantError::Unstable {
                stiffness_n_m: base,
                needed_n_m,
            });
        }
        Ok(())
    }
}

/// The response of a stack of two bodies in the plane, from rest.
///
/// # Accuracy
/// As of one body ([`super::rock_spatial`]).
///
/// # Limitation
/// Plane motion; where the upper body rotates on the lower one, a single history is one
/// realisation. An upper body that has left the lower one's face is not followed further.
///
/// # Reference
/// Psycharis 1990 and Spanos, Roussis and Politis 2001 for the four patterns of two rigid bodies;
/// on cushions they need no rules for the changes between them.
///
/// # Errors
/// Numbers out of range, a start other than from rest, cushions that do not keep the stack upright,
/// or a history too long for its stiffness.
pub fn rock_stack(
    stack: &Stack,
    motion: Base<'_>,
    options: &SpatialOptions,
) -> Result<StackRocking, CompliantError> {
    rock_stack_observed(stack, motion, options, |_| {})
}

/// [`rock_stack`], which also passes every step to `observe` in order.
///
/// # Errors
/// Those of [`rock_stack`].
pub fn rock_stack_observed(
    stack: &Stack,
    motion: Base<'_>,
    options: &SpatialOptions,
    mut observe: impl FnMut(&SpatialPiece<'_, '_>),
) -> Result<StackRocking, CompliantError> {
    [&stack.lower, &stack.upper]
        .into_iter()
        .try_for_each(StackBody::check)?;
    [&stack.support, &stack.interface]
        .into_iter()
        .try_for_each(Support::check)?;
    options.check()?;
    if let SpatialStart::Released { tilt_rad, .. } = options.start {
        let requirement = "0 for a stack: it starts from rest";
        within(false, "initial tilt", requirement, tilt_rad)?;
    }
    let world = stack.world(options.gravity_m_s2);
    stack.stands(&world)?;
    let motions = [motion.horizontal, None, motion.vertical];
    let ended = follow(
        &world,
        motions,
        options,
        (&world.at_rest(), true),
        &mut observe,
    )?;
    let Ended {
        end_time_s,
        bodies,
        track,
        fallen,
        is_open,
        energy,
        effort,
    } = ended;
    let (Some(&lower), Some(&upper)) = (bodies.first(), bodies.get(1)) else {
        return Err(CompliantError::NotFinite { time_s: end_time_s });
    };
    let overturned_body = fallen.map(|fallen| {
        if fallen.body == 0 {
            StackPart::Lower
        } else {
            StackPart::Upper
        }
    });
    let has_rocked = [lower, upper]
        .iter()
        .any(|body| body.outcome == Outcome::Rocked);
    Ok(StackRocking {
        outcome: match overturned_body {
            Some(_) => Outcome::Overturned,
            None if has_rocked && is_open => Outcome::Unresolved,
            None if has_rocked => Outcome::Rocked,
            None => Outcome::NoUplift,
        },
        lower,
        upper,
        peak_relative_rotation_rad: track.relative,
        overturned_body,
        patterns: track.patterns(end_time_s),
        landings: track.landings.close(end_time_s),
        end_time_s,
        energy,
        effort,
    })
}
