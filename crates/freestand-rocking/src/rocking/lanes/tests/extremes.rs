//! Inputs at the limits of what the types hold: nothing panics, nothing hangs, errors are those of
//! the scalar solver.

use std::f64::consts::FRAC_PI_2;

use super::super::rock_many;
use super::trouble::Random;
use crate::block::Block;
use crate::motion::{Motion, MotionError};
use crate::rocking::{Accuracy, Base, Restitution, RockingOptions, RockingSummary, Until, rock};

/// 1 mm to 100 m high, as slender as 0.8 to 50, some with the centre of gravity off the middle.
fn sizes() -> Vec<Block> {
    let mut blocks = Vec::new();
    for height in [0.001, 0.03, 1.0, 10.0, 100.0] {
        for slenderness in [0.8, 1.4, 5.0, 50.0] {
            let thickness = height / slenderness;
            let block = Block::uniform(height, thickness).unwrap();
            blocks.extend([block, block.with_cg_offset(0.4 * thickness).unwrap()]);
        }
    }
    blocks
}

fn check(base: Base, options: &RockingOptions, what: &str) {
    let blocks = sizes();
    for (block, kernel) in blocks.iter().zip(rock_many(&blocks, base, options)) {
        match (kernel, rock(block, base, options)) {
            (Ok(kernel), Ok(scalar)) => {
                assert_eq!(
                    (kernel.outcome, kernel.stop),
                    (scalar.outcome, scalar.stop),
                    "{what}: {block:?} {options:?}"
                );
                let peak = kernel.peak_rotation_rad;
                assert!(
                    (0.0..=FRAC_PI_2).contains(&peak),
                    "{what}: {peak} {block:?}"
                );
                assert!(
                    kernel
                        .sides
                        .iter()
                        .all(|side| side.impact_omega_rad_s.is_finite()),
                    "{what}: {block:?}"
                );
                assert!(
                    kernel.uplift_m.is_finite() && kernel.cg_rise_m.is_finite(),
                    "{what}: {block:?}"
                );
            }
            // As text, in which NaN is itself.
            (Err(kernel), Err(scalar)) => assert_eq!(
                format!("{kernel:?}"),
                format!("{scalar:?}"),
                "{what}: {block:?}"
            ),
            (kernel, scalar) => {
                panic!("{what}: {kernel:?} instead of {scalar:?}; {block:?} {options:?}")
            }
        }
    }
}

/// Subnormal, tiny and huge samples, alone and beside ordinary ones, in records of two samples and
/// more.
#[test]
fn samples_of_any_finite_size() {
    let sizes = [
        0.0,
        5e-324,
        1e-310,
        1e-200,
        1e-30,
        1e-8,
        1.0,
        30.0,
        1e4,
        1e10,
        1e100,
        1e300,
        f64::MAX,
    ];
    for dt in [1e-6, 0.001, 0.5] {
        for a in sizes {
            for accel in [
                vec![0.0, a],
                vec![a, -a],
                vec![0.0, a, 3.0, -a, -3.0, 0.0],
                vec![-a, -a, -a],
            ] {
                let motion = Motion::new(dt, accel.clone()).unwrap();
                let base = Base {
                    horizontal: Some(&motion),
                    vertical: None,
                };
                // Restitution is given: Housner's of the slender ones comes near 1 (`edges`: blocks
                // that rock for ever).
                for until in [
                    Until::EndOfMotion,
                    Until::Settled {
                        at_most_s: 300.0 * dt,
                    },
                ] {
                    let restitution = Restitution::Value(0.9);
                    let options = RockingOptions {
                        until,
                        restitution,
                        ..RockingOptions::default()
                    };
                    check(base, &options, &format!("every {dt} s {accel:?}"));
                }
            }
        }
    }
}

/// Vertical samples up to free flight and beyond it.
#[test]
fn vertical_samples_of_any_finite_size() {
    let horizontal = Motion::new(0.01, vec![0.0, 4.0, -4.0, 4.0, 0.0]).unwrap();
    for a in [5e-324, 1e-30, 9.8, 9.80665, 9.81, 1e3, 1e300] {
        for accel in [
            vec![0.0, a, 0.0, 0.0, 0.0],
            vec![0.0, -a, -a, 0.0, 0.0],
            vec![0.0, 0.0, 0.0, 0.0, -a],
        ] {
            let vertical = Motion::new(0.01, accel.clone()).unwrap();
            let base = Base {
                horizontal: Some(&horizontal),
                vertical: Some(&vertical),
            };
            check(
                base,
                &RockingOptions::default(),
                &format!("{accel:?} upwards"),
            );
        }
    }
}

#[test]
fn what_the_scalar_solver_refuses_is_refused() {
    let motion = Motion::new(0.01, vec![0.0, 4.0, 0.0]).unwrap();
    let longer = Motion::new(0.01, vec![0.0, 4.0, 0.0, 0.0]).unwrap();
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    let standard = RockingOptions::default();
    for options in [
        RockingOptions {
            gravity_m_s2: 0.0,
            ..standard
        },
        RockingOptions {
            gravity_m_s2: f64::NAN,
            ..standard
        },
        RockingOptions {
            gravity_m_s2: 1e-310,
            ..standard
        },
        RockingOptions {
            gravity_m_s2: f64::MAX,
            ..standard
        },
        RockingOptions {
            accuracy: Accuracy::Tolerance(1e-3),
            ..standard
        },
        RockingOptions {
            restitution: Restitution::Value(-0.1),
            ..standard
        },
        RockingOptions {
            restitution: Restitution::Value(f64::NAN),
            ..standard
        },
        RockingOptions {
            restitution: Restitution::Value(0.0),
            ..standard
        },
        RockingOptions {
            restitution: Restitution::Factor(2.0),
            ..standard
        },
        RockingOptions {
            initial_rotation_rad: 2.0,
            ..standard
        },
        RockingOptions {
            initial_omega_rad_s: f64::INFINITY,
            ..standard
        },
        RockingOptions {
            until: Until::Settled {
                at_most_s: f64::INFINITY,
            },
            ..standard
        },
        RockingOptions {
            until: Until::Settled {
                at_most_s: f64::NAN,
            },
            ..standard
        },
        RockingOptions {
            until: Until::Settled { at_most_s: -1.0 },
            ..standard
        },
        RockingOptions {
            until: Until::Time(0.0),
            ..standard
        },
    ] {
        check(base, &options, "options");
    }
    check(
        Base {
            vertical: Some(&longer),
            ..base
        },
        &standard,
        "two samplings",
    );
    check(Base::default(), &standard, "no motion");
    check(
        Base {
            horizontal: None,
            vertical: Some(&motion),
        },
        &standard,
        "only up and down",
    );
    assert_eq!(rock_many(&[], base, &standard), []);
}

#[test]
fn tolerances_out_of_range_are_refused() {
    let motion = Motion::new(0.01, vec![0.0, 4.0, 0.0]).unwrap();
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    for tolerance in [0.0, -1.0, 1e-17, 1.1e-3, 1.0, f64::INFINITY, f64::NAN] {
        let options = RockingOptions {
            accuracy: Accuracy::Tolerance(tolerance),
            ..RockingOptions::default()
        };
        check(base, &options, "a tolerance out of range");
    }
}

/// A motion holds nothing but finite samples, so the kernel never sees any other.
#[test]
fn motions_hold_finite_samples_only() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = Motion::new(0.01, vec![0.0, value, 0.0]);
        assert!(
            matches!(refused, Err(MotionError::NotFinite { index: 1, .. })),
            "{value}"
        );
    }
}

/// The memory of a tile grows with the samples, and so does a block's search for the next sample
/// that lifts it.
#[test]
#[ignore = "seconds, and 700 MB"]
fn ten_million_samples() {
    let mut random = Random::new(1);
    // Bursts of a hundred samples, each after a hundred of rest.
    let accel = (0..10_000_000)
        .map(|k| {
            if k / 100 % 2 == 0 {
                0.0
            } else {
                random.between(-1.0, 1.0)
            }
        })
        .collect();
    let motion = Motion::new(0.005, accel).unwrap();
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    // The threshold of the first is passed in every burst, that of the second in none.
    let blocks = [(2.0, 0.19), (2.0, 0.3), (3.0, 0.3)].map(|(h, t)| Block::uniform(h, t).unwrap());
    let kernel = rock_many(&blocks, base, &RockingOptions::default());
    for (block, kernel) in blocks.iter().zip(kernel) {
        let scalar = rock(block, base, &RockingOptions::default())
            .map(|rocking| RockingSummary::from(&rocking));
        match (kernel, scalar) {
            (Ok(kernel), Ok(scalar)) => {
                assert_eq!(kernel.outcome, scalar.outcome, "{block:?}");
                // A burst is forgotten in the rest behind it: the errors are those of a short
                // record.
                assert!(
                    (kernel.peak_rotation_rad - scalar.peak_rotation_rad).abs()
                        <= 1e-8 * scalar.peak_rotation_rad
                );
            }
            (kernel, scalar) => assert_eq!(kernel, scalar, "{block:?}"),
        }
    }
}
