//! The curves of a fit, for people.

use freestand::fragility::LimitState;
use freestand_input::words::significant;
use freestand_output::facts::Facts;
use freestand_risk::fragility::{FragilityReport, TWO_STAGE};

use crate::table::{Column, facts_table};

const COLUMNS: [Column; 9] = [
    ("id", "object", 0),
    ("limit_state", "limit state", 0),
    ("kind", "curve", 0),
    ("median", "median", 4),
    ("median_ci95", "95 %", 0),
    ("beta", "beta", 3),
    ("beta_ci95", "95 %", 0),
    ("lower", "none below", 4),
    ("upper", "all above", 4),
];

/// The curves by one measure, for people.
pub fn curves_text(report: &FragilityReport) -> String {
    let measure = report.table.measure.with_unit();
    format!(
        "Intensities: {measure} of the {}\n\n{}",
        report.at.name(),
        facts_table(rows(report), &COLUMNS)
    )
}

/// One row for each curve.
fn rows(report: &FragilityReport) -> Vec<Facts<'static>> {
    let rows = report.objects.iter().flat_map(|object| {
        object.fit.curves.iter().map(move |curve| {
            let interval = object.interval(curve.limit_state);
            let (median, beta) = interval.unzip();
            let both = |pair: Option<(f64, f64)>| {
                pair.map(|(low, high)| {
                    format!("{} to {}", significant(low, 3), significant(high, 3))
                })
            };
            Facts::default()
                .key("id", object.id.clone())
                .key("limit_state", curve.limit_state.name())
                .key("kind", curve.kind.name())
                .key("median", curve.kind.median())
                .key("median_ci95", both(median))
                .key("beta", curve.kind.beta())
                .key("beta_ci95", both(beta))
                .key("lower", curve.kind.lower())
                .key("upper", curve.kind.upper())
        })
    });
    let by_shock = report.objects.iter().filter_map(|object| {
        let two_stage = object.two_stage?;
        let none = None::<f64>;
        let row = Facts::default()
            .key("id", object.id.clone())
            .key("limit_state", LimitState::Exceeds.name())
            .key("kind", TWO_STAGE)
            .key("median", two_stage.median())
            .key("median_ci95", none)
            .key("beta", none)
            .key("beta_ci95", none)
            .key("lower", none)
            .key("upper", none);
        Some(row)
    });
    rows.chain(by_shock).collect()
}
