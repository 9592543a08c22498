//! The response of an object in one world: about each of its axes, on a rigid base and on its pads.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::cushion::Cushion;
use freestand::hull::shake::{HullOutcome, HullRocking};
use freestand::respond::{Glide, Outcome, PadSummary, RespondError, Tilt};
use freestand::rocking::{Outcome as Rocking, RockingSummary, SideExtremes};
use freestand::spatial::StackPart;
use freestand::wall_shock::{WallShock, largest};

use super::demand::{Demand, Terms};
use super::draw::{Draw, Drawn};
use super::object::{Gliding, Hit, Model, Subject, hit};
use crate::capacity::Capacity;
use serde::{Deserialize, Serialize};

/// One axis on a rigid base, or rolling or sliding.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct AxisMotion {
    pub(super) moved: Moved,
    /// `None`: demand or capacity is not known.
    pub(super) terms: Option<Terms>,
}

/// What an object does about one axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Moved {
    /// It stands on its edges, and may rock.
    Rocks {
        rocking: RockingSummary,
        /// `None`: overturned, or mass or cushion is not known.
        hit: Option<Hit>,
        /// The hardest impact on a wall; `None`: there was none.
        strike: Option<Strike>,
    },
    /// It rolls or slides before it could rock.
    Glides(Glide),
    /// It moves in three dimensions on the points of its hull.
    OnHull(HullRocking),
}

impl AxisMotion {
    /// `None`: it rolls or slides.
    pub(super) fn rocking(&self) -> Option<&RockingSummary> {
        match &self.moved {
            Moved::Rocks { rocking, .. } => Some(rocking),
            Moved::Glides(_) | Moved::OnHull(_) => None,
        }
    }

    /// Whether it does not stand on its hull even before the floor moves.
    pub(super) fn tips_at_rest(&self) -> bool {
        matches!(&self.moved, Moved::OnHull(body) if body.outcome == HullOutcome::Unsettled)
    }

    pub(super) fn hit(&self) -> Option<&Hit> {
        match &self.moved {
            Moved::Rocks { hit, .. } => hit.as_ref(),
            Moved::Glides(_) | Moved::OnHull(_) => None,
        }
    }

    fn strike(&self) -> Option<&Strike> {
        match &self.moved {
            Moved::Rocks { strike, .. } => strike.as_ref(),
            Moved::Glides(_) | Moved::OnHull(_) => None,
        }
    }

    /// Largest speed at a wall; `None`: it strikes none \[m/s\].
    pub(super) fn wall_speed_m_s(&self) -> Option<f64> {
        match &self.moved {
            Moved::OnHull(body) => (body.wall_contacts > 0).then_some(body.wall_speed_m_s),
            _ => self.strike().map(|strike| strike.speed_m_s),
        }
    }

    /// Largest shock at a wall; `None`: it strikes none, or the shock is not known \[m/s²\].
    pub(super) fn wall_acceleration_m_s2(&self) -> Option<f64> {
        self.strike()?.acceleration_m_s2
    }

    /// 0 without a hit \[g\].
    pub(super) fn larger_g(&self) -> f64 {
        self.hit().map_or(0.0, Hit::larger_g)
    }

    /// Its largest rotation, or tilt; `None`: it rolls or slides \[rad\].
    pub(super) fn peak_rotation_rad(&self) -> Option<f64> {
        match &self.moved {
            Moved::Rocks { rocking, .. } => Some(rocking.peak_rotation_rad),
            Moved::OnHull(body) => Some(body.peak_tilt_rad),
            Moved::Glides(_) => None,
        }
    }

    /// How it ended, in the words of an object that rocks.
    pub(super) fn outcome(&self) -> Rocking {
        match &self.moved {
            Moved::Rocks { rocking, .. } => rocking.outcome,
            Moved::Glides(glide) if glide.has_tripped => Rocking::Overturned,
            Moved::Glides(_) => Rocking::NoUplift,
            Moved::OnHull(body) => match Outcome::on_hull(body) {
                Outcome::Overturned => Rocking::Overturned,
                Outcome::Leaned => Rocking::Leaned,
                Outcome::Unresolved => Rocking::Unresolved,
                Outcome::Rocked { .. } => Rocking::Rocked,
                _ => Rocking::NoUplift,
            },
        }
    }

    /// Whether it falls, onto the floor or against a wall, or its stop overturns it.
    pub(super) fn has_fallen(&self) -> bool {
        self.outcome().has_fallen()
    }

    /// Whether an edge lifts.
    pub(super) fn lifts(&self) -> bool {
        self.outcome() != Rocking::NoUplift
    }

    /// 0 where it rolls or slides \[m\].
    pub(super) fn uplift_m(&self) -> f64 {
        match &self.moved {
            Moved::Rocks { rocking, .. } => rocking.uplift_m,
            Moved::OnHull(body) => body.uplift_m,
            Moved::Glides(_) => 0.0,
        }
    }

    /// 0 where it rolls or slides \[m\].
    pub(super) fn cg_rise_m(&self) -> f64 {
        match &self.moved {
            Moved::Rocks { rocking, .. } => rocking.cg_rise_m,
            Moved::OnHull(body) => body.cg_rise_m,
            Moved::Glides(_) => 0.0,
        }
    }
}

/// The hardest impact on a wall.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Strike {
    /// v_w \[m/s\].
    speed_m_s: f64,
    /// a_w; `None`: the mass of the object or the stiffness of the wall is not known \[m/s²\].
    acceleration_m_s2: Option<f64>,
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

/// One axis on its pads, or the whole body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct PadMotion {
    pub(super) found: PadSummary,
    /// The shock of an edge, with the factor of the world \[m/s²\].
    pub(super) edge_m_s2: f64,
    /// `None`: it moves in a plane.
    pub(super) space: Option<Tilt>,
    /// The body of a stack that falls first; `None`: none does.
    pub(super) fallen: Option<StackPart>,
    /// `None`: demand or capacity is not known.
    pub(super) terms: Option<Terms>,
}

/// Why it is not known what an object does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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

    /// Mass or cushion, or another value that the model needs.
    pub(super) fn missing() -> Self {
        Self::failed("mass or cushion is missing")
    }

    /// The model that was asked has not answered.
    pub(super) fn no_history() -> Self {
        Self::failed("the history is missing")
    }

    pub(super) fn why(&self) -> &str {
        match self {
            Self::Flight(why) | Self::Failed(why) => why,
        }
    }
}

impl From<RespondError> for Lost {
    fn from(error: RespondError) -> Self {
        if error.is_flight() {
            Self::Flight(error.to_string())
        } else {
            Self::failed(error)
        }
    }
}

/// What one model says of an object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct ModelResponse<A> {
    /// How it ended.
    pub(super) outcome: Outcome,
    /// What it did about each of its axes, or as a whole.
    pub(super) axes: Vec<A>,
}

/// The object on a rigid base, or why a history failed.
pub(super) type RigidResponse = Result<ModelResponse<AxisMotion>, Lost>;

/// The object on its pads, or why a history failed.
pub(super) type PadResponse = Result<ModelResponse<PadMotion>, Lost>;

/// An object in one world.
#[derive(Debug, Clone, Serialize, Deserialize)]
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
    /// Peak velocity of its floor \[m/s\]; `None` where nobody is told of it.
    pub(super) pfv_m_s: Option<f64>,
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
    pub(super) fn on_rigid(&self) -> Option<&ModelResponse<AxisMotion>> {
        self.rigid.as_ref()?.as_ref().ok()
    }

    /// On its pads; `None`: not asked, or a history failed.
    pub(super) fn on_pads(&self) -> Option<&ModelResponse<PadMotion>> {
        self.pads.as_ref()?.as_ref().ok()
    }
}

/// Shock and demand of a history with the values of its world.
pub(super) fn axis_motion(
    Drawn { subject, draw }: Drawn<'_>,
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
        let is_at_rest = rocking.outcome == Rocking::NoUplift;
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
        moved: Moved::Rocks {
            rocking,
            hit: found,
            strike,
        },
        terms,
    }
}

/// An object that rolls or slides: it stays upright, or its stop overturns it.
pub(super) fn glided(
    Drawn { subject, draw }: Drawn<'_>,
    gliding: &Gliding,
    glide: Glide,
    through_m_s2: f64,
) -> AxisMotion {
    let terms = subject.capacity.as_ref().and_then(|capacity| {
        if glide.has_tripped {
            return Some(Terms::OVERTURNED);
        }
        let speed_m_s = glide.stop_speed_m_s;
        let demand =
            speed_m_s.and_then(|speed| stop_demand(gliding, draw.mass_kg(subject)?, speed));
        terms(capacity, demand, speed_m_s.is_none(), 0.0, through_m_s2)
    });
    AxisMotion {
        moved: Moved::Glides(glide),
        terms,
    }
}

/// A body on its hull: what its landings do to what is inside is not calculated.
pub(super) fn on_hull(
    Drawn { subject, .. }: Drawn<'_>,
    found: HullRocking,
    floor_m_s2: f64,
) -> AxisMotion {
    let outcome = Outcome::on_hull(&found);
    let terms = subject.capacity.as_ref().and_then(|capacity| {
        if outcome == Outcome::Overturned {
            return Some(Terms::OVERTURNED);
        }
        let is_at_rest = outcome == Outcome::Stood;
        terms(capacity, None, is_at_rest, found.uplift_m, floor_m_s2)
    });
    AxisMotion {
        moved: Moved::OnHull(found),
        terms,
    }
}

/// The shock of the stop, v √(k_s/m), a half-sine; an elastic stop turns the speed round. `None`:
/// its stiffness is not known.
fn stop_demand(gliding: &Gliding, mass_kg: f64, speed_m_s: f64) -> Option<Demand> {
    let omega_rad_s = (gliding.stop_stiffness_n_m? / mass_kg).sqrt();
    Some(Demand {
        edge_m_s2: speed_m_s * omega_rad_s,
        velocity_change_m_s: 2.0 * speed_m_s,
        duration_s: std::f64::consts::PI / omega_rad_s,
    })
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
    Drawn { subject, draw }: Drawn<'_>,
    found: PadSummary,
    floor_m_s2: f64,
) -> PadMotion {
    let edge_m_s2 = draw.compliant * found.edge_acceleration_m_s2;
    let demand = Demand {
        edge_m_s2,
        velocity_change_m_s: found.velocity_change_m_s,
        duration_s: found.pulse_duration_s.unwrap_or(0.0),
    };
    let terms = |capacity: &Capacity| match found.has_fallen() {
        true => Some(Terms::OVERTURNED),
        false => {
            let is_at_rest = !found.has_landed;
            terms(capacity, Some(demand), is_at_rest, found.lift_m, floor_m_s2)
        }
    };
    PadMotion {
        found,
        edge_m_s2,
        space: None,
        fallen: None,
        terms: subject.capacity.as_ref().and_then(terms),
    }
}

/// Whether it falls about any axis, onto the floor or against a wall.
pub(super) fn overturned(axes: &[AxisMotion]) -> bool {
    axes.iter().any(AxisMotion::has_fallen)
}

/// Whether there is uplift about any axis.
pub(super) fn lifts(axes: &[AxisMotion]) -> bool {
    axes.iter().any(AxisMotion::lifts)
}

/// The governing axis: the one that overturns, else the one with the largest demand/capacity, else
/// shock, else rise.
pub(super) fn governing(axes: &[AxisMotion]) -> Option<(usize, &AxisMotion)> {
    let rank = |one: &AxisMotion| {
        let ratio = one.terms.map_or(0.0, |terms| terms.ratio());
        (one.has_fallen(), ratio, one.larger_g(), one.cg_rise_m())
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
