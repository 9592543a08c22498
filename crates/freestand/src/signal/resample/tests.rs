use super::*;
use std::f64::consts::TAU;

/// A wave of 4 Hz in a bell of 0.3 s around t = 5 s: above 7.5 Hz it contains only e^(−½
/// (3.5·2π·0.3)²) = 4e-10 of itself, and above 12 Hz 1e-49; e^(−½ (5/0.3)²) = 1e-60 is left of it
/// at 0 and 10 s.
fn wavelet(t: f64) -> f64 {
    let x = (t - 5.0) / 0.3;
    (-0.5 * x * x).exp() * (TAU * 4.0 * t + 0.7).cos()
}

fn sampled(dt_s: f64) -> Motion {
    let samples = (10.0 / dt_s).round() as usize + 1;
    Motion::new(
        dt_s,
        (0..samples).map(|k| wavelet(k as f64 * dt_s)).collect(),
    )
    .unwrap()
}

fn worst(motion: &Motion) -> f64 {
    let error = |(k, a): (usize, &f64)| (a - wavelet(k as f64 * motion.dt_s())).abs();
    motion
        .accel_m_s2()
        .iter()
        .enumerate()
        .map(error)
        .fold(0.0, f64::max)
}

#[test]
fn a_band_limited_motion_comes_back() {
    // Nyquist frequencies of 25 and 20 Hz contain it; the rounding of two transforms is a few ε
    // times log₂ of their length.
    for (from_s, to_s) in [
        (0.02, 0.01),
        (0.02, 0.005),
        (0.025, 0.02),
        (0.01, 0.025),
        (0.01, 0.004),
        (1.0 / 64.0, 0.01),
        (0.01, 1.0 / 64.0),
    ] {
        let motion = resampled(&sampled(from_s), to_s).unwrap();
        assert_eq!(
            (motion.dt_s(), motion.accel_m_s2().len()),
            (to_s, (10.0 / to_s) as usize + 1)
        );
        assert!(
            worst(&motion) < 1e-14 * 10.0,
            "{from_s} {to_s}: {:e}",
            worst(&motion)
        );
    }
    for factor in [2, 3, 7, 10, 11] {
        let motion = upsampled_sinc(&sampled(0.02), factor).unwrap();
        assert_eq!(motion.accel_m_s2().len(), 500 * factor + 1);
        assert!(worst(&motion) < 1e-13, "{factor}: {:e}", worst(&motion));
    }
}

#[test]
fn what_is_above_the_new_nyquist_frequency_is_left_out_and_not_aliased() {
    // 30 Hz in a bell of 0.3 s, resampled to 25 samples per second: without the filter a wave of
    // 5 Hz would appear at full size.
    let dt_s = 0.005;
    let fast = |t: f64| (-0.5 * ((t - 5.0) / 0.3).powi(2)).exp() * (TAU * 30.0 * t).cos();
    let samples: Vec<f64> = (0..=2000)
        .map(|k| fast(f64::from(k) * dt_s) + wavelet(f64::from(k) * dt_s))
        .collect();
    let motion = resampled(&Motion::new(dt_s, samples).unwrap(), 0.04).unwrap();
    // The bell leaves e^(−½ (8.5·2π·0.3)²) = 1e-56 and less of 4 Hz above 12.5 Hz, and of 30 Hz
    // below it. The fade cuts the mirrored half of the bell, which lets 2e-13 of 30 Hz through.
    assert!(worst(&motion) < 1e-12, "{:e}", worst(&motion));
}

#[test]
fn own_samples_stay_to_the_bit() {
    let accel: Vec<f64> = (0..300)
        .map(|k| ((k * k % 37) as f64 - 11.0) * 0.1)
        .collect();
    let motion = Motion::new(0.01, accel).unwrap();
    let fine = upsampled_sinc(&motion, 4).unwrap();
    assert!(fine.accel_m_s2().iter().step_by(4).eq(motion.accel_m_s2()));
    assert_eq!(resampled(&motion, 0.0025).unwrap(), fine);
    for unchanged in [
        upsampled_sinc(&motion, 0),
        upsampled_sinc(&motion, 1),
        resampled(&motion, 0.01),
    ] {
        assert_eq!(unchanged.unwrap(), motion);
    }
}

#[test]
fn a_jump_at_an_end_does_not_ring() {
    // With zeros beyond the ends, a constant and a ramp would jump by their whole value, and
    // overshoot by 9 % inside. Mirrored, they continue smoothly; what remains is rounding and the
    // fade, 1000 samples long.
    let constant = upsampled_sinc(&Motion::new(0.01, vec![2.0; 2000]).unwrap(), 5).unwrap();
    let ramp: Vec<f64> = (0..2000).map(|k| 1.0 - 0.001 * f64::from(k)).collect();
    let ramp = upsampled_sinc(&Motion::new(0.01, ramp).unwrap(), 5).unwrap();
    for (k, (c, r)) in constant
        .accel_m_s2()
        .iter()
        .zip(ramp.accel_m_s2())
        .enumerate()
    {
        let want = 1.0 - 0.0002 * k as f64;
        assert!(
            (c - 2.0).abs() < 1e-9 && (r - want).abs() < 1e-9,
            "{k} {c} {r}"
        );
    }
}

#[test]
fn transforms_are_respaced_as_scipy_does() {
    // scipy 1.17.1: scipy.signal.resample([1, 2, -1, 0.5, 3, -2][:from], to).tolist(),
    // rounded to 15 digits.
    let cases: [(usize, &[f64]); 6] = [
        (
            6,
            &[
                1.0,
                2.55058337429784,
                0.979304887527257,
                -1.0,
                -0.825164887286304,
                2.14374390858793,
                3.0,
                -0.600418487011537,
                -1.99804879611519,
            ],
        ),
        (
            6,
            &[
                1.0,
                2.48025545439968,
                0.416666666666667,
                -1.31358878773302,
                0.5,
                3.30521336578399,
                0.416666666666667,
                -2.13854669911732,
            ],
        ),
        (
            6,
            &[
                0.583333333333333,
                0.416666666666667,
                0.916666666666666,
                0.416666666666667,
            ],
        ),
        (
            6,
            &[0.416666666666667, 0.666666666666667, 0.666666666666667],
        ),
        (
            5,
            &[
                1.0,
                1.75141525889502,
                1.64674362973134,
                -0.588166393799135,
                -1.35967477524977,
                1.11962435882518,
                3.11293114551843,
                2.11712677607893,
            ],
        ),
        (
            5,
            &[1.0, 1.64674362973134, -1.35967477524977, 3.11293114551843],
        ),
    ];
    for (from, want) in cases {
        let from = &[1.0, 2.0, -1.0, 0.5, 3.0, -2.0][..from];
        let mut values: Vec<Complex<f64>> =
            from.iter().map(|&re| Complex { re, im: 0.0 }).collect();
        let mut planner = FftPlannerScalar::new();
        planner.plan_fft_forward(from.len()).process(&mut values);
        let mut values = respaced(&values, want.len());
        planner.plan_fft_inverse(want.len()).process(&mut values);
        for (value, want) in values.iter().zip(want) {
            // The printed digits.
            assert!(
                (value.re / from.len() as f64 - want).abs() < 1e-14,
                "{values:?} {want}"
            );
            assert!(value.im.abs() < 1e-14);
        }
    }
}

#[test]
fn lengths_are_smooth_and_close() {
    for least in 1..2000_u32 {
        let length = smooth_length(f64::from(least));
        let mut rest = length as u64;
        for prime in [2, 3, 5] {
            while u64::is_multiple_of(rest, prime) {
                rest /= prime;
            }
        }
        // The largest gap between such numbers below 2000 is 8 % (1 in 12).
        assert!(
            rest == 1 && length >= f64::from(least) && length < 1.5 * f64::from(least),
            "{least} {length}"
        );
    }
    assert_eq!(smooth_length(1_000_001.0), 1_012_500.0);
}

#[test]
fn ratios_are_found_or_refused() {
    assert_eq!(Ratio::near(0.01 / 0.005), Some(Ratio { up: 2, down: 1 }));
    assert_eq!(Ratio::near(0.005 / 0.01), Some(Ratio { up: 1, down: 2 }));
    assert_eq!(
        Ratio::near(1.0 / 256.0 / 0.005),
        Some(Ratio { up: 25, down: 32 })
    );
    assert_eq!(
        Ratio::near(0.01 / 0.0033),
        Some(Ratio { up: 100, down: 33 })
    );
    for odd in [
        std::f64::consts::PI * 0.1,
        1e-5,
        2e4,
        f64::NAN,
        f64::INFINITY,
        0.0,
    ] {
        assert_eq!(Ratio::near(odd), None, "{odd}");
    }
}

#[test]
fn steps_that_cannot_be_are_refused() {
    let motion = sampled(0.01);
    for dt_s in [0.0, -0.01, f64::NAN, f64::INFINITY, 11.0] {
        assert!(
            matches!(resampled(&motion, dt_s), Err(ResampleError::Step { .. })),
            "{dt_s}"
        );
    }
    assert!(matches!(
        resampled(&motion, 0.01 / 2f64.sqrt()),
        Err(ResampleError::Ratio { .. })
    ));
    assert!(matches!(
        resampled(&motion, 0.01 / 9999.0 / 9999.0),
        Err(ResampleError::Ratio { .. })
    ));
    for factor in [30_000, usize::MAX] {
        assert!(matches!(
            upsampled_sinc(&motion, factor),
            Err(ResampleError::TooLong { .. })
        ));
    }
    // Two samples make a motion, the shortest one that has a curve.
    let shortest = Motion::new(1.0, vec![0.0, 1.0]).unwrap();
    assert_eq!(upsampled_sinc(&shortest, 2).unwrap().accel_m_s2().len(), 3);
    assert_eq!(resampled(&shortest, 1.0).unwrap(), shortest);
}

/// A transform chosen for the processor sums in another order, and the last bits of a motion would
/// depend on the machine.
#[test]
fn the_same_bits_with_and_without_vector_units() {
    assert!(
        rustfft::FftPlannerAvx::<f64>::new().is_err(),
        "rustfft was built with vector units"
    );
    let motion = sampled(0.01);
    let accel = motion.accel_m_s2();
    let mirrored = MIRRORED.min(accel.len() - 1);
    let old = smooth_length((accel.len() + 2 * mirrored) as f64) as usize;
    let new = 2 * old;
    let mut values = continued(accel, mirrored, old);
    FftPlannerScalar::new()
        .plan_fft_forward(old)
        .process(&mut values);
    let mut values = respaced(&values, new);
    FftPlannerScalar::new()
        .plan_fft_inverse(new)
        .process(&mut values);
    let doubled = upsampled_sinc(&motion, 2).unwrap();
    for (index, (got, want)) in doubled
        .accel_m_s2()
        .iter()
        .zip(&values)
        .enumerate()
        .skip(1)
        .step_by(2)
    {
        assert_eq!(
            got.to_bits(),
            (want.re * (1.0 / old as f64)).to_bits(),
            "sample {index}"
        );
    }
}
