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

/// The largest number of steps between no loss and the loss of all objects.
const MAX_STEPS: f64 = 131_072.0;
/// The smallest number of these steps, however many objects there are.
const MIN_STEPS: f64 = 4096.0;
/// How many terms are added for all levels and objects together: about a second of work.
const MAX_TERMS: f64 = 1e9;
/// Losses are counted in hundredths, such as cents.
const HUNDREDTHS: f64 = 100.0;

/// How often the loss is at least as large as each of `losses` if, given the level, objects fail
/// independently of each other: for each level its annual rate and the losses of every object.
///
/// The sums are taken on a lattice from 0 to the loss of all objects.
///
/// # Accuracy
/// Exact if all losses are multiples of an amount that divides the loss of all objects into at most
/// 131,072 steps (fewer if levels times objects exceed about 2,500, but at least 4,096). Otherwise
/// that number of steps is used. A loss between two steps is divided between both, which keeps the
/// expected loss, and each object adds up to half a step of uncertainty to `losses`.
pub fn independent_loss_exceedance(levels: &[(f64, Vec<LossShares>)], losses: &[f64]) -> Vec<LossPoint> {
    let largest = |object: &LossShares| object.iter().map(|share| share.0).fold(0.0, f64::max);
    let total = levels.iter().map(|(_, objects)| objects.iter().map(largest).sum()).fold(0.0, f64::max);
    let terms: usize = levels.iter().flat_map(|(_, objects)| objects).map(Vec::len).sum();
    let steps = (MAX_TERMS / terms.max(1) as f64).clamp(MIN_STEPS, MAX_STEPS);
    let all = || levels.iter().flat_map(|(_, objects)| objects).flatten().map(|share| share.0);
    // Rounding must not lower a loss; one that is divided between two steps is up to half a step
    // off.
    let (step, slack) = match common_amount(all()).filter(|amount| total <= steps * amount) {
        Some(amount) => (amount, 1e-6),
        None => (if total > 0.0 { total / steps } else { 1.0 }, 0.5),
    };
    let mut rates = vec![0.0; losses.len()];
    for (annual_rate, objects) in levels {
        let at_least = rising_sums(&sum_of(objects, step));
        for (rate, least) in rates.iter_mut().zip(losses) {
            let from = (least / step - slack).ceil().max(0.0) as usize;
            *rate += annual_rate * at_least.get(from).copied().unwrap_or(0.0);
        }
    }
    losses.iter().zip(rates).map(|(&loss, annual_rate)| LossPoint { loss, annual_rate }).collect()
}

/// The largest amount of which all losses are multiples; `None` if one of them is not a whole
/// number of hundredths.
fn common_amount(losses: impl Iterator<Item = f64>) -> Option<f64> {
    let mut common = 0;
    for loss in losses {
        let hundredths = (HUNDREDTHS * loss).round();
        // Above 2⁵³ hundredths an f64 no longer distinguishes single hundredths.
        let is_whole = hundredths < 9e15 && (HUNDREDTHS * loss - hundredths).abs() <= 1e-9 * hundredths.max(1.0);
        let (mut a, mut b) = (is_whole.then_some(hundredths as u64)?, common);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        common = a;
    }
    (common > 0).then_some(common as f64 / HUNDREDTHS)
}

/// The probability of each number of steps to which the losses of all objects can add up.
fn sum_of(objects: &[LossShares], step: f64) -> Vec<f64> {
    let mut sum = vec![1.0];
    for object in objects {
        // The whole steps of a loss, the rest as a share of a step, and the probability.
        let places: Vec<(usize, f64, f64)> = object
            .iter()
            .map(|&(loss, p)| {
                let whole = (loss / step + 1e-6).floor();
                (whole as usize, (loss / step - whole).max(0.0), p)
            })
            .collect();
        let longest = places.iter().map(|place| place.0).max().unwrap_or(0);
        let mut next = vec![0.0; sum.len() + longest + 1];
        for (whole, rest, p) in places {
            for (i, before) in sum.iter().enumerate() {
                next[i + whole] += before * p * (1.0 - rest);
                next[i + whole + 1] += before * p * rest;
            }
        }
        while next.last() == Some(&0.0) {
            next.pop();
        }
        sum = next;
    }
    sum
}

/// For each number of steps, the probability of at least that number.
fn rising_sums(probabilities: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut at_least: Vec<f64> = probabilities
        .iter()
        .rev()
        .map(|p| {
            sum += p;
            sum
        })
        .collect();
    at_least.reverse();
    at_least
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

    /// Fourteen objects with three states have 4.8 million sums. With costs that are multiples of
    /// ten all of them are exact, from the smallest loss to that of all objects. For seven of the
    /// objects the sums are listed and compared one by one.
    #[test]
    fn sums_of_many_objects_are_exact() {
        let object = |i: usize| -> LossShares {
            let (repair, all) = (10.0 * (3 * i + 1) as f64, 10.0 * (17 * i + 40) as f64);
            vec![(0.0, 0.9 - 0.02 * i as f64), (repair, 0.06 + 0.01 * i as f64), (all, 0.04 + 0.01 * i as f64)]
        };
        let objects: Vec<LossShares> = (0..14).map(object).collect();
        let total: f64 = objects.iter().map(|object| object[2].0).sum();
        let p = |share: usize| objects.iter().map(|object| object[share].1).product::<f64>();
        let curve = independent_loss_exceedance(&[(0.02, objects.clone())], &[10.0, total]);
        assert!((curve[0].annual_rate / (0.02 * (1.0 - p(0))) - 1.0).abs() < 1e-12);
        assert!((curve[1].annual_rate / (0.02 * p(2)) - 1.0).abs() < 1e-12);

        let few = &objects[..7];
        let mut sums: LossShares = vec![(0.0, 1.0)];
        for object in few {
            sums =
                sums.iter().flat_map(|&(loss, p)| object.iter().map(move |&(more, q)| (loss + more, p * q))).collect();
        }
        let losses: Vec<f64> = sums.iter().map(|sum| sum.0).filter(|loss| *loss > 0.0).collect();
        for point in independent_loss_exceedance(&[(1.0, few.to_vec())], &losses) {
            let expected: f64 = sums.iter().filter(|sum| sum.0 >= point.loss).map(|sum| sum.1).sum();
            assert!((point.annual_rate - expected).abs() < 1e-13, "{point:?} {expected}");
        }
    }

    /// Twenty objects with losses √2, 2√2, 4√2 … have a million sums and no common amount.
    #[test]
    fn losses_without_a_common_amount_are_shared_between_steps() {
        let unit = 2.0_f64.sqrt();
        let objects: Vec<LossShares> = (0..20).map(|i| vec![(0.0, 0.5), (unit * f64::from(1 << i), 0.5)]).collect();
        let losses: Vec<f64> = (1..=1024).map(|i| unit * f64::from(i * 1024)).collect();
        // The sums are uniform from 0 to (2²⁰ − 1)√2; with 131,072 steps, twenty objects are off by
        // at most ten of them.
        for point in independent_loss_exceedance(&[(1.0, objects)], &losses) {
            let expected = 1.0 - point.loss / unit / f64::from(1 << 20);
            assert!((point.annual_rate - expected).abs() < 10.0 / MAX_STEPS, "{point:?} {expected}");
        }
    }
}
