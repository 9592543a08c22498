//! The rigid block rocking on a rigid base (Housner 1963), followed event by event.
//!
//! θ̈ = −p²\[(1+ü_v/g) sin(sα−θ) + (ü_h/g) cos(sα−θ)\], s = sgn θ; at θ = 0 an impact, ω⁺ = r ω⁻. θ
//! is positive when the block rotates to the right, about its right edge; a positive ü_h drives θ
//! negative. The base acceleration is linear between the samples of the motion.
//!
//! Event rules:
//! * **Uplift** from rest when |ü_h| > (g+ü_v) tan α, at the instant at which the straight line
//!   between two samples passes the threshold.
//! * **Impact** when θ returns to 0; all are reported. The velocity keeps its sign and the
//!   pivot changes.
//! * **Rest** when the velocity after an impact is at most [`REST_OMEGA_RAD_S`] and |ü_h| ≤ (g+ü_v)
//!   tan α: exactly θ = 0 until the next uplift. Where the threshold is passed the block starts
//!   again from zero velocity.
//! * **Overturned** when |θ| reaches π/2; passing α is reported but is not yet overturning.
//! * **Wall impact** when |θ| reaches the angle θ_c at which the block touches a wall
//!   ([`crate::wall`]): ω⁺ = −e_w ω⁻ about the same edge.
//! * **Leaning** when the velocity after a wall impact is at most [`REST_OMEGA_RAD_S`] and
//!   (1+ü_v/g) sin(α−θ_c) + s(ü_h/g) cos(α−θ_c) ≤ 0: exactly |θ| = θ_c until that sum is positive.
//! * **Touching walls** (θ_c = 0) stop the block at θ = 0. It uplifts only to the other side. A block
//!   that comes back from there lands, meets the wall and lands again at one instant: ω⁺ = −e_w r² ω⁻,
//!   about the edge that it came on. This is the limit of a small gap.
//! * **Free flight** where g + ü_v ≤ 0: the model does not apply, and the result is an error.
//!
//! Each piece of the motion is a Taylor series of the exact equation, with an order that follows
//! from the accuracy (`equation`), and each event is a root of that polynomial
//! (`crate::polynomial`): no result depends on where the samples of the output fall.

mod equation;
mod history;
mod lanes;
mod solve;

use thiserror::Error;

use crate::block::Block;
use crate::motion::Motion;
use crate::wall::{Contact, WallError, Walls};

pub use equation::Segment;
pub use history::{HistoryPoint, HistoryRecorder};
pub use lanes::{rock_between, rock_many, rock_many_on};
pub use solve::{rock, rock_observed};

/// Speed after an impact at or below which a block comes to rest, unless the base lifts it
/// again \[rad/s\].
pub const REST_OMEGA_RAD_S: f64 = 1e-9;

/// Number of impacts after which a history is abandoned; only a restitution of (nearly) 1 reaches
/// it.
pub const MAX_IMPACTS: usize = 1_000_000;

/// A block that needs more impacts than this to come to rest after the motion counts as rocking for
/// ever; only a restitution of (nearly) 1 does.
const STEADY_IMPACTS: f64 = 1e5;

/// Equation of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RockingModel {
    /// θ̈ = −p²\[(1+ü_v/g) sin(sα−θ) + (ü_h/g) cos(sα−θ)\].
    #[default]
    Rigid,
    /// sin x → x, cos x → 1, tan α → α: for tests against closed forms.
    Linearised,
}

impl RockingModel {
    /// The ratio |ü_h|/(g+ü_v) at which a block at rest uplifts about the edge nearer to its centre
    /// of gravity: tan α, or α when linearised.
    pub fn uplift_threshold_ratio(self, block: &Block) -> f64 {
        let nearer = block.cg_from_left_m().min(block.cg_from_right_m());
        match self {
            Self::Rigid => nearer / block.cg_height_m(),
            Self::Linearised => nearer.atan2(block.cg_height_m()),
        }
    }
}

/// ω⁺/ω⁻ at each impact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Restitution {
    /// Housner's ratio of the block ([`Block::landing_ratio`]); 0 for a squat block, which stops at
    /// every landing.
    #[default]
    Housner,
    /// One value in \[0, 1\] for every impact.
    Value(f64),
    /// Housner's ratio times a factor.
    Factor(f64),
    /// One value in \[0, 1\] for landings on the right edge, and one for those on the left.
    Edges([f64; 2]),
}

/// The accuracy of a history: the relative truncation error of each Taylor step in [`rock`]. In
/// [`rock_many`] the first term left out may be 300 times that, relative to the acceleration.
///
/// # Accuracy
/// Errors of the peak rotation: the worst of 336 histories that were solved to 160 bits, and the
/// median and 99 % of 4096 blocks 0.3–4 m high and 0.1–1 m thick under a record with steps of 5 ms
/// (`benches/README.md`). The last column is the relative cost of that spectrum.
///
/// | level | `rock`, worst | `rock_many`, worst | median | 99 % | cost |
/// |---|---|---|---|---|---|
/// | fast | 2.6e-10 | 3.6e-7 | 3e-10 | 2e-9 | 0.9 |
/// | standard | 3.2e-14 | 4.2e-10 | 7e-13 | 4e-12 | 1 |
/// | tight | 4.4e-15 | 7.7e-14 | 1e-15 | 1e-14 | 1.2 |
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Accuracy {
    /// 1e-9 for each step: for surveys.
    Fast,
    /// 1e-13 for each step.
    #[default]
    Standard,
    /// Close to rounding.
    Tight,
    /// A relative truncation error for each step, between 2⁻⁵³ and 1e-3.
    Tolerance(f64),
}

impl Accuracy {
    /// The relative truncation error of a step.
    pub fn tolerance(self) -> f64 {
        match self {
            Self::Fast => 1e-9,
            Self::Standard => 1e-13,
            Self::Tight => 0.5 * f64::EPSILON,
            Self::Tolerance(tolerance) => tolerance,
        }
    }

    /// Whether the tolerance is within the range that a step can meet.
    pub(crate) fn is_valid(self) -> bool {
        (0.5 * f64::EPSILON..=1e-3).contains(&self.tolerance())
    }

    /// `fast`, `standard`, `tight`, or `None` for a number.
    pub fn name(self) -> Option<&'static str> {
        match self {
            Self::Fast => Some("fast"),
            Self::Standard => Some("standard"),
            Self::Tight => Some("tight"),
            Self::Tolerance(_) => None,
        }
    }
}

/// Longest time after the motion in which a block may come to rest, where nothing else is said
/// \[s\]; only a restitution of nearly 1, as slender blocks have, and pads without damping need more.
pub const LONGEST_TAIL_S: f64 = 120.0;

/// When a history ends, unless the block overturns first.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Until {
    /// At the last sample.
    #[default]
    EndOfMotion,
    /// At this time \[s\]; after the last sample the base comes to rest within one time step, as if
    /// zeros followed.
    Time(f64),
    /// When the block has come to rest after the last sample, or at the last whole time step at most
    /// `at_most_s` after that sample, with the reason [`StopReason::EndOfMotion`]. It has [rocked](Outcome::Rocked)
    /// if its energy then is too small to pass a balance point. A block that would need more than 1e5 impacts to
    /// come to rest stops once a flight about each edge lies after the motion and it cannot fall any more.
    Settled {
        /// Longest time after the last sample \[s\].
        at_most_s: f64,
    },
}

/// The time steps after the last sample that [`Until::Settled`] lasts at most.
fn settling_steps(at_most_s: f64, dt_s: f64) -> f64 {
    (at_most_s / dt_s).floor()
}

/// How the base moves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Base<'a> {
    /// Horizontal acceleration; `None` if there is none.
    pub horizontal: Option<&'a Motion>,
    /// Vertical acceleration, positive upward, with the same time step and length; `None` if there
    /// is none.
    pub vertical: Option<&'a Motion>,
}

impl Base<'_> {
    /// Whether both motions, if there are two, have the same time step and length.
    ///
    /// # Errors
    /// They have not.
    pub fn check(&self) -> Result<(), RockingError> {
        let Some((h, v)) = self.horizontal.zip(self.vertical) else {
            return Ok(());
        };
        let (samples, vertical_samples) = (h.accel_m_s2().len(), v.accel_m_s2().len());
        let (dt_s, vertical_dt_s) = (h.dt_s(), v.dt_s());
        if (samples, dt_s) == (vertical_samples, vertical_dt_s) {
            return Ok(());
        }
        Err(RockingError::VerticalMismatch {
            samples,
            dt_s,
            vertical_samples,
            vertical_dt_s,
        })
    }
}

/// Everything else that a history depends on: model, restitution, start and end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RockingOptions {
    /// Equation of motion.
    pub model: RockingModel,
    /// Restitution.
    pub restitution: Restitution,
    /// g \[m/s²\].
    pub gravity_m_s2: f64,
    /// Accuracy.
    pub accuracy: Accuracy,
    /// θ at t = 0 \[rad\].
    pub initial_rotation_rad: f64,
    /// ω at t = 0 \[rad/s\].
    pub initial_omega_rad_s: f64,
    /// When to stop.
    pub until: Until,
    /// Walls beside the block.
    pub walls: Walls,
}

impl Default for RockingOptions {
    fn default() -> Self {
        Self {
            model: RockingModel::default(),
            restitution: Restitution::default(),
            gravity_m_s2: crate::G0_M_S2,
            accuracy: Accuracy::default(),
            initial_rotation_rad: 0.0,
            initial_omega_rad_s: 0.0,
            until: Until::default(),
            walls: Walls::NONE,
        }
    }
}

/// One impact of an edge on the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RockingImpact {
    /// Time \[s\].
    pub time_s: f64,
    /// ω⁻, signed \[rad/s\].
    pub omega_before_rad_s: f64,
    /// ω⁺ = r ω⁻ \[rad/s\].
    pub omega_after_rad_s: f64,
}

/// The outcome in tables of a history that ended because the base fell away
/// ([`RockingError::FreeFlight`]).
pub const FREE_FLIGHT: &str = "free-flight";

/// A side of the block: the edge that it turns about, and the wall beyond it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// θ > 0.
    Right,
    /// θ < 0.
    Left,
}

impl Side {
    /// `right`, `left`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Left => "left",
        }
    }

    /// The place of this side in arrays of both: 0 for the right one.
    pub fn index(self) -> usize {
        match self {
            Self::Right => 0,
            Self::Left => 1,
        }
    }
}

/// One impact of the block on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallImpact {
    /// Time \[s\].
    pub time_s: f64,
    /// The side of the wall.
    pub side: Side,
    /// ω⁻, signed \[rad/s\].
    pub omega_before_rad_s: f64,
    /// ω⁺ = −e_w ω⁻ \[rad/s\].
    pub omega_after_rad_s: f64,
}

/// How a history ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Outcome {
    /// The base never passed the uplift threshold.
    NoUplift,
    /// The object rocked and did not overturn: it came to rest, or cannot fall any more.
    Rocked,
    /// At the end the object is past its balance point and a wall holds it, or it bounces there.
    Leaned,
    /// The history ended while the object was neither at rest nor down: before the base came to rest, at a time
    /// that was given, or with energy enough to fall.
    Unresolved,
    /// |θ| reached π/2.
    Overturned,
}

impl Outcome {
    /// Whether the object has fallen over, onto the floor or against a wall: what counts in
    /// decisions.
    pub fn has_fallen(self) -> bool {
        matches!(self, Self::Leaned | Self::Overturned)
    }

    /// The name in every output: `no-uplift`, `rocked`, `leaned`, `unresolved`, `overturned`.
    pub fn name(self) -> &'static str {
        match self {
            Self::NoUplift => "no-uplift",
            Self::Rocked => "rocked",
            Self::Leaned => "leaned",
            Self::Unresolved => "unresolved",
            Self::Overturned => "overturned",
        }
    }
}

/// Why a history stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum StopReason {
    /// The end of the motion, or the requested time, was reached.
    EndOfMotion,
    /// The motion has ended and the block is at rest, or leans on a wall ([`Until::Settled`]).
    Settled,
    /// |θ| = π/2.
    Overturned,
}

impl StopReason {
    /// `end-of-motion`, `settled`, `overturned`.
    pub fn name(self) -> &'static str {
        match self {
            Self::EndOfMotion => "end-of-motion",
            Self::Settled => "settled",
            Self::Overturned => "overturned",
        }
    }
}

/// Work done to calculate a history.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Effort {
    /// Taylor steps.
    pub steps: usize,
    /// Taylor coefficients over all steps; each is one evaluation of the equation of motion.
    pub evaluations: usize,
}

/// The response of a block to a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Rocking {
    /// How the history ended; a block that starts with a rotation or a velocity has rocked.
    pub outcome: Outcome,
    /// Why the history stopped.
    pub stop: StopReason,
    /// Time at which it stopped \[s\].
    pub end_time_s: f64,
    /// Largest |θ| \[rad\]; π/2 when overturned.
    pub peak_rotation_rad: f64,
    /// Extremes on the right edge and on the left one. Their consequences differ only where the
    /// centre of gravity is off the middle.
    pub sides: [SideExtremes; 2],
    /// Time at which |θ| was largest \[s\].
    pub peak_rotation_time_s: Option<f64>,
    /// B sin(peak rotation): uplift of the free edge \[m\].
    pub uplift_m: f64,
    /// Largest rise of the centre of gravity \[m\]: R(1 − cos α) once |θ| has passed α.
    pub cg_rise_m: f64,
    /// Time of the first uplift from rest \[s\].
    pub first_uplift_time_s: Option<f64>,
    /// Number of uplifts from rest.
    pub uplift_count: usize,
    /// Time at which |θ| first passed α \[s\].
    pub passed_alpha_time_s: Option<f64>,
    /// Time at which |θ| reached π/2 \[s\].
    pub overturn_time_s: Option<f64>,
    /// All impacts on the floor.
    pub impacts: Vec<RockingImpact>,
    /// All impacts on walls.
    pub wall_impacts: Vec<WallImpact>,
    /// Where the block touches the right and the left wall.
    pub contacts: [Option<Contact>; 2],
    /// Whether a wall holds the block at the end.
    pub leaning: bool,
    /// Time at which the block last came to rest \[s\].
    pub rest_time_s: Option<f64>,
    /// θ at the end \[rad\].
    pub final_rotation_rad: f64,
    /// ω at the end \[rad/s\].
    pub final_omega_rad_s: f64,
    /// Whether the block is at rest at the end.
    pub at_rest: bool,
    /// r for landings on the right edge (the same on the left edge unless the centre of gravity is
    /// off the middle).
    pub restitution_ratio: f64,
    /// Work done.
    pub effort: Effort,
}

/// The part of a history that a spectrum keeps.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RockingSummary {
    /// How the history ended.
    pub outcome: Outcome,
    /// Why the history stopped.
    pub stop: StopReason,
    /// Largest |θ| \[rad\]; π/2 when overturned.
    pub peak_rotation_rad: f64,
    /// Extremes on the right and the left edge.
    pub sides: [SideExtremes; 2],
    /// Number of impacts on the floor until rest or the end.
    pub impact_count: usize,
    /// Number of impacts on walls.
    pub wall_impact_count: usize,
    /// B sin(peak rotation): uplift of the free edge \[m\].
    pub uplift_m: f64,
    /// Largest rise of the centre of gravity \[m\]; R(1 − cos α) once |θ| has passed α.
    pub cg_rise_m: f64,
}

impl From<&Rocking> for RockingSummary {
    fn from(rocking: &Rocking) -> Self {
        Self {
            outcome: rocking.outcome,
            stop: rocking.stop,
            peak_rotation_rad: rocking.peak_rotation_rad,
            sides: rocking.sides,
            impact_count: rocking.impacts.len(),
            wall_impact_count: rocking.wall_impacts.len(),
            uplift_m: rocking.uplift_m,
            cg_rise_m: rocking.cg_rise_m,
        }
    }
}

/// Extremes of the motion about one edge.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SideExtremes {
    /// Largest |θ| \[rad\].
    pub peak_rotation_rad: f64,
    /// Largest |ω| just before an impact that ends the motion about this edge \[rad/s\]; 0 without
    /// impacts.
    pub impact_omega_rad_s: f64,
    /// Largest |ω| just before an impact on the wall of this side \[rad/s\]; 0 without one.
    pub wall_omega_rad_s: f64,
}

/// Why a history cannot be calculated.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum RockingError {
    /// g + ü_v ≤ 0: the object leaves the floor.
    #[error(
        "the base falls away at {time_s} s (g + vertical acceleration ≤ 0): the object is in free flight, which the \
         rocking model does not cover"
    )]
    FreeFlight {
        /// Time \[s\].
        time_s: f64,
    },
    /// With a restitution of (nearly) 1 the block never comes to rest.
    #[error(
        "the object is not at rest at {time_s} s, after {limit} impacts: its restitution is too close to 1"
    )]
    TooManyImpacts {
        /// Time at which the calculation was abandoned \[s\].
        time_s: f64,
        /// The largest number of impacts, [`MAX_IMPACTS`].
        limit: usize,
    },
    /// The Taylor series does not converge: the input is physically impossible.
    #[error("the rocking cannot be calculated at {time_s} s: the time step shrank to {step_s} s")]
    StepTooSmall {
        /// Time \[s\].
        time_s: f64,
        /// The step \[s\].
        step_s: f64,
    },
    /// The restitution is outside \[0, 1\].
    #[error("the restitution must be between 0 and 1, not {value}")]
    Restitution {
        /// r.
        value: f64,
    },
    /// A wall that cannot be used.
    #[error(transparent)]
    Wall(#[from] WallError),
    /// A start beyond the angle at which the block touches a wall.
    #[error(
        "the object touches the {} wall at a rotation of {contact_rad} rad and cannot start beyond it, at {rotation_rad} \
         rad",
        side.name()
    )]
    BeyondWall {
        /// The side of the wall.
        side: Side,
        /// |θ| at the start \[rad\].
        rotation_rad: f64,
        /// θ_c \[rad\].
        contact_rad: f64,
    },
    /// Walls together with the linearised equation.
    #[error("the linearised equation of motion has no walls")]
    LinearisedWall,
    /// The initial rotation is not within ±π/2, or the initial velocity is not finite.
    #[error(
        "the initial rotation must be within ±π/2 and the velocity finite, not {rotation_rad} rad and {omega_rad_s} \
         rad/s"
    )]
    InitialState {
        /// θ \[rad\].
        rotation_rad: f64,
        /// ω \[rad/s\].
        omega_rad_s: f64,
    },
    /// An end that is not positive and finite, or none at all.
    #[error("a history needs a motion or a positive finite duration, not {duration_s} s")]
    Duration {
        /// The duration that was given \[s\].
        duration_s: f64,
    },
    /// Gravity that is not positive and finite.
    #[error("gravity must be positive and finite, not {gravity_m_s2} m/s²")]
    Gravity {
        /// The gravity that was given \[m/s²\].
        gravity_m_s2: f64,
    },
    /// An accuracy outside the range of relative errors that a step can meet.
    #[error("the accuracy must be between 1.1e-16 and 1e-3, not {tolerance}")]
    Accuracy {
        /// The tolerance that was given.
        tolerance: f64,
    },
    /// Horizontal and vertical motions with different time steps or lengths.
    #[error(
        "the vertical motion has {vertical_samples} samples every {vertical_dt_s} s, the horizontal one {samples} \
         every {dt_s} s"
    )]
    VerticalMismatch {
        /// Samples of the horizontal motion.
        samples: usize,
        /// Time step of the horizontal motion \[s\].
        dt_s: f64,
        /// Samples of the vertical motion.
        vertical_samples: usize,
        /// Time step of the vertical motion \[s\].
        vertical_dt_s: f64,
    },
}

impl Restitution {
    /// The ratios for landings of `block` on its right and left edges.
    ///
    /// # Errors
    /// A value, or a product of Housner's ratio and the factor, outside \[0, 1\].
    pub fn ratios(self, block: &Block) -> Result<[f64; 2], RockingError> {
        let housner = [block, &block.mirrored()].map(|b| b.landing_ratio().max(0.0));
        let ratios = match self {
            Self::Housner => housner,
            Self::Value(value) => [value; 2],
            Self::Factor(factor) => housner.map(|r| factor * r),
            Self::Edges(values) => values,
        };
        match ratios.into_iter().find(|r| !(0.0..=1.0).contains(r)) {
            Some(value) => Err(RockingError::Restitution { value }),
            None => Ok(ratios),
        }
    }
}
