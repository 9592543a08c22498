//! The quantities that a history in space reports, collected step by step.

use std::f64::consts::FRAC_PI_2;

use super::Fallen;
use super::element::{Element, Role};
use super::equation::{Line, Poses, State, World};
use super::landings::Landings;
use super::pose::{BODY, Pose, TURN};
use super::seen::{Pattern, Seen, tilts};
use crate::compliant::{HEADROOM, raise};
use crate::rocking::Outcome;
use crate::search::bisect;
use crate::space::Vector;

/// What one body did. Tilts are angles of its axis to the vertical; `tilt_x` and `tilt_y` are those
/// of the projections of the axis, positive to the right and to the back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// How the history ended for this body; `NoUplift` if no point of its base rose above its
    /// unloaded cushion.
    pub outcome: Outcome,
    /// Largest tilt \[rad\]; π/2 when overturned.
    pub peak_tilt_rad: f64,
    /// Its time \[s\].
    pub peak_tilt_time_s: f64,
    /// The largest `tilt_x` by magnitude, with its sign \[rad\].
    pub peak_tilt_x_rad: f64,
    /// The largest `tilt_y` by magnitude, with its sign \[rad\].
    pub peak_tilt_y_rad: f64,
    /// `tilt_x` at the end \[rad\].
    pub final_tilt_x_rad: f64,
    /// `tilt_y` at the end \[rad\].
    pub final_tilt_y_rad: f64,
    /// Yaw at the end: the twist of the swing-twist decomposition, 2 atan2(q_z, q_w) \[rad\].
    pub yaw_rad: f64,
    /// Largest horizontal displacement of the centre of the base \[m\].
    pub base_slide_peak_m: f64,
    /// The same at the end \[m\].
    pub base_slide_final_m: f64,
    /// Largest height of a point of the base above its unloaded cushion \[m\].
    pub uplift_m: f64,
    /// Time at which a point of the base was first above its unloaded cushion \[s\].
    pub first_uplift_time_s: Option<f64>,
    /// Time at which the tilt reached π/2, or at which the body slid off its support \[s\].
    pub overturn_time_s: Option<f64>,
}

/// How long a stack moved in each of its patterns, as shares of the time (Psycharis 1990): they add
/// up to 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Patterns {
    /// Neither body has an edge off its support.
    pub rest_ratio: f64,
    /// Both rock, about edges on the same side.
    pub same_ratio: f64,
    /// Both rock, about edges on opposite sides.
    pub opposite_ratio: f64,
    /// The lower body rocks and carries the upper one along: one body.
    pub together_ratio: f64,
    /// The upper body rocks alone.
    pub upper_alone_ratio: f64,
}

pub(super) fn yaw(turn: &[f64]) -> f64 {
    2.0 * turn[3].atan2(turn[0])
}

#[derive(Debug, Clone, Copy, Default)]
struct Peaks {
    /// Of the largest tilt: sin², the tilt and its time.
    square: f64,
    tilt: (f64, f64),
    /// `tilt_x` and `tilt_y`, signed, and the size of their tangents.
    tilts: [f64; 2],
    tangents: [f64; 2],
    slide: f64,
    uplift: f64,
    first_uplift: Option<f64>,
}

#[derive(Debug, Clone)]
pub(super) struct Track {
    peaks: Vec<Peaks>,
    /// Largest |θ_upper − θ_lower|.
    pub(super) relative: f64,
    /// Time in each pattern.
    times: Patterns,
    pub(super) base_contacts: usize,
    pub(super) wall_contacts: usize,
    pub(super) landings: Landings,
    /// Largest speed towards a wall at the begin of a contact.
    pub(super) wall_speed: f64,
    /// Largest force of the walls on the left and on the right.
    pub(super) wall_forces: [f64; 2],
    /// The same of one edge of a body.
    pub(super) wall_edge_forces: [f64; 2],
}

/// The centre of the base: its horizontal displacement squared, and the rate of that.
fn slide(world: &World<'_>, pose: &Pose, body: usize) -> (f64, f64) {
    let ([x, y, _], [rate_x, rate_y, _]) = pose.point(&[0.0, 0.0, -world.bodies[body].cg_height]);
    (x * x + y * y, 2.0 * (x * rate_x + y * rate_y))
}

impl Track {
    pub(super) fn new(world: &World<'_>, start: &State) -> Self {
        let mut peaks = vec![Peaks::default(); world.bodies.len()];
        let poses = world.poses(start);
        for (body, peaks) in peaks.iter_mut().enumerate() {
            let axis = poses[body].axis().0;
            peaks.tilts = tilts(&axis);
            peaks.tangents = [0, 1].map(|side| (axis[side] / axis[2].max(0.0)).abs());
        }
        Self {
            peaks,
            relative: 0.0,
            times: Patterns::default(),
            base_contacts: 0,
            wall_contacts: 0,
            landings: Landings::new(&world.elements),
            wall_speed: 0.0,
            wall_forces: [0.0; 2],
            wall_edge_forces: [0.0; 2],
        }
    }

    /// Evaluates a step.
    pub(super) fn read(&mut self, seen: &Seen<'_, '_>, line: &Line) {
        for body in 0..seen.world.bodies.len() {
            self.tilts(seen, body);
            let reached = self.peaks[body].slide.powi(2);
            if let Some((_, square)) =
                seen.crest(reached, |poses| slide(seen.world, &poses[body], body))
            {
                self.peaks[body].slide = square.sqrt();
            }
        }
        self.uplifts(seen);
        self.landings.read(seen, line);
        // Before the first contact there is no force.
        if self.wall_contacts > 0 {
            self.walls(seen);
        }
        if seen.world.bodies.len() == 2 {
            self.stack(seen);
        }
    }

    fn tilts(&mut self, seen: &Seen<'_, '_>, body: usize) {
        let peaks = &mut self.peaks[body];
        let axis = |poses: &Poses| poses[body].axis();
        let axis_at = |share: f64| axis(&seen.poses(share)).0;
        let ends = seen.ends.map(axis);
        // sin²: rises with the tilt up to π/2.
        let square = |(axis, rate): (Vector, Vector)| {
            (
                axis[0] * axis[0] + axis[1] * axis[1],
                2.0 * (axis[0] * rate[0] + axis[1] * rate[1]),
            )
        };
        let of = |poses: &Poses| square(axis(poses));
        if let Some((share, most)) = seen.crest_between(peaks.square, ends.map(square), of) {
            let [x, y, z] = axis_at(share);
            peaks.square = most;
            peaks.tilt = (x.hypot(y).atan2(z), seen.time_s(share));
        }
        for side in 0..2 {
            // The tangent rises with the angle, and needs no trigonometric function.
            let size = |(axis, rate): (Vector, Vector)| {
                let per_up = 1.0 / axis[2].max(0.0);
                let tangent = axis[side] * per_up;
                let rise = (rate[side] - tangent * rate[2]) * per_up;
                (tangent.abs(), tangent.signum() * rise)
            };
            let of = |poses: &Poses| size(axis(poses));
            let best = peaks.tangents[side];
            // As below, without divisions.
            let is_low =
                |(axis, _): &(Vector, Vector)| axis[side].abs() < HEADROOM * best * axis[2];
            if ends.iter().all(is_low) {
                continue;
            }
            if let Some((share, most)) = seen.crest_between(best, ends.map(size), of) {
                peaks.tangents[side] = most;
                peaks.tilts[side] = tilts(&axis_at(share))[side];
            }
        }
    }

    fn uplifts(&mut self, seen: &Seen<'_, '_>) {
        let mut elements = seen.world.elements.as_slice();
        if let Some(feet) = &seen.world.feet {
            let highest_m = seen
                .ends
                .iter()
                .map(|poses| feet.highest_m(&poses[0]))
                .fold(0.0, f64::max);
            if highest_m <= HEADROOM * self.peaks[0].uplift {
                elements = elements.get(feet.len()..).unwrap_or_default();
            }
        }
        let z = -seen.world.bodies[0].cg_height;
        let flats = |poses: &Poses| (poses[0].displacement(z, 2), poses[0].rising(z));
        let ends = seen.ends.map(flats);
        for element in elements {
            let body = match element.role {
                Role::Base => 0,
                Role::Interface => seen.world.bodies.len() - 1,
                Role::Wall => continue,
            };
            let point = [element.point[0], element.point[1]];
            let peaks = &mut self.peaks[body];
            let height = |poses: &Poses| {
                if element.role == Role::Base {
                    let (height, rising) = flats(poses);
                    return (height.of(point), rising.of(point));
                }
                let foot = seen.world.foot(element, poses);
                (-foot.compression, -foot.compression_rate)
            };
            let [from, to] = if element.role == Role::Base {
                ends.map(|(height, rising)| (height.of(point), rising.of(point)))
            } else {
                seen.ends.map(height)
            };
            if from.0.max(to.0) <= HEADROOM * peaks.uplift {
                continue;
            }
            if let Some((_, height_m)) = seen.crest_between(peaks.uplift, [from, to], height) {
                peaks.uplift = height_m;
            }
            if peaks.first_uplift.is_none() {
                let is_up = |share: f64| height(&seen.poses(share)).0 > 0.0;
                let share = if is_up(0.0) {
                    0.0
                } else {
                    bisect(0.0, 1.0, is_up)
                };
                peaks.first_uplift = Some(seen.time_s(share));
            }
        }
    }

    /// The forces of the walls.
    fn walls(&mut self, seen: &Seen<'_, '_>) {
        let pressed = seen.world.elements.iter().zip(seen.grips.each());
        let pressed =
            pressed.filter(|(element, grip)| element.role == Role::Wall && grip.carries());
        let pressed: Vec<&Element<'_>> = pressed.map(|(element, _)| element).collect();
        if pressed.is_empty() {
            return;
        }
        // Of each side, at the base and above.
        let forces = |share: f64| {
            let poses = seen.poses(share);
            let mut forces = [[0.0; 2]; 2];
            for element in &pressed {
                let foot = seen.world.foot(element, &poses);
                // The face of a wall on the right looks to the left; that of the object, on which a low wall
                // presses, looks to the right.
                let is_right = (element.sign < 0.0) == element.face_of.is_none();
                forces[usize::from(is_right)][usize::from(element.point[2] > 0.0)] +=
                    element.pad.push(foot.compression, foot.compression_rate);
            }
            forces
        };
        for side in 0..2 {
            raise(&mut self.wall_forces[side], |share| {
                forces(share)[side].iter().sum()
            });
            raise(&mut self.wall_edge_forces[side], |share| {
                let [base, above] = forces(share)[side];
                base.max(above)
            });
        }
    }

    /// The patterns and the relative rotation of two bodies.
    fn stack(&mut self, seen: &Seen<'_, '_>) {
        let relative = |poses: &Poses| {
            let [lower, upper] =
                [poses[0], poses[1]].map(|pose| (tilts(&pose.axis().0)[0], pose.omega[1]));
            let angle = upper.0 - lower.0;
            (angle.abs(), angle.signum() * (upper.1 - lower.1))
        };
        if let Some((_, angle)) = seen.crest(self.relative, relative) {
            self.relative = angle;
        }
        let times = &mut self.times;
        let time = match seen.pattern() {
            Pattern::Rest => &mut times.rest_ratio,
            Pattern::Together => &mut times.together_ratio,
            Pattern::UpperAlone => &mut times.upper_alone_ratio,
            Pattern::Same => &mut times.same_ratio,
            Pattern::Opposite => &mut times.opposite_ratio,
        };
        *time += seen.step.length_s;
    }

    /// The shares of a history of this length; what is skipped at rest is rest.
    pub(super) fn patterns(&self, end_s: f64) -> Patterns {
        let t = &self.times;
        let moving_s = t.same_ratio + t.opposite_ratio + t.together_ratio + t.upper_alone_ratio;
        Patterns {
            rest_ratio: (1.0 - moving_s / end_s).max(0.0),
            same_ratio: t.same_ratio / end_s,
            opposite_ratio: t.opposite_ratio / end_s,
            together_ratio: t.together_ratio / end_s,
            upper_alone_ratio: t.upper_alone_ratio / end_s,
        }
    }

    /// A contact begins, with this speed towards the face.
    pub(super) fn touch(&mut self, index: usize, role: Role, time_s: f64, speed: f64) {
        match role {
            Role::Base => {
                self.base_contacts += 1;
                self.landings.touch(index, time_s, speed);
            }
            Role::Wall => {
                self.wall_contacts += 1;
                self.wall_speed = self.wall_speed.max(speed);
            }
            Role::Interface => {}
        }
    }

    pub(super) fn finish(
        &self,
        world: &World<'_>,
        y: &State,
        fallen: Option<Fallen>,
    ) -> Vec<BodyMotion> {
        let poses = world.poses(y);
        let motion = |(body, peaks): (usize, &Peaks)| {
            let [final_tilt_x_rad, final_tilt_y_rad] = tilts(&poses[body].axis().0);
            let fallen = fallen.filter(|fallen| fallen.body == body);
            let is_over = fallen.is_some_and(|fallen| !fallen.slid_off);
            let outcome = if fallen.is_some() {
                Outcome::Overturned
            } else if peaks.uplift > 0.0 {
                Outcome::Rocked
            } else {
                Outcome::NoUplift
            };
            BodyMotion {
                outcome,
                peak_tilt_rad: if is_over { FRAC_PI_2 } else { peaks.tilt.0 },
                peak_tilt_time_s: fallen
                    .filter(|_| is_over)
                    .map_or(peaks.tilt.1, |fallen| fallen.time_s),
                peak_tilt_x_rad: peaks.tilts[0],
                peak_tilt_y_rad: peaks.tilts[1],
                final_tilt_x_rad,
                final_tilt_y_rad,
                yaw_rad: yaw(&y[BODY * body + TURN..]),
                base_slide_peak_m: peaks.slide,
                base_slide_final_m: slide(world, &poses[body], body).0.sqrt(),
                uplift_m: peaks.uplift,
                first_uplift_time_s: peaks.first_uplift,
                overturn_time_s: fallen.map(|fallen| fallen.time_s),
            }
        };
        self.peaks.iter().enumerate().map(motion).collect()
    }
}
