//! Which columns of the file freestand reads, and which are carried through.

use std::collections::BTreeMap;

use freestand_input::quantity::{Dimension, Unit, shorten};

use super::columns::{COLUMNS, Column, Heading, Holds, heading, letters, meant};
use super::findings::Findings;
use super::header::Header;

/// Largest number of columns that are carried through; an asset register has some dozens.
pub(super) const MAX_CARRIED: usize = 256;
/// Largest number of headings that are checked for typing mistakes.
const MAX_MEANT: usize = 20;

/// The place of a known column in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    /// Its column, from 0.
    pub(super) index: u32,
    /// Its heading in the file.
    pub(super) heading: String,
    /// The unit of numbers without one; `None`: each cell has its own unit.
    pub(super) unit: Option<&'static Unit>,
    /// Whether its cells can be read: `false` if the unit in the heading is wrong.
    pub(super) is_readable: bool,
}

/// What a column of the file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// A column without a heading.
    Unnamed,
    Ours(Column),
    /// The n-th column that is carried through.
    Carried(usize),
}

/// The columns of a file.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    places: Vec<Option<Place>>,
    roles: BTreeMap<u32, Role>,
    /// Headings that are carried through, in the order of the file.
    pub(super) carried: Vec<String>,
    /// One more than the last column that has a heading.
    pub(super) width: u32,
    /// Largest number of cells in a row, where the file says so.
    pub(super) widest: u32,
}

impl Layout {
    /// Interprets the headings; problems are added to `findings`, warnings to `warnings`.
    pub(super) fn new(header: &Header, findings: &mut Findings<'_>, warnings: &mut Vec<String>) -> Self {
        let width = header.headings.keys().last().map_or(0, |last| last + 1);
        let mut layout = Self {
            places: vec![None; COLUMNS.len()],
            roles: BTreeMap::new(),
            carried: Vec::new(),
            width,
            widest: header.width.map_or(width, |cells| cells.max(width)),
        };
        let mut looked_into = 0;
        for (&index, text) in &header.headings {
            match heading(text) {
                Heading::Ours(column, unit) => {
                    let unit = unit.or_else(|| header.units.get(&index).copied());
                    layout.take(
                        column,
                        Place { index, heading: text.clone(), unit, is_readable: true },
                        header,
                        findings,
                    );
                }
                Heading::BadUnit(column, unit) => {
                    let place = format!("column {} ({})", letters(index as usize), shorten(text));
                    let message = format!("{place}: \"{}\" is not a unit of {}", shorten(&unit), column.name());
                    findings.of_file(header.line, message, unit_hint(column));
                    layout.take(
                        column,
                        Place { index, heading: text.clone(), unit: None, is_readable: false },
                        header,
                        findings,
                    );
                }
                Heading::Other => {
                    layout.roles.insert(index, Role::Carried(layout.carried.len()));
                    layout.carried.push(text.clone());
                    looked_into += 1;
                    if looked_into <= MAX_MEANT
                        && let Some(hint) = meant(text)
                    {
                        let place = format!("column {} ({})", letters(index as usize), shorten(text));
                        warnings.push(format!("{place} is not read, only carried through: {hint}"));
                    }
                }
            }
        }
        layout.check(header, findings);
        layout
    }

    fn take(&mut self, column: Column, place: Place, header: &Header, findings: &mut Findings<'_>) {
        if let Some(other) = self.place(column) {
            let message = format!(
                "columns {} ({}) and {} ({}) are both {}",
                letters(other.index as usize),
                shorten(&other.heading),
                letters(place.index as usize),
                shorten(&place.heading),
                column.name()
            );
            findings.of_file(header.line, message, "keep one of them, or rename the other");
            return;
        }
        self.roles.insert(place.index, Role::Ours(column));
        if let Some(slot) = self.places.get_mut(column as usize) {
            *slot = Some(place);
        }
    }

    fn check(&self, header: &Header, findings: &mut Findings<'_>) {
        for spec in COLUMNS.iter().filter(|spec| spec.is_required) {
            if self.place(spec.column).is_none() {
                let unit = if spec.unit.is_empty() { String::new() } else { format!(" [{}]", spec.unit) };
                let near = self.carried.iter().take(MAX_MEANT);
                let near = near.filter(|text| meant(text).is_some_and(|hint| hint.contains(spec.name)));
                let hint = match near.map(|text| shorten(text)).next() {
                    Some(near) => {
                        format!("if \"{near}\" is that column, rename it \"{}{unit}\": {}", spec.name, spec.meaning)
                    }
                    None => format!(
                        "add a column \"{}{unit}\" ({}); leave a cell empty if its value is not known",
                        spec.name, spec.meaning
                    ),
                };
                findings.of_file(header.line, format!("the column {} is missing", spec.name), hint);
            }
        }
        if self.carried.len() > MAX_CARRIED {
            let message =
                format!("the file has {} other columns; at most {MAX_CARRIED} are carried through", self.carried.len());
            findings.of_file(header.line, message, "remove columns that are not needed");
        }
    }

    /// The place of a column.
    pub(super) fn place(&self, column: Column) -> Option<&Place> {
        self.places.get(column as usize).and_then(Option::as_ref)
    }

    /// What a column of the file is.
    pub(super) fn role(&self, index: u32) -> Role {
        self.roles.get(&index).copied().unwrap_or(Role::Unnamed)
    }

    /// The known columns, as they were interpreted.
    pub(super) fn columns(&self) -> Vec<ColumnRead> {
        let ours = self.places.iter().zip(&COLUMNS).filter_map(|(place, spec)| Some((place.as_ref()?, spec)));
        let mut columns: Vec<(u32, ColumnRead)> = ours
            .map(|(place, spec)| {
                let unit = match (spec.holds, place.unit) {
                    (_, Some(unit)) => Some(unit.symbol.to_owned()),
                    (Holds::Quantity(dimension), None) if dimension != Dimension::Ratio => {
                        Some("in each cell".to_owned())
                    }
                    _ => None,
                };
                let letter = letters(place.index as usize);
                (place.index, ColumnRead { letter, heading: place.heading.clone(), name: spec.name, unit })
            })
            .collect();
        columns.sort_by_key(|(index, _)| *index);
        columns.into_iter().map(|(_, column)| column).collect()
    }
}

/// A known column, as it was interpreted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ColumnRead {
    /// Its letter in a spreadsheet: `F`.
    pub letter: String,
    /// Its heading in the file.
    pub heading: String,
    /// Its name in freestand.
    pub name: &'static str,
    /// The unit of its numbers; `None`: text or ratios.
    pub unit: Option<String>,
}

/// What to write in place of a wrong unit.
pub(super) fn unit_hint(column: Column) -> String {
    let spec = column.spec();
    let Holds::Quantity(dimension) = spec.holds else { return "remove the brackets".to_owned() };
    let units: Vec<&str> = dimension.units().map(|unit| unit.symbol).take(6).collect();
    format!("write one of {}, such as \"{} [{}]\"", units.join(", "), spec.name, spec.unit)
}
