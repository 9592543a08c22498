use rand::RngExt;
use strum::VariantArray;

use super::*;
use crate::synthesis::QuickMatcher;

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn sd(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values
        .iter()
        .map(|value| (value - mean).powi(2))
        .sum::<f64>()
        / (values.len() - 1) as f64)
        .sqrt()
}

#[test]
fn no_two_uses_share_random_numbers() {
    let mut seen = std::collections::HashSet::new();
    let mut add =
        |mut random: rand_chacha::ChaCha8Rng| assert!(seen.insert(random.random::<u64>()));
    add(crate::fragility::draw_stream(1, 0, 0, 1));
    for &group in Group::VARIANTS {
        for (seed, world, repetition) in [
            (1, 0, 0),
            (2, 0, 0),
            (1, 1, 0),
            (1, 0, 1),
            (1, 0, 256),
            (1, 256, 0),
        ] {
            add(world_stream(seed, world, group, repetition));
            for object in [0, 1, u64::MAX] {
                add(object_stream(seed, world, object, group, repetition));
            }
            for refused in [1, 2, u16::MAX] {
                add(super::streams::redrawn_stream(
                    seed, world, group, repetition, refused,
                ));
            }
        }
    }
}

/// Recorded with rand_chacha 0.10.0. Any other value changes every world of every study.
#[test]
fn the_random_numbers_of_worlds_stay() {
    let shared: u64 = world_stream(1, 7, Group::Motion, 0).random();
    let own: u64 = object_stream(1, 7, 99, Group::Pad, 2).random();
    assert_eq!([shared, own], [1953417826444048120, 6192029235278566179]);
}

#[test]
fn restitution_moves_by_its_loss() {
    // One sd at 0.95 and 0.87; two sd at 0.95, all to the printed digit.
    for (median, z, expected) in [
        (0.95, 1.0, 0.93),
        (0.95, -1.0, 0.966),
        (0.87, 1.0, 0.82),
        (0.87, -1.0, 0.91),
        (0.95, -2.0, 0.977),
    ] {
        let r = restitution_at(median, 0.4, z);
        let digits = if expected > 0.95 { 1000.0 } else { 100.0 };
        assert!(
            (r - expected).abs() < 0.5 / digits + 1e-12,
            "{median} {z}: {r}"
        );
    }
    // logit L moves by exactly s ξ: 1e-15 of r is 1e-14 of a loss of 0.1.
    let logit = |r: f64| ((1.0 - r * r) / (r * r)).ln();
    assert!((logit(restitution_at(0.95, 0.4, 1.7)) - logit(0.95) - 0.68).abs() < 1e-13);
    for r in [1e-9, 0.3, 0.95, 1.0 - 1e-9] {
        for z in [-8.0, -1.0, 1.0, 8.0] {
            assert!(
                (0.0..1.0).contains(&restitution_at(r, 0.8, z)) && restitution_at(r, 0.8, z) > 0.0,
                "{r} {z}"
            );
        }
        assert_eq!(restitution_at(r, 0.0, 3.0), r);
    }
    assert_eq!(
        [
            restitution_at(1.0, 0.4, 2.0),
            restitution_at(0.0, 0.4, 2.0),
            restitution_at(-0.3, 0.4, 2.0)
        ],
        [1.0, 0.0, 0.0]
    );
}

/// Half of the draws are below the median: within 4 standard errors of ½, which are 4 of r.
#[test]
fn the_median_of_restitution_is_what_was_given() {
    let draw = |world| {
        restitution_draw(
            &mut object_stream(3, world, 5, Group::Restitution, 0),
            0.95 * 0.98,
            0.4,
        )
    };
    let draws: Vec<f64> = (0..4000).map(draw).collect();
    let below = draws.iter().filter(|r| **r < 0.95 * 0.98).count() as f64 / 4000.0;
    assert!((below - 0.5).abs() < 4.0 * 0.5 / 4000_f64.sqrt(), "{below}");
    assert!(draws.iter().all(|r| *r > 0.0 && *r < 1.0));
    // The spread is that of the logit, with a standard error of s/√(2n).
    let logits: Vec<f64> = draws
        .iter()
        .map(|r| ((1.0 - r * r) / (r * r)).ln())
        .collect();
    assert!(
        (sd(&logits) / 0.4 - 1.0).abs() < 4.0 / 8000_f64.sqrt(),
        "{}",
        sd(&logits)
    );
}

/// The formulas in another language with 25 digits.
#[test]
fn the_correlation_is_that_of_another_computation() {
    for (one_s, other_s, expected) in [
        (0.2, 1.0, 0.44442506635665),
        (2.0, 0.5, 0.51410775114629),
        (0.05, 0.1, 0.94212139253443),
        (0.05, 0.15, 0.91530497375686),
        (5.0, 0.05, 0.074324596921162),
        (0.1, 1.0, 0.27905447611989),
        (0.01, 10.0, 0.057641391465591),
        (0.001, 20.0, 0.057641391465591),
        (0.0, 0.01, 1.0),
    ] {
        let ratio = spectral_correlation_ratio(one_s, other_s);
        assert!(
            (ratio - expected).abs() < 1e-13,
            "{one_s} {other_s}: {ratio}"
        );
    }
}

#[test]
fn the_correlation_is_one_on_the_diagonal_and_falls() {
    for period_s in [0.02, 0.109, 0.15, 0.2, 0.5, 1.0] {
        assert_eq!(spectral_correlation_ratio(period_s, period_s), 1.0);
        // Up to 10 s, beyond which it is constant.
        let longer: Vec<f64> = (1..40)
            .map(|i| spectral_correlation_ratio(period_s, period_s * 1.06_f64.powi(i)))
            .collect();
        assert!(
            longer.is_sorted_by(|a, b| a > b) && longer[0] < 1.0,
            "{period_s}: {longer:?}"
        );
    }
}

/// A positive definite matrix has a real Cholesky factor; this one gives the matrix back.
#[test]
fn the_correlations_of_the_matched_periods_are_positive_definite() {
    let periods_s = crate::synthesis::matched_periods_s();
    let rows = super::ground::factor(&periods_s);
    let pivot = rows
        .iter()
        .enumerate()
        .map(|(i, row)| row[i] * row[i])
        .fold(1.0, f64::min);
    assert!((0.005..0.006).contains(&pivot), "{pivot}");
    for (i, row) in rows.iter().enumerate() {
        for (j, other) in rows.iter().enumerate() {
            let product: f64 = row.iter().zip(other).map(|(a, b)| a * b).sum();
            // 121 products, each rounded.
            assert!(
                (product - spectral_correlation_ratio(periods_s[i], periods_s[j])).abs() < 1e-13
            );
        }
    }
}

const WORLDS: u32 = 1000;

/// Worlds with the defaults: ln(S/target) of x, y and vertical.
fn thousand(options: SpreadOptions) -> Vec<WorldSpectra> {
    let spread = GroundSpread::new(options).unwrap();
    (0..WORLDS)
        .map(|world| spread.spectra(1, world, 0))
        .collect()
}

#[test]
fn the_spectra_of_worlds_have_the_mean_and_the_deviations_that_were_asked_for() {
    let worlds = thousand(SpreadOptions::default());
    let periods_s = crate::synthesis::matched_periods_s();
    let (mut band, mut shared) = (Vec::new(), Vec::new());
    for (i, &period_s) in periods_s.iter().enumerate() {
        let of = |component| {
            worlds
                .iter()
                .map(|world| world.of(component).ln_ratios()[i])
                .collect::<Vec<f64>>()
        };
        let [x, y, vertical] = [Component::X, Component::Y, Component::Vertical].map(of);
        for values in [&x, &y, &vertical] {
            let error = sd(values) / f64::from(WORLDS).sqrt();
            assert!(
                mean(values).abs() < 4.0 * error,
                "{period_s} s: {} {error}",
                mean(values)
            );
        }
        let correlation = |a: &[f64], b: &[f64]| {
            let product: f64 = a
                .iter()
                .zip(b)
                .map(|(p, q)| (p - mean(a)) * (q - mean(b)))
                .sum();
            product / f64::from(WORLDS - 1) / sd(a) / sd(b)
        };
        // Standard errors of a correlation: (1 − ρ²)/√n.
        assert!(
            (correlation(&x, &y) - 0.6).abs() < 4.0 * 0.64 / f64::from(WORLDS).sqrt(),
            "{period_s}"
        );
        assert!(
            correlation(&x, &vertical).abs() < 4.0 / f64::from(WORLDS).sqrt(),
            "{period_s}"
        );
        if (0.2..=3.0).contains(&period_s) {
            band.extend([sd(&x), sd(&y)]);
            shared.push(correlation(&x, &y));
        }
    }
    // By the covariances: 0.39294. Its standard error is a little below 0.39/√(2·1000) = 0.0088.
    let rms = (band.iter().map(|sd| sd * sd).sum::<f64>() / band.len() as f64).sqrt();
    assert!((rms - 0.39294).abs() < 0.02, "{rms}");
}

#[test]
fn the_mean_over_periods_deviates_by_the_intensity_alone() {
    let periods_s = crate::synthesis::matched_periods_s();
    let band = |deviation: &Deviation| {
        let within = periods_s
            .iter()
            .zip(deviation.ln_ratios())
            .filter(|(t, _)| (0.2..=3.0).contains(*t));
        mean(&within.map(|(_, ln)| *ln).collect::<Vec<_>>())
    };
    let means: Vec<f64> = thousand(SpreadOptions::default())
        .iter()
        .map(|world| band(&world.x))
        .collect();
    // Standard error τ/√(2n).
    assert!(
        (sd(&means) / 0.15 - 1.0).abs() < 4.0 / f64::from(2 * WORLDS).sqrt(),
        "{}",
        sd(&means)
    );
    let none = SpreadOptions {
        intensity_spread: 0.0,
        ..SpreadOptions::default()
    };
    assert!(
        thousand(none)
            .iter()
            .all(|world| band(&world.y).abs() < 1e-14)
    );
}

/// One factor at all periods of all components, and no other random number changes.
#[test]
fn the_spread_of_the_hazard_is_common_to_all() {
    let alone = SpreadOptions {
        hazard_spread: 0.15,
        ..SpreadOptions::NONE
    };
    let worlds = thousand(alone);
    for WorldSpectra { x, y, vertical } in &worlds {
        let all = [x, y, vertical].map(Deviation::ln_ratios).concat();
        assert!(all.iter().all(|ln| *ln == all[0]));
    }
    let drawn: Vec<f64> = worlds.iter().map(|world| world.x.ln_ratios()[0]).collect();
    // Four standard errors σ/√(2n); what is cut off at 3 σ takes 1.3 % away.
    let error = 4.0 / f64::from(2 * WORLDS).sqrt() + 0.013;
    assert!((sd(&drawn) / 0.15 - 1.0).abs() < error, "{}", sd(&drawn));
    let with = SpreadOptions {
        hazard_spread: 1e-9,
        ..SpreadOptions::default()
    };
    let (with, without) = [with, SpreadOptions::default()]
        .map(|options| GroundSpread::new(options).unwrap().spectra(9, 3, 0))
        .into();
    for (a, b) in with.x.ln_ratios().iter().zip(without.x.ln_ratios()) {
        assert!((a - b).abs() < 1e-8);
    }
    assert!(
        GroundSpread::new(SpreadOptions {
            hazard_spread: 1.6,
            ..alone
        })
        .is_err()
    );
}

#[test]
fn a_world_does_not_depend_on_the_others() {
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let first: Vec<WorldSpectra> = (0..5).map(|world| spread.spectra(9, world, 0)).collect();
    let backwards: Vec<WorldSpectra> = (0..80)
        .rev()
        .map(|world| spread.spectra(9, world, 0))
        .collect();
    assert!(first.iter().eq(backwards.iter().rev().take(5)));
    assert_ne!(spread.spectra(9, 0, 1), first[0]);
    // Another size of the deviations has the same random numbers.
    let double = SpreadOptions {
        spectral_spread: 1.3,
        intensity_spread: 0.3,
        ..SpreadOptions::default()
    };
    let doubled = GroundSpread::new(double).unwrap().spectra(9, 3, 0);
    for (twice, once) in doubled.x.ln_ratios().iter().zip(first[3].x.ln_ratios()) {
        assert!((twice - 2.0 * once).abs() < 1e-14);
    }
}

#[test]
fn spreads_out_of_range_are_refused() {
    let of = |spectral_spread, intensity_spread, component_correlation| {
        GroundSpread::new(SpreadOptions {
            spectral_spread,
            intensity_spread,
            component_correlation,
            hazard_spread: 0.0,
        })
        .is_ok()
    };
    assert!(of(0.0, 0.0, 0.0) && of(1.5, 1.5, 1.0));
    assert!(
        !of(-0.1, 0.0, 0.0) && !of(1.6, 0.0, 0.0) && !of(0.1, f64::NAN, 0.0) && !of(0.1, 0.1, 1.1)
    );
    assert!(BuildingSpread::new(1.1, 0.0).is_err() && BuildingSpread::new(0.0, -0.1).is_err());
    let refused = GroundSpread::new(SpreadOptions {
        spectral_spread: 2.0,
        ..SpreadOptions::NONE
    })
    .unwrap_err();
    assert_eq!(
        refused.to_string(),
        "the spectral spread must be from 0 to 1.5, not 2"
    );
}

/// EN 1998-1 type 1, ground C, 0.2 g.
fn code(period_s: f64) -> f64 {
    use crate::code_spectrum::{Eurocode8, GroundType, SpectrumType};
    Eurocode8::new(SpectrumType::Type1, GroundType::C, 0.2, 1.0)
        .unwrap()
        .sa_g(period_s)
}

#[test]
fn without_spreads_the_target_is_the_spectrum_of_the_code() {
    let spectra = GroundSpread::new(SpreadOptions::NONE)
        .unwrap()
        .spectra(1, 4, 0);
    for period_s in [0.0, 0.01, 0.05, 0.2, 0.7, 3.0, 5.0, 9.0] {
        for component in [Component::X, Component::Y, Component::Vertical] {
            assert_eq!(
                spectra.of(component).sa_g(period_s, code(period_s)),
                code(period_s)
            );
        }
    }
    let options = crate::synthesis::SynthesisOptions {
        passes: 2,
        ..Default::default()
    };
    let matcher = QuickMatcher::new(&options).unwrap();
    let motion = |component, repetition| {
        world_motion(
            code,
            &spectra,
            component,
            WorldDraw {
                seed: 1,
                world: 4,
                repetition,
            },
            &matcher,
        )
        .unwrap()
    };
    let x = motion(Component::X, 0);
    assert_eq!(
        x,
        crate::synthesis::synthesize(code, 1, 4, &options)
            .unwrap()
            .motion
    );
    let y = motion(Component::Y, 0);
    let again = motion(Component::X, 1);
    // Independent phases: a correlation of some 1/√(2·10 s·bandwidth), 0.2 at most.
    for other in [&y, &again] {
        let like = crate::synthesis::Resemblance::between(&x, other).correlation_ratio;
        assert!(like.abs() < 0.3, "{like}");
    }
}

#[test]
fn a_deviation_is_linear_between_its_periods_and_constant_beyond() {
    let spectra = GroundSpread::new(SpreadOptions::default())
        .unwrap()
        .spectra(1, 0, 0);
    let (periods_s, values) = (crate::synthesis::matched_periods_s(), spectra.x.ln_ratios());
    for (i, value) in values.iter().enumerate() {
        // A logarithm of the period rounds by 1e-15 of a step, times steps of ln S of some 0.1.
        assert!((spectra.x.sa_g(periods_s[i], 1.0).ln() - value).abs() < 1e-12);
    }
    let between = spectra
        .x
        .sa_g((periods_s[7] * periods_s[8]).sqrt(), 1.0)
        .ln();
    assert!((between - 0.5 * (values[7] + values[8])).abs() < 1e-12);
    assert!((spectra.x.sa_g(0.0, 2.0) / 2.0 / values[0].exp() - 1.0).abs() < 1e-14);
    assert!((spectra.x.sa_g(60.0, 2.0) / 2.0 / values[120].exp() - 1.0).abs() < 1e-14);
}

#[test]
fn periods_damping_and_sides_are_drawn_as_asked() {
    let draws: Vec<BuildingDraw> = (0..WORLDS)
        .map(|world| BuildingSpread::default().draw(5, world, 0))
        .collect();
    let ln =
        |of: fn(&BuildingDraw) -> f64| draws.iter().map(|draw| of(draw).ln()).collect::<Vec<f64>>();
    for (values, spread) in [
        (ln(|draw| draw.period_factor), 0.2),
        (ln(|draw| draw.damping_factor), 0.4),
    ] {
        assert!(
            (sd(&values) / spread - 1.0).abs() < 4.0 / f64::from(2 * WORLDS).sqrt(),
            "{}",
            sd(&values)
        );
        assert!(
            mean(&values).abs() < 4.0 * spread / f64::from(WORLDS).sqrt(),
            "{}",
            mean(&values)
        );
    }
    let at = BuildingSpread::default().at(1.0, -1.0);
    assert!(
        (at.period_factor - 0.2_f64.exp()).abs() < 1e-15
            && (at.damping_factor - (-0.4_f64).exp()).abs() < 1e-15
    );
    let along = (0..WORLDS)
        .filter(|&world| is_first_side_along_x(5, world, 77, 0))
        .count() as f64;
    assert!(
        (along / f64::from(WORLDS) - 0.5).abs() < 4.0 * 0.5 / f64::from(WORLDS).sqrt(),
        "{along}"
    );
}

/// On the left in half of the worlds, e_w uniform from 0 to 0.5: its mean 1/4 and its spread 1/(2√12),
/// both within four standard deviations of a mean of so many.
#[test]
fn a_wall_has_a_side_and_a_restitution() {
    const WORLDS: u32 = 4000;
    let draws: Vec<WallDraw> = (0..WORLDS)
        .map(|world| wall_draw(5, world, 77, 0, 0))
        .collect();
    let root = f64::from(WORLDS).sqrt();
    let left = draws.iter().filter(|one| one.is_on_left).count() as f64 / f64::from(WORLDS);
    assert!((left - 0.5).abs() < 4.0 * 0.5 / root, "{left}");
    let ratios: Vec<f64> = draws.iter().map(|one| one.restitution_ratio).collect();
    let spread = 0.5 / 12f64.sqrt();
    assert!(
        (mean(&ratios) - 0.25).abs() < 4.0 * spread / root,
        "{}",
        mean(&ratios)
    );
    assert!(ratios.iter().all(|ratio| (0.0..0.5).contains(ratio)));
    assert!(
        draws
            .iter()
            .zip(0..)
            .all(|(one, world)| one.is_on_left == wall_draw(5, world, 77, 3, 3).is_on_left)
    );
    // Logarithms are uniform: their mean is in the middle of the range, and they fill it.
    let logs = [
        (
            draws
                .iter()
                .map(|one| one.stiffness_ratio.ln())
                .collect::<Vec<f64>>(),
            WALL_STIFFNESS_RATIO,
        ),
        (
            draws.iter().map(|one| one.damping_ratio.ln()).collect(),
            WALL_DAMPING_RATIO,
        ),
    ];
    for (logs, (low, high)) in logs {
        let (low, high) = (low.ln(), high.ln());
        let spread = (high - low) / 12f64.sqrt();
        assert!((mean(&logs) - 0.5 * (low + high)).abs() < 4.0 * spread / root);
        assert!((sd(&logs) / spread - 1.0).abs() < 4.0 / root);
        assert!(logs.iter().all(|log| (low..high).contains(log)));
    }
    // Each part is drawn again by itself.
    let (first, other) = (wall_draw(5, 0, 77, 0, 0), wall_draw(5, 0, 77, 0, 1));
    assert_eq!(first.restitution_ratio, other.restitution_ratio);
    assert_ne!(first.stiffness_ratio, other.stiffness_ratio);
    assert_ne!(first.damping_ratio, other.damping_ratio);
    assert_eq!(wall_cushion_at(0.0), (1.0, 0.3));
    assert_eq!(wall_cushion_at(1.0), (5.0, 0.3 * (0.05f64 / 0.3)));
}

/// Five equal storeys, T₁ = 0.65 s, 5 % damping.
fn five_storeys() -> crate::building::Building {
    use crate::building::{Building, Damping, Storey};
    let storey = Storey {
        mass_kg: 2e5,
        stiffness_n_m: 2e8,
        height_m: 3.2,
    };
    let building = Building::shear(&[storey; 5], &Damping::Uniform(0.05), 5).unwrap();
    let factor = 0.65 / building.period_s();
    building.with_factors(factor, 1.0).unwrap()
}

/// The motions of worlds, as the specification of the assessment asks for them: spectra, and the
/// peaks of the roof.
#[test]
#[ignore = "ten seconds: 2 × 160 motions are matched; run it after a change of the spectra"]
fn the_motions_of_worlds_have_the_spectra_that_were_drawn() {
    use crate::building::floor_motion;
    use crate::oscillator::response_spectrum;
    use rayon::prelude::*;
    let periods_s: Vec<f64> = (0..30)
        .map(|i| 0.2 * 15_f64.powf(f64::from(i) / 29.0))
        .collect();
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let (building, matcher) = (
        five_storeys(),
        QuickMatcher::new(&crate::synthesis::SynthesisOptions::default()).unwrap(),
    );
    let worlds: Vec<_> = (0..160_u32)
        .into_par_iter()
        .map(|world| {
            let spectra = spread.spectra(1, world, 0);
            let drawn = BuildingSpread::default().draw(1, world, 0);
            let other = building
                .clone()
                .with_factors(drawn.period_factor, drawn.damping_factor)
                .unwrap();
            [Component::X, Component::Y].map(|component| {
                let motion = world_motion(
                    code,
                    &spectra,
                    component,
                    WorldDraw {
                        seed: 1,
                        world,
                        repetition: 0,
                    },
                    &matcher,
                )
                .unwrap();
                let psa = response_spectrum(&motion, 0.05, &periods_s)
                    .unwrap()
                    .psa_m_s2;
                let ln: Vec<f64> = psa
                    .iter()
                    .zip(&periods_s)
                    .map(|(sa, t)| (sa / crate::G0_M_S2 / code(*t)).ln())
                    .collect();
                let roof = |building| {
                    floor_motion(&motion, building, 1.0)
                        .unwrap()
                        .peak_m_s2()
                        .ln()
                };
                let asked = |t: &f64| spectra.of(component).sa_g(*t, 1.0).ln();
                let missed: Vec<f64> = ln
                    .iter()
                    .zip(&periods_s)
                    .map(|(ln, t)| ln - asked(t))
                    .collect();
                (
                    ln,
                    missed,
                    roof(&building),
                    roof(&other),
                    motion.peak_m_s2().ln(),
                )
            })
        })
        .collect();
    let both: Vec<_> = worlds.iter().flatten().collect();
    let n = worlds.len() as f64;
    let bias: Vec<f64> = (0..30)
        .map(|i| mean(&both.iter().map(|one| one.1[i]).collect::<Vec<_>>()))
        .collect();
    println!("mean of ln PSA less the drawn ln Sa: {bias:.3?}");
    let (mut square, mut correlation, mut worst) = (0.0, Vec::new(), 0.0_f64);
    for i in 0..periods_s.len() {
        let [x, y] = [0, 1].map(|c| {
            worlds
                .iter()
                .map(|world| world[c].0[i])
                .collect::<Vec<f64>>()
        });
        for values in [&x, &y] {
            square += sd(values).powi(2) / 60.0;
            worst = worst.max(mean(values).abs() / (sd(values) / n.sqrt()));
        }
        let product: f64 = x
            .iter()
            .zip(&y)
            .map(|(p, q)| (p - mean(&x)) * (q - mean(&y)))
            .sum();
        correlation.push(product / (n - 1.0) / sd(&x) / sd(&y));
    }
    let [misfit, roof, uncertain, ground] = [
        (mean(
            &both
                .iter()
                .flat_map(|one| one.1.iter().map(|ln| ln * ln))
                .collect::<Vec<_>>(),
        ))
        .sqrt(),
        sd(&both.iter().map(|one| one.2).collect::<Vec<_>>()),
        sd(&both.iter().map(|one| one.3).collect::<Vec<_>>()),
        sd(&both.iter().map(|one| one.4).collect::<Vec<_>>()),
    ];
    println!(
        "sd ln Sa {:.3}, worst mean {worst:.2} standard errors, correlation {:.2} ({:.2} to {:.2}), rms misfit {:.3}, \
         sd ln PGA {ground:.3}, roof {roof:.3}, with the building {uncertain:.3}",
        square.sqrt(),
        mean(&correlation),
        correlation.iter().copied().fold(1.0, f64::min),
        correlation.iter().copied().fold(0.0, f64::max),
        misfit
    );
    // By the covariances 0.393; a matched motion misses its target by 3 % to 6 %.
    assert!((square.sqrt() - 0.393).abs() < 0.04 && worst < 4.0);
    assert!(
        correlation.iter().all(|one| (0.35..0.8).contains(one))
            && (0.28..0.50).contains(&uncertain)
    );
}

/// A world whose spectra are not extreme is the first that was drawn; any other is drawn again under its own
/// number, so that no world depends on another.
#[test]
#[ignore = "seconds: 50,000 worlds; run it after a change of the spectra"]
fn extreme_spectra_are_drawn_again() {
    use rayon::prelude::*;
    const WORLDS: u32 = 50_000;
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let periods_s = crate::synthesis::matched_periods_s();
    let places = [0.2, 0.5, 1.0, 2.0]
        .map(|period_s| periods_s.iter().position(|t| t / period_s > 0.99).unwrap());
    let of = |spectra: &WorldSpectra| places.map(|i| spectra.x.ln_ratios()[i]);
    let worlds: Vec<_> = (0..WORLDS)
        .into_par_iter()
        .map(|world| {
            let (first, kept) = (spread.drawn(1, world, 0, 0), spread.spectra(1, world, 0));
            let is_extreme = |one: &Deviation| spread.is_extreme(one);
            let is_redrawn = is_extreme(&first.x) || is_extreme(&first.y);
            assert_eq!((&first.x, &first.y) != (&kept.x, &kept.y), is_redrawn);
            assert_eq!(first.vertical != kept.vertical, is_extreme(&first.vertical));
            assert!(
                ![&kept.x, &kept.y, &kept.vertical]
                    .into_iter()
                    .any(is_extreme)
            );
            (of(&first), of(&kept), is_redrawn)
        })
        .collect();
    let share = worlds.iter().filter(|one| one.2).count() as f64 / f64::from(WORLDS);
    println!("drawn again: {:.2} % of the worlds", 100.0 * share);
    // 200,000 worlds of another program: 0.0198. Four standard errors.
    assert!((share - 0.0198).abs() < 4.0 * (0.0198 / f64::from(WORLDS)).sqrt());
    for (k, i) in places.into_iter().enumerate() {
        let first: Vec<f64> = worlds.iter().map(|one| one.0[k]).collect();
        let kept: Vec<f64> = worlds.iter().map(|one| one.1[k]).collect();
        let shifts = [mean(&kept) - mean(&first), sd(&kept) - sd(&first)];
        println!(
            "ln Sa at {:.1} s: sd {:.3}, shift of the mean {:+.4}, of the sd {:+.4}; largest {:.2}, then {:.2}",
            periods_s[i],
            sd(&first),
            shifts[0],
            shifts[1],
            first.iter().copied().fold(0.0, f64::max),
            kept.iter().copied().fold(0.0, f64::max)
        );
        // A normal variable cut at ±3 has 0.9867 of its standard deviation; the cuts at the other periods and
        // of the other component take as much again at most. A mean differs by 2 % of worlds by some 1.5:
        // 4 · 1.5 √(0.02/50,000).
        assert!(shifts[0].abs() < 0.004);
        assert!((-0.0266..-0.0133 + 0.002).contains(&(shifts[1] / sd(&first))));
    }
}

/// The peaks of motions for a design ground acceleration of 0.5 g (EN 1998-1 type 1, ground B), as `--pga 0.5g`
/// asks for them.
#[test]
#[ignore = "seconds: 2 × 400 motions are matched; run it after a change of the spectra"]
fn the_median_peak_of_the_motions_is_that_of_the_target() {
    use crate::code_spectrum::{Eurocode8, GroundType, SpectrumType};
    use rayon::prelude::*;
    const WORLDS: u32 = 400;
    // a_g S is the design ground acceleration; S = 1.2.
    let code = Eurocode8::new(SpectrumType::Type1, GroundType::B, 0.5 / 1.2, 1.0).unwrap();
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let matcher = QuickMatcher::new(&crate::synthesis::SynthesisOptions::default()).unwrap();
    let peaks = |spectra: &WorldSpectra, world| {
        [Component::X, Component::Y].map(|component| {
            let key = WorldDraw {
                seed: 1,
                world,
                repetition: 0,
            };
            let made = world_motion(|t| code.sa_g(t), spectra, component, key, &matcher).unwrap();
            made.peak_m_s2() / crate::G0_M_S2
        })
    };
    let both: Vec<[[f64; 2]; 2]> = (0..WORLDS)
        .into_par_iter()
        .map(|world| {
            let (first, kept) = (spread.drawn(1, world, 0, 0), spread.spectra(1, world, 0));
            let found = peaks(&kept, world);
            let before = match first == kept {
                true => found,
                false => peaks(&first, world),
            };
            [before, found]
        })
        .collect();
    let sorted = |which: usize| {
        let mut all: Vec<f64> = both.iter().flat_map(|one| one[which]).collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let (before, found) = (sorted(0), sorted(1));
    let (median, most) = (found[found.len() / 2], found[found.len() - 1]);
    println!(
        "PGA of a component: median {median:.3} g, largest {most:.2} g; with extreme worlds {:.3} and {:.2} g",
        before[before.len() / 2],
        before[before.len() - 1]
    );
    // 0.565 g by another program; 3 standard errors of a median, 1.25 · 0.34/√n, of pairs that count as 500.
    assert!((median / 0.565 - 1.0).abs() < 3.0 * 1.25 * 0.34 / 500_f64.sqrt());
    assert!(most < before[before.len() - 1]);
}

/// Knowing less about restitution must not change how often an object overturns by much: from s = 0
/// to 0.8 by less than 0.05 and three standard errors.
#[test]
#[ignore = "ten seconds: 300 worlds with their motions; run it after a change of restitution"]
fn the_spread_of_restitution_hardly_changes_how_often_objects_overturn() {
    use crate::block::Block;
    use crate::building::floor_motion;
    use crate::rocking::{Base, Outcome, Restitution, RockingOptions, Until, rock};
    use rayon::prelude::*;
    let spread = GroundSpread::new(SpreadOptions::default()).unwrap();
    let matcher = QuickMatcher::new(&crate::synthesis::SynthesisOptions::default()).unwrap();
    let worlds = 300_u32;
    let motions: Vec<_> = (0..worlds)
        .into_par_iter()
        .map(|world| {
            let spectra = spread.spectra(2, world, 0);
            let ground = world_motion(
                code,
                &spectra,
                Component::X,
                WorldDraw {
                    seed: 2,
                    world,
                    repetition: 0,
                },
                &matcher,
            )
            .unwrap();
            let drawn = BuildingSpread::default().draw(2, world, 0);
            let building = five_storeys()
                .with_factors(drawn.period_factor, drawn.damping_factor)
                .unwrap();
            [floor_motion(&ground, &building, 1.0).unwrap(), ground]
        })
        .collect();
    for (height_m, thickness_m, place) in
        [(2.0, 0.45, 0), (1.5, 0.23, 1), (1.5, 0.3, 0), (2.0, 0.6, 0)]
    {
        let block = Block::uniform(height_m, thickness_m).unwrap();
        let falls = |spread: f64, world: u32| {
            let mut random = object_stream(2, world, 1, Group::Restitution, 0);
            let ratio = restitution_draw(&mut random, block.landing_ratio(), spread);
            let options = RockingOptions {
                restitution: Restitution::Value(ratio),
                until: Until::Settled { at_most_s: 120.0 },
                ..RockingOptions::default()
            };
            let base = Base {
                horizontal: Some(&motions[world as usize][place]),
                vertical: None,
            };
            rock(&block, base, &options).unwrap().outcome == Outcome::Overturned
        };
        let shares = [0.0, 0.2, 0.4, 0.8].map(|spread| {
            let count = (0..worlds)
                .into_par_iter()
                .filter(|&world| falls(spread, world))
                .count();
            count as f64 / f64::from(worlds)
        });
        println!(
            "{height_m} m x {thickness_m} m, {}: {shares:.3?}",
            ["roof", "ground"][place]
        );
        let p = shares[0].max(shares[3]);
        // The same worlds, so the standard error of the difference is at most that of a share.
        assert!(
            (shares[3] - shares[0]).abs() < 0.05 + 3.0 * (p * (1.0 - p) / f64::from(worlds)).sqrt()
        );
    }
}
