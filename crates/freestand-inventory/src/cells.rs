//! One cell as a quantity in SI, or why it is none.

use freestand_input::quantity::{Dimension, Quantity, is_possible, lookup};

use super::cell::Cell;
use super::numbers::{Decimal, FRACTIONS, Number, Piece, has_digit, joined, pieces, plain};
use super::problems::Kind;
use super::round::without_diameter;
use super::units::{CellUnit, NoUnit, find};
use super::vocabulary::{is_among, is_missing, without_approximation};

/// How a number with two readings is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Choice {
    /// Its sign is the decimal one.
    Decimal,
    /// Its sign separates thousands.
    Thousands,
    /// This sign is the decimal one.
    Sign(Decimal),
}

impl Choice {
    fn read(self, number: &Number) -> Result<String, Wrong> {
        match number {
            Number::Sure(text, _) => Ok(text.clone()),
            Number::Malformed => Err(Kind::Unreadable.into()),
            Number::Either {
                sign,
                as_decimal,
                as_thousands,
            } => {
                let is_decimal = self == Self::Decimal || self == Self::Sign(*sign);
                Ok(if is_decimal { as_decimal } else { as_thousands }.clone())
            }
        }
    }
}

/// What is said of a value that no quantity has, as of quantities elsewhere.
pub(super) const TOO_LARGE: &str = "is too large: no quantity is above 1e18 in SI units";

/// Why a cell has no value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Wrong {
    pub kind: Kind,
    /// What is wrong; empty: the kind alone says it.
    pub detail: String,
}

impl Wrong {
    pub(super) fn too_large() -> Self {
        Self::because(Kind::OutOfRange, TOO_LARGE)
    }

    pub(super) fn because(kind: Kind, detail: &str) -> Self {
        Self {
            kind,
            detail: detail.to_owned(),
        }
    }
}

impl From<Kind> for Wrong {
    fn from(kind: Kind) -> Self {
        Self::because(kind, "")
    }
}

/// The value of a cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measured {
    /// In SI.
    pub si: f64,
    /// Number and unit, ready for a reader of quantities.
    pub text: String,
    /// A rough value, or the middle of a range.
    pub is_approximate: bool,
    /// Whether the unit is that of the column.
    pub is_bare: bool,
}

impl Measured {
    fn sure(si: f64, text: String, is_bare: bool) -> Self {
        Self {
            si,
            text,
            is_approximate: false,
            is_bare,
        }
    }

    /// One number in this unit.
    fn in_unit(number: &str, unit: CellUnit, is_bare: bool) -> Result<Self, Wrong> {
        let si = unit.read(number).map_err(|_| Wrong::too_large())?;
        let text = match unit {
            CellUnit::Known(unit) => format!("{number} {}", unit.symbol),
            CellUnit::Force(_) | CellUnit::Gram(_) => format!("{si} kg"),
        };
        Ok(Self::sure(si, text, is_bare))
    }

    /// A value that was calculated.
    fn in_si(si: f64, dimension: Dimension, is_bare: bool) -> Self {
        let symbol = match dimension {
            Dimension::Length => "m",
            Dimension::Mass => "kg",
            Dimension::Time => "s",
            Dimension::Acceleration => "m/s2",
            Dimension::Stiffness => "N/m",
            Dimension::Velocity => "m/s",
            _ => "",
        };
        Self::sure(si, format!("{si} {symbol}"), is_bare)
    }
}

/// The text of a cell that may hold a number; `None`: its value is missing.
///
/// # Errors
/// A cell that is an error, a truth value or a date.
pub(super) fn number_text(cell: &Cell) -> Result<Option<String>, Wrong> {
    const ERRORS: &str = "#REF! #DIV/0! #VALUE! #NAME? #NUM! #NULL!";
    let (kind, detail) = match cell {
        Cell::Text(text) if !is_among(text.trim(), ERRORS) => {
            let text = plain(text);
            let has_digit = has_digit(&text) || text.contains(FRACTIONS);
            return Ok((has_digit && !is_missing(&text)).then_some(text));
        }
        Cell::Number(value) if value.is_finite() => return Ok(Some(format!("{value}"))),
        Cell::Error(text) if text == "#N/A" => return Ok(None),
        Cell::Text(_) | Cell::Error(_) => (Kind::Formula, "is the error of a formula"),
        Cell::Unevaluated => (Kind::Formula, ""),
        Cell::Date(_) => (
            Kind::Unreadable,
            "is a date: spreadsheets turn 1-2 and 3/4 into dates; format the cell as a number and type it again",
        ),
        Cell::TooLong(_) => (Kind::Unreadable, "has more characters than a cell can hold"),
        Cell::Number(_) | Cell::Bool(_) => (Kind::Unreadable, ""),
    };
    Err(Wrong::because(kind, detail))
}

/// Whether a text has a number with two readings.
pub(super) fn is_open(text: &str) -> bool {
    text.contains(['.', ','])
        && pieces(text)
            .iter()
            .any(|piece| matches!(piece, Piece::Number(Number::Either { .. })))
}

/// What the numbers of a text say about the decimal sign.
pub(super) fn evidence(text: &str) -> Vec<Decimal> {
    if !text.contains(['.', ',']) {
        return Vec::new();
    }
    pieces(text)
        .iter()
        .filter_map(|piece| match piece {
            Piece::Number(Number::Sure(_, evidence)) => *evidence,
            _ => None,
        })
        .collect()
}

/// The unit that a cell states; `None`: it is bare or cannot be read.
pub(super) fn stated_unit(text: &str, dimension: Dimension) -> Option<CellUnit> {
    let (text, _) = without_approximation(text);
    let Piece::Other(rest) = *pieces(text).last()? else {
        return None;
    };
    find(rest, dimension).ok().or_else(|| {
        let unit = Quantity::read(text).ok()?.unit;
        unit.filter(|unit| unit.dimension == dimension)
            .map(CellUnit::Known)
    })
}

/// Whether a cell is a number without a unit.
pub(super) fn is_bare(text: &str) -> bool {
    let (text, _) = without_approximation(text);
    matches!(pieces(text).as_slice(), [Piece::Number(number)] if *number != Number::Malformed)
}

/// The text before a bracket at the end, and in it.
pub(super) fn bracket_behind(text: &str) -> Option<(&str, &str)> {
    text.strip_suffix(')')?.rsplit_once('(')
}

/// The quantity in a text, in the unit of its cell or in that of its column.
///
/// # Errors
/// A text that is not one quantity of this dimension.
pub(super) fn quantity(
    text: &str,
    dimension: Dimension,
    unit: Option<CellUnit>,
    choice: Choice,
) -> Result<Measured, Wrong> {
    // Most cells are whole numbers without a unit.
    if let Some(unit) = unit
        && !text.is_empty()
        && text.bytes().all(|byte| byte.is_ascii_digit())
    {
        return Measured::in_unit(text, unit, true);
    }
    let round = (dimension == Dimension::Length).then(|| without_diameter(text).0);
    let (text, is_approximate) = without_approximation(round.as_deref().unwrap_or(text));
    let wanted = Wanted {
        dimension,
        unit,
        choice,
    };
    let mut found = wanted.spread_or_one(text)?;
    found.is_approximate |= is_approximate;
    Ok(found)
}

/// What a text is to hold.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    pub dimension: Dimension,
    /// Of bare numbers.
    pub unit: Option<CellUnit>,
    pub choice: Choice,
}

impl Wanted {
    /// With the unit that a text states itself, if it does.
    fn with_own(self, unit: Option<CellUnit>) -> Self {
        let unit = unit.or(self.unit);
        Self { unit, ..self }
    }

    fn spread_or_one(self, text: &str) -> Result<Measured, Wrong> {
        // 72" (1829 mm): two statements of one value; 85 kg (with books): a remark.
        if let Some((outer, inner)) = bracket_behind(text)
            && has_digit(outer)
        {
            let outer = outer.trim();
            if !has_digit(inner) {
                let own = find(inner, self.dimension).ok().filter(|_| is_bare(outer));
                return self.with_own(own).spread_or_one(outer);
            }
            let first = self.spread_or_one(outer)?;
            let second = self.spread_or_one(inner.trim())?;
            return if (first.si - second.si).abs() <= 0.02 * first.si.abs() {
                Ok(first)
            } else {
                let differ = "states two values that differ";
                Err(Wrong::because(Kind::NumberAmbiguous, differ))
            };
        }
        if let Some((middle, spread)) = text.split_once('±').or_else(|| text.split_once("+/-")) {
            let own = match pieces(spread.trim()).as_slice() {
                [Piece::Number(_), Piece::Other(rest)] => find(rest, self.dimension).ok(),
                _ => None,
            };
            let mut found = self.with_own(own).one(middle.trim())?;
            found.is_approximate = true;
            return Ok(found);
        }
        self.range(&pieces(text)).unwrap_or_else(|| self.one(text))
    }

    /// The middle of `150-180 cm`; `None`: the text is not a range.
    fn range(self, parts: &[Piece<'_>]) -> Option<Result<Measured, Wrong>> {
        const MARKS: &str = "- – — ~ to bis a à and .. ... 〜";
        let (low, words, high, rest) = match parts {
            [
                Piece::Number(low),
                Piece::Other(between),
                Piece::Number(high),
                rest @ ..,
            ] => (low, between.trim(), high, rest),
            _ => return None,
        };
        let rest = match rest {
            [] => "",
            [Piece::Other(rest)] => rest.trim(),
            _ => return None,
        };
        // The unit of the first number, if it has one, stands before the mark.
        let (first, mark) = words.rsplit_once(' ').unwrap_or(("", words));
        let first = if is_among(mark, MARKS) {
            first.trim()
        } else {
            MARKS
                .split(' ')
                .find_map(|mark| words.strip_suffix(mark))
                .map(str::trim)
                .filter(|rest| find(rest, self.dimension).is_ok())?
        };
        let own = |text: &str| match text {
            "" => Some(None),
            _ => find(text, self.dimension).ok().map(Some),
        };
        let (first, second) = (own(first)?, own(rest)?);
        let is = |unit: Option<CellUnit>, symbol| unit.is_some_and(|unit| unit.symbol() == symbol);
        // 6'-2" is one length.
        if is(first, "ft") && is(second, "in") {
            return None;
        }
        let is_bare = rest.is_empty();
        Some(
            self.middle((low, first), (high, second), words == "-" && is_bare)
                .map(|si| Measured {
                    is_approximate: true,
                    ..Measured::in_si(si, self.dimension, is_bare)
                }),
        )
    }

    /// The middle between two numbers with their units, if they have any.
    fn middle(
        self,
        (low, first): (&Number, Option<CellUnit>),
        (high, second): (&Number, Option<CellUnit>),
        may_be_inches: bool,
    ) -> Result<f64, Wrong> {
        let second = match self.dimension {
            Dimension::Ratio => None,
            _ => Some(second.or(first).or(self.unit).ok_or(Kind::UnitMissing)?),
        };
        let first = first.or(second);
        // 5-6 under feet may be 5 feet 6 inches.
        if may_be_inches && first.is_some_and(|unit| unit.symbol() == "ft") {
            return Err(Wrong::because(
                Kind::NumberAmbiguous,
                "may be a range or feet and inches",
            ));
        }
        let value = |number: &Number, unit: Option<CellUnit>| -> Result<f64, Wrong> {
            let text = self.choice.read(number)?;
            match unit {
                Some(unit) => unit.read(&text).map_err(|_| Wrong::too_large()),
                None => text.parse().map_err(|_| Kind::Unreadable.into()),
            }
        };
        let (low, high) = (value(low, first)?, value(high, second)?);
        if low > 0.0 && high > low && high <= 5.0 * low {
            Ok(0.5 * (low + high))
        } else {
            Err(Kind::Unreadable.into())
        }
    }

    pub(super) fn one(self, text: &str) -> Result<Measured, Wrong> {
        /// Words after a unit that say which size it is.
        const SIDES: &str = "h w d l high wide deep tall long hoch breit tief each ea";
        let is_ratio = self.dimension == Dimension::Ratio;
        let parts = pieces(text);
        let simple = match parts.as_slice() {
            [Piece::Number(number)] => Some((number, "")),
            [Piece::Number(number), Piece::Other(rest)] => Some((number, rest.trim())),
            _ => None,
        };
        let mut refused = NoUnit::Unknown;
        if let Some((number, rest)) = simple {
            let rest = match rest.rsplit_once(' ') {
                Some((unit, word)) if is_among(&word.to_lowercase(), SIDES) => unit.trim(),
                _ => rest,
            };
            if rest.is_empty() {
                return match self.unit {
                    Some(unit) => Measured::in_unit(&self.choice.read(number)?, unit, true),
                    None if is_ratio => {
                        let text = self.choice.read(number)?;
                        let si = text.parse().map_err(|_| Kind::Unreadable)?;
                        if !is_possible(si) {
                            return Err(Wrong::too_large());
                        }
                        Ok(Measured::sure(si, text, true))
                    }
                    None => Err(Kind::UnitMissing.into()),
                };
            }
            match find(rest, self.dimension) {
                Ok(own) => return Measured::in_unit(&self.choice.read(number)?, own, false),
                Err(why) => refused = why,
            }
        }
        if !is_ratio && has_two_values(&parts) {
            return Err(Wrong::because(
                Kind::NumberAmbiguous,
                "may be two values, and is no fraction as of inches",
            ));
        }
        // Feet and inches, fractions, signs.
        let text = joined(&parts, |number| self.choice.read(number))?;
        if let Ok(found) = Quantity::read(&text) {
            return self.scaled(&found);
        }
        let is_unit = simple.is_some_and(|(_, rest)| {
            let is_word =
                (2..=10).contains(&rest.chars().count()) && rest.chars().all(char::is_alphabetic);
            let is_known = matches!(refused, NoUnit::Other(_)) || lookup(rest).is_some();
            !rest.is_empty() && (is_known || is_word)
        });
        Err(if is_unit {
            Kind::UnitWrong
        } else {
            Kind::Unreadable
        }
        .into())
    }

    /// A quantity in its own unit, or in that of the column.
    fn scaled(self, found: &Quantity) -> Result<Measured, Wrong> {
        let stated = match found.unit {
            Some(own) if own.dimension == self.dimension => Some(CellUnit::Known(own)),
            Some(own) if self.dimension == Dimension::Mass && own.dimension == Dimension::Force => {
                Some(CellUnit::Force(own))
            }
            Some(_) => return Err(Kind::UnitWrong.into()),
            None => self.unit,
        };
        let scale = |unit| found.si(unit).map_err(|_| Wrong::too_large());
        let si = match stated {
            Some(CellUnit::Known(unit)) => scale(Some(unit))?,
            Some(CellUnit::Force(unit)) => scale(Some(unit))? / freestand::G0_M_S2,
            Some(CellUnit::Gram(kg)) => scale(Some(kg))? / 1000.0,
            None if self.dimension == Dimension::Ratio => scale(None)?,
            None => return Err(Kind::UnitMissing.into()),
        };
        Ok(Measured::in_si(si, self.dimension, found.unit.is_none()))
    }
}

/// Whether a stroke stands between two values, as in `1800/2000`: a fraction is less than one, and its lower
/// number is that of a rule, such as 1/2 or 15/16.
fn has_two_values(parts: &[Piece<'_>]) -> bool {
    let whole = |number: &Number| match number {
        Number::Sure(text, _) => text.parse::<u32>().ok(),
        _ => None,
    };
    parts.windows(3).any(|three| match three {
        [
            Piece::Number(upper),
            Piece::Other(stroke),
            Piece::Number(lower),
        ] if stroke.trim().ends_with('/') => {
            let is_fraction =
                |upper, lower: u32| upper < lower && lower.is_power_of_two() && lower <= 64;
            !whole(upper)
                .zip(whole(lower))
                .is_some_and(|(upper, lower)| is_fraction(upper, lower))
        }
        _ => false,
    })
}

/// A tolerance with its pulse: `15g 11ms`, `15 g, 11 ms`, `15 / 11 ms`; `None`: there is no pulse.
pub(super) fn with_pulse(text: &str) -> Option<(&str, &str)> {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
    if text.chars().all(is_of_number) {
        return None;
    }
    let parts = pieces(text);
    let numbers = parts
        .iter()
        .filter(|piece| matches!(piece, Piece::Number(_)))
        .count();
    if numbers != 2 {
        return None;
    }
    let is_of_number = |c: char| is_of_number(c) || c == ',';
    let trimmed = text.trim();
    // The unit of the second number is a time; words such as "half-sine" may follow either.
    let end = trimmed.rfind(|c: char| c.is_ascii_digit())?;
    let start = trimmed.get(..=end)?.trim_end_matches(is_of_number).len();
    let (first, second) = trimmed.split_at(start);
    let unit = second.trim_start_matches(is_of_number).trim();
    let unit = unit.split([' ', ')', ',']).next()?;
    find(unit, Dimension::Time).ok()?;
    let length = second.find(unit)? + unit.len();
    let peak = first
        .trim()
        .trim_end_matches(['@', '/', ',', ';', '(', ' ', '-'])
        .trim()
        .trim_end_matches("half-sine")
        .trim_end_matches("half sine")
        .trim_end_matches(" for")
        .trim_end_matches(" at")
        .trim();
    Some((
        peak.trim_end_matches([',', ';', '@', '/']).trim(),
        second.get(..length)?,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(text: &str, unit: Option<&str>) -> Result<(f64, bool), Kind> {
        let unit = unit.map(|unit| find(unit, Dimension::Length).unwrap());
        let found = quantity(
            &plain(text),
            Dimension::Length,
            unit,
            Choice::Sign(Decimal::Point),
        );
        found
            .map(|found| ((found.si * 1e6).round() / 1e6, found.is_approximate))
            .map_err(|wrong| wrong.kind)
    }

    #[test]
    fn lengths_as_people_type_them() {
        for (text, unit, expected) in [
            ("1800", Some("mm"), Ok((1.8, false))),
            ("1,800 mm", None, Ok((1.8, false))),
            ("1.8 m", Some("mm"), Ok((1.8, false))),
            ("1 800", Some("mm"), Ok((1.8, false))),
            ("１８０cm", None, Ok((1.8, false))),
            ("6'2\"", None, Ok((1.8796, false))),
            ("6′-2″", Some("in"), Ok((1.8796, false))),
            ("6 ft 2 in", None, Ok((1.8796, false))),
            ("5' 2 1/2\"", None, Ok((1.5875, false))),
            ("52½", Some("in"), Ok((1.3335, false))),
            ("11 1/2 in", None, Ok((0.2921, false))),
            ("72\" (1829 mm)", None, Ok((1.8288, false))),
            ("1829 (mm)", None, Ok((1.829, false))),
            ("72 in. high", None, Ok((1.8288, false))),
            ("approx. 180 cm", None, Ok((1.8, true))),
            ("150-180 cm", None, Ok((1.65, true))),
            ("150 – 180", Some("cm"), Ok((1.65, true))),
            ("150 cm to 1.8 m", None, Ok((1.65, true))),
            ("1800 ± 5 mm", None, Ok((1.8, true))),
            ("180 Zentimeter", None, Ok((1.8, false))),
            ("1800", None, Err(Kind::UnitMissing)),
            ("80 kg", Some("mm"), Err(Kind::UnitWrong)),
            ("5 furlongs", Some("mm"), Err(Kind::UnitWrong)),
            ("tall0x", Some("mm"), Err(Kind::Unreadable)),
            ("2 x 450", Some("mm"), Err(Kind::Unreadable)),
            ("1.2.3", Some("mm"), Err(Kind::Unreadable)),
            ("2019-05-01", Some("mm"), Err(Kind::Unreadable)),
            ("1800-2", Some("mm"), Err(Kind::Unreadable)),
            ("5-6", Some("ft"), Err(Kind::NumberAmbiguous)),
            ("72\" (1500 mm)", None, Err(Kind::NumberAmbiguous)),
            ("6'14\"", None, Err(Kind::Unreadable)),
            ("15/16\"", None, Ok((0.023_813, false))),
            ("1800/2000", Some("mm"), Err(Kind::NumberAmbiguous)),
            ("1800/2000 m", None, Err(Kind::NumberAmbiguous)),
            ("1800 mm/2000 mm", None, Err(Kind::NumberAmbiguous)),
            ("6/6", Some("ft"), Err(Kind::NumberAmbiguous)),
            ("2/3", Some("in"), Err(Kind::NumberAmbiguous)),
        ] {
            assert_eq!(length(text, unit), expected, "{text}");
        }
    }

    #[test]
    fn tolerances_with_a_pulse() {
        for (text, expected) in [
            ("15g 11ms", Some(("15g", "11ms"))),
            ("15 g, 11 ms", Some(("15 g", "11 ms"))),
            ("15/11 ms", Some(("15", "11 ms"))),
            ("15 g @ 11 ms half-sine", Some(("15 g", "11 ms"))),
            ("15 g half-sine 11 ms", Some(("15 g", "11 ms"))),
            ("15 g", None),
            ("10-15 g", None),
        ] {
            assert_eq!(with_pulse(text), expected, "{text}");
        }
    }
}
