//! The columns of a list that are read, and what is known about each.

use super::cell::{Cell, Row};
use super::cells::{Choice, Wrong, number_text};
use super::columns::Column;
use super::layout::{Body, Header};
use super::mapping::{Headed, Mapping};
use super::numbers::Decimal;
use super::problems::Place;
use super::sizes::{Sizes, sizes};
use super::units::{CellUnit, is_metric};

/// Where the unit of a column comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum UnitSource {
    Mapping,
    Heading,
    UnitRow,
    Sentence,
    Cells,
    Plausibility,
}

impl UnitSource {
    /// Whether a person might have chosen another.
    pub(super) fn is_assumed(self) -> bool {
        matches!(self, Self::Cells | Self::Plausibility)
    }
}

/// The decimal sign of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dialect {
    /// Nothing needs one, or nothing says which.
    Open,
    One(Decimal),
    /// Some cells have a comma, some a point.
    Mixed,
}

impl Dialect {
    pub(super) fn name(self) -> Option<&'static str> {
        match self {
            Self::Open => None,
            Self::One(sign) => Some(sign.name()),
            Self::Mixed => Some("mixed"),
        }
    }
}

/// A column that is read.
#[derive(Debug, Clone)]
pub(super) struct Use {
    /// Its place in the sheet, counted from 0.
    pub index: u32,
    /// Its place among the columns that are read.
    pub slot: usize,
    pub column: Column,
    pub heading: String,
    pub unit: Option<CellUnit>,
    pub unit_source: Option<UnitSource>,
    /// What the heading states, where that is not a unit of it.
    pub wrong_unit: Option<String>,
    pub dialect: Dialect,
    pub order: Option<Vec<char>>,
    /// The unit that a sentence of the list states for it, where its heading states one.
    pub sentence_unit: Option<CellUnit>,
    /// Units from a row on.
    pub later_units: Vec<(u32, CellUnit)>,
    /// Rows with a unit of their own, in a column of units.
    pub row_units: Vec<(u32, CellUnit)>,
}

impl Use {
    /// Its place for problems.
    pub(super) fn place(&self) -> Place<'_> {
        Place {
            column: Some(self.column),
            index: Some(self.index),
            heading: Some(&self.heading),
        }
    }

    /// Takes a unit.
    pub(super) fn take_unit(&mut self, unit: CellUnit, source: UnitSource) {
        self.unit = Some(unit);
        self.unit_source = Some(source);
    }

    /// The sizes in one of its cells.
    pub(super) fn sizes(
        &self,
        text: &str,
        unit: Option<CellUnit>,
        choice: Choice,
    ) -> Result<Sizes, Wrong> {
        sizes(text, unit, self.order.as_deref(), choice)
    }

    /// The unit of bare numbers in a row.
    pub(super) fn unit_at(&self, row: u32) -> Option<CellUnit> {
        self.stated_at(row)
            .or_else(|| self.row_unit(row))
            .or(self.unit)
    }

    /// The unit that is stated for the whole column, or for a part of it.
    fn stated_at(&self, row: u32) -> Option<CellUnit> {
        let later = self
            .later_units
            .iter()
            .rev()
            .find(|(from, _)| *from < row)
            .map(|(_, unit)| *unit);
        later.or_else(|| {
            self.unit
                .filter(|_| !self.unit_source.is_some_and(UnitSource::is_assumed))
        })
    }

    pub(super) fn row_unit(&self, row: u32) -> Option<CellUnit> {
        let at = self
            .row_units
            .binary_search_by_key(&row, |(row, _)| *row)
            .ok()?;
        self.row_units.get(at).map(|(_, unit)| *unit)
    }

    /// Two units of a row that differ, in words, where no mapping file decides.
    pub(super) fn contradiction_at(&self, row: u32) -> Option<String> {
        let stated = self
            .stated_at(row)
            .filter(|_| self.unit_source != Some(UnitSource::Mapping))?;
        // A row of units below a sentence is the later word.
        let sentence = self.sentence_unit.filter(|_| Some(stated) == self.unit);
        let others = [
            (self.row_unit(row), "the row"),
            (sentence, "a sentence of the list"),
        ];
        let (other, by) = others
            .into_iter()
            .find_map(|(unit, by)| Some((unit.filter(|unit| *unit != stated)?, by)))?;
        Some(format!(
            "{} by the heading, {} by {by}",
            stated.symbol(),
            other.symbol()
        ))
    }

    /// Whether the unit is neither in the heading nor in the cells.
    pub(super) fn is_unit_stated_outside(&self) -> bool {
        matches!(
            self.unit_source,
            Some(UnitSource::UnitRow | UnitSource::Sentence)
        )
    }

    /// Whether the unit of a bare number of a row was assumed.
    pub(super) fn is_unit_assumed(&self, row: u32) -> bool {
        self.unit_source.is_some_and(UnitSource::is_assumed)
            && self.stated_at(row).is_none()
            && self.row_unit(row).is_none()
    }
}

/// The columns of a list.
#[derive(Debug)]
pub(super) struct Understood {
    /// In the order of the sheet; of two with one name the one that is read comes first in `firsts`.
    pub uses: Vec<Use>,
    /// For each known column the places in `uses`, the one that is read first.
    pub firsts: Vec<Vec<usize>>,
    /// Columns that are carried through, with their headings.
    pub carried: Vec<(u32, String)>,
    pub is_imperial: bool,
    pub is_japanese: bool,
    /// Whether both decimal signs occur in it.
    pub has_both_signs: bool,
    pub warnings: Vec<String>,
}

/// What the columns are decided from.
pub(super) struct Evidence<'a> {
    pub rows: &'a [Row],
    pub header: &'a Header,
    pub body: &'a Body,
    pub mapping: Option<&'a Mapping>,
    /// Whether `;` separates the cells, as where commas are decimal signs.
    pub has_semicolons: bool,
}

impl Evidence<'_> {
    pub(super) fn cells(&self, index: u32) -> impl Iterator<Item = (&Row, &Cell)> {
        self.body
            .rows(self.rows)
            .filter_map(move |row| Some((row, row.get(index)?)))
    }

    /// The texts of a column that may hold numbers.
    pub(super) fn texts(&self, index: u32) -> impl Iterator<Item = (&Row, String)> {
        self.cells(index).filter_map(|(row, cell)| match cell {
            Cell::Text(_) => Some((row, number_text(cell).ok().flatten()?)),
            _ => None,
        })
    }

    /// The cells of a column that may hold numbers, in rows for which no unit is known.
    pub(super) fn open_texts(&self, one: &Use) -> impl Iterator<Item = (&Cell, String)> {
        self.cells(one.index)
            .filter(|(row, _)| one.unit_at(row.number).is_none())
            .filter_map(|(_, cell)| Some((cell, number_text(cell).ok().flatten()?)))
    }
}

impl Understood {
    /// The columns with one name, the one that is read first.
    pub(super) fn all(&self, column: Column) -> impl Iterator<Item = &Use> {
        self.firsts
            .get(column as usize)
            .into_iter()
            .flatten()
            .filter_map(|place| self.uses.get(*place))
    }

    /// The column with this name.
    pub(super) fn get(&self, column: Column) -> Option<&Use> {
        self.all(column).next()
    }

    /// Of each unit that is known, whether it is metric.
    pub(super) fn systems(&self) -> Vec<bool> {
        let uses = self.uses.iter();
        uses.filter_map(|one| is_metric(one.unit?)).collect()
    }

    /// Every heading with what it was taken for, as a mapping file has it.
    pub(super) fn headings(&self, header: &Header) -> Vec<Headed> {
        let one = |(index, heading): (&u32, &String)| {
            let found = self.uses.iter().find(|one| one.index == *index);
            (
                heading.clone(),
                found.map(|one| one.column),
                found.and_then(|one| one.unit),
            )
        };
        header.headings.iter().map(one).collect()
    }
}
