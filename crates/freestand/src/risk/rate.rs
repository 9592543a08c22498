//! The annual rate of a limit state: its fragility, integrated over the hazard.

use std::f64::consts::TAU;

use crate::fragility::{CurveKind, normal_ratio};

use super::hazard::{Hazard, HazardPoint, Tail, exponent_between, last_exponent};

/// How often a limit state is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnnualRates {
    /// Mean number of times per year, if the last segment of the hazard goes on above its last point;
    /// `None` where no curve is known.
    pub annual_rate: Option<f64>,
    /// What motions between the first and the last point of the hazard, and below the first, add to
    /// it; `None` where no curve is known.
    pub annual_rate_in_table: Option<f64>,
    /// Its lower bound, also where no curve is known and whatever happens above the last point.
    pub annual_rate_lower: f64,
    /// Its upper bound, whatever happens above the last point of the hazard; `None` where there is
    /// no bound.
    pub annual_rate_upper: Option<f64>,
    /// What motions below the first point of the hazard would add if λ continued there as in its
    /// first segment. It is not included in any of the rates.
    pub below_first: f64,
}

impl AnnualRates {
    /// If motions below the first point of the hazard add less than this share of a rate, they are
    /// ignored.
    const SMALL: f64 = 0.01;

    /// Above this ratio of the upper to the lower end, a rate is only known between its ends.
    const BOUND_RATIO: f64 = 1.1;

    /// Whether only bounds of the rate are known: the upper one is more than 10 % above the lower one,
    /// or there is none.
    pub fn is_bound(&self) -> bool {
        self.annual_rate.is_none()
            || self.begins_too_high()
            || self
                .annual_rate_upper
                .is_none_or(|upper| upper > Self::BOUND_RATIO * self.annual_rate_lower)
    }

    /// Whether the stated rate is the least that it can be.
    pub fn is_at_least(&self) -> bool {
        match self.annual_rate {
            Some(_) => self.begins_too_high() || self.annual_rate_upper.is_none(),
            None => self.annual_rate_lower > 0.0 || self.annual_rate_upper.is_none(),
        }
    }

    /// Whether the stated rate is the most that it can be: nothing else is known.
    pub fn is_at_most(&self) -> bool {
        self.annual_rate.is_none() && !self.is_at_least()
    }

    /// The most that the rate can be, which is compared with an accepted one; `None` where nothing bounds it.
    pub fn most(&self) -> Option<f64> {
        self.annual_rate_upper.map(|rate| rate + self.below_first)
    }

    /// The upper bound of the rate as it is told: none where motions below the first point of the hazard add to it.
    pub fn told_upper(&self) -> Option<f64> {
        self.annual_rate_upper.filter(|_| !self.begins_too_high())
    }

    /// Extends the bounds to `lower` and `upper`.
    pub fn widened(self, lower: f64, upper: Option<f64>) -> Self {
        Self {
            annual_rate_lower: self.annual_rate_lower.min(lower),
            annual_rate_upper: self.annual_rate_upper.zip(upper).map(|(a, b)| a.max(b)),
            ..self
        }
    }

    /// Whether the hazard begins too high for this limit state, so that the rate is only a lower
    /// bound.
    pub fn begins_too_high(&self) -> bool {
        self.annual_rate
            .is_some_and(|rate| self.below_first > Self::SMALL * rate)
    }
}

/// The annual rate of a limit state, ∫ P(limit state | x) |dλ(x)|.
///
/// With λ = aᵢ x^−kᵢ between the points xᵢ of the hazard and u = ln(x/θ)/β,
///
/// λ_f = λ(x₁)Φ(u₁) + Σ aᵢ θ^−kᵢ exp(kᵢ²β²/2) \[Φ(uᵢ₊₁ + kᵢβ) − Φ(uᵢ + kᵢβ)\].
///
/// Beyond the last point xₙ the last segment goes on, the term i = n with uₙ₊₁ = ∞.
/// `annual_rate_in_table` is the part of the motions up to xₙ. `annual_rate_lower` counts those beyond
/// it with λ(xₙ)Φ(uₙ), the least they can add, and `annual_rate_upper` with λ(xₙ), the most. Nothing is
/// assumed below x₁. `below_first` is what is left out there if the first segment continues, which is an upper bound where the hazard curve
/// flattens towards weak motions:
///
/// a₁ θ^−k₁ exp(k₁²β²/2) Φ(u₁ + k₁β) − λ(x₁)Φ(u₁).
///
/// For a power law without ends the rate is λ_f = k₀ (θ/reference)^−k exp(k²β²/2). A step counts as
/// β = 0 in the middle of its ends, and is at least the rate of the upper one and at most that of the
/// lower one. If a limit state was never reached up to some intensity, the rate is not known, but is
/// at most the rate of that intensity; if it was always reached from some intensity on, it is at least
/// that rate.
///
/// # Reference
/// Cornell, C. A., Jalayer, F., Hamburger, R. O. and Foutch, D. A. (2002). Probabilistic basis for
/// 2000 SAC FEMA steel moment frame guidelines. Journal of Structural Engineering 128, 526–533,
/// Eq. (7), here exact between the points.
///
/// # Accuracy
/// 1e-12 of the rate.
///
/// # Example
/// k = 2 and β = 0.5: e^{4·0.25/2} = 1.6487 times the rate of the median.
/// ```
/// use freestand::fragility::CurveKind;
/// use freestand::risk::{Hazard, annual_rate};
/// let hazard = Hazard::power_law(1e-4, 1.0, 2.0)?;
/// let rates = annual_rate(&hazard, CurveKind::Lognormal { median: 0.5, beta: 0.5 });
/// assert!((rates.annual_rate.unwrap() / (4e-4 * 0.5_f64.exp()) - 1.0).abs() < 1e-12);
/// # Ok::<(), freestand::risk::HazardError>(())
/// ```
pub fn annual_rate(hazard: &Hazard, curve: CurveKind) -> AnnualRates {
    let least = |upper: Option<f64>| {
        upper.map_or(0.0, |upper| hazard.annual_rate_with(upper, Tail::Absent))
    };
    let ends = match curve {
        CurveKind::Lognormal { .. } => None,
        CurveKind::Step { lower, upper } => Some((lower, upper)),
        CurveKind::None { lower } => return unknown(0.0, most(hazard, lower)),
        CurveKind::Bounds { lower, upper } => {
            return unknown(least(upper), lower.and_then(|lower| most(hazard, lower)));
        }
        CurveKind::All { upper } => return unknown(least(Some(upper)), None),
        CurveKind::NotIncreasing { .. } => return unknown(0.0, None),
    };
    let (Some(median), beta) = (curve.median(), curve.beta().unwrap_or(0.0)) else {
        return unknown(0.0, None);
    };
    let (parts, below_first) = match hazard {
        Hazard::PowerLaw { exponent, .. } => {
            let rate = whole(hazard.annual_rate(median), exponent * beta);
            (
                Parts {
                    least: rate,
                    in_table: rate,
                    tail: 0.0,
                    most: rate,
                },
                0.0,
            )
        }
        Hazard::Points(points) => {
            let below = points
                .first_chunk()
                .map_or(0.0, |pair| below_first(pair, median, beta));
            (Parts::of(points, median, beta), below)
        }
    };
    AnnualRates {
        annual_rate: Some(parts.least + parts.tail),
        annual_rate_in_table: Some(parts.in_table),
        annual_rate_lower: ends.map_or(parts.least, |(_, to)| parts.least.min(least(Some(to)))),
        annual_rate_upper: match ends {
            // If the lower end is below the first point, the rate has no upper bound.
            Some((from, _)) => most(hazard, from).map(|most| most.max(parts.most)),
            None => Some(parts.most),
        },
        below_first,
    }
}

/// The parts of a rate over points \[1/year\].
struct Parts {
    /// Motions above the last point count with the probability there.
    least: f64,
    /// They do not count.
    in_table: f64,
    /// What they add to `least` if the last segment goes on.
    tail: f64,
    /// They all count.
    most: f64,
}

impl Parts {
    fn of(points: &[HazardPoint], median: f64, beta: f64) -> Self {
        let between: f64 = points
            .windows(2)
            .map(|pair| segment(pair[0], pair[1], median, beta))
            .sum();
        let least = at_first(points, median, beta) + between;
        let Some(&last) = points.last() else {
            return Self {
                least,
                in_table: least,
                tail: 0.0,
                most: least,
            };
        };
        let at_last = last.annual_rate * probability(last.intensity, median, beta);
        Self {
            least,
            in_table: (least - at_last).max(0.0),
            tail: above_last(last, last_exponent(points), median, beta),
            most: least + (last.annual_rate - at_last),
        }
    }
}

/// ∫ λ dΦ from a point up, λ = λₙ (x/xₙ)^−k: λₙ exp(kβuₙ + k²β²/2) \[1 − Φ(wₙ)\] with w = u + kβ.
fn above_last(last: HazardPoint, exponent: f64, median: f64, beta: f64) -> f64 {
    if beta == 0.0 {
        let is_above = median > last.intensity;
        return if is_above {
            last.annual_rate * (median / last.intensity).powf(-exponent)
        } else {
            0.0
        };
    }
    let (u, shift) = ((last.intensity / median).ln() / beta, exponent * beta);
    let w = u + shift;
    // As in `segment`: the factor may overflow where the tail vanishes.
    let share = if w > 0.0 {
        density(u) * tail_ratio(w)
    } else {
        (shift * (u + 0.5 * shift)).exp() * normal_ratio(-w)
    };
    last.annual_rate * share
}

fn unknown(annual_rate_lower: f64, annual_rate_upper: Option<f64>) -> AnnualRates {
    AnnualRates {
        annual_rate: None,
        annual_rate_in_table: None,
        annual_rate_lower,
        annual_rate_upper,
        below_first: 0.0,
    }
}

/// The upper bound of the rate of a limit state that is never reached up to an intensity; `None` if
/// the hazard begins above that intensity.
fn most(hazard: &Hazard, lower: f64) -> Option<f64> {
    let first = match hazard {
        Hazard::Points(points) => points.first()?.intensity,
        Hazard::PowerLaw { .. } => 0.0,
    };
    (first <= lower).then(|| hazard.annual_rate_with(lower, Tail::Level))
}

/// ∫ Φ |dλ| of a power law without ends, λ(θ) exp(k²β²/2), with kβ.
pub(super) fn whole(rate_of_median: f64, spread: f64) -> f64 {
    rate_of_median * (0.5 * spread * spread).exp()
}

/// λ(x₁)Φ(u₁), the first term of the rate.
pub(super) fn at_first(points: &[HazardPoint], median: f64, beta: f64) -> f64 {
    points.first().map_or(0.0, |point| {
        point.annual_rate * probability(point.intensity, median, beta)
    })
}

/// ∫ Φ |dλ| up to x₁ if the first segment continues below it: [−λΦ] and ∫ λ dΦ.
fn below_first([low, high]: &[HazardPoint; 2], median: f64, beta: f64) -> f64 {
    let exponent = exponent_between(*low, *high);
    if beta == 0.0 {
        let at_median = low.annual_rate * (median / low.intensity).powf(-exponent);
        return if median < low.intensity {
            at_median - low.annual_rate
        } else {
            0.0
        };
    }
    let u = (low.intensity / median).ln() / beta;
    let w = u + exponent * beta;
    // The factor overflows where the tail vanishes. Written as φ(u)/φ(w), the factor cancels the
    // tail.
    let through = if w < 0.0 {
        density(u) * tail_ratio(-w)
    } else {
        (exponent * beta * (u + 0.5 * exponent * beta)).exp() * normal_ratio(w)
    };
    (low.annual_rate * (through - normal_ratio(u))).max(0.0)
}

/// Φ(ln(x/θ)/β); with β = 0 a jump at θ.
pub(super) fn probability(x: f64, median: f64, beta: f64) -> f64 {
    if beta > 0.0 {
        normal_ratio((x / median).ln() / beta)
    } else {
        f64::from(u8::from(x >= median))
    }
}

/// ∫ λ dΦ between two points, λ = λ₁ (x/x₁)^−k:
/// λ₁ exp(kβu₁ + k²β²/2) \[Φ(w₂) − Φ(w₁)\] with w = u + kβ.
pub(super) fn segment(low: HazardPoint, high: HazardPoint, median: f64, beta: f64) -> f64 {
    let exponent = exponent_between(low, high);
    if beta == 0.0 {
        let is_within = low.intensity < median && median <= high.intensity;
        let rate = low.annual_rate * (median / low.intensity).powf(-exponent);
        return if is_within { rate } else { 0.0 };
    }
    let of = |point: HazardPoint| (point.intensity / median).ln() / beta;
    let (u1, u2) = (of(low), of(high));
    let shift = exponent * beta;
    let (w1, w2) = (u1 + shift, u2 + shift);
    // The factor overflows where the hazard falls steeply and w is large; written as
    // φ(u₁)/φ(w₁), it cancels with the tails.
    if w1 > 0.0 {
        let fall = (-0.5 * (w2 - w1) * (w2 + w1)).exp();
        return low.annual_rate * density(u1) * (tail_ratio(w1) - tail_ratio(w2) * fall);
    }
    let factor = (shift * (u1 + 0.5 * shift)).exp();
    let share = if w2 > 0.0 {
        1.0 - normal_ratio(-w2) - normal_ratio(w1)
    } else {
        normal_ratio(w2) - normal_ratio(w1)
    };
    low.annual_rate * factor * share
}

fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}

/// Mills' ratio (1 − Φ(z))/φ(z) for z > 0; above 8 by its continued fraction 1/(z + 1/(z + 2/(z +
/// 3/(z + …)))), whose 30 terms are exact to rounding there.
fn tail_ratio(z: f64) -> f64 {
    if z < 8.0 {
        return normal_ratio(-z) / density(z);
    }
    let fraction = (1..=30).rev().fold(z, |below, i| z + f64::from(i) / below);
    1.0 / fraction
}

/// Probability of at least one event within a number of years, 1 − e^(−λ·years).
///
/// # Example
/// ```
/// assert!((freestand::risk::probability_in_years(1.0 / 475.0, 50.0) - 0.1).abs() < 1e-3);
/// ```
pub fn probability_in_years(annual_rate: f64, years: f64) -> f64 {
    -(-annual_rate * years).exp_m1()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::fragility::draw_stream;
    use crate::integration::unit_integral;
    use crate::risk::deaggregation::rate_below;
    use rand::RngExt;

    pub(in crate::risk) fn lognormal(median: f64, beta: f64) -> CurveKind {
        CurveKind::Lognormal { median, beta }
    }

    pub(in crate::risk) fn points(of: &[(f64, f64)]) -> Hazard {
        Hazard::points(
            of.iter()
                .map(|&(intensity, annual_rate)| HazardPoint {
                    intensity,
                    annual_rate,
                })
                .collect(),
        )
        .unwrap()
    }

    /// ∫ Φ |dλ| by quadrature in ln x, split at θ·e^{±β…} so that steep curves are resolved. Beyond the
    /// last point the last segment goes on until 1e-16 of it is left.
    fn by_quadrature(points: &[(f64, f64)], median: f64, beta: f64, upto: f64) -> f64 {
        let mut of = points.to_vec();
        let [low, high] = [points[points.len() - 2], points[points.len() - 1]];
        let exponent = (low.1 / high.1).ln() / (high.0 / low.0).ln();
        let beyond = (37.0 / exponent)
            .max((median / high.0).ln().max(0.0) + 10.0 * beta)
            .min(600.0);
        of.push((
            high.0 * beyond.exp(),
            high.1 * (-exponent * beyond).exp().max(1e-300),
        ));
        let phi = |log: f64| normal_ratio((log - median.ln()) / beta);
        let mut sum = 0.0;
        for pair in of.windows(2) {
            let (from, to) = (pair[0].0.ln(), pair[1].0.min(upto).ln());
            if to <= from {
                continue;
            }
            let exponent = (pair[0].1 / pair[1].1).ln() / (pair[1].0 / pair[0].0).ln();
            let mut cuts: Vec<f64> = (-80..=80)
                .map(|i| median.ln() + f64::from(i) * 0.1 * beta)
                .collect();
            cuts.retain(|cut| *cut > from && *cut < to);
            cuts.insert(0, from);
            cuts.push(to);
            for cut in cuts.windows(2).filter(|cut| cut[1] > cut[0]) {
                let at = |share: f64| {
                    let log = cut[0] + share * (cut[1] - cut[0]);
                    phi(log) * exponent * pair[0].1 * (-exponent * (log - from)).exp()
                };
                sum += (cut[1] - cut[0]) * unit_integral(at);
            }
        }
        let last = of[of.len() - 1];
        // What is left at the end.
        if upto >= last.0 {
            sum + last.1 * phi(last.0.ln())
        } else {
            sum
        }
    }

    pub(in crate::risk) const CURVE: [(f64, f64); 6] = [
        (0.01, 0.2),
        (0.05, 0.02),
        (0.1, 6e-3),
        (0.3, 6e-4),
        (0.31, 1e-4),
        (1.2, 1e-6),
    ];

    /// 1e-9 is asked; both agree to 1e-11 where the quadrature has 1e-12.
    #[test]
    fn an_annual_rate_is_the_integral() {
        let hazard = points(&CURVE);
        for median in [0.003, 0.05, 0.2, 0.305, 0.8, 3.0, 20.0] {
            for beta in [0.01, 0.05, 0.25, 0.6, 1.5] {
                let rate = annual_rate(&hazard, lognormal(median, beta))
                    .annual_rate
                    .unwrap();
                let expected = by_quadrature(&CURVE, median, beta, f64::INFINITY);
                assert!(
                    (rate - expected).abs() <= 1e-11 * expected + 1e-300,
                    "{median} {beta}: {rate} {expected}"
                );
                for upto in [0.02, 0.2, 0.305, 1.0] {
                    let part = rate_below(&hazard, upto, median, beta);
                    let expected = by_quadrature(&CURVE, median, beta, upto);
                    // The rounding of a difference of two numbers of the size of the rate.
                    assert!(
                        (part - expected).abs() <= 1e-11 * rate,
                        "{median} {beta} {upto}: {part} {expected}"
                    );
                }
            }
        }
    }

    /// The rate below the first point is the difference from a hazard that has another, lower
    /// point.
    #[test]
    fn what_is_below_the_first_point_is_the_integral() {
        let exponent = (CURVE[0].1 / CURVE[1].1).ln() / (CURVE[1].0 / CURVE[0].0).ln();
        // Intensities below 1e-12 contribute less than 1e-12 of any of these rates.
        let longer: Vec<(f64, f64)> = std::iter::once((1e-12, 0.2 * 1e10_f64.powf(exponent)))
            .chain(CURVE.iter().copied())
            .collect();
        for (median, beta) in [
            (0.003, 0.05),
            (0.003, 0.6),
            (0.02, 0.4),
            (0.05, 0.25),
            (0.2, 0.6),
            (0.8, 0.05),
        ] {
            let short = annual_rate(&points(&CURVE), lognormal(median, beta));
            let long = annual_rate(&points(&longer), lognormal(median, beta));
            let missing = long.annual_rate.unwrap() - short.annual_rate.unwrap();
            // The rounding of a difference of two numbers of the size of the rate.
            assert!(
                (short.below_first - missing).abs() <= 1e-11 * long.annual_rate.unwrap(),
                "{median} {beta}: {short:?} {missing}"
            );
            assert_eq!(
                short.begins_too_high(),
                median < 0.01 || beta == 0.4,
                "{median} {beta}: {short:?}"
            );
        }
    }

    /// Curves of two to eight points, with segments from almost level (k = 0.05) to steep (k = 40),
    /// and rates from 1e-12 to 30 a year: the sum over the segments loses no digits in any of them.
    #[test]
    fn an_annual_rate_is_the_integral_for_any_curve() {
        for sample in 0..60 {
            let mut random = draw_stream(5, sample, 0, 0);
            let mut between = |low: f64, high: f64| low * (high / low).powf(random.random::<f64>());
            let mut at = (between(1e-3, 1.0), between(1e-3, 30.0));
            let mut curve = vec![at];
            for _ in 0..=sample % 7 {
                let step = between(1.01, 3.0);
                at = (at.0 * step, at.1 * step.powf(-between(0.05, 40.0)));
                if at.1 > 1e-12 {
                    curve.push(at);
                }
            }
            if curve.len() < 2 {
                continue;
            }
            let (median, beta) = (between(1e-3, 3.0), between(0.02, 1.5));
            let rate = annual_rate(&points(&curve), lognormal(median, beta))
                .annual_rate
                .unwrap();
            let expected = by_quadrature(&curve, median, beta, f64::INFINITY);
            assert!(
                (rate - expected).abs() <= 1e-10 * expected + 1e-300,
                "{curve:?} {median} {beta}: {rate} {expected}"
            );
        }
    }

    /// A curve of which most of the rate is above the last point of the hazard: the parts by the
    /// trapezoidal rule over 2·10⁵ steps of ln x, which is good to 1e-9 here.
    #[test]
    fn motions_above_the_last_point_are_counted() {
        let of = [
            (0.0264, 0.05),
            (0.066, 0.01),
            (0.132, 0.002),
            (0.2376, 0.0004),
        ];
        let rates = annual_rate(&points(&of), lognormal(0.4, 0.35));
        let exponent = 5.0_f64.ln() / 1.8_f64.ln();
        let steps = 200_000;
        let (from, to) = (0.2376_f64.ln(), 0.2376_f64.ln() + 12.0);
        let width = (to - from) / f64::from(steps);
        let beyond: f64 = (0..=steps)
            .map(|i| {
                let log = from + width * f64::from(i);
                let weight = if i == 0 || i == steps { 0.5 } else { 1.0 };
                let lambda = 4e-4 * (-exponent * (log - from)).exp();
                weight * width * exponent * lambda * normal_ratio((log - 0.4_f64.ln()) / 0.35)
            })
            .sum();
        let in_table = rates.annual_rate_in_table.unwrap();
        let rate = rates.annual_rate.unwrap();
        assert!(
            ((in_table + beyond) / rate - 1.0).abs() < 1e-8,
            "{rates:?} {beyond}"
        );
        assert!(
            (rates.annual_rate_upper.unwrap() - in_table - 4e-4).abs() < 1e-15,
            "{rates:?}"
        );
        // To the three digits of an independent calculation.
        for (found, expected) in [
            (in_table, 1.79e-5),
            (rate, 1.52e-4),
            (in_table + 4e-4, 4.18e-4),
        ] {
            assert!((found / expected - 1.0).abs() < 0.005, "{found} {expected}");
        }
        assert!(rates.annual_rate_lower < rate && rates.is_bound());
    }

    /// Cornell's closed form, and a curve of points so long that its ends do not matter.
    #[test]
    fn a_power_law_is_the_closed_form() {
        let (median, beta, exponent) = (0.5, 0.25, 2.5);
        let expected = 1e-4 * 0.5_f64.powf(-2.5) * (0.5 * (2.5_f64 * 0.25).powi(2)).exp();
        let law = Hazard::power_law(1e-4, 1.0, exponent).unwrap();
        let rates = annual_rate(&law, lognormal(median, beta));
        assert!((rates.annual_rate.unwrap() / expected - 1.0).abs() < 1e-14);
        assert_eq!(rates.annual_rate, rates.annual_rate_upper);
        let of: Vec<(f64, f64)> = (-40..=40)
            .map(|i| 10_f64.powf(f64::from(i) / 10.0))
            .map(|x| (x, law.annual_rate(x)))
            .collect();
        let rates = annual_rate(&points(&of), lognormal(median, beta));
        // Beyond 1e4 there are 1e-14 of the rate.
        assert!((rates.annual_rate.unwrap() / expected - 1.0).abs() < 1e-12);
        assert!((rates.annual_rate_upper.unwrap() / expected - 1.0).abs() < 1e-12);
        // In other units the same.
        let other = Hazard::power_law(1e-4, 100.0, exponent).unwrap();
        let rate = annual_rate(&other, lognormal(100.0 * median, beta))
            .annual_rate
            .unwrap();
        assert!((rate / expected - 1.0).abs() < 1e-13);
    }

    /// A fall of 1e-300 within 1 % is k = 7e4: the factor alone overflows.
    #[test]
    fn a_steep_hazard_does_not_overflow() {
        let of = [(0.1, 1.0), (0.101, 1e-300)];
        for (median, beta) in [(0.1005, 0.3), (0.5, 0.2), (0.01, 1.0)] {
            let rate = annual_rate(&points(&of), lognormal(median, beta))
                .annual_rate
                .unwrap();
            let at_first = normal_ratio((0.1_f64 / median).ln() / beta);
            // The rate is λ(x₁)Φ(u₁), and a little more from the first 1e-5 of the interval.
            assert!(
                rate >= at_first && rate < at_first * 1.001 + 1e-3,
                "{rate} {at_first}"
            );
        }
    }

    #[test]
    fn steps_and_states_without_a_curve() {
        let hazard = points(&CURVE);
        let step = annual_rate(
            &hazard,
            CurveKind::Step {
                lower: 0.05,
                upper: 0.2,
            },
        );
        assert!((step.annual_rate.unwrap() / hazard.annual_rate(0.1) - 1.0).abs() < 1e-14);
        let none = annual_rate(&hazard, CurveKind::None { lower: 0.1 });
        assert_eq!(
            (none.annual_rate, none.annual_rate_upper),
            (None, Some(6e-3))
        );
        let beyond = annual_rate(&hazard, CurveKind::None { lower: 5.0 });
        assert_eq!(
            (beyond.annual_rate, beyond.annual_rate_upper),
            (None, Some(1e-6))
        );
        assert_eq!(
            annual_rate(&hazard, CurveKind::None { lower: 0.001 }).annual_rate_upper,
            None
        );
        assert_eq!(
            annual_rate(&hazard, CurveKind::All { upper: 0.1 }).annual_rate,
            None
        );
        let all = annual_rate(&hazard, CurveKind::All { upper: 0.1 });
        assert_eq!((all.annual_rate_lower, all.annual_rate_upper), (6e-3, None));
        assert_eq!(
            (step.annual_rate_lower, step.annual_rate_upper),
            (hazard.annual_rate(0.2), Some(hazard.annual_rate(0.05)))
        );
        // A step above the last point is at most as frequent as that point; one below the first is
        // at least as frequent as that one.
        let above = annual_rate(
            &hazard,
            CurveKind::Step {
                lower: 2.0,
                upper: 2.0,
            },
        );
        assert_eq!(
            (above.annual_rate_lower, above.annual_rate_in_table),
            (0.0, Some(0.0))
        );
        assert_eq!(above.annual_rate_upper, Some(1e-6));
        assert!(
            (above.annual_rate.unwrap() / hazard.annual_rate(2.0) - 1.0).abs() < 1e-14
                && above.is_bound()
        );
        let below = annual_rate(
            &hazard,
            CurveKind::Step {
                lower: 0.001,
                upper: 0.001,
            },
        );
        assert_eq!(below.annual_rate, Some(0.2));
        // The first segment has k = ln 10/ln 5.
        let exponent = 10.0_f64.ln() / 5.0_f64.ln();
        assert!((below.below_first / (0.2 * 10.0_f64.powf(exponent) - 0.2) - 1.0).abs() < 1e-13);
        assert_eq!(
            (below.annual_rate_upper, below.begins_too_high()),
            (None, true)
        );
        // The product of such ends is no number that has their root: √(1e-200·1e-200) = 1e-200,
        // below the first point.
        let tiny = annual_rate(
            &hazard,
            CurveKind::Step {
                lower: 1e-200,
                upper: 1e-200,
            },
        );
        assert_eq!(
            (tiny.annual_rate, tiny.below_first.is_finite()),
            (Some(0.2), true)
        );
        let law = Hazard::power_law(1e-4, 1e200, 2.0).unwrap();
        let huge = annual_rate(
            &law,
            CurveKind::Step {
                lower: 1e199,
                upper: 1e201,
            },
        );
        assert!(
            (huge.annual_rate.unwrap() / 1e-4 - 1.0).abs() < 1e-12,
            "{huge:?}"
        );
        // A very small β is a step.
        let steep = annual_rate(&hazard, lognormal(0.1, 1e-9))
            .annual_rate
            .unwrap();
        assert!(
            (steep / hazard.annual_rate(0.1) - 1.0).abs() < 1e-8,
            "{steep}"
        );
    }

    #[test]
    fn hazards_that_do_not_fall_are_refused() {
        use super::super::HazardError as E;
        let refused = |of: &[(f64, f64)]| {
            Hazard::points(
                of.iter()
                    .map(|&(intensity, annual_rate)| HazardPoint {
                        intensity,
                        annual_rate,
                    })
                    .collect(),
            )
            .unwrap_err()
        };
        assert_eq!(refused(&[(0.1, 1.0)]), E::TooFew { points: 1 });
        assert!(matches!(
            refused(&[(0.1, 1.0), (0.1, 0.5)]),
            E::NotRising { point: 2, .. }
        ));
        assert!(matches!(
            refused(&[(0.1, 1.0), (0.2, 0.5), (0.3, 0.5)]),
            E::NotFalling { point: 3, .. }
        ));
        assert!(matches!(
            refused(&[(0.1, 1.0), (f64::NAN, 0.5)]),
            E::Value { point: 2, .. }
        ));
        assert!(matches!(
            refused(&[(0.1, 1.0), (0.2, 0.0)]),
            E::Value { point: 2, .. }
        ));
        assert!(Hazard::power_law(1e-4, 1.0, -2.0).is_err());
    }
}
