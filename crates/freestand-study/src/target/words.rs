//! The words, and which of them belong to which code.

use std::path::Path;

use super::{Target, TargetProblem, codes, table};
use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, parse_grid, parse_positive, shorten};
use freestand_input::words::nearest;

/// The words that describe a spectrum; the same in flags (`--hazard-factor`) and in studies (`hazard_factor`), but for
/// `return_period_years`, which is `--return-period`.
pub const TARGET_KEYS: [&str; 22] = [
    "code",
    "edition",
    "site",
    "city",
    "hazard_factor",
    "return_period_years",
    "spectrum_type",
    "ground_acceleration",
    "importance_factor",
    "soil_factor",
    "corner_periods",
    "sds",
    "sd1",
    "ss",
    "s1",
    "fa",
    "fv",
    "long_period",
    "fault_distance",
    "spectrum",
    "interpolation",
    "beyond",
];

/// The codes by the names that people give them, in lower case and without spaces, `-` and `_`; the first is ours.
pub(super) const CODES: [(&[&str], Code); 5] = [
    (&["as1170.4", "as1170"], Code::As1170_4),
    (&["eurocode8", "ec8", "en1998", "en19981"], Code::Eurocode8),
    (&["asce7", "asce"], Code::Asce7),
    (&["nzs1170.5", "nzs1170"], Code::Nzs1170_5),
    (&["table"], Code::Table),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Code {
    As1170_4,
    Eurocode8,
    Asce7,
    Nzs1170_5,
    Table,
}

impl Code {
    pub(super) fn name(self) -> &'static str {
        CODES.iter().find(|(_, code)| *code == self).and_then(|(names, _)| names.first().copied()).unwrap_or_default()
    }

    fn title(self) -> &'static str {
        match self {
            Self::As1170_4 => "AS 1170.4",
            Self::Eurocode8 => "Eurocode 8",
            Self::Asce7 => "ASCE 7",
            Self::Nzs1170_5 => "NZS 1170.5",
            Self::Table => "a table of the user",
        }
    }

    /// The words that it takes, beside `code`.
    pub(super) fn keys(self) -> &'static [&'static str] {
        match self {
            Self::As1170_4 => &["edition", "site", "city", "hazard_factor", "return_period_years"],
            Self::Eurocode8 => &[
                "edition",
                "site",
                "spectrum_type",
                "ground_acceleration",
                "importance_factor",
                "soil_factor",
                "corner_periods",
            ],
            Self::Asce7 => &["edition", "sds", "sd1", "ss", "s1", "fa", "fv", "long_period"],
            Self::Nzs1170_5 => &["edition", "site", "hazard_factor", "return_period_years", "fault_distance"],
            Self::Table => &["spectrum", "interpolation", "beyond"],
        }
    }
}

/// A spectrum as written: values with their units, by [`TARGET_KEYS`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TargetWords {
    style: KeyStyle,
    entries: Vec<(&'static str, String)>,
}

impl TargetWords {
    /// No words yet.
    pub fn new(style: KeyStyle) -> Self {
        Self { style, entries: Vec::new() }
    }

    /// Adds a word, or puts it in place of what was said before.
    pub fn set(&mut self, key: &'static str, text: impl Into<String>) {
        self.entries.retain(|(name, _)| *name != key);
        self.entries.push((key, text.into()));
    }

    /// Whether nothing was said.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// A word.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.entries.iter().find(|(name, _)| *name == key).map(|(_, text)| text.as_str())
    }

    /// A key as the user writes it.
    pub fn name(&self, key: &str) -> String {
        match self.style {
            KeyStyle::File => key.to_owned(),
            KeyStyle::Flag => format!("--{}", key.trim_end_matches("_years").replace('_', "-")),
        }
    }

    /// A key and a value as the user writes them: `beyond = "hold"`, `--beyond hold`.
    pub fn example(&self, key: &str, value: &str) -> String {
        match self.style {
            KeyStyle::File => format!("{key} = \"{value}\""),
            KeyStyle::Flag if value.contains(' ') => format!("{} \"{value}\"", self.name(key)),
            KeyStyle::Flag => format!("{} {value}", self.name(key)),
        }
    }
}

/// Reads words and collects what is wrong with them.
pub(super) struct Reader<'w> {
    pub(super) words: &'w TargetWords,
    pub(super) base_dir: &'w Path,
    problems: Vec<TargetProblem>,
}

pub(super) fn resolve(words: &TargetWords, base_dir: &Path) -> Result<Target, Vec<TargetProblem>> {
    let mut reader = Reader { words, base_dir, problems: Vec::new() };
    let target = reader.code().and_then(|code| {
        reader.check_keys(code);
        match code {
            Code::As1170_4 => codes::as1170_4(&mut reader),
            Code::Eurocode8 => codes::eurocode8(&mut reader),
            Code::Asce7 => codes::asce7(&mut reader),
            Code::Nzs1170_5 => codes::nzs1170_5(&mut reader),
            Code::Table => table::table(&mut reader),
        }
    });
    match target {
        Some(target) if reader.problems.is_empty() => Ok(target),
        _ => Err(reader.problems),
    }
}

impl Reader<'_> {
    pub(super) fn note(&mut self, keys: &[&'static str], message: impl Into<String>, hint: impl Into<String>) {
        self.push(keys, Problem::new(ProblemKind::Value, message).hint(hint));
    }

    pub(super) fn push(&mut self, keys: &[&'static str], problem: Problem) {
        self.problems.push(TargetProblem { keys: keys.to_vec(), problem, is_missing: false });
    }

    pub(super) fn has_problems(&self) -> bool {
        !self.problems.is_empty()
    }

    /// The code: as named, a table where a file is named, else AS 1170.4.
    fn code(&mut self) -> Option<Code> {
        let Some(text) = self.words.get("code") else {
            return Some(if self.words.get("spectrum").is_some() { Code::Table } else { Code::As1170_4 });
        };
        let plain: String = text.to_lowercase().chars().filter(|c| !c.is_whitespace() && !"-_".contains(*c)).collect();
        let found = CODES.iter().find(|(names, _)| names.contains(&plain.as_str())).map(|(_, code)| *code);
        if found.is_none() {
            let names: Vec<&str> = CODES.iter().map(|(_, code)| code.name()).collect();
            let hint = format!("known: {}", names.join(", "));
            let message = format!("{} \"{}\" is not known", self.words.name("code"), shorten(text));
            self.note(&["code"], message, hint);
        }
        found
    }

    /// Refuses words that the code does not take.
    fn check_keys(&mut self, code: Code) {
        let strangers: Vec<&'static str> = self
            .words
            .entries
            .iter()
            .map(|(key, _)| *key)
            .filter(|key| *key != "code" && !code.keys().contains(key))
            .collect();
        for key in strangers {
            let takers: Vec<&str> =
                CODES.iter().filter(|(_, other)| other.keys().contains(&key)).map(|(_, other)| other.name()).collect();
            let message = format!("{} is no part of {}", self.words.name(key), code.title());
            let hint = if code == Code::Table || takers == ["table"] {
                format!("take a code, or a table with {}", self.words.name("spectrum"))
            } else {
                format!(
                    "leave it out, or name the code that has it: {}",
                    self.words.example("code", &takers.join(" or "))
                )
            };
            self.note(&[key], message, hint);
        }
    }

    pub(super) fn keep<T>(&mut self, key: &'static str, result: Result<T, Problem>) -> Option<T> {
        let name = self.words.name(key);
        result
            .map_err(|mut problem| {
                if !problem.message.starts_with(&name) {
                    problem.message = format!("{name}: {}", problem.message);
                }
                self.push(&[key], problem);
            })
            .ok()
    }

    /// A value above zero; `None` where it is missing or wrong.
    pub(super) fn positive(&mut self, key: &'static str, dimension: Dimension) -> Option<f64> {
        let result = parse_positive(self.words.get(key)?, dimension, &self.words.name(key));
        self.keep(key, result)
    }

    /// A value above zero that the code cannot do without.
    pub(super) fn needed(&mut self, key: &'static str, dimension: Dimension, code: Code, example: &str) -> Option<f64> {
        if self.words.get(key).is_none() {
            self.missing(key, code, example);
        }
        self.positive(key, dimension)
    }

    pub(super) fn missing(&mut self, key: &'static str, code: Code, example: &str) {
        let message = format!("{} needs {}", code.title(), self.words.name(key));
        let hint = format!("write {}", self.words.example(key, example));
        self.note(&[key, "code"], message, hint);
        self.problems.iter_mut().last().into_iter().for_each(|last| last.is_missing = true);
    }

    /// Periods, ascending or not.
    pub(super) fn periods(&mut self, key: &'static str) -> Option<Vec<f64>> {
        let result = parse_grid(self.words.get(key)?, Dimension::Time);
        self.keep(key, result)
    }

    /// A year or another whole number; one that is too large for its type is none of any table.
    pub(super) fn whole(&mut self, key: &'static str) -> Option<u32> {
        let text = self.words.get(key)?.trim();
        let digits = !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
        if !digits {
            let message = format!("{} must be a whole number, not \"{}\"", self.words.name(key), shorten(text));
            self.note(&[key], message, "write digits alone, without a sign, a point or a unit");
            return None;
        }
        Some(text.parse().unwrap_or(u32::MAX))
    }

    /// One of some words, whatever its capitals.
    pub(super) fn one_of<T: Copy>(&mut self, key: &'static str, known: &[(&'static str, T)], default: T) -> Option<T> {
        let Some(text) = self.words.get(key) else { return Some(default) };
        let plain = text.trim().to_lowercase();
        let found = known.iter().find(|(name, _)| *name == plain).map(|(_, value)| *value);
        if found.is_none() {
            let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
            let message = format!("{} \"{}\" is not known", self.words.name(key), shorten(text));
            let hint = match nearest(text, &names) {
                Some(near) => format!("did you mean {near}?"),
                None => format!("one of {}", names.join(", ")),
            };
            self.note(&[key], message, hint);
        }
        found
    }
}
