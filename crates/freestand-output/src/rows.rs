//! Tables as CSV with commas and LF. Numbers are the shortest that read back the same; a missing
//! value is an empty field.

use freestand_input::words::{push_shortest, shortest};
use freestand_input::{Problem, ProblemKind};
use serde_json::Value;

/// Rows of text as CSV.
///
/// # Errors
/// None in practice: all rows have the same length, and writing to memory does not fail.
pub fn csv(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Result<Vec<u8>, Problem> {
    let mut writer = csv_writer();
    writer.write_record(header).map_err(broken)?;
    for row in rows {
        writer.write_record(row).map_err(broken)?;
    }
    writer.into_inner().map_err(|error| broken(csv::Error::from(error.into_error())))
}

/// A writer of CSV to memory; lines end with LF.
pub fn csv_writer() -> csv::Writer<Vec<u8>> {
    csv::WriterBuilder::new().terminator(csv::Terminator::Any(b'\n')).from_writer(Vec::new())
}

/// The problem of a table that cannot be written.
pub fn broken(error: csv::Error) -> Problem {
    Problem::new(ProblemKind::Io, format!("a table cannot be written: {error}"))
}

/// Records of a serializable type as CSV: field names as the header, `None` as an empty field.
///
/// # Errors
/// None in practice: records consist of numbers and texts, and writing to memory does not fail.
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
        // By default, the csv crate writes numbers as `0.0` and `1e16`.
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

/// Rows of numbers as CSV, after `head`, which ends with the header.
pub fn numbers_csv<R: AsRef<[f64]>>(head: &str, rows: impl IntoIterator<Item = R>) -> String {
    let mut text = format!("{head}\n");
    for row in rows {
        for (i, value) in row.as_ref().iter().enumerate() {
            if i > 0 {
                text.push(',');
            }
            push_shortest(&mut text, *value);
        }
        text.push('\n');
    }
    text
}

/// Named columns of numbers, all of the same length, as CSV.
///
/// # Errors
/// None in practice: writing to memory does not fail.
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
