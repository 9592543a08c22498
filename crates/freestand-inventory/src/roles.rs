//! Which column each heading is.

use std::collections::BTreeMap;

use freestand_input::quantity::Dimension;
use freestand_input::words::canonical;

use super::cell::{Cell, Row};
use super::cells::Choice;
use super::columns::{COLUMNS, Column, Holds, letters};
use super::floors::storey;
use super::headings::{HeadingUnit, Language, Meaning, dimension};
use super::layout::Header;
use super::numbers::plain;
use super::sentence::cell_unit;
use super::sizes::sizes;
use super::units::{CellUnit, find};
use super::used::{Dialect, Evidence, Understood, UnitSource, Use};
use super::vocabulary::{is_missing, rating};

/// What the headings of the columns that are read mean.
type Candidates = BTreeMap<u32, Meaning>;

/// Which column each heading is.
pub(super) fn roles(evidence: &Evidence<'_>) -> Understood {
    let Evidence {
        header, mapping, ..
    } = evidence;
    let mut candidates = Candidates::new();
    for (index, heading) in &header.headings {
        let found = header.meanings.get(index);
        let one = match mapping.and_then(|mapping| mapping.column(heading)) {
            Some(mapped) => mapped.column.map(|column| {
                let own = found.filter(|found| found.column == column);
                let own_unit = || own.map_or(HeadingUnit::None, |own| own.unit.clone());
                Meaning {
                    unit: mapped.unit.map_or_else(own_unit, HeadingUnit::Stated),
                    order: own.and_then(|own| own.order.clone()),
                    language: Language::Unsaid,
                    ..Meaning::new(column)
                }
            }),
            None => found.cloned(),
        };
        candidates.extend(one.map(|one| (*index, one)));
    }
    by_content(&mut candidates, evidence);
    let warnings = sides(&mut candidates, header);
    let spoken = |language| {
        let all = candidates.values();
        all.filter(|one| one.language == language).count()
    };
    let is_japanese =
        spoken(Language::EastAsian) > spoken(Language::English) + spoken(Language::Comma);
    second_texts(&mut candidates);
    let carried = header.headings.clone().into_iter();
    let carried = carried
        .filter(|(index, _)| !candidates.contains_key(index))
        .collect();
    let mut uses = Vec::with_capacity(candidates.len());
    let mut firsts: Vec<Vec<(u16, usize)>> = vec![Vec::new(); COLUMNS.len()];
    for (slot, (index, one)) in candidates.into_iter().enumerate() {
        if let Some(places) = firsts.get_mut(one.column as usize) {
            places.push((one.rank, slot));
        }
        uses.push(used(index, slot, one, evidence));
    }
    let by_rank = |mut places: Vec<(u16, usize)>| {
        places.sort_unstable();
        places.into_iter().map(|(_, slot)| slot).collect()
    };
    let firsts = firsts.into_iter().map(by_rank).collect();
    row_units(&mut uses, evidence);
    Understood {
        uses,
        firsts,
        carried,
        is_imperial: false,
        is_japanese,
        has_both_signs: false,
        warnings,
    }
}

/// A column with what its heading says.
fn used(index: u32, slot: usize, one: Meaning, evidence: &Evidence<'_>) -> Use {
    let heading = evidence.header.heading(index);
    let mapped = evidence
        .mapping
        .and_then(|mapping| mapping.column(&heading)?.unit);
    let source = match mapped {
        Some(_) => UnitSource::Mapping,
        None => UnitSource::Heading,
    };
    let (unit, wrong_unit) = match one.unit {
        HeadingUnit::Wrong(text) => (None, Some(text)),
        unit => (unit.stated(), None),
    };
    let later = evidence.body.units.iter();
    let later = later.filter(|(_, column, _)| *column == index);
    Use {
        index,
        slot,
        column: one.column,
        heading,
        unit,
        unit_source: unit.map(|_| source),
        wrong_unit,
        dialect: Dialect::Open,
        order: one.order,
        sentence_unit: None,
        later_units: later.map(|(row, _, unit)| (*row, *unit)).collect(),
        row_units: Vec::new(),
    }
}

/// The rows that have a unit of their own: of several columns of units the next to the right of a
/// column is its own, as in `Height, Unit, Weight, Unit`; else the last.
fn row_units(uses: &mut [Use], evidence: &Evidence<'_>) {
    let columns: Vec<u32> = uses
        .iter()
        .filter(|one| one.column == Column::Unit)
        .map(|one| one.index)
        .collect();
    for one in uses.iter_mut().filter(|_| !columns.is_empty()) {
        let Some(dimension) = dimension(one.column) else {
            continue;
        };
        let of = |column: &u32| -> Vec<(u32, CellUnit)> {
            let unit = |(row, cell): (&Row, &Cell)| {
                Some((row.number, cell_unit(&cell.shown(), dimension)?))
            };
            evidence.cells(*column).filter_map(unit).collect()
        };
        let stating: Vec<(u32, Vec<(u32, CellUnit)>)> = columns
            .iter()
            .map(|column| (*column, of(column)))
            .filter(|(_, units)| !units.is_empty())
            .collect();
        let next = stating.iter().find(|(column, _)| *column > one.index);
        let own = next.or(stating.last());
        one.row_units = own.map(|(_, units)| units.clone()).unwrap_or_default();
    }
}

/// Of two columns with one name the better heading is read. The other is carried through where it
/// holds texts or ratios; a second quantity is compared with the first.
fn second_texts(candidates: &mut Candidates) {
    let mut seen: Vec<(usize, u16, u32)> = candidates
        .iter()
        .map(|(&index, one)| (one.column as usize, one.rank, index))
        .collect();
    seen.sort_unstable();
    let is_compared = |column: Column| {
        column == Column::Unit || dimension(column).is_some_and(|of| of != Dimension::Ratio)
    };
    for pair in seen.windows(2) {
        if let [(first, ..), (column, _, index)] = pair
            && first == column
            && !is_compared(COLUMNS[*column].column)
        {
            candidates.remove(index);
        }
    }
}

/// Corrects what a heading alone cannot say: an "Item" of running numbers is an id, a column of
/// ratings without ratings is another one.
fn by_content(candidates: &mut Candidates, evidence: &Evidence<'_>) {
    let count = |column| {
        let all = candidates.values();
        all.filter(|one| one.column == column).count()
    };
    let (ids, items) = (count(Column::Id), count(Column::Item));
    let is_number = |text: &str| text.chars().all(|c| c.is_ascii_digit() || c == '.');
    let mm = find("mm", Dimension::Length).ok();
    let is_size = |text: &str| sizes(&plain(text), mm, None, Choice::Decimal).is_ok();
    let is_unit = |text: &str| {
        let mut measures = [Dimension::Length, Dimension::Mass].into_iter();
        measures.any(|dimension| cell_unit(text, dimension).is_some())
    };
    candidates.retain(|index, one| {
        let measure = dimension(one.column);
        let may_be_units = matches!(measure, Some(Dimension::Length | Dimension::Mass))
            || one.column == Column::Quantity;
        let is_rating = one.column.spec().holds == Holds::Rating;
        let is_word = matches!(one.column, Column::Item | Column::Unit);
        if !(may_be_units || is_rating || is_word) {
            return true;
        }
        let texts = sample(*index, evidence);
        let count = |is: &dyn Fn(&str) -> bool| texts.iter().filter(|text| is(text)).count();
        match (one.column, texts.len()) {
            // "Unit" may be a ward or "each".
            (Column::Unit, all) => return all > 0 && 2 * count(&is_unit) >= all,
            (_, 0) => return true,
            (Column::Item, all) if items > 1 && count(&is_number) == all => {
                one.column = Column::Id;
                one.rank = if ids > 0 { 95 } else { 1 };
            }
            // "Masse" of a Swiss list may be sizes.
            (Column::Mass, all) if 2 * count(&is_size) > all => one.column = Column::Dimensions,
            _ => {}
        }
        // "Units" may be a number, "Height unit" a column of units.
        if may_be_units && count(&is_unit) == texts.len() {
            one.column = Column::Unit;
        }
        let is_rated = |text: &str| rating(text).is_some();
        if !is_rating || texts.len() < 3 || 2 * count(&is_rated) >= texts.len() {
            return true;
        }
        let is_fl = canonical(&evidence.header.heading(*index)) == "fl";
        let is_floor = is_fl && 2 * count(&|text| storey(text).is_some()) >= texts.len();
        if is_floor {
            *one = Meaning {
                rank: 60,
                language: one.language,
                ..Meaning::new(Column::Floor)
            };
        }
        is_floor
    });
}

/// The first texts of a column that say something.
fn sample(index: u32, evidence: &Evidence<'_>) -> Vec<String> {
    let texts = evidence.cells(index);
    texts
        .map(|(_, cell)| cell.shown().trim().to_owned())
        .filter(|text| !is_missing(text))
        .take(200)
        .collect()
}

/// Beside a width and without a depth, a length is the longer side and the width the shorter; beside both it
/// is not read, which is said.
fn sides(candidates: &mut Candidates, header: &Header) -> Vec<String> {
    let has_depth = candidates
        .values()
        .any(|one| one.column == Column::Thickness);
    let widths = candidates
        .iter()
        .filter(|(_, one)| one.column == Column::Width)
        .map(|(index, one)| (*index, one.is_long_side));
    let (long, mut short): (Vec<_>, Vec<_>) = widths.partition(|(_, is_long)| *is_long);
    // French: L and l, both "l".
    if short.is_empty() && long.len() == 2 && !has_depth {
        short.extend(long.get(1));
    }
    if long.is_empty() || short.is_empty() {
        return Vec::new();
    }
    if !has_depth {
        for (index, _) in short {
            if let Some(one) = candidates.get_mut(&index) {
                one.column = Column::Thickness;
            }
        }
        return Vec::new();
    }
    let left_out = |(index, _): (u32, bool)| {
        candidates.remove(&index);
        format!(
            "column {} ({}) is not read: there are a width and a depth already",
            letters(index as usize),
            header.heading(index)
        )
    };
    long.into_iter().map(left_out).collect()
}
