//! Numbers and texts as people read them.

use std::fmt::Write;

use unicode_normalization::UnicodeNormalization as _;

/// A number with `digits` significant digits: `300.0`, `1.500`, `1.50e-5`; with an exponent only if
/// the plain form would be long; `–` if it is not finite.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    // The exponent is taken after rounding: 9.9996 with four digits is 10.00.
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent = scientific
        .split_once('e')
        .and_then(|(_, power)| power.parse::<i32>().ok())
        .unwrap_or(0);
    if (-4..9).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        format!("{value:.decimals$}")
    } else {
        scientific
    }
}

/// A number as [`significant`], without trailing zeros: `300`, `1.5`, `0.196`.
pub fn number(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (mantissa, power) = text
        .split_once('e')
        .map_or((text.as_str(), None), |(m, p)| (m, Some(p)));
    let mantissa = if mantissa.contains('.') {
        mantissa.trim_end_matches('0').trim_end_matches('.')
    } else {
        mantissa
    };
    power.map_or_else(
        || mantissa.to_owned(),
        |power| format!("{mantissa}e{power}"),
    )
}

/// A number with a fixed number of decimals; `–` if it is not finite.
pub fn fixed(value: f64, decimals: usize) -> String {
    if value.is_finite() {
        format!("{value:.decimals$}")
    } else {
        "–".to_owned()
    }
}

/// A share in percent.
pub fn percent(share: f64, decimals: usize) -> String {
    format!("{} %", fixed(100.0 * share, decimals))
}

/// A share in percent with `digits` significant digits.
pub fn percent_significant(share: f64, digits: usize) -> String {
    format!("{} %", number(100.0 * share, digits))
}

/// A probability in percent, to two digits; below 0.01 % its digits mean nothing.
pub fn percent_words(share: f64) -> String {
    if share > 0.0 && share < 1e-4 {
        "under 0.01 %".to_owned()
    } else {
        percent_significant(share, 2)
    }
}

/// A count with its noun in singular or plural: `1 motion`, `20 motions`, `3 entries`.
pub fn counted(count: usize, noun: &str) -> String {
    match noun
        .strip_suffix('y')
        .filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u']))
    {
        _ if count == 1 => format!("{count} {noun}"),
        Some(stem) => format!("{count} {stem}ies"),
        None => format!("{count} {noun}s"),
    }
}

/// `level`, `level and height`, `level, height and thickness`.
pub fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The first `most` of several names: `a, b and 42 more`.
pub fn some(names: &[impl AsRef<str>], most: usize) -> String {
    let listed: Vec<&str> = names.iter().take(most).map(AsRef::as_ref).collect();
    let more = names.len() - listed.len();
    listed.join(", ")
        + &if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        }
}

/// A number for CSV: the shortest text that reads back as `value`.
pub fn shortest(value: f64) -> String {
    let mut text = String::new();
    push_shortest(&mut text, value);
    text
}

/// Appends the shortest text that reads back as `value`, without an exponent if that is short.
/// (Writing to a `String` cannot fail.)
pub fn push_shortest(out: &mut String, value: f64) {
    let size = value.abs();
    let _ = if size == 0.0 || (1e-5..1e16).contains(&size) {
        write!(out, "{value}")
    } else {
        write!(out, "{value:e}")
    };
}

/// Values with their names in inputs and outputs, and their meanings.
pub type Choices<T> = &'static [(T, &'static str, &'static str)];

/// The name of one of these values.
pub fn name_of<T: PartialEq>(choices: Choices<T>, value: T) -> &'static str {
    choices
        .iter()
        .find(|choice| choice.0 == value)
        .map_or("", |choice| choice.1)
}

/// The form in which words are compared: letters and digits in lower case, without accents and other
/// variants of a letter (Unicode's compatibility decomposition), with one blank for everything else
/// between them.
///
/// # Example
/// ```
/// use freestand_input::words::canonical;
/// assert_eq!(canonical("  Höhe, (mm)"), "hohe mm");
/// assert_eq!(canonical("N° d’inventaire"), "n d inventaire");
/// assert_eq!(canonical("ＩＤ番号"), "id番号");
/// ```
pub fn canonical(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    if text.is_ascii() {
        push_words(&mut out, text.chars());
    } else {
        // What is not an accent of the Latin script belongs to its letter (が) and is put back.
        let is_accent = |c: &char| ('\u{300}'..='\u{36f}').contains(c);
        push_words(
            &mut out,
            text.nfkd()
                .filter(|c| !is_accent(c))
                .nfc()
                .flat_map(char::to_lowercase),
        );
    }
    out.truncate(out.trim_end().len());
    out
}

fn push_words(out: &mut String, letters: impl Iterator<Item = char>) {
    for c in letters {
        match c {
            'ß' => out.push_str("ss"),
            'œ' => out.push_str("oe"),
            'æ' => out.push_str("ae"),
            c if c.is_alphanumeric() => out.push(c.to_ascii_lowercase()),
            _ if !out.is_empty() && !out.ends_with(' ') => out.push(' '),
            _ => {}
        }
    }
}

/// The candidate that the user most likely meant by a mistyped word: at most a third of the letters
/// differ.
pub fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase();
    let (distance, best) = candidates
        .iter()
        .map(|candidate| {
            (
                strsim::levenshtein(&word, &candidate.to_lowercase()),
                *candidate,
            )
        })
        .min_by_key(|&(distance, _)| distance)?;
    (3 * distance <= word.chars().count().max(best.chars().count())).then_some(best)
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
        assert_eq!(
            (significant(9.99996, 4), significant(0.0999999, 3)),
            ("10.00".to_owned(), "0.100".to_owned())
        );
        assert_eq!(
            (significant(2.7835e-5, 4), significant(4.38e6, 3)),
            ("2.784e-5".to_owned(), "4380000".to_owned())
        );
    }

    #[test]
    fn nouns_follow_their_count() {
        let found = [(1, "entry"), (2, "entry"), (0, "motion"), (30, "storey")]
            .map(|(n, noun)| counted(n, noun));
        assert_eq!(found, ["1 entry", "2 entries", "0 motions", "30 storeys"]);
    }

    #[test]
    fn nearest_words() {
        assert_eq!(
            nearest("storey_hight", &["storeys", "storey_height"]),
            Some("storey_height")
        );
        assert_eq!(nearest("banana", &["storeys", "storey_height"]), None);
        assert_eq!(nearest("x", &[]), None);
    }
}
