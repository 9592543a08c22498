//! Numbers as people type them: which sign is the decimal one, and what the digits say about it.
//!
//! A cell alone often cannot say whether `1.200` is 1200 or 1.2; its column can. Here each number
//! is taken apart into what is certain, what it tells about the decimal sign, and the two readings
//! between which a column decides.

use freestand::cushion::PAD_STIFFNESS_N_M;

use super::columns::Column;

/// A decimal sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum Decimal {
    /// `85.5`
    Point,
    /// `85,5`
    Comma,
}

impl Decimal {
    /// Its name in outputs.
    pub(super) fn name(self) -> &'static str {
        self.into()
    }

    fn of(sign: char) -> Self {
        if sign == ',' {
            Self::Comma
        } else {
            Self::Point
        }
    }

    pub(super) fn other(self) -> Self {
        match self {
            Self::Point => Self::Comma,
            Self::Comma => Self::Point,
        }
    }
}

/// One number of a cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Number {
    /// One reading, with a decimal point; and what it tells about the decimal sign.
    Sure(String, Option<Decimal>),
    /// `1.200` or `1,200`: the reading with this sign as the decimal one, and the other one.
    Either {
        sign: Decimal,
        as_decimal: String,
        as_thousands: String,
    },
    /// `1.2.3`: none.
    Malformed,
}

/// A part of a cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Piece<'t> {
    Number(Number),
    /// Everything between numbers, as it is.
    Other(&'t str),
}

/// Characters by which groups of three digits may be separated, beside point and comma.
fn is_group_mark(c: char) -> bool {
    matches!(
        c,
        ' ' | '\u{a0}' | '\u{2009}' | '\u{202f}' | '\u{2007}' | '\''
    )
}

/// Takes a cell apart into numbers and what is between them. The text must be [`plain`].
pub(super) fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut found = Vec::new();
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let (mut at, mut start) = (0, 0);
    while at < bytes.len() {
        let is_start = digit(at) || matches!(bytes.get(at), Some(b'.' | b',')) && digit(at + 1);
        if !is_start {
            at += 1;
            continue;
        }
        let end = number_end(text, at);
        if let Some(between) = text.get(start..at).filter(|between| !between.is_empty()) {
            found.push(Piece::Other(between));
        }
        found.push(Piece::Number(number(text.get(at..end).unwrap_or_default())));
        (at, start) = (end, end);
    }
    if let Some(rest) = text.get(start..).filter(|rest| !rest.is_empty()) {
        found.push(Piece::Other(rest));
    }
    found
}

/// Where the number that begins at `start` ends.
fn number_end(text: &str, start: usize) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes
            .get(from..)
            .unwrap_or_default()
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let mut end = start + digits(start);
    let mut group = end - start;
    while let Some(mark) = text.get(end..).and_then(|rest| rest.chars().next()) {
        let next = end + mark.len_utf8();
        let following = digits(next);
        let goes_on = match mark {
            '.' | ',' => following > 0,
            // Only groups of exactly three belong together: "5 2" and "5' 2" are two numbers.
            _ if is_group_mark(mark) => {
                following == 3
                    && (1..=3).contains(&group)
                    && !matches!(bytes.get(next + 3), Some(b'/' | b'"' | b'\''))
                    && !is_fraction(text.get(next + 3..).unwrap_or_default())
            }
            _ => false,
        };
        if !goes_on {
            break;
        }
        group = following;
        end = next + following;
    }
    // 1.5e3, but not the e of a word.
    if let Some(b'e' | b'E') = bytes.get(end) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let length = digits(end + 1 + sign);
        let after = end + 1 + sign + length;
        if length > 0
            && !text
                .get(after..)
                .and_then(|rest| rest.chars().next())
                .is_some_and(char::is_alphabetic)
        {
            end = after;
        }
    }
    end
}

/// Fractions that are one character.
pub(super) const FRACTIONS: [char; 9] = ['½', '¼', '¾', '⅓', '⅔', '⅛', '⅜', '⅝', '⅞'];

fn is_fraction(rest: &str) -> bool {
    rest.trim_start().starts_with(FRACTIONS)
}

/// Whether a text has a digit.
pub(super) fn has_digit(text: &str) -> bool {
    text.bytes().any(|byte| byte.is_ascii_digit())
}

/// What a run of digits and signs means.
fn number(text: &str) -> Number {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => text.split_at(at),
        None => (text, ""),
    };
    let marks: Vec<char> = mantissa.chars().filter(|c| !c.is_ascii_digit()).collect();
    let groups: Vec<&str> = mantissa.split(|c: char| !c.is_ascii_digit()).collect();
    let digits = |groups: &[&str]| groups.concat();
    let has_thousands = |groups: &[&str]| {
        groups
            .first()
            .is_some_and(|first| (1..=3).contains(&first.len()) && *first != "0")
            && groups.iter().skip(1).all(|group| group.len() == 3)
    };
    let sure = |whole: String, fraction: &str, evidence| {
        let whole = if whole.is_empty() {
            "0".to_owned()
        } else {
            whole
        };
        let point = if fraction.is_empty() { "" } else { "." };
        Number::Sure(format!("{whole}{point}{fraction}{exponent}"), evidence)
    };
    let Some((&last, before)) = marks.split_last() else {
        return sure(mantissa.to_owned(), "", None);
    };
    let Some((&fraction, whole)) = groups.split_last() else {
        return Number::Malformed;
    };
    let is_sign = |c: char| matches!(c, '.' | ',');
    if before.is_empty() && is_sign(last) {
        let before_sign = whole.first().copied().unwrap_or_default();
        let sign = Decimal::of(last);
        let is_open = fraction.len() == 3
            && (1..=3).contains(&before_sign.len())
            && !before_sign.starts_with('0')
            && exponent.is_empty();
        return if is_open {
            let as_decimal = format!("{before_sign}.{fraction}");
            Number::Either {
                sign,
                as_decimal,
                as_thousands: format!("{before_sign}{fraction}"),
            }
        } else {
            sure(before_sign.to_owned(), fraction, Some(sign))
        };
    }
    // Several marks of one kind: thousands, and the other sign is the decimal one.
    if before.iter().all(|mark| same_kind(*mark, last)) {
        let evidence = is_sign(last).then(|| Decimal::of(last).other());
        return if has_thousands(&groups) {
            sure(digits(&groups), "", evidence)
        } else {
            Number::Malformed
        };
    }
    // Two kinds: the last is the decimal sign, once; the first separates thousands.
    let first = before.first().copied().unwrap_or(last);
    let is_well_formed = is_sign(last)
        && !same_kind(first, last)
        && before.iter().all(|mark| same_kind(*mark, first))
        && has_thousands(whole);
    if is_well_formed {
        sure(digits(whole), fraction, Some(Decimal::of(last)))
    } else {
        Number::Malformed
    }
}

fn same_kind(a: char, b: char) -> bool {
    a == b || a.is_whitespace() && b.is_whitespace()
}

/// The text of pieces with every number in one reading; `read` chooses between two.
pub(super) fn joined<E>(
    pieces: &[Piece<'_>],
    mut read: impl FnMut(&Number) -> Result<String, E>,
) -> Result<String, E> {
    let mut text = String::new();
    for piece in pieces {
        match piece {
            Piece::Other(other) => text.push_str(other),
            Piece::Number(number) => text.push_str(&read(number)?),
        }
    }
    Ok(text)
}

/// A text with full-width letters, digits and signs as plain ones, one kind of quotation marks, and
/// a minus where there is one.
pub(super) fn plain(text: &str) -> String {
    if text
        .bytes()
        .all(|byte| (b' '..0x7f).contains(&byte) && !matches!(byte, b'\'' | b'`'))
    {
        return text.trim().to_owned();
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text.trim().chars().peekable();
    while let Some(c) = rest.next() {
        let is_between = out.ends_with(|last: char| last.is_ascii_digit())
            && rest.peek().is_some_and(char::is_ascii_digit);
        let c = match c {
            // Two lines of a cell are two numbers, and never one with groups of digits.
            '\n' | '\r' if is_between => '\n',
            '\u{ff01}'..='\u{ff5e}' => char::from_u32(c as u32 - 0xfee0).unwrap_or(c),
            '\u{3000}' | '\n' | '\r' | '\t' => ' ',
            '\u{2212}' => '-',
            '’' | '‘' | '′' | '´' | '`' => '\'',
            '”' | '“' | '″' | '„' => '"',
            _ => c,
        };
        // Two apostrophes are an inch.
        if c == '\'' && out.ends_with('\'') {
            out.pop();
            out.push('"');
        } else {
            out.push(c);
        }
    }
    out
}

/// Whether a value is one that such an object can have. It decides between two readings and never
/// refuses a value.
pub(super) fn is_plausible(column: Column, value: f64) -> bool {
    let range = match column {
        Column::Height => 0.1..=6.0,
        Column::Thickness
        | Column::Width
        | Column::Diameter
        | Column::BaseThickness
        | Column::BaseWidth => 0.05..=6.0,
        Column::CgHeight => 0.02..=5.0,
        Column::Mass => 0.5..=100e3,
        Column::Tolerance => 0.3 * 9.80665..=1000.0 * 9.80665,
        Column::ToleranceDuration => 1e-4..=1.0,
        Column::ToleranceVelocityChange => 0.01..=50.0,
        Column::ToleranceEdgeLift => 1e-4..=1.0,
        Column::PadThickness => 5e-4..=0.5,
        Column::Stiffness | Column::PadStiffness | Column::SeriesStiffness => PAD_STIFFNESS_N_M,
        Column::LevelRatio | Column::Restitution | Column::Accepted | Column::Friction => 0.0..=1.0,
        Column::RestitutionFactor => 0.3..=2.0,
        Column::Quantity | Column::PadsPerEdge => {
            return (1.0..=5000.0).contains(&value) && value.fract() == 0.0;
        }
        _ => return true,
    };
    range.contains(&value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str) -> Number {
        let text = plain(text);
        let mut found = pieces(&text);
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        let Piece::Number(number) = found.remove(0) else {
            panic!("{text}")
        };
        number
    }

    #[test]
    fn what_the_digits_say_about_the_decimal_sign() {
        use Decimal::{Comma, Point};
        for (text, value, evidence) in [
            ("1800", "1800", None),
            ("85,5", "85.5", Some(Comma)),
            ("85.5", "85.5", Some(Point)),
            ("0.350", "0.350", Some(Point)),
            ("0,350", "0.350", Some(Comma)),
            (",350", "0.350", Some(Comma)),
            ("1234,567", "1234.567", Some(Comma)),
            ("1.250,5", "1250.5", Some(Comma)),
            ("1.250,500", "1250.500", Some(Comma)),
            ("1,250.5", "1250.5", Some(Point)),
            ("1.250.000", "1250000", Some(Comma)),
            ("1,250,000", "1250000", Some(Point)),
            ("1 250", "1250", None),
            ("1\u{202f}250,5", "1250.5", Some(Comma)),
            ("1'250", "1250", None),
            ("1’250.5", "1250.5", Some(Point)),
            ("１８００", "1800", None),
            ("1.5e3", "1.5e3", Some(Point)),
            ("007", "007", None),
        ] {
            assert_eq!(
                one(text),
                Number::Sure(value.to_owned(), evidence),
                "{text}"
            );
        }
        for (text, sign, decimal, thousands) in [
            ("1.200", Point, "1.200", "1200"),
            ("1,200", Comma, "1.200", "1200"),
            ("120,000", Comma, "120.000", "120000"),
        ] {
            let (as_decimal, as_thousands) = (decimal.to_owned(), thousands.to_owned());
            assert_eq!(
                one(text),
                Number::Either {
                    sign,
                    as_decimal,
                    as_thousands
                },
                "{text}"
            );
        }
        for text in ["1.2.3", "12.05.2019", "1,25,000", "1.25.000,5", "1,200.5.6"] {
            assert_eq!(one(text), Number::Malformed, "{text}");
        }
    }

    #[test]
    fn numbers_are_found_between_other_text() {
        let text = plain("5′ 2 1/2″");
        let said: Vec<String> = pieces(&text)
            .iter()
            .map(|piece| match piece {
                Piece::Number(Number::Sure(text, _)) => format!("<{text}>"),
                Piece::Other(text) => (*text).to_owned(),
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(said.concat(), "<5>' <2> <1>/<2>\"");
        assert_eq!(pieces("15g 11ms").len(), 4);
        assert_eq!(pieces("2 x 450").len(), 3);
    }
}
