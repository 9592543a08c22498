//! Curves as points, for programs that join them by straight lines.

use freestand::fragility::{CurveKind, Empirical, LimitState, Sampling, empirical};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

use crate::fragility::ObjectFragility;

/// The largest step of a sampled curve: with 2 % the straight line between two points is off by
/// 0.0003 at most for β ≥ 0.25, with 10 % by 0.005.
const STEP: f64 = 1.02;
/// How far a sampled curve goes beyond the levels of the runs.
const BEYOND: f64 = 5.0;

/// Probabilities at common intensities, rising, from 0 at the intensity 0; beyond the last one they
/// stay as they are there.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Points {
    /// Intensities above 0, in the unit of the measure.
    pub(super) levels: Vec<f64>,
    /// P(exceeds or overturns); `None` without a tolerance.
    pub(super) exceeds: Option<Vec<f64>>,
    /// P(overturns).
    pub(super) overturns: Vec<f64>,
}

impl Points {
    /// The shares of runs of an object, made to rise; or, where shocks were fitted, samples of the
    /// fitted probabilities.
    ///
    /// # Errors
    /// Fitted probabilities of an object that rocks or overturns no more often under stronger
    /// motions: nothing is known of them.
    pub(super) fn of(object: &ObjectFragility, is_by_shock: bool) -> Result<Self, Problem> {
        match object.two_stage.filter(|_| is_by_shock) {
            Some(two_stage) => {
                let overturns = object.fit.curve(LimitState::Overturns);
                let known = [Some(two_stage.rocks), Some(two_stage.overturns), overturns];
                if known
                    .into_iter()
                    .flatten()
                    .any(|kind| matches!(kind, CurveKind::NotIncreasing { .. }))
                {
                    let id = shorten(&object.id);
                    let message = format!(
                        "object {id} rocks or overturns no more often under stronger motions"
                    );
                    let hint = "leave out `tolerance`, so that the shares of runs are exported, or run more intensities";
                    return Err(Problem::value(message, hint));
                }
                let levels = sampled(object.outcomes.levels());
                let of = |p: &dyn Fn(f64) -> f64| -> Vec<f64> {
                    // Rounding alone would make a curve fall.
                    levels
                        .iter()
                        .scan(0.0_f64, |most, x| Some(raise(most, p(*x))))
                        .collect()
                };
                let overturns = of(&|x| overturns.map_or(0.0, |kind| kind.least_probability(x)));
                let exceeds = of(&|x| two_stage.probability(x));
                let exceeds = exceeds
                    .iter()
                    .zip(&overturns)
                    .map(|(one, other)| one.max(*other))
                    .collect();
                Ok(Self {
                    levels,
                    exceeds: Some(exceeds),
                    overturns,
                })
            }
            None => {
                let seen = |state| {
                    let seen = empirical(&object.outcomes, state);
                    if object.outcomes.sampling() == Sampling::Own {
                        stepped(&seen)
                    } else {
                        rising(&seen)
                    }
                };
                let overturns = seen(LimitState::Overturns);
                let exceeds = object
                    .fit
                    .curve(LimitState::Exceeds)
                    .map(|_| seen(LimitState::Exceeds));
                let mut levels: Vec<f64> = overturns
                    .iter()
                    .chain(exceeds.iter().flatten())
                    .map(|point| point.0)
                    .collect();
                if levels.is_empty() {
                    levels = object.outcomes.levels().to_vec();
                }
                levels.sort_by(f64::total_cmp);
                levels.dedup();
                let of = |curve: &[(f64, f64)]| {
                    levels
                        .iter()
                        .map(|x| between(curve, *x))
                        .collect::<Vec<f64>>()
                };
                let overturned = of(&overturns);
                let exceeded = exceeds.map(|curve| {
                    of(&curve)
                        .iter()
                        .zip(&overturned)
                        .map(|(one, other)| one.max(*other))
                        .collect()
                });
                Ok(Self {
                    exceeds: exceeded,
                    overturns: overturned,
                    levels,
                })
            }
        }
    }
}

fn raise(most: &mut f64, value: f64) -> f64 {
    *most = most.max(value);
    *most
}

fn sampled(levels: &[f64]) -> Vec<f64> {
    let (from, to) = (
        levels.first().copied().unwrap_or(1.0) / BEYOND,
        levels.last().copied().unwrap_or(1.0) * BEYOND,
    );
    let count = ((to / from).ln() / STEP.ln()).ceil();
    (0..=count as usize)
        .map(|i| from * (to / from).powf(i as f64 / count))
        .collect()
}

/// Shares that rise with the intensity, nearest to those that were seen: neighbours that fall are
/// joined at their mean, weighted by their trials (pool adjacent violators). Limit states with the
/// same levels and trials keep their order.
fn rising(seen: &[Empirical]) -> Vec<(f64, f64)> {
    // Trials, those that reached the state, and how many levels they are of.
    let mut pools: Vec<(f64, f64, usize)> = Vec::new();
    for one in seen {
        let mut pool = (one.trials, one.reached, 1);
        while let Some(&(trials, reached, levels)) = pools.last() {
            if reached * pool.0 <= pool.1 * trials {
                break;
            }
            pool = (trials + pool.0, reached + pool.1, levels + pool.2);
            pools.pop();
        }
        pools.push(pool);
    }
    let shares = pools
        .iter()
        .flat_map(|&(trials, reached, levels)| std::iter::repeat_n(reached / trials, levels));
    seen.iter().map(|one| one.intensity).zip(shares).collect()
}

/// How far below a jump the point before it lies, relative to its intensity.
const BEFORE_JUMP: f64 = 1.0 - 1e-6;

/// The distribution of capacities, which rise, as it is: it jumps at each of them and stays between
/// them, and is 0 up to the lowest. Straight lines from one to the next would tell of failures where
/// there were none.
fn stepped(capacities: &[Empirical]) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    let mut before = 0.0;
    for (i, one) in capacities.iter().enumerate() {
        // Of equal capacities the last counts all of them.
        if capacities
            .get(i + 1)
            .is_some_and(|next| next.intensity == one.intensity)
        {
            continue;
        }
        let share = one.reached / one.trials;
        let foot = BEFORE_JUMP * one.intensity;
        if points.last().is_none_or(|last| last.0 < foot) {
            points.push((foot, before));
        }
        points.push((one.intensity, share));
        before = share;
    }
    points
}

/// The probability on straight lines, from 0 at the intensity 0.
fn between(curve: &[(f64, f64)], x: f64) -> f64 {
    let after = curve.partition_point(|point| point.0 < x);
    let low = after
        .checked_sub(1)
        .and_then(|i| curve.get(i))
        .copied()
        .unwrap_or((0.0, 0.0));
    match curve.get(after) {
        Some(&(to, p)) if to > low.0 => low.1 + (p - low.1) * (x - low.0) / (to - low.0),
        Some(&(_, p)) => p,
        None => low.1,
    }
}

#[cfg(test)]
mod tests {
    use freestand::fragility::{Curve, Fit, FitKind, OutcomeClass, Outcomes, Run, TwoStage};

    use super::*;

    /// An object whose runs, at 0.1 and 0.2, all rocked or all overturned, and tolerates more than
    /// the ceiling.
    fn by_shock(rocks: CurveKind, overturns: CurveKind) -> ObjectFragility {
        let class = OutcomeClass::Overturned;
        let runs = [0.1, 0.2].map(|intensity| Run {
            motion: Some(0),
            intensity,
            class,
            weight: 1.0,
        });
        let curve = |limit_state, kind| Curve { limit_state, kind };
        ObjectFragility {
            capacities: Vec::new(),
            id: "a".to_owned(),
            outcomes: Outcomes::new(&runs).unwrap(),
            unresolved: 0,
            reasons: Vec::new(),
            fit: Fit {
                kind: FitKind::Ordered,
                curves: vec![
                    curve(LimitState::Rocks, rocks),
                    curve(LimitState::Overturns, overturns),
                ],
                log_likelihood: 0.0,
                score_per_run: 0.0,
            },
            caution: None,
            two_stage: Some(TwoStage {
                rocks,
                overturns,
                shock: None,
                ceiling_g: 1.0,
                tolerance_g: 2.0,
            }),
            no_two_stage: None,
            goodness: None,
            bootstrap: None,
            qualities: Vec::new(),
            resurrections: None,
            scaled_above_4: None,
        }
    }

    /// What overturned in every run is exported as certain from the lowest intensity of the runs
    /// on, and what is not known at all is refused.
    #[test]
    fn what_always_overturns_is_exported() {
        let all = CurveKind::All { upper: 0.1 };
        let points = Points::of(&by_shock(all, all), true).unwrap();
        let pairs = points.levels.iter().zip(&points.overturns);
        assert!(
            pairs
                .clone()
                .all(|(x, p)| *p == f64::from(u8::from(*x >= 0.1))),
            "{points:?}"
        );
        assert!(pairs.filter(|(_, p)| **p == 1.0).count() > 10);
        assert_eq!(points.exceeds, Some(points.overturns.clone()));
        let unknown = CurveKind::NotIncreasing {
            lower: 0.1,
            upper: 0.2,
        };
        let problem = Points::of(&by_shock(all, unknown), true).unwrap_err();
        assert!(
            problem
                .message
                .contains("object a rocks or overturns no more often"),
            "{problem}"
        );
    }

    fn seen(of: &[(f64, f64)]) -> Vec<Empirical> {
        of.iter()
            .map(|&(intensity, reached)| Empirical {
                intensity,
                trials: 10.0,
                reached,
            })
            .collect()
    }

    /// 2, 5, 3, 4 of 10: the last three are joined at their mean, 4 of 10.
    #[test]
    fn shares_that_fall_are_joined() {
        let risen = rising(&seen(&[
            (1.0, 2.0),
            (2.0, 5.0),
            (3.0, 3.0),
            (4.0, 4.0),
            (5.0, 9.0),
        ]));
        assert_eq!(
            risen,
            [(1.0, 0.2), (2.0, 0.4), (3.0, 0.4), (4.0, 0.4), (5.0, 0.9)]
        );
        assert_eq!(
            (
                between(&risen, 0.5),
                between(&risen, 4.5),
                between(&risen, 50.0)
            ),
            (0.1, 0.65, 0.9)
        );
        assert_eq!(between(&[], 1.0), 0.0);
    }

    /// Capacities 2, 4, 4 of ten motions: 0 below 2, 0.1 up to 4, 0.3 from there.
    #[test]
    fn capacities_are_steps() {
        let points = stepped(&seen(&[(2.0, 1.0), (4.0, 2.0), (4.0, 3.0)]));
        let at = |x| between(&points, x);
        assert_eq!(
            [0.5, 1.99, 2.0, 3.99, 4.0, 9.0].map(at),
            [0.0, 0.0, 0.1, 0.1, 0.3, 0.3]
        );
        assert!(points.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn samples_are_near_each_other() {
        let levels = sampled(&[0.1, 1.0]);
        assert!((levels[0] - 0.02).abs() < 1e-15 && (levels[levels.len() - 1] - 5.0).abs() < 1e-12);
        assert!(
            levels
                .windows(2)
                .all(|pair| pair[1] / pair[0] < 1.0200001 && pair[1] > pair[0])
        );
    }
}
