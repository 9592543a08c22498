//! What all objects lose together, and what a budget is worth.

use freestand_output::figure::mark::MarkerShape;

use freestand::risk::LossPoint;
use freestand_output::figure::legend::{Entry, Sign};
use freestand_output::figure::page::{Page, Panel, columns, draw};
use freestand_output::figure::style::{
    Axis, CurveStyle, axes, curve_style, decades, line, markers, plain, plain_ticks,
};
use freestand_output::figure::{Figure, FigureError};

use freestand_risk::RiskReport;
use freestand_risk::plan::Chosen;
use freestand_risk::portfolio::Portfolio;

/// Height of the panels \[px\].
const PANEL_PX: f64 = 300.0;
/// The return periods that the axis covers at least \[years\].
const PERIODS: (f64, f64) = (10.0, 2500.0);
/// Rarer losses are not drawn \[years\].
const RAREST: f64 = 1e5;

/// Losses against their return periods and the worth of budgets; `None` where there is neither.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn risk_figure(report: &RiskReport) -> Result<Option<Figure>, FigureError> {
    let currency = report.currency.as_deref().unwrap_or("");
    let mut panels = Vec::new();
    let mut legend = Vec::new();
    let mut sentences = Vec::new();
    let entry = |style: CurveStyle, words: &str| {
        let sign = Sign::Line {
            colour: style.colour,
            width_px: 2.0,
            dash: style.dash,
        };
        Entry {
            sign,
            words: words.to_owned(),
        }
    };
    if let Some(portfolio) = report
        .portfolio
        .as_ref()
        .filter(|portfolio| !portfolio.curve.is_empty())
    {
        panels.push(losses(portfolio, currency));
        legend.push(entry(curve_style(0), "all objects under the same motions"));
        legend.push(entry(curve_style(1), "if objects failed independently"));
        sentences.push(
            "Loss of all objects together that is reached or exceeded once in this many years on average. The lines \
             differ because all objects have the same motions, so they tend to fail together.",
        );
    }
    if let Some(plan) = report
        .measures
        .as_ref()
        .and_then(|measures| measures.plan.as_ref())
    {
        panels.push(frontier(plan, currency));
        legend.push(entry(curve_style(2), "best plan within a budget"));
        let sign = Sign::Dot {
            colour: curve_style(3).colour,
        };
        legend.push(Entry {
            sign,
            words: "the plan".to_owned(),
        });
        sentences.push(if plan.is_at_least() {
            "What the best plan within each budget saves at least beyond its cost, in present value."
        } else {
            "What the best plan within each budget saves beyond its cost, in present value."
        });
    }
    if panels.is_empty() {
        return Ok(None);
    }
    let columns = columns(panels.len());
    draw(Page {
        name: "risk".to_owned(),
        title: match panels.len() {
            1 if report.portfolio.is_some() => "Losses of all objects".to_owned(),
            1 => "What a budget is worth".to_owned(),
            _ => "Losses of all objects, and what a budget is worth".to_owned(),
        },
        caption: sentences.join(" "),
        panels,
        columns,
        row_heights_px: vec![PANEL_PX],
        legend,
    })
    .map(Some)
}

/// A factor and a word that make amounts up to `largest` easy to read.
pub(super) fn scale(largest: f64) -> (f64, &'static str) {
    [(1e-9, "billion "), (1e-6, "million "), (1e-3, "thousand ")]
        .into_iter()
        .find(|(factor, _)| largest * factor >= 1.0)
        .unwrap_or((1.0, ""))
}

/// The stairs of a curve of return periods and losses: a loss from its return period on, up to the next one.
pub(super) fn stairs(curve: impl Iterator<Item = (f64, f64)>, to: f64) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    for (years, loss) in curve {
        if years > to {
            break;
        }
        points.push((years, points.last().map_or(0.0, |last| last.1)));
        points.push((years, loss));
    }
    points.extend(points.last().map(|last| (to, last.1)));
    points
}

fn losses(portfolio: &Portfolio, currency: &str) -> Panel {
    let period = |point: Option<&LossPoint>| point.map(|point| 1.0 / point.annual_rate);
    let first = period(portfolio.curve.first())
        .unwrap_or(PERIODS.0)
        .min(PERIODS.0);
    let last = period(portfolio.curve.last())
        .unwrap_or(PERIODS.1)
        .clamp(PERIODS.1, RAREST);
    let (from, to) = (
        10.0_f64.powf(first.log10().floor()),
        10.0_f64.powf(last.log10().ceil()),
    );
    let within = |point: &&LossPoint| point.annual_rate * to >= 1.0;
    let largest = portfolio
        .curve
        .iter()
        .filter(within)
        .map(|point| point.loss)
        .fold(0.0, f64::max);
    let (factor, word) = scale(largest);
    let x = Axis {
        from,
        to,
        step: None,
        label: "Once in … years".to_owned(),
    };
    let y = Axis::from_zero(
        factor * largest,
        &plain(&format!("Loss ({word}{currency})")),
    );
    let top = y.to;
    let mut layout = axes(x, y).with_title("Losses").with_log_x();
    layout.x_tick_format = decades();
    layout.y_tick_format = plain_ticks(top);
    let of = |curve: &[LossPoint], i: usize| {
        let style = curve_style(i);
        let known = curve.iter().filter(|point| point.annual_rate > 0.0);
        let known = known.map(|point| (1.0 / point.annual_rate, factor * point.loss));
        line(&stairs(known, to), style.colour, 2.0, style.dash)
    };
    Panel {
        marks: vec![of(&portfolio.independent, 1), of(&portfolio.curve, 0)],
        layout,
    }
}

fn frontier(plan: &Chosen, currency: &str) -> Panel {
    let points = || {
        plan.frontier
            .iter()
            .map(|within| (within.budget, within.net_present_value))
    };
    let (budgets, budget_word) = scale(plan.budget);
    let (values, value_word) = scale(points().map(|point| point.1).fold(0.0, f64::max));
    let x = Axis::from_zero(
        1.02 * budgets * plan.budget,
        &plain(&format!("Budget ({budget_word}{currency})")),
    );
    let most = points().map(|point| point.1).fold(0.0, f64::max);
    let y = Axis::from_zero(
        values * most,
        &plain(&format!("Net present value ({value_word}{currency})")),
    );
    let (right, top) = (x.to, y.to);
    // A plan is worth what it is from its budget on.
    let mut drawn = vec![(0.0, 0.0)];
    for (budget, value) in points() {
        drawn.push((
            budgets * budget,
            drawn.last().map_or(0.0, |last: &(f64, f64)| last.1),
        ));
        drawn.push((budgets * budget, values * value));
    }
    let (style, own) = (curve_style(2), curve_style(3));
    let here = [(budgets * plan.budget, values * plan.plan.value)];
    let mut layout = axes(x, y).with_title("Budgets");
    layout.x_tick_format = plain_ticks(right);
    layout.y_tick_format = plain_ticks(top);
    let marks = vec![
        line(&drawn, style.colour, 2.0, style.dash),
        markers(&here, own.colour, MarkerShape::Circle, 6.0),
    ];
    Panel { marks, layout }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loss_begins_at_its_return_period() {
        let curve = [(10.0, 1.0), (100.0, 5.0), (1e6, 9.0)];
        let drawn = stairs(curve.into_iter(), 1000.0);
        assert_eq!(
            drawn,
            [
                (10.0, 0.0),
                (10.0, 1.0),
                (100.0, 1.0),
                (100.0, 5.0),
                (1000.0, 5.0)
            ]
        );
        assert_eq!((scale(999.0), scale(2e6)), ((1.0, ""), (1e-6, "million ")));
    }
}
