//! One history of an object on its cushions, compared with Eq. (5): request → report.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::{
    CompliantBase, CompliantPoint, CompliantRocking, EnergyAudit, Swing, Touch,
};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::impact::{ImpactModel, Landing, compression_warnings, stiffness_warnings};
use freestand::motion::Motion;
use freestand::respond::{HistoryOptions, PadHistory, Pads, Release};
use freestand::rocking::{Outcome, Until};

use crate::doubt::{HistoryDoubt, HistoryNote};
use crate::unsolved::{self, base, unresolved};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, format_si};
use freestand_output::answer;

/// Free rocking without a given duration lasts this many swings of a rigid block.
const FREE_SWINGS: f64 = 4.0;
/// Duration for an object that does not swing back, as a multiple of the block's 1/p.
const FALL_TIMES: f64 = 12.0;

/// An object on cushions, under a motion or released.
#[derive(Debug, Clone)]
pub struct CompliantRequest {
    /// The object, in one plane.
    pub object: Pads,
    /// Thickness of the pad, for the warnings \[m\].
    pub pad_thickness_m: Option<f64>,
    /// What its reader must know.
    pub notes: Vec<HistoryNote>,
    /// Horizontal motion of its base.
    pub horizontal: Option<Motion>,
    /// Vertical motion of its base.
    pub vertical: Option<Motion>,
    /// Accuracy, start, end, points, samples.
    pub how: HistoryOptions,
}

/// How far to the right an object is turned when it is released.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turned {
    /// θ \[rad\].
    Rotation(f64),
    /// The rotation at this rise of the centre of gravity \[m\].
    CgRise(f64),
}

/// The initial state of an object; upright without a release.
///
/// # Errors
/// A rise beyond the balance point.
pub fn start(block: &Block, turned: Option<Turned>, omega_rad_s: f64) -> Result<Release, Problem> {
    let pivot = block.right_pivot();
    let rotation_rad = match turned {
        None => 0.0,
        Some(Turned::Rotation(rotation_rad)) => rotation_rad,
        Some(Turned::CgRise(rise_m)) => pivot.rotation_at_rise_rad(rise_m).ok_or_else(|| {
            let balance = format_si(pivot.balance_rise_m(), Dimension::Length);
            let message =
                format!("`cg_rise` is beyond the balance point, which is at a rise of {balance}");
            Problem::value(message, "give a smaller rise, or `initial_rotation`")
        })?,
    };
    Ok(Release {
        rotation_rad,
        omega_rad_s,
    })
}

/// The base with this tangential stiffness of the cushion under one edge \[N/m\].
pub fn with_tangential_stiffness(
    base: CompliantBase,
    stiffness_n_m: f64,
    gravity_m_s2: f64,
) -> CompliantBase {
    CompliantBase {
        tangential_stiffness_ratio: stiffness_n_m / base.normal_stiffness_n_m(gravity_m_s2),
        ..base
    }
}

answer! {
    /// What an object on its cushions did. An impact is a contact of an edge with its cushion; `first_impact_…` belong
    /// to a release and are missing under a motion.
    pub struct PadAnswer of (
        rocking: &CompliantRocking,
        request: &CompliantRequest,
        block: &Block,
        base: &CompliantBase,
        paper_m_s2: Option<f64>,
        damped_m_s2: Option<f64>,
        first_m_s2: Option<f64>,
    ) {
        /// What the object stands on.
        base: &'static str = "compliant";
        outcome: &'static str = rocking.outcome.name() => "outcome";
        end_time_s: f64 => "end";
        peak_rotation_rad: f64 => "largest rotation";
        /// The largest rotation divided by the smaller of the angles α at which the object balances.
        peak_rotation_ratio: f64 = rocking.peak_rotation_rad
            / block.pivot().slenderness_angle_rad.min(block.right_pivot().slenderness_angle_rad) => "  divided by α";
        peak_rotation_time_s: f64 => "  at";
        uplift_m: f64 => "uplift";
        cg_rise_m: f64 => "rise of the centre of gravity";
        first_uplift_time_s: Option<f64> => "first uplift";
        impact_count: usize = rocking.touches.len() => "impacts";
        /// All contacts of an edge with its cushion.
        impacts: Vec<PadImpact> = rocking.touches.iter().map(PadImpact::of).collect();
        bounce_count: usize => "bounces";
        flight_count: usize => "times airborne";
        flight_time_s: f64 => "time airborne";
        /// All swings, during which an edge is off its cushion.
        swings: Vec<PadSwing> = rocking.swings.iter().map(PadSwing::of).collect();
        passed_alpha_time_s: Option<f64> => "passes the balance point";
        overturn_time_s: Option<f64> => "overturns";
        /// The largest acceleration of an edge.
        edge_acceleration_g: f64 = in_g(rocking.peak_edge_acceleration_m_s2()) => "shock, simulated";
        /// That of the left edge.
        edge_acceleration_left_g: f64 = in_g(rocking.peak_edge_accelerations_m_s2[0]);
        /// That of the right edge.
        edge_acceleration_right_g: f64 = in_g(rocking.peak_edge_accelerations_m_s2[1]);
        first_impact_edge_acceleration_g: Option<f64> = first_m_s2.map(in_g) => "  in the first impact";
        /// Eq. (5) at the largest rise, without the damping of the cushion.
        edge_acceleration_paper_g: Option<f64> = paper_m_s2.map(in_g) => "shock by Eq. (5) at this rise";
        /// The landing of the same effective mass at the largest rise, with the damping of the cushion.
        edge_acceleration_effective_mass_g: Option<f64> = damped_m_s2.map(in_g);
        edge_acceleration_over_paper_ratio: Option<f64> =
            paper_m_s2.map(|paper| rocking.peak_edge_acceleration_m_s2() / paper) => "simulated over Eq. (5)";
        first_impact_over_paper_ratio: Option<f64> =
            paper_m_s2.zip(first_m_s2).map(|(paper, first)| first / paper) => "first impact over Eq. (5)";
        /// Of a rigid base: on cushions, friction is simulated.
        friction_needed_ratio: Option<f64> = None;
        /// Of a rigid base.
        impact_friction_needed_ratio: Option<f64> = None;
        /// Of a rigid base: on cushions, the equations of motion determine the energy that a landing loses.
        edge_acceleration_impact_velocity_g: Option<f64> = None;
        /// Of a rigid base.
        ceiling_g: Option<f64> = None;
        /// The largest force under an edge.
        edge_force_n: f64 = rocking.peak_edge_forces_n[0].max(rocking.peak_edge_forces_n[1]);
        /// The largest compression of a cushion.
        compression_m: f64 = rocking.peak_compression_m;
        friction_used_ratio: f64 => "friction used";
        slid_m: f64 => "sliding distance";
        /// The peaks at the point that was asked for.
        at: Option<PointPeaks> = request.how.points_m.first().zip(rocking.points.first())
            .map(|(point_m, peaks)| PointPeaks::of(point_m, peaks));
        /// √(Δh/Δh of the swing before), of free rocking.
        restitution_ratio: Option<f64> =
            rocking.swings.iter().find_map(|swing| swing.effective_restitution_ratio);
        static_compression_m: Option<f64> =
            rocking.equilibrium.map(|rest| rest.compressions_m[0].max(rest.compressions_m[1])) => "compression at rest";
        /// Compression at rest under the left and the right edge.
        static_compressions_m: Option<[f64; 2]> = rocking.equilibrium.map(|rest| rest.compressions_m);
        /// Rotation at rest.
        static_rotation_rad: Option<f64> = rocking.equilibrium.map(|rest| rest.rotation_rad);
        /// The energy balance.
        energy: PadEnergy = PadEnergy::of(&rocking.energy);
        /// Rotation at the end.
        final_rotation_rad: f64;
        /// Angular velocity at the end.
        final_omega_rad_s: f64;
        /// R: from the left edge to the centre of gravity.
        half_diagonal_m: f64 = block.pivot().half_diagonal_m;
        /// α of the left edge.
        slenderness_angle_rad: f64 = block.pivot().slenderness_angle_rad;
        /// p of the left edge.
        frequency_parameter_rad_s: f64 =
            block.pivot().frequency_parameter_rad_s(request.how.settings.gravity_m_s2);
        /// Mass of the object.
        mass_kg: f64 = base.mass_kg;
        /// The law of the cushions.
        law: &'static str = base.cushion.law().name();
        /// Number of contact elements.
        contacts: usize = base.contacts;
        /// Tangential over normal stiffness of a cushion.
        tangential_stiffness_ratio: f64 = base.tangential_stiffness_ratio;
        /// Coefficient of friction; none: no slip.
        friction_ratio: Option<f64> = base.friction_ratio;
        /// Relative tolerance of the solver.
        tolerance: f64 = request.how.settings.on_pads.tolerance();
        /// Steps of the solver.
        steps: usize = rocking.effort.steps;
        /// Evaluations of the equations of motion.
        evaluations: usize = rocking.effort.evaluations;
    }

    /// A contact of an edge with its cushion.
    pub struct PadImpact of (touch: &Touch) {
        /// When it happened.
        time_s: f64;
        /// `left` or `right`.
        edge: &'static str = touch.edge.into();
        /// Speed at which the edge meets the cushion.
        speed_m_s: f64;
        /// Angular velocity before the contact.
        omega_before_rad_s: f64;
        /// Angular velocity after the contact.
        omega_after_rad_s: Option<f64>;
        /// End of the contact.
        end_time_s: Option<f64>;
        /// Speed at which the edge leaves the cushion.
        rebound_m_s: Option<f64>;
        /// Largest acceleration of the edge.
        edge_acceleration_g: f64 = in_g(touch.peak_acceleration_m_s2);
        /// Largest force under the edge.
        force_n: f64 = touch.peak_force_n;
    }

    /// A swing.
    pub struct PadSwing of (swing: &Swing) {
        /// When the rotation is largest.
        time_s: f64;
        /// The largest rotation, signed.
        rotation_rad: f64;
        /// √(Δh/Δh of the swing before), of free rocking.
        restitution_ratio: Option<f64> = swing.effective_restitution_ratio;
    }

    /// The peaks at a point of an object.
    pub struct PointPeaks of (point_m: &(f64, f64), peaks: &freestand::compliant::PointPeaks) {
        /// From the left edge.
        x_m: f64 = point_m.0;
        /// Above the base.
        z_m: f64 = point_m.1;
        horizontal_g: f64 = in_g(peaks.horizontal_m_s2) => "acceleration of the point, horizontal";
        vertical_g: f64 = in_g(peaks.vertical_m_s2) => "acceleration of the point, vertical";
    }

    /// The energy balance of a history.
    pub struct PadEnergy of (energy: &EnergyAudit) {
        /// Energy at the start.
        initial_j: f64;
        /// Kinetic energy at the end.
        kinetic_j: f64;
        /// Potential energy at the end.
        potential_j: f64;
        /// Energy in the cushions at the end.
        stored_j: f64;
        /// Dissipated in the cushions.
        cushion_dissipation_j: f64;
        /// Dissipated in the tangential springs.
        tangential_dissipation_j: f64;
        /// Dissipated by friction.
        friction_j: f64;
        /// Left in the cushions where an edge leaves them.
        lost_at_separation_j: f64;
        /// Work of the floor.
        base_work_j: f64;
        /// Energy that was exchanged in all.
        turnover_j: f64;
        residual_ratio: f64 => "error of the energy balance";
    }
}

/// What the object did.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantReport {
    /// What it did.
    pub answer: PadAnswer,
    /// What the object rests on.
    pub base: CompliantBase,
    /// What may make it wrong.
    pub doubts: Vec<HistoryDoubt>,
    /// Its history.
    pub history: PadHistory,
}

/// Calculates the motion of the object.
///
/// # Errors
/// The errors of the solver, each with a hint, and a history that is too long to sample.
pub fn rock_on_cushions(request: &CompliantRequest) -> Result<CompliantReport, Problem> {
    let motion = base(&request.horizontal, &request.vertical);
    let is_free = motion.horizontal.is_none() && motion.vertical.is_none();
    let mut how = request.how.clone();
    if is_free && matches!(how.settings.until, Until::Settled { .. }) {
        how.settings.until =
            Until::Time(natural_duration_s(&request.object.planes.one.block, &how));
    }
    let history = request
        .object
        .follow(motion, &how)
        .map_err(unsolved::problem)?;
    let is_one = !is_free && is_one_realisation(request, &how, history.rocking.outcome);
    let mut report = report(request, history);
    if is_one {
        report.doubts.push(HistoryDoubt::OtherOutcomeNearby);
    }
    Ok(report)
}

/// Relative change of the motion by which an outcome is tested.
const CHANGE_RATIO: f64 = 1e-4;

/// Whether the outcome is another under a slightly weaker or stronger motion.
fn is_one_realisation(request: &CompliantRequest, how: &HistoryOptions, outcome: Outcome) -> bool {
    let how = HistoryOptions {
        is_sampled: false,
        ..how.clone()
    };
    let is_other = |factor: f64| {
        let scaled = |motion: &Option<Motion>| {
            motion
                .as_ref()
                .map(|motion| motion.scaled(factor))
                .transpose()
        };
        let (Ok(horizontal), Ok(vertical)) =
            (scaled(&request.horizontal), scaled(&request.vertical))
        else {
            return false;
        };
        let motion = base(&horizontal, &vertical);
        let found = request.object.follow(motion, &how);
        found.map_or(true, |found| found.rocking.outcome != outcome)
    };
    [1.0 - CHANGE_RATIO, 1.0 + CHANGE_RATIO]
        .into_iter()
        .any(is_other)
}

/// The duration of four swings of a rigid block released in the same way, or that of a fall if it
/// does not swing back.
fn natural_duration_s(block: &Block, how: &HistoryOptions) -> f64 {
    let Release {
        rotation_rad,
        omega_rad_s,
    } = how.start;
    let pivot = if rotation_rad > 0.0 {
        block.right_pivot()
    } else {
        block.pivot()
    };
    let p = pivot.frequency_parameter_rad_s(how.settings.gravity_m_s2);
    let share = rotation_rad.abs() / pivot.slenderness_angle_rad;
    let swings = omega_rad_s == 0.0 && 0.0 < share && share < 1.0;
    let free = swings.then(|| 2.0 * FREE_SWINGS * (1.0 / (1.0 - share)).acosh() / p);
    free.map_or(FALL_TIMES / p, |time_s| time_s.min(FALL_TIMES / p))
}

/// A linear cushion with c = 2ζ√(k m) under the edge of a mass m \[N s/m\].
///
/// # Errors
/// A stiffness or a damping that no cushion can have.
pub fn damped(mass_kg: f64, stiffness_n_m: f64, damping_ratio: f64) -> Result<Cushion, Problem> {
    let damping_n_s_m = 2.0 * damping_ratio * (stiffness_n_m * mass_kg).sqrt();
    let law = if damping_ratio > 0.0 {
        ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        }
    } else {
        ContactLaw::Linear { stiffness_n_m }
    };
    Cushion::new(law).map_err(|error| {
        Problem::value(
            error.to_string(),
            "check the stiffness and the damping of the cushion",
        )
    })
}

/// Eq. (5) for a rise of the centre of gravity, on any cushion: the landing of m_eff at the edge's
/// velocity \[m/s²\].
pub fn paper_edge_acceleration_m_s2(
    block: &Block,
    base: &CompliantBase,
    cg_rise_m: f64,
    gravity_m_s2: f64,
) -> f64 {
    let landing = Landing::rocking(block, ImpactModel::Paper);
    landing.edge_acceleration_m_s2(base.mass_kg, &base.cushion, cg_rise_m, gravity_m_s2)
}

/// The base with undamped cushions, as Eq. (5) assumes.
fn undamped(base: &CompliantBase) -> CompliantBase {
    let law = match *base.cushion.law() {
        ContactLaw::KelvinVoigt { stiffness_n_m, .. } => ContactLaw::Linear { stiffness_n_m },
        ContactLaw::HuntCrossley {
            coefficient_n_mn,
            exponent,
            ..
        } => ContactLaw::Power {
            coefficient_n_mn,
            exponent,
        },
        _ => return base.clone(),
    };
    // The remaining numbers are valid for a cushion.
    Cushion::new(law).map_or_else(
        |_| base.clone(),
        |cushion| CompliantBase {
            cushion,
            ..base.clone()
        },
    )
}

fn report(request: &CompliantRequest, history: PadHistory) -> CompliantReport {
    let Pads { planes, base } = &request.object;
    let (block, settings) = (&planes.one.block, &request.how.settings);
    let rocking = &history.rocking;
    let is_up = matches!(rocking.outcome, Outcome::Rocked | Outcome::Unresolved);
    let landed = |base: &CompliantBase| {
        let a = is_up.then(|| {
            paper_edge_acceleration_m_s2(block, base, rocking.cg_rise_m, settings.gravity_m_s2)
        });
        a.filter(|a| *a > 0.0 && a.is_finite())
    };
    let (paper_m_s2, damped_m_s2) = (landed(&undamped(base)), landed(base));
    let is_release = request.horizontal.is_none() && request.vertical.is_none();
    let first_m_s2 = rocking
        .touches
        .first()
        .filter(|_| is_release)
        .map(|touch| touch.peak_acceleration_m_s2);
    let answer = PadAnswer::of(
        rocking,
        request,
        block,
        base,
        paper_m_s2,
        damped_m_s2,
        first_m_s2,
    );
    CompliantReport {
        answer,
        doubts: doubts(request, rocking),
        base: base.clone(),
        history,
    }
}

/// An acceleration \[m/s²\] in g.
fn in_g(acceleration_m_s2: f64) -> f64 {
    acceleration_m_s2 / G0_M_S2
}

/// Largest relative error of the energy balance that causes no warning.
const ENERGY_LIMIT: f64 = 1e-5;

fn doubts(request: &CompliantRequest, rocking: &CompliantRocking) -> Vec<HistoryDoubt> {
    let (base, pad_thickness_m) = (&request.object.base, request.pad_thickness_m);
    let is_shaken = request.horizontal.is_some() || request.vertical.is_some();
    let mut of_cushion = stiffness_warnings(base.mass_kg, &base.cushion, pad_thickness_m);
    of_cushion.extend(compression_warnings(
        rocking.peak_compression_m,
        &base.cushion,
        pad_thickness_m,
    ));
    let is_soft = rocking.equilibrium.is_none();
    of_cushion
        .into_iter()
        .map(HistoryDoubt::Validity)
        .chain(rings(&base.cushion, is_shaken))
        .chain(is_soft.then_some(HistoryDoubt::TooSoft))
        .chain(energy_error(rocking.energy.residual_ratio))
        .chain(unresolved(rocking.outcome))
        .collect()
}

/// Undamped cushions under a motion.
pub(crate) fn rings(cushion: &Cushion, is_shaken: bool) -> Option<HistoryDoubt> {
    (is_shaken && !cushion.law().is_damped()).then_some(HistoryDoubt::Undamped)
}

/// An energy balance that does not close.
pub(crate) fn energy_error(residual_ratio: f64) -> Option<HistoryDoubt> {
    (residual_ratio > ENERGY_LIMIT).then_some(HistoryDoubt::EnergyError(residual_ratio))
}

/// The columns of a history.
pub fn history_head(history: &[CompliantPoint]) -> String {
    let mut head = String::from(
        "time_s,theta_rad,omega_rad_s,x_m,z_m,edge_acceleration_left_g,edge_acceleration_right_g",
    );
    if let Some(first) = history.first() {
        head.push_str(
            &",at_horizontal_g,at_vertical_g".repeat(first.point_accelerations_m_s2.len()),
        );
        for index in 1..=first.contact_forces_n.len() {
            head.push_str(&format!(
                ",normal_force_{index}_n,tangential_force_{index}_n"
            ));
        }
    }
    head
}

/// A row of a history.
pub fn history_row(p: &CompliantPoint) -> Vec<f64> {
    let points = p.point_accelerations_m_s2.iter().flat_map(|&(h, v)| [h, v]);
    let in_g = p
        .edge_accelerations_m_s2
        .into_iter()
        .chain(points)
        .map(|a| a / G0_M_S2);
    let forces = p
        .contact_forces_n
        .iter()
        .flat_map(|&(right, up)| [up, right]);
    [p.time_s, p.theta_rad, p.omega_rad_s, p.x_m, p.z_m]
        .into_iter()
        .chain(in_g)
        .chain(forces)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use freestand::compliant::CompliantAccuracy;
    use freestand::respond::{Along, Plane, Planes, Settings};

    fn request(damping_ratio: f64) -> CompliantRequest {
        let block = Block::uniform(2.3, 0.6).unwrap();
        let rotation_rad = block.right_pivot().rotation_at_rise_rad(0.016).unwrap();
        let base = CompliantBase::new(140.0, damped(140.0, 4.38e6, damping_ratio).unwrap());
        let along = Along::X;
        CompliantRequest {
            object: Pads {
                planes: Planes::single(Plane { along, block }),
                base,
            },
            pad_thickness_m: None,
            notes: Vec::new(),
            horizontal: None,
            vertical: None,
            how: HistoryOptions {
                settings: Settings {
                    on_pads: CompliantAccuracy::Standard,
                    ..Settings::default()
                },
                start: Release {
                    rotation_rad,
                    omega_rad_s: 0.0,
                },
                points_m: vec![(0.3, 1.15)],
                is_sampled: true,
            },
        }
    }

    /// Eq. (5) at the rise of the release by hand: 4.526 g at 9.81 m/s², √(9.80665/9.81) of the
    /// acceleration and the unit the other way, so 4.527 at 9.80665; the peak of the first landing
    /// is 0.79 of it.
    #[test]
    fn a_release_is_compared_with_equation_5() {
        let report = rock_on_cushions(&request(0.0)).unwrap();
        assert!((report.answer.edge_acceleration_paper_g.unwrap() - 4.5268).abs() < 1e-3);
        assert!((report.answer.first_impact_over_paper_ratio.unwrap() - 0.79).abs() < 0.005);
        assert!((report.history.rocking.cg_rise_m - 0.016).abs() < 1e-12);
        assert_eq!(report.answer.outcome, "rocked");
        assert!(
            (report.answer.static_compression_m.unwrap() - 140.0 * G0_M_S2 / (2.0 * 4.38e6)).abs()
                < 1e-15
        );
        assert!(
            report.history.rocking.energy.residual_ratio < 1e-7 && report.doubts.is_empty(),
            "{:?}",
            report.doubts
        );
        let samples = &report.history.samples;
        assert_eq!(history_head(samples).split(',').count(), 13);
        assert!(samples.iter().all(|point| history_row(point).len() == 13));
        // The samples show the pulse, as fine as they are: 1 − cos(π/80) = 0.08 % below its peak.
        let sampled = report
            .history
            .samples
            .iter()
            .map(|p| p.edge_accelerations_m_s2[0])
            .fold(0.0, f64::max)
            / G0_M_S2;
        let peak_g = report.answer.edge_acceleration_left_g;
        assert!(sampled <= peak_g && sampled > 0.995 * peak_g);
    }

    /// ζ of the mass: c = 2 · 0.05 √(4.38e6 · 140).
    #[test]
    fn damping_is_that_of_the_mass() {
        let expected = 0.1 * (4.38e6 * 140.0f64).sqrt();
        let ContactLaw::KelvinVoigt { damping_n_s_m, .. } =
            *request(0.05).object.base.cushion.law()
        else {
            panic!("a damped cushion")
        };
        assert!((damping_n_s_m / expected - 1.0).abs() < 1e-12);
        let report = rock_on_cushions(&request(0.05)).unwrap();
        // Eq. (5) knows no damping; the landing of the effective mass does: of it ζ is
        // 0.05/√(1 − 0.1875 x) = 0.05124, and exp(−ζ w t*) = 0.92988.
        assert!((report.answer.edge_acceleration_paper_g.unwrap() - 4.5268).abs() < 1e-3);
        let ratio = report.answer.edge_acceleration_effective_mass_g.unwrap()
            / report.answer.edge_acceleration_paper_g.unwrap();
        assert!((ratio - 0.92988).abs() < 1e-5, "{ratio}");
        assert!(report.history.rocking.energy.cushion_dissipation_j > 0.0);
    }

    #[test]
    fn too_soft_a_cushion_is_a_problem_with_a_hint() {
        let mut request = request(0.0);
        request.object.base.cushion = Cushion::linear(4380.0).unwrap();
        request.how.start = Release::default();
        request.how.settings.until = Until::Time(1.0);
        let problem = rock_on_cushions(&request).unwrap_err();
        assert!(problem.message.contains("too soft") && problem.hint.is_some());
    }
}
