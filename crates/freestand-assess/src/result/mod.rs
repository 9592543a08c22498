//! The result for one object: everything that its row, its page and the workbook show.

use crate::capacity::Capacity;
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

pub use freestand_inventory::too_mild::TooMild;
pub use freestand_study::result::Ranked;
pub use freestand_study::study::Unstated;

pub use crate::axis::Axis;
pub use crate::reason::Criterion;
use crate::reason::{Note, Reason};
pub use crate::restraint::force::{RestraintForce, design_force, reported_force};

/// The verdict: what to do with an object.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, IntoStaticStr,
)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum Decision {
    /// Fix it to the building.
    Restrain,
    /// Put it on a softer pad.
    Soften,
    /// It stands, but it rolls or slides farther than it has room: lock or tether it, or give it room.
    Lock,
    /// The data that a verdict needs are incomplete.
    NoVerdict,
    /// Leave it as it is.
    Leave,
}

impl Decision {
    /// All decisions, the most urgent first.
    pub const ALL: [Self; 5] = [
        Self::Restrain,
        Self::Soften,
        Self::Lock,
        Self::NoVerdict,
        Self::Leave,
    ];

    /// How many there are.
    pub const COUNT: usize = Self::ALL.len();

    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Whether an object falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum FallsAnswer {
    /// The probability is below the accepted one.
    Stays,
    /// It is above the accepted one.
    Falls,
    /// It is too close to the accepted one.
    Close,
    /// The run was stopped before its worlds sufficed.
    Open,
}

/// Whether a shock exceeds the tolerance of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum ShockAnswer {
    /// The probability is below the accepted one.
    Stands,
    /// It is above the accepted one.
    Exceeded,
    /// It is too close to the accepted one.
    Close,
    /// The run was stopped before its worlds sufficed.
    Open,
    /// Data are missing.
    Unknown,
}

/// The answers to both questions, and how sure they are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Answers {
    /// Whether it falls.
    pub falls: FallsAnswer,
    /// Whether a shock exceeds its tolerance.
    pub shock: ShockAnswer,
    /// Whether the verdict rests on whether it falls or is damaged, and not on falling alone.
    pub asks_shock: bool,
    /// Whether both models are on the same side of the accepted probability; `None`: one model.
    pub models_agree: Option<bool>,
    /// Worlds.
    pub worlds: u32,
    /// Worlds after which no more are added.
    pub worlds_cap: u32,
    /// Worlds on the compliant base, where they are fewer.
    pub worlds_compliant: Option<u32>,
    /// Confidence of the intervals.
    pub confidence: f64,
    /// By the rigid base and Eq. (5); `None`: not asked.
    pub rigid: Option<ModelAnswers>,
    /// By the compliant base; `None`: not asked.
    pub compliant: Option<ModelAnswers>,
    /// The restitution that was drawn, at 16 and 84 %.
    pub restitution_p16_p84: [f64; 2],
    /// The motions that the worlds use in turn, where they are too few for `leave`.
    pub few_motions: Option<FewMotions>,
    /// The fewest worlds that could carry `leave`, where that is more than [`Self::worlds_cap`].
    pub worlds_needed: Option<u32>,
    /// Why it may fall where the calculation lets it stand, so that it is never left as it is.
    pub too_mild: Option<TooMild>,
}

/// Motions that are too few for `leave`, however many worlds use them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct FewMotions {
    /// How many there are.
    pub motions: u32,
    /// The fewest that could carry `leave`; `None`: no number within the largest number of worlds.
    pub needed: Option<u32>,
}

impl FewMotions {
    /// `None` where `motions` are enough.
    pub fn of(motions: u32, needed: Option<u32>) -> Option<Self> {
        needed
            .is_none_or(|needed| motions < needed)
            .then_some(Self { motions, needed })
    }
}

impl Answers {
    /// Whether the compliant base decides: its interval has the larger upper end, for the tolerance
    /// where that is known, else for falling.
    pub fn decides_on_pads(&self) -> bool {
        let Some(pads) = &self.compliant else {
            return false;
        };
        let Some(rigid) = &self.rigid else {
            return true;
        };
        match (rigid.exceed, pads.exceed) {
            (Some(rigid), Some(pads)) => pads.high > rigid.high,
            _ => pads.overturn.high > rigid.overturn.high,
        }
    }

    /// Whether an answer is too close to call.
    pub fn is_close(&self) -> bool {
        self.close_on() != ""
    }

    /// The answer that is too close to call: `falls`, `shock`, `both`, or nothing.
    pub fn close_on(&self) -> &'static str {
        let shock = self.asks_shock && self.shock == ShockAnswer::Close;
        match (self.falls == FallsAnswer::Close, shock) {
            (true, true) => "both",
            (true, false) => "falls",
            // A fall settles the verdict.
            (false, true) if self.falls == FallsAnswer::Stays => "shock",
            _ => "",
        }
    }
}

/// The probabilities by one model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ModelAnswers {
    /// P(it falls).
    pub overturn: Probability,
    /// P(a shock exceeds its tolerance, or it falls); `None`: not known.
    pub exceed: Option<Probability>,
}

/// The model of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum ObjectModel {
    /// It stands freely on a rigid base.
    Rock,
    /// It stands on a rigid base beside a wall or neighbours.
    RockWall,
    /// It stands freely, on a rigid base and on its pads.
    Compliant,
    /// It rolls on free casters.
    Roll,
    /// It slides on its base.
    Slide,
    /// It moves in three dimensions on its pads.
    #[strum(serialize = "compliant-3d")]
    Spatial,
    /// It moves in a plane on its pads, with another body on it.
    Stack,
    /// It moves in three dimensions on the points of its hull.
    #[strum(serialize = "hull-3d")]
    Hull,
}

impl ObjectModel {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// How an object moves in three dimensions. Where it falls, each ranks above every number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct InSpace {
    /// Largest angle of its axis to the vertical, median world \[rad\].
    pub tilt_rad_median: Ranked,
    /// The same that 84 % of the worlds do not exceed \[rad\].
    pub tilt_rad_p84: Ranked,
    /// Largest horizontal displacement of the centre of its base, median world \[m\].
    pub walk_m_median: Ranked,
    /// The same that 84 % of the worlds do not exceed \[m\].
    pub walk_m_p84: Ranked,
}

/// An object with another body on it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Stacked {
    /// Worlds with a complete history.
    pub worlds: u32,
    /// Of these, those in which the object itself falls first.
    pub lower_falls: u32,
    /// Those in which what stands on it falls first.
    pub upper_falls: u32,
    /// Steady floor acceleration at which what stands on it rocks alone, on rigid edges \[g\].
    pub threshold_upper_g: f64,
    /// That at which both rock as one body \[g\].
    pub threshold_together_g: f64,
}

/// What a wall or neighbours do to an object.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AtWall {
    /// Share of the worlds at whose end it leans on the wall, past its balance point. They count as
    /// falls.
    pub lean_share: f64,
    /// Share of the worlds in which it strikes the wall.
    pub strike_share: f64,
    /// Largest speed at the wall, median world; 0 where it does not strike it \[m/s\].
    pub speed_m_s_median: f64,
    /// Largest shock at the wall, median world; `None`: its mass or the stiffness of the wall is not
    /// known \[g\].
    pub acceleration_g_median: Option<f64>,
}

/// How far an object rolls or slides, and what a stop does to it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rolled {
    /// Largest distance from where it stood as if nothing were in the way, median world \[m\].
    pub travel_m_median: f64,
    /// Travel that 84 % of the worlds do not exceed \[m\].
    pub travel_m_p84: f64,
    /// Whether one horizontal component of its floor is all that is known: it travels at least so far.
    pub is_at_least: bool,
    /// The way to its stop; `None`: nothing stops it \[m\].
    pub clearance_m: Option<f64>,
    /// The least room on every side for which the upper end of P(it needs more) is below the accepted one, else the most \[m\].
    pub clearance_needed_m: f64,
    /// Room on every side that 50, 84 and 98 % of the worlds do not exceed, turned as it is in each \[m\].
    pub room_m: [f64; 3],
    /// Share of worlds in which it reaches its stop.
    pub stop_share: f64,
    /// Speed at the stop that 84 % of the worlds do not exceed; `None`: it does not reach it \[m/s\].
    pub stop_speed_m_s_p84: Option<f64>,
    /// The speed at which the stop overturns it, about the axis where it is smaller \[m/s\].
    pub trip_speed_m_s: f64,
}

/// An object that rolls or slides, locked or held so that it rocks instead, in the same worlds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Braked {
    /// P(it falls) by the model that decides.
    pub overturn: Probability,
    /// Worlds.
    pub worlds: u32,
    /// Whether it stands: the upper end is below the accepted probability, and no shock of its
    /// landings, as far as that is known, is too hard for it.
    pub stands: bool,
}

/// P(it falls) if a wall stood behind an object for which the list gives none, on a rigid base in the
/// same worlds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BeforeWall {
    /// Where it touches the wall.
    pub touching: Probability,
    /// With a gap of 50 mm.
    pub at_50_mm: Probability,
}

impl Rolled {
    /// How far it goes in 84 % of worlds, no farther than its stop \[m\]; and whether it may go farther,
    /// because one component of the floor is all that is known.
    pub fn reach_m(&self) -> (f64, bool) {
        let to_stop_m = self
            .clearance_m
            .filter(|_| self.stop_share > 0.0)
            .unwrap_or(f64::INFINITY);
        let reach_m = self.travel_m_p84.min(to_stop_m);
        (reach_m, self.is_at_least && reach_m < to_stop_m)
    }

    /// Trip speed over the speed at the stop; above 1 the stop does not overturn it.
    pub fn trip_margin(&self) -> Option<f64> {
        Some(self.trip_speed_m_s / self.stop_speed_m_s_p84?)
    }
}

/// An object on its pads.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OnPads {
    /// Frequency of rocking with both edges on their pads \[Hz\].
    pub rocking_frequency_hz: Option<f64>,
    /// Steady floor acceleration at which an edge lets go of its pad \[g\].
    pub pad_uplift_threshold_g: Option<f64>,
    /// U that 84 % of the worlds do not exceed; an edge lets go above 1.
    pub pad_uplift_ratio_p84: Option<f64>,
    /// Share of the worlds in which an edge lets go.
    pub let_go_share: f64,
    /// e of the rigid model, median.
    pub rebound_restitution: f64,
    /// Shock on the compliant base, median world \[g\].
    pub edge_acceleration_g_median: Ranked,
    /// Demand/capacity on the compliant base, median world.
    pub demand_capacity_median: Ranked,
    /// Uplift on the compliant base, median world \[m\].
    pub lift_m_median: Ranked,
    /// Compression that 95 % of the worlds do not exceed \[m\].
    pub compression_m_p95: f64,
    /// Worlds in which a history on pads failed.
    pub failed: usize,
}

/// What the answer depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shares {
    /// Of each group: the share of worlds in which the answer would be another if only this were
    /// different, over that for two independent worlds; `None`: too few events.
    pub by_group: Vec<(Cause, Option<f64>)>,
    /// What to measure first.
    pub measure_first: Option<MeasureFirst>,
}

/// What to measure first: the accepted probability lies between those at its two ends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeasureFirst {
    /// What it is.
    pub cause: Cause,
    /// The probability where it is at its 10 % point.
    pub low_ratio: f64,
    /// And at its 90 % point.
    pub high_ratio: f64,
}

/// What an answer may depend on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum Cause {
    /// The ground motion.
    Motion,
    /// Period and damping of the building.
    Building,
    /// Restitution.
    Restitution,
    /// Stiffness and damping of the pads.
    Pad,
    /// Size and mass.
    Body,
    /// The error of the models.
    Model,
}

impl Cause {
    /// All causes, in the order of the outputs.
    pub const ALL: [Self; 6] = [
        Self::Motion,
        Self::Building,
        Self::Restitution,
        Self::Pad,
        Self::Body,
        Self::Model,
    ];

    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Probabilities per year.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PerYear {
    /// That it falls.
    pub overturn: f64,
    /// That a shock exceeds its tolerance, or that it falls.
    pub exceed: Option<f64>,
    /// Whether weaker earthquakes than those calculated would add to them.
    pub is_at_least: bool,
}

/// What sets the accepted probability of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AcceptedFor {
    /// The inventory gives a probability for this object.
    ThisObject,
    /// The rating of life safety.
    LifeSafety,
    /// The rating of the loss of property.
    Property,
    /// The rating of the loss of function.
    Function,
    /// No consequence is rated.
    Default,
    /// No consequence is rated, and it falls with little energy.
    SmallItem,
}

impl AcceptedFor {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::ThisObject => "this object",
            Self::LifeSafety => "life safety",
            Self::Property => "property",
            Self::Function => "function",
            Self::Default => "default",
            Self::SmallItem => "small item",
        }
    }
}

/// A probability with its interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Probability {
    /// The estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// The assessment of one object under the motions of its floor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Assessment {
    /// The object.
    pub id: String,
    /// What to do.
    pub decision: Decision,
    /// Why, in the order in which it is told.
    pub why: Vec<Reason>,
    /// The tier that decided: 0 it rocks in no world, 2 histories on a rigid base, 3 also on the
    /// compliant base.
    pub tier: u8,
    /// The answers; `None`: geometry, level or motions are missing.
    pub answers: Option<Answers>,
    /// Its model; `None`: geometry, level or motions are missing.
    pub model: Option<ObjectModel>,
    /// At its wall; `None`: nothing is within reach, or it does not count.
    pub at_wall: Option<AtWall>,
    /// On its casters, or sliding on its base; `None`: it does neither, or rocks as well.
    pub rolled: Option<Rolled>,
    /// Locked, where it rolls or slides farther than it has room; `None`: that was not asked.
    pub braked: Option<Braked>,
    /// With a wall behind it; `None`: the list gives one, or it is not restrained.
    #[serde(default)]
    pub before_wall: Option<BeforeWall>,
    /// In three dimensions; `None`: it moves in a plane.
    pub in_space: Option<InSpace>,
    /// With what stands on it; `None`: nothing does.
    pub stacked: Option<Stacked>,
    /// On its pads; `None`: the compliant base was not asked.
    pub on_pads: Option<OnPads>,
    /// What the answer depends on, where that was calculated.
    pub shares: Option<Shares>,
    /// Per year, where that was asked.
    pub per_year: Option<PerYear>,
    /// The probability of overturning or damage that the owner accepts.
    pub accepted_ratio: f64,
    /// What sets that probability.
    pub accepted_for: AcceptedFor,
    /// Its floor; `None`: the level is missing.
    pub floor: Option<FloorFacts>,
    /// Its response with the values of the inventory; `None`: geometry or level is missing, or
    /// every history failed.
    pub response: Option<OnRigidBase>,
    /// The shock of its landings; `None`: mass or cushion is missing too.
    pub shock: Option<Shock>,
    /// Demand/capacity; `None`: the tolerance is missing too.
    pub capacity: Option<CapacityCheck>,
    /// P(it falls) by the model that decides.
    pub p_overturn: Option<Probability>,
    /// P(a criterion is exceeded, or it falls) by the model that decides; `None` where that is not
    /// known.
    pub p_exceed: Option<Probability>,
    /// Sliding.
    pub sliding: Option<Sliding>,
    /// The softer pad, where one was looked for.
    pub softening: Option<Softening>,
    /// Forces for the design of a restraint, for `restrain`.
    pub restraint: Vec<RestraintForce>,
    /// Clearance that it needs on every side while it rocks \[m\]; its height where it overturns.
    pub clearance_m: Option<f64>,
    /// Comparisons with published numbers.
    pub comparisons: Vec<Comparison>,
    /// Eqs. (5)–(8) in the world that decides, step by step.
    pub chain: Option<Chain>,
    /// What else there is to know.
    pub notes: Vec<Note>,
}

impl Assessment {
    /// Whether the run was stopped before its worlds sufficed.
    pub fn was_stopped(&self) -> bool {
        self.why
            .iter()
            .any(|reason| matches!(reason, Reason::Stopped { .. }))
    }

    /// Whether a history failed, by either model.
    pub fn has_failed_histories(&self) -> bool {
        let failed_on_pads = self.on_pads.as_ref().is_some_and(|pads| pads.failed > 0);
        match &self.response {
            Some(response) => response.failed > 0 || failed_on_pads,
            // Its rigid base was asked, but every history failed.
            None => {
                failed_on_pads
                    || self
                        .answers
                        .as_ref()
                        .is_some_and(|answers| answers.rigid.is_some())
            }
        }
    }

    /// Whether the compliant base decides.
    pub fn decides_on_pads(&self) -> bool {
        self.answers.as_ref().is_some_and(Answers::decides_on_pads)
    }

    /// The force that its anchors and a bracket are designed for: [`design_force`].
    pub fn design_force(&self) -> Option<&RestraintForce> {
        design_force(&self.restraint)
    }

    /// Whether it is left as it is, and only falling was assessed.
    pub fn is_left_for_falling_alone(&self) -> bool {
        self.decision == Decision::Leave
            && self
                .answers
                .as_ref()
                .is_some_and(|answers| !answers.asks_shock)
    }

    /// Demand/capacity of the median world, by the model that decides.
    pub fn demand_capacity_median(&self) -> Option<Ranked> {
        let capacity = self.capacity.as_ref()?;
        let pads = self.on_pads.as_ref().filter(|_| self.decides_on_pads());
        Some(pads.map_or(capacity.demand_capacity, |pads| pads.demand_capacity_median))
    }

    /// Shock of the median world, by the model that decides \[g\].
    pub fn edge_acceleration_g_median(&self) -> Option<Ranked> {
        let pads = self.on_pads.as_ref().filter(|_| self.decides_on_pads());
        pads.map(|pads| pads.edge_acceleration_g_median).or(self
            .shock
            .as_ref()
            .map(|shock| shock.edge_acceleration_g[1]))
    }
}

/// A comparison with a published number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Comparison {
    /// What its code requires for a rigid part on its floor.
    CodeFloor {
        /// The acceleration \[g\].
        code_g: f64,
        /// The clause.
        clause: String,
    },
    /// By the rule of the FEMA P-58 fragilities of unanchored contents.
    FemaP58 {
        /// Median PFV at which an object of its shape overturns \[m/s\].
        median_m_s: f64,
        /// That it overturns at the median PFV of its floor.
        probability: f64,
    },
    /// The steady acceleration at which an edge lifts.
    Uplift {
        /// That acceleration \[g\].
        threshold_g: f64,
    },
}

/// The floor of an object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FloorFacts {
    /// 0 ground, 1 roof.
    pub level_ratio: f64,
    /// Median peak floor acceleration \[g\].
    pub pfa_g_median: f64,
    /// Largest peak floor acceleration \[g\].
    pub pfa_g_max: f64,
    /// Median peak floor velocity \[m/s\].
    pub pfv_m_s_median: f64,
}

/// The response of an object with the values of the inventory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OnRigidBase {
    /// Motions with a history about every axis.
    pub motions: usize,
    /// Motions for which a history failed.
    pub failed: usize,
    /// The reason of the first failure.
    pub failure: Option<String>,
    /// Share of the motions that cause uplift about either axis.
    pub uplift_share: f64,
    /// Share of the motions that overturn it.
    pub overturn_share: f64,
    /// Uplift \[m\] at 16, 50 and 84 %.
    pub uplift_m: [Ranked; 3],
    /// Peak rotation over the slenderness angle at 16, 50 and 84 %.
    pub rotation_ratio: [Ranked; 3],
    /// Largest number of impacts under one motion.
    pub impacts_max: usize,
    /// The axes, the thickness first.
    pub axes: Vec<AxisResponse>,
}

/// The response about one axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AxisResponse {
    /// The side that lies in the plane of motion.
    pub axis: Axis,
    /// Slenderness angle α \[rad\].
    pub slenderness_angle_rad: f64,
    /// Half diagonal R \[m\].
    pub half_diagonal_m: f64,
    /// Floor acceleration that causes uplift, tan α \[g\].
    pub uplift_threshold_g: f64,
    /// Share of the motions that cause uplift.
    pub uplift_share: f64,
    /// Share of the motions that overturn it.
    pub overturn_share: f64,
    /// Shock from the larger of the two sources of energy, at 16, 50 and 84 % \[g\]; `None` without
    /// mass or cushion.
    pub edge_acceleration_g: Option<[Ranked; 3]>,
    /// Ceiling: the largest shock from an uplift under any motion \[g\].
    pub ceiling_g: Option<f64>,
}

/// The shock of the landings, for each motion about the worse axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shock {
    /// The shock from the larger of the two sources of energy, at 16, 50 and 84 % \[g\].
    pub edge_acceleration_g: [Ranked; 3],
    /// The shock from the rise of the centre of gravity (the source of energy in the paper), at 16,
    /// 50 and 84 % \[g\].
    pub edge_acceleration_uplift_g: [Ranked; 3],
    /// Largest shock under the motions that do not overturn it \[g\].
    pub edge_acceleration_max_g: Option<f64>,
    /// Duration of the pulse about the governing axis, π√(m_eff/k) on a spring \[s\].
    pub pulse_duration_s: f64,
    /// Velocity change at the median shock \[m/s\].
    pub velocity_change_m_s: Ranked,
    /// Ceiling: the largest shock from an uplift about either axis, under any motion \[g\].
    pub ceiling_g: f64,
    /// Stiffness under one edge \[N/m\]; `None` for a contact law that has none.
    pub stiffness_n_m: Option<f64>,
    /// Impacts above the peak of its tolerance under the most severe motion that does not overturn
    /// it; `None` without a peak.
    pub impacts_above_tolerance: Option<usize>,
}

/// Demand divided by capacity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CapacityCheck {
    /// Demand/capacity of the median motion; overturned ranks above every number.
    pub demand_capacity: Ranked,
    /// Demand/capacity that 84 % of the motions do not exceed.
    pub demand_capacity_p84: Ranked,
    /// The criterion that governs in the world that decides.
    pub governing: Criterion,
    /// The tolerance.
    pub tolerance: Capacity,
    /// Its source, ready to print.
    pub source: String,
    /// Median floor acceleration over the peak of the tolerance.
    pub floor_ratio: Option<f64>,
}

/// Sliding of an object: its friction compared with the friction that its motions require.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sliding {
    /// Whether it slides.
    pub verdict: SlidingVerdict,
    /// The coefficient of friction that was stated or assumed, lowest and highest.
    pub friction_ratio: (f64, f64),
    /// Whether the inventory states the friction.
    pub is_stated: bool,
}

/// Whether an object slides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum SlidingVerdict {
    /// It does not slide, even with the lowest friction.
    No,
    /// It slides with the lowest friction, but not with the highest.
    Possible,
    /// It slides even with the highest friction.
    Yes,
}

impl SlidingVerdict {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A softer pad.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Softening {
    /// Largest stiffness under one edge that keeps the probability at or below the accepted one
    /// \[N/m\].
    pub max_stiffness_n_m: Option<f64>,
    /// Compression of that pad that 95 % of the worlds do not exceed \[m\].
    pub stroke_m: Option<f64>,
    /// Thickness of the pad, stated or assumed \[m\].
    pub pad_thickness_m: f64,
    /// Median shock on that pad on the compliant base \[g\]; none where most worlds overturn it.
    pub edge_acceleration_g: Option<f64>,
    /// Upper end of P(exceeded) on that pad, by the model that decides.
    pub p_exceed_high: Option<f64>,
    /// Upper end of P(it falls) on that pad, by the model that decides.
    pub p_overturn_high: Option<f64>,
    /// Whether that thickness is assumed.
    pub is_assumed: bool,
    /// What was checked, and what failed.
    pub outcome: PadOutcome,
}

/// What a softer pad comes to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PadOutcome {
    /// It is enough.
    Enough,
    /// It is compressed by more than this share of its thickness.
    Pressed(f64),
    /// The object falls from it.
    Falls,
    /// Its tolerance is still exceeded.
    Exceeded {
        /// Whether that is too close to the accepted probability to call.
        is_close: bool,
    },
}

impl Softening {
    /// Whether the pad passed every check.
    pub fn admissible(&self) -> bool {
        self.outcome == PadOutcome::Enough
    }
}

/// Eqs. (5)–(8) at one motion about one axis, with the numbers that a reader needs to repeat them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Chain {
    /// The motion.
    pub motion: String,
    /// The side that lies in the plane of motion.
    pub axis: Axis,
    /// Height \[m\].
    pub height_m: f64,
    /// Side in the plane of motion \[m\].
    pub thickness_m: f64,
    /// Whether Eqs. (5)–(7) apply as printed: a uniform block that rests on its full width, on a
    /// spring.
    pub is_uniform: bool,
    /// Distance between the edges \[m\].
    pub base_m: f64,
    /// Half diagonal R, from an edge to the centre of gravity \[m\].
    pub half_diagonal_m: f64,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Stiffness under one edge \[N/m\]; `None` for a contact law that has none.
    pub stiffness_n_m: Option<f64>,
    /// Rise of the centre of gravity \[m\].
    pub cg_rise_m: f64,
    /// Landing ratio R_D, Eq. (6).
    pub landing_ratio: f64,
    /// Whether the landing is halted (R_D = 0, Eq. (8)).
    pub is_halted: bool,
    /// Drop acceleration a, Eq. (7) \[g\].
    pub drop_acceleration_g: f64,
    /// Effective mass m_eff \[kg\].
    pub effective_mass_kg: f64,
    /// Shock a_edge from the rise of the centre of gravity, Eq. (5) or (8) \[g\].
    pub edge_acceleration_g: f64,
    /// Shock a_edge from the velocity before the impact \[g\].
    pub edge_acceleration_impact_velocity_g: f64,
    /// Velocity change Δv \[m/s\].
    pub velocity_change_m_s: f64,
    /// Duration of the pulse T \[s\].
    pub pulse_duration_s: f64,
    /// Uplift \[m\].
    pub uplift_m: f64,
    /// Demand/capacity under this motion.
    pub demand_capacity_ratio: Option<f64>,
}
