//! Lognormal fragilities, probabilities over motions with confidence intervals, and reproducible
//! random numbers.

mod draws;
mod interval;

use std::f64::consts::{SQRT_2, TAU};

use statrs::function::erf::erfc;
use thiserror::Error;

use crate::block::Block;

pub use draws::{draw_stream, log_uniform_draw, lognormal_draw, uniform_draw};
pub use interval::{clopper_pearson, probability_interval};

/// Φ, the standard normal distribution.
fn normal_ratio(z: f64) -> f64 {
    0.5 * erfc(-z / SQRT_2)
}

/// Probability that a demand exceeds a lognormal capacity: Φ(ln(demand/median)/β); 0 if there is no
/// demand.
///
/// `demand` and `median` are in the same unit, `beta` is the standard deviation of the logarithm.
///
/// # Reference
/// FEMA P-58-1, 2nd edition (2018), 3.8: fragilities.
///
/// # Accuracy
/// Rounding. With β = 0 it is a step, with ½ at the median.
///
/// # Example
/// A bookcase of five shelves with a median peak floor velocity of 0.29 m/s and β = 0.5, on a floor
/// with a peak velocity of 0.4 m/s, and on one with the median itself:
/// ```
/// use freestand::fragility::lognormal_probability;
/// assert!((lognormal_probability(0.4, 0.29, 0.5) - 0.73994).abs() < 5e-6);
/// assert_eq!(lognormal_probability(0.29, 0.29, 0.5), 0.5);
/// ```
pub fn lognormal_probability(demand: f64, median: f64, beta: f64) -> f64 {
    if demand <= 0.0 {
        return 0.0;
    }
    let log = (demand / median).ln();
    if log == 0.0 { 0.5 } else { normal_ratio(log / beta) }
}

/// A lognormal fragility fitted to failures counted at levels of intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LognormalFragility {
    /// Intensity at which half of the objects fail, in the unit of the levels.
    pub median: f64,
    /// β, the standard deviation of the logarithm.
    pub beta: f64,
    /// Standard error of ln median.
    pub median_log_error: f64,
    /// Standard error of β.
    pub beta_error: f64,
}

impl LognormalFragility {
    /// Probability of failure at an intensity.
    pub fn probability(&self, intensity: f64) -> f64 {
        lognormal_probability(intensity, self.median, self.beta)
    }
}

/// Why a fragility cannot be fitted to counts of failures.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FragilityError {
    /// A level without trials, with more failures than trials, or with an intensity that has no
    /// logarithm.
    #[error(
        "level {level} (intensity {intensity}, {failures} of {trials} failed): the intensity must be positive and \
         finite, there must be at least one trial, and no more failures than trials"
    )]
    Level {
        /// The level, counted from 1.
        level: usize,
        /// The intensity.
        intensity: f64,
        /// Number of failures.
        failures: u32,
        /// Number of trials.
        trials: u32,
    },
    /// No failure at any level.
    #[error("no trial failed (number of trials: {trials}), so the median is above all levels")]
    NoneFailed {
        /// Number of trials over all levels.
        trials: u64,
    },
    /// No survivor at any level.
    #[error("every trial failed (number of trials: {trials}), so the median is below all levels")]
    AllFailed {
        /// Number of trials over all levels.
        trials: u64,
    },
    /// A step from survival to failure: the likelihood grows without bound as β goes to 0.
    #[error(
        "there is no failure below {fails_from} and no survivor above {survives_to}, so the spread β is unknown: \
         test at more levels near these intensities"
    )]
    NoSpread {
        /// Lowest intensity with a failure.
        fails_from: f64,
        /// Highest intensity with a survivor.
        survives_to: f64,
    },
    /// Failures do not grow with intensity, or all levels have the same intensity.
    #[error("the failures do not grow with intensity, so no lognormal fragility fits them")]
    NotIncreasing,
}

/// The lognormal fragility with the largest likelihood: P(failure | x) = Φ(ln(x/θ)/β), with
/// binomial failures at each level.
///
/// Each level is (intensity, failures, trials). Survival need not be monotone in intensity: a level
/// may have fewer failures than the one below it. Newton's method (Fisher scoring) on z = b₀ + b₁
/// ln x, whose likelihood is concave; β = 1/b₁ and ln θ = −b₀/b₁, with the errors of both from the
/// information matrix.
///
/// # Reference
/// Baker, J. W. (2015). Efficient analytical fragility function fitting using dynamic structural
/// analysis. Earthquake Spectra 31(1), 579–599, Eq. (11).
///
/// # Accuracy
/// The score of the solution is 1e-10 of the number of trials.
///
/// # Limitation
/// The errors assume independent trials. Motions that were scaled to every level are not
/// independent, and the errors are then too small.
///
/// # Errors
/// A level without trials; no failure or no survivor at all; no overlap, so that β would be 0;
/// failures that do not grow.
///
/// # Example
/// Two levels are met exactly. Φ(∓1) = 0.158655 and 0.841345 at e^∓½: median 1, β = 0.5:
/// ```
/// let (low, high) = ((-0.5_f64).exp(), 0.5_f64.exp());
/// let levels = [(low, 158_655, 1_000_000), (high, 841_345, 1_000_000)];
/// let fitted = freestand::fragility::fit_lognormal(&levels)?;
/// assert!((fitted.median - 1.0).abs() < 1e-9 && (fitted.beta - 0.5).abs() < 1e-6);
/// # Ok::<(), freestand::fragility::FragilityError>(())
/// ```
pub fn fit_lognormal(levels: &[(f64, u32, u32)]) -> Result<LognormalFragility, FragilityError> {
    checked(levels)?;
    let trials: f64 = levels.iter().map(|&(_, _, trials)| f64::from(trials)).sum();
    // With the origin at the middle of the levels the two parameters are nearly independent.
    let middle = levels.iter().map(|&(x, _, trials)| x.ln() * f64::from(trials)).sum::<f64>() / trials;
    let points: Vec<_> = levels.iter().map(|&(x, f, n)| (x.ln() - middle, f64::from(f), f64::from(n))).collect();
    let mut b = [0.0, 1.0];
    let mut here = likelihood(&points, b);
    for _ in 0..200 {
        let (score, information) = derivatives(&points, b);
        let Some(step) = solved(information, score) else { return Err(FragilityError::NotIncreasing) };
        if score[0].abs().max(score[1].abs()) <= 1e-10 * trials {
            break;
        }
        // The likelihood is concave: halving the step always finds a better point until only
        // rounding is left.
        let better = (0..40).map(|i| 0.5_f64.powi(i)).find_map(|part| {
            let there = [b[0] + part * step[0], b[1] + part * step[1]];
            Some((there, likelihood(&points, there))).filter(|(_, value)| *value > here)
        });
        let Some((there, value)) = better else { break };
        (b, here) = (there, value);
    }
    let (_, information) = derivatives(&points, b);
    fitted(b, information, middle).ok_or(FragilityError::NotIncreasing)
}

/// Refuses counts whose likelihood has no maximum at a finite, positive slope.
fn checked(levels: &[(f64, u32, u32)]) -> Result<(), FragilityError> {
    for (i, &(intensity, failures, trials)) in levels.iter().enumerate() {
        if !(intensity > 0.0 && intensity.is_finite() && trials > 0 && failures <= trials) {
            return Err(FragilityError::Level { level: i + 1, intensity, failures, trials });
        }
    }
    let trials = levels.iter().map(|&(_, _, trials)| u64::from(trials)).sum();
    let failing = || levels.iter().filter(|(_, failures, _)| *failures > 0).map(|(x, ..)| *x);
    let surviving = || levels.iter().filter(|(_, failures, trials)| failures < trials).map(|(x, ..)| *x);
    let Some(fails_from) = failing().reduce(f64::min) else { return Err(FragilityError::NoneFailed { trials }) };
    let Some(survives_to) = surviving().reduce(f64::max) else { return Err(FragilityError::AllFailed { trials }) };
    let fails_to = failing().fold(0.0, f64::max);
    let survives_from = surviving().fold(f64::INFINITY, f64::min);
    if survives_from >= fails_to {
        return Err(FragilityError::NotIncreasing);
    }
    if fails_from >= survives_to {
        return Err(FragilityError::NoSpread { fails_from, survives_to });
    }
    Ok(())
}

/// ln of the binomial likelihood of (ln x, failures, trials).
fn likelihood(points: &[(f64, f64, f64)], b: [f64; 2]) -> f64 {
    let log = |z: f64| normal_ratio(z).max(f64::MIN_POSITIVE).ln();
    points
        .iter()
        .map(|&(x, failures, trials)| {
            let z = b[0] + b[1] * x;
            failures * log(z) + (trials - failures) * log(-z)
        })
        .sum()
}

/// The gradient of [`likelihood`] and the expected information (1,1), (1,2), (2,2).
fn derivatives(points: &[(f64, f64, f64)], b: [f64; 2]) -> ([f64; 2], [f64; 3]) {
    let (mut score, mut information) = ([0.0; 2], [0.0; 3]);
    for &(x, failures, trials) in points {
        let z = b[0] + b[1] * x;
        let density = (-0.5 * z * z).exp() / TAU.sqrt();
        let p = normal_ratio(z);
        let spread = (p * normal_ratio(-z)).max(f64::MIN_POSITIVE);
        let slope = density * (failures - trials * p) / spread;
        let weight = trials * density * density / spread;
        score = [score[0] + slope, score[1] + slope * x];
        information = [information[0] + weight, information[1] + weight * x, information[2] + weight * x * x];
    }
    (score, information)
}

/// Solves the symmetric 2 × 2 system; `None` where it is singular.
fn solved([a, b, c]: [f64; 3], [u, v]: [f64; 2]) -> Option<[f64; 2]> {
    let determinant = a * c - b * b;
    (determinant > 0.0).then(|| [(c * u - b * v) / determinant, (a * v - b * u) / determinant])
}

/// Converts back to median and β, with their errors by the delta method.
fn fitted(b: [f64; 2], information: [f64; 3], middle: f64) -> Option<LognormalFragility> {
    let [intercept, slope] = b;
    if slope <= 0.0 {
        return None;
    }
    let variance = |gradient: [f64; 2]| {
        solved(information, gradient).map(|half| (gradient[0] * half[0] + gradient[1] * half[1]).sqrt())
    };
    Some(LognormalFragility {
        median: (middle - intercept / slope).exp(),
        beta: 1.0 / slope,
        median_log_error: variance([-1.0 / slope, intercept / (slope * slope)])?,
        beta_error: variance([0.0, -1.0 / (slope * slope)])?,
    })
}

/// Peak floor velocity at which half of the blocks of this size overturn, by an empirical
/// formula \[m/s\]: V = A/(2πF) with A = (B/H)(1 + B/H) g and F = 15.6/√H (1 + B/H)^(−1.5), H in cm
/// and F in Hz; B is the base, H the height.
///
/// # Reference
/// Kaneko and Hayashi (2000), V_R50; quoted from memory. The nine medians of peak floor velocity
/// that FEMA P-58 gives for bookcases and filing cabinets are 0.75 to 0.81 of it: 0.8 V_R50 extends
/// them to other sizes.
///
/// # Accuracy
/// It is a fit to published simulations of blocks on floors; expect an error of up to a factor of
/// 1.5 either way.
///
/// # Example
/// A bookcase 71 in high and 12 5/8 in deep: 0.360 m/s; P-58 gives 0.29 m/s for it.
/// ```
/// use freestand::{block::Block, fragility::kaneko_hayashi_velocity_m_s};
/// let bookcase = Block::uniform(71.0 * 0.0254, 12.625 * 0.0254)?;
/// assert!((kaneko_hayashi_velocity_m_s(&bookcase) - 0.360).abs() < 5e-4);
/// # Ok::<(), freestand::block::BlockError>(())
/// ```
pub fn kaneko_hayashi_velocity_m_s(block: &Block) -> f64 {
    let ratio = block.base_width_m() / block.height_m();
    let acceleration_m_s2 = ratio * (1.0 + ratio) * crate::G0_M_S2;
    let frequency_hz = 15.6 / (100.0 * block.height_m()).sqrt() * (1.0 + ratio).powf(-1.5);
    acceleration_m_s2 / (TAU * frequency_hz)
}

#[cfg(test)]
mod tests;
