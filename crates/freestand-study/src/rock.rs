//! One rocking history, with what an engineer asks of it: shock, friction, validity.

use freestand::block::Block;
use freestand::impact::{
    ASSUMED_FRICTION, ImpactModel, ValidityWarning, compression_warnings, impact_friction_needed_ratio,
    stiffness_warnings,
};
use freestand::motion::{MAX_SAMPLES, Motion};
use freestand::rocking::Outcome;
use freestand::rocking::{
    Base, HistoryPoint, HistoryRecorder, Rocking, RockingError, RockingOptions, Until, rock_observed,
};
use freestand::spectra::{UpliftCell, landings};
use freestand::{G0_M_S2, rocking};
use serde::Serialize;

use crate::cushion::EdgeCushion;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::push_shortest;

/// Sampling of a history without a motion \[s\].
const FREE_HISTORY_DT_S: f64 = 0.005;

/// An object under a motion.
#[derive(Debug, Clone)]
pub struct RockRequest {
    /// The object.
    pub block: Block,
    /// Horizontal motion of its base.
    pub horizontal: Option<Motion>,
    /// Vertical motion of its base.
    pub vertical: Option<Motion>,
    /// Model, restitution, accuracy, initial state, end.
    pub options: RockingOptions,
    /// Mass \[kg\] and what stands under one edge, for the shock.
    pub cushion: Option<(f64, EdgeCushion)>,
    /// Coefficient of friction that sliding is judged by.
    pub friction: Option<f64>,
}

/// One impact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ImpactReport {
    /// When \[s\].
    pub time_s: f64,
    /// ω⁻ \[rad/s\].
    pub omega_before_rad_s: f64,
    /// ω⁺ \[rad/s\].
    pub omega_after_rad_s: f64,
    /// Shock by the impact velocity \[g\]; `None` without mass and stiffness.
    pub edge_acceleration_impact_velocity_g: Option<f64>,
}

/// What the object did: the keys of `freestand rock --json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct RockReport {
    pub outcome: &'static str,
    pub stopped: &'static str,
    pub end_time_s: f64,
    pub peak_rotation_rad: f64,
    pub peak_rotation_ratio: f64,
    pub peak_rotation_time_s: Option<f64>,
    pub uplift_m: f64,
    pub cg_rise_m: f64,
    pub first_uplift_time_s: Option<f64>,
    pub uplift_count: usize,
    pub impact_count: usize,
    pub impacts: Vec<ImpactReport>,
    pub passed_alpha_time_s: Option<f64>,
    pub overturn_time_s: Option<f64>,
    pub rest_time_s: Option<f64>,
    pub at_rest: bool,
    pub friction_needed_ratio: Option<f64>,
    pub impact_friction_needed_ratio: f64,
    pub restitution_ratio: f64,
    pub final_rotation_rad: f64,
    pub final_omega_rad_s: f64,
    pub half_diagonal_m: f64,
    pub slenderness_angle_rad: f64,
    pub frequency_parameter_rad_s: f64,
    pub uplift_threshold_g: f64,
    pub model: &'static str,
    pub accuracy: String,
    pub edge_acceleration_g: Option<f64>,
    pub edge_acceleration_impact_velocity_g: Option<f64>,
    pub ceiling_g: Option<f64>,
    pub steps: usize,
    pub evaluations: usize,
    #[serde(skip)]
    pub warnings: Vec<String>,
    #[serde(skip)]
    pub history: Vec<HistoryPoint>,
}

/// Follows the object; the history is sampled only if `record` says so.
///
/// # Errors
/// What the solver refuses, with a hint.
pub fn rock(request: &RockRequest, record: bool) -> Result<RockReport, Problem> {
    let base = Base { horizontal: request.horizontal.as_ref(), vertical: request.vertical.as_ref() };
    let sampled = base.horizontal.map_or(FREE_HISTORY_DT_S, Motion::dt_s);
    if let Until::Time(end_s) = request.options.until
        && record
        && end_s / sampled > MAX_SAMPLES as f64
    {
        return Err(Problem::new(
            ProblemKind::Value,
            format!("a history of {end_s} s at steps of {sampled} s is too long"),
        )
        .hint("give a shorter --duration, or leave --history out"));
    }
    let mut recorder = HistoryRecorder::new(base.horizontal, FREE_HISTORY_DT_S);
    let mut friction: Option<f64> = None;
    let rocking = rock_observed(&request.block, base, &request.options, |segment| {
        let needed = segment.friction_needed_ratio();
        friction = Some(friction.map_or(needed, |most| most.max(needed)));
        if record {
            recorder.observe(segment);
        }
    })
    .map_err(problem)?;
    let history = if record { recorder.finish(&rocking) } else { Vec::new() };
    Ok(report(request, rocking, friction, history))
}

fn report(request: &RockRequest, rocking: Rocking, friction: Option<f64>, history: Vec<HistoryPoint>) -> RockReport {
    let (block, options) = (&request.block, &request.options);
    let gravity = options.gravity_m_s2;
    let pivot = block.pivot();
    let cell = UpliftCell::new(*block, &rocking);
    let landings = landings(block, ImpactModel::Paper);
    let impact_friction = [*block, block.mirrored()]
        .map(|block| impact_friction_needed_ratio(&block, rocking.restitution_ratio))
        .into_iter()
        .fold(0.0, f64::max);
    let cushion = request.cushion.as_ref();
    let shock = cushion.map(|(mass, edge)| cell.shock(*mass, &edge.cushion, ImpactModel::Paper, gravity));
    let shock_of = |omega: f64| {
        cushion.map(|(mass, edge)| {
            // A block on its right edge (θ > 0) comes back with ω < 0.
            let landing = &landings[usize::from(omega > 0.0)];
            let rise_m = landing.equivalent_rise_m(omega, gravity);
            landing.edge_acceleration_m_s2(*mass, &edge.cushion, rise_m, gravity) / G0_M_S2
        })
    };

    let mut warnings: Vec<String> = Vec::new();
    if block.landing_ratio() < 0.0 {
        warnings.push(ValidityWarning::Squat { landing_ratio: block.landing_ratio() }.to_string());
    }
    if let Some((mass, EdgeCushion { cushion, pad_thickness_m, .. })) = request.cushion.as_ref() {
        warnings.extend(stiffness_warnings(*mass, cushion, *pad_thickness_m).iter().map(ToString::to_string));
        let impacts = landings.iter().zip(rocking.sides).map(|(landing, side)| {
            let rise_m = landing.pivot.largest_rise_m(side.peak_rotation_rad);
            landing.impact(*mass, cushion, rise_m, gravity)
        });
        let deepest = impacts.max_by(|a, b| a.compression_m.total_cmp(&b.compression_m));
        let beyond = deepest
            .map(|impact| compression_warnings(impact.compression_m, cushion, *pad_thickness_m))
            .unwrap_or_default();
        warnings.extend(beyond.iter().map(ToString::to_string));
    }
    let limit = request.friction.unwrap_or(ASSUMED_FRICTION);
    let mut sliding = |needed: f64, when| {
        if needed > limit {
            let assumed =
                if request.friction.is_some() { "" } else { "; this friction is an assumption, --friction sets it" };
            let warning = ValidityWarning::Sliding { needed_ratio: needed, friction_ratio: limit, when };
            warnings.push(format!("{warning}{assumed}"));
        }
    };
    if let Some(needed) = friction {
        if needed.is_finite() {
            sliding(needed, "while rocking");
        }
        if !rocking.impacts.is_empty() {
            sliding(impact_friction, "in an impact");
        }
    }
    if friction.is_some_and(f64::is_infinite) {
        warnings.push(
            "the contact would have to pull the object down at some instant: it would leave the floor, which the model \
             leaves out"
                .to_owned(),
        );
    }

    RockReport {
        outcome: rocking.outcome.name(),
        stopped: rocking.stop.name(),
        end_time_s: rocking.end_s,
        peak_rotation_rad: rocking.peak_rotation_rad,
        peak_rotation_ratio: landings
            .iter()
            .zip(rocking.sides)
            .map(|(landing, side)| side.peak_rotation_rad / landing.pivot.slenderness_angle_rad)
            .fold(0.0, f64::max),
        peak_rotation_time_s: rocking.peak_rotation_time_s.filter(|_| rocking.outcome != Outcome::NoUplift),
        uplift_m: rocking.uplift_m,
        cg_rise_m: rocking.cg_rise_m,
        first_uplift_time_s: rocking.first_uplift_time_s,
        uplift_count: rocking.uplift_count,
        impact_count: rocking.impacts.len(),
        impacts: rocking
            .impacts
            .iter()
            .map(|i| ImpactReport {
                time_s: i.time_s,
                omega_before_rad_s: i.omega_before_rad_s,
                omega_after_rad_s: i.omega_after_rad_s,
                edge_acceleration_impact_velocity_g: shock_of(i.omega_before_rad_s),
            })
            .collect(),
        passed_alpha_time_s: rocking.passed_alpha_time_s,
        overturn_time_s: rocking.overturn_time_s,
        rest_time_s: rocking.rest_time_s,
        at_rest: rocking.at_rest,
        friction_needed_ratio: friction.filter(|ratio| ratio.is_finite()),
        impact_friction_needed_ratio: impact_friction,
        restitution_ratio: rocking.restitution_ratio,
        final_rotation_rad: rocking.final_rotation_rad,
        final_omega_rad_s: rocking.final_omega_rad_s,
        half_diagonal_m: pivot.half_diagonal_m,
        slenderness_angle_rad: pivot.slenderness_angle_rad,
        frequency_parameter_rad_s: pivot.frequency_parameter_rad_s(gravity),
        uplift_threshold_g: options.model.uplift_threshold_ratio(block) * gravity / G0_M_S2,
        model: match options.model {
            rocking::RockingModel::Rigid => "rigid",
            rocking::RockingModel::Linearised => "linear",
        },
        accuracy: crate::summary::accuracy_words(options.accuracy),
        edge_acceleration_g: shock.and_then(|s| s.edge_acceleration_g),
        edge_acceleration_impact_velocity_g: shock.and_then(|s| s.edge_acceleration_impact_velocity_g),
        ceiling_g: shock.map(|s| s.ceiling_g),
        steps: rocking.effort.steps,
        evaluations: rocking.effort.evaluations,
        warnings,
        history,
    }
}

/// A problem of the solver, with what to do about it.
pub fn problem(error: RockingError) -> Problem {
    let hint = match error {
        RockingError::FreeFlight { .. } => "check the unit and the scale of the vertical motion",
        RockingError::TooManyImpacts { .. } => {
            "a restitution of 1 never loses energy: give a smaller one or a shorter duration"
        }
        RockingError::StepTooSmall { .. } => "check the unit and the scale of the motion, and the size of the object",
        RockingError::Restitution { .. } => "give a restitution in (0, 1]",
        RockingError::InitialState { .. } => "an object is overturned at 90 deg",
        RockingError::Duration { .. } => "give --motion, or --initial-rotation with --duration",
        RockingError::Gravity { .. } => "leave gravity out for 9.80665 m/s2",
        RockingError::Accuracy { .. } => "use fast, standard or tight",
        RockingError::VerticalMismatch { .. } => "resample one of them, so that both have the same step and length",
    };
    let kind = match error {
        RockingError::FreeFlight { .. } | RockingError::TooManyImpacts { .. } | RockingError::StepTooSmall { .. } => {
            ProblemKind::Computation
        }
        _ => ProblemKind::Value,
    };
    Problem::new(kind, error.to_string()).hint(hint)
}

/// A history as CSV: time, rotation, angular velocity, lift of the free edge, base acceleration.
///
/// Samples at the steps of the motion, and a row just before and just after every impact.
pub fn history_csv(block: &Block, history: &[HistoryPoint]) -> String {
    let mut text = String::from("time_s,theta_rad,omega_rad_s,uplift_m,base_accel_m_s2\n");
    for p in history {
        let uplift_m = block.base_width_m() * p.theta_rad.abs().sin();
        for (i, value) in [p.time_s, p.theta_rad, p.omega_rad_s, uplift_m, p.base_accel_m_s2].into_iter().enumerate() {
            if i > 0 {
                text.push(',');
            }
            push_shortest(&mut text, value);
        }
        text.push('\n');
    }
    text
}
