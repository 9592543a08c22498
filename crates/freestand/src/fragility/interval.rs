//! Confidence intervals of probabilities.

use statrs::function::beta::checked_beta_reg;

/// Confidence interval of a probability after `hits` of `trials` independent yes-or-no trials; both
/// may be effective numbers and need not be whole.
///
/// The ends are quantiles of beta distributions, B(α/2; x, n − x + 1) and B(1 − α/2; x + 1, n − x)
/// with α = 1 − confidence; an end is 0 where there are no hits and 1 where all are. For whole
/// numbers the interval covers at least as often as its confidence says.
///
/// (0, 1) without trials, with more hits than trials, or with a confidence that is not from 0 to 1.
///
/// # Reference
/// Clopper and Pearson (1934), "The use of confidence or fiducial limits illustrated in the case of
/// the binomial", Biometrika 26.
///
/// # Accuracy
/// The ends are within 1e-15, or where that is larger, 1e-12 of their value.
///
/// # Example
/// Five of ten, 95 %: 18.7 to 81.3 %, as in the tables.
/// ```
/// let (low, high) = freestand::fragility::clopper_pearson(5.0, 10.0, 0.95);
/// assert!((low - 0.187086).abs() < 5e-7 && (low + high - 1.0).abs() < 1e-12);
/// ```
pub fn clopper_pearson(hits: f64, trials: f64, confidence: f64) -> (f64, f64) {
    // Rounding of share · trials may leave more hits than trials.
    let is_count =
        trials > 0.0 && trials.is_finite() && (0.0..=trials * (1.0 + 1e-12)).contains(&hits);
    if !is_count || !(0.0..=1.0).contains(&confidence) {
        return (0.0, 1.0);
    }
    let (hits, tail) = (hits.min(trials), 0.5 * (1.0 - confidence));
    let low = if hits > 0.0 {
        beta_quantile(hits, trials - hits + 1.0, tail)
    } else {
        0.0
    };
    let high = if hits < trials {
        beta_quantile(hits + 1.0, trials - hits, 1.0 - tail)
    } else {
        1.0
    };
    (low, high)
}

/// Quantile of the beta distribution by bisection: safe for every a and b, and fast compared with
/// the calculation of a motion.
fn beta_quantile(a: f64, b: f64, probability: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..52 {
        let middle = 0.5 * (low + high);
        if checked_beta_reg(a, b, middle).unwrap_or(1.0) < probability {
            low = middle
        } else {
            high = middle
        }
    }
    0.5 * (low + high)
}
