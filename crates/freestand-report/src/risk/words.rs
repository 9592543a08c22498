//! Rates, losses and verdicts as people read them.

use freestand::fragility::LimitState;
use freestand::risk::AnnualRates;
use freestand_input::quantity::shorten;
use freestand_input::words::{number, percent_significant};
use freestand_risk::costs::NotCounted;
use freestand_risk::objects::{LossBounds, ObjectRisk, RiskVerdict, Slopes, StateRisk, Unjudged};
use freestand_risk::report::WhyNotRun;

/// The words before a number that is a lower bound.
pub(super) fn least(is_at_least: bool) -> &'static str {
    if is_at_least { "at least " } else { "" }
}

/// A rate in words: how often, its 95 % interval if it has one, and the chance in a number of
/// years.
fn rate_words(
    rate: f64,
    ci95: Option<(f64, f64)>,
    slopes: Slopes,
    probability: f64,
    years: &str,
) -> String {
    let interval = |(low, high)| {
        let (low, high) = (number(low, 3), number(high, 3));
        match slopes {
            Slopes::Alone => {
                format!(
                    "; {low} to {high} a year for a slope of the hazard that is 0.5 smaller or larger"
                )
            }
            Slopes::Stated | Slopes::BesideMotions => {
                format!("; 95 % interval {low} to {high} a year")
            }
        }
    };
    format!(
        "{} a year ({}{}), {} in {years} years",
        number(rate, 3),
        once_in(rate).unwrap_or_else(|| "never".to_owned()),
        ci95.map_or(String::new(), interval),
        percent_significant(probability, 3)
    )
}

/// `once in 475 years`; `None` for a rate of 0.
pub(super) fn once_in(rate: f64) -> Option<String> {
    (rate > 0.0).then(|| format!("once in {} years", rounded(1.0 / rate, 3)))
}

/// A number with a few significant digits, also before the decimal point: 10900, not 10932.
pub(super) fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    number(text.parse().unwrap_or(value), digits)
}

/// The rate, the probability and the bounds, for people.
pub(super) fn state_words(state: &StateRisk, years: &str) -> String {
    let AnnualRates {
        annual_rate,
        annual_rate_lower,
        ..
    } = state.rates;
    let at_most = |most: f64| state.rates.told_upper().filter(|upper| *upper > most);
    let Some(rate) = annual_rate else {
        let least = (annual_rate_lower > 0.0)
            .then(|| format!(", at least {} a year", number(annual_rate_lower, 3)));
        let most = at_most(0.0).map(|upper| format!(", at most {} a year", number(upper, 3)));
        return format!(
            "not known{}{}",
            least.unwrap_or_default(),
            most.unwrap_or_default()
        );
    };
    // Where motions below the runs have no bound, the stated rate may be too large as well as too small.
    let is_least = state.rates.is_at_least() && annual_rate_lower >= 0.99 * rate;
    let least = if is_least { "at least " } else { "" };
    let words = rate_words(
        rate,
        state.ci95,
        state.slopes,
        state.probability.unwrap_or(0.0),
        years,
    );
    // The runs leave bounds, or motions above the last point of the hazard do, or the ends of a step.
    let is_said = state
        .ci95
        .zip(at_most(0.0))
        .is_some_and(|((_, high), most)| state.rates.is_bound() && most <= 1.01 * high);
    let bounds = if is_said {
        None
    } else if state.rates.is_bound() && annual_rate_lower < 0.99 * rate {
        let least = number(annual_rate_lower, 3);
        Some(match at_most(0.0) {
            Some(most) => format!("; between {least} and {} a year", number(most, 3)),
            None => format!("; at least {least} a year"),
        })
    } else {
        at_most(1.01 * rate).map(|upper| format!("; up to {} a year", number(upper, 3)))
    };
    format!("{least}{words}{}", bounds.unwrap_or_default())
}

/// The words after a loss of which only bounds are known.
pub(super) fn loss_words(loss: &LossBounds, unit: &str) -> String {
    match loss.most.filter(|_| loss.is_bound()) {
        Some(most) => format!(
            "; between {} and {} {unit}",
            number(loss.least, 4),
            number(most, 4)
        ),
        None => String::new(),
    }
}

/// A verdict.
pub(super) fn verdict_words(verdict: RiskVerdict) -> &'static str {
    match verdict {
        RiskVerdict::Accepted => "accepted",
        RiskVerdict::Exceeds => "more often than accepted",
    }
}

/// The words after a verdict that is not certain.
pub(super) fn uncertainty_words(object: &ObjectRisk) -> &'static str {
    match object.is_certain {
        Some(true) => "",
        Some(false) => ", not certain",
        None => ", uncertainty not known",
    }
}

/// Why an accepted rate has no verdict.
pub(super) fn why_unjudged(why: Unjudged) -> String {
    match why {
        Unjudged::NoCurve(state) => format!("there is no curve of {}", reaching(state)),
        Unjudged::UnknownRate(state) => format!("the rate of {} is not known", reaching(state)),
    }
}

/// To reach a limit state, as a noun.
pub(super) fn reaching(state: LimitState) -> &'static str {
    match state {
        LimitState::Rocks => "rocking",
        LimitState::Exceeds => "exceeding",
        LimitState::Overturns => "overturning",
    }
}

/// Why an object was not run.
pub(super) fn why_not_run(why: &WhyNotRun) -> String {
    match why {
        WhyNotRun::LeftOut(why) => why.clone(),
        WhyNotRun::Anchored(said) => {
            format!("anchored, the inventory says: {}", shorten(said))
        }
    }
}

/// A part of a loss that is not counted.
pub(super) fn not_counted(part: NotCounted) -> &'static str {
    match part {
        NotCounted::Repair => "repair_cost",
        NotCounted::Replacement => "replacement_cost",
        NotCounted::Downtime => "downtime",
        NotCounted::Casualties => "casualties",
        NotCounted::RepairWithoutCurve => "repair_cost (there is no curve of exceeding)",
        NotCounted::ExceedingOfUnknownRate => "exceeding (its rate is not known)",
        NotCounted::OverturningOfUnknownRate => "overturning (its rate is not known)",
        NotCounted::OverturningWithoutCurve => "overturning (there is no curve of it)",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(rate: Option<f64>, lower: f64, upper: Option<f64>) -> StateRisk {
        StateRisk {
            limit_state: LimitState::Overturns,
            rates: AnnualRates {
                annual_rate: rate,
                annual_rate_in_table: rate,
                annual_rate_lower: lower,
                annual_rate_upper: upper,
                below_first: 0.0,
            },
            open: None,
            ci95: None,
            slopes: Slopes::Stated,
            lacks_interval: false,
            probability: rate.map(|rate| 50.0 * rate),
            years: 50.0,
        }
    }

    #[test]
    fn rates_and_losses_in_words() {
        let known = state(Some(1e-3), 1e-3, Some(1e-3));
        let with_interval = |state: StateRisk| StateRisk {
            ci95: Some((5e-4, 2e-3)),
            ..state
        };
        let of_slopes = StateRisk {
            slopes: Slopes::Alone,
            ..with_interval(known.clone())
        };
        let mut cut = known.clone();
        cut.rates.below_first = 1e-2;
        let states = [
            known.clone(),
            state(Some(0.0), 0.0, Some(0.0)),
            with_interval(known),
            of_slopes,
            cut,
            state(Some(1e-3), 5e-4, Some(1.05e-3)),
            state(Some(1e-3), 1e-3, Some(3e-3)),
            state(Some(1e-3), 5e-4, Some(3e-3)),
            with_interval(state(Some(1e-3), 5e-4, Some(2e-3))),
            state(Some(1e-3), 5e-4, None),
            state(Some(1e-3), 1e-3, None),
            state(None, 0.0, None),
            state(None, 1e-4, Some(1e-2)),
        ];
        let mut told: Vec<String> = states.iter().map(|one| state_words(one, "50")).collect();
        let losses = [Some(100.0), Some(300.0), None].map(|most| LossBounds {
            least: 100.0,
            best: 150.0,
            most,
        });
        told.extend(losses.map(|loss| format!("150 AUD{}", loss_words(&loss, "AUD"))));
        let verdicts = [RiskVerdict::Accepted, RiskVerdict::Exceeds];
        told.extend(verdicts.map(|verdict| verdict_words(verdict).to_owned()));
        told.extend(LimitState::ALL.map(|state| reaching(state).to_owned()));
        let parts = [
            NotCounted::Repair,
            NotCounted::Replacement,
            NotCounted::Downtime,
            NotCounted::Casualties,
            NotCounted::RepairWithoutCurve,
            NotCounted::ExceedingOfUnknownRate,
            NotCounted::OverturningOfUnknownRate,
            NotCounted::OverturningWithoutCurve,
        ];
        told.extend(parts.map(|part| not_counted(part).to_owned()));
        let whys = [
            WhyNotRun::LeftOut("its height is not given".to_owned()),
            WhyNotRun::Anchored("bolted".to_owned()),
        ];
        told.extend(whys.iter().map(why_not_run));
        insta::assert_snapshot!(told.join("\n"));
    }
}
