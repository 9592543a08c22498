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
    let mut carried: Vec<(u32, String)> = Vec::new();
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
        match one {
            Some(one) => _ = candidates.insert(*index, one),
            None => carried.push((*index, heading.clone())),
        }
    }
    let mut warnings = Vec::new();
    by_content(&mut candidates, evidence, &mut carried);
    sides(&mut candidates, header, &mut carried, &mut warnings);
    let spoken = |language| {
        let all = candidates.values();
        all.filter(|one| one.language == language).count()
    };
    let is_japanese =
        spoken(Language::EastAsian) > spoken(Language::English) + spoken(Language::Comma);
    second_texts(&mut candidates, header, &mut carried);
    carried.sort_by_key(|(index, _)| *index);
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
        let all: Vec<(u32, Vec<(u32, CellUnit)>)> =
            columns.iter().map(|column| (*column, of(column))).collect();
        let mut stating = all.into_iter().filter(|(_, units)| !units.is_empty());
        let mut last = None;
        let next = stating.find_map(|(column, units)| {
            if column > one.index {
                return Some(units);
            }
            last = Some(units);
            None
        });
        one.row_units = next.or(last).unwrap_or_default();
    }
}

/// Of two columns with one name the better heading is read. The other is carried through where it
/// holds texts or ratios; a second quantity is compared with the first.
fn second_texts(candidates: &mut Candidates, header: &Header, carried: &mut Vec<(u32, String)>) {
    let mut seen: Vec<(Column, u16, u32)> = candidates
        .iter()
        .map(|(&index, one)| (one.column, one.rank, index))
        .collect();
    seen.sort_unstable_by_key(|&(column, rank, index)| (column as usize, rank, index));
    for pair in seen.windows(2) {
        let [(first, ..), (column, _, index)] = *pair else {
            continue;
        };
        let is_unit = column == Column::Unit;
        if first == column
            && !is_unit
            && dimension(column).is_none_or(|dimension| dimension == Dimension::Ratio)
        {
            candidates.remove(&index);
            carry(index, header, carried);
        }
    }
}

/// Carries a column through.
fn carry(index: u32, header: &Header, carried: &mut Vec<(u32, String)>) {
    carried.push((index, header.heading(index)));
}

/// Corrects what a heading alone cannot say: an "Item" of running numbers is an id, a column of
/// ratings without ratings is another one.
fn by_content(
    candidates: &mut Candidates,
    evidence: &Evidence<'_>,
    carried: &mut Vec<(u32, String)>,
) {
    let sample = |index: u32| -> Vec<String> {
        let texts = evidence
            .cells(index)
            .map(|(_, cell)| cell.shown().trim().to_owned());
        texts.filter(|text| !is_missing(text)).take(200).collect()
    };
    let is_number =
        |text: &String| text.chars().all(|c| c.is_ascii_digit() || c == '.') && !text.is_empty();
    let items: Vec<u32> = candidates
        .iter()
        .filter(|(_, one)| one.column == Column::Item)
        .map(|(index, _)| *index)
        .collect();
    let has_id = candidates.values().any(|one| one.column == Column::Id);
    if items.len() > 1 {
        for index in items {
            let texts = sample(index);
            if !texts.is_empty()
                && texts.iter().all(is_number)
                && let Some(one) = candidates.get_mut(&index)
            {
                one.column = Column::Id;
                one.rank = if has_id { 95 } else { 1 };
            }
        }
    }
    // "Masse" of a Swiss list may be sizes.
    for (index, one) in candidates
        .iter_mut()
        .filter(|(_, one)| one.column == Column::Mass)
    {
        let texts = sample(*index);
        let mm = find("mm", Dimension::Length).ok();
        let is_size = |text: &&String| sizes(&plain(text), mm, None, Choice::Decimal).is_ok();
        let sized = texts.iter().filter(is_size).count();
        if !texts.is_empty() && 2 * sized > texts.len() {
            one.column = Column::Dimensions;
        }
    }
    let mut dropped = Vec::new();
    // "Units" may be a number, "Unit" a ward or "each", "Height unit" a column of units.
    for (index, one) in candidates.iter_mut() {
        let is_size = matches!(
            dimension(one.column),
            Some(Dimension::Length | Dimension::Mass)
        );
        if !matches!(one.column, Column::Unit | Column::Quantity) && !is_size {
            continue;
        }
        let texts = sample(*index);
        let is_unit = |text: &&String| {
            [Dimension::Length, Dimension::Mass]
                .into_iter()
                .any(|dimension| cell_unit(text, dimension).is_some())
        };
        let units = texts.iter().filter(is_unit).count();
        if one.column == Column::Unit {
            if 2 * units < texts.len() || texts.is_empty() {
                dropped.push(*index);
            }
        } else if units == texts.len() && !texts.is_empty() {
            one.column = Column::Unit;
        }
    }
    for (index, one) in candidates.iter_mut() {
        if one.column.spec().holds != Holds::Rating {
            continue;
        }
        let texts = sample(*index);
        let rated = texts.iter().filter(|text| rating(text).is_some()).count();
        if texts.len() >= 3 && 2 * rated < texts.len() {
            let floors = texts.iter().filter(|text| storey(text).is_some()).count();
            let is_fl = canonical(&evidence.header.heading(*index)) == "fl";
            if is_fl && 2 * floors >= texts.len() {
                *one = Meaning {
                    rank: 60,
                    language: one.language,
                    ..Meaning::new(Column::Floor)
                };
            } else {
                dropped.push(*index);
            }
        }
    }
    for index in dropped {
        candidates.remove(&index);
        carry(index, evidence.header, carried);
    }
}

/// Beside a width and without a depth, a length is the longer side and the width the shorter.
fn sides(
    candidates: &mut Candidates,
    header: &Header,
    carried: &mut Vec<(u32, String)>,
    warnings: &mut Vec<String>,
) {
    let has = |candidates: &Candidates, column: Column| {
        candidates.values().any(|one| one.column == column)
    };
    let widths = |candidates: &Candidates, is_long: bool| -> Vec<u32> {
        let of = |one: &&Meaning| one.column == Column::Width && one.is_long_side == is_long;
        candidates
            .iter()
            .filter(|(_, one)| of(one))
            .map(|(index, _)| *index)
            .collect()
    };
    let long = widths(candidates, true);
    let mut short = widths(candidates, false);
    // French: L and l, both "l".
    if short.is_empty() && long.len() == 2 && !has(candidates, Column::Thickness) {
        short = long.get(1..).unwrap_or_default().to_vec();
    }
    if long.is_empty() || short.is_empty() {
        return;
    }
    if has(candidates, Column::Thickness) {
        for index in long {
            warnings.push(format!(
                "column {} ({}) is not read: there are a width and a depth already",
                letters(index as usize),
                header.heading(index)
            ));
            candidates.remove(&index);
            carry(index, header, carried);
        }
    } else {
        for index in short {
            if let Some(one) = candidates.get_mut(&index) {
                one.column = Column::Thickness;
            }
        }
    }
}
