//! What each column of a list is: its name, its unit and its decimal sign, each with its evidence.

use std::collections::BTreeMap;

use freestand_input::quantity::Dimension;
use freestand_input::words::canonical;

use super::cell::{Cell, Row};
use super::cells::{Choice, evidence, is_bare, is_open, number_text, quantity, sizes, stated_unit};
use super::columns::{COLUMNS, Column, Holds, letters};
use super::headings::{HeadingUnit, Language, dimension};
use super::layout::{Body, Header, LeftOut, RowKind, SIZES};
use super::mapping::Mapping;
use super::numbers::{Decimal, is_plausible};
use super::round::is_among;
use super::sentence::{cell_unit, sentence_unit};
use super::units::{CellUnit, find, is_metric};
use super::vocabulary::{is_missing, rating};

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
    pub(super) index: u32,
    /// Its place among the columns that are read.
    pub(super) slot: usize,
    pub(super) column: Column,
    pub(super) heading: String,
    pub(super) unit: Option<CellUnit>,
    pub(super) unit_source: Option<UnitSource>,
    /// What the heading states, where that is not a unit of it.
    pub(super) wrong_unit: Option<String>,
    pub(super) dialect: Dialect,
    pub(super) order: Option<Vec<char>>,
    /// The unit that a sentence of the list states for it, where its heading states one.
    sentence_unit: Option<CellUnit>,
    /// Units from a row on.
    later_units: Vec<(u32, CellUnit)>,
    /// Rows with a unit of their own, in a column of units.
    row_units: Vec<(u32, CellUnit)>,
}

impl Use {
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

    fn row_unit(&self, row: u32) -> Option<CellUnit> {
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
    pub(super) uses: Vec<Use>,
    /// For each known column the places in `uses`, the one that is read first.
    firsts: Vec<Vec<usize>>,
    /// Columns that are carried through, with their headings.
    pub(super) carried: Vec<(u32, String)>,
    pub(super) is_imperial: bool,
    pub(super) is_japanese: bool,
    /// Whether both decimal signs occur in it.
    pub(super) has_both_signs: bool,
    pub(super) warnings: Vec<String>,
}

/// What the columns are decided from.
pub(super) struct Evidence<'a> {
    pub(super) rows: &'a [Row],
    pub(super) header: &'a Header,
    pub(super) body: &'a Body,
    pub(super) mapping: Option<&'a Mapping>,
    /// Whether `;` separates the cells, as where commas are decimal signs.
    pub(super) has_semicolons: bool,
}

impl Evidence<'_> {
    fn objects(&self) -> impl Iterator<Item = &Row> {
        self.body
            .objects
            .iter()
            .filter_map(|(place, _)| self.rows.get(*place))
    }

    fn cells(&self, index: u32) -> impl Iterator<Item = (&Row, &Cell)> {
        self.objects()
            .filter_map(move |row| Some((row, row.get(index)?)))
    }

    /// The texts of a column that may hold numbers.
    fn texts(&self, index: u32) -> impl Iterator<Item = (&Row, String)> {
        self.cells(index).filter_map(|(row, cell)| match cell {
            Cell::Text(_) => Some((row, number_text(cell).ok().flatten()?)),
            _ => None,
        })
    }
}

/// Decides what every column is.
pub(super) fn understand(evidence: &Evidence<'_>) -> Understood {
    let mut all = roles(evidence);
    stated_units(&mut all, evidence);
    dialects(&mut all, evidence);
    assumed_units(&mut all, evidence);
    plausible_dialects(&mut all, evidence);
    all.is_imperial = {
        let systems: Vec<bool> = all
            .uses
            .iter()
            .filter_map(|one| is_metric(one.unit?))
            .collect();
        let metric = systems.iter().filter(|&&metric| metric).count();
        !systems.is_empty() && 2 * metric < systems.len()
            || systems.is_empty() && cells_are_imperial(&all, evidence)
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
            match stated_unit(&text, dimension)
                .or(one.row_unit(row.number))
                .and_then(is_metric)
            {
                Some(true) => metric += 1,
                Some(false) => imperial += 1,
                None => {}
            }
        }
    }
    imperial > metric
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

    /// Every heading with what it was taken for, as a mapping file has it.
    pub(super) fn headings(
        &self,
        header: &Header,
    ) -> Vec<(String, Option<Column>, Option<CellUnit>)> {
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

/// Which column each heading is.
fn roles(evidence: &Evidence<'_>) -> Understood {
    let Evidence {
        header, mapping, ..
    } = evidence;
    let mut candidates: BTreeMap<u32, Candidate> = BTreeMap::new();
    let mut carried: Vec<(u32, String)> = Vec::new();
    for (index, heading) in &header.headings {
        let mapped = mapping.and_then(|mapping| mapping.column(heading));
        let found = header.meanings.get(index);
        let one = match (mapped, found) {
            (Some(mapped), _) => mapped.column.map(|column| {
                let own = found.filter(|found| found.column == column);
                let unit = mapped.unit.map(|unit| (unit, UnitSource::Mapping));
                Candidate {
                    column,
                    rank: 0,
                    unit: unit.map_or_else(
                        || own.map_or(HeadingUnit::None, |own| own.unit.clone()),
                        |(unit, _)| HeadingUnit::Stated(unit),
                    ),
                    is_mapped: mapped.unit.is_some(),
                    is_long_side: false,
                    order: own.and_then(|own| own.order.clone()),
                    language: None,
                }
            }),
            (None, Some(found)) => Some(Candidate {
                column: found.column,
                rank: found.rank,
                unit: found.unit.clone(),
                is_mapped: false,
                is_long_side: found.is_long_side,
                order: found.order.clone(),
                language: Some(found.language),
            }),
            (None, None) => None,
        };
        match one {
            Some(one) => {
                candidates.insert(*index, one);
            }
            None => carried.push((*index, heading.clone())),
        }
    }
    let mut warnings = Vec::new();
    by_content(&mut candidates, evidence, &mut carried);
    sides(&mut candidates, header, &mut carried, &mut warnings);
    let is_japanese = {
        let of = |language| {
            candidates
                .values()
                .filter(|one| one.language == Some(language))
                .count()
        };
        of(Language::EastAsian) > of(Language::English) + of(Language::Comma)
    };
    second_texts(&mut candidates, header, &mut carried);
    carried.sort_by_key(|(index, _)| *index);
    let mut uses = Vec::with_capacity(candidates.len());
    let mut firsts: Vec<Vec<(u16, usize)>> = vec![Vec::new(); COLUMNS.len()];
    for (slot, (index, one)) in candidates.into_iter().enumerate() {
        if let Some(places) = firsts.get_mut(one.column as usize) {
            places.push((one.rank, slot));
        }
        let (unit, wrong_unit) = match one.unit {
            HeadingUnit::Stated(unit) => (Some(unit), None),
            HeadingUnit::Wrong(text) => (None, Some(text)),
            HeadingUnit::None => (None, None),
        };
        let source = if one.is_mapped {
            UnitSource::Mapping
        } else {
            UnitSource::Heading
        };
        let later = evidence
            .body
            .units
            .iter()
            .filter(|(_, column, _)| *column == index);
        uses.push(Use {
            index,
            slot,
            column: one.column,
            heading: header.headings.get(&index).cloned().unwrap_or_default(),
            unit,
            unit_source: unit.map(|_| source),
            wrong_unit,
            dialect: Dialect::Open,
            order: one.order,
            sentence_unit: None,
            later_units: later.map(|(row, _, unit)| (*row, *unit)).collect(),
            row_units: Vec::new(),
        });
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
fn second_texts(
    candidates: &mut BTreeMap<u32, Candidate>,
    header: &Header,
    carried: &mut Vec<(u32, String)>,
) {
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
    carried.push((
        index,
        header.headings.get(&index).cloned().unwrap_or_default(),
    ));
}

struct Candidate {
    column: Column,
    rank: u16,
    unit: HeadingUnit,
    is_mapped: bool,
    is_long_side: bool,
    order: Option<Vec<char>>,
    language: Option<Language>,
}

/// Corrects what a heading alone cannot say: an "Item" of running numbers is an id, a column of
/// ratings without ratings is another one.
fn by_content(
    candidates: &mut BTreeMap<u32, Candidate>,
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
        let is_size = |text: &&String| {
            sizes(
                &super::numbers::plain(text),
                find("mm", Dimension::Length).ok(),
                None,
                Choice::Decimal,
            )
            .is_ok()
        };
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
        if COLUMNS
            .get(one.column as usize)
            .is_none_or(|spec| spec.holds != Holds::Rating)
        {
            continue;
        }
        let texts = sample(*index);
        let rated = texts.iter().filter(|text| rating(text).is_some()).count();
        if texts.len() >= 3 && 2 * rated < texts.len() {
            let heading = evidence
                .header
                .headings
                .get(index)
                .map(|text| canonical(text))
                .unwrap_or_default();
            let floors = texts
                .iter()
                .filter(|text| super::floors::storey(text).is_some())
                .count();
            if heading == "fl" && 2 * floors >= texts.len() {
                *one = Candidate {
                    column: Column::Floor,
                    rank: 60,
                    unit: HeadingUnit::None,
                    is_mapped: false,
                    is_long_side: false,
                    order: None,
                    language: one.language,
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
    candidates: &mut BTreeMap<u32, Candidate>,
    header: &Header,
    carried: &mut Vec<(u32, String)>,
    warnings: &mut Vec<String>,
) {
    let has = |candidates: &BTreeMap<u32, Candidate>, column: Column| {
        candidates.values().any(|one| one.column == column)
    };
    let widths = |candidates: &BTreeMap<u32, Candidate>, is_long: bool| -> Vec<u32> {
        let of = |one: &&Candidate| one.column == Column::Width && one.is_long_side == is_long;
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
            let heading = header.headings.get(&index).cloned().unwrap_or_default();
            warnings.push(format!(
                "column {} ({heading}) is not read: there are a width and a depth already",
                letters(index as usize)
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
                one.unit = Some(unit);
                one.unit_source = Some(UnitSource::Mapping);
                one.wrong_unit = None;
            }
        } else if one.unit.is_none() && one.wrong_unit.is_none() {
            let from_row = evidence
                .header
                .unit(one.index)
                .map(|unit| (unit, UnitSource::UnitRow));
            let from_sentence = || of(&said, dimension).map(|unit| (unit, UnitSource::Sentence));
            if let Some((unit, source)) = from_row.or_else(from_sentence) {
                one.unit = Some(unit);
                one.unit_source = Some(source);
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
    if let Some(sign) = evidence.mapping.and_then(|mapping| mapping.decimal) {
        for one in all.uses.iter_mut().filter(|one| holds_numbers(one.column)) {
            one.dialect = Dialect::One(sign);
        }
        return;
    }
    for one in all.uses.iter_mut().filter(|one| holds_numbers(one.column)) {
        let (mut point, mut comma) = (false, false);
        for (_, text) in evidence.texts(one.index) {
            for sign in self::evidence(&text) {
                match sign {
                    Decimal::Point => point = true,
                    Decimal::Comma => comma = true,
                }
            }
        }
        one.dialect = match (point, comma) {
            (true, true) => Dialect::Mixed,
            (true, false) => Dialect::One(Decimal::Point),
            (false, true) => Dialect::One(Decimal::Comma),
            (false, false) => Dialect::Open,
        };
    }
    let has = |dialect| all.uses.iter().any(|one| one.dialect == dialect);
    all.has_both_signs = has(Dialect::Mixed)
        || has(Dialect::One(Decimal::Point)) && has(Dialect::One(Decimal::Comma));
    let mut known = all
        .uses
        .iter()
        .filter(|one| one.dialect != Dialect::Open)
        .map(|one| one.dialect);
    let Some(first @ Dialect::One(_)) = known.next() else {
        return;
    };
    if known.all(|other| other == first) {
        for one in all.uses.iter_mut().filter(|one| holds_numbers(one.column)) {
            one.dialect = first;
        }
    }
}

fn holds_numbers(column: Column) -> bool {
    let holds = COLUMNS.get(column as usize).map(|spec| spec.holds);
    matches!(
        holds,
        Some(Holds::Quantity(_) | Holds::Count | Holds::Range | Holds::Sizes)
    )
}

/// Lengths that the one unit of bare sizes is searched among.
const CANDIDATES: [&str; 5] = ["mm", "cm", "m", "in", "ft"];

/// Units that nothing states: those of the column's own cells, or for lengths the one that makes
/// the sizes plausible.
fn assumed_units(all: &mut Understood, evidence: &Evidence<'_>) {
    let mut open: Vec<usize> = Vec::new();
    // Whether the list is metric, where anything says so.
    let mut systems: Vec<bool> = all
        .uses
        .iter()
        .filter_map(|one| is_metric(one.unit?))
        .collect();
    for (place, one) in all.uses.iter_mut().enumerate() {
        let Some(dimension) =
            dimension(one.column).filter(|dimension| *dimension != Dimension::Ratio)
        else {
            continue;
        };
        if one.unit.is_some() || one.wrong_unit.is_some() {
            continue;
        }
        let mut stated: Vec<(CellUnit, usize)> = Vec::new();
        let mut bare = 0usize;
        for (row, cell) in evidence.cells(one.index) {
            if one.unit_at(row.number).is_some() {
                continue;
            }
            let Ok(Some(text)) = number_text(cell) else {
                continue;
            };
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
        let most = stated
            .iter()
            .filter(|(_, count)| 2 * count >= total)
            .map(|(unit, _)| *unit);
        let fitting: Vec<CellUnit> = most.filter(|unit| fits(evidence, one, *unit)).collect();
        match fitting.as_slice() {
            [unit] => {
                one.unit = Some(*unit);
                one.unit_source = Some(UnitSource::Cells);
            }
            _ if dimension == Dimension::Length => open.push(place),
            _ => {}
        }
    }
    let metric = systems.iter().filter(|&&metric| metric).count();
    let is_metric_list = if systems.is_empty() {
        let has_comma = evidence
            .header
            .meanings
            .values()
            .filter(|found| found.language != Language::English)
            .count();
        (2 * has_comma > evidence.header.meanings.len()).then_some(true)
    } else if metric == systems.len() {
        Some(true)
    } else if metric == 0 {
        Some(false)
    } else {
        None
    };
    let fitting: Vec<CellUnit> = CANDIDATES
        .iter()
        .filter_map(|symbol| find(symbol, Dimension::Length).ok())
        .filter(|unit| is_metric_list.is_none_or(|metric| is_metric(*unit) == Some(metric)))
        .filter(|unit| all_fit(evidence, &open, all, *unit))
        .collect();
    if let [only] = fitting.as_slice() {
        for place in open {
            if let Some(one) = all.uses.get_mut(place) {
                one.unit = Some(*only);
                one.unit_source = Some(UnitSource::Plausibility);
            }
        }
    }
}

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
fn plausible_count(evidence: &Evidence<'_>, one: &Use, unit: CellUnit) -> (usize, usize) {
    let (mut good, mut count) = (0, 0);
    let Some(dimension) = dimension(one.column) else {
        return (0, 0);
    };
    for (row, cell) in evidence.cells(one.index) {
        if one.unit_at(row.number).is_some() {
            continue;
        }
        let Ok(Some(text)) = number_text(cell) else {
            continue;
        };
        // What has two readings says nothing about the unit.
        let Some(choice) = choice_of(cell, &text, one.dialect) else {
            continue;
        };
        if one.column == Column::Dimensions {
            let Ok(found) = sizes(&text, Some(unit), one.order.as_deref(), choice) else {
                continue;
            };
            if !found.is_bare {
                continue;
            }
            let height = found.height.map(|size| is_plausible(Column::Height, size));
            let others = [found.width, found.thickness]
                .map(|size| size.map(|size| is_plausible(Column::Width, size)));
            for is_good in [height, others[0], others[1]].into_iter().flatten() {
                count += 1;
                good += usize::from(is_good);
            }
        } else if let Ok(found) = quantity(&text, dimension, Some(unit), choice)
            && found.is_bare
        {
            count += 1;
            good += usize::from(is_plausible(one.column, found.si));
        }
    }
    (good, count)
}

fn fits(evidence: &Evidence<'_>, one: &Use, unit: CellUnit) -> bool {
    let (good, count) = plausible_count(evidence, one, unit);
    10 * good >= 9 * count
}

fn all_fit(evidence: &Evidence<'_>, open: &[usize], all: &Understood, unit: CellUnit) -> bool {
    let sizes = [
        Column::Height,
        Column::Thickness,
        Column::Width,
        Column::Dimensions,
    ];
    let (mut good, mut count) = (0, 0);
    for one in open
        .iter()
        .filter_map(|place| all.uses.get(*place))
        .filter(|one| sizes.contains(&one.column))
    {
        let (more, of) = plausible_count(evidence, one, unit);
        good += more;
        count += of;
    }
    count > 0 && 10 * good >= 9 * count
}

/// The decimal sign of columns of which only plausibility tells, or the language.
fn plausible_dialects(all: &mut Understood, evidence: &Evidence<'_>) {
    let has_comma_headings = {
        let of = |language| {
            evidence
                .header
                .meanings
                .values()
                .filter(|found| found.language == language)
                .count()
        };
        of(Language::Comma) > of(Language::English)
    };
    // Sizes first: the density of a mass needs them.
    let mut order: Vec<usize> = (0..all.uses.len()).collect();
    order.sort_by_key(|place| {
        all.uses
            .get(*place)
            .is_some_and(|one| one.column == Column::Mass)
    });
    for place in order {
        let Some(one) = all.uses.get(place) else {
            continue;
        };
        if one.dialect != Dialect::Open || !holds_numbers(one.column) {
            continue;
        }
        let (mut decimal, mut thousands) = ([0usize; 2], [0usize; 2]);
        let mut has_open = false;
        for (row, text) in evidence.texts(one.index) {
            if !is_open(&text) {
                continue;
            }
            has_open = true;
            let sign = usize::from(text.contains(','));
            let fits = |choice| is_plausible_reading(all, one, row, &text, choice);
            match (fits(Choice::Decimal), fits(Choice::Thousands)) {
                (true, false) => decimal[sign] += 1,
                (false, true) => thousands[sign] += 1,
                _ => {}
            }
        }
        if !has_open {
            continue;
        }
        // A point as a decimal sign, or a comma for thousands, speaks for the point.
        let point = decimal[0] + thousands[1];
        let comma = decimal[1] + thousands[0];
        let found = match (point, comma) {
            (0, 0) if evidence.has_semicolons || has_comma_headings => Dialect::One(Decimal::Comma),
            (0, 0) => Dialect::Open,
            (_, 0) => Dialect::One(Decimal::Point),
            (0, _) => Dialect::One(Decimal::Comma),
            _ => Dialect::Mixed,
        };
        if let Some(one) = all.uses.get_mut(place) {
            one.dialect = found;
        }
    }
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
        return sizes(text, unit, one.order.as_deref(), choice).is_ok_and(|found| {
            found
                .height
                .is_none_or(|size| is_plausible(Column::Height, size))
                && [found.width, found.thickness]
                    .iter()
                    .flatten()
                    .all(|size| is_plausible(Column::Width, *size))
        });
    }
    let dimension = dimension(one.column).unwrap_or(Dimension::Ratio);
    let Ok(found) = quantity(text, dimension, unit, choice) else {
        return false;
    };
    if one.column == Column::Mass
        && let Some(volume) = volume(all, row)
    {
        return super::plausible::is_density_plausible(found.si, volume);
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
        match (
            read(Choice::Decimal).filter(is_size),
            read(Choice::Thousands).filter(is_size),
        ) {
            (Some(size), None) | (None, Some(size)) => Some(size),
            _ => None,
        }
    };
    if let Some(one) = all.get(Column::Dimensions)
        && let Some(cell) = row.get(one.index)
        && let Ok(Some(text)) = number_text(cell)
    {
        let choice = choice_of(cell, &text, one.dialect)?;
        let found = sizes(&text, one.unit_at(row.number), one.order.as_deref(), choice).ok()?;
        return Some(
            found.height.or_else(|| size(Column::Height))? * found.thickness? * found.width?,
        );
    }
    let (height, thickness) = (size(Column::Height)?, size(Column::Thickness)?);
    Some(height * thickness * size(Column::Width).unwrap_or(thickness))
}
