use super::*;
use crate::cushion::Cushion;
use crate::identify::{VirtualStaticOptions, virtual_static};

/// A machine of 10 kN/mm, a slack of 0.3 mm and a loss of a fifth are recovered. Loading is
/// straight, so only rounding remains; the half-sine of the loss is integrated in 200 steps.
#[test]
fn static_tests_come_back() {
    let pad = Cushion::linear(1e6).unwrap();
    let made = VirtualStaticOptions {
        max_force_n: 1000.0,
        points: 201,
        hysteresis_ratio: 0.2,
        toe_m: 0.3e-3,
        machine_stiffness_n_m: Some(1e7),
        noise_ratio: 0.0,
        seed: 1,
        index: 0,
    };
    let (force, displacement): (Vec<f64>, Vec<f64>) =
        virtual_static(&pad, &made).into_iter().unzip();
    let options = StaticOptions {
        load_n: Some(350.0),
        machine_stiffness_n_m: Some(1e7),
        toe: Toe::Slack,
    };
    let test = static_test(&force, &displacement, &options).unwrap();
    assert!((test.tangent_stiffness_n_m / 1e6 - 1.0).abs() < 1e-9);
    // The slack is searched to 4e-9 of a bracket that is as long as it; a sum of squares hides half of its digits.
    assert!((test.secant_stiffness_n_m / 1e6 - 1.0).abs() < 1e-5);
    assert!((test.toe_m / 0.3e-3 - 1.0).abs() < 1e-5);
    assert!((test.hysteresis_ratio.unwrap() / 0.2 - 1.0).abs() < 1e-4);
    assert!((test.exponent.unwrap() - 1.0).abs() < 1e-4);
    let tangent = static_test(
        &force,
        &displacement,
        &StaticOptions {
            toe: Toe::Tangent,
            ..options
        },
    )
    .unwrap();
    assert!(
        (tangent.toe_m / 0.3e-3 - 1.0).abs() < 1e-9
            && tangent.exponent.is_some_and(|n| (n - 1.0).abs() < 1e-9)
    );
    let soft = StaticOptions {
        machine_stiffness_n_m: Some(1e5),
        ..options
    };
    assert!(matches!(
        static_test(&force, &displacement, &soft),
        Err(StaticError::Machine { .. })
    ));
    let heavy = StaticOptions {
        load_n: Some(2e3),
        ..options
    };
    assert!(matches!(
        static_test(&force, &displacement, &heavy),
        Err(StaticError::Load { .. })
    ));
}

/// Straight lines of 1000 N/mm up to each of `tops`, and back at 80 % of the force; each cycle ends
/// at `rest_n`.
fn cycles(tops: &[f64], rest_n: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut force, mut displacement) = (vec![0.0], vec![0.0]);
    let mut at_n = 0.0;
    for &top in tops {
        for (from, to, share) in [(at_n, top, 1.0), (top, rest_n, 0.8)] {
            let steps = 100;
            displacement.extend(
                (1..=steps).map(|i| (from + (to - from) * f64::from(i) / f64::from(steps)) / 1e6),
            );
            force.extend(
                (1..=steps).map(|i| share * (from + (to - from) * f64::from(i) / f64::from(steps))),
            );
        }
        at_n = rest_n;
    }
    (force, displacement)
}

/// Cycles before and after the last full one are ignored: loading is straight, 1000 N/mm to
/// rounding, and unloading at 80 % of its force loses a fifth, less the share of the first step
/// back, from 1000 to 792 N: 0.2 · 1/100.
#[test]
fn conditioning_cycles_are_left_out() {
    let options = StaticOptions {
        load_n: None,
        machine_stiffness_n_m: None,
        toe: Toe::Slack,
    };
    for (tops, max_n, others) in [
        (&[1000.0][..], 1000.0, 0),
        (&[300.0, 600.0, 1000.0], 1000.0, 2),
        (&[1000.0, 980.0, 970.0], 970.0, 2),
        (&[600.0, 1000.0, 500.0], 1000.0, 2),
    ] {
        let (force, displacement) = cycles(tops, 0.0);
        let test = static_test(&force, &displacement, &options).unwrap();
        assert!(
            (test.tangent_stiffness_n_m / 1e6 - 1.0).abs() < 1e-9,
            "{tops:?} {test:?}"
        );
        assert!(
            (test.secant_stiffness_n_m / 1e6 - 1.0).abs() < 1e-9,
            "{tops:?}"
        );
        assert!(
            (test.hysteresis_ratio.unwrap() - 0.2).abs() < 2.1e-3,
            "{tops:?} {:?}",
            test.hysteresis_ratio
        );
        assert!(
            test.toe_m.abs() < 1e-12 && (test.exponent.unwrap() - 1.0).abs() < 1e-9,
            "{tops:?}"
        );
        assert_eq!(
            (test.max_force_n, test.other_cycles, test.loading_count),
            (max_n, others, 101),
            "{tops:?}"
        );
    }
    // A pause without unloading is not the start of loading.
    let (force, displacement) = cycles(&[600.0, 1000.0], 550.0);
    assert!(matches!(
        static_test(&force, &displacement, &options),
        Err(StaticError::Foot { .. })
    ));
}

/// A curve that softens, F = 1000 N · √(d/1 mm): the tangent at 500 N (0.25 mm, 1000 N/mm) meets
/// zero at −0.25 mm, and the straight line through a quarter to both sides of a parabola on its
/// side is that tangent to 3 %.
#[test]
fn a_softening_curve_has_a_toe_below_zero() {
    let displacement: Vec<f64> = (0..=200).map(|i| f64::from(i) * 5e-6).collect();
    let force: Vec<f64> = displacement
        .iter()
        .map(|d| 1e3 * (d / 1e-3).sqrt())
        .collect();
    let options = StaticOptions {
        load_n: None,
        machine_stiffness_n_m: None,
        toe: Toe::Tangent,
    };
    let test = static_test(&force, &displacement, &options).unwrap();
    assert!((test.toe_m / -0.25e-3 - 1.0).abs() < 0.06, "{}", test.toe_m);
    assert!(test.toe_m < -3.0 * test.toe_error_m);
}

/// F = K dⁿ with and without a slack of 0.2 mm, and noise of 0.3 % of the largest force, even over ±√3 σ: the physics of
/// the pad stays, its exponent to 0.05 and its secant to 3 %, and the slack goes. The tangent would make secant and
/// tangent the same.
#[test]
fn only_the_slack_of_a_curve_is_cut_off() {
    let noise =
        |i: u32| 3.0 * 3f64.sqrt() * (2.0 * (f64::from(i) * 0.618_033_988_749_895).fract() - 1.0);
    for (exponent, slack_m) in [
        (1.0, 0.0),
        (1.3, 0.0),
        (1.3, 0.2e-3),
        (1.5, 0.0),
        (1.5, 0.2e-3),
        (0.7, 0.0),
    ] {
        let law = |d: f64| 1e3 * (d.max(0.0) / 1e-3).powf(exponent);
        let displacement: Vec<f64> = (0..=800)
            .map(|i| f64::from(i) * (1e-3 + slack_m) / 800.0)
            .collect();
        let force: Vec<f64> = displacement
            .iter()
            .zip(0..)
            .map(|(d, i)| law(d - slack_m) + noise(i))
            .collect();
        let options = StaticOptions {
            load_n: Some(350.0),
            machine_stiffness_n_m: None,
            toe: Toe::Slack,
        };
        let test = static_test(&force, &displacement, &options).unwrap();
        let truth = 350.0 / (1e-3 * 0.35f64.powf(exponent.recip()));
        assert!(
            (test.exponent.unwrap() - exponent).abs() < 0.05,
            "{exponent} {slack_m}: {:?}",
            test.exponent
        );
        assert!(
            (test.secant_stiffness_n_m / truth - 1.0).abs() < 0.03,
            "{exponent} {slack_m}: {}",
            test.toe_m
        );
    }
}

/// Noise in the force alone does not bias the stiffness: 4000 points of a straight line of
/// 1100 N/mm with 2 % of the largest force, evenly over their range; selected by their force they
/// would give 7 % less.
#[test]
fn noise_in_the_force_does_not_flatten_the_line() {
    // Additive recurrence with the golden ratio: even over ±√3 σ, and no two neighbours are equal.
    let noise =
        |i: u32| 20.0 * 3f64.sqrt() * (2.0 * (f64::from(i) * 0.618_033_988_749_895).fract() - 1.0);
    let displacement: Vec<f64> = (0..4000).map(|i| f64::from(i) / 4000.0 / 1100.0).collect();
    let force: Vec<f64> = displacement
        .iter()
        .zip(0..)
        .map(|(d, i)| 1.1e6 * d + noise(i))
        .collect();
    let options = StaticOptions {
        load_n: Some(500.0),
        machine_stiffness_n_m: None,
        toe: Toe::Slack,
    };
    let test = static_test(&force, &displacement, &options).unwrap();
    assert!(
        (test.tangent_stiffness_n_m / 1.1e6 - 1.0).abs() < 0.02,
        "{}",
        test.tangent_stiffness_n_m
    );
}
