//! Numbers as Fortran programs print them; strong-motion records have been written this way for
//! fifty years.

use super::units::missing;
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

/// A number found at the start of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Number {
    pub(crate) value: f64,
    /// Its length in bytes.
    pub(crate) length: usize,
    /// The last printed digit counts 10^this, which limits the accuracy of a printed time.
    pub(crate) last_digit_exponent: i32,
    /// A whole number that begins with a zero, `0123`: the digits after a decimal comma.
    pub(crate) zero_padded: bool,
    /// How many characters it has from its point on; 0 without a point.
    pub(crate) tail: usize,
}

/// The number at the start of `text`, if there is one.
///
/// Reads what Fortran's F, E, D and G formats print: `.123`, `5.`, `1.5E-03`, `1.5D-03`, and
/// `1.2345-101`, a three-digit exponent in a field without room for its E. In `.1234-.5678` the
/// second sign begins the next field: a sign begins an exponent only after a mantissa with a point
/// and before exactly three digits without a point.
pub(crate) fn scan(text: &[u8]) -> Option<Number> {
    let is_sign = |at: usize| matches!(text.get(at), Some(b'+' | b'-'));
    let digits = |from: usize| run_of_digits(&text[from.min(text.len())..], 0).0;

    let start = usize::from(is_sign(0));
    let (whole, significand) = run_of_digits(&text[start..], 0);
    let mut end = start + whole;
    let has_point = text.get(end) == Some(&b'.');
    let (fraction, significand) = if has_point {
        run_of_digits(&text[end + 1..], significand)
    } else {
        (0, significand)
    };
    if whole + fraction == 0 {
        return None;
    }
    end += usize::from(has_point) + fraction;
    let mantissa = &text[..end];

    let mut exponent: &[u8] = b"0";
    if matches!(text.get(end), Some(b'e' | b'E' | b'd' | b'D')) {
        let from = end + 1;
        let sign = usize::from(is_sign(from));
        let length = digits(from + sign);
        if length > 0 {
            end = from + sign + length;
            exponent = &text[from..end];
        }
    } else if has_point && is_sign(end) && digits(end + 1) == 3 && text.get(end + 4) != Some(&b'.')
    {
        exponent = &text[end..end + 4];
        end += 4;
    }

    // An exponent beyond i32 makes the value 0 or infinite; the last digit then means nothing.
    let power = power_of(exponent);
    let last_digit_exponent = power.unwrap_or(0).saturating_sub(fraction as i32);
    let short = if power.is_some() && whole + fraction <= 15 {
        exact(significand, last_digit_exponent)
    } else {
        None
    };
    let value = match short {
        Some(size) if text[0] == b'-' => -size,
        Some(size) => size,
        None => format!("{}e{}", str_of(mantissa)?, str_of(exponent)?)
            .parse()
            .ok()?,
    };
    let zero_padded = whole > 1 && text[start] == b'0' && !has_point && end == start + whole;
    let tail = if has_point { end - start - whole } else { 0 };
    Some(Number {
        value,
        length: end,
        last_digit_exponent,
        zero_padded,
        tail,
    })
}

/// The number of an exponent, `-03` or `7`, if i32 holds it.
fn power_of(exponent: &[u8]) -> Option<i32> {
    let is_signed = matches!(exponent.first(), Some(b'+' | b'-'));
    let (length, size) = run_of_digits(&exponent[usize::from(is_signed)..], 0);
    let size = i32::try_from(size).ok().filter(|_| length <= 19)?;
    Some(if exponent.first() == Some(&b'-') {
        -size
    } else {
        size
    })
}

/// How many digits `text` begins with, and `number` continued by them. The number is valid up to 19
/// digits.
fn run_of_digits(text: &[u8], mut number: u64) -> (usize, u64) {
    let mut length = 0;
    while let Some(digit) = text
        .get(length)
        .map(|b| b.wrapping_sub(b'0'))
        .filter(|digit| *digit < 10)
    {
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit));
        length += 1;
    }
    (length, number)
}

/// `significand` × 10^`exponent`. A number of up to 15 digits needs no general algorithm: f64 holds
/// it exactly, powers of ten are exact up to 10^22, and one product or quotient of exact numbers is
/// rounded once, to the nearest (Clinger 1990).
fn exact(significand: u64, exponent: i32) -> Option<f64> {
    const POWERS: [f64; 23] = [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
        1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
    ];
    let power = *POWERS.get(exponent.unsigned_abs() as usize)?;
    Some(if exponent < 0 {
        significand as f64 / power
    } else {
        significand as f64 * power
    })
}

fn str_of(text: &[u8]) -> Option<&str> {
    std::str::from_utf8(text).ok()
}

/// The number that `text` is, from its first byte to its last.
pub(crate) fn number(text: &[u8]) -> Option<Number> {
    scan(text).filter(|number| number.length == text.len())
}

/// The number that a text begins with.
pub(crate) fn leading_value(text: &str) -> Option<f64> {
    scan(text.as_bytes()).map(|number| number.value)
}

/// Why a field is not a number.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum BadField {
    /// NaN, inf, or the asterisks of a Fortran overflow.
    Missing(String),
    /// Anything else.
    NotANumber(String),
}

impl BadField {
    pub(crate) fn new(field: &[u8]) -> Self {
        let text = super::lines::text_of(&field[..field.len().min(64)]);
        if is_missing_word(field) {
            Self::Missing(text)
        } else {
            Self::NotANumber(text)
        }
    }
}

/// The problem that a field is not a number.
pub(crate) fn bad_field(bad: &BadField, line: usize) -> Problem {
    match bad {
        BadField::Missing(text) => missing(text, line),
        BadField::NotANumber(text) => Problem::format(
            format!("\"{}\" is not a number", shorten(text)),
            "the file may be damaged; comment lines must begin with #",
        )
        .at_line(line),
    }
}

/// Words that mark a missing value.
pub(crate) fn is_missing_word(field: &[u8]) -> bool {
    let word = field
        .strip_prefix(b"-")
        .or_else(|| field.strip_prefix(b"+"))
        .unwrap_or(field)
        .to_ascii_lowercase();
    let stars = !word.is_empty() && word.iter().all(|&b| b == b'*');
    stars
        || matches!(
            word.as_slice(),
            b"nan"
                | b"inf"
                | b"infinity"
                | b"na"
                | b"n/a"
                | b"null"
                | b"none"
                | b"1.#inf"
                | b"1.#qnan"
        )
}

/// Values that agencies write for a missing value: -999, -9999, -32768, 1.7E38 and similar.
pub(crate) fn is_missing_value(value: f64) -> bool {
    value == -999.0
        || value == -9999.0
        || value == -32768.0
        || value.abs() >= 1e30
        || value.is_nan()
}

/// As [`is_missing_value`], and numbers of nothing but nines, 9999.99 or 99999, with which data loggers and spreadsheets
/// fill a gap. Four nines at least: a motion may well reach 999 in mm/s².
pub(crate) fn is_gap_mark(value: f64) -> bool {
    let is_nines = |decimals: i32| {
        let digits = value.abs() * 10f64.powi(decimals);
        let whole = digits.round();
        // A printed decimal differs from its digits by rounding alone.
        (digits - whole).abs() < 1e-6 && whole >= 9999.0 && (whole + 1.0).log10().fract() == 0.0
    };
    is_missing_value(value) || value.abs() >= 999.0 && value.abs() < 1e9 && (0..=4).any(is_nines)
}

/// The numbers of a line of fields separated by blanks, or by a sign where a blank had no room.
pub(crate) fn fields(line: &[u8], mut each: impl FnMut(Number)) -> Result<(), BadField> {
    let mut rest = line.trim_ascii();
    while !rest.is_empty() {
        let ends = |number: &Number| {
            matches!(
                rest.get(number.length),
                None | Some(b'+' | b'-' | b' ' | b'\t' | 0x0B | 0x0C)
            )
        };
        let Some(number) = scan(rest).filter(ends) else {
            return Err(BadField::new(words(rest).next().unwrap_or(rest)));
        };
        each(number);
        rest = rest[number.length..].trim_ascii_start();
    }
    Ok(())
}

/// What stands between blanks.
pub(crate) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn values(line: &str) -> Result<Vec<f64>, BadField> {
        let mut out = Vec::new();
        fields(line.as_bytes(), |number| out.push(number.value)).map(|()| out)
    }

    /// Exact: each value is the nearest f64 to the decimal number.
    #[test]
    fn fortran_fields() {
        for (line, expected) in [
            ("1 2.5 -3", &[1.0, 2.5, -3.0][..]),
            ("   .3654112E-03  -.5", &[0.3654112e-3, -0.5]),
            (".1234E-02-.5678E-03", &[0.1234e-2, -0.5678e-3]),
            ("-.1-.2+.3", &[-0.1, -0.2, 0.3]),
            ("0.1234-0.5678", &[0.1234, -0.5678]),
            ("1.5D-03 1.5d+2 1d0", &[1.5e-3, 150.0, 1.0]),
            ("1.2345-101", &[1.2345e-101]),
            ("1.2345-101-1.5+100", &[1.2345e-101, -1.5e100]),
            ("1.2345-101.5", &[1.2345, -101.5]),
            ("5. +.5", &[5.0, 0.5]),
            ("123-101", &[123.0, -101.0]),
            ("1.5E-1-6.7E-2", &[0.15, -0.067]),
            ("\t1\t\t2 ", &[1.0, 2.0]),
            ("", &[]),
        ] {
            assert_eq!(values(line).as_deref(), Ok(expected), "{line}");
        }
    }

    #[test]
    fn what_is_no_number() {
        for (line, field) in [
            ("1 abc 2", "abc"),
            ("1.2.3", "1.2.3"),
            ("1 .", "."),
            ("0x10", "0x10"),
            ("1,2", "1,2"),
            ("--1", "--1"),
            ("1e", "1e"),
        ] {
            assert_eq!(
                values(line),
                Err(BadField::NotANumber(field.to_owned())),
                "{line}"
            );
        }
        for line in ["NaN", "-inf", "*****", "+Infinity", "null"] {
            assert_eq!(values(line), Err(BadField::Missing(line.to_owned())));
        }
    }

    #[test]
    fn the_last_printed_digit() {
        for (text, exponent) in [
            ("0.0100", -4),
            ("5", 0),
            ("5.", 0),
            ("1.50E-02", -4),
            ("1.5D+03", 2),
            ("1.25-101", -103),
        ] {
            assert_eq!(
                number(text.as_bytes()).unwrap().last_digit_exponent,
                exponent,
                "{text}"
            );
        }
        assert_eq!(number(b"1.5 "), None);
    }

    proptest! {
        /// Short and long numbers alike are the nearest f64, as the standard library has it.
        #[test]
        fn every_number_is_the_nearest(text in "[+-]?([0-9]{1,18}\\.?[0-9]{0,12}|\\.[0-9]{1,20})([eE][+-]?[0-9]{1,3})?") {
            let expected: f64 = text.parse().unwrap();
            let found = number(text.as_bytes()).map(|number| number.value.to_bits());
            prop_assert_eq!(found, Some(expected.to_bits()));
        }
    }

    #[test]
    fn missing_values() {
        for value in [
            -999.0,
            -9999.0,
            -32768.0,
            1.7e38,
            -1.7e38,
            f64::NAN,
            f64::INFINITY,
        ] {
            assert!(is_missing_value(value));
        }
        for value in [0.0, 999.0, -998.9, -999.5, 32768.0] {
            assert!(!is_missing_value(value));
        }
    }
}
