use super::*;

/// Frequencies and dampings that reach both branches of the kernel, the border between them and
/// both extremes.
const OMEGA_DT: [f64; 9] = [1e-6, 1e-3, 0.1, 0.499_999, 0.500_001, 1.0, 3.0, 40.0, 1e4];
const ZETA: [f64; 4] = [0.0, 0.05, 0.7, 0.999];
const DT_S: f64 = 0.01;

/// Response to a = `step` + `ramp`·t from rest, textbook closed form.
fn exact(omega: f64, zeta: f64, step: f64, ramp: f64, t: f64) -> f64 {
    let omega_d = omega * (1.0 - zeta * zeta).sqrt();
    let decay = (-zeta * omega * t).exp();
    let (sin, cos) = (omega_d * t).sin_cos();
    let to_step = 1.0 - decay * (cos + zeta * omega / omega_d * sin);
    let to_ramp = t - 2.0 * zeta / omega
        + decay * (2.0 * zeta / omega * cos + (2.0 * zeta * zeta - 1.0) / omega_d * sin);
    -(step * to_step + ramp * to_ramp) / (omega * omega)
}

#[test]
fn step_and_ramp_are_exact_at_every_sample() {
    for x in OMEGA_DT.into_iter().filter(|&x| x > 0.05) {
        for zeta in ZETA {
            let omega = x / DT_S;
            let step = OscillatorStep::new(omega, zeta, DT_S).unwrap();
            let mut state = OscillatorState::default();
            for k in 0..200 {
                let t = k as f64 * DT_S;
                state = step.advance(state, 3.0 - 2.0 * t, 3.0 - 2.0 * (t + DT_S));
                let want = exact(omega, zeta, 3.0, -2.0, t + DT_S);
                // Rounding: the argument of the sine, up to ω t = 2e6 and therefore wrong by
                // 2e6 ε = 5e-10, times the size of the response, 2·3/ω²; plus 200 steps of a
                // few ε.
                let tolerance = 6.0 / (omega * omega) * (1e-12 + 4.0 * omega * t * f64::EPSILON);
                assert!(
                    (state.displacement_m - want).abs() < tolerance,
                    "x {x}, zeta {zeta}, k {k}"
                );
            }
        }
    }
}

#[test]
fn a_slow_oscillator_lets_the_base_move_away() {
    // ω dt → 0: u = −∫∫a, whatever the damping; the closed form would have no digits left at ω
    // dt = 1e-6.
    for zeta in ZETA {
        let step = OscillatorStep::new(1e-6 / DT_S, zeta, DT_S).unwrap();
        let state = step.advance(OscillatorState::default(), 1.0, 4.0);
        // Trapezium: a₀ dt²/2 + (a₁ − a₀) dt²/6 = dt²; the neglected term is of order ζ ω dt =
        // 1e-6.
        assert!((state.displacement_m / (-DT_S * DT_S) - 1.0).abs() < 2e-6);
        assert!((state.velocity_m_s / (-2.5 * DT_S) - 1.0).abs() < 2e-6);
    }
}

#[test]
fn a_stiff_oscillator_follows_the_base() {
    // ω dt → ∞ with damping: the absolute acceleration is that of the base, except for 2ζ/(ω
    // dt) of its change.
    let motion = Motion::new(DT_S, vec![0.0, 1.0, -2.0, 5.0, 0.5]).unwrap();
    let history = absolute_acceleration_history_m_s2(&motion, TAU * DT_S / 1e4, 0.05).unwrap();
    for (a, base) in history.iter().zip(motion.accel_m_s2()) {
        // Largest change 7 m/s² · 2·0.05/1e4 for the lag, and 7/1e4 for the vibration that the
        // slope excites.
        assert!((a - base).abs() < 7.0 * 1.1e-4, "{a} {base}");
    }
}

#[test]
fn free_vibration_is_exact() {
    for x in OMEGA_DT.into_iter().filter(|&x| x < 50.0) {
        for zeta in ZETA {
            let omega = x / DT_S;
            let omega_d = omega * (1.0 - zeta * zeta).sqrt();
            let step = OscillatorStep::new(omega, zeta, DT_S).unwrap();
            let mut state = OscillatorState {
                displacement_m: 0.3,
                velocity_m_s: 0.2 * omega,
            };
            for k in 1..=100 {
                state = step.advance(state, 0.0, 0.0);
                let t = k as f64 * DT_S;
                let (sin, cos) = (omega_d * t).sin_cos();
                let want = (-zeta * omega * t).exp()
                    * (0.3 * cos + (0.2 * omega + zeta * omega * 0.3) / omega_d * sin);
                // 100 steps of a few ε; near-critical damping magnifies them by ω/ω_D = 22.
                assert!(
                    (state.displacement_m - want).abs() < 1e-12,
                    "x {x}, zeta {zeta}, k {k}"
                );
            }
        }
    }
}

#[test]
fn both_branches_of_the_kernel_agree_where_they_meet() {
    for zeta in ZETA {
        let (a, b) = (
            kernel_series(SERIES_BELOW, zeta, DT_S),
            kernel_closed(SERIES_BELOW / DT_S, zeta, DT_S),
        );
        // The closed form loses about 12/(ω dt)³ ≈ 100 ε in S₂; the series loses nothing.
        for (series, closed) in [(a.h, b.h), (a.s1, b.s1), (a.s2, b.s2)] {
            assert!(
                (series / closed - 1.0).abs() < 300.0 * f64::EPSILON,
                "zeta {zeta}: {series} {closed}"
            );
        }
    }
}

#[test]
fn the_sampling_of_a_sine_costs_the_square_of_the_step() {
    // Steady state under sin(Ω t): amplitude of u is 1/√((ω²−Ω²)² + (2ζωΩ)²). A motion is
    // linear between samples, so the error is that of the interpolation, O(dt²): halving the
    // step divides it by 4.
    let (omega, zeta, drive) = (TAU, 0.05, 5.0);
    let error = |per_second: usize| {
        let step = OscillatorStep::new(omega, zeta, 1.0 / per_second as f64).unwrap();
        let mut state = OscillatorState::default();
        let a = |k: usize| (drive * k as f64 / per_second as f64).sin();
        for k in 0..60 * per_second {
            state = step.advance(state, a(k), a(k + 1));
        }
        let (stiff, damp) = (omega * omega - drive * drive, 2.0 * zeta * omega * drive);
        let (sin, cos) = (drive * 60.0_f64).sin_cos();
        // After 60 s the transient is e^(−19) = 6e-9 of the result, far below the errors of
        // 1e-5.
        state.displacement_m + (stiff * sin - damp * cos) / (stiff * stiff + damp * damp)
    };
    let ratio = error(50) / error(100);
    // The next term of the error is (Ω dt)² = 1 % of the first.
    assert!((ratio - 4.0).abs() < 0.04, "{ratio}");
}

#[test]
fn a_period_of_zero_gives_the_pga_and_the_lanes_equal_the_single_oscillator() {
    let accel: Vec<f64> = (0..400)
        .map(|k| ((k * k % 37) as f64 - 18.0) * 0.1)
        .collect();
    let motion = Motion::new(0.02, accel).unwrap();
    let periods_s: Vec<f64> = (0..19).map(|i| i as f64 * 0.17).collect();
    let spectrum = response_spectrum(&motion, 0.05, &periods_s).unwrap();
    assert_eq!(
        (
            spectrum.sd_m[0],
            spectrum.psv_m_s[0],
            spectrum.psa_m_s2[0],
            spectrum.sa_m_s2[0]
        ),
        (0.0, 0.0, motion.peak_m_s2(), motion.peak_m_s2())
    );
    for (i, &period_s) in periods_s.iter().enumerate().skip(1) {
        let history = absolute_acceleration_history_m_s2(&motion, period_s, 0.05).unwrap();
        let peak = history.iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
        assert_eq!(spectrum.sa_m_s2[i].to_bits(), peak.to_bits());
        let omega = TAU / period_s;
        assert_eq!(spectrum.psa_m_s2[i], omega * (omega * spectrum.sd_m[i]));
    }
}

#[test]
fn a_bank_of_displacements_equals_the_single_oscillators() {
    // Noise that falls above 3 Hz, with a jump at the start; ten seconds, so that a period of 5 s
    // has its peak.
    let (mut random, mut a) = (7_u32, 3.0);
    let accel: Vec<f64> = (0..2000)
        .map(|_| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            a = 0.9 * a + f64::from(random >> 8) / f64::from(1 << 23) - 1.0;
            a
        })
        .collect();
    let dt_s = 0.005;
    let periods_s: Vec<f64> = (0..121)
        .map(|i| 0.05 * 100_f64.powf(f64::from(i) / 120.0))
        .collect();
    let motion = Motion::new(dt_s, accel.clone()).unwrap();
    let exact = response_spectrum(&motion, 0.05, &periods_s).unwrap().sd_m;
    let bank = DisplacementBank::new(&periods_s, 0.05, dt_s).unwrap();
    let peaks_m = bank.peaks_m(&accel);
    assert_eq!(peaks_m.len(), 121);
    for ((peak, exact), period_s) in peaks_m.iter().zip(exact).zip(periods_s) {
        // 1e-16 (T/2π dt)² of the peak, at most 3e-12, in each of some hundred steps.
        assert!((peak / exact - 1.0).abs() < 1e-10, "{period_s}");
    }
    assert_eq!(bank.peaks_m(&accel[..1]), [0.0; 121]);
    let first = response_spectrum(
        &Motion::new(dt_s, accel[..2].to_vec()).unwrap(),
        0.05,
        &[1.0],
    );
    let one = DisplacementBank::new(&[1.0], 0.05, dt_s).unwrap();
    // A division and a multiplication by b₂ more.
    let ratio = one.peaks_m(&accel[..2])[0] / first.unwrap().sd_m[0];
    assert!((ratio - 1.0).abs() < 4.0 * f64::EPSILON, "{ratio}");
}

#[test]
fn a_quick_bank_takes_a_fifth_of_the_steps_and_misses_little() {
    // Noise that falls above 3 Hz and starts from quiet, as ground motions do.
    let (mut random, mut a) = (7_u32, 0.0);
    let accel: Vec<f64> = (0..9001)
        .map(|k| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            a = 0.9 * a + f64::from(random >> 8) / f64::from(1 << 23) - 1.0;
            a * (f64::from(k) / 500.0).min(1.0)
        })
        .collect();
    let periods_s: Vec<f64> = (0..121)
        .map(|i| 0.05 * 100_f64.powf(f64::from(i) / 120.0))
        .collect();
    let exact = DisplacementBank::new(&periods_s, 0.05, 0.005).unwrap();
    let quick = DisplacementBank::quick(&periods_s, 0.05, 0.005).unwrap();
    let (Groups::Exact(all), Groups::Quick(thinned)) = (&exact.groups, &quick.groups) else {
        panic!("another kind");
    };
    let every: Vec<usize> = thinned.iter().map(|group| group.every).collect();
    // Vectors of one size: eight on every sample, four on all, a half, a fourth and a sixteenth.
    assert_eq!((all.len(), &every[..]), (8, &[1, 2, 4, 16][..]));
    let ratios: Vec<f64> = quick
        .peaks_m(&accel)
        .iter()
        .zip(exact.peaks_m(&accel))
        .map(|(quick, exact)| quick / exact - 1.0)
        .collect();
    assert_eq!(ratios.len(), 121);
    let mean = ratios.iter().sum::<f64>() / 121.0;
    // A peak that lies between samples is missed by 1.9 % at most, less the 0.6 % that are added;
    // each of 121 by about 0.5 %, so the mean is within 4 × 0.5 %/√121 of 0.
    assert!(ratios.iter().all(|ratio| ratio.abs() < 0.02), "{ratios:?}");
    assert!(mean.abs() < 0.002, "{mean}");
}

/// Quiet before, which is left out, and after, where vibration decays. The number of samples before is one of whole samples of
/// the most thinned group, so that the others do not shift.
#[test]
fn a_quick_bank_does_not_see_quiet() {
    let periods_s: Vec<f64> = (0..121)
        .map(|i| 0.05 * 100_f64.powf(f64::from(i) / 120.0))
        .collect();
    let quick = DisplacementBank::quick(&periods_s, 0.05, 0.005).unwrap();
    // A push, after which oscillators of long periods go on.
    let shaking = (1..100).map(|k| (std::f64::consts::PI * f64::from(k) / 100.0).sin());
    let quiet = |samples: usize| std::iter::repeat_n(0.0, samples);
    let alone: Vec<f64> = quiet(160)
        .chain(shaking.clone())
        .chain(quiet(2000))
        .collect();
    let within: Vec<f64> = quiet(960).chain(shaking).chain(quiet(5000)).collect();
    assert_eq!(quick.peaks_m(&alone), quick.peaks_m(&within));
    // All of it counts: without the quiet after it, long periods have not had their peaks.
    let cut = quick.peaks_m(&alone[..259]);
    let both = || cut.iter().zip(quick.peaks_m(&alone));
    assert!(both().all(|(cut, whole)| *cut <= whole) && both().any(|(cut, whole)| *cut < whole));
    assert_eq!(quick.peaks_m(&[0.0; 40]), [0.0; 121]);
}

#[test]
fn an_oscillator_starts_at_rest_under_a_motion_that_starts_with_a_jump() {
    let motion = Motion::new(DT_S, vec![2.0; 2]).unwrap();
    let history = absolute_acceleration_history_m_s2(&motion, 1.0, 0.05).unwrap();
    let (omega, zeta) = (TAU, 0.05);
    let omega_d = omega * (1.0_f64 - zeta * zeta).sqrt();
    let u = exact(omega, zeta, 2.0, 0.0, DT_S);
    let v = -2.0 * (-zeta * omega * DT_S).exp() * (omega_d * DT_S).sin() / omega_d;
    assert_eq!(history[0], 0.0);
    // The textbook form cancels at ω dt = 0.06: 1e-16/0.06² of the answer.
    assert!((history[1] + 2.0 * zeta * omega * v + omega * omega * u).abs() < 1e-13);
}

#[test]
fn what_is_not_an_oscillator_is_refused() {
    let motion = Motion::new(DT_S, vec![0.0, 1.0]).unwrap();
    for damping_ratio in [-0.01, 1.0, f64::NAN] {
        let refused = response_spectrum(&motion, damping_ratio, &[0.0]);
        assert!(matches!(refused, Err(OscillatorError::Damping { .. })));
    }
    for period_s in [-1.0, f64::NAN, f64::INFINITY, 1e-200] {
        let refused = response_spectrum(&motion, 0.05, &[1.0, period_s]);
        assert!(
            matches!(refused, Err(OscillatorError::Period { .. })),
            "{period_s}"
        );
    }
    assert!(matches!(
        OscillatorStep::new(1.0, 0.0, 0.0),
        Err(OscillatorError::TimeStep { .. })
    ));
}
