//! The response of an object in one world: about each of its axes, on a rigid base and on its pads.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::{CompliantRocking, CompliantSummary, PadOutcome};
use freestand::cushion::Cushion;
use freestand::rocking::{
    Outcome, Restitution, RockingError, RockingOptions, RockingSummary, SideExtremes, Until,
};
use freestand::spatial::{BaseLandings, BodyMotion, StackPart};
use freestand::wall::Walls;
use freestand::wall_shock::{WallShock, largest};

use freestand_study::run::LONGEST_TAIL_S;

use super::capacity::{Capacity, Demand, Terms};
use super::draw::Draw;
use super::object::{Hit, Model, Subject, hit};
use super::pulse::Pulses;

/// One axis on a rigid base.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct AxisMotion {
    pub(super) rocking: RockingSummary,
    /// `None`: overturned, or mass or cushion is not known.
    pub(super) hit: Option<Hit>,
    /// The hardest impact on a wall; `None`: there was none.
    pub(super) strike: Option<Strike>,
    /// `None`: it neither rolls nor slides without rocking.
    pub(super) roll: Option<Roll>,
    /// `None`: demand or capacity is not known.
    pub(super) terms: Option<Terms>,
}

/// What an object that rolls or slides does in the plane of one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Roll {
    /// The largest distance from where it stood, as if nothing were in the way \[m\].
    pub(super) travel_m: f64,
    /// Whether one component of the floor is all that is known, so that it travels farther.
    pub(super) is_at_least: bool,
    /// Speed at which it reaches its stop; `None`: it does not \[m/s\].
    pub(super) stop_speed_m_s: Option<f64>,
}

/// The hardest impact on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strike {
    /// v_w \[m/s\].
    pub(super) speed_m_s: f64,
    /// a_w; `None`: the mass of the object or the stiffness of the wall is not known \[m/s²\].
    pub(super) acceleration_m_s2: Option<f64>,
    restitution_ratio: f64,
}

impl Strike {
    fn new(
        subject: &Subject,
        draw: &Draw,
        axis: usize,
        block: &Block,
        sides: [SideExtremes; 2],
    ) -> Option<Self> {
        let beside = subject.way.walls()?;
        // The solver has refused what it refuses.
        let contacts = draw.walls(subject, axis).contacts(block).ok()?;
        let shocks = WallShock::of_sides(block, contacts);
        let stiff = draw.mass_kg(subject).zip(beside.stiffness_n_m);
        let acceleration = |(mass_kg, stiffness_n_m)| {
            largest(shocks, sides, |shock, omega| {
                shock.acceleration_m_s2(omega, mass_kg, stiffness_n_m)
            })
        };
        Some(Self {
            speed_m_s: largest(shocks, sides, WallShock::speed_m_s)?,
            acceleration_m_s2: stiff.and_then(acceleration),
            // Both sides have the same.
            restitution_ratio: contacts.iter().flatten().next()?.restitution_ratio,
        })
    }

    /// As the demand of a shock: a half-sine of π v_w/a_w.
    fn demand(&self) -> Option<Demand> {
        let edge_m_s2 = self
            .acceleration_m_s2
            .filter(|acceleration| *acceleration > 0.0)?;
        Some(Demand {
            edge_m_s2,
            velocity_change_m_s: (1.0 + self.restitution_ratio) * self.speed_m_s,
            duration_s: std::f64::consts::PI * self.speed_m_s / edge_m_s2,
        })
    }
}

/// One axis on its pads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PadMotion {
    pub(super) has_overturned: bool,
    /// Whether an edge let go of its pad.
    pub(super) has_let_go: bool,
    /// U; `None` from a solver that does not know it.
    pub(super) pad_uplift_ratio: Option<f64>,
    pub(super) lift_m: f64,
    /// With the factor of the world \[m/s²\].
    pub(super) edge_m_s2: f64,
    pub(super) compression_m: f64,
    /// `None`: it moves in a plane.
    pub(super) space: Option<Space>,
    /// The body of a stack that falls first; `None`: none does.
    pub(super) fallen: Option<StackPart>,
    /// `None`: demand or capacity is not known.
    pub(super) terms: Option<Terms>,
}

/// Why a history on a rigid base has no end.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Lost {
    /// The floor falls away, and the object flies.
    Flight(String),
    /// Anything else.
    Failed(String),
}

impl Lost {
    pub(super) fn failed(why: impl std::fmt::Display) -> Self {
        Self::Failed(why.to_string())
    }

    pub(super) fn why(&self) -> &str {
        match self {
            Self::Flight(why) | Self::Failed(why) => why,
        }
    }
}

/// Why an object that still moves long after the motion has no answer.
const UNRESOLVED: &str = "the object is neither at rest nor down long after the motion";

/// The outcome of a history, or why it has none.
///
/// # Errors
/// It ended before it was certain what becomes of the object.
pub(super) fn resolved(outcome: Outcome) -> Result<(), Lost> {
    if outcome == Outcome::Unresolved {
        Err(Lost::failed(UNRESOLVED))
    } else {
        Ok(())
    }
}

impl From<RockingError> for Lost {
    fn from(error: RockingError) -> Self {
        match error {
            RockingError::FreeFlight { .. } => Self::Flight(error.to_string()),
            _ => Self::Failed(error.to_string()),
        }
    }
}

/// What an object does in three dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Space {
    /// Largest angle of its axis to the vertical \[rad\].
    pub(super) tilt_rad: f64,
    /// Largest horizontal displacement of the centre of its base \[m\].
    pub(super) walk_m: f64,
}

/// The object on a rigid base: every axis, or why a history failed.
pub(super) type RigidResponse = Result<Vec<AxisMotion>, Lost>;

/// The object on its pads: every axis, or why a history failed.
pub(super) type PadResponse = Result<Vec<PadMotion>, String>;

/// An object in one world.
#[derive(Debug, Clone)]
pub(super) struct Lived {
    pub(super) draw: Draw,
    /// `None`: the model is not asked.
    pub(super) rigid: Option<RigidResponse>,
    /// `None`: the model was not asked in this world.
    pub(super) pads: Option<PadResponse>,
    /// Whether rocking needs more friction than the list gives it: it slides as well.
    pub(super) slips: bool,
    /// Peak acceleration of its floor \[m/s²\].
    pub(super) pfa_m_s2: f64,
    /// Peak velocity of its floor \[m/s\].
    pub(super) pfv_m_s: f64,
}

impl Lived {
    /// Whether its pads answer for both models: a rigid base can follow neither an object that slides
    /// while it rocks nor one that flies.
    pub(super) fn is_for_pads(&self) -> bool {
        let flies = matches!(self.rigid, Some(Err(Lost::Flight(_))));
        (self.slips || flies) && self.on_pads().is_some()
    }

    /// The model whose history in this world answers where `model` is asked.
    pub(super) fn answering(&self, model: Model) -> Model {
        if self.is_for_pads() {
            Model::Pads
        } else {
            model
        }
    }

    /// Why the history on a rigid base failed, where nothing else answers.
    pub(super) fn failure(&self) -> Option<&Lost> {
        self.rigid
            .as_ref()?
            .as_ref()
            .err()
            .filter(|_| !self.is_for_pads())
    }

    /// On a rigid base; `None`: not asked, or a history failed.
    pub(super) fn on_rigid(&self) -> Option<&[AxisMotion]> {
        self.rigid.as_ref()?.as_deref().ok()
    }

    /// On its pads; `None`: not asked, or a history failed.
    pub(super) fn on_pads(&self) -> Option<&[PadMotion]> {
        self.pads.as_ref()?.as_deref().ok()
    }
}

/// The options of every history on a rigid base, the same as in `run`.
pub(super) fn options(restitution: Restitution, walls: Walls) -> RockingOptions {
    RockingOptions {
        restitution,
        walls,
        until: Until::Settled {
            at_most_s: LONGEST_TAIL_S,
        },
        ..RockingOptions::default()
    }
}

/// Shock and demand of a history with the values of its world.
pub(super) fn axis_motion(
    subject: &Subject,
    draw: &Draw,
    axis: usize,
    block: &Block,
    rocking: RockingSummary,
    body: Option<&(f64, Cushion)>,
    floor_m_s2: f64,
) -> AxisMotion {
    let has_fallen = rocking.outcome.has_fallen();
    let strike = Strike::new(subject, draw, axis, block, rocking.sides);
    // Where a cushion bottoms, no shock is known.
    let found = body.filter(|_| !has_fallen).and_then(|(mass_kg, cushion)| {
        let mut hit = hit(block, &rocking, *mass_kg, cushion)?;
        // The formula of an undamped cushion is 2 v.
        hit.velocity_change_m_s *= 0.5 * (1.0 + draw.rebound_restitution());
        Some(hit)
    });
    let terms = subject.capacity.as_ref().and_then(|capacity| {
        if has_fallen {
            return Some(Terms::OVERTURNED);
        }
        let demand = found.as_ref().map(|hit| Demand {
            edge_m_s2: draw.model * hit.larger_g() * G0_M_S2,
            velocity_change_m_s: hit.velocity_change_m_s,
            duration_s: hit.duration_s,
        });
        let is_at_rest = rocking.outcome == Outcome::NoUplift;
        let edge = terms(capacity, demand, is_at_rest, rocking.uplift_m, floor_m_s2)?;
        // The shock at the wall counts where it is the harder one.
        let wall = strike.as_ref().and_then(Strike::demand);
        let wall = wall
            .and_then(|demand| terms(capacity, Some(demand), false, rocking.uplift_m, floor_m_s2));
        Some(
            wall.filter(|wall| wall.ratio() > edge.ratio())
                .unwrap_or(edge),
        )
    });
    AxisMotion {
        rocking,
        hit: found,
        strike,
        roll: None,
        terms,
    }
}

pub(super) fn terms(
    capacity: &Capacity,
    demand: Option<Demand>,
    is_at_rest: bool,
    uplift_m: f64,
    floor_m_s2: f64,
) -> Option<Terms> {
    capacity.terms(demand, is_at_rest, uplift_m, floor_m_s2, |duration_s| {
        capacity.severity_ratio(duration_s)
    })
}

/// What a history on pads means in its world.
pub(super) fn pad_motion(
    subject: &Subject,
    draw: &Draw,
    found: &CompliantSummary,
    floor_m_s2: f64,
) -> PadMotion {
    let edge_m_s2 = draw.compliant * found.peak_edge_acceleration_m_s2();
    let demand = Demand {
        edge_m_s2,
        velocity_change_m_s: found.velocity_change_m_s,
        duration_s: found.pulse_duration_s.unwrap_or(0.0),
    };
    let has_overturned = found.outcome == PadOutcome::Overturned;
    let is_at_rest = found.touch_count == 0;
    let terms = |capacity: &Capacity| match has_overturned {
        true => Some(Terms::OVERTURNED),
        false => terms(capacity, Some(demand), is_at_rest, found.lift_m, floor_m_s2),
    };
    PadMotion {
        has_overturned,
        has_let_go: found.outcome != PadOutcome::StayedOn,
        pad_uplift_ratio: Some(found.pad_uplift_ratio),
        lift_m: found.lift_m,
        edge_m_s2,
        compression_m: found.peak_compression_m,
        space: None,
        fallen: None,
        terms: subject.capacity.as_ref().and_then(terms),
    }
}

/// The same from the solver for any contact law.
pub(super) fn pad_motion_of(
    subject: &Subject,
    draw: &Draw,
    found: &CompliantRocking,
    pulses: Pulses,
    floor_m_s2: f64,
) -> PadMotion {
    let (velocity_change_m_s, pulse_duration_s) = pulses.found(found);
    let summary = CompliantSummary {
        outcome: pad_outcome(found.outcome),
        pad_uplift_ratio: 0.0,
        lift_m: found.uplift_m,
        peak_edge_accelerations_m_s2: found.peak_edge_accelerations_m_s2,
        touch_count: found.touches.len(),
        touch_speed_m_s: found
            .touches
            .iter()
            .map(|touch| touch.speed_m_s)
            .fold(0.0, f64::max),
        velocity_change_m_s,
        pulse_duration_s,
        contact_duration_s: None,
        peak_compression_m: found.peak_compression_m,
        let_go_time_s: None,
        first_uplift_time_s: found.first_uplift_time_s,
        overturn_time_s: found.overturn_time_s,
    };
    PadMotion {
        pad_uplift_ratio: None,
        ..pad_motion(subject, draw, &summary, floor_m_s2)
    }
}

/// An object that its pads do not keep upright.
pub(super) const TOPPLED: PadMotion = PadMotion {
    has_overturned: true,
    has_let_go: true,
    pad_uplift_ratio: None,
    lift_m: 0.0,
    edge_m_s2: 0.0,
    compression_m: 0.0,
    space: None,
    fallen: None,
    terms: Some(Terms::OVERTURNED),
};

/// What a history of bodies in space means in its world.
pub(super) fn space_motion(
    subject: &Subject,
    draw: &Draw,
    (outcome, body, landings): (Outcome, &BodyMotion, &BaseLandings),
    floor_m_s2: f64,
) -> PadMotion {
    let summary = CompliantSummary {
        outcome: pad_outcome(outcome),
        pad_uplift_ratio: 0.0,
        lift_m: body.uplift_m,
        peak_edge_accelerations_m_s2: [landings.peak_acceleration_m_s2; 2],
        // Whether it landed at all is what counts.
        touch_count: usize::from(landings.pulse_duration_s.is_some()),
        touch_speed_m_s: 0.0,
        velocity_change_m_s: landings.velocity_change_m_s,
        pulse_duration_s: landings.pulse_duration_s,
        contact_duration_s: None,
        peak_compression_m: landings.peak_compression_m,
        let_go_time_s: None,
        first_uplift_time_s: body.first_uplift_time_s,
        overturn_time_s: body.overturn_time_s,
    };
    let space = Space {
        tilt_rad: body.peak_tilt_rad,
        walk_m: body.base_slide_peak_m,
    };
    PadMotion {
        pad_uplift_ratio: None,
        space: Some(space),
        ..pad_motion(subject, draw, &summary, floor_m_s2)
    }
}

fn pad_outcome(outcome: Outcome) -> PadOutcome {
    match outcome {
        Outcome::Overturned | Outcome::Leaned => PadOutcome::Overturned,
        Outcome::Rocked | Outcome::Unresolved => PadOutcome::LetGo,
        Outcome::NoUplift => PadOutcome::StayedOn,
    }
}

/// Whether it falls about any axis, onto the floor or against a wall.
pub(super) fn overturned(axes: &[AxisMotion]) -> bool {
    axes.iter().any(|one| one.rocking.outcome.has_fallen())
}

/// Whether it ends leaning on a wall, and does not fall onto the floor.
pub(super) fn leans(axes: &[AxisMotion]) -> bool {
    let ends = |outcome: Outcome| axes.iter().any(|one| one.rocking.outcome == outcome);
    ends(Outcome::Leaned) && !ends(Outcome::Overturned)
}

/// Whether there is uplift about any axis.
pub(super) fn lifts(axes: &[AxisMotion]) -> bool {
    axes.iter()
        .any(|one| one.rocking.outcome != Outcome::NoUplift)
}

/// The governing axis: the one that overturns, else the one with the largest demand/capacity, else
/// shock, else rise.
pub(super) fn governing(axes: &[AxisMotion]) -> Option<(usize, &AxisMotion)> {
    let rank = |one: &AxisMotion| {
        let shock_g = one.hit.as_ref().map_or(0.0, Hit::larger_g);
        let ratio = one.terms.map_or(0.0, |terms| terms.ratio());
        (
            one.rocking.outcome.has_fallen(),
            ratio,
            shock_g,
            one.rocking.cg_rise_m,
        )
    };
    axes.iter().enumerate().reduce(|most, next| {
        if rank(next.1) > rank(most.1) {
            next
        } else {
            most
        }
    })
}

/// Largest number over the axes, +∞ where one overturns.
pub(super) fn ranked(axes: &[AxisMotion], number: impl Fn(&AxisMotion) -> f64) -> f64 {
    if overturned(axes) {
        f64::INFINITY
    } else {
        axes.iter().map(number).fold(0.0, f64::max)
    }
}

/// Demand/capacity about the worse axis; `None` where that of one axis is not known.
pub(super) fn demand_capacity(axes: &[AxisMotion]) -> Option<f64> {
    worst(axes.iter().map(|one| one.terms))
}

/// The same on pads.
pub(super) fn pads_demand_capacity(axes: &[PadMotion]) -> Option<f64> {
    worst(axes.iter().map(|one| one.terms))
}

fn worst(terms: impl Iterator<Item = Option<Terms>>) -> Option<f64> {
    let mut known = Some(0.0f64);
    for one in terms {
        let ratio = one.map(|terms| terms.ratio());
        if ratio == Some(f64::INFINITY) {
            return ratio;
        }
        known = known.zip(ratio).map(|(most, ratio)| most.max(ratio));
    }
    known
}
