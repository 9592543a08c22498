//! Draws of the uncertain values, and the probabilities that they give.

use freestand::block::Block;
use freestand::fragility::{draw_stream, lognormal_draw, probability_interval};
use freestand::rocking::Restitution;
use sha2::{Digest, Sha256};

use crate::result::Probability;
use freestand_study::study::assessment::{Settings, Spread};

use super::capacity::{Factors, Terms};
use super::object::{AxisGeometry, Subject};

/// Confidence level of every interval.
pub(super) const CONFIDENCE: f64 = 0.95;

/// Standard error of a probability, from the draws alone, below which more draws are not
/// worthwhile.
const ENOUGH_ERROR: f64 = 0.005;

/// Distance between a probability and the accepted one, in standard errors, from which more draws
/// cannot change the decision.
const CLEAR_ERRORS: f64 = 4.0;

/// The uncertain values of one history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Draw {
    restitution: f64,
    heights: f64,
    sides: [f64; 2],
    pub(super) stiffness: f64,
    pub(super) mass: f64,
    pub(super) model: f64,
}

/// A key that depends on a text alone: random numbers are keyed by the names of objects and
/// motions, not by their place.
pub(super) fn key(text: &str) -> u64 {
    let digest = Sha256::digest(text.as_bytes());
    digest.iter().take(8).fold(0, |key, byte| key << 8 | u64::from(*byte))
}

/// Draw number `index` of an object under a motion, both given by their [`key`]s.
pub(super) fn draw(settings: &Settings, subject: &Subject, object: u64, record: u64, index: u32) -> Draw {
    let mut stream = draw_stream(settings.seed, object, record, u64::from(index));
    let Spread { restitution, stiffness, mass, geometry, model } = settings.spread;
    let own = subject.body.as_ref().and_then(|body| body.stiffness_spread);
    // Always in this order: a value that is certain consumes its random number as well.
    let mut next = |spread: f64| lognormal_draw(&mut stream, 1.0, spread);
    let (stiffness, mass, model) = (next(own.unwrap_or(stiffness)), next(mass), next(model));
    let (heights, sides) = (next(geometry), [next(geometry), next(geometry)]);
    // Restitution comes last, since it may be drawn more than once.
    let limit =
        subject.axes.iter().map(|one| max_restitution_factor(subject, &one.block)).fold(f64::INFINITY, f64::min);
    let restitution = std::iter::repeat_with(|| next(restitution)).take(1000).find(|r| *r <= limit).unwrap_or(1.0);
    Draw { restitution, heights, sides, stiffness, mass, model }
}

/// Largest restitution that is drawn: no landing on a floor is more elastic, and with more a block
/// rocks for minutes.
const MAX_RESTITUTION: f64 = 0.99;

/// The factor that takes the restitution of an object to [`MAX_RESTITUTION`]; 1 where the stated
/// value is above.
pub(super) fn max_restitution_factor(subject: &Subject, block: &Block) -> f64 {
    (MAX_RESTITUTION / ratio(subject.restitution, block)).max(1.0)
}

/// The larger of the two ratios of a block.
fn ratio(restitution: Restitution, block: &Block) -> f64 {
    restitution.ratios(block).map_or(0.0, |[one, other]| one.max(other))
}

impl Draw {
    /// The block and its restitution.
    pub(super) fn block(&self, subject: &Subject, axis: usize) -> Option<(Block, Restitution)> {
        let geometry: &AxisGeometry = subject.axes.get(axis)?;
        let block = geometry.scaled(self.heights, self.sides.get(axis).copied().unwrap_or(1.0));
        // The restitution of the unchanged block, so that an uncertain height does not count twice.
        let restitution = (ratio(subject.restitution, &geometry.block) * self.restitution).min(1.0);
        Some((block, Restitution::Value(restitution)))
    }
}

/// The result of one draw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outcome {
    pub(super) overturned: bool,
    /// About each axis; `None` where nothing can be compared.
    pub(super) terms: [Option<Terms>; 2],
    /// The error of the model.
    pub(super) model: f64,
}

impl Outcome {
    /// Whether a criterion is exceeded, with factors on the shocks about each axis; overturned
    /// counts as exceeded.
    pub(super) fn exceeds_by(&self, factors: impl Fn(&Terms) -> Factors) -> bool {
        self.overturned || self.terms.iter().flatten().any(|one| one.ratio_by(factors(one).times(self.model)) > 1.0)
    }

    /// Whether a criterion is exceeded; overturned counts as exceeded.
    pub(super) fn exceeds(&self) -> bool {
        self.exceeds_by(|_| Factors::ONE)
    }
}

/// The draws of one object, `[motion][draw]`.
pub(super) type Draws = Vec<Vec<Outcome>>;

/// The share of each motion's draws for which something holds; motions without draws are left out.
pub(super) fn shares(draws: &Draws, holds: impl Fn(&Outcome) -> bool) -> Vec<f64> {
    let share = |motion: &Vec<Outcome>| motion.iter().filter(|one| holds(one)).count() as f64 / motion.len() as f64;
    draws.iter().filter(|motion| !motion.is_empty()).map(share).collect()
}

/// The probability from motions of equal weight; `None` without a motion.
pub(super) fn probability(by_motion: &[f64]) -> Option<Probability> {
    if by_motion.is_empty() {
        return None;
    }
    let value = by_motion.iter().sum::<f64>() / by_motion.len() as f64;
    let (low, high) = probability_interval(by_motion, CONFIDENCE);
    Some(Probability { value, low: low.min(value), high: high.max(value) })
}

/// Whether `count` draws for each motion are enough to compare a probability with the accepted one.
///
/// More draws reduce only the error within the motions, Σ pⱼ(1−pⱼ)/(count n²). The uncertainty from
/// the number of motions remains and is part of the interval.
pub(super) fn enough(by_motion: &[f64], count: u32, accepted_ratio: f64) -> bool {
    let n = by_motion.len() as f64;
    let within = by_motion.iter().map(|p| p * (1.0 - p)).sum::<f64>() / (f64::from(count) * n * n);
    let value = by_motion.iter().sum::<f64>() / n;
    // Where all draws of a motion agree, the next one might not.
    let error = within.sqrt().max(1.0 / (f64::from(count) * n * CLEAR_ERRORS));
    error <= ENOUGH_ERROR || (value - accepted_ratio).abs() >= CLEAR_ERRORS * error
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn enough_is_enough() {
        // Clear: no motion of 20, with 8 draws each.
        assert!(enough(&[0.0; 20], 8, 0.1));
        // Near: one motion is certain, one undecided; the error is √(0.25/8)/20 = 0.0088.
        let mut on_line = vec![0.0; 20];
        on_line[0] = 0.5;
        on_line[1] = 1.0;
        assert!(!enough(&on_line, 8, 0.1));
        assert!(enough(&on_line, 32, 0.1));
    }

    #[test]
    fn keys_depend_on_the_text_alone() {
        assert_eq!(key("rack-1"), key("rack-1"));
        assert_ne!(key("rack-1"), key("rack-2"));
        // The first bytes of SHA-256("abc") = ba7816bf 8f01cfea…
        assert_eq!(key("abc"), 0xba78_16bf_8f01_cfea);
    }
}
