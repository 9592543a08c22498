//! One history of an object on its cushions, compared with Eq. (5): request → report.

mod figure;

pub use figure::trace_figure;
use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::{CompliantBase, CompliantPoint, CompliantRocking, Swing, Touch};
use freestand::cushion::{ContactLaw, Cushion};
use freestand::impact::{ImpactModel, Landing, compression_warnings, stiffness_warnings};
use freestand::motion::Motion;
use freestand::respond::{HistoryOptions, PadHistory, Pads, Release};
use freestand::rocking::{Base, Outcome, Until};

use crate::unsolved::{self, unresolved_warning};
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, format_si};
use freestand_output::facts;
use freestand_output::facts::{Facts, Value};
use freestand_output::rows::table_of_numbers;
use freestand_output::table::Table;

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
    /// How the cushion was read, in words.
    pub notes: Vec<String>,
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

/// What the object did.
///
/// In the facts `edge_acceleration_g` is the largest of the history, `…_paper_g` Eq. (5) at the
/// same rise without the cushion's damping, `…_effective_mass_g` the landing of the same effective
/// mass with it. An impact is a contact of an edge with its cushion; `first_impact_…` belong to a
/// release and are missing under a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantReport {
    /// The document of `freestand rock` with a compliant base.
    pub facts: Facts<'static>,
    /// What the object rests on.
    pub base: CompliantBase,
    /// Warnings about the validity of the result.
    pub warnings: Vec<String>,
    /// Its history.
    pub history: PadHistory,
}

/// Calculates the motion of the object.
///
/// # Errors
/// The errors of the solver, each with a hint, and a history that is too long to sample.
pub fn rock_on_cushions(request: &CompliantRequest) -> Result<CompliantReport, Problem> {
    let motion = Base {
        horizontal: request.horizontal.as_ref(),
        vertical: request.vertical.as_ref(),
    };
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
        report.warnings.push(ONE_REALISATION.to_owned());
    }
    Ok(report)
}

/// What a single history is worth where a small change of the motion ends it differently.
const ONE_REALISATION: &str = "one realisation: another outcome follows from a motion that differs by 0.01 %; trust \
                               shares over many motions, not this history";

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
        let motion = Base {
            horizontal: horizontal.as_ref(),
            vertical: vertical.as_ref(),
        };
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
    let pivot = block.pivot();
    let alphas = [pivot, block.right_pivot()].map(|pivot| pivot.slenderness_angle_rad);
    let is_up = matches!(rocking.outcome, Outcome::Rocked | Outcome::Unresolved);
    let landed = |base: &CompliantBase| {
        let a = is_up.then(|| {
            paper_edge_acceleration_m_s2(block, base, rocking.cg_rise_m, settings.gravity_m_s2)
        });
        a.filter(|a| *a > 0.0 && a.is_finite())
    };
    let (paper_m_s2, damped_m_s2) = (landed(&undamped(base)), landed(base));
    let peak_m_s2 = rocking.peak_edge_acceleration_m_s2();
    // Under a motion the first touch is not the one that follows the largest rise.
    let is_release = request.horizontal.is_none() && request.vertical.is_none();
    let first_m_s2 = rocking
        .touches
        .first()
        .filter(|_| is_release)
        .map(|touch| touch.peak_acceleration_m_s2);
    let first_over_paper = paper_m_s2
        .zip(first_m_s2)
        .map(|(paper, first)| first / paper);
    let in_g = |a: f64| a / G0_M_S2;
    let (peak_g, edges_g) = (
        in_g(peak_m_s2),
        rocking.peak_edge_accelerations_m_s2.map(in_g),
    );
    let force_n = rocking.peak_edge_forces_n[0].max(rocking.peak_edge_forces_n[1]);
    let share = rocking.peak_rotation_rad / alphas[0].min(alphas[1]);
    let at = request
        .how
        .points_m
        .first()
        .zip(rocking.points.first())
        .map(|(&(x_m, z_m), peaks)| {
            let at = Facts::default().key("x_m", x_m).key("z_m", z_m);
            at.fact(
                "horizontal_g",
                "acceleration of the point, horizontal",
                in_g(peaks.horizontal_m_s2),
            )
            .fact(
                "vertical_g",
                "acceleration of the point, vertical",
                in_g(peaks.vertical_m_s2),
            )
        });
    let rest = rocking.equilibrium;
    let sunk_m = rest.map(|rest| rest.compressions_m[0].max(rest.compressions_m[1]));
    let restitution = rocking
        .swings
        .iter()
        .find_map(|swing| swing.effective_restitution_ratio);
    let energy = facts!(rocking.energy; initial_j, kinetic_j, potential_j, stored_j, cushion_dissipation_j,
        tangential_dissipation_j, friction_j, lost_at_separation_j, base_work_j, turnover_j,
        residual_ratio "error of the energy balance");
    let facts = Facts::default()
        .key("base", "compliant")
        .fact("outcome", "outcome", rocking.outcome.name())
        .and(facts!(rocking; end_time_s "end", peak_rotation_rad "largest rotation"))
        .fact("peak_rotation_ratio", "  divided by α", share)
        .fact("peak_rotation_time_s", "  at", rocking.peak_rotation_time_s)
        .and(facts!(rocking; uplift_m "uplift", cg_rise_m "rise of the centre of gravity",
            first_uplift_time_s "first uplift"))
        .fact("impact_count", "impacts", rocking.touches.len())
        .key("impacts", rocking.touches.iter().map(touch).collect::<Vec<_>>())
        .and(facts!(rocking; bounce_count "bounces", flight_count "times airborne", flight_time_s "time airborne"))
        .key("swings", rocking.swings.iter().map(swing).collect::<Vec<_>>())
        .and(facts!(rocking; passed_alpha_time_s "passes the balance point", overturn_time_s "overturns"))
        .fact("edge_acceleration_g", "shock, simulated", peak_g)
        .key("edge_acceleration_left_g", edges_g[0])
        .key("edge_acceleration_right_g", edges_g[1])
        .fact("first_impact_edge_acceleration_g", "  in the first impact", first_m_s2.map(in_g))
        .fact("edge_acceleration_paper_g", "shock by Eq. (5) at this rise", paper_m_s2.map(in_g))
        .key("edge_acceleration_effective_mass_g", damped_m_s2.map(in_g))
        .fact("edge_acceleration_over_paper_ratio", "simulated over Eq. (5)", paper_m_s2.map(|paper| peak_m_s2 / paper))
        .fact("first_impact_over_paper_ratio", "first impact over Eq. (5)", first_over_paper)
        // These belong to the rigid base: here friction is simulated, and the cushion determines
        // the energy that a landing loses.
        .key("friction_needed_ratio", Value::Missing)
        .key("impact_friction_needed_ratio", Value::Missing)
        .key("edge_acceleration_impact_velocity_g", Value::Missing)
        .key("ceiling_g", Value::Missing)
        .key("edge_force_n", force_n)
        .key("compression_m", rocking.peak_compression_m)
        .and(facts!(rocking; friction_used_ratio "friction used", slid_m "sliding distance"))
        .key("at", at)
        .key("restitution_ratio", restitution)
        .fact("static_compression_m", "compression at rest", sunk_m)
        .key("static_compressions_m", rest.map(|rest| rest.compressions_m))
        .key("static_rotation_rad", rest.map(|rest| rest.rotation_rad))
        .key("energy", energy)
        .and(facts!(rocking; final_rotation_rad, final_omega_rad_s))
        .and(facts!(pivot; half_diagonal_m, slenderness_angle_rad))
        .key("frequency_parameter_rad_s", pivot.frequency_parameter_rad_s(settings.gravity_m_s2))
        .key("mass_kg", base.mass_kg)
        .key("law", base.cushion.law().name())
        .and(facts!(base; contacts, tangential_stiffness_ratio, friction_ratio))
        .key("tolerance", settings.on_pads.tolerance())
        .and(facts!(rocking.effort; steps, evaluations))
        .fact("notes", "note", request.notes.clone());
    CompliantReport {
        facts,
        warnings: warnings(request, rocking),
        base: base.clone(),
        history,
    }
}

fn touch(touch: &Touch) -> Facts<'static> {
    facts!(touch; time_s)
        .key("edge", <&str>::from(touch.edge))
        .and(facts!(touch; speed_m_s, omega_before_rad_s, omega_after_rad_s, end_time_s, rebound_m_s))
        .key("edge_acceleration_g", touch.peak_acceleration_m_s2 / G0_M_S2)
        .key("force_n", touch.peak_force_n)
}

/// A swing during which an edge is off its cushion. The restitution, √(Δh/Δh of the swing before),
/// is for free rocking only.
fn swing(swing: &Swing) -> Facts<'static> {
    facts!(swing; time_s, rotation_rad).key("restitution_ratio", swing.effective_restitution_ratio)
}

/// Largest relative error of the energy balance that causes no warning.
const ENERGY_LIMIT: f64 = 1e-5;

fn warnings(request: &CompliantRequest, rocking: &CompliantRocking) -> Vec<String> {
    let (base, pad_thickness_m) = (&request.object.base, request.pad_thickness_m);
    let is_shaken = request.horizontal.is_some() || request.vertical.is_some();
    let stiffness = stiffness_warnings(base.mass_kg, &base.cushion, pad_thickness_m);
    let mut warnings: Vec<String> = stiffness.iter().map(ToString::to_string).collect();
    let beyond = compression_warnings(rocking.peak_compression_m, &base.cushion, pad_thickness_m);
    warnings.extend(beyond.iter().map(ToString::to_string));
    warnings.extend(ringing_warning(&base.cushion, is_shaken));
    if rocking.equilibrium.is_none() {
        warnings.push(
            "the cushions are too soft to keep the object upright at rest: check their stiffness"
                .to_owned(),
        );
    }
    warnings.extend(energy_warning(rocking.energy.residual_ratio));
    warnings.extend(unresolved_warning(rocking.outcome));
    warnings
}

/// What is wrong with undamped cushions under a motion.
pub(crate) fn ringing_warning(cushion: &Cushion, is_shaken: bool) -> Option<String> {
    (is_shaken && !cushion.law().is_damped()).then(|| {
        "the cushions have no damping: under a motion the object keeps ringing on them, and the largest shock of a \
         long history depends on rounding; use a damped law, such as `law = \"kelvin-voigt\"` with `damping = \"5 %\"`"
            .to_owned()
    })
}

/// A warning about an energy balance that does not close.
pub(crate) fn energy_warning(residual_ratio: f64) -> Option<String> {
    (residual_ratio > ENERGY_LIMIT).then(|| {
        format!(
            "the energy balance has an error of {residual_ratio:.1e} of the energy exchanged: use `accuracy = \"tight\"`"
        )
    })
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

/// A history as CSV: position, edge accelerations, acceleration of the requested point, and the
/// forces of the contact elements on the object from left to right.
pub fn history_table(history: &[CompliantPoint]) -> Table {
    table_of_numbers(&history_head(history), history.iter().map(history_row))
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

    fn number(report: &CompliantReport, name: &str) -> f64 {
        report.facts.number(name).unwrap()
    }

    /// Eq. (5) at the rise of the release by hand: 4.526 g at 9.81 m/s², √(9.80665/9.81) of the
    /// acceleration and the unit the other way, so 4.527 at 9.80665; the peak of the first landing
    /// is 0.79 of it.
    #[test]
    fn a_release_is_compared_with_equation_5() {
        let report = rock_on_cushions(&request(0.0)).unwrap();
        assert!((number(&report, "edge_acceleration_paper_g") - 4.5268).abs() < 1e-3);
        assert!((number(&report, "first_impact_over_paper_ratio") - 0.79).abs() < 0.005);
        assert!((report.history.rocking.cg_rise_m - 0.016).abs() < 1e-12);
        assert_eq!(report.facts.text("outcome"), Some("rocked"));
        assert!(
            (number(&report, "static_compression_m") - 140.0 * G0_M_S2 / (2.0 * 4.38e6)).abs()
                < 1e-15
        );
        assert!(
            report.history.rocking.energy.residual_ratio < 1e-7 && report.warnings.is_empty(),
            "{:?}",
            report.warnings
        );
        let csv = history_table(&report.history.samples).to_string();
        let columns = |line: &str| line.split(',').count();
        assert!(csv.lines().all(|line| columns(line) == 13));
        assert_eq!(csv.lines().count(), report.history.samples.len() + 1);
        // The samples show the pulse, as fine as they are: 1 − cos(π/80) = 0.08 % below its peak.
        let sampled = report
            .history
            .samples
            .iter()
            .map(|p| p.edge_accelerations_m_s2[0])
            .fold(0.0, f64::max)
            / G0_M_S2;
        let peak_g = number(&report, "edge_acceleration_left_g");
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
        assert!((number(&report, "edge_acceleration_paper_g") - 4.5268).abs() < 1e-3);
        let ratio = number(&report, "edge_acceleration_effective_mass_g")
            / number(&report, "edge_acceleration_paper_g");
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
