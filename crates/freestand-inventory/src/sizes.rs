//! The sizes of an object in one cell.

use freestand_input::quantity::Dimension;
use freestand_input::words::canonical;

use super::cells::{Choice, Wanted, Wrong, bracket_behind, stated_unit};
use super::columns::Column;
use super::headings::order_of;
use super::problems::Kind;
use super::units::{CellUnit, find};
use super::vocabulary::{is_missing, without_approximation};

/// The three sizes of a cell \[m\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Sizes {
    pub height: Option<f64>,
    pub width: Option<f64>,
    pub thickness: Option<f64>,
    /// No letters and no heading said which is which.
    pub is_order_guessed: bool,
    /// A side is called a diameter.
    pub is_round: bool,
    pub is_approximate: bool,
    pub is_bare: bool,
}

impl Sizes {
    /// The sizes that are known, with a column of such sizes: both sides are as a width is.
    pub(super) fn sides(&self) -> impl Iterator<Item = (Column, f64)> {
        let all = [
            (Column::Height, self.height),
            (Column::Width, self.width),
            (Column::Width, self.thickness),
        ];
        all.into_iter()
            .filter_map(|(column, size)| Some((column, size?)))
    }
}

/// One size, with the letter that names it.
#[derive(Clone, Copy)]
struct Side<'t> {
    text: &'t str,
    letter: Option<char>,
}

/// `1800 x 600 x 450 mm`, `H1800 × W600 × D450`, `H 1800, W 600, D 450`, `6'2" x 2'6" x 18"`,
/// `Ø230 x 1500`; `H ? x W 600 x D 450` has no height.
///
/// # Errors
/// Anything but two or three lengths.
pub(super) fn sizes(
    text: &str,
    unit: Option<CellUnit>,
    order: Option<&[char]>,
    choice: Choice,
) -> Result<Sizes, Wrong> {
    let (text, is_approximate) = without_approximation(text);
    let lower = text
        .to_lowercase()
        .replace(" by ", "x")
        .replace(['×', '✕', 'х', '*'], "x");
    // A bracket behind may say the order: 60x40x180 (LxWxH).
    let (lower, in_cell) = bracket_behind(&lower)
        .and_then(|(outer, inner)| Some((outer.trim(), Some(order_of(inner)?))))
        .unwrap_or((&lower, None));
    let mut sides = cut(lower).ok_or(Kind::Unreadable)?;
    let stated: Vec<Option<CellUnit>> = sides
        .iter()
        .map(|side| stated_unit(side.text, Dimension::Length))
        .collect();
    // The last unit holds for all that have none.
    let wanted = Wanted {
        dimension: Dimension::Length,
        unit: stated.last().copied().flatten().or(unit),
        choice,
    };
    // A size that is named but not known: the others hold.
    let is_known = |side: &Side<'_>| side.letter.is_none() || !is_missing(side.text);
    if sides.iter().any(is_known) {
        sides.retain(is_known);
    }
    let values: Vec<(Option<char>, f64)> = sides
        .iter()
        .map(|side| Ok((side.letter, wanted.one(side.text)?.si)))
        .collect::<Result<_, Wrong>>()?;
    let found = by_letters(values, in_cell.as_deref().or(order)).ok_or(Kind::Unreadable)?;
    Ok(Sizes {
        is_approximate,
        is_bare: stated.iter().all(Option::is_none),
        ..found
    })
}

/// The two or three parts of a text.
fn cut(text: &str) -> Option<Vec<Side<'_>>> {
    let parts: Vec<&str> = if text.contains('x') {
        text.split('x').collect()
    } else if let Some(parts) = lettered(text) {
        parts
    } else {
        Some(text.split('/').collect()).filter(|parts: &Vec<_>| parts.len() == 3)?
    };
    (2..=3)
        .contains(&parts.len())
        .then(|| parts.into_iter().map(|part| side(part.trim())).collect())
}

/// Which value is which: by their letters, or by the order of the heading where none has a letter.
fn by_letters(mut values: Vec<(Option<char>, f64)>, order: Option<&[char]>) -> Option<Sizes> {
    if let [(Some('O'), round), (_, height)] | [(_, height), (Some('O'), round)] = values.as_slice()
    {
        return Some(Sizes {
            height: Some(*height),
            width: Some(*round),
            thickness: Some(*round),
            is_round: true,
            ..Sizes::default()
        });
    }
    let named = |values: &[(Option<char>, f64)]| {
        values.iter().filter(|(letter, _)| letter.is_some()).count()
    };
    if let Some(order) = order.filter(|order| order.len() == values.len())
        && named(&values) == 0
    {
        for ((slot, _), letter) in values.iter_mut().zip(order) {
            *slot = Some(*letter);
        }
    }
    match named(&values) {
        0 => by_size(values.iter().map(|(_, value)| *value).collect()),
        count if count == values.len() => named_sides(&values),
        _ => None,
    }
}

fn named_sides(values: &[(Option<char>, f64)]) -> Option<Sizes> {
    let value = |wanted: char| {
        let found = values.iter().find(|(letter, _)| *letter == Some(wanted));
        found.map(|(_, value)| *value)
    };
    let [height, width, length, depth] = ['H', 'W', 'L', 'D'].map(value);
    let (width, thickness) = match (length, width, depth) {
        (Some(_), Some(_), Some(_)) => return None,
        (Some(_), Some(_), None) => (length, width),
        _ => (length.or(width), depth),
    };
    let found = Sizes {
        height,
        width,
        thickness,
        ..Sizes::default()
    };
    let count = [height, width, thickness].iter().flatten().count();
    (count == values.len()).then_some(found)
}

/// The largest of three is the height.
fn by_size(mut values: Vec<f64>) -> Option<Sizes> {
    values.sort_by(f64::total_cmp);
    let (short, long, height) = match values.as_slice() {
        [short, long, height] => (short, long, Some(*height)),
        [short, long] => (short, long, None),
        _ => return None,
    };
    Some(Sizes {
        height,
        width: Some(*long),
        thickness: Some(*short),
        is_order_guessed: height.is_some(),
        ..Sizes::default()
    })
}

/// `H 1800, W 600 mm D 450` or `1800h 600w 450d`, cut into its sizes; `None` where not each of them has
/// its letter.
fn lettered(text: &str) -> Option<Vec<&str>> {
    let is_gap = |c: char| c.is_whitespace() || matches!(c, ',' | ';');
    let starts_with_digit = |word: &str| word.starts_with(|c: char| c.is_ascii_digit() || c == '?');
    let words: Vec<&str> = text.split(is_gap).filter(|word| !word.is_empty()).collect();
    let mut starts: Vec<usize> = Vec::new();
    let mut from = 0;
    for (place, word) in words.iter().enumerate() {
        let at = from + text.get(from..)?.find(word)?;
        from = at + word.len();
        let digits = word
            .find(|c: char| c.is_ascii_digit() || c == '?')
            .unwrap_or(word.len());
        let (before, rest) = word.split_at(digits);
        let names_next = rest.is_empty()
            && words
                .get(place + 1)
                .is_some_and(|next| starts_with_digit(next));
        let is_named = axis(before.trim_end_matches([':', '=', '.'])).is_some()
            && (!rest.is_empty() || names_next);
        if is_named || starts_with_digit(word) && side(word).letter.is_some() {
            starts.push(at);
        }
    }
    let ends = starts.iter().skip(1).copied().chain([text.len()]);
    let parts = starts
        .iter()
        .zip(ends)
        .map(|(&start, end)| Some(text.get(start..end)?.trim_end_matches(is_gap)));
    (starts.first() == Some(&0) && starts.len() > 1).then(|| parts.collect())?
}

/// The letter of a word that names a size; O: a diameter.
fn axis(word: &str) -> Option<char> {
    let word = word.trim_matches(|c: char| !c.is_alphabetic() && !matches!(c, '⌀' | 'ø'));
    if matches!(word, "ø" | "⌀" | "dia" | "diam") {
        return Some('O');
    }
    Some(match canonical(word).as_str() {
        "h" | "a" | "ht" | "high" | "tall" | "hoch" | "height" | "alto" | "hauteur" | "haut" => 'H',
        "w" | "b" | "wide" | "breit" | "width" | "ancho" | "largeur" | "larg" => 'W',
        "l" | "long" | "lang" | "length" | "longueur" | "largo" => 'L',
        "d" | "t" | "p" | "f" | "deep" | "tief" | "depth" | "fondo" | "profondeur" | "prof" => 'D',
        _ => return None,
    })
}

/// A size without the letter before or after it.
fn side(text: &str) -> Side<'_> {
    let number = text.find(|c: char| c.is_ascii_digit() || matches!(c, '.' | '?'));
    let start = number
        .or_else(|| text.find(char::is_whitespace))
        .unwrap_or(0);
    let (before, rest) = text.split_at(start);
    let letter = axis(before.trim().trim_end_matches([':', '=', '.']));
    if letter.is_some() {
        let text = rest.trim();
        return Side { text, letter };
    }
    // 1800h, 1800 mm h, 72"h, 1800 mm (h), but not the m of 1.8 m.
    let bare = rest.trim_end_matches([')', ' ']);
    let without_word = bare.trim_end_matches(|c: char| c.is_alphabetic() || c == '⌀');
    let (rest, word) = bare.split_at(without_word.len());
    match axis(word).filter(|_| find(word, Dimension::Length).is_err()) {
        None => Side { text, letter: None },
        letter => Side {
            text: rest.trim().trim_end_matches('(').trim(),
            letter,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::{Decimal, plain};

    #[test]
    fn sizes_in_one_cell() {
        let mm = find("mm", Dimension::Length).ok();
        let read = |text: &str, order: Option<&[char]>| {
            let found = sizes(&plain(text), mm, order, Choice::Sign(Decimal::Point)).unwrap();
            let mm = |size: Option<f64>| size.map(|size| (size * 1e3).round());
            (
                mm(found.height),
                mm(found.width),
                mm(found.thickness),
                found.is_order_guessed,
            )
        };
        let plain_order = (Some(1800.0), Some(600.0), Some(450.0), false);
        for text in [
            "H1800 x W600 x D450",
            "1800H x 600W x 450D",
            "B600 × T450 × H1800",
            "180 cm (H) x 60 cm (W) x 45 cm (D)",
            "h: 1800, w: 600, d: 450".replace(", ", " x ").as_str(),
            "600x450x1800 (WxDxH)",
            "L 600 x B 450 x H 1800",
            "H1800 W600 D450",
            "H 1800, W 600, D 450",
            "H: 180 cm; W: 60 cm; D: 45 cm",
            "1800h 600w 450d",
        ] {
            assert_eq!(read(text, None), plain_order, "{text}");
        }
        assert_eq!(
            read("1800 x 600 x 450", Some(&['H', 'W', 'D'])),
            plain_order
        );
        assert_eq!(
            read("450 x 1800 x 600", None),
            (Some(1800.0), Some(600.0), Some(450.0), true)
        );
        assert_eq!(
            read("180 x 60 x 45 cm", None),
            (Some(1800.0), Some(600.0), Some(450.0), true)
        );
        assert_eq!(
            read("6'0\" x 2'0\" x 18\"", None),
            (Some(1829.0), Some(610.0), Some(457.0), true)
        );
        assert_eq!(
            read("Ø230 x 1500", None),
            (Some(1500.0), Some(230.0), Some(230.0), false)
        );
        assert_eq!(
            read("600 x 450", None),
            (None, Some(600.0), Some(450.0), false)
        );
        for text in ["H ? x W 600 x D 450", "W 600 D 450", "H tbc x W600 x D450"] {
            assert_eq!(
                read(text, None),
                (None, Some(600.0), Some(450.0), false),
                "{text}"
            );
        }
        for text in [
            "1800",
            "1 x 2 x 3 x 4",
            "H1800 x 600 x 450",
            "large",
            "H ? x W ?",
            "1800 600 450",
            "H1800 600 450",
        ] {
            assert!(
                sizes(text, mm, None, Choice::Sign(Decimal::Point)).is_err(),
                "{text}"
            );
        }
    }
}
