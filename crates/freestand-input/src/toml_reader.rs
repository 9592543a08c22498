//! Reads a TOML text value by value, each with its line, and collects problems.

use std::collections::HashSet;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::keys::KeyStyle;
use crate::problem::{Problem, ProblemKind, Problems};
use crate::quantity::{self, Dimension, Unit};
use crate::words::{counted, nearest};

/// The largest number of lines that are not TOML that are named one by one: a file of another kind
/// has thousands.
const MAX_TOLD: usize = 20;

/// A value and its line.
#[derive(Debug, Clone, PartialEq)]
pub struct Written<T> {
    /// The value.
    pub value: T,
    /// Its line, counted from 1.
    pub line: usize,
}

impl<T> Written<T> {
    /// The same line with another value.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Written<U> {
        Written {
            value: change(self.value),
            line: self.line,
        }
    }
}

/// A text with each run of white space replaced by one space.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// How a message shows a value.
pub fn describe(value: &DeValue) -> String {
    match value {
        DeValue::String(text) => format!("\"{}\"", quantity::shorten(text)),
        DeValue::Integer(number) => quantity::shorten(number.as_str()),
        DeValue::Float(number) => quantity::shorten(number.as_str()),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// The digits of a bare number.
pub fn bare_number(value: &DeValue) -> Option<String> {
    match value {
        DeValue::Integer(number) if number.radix() == 10 => Some(number.as_str().to_owned()),
        DeValue::Float(number) => Some(number.as_str().to_owned()),
        _ => None,
    }
}

/// Reads the values of a TOML text and collects its problems.
pub struct Reader<'s> {
    /// The file, if there is one.
    pub source: Option<&'s Path>,
    /// Byte at which each line starts.
    pub line_starts: Vec<usize>,
    /// The problems so far.
    pub problems: Problems,
}

impl<'s> Reader<'s> {
    /// A reader of a text that has not been parsed.
    pub fn new(text: &str, source: Option<&'s Path>) -> Self {
        let mut reader = Self {
            source,
            line_starts: Vec::new(),
            problems: Problems::default(),
        };
        reader.set_text(text);
        reader
    }

    /// Finds the lines of a text.
    pub fn set_text(&mut self, text: &str) {
        self.line_starts = std::iter::once(0)
            .chain(text.match_indices('\n').map(|(at, _)| at + 1))
            .collect();
    }

    /// The keys and values of the text; `None` if it is not TOML.
    pub fn document<'t>(&mut self, text: &'t str) -> Option<Spanned<DeTable<'t>>> {
        // A byte-order mark does not belong to the first key.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        self.set_text(text);
        let (document, errors) = DeTable::parse_recoverable(text);
        let has_old_ends = text.replace("\r\n", "").contains('\r');
        let mut lines = HashSet::new();
        for error in errors {
            let line = error.span().map(|span| self.line_of(span.start));
            // Further errors on the same line follow from the first.
            if !lines.insert(line) || lines.len() > MAX_TOLD {
                continue;
            }
            // The parser uses backticks as quotation marks; in our messages they mark keys.
            let message = one_line(&error.message().replace('`', "\""));
            let problem = Problem::new(ProblemKind::Format, format!("not TOML: {message}"));
            let hint = if has_old_ends {
                "save it with line ends LF or CR LF"
            } else {
                "write a heading as [name], a key as name = value, and text in \"quotes\""
            };
            self.note(line, problem.hint(hint));
        }
        if let Some(more) = lines.len().checked_sub(MAX_TOLD).filter(|more| *more > 0) {
            let message = format!("not TOML: {} like these", counted(more, "more line"));
            let hint = "check that this is a study, and not a list of objects or a record";
            self.note(None, Problem::format(message, hint));
        }
        // In a text that is not TOML, other problems would only be consequences.
        self.problems.is_empty().then_some(document)
    }

    /// The line of a byte, counted from 1.
    pub fn line_of(&self, byte: usize) -> usize {
        self.line_starts.partition_point(|&start| start <= byte)
    }

    /// Adds a problem of the file, at its line if that is known. The problem names the keys as the
    /// file does.
    pub fn note(&mut self, line: Option<usize>, problem: Problem) {
        let problem = line
            .into_iter()
            .fold(problem.shown(KeyStyle::File), Problem::at_line);
        self.problems
            .push(self.source.into_iter().fold(problem, Problem::in_file));
    }

    /// Adds the problem of a value that has the wrong type.
    pub fn wrong_type(
        &mut self,
        line: usize,
        key: &str,
        expected: &str,
        value: &DeValue,
        hint: &str,
    ) {
        self.note(
            Some(line),
            Problem::value(
                format!("{key} must be {expected}, not {}", describe(value)),
                hint,
            ),
        );
    }

    /// The value with its line; a problem is added under its key.
    pub fn keep<T>(
        &mut self,
        key: &str,
        line: usize,
        result: Result<T, Problem>,
    ) -> Option<Written<T>> {
        match result {
            Ok(value) => Some(Written { value, line }),
            Err(mut problem) => {
                problem.message = format!("{key}: {}", problem.message);
                self.note(Some(line), problem);
                None
            }
        }
    }

    /// A ratio: bare, or a string such as "5 %".
    pub fn ratio_value(&mut self, key: &str, value: &DeValue, line: usize) -> Option<Written<f64>> {
        let text = value
            .as_str()
            .map(str::to_owned)
            .or_else(|| bare_number(value));
        let Some(text) = text else {
            self.wrong_type(
                line,
                key,
                "a number",
                value,
                "write a bare number or a percentage such as \"5 %\"",
            );
            return None;
        };
        let result = quantity::parse(&text, Dimension::Ratio);
        self.keep(key, line, result)
    }

    /// A quantity: a string with its unit, or a bare number where the key states the unit.
    pub fn quantity_value(
        &mut self,
        key: &str,
        value: &DeValue,
        line: usize,
        dimension: Dimension,
        stated: Option<&Unit>,
    ) -> Option<Written<f64>> {
        let result = match (stated, bare_number(value), value.as_str()) {
            (Some(unit), Some(number), _) => quantity::parse_in_unit(&number, unit),
            (Some(unit), None, Some(text)) => quantity::parse_in_unit(text, unit),
            (None, Some(number), _) => quantity::parse(&number, dimension),
            (None, None, Some(text)) => quantity::parse(text, dimension),
            _ => {
                let hint = format!(
                    "write a number and its unit, such as {}",
                    example(dimension)
                );
                self.wrong_type(line, key, dimension.with_article(), value, &hint);
                return None;
            }
        };
        self.keep(key, line, result)
    }
}

/// An example of a quantity, for a hint: `"2.3 m"`.
pub fn example(dimension: Dimension) -> String {
    dimension.units().next().map_or_else(
        || "0.5".to_owned(),
        |unit| format!("\"2.3 {}\"", unit.symbol),
    )
}

/// How a unit is written at the end of a key: `N/mm` → `n_mm`, `m/s2` → `m_s2`.
pub fn key_suffix(unit: &Unit) -> String {
    unit.symbol.to_lowercase().replace(['/', '·', ' '], "_")
}

/// The place of keys in a TOML document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In a document of tables.
    Document,
    /// In a document without tables.
    PlainDocument,
    /// In the table of this name.
    Table(&'static str),
}

/// A table being read, and the keys that are known.
pub struct Section<'t, 'i> {
    /// Where its keys are.
    pub place: Place,
    /// Its keys and values.
    pub entries: &'t DeTable<'i>,
    /// Line of its heading.
    pub line: usize,
    /// Known keys.
    pub known: Vec<&'static str>,
    /// Keys that were found, as written.
    pub taken: Vec<String>,
}

impl<'t, 'i> Section<'t, 'i> {
    /// A table before reading.
    pub fn new(place: Place, entries: &'t DeTable<'i>, line: usize) -> Self {
        Self {
            place,
            entries,
            line,
            known: Vec::new(),
            taken: Vec::new(),
        }
    }

    /// A key and its value.
    pub fn entry(
        &self,
        key: &str,
    ) -> Option<(&'t Spanned<std::borrow::Cow<'i, str>>, &'t DeValue<'i>)> {
        self.entries
            .iter()
            .find(|(name, _)| name.get_ref() == key)
            .map(|(name, value)| (name, value.get_ref()))
    }

    /// A value and its line; the key counts as known.
    pub fn take(&mut self, reader: &Reader, key: &'static str) -> Option<(&'t DeValue<'i>, usize)> {
        self.known.push(key);
        let (name, value) = self.entry(key)?;
        self.taken.push(key.to_owned());
        Some((value, reader.line_of(name.span().start)))
    }

    /// A table within this table.
    pub fn table(&mut self, reader: &mut Reader, key: &'static str) -> Option<Section<'t, 'i>> {
        let (value, line) = self.take(reader, key)?;
        if let DeValue::Table(entries) = value {
            return Some(Section::new(Place::Table(key), entries, line));
        }
        let hint = if self.place == Place::Document {
            format!("write [{key}] on a line of its own")
        } else {
            format!("write {key} = {{ … }}")
        };
        reader.wrong_type(line, key, "a table", value, &hint);
        None
    }

    /// A text.
    pub fn string(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<String>> {
        let (value, line) = self.take(reader, key)?;
        if let Some(text) = value.as_str() {
            return Some(Written {
                value: text.to_owned(),
                line,
            });
        }
        reader.wrong_type(line, key, "text", value, "write it in \"quotes\"");
        None
    }

    /// A text, or the digits of a number.
    pub fn name_or_number(
        &mut self,
        reader: &mut Reader,
        key: &'static str,
    ) -> Option<Written<String>> {
        let (value, line) = self.take(reader, key)?;
        if let Some(text) = value
            .as_str()
            .map(str::to_owned)
            .or_else(|| bare_number(value))
        {
            return Some(Written { value: text, line });
        }
        reader.wrong_type(
            line,
            key,
            "a name or a number",
            value,
            "write it in \"quotes\"",
        );
        None
    }

    /// A list of texts; a single text counts as a list of one.
    pub fn strings(
        &mut self,
        reader: &mut Reader,
        key: &'static str,
    ) -> Option<Written<Vec<Written<String>>>> {
        let (value, line) = self.take(reader, key)?;
        let hint = format!("write {key} = [\"a.AT2\", \"b.AT2\"]");
        match value {
            DeValue::String(text) => {
                let only = Written {
                    value: text.clone().into_owned(),
                    line,
                };
                return Some(Written {
                    value: vec![only],
                    line,
                });
            }
            DeValue::Array(items) => {
                let mut strings = Vec::new();
                for item in items {
                    let line = reader.line_of(item.span().start);
                    match item.get_ref().as_str() {
                        Some(text) => strings.push(Written {
                            value: text.to_owned(),
                            line,
                        }),
                        None => {
                            reader.wrong_type(line, key, "a list of texts", item.get_ref(), &hint)
                        }
                    }
                }
                return Some(Written {
                    value: strings,
                    line,
                });
            }
            _ => reader.wrong_type(line, key, "a list of texts", value, &hint),
        }
        None
    }

    /// `true` or `false`.
    pub fn boolean(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<bool>> {
        let (value, line) = self.take(reader, key)?;
        if let DeValue::Boolean(flag) = value {
            return Some(Written { value: *flag, line });
        }
        reader.wrong_type(line, key, "true or false", value, "write it without quotes");
        None
    }

    /// A whole number without a sign.
    pub fn count(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<u64>> {
        let (value, line) = self.take(reader, key)?;
        let number = match value {
            DeValue::Integer(number) => u64::from_str_radix(number.as_str(), number.radix()).ok(),
            _ => None,
        };
        if let Some(value) = number {
            return Some(Written { value, line });
        }
        reader.wrong_type(
            line,
            key,
            "a whole number",
            value,
            "write only digits, without a sign, a point or quotes",
        );
        None
    }

    /// A ratio: bare, or a text such as "5 %".
    pub fn ratio(&mut self, reader: &mut Reader, key: &'static str) -> Option<Written<f64>> {
        let (value, line) = self.take(reader, key)?;
        reader.ratio_value(key, value, line)
    }

    /// The value of the key, or of the key with a unit appended; both together are refused.
    pub fn take_with_unit(
        &mut self,
        reader: &mut Reader,
        key: &'static str,
        dimension: Dimension,
    ) -> Option<(String, &'t DeValue<'i>, usize, Option<&'static Unit>)> {
        let mut found = self
            .take(reader, key)
            .map(|(value, line)| (key.to_owned(), value, line, None));
        for unit in dimension.units() {
            let stated = format!("{key}_{}", key_suffix(unit));
            let Some((name, value)) = self.entry(&stated) else {
                continue;
            };
            // N/mm and kN/m share no suffix, but two spellings of one unit would be seen twice
            // here.
            if self.taken.contains(&stated) {
                continue;
            }
            self.taken.push(stated.clone());
            let line = reader.line_of(name.span().start);
            if let Some((first, ..)) = &found {
                let message = format!("{first} and {stated} both state the same value");
                reader.note(Some(line), Problem::value(message, "keep one of them"));
            } else {
                found = Some((stated, value, line, Some(unit)));
            }
        }
        found
    }

    /// A quantity: a text with its unit, or a bare number where the key states the unit.
    pub fn quantity(
        &mut self,
        reader: &mut Reader,
        key: &'static str,
        dimension: Dimension,
    ) -> Option<Written<f64>> {
        let (name, value, line, unit) = self.take_with_unit(reader, key, dimension)?;
        reader.quantity_value(&name, value, line, dimension, unit)
    }

    /// A grid text, a list of quantities or one quantity; bare numbers if the key states the unit.
    pub fn grid(
        &mut self,
        reader: &mut Reader,
        key: &'static str,
        dimension: Dimension,
    ) -> Option<Written<Vec<f64>>> {
        let (name, value, line, unit) = self.take_with_unit(reader, key, dimension)?;
        match (value, unit) {
            (DeValue::Array(items), _) => {
                let before = reader.problems.len();
                let values: Vec<f64> = items
                    .iter()
                    .filter_map(|item| {
                        let line = reader.line_of(item.span().start);
                        reader.quantity_value(&name, item.get_ref(), line, dimension, unit)
                    })
                    .map(|written| written.value)
                    .collect();
                (reader.problems.len() == before).then_some(Written {
                    value: values,
                    line,
                })
            }
            (DeValue::String(text), unit) => {
                let result = match unit {
                    Some(unit) => quantity::parse_grid_in_unit(text, unit),
                    None => quantity::parse_grid(text, dimension),
                };
                reader.keep(&name, line, result)
            }
            _ => Some(
                reader
                    .quantity_value(&name, value, line, dimension, unit)?
                    .map(|value| vec![value]),
            ),
        }
    }

    /// Refuses unknown keys.
    pub fn finish(self, reader: &mut Reader) {
        for (name, value) in self.entries {
            let key = name.get_ref().as_ref();
            if self.taken.iter().any(|taken| taken == key) {
                continue;
            }
            let shown = quantity::shorten(key);
            let what = match (self.place, value.get_ref()) {
                (Place::Document | Place::PlainDocument, DeValue::Table(_)) => {
                    format!("unknown table [{shown}]")
                }
                (Place::Document, _) => format!("{shown} is outside every table"),
                (Place::PlainDocument, _) => format!("unknown key {shown}"),
                (Place::Table(table), _) => format!("unknown key {shown} in [{table}]"),
            };
            let hint = match nearest(key, &self.known) {
                Some(near) if self.place == Place::Document => format!("did you mean [{near}]?"),
                Some(near) => format!("did you mean {near}?"),
                None => format!("known: {}", self.known.join(", ")),
            };
            let line = reader.line_of(name.span().start);
            reader.note(Some(line), Problem::value(what, hint));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of another kind is told by its first lines and the number of the others.
    #[test]
    fn a_file_that_is_not_toml_is_told_in_a_few_lines() {
        let text: String = (0..40_000)
            .map(|i| format!("{i};cabinet;1800;300\n"))
            .collect();
        let mut reader = Reader::new(&text, None);
        assert!(reader.document(&text).is_none());
        let lines: Vec<Option<usize>> = reader
            .problems
            .into_iter()
            .map(|problem| problem.line)
            .collect();
        let told: Vec<Option<usize>> = (1..=MAX_TOLD).map(Some).chain([None]).collect();
        assert_eq!(lines, told);
        let few = "a = 1\nb\nc = 2\n";
        let mut reader = Reader::new(few, None);
        assert!(reader.document(few).is_none());
        assert_eq!(
            reader
                .problems
                .into_iter()
                .map(|problem| problem.line)
                .collect::<Vec<_>>(),
            [Some(2)]
        );
    }
}
