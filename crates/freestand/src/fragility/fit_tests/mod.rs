mod shocks;

use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

use super::*;

const STATES: [LimitState; 3] = LimitState::ALL;

/// Motions with one capacity each, at the same levels: class ≥ j where ln(x/θⱼ)/β is above ε.
fn clustered(seed: u64, motions: usize, levels: &[f64], medians: [f64; 3], beta: f64) -> Vec<Run> {
    let mut random = draw_stream(seed, 0, 0, 99);
    let mut runs = Vec::new();
    for motion in 0..motions {
        let epsilon: f64 = StandardNormal.sample(&mut random);
        for &intensity in levels {
            let reached = medians
                .iter()
                .filter(|median| (intensity / **median).ln() >= beta * epsilon)
                .count();
            runs.push(Run {
                motion: Some(motion),
                intensity,
                class: OutcomeClass::ALL[reached],
                weight: 1.0,
            });
        }
    }
    runs
}

fn grid(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| from * (to / from).powf(i as f64 / (count - 1) as f64))
        .collect()
}

fn lognormal(fit: &Fit, state: LimitState) -> (f64, f64) {
    match fit.curve(state) {
        Some(CurveKind::Lognormal { median, beta }) => (median, beta),
        other => panic!("{state:?}: {other:?}"),
    }
}

/// The multinomial likelihood, written out.
fn likelihood(runs: &[Run], curves: &[(LimitState, f64, f64)]) -> f64 {
    let p = |state: &(LimitState, f64, f64), x: f64| lognormal_probability(x, state.1, state.2);
    runs.iter()
        .map(|run| {
            let reached = curves.iter().rfind(|curve| curve.0.is_reached(run.class));
            let next = curves.iter().find(|curve| !curve.0.is_reached(run.class));
            let above = reached.map_or(1.0, |curve| p(curve, run.intensity));
            run.weight * (above - next.map_or(0.0, |curve| p(curve, run.intensity))).ln()
        })
        .sum()
}

/// Counts in the exact proportions of known curves: the fit is these curves. The shares are rounded
/// to 1e-9, and the score to 1e-8 of the runs.
#[test]
fn known_curves_are_found_again() {
    let (medians, beta) = ([0.08, 0.3, 0.5], 0.25);
    let mut runs = Vec::new();
    for intensity in grid(0.04, 1.2, 12) {
        let p = medians.map(|median| lognormal_probability(intensity, median, beta));
        let shares = [1.0 - p[0], p[0] - p[1], p[1] - p[2], p[2]];
        for (class, share) in OutcomeClass::ALL.into_iter().zip(shares) {
            runs.push(Run {
                motion: None,
                intensity,
                class,
                weight: (1e9 * share).round(),
            });
        }
    }
    let outcomes = Outcomes::new(&runs).unwrap();
    for kind in [FitKind::Ordered, FitKind::Separate] {
        let fit = fit_curves(&outcomes, &STATES, kind);
        assert!(fit.score_per_run <= 1e-8, "{}", fit.score_per_run);
        for (state, median) in STATES.into_iter().zip(medians) {
            let found = lognormal(&fit, state);
            assert!(
                (found.0 / median - 1.0).abs() < 1e-7 && (found.1 / beta - 1.0).abs() < 1e-7,
                "{found:?}"
            );
        }
        assert_eq!(fit.crossing(0.001, 10.0), None);
    }
}

/// Random runs of every kind, also few, steep, flat and uneven: no step of 0.4 % in a median or in β
/// raises the likelihood, which is the one written out above.
#[test]
fn no_small_step_is_better() {
    let mut fitted = 0;
    for sample in 0..300 {
        let mut random = draw_stream(7, sample, 0, 0);
        let beta = [0.02, 0.1, 0.3, 0.6, 1.5][random.random_range(0..5)];
        let levels = random.random_range(2..12);
        let count = random.random_range(5..200);
        let with_tolerance = random.random::<bool>();
        let runs: Vec<Run> = (0..count)
            .map(|_| {
                let x = grid(0.2, 3.0, levels)[random.random_range(0..levels)];
                let epsilon: f64 = StandardNormal.sample(&mut random);
                let reached = [0.5, 0.8, 1.0]
                    .iter()
                    .filter(|m| (x / **m).ln() >= beta * epsilon)
                    .count();
                let class = match OutcomeClass::ALL[reached] {
                    OutcomeClass::Exceeded if !with_tolerance => OutcomeClass::Rocked,
                    class => class,
                };
                Run {
                    motion: None,
                    intensity: x,
                    class,
                    weight: f64::from(random.random_range(1..4)),
                }
            })
            .collect();
        let outcomes = Outcomes::new(&runs).unwrap();
        let fit = fit_curves(&outcomes, &outcomes.limit_states(), FitKind::Ordered);
        let states = fit.fitted_states();
        if states.is_empty() {
            continue;
        }
        fitted += 1;
        assert!(fit.score_per_run <= 1e-8);
        let curves: Vec<_> = states
            .iter()
            .map(|state| {
                let (median, beta) = lognormal(&fit, *state);
                (*state, median, beta)
            })
            .collect();
        let best = likelihood(&runs, &curves);
        let rounding = 1e-9 * (1.0 + best.abs());
        assert!(
            (best - fit.log_likelihood).abs() < rounding,
            "{best} {}",
            fit.log_likelihood
        );
        for factor in [0.996, 1.004] {
            for i in 0..=curves.len() {
                let mut other = curves.clone();
                match other.get_mut(i) {
                    Some(curve) => curve.1 *= factor,
                    None => other.iter_mut().for_each(|curve| curve.2 *= factor),
                }
                // Two states that share a curve move together; apart, one of them would be crossed.
                let ties = curves.windows(2).any(|pair| pair[0].1 == pair[1].1);
                let value = likelihood(&runs, &other);
                assert!(
                    ties || value.is_nan() || value <= best + rounding,
                    "{sample}: {value} {best}"
                );
            }
        }
    }
    assert!(fitted > 150, "{fitted}");
}

/// Rows and the table of their counts are the same numbers, so the fits agree to the bit, also of
/// samples in another order.
#[test]
fn counts_and_rows_are_one_fit() {
    let rows = clustered(3, 40, &grid(0.1, 1.5, 9), [0.2, 0.4, 0.6], 0.4);
    let outcomes = Outcomes::new(&rows).unwrap();
    let mut counts = Vec::new();
    for &intensity in outcomes.levels() {
        for class in OutcomeClass::ALL {
            let weight = rows
                .iter()
                .filter(|run| run.intensity == intensity && run.class == class)
                .count() as f64;
            counts.push(Run {
                motion: None,
                intensity,
                class,
                weight,
            });
        }
    }
    counts.reverse();
    let counts = Outcomes::new(&counts).unwrap();
    assert_eq!((counts.motions(), outcomes.motions()), (None, Some(40)));
    for kind in [FitKind::Ordered, FitKind::Separate] {
        assert_eq!(
            fit_curves(&outcomes, &STATES, kind),
            fit_curves(&counts, &STATES, kind)
        );
    }
    assert!(bootstrap(&counts, &STATES, FitKind::Ordered, (10, 1), &|| true).is_none());
}

/// x → c x: θ → c θ, the same β and likelihood. Only ln x differs, by rounding.
#[test]
fn a_fit_of_ordered_states_does_not_know_its_unit() {
    let rows = clustered(4, 30, &grid(0.1, 1.5, 9), [0.2, 0.4, 0.6], 0.4);
    let scaled: Vec<Run> = rows
        .iter()
        .map(|run| Run {
            intensity: 9.80665 * run.intensity,
            ..*run
        })
        .collect();
    let [one, other] = [rows, scaled]
        .map(|runs| fit_curves(&Outcomes::new(&runs).unwrap(), &STATES, FitKind::Ordered));
    for state in STATES {
        let (a, b) = (lognormal(&one, state), lognormal(&other, state));
        assert!(
            (b.0 / a.0 / 9.80665 - 1.0).abs() < 1e-9 && (b.1 / a.1 - 1.0).abs() < 1e-9,
            "{a:?} {b:?}"
        );
    }
    assert!((one.log_likelihood - other.log_likelihood).abs() < 1e-9 * one.log_likelihood.abs());
}

#[test]
fn data_without_a_spread_are_results() {
    let fit = |classes: &[(f64, OutcomeClass)], kind| {
        let run = |&(intensity, class): &(f64, OutcomeClass)| Run {
            motion: Some(0),
            intensity,
            class,
            weight: 1.0,
        };
        let runs: Vec<Run> = classes.iter().map(run).collect();
        fit_curves(&Outcomes::new(&runs).unwrap(), &STATES, kind)
    };
    use OutcomeClass::{Exceeded, NoUplift, Overturned, Rocked};
    let stepped = [
        (1.0, Rocked),
        (2.0, Rocked),
        (4.0, Exceeded),
        (3.0, Exceeded),
        (5.0, Rocked),
        (8.0, Exceeded),
    ];
    for kind in [FitKind::Ordered, FitKind::Separate] {
        let fit = fit(&stepped, kind);
        assert_eq!(
            fit.curve(LimitState::Rocks),
            Some(CurveKind::All { upper: 1.0 })
        );
        assert_eq!(
            fit.curve(LimitState::Overturns),
            Some(CurveKind::None { lower: 8.0 })
        );
        assert_eq!(fit.fitted_states(), [LimitState::Exceeds]);
    }
    let step = [(1.0, NoUplift), (4.0, Overturned), (9.0, Overturned)];
    let fit_of_step = fit(&step, FitKind::Ordered);
    let kind = fit_of_step.curve(LimitState::Overturns).unwrap();
    assert_eq!(
        kind,
        CurveKind::Step {
            lower: 1.0,
            upper: 4.0
        }
    );
    assert_eq!(
        (kind.median(), kind.beta(), kind.name()),
        (Some(2.0), None, "step")
    );
    assert_eq!(
        (kind.probability(1.9), kind.probability(2.1)),
        (Some(0.0), Some(1.0))
    );
    assert_eq!(
        (fit_of_step.log_likelihood, fit_of_step.fitted_states()),
        (0.0, vec![])
    );
    // At one level some do and some do not, and no other level is mixed.
    let bounds = |classes: &[(f64, OutcomeClass)]| {
        fit(classes, FitKind::Ordered)
            .curve(LimitState::Overturns)
            .unwrap()
    };
    let top = bounds(&[
        (1.0, NoUplift),
        (2.0, NoUplift),
        (4.0, NoUplift),
        (4.0, Overturned),
    ]);
    assert_eq!(
        top,
        CurveKind::Bounds {
            lower: Some(2.0),
            upper: None
        }
    );
    assert_eq!(
        (top.median(), top.probability(4.0), top.name()),
        (None, None, "bounds")
    );
    let lowest = bounds(&[
        (1.0, NoUplift),
        (1.0, Overturned),
        (2.0, Overturned),
        (4.0, Overturned),
    ]);
    assert_eq!(
        lowest,
        CurveKind::Bounds {
            lower: None,
            upper: Some(2.0)
        }
    );
    let between = bounds(&[
        (1.0, NoUplift),
        (2.0, NoUplift),
        (2.0, Overturned),
        (4.0, Overturned),
    ]);
    assert_eq!(
        between,
        CurveKind::Bounds {
            lower: Some(1.0),
            upper: Some(4.0)
        }
    );
    // Fewer overturn at the higher intensity.
    let falling = [(1.0, Overturned), (1.0, NoUplift), (2.0, NoUplift)];
    let falling = fit(&falling, FitKind::Ordered)
        .curve(LimitState::Overturns)
        .unwrap();
    assert_eq!(
        falling,
        CurveKind::NotIncreasing {
            lower: 1.0,
            upper: 2.0
        }
    );
    // No run ended between two states: they share a curve.
    let tied = [
        (1.0, NoUplift),
        (2.0, Overturned),
        (3.0, NoUplift),
        (4.0, Overturned),
    ];
    let tied = fit(&tied, FitKind::Ordered);
    assert_eq!(
        lognormal(&tied, LimitState::Rocks),
        lognormal(&tied, LimitState::Overturns)
    );
    let bad = Run {
        motion: None,
        intensity: 0.0,
        class: Rocked,
        weight: 1.0,
    };
    assert!(matches!(
        Outcomes::new(&[bad]),
        Err(OutcomesError::Intensity { run: 1, .. })
    ));
    assert_eq!(Outcomes::new(&[]), Err(OutcomesError::Empty));
}

/// β 0.2 and 0.8 from separate fits: ln x = (0.8 ln 1 − 0.2 ln 1.5)/0.6 where the curves cross.
#[test]
fn separate_curves_that_cross_say_where() {
    let curve = |limit_state, median, beta| Curve {
        limit_state,
        kind: CurveKind::Lognormal { median, beta },
    };
    let curves = vec![
        curve(LimitState::Exceeds, 1.0, 0.2),
        curve(LimitState::Overturns, 1.5, 0.8),
    ];
    let fit = Fit {
        kind: FitKind::Separate,
        curves,
        log_likelihood: 0.0,
        score_per_run: 0.0,
    };
    let at = fit.crossing(0.01, 100.0).unwrap().intensity;
    assert!((at - 1.5_f64.powf(-1.0 / 3.0)).abs() < 1e-12, "{at}");
    assert!(
        (lognormal_probability(at, 1.0, 0.2) - lognormal_probability(at, 1.5, 0.8)).abs() < 1e-12
    );
    assert_eq!(fit.crossing(1.0, 100.0), None);
}

/// The mean of ln θ over m motions has the standard deviation β/√m. The width of one sample scatters
/// by 1/√(2m), 5 % at m = 200, so the mean of 12 samples is within four times 1.5 %.
#[test]
fn the_motions_are_the_sample_and_not_the_runs() {
    let (motions, beta) = (200, 0.3);
    let widths: Vec<f64> = (0..12)
        .map(|seed| {
            let runs = clustered(seed, motions, &grid(0.1, 3.0, 40), [0.2, 0.4, 0.6], beta);
            let outcomes = Outcomes::new(&runs).unwrap();
            let samples =
                bootstrap(&outcomes, &STATES, FitKind::Ordered, (300, seed), &|| true).unwrap();
            assert_eq!((samples.failed, samples.samples.len()), (0, 300));
            let (low, high) = samples.interval(LimitState::Overturns).unwrap().median;
            (high / low).ln()
        })
        .collect();
    let mean = widths.iter().sum::<f64>() / 12.0;
    let expected = 2.0 * 1.96 * beta / (motions as f64).sqrt();
    assert!((mean / expected - 1.0).abs() < 0.06, "{mean} {expected}");
}

#[test]
fn threads_do_not_change_a_sample() {
    let runs = clustered(5, 20, &grid(0.1, 3.0, 15), [0.2, 0.4, 0.6], 0.3);
    let outcomes = Outcomes::new(&runs).unwrap();
    let fit = fit_curves(&outcomes, &STATES, FitKind::Ordered);
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            (
                bootstrap(&outcomes, &STATES, FitKind::Ordered, (60, 9), &|| true),
                goodness(&outcomes, &fit, (60, 9), &|| true),
            )
        })
    });
    assert_eq!(one, three);
    assert_ne!(
        one.0,
        bootstrap(&outcomes, &STATES, FitKind::Ordered, (60, 10), &|| true),
        "another seed"
    );
}

/// Curves that made the runs fit; one lognormal curve does not fit two groups of motions whose
/// capacities differ by a factor of ten.
#[test]
fn a_misfit_is_seen() {
    let levels = grid(0.05, 5.0, 20);
    let states = [LimitState::Overturns];
    let good = Outcomes::new(&clustered(1, 60, &levels, [0.1, 0.2, 0.5], 0.4)).unwrap();
    let fit = fit_curves(&good, &states, FitKind::Ordered);
    let well = goodness(&good, &fit, (99, 1), &|| true).unwrap();
    assert!(
        well.is_misfit() == Some(false) && well.dof == 18 && well.ks.unwrap() < 0.15,
        "{well:?}"
    );
    // Below 20 samples p is 1/20 at least, whatever the fit: nothing was tested.
    assert_eq!(
        goodness(&good, &fit, (19, 1), &|| true)
            .unwrap()
            .is_misfit(),
        None
    );
    assert_eq!(
        goodness(&good, &fit, (0, 1), &|| true).unwrap().is_misfit(),
        None
    );
    let mut runs = clustered(2, 60, &levels, [0.1, 0.1, 0.12], 0.1);
    runs.extend(
        clustered(3, 60, &levels, [0.1, 0.1, 1.9], 0.1)
            .into_iter()
            .map(|run| Run {
                motion: run.motion.map(|motion| motion + 60),
                ..run
            }),
    );
    let mixed = Outcomes::new(&runs).unwrap();
    let fit = fit_curves(&mixed, &states, FitKind::Ordered);
    let badly = goodness(&mixed, &fit, (99, 1), &|| true).unwrap();
    assert!(
        badly.is_misfit() == Some(true) && badly.ks.unwrap() > 0.2,
        "{badly:?}"
    );
}

/// Capacities are the lowest levels, also where a motion spares the object at a higher one.
#[test]
fn capacities_are_the_lowest_levels() {
    let run = |motion, intensity, class| Run {
        motion: Some(motion),
        intensity,
        class,
        weight: 1.0,
    };
    use OutcomeClass::{Overturned, Rocked};
    let runs = [
        run(3, 1.0, Rocked),
        run(3, 2.0, Overturned),
        run(3, 4.0, Rocked),
        run(7, 2.5, Rocked),
    ];
    // One run of a motion does not tell its capacity.
    assert_eq!(
        capacity_spread(&Outcomes::new(&runs).unwrap(), LimitState::Rocks),
        None
    );
    let runs = [&runs[..], &[run(7, 2.0, OutcomeClass::NoUplift)]].concat();
    let outcomes = Outcomes::new(&runs).unwrap();
    assert_eq!(
        outcomes.capacities(LimitState::Overturns),
        [Some(2.0), None]
    );
    assert_eq!(
        outcomes.capacities(LimitState::Rocks),
        [Some(1.0), Some(2.5)]
    );
    assert_eq!(capacity_spread(&outcomes, LimitState::Overturns), None);
    let spread = capacity_spread(&outcomes, LimitState::Rocks).unwrap();
    assert!((spread - 2.5_f64.ln() / 2.0_f64.sqrt()).abs() < 1e-15);
}

/// Four motions whose capacities are 1, 1, 2 and above all levels, and curves through none of them, by
/// hand: both sides of each step where every motion has levels of its own, and all levels where they
/// share them.
#[test]
fn the_distance_has_two_sides() {
    let run = |motion, intensity, class| Run {
        motion: Some(motion),
        intensity,
        class,
        weight: 1.0,
    };
    use OutcomeClass::{NoUplift, Overturned};
    let capacities = [1.0, 1.0, 2.0, f64::INFINITY];
    let class = |x: f64, capacity: f64| if x < capacity { NoUplift } else { Overturned };
    let of = |levels: &dyn Fn(usize, f64) -> Vec<f64>| {
        let runs = capacities.iter().enumerate().flat_map(|(i, capacity)| {
            levels(i, *capacity)
                .into_iter()
                .map(move |x| run(i, x, class(x, *capacity)))
        });
        Outcomes::new(&runs.collect::<Vec<Run>>()).unwrap()
    };
    let shared = of(&|_, _| vec![0.5, 1.0, 2.0, 3.0]);
    let own = of(&|i, capacity| {
        [0.9 + 0.001 * i as f64, 1.0]
            .map(|ratio| ratio * capacity.min(3.0))
            .to_vec()
    });
    assert_eq!(
        (shared.sampling(), own.sampling()),
        (Sampling::Shared, Sampling::Own)
    );
    let with = |outcomes: &Outcomes, median: f64| {
        let kind = CurveKind::Lognormal { median, beta: 1.0 };
        let curves = vec![Curve {
            limit_state: LimitState::Overturns,
            kind,
        }];
        let fit = Fit {
            kind: FitKind::Ordered,
            curves,
            log_likelihood: 0.0,
            score_per_run: 0.0,
        };
        goodness(outcomes, &fit, (0, 1), &|| true)
            .unwrap()
            .ks
            .unwrap()
    };
    // Far above the steps: P(1) = Φ(2) = 0.977250, from the 0 before the step; one side says 0.477. At
    // the levels P(0.5) = Φ(2 − ln 2) = 0.90437. Six and five digits by hand.
    assert!((with(&own, (-2.0_f64).exp()) - 0.977_250).abs() < 1e-6);
    assert!((with(&shared, (-2.0_f64).exp()) - 0.904_37).abs() < 1e-5);
    // Far below them: P(2) = Φ(−2), from the 3/4 after the step.
    for outcomes in [&own, &shared] {
        assert!((with(outcomes, 2.0 * 2.0_f64.exp()) - (0.75 - 0.022_750)).abs() < 1e-6);
    }
}

/// 50 motions with one run each: a run tells on which side of its intensity the capacity is. The
/// shares of ten bins are near the probability, where a distribution of the intensities of those
/// that overturned is not.
#[test]
fn one_run_per_motion_has_no_capacities() {
    let mut random = draw_stream(11, 0, 0, 3);
    let runs: Vec<Run> = (0..500)
        .map(|i| {
            let intensity = 0.1 * 100_f64.powf(random.random::<f64>());
            let normal: f64 = StandardNormal.sample(&mut random);
            let class = if intensity < (0.4 * normal).exp() {
                OutcomeClass::NoUplift
            } else {
                OutcomeClass::Overturned
            };
            Run {
                motion: Some(i),
                intensity,
                class,
                weight: 1.0,
            }
        })
        .collect();
    let outcomes = Outcomes::new(&runs).unwrap();
    assert_eq!(outcomes.sampling(), Sampling::Cloud);
    let seen = empirical(&outcomes, LimitState::Overturns);
    assert_eq!(
        seen.iter().map(|bin| bin.trials).collect::<Vec<_>>(),
        [50.0; 10]
    );
    assert!(
        seen.windows(2)
            .all(|pair| pair[0].intensity < pair[1].intensity)
    );
    // Where the curve hardly bends within a bin: four standard errors of 50 runs at most.
    for bin in &seen {
        let p = lognormal_probability(bin.intensity, 1.0, 0.4);
        assert!(
            (bin.reached / bin.trials - p).abs() < 4.0 * (0.25_f64 / 50.0).sqrt(),
            "{bin:?} {p}"
        );
    }
    let ends = [
        seen[0].reached / seen[0].trials,
        seen[9].reached / seen[9].trials,
    ];
    assert_eq!(ends, [0.0, 1.0]);
    let fit = fit_curves(&outcomes, &[LimitState::Overturns], FitKind::Ordered);
    assert_eq!(
        goodness(&outcomes, &fit, (0, 1), &|| true).unwrap().ks,
        None
    );
    let above = runs
        .iter()
        .filter(|run| run.class == OutcomeClass::Overturned)
        .copied()
        .collect::<Vec<_>>();
    assert_eq!(
        capacity_spread(&Outcomes::new(&above).unwrap(), LimitState::Overturns),
        None
    );
    // Few runs have few bins, and a second run of most motions makes levels of their own.
    let few = Outcomes::new(&runs[..12]).unwrap();
    assert_eq!(
        empirical(&few, LimitState::Overturns)
            .iter()
            .map(|bin| bin.trials)
            .collect::<Vec<_>>(),
        [6.0; 2]
    );
    let scaled = |run: &Run| Run {
        intensity: 20.0 * run.intensity,
        class: OutcomeClass::Overturned,
        ..*run
    };
    let twice: Vec<Run> = runs.iter().flat_map(|run| [*run, scaled(run)]).collect();
    assert_eq!(Outcomes::new(&twice).unwrap().sampling(), Sampling::Own);
}

/// Weights of a fifth of a run: none is drawn, nothing can be compared, and nothing is claimed.
#[test]
fn counts_of_less_than_a_run_are_not_simulated() {
    let run = |intensity, class, weight| Run {
        motion: None,
        intensity,
        class,
        weight,
    };
    let runs: Vec<Run> = [(1.0, 0.15, 0.05), (2.0, 0.05, 0.15), (3.0, 0.1, 0.1)]
        .iter()
        .flat_map(|&(x, stays, falls)| {
            [
                run(x, OutcomeClass::NoUplift, stays),
                run(x, OutcomeClass::Overturned, falls),
            ]
        })
        .collect();
    let outcomes = Outcomes::new(&runs).unwrap();
    let fit = fit_curves(&outcomes, &[LimitState::Overturns], FitKind::Ordered);
    let found = goodness(&outcomes, &fit, (40, 1), &|| true).unwrap();
    assert_eq!(
        (found.simulated, found.p_value, found.is_misfit()),
        (0, None, None)
    );
}

#[test]
fn samples_that_are_few_or_all_the_same_have_no_interval() {
    let curve = |median| {
        vec![Curve {
            limit_state: LimitState::Overturns,
            kind: CurveKind::Lognormal { median, beta: 0.3 },
        }]
    };
    let none = || {
        vec![Curve {
            limit_state: LimitState::Overturns,
            kind: CurveKind::None { lower: 1.0 },
        }]
    };
    let of = |samples| Bootstrap { samples, failed: 0 };
    let state = LimitState::Overturns;
    assert_eq!(
        of(vec![curve(1.0), curve(1.0)]).lacks_interval(state),
        Some(NoInterval::AllEqual)
    );
    let few = of(vec![curve(1.0), none(), none()]);
    assert_eq!(
        few.lacks_interval(state),
        Some(NoInterval::FewCurves {
            known: 1,
            samples: 3
        })
    );
    assert!(few.interval(state).is_none());
    assert!(
        of(vec![curve(1.0), curve(2.0), none()])
            .interval(state)
            .is_some()
    );
}

/// Median and β of each limit state.
const ORDERED: [(f64, f64); 3] = [
    (0.2214900617836216, 0.5881486391032181),
    (0.44867645634068737, 0.5881486391032181),
    (0.7937635185842341, 0.5881486391032181),
];
const SEPARATE: [(f64, f64); 3] = [
    (0.22035691236741575, 0.6070864976733632),
    (0.45183353608065624, 0.5907249137429267),
    (0.7930445421165542, 0.5497761671840987),
];

/// Counts at six levels. The expected ordered fit is from `OrderedModel` (probit) of statsmodels
/// 0.15 in ln x, the separate ones from its binomial model with a probit link; both converged to
/// 1e-10.
#[test]
fn fits_are_those_of_statsmodels() {
    let levels = [0.1, 0.2, 0.35, 0.6, 1.0, 1.7];
    let counts = [
        [18, 2, 0, 0],
        [11, 7, 2, 0],
        [5, 8, 5, 2],
        [1, 6, 7, 6],
        [0, 2, 6, 12],
        [0, 0, 1, 19],
    ];
    let mut runs = Vec::new();
    for (intensity, counts) in levels.into_iter().zip(counts) {
        for (class, count) in OutcomeClass::ALL.into_iter().zip(counts) {
            runs.push(Run {
                motion: None,
                intensity,
                class,
                weight: f64::from(count),
            });
        }
    }
    let outcomes = Outcomes::new(&runs).unwrap();
    for (kind, expected) in [(FitKind::Ordered, ORDERED), (FitKind::Separate, SEPARATE)] {
        let fit = fit_curves(&outcomes, &STATES, kind);
        for (state, (median, beta)) in STATES.into_iter().zip(expected) {
            let Some(CurveKind::Lognormal {
                median: found,
                beta: spread,
            }) = fit.curve(state)
            else {
                panic!()
            };
            // Fits end at a score of 1e-8 per run.
            assert!(
                (found / median - 1.0).abs() < 1e-8,
                "{kind:?} {state:?} {found}"
            );
            assert!(
                (spread / beta - 1.0).abs() < 1e-8,
                "{kind:?} {state:?} {spread}"
            );
        }
    }
}
