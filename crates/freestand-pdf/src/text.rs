//! Words and numbers for a page.

use freestand_study::assess::result::Ranked;
pub(crate) use freestand_study::words::number;

/// Longest text of an inventory that a page prints, in characters.
const LONGEST: usize = 1500;

/// A word longer than this may be broken, so that it stays in its column.
const LONGEST_WORD: usize = 18;

/// Stands for a character that the embedded fonts do not have.
pub(crate) const UNKNOWN: char = '□';

/// A text as a page can print it: one line, no control characters, nothing that turns the direction of writing, cut where it is
/// longer than a page should hold, with places to break in long words, and a box for what the fonts do not have.
///
/// `is_known` says which characters the fonts have; the second value is whether one was missing.
pub(crate) fn printable(text: &str, is_known: impl Fn(char) -> bool) -> (String, bool) {
    let (mut out, mut word, mut missing) = (String::with_capacity(text.len().min(4 * LONGEST)), 0, false);
    for (count, c) in text.chars().enumerate() {
        if count == LONGEST {
            out.push_str(" …");
            break;
        }
        let c = match c {
            c if c.is_whitespace() || c.is_control() => ' ',
            // Marks that reorder or hide text would let a name pretend to be another one.
            '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{ad}' => {
                continue;
            }
            c if is_known(c) => c,
            _ => {
                missing = true;
                UNKNOWN
            }
        };
        word = if c == ' ' || c == '-' { 0 } else { word + 1 };
        if word > LONGEST_WORD {
            out.push('\u{200b}');
            word = 1;
        }
        out.push(c);
    }
    (out, missing)
}

/// The first characters of a text, for a line that has no room for all.
pub(crate) fn shortened(text: &str, longest: usize) -> String {
    if text.chars().count() <= longest {
        return text.to_owned();
    }
    text.chars().take(longest.saturating_sub(1)).chain(['…']).collect()
}

/// A number and its unit.
pub(crate) fn quantity(value: f64, digits: usize, unit: &str) -> String {
    format!("{} {unit}", number(value, digits))
}

/// The same, a dash where there is none.
pub(crate) fn optional(value: Option<f64>, digits: usize, unit: &str) -> String {
    value.filter(|value| value.is_finite()).map_or_else(|| "–".to_owned(), |value| quantity(value, digits, unit))
}

/// A length in millimetres.
pub(crate) fn millimetres(value_m: f64) -> String {
    quantity(1000.0 * value_m, 4, "mm")
}

/// A stiffness in newtons per millimetre.
pub(crate) fn stiffness(value_n_m: f64) -> String {
    quantity(value_n_m / 1000.0, 4, "N/mm")
}

/// A share in percent: whole, with more digits where it is near 0 or 1, which it must not seem to be.
pub(crate) fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value > 0.0 && value < 10.0 {
        format!("{} %", number(value, 2))
    } else if value > 99.0 && value < 100.0 {
        format!("{} %", number(value, 3))
    } else {
        format!("{value:.0} %")
    }
}

/// A quantile among motions of which some overturn the object.
pub(crate) fn ranked(value: Ranked, factor: f64, digits: usize) -> String {
    match value {
        Ranked::Value(value) => number(factor * value, digits),
        Ranked::Overturned => "overturned".to_owned(),
        Ranked::NoData => "–".to_owned(),
    }
}

/// A text, or a dash where it is empty.
pub(crate) fn or_dash(text: &str) -> String {
    if text.trim().is_empty() { "–".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_but_han(c: char) -> bool {
        !('\u{4e00}'..='\u{9fff}').contains(&c)
    }

    #[test]
    fn a_text_is_one_line_without_marks_that_turn_it() {
        let (text, missing) = printable("a\u{202e}b\nc\u{0}d\u{feff}", all_but_han);
        assert_eq!((text.as_str(), missing), ("ab c d", false));
    }

    #[test]
    fn what_the_fonts_do_not_have_is_a_box_and_is_said() {
        assert_eq!(printable("架 A", all_but_han), ("□ A".to_owned(), true));
    }

    #[test]
    fn long_words_can_be_broken_and_long_texts_end() {
        let (text, _) = printable(&"x".repeat(1_000_000), all_but_han);
        assert_eq!(text.chars().filter(|c| *c == 'x').count(), LONGEST);
        assert!(text.split('\u{200b}').all(|part| part.trim_end_matches(" …").len() <= LONGEST_WORD));
        assert!(text.ends_with(" …"));
    }

    #[test]
    fn shares_near_none_and_all_keep_their_digits() {
        for (share, words) in
            [(0.0, "0 %"), (0.0123, "1.2 %"), (0.1, "10 %"), (0.996, "99.6 %"), (0.57, "57 %"), (1.0, "100 %")]
        {
            assert_eq!(percent(share), words);
        }
    }
}
