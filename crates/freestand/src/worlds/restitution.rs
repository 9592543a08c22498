//! Uncertain restitution, drawn through the share of energy that an impact takes.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Standard deviation of logit L where nothing else is known: one of them moves a restitution of
/// 0.95 to 0.930 or 0.966, as measured on concrete and granite (assumed).
pub const RESTITUTION_SPREAD: f64 = 0.40;

/// The restitution at `standard_normal` standard deviations: with L = 1 − r² the share of the
/// energy that an impact takes,
///
/// logit L = logit(1 − r_m²) + s ξ, r = √(1 − L) = 1/√(1 + e^(sξ) (1 − r_m²)/r_m²).
///
/// The result lies between 0 and 1, is never clipped, falls with ξ, and its median over normal ξ is
/// the median r_m that is given, e.g. that of Housner times the factor of the interface. A median
/// of 1 or more (a stated one) is not changed, and one of 0 or less (a block so squat that an
/// impact halts it) gives 0.
///
/// # Accuracy
/// Rounding: within 1e-15; with s ξ = 0 the median itself. From 1 − 1e-14 the result may round to
/// 1.
///
/// # Example
/// ```
/// use freestand::worlds::restitution_at;
/// assert_eq!(restitution_at(0.95, 0.4, 0.0), 0.95);
/// assert!((restitution_at(0.95, 0.4, 1.0) - 0.928).abs() < 5e-4);
/// assert!((restitution_at(0.95, 0.4, -1.0) - 0.966).abs() < 5e-4);
/// ```
pub fn restitution_at(median_ratio: f64, spread: f64, standard_normal: f64) -> f64 {
    let r = median_ratio;
    let shift = spread * standard_normal;
    if r <= 0.0 {
        0.0
    } else if r >= 1.0 || shift == 0.0 {
        r
    } else {
        // (1 − r)(1 + r) keeps the digits of a small loss.
        let odds = (1.0 - r) * (1.0 + r) / (r * r) * shift.exp();
        1.0 / (1.0 + odds).sqrt()
    }
}

/// [`restitution_at`] a random ξ; one random number is used whatever the median.
pub fn restitution_draw(random: &mut ChaCha8Rng, median_ratio: f64, spread: f64) -> f64 {
    let normal: f64 = StandardNormal.sample(random);
    restitution_at(median_ratio, spread, normal)
}
