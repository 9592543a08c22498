//! Sizes that no object has, or that are ten times off the other rows of their column: nothing is
//! calculated with them until a person has confirmed or corrected the cell.

use freestand_input::quantity::{Dimension, shorten};
use freestand_input::words::number;
use freestand_study::shape::{HEIGHT_M, SIDE_M};

use super::Item;
use super::columns::{Column, letters};
use super::edit::Edit;
use super::numbers::plain;
use super::problems::{Findings, Kind, Place};
use super::units::{CellUnit, find};

/// Height over the shorter side: a pole without a base.
const MAX_SLENDERNESS: f64 = 40.0;
/// Density of the box around an object \[kg/m³\]: nothing is heavier than gold, and no box is as light
/// as air.
const DENSITY: std::ops::RangeInclusive<f64> = 1.2..=20e3;
/// A size typed in a unit that is ten times another: its own spread about the median is ±10 %.
const TEN_TIMES: f64 = 9.0;
/// In a list of many kinds of objects sizes spread: a size is off only beyond this many standard
/// deviations of the column, estimated from the median of the deviations (1.4826 for a normal law).
const SPREAD: f64 = 3.5 * 1.4826;
/// Rows of a column from which its median says what is usual.
const MIN_ROWS: usize = 5;

/// A cell of a size, with the object that it belongs to.
pub(super) struct SizeCell {
    pub column: Column,
    /// The place of the column in the sheet.
    pub index: u32,
    pub heading: String,
    pub row: u32,
    pub text: String,
    /// Of the bare number; `None`: the cell states its own.
    pub unit: Option<CellUnit>,
}

impl SizeCell {
    fn name(&self) -> String {
        format!("{}{}", letters(self.index as usize), self.row)
    }

    /// The text with which the cell would be mended, or confirmed where nothing mends it.
    fn edit(&self, median_m: Option<f64>) -> String {
        const UNITS: [&str; 5] = ["mm", "cm", "m", "in", "ft"];
        let text = plain(&self.text);
        let digits = text.trim_end_matches(|c: char| !c.is_ascii_digit()).trim();
        let own = self.unit.map(CellUnit::symbol);
        let in_unit = |unit: &'static str| {
            let value = find(unit, Dimension::Length)
                .ok()?
                .read(&digits.replace(',', "."))
                .ok()?;
            let far = (value / median_m.unwrap_or(usual_m(self.column)))
                .ln()
                .abs();
            // A factor of three on either side: what differs more is no better.
            (Some(unit) != own && range(self.column).contains(&value) && far < 3f64.ln())
                .then_some((far, unit))
        };
        let best = UNITS
            .into_iter()
            .filter_map(in_unit)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match best {
            Some((_, unit)) => format!("{}={digits} {unit}", self.name()),
            None => format!("{}={}", self.name(), self.text.trim()),
        }
    }
}

/// A size of furniture, where the column has too few rows to say what is usual in it \[m\].
fn usual_m(column: Column) -> f64 {
    if column == Column::Height { 1.5 } else { 0.6 }
}

/// The median of the sizes of a column, and the median deviation from it in logarithms.
struct Usual {
    median_m: f64,
    deviation: f64,
}

fn usual(items: &[Item], column: Column) -> Option<Usual> {
    let mut logs: Vec<f64> = items
        .iter()
        .filter_map(|item| value(item, column))
        .map(f64::ln)
        .collect();
    if logs.len() < MIN_ROWS {
        return None;
    }
    // Where most of a column is impossible, its median is no measure.
    let middle = median(&mut logs).filter(|middle| range(column).contains(&middle.exp()))?;
    let mut deviations: Vec<f64> = logs.iter().map(|log| (log - middle).abs()).collect();
    Some(Usual {
        median_m: middle.exp(),
        deviation: median(&mut deviations)?,
    })
}

/// A positive size of an object \[m\].
fn value(item: &Item, column: Column) -> Option<f64> {
    let value = match column {
        Column::Height => item.height_m,
        Column::Width => item.width_m,
        _ => item.thickness_m,
    };
    value.filter(|value| *value > 0.0)
}

fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// Finds such sizes, except in cells that an edit has confirmed; the objects get the edits to confirm.
/// `cell` finds the cell of a size.
pub(super) fn confirm(
    items: &mut [Item],
    edits: &[Edit],
    findings: &mut Findings,
    cell: &dyn Fn(&Item, Column) -> Option<SizeCell>,
) {
    let columns = [Column::Height, Column::Thickness, Column::Width];
    let usual = columns.map(|column| usual(items, column));
    for item in items {
        for (column, usual) in columns.into_iter().zip(&usual) {
            let Some(why) =
                value(item, column).and_then(|value| why(value, column, item, usual.as_ref()))
            else {
                continue;
            };
            let Some(cell) = cell(item, column) else {
                continue;
            };
            if edits.iter().any(|edit| edit.is_of(cell.row, cell.index)) {
                continue;
            }
            let edit = cell.edit(usual.as_ref().map(|usual| usual.median_m));
            let at = Place {
                column: Some(column),
                index: Some(cell.index),
                heading: Some(&cell.heading),
            };
            let said = format!(
                "such a size is hardly possible; \"{}\", for example, was read as {why}",
                shorten(cell.text.trim())
            );
            let kind = Kind::ImplausibleSize;
            findings.add(kind, at, Some(cell.row), &cell.text, &said);
            findings.propose(kind, at, &edit);
            if !item.to_confirm.contains(&edit) {
                item.to_confirm.push(edit);
            }
            if !item.doubts.contains(&kind) {
                item.doubts.push(kind);
            }
        }
    }
}

/// Why a size is not believed, after "was read as".
fn why(value_m: f64, column: Column, item: &Item, usual: Option<&Usual>) -> Option<String> {
    let range = range(column);
    let said = |what: String| Some(format!("{} m, {what}", number(value_m, 4)));
    if !range.contains(&value_m) {
        let (low, high) = (range.start(), range.end());
        return said(format!("and such a size is between {low} and {high} m"));
    }
    if let Some(usual) = usual {
        let far = (value_m / usual.median_m).ln().abs();
        if far >= TEN_TIMES.ln() && far > SPREAD * usual.deviation {
            let times = number(far.exp(), 2);
            let is_smaller = value_m < usual.median_m;
            let than = if is_smaller { "smaller" } else { "larger" };
            return said(format!(
                "{times} times {than} than the median of its column"
            ));
        }
    }
    let (height_m, thickness_m) = (item.height_m?, item.thickness_m?);
    let shorter_m = item
        .width_m
        .map_or(thickness_m, |width_m| width_m.min(thickness_m));
    if height_m > MAX_SLENDERNESS * shorter_m {
        let times = number(height_m / shorter_m, 3);
        return said(format!("and the height is {times} times the shorter side"));
    }
    let density = item.mass_kg? / (height_m * thickness_m * item.width_m?);
    let is_possible = DENSITY.contains(&density);
    let density = number(density, 2);
    said(format!("and the object would weigh {density} kg/m³")).filter(|_| !is_possible)
}

/// Whether an object can have such a size.
pub(super) fn is_possible(column: Column, value_m: f64) -> bool {
    range(column).contains(&value_m)
}

fn range(column: Column) -> std::ops::RangeInclusive<f64> {
    if column == Column::Height {
        HEIGHT_M
    } else {
        SIDE_M
    }
}
