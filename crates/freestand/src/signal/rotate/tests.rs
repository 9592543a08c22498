use super::*;

/// `k = np.arange(400); a = ((k*k % 37) - 18.0)*0.1; dt = 0.02`
/// `b = ((k*k % 41) - 20.0)*0.07 + 0.3*np.sin(0.05*k)`
fn pair() -> (Motion, Motion) {
    let a = (0..400)
        .map(|k| (f64::from(k * k % 37) - 18.0) * 0.1)
        .collect();
    let b = (0..400)
        .map(|k| (f64::from(k * k % 41) - 20.0) * 0.07 + 0.3 * (0.05 * f64::from(k)).sin())
        .collect();
    (Motion::new(0.02, a).unwrap(), Motion::new(0.02, b).unwrap())
}

#[test]
fn rotd_is_that_of_scipy_and_numpy() {
    // scipy 1.17.1, numpy 2:
    // u1 = lsim(StateSpace([[0, 1], [-w*w, -0.1*w]], [[0], [-1]], [[1, 0]], [[0]]), a, t)[1],
    // which is exact for an input that is linear between samples; u2 with b; then
    // sa = w*w*abs(outer(cos(th), u1) + outer(sin(th), u2)).max(1)
    // sa[0], sa[90], np.percentile(sa, [0, 16, 50, 84, 100])
    let want = [
        [
            1.8,
            1.6998720809124517,
            1.6998720809124517,
            1.9022446947377092,
            2.22272166388423,
            2.378347126958021,
            2.432676609903652,
        ],
        [
            2.485575461601515,
            3.462017087872146,
            2.467682060472653,
            2.9531176852699668,
            3.6983696973272027,
            3.968254499313214,
            4.029077588373555,
        ],
        [
            1.4392946547979273,
            1.678282204106242,
            1.261872569100214,
            1.4052343019994018,
            1.5632385156122348,
            1.7509022551437725,
            1.7830330991487444,
        ],
    ];
    let (a, b) = pair();
    let pair = Pair::new(&a, &b).unwrap();
    let got = directional_spectrum(
        &pair,
        0.05,
        &[0.0, 0.3, 1.0],
        &[0.0, 16.0, 50.0, 84.0, 100.0],
    )
    .unwrap();
    for (i, want) in want.into_iter().enumerate() {
        let mut row = vec![got.first_m_s2[i], got.second_m_s2[i]];
        row.extend(got.rotd_m_s2.iter().map(|nn| nn[i]));
        for (got, want) in row.iter().zip(want) {
            // SciPy's matrix exponential keeps 12 digits over 400 steps.
            assert!((got / want - 1.0).abs() < 1e-11, "{i}: {got} {want}");
        }
        assert_eq!(got.larger_m_s2[i], row[0].max(row[1]));
        assert_eq!(got.geometric_mean_m_s2[i], (row[0] * row[1]).sqrt());
    }
}

#[test]
fn components_are_those_of_the_response_spectrum() {
    let (a, b) = pair();
    let periods = [0.1, 0.5, 2.0];
    let got = directional_spectrum(&Pair::new(&a, &b).unwrap(), 0.02, &periods, &[]).unwrap();
    for (motion, got) in [(&a, &got.first_m_s2), (&b, &got.second_m_s2)] {
        let want = crate::oscillator::response_spectrum(motion, 0.02, &periods)
            .unwrap()
            .psa_m_s2;
        for (got, want) in got.iter().zip(want) {
            // ω·(ω·u) there and (ω·ω)·u here.
            assert!((got / want - 1.0).abs() < 1e-15, "{got} {want}");
        }
    }
}

#[test]
fn few_points_give_the_peaks_of_all() {
    // A narrow ellipse, a circle, a line and a cloud, compared with every point in every direction.
    let shapes: [fn(f64) -> (f64, f64); 4] = [
        |t| (t.cos(), 0.05 * (t + 0.3).sin()),
        |t| (t.cos(), t.sin()),
        |t| (t.sin(), 2.0 * t.sin()),
        |t| {
            (
                (1.3 * t).sin() * (0.1 * t).cos(),
                (2.1 * t).cos() * (0.17 * t).sin(),
            )
        },
    ];
    for shape in shapes {
        let points: Vec<(f64, f64)> = (0..500).map(|k| shape(0.37 * f64::from(k))).collect();
        let got = peaks_by_direction(&points);
        for (degrees, got) in got.into_iter().enumerate() {
            let (cos, sin) = direction(degrees);
            let want = points
                .iter()
                .map(|(x, y)| (x * cos + y * sin).abs())
                .fold(0.0, f64::max);
            assert_eq!(got, want, "{degrees}");
        }
    }
    assert_eq!(
        peaks_by_direction(&[(0.0, 0.0), (0.0, 0.0)]),
        vec![0.0; DIRECTIONS]
    );
}

#[test]
fn a_motion_along_one_line_is_found_in_every_frame() {
    // 2 sin along 30 degrees from north; components at 350 and 80, then at 10 and 80 degrees.
    let along = |degrees: f64| {
        let share = 2.0 * (30.0 - degrees).to_radians().cos();
        Motion::new(
            0.01,
            (0..100)
                .map(|k| share * (0.1 * f64::from(k)).sin())
                .collect(),
        )
        .unwrap()
    };
    let want = along(30.0);
    for (first_deg, second_deg) in [(350.0, 80.0), (10.0, 80.0), (80.0, 350.0), (-10.0, 440.0)] {
        let (first, second) = (along(first_deg), along(second_deg));
        let pair = Pair::new(&first, &second).unwrap();
        let across = pair.component_at(first_deg, second_deg, 120.0).unwrap();
        let got = pair.component_at(first_deg, second_deg, 30.0).unwrap();
        // A few roundings of values of 2, at most doubled by the angle between the components.
        assert!(
            across.peak_m_s2() < 1e-14,
            "{first_deg} {second_deg} {:e}",
            across.peak_m_s2()
        );
        assert!(
            got.accel_m_s2()
                .iter()
                .zip(want.accel_m_s2())
                .all(|(a, b)| (a - b).abs() < 1e-14)
        );
    }
}

#[test]
fn a_component_at_its_own_azimuth_is_itself() {
    let (a, b) = pair();
    let pair = Pair::new(&a, &b).unwrap();
    assert_eq!(pair.component_at(0.0, 90.0, 0.0).unwrap(), a);
    assert_eq!(pair.component_at(37.0, 127.0, 127.0).unwrap(), b);
    assert_eq!(pair.component_at(37.0, 307.0, 37.0).unwrap(), a);
    let turned = pair.component_at(37.0, 127.0, 217.0).unwrap();
    assert_eq!(turned, a.scaled(-1.0).unwrap());
}

#[test]
fn components_that_do_not_belong_together_are_refused() {
    let (a, b) = pair();
    let short = Motion::new(0.02, vec![1.0; 399]).unwrap();
    let fast = Motion::new(0.01, vec![1.0; 400]).unwrap();
    assert!(matches!(
        Pair::new(&a, &short),
        Err(RotateError::Lengths { .. })
    ));
    assert!(matches!(
        Pair::new(&a, &fast),
        Err(RotateError::Steps { .. })
    ));
    let pair = Pair::new(&a, &b).unwrap();
    for second_deg in [0.0, 29.0, 151.0, 180.0, 360.0] {
        assert!(
            matches!(
                pair.component_at(0.0, second_deg, 10.0),
                Err(RotateError::Parallel { .. })
            ),
            "{second_deg}"
        );
    }
    assert!(matches!(
        pair.component_at(0.0, 90.0, f64::NAN),
        Err(RotateError::Azimuth { .. })
    ));
    for percentile in [-1.0, 100.1, f64::NAN] {
        let refused = directional_spectrum(&pair, 0.05, &[1.0], &[percentile]);
        assert!(matches!(refused, Err(RotateError::Percentile { .. })));
    }
    let refused = [(1.0, 1.0), (-0.1, 1.0), (0.05, -1.0), (0.05, f64::NAN)];
    for (damping, period) in refused {
        let refused = directional_spectrum(&pair, damping, &[period], &[50.0]);
        assert!(
            matches!(refused, Err(RotateError::Oscillator(_))),
            "{damping} {period}"
        );
    }
}
