//! Numbers of an object over its worlds (quantiles and shares), and what has the same worlds together.

use crate::result::Ranked;
use freestand_study::statistics::{QUANTILES, ranked_quantile};

/// Quantiles of values over the worlds.
pub(super) fn quantiles(values: impl Iterator<Item = f64>) -> [Ranked; 3] {
    let mut values: Vec<f64> = values.collect();
    QUANTILES.map(|q| ranked_quantile(&mut values, q))
}

/// One quantile; 0 without values, +∞ where it overturns.
pub(super) fn quantile(values: impl Iterator<Item = f64>, q: f64) -> f64 {
    let mut values: Vec<f64> = values.collect();
    match ranked_quantile(&mut values, q) {
        Ranked::Value(value) => value,
        Ranked::Overturned => f64::INFINITY,
        Ranked::NoData => 0.0,
    }
}

/// The share of worlds in which something holds.
pub(super) fn share(values: impl Iterator<Item = bool>) -> f64 {
    let (holds, count) = values.fold((0usize, 0usize), |(holds, count), one| {
        (holds + usize::from(one), count + 1)
    });
    holds as f64 / count.max(1) as f64
}

/// What belongs to each key, in the order of their first appearance.
pub(super) fn grouped<K: PartialEq>(
    items: impl Iterator<Item = (K, usize)>,
) -> Vec<(K, Vec<usize>)> {
    let mut groups: Vec<(K, Vec<usize>)> = Vec::new();
    for (key, place) in items {
        match groups.iter_mut().find(|(other, _)| *other == key) {
            Some((_, places)) => places.push(place),
            None => groups.push((key, vec![place])),
        }
    }
    groups
}
