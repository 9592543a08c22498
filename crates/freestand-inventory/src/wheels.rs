//! What a list says about the wheels of an object.

use freestand_input::words::canonical;

use super::Casters;
use super::vocabulary::{Answer, is_among, yes_or_no};

/// Whether something rests on wheels.
pub(super) fn names_wheels(text: &str) -> bool {
    const WHEELS: &str = "castor|caster|wheel|rollen|rader|fahrbar|roulette|roues|ruedas|ruote|rotelle|rodas|rodizio|\
        tekerlek|キャスター|車輪|轮|mobile|on rollers|roller base";
    let words = canonical(text);
    WHEELS.split('|').any(|word| words.contains(word))
}

/// Whether a name or a note says that the object is on wheels that may roll: "shelving on castors", but not
/// "ventilator, castors braked".
pub(super) fn may_roll(text: &str) -> bool {
    let is_held = |part: &str| {
        names_wheels(part) && matches!(casters(part), Wheels::Said(Casters::Braked | Casters::None))
    };
    let parts = || text.split([',', ';', '(', ')', '.', ':']);
    parts().any(is_wheeled) && !parts().any(is_held) && !is_held(text)
}

fn is_wheeled(text: &str) -> bool {
    const WHEELED: &str =
        "castors casters castored wheeled fahrbar fahrbare fahrbarer fahrbares tekerlekli rodizios";
    const WHEELS: &str = "wheels rollen radern roulettes roues ruedas ruote rotelle rodas";
    const ON: &str = "on with auf mit sur a avec con su com sobre";
    let words = canonical(text);
    let before = std::iter::once("").chain(words.split(' '));
    before.zip(words.split(' ')).any(|(before, word)| {
        let is_named =
            is_among(word, WHEELED) || word.contains("キャスター") && !word.contains("なし");
        is_named && !is_among(before, NONE) || is_among(word, WHEELS) && is_among(before, ON)
    })
}

/// What a cell says about the casters of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wheels {
    /// In so many words.
    Said(Casters),
    /// It speaks of them; that all are braked, that they roll or that there are none is not certain.
    Some,
    /// The same, and a word says that they are braked, which another may turn: "2 of 4 locked".
    PerhapsBraked,
    /// It stands on something else: feet, pads.
    Other,
    /// The text is not understood.
    Unclear,
}

// Words that blanks separate, in the form of [`canonical`].
const WHEEL: &str = "castor castors caster casters wheel wheels roller rollers rolle rollen lenkrolle lenkrollen rad \
    rader roulette roulettes roue roues rueda ruedas ruota ruote rotella rotelle roda rodas rodizio rodizios tekerlek \
    tekerlekler tekerlekleri キャスター 車輪 轮 轮子 脚轮";
const BRAKE: &str = "brake brakes lock locks bremse bremsen feststeller frein freins freno frenos freni freio freios \
    trava travas fren frenler ブレーキ ロック 刹车";
const HELD: &str = "braked locked gebremst festgestellt arretiert blockiert freine freinee freines freinees bloque \
    bloquee bloques bloquees frenado frenada frenados frenadas bloqueado bloqueada bloqueados bloqueadas travado \
    travada travados travadas frenato frenata frenati frenate bloccato bloccata bloccati bloccate kilitli ロック済 \
    ロック済み 锁定 已锁定";
const FREE: &str = "free unlocked unbraked frei ungebremst libre libres libero libera liberi libere livre livres \
    serbest kilitsiz frensiz フリー 自由 ロックなし ブレーキなし 无刹车 不带刹车";
const NONE: &str = "no none without nein kein keine ohne non sans aucun aucune sin sem senza nessuna nao なし 没有";
/// A whole cell that answers no.
const NO: &str = "n no nein non nee nao hayir yok false falsch faux falso 0 無 无 否 なし 没有";
/// Words that change nothing beside the others.
const PLAIN: &str = "yes ja oui si sim evet all alle tous toutes todos todas tutti tutte and und et y e ed \
    ve with mit avec con com on auf sur su sobre the die der das les le la las los are is sind ist sont est sono estan";

/// What every word of a cell together says of the wheels; `None` where one word may turn what another says.
/// That they are braked stops the object from rolling, and is never guessed.
fn state(words: &str) -> Option<Casters> {
    const NOT: &str = "not nicht non pas nao";
    const WITHOUT: &str = "no without ohne kein keine sans sin senza sem";
    const SET: &str = "serre serres";
    let mut rest: Vec<&str> = words.split(' ').rev().collect();
    let (mut said, mut has_count) = (None, false);
    while let Some(word) = rest.pop() {
        let next = rest.last().copied().unwrap_or_default();
        let is_last_on = next == "on" && rest.len() == 1;
        let (found, takes_next) = if is_among(word, WITHOUT) && is_among(next, BRAKE)
            || is_among(word, NOT) && is_among(next, HELD)
        {
            (Some(Casters::Free), true)
        } else if is_among(word, BRAKE) && (is_last_on || is_among(next, SET)) {
            (Some(Casters::Braked), true)
        } else if is_among(word, HELD) {
            (Some(Casters::Braked), false)
        } else if is_among(word, FREE) {
            (Some(Casters::Free), false)
        } else if let Some((number, unit)) = numbered(word) {
            // "3 in 4 castors" is no size.
            let is_share = || rest.len() > 1 && numbered(rest[rest.len() - 2]).is_some();
            let is_size = |unit: &str| matches!(unit, "mm" | "cm") || unit == "in" && !is_share();
            // Fewer than four may be some of them.
            let is_count = number >= 4 && matches!(unit, "" | "x") && !has_count && !is_size(next);
            if !(is_count || is_size(unit) || unit.is_empty() && is_size(next)) {
                return None;
            }
            has_count |= is_count;
            (None, !is_count && unit.is_empty())
        } else if [WHEEL, BRAKE, PLAIN].iter().any(|all| is_among(word, all)) {
            (None, false)
        } else {
            return None;
        };
        if takes_next {
            rest.pop();
        }
        if said.is_some() && found.is_some() && said != found {
            return None;
        }
        said = said.or(found);
    }
    said
}

/// The number at the beginning of a word, and what follows it: `75mm`, `4x`.
fn numbered(word: &str) -> Option<(u32, &str)> {
    let (number, unit) = word.split_at(word.bytes().take_while(u8::is_ascii_digit).count());
    number.parse().ok().map(|number| (number, unit))
}

/// Whether every word says that there are none, or what is there in their place.
fn says_none(words: &str) -> bool {
    let mut each = words.split(' ');
    let is_known = |word: &str| {
        [NONE, WHEEL, PLAIN, OTHER]
            .iter()
            .any(|all| is_among(word, all))
    };
    // "No feet, castors" has castors.
    let mut pairs = words.split(' ').zip(words.split(' ').skip(1));
    let lacks_other = pairs.any(|(word, next)| is_among(word, NONE) && is_among(next, OTHER));
    words.split(' ').all(is_known) && each.any(|word| is_among(word, NONE)) && !lacks_other
}

const OTHER: &str = "feet foot pad pads mounts springs legs plinth skids glides base fusse fuss sockel pieds patas pes \
    piedini ayak takoz 脚 stand floor boden levellers rails";

/// Whether something rolls: by a word of its own, or by what is said about its wheels.
pub(super) fn casters(text: &str) -> Wheels {
    // Beginnings of words about brakes.
    const ON_BRAKES: &str = "brak unbrak lock unlock brems gebrems ungebrems festst festge arret frein bloqu blocc \
        blocki fren freio trava kilit";
    const ON_BRAKES_INSIDE: [&str; 4] = ["刹车", "锁", "ブレーキ", "ロック"];
    let words = canonical(text);
    let is_asked = text.contains(['?', '？']);
    if !is_asked {
        if let Some(found) = state(&words) {
            return Wheels::Said(found);
        }
        if says_none(&words) {
            return Wheels::Said(Casters::None);
        }
        let is_of_brakes = words
            .split(' ')
            .any(|word| ON_BRAKES.split(' ').any(|start| word.starts_with(start)))
            || ON_BRAKES_INSIDE.iter().any(|part| words.contains(part));
        if is_of_brakes {
            let is_held = words.split(' ').any(|word| is_among(word, HELD));
            return if is_held {
                Wheels::PerhapsBraked
            } else {
                Wheels::Some
            };
        }
    }
    if words.parse::<u32>().is_ok_and(|count| count > 1) || names_wheels(text) {
        return Wheels::Some;
    }
    match yes_or_no(text) {
        Answer::Yes => Wheels::Some,
        // "Not fixed" is no answer about wheels.
        Answer::No if words.is_empty() || is_among(&words, NO) => Wheels::Said(Casters::None),
        _ if matches!(words.as_str(), "y" | "x" | "j" | "o" | "s" | "1") => Wheels::Some,
        _ if words.split(' ').any(|word| is_among(word, OTHER)) => Wheels::Other,
        _ => Wheels::Unclear,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn casters_by_their_words() {
        use Casters::{Braked, Free, None as No};
        for (text, expected) in [
            ("free", Wheels::Said(Free)),
            ("castors free", Wheels::Said(Free)),
            ("yes, free", Wheels::Said(Free)),
            ("yes", Wheels::Some),
            ("4 castors, 75 mm", Wheels::Some),
            ("Rollen, gebremst", Wheels::Said(Braked)),
            ("roulettes bloquées", Wheels::Said(Braked)),
            ("wheels locked", Wheels::Said(Braked)),
            ("yes, locked", Wheels::Said(Braked)),
            ("kilitli", Wheels::Said(Braked)),
            ("castors unlocked", Wheels::Said(Free)),
            ("nicht gebremst", Wheels::Said(Free)),
            ("freins serrés", Wheels::Said(Braked)),
            ("no brakes", Wheels::Said(Free)),
            ("no brakes on castors", Wheels::Said(Free)),
            ("without brakes, on wheels", Wheels::Said(Free)),
            ("ohne Bremse", Wheels::Said(Free)),
            ("frensiz", Wheels::Said(Free)),
            ("无刹车", Wheels::Said(Free)),
            ("libere", Wheels::Said(Free)),
            // Brakes that nobody says are set, or that some of the wheels have.
            ("with brakes", Wheels::Some),
            ("4, 2 with brakes", Wheels::Some),
            ("4, 2 locked", Wheels::PerhapsBraked),
            ("4, davon 2 gebremst", Wheels::PerhapsBraked),
            ("4, 2 without brakes", Wheels::Some),
            ("no brakes on 2 of 4", Wheels::Some),
            ("no brakes on 2 castors", Wheels::Some),
            ("no brakes on one castor", Wheels::Some),
            ("rear castors locked", Wheels::PerhapsBraked),
            ("une roulette sans frein", Wheels::Some),
            ("vorne gebremst", Wheels::PerhapsBraked),
            ("ohne Bremse, davon 2", Wheels::Some),
            ("4 castors, no brakes", Wheels::Said(Free)),
            ("2 of 4 locked", Wheels::PerhapsBraked),
            ("braked when parked", Wheels::PerhapsBraked),
            ("lockable", Wheels::Some),
            ("brakes broken", Wheels::Some),
            ("con freno", Wheels::Some),
            ("带刹车", Wheels::Some),
            ("4", Wheels::Some),
            ("sem rodízios", Wheels::Said(No)),
            ("senza", Wheels::Said(No)),
            ("brake only on two castors", Wheels::Some),
            ("wheels, not parked", Wheels::Some),
            ("roues non freinées", Wheels::Said(Free)),
            // What else stands beside the word may turn it: only words that cannot are passed over.
            ("was locked", Wheels::PerhapsBraked),
            ("rarely locked", Wheels::PerhapsBraked),
            ("sometimes braked", Wheels::PerhapsBraked),
            ("usually locked", Wheels::PerhapsBraked),
            ("can be locked", Wheels::PerhapsBraked),
            ("should be braked", Wheels::PerhapsBraked),
            ("to be locked", Wheels::PerhapsBraked),
            ("braked: n", Wheels::PerhapsBraked),
            ("braked - broken", Wheels::PerhapsBraked),
            ("braked, one broken", Wheels::PerhapsBraked),
            ("4 of 4 locked", Wheels::PerhapsBraked),
            ("4 of 5 locked", Wheels::PerhapsBraked),
            ("2 castors locked", Wheels::PerhapsBraked),
            ("castors removed", Wheels::Some),
            ("no castors locked", Wheels::PerhapsBraked),
            ("brakes on castors", Wheels::Some),
            ("kann gebremst werden", Wheels::PerhapsBraked),
            ("soll gebremst werden", Wheels::PerhapsBraked),
            ("gebremst (defekt)", Wheels::PerhapsBraked),
            ("frein HS", Wheels::Some),
            ("bloquées (frein cassé)", Wheels::PerhapsBraked),
            ("peut être bloqué", Wheels::PerhapsBraked),
            ("può essere bloccato", Wheels::PerhapsBraked),
            ("bloqueable", Wheels::Some),
            ("never locked", Wheels::PerhapsBraked),
            ("free, locked", Wheels::PerhapsBraked),
            ("no, locked", Wheels::PerhapsBraked),
            ("not lockable", Wheels::Some),
            ("ロックあり", Wheels::Some),
            ("ロックなし", Wheels::Said(Free)),
            ("no lock", Wheels::Said(Free)),
            ("not locked", Wheels::Said(Free)),
            ("unbraked", Wheels::Said(Free)),
            ("all locked", Wheels::Said(Braked)),
            ("4 castors, 75 mm, locked", Wheels::Said(Braked)),
            ("75mm castors braked", Wheels::Said(Braked)),
            ("castors: 4, locked", Wheels::Said(Braked)),
            ("castors, brakes on", Wheels::Said(Braked)),
            ("Alle Rollen sind gebremst", Wheels::Said(Braked)),
            ("キャスター ロック済", Wheels::Said(Braked)),
            ("Rollen: keine", Wheels::Said(No)),
            ("no castors, on feet", Wheels::Said(No)),
            ("locked?", Wheels::Unclear),
            ("no", Wheels::Said(No)),
            ("no castors", Wheels::Said(No)),
            ("four levelling feet", Wheels::Other),
            ("rubber pads", Wheels::Other),
            ("spring mounts", Wheels::Other),
            ("see photo", Wheels::Unclear),
            ("no feet, castors", Wheels::Some),
            ("roulettes sans pieds", Wheels::Some),
            ("ohne Sockel, mit Rollen", Wheels::Some),
            ("no castors, feet", Wheels::Said(No)),
            ("not fixed", Wheels::Unclear),
            ("loose", Wheels::Unclear),
            ("not sure", Wheels::Unclear),
            ("FALSE", Wheels::Said(No)),
            ("3 in 4 castors locked", Wheels::PerhapsBraked),
            ("3 in castors locked", Wheels::Said(Braked)),
            ("both castors locked", Wheels::PerhapsBraked),
        ] {
            assert_eq!(casters(text), expected, "{text}");
        }
    }

    #[test]
    fn names_and_notes_that_speak_of_wheels() {
        for text in [
            "Linen shelving on castors",
            "on wheels",
            "cart, castors free",
            "rack on castors, locked",
            "Regal, fahrbar",
            "chariot à roulettes",
            "キャスター付き棚",
        ] {
            assert!(may_roll(text), "{text}");
        }
        for text in [
            "cabinet",
            "no castors",
            "Ventilator, castors braked",
            "rack on wheels (wheels locked)",
            "ohne Rollen",
            "Regal für Rollen",
            "steering wheels",
            "キャスターなし",
            "",
        ] {
            assert!(!may_roll(text), "{text}");
        }
    }
}
