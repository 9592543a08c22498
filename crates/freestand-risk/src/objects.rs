//! The risk of one object.

use freestand::fragility::{CurveKind, LimitState, percentiles};
use freestand::risk::{
    AnnualRates, Bin, Hazard, annual_rate, deaggregation, expected_annual_loss,
    probability_in_years,
};
use freestand_output::answer_of;
use freestand_output::facts::Facts;

use crate::fragility::{ObjectCurves, ObjectFragility};

use super::costs::{CostRow, Effect, NotCounted};
use super::rates::{Open, StateRates, least_fall, object_rates};

/// The states whose curves enter a loss.
pub(crate) const LOSS_STATES: [LimitState; 2] = [LimitState::Exceeds, LimitState::Overturns];

/// Whether an object fails more often than accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum RiskVerdict {
    /// It fails no more often than accepted.
    Accepted,
    /// It fails more often.
    Exceeds,
}

/// Why an accepted rate has no verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unjudged {
    /// There is no curve of the limit state.
    NoCurve(LimitState),
    /// Its rate is not known.
    UnknownRate(LimitState),
}

/// What the slopes of the hazard of a place have to do with the interval of a rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slopes {
    /// Nothing: the hazard is as stated.
    Stated,
    /// They are in the interval beside the motions.
    BesideMotions,
    /// They are all that is in it: it is a range, and no 95 % interval.
    Alone,
}

/// How often a limit state is reached.
#[derive(Debug, Clone, PartialEq)]
pub struct StateRisk {
    /// The limit state.
    pub limit_state: LimitState,
    /// How often a year.
    pub rates: AnnualRates,
    /// Where the runs leave much of the rate open.
    pub open: Option<Open>,
    /// The 95 % interval over the motions, together with the bounds that the runs leave.
    pub ci95: Option<(f64, f64)>,
    /// Whether that interval also covers other slopes of the hazard, and whether it is nothing else: no motions were drawn.
    pub slopes: Slopes,
    /// Whether samples were drawn and tell no interval.
    pub lacks_interval: bool,
    /// Probability in some years; `None` where the rate is not known.
    pub probability: Option<f64>,
    /// Those years.
    pub years: f64,
}

impl StateRisk {
    /// Whether the rate is certainly below or certainly above the accepted one; `None` if its
    /// uncertainty is not known.
    fn is_certain(&self, accepted: f64) -> Option<bool> {
        let AnnualRates {
            annual_rate,
            annual_rate_lower,
            ..
        } = self.rates;
        annual_rate?;
        let straddles = |low: f64, high: Option<f64>| {
            low <= accepted && high.is_none_or(|high| accepted <= high)
        };
        let most = self.rates.most();
        let is_open = straddles(annual_rate_lower, most)
            || self
                .ci95
                .is_some_and(|(low, high)| straddles(low, Some(high)))
            || self.lacks_interval;
        if is_open {
            Some(false)
        } else {
            self.ci95.map(|_| true)
        }
    }

    /// The verdict: accepted only if the most that the rate can be is; `None` if neither the rate nor its
    /// bounds decide.
    fn verdict(&self, accepted: f64) -> Option<RiskVerdict> {
        let AnnualRates {
            annual_rate,
            annual_rate_lower,
            ..
        } = self.rates;
        let most = self.rates.most();
        match (annual_rate, most) {
            (Some(rate), _) if rate > accepted => Some(RiskVerdict::Exceeds),
            (_, Some(most)) if most <= accepted => Some(RiskVerdict::Accepted),
            (Some(_), Some(_)) => Some(RiskVerdict::Exceeds),
            _ => (annual_rate_lower > accepted).then_some(RiskVerdict::Exceeds),
        }
    }

    /// The rate, or its lower bound if nothing bounds it above.
    pub fn known(&self) -> Option<f64> {
        let lower = self.rates.annual_rate_lower;
        if self.is_at_least() {
            (lower > 0.0).then_some(lower)
        } else {
            self.rates.annual_rate
        }
    }

    /// Whether the limit state may be reached more often than is counted.
    pub fn is_at_least(&self) -> bool {
        self.rates.annual_rate.is_none() || self.rates.is_at_least()
    }
}

/// An accepted rate, and the rate that it is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The limit state.
    pub limit_state: LimitState,
    /// The accepted rate \[1/year\].
    pub accepted: f64,
    /// The rate \[1/year\]; `None` if it is not known.
    pub annual_rate: Option<f64>,
    /// Whether it is the most that the rate can be, because the rate itself is accepted.
    pub is_most: bool,
}

impl Limit {
    /// The rate divided by the accepted one; 0 if the rate is not known.
    pub fn ratio(&self) -> f64 {
        self.annual_rate.map_or(0.0, |rate| rate / self.accepted)
    }

    fn is_broken(&self) -> bool {
        self.annual_rate.is_some_and(|rate| rate > self.accepted)
    }
}

/// The risk of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectRisk {
    /// Identifier of the object.
    pub id: String,
    /// Its fragility.
    pub curves: ObjectCurves,
    /// Its limit states.
    pub states: Vec<StateRisk>,
    /// Parts of its rate of overturning by intensity.
    pub deaggregation: Vec<Bin>,
    /// Accepted rate of overturning \[1/year\].
    pub accepted_rate: Option<f64>,
    /// Accepted rate of exceeding its tolerance \[1/year\].
    pub accepted_exceed_rate: Option<f64>,
    /// Whether it fails more often than accepted; `None` where that is not known or not asked.
    pub verdict: Option<RiskVerdict>,
    /// Whether the verdict holds over the whole interval.
    pub is_certain: Option<bool>,
    /// Why an accepted rate has no verdict.
    pub why: Option<Unjudged>,
    /// What its failures cost.
    pub cost: Option<CostRow>,
    /// What its failures cost a year on average.
    pub expected_annual_loss: Option<f64>,
    /// The ends of that loss.
    pub loss: Option<LossBounds>,
    /// Whether the rates, and with them the loss, may be larger than those that are counted.
    pub is_at_least: bool,
    /// Casualties per year; `None` where their probability or the rate of overturning is not known.
    pub expected_annual_casualties: Option<f64>,
    /// The least that they can be; `None` where their probability is not known.
    pub least_casualties: Option<f64>,
    /// The ends of them, the upper one where the rate of overturning has one.
    pub casualty_bounds: Option<(f64, Option<f64>)>,
    /// Kinds of costs that were not given.
    pub not_counted: Vec<NotCounted>,
}

impl ObjectRisk {
    /// From its fragility, its costs and the hazard.
    pub(crate) fn new(
        curves: &ObjectCurves,
        fit: Option<&ObjectFragility>,
        cost: Option<&CostRow>,
        (hazard, tilted): (&Hazard, &[Hazard]),
        years: f64,
        accepted: Option<f64>,
    ) -> Self {
        let rates = object_rates(curves, 1.0, hazard);
        let states: Vec<StateRisk> = curves
            .curves
            .iter()
            .zip(rates)
            .map(
                |(
                    curve,
                    StateRates {
                        limit_state,
                        rates,
                        by_runs,
                        most,
                        open,
                    },
                )| {
                    let samples = fit.and_then(|fit| fit.bootstrap.as_ref());
                    let is_lognormal = matches!(curve.kind, CurveKind::Lognormal { .. });
                    let lacks = samples
                        .filter(|_| is_lognormal)
                        .and_then(|one| one.lacks_interval(limit_state));
                    let is_known = is_lognormal && lacks.is_none();
                    // Without samples of motions only the slope of the hazard is open, if it is.
                    let is_open = samples.is_some() || !tilted.is_empty();
                    let of = |hazard: &Hazard| {
                        let rate = |kind| annual_rate(hazard, kind).annual_rate;
                        let lognormal = |(median, beta)| CurveKind::Lognormal { median, beta };
                        match samples {
                            Some(samples) => {
                                let all = samples.lognormals(limit_state).map(lognormal);
                                percentiles(all.filter_map(rate).collect())
                            }
                            None => rate(curve.kind).map(|rate| (rate, rate)),
                        }
                    };
                    let ci95 = Some(hazard)
                        .filter(|_| is_known && is_open)
                        .and_then(|hazard| {
                            let mut all = std::iter::once(hazard).chain(tilted).map(of);
                            let first = all.next()??;
                            all.try_fold(first, |(low, high), one| {
                                one.map(|one| (low.min(one.0), high.max(one.1)))
                            })
                        });
                    StateRisk {
                        limit_state,
                        rates,
                        open,
                        // An interval over the motions has an upper end, and the rate has none.
                        ci95: ci95
                            .filter(|_| curves.caution.is_none())
                            .and_then(|ci95| joined(ci95, by_runs, most)),
                        slopes: match (tilted.is_empty(), samples) {
                            (true, _) => Slopes::Stated,
                            (false, Some(_)) => Slopes::BesideMotions,
                            (false, None) => Slopes::Alone,
                        },
                        lacks_interval: lacks.is_some(),
                        probability: rates
                            .annual_rate
                            .map(|rate| probability_in_years(rate, years)),
                        years,
                    }
                },
            )
            .collect();
        let accepted_rate = cost.and_then(|cost| cost.accepted_rate).or(accepted);
        let accepted_exceed_rate = cost.and_then(|cost| cost.accepted_exceed_rate);
        let Judged {
            verdict,
            is_certain,
            why,
        } = judged(&states, accepted_rate, accepted_exceed_rate);
        let mut not_counted = cost.map_or(Vec::new(), CostRow::not_counted);
        let has_exceeds = curves.curve(LimitState::Exceeds).is_some();
        if cost.is_some_and(|cost| cost.repair.is_some()) && !has_exceeds {
            not_counted.push(NotCounted::RepairWithoutCurve);
        }
        let unknown = |state: LimitState| {
            states
                .iter()
                .any(|one| one.limit_state == state && one.rates.annual_rate.is_none())
        };
        let loss = cost
            .filter(|cost| cost.has_costs())
            .map(|cost| loss_of(curves, cost, hazard));
        let is_at_least = states
            .iter()
            .any(|one| LOSS_STATES.contains(&one.limit_state) && one.is_at_least())
            || loss.is_some_and(|loss| loss.most.is_none());
        for (state, part) in [
            (LimitState::Exceeds, NotCounted::ExceedingOfUnknownRate),
            (LimitState::Overturns, NotCounted::OverturningOfUnknownRate),
        ] {
            if cost.is_some() && unknown(state) {
                not_counted.push(part);
            }
        }
        if cost.is_some_and(|cost| cost.overturned() > 0.0)
            && curves.curve(LimitState::Overturns).is_none()
        {
            not_counted.push(NotCounted::OverturningWithoutCurve);
        }
        let expected_annual_loss = loss.map(|loss| loss.best);
        let overturns = states
            .iter()
            .find(|one| one.limit_state == LimitState::Overturns);
        let casualties = |rate: f64| {
            cost.and_then(|cost| Some(cost.quantity * cost.casualty_probability? * rate))
        };
        let expected_annual_casualties =
            overturns.and_then(|one| casualties(one.rates.annual_rate?));
        let least_casualties = casualties(overturns.and_then(StateRisk::known).unwrap_or(0.0));
        let lower = casualties(overturns.map_or(0.0, |one| one.rates.annual_rate_lower));
        let upper = overturns.and_then(|one| casualties(one.rates.annual_rate_upper?));
        let casualty_bounds = lower.map(|lower| (lower, upper));
        let deaggregation = curves
            .curves
            .last()
            .map_or(Vec::new(), |curve| deaggregation(hazard, curve.kind));
        Self {
            id: curves.id.clone(),
            curves: curves.clone(),
            states,
            deaggregation,
            accepted_rate,
            accepted_exceed_rate,
            verdict,
            is_certain,
            why,
            cost: cost.cloned(),
            expected_annual_loss,
            loss,
            is_at_least,
            expected_annual_casualties,
            least_casualties,
            casualty_bounds,
            not_counted,
        }
    }

    /// A limit state; `None` without its curve.
    pub fn state(&self, limit_state: LimitState) -> Option<&StateRisk> {
        self.states
            .iter()
            .find(|one| one.limit_state == limit_state)
    }

    /// Whether it may overturn more often than is counted, or nothing tells how often.
    pub fn may_overturn_more(&self) -> bool {
        self.state(LimitState::Overturns)
            .is_none_or(StateRisk::is_at_least)
    }

    /// The accepted rates that a verdict is about: those that are not kept, or all of them if they are.
    pub fn named_limits(&self) -> Vec<Limit> {
        let accepted = [self.accepted_exceed_rate, self.accepted_rate];
        let limits = LOSS_STATES
            .into_iter()
            .zip(accepted)
            .filter_map(|(limit_state, accepted)| {
                let (found, accepted) = (self.state(limit_state), accepted?);
                let known = found.and_then(StateRisk::known);
                let most = found.and_then(|one| one.rates.most());
                let most = most.filter(|most| {
                    *most > accepted && known.is_some_and(|known| known <= accepted)
                });
                Some(Limit {
                    limit_state,
                    accepted,
                    annual_rate: most.or(known),
                    is_most: most.is_some(),
                })
            });
        let (broken, kept): (Vec<Limit>, Vec<Limit>) = limits.partition(Limit::is_broken);
        if broken.is_empty() { kept } else { broken }
    }

    /// Its rows of `risk.csv`.
    pub fn rows(&self, years: f64) -> Vec<Facts<'_>> {
        let rows = self.states.iter().map(|one| {
            Facts::default()
                .key("id", self.id.as_str())
                .key("limit_state", one.limit_state.name())
                .key("annual_rate", one.rates.annual_rate)
                .key("annual_rate_lower", one.rates.annual_rate_lower)
                .key("annual_rate_upper", one.rates.told_upper())
                .key("annual_rate_ci95_low", one.ci95.map(|ends| ends.0))
                .key("annual_rate_ci95_high", one.ci95.map(|ends| ends.1))
                .key("annual_rate_in_table", one.rates.annual_rate_in_table)
                .key("is_bound", one.rates.is_bound())
                .key("is_at_least", one.rates.is_at_least())
                .key("is_at_most", one.rates.is_at_most())
                .key("probability", one.probability)
                .key("years", years)
                .key("verdict", self.verdict.map(<&str>::from))
                .key("expected_annual_loss", self.expected_annual_loss)
                .key(
                    "expected_annual_loss_lower",
                    self.loss.map(|loss| loss.least),
                )
                .key(
                    "expected_annual_loss_upper",
                    self.loss.and_then(|loss| loss.most),
                )
        });
        rows.collect()
    }
}

answer_of!(StateRisk as state {
    limit_state: &'static str = state.limit_state.name();
    annual_rate: Option<f64> = state.rates.annual_rate;
    annual_rate_lower: f64 = state.rates.annual_rate_lower;
    annual_rate_upper: Option<f64> = state.rates.told_upper();
    /// The part of the rate that the hazard table covers.
    annual_rate_in_table: Option<f64> = state.rates.annual_rate_in_table;
    is_bound: bool = state.rates.is_bound();
    is_at_least: bool = state.rates.is_at_least();
    is_at_most: bool = state.rates.is_at_most();
    annual_rate_below_first_point: f64 = state.rates.below_first;
    /// The 95 % interval over the motions, with the bounds that the runs leave.
    annual_rate_ci95: Option<[f64; 2]> = state.ci95.map(Into::into);
    /// The chance in these years.
    probability: Option<f64> = state.probability;
    years: f64 = state.years;
});

/// The interval over the motions together with the bounds that the runs leave, and not above the most that
/// a milder limit state allows; `None` where there is no upper end.
fn joined(
    (low, high): (f64, f64),
    by_runs: Option<(f64, Option<f64>)>,
    most: Option<f64>,
) -> Option<(f64, f64)> {
    let (low, high) = match by_runs {
        Some((least, upper)) => (low.min(least), high.max(upper?)),
        None => (low, high),
    };
    let high = most.map_or(high, |most| most.min(high));
    Some((low.min(high), high))
}

/// What is known about the accepted rates of an object.
#[derive(Debug, Clone, PartialEq, Default)]
struct Judged {
    /// `None` without an accepted rate, or where a rate is not known and no other exceeds its own.
    verdict: Option<RiskVerdict>,
    is_certain: Option<bool>,
    /// Why there is no verdict on an accepted rate.
    why: Option<Unjudged>,
}

fn judged(states: &[StateRisk], accepted: Option<f64>, accepted_exceed: Option<f64>) -> Judged {
    let mut found: Vec<(RiskVerdict, Option<bool>)> = Vec::new();
    let mut why = None;
    for (state, accepted) in LOSS_STATES.into_iter().zip([accepted_exceed, accepted]) {
        let Some(accepted) = accepted else { continue };
        let one = states.iter().find(|one| one.limit_state == state);
        match one.and_then(|one| Some((one.verdict(accepted)?, one.is_certain(accepted)))) {
            Some(here) => found.push(here),
            None => {
                why = why.or(Some(match one {
                    Some(_) => Unjudged::UnknownRate(state),
                    None => Unjudged::NoCurve(state),
                }));
            }
        }
    }
    let exceeds = found
        .iter()
        .any(|(verdict, _)| *verdict == RiskVerdict::Exceeds);
    let verdict = match (exceeds, why) {
        (true, _) => Some(RiskVerdict::Exceeds),
        (false, None) if !found.is_empty() => Some(RiskVerdict::Accepted),
        _ => None,
    };
    let both = |a: Option<bool>, b: Option<bool>| match (a, b) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    };
    let is_certain = verdict.and(found.iter().map(|one| one.1).reduce(both).flatten());
    Judged {
        verdict,
        is_certain,
        why,
    }
}

/// How often a limit state is reached: the least that it can be, and the most; `None` where nothing
/// bounds it \[1/year\].
#[derive(Debug, Clone, Copy, PartialEq)]
struct Interval {
    least: f64,
    /// What is stated.
    best: f64,
    most: Option<f64>,
}

impl Interval {
    fn known(rate: f64) -> Self {
        Self {
            least: rate,
            best: rate,
            most: Some(rate),
        }
    }
}

/// An expected annual loss: the least that it can be, and the most; `None` where nothing bounds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LossBounds {
    /// The least.
    pub least: f64,
    /// What is stated: by the rates that are known, and the least of the others.
    pub best: f64,
    /// The most; `None` where nothing bounds it.
    pub most: Option<f64>,
}

impl LossBounds {
    /// A loss is known to 10 %, as its rates are.
    const BOUND_RATIO: f64 = 1.1;

    /// Whether only bounds are known.
    pub fn is_bound(&self) -> bool {
        self.most
            .is_none_or(|most| most > Self::BOUND_RATIO * self.least)
    }

    /// The loss that is stated: what has no most is *at least* its least.
    pub fn stated(&self, is_at_least: bool) -> f64 {
        if is_at_least { self.least } else { self.best }
    }
}

/// What an option leaves of the loss of an object, and what it avoids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Avoided {
    /// Expected annual loss with the option.
    pub after: LossBounds,
    /// The least annual loss that the option avoids; `None` where nothing bounds the loss with it.
    pub least: Option<f64>,
    /// The annual loss that it avoids by the stated losses.
    pub best: f64,
    /// Whether it may avoid more.
    pub is_at_least: bool,
    /// The least number of falls a year that it avoids; `None` where nothing tells.
    pub falls: Option<f64>,
}

/// The rates of both states of losses, [`LOSS_STATES`]; `None` without a curve.
fn loss_rates(curves: &ObjectCurves, factor: f64, hazard: &Hazard) -> [Option<AnnualRates>; 2] {
    let all = object_rates(curves, factor, hazard);
    LOSS_STATES.map(|state| {
        all.iter()
            .find(|one| one.limit_state == state)
            .map(|one| one.rates)
    })
}

/// The ends of a rate. Motions below the first point of the hazard count for nothing, and bound nothing.
fn ends_of(rates: AnnualRates) -> Interval {
    let AnnualRates {
        annual_rate,
        annual_rate_lower: least,
        ..
    } = rates;
    let most = rates.told_upper();
    match annual_rate {
        Some(rate) if rates.is_bound() => Interval {
            least,
            best: rate,
            most,
        },
        Some(rate) => Interval::known(rate),
        None => Interval {
            least,
            best: least,
            most,
        },
    }
}

/// Expected annual loss between the ends of the rates of exceeding and of overturning. An object
/// overturns at most as often as its tolerance is exceeded, if it has a tolerance.
///
/// The loss q \[(λ_e − λ_o)⁺ C_e + λ_o C_o\] rises with λ_e, and as a function of λ_o it is convex with
/// one corner, at λ_o = λ_e: it is largest at an end of λ_o, and least at an end or at the corner.
fn loss_between(
    [exceeds, overturns]: [Option<Interval>; 2],
    has_exceeds: bool,
    cost: &CostRow,
) -> LossBounds {
    let unknown = Interval {
        least: 0.0,
        best: 0.0,
        most: None,
    };
    let exceeds = has_exceeds.then(|| exceeds.unwrap_or(unknown));
    let mut overturns = overturns.unwrap_or(unknown);
    // What is known may contradict itself where curves were fitted separately; what is not, cannot.
    if overturns.most != Some(overturns.least) {
        let bound = exceeds
            .and_then(|exceeds| exceeds.most)
            .map(|most| most.max(overturns.least));
        overturns.most = [overturns.most, bound]
            .into_iter()
            .flatten()
            .reduce(f64::min);
    }
    let repair = if has_exceeds {
        cost.repair.unwrap_or(0.0)
    } else {
        0.0
    };
    let of = |exceeds: f64, overturns: f64| {
        expected_annual_loss(cost.quantity, exceeds, overturns, repair, cost.overturned())
    };
    let exceeds = exceeds
        .filter(|_| repair > 0.0)
        .unwrap_or(Interval::known(0.0));
    let corner = exceeds
        .least
        .min(overturns.most.unwrap_or(f64::INFINITY))
        .max(overturns.least);
    let least = of(exceeds.least, overturns.least).min(of(exceeds.least, corner));
    let most = match (exceeds.most, overturns.most) {
        (Some(exceeds), Some(most)) => Some(of(exceeds, overturns.least).max(of(exceeds, most))),
        // Nothing overturns for nothing.
        (Some(exceeds), None) if cost.overturned() == 0.0 => Some(of(exceeds, overturns.least)),
        _ => None,
    };
    LossBounds {
        least,
        best: of(exceeds.best, overturns.best),
        most,
    }
}

/// Expected annual loss of an object. A rate that is not known counts with the least and with the most
/// that it can be.
pub(crate) fn loss_of(curves: &ObjectCurves, cost: &CostRow, hazard: &Hazard) -> LossBounds {
    let rates = loss_rates(curves, 1.0, hazard);
    loss_between(
        rates.map(|rates| rates.map(ends_of)),
        curves.curve(LimitState::Exceeds).is_some(),
        cost,
    )
}

/// The loss that an option avoids: the least one, which is the least loss of the object without the
/// option less the largest one with it.
///
/// Either part alone would prove nothing. A rate that is not known counts with its lower bound
/// without the option and with its upper bound with it, so that the difference is the least that the
/// option can avoid, whichever of the rates is not known. Where no bound of the loss with the option
/// is known, nothing is known about what it avoids. Where an option multiplies medians by 1 or more,
/// the object fails no more often with it, whatever its curve: a difference below 0 then counts as 0
/// (if overturning costs no less than a repair).
///
/// Motions below the first point of the hazard count neither without the option nor with it, unless
/// they would add more to the rate with it: the difference is then a loss that it causes. A step
/// counts in the middle of its ends, as everywhere.
pub(crate) fn avoided(
    curves: &ObjectCurves,
    effect: &Effect,
    cost: &CostRow,
    hazard: &Hazard,
) -> Avoided {
    let before = loss_of(curves, cost, hazard);
    let without = loss_rates(curves, 1.0, hazard);
    let (changed, factor) = match effect {
        Effect::MedianFactor(factor) => (curves, *factor),
        Effect::Curves(other) => (other, 1.0),
    };
    let with = loss_rates(changed, factor, hazard);
    let has_exceeds = [curves, changed]
        .iter()
        .any(|curves| curves.curve(LimitState::Exceeds).is_some());
    let after = loss_between(with.map(|rates| rates.map(ends_of)), has_exceeds, cost);
    let mut charged = with.map(|rates| rates.map(ends_of));
    for ((end, with), without) in charged.iter_mut().zip(with).zip(without) {
        let (Some(end), Some(with)) = (end, with) else {
            continue;
        };
        if with.begins_too_high() {
            let excess = with.below_first - without.map_or(0.0, |rates| rates.below_first);
            end.most = Some(end.least + excess.max(0.0));
        }
    }
    let charged = loss_between(charged, has_exceeds, cost);
    let best = before.best - after.best;
    let is_exact = |loss: &LossBounds| loss.most == Some(loss.least);
    let mut least = charged.most.map(|most| before.least - most);
    if let Effect::MedianFactor(factor) = *effect
        && factor >= 1.0
        && cost.overturned() >= cost.repair.unwrap_or(0.0)
    {
        least = least.map(|least| least.max(0.0));
        if !(is_exact(&before) && is_exact(&charged)) {
            least = avoided_by_factor(curves, factor, cost, hazard)
                .map(|more| more.min(best.max(0.0)))
                .into_iter()
                .chain(least)
                .reduce(f64::max);
        }
    }
    let [_, of_fall] = LOSS_STATES;
    let falls = match effect {
        Effect::MedianFactor(factor) if *factor >= 1.0 => {
            least_fall(curves, of_fall, *factor, hazard)
        }
        _ => without[1]
            .zip(with[1])
            .and_then(|(without, with)| Some(ends_of(without).least - ends_of(with).most?)),
    };
    let falls = falls.map(|falls| cost.quantity * falls);
    Avoided {
        after,
        least,
        best,
        is_at_least: !is_exact(&before) || !is_exact(&charged),
        falls,
    }
}

/// The least loss that is avoided where every median is multiplied by `factor` ≥ 1, and overturning costs
/// no less than a repair: q \[C_e Δλ_e + (C_o − C_e) Δλ_o\] with the least fall of each rate.
fn avoided_by_factor(
    curves: &ObjectCurves,
    factor: f64,
    cost: &CostRow,
    hazard: &Hazard,
) -> Option<f64> {
    let [exceeds, overturns] = LOSS_STATES;
    let repair = cost
        .repair
        .filter(|_| curves.curve(exceeds).is_some())
        .unwrap_or(0.0);
    let fall = |state, price: f64| {
        if price == 0.0 {
            Some(0.0)
        } else {
            least_fall(curves, state, factor, hazard)
        }
    };
    let of_repair = repair * fall(exceeds, repair)?;
    let more = cost.overturned() - repair;
    Some(cost.quantity * (of_repair + more * fall(overturns, more)?))
}

#[cfg(test)]
mod tests;
