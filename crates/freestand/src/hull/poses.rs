//! The poses in which a body can stand.

use std::f64::consts::PI;

use super::{Hull, HullError, Vector, normal_of, tilt_of, unit};
use crate::space::{cross, difference, dot};

/// A body that is given upright may stand up to this far from it \[rad\].
const NEAR_RAD: f64 = 20.0 * PI / 180.0;

/// Poses nearer to each other than this are one \[rad\].
const SAME_RAD: f64 = 2.0 * PI / 180.0;

/// A pose in which a body stands.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StablePose {
    /// The direction of the body that is down.
    pub down: Vector,
    /// Height of the centre of gravity above the floor \[m\].
    pub cg_height_m: f64,
}

impl StablePose {
    /// The axes of the floor in those of the body: x, as near as possible to that of the body, y, and up.
    pub fn axes(&self) -> [Vector; 3] {
        let [x, y, z] = self.down;
        let along = [1.0 - x * x, -x * y, -x * z];
        // A body that lies on its x has none along it.
        let x_axis = unit(&along)
            .filter(|_| dot(&along, &along) > 1e-12)
            .unwrap_or([0.0, 1.0, 0.0]);
        let up = self.down.map(|one| -one);
        [x_axis, cross(&up, &x_axis), up]
    }

    /// What is down in the axes of the body after a tilt from the pose.
    pub(super) fn tilted(&self, axes: &[Vector; 3], tilt_rad: f64, toward_rad: f64) -> Vector {
        let (sin, cos) = tilt_rad.sin_cos();
        let (along_y, along_x) = toward_rad.sin_cos();
        [0, 1, 2].map(|i| cos * self.down[i] + sin * (along_x * axes[0][i] + along_y * axes[1][i]))
    }

    /// Tilt from the pose as given, and its direction \[rad\].
    pub fn tilt(&self) -> (f64, f64) {
        tilt_of(&self.down)
    }
}

impl Hull {
    /// All poses in which the body stands, the most upright first.
    ///
    /// Poses less than 2° apart are one, the lowest: a gently curved base has several that nobody could tell
    /// apart. It stands on a face where the foot of the perpendicular from the centre of gravity is inside the
    /// face: there the height of the centre of gravity is a minimum.
    pub fn stable_poses(&self) -> Vec<StablePose> {
        let mut all: Vec<StablePose> = Vec::new();
        for face in self.faces() {
            let corners = self.corners(face);
            let Some(down) = unit(&normal_of(&corners)) else {
                continue;
            };
            let cg_height_m = dot(&down, &corners[0]);
            let foot = down.map(|x| cg_height_m * x);
            // A flat base is many triangles, and the foot may be on a line between two: a rounding error must
            // not put it outside both.
            let is_inside = (0..3).all(|at| {
                let side = difference(&corners[(at + 1) % 3], &corners[at]);
                let across = cross(&side, &difference(&foot, &corners[at]));
                dot(&across, &down) >= -1e-9 * dot(&side, &side)
            });
            if is_inside {
                all.push(StablePose { down, cg_height_m });
            }
        }
        all.sort_by(|a, b| a.cg_height_m.total_cmp(&b.cg_height_m));
        let mut poses: Vec<StablePose> = Vec::new();
        for pose in all {
            let is_near = |other: &StablePose| dot(&other.down, &pose.down) > SAME_RAD.cos();
            if !poses.iter().any(is_near) {
                poses.push(pose);
            }
        }
        poses.sort_by(|a, b| a.tilt().0.total_cmp(&b.tilt().0));
        poses
    }

    /// The pose nearest to the one as given.
    ///
    /// # Errors
    /// None within 20°.
    pub fn standing(&self) -> Result<StablePose, HullError> {
        let poses = self.stable_poses();
        let nearest = poses.first().copied();
        let tilt_rad = nearest.map_or(std::f64::consts::PI, |pose| pose.tilt().0);
        nearest
            .filter(|_| tilt_rad <= NEAR_RAD)
            .ok_or(HullError::NoPose {
                tilt_deg: tilt_rad.to_degrees(),
            })
    }
}
