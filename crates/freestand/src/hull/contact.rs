//! The points of a hull with which a body touches the floor.

use std::f64::consts::{PI, TAU};

use super::poses::StablePose;
use super::{Hull, Vector};
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
        let vertices = self.vertices_m();
        let caps = self.caps(directions);
        // How many of the directions that are left each vertex serves well enough.
        let mut gains = vec![0_u32; vertices.len()];
        for vertex in caps.iter().flat_map(|cap| &cap.vertices) {
            gains[*vertex as usize] += 1;
        }
        let mut is_open = vec![true; directions.len()];
        let mut chosen = Vec::new();
        let mut choose = |vertex: usize, gains: &mut [u32]| {
            let of_directions = caps.iter().zip(directions).zip(&mut is_open);
            for ((cap, (down, _)), is_open) in of_directions {
                if *is_open && dot(&vertices[vertex], down) >= cap.least_m {
                    *is_open = false;
                    cap.vertices
                        .iter()
                        .for_each(|one| gains[*one as usize] -= 1);
                }
            }
            chosen.push(vertices[vertex]);
        };
        for (vertex, _) in vertices.iter().enumerate().filter(|(_, one)| must(one)) {
            choose(vertex, &mut gains);
        }
        // The vertex that serves most of those which are left, again and again.
        let most = |gains: &[u32]| {
            let all = gains.iter().copied().enumerate();
            all.reduce(|best, one| if one.1 > best.1 { one } else { best })
        };
        while let Some((vertex, 1..)) = most(&gains) {
            choose(vertex, &mut gains);
        }
        chosen
    }

    /// Of each direction, the vertices that reach far enough in it. On a convex body edges join them to the one that
    /// reaches farthest: they are found from there, without a look at all the others.
    fn caps(&self, directions: &[(Vector, f64)]) -> Vec<Cap> {
        let sides = self.sides();
        let mut lowest = directions
            .first()
            .map_or(0, |(down, _)| self.lowest(down).1);
        // The number of the direction, from 1, in which a vertex was last seen.
        let mut seen = vec![0_u32; self.vertices_m().len()];
        let of_direction = |(at, (down, error_m)): (u32, &(Vector, f64))| {
            let height_m;
            (height_m, lowest) = self.lowest_from(lowest, &sides, down);
            let least_m = height_m - error_m;
            let mut vertices = vec![lowest as u32];
            seen[lowest] = at;
            let mut next = 0;
            while let Some(vertex) = vertices.get(next) {
                for one in &sides[*vertex as usize] {
                    let is_new = seen[*one] != at;
                    if is_new && dot(&self.vertices_m()[*one], down) >= least_m {
                        seen[*one] = at;
                        vertices.push(*one as u32);
                    }
                }
                next += 1;
            }
            Cap { least_m, vertices }
        };
        (1..).zip(directions).map(of_direction).collect()
    }
}

/// The vertices that reach far in a direction.
struct Cap {
    /// How far they reach at least \[m\].
    least_m: f64,
    vertices: Vec<u32>,
}
