//! A body in the pose in which it stands, with the points on which it is followed.

use super::poses::StablePose;
use super::wall::HullWall;
use super::{HullBody, Vector, height_m};
use crate::space::{difference, dot};

/// A body in the pose in which it stands, with the points on which it is followed.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Standing {
    pub(super) mass_kg: f64,
    pub(super) inertia_kg_m2: [Vector; 3],
    pub(super) points_m: Vec<Vector>,
    /// The points with which it meets walls, and these.
    pub(super) sides_m: Vec<Vector>,
    pub(super) walls: Vec<HullWall>,
    pub(super) poses: Vec<StablePose>,
    pub(super) pose: usize,
    /// The largest distance between two points of its base \[m\].
    pub(super) base_width_m: f64,
    /// Below this share of gravity, no horizontal acceleration lifts it; 0 where that is not known.
    pub(super) quiet_ratio: f64,
    /// Whether waves displace its base, so that it does not rest as it stands.
    pub(super) is_uneven: bool,
}

/// Points nearer to the floor than this are on it, and a base is flat where no other point is nearer than this
/// \[m\].
const ON_FLOOR_M: f64 = 1e-5;
const OFF_FLOOR_M: f64 = 5e-3;

/// What is nearer to the floor than this belongs to the underside of a scanned body \[m\].
const UNDERSIDE_M: f64 = 0.05;

/// A fifth of the acceleration that lifts a rigid body on the flat base that these points have, over gravity. Elastic
/// contacts amplify weak shaking, but what they lift then is less than a millimetre. 0 where the base is not flat.
fn quiet_ratio(points_m: &[Vector], pose: &StablePose) -> f64 {
    let depth_m = |point: &Vector| pose.cg_height_m - dot(point, &pose.down);
    let is_flat = points_m
        .iter()
        .map(depth_m)
        .all(|depth_m| !(ON_FLOOR_M..OFF_FLOOR_M).contains(&depth_m));
    if !is_flat {
        return 0.0;
    }
    let axes = pose.axes();
    let base = points_m.iter().filter(|point| depth_m(point) < ON_FLOOR_M);
    let base: Vec<[f64; 2]> = base
        .map(|point| [dot(point, &axes[0]), dot(point, &axes[1])])
        .collect();
    // The distance of the nearest edge is the least of these over all directions.
    let reach_m = |degrees: u32| {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let along = base.iter().map(|[x, y]| x * cos + y * sin);
        along.fold(0.0, f64::max)
    };
    let least_m = (0..360).map(reach_m).fold(f64::INFINITY, f64::min);
    0.2 * least_m / pose.cg_height_m
}

/// The largest distance between two points of the base \[m\].
fn base_width_m(points_m: &[Vector], pose: &StablePose) -> f64 {
    let is_base = |point: &&Vector| pose.cg_height_m - dot(point, &pose.down) < OFF_FLOOR_M;
    let base: Vec<&Vector> = points_m.iter().filter(is_base).collect();
    let of_pair = |a: &Vector, b: &Vector| {
        let apart = difference(a, b);
        dot(&apart, &apart).sqrt()
    };
    let pairs = base.iter().flat_map(|a| base.iter().map(|b| of_pair(a, b)));
    pairs.fold(0.0, f64::max)
}

impl HullBody {
    /// The body in one of its [stable poses](super::Hull::stable_poses); `None` where it has not so many.
    pub fn standing(&self, pose: usize) -> Option<Standing> {
        let poses = self.hull.stable_poses();
        let chosen = poses.get(pose)?;
        let points_m = self.hull.contact_points_m(chosen);
        Some(Standing {
            mass_kg: self.mass_kg,
            inertia_kg_m2: self.inertia_kg_m2,
            quiet_ratio: quiet_ratio(&points_m, chosen),
            base_width_m: base_width_m(&points_m, chosen),
            points_m,
            sides_m: self.hull.side_points_m(chosen),
            walls: Vec::new(),
            poses,
            pose,
            is_uneven: false,
        })
    }
}

impl Standing {
    /// The body with its lengths along its axes and its mass multiplied by factors.
    pub fn scaled(&self, lengths: [f64; 3], mass: f64) -> Self {
        let stretched = |v: &Vector| [0, 1, 2].map(|i| lengths[i] * v[i]);
        // C = ½ tr(J) I − J is the sum of m x xᵀ.
        let half_trace = |m: &[Vector; 3]| 0.5 * (m[0][0] + m[1][1] + m[2][2]);
        let half = half_trace(&self.inertia_kg_m2);
        let sums = [0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| {
                let of_trace = if i == j { half } else { 0.0 };
                mass * lengths[i] * lengths[j] * (of_trace - self.inertia_kg_m2[i][j])
            })
        });
        let trace = 2.0 * half_trace(&sums);
        let inertia_kg_m2 =
            [0, 1, 2].map(|i| [0, 1, 2].map(|j| if i == j { trace } else { 0.0 } - sums[i][j]));
        let posed = |pose: &StablePose| {
            let normal = [0, 1, 2].map(|i| pose.down[i] / lengths[i]);
            let size = dot(&normal, &normal).sqrt();
            StablePose {
                down: normal.map(|x| x / size),
                cg_height_m: pose.cg_height_m / size,
            }
        };
        let points_m: Vec<Vector> = self.points_m.iter().map(stretched).collect();
        let poses: Vec<StablePose> = self.poses.iter().map(posed).collect();
        Self {
            mass_kg: mass * self.mass_kg,
            inertia_kg_m2,
            quiet_ratio: quiet_ratio(&points_m, &poses[self.pose]),
            base_width_m: base_width_m(&points_m, &poses[self.pose]),
            points_m,
            sides_m: self.sides_m.iter().map(stretched).collect(),
            walls: self.walls.clone(),
            poses,
            pose: self.pose,
            is_uneven: self.is_uneven,
        }
    }

    /// The body with its centre of gravity higher by `up_m`, and with a base that waves displace: each is its wave vector
    /// along x and y of the body \[1/m\], its phase \[rad\] and its amplitude \[m\].
    pub fn uneven(&self, up_m: f64, waves: &[([f64; 2], f64, f64)]) -> Self {
        let down = self.pose().down;
        let displaced = |point: &Vector| {
            let depth_m = self.pose().cg_height_m - dot(point, &down);
            let wave = |([x, y], phase, amplitude_m): &([f64; 2], f64, f64)| {
                amplitude_m * (x * point[0] + y * point[1] + phase).cos()
            };
            let of_waves: f64 = match depth_m < UNDERSIDE_M {
                true => waves.iter().map(wave).sum(),
                false => 0.0,
            };
            [0, 1, 2].map(|i| point[i] + (up_m + of_waves) * down[i])
        };
        let posed = |pose: &StablePose| StablePose {
            cg_height_m: pose.cg_height_m + up_m * dot(&pose.down, &down),
            ..*pose
        };
        let points_m: Vec<Vector> = self.points_m.iter().map(displaced).collect();
        let mut poses: Vec<StablePose> = self.poses.iter().map(posed).collect();
        if !waves.is_empty() {
            // It settles from where its lowest point touches the floor: one that began below the floor by the height of
            // a wave would be thrown up.
            poses[self.pose].cg_height_m = height_m(&points_m, &down);
        }
        let quiet_ratio = match waves.is_empty() {
            true => quiet_ratio(&points_m, &poses[self.pose]),
            false => 0.0,
        };
        Self {
            quiet_ratio,
            points_m,
            sides_m: self.sides_m.iter().map(displaced).collect(),
            poses,
            is_uneven: !waves.is_empty(),
            ..self.clone()
        }
    }

    /// The largest distance between two points of its base \[m\].
    pub fn base_width_m(&self) -> f64 {
        self.base_width_m
    }

    /// The same body with walls beside it.
    #[must_use]
    pub fn beside(mut self, walls: Vec<HullWall>) -> Self {
        self.walls = walls;
        self
    }

    /// The walls beside it.
    pub fn walls(&self) -> &[HullWall] {
        &self.walls
    }

    /// Its mass \[kg\].
    pub fn mass_kg(&self) -> f64 {
        self.mass_kg
    }

    /// The points on which it is followed \[m\].
    pub fn points_m(&self) -> &[Vector] {
        &self.points_m
    }

    /// The points with which it meets walls \[m\].
    #[cfg(test)]
    pub(super) fn sides(&self) -> &[Vector] {
        &self.sides_m
    }

    /// The points that carry it at rest, for the length of a step.
    pub(super) fn carried_by(&self, sinking_m: f64) -> usize {
        let pose = self.pose();
        let reach_m = pose.cg_height_m - 3.0 * sinking_m;
        let is_low = |point: &&Vector| dot(point, &pose.down) > reach_m;
        self.points_m.iter().filter(is_low).count().max(3)
    }

    /// Whether it has the pose in which it stands: what was read from a file may have none.
    pub fn has_its_pose(&self) -> bool {
        self.pose < self.poses.len()
    }

    /// All its stable poses, the most upright first.
    pub fn poses(&self) -> &[StablePose] {
        &self.poses
    }

    /// The pose.
    pub fn pose(&self) -> &StablePose {
        &self.poses[self.pose]
    }

    /// The stable pose that is nearest to a direction which is down.
    pub(super) fn nearest(&self, down: &Vector) -> usize {
        let along = |index: &usize| dot(&self.poses[*index].down, down);
        (0..self.poses.len())
            .max_by(|a, b| along(a).total_cmp(&along(b)))
            .unwrap_or(self.pose)
    }
}
