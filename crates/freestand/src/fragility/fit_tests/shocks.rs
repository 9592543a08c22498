//! Distributions of shocks below a ceiling.

use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

use super::*;

/// Shocks of known a, b, σ below a ceiling, drawn by inversion.
fn shocks(
    seed: u64,
    count: usize,
    (a, b, sigma): (f64, f64, f64),
    ceiling_g: f64,
) -> Vec<ShockRun> {
    let mut random = draw_stream(seed, 0, 0, 7);
    let mut runs = Vec::new();
    while runs.len() < count {
        let intensity = 0.1 * 20_f64.powf(random.random::<f64>());
        let normal: f64 = StandardNormal.sample(&mut random);
        let shock_g = (a + b * intensity.ln() + sigma * normal).exp();
        if shock_g <= ceiling_g {
            runs.push(ShockRun {
                intensity,
                shock_g,
                weight: 1.0,
            });
        }
    }
    runs
}

/// 4000 shocks of which a third is cut off: within four standard errors, about σ/√n · 2 for a and b
/// at this truncation, found with the scatter over seeds.
#[test]
fn a_truncated_distribution_is_found_again() {
    let truth = (2.0, 0.8, 0.35);
    let found: Vec<ShockDistribution> = (0..8)
        .map(|seed| fit_shock(&shocks(seed, 4000, truth, 6.0), 6.0).unwrap())
        .collect();
    let mean = |of: &dyn Fn(&ShockDistribution) -> f64| {
        found.iter().map(of).sum::<f64>() / found.len() as f64
    };
    let values = |fit: &ShockDistribution| [fit.intercept, fit.slope, fit.sigma];
    for (i, truth) in [truth.0, truth.1, truth.2].into_iter().enumerate() {
        let mean = mean(&|fit| values(fit)[i]);
        let spread = found
            .iter()
            .map(|fit| (values(fit)[i] - mean).powi(2))
            .sum::<f64>()
            / 7.0;
        let error = (spread / 8.0).sqrt();
        assert!(
            (mean - truth).abs() < 4.0 * error && error < 0.02,
            "{mean} {truth} {error}"
        );
    }
    assert!(found.iter().all(|fit| fit.score_per_run <= 1e-8));
}

/// The likelihood of ln s, written out, at steps of 0.4 % in a, b and σ.
#[test]
fn no_small_step_of_a_truncated_distribution_is_better() {
    let ceiling_g = 6.0;
    for (seed, truth) in [
        (1, (2.0, 0.8, 0.35)),
        (2, (1.0, 0.2, 0.9)),
        (3, (0.0, 1.5, 0.1)),
    ] {
        let runs = shocks(seed, 60, truth, ceiling_g);
        let fit = fit_shock(&runs, ceiling_g).unwrap();
        let value = |a: f64, b: f64, sigma: f64| -> f64 {
            let of = |run: &ShockRun| {
                let mu = a + b * run.intensity.ln();
                let z = (run.shock_g.ln() - mu) / sigma;
                ordered::density(z).ln()
                    - sigma.ln()
                    - normal_ratio((ceiling_g.ln() - mu) / sigma).ln()
            };
            runs.iter().map(of).sum()
        };
        let best = value(fit.intercept, fit.slope, fit.sigma);
        assert!(
            (best - fit.log_likelihood).abs() < 1e-9 * best.abs().max(1.0),
            "{best} {}",
            fit.log_likelihood
        );
        for factor in [0.996, 1.004] {
            assert!(value(fit.intercept * factor, fit.slope, fit.sigma) <= best);
            assert!(value(fit.intercept, fit.slope * factor, fit.sigma) <= best);
            assert!(value(fit.intercept, fit.slope, fit.sigma * factor) <= best);
        }
    }
}

#[test]
fn what_no_shock_distribution_fits_is_said() {
    let run = |intensity, shock_g| ShockRun {
        intensity,
        shock_g,
        weight: 1.0,
    };
    let few = [run(1.0, 1.0), run(2.0, 2.0)];
    assert_eq!(fit_shock(&few, 9.0), Err(ShockFitError::TooFew { runs: 2 }));
    let one_level = [run(1.0, 1.0), run(1.0, 2.0), run(1.0, 3.0)];
    assert_eq!(
        fit_shock(&one_level, 9.0),
        Err(ShockFitError::TooFew { runs: 3 })
    );
    let above = [run(1.0, 1.0), run(2.0, 9.5), run(1.0, 3.0)];
    assert!(matches!(
        fit_shock(&above, 9.0),
        Err(ShockFitError::Shock { run: 2, .. })
    ));
    let line = [run(1.0, 1.0), run(2.0, 2.0), run(3.0, 3.0)];
    assert_eq!(fit_shock(&line, 9.0), Err(ShockFitError::NoMaximum));
}

/// At the ceiling only overturning exceeds; far below it everything that rocks does.
#[test]
fn a_tolerance_at_the_ceiling_is_exceeded_only_by_overturning() {
    let shock = fit_shock(&shocks(1, 200, (2.0, 0.8, 0.35), 6.0), 6.0).unwrap();
    let curve = |median| CurveKind::Lognormal { median, beta: 0.4 };
    let at = |tolerance_g| TwoStage {
        rocks: curve(0.2),
        overturns: curve(0.9),
        shock: Some(shock),
        ceiling_g: 6.0,
        tolerance_g,
    };
    for x in [0.1, 0.5, 2.0] {
        let [rocks, overturns] = [0.2, 0.9].map(|median| lognormal_probability(x, median, 0.4));
        assert_eq!(at(6.0).probability(x), overturns);
        assert!((at(1e-9).probability(x) - rocks).abs() < 1e-12);
        assert!(at(3.0).probability(x) > overturns && at(3.0).probability(x) < rocks);
    }
    assert!(at(6.0).is_above_ceiling() && !at(5.9).is_above_ceiling());
    let median = at(3.0).median().unwrap();
    assert!(
        (at(3.0).probability(median) - 0.5).abs() < 1e-12 && median < 0.9,
        "{median}"
    );
    assert!((at(6.0).median().unwrap() - 0.9).abs() < 1e-12);
    // Far above the data the median is beyond the ceiling, and the two tails are still compared.
    let mut before = 0.0;
    for i in 0..60 {
        let p = shock.exceedance(5.0, 10_f64.powi(i));
        assert!((before..=1.0).contains(&p), "10^{i}: {p} {before}");
        before = p;
    }
}
