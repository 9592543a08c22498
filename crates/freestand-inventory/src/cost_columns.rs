//! The columns of costs: their names, headings and units, and the currencies.

use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;
use freestand_input::words::canonical;

use super::numbers::plain;
use super::vocabulary::{is_among, is_phrase};

/// A number of the costs of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cost {
    /// Of its repair.
    Repair,
    /// Of a new object.
    Replacement,
    /// How long it is missing \[day\].
    Downtime,
    /// Of a day on which it is missing.
    DowntimeDay,
    /// The probability that somebody is hurt if it overturns.
    CasualtyProbability,
    /// Of somebody who is hurt.
    Casualty,
    /// The accepted yearly rate of falls.
    AcceptedRate,
    /// The accepted yearly rate at which a tolerance is exceeded.
    AcceptedExceedRate,
    /// Where its site is \[°E\].
    Longitude,
    /// Where its site is \[°N\].
    Latitude,
}

impl Cost {
    /// Whether a number can be such a one.
    pub(super) fn holds(self, value: f64) -> bool {
        match self {
            Self::CasualtyProbability => (0.0..=1.0).contains(&value),
            Self::AcceptedRate | Self::AcceptedExceedRate => value > 0.0,
            Self::Longitude => (-360.0..=360.0).contains(&value),
            Self::Latitude => (-90.0..=90.0).contains(&value),
            Self::Repair
            | Self::Replacement
            | Self::Downtime
            | Self::DowntimeDay
            | Self::Casualty => value >= 0.0,
        }
    }
}

/// The costs of an object; `None`: an empty cell, or one that cannot be read.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Amounts(pub(super) [Option<f64>; COST_COLUMNS.len()]);

impl Amounts {
    /// One of them.
    pub fn of(&self, cost: Cost) -> Option<f64> {
        self.0.get(cost as usize).copied().flatten()
    }
}

/// The unit of a column of costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CostUnit {
    /// A currency, and this after it.
    Money(&'static str),
    /// One of these words, which may stand in the heading itself.
    Named(&'static [&'static str]),
    Bare,
}

/// A column of costs: its name, and its other headings in the form of [`canonical`], `|` between two.
pub(super) struct CostColumn {
    pub cost: Cost,
    pub name: &'static str,
    pub unit: CostUnit,
    headings: &'static str,
}

const fn column(
    cost: Cost,
    name: &'static str,
    unit: CostUnit,
    headings: &'static str,
) -> CostColumn {
    CostColumn {
        cost,
        name,
        unit,
        headings,
    }
}

use CostUnit::{Bare, Money, Named};

const DAYS: CostUnit = Named(&["day", "days", "d", "tage", "jours", "dias"]);
const PER_YEAR: CostUnit = Named(&["1/yr", "/yr", "1/year"]);

/// In the order of [`Cost`].
#[rustfmt::skip]
pub(super) const COST_COLUMNS: [CostColumn; 10] = [
    column(Cost::Repair, "repair_cost", Money(""),
        "cost of repair|repair|reparaturkosten|cout de reparation|costo de reparacion"),
    column(Cost::Replacement, "replacement_cost", Money(""),
        "replacement value|cost of replacement|insured value|asset value|neuwert|wiederbeschaffungswert|valeur a neuf|\
         valeur de remplacement|valor de reposicion|valore a nuovo|valor de reposicao|bedel|取得価額|重置价值"),
    column(Cost::Downtime, "downtime", DAYS, "downtime days|ausfalltage"),
    column(Cost::DowntimeDay, "downtime_cost", Money("/day"), "cost of downtime|ausfallkosten"),
    column(Cost::CasualtyProbability, "casualty_probability", Bare, ""),
    column(Cost::Casualty, "casualty_cost", Money(""), ""),
    column(Cost::AcceptedRate, "accepted_annual_rate", PER_YEAR, ""),
    column(Cost::AcceptedExceedRate, "accepted_exceed_annual_rate", PER_YEAR, ""),
    column(Cost::Longitude, "longitude", Bare, "lon"),
    column(Cost::Latitude, "latitude", Bare, "lat"),
];

impl CostColumn {
    fn named(name: &str) -> Option<&'static Self> {
        COST_COLUMNS.iter().find(|column| column.name == name)
    }
}

/// Whether a name is that of a column of costs; a mapping file may give it to a heading.
pub fn cost_name(name: &str) -> Option<&'static str> {
    CostColumn::named(name).map(|column| column.name)
}

/// A heading of costs: `Replacement value NZD`, `downtime_cost [EUR/day]`.
pub(super) struct CostHeading {
    pub column: &'static CostColumn,
    /// After the name, or of the mapping file.
    pub unit: Option<String>,
}

impl CostHeading {
    /// A heading that says what it is.
    pub(super) fn of(heading: &str) -> Option<Self> {
        let text = plain(heading);
        let (name, unit) = name_and_unit(&text);
        let words = canonical(name);
        let is_it = |column: &&CostColumn| {
            canonical(column.name) == words
                || !words.is_empty() && is_phrase(&words, column.headings)
        };
        COST_COLUMNS.iter().find(is_it).map(|column| Self {
            column,
            unit: unit.map(str::to_owned),
        })
    }

    /// A heading that a mapping file takes for one of this name, and may give a unit.
    pub(super) fn mapped(heading: &str, name: &str, unit: Option<String>) -> Option<Self> {
        let text = plain(heading);
        let own = || name_and_unit(&text).1.map(str::to_owned);
        Some(Self {
            column: CostColumn::named(name)?,
            unit: unit.or_else(own),
        })
    }

    /// The currency, where it is one of money.
    ///
    /// # Errors
    /// A unit that is missing, or is another one.
    pub(super) fn currency(&self, heading: &str) -> Result<Option<String>, Problem> {
        let unit = self.unit.as_deref().map(str::trim);
        let name = self.column.name;
        let refused = |what: &str, example: &str| {
            let message = format!("the column \"{}\" {what}", shorten(heading));
            let hint = format!(
                "write {name} [{example}], or give the unit in a mapping file (`columns = \"FILE\"`)"
            );
            Err(Problem::value(message, hint))
        };
        match self.column.unit {
            Bare => Ok(None),
            Named(words) => {
                let first = words.first().copied().unwrap_or_default();
                let in_heading = canonical(heading);
                let is_stated = match unit {
                    Some(unit) => words.contains(&unit.to_lowercase().as_str()),
                    None => words
                        .iter()
                        .any(|word| word.len() > 3 && in_heading.ends_with(word)),
                };
                if is_stated {
                    Ok(None)
                } else {
                    refused(&format!("is not in {first}"), first)
                }
            }
            Money(per) => {
                let currency = unit
                    .and_then(|unit| unit.strip_suffix(per))
                    .map(str::trim)
                    .filter(|text| is_currency(text));
                match currency {
                    Some(currency) => Ok(Some(currency.to_owned())),
                    None => refused("states no currency", &format!("AUD{per}")),
                }
            }
        }
    }
}

/// The parts of `Replacement value NZD` and of `downtime_cost [EUR/day]`.
fn name_and_unit(heading: &str) -> (&str, Option<&str>) {
    let (name, inner) = match heading.find(['[', '(']) {
        Some(at) => {
            let (name, unit) = heading.split_at(at);
            let unit = unit.trim_start_matches(['[', '(']);
            (name.trim(), Some(unit.trim_end_matches([']', ')', ' '])))
        }
        None => (heading, None),
    };
    match name.rsplit_once(' ').filter(|(_, last)| is_currency(last)) {
        Some((name, last)) => (name, inner.or(Some(last))),
        None => (name, inner),
    }
}

/// Whether a text is the sign or the code of a currency.
pub(super) fn is_currency(text: &str) -> bool {
    let letters = text.strip_suffix('$').unwrap_or(text);
    let is_upper = letters.bytes().all(|byte| byte.is_ascii_uppercase());
    matches!(text, "€" | "£" | "¥")
        || is_upper
            && if letters == text {
                text.len() == 3
            } else {
                letters.len() <= 2
            }
}

/// The code of a currency that is written otherwise; any other text as it is.
pub fn code(currency: &str) -> &str {
    match currency {
        "€" => "EUR",
        "£" => "GBP",
        "A$" | "AU$" => "AUD",
        "C$" | "CA$" => "CAD",
        "HK$" => "HKD",
        "MX$" => "MXN",
        "NT$" => "TWD",
        "NZ$" => "NZD",
        "R$" => "BRL",
        "S$" => "SGD",
        "US$" => "USD",
        _ => currency,
    }
}

/// Whether a cell may state this currency in a column of that one: its code, or its sign.
pub(super) fn is_of(cell: &str, column: &str) -> bool {
    const DOLLARS: &str = "ARS AUD CAD CLP COP FJD HKD MXN NZD SGD TWD USD";
    let (cell, column) = (code(cell), code(column));
    match cell {
        "$" => column == "$" || is_among(column, DOLLARS),
        "¥" => matches!(column, "¥" | "JPY" | "CNY"),
        _ => cell == column,
    }
}
