//! Which readings of a cell are plausible.

use freestand_input::quantity::Dimension;

use super::cell::{Cell, Row};
use super::cells::{Choice, is_open, number_text, quantity};
use super::columns::Column;
use super::headings::dimension;
use super::numbers::is_plausible;
use super::plausible::is_density_plausible;
use super::units::CellUnit;
use super::used::{Dialect, Evidence, Understood, Use};

/// How a cell of a column is read; `None`: it has two readings and nothing decides.
pub(super) fn choice_of(cell: &Cell, text: &str, dialect: Dialect) -> Option<Choice> {
    match (cell, dialect) {
        // A number of a workbook is a number.
        (Cell::Number(_), _) => Some(Choice::Decimal),
        (_, Dialect::One(sign)) => Some(Choice::Sign(sign)),
        _ => (!is_open(text)).then_some(Choice::Decimal),
    }
}

/// Bare sizes of a column in this unit: how many are plausible, of how many.
pub(super) fn plausible_count(
    evidence: &Evidence<'_>,
    one: &Use,
    unit: CellUnit,
) -> (usize, usize) {
    let (mut good, mut count) = (0, 0);
    let Some(dimension) = dimension(one.column) else {
        return (0, 0);
    };
    let mut judge = |column, value| {
        count += 1;
        good += usize::from(is_plausible(column, value));
    };
    for (cell, text) in evidence.open_texts(one) {
        // What has two readings says nothing about the unit.
        let Some(choice) = choice_of(cell, &text, one.dialect) else {
            continue;
        };
        if one.column == Column::Dimensions {
            if let Ok(found) = one.sizes(&text, Some(unit), choice)
                && found.is_bare
            {
                found.sides().for_each(|(side, size)| judge(side, size));
            }
        } else if let Ok(found) = quantity(&text, dimension, Some(unit), choice)
            && found.is_bare
        {
            judge(one.column, found.si);
        }
    }
    (good, count)
}

/// Whether a reading of a cell is one that such an object can have.
pub(super) fn is_plausible_reading(
    all: &Understood,
    one: &Use,
    row: &Row,
    text: &str,
    choice: Choice,
) -> bool {
    let unit = one.unit_at(row.number);
    if one.column == Column::Dimensions {
        return one
            .sizes(text, unit, choice)
            .is_ok_and(|found| found.sides().all(|(side, size)| is_plausible(side, size)));
    }
    let dimension = dimension(one.column).unwrap_or(Dimension::Ratio);
    let Ok(found) = quantity(text, dimension, unit, choice) else {
        return false;
    };
    if one.column == Column::Mass
        && let Some(volume) = volume(all, row)
    {
        return is_density_plausible(found.si, volume);
    }
    is_plausible(one.column, found.si)
}

/// The volume of the box around the object of a row \[m³\], if its sizes have only one reading.
/// Sizes that no object has say nothing about the mass.
fn volume(all: &Understood, row: &Row) -> Option<f64> {
    let size = |column: Column| {
        let one = all.get(column)?;
        let cell = row.get(one.index)?;
        let text = number_text(cell).ok().flatten()?;
        let read = |choice| {
            let found = quantity(&text, Dimension::Length, one.unit_at(row.number), choice).ok()?;
            Some(found.si)
        };
        let is_size = |size: &f64| is_plausible(column, *size);
        if let Some(choice) = choice_of(cell, &text, one.dialect) {
            return read(choice).filter(is_size);
        }
        let [decimal, thousands] =
            [Choice::Decimal, Choice::Thousands].map(|choice| read(choice).filter(is_size));
        decimal.xor(thousands)
    };
    if let Some(one) = all.get(Column::Dimensions)
        && let Some(cell) = row.get(one.index)
        && let Ok(Some(text)) = number_text(cell)
    {
        let choice = choice_of(cell, &text, one.dialect)?;
        let found = one.sizes(&text, one.unit_at(row.number), choice).ok()?;
        return Some(
            found.height.or_else(|| size(Column::Height))? * found.thickness? * found.width?,
        );
    }
    let (height, thickness) = (size(Column::Height)?, size(Column::Thickness)?);
    Some(height * thickness * size(Column::Width).unwrap_or(thickness))
}
