//! Lognormal fragilities of ordered limit states, fitted to outcomes.

use std::f64::consts::TAU;

use statrs::function::erf::erf_inv;

use super::maximum::{Derivatives, maximum};
use super::outcomes::{Counts, LimitState, Outcomes};
use super::{lognormal_probability, normal_ratio};

/// What is known about the probability of a limit state as a function of the intensity.
#[derive(Debug, Clone, Copy, PartialEq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum CurveKind {
    /// Φ(ln(x/median)/β).
    Lognormal {
        /// Intensity at which half of the runs reach it.
        median: f64,
        /// Standard deviation of the logarithm.
        beta: f64,
    },
    /// No run reached it up to `lower`, and all did from `upper`: β is not known. `lower` is below
    /// `upper`; where only a median is given, both are equal.
    Step {
        /// Highest intensity at which a run did not reach it.
        lower: f64,
        /// Lowest intensity at which a run reached it.
        upper: f64,
    },
    /// Some runs reached it and some did not at one level alone, none below and all above it: the
    /// likelihood grows towards β = 0 without end, and every share at that level suits it. At least
    /// one of the two is known.
    ///
    /// # Reference
    /// Albert, A. and Anderson, J. A. (1984). On the existence of maximum likelihood estimates in
    /// logistic regression models. Biometrika 71, 1–10: quasi-complete separation.
    Bounds {
        /// Highest intensity up to which no run reached it; `None`: some did at the lowest one.
        lower: Option<f64>,
        /// Lowest intensity from which every run reached it; `None`: not all did at the highest one.
        upper: Option<f64>,
    },
    /// No run reached it.
    None {
        /// The highest intensity.
        lower: f64,
    },
    /// Every run reached it.
    All {
        /// The lowest intensity.
        upper: f64,
    },
    /// It is not reached more often at higher intensities, so no fragility fits.
    NotIncreasing {
        /// Lowest intensity at which a run reached it.
        lower: f64,
        /// Highest intensity at which a run did not.
        upper: f64,
    },
}

impl CurveKind {
    /// The name in inputs and outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The intensity at which half of the runs reach it; of a step the geometric mean of its ends.
    pub fn median(self) -> Option<f64> {
        match self {
            Self::Lognormal { median, .. } => Some(median),
            Self::Step { lower, upper } => {
                let product = lower * upper;
                // The product of huge or tiny ends overflows or underflows.
                Some(if product.is_normal() {
                    product.sqrt()
                } else {
                    lower.sqrt() * upper.sqrt()
                })
            }
            Self::Bounds { .. }
            | Self::None { .. }
            | Self::All { .. }
            | Self::NotIncreasing { .. } => None,
        }
    }

    /// β; `None` where it is not known.
    pub fn beta(self) -> Option<f64> {
        if let Self::Lognormal { beta, .. } = self {
            Some(beta)
        } else {
            None
        }
    }

    /// The lower of the two intensities between which it changes, as far as they are known.
    pub fn lower(self) -> Option<f64> {
        match self {
            Self::Step { lower, .. } | Self::None { lower } | Self::NotIncreasing { lower, .. } => {
                Some(lower)
            }
            Self::Bounds { lower, .. } => lower,
            Self::Lognormal { .. } | Self::All { .. } => None,
        }
    }

    /// The upper one.
    pub fn upper(self) -> Option<f64> {
        match self {
            Self::Step { upper, .. } | Self::All { upper } | Self::NotIncreasing { upper, .. } => {
                Some(upper)
            }
            Self::Bounds { upper, .. } => upper,
            Self::Lognormal { .. } | Self::None { .. } => None,
        }
    }

    /// The probability at an intensity; a step is a jump at its median. `None` where no curve is
    /// known.
    pub fn probability(self, intensity: f64) -> Option<f64> {
        self.median()
            .map(|median| lognormal_probability(intensity, median, self.beta().unwrap_or(0.0)))
    }

    /// The probability at an intensity, also where no curve is known: then the least that the runs
    /// allow, 1 from the intensity on from which every run reached it, and 0 below. A step jumps at
    /// its median, between its ends. Of a state that is not reached more often at higher
    /// intensities nothing is known at any of them, so that 0 says nothing either: tell the user.
    ///
    /// # Example
    /// ```
    /// use freestand::fragility::CurveKind;
    /// let all = CurveKind::All { upper: 0.2 };
    /// assert_eq!((all.probability(0.3), all.least_probability(0.3)), (None, 1.0));
    /// assert_eq!(all.least_probability(0.1), 0.0);
    /// ```
    pub fn least_probability(self, intensity: f64) -> f64 {
        match self {
            Self::Lognormal { .. } | Self::Step { .. } => {
                self.probability(intensity).unwrap_or(0.0)
            }
            Self::All { upper }
            | Self::Bounds {
                upper: Some(upper), ..
            } => f64::from(u8::from(intensity >= upper)),
            Self::Bounds { upper: None, .. } | Self::None { .. } | Self::NotIncreasing { .. } => {
                0.0
            }
        }
    }
}

/// The fragility of one limit state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    /// The limit state.
    pub limit_state: LimitState,
    /// Its probability.
    pub kind: CurveKind,
}

/// How the limit states of an object are fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FitKind {
    /// All together, with one β: curves cannot cross.
    Ordered,
    /// Each by itself: curves may cross.
    Separate,
}

/// The curves of an object, and how well they fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// How they were fitted.
    pub kind: FitKind,
    /// One curve for each limit state, from harmless to severe.
    pub curves: Vec<Curve>,
    /// ln of the multinomial likelihood without its combinatorial constant; of separate fits the
    /// sum. Only limit states with a lognormal curve take part; 0 without any.
    pub log_likelihood: f64,
    /// Largest derivative of it by ln median or ln β, divided by the number of runs.
    pub score_per_run: f64,
}

/// Two curves that cross.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Their limit states, the less severe first.
    pub states: [LimitState; 2],
    /// Where they cross.
    pub intensity: f64,
}

impl Fit {
    /// The curve of a limit state.
    pub fn curve(&self, state: LimitState) -> Option<CurveKind> {
        self.curves
            .iter()
            .find(|curve| curve.limit_state == state)
            .map(|curve| curve.kind)
    }

    /// The limit states with a lognormal curve.
    pub fn fitted_states(&self) -> Vec<LimitState> {
        let fitted = self
            .curves
            .iter()
            .filter(|curve| matches!(curve.kind, CurveKind::Lognormal { .. }));
        fitted.map(|curve| curve.limit_state).collect()
    }

    /// The crossing of the lowest pair of limit states whose curves cross:
    /// ln x = (β₂ ln θ₁ − β₁ ln θ₂)/(β₂ − β₁). Beyond it the more severe state would be the more
    /// probable one. `None` if none cross between the given intensities.
    pub fn crossing(&self, from: f64, to: f64) -> Option<Crossing> {
        self.curves
            .iter()
            .zip(self.curves.iter().skip(1))
            .find_map(|(one, other)| {
                let (
                    CurveKind::Lognormal {
                        median: m1,
                        beta: b1,
                    },
                    CurveKind::Lognormal {
                        median: m2,
                        beta: b2,
                    },
                ) = (one.kind, other.kind)
                else {
                    return None;
                };
                let intensity = ((b2 * m1.ln() - b1 * m2.ln()) / (b2 - b1)).exp();
                (b1 != b2 && (from..=to).contains(&intensity)).then_some(Crossing {
                    states: [one.limit_state, other.limit_state],
                    intensity,
                })
            })
    }
}

/// Lognormal fragilities of these limit states, with the largest likelihood.
///
/// *Ordered*: P(class ≥ j | x) = Φ(ln(x/θⱼ)/β) with rising θⱼ and one β, so curves cannot cross; the
/// class of a run is multinomial. In 1/β and ln(θⱼ)/β the likelihood is concave, so Newton's method
/// finds its only maximum from any start. *Separate*: one binomial fit for each limit state.
///
/// A limit state that no run, every run, or every run above some intensity reached has no β: it is
/// a result of its own kind, and is left out of an ordered fit, whose classes then merge. Two states
/// between which no run ended have one curve.
///
/// # Reference
/// McCullagh, P. (1980). Regression models for ordinal data. Journal of the Royal Statistical
/// Society B 42, 109–142; Pratt, J. W. (1981) for the concavity. Baker, J. W. (2015). Earthquake
/// Spectra 31(1), 579–599, Eq. (11), for separate fits.
///
/// # Accuracy
/// Derivatives of the log-likelihood by ln θ and ln β are at most 1e-8 of the number of runs.
///
/// # Example
/// Φ(∓1) = 0.158655 and 0.841345 of the runs overturn at e^∓½: median 1, β = 0.5.
/// ```
/// use freestand::fragility::{CurveKind, FitKind, LimitState, OutcomeClass, Outcomes, Run, fit_curves};
/// let run = |ln_x: f64, class, weight| Run { motion: None, intensity: ln_x.exp(), class, weight };
/// let (rocked, overturned) = (OutcomeClass::Rocked, OutcomeClass::Overturned);
/// let runs = [
///     run(-0.5, rocked, 841_345.0),
///     run(-0.5, overturned, 158_655.0),
///     run(0.5, rocked, 158_655.0),
///     run(0.5, overturned, 841_345.0),
/// ];
/// let fit = fit_curves(&Outcomes::new(&runs)?, &[LimitState::Overturns], FitKind::Ordered);
/// let Some(CurveKind::Lognormal { median, beta }) = fit.curve(LimitState::Overturns) else { panic!() };
/// assert!((median - 1.0).abs() < 1e-9 && (beta - 0.5).abs() < 1e-6);
/// # Ok::<(), freestand::fragility::OutcomesError>(())
/// ```
pub fn fit_curves(outcomes: &Outcomes, states: &[LimitState], kind: FitKind) -> Fit {
    fit_counts(outcomes.levels(), &outcomes.counts(None), states, kind, &[])
}

/// As [`fit_curves`], to counts at rising levels; levels without runs are allowed. `near` are curves
/// that are close to those that are sought: they save steps, and change no result.
pub(super) fn fit_counts(
    levels: &[f64],
    counts: &[Counts],
    states: &[LimitState],
    kind: FitKind,
    near: &[Curve],
) -> Fit {
    let mut states = states.to_vec();
    states.sort_unstable();
    states.dedup();
    if kind == FitKind::Ordered {
        return ordered(levels, counts, &states, near);
    }
    let each: Vec<Fit> = states
        .iter()
        .map(|state| ordered(levels, counts, &[*state], near))
        .collect();
    Fit {
        kind,
        log_likelihood: each.iter().map(|fit| fit.log_likelihood).sum(),
        score_per_run: each.iter().map(|fit| fit.score_per_run).fold(0.0, f64::max),
        curves: each.into_iter().flat_map(|fit| fit.curves).collect(),
    }
}

/// What the counts of one limit state are if they are not a lognormal curve.
fn degenerate(levels: &[f64], counts: &[Counts], state: LimitState) -> Option<CurveKind> {
    let first = state.first_class().index();
    let of = |range: std::ops::Range<usize>| {
        let found = levels
            .iter()
            .zip(counts)
            .filter(move |(_, counts)| counts[range.clone()].iter().sum::<f64>() > 0.0);
        found.map(|(level, _)| *level)
    };
    let (reached, spared) = (|| of(first..4), || of(0..first));
    let (reached_from, spared_to) = (reached().next(), spared().next_back());
    let (Some(lowest), Some(highest)) = (reached_from, spared_to) else {
        return Some(match (reached_from, spared_to) {
            (Some(upper), _) => CurveKind::All { upper },
            (None, lower) => CurveKind::None {
                lower: lower.unwrap_or(0.0),
            },
        });
    };
    if spared().next() >= reached().next_back() {
        return Some(CurveKind::NotIncreasing {
            lower: lowest,
            upper: highest,
        });
    }
    if lowest == highest {
        let (below, above) = (
            spared().rfind(|level| *level < lowest),
            reached().find(|level| *level > highest),
        );
        return Some(CurveKind::Bounds {
            lower: below,
            upper: above,
        });
    }
    (lowest > highest).then_some(CurveKind::Step {
        lower: highest,
        upper: lowest,
    })
}

fn ordered(levels: &[f64], counts: &[Counts], states: &[LimitState], near: &[Curve]) -> Fit {
    let mut curves: Vec<Curve> = Vec::new();
    let mut fitted: Vec<LimitState> = Vec::new();
    for &limit_state in states {
        let kind = degenerate(levels, counts, limit_state);
        if kind.is_none() {
            fitted.push(limit_state);
        }
        let kind = kind.unwrap_or(CurveKind::NotIncreasing {
            lower: 0.0,
            upper: 0.0,
        });
        curves.push(Curve { limit_state, kind });
    }
    let model = Model::new(levels, counts, &fitted);
    let (mut log_likelihood, mut score_per_run) = (0.0, 0.0);
    let found = model
        .start_near(&fitted, near)
        .and_then(|start| model.fit_from(start))
        .or_else(|| model.fit());
    if let Some((found, derivatives)) = found {
        let [slope, ref thresholds @ ..] = found;
        log_likelihood = derivatives.value;
        score_per_run = model.score(&found, &derivatives.gradient) / model.runs;
        for (state, group) in fitted.iter().zip(&model.group_of) {
            let curve = curves.iter_mut().find(|curve| curve.limit_state == *state);
            if let Some(curve) = curve {
                curve.kind = CurveKind::Lognormal {
                    median: (model.middle + model.scale * thresholds[*group] / slope).exp(),
                    beta: model.scale / slope,
                };
            }
        }
    } else {
        // The likelihood grows towards ever flatter or falling curves.
        for curve in curves
            .iter_mut()
            .filter(|curve| fitted.contains(&curve.limit_state))
        {
            let used = || {
                levels
                    .iter()
                    .zip(counts)
                    .filter(|(_, counts)| counts.iter().sum::<f64>() > 0.0)
            };
            let (first, last) = (used().next(), used().next_back());
            let level = |pair: Option<(&f64, &Counts)>| pair.map_or(0.0, |(level, _)| *level);
            curve.kind = CurveKind::NotIncreasing {
                lower: level(first),
                upper: level(last),
            };
        }
    }
    Fit {
        kind: FitKind::Ordered,
        curves,
        log_likelihood,
        score_per_run,
    }
}

/// The ordered probit model: P(group ≥ g | z) = Φ(b z − c_g), z = (ln x − middle)/scale. The
/// parameters are b and up to three thresholds c.
struct Model {
    middle: f64,
    scale: f64,
    /// z and the counts of each group of classes at each level.
    points: Vec<(f64, [f64; 4])>,
    /// Number of runs.
    runs: f64,
    /// For each limit state its threshold.
    group_of: Vec<usize>,
    /// Number of thresholds.
    thresholds: usize,
}

/// b, c₁ … c₃.
type Parameters = [f64; 4];

impl Model {
    fn new(levels: &[f64], counts: &[Counts], states: &[LimitState]) -> Self {
        let total = |classes: std::ops::Range<usize>| -> f64 {
            counts
                .iter()
                .map(|counts| counts[classes.clone()].iter().sum::<f64>())
                .sum()
        };
        // The first class of each group. A state shares the threshold of the one before it if no
        // run ended between them.
        let mut firsts: Vec<usize> = Vec::new();
        let mut group_of = Vec::new();
        for state in states {
            let first = state.first_class().index();
            match firsts.last() {
                Some(&before) if total(before..first) == 0.0 => {}
                _ => firsts.push(first),
            }
            group_of.push(firsts.len() - 1);
        }
        let grouped = |counts: &Counts| {
            let mut groups = [0.0; 4];
            for (class, count) in counts.iter().enumerate() {
                groups[firsts.iter().filter(|first| class >= **first).count()] += count;
            }
            groups
        };
        let runs = total(0..4);
        let mean = |of: &dyn Fn(f64) -> f64| {
            let weighted = levels
                .iter()
                .zip(counts)
                .map(|(level, counts)| of(level.ln()) * counts.iter().sum::<f64>());
            weighted.sum::<f64>() / runs.max(f64::MIN_POSITIVE)
        };
        let middle = mean(&|ln_x| ln_x);
        let scale = mean(&|ln_x| (ln_x - middle).powi(2)).sqrt();
        let scale = if scale > 0.0 { scale } else { 1.0 };
        let points = levels
            .iter()
            .zip(counts)
            .map(|(level, counts)| ((level.ln() - middle) / scale, grouped(counts)));
        let points = points
            .filter(|(_, groups)| groups.iter().sum::<f64>() > 0.0)
            .collect();
        Self {
            middle,
            scale,
            points,
            runs,
            group_of,
            thresholds: firsts.len(),
        }
    }

    /// The parameters with the largest likelihood; `None` without limit states, or where no rising
    /// curve fits.
    fn fit(&self) -> Option<(Parameters, Derivatives<4>)> {
        if self.thresholds == 0 {
            return None;
        }
        // Flat curves at the observed shares: the likelihood is finite there, and concave.
        let mut start = [0.0; 4];
        for (i, threshold) in start.iter_mut().skip(1).take(self.thresholds).enumerate() {
            let above: f64 = self
                .points
                .iter()
                .map(|(_, groups)| groups[i + 1..].iter().sum::<f64>())
                .sum();
            *threshold = -std::f64::consts::SQRT_2 * erf_inv(2.0 * above / self.runs - 1.0);
        }
        self.fit_from(start)
    }

    /// The parameters of curves close to those that are sought; `None` unless each threshold has
    /// one and they rise.
    fn start_near(&self, states: &[LimitState], near: &[Curve]) -> Option<Parameters> {
        let mut start = [0.0; 4];
        for (state, group) in states.iter().zip(&self.group_of) {
            let kind = near.iter().find(|curve| curve.limit_state == *state)?.kind;
            let CurveKind::Lognormal { median, beta } = kind else {
                return None;
            };
            start[0] = self.scale / beta;
            // Of states that share a threshold the first counts.
            let threshold = &mut start[group + 1];
            if *threshold == 0.0 {
                *threshold = (median.ln() - self.middle) / beta;
            }
        }
        let used = &start[1..=self.thresholds];
        let is_rising = used.windows(2).all(|pair| pair[0] < pair[1]);
        (self.thresholds > 0 && is_rising && start.iter().all(|value| value.is_finite()))
            .then_some(start)
    }

    /// As [`Model::fit`], from other parameters.
    fn fit_from(&self, start: Parameters) -> Option<(Parameters, Derivatives<4>)> {
        let score = |at: &Parameters, gradient: &Parameters| self.score(at, gradient);
        let target = 1e-8 * self.runs;
        let (found, derivatives) = maximum(
            start,
            1 + self.thresholds,
            target,
            |at| self.log_likelihood(at),
            score,
        )?;
        (found[0] > 0.0).then_some((found, derivatives))
    }

    /// The largest derivative of the log-likelihood by ln θ or ln β: with β = scale/b and
    /// ln θ = middle + scale c/b, these are ∂/∂c · b/scale and −(b ∂/∂b + Σ c ∂/∂c).
    fn score(&self, at: &Parameters, gradient: &Parameters) -> f64 {
        let by_beta: f64 = at
            .iter()
            .zip(gradient)
            .map(|(value, slope)| value * slope)
            .sum();
        let by_median = gradient
            .iter()
            .skip(1)
            .map(|slope| (slope * at[0] / self.scale).abs())
            .fold(0.0, f64::max);
        // At b = 0 the derivatives by ln θ vanish, so those of the parameters count too.
        let own = if at[0] > 0.0 {
            0.0
        } else {
            gradient.iter().map(|slope| slope.abs()).fold(0.0, f64::max)
        };
        by_beta.abs().max(by_median).max(own)
    }

    fn log_likelihood(&self, at: &Parameters) -> Derivatives<4> {
        let mut sum = Derivatives::zero();
        for (z, groups) in &self.points {
            for (group, &count) in groups.iter().enumerate().take(self.thresholds + 1) {
                if count > 0.0 {
                    self.add(&mut sum, at, *z, group, count);
                }
            }
        }
        sum
    }

    /// Adds `count` ln p with p = Φ(u) − Φ(v), u = b z − c of the group (∞ for the first), v that of
    /// the next one (−∞ for the last).
    fn add(&self, sum: &mut Derivatives<4>, at: &Parameters, z: f64, group: usize, count: f64) {
        let upper = (group > 0).then(|| at[0] * z - at[group]);
        let lower = (group < self.thresholds).then(|| at[0] * z - at[group + 1]);
        let p = between(upper, lower).max(f64::MIN_POSITIVE);
        let slope = |at: Option<f64>| at.map_or(0.0, |at| density(at) / p);
        let (by_upper, by_lower) = (slope(upper), -slope(lower));
        let second = |at: Option<f64>, by: f64| at.map_or(0.0, |at| -at * by - by * by);
        let (upper_twice, lower_twice) = (second(upper, by_upper), second(lower, by_lower));
        let both = -by_upper * by_lower;
        sum.value += count * p.ln();
        // u and v depend on b by z, and on their own threshold by −1.
        sum.gradient[0] += count * z * (by_upper + by_lower);
        sum.hessian[0][0] += count * z * z * (upper_twice + lower_twice + 2.0 * both);
        let sides = [
            (group, by_upper, upper_twice),
            (group + 1, by_lower, lower_twice),
        ];
        for (i, by, twice) in sides {
            if (1..=self.thresholds).contains(&i) {
                sum.gradient[i] -= count * by;
                sum.hessian[i][i] += count * twice;
                let mixed = -count * z * (twice + both);
                sum.hessian[0][i] += mixed;
                sum.hessian[i][0] += mixed;
            }
        }
        if group > 0 && group < self.thresholds {
            sum.hessian[group][group + 1] += count * both;
            sum.hessian[group + 1][group] += count * both;
        }
    }
}

/// φ, the density of the standard normal distribution.
pub(super) fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}

/// Φ(upper) − Φ(lower) in the tail where both are small; `None` is an end at infinity.
fn between(upper: Option<f64>, lower: Option<f64>) -> f64 {
    match (upper, lower) {
        (None, None) => 1.0,
        (Some(upper), None) => normal_ratio(upper),
        (None, Some(lower)) => normal_ratio(-lower),
        (Some(upper), Some(lower)) if upper > 0.0 && lower > 0.0 => {
            normal_ratio(-lower) - normal_ratio(-upper)
        }
        (Some(upper), Some(lower)) => normal_ratio(upper) - normal_ratio(lower),
    }
}
