//! Confidence intervals of probabilities.

use statrs::function::beta::{checked_beta_reg, ln_beta};

/// Newton's method ends with a step below this share of the distance to the nearer end of (0, 1). The error left is at
/// most (a + b) times its square, as a share of that distance: 1e-17 with 1280 trials.
const LAST_STEP_RATIO: f64 = 1e-10;

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
/// Up to 1280 trials each end is within 1e-12 of its value or within 1e-15, whichever is larger; of 100,000 trials small
/// ends are within 1e-9 of their value, because the logarithms of gamma functions lose digits.
///
/// # Example
/// Five of ten, 95 %: 18.7 to 81.3 %, as in the tables.
/// ```
/// let (low, high) = freestand::fragility::clopper_pearson(5.0, 10.0, 0.95);
/// assert!((low - 0.187086).abs() < 5e-7 && (low + high - 1.0).abs() < 1e-12);
/// ```
pub fn clopper_pearson(hits: f64, trials: f64, confidence: f64) -> (f64, f64) {
    (
        lower_end(hits, trials, confidence),
        upper_end(hits, trials, confidence),
    )
}

/// The lower end of [`clopper_pearson`] alone.
pub(crate) fn lower_end(hits: f64, trials: f64, confidence: f64) -> f64 {
    match counted(hits, trials, confidence) {
        Some((hits, tail)) if hits > 0.0 && tail > 0.0 => {
            beta_quantile(hits, trials - hits + 1.0, tail)
        }
        _ => 0.0,
    }
}

/// The upper end of [`clopper_pearson`] alone.
pub(crate) fn upper_end(hits: f64, trials: f64, confidence: f64) -> f64 {
    match counted(hits, trials, confidence) {
        Some((hits, tail)) if hits < trials && tail > 0.0 => {
            beta_quantile(hits + 1.0, trials - hits, 1.0 - tail)
        }
        _ => 1.0,
    }
}

/// The hits, at most as many as trials, and the probability outside each end; `None`: the arguments are no count or no
/// confidence.
fn counted(hits: f64, trials: f64, confidence: f64) -> Option<(f64, f64)> {
    // Rounding of share · trials may leave more hits than trials.
    let is_count =
        trials > 0.0 && trials.is_finite() && (0.0..=trials * (1.0 + 1e-12)).contains(&hits);
    let is_known = is_count && (0.0..=1.0).contains(&confidence);
    is_known.then(|| (hits.min(trials), 0.5 * (1.0 - confidence)))
}

/// Quantile of the beta distribution by Newton's method, and by bisection where a step would leave the bracket.
fn beta_quantile(a: f64, b: f64, probability: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let ln_beta = ln_beta(a, b);
    let mut at = a / (a + b);
    // A bound: bisection alone would take 52 steps.
    for _ in 0..100 {
        let missed = checked_beta_reg(a, b, at).unwrap_or(1.0) - probability;
        if missed < 0.0 {
            low = at;
        } else {
            high = at;
        }
        let density = ((a - 1.0) * at.ln() + (b - 1.0) * (-at).ln_1p() - ln_beta).exp();
        let newton = at - missed / density;
        let next = match low <= newton && newton <= high {
            true => newton,
            false => 0.5 * (low + high),
        };
        // A step squares the error, so the next one would be below rounding.
        let last = (LAST_STEP_RATIO * next.min(1.0 - next)).max(f64::EPSILON * next);
        let is_there = (next - at).abs() <= last;
        at = next;
        if is_there {
            break;
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Up to 1280 trials, as the documentation says.
    const ACCURACY: f64 = 1e-12;

    fn by_bisection(a: f64, b: f64, probability: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match checked_beta_reg(a, b, middle).unwrap() < probability {
                true => low = middle,
                false => high = middle,
            }
        }
        0.5 * (low + high)
    }

    #[test]
    fn the_ends_are_those_of_bisection() {
        for trials in [1.0, 2.0, 6.5, 20.0, 45.0, 320.0, 1280.0, 1e5] {
            for hits in [
                0.01,
                0.5,
                1.0,
                3.0,
                0.3 * trials,
                0.5 * trials,
                trials - 0.5,
            ] {
                if hits >= trials {
                    continue;
                }
                for confidence in [0.5, 0.9, 0.98, 0.9999] {
                    let tail = 0.5 * (1.0 - confidence);
                    let low = by_bisection(hits, trials - hits + 1.0, tail);
                    let high = by_bisection(hits + 1.0, trials - hits, 1.0 - tail);
                    let found = clopper_pearson(hits, trials, confidence);
                    // Both by the same function of beta, so this is about the iteration.
                    for (found, expected) in [(found.0, low), (found.1, high)] {
                        let error = (found - expected).abs();
                        assert!(
                            error <= 1e-12 * expected + 1e-15,
                            "{hits} of {trials}, {confidence}: {found} {expected}"
                        );
                    }
                }
            }
        }
    }

    /// All or none of n: the ends are (α/2)^(1/n) and 1 − (α/2)^(1/n).
    #[test]
    fn the_ends_of_all_and_none_are_roots() {
        for trials in [1.0, 6.5, 20.0, 320.0, 1280.0, 1e5] {
            for confidence in [0.0_f64, 0.5, 0.98, 0.9999, 1.0] {
                let root = (0.5 * (1.0 - confidence)).powf(1.0 / trials);
                let (low, one) = clopper_pearson(trials, trials, confidence);
                let (zero, high) = clopper_pearson(0.0, trials, confidence);
                assert_eq!((zero, one), (0.0, 1.0));
                for (found, expected) in [(low, root), (high, 1.0 - root)] {
                    let error = (found - expected).abs();
                    let accuracy = if trials > 1280.0 { 1e-9 } else { ACCURACY };
                    assert!(
                        error <= accuracy * expected,
                        "{trials} {confidence}: {found} {expected}"
                    );
                }
            }
        }
    }
}
