//! The exact screen: it says of a motion whether an edge lets go, and by which factor it does not.

use super::*;

/// A motion at 0.985 of the factor at which U is 1 leaves both edges on their pads, at 1.03 one lets
/// go: in the scalar solver, which knows nothing of U. What the linear equations leave out are
/// squares of the rotation.
fn check(world: CompliantWorld, name: &str) {
    let ratio = follow_all(&[world])[0].pad_uplift_ratio;
    for (share, lets_go) in [(0.985, false), (1.03, true)] {
        let horizontal = world
            .motion
            .horizontal
            .map(|motion| motion.scaled(share / ratio).unwrap());
        let vertical = world
            .motion
            .vertical
            .map(|motion| motion.scaled(share / ratio).unwrap());
        let motion = Base {
            horizontal: horizontal.as_ref(),
            vertical: vertical.as_ref(),
        };
        let scaled = CompliantWorld { motion, ..world };
        let found = follow_all(&[scaled])[0];
        // The equations are linear in the motion: rounding of a thousand steps.
        assert!(
            (found.pad_uplift_ratio / share - 1.0).abs() < 1e-9,
            "{name}: {found:?}"
        );
        assert_eq!(
            found.outcome == PadOutcome::LetGo,
            lets_go,
            "{name}, {share}: {found:?}"
        );
        // Nothing but an event of a contact is one, without slip and kinks.
        let events = scalar(&scaled, CompliantAccuracy::Fast).effort.events;
        assert_eq!(
            events > 0,
            lets_go,
            "{name}, {share}: {events} events of the scalar solver"
        );
    }
}

#[test]
fn the_screen_says_when_an_edge_lets_go() {
    let motions = motions(3);
    for (i, object) in objects().into_iter().enumerate() {
        screens(&motions, i, &object);
    }
}

#[test]
#[ignore = "ten seconds: every object under every motion"]
fn the_screen_says_when_an_edge_lets_go_under_every_motion() {
    let motions = motions(3);
    for i in 0..motions.len() {
        for object in objects() {
            screens(&motions, i, &object);
        }
    }
}

fn screens(motions: &[Motion], i: usize, object: &Object) {
    let horizontal = part(&motions[i % 3], 1.0, 9.0, object.up_m_s2());
    check(object.world(&horizontal), object.name);
    let other = &motions[(i + 1) % 3];
    let vertical = part(other, 1.0, 9.0, 0.5 * object.up_m_s2());
    let motion = Base {
        horizontal: Some(&horizontal),
        vertical: Some(&vertical),
    };
    check(
        CompliantWorld {
            motion,
            ..object.world(&horizontal)
        },
        object.name,
    );
}

/// A push that grows over 40 s, some two hundred periods, lifts at the steady threshold.
#[test]
fn a_slow_push_lifts_at_the_threshold() {
    for object in objects() {
        let up_m_s2 = object.up_m_s2();
        // Toward the side on which the edge farther from the centre of gravity goes.
        let push = Motion::new(
            0.01,
            (0..4000)
                .map(|i| 1.2 * up_m_s2 * f64::from(i) / 4000.0)
                .collect(),
        )
        .unwrap();
        let other = push.scaled(-1.0).unwrap();
        let found = follow_all(&[object.world(&push), object.world(&other)]);
        let first = found
            .iter()
            .filter_map(|done| done.let_go_time_s)
            .fold(f64::INFINITY, f64::min);
        let reached = 1.2 * first / 40.0;
        // First order in the rotation: an edge lets go at θ = m g/(k b), at most 1.2e-2 of b/2c here.
        assert!((reached - 1.0).abs() < 0.02, "{}: {reached}", object.name);
    }
}

/// Where both edges stay, what is reported is what the scalar solver reports.
#[test]
fn below_uplift_both_solvers_agree() {
    let motions = motions(2);
    for object in objects() {
        let horizontal = part(&motions[0], 1.0, 8.0, object.up_m_s2());
        let vertical = part(&motions[1], 1.0, 8.0, 0.6 * object.up_m_s2());
        for vertical in [None, Some(&vertical)] {
            let motion = Base {
                horizontal: Some(&horizontal),
                vertical,
            };
            let ratio = follow_all(&[CompliantWorld {
                motion,
                ..object.world(&horizontal)
            }])[0]
                .pad_uplift_ratio;
            // Three fifths of what lifts it.
            let horizontal = horizontal.scaled(0.6 / ratio).unwrap();
            let vertical = vertical.map(|motion| motion.scaled(0.6 / ratio).unwrap());
            let motion = Base {
                horizontal: Some(&horizontal),
                vertical: vertical.as_ref(),
            };
            let world = CompliantWorld {
                motion,
                ..object.world(&horizontal)
            };
            let (found, expected) = (
                follow_all(&[world])[0],
                scalar(&world, CompliantAccuracy::Standard),
            );
            assert!(
                found.outcome == PadOutcome::StayedOn && found.lift_m == 0.0,
                "{}: {found:?}",
                object.name
            );
            let press = found.peak_compression_m / expected.peak_compression_m - 1.0;
            // The rotation, of up to 5e-3, enters squared: c θ²/2 of a sink of b θ/2.
            assert!(press.abs() < 0.01, "{}: compression {press}", object.name);
            for edge in 0..2 {
                let (got, expected) = (
                    found.peak_edge_accelerations_m_s2[edge],
                    expected.peak_edge_accelerations_m_s2[edge],
                );
                // Taken at the steps, which are up to half a radian of the fastest vibration: 1 - cos(1/4) of its part.
                assert!(
                    (got / expected - 1.0).abs() < 0.03,
                    "{}: edge {edge} {got} {expected}",
                    object.name
                );
            }
        }
    }
}
