//! Walls beside bodies on their hull.

use std::f64::consts::PI;

use super::super::shapes::{Outline, upright};
use super::super::wall::HullWall;
use super::shake::{Contact, HullOutcome, HullPoint, HullRocking, Sampling, shake_observed};
use super::standing::Standing;
use super::*;
use crate::compliant::EdgeSide;
use crate::cushion::{ContactLaw, Cushion};
use crate::spatial::{
    Shape, SpatialMotion, SpatialObject, SpatialOptions, Support, Wall, rock_spatial_observed,
};

const G: f64 = 9.81;
const MASS_KG: f64 = 120.0;

/// A wall behind the body, on its −x.
fn behind(gap_m: f64) -> HullWall {
    HullWall {
        toward_rad: PI,
        gap_m,
        stiffness_n_m: 5e6,
        damping_ratio: 0.05,
    }
}

fn body(outline: Outline, height_m: f64) -> Standing {
    let (body, _) = upright(&outline, height_m, MASS_KG, None, None).unwrap();
    body.standing(0).unwrap()
}

fn bodies() -> [Standing; 3] {
    [
        body(Outline::Box([0.4, 0.6]), 1.8),
        body(Outline::Circle(0.4), 1.8),
        body(Outline::Polygon(5, 0.5), 1.8),
    ]
}

/// One sine of this amplitude \[m/s²\] and period, and rest until 4 s.
fn sine(amplitude_m_s2: f64, period_s: f64) -> Motion {
    let at = |i: usize| match i as f64 * 0.005 / period_s {
        share if share <= 1.0 => amplitude_m_s2 * (2.0 * PI * share).sin(),
        _ => 0.0,
    };
    Motion::new(0.005, (0..800).map(at).collect()).unwrap()
}

fn both<'a>(x: &'a Motion, y: &'a Motion) -> SpatialMotion<'a> {
    SpatialMotion {
        x: Some(x),
        y: Some(y),
        vertical: None,
    }
}

fn contact(friction_ratio: f64) -> Contact {
    Contact {
        friction_ratio,
        ..Contact::default()
    }
}

fn observed(
    body: &Standing,
    contact: &Contact,
    motion: &SpatialMotion,
) -> (HullRocking, Vec<HullPoint>) {
    let mut points = Vec::new();
    let found = shake_observed(
        body,
        contact,
        0.0,
        motion,
        G,
        Sampling::WHOLE,
        &mut |point| points.push(point),
    );
    (found.unwrap(), points)
}

/// How far the body is beyond its extreme at rest, towards −x \[m\].
fn depth_m(body: &Standing, points: &[HullPoint]) -> f64 {
    let nearest_m = |point: &HullPoint| {
        let of = |one: &Vector| point.place_m(one)[0];
        body.sides().iter().map(of).fold(f64::INFINITY, f64::min)
    };
    let start_m = nearest_m(&points[0]);
    points
        .iter()
        .map(|point| start_m - nearest_m(point))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// The wall stops base and top: without it they go farther by centimetres. What a contact can do to it is bounded by the
/// energy of the largest speed, ½ m v² = ½ (k_w/2) d², and by the static push of the floor on a single point.
#[test]
fn a_wall_stops_every_vertex() {
    let (x, y) = (sine(4.0, 1.0), sine(1.0, 0.7));
    for free in bodies() {
        let (alone, points) = observed(&free, &contact(0.3), &both(&x, &y));
        assert!(depth_m(&free, &points) > 0.05, "{alone:?}");
        let beside = free.clone().beside(vec![behind(0.01)]);
        let (found, points) = observed(&beside, &contact(0.3), &both(&x, &y));
        let point_n_m = 0.5 * 5e6;
        let most_m =
            found.wall_speed_m_s * (MASS_KG / point_n_m).sqrt() + MASS_KG * 4.0 / point_n_m;
        let deepest_m = depth_m(&free, &points) - 0.01;
        assert!(found.wall_contacts > 1, "{found:?}");
        assert!(
            deepest_m > 0.0 && deepest_m < most_m,
            "{deepest_m} {most_m} {found:?}"
        );
    }
}

/// Out of reach it changes no bit.
#[test]
fn a_wall_out_of_reach_is_no_wall() {
    let (x, y) = (sine(5.0, 1.0), sine(1.5, 0.7));
    for free in bodies() {
        // A soft wall, whose steps are not shorter.
        let far = HullWall {
            stiffness_n_m: 1e4,
            ..behind(5.0)
        };
        let (alone, _) = observed(&free, &contact(0.5), &both(&x, &y));
        let (beside, _) = observed(
            &free.clone().beside(vec![far]),
            &contact(0.5),
            &both(&x, &y),
        );
        assert_eq!(alone, beside);
    }
}

/// A slow push against a wall compresses it under both edges of a box: d = m a/(2 k_w).
#[test]
fn a_push_against_a_wall_compresses_it_as_springs_do() {
    let most_m_s2 = 2.0;
    let ramp = Motion::new(
        0.01,
        (0..=300)
            .map(|i| most_m_s2 * f64::from(i) / 300.0)
            .collect(),
    );
    let (ramp, standing) = (ramp.unwrap(), body(Outline::Box([0.4, 0.6]), 1.0));
    let motion = SpatialMotion {
        x: Some(&ramp),
        ..SpatialMotion::default()
    };
    let beside = standing.beside(vec![behind(0.0)]);
    let mut last = None;
    let see = &mut |point: HullPoint| {
        if point.time_s < 2.995 {
            last = Some(point);
        }
    };
    shake_observed(
        &beside,
        &contact(0.0),
        0.0,
        &motion,
        G,
        Sampling::WHOLE,
        see,
    )
    .unwrap();
    let last = last.unwrap();
    let depth_m = MASS_KG * most_m_s2 * (last.time_s / 3.0) / (2.0 * 5e6);
    // Its vibration is that of a ramp: 1 % of it in 3 s.
    assert!(
        (-last.cg_m[0] / depth_m - 1.0).abs() < 0.02,
        "{last:?} {depth_m}"
    );
    assert!(last.tilts_rad[2] < 1e-5, "{last:?}");
}

/// On a smooth floor between two elastic walls a box goes to and fro with the speed of its push; damped walls slow it
/// down. After many strikes rounding has turned it, and it spins.
#[test]
fn elastic_walls_keep_the_speed() {
    let push = Motion::new(
        0.005,
        (0..800).map(|i| if i < 40 { -3.0 } else { 0.0 }).collect(),
    );
    let push = push.unwrap();
    let motion = SpatialMotion {
        x: Some(&push),
        ..SpatialMotion::default()
    };
    // The largest between two samples in the last second; 0.2 m take 0.3 s.
    let speed_m_s = |damping_ratio: f64| {
        let wall = |toward_rad: f64| HullWall {
            toward_rad,
            damping_ratio,
            ..behind(0.1)
        };
        let beside = body(Outline::Box([0.4, 0.6]), 1.0).beside(vec![wall(0.0), wall(PI)]);
        let (found, points) = observed(&beside, &contact(0.0), &motion);
        assert!(found.wall_contacts > 3, "{found:?}");
        let last = points
            .windows(2)
            .filter(|two| (3.0..4.0).contains(&two[0].time_s));
        last.map(|two| (two[1].cg_m[0] - two[0].cg_m[0]).abs() / 0.005)
            .fold(0.0, f64::max)
    };
    // 3 m/s² for 0.195 s, and down within a sample. Each strike changes it by the square of the step over the vibration, 1e-3 at most.
    let elastic = speed_m_s(0.0);
    assert!((elastic / 0.5925 - 1.0).abs() < 0.01, "{elastic}");
    assert!(speed_m_s(0.1) < 0.3);
}

/// A wall on the other side under the opposite motion: the mirror image, until rounding has grown.
#[test]
fn mirrored_walls_give_mirrored_histories() {
    let x = sine(4.0, 0.9);
    let opposite = x.scaled(-1.0).unwrap();
    for standing in [
        body(Outline::Box([0.4, 0.6]), 1.8),
        body(Outline::Circle(0.4), 1.8),
    ] {
        let of = |toward_rad: f64, x: &Motion| {
            let wall = HullWall {
                toward_rad,
                ..behind(0.01)
            };
            let motion = SpatialMotion {
                x: Some(x),
                ..SpatialMotion::default()
            };
            observed(&standing.clone().beside(vec![wall]), &contact(0.6), &motion)
        };
        let ((one, left), (_, right)) = (of(PI, &x), of(0.0, &opposite));
        assert!(one.wall_contacts > 0, "{one:?}");
        for (a, b) in left.iter().zip(&right).take_while(|(a, _)| a.time_s < 1.2) {
            assert!(
                (a.tilts_rad[0] + b.tilts_rad[0]).abs() < 1e-6,
                "{a:?} {b:?}"
            );
            assert!((a.cg_m[0] + b.cg_m[0]).abs() < 1e-6, "{a:?} {b:?}");
        }
    }
}

/// Turned about the vertical together with the motion and the wall, a history is the same.
#[test]
fn the_wall_turns_with_the_body() {
    let (x, none) = (sine(4.0, 0.9), sine(0.0, 0.9));
    let (sin, cos) = 0.7f64.sin_cos();
    let (along, across) = (x.scaled(cos).unwrap(), x.scaled(sin).unwrap());
    let beside = body(Outline::Box([0.4, 0.6]), 1.8).beside(vec![behind(0.01)]);
    let first = |yaw_rad: f64, motion: &SpatialMotion| {
        let mut tilts = Vec::new();
        let see = &mut |point: HullPoint| tilts.push(point.tilts_rad[2]);
        shake_observed(
            &beside,
            &contact(0.6),
            yaw_rad,
            motion,
            G,
            Sampling::WHOLE,
            see,
        )
        .unwrap();
        tilts
    };
    let (straight, turned) = (
        first(0.0, &both(&x, &none)),
        first(0.7, &both(&along, &across)),
    );
    let most = straight.iter().copied().fold(0.0, f64::max);
    assert!(most > 0.02, "{most}");
    for (a, b) in straight.iter().zip(&turned).take(240) {
        assert!((a - b).abs() < 1e-5, "{a} {b}");
    }
}

/// Past its balance point it comes to lean on a wall; without the wall it falls.
#[test]
fn past_its_balance_point_it_leans() {
    let pulse = |i: usize| 6.0 * (PI * (i as f64 / 160.0).min(1.0)).sin();
    let x = Motion::new(0.005, (0..800).map(pulse).collect()).unwrap();
    let standing = body(Outline::Box([0.4, 0.6]), 1.8);
    let motion = SpatialMotion {
        x: Some(&x),
        ..SpatialMotion::default()
    };
    let (alone, _) = observed(&standing, &contact(1.0), &motion);
    assert_eq!(alone.outcome, HullOutcome::Overturned);
    let damped = HullWall {
        damping_ratio: 0.5,
        ..behind(0.6)
    };
    let (beside, _) = observed(&standing.beside(vec![damped]), &contact(1.0), &motion);
    assert_eq!(beside.outcome, HullOutcome::Leaned, "{beside:?}");
    assert!(beside.outcome.falls());
}

/// A box that strikes a wall as the solver for cushions follows it, on cushions like the contacts of the hull. Before the
/// strike both agree to 1e-5; in the rebound the foot jumps and slips, and the dashpots along the floor, which cushions
/// do not have, change it: with 20 % of damping by 7 %, with 1 % hardly. Afterwards they are two histories.
#[test]
fn a_box_beside_a_wall_moves_as_on_its_cushions() {
    let x = sine(3.5, 0.8);
    let sinking_m = 1e-4;
    let contact = Contact {
        friction_ratio: 1.0,
        damping_ratio: 0.01,
        sinking_m,
        ..Contact::default()
    };
    let wall = behind(0.02);
    let beside = body(Outline::Box([0.4, 0.6]), 1.8).beside(vec![wall]);
    let motion = SpatialMotion {
        x: Some(&x),
        ..SpatialMotion::default()
    };
    let (found, points) = observed(&beside, &contact, &motion);
    assert!(found.wall_contacts > 1, "{found:?}");
    let law = |stiffness_n_m: f64, damping_n_s_m: f64| {
        Cushion::new(ContactLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m,
        })
        .unwrap()
    };
    let point_n_m = MASS_KG * G / (3.0 * sinking_m);
    let point_n_s_m = 2.0 * 0.01 * (point_n_m * MASS_KG / 3.0).sqrt();
    let object = SpatialObject {
        shape: Shape::Prism {
            thickness_m: 0.4,
            width_m: 0.6,
            height_m: 1.8,
        },
        mass_kg: MASS_KG,
        support: Support {
            tangential_stiffness_ratio: 0.7,
            friction_ratio: Some(1.0),
            ..Support::new(law(2.0 * point_n_m, 2.0 * point_n_s_m))
        },
        walls: vec![Wall {
            side: EdgeSide::Left,
            gap_m: 0.02,
            height_m: f64::INFINITY,
            cushion: Some(law(5e6, 2.0 * 0.05 * (5e6 * MASS_KG).sqrt())),
        }],
    };
    let options = SpatialOptions {
        gravity_m_s2: G,
        duration_s: Some(1.6),
        ..SpatialOptions::default()
    };
    let mut on_cushions = Vec::new();
    rock_spatial_observed(&object, motion, &options, |piece| {
        on_cushions.push((piece.start_s(), piece.pose(0, 0.0).unwrap().tilts_rad[0]));
    })
    .unwrap();
    let at = |time_s: f64| {
        let after = on_cushions
            .partition_point(|one| one.0 <= time_s)
            .clamp(1, on_cushions.len() - 1);
        let ((t0, a), (t1, b)) = (on_cushions[after - 1], on_cushions[after]);
        a + (b - a) * (time_s - t0) / (t1 - t0)
    };
    let until = |point: &&HullPoint| point.time_s < 0.31;
    let most = points
        .iter()
        .take_while(until)
        .map(|p| p.tilts_rad[0].abs())
        .fold(0.0, f64::max);
    let apart = |from_s: f64, to_s: f64| {
        let there = points.iter().filter(|p| (from_s..to_s).contains(&p.time_s));
        there
            .map(|p| (p.tilts_rad[0] - at(p.time_s)).abs())
            .fold(0.0, f64::max)
    };
    // The foot lifts first at 0.1 s, and the top strikes at 0.26 s.
    assert!(apart(0.0, 0.25) < 2e-5, "{}", apart(0.0, 0.25));
    assert!(
        most > 0.009 && apart(0.25, 0.31) < 0.02 * most,
        "{} {most} {found:?}",
        apart(0.25, 0.31)
    );
}

#[test]
fn walls_that_make_no_sense_are_refused() {
    let standing = body(Outline::Circle(0.4), 1.8);
    for wrong in [
        HullWall {
            gap_m: -0.1,
            ..behind(0.0)
        },
        HullWall {
            stiffness_n_m: 0.0,
            ..behind(0.0)
        },
        HullWall {
            damping_ratio: f64::NAN,
            ..behind(0.0)
        },
        HullWall {
            toward_rad: f64::INFINITY,
            ..behind(0.0)
        },
    ] {
        let beside = standing.clone().beside(vec![wrong]);
        let refused =
            super::super::shake::shake(&beside, &contact(0.5), 0.0, &SpatialMotion::default(), G);
        assert_eq!(refused, Err(HullError::Wall));
    }
}
