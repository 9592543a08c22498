//! The poses in which a body can stand.

use std::f64::consts::PI;

use super::contact::Around;
use super::{Hull, HullError, Vector, normal_of, tilt_of, unit};
use crate::space::{cross, difference, dot};

/// A body that is given upright may stand up to this far from it \[rad\].
const NEAR_RAD: f64 = 20.0 * PI / 180.0;

/// What is within this of the floor is the base \[m\].
const BASE_M: f64 = 0.003;

/// A pose in which a body stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StablePose {
    /// The direction of the body that is down.
    pub down: Vector,
    /// Height of the centre of gravity above the floor \[m\].
    pub cg_height_m: f64,
    /// The smallest angle by which it must be tipped about a side of its base \[rad\]. The base is what is
    /// within 3 mm of the floor, as if it were flat: a curved one tips earlier.
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

    /// The smallest angle about a side of the base, and its direction.
    fn tip(&self, down: &Vector, cg_height_m: f64) -> (f64, f64) {
        let around = Around::new(down);
        let is_base = |vertex: &&Vector| dot(vertex, down) > cg_height_m - BASE_M;
        let base: Vec<[f64; 2]> = self
            .vertices_m()
            .iter()
            .filter(is_base)
            .map(|vertex| around.aside(vertex))
            .collect();
        let outline = outline(base);
        let sides = outline.iter().zip(outline.iter().cycle().skip(1));
        let about = sides.filter_map(|(a, b)| {
            let [x, y] = [b[0] - a[0], b[1] - a[1]];
            let length_m = x.hypot(y);
            // Outward, to the right of a side: the outline turns to the left.
            let outward = [y / length_m, -x / length_m];
            let lever_m = outward[0] * a[0] + outward[1] * a[1];
            let (_, toward_rad) = tilt_of(&around.down(PI / 2.0, outward[1].atan2(outward[0])));
            (length_m > 0.0).then(|| (lever_m.atan2(cg_height_m), toward_rad))
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

/// The convex outline of points, to the left (Andrew 1979).
fn outline(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turns_left = |a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
    };
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while let [.., a, b] = &chain[..]
                && !turns_left(a, b, &point)
            {
                chain.pop();
            }
            chain.push(point);
        }
        // Its last point is the first of the other chain.
        chain.pop();
        chain
    };
    let mut all = chain(&mut points.iter().copied());
    all.extend(chain(&mut points.iter().rev().copied()));
    all
}
