//! How often a loss is as large, over worlds that all objects share.

/// A motion at a level, and what it costs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct World {
    /// How often it happens \[1/year\].
    pub annual_rate: f64,
    /// Loss of all objects together.
    pub loss: f64,
}

/// A point of a loss exceedance curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LossPoint {
    /// Loss.
    pub loss: f64,
    /// How often a loss is as large or larger \[1/year\].
    pub annual_rate: f64,
}

/// Σ ν L \[currency/year\].
pub fn expected_loss_per_year(worlds: &[World]) -> f64 {
    worlds.iter().map(|world| world.annual_rate * world.loss).sum()
}

/// How often a loss is at least as large as each of the distinct losses above 0, by rising loss.
///
/// # Example
/// ```
/// use freestand::risk::{World, loss_exceedance};
/// let world = |annual_rate, loss| World { annual_rate, loss };
/// let curve = loss_exceedance(&[world(0.5, 0.0), world(0.25, 10.0), world(0.125, 30.0), world(0.25, 10.0)]);
/// let points: Vec<(f64, f64)> = curve.iter().map(|point| (point.loss, point.annual_rate)).collect();
/// assert_eq!(points, [(10.0, 0.625), (30.0, 0.125)]);
/// ```
pub fn loss_exceedance(worlds: &[World]) -> Vec<LossPoint> {
    let mut sorted: Vec<World> = worlds.iter().copied().filter(|world| world.loss > 0.0).collect();
    sorted.sort_by(|a, b| b.loss.total_cmp(&a.loss));
    let mut curve: Vec<LossPoint> = Vec::new();
    let mut annual_rate = 0.0;
    for world in sorted {
        annual_rate += world.annual_rate;
        match curve.last_mut() {
            Some(point) if point.loss == world.loss => point.annual_rate = annual_rate,
            _ => curve.push(LossPoint { loss: world.loss, annual_rate }),
        }
    }
    curve.reverse();
    curve
}

/// The largest loss that is reached or exceeded at least once in this many years on average; 0 where
/// none is.
pub fn loss_at_return_period(curve: &[LossPoint], years: f64) -> f64 {
    let frequent = curve.iter().filter(|point| point.annual_rate * years >= 1.0);
    frequent.map(|point| point.loss).fold(0.0, f64::max)
}

/// The losses of one object at one level, with their probabilities.
pub type LossShares = Vec<(f64, f64)>;

/// Most distinct losses that a sum of objects keeps.
const MAX_LOSSES: usize = 4096;

/// How often the loss is at least as large as each of `losses` if, given the level, objects fail
/// independently of each other: for each level its annual rate and the losses of every object.
///
/// # Accuracy
/// Exact up to 4096 distinct sums of losses; beyond that neighbours are joined at their mean, which
/// keeps the expected loss.
pub fn independent_loss_exceedance(levels: &[(f64, Vec<LossShares>)], losses: &[f64]) -> Vec<LossPoint> {
    let mut rates = vec![0.0; losses.len()];
    for (annual_rate, objects) in levels {
        let mut sum: LossShares = vec![(0.0, 1.0)];
        for object in objects {
            let pairs = sum.iter().flat_map(|&(loss, p)| object.iter().map(move |&(more, q)| (loss + more, p * q)));
            let mut next: LossShares = pairs.filter(|(_, p)| *p > 0.0).collect();
            next.sort_by(|a, b| a.0.total_cmp(&b.0));
            sum = joined(&next);
            while sum.len() > MAX_LOSSES {
                sum = sum.chunks(2).map(mean_of).collect();
            }
        }
        for (rate, least) in rates.iter_mut().zip(losses) {
            // Sums of the same costs in another order differ in the last digit.
            let share: f64 = sum.iter().filter(|(loss, _)| *loss >= least * (1.0 - 1e-12)).map(|(_, p)| p).sum();
            *rate += annual_rate * share;
        }
    }
    losses.iter().zip(rates).map(|(&loss, annual_rate)| LossPoint { loss, annual_rate }).collect()
}

/// Joins neighbours that are equal.
fn joined(sorted: &[(f64, f64)]) -> LossShares {
    let mut all: LossShares = Vec::new();
    for &(loss, p) in sorted {
        match all.last_mut() {
            Some(last) if last.0 == loss => last.1 += p,
            _ => all.push((loss, p)),
        }
    }
    all
}

fn mean_of(pair: &[(f64, f64)]) -> (f64, f64) {
    let p: f64 = pair.iter().map(|(_, p)| p).sum();
    (pair.iter().map(|(loss, p)| loss * p).sum::<f64>() / p, p)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worlds(of: &[(f64, f64)]) -> Vec<World> {
        of.iter().map(|&(annual_rate, loss)| World { annual_rate, loss }).collect()
    }

    /// Two equal objects under common motions: the same rates at twice the losses.
    #[test]
    fn two_equal_objects_lose_twice_as_much() {
        let one = worlds(&[(0.01, 0.0), (0.002, 1000.0), (0.001, 5000.0), (0.003, 1000.0)]);
        let two: Vec<World> = one.iter().map(|world| World { loss: 2.0 * world.loss, ..*world }).collect();
        let (curve, double) = (loss_exceedance(&one), loss_exceedance(&two));
        assert_eq!(curve.len(), 2);
        for (a, b) in curve.iter().zip(&double) {
            assert_eq!((2.0 * a.loss, a.annual_rate), (b.loss, b.annual_rate));
        }
        assert_eq!(expected_loss_per_year(&two), 2.0 * expected_loss_per_year(&one));
        assert_eq!(loss_at_return_period(&curve, 100.0), 0.0);
        assert_eq!((loss_at_return_period(&curve, 200.0), loss_at_return_period(&curve, 1001.0)), (1000.0, 5000.0));
    }

    /// The area under the curve is the expected loss.
    #[test]
    fn the_curve_and_the_expected_loss_agree() {
        let all = worlds(&[(0.01, 3.0), (0.002, 10.0), (0.001, 50.0), (0.003, 11.0), (0.2, 0.0)]);
        let mut before = 0.0;
        let area: f64 = loss_exceedance(&all)
            .iter()
            .map(|point| {
                let part = (point.loss - before) * point.annual_rate;
                before = point.loss;
                part
            })
            .sum();
        assert!((area - expected_loss_per_year(&all)).abs() < 1e-15);
    }

    /// Binomial: ten objects that lose 1 with p = 0.3.
    #[test]
    fn independent_objects_are_binomial() {
        let object: LossShares = vec![(0.0, 0.7), (1.0, 0.3)];
        let curve = independent_loss_exceedance(&[(0.02, vec![object; 10])], &[1.0, 10.0]);
        assert!((curve[0].annual_rate - 0.02 * (1.0 - 0.7_f64.powi(10))).abs() < 1e-15);
        assert!((curve[1].annual_rate / (0.02 * 0.3_f64.powi(10)) - 1.0).abs() < 1e-12);
    }

    /// Twenty objects with losses 1, 2, 4 … have a million sums: joined, they keep their mean.
    #[test]
    fn joined_losses_keep_their_mean() {
        let objects: Vec<LossShares> = (0..20).map(|i| vec![(0.0, 0.5), (f64::from(1 << i), 0.5)]).collect();
        let losses: Vec<f64> = (1..=1024).map(|i| f64::from(i * 1024)).collect();
        let curve = independent_loss_exceedance(&[(1.0, objects)], &losses);
        // Uniform from 0 to 2²⁰ − 1; a joined loss is off by a 4096th of the range at most.
        for point in curve {
            let expected = 1.0 - point.loss / f64::from(1 << 20);
            assert!((point.annual_rate - expected).abs() < 1.0 / 1024.0, "{point:?} {expected}");
        }
    }
}
