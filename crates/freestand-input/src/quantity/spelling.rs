//! One spelling of the characters of a quantity that have several.

use std::borrow::Cow;

/// The text with one spelling of every character that has several: full-width forms, vulgar
/// fractions, typographic marks of feet and inches, the square symbols of Japanese type.
pub(super) fn plain(text: &str) -> Cow<'_, str> {
    if text.bytes().all(|byte| byte.is_ascii() && byte != b'`') {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 4);
    for c in text.chars() {
        if let Some((_, fraction)) = VULGAR.iter().find(|(vulgar, _)| *vulgar == c) {
            // 52½ is 52 1/2, not 521/2.
            if out.ends_with(|c: char| c.is_ascii_digit()) {
                out.push(' ');
            }
            out.push_str(fraction);
            continue;
        }
        match c {
            '\u{ff01}'..='\u{ff5e}' => out.extend(char::from_u32(c as u32 - 0xfee0)),
            '\u{2044}' | '\u{2215}' => out.push('/'),
            '\u{2019}' | '\u{2018}' | '\u{2032}' | '\u{b4}' | '`' => out.push('\''),
            '\u{201d}' | '\u{201c}' | '\u{201e}' | '\u{2033}' => out.push('"'),
            '㎜' => out.push_str("mm"),
            '㎝' => out.push_str("cm"),
            '㎏' => out.push_str("kg"),
            _ if c.is_whitespace() => out.push(' '),
            _ => out.push(c),
        }
    }
    Cow::Owned(out)
}

const VULGAR: [(char, &str); 15] = [
    ('½', "1/2"),
    ('¼', "1/4"),
    ('¾', "3/4"),
    ('⅓', "1/3"),
    ('⅔', "2/3"),
    ('⅛', "1/8"),
    ('⅜', "3/8"),
    ('⅝', "5/8"),
    ('⅞', "7/8"),
    ('⅕', "1/5"),
    ('⅖', "2/5"),
    ('⅗', "3/5"),
    ('⅘', "4/5"),
    ('⅙', "1/6"),
    ('⅚', "5/6"),
];
