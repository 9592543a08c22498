//! The solver: it follows the bodies from step to step and from event to event.

use super::element::{Element, Grip, Role};
use super::equation::{Foot, Grips, LEN, Line, Poses, SLIP, State, World};
use super::pose::{BODY, PLACE, Pose, SPIN, TURN, VELOCITY};
use super::seen::Seen;
use super::track::{BodyMotion, Track};
use super::{Fallen, SpatialOptions, SpatialPiece};
use crate::compliant::pad::between_kinks;
use crate::compliant::step::{BOGACKI_SHAMPINE, Step};
use crate::compliant::stepper::{Found, Trial, next};
use crate::compliant::tail::Tail;
use crate::compliant::{CompliantEffort, CompliantError, EnergyAudit, Ledger, MAX_STEPS, TOUCHING};
use crate::motion::Motion;
use crate::rocking::LONGEST_TAIL_S;

/// The error of a step is a mean over the entries of the state; many of them hardly move. With this
/// share of the tolerance half of the energy balances stay open by less than a third of the tolerance at `fast` (benches/README.md).
const SHARE: f64 = 0.3;

/// How near to an event the interpolating polynomial is searched, and how far past it a step may
/// end, as a margin of the order of 1 and a multiple of the tolerance. A contact that begins or ends
/// ε of the static compression late misses ε² of its energy.
const NEAR: f64 = 2.0;
const PAST: f64 = 10.0;

/// Longest step, as an angle of the vertical vibration on the cushions. Sway and pitch are up to twice as fast: what
/// limits a step in which one of them is visible is its error, a third of a radian at `fast`.
const LONGEST_RAD: f64 = 1.25;

/// A body whose axis has a larger vertical part than this at both ends of a step does not overturn within it.
const UPRIGHT: f64 = 0.1;

/// The error of the direction of a spring that slips counts with its force at the end of the step as a share of the weight,
/// but at least with the share `LIGHT`, and with `KEPT` of that at the start: a foot that presses more again turns its spring soon.
const LIGHT: f64 = 1e-3;
const KEPT: f64 = 0.1;

/// What every history of bodies in space ends with.
pub(super) struct Ended {
    pub(super) end_time_s: f64,
    pub(super) bodies: Vec<BodyMotion>,
    pub(super) track: Track,
    pub(super) fallen: Option<Fallen>,
    /// Whether it ended before it was certain that nothing falls.
    pub(super) is_open: bool,
    pub(super) energy: EnergyAudit,
    pub(super) effort: CompliantEffort,
}

struct Solver<'a, 'b, F> {
    world: &'a World<'b>,
    grips: Grips,
    /// For each element, the two kinks of its law that enclose its compression.
    lines: Vec<(f64, f64)>,
    kinks_m: Vec<Vec<f64>>,
    y: State,
    poses: Poses,
    rates: State,
    time_s: f64,
    try_s: f64,
    unit_s: f64,
    sizes: State,
    tolerance: f64,
    is_resting: bool,
    fallen: Option<Fallen>,
    track: Track,
    ledger: Ledger,
    tail: Tail,
    effort: CompliantEffort,
    observe: F,
}

/// Calculates the motion of the bodies from `start`; `is_at_rest`: nothing moves before the base
/// does.
pub(super) fn follow(
    world: &World<'_>,
    motions: [Option<&Motion>; 3],
    options: &SpatialOptions,
    (start, is_at_rest): (&State, bool),
    observe: &mut dyn FnMut(&SpatialPiece<'_, '_>),
) -> Result<Ended, CompliantError> {
    if Line::mismatch(motions) {
        return Err(CompliantError::VerticalMismatch);
    }
    let given = motions.into_iter().flatten().next();
    let settled_s = || given.map(|motion| motion.duration_s() + LONGEST_TAIL_S);
    let end_s = options.duration_s.or_else(settled_s).unwrap_or(0.0);
    if !(end_s > 0.0 && end_s.is_finite()) {
        return Err(CompliantError::Duration { duration_s: end_s });
    }
    let mut solver = Solver::new(world, options, start, observe);
    let samples = given.map_or(0, |motion| motion.accel_m_s2().len());
    let mut step = Step::new(start, world.len(), &BOGACKI_SHAMPINE);
    let mut index = 0;
    while solver.time_s < end_s && solver.fallen.is_none() && !solver.tail.is_over {
        let (line, until_s) = Line::of(motions, index, end_s);
        if index >= samples {
            solver.tail.begin();
        }
        if line.is_still() && solver.is_resting && is_at_rest {
            // Nothing has moved it, and nothing will.
            if index >= samples && options.duration_s.is_none() {
                break;
            }
            solver.time_s = until_s;
        } else {
            if solver.is_resting {
                solver.rates = world.rates(&solver.grips, &line, solver.time_s, &solver.y);
                solver.is_resting = false;
            }
            solver.pass(&mut step, &line, until_s)?;
        }
        index += 1;
    }
    Ok(solver.finish())
}

impl<'a, 'b, F: FnMut(&SpatialPiece<'_, '_>)> Solver<'a, 'b, F> {
    fn new(world: &'a World<'b>, options: &SpatialOptions, start: &State, observe: F) -> Self {
        let unit_s = world.unit_s;
        let poses = world.poses(start);
        let grips = Grips::new(world, grips_at(world, &poses));
        let rest_j = world
            .elements
            .iter()
            .filter(|element| element.role != Role::Wall);
        let rest_j = rest_j
            .map(|element| 0.5 * element.weight_n * element.unit_m)
            .fold(0.0, f64::max);
        let mut solver = Self {
            world,
            lines: vec![(f64::NEG_INFINITY, f64::INFINITY); world.elements.len()],
            kinks_m: world
                .elements
                .iter()
                .map(|element| element.pad.cushion.law().kinks_m())
                .collect(),
            y: *start,
            poses,
            rates: *start,
            time_s: 0.0,
            try_s: 0.1 * unit_s,
            unit_s,
            sizes: sizes(world, unit_s),
            tolerance: SHARE * options.accuracy.tolerance(),
            is_resting: true,
            fallen: None,
            track: Track::new(world, start),
            ledger: Ledger::open(2.0 * rest_j, &world.energies(&grips, start, &poses)),
            tail: tail(world, 2.0 * rest_j, options.duration_s.is_none()),
            effort: CompliantEffort::default(),
            grips,
            observe,
        };
        (0..world.elements.len()).for_each(|index| solver.place_between_kinks(index));
        solver
    }

    /// Calculates one straight segment of the motion. The acceleration of the base has no steps: the rates at its start
    /// are those at the end of the one before.
    fn pass(
        &mut self,
        step: &mut Step<LEN>,
        line: &Line,
        until_s: f64,
    ) -> Result<(), CompliantError> {
        while self.time_s < until_s && self.fallen.is_none() && !self.tail.is_over {
            let rest_s = until_s - self.time_s;
            if rest_s <= 4.0 * f64::EPSILON * until_s {
                break;
            }
            let found = self.next(step, line, rest_s)?;
            let is_last = step.length_s == rest_s;
            // A step that a sample cut short, whether or not an event came first, tells of no shorter one.
            self.try_s = if found.reached_kink {
                found.grow_s.max(self.try_s)
            } else {
                found.grow_s
            };
            self.accept(line, step, found.has_event)?;
            if is_last {
                self.time_s = until_s;
            }
            if self.effort.steps > MAX_STEPS {
                return Err(CompliantError::TooManySteps {
                    time_s: self.time_s,
                    limit: MAX_STEPS,
                });
            }
        }
        if self.fallen.is_none() && !self.tail.is_over {
            self.time_s = until_s;
        }
        Ok(())
    }

    /// Takes the step of this length from the present state; returns its error ratio.
    fn take(&self, step: &mut Step<LEN>, line: &Line, length_s: f64) -> f64 {
        let rates = |time_s: f64, y: &State, rates: &mut State| {
            self.world
                .enter_rates(&self.grips, line, (time_s, y), rates);
        };
        step.take(rates, self.time_s, (&self.y, &self.rates), length_s);
        let mut slipping = self.grips.slipping().peekable();
        if slipping.peek().is_none() {
            return step.error_ratio(&self.sizes, self.tolerance);
        }
        let (mut sizes, ends) = (self.sizes, [self.poses, self.world.poses(&step.end)]);
        for index in slipping {
            let element = &self.world.elements[index];
            let force_n = |poses: &Poses| {
                let foot = self.world.foot(element, poses);
                element.pad.push(foot.compression, foot.compression_rate)
            };
            let most_n = (KEPT * force_n(&ends[0])).max(force_n(&ends[1]));
            let share = (most_n / element.weight_n).clamp(LIGHT, 1.0);
            sizes[self.world.direction(element)] /= share;
        }
        step.error_ratio(&sizes, self.tolerance)
    }

    /// Takes the next step.
    fn next(
        &mut self,
        step: &mut Step<LEN>,
        line: &Line,
        rest_s: f64,
    ) -> Result<Found, CompliantError> {
        let mut effort = self.effort;
        let trial = Trial {
            start_s: self.time_s,
            try_s: self.try_s,
            longest_s: LONGEST_RAD * self.unit_s,
            rest_s,
            unit_s: self.unit_s,
            near: Some(NEAR * self.tolerance),
            close: PAST * self.tolerance,
        };
        let take = |step: &mut Step<LEN>, length_s: f64| self.take(step, line, length_s);
        let margin = |time_s: f64, y: &State, most: f64| self.least_margin(line, (time_s, y), most);
        let may_have_event = |step: &Step<LEN>| self.may_have_event(step);
        let found = next(step, trial, take, may_have_event, margin, &mut effort)?;
        self.effort = effort;
        Ok(found)
    }

    fn accept(
        &mut self,
        line: &Line,
        step: &mut Step<LEN>,
        has_event: bool,
    ) -> Result<(), CompliantError> {
        self.effort.steps += 1;
        // The rates at the end are not recalculated: normalising the rotation changes them by about the tolerance.
        for body in 0..self.world.bodies.len() {
            let turn = &mut step.end[BODY * body + TURN..BODY * body + SPIN];
            let length = turn.iter().map(|part| part * part).sum::<f64>().sqrt();
            turn.iter_mut().for_each(|part| *part /= length);
        }
        let poses = self.world.poses(&step.end);
        if !poses[0].place[2].is_finite() {
            return Err(CompliantError::NotFinite {
                time_s: step.start_s,
            });
        }
        let seen = Seen {
            world: self.world,
            grips: &self.grips,
            step,
            ends: [&self.poses, &poses],
        };
        self.track.read(&seen, line);
        (self.observe)(&SpatialPiece { seen });
        let used = self.world.len();
        self.y[..used].copy_from_slice(&step.end[..used]);
        self.rates[..used].copy_from_slice(&step.end_rates()[..used]);
        self.time_s = step.start_s + step.length_s;
        self.poses = poses;
        if has_event {
            let past = self.past(line, &poses);
            for &index in &past {
                self.change(index, &poses);
            }
            if !past.is_empty() {
                self.grips.sort(self.world, self.time_s);
                let slipping = self.grips.slipping();
                let directions =
                    slipping.map(|index| self.world.direction(&self.world.elements[index]));
                step.change_only(self.world.directions(), directions);
                self.rates = self.world.rates(&self.grips, line, self.time_s, &self.y);
            }
            if let Some(body) =
                (0..self.world.bodies.len()).find(|&body| poses[body].upright() <= 0.0)
            {
                self.fallen = Some(Fallen {
                    body,
                    time_s: self.time_s,
                    slid_off: false,
                });
            }
        }
        self.ledger
            .enter(&self.world.energies(&self.grips, &self.y, &poses));
        let mut tail = self.tail;
        tail.step(self.time_s, &self.ledger, || self.is_held());
        self.tail = tail;
        Ok(())
    }

    /// Whether every foot carries its body, or a wall holds one above its centre of gravity.
    fn is_held(&self) -> bool {
        let mut both = self.world.elements.iter().zip(self.grips.each());
        let holds = |element: &Element<'_>| element.role == Role::Wall && element.point[2] > 0.0;
        let is_at_wall = both.any(|(element, grip)| holds(element) && grip.carries());
        let mut both = self.world.elements.iter().zip(self.grips.each());
        is_at_wall || both.all(|(element, grip)| element.role == Role::Wall || grip.carries())
    }

    /// How far an element is from its next event, of the order of 1; negative past it.
    fn margin(
        &self,
        index: usize,
        time_s: f64,
        poses: &Poses,
        (y, rates): (&State, Option<&State>),
    ) -> f64 {
        let (element, grip) = (&self.world.elements[index], self.grips.each()[index]);
        if grip == Grip::Gone {
            return 1.0;
        }
        if let Grip::Open {
            since_s,
            compression_m,
        } = grip
        {
            let surface_m = element.pad.surface(since_s, compression_m, time_s);
            return (surface_m - self.world.compression(element, poses)) / element.unit_m;
        }
        let foot = self.world.foot(element, poses);
        let load = self.world.load(element, grip, &foot, y);
        let pushes = element.pad.pushes(
            foot.compression,
            load.normal,
            (element.unit_m, element.weight_n),
        );
        let (low, high) = self.lines[index];
        let between = (foot.compression - low)
            .min(high - foot.compression)
            .min(foot.to_end)
            / element.unit_m;
        let margin = pushes.min(between);
        let Some(friction) = element.friction else {
            return margin;
        };
        if grip == Grip::Slip {
            let slipping = self.world.slipping(element, poses, (&foot, &load), rates);
            margin.min(slipping * self.unit_s / element.unit_m)
        } else {
            margin.min((friction * load.normal - length(load.tangential)) / element.weight_n)
        }
    }

    /// The rates that the margins of slipping elements need, if any does.
    fn rates_of_slip(&self, line: &Line, time_s: f64, y: &State) -> Option<State> {
        let is_damped = |index: usize| self.world.elements[index].pad.is_damped();
        let is_needed = self.grips.slipping().any(is_damped);
        is_needed.then(|| self.world.rates(&self.grips, line, time_s, y))
    }

    /// Whether a step may have an event: not if all feet are far from theirs, there is nothing else, and the body is
    /// not about to overturn.
    fn may_have_event(&self, step: &Step<LEN>) -> bool {
        let Some(feet) = self
            .world
            .feet
            .as_ref()
            .filter(|feet| feet.len() == self.world.elements.len())
        else {
            return true;
        };
        let end = Pose::at(&step.end);
        let is_upright = self.poses[0].upright().min(end.upright()) > UPRIGHT;
        let ends = [
            (&self.poses[0], &step.start_rates()[..]),
            (&end, &step.end_rates()[..]),
        ];
        let times = (step.start_s + step.length_s, step.length_s);
        !(is_upright && feet.stay(self.grips.feet(), ends, times))
    }

    /// The smallest of all margins, or `most`; overturning counts as one of them.
    fn least_margin(&self, line: &Line, (time_s, y): (f64, &State), most: f64) -> f64 {
        let poses = self.world.poses(y);
        let rates = self.rates_of_slip(line, time_s, y);
        let of = |index: usize| self.margin(index, time_s, &poses, (y, rates.as_ref()));
        let bodies = poses
            .iter()
            .take(self.world.bodies.len())
            .map(|pose| pose.upright());
        let others = (self.world.feet()..self.world.elements.len()).map(of);
        let least = bodies.chain(others).fold(most, f64::min);
        let Some(feet) = &self.world.feet else {
            return least;
        };
        let grips = (self.grips.feet(), self.grips.alone());
        feet.margin(grips, (time_s, &poses[0]), least, of)
    }

    /// The elements that are past their event.
    fn past(&self, line: &Line, poses: &Poses) -> Vec<usize> {
        let rates = self.rates_of_slip(line, self.time_s, &self.y);
        let of = |index: usize| self.margin(index, self.time_s, poses, (&self.y, rates.as_ref()));
        let feet = self.world.feet.as_ref();
        let near = feet.map(|feet| feet.near(self.grips.each(), (self.time_s, &poses[0])));
        let others = self.world.feet()..self.world.elements.len();
        let near = near.into_iter().flatten().chain(others);
        near.filter(|&index| of(index) < 0.0).collect()
    }

    /// Changes an element that is past its event.
    fn change(&mut self, index: usize, poses: &Poses) {
        self.effort.events += 1;
        let (element, grip) = (&self.world.elements[index], self.grips.each()[index]);
        let foot = self.world.foot(element, poses);
        if let Grip::Open { .. } = grip {
            if foot.to_end < 0.0 {
                self.lose(index);
            } else {
                self.touch(index, &foot);
            }
            return;
        }
        let normal_n = element.pad.push(foot.compression, foot.compression_rate);
        let (low, high) = self.lines[index];
        if element.pad.is_over(foot.compression, normal_n) {
            self.leave(index, &foot);
        } else if foot.to_end < 0.0 {
            self.leave(index, &foot);
            self.lose(index);
        } else if foot.compression < low || foot.compression > high {
            self.place_between_kinks(index);
        } else {
            self.turn(index, &foot);
        }
    }

    /// Begins a contact; the energy that its cushion holds is taken back from the losses.
    fn touch(&mut self, index: usize, foot: &Foot) {
        let element = &self.world.elements[index];
        self.ledger.lose(-element.pad.pressed_j(foot.compression));
        self.grips.set(
            index,
            Grip::Stick {
                anchor: foot.on_face,
            },
        );
        self.place_between_kinks(index);
        self.track
            .touch(index, element.role, self.time_s, foot.compression_rate);
        let Some(friction) = element.friction else {
            return;
        };
        let normal_n = element.pad.push(foot.compression, foot.compression_rate);
        // The spring is not stretched yet. At the first contact without dashpots both forces are
        // zero, and their rates decide.
        if normal_n <= TOUCHING * element.weight_n {
            let rate = element
                .pad
                .push_rate(foot.compression.max(0.0), foot.compression_rate, 0.0);
            let speed = length(foot.sliding);
            if element.tangential_stiffness * speed > friction * rate {
                self.grips.set(index, Grip::Slip);
                self.y[self.world.direction(element)] = foot.sliding[1].atan2(foot.sliding[0]);
            }
        }
    }

    /// Ends a contact; the energy in its springs is lost to the bodies.
    fn leave(&mut self, index: usize, foot: &Foot) {
        let element = &self.world.elements[index];
        self.track
            .landings
            .leave(index, self.time_s, foot.compression_rate);
        let sheared_j = self
            .world
            .sheared_j(element, self.grips.each()[index], foot, &self.y);
        if self.grips.each()[index] == Grip::Slip {
            self.y[self.world.behind() + SLIP] -= sheared_j;
        }
        self.ledger
            .lose(element.pad.pressed_j(foot.compression) + sheared_j);
        self.grips.set(
            index,
            Grip::Open {
                since_s: self.time_s,
                compression_m: foot.compression.max(0.0),
            },
        );
    }

    /// The point of an element has passed the end of the face; a body without any other support
    /// falls.
    fn lose(&mut self, index: usize) {
        self.grips.set(index, Grip::Gone);
        let role = self.world.elements[index].role;
        let same = self
            .world
            .elements
            .iter()
            .zip(self.grips.each())
            .filter(|(element, _)| element.role == role);
        if role == Role::Interface && same.into_iter().all(|(_, grip)| *grip == Grip::Gone) {
            let body = self.world.bodies.len() - 1;
            self.fallen = Some(Fallen {
                body,
                time_s: self.time_s,
                slid_off: true,
            });
        }
    }

    /// Begins or ends a slip. The energy of the spring is counted with the slip in between.
    fn turn(&mut self, index: usize, foot: &Foot) {
        let element = &self.world.elements[index];
        let (grip, slip) = (self.grips.each()[index], self.world.behind() + SLIP);
        let sheared_j = self.world.sheared_j(element, grip, foot, &self.y);
        let [a, b] = self.world.load(element, grip, foot, &self.y).tangential;
        if grip == Grip::Slip {
            self.y[slip] -= sheared_j;
            let k = element.tangential_stiffness;
            self.grips.set(
                index,
                Grip::Stick {
                    anchor: [foot.on_face[0] + a / k, foot.on_face[1] + b / k],
                },
            );
        } else {
            self.y[slip] += sheared_j;
            self.y[self.world.direction(element)] = (-b).atan2(-a);
            self.grips.set(index, Grip::Slip);
        }
    }

    fn place_between_kinks(&mut self, index: usize) {
        let foot = self
            .world
            .foot(&self.world.elements[index], &self.world.poses(&self.y));
        self.lines[index] = between_kinks(&self.kinks_m[index], foot.compression);
    }

    fn finish(self) -> Ended {
        let is_open = self.tail.is_open(&self.ledger);
        Ended {
            end_time_s: self.time_s,
            bodies: self.track.finish(self.world, &self.y, self.fallen),
            track: self.track,
            fallen: self.fallen,
            is_open,
            energy: self.ledger.close(),
            effort: self.effort,
        }
    }
}

/// The elements of bodies that start in a place: contacts carry load without stretch.
fn grips_at(world: &World<'_>, poses: &Poses) -> Vec<Grip> {
    let grip = |element| {
        let foot = world.foot(element, poses);
        if foot.compression > 0.0 {
            Grip::Stick {
                anchor: foot.on_face,
            }
        } else {
            Grip::UNTOUCHED
        }
    };
    world.elements.iter().map(grip).collect()
}

/// The end of a history after the motion. The balance point of a body is that about the nearest edge of
/// its base.
fn tail(world: &World<'_>, rest_j: f64, ends: bool) -> Tail {
    let rest = world.at_rest();
    let poses = world.poses(&rest);
    let grips = Grips::new(world, grips_at(world, &poses));
    let stands = world.energies(&grips, &rest, &poses);
    let balance_j = world.bodies.iter().enumerate().map(|(index, body)| {
        let own = world
            .elements
            .iter()
            .filter(|one| one.role != Role::Wall && one.point_of == Some(index));
        let reach = |axis: usize| {
            own.clone()
                .map(|one| one.point[axis].abs())
                .fold(0.0, f64::max)
        };
        let nearest = [0, 1]
            .map(reach)
            .into_iter()
            .filter(|reach| *reach > 0.0)
            .fold(f64::INFINITY, f64::min);
        body.mass * world.gravity * (nearest.hypot(body.cg_height) - body.cg_height)
    });
    Tail::new(
        rest_j,
        stands.potential_j + stands.stored_j,
        balance_j.fold(f64::INFINITY, f64::min),
        ends,
    )
}

fn length([a, b]: [f64; 2]) -> f64 {
    (a * a + b * b).sqrt()
}

/// The size of each entry of the state: what the weight alone does on the cushions.
fn sizes(world: &World<'_>, unit_s: f64) -> State {
    // A direction counts as much as the weight.
    let mut sizes = [1.0; LEN];
    let (mut most_j, behind) = (0.0f64, world.behind());
    for (index, body) in world.bodies.iter().enumerate() {
        let own = |element: &&Element<'_>| {
            element.role != Role::Wall && [element.point_of, element.face_of].contains(&Some(index))
        };
        let elements = || world.elements.iter().filter(own);
        let unit_m = elements()
            .map(|element| element.unit_m)
            .fold(f64::INFINITY, f64::min);
        let reach = elements()
            .flat_map(|element| [element.point[0].abs(), element.point[1].abs()])
            .fold(0.0, f64::max);
        let width = 2.0 * reach;
        most_j = most_j.max(body.mass * world.gravity * unit_m);
        for axis in 0..3 {
            sizes[BODY * index + PLACE + axis] = unit_m;
            sizes[BODY * index + VELOCITY + axis] = unit_m / unit_s;
            sizes[BODY * index + SPIN + axis] = unit_m / width / unit_s;
        }
        sizes[BODY * index + TURN..BODY * index + SPIN].fill(0.5 * unit_m / width);
    }
    sizes[behind..behind + SLIP + 1].fill(most_j);
    sizes
}
