//! The poses in which a body can stand.

use super::{Hull, HullError, Vector, normal_of, tilt_of, unit};
use crate::space::{cross, difference, dot};

/// A body that is given upright may stand up to this far from it \[rad\].
const NEAR_RAD: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// A pose in which a body stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StablePose {
    /// The direction of the body that is down.
    pub down: Vector,
    /// Height of the centre of gravity above the floor \[m\].
    pub cg_height_m: f64,
    /// The smallest angle by which it must be tipped about a side of the face on which it stands
    /// \[rad\].
    pub tip_rad: f64,
    /// Towards which it tips then: 0 to +x, π/2 to +y \[rad\].
    pub tip_toward_rad: f64,
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
    /// face: there the height of the centre of gravity is a minimum. The angle about a side is that
    /// between the perpendicular and the plane through the centre of gravity and that side.
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
                let (tip_rad, tip_toward_rad) = self.tip(&down, cg_height_m);
                poses.push(StablePose {
                    down,
                    cg_height_m,
                    tip_rad,
                    tip_toward_rad,
                });
            }
        }
        poses.sort_by(|a, b| a.tilt().0.total_cmp(&b.tilt().0));
        poses
    }

    /// The smallest tip angle on the flat face with this normal, and its direction.
    fn tip(&self, down: &Vector, cg_height_m: f64) -> (f64, f64) {
        // Sides of the face: edges between a triangle in its plane and one that is not.
        let is_flat = |face: &[usize; 3]| {
            unit(&normal_of(&self.corners(face)))
                .is_some_and(|normal| dot(&normal, down) > 1.0 - 1e-12)
        };
        let flat: Vec<&[usize; 3]> = self.faces().iter().filter(|face| is_flat(face)).collect();
        let sides = || {
            flat.iter()
                .flat_map(|face| (0..3).map(|at| (face[at], face[(at + 1) % 3])))
        };
        let outer = sides().filter(|(a, b)| !sides().any(|other| other == (*b, *a)));
        let about = outer.filter_map(|(a, b)| {
            let start = self.vertices_m()[a];
            let along = difference(&self.vertices_m()[b], &start);
            // Outward in the plane of the face.
            let outward = unit(&cross(&along, down))?;
            let lever_m = dot(&outward, &start);
            let (_, toward_rad) = tilt_of(&outward);
            Some((lever_m.atan2(cg_height_m), toward_rad))
        });
        about
            .reduce(|least, one| if one.0 < least.0 { one } else { least })
            .unwrap_or((0.0, 0.0))
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
