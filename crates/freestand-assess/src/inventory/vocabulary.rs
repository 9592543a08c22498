//! Words that people write into cells, in six languages.

use freestand_input::words::canonical;

use super::Casters;

/// Whether a text says that the value is not known.
pub(super) fn is_missing(text: &str) -> bool {
    // No such word has a digit or is long: most cells need no comparison.
    if text.len() > 40 || text.bytes().any(|byte| byte.is_ascii_digit()) {
        return false;
    }
    let words = canonical(text);
    // Only dashes, question marks and the like; letters of other scripts are words.
    words.is_empty() || MISSING.contains(&words.as_str())
}

/// Whether a text says that there is nothing, or that it is not known.
pub(super) fn is_no_value(text: &str) -> bool {
    const NOTHING: [&str; 9] = ["no", "nein", "non", "nee", "keine", "kein", "aucun", "ninguno", "free standing"];
    is_missing(text) || NOTHING.contains(&canonical(text).as_str())
}

/// In the form of [`canonical`].
const MISSING: [&str; 54] = [
    "n a",
    "na",
    "tbd",
    "tbc",
    "tba",
    "unk",
    "unknown",
    "none",
    "nil",
    "null",
    "nan",
    "see manual",
    "see drawing",
    "not known",
    "not available",
    "not applicable",
    "not measured",
    "to be confirmed",
    "to be determined",
    "ditto",
    "k a",
    "ka",
    "unbekannt",
    "entfallt",
    "s o",
    "siehe oben",
    "nicht bekannt",
    "keine",
    "keine angabe",
    "fehlt",
    "offen",
    "neant",
    "inconnu",
    "inconnue",
    "n d",
    "nd",
    "n c",
    "nc",
    "non connu",
    "aucun",
    "s d",
    "sd",
    "desconocido",
    "desconocida",
    "ninguno",
    "no disponible",
    "sconosciuto",
    "sconosciuta",
    "non noto",
    "nessuno",
    "不明",
    "未定",
    "なし",
    "未確認",
];

/// Words that begin a row of totals.
const TOTALS: [&str; 20] = [
    "total",
    "totals",
    "subtotal",
    "sub",
    "grand",
    "sum",
    "sums",
    "summe",
    "summen",
    "zwischensumme",
    "gesamt",
    "gesamtsumme",
    "gesamtgewicht",
    "somme",
    "sous",
    "suma",
    "totale",
    "totales",
    "subtotale",
    "totaux",
];

/// Whether a text begins a row of totals.
pub(super) fn begins_total(text: &str) -> bool {
    let words = canonical(text);
    let mut each = words.split(' ');
    let first = each.next().unwrap_or_default();
    let second = each.next().unwrap_or_default();
    let is_total = TOTALS.contains(&first)
        && match first {
            "sub" | "sous" | "grand" => second.starts_with("total"),
            // A surveyor's instrument.
            "total" => second != "station",
            _ => true,
        };
    is_total || ["合計", "小計", "総計"].iter().any(|word| words.starts_with(word))
}

/// Whether a text alone in its row is a remark rather than the name of a section.
pub(super) fn begins_note(text: &str) -> bool {
    let words = canonical(text);
    let first = words.split(' ').next().unwrap_or_default();
    text.trim_start().starts_with(['*', '※'])
        || ["note", "notes", "nb", "hinweis", "anmerkung", "remarque", "nota", "remark", "continued"].contains(&first)
}

/// Whether an object is anchored; `None`: the text does not say.
pub(super) fn yes_or_no(text: &str) -> Option<bool> {
    const YES: [&str; 49] = [
        "y",
        "yes",
        "true",
        "1",
        "x",
        "anchored",
        "bolted",
        "fixed",
        "secured",
        "restrained",
        "screwed",
        "braced",
        "strapped",
        "wall",
        "ja",
        "j",
        "verankert",
        "verschraubt",
        "befestigt",
        "gesichert",
        "angeschraubt",
        "oui",
        "o",
        "fixe",
        "fixee",
        "ancre",
        "ancree",
        "visse",
        "boulonne",
        "si",
        "s",
        "anclado",
        "anclada",
        "fijado",
        "fijada",
        "fijo",
        "atornillado",
        "ancorato",
        "ancorata",
        "fissato",
        "fissata",
        "vero",
        "vrai",
        "wahr",
        "verdadero",
        "有",
        "あり",
        "固定",
        "固定済",
    ];
    const NO: [&str; 35] = [
        "n",
        "no",
        "false",
        "0",
        "free",
        "freestanding",
        "free standing",
        "not anchored",
        "not bolted",
        "not fixed",
        "unanchored",
        "unrestrained",
        "loose",
        "nein",
        "frei",
        "freistehend",
        "nicht verankert",
        "nicht befestigt",
        "non",
        "libre",
        "non fixe",
        "pas fixe",
        "sin anclar",
        "sin fijar",
        "libero",
        "non fissato",
        "non ancorato",
        "falso",
        "faux",
        "falsch",
        "無",
        "なし",
        "未固定",
        "否",
        "non ancre",
    ];
    match text.trim() {
        "✓" | "✔" | "☑" | "○" | "◯" | "〇" | "●" => return Some(true),
        "×" | "✗" | "✘" | "☐" => return Some(false),
        _ => {}
    }
    let words = canonical(text);
    if NO.contains(&words.as_str()) {
        return Some(false);
    }
    if YES.contains(&words.as_str()) {
        return Some(true);
    }
    // "Yes, 4 bolts", "bolted to slab", "No (castors)"; a partial "no" says neither.
    let mut each = words.split(' ');
    let first = each.next().unwrap_or_default();
    let negations = ["not", "nicht", "pas", "sin", "non", "no", "partly", "partially", "teilweise"];
    if each.any(|word| negations.contains(&word) || word.starts_with("part")) {
        return None;
    }
    match first {
        "yes" | "ja" | "oui" | "anchored" | "bolted" | "screwed" | "verankert" | "verschraubt" | "fixe" | "ancre"
        | "anclado" | "ancorato" | "fissato" => Some(true),
        "no" | "nein" | "unanchored" | "freestanding" => Some(false),
        "not" | "nicht" => Some(false),
        _ => None,
    }
}

/// A rating by its word: 2 high, 1 medium, 0 low.
pub(crate) fn rating(text: &str) -> Option<u8> {
    let words = canonical(text.split(['(', '[']).next().unwrap_or_default());
    Some(match words.as_str() {
        "h" | "high" | "hi" | "hoch" | "eleve" | "elevee" | "haut" | "haute" | "fort" | "forte" | "alto" | "alta"
        | "高" => 2,
        "m" | "medium" | "med" | "mod" | "moderate" | "mittel" | "moyen" | "moyenne" | "medio" | "media" | "中" => 1,
        "l" | "low" | "lo" | "niedrig" | "gering" | "faible" | "bas" | "basse" | "bajo" | "baja" | "basso"
        | "bassa" | "低" => 0,
        _ => return None,
    })
}

/// Whether something rests on wheels.
pub(super) fn names_wheels(text: &str) -> bool {
    let words = canonical(text);
    ["castor", "caster", "wheel", "rollen", "rader", "roulette", "ruedas", "ruote", "rotelle", "キャスター", "車輪"]
        .iter()
        .any(|word| words.contains(word))
}

/// Whether something rolls: by a word of its own, or by what is said about its wheels.
pub(super) fn casters(text: &str) -> Option<Casters> {
    const BRAKED: [&str; 12] = [
        "braked",
        "brakes on",
        "locked",
        "gebremst",
        "festgestellt",
        "frein",
        "bloque",
        "frenad",
        "bloquead",
        "frenat",
        "bloccat",
        "ロック",
    ];
    const FREE: [&str; 9] =
        ["free", "unlocked", "unbraked", "frei", "libre", "libero", "libera", "ungebremst", "フリー"];
    let words = canonical(text);
    if FREE.iter().any(|word| words.contains(word)) {
        return Some(Casters::Free);
    }
    if BRAKED.iter().any(|word| words.contains(word)) {
        return Some(Casters::Braked);
    }
    match yes_or_no(text) {
        Some(true) => Some(Casters::Free),
        Some(false) => Some(Casters::None),
        None => names_wheels(text).then_some(Casters::Free),
    }
}

/// The text without the words that make its number a rough one, and whether there were any.
pub(super) fn without_approximation(text: &str) -> (&str, bool) {
    const BEFORE: [&str; 26] = [
        "approximately",
        "approx.",
        "approx",
        "about",
        "abt.",
        "abt",
        "estimated",
        "est.",
        "est",
        "circa",
        "ca.",
        "ca",
        "c.",
        "environ",
        "env.",
        "env",
        "aprox.",
        "aprox",
        "etwa",
        "rund",
        "ungefähr",
        "ungef.",
        "約",
        "约",
        "~",
        "≈",
    ];
    const AFTER: [&str; 24] = [
        "(estimated)",
        "(est.)",
        "(est)",
        "(approx.)",
        "(approx)",
        "(ca.)",
        "(circa)",
        "(geschätzt)",
        "(gesch.)",
        "(estimé)",
        "(estimée)",
        "(estimado)",
        "(stimato)",
        "(?)",
        "(~)",
        "est.",
        "est",
        "approx.",
        "approx",
        "environ",
        "ca.",
        "estimated",
        "程度",
        "?",
    ];
    let mut rest = text.trim();
    let mut was_found = false;
    // A bare number, as most cells are.
    if rest.bytes().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b',')) {
        return (rest, false);
    }
    loop {
        let lower = rest.to_lowercase();
        // Lower case keeps the length of all letters that these words have.
        let lower = if lower.len() == rest.len() { lower.as_str() } else { rest };
        let before = BEFORE.iter().find_map(|mark| {
            let after = rest.get(lower.strip_prefix(mark).map(|_| mark.len())?..)?;
            // "c.g." is no "c.", "cabinet" no "ca".
            (!mark.ends_with(char::is_alphabetic) || !after.starts_with(char::is_alphabetic)).then_some(after)
        });
        let after = AFTER.iter().find_map(|mark| {
            let before = rest.get(..lower.strip_suffix(mark)?.len())?;
            (!mark.starts_with(char::is_alphabetic) || !before.ends_with(char::is_alphabetic)).then_some(before)
        });
        match before.or(after) {
            Some(shorter) if !shorter.trim().is_empty() => {
                rest = shorter.trim();
                was_found = true;
            }
            _ => return (rest, was_found),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_values_that_are_not_known() {
        for text in ["", "-", "–", "—", "?", "n/a", "N.A.", "#N/A", "TBC", "k.A.", "néant", "s/d", "不明", "see manual"]
        {
            assert!(is_missing(text), "{text}");
        }
        assert!(!is_missing("0") && !is_missing("rack"));
    }

    #[test]
    fn answers_to_yes_or_no() {
        for text in
            ["Y", "x", "✓", "Bolted to slab", "ja", "fixé au mur".split(' ').next().unwrap(), "sì", "有", "TRUE"]
        {
            assert_eq!(yes_or_no(text), Some(true), "{text}");
        }
        for text in ["N", "free", "nicht verankert", "無", "×", "not bolted", "No (castors)", "FALSE"] {
            assert_eq!(yes_or_no(text), Some(false), "{text}");
        }
        for text in ["", "?", "partly bolted", "to be checked", "anchored at top, not at base"] {
            assert_eq!(yes_or_no(text), None, "{text}");
        }
    }

    #[test]
    fn casters_by_their_words() {
        use Casters::{Braked, Free, None as No};
        for (text, expected) in [
            ("free", Some(Free)),
            ("yes", Some(Free)),
            ("4 castors, 75 mm", Some(Free)),
            ("Rollen, gebremst", Some(Braked)),
            ("roulettes bloquées", Some(Braked)),
            ("wheels locked", Some(Braked)),
            ("castors unlocked", Some(Free)),
            ("no", Some(No)),
            ("four levelling feet", None),
        ] {
            assert_eq!(casters(text), expected, "{text}");
        }
    }

    #[test]
    fn rough_numbers_are_marked() {
        for (text, rest) in [
            ("approx. 180 cm", "180 cm"),
            ("~85", "85"),
            ("ca.1200", "1200"),
            ("180 (est.)", "180"),
            ("約180cm", "180cm"),
            ("85?", "85"),
        ] {
            assert_eq!(without_approximation(text), (rest, true), "{text}");
        }
        assert_eq!(without_approximation("cabinet 3"), ("cabinet 3", false));
    }

    #[test]
    fn totals_are_not_surveying_instruments() {
        for text in ["Total", "TOTAL:", "Sub-total", "Grand total", "Summe", "Gesamt", "Sous-total", "合計 12"] {
            assert!(begins_total(text), "{text}");
        }
        for text in ["Total station", "Sub-station panel", "Summer school", "Grand piano"] {
            assert!(!begins_total(text), "{text}");
        }
    }
}
