//! From probabilities at several intensities to a yearly rate.

use super::{DecisionError, within};

/// The share of a rate in the lowest strip above which a lower level is added: weak earthquakes are so
/// frequent that a small probability may be most of a rate.
const NEGLIGIBLE: f64 = 0.1;
/// The lowest level that is added: 1/64 of the intensity.
const LOWEST_RATIO: f64 = 1.0 / 64.0;

/// The probability of an event at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// Intensity relative to that of the study.
    pub intensity_ratio: f64,
    /// Probability of the event at that intensity.
    pub probability: f64,
}

/// How often an event happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnnualRate {
    /// Mean number of events per year \[1/year\].
    pub rate_per_year: f64,
    /// Probability of one or more within a year, 1 − e^−ν.
    pub probability_per_year: f64,
    /// Whether intensities below the lowest level might add to it: more than a tenth of the rate is in the
    /// strip of the lowest level.
    pub is_at_least: bool,
}

/// Rate of earthquakes stronger than `intensity_ratio` times that of the study, s^−k/return
/// period \[1/year\].
///
/// # Reference
/// EN 1998-1 (2004), 2.1(4), note: k is about 3.
pub fn hazard_per_year(intensity_ratio: f64, exponent: f64, return_period_years: f64) -> f64 {
    intensity_ratio.powf(-exponent) / return_period_years
}

/// The level to calculate next, below the lowest: 1/√2 of it where more than a tenth of the rate is in its
/// strip, and not below 1/64 of the intensity of the study; otherwise `None`. The levels may be in any
/// order.
pub fn level_below(levels: &[Level], hazard_per_year: impl Fn(f64) -> f64) -> Option<f64> {
    let mut sorted = levels.to_vec();
    sorted.sort_by(|a, b| a.intensity_ratio.total_cmp(&b.intensity_ratio));
    let next = sorted.first()?.intensity_ratio * std::f64::consts::FRAC_1_SQRT_2;
    let rate = annual_rate(&sorted, hazard_per_year).ok()?;
    (rate.is_at_least && next >= LOWEST_RATIO).then_some(next)
}

/// Yearly rate of an event from its probability at rising levels s₁ < s₂ < … of intensity,
///
/// ν = Σ P(sⱼ) \[λ(eⱼ₋₁) − λ(eⱼ)\], eⱼ = √(sⱼ sⱼ₊₁), e₀ = s₁ √(s₁/s₂), λ(eₙ) = 0,
///
/// with λ(s) the rate of earthquakes of intensity s or more, `hazard_per_year`. Below e₀ nothing is
/// counted, and above the last level the probability stays that of the last level.
///
/// # Reference
/// McGuire (2004), "Seismic hazard and risk analysis", section 10: the convolution of a fragility
/// with the hazard.
///
/// # Accuracy
/// A sum over strips: with levels √2 apart, k = 3 and lognormal fragilities (β 0.4, median 1 to 2),
/// within 7 % of the integral.
///
/// # Errors
/// Fewer than two levels, levels that do not rise from above 0, a probability outside 0 to 1, or a
/// hazard that grows with the intensity.
///
/// # Example
/// A certain event at two levels 1 and 4: λ(e₀ = ½) = 8/475 with k = 3.
/// ```
/// use freestand::decision::{Level, annual_rate, hazard_per_year};
/// let levels = [1.0, 4.0].map(|intensity_ratio| Level { intensity_ratio, probability: 1.0 });
/// let rate = annual_rate(&levels, |s| hazard_per_year(s, 3.0, 475.0))?;
/// assert!((rate.rate_per_year - 8.0 / 475.0).abs() < 1e-12 && rate.is_at_least);
/// # Ok::<(), freestand::decision::DecisionError>(())
/// ```
pub fn annual_rate(
    levels: &[Level],
    hazard_per_year: impl Fn(f64) -> f64,
) -> Result<AnnualRate, DecisionError> {
    within(
        levels.len() >= 2,
        "the number of levels",
        "2 or more",
        levels.len() as f64,
    )?;
    let mut below = 0.0;
    for level in levels {
        let ratio = level.intensity_ratio;
        within(
            ratio > below && ratio.is_finite(),
            "a level of intensity",
            "above 0 and above the one before",
            ratio,
        )?;
        let is_probability = (0.0..=1.0).contains(&level.probability);
        within(
            is_probability,
            "the probability at a level",
            "0 to 1",
            level.probability,
        )?;
        below = ratio;
    }
    let ratios: Vec<f64> = levels.iter().map(|level| level.intensity_ratio).collect();
    let strips = strip_rates(&ratios, hazard_per_year)?;
    let parts: Vec<f64> = levels
        .iter()
        .zip(strips)
        .map(|(level, strip)| level.probability * strip)
        .collect();
    let rate_per_year = parts.iter().sum::<f64>();
    let probability_per_year = -(-rate_per_year).exp_m1();
    let is_at_least = parts
        .first()
        .is_some_and(|lowest| *lowest > NEGLIGIBLE * rate_per_year);
    Ok(AnnualRate {
        rate_per_year,
        probability_per_year,
        is_at_least,
    })
}

/// Yearly rate of the motions that each of the rising levels s₁ < s₂ < … stands for,
/// λ(eⱼ₋₁) − λ(eⱼ), with the edges eⱼ of [`annual_rate`] \[1/year\].
///
/// # Errors
/// Fewer than two levels, levels that do not rise from above 0, or a hazard that grows with the
/// intensity.
pub fn strip_rates(
    levels: &[f64],
    hazard_per_year: impl Fn(f64) -> f64,
) -> Result<Vec<f64>, DecisionError> {
    within(
        levels.len() >= 2,
        "the number of levels",
        "2 or more",
        levels.len() as f64,
    )?;
    let mut below = 0.0;
    for &level in levels {
        within(
            level > below && level.is_finite(),
            "a level of intensity",
            "above 0 and above the one before",
            level,
        )?;
        below = level;
    }
    let first = levels[0] * (levels[0] / levels[1]).sqrt();
    let edges =
        std::iter::once(first).chain(levels.windows(2).map(|pair| (pair[0] * pair[1]).sqrt()));
    let rates: Vec<f64> = edges.map(hazard_per_year).chain([0.0]).collect();
    let mut strips = Vec::with_capacity(levels.len());
    for pair in rates.windows(2) {
        let strip = pair[0] - pair[1];
        within(
            strip >= 0.0 && strip.is_finite(),
            "the rate of a strip of intensities",
            "0 or more",
            strip,
        )?;
        strips.push(strip);
    }
    Ok(strips)
}
