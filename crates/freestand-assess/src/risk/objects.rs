//! The risk of one object.

use freestand::fragility::{CurveKind, LimitState, percentiles};
use freestand::risk::{Bin, Hazard, annual_rate, deaggregation, expected_annual_loss, probability_in_years};
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
    pub(crate) annual_rate: Option<f64>,
    pub(crate) annual_rate_upper: Option<f64>,
    pub(crate) ci95: Option<(f64, f64)>,
    /// Whether samples were drawn and tell no interval.
    pub(crate) lacks_interval: bool,
    pub(crate) probability: Option<f64>,
    pub(crate) years: f64,
}

impl StateRisk {
    pub(crate) fn words(&self, years: &str) -> String {
        match (self.annual_rate, self.annual_rate_upper) {
            (Some(rate), upper) => {
                let words = rate_words(rate, self.ci95, self.probability.unwrap_or(0.0), years);
                // What the hazard beyond its last point might add.
                match upper.filter(|upper| *upper > 1.01 * rate) {
                    Some(upper) => format!("{words}; up to {} a year", number(upper, 3)),
                    None => words,
                }
            }
            (None, Some(upper)) => format!("not known, at most {} a year", number(upper, 3)),
            (None, None) => "not known".to_owned(),
        }
    }
}

/// An accepted rate, and the rate that it is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Limit {
    pub(crate) limit_state: LimitState,
    /// \[1/year\]
    pub(crate) accepted: f64,
    /// `None`: not known \[1/year\].
    pub(crate) annual_rate: Option<f64>,
}

impl Limit {
    /// The rate over the accepted one; 0 where it is not known.
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
                    annual_rate: rates.annual_rate,
                    annual_rate_upper: rates.annual_rate_upper,
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
            |state: LimitState| states.iter().any(|one| one.limit_state == state && one.annual_rate.is_none());
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
            Some(cost.quantity * cost.casualty_probability? * overturns.and_then(|one| one.annual_rate)?)
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
                    .key("annual_rate", one.annual_rate)
                    .key("annual_rate_upper", one.annual_rate_upper)
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
            .key("expected_annual_casualties", self.expected_annual_casualties)
            .key("not_counted", self.not_counted.clone())
    }

    /// The accepted rates that a verdict is about: those that are not kept, or all of them if they are.
    pub(crate) fn named_limits(&self) -> Vec<Limit> {
        let accepted = [self.accepted_exceed_rate, self.accepted_rate];
        let limits = LOSS_STATES.into_iter().zip(accepted).filter_map(|(limit_state, accepted)| {
            let found = self.states.iter().find(|one| one.limit_state == limit_state);
            Some(Limit { limit_state, accepted: accepted?, annual_rate: found.and_then(|one| one.annual_rate) })
        });
        let (broken, kept): (Vec<Limit>, Vec<Limit>) = limits.partition(Limit::is_broken);
        if broken.is_empty() { kept } else { broken }
    }

    pub(crate) fn rows(&self, years: f64) -> Vec<Facts<'_>> {
        let rows = self.states.iter().map(|one| {
            Facts::default()
                .key("id", self.id.as_str())
                .key("limit_state", one.limit_state.name())
                .key("annual_rate", one.annual_rate)
                .key("annual_rate_upper", one.annual_rate_upper)
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
    let mut is_certain = true;
    for (state, accepted) in LOSS_STATES.into_iter().zip([accepted_exceed, accepted]) {
        let Some(accepted) = accepted else { continue };
        let Some(one) = states.iter().find(|one| one.limit_state == state) else { return (None, None) };
        let here = match (one.annual_rate, one.annual_rate_upper) {
            (Some(rate), upper) => {
                let straddles = one.ci95.is_some_and(|(low, high)| low <= accepted && accepted <= high);
                let may_be_more = rate <= accepted && upper.is_none_or(|upper| upper > accepted);
                is_certain &= !straddles && !may_be_more && !one.lacks_interval;
                if rate > accepted { RiskVerdict::Exceeds } else { RiskVerdict::Accepted }
            }
            (None, Some(upper)) if upper <= accepted => RiskVerdict::Accepted,
            (None, _) => return (None, None),
        };
        verdict = match (verdict, here) {
            (Some(RiskVerdict::Exceeds), _) => verdict,
            _ => Some(here),
        };
    }
    (verdict, verdict.map(|_| is_certain))
}

/// Expected annual loss of an object whose curves an option changes.
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
        curve.and_then(|kind| annual_rate(hazard, kind).annual_rate)
    };
    let overturns = rate(LimitState::Overturns).unwrap_or(0.0);
    let exceeds = rate(LimitState::Exceeds).unwrap_or(overturns);
    expected_annual_loss(cost.quantity, exceeds, overturns, cost.repair.unwrap_or(0.0), cost.overturned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(limit_state: LimitState, rate: Option<f64>, upper: f64, ci95: Option<(f64, f64)>) -> StateRisk {
        StateRisk {
            limit_state,
            annual_rate: rate,
            annual_rate_upper: Some(upper),
            ci95,
            lacks_interval: false,
            probability: None,
            years: 50.0,
        }
    }

    #[test]
    fn verdicts_follow_the_accepted_rates() {
        let overturns = |rate, upper, ci95| [state(LimitState::Overturns, rate, upper, ci95)];
        let judged = |states: &[StateRisk], accepted| super::judged(states, accepted, None);
        let (accepted, exceeds) = (Some(RiskVerdict::Accepted), Some(RiskVerdict::Exceeds));
        assert_eq!(judged(&overturns(Some(1e-4), 1e-4, None), None), (None, None));
        assert_eq!(judged(&overturns(Some(1e-4), 1e-4, None), Some(1e-3)), (accepted, Some(true)));
        assert_eq!(judged(&overturns(Some(1e-4), 2e-3, None), Some(1e-3)), (accepted, Some(false)));
        assert_eq!(judged(&overturns(Some(1e-4), 1e-4, Some((1e-5, 2e-3))), Some(1e-3)), (accepted, Some(false)));
        assert_eq!(judged(&overturns(Some(2e-3), 2e-3, None), Some(1e-3)), (exceeds, Some(true)));
        assert_eq!(judged(&overturns(None, 5e-4, None), Some(1e-3)), (accepted, Some(true)));
        assert_eq!(judged(&overturns(None, 5e-3, None), Some(1e-3)), (None, None));
        let both =
            [state(LimitState::Exceeds, Some(0.1), 0.1, None), state(LimitState::Overturns, Some(1e-4), 1e-4, None)];
        assert_eq!(super::judged(&both, Some(1e-3), Some(1e-2)), (exceeds, Some(true)));
        assert_eq!(super::judged(&both[1..], Some(1e-3), Some(1e-2)), (None, None));
    }
}
