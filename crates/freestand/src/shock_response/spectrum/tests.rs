use super::super::{Peak, half_sine_maximax_ratio};
use super::*;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn half_sine(duration_s: f64, steps: u32) -> Motion {
    let sine = |k: u32| (PI * f64::from(k) / f64::from(steps)).sin();
    Motion::new(
        duration_s / f64::from(steps),
        (0..=steps).map(sine).collect(),
    )
    .unwrap()
}

fn sampled(kind: ResponseKind, damping_ratio: f64) -> ShockSpectrumOptions {
    ShockSpectrumOptions {
        kind,
        damping_ratio,
        upsample: false,
    }
}

fn maximax(motion: &Motion, frequencies_hz: &[f64], options: ShockSpectrumOptions) -> Vec<f64> {
    let spectrum = shock_spectrum(motion, frequencies_hz, options).unwrap();
    spectrum
        .peaks
        .iter()
        .map(|one| one.peak(Peak::Maximax))
        .collect()
}

const KINDS: [ResponseKind; 3] = [
    ResponseKind::AbsoluteAcceleration,
    ResponseKind::RelativeDisplacement,
    ResponseKind::PseudoVelocity,
];

/// Undamped oscillators under a half-sine agree with the closed form, from the impulsive to the
/// static end.
#[test]
fn half_sine_without_damping_is_the_closed_form() {
    let options = ShockSpectrumOptions {
        damping_ratio: 0.0,
        ..ShockSpectrumOptions::default()
    };
    let frequencies: Vec<f64> = (0..=140).map(|i| (f64::from(i) / 10.0).exp2()).collect();
    let values = maximax(&half_sine(0.011, 1100), &frequencies, options);
    for (f, value) in frequencies.iter().zip(values) {
        let exact = half_sine_maximax_ratio(f * 0.011);
        // A component has at least 128 samples in a period: 0.05 %, as documented.
        assert!((value / exact - 1.0).abs() < 5e-4, "{f}: {value} {exact}");
    }
}

/// ζ = 0.05, maximax divided by the peak of a half-sine, from a fine numerical solution.
#[test]
fn half_sine_with_damping() {
    let values = maximax(
        &half_sine(1.0, 20_000),
        &[0.25, 0.5, 1.0, 2.0],
        ShockSpectrumOptions::default(),
    );
    for (value, expected) in values.iter().zip([0.87808, 1.46264, 1.62379, 1.21237]) {
        // Half a unit of the last digit.
        assert!((value - expected).abs() < 5.1e-6, "{value} {expected}");
    }
}

/// Smallwood's biquad in its direct form, with zeros appended to the motion in place of the closed
/// form.
fn biquad(
    motion: &Motion,
    frequency_hz: f64,
    zeta: f64,
    kind: ResponseKind,
    tail: usize,
) -> Vec<f64> {
    let (w, h) = (TAU * frequency_hz, motion.dt_s());
    let root = (1.0 - zeta * zeta).sqrt();
    let (e, a, b) = ((-zeta * w * h).exp(), w * h, w * h * root);
    let (c, s) = (e * b.cos(), e * b.sin());
    let sp = s / b;
    let q = (2.0 * zeta * zeta - 1.0) / root;
    let [b0, b1, b2] = match kind {
        ResponseKind::AbsoluteAcceleration => [1.0 - sp, 2.0 * (sp - c), e * e - sp],
        _ => {
            let scale = -1.0 / (w * w * a);
            let b0 = 2.0 * zeta * (c - 1.0) + q * s + a;
            let b1 = -2.0 * c * a + 2.0 * zeta * (1.0 - e * e) - 2.0 * q * s;
            let b2 = e * e * (a + 2.0 * zeta) - 2.0 * zeta * c + q * s;
            let power = if kind == ResponseKind::PseudoVelocity {
                w
            } else {
                1.0
            };
            [b0, b1, b2].map(|b| b * scale * power)
        }
    };
    let (mut x, mut y) = ([0.0; 2], [0.0; 2]);
    let samples = motion
        .accel_m_s2()
        .iter()
        .copied()
        .chain(std::iter::repeat_n(0.0, tail));
    let step = |now: f64| {
        let out = b0 * now + b1 * x[0] + b2 * x[1] + 2.0 * c * y[0] - e * e * y[1];
        (x, y) = ([now, x[0]], [out, y[0]]);
        out
    };
    samples.map(step).collect()
}

fn noise(seed: u64, samples: usize) -> Vec<f64> {
    use rand::SeedableRng;
    use rand_distr::Distribution;
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
    (0..samples)
        .map(|_| rand_distr::StandardNormal.sample(&mut random))
        .collect()
}

/// All kinds and peaks agree with the filter in the form of ISO 18431-4. The free decay is sampled
/// there and exact here: they agree as far as 1000 samples per period allow.
#[test]
fn it_is_the_filter_of_iso_18431_4() {
    let motion = Motion::new(1e-3, noise(5, 2000)).unwrap();
    for kind in KINDS {
        for (f, zeta) in [
            (1.0, 0.05),
            (7.0, 0.0),
            (60.0, 0.1),
            (170.0, 0.5),
            (499.0, 0.02),
        ] {
            let spectrum = shock_spectrum(&motion, &[f], sampled(kind, zeta)).unwrap();
            let response = biquad(&motion, f, zeta, kind, if f < 2.0 { 2000 } else { 0 });
            let (primary, residual) = response.split_at(2000);
            let most = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
            let least = |part: &[f64]| 0.0 - part.iter().copied().fold(0.0, f64::min);
            let peaks = spectrum.peaks[0];
            let scale = peaks.peak(Peak::Primary);
            // The biquad's own rounding: 1e-16/(ωh)² = 3e-12 per sample at 1 Hz, over 2000 samples.
            assert!(
                (peaks.primary_positive - most(primary)).abs() < 1e-9 * scale,
                "{kind:?} {f}"
            );
            assert!(
                (peaks.primary_negative - least(primary)).abs() < 1e-9 * scale,
                "{kind:?} {f}"
            );
            if !residual.is_empty() {
                for (exact, sampled) in [
                    (peaks.residual_positive, most(residual)),
                    (peaks.residual_negative, least(residual)),
                ] {
                    // (π/1000)²/2 = 5e-6 of the peak between samples.
                    assert!(
                        (-1e-9 * scale..=1e-5 * scale).contains(&(exact - sampled)),
                        "{kind:?} {exact} {sampled}"
                    );
                }
            }
        }
    }
}

/// Digits at 1 Hz and 100 kHz: the velocity shock of a pulse of 1 ms, in closed form.
#[test]
fn slow_components_keep_their_digits() {
    let motion = half_sine(1e-3, 100);
    let exact: f64 = motion.accel_m_s2().iter().sum::<f64>() * motion.dt_s();
    let values = maximax(&motion, &[1e-3], sampled(ResponseKind::PseudoVelocity, 0.0));
    // (ωT)²/24 is 2e-12 at 1 mHz; ωh is 6e-8 and the biquad would have no digits left.
    assert!(
        (values[0] / exact - 1.0).abs() < 1e-11,
        "{}",
        values[0] / exact - 1.0
    );
}

/// The same shock at twice the sampling rate, below a twentieth of it: less than 0.1 %.
#[test]
fn twice_the_rate_is_the_same_spectrum() {
    // Struck tones with content up to a fifth of the lower rate, and less than 1e-12 above half of
    // it.
    let tone = |t: f64, f: f64, at: f64, width: f64| {
        (-((t - at) / width).powi(2)).exp() * (TAU * f * (t - at) + 0.4).cos()
    };
    let shock = |t: f64| {
        50.0 * tone(t, 30.0, 0.1, 0.02)
            + 90.0 * tone(t, 430.0, 0.09, 0.003)
            + 40.0 * tone(t, 1900.0, 0.11, 0.001)
    };
    let at = |rate: f64| {
        Motion::new(
            1.0 / rate,
            (0..=(0.2 * rate) as usize)
                .map(|k| shock(k as f64 / rate))
                .collect(),
        )
    };
    let frequencies: Vec<f64> = (0..=108)
        .map(|i| (f64::from(i) / 12.0).exp2())
        .take_while(|f| *f < 500.0)
        .collect();
    for kind in KINDS {
        let options = ShockSpectrumOptions {
            kind,
            ..ShockSpectrumOptions::default()
        };
        let coarse = maximax(&at(1e4).unwrap(), &frequencies, options);
        let fine = maximax(&at(2e4).unwrap(), &frequencies, options);
        for ((f, coarse), fine) in frequencies.iter().zip(coarse).zip(fine) {
            assert!(
                (coarse / fine - 1.0).abs() < 1e-3,
                "{kind:?} {f}: {coarse} {fine}"
            );
        }
    }
}

/// A tone at a tenth of the sampling rate: the sampled peaks are up to 5 % low, the upsampled ones
/// 0.05 %.
#[test]
fn upsampling_finds_the_peaks_between_samples() {
    let rate = 1e4;
    let tone = |k: usize| {
        let t = k as f64 / rate;
        (PI * t / 0.1).sin().powi(2) * (TAU * 1000.0 * t + 0.3).sin()
    };
    let motion = Motion::new(1.0 / rate, (0..=1000).map(tone).collect()).unwrap();
    let truth = {
        let fine = |k: usize| {
            let t = k as f64 / (200.0 * rate);
            (PI * t / 0.1).sin().powi(2) * (TAU * 1000.0 * t + 0.3).sin()
        };
        let motion = Motion::new(1.0 / (200.0 * rate), (0..=200_000).map(fine).collect()).unwrap();
        maximax(
            &motion,
            &[1000.0],
            sampled(ResponseKind::AbsoluteAcceleration, 0.05),
        )[0]
    };
    let found = maximax(&motion, &[1000.0], ShockSpectrumOptions::default())[0];
    let as_sampled = maximax(
        &motion,
        &[1000.0],
        sampled(ResponseKind::AbsoluteAcceleration, 0.05),
    )[0];
    assert!((found / truth - 1.0).abs() < 5e-4, "{found} {truth}");
    assert!(as_sampled / truth - 1.0 < -0.01, "{as_sampled} {truth}");
}

/// Tones that fill the band up to half the rate: even components with more than 128 samples per
/// period respond to them through their damper, and straight lines between the samples remove half
/// of the highest ones.
#[test]
fn slow_components_feel_what_fills_the_band() {
    let noise = |t: f64| {
        let tone = |k: u32| (TAU * (5.0 + 25.0 * f64::from(k)) * t + 2.4 * f64::from(k * k)).sin();
        (PI * t / 0.4).sin().powi(2) * (0..192).map(tone).sum::<f64>()
    };
    let at = |factor: u32| {
        let rate = 1e4 * f64::from(factor);
        Motion::new(
            1.0 / rate,
            (0..=4000 * factor)
                .map(|k| noise(f64::from(k) / rate))
                .collect(),
        )
        .unwrap()
    };
    let frequencies = [10.0, 20.0, 40.0, 75.0];
    let bare = sampled(ResponseKind::AbsoluteAcceleration, 0.05);
    let truth = maximax(&at(32), &frequencies, bare);
    let worst = |options| {
        let found = maximax(&at(1), &frequencies, options);
        found
            .iter()
            .zip(&truth)
            .map(|(found, truth)| (found / truth - 1.0).abs())
            .fold(0.0, f64::max)
    };
    // The documented accuracy; without upsampling the error is more than twice that.
    let (found, as_sampled) = (worst(ShockSpectrumOptions::default()), worst(bare));
    assert!(found < 1e-3 && as_sampled > 2e-3, "{found} {as_sampled}");
}

#[test]
fn wrong_input_is_refused_and_overflow_noticed() {
    let motion = half_sine(0.01, 10);
    let with =
        |f: f64, zeta: f64| shock_spectrum(&motion, &[f], sampled(ResponseKind::default(), zeta));
    for f in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e200] {
        assert!(
            matches!(with(f, 0.05), Err(ShockResponseError::Frequency { .. })),
            "{f}"
        );
    }
    for zeta in [-0.1, 1.0, f64::NAN] {
        assert!(
            matches!(with(10.0, zeta), Err(ShockResponseError::Damping { .. })),
            "{zeta}"
        );
    }
    let huge = Motion::new(0.001, vec![0.0, 1e308, 1e308, 1e308, -1e308, 0.0]).unwrap();
    let found = shock_spectrum(&huge, &[400.0], sampled(ResponseKind::default(), 0.0));
    assert!(
        matches!(found, Err(ShockResponseError::Overflow { .. })),
        "{found:?}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// The response is linear; the sign only exchanges the peaks; the maximax is never below the
    /// residual.
    #[test]
    fn scaling_and_mirror(seed in 0u64..1000, factor in 0.1f64..50.0, f in 0.5f64..400.0, zeta in 0.0f64..0.9) {
        let samples = noise(seed, 300);
        let motion = |scale: f64| Motion::new(1e-3, samples.iter().map(|a| scale * a).collect()).unwrap();
        for upsample in [false, true] {
            let options = ShockSpectrumOptions { kind: ResponseKind::default(), damping_ratio: zeta, upsample };
            let one = shock_spectrum(&motion(1.0), &[f], options).unwrap().peaks[0];
            let scaled = shock_spectrum(&motion(factor), &[f], options).unwrap().peaks[0];
            let mirrored = shock_spectrum(&motion(-1.0), &[f], options).unwrap().peaks[0];
            prop_assert!(one.peak(Peak::Maximax) >= one.peak(Peak::Residual));
            for (peak, other) in [(Peak::Positive, Peak::Negative), (Peak::Residual, Peak::Residual)] {
                // The phase of a decay is rounded, and that of its mirror image differently.
                let (a, b) = (one.peak(peak), mirrored.peak(other));
                prop_assert!((a - b).abs() <= 1e-13 * one.peak(Peak::Maximax), "{} {}", a, b);
            }
            for peak in [Peak::Maximax, Peak::Positive, Peak::Negative, Peak::Primary, Peak::Residual] {
                // Every sum is rounded separately: some 300 of them.
                let (a, b) = (factor * one.peak(peak), scaled.peak(peak));
                prop_assert!((a - b).abs() <= 1e-12 * factor * one.peak(Peak::Maximax).max(1.0), "{} {}", a, b);
            }
        }
    }

    /// Without damping, a shock and its reverse leave the same residual: the magnitude of its
    /// transform.
    #[test]
    fn residual_without_damping_does_not_know_the_direction_of_time(seed in 0u64..1000, f in 0.5f64..400.0) {
        let samples = noise(seed, 300);
        let residual = |samples: Vec<f64>| {
            let motion = Motion::new(1e-3, samples).unwrap();
            let spectrum = shock_spectrum(&motion, &[f], sampled(ResponseKind::default(), 0.0)).unwrap();
            spectrum.peaks[0].peak(Peak::Residual)
        };
        let (one, other) = (residual(samples.clone()), residual(samples.into_iter().rev().collect()));
        prop_assert!((one - other).abs() < 1e-10 * one.max(1.0), "{} {}", one, other);
    }

    /// Zeros around a shock that begins and ends with zeros change nothing, and the residual
    /// becomes primary.
    #[test]
    fn zeros_around_change_nothing(seed in 0u64..1000, before in 0usize..40, after in 0usize..40, f in 0.5f64..400.0) {
        let mut samples = noise(seed, 200);
        (samples[0], samples[199]) = (0.0, 0.0);
        let options = sampled(ResponseKind::default(), 0.05);
        let bare = shock_spectrum(&Motion::new(1e-3, samples.clone()).unwrap(), &[f], options).unwrap().peaks[0];
        let padded = [vec![0.0; before], samples, vec![0.0; after]].concat();
        let padded = shock_spectrum(&Motion::new(1e-3, padded).unwrap(), &[f], options).unwrap().peaks[0];
        prop_assert!(padded.peak(Peak::Primary) >= bare.peak(Peak::Primary));
        // What was exact in the decay is now sampled, and the reverse: the difference is at most
        // what sampling misses.
        let missed = 1.0 - (PI * (f * 1e-3).min(0.5)).cos();
        let (a, b) = (bare.peak(Peak::Maximax), padded.peak(Peak::Maximax));
        prop_assert!(b <= a * (1.0 + 1e-12) && b >= a * (1.0 - missed - 1e-12), "{} {}", a, b);
    }

    /// The bits do not depend on the vector unit or on the other oscillators.
    #[test]
    fn bits_do_not_depend_on_vectors_or_company(seed in 0u64..1000) {
        let motion = Motion::new(1e-3, noise(seed, 400)).unwrap();
        let frequencies: Vec<f64> = (0..37).map(|i| (f64::from(i) / 5.0).exp2()).collect();
        let options = ShockSpectrumOptions::default();
        let plain = shock_spectrum_on(pulp::Arch::Scalar, &motion, &frequencies, options).unwrap();
        prop_assert_eq!(&plain, &shock_spectrum(&motion, &frequencies, options).unwrap());
        let alone = shock_spectrum(&motion, &frequencies[20..21], options).unwrap();
        prop_assert_eq!(alone.peaks[0], plain.peaks[20]);
    }
}
