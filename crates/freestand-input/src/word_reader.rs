//! Reads [`Words`] key by key: returns each value, or adds a problem under its key if the value is
//! wrong.

use std::fmt::Display;
use std::ops::{Bound, RangeBounds};
use std::str::FromStr;

use crate::keys::Words;
use crate::problem::{Problem, ProblemKind, Problems};
use crate::quantity::{Dimension, is_possible, parse, parse_grid, shorten, too_large};
use crate::words::{Choices, nearest, shortest};

/// Words, and their problems so far. A method returns `None` if the key is missing or its value is
/// wrong.
#[derive(Debug)]
pub struct WordReader<'w> {
    /// The values as written.
    pub words: &'w Words,
    /// The problems so far.
    pub problems: Problems,
    /// Keys whose values were asked for.
    asked: Vec<&'static str>,
}

impl<'w> WordReader<'w> {
    /// A reader that has not read any of these words.
    pub fn new(words: &'w Words) -> Self {
        Self {
            words,
            problems: Problems::default(),
            asked: Vec::new(),
        }
    }

    /// These keys are read elsewhere.
    pub fn pass(&mut self, keys: &[&'static str]) {
        self.asked.extend(keys);
    }

    /// Keys that were written and that nobody has asked for.
    pub fn unread(&self) -> Vec<&'static str> {
        let mut unread: Vec<&'static str> = Vec::new();
        for (key, _) in self.words.entries() {
            if !self.asked.contains(&key) && !unread.contains(&key) {
                unread.push(key);
            }
        }
        unread
    }

    /// Whether a key was written.
    pub fn has(&self, key: &str) -> bool {
        self.words.get(key).is_some()
    }

    /// Adds a problem with the values of some keys.
    pub fn note(
        &mut self,
        keys: &[&'static str],
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.problems.push(Problem::value(message, hint).of(keys));
    }

    /// Adds a problem with keys, the first of which is missing.
    pub fn missing(
        &mut self,
        keys: &[&'static str],
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.problems.push(
            Problem::new(ProblemKind::Missing, message)
                .hint(hint)
                .of(keys),
        );
    }

    /// Adds a problem if a key was not written.
    pub fn require(
        &mut self,
        key: &'static str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        if !self.has(key) {
            self.missing(&[key], message, hint);
        }
    }

    /// The value of a result; a problem is added under the key.
    pub fn keep<T>(&mut self, key: &'static str, result: Result<T, Problem>) -> Option<T> {
        self.problems.keep_named(key, result)
    }

    /// A text read by a function.
    pub fn read<T>(
        &mut self,
        key: &'static str,
        read: impl FnOnce(&str) -> Result<T, Problem>,
    ) -> Option<T> {
        let text = self.one(key)?;
        self.keep(key, read(text))
    }

    /// A text.
    pub fn text(&mut self, key: &'static str) -> Option<&'w str> {
        self.asked.push(key);
        self.words.get(key)
    }

    /// A text that is neither a list nor a table.
    pub fn one(&mut self, key: &'static str) -> Option<&'w str> {
        let text = self.text(key)?;
        if let Some(many) = self.words.many(key) {
            let message = format!("`{key}` must be one value, not {many}");
            self.note(&[key], message, "give one value");
            return None;
        }
        Some(text)
    }

    /// Whether a flag is set.
    pub fn flag(&mut self, key: &'static str) -> bool {
        match self.one(key) {
            None | Some("false") => false,
            Some("true") => true,
            Some(text) => {
                let message = format!("`{key}` must be true or false, not \"{}\"", shorten(text));
                self.note(&[key], message, "give one of them");
                false
            }
        }
    }

    /// A quantity: a text with its unit, or a bare number in SI of a program.
    pub fn quantity(&mut self, key: &'static str, dimension: Dimension) -> Option<f64> {
        let text = self.one(key)?;
        match *self.words.numbers(key) {
            [number] if is_possible(number) => Some(number),
            [number] => self.keep(key, Err(impossible(number))),
            _ => self.keep(key, parse(text, dimension)),
        }
    }

    /// Two quantities, `"0.3 m, 1.2 m"`; the hint says which.
    pub fn two(
        &mut self,
        key: &'static str,
        dimension: Dimension,
        hint: &str,
    ) -> Option<(f64, f64)> {
        let found = self.grid(key, dimension)?;
        let [first, second] = found[..] else {
            self.note(
                &[key],
                format!("`{key}` must be two values, not {}", found.len()),
                hint,
            );
            return None;
        };
        Some((first, second))
    }

    /// Adds a problem if both keys were written.
    pub fn exclusive(&mut self, first: &'static str, second: &'static str) {
        if self.has(first) && self.has(second) {
            let message = format!("`{first}` and `{second}` exclude each other");
            self.note(&[first, second], message, "keep one of them");
        }
    }

    /// A quantity that `accept` accepts. `expected` says what it must be: for the message, and for
    /// the hint, after words such as "give a length".
    pub fn accepted(
        &mut self,
        key: &'static str,
        dimension: Dimension,
        accept: impl Fn(f64) -> bool,
        expected: [&str; 2],
    ) -> Option<f64> {
        let value = self.quantity(key, dimension)?;
        if accept(value) {
            return Some(value);
        }
        let text = self.words.get(key).unwrap_or_default();
        self.refuse(key, text, dimension, expected);
        None
    }

    /// Adds a problem with a quantity that is none of the expected, as in [`Self::accepted`].
    pub fn refuse(
        &mut self,
        key: &'static str,
        text: &str,
        dimension: Dimension,
        [must_be, give]: [&str; 2],
    ) {
        let message = format!(
            "`{key}` must be {must_be}, not \"{}\"",
            shorten(text.trim())
        );
        let hint = format!("give {} {give}", dimension.with_article());
        self.note(&[key], message, hint);
    }

    /// A quantity above zero.
    pub fn positive(&mut self, key: &'static str, dimension: Dimension) -> Option<f64> {
        self.accepted(key, dimension, |value| value > 0.0, ["positive", "above 0"])
    }

    /// A quantity of zero or more.
    pub fn non_negative(&mut self, key: &'static str, dimension: Dimension) -> Option<f64> {
        self.accepted(
            key,
            dimension,
            |value| value >= 0.0,
            ["0 or more", "of 0 or more"],
        )
    }

    /// A share of a whole.
    pub fn share(&mut self, key: &'static str) -> Option<f64> {
        self.accepted(
            key,
            Dimension::Ratio,
            |value| (0.0..=1.0).contains(&value),
            ["from 0 to 100 %", "such as \"5 %\""],
        )
    }

    /// A grid or a list of quantities.
    pub fn grid(&mut self, key: &'static str, dimension: Dimension) -> Option<Vec<f64>> {
        let numbers = self.words.numbers(key);
        if let Some(number) = numbers.iter().find(|number| !is_possible(**number)) {
            let problem = impossible(*number);
            return self.keep(key, Err(problem));
        }
        if numbers.is_empty() {
            let text = self.text(key)?;
            return self.keep(key, parse_grid(text, dimension));
        }
        self.pass(&[key]);
        Some(numbers.to_vec())
    }

    /// A whole number.
    pub fn whole(&mut self, key: &'static str) -> Option<u32> {
        self.whole_within(key, 0..)
    }

    /// A whole number within limits.
    pub fn whole_within<T>(&mut self, key: &'static str, limits: impl RangeBounds<T>) -> Option<T>
    where
        T: FromStr + PartialOrd + Display,
    {
        let text = self.one(key)?.trim();
        if text.is_empty() || !text.chars().all(|c| c.is_ascii_digit()) {
            let message = format!("`{key}` must be a whole number, not \"{}\"", shorten(text));
            self.note(
                &[key],
                message,
                "write digits alone, without a sign, a point or a unit",
            );
            return None;
        }
        // Digits alone: what cannot be read is too large.
        let number: Option<T> = text.parse().ok();
        let is_read = number.is_some();
        let within = number.filter(|number| limits.contains(number));
        if within.is_none() {
            let must_be = match (limits.start_bound(), limits.end_bound()) {
                (Bound::Included(least), Bound::Included(most)) => format!("{least} to {most}"),
                (Bound::Included(least), _) if is_read => format!("{least} or more"),
                _ => "a smaller number".to_owned(),
            };
            let message = format!("`{key}` must be {must_be}, not {}", shorten(text));
            self.note(&[key], message, "give another number");
        }
        within
    }

    /// Adds a problem for each of these keys that was written: `why` says, as a clause, why it has no effect.
    pub fn idle(&mut self, keys: &[&'static str], why: &str) {
        for &key in keys {
            if self.has(key) {
                let message = format!("`{key}` has no effect: {why}");
                self.note(&[key], message, "leave it out");
            }
        }
    }

    /// One of these values, by its name.
    pub fn choice<T: Copy>(&mut self, key: &'static str, choices: Choices<T>) -> Option<T> {
        let known: Vec<(&str, T)> = choices
            .iter()
            .map(|&(value, name, _)| (name, value))
            .collect();
        self.one_of(key, &known)
    }

    /// One of the known names.
    pub fn name(&mut self, key: &'static str, known: &[&'static str]) -> Option<String> {
        let known: Vec<(&str, &str)> = known.iter().map(|&name| (name, name)).collect();
        self.one_of(key, &known).map(str::to_owned)
    }

    /// Any of these values, by their names, with commas between them or one by one.
    pub fn choices<T: Copy>(&mut self, key: &'static str, choices: Choices<T>) -> Vec<T> {
        self.pass(&[key]);
        let known: Vec<(&str, T)> = choices
            .iter()
            .map(|&(value, name, _)| (name, value))
            .collect();
        let words = self.words;
        let names = words.all(key).flat_map(|text| text.split(','));
        names
            .filter_map(|name| self.known(key, name, &known))
            .collect()
    }

    /// One of the known words; capitals are ignored.
    pub fn one_of<T: Copy>(&mut self, key: &'static str, known: &[(&str, T)]) -> Option<T> {
        let text = self.one(key)?;
        self.known(key, text, known)
    }

    fn known<T: Copy>(&mut self, key: &'static str, text: &str, known: &[(&str, T)]) -> Option<T> {
        let plain = text.trim().to_lowercase().replace(['_', ' '], "-");
        let found = known
            .iter()
            .find(|(name, _)| *name == plain)
            .map(|(_, value)| *value);
        if found.is_none() {
            let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
            let hint = match nearest(text, &names) {
                Some(near) => format!("did you mean {near}?"),
                None => format!("give one of {}", names.join(", ")),
            };
            self.note(
                &[key],
                format!("`{key}` \"{}\" is not known", shorten(text)),
                hint,
            );
        }
        found
    }
}

/// What is said of a number that no quantity has.
fn impossible(number: f64) -> Problem {
    if number.is_finite() {
        too_large(&shortest(number))
    } else {
        Problem::value(format!("{number} is not a finite number"), "give a number")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::written::Written;

    #[test]
    fn a_number_that_no_quantity_has() {
        let mut words = Words::default();
        words.write("height", &Written::Number(1e20));
        words.write("width", &Written::Number(f64::NAN));
        words.write("heights", &Written::List(vec![Written::Number(1e300)]));
        let mut reader = WordReader::new(&words);
        assert_eq!(reader.quantity("height", Dimension::Length), None);
        assert_eq!(reader.quantity("width", Dimension::Length), None);
        assert_eq!(reader.grid("heights", Dimension::Length), None);
        let found = reader.problems.problems.iter();
        let found: Vec<&str> = found.map(|one| one.message.as_str()).collect();
        assert_eq!(
            found,
            [
                "`height`: \"1e20\" is too large",
                "`width`: NaN is not a finite number",
                "`heights`: \"1e300\" is too large"
            ]
        );
    }

    #[test]
    fn every_wrong_value_is_a_problem_under_its_key() {
        let words: Words = [
            ("mass", "-2 kg"),
            ("uplift", "-1 mm"),
            ("stiffness", "4380"),
            ("count", "2.5"),
            ("window", "lamm"),
        ]
        .into_iter()
        .collect();
        let mut reader = WordReader::new(&words);
        assert_eq!(reader.positive("mass", Dimension::Mass), None);
        assert_eq!(reader.non_negative("uplift", Dimension::Length), None);
        assert_eq!(reader.positive("stiffness", Dimension::Stiffness), None);
        assert_eq!(reader.whole("count"), None);
        assert_eq!(
            reader.one_of("window", &[("lam", 1), ("saragoni-hart", 2)]),
            None
        );
        assert_eq!(reader.positive("height", Dimension::Length), None);
        let found: Vec<(&str, &str)> = reader
            .problems
            .problems
            .iter()
            .map(|one| (one.keys[0].as_ref(), one.message.as_str()))
            .collect();
        assert_eq!(
            found,
            [
                ("mass", "`mass` must be positive, not \"-2 kg\""),
                ("uplift", "`uplift` must be 0 or more, not \"-1 mm\""),
                ("stiffness", "`stiffness`: \"4380\" needs a unit"),
                ("count", "`count` must be a whole number, not \"2.5\""),
                ("window", "`window` \"lamm\" is not known"),
            ]
        );
    }
}
