//! The name of a floor as the height of the floor over the height of the building.

use std::collections::HashMap;
use std::sync::LazyLock;

use freestand_input::words::canonical;
use freestand_study::study::FirstFloor;

use super::vocabulary::{by_word, is_among, is_phrase};

/// What is known about the floors of the building.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Floors {
    /// Names of floors, and their heights over that of the building.
    pub named: Vec<(String, f64)>,
    /// Number of storeys.
    pub storeys: Option<usize>,
    /// Height of the roof \[m\], for floors that are given by their elevation.
    pub height_m: Option<f64>,
    /// Whether floor 1 is the ground; `None`: the list decides.
    pub first_floor: Option<FirstFloor>,
}

/// What the name of a floor says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Storey {
    /// At or below the ground.
    Ground,
    /// A basement: like the ground, but it does not name the floor at street level.
    Below,
    Roof,
    /// The last storey, under the roof.
    Top,
    /// Half a storey above the ground.
    Mezzanine,
    /// This many storeys above the ground, for certain.
    Above(u32),
    /// A number of which the list must say whether 1 is the ground.
    Numbered(u32),
    /// A number where 1 is the ground.
    FromOne(u32),
}

/// Names of floors, `|` between two.
static NAMES: LazyLock<HashMap<&str, Storey>> = LazyLock::new(|| {
    by_word(&[
        (
            Storey::Ground,
            "zemin|zemin kat|terreo|res do chao|rez de chao|r c|giris kat|地面|g|gf|gr|ground|\
             ground floor|ground level|lobby|0|00|l0|eg|erdgeschoss|parterre|rdc|rez de chaussee|rez|r 0|pb|\
             planta baja|baja|pt|piano terra|terra|terreno|p 0|street level|main floor|地上|bajos|planta 0",
        ),
        (
            Storey::Top,
            "catı katı|sotao|dg|dachgeschoss|attic|penthouse|ph|combles|atico|attico",
        ),
        (
            Storey::Mezzanine,
            "mezzanine|mezz|m|zwischengeschoss|entresol|entresuelo|mezzanino|ammezzato",
        ),
    ])
});
const BELOW: &str = "bodrum|bodrum kat|subsolo|cave|below ground|lg|basement|lower ground|garage|cellar|ug|kg|\
    kellergeschoss|keller|untergeschoss|tiefgarage|sous sol|ss|sotano|seminterrato|interrato|地下|\
    lower ground floor|parking|semisotano|cantina|地下室";
const ROOF: &str = "catı cati telhado 屋顶 楼顶 roof rf dach toiture toit azotea cubierta copertura tetto 屋上 terraza";

/// What the name of a floor says; `None`: nothing known, or two floors: "basement/roof", "level 2 (roof of annex)".
pub(super) fn storey(text: &str) -> Option<Storey> {
    const BETWEEN: [&str; 8] = [
        " to ", " or ", " and ", " bis ", " oder ", " und ", " et ", " ou ",
    ];
    let parts = BETWEEN
        .iter()
        .fold(text.to_lowercase(), |text, word| text.replace(word, "/"));
    // "Basement - level 3", but not "level - 1".
    let by_strokes: Vec<&str> = parts.split(" - ").collect();
    let parts = by_strokes.iter().skip(1).fold(
        by_strokes.first().copied().unwrap_or_default().to_owned(),
        |all, part| {
            all + if part.starts_with(char::is_alphabetic) {
                "/"
            } else {
                " - "
            } + part
        },
    );
    let mut named = parts
        .split(['/', '(', ',', ';', '&'])
        .filter_map(one_storey);
    let at_ground = |one| match one {
        Storey::Below => Storey::Ground,
        _ => one,
    };
    let first = named.next().map(at_ground);
    if named.any(|other| Some(at_ground(other)) != first) {
        return None;
    }
    one_storey(text)
}

fn one_storey(text: &str) -> Option<Storey> {
    let text = text.trim();
    let words = canonical(text);
    let is_digit = |c: char| c.is_ascii_digit();
    if let Some(depth) = text.strip_prefix(['-', '\u{2212}']).map(str::trim) {
        return depth.starts_with(is_digit).then_some(Storey::Below);
    }
    // "Level -1" is below the ground; "L-1" and "Level - 1" may be either.
    if let Some((before, after)) = text.split_once(['-', '\u{2212}'])
        && after.trim_start().starts_with(is_digit)
        && is_level_word(before)
    {
        let is_sign = before.ends_with(' ') && after.starts_with(is_digit);
        return is_sign.then_some(Storey::Below);
    }
    // "R-1" is the first basement of a French building, whose ground is R.
    if let Some(depth) = text
        .strip_prefix(['R', 'r'])
        .and_then(|rest| rest.trim_start().strip_prefix(['-', '\u{2212}']))
    {
        return depth
            .trim_start()
            .starts_with(is_digit)
            .then_some(Storey::Below);
    }
    if words.is_empty() {
        return None;
    }
    let w = words.as_str();
    if let Some(found) = NAMES.get(w) {
        return Some(*found);
    }
    let is_roof = w.split(' ').any(|word| is_among(word, ROOF))
        || ["屋上", "roof"].iter().any(|word| w.contains(word));
    let is_below = is_phrase(w, BELOW)
        || w.split(' ')
            .any(|word| is_among(word, "basement garage sotano seminterrato untergeschoss"))
        || w.starts_with("地下")
        || w.starts_with("sous sol");
    match (is_below, is_roof) {
        // "Garage roof"
        (true, true) => return None,
        (true, false) => return Some(Storey::Below),
        // "4th floor roof" may be the roof of a lower part.
        (false, true) if is_numbered_roof(w) => return None,
        // "any text with roof": the roof, not the storey under it.
        (false, true) => return Some(Storey::Roof),
        (false, false) => {}
    }
    if let Some(number) = ordinal(w) {
        return Some(Storey::Numbered(number));
    }
    numbered(text, w)
}

/// Whether the words beside that for a roof are the name of a floor.
fn is_numbered_roof(words: &str) -> bool {
    let rest: Vec<&str> = words
        .split(' ')
        .filter(|word| !is_among(word, ROOF) && !word.contains("roof"))
        .collect();
    rest.len() < words.split(' ').count() && one_storey(&rest.join(" ")).is_some()
}

/// Whether a text is only a word for a floor.
fn is_level_word(text: &str) -> bool {
    is_among(
        &canonical(text),
        "l lv lvl level floor fl f storey story etage niveau ebene kat piso planta nivel piano livello andar",
    )
}

/// The number of `first`, `Second floor`, `erster Stock`.
fn ordinal(words: &str) -> Option<u32> {
    static ORDINALS: LazyLock<HashMap<&str, u32>> = LazyLock::new(|| {
        by_word(&[
            (
                1,
                "first|erste|erster|erstes|premier|primer|primera|primo|primeiro|birinci",
            ),
            (
                2,
                "second|zweite|zweiter|zweites|deuxieme|segundo|segunda|secondo|ikinci",
            ),
            (
                3,
                "third|dritte|dritter|drittes|troisieme|tercer|tercera|terzo|terceiro|ucuncu",
            ),
            (
                4,
                "fourth|vierte|vierter|viertes|quatrieme|cuarto|cuarta|quarto|dorduncu",
            ),
            (5, "fifth|funfte|funfter|cinquieme|quinto|quinta|besinci"),
            (
                6,
                "sixth|sechste|sechster|sixieme|sexto|sexta|sesto|altıncı",
            ),
            (
                7,
                "seventh|siebte|siebter|septieme|septimo|septima|settimo|yedinci",
            ),
            (
                8,
                "eighth|achte|achter|huitieme|octavo|octava|ottavo|sekizinci",
            ),
            (
                9,
                "ninth|neunte|neunter|neuvieme|noveno|novena|nono|dokuzuncu",
            ),
            (10, "tenth|zehnte|zehnter|dixieme|decimo|decima|onuncu"),
        ])
    });
    let (first, rest) = words.split_once(' ').unwrap_or((words, ""));
    let is_floor =
        rest.is_empty() || is_level_word(rest) || is_among(rest, "stock stockwerk obergeschoss");
    ORDINALS.get(first).copied().filter(|_| is_floor)
}

/// `3`, `L3`, `Level 3`, `3rd`, `2nd floor`, `3. OG`, `R+3`, `3e étage`, `planta 3`, `3° piano`,
/// `3F`, `3階`, `B1`.
fn numbered(text: &str, words: &str) -> Option<Storey> {
    let start = words.find(|c: char| c.is_ascii_digit())?;
    let rest = words.get(start..)?;
    let length = rest.bytes().take_while(u8::is_ascii_digit).count();
    let number: u32 = rest
        .get(..length)?
        .parse()
        .ok()
        .filter(|number| *number <= 300)?;
    let (before, after) = (words.get(..start)?.trim(), rest.get(length..)?.trim());
    // A second number: "3 or 4", "3.12", a date.
    if after.chars().any(|c| c.is_ascii_digit()) || text.contains("½") {
        return None;
    }
    // "3E" may be a wing in the east.
    if (before, after) == ("", "e") && !text.contains(&format!("{}e", &rest[..length])) {
        return None;
    }
    let is_it = |(in_front, behind, _): &&NumberForm| {
        before.is_empty() && is_phrase(after, behind)
            || after.is_empty() && !before.is_empty() && is_phrase(before, in_front)
    };
    let (.., found) = NUMBERED.iter().find(is_it)?;
    Some(match found(number) {
        Storey::Below => Storey::Below,
        _ if number == 0 => Storey::Ground,
        found => found,
    })
}

type NumberForm = (&'static str, &'static str, fn(u32) -> Storey);

/// Words in front of a number and behind it, `|` between two, and what the number then is.
const NUMBERED: [NumberForm; 4] = [
    (
        "b|ug|basement|sotano|sous sol|u|sub",
        "ug|untergeschoss|u g|sous sol|sotano",
        |_| Storey::Below,
    ),
    (
        "og|obergeschoss|r|etage|kat|andar|piano|planta",
        "og|o g|obergeschoss|ober|e|e etage|er etage|eme etage|ere etage|ieme etage|etage|stock|stockwerk|er|eme|\
         ere|ieme|kat|o andar|andar|a kat|o piano|piano|a planta|planta",
        Storey::Above,
    ),
    ("", "階|f階|楼|层|樓|层楼", Storey::FromOne),
    (
        "l|lv|lvl|level|floor|fl|flr|f|storey|story|no|geschoss|stock|niveau|niv|n|piso|nivel|livello|floor no",
        "|st|nd|rd|th|o|a|f|fl|flr|floor|level|storey|story|st floor|nd floor|rd floor|th floor|st fl|nd fl|rd fl|\
         th fl|st flr|nd flr|rd flr|th flr|st level|nd level|rd level|th level|geschoss|piso|o piso|livello|niveau|\
         st storey|nd storey|rd storey|th storey",
        Storey::Numbered,
    ),
];

/// The form in which names of floors are compared: without case, blanks, and the words for a floor.
fn bare(text: &str) -> String {
    let words = canonical(text);
    let kept: Vec<&str> = words
        .split(' ')
        .filter(|word| !matches!(*word, "floor" | "level" | "storey" | "story" | "l" | "f"))
        .collect();
    let joined = kept.concat();
    // L3 and 3F are 3.
    let rest = joined
        .strip_prefix('l')
        .or_else(|| joined.strip_suffix('f'));
    match rest {
        Some(rest) if !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_digit()) => {
            rest.to_owned()
        }
        _ if joined.is_empty() => words,
        _ => joined,
    }
}

/// Finds the height of floors by their names.
#[derive(Debug)]
pub(super) struct FloorFinder {
    names: HashMap<String, f64>,
    storeys: Option<usize>,
    first: FirstFloor,
    /// Whether nothing in the list or the study says that floor 1 is above the ground.
    is_assumed: bool,
}

/// The height of a floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Found {
    /// Over the height of the building; with a doubt whether floor 1 is the ground.
    Ratio(f64, bool),
    /// Neither named nor understood, or above the roof.
    Unknown,
    /// Nothing says how many storeys there are.
    NoStoreys,
}

impl FloorFinder {
    /// `named` are the floors of the list; `is_imperial`: it is in feet or inches; `is_japanese`:
    /// its headings are.
    pub(super) fn new(
        floors: &Floors,
        list: &[String],
        is_imperial: bool,
        is_japanese: bool,
    ) -> Self {
        let names_ground = list.iter().any(|text| storey(text) == Some(Storey::Ground));
        let (first, is_assumed) = match floors.first_floor {
            Some(first) => (first, false),
            None if is_japanese => (FirstFloor::Ground, false),
            None if names_ground => (FirstFloor::Above, false),
            None if is_imperial => (FirstFloor::Ground, false),
            None => (FirstFloor::Above, true),
        };
        let names = floors
            .named
            .iter()
            .map(|(name, ratio)| (bare(name), *ratio))
            .collect();
        Self {
            names,
            storeys: floors.storeys.filter(|storeys| *storeys > 0),
            first,
            is_assumed,
        }
    }

    /// The storeys between the ground and a floor with this number.
    fn above_ground(&self, number: u32) -> u32 {
        match self.first {
            FirstFloor::Ground => number.saturating_sub(1),
            FirstFloor::Above => number,
        }
    }

    /// What tells this floor from the others of its building; `None`: its name is not understood. "Level 6",
    /// "L6" and "6" are one floor.
    pub(super) fn identity(&self, text: &str) -> Option<(u8, u32)> {
        Some(match storey(text)? {
            Storey::Ground => (0, 0),
            Storey::Below => {
                let digits: String = text.chars().filter(char::is_ascii_digit).collect();
                (1, digits.parse().unwrap_or(0))
            }
            Storey::Roof => (2, 0),
            Storey::Top => (3, 0),
            Storey::Mezzanine => (4, 0),
            Storey::Above(number) => (5, number),
            Storey::FromOne(number) => (5, number.saturating_sub(1)),
            Storey::Numbered(number) => (5, self.above_ground(number)),
        })
    }

    /// Whether the building or a mapping file gives its height.
    pub(super) fn names(&self, text: &str) -> bool {
        self.names.contains_key(&bare(text))
    }

    /// The height of a floor over that of the building.
    pub(super) fn find(&self, text: &str) -> Found {
        if let Some(ratio) = self.names.get(&bare(text)) {
            return Found::Ratio(*ratio, false);
        }
        let Some(storey) = storey(text) else {
            return Found::Unknown;
        };
        match storey {
            Storey::Ground | Storey::Below => return Found::Ratio(0.0, false),
            Storey::Roof => return Found::Ratio(1.0, false),
            _ => {}
        }
        let Some(storeys) = self.storeys else {
            // A building that is known by name has no other floors.
            return if self.names.is_empty() {
                Found::NoStoreys
            } else {
                Found::Unknown
            };
        };
        let share = |height: f64| Found::Ratio(height / storeys as f64, false);
        let (number, is_assumed) = match storey {
            Storey::Top => return share((storeys - 1) as f64),
            Storey::Mezzanine => return share(0.5),
            Storey::FromOne(number) => (number.saturating_sub(1), false),
            Storey::Numbered(number) => (
                self.above_ground(number),
                self.is_assumed && self.first == FirstFloor::Above,
            ),
            Storey::Above(number) => (number, false),
            Storey::Ground | Storey::Below | Storey::Roof => (0, false),
        };
        if number as usize > storeys {
            return Found::Unknown;
        }
        Found::Ratio(f64::from(number) / storeys as f64, is_assumed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_floors() {
        use Storey::{Above, Below, FromOne, Ground, Mezzanine, Numbered, Roof, Top};
        for (text, expected) in [
            ("G", Some(Ground)),
            ("Ground floor", Some(Ground)),
            ("EG", Some(Ground)),
            ("RDC", Some(Ground)),
            ("Rez-de-chaussée", Some(Ground)),
            ("Planta baja", Some(Ground)),
            ("Piano terra", Some(Ground)),
            ("0", Some(Ground)),
            ("B1", Some(Below)),
            ("-1", Some(Below)),
            ("Level -1", Some(Below)),
            ("Level \u{2212}2", Some(Below)),
            ("L-1", None),
            ("Level - 1", None),
            ("basement", Some(Below)),
            ("first", Some(Numbered(1))),
            ("Second floor", Some(Numbered(2))),
            ("first aid room", None),
            ("Zemin kat", Some(Ground)),
            ("3. kat", Some(Above(3))),
            ("3º andar", Some(Above(3))),
            ("3楼", Some(FromOne(3))),
            ("çatı", Some(Roof)),
            ("1. UG", Some(Below)),
            ("Sous-sol", Some(Below)),
            ("地下1階", Some(Below)),
            ("Basement 2", Some(Below)),
            ("Roof", Some(Roof)),
            ("Roof level", Some(Roof)),
            ("屋上", Some(Roof)),
            ("DG", Some(Top)),
            ("Mezzanine", Some(Mezzanine)),
            ("3", Some(Numbered(3))),
            ("03", Some(Numbered(3))),
            ("L3", Some(Numbered(3))),
            ("Lvl 3", Some(Numbered(3))),
            ("Level 3", Some(Numbered(3))),
            ("3rd", Some(Numbered(3))),
            ("2nd floor", Some(Numbered(2))),
            ("3F", Some(Numbered(3))),
            ("3. OG", Some(Above(3))),
            ("3. Obergeschoss", Some(Above(3))),
            ("R+3", Some(Above(3))),
            ("3e étage", Some(Above(3))),
            ("1er étage", Some(Above(1))),
            ("3e", Some(Above(3))),
            ("2ème", Some(Above(2))),
            // A wing in the east.
            ("3E", None),
            ("3 e", None),
            ("planta 3", Some(Above(3))),
            ("3ª planta", Some(Above(3))),
            ("piano 3", Some(Above(3))),
            ("3° piano", Some(Above(3))),
            ("3階", Some(FromOne(3))),
            ("north wing", None),
            ("3.12", None),
            ("3 or 4", None),
            ("Annex upper", None),
            ("R-1", Some(Below)),
            ("R - 2", Some(Below)),
            ("-1", Some(Below)),
            ("UG1", Some(Below)),
            ("S-1", None),
            ("3/F", Some(Numbered(3))),
            ("Ground floor, garage", Some(Below)),
            // Two floors are none.
            ("basement/roof", None),
            ("basement - level 3", None),
            ("level 2 rooftop", None),
            ("garage roof", None),
            ("4th floor roof", None),
            ("Roof, block 2", Some(Roof)),
            ("level 2 (roof of annex)", None),
            ("basement to level 3", None),
            ("1/2", None),
            ("1-2", None),
            ("1 or 2", None),
            ("ground/first", None),
        ] {
            assert_eq!(storey(text), expected, "{text}");
        }
    }

    #[test]
    fn floors_are_shares_of_the_height() {
        let six = Floors {
            storeys: Some(6),
            ..Floors::default()
        };
        let found = |floors: &Floors, list: &[&str], imperial, text: &str| {
            let list: Vec<String> = list.iter().map(|&text| text.to_owned()).collect();
            FloorFinder::new(floors, &list, imperial, false).find(text)
        };
        assert_eq!(
            found(&six, &["G", "3"], false, "3"),
            Found::Ratio(0.5, false)
        );
        assert_eq!(found(&six, &["3"], false, "3"), Found::Ratio(0.5, true));
        assert_eq!(
            found(&six, &["1", "4"], true, "4"),
            Found::Ratio(0.5, false)
        );
        assert_eq!(found(&six, &[], false, "7"), Found::Unknown);
        assert_eq!(
            found(&six, &[], false, "DG"),
            Found::Ratio(5.0 / 6.0, false)
        );
        let settled = Floors {
            first_floor: Some(FirstFloor::Ground),
            ..six
        };
        assert_eq!(
            found(&settled, &["3"], false, "4"),
            Found::Ratio(0.5, false)
        );
        let table = Floors {
            named: vec![("Lobby".to_owned(), 0.0), ("L2".to_owned(), 0.4)],
            ..Floors::default()
        };
        assert_eq!(
            found(&table, &[], false, "level 2"),
            Found::Ratio(0.4, false)
        );
        assert_eq!(found(&table, &[], false, "LOBBY"), Found::Ratio(0.0, false));
        assert_eq!(found(&table, &[], false, "5"), Found::Unknown);
        assert_eq!(found(&Floors::default(), &[], false, "5"), Found::NoStoreys);
    }
}
