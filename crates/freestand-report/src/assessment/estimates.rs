//! What is told while an assessment runs: how long it takes, and what the first worlds say of each object.

use freestand_assess::portfolio::Estimate;
use freestand_assess::result::Probability;
use freestand_input::quantity::shorten;
use freestand_input::words::counted;
use serde::Serialize;

use super::reasons::spread;
use crate::table::table;

/// Effort that one core does in a second: assumed, from three lists of benches/README.md. A slower machine takes longer; once
/// work has begun, its own speed counts.
const EFFORT_PER_S: f64 = 25_000.0;

/// Rows of the table of first estimates.
const ROWS: usize = 15;

/// How long an assessment takes, before it begins.
pub fn usual_time(effort: u64, threads: usize) -> String {
    let seconds = effort as f64 / EFFORT_PER_S / threads.max(1) as f64;
    format!(
        "This takes {} on {}.",
        duration(seconds),
        counted(threads, "thread")
    )
}

/// The time that is left where this share of the effort took so long; `None`: too little is done to say.
pub fn time_left(share: f64, elapsed_s: f64) -> Option<String> {
    const FEWEST: f64 = 0.02;
    (FEWEST..1.0)
        .contains(&share)
        .then(|| format!("{} left", duration(elapsed_s * (1.0 - share) / share)))
}

fn duration(seconds: f64) -> String {
    const MINUTE_S: f64 = 60.0;
    match seconds {
        s if s < 5.0 => "less than 5 s".to_owned(),
        s if s < 1.5 * MINUTE_S => format!("about {} s", (s / 5.0).ceil() * 5.0),
        s if s < 90.0 * MINUTE_S => format!("about {} min", (s / MINUTE_S).ceil()),
        s => format!("about {} h", (s / MINUTE_S / MINUTE_S).ceil()),
    }
}

/// The objects that fall most often in their first worlds. There is no verdict in it: most intervals hold the accepted
/// probability.
pub fn first_estimates(estimates: &[Estimate]) -> String {
    let mut order: Vec<&Estimate> = estimates.iter().collect();
    order.sort_by(|a, b| {
        let key = |one: &Estimate| one.exceed.map_or(one.overturn, |exceed| exceed).value;
        let falls = |one: &Estimate| one.overturn.value;
        falls(b)
            .total_cmp(&falls(a))
            .then(key(b).total_cmp(&key(a)))
    });
    let worlds = estimates.iter().map(|one| one.worlds).max().unwrap_or(0);
    let row = |one: &&Estimate| {
        vec![
            shorten(&one.item.id),
            shorten(&one.item.item),
            spread(one.overturn),
            one.exceed.map_or_else(|| "-".to_owned(), spread),
        ]
    };
    let rows: Vec<Vec<String>> = order.iter().take(ROWS).map(row).collect();
    let mut text = format!(
        "First estimates from {}; they get sharper, and the verdicts follow:\n{}",
        counted(worlds as usize, "world"),
        table(&["id", "item", "falls", "too hard"], &rows)
    );
    if estimates.len() > ROWS {
        text.push_str(&format!("… and {} more\n", estimates.len() - ROWS));
    }
    text
}

/// An object after some of its worlds, with the names of `objects.csv`.
#[derive(Debug, Serialize)]
pub struct EstimateRow<'a> {
    row: u32,
    id: &'a str,
    worlds: u32,
    p_overturn: f64,
    p_overturn_low: f64,
    p_overturn_high: f64,
    p_exceed: Option<f64>,
    p_exceed_low: Option<f64>,
    p_exceed_high: Option<f64>,
    is_settled: bool,
}

impl<'a> EstimateRow<'a> {
    /// Of an estimate.
    pub fn new(estimate: &Estimate<'a>) -> Self {
        let Probability { value, low, high } = estimate.overturn;
        Self {
            row: estimate.item.row,
            id: &estimate.item.id,
            worlds: estimate.worlds,
            p_overturn: value,
            p_overturn_low: low,
            p_overturn_high: high,
            p_exceed: estimate.exceed.map(|one| one.value),
            p_exceed_low: estimate.exceed.map(|one| one.low),
            p_exceed_high: estimate.exceed.map(|one| one.high),
            is_settled: estimate.is_settled,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assessment::fixture;

    #[test]
    fn times_in_words() {
        let told = [0.0, 5.0, 61.0, 200.0, 4000.0, 20_000.0].map(duration);
        assert_eq!(
            told,
            [
                "less than 5 s",
                "about 5 s",
                "about 65 s",
                "about 4 min",
                "about 67 min",
                "about 6 h"
            ]
        );
        assert_eq!(time_left(0.01, 10.0), None);
        assert_eq!(time_left(0.25, 10.0).unwrap(), "about 30 s left");
        assert_eq!(time_left(1.0, 10.0), None);
    }

    /// Those that fall most often come first, and no verdict is told.
    #[test]
    fn first_estimates_have_no_verdict() {
        let items = [0, 1].map(fixture::item);
        let of = |place: usize, hits: f64| Estimate {
            item: &items[place],
            worlds: 20,
            overturn: Probability {
                value: hits / 20.0,
                low: 0.0,
                high: 0.206,
            },
            exceed: (place == 1).then_some(Probability {
                value: 0.5,
                low: 0.25,
                high: 0.75,
            }),
            is_settled: false,
        };
        insta::assert_snapshot!(first_estimates(&[of(0, 0.0), of(1, 3.0)]));
    }
}
