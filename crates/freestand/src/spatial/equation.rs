//! The equations of motion of rigid bodies in space on contact elements.

use super::element::{Element, Grip};
use super::feet::{Feet, Push, Sorted};
use super::pose::{BODY, PLACE, Pose, SPIN, TURN, VELOCITY, vector};
use crate::compliant::Energies;
use crate::compliant::step::Step;
use crate::space::{
    Vector, cross, difference, dot, moved, moved_back, sum, turned, turned_back, turning,
};

/// The largest number of bodies, and of elements that may slip.
pub(super) const MAX_BODIES: usize = 2;
const MAX_SLIPS: usize = 48;

// Behind the bodies: the work of the base, what dashpots and slip dissipate, and the direction of
// the stretch of each element that may slip.
const WORK: usize = 0;
const DASHPOT: usize = 1;
pub(super) const SLIP: usize = 2;
const DIRECTION: usize = 3;

/// One body with a rim of elements that slip, or two bodies.
pub(super) const LEN: usize = BODY + DIRECTION + MAX_SLIPS;

pub(super) type State = [f64; LEN];

/// Accelerations of the base: to the right, back, upward.
pub(super) type Line = crate::compliant::stepper::Line<3>;

/// The direction of a slipping spring follows the velocity at most at this rate, in units of the
/// vibration on the cushions: where the spring is short compared with the way that it slides, both
/// agree but for the fiftieth part of a vibration, and the equations would be stiff.
const TURNING: f64 = 50.0;

/// A rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rigid {
    pub(super) mass: f64,
    /// About the principal axes through the centre of gravity.
    pub(super) inertia: Vector,
    /// The centre of gravity when the body is upright above unloaded cushions.
    pub(super) home: Vector,
    /// From the centre of gravity to the base.
    pub(super) cg_height: f64,
    /// 1/m and 1/J: divisions in every evaluation would wait.
    per_mass: f64,
    per_inertia: Vector,
}

impl Rigid {
    /// A body with the base at the height `base_m`.
    pub(super) fn new(mass: f64, gyration_m2: Vector, base_m: f64, cg_height: f64) -> Self {
        let inertia = gyration_m2.map(|square| mass * square);
        Self {
            mass,
            inertia,
            home: [0.0, 0.0, base_m + cg_height],
            cg_height,
            per_mass: 1.0 / mass,
            per_inertia: inertia.map(|inertia| 1.0 / inertia),
        }
    }
}

/// The poses of all bodies.
pub(super) type Poses = [Pose; MAX_BODIES];

/// The kinematics of an element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot {
    /// From the centre of gravity of each body to the point, in floor axes.
    point_arm: Vector,
    face_arm: Vector,
    pub(super) compression: f64,
    pub(super) compression_rate: f64,
    /// Place of the point on the face, from that at rest, and its velocity.
    pub(super) on_face: [f64; 2],
    pub(super) sliding: [f64; 2],
    /// Distance to the end of the face.
    pub(super) to_end: f64,
}

/// Forces of an element, along the axes of the face.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Load {
    pub(super) normal: f64,
    /// The part of it that is not lost.
    elastic: f64,
    pub(super) tangential: [f64; 2],
    /// Cosine and sine of the direction of a sliding spring.
    pub(super) direction: [f64; 2],
}

/// The grips of all elements, sorted by how their forces are calculated.
#[derive(Debug, Clone)]
pub(super) struct Grips {
    each: Vec<Grip>,
    feet: Sorted,
    /// All other elements that carry.
    alone: Vec<usize>,
}

impl Grips {
    pub(super) fn new(world: &World<'_>, each: Vec<Grip>) -> Self {
        let mut grips = Self {
            each,
            feet: Sorted::default(),
            alone: Vec::new(),
        };
        grips.sort(world, 0.0);
        grips
    }

    pub(super) fn each(&self) -> &[Grip] {
        &self.each
    }

    pub(super) fn feet(&self) -> &Sorted {
        &self.feet
    }

    /// The elements that carry, but for feet that stick together.
    pub(super) fn alone(&self) -> &[usize] {
        &self.alone
    }

    /// The elements that slip.
    pub(super) fn slipping(&self) -> impl Iterator<Item = usize> {
        let alone = self.alone.iter().copied();
        alone.filter(|index| self.each[*index] == Grip::Slip)
    }

    /// Gives an element another grip; [`Grips::sort`] comes after all changes.
    pub(super) fn set(&mut self, index: usize, grip: Grip) {
        self.each[index] = grip;
    }

    pub(super) fn sort(&mut self, world: &World<'_>, time_s: f64) {
        self.alone.clear();
        if let Some(feet) = &world.feet {
            feet.sort((&self.each, time_s), &mut self.feet, &mut self.alone);
        }
        let others = self.each.iter().enumerate().skip(world.feet());
        self.alone.extend(
            others
                .filter(|(_, grip)| grip.carries())
                .map(|(index, _)| index),
        );
    }
}

/// The bodies and everything that they touch.
#[derive(Debug, Clone)]
pub(super) struct World<'a> {
    pub(super) bodies: Vec<Rigid>,
    pub(super) elements: Vec<Element<'a>>,
    /// The first elements, where they are feet of a single body in space.
    pub(super) feet: Option<Feet<'a>>,
    pub(super) gravity: f64,
    /// Number of elements that may slip.
    pub(super) slots: usize,
    /// The bodies move in the plane of x and z, exactly: two elements do not hold a body in the
    /// third direction, where rounding would grow.
    pub(super) is_planar: bool,
    /// 1/ω of the fastest vibration on the cushions.
    pub(super) unit_s: f64,
}

/// The two axes of a face.
fn along(normal: usize) -> [usize; 2] {
    match normal {
        0 => [1, 2],
        1 => [2, 0],
        _ => [0, 1],
    }
}

impl<'a> World<'a> {
    pub(super) fn new(
        bodies: Vec<Rigid>,
        elements: Vec<Element<'a>>,
        gravity: f64,
        is_planar: bool,
    ) -> Self {
        let units = elements
            .iter()
            .map(|element| (element.unit_m / gravity).sqrt());
        let unit_s = units.fold(f64::INFINITY, f64::min);
        let slots = elements
            .iter()
            .filter(|element| element.friction.is_some())
            .map(|element| element.slot + 1);
        let slots = slots.fold(0, usize::max);
        Self {
            bodies,
            elements,
            feet: None,
            gravity,
            slots,
            is_planar,
            unit_s,
        }
    }

    /// Number of feet among the elements.
    pub(super) fn feet(&self) -> usize {
        self.feet.as_ref().map_or(0, Feet::len)
    }

    /// Number of entries of the state in use.
    pub(super) fn len(&self) -> usize {
        self.behind() + DIRECTION + self.slots
    }

    /// Index of the first entry behind the bodies.
    pub(super) fn behind(&self) -> usize {
        BODY * self.bodies.len()
    }

    /// Index of the first direction of a stretch.
    pub(super) fn directions(&self) -> usize {
        self.behind() + DIRECTION
    }

    /// Index of the direction of an element's stretch.
    pub(super) fn direction(&self, element: &Element) -> usize {
        self.directions() + element.slot
    }

    /// The state upright above unloaded cushions.
    pub(super) fn upright(&self) -> State {
        let mut y = [0.0; LEN];
        for body in 0..self.bodies.len() {
            y[BODY * body + TURN] = 1.0;
        }
        y
    }

    #[inline]
    pub(super) fn poses(&self, y: &State) -> Poses {
        self.poses_with(Pose::at(y), y)
    }

    /// [`World::poses`] with that of the first body known.
    #[inline]
    fn poses_with(&self, lower: Pose, y: &State) -> Poses {
        let upper = if self.bodies.len() == MAX_BODIES {
            Pose::at(&y[BODY..])
        } else {
            Pose::STILL
        };
        [lower, upper]
    }

    /// The poses at a share of a step.
    pub(super) fn poses_in(&self, step: &Step<LEN>, share: f64) -> Poses {
        let of = |body: usize| Pose::at(&step.entries::<BODY>(BODY * body, share));
        let upper = if self.bodies.len() == MAX_BODIES {
            of(1)
        } else {
            Pose::STILL
        };
        [of(0), upper]
    }

    pub(super) fn foot(&self, element: &Element, poses: &Poses) -> Foot {
        let (shift, velocity, point_arm, gap) = match element.point_of {
            Some(body) => {
                let pose = &poses[body];
                let (point, gap) = element.pressed(pose);
                let by_turn = moved(&pose.shift, &point);
                let arm = sum(&point, &by_turn);
                (
                    sum(&pose.place, &by_turn),
                    sum(&pose.velocity, &cross(&pose.omega, &arm)),
                    arm,
                    gap,
                )
            }
            None => ([0.0; 3], [0.0; 3], [0.0; 3], element.gap),
        };
        let (place, rate, face_arm, from_cg) = match element.face_of {
            None => (shift, velocity, [0.0; 3], [0.0; 3]),
            Some(body) => {
                let home = element
                    .point_of
                    .map_or([0.0; 3], |body| self.bodies[body].home);
                let start = sum(&home, &element.point);
                let pose = &poses[body];
                let from_cg = difference(&start, &self.bodies[body].home);
                let shift = difference(&shift, &pose.place);
                let arm = sum(&from_cg, &shift);
                let velocity = difference(
                    &difference(&velocity, &pose.velocity),
                    &cross(&pose.omega, &arm),
                );
                let place = sum(&shift, &moved_back(&pose.shift, &arm));
                (place, turned_back(&pose.shift, &velocity), arm, from_cg)
            }
        };
        let [a, b] = along(element.normal);
        Foot {
            point_arm,
            face_arm,
            compression: -(gap + element.sign * place[element.normal]),
            compression_rate: -element.sign * rate[element.normal],
            on_face: [place[a], place[b]],
            sliding: [rate[a], rate[b]],
            to_end: element.end.map_or(f64::INFINITY, |(axis, end)| {
                end - (from_cg[axis] + place[axis]).abs()
            }),
        }
    }

    /// The compression of an element alone.
    pub(super) fn compression(&self, element: &Element, poses: &Poses) -> f64 {
        match (element.point_of, element.face_of) {
            (Some(body), None) => {
                let (pose, axis) = (&poses[body], element.normal);
                let (point, gap) = element.pressed(pose);
                -(gap + element.sign * (pose.place[axis] + dot(&pose.shift[axis], &point)))
            }
            _ => self.foot(element, poses).compression,
        }
    }

    pub(super) fn load(&self, element: &Element, grip: Grip, foot: &Foot, y: &State) -> Load {
        if !grip.carries() {
            return Load::default();
        }
        let [normal, elastic] = element
            .pad
            .push_and_elastic(foot.compression, foot.compression_rate);
        let (tangential, direction) = match grip {
            Grip::Slip => {
                let (sin, cos) = y[self.direction(element)].sin_cos();
                let force = element.friction.unwrap_or(0.0) * normal;
                ([-force * cos, -force * sin], [cos, sin])
            }
            Grip::Stick { anchor } => {
                let k = element.tangential_stiffness;
                (
                    [
                        -k * (foot.on_face[0] - anchor[0]),
                        -k * (foot.on_face[1] - anchor[1]),
                    ],
                    [0.0; 2],
                )
            }
            Grip::Open { .. } | Grip::Gone => ([0.0; 2], [0.0; 2]),
        };
        Load {
            normal,
            elastic,
            tangential,
            direction,
        }
    }

    /// The time derivative of the state.
    pub(super) fn rates(&self, grips: &Grips, line: &Line, time_s: f64, y: &State) -> State {
        let mut rates = [0.0; LEN];
        self.enter_rates(grips, line, (time_s, y), &mut rates);
        rates
    }

    /// [`World::rates`] into a state of which only what is in use may differ from zero.
    pub(super) fn enter_rates(
        &self,
        grips: &Grips,
        line: &Line,
        (time_s, y): (f64, &State),
        rates: &mut State,
    ) {
        rates[self.behind()..self.len()].fill(0.0);
        let lower = Pose::at(y);
        let mut push = Push::default();
        if let Some(feet) = self.feet.as_ref().filter(|_| !grips.feet.sums.is_empty()) {
            push = feet.push(&grips.feet.sums, &lower);
            rates[self.behind() + DASHPOT] = push.dissipated_w;
        }
        let shaking = line.at(time_s);
        if grips.alone.is_empty() && self.bodies.len() == 1 {
            // Most steps: no pose or force goes through the memory.
            self.enter_body(0, (push.force, push.torque), (y, &lower), shaking, rates);
            return;
        }
        let poses = self.poses_with(lower, y);
        let (mut forces, mut torques) = ([push.force, [0.0; 3]], [push.torque, [0.0; 3]]);
        let behind = self.behind();
        for &index in &grips.alone {
            let (element, grip) = (&self.elements[index], grips.each[index]);
            let foot = self.foot(element, &poses);
            let load = self.load(element, grip, &foot, y);
            let force = self.force_on_point(element, &load, &poses);
            if let Some(body) = element.point_of {
                forces[body] = sum(&forces[body], &force);
                torques[body] = sum(&torques[body], &cross(&foot.point_arm, &force));
            }
            if let Some(body) = element.face_of {
                forces[body] = difference(&forces[body], &force);
                torques[body] = difference(&torques[body], &cross(&foot.face_arm, &force));
            }
            if element.pad.is_damped() {
                rates[behind + DASHPOT] += (load.normal - load.elastic) * foot.compression_rate;
            }
            if grip == Grip::Slip {
                let [t, s] = [load.tangential, foot.sliding];
                rates[behind + SLIP] -= t[0] * s[0] + t[1] * s[1];
                let direction = self.direction(element);
                rates[direction] = self.veering(element, &foot, &load);
            }
        }
        for index in 0..self.bodies.len() {
            let load = (forces[index], torques[index]);
            self.enter_body(index, load, (y, &poses[index]), shaking, rates);
        }
    }

    /// The rates of a body with this force and torque in floor axes.
    #[inline(always)]
    fn enter_body(
        &self,
        index: usize,
        (mut force, mut torque): (Vector, Vector),
        (y, pose): (&State, &Pose),
        shaking: Vector,
        rates: &mut State,
    ) {
        let (at, body) = (BODY * index, &self.bodies[index]);
        if self.is_planar {
            force[1] = 0.0;
            (torque[0], torque[2]) = (0.0, 0.0);
        }
        let spin = vector(y, at + SPIN);
        let torque = turned_back(&pose.shift, &torque);
        let [a, b, c] = body.inertia;
        let gyroscopic = cross(&spin, &[a * spin[0], b * spin[1], c * spin[2]]);
        let (per_mass, per_inertia) = (body.per_mass, body.per_inertia);
        let fallen = [shaking[0], shaking[1], self.gravity + shaking[2]];
        for axis in 0..3 {
            rates[at + PLACE + axis] = pose.velocity[axis];
            rates[at + VELOCITY + axis] = force[axis] * per_mass - fallen[axis];
            rates[at + SPIN + axis] = (torque[axis] - gyroscopic[axis]) * per_inertia[axis];
        }
        rates[at + TURN..at + TURN + 4].copy_from_slice(&turning(&pose.turn, &spin));
        rates[self.behind() + WORK] -= body.mass * dot(&shaking, &pose.velocity);
    }

    /// The force on the body with the point, in floor axes.
    fn force_on_point(&self, element: &Element, load: &Load, poses: &Poses) -> Vector {
        let [a, b] = along(element.normal);
        let mut force = [0.0; 3];
        (force[a], force[b]) = (load.tangential[0], load.tangential[1]);
        force[element.normal] = element.sign * load.normal;
        match element.face_of {
            None => force,
            Some(body) => turned(&poses[body].shift, &force),
        }
    }

    /// Rate at which the stretch of a sliding spring turns: σ̇ = v − λσ̂ turns σ, whose length is
    /// μN/k_t, with the velocity across it.
    fn veering(&self, element: &Element, foot: &Foot, load: &Load) -> f64 {
        let [cos, sin] = load.direction;
        let across = cos * foot.sliding[1] - sin * foot.sliding[0];
        let friction = element.friction.unwrap_or(0.0);
        if across == 0.0 || friction == 0.0 {
            return 0.0;
        }
        let length = friction * load.normal.abs() / element.tangential_stiffness;
        let [a, b] = foot.sliding;
        let length = length.max((a * a + b * b).sqrt() * self.unit_s / TURNING);
        across / length
    }

    /// λ: the velocity at which the foot of a sliding spring slides along its stretch. The spring
    /// sticks when it is negative. A damped law needs the rates of the state.
    pub(super) fn slipping(
        &self,
        element: &Element,
        poses: &Poses,
        (foot, load): (&Foot, &Load),
        rates: Option<&State>,
    ) -> f64 {
        let [cos, sin] = load.direction;
        let along = cos * foot.sliding[0] + sin * foot.sliding[1];
        let pressing = rates.map_or(0.0, |rates| self.pressing(element, foot, poses, rates));
        let normal_rate = element
            .pad
            .push_rate(foot.compression, foot.compression_rate, pressing);
        along - element.friction.unwrap_or(0.0) * normal_rate / element.tangential_stiffness
    }

    /// The second derivative of the compression of an element.
    pub(super) fn pressing(
        &self,
        element: &Element,
        foot: &Foot,
        poses: &Poses,
        rates: &State,
    ) -> f64 {
        // Acceleration of a body's point at an arm from its centre of gravity.
        let linear = |body: usize| vector(rates, BODY * body + VELOCITY);
        let angular = |body: usize| turned(&poses[body].shift, &vector(rates, BODY * body + SPIN));
        let point = element.point_of.map_or([0.0; 3], |body| {
            let omega = &poses[body].omega;
            let inward = cross(omega, &cross(omega, &foot.point_arm));
            sum(
                &linear(body),
                &sum(&cross(&angular(body), &foot.point_arm), &inward),
            )
        });
        let Some(body) = element.face_of else {
            return -element.sign * point[element.normal];
        };
        let (pose, arm) = (&poses[body], &foot.face_arm);
        let velocity = element.point_of.map_or([0.0; 3], |other| {
            sum(
                &poses[other].velocity,
                &cross(&poses[other].omega, &foot.point_arm),
            )
        });
        let nearing = difference(&velocity, &pose.velocity);
        let slow = difference(&nearing, &cross(&pose.omega, arm));
        let relative = difference(
            &difference(&point, &linear(body)),
            &cross(&angular(body), arm),
        );
        let relative = difference(&relative, &cross(&pose.omega, &nearing));
        // The axes of the face turn as well.
        let relative = difference(&relative, &cross(&pose.omega, &slow));
        -element.sign * turned_back(&pose.shift, &relative)[element.normal]
    }

    /// Where the energy is.
    pub(super) fn energies(&self, grips: &Grips, y: &State, poses: &Poses) -> Energies {
        let (mut kinetic_j, mut potential_j) = (0.0, 0.0);
        for (body, y) in self.bodies.iter().zip(y.chunks_exact(BODY)) {
            let (velocity, spin) = (vector(y, VELOCITY), vector(y, SPIN));
            kinetic_j += 0.5 * body.mass * dot(&velocity, &velocity);
            kinetic_j += 0.5
                * (0..3)
                    .map(|axis| body.inertia[axis] * spin[axis] * spin[axis])
                    .sum::<f64>();
            potential_j += body.mass * self.gravity * y[PLACE + 2];
        }
        let stored = |&index: &usize| {
            let (element, grip) = (&self.elements[index], grips.each[index]);
            // The energy of a slipping spring is counted with the slip.
            if grip == Grip::Slip {
                return element.pad.pressed_j(self.compression(element, poses));
            }
            let foot = self.foot(element, poses);
            element.pad.pressed_j(foot.compression) + self.sheared_j(element, grip, &foot, y)
        };
        let of_feet_j = self
            .feet
            .as_ref()
            .map_or(0.0, |feet| feet.stored_j(&grips.feet.sums, &poses[0]));
        let behind = self.behind();
        Energies {
            kinetic_j,
            potential_j,
            stored_j: of_feet_j + grips.alone.iter().map(stored).sum::<f64>(),
            base_work_j: y[behind + WORK],
            cushion_dissipation_j: y[behind + DASHPOT],
            tangential_dissipation_j: 0.0,
            friction_j: y[behind + SLIP],
        }
    }

    /// Energy in the tangential spring of an element.
    pub(super) fn sheared_j(&self, element: &Element, grip: Grip, foot: &Foot, y: &State) -> f64 {
        let [a, b] = self.load(element, grip, foot, y).tangential;
        if element.tangential_stiffness > 0.0 {
            0.5 * (a * a + b * b) / element.tangential_stiffness
        } else {
            0.0
        }
    }
}
