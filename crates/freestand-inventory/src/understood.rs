//! What each column of a list is: its name, its unit and its decimal sign, each with its evidence.

use freestand_input::quantity::Dimension;
use freestand_input::words::canonical;

use super::cells::{Choice, evidence, is_bare, is_open, stated_unit};
use super::columns::{Column, Holds};
use super::headings::{Language, dimension};
use super::layout::{LeftOut, RowKind, SIZES};
use super::numbers::Decimal;
use super::readings::{is_plausible_reading, plausible_count};
use super::roles::roles;
use super::sentence::sentence_unit;
use super::units::{CellUnit, find, is_metric};
use super::used::{Dialect, Evidence, Understood, UnitSource, Use};
use super::vocabulary::is_among;

/// Decides what every column is.
pub(super) fn understand(evidence: &Evidence<'_>) -> Understood {
    let mut all = roles(evidence);
    stated_units(&mut all, evidence);
    dialects(&mut all, evidence);
    assumed_units(&mut all, evidence);
    plausible_dialects(&mut all, evidence);
    let systems = all.systems();
    let metric = systems.iter().filter(|&&metric| metric).count();
    all.is_imperial = match systems.len() {
        0 => cells_are_imperial(&all, evidence),
        count => 2 * metric < count,
    };
    all
}

fn cells_are_imperial(all: &Understood, evidence: &Evidence<'_>) -> bool {
    let (mut metric, mut imperial) = (0, 0);
    for one in &all.uses {
        let Some(dimension) = dimension(one.column) else {
            continue;
        };
        for (row, text) in evidence.texts(one.index).take(50) {
            let unit = stated_unit(&text, dimension).or(one.row_unit(row.number));
            match unit.and_then(is_metric) {
                Some(true) => metric += 1,
                Some(false) => imperial += 1,
                None => {}
            }
        }
    }
    imperial > metric
}

/// Units from the mapping, the row of units and sentences beside the table.
fn stated_units(all: &mut Understood, evidence: &Evidence<'_>) {
    let said = sentences(evidence, false);
    let said_of_all = sentences(evidence, true);
    // The units of these, where all of them agree.
    let of = |said: &[String], dimension| {
        let mut units = said
            .iter()
            .filter_map(|text| sentence_unit(text, dimension));
        let first = units.next()?;
        units.all(|other| other == first).then_some(first)
    };
    for one in &mut all.uses {
        let Some(dimension) = dimension(one.column) else {
            continue;
        };
        if let Some(unit) = evidence
            .mapping
            .and_then(|mapping| mapping.unit(one.column))
        {
            if one.unit_source != Some(UnitSource::Mapping) {
                one.take_unit(unit, UnitSource::Mapping);
                one.wrong_unit = None;
            }
        } else if one.unit.is_none() && one.wrong_unit.is_none() {
            if let Some(unit) = evidence.header.unit(one.index) {
                one.take_unit(unit, UnitSource::UnitRow);
            } else if let Some(unit) = of(&said, dimension) {
                one.take_unit(unit, UnitSource::Sentence);
            }
        }
        // Of the sizes of objects, a sentence says more than a heading; those of pads and gaps may have their own.
        if SIZES.contains(&one.column) || one.column == Column::Mass {
            one.sentence_unit = of(&said_of_all, dimension);
        }
    }
}

/// Texts beside the table: above it, remarks in it, below it; `of_all`: only sentences, and without those that
/// make an exception.
fn sentences(evidence: &Evidence<'_>, of_all: bool) -> Vec<String> {
    const EXCEPT: &str = "unless except otherwise sofern ausser sauf salvo tranne excepto";
    let is_one = |left: &LeftOut| !of_all || matches!(left.kind, RowKind::Note | RowKind::Section);
    let is_whole = |text: &str| {
        !of_all
            || !canonical(text)
                .split(' ')
                .any(|word| is_among(word, EXCEPT))
    };
    let header = evidence.header;
    let above = evidence
        .rows
        .iter()
        .skip_while(|row| row.number < header.first_row);
    let above = above.take_while(|row| row.number < header.row);
    let cells = above.flat_map(|row| row.cells.iter().map(|(_, cell)| cell.shown()));
    let left = evidence
        .body
        .left_out
        .iter()
        .filter(|left| is_one(left))
        .map(|left| left.text.clone());
    cells
        .chain(left)
        .filter(|text| text.len() < 400 && is_whole(text))
        .take(300)
        .collect()
}

/// The decimal sign of each column from its own cells, or from those of the others.
fn dialects(all: &mut Understood, evidence: &Evidence<'_>) {
    let mut of_numbers: Vec<&mut Use> = all
        .uses
        .iter_mut()
        .filter(|one| holds_numbers(one.column))
        .collect();
    if let Some(sign) = evidence.mapping.and_then(|mapping| mapping.decimal) {
        for one in of_numbers {
            one.dialect = Dialect::One(sign);
        }
        return;
    }
    for one in &mut of_numbers {
        let mut signs = evidence
            .texts(one.index)
            .flat_map(|(_, text)| self::evidence(&text));
        one.dialect = match signs.next() {
            None => Dialect::Open,
            Some(first) if signs.all(|sign| sign == first) => Dialect::One(first),
            Some(_) => Dialect::Mixed,
        };
    }
    let known: Vec<Dialect> = of_numbers
        .iter()
        .map(|one| one.dialect)
        .filter(|dialect| *dialect != Dialect::Open)
        .collect();
    let is_one = known.iter().all(|dialect| Some(dialect) == known.first());
    let is_mixed = known.contains(&Dialect::Mixed);
    if let Some(first) = known.first().filter(|_| is_one && !is_mixed) {
        for one in of_numbers {
            one.dialect = *first;
        }
    }
    all.has_both_signs = is_mixed || !is_one;
}

fn holds_numbers(column: Column) -> bool {
    matches!(
        column.spec().holds,
        Holds::Quantity(_) | Holds::Count | Holds::Range | Holds::Sizes
    )
}

/// Lengths that the one unit of bare sizes is searched among.
const CANDIDATES: [&str; 5] = ["mm", "cm", "m", "in", "ft"];

/// Units that nothing states: those of the column's own cells, or for lengths the one that makes
/// the sizes plausible.
fn assumed_units(all: &mut Understood, evidence: &Evidence<'_>) {
    let mut open: Vec<usize> = Vec::new();
    // Whether the list is metric, where anything says so.
    let mut systems = all.systems();
    for (place, one) in all.uses.iter_mut().enumerate() {
        let dimension = dimension(one.column).filter(|dimension| *dimension != Dimension::Ratio);
        let Some(dimension) = dimension.filter(|_| one.unit.is_none() && one.wrong_unit.is_none())
        else {
            continue;
        };
        let mut stated: Vec<(CellUnit, usize)> = Vec::new();
        let mut bare = 0usize;
        for (_, text) in evidence.open_texts(one) {
            match stated_unit(&text, dimension) {
                Some(unit) => match stated.iter_mut().find(|(other, _)| *other == unit) {
                    Some((_, count)) => *count += 1,
                    None => stated.push((unit, 1)),
                },
                None => bare += usize::from(is_bare(&text) || one.column == Column::Dimensions),
            }
        }
        systems.extend(stated.iter().filter_map(|(unit, _)| is_metric(*unit)));
        if bare == 0 {
            continue;
        }
        let total: usize = stated.iter().map(|(_, count)| count).sum();
        stated.retain(|(unit, count)| {
            let (good, of) = plausible_count(evidence, one, *unit);
            2 * count >= total && 10 * good >= 9 * of
        });
        match stated.as_slice() {
            [(unit, _)] => one.take_unit(*unit, UnitSource::Cells),
            _ if dimension == Dimension::Length => open.push(place),
            _ => {}
        }
    }
    let is_metric_list = match systems.first() {
        Some(first) => systems.iter().all(|one| one == first).then_some(*first),
        None => {
            let header = evidence.header;
            let english = header.spoken(Language::English);
            (2 * english < header.meanings.len()).then_some(true)
        }
    };
    let sizes: Vec<&Use> = open
        .iter()
        .filter_map(|place| all.uses.get(*place))
        .filter(|one| SIZES.contains(&one.column) && one.column != Column::Diameter)
        .collect();
    let mut fitting = CANDIDATES
        .iter()
        .filter_map(|symbol| find(symbol, Dimension::Length).ok())
        .filter(|unit| is_metric_list.is_none_or(|metric| is_metric(*unit) == Some(metric)))
        .filter(|unit| {
            let (good, count) = plausible_counts(evidence, &sizes, *unit);
            count > 0 && 10 * good >= 9 * count
        });
    if let (Some(only), None) = (fitting.next(), fitting.next()) {
        for place in open {
            if let Some(one) = all.uses.get_mut(place) {
                one.take_unit(only, UnitSource::Plausibility);
            }
        }
    }
}

/// Bare sizes of several columns in this unit: how many are plausible, of how many.
fn plausible_counts(evidence: &Evidence<'_>, columns: &[&Use], unit: CellUnit) -> (usize, usize) {
    columns
        .iter()
        .map(|one| plausible_count(evidence, one, unit))
        .fold((0, 0), |(good, count), (more, of)| {
            (good + more, count + of)
        })
}

/// The decimal sign of columns of which only plausibility tells, or the language.
fn plausible_dialects(all: &mut Understood, evidence: &Evidence<'_>) {
    let spoken = |language| evidence.header.spoken(language);
    let has_comma_headings = spoken(Language::Comma) > spoken(Language::English);
    // Sizes first: the density of a mass needs them.
    let mut order: Vec<usize> = (0..all.uses.len()).collect();
    order.sort_by_key(|place| all.uses[*place].column == Column::Mass);
    for place in order {
        let one = &all.uses[place];
        if one.dialect != Dialect::Open || !holds_numbers(one.column) {
            continue;
        }
        let (mut point, mut comma) = (0usize, 0usize);
        let mut has_open = false;
        for (row, text) in evidence.texts(one.index) {
            if !is_open(&text) {
                continue;
            }
            has_open = true;
            let fits = |choice| is_plausible_reading(all, one, row, &text, choice);
            let is_decimal = fits(Choice::Decimal);
            if is_decimal == fits(Choice::Thousands) {
                continue;
            }
            // A point as a decimal sign, or a comma for thousands, speaks for the point.
            if text.contains(',') == is_decimal {
                comma += 1;
            } else {
                point += 1;
            }
        }
        if !has_open {
            continue;
        }
        all.uses[place].dialect = match (point, comma) {
            (0, 0) if evidence.has_semicolons || has_comma_headings => Dialect::One(Decimal::Comma),
            (0, 0) => Dialect::Open,
            (_, 0) => Dialect::One(Decimal::Point),
            (0, _) => Dialect::One(Decimal::Comma),
            _ => Dialect::Mixed,
        };
    }
}
