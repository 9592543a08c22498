//! One value in place of the study's, so that any value of a study can be varied.

use std::borrow::Cow;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// One value in place of the study's.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Table of the study.
    pub table: &'static str,
    /// Key in it.
    pub key: &'static str,
    /// The value, as a study writes it.
    pub value: String,
    /// Keys that it replaces.
    pub in_place_of: &'static [&'static str],
    /// The value is one of the default values and was not stated by the user.
    pub is_default: bool,
}

impl Change {
    /// `damping = 2 %`.
    pub fn words(&self) -> String {
        format!("{} = {}", self.key, self.value)
    }

    /// The value as a number of TOML, which has no `.5` and no `007`; `None` for a text.
    pub(super) fn number(&self) -> Option<String> {
        if let Ok(whole) = self.value.parse::<i64>() {
            return Some(whole.to_string());
        }
        let number = self.value.parse::<f64>().ok()?;
        number.is_finite().then(|| format!("{number:?}"))
    }

    /// Puts the value into a document in which `[table]`, if it is there, is a table; `number` is
    /// [`Change::number`].
    pub(super) fn put<'t>(&'t self, number: Option<&'t str>, document: &mut DeTable<'t>) {
        let key = |name: &'t str| Spanned::new(0..0, Cow::Borrowed(name));
        let table = document
            .entry(key(self.table))
            .or_insert_with(|| Spanned::new(0..0, DeValue::Table(DeTable::new())));
        let DeValue::Table(table) = table.get_mut() else {
            return;
        };
        // `damping_percent` and the like state the unit in the key.
        let is = |name: &str, key: &str| {
            name.strip_prefix(key)
                .is_some_and(|unit| unit.is_empty() || unit.starts_with('_'))
        };
        let goes =
            |name: &str| is(name, self.key) || self.in_place_of.iter().any(|other| is(name, other));
        let mut kept: DeTable = std::mem::take(table)
            .into_iter()
            .filter(|(name, _)| !goes(name.get_ref()))
            .collect();
        let value = match number.map(DeValue::parse) {
            Some(Ok(number)) => number.into_inner(),
            Some(Err(_)) | None => DeValue::String(Cow::Borrowed(&self.value)),
        };
        kept.insert(key(self.key), Spanned::new(0..0, value));
        *table = kept;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::parse;

    /// The keys that it replaces may also state a unit.
    #[test]
    fn a_value_takes_the_place_of_others_whatever_their_units() {
        let study = "[objects]\nmass_kg = 1\npad_stiffness_n_mm = 2190\npads_per_edge = 2\n";
        let change = Change {
            table: "objects",
            key: "stiffness",
            value: "5 kN/mm".to_owned(),
            in_place_of: &["pad_stiffness", "pads_per_edge"],
            is_default: false,
        };
        let (changed, problems) = parse(study, Some(&change), None);
        assert!(problems.is_empty(), "{problems}");
        let (written, _) = parse(
            "[objects]\nmass_kg = 1\nstiffness = \"5 kN/mm\"\n",
            None,
            None,
        );
        let texts = |objects: &crate::options::ObjectsOptions| {
            let words = &objects.cushion;
            (
                objects.mass_kg.as_ref().map(|mass| mass.value),
                format!("{:?}", words.entries().collect::<Vec<_>>()),
            )
        };
        assert_eq!(texts(&changed.objects), texts(&written.objects));
    }

    /// What is no number of TOML is one of the command line.
    #[test]
    fn numbers_are_those_of_a_person() {
        let change = |value: &str| Change {
            table: "ground",
            key: "seed",
            value: value.to_owned(),
            in_place_of: &[],
            is_default: false,
        };
        let seed = |value: &str| parse("", Some(&change(value)), None).0.ground.seed;
        assert_eq!(seed("007").map(|seed| seed.value), Some(7));
        assert_eq!(change(".5").number().as_deref(), Some("0.5"));
        assert_eq!(
            (change("2 %").number(), change("nan").number()),
            (None, None)
        );
    }
}
