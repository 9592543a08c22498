//! Numbers and texts as people read them.

/// A number with `digits` significant digits: `300.0`, `1.500`, `1.50e-5`; an exponent only where the plain form would be
/// long, `–` where it is not finite.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    // The exponent after rounding: 9.9996 with four digits is 10.00.
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent = scientific.split_once('e').and_then(|(_, power)| power.parse::<i32>().ok()).unwrap_or(0);
    if (-4..9).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        format!("{value:.decimals$}")
    } else {
        scientific
    }
}

/// The same without trailing zeros: `300`, `1.5`, `0.196`.
pub fn number(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (mantissa, power) = text.split_once('e').map_or((text.as_str(), None), |(m, p)| (m, Some(p)));
    let mantissa = if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    power.map_or_else(|| mantissa.to_owned(), |power| format!("{mantissa}e{power}"))
}

/// A number with a fixed count of decimals; `–` where it is not finite.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    if value.is_finite() { format!("{value:.decimals$}") } else { "–".to_owned() }
}

/// A share in percent.
pub(crate) fn percent(share: f64, decimals: usize) -> String {
    format!("{} %", fixed(100.0 * share, decimals))
}

/// Text for HTML: between tags and in quoted attributes. Characters that no document may hold are left out.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            '\n' | '\t' => escaped.push(c),
            '\u{fffe}' | '\u{ffff}' => {}
            c if c.is_control() => {}
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, digits, expected) in [
            (300.0, 4, "300"),
            (1.5, 4, "1.5"),
            (0.19654, 3, "0.197"),
            (4380.0, 6, "4380"),
            (12345.0, 3, "12345"),
            (0.0, 3, "0"),
            (-0.083, 2, "-0.083"),
            (1e-7, 2, "1e-7"),
            (9.99996, 4, "10"),
            (f64::NAN, 3, "–"),
        ] {
            assert_eq!(number(value, digits), expected);
        }
    }

    #[test]
    fn rounding_up_a_decade_adds_no_digit() {
        assert_eq!((significant(9.99996, 4), significant(0.0999999, 3)), ("10.00".to_owned(), "0.100".to_owned()));
        assert_eq!((significant(2.7835e-5, 4), significant(4.38e6, 3)), ("2.784e-5".to_owned(), "4380000".to_owned()));
    }

    #[test]
    fn markup_is_escaped() {
        assert_eq!(escape("<a href='x'>&\u{0}\"</a>"), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;&lt;/a&gt;");
    }
}
