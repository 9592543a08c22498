//! Units that a sentence beside a table states.

use freestand_input::quantity::Dimension;
use freestand_input::words::canonical;

use super::units::{CellUnit, find};
use super::vocabulary::{is_among, is_ditto};

/// The unit that the cell of a column of units states for lengths or masses: `cm`, `mm / kg`.
pub(super) fn cell_unit(text: &str, dimension: Dimension) -> Option<CellUnit> {
    // A quotation mark may repeat the cell above.
    (text.len() < 40 && !is_ditto(text))
        .then(|| sentence_unit(&format!("unit: {text}"), dimension))
        .flatten()
}

/// The unit that a sentence states for lengths or masses: `All dimensions in mm, weights in kg`.
pub(super) fn sentence_unit(text: &str, dimension: Dimension) -> Option<CellUnit> {
    const LENGTHS: &str = "dimension dimensions dim dims size sizes length lengths measurements measures masse \
        abmessungen langen grossen cotes mesures dimensiones medidas cotas dimensioni misure quote 寸法 heights";
    const MASSES: &str = "weight weights mass masses gewicht gewichte massen poids peso pesos masas pesi 重量 質量 wt wts";
    const BOTH: &str = "units unit einheiten einheit unites unite unidades unita 単位";
    const BEFORE: &str = "in en em are sind sont son sono by は is all";
    const CHAIN: &str = "and und et y e or &";
    let wanted = match dimension {
        Dimension::Length => LENGTHS,
        Dimension::Mass => MASSES,
        _ => return None,
    };
    // Words, with a colon, an equals sign or a bracket as words of their own; scripts are apart.
    let mut words: Vec<String> = Vec::new();
    let mut kind = 0;
    for c in text.chars() {
        let now = if matches!(
            c,
            ':' | '：' | '=' | '(' | '[' | ',' | '、' | '&' | '/' | 'は'
        ) {
            3
        } else if c.is_ascii_alphanumeric()
            || ('\u{c0}'..='\u{24f}').contains(&c)
            || matches!(c, '"' | '\'')
        {
            1
        } else if c.is_alphabetic() {
            2
        } else {
            0
        };
        match (now == kind && now != 3, now) {
            (_, 0) => {}
            (true, _) => {
                if let Some(last) = words.last_mut() {
                    last.push(c);
                }
            }
            (false, _) => words.push(c.to_string()),
        }
        kind = now;
    }
    let mut is_wanted = false;
    let mut found: Option<CellUnit> = None;
    // Whether a unit may stand here.
    let mut is_due = false;
    for (place, word) in words.iter().enumerate() {
        let plain = canonical(word);
        if is_among(&plain, BOTH) || is_among(&plain, wanted) {
            (is_wanted, is_due) = (true, false);
        } else if is_among(&plain, LENGTHS) || is_among(&plain, MASSES) {
            (is_wanted, is_due) = (false, false);
        } else if matches!(word.as_str(), ":" | "：" | "=" | "(" | "[") {
            is_due = true;
        } else if let Ok(unit) = find(word, dimension)
            && (is_due || !word.is_ascii())
            && (plain != "in"
                || words
                    .get(place + 1)
                    .is_none_or(|next| !next.chars().all(char::is_alphanumeric)))
        {
            if is_wanted {
                if found.is_some_and(|other| other != unit) {
                    return None;
                }
                found = Some(unit);
            }
        } else if is_among(&plain, BEFORE) {
            is_due = true;
        } else {
            // "mm, kg", "mm and kg": units in a chain.
            let is_unit = [Dimension::Mass, Dimension::Length]
                .iter()
                .any(|other| find(word, *other).is_ok());
            is_due &= is_unit
                || is_among(&plain, CHAIN)
                || matches!(word.as_str(), "," | "、" | "/" | "&");
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_state_units() {
        let symbol = |text: &str, dimension| sentence_unit(text, dimension).map(CellUnit::symbol);
        for (text, length, mass) in [
            ("All dimensions in mm", Some("mm"), None),
            (
                "All dimensions in mm, weights in kg",
                Some("mm"),
                Some("kg"),
            ),
            (
                "All dimensions are in inches and weights in lb.",
                Some("in"),
                Some("lb"),
            ),
            ("Alle Maße in cm, Gewichte in kg", Some("cm"), Some("kg")),
            ("Dimensions en cm, poids en kg", Some("cm"), Some("kg")),
            ("Medidas en cm", Some("cm"), None),
            ("Misure in mm", Some("mm"), None),
            ("単位：mm、kg", Some("mm"), Some("kg")),
            ("寸法はmm、重量はkg", Some("mm"), Some("kg")),
            ("Units: mm, kg", Some("mm"), Some("kg")),
            ("Units: in / lb", Some("in"), Some("lb")),
            ("Dimensions (mm)", Some("mm"), None),
            ("Inventory of objects in the museum", None, None),
            ("Dimensions were taken in May", None, None),
            ("Weights in kg", None, Some("kg")),
        ] {
            assert_eq!(
                (
                    symbol(text, Dimension::Length),
                    symbol(text, Dimension::Mass)
                ),
                (length, mass),
                "{text}"
            );
        }
    }
}
