//! Walls beside a body on its hull.
//!
//! A wall is a smooth plane that moves with the floor and is taller than the body. It presses on every vertex of the
//! hull behind it: N = k d + c ḋ, at least 0, with the depth d, k = k_w/2 and c = ζ_w √(k_w m). So the two ends of
//! an edge together have the stiffness k_w and the damping ratio ζ_w = c_w/(2√(k_w m)).

use super::Vector;
use super::lanes::{LANES, lanes};
use crate::space::{Shift, cross, dot, turned, turned_back};

/// A wall beside a body.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HullWall {
    /// Where it stands, seen from the body: the angle from its x to its y \[rad\].
    pub toward_rad: f64,
    /// Its distance from the nearest point of the body at rest \[m\].
    pub gap_m: f64,
    /// k_w \[N/m\].
    pub stiffness_n_m: f64,
    /// ζ_w.
    pub damping_ratio: f64,
}

impl HullWall {
    pub(super) fn is_valid(&self) -> bool {
        let is_number = |x: f64| x >= 0.0 && x.is_finite();
        self.toward_rad.is_finite()
            && is_number(self.gap_m)
            && is_number(self.damping_ratio)
            && is_number(self.stiffness_n_m)
            && self.stiffness_n_m > 0.0
    }

    /// c of one point \[N s/m\].
    pub(super) fn point_n_s_m(&self, mass_kg: f64) -> f64 {
        self.damping_ratio * (self.stiffness_n_m * mass_kg).sqrt()
    }
}

/// Where a body is and how it moves, in the axes of the floor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving {
    pub(super) place_m: Vector,
    /// Q − I.
    pub(super) shift: Shift,
    pub(super) velocity_m_s: Vector,
    pub(super) omega_rad_s: Vector,
}

impl Moving {
    /// From its centre of gravity to a point, and the velocity there.
    #[inline(always)]
    fn point(&self, point_m: &Vector) -> (Vector, Vector) {
        let arm = turned(&self.shift, point_m);
        let by_turn = cross(&self.omega_rad_s, &arm);
        (arm, [0, 1, 2].map(|i| self.velocity_m_s[i] + by_turn[i]))
    }
}

/// The walls of a history and what they have seen.
#[derive(Debug, Clone, Default)]
pub(super) struct Beside<'b> {
    planes: Vec<Plane>,
    /// The points that meet them, also by coordinate, and how far the farthest is from the centre of gravity \[m\].
    points_m: &'b [Vector],
    coordinates: Vec<[[f64; LANES]; 3]>,
    reach_m: f64,
    /// The points behind a wall, with their depths.
    behind: Vec<(usize, f64)>,
    /// How often it struck a wall, and the largest speed of a point there \[m/s\].
    pub(super) contacts: usize,
    pub(super) speed_m_s: f64,
}

#[derive(Debug, Clone)]
struct Plane {
    /// From the wall to the body.
    normal: Vector,
    /// n·x of its points \[m\].
    offset_m: f64,
    point_n_m: f64,
    point_n_s_m: f64,
    /// No point of the body is nearer than this \[m\].
    clear_m: f64,
    presses: bool,
    is_touched: bool,
}

impl<'b> Beside<'b> {
    /// The walls beside a body turned by `yaw_rad` that has settled.
    pub(super) fn new(
        walls: &[HullWall],
        mass_kg: f64,
        yaw_rad: f64,
        at: &Moving,
        points_m: &'b [Vector],
    ) -> Self {
        let plane = |wall: &HullWall| {
            let (sin, cos) = (yaw_rad + wall.toward_rad).sin_cos();
            let normal = [-cos, -sin, 0.0];
            let reach = points_m
                .iter()
                .map(|point| dot(&normal, &at.point(point).0));
            let nearest_m = reach.fold(f64::INFINITY, f64::min);
            Plane {
                normal,
                offset_m: dot(&normal, &at.place_m) + nearest_m - wall.gap_m,
                point_n_m: 0.5 * wall.stiffness_n_m,
                point_n_s_m: wall.point_n_s_m(mass_kg),
                clear_m: 0.0,
                presses: false,
                is_touched: false,
            }
        };
        let squares = points_m.iter().map(|point| dot(point, point));
        Self {
            planes: walls.iter().map(plane).collect(),
            coordinates: lanes(points_m),
            reach_m: squares.fold(0.0, f64::max).sqrt(),
            points_m,
            ..Self::default()
        }
    }

    /// Whether a wall presses on the body.
    pub(super) fn presses(&self) -> bool {
        self.planes.iter().any(|plane| plane.presses)
    }

    /// Adds what the walls do to a body that has come here in a step.
    #[inline(always)]
    pub(super) fn push(
        &mut self,
        at: &Moving,
        step_s: f64,
        force: &mut Vector,
        torque: &mut Vector,
    ) {
        for plane in &mut self.planes {
            plane.presses = false;
            // Nothing to look at as long as no point can have come so far since the last look.
            let turning = dot(&at.omega_rad_s, &at.omega_rad_s).sqrt();
            let nearing = (-dot(&plane.normal, &at.velocity_m_s)).max(0.0);
            plane.clear_m -= step_s * (nearing + self.reach_m * turning);
            if plane.clear_m > 0.0 {
                continue;
            }
            plane.look(at, &self.coordinates, &mut self.behind);
            let is_new = !plane.is_touched;
            plane.is_touched = !self.behind.is_empty();
            self.contacts += usize::from(is_new && plane.is_touched);
            for &(point, depth_m) in &self.behind {
                let (arm, velocity) = at.point(&self.points_m[point]);
                let rate_m_s = -dot(&plane.normal, &velocity);
                if is_new {
                    self.speed_m_s = self.speed_m_s.max(rate_m_s);
                }
                let normal_n = (plane.point_n_m * depth_m + plane.point_n_s_m * rate_m_s).max(0.0);
                plane.presses |= normal_n > 0.0;
                let of_point = plane.normal.map(|x| normal_n * x);
                let moment = cross(&arm, &of_point);
                for i in 0..3 {
                    force[i] += of_point[i];
                    torque[i] += moment[i];
                }
            }
        }
    }
}

impl Plane {
    /// The points of the body behind it, each with its depth.
    #[inline(always)]
    fn look(
        &mut self,
        at: &Moving,
        coordinates: &[[[f64; LANES]; 3]],
        behind: &mut Vec<(usize, f64)>,
    ) {
        behind.clear();
        let from_m = dot(&self.normal, &at.place_m) - self.offset_m;
        let normal = turned_back(&at.shift, &self.normal);
        self.clear_m = f64::INFINITY;
        for (group, [x, y, z]) in coordinates.iter().enumerate() {
            let distance_m: [f64; LANES] = std::array::from_fn(|lane| {
                from_m + normal[0] * x[lane] + normal[1] * y[lane] + normal[2] * z[lane]
            });
            let nearest_m = distance_m.iter().fold(f64::INFINITY, |a, b| a.min(*b));
            self.clear_m = self.clear_m.min(nearest_m);
            if nearest_m < 0.0 {
                let found = distance_m.iter().enumerate().filter(|(_, one)| **one < 0.0);
                behind.extend(found.map(|(lane, one)| (LANES * group + lane, -one)));
            }
        }
    }
}
