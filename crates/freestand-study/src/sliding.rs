//! A block that slides, or an object on casters: its travel, what it reaches, and whether a stop
//! would overturn it.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::impact::ASSUMED_FRICTION;
use freestand::motion::Motion;
use freestand::respond::{
    Along, Glider, HistoryOptions, Plane, PlaneSlideHistory, Planes, SlideHistory, SlidePoint,
};
use freestand::rocking::{Base, RockingError};
use freestand::sliding::{
    Clearance, Friction, PlaneMotion, PlanePoint, PlaneSliding, Sliding, SlidingOutcome,
    trip_speed_m_s,
};

use crate::doubt::HistoryDoubt;
use crate::rock::RockImpact;
use crate::unsolved::{self, base, rocking_problem, sliding_problem};
use freestand_input::problem::Problem;
use freestand_input::words::significant;
use freestand_output::answer;

/// Rolling resistance of casters on a usual floor: 0.01 on a hard floor, 0.05 on carpet. From
/// memory; it decreases with the diameter of the wheel and depends on the floor covering (Gille and
/// Clerc-Urmès 2024, 44 wheels on 5 floors).
pub const DEFAULT_ROLLING_RESISTANCE: f64 = 0.02;

/// What is under an object that does not rock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contact {
    /// A base that slides.
    Base,
    /// Casters that roll.
    Casters,
    /// Casters with brakes, whose wheels slide.
    BrakedCasters,
}

impl Contact {
    /// The model of the object in every output: `slide` or `roll`.
    pub fn model(self) -> &'static str {
        match self {
            Self::Base | Self::BrakedCasters => "slide",
            Self::Casters => "roll",
        }
    }
}

/// What was given about the contact; what is missing gets its default.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceGiven {
    /// What is under the object.
    pub contact: Contact,
    /// μ_s of a base or of braked wheels.
    pub friction: Option<f64>,
    /// μ_k; μ_s if missing.
    pub friction_kinetic: Option<f64>,
    /// μ_r of casters that roll.
    pub rolling_resistance: Option<f64>,
    /// Room on both sides.
    pub clearance: Clearance,
}

/// The contact of an object that slides or rolls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// What is under the object.
    pub contact: Contact,
    /// Friction, or rolling resistance.
    pub friction: Friction,
    /// Room on both sides.
    pub clearance: Clearance,
    /// Whether the coefficient is a default.
    is_assumed: bool,
}

impl Surface {
    /// The contact with its defaults.
    ///
    /// # Errors
    /// Coefficients that are impossible, or μ_k above μ_s.
    pub fn new(given: &SurfaceGiven) -> Result<Self, Problem> {
        let (ratio, default) = match given.contact {
            Contact::Base | Contact::BrakedCasters => (given.friction, ASSUMED_FRICTION),
            Contact::Casters => (given.rolling_resistance, DEFAULT_ROLLING_RESISTANCE),
        };
        let static_ratio = ratio.unwrap_or(default);
        let friction = Friction::new(static_ratio, given.friction_kinetic.unwrap_or(static_ratio))
            .map_err(sliding_problem)?;
        Ok(Self {
            contact: given.contact,
            friction,
            clearance: given.clearance,
            is_assumed: ratio.is_none(),
        })
    }

    /// The key of its coefficient.
    fn key(&self) -> &'static str {
        match self.contact {
            Contact::Base | Contact::BrakedCasters => "friction",
            Contact::Casters => "rolling_resistance",
        }
    }

    /// Whether `block` slides on it, and never rocks. Braked casters that hold let it rock.
    ///
    /// # Errors
    /// A base or casters that were said to slide, but hold the block until an edge lifts.
    pub fn carries(&self, block: &Block) -> Result<bool, Problem> {
        if self.friction.is_below_uplift(block) {
            return Ok(true);
        }
        match self.contact {
            Contact::BrakedCasters => Ok(false),
            Contact::Base | Contact::Casters => Err(self.refused(block)),
        }
    }

    fn refused(&self, block: &Block) -> Problem {
        let limit = freestand::rocking::RockingModel::Rigid.uplift_threshold_ratio(block);
        let message = format!(
            "with a coefficient of {} an edge lifts before the object {}: it may rock and slide at once (this model \
             holds up to {}, half the base width over the height of the centre of gravity)",
            self.friction.static_ratio(),
            if self.contact == Contact::Casters {
                "rolls"
            } else {
                "slides"
            },
            significant(limit, 4),
        );
        Problem::value(
            message,
            format!(
                "use `base` compliant with `friction`, or a smaller `{}`",
                self.key()
            ),
        )
    }

    /// A block on it, as it is followed.
    fn glider(&self, block: Block, yaw_rad: f64) -> Glider {
        let along = Along::X;
        Glider {
            planes: Planes::single(Plane { along, block }),
            friction: self.friction,
            clearance: self.clearance,
            yaw_rad,
        }
    }
}

/// An object that slides under a motion.
#[derive(Debug, Clone)]
pub struct SlideRequest {
    /// The object.
    pub block: Block,
    /// What is under it.
    pub surface: Surface,
    /// Horizontal motion of its base.
    pub horizontal: Option<Motion>,
    /// Horizontal motion of its base at right angles to that, to its left.
    pub across: Option<Motion>,
    /// Vertical motion of its base.
    pub vertical: Option<Motion>,
    /// How far it is turned from the direction of the motion, anticlockwise from above \[rad\].
    pub orientation_rad: f64,
    /// Whether it is known to slide across its width before it rocks.
    pub slides_across: bool,
    /// What is at the end of the clearance, for the shock there.
    pub stop: Option<StopShock>,
    /// Gravity, end, samples.
    pub how: HistoryOptions,
}

impl SlideRequest {
    /// Whether it may move along both of its axes.
    pub fn moves_in_plane(&self) -> bool {
        self.across.is_some() || self.orientation_rad != 0.0
    }
}

/// A stop that an object on it strikes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopShock {
    /// Mass of the object \[kg\].
    pub mass_kg: f64,
    /// k_s \[N/m\].
    pub stiffness_n_m: f64,
}

impl StopShock {
    /// A stop with what it needs; `None` if its stiffness is not given.
    ///
    /// # Errors
    /// A stiffness without a mass, or without a clearance at whose end the stop is.
    pub fn new(
        stiffness_n_m: Option<f64>,
        mass_kg: Option<f64>,
        clearance: &Clearance,
    ) -> Result<Option<Self>, Problem> {
        let Some(stiffness_n_m) = stiffness_n_m else {
            return Ok(None);
        };
        if clearance.left_m.is_none() && clearance.right_m.is_none() {
            return Err(Problem::value(
                "there is no stop: its distance from the object is missing",
                "give `clearance_left` or `clearance_right`; 0 where they touch",
            ));
        }
        let Some(mass_kg) = mass_kg else {
            let message = "the stiffness of the stop is used for the shock, which also needs the mass of the object";
            return Err(Problem::value(
                message,
                "add `mass`, or leave `stop_stiffness` out",
            ));
        };
        Ok(Some(Self {
            mass_kg,
            stiffness_n_m,
        }))
    }

    /// v √(k_s/m): peak of the half-sine with which an elastic stop turns the speed round
    /// \[m/s²\]. The object does not turn about the stop, which is level with its centre of gravity.
    ///
    /// # Example
    /// 1 m/s onto 100 N/mm with 100 kg: √1000 m/s².
    /// ```
    /// use freestand_study::sliding::StopShock;
    /// let stop = StopShock { mass_kg: 100.0, stiffness_n_m: 1e5 };
    /// assert!((stop.acceleration_m_s2(-1.0) - 1e3f64.sqrt()).abs() < 1e-12);
    /// ```
    pub fn acceleration_m_s2(&self, velocity_m_s: f64) -> f64 {
        velocity_m_s.abs() * (self.stiffness_n_m / self.mass_kg).sqrt()
    }
}

answer! {
    /// The slide of an object.
    pub struct SlideAnswer of (sliding: &Sliding, request: &SlideRequest) {
        outcome: &'static str = sliding.outcome.name() => "outcome";
        model: &'static str = request.surface.contact.model() => "model";
        end_time_s: f64 => "end";
        slide_peak_m: f64 = sliding.peak_m => "largest slide";
        slide_peak_time_s: Option<f64> = sliding.peak_time_s => "  at";
        slide_final_m: f64 = sliding.final_m => "slide at the end";
        slide_path_m: f64 = sliding.path_m => "length of the path";
        slide_speed_max_m_s: f64 = sliding.speed_max_m_s => "largest speed";
        slide_count: usize => "slides from rest";
        first_slide_time_s: Option<f64> => "  first at";
        clearance_left_m: Option<f64> = request.surface.clearance.left_m => "clearance to the left";
        clearance_right_m: Option<f64> = request.surface.clearance.right_m => "clearance to the right";
        clearance_time_s: Option<f64> = sliding.contact.map(|(time_s, _)| time_s) => "clearance reached at";
        clearance_speed_m_s: Option<f64> =
            sliding.contact.map(|(_, velocity_m_s)| velocity_m_s) => "  with the velocity";
        stop_acceleration_g: Option<f64> = request.stop.zip(sliding.contact)
            .map(|(stop, (_, velocity_m_s))| stop.acceleration_m_s2(velocity_m_s) / G0_M_S2)
            => "  shock of the stop there";
        trip_speed_m_s: f64 =
            trip_speed_m_s(&request.block, request.how.settings.gravity_m_s2) => "speed at which a stop trips it";
        friction_ratio: f64 = request.surface.friction.static_ratio() => "friction or rolling resistance";
        friction_kinetic_ratio: f64 = request.surface.friction.kinetic_ratio() => "  while it moves";
        slide_threshold_g: f64 =
            request.surface.friction.static_ratio() * request.how.settings.gravity_m_s2 / G0_M_S2 => "slides above";
        /// It does not rock.
        peak_rotation_rad: f64 = 0.0;
        /// It does not rock.
        uplift_m: f64 = 0.0;
        /// It does not rock.
        cg_rise_m: f64 = 0.0;
        /// It does not rock.
        impact_count: usize = 0;
        /// It does not rock.
        impacts: Vec<RockImpact> = Vec::new();
    }
}

answer! {
    /// The slide of an object under both components of its floor.
    pub struct PlaneSlideAnswer of (sliding: &PlaneSliding, request: &SlideRequest) {
        outcome: &'static str = plane_outcome(sliding).name() => "outcome";
        model: &'static str = request.surface.contact.model() => "model";
        end_time_s: f64 => "end";
        slide_peak_m: f64 = sliding.peak_m => "largest distance from its place";
        slide_left_m: f64 = sliding.farthest_m[0][0] => "  farthest to the left";
        slide_right_m: f64 = sliding.farthest_m[0][1] => "  to the right";
        slide_front_m: f64 = sliding.farthest_m[1][0] => "  to the front";
        slide_back_m: f64 = sliding.farthest_m[1][1] => "  to the back";
        slide_final_x_m: f64 = sliding.final_m[0] => "at the end, to the right";
        slide_final_y_m: f64 = sliding.final_m[1] => "  to the back";
        slide_path_m: f64 = sliding.path_m => "length of the path";
        slide_speed_max_m_s: f64 = sliding.speed_max_m_s => "largest speed";
        clearance_left_m: Option<f64> = request.surface.clearance.left_m => "clearance to the left";
        clearance_right_m: Option<f64> = request.surface.clearance.right_m => "clearance to the right";
        clearance_time_s: Option<f64> = sliding.contacts[0].map(|(time_s, _)| time_s) => "clearance reached at";
        clearance_speed_m_s: Option<f64> =
            sliding.contacts[0].map(|(_, velocity_m_s)| velocity_m_s) => "  with the velocity to the right";
        stop_acceleration_g: Option<f64> = request.stop.zip(sliding.contacts[0])
            .map(|(stop, (_, velocity_m_s))| stop.acceleration_m_s2(velocity_m_s) / G0_M_S2)
            => "  shock of the stop there";
        trip_speed_m_s: f64 =
            trip_speed_m_s(&request.block, request.how.settings.gravity_m_s2) => "speed at which a stop trips it";
        friction_ratio: f64 = request.surface.friction.static_ratio() => "friction or rolling resistance";
        friction_kinetic_ratio: f64 = request.surface.friction.kinetic_ratio() => "  while it moves";
        slide_threshold_g: f64 =
            request.surface.friction.static_ratio() * request.how.settings.gravity_m_s2 / G0_M_S2 => "slides above";
    }
}

fn plane_outcome(sliding: &PlaneSliding) -> SlidingOutcome {
    if sliding.path_m > 0.0 {
        SlidingOutcome::Slid
    } else {
        SlidingOutcome::Stuck
    }
}

/// The slide of an object under both components of its floor.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneSlideReport {
    /// What it did.
    pub answer: PlaneSlideAnswer,
    /// What may make it wrong.
    pub doubts: Vec<HistoryDoubt>,
    /// Its history.
    pub history: PlaneSlideHistory,
}

/// The slide of an object.
#[derive(Debug, Clone, PartialEq)]
pub struct SlideReport {
    /// What it did.
    pub answer: SlideAnswer,
    /// What may make it wrong.
    pub doubts: Vec<HistoryDoubt>,
    /// Its history.
    pub history: SlideHistory,
}

/// Calculates the slide.
///
/// # Errors
/// A block that this surface holds until it rocks, free flight, and input that the solver refuses.
pub fn slide(request: &SlideRequest) -> Result<SlideReport, Problem> {
    let SlideRequest { block, surface, .. } = request;
    if !surface.carries(block)? {
        return Err(surface.refused(block));
    }
    let base = base(&request.horizontal, &request.vertical);
    let glider = surface.glider(*block, 0.0);
    let history = glider
        .follow(base, &request.how)
        .map_err(unsolved::problem)?;
    if history.sliding.outcome == SlidingOutcome::FreeFlight {
        return Err(rocking_problem(RockingError::FreeFlight {
            time_s: history.sliding.end_time_s,
        }));
    }
    Ok(SlideReport {
        answer: SlideAnswer::of(&history.sliding, request),
        doubts: doubts(
            request,
            history.sliding.contact,
            history.sliding.final_velocity_m_s,
        ),
        history,
    })
}

/// Calculates the slide under both components; one that is missing does not move. An object that is turned meets
/// both under one.
///
/// # Errors
/// As for [`slide`].
pub fn slide_under_both(request: &SlideRequest) -> Result<PlaneSlideReport, Problem> {
    let SlideRequest { block, surface, .. } = request;
    if !surface.carries(block)? {
        return Err(surface.refused(block));
    }
    let size = |motion: &Motion| (motion.dt_s(), motion.accel_m_s2().len());
    if let Some((x, y)) = request.horizontal.as_ref().zip(request.across.as_ref())
        && size(x) != size(y)
    {
        let message = "both components of the motion must have the same step and length";
        let hint = "resample one of them to the step and length of the other first";
        return Err(Problem::value(message, hint).of(&["motion_y"]));
    }
    let given = [&request.horizontal, &request.across, &request.vertical];
    let Some(any) = given.into_iter().flatten().next() else {
        return Err(rocking_problem(RockingError::Duration { duration_s: 0.0 }));
    };
    let still = any.scaled(0.0).map_err(|error| {
        Problem::value(
            error.to_string(),
            "check the unit and the scale of the motion",
        )
    })?;
    let motion = PlaneMotion {
        x: request.horizontal.as_ref().unwrap_or(&still),
        y: request.across.as_ref().unwrap_or(&still),
        vertical: request.vertical.as_ref(),
    };
    let glider = surface.glider(*block, request.orientation_rad);
    let history = glider
        .follow_in_plane(motion, &request.how)
        .map_err(unsolved::problem)?;
    if let Some(time_s) = history.sliding.free_flight_time_s {
        return Err(rocking_problem(RockingError::FreeFlight { time_s }));
    }
    let mut doubts = doubts(
        request,
        history.sliding.contacts[0],
        history.sliding.final_speed_m_s,
    );
    if !request.slides_across {
        doubts.push(HistoryDoubt::MayRockAcross);
    }
    Ok(PlaneSlideReport {
        answer: PlaneSlideAnswer::of(&history.sliding, request),
        doubts,
        history,
    })
}

/// The slide of a block on this surface under one motion, which does not depend on its size, until
/// it rests, or up to free flight.
///
/// # Errors
/// Input that the solver refuses.
pub fn slide_under(surface: &Surface, block: Block, base: Base) -> Result<Sliding, Problem> {
    let found = surface
        .glider(block, 0.0)
        .follow(base, &HistoryOptions::default());
    found.map(|found| found.sliding).map_err(unsolved::problem)
}

fn doubts(
    request: &SlideRequest,
    contact: Option<(f64, f64)>,
    final_velocity_m_s: f64,
) -> Vec<HistoryDoubt> {
    let surface = &request.surface;
    let assumed = surface.is_assumed.then(|| HistoryDoubt::Assumed {
        key: surface.key(),
        ratio: surface.friction.static_ratio(),
    });
    let trip_m_s = trip_speed_m_s(&request.block, request.how.settings.gravity_m_s2);
    let trips = contact
        .map(|(_, velocity_m_s)| velocity_m_s.abs())
        .filter(|speed_m_s| *speed_m_s >= trip_m_s)
        .map(|speed_m_s| HistoryDoubt::Trips {
            speed_m_s,
            trip_m_s,
        });
    let moves = (final_velocity_m_s != 0.0).then_some(HistoryDoubt::StillMoves);
    assumed.into_iter().chain(trips).chain(moves).collect()
}

/// The columns of a history.
pub const HISTORY: &str = "time_s,slide_m,velocity_m_s,base_accel_m_s2";

/// A row of a history.
pub fn history_row(point: &SlidePoint) -> [f64; 4] {
    [
        point.time_s,
        point.slide_m,
        point.velocity_m_s,
        point.base_accel_m_s2,
    ]
}

/// The columns of a history under both components, along the axes of the object.
pub const PLANE_HISTORY: &str =
    "time_s,slide_x_m,slide_y_m,velocity_x_m_s,velocity_y_m_s,base_accel_x_m_s2,base_accel_y_m_s2";

/// A row of a history under both components.
pub fn plane_history_row(point: &PlanePoint) -> [f64; 7] {
    let PlanePoint {
        time_s,
        place_m: [x, y],
        velocity_m_s: [v_x, v_y],
        base_accel_m_s2: [a_x, a_y],
    } = *point;
    [time_s, x, y, v_x, v_y, a_x, a_y]
}
