//! One cell as a quantity in SI, or why it is none.

use freestand_input::quantity::{Dimension, Quantity, is_possible, lookup};
use freestand_input::words::canonical;

use super::cell::Cell;
use super::headings::order_of;
use super::numbers::{Decimal, Number, Piece, joined, pieces, plain};
use super::problems::Kind;
use super::round::without_diameter;
use super::units::{CellUnit, NoUnit, find};
use super::vocabulary::{is_missing, without_approximation};

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
        match (number, self) {
            (Number::Sure(text, _), _) => Ok(text.clone()),
            (Number::Malformed, _) => Err(Wrong::new(Kind::Unreadable)),
            (Number::Either { as_decimal, .. }, Self::Decimal) => Ok(as_decimal.clone()),
            (Number::Either { as_thousands, .. }, Self::Thousands) => Ok(as_thousands.clone()),
            (
                Number::Either {
                    sign,
                    as_decimal,
                    as_thousands,
                },
                Self::Sign(decimal),
            ) => Ok(if *sign == decimal {
                as_decimal.clone()
            } else {
                as_thousands.clone()
            }),
        }
    }
}

/// Why a cell has no value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Wrong {
    pub(super) kind: Kind,
    /// What is wrong, where the kind alone does not say it.
    pub(super) detail: Option<String>,
}

impl Wrong {
    pub(super) fn new(kind: Kind) -> Self {
        Self { kind, detail: None }
    }

    pub(super) fn out_of_range(detail: &str) -> Self {
        Self::because(Kind::OutOfRange, detail)
    }

    /// A value that no quantity has, as quantities elsewhere say it.
    pub(super) fn too_large() -> Self {
        Self::out_of_range("is too large: no quantity is above 1e18 in SI units")
    }

    pub(super) fn because(kind: Kind, detail: &str) -> Self {
        Self {
            kind,
            detail: Some(detail.to_owned()),
        }
    }
}

/// The value of a cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measured {
    /// In SI.
    pub(super) si: f64,
    /// Number and unit, ready for a reader of quantities.
    pub(super) text: String,
    /// A rough value, or the middle of a range.
    pub(super) is_approximate: bool,
    /// Whether the unit is that of the column.
    pub(super) is_bare: bool,
}

/// The text of a cell that may hold a number; `None`: its value is missing.
///
/// # Errors
/// A cell that is an error, a truth value or a date.
pub(super) fn number_text(cell: &Cell) -> Result<Option<String>, Wrong> {
    match cell {
        Cell::Text(text)
            if ["#REF!", "#DIV/0!", "#VALUE!", "#NAME?", "#NUM!", "#NULL!"]
                .contains(&text.trim()) =>
        {
            Err(Wrong::because(Kind::Formula, "is the error of a formula"))
        }
        Cell::Text(text) => {
            let text = plain(text);
            let has_digit = text
                .chars()
                .any(|c| c.is_ascii_digit() || "½¼¾⅓⅔⅛⅜⅝⅞".contains(c));
            Ok((has_digit && !is_missing(&text)).then_some(text))
        }
        Cell::Number(value) if value.is_finite() => Ok(Some(format!("{value}"))),
        Cell::Error(text) if text == "#N/A" => Ok(None),
        Cell::Error(_) => Err(Wrong::because(Kind::Formula, "is the error of a formula")),
        Cell::Unevaluated => Err(Wrong::new(Kind::Formula)),
        Cell::Date(_) => Err(Wrong::because(
            Kind::Unreadable,
            "is a date: spreadsheets turn 1-2 and 3/4 into dates; format the cell as a number and type it again",
        )),
        Cell::TooLong(_) => Err(Wrong::because(
            Kind::Unreadable,
            "has more characters than a cell can hold",
        )),
        Cell::Number(_) | Cell::Bool(_) => Err(Wrong::new(Kind::Unreadable)),
    }
}

/// Whether a text has a number with two readings.
pub(super) fn is_open(text: &str) -> bool {
    text.contains(['.', ','])
        && pieces(text)
            .iter()
            .any(|piece| matches!(piece, Piece::Number(Number::Either { .. })))
}

/// What the numbers of a text say about the decimal sign.
pub(super) fn evidence(text: &str) -> impl Iterator<Item = Decimal> {
    let found = if text.contains(['.', ',']) {
        pieces(text)
    } else {
        Vec::new()
    };
    let said: Vec<Decimal> = found
        .iter()
        .filter_map(|piece| match piece {
            Piece::Number(Number::Sure(_, evidence)) => *evidence,
            _ => None,
        })
        .collect();
    said.into_iter()
}

/// The unit that a cell states; `None`: it is bare or cannot be read.
pub(super) fn stated_unit(text: &str, dimension: Dimension) -> Option<CellUnit> {
    let (text, _) = without_approximation(text);
    let parts = pieces(text);
    match parts.last()? {
        Piece::Other(rest) => match find(rest, dimension) {
            Ok(unit) => Some(unit),
            Err(_) => Quantity::read(text)
                .ok()?
                .unit
                .filter(|unit| unit.dimension == dimension)
                .map(CellUnit::Known),
        },
        Piece::Number(_) => None,
    }
}

/// Whether a cell is a number without a unit.
pub(super) fn is_bare(text: &str) -> bool {
    let (text, _) = without_approximation(text);
    matches!(pieces(text).as_slice(), [Piece::Number(number)] if *number != Number::Malformed)
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
    if let (Some(unit), true) = (
        unit,
        !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit()),
    ) {
        let si = unit.read(text).map_err(|_| Wrong::too_large())?;
        return Ok(Measured {
            si,
            text: with_symbol(text, unit, si),
            is_approximate: false,
            is_bare: true,
        });
    }
    let round = (dimension == Dimension::Length).then(|| without_diameter(text).0);
    let (text, is_approximate) = without_approximation(round.as_deref().unwrap_or(text));
    let mut found = spread_or_one(text, dimension, unit, choice)?;
    found.is_approximate |= is_approximate;
    Ok(found)
}

fn spread_or_one(
    text: &str,
    dimension: Dimension,
    unit: Option<CellUnit>,
    choice: Choice,
) -> Result<Measured, Wrong> {
    // 72" (1829 mm): two statements of one value; 85 kg (with books): a remark.
    if let Some((outer, inner)) = text
        .strip_suffix(')')
        .and_then(|rest| rest.rsplit_once('('))
    {
        let outer = outer.trim();
        if outer.chars().any(|c| c.is_ascii_digit()) {
            if inner.chars().any(|c| c.is_ascii_digit()) {
                let first = spread_or_one(outer, dimension, unit, choice)?;
                let second = spread_or_one(inner.trim(), dimension, unit, choice)?;
                let is_same = (first.si - second.si).abs() <= 0.02 * first.si.abs();
                let differ = "states two values that differ";
                return if is_same {
                    Ok(first)
                } else {
                    Err(Wrong::because(Kind::NumberAmbiguous, differ))
                };
            }
            let own = find(inner, dimension).ok().filter(|_| is_bare(outer));
            return spread_or_one(outer, dimension, own.or(unit), choice);
        }
    }
    if let Some((middle, spread)) = text.split_once('±').or_else(|| text.split_once("+/-")) {
        let after = pieces(spread.trim());
        let own = match after.as_slice() {
            [Piece::Number(_), Piece::Other(rest)] => find(rest, dimension).ok(),
            _ => None,
        };
        return one(middle.trim(), dimension, own.or(unit), choice).map(|found| Measured {
            is_approximate: true,
            ..found
        });
    }
    let parts = pieces(text);
    if let Some(found) = range(&parts, dimension, unit, choice) {
        return found;
    }
    one(text, dimension, unit, choice)
}

/// The middle of `150-180 cm`; `None`: the text is not a range.
fn range(
    parts: &[Piece<'_>],
    dimension: Dimension,
    unit: Option<CellUnit>,
    choice: Choice,
) -> Option<Result<Measured, Wrong>> {
    let (low, between, high, rest) = match parts {
        [
            Piece::Number(low),
            Piece::Other(between),
            Piece::Number(high),
        ] => (low, *between, high, ""),
        [
            Piece::Number(low),
            Piece::Other(between),
            Piece::Number(high),
            Piece::Other(rest),
        ] => (low, *between, high, *rest),
        _ => return None,
    };
    const MARKS: [&str; 12] = [
        "-", "–", "—", "~", "to", "bis", "a", "à", "and", "..", "...", "〜",
    ];
    let words = between.trim();
    // The unit of the first number, if it has one, stands before the mark.
    let (first, mark) = match words.rsplit_once(' ') {
        Some((unit, mark)) => (unit.trim(), mark),
        None => ("", words),
    };
    let joined_unit = MARKS
        .iter()
        .find_map(|mark| words.strip_suffix(mark))
        .map(str::trim);
    let first = if MARKS.contains(&mark) {
        first
    } else {
        joined_unit.filter(|rest| find(rest, dimension).is_ok())?
    };
    let own = |text: &str| {
        if text.is_empty() {
            Ok(None)
        } else {
            find(text, dimension).map(Some)
        }
    };
    let (Ok(first), Ok(second)) = (own(first), own(rest.trim())) else {
        return None;
    };
    // 6'-2" is one length.
    if first.is_some_and(|unit| unit.symbol() == "ft")
        && second.is_some_and(|unit| unit.symbol() == "in")
    {
        return None;
    }
    let read = || {
        let second = second
            .or(first)
            .or(unit)
            .ok_or(Wrong::new(Kind::UnitMissing));
        let second = if dimension == Dimension::Ratio {
            None
        } else {
            Some(second?)
        };
        let first = first.or(second);
        // 5-6 under feet may be 5 feet 6 inches.
        if first.or(second).is_some_and(|unit| unit.symbol() == "ft")
            && between.trim() == "-"
            && rest.trim().is_empty()
        {
            return Err(Wrong::because(
                Kind::NumberAmbiguous,
                "may be a range or feet and inches",
            ));
        }
        let value = |number: &Number, unit: Option<CellUnit>| {
            let text = choice.read(number)?;
            match unit {
                Some(unit) => unit.read(&text).map_err(|_| Wrong::new(Kind::Unreadable)),
                None => text
                    .parse::<f64>()
                    .map_err(|_| Wrong::new(Kind::Unreadable)),
            }
        };
        let (low, high) = (value(low, first)?, value(high, second)?);
        if !(low > 0.0 && high > low && high <= 5.0 * low) {
            return Err(Wrong::new(Kind::Unreadable));
        }
        let si = 0.5 * (low + high);
        let is_bare = rest.trim().is_empty();
        Ok(Measured {
            si,
            text: format!("{si} {}", si_symbol(dimension)),
            is_approximate: true,
            is_bare,
        })
    };
    Some(read())
}

fn si_symbol(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::Length => "m",
        Dimension::Mass => "kg",
        Dimension::Time => "s",
        Dimension::Acceleration => "m/s2",
        Dimension::Stiffness => "N/m",
        Dimension::Velocity => "m/s",
        _ => "",
    }
}

/// Number and unit, ready for a reader of quantities.
fn with_symbol(number: &str, unit: CellUnit, si: f64) -> String {
    match unit {
        CellUnit::Known(unit) => format!("{number} {}", unit.symbol),
        CellUnit::Force(_) | CellUnit::Gram(_) => format!("{si} kg"),
    }
}

/// Words after a unit that say which size it is.
const SIDES: [&str; 14] = [
    "h", "w", "d", "l", "high", "wide", "deep", "tall", "long", "hoch", "breit", "tief", "each",
    "ea",
];

fn one(
    text: &str,
    dimension: Dimension,
    unit: Option<CellUnit>,
    choice: Choice,
) -> Result<Measured, Wrong> {
    let parts = pieces(text);
    let unreadable = || Wrong::new(Kind::Unreadable);
    let simple = match parts.as_slice() {
        [Piece::Number(number)] => Some((number, "")),
        [Piece::Number(number), Piece::Other(rest)] => Some((number, rest.trim())),
        _ => None,
    };
    let value = |number: &Number, unit: CellUnit, is_bare| {
        let text = choice.read(number)?;
        let si = unit.read(&text).map_err(|_| Wrong::too_large())?;
        let text = with_symbol(&text, unit, si);
        Ok(Measured {
            si,
            text,
            is_approximate: false,
            is_bare,
        })
    };
    let mut refused = NoUnit::Unknown;
    if let Some((number, rest)) = simple {
        let last_word = rest
            .rsplit_once(' ')
            .filter(|(_, word)| SIDES.contains(&word.to_lowercase().as_str()));
        let rest = last_word.map_or(rest, |(unit, _)| unit.trim());
        if rest.is_empty() {
            return match unit {
                Some(unit) => value(number, unit, true),
                None if dimension == Dimension::Ratio => {
                    let text = choice.read(number)?;
                    let si = text.parse::<f64>().map_err(|_| unreadable())?;
                    if !is_possible(si) {
                        return Err(Wrong::too_large());
                    }
                    Ok(Measured {
                        si,
                        text,
                        is_approximate: false,
                        is_bare: true,
                    })
                }
                None => Err(Wrong::new(Kind::UnitMissing)),
            };
        }
        match find(rest, dimension) {
            Ok(own) => return value(number, own, false),
            Err(why) => refused = why,
        }
    }
    if dimension != Dimension::Ratio && has_two_values(&parts) {
        return Err(Wrong::because(
            Kind::NumberAmbiguous,
            "may be two values, and is no fraction as of inches",
        ));
    }
    // Feet and inches, fractions, signs.
    let text = joined(&parts, |number| choice.read(number))?;
    match Quantity::read(&text) {
        Ok(found) => {
            let stated = match (found.unit, unit) {
                (Some(own), _) if own.dimension == dimension => Some(CellUnit::Known(own)),
                (Some(own), _)
                    if dimension == Dimension::Mass && own.dimension == Dimension::Force =>
                {
                    Some(CellUnit::Force(own))
                }
                (Some(_), _) => return Err(Wrong::new(Kind::UnitWrong)),
                (None, unit) => unit,
            };
            let is_bare = found.unit.is_none();
            let scale = |found: &Quantity, unit| found.si(unit).map_err(|_| Wrong::too_large());
            let si = match stated {
                Some(CellUnit::Known(unit)) => scale(&found, Some(unit))?,
                Some(CellUnit::Force(unit)) => scale(&found, Some(unit))? / freestand::G0_M_S2,
                Some(CellUnit::Gram(kg)) => scale(&found, Some(kg))? / 1000.0,
                None if dimension == Dimension::Ratio => scale(&found, None)?,
                None => return Err(Wrong::new(Kind::UnitMissing)),
            };
            Ok(Measured {
                si,
                text: format!("{si} {}", si_symbol(dimension)),
                is_approximate: false,
                is_bare,
            })
        }
        Err(_) => {
            let rest = simple.map_or("", |(_, rest)| rest);
            let is_word = !rest.is_empty()
                && rest.chars().count() <= 10
                && rest.chars().all(char::is_alphabetic)
                && rest.chars().count() > 1;
            let is_unit = matches!(refused, NoUnit::Other(_)) || lookup(rest).is_some() || is_word;
            Err(Wrong::new(
                if simple.is_some() && is_unit && !rest.is_empty() {
                    Kind::UnitWrong
                } else {
                    Kind::Unreadable
                },
            ))
        }
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

/// The three sizes of a cell \[m\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Sizes {
    pub(super) height: Option<f64>,
    pub(super) width: Option<f64>,
    pub(super) thickness: Option<f64>,
    /// No letters and no heading said which is which.
    pub(super) is_order_guessed: bool,
    /// A side is called a diameter.
    pub(super) is_round: bool,
    pub(super) is_approximate: bool,
    pub(super) is_bare: bool,
}

/// One size, with the letter that names it.
#[derive(Clone, Copy)]
struct Side<'t> {
    text: &'t str,
    letter: Option<char>,
}

/// `1800 x 600 x 450 mm`, `H1800 × W600 × D450`, `H 1800, W 600, D 450`, `6'2" x 2'6" x 18"`,
/// `Ø230 x 1500`; `H ? x W 600 x D 450` has no height.
///
/// # Errors
/// Anything but two or three lengths.
pub(super) fn sizes(
    text: &str,
    unit: Option<CellUnit>,
    order: Option<&[char]>,
    choice: Choice,
) -> Result<Sizes, Wrong> {
    let (text, is_approximate) = without_approximation(text);
    let unreadable = || Wrong::new(Kind::Unreadable);
    let lower = text
        .to_lowercase()
        .replace(" by ", "x")
        .replace(['×', '✕', 'х', '*'], "x");
    // A bracket behind may say the order: 60x40x180 (LxWxH).
    let (lower, in_cell) = match lower
        .strip_suffix(')')
        .and_then(|rest| rest.rsplit_once('('))
    {
        Some((outer, inner)) if order_of(inner).is_some() => {
            (outer.trim().to_owned(), order_of(inner))
        }
        _ => (lower, None),
    };
    let parts: Vec<&str> = if lower.contains('x') {
        lower.split('x').collect()
    } else {
        lettered(&lower)
            .or_else(|| Some(lower.split('/').collect()).filter(|parts: &Vec<_>| parts.len() == 3))
            .ok_or_else(unreadable)?
    };
    let sides: Vec<Side<'_>> = parts.into_iter().map(|part| side(part.trim())).collect();
    if !(2..=3).contains(&sides.len()) {
        return Err(unreadable());
    }
    // The last unit holds for all that have none.
    let last = sides
        .last()
        .and_then(|side| stated_unit(side.text, Dimension::Length));
    let is_stated = sides
        .iter()
        .any(|side| stated_unit(side.text, Dimension::Length).is_some());
    let is_bare = !is_stated;
    let unit = last.or(unit);
    // A size that is named but not known: the others hold.
    let known: Vec<Side<'_>> = sides
        .iter()
        .filter(|side| side.letter.is_none() || !is_missing(side.text))
        .copied()
        .collect();
    let mut sides = if known.is_empty() { sides } else { known };
    let values: Vec<f64> = sides
        .iter()
        .map(|side| one(side.text, Dimension::Length, unit, choice).map(|found| found.si))
        .collect::<Result<_, _>>()?;
    let mut found = Sizes {
        is_approximate,
        is_bare,
        ..Sizes::default()
    };
    let has_round = sides.iter().any(|side| side.letter == Some('O'));
    if let ([first, second], true) = (values.as_slice(), has_round) {
        let is_first = sides.first().is_some_and(|side| side.letter == Some('O'));
        let (round, height) = if is_first {
            (*first, *second)
        } else {
            (*second, *first)
        };
        return Ok(Sizes {
            height: Some(height),
            width: Some(round),
            thickness: Some(round),
            is_round: true,
            ..found
        });
    }
    let order = in_cell.as_deref().or(order);
    if sides.iter().all(|side| side.letter.is_none())
        && let Some(order) = order.filter(|order| order.len() == sides.len())
    {
        for (side, letter) in sides.iter_mut().zip(order) {
            side.letter = Some(*letter);
        }
    }
    let letters: Vec<char> = sides.iter().filter_map(|side| side.letter).collect();
    if letters.len() == sides.len() {
        let value = |letter: char| {
            letters
                .iter()
                .position(|other| *other == letter)
                .and_then(|at| values.get(at))
                .copied()
        };
        let (height, width, length, depth) = (value('H'), value('W'), value('L'), value('D'));
        let named = [height, width, length, depth].iter().flatten().count();
        if named != sides.len() {
            return Err(unreadable());
        }
        found.height = height;
        (found.width, found.thickness) = match (length, width, depth) {
            (Some(length), Some(width), None) => (Some(length), Some(width)),
            (None, width, depth) => (width, depth),
            (Some(length), None, depth) => (Some(length), depth),
            _ => return Err(unreadable()),
        };
        return Ok(found);
    }
    if !letters.is_empty() {
        return Err(unreadable());
    }
    let mut sorted = values.clone();
    sorted.sort_by(f64::total_cmp);
    match sorted.as_slice() {
        [short, long, height] => {
            found = Sizes {
                height: Some(*height),
                width: Some(*long),
                thickness: Some(*short),
                ..found
            };
            found.is_order_guessed = true;
        }
        [short, long] => {
            found = Sizes {
                width: Some(*long),
                thickness: Some(*short),
                ..found
            }
        }
        _ => return Err(unreadable()),
    }
    Ok(found)
}

/// `H 1800, W 600 mm D 450` or `1800h 600w 450d`, cut into its sizes; `None` where not each of them has
/// its letter.
fn lettered(text: &str) -> Option<Vec<&str>> {
    let is_gap = |c: char| c.is_whitespace() || matches!(c, ',' | ';');
    let starts_with_digit = |word: &str| word.starts_with(|c: char| c.is_ascii_digit() || c == '?');
    let words: Vec<&str> = text.split(is_gap).filter(|word| !word.is_empty()).collect();
    let mut starts: Vec<usize> = Vec::new();
    let mut from = 0;
    for (place, word) in words.iter().enumerate() {
        let at = from + text.get(from..)?.find(word)?;
        from = at + word.len();
        let digits = word
            .find(|c: char| c.is_ascii_digit() || c == '?')
            .unwrap_or(word.len());
        let (before, rest) = word.split_at(digits);
        let names_next = rest.is_empty()
            && words
                .get(place + 1)
                .is_some_and(|next| starts_with_digit(next));
        let is_named = axis(before.trim_end_matches([':', '=', '.'])).is_some()
            && (!rest.is_empty() || names_next);
        if is_named || starts_with_digit(word) && side(word).letter.is_some() {
            starts.push(at);
        }
    }
    let ends = starts.iter().skip(1).copied().chain([text.len()]);
    let parts = starts
        .iter()
        .zip(ends)
        .map(|(&start, end)| Some(text.get(start..end)?.trim_end_matches(is_gap)));
    (starts.first() == Some(&0) && starts.len() > 1).then(|| parts.collect())?
}

/// The letter of a word that names a size; O: a diameter.
fn axis(word: &str) -> Option<char> {
    let word = word.trim_matches(|c: char| !c.is_alphabetic() && !matches!(c, '⌀' | 'ø'));
    if matches!(word, "ø" | "⌀" | "dia" | "diam") {
        return Some('O');
    }
    Some(match canonical(word).as_str() {
        "h" | "a" | "ht" | "high" | "tall" | "hoch" | "height" | "alto" | "hauteur" | "haut" => 'H',
        "w" | "b" | "wide" | "breit" | "width" | "ancho" | "largeur" | "larg" => 'W',
        "l" | "long" | "lang" | "length" | "longueur" | "largo" => 'L',
        "d" | "t" | "p" | "f" | "deep" | "tief" | "depth" | "fondo" | "profondeur" | "prof" => 'D',
        _ => return None,
    })
}

/// A size without the letter before or after it.
fn side(text: &str) -> Side<'_> {
    let number = text.find(|c: char| c.is_ascii_digit() || matches!(c, '.' | '?'));
    let start = number
        .or_else(|| text.find(char::is_whitespace))
        .unwrap_or(0);
    let (before, rest) = text.split_at(start);
    if let Some(found) = axis(before.trim().trim_end_matches([':', '=', '.'])) {
        return Side {
            text: rest.trim(),
            letter: Some(found),
        };
    }
    // 1800h, 1800 mm h, 72"h, 1800 mm (h), but not the m of 1.8 m.
    let bare = rest.trim_end_matches([')', ' ']);
    let end = bare
        .rfind(|c: char| !c.is_alphabetic() && c != '⌀')
        .map_or(0, |at| {
            at + bare[at..].chars().next().map_or(1, char::len_utf8)
        });
    let (rest, word) = bare.split_at(end);
    if find(word, Dimension::Length).is_err()
        && let Some(found) = axis(word)
    {
        return Side {
            text: rest.trim().trim_end_matches('(').trim(),
            letter: Some(found),
        };
    }
    Side { text, letter: None }
}

/// A tolerance with its pulse: `15g 11ms`, `15 g, 11 ms`, `15 / 11 ms`; `None`: there is no pulse.
pub(super) fn with_pulse(text: &str) -> Option<(&str, &str)> {
    if text
        .bytes()
        .all(|byte| byte.is_ascii_digit() || byte == b'.')
    {
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
    let trimmed = text.trim();
    // The unit of the second number is a time; words such as "half-sine" may follow either.
    let end = trimmed.rfind(|c: char| c.is_ascii_digit())?;
    let start = trimmed
        .get(..=end)?
        .rfind(|c: char| !c.is_ascii_digit() && c != '.' && c != ',')?;
    let start = start + trimmed.get(start..)?.chars().next()?.len_utf8();
    let (first, second) = (trimmed.get(..start)?, trimmed.get(start..)?);
    let unit = second
        .trim_start_matches(|c: char| c.is_ascii_digit() || c == '.' || c == ',')
        .trim();
    let unit = unit.split([' ', ')', ',']).next()?;
    find(unit, Dimension::Time).ok()?;
    let length = second.find(unit)? + unit.len();
    let peak = first
        .trim()
        .trim_end_matches(['@', '/', ',', ';', '(', ' ', '-'])
        .trim();
    let peak = peak
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
    fn sizes_in_one_cell() {
        let mm = find("mm", Dimension::Length).ok();
        let read = |text: &str, order: Option<&[char]>| {
            let found = sizes(&plain(text), mm, order, Choice::Sign(Decimal::Point)).unwrap();
            let mm = |size: Option<f64>| size.map(|size| (size * 1e3).round());
            (
                mm(found.height),
                mm(found.width),
                mm(found.thickness),
                found.is_order_guessed,
            )
        };
        let plain_order = (Some(1800.0), Some(600.0), Some(450.0), false);
        for text in [
            "H1800 x W600 x D450",
            "1800H x 600W x 450D",
            "B600 × T450 × H1800",
            "180 cm (H) x 60 cm (W) x 45 cm (D)",
            "h: 1800, w: 600, d: 450".replace(", ", " x ").as_str(),
            "600x450x1800 (WxDxH)",
            "L 600 x B 450 x H 1800",
            "H1800 W600 D450",
            "H 1800, W 600, D 450",
            "H: 180 cm; W: 60 cm; D: 45 cm",
            "1800h 600w 450d",
        ] {
            assert_eq!(read(text, None), plain_order, "{text}");
        }
        assert_eq!(
            read("1800 x 600 x 450", Some(&['H', 'W', 'D'])),
            plain_order
        );
        assert_eq!(
            read("450 x 1800 x 600", None),
            (Some(1800.0), Some(600.0), Some(450.0), true)
        );
        assert_eq!(
            read("180 x 60 x 45 cm", None),
            (Some(1800.0), Some(600.0), Some(450.0), true)
        );
        assert_eq!(
            read("6'0\" x 2'0\" x 18\"", None),
            (Some(1829.0), Some(610.0), Some(457.0), true)
        );
        assert_eq!(
            read("Ø230 x 1500", None),
            (Some(1500.0), Some(230.0), Some(230.0), false)
        );
        assert_eq!(
            read("600 x 450", None),
            (None, Some(600.0), Some(450.0), false)
        );
        for text in ["H ? x W 600 x D 450", "W 600 D 450", "H tbc x W600 x D450"] {
            assert_eq!(
                read(text, None),
                (None, Some(600.0), Some(450.0), false),
                "{text}"
            );
        }
        for text in [
            "1800",
            "1 x 2 x 3 x 4",
            "H1800 x 600 x 450",
            "large",
            "H ? x W ?",
            "1800 600 450",
            "H1800 600 450",
        ] {
            assert!(
                sizes(text, mm, None, Choice::Sign(Decimal::Point)).is_err(),
                "{text}"
            );
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
