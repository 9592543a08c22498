use super::*;
use crate::measures::{Integrals, integrals};
use rustfft::num_complex::Complex;

fn response(sections: &[Section], hz: f64, dt_s: f64) -> Complex<f64> {
    let z = Complex::from_polar(1.0, -std::f64::consts::TAU * hz * dt_s);
    let gain = |s: &Section| {
        let ([b0, b1, b2], [a1, a2]) = (s.numerator, s.denominator);
        (b0 + (b1 + b2 * z) * z) / (1.0 + (a1 + a2 * z) * z)
    };
    sections.iter().map(gain).product()
}

/// scipy 1.17.1:
/// `sosfreqz(butter(order, corner, kind, fs=1/dt, output="sos"), worN=[hz], fs=1/dt)`,
/// at half the corner, the corner and 1.3 times the corner (1.2 for low-pass filters).
#[test]
fn frequency_responses_are_those_of_scipy() {
    type Case = (u32, f64, bool, f64, [(f64, f64); 3]);
    let cases: [Case; 7] = [
        (
            4,
            0.1,
            true,
            0.01,
            [
                (0.013008445663728852, -0.06100618344264266),
                (-0.7071067811891566, -1.191965795601122e-12),
                (-0.5969343793558665, 0.731073665985398),
            ],
        ),
        (
            5,
            0.5,
            true,
            0.005,
            [
                (0.031054106758053333, -0.0033319534672686777),
                (-0.49999999999962397, -0.49999999999983546),
                (-0.8999338351862054, 0.3499940075181016),
            ],
        ),
        (
            10,
            0.25,
            true,
            0.02,
            [
                (0.0009640223801947126, -0.0001521786844115417),
                (2.311620194578621e-13, 0.7071067811868087),
                (0.6139074687082617, -0.7860593396504523),
            ],
        ),
        (
            4,
            0.01,
            true,
            0.01,
            [
                (0.013008350207533716, -0.06100682459899966),
                (-0.7071067813873514, -3.3415110225403917e-10),
                (-0.5969384925750494, 0.7310691116066238),
            ],
        ),
        (
            1,
            2.0,
            false,
            0.01,
            [
                (0.8003160039772076, -0.3997628018652569),
                (0.5, -0.4999999999999995),
                (0.4095553700128786, -0.49175173503150177),
            ],
        ),
        (
            3,
            25.0,
            false,
            0.005,
            [
                (0.5322559139576765, -0.8393976572791554),
                (-0.5, -0.5),
                (-0.4538640474453102, -0.13413851239975694),
            ],
        ),
        (
            8,
            40.0,
            false,
            0.01,
            [
                (0.34541039538123824, -0.938451734864161),
                (0.7071067811865482, 0.0),
                (1.072761759873919e-6, 1.6595534198998737e-6),
            ],
        ),
    ];
    for (order, corner_hz, is_high, dt_s, want) in cases {
        let sections = if is_high {
            high_pass_sections
        } else {
            low_pass_sections
        };
        let sections = sections(corner_hz, order, dt_s).unwrap();
        let ratios = [0.5, 1.0, if is_high { 1.3 } else { 1.2 }];
        for (ratio, (re, im)) in ratios.into_iter().zip(want) {
            let got = response(&sections, ratio * corner_hz, dt_s);
            // The coefficients of both sides are rounded to ε; near z = 1 they cancel to the square
            // of the corner.
            let k = (PI * corner_hz * dt_s).tan().min(1.0);
            let tolerance = 1e-13 + 2.0 * f64::from(order) * f64::EPSILON / (k * k);
            assert!(
                (got - Complex::new(re, im)).norm() < tolerance,
                "{order} {corner_hz} {ratio}: {got}"
            );
        }
    }
}

#[test]
fn coefficients_are_those_of_scipy() {
    // scipy 1.17.1: butter(order, corner, kind, fs=100, output="sos")
    let near = |got: &[f64], want: &[f64]| {
        // Each is the result of a few operations of size 2.
        assert!(
            got.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-14),
            "{got:?} {want:?}"
        );
    };
    let low = low_pass_sections(5.0, 2, 0.01).unwrap();
    near(
        &low[0].numerator,
        &[
            0.020083365564211232,
            0.040166731128422464,
            0.020083365564211232,
        ],
    );
    near(
        &low[0].denominator,
        &[-1.5610180758007182, 0.6413515380575631],
    );
    let high = high_pass_sections(5.0, 2, 0.01).unwrap();
    near(
        &high[0].numerator,
        &[0.8005924034645702, -1.6011848069291403, 0.8005924034645702],
    );
    near(
        &high[0].denominator,
        &[-1.5610180758007182, 0.6413515380575631],
    );
    let third = low_pass_sections(5.0, 3, 0.01).unwrap();
    near(&third[0].denominator, &[-0.726542528005361, 0.0]);
    near(
        &third[1].denominator,
        &[-1.647552215703991, 0.7323389172728038],
    );
    // SciPy puts the gain of all sections into the first one.
    near(
        &[third[0].numerator[0] * third[1].numerator[0]],
        &[0.00289819463372143],
    );
    let fourth = high_pass_sections(0.5, 4, 0.01).unwrap();
    near(
        &fourth[1].denominator,
        &[-1.9426382305401135, 0.9435972784703671],
    );
    near(
        &fourth[0].denominator,
        &[-1.975269634851873, 0.9762447923594398],
    );
    near(
        &[fourth[0].numerator[0] * fourth[1].numerator[0]],
        &[0.9597822300872386],
    );
}

/// The same recipe for `ours` and SciPy:
/// ```python
/// k = np.arange(400); x = ((k*k % 37) - 18.0)*0.1; dt = 0.02
/// y = np.r_[np.zeros(pad), x, np.zeros(pad)]                      # pad = 1.5 n/fc/dt
/// sos = np.vstack([butter(n, low, "high", fs=50, output="sos"),
///                  butter(n, high, "low", fs=50, output="sos")])
/// y = sosfilt(sos, sosfilt(sos, y)[::-1])[::-1]
/// ```
#[test]
fn filtered_series_are_those_of_scipy() {
    type Case = (Pass, u32, usize, [f64; 8]);
    let cases: [Case; 4] = [
        (
            Pass::High { low_cut_hz: 0.5 },
            4,
            600,
            [
                2.080991210590987e-09,
                -2.8420438199893884e-05,
                -1.7814123929761727,
                -1.682540348454673,
                -1.4997585715459336,
                0.8292198963482333,
                -0.07062870001288603,
                -3.9213118570301205e-09,
            ],
        ),
        (
            Pass::Low { high_cut_hz: 8.0 },
            3,
            29,
            [
                -1.0587732784908544e-07,
                -0.0005421677633982336,
                -1.2472273927465705,
                -1.593165668980003,
                -0.12368952045277073,
                0.036367998341163464,
                0.07114202414999908,
                -1.4222933608372384e-08,
            ],
        ),
        (
            Pass::Band {
                low_cut_hz: 0.2,
                high_cut_hz: 10.0,
            },
            5,
            1875,
            [
                2.1278727589610764e-09,
                -1.2626685188688535e-06,
                -1.2273943110631136,
                -1.7286161734705339,
                -0.35573366493789904,
                -0.03174149706629624,
                0.14639561638473153,
                6.797533118492008e-10,
            ],
        ),
        (
            Pass::Band {
                low_cut_hz: 0.1,
                high_cut_hz: 20.0,
            },
            4,
            3000,
            [
                -1.3147892573834794e-09,
                -1.9994800730111907e-06,
                -1.5373411249537816,
                -1.9323753872739342,
                -1.0704730762701626,
                0.30434732085340255,
                0.3955257445035347,
                7.353463854710225e-10,
            ],
        ),
    ];
    let accel = (0..400)
        .map(|k| (f64::from(k * k % 37) - 18.0) * 0.1)
        .collect();
    let motion = Motion::new(0.02, accel).unwrap();
    for (pass, order, pad, want) in cases {
        let Filtered { motion, pad_s } = filtered(&motion, pass, order).unwrap();
        let accel = motion.accel_m_s2();
        assert_eq!((accel.len(), pad_s), (400 + 2 * pad, pad as f64 * 0.02));
        let at = [
            0,
            pad / 2,
            pad,
            pad + 1,
            pad + 200,
            pad + 399,
            pad + 400,
            accel.len() - 1,
        ];
        for (index, want) in at.into_iter().zip(want) {
            // Rounding on both sides, magnified by the square of the warped corner:
            // ε/(π·0.1·0.02)² = 6e-12.
            assert!(
                (accel[index] - want).abs() < 1e-10,
                "{pass:?} {index}: {} {want}",
                accel[index]
            );
        }
    }
}

#[test]
fn a_sine_passes_or_not_and_is_not_shifted() {
    // Far from the ends a sine is multiplied by |H|² = 1/(1 + (f_c/f)^2n), with warped frequencies,
    // and stays in phase.
    let (dt_s, hz) = (0.01, 2.0);
    let sine = |k: usize| (std::f64::consts::TAU * hz * dt_s * k as f64).sin();
    let motion = Motion::new(dt_s, (0..20_000).map(sine).collect()).unwrap();
    let warped = |hz: f64| (PI * hz * dt_s).tan();
    for (pass, order, gain) in [
        (Pass::High { low_cut_hz: 2.0 }, 4, 0.5),
        (Pass::Low { high_cut_hz: 2.0 }, 3, 0.5),
        (
            Pass::High { low_cut_hz: 3.0 },
            2,
            1.0 / (1.0 + (warped(3.0) / warped(2.0)).powi(4)),
        ),
        (
            Pass::Low { high_cut_hz: 1.0 },
            2,
            1.0 / (1.0 + (warped(2.0) / warped(1.0)).powi(4)),
        ),
    ] {
        let out = filtered(&motion, pass, order).unwrap();
        let pad = (out.pad_s / dt_s).round() as usize;
        for k in 9900..10_100 {
            // 100 s from the ends the transient is e^(−100·2π·2·0.38) = 0; 1e-16 per step of
            // 1/(warped corner)².
            assert!(
                (out.motion.accel_m_s2()[pad + k] - gain * sine(k)).abs() < 1e-11,
                "{pass:?} {k}"
            );
        }
    }
}

#[test]
fn the_kept_pads_leave_velocity_and_displacement_at_rest() {
    // The pulse alone ends with a velocity of 0.1 m/s; the high-pass filter has no gain at zero
    // frequency.
    let mut accel = vec![0.0; 400];
    accel[100..110].fill(1.0);
    let out = filtered(
        &Motion::new(0.01, accel).unwrap(),
        Pass::High { low_cut_hz: 0.5 },
        4,
    )
    .unwrap()
    .motion;
    let Integrals {
        velocity_m_s: velocity,
        displacement_m: displacement,
    } = integrals(&out);
    let peak = |values: &[f64]| values.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
    // After 12 s of the slowest pole, e^(−π·12·0.38) = 6e-7 is left; the displacement contains two
    // more integrals of it.
    assert!(velocity.last().unwrap().abs() < 1e-5 * peak(&velocity));
    assert!(displacement.last().unwrap().abs() < 1e-4 * peak(&displacement));
}

#[test]
fn what_is_no_filter_is_refused() {
    let motion = Motion::new(0.01, vec![1.0; 100]).unwrap();
    for order in [0, 11, u32::MAX] {
        let refused = filtered(&motion, Pass::High { low_cut_hz: 1.0 }, order);
        assert_eq!(refused, Err(FilterError::Order { order }));
    }
    for corner_hz in [0.0, -1.0, 50.0, 51.0, f64::NAN, f64::INFINITY] {
        for pass in [
            Pass::High {
                low_cut_hz: corner_hz,
            },
            Pass::Low {
                high_cut_hz: corner_hz,
            },
            Pass::Band {
                low_cut_hz: corner_hz,
                high_cut_hz: 20.0,
            },
            Pass::Band {
                low_cut_hz: 0.1,
                high_cut_hz: corner_hz,
            },
        ] {
            assert!(
                matches!(filtered(&motion, pass, 4), Err(FilterError::Corner { .. })),
                "{pass:?}"
            );
        }
    }
    for (low_cut_hz, high_cut_hz) in [(5.0, 5.0), (6.0, 5.0)] {
        let refused = filtered(
            &motion,
            Pass::Band {
                low_cut_hz,
                high_cut_hz,
            },
            4,
        );
        assert_eq!(
            refused,
            Err(FilterError::NoBand {
                low_cut_hz,
                high_cut_hz
            })
        );
    }
    let refused = filtered(&motion, Pass::High { low_cut_hz: 1e-9 }, 4);
    assert!(matches!(refused, Err(FilterError::TooLong { .. })));
}

#[test]
fn every_order_holds_its_corner() {
    for order in 1..=MAX_ORDER {
        for corner_hz in [0.1, 10.0, 49.0] {
            for sections in [high_pass_sections, low_pass_sections] {
                let list = sections(corner_hz, order, 0.01).unwrap();
                assert_eq!(list.len(), order.div_ceil(2) as usize);
                let gain = response(&list, corner_hz, 0.01).norm();
                // As above: ε over the square of the warped corner, 1e-5 at 0.1 Hz.
                assert!(
                    (gain - 0.5_f64.sqrt()).abs() < 2e-10,
                    "{order} {corner_hz} {gain}"
                );
            }
        }
    }
}
