//! Properties that every spectrum has, whatever its code.

use super::*;
use proptest::prelude::*;
use proptest::sample::select;

/// Spectra of all codes and an extended table, with parameters biased towards the ends of their
/// ranges.
fn spectra() -> impl Strategy<Value = CodeSpectrum> {
    let australia = (
        select(&SiteClass::ALL[..]),
        select(vec![1e-6, 0.03, 0.08, 0.6, 1e6]),
        select(vec![20u32, 500, 2500]),
    )
        .prop_map(|(site, z, years)| {
            As1170_4::new(Edition::default(), site, z, years)
                .unwrap()
                .into()
        });
    let europe = (
        any::<bool>(),
        select(&GroundType::ALL[..]),
        1e-3..10.0f64,
        0.5..2.0f64,
    )
        .prop_map(|(one, ground, ag, gamma)| {
            let spectrum_type = if one {
                SpectrumType::Type1
            } else {
                SpectrumType::Type2
            };
            Eurocode8::new(spectrum_type, ground, ag, gamma)
                .unwrap()
                .into()
        });
    let annex = (0.5..3.0f64, 1e-3..0.3f64, 1.0..4.0f64, 1.0..8.0f64).prop_map(
        |(soil_factor_ratio, tb_s, c, d)| {
            let shape = SpectrumShape {
                soil_factor_ratio,
                tb_s,
                tc_s: tb_s * c,
                td_s: tb_s * c * d,
            };
            Eurocode8::with_shape(SpectrumType::Type2, None, 0.1, 1.0, shape)
                .unwrap()
                .into()
        },
    );
    let america = (1e-3..3.0f64, 1e-3..3.0f64, 1.0..40.0f64).prop_map(|(sds, ratio, tl)| {
        Asce7::new(Asce7Edition::Asce7_22, sds, sds * ratio, ratio * tl)
            .unwrap()
            .into()
    });
    let new_zealand = (
        select(&SubsoilClass::ALL[..]),
        0.05..2.0f64,
        select(vec![20u32, 250, 500, 2500]),
        0.0..30.0f64,
    )
        .prop_map(|(site, z, years, km)| {
            Nzs1170_5::new(site, z, years, (km > 1.0).then_some(km))
                .unwrap()
                .into()
        });
    let table = (
        prop::collection::vec((1e-3..1.0f64, 1e-4..10.0f64), 2..12),
        any::<bool>(),
    )
        .prop_map(|(rows, log)| {
            let (steps, sa_g): (Vec<f64>, Vec<f64>) = rows.into_iter().unzip();
            let periods_s = steps
                .iter()
                .scan(0.0, |sum, step| Some(std::mem::replace(sum, *sum + step)))
                .collect();
            let interpolation = if log {
                Interpolation::LogLog
            } else {
                Interpolation::Linear
            };
            SpectrumTable::new(periods_s, sa_g, interpolation, OutOfRange::Hold)
                .unwrap()
                .into()
        });
    prop_oneof![australia, europe, annex, america, new_zealand, table]
}

proptest! {
    #[test]
    fn positive_finite_and_below_the_plateau(
        code in spectra(),
        period_s in prop_oneof![Just(0.0), 1e-6..1e-2f64, 0.0..20.0f64, 20.0..1e3f64],
    ) {
        let sa_g = code.sa_g(period_s);
        prop_assert!(sa_g > 0.0 && sa_g.is_finite(), "{sa_g}");
        // Near faults count from 1.5 s on, where 1.72 times the remaining spectrum is below the
        // plateau. A plateau that a rise reaches may differ by rounding.
        prop_assert!(sa_g <= code.plateau_g() * (1.0 + 1e-12), "{sa_g} {}", code.plateau_g());
    }

    /// Continuous everywhere, except for the documented steps of rounded constants: 0.4 % at most.
    #[test]
    fn continuous(code in spectra(), share in 0.0..1.0f64) {
        let mut places = code.corner_periods_s();
        places.push(0.01 + 8.0 * share);
        for place in places {
            let (before, after) = (code.sa_g(place.next_down()), code.sa_g(place.next_up()));
            prop_assert!((after / before - 1.0).abs() < 0.0041, "{place}: {before} {after}");
        }
    }

    #[test]
    fn corners_ascend_and_displacement_ends_constant(code in spectra()) {
        let corners = code.corner_periods_s();
        prop_assert!(corners.windows(2).all(|pair| pair[0] <= pair[1]), "{corners:?}");
        let last = corners.last().copied().unwrap();
        // Above the last corner Sa T² is constant: two divisions and a few products.
        let [one, two] = [1.01 * last, 7.0 * last].map(|t| code.sa_g(t) * t * t);
        prop_assert!((two / one - 1.0).abs() < 1e-14);
        prop_assert_eq!(code.longest_period_s(), None);
        prop_assert_eq!(code.shortest_period_s(), 0.0);
    }

    #[test]
    fn no_spectrum_before_zero(code in spectra(), period_s in -1e3..-1e-9f64) {
        prop_assert!(code.sa_g(period_s).is_nan() && code.sa_g(f64::NAN).is_nan());
    }

    /// A part on the ground has the acceleration of the ground, and a part higher up at least that.
    #[test]
    fn floors_rise_from_the_ground(
        code in spectra(),
        low in 0.0..1.0f64,
        share in 0.0..1.0f64,
        height_m in 2.0..300.0f64,
        period in prop::option::of(0.05..6.0f64),
    ) {
        let at = |level_ratio| {
            let question = parts::PartsQuestion { level_ratio, building_height_m: Some(height_m), building_period_s: period };
            parts::floor_acceleration_g(&code, &question)
        };
        if let (Some(ground), Some(lower), Some(upper)) = (at(0.0), at(low), at(low + (1.0 - low) * share)) {
            prop_assert!((ground / code.sa_g(0.0) - 1.0).abs() < 1e-15);
            prop_assert!(upper >= lower && lower >= ground && upper <= 3.6 * ground);
        } else {
            prop_assert!(matches!(code, CodeSpectrum::Table(_)));
        }
    }
}
