//! Numbers as they are written: digits, fractions, feet and inches, kept exact until their unit is
//! known.

use std::borrow::Cow;

use super::units::Unit;
use super::{shorten, value_problem};
use crate::problem::Problem;

/// A number as it was written: `±digits · 10^exponent / denominator`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Number {
    is_negative: bool,
    /// At least one digit, no sign and no point.
    digits: String,
    exponent: i32,
    denominator: u32,
    /// Whether it was written with digits alone: no sign, point, exponent or fraction.
    is_whole: bool,
    /// Whether it was written with an exponent.
    has_exponent: bool,
}

impl Number {
    /// The value in a unit, in SI; `None` if it is not finite.
    ///
    /// # Accuracy
    /// See [`Unit`]. Where digits and unit have more than 38 digits together, one rounding more.
    pub(super) fn in_unit(&self, unit: Option<&Unit>) -> Option<f64> {
        let (shift, whole, divisor, factor) = unit.map_or((0, 1, 1, 1.0), |unit| {
            (unit.decimal_exponent, unit.whole, unit.divisor, unit.factor)
        });
        let exponent = self.exponent.saturating_add(shift);
        let sign = if self.is_negative { "-" } else { "" };
        let decimal = |digits: &str| format!("{sign}{digits}e{exponent}").parse::<f64>().ok();
        let exact = self
            .digits
            .parse::<u128>()
            .ok()
            .and_then(|digits| digits.checked_mul(u128::from(whole)));
        let scaled = match exact {
            Some(product) => decimal(&product.to_string())?,
            None => decimal(&self.digits)? * whole as f64,
        };
        let value = scaled / f64::from(self.denominator) / f64::from(divisor) * factor;
        value.is_finite().then_some(value)
    }
}

/// A number, and the text of its unit.
#[derive(Debug)]
pub(super) struct Split<'a> {
    pub(super) number: Number,
    /// Empty if there is none; `in` after feet and inches.
    pub(super) unit: Cow<'a, str>,
}

/// Splits `text`, which has been through [`plain`](super::spelling::plain); messages show `written`,
/// the text of the user.
pub(super) fn split<'a>(text: &'a str, written: &str) -> Result<Split<'a>, Problem> {
    let (number, rest) = leading_number(text, written)?;
    if let Some(inches) = after_feet(rest) {
        return Ok(Split {
            number: feet_and_inches(&number, inches, written)?,
            unit: Cow::Borrowed("in"),
        });
    }
    let unit = rest.trim();
    match unit.chars().next() {
        Some(',') => Err(value_problem(format!(
            "\"{}\" has a comma in the number",
            shorten(written)
        ))
        .hint("write the decimal sign as a point: \"2.3 m\"")),
        Some(c) if c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | '_') => Err(value_problem(
            format!("\"{}\" is more than one number", shorten(written)),
        )
        .hint("write the digits without separators and the unit once, such as \"2300 mm\"")),
        _ => Ok(Split {
            number,
            unit: Cow::Borrowed(unit),
        }),
    }
}

/// The number at the start of a text, with the text that follows it.
fn leading_number<'a>(text: &'a str, written: &str) -> Result<(Number, &'a str), Problem> {
    let (is_negative, unsigned) = match text.strip_prefix(['-', '\u{2212}']) {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let has_sign = unsigned.len() < text.len();
    let (whole, rest) = leading_digits(unsigned);
    if !whole.is_empty()
        && let Some((fraction, rest)) = fraction(whole, rest)
    {
        let (digits, denominator) = fraction.value(written)?;
        let number = Number {
            is_negative,
            digits,
            exponent: 0,
            denominator,
            is_whole: false,
            has_exponent: false,
        };
        return Ok((number, rest));
    }
    let (decimals, rest) = match rest.strip_prefix('.') {
        Some(after) => leading_digits(after),
        None => ("", rest),
    };
    if whole.is_empty() && decimals.is_empty() {
        return Err(not_a_number(written));
    }
    let has_point = unsigned[whole.len()..].starts_with('.');
    // An e that no digits follow is the beginning of a (wrong) unit.
    let stated = rest.strip_prefix(['e', 'E']).and_then(exponent_after);
    let (exponent, rest) = stated.map_or((0, rest), |(exponent, rest)| (exponent, rest));
    let shift = i32::try_from(decimals.len()).unwrap_or(i32::MAX / 2);
    let number = Number {
        is_negative,
        digits: format!("{whole}{decimals}"),
        exponent: exponent.saturating_sub(shift),
        denominator: 1,
        is_whole: !has_sign && !has_point && stated.is_none(),
        has_exponent: stated.is_some(),
    };
    Ok((number, rest))
}

fn not_a_number(written: &str) -> Problem {
    if written.is_empty() {
        value_problem("a quantity is missing")
    } else {
        value_problem(format!("\"{}\" is not a quantity", shorten(written)))
    }
    .hint("write a number and its unit, such as \"2.3 m\"")
}

fn leading_digits(text: &str) -> (&str, &str) {
    text.split_at(text.bytes().take_while(u8::is_ascii_digit).count())
}

/// The exponent after an `e`, if there is one.
fn exponent_after(text: &str) -> Option<(i32, &str)> {
    let sign = usize::from(text.starts_with(['+', '-']));
    let (digits, rest) = leading_digits(&text[sign..]);
    if digits.is_empty() {
        return None;
    }
    // Beyond i32 the value is 0 or infinite anyway; saturate and let the conversion say which.
    let saturated = if text.starts_with('-') {
        i32::MIN / 2
    } else {
        i32::MAX / 2
    };
    Some((
        text[..sign + digits.len()].parse().unwrap_or(saturated),
        rest,
    ))
}

/// `1/2`, or `11 1/2` and `11-1/2` with their whole number.
struct Fraction<'a> {
    whole: &'a str,
    over: &'a str,
    under: &'a str,
}

/// The fraction that begins with the digits `first`, followed by `rest`.
fn fraction<'a>(first: &'a str, rest: &'a str) -> Option<(Fraction<'a>, &'a str)> {
    if let Some(after) = rest.strip_prefix('/') {
        let (under, rest) = leading_digits(after);
        return (!under.is_empty()).then_some((
            Fraction {
                whole: "0",
                over: first,
                under,
            },
            rest,
        ));
    }
    let next = match rest.strip_prefix('-') {
        Some(next) => next,
        None if rest.starts_with(' ') => rest.trim_start(),
        None => return None,
    };
    let (over, rest) = leading_digits(next);
    let (under, rest) = leading_digits(rest.strip_prefix('/')?);
    (!over.is_empty() && !under.is_empty()).then_some((
        Fraction {
            whole: first,
            over,
            under,
        },
        rest,
    ))
}

impl Fraction<'_> {
    /// Numerator and denominator of the whole.
    fn value(&self, written: &str) -> Result<(String, u32), Problem> {
        let refused = |what: &str| {
            value_problem(format!("\"{}\" {what}", shorten(written)))
                .hint("write a fraction such as \"1/2 in\" or \"11 1/2 in\"")
        };
        let (Ok(whole), Ok(over), Ok(under)) = (
            self.whole.parse::<u32>(),
            self.over.parse::<u16>(),
            self.under.parse::<u16>(),
        ) else {
            return Err(refused("is not a fraction that can be read"));
        };
        if under == 0 {
            return Err(refused("is a division by 0"));
        }
        // 5 3/2 and 10 000/3 are slips: nobody writes a mixed number so.
        let is_mixed = self.whole != "0";
        if is_mixed && (over >= under || self.over.len() > 1 && self.over.starts_with('0')) {
            return Err(refused(
                "is not a mixed number: its fraction must be below 1",
            ));
        }
        let numerator = u64::from(whole) * u64::from(under) + u64::from(over);
        Ok((numerator.to_string(), u32::from(under)))
    }
}

/// What follows a word or mark of feet, if it is a number: the inches.
fn after_feet(rest: &str) -> Option<&str> {
    let rest = rest.trim_start();
    let is_word = |word: &&str| {
        rest.get(..word.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(word))
    };
    let word = ["feet", "foot", "ft.", "ft", "'"]
        .into_iter()
        .find(is_word)?;
    let after = rest[word.len()..].trim_start();
    let after = after
        .strip_prefix(['-', '\u{2013}'])
        .map_or(after, str::trim_start);
    after
        .starts_with(|c: char| c.is_ascii_digit() || c == '.')
        .then_some(after)
}

fn feet_and_inches(feet: &Number, inches: &str, written: &str) -> Result<Number, Problem> {
    let shown = shorten(written);
    let refused = |what: &str, hint: &str| Err(Problem::value(format!("\"{shown}\" {what}"), hint));
    let example = "write 6'2\", 6 ft 2 in or 6' 2 1/2\"";
    let (part, unit) = leading_number(inches, written)?;
    match super::units::lookup(unit) {
        Some(unit) if unit.symbol == "in" => {}
        None if unit.trim().is_empty() => {
            let hint = "write 6'2\" or 6 ft 2 in; if the mark separates thousands, write the digits without it";
            return refused("has a number after the feet without a mark of inches", hint);
        }
        _ => return refused("has something other than inches after the feet", example),
    }
    if !feet.is_whole {
        let hint = "write whole feet without a sign and then the inches, such as 6'2\", or one unit, such as \"-74 in\"";
        return refused(
            "has a sign, a fraction or an exponent before the feet",
            hint,
        );
    }
    if part.has_exponent {
        return refused("has an exponent in the inches", example);
    }
    if part.in_unit(None).is_none_or(|inches| inches >= 12.0) {
        return refused(
            "has 12 inches or more after the feet",
            "write the rest as feet, such as 7'2\", or one unit",
        );
    }
    sum(feet, &part).map_or_else(|| refused("is too large for a number", example), Ok)
}

/// Feet and inches, in inches: `12 feet + inches`, exactly.
fn sum(feet: &Number, inches: &Number) -> Option<Number> {
    let decimals = 10u128.checked_pow(inches.exponent.unsigned_abs())?;
    let feet = feet.digits.parse::<u128>().ok()?.checked_mul(12)?;
    let feet = feet
        .checked_mul(decimals)?
        .checked_mul(u128::from(inches.denominator))?;
    let total = feet.checked_add(inches.digits.parse().ok()?)?;
    Some(Number {
        digits: total.to_string(),
        ..inches.clone()
    })
}
