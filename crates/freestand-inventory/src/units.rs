//! Units as people write them in headings and cells: words of six languages, plurals, capitals.

use std::collections::HashMap;
use std::sync::LazyLock;

use freestand::G0_M_S2;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, Unit, lookup, parse_in_unit};
use freestand_input::words::canonical;

use super::vocabulary::{by_word, is_among};

/// The unit of a column or a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum CellUnit {
    /// A unit of what the column holds.
    Known(&'static Unit),
    /// A force in a column of masses: divided by g.
    Force(&'static Unit),
    /// Grams in a column of masses, where g cannot be an acceleration; with the kilogram.
    Gram(&'static Unit),
}

impl CellUnit {
    /// Its symbol.
    pub(super) fn symbol(self) -> &'static str {
        match self {
            Self::Known(unit) | Self::Force(unit) => unit.symbol,
            Self::Gram(_) => "g",
        }
    }

    /// A number in this unit, in SI (kg for a force).
    ///
    /// # Errors
    /// Anything but one finite number.
    pub(super) fn read(self, number: &str) -> Result<f64, Problem> {
        match self {
            Self::Known(unit) => parse_in_unit(number, unit),
            Self::Force(unit) => Ok(parse_in_unit(number, unit)? / G0_M_S2),
            Self::Gram(kg) => Ok(parse_in_unit(number, kg)? / 1000.0),
        }
    }
}

/// Words for units, and their symbols.
static WORDS: LazyLock<HashMap<&str, &str>> = LazyLock::new(|| {
    by_word(&[
        (
            "mm",
            "millimeter|millimeters|millimetre|millimetres|milimetros|millimetri|ミリ|ミリメートル",
        ),
        (
            "cm",
            "centimeter|centimeters|centimetre|centimetres|zentimeter|centimetros|centimetri|cms|センチ|センチメートル",
        ),
        ("m", "meter|meters|metre|metres|metros|metri|mtr|メートル"),
        (
            "in",
            "inch|inches|ins|zoll|pouce|pouces|pulgada|pulgadas|pollici|インチ",
        ),
        ("ft", "feet|foot|pieds|pies|piedi|fuss"),
        (
            "kg",
            "kilogram|kilograms|kilogramm|kilogramme|kilogrammes|kilogramos|chilogrammi|kilo|kilos|kgs|kgm|\
            キロ|キログラム",
        ),
        ("t", "tonne|tonnes|tonnen|toneladas|tonnellate|トン"),
        ("lb", "pound|pounds|lbs|lbm|livres|libras|libbre|ポンド"),
        ("oz", "ounces"),
        ("ms", "msec|millisecond|milliseconds|millisekunden"),
        ("s", "sec|seconds"),
        ("g", "gs|g s"),
        ("%", "percent"),
        ("kip", "kips"),
    ])
});

/// Why a text is not a unit of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NoUnit {
    /// It is a unit of something else.
    Other(Dimension),
    /// It is not a unit.
    Unknown,
}

/// The unit that is written `text` in a column that holds `dimension`.
///
/// # Errors
/// A unit of something else, or no unit at all.
pub(super) fn find(text: &str, dimension: Dimension) -> Result<CellUnit, NoUnit> {
    let text = text.trim().trim_end_matches('.').trim();
    let text = text
        .strip_prefix(['(', '['])
        .and_then(|rest| rest.strip_suffix([')', ']']))
        .unwrap_or(text)
        .trim();
    if text.is_empty() || text.len() > 40 {
        return Err(NoUnit::Unknown);
    }
    // As it is usually written.
    if let Some(unit) = lookup(text).filter(|unit| unit.dimension == dimension) {
        return Ok(CellUnit::Known(unit));
    }
    let words = canonical(text);
    let lower = text.to_lowercase();
    let word = WORDS.get(words.as_str()).copied();
    // N_mm and N mm in headings are N/mm.
    let slashed = text.replacen(['_', ' '], "/", 1);
    let mut other = None;
    for spelling in [
        Some(text),
        word,
        Some(lower.as_str()),
        Some(slashed.as_str()),
    ]
    .into_iter()
    .flatten()
    {
        let Some(unit) = lookup(spelling) else {
            continue;
        };
        if unit.dimension == dimension {
            return Ok(CellUnit::Known(unit));
        }
        match (dimension, unit.dimension) {
            (Dimension::Mass, Dimension::Force) => return Ok(CellUnit::Force(unit)),
            (Dimension::Mass, Dimension::Acceleration) if spelling == "g" => return gram(),
            _ => {}
        }
        other.get_or_insert(unit.dimension);
    }
    if dimension == Dimension::Mass && is_among(&words, "gram grams gramm grammes gramos grammi") {
        return gram();
    }
    Err(other.map_or(NoUnit::Unknown, NoUnit::Other))
}

fn gram() -> Result<CellUnit, NoUnit> {
    lookup("kg").map(CellUnit::Gram).ok_or(NoUnit::Unknown)
}

/// Whether a unit belongs to the metric system; `None`: to both or neither.
pub(super) fn is_metric(unit: CellUnit) -> Option<bool> {
    match unit.symbol() {
        "mm" | "cm" | "m" | "kg" | "t" => Some(true),
        "in" | "ft" | "yd" | "lb" | "oz" | "lbf" | "kip" | "slug" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_found_by_their_words() {
        let symbol = |text: &str, dimension| find(text, dimension).map(CellUnit::symbol);
        for (text, dimension, expected) in [
            ("mm", Dimension::Length, "mm"),
            ("MM", Dimension::Length, "mm"),
            ("M", Dimension::Length, "m"),
            ("[cm]", Dimension::Length, "cm"),
            ("Zentimeter", Dimension::Length, "cm"),
            ("KG", Dimension::Mass, "kg"),
            ("kgs.", Dimension::Mass, "kg"),
            ("T", Dimension::Mass, "t"),
            ("g", Dimension::Mass, "g"),
            ("kN", Dimension::Mass, "kN"),
            ("n_mm", Dimension::Stiffness, "N/mm"),
            ("KN/M", Dimension::Stiffness, "kN/m"),
            ("msec", Dimension::Time, "ms"),
        ] {
            assert_eq!(symbol(text, dimension), Ok(expected), "{text}");
        }
        assert_eq!(
            symbol("kg", Dimension::Length),
            Err(NoUnit::Other(Dimension::Mass))
        );
        assert_eq!(symbol("overall", Dimension::Length), Err(NoUnit::Unknown));
        // 2 kN / 9.80665 m/s².
        let force = find("kN", Dimension::Mass).unwrap().read("2").unwrap();
        assert!((force - 203.943_242_6).abs() < 1e-6, "{force}");
        assert_eq!(find("g", Dimension::Mass).unwrap().read("850"), Ok(0.85));
    }
}
