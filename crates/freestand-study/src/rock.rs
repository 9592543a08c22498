//! One rocking history, with what an engineer needs from it: shock, friction, validity.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::impact::{
    ASSUMED_FRICTION, ImpactModel, ValidityWarning, impact_friction_needed_ratio,
};
use freestand::motion::Motion;
use freestand::respond::{HistoryOptions, RigidHistory, RigidPlane};
use freestand::rocking::{
    Accuracy, HistoryPoint, LONGEST_TAIL_S, Outcome, Rocking, RockingImpact, RockingModel, Until,
};
use freestand::spectra::{ShockCell, UpliftCell, landings};

use crate::cushion::EdgeCushion;
use crate::doubt::{HistoryDoubt, HistoryNote};
use crate::shape::Sizes;
use crate::unsolved::{self, base, unresolved};
use crate::walls::{WallAnswer, WallStiffness};
use freestand_input::problem::Problem;
use freestand_input::words::{Choices, name_of};
use freestand_output::answer;

/// The equations of motion by name.
pub const MODELS: Choices<RockingModel> = &[
    (RockingModel::Rigid, "rigid", "The exact equation of motion"),
    (
        RockingModel::Linearised,
        "linear",
        "Linearised (sin x → x, tan α → α), for comparison with closed forms",
    ),
];

/// Accuracies by name.
pub const ACCURACIES: Choices<Accuracy> = &[
    (
        Accuracy::Fast,
        "fast",
        "Error of 1e-9 per step; rotations in spectra to about 1e-7",
    ),
    (
        Accuracy::Standard,
        "standard",
        "Error of 1e-13 per step; rotations in spectra to 1e-9 or better",
    ),
    (
        Accuracy::Tight,
        "tight",
        "The limit of double precision; nearly so in spectra",
    ),
];

/// When a history ends: at a time that was given \[s\], else when the object rests or lies after
/// the last sample.
pub fn until(duration_s: Option<f64>) -> Until {
    duration_s.map_or(
        Until::Settled {
            at_most_s: LONGEST_TAIL_S,
        },
        Until::Time,
    )
}

/// An object under a motion.
#[derive(Debug, Clone)]
pub struct RockRequest {
    /// The object.
    pub object: RigidPlane,
    /// Horizontal motion of its base.
    pub horizontal: Option<Motion>,
    /// Vertical motion of its base.
    pub vertical: Option<Motion>,
    /// Model, accuracy, initial state, end, samples.
    pub how: HistoryOptions,
    /// Mass \[kg\] and the cushion under one edge, for the shock.
    pub cushion: Option<(f64, EdgeCushion)>,
    /// Mass and stiffness for the shock on a wall.
    pub wall: WallStiffness,
    /// Coefficient of friction, for the warning against sliding.
    pub friction: Option<f64>,
}

answer! {
    /// What an object on a rigid base did.
    pub struct RockAnswer of (
        rocking: &Rocking,
        block: &Block,
        request: &RockRequest,
        friction: Option<f64>,
        impact_friction: f64,
        shock: Option<ShockCell>,
        landed: &[EdgeLanding],
    ) {
        outcome: &'static str = rocking.outcome.name() => "outcome";
        stopped: &'static str = rocking.stop.name() => "reason for the end";
        end_time_s: f64 => "end";
        peak_rotation_rad: f64 => "largest rotation";
        /// The largest rotation divided by the angle α at which the object balances on that edge.
        peak_rotation_ratio: f64 = peak_rotation_ratio(block, rocking) => "  divided by α";
        peak_rotation_time_s: Option<f64> =
            rocking.peak_rotation_time_s.filter(|_| rocking.outcome != Outcome::NoUplift) => "  at";
        /// Largest uplift of an edge.
        uplift_m: f64 => "uplift";
        cg_rise_m: f64 => "rise of the centre of gravity";
        first_uplift_time_s: Option<f64> => "first uplift";
        /// How often the object left its base.
        uplift_count: usize;
        impact_count: usize = rocking.impacts.len() => "impacts";
        /// All impacts on the floor.
        impacts: Vec<RockImpact> =
            rocking.impacts.iter().zip(landed).map(|(impact, landed)| RockImpact::of(impact, landed)).collect();
        walls: WallAnswer = WallAnswer::of(rocking, block, request.wall) => flat;
        passed_alpha_time_s: Option<f64> => "passes the balance point";
        overturn_time_s: Option<f64> => "overturns";
        rest_time_s: Option<f64> => "comes to rest";
        /// Whether it is at rest at the end.
        at_rest: bool;
        friction_needed_ratio: Option<f64> =
            friction.filter(|ratio| ratio.is_finite()) => "friction needed while rocking";
        impact_friction_needed_ratio: f64 = impact_friction => "friction needed in an impact";
        restitution_ratio: f64 => "restitution";
        /// Rotation at the end.
        final_rotation_rad: f64;
        /// Angular velocity at the end.
        final_omega_rad_s: f64;
        /// R: from the left edge to the centre of gravity.
        half_diagonal_m: f64 = block.pivot().half_diagonal_m;
        /// α of the left edge.
        slenderness_angle_rad: f64 = block.pivot().slenderness_angle_rad;
        frequency_parameter_rad_s: f64 =
            block.pivot().frequency_parameter_rad_s(request.how.settings.gravity_m_s2) => "frequency parameter p";
        uplift_threshold_g: f64 =
            request.how.settings.model.uplift_threshold_ratio(block) * request.how.settings.gravity_m_s2 / G0_M_S2
            => "uplift threshold";
        /// The equation of motion.
        model: &'static str = name_of(MODELS, request.how.settings.model);
        /// What the object stands on.
        base: &'static str = "rigid";
        /// The accuracy of the solver.
        accuracy: String = crate::summary::accuracy_words(request.how.settings.accuracy);
        edge_acceleration_g: Option<f64> =
            shock.and_then(|shock| shock.edge_acceleration_g) => "shock, from the uplift";
        edge_acceleration_impact_velocity_g: Option<f64> =
            shock.and_then(|shock| shock.edge_acceleration_impact_velocity_g) => "shock, from the impact velocity";
        ceiling_g: Option<f64> = shock.map(|shock| shock.ceiling_g) => "ceiling of the shock";
        /// Steps of the solver.
        steps: usize = rocking.effort.steps;
        /// Evaluations of the equation of motion.
        evaluations: usize = rocking.effort.evaluations;
    }

    /// An impact on the floor.
    pub struct RockImpact of (impact: &RockingImpact, landed: &EdgeLanding) {
        /// When it happened.
        time_s: f64;
        /// Angular velocity before the impact, signed.
        omega_before_rad_s: f64;
        /// Angular velocity after the impact.
        omega_after_rad_s: f64;
        /// Shock of the edge that lands, from the speed of the impact.
        edge_acceleration_impact_velocity_g: Option<f64> = landed.edge_acceleration_g;
    }
}

/// The response of an object.
#[derive(Debug, Clone, PartialEq)]
pub struct RockReport {
    /// What it did.
    pub answer: RockAnswer,
    /// What may make it wrong.
    pub doubts: Vec<HistoryDoubt>,
    /// What its reader must know.
    pub notes: Vec<HistoryNote>,
    /// Its history.
    pub history: RigidHistory,
    /// Its impacts on the floor.
    pub landings: Vec<EdgeLanding>,
}

/// An impact on the floor, with its shock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeLanding {
    /// Time \[s\].
    pub time_s: f64,
    /// ω⁻, signed \[rad/s\].
    pub omega_before_rad_s: f64,
    /// Shock of the edge that lands, from the speed of the impact \[g\]; `None` without mass and cushion.
    pub edge_acceleration_g: Option<f64>,
}

/// The impacts of a history on the floor; `body` is the mass \[kg\] and the cushion under one edge.
pub fn edge_landings(
    block: &Block,
    rocking: &Rocking,
    body: Option<(f64, &Cushion)>,
    gravity_m_s2: f64,
) -> Vec<EdgeLanding> {
    let landings = landings(block, ImpactModel::Paper);
    let shock_of = |omega: f64| {
        body.map(|(mass_kg, cushion)| {
            // A block on its right edge (θ > 0) comes back with ω < 0.
            let landing = &landings[usize::from(omega > 0.0)];
            let rise_m = landing.equivalent_rise_m(omega, gravity_m_s2);
            landing.edge_acceleration_m_s2(mass_kg, cushion, rise_m, gravity_m_s2) / G0_M_S2
        })
    };
    let landed = |i: &RockingImpact| EdgeLanding {
        time_s: i.time_s,
        omega_before_rad_s: i.omega_before_rad_s,
        edge_acceleration_g: shock_of(i.omega_before_rad_s),
    };
    rocking.impacts.iter().map(landed).collect()
}

/// Calculates the response of the object.
///
/// # Errors
/// An input that the solver refuses, with a hint.
pub fn rock(request: &RockRequest) -> Result<RockReport, Problem> {
    let base = base(&request.horizontal, &request.vertical);
    let history = request
        .object
        .follow(base, &request.how)
        .map_err(unsolved::problem)?;
    Ok(report(request, history))
}

fn report(request: &RockRequest, history: RigidHistory) -> RockReport {
    let (block, settings) = (&request.object.plane.block, &request.how.settings);
    let (rocking, friction) = (&history.rocking, history.friction_needed_ratio);
    let gravity = settings.gravity_m_s2;

    let cell = UpliftCell::new(*block, rocking);
    let landings = landings(block, ImpactModel::Paper);
    let impact_friction = [*block, block.mirrored()]
        .map(|block| impact_friction_needed_ratio(&block, rocking.restitution_ratio))
        .into_iter()
        .fold(0.0, f64::max);
    let cushion = request.cushion.as_ref();
    let shock =
        cushion.map(|(mass, edge)| cell.shock(*mass, &edge.cushion, ImpactModel::Paper, gravity));
    let body = cushion.map(|(mass, edge)| (*mass, &edge.cushion));
    let landed = edge_landings(block, rocking, body, gravity);

    let sizes = Sizes::of(block).doubts();
    let mut doubts: Vec<HistoryDoubt> = sizes.into_iter().map(HistoryDoubt::Size).collect();
    if block.landing_ratio() < 0.0 {
        doubts.push(HistoryDoubt::Validity(ValidityWarning::Squat {
            landing_ratio: block.landing_ratio(),
        }));
    }
    doubts.extend(unresolved(rocking.outcome));
    let walls = &request.object.walls;
    doubts.extend(crate::walls::doubts(block, walls, rocking.contacts));
    if let Some((mass, edge)) = cushion {
        let mut of_cushion = edge.stiffness_doubts(*mass);
        let impacts = landings.iter().zip(rocking.sides).map(|(landing, side)| {
            let rise_m = landing.pivot.largest_rise_m(side.peak_rotation_rad);
            landing.impact(*mass, &edge.cushion, rise_m, gravity)
        });
        if let Some(deepest) = impacts.max_by(|a, b| a.compression_m.total_cmp(&b.compression_m)) {
            of_cushion.extend(edge.compression_doubts(deepest.compression_m));
        }
        doubts.extend(of_cushion.into_iter().map(HistoryDoubt::Validity));
    }
    let friction_ratio = request.friction.unwrap_or(ASSUMED_FRICTION);
    let mut sliding = |needed_ratio: f64, in_impact: bool| {
        if needed_ratio > friction_ratio {
            let warning = ValidityWarning::Sliding {
                needed_ratio,
                friction_ratio,
                in_impact,
            };
            doubts.push(match request.friction {
                Some(_) => HistoryDoubt::Validity(warning),
                None => HistoryDoubt::SlidesByAssumption(warning),
            });
        }
    };
    if let Some(needed) = friction {
        if needed.is_finite() {
            sliding(needed, false);
        }
        if !rocking.impacts.is_empty() {
            sliding(impact_friction, true);
        }
    }
    if friction.is_some_and(f64::is_infinite) {
        doubts.push(HistoryDoubt::LeavesTheFloor);
    }
    let on_pads = shock.map(|_| HistoryNote::PadsForShockAlone);
    let leans = rocking.leaning.then_some(HistoryNote::Leans);
    let notes = leans.into_iter().chain(on_pads).collect();

    let answer = RockAnswer::of(
        rocking,
        block,
        request,
        friction,
        impact_friction,
        shock,
        &landed,
    );
    RockReport {
        answer,
        doubts,
        notes,
        history,
        landings: landed,
    }
}

/// The largest rotation as a share of the slenderness angle of its side.
fn peak_rotation_ratio(block: &Block, rocking: &Rocking) -> f64 {
    let landings = landings(block, ImpactModel::Paper);
    let sides = landings.iter().zip(rocking.sides);
    sides
        .map(|(landing, side)| side.peak_rotation_rad / landing.pivot.slenderness_angle_rad)
        .fold(0.0, f64::max)
}

/// The columns of a history.
pub const HISTORY: &str = "time_s,theta_rad,omega_rad_s,uplift_m,base_accel_m_s2";

/// A row of a history: time, rotation, angular velocity, uplift, base acceleration.
pub fn history_row(block: &Block, point: &HistoryPoint) -> [f64; 5] {
    let uplift_m = block.base_width_m() * point.theta_rad.abs().sin();
    [
        point.time_s,
        point.theta_rad,
        point.omega_rad_s,
        uplift_m,
        point.base_accel_m_s2,
    ]
}
