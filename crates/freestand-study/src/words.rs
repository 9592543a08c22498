//! Numbers and texts as people read them.

/// A number with at most `digits` significant digits and no trailing zeros: `300`, `1.5`, `0.196`; `–` where it is not
/// finite.
pub(crate) fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor();
    if !(-4.0..9.0).contains(&exponent) {
        return format!("{value:.*e}", digits.saturating_sub(1));
    }
    let decimals = (digits as f64 - 1.0 - exponent).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
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
            (1e-7, 2, "1.0e-7"),
            (f64::NAN, 3, "–"),
        ] {
            assert_eq!(number(value, digits), expected);
        }
    }

    #[test]
    fn markup_is_escaped() {
        assert_eq!(escape("<a href='x'>&\u{0}\"</a>"), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;&lt;/a&gt;");
    }
}
