//! Texts that a spreadsheet would take for formulas, in CSV files.
//!
//! A spreadsheet calculates a cell that begins with one of `= + - @`, their full-width forms
//! included, and it skips blanks and control characters before them. A leading `'` makes the cell a
//! text.

use std::borrow::Cow;

/// The text as a field of a CSV: a text that a spreadsheet would take for a formula gets a leading
/// `'`, and so does such a text that has one already, so that [`unguarded`] restores it.
///
/// # Example
/// ```
/// use freestand_input::formula::{guarded, unguarded};
/// assert_eq!(guarded("=1+1"), "'=1+1");
/// assert_eq!(guarded("rack"), "rack");
/// assert_eq!(unguarded("'=1+1"), "=1+1");
/// ```
pub fn guarded(text: &str) -> Cow<'_, str> {
    if is_formula_like(text.trim_start_matches('\'')) {
        format!("'{text}").into()
    } else {
        text.into()
    }
}

/// A field that holds a number or a text: a number is left as it is.
pub fn guarded_text_or_number(text: &str) -> Cow<'_, str> {
    if text.parse::<f64>().is_ok() {
        text.into()
    } else {
        guarded(text)
    }
}

/// The text from which [`guarded`] made this; any other text is unchanged.
pub fn unguarded(text: &str) -> &str {
    match text.strip_prefix('\'') {
        Some(rest) if is_formula_like(rest.trim_start_matches('\'')) => rest,
        _ => text,
    }
}

fn is_formula_like(text: &str) -> bool {
    let is_skipped =
        |c: char| c.is_whitespace() || c.is_control() || matches!(c, '\u{200b}' | '\u{feff}');
    text.trim_start_matches(is_skipped)
        .starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_looks_like_a_formula_is_guarded_and_restored() {
        for (text, in_csv) in [
            ("=1+1", "'=1+1"),
            ("@x", "'@x"),
            ("-", "'-"),
            ("'=1", "''=1"),
            ("\t=1", "'\t=1"),
            ("\r\n+1", "'\r\n+1"),
            (" =cmd|'/c calc'!A1", "' =cmd|'/c calc'!A1"),
            ("＝1", "'＝1"),
            ("＠SUM(1)", "'＠SUM(1)"),
            ("\u{feff}=1", "'\u{feff}=1"),
            ("'quoted'", "'quoted'"),
            ("rack", "rack"),
            ("a=b", "a=b"),
            ("", ""),
            ("'", "'"),
        ] {
            assert_eq!(guarded(text), in_csv);
            assert_eq!(unguarded(in_csv), text);
        }
    }

    #[test]
    fn a_number_is_not_a_formula() {
        assert_eq!(guarded_text_or_number("-1.5e-3"), "-1.5e-3");
        assert_eq!(guarded_text_or_number("-1.5 m"), "'-1.5 m");
        assert_eq!(guarded_text_or_number("+1+1"), "'+1+1");
    }
}
