//! Objects on a compliant base in three dimensions, objects at a wall, and stacks of two: rigid
//! bodies on elements that only push, event by event.
//!
//! Axes of the floor: x to the right (along the thickness), y to the back (along the width), z
//! upward. With the place r of the centre of gravity relative to the floor, the unit quaternion q
//! (body → floor), the angular velocity Ω in body axes, and N, T of each element at ρ,
//!
//! m r̈ = Σ(T + N ẑ) − m(ü_x, ü_y, g + ü_z), J Ω̇ + Ω×JΩ = Qᵀ Σ ρ×(T + N ẑ), q̇ = ½ q ⊗ (0, Ω).
//!
//! N comes from the law of a [`Cushion`], as in the plane ([`compliant`](crate::compliant)), and
//! the integrator, the contact laws and the energy balance are the same.
//!
//! Rules, beyond those of the plane:
//! * **Elements**: a prism stands on its four corners, each with half of the cushion of one edge; a
//!   cylinder on 48 points of its rim, each with 2/48 of it.
//! * **Friction**: T = −k_t σ, with the stretch σ of a spring in the plane of the face. While it
//!   sticks, σ̇ = v, the velocity of the point along the face. When |k_t σ| reaches μN it slips:
//!   σ̇ = v − λσ̂, λ = v·σ̂ − (μ/k_t)Ṅ, which keeps |k_t σ| = μN while the direction turns with the
//!   velocity; it sticks again where λ = 0. σ = 0 at each new contact. The direction turns at no more
//!   than fifty times the rate of the vibration on the cushions: faster, it is that of the velocity.
//! * **A wall** is smooth and moves with the floor. It stops every corner of the object, those of the base too, and
//!   both rims of a cylinder. What the object loses there follows from the cushion of the wall; the foot may
//!   lift and slip.
//! * **A stack** is two bodies in the plane. Between them are two elements at the corners of the
//!   narrower body, normal to the face of the other one, with equal and opposite forces. An element
//!   ends where its corner leaves that face.
//! * **Overturned** when the axis of a body is horizontal (tilt π/2), or when the upper body has
//!   left the face of the lower one.
//!
//! # Limitation
//! A single history of a body that rocks in two directions is one realisation: neighbouring motions
//! give different ones. Shares and fractiles over many motions are what can be trusted (Vassiliou
//! et al. 2021, DOI 10.1177/8755293020988017, on 226 shaking-table tests).

mod element;
mod equation;
mod feet;
mod landings;
mod pose;
mod seen;
mod solve;
mod stack;
mod track;
mod wall;

#[cfg(test)]
mod tests;

use std::f64::consts::TAU;

use self::element::{Element, Role};
use self::equation::{Rigid, State, World};
use self::feet::Feet;
use self::pose::{BODY, PLACE, SPIN, TURN, VELOCITY};
use self::seen::{Seen, tilts};
use self::solve::{Ended, follow};
use self::track::yaw;
use crate::compliant::pad::Pad;
use crate::compliant::{
    ASSUMED_TANGENTIAL_RATIO, CompliantAccuracy, CompliantEffort, CompliantError, EdgeSide,
    EnergyAudit, check_accuracy, check_tilt, not_negative, positive, tangential_ratio, within,
};
use crate::cushion::Cushion;
use crate::motion::Motion;
use crate::rocking::Outcome;
use crate::search::bisect;

pub use landings::BaseLandings;
pub use seen::Pattern;
pub use stack::{Stack, StackBody, StackPart, StackRocking, rock_stack, rock_stack_observed};
pub use track::{BodyMotion, Patterns};
pub use wall::Wall;

/// Points of a cylinder's rim that rest on the floor.
pub const RIM_POINTS: usize = 48;

/// The shape of a uniform object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A prism on its four corners.
    Prism {
        /// Size along x \[m\].
        thickness_m: f64,
        /// Size along y \[m\].
        width_m: f64,
        /// Height \[m\].
        height_m: f64,
    },
    /// An upright cylinder on its rim.
    Cylinder {
        /// Diameter \[m\].
        diameter_m: f64,
        /// Height \[m\].
        height_m: f64,
    },
    /// A block that can only move in the plane of x and z, on its two edges.
    Plane {
        /// Size along x \[m\].
        thickness_m: f64,
        /// Height \[m\].
        height_m: f64,
    },
}

impl Shape {
    /// Sizes along x, y and z \[m\].
    pub fn sizes_m(&self) -> [f64; 3] {
        match *self {
            Self::Prism {
                thickness_m,
                width_m,
                height_m,
            } => [thickness_m, width_m, height_m],
            Self::Cylinder {
                diameter_m,
                height_m,
            } => [diameter_m, diameter_m, height_m],
            Self::Plane {
                thickness_m,
                height_m,
            } => [thickness_m, thickness_m, height_m],
        }
    }

    /// Acceleration of the floor along x and along y at which the object begins to rock on a rigid
    /// floor, divided by gravity: t/h and w/h. A cylinder rocks where the vector of both exceeds
    /// 2a/h. Rigid corners; a cushion lets go of a corner earlier.
    pub fn uplift_thresholds(&self) -> [f64; 2] {
        let [x, y, z] = self.sizes_m();
        [x / z, y / z]
    }

    /// Moments of inertia about the axes through the centre of gravity, divided by the mass \[m²\]:
    /// a box, (w² + h², t² + h², t² + w²)/12, or a cylinder of radius a, (3a² + h², 3a² + h²,
    /// 6a²)/12.
    fn gyration_m2(&self) -> [f64; 3] {
        let [x, y, z] = self.sizes_m().map(|size| size * size);
        match self {
            Self::Cylinder { .. } => [(0.75 * x + z) / 12.0, (0.75 * x + z) / 12.0, 1.5 * x / 12.0],
            _ => [(y + z) / 12.0, (x + z) / 12.0, (x + y) / 12.0],
        }
    }

    /// The points of the base, from its centre \[m\].
    pub fn feet_m(&self) -> Vec<[f64; 2]> {
        let [x, y, _] = self.sizes_m().map(|size| 0.5 * size);
        match self {
            Self::Prism { .. } => vec![[-x, -y], [x, -y], [x, y], [-x, y]],
            Self::Plane { .. } => vec![[-x, 0.0], [x, 0.0]],
            Self::Cylinder { .. } => {
                let angle = |index: usize| TAU * index as f64 / RIM_POINTS as f64;
                (0..RIM_POINTS)
                    .map(|index| [x * angle(index).cos(), x * angle(index).sin()])
                    .collect()
            }
        }
    }
}

/// What supports a body: the cushion under one edge, of which a body has two, and its friction.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// The cushion under one edge.
    pub cushion: Cushion,
    /// Tangential stiffness divided by the tangent stiffness of the cushion under half the weight.
    pub tangential_stiffness_ratio: f64,
    /// Coefficient of friction μ; `None`: no slip during contact.
    pub friction_ratio: Option<f64>,
}

impl Support {
    /// This cushion under each of two edges, without slip.
    pub fn new(cushion: Cushion) -> Self {
        Self {
            cushion,
            tangential_stiffness_ratio: ASSUMED_TANGENTIAL_RATIO,
            friction_ratio: None,
        }
    }

    fn check(&self) -> Result<(), CompliantError> {
        tangential_ratio(self.tangential_stiffness_ratio)?;
        self.friction_ratio
            .map_or(Ok(()), |friction| not_negative("friction", friction))
    }

    /// An element at `point` of `point_of` on a horizontal face that looks upward, with this share
    /// of the cushion of one edge, under a weight on two edges.
    fn element(
        &self,
        (point_of, point): (usize, [f64; 3]),
        share: f64,
        weight_n: f64,
        slot: usize,
    ) -> Element<'_> {
        let unit_m = self.cushion.static_compression_m(0.5 * weight_n);
        let stiffness =
            share * self.tangential_stiffness_ratio * self.cushion.tangent_stiffness_n_m(unit_m);
        // Without friction there is no tangential force at all.
        let (tangential_stiffness, friction) = match self.friction_ratio {
            Some(0.0) => (0.0, None),
            friction => (stiffness, friction),
        };
        Element {
            point_of: Some(point_of),
            point,
            rim_m: 0.0,
            face_of: None,
            normal: 2,
            sign: 1.0,
            gap: 0.0,
            end: None,
            pad: Pad {
                cushion: &self.cushion,
                share,
            },
            tangential_stiffness,
            friction,
            slot,
            unit_m,
            weight_n,
            role: Role::Base,
        }
    }
}

/// An object in space and what it touches.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialObject {
    /// Its shape; uniform.
    pub shape: Shape,
    /// Its mass \[kg\].
    pub mass_kg: f64,
    /// What it rests on.
    pub support: Support,
    /// Walls beside it.
    pub walls: Vec<Wall>,
}

/// The accelerations of the floor. Those that are given have the same step and length.
#[derive(Debug, Clone, Copy, Default)]
pub struct SpatialMotion<'a> {
    /// To the right.
    pub x: Option<&'a Motion>,
    /// To the back.
    pub y: Option<&'a Motion>,
    /// Upward.
    pub vertical: Option<&'a Motion>,
}

/// The initial state of a history in space.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum SpatialStart {
    /// At rest on the compressed cushions.
    #[default]
    Rest,
    /// Tilted, with the weight on the cushions of the lowest points, and released; the lowest point
    /// is at rest.
    Released {
        /// Tilt \[rad\].
        tilt_rad: f64,
        /// Direction of the tilt \[rad\]: 0 to the right, π/2 to the back.
        toward_rad: f64,
        /// Angular velocity in floor axes \[rad/s\].
        omega_rad_s: [f64; 3],
    },
}

/// Everything else that a history in space depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialOptions {
    /// g \[m/s²\].
    pub gravity_m_s2: f64,
    /// Accuracy.
    pub accuracy: CompliantAccuracy,
    /// Initial state.
    pub start: SpatialStart,
    /// End time; `None`: when everything has come to rest or something has fallen after the last
    /// sample, or [`LONGEST_TAIL_S`](crate::rocking::LONGEST_TAIL_S) after that sample. After the last
    /// sample the base comes to rest within one time step \[s\].
    pub duration_s: Option<f64>,
}

impl Default for SpatialOptions {
    fn default() -> Self {
        Self {
            gravity_m_s2: crate::G0_M_S2,
            accuracy: CompliantAccuracy::default(),
            start: SpatialStart::default(),
            duration_s: None,
        }
    }
}

impl SpatialOptions {
    fn check(&self) -> Result<(), CompliantError> {
        positive("gravity", self.gravity_m_s2)?;
        check_accuracy(self.accuracy)?;
        if let SpatialStart::Released {
            tilt_rad,
            toward_rad,
            omega_rad_s,
        } = self.start
        {
            check_tilt("initial tilt", tilt_rad)?;
            not_negative("direction of the initial tilt", toward_rad.abs())?;
            omega_rad_s
                .iter()
                .try_for_each(|omega| not_negative("initial angular speed", omega.abs()))?;
        }
        Ok(())
    }
}

/// The response of an object in space.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialRocking {
    /// What it did.
    pub body: BodyMotion,
    /// Time at which the history ended \[s\].
    pub end_time_s: f64,
    /// Compression of the cushions at rest \[m\].
    pub static_compression_m: f64,
    /// Contacts of points of the base with the floor, except those at the start.
    pub base_contact_count: usize,
    /// Contacts of points of the object with a wall.
    pub wall_contact_count: usize,
    /// How its base landed.
    pub landings: BaseLandings,
    /// Largest speed of such a point towards the wall when it touches; 0 without a contact \[m/s\].
    pub wall_speed_max_m_s: f64,
    /// Largest force of the wall on the left and of the one on the right; 0 without a contact \[N\].
    pub wall_forces_max_n: [f64; 2],
    /// The same on one edge of the object, at its base or above: the two may strike at once \[N\].
    pub wall_edge_forces_max_n: [f64; 2],
    /// The energy balance.
    pub energy: EnergyAudit,
    /// Work done.
    pub effort: CompliantEffort,
}

/// A body that has fallen, and when.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Fallen {
    body: usize,
    time_s: f64,
    /// It has left its support rather than reached π/2.
    slid_off: bool,
}

/// Where a body is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPose {
    /// `tilt_x` and `tilt_y` \[rad\].
    pub tilts_rad: [f64; 2],
    /// Angle of the axis to the vertical \[rad\].
    pub tilt_rad: f64,
    /// Yaw \[rad\].
    pub yaw_rad: f64,
    /// Displacement of the centre of the base: x, y, z \[m\].
    pub base_m: [f64; 3],
    /// Displacement of the centre of gravity: x, y, z \[m\].
    pub cg_m: [f64; 3],
}

/// A step of a history in space, as passed to an observer.
#[derive(Debug, Clone, Copy)]
pub struct SpatialPiece<'a, 'b> {
    seen: Seen<'a, 'b>,
}

impl SpatialPiece<'_, '_> {
    /// Start time \[s\].
    pub fn start_s(&self) -> f64 {
        self.seen.step.start_s
    }

    /// Length \[s\].
    pub fn length_s(&self) -> f64 {
        self.seen.step.length_s
    }

    /// Where a point of a body is at a share of the step, in floor axes from the point below the
    /// centre of its base at rest; the point is given from the centre of the base, upright \[m\].
    pub fn place_m(
        &self,
        body: usize,
        from_base_m: [f64; 3],
        share_ratio: f64,
    ) -> Option<[f64; 3]> {
        let rigid = self.seen.world.bodies.get(body)?;
        let poses = self.seen.world.poses(&self.seen.state(share_ratio));
        let [x, y, z] = from_base_m;
        let moved = poses[body].point(&[x, y, z - rigid.cg_height]).0;
        Some([x + moved[0], y + moved[1], z + moved[2]])
    }

    /// How the bodies of a stack move in this step; `None` for one body.
    pub fn pattern(&self) -> Option<Pattern> {
        (self.seen.world.bodies.len() == 2).then(|| self.seen.pattern())
    }

    /// Where a body is at a share of the step; 0 is the only or the lower body, 1 the upper one.
    pub fn pose(&self, body: usize, share_ratio: f64) -> Option<BodyPose> {
        let rigid = self.seen.world.bodies.get(body)?;
        let y = self.seen.state(share_ratio);
        let pose = self.seen.world.poses(&y)[body];
        let axis = pose.axis().0;
        Some(BodyPose {
            tilts_rad: tilts(&axis),
            tilt_rad: axis[0].hypot(axis[1]).atan2(axis[2]),
            yaw_rad: yaw(&y[BODY * body + TURN..]),
            base_m: pose.point(&[0.0, 0.0, -rigid.cg_height]).0,
            cg_m: pose.place,
        })
    }
}

/// The response of an object in space.
///
/// # Accuracy
/// As in the plane ([`CompliantAccuracy`]); [`EnergyAudit`] shows the accuracy reached.
///
/// # Errors
/// Numbers out of range, cushions that do not keep the object upright, or a history too long for
/// its stiffness.
///
/// # Example
/// A square cabinet that is pushed along the diagonal stays in its diagonal plane.
/// ```
/// use freestand::cushion::Cushion;
/// use freestand::motion::Motion;
/// use freestand::spatial::{Shape, SpatialMotion, SpatialObject, SpatialOptions, Support, rock_spatial};
///
/// let shape = Shape::Prism { thickness_m: 0.4, width_m: 0.4, height_m: 1.6 };
/// let support = Support::new(Cushion::linear(2e6)?);
/// let object = SpatialObject { shape, mass_kg: 150.0, support, walls: Vec::new() };
/// let push = Motion::new(0.005, (0..60).map(|i| 4.0 * (i as f64 * 0.1).sin()).collect())?;
/// let motion = SpatialMotion { x: Some(&push), y: Some(&push), vertical: None };
/// let options = SpatialOptions { duration_s: Some(0.3), ..SpatialOptions::default() };
/// let rocking = rock_spatial(&object, motion, &options)?;
/// assert!((rocking.body.final_tilt_x_rad - rocking.body.final_tilt_y_rad).abs() < 1e-9);
/// assert!(rocking.body.peak_tilt_rad > 0.01 && rocking.body.yaw_rad.abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rock_spatial(
    object: &SpatialObject,
    motion: SpatialMotion<'_>,
    options: &SpatialOptions,
) -> Result<SpatialRocking, CompliantError> {
    rock_spatial_observed(object, motion, options, |_| {})
}

/// [`rock_spatial`], which also passes every step to `observe` in order.
///
/// # Errors
/// Those of [`rock_spatial`].
pub fn rock_spatial_observed(
    object: &SpatialObject,
    motion: SpatialMotion<'_>,
    options: &SpatialOptions,
    mut observe: impl FnMut(&SpatialPiece<'_, '_>),
) -> Result<SpatialRocking, CompliantError> {
    object.check()?;
    options.check()?;
    let world = object.world(options.gravity_m_s2);
    let rest = world.at_rest();
    let (start, is_at_rest) = match options.start {
        SpatialStart::Rest => {
            object.stands(&world)?;
            (rest, true)
        }
        SpatialStart::Released {
            tilt_rad,
            toward_rad,
            omega_rad_s,
        } => (
            world.released(crate::space::tilted(tilt_rad, toward_rad), omega_rad_s),
            false,
        ),
    };
    let poses = world.poses(&start);
    let walls = world
        .elements
        .iter()
        .filter(|element| element.role == Role::Wall);
    // Rounding presses an object that touches by some 1e-16 m.
    if !is_at_rest
        && walls
            .into_iter()
            .any(|wall| world.foot(wall, &poses).compression > 1e-12)
    {
        return Err(CompliantError::BeyondWall);
    }
    let ended = follow(
        &world,
        [motion.x, motion.y, motion.vertical],
        options,
        (&start, is_at_rest),
        &mut observe,
    )?;
    let Ended {
        end_time_s,
        bodies,
        track,
        is_open,
        energy,
        effort,
        ..
    } = ended;
    let Some(&body) = bodies.first() else {
        return Err(CompliantError::NotFinite { time_s: end_time_s });
    };
    // Past its balance point and not fallen, it is held by a wall.
    let balance_rad = object.shape.uplift_thresholds()[0].atan();
    let leans = body.outcome == Outcome::Rocked
        && track.wall_contacts > 0
        && object.walls.iter().any(|wall| {
            let tilt_rad = body.final_tilt_x_rad;
            balance_rad
                <= if wall.side == EdgeSide::Left {
                    -tilt_rad
                } else {
                    tilt_rad
                }
        });
    let outcome = match body.outcome {
        Outcome::Rocked if leans => Outcome::Leaned,
        Outcome::Rocked if is_open => Outcome::Unresolved,
        outcome => outcome,
    };
    let body = BodyMotion { outcome, ..body };
    Ok(SpatialRocking {
        body,
        end_time_s,
        static_compression_m: -rest[PLACE + 2],
        base_contact_count: track.base_contacts,
        wall_contact_count: track.wall_contacts,
        landings: track.landings.close(end_time_s),
        wall_speed_max_m_s: track.wall_speed,
        wall_forces_max_n: track.wall_forces,
        wall_edge_forces_max_n: track.wall_edge_forces,
        energy,
        effort,
    })
}

impl SpatialObject {
    fn check(&self) -> Result<(), CompliantError> {
        positive("mass", self.mass_kg)?;
        let names = ["thickness", "width", "height"];
        names
            .into_iter()
            .zip(self.shape.sizes_m())
            .try_for_each(|(name, size)| positive(name, size))?;
        self.support.check()?;
        for wall in &self.walls {
            not_negative("gap to a wall", wall.gap_m)?;
            let is_high = wall.height_m > 0.0;
            within(is_high, "height of a wall", "positive", wall.height_m)?;
            if matches!(self.shape, Shape::Cylinder { .. }) && wall.is_low(&self.shape) {
                let requirement = "that of a prism at a wall lower than the object";
                within(false, "shape", requirement, wall.height_m)?;
            }
        }
        Ok(())
    }

    fn world(&self, gravity: f64) -> World<'_> {
        let [.., height] = self.shape.sizes_m();
        let (mass, cg_height) = (self.mass_kg, 0.5 * height);
        let body = Rigid::new(mass, self.shape.gyration_m2(), 0.0, cg_height);
        let feet = self.shape.feet_m();
        let share = 2.0 / feet.len() as f64;
        let weight_n = mass * gravity;
        let foot = |(slot, &[x, y]): (usize, &[f64; 2])| {
            self.support
                .element((0, [x, y, -cg_height]), share, weight_n, slot)
        };
        let mut elements: Vec<Element<'_>> = feet.iter().enumerate().map(foot).collect();
        let foot = self.support.element((0, [0.0; 3]), share, weight_n, 0);
        for wall in &self.walls {
            elements.extend(wall.elements(&self.shape, &foot));
        }
        let is_planar = matches!(self.shape, Shape::Plane { .. });
        let feet = elements.first().map(|one| Feet::new(feet, -cg_height, one));
        World {
            feet,
            ..World::new(vec![body], elements, gravity, is_planar)
        }
    }

    /// Returns an error if the cushions do not keep the object upright.
    fn stands(&self, world: &World<'_>) -> Result<(), CompliantError> {
        let needed_n_m = self.mass_kg * world.gravity * 0.5 * self.shape.sizes_m()[2];
        let axes: &[usize] = if matches!(self.shape, Shape::Plane { .. }) {
            &[0]
        } else {
            &[0, 1]
        };
        let stiffness_n_m = axes
            .iter()
            .map(|&axis| world.righting_n_m(Role::Base, axis))
            .fold(f64::INFINITY, f64::min);
        if stiffness_n_m > needed_n_m {
            Ok(())
        } else {
            Err(CompliantError::Unstable {
                stiffness_n_m,
                needed_n_m,
            })
        }
    }
}

impl World<'_> {
    /// The compression of the cushions of one role under the weight of `units` (two edges).
    fn sunk_m(&self, role: Role) -> f64 {
        self.elements
            .iter()
            .find(|element| element.role == role)
            .map_or(0.0, |element| element.unit_m)
    }

    /// Rotational stiffness of the cushions of one role under the weight on them: Σ k x² \[N m/rad\].
    fn righting_n_m(&self, role: Role, axis: usize) -> f64 {
        let of = |element: &Element<'_>| {
            let slope =
                element.pad.share * element.pad.cushion.tangent_stiffness_n_m(element.unit_m);
            slope * element.point[axis].powi(2)
        };
        self.elements
            .iter()
            .filter(|element| element.role == role)
            .map(of)
            .sum()
    }

    /// At rest: each body as far down as the cushions under it are compressed.
    pub(super) fn at_rest(&self) -> State {
        let mut y = self.upright();
        let mut down_m = 0.0;
        for (body, role) in (0..self.bodies.len()).zip([Role::Base, Role::Interface]) {
            down_m += self.sunk_m(role);
            y[BODY * body + PLACE + 2] = -down_m;
        }
        y
    }

    /// One body with this rotation and angular velocity (floor axes); its weight is on the lowest
    /// points, and the lowest of all is at rest, in its place.
    fn released(&self, turn: crate::space::Turn, omega: [f64; 3]) -> State {
        let mut y = self.upright();
        y[TURN..SPIN].copy_from_slice(&turn);
        let shift = crate::space::shift(&turn);
        y[SPIN..SPIN + 3].copy_from_slice(&crate::space::turned_back(&shift, &omega));
        let base = || {
            self.elements
                .iter()
                .filter(|element| element.role == Role::Base)
        };
        let poses = self.poses(&y);
        let compression = |element: &Element<'_>| self.compression(element, &poses);
        let lowest = base().max_by(|a, b| compression(a).total_cmp(&compression(b)));
        let Some(lowest) = lowest else { return y };
        let top = compression(lowest);
        // Below its unloaded cushion by d, the lowest point carries at most the weight.
        let force = |d: f64| {
            base()
                .map(|element| {
                    element
                        .pad
                        .push((compression(element) - top + d).max(0.0), 0.0)
                })
                .sum::<f64>()
        };
        let weight_n = self.bodies[0].mass * self.gravity;
        let most_m = lowest
            .pad
            .cushion
            .static_compression_m(weight_n / lowest.pad.share);
        let d = bisect(0.0, most_m, |d| force(d) >= weight_n);
        y[PLACE + 2] = top - d;
        // The lowest point is where it is when the body is upright.
        let aside = crate::space::moved(&shift, &lowest.point);
        (y[PLACE], y[PLACE + 1]) = (-aside[0], -aside[1]);
        let arm = crate::space::turned(&shift, &lowest.point);
        let velocity = crate::space::cross(&arm, &omega);
        y[VELOCITY..VELOCITY + 3].copy_from_slice(&velocity);
        y
    }
}
