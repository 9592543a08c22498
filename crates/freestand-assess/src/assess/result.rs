//! What is found out about one object: everything that a row, a page and a workbook say of it.

use serde::{Deserialize, Serialize};

/// What to do with an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Decision {
    /// Fix it to the building.
    Restrain,
    /// Put it on a softer pad.
    Soften,
    /// Something is missing that a verdict would need.
    NoVerdict,
    /// Let it stand as it is.
    Leave,
}

impl Decision {
    /// All, the most urgent first.
    pub const ALL: [Self; 4] = [Self::Restrain, Self::Soften, Self::NoVerdict, Self::Leave];

    /// The name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Restrain => "restrain",
            Self::Soften => "soften",
            Self::NoVerdict => "no-verdict",
            Self::Leave => "leave",
        }
    }
}

pub use freestand_study::result::Ranked;

/// A probability and what is known of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Probability {
    /// The estimate.
    pub value: f64,
    /// Lower end of the 95 % interval.
    pub low: f64,
    /// Upper end of the 95 % interval.
    pub high: f64,
}

/// Everything about one object under the motions of its floor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Assessment {
    /// The object.
    pub id: String,
    /// What to do.
    pub decision: Decision,
    /// Why, in one or two sentences.
    pub why: String,
    /// The tier that decided: 0 thresholds, 1 spectra, 2 its own histories, 3 the compliant base.
    pub tier: u8,
    /// Probability that its owner accepts, and for which consequence: `life safety`, `property`, `function`, or `default`.
    pub accepted_ratio: f64,
    /// The consequence that the accepted probability is for.
    pub accepted_for: String,
    /// Its floor; `None`: the level is missing.
    pub floor: Option<FloorFacts>,
    /// What it does as it stands, motion by motion put together; `None`: geometry or level is missing, or no motion could be followed.
    pub response: Option<Response>,
    /// The shock of the landing; `None`: mass or cushion is missing too.
    pub shock: Option<Shock>,
    /// Demand over capacity; `None`: the tolerance is missing too.
    pub capacity: Option<CapacityCheck>,
    /// P(overturned), over all draws.
    pub p_overturn: Option<Probability>,
    /// P(a criterion is exceeded, or overturned), over all draws; `None` without a tolerance.
    pub p_exceed: Option<Probability>,
    /// Draws of the uncertain values for each motion; 0: none were needed.
    pub draws: u32,
    /// Sliding.
    pub sliding: Option<Sliding>,
    /// The softer pad, where one was looked for.
    pub softening: Option<Softening>,
    /// The second opinion of the compliant base, where the object was near the line.
    pub compliant: Option<CompliantCheck>,
    /// What would change it, the largest first.
    pub tornado: Vec<Swing>,
    /// Forces to fix it with, for `restrain`.
    pub restraint: Vec<RestraintForce>,
    /// Clearance that it needs on every side where it rocks \[m\]; its height where it falls.
    pub clearance_m: Option<f64>,
    /// Other people's numbers beside ours: code accelerations, fragilities of FEMA P-58 and Hazus, empirical overturning; each one
    /// sentence with its source.
    pub context: Vec<String>,
    /// Eqs. (5)–(7) at the motion that decides, for a reader to follow.
    pub chain: Option<Chain>,
    /// Assumptions, doubts and how the row was read.
    pub notes: Vec<String>,
}

/// The floor of an object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FloorFacts {
    /// 0 ground, 1 roof.
    pub level_ratio: f64,
    /// Median peak floor acceleration \[g\].
    pub pfa_g_median: f64,
    /// The largest \[g\].
    pub pfa_g_max: f64,
    /// Median peak floor velocity \[m/s\].
    pub pfv_m_s_median: f64,
}

/// What an object does, with the values of the inventory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Response {
    /// Motions that were followed about every axis.
    pub motions: usize,
    /// Motions that could not be, with the reason of the first.
    pub failed: usize,
    /// Why.
    pub failure: Option<String>,
    /// Share of the motions under which it lifts off, about either axis.
    pub uplift_share: f64,
    /// Share of the motions under which it overturns.
    pub overturn_share: f64,
    /// Lift of the free edge \[m\] at 16, 50 and 84 %.
    pub uplift_m: [Ranked; 3],
    /// Peak rotation over the overturning angle at 16, 50 and 84 %.
    pub rotation_ratio: [Ranked; 3],
    /// Largest number of impacts of a motion.
    pub impacts_max: usize,
    /// The axes, the thickness first.
    pub axes: Vec<AxisResponse>,
}

/// The object about one axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AxisResponse {
    /// `thickness` or `width`: the side that lies in the plane of motion.
    pub axis: String,
    /// α \[rad\].
    pub slenderness_angle_rad: f64,
    /// R \[m\].
    pub half_diagonal_m: f64,
    /// Floor acceleration that lifts it, tan α \[g\].
    pub uplift_threshold_g: f64,
    /// Share of the motions under which it lifts off.
    pub uplift_share: f64,
    /// Share of the motions under which it overturns.
    pub overturn_share: f64,
    /// Shock, the larger source, at 16, 50 and 84 % \[g\]; `None` without mass or cushion.
    pub edge_acceleration_g: Option<[Ranked; 3]>,
    /// No record gives more `uplift` shock \[g\].
    pub ceiling_g: Option<f64>,
}

/// The shock of the landing, per motion the worse axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shock {
    /// The larger source, at 16, 50 and 84 % \[g\].
    pub edge_acceleration_g: [Ranked; 3],
    /// From the rise of the centre of gravity (the paper's source), at 16, 50 and 84 % \[g\].
    pub edge_acceleration_uplift_g: [Ranked; 3],
    /// Largest of any motion that it survives \[g\].
    pub edge_acceleration_max_g: Option<f64>,
    /// Duration of the pulse about the axis that governs, π√(m_eff/k) on a spring \[s\].
    pub pulse_duration_s: f64,
    /// Velocity change at the median shock \[m/s\].
    pub velocity_change_m_s: Ranked,
    /// No record gives more `uplift` shock about either axis \[g\].
    pub ceiling_g: f64,
    /// Stiffness under one edge \[N/m\]; `None` for a law that has none.
    pub stiffness_n_m: Option<f64>,
    /// Impacts above the peak that it stands, under the hardest motion that it survives; `None` without such a peak.
    pub impacts_above_tolerance: Option<usize>,
}

/// Demand over capacity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CapacityCheck {
    /// Of the median motion; overturned is beyond every number.
    pub demand_capacity: Ranked,
    /// At 84 % of the motions.
    pub demand_capacity_p84: Ranked,
    /// The criterion that governs at the motion that decides: `peak`, `damage-boundary`, `spectrum`, `edge-lift`, `floor-acceleration`, `overturning`.
    pub governing: String,
    /// The tolerance in words: `5 g, 11 ms half-sine`.
    pub tolerance: String,
    /// Its source, ready to print.
    pub source: String,
    /// Whether the source may decide; a recalled one may not.
    pub decides: bool,
    /// Median floor acceleration over the tolerance's peak.
    pub floor_ratio: Option<f64>,
}

/// Whether it slides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sliding {
    /// `no`, `possible` or `yes`: under no motion, for some, for all of the stated friction.
    pub verdict: String,
    /// The friction that was assumed or stated, lowest and highest.
    pub friction_ratio: (f64, f64),
    /// Whether it was stated in the inventory.
    pub is_stated: bool,
}

/// A softer pad.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Softening {
    /// Largest stiffness under one edge that keeps the probability within what is accepted \[N/m\].
    pub max_stiffness_n_m: Option<f64>,
    /// Largest compression of that pad under the motions that were run again \[m\].
    pub stroke_m: Option<f64>,
    /// Thickness of the pad, stated or assumed \[m\].
    pub pad_thickness_m: f64,
    /// Shock on that pad from the motions that were run again \[g\].
    pub edge_acceleration_g: Option<f64>,
    /// Whether everything that was checked holds.
    pub admissible: bool,
    /// What was checked, and what failed.
    pub note: String,
}

/// The compliant base beside Eq. (5), under the motions around the one that decides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CompliantCheck {
    /// Motions that were run.
    pub motions: usize,
    /// Of how many of them it overturns.
    pub overturned: usize,
    /// Median ratio of its shock over that of Eq. (5); `None` where none survives.
    pub shock_ratio: Option<f64>,
    /// Whether it leads to the same decision.
    pub agrees: bool,
}

/// A bar of the tornado: one value at either end of its range, the others as they are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Swing {
    /// `stiffness`, `restitution`, `mass`, `motion`, `model`, `geometry`.
    pub parameter: String,
    /// The low end in words: `0.8 × k`.
    pub low: String,
    /// The high end in words.
    pub high: String,
    /// Demand over capacity at the low end, of the median motion; without a tolerance the shock in g; overturned is beyond every number.
    pub at_low: Ranked,
    /// At the high end.
    pub at_high: Ranked,
    /// As it is.
    pub as_is: Ranked,
    /// Whether at either end more motions than are accepted are beyond what is stood, or no more are.
    pub flips: bool,
}

/// A force to fix an object with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RestraintForce {
    /// The clause.
    pub source: String,
    /// Horizontal force at the centre of gravity \[N\].
    pub force_n: f64,
    /// Over the weight.
    pub force_ratio: f64,
    /// Tension of all the anchors along one edge about the axis that needs more \[N\]; 0: the weight holds it down.
    pub anchor_tension_n: f64,
    /// The formula with its numbers, and what was assumed.
    pub note: String,
}

/// Eqs. (5)–(7) at one motion about one axis, as a reader would compute them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Chain {
    /// The motion.
    pub motion: String,
    /// `thickness` or `width`.
    pub axis: String,
    /// Height \[m\].
    pub height_m: f64,
    /// Side in the plane of motion \[m\].
    pub thickness_m: f64,
    /// Whether Eqs. (5)–(7) hold as printed: a uniform block on its full width, and a spring.
    pub is_uniform: bool,
    /// Distance between the pivot edges \[m\].
    pub base_m: f64,
    /// R, from a pivot edge to the centre of gravity \[m\].
    pub half_diagonal_m: f64,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Stiffness under the edge \[N/m\]; `None` for a law that has none.
    pub stiffness_n_m: Option<f64>,
    /// Rise of the centre of gravity \[m\].
    pub cg_rise_m: f64,
    /// R_D, Eq. (6).
    pub landing_ratio: f64,
    /// Whether the landing is halted (R_D = 0, Eq. (8)).
    pub is_halted: bool,
    /// a, Eq. (7) \[g\].
    pub drop_acceleration_g: f64,
    /// m_eff \[kg\].
    pub effective_mass_kg: f64,
    /// a_edge, Eq. (5) \[g\].
    pub edge_acceleration_g: f64,
    /// From the velocity before the impact \[g\].
    pub edge_acceleration_impact_velocity_g: f64,
    /// Δv \[m/s\].
    pub velocity_change_m_s: f64,
    /// T \[s\].
    pub pulse_duration_s: f64,
    /// Lift of the free edge \[m\].
    pub uplift_m: f64,
    /// Demand over capacity of this motion.
    pub demand_capacity_ratio: Option<f64>,
}
