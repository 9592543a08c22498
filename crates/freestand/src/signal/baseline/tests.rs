use super::*;

/// `k = np.arange(400); a = ((k*k % 37) - 18.0)*0.1; dt = 0.02; t = k*dt`
fn uneven() -> Motion {
    Motion::new(
        0.02,
        (0..400)
            .map(|k| (f64::from(k * k % 37) - 18.0) * 0.1)
            .collect(),
    )
    .unwrap()
}

fn assert_samples(motion: &Motion, at: [usize; 4], want: [f64; 4], tolerance: f64) {
    for (index, want) in at.into_iter().zip(want) {
        let got = motion.accel_m_s2()[index];
        assert!((got - want).abs() < tolerance, "{index}: {got} {want}");
    }
}

#[test]
fn polynomials_are_those_of_numpy() {
    // numpy 2: `a - np.polynomial.chebyshev.Chebyshev.fit(t, a, degree)(t)`
    // at samples 0, 57, 200, 399.
    for (degree, want) in [
        (
            1,
            [
                -1.7741172069825437,
                1.2168448521553261,
                -1.505829280183001,
                0.8626172069825437,
            ],
        ),
        (
            3,
            [
                -1.7136870664529742,
                1.1970377682114384,
                -1.4941402951421079,
                0.7570345559382163,
            ],
        ),
        (
            10,
            [
                -0.6003910410629507,
                1.3416857853006894,
                -1.5548849345065001,
                0.655776585981999,
            ],
        ),
    ] {
        let got = corrected(&uneven(), Baseline::Polynomial { degree }).unwrap();
        // Both sides keep 14 digits of values of size 2.
        assert_samples(&got, [0, 57, 200, 399], want, 1e-13);
    }
}

#[test]
fn velocity_fits_are_those_of_numpy() {
    // v = np.r_[0, np.cumsum(0.5*dt*(a[1:] + a[:-1]))]; s = (t[f:] - t[f])/(t[-1] - t[f])
    // c = np.linalg.lstsq(np.stack([s**j for j in range(1, degree + 1)], 1), v[f:])[0]
    // The derivative sum(c_j j s**(j - 1))/(t[-1] - t[f]) is subtracted, half of it at f > 0;
    // samples 0, f, 200, 399.
    for (degree, from, want) in [
        (
            2,
            0,
            [
                -1.799633916258,
                -1.799633916258,
                -1.5002034839241718,
                0.8992297962479872,
            ],
        ),
        (
            3,
            50,
            [
                -1.8,
                0.29868804122380566,
                -1.4987131995432397,
                0.8936571346079085,
            ],
        ),
        (
            6,
            0,
            [
                -1.7768535798117782,
                -1.7768535798117782,
                -1.5024957971357469,
                0.8102243417274257,
            ],
        ),
    ] {
        let baseline = Baseline::Graizer {
            degree,
            from_s: from as f64 * 0.02,
        };
        // The powers in lstsq have a condition of 1e6 at degree 6: 1e-10 of velocities of 0.1 m/s
        // over 8 s.
        assert_samples(
            &corrected(&uneven(), baseline).unwrap(),
            [0, from, 200, 399],
            want,
            1e-11,
        );
    }
}

#[test]
fn a_high_degree_on_a_long_record_keeps_its_digits() {
    // x¹⁰ on 200 000 samples; its size is 1, and the sums keep 14 digits.
    let samples = 200_000;
    let accel = (0..samples).map(|k| place(k, samples).powi(10)).collect();
    let motion = Motion::new(0.005, accel).unwrap();
    let rest = corrected(&motion, Baseline::Polynomial { degree: 10 }).unwrap();
    assert!(rest.peak_m_s2() < 1e-12, "{:e}", rest.peak_m_s2());
}

#[test]
fn means_are_taken_off() {
    let motion = Motion::new(0.01, vec![1.0, 3.0, 2.0, 6.0]).unwrap();
    assert_eq!(
        corrected(&motion, Baseline::Mean).unwrap().accel_m_s2(),
        [-2.0, 0.0, -1.0, 3.0]
    );
    // Samples at 0 and 0.01 s are before 0.02 s.
    let quiet = corrected(&motion, Baseline::PreEvent { until_s: 0.02 }).unwrap();
    assert_eq!(quiet.accel_m_s2(), [-1.0, 1.0, 0.0, 4.0]);
    let one = corrected(&motion, Baseline::PreEvent { until_s: 1e-9 }).unwrap();
    assert_eq!(one.accel_m_s2(), [0.0, 2.0, 1.0, 5.0]);
}

#[test]
fn known_offsets_are_found_again() {
    // A pulse without a final velocity, and offsets of 0.02 m/s² from 4 s and of −0.005 m/s² from
    // 10 s on: the velocity after them is a straight line, so both are recovered.
    let (dt_s, samples) = (0.01, 4001);
    let clean: Vec<f64> = (0..samples)
        .map(|k| {
            if (500..700).contains(&k) {
                (std::f64::consts::PI * (k - 500) as f64 / 100.0).sin()
            } else {
                0.0
            }
        })
        .collect();
    let offset = |k: usize| match k {
        0..400 => 0.0,
        400 => 0.01,
        401..1000 => 0.02,
        1000 => 0.0075,
        _ => -0.005,
    };
    let accel = clean
        .iter()
        .enumerate()
        .map(|(k, a)| a + offset(k))
        .collect();
    let motion = Motion::new(dt_s, accel).unwrap();
    let got = corrected(
        &motion,
        Baseline::Boore2001 {
            t1_s: 4.0,
            t2_s: 10.0,
        },
    )
    .unwrap();
    for (got, want) in got.accel_m_s2().iter().zip(&clean) {
        // Sums of 4000 values of 1 m/s² over 6 s.
        assert!((got - want).abs() < 1e-13, "{got} {want}");
    }
    // Graizer's correction is made for a drift of the velocity, here 0.1 m/s · (s + s²/2 …) from
    // 5 s on.
    let ramp = |k: usize| {
        if k > 500 {
            0.004 + 0.0003 * (k - 500) as f64 * dt_s
        } else {
            0.0
        }
    };
    let accel = clean
        .iter()
        .enumerate()
        .map(|(k, _)| if k == 500 { 0.002 } else { ramp(k) })
        .collect();
    let drifting = Motion::new(dt_s, accel).unwrap();
    let rest = corrected(
        &drifting,
        Baseline::Graizer {
            degree: 2,
            from_s: 5.0,
        },
    )
    .unwrap();
    // At the first sample after the start the velocity is that of half an interval less: 0.002·dt
    // below the parabola, which changes the fit by the share of one sample in 3500.
    assert!(rest.peak_m_s2() < 1e-6, "{:e}", rest.peak_m_s2());
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let motion = Motion::new(0.1, vec![1.0; 21]).unwrap();
    let refused = |baseline| corrected(&motion, baseline).unwrap_err();
    for degree in [11, usize::MAX] {
        assert!(matches!(
            refused(Baseline::Polynomial { degree }),
            BaselineError::Degree { .. }
        ));
        assert!(matches!(
            refused(Baseline::Graizer {
                degree,
                from_s: 0.0
            }),
            BaselineError::Degree { .. }
        ));
    }
    assert!(matches!(
        refused(Baseline::Graizer {
            degree: 0,
            from_s: 0.0
        }),
        BaselineError::Degree { .. }
    ));
    assert!(matches!(
        refused(Baseline::Graizer {
            degree: 2,
            from_s: 1.8
        }),
        BaselineError::TooShort { .. }
    ));
    for time_s in [-1.0, 2.5, f64::NAN] {
        assert!(matches!(
            refused(Baseline::PreEvent { until_s: time_s }),
            BaselineError::Time { .. }
        ));
        assert!(matches!(
            refused(Baseline::Graizer {
                degree: 2,
                from_s: time_s
            }),
            BaselineError::Time { .. }
        ));
        assert!(matches!(
            refused(Baseline::Boore2001 {
                t1_s: time_s,
                t2_s: 1.0
            }),
            BaselineError::Time { .. }
        ));
        assert!(matches!(
            refused(Baseline::Boore2001 {
                t1_s: 0.5,
                t2_s: time_s
            }),
            BaselineError::Time { .. }
        ));
    }
    for (t1_s, t2_s) in [(1.0, 1.0), (1.0, 0.9), (0.5, 1.9)] {
        assert!(
            matches!(
                refused(Baseline::Boore2001 { t1_s, t2_s }),
                BaselineError::Time { .. }
            ),
            "{t1_s} {t2_s}"
        );
    }
    let two = Motion::new(0.1, vec![1.0; 2]).unwrap();
    assert!(matches!(
        corrected(&two, Baseline::Polynomial { degree: 2 }),
        Err(BaselineError::TooShort { .. })
    ));
    assert!(corrected(&two, Baseline::Polynomial { degree: 1 }).is_ok());
}
