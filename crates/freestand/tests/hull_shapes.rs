//! Bodies of simple shapes have the angles and the moments of inertia of closed forms.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use freestand::hull::HullError;
use freestand::hull::shapes::{Outline, upright};

/// Tilt and direction of the pass, which lies on a grid of 1/80 of a degree and 1/16 of a degree.
fn pass(outline: &Outline, feet: Option<&[[f64; 2]]>) -> (f64, f64) {
    let (body, _) = upright(outline, 1.0, 50.0, None, feet).unwrap();
    let barrier = body.hull.barrier(&body.hull.standing().unwrap());
    // The block of the same barrier has the same angle, but for 0.1 mm of rise on the grid.
    assert!((barrier.angle_rad() - barrier.tilt_rad).abs() < 1e-3);
    (barrier.tilt_rad, barrier.toward_rad)
}

#[test]
fn each_tips_over_its_nearest_edge() {
    let near = |found: f64, expected: f64| (found - expected).abs() < 3e-4;
    let (tilt, toward) = pass(&Outline::Box([0.3, 0.5]), None);
    assert!(near(tilt, (0.15_f64 / 0.5).atan()), "{tilt}");
    assert!(toward.sin().abs() < 2e-3, "{toward}");
    // Between two corners of the polygon of a circle: cos(π/48) of the radius.
    let (tilt, _) = pass(&Outline::Circle(0.3), None);
    let expected = (0.15 * (PI / 48.0).cos() / 0.5).atan();
    assert!(near(tilt, expected), "{tilt} {expected}");
    let (tilt, toward) = pass(&Outline::Polygon(6, 0.3), None);
    assert!(near(tilt, (0.15 * (PI / 6.0).cos() / 0.5).atan()), "{tilt}");
    assert!((3.0 * toward).cos().abs() < 1e-2, "{toward}");
    // A tripod: the nearest edge is half as far as its feet.
    let foot = |turn: f64| [0.2 * turn.cos(), 0.2 * turn.sin()];
    let feet = [0.0, 2.0 * PI / 3.0, 4.0 * PI / 3.0].map(foot);
    let (tilt, _) = pass(&Outline::Circle(0.5), Some(&feet));
    assert!(near(tilt, (0.1_f64 / 0.5).atan()), "{tilt}");
}

#[test]
fn their_moments_of_inertia_are_those_of_uniform_bodies() {
    let of = |outline: Outline| upright(&outline, 1.0, 12.0, None, None).unwrap();
    let cylinder = of(Outline::Circle(0.4));
    // m(3a² + h²)/12 and m a²/2.
    let expected = [3.0 * 0.04 + 1.0, 3.0 * 0.04 + 1.0, 6.0 * 0.04];
    for (axis, expected) in expected.into_iter().enumerate() {
        let found = cylinder.0.inertia_kg_m2[axis][axis];
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    assert!((cylinder.1 - 0.04 * PI).abs() < 1e-12);
    // A square on its corners is the box of the same sides.
    let (square, same) = (
        of(Outline::Polygon(4, 0.4 * 2f64.sqrt())),
        of(Outline::Box([0.4, 0.4])),
    );
    for axis in 0..3 {
        let [found, expected] = [&square, &same].map(|one| one.0.inertia_kg_m2[axis][axis]);
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    assert!((square.1 - same.1).abs() < 1e-12);
}

#[test]
fn a_centre_of_gravity_beside_its_feet_does_not_stand() {
    let feet = [[0.05, 0.0], [0.1, 0.1], [0.1, -0.1]];
    let beside = upright(&Outline::Box([0.4, 0.4]), 1.0, 50.0, None, Some(&feet));
    assert_eq!(beside, Err(HullError::Outside));
    let above = upright(&Outline::Box([0.4, 0.4]), 1.0, 50.0, Some(1.2), None);
    assert!(above.is_err());
}
