//! What failures cost, of a list as people keep it.

use std::path::Path;

use freestand_input::problem::{Problem, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::some;

use super::columns::Column;
use super::cost_columns::{Amounts, CostColumn, CostHeading, CostUnit, code, is_currency, is_of};
use super::mapping::cost_heading;
use super::numbers::{Number, Piece, pieces, plain};
use super::vocabulary::is_no_value;
use super::{Casters, Edit, Item, Mapping, ReadOptions, inspect_inventory};
use crate::library::Lookup;
use crate::too_mild::TooMild;

/// How the cells of a list are read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CellsRequest {
    /// A sheet of a workbook.
    pub sheet: Option<String>,
    /// A mapping file.
    pub columns: Option<std::path::PathBuf>,
    /// Cells that are read otherwise than the file has them.
    pub edits: Vec<Edit>,
}

impl CellsRequest {
    /// Whether anything is asked.
    pub fn is_given(&self) -> bool {
        *self != Self::default()
    }
}

/// Whether a file reads as a list as people keep it.
pub fn is_list(path: &Path) -> bool {
    inspect_inventory(path, &ReadOptions::new(&Lookup::NONE)).is_ok()
}

/// The costs of a list as people keep it.
#[derive(Debug)]
pub struct ListedCosts {
    /// The currency of its amounts.
    pub currency: Option<String>,
    /// Each object with its costs.
    pub objects: Vec<(Item, Amounts)>,
    /// Objects whose runs would be too mild, by what the list says of them.
    pub too_mild: Vec<(String, TooMild)>,
    /// What the reader doubts.
    pub warnings: Vec<String>,
}

/// The most rows that are named of one problem.
const NAMED_ROWS: usize = 5;

/// Reads the costs of a list.
///
/// # Errors
/// A list or a mapping file that cannot be read; a column without its unit; two currencies, also of a cell and
/// its column.
pub fn costs_of_list(path: &Path, request: &CellsRequest) -> Result<ListedCosts, Problems> {
    let mapping = request.columns.as_deref().map(Mapping::load).transpose()?;
    let options = ReadOptions {
        sheet: request.sheet.as_deref(),
        mapping: mapping.as_ref(),
        edits: &request.edits,
        ..ReadOptions::new(&Lookup::NONE)
    };
    let inventory = inspect_inventory(path, &options)?.inventory;
    let columns: Vec<(usize, &str, CostHeading)> = inventory
        .carried
        .iter()
        .enumerate()
        .filter_map(|(slot, heading)| {
            let cost = cost_heading(heading, mapping.as_ref())?;
            Some((slot, heading.as_str(), cost))
        })
        .collect();
    let mut currency: Option<String> = None;
    for (_, heading, column) in &columns {
        let own = column
            .currency(heading)
            .map_err(|problem| problem.in_file(path))?;
        if let (Some(known), Some(own)) = (&currency, &own)
            && code(known) != code(own)
        {
            let message = format!(
                "\"{}\" is in {own}, and other costs are in {known}",
                shorten(heading)
            );
            return Err(Problem::value(message, "convert all costs to one currency")
                .in_file(path)
                .into());
        }
        currency = currency.or(own);
    }
    in_one_currency(&inventory.items, &columns, currency.as_deref())
        .map_err(|problem| problem.in_file(path))?;
    let is_ignored = |heading: &&String| {
        let mapping = mapping.as_ref();
        mapping.is_some_and(|mapping| mapping.ignores(heading))
            && CostHeading::of(heading).is_some()
    };
    let ignored = inventory.carried.iter().filter(is_ignored).map(|heading| {
        let heading = shorten(heading);
        format!("the column \"{heading}\" is not counted, because the mapping file says \"ignore\"")
    });
    let mut warnings: Vec<String> = ignored.collect();
    // A number of objects that cannot be read counts as one.
    let counts = inventory
        .findings
        .iter()
        .filter(|one| one.column == Some(Column::Quantity));
    warnings.extend(counts.map(|one| format!("in the list: {}", one.line())));
    // What stands on it keeps it from rolling, as in its calculation.
    let rolls = |item: &Item| {
        item.surroundings.upper.is_none() && item.surroundings.casters == Some(Casters::Free)
    };
    let mild = |item: &Item| match (rolls(item), item.is_round()) {
        (true, _) => Some((item.id.clone(), TooMild::Glides)),
        (_, true) => Some((item.id.clone(), TooMild::Round)),
        _ => None,
    };
    let too_mild = inventory.items.iter().filter_map(mild).collect();
    let columns: Vec<(usize, &CostColumn)> = columns
        .iter()
        .map(|(slot, _, heading)| (*slot, heading.column))
        .collect();
    let mut objects = Vec::with_capacity(inventory.items.len());
    for item in inventory.items {
        let mut amounts = Amounts::default();
        for (slot, column) in &columns {
            let text = item.carried.get(*slot).map_or("", String::as_str);
            let value = amount(text, column.unit).filter(|value| column.cost.holds(*value));
            if value.is_none() && !is_no_value(text) {
                let said = format!(
                    "row {}: \"{}\" is no {}: it is not counted",
                    item.row,
                    shorten(text),
                    column.name
                );
                warnings.push(said);
            }
            if let Some(own) = amounts.0.get_mut(column.cost as usize) {
                *own = own.or(value);
            }
        }
        objects.push((item, amounts));
    }
    warnings.extend(inventory.warnings);
    Ok(ListedCosts {
        currency,
        objects,
        too_mild,
        warnings,
    })
}

/// Refuses cells that state another currency than their column.
fn in_one_currency(
    items: &[Item],
    columns: &[(usize, &str, CostHeading)],
    currency: Option<&str>,
) -> Result<(), Problem> {
    let Some(currency) = currency else {
        return Ok(());
    };
    let money: Vec<_> = columns
        .iter()
        .filter(|one| matches!(one.2.column.unit, CostUnit::Money(_)))
        .collect();
    let cells = items.iter().flat_map(|item| {
        money.iter().filter_map(move |(slot, heading, _)| {
            Some((item.row, *heading, item.carried.get(*slot)?))
        })
    });
    let mut other = cells.filter(|(.., text)| {
        without_currency(&plain(text))
            .1
            .iter()
            .flatten()
            .any(|own| !is_of(own, currency))
    });
    let Some((row, heading, text)) = other.next() else {
        return Ok(());
    };
    let rows: Vec<String> = other.map(|(row, ..)| row.to_string()).collect();
    let also = match rows.len() {
        0 => String::new(),
        1 => format!(" (also row {})", rows[0]),
        _ => format!(" (also rows {})", some(&rows, NAMED_ROWS)),
    };
    let message = format!(
        "\"{}\" is not in {currency}, as the column \"{}\" is{also}",
        shorten(text),
        shorten(heading)
    );
    let hint = format!(
        "convert all costs to one currency, and write {currency} or nothing beside the number"
    );
    Err(Problem::value(message, hint).at_line(usize::try_from(row).unwrap_or(0)))
}

/// The number of a cell; an amount of money never has three decimals. Words such as "Mio" are not understood.
fn amount(text: &str, unit: CostUnit) -> Option<f64> {
    let text = plain(text);
    if matches!(unit, CostUnit::Money(_)) {
        return number_of(without_currency(&text).0, true);
    }
    match text.strip_suffix('%') {
        Some(percent) => Some(number_of(percent.trim(), false)? / 100.0),
        None => number_of(&text, false),
    }
}

/// A number alone; one that may have three decimals or thousands has thousands if it is money.
fn number_of(text: &str, is_money: bool) -> Option<f64> {
    let found = pieces(text);
    let [Piece::Number(number)] = found.as_slice() else {
        return None;
    };
    let number = match number {
        Number::Sure(number, _) => number,
        Number::Either { as_thousands, .. } if is_money => as_thousands,
        Number::Either { .. } | Number::Malformed => return None,
    };
    number.parse().ok().filter(|value: &f64| value.is_finite())
}

/// An amount of money with its currency as people write it: `15 000 NZD`, `$5000 NZD`, `€20.000`. `None`: it is not
/// one, or it states no currency.
pub fn money(text: &str) -> Option<(f64, String)> {
    let text = plain(text);
    let upper = text.to_uppercase();
    let (bare, currencies) = without_currency(&upper);
    // A column of costs may be in what its owner calls a currency, such as kr.
    let (number, word) = text.split_at(text.trim_end_matches(char::is_alphabetic).len());
    let (bare, currency) = match currencies {
        [Some(sign), Some(own)] => (bare, Some(own).filter(|own| is_of(sign, own))?),
        [None, None] if word.chars().count() > 1 => (number.trim_end(), word),
        [before, after] => (bare, before.or(after)?),
    };
    let decimals = bare
        .rsplit_once(['.', ','])
        .map_or("", |(_, decimals)| decimals);
    let is_cut = !bare.starts_with(|first: char| first.is_ascii_digit());
    if is_cut || decimals.bytes().take_while(u8::is_ascii_digit).count() > 3 {
        return None;
    }
    let number = number_of(bare, true).or_else(|| bare.parse().ok())?;
    Some((number, currency.to_owned())).filter(|(number, _)| number.is_finite())
}

/// An amount without its currency, and the currencies before and after it.
fn without_currency(text: &str) -> (&str, [Option<&str>; 2]) {
    let is_part = |c: char| c.is_alphabetic() || matches!(c, '$' | '€' | '£' | '¥');
    let text = text.trim();
    let (first, rest) = text.split_at(text.find(|c| !is_part(c)).unwrap_or(0));
    let before = Some(first).filter(|first| is_currency(first));
    let text = if before.is_some() {
        rest.trim_start()
    } else {
        text
    };
    let (rest, last) = text.split_at(text.trim_end_matches(is_part).len());
    let after = Some(last).filter(|last| is_currency(last));
    (
        if after.is_some() {
            rest.trim_end()
        } else {
            text
        },
        [before, after],
    )
}

#[cfg(test)]
mod tests {
    use super::super::cost_columns::{COST_COLUMNS, Cost};
    use super::*;

    #[test]
    fn amounts_as_registers_have_them() {
        for (text, expected) in [
            ("8400", Some(8400.0)),
            ("62,000", Some(62e3)),
            ("$85,000", Some(85e3)),
            ("28 000", Some(28e3)),
            ("19.500", Some(19.5e3)),
            ("1.250,50 EUR", Some(1250.5)),
            ("NZD 3200", Some(3200.0)),
            ("1200€", Some(1200.0)),
            ("NZ$5000", Some(5000.0)),
            ("$5000 NZD", Some(5000.0)),
            ("priceless", None),
            ("100-200", None),
            ("85k", None),
            ("1.2 Mio", None),
            ("8,5 Tsd", None),
            ("", None),
        ] {
            assert_eq!(amount(text, CostUnit::Money("")), expected, "{text}");
        }
        assert_eq!(amount("5 %", CostUnit::Bare), Some(0.05));
    }

    #[test]
    fn a_cell_states_the_currency_of_its_column_or_none() {
        let fits = |text: &str, column: &str| {
            without_currency(text)
                .1
                .iter()
                .flatten()
                .all(|own| is_of(own, column))
        };
        for text in [
            "5000",
            "5000 NZD",
            "NZD 5000",
            "NZ$5000",
            "$5000",
            "$5000 NZD",
            "5000 NZ$",
            "approx 5000",
        ] {
            assert!(fits(text, "NZD") && fits(text, "NZ$"), "{text}");
        }
        for text in [
            "€5000",
            "5000 EUR",
            "5000 AUD",
            "$62000 AUD",
            "A$5000",
            "5 MIO",
            "£5",
            "¥ 900",
        ] {
            assert!(!fits(text, "NZD"), "{text}");
        }
        assert!(fits("€5", "EUR") && fits("5 EUR", "€") && fits("¥5", "CNY"));
        // Which dollars a column means is not known.
        assert!(fits("$5", "$") && !fits("US$5", "$") && !fits("5 USD", "$"));
    }

    #[test]
    fn headings_of_costs_name_their_unit() {
        for (heading, cost, currency) in [
            ("Replacement value NZD", Cost::Replacement, Some("NZD")),
            ("replacement_cost [EUR]", Cost::Replacement, Some("EUR")),
            ("Neuwert [NZD]", Cost::Replacement, Some("NZD")),
            ("downtime_cost [EUR/day]", Cost::DowntimeDay, Some("EUR")),
            ("downtime [day]", Cost::Downtime, None),
            ("Ausfalltage", Cost::Downtime, None),
        ] {
            let found = CostHeading::of(heading).unwrap();
            assert_eq!(found.column.cost, cost, "{heading}");
            assert_eq!(
                found.currency(heading).unwrap().as_deref(),
                currency,
                "{heading}"
            );
        }
        for heading in [
            "downtime [h]",
            "Downtime",
            "Neuwert",
            "downtime_cost [EUR]",
            "accepted_annual_rate",
        ] {
            assert!(
                CostHeading::of(heading).unwrap().currency(heading).is_err(),
                "{heading}"
            );
        }
        assert!(CostHeading::of("Notes").is_none());
    }

    #[test]
    fn columns_are_in_the_order_of_their_costs() {
        assert!(
            COST_COLUMNS
                .iter()
                .enumerate()
                .all(|(place, column)| column.cost as usize == place)
        );
    }
}
