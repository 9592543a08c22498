//! Headers of lines `KEY: value`, as several archives write them, and the rows of numbers below
//! them.

use super::digit_style::DigitStyle;
use super::fortran::{Number, bad_field, fields, is_missing_word, number, words};
use super::lines::{Line, Lines};
use super::rows::Rows;
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;
use freestand_input::quantity::shorten;

/// The last line on which the first row of numbers may be; in the longest of these headers it is
/// line 65.
const HEADER_LINES: usize = 1000;

/// A line of a header. Prose without a colon is a key with an empty value.
pub(crate) struct Entry {
    pub(crate) line: usize,
    pub(crate) key: String,
    pub(crate) value: String,
}

/// The lines above the numbers.
pub(crate) struct Header {
    pub(crate) entries: Vec<Entry>,
}

/// Splits a line at its first colon: times and addresses in the value have colons of their own.
pub(crate) fn entry(line: &Line<'_>) -> Entry {
    let text = line.text();
    let (key, value) = text.split_once(':').unwrap_or((&text, ""));
    Entry {
        line: line.number,
        key: key.trim().to_owned(),
        value: value.trim().to_owned(),
    }
}

impl Entry {
    /// Whether its key is `key`, ignoring capitals and a unit in brackets after it.
    pub(crate) fn is(&self, key: &str) -> bool {
        self.key
            .split('(')
            .next()
            .unwrap_or("")
            .trim()
            .eq_ignore_ascii_case(key)
    }

    fn problem(&self, what: &str) -> Problem {
        let (key, value) = (shorten(&self.key), shorten(&self.value));
        Problem::format(
            format!("{key} is \"{value}\"; {what} is expected"),
            "correct the header if it is wrong, or fetch the file again",
        )
        .at_line(self.line)
    }
}

impl Header {
    /// Reads the lines above the first row of numbers, and leaves `rest` before that row.
    pub(crate) fn read(rest: &mut Lines<'_>) -> Self {
        let is_below = |line: &Line<'_>| line.number > HEADER_LINES;
        let above = rest
            .leading(|line| is_below(line) || !is_row(line))
            .take_while(|line| !is_below(line))
            .filter(|line| !line.is_blank());
        Self {
            entries: above.map(|line| entry(&line)).collect(),
        }
    }

    /// The line of a key whose value is not empty.
    pub(crate) fn get(&self, key: &str) -> Option<&Entry> {
        self.entries
            .iter()
            .find(|entry| entry.is(key) && !entry.value.is_empty())
    }

    /// The value of a key; empty if the key is missing.
    pub(crate) fn text(&self, key: &str) -> &str {
        self.get(key).map_or("", |entry| &entry.value)
    }

    /// The number under a key, with its line.
    ///
    /// # Errors
    /// A value that is not a number.
    pub(crate) fn number(&self, key: &str) -> Result<Option<(f64, usize)>, Problem> {
        let Some(entry) = self.get(key) else {
            return Ok(None);
        };
        let value = number(entry.value.as_bytes())
            .ok_or_else(|| entry.problem("a number"))?
            .value;
        Ok(Some((value, entry.line)))
    }

    /// The time step \[s\] under a key, with its line; a key may state its unit in brackets.
    /// Without the key, the step `given_s` by the user.
    ///
    /// # Errors
    /// A value that is not a number, or a unit other than seconds and milliseconds; no step at all.
    pub(crate) fn step_s(&self, key: &str, given_s: Option<f64>) -> Result<(f64, usize), Problem> {
        let Some((value, line)) = self.number(key)? else {
            return given_s.map(|dt_s| (dt_s, 1)).ok_or_else(|| {
                Problem::value(
                    format!("the header has no time step ({key})"),
                    "give the time step, such as `dt = \"0.01 s\"`",
                )
            });
        };
        let unit = self
            .get(key)
            .and_then(|entry| entry.key.split_once('('))
            .map_or("s", |(_, unit)| unit);
        match unit
            .trim_end_matches(')')
            .trim()
            .to_ascii_lowercase()
            .as_str()
        {
            "s" | "sec" | "secs" | "second" | "seconds" => Ok((value, line)),
            "ms" | "msec" => Ok((value / 1000.0, line)),
            other => Err(Problem::format(
                format!("\"{}\" is not a unit of time", shorten(other)),
                "the step must be in s or ms",
            )
            .at_line(line)),
        }
    }

    /// The number of values under a key, with its line.
    ///
    /// # Errors
    /// A value that is not a whole number.
    pub(crate) fn count(&self, key: &str) -> Result<Option<(usize, usize)>, Problem> {
        let Some(entry) = self.get(key) else {
            return Ok(None);
        };
        let value = number(entry.value.as_bytes()).map(|number| number.value);
        match value.filter(|value| (0.0..1e9).contains(value) && value.fract() == 0.0) {
            Some(value) => Ok(Some((value as usize, entry.line))),
            None => Err(entry.problem("a whole number")),
        }
    }
}

/// Whether a line is a row of numbers. A row of words that mark missing values counts: it must be
/// refused, not taken for a header.
fn is_row(line: &Line<'_>) -> bool {
    let mut values = 0;
    if fields(line.bytes, |_| values += 1).is_ok() {
        return values > 0;
    }
    words(line.bytes).all(|word| is_missing_word(word) || number(word).is_some())
}

/// Reads rows of `width` numbers to the end of the file; `declared` is the number that the header
/// states, and its line.
///
/// # Errors
/// A field that is not a number, a wrong number of rows, no rows; otherwise as [`Rows::push`].
pub(crate) fn read_rows(
    rest: &mut Lines<'_>,
    width: usize,
    declared: Option<(usize, usize)>,
    notes: &mut Vec<Note>,
) -> Result<Rows, Problem> {
    let (mut rows, mut row) = (Rows::of_width(width), Vec::with_capacity(width));
    let mut digit_styles: Vec<DigitStyle> = (0..width).map(|_| DigitStyle::default()).collect();
    for line in rest.filled() {
        row.clear();
        let each = |number: Number| {
            if let Some(style) = digit_styles.get_mut(row.len()) {
                style.see(&number, line.number);
            }
            row.push(number.value);
        };
        if let Err(bad) = fields(line.bytes, each) {
            // A footer may follow the last value.
            if row.is_empty() && declared.is_some_and(|(count, _)| count == rows.count()) {
                notes.push(below_values(&line));
                break;
            }
            return Err(bad_field(&bad, line.number));
        }
        rows.push(&row, line.number)?;
    }
    notes.extend(rows.judge()?);
    notes.extend(digit_styles.iter().filter_map(DigitStyle::note));
    match declared {
        Some((count, line)) if count != rows.count() => {
            Err(wrong_count(count, rows.count()).at_line(line))
        }
        _ => rows.not_empty(rest),
    }
}

/// The problem that the header states another number of values than the file has.
fn wrong_count(declared: usize, found: usize) -> Problem {
    Problem::format(
        format!("the header declares {declared} values, but the file has {found}"),
        "the file may be cut off: fetch it again, or correct the number if no value is missing",
    )
}

/// Refuses numbers after the last value that the header declares, and notes other text there.
///
/// # Errors
/// A row of numbers.
pub(crate) fn refuse_more_values(
    rest: &mut Lines<'_>,
    notes: &mut Vec<Note>,
) -> Result<(), Problem> {
    let Some(line) = rest.filled().next() else {
        return Ok(());
    };
    if is_row(&line) {
        return Err(Problem::format(
            "there are more values than the header declares",
            "correct the number in the header if the values belong to the record",
        )
        .at_line(line.number));
    }
    notes.push(below_values(&line));
    Ok(())
}

fn below_values(line: &Line<'_>) -> Note {
    let words = format!(
        "line {} follows the last value and was ignored",
        line.number
    );
    Note::new(NoteKind::TextIgnored, words)
}

#[cfg(test)]
mod tests;
