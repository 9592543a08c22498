//! The block on a compliant base: a rigid body on compression-only cushions, in the plane, followed in time.
//!
//! m ẍ = ΣT − m ü_h, m z̈ = ΣN − m(g + ü_v), I θ̈ = Σ(r_z T − r_x N), with N by the law of a
//! [`Cushion`] at each contact element and T by a spring that may slip. Sine and cosine are exact: rotations may be large. It is a
//! second opinion on Eq. (5) of [`impact`](crate::impact), which knows neither how the old pivot unloads nor how the landing edge
//! gives way sideways.
//!
//! Rules:
//! * **Zero** is the surface of the unloaded pads. At rest the pads are pressed ([`Equilibrium`]); a rotation on pressed pads is
//!   not uplift: **uplift** is the height of an edge above its unloaded pad.
//! * **Contact** begins when a point meets the surface of its cushion and ends when the cushion would have to pull. A damped
//!   cushion is left while it is still pressed; its surface comes back on its own as its dashpot lets it, and what it had stored
//!   is lost to the body.
//! * **Friction**: T is a spring from where the point touched, with an optional dashpot; where |T| passes μN the foot of the spring slides at μN and
//!   sticks again when its sliding would turn round. The spring starts anew with each contact.
//! * **Overturned** when |θ| reaches π/2. A body that leaves all its cushions flies.
//!
//! Between samples the base acceleration is linear, and no step crosses a sample, the beginning or end of a contact or of a
//! slip, or a kink of a tabulated law.

mod audit;
mod equation;
mod equilibrium;
mod events;
mod history;
mod solve;
mod step;
mod track;

#[cfg(test)]
mod tests;

use thiserror::Error;

use crate::cushion::Cushion;
use crate::rocking::{Base, Outcome};

pub use audit::EnergyAudit;
pub use equilibrium::{Equilibrium, equilibrium};
pub use history::{CompliantPoint, CompliantRecorder};
pub use solve::{Piece, rock_compliant, rock_compliant_observed};

/// Steps after which a history is given up.
pub const MAX_STEPS: usize = 20_000_000;

/// Most contact elements under a body.
pub const MAX_CONTACTS: usize = equation::MAX_CONTACTS;

/// Stiffness of the tangential spring over that of the cushion where nobody says: an assumption. Between 0.5 and 100 the shock of the
/// cabinet of Al Abadi et al. changes by a tenth.
pub const ASSUMED_TANGENTIAL_RATIO: f64 = 1.0;

/// What a body stands on.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantBase {
    /// Mass of the body \[kg\].
    pub mass_kg: f64,
    /// All the cushion under one edge.
    pub cushion: Cushion,
    /// Contact elements, evenly from edge to edge: 2 are the two edges, N > 2 share the cushions of both, 2/N of the
    /// `cushion` each.
    pub contacts: usize,
    /// Tangential stiffness over the tangent stiffness of the cushion at half the weight.
    pub tangential_stiffness_ratio: f64,
    /// Tangential dashpot of one edge \[N s/m\]. Where feet slip, a small one makes the equations stiff: k_t/c steps a second. Without
    /// slip it pulls on a foot that hardly presses, and the contact may chatter: give friction then.
    pub tangential_damping_n_s_m: f64,
    /// μ, or `None`: no slip while there is contact.
    pub friction_ratio: Option<f64>,
}

impl CompliantBase {
    /// A body of `mass_kg` with this cushion under each of its two edges, without slip.
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

    /// Tangent stiffness of the cushion under one edge with half the weight on it \[N/m\]: what the tangential one is a ratio of.
    pub fn normal_stiffness_n_m(&self, gravity_m_s2: f64) -> f64 {
        let rest_m = self.cushion.static_compression_m(0.5 * self.mass_kg * gravity_m_s2);
        self.cushion.tangent_stiffness_n_m(rest_m)
    }
}

/// How a history begins.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Start {
    /// At rest on the pressed cushions.
    #[default]
    Rest,
    /// Held at a rotation and let go: the weight is in balance on the cushion of the lower edge, the tilt is held by a
    /// couple that ends at t = 0; then it turns about that edge at `omega_rad_s`.
    Tilted {
        /// θ \[rad\], measured from the upright body.
        rotation_rad: f64,
        /// ω \[rad/s\].
        omega_rad_s: f64,
    },
    /// Upright and at rest, this far above the unloaded cushions.
    Dropped {
        /// Fall to the first touch \[m\].
        height_m: f64,
    },
}

/// How accurately a history is followed: an error of each step, relative to what the weight alone does to the cushions.
///
/// # Accuracy
/// Runge–Kutta 5(4): the error of a history falls in proportion to the tolerance. Releases of a cabinet on 4380 N/mm, worst over
/// the first second:
///
/// | level | tolerance | peak shock | energy |
/// |---|---|---|---|
/// | fast | 1e-5 | 2e-4 | 1e-5 |
/// | standard | 1e-8 | 2e-7 | 1e-8 |
/// | tight | 1e-11 | 2e-10 | 1e-11 |
///
/// Laws with a root at the first touch (Hertz) close the energy to 1e-5 by `standard`, a bottoming one near its end to 1e-3.
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

/// What a history depends on beside the body, what it stands on and the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantOptions {
    /// g \[m/s²\].
    pub gravity_m_s2: f64,
    /// Accuracy.
    pub accuracy: CompliantAccuracy,
    /// How it begins.
    pub start: Start,
    /// When it ends; `None`: with the last sample. Past the last sample the base comes to rest within one more step \[s\].
    pub duration_s: Option<f64>,
    /// Points whose peak accelerations are wanted: from the left edge, and above the base \[m\].
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeSide {
    /// The left edge.
    Left,
    /// The right edge.
    Right,
}

impl EdgeSide {
    /// `left`, `right`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// A touch of an edge with its cushion, until it leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The edge.
    pub edge: EdgeSide,
    /// When it touched \[s\].
    pub time_s: f64,
    /// Downward speed of the edge then \[m/s\].
    pub speed_m_s: f64,
    /// ω then \[rad/s\].
    pub omega_before_rad_s: f64,
    /// When it left, if it did \[s\].
    pub end_s: Option<f64>,
    /// Upward speed of the edge on leaving \[m/s\].
    pub rebound_m_s: Option<f64>,
    /// ω on leaving \[rad/s\].
    pub omega_after_rad_s: Option<f64>,
    /// Largest upward acceleration of the edge meanwhile, in the ground's frame \[m/s²\].
    pub peak_acceleration_m_s2: f64,
    /// Largest force of its cushion meanwhile \[N\].
    pub peak_force_n: f64,
}

/// The largest rotation between two passages of the upright position, with an edge off its cushion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// When \[s\].
    pub time_s: f64,
    /// θ \[rad\].
    pub rotation_rad: f64,
    /// √(Δh/Δh of the swing before), with the rises of the centre of gravity about a rigid edge: what Housner's r is to a
    /// rigid block. `None` for the first swing, and where the base moves and takes part in it.
    pub effective_restitution_ratio: Option<f64>,
}

/// Peak accelerations of a point of the body in the ground's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointPeaks {
    /// Of its horizontal acceleration, absolute \[m/s²\].
    pub horizontal_m_s2: f64,
    /// Of its vertical acceleration, absolute \[m/s²\].
    pub vertical_m_s2: f64,
}

/// Work that a history took.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CompliantEffort {
    /// Steps that were kept.
    pub steps: usize,
    /// Steps that were too long.
    pub rejected: usize,
    /// Contacts and slips that began or ended, kinks that were passed.
    pub events: usize,
    /// Evaluations of the equation of motion in steps, those that look for an event included.
    pub evaluations: usize,
}

/// What a body did on its cushions.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantRocking {
    /// What happened; `NoUplift` if no edge rose above its unloaded pad.
    pub outcome: Outcome,
    /// When the history ended \[s\].
    pub end_s: f64,
    /// Balance on the cushions at rest; `None` if there is none that holds (the start was another one).
    pub equilibrium: Option<Equilibrium>,
    /// Largest |θ| \[rad\]; π/2 when overturned.
    pub peak_rotation_rad: f64,
    /// When \[s\].
    pub peak_rotation_time_s: f64,
    /// Largest |θ| with an edge above its unloaded pad \[rad\].
    pub peak_uplifted_rotation_rad: f64,
    /// Largest height of an edge above its unloaded pad \[m\].
    pub uplift_m: f64,
    /// Rise of the centre of gravity of a rigid rocking block at that rotation \[m\]: what Eq. (7) takes; R(1 − cos α) beyond α.
    pub cg_rise_m: f64,
    /// First time that an edge was above its unloaded pad \[s\].
    pub first_uplift_time_s: Option<f64>,
    /// When |θ| first passed α of the edge that it turned about \[s\].
    pub passed_alpha_time_s: Option<f64>,
    /// When |θ| reached π/2 \[s\].
    pub overturn_time_s: Option<f64>,
    /// Touches of the two edges, those at the start left out.
    pub touches: Vec<Touch>,
    /// Touches of an edge that had left its cushion with no touch of the other edge in between.
    pub bounce_count: usize,
    /// Times that the body left all its cushions.
    pub flight_count: usize,
    /// Time off all cushions \[s\].
    pub flight_time_s: f64,
    /// Swings with an edge off its cushion.
    pub swings: Vec<Swing>,
    /// Largest upward acceleration of each edge while it carried, left and right, in the ground's frame \[m/s²\].
    pub peak_edge_accelerations_m_s2: [f64; 2],
    /// Largest force of the cushion under each edge \[N\].
    pub peak_edge_forces_n: [f64; 2],
    /// Largest compression of a cushion under an edge \[m\].
    pub peak_compression_m: f64,
    /// For each of [`CompliantOptions::points_m`].
    pub points: Vec<PointPeaks>,
    /// Largest |T|/N of a contact that carries at least a tenth of the weight.
    pub friction_used_ratio: f64,
    /// Distance that the feet slid, all together \[m\].
    pub slid_m: f64,
    /// θ at the end \[rad\].
    pub final_rotation_rad: f64,
    /// ω at the end \[rad/s\].
    pub final_omega_rad_s: f64,
    /// Where the energy went.
    pub energy: EnergyAudit,
    /// Work that it took.
    pub effort: CompliantEffort,
}

impl CompliantRocking {
    /// The harder edge's [`CompliantRocking::peak_edge_accelerations_m_s2`]: a_edge.
    pub fn peak_edge_acceleration_m_s2(&self) -> f64 {
        self.peak_edge_accelerations_m_s2[0].max(self.peak_edge_accelerations_m_s2[1])
    }
}

/// Why a history cannot be followed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CompliantError {
    /// A number that is not what it must be.
    #[error("the {name} must be {requirement}, not {value}")]
    Value {
        /// Which.
        name: &'static str,
        /// What it must be.
        requirement: &'static str,
        /// What it is.
        value: f64,
    },
    /// Too few or too many contact elements.
    #[error("a body stands on 2 to {MAX_CONTACTS} contact elements, not {contacts}")]
    Contacts {
        /// How many were given.
        contacts: usize,
    },
    /// The cushions are too soft to keep the body upright.
    #[error(
        "the cushions are too soft for this body: it has no upright position at rest that holds (turning stiffness {stiffness_n_m:.4} N m/rad against m g z = {needed_n_m:.4} N m/rad)"
    )]
    Unstable {
        /// Of the cushions under the weight.
        stiffness_n_m: f64,
        /// Weight times height of the centre of gravity.
        needed_n_m: f64,
    },
    /// No end, or one that is not positive.
    #[error("a history needs a motion or a positive finite duration, not {duration_s} s")]
    Duration {
        /// What was given.
        duration_s: f64,
    },
    /// Horizontal and vertical motions of different sampling.
    #[error("the horizontal and the vertical motion differ in their steps or lengths")]
    VerticalMismatch,
    /// The step that would be accurate enough is lost in rounding.
    #[error("the motion cannot be followed at {time_s} s: the step shrank to {step_s} s")]
    StepTooSmall {
        /// When.
        time_s: f64,
        /// The step.
        step_s: f64,
    },
    /// [`MAX_STEPS`].
    #[error("{limit} steps by {time_s} s: the cushions are too stiff for so long a history")]
    TooManySteps {
        /// When it was given up.
        time_s: f64,
        /// How many.
        limit: usize,
    },
}

fn positive(name: &'static str, value: f64) -> Result<(), CompliantError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(CompliantError::Value { name, requirement: "positive", value })
}

fn not_negative(name: &'static str, value: f64) -> Result<(), CompliantError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(CompliantError::Value { name, requirement: "zero or positive", value })
}

/// Refuses what no history can be made of.
fn check(base: &CompliantBase, motion: Base<'_>, options: &CompliantOptions) -> Result<(), CompliantError> {
    positive("mass", base.mass_kg)?;
    positive("gravity", options.gravity_m_s2)?;
    positive("ratio of the tangential stiffness", base.tangential_stiffness_ratio)?;
    not_negative("tangential damping", base.tangential_damping_n_s_m)?;
    if let Some(friction) = base.friction_ratio {
        not_negative("friction", friction)?;
    }
    if !(2..=MAX_CONTACTS).contains(&base.contacts) {
        return Err(CompliantError::Contacts { contacts: base.contacts });
    }
    let tolerance = options.accuracy.tolerance();
    if !(1e-13..=1e-2).contains(&tolerance) {
        return Err(CompliantError::Value {
            name: "accuracy",
            requirement: "between 1e-13 and 1e-2",
            value: tolerance,
        });
    }
    match options.start {
        Start::Rest => {}
        Start::Tilted { rotation_rad, omega_rad_s } => {
            if rotation_rad.is_nan() || rotation_rad.abs() >= std::f64::consts::FRAC_PI_2 {
                let requirement = "within ±π/2";
                return Err(CompliantError::Value { name: "initial rotation", requirement, value: rotation_rad });
            }
            not_negative("initial angular speed", omega_rad_s.abs())?;
        }
        Start::Dropped { height_m } => not_negative("height of the drop", height_m)?,
    }
    if let (Some(h), Some(v)) = (motion.horizontal, motion.vertical)
        && (h.dt_s() != v.dt_s() || h.accel_m_s2().len() != v.accel_m_s2().len())
    {
        return Err(CompliantError::VerticalMismatch);
    }
    Ok(())
}
