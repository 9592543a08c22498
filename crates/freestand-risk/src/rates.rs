//! How often an object reaches its limit states: by its curves, between the bounds that its runs
//! leave, and in the order of the limit states.

use freestand::fragility::{CurveKind, LimitState};
use freestand::risk::{
    AboveLast, AnnualRates, Capacity, Gap, Hazard, RESOLVED, annual_rate, bounds_by_runs,
    least_avoided, open_parts, open_rate,
};

use crate::fragility::ObjectCurves;

/// Intensities with one ratio between neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Levels {
    pub from: f64,
    pub to: f64,
    ratio: f64,
}

/// What the runs leave open of a rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Open {
    pub gap: Option<Gap>,
    /// Intensities that would tell it, where they are known.
    pub levels: Option<Levels>,
}

/// How often a limit state is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StateRates {
    pub limit_state: LimitState,
    /// With the bounds that the runs leave, whatever is above the last point of the hazard.
    pub rates: AnnualRates,
    /// The bounds that the runs leave if the hazard goes on above its last point; `None` where only a
    /// curve is known.
    pub by_runs: Option<(f64, Option<f64>)>,
    /// The most that it can be because a milder limit state is not more frequent.
    pub most: Option<f64>,
    pub open: Option<Open>,
}

/// The rates of all limit states of an object that withstands `factor` times the intensity, from
/// harmless to severe.
pub(crate) fn object_rates(curves: &ObjectCurves, factor: f64, hazard: &Hazard) -> Vec<StateRates> {
    let of = |curve: &freestand::fragility::Curve| {
        let kind = scaled(curve.kind, factor);
        let found: Vec<Capacity> = curves
            .capacities(curve.limit_state)
            .iter()
            .map(|one| one.scaled(factor))
            .collect();
        of_curve(hazard, curve.limit_state, kind, &found)
    };
    let mut states: Vec<StateRates> = curves.curves.iter().map(of).collect();
    put_in_order(&mut states);
    // Nothing says how much more often such an object fails.
    for one in states.iter_mut().filter(|_| curves.caution.is_some()) {
        one.rates.annual_rate_upper = None;
        one.most = None;
    }
    states
}

/// The curve of an object that withstands `factor` times the intensity.
fn scaled(kind: CurveKind, factor: f64) -> CurveKind {
    let times = |x: Option<f64>| x.map(|x| factor * x);
    match kind {
        CurveKind::Lognormal { median, beta } => CurveKind::Lognormal {
            median: factor * median,
            beta,
        },
        CurveKind::Step { lower, upper } => CurveKind::Step {
            lower: factor * lower,
            upper: factor * upper,
        },
        CurveKind::Bounds { lower, upper } => CurveKind::Bounds {
            lower: times(lower),
            upper: times(upper),
        },
        CurveKind::None { lower } => CurveKind::None {
            lower: factor * lower,
        },
        CurveKind::All { upper } => CurveKind::All {
            upper: factor * upper,
        },
        CurveKind::NotIncreasing { lower, upper } => CurveKind::NotIncreasing {
            lower: factor * lower,
            upper: factor * upper,
        },
    }
}

fn of_curve(
    hazard: &Hazard,
    limit_state: LimitState,
    kind: CurveKind,
    found: &[Capacity],
) -> StateRates {
    let by_curve = annual_rate(hazard, kind);
    if found.is_empty() {
        return StateRates {
            limit_state,
            rates: by_curve,
            by_runs: None,
            most: None,
            open: None,
        };
    }
    let bounds = |above| bounds_by_runs(hazard, kind, by_curve, found, above);
    let (least, most) = bounds(AboveLast::Open);
    let rates = match by_curve.annual_rate {
        Some(_) => by_curve.widened(least, most),
        // Both hold.
        None => AnnualRates {
            annual_rate_lower: by_curve.annual_rate_lower.max(least),
            annual_rate_upper: [by_curve.annual_rate_upper, most]
                .into_iter()
                .flatten()
                .reduce(f64::min),
            ..by_curve
        },
    };
    let open = Some(what_is_open(hazard, by_curve, most, found));
    StateRates {
        limit_state,
        rates,
        by_runs: Some(bounds(AboveLast::Continued)),
        most: None,
        open,
    }
}

/// Where the largest part of a rate is open, if that is more than a tenth of it, and the intensities that
/// would tell it.
fn what_is_open(
    hazard: &Hazard,
    by_curve: AnnualRates,
    most: Option<f64>,
    found: &[Capacity],
) -> Open {
    let largest = open_parts(hazard, by_curve, most, found).into_iter();
    let gap = largest
        .max_by(|a, b| a.annual_rate.total_cmp(&b.annual_rate))
        .map(|part| part.gap);
    let all = open_rate(by_curve, most);
    Open {
        gap,
        levels: all.and_then(|all| Levels::that_may_tell(hazard, found, RESOLVED * all)),
    }
}

/// The most parts into which an interval of intensities is divided, and the most steps above the highest.
const MOST_PARTS: i32 = 1000;

impl Levels {
    /// The intensities between two of which, and above all of which, less than `part` of a rate would be if the
    /// capacities between two levels of the runs were spread evenly by ln intensity; `None` where it is
    /// not known how weak the motions are that begin to reach a limit state.
    fn that_may_tell(hazard: &Hazard, found: &[Capacity], part: f64) -> Option<Self> {
        let mut levels = Self {
            from: f64::INFINITY,
            to: 0.0,
            ratio: f64::INFINITY,
        };
        // Those of the lowest intensity belong together.
        let begins = found.iter().filter(|one| one.is_lowest).map(|one| one.from);
        let lowest = begins
            .reduce(|a, b| Some(a?.min(b?)))
            .unwrap_or(Some(f64::INFINITY))?;
        let share = found
            .iter()
            .filter(|one| one.is_lowest)
            .map(|one| one.share)
            .sum::<f64>();
        for one in found {
            let (from, share) = if one.is_lowest {
                (lowest, share)
            } else {
                (one.from?, one.share)
            };
            let far = || {
                (0..MOST_PARTS)
                    .map(|i| from * 1.1_f64.powi(i))
                    .find(|x| share * hazard.annual_rate(*x) < part)
            };
            let to = one.to.or_else(far)?;
            let ratio = |parts: i32| (to / from).powf(1.0 / f64::from(parts));
            let falls = |ratio: f64| hazard.annual_rate(from) - hazard.annual_rate(ratio * from);
            let is_told = |parts: &i32| share / f64::from(*parts) * falls(ratio(*parts)) < part;
            if from < to {
                let parts = (1..MOST_PARTS).find(is_told)?;
                levels = levels.with(Self {
                    from,
                    to,
                    ratio: ratio(parts),
                });
            }
        }
        Some(levels).filter(|levels| levels.from < levels.to)
    }

    /// Those that do for both.
    pub fn with(self, other: Self) -> Self {
        let Self { from, to, ratio } = other;
        Self {
            from: self.from.min(from),
            to: self.to.max(to),
            ratio: self.ratio.min(ratio),
        }
    }

    /// How many they are.
    pub fn count(self) -> usize {
        ((self.to / self.from).ln() / self.ratio.ln())
            .ceil()
            .max(1.0) as usize
            + 1
    }
}

/// Whoever overturns has rocked: a severe limit state is never more frequent than a milder one.
///
/// What runs say of the milder one bounds the curve of the severe one, which may go on below the runs.
/// Otherwise the milder one is at least as frequent as the severe one.
fn put_in_order(states: &mut [StateRates]) {
    for place in 1..states.len() {
        let mild = states[place - 1].rates;
        let Some(most) = mild
            .annual_rate_upper
            .filter(|_| mild.annual_rate.is_none())
        else {
            continue;
        };
        states[place].most = Some(most);
        let severe = &mut states[place].rates;
        severe.annual_rate = severe.annual_rate.map(|rate| rate.min(most));
        severe.annual_rate_in_table = severe.annual_rate_in_table.map(|rate| rate.min(most));
        severe.annual_rate_lower = severe.annual_rate_lower.min(most);
        severe.annual_rate_upper = Some(
            severe
                .annual_rate_upper
                .map_or(most, |upper| upper.min(most)),
        );
    }
    for place in (1..states.len()).rev() {
        let severe = states[place].rates;
        let mild = &mut states[place - 1].rates;
        let known = severe.annual_rate.unwrap_or(severe.annual_rate_lower);
        mild.annual_rate_lower = match mild.annual_rate {
            Some(_) => mild.annual_rate_lower.max(severe.annual_rate_lower),
            None => mild.annual_rate_lower.max(known),
        };
        mild.annual_rate = mild.annual_rate.map(|rate| rate.max(known));
        mild.annual_rate_upper = mild.annual_rate_upper.map(|upper| upper.max(known));
        if let (Some(in_mild), Some(in_severe)) =
            (mild.annual_rate_in_table, severe.annual_rate_in_table)
        {
            mild.annual_rate_in_table = Some(in_mild.max(in_severe));
        }
    }
}

/// The least that the rate of a limit state falls if the object withstands `factor` times the intensity,
/// `factor` ≥ 1; `None` where nothing tells.
///
/// The capacities are the same with the option and without it, only farther up, and so is the hazard,
/// so that the difference is known better than either rate: it is the least over what may be between
/// the intensities of the runs, and above the last point of the hazard.
pub(crate) fn least_fall(
    curves: &ObjectCurves,
    state: LimitState,
    factor: f64,
    hazard: &Hazard,
) -> Option<f64> {
    let kind = curves.curve(state)?;
    let (without, with) = (
        annual_rate(hazard, kind),
        annual_rate(hazard, scaled(kind, factor)),
    );
    let fall = |of: fn(&AnnualRates) -> Option<f64>| Some(of(&without)? - of(&with)?);
    let by_curve = without.annual_rate.and(
        [
            fall(|rates| Some(rates.annual_rate_lower)),
            fall(|rates| rates.annual_rate),
            fall(|rates| rates.annual_rate_upper),
        ]
        .into_iter()
        .flatten()
        .reduce(f64::min),
    );
    let found = curves.capacities(state);
    let by_runs = if found.is_empty() {
        None
    } else {
        least_avoided(hazard, found, factor)
    };
    by_curve
        .into_iter()
        .chain(by_runs)
        .reduce(f64::min)
        .map(|fall| fall.max(0.0))
}

#[cfg(test)]
mod tests {
    use freestand::fragility::{OutcomeClass, Outcomes, Run, draw_stream, lognormal_draw};
    use freestand::risk::capacities;

    use super::*;

    /// Of 200 motions with β = 0.4, three coarse levels leave a rate open; those that are proposed tell it.
    #[test]
    fn proposed_levels_tell_the_rate() {
        let hazard = Hazard::power_law(1e-2, 0.1, 2.5).unwrap();
        let of: Vec<f64> = (0..200)
            .map(|i| lognormal_draw(&mut draw_stream(3, i, 0, 0), 0.3, 0.4))
            .collect();
        let uplifts: Vec<Option<f64>> = of.iter().map(|x| Some(0.5 * x)).collect();
        let open = |levels: &[f64]| {
            let run = |motion: usize, intensity: f64| {
                let class = if intensity >= of[motion] {
                    OutcomeClass::Overturned
                } else {
                    OutcomeClass::Rocked
                };
                Run {
                    motion: Some(motion),
                    intensity,
                    class,
                    weight: 1.0,
                }
            };
            let runs =
                (0..of.len()).flat_map(|motion| levels.iter().map(move |level| (motion, *level)));
            let outcomes = Outcomes::new(
                &runs
                    .map(|(motion, level)| run(motion, level))
                    .collect::<Vec<_>>(),
            )
            .unwrap();
            let found = capacities(&outcomes, LimitState::Overturns, &uplifts);
            of_curve(
                &hazard,
                LimitState::Overturns,
                CurveKind::Lognormal {
                    median: 0.3,
                    beta: 0.4,
                },
                &found,
            )
            .open
        };
        let Levels { from, to, .. } = open(&[0.2, 0.4, 0.8]).unwrap().levels.unwrap();
        let count = open(&[0.2, 0.4, 0.8]).unwrap().levels.unwrap().count();
        let level = |i: usize| from * (to / from).powf(i as f64 / (count - 1) as f64);
        assert!((10..100).contains(&count), "{count}");
        assert_eq!(
            open(&(0..count).map(level).collect::<Vec<_>>())
                .unwrap()
                .gap,
            None,
            "{from} {to} {count}"
        );
    }
}
