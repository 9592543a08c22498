//! Lognormal fragilities and their fits to outcomes, probabilities over motions with confidence
//! intervals, and reproducible random numbers.

mod bootstrap;
mod draws;
mod incremental;
mod interval;
mod maximum;
mod ordered;
mod outcomes;
mod quality;
mod two_stage;

use std::f64::consts::{SQRT_2, TAU};

use libm::erfc;
use thiserror::Error;

use crate::block::Block;

pub use bootstrap::{
    Bootstrap, CurveInterval, Empirical, GoOn, Goodness, NoInterval, bootstrap, capacity_spread,
    empirical, goodness, mean_and_sd, percentiles,
};
pub use draws::{draw_stream, log_uniform_draw, lognormal_draw, uniform_draw};
pub use incremental::{
    BEYOND_RATIO, BRACKET_RATIO, STEP_RATIO, ScaleRun, level_weights, missing_levels,
    resurrections, scales_of_motion,
};
pub use interval::{clopper_pearson, probability_interval};
pub use ordered::{Curve, CurveKind, Fit, FitKind, fit_curves};
pub use outcomes::{LimitState, OutcomeClass, Outcomes, OutcomesError, Run, Sampling};
pub use quality::{Line, line_through, trend_p_value, weighted_line};
pub use two_stage::{ShockDistribution, ShockFitError, ShockRun, TwoStage, fit_shock};

/// Φ, the standard normal distribution.
pub(crate) fn normal_ratio(z: f64) -> f64 {
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
    if log == 0.0 {
        0.5
    } else {
        normal_ratio(log / beta)
    }
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
    /// The levels say too little about median or β for a standard error.
    #[error(
        "the standard errors of median {median} and β = {beta} cannot be calculated, because the levels are too far \
         from the median: test at levels nearer to it"
    )]
    NoErrors {
        /// The median.
        median: f64,
        /// β.
        beta: f64,
    },
}

/// The lognormal fragility with the largest likelihood: P(failure | x) = Φ(ln(x/θ)/β), with
/// binomial failures at each level.
///
/// Each level is (intensity, failures, trials). Survival need not be monotone in intensity: a level
/// may have fewer failures than the one below it. [`fit_curves`] of one limit state, with the errors
/// of ln θ and β from the expected information.
///
/// # Reference
/// Baker, J. W. (2015). Efficient analytical fragility function fitting using dynamic structural
/// analysis. Earthquake Spectra 31(1), 579–599, Eq. (11).
///
/// # Accuracy
/// The score of the solution is at most 1e-8 of the number of trials.
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
    for (i, &(intensity, failures, trials)) in levels.iter().enumerate() {
        if !(intensity > 0.0 && intensity.is_finite() && trials > 0 && failures <= trials) {
            return Err(FragilityError::Level {
                level: i + 1,
                intensity,
                failures,
                trials,
            });
        }
    }
    let run = |intensity: f64, class: OutcomeClass, count: u32| Run {
        motion: None,
        intensity,
        class,
        weight: f64::from(count),
    };
    let runs: Vec<Run> = levels
        .iter()
        .flat_map(|&(x, failures, trials)| {
            [
                run(x, OutcomeClass::NoUplift, trials - failures),
                run(x, OutcomeClass::Overturned, failures),
            ]
        })
        .collect();
    let trials = levels.iter().map(|&(_, _, trials)| u64::from(trials)).sum();
    // Every level was checked, so that only runs that do not exist can be refused.
    let outcomes = Outcomes::new(&runs).map_err(|_| FragilityError::NoneFailed { trials })?;
    let fit = fit_curves(&outcomes, &[LimitState::Overturns], FitKind::Separate);
    let (median, beta) = match fit.curve(LimitState::Overturns) {
        Some(CurveKind::Lognormal { median, beta }) => (median, beta),
        Some(CurveKind::All { .. }) => return Err(FragilityError::AllFailed { trials }),
        Some(CurveKind::Step { lower, upper }) => {
            return Err(FragilityError::NoSpread {
                fails_from: upper,
                survives_to: lower,
            });
        }
        Some(CurveKind::Bounds { .. }) => {
            // The one level at which some failed and some did not is the lowest with a failure.
            let failing = levels
                .iter()
                .filter(|(_, failures, _)| *failures > 0)
                .map(|(x, ..)| *x);
            let mixed = failing.fold(f64::INFINITY, f64::min);
            return Err(FragilityError::NoSpread {
                fails_from: mixed,
                survives_to: mixed,
            });
        }
        Some(CurveKind::NotIncreasing { .. }) => return Err(FragilityError::NotIncreasing),
        // A fit has a curve for each state that it was asked for.
        Some(CurveKind::None { .. }) | None => return Err(FragilityError::NoneFailed { trials }),
    };
    let (median_log_error, beta_error) =
        errors(levels, median, beta).ok_or(FragilityError::NoErrors { median, beta })?;
    Ok(LognormalFragility {
        median,
        beta,
        median_log_error,
        beta_error,
    })
}

/// Standard errors of ln median and of β, from the expected information by both.
///
/// With z = ln(x/θ)/β a trial has the information φ²/(Φ(1 − Φ)) · (∂z)(∂z)ᵀ, and ∂z = −(1, z)/β.
fn errors(levels: &[(f64, u32, u32)], median: f64, beta: f64) -> Option<(f64, f64)> {
    let mut information = [[0.0; 2]; 2];
    for &(x, _, trials) in levels {
        let z = (x / median).ln() / beta;
        let spread = (normal_ratio(z) * normal_ratio(-z)).max(f64::MIN_POSITIVE);
        let weight = f64::from(trials) * ordered::density(z).powi(2) / spread / (beta * beta);
        for (i, row) in information.iter_mut().enumerate() {
            for (j, cell) in row.iter_mut().enumerate() {
                *cell += weight * z.powi((i + j) as i32);
            }
        }
    }
    let variance = |unit: [f64; 2], i: usize| {
        maximum::solve_positive(&information, &unit, 2).map(|column| column[i])
    };
    Some((
        variance([1.0, 0.0], 0)?.sqrt(),
        variance([0.0, 1.0], 1)?.sqrt(),
    ))
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

#[cfg(test)]
mod fit_tests;
