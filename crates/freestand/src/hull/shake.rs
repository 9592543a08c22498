//! A body on its hull under a motion of the floor, in small steps.
//!
//! m r̈ = Σ F − m(ü_x, ü_y, g + ü_z), J Ω̇ + Ω × JΩ = Qᵀ Σ (Q p) × F, with the forces F at the points p of
//! the hull that are below the floor. Normal to the floor N = −k_n z − c_n ż, at least 0; along it T = −k_t
//! s − c_t v with the stretch s of a spring, at most μN, where it slips. k_n = m g/(3δ) at each point,
//! however many there are; c_n = 2ζ√(k_n m/3), k_t = 0.7 k_n, c_t = 1.4ζ√(k_t m/3).
//!
//! [Walls](super::wall) press on the points of the hull behind them.
//!
//! # Accuracy
//! Velocities are stepped before positions, at most 0.1 ms at once: 1/32 of a radian of the vibration of
//! the weight on three contacts that sink 0.1 mm. Many points at once are stiffer and more damped than three:
//! the step is then shorter. A single history of a body that rocks in space is one realisation: a
//! change of the direction by 0.01° changes the outcome of 1 to 5 of 100 motions. Shares over many
//! histories are what can be compared.

use pulp::Arch;

use super::lanes::{LANES, lanes};
use super::standing::Standing;
use super::wall::{Beside, HullWall, Moving};
use super::{HullError, Vector, rolling};
use crate::motion::Motion;
use crate::rocking::LONGEST_TAIL_S;
use crate::space::{Shift, Turn, cross, dot, shift, turned, turned_back, turning};
use crate::spatial::SpatialMotion;

/// How a body touches the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact {
    /// Coefficient of friction μ.
    pub friction_ratio: f64,
    /// Damping of a contact ζ.
    pub damping_ratio: f64,
    /// How far three points sink under the weight, δ \[m\].
    pub sinking_m: f64,
    /// Coefficient of rolling friction μ_r of a round body: the lever arm of the normal force over the radius.
    pub rolling_ratio: f64,
}

impl Default for Contact {
    /// μ = 0.6, ζ = 0.2, δ = 0.1 mm: fixed before any test was calculated. No rolling friction.
    fn default() -> Self {
        Self {
            friction_ratio: 0.6,
            damping_ratio: 0.2,
            sinking_m: 1e-4,
            rolling_ratio: 0.0,
        }
    }
}

impl Contact {
    /// The stiffness of an edge of a body, of two points: 2 m g/(3δ) \[N/m\].
    pub fn edge_n_m(&self, mass_kg: f64, gravity_m_s2: f64) -> f64 {
        2.0 * self.point_n_m(mass_kg, gravity_m_s2)
    }

    /// A stiffness of a wall beside it as it is followed \[N/m\]: of 10 000 edges it gives way by a ten-thousandth of what the
    /// floor does, and a stiffer wall would only need shorter steps.
    pub fn wall_n_m(&self, given_n_m: f64, mass_kg: f64, gravity_m_s2: f64) -> f64 {
        given_n_m.min(1e4 * self.edge_n_m(mass_kg, gravity_m_s2))
    }

    fn point_n_m(&self, mass_kg: f64, gravity_m_s2: f64) -> f64 {
        mass_kg * gravity_m_s2 / (3.0 * self.sinking_m)
    }
}

/// Tilt from the pose above which a body has overturned \[rad\].
pub const OVERTURNED_RAD: f64 = std::f64::consts::PI / 3.0;

/// The longest step \[s\].
const STEP_S: f64 = 1e-4;

/// A body settles for at most this time before it is shaken \[s\].
const SETTLING_S: f64 = 30.0;

/// It rests where it is slower than this for a fifth of a second \[m/s\]; before it is shaken, far slower.
const RESTING_M_S: f64 = 1e-3;
const SETTLED_M_S: f64 = 1e-5;
const RESTING_S: f64 = 0.2;

/// A body that rests farther than this from its pose while a wall presses on it leans there \[rad\]: short of its
/// balance point a smooth wall holds nothing.
const LEANING_RAD: f64 = 0.02;

/// A settling body loses its speed at this rate \[1/s\]: enough to end its vibration, and little enough not to
/// hold up what leans slowly.
const SETTLING_1_S: f64 = 3.0;

/// A body with an uneven base is first put down on it, with its speed lost at this rate \[1/s\]: dropped from where one
/// point touches, a slender one would tip over.
const PUT_DOWN_1_S: f64 = 30.0;

/// How a history on a hull ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum HullOutcome {
    /// It rests in its pose.
    Stood,
    /// It rests in another stable pose, by its place among [`Hull::stable_poses`](super::Hull::stable_poses).
    Shifted(usize),
    /// Its tilt exceeded [`OVERTURNED_RAD`].
    Overturned,
    /// It rests against a wall, past its balance point.
    Leaned,
    /// It did not come to rest.
    Unresolved,
    /// It did not come to rest in its pose before the floor moved.
    Unsettled,
}

impl HullOutcome {
    /// Whether it has left its pose, or cannot stand in it, which counts as a fall.
    pub fn falls(self) -> bool {
        matches!(
            self,
            Self::Shifted(_) | Self::Overturned | Self::Leaned | Self::Unsettled
        )
    }
}

/// What a body did.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HullRocking {
    /// How it ended.
    pub outcome: HullOutcome,
    /// The largest tilt from its pose \[rad\].
    pub peak_tilt_rad: f64,
    /// When it was largest \[s\].
    pub peak_tilt_time_s: f64,
    /// Largest rise of its centre of gravity \[m\].
    pub cg_rise_m: f64,
    /// Largest uplift of a point of its base, from the width of the base and the largest tilt \[m\].
    pub uplift_m: f64,
    /// How far its centre of gravity is from where it was, along the floor \[m\].
    pub moved_m: [f64; 2],
    /// How often it struck a wall, and the largest speed of a point there \[m/s\].
    pub wall_contacts: usize,
    /// See `wall_contacts`.
    pub wall_speed_m_s: f64,
    /// When the history ended \[s\].
    pub end_s: f64,
}

/// A body at one instant, on its way from where it rested.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HullPoint {
    /// Time \[s\].
    pub time_s: f64,
    /// Its tilt towards +x and towards +y of the floor, and in all \[rad\].
    pub tilts_rad: [f64; 3],
    /// How far it has turned about the vertical \[rad\].
    pub yaw_rad: f64,
    /// The displacement of the point of the body that was on the floor below its centre of gravity \[m\].
    pub base_m: Vector,
    /// The place of its centre of gravity above where that was on the floor \[m\].
    pub cg_m: Vector,
    /// Its rotation from the axes in which it was given to those of the floor: w, x, y, z of a unit quaternion.
    pub turn: Turn,
}

impl HullPoint {
    /// Where a point of the body is, in the axes of the floor.
    pub fn place_m(&self, point_m: &Vector) -> Vector {
        let arm = turned(&shift(&self.turn), point_m);
        [0, 1, 2].map(|i| self.cg_m[i] + arm[i])
    }
}

/// When a history is passed to who observes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Whether the history is whole. [`shake`] leaves out what comes before the first acceleration that could lift a
    /// body with a flat base, and what comes after the last one once it rests; what is not whole takes the same
    /// steps as [`shake`], and so ends as it does.
    pub is_whole: bool,
    /// The longest time between two points, besides those at the samples of the motion \[s\].
    pub apart_s: f64,
}

impl Sampling {
    /// The whole history, at the samples of the motion.
    pub const WHOLE: Self = Self {
        is_whole: true,
        apart_s: f64::INFINITY,
    };
}

/// The rotation that brings a direction of the body down, and then turns it by `yaw_rad` about the
/// vertical.
fn upright(down: &Vector, yaw_rad: f64) -> Turn {
    // About down × −z, by the angle between them.
    let axis = cross(down, &[0.0, 0.0, -1.0]);
    let real = 1.0 - down[2];
    let tilt = if real > 1e-12 {
        normalised([real, axis[0], axis[1], axis[2]])
    } else {
        [0.0, 1.0, 0.0, 0.0]
    };
    let (sin, cos) = (0.5 * yaw_rad).sin_cos();
    let [w, x, y, z] = tilt;
    [
        cos * w - sin * z,
        cos * x - sin * y,
        cos * y + sin * x,
        cos * z + sin * w,
    ]
}

fn normalised(turn: Turn) -> Turn {
    let norm = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
    turn.map(|x| x / norm)
}

fn times(m: &[Vector; 3], v: &Vector) -> Vector {
    [dot(&m[0], v), dot(&m[1], v), dot(&m[2], v)]
}

/// The inverse of a symmetric matrix.
fn inverse(m: &[Vector; 3]) -> [Vector; 3] {
    let rows = [
        cross(&m[1], &m[2]),
        cross(&m[2], &m[0]),
        cross(&m[0], &m[1]),
    ];
    let determinant = dot(&m[0], &rows[0]);
    rows.map(|row| row.map(|x| x / determinant))
}

/// The body between two steps.
struct Stepper<'b> {
    body: &'b Standing,
    /// Its points by coordinate, [`LANES`] at once, and their heights.
    coordinates: Vec<[[f64; LANES]; 3]>,
    heights_m: Vec<[f64; LANES]>,
    /// What stands beside it, once it has settled.
    beside: Beside<'b>,
    /// The points that touched the floor at the last step, and those that do now.
    touching: Vec<usize>,
    touched: Vec<usize>,
    /// The stretch of the spring along the floor at each point \[m\].
    stretches_m: Vec<[f64; 2]>,
    inverse: [Vector; 3],
    normal_n_m: f64,
    normal_n_s_m: f64,
    tangential_n_m: f64,
    tangential_n_s_m: f64,
    friction_ratio: f64,
    rolling_ratio: f64,
    gravity_m_s2: f64,
    /// The longest step \[s\].
    longest_s: f64,
    place_m: Vector,
    velocity_m_s: Vector,
    turn: Turn,
    /// Q − I.
    shift: Shift,
    /// In the axes of the body.
    omega_rad_s: Vector,
}

impl<'b> Stepper<'b> {
    fn new(body: &'b Standing, contact: &Contact, yaw_rad: f64, gravity_m_s2: f64) -> Self {
        let normal_n_m = contact.point_n_m(body.mass_kg, gravity_m_s2);
        let tangential_n_m = 0.7 * normal_n_m;
        let damping = |ratio: f64, stiffness_n_m: f64| {
            ratio * contact.damping_ratio * (stiffness_n_m * body.mass_kg / 3.0).sqrt()
        };
        let turn = upright(&body.pose().down, yaw_rad);
        let normal_n_s_m = damping(2.0, normal_n_m);
        // All points at rest together are this stiff and damped, over the mass; so are both edges at a wall.
        let points = body.carried_by(contact.sinking_m) as f64;
        let at_walls =
            |of: &dyn Fn(&HullWall) -> f64| body.walls.iter().map(of).fold(0.0, f64::max);
        let wall_n_m = at_walls(&|wall| 2.0 * wall.stiffness_n_m);
        let wall_n_s_m = at_walls(&|wall| 4.0 * wall.point_n_s_m(body.mass_kg));
        let fast_rad_s = ((points * normal_n_m).max(wall_n_m) / body.mass_kg).sqrt();
        let damped_1_s = (points * normal_n_s_m).max(wall_n_s_m) / body.mass_kg;
        let longest_s = STEP_S.min(0.2 / fast_rad_s).min(0.5 / damped_1_s);
        let coordinates = lanes(&body.points_m);
        Self {
            heights_m: vec![[0.0; LANES]; coordinates.len()],
            coordinates,
            beside: Beside::default(),
            touching: Vec::new(),
            touched: Vec::new(),
            stretches_m: vec![[0.0; 2]; body.points_m.len()],
            inverse: inverse(&body.inertia_kg_m2),
            normal_n_m,
            normal_n_s_m,
            tangential_n_m,
            tangential_n_s_m: damping(1.4, tangential_n_m),
            friction_ratio: contact.friction_ratio,
            rolling_ratio: contact.rolling_ratio,
            gravity_m_s2,
            longest_s,
            place_m: [0.0, 0.0, body.pose().cg_height_m],
            velocity_m_s: [0.0; 3],
            shift: shift(&turn),
            turn,
            omega_rad_s: [0.0; 3],
            body,
        }
    }

    /// One step under these accelerations of the floor \[m/s²\].
    #[inline(always)]
    fn step(&mut self, floor_m_s2: &Vector, step_s: f64) {
        let omega = turned(&self.shift, &self.omega_rad_s);
        self.raise();
        let (mut force, mut torque) = ([0.0; 3], [0.0; 3]);
        for at in 0..self.touching.len() {
            let point = self.touching[at];
            let height_m = self.heights_m[point / LANES][point % LANES];
            let arm = turned(&self.shift, &self.body.points_m[point]);
            let by_turn = cross(&omega, &arm);
            let v = [0, 1, 2].map(|i| self.velocity_m_s[i] + by_turn[i]);
            let normal_n = (-self.normal_n_m * height_m - self.normal_n_s_m * v[2]).max(0.0);
            let along = self.tangential(point, [v[0], v[1]], normal_n, step_s);
            let of_point = [along[0], along[1], normal_n];
            let moment = cross(&arm, &of_point);
            for i in 0..3 {
                force[i] += of_point[i];
                torque[i] += moment[i];
            }
            if self.rolling_ratio > 0.0 {
                let (point_m, down) = (&self.body.points_m[point], &self.body.pose().down);
                let held = rolling::moment_m(point_m, down, &self.shift, &omega);
                for i in 0..2 {
                    torque[i] += self.rolling_ratio * normal_n * held[i];
                }
            }
        }
        if !self.body.walls.is_empty() {
            let moving = self.moving(omega);
            self.beside.push(&moving, step_s, &mut force, &mut torque);
        }
        let down = [0.0, 0.0, self.gravity_m_s2];
        for i in 0..3 {
            let rate = force[i] / self.body.mass_kg - floor_m_s2[i] - down[i];
            self.velocity_m_s[i] += step_s * rate;
            self.place_m[i] += step_s * self.velocity_m_s[i];
        }
        let torque = turned_back(&self.shift, &torque);
        let momentum = times(&self.body.inertia_kg_m2, &self.omega_rad_s);
        let gyroscopic = cross(&self.omega_rad_s, &momentum);
        let net = [0, 1, 2].map(|i| torque[i] - gyroscopic[i]);
        let rate = times(&self.inverse, &net);
        for (omega, rate) in self.omega_rad_s.iter_mut().zip(rate) {
            *omega += step_s * rate;
        }
        let rate = turning(&self.turn, &self.omega_rad_s);
        let [w, x, y, z] = self.turn;
        self.turn = normalised([
            w + step_s * rate[0],
            x + step_s * rate[1],
            y + step_s * rate[2],
            z + step_s * rate[3],
        ]);
        self.shift = shift(&self.turn);
    }

    #[inline(always)]
    fn moving(&self, omega_rad_s: Vector) -> Moving {
        Moving {
            place_m: self.place_m,
            shift: self.shift,
            velocity_m_s: self.velocity_m_s,
            omega_rad_s,
        }
    }

    /// Puts up its walls where it has settled.
    fn stand_beside(&mut self, yaw_rad: f64) {
        let body = self.body;
        if !body.walls.is_empty() {
            let at = self.moving([0.0; 3]);
            self.beside = Beside::new(&body.walls, body.mass_kg, yaw_rad, &at, &body.sides_m);
        }
    }

    /// The heights of all points, which is nearly all of the work, and those that touch the floor.
    #[inline(always)]
    fn raise(&mut self) {
        std::mem::swap(&mut self.touching, &mut self.touched);
        self.touching.clear();
        let [to_x, to_y, to_z] = self.shift[2];
        let up_m = self.place_m[2];
        for (group, [x, y, z]) in self.coordinates.iter().enumerate() {
            let heights_m = &mut self.heights_m[group];
            let mut is_below = false;
            for lane in 0..LANES {
                let height_m = up_m + to_x * x[lane] + to_y * y[lane] + (1.0 + to_z) * z[lane];
                heights_m[lane] = height_m;
                is_below |= height_m < 0.0;
            }
            if is_below {
                let below = (0..LANES).filter(|lane| heights_m[*lane] < 0.0);
                let points = below.map(|lane| LANES * group + lane);
                let is_point = |point: &usize| *point < self.body.points_m.len();
                self.touching.extend(points.filter(is_point));
            }
        }
        // Who has left the floor begins anew.
        for point in &self.touched {
            if self.heights_m[point / LANES][point % LANES] >= 0.0 {
                self.stretches_m[*point] = [0.0; 2];
            }
        }
    }

    /// The force along the floor at a point that moves with this velocity \[N\].
    #[inline(always)]
    fn tangential(&mut self, point: usize, v: [f64; 2], normal_n: f64, step_s: f64) -> [f64; 2] {
        let stretch_m = &mut self.stretches_m[point];
        let mut along = [0.0; 2];
        for i in 0..2 {
            stretch_m[i] += step_s * v[i];
            along[i] = -self.tangential_n_m * stretch_m[i] - self.tangential_n_s_m * v[i];
        }
        let size_n = (along[0] * along[0] + along[1] * along[1]).sqrt();
        let most_n = self.friction_ratio * normal_n;
        if size_n > most_n {
            for i in 0..2 {
                along[i] *= most_n / size_n;
                stretch_m[i] = -(along[i] + self.tangential_n_s_m * v[i]) / self.tangential_n_m;
            }
        }
        along
    }

    /// What is down in the axes of the body.
    fn down(&self) -> Vector {
        let [x, y, z] = self.shift[2];
        [-x, -y, -1.0 - z]
    }

    /// Where a point of the body is.
    fn place_of(&self, point: &Vector) -> Vector {
        let arm = turned(&self.shift, point);
        [0, 1, 2].map(|i| self.place_m[i] + arm[i])
    }

    /// The speed of its centre of gravity and that of a point at its height together \[m/s\].
    fn speed_m_s(&self) -> f64 {
        let size = |v: &Vector| dot(v, v).sqrt();
        size(&self.velocity_m_s) + self.body.pose().cg_height_m * size(&self.omega_rad_s)
    }

    /// Lets it settle on its contacts. Whether it rests, in its pose.
    fn settle(&mut self) -> bool {
        if self.body.is_uneven {
            self.come_to_rest(PUT_DOWN_1_S);
        }
        self.come_to_rest(SETTLING_1_S) && self.body.nearest(&self.down()) == self.body.pose
    }

    /// Whether it comes to rest, losing its speed at this rate \[1/s\].
    fn come_to_rest(&mut self, loss_1_s: f64) -> bool {
        let mut rested = 0;
        let needed = self.steps(RESTING_S);
        let kept = 1.0 - loss_1_s * self.longest_s;
        for _ in 0..self.steps(SETTLING_S) {
            self.step(&[0.0; 3], self.longest_s);
            self.velocity_m_s = self.velocity_m_s.map(|v| kept * v);
            self.omega_rad_s = self.omega_rad_s.map(|v| kept * v);
            let is_slow = self.speed_m_s() < SETTLED_M_S;
            rested = if is_slow { rested + 1 } else { 0 };
            if rested > needed {
                break;
            }
        }
        (self.velocity_m_s, self.omega_rad_s) = ([0.0; 3], [0.0; 3]);
        rested > needed
    }

    fn steps(&self, duration_s: f64) -> usize {
        (duration_s / self.longest_s) as usize
    }
}

/// A body under a motion of the floor, turned by `yaw_rad` about the vertical, until it rests or lies; at
/// most [`LONGEST_TAIL_S`] after the last sample.
///
/// # Errors
/// A contact without stiffness, damping or with negative friction; components of a motion that differ in
/// step or length.
pub fn shake(
    body: &Standing,
    contact: &Contact,
    yaw_rad: f64,
    motion: &SpatialMotion,
    gravity_m_s2: f64,
) -> Result<HullRocking, HullError> {
    followed(body, contact, yaw_rad, motion, gravity_m_s2, None)
}

/// As [`shake`], and passes where the body is.
///
/// # Errors
/// As [`shake`].
pub fn shake_observed(
    body: &Standing,
    contact: &Contact,
    yaw_rad: f64,
    motion: &SpatialMotion,
    gravity_m_s2: f64,
    sampling: Sampling,
    observe: &mut dyn FnMut(HullPoint),
) -> Result<HullRocking, HullError> {
    let observe = Some((sampling, observe));
    followed(body, contact, yaw_rad, motion, gravity_m_s2, observe)
}

fn followed(
    body: &Standing,
    contact: &Contact,
    yaw_rad: f64,
    motion: &SpatialMotion,
    gravity_m_s2: f64,
    observe: Option<(Sampling, &mut dyn FnMut(HullPoint))>,
) -> Result<HullRocking, HullError> {
    let Contact {
        friction_ratio,
        damping_ratio,
        sinking_m,
        rolling_ratio,
    } = *contact;
    let is_positive = |x: f64| x > 0.0 && x.is_finite();
    if !body.walls.iter().all(HullWall::is_valid) {
        return Err(HullError::Wall);
    }
    let rolls = rolling_ratio >= 0.0 && rolling_ratio.is_finite();
    if !(friction_ratio >= 0.0 && rolls && is_positive(damping_ratio) && is_positive(sinking_m)) {
        return Err(HullError::Contact);
    }
    let given = [motion.x, motion.y, motion.vertical];
    let mut all = given.into_iter().flatten();
    let first = all.next();
    let is_same = |one: &Motion, other: &Motion| {
        one.dt_s() == other.dt_s() && one.accel_m_s2().len() == other.accel_m_s2().len()
    };
    if first.is_some_and(|first| all.any(|one| !is_same(one, first))) {
        return Err(HullError::Motion);
    }
    // The same operations in the same order, in the vectors that the processor has.
    Ok(Arch::new().dispatch(|| follow(body, contact, yaw_rad, given, gravity_m_s2, observe)))
}

/// How far a body has come from where it rests.
struct Watch {
    rest_m: Vector,
    rest_down: Vector,
    /// The point of the body on the floor below its centre of gravity.
    base_m: Vector,
    base_at_rest_m: Vector,
    rest_turn: Turn,
    least_cos: f64,
    peak_s: f64,
    rise_m: f64,
    now_s: f64,
}

impl Watch {
    fn new(stepper: &Stepper) -> Self {
        let rest_down = stepper.down();
        let base_m = rest_down.map(|x| stepper.place_m[2] * x);
        Self {
            rest_m: stepper.place_m,
            rest_down,
            base_m,
            base_at_rest_m: stepper.place_of(&base_m),
            rest_turn: stepper.turn,
            least_cos: 1.0,
            peak_s: 0.0,
            rise_m: 0.0,
            now_s: 0.0,
        }
    }

    /// Whether it has overturned.
    #[inline(always)]
    fn has_fallen(&mut self, stepper: &Stepper, now_s: f64) -> bool {
        self.rise_m = self.rise_m.max(stepper.place_m[2] - self.rest_m[2]);
        let cos = dot(&stepper.down(), &self.rest_down);
        if cos < self.least_cos {
            (self.least_cos, self.peak_s) = (cos, now_s);
        }
        self.least_cos < OVERTURNED_RAD.cos()
    }

    fn ended(&self, stepper: &Stepper, outcome: HullOutcome) -> HullRocking {
        HullRocking {
            outcome,
            peak_tilt_rad: self.least_cos.clamp(-1.0, 1.0).acos(),
            peak_tilt_time_s: self.peak_s,
            cg_rise_m: self.rise_m,
            uplift_m: stepper.body.base_width_m
                * (1.0 - self.least_cos * self.least_cos).max(0.0).sqrt(),
            moved_m: [0, 1].map(|i| stepper.place_m[i] - self.rest_m[i]),
            wall_contacts: stepper.beside.contacts,
            wall_speed_m_s: stepper.beside.speed_m_s,
            end_s: self.now_s,
        }
    }

    fn point(&self, stepper: &Stepper, time_s: f64) -> HullPoint {
        let base_m = stepper.place_of(&self.base_m);
        let up = turned(&stepper.shift, &self.rest_down).map(|x| -x);
        // Of the rotation since it rested, the part about the vertical.
        let [w, x, y, z] = stepper.turn;
        let [w0, x0, y0, z0] = self.rest_turn;
        let (real, vertical) = (
            w * w0 + x * x0 + y * y0 + z * z0,
            z * w0 - w * z0 + y * x0 - x * y0,
        );
        HullPoint {
            time_s,
            tilts_rad: [
                up[0].atan2(up[2]),
                up[1].atan2(up[2]),
                up[0].hypot(up[1]).atan2(up[2]),
            ],
            yaw_rad: 2.0 * vertical.atan2(real),
            base_m: [0, 1, 2].map(|i| base_m[i] - self.base_at_rest_m[i]),
            cg_m: [0, 1, 2].map(|i| match i {
                2 => stepper.place_m[2],
                _ => stepper.place_m[i] - self.rest_m[i],
            }),
            turn: stepper.turn,
        }
    }
}

#[inline(always)]
fn follow(
    body: &Standing,
    contact: &Contact,
    yaw_rad: f64,
    given: [Option<&Motion>; 3],
    gravity_m_s2: f64,
    observe: Option<(Sampling, &mut dyn FnMut(HullPoint))>,
) -> HullRocking {
    let nobody: &mut dyn FnMut(HullPoint) = &mut |_| {};
    let unseen = Sampling {
        is_whole: false,
        ..Sampling::WHOLE
    };
    let (Sampling { is_whole, apart_s }, observe) = observe.unwrap_or((unseen, nobody));
    let mut stepper = Stepper::new(body, contact, yaw_rad, gravity_m_s2);
    let is_settled = stepper.settle();
    let mut watch = Watch::new(&stepper);
    if !is_settled {
        return watch.ended(&stepper, HullOutcome::Unsettled);
    }
    stepper.stand_beside(yaw_rad);
    let first = given.into_iter().flatten().next();
    let (samples, dt_s) = first.map_or((0, STEP_S), |one| (one.accel_m_s2().len(), one.dt_s()));
    let per_sample = (dt_s / stepper.longest_s).ceil().max(1.0) as usize;
    let step_s = dt_s / per_sample as f64;
    let seen_each = ((apart_s / step_s) as usize).max(1);
    let is_seen = |sub: usize| seen_each < per_sample && sub > 0 && sub.is_multiple_of(seen_each);
    let at = |axis: usize, sample: usize| {
        given[axis].map_or(0.0, |one| {
            one.accel_m_s2().get(sample).copied().unwrap_or(0.0)
        })
    };
    // The floor between a sample and the next one could lift it, or slide from under it.
    let quiet_ratio = body.quiet_ratio.min(0.5 * contact.friction_ratio);
    let is_strong = |sample: usize| {
        [sample, sample + 1].into_iter().any(|sample| {
            let [x, y, z] = [0, 1, 2].map(|axis| at(axis, sample));
            x.hypot(y) >= quiet_ratio * (gravity_m_s2 + z)
        })
    };
    let strong = match is_whole || quiet_ratio == 0.0 {
        true => 0..samples,
        false => {
            let first = (0..samples).find(|sample| is_strong(*sample));
            let last = (0..samples).rfind(|sample| is_strong(*sample));
            first.unwrap_or(samples)..last.map_or(0, |last| last + 1)
        }
    };
    watch.now_s = strong.start as f64 * dt_s;
    let (mut rested, needed) = (0, stepper.steps(RESTING_S));
    for sample in strong.start..samples {
        if sample >= strong.end && rested > needed {
            break;
        }
        observe(watch.point(&stepper, watch.now_s));
        let [from, to] = [sample, sample + 1].map(|sample| [0, 1, 2].map(|axis| at(axis, sample)));
        for sub in 0..per_sample {
            if is_seen(sub) {
                observe(watch.point(&stepper, watch.now_s + sub as f64 * step_s));
            }
            let share = (sub as f64 + 0.5) / per_sample as f64;
            let floor = [0, 1, 2].map(|i| from[i] + share * (to[i] - from[i]));
            stepper.step(&floor, step_s);
            let now_s = watch.now_s + (sub + 1) as f64 * step_s;
            if watch.has_fallen(&stepper, now_s) {
                watch.now_s = now_s;
                observe(watch.point(&stepper, now_s));
                return watch.ended(&stepper, HullOutcome::Overturned);
            }
        }
        watch.now_s = (sample + 1) as f64 * dt_s;
        let is_slow = sample >= strong.end && stepper.speed_m_s() < RESTING_M_S;
        rested = if is_slow { rested + per_sample } else { 0 };
    }
    rested = 0;
    let tail_s = stepper.longest_s;
    let mut next_s = watch.now_s;
    for _ in 0..stepper.steps(LONGEST_TAIL_S) {
        if watch.now_s >= next_s {
            observe(watch.point(&stepper, watch.now_s));
            next_s += dt_s.min(apart_s);
        }
        stepper.step(&[0.0; 3], tail_s);
        watch.now_s += tail_s;
        if watch.has_fallen(&stepper, watch.now_s) {
            observe(watch.point(&stepper, watch.now_s));
            return watch.ended(&stepper, HullOutcome::Overturned);
        }
        let is_slow = stepper.speed_m_s() < RESTING_M_S;
        rested = if is_slow { rested + 1 } else { 0 };
        if rested > needed {
            let is_held = stepper.beside.presses();
            let is_tilted = dot(&stepper.down(), &watch.rest_down) < LEANING_RAD.cos();
            let outcome = match body.nearest(&stepper.down()) {
                _ if is_held && is_tilted => HullOutcome::Leaned,
                pose if pose == body.pose => HullOutcome::Stood,
                pose => HullOutcome::Shifted(pose),
            };
            return watch.ended(&stepper, outcome);
        }
    }
    watch.ended(&stepper, HullOutcome::Unresolved)
}
