//! A history as it is drawn: few points, from which no angle is off by more than a tolerance.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand::compliant::EdgeSide;
use freestand::motion::Motion;
use freestand::respond::{PadHistory, RigidHistory, RigidPlane};
use freestand::rocking::Side;
use freestand::wall::Wall;
use serde::Serialize;

use crate::rock::EdgeLanding;

/// No angle that is drawn is off by more than this \[rad\]: 0.02°, a third of a millimetre at the top of
/// an object of 1 m.
pub const TOLERANCE_RAD: f64 = 0.02 * std::f64::consts::PI / 180.0;

/// The part of the tolerance that thinning may use. The rest is for the curve between two samples:
/// p² h²/8 = 5e-5 rad for p = 4 rad/s and samples at 5 ms.
pub(crate) const THINNING_RATIO: f64 = 0.75;

/// The part of its peak by which the acceleration of the floor may be off, which is drawn as an arrow.
pub(crate) const ACCELERATION_RATIO: f64 = 0.005;

/// A history, piecewise linear in time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnHistory {
    /// Times, each later than the one before \[s\].
    pub time_s: Vec<f64>,
    /// θ at these times, positive about the right edge \[rad\].
    pub theta_rad: Vec<f64>,
    /// Times of the acceleration \[s\].
    pub base_time_s: Vec<f64>,
    /// Acceleration of the floor \[m/s²\].
    pub base_accel_m_s2: Vec<f64>,
    /// Every impact on the floor.
    pub impacts: Vec<DrawnImpact>,
    /// No angle is off by more than this \[rad\].
    pub tolerance_rad: f64,
    /// `rocked`, `overturned` …
    pub outcome: &'static str,
    /// `rigid` or `compliant`: what the object stands on.
    pub base: &'static str,
    /// Height of the block \[m\].
    pub height_m: f64,
    /// Its side in the plane of the motion \[m\].
    pub thickness_m: f64,
    /// The distance between its edges \[m\].
    pub base_width_m: f64,
    /// Height of its centre of gravity \[m\].
    pub cg_height_m: f64,
    /// The angle at which it balances on an edge \[rad\].
    pub balance_rad: f64,
    /// The wall on its left, where θ < 0.
    pub wall_left: Option<DrawnWall>,
    /// The wall on its right.
    pub wall_right: Option<DrawnWall>,
    /// Where the object is, if it moves in three dimensions; θ is then its tilt in any direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub space: Option<DrawnSpace>,
}

/// Where a body in three dimensions is at the times of its history. A point p of its surface is then at
/// x + Q (s + S p), in the axes of the floor, z upward.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnSpace {
    /// x: its centre of gravity \[m\].
    pub place_m: [Vec<f64>; 3],
    /// Q: w, x, y, z of a quaternion.
    pub turn: [Vec<f64>; 4],
    /// S: its lengths in this history over those of the surface.
    pub scale_ratio: [f64; 3],
    /// s: how far the surface is from where it is given, about the centre of gravity \[m\].
    pub shift_m: [f64; 3],
    /// The second component of the acceleration of the floor, at the times of the first \[m/s²\].
    pub base_accel_y_m_s2: Vec<f64>,
    /// Where its weakest side is at rest, from x to y of the floor; `None`: it is round \[rad\].
    pub weakest_rad: Option<f64>,
    /// No place is off by more than this \[m\].
    pub tolerance_m: f64,
}

/// A wall beside an object.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DrawnWall {
    /// Distance from the face of the object \[m\].
    pub gap_m: f64,
    /// Height above the floor \[m\]; `None`: taller than the object.
    pub height_m: Option<f64>,
}

impl From<Wall> for DrawnWall {
    fn from(wall: Wall) -> Self {
        Self {
            gap_m: wall.gap_m,
            height_m: wall.height_m,
        }
    }
}

/// An impact on the floor.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DrawnImpact {
    /// Time \[s\].
    pub time_s: f64,
    /// Peak acceleration at the edge, from the speed of the impact \[g\]; `None` without mass and cushion.
    pub edge_acceleration_g: Option<f64>,
    /// The edge that lands.
    pub edge: &'static str,
}

/// A history on a rigid base that was sampled, with its impacts on the floor.
pub fn drawn(
    object: &RigidPlane,
    history: &RigidHistory,
    landings: &[EdgeLanding],
    floor: Option<&Motion>,
) -> DrawnHistory {
    let (block, rocking) = (&object.plane.block, &history.rocking);
    let impacts = landings.iter().map(|one| DrawnImpact {
        time_s: one.time_s,
        edge_acceleration_g: one.edge_acceleration_g,
        // Turning about the right edge (θ > 0), it comes back with ω < 0 and the left edge lands.
        edge: if one.omega_before_rad_s < 0.0 {
            Side::Left.name()
        } else {
            Side::Right.name()
        },
    });
    let samples = history.samples.iter();
    let points = rising(samples.map(|point| (point.time_s, point.theta_rad)));
    let outcome = (rocking.outcome.name(), "rigid");
    DrawnHistory {
        wall_left: object.walls.left.map(DrawnWall::from),
        wall_right: object.walls.right.map(DrawnWall::from),
        ..of_points(block, points, impacts.collect(), floor, outcome)
    }
}

/// A history on pads that was sampled, with every contact of an edge as an impact.
pub fn drawn_on_pads(block: &Block, history: &PadHistory, floor: Option<&Motion>) -> DrawnHistory {
    let rocking = &history.rocking;
    let impacts = rocking.touches.iter().map(|touch| DrawnImpact {
        time_s: touch.time_s,
        edge_acceleration_g: Some(touch.peak_acceleration_m_s2 / G0_M_S2),
        edge: match touch.edge {
            EdgeSide::Left => Side::Left.name(),
            EdgeSide::Right => Side::Right.name(),
        },
    });
    let samples = history.samples.iter();
    let points = rising(samples.map(|point| (point.time_s, point.theta_rad)));
    let outcome = (rocking.outcome.name(), "compliant");
    of_points(block, points, impacts.collect(), floor, outcome)
}

/// Both, from points with rising times.
fn of_points(
    block: &Block,
    points: Vec<(f64, f64)>,
    mut impacts: Vec<DrawnImpact>,
    floor: Option<&Motion>,
    (outcome, base): (&'static str, &'static str),
) -> DrawnHistory {
    impacts.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    let points = with_times(points, impacts.iter().map(|impact| impact.time_s));
    let points: Vec<(f64, [f64; 1])> = points.into_iter().map(|(t, y)| (t, [y])).collect();
    let mut at = impacts.iter().map(|impact| impact.time_s).peekable();
    let is_kept = |time_s: f64| {
        let mut is_one = false;
        while let Some(impact_s) = at.next_if(|impact_s| *impact_s <= time_s) {
            is_one |= impact_s == time_s;
        }
        is_one
    };
    let (time_s, [theta_rad]) = thinned(&points, [THINNING_RATIO * TOLERANCE_RAD], is_kept);
    let samples = floor.map(|motion| {
        let of = |(i, accel): (usize, &f64)| (i as f64 * motion.dt_s(), [*accel]);
        motion
            .accel_m_s2()
            .iter()
            .enumerate()
            .map(of)
            .collect::<Vec<_>>()
    });
    let samples = samples.unwrap_or_default();
    let peak_m_s2 = samples
        .iter()
        .fold(0.0f64, |most, (_, [accel])| most.max(accel.abs()));
    let (base_time_s, [base_accel_m_s2]) =
        thinned(&samples, [ACCELERATION_RATIO * peak_m_s2], |_| false);
    DrawnHistory {
        time_s,
        theta_rad,
        base_time_s,
        base_accel_m_s2,
        impacts,
        tolerance_rad: TOLERANCE_RAD,
        outcome,
        base,
        height_m: block.height_m(),
        thickness_m: block.thickness_m(),
        base_width_m: block.base_width_m(),
        cg_height_m: block.cg_height_m(),
        balance_rad: block.pivot().slenderness_angle_rad,
        wall_left: None,
        wall_right: None,
        space: None,
    }
}

/// The points, with those at these rising times between them.
fn with_times(points: Vec<(f64, f64)>, times: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
    let mut found = Vec::with_capacity(points.len());
    let mut times = times.peekable();
    for point in points {
        while let Some(time) = times.next_if(|time| *time < point.0) {
            if let Some(&(t0, y0)) = found.last()
                && t0 < time
            {
                found.push((time, y0 + (point.1 - y0) * (time - t0) / (point.0 - t0)));
            }
        }
        found.push(point);
    }
    found
}

/// Points with rising times: of several at one time, the first.
fn rising(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut found: Vec<(f64, f64)> = Vec::new();
    for point in points {
        if found.last().is_none_or(|last| last.0 < point.0) {
            found.push(point);
        }
    }
    found
}

/// The times and the values of the fewest of these points that one pass finds, so that the straight lines between them
/// are within the tolerances of all; those at times that `is_kept` names are among them. It is asked in the order of
/// time.
pub(crate) fn thinned<const N: usize>(
    points: &[(f64, [f64; N])],
    tolerances: [f64; N],
    mut is_kept: impl FnMut(f64) -> bool,
) -> (Vec<f64>, [Vec<f64>; N]) {
    const OPEN: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
    let (mut times, mut values) = (Vec::new(), [const { Vec::new() }; N]);
    let Some((&first, rest)) = points.split_first() else {
        return (times, values);
    };
    let mut keep = |(time, all): (f64, [f64; N])| {
        times.push(time);
        for (values, value) in values.iter_mut().zip(all) {
            values.push(value);
        }
    };
    keep(first);
    let (mut anchor, mut last, mut is_last_kept) = (first, first, true);
    let mut slopes = [OPEN; N];
    for &point in rest {
        let slope = |from: (f64, [f64; N]), i: usize, off: f64| {
            (point.1[i] + off - from.1[i]) / (point.0 - from.0)
        };
        let is_straight = |i: usize| (slopes[i].0..=slopes[i].1).contains(&slope(anchor, i, 0.0));
        if !(0..N).all(is_straight) {
            keep(last);
            anchor = last;
            slopes = [OPEN; N];
        }
        for (i, (low, high)) in slopes.iter_mut().enumerate() {
            *low = low.max(slope(anchor, i, -tolerances[i]));
            *high = high.min(slope(anchor, i, tolerances[i]));
        }
        (last, is_last_kept) = (point, false);
        if is_kept(point.0) {
            keep(point);
            anchor = point;
            slopes = [OPEN; N];
            is_last_kept = true;
        }
    }
    if !is_last_kept {
        keep(last);
    }
    (times, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(line: &[(f64, f64)], time: f64) -> f64 {
        let next = line
            .partition_point(|point| point.0 < time)
            .clamp(1, line.len() - 1);
        let ((t0, y0), (t1, y1)) = (line[next - 1], line[next]);
        y0 + (y1 - y0) * (time - t0) / (t1 - t0)
    }

    #[test]
    fn thinning_keeps_the_curve_and_the_impacts() {
        let points: Vec<(f64, f64)> = (0..4000)
            .map(|i| f64::from(i) * 0.005)
            .map(|t| (t, (3.0 * t).sin().abs() * (-0.2 * t).exp()))
            .collect();
        let kept = [points[700].0, points[701].0, points[3333].0];
        // A second value with a tolerance of its own.
        let both: Vec<(f64, [f64; 2])> = points.iter().map(|(t, y)| (*t, [*y, 7.0 * t])).collect();
        let (times, [values, line]) = thinned(&both, [1e-3, 1e-9], |time| kept.contains(&time));
        let thin: Vec<(f64, f64)> = times.iter().copied().zip(values).collect();
        assert!(
            times
                .iter()
                .zip(line)
                .all(|(time, value)| value == 7.0 * time)
        );
        assert!(thin.len() < points.len() / 8, "{}", thin.len());
        let worst = points
            .iter()
            .map(|(t, y)| (at(&thin, *t) - y).abs())
            .fold(0.0, f64::max);
        // The lines pass through samples, so the bound holds at every sample, but for rounding.
        assert!(worst <= 1e-3 * (1.0 + 1e-9), "{worst}");
        assert!(
            kept.iter()
                .all(|time| thin.iter().any(|point| point.0 == *time))
        );
        assert!(thin.windows(2).all(|two| two[0].0 < two[1].0));
        assert_eq!((thin.first(), thin.last()), (points.first(), points.last()));
    }

    #[test]
    fn nothing_and_little() {
        assert!(thinned(&[], [1.0], |_| false).0.is_empty());
        let one = thinned(&[(0.0, [1.0])], [1.0], |_| false);
        assert_eq!(one, (vec![0.0], [vec![1.0]]));
        assert_eq!(
            with_times(
                vec![(0.0, 0.0), (2.0, 4.0)],
                [0.0, 1.0, 1.0, 2.0, 3.0].into_iter()
            ),
            [(0.0, 0.0), (1.0, 2.0), (2.0, 4.0)]
        );
        assert_eq!(
            rising([(0.0, 1.0), (0.0, 2.0), (1.0, 3.0)].into_iter()),
            [(0.0, 1.0), (1.0, 3.0)]
        );
    }
}
