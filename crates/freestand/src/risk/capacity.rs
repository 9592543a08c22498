//! What runs at a few intensities leave open of a rate.
//!
//! A curve says how often an object fails between the intensities of the runs and below them; the
//! runs themselves say only between which two of them the object begins to fail. Where motions of
//! these intensities are frequent, that is a wide range.

use crate::fragility::{LimitState, Outcomes};

use super::hazard::{Hazard, Tail, first_exponent};

/// Between which intensities the capacity of a share of the motions lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capacity {
    /// Above this one; `None`: nothing is known but that it is not above `to`.
    pub from: Option<f64>,
    /// Not above this one; `None`: above `from`, however far.
    pub to: Option<f64>,
    /// The share of the motions.
    pub share: f64,
    /// Whether `to` is the lowest intensity of the runs, so that `from` is none of them.
    pub is_lowest: bool,
}

impl Capacity {
    /// The same of an object that withstands so many times the intensity.
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            from: self.from.map(|x| factor * x),
            to: self.to.map(|x| factor * x),
            ..self
        }
    }
}

/// Where the capacities of the runs of an object lie, rising, with shares that sum to 1.
///
/// The share of runs that reached a limit state is made to rise with the intensity by isotonic
/// regression (the pool of adjacent violators). What it rises from one level to the next lies between
/// the two, what it is at the lowest level between the uplift of each motion and that level, and the
/// rest above the highest one. `uplifts` has the intensity that just lifts the object in each motion,
/// below which it reaches no limit state; an empty slice, or `None`, where it is not known.
///
/// # Reference
/// Ayer, M., Brunk, H. D., Ewing, G. M., Reid, W. T. and Silverman, E. (1955). An empirical
/// distribution function for sampling with incomplete information. Annals of Mathematical Statistics
/// 26, 641–647.
///
/// # Example
/// One of two motions at 0.1, none at 0.2 and both at 0.4: ¼ up to 0.2, the rest up to 0.4.
/// ```
/// use freestand::fragility::{LimitState, OutcomeClass, Outcomes, Run};
/// use freestand::risk::capacities;
/// let run = |motion, intensity, is_over| {
///     let class = if is_over { OutcomeClass::Overturned } else { OutcomeClass::Rocked };
///     Run { motion: Some(motion), intensity, class, weight: 1.0 }
/// };
/// let runs = [(0, 0.1, true), (1, 0.1, false), (0, 0.2, false), (1, 0.2, false), (0, 0.4, true), (1, 0.4, true)];
/// let runs: Vec<Run> = runs.into_iter().map(|(motion, x, is_over)| run(motion, x, is_over)).collect();
/// let found = capacities(&Outcomes::new(&runs)?, LimitState::Overturns, &[Some(0.05), Some(0.08)]);
/// let found: Vec<_> = found.iter().map(|one| (one.from, one.to, one.share)).collect();
/// assert_eq!(found, [(Some(0.05), Some(0.1), 0.25), (Some(0.2), Some(0.4), 0.75)]);
/// # Ok::<(), freestand::fragility::OutcomesError>(())
/// ```
pub fn capacities(
    outcomes: &Outcomes,
    state: LimitState,
    uplifts: &[Option<f64>],
) -> Vec<Capacity> {
    let levels = outcomes.levels();
    let shares = rising_shares(&outcomes.shares(state));
    let mut found = Vec::new();
    let mut before: Option<(f64, f64)> = None;
    for (&level, &share) in levels.iter().zip(&shares) {
        match before {
            None if share > 0.0 => {
                let reached = outcomes.reached_at_lowest(state);
                let all: f64 = reached.iter().map(|(_, weight)| weight).sum();
                found.extend(reached.into_iter().map(|(motion, weight)| {
                    Capacity {
                        // A run that lifts below its own uplift only by the last digit.
                        from: motion
                            .and_then(|motion| *uplifts.get(motion)?)
                            .map(|uplift| uplift.min(level)),
                        to: Some(level),
                        share: share * weight / all,
                        is_lowest: true,
                    }
                }));
            }
            Some((below, known)) if share > known => {
                found.push(Capacity {
                    from: Some(below),
                    to: Some(level),
                    share: share - known,
                    is_lowest: false,
                });
            }
            _ => {}
        }
        before = Some((level, share));
    }
    if let Some((last, share)) = before.filter(|(_, share)| *share < 1.0) {
        found.push(Capacity {
            from: Some(last),
            to: None,
            share: 1.0 - share,
            is_lowest: false,
        });
    }
    found
}

/// Shares that never fall, each the mean of neighbours that do: of `(reached, runs)` at each level.
fn rising_shares(counts: &[(f64, f64)]) -> Vec<f64> {
    // Reached, runs, and the number of levels of each block.
    let mut blocks: Vec<(f64, f64, usize)> = Vec::new();
    for &(reached, runs) in counts {
        blocks.push((reached, runs, 1));
        while let [.., low, high] = blocks.as_slice() {
            if low.0 * high.1 <= high.0 * low.1 {
                break;
            }
            let both = (low.0 + high.0, low.1 + high.1, low.2 + high.2);
            blocks.truncate(blocks.len() - 2);
            blocks.push(both);
        }
    }
    let share = |&(reached, runs, levels): &(f64, f64, usize)| {
        std::iter::repeat_n(
            if runs > 0.0 {
                (reached / runs).min(1.0)
            } else {
                0.0
            },
            levels,
        )
    };
    blocks.iter().flat_map(share).collect()
}

/// The largest share of an upper bound that motions below the first point of a hazard may have if they
/// count as those of a curve that continues its first segment.
const SMALL: f64 = 0.01;

/// What is assumed of motions above the last point of a hazard where the ends of a rate are sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AboveLast {
    /// Nothing: for the least there are none, for the most all are as strong as any.
    Open,
    /// The last segment goes on, for both.
    Continued,
}

impl AboveLast {
    /// For the least that a rate can be.
    pub fn least(self) -> Tail {
        match self {
            Self::Open => Tail::Absent,
            Self::Continued => Tail::Continued,
        }
    }

    /// For the most.
    pub fn most(self) -> Tail {
        match self {
            Self::Open => Tail::Level,
            Self::Continued => Tail::Continued,
        }
    }
}

/// The least and the most that a rate can be, wherever between its ends each capacity lies:
/// Σ share λ(to) and Σ share λ(from) \[1/year\]. The most is `None` where an end is not known, or where
/// much of it is below the first point of the hazard.
///
/// In terms of the probability P at the levels x this is Σ P(xᵢ) \[λ(xᵢ) − λ(xᵢ₊₁)\] + P(xₙ) λ(xₙ), and
/// the same with P(xᵢ₊₁), λ(xₙ) above the last level and P(x₁) \[λ(uplift) − λ(x₁)\] below the first.
pub fn rate_bounds(
    hazard: &Hazard,
    capacities: &[Capacity],
    above: AboveLast,
) -> (f64, Option<f64>) {
    let least = capacities.iter().map(|one| {
        one.share
            * one
                .to
                .map_or(0.0, |to| hazard.annual_rate_with(to, above.least()))
    });
    let first = match hazard {
        Hazard::Points(points) => points.first().copied(),
        Hazard::PowerLaw { .. } => None,
    };
    let (mut most, mut below_first) = (0.0, 0.0);
    for one in capacities {
        let Some(from) = one.from else {
            return (least.sum(), None);
        };
        match first.filter(|first| from < first.intensity) {
            Some(first) => {
                let exponent = first_exponent(hazard);
                let rate = one.share * first.annual_rate * (from / first.intensity).powf(-exponent);
                below_first += rate - one.share * first.annual_rate;
                most += rate;
            }
            None => most += one.share * hazard.annual_rate_with(from, above.most()),
        }
    }
    (least.sum(), (below_first <= SMALL * most).then_some(most))
}

/// The least that the rate falls if the object withstands `factor` times the intensity, wherever
/// between its ends each capacity lies and whatever is above the last point of the hazard
/// \[1/year\]; `None` for a factor below 1 where an end is not known.
pub fn least_avoided(hazard: &Hazard, capacities: &[Capacity], factor: f64) -> Option<f64> {
    let avoided = |x: f64, tail: Tail| {
        hazard.annual_rate_with(x, tail) - hazard.annual_rate_with(factor * x, tail)
    };
    let of = |one: &Capacity, tail: Tail| -> Option<f64> {
        let (from, to) = match (one.from, one.to) {
            (Some(from), Some(to)) => (from, to),
            // Far above every motion nothing is avoided, and nothing is added.
            (Some(from), None) => (from, FAR * from),
            (None, _) => return (factor >= 1.0).then_some(0.0),
        };
        let at = |i: u32| from * (to / from).powf(f64::from(i) / f64::from(STEPS));
        let least = (0..=STEPS)
            .map(|i| avoided(at(i), tail))
            .fold(f64::INFINITY, f64::min);
        Some(
            one.share
                * if one.to.is_none() {
                    least.min(0.0)
                } else {
                    least
                },
        )
    };
    let sum = |tail| {
        capacities
            .iter()
            .map(|one| of(one, tail))
            .sum::<Option<f64>>()
    };
    let tails = [Tail::Absent, Tail::Continued, Tail::Level].map(sum);
    tails.into_iter().reduce(|a, b| Some(a?.min(b?)))?
}

/// Steps between the ends of a capacity, in which the least that is avoided is searched.
const STEPS: u32 = 24;
/// How far above the highest level a capacity is searched.
const FAR: f64 = 100.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::{OutcomeClass, Run, draw_stream, lognormal_draw};

    /// Stripes of motions with these capacities for overturning, that lift at `uplift` of it.
    fn stripes(capacities: &[f64], levels: &[f64]) -> Outcomes {
        let mut runs = Vec::new();
        for (motion, capacity) in capacities.iter().enumerate() {
            for &intensity in levels {
                let class = if intensity >= *capacity {
                    OutcomeClass::Overturned
                } else {
                    OutcomeClass::Rocked
                };
                runs.push(Run {
                    motion: Some(motion),
                    intensity,
                    class,
                    weight: 1.0,
                });
            }
        }
        Outcomes::new(&runs).unwrap()
    }

    fn bounds(hazard: &Hazard, outcomes: &Outcomes, uplifts: &[Option<f64>]) -> (f64, Option<f64>) {
        let found = capacities(outcomes, LimitState::Overturns, uplifts);
        let shares: f64 = found.iter().map(|one| one.share).sum();
        // Rounding of a sum.
        assert!((shares - 1.0).abs() < 1e-12, "{shares}");
        rate_bounds(hazard, &found, AboveLast::Open)
    }

    /// The rate of the motions is the mean of λ at their capacities. Whatever the levels, it is between
    /// the bounds, and with levels close together the bounds are close together.
    #[test]
    fn the_rate_of_the_motions_is_between_the_bounds() {
        let hazard = Hazard::power_law(1e-2, 0.1, 2.5).unwrap();
        for sample in 0..40 {
            let mut random = draw_stream(9, sample, 0, 0);
            let of: Vec<f64> = (0..20)
                .map(|_| lognormal_draw(&mut random, 0.3, 0.4))
                .collect();
            let uplifts: Vec<Option<f64>> = of.iter().map(|x| Some(0.2 * x)).collect();
            let truth = of.iter().map(|x| hazard.annual_rate(*x)).sum::<f64>() / 20.0;
            let grid = |from: f64, ratio: f64, count: i32| -> Vec<f64> {
                (0..count).map(|i| from * ratio.powi(i)).collect()
            };
            for levels in [grid(0.3, 1.5, 5), grid(0.1, 2.0, 4), grid(0.05, 1.2, 20)] {
                let (least, most) = bounds(&hazard, &stripes(&of, &levels), &uplifts);
                let most = most.unwrap();
                assert!(
                    least <= truth && truth <= most,
                    "{levels:?}: {least} {truth} {most}"
                );
            }
            // 1.01^2.5 is 1.025.
            let (least, most) = bounds(&hazard, &stripes(&of, &grid(0.02, 1.01, 600)), &uplifts);
            assert!(most.unwrap() < 1.026 * least, "{least} {most:?}");
        }
    }

    /// P(x₁), …, P(xₙ) of three levels, by the formulas in terms of P.
    #[test]
    fn the_bounds_are_those_of_the_probabilities() {
        let hazard = Hazard::power_law(1.0, 1.0, 1.0).unwrap();
        let of = [0.5, 1.5, 1.5, 3.0];
        let (least, most) = bounds(&hazard, &stripes(&of, &[1.0, 2.0, 2.5]), &[Some(0.25); 4]);
        let (p, rate) = ([0.25, 0.75, 0.75], [1.0, 0.5, 0.4]);
        let least_of = p[0] * (rate[0] - rate[1]) + p[1] * (rate[1] - rate[2]) + p[2] * rate[2];
        let most_of =
            p[0] * (4.0 - 1.0) + p[1] * (rate[0] - rate[1]) + p[2] * (rate[1] - rate[2]) + rate[2];
        assert!(
            (least - least_of).abs() < 1e-15 && (most.unwrap() - most_of).abs() < 1e-15,
            "{least} {most:?}"
        );
        // Without the uplift there is no upper bound, unless nothing fails at the lowest level.
        assert_eq!(
            bounds(&hazard, &stripes(&of, &[1.0, 2.0, 2.5]), &[]).1,
            None
        );
        assert!(
            bounds(&hazard, &stripes(&of, &[0.4, 2.0, 2.5]), &[])
                .1
                .is_some()
        );
    }

    /// A hazard that begins above the uplift says nothing about the most.
    #[test]
    fn a_hazard_that_begins_too_high_has_no_upper_bound() {
        use super::super::HazardPoint;
        let points = [(1.0, 1.0), (4.0, 0.25)].map(|(intensity, annual_rate)| HazardPoint {
            intensity,
            annual_rate,
        });
        let hazard = Hazard::points(points.to_vec()).unwrap();
        let runs = stripes(&[0.5, 1.5, 1.5, 3.0], &[1.0, 2.0, 2.5]);
        assert_eq!(bounds(&hazard, &runs, &[Some(0.25); 4]).1, None);
        assert!(bounds(&hazard, &runs, &[Some(1.0); 4]).1.is_some());
    }

    /// For a power law λ(x) − λ(fx) falls with x: it is least at the upper ends, (1 − f^−k) of the least
    /// rate; a curve that is flat between two points avoids nothing there.
    #[test]
    fn what_is_avoided_is_the_least_between_the_ends() {
        let hazard = Hazard::power_law(1.0, 1.0, 2.0).unwrap();
        let found = capacities(
            &stripes(&[0.5, 1.5], &[1.0, 2.0]),
            LimitState::Overturns,
            &[Some(0.25); 2],
        );
        let (least, _) = rate_bounds(&hazard, &found, AboveLast::Open);
        let avoided = least_avoided(&hazard, &found, 2.0).unwrap();
        assert!(
            (avoided / (least * 0.75) - 1.0).abs() < 1e-12,
            "{avoided} {least}"
        );
        assert_eq!(least_avoided(&hazard, &found, 1.0), Some(0.0));
        let open = [Capacity {
            from: None,
            to: Some(1.0),
            share: 1.0,
            is_lowest: true,
        }];
        assert_eq!(
            (
                least_avoided(&hazard, &open, 2.0),
                least_avoided(&hazard, &open, 0.5)
            ),
            (Some(0.0), None)
        );
    }
}
