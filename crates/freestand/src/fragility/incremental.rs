//! Which scales of a motion are run in an incremental dynamic analysis, and how much each counts.

use super::outcomes::{LimitState, OutcomeClass};

/// Factor from one scale to the next on the way up, and the widest gap that is left between two
/// intensities.
pub const STEP_RATIO: f64 = 1.3;

/// A boundary between two classes is known when the scales on both sides of it are this close.
pub const BRACKET_RATIO: f64 = 1.05;

/// Ratio of the scales above and below the uplift threshold. The threshold is exact, but exactly
/// there the last digit of a motion decides whether the object lifts.
const THRESHOLD_RATIO: f64 = 1.002;

/// How far above the scale that first overturns an object it is run again.
pub const BEYOND_RATIO: f64 = 1.5;

/// Number of these scales.
const BEYOND: i32 = 3;

/// The most steps up, down or towards a boundary.
const MAX_STEPS: usize = 200;

/// One scale of a motion, and what the object did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScaleRun {
    /// Factor on the motion.
    pub scale_ratio: f64,
    /// How the run ended; `None`: it could not be followed.
    pub class: Option<OutcomeClass>,
}

/// The scales of one motion, rising, as the outcomes ask for them.
///
/// `threshold_ratio` is the scale above which a horizontal motion lifts the object. It is run 0.1 %
/// below and 0.1 % above it. From there the scale grows by [`STEP_RATIO`] until the object overturns,
/// or to `max_ratio`. If it lifts at the first scale, smaller ones follow until it does not. Then each
/// boundary between classes is bisected in the logarithm to [`BRACKET_RATIO`], and three scales up to
/// [`BEYOND_RATIO`] times the one that first overturned it follow: survival is not monotone in the
/// scale. A run that could not be followed is kept, and bounds nothing.
///
/// # Reference
/// Vamvatsikos, D. and Cornell, C. A. (2002). Incremental dynamic analysis. Earthquake Engineering
/// and Structural Dynamics 31, 491–514: hunt and fill.
///
/// # Example
/// An object that lifts from 1 and overturns from 2 times its motion:
/// ```
/// use freestand::fragility::{LimitState, OutcomeClass, scales_of_motion};
/// let class = |scale: f64| match scale {
///     s if s > 2.0 => OutcomeClass::Overturned,
///     s if s > 1.0 => OutcomeClass::Rocked,
///     _ => OutcomeClass::NoUplift,
/// };
/// let states = [LimitState::Rocks, LimitState::Overturns];
/// let runs = scales_of_motion(1.0, 10.0, &states, |scale| Some(class(scale)));
/// let overturned: Vec<f64> =
///     runs.iter().filter(|run| run.class == Some(OutcomeClass::Overturned)).map(|run| run.scale_ratio).collect();
/// assert!(overturned[0] > 2.0 && overturned[0] < 2.0 * 1.05);
/// assert!(overturned.iter().any(|scale| (scale / overturned[0] - 1.5).abs() < 1e-12));
/// ```
pub fn scales_of_motion(
    threshold_ratio: f64,
    max_ratio: f64,
    states: &[LimitState],
    mut run: impl FnMut(f64) -> Option<OutcomeClass>,
) -> Vec<ScaleRun> {
    let mut runs: Vec<ScaleRun> = Vec::new();
    let mut at = |runs: &mut Vec<ScaleRun>, scale_ratio: f64| {
        let class = run(scale_ratio);
        let place = runs.partition_point(|other| other.scale_ratio < scale_ratio);
        runs.insert(place, ScaleRun { scale_ratio, class });
        class
    };
    let half = THRESHOLD_RATIO.sqrt();
    let start_ratio = (threshold_ratio / half).min(max_ratio);
    at(&mut runs, start_ratio);
    let mut scale_ratio = (threshold_ratio * half).min(max_ratio);
    for _ in 0..MAX_STEPS {
        if start_ratio >= max_ratio {
            break;
        }
        let class = at(&mut runs, scale_ratio);
        if class == Some(OutcomeClass::Overturned) || scale_ratio >= max_ratio {
            break;
        }
        scale_ratio = (scale_ratio * STEP_RATIO).min(max_ratio);
    }
    // A vertical motion may lift it below the threshold of the horizontal one.
    let mut lowest_ratio = start_ratio;
    for _ in 0..MAX_STEPS {
        let lifts = runs
            .first()
            .is_some_and(|run| run.class.is_none_or(|class| class > OutcomeClass::NoUplift));
        if !lifts || lowest_ratio < 1e-6 * start_ratio {
            break;
        }
        lowest_ratio /= STEP_RATIO;
        at(&mut runs, lowest_ratio);
    }
    for state in states {
        for _ in 0..MAX_STEPS {
            let Some(scale_ratio) = middle_of_bracket(&runs, *state) else {
                break;
            };
            at(&mut runs, scale_ratio);
        }
    }
    let first = runs
        .iter()
        .find(|run| run.class == Some(OutcomeClass::Overturned))
        .map(|run| run.scale_ratio);
    if let Some(first) = first {
        for i in 1..=BEYOND {
            let scale_ratio = first * BEYOND_RATIO.powf(f64::from(i) / f64::from(BEYOND));
            let is_new = runs
                .iter()
                .all(|run| (run.scale_ratio / scale_ratio - 1.0).abs() > 1e-9);
            if scale_ratio <= max_ratio && is_new {
                at(&mut runs, scale_ratio);
            }
        }
    }
    runs
}

/// The geometric mean of the lowest scale that reached a limit state and the one below it; `None`
/// where they are close enough, or nothing is below it. A run that could not be followed is passed
/// over, unless it is the mean itself.
fn middle_of_bracket(runs: &[ScaleRun], state: LimitState) -> Option<f64> {
    let known = |run: &&ScaleRun| run.class.is_some();
    let upper = runs
        .iter()
        .find(|run| run.class.is_some_and(|class| state.is_reached(class)))?
        .scale_ratio;
    let lower = runs
        .iter()
        .filter(known)
        .rfind(|run| run.scale_ratio < upper)?
        .scale_ratio;
    let middle = (lower * upper).sqrt();
    let is_new = runs.iter().all(|run| run.scale_ratio != middle);
    (upper / lower > BRACKET_RATIO && is_new).then_some(middle)
}

/// Number of runs that did not overturn above the lowest scale that did; `runs` rise.
pub fn resurrections(runs: &[ScaleRun]) -> usize {
    let after = runs
        .iter()
        .skip_while(|run| run.class != Some(OutcomeClass::Overturned));
    after
        .filter(|run| {
            run.class
                .is_some_and(|class| class < OutcomeClass::Overturned)
        })
        .count()
}

/// The intensities that are missing between `from` and `to`, so that no gap is wider than
/// [`STEP_RATIO`]; `levels` rise.
///
/// # Example
/// ```
/// use freestand::fragility::missing_levels;
/// assert_eq!(missing_levels(&[1.0, 1.2], 1.0, 1.5), [1.5]);
/// assert_eq!(missing_levels(&[1.0, 1.2], 0.9, 1.2), [0.9]);
/// assert!(missing_levels(&[0.5, 1.0, 1.2, 1.5], 1.0, 1.5).is_empty());
/// ```
pub fn missing_levels(levels: &[f64], from: f64, to: f64) -> Vec<f64> {
    let rounding = 1.0 + 1e-9;
    let mut missing = Vec::new();
    let mut last: Option<f64> = levels
        .iter()
        .copied()
        .rfind(|level| *level <= from * rounding);
    if last.is_none() {
        missing.push(from);
        last = Some(from);
    }
    let within = levels
        .iter()
        .copied()
        .filter(|level| *level > from * rounding && *level < to / rounding);
    let is_closed = levels.iter().any(|level| *level >= to / rounding);
    let above = levels
        .iter()
        .copied()
        .find(|level| *level >= to / rounding)
        .unwrap_or(to);
    for level in within.chain([above]) {
        let before = last.unwrap_or(level);
        // Below the band nothing is missing.
        let parts = ((level / before).ln() / STEP_RATIO.ln() - 1e-9)
            .ceil()
            .max(1.0);
        for part in 1..parts as usize {
            let between = before * (level / before).powf(part as f64 / parts);
            if between >= from / rounding && between <= to * rounding {
                missing.push(between);
            }
        }
        last = Some(level);
    }
    if !is_closed {
        missing.push(to);
    }
    missing
}

/// How much each level of a motion counts: the part of ln intensity from `from` to `to` that is
/// nearer to it than to its neighbours, so that many levels close to a boundary do not count more
/// than few levels elsewhere. `levels` rise.
///
/// Without it the fit would be wrong: bisection puts one level that reached a limit state and one
/// that did not next to the capacity of every motion, and as many of both at any intensity look like
/// a large β. With it every motion is spread evenly over the same intensities, whatever its outcomes.
/// A motion that could not be scaled up to `to` counts half a gap beyond its last level. If `from` is
/// `to`, there is no interval to share, and every level counts as one run.
///
/// # Example
/// ```
/// use freestand::fragility::level_weights;
/// let weights = level_weights(&[1.0, 2.0, 2.1, 4.0], 1.0, 4.0);
/// assert!((weights.iter().sum::<f64>() - 4.0_f64.ln()).abs() < 1e-12 && weights[2] < weights[0]);
/// ```
pub fn level_weights(levels: &[f64], from: f64, to: f64) -> Vec<f64> {
    if from >= to {
        return vec![1.0; levels.len()];
    }
    let half_gap = STEP_RATIO.sqrt();
    let ends = levels.first().zip(levels.last());
    let Some((low, high)) =
        ends.map(|(first, last)| (from.max(first / half_gap), to.min(last * half_gap)))
    else {
        return Vec::new();
    };
    let between = |i: usize| match (
        i.checked_sub(1).and_then(|before| levels.get(before)),
        levels.get(i),
    ) {
        (Some(before), Some(after)) => (before * after).sqrt().clamp(low, high.max(low)),
        (None, _) => low,
        (_, None) => high.max(low),
    };
    (0..levels.len())
        .map(|i| (between(i + 1) / between(i)).ln().max(0.0))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::{
        CurveKind, FitKind, Outcomes, Run, draw_stream, fit_curves, lognormal_draw,
    };

    const STATES: [LimitState; 2] = [LimitState::Rocks, LimitState::Overturns];

    /// Rocks from 1 and overturns from a capacity.
    fn class(scale: f64, capacity: f64) -> OutcomeClass {
        match scale {
            s if s >= capacity => OutcomeClass::Overturned,
            s if s > 1.0 => OutcomeClass::Rocked,
            _ => OutcomeClass::NoUplift,
        }
    }

    #[test]
    fn boundaries_are_bracketed_and_nothing_is_run_beyond_the_largest_scale() {
        for capacity in [1.01, 1.7, 4.0, 9.99, 20.0] {
            let runs = scales_of_motion(1.0, 10.0, &STATES, |scale| Some(class(scale, capacity)));
            assert!(
                runs.windows(2)
                    .all(|pair| pair[0].scale_ratio < pair[1].scale_ratio),
                "{capacity}"
            );
            assert!(runs.iter().all(|run| run.scale_ratio <= 10.0), "{capacity}");
            for state in STATES {
                let place = runs
                    .iter()
                    .position(|run| run.class.is_some_and(|class| state.is_reached(class)));
                let Some(place) = place else {
                    assert_eq!(
                        (state, capacity, runs.last().unwrap().scale_ratio),
                        (LimitState::Overturns, 20.0, 10.0)
                    );
                    continue;
                };
                let (below, above) = (runs[place - 1].scale_ratio, runs[place].scale_ratio);
                assert!(
                    above / below <= BRACKET_RATIO,
                    "{capacity} {state:?} {below} {above}"
                );
            }
        }
    }

    /// If the threshold were bisected to 5 %, the step would be off by a factor of 0.98 or 1.02.
    #[test]
    fn the_uplift_threshold_is_bracketed_closely_up_to_the_largest_scale() {
        for threshold in [0.3, 1.0, 7.3] {
            let runs = scales_of_motion(threshold, 10.0, &STATES, |scale| {
                Some(class(scale / threshold, 20.0))
            });
            let place = runs
                .iter()
                .position(|run| run.class != Some(OutcomeClass::NoUplift))
                .unwrap();
            let (below, above) = (runs[place - 1].scale_ratio, runs[place].scale_ratio);
            // The rounding of a product and a root.
            assert!(
                ((below * above).sqrt() / threshold - 1.0).abs() < 1e-15,
                "{threshold}"
            );
            assert!(above / below < 1.0021, "{threshold}");
        }
        let weak = scales_of_motion(30.0, 10.0, &STATES, |scale| Some(class(scale / 30.0, 20.0)));
        assert_eq!(
            weak,
            [ScaleRun {
                scale_ratio: 10.0,
                class: Some(OutcomeClass::NoUplift)
            }]
        );
    }

    #[test]
    fn a_single_level_counts() {
        assert_eq!(level_weights(&[0.7], 0.7, 0.7), [1.0]);
    }

    #[test]
    fn survivors_above_the_first_overturning_are_counted() {
        let runs = scales_of_motion(1.0, 10.0, &STATES, |scale| {
            Some(if (2.3..2.6).contains(&scale) {
                OutcomeClass::Rocked
            } else {
                class(scale, 2.0)
            })
        });
        let first = runs
            .iter()
            .find(|run| run.class == Some(OutcomeClass::Overturned))
            .unwrap()
            .scale_ratio;
        assert!((2.0..2.1).contains(&first));
        assert!(resurrections(&runs) > 0);
        assert_eq!(
            resurrections(&scales_of_motion(1.0, 10.0, &STATES, |scale| Some(class(
                scale, 2.0
            )))),
            0
        );
    }

    #[test]
    fn an_object_that_lifts_at_once_is_run_at_smaller_scales() {
        let runs = scales_of_motion(2.0, 10.0, &STATES, |scale| Some(class(scale, 3.0)));
        assert!(runs[0].scale_ratio <= 1.0 && runs[0].class == Some(OutcomeClass::NoUplift));
    }

    #[test]
    fn runs_that_cannot_be_followed_end_the_search() {
        let runs = scales_of_motion(1.0, 10.0, &STATES, |_| None);
        assert!(runs.iter().all(|run| run.class.is_none()) && runs.len() < 2 * MAX_STEPS);
    }

    #[test]
    fn missing_levels_leave_no_wide_gap() {
        let levels = [0.2, 0.9, 1.0, 3.0, 3.1, 8.0];
        let mut all = missing_levels(&levels, 0.5, 10.0);
        assert!(all.iter().all(|level| (0.5..=10.0).contains(level)));
        all.extend(levels);
        all.sort_by(f64::total_cmp);
        for pair in all.windows(2).filter(|pair| pair[0] >= 0.5) {
            assert!(pair[1] / pair[0] <= STEP_RATIO * (1.0 + 1e-9), "{pair:?}");
        }
        assert_eq!(all.last(), Some(&10.0));
    }

    /// 400 motions with lognormal capacities, β = 0.4, median 3, and of the uplift, median 1: the fit
    /// to the weighted runs finds them, one to runs that all count alike finds a β that is too large.
    #[test]
    fn weighted_runs_give_the_spread_of_the_capacities() {
        let (motions, beta) = (400, 0.4);
        let mut each = Vec::new();
        for motion in 0..motions {
            let mut random = draw_stream(5, 0, motion, 0);
            // An intensity of 1 is a scale of 1: both boundaries have the same ε.
            let uplift = lognormal_draw(&mut random, 1.0, beta);
            let capacity = 3.0 * uplift;
            let of = |x: f64| match x {
                x if x >= capacity => OutcomeClass::Overturned,
                x if x > uplift => OutcomeClass::Rocked,
                _ => OutcomeClass::NoUplift,
            };
            let runs = scales_of_motion(uplift, 30.0, &STATES, |scale| Some(of(scale)));
            each.push((
                runs.iter().map(|run| run.scale_ratio).collect::<Vec<f64>>(),
                uplift,
                capacity,
            ));
        }
        let from = each
            .iter()
            .map(|one| one.0[0])
            .fold(f64::INFINITY, f64::min);
        let to = each
            .iter()
            .filter_map(|one| one.0.last().copied())
            .fold(0.0, f64::max);
        let mut found = Vec::new();
        for is_weighted in [true, false] {
            let mut runs = Vec::new();
            for (motion, (levels, uplift, capacity)) in each.iter().enumerate() {
                let mut levels = levels.clone();
                levels.extend(missing_levels(&levels, from, to));
                levels.sort_by(f64::total_cmp);
                for (x, weight) in levels.iter().zip(level_weights(&levels, from, to)) {
                    let class = match *x {
                        x if x >= *capacity => OutcomeClass::Overturned,
                        x if x > *uplift => OutcomeClass::Rocked,
                        _ => OutcomeClass::NoUplift,
                    };
                    let weight = if is_weighted { weight } else { 1.0 };
                    runs.push(Run {
                        motion: Some(motion),
                        intensity: *x,
                        class,
                        weight,
                    });
                }
            }
            let fit = fit_curves(&Outcomes::new(&runs).unwrap(), &STATES, FitKind::Ordered);
            let Some(CurveKind::Lognormal { median, beta }) = fit.curve(LimitState::Overturns)
            else {
                panic!()
            };
            found.push((median, beta));
        }
        let capacities: Vec<f64> = each.iter().map(|one| one.2.ln()).collect();
        let mean = capacities.iter().sum::<f64>() / capacities.len() as f64;
        let spread = capacities.iter().map(|ln| (ln - mean).powi(2)).sum::<f64>()
            / (capacities.len() - 1) as f64;
        // The levels are up to 5 % (0.05 of ln x) above a capacity and 1.3 apart elsewhere.
        let [weighted, alike] = [found[0], found[1]];
        assert!(
            (weighted.0.ln() - mean).abs() < 0.03,
            "{weighted:?} {}",
            mean.exp()
        );
        assert!(
            (weighted.1 / spread.sqrt() - 1.0).abs() < 0.05,
            "{weighted:?} {}",
            spread.sqrt()
        );
        assert!(alike.1 / spread.sqrt() > 1.1, "{alike:?} {}", spread.sqrt());
    }
}
