//! The block on a compliant base: a rigid block on cushions that only push, in the plane,
//! integrated in time.
//!
//! m ẍ = ΣT − m ü_h, m z̈ = ΣN − m(g + ü_v), I θ̈ = Σ(r_z T − r_x N), with N from the law of a
//! [`Cushion`] at each contact element and T from a spring that may slip. Sine and cosine are
//! exact, so rotations may be large. It is a second opinion on Eq. (5) of
//! [`impact`](crate::impact), which models neither how the old pivot unloads nor how the landing
//! edge moves sideways.
//!
//! Rules:
//! * **Zero** is the surface of the unloaded pads. At rest the pads are compressed
//!   ([`Equilibrium`]); a rotation on compressed pads is not uplift: **uplift** is the height of an
//!   edge above its unloaded pad.
//! * **Contact** begins when a point meets the surface of its cushion and ends when the cushion
//!   would have to pull. The contact with a damped cushion ends while it is still compressed; its
//!   surface then recovers as its dashpot allows, and the energy stored in it is lost to the block.
//! * **Friction**: T is a spring from the point of first contact, with an optional dashpot. Where
//!   |T| exceeds μN the foot of the spring slides at μN; it sticks again when its sliding would
//!   reverse. The spring starts unstretched with each contact.
//! * **Overturned** when |θ| reaches π/2. A block that leaves all its cushions is in free flight.
//!
//! Between samples the base acceleration is linear, and no step crosses a sample, the beginning or
//! end of a contact or of a slip, or a kink of a tabulated law.

mod audit;
mod bulk;
mod equation;
mod equilibrium;
mod events;
mod history;
pub(crate) mod pad;
mod solve;
pub(crate) mod step;
pub(crate) mod stepper;
pub(crate) mod tail;
mod track;

#[cfg(test)]
mod tests;

use thiserror::Error;

use crate::cushion::Cushion;
use crate::rocking::{Accuracy, Base, Outcome};

pub use audit::EnergyAudit;
pub(crate) use audit::{Energies, Ledger};
#[doc(hidden)]
pub use bulk::rock_compliant_many_on;
pub use bulk::{
    CompliantSummary, CompliantWorld, PadOutcome, pad_uplift_threshold_m_s2, rock_compliant_many,
    rocking_frequency_hz,
};
pub use equilibrium::{Equilibrium, equilibrium};
pub(crate) use events::TOUCHING;
pub use history::{CompliantPoint, CompliantRecorder};
pub use solve::{Piece, rock_compliant, rock_compliant_observed};
pub(crate) use track::{HEADROOM, raise};

/// Steps after which a history is abandoned.
pub const MAX_STEPS: usize = 20_000_000;

/// The largest number of contact elements under a block.
pub const MAX_CONTACTS: usize = equation::MAX_CONTACTS;

/// Stiffness of the tangential spring divided by that of the cushion where none is given: an
/// assumption. Between 0.5 and 100 the shock of the cabinet of Al Abadi et al. changes by a tenth.
pub const ASSUMED_TANGENTIAL_RATIO: f64 = 1.0;

/// The supports of a block.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantBase {
    /// Mass of the block \[kg\].
    pub mass_kg: f64,
    /// The cushion under one edge.
    pub cushion: Cushion,
    /// Contact elements, evenly spaced from edge to edge: 2 are the two edges; N > 2 share the
    /// cushions of both, 2/N of the `cushion` each.
    pub contacts: usize,
    /// Tangential stiffness divided by the tangent stiffness of the cushion under half the weight.
    pub tangential_stiffness_ratio: f64,
    /// Tangential dashpot of one edge \[N s/m\]. Where the contacts slip, a small value makes the
    /// equations stiff: k_t/c steps per second. Without slip it pulls on contacts that carry almost
    /// no load, and they may chatter; use friction then.
    pub tangential_damping_n_s_m: f64,
    /// Coefficient of friction μ; `None`: no slip during contact.
    pub friction_ratio: Option<f64>,
}

impl CompliantBase {
    /// A block of `mass_kg` with this cushion under each of its two edges, without slip.
    pub fn new(mass_kg: f64, cushion: Cushion) -> Self {
        Self {
            mass_kg,
            cushion,
            contacts: 2,
            tangential_stiffness_ratio: ASSUMED_TANGENTIAL_RATIO,
            tangential_damping_n_s_m: 0.0,
            friction_ratio: None,
        }
    }

    /// Tangent stiffness of the cushion under one edge with half the weight on it \[N/m\]; the
    /// tangential stiffness is a ratio of it.
    pub fn normal_stiffness_n_m(&self, gravity_m_s2: f64) -> f64 {
        let rest_m = self
            .cushion
            .static_compression_m(0.5 * self.mass_kg * gravity_m_s2);
        self.cushion.tangent_stiffness_n_m(rest_m)
    }
}

/// The initial state of a history.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Start {
    /// At rest on the compressed cushions.
    #[default]
    Rest,
    /// Held at a rotation and released: the weight rests on the cushion of the lower edge, and a
    /// couple that ends at t = 0 holds the rotation; then the block rotates about that edge at
    /// `omega_rad_s`.
    Tilted {
        /// θ \[rad\], from the upright position.
        rotation_rad: f64,
        /// ω \[rad/s\].
        omega_rad_s: f64,
    },
    /// Upright and at rest, above the unloaded cushions.
    Dropped {
        /// Height of fall to the first contact \[m\].
        height_m: f64,
    },
}

/// The accuracy of a history: an error of each step, relative to the effect of the weight alone on
/// the cushions.
///
/// # Accuracy
/// Runge–Kutta 5(4): the error of a history decreases in proportion to the tolerance. The
/// largest relative errors over the first second, for a cabinet released on 4380 N/mm:
///
/// | level | tolerance | peak shock | energy |
/// |---|---|---|---|
/// | fast | 1e-5 | 2e-4 | 1e-5 |
/// | standard | 1e-8 | 2e-7 | 1e-8 |
/// | tight | 1e-11 | 2e-10 | 1e-11 |
///
/// At `standard` the energy balance closes to 1e-5 with a law that has a fractional power at first
/// contact (Hertz), and to 1e-3 with a bottoming law near its limit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum CompliantAccuracy {
    /// 1e-5: for surveys.
    Fast,
    /// 1e-8.
    #[default]
    Standard,
    /// 1e-11.
    Tight,
    /// A tolerance between 1e-13 and 1e-2.
    Tolerance(f64),
}

impl CompliantAccuracy {
    /// The tolerance of a step.
    pub fn tolerance(self) -> f64 {
        match self {
            Self::Fast => 1e-5,
            Self::Standard => 1e-8,
            Self::Tight => 1e-11,
            Self::Tolerance(tolerance) => tolerance,
        }
    }
}

/// The accuracy of the same name.
impl From<Accuracy> for CompliantAccuracy {
    fn from(name: Accuracy) -> Self {
        match name {
            Accuracy::Fast => Self::Fast,
            Accuracy::Standard => Self::Standard,
            Accuracy::Tight => Self::Tight,
            Accuracy::Tolerance(tolerance) => Self::Tolerance(tolerance),
        }
    }
}

/// Everything else that a history depends on: gravity, accuracy, start, end and points of interest.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantOptions {
    /// g \[m/s²\].
    pub gravity_m_s2: f64,
    /// Accuracy.
    pub accuracy: CompliantAccuracy,
    /// Initial state.
    pub start: Start,
    /// End time; `None`: when the object has come to rest or fallen after the last sample, or
    /// [`LONGEST_TAIL_S`](crate::rocking::LONGEST_TAIL_S) after that sample. After the last sample the base comes to rest within one
    /// time step \[s\].
    pub duration_s: Option<f64>,
    /// Points whose peak accelerations are requested: from the left edge, and above the base \[m\].
    pub points_m: Vec<(f64, f64)>,
}

impl Default for CompliantOptions {
    fn default() -> Self {
        Self {
            gravity_m_s2: crate::G0_M_S2,
            accuracy: CompliantAccuracy::default(),
            start: Start::default(),
            duration_s: None,
            points_m: Vec::new(),
        }
    }
}

/// An edge of the base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum EdgeSide {
    /// The left edge.
    Left,
    /// The right edge.
    Right,
}

impl EdgeSide {
    /// Both edges.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];
}

/// One contact of an edge with its cushion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The edge.
    pub edge: EdgeSide,
    /// Time at which it began \[s\].
    pub time_s: f64,
    /// Downward velocity of the edge at that time \[m/s\].
    pub speed_m_s: f64,
    /// ω at that time \[rad/s\].
    pub omega_before_rad_s: f64,
    /// Time at which it ended, if it did \[s\].
    pub end_time_s: Option<f64>,
    /// Upward velocity of the edge at its end \[m/s\].
    pub rebound_m_s: Option<f64>,
    /// ω at its end \[rad/s\].
    pub omega_after_rad_s: Option<f64>,
    /// Largest upward acceleration of the edge during the contact, in the inertial frame \[m/s²\].
    pub peak_acceleration_m_s2: f64,
    /// Largest force of its cushion during the contact \[N\].
    pub peak_force_n: f64,
}

/// A swing: the largest rotation between two passages of the upright position, if an edge was off
/// its cushion between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Time \[s\].
    pub time_s: f64,
    /// θ \[rad\].
    pub rotation_rad: f64,
    /// √(Δh/Δh of the previous swing), with the rises of the centre of gravity about a rigid edge:
    /// the counterpart of Housner's r. `None` for the first swing, and where the base moves during
    /// it.
    pub effective_restitution_ratio: Option<f64>,
}

/// Peak accelerations of a point of the block in the inertial frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointPeaks {
    /// Largest absolute horizontal acceleration \[m/s²\].
    pub horizontal_m_s2: f64,
    /// Largest absolute vertical acceleration \[m/s²\].
    pub vertical_m_s2: f64,
}

/// Work done to calculate a history.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CompliantEffort {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Contacts and slips that began or ended, and kinks that were passed.
    pub events: usize,
    /// Evaluations of the equation of motion in steps, including those that locate an event.
    pub evaluations: usize,
}

/// The response of a block on its cushions.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantRocking {
    /// How the history ended; `NoUplift` if no edge rose above its unloaded pad.
    pub outcome: Outcome,
    /// Time at which the history ended \[s\].
    pub end_time_s: f64,
    /// Equilibrium on the cushions at rest; `None` if there is no stable one (and the history did
    /// not start from it).
    pub equilibrium: Option<Equilibrium>,
    /// Largest |θ| \[rad\]; π/2 when overturned.
    pub peak_rotation_rad: f64,
    /// Its time \[s\].
    pub peak_rotation_time_s: f64,
    /// Largest |θ| with an edge above its unloaded pad \[rad\].
    pub peak_uplifted_rotation_rad: f64,
    /// Largest height of an edge above its unloaded pad \[m\].
    pub uplift_m: f64,
    /// Rise of the centre of gravity of a rigid rocking block at that rotation \[m\], as used in
    /// Eq. (7); R(1 − cos α) beyond α.
    pub cg_rise_m: f64,
    /// Time at which an edge was first above its unloaded pad \[s\].
    pub first_uplift_time_s: Option<f64>,
    /// Time at which |θ| first passed α of the edge about which the block rotated \[s\].
    pub passed_alpha_time_s: Option<f64>,
    /// Time at which |θ| reached π/2 \[s\].
    pub overturn_time_s: Option<f64>,
    /// Contacts of the two edges, except those at the start.
    pub touches: Vec<Touch>,
    /// Contacts of an edge that had left its cushion without a contact of the other edge in
    /// between.
    pub bounce_count: usize,
    /// Number of times that the block left all its cushions.
    pub flight_count: usize,
    /// Time without contact with any cushion \[s\].
    pub flight_time_s: f64,
    /// Swings with an edge off its cushion.
    pub swings: Vec<Swing>,
    /// Largest upward acceleration of each edge during contact, left and right, in the inertial
    /// frame \[m/s²\].
    pub peak_edge_accelerations_m_s2: [f64; 2],
    /// Largest force of the cushion under each edge \[N\].
    pub peak_edge_forces_n: [f64; 2],
    /// Largest compression of a cushion under an edge \[m\].
    pub peak_compression_m: f64,
    /// The peaks for each of [`CompliantOptions::points_m`].
    pub points: Vec<PointPeaks>,
    /// Largest |T|/N of a contact that carries at least a tenth of the weight.
    pub friction_used_ratio: f64,
    /// Total sliding distance of all contacts \[m\].
    pub slid_m: f64,
    /// θ at the end \[rad\].
    pub final_rotation_rad: f64,
    /// ω at the end \[rad/s\].
    pub final_omega_rad_s: f64,
    /// The energy balance.
    pub energy: EnergyAudit,
    /// Work done.
    pub effort: CompliantEffort,
}

impl CompliantRocking {
    /// The larger of [`CompliantRocking::peak_edge_accelerations_m_s2`]: a_edge.
    pub fn peak_edge_acceleration_m_s2(&self) -> f64 {
        self.peak_edge_accelerations_m_s2[0].max(self.peak_edge_accelerations_m_s2[1])
    }
}

/// Why a history cannot be calculated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CompliantError {
    /// A number that is out of range.
    #[error("the {name} must be {requirement}, not {value}")]
    Value {
        /// The name of the number.
        name: &'static str,
        /// The requirement that it does not meet.
        requirement: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// Too few or too many contact elements.
    #[error("an object must have 2 to {MAX_CONTACTS} contact elements, not {contacts}")]
    Contacts {
        /// The number that was given.
        contacts: usize,
    },
    /// The cushions are too soft to keep the object upright.
    #[error(
        "the cushions are too soft for this object: it has no stable upright position at rest (rotational stiffness \
         {stiffness_n_m:.4} N m/rad; m g z = {needed_n_m:.4} N m/rad)"
    )]
    Unstable {
        /// Rotational stiffness of the cushions under the weight \[N m/rad\].
        stiffness_n_m: f64,
        /// The stiffness needed: weight times height of the centre of gravity \[N m/rad\].
        needed_n_m: f64,
    },
    /// An end that is not positive and finite, or none at all.
    #[error("a history needs a motion or a positive finite duration, not {duration_s} s")]
    Duration {
        /// The duration that was given \[s\].
        duration_s: f64,
    },
    /// A start at which the object reaches into a wall.
    #[error("the object starts beyond its wall")]
    BeyondWall,
    /// Horizontal and vertical motions with different time steps or lengths.
    #[error("the horizontal and the vertical motion differ in time step or length")]
    VerticalMismatch,
    /// The step that would be accurate enough is lost in rounding.
    #[error(
        "the motion of the object cannot be calculated at {time_s} s: the time step shrank to {step_s} s"
    )]
    StepTooSmall {
        /// Time at which the calculation was abandoned \[s\].
        time_s: f64,
        /// Length of the step \[s\].
        step_s: f64,
    },
    /// A motion too strong for numbers.
    #[error("the motion of the object grew beyond all numbers by {time_s} s")]
    NotFinite {
        /// Time \[s\].
        time_s: f64,
    },
    /// More than [`MAX_STEPS`] steps.
    #[error(
        "the calculation stopped at {time_s} s after {limit} steps: the cushions are too stiff for a history of this \
         length"
    )]
    TooManySteps {
        /// Time at which the calculation was abandoned \[s\].
        time_s: f64,
        /// The largest number of steps.
        limit: usize,
    },
}

/// # Errors
/// A number that is not `fine`.
pub(crate) fn within(
    fine: bool,
    name: &'static str,
    requirement: &'static str,
    value: f64,
) -> Result<(), CompliantError> {
    fine.then_some(()).ok_or(CompliantError::Value {
        name,
        requirement,
        value,
    })
}

pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), CompliantError> {
    let fine = value > 0.0 && value.is_finite();
    within(fine, name, "positive and finite", value)
}

pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<(), CompliantError> {
    let fine = value >= 0.0 && value.is_finite();
    within(fine, name, "at least 0 and finite", value)
}

/// # Errors
/// Errors of a step that are too large to trust, or smaller than rounding.
pub(crate) fn check_accuracy(accuracy: CompliantAccuracy) -> Result<(), CompliantError> {
    let tolerance = accuracy.tolerance();
    let fine = (1e-13..=1e-2).contains(&tolerance);
    within(fine, "accuracy", "between 1e-13 and 1e-2", tolerance)
}

/// # Errors
/// A start beyond lying.
pub(crate) fn check_tilt(name: &'static str, tilt_rad: f64) -> Result<(), CompliantError> {
    let fine = tilt_rad.abs() < std::f64::consts::FRAC_PI_2;
    within(fine, name, "within ±π/2", tilt_rad)
}

/// The stiffest cushion along its face, as a multiple of its stiffness across it. Real ones are from 2/3 to
/// 1; the number of steps grows with the root of the ratio.
pub const MAX_TANGENTIAL_RATIO: f64 = 1000.0;

pub(crate) fn tangential_ratio(value: f64) -> Result<(), CompliantError> {
    let name = "ratio of the tangential stiffness";
    positive(name, value)?;
    within(value <= MAX_TANGENTIAL_RATIO, name, "at most 1000", value)
}

/// Returns an error for input from which no history can be calculated.
fn check(
    base: &CompliantBase,
    motion: Base<'_>,
    options: &CompliantOptions,
) -> Result<(), CompliantError> {
    positive("mass", base.mass_kg)?;
    positive("gravity", options.gravity_m_s2)?;
    tangential_ratio(base.tangential_stiffness_ratio)?;
    not_negative("tangential damping", base.tangential_damping_n_s_m)?;
    if let Some(friction) = base.friction_ratio {
        not_negative("friction", friction)?;
    }
    if !(2..=MAX_CONTACTS).contains(&base.contacts) {
        return Err(CompliantError::Contacts {
            contacts: base.contacts,
        });
    }
    check_accuracy(options.accuracy)?;
    match options.start {
        Start::Rest => {}
        Start::Tilted {
            rotation_rad,
            omega_rad_s,
        } => {
            check_tilt("initial rotation", rotation_rad)?;
            not_negative("initial angular speed", omega_rad_s.abs())?;
        }
        Start::Dropped { height_m } => not_negative("height of the drop", height_m)?,
    }
    if equation::Line::mismatch([motion.horizontal, motion.vertical]) {
        return Err(CompliantError::VerticalMismatch);
    }
    Ok(())
}
