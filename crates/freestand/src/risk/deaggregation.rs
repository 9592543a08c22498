//! Which motions cause an annual rate: its parts by ranges of intensity.

use super::hazard::{Hazard, HazardPoint};
use super::rate::{annual_rate, at_first, probability, segment, whole};
use crate::fragility::{CurveKind, normal_ratio};

/// What a range of intensities contributes to an annual rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bin {
    /// From this intensity; 0 for the first bin.
    pub low: f64,
    /// Up to this one; `None` for the last bin.
    pub high: Option<f64>,
    /// Its part of the annual rate \[1/year\].
    pub annual_rate: f64,
    /// Its share of the annual rate.
    pub share: f64,
}

/// Number of bins of a deaggregation.
const BINS: usize = 24;

/// Which intensities contribute to an annual rate: ∫ Φ |dλ| in 24 bins, evenly spaced in ln x over
/// the hazard; of a power law over ±4 β (at least a factor of e) about the centre of the
/// contributions, θ exp(−kβ²). Empty where no rate is known.
///
/// # Accuracy
/// The bins sum to the annual rate within 1e-12 of it.
pub fn deaggregation(hazard: &Hazard, curve: CurveKind) -> Vec<Bin> {
    let Some(total) = annual_rate(hazard, curve).annual_rate else {
        return Vec::new();
    };
    let (Some(median), beta) = (curve.median(), curve.beta().unwrap_or(0.0)) else {
        return Vec::new();
    };
    let (from, to) = match hazard {
        Hazard::Points(points) => {
            let of = |point: Option<&HazardPoint>| point.map_or(median, |point| point.intensity);
            (of(points.first()), of(points.last()))
        }
        Hazard::PowerLaw { exponent, .. } => {
            let (centre, reach) = (
                median * (-exponent * beta * beta).exp(),
                (4.0 * beta).max(1.0).exp(),
            );
            (centre / reach, centre * reach)
        }
    };
    let edge = |i: usize| from * (to / from).powf(i as f64 / BINS as f64);
    let below: Vec<f64> = (1..BINS)
        .map(|i| rate_below(hazard, edge(i), median, beta))
        .chain([total])
        .collect();
    let mut last = 0.0;
    let bin = |(i, upto): (usize, f64)| {
        let annual_rate = upto - last;
        last = upto;
        let share = if total > 0.0 {
            annual_rate / total
        } else {
            0.0
        };
        let low = if i == 0 { 0.0 } else { edge(i) };
        Bin {
            low,
            high: (i + 1 < BINS).then(|| edge(i + 1)),
            annual_rate,
            share,
        }
    };
    below.into_iter().enumerate().map(bin).collect()
}

/// The part of an annual rate that motions up to an intensity cause, ∫ P |dλ|; `None` where no curve is
/// known.
pub fn annual_rate_below(hazard: &Hazard, curve: CurveKind, upto: f64) -> Option<f64> {
    let rates = annual_rate(hazard, curve);
    let (median, beta) = (curve.median()?, curve.beta().unwrap_or(0.0));
    let is_beyond = matches!(hazard, Hazard::Points(points) if points.last().is_some_and(|last| last.intensity < upto));
    if is_beyond {
        rates.annual_rate
    } else {
        rates
            .annual_rate
            .map(|_| rate_below(hazard, upto, median, beta))
    }
}

/// ∫ Φ |dλ| up to an intensity within the hazard.
pub(super) fn rate_below(hazard: &Hazard, upto: f64, median: f64, beta: f64) -> f64 {
    let here = hazard.annual_rate(upto) * probability(upto, median, beta);
    match hazard {
        Hazard::PowerLaw { exponent, .. } => {
            let shift = exponent * beta;
            let all = whole(hazard.annual_rate(median), shift);
            // A step contributes from its median on.
            let share = if beta > 0.0 {
                normal_ratio((upto / median).ln() / beta + shift)
            } else {
                probability(upto, median, beta)
            };
            (all * share - here).max(0.0)
        }
        Hazard::Points(points) => {
            // [−λΦ] and ∫ λ dΦ of the segments, the last one cut at `upto`.
            let first = at_first(points, median, beta);
            let cut = HazardPoint {
                intensity: upto,
                annual_rate: hazard.annual_rate(upto),
            };
            let upto_cut = points
                .windows(2)
                .filter(|pair| pair[0].intensity < upto)
                .map(|pair| {
                    let high = if pair[1].intensity > upto {
                        cut
                    } else {
                        pair[1]
                    };
                    segment(pair[0], high, median, beta)
                });
            (first + upto_cut.sum::<f64>() - here).max(0.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integration::unit_integral;
    use crate::risk::rate::tests::{CURVE, lognormal, points};

    #[test]
    fn bins_sum_to_the_rate() {
        let law = Hazard::power_law(1e-4, 1.0, 2.5).unwrap();
        let step = CurveKind::Step {
            lower: 0.4,
            upper: 0.4,
        };
        for hazard in [points(&CURVE), law] {
            for curve in [lognormal(0.2, 0.4), lognormal(0.05, 0.1), step] {
                let bins = deaggregation(&hazard, curve);
                let rate = annual_rate(&hazard, curve).annual_rate.unwrap();
                assert_eq!((bins.len(), bins[0].low, bins[23].high), (24, 0.0, None));
                assert!(
                    bins.windows(2)
                        .all(|pair| pair[0].high == Some(pair[1].low))
                );
                assert!(bins.iter().all(|bin| bin.annual_rate >= 0.0), "{bins:?}");
                let sum: f64 = bins.iter().map(|bin| bin.annual_rate).sum();
                let shares: f64 = bins.iter().map(|bin| bin.share).sum();
                assert!(
                    (sum / rate - 1.0).abs() < 1e-12 && (shares - 1.0).abs() < 1e-12,
                    "{sum} {rate}"
                );
            }
        }
        assert!(deaggregation(&points(&CURVE), CurveKind::None { lower: 1.0 }).is_empty());
    }

    /// The density of ln x among the contributions of a power law is normal about ln θ − kβ², less
    /// what the hazard itself takes: by quadrature.
    #[test]
    fn bins_of_a_power_law_are_integrals() {
        let (median, beta, exponent) = (0.5, 0.25, 2.5);
        let law = Hazard::power_law(1e-4, 1.0, exponent).unwrap();
        for bin in deaggregation(&law, lognormal(median, beta))
            .into_iter()
            .skip(1)
        {
            let Some(high) = bin.high else { continue };
            let (from, to) = (bin.low.ln(), high.ln());
            let at = |share: f64| {
                let log = from + share * (to - from);
                normal_ratio((log - median.ln()) / beta) * exponent * law.annual_rate(log.exp())
            };
            let expected = (to - from) * unit_integral(at);
            assert!(
                (bin.annual_rate - expected).abs() < 1e-14,
                "{bin:?} {expected}"
            );
        }
    }
}
