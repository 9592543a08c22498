//! Histories at random.

use proptest::prelude::*;

use super::*;

/// Any law, stiff and soft, few and many elements, contacts that stick, slip and slide.
fn any_base() -> impl Strategy<Value = CompliantBase> {
    let law = prop::sample::select(laws());
    let factor = (-1.0..2.5f64).prop_map(|x| 10f64.powf(x));
    let friction = prop_oneof![Just(None), Just(Some(0.0)), (0.01..1.5f64).prop_map(Some)];
    let ratio = (-1.0..1.5f64).prop_map(|x| 10f64.powf(x));
    let drag = prop_oneof![Just(0.0), 500.0..5000.0f64];
    (law, factor, friction, ratio, drag, 2..6usize).prop_map(
        |(law, factor, friction_ratio, ratio, drag, contacts)| CompliantBase {
            contacts,
            tangential_stiffness_ratio: ratio,
            tangential_damping_n_s_m: drag,
            friction_ratio,
            ..CompliantBase::new(MASS_KG, Cushion::new(law).unwrap().times(factor).unwrap())
        },
    )
}

fn any_start() -> impl Strategy<Value = Start> {
    prop_oneof![
        Just(Start::Rest),
        (0.0..0.2f64).prop_map(|height_m| Start::Dropped { height_m }),
        (-0.35..0.35f64, -1.0..1.0f64).prop_map(|(rotation_rad, omega_rad_s)| Start::Tilted {
            rotation_rad,
            omega_rad_s
        }),
        (-1e-4..1e-4f64).prop_map(|rotation_rad| Start::Tilted {
            rotation_rad,
            omega_rad_s: 0.0
        }),
    ]
}

proptest! {
    // The same cases in every run, so that the bounds below apply to exactly what is tested. For
    // other cases change the seed.
    #![proptest_config(ProptestConfig {
        cases: 48,
        failure_persistence: None,
        rng_seed: proptest::test_runner::RngSeed::Fixed(7),
        ..ProptestConfig::default()
    })]

    /// For any block, cushions, start and motion, including vertical motion, the history reaches
    /// its end or the block overturns; the energy balance closes to 1e-4 (1e-5 for a barely rocking
    /// block on five elements with the steepest root at first contact; five hundred histories had
    /// less); the contacts never pull; and friction stays within its limit. Only cushions too soft
    /// to keep the block upright are refused, and only histories on cushions that bottom are
    /// abandoned.
    #[test]
    #[ignore = "seconds: histories at random"]
    fn any_history_is_followed_and_closes(
        base in any_base(),
        start in any_start(),
        (h, t, offset) in (0.5..3.0f64, 0.3..1.2f64, -0.8..0.8f64),
        (across, up) in (-1.5..1.5f64, prop_oneof![Just(0.0), -2.0..2.0f64]),
    ) {
        let block = Block::uniform(h, t).unwrap().with_cg_offset(0.5 * offset * t).unwrap();
        let (horizontal, vertical) = (shaking(across), shaking(up));
        let motion = Base { horizontal: Some(&horizontal), vertical: Some(&vertical) };
        // Near its limit a bottoming cushion stiffens several hundredfold within a step: at
        // `standard` 1.4e-4 has been observed there.
        let is_tangent = base.cushion.law().name() == "tangent";
        let accuracy = if is_tangent { CompliantAccuracy::Tight } else { CompliantAccuracy::Standard };
        let options = CompliantOptions { start, accuracy, duration_s: Some(0.5), ..CompliantOptions::default() };
        let mut pulls = false;
        // The excess of a contact over its friction, relative to the weight.
        let mut beyond_ratio = 0.0f64;
        let done = rock_compliant_observed(&block, &base, motion, &options, |piece| {
            for index in 0..base.contacts {
                let (right_n, up_n, _) = piece.contact(index, 1.0).unwrap();
                pulls |= up_n < 0.0;
                if let Some(friction) = base.friction_ratio {
                    beyond_ratio = beyond_ratio.max((right_n.abs() - friction * up_n) / (MASS_KG * G0_M_S2));
                }
            }
        });
        let got = match done {
            Ok(got) => got,
            Err(CompliantError::Unstable { .. }) => return Ok(()),
            // Near its limit a bottoming cushion is arbitrarily stiff.
            Err(CompliantError::StepTooSmall { .. }) if is_tangent => return Ok(()),
            Err(error) => return Err(TestCaseError::fail(format!("{error}: {base:?} {start:?} {block:?}"))),
        };
        prop_assert!(got.energy.residual_ratio < 1e-4, "{:?}", got.energy);
        prop_assert!(!pulls);
        // The search for a slip works in units of the weight. For a lightly loaded contact (1 % of
        // the weight or less) that is some 1e-4 of its own friction, most where a dashpot pulls at
        // it.
        prop_assert!(beyond_ratio <= 1e-4, "{beyond_ratio}");
        prop_assert!(got.energy.friction_j >= -1e-6 * got.energy.turnover_j, "{:?}", got.energy);
        prop_assert!(got.peak_edge_acceleration_m_s2().is_finite() && got.uplift_m >= 0.0);
        prop_assert_eq!(got.overturn_time_s.is_none(), got.end_time_s == 0.5);
        for touch in &got.touches {
            prop_assert!(touch.end_time_s.is_none_or(|end_s| end_s >= touch.time_s));
        }
    }
}
