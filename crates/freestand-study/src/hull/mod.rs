//! One history of a body on the points of its hull, in three dimensions.

pub mod body;

use std::sync::Arc;

use freestand::hull::barrier::Barrier;
use freestand::hull::poses::StablePose;
use freestand::hull::shake::{
    Contact, HullOutcome, HullPoint, HullRocking, Sampling, shake_observed,
};
use freestand::hull::standing::Standing;
use freestand::hull::wall::HullWall;
use freestand::hull::{Hull, HullBody, HullError, Vector};
use freestand::motion::Motion;
use freestand::respond::SpatialPoint;
use freestand::spatial::SpatialMotion;
use freestand_input::problem::Problem;
use freestand_input::words::number;
use freestand_output::answer;
use freestand_scan::mesh::Mesh;
use serde::{Deserialize, Serialize};

use crate::doubt::{BesideWall, HistoryDoubt, HistoryNote, NarrowBase};
use crate::walls::GivenCushion;

/// A scan that is turned by more than this before it stands is said to be \[rad\].
const TURNED_RAD: f64 = 0.035;

/// A body whose barrier is that of a block of this slenderness angle hardly stands \[rad\]: what it takes to
/// overturn a block of it is 0.03 g.
const HARDLY_RAD: f64 = 0.03;

/// What the shape of a body was taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BodyKind {
    /// A rectangular base.
    Box,
    /// A round base.
    Cylinder,
    /// A regular polygon.
    Polygon,
    /// Given feet.
    OnFeet,
    /// A scan, with its underside.
    Scan,
    /// A scan whose underside is taken to be flat.
    ScanOnFlatBase,
    /// A scan on given feet.
    ScanOnFeet,
}

impl BodyKind {
    /// Whether nobody measured the side on which it stands.
    pub fn is_unseen(self) -> bool {
        matches!(self, Self::ScanOnFlatBase | Self::ScanOnFeet)
    }

    /// Whether it was scanned.
    pub fn is_scan(self) -> bool {
        self.is_unseen() || self == Self::Scan
    }

    /// Its shape in every output.
    pub fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Cylinder => "cylinder",
            Self::Polygon => "polygon",
            Self::OnFeet => "feet",
            Self::Scan => "scan",
            Self::ScanOnFlatBase => "scan-flat-base",
            Self::ScanOnFeet => "scan-on-feet",
        }
    }
}

/// Triangles to be drawn, about the centre of gravity of a body, in the axes in which it was given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Their vertices \[m\].
    pub vertices_m: Vec<[f32; 3]>,
    /// Of each triangle, the numbers of its vertices.
    pub faces: Vec<[u32; 3]>,
}

impl Surface {
    /// The triangles of a mesh of which one unit has so many metres.
    pub(crate) fn of_mesh(mesh: &Mesh, unit_m: f64, cg_m: Vector) -> Self {
        let about_cg = |vertex: &[f64; 3]| [0, 1, 2].map(|i| (unit_m * vertex[i] - cg_m[i]) as f32);
        Self {
            vertices_m: mesh.vertices.iter().map(about_cg).collect(),
            faces: mesh.faces.clone(),
        }
    }

    /// The triangles of a hull.
    pub fn of_hull(hull: &Hull) -> Self {
        let vertices = hull.vertices_m().iter();
        let faces = hull.faces().iter();
        Self {
            vertices_m: vertices.map(|vertex| vertex.map(|x| x as f32)).collect(),
            faces: faces.map(|face| face.map(|one| one as u32)).collect(),
        }
    }
}

/// A body in the pose in which it stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyInPose {
    /// What its shape was taken from.
    pub kind: BodyKind,
    /// The body as it is followed.
    pub standing: Standing,
    /// The hill that its centre of gravity must climb.
    pub barrier: Barrier,
    /// Its volume \[m³\].
    pub volume_m3: f64,
    /// Whether the hull of a scan with holes takes its place.
    pub is_hull_of_scan: bool,
    /// Its mass, where it is known \[kg\].
    pub mass_kg: Option<f64>,
    /// The number of its pose, from 1.
    pub pose: usize,
    /// Its height \[m\].
    pub height_m: f64,
    /// Its outer sizes along the axes in which it stands, x and y \[m\].
    pub plan_m: [f64; 2],
    /// How far the surface of a scan may be from the true one \[m\].
    pub scan_error_m: f64,
    /// Whether the height of the centre of gravity of a scan was stated; else it is that of a uniform body.
    pub is_cg_stated: bool,
    /// What it looks like.
    pub surface: Surface,
}

/// Contact points this near to the floor are corners of a flat base \[m\].
const FLAT_M: f64 = 1e-5;

/// A flat base so many times narrower than the body may be a part of the true one: a scan of 300 mm that is tilted by
/// 2° has a strip of 57 mm within 2 mm of its lowest point.
const NARROW_RATIO: f64 = 4.0;

/// The height of the centre of gravity from which on contacts sink as far as those of the rocks of the tests; those of
/// smaller bodies sink less, in proportion \[m\].
const OF_FULL_SINKING_M: f64 = 0.25;

/// How far the contacts of a manufactured base sink, over those of a stone: with as much, a cylinder of 1.5 m would fall 5 %
/// below the acceleration that lifts it.
const MANUFACTURED_RATIO: f64 = 0.1;

impl BodyInPose {
    /// Thickness of the symmetric block of its height whose centre of gravity, as high as its own, must climb as far
    /// \[m\].
    pub fn thickness_m(&self) -> f64 {
        2.0 * self.standing.pose().cg_height_m * self.barrier.angle_rad().tan()
    }

    /// What it is.
    pub fn answer(&self) -> BodyAnswer {
        BodyAnswer::of(self)
    }

    /// How far the body is turned to stand, where nobody chose a pose \[rad\].
    pub fn turned_rad(&self) -> Option<f64> {
        let turned_rad = self.standing.pose().tilt().0;
        (self.pose == 1 && turned_rad > TURNED_RAD).then_some(turned_rad)
    }

    /// Of a scan whose underside is taken to be flat: how wide that is where it is narrowest, where the
    /// body is more than four times as wide in this direction: the scan may be tilted, so that a
    /// part of its base alone is at its lowest point. `None`: it is not.
    pub fn narrow_base(&self) -> Option<NarrowBase> {
        if self.kind != BodyKind::ScanOnFlatBase {
            return None;
        }
        let pose = self.standing.pose();
        let [x, y, _] = pose.axes();
        let dot = |a: &Vector, b: &Vector| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
        let depth_m = |point: &&Vector| pose.cg_height_m - dot(point, &pose.down);
        let points = self.standing.points_m();
        let base: Vec<&Vector> = points.iter().filter(|one| depth_m(one) < FLAT_M).collect();
        let width_m = |along: [f64; 2]| {
            let of = |point: &&Vector| along[0] * dot(point, &x) + along[1] * dot(point, &y);
            let (low, high) = base
                .iter()
                .map(of)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), one| {
                    (low.min(one), high.max(one))
                });
            high - low
        };
        let in_direction = |degrees: u32| {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            // The width of an ellipse with these axes, which is not more than that of the rectangle around it.
            let plan_m = (cos * self.plan_m[0]).hypot(sin * self.plan_m[1]);
            (width_m([cos, sin]), plan_m)
        };
        (0..180)
            .map(in_direction)
            .min_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)))
            .filter(|(base_m, plan_m)| base_m * NARROW_RATIO < *plan_m)
            .map(|(base_m, plan_m)| NarrowBase { base_m, plan_m })
    }

    /// How far its contacts sink, over how far those of the rocks of the tests on a shake table do.
    pub fn sinking_ratio(&self) -> f64 {
        let of_size = (self.barrier.rest_m / OF_FULL_SINKING_M).min(1.0);
        match self.kind.is_scan() {
            true => of_size,
            false => of_size * MANUFACTURED_RATIO,
        }
    }

    /// A body in its stable pose of this number, from 1; 1 is the most upright one.
    ///
    /// # Errors
    /// A body without this pose, or that stands nowhere near upright.
    pub fn new(
        body: &HullBody,
        kind: BodyKind,
        volume_m3: f64,
        is_hull_of_scan: bool,
        mass_kg: Option<f64>,
        pose: usize,
        scan_error_m: f64,
    ) -> Result<Self, Problem> {
        if pose == 1 {
            body.hull.standing().map_err(cannot_stand)?;
        }
        let Some(standing) = pose.checked_sub(1).and_then(|at| body.standing(at)) else {
            let count = body.hull.stable_poses().len();
            let message = format!("there is no stable pose {pose}: the body has {count}");
            return Err(Problem::value(
                message,
                format!("give a number from 1 to {count}"),
            ));
        };
        let barrier = body.hull.barrier(standing.pose());
        let standing_down = standing.pose().down;
        let [x, y, _] = standing.pose().axes();
        let plan_m = [x, y].map(|axis| extent_m(body, axis));
        Ok(Self {
            kind,
            standing,
            barrier,
            volume_m3,
            is_hull_of_scan,
            mass_kg,
            pose,
            height_m: extent_m(body, standing_down),
            plan_m,
            scan_error_m,
            is_cg_stated: false,
            surface: Surface::of_hull(&body.hull),
        })
    }
}

/// The extent of a body in a direction \[m\].
fn extent_m(body: &HullBody, toward: Vector) -> f64 {
    let back = toward.map(|x| -x);
    body.hull.height_m(&toward) + body.hull.height_m(&back)
}

fn cannot_stand(error: HullError) -> Problem {
    let hint =
        "turn the scan so that z points upward, or choose one of its stable poses with `stand_on`";
    Problem::value(error.to_string(), hint)
}

/// A body under a motion.
#[derive(Debug, Clone)]
pub struct HullRequest {
    /// The body.
    pub body: Arc<BodyInPose>,
    /// How it touches the floor.
    pub contact: Contact,
    /// Where walls stand beside it: the angle from its x to its y \[rad\], and the gap \[m\].
    pub walls: Vec<(f64, f64)>,
    /// Their cushion, as far as it was given; else that of an edge of the body.
    pub wall_cushion: GivenCushion,
    /// Horizontal motions of the floor: the first, and the one to its left (at 90° anticlockwise, seen from
    /// above).
    pub motions: [Option<Motion>; 2],
    /// Vertical motion of the floor.
    pub vertical: Option<Motion>,
    /// How far the body is turned from the first motion, anticlockwise seen from above \[rad\].
    pub orientation_rad: f64,
    /// Gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// Whether the history is sampled.
    pub is_sampled: bool,
}

impl HullRequest {
    /// How the floor moves.
    pub(crate) fn motion(&self) -> SpatialMotion<'_> {
        let [x, y] = self.motions.each_ref().map(Option::as_ref);
        SpatialMotion {
            x,
            y,
            vertical: self.vertical.as_ref(),
        }
    }

    /// Stiffness of an edge of the body \[N/m\].
    fn edge_n_m(&self) -> f64 {
        let mass_kg = self.body.standing.mass_kg();
        self.contact.edge_n_m(mass_kg, self.gravity_m_s2)
    }

    /// k_w and ζ_w of its walls: what was given, else those of an edge and of the contacts.
    pub(crate) fn cushion(&self) -> (f64, f64) {
        let given = self.wall_cushion;
        (
            given.stiffness_n_m.map_or(self.edge_n_m(), |given_n_m| {
                let mass_kg = self.body.standing.mass_kg();
                self.contact.wall_n_m(given_n_m, mass_kg, self.gravity_m_s2)
            }),
            given.damping_ratio.unwrap_or(self.contact.damping_ratio),
        )
    }

    /// The body beside its walls with this k_w and ζ_w.
    pub(crate) fn beside(&self, (stiffness_n_m, damping_ratio): (f64, f64)) -> Standing {
        let wall = |&(toward_rad, gap_m): &(f64, f64)| HullWall {
            toward_rad,
            gap_m,
            stiffness_n_m,
            damping_ratio,
        };
        let walls = self.walls.iter().map(wall).collect();
        self.body.standing.clone().beside(walls)
    }
}

answer! {
    /// A body, and the hill that it must climb to fall.
    pub struct BodyAnswer of (body: &BodyInPose) {
        shape: &'static str = body.kind.name() => "shape";
        mass_kg: Option<f64> => "mass";
        /// Its volume.
        volume_m3: f64;
        cg_height_m: f64 = body.standing.pose().cg_height_m => "height of the centre of gravity";
        tip_angle_rad: f64 = body.barrier.tilt_rad => "tilt at which it overturns over its weakest side";
        /// The slenderness angle of the symmetric block whose centre of gravity must climb as far.
        barrier_angle_rad: f64 = body.barrier.angle_rad() => "angle of the block with the same barrier";
        barrier_rise_m: f64 = body.barrier.rise_m => "  its centre of gravity rises until then by";
        weakest_direction_rad: Option<f64> =
            (body.kind != BodyKind::Cylinder).then_some(body.barrier.toward_rad) => "direction of its weakest side, from x to y";
        /// The points on which it is followed, from the centre of gravity, in the axes in which it was given.
        contact_points: Vec<Vec<f64>> = body.standing.points_m().iter().map(|point| point.to_vec()).collect();
        /// The number of the stable pose in which it stands.
        pose: usize;
        /// The poses in which it could stand, the most upright first.
        stable_poses: Vec<PoseAnswer> = poses(body).iter().map(PoseAnswer::of).collect();
        /// Whether the convex hull of a scan takes its place.
        is_hull_of_scan: bool;
    }

    /// A pose in which a body stands.
    pub struct PoseAnswer of (pose: &StablePose) {
        /// Its tilt from the axes in which the body was given.
        tilt_rad: f64 = pose.tilt().0;
        /// The direction of that tilt.
        toward_rad: f64 = pose.tilt().1;
        /// Height of the centre of gravity.
        cg_height_m: f64;
    }

    /// What a body did under a motion.
    pub struct HullRun of (rocking: &HullRocking, request: &HullRequest) {
        outcome: &'static str = outcome_name(rocking.outcome) => "outcome";
        shifted_to: Option<usize> = shifted_to(rocking.outcome) => "comes to rest in stable pose";
        end_time_s: f64 = rocking.end_s => "end";
        peak_tilt_rad: f64 => "largest tilt";
        /// The largest tilt divided by that at which it tips over its weakest side.
        peak_tilt_ratio: f64 = rocking.peak_tilt_rad / request.body.barrier.tilt_rad
            => "  divided by that at which it overturns";
        peak_tilt_time_s: f64 => "  at";
        uplift_m: f64 => "uplift of a point of the base";
        cg_rise_m: f64 => "rise of the centre of gravity";
        overturn_time_s: Option<f64> =
            (rocking.outcome == HullOutcome::Overturned).then_some(rocking.end_s) => "overturns";
        moved_x_m: f64 = rocking.moved_m[0] => "displacement of the centre of gravity, along the motion";
        moved_y_m: f64 = rocking.moved_m[1] => "  across it";
        wall_impact_count: Option<usize> =
            (!request.walls.is_empty()).then_some(rocking.wall_contacts) => "contacts with walls";
        wall_speed_max_m_s: Option<f64> =
            (rocking.wall_contacts > 0).then_some(rocking.wall_speed_m_s) => "  largest speed";
    }

    /// What a body on its hull did.
    pub struct HullAnswer of (rocking: &HullRocking, request: &HullRequest) {
        run: HullRun = HullRun::of(rocking, request) => flat;
        set: HullSetting = HullSetting::of(request) => flat;
    }

    /// A body and how it is followed, the same under every motion.
    pub struct HullSetting of (request: &HullRequest) {
        /// What the body stands on.
        base: &'static str = "stiff";
        /// How it is followed.
        model: &'static str = "hull-3d";
        /// The body.
        body: BodyAnswer = BodyAnswer::of(&request.body);
        friction_ratio: f64 = request.contact.friction_ratio => "friction";
        contact_damping_ratio: f64 = request.contact.damping_ratio => "damping of the contacts";
        contact_sinking_m: f64 = request.contact.sinking_m => "static compression of three contacts";
        /// Coefficient of rolling friction of a cylinder on its rim.
        rolling_friction_ratio: f64 = request.contact.rolling_ratio;
        /// How far the body is turned from the first motion, anticlockwise from above.
        orientation_rad: f64 = request.orientation_rad;
        /// Whether the probability that such a body falls is known to be too low.
        model_bias: bool = true;
    }
}

/// All poses of a scan; another shape stands upright.
fn poses(body: &BodyInPose) -> &[StablePose] {
    match body.kind.is_scan() {
        true => body.standing.poses(),
        false => std::slice::from_ref(body.standing.pose()),
    }
}

fn outcome_name(outcome: HullOutcome) -> &'static str {
    match outcome {
        HullOutcome::Stood => "stood",
        HullOutcome::Shifted(_) => "shifted",
        HullOutcome::Overturned => "overturned",
        HullOutcome::Leaned => "leaned",
        HullOutcome::Unresolved | HullOutcome::Unsettled => "unresolved",
    }
}

fn shifted_to(outcome: HullOutcome) -> Option<usize> {
    match outcome {
        HullOutcome::Shifted(pose) => Some(pose + 1),
        _ => None,
    }
}

/// What a single history of such a body is worth.
fn notes(body: &BodyInPose) -> Vec<HistoryNote> {
    let is_untested = matches!(
        body.kind,
        BodyKind::Cylinder | BodyKind::Polygon | BodyKind::OnFeet
    );
    let is_flat = body.kind == BodyKind::ScanOnFlatBase;
    [HistoryNote::OneRealisation, HistoryNote::Underestimates]
        .into_iter()
        .chain(is_untested.then_some(HistoryNote::Untested))
        .chain(is_flat.then_some(HistoryNote::FlatUnderside))
        .chain(body.turned_rad().map(HistoryNote::Turned))
        .chain(body.is_hull_of_scan.then_some(HistoryNote::HullOfScan))
        .collect()
}

/// What a body did.
#[derive(Debug, Clone, PartialEq)]
pub struct HullReport {
    /// What it did.
    pub answer: HullAnswer,
    /// What may make it wrong.
    pub doubts: Vec<HistoryDoubt>,
    /// What its reader must know.
    pub notes: Vec<HistoryNote>,
    /// Where it was at the samples of the motion; empty if not sampled.
    pub history: Vec<HullPoint>,
}

pub(crate) fn not_followed(error: HullError) -> Problem {
    let hint = match error {
        HullError::Motion => "resample one of them to the step and length of the other first",
        _ => "check the contacts, the walls and the mass",
    };
    Problem::value(error.to_string(), hint)
}

/// Calculates the motion of a body on its hull.
///
/// # Errors
/// Motions that differ in step or length; a body that does not come to rest before it is shaken.
pub fn rock_on_hull(request: &HullRequest) -> Result<HullReport, Problem> {
    let motion = request.motion();
    let mut history = Vec::new();
    let mut beside = |cushion: (f64, f64), is_sampled: bool| {
        let rocking = shake_observed(
            &request.beside(cushion),
            &request.contact,
            request.orientation_rad,
            &motion,
            request.gravity_m_s2,
            Sampling::WHOLE,
            &mut |point| {
                if is_sampled {
                    history.push(point);
                }
            },
        );
        rocking.map_err(not_followed)
    };
    let rocking = beside(request.cushion(), request.is_sampled)?;
    if rocking.outcome == HullOutcome::Unsettled {
        let message = format!(
            "the body does not come to rest in its pose before the floor moves: it falls if its centre of gravity rises \
             by only {} mm",
            number(1e3 * request.body.barrier.rise_m, 2)
        );
        return Err(Problem::value(
            message,
            "choose another stable pose with `stand_on`, or a smaller `contact_sinking`",
        ));
    }
    let edge_n_m = request.edge_n_m();
    let ends = request.wall_cushion.ends(edge_n_m);
    let mut doubts = Vec::new();
    if let Some(ends) = ends.filter(|_| !request.walls.is_empty()) {
        let [soft, stiff] = ends.map(|cushion| -> Result<BesideWall, Problem> {
            let found = beside(cushion, false)?;
            Ok(BesideWall {
                stiffness_ratio: cushion.0 / edge_n_m,
                damping_ratio: cushion.1,
                outcome: outcome_name(found.outcome),
                tilt_rad: found.peak_tilt_rad,
            })
        });
        doubts.push(HistoryDoubt::WallCushionAssumed([soft?, stiff?]));
    }
    let barrier = &request.body.barrier;
    let hardly = (barrier.angle_rad() < HARDLY_RAD).then_some(barrier.rise_m);
    let is_open = rocking.outcome == HullOutcome::Unresolved;
    doubts.extend(request.body.narrow_base().map(HistoryDoubt::NarrowBase));
    doubts.extend(hardly.map(HistoryDoubt::HardlyStands));
    doubts.extend(is_open.then_some(HistoryDoubt::UnresolvedOnHull));
    Ok(HullReport {
        answer: HullAnswer::of(&rocking, request),
        doubts,
        notes: notes(&request.body),
        history,
    })
}

/// A point of a history as that of an object on cushions is written.
pub fn spatial_point(point: &HullPoint) -> SpatialPoint {
    SpatialPoint {
        time_s: point.time_s,
        tilts_rad: point.tilts_rad,
        yaw_rad: point.yaw_rad,
        base_m: point.base_m,
    }
}

#[cfg(test)]
mod tests {
    use freestand_scan::body::Leaking;

    use super::body::Scan;
    use super::*;

    /// A frustum of 300 × 300 mm at the top, 400 mm high, on a square base.
    fn on_base(side_m: f64) -> BodyInPose {
        let corners = |side_m: f64, z_m: f64| {
            [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
                .map(|(x, y)| [x * side_m, y * side_m, z_m])
        };
        let vertices = [corners(side_m, 0.0), corners(0.3, 0.4)].concat();
        let side = |at: usize| {
            let next = (at + 1) % 4;
            [[at, next, 4 + next], [at, 4 + next, 4 + at]]
        };
        let mut faces = vec![[0, 3, 2], [0, 2, 1], [4, 5, 6], [4, 6, 7]];
        faces.extend((0..4).flat_map(side));
        let scan = Scan {
            unit_m: 1.0,
            base: None,
            error_m: None,
            leaking: Leaking::Refuse,
            feet_m: None,
            pose: 1,
            cg_height_m: None,
            mass_kg: None,
        };
        scan.body(&Mesh::of_triangles(&vertices, &faces).unwrap())
            .unwrap()
    }

    #[test]
    fn a_narrow_flat_base_is_said() {
        let NarrowBase { base_m, plan_m } = on_base(0.06).narrow_base().unwrap();
        assert!((base_m - 0.06).abs() < 1e-9, "{base_m}");
        assert!((plan_m - 0.3).abs() < 1e-9, "{plan_m}");
        assert_eq!(on_base(0.09).narrow_base(), None);
    }
}
