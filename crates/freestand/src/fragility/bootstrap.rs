//! How sure a fit is, and how well it fits: by drawing motions again.

use rand::RngExt;
use rand_distr::{Binomial, Distribution, StandardNormal};
use rayon::prelude::*;

use super::draws::draw_stream;
use super::ordered::{Curve, CurveKind, Fit, FitKind, fit_counts};
use super::outcomes::{Counts, LimitState, OutcomeClass, Outcomes};

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
        self.samples.iter().flatten().filter(move |curve| curve.limit_state == state).filter_map(|curve| {
            if let CurveKind::Lognormal { median, beta } = curve.kind { Some((median, beta)) } else { None }
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
            Some(NoInterval::FewCurves { known, samples: self.samples.len() })
        } else if medians.all(|median| first.is_some_and(|first| (median / first - 1.0).abs() < SAME_RATIO)) {
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
        Some(CurveInterval { median: percentiles(medians)?, beta: percentiles(betas)? })
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
        values.get(below as usize + 1).map_or(low, |high| low + part * (high - low))
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
        let fitted: Vec<LimitState> = curves.iter().filter(is_fitted).map(|curve| curve.limit_state).collect();
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
    /// Largest distance between the distribution of the capacities and its curve (Kolmogorov and
    /// Smirnov); of counts between the share at a level and the curve.
    pub ks: f64,
}

impl Goodness {
    /// Whether the curves do not fit: less than 5 % of samples deviate as much.
    pub fn is_misfit(&self) -> bool {
        self.p_value.is_some_and(|p| p < 0.05)
    }
}

/// How well curves fit; `None` if no limit state has a lognormal curve, and if `go_on` returns
/// false; it is called before every simulated sample.
///
/// A simulated sample has one capacity for each motion: a standard normal number ε, and at the
/// intensity x the limit states whose ln(x/θ)/β is above it are reached. So the levels of a motion
/// belong together, as those of a motion that is scaled do. Counts have no motions, and every run
/// has its own ε. Sample i uses the random numbers of (seed, i).
pub fn goodness(outcomes: &Outcomes, fit: &Fit, (replicates, seed): (u32, u64), go_on: GoOn) -> Option<Goodness> {
    let states = fit.fitted_states();
    if states.is_empty() {
        return None;
    }
    let (deviance, dof) = deviance(outcomes, fit, &states);
    // The outer `None`: stopped. The inner one: a sample without β for a state, which has no
    // deviance.
    let simulate = |replicate: u32| -> Option<Option<f64>> {
        if !go_on() {
            return None;
        }
        let simulated = simulated(outcomes, fit, &states, seed, replicate);
        let counts = simulated.counts(None);
        let again = fit_counts(simulated.levels(), &counts, &states, fit.kind, &fit.curves);
        Some((again.fitted_states() == states).then(|| self::deviance(&simulated, &again, &states).0))
    };
    let simulated: Vec<Option<f64>> = (0..replicates).into_par_iter().map(simulate).collect::<Option<_>>()?;
    let simulated: Vec<f64> = simulated.into_iter().flatten().collect();
    let larger = simulated.iter().filter(|other| **other >= deviance).count();
    // The sample itself is one of them.
    let p_value = (!simulated.is_empty()).then(|| (larger + 1) as f64 / (simulated.len() + 1) as f64);
    Some(Goodness { deviance, dof, p_value, ks: distance(outcomes, fit, &states) })
}

/// Runs with the outcomes that the curves give to drawn capacities.
fn simulated(outcomes: &Outcomes, fit: &Fit, states: &[LimitState], seed: u64, replicate: u32) -> Outcomes {
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
            let capacities: Vec<f64> = (0..motions).map(|_| StandardNormal.sample(&mut random)).collect();
            outcomes.with_classes(|run| class(run.level, capacities[run.motion]))
        }
        None => {
            let mut runs = Vec::new();
            for (level, counts) in outcomes.counts(None).iter().enumerate() {
                let mut drawn = [0.0; 4];
                // Class by class, beginning with the worst: how many of the remaining runs have it.
                let (mut left, mut worse) = (counts.iter().sum::<f64>().round() as u64, 0.0_f64);
                for state in states.iter().rev() {
                    let reached = fit.curve(*state).and_then(|kind| kind.probability(outcomes.levels()[level]));
                    let reached = reached.unwrap_or(0.0).max(worse);
                    let share = if worse < 1.0 { (reached - worse) / (1.0 - worse) } else { 0.0 };
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
            Outcomes::new(&runs).unwrap_or_else(|_| outcomes.clone())
        }
    }
}

/// The deviance and its degrees of freedom.
fn deviance(outcomes: &Outcomes, fit: &Fit, states: &[LimitState]) -> (f64, i64) {
    let counts = outcomes.counts(None);
    let by_states = |states: &[LimitState]| -> (f64, i64) {
        let mut firsts: Vec<usize> = states.iter().map(|state| state.first_class().index()).collect();
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
            let sum = each.iter().fold((0.0, 0), |sum, each| (sum.0 + each.0, sum.1 + each.1));
            (sum.0, sum.1, 2 * states.len())
        }
    };
    (2.0 * (saturated - fit.log_likelihood), shares - parameters as i64)
}

/// Σ n ln(n/N) over the groups of classes that begin with these.
fn saturated(counts: &Counts, firsts: &[usize]) -> f64 {
    let all: f64 = counts.iter().sum();
    let mut groups = [0.0; 4];
    for (class, count) in counts.iter().enumerate() {
        groups[firsts.iter().filter(|first| class >= **first).count()] += count;
    }
    groups.iter().filter(|count| **count > 0.0).map(|count| count * (count / all).ln()).sum()
}

/// The largest distance between what was seen and the curves.
fn distance(outcomes: &Outcomes, fit: &Fit, states: &[LimitState]) -> f64 {
    let mut largest: f64 = 0.0;
    for state in states {
        let Some(kind) = fit.curve(*state) else { continue };
        let mut seen: Vec<(f64, f64)> = Vec::new();
        if let Some(motions) = outcomes.motions() {
            let mut capacities: Vec<f64> = outcomes.capacities(*state).into_iter().flatten().collect();
            capacities.sort_by(f64::total_cmp);
            let share = |i: usize| (i + 1) as f64 / motions as f64;
            seen.extend(capacities.iter().enumerate().map(|(i, x)| (*x, share(i))));
            // Of equal capacities only the last counts: the others lie within the step.
            seen.reverse();
            seen.dedup_by(|next, kept| next.0 == kept.0);
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
    largest
}

/// The spread of the capacities of the motions, the *efficiency* of the intensity measure: the
/// standard deviation of the logarithm of the lowest intensity at which each motion reaches the
/// limit state. `None` for counts, for fewer than two motions, if a motion does not reach the limit
/// state, and if all motions reach it at the same intensity: then the levels are too far apart to
/// show a spread.
pub fn capacity_spread(outcomes: &Outcomes, state: LimitState) -> Option<f64> {
    let logs: Option<Vec<f64>> = outcomes.capacities(state).into_iter().map(|x| x.map(f64::ln)).collect();
    let logs = logs.filter(|logs| logs.len() >= 2)?;
    let mean = logs.iter().sum::<f64>() / logs.len() as f64;
    let spread = (logs.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (logs.len() - 1) as f64).sqrt();
    // Rounding alone gives equal numbers a tiny spread.
    (spread > 1e-12).then_some(spread)
}

/// What was seen of a limit state at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Empirical {
    /// The intensity.
    pub intensity: f64,
    /// Runs, or motions where it is a distribution of capacities.
    pub trials: f64,
    /// How many of them reached the limit state.
    pub reached: f64,
}

/// The share of runs that reached a limit state at each level; where every motion has levels of its
/// own (fewer than two runs per level on average), the distribution of the capacities of the
/// motions instead.
pub fn empirical(outcomes: &Outcomes, state: LimitState) -> Vec<Empirical> {
    if outcomes.has_own_levels() {
        let capacities = outcomes.capacities(state);
        let trials = capacities.len() as f64;
        let mut known: Vec<f64> = capacities.into_iter().flatten().collect();
        known.sort_by(f64::total_cmp);
        let seen = known.iter().enumerate().map(|(i, x)| Empirical { intensity: *x, trials, reached: (i + 1) as f64 });
        return seen.collect();
    }
    let first = state.first_class().index();
    let seen = outcomes.levels().iter().zip(outcomes.counts(None)).map(|(level, counts)| Empirical {
        intensity: *level,
        trials: counts.iter().sum(),
        reached: counts[first..].iter().sum(),
    });
    seen.collect()
}
