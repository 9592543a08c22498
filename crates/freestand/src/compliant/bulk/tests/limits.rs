//! Numbers that are out of range, and histories that end early.

use super::*;

#[test]
fn what_cannot_be_followed_says_why() {
    let motion = Motion::new(0.01, vec![1.0; 100]).unwrap();
    let other = Motion::new(0.02, vec![1.0; 100]).unwrap();
    let good = rack().world(&motion);
    let error = |world| {
        rock_compliant_many(&[world, good], G0_M_S2)
            .swap_remove(0)
            .unwrap_err()
    };
    let value = |error| matches!(error, CompliantError::Value { .. });
    assert!(value(error(CompliantWorld {
        mass_kg: f64::NAN,
        ..good
    })));
    assert!(value(error(CompliantWorld {
        stiffness_n_m: 0.0,
        ..good
    })));
    assert!(value(error(CompliantWorld {
        damping_n_s_m: -1.0,
        ..good
    })));
    assert!(matches!(
        error(CompliantWorld {
            stiffness_n_m: 5e3,
            ..good
        }),
        CompliantError::Unstable { .. }
    ));
    assert!(matches!(
        error(CompliantWorld {
            motion: Base::default(),
            ..good
        }),
        CompliantError::Duration { .. }
    ));
    let motion_of = |horizontal, vertical| Base {
        horizontal: Some(horizontal),
        vertical,
    };
    let mixed = CompliantWorld {
        motion: motion_of(&motion, Some(&other)),
        ..good
    };
    assert_eq!(error(mixed), CompliantError::VerticalMismatch);
    let stiff = CompliantWorld {
        stiffness_n_m: 1e18,
        ..good
    };
    assert!(matches!(error(stiff), CompliantError::TooManySteps { .. }));
    assert!(value(
        rock_compliant_many(&[good], -1.0)
            .swap_remove(0)
            .unwrap_err()
    ));
    let huge = Motion::new(0.01, vec![1e300; 100]).unwrap();
    let huge = rock_compliant_many(
        &[CompliantWorld {
            motion: motion_of(&huge, None),
            ..good
        }],
        G0_M_S2,
    );
    assert!(huge[0].as_ref().map_or_else(
        |error| matches!(error, CompliantError::NotFinite { .. }),
        |_| false
    ));
}

/// A push of 0.8 s at three times the threshold overturns every object, in both solvers; the kernel stops before the
/// object lies on the floor.
#[test]
fn a_long_push_overturns() {
    for object in objects() {
        let push = Motion::new(0.01, vec![3.0 * object.up_m_s2(); 300]).unwrap();
        let world = object.world(&push);
        let (found, expected) = (
            follow_all(&[world])[0],
            scalar(&world, CompliantAccuracy::Fast),
        );
        assert_eq!(found.outcome, PadOutcome::Overturned, "{}", object.name);
        let (found_s, expected_s) = (
            found.overturn_time_s.unwrap(),
            expected.overturn_time_s.unwrap(),
        );
        assert!(
            found_s < expected_s && found_s > 0.6 * expected_s,
            "{}: {found_s} {expected_s}",
            object.name
        );
        assert!(
            found.let_go_time_s <= found.first_uplift_time_s
                && found.first_uplift_time_s < found.overturn_time_s
        );
    }
}

/// A base that does not move: no uplift, the sink at rest, and no time.
#[test]
fn a_still_base_leaves_everything_at_rest() {
    for object in objects() {
        let still = Motion::new(0.01, vec![0.0; 200]).unwrap();
        let found = follow_all(&[object.world(&still)])[0];
        assert!(
            found.outcome == PadOutcome::StayedOn && found.pad_uplift_ratio == 0.0,
            "{found:?}"
        );
        let sink = scalar(&object.world(&still), CompliantAccuracy::Fast)
            .equilibrium
            .unwrap()
            .compressions_m;
        // No step is taken.
        assert!((found.peak_compression_m / sink[0].max(sink[1]) - 1.0).abs() < 1e-14);
        assert_eq!(found.peak_edge_acceleration_m_s2(), 0.0);
    }
}
