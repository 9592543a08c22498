//! What falls cost at all sites together, on the console.

use freestand_input::words::number;
use freestand_risk::budget::{LossRow, SitesLosses, UnknownLosses};

use super::words::amount;
use crate::table::table;

pub(super) fn why_unknown(unknown: &UnknownLosses) -> String {
    match unknown {
        UnknownLosses::NoRates(site) => format!(
            "The losses of all sites together are not known: the hazard of {site} has no annual rates"
        ),
        UnknownLosses::NoCosts(site) => format!(
            "The losses of all sites together are not known: the list of {site} has no costs of a fall"
        ),
    }
}

/// The losses of all sites, on the console.
pub(super) fn losses_text(losses: &SitesLosses) -> String {
    let currency = &losses.currency;
    let at_least = |is_at_least: bool| if is_at_least { "at least " } else { "" };
    let mut headings = vec!["site", "loss a year"];
    if losses.is_insured {
        headings.push("paid a year");
    }
    let has_downtime = losses
        .sites
        .iter()
        .any(|one| one.downtime_days_per_year.is_some());
    if has_downtime {
        headings.push("days of downtime a year");
    }
    let rows: Vec<Vec<String>> = losses
        .sites
        .iter()
        .map(|one| {
            let least = at_least(one.annual_loss_is_at_least);
            let mut row = vec![
                one.site.clone(),
                format!("{least}{}", amount(one.annual_loss)),
            ];
            if losses.is_insured {
                row.push(amount(one.annual_paid));
            }
            if has_downtime {
                let days = one.downtime_days_per_year;
                row.push(days.map_or("unknown".to_owned(), |days| number(days, 2)));
            }
            row
        })
        .collect();
    let mut text = format!("\nWhat falls cost at all sites [{currency}]\n\n");
    text.push_str(&table(&headings, &rows));
    text.push_str(&format!(
        "\nAll sites: {}{} {currency} a year. In {} simulated years:\n\n",
        at_least(losses.annual_loss_is_at_least),
        amount(losses.annual_loss),
        losses.simulated_years,
    ));
    let mut headings = vec!["once in", "earthquakes", "in an earthquake", "in a year"];
    if losses.is_insured {
        headings.extend(["paid for it", "paid for the year"]);
    }
    let row = |row: &LossRow| {
        let years = format!("{} years", row.return_period_years);
        let mut cells = vec![years, row.dependence.name().to_owned()];
        let mut amounts = vec![row.event.loss, row.year.loss];
        if losses.is_insured {
            amounts.extend([row.event.paid, row.year.paid]);
        }
        cells.extend(amounts.into_iter().map(amount));
        cells
    };
    let mut rows: Vec<&LossRow> = losses.rows.iter().collect();
    rows.sort_by_key(|row| row.return_period_years);
    let rows: Vec<Vec<String>> = rows.into_iter().map(row).collect();
    text.push_str(&table(&headings, &rows));
    text.push('\n');
    text.push_str(&dependence_words(losses));
    text.push('\n');
    text
}

/// What the kinds of earthquakes are.
fn dependence_words(losses: &SitesLosses) -> String {
    let correlated = match losses.correlation_range_km {
        Some(range_km) => format!(
            "correlated: each is at all sites, its strengths correlated by exp(-3h/r) at the distance h, r = {} km{}",
            number(range_km, 3),
            match losses.correlation_range_is_assumed {
                true => " (assumed; 8.5 to 41 km by Jayaram and Baker 2009)",
                false => "",
            }
        ),
        None => "correlated: not known, because the coordinates of a site are not".to_owned(),
    };
    format!(
        "Earthquakes - independent: each is at one site; {correlated}; common: the sites are as one. The loss a year is the same in all three."
    )
}
