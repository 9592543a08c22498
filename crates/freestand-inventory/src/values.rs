//! The values of one row: read from its cells, where each that cannot be read is added to the problems, or
//! given as they are.

use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, is_possible, shorten};
use freestand_input::words::{Choices, canonical};

use std::sync::Arc;

use freestand_study::hull::BodyInPose;
use freestand_study::hull::body::Form;
use freestand_study::study::assessment::Questions;

use super::cell::{Cell, Row, row_at};
use super::cells::{
    Choice, Measured, TOO_LARGE, Wrong, is_open, number_text, quantity, with_pulse,
};
use super::columns::Column;
use super::given::Given;
use super::headings::dimension;
use super::numbers::Decimal;
use super::problems::{Kind, Place, RowFindings};
use super::readings::{choice_of, is_plausible_reading};
use super::round::{names_diameter, shape};
use super::sentence::cell_unit;
use super::sizes::Sizes;
use super::used::{Dialect, Understood, Use};
use super::vocabulary::{
    Answer, is_among, is_ditto, is_missing, is_no_value, rating, without_state, yes_or_no,
};
use super::wheels::{Wheels, casters};
use super::workbook::Merges;
use super::{Casters, Rating};

/// The values of a row.
pub(super) enum Values<'a> {
    /// In the cells of a list.
    Cells(Cells<'a>),
    /// As they are.
    Given(Given<'a>),
}

impl<'a> Values<'a> {
    /// Its row, counted from 1.
    pub(super) fn row(&self) -> u32 {
        match self {
            Self::Cells(cells) => cells.row.number,
            Self::Given(_) => 1,
        }
    }

    pub(super) fn told(&mut self) -> &mut RowFindings<'a> {
        match self {
            Self::Cells(cells) => &mut cells.told,
            Self::Given(given) => &mut given.told,
        }
    }

    /// Whether the list has a column.
    pub(super) fn has(&self, column: Column) -> bool {
        match self {
            Self::Cells(cells) => cells.columns.get(column).is_some(),
            Self::Given(given) => given.get(column).is_some(),
        }
    }

    /// A value as a person would see it.
    pub(super) fn shown(&self, column: Column) -> Option<String> {
        match self {
            Self::Cells(cells) => {
                let one = cells.columns.get(column)?;
                cells.row.get(one.index).map(Cell::shown)
            }
            Self::Given(given) => Some(given.get(column)?.shown(column)),
        }
    }

    /// Whether a column has a text in this row that is not a word for a missing value.
    pub(super) fn is_filled(&self, column: Column) -> bool {
        self.shown(column).is_some_and(|text| !is_missing(&text))
    }

    /// The place of a column; that of the row where the list does not have it.
    fn place(&self, column: Column) -> Place<'a> {
        let one = match self {
            Self::Cells(cells) => cells.columns.get(column),
            Self::Given(_) => None,
        };
        let unknown = Place {
            column: Some(column),
            ..Place::ROW
        };
        one.map_or(unknown, Use::place)
    }

    /// Adds a problem of a column; with a detail, that is said in place of the words of its kind.
    pub(super) fn report(&mut self, column: Column, kind: Kind, detail: &str) {
        let example = self.shown(column).unwrap_or_default();
        let (place, row) = (self.place(column), self.row());
        self.told().add(place, kind, row, &example, detail);
    }

    /// Adds a problem of the whole list that this row shows.
    pub(super) fn report_once(&mut self, column: Column, kind: Kind) {
        let example = self.shown(column).unwrap_or_default();
        let place = self.place(column);
        self.told().findings.add(kind, place, None, &example, "");
    }

    /// Adds a wrong value with a message of another reader.
    pub(super) fn wrong(&mut self, column: Column, kind: Kind, problem: &Problem) {
        self.report(column, kind, &problem.message);
        if let Some(hint) = problem.hint.as_ref().filter(|_| self.has(column)) {
            let place = self.place(column);
            self.told().findings.hint(kind, place, hint);
        }
    }

    /// Adds a warning about the row.
    pub(super) fn note(&mut self, words: &'static str) {
        let row = self.row();
        self.told().findings.note(words, row);
    }

    /// Its cells, if there are any.
    fn cells(&mut self) -> Option<&mut Cells<'a>> {
        match self {
            Self::Cells(cells) => Some(cells),
            Self::Given(_) => None,
        }
    }

    /// Text without the blanks around it; empty where there is none.
    pub(super) fn text(&mut self, column: Column) -> String {
        match self {
            Self::Cells(cells) => cells.text(column),
            Self::Given(given) => given.text(column),
        }
    }

    /// A quantity in SI.
    pub(super) fn number(&mut self, column: Column) -> Option<f64> {
        match self {
            Self::Cells(cells) => cells.quantity(column).map(|found| found.si),
            Self::Given(given) => {
                let value = given.number(column);
                self.accepted(column, value, |value| is_possible(*value), TOO_LARGE)
            }
        }
    }

    /// A value that a test accepts; `expected` says what it must be.
    pub(super) fn accepted<T>(
        &mut self,
        column: Column,
        value: Option<T>,
        accept: impl FnOnce(&T) -> bool,
        expected: &str,
    ) -> Option<T> {
        let value = value?;
        if accept(&value) {
            return Some(value);
        }
        self.report(column, Kind::OutOfRange, expected);
        None
    }

    /// A positive quantity in SI.
    pub(super) fn positive(&mut self, column: Column) -> Option<f64> {
        let value = self.number(column);
        self.accepted(column, value, |value| *value > 0.0, "must be above 0")
    }

    /// A quantity in SI that may be 0.
    pub(super) fn not_negative(&mut self, column: Column) -> Option<f64> {
        let value = self.number(column);
        self.accepted(column, value, |value| *value >= 0.0, "must not be below 0")
    }

    /// A ratio above 0 and below 1.
    pub(super) fn share(&mut self, column: Column) -> Option<f64> {
        let value = self.positive(column);
        let expected = "must be above 0 and below 1";
        self.accepted(column, value, |value| *value < 1.0, expected)
    }

    /// A positive quantity of a cell as text with its unit.
    pub(super) fn positive_text(&mut self, column: Column) -> Option<String> {
        let found = self.cells()?.quantity(column);
        let found = self.accepted(column, found, |found| found.si > 0.0, "must be above 0");
        found.map(|found| found.text)
    }

    /// The stiffness under one edge, where it is given as it is \[N/m\].
    pub(super) fn given_stiffness(&mut self) -> Option<f64> {
        match self {
            Self::Given(_) => self.number(Column::Stiffness),
            Self::Cells(_) => None,
        }
    }

    /// A whole number, at least 1.
    pub(super) fn whole(&mut self, column: Column) -> Option<u32> {
        self.cells()?.whole(column)
    }

    /// The sizes in one cell.
    pub(super) fn sizes(&mut self) -> Option<Sizes> {
        self.cells()?.sizes()
    }

    /// Whether a cell of a side calls it a diameter.
    pub(super) fn is_diameter(&mut self, column: Column) -> bool {
        self.cells().is_some_and(|cells| cells.is_diameter(column))
    }

    /// The duration in a tolerance such as `15g 11ms` \[s\].
    pub(super) fn pulse(&mut self) -> Option<f64> {
        self.cells()?.pulse()
    }

    /// Says which cells of the columns of units are none.
    pub(super) fn units(&mut self) {
        if let Some(cells) = self.cells() {
            cells.units();
        }
    }

    /// Two positive ratios in rising order.
    pub(super) fn range(&mut self, column: Column) -> Option<(f64, f64)> {
        match self {
            Self::Cells(cells) => cells.range(column),
            Self::Given(given) => {
                let ends = given.range(column);
                let ends = self.accepted(column, ends, |ends| is_rising(*ends), NOT_RISING);
                self.accepted(column, ends, |ends| is_possible(ends.1), TOO_LARGE)
            }
        }
    }

    /// What a text means; one that means nothing known is a problem of this kind.
    fn meant<T>(
        &mut self,
        column: Column,
        meaning: impl FnOnce(&str) -> Option<T>,
        kind: Kind,
        detail: &str,
    ) -> Option<T> {
        let text = self.text(column);
        if text.is_empty() {
            return None;
        }
        let found = meaning(&text);
        if found.is_none() {
            self.report(column, kind, detail);
        }
        found
    }

    /// The body that it is, without a list.
    pub(super) fn body(&self) -> Option<Arc<BodyInPose>> {
        match self {
            Self::Given(given) => given.body().map(Arc::clone),
            Self::Cells(_) => None,
        }
    }

    /// The shape of its base; `None`: nothing says it.
    pub(super) fn shape(&mut self) -> Option<Form> {
        if let Self::Given(given) = self {
            return given.is_round().then_some(Form::Cylinder);
        }
        let detail = "is not a shape: write box, cylinder where the base is round, or polygon:8 with the number of its \
                      corners";
        self.meant(Column::Shape, shape, Kind::Unreadable, detail)
    }

    /// One of a few names.
    pub(super) fn named<T: Copy>(&mut self, column: Column, choices: Choices<T>) -> Option<T> {
        let names: Vec<&str> = choices.iter().map(|(_, name, _)| *name).collect();
        let detail = format!("is not one of {}", names.join(", "));
        let found = |text: &str| {
            let words = canonical(text);
            let same = choices.iter().find(|(_, name, _)| canonical(name) == words);
            same.map(|(value, _, _)| *value)
        };
        self.meant(column, found, Kind::Unreadable, &detail)
    }

    /// High, medium or low.
    pub(super) fn rating(&mut self, column: Column) -> Option<Rating> {
        let rated = |text: &str| match rating(text)? {
            2 => Some(Rating::High),
            1 => Some(Rating::Medium),
            _ => Some(Rating::Low),
        };
        let detail = "is not a rating: write H, M or L";
        self.meant(column, rated, Kind::Unreadable, detail)
    }

    /// Yes or no; what is not clearly one of them is a doubt.
    pub(super) fn answer(&mut self, column: Column) -> Option<bool> {
        let answer = |text: &str| match yes_or_no(text) {
            Answer::Yes => Some(true),
            Answer::No => Some(false),
            Answer::Unclear => None,
        };
        self.meant(column, answer, Kind::AnchoredUnclear, "")
    }

    /// What a cell says about its casters, and what else it says that the object stands on.
    pub(super) fn casters(&mut self, column: Column) -> (Option<Casters>, String) {
        if let Self::Given(given) = self {
            return (given.casters(column), String::new());
        }
        let text = self.text(column);
        if text.is_empty() {
            return (None, text);
        }
        match casters(&text) {
            Wheels::Said(found) => (Some(found), String::new()),
            Wheels::Some | Wheels::PerhapsBraked => {
                self.report(column, Kind::Casters, "");
                (Some(Casters::Free), String::new())
            }
            Wheels::Other => (Some(Casters::None), text),
            Wheels::Unclear => {
                let detail = "does not say whether it rolls: write no, free or braked";
                self.report(column, Kind::NotUnderstood, detail);
                (None, text)
            }
        }
    }

    /// What is asked of the object.
    pub(super) fn questions(&mut self, column: Column) -> Option<Questions> {
        let asked = |text: &str| {
            let mut plain = text.to_lowercase();
            plain.retain(|c| !c.is_whitespace());
            let found = Questions::ALL.iter().find(|(name, _)| *name == plain);
            found.map(|(_, questions)| *questions)
        };
        let detail = "is not a question: write falls or falls+shock";
        self.meant(column, asked, Kind::Unreadable, detail)
    }
}

const NOT_RISING: &str = "is not a positive value or a rising range, such as 0.3-0.5";

fn is_rising((low, high): (f64, f64)) -> bool {
    low > 0.0 && low <= high
}

/// A row with everything that is needed to read its cells.
pub(super) struct Cells<'a> {
    pub row: &'a Row,
    /// All rows of the sheet, for cells that are merged with one above.
    pub rows: &'a [Row],
    pub columns: &'a Understood,
    pub merges: &'a Merges,
    pub told: RowFindings<'a>,
    /// Its cells have shifted: no number is taken.
    pub is_shifted: bool,
    /// For each column in use: cells with a value, and cells without any.
    pub counts: &'a mut [(usize, usize)],
}

impl<'a> Cells<'a> {
    /// Adds a problem of a cell.
    fn problem(&mut self, one: &Use, kind: Kind, example: &str, detail: &str) {
        let row = self.row.number;
        self.told.add(one.place(), kind, row, example, detail);
    }

    /// A cell that is not blank; a cell that is merged with one above has its value.
    fn cell(&mut self, one: &Use) -> Option<&'a Cell> {
        let row = self.row;
        if let Some(cell) = row.get(one.index).filter(|cell| !cell.is_blank()) {
            return Some(cell);
        }
        let (top, left) = self.merges.top_left(row.number, one.index)?;
        if left != one.index {
            return None;
        }
        let merged = row_at(self.rows, top)?;
        let cell = merged.get(left).filter(|cell| !cell.is_blank())?;
        // A mass over three rows may be that of all three.
        if matches!(
            one.column,
            Column::Mass | Column::Quantity | Column::Id | Column::Unit
        ) {
            if one.column != Column::Id {
                self.problem(one, Kind::Merged, &cell.shown(), "");
            }
            return None;
        }
        Some(cell)
    }

    fn count(&mut self, one: &Use, has_value: bool) {
        if let Some((values, missing)) = self.counts.get_mut(one.slot) {
            *(if has_value { values } else { missing }) += 1;
        }
    }

    /// Text without the blanks around it; empty where there is none.
    fn text(&mut self, column: Column) -> String {
        let columns = self.columns;
        let Some(one) = columns.get(column) else {
            return String::new();
        };
        let text = match self.cell(one) {
            None => String::new(),
            Some(Cell::Error(text)) if text == "#N/A" => String::new(),
            Some(cell @ (Cell::Error(_) | Cell::Unevaluated)) => {
                self.problem(one, Kind::Formula, &cell.shown(), "");
                return String::new();
            }
            Some(Cell::TooLong(chars)) => {
                let detail =
                    format!("has {chars} characters, more than a cell of a spreadsheet can hold");
                self.problem(one, Kind::Unreadable, "", &detail);
                return String::new();
            }
            Some(cell) => cell.shown().trim().to_owned(),
        };
        let is_kept = column == Column::Notes || !is_missing(&text);
        let text = if is_kept { text } else { String::new() };
        self.count(one, !text.is_empty());
        text
    }

    /// A quantity; the other columns of the same name are used where the first has none.
    fn quantity(&mut self, column: Column) -> Option<Measured> {
        let columns = self.columns;
        let mut found: Option<Measured> = None;
        for one in columns.all(column) {
            let Some(other) = self.one_quantity(one) else {
                continue;
            };
            let first = found.get_or_insert_with(|| other.clone());
            // Rounding of inches to millimetres is no difference.
            if (first.si - other.si).abs() > 0.02 * first.si.abs()
                && let Some(first) = columns.get(column)
            {
                let example = self.row.shown(first.index);
                self.problem(first, Kind::TwoColumns, &example, "");
            }
        }
        found
    }

    /// A cell that is to hold numbers, with its text. One that is missing is counted, one that holds
    /// something else is reported.
    fn numeric(&mut self, one: &Use) -> Option<(&'a Cell, String)> {
        let Some(cell) = self.cell(one) else {
            self.count(one, false);
            return None;
        };
        match number_text(cell) {
            Ok(Some(text)) => (!self.is_shifted).then_some((cell, text)),
            // An empty cell says that nothing is there; a text may say the opposite.
            Ok(None) if one.column.means_nothing_there() && !is_no_value(&cell.shown()) => {
                let detail = "is neither a number nor a word for a missing value: write a number with its unit, 0 \
                              where they touch, or leave the cell empty where nothing is there";
                self.refused(one, cell, Wrong::because(Kind::Unreadable, detail))
            }
            Ok(None) => {
                self.count(one, false);
                let text = cell.shown();
                // "Housner" in a column of restitutions says what an empty cell does.
                let is_usual = one.column == Column::Restitution && canonical(&text) == "housner";
                let detail = if is_ditto(&text) {
                    Some("points to another cell: write the value itself")
                } else if !is_no_value(&text) && !is_usual {
                    Some("is not a number, nor a usual word for a value that is not known")
                } else {
                    None
                };
                if let Some(detail) = detail {
                    self.problem(one, Kind::NotUnderstood, &text, detail);
                }
                None
            }
            Err(wrong) => self.refused(one, cell, wrong),
        }
    }

    /// Counts a value, or reports why there is none.
    fn taken<T>(&mut self, one: &Use, cell: &Cell, found: Result<T, Wrong>) -> Option<T> {
        match found {
            Ok(value) => {
                self.count(one, true);
                Some(value)
            }
            Err(wrong) => self.refused(one, cell, wrong),
        }
    }

    fn one_quantity(&mut self, one: &Use) -> Option<Measured> {
        let dimension = dimension(one.column).unwrap_or(Dimension::Ratio);
        let (cell, text) = self.numeric(one)?;
        let unit = one.unit_at(self.row.number);
        let (text, is_too_small) = match one.column {
            Column::Tolerance => (with_pulse(&text).map_or(&text[..], |(peak, _)| peak), false),
            Column::Mass => without_state(&text),
            _ => (&text[..], false),
        };
        let found = self.chosen(one, cell, text, |choice| {
            quantity(text, dimension, unit, choice)
        });
        let possible = |found: Measured| {
            if !is_possible(found.si) {
                return Err(Wrong::too_large());
            }
            self.agreed(one, found.is_bare).map(|()| found)
        };
        let found = self.taken(one, cell, found.and_then(possible))?;
        self.doubts_of(
            one,
            cell,
            found.is_approximate || is_too_small,
            found.is_bare,
        );
        Some(found)
    }

    /// Refuses a bare number of which two units are stated.
    fn agreed(&self, one: &Use, is_bare: bool) -> Result<(), Wrong> {
        match one.contradiction_at(self.row.number).filter(|_| is_bare) {
            Some(units) => Err(Wrong::because(Kind::UnitContradicted, &units)),
            None => Ok(()),
        }
    }

    /// Says which cells of the columns of units are none.
    fn units(&mut self) {
        let columns = self.columns;
        for one in columns.all(Column::Unit) {
            let text = self
                .cell(one)
                .map(Cell::shown)
                .filter(|text| !is_missing(text));
            self.count(one, text.is_some());
            let Some(text) = text else { continue };
            let is_unit = |dimension| cell_unit(&text, dimension).is_some();
            if !is_unit(Dimension::Length) && !is_unit(Dimension::Mass) {
                let detail = "is not a unit of length or mass";
                self.problem(one, Kind::NotUnderstood, &text, detail);
            }
        }
    }

    fn doubts_of(&mut self, one: &Use, cell: &Cell, is_approximate: bool, is_bare: bool) {
        if is_approximate {
            self.problem(one, Kind::Approximate, &cell.shown(), "");
        }
        if is_bare && one.is_unit_assumed(self.row.number) {
            let unit = one.unit.map_or("", |unit| unit.symbol());
            let detail = format!("states no unit; {unit} was taken, which fits the list");
            self.problem(one, Kind::UnitAssumed, &cell.shown(), &detail);
        }
    }

    fn refused<T>(&mut self, one: &Use, cell: &Cell, wrong: Wrong) -> Option<T> {
        let Wrong { kind, detail } = match &one.wrong_unit {
            Some(text) if wrong.kind == Kind::UnitMissing => {
                let (unit, name) = (shorten(text), one.column.name());
                let detail = format!("its heading has \"{unit}\", which is not a unit of {name}");
                Wrong::because(Kind::UnitWrong, &detail)
            }
            _ => wrong,
        };
        self.problem(one, kind, &cell.shown(), &detail);
        None
    }

    /// The reading that the column's decimal sign and plausibility agree on.
    fn chosen<T>(
        &self,
        one: &Use,
        cell: &Cell,
        text: &str,
        read: impl Fn(Choice) -> Result<T, Wrong>,
    ) -> Result<T, Wrong> {
        let is_open = matches!(cell, Cell::Text(_)) && is_open(text);
        if !is_open {
            return read(choice_of(cell, text, one.dialect).unwrap_or(Choice::Decimal));
        }
        let fits = |choice| is_plausible_reading(self.columns, one, self.row, text, choice);
        let ambiguous = || Err(Kind::NumberAmbiguous.into());
        match one.dialect {
            Dialect::One(sign) => {
                let (own, other) = (Choice::Sign(sign), Choice::Sign(sign.other()));
                match (fits(own), fits(other)) {
                    // In a list of both signs plausibility decides; in any other it contradicts.
                    (false, true) if self.columns.has_both_signs => read(other),
                    (false, true) => ambiguous(),
                    _ => read(own),
                }
            }
            Dialect::Mixed | Dialect::Open => {
                match (fits(Choice::Decimal), fits(Choice::Thousands)) {
                    (true, false) => read(Choice::Decimal),
                    (false, true) => read(Choice::Thousands),
                    _ => match (read(Choice::Decimal), read(Choice::Thousands)) {
                        // Without a unit, that is what is wrong first.
                        (Err(wrong), Err(_)) if wrong.kind != Kind::Unreadable => Err(wrong),
                        _ => ambiguous(),
                    },
                }
            }
        }
    }

    /// The duration in a tolerance such as `15g 11ms` \[s\].
    fn pulse(&mut self) -> Option<f64> {
        let columns = self.columns;
        let one = columns.get(Column::Tolerance)?;
        let text = number_text(self.cell(one)?).ok().flatten()?;
        let (_, duration) = with_pulse(&text)?;
        let sign = match one.dialect {
            Dialect::One(sign) => sign,
            _ => Decimal::Point,
        };
        quantity(duration, Dimension::Time, None, Choice::Sign(sign))
            .ok()
            .map(|found| found.si)
            .filter(|s| *s > 0.0)
    }

    /// The sizes in one cell.
    fn sizes(&mut self) -> Option<Sizes> {
        let columns = self.columns;
        let one = columns.get(Column::Dimensions)?;
        let (cell, text) = self.numeric(one)?;
        let unit = one.unit_at(self.row.number);
        let found = self.chosen(one, cell, &text, |choice| one.sizes(&text, unit, choice));
        let positive = |found: Sizes| {
            let all = [found.height, found.width, found.thickness];
            let is_wrong = all.iter().flatten().any(|size| *size <= 0.0);
            if is_wrong {
                return Err(Wrong::because(Kind::OutOfRange, "must be above 0"));
            }
            self.agreed(one, found.is_bare).map(|()| found)
        };
        let found = self.taken(one, cell, found.and_then(positive))?;
        if found.is_order_guessed {
            self.problem(one, Kind::DimensionOrder, &cell.shown(), "");
        }
        self.doubts_of(one, cell, found.is_approximate, found.is_bare);
        Some(found)
    }

    /// Whether a cell of a side calls it a diameter.
    fn is_diameter(&self, column: Column) -> bool {
        let one = self.columns.get(column);
        let cell = one.and_then(|one| self.row.get(one.index));
        matches!(cell, Some(Cell::Text(text)) if names_diameter(text))
    }

    /// A whole number, at least 1.
    fn whole(&mut self, column: Column) -> Option<u32> {
        // "2 pcs" and "3x" are counts.
        const COUNTS: &str = "pcs pc off x ea each units nos no stk stuck st 台 個";
        // "2 pairs" are four.
        const PAIRS: &str = "pair pairs pr prs paar paare paire paires pares paia 対";
        const DOZENS: &str = "dozen dz dutzend douzaine docena dozzina";
        let columns = self.columns;
        let one = columns.get(column)?;
        let (cell, text) = self.numeric(one)?;
        let bare = text.trim_end_matches(|c: char| !c.is_ascii_digit()).trim();
        let rest = canonical(text.get(bare.len()..).unwrap_or_default());
        let (times, text) = if is_among(&rest, PAIRS) {
            (2.0, bare)
        } else if is_among(&rest, DOZENS) {
            (12.0, bare)
        } else if is_among(&rest, COUNTS) {
            (1.0, bare)
        } else {
            (1.0, &text[..])
        };
        let text = text.strip_prefix(['x', 'X', '×']).map_or(text, str::trim);
        let found = self.chosen(one, cell, text, |choice| {
            quantity(text, Dimension::Ratio, None, choice)
        });
        let whole = |found: Measured| {
            let si = times * found.si;
            if (1.0..=1e6).contains(&si) && si.fract() == 0.0 {
                Ok(Measured { si, ..found })
            } else {
                let detail = "must be a whole number, at least 1";
                Err(Wrong::because(Kind::OutOfRange, detail))
            }
        };
        let found = self.taken(one, cell, found.and_then(whole))?;
        if times > 1.0 {
            let detail = format!("was read as {}", found.si);
            self.problem(one, Kind::Approximate, &cell.shown(), &detail);
        }
        self.doubts_of(one, cell, found.is_approximate, false);
        Some(found.si as u32)
    }

    /// Two positive ratios in rising order, `0.3-0.5` or `0.3 to 0.5`, or one for both.
    fn range(&mut self, column: Column) -> Option<(f64, f64)> {
        let columns = self.columns;
        let one = columns.get(column)?;
        let (cell, text) = self.numeric(one)?;
        let unit = one.unit_at(self.row.number);
        let ratio = |text: &str| {
            let read = |choice| quantity(text, Dimension::Ratio, unit, choice);
            self.chosen(one, cell, text, read).map(|found| found.si)
        };
        let both = match split_range(&text) {
            Some((low, high)) => ratio(low).and_then(|low| Ok((low, ratio(high)?))),
            None => ratio(&text).map(|value| (value, value)),
        };
        let rising = |ends| match is_rising(ends) {
            true => Ok(ends),
            false => Err(Wrong::because(Kind::OutOfRange, NOT_RISING)),
        };
        self.taken(one, cell, both.and_then(rising))
    }
}

/// The two ends of `0.3-0.5`, `0.3 – 0.5`, `0.3 to 0.5` or `0.3..0.5`; a minus at the start or
/// after an `e` is a sign.
fn split_range(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    for mark in [" to ", "...", "..", "…", "–", "—"] {
        if let Some((low, high)) = text.split_once(mark) {
            return Some((low.trim(), high.trim()));
        }
    }
    let (at, _) = text.match_indices('-').find(|(at, _)| {
        let before = text.get(..*at).unwrap_or_default().trim_end();
        before.ends_with(|c: char| c.is_ascii_digit() || matches!(c, '%' | '.'))
    })?;
    Some((text.get(..at)?.trim(), text.get(at + 1..)?.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_split() {
        for (text, ends) in [
            ("0.3-0.5", Some(("0.3", "0.5"))),
            ("0.3 – 0.5", Some(("0.3", "0.5"))),
            (" 0.3 to 0.5", Some(("0.3", "0.5"))),
            ("0.3..0.5", Some(("0.3", "0.5"))),
            ("30 % - 50 %", Some(("30 %", "50 %"))),
            ("3e-1", None),
            ("-0.3", None),
            ("0.3", None),
        ] {
            assert_eq!(split_range(text), ends, "{text}");
        }
    }
}
