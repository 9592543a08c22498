//! What a result says, as one list: each fact once, with its name, its label for people and its
//! value. The JSON document, the rows of a CSV and the text of a command are all made from it.
//!
//! A name ends in its unit (`uplift_m`, `edge_acceleration_g`), so no other list states the unit.

use std::borrow::Cow;

use freestand_input::quantity::{format_si, lookup};
use freestand_input::words::{push_shortest, shortest, significant};
use freestand_input::{Problem, ProblemKind};
use serde::{Serialize, Serializer};

use crate::rows::{broken, csv, csv_writer};

/// Facts in the order in which they are written.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts<'a>(Vec<Fact<'a>>);

/// One of them.
#[derive(Debug, Clone, PartialEq)]
struct Fact<'a> {
    /// Empty: only people read it.
    name: &'static str,
    /// Empty: only programs read it.
    label: &'static str,
    value: Value<'a>,
}

/// The value of a fact.
#[derive(Debug, Clone, PartialEq)]
pub enum Value<'a> {
    /// No value: `null`, an empty field, no line of text.
    Missing,
    /// A text.
    Text(Cow<'a, str>),
    /// A number.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// Yes or no.
    Flag(bool),
    /// Several values: an array; not a field of a CSV.
    List(Vec<Value<'a>>),
    /// Facts within a fact: an object; not a field of a CSV.
    Facts(Facts<'a>),
}

/// Endings of names, longest first, with the unit that each stands for and the digits that people
/// are shown.
const UNITS: [(&str, &str, usize); 20] = [
    ("_m_s2", "m/s2", 4),
    ("_rad_s", "rad/s", 6),
    ("_m2_s", "m²/s", 4),
    ("_j_m3", "J/m³", 4),
    ("_m3_j", "m³/J", 5),
    ("_n_s_m", "N·s/m", 6),
    ("_n_m", "N/m", 6),
    ("_m_s", "m/s", 4),
    ("_s_m", "s/m", 6),
    ("_ratio", "", 4),
    ("_rad", "rad", 6),
    ("_deg", "deg", 4),
    ("_kg", "kg", 4),
    ("_pa", "Pa", 6),
    ("_hz", "Hz", 6),
    ("_g", "g", 4),
    ("_j", "J", 4),
    ("_n", "N", 6),
    ("_m", "m", 6),
    ("_s", "s", 6),
];

/// The unit in which the value called `name` is, and the digits that people are shown.
fn unit_of(name: &str) -> Option<(&'static str, usize)> {
    UNITS.iter().find(|(ending, ..)| name.ends_with(ending)).map(|&(_, unit, digits)| (unit, digits))
}

/// A number for people, in the unit that its name states.
fn number_words(value: f64, unit: Option<(&str, usize)>) -> String {
    let (unit, digits) = unit.unwrap_or(("", 4));
    match lookup(unit).map(|unit| unit.dimension) {
        Some(dimension) if digits == 6 => format_si(value, dimension),
        _ => format!("{} {}", significant(value, digits), unit.replace("m/s2", "m/s²")).trim_end().to_owned(),
    }
}

impl<'a> Facts<'a> {
    /// Adds a fact that people read under `label`.
    #[must_use]
    pub fn fact(mut self, name: &'static str, label: &'static str, value: impl Into<Value<'a>>) -> Self {
        self.0.push(Fact { name, label, value: value.into() });
        self
    }

    /// Adds a fact for programs.
    #[must_use]
    pub fn key(self, name: &'static str, value: impl Into<Value<'a>>) -> Self {
        self.fact(name, "", value)
    }

    /// Adds a line for people, such as a value of the input as it was understood.
    #[must_use]
    pub fn line(self, label: &'static str, words: Option<String>) -> Self {
        self.fact("", label, words)
    }

    /// Adds the facts of another list, on the same level.
    #[must_use]
    pub fn and(mut self, others: Self) -> Self {
        self.0.extend(others.0);
        self
    }

    /// The value called `name`, also within other facts; the first in their order.
    pub fn get(&self, name: &str) -> Option<&Value<'a>> {
        self.0.iter().find_map(|fact| match &fact.value {
            value if fact.name == name => Some(value),
            Value::Facts(facts) => facts.get(name),
            _ => None,
        })
    }

    /// The number called `name`; `None` where it is missing or no number.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Value::Number(value) => Some(*value),
            Value::Count(count) => Some(*count as f64),
            _ => None,
        }
    }

    /// The text called `name`; `None` where it is missing or no text.
    pub fn text(&self, name: &str) -> Option<&str> {
        if let Value::Text(text) = self.get(name)? { Some(text) } else { None }
    }

    /// Labels and values for people: of the facts that have both.
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let mut lines = Vec::new();
        self.push_lines(None, &mut lines);
        lines
    }

    /// A name without a unit is in that of the fact around it: `stiffness_n_m: {fit, …}`.
    fn push_lines(&self, around: Option<(&str, usize)>, lines: &mut Vec<(&'static str, String)>) {
        for Fact { name, label, value } in &self.0 {
            let unit = unit_of(name).or(around);
            match value {
                Value::Facts(facts) => facts.push_lines(unit, lines),
                Value::Missing => {}
                _ if label.is_empty() => {}
                // Sentences have a line each; the numbers of a list are the two ends of a range.
                Value::List(values) if !matches!(values.first(), Some(Value::Number(_))) => {
                    lines.extend(values.iter().map(|value| (*label, value.words(unit))));
                }
                _ => lines.push((label, value.words(unit))),
            }
        }
    }

    /// A cell of a table for people: the value called `name` in `unit`, or `-`; with all its digits
    /// where `digits` is 0.
    pub fn cell(&self, name: &str, unit: &str, digits: usize) -> String {
        match self.get(name) {
            Some(Value::Number(value)) => {
                let is_own = unit_of(name).is_some_and(|(own, _)| own == unit);
                let unit = lookup(unit).filter(|_| !is_own);
                let value = unit.map_or(*value, |unit| unit.from_si(*value));
                if digits == 0 { shortest(value) } else { significant(value, digits) }
            }
            Some(Value::Missing) | None => "-".to_owned(),
            Some(value) => value.words(None),
        }
    }

    /// The fields of a row: names with what is neither a list nor other facts.
    fn fields(&self) -> impl Iterator<Item = (&'static str, &Value<'a>)> {
        let is_field = |fact: &&Fact| !(fact.name.is_empty() || matches!(fact.value, Value::List(_) | Value::Facts(_)));
        self.0.iter().filter(is_field).map(|fact| (fact.name, &fact.value))
    }
}

impl Value<'_> {
    fn words(&self, unit: Option<(&str, usize)>) -> String {
        match self {
            Self::Missing => "-".to_owned(),
            Self::Text(text) => text.clone().into_owned(),
            Self::Number(value) => number_words(*value, unit),
            Self::Count(count) => count.to_string(),
            Self::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Self::List(values) if values.is_empty() => "-".to_owned(),
            Self::List(values) => {
                let between = if matches!(values[0], Self::Number(_)) { " to " } else { ", " };
                values.iter().map(|value| value.words(unit)).collect::<Vec<_>>().join(between)
            }
            Self::Facts(_) => String::new(),
        }
    }
}

impl Serialize for Facts<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let named = self.0.iter().filter(|fact| !fact.name.is_empty());
        serializer.collect_map(named.map(|fact| (fact.name, &fact.value)))
    }
}

impl Serialize for Value<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Missing => serializer.serialize_none(),
            Self::Text(text) => text.serialize(serializer),
            Self::Number(value) => value.serialize(serializer),
            Self::Count(count) => count.serialize(serializer),
            Self::Flag(flag) => flag.serialize(serializer),
            Self::List(values) => values.serialize(serializer),
            Self::Facts(facts) => facts.serialize(serializer),
        }
    }
}

/// The names of a row as the first line of a CSV.
///
/// # Errors
/// None in practice: memory does not fail.
pub fn csv_header(row: &Facts) -> Result<Vec<u8>, Problem> {
    csv(&row.fields().map(|(name, _)| name).collect::<Vec<_>>(), std::iter::empty())
}

/// Rows as CSV without a header; lists are left out.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn csv_rows<'a>(rows: impl Iterator<Item = Facts<'a>>) -> Result<Vec<u8>, Problem> {
    let mut writer = csv_writer();
    let mut text = String::new();
    for row in rows {
        for (_, value) in row.fields() {
            text.clear();
            match value {
                Value::Text(value) => text.push_str(value),
                Value::Number(value) if value.is_finite() => push_shortest(&mut text, *value),
                Value::Count(count) => text.push_str(&count.to_string()),
                Value::Flag(flag) => text.push_str(&flag.to_string()),
                _ => {}
            }
            writer.write_field(&text).map_err(broken)?;
        }
        writer.write_record(None::<&[u8]>).map_err(broken)?;
    }
    writer.into_inner().map_err(|error| broken(csv::Error::from(error.into_error())))
}

/// Rows as CSV with a header; nothing without rows.
///
/// # Errors
/// None in practice: see [`csv_rows`].
///
/// # Example
/// ```
/// use freestand_output::facts::{Facts, table_csv};
/// let row = |count: usize, uplift_m: Option<f64>| Facts::default().key("count", count).key("uplift_m", uplift_m);
/// assert_eq!(table_csv([row(1, Some(0.0)), row(2, None)])?, b"count,uplift_m\n1,0\n2,\n");
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn table_csv<'a>(rows: impl IntoIterator<Item = Facts<'a>>) -> Result<Vec<u8>, Problem> {
    let mut rows = rows.into_iter().peekable();
    let mut text = rows.peek().map(csv_header).transpose()?.unwrap_or_default();
    text.extend(csv_rows(rows)?);
    Ok(text)
}

/// Rows as members of an array on the second level of a
/// [`document`](crate::json::document), with a comma before each of them.
///
/// # Errors
/// None in practice: memory does not fail.
pub fn json_rows<'a>(rows: impl Iterator<Item = Facts<'a>>) -> Result<Vec<u8>, Problem> {
    let broken = |error: serde_json::Error| Problem::new(ProblemKind::Io, format!("a row cannot be written: {error}"));
    let mut out = Vec::new();
    for row in rows {
        out.extend_from_slice(b",\n    {");
        for (i, Fact { name, value, .. }) in row.0.iter().enumerate() {
            out.extend_from_slice(if i == 0 { b"\n      " } else { b",\n      " });
            serde_json::to_writer(&mut out, name).map_err(broken)?;
            out.extend_from_slice(b": ");
            serde_json::to_writer(&mut out, value).map_err(broken)?;
        }
        out.extend_from_slice(b"\n    }");
    }
    Ok(out)
}

impl From<f64> for Value<'_> {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<usize> for Value<'_> {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<bool> for Value<'_> {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl<'a> From<&'a str> for Value<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Value<'_> {
    fn from(text: String) -> Self {
        Self::Text(text.into())
    }
}

impl<'a> From<Facts<'a>> for Value<'a> {
    fn from(facts: Facts<'a>) -> Self {
        Self::Facts(facts)
    }
}

impl<'a, T: Into<Value<'a>>> From<Option<T>> for Value<'a> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Missing, Into::into)
    }
}

impl<'a, T: Into<Value<'a>>> From<Vec<T>> for Value<'a> {
    fn from(values: Vec<T>) -> Self {
        Self::List(values.into_iter().map(Into::into).collect())
    }
}

impl<'a, T: Into<Value<'a>>, const N: usize> From<[T; N]> for Value<'a> {
    fn from(values: [T; N]) -> Self {
        Self::List(values.into_iter().map(Into::into).collect())
    }
}

impl<'a, T: Into<Value<'a>> + Clone> From<&[T]> for Value<'a> {
    fn from(values: &[T]) -> Self {
        values.to_vec().into()
    }
}

/// Facts with the names, the values and the order of fields, each perhaps with a label:
/// `facts!(impact; time_s, speed_m_s "speed")`.
#[macro_export]
macro_rules! facts {
    ($from:expr; $($name:ident $($label:literal)?),+ $(,)?) => {
        $crate::facts::Facts::default()$(.fact(stringify!($name), concat!($($label)?), $from.$name))+
    };
}
