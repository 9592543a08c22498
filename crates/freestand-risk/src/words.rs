//! Rates and amounts as people read them.

use freestand_input::words::{number, percent_significant};

/// The verb after a number of things.
pub fn is_or_are(count: usize) -> &'static str {
    if count == 1 { "is" } else { "are" }
}

/// An intensity with four digits, for a message.
pub fn rounded_value(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// The words before a number that is a lower bound.
pub fn least(is_at_least: bool) -> &'static str {
    if is_at_least { "at least " } else { "" }
}

/// A rate in words: how often, its 95 % interval if it has one, and the chance in a number of
/// years.
pub fn rate_words(rate: f64, ci95: Option<(f64, f64)>, probability: f64, years: &str) -> String {
    let interval = |(low, high)| {
        format!(
            "; 95 % interval {} to {} a year",
            number(low, 3),
            number(high, 3)
        )
    };
    format!(
        "{} a year ({}{}), {} in {years} years",
        number(rate, 3),
        once_in(rate).unwrap_or_else(|| "never".to_owned()),
        ci95.map_or(String::new(), interval),
        percent_significant(probability, 3)
    )
}

/// `once in 475 years`; `None` for a rate of 0.
pub fn once_in(rate: f64) -> Option<String> {
    (rate > 0.0).then(|| format!("once in {} years", rounded(1.0 / rate, 3)))
}

/// A number with a few significant digits, also before the decimal point: 10900, not 10932.
pub fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    number(text.parse().unwrap_or(value), digits)
}
