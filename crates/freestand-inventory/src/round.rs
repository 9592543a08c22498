//! Whether an object is round: by a column, by a mark in a size, or by its name.

use freestand_input::words::canonical;
use freestand_study::hull::body::Form;

use super::vocabulary::is_among;

/// Words for a diameter in the cell of a size, in the form of [`canonical`].
const DIAMETER: &str = "ø ⌀ dia diam diameter diametre diametro durchmesser round rund rond 直径";
/// Signs for a diameter.
const SIGNS: [char; 3] = ['Ø', 'ø', '⌀'];

/// A length without the words that make it a diameter, and whether there were any: `Ø230`,
/// `500 dia`, `dia. 500 mm`.
pub(super) fn without_diameter(text: &str) -> (String, bool) {
    if text
        .bytes()
        .all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b',' | b' '))
    {
        return (text.to_owned(), false);
    }
    let is_mark =
        |word: &str| is_among(&canonical(word), DIAMETER) || matches!(word, "⌀" | "Ø" | "ø");
    let mut rest = text.trim().to_owned();
    let mut was_found = false;
    loop {
        let without_mark = rest.trim_start_matches(SIGNS).trim_start();
        let start = without_mark
            .find(|c: char| !c.is_alphabetic())
            .unwrap_or(without_mark.len());
        let (first, after) = without_mark.split_at(start);
        // "rund 180 cm" is about 180 cm, "180 cm rund" is a diameter.
        let begins = (is_mark(first) && canonical(first) != "rund")
            .then(|| after.trim_start_matches(['.', ':', '=', ' ']));
        let before = begins.unwrap_or(without_mark);
        let bare = before.trim_end_matches(['.', ')', ' ', 'Ø', 'ø', '⌀']);
        let (left, last) = bare.split_at(bare.trim_end_matches(char::is_alphabetic).len());
        let ends = is_mark(last) && !left.trim().is_empty();
        let shorter = if ends {
            left.trim_end_matches(['(', ',', ' '])
        } else if before.ends_with(SIGNS) {
            bare
        } else {
            before
        };
        if shorter.len() == rest.len() || shorter.trim().is_empty() {
            return (rest, was_found);
        }
        rest = shorter.trim().to_owned();
        was_found = true;
    }
}

/// Whether a cell calls a size a diameter.
pub(super) fn names_diameter(text: &str) -> bool {
    without_diameter(text).1
}

/// The shape in the cell of a column `shape`; `None`: it is not understood.
pub(super) fn shape(text: &str) -> Option<Form> {
    const ROUND: &str = "round circular circle cylinder cylindrical cyl conical oval rund zylinder zylindrisch \
        rond ronde cylindre cylindrique redondo redonda cilindro cilindrico rotondo tondo yuvarlak silindir 円筒";
    const BOX: &str = "box square rectangular rectangle cuboid prism cabinet block eckig rechteckig quadratisch \
        quader kasten carre rectangulaire boite cuadrado caja quadrato rettangolare dikdortgen 箱";
    const CORNERS: [(&str, u32); 4] = [
        ("triangle triangular dreieckig", 3),
        ("pentagon pentagonal", 5),
        ("hexagon hexagonal sechseckig", 6),
        ("octagon octagonal achteckig", 8),
    ];
    let words = canonical(text);
    let polygon = words.strip_prefix("polygon").map(str::trim);
    if let Some(corners) = polygon.filter(|corners| !corners.is_empty()) {
        return Form::of(&format!("polygon:{corners}")).ok();
    }
    let named = CORNERS.iter().find(|(names, _)| is_among(&words, names));
    match named {
        Some((_, corners)) => Some(Form::Polygon(*corners)),
        // Of a polygon whose corners nobody counted, the circle is the worse.
        None if is_among(&words, ROUND) || polygon.is_some() => Some(Form::Cylinder),
        None => is_among(&words, BOX).then_some(Form::Box),
    }
}

/// Whether the name of an object is that of a round one, such as a gas cylinder; a rack of bottles is none.
pub(super) fn names_round_object(text: &str) -> bool {
    const ROUND: &str = "cylinder cylinders bottle bottles drum drums barrel barrels dewar keg column pillar \
        vase urn zylinder fass saule bouteille bouteilles cylindre colonne fut cilindro botella bombona bidon \
        columna bombola bombole fusto colonna tup silindir varil";
    const HOLDERS: &str = "rack cabinet store storage trolley cart cage holder stand shelf shelves shelving box \
        case cupboard washer press machine warmer wagen schrank regal armoire chariot armadio armario";
    // "Bust on a column": what it stands on is another object.
    const ON: &str = " on | auf | sur | sobre | su | next to | with ";
    let all = canonical(text);
    let words = ON.split('|').fold(all.as_str(), |words, on| {
        words.split(on).next().unwrap_or(words)
    });
    let has = |all: &str| words.split(' ').any(|word| is_among(word, all));
    let is_compound = words
        .split(' ')
        .any(|word| word.ends_with("flasche") || word.ends_with("flaschen"));
    (has(ROUND) || is_compound || words.contains("ボンベ")) && !has(HOLDERS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diameter_is_a_length_with_a_mark() {
        for (text, rest) in [
            ("Ø230", "230"),
            ("Ø 230 mm", "230 mm"),
            ("⌀230", "230"),
            ("500 dia", "500"),
            ("500 mm dia.", "500 mm"),
            ("dia. 500 mm", "500 mm"),
            ("500 (dia)", "500"),
            ("40 cm rund", "40 cm"),
            ("230Ø", "230"),
        ] {
            assert_eq!(without_diameter(text), (rest.to_owned(), true), "{text}");
            assert!(names_diameter(text), "{text}");
        }
        for text in [
            "230",
            "1.8 m",
            "6'2\"",
            "rack",
            "dia",
            "72\" (1829 mm)",
            "rund 180 cm",
        ] {
            assert_eq!(without_diameter(text), (text.to_owned(), false), "{text}");
        }
        assert!(!names_diameter("1800 mm") && !names_diameter("ground"));
    }

    #[test]
    fn names_of_round_objects_and_of_what_holds_them() {
        for text in [
            "Oxygen cylinder G size",
            "Gasflasche",
            "LN2 dewar on roller base",
            "Vase Ming",
            "Oil drum",
        ] {
            assert!(names_round_object(text), "{text}");
        }
        for text in [
            "bookcase",
            "Bottle rack",
            "Cylinder cage",
            "Gas bottle cabinet",
            "Flaschenschrank",
            "bust on a column",
        ] {
            assert!(!names_round_object(text), "{text}");
        }
        assert_eq!(
            [
                shape("Cylinder"),
                shape("box"),
                shape("odd"),
                shape("Polygon: 8"),
                shape("hexagonal"),
                shape("polygon"),
                shape("polygon:2"),
            ],
            [
                Some(Form::Cylinder),
                Some(Form::Box),
                None,
                Some(Form::Polygon(8)),
                Some(Form::Polygon(6)),
                Some(Form::Cylinder),
                None,
            ]
        );
    }
}
