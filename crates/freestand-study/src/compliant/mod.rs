//! One history of an object on its cushions, with Eq. (5) beside it: request → report.

mod figure;

pub use figure::{Trace, trace_figure};
use freestand::G0_M_S2;
use freestand::block::{Block, Pivot};
use freestand::compliant::{
    CompliantAccuracy, CompliantBase, CompliantError, CompliantOptions, CompliantPoint, CompliantRecorder,
    CompliantRocking, EnergyAudit, Start, rock_compliant_observed,
};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::impact::{ImpactModel, Landing, compression_warnings, stiffness_warnings};
use freestand::motion::{MAX_SAMPLES, Motion};
use freestand::rocking::{Base, Outcome};
use serde::Serialize;

use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::push_shortest;

/// Samples of a history for each landing pulse, so that a peak between them is at most 0.1 % higher.
const SAMPLES_PER_PULSE: f64 = 40.0;
/// Swings of a rigid block that free rocking is followed for where nobody says.
const FREE_SWINGS: f64 = 4.0;
/// Time for what does not swing back, over the block's 1/p.
const FALL_TIMES: f64 = 12.0;

/// An object on cushions under a motion, or let go.
#[derive(Debug, Clone)]
pub struct CompliantRequest {
    /// The object.
    pub block: Block,
    /// What it stands on.
    pub base: CompliantBase,
    /// Thickness of the pad, for the warnings \[m\].
    pub pad_thickness_m: Option<f64>,
    /// How the cushion was read, in words.
    pub notes: Vec<String>,
    /// Horizontal motion of its base.
    pub horizontal: Option<Motion>,
    /// Vertical motion of its base.
    pub vertical: Option<Motion>,
    /// Accuracy, start, end, points.
    pub options: CompliantOptions,
}

/// A touch of an edge, until it leaves its cushion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct TouchReport {
    pub time_s: f64,
    pub edge: &'static str,
    pub speed_m_s: f64,
    pub omega_before_rad_s: f64,
    pub omega_after_rad_s: Option<f64>,
    pub end_time_s: Option<f64>,
    pub rebound_m_s: Option<f64>,
    pub edge_acceleration_g: f64,
    pub force_n: f64,
}

/// A swing with an edge off its cushion; the restitution is √(Δh/Δh before), of free rocking only.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct SwingReport {
    pub time_s: f64,
    pub rotation_rad: f64,
    pub restitution_ratio: Option<f64>,
}

/// Peak accelerations of a point of the object.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct PointReport {
    pub x_m: f64,
    pub z_m: f64,
    pub horizontal_g: f64,
    pub vertical_g: f64,
}

/// Where the energy went: [`EnergyAudit`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct EnergyReport {
    pub initial_j: f64,
    pub kinetic_j: f64,
    pub potential_j: f64,
    pub stored_j: f64,
    pub cushion_dissipation_j: f64,
    pub tangential_dissipation_j: f64,
    pub friction_j: f64,
    pub lost_at_separation_j: f64,
    pub base_work_j: f64,
    pub turnover_j: f64,
    pub residual_ratio: f64,
}

/// What the object did: the keys of `freestand rock --base compliant --json`.
///
/// `edge_acceleration_g` is the largest of the history, `…_paper_g` Eq. (5) at the same rise without the cushion's damping,
/// `…_effective_mass_g` the landing of the same effective mass with it. An impact is a touch of an edge; `first_impact_…` are
/// those of a release, and `None` under a motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names are the documentation: SI units as they say")]
pub struct CompliantReport {
    pub base: &'static str,
    pub outcome: &'static str,
    pub end_time_s: f64,
    pub peak_rotation_rad: f64,
    pub peak_rotation_ratio: f64,
    pub peak_rotation_time_s: f64,
    pub uplift_m: f64,
    pub cg_rise_m: f64,
    pub first_uplift_time_s: Option<f64>,
    pub impact_count: usize,
    pub impacts: Vec<TouchReport>,
    pub bounce_count: usize,
    pub flight_count: usize,
    pub flight_time_s: f64,
    pub swings: Vec<SwingReport>,
    pub passed_alpha_time_s: Option<f64>,
    pub overturn_time_s: Option<f64>,
    pub edge_acceleration_g: f64,
    pub edge_acceleration_left_g: f64,
    pub edge_acceleration_right_g: f64,
    pub first_impact_edge_acceleration_g: Option<f64>,
    pub edge_acceleration_paper_g: Option<f64>,
    pub edge_acceleration_effective_mass_g: Option<f64>,
    pub edge_acceleration_over_paper_ratio: Option<f64>,
    pub first_impact_over_paper_ratio: Option<f64>,
    /// Of the rigid base: the feet here slip or hold, and a landing takes what it takes.
    pub friction_needed_ratio: Option<f64>,
    pub impact_friction_needed_ratio: Option<f64>,
    pub edge_acceleration_impact_velocity_g: Option<f64>,
    pub ceiling_g: Option<f64>,
    pub edge_force_n: f64,
    pub compression_m: f64,
    pub friction_used_ratio: f64,
    pub slid_m: f64,
    pub at: Option<PointReport>,
    pub restitution_ratio: Option<f64>,
    pub static_compression_m: Option<f64>,
    pub static_compressions_m: Option<[f64; 2]>,
    pub static_rotation_rad: Option<f64>,
    pub energy: EnergyReport,
    pub final_rotation_rad: f64,
    pub final_omega_rad_s: f64,
    pub half_diagonal_m: f64,
    pub slenderness_angle_rad: f64,
    pub frequency_parameter_rad_s: f64,
    pub mass_kg: f64,
    pub law: &'static str,
    pub contacts: usize,
    pub tangential_stiffness_ratio: f64,
    pub friction_ratio: Option<f64>,
    pub tolerance: f64,
    pub steps: usize,
    pub evaluations: usize,
    pub notes: Vec<String>,
    #[serde(skip)]
    pub warnings: Vec<String>,
    #[serde(skip)]
    pub history: Vec<CompliantPoint>,
}

/// Follows the object; the history is sampled only if `record` says so.
///
/// # Errors
/// What the solver refuses, with a hint.
pub fn rock_on_cushions(request: &CompliantRequest, record: bool) -> Result<CompliantReport, Problem> {
    let motion = Base { horizontal: request.horizontal.as_ref(), vertical: request.vertical.as_ref() };
    let mut options = request.options.clone();
    let pivot = pivot_of(&request.block, options.start);
    if motion.horizontal.is_none() && motion.vertical.is_none() && options.duration_s.is_none() {
        options.duration_s = Some(natural_duration_s(&pivot, options.start, options.gravity_m_s2));
    }
    let dt_s = sampling_s(request);
    let end_s = options.duration_s.or(motion.horizontal.or(motion.vertical).map(Motion::duration_s)).unwrap_or(0.0);
    if record && end_s / dt_s > MAX_SAMPLES as f64 {
        let message = format!("a history of {end_s} s at steps of {dt_s} s is too long");
        return Err(Problem::new(ProblemKind::Value, message)
            .hint("give a shorter --duration, or leave --history and --out out"));
    }
    let (width_m, contacts) = (request.block.base_width_m(), request.base.contacts);
    let mut recorder = CompliantRecorder::new(dt_s, width_m, &options.points_m, contacts);
    let rocking = rock_compliant_observed(&request.block, &request.base, motion, &options, |piece| {
        if record {
            recorder.observe(piece);
        }
    })
    .map_err(problem)?;
    let history = if record { recorder.finish(&rocking) } else { Vec::new() };
    Ok(report(request, rocking, history))
}

fn pivot_of(block: &Block, start: Start) -> Pivot {
    match start {
        Start::Tilted { rotation_rad, .. } if rotation_rad > 0.0 => block.right_pivot(),
        _ => block.pivot(),
    }
}

/// Four swings of the rigid block that is let go like this; the time of a fall where it does not swing back.
fn natural_duration_s(pivot: &Pivot, start: Start, gravity_m_s2: f64) -> f64 {
    let p = pivot.frequency_parameter_rad_s(gravity_m_s2);
    let free = match start {
        Start::Tilted { rotation_rad, omega_rad_s: 0.0 } => {
            let share = rotation_rad.abs() / pivot.slenderness_angle_rad;
            (0.0 < share && share < 1.0).then(|| 2.0 * FREE_SWINGS * (1.0 / (1.0 - share)).acosh() / p)
        }
        _ => None,
    };
    free.map_or(FALL_TIMES / p, |time_s| time_s.min(FALL_TIMES / p))
}

/// The step of a history: that of the motion, or enough for a landing.
fn sampling_s(request: &CompliantRequest) -> f64 {
    let landing = Landing::rocking(&request.block, ImpactModel::Paper);
    let weight_n = request.base.mass_kg * request.options.gravity_m_s2;
    let cushion = &request.base.cushion;
    let stiffness_n_m = cushion.tangent_stiffness_n_m(cushion.static_compression_m(weight_n));
    let m_eff = landing.effective_mass_ratio * request.base.mass_kg;
    let pulse_s = std::f64::consts::PI * (m_eff / stiffness_n_m).sqrt() / SAMPLES_PER_PULSE;
    let motion = request.horizontal.as_ref().or(request.vertical.as_ref());
    motion.map_or(pulse_s, |motion| motion.dt_s().min(pulse_s))
}

/// A linear cushion with c = 2ζ√(k m) under the edge of a mass m \[N s/m\].
///
/// # Errors
/// A stiffness that makes no cushion.
pub fn damped(mass_kg: f64, stiffness_n_m: f64, damping_ratio: f64) -> Result<Cushion, Problem> {
    let damping_n_s_m = 2.0 * damping_ratio * (stiffness_n_m * mass_kg).sqrt();
    let law = if damping_ratio > 0.0 {
        ContactLaw::KelvinVoigt { stiffness_n_m, damping_n_s_m }
    } else {
        ContactLaw::Linear { stiffness_n_m }
    };
    Cushion::new(law).map_err(|error| {
        Problem::new(ProblemKind::Value, error.to_string()).hint("check the stiffness and the damping of the cushion")
    })
}

/// Eq. (5) for a rise of the centre of gravity, on any cushion: the landing of m_eff at the edge's velocity \[m/s²\].
pub fn paper_edge_acceleration_m_s2(block: &Block, base: &CompliantBase, cg_rise_m: f64, gravity_m_s2: f64) -> f64 {
    let landing = Landing::rocking(block, ImpactModel::Paper);
    landing.edge_acceleration_m_s2(base.mass_kg, &base.cushion, cg_rise_m, gravity_m_s2)
}

/// The base with cushions that have lost their dashpots: what Eq. (5) is about.
fn undamped(base: &CompliantBase) -> CompliantBase {
    let law = match *base.cushion.law() {
        ContactLaw::KelvinVoigt { stiffness_n_m, .. } => ContactLaw::Linear { stiffness_n_m },
        ContactLaw::HuntCrossley { coefficient_n_mn, exponent, .. } => ContactLaw::Power { coefficient_n_mn, exponent },
        _ => return base.clone(),
    };
    // The numbers that are left are those of a cushion.
    Cushion::new(law).map_or_else(|_| base.clone(), |cushion| CompliantBase { cushion, ..base.clone() })
}

fn report(request: &CompliantRequest, rocking: CompliantRocking, history: Vec<CompliantPoint>) -> CompliantReport {
    let (block, base, options) = (&request.block, &request.base, &request.options);
    let pivot = block.pivot();
    let alphas = [pivot, block.right_pivot()].map(|pivot| pivot.slenderness_angle_rad);
    let is_up = rocking.outcome == Outcome::Rocked;
    let landed = |base: &CompliantBase| {
        let a = is_up.then(|| paper_edge_acceleration_m_s2(block, base, rocking.cg_rise_m, options.gravity_m_s2));
        a.filter(|a| *a > 0.0 && a.is_finite())
    };
    let (paper_m_s2, damped_m_s2) = (landed(&undamped(base)), landed(base));
    let peak_m_s2 = rocking.peak_edge_acceleration_m_s2();
    // Under a motion the first touch is not the one that follows the largest rise.
    let is_release = request.horizontal.is_none() && request.vertical.is_none();
    let first_m_s2 = rocking.touches.first().filter(|_| is_release).map(|touch| touch.peak_acceleration_m_s2);
    let in_g = |a: f64| a / G0_M_S2;
    let force_n = rocking.peak_edge_forces_n[0].max(rocking.peak_edge_forces_n[1]);
    let rest = rocking.equilibrium;
    CompliantReport {
        base: "compliant",
        outcome: rocking.outcome.name(),
        end_time_s: rocking.end_s,
        peak_rotation_rad: rocking.peak_rotation_rad,
        peak_rotation_ratio: rocking.peak_rotation_rad / alphas[0].min(alphas[1]),
        peak_rotation_time_s: rocking.peak_rotation_time_s,
        uplift_m: rocking.uplift_m,
        cg_rise_m: rocking.cg_rise_m,
        first_uplift_time_s: rocking.first_uplift_time_s,
        impact_count: rocking.touches.len(),
        bounce_count: rocking.bounce_count,
        flight_count: rocking.flight_count,
        flight_time_s: rocking.flight_time_s,
        passed_alpha_time_s: rocking.passed_alpha_time_s,
        overturn_time_s: rocking.overturn_time_s,
        edge_acceleration_g: in_g(peak_m_s2),
        edge_acceleration_left_g: in_g(rocking.peak_edge_accelerations_m_s2[0]),
        edge_acceleration_right_g: in_g(rocking.peak_edge_accelerations_m_s2[1]),
        first_impact_edge_acceleration_g: first_m_s2.map(in_g),
        edge_acceleration_paper_g: paper_m_s2.map(in_g),
        edge_acceleration_effective_mass_g: damped_m_s2.map(in_g),
        edge_acceleration_over_paper_ratio: paper_m_s2.map(|paper| peak_m_s2 / paper),
        first_impact_over_paper_ratio: paper_m_s2.zip(first_m_s2).map(|(paper, first)| first / paper),
        friction_needed_ratio: None,
        impact_friction_needed_ratio: None,
        edge_acceleration_impact_velocity_g: None,
        ceiling_g: None,
        edge_force_n: force_n,
        compression_m: rocking.peak_compression_m,
        friction_used_ratio: rocking.friction_used_ratio,
        slid_m: rocking.slid_m,
        at: options.points_m.first().zip(rocking.points.first()).map(|(&(x_m, z_m), peaks)| PointReport {
            x_m,
            z_m,
            horizontal_g: in_g(peaks.horizontal_m_s2),
            vertical_g: in_g(peaks.vertical_m_s2),
        }),
        restitution_ratio: rocking.swings.iter().find_map(|swing| swing.effective_restitution_ratio),
        static_compression_m: rest.map(|rest| rest.compressions_m[0].max(rest.compressions_m[1])),
        static_compressions_m: rest.map(|rest| rest.compressions_m),
        static_rotation_rad: rest.map(|rest| rest.rotation_rad),
        energy: energy(rocking.energy),
        final_rotation_rad: rocking.final_rotation_rad,
        final_omega_rad_s: rocking.final_omega_rad_s,
        half_diagonal_m: pivot.half_diagonal_m,
        slenderness_angle_rad: pivot.slenderness_angle_rad,
        frequency_parameter_rad_s: pivot.frequency_parameter_rad_s(options.gravity_m_s2),
        mass_kg: base.mass_kg,
        law: base.cushion.law().name(),
        contacts: base.contacts,
        tangential_stiffness_ratio: base.tangential_stiffness_ratio,
        friction_ratio: base.friction_ratio,
        tolerance: options.accuracy.tolerance(),
        steps: rocking.effort.steps,
        evaluations: rocking.effort.evaluations,
        notes: request.notes.clone(),
        warnings: warnings(request, &rocking),
        impacts: rocking.touches.into_iter().map(touch).collect(),
        swings: rocking
            .swings
            .into_iter()
            .map(|swing| SwingReport {
                time_s: swing.time_s,
                rotation_rad: swing.rotation_rad,
                restitution_ratio: swing.effective_restitution_ratio,
            })
            .collect(),
        history,
    }
}

fn touch(touch: freestand::compliant::Touch) -> TouchReport {
    TouchReport {
        time_s: touch.time_s,
        edge: touch.edge.name(),
        speed_m_s: touch.speed_m_s,
        omega_before_rad_s: touch.omega_before_rad_s,
        omega_after_rad_s: touch.omega_after_rad_s,
        end_time_s: touch.end_s,
        rebound_m_s: touch.rebound_m_s,
        edge_acceleration_g: touch.peak_acceleration_m_s2 / G0_M_S2,
        force_n: touch.peak_force_n,
    }
}

fn energy(audit: EnergyAudit) -> EnergyReport {
    EnergyReport {
        initial_j: audit.initial_j,
        kinetic_j: audit.kinetic_j,
        potential_j: audit.potential_j,
        stored_j: audit.stored_j,
        cushion_dissipation_j: audit.cushion_dissipation_j,
        tangential_dissipation_j: audit.tangential_dissipation_j,
        friction_j: audit.friction_j,
        lost_at_separation_j: audit.lost_at_separation_j,
        base_work_j: audit.base_work_j,
        turnover_j: audit.turnover_j,
        residual_ratio: audit.residual_ratio,
    }
}

/// Energy that may be missing before it is said.
const ENERGY_LIMIT: f64 = 1e-5;

fn warnings(request: &CompliantRequest, rocking: &CompliantRocking) -> Vec<String> {
    let (base, pad_thickness_m) = (&request.base, request.pad_thickness_m);
    let is_shaken = request.horizontal.is_some() || request.vertical.is_some();
    let stiffness = stiffness_warnings(base.mass_kg, &base.cushion, pad_thickness_m);
    let mut warnings: Vec<String> = stiffness.iter().map(ToString::to_string).collect();
    let beyond = compression_warnings(rocking.peak_compression_m, &base.cushion, pad_thickness_m);
    warnings.extend(beyond.iter().map(ToString::to_string));
    if is_shaken && !base.cushion.law().is_damped() {
        warnings.push(
            "the cushions have no damping: under a motion the object keeps ringing on them, and the largest shock of a long \
             history hangs on rounding; give a damped law, such as --law kelvin-voigt --damping 5%"
                .to_owned(),
        );
    }
    if rocking.equilibrium.is_none() {
        warnings.push("the cushions are too soft to keep the object upright when it comes to rest".to_owned());
    }
    let missing = rocking.energy.residual_ratio;
    if missing > ENERGY_LIMIT {
        warnings
            .push(format!("the energy balance is open by {missing:.1e} of what was turned over: use --accuracy tight"));
    }
    warnings
}

/// A problem of the solver, with what to do about it.
pub fn problem(error: CompliantError) -> Problem {
    let (kind, hint) = match error {
        CompliantError::Value { .. } => (ProblemKind::Value, "check the flags of the object and its cushion"),
        CompliantError::Contacts { .. } => (ProblemKind::Value, "2 are the two edges"),
        CompliantError::Unstable { .. } => {
            (ProblemKind::Value, "check the unit of the stiffness: N/m typed for N/mm is a thousand times too soft")
        }
        CompliantError::Duration { .. } => (ProblemKind::Value, "give --motion, or --cg-rise or --initial-rotation"),
        CompliantError::VerticalMismatch => {
            (ProblemKind::Value, "resample one of them, so that both have the same step and length")
        }
        CompliantError::StepTooSmall { .. } => {
            (ProblemKind::Computation, "check the units of the motion and of the cushion, and whether it bottoms")
        }
        CompliantError::TooManySteps { .. } => {
            (ProblemKind::Computation, "use a shorter --duration or --accuracy fast; a very stiff base is --base rigid")
        }
    };
    Problem::new(kind, error.to_string()).hint(hint)
}

/// An accuracy by its name in flags.
pub fn accuracy(name: freestand::rocking::Accuracy) -> CompliantAccuracy {
    match name {
        freestand::rocking::Accuracy::Fast => CompliantAccuracy::Fast,
        freestand::rocking::Accuracy::Standard => CompliantAccuracy::Standard,
        freestand::rocking::Accuracy::Tight => CompliantAccuracy::Tight,
        freestand::rocking::Accuracy::Tolerance(tolerance) => CompliantAccuracy::Tolerance(tolerance),
    }
}

/// A history as CSV: position, edge accelerations, that of the point that was asked for, forces of the contact elements from left to
/// right on the object.
pub fn history_csv(history: &[CompliantPoint]) -> String {
    let mut text =
        String::from("time_s,theta_rad,omega_rad_s,x_m,z_m,edge_acceleration_left_g,edge_acceleration_right_g");
    if let Some(first) = history.first() {
        for _ in &first.point_accelerations_m_s2 {
            text.push_str(",at_horizontal_g,at_vertical_g");
        }
        for index in 1..=first.contact_forces_n.len() {
            text.push_str(&format!(",normal_force_{index}_n,tangential_force_{index}_n"));
        }
    }
    text.push('\n');
    for p in history {
        let edges = p.edge_accelerations_m_s2.map(|a| a / G0_M_S2);
        let points = p.point_accelerations_m_s2.iter().flat_map(|&(h, v)| [h / G0_M_S2, v / G0_M_S2]);
        let forces = p.contact_forces_n.iter().flat_map(|&(right, up)| [up, right]);
        let values = [p.time_s, p.theta_rad, p.omega_rad_s, p.x_m, p.z_m].into_iter().chain(edges);
        for (i, value) in values.chain(points).chain(forces).enumerate() {
            if i > 0 {
                text.push(',');
            }
            push_shortest(&mut text, value);
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(damping_ratio: f64) -> CompliantRequest {
        let block = Block::uniform(2.3, 0.6).unwrap();
        let rotation_rad = block.right_pivot().rotation_at_rise_rad(0.016).unwrap();
        let base = CompliantBase::new(140.0, damped(140.0, 4.38e6, damping_ratio).unwrap());
        let start = Start::Tilted { rotation_rad, omega_rad_s: 0.0 };
        let options = CompliantOptions { start, points_m: vec![(0.3, 1.15)], ..CompliantOptions::default() };
        CompliantRequest {
            block,
            base,
            pad_thickness_m: None,
            notes: Vec::new(),
            horizontal: None,
            vertical: None,
            options,
        }
    }

    /// Eq. (5) at the rise of the release by hand: 4.526 g at 9.81 m/s², √(9.80665/9.81) of the acceleration and the
    /// unit the other way, so 4.527 at 9.80665; the peak of the first landing is 0.79 of it.
    #[test]
    fn a_release_is_reported_beside_equation_5() {
        let report = rock_on_cushions(&request(0.0), true).unwrap();
        assert!((report.edge_acceleration_paper_g.unwrap() - 4.5268).abs() < 1e-3);
        assert!((report.first_impact_over_paper_ratio.unwrap() - 0.79).abs() < 0.005);
        assert!((report.cg_rise_m - 0.016).abs() < 1e-12);
        assert_eq!(report.outcome, "rocked");
        assert!((report.static_compression_m.unwrap() - 140.0 * G0_M_S2 / (2.0 * 4.38e6)).abs() < 1e-15);
        assert!(report.energy.residual_ratio < 1e-7 && report.warnings.is_empty(), "{:?}", report.warnings);
        let csv = history_csv(&report.history);
        let columns = |line: &str| line.split(',').count();
        assert!(csv.lines().all(|line| columns(line) == 13));
        assert_eq!(csv.lines().count(), report.history.len() + 1);
        // The samples show the pulse, as fine as they are: 1 − cos(π/80) = 0.08 % below its peak.
        let sampled = report.history.iter().map(|p| p.edge_accelerations_m_s2[0]).fold(0.0, f64::max) / G0_M_S2;
        assert!(sampled <= report.edge_acceleration_left_g && sampled > 0.995 * report.edge_acceleration_left_g);
    }

    /// ζ of the mass: c = 2 · 0.05 √(4.38e6 · 140).
    #[test]
    fn damping_is_that_of_the_mass() {
        let expected = 0.1 * (4.38e6 * 140.0f64).sqrt();
        let ContactLaw::KelvinVoigt { damping_n_s_m, .. } = *request(0.05).base.cushion.law() else {
            panic!("a damped cushion")
        };
        assert!((damping_n_s_m / expected - 1.0).abs() < 1e-12);
        let report = rock_on_cushions(&request(0.05), false).unwrap();
        // Eq. (5) knows no damping; the landing of the effective mass does: of it ζ is
        // 0.05/√(1 − 0.1875 x) = 0.05124, and exp(−ζ w t*) = 0.92988.
        assert!((report.edge_acceleration_paper_g.unwrap() - 4.5268).abs() < 1e-3);
        let ratio = report.edge_acceleration_effective_mass_g.unwrap() / report.edge_acceleration_paper_g.unwrap();
        assert!((ratio - 0.92988).abs() < 1e-5, "{ratio}");
        assert!(report.energy.cushion_dissipation_j > 0.0 && report.history.is_empty());
    }

    #[test]
    fn too_soft_a_cushion_is_a_problem_with_a_hint() {
        let mut request = request(0.0);
        request.base.cushion = Cushion::linear(4380.0).unwrap();
        request.options.start = Start::Rest;
        request.options.duration_s = Some(1.0);
        let problem = rock_on_cushions(&request, false).unwrap_err();
        assert!(problem.message.contains("too soft") && problem.hint.is_some());
    }
}
