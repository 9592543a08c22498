//! The points of a hull with which a body touches the floor.

use std::f64::consts::{PI, TAU};

use super::{Hull, Vector, height_m};
use crate::space::dot;

/// Tilts from the pose up to this are looked at \[rad\].
const MAX_TILT_RAD: f64 = 40.0 * PI / 180.0;

/// How much lower the centre of gravity may stand on the chosen points: in the pose \[m\], and for each
/// radian of tilt beside it \[m\].
const ERROR_M: f64 = 3e-5;
const ERROR_M_PER_RAD: f64 = 3e-5 * 180.0 / PI;

/// Steps of the tilt and of its direction: half a degree and two degrees.
const TILTS: usize = 80;
const DIRECTIONS: usize = 180;

impl Hull {
    /// The vertices on which a body stands for some tilt up to 40° from a pose, as few as keep the
    /// height of the centre of gravity within 0.03 mm and another 0.03 mm for each degree of tilt.
    pub fn contact_points_m(&self, pose_down: &Vector) -> Vec<Vector> {
        let around = Around::new(pose_down);
        let mut directions = vec![(*pose_down, ERROR_M)];
        for tilt in 1..=TILTS {
            let tilt_rad = MAX_TILT_RAD * tilt as f64 / TILTS as f64;
            let error_m = ERROR_M + ERROR_M_PER_RAD * tilt_rad;
            for one in 0..DIRECTIONS {
                let toward_rad = TAU * one as f64 / DIRECTIONS as f64;
                directions.push((around.down(tilt_rad, toward_rad), error_m));
            }
        }
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
        // The vertex that serves most of those which are left, again and again.
        let mut is_open = vec![true; directions.len()];
        let mut chosen = Vec::new();
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

/// Directions about a pose.
pub(super) struct Around {
    down: Vector,
    x: Vector,
    y: Vector,
}

impl Around {
    pub(super) fn new(down: &Vector) -> Self {
        // x as near as possible to that of the body.
        let along = [
            1.0 - down[0] * down[0],
            -down[0] * down[1],
            -down[0] * down[2],
        ];
        let size = dot(&along, &along).sqrt();
        let x = if size > 1e-6 {
            along.map(|one| one / size)
        } else {
            [0.0, 1.0, 0.0]
        };
        let up = down.map(|one| -one);
        Self {
            down: *down,
            x,
            y: crate::space::cross(&up, &x),
        }
    }

    /// What is down after a tilt from the pose.
    pub(super) fn down(&self, tilt_rad: f64, toward_rad: f64) -> Vector {
        let (sin, cos) = tilt_rad.sin_cos();
        let (along_y, along_x) = toward_rad.sin_cos();
        [0, 1, 2].map(|i| cos * self.down[i] + sin * (along_x * self.x[i] + along_y * self.y[i]))
    }
}
