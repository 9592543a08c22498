//! The poses in which a body can stand.

use std::f64::consts::PI;

use super::{Hull, HullError, Vector, normal_of, tilt_of, unit};
use crate::space::{cross, difference, dot};

/// A body that is given upright may stand up to this far from it \[rad\].
const NEAR_RAD: f64 = 20.0 * PI / 180.0;

/// A pose in which a body stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StablePose {
    /// The direction of the body that is down.
    pub down: Vector,
    /// Height of the centre of gravity above the floor \[m\].
    pub cg_height_m: f64,
}

impl StablePose {
    /// Tilt from the pose as given, and its direction \[rad\].
    pub fn tilt(&self) -> (f64, f64) {
        tilt_of(&self.down)
    }
}

impl Hull {
    /// All poses in which the body stands, the most upright first.
    ///
    /// It stands on a face where the foot of the perpendicular from the centre of gravity is inside the
    /// face: there the height of the centre of gravity is a minimum.
    pub fn stable_poses(&self) -> Vec<StablePose> {
        let mut poses: Vec<StablePose> = Vec::new();
        for face in self.faces() {
            let corners = self.corners(face);
            let Some(down) = unit(&normal_of(&corners)) else {
                continue;
            };
            let cg_height_m = dot(&down, &corners[0]);
            let foot = down.map(|x| cg_height_m * x);
            let is_inside = (0..3).all(|at| {
                let side = difference(&corners[(at + 1) % 3], &corners[at]);
                dot(&cross(&side, &difference(&foot, &corners[at])), &down) >= 0.0
            });
            // A flat base is many triangles, and the foot may be on a line between two.
            let is_known = |pose: &StablePose| dot(&pose.down, &down) > 1.0 - 1e-12;
            if is_inside && !poses.iter().any(is_known) {
                poses.push(StablePose { down, cg_height_m });
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
