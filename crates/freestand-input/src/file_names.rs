//! Names of files and folders that every system can have: Linux, macOS and Windows, also where a disk of
//! one is read by another.

use std::collections::HashSet;

use unicode_normalization::UnicodeNormalization;

/// The longest name \[bytes\]. Most file systems have 255; the rest is for what is added to a name: an
/// ending, a number, and the mark of a file that is not complete.
pub const LONGEST: usize = 200;

/// Why no file or folder should have this name; `None`: it can be used everywhere.
///
/// # Example
/// ```
/// use freestand_input::file_names::unfit;
/// assert_eq!(unfit("Bogotá 2"), None);
/// assert!(unfit("NUL.txt").is_some());
/// ```
pub fn unfit(name: &str) -> Option<&'static str> {
    let is_fine = |letter: char| letter.is_alphanumeric() || " -_.".contains(letter);
    if name.is_empty() {
        Some("a name is missing")
    } else if !name.chars().all(is_fine) {
        Some("it has a letter that some systems do not have in names of files")
    } else if name.len() > LONGEST {
        Some("it is too long for the name of a file")
    } else if name.starts_with(['.', ' ']) || name.ends_with(['.', ' ']) {
        Some("it begins or ends with a dot or a space")
    } else if is_device(name) {
        Some("Windows keeps this name for a device")
    } else {
        None
    }
}

/// The text as a name that can be used everywhere: what is neither a letter, a digit nor one of `also`
/// becomes `instead`. `None`: nothing is left of it. Of a long text the end is kept: it says what the
/// file is, and differs most often.
///
/// # Example
/// ```
/// use freestand_input::file_names::made_of;
/// assert_eq!(made_of("a:b/c", "-_.", '-').as_deref(), Some("a-b-c"));
/// assert_eq!(made_of("..", "-_.", '-'), None);
/// ```
pub fn made_of(text: &str, also: &str, instead: char) -> Option<String> {
    let is_fine = |letter: char| letter.is_alphanumeric() || also.contains(letter);
    let plain: String = text
        .chars()
        .map(|letter| if is_fine(letter) { letter } else { instead })
        .collect();
    let is_edge = |letter: char| ['.', ' ', '-'].contains(&letter);
    let plain = plain.trim_matches(is_edge);
    let from = plain
        .char_indices()
        .map(|(at, _)| at)
        // One byte is for what a device's name gets.
        .find(|at| plain.len() - at < LONGEST)
        .unwrap_or(plain.len());
    let short = plain[from..].trim_start_matches(is_edge);
    if short.is_empty() {
        return None;
    }
    let stem = stem(short);
    Some(if is_device(short) {
        format!("{stem}{instead}{}", &short[stem.len()..])
    } else {
        short.to_owned()
    })
}

/// The most letters of [`of_words`].
const MOST_LETTERS: usize = 60;

/// A name made of the words of a text: its letters and digits, with a hyphen in place of everything else;
/// `unnamed` where nothing is left.
///
/// # Example
/// ```
/// use freestand_input::file_names::of_words;
/// assert_eq!(of_words("Level 3, ICU"), "Level-3-ICU");
/// assert_eq!(of_words("../x"), "x");
/// assert_eq!(of_words("CON"), "CON-");
/// assert_eq!(of_words("//"), "unnamed");
/// ```
pub fn of_words(text: &str) -> String {
    let words = text.split(|letter: char| !letter.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    let name: String = words.join("-").chars().take(MOST_LETTERS).collect();
    made_of(&name, "-", '-').unwrap_or_else(|| "unnamed".to_owned())
}

/// The name, or the name with the first free number from 2. Names that mean one file on some system are
/// equal.
///
/// # Example
/// ```
/// use freestand_input::file_names::unique;
/// let mut taken = std::collections::HashSet::new();
/// let names = ["Roof", "roof", "floor"].map(|name| unique(name, &mut taken));
/// assert_eq!(names, ["Roof", "roof-2", "floor"]);
/// ```
pub fn unique(name: &str, taken: &mut HashSet<String>) -> String {
    let mut candidate = name.to_owned();
    let mut number = 2;
    while !taken.insert(same_file(&candidate)) {
        candidate = format!("{name}-{number}");
        number += 1;
    }
    candidate
}

/// What two names have in common that mean one file on some system: there, capitals do not count, and
/// neither does how an accent is written.
///
/// # Example
/// ```
/// use freestand_input::file_names::same_file;
/// assert_eq!(same_file("Bogotá"), same_file("BOGOTA\u{301}"));
/// ```
pub fn same_file(name: &str) -> String {
    name.to_lowercase().nfc().collect()
}

/// The name before its first dot.
fn stem(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// Names that Windows keeps for devices, with any ending ("Naming Files, Paths, and Namespaces",
/// Microsoft): the digits of COM and LPT may be raised ones.
fn is_device(name: &str) -> bool {
    let stem = stem(name).trim_end().to_ascii_lowercase();
    let is_numbered = |device: &str| {
        let number = stem.strip_prefix(device);
        number.is_some_and(|number| {
            let mut letters = number.chars();
            let first = letters.next();
            first.is_some_and(|one| one.is_ascii_digit() || "¹²³".contains(one))
                && letters.next().is_none()
        })
    };
    ["con", "prn", "aux", "nul"].contains(&stem.as_str())
        || is_numbered("com")
        || is_numbered("lpt")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A text, whether it can be a name as it is, and the name that is made of it.
    const CASES: [(&str, bool, Option<&str>); 37] = [
        ("Messina", true, Some("Messina")),
        ("Bogotá 2", true, Some("Bogotá 2")),
        ("a.b", true, Some("a.b")),
        ("仙台", true, Some("仙台")),
        ("comet", true, Some("comet")),
        ("auxiliary", true, Some("auxiliary")),
        ("COM10", true, Some("COM10")),
        ("LPT", true, Some("LPT")),
        ("", false, None),
        (".", false, None),
        ("..", false, None),
        (" ", false, None),
        ("CON", false, Some("CON_")),
        ("con", false, Some("con_")),
        ("Con.AT2", false, Some("Con_.AT2")),
        ("con .txt", false, Some("con _.txt")),
        ("NUL.tar.gz", false, Some("NUL_.tar.gz")),
        ("prn.csv", false, Some("prn_.csv")),
        ("aux", false, Some("aux_")),
        ("COM1", false, Some("COM1_")),
        ("COM0", false, Some("COM0_")),
        ("com¹", false, Some("com¹_")),
        ("lpt9.x", false, Some("lpt9_.x")),
        ("CON.", false, Some("CON_")),
        ("a ", false, Some("a")),
        ("a.", false, Some("a")),
        (" a", false, Some("a")),
        (".a", false, Some("a")),
        ("a. .", false, Some("a")),
        ("a:b", false, Some("a_b")),
        ("a\\b", false, Some("a_b")),
        ("a/b", false, Some("a_b")),
        ("../a", false, Some("_a")),
        ("a*", false, Some("a_")),
        ("a?", false, Some("a_")),
        ("a<b>|\"", false, Some("a_b___")),
        ("a\r\nb\0", false, Some("a__b_")),
    ];

    #[test]
    fn a_name_can_be_used_everywhere() {
        for (text, is_fit, made) in CASES {
            assert_eq!(unfit(text).is_none(), is_fit, "{text:?}");
            let found = made_of(text, " -_.", '_');
            assert_eq!(found.as_deref(), made, "{text:?}");
            if let Some(name) = found {
                assert_eq!(unfit(&name), None, "{text:?}");
            }
        }
    }

    #[test]
    fn a_long_name_is_cut_between_letters_and_keeps_its_end() {
        for letter in ["x", "é", "仙", "🏛a"] {
            let long = format!("{}.csv", letter.repeat(300));
            assert!(unfit(&long).is_some());
            let made = made_of(&long, " -_.", '_').unwrap();
            assert_eq!(unfit(&made), None, "{made}");
            assert!(made.ends_with(".csv") && made.len() > LONGEST - 5, "{made}");
        }
        // What the cut leaves at the start is a device.
        let made = made_of(&format!("xcon.{}", "a".repeat(LONGEST - 5)), ".", '_').unwrap();
        assert_eq!((unfit(&made), made.len()), (None, LONGEST), "{made}");
    }

    #[test]
    fn names_that_are_one_file_somewhere_are_equal() {
        for (one, other, is_same) in [
            ("Roof", "roof", true),
            ("BOGOTÁ", "bogotá", true),
            ("a\u{301}", "á", true),
            ("a", "á", false),
            ("a", "a ", false),
        ] {
            assert_eq!(same_file(one) == same_file(other), is_same, "{one} {other}");
        }
    }
}
