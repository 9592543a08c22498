//! The shock of an object that rocks, as a distribution up to its ceiling.

use thiserror::Error;

use super::maximum::{Derivatives, maximum};
use super::normal_ratio;
use super::ordered::{CurveKind, density};
use crate::search::bisect;

/// The shock of one run that rocked and did not overturn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShockRun {
    /// Intensity measure.
    pub intensity: f64,
    /// Shock \[g\].
    pub shock_g: f64,
    /// How many runs it counts for.
    pub weight: f64,
}

impl ShockRun {
    /// Whether its shock is above 0 and at most the ceiling \[g\]. The shock of a landing from the
    /// balance point is the ceiling, up to rounding.
    pub fn is_below(&self, ceiling_g: f64) -> bool {
        self.shock_g > 0.0 && self.shock_g <= ceiling_g * (1.0 + 1e-9)
    }
}

/// Why a distribution of shocks cannot be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ShockFitError {
    /// A shock that is not positive, or above the ceiling.
    #[error(
        "run {run}: the shock is {shock_g} g, but must be above 0 and at most the ceiling, {ceiling_g} g"
    )]
    Shock {
        /// The run, counted from 1.
        run: usize,
        /// The shock \[g\].
        shock_g: f64,
        /// The ceiling \[g\].
        ceiling_g: f64,
    },
    /// Fewer than three runs, or all at one intensity.
    #[error(
        "the shocks of at least three runs at two intensities are needed, and there are {runs}"
    )]
    TooFew {
        /// Number of runs with a shock.
        runs: usize,
    },
    /// The likelihood has no maximum: the shocks pile up below the ceiling, or lie on a line.
    #[error("no lognormal distribution below the ceiling fits the shocks")]
    NoMaximum,
}

/// Lognormal shock of an object that rocks, truncated at the ceiling c:
/// F(s | x) = Φ((ln s − μ)/σ)/Φ((ln c − μ)/σ) for s ≤ c, with μ = a + b ln x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShockDistribution {
    /// a, ln of the median shock in g at intensity 1 if there were no ceiling.
    pub intercept: f64,
    /// b, the power of the intensity.
    pub slope: f64,
    /// σ, the standard deviation of the logarithm if there were no ceiling.
    pub sigma: f64,
    /// The ceiling c \[g\].
    pub ceiling_g: f64,
    /// ln of the likelihood of ln s.
    pub log_likelihood: f64,
    /// Largest derivative of the likelihood by its parameters, divided by the number of runs.
    pub score_per_run: f64,
}

impl ShockDistribution {
    /// 1 − F: the probability that the shock of a run that rocks at this intensity is above a
    /// tolerance; 0 from the ceiling on.
    pub fn exceedance(&self, tolerance_g: f64, intensity: f64) -> f64 {
        if tolerance_g >= self.ceiling_g {
            return 0.0;
        }
        let of = |shock_g: f64| {
            (shock_g.ln() - self.intercept - self.slope * intensity.ln()) / self.sigma
        };
        let (z, top) = (of(tolerance_g), of(self.ceiling_g));
        // Φ(z)/Φ(top) of two small tails is the ratio of rounding errors beyond −37.
        if top < -37.0 {
            return -((top * top - z * z) / 2.0 + (top / z).ln()).exp_m1();
        }
        1.0 - normal_ratio(z) / normal_ratio(top)
    }
}

/// The distribution of shocks with the largest likelihood, of runs that rocked and did not overturn.
///
/// ln f = −ln σ − ½((ln s − μ)/σ)² − ln Φ((ln c − μ)/σ) + constant, μ = a + b ln x. In 1/σ, a/σ and
/// b/σ it has one maximum at most.
///
/// # Reference
/// Orme, C. (1989). On the uniqueness of the maximum likelihood estimator in truncated regression
/// models. Econometric Reviews 8, 217–222.
///
/// # Accuracy
/// Derivatives by 1/σ, a/σ and b/σ are at most 1e-8 of the number of runs.
///
/// # Errors
/// A shock above the ceiling, too few runs, or shocks that no such distribution fits.
pub fn fit_shock(runs: &[ShockRun], ceiling_g: f64) -> Result<ShockDistribution, ShockFitError> {
    if let Some(i) = runs.iter().position(|run| !run.is_below(ceiling_g)) {
        return Err(ShockFitError::Shock {
            run: i + 1,
            shock_g: runs[i].shock_g,
            ceiling_g,
        });
    }
    let weight: f64 = runs.iter().map(|run| run.weight).sum();
    let mean = |of: &dyn Fn(&ShockRun) -> f64| {
        runs.iter().map(|run| run.weight * of(run)).sum::<f64>() / weight
    };
    let middle = mean(&|run| run.intensity.ln());
    let spread = mean(&|run| (run.intensity.ln() - middle).powi(2)).sqrt();
    if runs.len() < 3 || spread.partial_cmp(&1e-12) != Some(std::cmp::Ordering::Greater) {
        return Err(ShockFitError::TooFew { runs: runs.len() });
    }
    let top = ceiling_g.ln();
    // Centred and scaled, the parameters are nearly independent.
    let points: Vec<[f64; 3]> = runs
        .iter()
        .map(|run| {
            [
                (run.intensity.ln() - middle) / spread,
                run.shock_g.ln().min(top),
                run.weight,
            ]
        })
        .collect();
    // The line and the spread without a ceiling are the start.
    let mean_log = mean(&|run| run.shock_g.ln());
    let along = points
        .iter()
        .map(|[z, s, weight]| weight * z * (s - mean_log))
        .sum::<f64>()
        / weight;
    let rest = points
        .iter()
        .map(|[z, s, w]| w * (s - mean_log - along * z).powi(2))
        .sum::<f64>()
        / weight;
    if rest.partial_cmp(&1e-20) != Some(std::cmp::Ordering::Greater) {
        return Err(ShockFitError::NoMaximum);
    }
    let scale = rest.sqrt();
    let start = [1.0, mean_log - top, along].map(|value| value / scale);
    let at = |parameters: &[f64; 3]| shock_likelihood(&points, top, parameters);
    let score = |_: &[f64; 3], gradient: &[f64; 3]| {
        gradient.iter().map(|slope| slope.abs()).fold(0.0, f64::max)
    };
    let found = maximum(start, 3, 1e-8 * weight, at, score);
    let ([tau, level, slope], derivatives) = found.ok_or(ShockFitError::NoMaximum)?;
    if tau <= 0.0 {
        return Err(ShockFitError::NoMaximum);
    }
    let slope = slope / tau / spread;
    Ok(ShockDistribution {
        intercept: top + level / tau - slope * middle,
        slope,
        sigma: 1.0 / tau,
        ceiling_g,
        log_likelihood: derivatives.value - 0.5 * std::f64::consts::TAU.ln() * weight,
        score_per_run: score(&[tau, level, slope], &derivatives.gradient) / weight,
    })
}

/// ln τ − ½ e² − ln Φ(t) with e = τ(ln s − ln c) − α − γ z and t = −α − γ z, so that
/// μ = ln c + (α + γ z)/τ.
fn shock_likelihood(
    points: &[[f64; 3]],
    top: f64,
    &[tau, level, slope]: &[f64; 3],
) -> Derivatives<3> {
    let mut sum = Derivatives::zero();
    if tau <= 0.0 {
        sum.value = f64::NEG_INFINITY;
        return sum;
    }
    for &[z, log, weight] in points {
        let below = log - top;
        let e = tau * below - level - slope * z;
        let t = -level - slope * z;
        let share = normal_ratio(t);
        // φ/Φ; far in the tail −t.
        let ratio = if t < -36.0 {
            -t - 1.0 / t
        } else {
            density(t) / share
        };
        let log_share = if t < -36.0 {
            -0.5 * t * t - (-t).ln() - 0.5 * std::f64::consts::TAU.ln()
        } else {
            share.ln()
        };
        sum.value += weight * (tau.ln() - 0.5 * e * e - log_share);
        let by = [below, -1.0, -z];
        let by_t = [0.0, -1.0, -z];
        // d²(−ln Φ)/dt² = r (t + r).
        let curved = ratio * (t + ratio);
        for i in 0..3 {
            sum.gradient[i] += weight * (-e * by[i] - ratio * by_t[i]);
            for j in 0..3 {
                sum.hessian[i][j] += weight * (-by[i] * by[j] + curved * by_t[i] * by_t[j]);
            }
        }
        sum.gradient[0] += weight / tau;
        sum.hessian[0][0] -= weight / (tau * tau);
    }
    sum
}

/// The probability that a tolerance is exceeded or the object overturns,
/// P_o + (1 − P_o − P_0)(1 − F(tolerance)), with P_o the probability of overturning and P_0 that of
/// no uplift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoStage {
    /// When it rocks.
    pub rocks: CurveKind,
    /// When it overturns.
    pub overturns: CurveKind,
    /// The shock of an object that rocks; `None` if it is not known, which happens only if the
    /// tolerance is at or above the ceiling, where it is not needed.
    pub shock: Option<ShockDistribution>,
    /// The ceiling \[g\].
    pub ceiling_g: f64,
    /// Tolerance \[g\].
    pub tolerance_g: f64,
}

impl TwoStage {
    /// Whether the tolerance is at or above the ceiling, so that only overturning exceeds it.
    pub fn is_above_ceiling(&self) -> bool {
        self.tolerance_g >= self.ceiling_g
    }

    /// The intensity at which the probability is ½; `None` if it never is between the thousandth
    /// and the thousandfold of the curve of overturning.
    pub fn median(&self) -> Option<f64> {
        let centre = self.overturns.median().or_else(|| self.rocks.median())?;
        let (low, high) = ((centre / 1e3).ln(), (centre * 1e3).ln());
        let is_beyond = |ln_x: f64| self.probability(ln_x.exp()) >= 0.5;
        (!is_beyond(low) && is_beyond(high)).then(|| bisect(low, high, is_beyond).exp())
    }

    /// The probability at an intensity.
    pub fn probability(&self, intensity: f64) -> f64 {
        let rocks = match self.rocks {
            // Below the weakest motions of the runs their shocks alone let the probability fall: it
            // has no jump there.
            CurveKind::All { .. } => 1.0,
            kind => kind.least_probability(intensity),
        };
        let overturns = self.overturns.least_probability(intensity);
        let exceedance = self
            .shock
            .map_or(0.0, |shock| shock.exceedance(self.tolerance_g, intensity));
        overturns + (rocks - overturns).max(0.0) * exceedance
    }
}
