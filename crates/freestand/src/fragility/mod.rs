//! Lognormal fragilities and their fits to outcomes, intervals of probabilities, and reproducible
//! random numbers.

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
pub use interval::clopper_pearson;
pub(crate) use interval::{lower_end, upper_end};
pub use ordered::{Crossing, Curve, CurveKind, Fit, FitKind, fit_curves};
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
