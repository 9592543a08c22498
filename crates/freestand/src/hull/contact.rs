//! The points of a hull with which a body touches the floor.

use std::f64::consts::{PI, TAU};

use super::poses::StablePose;
use super::{Hull, Vector, height_m};
use crate::space::dot;

/// Tilts from the pose up to this are looked at \[rad\]: past it a body falls, whatever its points.
const MAX_TILT_RAD: f64 = 40.0 * PI / 180.0;

/// How much lower the centre of gravity may stand on the chosen points: in the pose \[m\], and for each
/// radian of tilt beside it \[m\].
const ERROR_M: f64 = 3e-5;
const ERROR_M_PER_RAD: f64 = 3e-5 * 180.0 / PI;

/// Vertices nearer to the floor than this are corners of a flat base \[m\]; a base of more than a few is flat.
const ON_FLOOR_M: f64 = 1e-6;

/// Steps of the tilt and of its direction: half a degree and two degrees.
const TILTS: usize = 80;
const DIRECTIONS: usize = 180;

/// For walls: the error of the distance \[m\], and steps of the tilt and of its direction, 5° and 3°.
const SIDE_ERROR_M: f64 = 2e-4;
const SIDE_TILTS: i32 = 8;
const SIDE_DIRECTIONS: u32 = 120;

impl Hull {
    /// The vertices on which a body stands for some tilt up to 40° from a pose, as few as keep the
    /// height of the centre of gravity within 0.03 mm and another 0.03 mm for each degree of tilt.
    pub fn contact_points_m(&self, pose: &StablePose) -> Vec<Vector> {
        let axes = pose.axes();
        let mut directions = vec![(pose.down, ERROR_M)];
        for tilt in 1..=TILTS {
            let tilt_rad = MAX_TILT_RAD * tilt as f64 / TILTS as f64;
            let error_m = ERROR_M + ERROR_M_PER_RAD * tilt_rad;
            for one in 0..DIRECTIONS {
                let toward_rad = TAU * one as f64 / DIRECTIONS as f64;
                directions.push((pose.tilted(&axes, tilt_rad, toward_rad), error_m));
            }
        }
        // Of a flat base all corners count: without some of them a round one would have better and worse sides.
        let is_on_floor = |vertex: &Vector| pose.cg_height_m - dot(vertex, &pose.down) < ON_FLOOR_M;
        self.covering(&directions, is_on_floor)
    }

    /// The vertices with which a body meets walls beside its pose, for tilts up to 40°: as few as keep the distance of the
    /// nearest within 0.2 mm.
    pub(super) fn side_points_m(&self, pose: &StablePose) -> Vec<Vector> {
        let axes = pose.axes();
        let mut directions = Vec::new();
        for elevation in -SIDE_TILTS..=SIDE_TILTS {
            let (sin, cos) =
                (MAX_TILT_RAD * f64::from(elevation) / f64::from(SIDE_TILTS)).sin_cos();
            for one in 0..SIDE_DIRECTIONS {
                let (across, along) = (TAU * f64::from(one) / f64::from(SIDE_DIRECTIONS)).sin_cos();
                let parts = [cos * along, cos * across, sin];
                let direction =
                    [0, 1, 2].map(|i| (0..3).map(|axis| parts[axis] * axes[axis][i]).sum());
                directions.push((direction, SIDE_ERROR_M));
            }
        }
        self.covering(&directions, |_| false)
    }

    /// As few vertices as reach so far in each direction, but for the error beside it; with all that must be among them.
    fn covering(
        &self,
        directions: &[(Vector, f64)],
        must: impl Fn(&Vector) -> bool,
    ) -> Vec<Vector> {
        // The directions that each vertex serves well enough.
        let mut serves: Vec<Vec<usize>> = vec![Vec::new(); self.vertices_m().len()];
        for (at, (down, error_m)) in directions.iter().enumerate() {
            let least_m = height_m(self.vertices_m(), down) - error_m;
            for (vertex, served) in self.vertices_m().iter().zip(&mut serves) {
                if dot(vertex, down) >= least_m {
                    served.push(at);
                }
            }
        }
        let mut is_open = vec![true; directions.len()];
        let mut chosen = Vec::new();
        let corners = self.vertices_m().iter().zip(&serves);
        for (corner, served) in corners.filter(|(vertex, _)| must(vertex)) {
            served.iter().for_each(|at| is_open[*at] = false);
            chosen.push(*corner);
        }
        // The vertex that serves most of those which are left, again and again.
        loop {
            let gain = |served: &Vec<usize>| served.iter().filter(|at| is_open[**at]).count();
            let best = serves
                .iter()
                .map(gain)
                .enumerate()
                .reduce(|best, one| if one.1 > best.1 { one } else { best });
            let Some((vertex, 1..)) = best else {
                return chosen;
            };
            serves[vertex].iter().for_each(|at| is_open[*at] = false);
            chosen.push(self.vertices_m()[vertex]);
        }
    }
}
