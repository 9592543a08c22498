//! The answer for people.

use freestand::fragility::LimitState;
use freestand_input::words::number;

use crate::report::RiskReport;
use crate::words::least;

/// The answer for people.
pub fn text(report: &RiskReport) -> String {
    let mut text = String::new();
    let currency = report.currency.as_deref().unwrap_or("");
    let plan = report
        .measures
        .as_ref()
        .and_then(|measures| measures.plan.as_ref());
    text.extend(
        plan.and_then(|plan| plan.unfunded_words(currency))
            .map(|words| format!("{words}\n")),
    );
    let years = number(report.years, 4);
    for object in &report.objects {
        text += &format!("{}\n", object.id);
        for one in &object.states {
            text += &format!("  {:10}  {}\n", one.limit_state.name(), one.words(&years));
        }
        if let Some(verdict) = object.verdict {
            let limits = object.named_limits();
            let limits = limits.iter().map(|limit| {
                let of = if limit.limit_state == LimitState::Overturns {
                    "overturning"
                } else {
                    "exceeding"
                };
                format!("accepted for {of}: {} a year", number(limit.accepted, 3))
            });
            let accepted = format!(" ({})", limits.collect::<Vec<_>>().join("; "));
            let sure = object.uncertainty_words();
            text += &format!("  verdict     {}{sure}{accepted}\n", verdict.words());
        } else if let Some(why) = object.why {
            text += &format!("  verdict     not known: {why}\n");
        }
        if let (Some(loss), Some(currency)) = (object.loss, &report.currency) {
            let bounds = loss.words(&format!("{currency} a year"));
            let (least, stated) = (
                least(object.is_at_least),
                number(loss.stated(object.is_at_least), 4),
            );
            text += &format!("  loss        {least}{stated} {currency} a year{bounds}\n");
        }
        if let Some(why) = object.curves.caution {
            text += &format!(
                "  caution     {}; it may fail more often than its curves say\n",
                why.words()
            );
        }
        if !object.not_counted.is_empty() && object.expected_annual_loss.is_some() {
            text += &format!("  not counted {}\n", object.not_counted.join(", "));
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
        text += &portfolio.text(currency);
    }
    if let Some(measures) = &report.measures {
        text += &measures.text(currency);
    }
    text.extend(
        report
            .assumptions
            .iter()
            .map(|assumed| format!("{assumed}\n")),
    );
    text
}
