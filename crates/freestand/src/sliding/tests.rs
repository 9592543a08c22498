//! Closed forms, symmetries and event rules of the sliding block.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::block::Block;
use crate::motion::Motion;
use crate::rocking::Base;

fn options(static_ratio: f64, kinetic_ratio: f64) -> SlidingOptions {
    SlidingOptions::new(Friction::new(static_ratio, kinetic_ratio).unwrap())
}

fn settled(options: SlidingOptions) -> SlidingOptions {
    SlidingOptions {
        until: Until::Settled { at_most_s: 100.0 },
        ..options
    }
}

fn solve(motion: &Motion, options: &SlidingOptions) -> Sliding {
    slide(
        Base {
            horizontal: Some(motion),
            vertical: None,
        },
        options,
    )
    .unwrap()
}

/// A floor that jumps to A g, holds it for T and falls to zero within `dt`: three parabolas and
/// cubics in a row, by hand. As dt → 0 the slide is A g T²(A−N)/(2N). 1e-14: a few roundings.
#[test]
fn a_rectangle_has_its_closed_form() {
    let (a, n, t, g): (f64, f64, f64, f64) = (0.6, 0.2, 0.5, G0_M_S2);
    for dt in [0.5, 0.125, 1e-3, 1e-5] {
        let samples = vec![a * g; (t / dt).round() as usize + 1];
        let got = solve(&Motion::new(dt, samples).unwrap(), &settled(options(n, n)));
        let v = (a - n) * g * t;
        let v2 = v + (a - n) * g * dt - 0.5 * a * g * dt;
        let ramp = v * dt + 0.5 * (a - n) * g * dt * dt - a * g * dt * dt / 6.0;
        let exact = 0.5 * (a - n) * g * t * t + ramp + v2 * v2 / (2.0 * n * g);
        // A sum of up to 5e4 steps rounds as often.
        assert!(
            (got.final_m + exact).abs() < 1e-11 * exact,
            "{dt}: {} {exact}",
            got.final_m
        );
        assert_eq!(
            (got.slide_count, got.outcome, got.first_slide_time_s),
            (1, SlidingOutcome::Slid, Some(0.0))
        );
        assert_eq!(
            (got.peak_m, got.peak_time_s),
            (got.final_m, Some(got.end_time_s))
        );
        if dt == 1e-5 {
            // The ramp adds about (A−N)/N (A/2) g T dt to the limit.
            assert!((got.final_m + a * g * t * t * (a - n) / (2.0 * n)).abs() < 1e-4);
        }
    }
}

/// One half sine A g of duration T; A = 0.6, N = 0.2, T = 0.5 s: 0.475945 m. Straight lines between
/// 20000 samples are within (π/20000)²/12 = 2e-9 of the sine.
#[test]
fn a_half_sine_has_its_closed_form() {
    let g = G0_M_S2;
    for (a, n, t) in [(0.6, 0.2, 0.5), (1.0, 0.05, 0.3), (0.5, 0.36, 1.0)] {
        let steps = 20_000;
        let sample = |i: i32| a * g * (PI * f64::from(i) / f64::from(steps)).sin();
        let motion = Motion::new(t / f64::from(steps), (0..=steps).map(sample).collect()).unwrap();
        let got = solve(&motion, &settled(options(n, n)));
        let (w, psi) = (PI / t, f64::asin(n / a));
        let exact = a * g / (w * w)
            * (psi.sin() + (1.0 + psi.cos()).powi(2) / (2.0 * psi.sin()) - (PI - psi));
        assert!(
            (got.final_m + exact).abs() < 1e-7 * exact,
            "{a} {n} {t}: {} {exact}",
            got.final_m
        );
        if a == 0.6 {
            assert!((got.final_m + 0.475945).abs() < 5e-7, "{}", got.final_m);
        }
    }
}

/// μ_k < μ_s: rest until μ_s g, then the acceleration jumps. A ramp u = c t from zero: onset at
/// t₀ = μ_s g/c, then ẍ = −c t + μ_k g.
#[test]
fn the_acceleration_jumps_at_onset() {
    let (c, g) = (40.0, G0_M_S2);
    let motion = Motion::new(0.5, vec![0.0, 0.5 * c]).unwrap();
    let got = solve(&motion, &options(0.5, 0.2));
    let start = 0.5 * g / c;
    let (left, jump) = (0.5 - start, (0.5 - 0.2) * g);
    let exact = 0.5 * jump * left * left + c * left.powi(3) / 6.0;
    assert!((got.final_m + exact).abs() < 1e-14);
    assert!((got.first_slide_time_s.unwrap() - start).abs() < 1e-15);
    assert!((got.speed_max_m_s - (jump * left + 0.5 * c * left * left)).abs() < 1e-14);
}

/// ẋ = 0 twice within one interval: a slide to the right at 0.05 g s stops at 0.084 s, turns back,
/// stops and sticks at 0.156 s, and starts to the right again at 0.28 s.
#[test]
fn the_velocity_passes_zero_twice_in_one_interval() {
    let g = G0_M_S2;
    let motion = Motion::new(1.0, vec![-g, 0.5 * g, -2.0 * g, 0.0]).unwrap();
    let coarse = solve(&motion, &options(0.2, 0.2));
    let fine = solve(&motion.upsampled(1024), &options(0.2, 0.2));
    let mut pieces = Vec::new();
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    slide_observed(base, &options(0.2, 0.2), |piece| pieces.push(*piece)).unwrap();
    let second: Vec<f64> = pieces
        .iter()
        .map(|p| p.start_s - 1.0)
        .filter(|t| (0.0..1.0).contains(t))
        .collect();
    let (stop, onset) = ((0.7 - 0.24f64.sqrt()) / 2.5, 0.28);
    assert_eq!(second.len(), 4, "{second:?}");
    assert!(
        (second[1] - stop).abs() < 1e-14 && (second[3] - onset).abs() < 1e-14,
        "{second:?}"
    );
    // 3072 steps in place of 3; each adds one rounding.
    assert!((coarse.final_m - fine.final_m).abs() < 1e-11 * coarse.path_m);
    assert!((coarse.path_m - fine.path_m).abs() < 1e-11 * coarse.path_m);
    assert!((coarse.peak_m - fine.peak_m).abs() < 1e-11 * coarse.path_m);
    assert_eq!(coarse.slide_count, fine.slide_count);
}

/// A threshold that is met exactly is not passed, at rest and at the start of the motion.
#[test]
fn a_threshold_met_exactly_holds() {
    let under = |samples: Vec<f64>| {
        let motion = Motion::new(0.25, samples).unwrap();
        solve(
            &motion,
            &SlidingOptions {
                gravity_m_s2: 8.0,
                ..options(0.25, 0.125)
            },
        )
    };
    assert_eq!(
        under(vec![2.0, 2.0, -2.0, 0.0, 2.0, 2.0]).outcome,
        SlidingOutcome::Stuck
    );
    assert_eq!(
        under(vec![2.0, 2.0, 2.0 + 4.0 * f64::EPSILON, 2.0]).outcome,
        SlidingOutcome::Slid
    );
}

#[test]
fn the_first_clearance_that_is_reached_counts() {
    let g = G0_M_S2;
    // To the left by 0.1 m and more, then back to the right.
    let motion = Motion::new(
        0.1,
        vec![0.5 * g, 0.5 * g, 0.5 * g, -2.0 * g, -2.0 * g, -2.0 * g, 0.0],
    )
    .unwrap();
    let with = |left_m, right_m| {
        let clearance = Clearance { left_m, right_m };
        solve(
            &motion,
            &SlidingOptions {
                clearance,
                ..settled(options(0.2, 0.2))
            },
        )
    };
    let free = with(None, None);
    assert!(free.peak_m > 0.5 && free.contact.is_none());
    let (time_s, velocity_m_s) = with(Some(0.05), Some(0.5)).contact.unwrap();
    // 0.3 g from rest: x = 0.15 g t², ẋ = 0.3 g t, within the first 0.2 s.
    let exact = (0.05 / (0.15 * g)).sqrt();
    assert!((time_s - exact).abs() < 1e-14 && (velocity_m_s + 0.3 * g * exact).abs() < 1e-13);
    assert!(with(Some(10.0), Some(0.5)).contact.unwrap().1 > 0.0);
    assert_eq!(with(Some(10.0), Some(100.0)).contact, None);
    // Something touches the block: it is reached at once, without speed.
    assert_eq!(with(Some(0.0), None).contact, Some((0.0, 0.0)));
    // The slide is that without an obstacle.
    assert_eq!(
        Sliding {
            contact: None,
            ..with(Some(0.05), Some(0.5))
        },
        free
    );
}

/// Where the weight falls to nothing the history ends; until then less weight means less friction.
#[test]
fn free_flight_ends_the_history() {
    let g = G0_M_S2;
    let horizontal = Motion::new(0.5, vec![0.1 * g; 4]).unwrap();
    let vertical = Motion::new(0.5, vec![0.0, 0.0, -2.0 * g, -2.0 * g]).unwrap();
    let got = slide(
        Base {
            horizontal: Some(&horizontal),
            vertical: Some(&vertical),
        },
        &options(0.2, 0.2),
    )
    .unwrap();
    assert_eq!(
        (got.outcome, got.end_time_s),
        (SlidingOutcome::FreeFlight, 0.75)
    );
    // g(1 − 4τ) μ = 0.1 g at τ = 1/8.
    assert!((got.first_slide_time_s.unwrap() - 0.625).abs() < 1e-15);
    assert!(got.final_m < 0.0 && got.peak_time_s == Some(0.75));
}

#[test]
fn impossible_values_are_refused() {
    assert!(Friction::new(0.2, 0.3).is_err() && Friction::new(f64::NAN, 0.1).is_err());
    assert!(Friction::uniform(-0.1).is_err() && Friction::uniform(f64::INFINITY).is_err());
    let motion = Motion::new(0.1, vec![0.0; 3]).unwrap();
    let base = Base {
        horizontal: Some(&motion),
        vertical: None,
    };
    let clearance = Clearance {
        left_m: Some(-0.1),
        right_m: None,
    };
    let refused = |options: SlidingOptions| slide(base, &options).unwrap_err();
    let good = options(0.2, 0.1);
    assert_eq!(
        refused(SlidingOptions { clearance, ..good }),
        SlidingError::Clearance { clearance_m: -0.1 }
    );
    assert!(matches!(
        refused(SlidingOptions {
            gravity_m_s2: 0.0,
            ..good
        }),
        SlidingError::Base(_)
    ));
    assert!(matches!(
        refused(SlidingOptions {
            until: Until::Time(-1.0),
            ..good
        }),
        SlidingError::Base(_)
    ));
    assert!(slide(Base::default(), &good).is_err());
}

/// √[(8/3)gR(1−cos α)]/cos α; with an offset, the edge that needs less.
#[test]
fn the_trip_speed_has_its_closed_form() {
    let block = Block::uniform(2.0, 0.6).unwrap();
    let edge = block.pivot();
    let rise = edge.half_diagonal_m * (1.0 - edge.slenderness_angle_rad.cos());
    let closed = (8.0 / 3.0 * G0_M_S2 * rise).sqrt() / edge.slenderness_angle_rad.cos();
    assert!((trip_speed_m_s(&block, G0_M_S2) - closed).abs() < 1e-14);
    let leaning = block.with_cg_offset(0.1).unwrap();
    assert!(trip_speed_m_s(&leaning, G0_M_S2) < closed);
    assert_eq!(
        trip_speed_m_s(&leaning, G0_M_S2),
        trip_speed_m_s(&leaning.mirrored(), G0_M_S2)
    );
}

/// Samples that are multiples of half the threshold (g = 8, μ_s = 1/4, threshold 2), so that
/// thresholds are met exactly and rounding does not decide.
fn troubled() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec((-12i32..=12).prop_map(f64::from), 3..24)
}

fn binary(kinetic_ratio: f64) -> SlidingOptions {
    SlidingOptions {
        gravity_m_s2: 8.0,
        ..settled(options(0.25, kinetic_ratio))
    }
}

/// The block stops at 15/28 s, at the instant at which a falling ü passes the threshold of 2 m/s²: it sticks,
/// however the straight lines are divided and rounded, until ü = −2 at 4/7 s. All of its path by hand.
#[test]
fn a_stop_at_the_threshold_sticks() {
    let motion = Motion::new(0.125, vec![-4.0, -3.0, 6.0, -8.0, 6.0, -8.0]).unwrap();
    for parts in [1, 2, 8] {
        let fine = motion.with_zero_tail(0.125).unwrap().upsampled(parts);
        let got = solve(&fine, &binary(0.125));
        // Some tens of roundings.
        let error = got.final_m - 6211.0 / 18816.0;
        assert!(error.abs() < 1e-14, "{parts}: {error}");
        assert_eq!(got.slide_count, 2);
    }
}

/// A speed that only touches 0 is a stop as well, inside an interval and at a sample of finer lines: the block
/// sticks until the threshold, where without rounding it would otherwise go on.
#[test]
fn a_speed_that_touches_zero_is_a_stop() {
    let motion = Motion::new(0.125, vec![9.0, -10.0, 7.0, -12.0]).unwrap();
    let found = [1, 2, 8].map(|parts| {
        let fine = motion.with_zero_tail(0.125).unwrap().upsampled(parts);
        solve(&fine, &binary(0.125))
    });
    for got in &found[1..] {
        // Some tens of roundings, and a stop that moves by √ε at no speed.
        assert!((got.final_m - found[0].final_m).abs() < 1e-13, "{got:?}");
        assert_eq!(got.slide_count, found[0].slide_count);
    }
    assert_eq!(found[0].slide_count, 2);
}

proptest! {
    // PROPTEST_CASES may ask for more.
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases.max(300), ..ProptestConfig::default() })]

    /// −ü gives −x to the bit; twice ü and g give twice x to the bit.
    #[test]
    fn mirror_and_similarity(samples in troubled(), half in any::<bool>()) {
        let options = binary(if half { 0.125 } else { 0.25 });
        let motion = Motion::new(0.125, samples).unwrap();
        let got = solve(&motion, &options);
        let mirrored = solve(&motion.scaled(-1.0).unwrap(), &options);
        prop_assert_eq!(mirrored.peak_m, -got.peak_m);
        prop_assert_eq!(mirrored.final_m, -got.final_m);
        prop_assert_eq!((mirrored.path_m, mirrored.slide_count), (got.path_m, got.slide_count));
        let doubled = solve(&motion.scaled(2.0).unwrap(), &SlidingOptions { gravity_m_s2: 16.0, ..options });
        prop_assert_eq!((doubled.peak_m, doubled.path_m), (2.0 * got.peak_m, 2.0 * got.path_m));
        prop_assert_eq!(doubled.speed_max_m_s, 2.0 * got.speed_max_m_s);
    }

    /// Zeros after the motion change nothing: it returns to zero in one step anyway. Samples on its
    /// straight lines change rounding only: at a stop that grazes zero, its root.
    #[test]
    fn zeros_and_samples_on_straight_lines(samples in troubled(), half in any::<bool>()) {
        let options = binary(if half { 0.125 } else { 0.25 });
        let motion = Motion::new(0.125, samples).unwrap();
        let got = solve(&motion, &options);
        let padded = solve(&motion.with_zero_tail(3.0).unwrap(), &options);
        let close = |a: f64, b: f64, within: f64| (a - b).abs() <= within * (1.0 + got.path_m);
        // The quiet time is divided into steps, each with one rounding.
        prop_assert!(close(padded.final_m, got.final_m, 1e-13) && close(padded.path_m, got.path_m, 1e-13));
        // A power of two puts the new samples exactly on the lines, here with the return to zero after
        // the last sample; a grazing stop moves by √ε.
        let fine = solve(&motion.with_zero_tail(0.125).unwrap().upsampled(8), &options);
        prop_assert!(close(fine.final_m, got.final_m, 1e-7), "{} {}", fine.final_m, got.final_m);
        prop_assert!(close(fine.peak_m.abs(), got.peak_m.abs(), 1e-7));
        prop_assert!(close(fine.path_m, got.path_m, 1e-7));
    }

    /// What every slide satisfies; and the pieces join: each begins where the one before ends.
    #[test]
    fn the_pieces_of_a_history_join(samples in troubled(), half in any::<bool>()) {
        let options = binary(if half { 0.125 } else { 0.25 });
        let motion = Motion::new(0.125, samples).unwrap();
        let mut pieces: Vec<SlidingPiece> = Vec::new();
        let base = Base { horizontal: Some(&motion), vertical: None };
        let got = slide_observed(base, &options, |piece| pieces.push(*piece)).unwrap();
        prop_assert!(got.path_m >= got.peak_m.abs() && got.peak_m.abs() >= got.final_m.abs());
        prop_assert!(got.final_velocity_m_s == 0.0, "settled");
        for pair in pieces.windows(2) {
            let (x, v) = pair[0].state(pair[0].length_s);
            prop_assert!((pair[0].start_s + pair[0].length_s - pair[1].start_s).abs() < 1e-12);
            prop_assert!((x - pair[1].slide_m).abs() < 1e-12 * (1.0 + got.path_m));
            // A stop is a root: within √ε of zero where it grazes.
            prop_assert!((v - pair[1].velocity_m_s).abs() < 1e-7 * (1.0 + got.speed_max_m_s));
        }
    }
}
