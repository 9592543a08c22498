//! The answer for people.

use freestand_input::words::number;

use freestand_input::quantity::shorten;
use freestand_input::words::counted;
use freestand_risk::RiskReport;
use freestand_risk::plan::{Chosen, Measures, Worth};
use freestand_risk::portfolio::{Portfolio, RETURN_PERIODS};

use super::doubts::assumptions;
use super::words::{
    least, loss_words, not_counted, reaching, state_words, uncertainty_words, verdict_words,
    why_unjudged,
};
use crate::assessment::words::too_mild;

/// The answer for people.
pub fn risk_text(report: &RiskReport) -> String {
    let mut text = String::new();
    let currency = report.currency.as_deref().unwrap_or("");
    let plan = report
        .measures
        .as_ref()
        .and_then(|measures| measures.plan.as_ref());
    text.extend(
        plan.and_then(|plan| unfunded_words(plan, currency))
            .map(|words| format!("{words}\n")),
    );
    let years = number(report.years, 4);
    for object in &report.objects {
        text += &format!("{}\n", object.id);
        for one in &object.states {
            text += &format!(
                "  {:10}  {}\n",
                one.limit_state.name(),
                state_words(one, &years)
            );
        }
        if let Some(verdict) = object.verdict {
            let limits = object.named_limits();
            let limits = limits.iter().map(|limit| {
                let of = reaching(limit.limit_state);
                format!("accepted for {of}: {} a year", number(limit.accepted, 3))
            });
            let accepted = format!(" ({})", limits.collect::<Vec<_>>().join("; "));
            let sure = uncertainty_words(object);
            text += &format!("  verdict     {}{sure}{accepted}\n", verdict_words(verdict));
        } else if let Some(why) = object.why {
            text += &format!("  verdict     not known: {}\n", why_unjudged(why));
        }
        if let (Some(loss), Some(currency)) = (object.loss, &report.currency) {
            let bounds = loss_words(&loss, &format!("{currency} a year"));
            let (least, stated) = (
                least(object.is_at_least),
                number(loss.stated(object.is_at_least), 4),
            );
            text += &format!("  loss        {least}{stated} {currency} a year{bounds}\n");
        }
        if let Some(why) = object.curves.caution {
            text += &format!(
                "  caution     {}; it may fail more often than its curves say\n",
                too_mild(why)
            );
        }
        if !object.not_counted.is_empty() && object.expected_annual_loss.is_some() {
            let parts = object.not_counted.iter().copied();
            let parts: Vec<&str> = parts.map(not_counted).collect();
            text += &format!("  not counted {}\n", parts.join(", "));
        }
    }
    if let Some(loss) = report.stated_loss().filter(|_| report.objects.len() > 1) {
        let bounds = match report.loss_bounds() {
            Some((from, Some(to))) if report.is_bound() => {
                format!(
                    "; between {} and {} {currency} a year",
                    number(from, 4),
                    number(to, 4)
                )
            }
            _ => String::new(),
        };
        let least = least(report.is_at_least());
        text += &format!(
            "All objects: {least}{} {currency} a year{bounds}\n",
            number(loss, 4)
        );
    }
    if let Some(portfolio) = &report.portfolio {
        text += &portfolio_text(portfolio, currency);
    }
    if let Some(measures) = &report.measures {
        text += &measures_text(measures, currency);
    }
    let assumed = assumptions(report).into_iter();
    text.extend(assumed.map(|sentence| sentence + "\n"));
    text
}

/// The losses of all objects under common motions.
fn portfolio_text(portfolio: &Portfolio, currency: &str) -> String {
    let least = least(portfolio.is_at_least);
    let bounds = portfolio.annual_loss();
    let mut text = format!(
        "All objects under common motions ({}): {least}{} {currency} a year{}\n",
        counted(portfolio.worlds, "world"),
        number(portfolio.expected_annual_loss, 4),
        loss_words(&bounds, &format!("{currency} a year"))
    );
    for years in RETURN_PERIODS {
        let loss = portfolio.at_return_period(years);
        let bounds = loss_words(&loss, currency);
        text += &format!(
            "  once in {years} years: {least}{} {currency}{bounds}\n",
            number(loss.best, 4)
        );
    }
    text
}

/// What the options are worth, and the plan within the budget.
fn measures_text(measures: &Measures, currency: &str) -> String {
    let line = |worth: &Worth| {
        let least = least(worth.is_at_least);
        let ratio = worth.ratio().map_or("-".to_owned(), |ratio| {
            format!("{least}{}", number(ratio, 3))
        });
        let benefit = match worth.benefit_present_value {
            Some(benefit) => format!(
                "worth {least}{} {currency}, benefit/cost {ratio}",
                number(benefit, 4)
            ),
            None => "worth not known: a rate with it has no upper bound".to_owned(),
        };
        format!(
            "  {}: {}, cost {} {currency}, {benefit}\n",
            worth.id,
            worth.option,
            number(worth.cost, 4)
        )
    };
    let mut text = "Options by benefit over cost:\n".to_owned();
    text.extend(measures.ranking().into_iter().map(line));
    if let Some(found) = &measures.plan {
        let Chosen {
            budget,
            plan,
            chosen,
            ..
        } = found;
        let proven = match (plan.is_optimal, measures.is_at_least()) {
            (true, false) => "the best",
            (true, true) => "the best by the least that options are worth",
            (false, _) => "the best found so far",
        };
        text += &format!(
            "Plan within {} {currency}, {proven}: {}, cost {} {currency}, net present value {}{} {currency}\n",
            number(*budget, 4),
            counted(chosen.len(), "option"),
            number(plan.cost, 4),
            least(found.is_at_least()),
            number(plan.value, 4)
        );
        text.extend(chosen.iter().map(line));
    }
    text
}

/// What people need and the budget does not reach: `Unfunded life safety: 2 objects, 1400 EUR`.
pub(super) fn unfunded_words(plan: &Chosen, currency: &str) -> Option<String> {
    let cost: f64 = plan.unfunded.iter().map(|worth| worth.cost).sum();
    let objects = counted(plan.unfunded.len(), "object");
    let amount = number(cost, 4);
    let ids: Vec<String> = plan
        .unfunded
        .iter()
        .map(|worth| shorten(&worth.id))
        .collect();
    let words = || {
        format!(
            "Unfunded life safety: {objects}, {amount} {currency} ({})",
            ids.join(", ")
        )
    };
    (!ids.is_empty()).then(words)
}
