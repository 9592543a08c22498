//! The risk of one object.

use freestand::fragility::{CurveKind, LimitState, percentiles};
use freestand::risk::{
    AnnualRates, Bin, Hazard, annual_rate, deaggregation, expected_annual_loss, probability_in_years,
};
use freestand_input::words::number;
use freestand_output::facts::Facts;

use crate::fragility::{ObjectCurves, ObjectFragility, ends};

use super::costs::{CostRow, Effect};
use super::{LOSS_STATES, rate_words};

/// Whether an object fails more often than accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RiskVerdict {
    Accepted,
    Exceeds,
}

impl RiskVerdict {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Accepted => "accepted",
            Self::Exceeds => "exceeds",
        }
    }

    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Accepted => "accepted",
            Self::Exceeds => "more often than accepted",
        }
    }
}

/// How often a limit state is reached.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StateRisk {
    pub(crate) limit_state: LimitState,
    pub(crate) rates: AnnualRates,
    pub(crate) ci95: Option<(f64, f64)>,
    /// Whether samples were drawn and tell no interval.
    pub(crate) lacks_interval: bool,
    pub(crate) probability: Option<f64>,
    pub(crate) years: f64,
}

impl StateRisk {
    pub(crate) fn words(&self, years: &str) -> String {
        let AnnualRates { annual_rate, annual_rate_lower, annual_rate_upper, .. } = self.rates;
        let at_most = |most: f64| annual_rate_upper.filter(|upper| *upper > most);
        let Some(rate) = annual_rate else {
            let least =
                (annual_rate_lower > 0.0).then(|| format!(", at least {} a year", number(annual_rate_lower, 3)));
            let most = at_most(0.0).map(|upper| format!(", at most {} a year", number(upper, 3)));
            return format!("not known{}{}", least.unwrap_or_default(), most.unwrap_or_default());
        };
        let least = if self.rates.begins_too_high() { "at least " } else { "" };
        let words = rate_words(rate, self.ci95, self.probability.unwrap_or(0.0), years);
        // The upper bound: motions beyond the last point of the hazard, or the lower end of a step.
        let most = at_most(1.01 * rate).map(|upper| format!("; up to {} a year", number(upper, 3)));
        format!("{least}{words}{}", most.unwrap_or_default())
    }

    /// Whether the rate is certainly below or certainly above the accepted one; `None` if its
    /// uncertainty is not known.
    fn is_certain(&self, accepted: f64) -> Option<bool> {
        let AnnualRates { annual_rate, annual_rate_lower, annual_rate_upper, below_first } = self.rates;
        let rate = annual_rate?;
        let straddles = |low: f64, high: f64| low <= accepted && accepted <= high;
        let is_open = straddles(annual_rate_lower, rate)
            || rate <= accepted && annual_rate_upper.is_none_or(|upper| upper > accepted)
            || rate <= accepted && rate + below_first > accepted
            || self.ci95.is_some_and(|(low, high)| straddles(low, high))
            || self.lacks_interval;
        if is_open { Some(false) } else { self.ci95.map(|_| true) }
    }

    /// The verdict; `None` if neither the rate nor its bounds decide.
    fn verdict(&self, accepted: f64) -> Option<RiskVerdict> {
        let AnnualRates { annual_rate, annual_rate_lower, annual_rate_upper, .. } = self.rates;
        let exceeds = |rate: f64| if rate > accepted { RiskVerdict::Exceeds } else { RiskVerdict::Accepted };
        annual_rate
            .map(exceeds)
            .or((annual_rate_lower > accepted).then_some(RiskVerdict::Exceeds))
            .or(annual_rate_upper.filter(|upper| *upper <= accepted).map(exceeds))
    }

    /// The rate, or its lower bound if only that is known.
    fn known(&self) -> Option<f64> {
        self.rates.annual_rate.or((self.rates.annual_rate_lower > 0.0).then_some(self.rates.annual_rate_lower))
    }

    /// Whether the limit state may be reached more often than is counted.
    fn is_at_least(&self) -> bool {
        self.rates.annual_rate.is_none() || self.rates.begins_too_high()
    }
}

/// An accepted rate, and the rate that it is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Limit {
    pub(crate) limit_state: LimitState,
    /// The accepted rate \[1/year\].
    pub(crate) accepted: f64,
    /// The rate \[1/year\]; `None` if it is not known.
    pub(crate) annual_rate: Option<f64>,
}

impl Limit {
    /// The rate divided by the accepted one; 0 if the rate is not known.
    pub(crate) fn ratio(&self) -> f64 {
        self.annual_rate.map_or(0.0, |rate| rate / self.accepted)
    }

    fn is_broken(&self) -> bool {
        self.annual_rate.is_some_and(|rate| rate > self.accepted)
    }
}

/// The risk of one object.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ObjectRisk {
    pub(crate) id: String,
    pub(crate) curves: ObjectCurves,
    pub(crate) states: Vec<StateRisk>,
    pub(crate) deaggregation: Vec<Bin>,
    pub(crate) accepted_rate: Option<f64>,
    pub(crate) accepted_exceed_rate: Option<f64>,
    pub(crate) verdict: Option<RiskVerdict>,
    pub(crate) is_certain: Option<bool>,
    pub(crate) cost: Option<CostRow>,
    pub(crate) expected_annual_loss: Option<f64>,
    /// Whether the rates, and with them the loss, may be larger than those that are counted.
    pub(crate) is_at_least: bool,
    /// Casualties per year; `None` where their probability or the rate of overturning is not known.
    pub(crate) expected_annual_casualties: Option<f64>,
    pub(crate) not_counted: Vec<&'static str>,
}

impl ObjectRisk {
    pub(crate) fn new(
        curves: &ObjectCurves,
        fit: Option<&ObjectFragility>,
        cost: Option<&CostRow>,
        hazard: &Hazard,
        years: f64,
        accepted: Option<f64>,
    ) -> Self {
        let states: Vec<StateRisk> = curves
            .curves
            .iter()
            .map(|curve| {
                let rates = annual_rate(hazard, curve.kind);
                let samples = fit.and_then(|fit| fit.bootstrap.as_ref());
                let is_lognormal = matches!(curve.kind, CurveKind::Lognormal { .. });
                let lacks = samples.filter(|_| is_lognormal).and_then(|one| one.lacks_interval(curve.limit_state));
                let is_known = is_lognormal && lacks.is_none();
                let ci95 = samples.filter(|_| is_known).and_then(|samples| {
                    let rate = |(median, beta)| annual_rate(hazard, CurveKind::Lognormal { median, beta }).annual_rate;
                    percentiles(samples.lognormals(curve.limit_state).filter_map(rate).collect())
                });
                StateRisk {
                    limit_state: curve.limit_state,
                    rates,
                    ci95,
                    lacks_interval: lacks.is_some(),
                    probability: rates.annual_rate.map(|rate| probability_in_years(rate, years)),
                    years,
                }
            })
            .collect();
        let accepted_rate = cost.and_then(|cost| cost.accepted_rate).or(accepted);
        let accepted_exceed_rate = cost.and_then(|cost| cost.accepted_exceed_rate);
        let (verdict, is_certain) = judged(&states, accepted_rate, accepted_exceed_rate);
        let mut not_counted = cost.map_or(Vec::new(), CostRow::not_counted);
        let has_exceeds = curves.curve(LimitState::Exceeds).is_some();
        if cost.is_some_and(|cost| cost.repair.is_some()) && !has_exceeds {
            not_counted.push("repair_cost (there is no curve of exceeding)");
        }
        let unknown =
            |state: LimitState| states.iter().any(|one| one.limit_state == state && one.rates.annual_rate.is_none());
        let is_at_least = states.iter().any(|one| LOSS_STATES.contains(&one.limit_state) && one.is_at_least());
        for (state, words) in [
            (LimitState::Exceeds, "exceeding (its rate is not known)"),
            (LimitState::Overturns, "overturning (its rate is not known)"),
        ] {
            if cost.is_some() && unknown(state) {
                not_counted.push(words);
            }
        }
        let expected_annual_loss =
            cost.filter(|cost| cost.has_costs()).map(|cost| loss_of(curves, &Effect::MedianFactor(1.0), cost, hazard));
        let overturns = states.iter().find(|one| one.limit_state == LimitState::Overturns);
        let expected_annual_casualties = cost.and_then(|cost| {
            Some(cost.quantity * cost.casualty_probability? * overturns.and_then(|one| one.rates.annual_rate)?)
        });
        let deaggregation = curves.curves.last().map_or(Vec::new(), |curve| deaggregation(hazard, curve.kind));
        Self {
            id: curves.id.clone(),
            curves: curves.clone(),
            states,
            deaggregation,
            accepted_rate,
            accepted_exceed_rate,
            verdict,
            is_certain,
            cost: cost.cloned(),
            expected_annual_loss,
            is_at_least,
            expected_annual_casualties,
            not_counted,
        }
    }

    pub(crate) fn facts(&self) -> Facts<'static> {
        let states: Vec<Facts> = self
            .states
            .iter()
            .map(|one| {
                Facts::default()
                    .key("limit_state", one.limit_state.name())
                    .key("annual_rate", one.rates.annual_rate)
                    .key("annual_rate_lower", one.rates.annual_rate_lower)
                    .key("annual_rate_upper", one.rates.annual_rate_upper)
                    .key("annual_rate_below_first_point", one.rates.below_first)
                    .key("annual_rate_ci95", ends(one.ci95))
                    .key("probability", one.probability)
                    .key("years", one.years)
            })
            .collect();
        let bins: Vec<Facts> = self
            .deaggregation
            .iter()
            .map(|bin| {
                Facts::default()
                    .key("im_low", bin.low)
                    .key("im_high", bin.high)
                    .key("annual_rate", bin.annual_rate)
                    .key("share", bin.share)
            })
            .collect();
        Facts::default()
            .key("id", self.id.clone())
            .key("limit_states", states)
            .key("deaggregation", bins)
            .key("accepted_annual_rate", self.accepted_rate)
            .key("accepted_exceed_annual_rate", self.accepted_exceed_rate)
            .key("verdict", self.verdict.map(RiskVerdict::name))
            .key("certain", self.is_certain)
            .key("expected_annual_loss", self.expected_annual_loss)
            .key("is_at_least", self.is_at_least)
            .key("expected_annual_casualties", self.expected_annual_casualties)
            .key("not_counted", self.not_counted.clone())
    }

    /// The words after a verdict that is not certain.
    pub(crate) fn uncertainty_words(&self) -> &'static str {
        match self.is_certain {
            Some(true) => "",
            Some(false) => ", not certain",
            None => ", uncertainty not known",
        }
    }

    /// The accepted rates that a verdict is about: those that are not kept, or all of them if they are.
    pub(crate) fn named_limits(&self) -> Vec<Limit> {
        let accepted = [self.accepted_exceed_rate, self.accepted_rate];
        let limits = LOSS_STATES.into_iter().zip(accepted).filter_map(|(limit_state, accepted)| {
            let found = self.states.iter().find(|one| one.limit_state == limit_state);
            Some(Limit { limit_state, accepted: accepted?, annual_rate: found.and_then(StateRisk::known) })
        });
        let (broken, kept): (Vec<Limit>, Vec<Limit>) = limits.partition(Limit::is_broken);
        if broken.is_empty() { kept } else { broken }
    }

    pub(crate) fn rows(&self, years: f64) -> Vec<Facts<'_>> {
        let rows = self.states.iter().map(|one| {
            Facts::default()
                .key("id", self.id.as_str())
                .key("limit_state", one.limit_state.name())
                .key("annual_rate", one.rates.annual_rate)
                .key("annual_rate_lower", one.rates.annual_rate_lower)
                .key("annual_rate_upper", one.rates.annual_rate_upper)
                .key("annual_rate_ci95_low", one.ci95.map(|ends| ends.0))
                .key("annual_rate_ci95_high", one.ci95.map(|ends| ends.1))
                .key("probability", one.probability)
                .key("years", years)
                .key("verdict", self.verdict.map(RiskVerdict::name))
                .key("expected_annual_loss", self.expected_annual_loss)
        });
        rows.collect()
    }
}

/// The verdict, and whether it is certain; `None` without an accepted rate, or where a rate is not
/// known.
fn judged(
    states: &[StateRisk],
    accepted: Option<f64>,
    accepted_exceed: Option<f64>,
) -> (Option<RiskVerdict>, Option<bool>) {
    let mut verdict = None;
    let mut is_certain = Some(true);
    for (state, accepted) in LOSS_STATES.into_iter().zip([accepted_exceed, accepted]) {
        let Some(accepted) = accepted else { continue };
        let found = states.iter().find(|one| one.limit_state == state);
        let Some((one, here)) = found.and_then(|one| Some((one, one.verdict(accepted)?))) else { return (None, None) };
        is_certain = match (is_certain, one.is_certain(accepted)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        };
        verdict = match (verdict, here) {
            (Some(RiskVerdict::Exceeds), _) => verdict,
            _ => Some(here),
        };
    }
    (verdict, verdict.and(is_certain))
}

/// Expected annual loss of an object whose curves an option changes. For a rate that is not known,
/// its lower bound is used.
pub(crate) fn loss_of(curves: &ObjectCurves, effect: &Effect, cost: &CostRow, hazard: &Hazard) -> f64 {
    let changed = |kind: CurveKind, factor: f64| match kind {
        CurveKind::Lognormal { median, beta } => CurveKind::Lognormal { median: factor * median, beta },
        CurveKind::Step { lower, upper } => CurveKind::Step { lower: factor * lower, upper: factor * upper },
        CurveKind::Bounds { lower, upper } => {
            CurveKind::Bounds { lower: lower.map(|lower| factor * lower), upper: upper.map(|upper| factor * upper) }
        }
        CurveKind::None { lower } => CurveKind::None { lower: factor * lower },
        CurveKind::All { upper } => CurveKind::All { upper: factor * upper },
        CurveKind::NotIncreasing { lower, upper } => {
            CurveKind::NotIncreasing { lower: factor * lower, upper: factor * upper }
        }
    };
    let rate = |state: LimitState| {
        let curve = match effect {
            Effect::MedianFactor(factor) => curves.curve(state).map(|kind| changed(kind, *factor)),
            Effect::Curves(other) => other.curve(state),
        };
        curve.map(|kind| {
            let rates = annual_rate(hazard, kind);
            rates.annual_rate.unwrap_or(rates.annual_rate_lower)
        })
    };
    let overturns = rate(LimitState::Overturns).unwrap_or(0.0);
    let exceeds = rate(LimitState::Exceeds).unwrap_or(overturns);
    expected_annual_loss(cost.quantity, exceeds, overturns, cost.repair.unwrap_or(0.0), cost.overturned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(
        limit_state: LimitState,
        rate: Option<f64>,
        (lower, upper): (f64, f64),
        ci95: Option<(f64, f64)>,
    ) -> StateRisk {
        StateRisk {
            limit_state,
            rates: AnnualRates {
                annual_rate: rate,
                annual_rate_lower: lower,
                annual_rate_upper: Some(upper),
                below_first: 0.0,
            },
            ci95,
            lacks_interval: false,
            probability: None,
            years: 50.0,
        }
    }

    #[test]
    fn verdicts_follow_the_accepted_rates() {
        let overturns = |rate, ends, ci95| [state(LimitState::Overturns, rate, ends, ci95)];
        let judged = |states: &[StateRisk], accepted| super::judged(states, accepted, None);
        let (accepted, exceeds) = (Some(RiskVerdict::Accepted), Some(RiskVerdict::Exceeds));
        let (same, narrow) = ((1e-4, 1e-4), Some((5e-5, 2e-4)));
        assert_eq!(judged(&overturns(Some(1e-4), same, narrow), None), (None, None));
        assert_eq!(judged(&overturns(Some(1e-4), same, narrow), Some(1e-3)), (accepted, Some(true)));
        assert_eq!(judged(&overturns(Some(1e-4), (1e-4, 2e-3), narrow), Some(1e-3)), (accepted, Some(false)));
        assert_eq!(judged(&overturns(Some(1e-4), same, Some((1e-5, 2e-3))), Some(1e-3)), (accepted, Some(false)));
        assert_eq!(
            judged(&overturns(Some(2e-3), (2e-3, 2e-3), Some((1.5e-3, 3e-3))), Some(1e-3)),
            (exceeds, Some(true))
        );
        // The uncertainty of a rate without an interval is not known, unless its bounds state it.
        assert_eq!(judged(&overturns(Some(1e-4), same, None), Some(1e-3)), (accepted, None));
        assert_eq!(judged(&overturns(Some(2e-3), (5e-4, 3e-3), None), Some(1e-3)), (exceeds, Some(false)));
        // If a rate is not known, its bounds decide.
        assert_eq!(judged(&overturns(None, (0.0, 5e-4), None), Some(1e-3)), (accepted, None));
        assert_eq!(judged(&overturns(None, (5e-3, 1.0), None), Some(1e-3)), (exceeds, None));
        assert_eq!(judged(&overturns(None, (0.0, 5e-3), None), Some(1e-3)), (None, None));
        // A hazard that begins too high gives only a lower bound.
        let mut cut = overturns(Some(1e-4), same, narrow);
        cut[0].rates.below_first = 2e-3;
        assert_eq!(judged(&cut, Some(1e-3)), (accepted, Some(false)));
        let both = [
            state(LimitState::Exceeds, Some(0.1), (0.1, 0.1), Some((0.05, 0.2))),
            state(LimitState::Overturns, Some(1e-4), same, narrow),
        ];
        assert_eq!(super::judged(&both, Some(1e-3), Some(1e-2)), (exceeds, Some(true)));
        assert_eq!(super::judged(&both[1..], Some(1e-3), Some(1e-2)), (None, None));
    }
}
