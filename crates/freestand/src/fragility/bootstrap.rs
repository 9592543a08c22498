//! How sure a fit is, and how well it fits: by drawing motions again.

use rand::RngExt;
use rand_distr::{Binomial, Distribution, StandardNormal};
use rayon::prelude::*;

use super::draws::draw_stream;
use super::ordered::{Curve, CurveKind, Fit, FitKind, fit_counts};
use super::outcomes::{Counts, LimitState, OutcomeClass, Outcomes, Sampling};

/// Keys of the random numbers, beside those of objects.
const RESAMPLED: u64 = u64::MAX;
const SIMULATED: u64 = u64::MAX - 1;

/// Whether samples are still wanted.
pub type GoOn<'a> = &'a (dyn Fn() -> bool + Sync);

/// The fits of samples of motions drawn again.
#[derive(Debug, Clone, PartialEq)]
pub struct Bootstrap {
    /// The curves of every sample, in the order of the limit states.
    pub samples: Vec<Vec<Curve>>,
    /// Samples in which a limit state that the fit has a curve for has none.
    pub failed: usize,
}

/// Medians closer than this are the same: the likelihood is solved to 1e-8.
const SAME_RATIO: f64 = 1e-6;

/// Why bootstrap samples tell no interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoInterval {
    /// Fewer than half of them have a curve.
    FewCurves {
        /// How many have one.
        known: usize,
        /// How many there are.
        samples: usize,
    },
    /// All curves are the same.
    AllEqual,
}

/// The ends of 95 % intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveInterval {
    /// Of the median.
    pub median: (f64, f64),
    /// Of β.
    pub beta: (f64, f64),
}

impl Bootstrap {
    /// The curves of one limit state in the samples that have one.
    pub fn lognormals(&self, state: LimitState) -> impl Iterator<Item = (f64, f64)> {
        self.samples
            .iter()
            .flatten()
            .filter(move |curve| curve.limit_state == state)
            .filter_map(|curve| {
                if let CurveKind::Lognormal { median, beta } = curve.kind {
                    Some((median, beta))
                } else {
                    None
                }
            })
    }

    /// Why the samples tell no interval of a limit state; `None`: they do.
    ///
    /// Fewer than half of the samples with a curve are a choice of the data and not a sample of it,
    /// and curves that are all the same have no width although few motions leave much open.
    pub fn lacks_interval(&self, state: LimitState) -> Option<NoInterval> {
        let known = self.lognormals(state).count();
        let mut medians = self.lognormals(state).map(|(median, _)| median);
        let first = medians.next();
        if 2 * known < self.samples.len() || known == 0 {
            Some(NoInterval::FewCurves {
                known,
                samples: self.samples.len(),
            })
        } else if medians
            .all(|median| first.is_some_and(|first| (median / first - 1.0).abs() < SAME_RATIO))
        {
            Some(NoInterval::AllEqual)
        } else {
            None
        }
    }

    /// The 95 % percentile intervals of a limit state: from the 2.5th to the 97.5th percentile of
    /// the samples that have a curve. `None` where [`Bootstrap::lacks_interval`].
    pub fn interval(&self, state: LimitState) -> Option<CurveInterval> {
        if self.lacks_interval(state).is_some() {
            return None;
        }
        let (medians, betas): (Vec<f64>, Vec<f64>) = self.lognormals(state).unzip();
        Some(CurveInterval {
            median: percentiles(medians)?,
            beta: percentiles(betas)?,
        })
    }
}

/// The 2.5th and the 97.5th percentile, linear between the values; `None` without values.
///
/// # Example
/// ```
/// let values = (0..=1000).map(f64::from).collect();
/// assert_eq!(freestand::fragility::percentiles(values), Some((25.0, 975.0)));
/// ```
pub fn percentiles(mut values: Vec<f64>) -> Option<(f64, f64)> {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let place = share * (values.len() - 1) as f64;
        let (below, part) = (place.floor(), place.fract());
        let low = values[below as usize];
        values
            .get(below as usize + 1)
            .map_or(low, |high| low + part * (high - low))
    };
    (!values.is_empty()).then(|| (at(0.025), at(0.975)))
}

/// Fits samples of as many motions as there are, drawn with replacement; all levels of a motion stay
/// together. Sample i uses the random numbers of (seed, i) and nothing else, so the samples do not
/// depend on threads, and objects under the same motions share them. `None` for counts, which have
/// no motions, and if `go_on` returns false; it is called before every sample.
///
/// # Reference
/// Efron, B. and Tibshirani, R. (1993). An introduction to the bootstrap, chapter 8 (clusters).
///
/// # Accuracy
/// Coverage by simulation (`cargo run --release -p freestand --example bootstrap_coverage`): see
/// docs/risk.md.
pub fn bootstrap(
    outcomes: &Outcomes,
    states: &[LimitState],
    kind: FitKind,
    (replicates, seed): (u32, u64),
    go_on: GoOn,
) -> Option<Bootstrap> {
    let motions = outcomes.motions()?;
    let whole = fit_counts(outcomes.levels(), &outcomes.counts(None), states, kind, &[]);
    let expected = whole.fitted_states();
    let samples: Vec<Vec<Curve>> = (0..replicates)
        .into_par_iter()
        .map(|replicate| {
            if !go_on() {
                return None;
            }
            let mut random = draw_stream(seed, RESAMPLED, u64::from(replicate), 0);
            let mut times = vec![0.0; motions];
            for _ in 0..motions {
                times[random.random_range(0..motions)] += 1.0;
            }
            let counts = outcomes.counts(Some(&times));
            Some(fit_counts(outcomes.levels(), &counts, states, kind, &whole.curves).curves)
        })
        .collect::<Option<_>>()?;
    let fits = |curves: &&Vec<Curve>| {
        let is_fitted = |curve: &&Curve| matches!(curve.kind, CurveKind::Lognormal { .. });
        let fitted: Vec<LimitState> = curves
            .iter()
            .filter(is_fitted)
            .map(|curve| curve.limit_state)
            .collect();
        expected.iter().all(|state| fitted.contains(state))
    };
    let failed = samples.len() - samples.iter().filter(fits).count();
    Some(Bootstrap { samples, failed })
}

/// How well curves fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goodness {
    /// Twice the log-likelihood that is missing to that of the shares of each level.
    pub deviance: f64,
    /// Degrees of freedom: shares less parameters.
    pub dof: i64,
    /// Share of simulated samples, made with the fitted curves, whose deviance is as large. `None`
    /// if none was simulated.
    pub p_value: Option<f64>,
    /// How many samples were simulated and could be compared.
    pub simulated: usize,
    /// Largest distance between the distribution of the capacities and its curve (Kolmogorov and
    /// Smirnov), on both sides of each step; where motions share their levels, at these; of counts
    /// between the share at a level and the curve.
    /// `None` for one run per motion: these have neither capacities nor levels.
    pub ks: Option<f64>,
}

/// Fewer simulated samples cannot give a p-value below 5 %: 1/(n + 1) is the smallest one.
const FEWEST_SIMULATED: usize = 20;

impl Goodness {
    /// Whether the curves do not fit: less than 5 % of samples deviate as much. `None`: it was not
    /// tested, because fewer than 20 samples could be compared.
    pub fn is_misfit(&self) -> Option<bool> {
        self.p_value
            .filter(|_| self.simulated >= FEWEST_SIMULATED)
            .map(|p| p < 0.05)
    }
}

/// How well curves fit; `None` if no limit state has a lognormal curve, and if `go_on` returns
/// false; it is called before every simulated sample.
///
/// A simulated sample has one capacity for each motion: a standard normal number ε, and at the
/// intensity x the limit states whose ln(x/θ)/β is above it are reached. So the levels of a motion
/// belong together, as those of a motion that is scaled do. Counts have no motions, and every run
/// has its own ε. Sample i uses the random numbers of (seed, i).
pub fn goodness(
    outcomes: &Outcomes,
    fit: &Fit,
    (replicates, seed): (u32, u64),
    go_on: GoOn,
) -> Option<Goodness> {
    let states = fit.fitted_states();
    if states.is_empty() {
        return None;
    }
    let (deviance, dof) = deviance(outcomes, fit, &states);
    // The outer `None`: stopped. The inner one: a sample without runs or without β for a state, which has no
    // deviance.
    let simulate = |replicate: u32| -> Option<Option<f64>> {
        if !go_on() {
            return None;
        }
        let Some(simulated) = simulated(outcomes, fit, &states, seed, replicate) else {
            return Some(None);
        };
        let counts = simulated.counts(None);
        let again = fit_counts(simulated.levels(), &counts, &states, fit.kind, &fit.curves);
        Some(
            (again.fitted_states() == states)
                .then(|| self::deviance(&simulated, &again, &states).0),
        )
    };
    let simulated: Vec<Option<f64>> = (0..replicates)
        .into_par_iter()
        .map(simulate)
        .collect::<Option<_>>()?;
    let simulated: Vec<f64> = simulated.into_iter().flatten().collect();
    let larger = simulated.iter().filter(|other| **other >= deviance).count();
    // The sample itself is one of them.
    let p_value =
        (!simulated.is_empty()).then(|| (larger + 1) as f64 / (simulated.len() + 1) as f64);
    Some(Goodness {
        deviance,
        dof,
        p_value,
        simulated: simulated.len(),
        ks: distance(outcomes, fit, &states),
    })
}

/// Runs with the outcomes that the curves give to drawn capacities. `None`: counts whose weights are
/// so small that no whole run is drawn at any level.
fn simulated(
    outcomes: &Outcomes,
    fit: &Fit,
    states: &[LimitState],
    seed: u64,
    replicate: u32,
) -> Option<Outcomes> {
    let mut random = draw_stream(seed, SIMULATED, u64::from(replicate), 0);
    let class = |level: usize, epsilon: f64| {
        let x = outcomes.levels()[level].ln();
        let reached = states.iter().rfind(|state| match fit.curve(**state) {
            Some(CurveKind::Lognormal { median, beta }) => x - median.ln() >= beta * epsilon,
            _ => false,
        });
        reached.map_or(OutcomeClass::NoUplift, |state| state.first_class())
    };
    match outcomes.motions() {
        Some(motions) => {
            let capacities: Vec<f64> = (0..motions)
                .map(|_| StandardNormal.sample(&mut random))
                .collect();
            Some(outcomes.with_classes(|run| class(run.level, capacities[run.motion])))
        }
        None => {
            let mut runs = Vec::new();
            for (level, counts) in outcomes.counts(None).iter().enumerate() {
                let mut drawn = [0.0; 4];
                // Class by class, beginning with the worst: how many of the remaining runs have it.
                let (mut left, mut worse) = (counts.iter().sum::<f64>().round() as u64, 0.0_f64);
                for state in states.iter().rev() {
                    let reached = fit
                        .curve(*state)
                        .and_then(|kind| kind.probability(outcomes.levels()[level]));
                    let reached = reached.unwrap_or(0.0).max(worse);
                    let share = if worse < 1.0 {
                        (reached - worse) / (1.0 - worse)
                    } else {
                        0.0
                    };
                    let count = Binomial::new(left, share).map_or(0, |law| law.sample(&mut random));
                    drawn[state.first_class().index()] += count as f64;
                    (left, worse) = (left - count, reached);
                }
                drawn[OutcomeClass::NoUplift.index()] += left as f64;
                let intensity = outcomes.levels()[level];
                let run = |(class, &weight): (&OutcomeClass, &f64)| super::Run {
                    motion: None,
                    intensity,
                    class: *class,
                    weight,
                };
                runs.extend(OutcomeClass::ALL.iter().zip(&drawn).map(run));
            }
            Outcomes::new(&runs).ok()
        }
    }
}

/// The deviance and its degrees of freedom.
fn deviance(outcomes: &Outcomes, fit: &Fit, states: &[LimitState]) -> (f64, i64) {
    let counts = outcomes.counts(None);
    let by_states = |states: &[LimitState]| -> (f64, i64) {
        let mut firsts: Vec<usize> = states
            .iter()
            .map(|state| state.first_class().index())
            .collect();
        firsts.dedup();
        let saturated: f64 = counts.iter().map(|counts| saturated(counts, &firsts)).sum();
        (saturated, (counts.len() * firsts.len()) as i64)
    };
    let (saturated, shares, parameters) = match fit.kind {
        FitKind::Ordered => {
            let (saturated, shares) = by_states(states);
            (saturated, shares, states.len() + 1)
        }
        FitKind::Separate => {
            let each: Vec<(f64, i64)> = states.iter().map(|state| by_states(&[*state])).collect();
            let sum = each
                .iter()
                .fold((0.0, 0), |sum, each| (sum.0 + each.0, sum.1 + each.1));
            (sum.0, sum.1, 2 * states.len())
        }
    };
    (
        2.0 * (saturated - fit.log_likelihood),
        shares - parameters as i64,
    )
}

/// Σ n ln(n/N) over the groups of classes that begin with these.
fn saturated(counts: &Counts, firsts: &[usize]) -> f64 {
    let all: f64 = counts.iter().sum();
    let mut groups = [0.0; 4];
    for (class, count) in counts.iter().enumerate() {
        groups[firsts.iter().filter(|first| class >= **first).count()] += count;
    }
    groups
        .iter()
        .filter(|count| **count > 0.0)
        .map(|count| count * (count / all).ln())
        .sum()
}

/// The largest distance between what was seen and the curves; `None` for one run per motion.
fn distance(outcomes: &Outcomes, fit: &Fit, states: &[LimitState]) -> Option<f64> {
    let sampling = outcomes.sampling();
    if sampling == Sampling::Cloud {
        return None;
    }
    let mut largest: f64 = 0.0;
    for state in states {
        let Some(kind) = fit.curve(*state) else {
            continue;
        };
        let mut seen: Vec<(f64, f64)> = Vec::new();
        if let Some(motions) = outcomes.motions() {
            let mut capacities: Vec<f64> =
                outcomes.capacities(*state).into_iter().flatten().collect();
            capacities.sort_by(f64::total_cmp);
            let share = |reached: usize| reached as f64 / motions as f64;
            if sampling == Sampling::Shared {
                // Between two levels nothing was seen, so that a step may be anywhere between them.
                let reached = |x: f64| capacities.partition_point(|capacity| *capacity <= x);
                seen.extend(outcomes.levels().iter().map(|x| (*x, share(reached(*x)))));
            } else {
                // Both sides of every step; equal capacities are one step.
                let mut reached = 0;
                for equal in capacities.chunk_by(|one, next| one == next) {
                    let before = share(reached);
                    reached += equal.len();
                    seen.extend(
                        equal
                            .first()
                            .into_iter()
                            .flat_map(|x| [(*x, before), (*x, share(reached))]),
                    );
                }
            }
        } else {
            for (level, counts) in outcomes.levels().iter().zip(outcomes.counts(None)) {
                let reached: f64 = counts[state.first_class().index()..].iter().sum();
                seen.push((*level, reached / counts.iter().sum::<f64>()));
            }
        }
        for (x, share) in seen {
            largest = largest.max((share - kind.probability(x).unwrap_or(share)).abs());
        }
    }
    Some(largest)
}

/// The spread of the capacities of the motions, the *efficiency* of the intensity measure: the
/// standard deviation of the logarithm of the lowest intensity at which each motion reaches the
/// limit state. `None` for counts, for fewer than two motions, if a motion has one run, if a motion does not reach the limit
/// state, and if all motions reach it at the same intensity: then the levels are too far apart to
/// show a spread.
pub fn capacity_spread(outcomes: &Outcomes, state: LimitState) -> Option<f64> {
    if !outcomes.tells_capacities() {
        return None;
    }
    let logs: Option<Vec<f64>> = outcomes
        .capacities(state)
        .into_iter()
        .map(|x| x.map(f64::ln))
        .collect();
    let (_, spread) = mean_and_sd(&logs?)?;
    // Rounding alone gives equal numbers a tiny spread.
    (spread > 1e-12).then_some(spread)
}

/// The mean and the standard deviation of a sample, with one degree of freedom taken off; `None` for
/// fewer than two values.
///
/// # Example
/// ```
/// assert_eq!(freestand::fragility::mean_and_sd(&[1.0, 2.0, 3.0]), Some((2.0, 1.0)));
/// assert_eq!(freestand::fragility::mean_and_sd(&[1.0]), None);
/// ```
pub fn mean_and_sd(values: &[f64]) -> Option<(f64, f64)> {
    if values.len() < 2 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    Some((mean, (squares / (values.len() - 1) as f64).sqrt()))
}

/// What was seen of a limit state at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Empirical {
    /// The intensity; of several levels together their geometric mean.
    pub intensity: f64,
    /// Runs, or motions where it is a distribution of capacities.
    pub trials: f64,
    /// How many of them reached the limit state.
    pub reached: f64,
}

/// The most bins of a cloud.
const MAX_BINS: usize = 10;

/// The fewest runs of a bin: below five a share says little.
const RUNS_OF_BIN: usize = 5;

/// The share of runs that reached a limit state at each level. Where every motion has several levels
/// of its own ([`Sampling::Own`]), the distribution of the capacities of the motions instead; of one
/// run per motion, the shares in up to ten bins of rising intensity with equally many runs.
pub fn empirical(outcomes: &Outcomes, state: LimitState) -> Vec<Empirical> {
    let first = state.first_class().index();
    let shares = || {
        outcomes
            .levels()
            .iter()
            .zip(outcomes.counts(None))
            .map(|(level, counts)| Empirical {
                intensity: *level,
                trials: counts.iter().sum(),
                reached: counts[first..].iter().sum(),
            })
    };
    match outcomes.sampling() {
        Sampling::Shared => shares().collect(),
        Sampling::Own => {
            let capacities = outcomes.capacities(state);
            let trials = capacities.len() as f64;
            let mut known: Vec<f64> = capacities.into_iter().flatten().collect();
            known.sort_by(f64::total_cmp);
            let seen = known.iter().enumerate();
            seen.map(|(i, x)| Empirical {
                intensity: *x,
                trials,
                reached: (i + 1) as f64,
            })
            .collect()
        }
        Sampling::Cloud => binned(&shares().collect::<Vec<_>>()),
    }
}

/// Levels with few runs each, joined to bins with equally many.
fn binned(levels: &[Empirical]) -> Vec<Empirical> {
    let all: f64 = levels.iter().map(|level| level.trials).sum();
    let bins = (levels.len() / RUNS_OF_BIN).clamp(1, MAX_BINS) as f64;
    let mut below = 0.0;
    let placed: Vec<(f64, &Empirical)> = levels
        .iter()
        .map(|level| {
            // The bin of the middle of the level, so that rounding does not decide.
            let place = (bins * (below + 0.5 * level.trials) / all).floor();
            below += level.trials;
            (place, level)
        })
        .collect();
    let joined = placed.chunk_by(|one, next| one.0 == next.0).map(|bin| {
        let sum = |of: fn(&Empirical) -> f64| bin.iter().map(|(_, level)| of(level)).sum::<f64>();
        let trials = sum(|level| level.trials);
        let intensity = (sum(|level| level.trials * level.intensity.ln()) / trials).exp();
        Empirical {
            intensity,
            trials,
            reached: sum(|level| level.reached),
        }
    });
    joined.collect()
}
