//! The history of a body in three dimensions as it is drawn.

use freestand::hull::HullError;
use freestand::hull::shake::{HullOutcome, HullPoint, Sampling, shake_observed};
use freestand::respond::{OnHull, Outcome};
use freestand::spatial::SpatialMotion;
use freestand_input::problem::Problem;

use crate::drawn::{
    ACCELERATION_RATIO, DrawnHistory, DrawnSpace, THINNING_RATIO, TOLERANCE_RAD, thinned,
};
use crate::hull::{BodyInPose, BodyKind, HullRequest, not_followed};

/// No place that is drawn is off by more than this \[m\].
const TOLERANCE_M: f64 = 1e-4;

/// Between two points that the solver passes \[s\]: contacts that sink 0.01 mm swing with 1000 rad/s; after a change
/// of 0.3 rad/s in half a period, a straight line is off by ω̇ h²/8 = 3e-6 rad, a thirtieth of what thinning leaves
/// of the tolerance.
const APART_S: f64 = 5e-4;

/// The values of a point: the quaternion, the place, the tilt.
const VALUES: usize = 8;

/// The decimals that are handed out: of a quaternion, 4e-7 rad, and a micrometre.
const TURN_DECIMALS: f64 = 1e7;
const PLACE_DECIMALS: f64 = 1e6;

/// How the surface of a body becomes that of the body which is followed.
#[derive(Debug, Clone, Copy)]
pub struct Drawing {
    /// Its lengths over those that were given.
    pub scale_ratio: [f64; 3],
    /// How far it is then from its centre of gravity, besides \[m\].
    pub shift_m: [f64; 3],
}

impl Drawing {
    /// The body as it was given.
    pub const AS_GIVEN: Self = Self {
        scale_ratio: [1.0; 3],
        shift_m: [0.0; 3],
    };
}

/// The history of a body, which is calculated for it. `is_whole`: as by [`shake_observed`], in place of the steps by
/// which it is decided whether the body falls.
///
/// # Errors
/// As for [`shake_observed`].
pub fn drawn_body(
    body: &BodyInPose,
    on: &OnHull,
    drawing: Drawing,
    motion: &SpatialMotion<'_>,
    gravity_m_s2: f64,
    is_whole: bool,
) -> Result<DrawnHistory, HullError> {
    let sampling = Sampling {
        is_whole,
        apart_s: APART_S,
    };
    let mut points: Vec<(f64, [f64; VALUES])> = Vec::new();
    let mut see = |point: HullPoint| {
        let ([w, x, y, z], [to_x, to_y, to_z]) = (point.turn, point.cg_m);
        let values = [w, x, y, z, to_x, to_y, to_z, point.tilts_rad[2]];
        // It rests until the first point that was passed.
        if points.is_empty() && point.time_s > 0.0 {
            points.push((0.0, values));
        }
        if points.last().is_none_or(|last| last.0 < point.time_s) {
            points.push((point.time_s, values));
        }
    };
    let (standing, yaw_rad) = (&on.body, on.yaw_rad);
    let rocking = shake_observed(
        standing,
        &on.contact,
        yaw_rad,
        motion,
        gravity_m_s2,
        sampling,
        &mut see,
    )?;
    // An error of ε in each of four values turns it by 4 ε at most; one in each of three moves it by √3 ε.
    let [turn, tilt] = [0.25, 1.0].map(|part| part * THINNING_RATIO * TOLERANCE_RAD);
    let place = THINNING_RATIO * TOLERANCE_M / 3.0f64.sqrt();
    let tolerances = [turn, turn, turn, turn, place, place, place, tilt];
    let (time_s, [w, x, y, z, to_x, to_y, to_z, theta_rad]) =
        thinned(&points, tolerances, |_| false);
    let rounded = |values: Vec<f64>, decimals: f64| -> Vec<f64> {
        let of = |value: f64| (value * decimals).round() / decimals;
        values.into_iter().map(of).collect()
    };
    let (base_time_s, [base_accel_m_s2, base_accel_y_m_s2]) = floor(motion);
    let outcome = match (rocking.outcome, Outcome::on_hull(&rocking)) {
        (HullOutcome::Shifted(_), _) => "shifted",
        (HullOutcome::Unsettled, _) => "unresolved",
        (_, Outcome::Overturned) => "overturned",
        (_, Outcome::Unresolved) => "unresolved",
        (_, Outcome::Leaned) => "leaned",
        (_, Outcome::Rocked { .. }) => "rocked",
        (_, Outcome::Stood | Outcome::Rolled(_) | Outcome::Slid(_)) => "no-uplift",
    };
    let is_round = body.kind == BodyKind::Cylinder;
    Ok(DrawnHistory {
        time_s,
        theta_rad: rounded(theta_rad, TURN_DECIMALS),
        base_time_s,
        base_accel_m_s2,
        impacts: Vec::new(),
        tolerance_rad: TOLERANCE_RAD,
        outcome,
        base: "stiff",
        height_m: body.height_m,
        thickness_m: standing.base_width_m(),
        base_width_m: standing.base_width_m(),
        cg_height_m: standing.pose().cg_height_m,
        balance_rad: body.barrier.tilt_rad,
        wall_left: None,
        wall_right: None,
        space: Some(DrawnSpace {
            place_m: [to_x, to_y, to_z].map(|values| rounded(values, PLACE_DECIMALS)),
            turn: [w, x, y, z].map(|values| rounded(values, TURN_DECIMALS)),
            scale_ratio: drawing.scale_ratio,
            shift_m: drawing.shift_m,
            base_accel_y_m_s2,
            weakest_rad: (!is_round).then_some(yaw_rad + body.barrier.toward_rad),
            tolerance_m: TOLERANCE_M,
        }),
    })
}

/// What [`rock_on_hull`](crate::hull::rock_on_hull) calculates, as it is drawn.
///
/// # Errors
/// As for that.
pub fn drawn_of_hull(request: &HullRequest) -> Result<DrawnHistory, Problem> {
    let on = OnHull {
        body: request.beside(request.cushion()),
        contact: request.contact,
        yaw_rad: request.orientation_rad,
    };
    let (motion, gravity_m_s2) = (request.motion(), request.gravity_m_s2);
    let drawing = Drawing::AS_GIVEN;
    drawn_body(&request.body, &on, drawing, &motion, gravity_m_s2, true).map_err(not_followed)
}

/// Both components of the acceleration of the floor.
fn floor(motion: &SpatialMotion<'_>) -> (Vec<f64>, [Vec<f64>; 2]) {
    let both = [motion.x, motion.y];
    let any = both.into_iter().flatten().next();
    let (count, dt_s) = any.map_or((0, 0.0), |one| (one.accel_m_s2().len(), one.dt_s()));
    let at = |i: usize| {
        both.map(|one| {
            one.and_then(|one| one.accel_m_s2().get(i).copied())
                .unwrap_or(0.0)
        })
    };
    let samples: Vec<(f64, [f64; 2])> = (0..count).map(|i| (i as f64 * dt_s, at(i))).collect();
    let all = samples.iter().flat_map(|(_, both)| both);
    let peak_m_s2 = all.fold(0.0f64, |most, accel| most.max(accel.abs()));
    thinned(&samples, [ACCELERATION_RATIO * peak_m_s2; 2], |_| false)
}

#[cfg(test)]
mod tests {
    use freestand::hull::shake::Contact;
    use freestand::hull::shapes::{Outline, upright};
    use freestand::motion::Motion;

    use super::*;

    fn at(times: &[f64], values: &[f64], time: f64) -> f64 {
        let next = times
            .partition_point(|one| *one < time)
            .clamp(1, times.len() - 1);
        let ([t0, t1], [y0, y1]) = (
            [times[next - 1], times[next]],
            [values[next - 1], values[next]],
        );
        y0 + (y1 - y0) * (time - t0) / (t1 - t0)
    }

    /// Against the history at every step: no angle and no place is off by more than is said.
    #[test]
    fn what_is_drawn_is_the_history() {
        let outline = Outline::Polygon(6, 0.3);
        let (solid, volume_m3) = upright(&outline, 0.9, 40.0, None, None).unwrap();
        let kind = BodyKind::Polygon;
        let body = BodyInPose::new(&solid, kind, volume_m3, false, None, 1, 0.0).unwrap();
        let wave = |hz: f64, peak: f64| {
            let at = |i: i32| peak * (std::f64::consts::TAU * hz * 0.01 * f64::from(i)).sin();
            Motion::new(0.01, (0..300).map(at).collect()).unwrap()
        };
        let (along, across) = (wave(1.1, 5.5), wave(0.7, 4.0));
        let motion = SpatialMotion {
            x: Some(&along),
            y: Some(&across),
            vertical: None,
        };
        let on = OnHull {
            body: body.standing.clone(),
            contact: Contact {
                sinking_m: 1e-5,
                ..Contact::default()
            },
            yaw_rad: 0.4,
        };
        let drawn = drawn_body(&body, &on, Drawing::AS_GIVEN, &motion, 9.81, false).unwrap();
        let space = drawn.space.as_ref().unwrap();
        let mut points = Vec::new();
        let sampling = Sampling {
            is_whole: false,
            apart_s: 0.0,
        };
        let mut see = |point: HullPoint| points.push(point);
        let (standing, contact) = (&on.body, &on.contact);
        shake_observed(standing, contact, 0.4, &motion, 9.81, sampling, &mut see).unwrap();
        assert!(drawn.theta_rad.iter().any(|tilt| *tilt > 0.1), "it rocks");
        assert!(drawn.time_s.len() * 20 < points.len(), "it is thinned");
        assert!(drawn.time_s.windows(2).all(|two| two[0] < two[1]));
        let (mut turned_rad, mut moved_m, mut tilted_rad) = (0.0f64, 0.0f64, 0.0f64);
        let last_s = drawn.time_s.last().unwrap();
        for point in points.iter().filter(|point| point.time_s <= *last_s) {
            let of = |values: &Vec<f64>| at(&drawn.time_s, values, point.time_s);
            let turn = space.turn.each_ref().map(of);
            let size = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
            let cos = (0..4).map(|i| turn[i] * point.turn[i] / size).sum::<f64>();
            // 1 − cos² of the half angle, which is small.
            let sin2 = (0..4).map(|i| (turn[i] / size - cos * point.turn[i]).powi(2));
            turned_rad = turned_rad.max(2.0 * sin2.sum::<f64>().sqrt());
            let place = space.place_m.each_ref().map(of);
            let off = (0..3).map(|i| (place[i] - point.cg_m[i]).powi(2));
            moved_m = moved_m.max(off.sum::<f64>().sqrt());
            tilted_rad = tilted_rad.max((of(&drawn.theta_rad) - point.tilts_rad[2]).abs());
        }
        assert!(turned_rad <= TOLERANCE_RAD, "{turned_rad}");
        assert!(tilted_rad <= TOLERANCE_RAD, "{tilted_rad}");
        assert!(moved_m <= TOLERANCE_M, "{moved_m}");
    }
}
