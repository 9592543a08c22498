//! What failures cost, of a list as people keep it: a table with the names and the units that `risk` reads.

use std::path::Path;

use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::canonical;
use freestand_output::rows::csv_writer;

use super::columns::Column;
use super::numbers::{Number, Piece, pieces, plain};
use super::round::{ROUND, too_mild};
use super::vocabulary::is_no_value;
use super::{Edit, Inventory, Mapping, ReadOptions, inspect_inventory};
use crate::library::Lookup;

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

/// A column of costs: its name, what follows its currency in the unit, and its other headings in the form
/// of [`canonical`].
struct CostColumn {
    name: &'static str,
    /// `None`: it is no amount of money, and this is its unit.
    per: Result<&'static str, &'static str>,
    headings: &'static [&'static str],
}

const COST_COLUMNS: [CostColumn; 10] = [
    CostColumn {
        name: "repair_cost",
        per: Ok(""),
        headings: &[
            "repair cost",
            "cost of repair",
            "repair",
            "reparaturkosten",
            "cout de reparation",
            "costo de reparacion",
        ],
    },
    CostColumn {
        name: "replacement_cost",
        per: Ok(""),
        headings: &[
            "replacement cost",
            "replacement value",
            "cost of replacement",
            "insured value",
            "asset value",
            "neuwert",
            "wiederbeschaffungswert",
            "valeur a neuf",
            "valeur de remplacement",
            "valor de reposicion",
            "valore a nuovo",
            "valor de reposicao",
            "bedel",
            "取得価額",
            "重置价值",
        ],
    },
    CostColumn { name: "downtime", per: Err("day"), headings: &["downtime", "downtime days", "ausfalltage"] },
    CostColumn {
        name: "downtime_cost",
        per: Ok("/day"),
        headings: &["downtime cost", "cost of downtime", "ausfallkosten"],
    },
    CostColumn { name: "casualty_probability", per: Err(""), headings: &["casualty probability"] },
    CostColumn { name: "casualty_cost", per: Ok(""), headings: &["casualty cost"] },
    CostColumn { name: "accepted_annual_rate", per: Err("1/yr"), headings: &["accepted annual rate"] },
    CostColumn { name: "accepted_exceed_annual_rate", per: Err("1/yr"), headings: &["accepted exceed annual rate"] },
    CostColumn { name: "longitude", per: Err(""), headings: &["longitude", "lon"] },
    CostColumn { name: "latitude", per: Err(""), headings: &["latitude", "lat"] },
];

/// Whether a name is that of a column of costs; a mapping file may give it to a heading.
pub(super) fn cost_name(name: &str) -> Option<&'static str> {
    COST_COLUMNS.iter().find(|column| column.name == name).map(|column| column.name)
}

/// The name and the currency of a heading: `Replacement value NZD`, `Neuwert [EUR]`.
fn named(heading: &str, mapping: Option<&Mapping>) -> Option<(&'static CostColumn, Option<String>)> {
    let text = plain(heading);
    let (name, inner) = match text.find(['[', '(']) {
        Some(at) => (text.get(..at)?.trim(), text.get(at + 1..)?.trim_end_matches([']', ')', ' '])),
        None => (text.as_str(), ""),
    };
    let last = name.rsplit_once(' ').filter(|(_, last)| is_currency(last));
    let (name, last) = last.map_or((name, None), |(name, last)| (name, Some(last)));
    let currency = inner.split('/').next().map(str::trim).filter(|text| is_currency(text)).or(last).map(str::to_owned);
    if let Some((mapped, unit)) = mapping.and_then(|mapping| mapping.cost(heading)) {
        let column = COST_COLUMNS.iter().find(|column| column.name == mapped)?;
        return Some((column, unit.or(currency)));
    }
    let words = canonical(name);
    let is_it = |column: &&CostColumn| canonical(column.name) == words || column.headings.contains(&words.as_str());
    COST_COLUMNS.iter().find(is_it).map(|column| (column, currency))
}

fn is_currency(text: &str) -> bool {
    matches!(text, "$" | "€" | "£" | "¥") || text.len() == 3 && text.bytes().all(|byte| byte.is_ascii_uppercase())
}

/// The costs of a list as a CSV with the names that `risk` reads, each object in the line of its row; and
/// warnings.
///
/// # Errors
/// A list or a mapping file that cannot be read.
pub fn costs_of_list(path: &Path, request: &CellsRequest) -> Result<(Vec<u8>, Vec<String>), Problems> {
    let mapping = request.columns.as_deref().map(Mapping::load).transpose()?;
    let options = ReadOptions {
        sheet: request.sheet.as_deref(),
        mapping: mapping.as_ref(),
        edits: &request.edits,
        ..ReadOptions::new(&Lookup::NONE)
    };
    let reading = inspect_inventory(path, &options)?;
    let (bytes, mut warnings) = written(&reading.inventory, mapping.as_ref())?;
    // A number of objects that cannot be read counts as one.
    let counts = reading.inventory.findings.iter().filter(|one| one.column == Some(Column::Quantity));
    warnings.extend(counts.map(|one| format!("in the list: {}", one.line())));
    let items = reading.inventory.items.iter();
    let round: Vec<&str> = items.filter(|item| item.is_round).map(|item| &*item.id).collect();
    warnings.extend(too_mild(ROUND, &round));
    warnings.extend(reading.inventory.warnings);
    Ok((bytes, warnings))
}

fn written(inventory: &Inventory, mapping: Option<&Mapping>) -> Result<(Vec<u8>, Vec<String>), Problem> {
    let found: Vec<(usize, &CostColumn, Option<String>)> = inventory
        .carried
        .iter()
        .enumerate()
        .filter_map(|(slot, heading)| named(heading, mapping).map(|(column, currency)| (slot, column, currency)))
        .collect();
    let mut names = vec!["id".to_owned(), "item".to_owned(), "quantity".to_owned()];
    for (_, column, currency) in &found {
        let unit = match column.per {
            Ok(per) => currency.as_ref().map_or_else(String::new, |currency| format!(" [{currency}{per}]")),
            Err("") => String::new(),
            Err(unit) => format!(" [{unit}]"),
        };
        names.push(format!("{}{unit}", column.name));
    }
    let mut lines = vec![line(&names)?];
    let mut warnings = Vec::new();
    for item in &inventory.items {
        let mut cells = vec![item.id.clone(), item.item.clone(), item.quantity.to_string()];
        for (slot, column, _) in &found {
            let text = item.carried.get(*slot).map_or("", String::as_str);
            let value = amount(text, column.per.is_ok());
            if value.is_none() && !is_no_value(text) {
                let said = format!("row {}: \"{}\" is no {}: it is not counted", item.row, shorten(text), column.name);
                warnings.push(said);
            }
            cells.push(value.unwrap_or_default());
        }
        // A problem of a cell names the line: that is the row of the list.
        let row = usize::try_from(item.row).unwrap_or(usize::MAX);
        while lines.len() + 1 < row {
            lines.push("\n".to_owned());
        }
        lines.push(line(&cells)?);
    }
    Ok((lines.concat().into_bytes(), warnings))
}

fn line(cells: &[String]) -> Result<String, Problem> {
    let broken = || {
        let problem = Problem::new(ProblemKind::Computation, "the costs of a list cannot be written");
        problem.hint("this is a defect of freestand; please report it")
    };
    let mut writer = csv_writer();
    // A line break within a cell would move the lines behind it.
    writer.write_record(cells.iter().map(|cell| cell.replace(['\n', '\r'], " "))).map_err(|_| broken())?;
    let bytes = writer.into_inner().map_err(|_| broken())?;
    String::from_utf8(bytes).map_err(|_| broken())
}

/// The number of a cell, with a point; an amount of money never has three decimals.
fn amount(text: &str, is_money: bool) -> Option<String> {
    let text = plain(text);
    let outer = |c: char| c.is_alphabetic() || c.is_whitespace() || matches!(c, '$' | '€' | '£' | '¥' | '.');
    let bare = text.trim_matches(|c| outer(c) && !matches!(c, '.')).trim_end_matches('.');
    let percent = bare.strip_suffix('%').filter(|_| !is_money);
    let found = pieces(percent.unwrap_or(bare).trim());
    let [Piece::Number(number)] = found.as_slice() else { return None };
    let number = match number {
        Number::Sure(number, _) => number.clone(),
        Number::Either { as_thousands, .. } if is_money => as_thousands.clone(),
        Number::Either { .. } | Number::Malformed => return None,
    };
    Some(if percent.is_some() { (number.parse::<f64>().ok()? / 100.0).to_string() } else { number })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_as_registers_have_them() {
        for (text, expected) in [
            ("8400", Some("8400")),
            ("62,000", Some("62000")),
            ("$85,000", Some("85000")),
            ("28 000", Some("28000")),
            ("19.500", Some("19500")),
            ("1.250,50 EUR", Some("1250.50")),
            ("NZD 3200", Some("3200")),
            ("priceless", None),
            ("100-200", None),
            ("", None),
        ] {
            assert_eq!(amount(text, true).as_deref(), expected, "{text}");
        }
        assert_eq!(amount("5 %", false).as_deref(), Some("0.05"));
    }

    #[test]
    fn headings_of_costs_name_their_currency() {
        for (heading, name, currency) in [
            ("Replacement value NZD", "replacement_cost", Some("NZD")),
            ("replacement_cost [EUR]", "replacement_cost", Some("EUR")),
            ("Neuwert [NZD]", "replacement_cost", Some("NZD")),
            ("downtime_cost [EUR/day]", "downtime_cost", Some("EUR")),
            ("downtime [day]", "downtime", None),
        ] {
            let (column, found) = named(heading, None).unwrap();
            assert_eq!((column.name, found.as_deref()), (name, currency), "{heading}");
        }
        assert!(named("Notes", None).is_none());
    }
}
