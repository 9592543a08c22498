//! A result as one list of facts: each appears once, with its name, its label for people and its
//! value. The JSON document, the rows of a CSV and the text of a command are all made from it.
//!
//! A name ends in its unit (`uplift_m`, `edge_acceleration_g`), so no other list states the unit.

use std::borrow::Cow;

use freestand_input::formula::guarded;
use freestand_input::quantity::{format_si, lookup};
use freestand_input::words::{push_shortest, shortest, significant};
use freestand_input::{Problem, ProblemKind};
use serde::{Serialize, Serializer};

use crate::parquet::{ColumnType, ParquetColumn, ParquetValue};
use crate::rows::{broken, csv, csv_writer};
use crate::table::{Holds, Table};
use crate::units::unit_of;

/// A list of facts, in the order in which they are written.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts<'a>(Vec<Fact<'a>>);

/// One fact.
#[derive(Debug, Clone, PartialEq)]
struct Fact<'a> {
    /// The name; empty if the fact is only for people.
    name: &'static str,
    /// The label; empty if the fact is only for programs.
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
    /// A number, or the word that takes its place.
    NumberOr(Option<f64>, &'static str),
    /// Several values: an array; not a field of a CSV.
    List(Vec<Value<'a>>),
    /// Facts within a fact: an object; not a field of a CSV.
    Facts(Facts<'a>),
}

/// A number as text for people, in the unit that its name states.
fn number_words(value: f64, unit: Option<(&str, usize)>) -> String {
    let (unit, digits) = unit.unwrap_or(("", 4));
    match lookup(unit).map(|unit| unit.dimension) {
        Some(dimension) if digits == 6 => format_si(value, dimension),
        _ => format!(
            "{} {}",
            significant(value, digits),
            unit.replace("m/s2", "m/s²")
        )
        .trim_end()
        .to_owned(),
    }
}

impl<'a> Facts<'a> {
    /// Adds a fact that people read under `label`.
    #[must_use]
    pub fn fact(
        mut self,
        name: &'static str,
        label: &'static str,
        value: impl Into<Value<'a>>,
    ) -> Self {
        self.0.push(Fact {
            name,
            label,
            value: value.into(),
        });
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

    /// The first value called `name`, also within nested facts.
    pub fn get(&self, name: &str) -> Option<&Value<'a>> {
        self.0.iter().find_map(|fact| match &fact.value {
            value if fact.name == name => Some(value),
            Value::Facts(facts) => facts.get(name),
            _ => None,
        })
    }

    /// The number called `name`; `None` if it is missing or not a number.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Value::Number(value) => Some(*value),
            Value::Count(count) => Some(*count as f64),
            Value::NumberOr(value, _) => *value,
            _ => None,
        }
    }

    /// The text called `name`; `None` if it is missing or not a text.
    pub fn text(&self, name: &str) -> Option<&str> {
        if let Value::Text(text) = self.get(name)? {
            Some(text)
        } else {
            None
        }
    }

    /// Names and values for programs, in their order.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &Value<'a>)> {
        self.0
            .iter()
            .filter(|fact| !fact.name.is_empty())
            .map(|fact| (fact.name, &fact.value))
    }

    /// Labels and values for people, of the facts that have both.
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let mut lines = Vec::new();
        self.push_lines(None, &mut lines);
        lines
    }

    /// A fact whose name has no unit takes the unit of the enclosing fact:
    /// `stiffness_n_m: {fit, …}`.
    fn push_lines(&self, around: Option<(&str, usize)>, lines: &mut Vec<(&'static str, String)>) {
        for Fact { name, label, value } in &self.0 {
            let unit = unit_of(name).or(around);
            match value {
                Value::Facts(facts) => facts.push_lines(unit, lines),
                Value::Missing => {}
                _ if label.is_empty() => {}
                // Each sentence of a list has its own line; numbers of a list are the two ends of a
                // range.
                Value::List(values) if !matches!(values.first(), Some(Value::Number(_))) => {
                    lines.extend(values.iter().map(|value| (*label, value.words(unit))));
                }
                _ => lines.push((label, value.words(unit))),
            }
        }
    }

    /// A cell of a table for people: the value called `name` in `unit`, or `-`. If `digits` is 0,
    /// it has all its digits.
    pub fn cell(&self, name: &str, unit: &str, digits: usize) -> String {
        match self.get(name) {
            Some(Value::Number(value) | Value::NumberOr(Some(value), _)) => {
                let is_own = unit_of(name).is_some_and(|(own, _)| own == unit);
                let unit = lookup(unit).filter(|_| !is_own);
                let value = unit.map_or(*value, |unit| unit.from_si(*value));
                if digits == 0 {
                    shortest(value)
                } else {
                    significant(value, digits)
                }
            }
            Some(Value::Missing) | None => "-".to_owned(),
            Some(value) => value.words(None),
        }
    }

    /// The fields of a row: names and values, without lists and nested facts.
    fn fields(&self) -> impl Iterator<Item = (&'static str, &Value<'a>)> {
        let is_field = |fact: &&Fact| {
            !(fact.name.is_empty() || matches!(fact.value, Value::List(_) | Value::Facts(_)))
        };
        self.0
            .iter()
            .filter(is_field)
            .map(|fact| (fact.name, &fact.value))
    }
}

/// The fields of a row as columns of a Parquet table; `holds` says what a column of this name holds,
/// because a value that is missing does not.
pub fn parquet_columns(row: &Facts, holds: impl Fn(&str) -> ColumnType) -> Vec<ParquetColumn> {
    let column = |(name, _): (&'static str, _)| {
        let unit = unit_of(name).map_or("", |(unit, _)| unit);
        let described = Some((
            if unit.is_empty() { "–" } else { unit }.to_owned(),
            String::new(),
        ));
        ParquetColumn {
            name: name.to_owned(),
            holds: holds(name),
            described,
        }
    };
    row.fields().map(column).collect()
}

/// The fields of a row as values of a Parquet table.
pub fn parquet_values<'r>(row: &'r Facts<'_>) -> impl Iterator<Item = ParquetValue<'r>> {
    row.fields().map(|(_, value)| match value {
        Value::Text(text) => ParquetValue::Text(Cow::Borrowed(text)),
        Value::Number(value) | Value::NumberOr(Some(value), _) => ParquetValue::Number(*value),
        Value::Count(count) => ParquetValue::Count(*count),
        Value::Flag(flag) => ParquetValue::Flag(*flag),
        Value::Missing | Value::NumberOr(None, _) | Value::List(_) | Value::Facts(_) => {
            ParquetValue::Missing
        }
    })
}

impl Value<'_> {
    /// What a column with this value holds.
    fn held(&self) -> Holds {
        match self {
            Self::Missing => Holds::Nothing,
            Self::Number(_) => Holds::Number,
            Self::Count(_) => Holds::Count,
            Self::Flag(_) => Holds::Flag,
            Self::NumberOr(_, word) => Holds::NumberOr(word),
            Self::Text(_) | Self::List(_) | Self::Facts(_) => Holds::Text,
        }
    }

    fn words(&self, unit: Option<(&str, usize)>) -> String {
        match self {
            Self::Missing => "-".to_owned(),
            Self::Text(text) => text.clone().into_owned(),
            Self::Number(value) | Self::NumberOr(Some(value), _) => number_words(*value, unit),
            Self::NumberOr(None, word) => (*word).to_owned(),
            Self::Count(count) => count.to_string(),
            Self::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Self::List(values) if values.is_empty() => "-".to_owned(),
            Self::List(values) => {
                let between = if matches!(values[0], Self::Number(_)) {
                    " to "
                } else {
                    ", "
                };
                values
                    .iter()
                    .map(|value| value.words(unit))
                    .collect::<Vec<_>>()
                    .join(between)
            }
            Self::Facts(_) => String::new(),
        }
    }
}

impl Serialize for Facts<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.named())
    }
}

impl Serialize for Value<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Missing => serializer.serialize_none(),
            Self::Text(text) => text.serialize(serializer),
            Self::Number(value) | Self::NumberOr(Some(value), _) => value.serialize(serializer),
            Self::NumberOr(None, word) => word.serialize(serializer),
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
/// None in practice: writing to memory does not fail.
pub fn csv_header(row: &Facts) -> Result<Vec<u8>, Problem> {
    csv(
        &row.fields().map(|(name, _)| name).collect::<Vec<_>>(),
        std::iter::empty(),
    )
}

/// Rows as CSV without a header; lists are left out.
///
/// # Errors
/// None in practice: all rows have the same length, and writing to memory does not fail.
pub fn csv_rows<'a>(rows: impl Iterator<Item = Facts<'a>>) -> Result<Vec<u8>, Problem> {
    let mut writer = csv_writer();
    let mut text = String::new();
    for row in rows {
        for (_, value) in row.fields() {
            text.clear();
            match value {
                Value::Text(value) => text.push_str(&guarded(value)),
                Value::Number(value) | Value::NumberOr(Some(value), _) if value.is_finite() => {
                    push_shortest(&mut text, *value);
                }
                Value::NumberOr(None, word) => text.push_str(word),
                Value::Count(count) => text.push_str(&count.to_string()),
                Value::Flag(flag) => text.push_str(&flag.to_string()),
                _ => {}
            }
            writer.write_field(&text).map_err(broken)?;
        }
        writer.write_record(None::<&[u8]>).map_err(broken)?;
    }
    writer
        .into_inner()
        .map_err(|error| broken(csv::Error::from(error.into_error())))
}

/// Rows as a table; empty if there are no rows.
///
/// # Errors
/// None in practice: see [`csv_rows`].
///
/// # Example
/// ```
/// use freestand_output::facts::{Facts, table};
/// let row = |count: usize, uplift_m: Option<f64>| Facts::default().key("count", count).key("uplift_m", uplift_m);
/// assert_eq!(table([row(1, Some(0.0)), row(2, None)])?.as_ref(), b"count,uplift_m\n1,0\n2,\n");
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn table<'a>(rows: impl IntoIterator<Item = Facts<'a>>) -> Result<Table, Problem> {
    let mut rows = rows.into_iter().peekable();
    let Some(first) = rows.peek() else {
        return Ok(Table::default());
    };
    let mut text = csv_header(first)?;
    let mut columns: Vec<(String, Holds)> = first
        .fields()
        .map(|(name, _)| (name.to_owned(), Holds::Nothing))
        .collect();
    text.extend(csv_rows(rows.inspect(|row| {
        for ((_, holds), (_, value)) in columns.iter_mut().zip(row.fields()) {
            *holds = holds.and(value.held());
        }
    }))?);
    Ok(Table::new(text, columns))
}

/// Rows as members of an array on the second level of a
/// [`document`](crate::json::document), with a comma before each of them.
///
/// # Errors
/// None in practice: writing to memory does not fail.
pub fn json_rows<'a>(rows: impl Iterator<Item = Facts<'a>>) -> Result<Vec<u8>, Problem> {
    let broken = |error: serde_json::Error| {
        Problem::new(ProblemKind::Io, format!("a row cannot be written: {error}"))
    };
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

/// A column of rows: its name, and its values as JSON with a comma before each of them.
pub type JsonColumn = (&'static str, Vec<u8>);

/// Rows, all of the same names, by columns: a tenth of the text of [`json_rows`] for whoever reads
/// whole columns.
///
/// # Errors
/// None in practice: writing to memory does not fail.
pub fn json_columns<'a>(rows: impl Iterator<Item = Facts<'a>>) -> Result<Vec<JsonColumn>, Problem> {
    let broken = |error: serde_json::Error| {
        Problem::new(
            ProblemKind::Io,
            format!("a column cannot be written: {error}"),
        )
    };
    let mut columns: Vec<JsonColumn> = Vec::new();
    for row in rows {
        if columns.is_empty() {
            columns = row.0.iter().map(|fact| (fact.name, Vec::new())).collect();
        }
        for (Fact { value, .. }, (_, column)) in row.0.iter().zip(&mut columns) {
            column.push(b',');
            serde_json::to_writer(column, value).map_err(broken)?;
        }
    }
    Ok(columns)
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

impl From<u64> for Value<'_> {
    fn from(count: u64) -> Self {
        Self::Count(count)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn shock() -> Facts<'static> {
        let stiffness = Facts::default()
            .fact("fit", "stiffness", 4.38e6)
            .key("ci95", [4e6, 5e6]);
        Facts::default()
            .fact("name", "object", "rack")
            .line("cushion", Some("linear, 4380 N/mm".to_owned()))
            .fact("uplift_m", "uplift", 0.0123)
            .fact("peak_accel_m_s2", "peak", None::<f64>)
            .fact("stiffness_n_m", "", stiffness)
            .fact("period_range_s", "range", [0.1, 2.5])
            .fact("steps", "steps", 12_usize)
            .fact("overturned", "overturned", false)
            .fact("notes", "note", vec!["one", "two"])
    }

    #[test]
    fn people_read_labels_units_and_no_missing_value() {
        let lines = [
            ("object", "rack"),
            ("cushion", "linear, 4380 N/mm"),
            ("uplift", "12.3 mm"),
            // The name `fit` states no unit: that of the fact around it is used.
            ("stiffness", "4380 N/mm"),
            ("range", "0.1 s to 2.5 s"),
            ("steps", "12"),
            ("overturned", "no"),
            ("note", "one"),
            ("note", "two"),
        ];
        assert_eq!(
            shock().lines(),
            lines.map(|(label, words)| (label, words.to_owned()))
        );
    }

    #[test]
    fn programs_read_names_and_null_for_a_missing_value() {
        let json = serde_json::to_value(shock()).unwrap();
        let expected = serde_json::json!({
            "name": "rack", "uplift_m": 0.0123, "peak_accel_m_s2": null,
            "stiffness_n_m": {"fit": 4.38e6, "ci95": [4e6, 5e6]},
            "period_range_s": [0.1, 2.5], "steps": 12, "overturned": false, "notes": ["one", "two"],
        });
        assert_eq!(json, expected);
    }

    #[test]
    fn a_row_leaves_out_lines_lists_and_facts_within_facts() {
        let csv = table([shock()]).unwrap();
        assert_eq!(
            csv.as_ref(),
            b"name,uplift_m,peak_accel_m_s2,steps,overturned\nrack,0.0123,,12,false\n"
        );
        assert_eq!(table([]).unwrap().as_ref(), b"");
    }

    #[test]
    fn rows_in_an_array_are_those_of_the_list() {
        let row = || Facts::default().key("id", "a\"b").key("uplift_m", 0.5);
        let rows = String::from_utf8(json_rows([row(), row()].into_iter()).unwrap()).unwrap();
        let array: serde_json::Value = serde_json::from_str(&format!("[0{rows}]")).unwrap();
        let row = serde_json::to_value(row()).unwrap();
        assert_eq!(array, serde_json::json!([0, row, row]));
    }

    #[test]
    fn a_cell_is_in_the_unit_of_its_column() {
        let facts = shock();
        let cells = [
            ("uplift_m", "mm", 3),
            ("uplift_m", "m", 0),
            ("peak_accel_m_s2", "m/s2", 3),
            ("none", "", 3),
        ];
        assert_eq!(
            cells.map(|(name, unit, digits)| facts.cell(name, unit, digits)),
            ["12.3", "0.0123", "-", "-"]
        );
        assert_eq!(facts.cell("fit", "N/mm", 4), "4380");
    }

    #[test]
    fn a_value_is_found_also_within_other_facts() {
        let facts = shock();
        assert_eq!(
            (facts.number("fit"), facts.number("steps")),
            (Some(4.38e6), Some(12.0))
        );
        assert_eq!(
            (facts.text("name"), facts.text("fit"), facts.number("name")),
            (Some("rack"), None, None)
        );
    }
}
