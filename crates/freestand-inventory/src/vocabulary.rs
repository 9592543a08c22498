//! Words that people write into cells, in six languages.

use std::collections::{HashMap, HashSet};
use std::sync::LazyLock;

use freestand_input::words::canonical;

use super::numbers::has_digit;

/// Whether a word is one of these, which blanks separate.
pub(super) fn is_among(word: &str, all: &str) -> bool {
    all.split(' ').any(|one| one == word)
}

/// Whether a text is one of these, which `|` separates.
pub(super) fn is_phrase(text: &str, all: &str) -> bool {
    all.split('|').any(|one| one == text)
}

/// Texts by what they mean; `|` separates those of one meaning.
pub(super) fn by_word<T: Copy>(table: &[(T, &'static str)]) -> HashMap<&'static str, T> {
    let words = |(meaning, all): &(T, &'static str)| {
        let meaning = *meaning;
        all.split('|').map(move |word| (word, meaning))
    };
    table.iter().flat_map(words).collect()
}

/// Whether a text says that the value is not known.
pub(super) fn is_missing(text: &str) -> bool {
    // No such word has a digit or is long: most cells need no comparison.
    if text.len() > 40 || has_digit(text) {
        return false;
    }
    let words = canonical(text);
    // Only dashes, question marks and the like; letters of other scripts are words.
    (words.is_empty() && marked(text).is_none()) || MISSING.contains(words.as_str())
}

/// What a mark in a cell says, as in a form; `None`: it is no such mark.
fn marked(text: &str) -> Option<Answer> {
    match text.trim() {
        "✓" | "✔" | "☑" | "○" | "◯" | "〇" | "●" => Some(Answer::Yes),
        "×" | "✗" | "✘" | "☐" => Some(Answer::No),
        _ => None,
    }
}

/// Whether a text says that there is nothing, or that it is not known.
pub(super) fn is_no_value(text: &str) -> bool {
    const NOTHING: &str = "no|nein|non|nee|keine|kein|aucun|ninguno|free standing";
    is_missing(text) || is_phrase(&canonical(text), NOTHING)
}

/// In the form of [`canonical`].
static MISSING: LazyLock<HashSet<&str>> = LazyLock::new(|| {
    "n a|na|tbd|tbc|tba|unk|unknown|none|nil|null|nan|see manual|see drawing|not known|\
        not available|not applicable|not measured|to be confirmed|to be determined|k a|ka|unbekannt|entfallt|\
        bilinmiyor|desconhecido|nao disponivel|未知|无|yok|nicht bekannt|keine|keine angabe|fehlt|offen|neant|\
        inconnu|inconnue|n d|nd|n c|nc|non connu|aucun|s d|sd|desconocido|desconocida|ninguno|no disponible|\
        sconosciuto|sconosciuta|non noto|nessuno|不明|未定|なし|未確認"
    .split('|')
    .collect()
});

/// Words that begin a row of totals.
const TOTALS: &str = "total totals subtotal sub grand sum sums summe summen zwischensumme gesamt gesamtsumme \
        gesamtgewicht somme sous suma totale totales subtotale totaux";

/// Whether a text begins a row of totals.
pub(super) fn begins_total(text: &str) -> bool {
    let words = canonical(text);
    let mut each = words.split(' ');
    let first = each.next().unwrap_or_default();
    let second = each.next().unwrap_or_default();
    let is_total = is_among(first, TOTALS)
        && match first {
            "sub" | "sous" | "grand" => second.starts_with("total"),
            // A surveyor's instrument.
            "total" => second != "station",
            _ => true,
        };
    is_total
        || ["合計", "小計", "総計"]
            .iter()
            .any(|word| words.starts_with(word))
}

/// Whether a text alone in its row is a remark rather than the name of a section.
pub(super) fn begins_note(text: &str) -> bool {
    let words = canonical(text);
    let first = words.split(' ').next().unwrap_or_default();
    text.trim_start().starts_with(['*', '※'])
        || is_among(
            first,
            "note notes nb hinweis anmerkung remarque nota remark continued",
        )
}

/// What a cell answers to yes or no.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Answer {
    Yes,
    No,
    /// Neither for certain: "Y?", "yes but loose", "planned 2026", a letter.
    Unclear,
}

/// Whether an object is anchored. Yes is only what cannot mean anything else: an object that is taken
/// as anchored is not assessed. Letters and signs are no words: "x" may mean either.
pub(super) fn yes_or_no(text: &str) -> Answer {
    const YES: &str = "yes true anchored bolted fixed secured restrained screwed ja verankert verschraubt befestigt \
        gesichert angeschraubt wahr oui fixe fixee ancre ancree visse vissee boulonne boulonnee vrai si anclado \
        anclada fijado fijada fijo atornillado verdadero ancorato ancorata fissato fissata vero sim ancorado \
        fixado aparafusado evet sabit sabitlenmis 有 あり 固定 固定済 はい 是";
    // What may stand beside a yes: "bolted to the slab", "yes, 4 bolts M12".
    const HOW: &str = "to the a floor slab wall concrete base with and by at bolt bolts anchor anchors screws x \
        each corner corners expansion chemical am an im boden der wand au sol mur al";
    const NO: &str = "n|no|false|0|free|freestanding|free standing|not anchored|not bolted|not fixed|unanchored|\
        unrestrained|loose|nein|frei|freistehend|nicht verankert|nicht befestigt|falsch|non|libre|non fixe|\
        pas fixe|non ancre|faux|sin anclar|sin fijar|libero|non fissato|non ancorato|falso|nao|nao fixado|solto|\
        livre|hayır|hayir|yok|sabit degil|serbest|無|なし|未固定|否|いいえ|没有";
    if let Some(answer) = marked(text) {
        return answer;
    }
    let words = canonical(text);
    if text.contains(['?', '？']) {
        return Answer::Unclear;
    }
    if is_phrase(&words, NO) {
        return Answer::No;
    }
    // Sizes of bolts: M12, 4x.
    let is_size = |word: &str| {
        word.trim_start_matches(['m', 'x'])
            .trim_end_matches('x')
            .parse::<u32>()
            .is_ok()
    };
    let mut each = words.split(' ');
    let first = each.next().unwrap_or_default();
    if is_among(first, YES)
        && each.all(|word| is_among(word, YES) || is_among(word, HOW) || is_size(word))
    {
        return Answer::Yes;
    }
    // "No (castors)": whatever follows, it is not anchored.
    if matches!(
        first,
        "no" | "nein" | "not" | "nicht" | "unanchored" | "freestanding" | "hayır"
    ) {
        return Answer::No;
    }
    Answer::Unclear
}

/// A rating by its word: 2 high, 1 medium, 0 low.
pub fn rating(text: &str) -> Option<u8> {
    let words = canonical(text.split(['(', '[']).next().unwrap_or_default());
    Some(match words.as_str() {
        "h" | "high" | "hi" | "hoch" | "eleve" | "elevee" | "haut" | "haute" | "fort" | "forte"
        | "alto" | "alta" | "高" => 2,
        "m" | "medium" | "med" | "mod" | "moderate" | "mittel" | "moyen" | "moyenne" | "medio"
        | "media" | "中" => 1,
        "l" | "low" | "lo" | "niedrig" | "gering" | "faible" | "bas" | "basse" | "bajo"
        | "baja" | "basso" | "bassa" | "低" => 0,
        _ => return None,
    })
}

/// Whether a text points to another cell.
pub(super) fn is_ditto(text: &str) -> bool {
    let words = canonical(text);
    matches!(
        words.as_str(),
        "ditto" | "do" | "s o" | "siehe oben" | "wie oben" | "idem" | "as above" | "same" | "同上"
    ) || matches!(text.trim(), "\"" | "''" | "″" | "〃" | "”" | "“")
}

/// A number without the words behind it that say in which state a mass was taken, and whether it may be
/// too small: `1400 full`, `85 kg empty`.
pub(super) fn without_state(text: &str) -> (&str, bool) {
    const FULL: &str = "full loaded laden filled gross operating wet voll beladen brutto plein charge \
        lleno pieno cheio dolu";
    const EMPTY: &str = "empty dry net unladen tare leer netto vide vacio vuoto bos";
    let trimmed = text.trim().trim_end_matches([')', '.', ' ']);
    let (before, word) = trimmed.split_at(trimmed.trim_end_matches(char::is_alphabetic).len());
    let word = canonical(word);
    let before = before.trim_end_matches(['(', ',', ' ', '-']);
    let is_empty = is_among(&word, EMPTY);
    if has_digit(before) && (is_empty || is_among(&word, FULL)) {
        (before, is_empty)
    } else {
        (text, false)
    }
}

/// The text without the words that make its number a rough one, and whether there were any.
pub(super) fn without_approximation(text: &str) -> (&str, bool) {
    const BEFORE: &str = "approximately|approx.|approx|about|abt.|abt|estimated|est.|est|circa|ca.|ca|c.|environ|\
        env.|env|aprox.|aprox|etwa|rund|ungefähr|ungef.|約|约|~|≈";
    const AFTER: &str = "(estimated)|(est.)|(est)|(approx.)|(approx)|(ca.)|(circa)|(geschätzt)|(gesch.)|(estimé)|\
        (estimée)|(estimado)|(stimato)|(?)|(~)|est.|est|approx.|approx|environ|ca.|estimated|程度|?";
    let mut rest = text.trim();
    let mut was_found = false;
    // A bare number, as most cells are.
    if rest
        .bytes()
        .all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b','))
    {
        return (rest, false);
    }
    loop {
        let lower = rest.to_lowercase();
        // Lower case keeps the length of all letters that these words have.
        let lower = if lower.len() == rest.len() {
            lower.as_str()
        } else {
            rest
        };
        let before = BEFORE.split('|').find_map(|mark| {
            let after = rest.get(lower.strip_prefix(mark).map(|_| mark.len())?..)?;
            // "c.g." is no "c.", "cabinet" no "ca".
            (!mark.ends_with(char::is_alphabetic) || !after.starts_with(char::is_alphabetic))
                .then_some(after)
        });
        let after = AFTER.split('|').find_map(|mark| {
            let before = rest.get(..lower.strip_suffix(mark)?.len())?;
            (!mark.starts_with(char::is_alphabetic) || !before.ends_with(char::is_alphabetic))
                .then_some(before)
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
        for text in [
            "",
            "-",
            "–",
            "—",
            "?",
            "n/a",
            "N.A.",
            "#N/A",
            "TBC",
            "k.A.",
            "néant",
            "s/d",
            "不明",
            "see manual",
        ] {
            assert!(is_missing(text), "{text}");
        }
        assert!(!is_missing("0") && !is_missing("rack"));
    }

    #[test]
    fn only_an_unequivocal_yes_is_one() {
        for text in [
            "Yes",
            "✓",
            "Bolted to slab",
            "ja",
            "sì",
            "有",
            "TRUE",
            "Yes - bolted",
            "yes, 4x M12",
            "evet",
        ] {
            assert_eq!(yes_or_no(text), Answer::Yes, "{text}");
        }
        for text in [
            "N",
            "free",
            "nicht verankert",
            "無",
            "×",
            "not bolted",
            "No (castors)",
            "FALSE",
            "hayır",
            "yok",
        ] {
            assert_eq!(yes_or_no(text), Answer::No, "{text}");
        }
        for text in [
            "Y?",
            "fixed?",
            "Yes – planned 2026",
            "Yes but loose",
            "y",
            "x",
            "s",
            "j",
            "o",
            "1",
            "wall",
            "chained to wall",
            "chained",
            "bolts missing",
            "partially",
            "partly bolted",
            "to be checked",
            "anchored at top, not at base",
            "fixed to trolley",
        ] {
            assert_eq!(yes_or_no(text), Answer::Unclear, "{text}");
        }
    }

    #[test]
    fn the_state_of_a_mass_is_no_unit() {
        for (text, rest, is_too_small) in [
            ("1400 full", "1400", false),
            ("85 kg empty", "85 kg", true),
            ("85 kg (voll)", "85 kg", false),
            ("85 kg", "85 kg", false),
            ("full", "full", false),
        ] {
            assert_eq!(without_state(text), (rest, is_too_small), "{text}");
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
        for text in [
            "Total",
            "TOTAL:",
            "Sub-total",
            "Grand total",
            "Summe",
            "Gesamt",
            "Sous-total",
            "合計 12",
        ] {
            assert!(begins_total(text), "{text}");
        }
        for text in [
            "Total station",
            "Sub-station panel",
            "Summer school",
            "Grand piano",
        ] {
            assert!(!begins_total(text), "{text}");
        }
    }
}
