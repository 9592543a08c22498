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
    worlds
        .iter()
        .map(|world| world.annual_rate * world.loss)
        .sum()
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
    let mut sorted: Vec<World> = worlds
        .iter()
        .copied()
        .filter(|world| world.loss > 0.0)
        .collect();
    sorted.sort_by(|a, b| b.loss.total_cmp(&a.loss));
    let mut curve: Vec<LossPoint> = Vec::new();
    let mut annual_rate = 0.0;
    for world in sorted {
        annual_rate += world.annual_rate;
        match curve.last_mut() {
            Some(point) if point.loss == world.loss => point.annual_rate = annual_rate,
            _ => curve.push(LossPoint {
                loss: world.loss,
                annual_rate,
            }),
        }
    }
    curve.reverse();
    curve
}

/// The largest loss that is reached or exceeded at least once in this many years on average; 0 where
/// none is.
pub fn loss_at_return_period(curve: &[LossPoint], years: f64) -> f64 {
    let frequent = curve
        .iter()
        .filter(|point| point.annual_rate * years >= 1.0);
    frequent.map(|point| point.loss).fold(0.0, f64::max)
}

/// The losses of one object at one level, with their probabilities.
pub type LossShares = Vec<(f64, f64)>;

/// The largest number of steps between no loss and the loss of all objects.
const MAX_STEPS: f64 = 131_072.0;
/// The smallest number of these steps, however many objects there are.
const MIN_STEPS: f64 = 4096.0;
/// How many terms are added for all levels and objects together on one lattice: about a second of
/// work.
const MAX_TERMS: f64 = 1e9;
/// Losses are counted in hundredths, such as cents.
const HUNDREDTHS: f64 = 100.0;

/// How much finer the next lattice is.
const FINER: f64 = 64.0;
/// The most lattices: losses of one part in 64⁶, 7·10¹⁰, are resolved.
const MAX_LATTICES: usize = 6;
/// On a lattice that is not exact a loss counts as reached from so many steps below it. A sum of m
/// losses between steps is shared among m + 1 of them, with a standard deviation of √m/2 steps at
/// most: three steps hold nearly all of it for a few objects, whose sums are what is asked for.
const SHARED: f64 = 3.0;
/// The same on an exact lattice: rounding must not lower a loss.
const ROUNDING: f64 = 1e-6;

/// How often the loss is at least as large as each of `losses` if, given the level, objects fail
/// independently of each other: for each level its annual rate and the losses of every object.
///
/// The sums are taken on lattices from 0 upwards, the coarsest to the loss of all objects, each
/// other one 64 times finer, up to as many steps; its last step stands for everything above. Every
/// loss is taken from the finest lattice that it is on.
///
/// # Accuracy
/// Exact if all losses are multiples of an amount that divides the loss of all objects into at most
/// 131,072 steps (fewer if levels times objects exceed about 2,500, at least 4,096), and up to so
/// many of this amount in any case. Otherwise a loss between two steps is divided between both,
/// which keeps the expected loss, each object adds up to half a step of uncertainty to the losses
/// that are asked for, and losses up to three steps below count as reached. A loss has 64 steps or
/// more. How often any loss happens, which is the rate of the smallest one, is exact.
pub fn independent_loss_exceedance(
    levels: &[(f64, Vec<LossShares>)],
    losses: &[f64],
) -> Vec<LossPoint> {
    let terms: usize = levels
        .iter()
        .flat_map(|(_, objects)| objects)
        .map(Vec::len)
        .sum();
    on_lattices(
        levels,
        losses,
        (MAX_TERMS / terms.max(1) as f64)
            .clamp(MIN_STEPS, MAX_STEPS)
            .floor(),
    )
}

/// The same with at most so many steps.
fn on_lattices(levels: &[(f64, Vec<LossShares>)], losses: &[f64], steps: f64) -> Vec<LossPoint> {
    let largest = |object: &LossShares| object.iter().map(|share| share.0).fold(0.0, f64::max);
    let total = levels
        .iter()
        .map(|(_, objects)| objects.iter().map(largest).sum())
        .fold(0.0, f64::max);
    let all = || {
        levels
            .iter()
            .flat_map(|(_, objects)| objects)
            .flatten()
            .map(|share| share.0)
    };
    let least = losses
        .iter()
        .copied()
        .filter(|loss| *loss > 0.0)
        .fold(f64::INFINITY, f64::min);
    let lattices = lattices(total, common_amount(all()), least, steps);
    // The lattice of each loss that is asked for.
    let finest = |loss: f64| {
        lattices
            .iter()
            .rposition(|(step, _)| loss <= steps * step)
            .unwrap_or(0)
    };
    let places: Vec<usize> = losses.iter().map(|loss| finest(*loss)).collect();
    let mut rates = vec![0.0; losses.len()];
    for (annual_rate, objects) in levels {
        let (any, smallest) = any_loss(objects);
        for (number, &(step, slack)) in lattices
            .iter()
            .enumerate()
            .filter(|(number, _)| places.contains(number))
        {
            let at_least = rising_sums(&sum_of(objects, step, steps as usize));
            let here = rates
                .iter_mut()
                .zip(losses)
                .zip(&places)
                .filter(|(_, place)| **place == number);
            for ((rate, &least), _) in here {
                *rate += annual_rate
                    * if least <= 0.0 {
                        1.0
                    } else if least <= smallest {
                        any
                    } else {
                        // At 0 there is no loss, although a part of a shared one.
                        let from = (least / step - slack).ceil().max(1.0) as usize;
                        at_least.get(from).copied().unwrap_or(0.0)
                    };
            }
        }
    }
    losses
        .iter()
        .zip(rates)
        .map(|(&loss, annual_rate)| LossPoint { loss, annual_rate })
        .collect()
}

/// The steps of lattices, from coarse to fine, until the least loss that is asked for has enough of
/// them or a lattice is exact, and how far below itself a loss counts as reached \[steps\].
fn lattices(total: f64, amount: Option<f64>, least: f64, steps: f64) -> Vec<(f64, f64)> {
    let mut step = if total > 0.0 { total / steps } else { 1.0 };
    let mut found = Vec::new();
    loop {
        if let Some(amount) = amount.filter(|amount| step <= *amount) {
            found.push((amount, ROUNDING));
            return found;
        }
        found.push((step, SHARED));
        if FINER * least >= steps * step || found.len() == MAX_LATTICES {
            let exact = amount.filter(|amount| least <= steps * amount);
            found.extend(exact.map(|amount| (amount, ROUNDING)));
            return found;
        }
        step /= FINER;
    }
}

/// The probability that any object has a loss, 1 − Π P(no loss), and the smallest loss that is
/// possible.
fn any_loss(objects: &[LossShares]) -> (f64, f64) {
    let losses = |object: &LossShares| {
        object
            .iter()
            .copied()
            .filter(|share| share.0 > 0.0)
            .collect::<Vec<_>>()
    };
    let none: f64 = objects
        .iter()
        .map(|object| {
            (-losses(object)
                .iter()
                .map(|share| share.1)
                .sum::<f64>()
                .min(1.0))
            .ln_1p()
        })
        .sum();
    let possible = objects
        .iter()
        .flat_map(losses)
        .filter(|share| share.1 > 0.0);
    (
        -none.exp_m1(),
        possible.map(|share| share.0).fold(f64::INFINITY, f64::min),
    )
}

/// The largest amount of which all losses are multiples; `None` if one of them is not a whole
/// number of hundredths.
fn common_amount(losses: impl Iterator<Item = f64>) -> Option<f64> {
    let mut common = 0;
    for loss in losses {
        let hundredths = (HUNDREDTHS * loss).round();
        // Above 2⁵³ hundredths an f64 no longer distinguishes single hundredths.
        let is_whole = hundredths < 9e15
            && (HUNDREDTHS * loss - hundredths).abs() <= 1e-9 * hundredths.max(1.0);
        let (mut a, mut b) = (is_whole.then_some(hundredths as u64)?, common);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        common = a;
    }
    (common > 0).then_some(common as f64 / HUNDREDTHS)
}

/// The probability of each number of steps that the losses of all objects add up to; the last
/// number, `most`, stands for all above it too.
fn sum_of(objects: &[LossShares], step: f64, most: usize) -> Vec<f64> {
    let mut sum = vec![1.0];
    for object in objects {
        // The whole steps of a loss, the rest as a share of a step, and the probability.
        let places: Vec<(usize, f64, f64)> = object
            .iter()
            .map(|&(loss, p)| {
                let whole = (loss / step + 1e-6).floor();
                (
                    (whole as usize).min(most),
                    (loss / step - whole).max(0.0),
                    p,
                )
            })
            .collect();
        let longest = places.iter().map(|place| place.0).max().unwrap_or(0);
        let mut next = vec![0.0; (sum.len() + longest + 1).min(most + 1)];
        let mut add = |shift: usize, p: f64| {
            if p == 0.0 {
                return;
            }
            let (within, beyond) = sum.split_at(sum.len().min(most - shift.min(most)));
            for (to, before) in next.iter_mut().skip(shift).zip(within) {
                *to += before * p;
            }
            if let (Some(last), false) = (next.get_mut(most), beyond.is_empty()) {
                *last += p * beyond.iter().sum::<f64>();
            }
        };
        for (whole, rest, p) in places {
            add(whole, p * (1.0 - rest));
            add(whole + 1, p * rest);
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
        of.iter()
            .map(|&(annual_rate, loss)| World { annual_rate, loss })
            .collect()
    }

    /// Two equal objects under common motions: the same rates at twice the losses.
    #[test]
    fn two_equal_objects_lose_twice_as_much() {
        let one = worlds(&[
            (0.01, 0.0),
            (0.002, 1000.0),
            (0.001, 5000.0),
            (0.003, 1000.0),
        ]);
        let two: Vec<World> = one
            .iter()
            .map(|world| World {
                loss: 2.0 * world.loss,
                ..*world
            })
            .collect();
        let (curve, double) = (loss_exceedance(&one), loss_exceedance(&two));
        assert_eq!(curve.len(), 2);
        for (a, b) in curve.iter().zip(&double) {
            assert_eq!((2.0 * a.loss, a.annual_rate), (b.loss, b.annual_rate));
        }
        assert_eq!(
            expected_loss_per_year(&two),
            2.0 * expected_loss_per_year(&one)
        );
        assert_eq!(loss_at_return_period(&curve, 100.0), 0.0);
        assert_eq!(
            (
                loss_at_return_period(&curve, 200.0),
                loss_at_return_period(&curve, 1001.0)
            ),
            (1000.0, 5000.0)
        );
    }

    /// The area under the curve is the expected loss.
    #[test]
    fn the_curve_and_the_expected_loss_agree() {
        let all = worlds(&[
            (0.01, 3.0),
            (0.002, 10.0),
            (0.001, 50.0),
            (0.003, 11.0),
            (0.2, 0.0),
        ]);
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
            vec![
                (0.0, 0.9 - 0.02 * i as f64),
                (repair, 0.06 + 0.01 * i as f64),
                (all, 0.04 + 0.01 * i as f64),
            ]
        };
        let objects: Vec<LossShares> = (0..14).map(object).collect();
        let total: f64 = objects.iter().map(|object| object[2].0).sum();
        let p = |share: usize| {
            objects
                .iter()
                .map(|object| object[share].1)
                .product::<f64>()
        };
        let curve = independent_loss_exceedance(&[(0.02, objects.clone())], &[10.0, total]);
        assert!((curve[0].annual_rate / (0.02 * (1.0 - p(0))) - 1.0).abs() < 1e-12);
        assert!((curve[1].annual_rate / (0.02 * p(2)) - 1.0).abs() < 1e-12);

        let few = &objects[..7];
        let mut sums: LossShares = vec![(0.0, 1.0)];
        for object in few {
            sums = sums
                .iter()
                .flat_map(|&(loss, p)| object.iter().map(move |&(more, q)| (loss + more, p * q)))
                .collect();
        }
        let losses: Vec<f64> = sums
            .iter()
            .map(|sum| sum.0)
            .filter(|loss| *loss > 0.0)
            .collect();
        for point in independent_loss_exceedance(&[(1.0, few.to_vec())], &losses) {
            let expected: f64 = sums
                .iter()
                .filter(|sum| sum.0 >= point.loss)
                .map(|sum| sum.1)
                .sum();
            assert!(
                (point.annual_rate - expected).abs() < 1e-13,
                "{point:?} {expected}"
            );
        }
    }

    /// Twenty objects with losses √2, 2√2, 4√2 … have a million sums and no common amount.
    #[test]
    fn losses_without_a_common_amount_are_shared_between_steps() {
        let unit = 2.0_f64.sqrt();
        let objects: Vec<LossShares> = (0..20)
            .map(|i| vec![(0.0, 0.5), (unit * f64::from(1 << i), 0.5)])
            .collect();
        let losses: Vec<f64> = (1..=1024).map(|i| unit * f64::from(i * 1024)).collect();
        // The sums are uniform from 0 to (2²⁰ − 1)√2; with 131,072 steps, twenty objects are off by
        // at most ten of them.
        for point in independent_loss_exceedance(&[(1.0, objects)], &losses) {
            let expected = 1.0 - point.loss / unit / f64::from(1 << 20);
            assert!(
                (point.annual_rate - expected).abs() < 10.0 / MAX_STEPS,
                "{point:?} {expected}"
            );
        }
    }

    /// A small loss beside a total of 10⁷√2 is far below a step of the lattice: worlds without any
    /// loss do not count, and the small one is as frequent as it is.
    #[test]
    fn a_loss_below_a_step_is_as_frequent_as_it_is() {
        let large = 1e7 * 2.0_f64.sqrt();
        let objects = vec![
            vec![(0.0, 0.9), (7.0, 0.1)],
            vec![(0.0, 0.97), (0.0, 0.01), (large, 0.02)],
        ];
        let curve = independent_loss_exceedance(&[(0.1, objects)], &[0.0, 3.0, 7.0, 0.99 * large]);
        let rates: Vec<f64> = curve.iter().map(|point| point.annual_rate / 0.1).collect();
        let any = 1.0 - 0.9 * 0.98;
        // Sums of three numbers below 1.
        assert!((rates[0] - 1.0).abs() < 1e-15, "{rates:?}");
        assert!(
            (rates[1] - any).abs() < 1e-14 && (rates[2] - any).abs() < 1e-14,
            "{rates:?}"
        );
        assert!((rates[3] - 0.02).abs() < 1e-14, "{rates:?}");
    }

    /// Many objects whose repair costs 1 % of their replacement, with a repair of a fifth of a step
    /// of the coarsest lattice, and not a whole number of cents: the rates of one repair, of up to
    /// six, and of a replacement.
    #[test]
    fn repairs_of_many_objects_are_counted() {
        let repair = 3.0_f64.sqrt();
        let count = 200;
        let p = |level: i32| (2e-3 * f64::from(level), 1e-5 * f64::from(level));
        let of = |level: i32| {
            let (repaired, lost) = p(level);
            let object = vec![
                (0.0, 1.0 - repaired - lost),
                (repair, repaired),
                (100.0 * repair, lost),
            ];
            (0.3_f64.powi(level), vec![object; count as usize])
        };
        let levels: Vec<(f64, Vec<LossShares>)> = (1..=3).map(of).collect();
        let asked: Vec<f64> = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 100.0]
            .map(|repairs| repairs * repair)
            .to_vec();
        let curve = on_lattices(&levels, &asked, MIN_STEPS);
        for (point, repairs) in curve.iter().zip([1, 2, 3, 4, 5, 6, 100]) {
            // Fewer repairs than these, and no replacement; the tails of 100 repairs vanish.
            let at = |level: i32| {
                let (repaired, lost) = p(level);
                let none = (1.0 - repaired - lost).powi(count);
                let odds = repaired / (1.0 - repaired - lost);
                let next = |(term, sum): (f64, f64), i: i32| {
                    let term = term * odds * f64::from(count - i + 1) / f64::from(i);
                    (term, sum + term)
                };
                0.3_f64.powi(level) * (1.0 - (1..repairs).fold((none, none), next).1)
            };
            let expected: f64 = (1..=3).map(at).sum();
            // A repair is 838.86 steps of the finest lattice: 0.14⁴ = 4e-4 of four of them is four
            // steps below.
            assert!(
                (point.annual_rate / expected - 1.0).abs() < 1e-3,
                "{repairs}: {point:?} {expected}"
            );
        }
        assert!(
            curve
                .windows(2)
                .all(|pair| pair[1].annual_rate < pair[0].annual_rate)
        );
    }
}
