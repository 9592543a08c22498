//! The columns of `objects.csv`, of the Parquet file and of the workbook: one list for all three.

mod columns;

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use freestand_assess::result::Assessment;
use freestand_inventory::{Inventory, Item};
use freestand_study::result::Ranked;

#[cfg(test)]
use super::Row;

pub(super) use columns::COLUMNS;

/// One object of the inventory, assessed or not yet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line<'a> {
    /// Its row of the inventory.
    pub item: &'a Item,
    /// Its rank and its assessment; `None`: the run was interrupted before it.
    pub found: Option<(usize, &'a Assessment)>,
}

impl<'a> Line<'a> {
    /// The line of a row.
    #[cfg(test)]
    pub(super) fn of(row: &'a Row<'a>) -> Self {
        Self {
            item: row.item,
            found: Some((row.rank, &row.found)),
        }
    }

    /// Its assessment.
    pub(super) fn assessment(&self) -> Option<&'a Assessment> {
        self.found.map(|(_, found)| found)
    }
}

/// The type of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Text.
    Text,
    /// The name of a decision.
    Decision,
    /// A number.
    Number,
    /// A share or a probability, which people read in percent.
    Share,
    /// A whole number.
    Count,
    /// A number, or `overturned`, which ranks above every number.
    Ranked,
    /// `true` or `false`.
    Flag,
}

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cell<'a> {
    /// A text.
    Text(Cow<'a, str>),
    /// A finite number.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// `overturned`, which ranks above every number.
    Overturned,
    /// Yes or no.
    Flag(bool),
    /// Nothing: an empty field, a null.
    Missing,
}

impl<'a> Cell<'a> {
    /// A text; an empty one is missing.
    pub(super) fn text(text: &'a str) -> Self {
        if text.is_empty() {
            Self::Missing
        } else {
            Self::Text(Cow::Borrowed(text))
        }
    }

    /// A text made for the cell.
    pub(super) fn owned(text: Option<String>) -> Self {
        text.filter(|text| !text.is_empty())
            .map_or(Self::Missing, |text| Self::Text(Cow::Owned(text)))
    }

    /// A number; one that is not finite is missing.
    pub(super) fn number(value: Option<f64>) -> Self {
        value
            .filter(|value| value.is_finite())
            .map_or(Self::Missing, Self::Number)
    }

    /// A whole number.
    pub(super) fn count(value: Option<usize>) -> Self {
        value.map_or(Self::Missing, |value| Self::Count(value as u64))
    }

    /// A number, or `overturned`.
    pub(super) fn ranked(value: Option<Ranked>) -> Self {
        match value {
            Some(Ranked::Value(value)) => Self::number(Some(value)),
            Some(Ranked::Overturned) => Self::Overturned,
            Some(Ranked::NoData) | None => Self::Missing,
        }
    }
}

/// A column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    /// Its header, with the unit at its end.
    pub name: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// Its unit, `–` where it has none.
    pub unit: &'static str,
    /// What it means, for the sheet of columns.
    pub meaning: &'static str,
    /// Makes the cell of an object.
    pub cell: for<'a> fn(&Line<'a>) -> Cell<'a>,
}

/// The key of the number of an object's row in the inventory, which only the JSON rows have.
pub(super) const ROW: &str = "row";

/// The headers of the columns that are carried through. One that equals a column of freestand or an
/// earlier header is renamed, because an inventory may be the `objects.csv` of an earlier run.
pub(super) fn carried_names(carried: &[String]) -> Vec<String> {
    // Spreadsheets and databases treat `Rank` and `rank` as one name.
    let ours = COLUMNS
        .iter()
        .flat_map(|column| [column.name.to_owned(), overturned_name(column)]);
    let mut taken: HashSet<String> = ours.map(|name| name.to_lowercase()).collect();
    // The JSON rows have the number of the row besides the columns.
    taken.insert(ROW.to_owned());
    // How often a header was found: a thousand equal ones are not each compared with all others.
    let mut met: HashMap<String, usize> = HashMap::new();
    let mut names = Vec::with_capacity(carried.len());
    for (i, header) in carried.iter().enumerate() {
        let header = header.trim();
        let base = if header.is_empty() {
            format!("column {}", i + 1)
        } else {
            header.to_owned()
        };
        let count = met.entry(base.to_lowercase()).or_default();
        let mut name = base.clone();
        while !taken.insert(name.to_lowercase()) {
            *count += 1;
            name = if *count == 1 {
                format!("{base} (inventory)")
            } else {
                format!("{base} (inventory {count})")
            };
        }
        names.push(name);
    }
    names
}

/// The cells that are carried through: one for each header, however many the row has.
pub(super) fn carried_cells<'a>(
    inventory: &Inventory,
    item: &'a Item,
) -> impl Iterator<Item = Cell<'a>> {
    (0..inventory.carried.len()).map(|i| {
        item.carried
            .get(i)
            .map_or(Cell::Missing, |text| Cell::text(text))
    })
}

/// The name of the Boolean column that is `true` where a ranked number is `overturned`.
pub(super) fn overturned_name(column: &Column) -> String {
    format!("{}_overturned", column.name)
}

#[cfg(test)]
mod tests;
