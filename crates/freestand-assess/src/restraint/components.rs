//! What an object is in the tables of ASCE 7: a generator has other factors than a cabinet.

use std::sync::LazyLock;

use freestand_input::words::canonical;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The name of the row for objects that are in no other.
const OTHER: &str = "other";

/// The word of a source whose values nobody has read.
const RECALLED: &str = "recalled";

/// A row of table 13.5-1 or 13.6-1.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// The name in flags.
    pub name: &'static str,
    /// The row of the table, shortened.
    pub title: &'static str,
    /// The number of the table.
    pub table: &'static str,
    /// a_p of ASCE 7-16.
    pub(super) amplification_ratio: f64,
    /// R_p of ASCE 7-16.
    pub(super) response_ratio: f64,
    /// Where a_p and R_p were read; `None`: recalled.
    pub source_16: Option<&'static str>,
    /// C_AR of ASCE 7-22, on or below the ground and above it.
    pub(super) resonance_ratios: [f64; 2],
    /// R_po of ASCE 7-22.
    pub(super) strength_ratio: f64,
    /// Ω₀p of ASCE 7-22.
    pub(super) overstrength_ratio: f64,
    /// Where C_AR, R_po and Ω₀p were read; `None`: recalled.
    pub source_22: Option<&'static str>,
    /// Words by which an item of a list is recognised, in the form that is compared.
    words: Vec<String>,
}

/// As its name.
impl Serialize for Component {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

impl<'de> Deserialize<'de> for &'static Component {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let mut rows = Component::all().iter();
        rows.find(|row| row.name == name).ok_or_else(|| {
            D::Error::custom(format!("\"{name}\" is no row of the tables of ASCE 7"))
        })
    }
}

impl Component {
    /// Every row, the one for all other objects last.
    pub fn all() -> &'static [Self] {
        static ROWS: LazyLock<Vec<Component>> = LazyLock::new(|| rows().filter_map(read).collect());
        &ROWS
    }

    /// The row for objects that are in no other: the smallest reduction, so the largest force of a
    /// rigid part.
    pub(crate) fn other() -> Option<&'static Self> {
        Self::all().iter().find(|row| row.name == OTHER)
    }

    /// Whether it is the row for objects that are in no other.
    pub(crate) fn is_other(&self) -> bool {
        self.name == OTHER
    }

    /// Whether it is a cabinet or a shelf, for which EN 1998-1 has a behaviour factor.
    pub(crate) fn is_cabinet(&self) -> bool {
        matches!(self.name, "cabinet" | "shelving")
    }

    /// The row with this name, or the one that these words describe: `generator`, `Emergency
    /// generator, 200 kVA`. The longest phrase of the table decides. `None` where no word is known.
    ///
    /// # Example
    /// ```
    /// use freestand_assess::restrain::Component;
    /// let name = |text| Component::find(text).map(|row| row.name);
    /// assert_eq!(name("Emergency generators"), Some("generator"));
    /// assert_eq!(name("Steel storage cabinet"), Some("cabinet"));
    /// assert_eq!(name("Instrument cabinet"), Some("switchgear"));
    /// assert_eq!(name("Statue"), None);
    /// ```
    pub fn find(text: &str) -> Option<&'static Self> {
        let text = compared(text);
        let by_name = Self::all().iter().find(|row| compared(row.name) == text);
        let phrases = Self::all()
            .iter()
            .flat_map(|row| row.words.iter().map(move |phrase| (row, phrase)));
        let found = phrases.filter(|(_, phrase)| text.contains(phrase.as_str()));
        // Of two phrases of one length the first row counts.
        let longest = found.reduce(|best, one| {
            if one.1.len() > best.1.len() {
                one
            } else {
                best
            }
        });
        by_name.or(longest.map(|(row, _)| row))
    }

    /// The names, for messages.
    pub fn names() -> String {
        let names: Vec<&str> = Self::all().iter().map(|row| row.name).collect();
        names.join(", ")
    }
}

/// The words of a text in singular, with a blank before and after each.
fn compared(text: &str) -> String {
    let text = canonical(text);
    let words = text
        .split(|letter: char| !letter.is_alphanumeric())
        .filter(|word| !word.is_empty());
    let singular = |word: &str| match word.strip_suffix('s') {
        Some(stem) if stem.len() > 2 && !stem.ends_with('s') => stem.to_owned(),
        _ => word.to_owned(),
    };
    words.fold(" ".to_owned(), |all, word| all + &singular(word) + " ")
}

/// The rows of the table.
fn rows() -> impl Iterator<Item = &'static str> {
    include_str!("components.csv")
        .lines()
        .filter(|line| !line.starts_with('#') && !line.is_empty())
}

fn read(row: &'static str) -> Option<Component> {
    let fields: Vec<&str> = row.split(';').map(str::trim).collect();
    let &[
        name,
        title,
        table,
        of_16,
        source_16,
        of_22,
        source_22,
        words,
    ] = fields.as_slice()
    else {
        return None;
    };
    let numbers = |text: &str| -> Vec<f64> {
        text.split(',')
            .filter_map(|value| value.trim().parse().ok())
            .collect()
    };
    let source = |text: &'static str| Some(text).filter(|text| *text != RECALLED);
    let (
        &[amplification_ratio, response_ratio],
        &[on_ground, above, strength_ratio, overstrength_ratio],
    ) = (numbers(of_16).as_slice(), numbers(of_22).as_slice())
    else {
        return None;
    };
    Some(Component {
        name,
        title,
        table,
        amplification_ratio,
        response_ratio,
        source_16: source(source_16),
        resonance_ratios: [on_ground, above],
        strength_ratio,
        overstrength_ratio,
        source_22: source(source_22),
        words: words
            .split(',')
            .filter(|word| !word.trim().is_empty())
            .map(compared)
            .collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No row is dropped silently, every factor is usable, and no two rows share a word.
    #[test]
    fn the_table_is_whole() {
        let all = Component::all();
        assert_eq!(all.len(), rows().count());
        assert!(Component::other().is_some_and(Component::is_other));
        let mut words: Vec<&String> = all.iter().flat_map(|row| &row.words).collect();
        let count = words.len();
        words.sort();
        words.dedup();
        assert_eq!(words.len(), count, "a word in two rows");
        for row in all {
            let factors = [
                row.amplification_ratio,
                row.response_ratio,
                row.strength_ratio,
                row.overstrength_ratio,
            ];
            assert!(
                factors
                    .iter()
                    .chain(&row.resonance_ratios)
                    .all(|factor| (1.0..=6.0).contains(factor)),
                "{row:?}"
            );
            assert_eq!(
                Component::find(row.name).map(|found| found.name),
                Some(row.name)
            );
        }
    }

    /// ASCE 7-10, table 13.6-1, as it is published.
    #[test]
    fn rows_of_table_13_6_1() {
        for (item, factors) in [
            ("Diesel generator", [1.0, 2.5]),
            ("UPS", [1.0, 2.5]),
            ("Main switchgear", [2.5, 6.0]),
            ("Spring-mounted chiller", [2.5, 2.0]),
            ("Air handling unit 3", [2.5, 6.0]),
            ("Server", [1.0, 2.5]),
        ] {
            let row = Component::find(item).unwrap();
            assert_eq!(
                [row.amplification_ratio, row.response_ratio],
                factors,
                "{item}"
            );
        }
        assert_eq!(Component::find("upset vase"), None);
    }
}
