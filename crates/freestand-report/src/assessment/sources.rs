//! The sources of the numbers of an assessment, counted row by row in bounded memory.

use std::collections::BTreeMap;

use super::table::Line;
use crate::restraint::force::{kind_words, source_name};

/// Sources that are counted separately; further ones are counted together.
const MAX_SOURCES: usize = 2_000;

/// Longest name of a source, in characters.
const MAX_SOURCE_CHARS: usize = 400;

/// What a number is, its source, and how far the source can be trusted.
type Key = (&'static str, String, &'static str);

/// Sources with the number of objects that use them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Sources {
    objects: BTreeMap<Key, usize>,
}

impl Sources {
    /// Counts the sources of one row.
    pub(super) fn add(&mut self, line: &Line) {
        if let Some(tolerance) = &line.item.tolerance {
            self.count(
                "tolerance",
                &tolerance.source,
                tolerance.confidence.description(),
            );
        }
        if let Some(source) = &line.item.cushion_source {
            self.count("cushion", source, "an estimate, not a measurement");
        }
        for force in line
            .assessment()
            .into_iter()
            .flat_map(|found| &found.restraint)
        {
            let source = &force.source;
            self.count(
                "restraint force",
                source_name(source),
                kind_words(source.kind),
            );
        }
    }

    /// What the number is, its source, its trust and the number of objects, in alphabetical order.
    pub(super) fn rows(&self) -> impl Iterator<Item = (&'static str, &str, &'static str, usize)> {
        self.objects
            .iter()
            .map(|((what, source, worth), count)| (*what, source.as_str(), *worth, *count))
    }

    fn count(&mut self, what: &'static str, source: &str, worth: &'static str) {
        let name: String = source.chars().take(MAX_SOURCE_CHARS).collect();
        let key = (what, name, worth);
        let key = if self.objects.len() < MAX_SOURCES || self.objects.contains_key(&key) {
            key
        } else {
            (what, "other sources".to_owned(), "see the objects")
        };
        *self.objects.entry(key).or_default() += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assessment::fixture::{inventory, item, rows};

    #[test]
    fn sources_are_counted_and_bounded() {
        let mut items: Vec<_> = (0..2_100).map(item).collect();
        for item in &mut items {
            item.cushion_source = Some(format!("pad {}", item.row));
        }
        let inventory = inventory(items);
        let mut sources = Sources::default();
        for row in &rows(&inventory, 2_100) {
            sources.add(&Line::of(row));
        }
        let found: Vec<_> = sources.rows().collect();
        // Some 2000 pads and the others together; a tolerance in three of four rows; the two
        // clauses were counted first.
        assert!(found.len() <= MAX_SOURCES + 1);
        let of = |what: &str| {
            found
                .iter()
                .filter(|row| row.0 == what)
                .map(|row| row.3)
                .sum::<usize>()
        };
        assert_eq!((of("tolerance"), of("cushion")), (1_575, 2_100));
        assert!(found.iter().any(|row| row.1 == "other sources"));
    }
}
