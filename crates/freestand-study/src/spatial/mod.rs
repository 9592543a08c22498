//! One history of an object in three dimensions, or of a stack of two: request → report.

mod wall;

use freestand::compliant::CompliantEffort;
use freestand::cushion::{ContactLaw, Cushion};

use freestand::motion::Motion;
use freestand::respond::{
    HistoryOptions, Settings, SpatialHistory, SpatialPoint, StackHistory, StackPoint,
};

use freestand::signal::rotate::Pair;
use freestand::spatial::{
    BodyMotion, Patterns, Shape, SpatialMotion, SpatialObject, SpatialRocking, Stack, StackRocking,
    Support,
};
use freestand_input::problem::Problem;
use freestand_output::answer;
use freestand_records::horizontal::HorizontalMotion;

pub use wall::{CushionWallAnswer, walls_on_cushions};

use crate::compliant::{damped, energy_error, rings};
use crate::cushion::EdgeCushion;
use crate::doubt::{HistoryDoubt, HistoryNote};
use crate::unsolved::{self, base, unresolved};
use crate::walls::GivenCushion;

/// The shapes of objects in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ShapeName {
    /// A prism on its four corners.
    #[default]
    Prism,
    /// An upright cylinder on its rim; the thickness is its diameter.
    Cylinder,
}

/// The shape of an object with these sizes \[m\].
///
/// # Errors
/// A prism without a width, or a cylinder with one that is not its diameter.
pub fn shape(
    name: ShapeName,
    height_m: f64,
    thickness_m: f64,
    width_m: Option<f64>,
) -> Result<Shape, Problem> {
    match (name, width_m) {
        (ShapeName::Prism, Some(width_m)) => Ok(Shape::Prism {
            thickness_m,
            width_m,
            height_m,
        }),
        (ShapeName::Prism, None) => {
            let hint =
                "give `width`, the horizontal size across the thickness, or `shape = \"cylinder\"`";
            Err(Problem::value(
                "an object in three dimensions needs a width",
                hint,
            ))
        }
        (ShapeName::Cylinder, Some(width_m)) if width_m != thickness_m => {
            let message = format!(
                "`width`: a cylinder has one diameter, but {width_m} m differs from the thickness"
            );
            Err(Problem::value(
                message,
                "leave the width out: the thickness is the diameter",
            ))
        }
        (ShapeName::Cylinder, _) => Ok(Shape::Cylinder {
            diameter_m: thickness_m,
            height_m,
        }),
    }
}

/// An object in space, under a motion or released.
#[derive(Debug, Clone)]
pub struct SpatialRequest {
    /// The object and what it rests on.
    pub object: SpatialObject,
    /// How the cushion was read.
    pub edge: EdgeCushion,
    /// The cushion of its walls, as far as it was given.
    pub wall_cushion: GivenCushion,
    /// Horizontal motions of the floor: the first, and the one to its left (at 90° anticlockwise,
    /// seen from above).
    pub motions: [Option<Motion>; 2],
    /// Vertical motion of the floor.
    pub vertical: Option<Motion>,
    /// How far the object is turned from the first motion, anticlockwise seen from above \[rad\].
    pub orientation_rad: f64,
    /// Gravity, accuracy, start, end, samples.
    pub how: HistoryOptions,
}

answer! {
    /// What an object in space did.
    pub struct SpatialAnswer of (body: &BodyMotion, rocking: &SpatialRocking, request: &SpatialRequest) {
        /// What the object stands on.
        base: &'static str = "compliant";
        /// How it is followed.
        model: &'static str = names(&request.object.shape).0;
        shape: &'static str = names(&request.object.shape).1 => "shape";
        outcome: &'static str = body.outcome.name() => "outcome";
        end_time_s: f64 = rocking.end_time_s => "end";
        peak_tilt_rad: f64 => "largest tilt";
        peak_tilt_time_s: f64 => "  at";
        peak_tilt_x_rad: f64 => "  to the right";
        peak_tilt_y_rad: f64 => "  to the back";
        uplift_m: f64 => "uplift of a point of the base";
        first_uplift_time_s: Option<f64> => "first uplift";
        overturn_time_s: Option<f64> => "overturns";
        final_tilt_x_rad: f64 => "tilt at the end, to the right";
        final_tilt_y_rad: f64 => "tilt at the end, to the back";
        yaw_rad: f64 => "yaw at the end";
        base_slide_peak_m: f64 => "largest displacement of the base";
        base_slide_final_m: f64 => "displacement of the base at the end";
        impact_count: usize = rocking.base_contact_count => "contacts with the floor";
        walls: Option<CushionWallAnswer> = wall::answer(&request.object, rocking) => flat;
        threshold_x_g: f64 = request.object.shape.uplift_thresholds()[0] => "uplift threshold, thickness";
        threshold_y_g: Option<f64> =
            in_space(&request.object.shape, request.object.shape.uplift_thresholds()[1]) => "uplift threshold, width";
        static_compression_m: f64 = rocking.static_compression_m => "compression at rest";
        energy_error_ratio: f64 = rocking.energy.residual_ratio => "error of the energy balance";
        /// Dissipated in the cushions.
        cushion_dissipation_j: f64 = rocking.energy.cushion_dissipation_j;
        /// Dissipated by friction.
        friction_j: f64 = rocking.energy.friction_j;
        /// Left in the cushions where an edge leaves them.
        lost_at_separation_j: f64 = rocking.energy.lost_at_separation_j;
        /// Work of the floor.
        base_work_j: f64 = rocking.energy.base_work_j;
        /// Energy that was exchanged in all.
        turnover_j: f64 = rocking.energy.turnover_j;
        /// Height of the object.
        height_m: f64 = request.object.shape.sizes_m()[2];
        /// Size along the first motion, where the object is not turned.
        thickness_m: f64 = request.object.shape.sizes_m()[0];
        /// Size across the thickness.
        width_m: Option<f64> = in_space(&request.object.shape, request.object.shape.sizes_m()[1]);
        /// How far the object is turned from the first motion, anticlockwise from above.
        orientation_rad: f64 = request.orientation_rad;
        support: SupportAnswer = SupportAnswer::of(
            &request.object.support, request.object.mass_kg, &request.how.settings, rocking.effort,
        ) => flat;
    }

    /// What an object in space or a stack rests on, and how it was followed.
    pub struct SupportAnswer of (support: &Support, mass_kg: f64, settings: &Settings, effort: CompliantEffort) {
        /// Mass of the object.
        mass_kg: f64 = mass_kg;
        /// The law of the cushions.
        law: &'static str = support.cushion.law().name();
        /// Tangential over normal stiffness of a cushion.
        tangential_stiffness_ratio: f64;
        /// Coefficient of friction; none: no slip.
        friction_ratio: Option<f64>;
        /// Relative tolerance of the solver.
        tolerance: f64 = settings.on_pads.tolerance();
        /// Steps of the solver.
        steps: usize = effort.steps;
        /// Evaluations of the equations of motion.
        evaluations: usize = effort.evaluations;
    }

    /// What a stack did.
    pub struct StackAnswer of (rocking: &StackRocking, request: &StackRequest) {
        /// What the lower body stands on.
        base: &'static str = "compliant";
        /// How it is followed.
        model: &'static str = "stack";
        outcome: &'static str = rocking.outcome.name() => "outcome";
        overturned_body: Option<&'static str> =
            rocking.overturned_body.map(Into::into) => "body that falls";
        end_time_s: f64 => "end";
        /// The lower body.
        lower: LowerBody = LowerBody::of(&rocking.lower);
        /// The upper body.
        upper: UpperBody = UpperBody::of(&rocking.upper, rocking.peak_relative_rotation_rad);
        threshold_upper_g: f64 = request.stack.threshold_upper() => "uplift threshold, upper body alone";
        threshold_together_g: f64 = request.stack.threshold_together() => "uplift threshold, both together";
        /// Shares of the time.
        patterns: StackPatterns = StackPatterns::of(&rocking.patterns);
        energy_error_ratio: f64 = rocking.energy.residual_ratio => "error of the energy balance";
        support: SupportAnswer = SupportAnswer::of(
            &request.stack.support, request.stack.lower.mass_kg, &request.how.settings, rocking.effort,
        ) => flat;
        /// Mass of the upper body.
        upper_mass_kg: f64 = request.stack.upper.mass_kg;
        /// Coefficient of friction between the bodies; none: no slip.
        interface_friction_ratio: Option<f64> = request.stack.interface.friction_ratio;
    }

    /// What a body of a stack did.
    pub struct StackBodyAnswer of (body: &BodyMotion) {
        /// How it ended.
        outcome: &'static str = body.outcome.name();
        /// When the rotation was largest.
        peak_rotation_time_s: f64 = body.peak_tilt_time_s;
        /// Rotation at the end.
        final_rotation_rad: f64 = body.final_tilt_x_rad;
        /// Largest uplift of an edge.
        uplift_m: f64;
        /// When an edge first lifted.
        first_uplift_time_s: Option<f64>;
        /// When it overturned.
        overturn_time_s: Option<f64>;
    }

    /// What the lower body of a stack did.
    pub struct LowerBody of (motion: &BodyMotion) {
        peak_rotation_rad: f64 = motion.peak_tilt_rad => "largest rotation, lower body";
        body: StackBodyAnswer = StackBodyAnswer::of(motion) => flat;
    }

    /// What the upper body of a stack did.
    pub struct UpperBody of (motion: &BodyMotion, peak_relative_rotation_rad: f64) {
        peak_rotation_rad: f64 = motion.peak_tilt_rad => "largest rotation, upper body";
        peak_relative_rotation_rad: f64 = peak_relative_rotation_rad => "  relative to the lower one";
        body: StackBodyAnswer = StackBodyAnswer::of(motion) => flat;
    }

    /// Shares of the time in which a stack moves in a pattern.
    pub struct StackPatterns of (patterns: &Patterns) {
        /// Neither body has an edge off its support.
        rest_ratio: f64;
        same_ratio: f64 => "share of the time: both rock, same sense";
        opposite_ratio: f64 => "  both rock, opposite sense";
        together_ratio: f64 => "  together as one body";
        upper_alone_ratio: f64 => "  the upper body alone";
    }
}

/// What an object in space did.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialReport {
    /// What it did.
    pub answer: SpatialAnswer,
    /// What may make it wrong.
    pub doubts: Vec<HistoryDoubt>,
    /// What its reader must know.
    pub notes: Vec<HistoryNote>,
    /// The shape.
    pub shape: Shape,
    /// Its history.
    pub history: SpatialHistory,
}

/// A stack under a motion.
#[derive(Debug, Clone)]
pub struct StackRequest {
    /// The bodies and what they rest on.
    pub stack: Stack,
    /// How the cushion under the lower body was read.
    pub edge: EdgeCushion,
    /// Horizontal motion of the floor.
    pub horizontal: Option<Motion>,
    /// Vertical motion of the floor.
    pub vertical: Option<Motion>,
    /// Gravity, accuracy, end, samples.
    pub how: HistoryOptions,
}

/// What a stack did.
#[derive(Debug, Clone, PartialEq)]
pub struct StackReport {
    /// What it did.
    pub answer: StackAnswer,
    /// What may make it wrong.
    pub doubts: Vec<HistoryDoubt>,
    /// What its reader must know.
    pub notes: Vec<HistoryNote>,
    /// The stack.
    pub stack: Stack,
    /// Its history.
    pub history: StackHistory,
}

/// The cushion between the bodies of a stack: that under the lower one, or the same law with this
/// stiffness of one edge and the same damping ratio.
///
/// # Errors
/// A stiffness for a law that has none.
pub fn interface(
    cushion: &Cushion,
    stiffness_n_m: Option<f64>,
    lower_kg: f64,
    upper_kg: f64,
) -> Result<Cushion, Problem> {
    let Some(interface_n_m) = stiffness_n_m else {
        return Ok(cushion.clone());
    };
    with_stiffness(cushion, interface_n_m, [lower_kg, upper_kg]).unwrap_or_else(|| {
        Err(Problem::value(
            format!("`interface_stiffness` does not describe a cushion of the law {}", cushion.law().name()),
            "leave it out: the bodies then have the same cushion between them as below; or use a linear law",
        ))
    })
}

/// The law of a cushion with another stiffness, and the damping ratio that it has under the first of
/// two masses under the second; `None` for a law without a stiffness.
fn with_stiffness(
    cushion: &Cushion,
    other_n_m: f64,
    masses_kg: [f64; 2],
) -> Option<Result<Cushion, Problem>> {
    let [from_kg, to_kg] = masses_kg;
    match *cushion.law() {
        ContactLaw::Linear { .. } => Some(damped(to_kg, other_n_m, 0.0)),
        ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        } => Some(damped(
            to_kg,
            other_n_m,
            damping_n_s_m / (2.0 * (stiffness_n_m * from_kg).sqrt()),
        )),
        _ => None,
    }
}

/// The motions along the thickness and along the width of an object that is turned.
fn turned(request: &SpatialRequest) -> Result<[Option<Motion>; 2], Problem> {
    let [first, second] = &request.motions;
    let Some(given) = first.as_ref().or(second.as_ref()) else {
        return Ok([None, None]);
    };
    let too_large = |error: freestand::motion::MotionError| {
        Problem::value(error.to_string(), "scale the motion down")
    };
    let zero = Motion::new(given.dt_s(), vec![0.0; given.accel_m_s2().len()]).map_err(too_large)?;
    let (along, across) = (
        first.clone().unwrap_or_else(|| zero.clone()),
        second.clone().unwrap_or(zero),
    );
    Pair::new(&along, &across).map_err(|error| {
        let hint =
            "resample one of them to the step and length of the other first, with motion convert";
        Problem::value(error.to_string(), hint)
    })?;
    let both = HorizontalMotion {
        along,
        across: Some(across),
    };
    let degrees = request.orientation_rad.to_degrees();
    let part = |angle: f64| {
        both.in_direction(angle)
            .map(|motion| Some(motion.into_owned()))
            .map_err(too_large)
    };
    if degrees == 0.0 {
        return Ok([part(0.0)?, part(90.0)?]);
    }
    Ok([part(degrees)?, part(degrees + 90.0)?])
}

/// Calculates the motion of an object in space.
///
/// # Errors
/// The errors of the solver, each with a hint; motions that differ in step or length; a history that
/// is too long to sample.
pub fn rock_in_space(request: &SpatialRequest) -> Result<SpatialReport, Problem> {
    wall::check(&request.object)?;
    let [x, y] = turned(request)?;
    let motion = SpatialMotion {
        x: x.as_ref(),
        y: y.as_ref(),
        vertical: request.vertical.as_ref(),
    };
    let given = motion.x.or(motion.vertical);
    let object = &request.object;
    let history = object
        .follow(motion, &request.how)
        .map_err(unsolved::problem)?;
    let rocking = &history.rocking;
    let body = &rocking.body;
    let answer = SpatialAnswer::of(body, rocking, request);
    let is_shaken = given.is_some();
    let mut doubts = doubts(
        object.mass_kg,
        &request.edge,
        is_shaken,
        rocking.energy.residual_ratio,
    );
    doubts.extend(unresolved(body.outcome));
    doubts.extend(wall::ends(request, motion)?);
    Ok(SpatialReport {
        answer,
        doubts,
        notes: notes(&request.edge),
        shape: object.shape,
        history,
    })
}

/// The model of a shape, and its name.
fn names(shape: &Shape) -> (&'static str, &'static str) {
    match shape {
        Shape::Prism { .. } => ("compliant-3d", "prism"),
        Shape::Cylinder { .. } => ("compliant-3d", "cylinder"),
        Shape::Plane { .. } => ("compliant", "prism in the plane of its thickness"),
    }
}

/// A value that an object has in three dimensions alone: in the plane there is no width.
fn in_space(shape: &Shape, value: f64) -> Option<f64> {
    (!matches!(shape, Shape::Plane { .. })).then_some(value)
}

fn notes(edge: &EdgeCushion) -> Vec<HistoryNote> {
    let of_cushion = edge.notes.iter().cloned().map(HistoryNote::Cushion);
    std::iter::once(HistoryNote::OneRealisation)
        .chain(of_cushion)
        .collect()
}

fn doubts(
    mass_kg: f64,
    edge: &EdgeCushion,
    is_shaken: bool,
    residual_ratio: f64,
) -> Vec<HistoryDoubt> {
    let of_cushion = edge.stiffness_doubts(mass_kg).into_iter();
    of_cushion
        .map(HistoryDoubt::Validity)
        .chain(rings(&edge.cushion, is_shaken))
        .chain(energy_error(residual_ratio))
        .collect()
}

/// Calculates the motion of a stack.
///
/// # Errors
/// The errors of the solver, each with a hint, and a history that is too long to sample.
pub fn rock_stacked(request: &StackRequest) -> Result<StackReport, Problem> {
    let motion = base(&request.horizontal, &request.vertical);
    let given = motion.horizontal.or(motion.vertical);
    let history = request
        .stack
        .follow(motion, &request.how)
        .map_err(unsolved::problem)?;
    let rocking = &history.rocking;
    let answer = StackAnswer::of(rocking, request);
    let lower_kg = request.stack.lower.mass_kg;
    let mut doubts = doubts(
        lower_kg,
        &request.edge,
        given.is_some(),
        rocking.energy.residual_ratio,
    );
    doubts.extend(unresolved(rocking.outcome));
    Ok(StackReport {
        answer,
        doubts,
        notes: notes(&request.edge),
        stack: request.stack.clone(),
        history,
    })
}

/// The columns of a history in space.
pub const SPATIAL_HISTORY: &str =
    "time_s,tilt_x_rad,tilt_y_rad,tilt_rad,yaw_rad,base_x_m,base_y_m,base_z_m";

/// A row of a history in space.
pub fn spatial_row(point: &SpatialPoint) -> [f64; 8] {
    let ([x, y, tilt], [base_x, base_y, base_z]) = (point.tilts_rad, point.base_m);
    [
        point.time_s,
        x,
        y,
        tilt,
        point.yaw_rad,
        base_x,
        base_y,
        base_z,
    ]
}

/// The columns of the history of a stack.
pub const STACK_HISTORY: &str = "time_s,lower_rotation_rad,upper_rotation_rad";

/// A row of the history of a stack.
pub fn stack_row(point: &StackPoint) -> [f64; 3] {
    [point.time_s, point.rotations_rad[0], point.rotations_rad[1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ζ = c/(2√(k m)) is kept: 0.05 below 100 kg on 4e6 N/m and between, for 16 kg on 1e6 N/m.
    #[test]
    fn an_interface_has_the_damping_ratio_of_the_base() {
        let base = damped(100.0, 4e6, 0.05).unwrap();
        let between = interface(&base, Some(1e6), 100.0, 16.0).unwrap();
        let ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        } = *between.law()
        else {
            panic!("{between:?}")
        };
        assert_eq!(stiffness_n_m, 1e6);
        assert!((damping_n_s_m - 0.1 * (1e6 * 16.0f64).sqrt()).abs() < 1e-9);
        assert_eq!(interface(&base, None, 100.0, 16.0).unwrap(), base);
        let plain = interface(&Cushion::linear(4e6).unwrap(), Some(1e6), 100.0, 16.0).unwrap();
        assert_eq!(plain, Cushion::linear(1e6).unwrap());
        let hertz = Cushion::new(ContactLaw::Power {
            coefficient_n_mn: 1e8,
            exponent: 1.5,
        })
        .unwrap();
        assert!(
            interface(&hertz, Some(1e6), 100.0, 16.0)
                .unwrap_err()
                .hint
                .is_some()
        );
    }

    #[test]
    fn a_prism_has_a_width_and_a_cylinder_a_diameter() {
        assert!(shape(ShapeName::Prism, 2.0, 0.5, None).is_err());
        assert!(shape(ShapeName::Cylinder, 2.0, 0.5, Some(0.6)).is_err());
        let round = Shape::Cylinder {
            diameter_m: 0.5,
            height_m: 2.0,
        };
        assert_eq!(shape(ShapeName::Cylinder, 2.0, 0.5, None), Ok(round));
        assert_eq!(shape(ShapeName::Cylinder, 2.0, 0.5, Some(0.5)), Ok(round));
        let prism = Shape::Prism {
            thickness_m: 0.5,
            width_m: 0.7,
            height_m: 2.0,
        };
        assert_eq!(shape(ShapeName::Prism, 2.0, 0.5, Some(0.7)), Ok(prism));
    }

    /// Turned anticlockwise by 90°, the object meets the first motion along its width, from the
    /// right as seen along it: along the width a₁ cos 90° … = −a₁ sin 90°.
    #[test]
    fn a_turned_object_meets_turned_motions() {
        let motion = |scale: f64| Motion::new(0.01, vec![0.0, scale, 2.0 * scale]).unwrap();
        let edge = EdgeCushion {
            cushion: Cushion::linear(4e6).unwrap(),
            pad_thickness_m: None,
            notes: Vec::new(),
        };
        let request = |orientation_rad: f64| SpatialRequest {
            object: SpatialObject {
                shape: Shape::Cylinder {
                    diameter_m: 0.5,
                    height_m: 1.8,
                },
                mass_kg: 200.0,
                support: Support::new(edge.cushion.clone()),
                walls: Vec::new(),
            },
            wall_cushion: GivenCushion::default(),
            edge: edge.clone(),
            motions: [Some(motion(1.0)), Some(motion(0.5))],
            vertical: None,
            orientation_rad,
            how: HistoryOptions::default(),
        };
        let last = |orientation_rad: f64| {
            turned(&request(orientation_rad))
                .unwrap()
                .map(|m| m.unwrap().accel_m_s2()[2])
        };
        assert_eq!(last(0.0), [2.0, 1.0]);
        let [x, y] = last(std::f64::consts::FRAC_PI_2);
        assert!(
            (x - 1.0).abs() < 1e-12 && (y + 2.0).abs() < 1e-12,
            "{x} {y}"
        );
        let [x, y] = last(0.3);
        assert!((x.hypot(y) - 5f64.sqrt()).abs() < 1e-12);
    }
}
