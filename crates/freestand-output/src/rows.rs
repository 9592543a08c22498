//! Tables as CSV and as members of a JSON document: comma, LF, shortest numbers that read back the
//! same; a missing value is an empty field, or `null`.

use std::borrow::Cow;

use freestand_input::words::{push_shortest, shortest};
use freestand_input::{Problem, ProblemKind};
use serde_json::Value;

/// Rows of text as CSV.
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn csv(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Result<Vec<u8>, Problem> {
    let mut writer = csv_writer();
    writer.write_record(header).map_err(broken)?;
    for row in rows {
        writer.write_record(row).map_err(broken)?;
    }
    writer.into_inner().map_err(|error| broken(csv::Error::from(error.into_error())))
}

/// A writer of CSV into memory, lines ended by LF.
pub fn csv_writer() -> csv::Writer<Vec<u8>> {
    csv::WriterBuilder::new().terminator(csv::Terminator::Any(b'\n')).from_writer(Vec::new())
}

/// A table that cannot be written.
pub fn broken(error: csv::Error) -> Problem {
    Problem::new(ProblemKind::Io, format!("a table cannot be written: {error}"))
}

/// Records of a serializable type as CSV: field names as the header, `None` as an empty field.
///
/// # Errors
/// None in practice: records are of numbers and texts, and memory does not fail.
///
/// # Example
/// ```
/// #[derive(serde::Serialize)]
/// struct Row {
///     count: usize,
///     uplift_m: Option<f64>,
/// }
/// let rows = [Row { count: 1, uplift_m: Some(0.0) }, Row { count: 2, uplift_m: None }];
/// assert_eq!(freestand_output::rows::records_csv(&rows)?, b"count,uplift_m\n1,0\n2,\n");
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn records_csv<T: serde::Serialize>(records: &[T]) -> Result<Vec<u8>, Problem> {
    let mut header = Vec::new();
    let mut rows = Vec::with_capacity(records.len());
    for record in records {
        // Left to itself, the csv crate writes numbers as `0.0` and `1e16`.
        let Ok(Value::Object(fields)) = serde_json::to_value(record) else {
            return Err(Problem::new(ProblemKind::Io, "a table cannot be written: its records have no fields"));
        };
        if rows.is_empty() {
            header = fields.keys().cloned().collect();
        }
        rows.push(fields.values().map(cell).collect());
    }
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    csv(&header, rows.into_iter())
}

/// One value of a row that is written and not stored.
#[derive(Debug, Clone, PartialEq)]
pub enum Field<'a> {
    /// A text.
    Text(Cow<'a, str>),
    /// A number.
    Number(f64),
    /// A whole number.
    Count(usize),
    /// Yes or no.
    Flag(bool),
    /// No value: an empty field, `null`.
    Missing,
}

impl From<Option<f64>> for Field<'_> {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Missing, Self::Number)
    }
}

/// The names of a row's fields as the first line of a CSV.
///
/// # Errors
/// None in practice: memory does not fail.
pub fn csv_header(fields: &[(&'static str, Field)]) -> Result<Vec<u8>, Problem> {
    csv(&fields.iter().map(|(name, _)| *name).collect::<Vec<_>>(), std::iter::empty())
}

/// Rows of named fields as CSV without a header, written as by [`records_csv`].
///
/// # Errors
/// None in practice: rows are of one length and memory does not fail.
pub fn csv_rows<'a>(rows: impl Iterator<Item = Vec<(&'static str, Field<'a>)>>) -> Result<Vec<u8>, Problem> {
    let mut writer = csv_writer();
    let mut text = String::new();
    for row in rows {
        for (_, field) in &row {
            text.clear();
            match field {
                Field::Text(value) => text.push_str(value),
                Field::Number(value) => push_shortest(&mut text, *value),
                Field::Count(value) => text.push_str(&value.to_string()),
                Field::Flag(value) => text.push_str(&value.to_string()),
                Field::Missing => {}
            }
            writer.write_field(&text).map_err(broken)?;
        }
        writer.write_record(None::<&[u8]>).map_err(broken)?;
    }
    writer.into_inner().map_err(|error| broken(csv::Error::from(error.into_error())))
}

/// Rows of named fields as members of an array on the second level of a
/// [`document`](freestand_output::json::document), with a comma before each of them.
///
/// # Errors
/// None in practice: memory does not fail.
pub fn json_rows<'a>(rows: impl Iterator<Item = Vec<(&'static str, Field<'a>)>>) -> Result<Vec<u8>, Problem> {
    let broken = |error: serde_json::Error| Problem::new(ProblemKind::Io, format!("a row cannot be written: {error}"));
    let mut out = Vec::new();
    for row in rows {
        out.extend_from_slice(b",\n    {");
        for (i, (name, field)) in row.iter().enumerate() {
            out.extend_from_slice(if i == 0 { b"\n      " } else { b",\n      " });
            serde_json::to_writer(&mut out, name).map_err(broken)?;
            out.extend_from_slice(b": ");
            match field {
                Field::Text(value) => serde_json::to_writer(&mut out, value),
                Field::Number(value) => serde_json::to_writer(&mut out, value),
                Field::Count(value) => serde_json::to_writer(&mut out, value),
                Field::Flag(value) => serde_json::to_writer(&mut out, value),
                Field::Missing => serde_json::to_writer(&mut out, &()),
            }
            .map_err(broken)?;
        }
        out.extend_from_slice(b"\n    }");
    }
    Ok(out)
}

/// Named columns of numbers, all of one length, as CSV.
///
/// # Errors
/// None in practice: memory does not fail.
pub fn columns_csv(columns: &[(&str, &[f64])]) -> Result<Vec<u8>, Problem> {
    let header: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let length = columns.iter().map(|(_, values)| values.len()).min().unwrap_or(0);
    csv(&header, (0..length).map(|i| columns.iter().map(|(_, values)| shortest(values[i])).collect()))
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Number(number) if number.is_f64() => optional(number.as_f64()),
        other => other.to_string(),
    }
}

/// A cell of a number that may be missing.
pub fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, shortest)
}
