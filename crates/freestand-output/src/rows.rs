//! Tables as CSV with commas and LF. Numbers are the shortest that read back the same; a missing
//! value is an empty field.

use freestand_input::formula::guarded_text_or_number;
use freestand_input::words::{push_shortest, shortest};
use freestand_input::{Problem, ProblemKind};
use serde_json::Value;

pub use crate::table::broken;
use crate::table::{Holds, Table};

/// Rows of numbers and texts as CSV. A text that a spreadsheet would take for a formula gets a leading `'`.
///
/// # Errors
/// None in practice: all rows have the same length, and writing to memory does not fail.
pub fn csv(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Result<Vec<u8>, Problem> {
    let mut writer = csv_writer();
    writer
        .write_record(
            header
                .iter()
                .map(|name| guarded_text_or_number(name).into_owned()),
        )
        .map_err(broken)?;
    for row in rows {
        for field in row {
            writer
                .write_field(guarded_text_or_number(&field).as_ref())
                .map_err(broken)?;
        }
        writer.write_record(None::<&[u8]>).map_err(broken)?;
    }
    writer
        .into_inner()
        .map_err(|error| broken(csv::Error::from(error.into_error())))
}

/// A writer of CSV to memory; lines end with LF.
pub fn csv_writer() -> csv::Writer<Vec<u8>> {
    csv::WriterBuilder::new()
        .terminator(csv::Terminator::Any(b'\n'))
        .from_writer(Vec::new())
}

/// Records of a serializable type as a table: field names as the header, `None` as an empty field.
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
/// assert_eq!(freestand_output::rows::table_of_records(&rows)?.as_ref(), b"count,uplift_m\n1,0\n2,\n");
/// # Ok::<(), freestand_input::problem::Problem>(())
/// ```
pub fn table_of_records<T: serde::Serialize>(records: &[T]) -> Result<Table, Problem> {
    let mut columns: Vec<(String, Holds)> = Vec::new();
    let mut rows = Vec::with_capacity(records.len());
    for record in records {
        // By default, the csv crate writes numbers as `0.0` and `1e16`.
        let Ok(Value::Object(fields)) = serde_json::to_value(record) else {
            return Err(Problem::new(
                ProblemKind::Io,
                "a table cannot be written: its records have no fields",
            ));
        };
        if rows.is_empty() {
            columns = fields
                .keys()
                .map(|name| (name.clone(), Holds::Nothing))
                .collect();
        }
        for ((_, holds), value) in columns.iter_mut().zip(fields.values()) {
            *holds = holds.and(held(value));
        }
        rows.push(fields.values().map(cell).collect());
    }
    if rows.is_empty() {
        return Ok(Table::default());
    }
    let header: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let text = csv(&header, rows.into_iter())?;
    Ok(Table::new(text, columns))
}

/// What the value of a record is.
fn held(value: &Value) -> Holds {
    match value {
        Value::Null => Holds::Nothing,
        Value::Bool(_) => Holds::Flag,
        Value::Number(number) if number.is_u64() => Holds::Count,
        Value::Number(_) => Holds::Number,
        Value::String(_) | Value::Array(_) | Value::Object(_) => Holds::Text,
    }
}

/// Rows of numbers as a table whose first line is `header`, names with commas between them.
pub fn table_of_numbers<R: AsRef<[f64]>>(header: &str, rows: impl IntoIterator<Item = R>) -> Table {
    let columns = header
        .split(',')
        .map(|name| (name.to_owned(), Holds::Number))
        .collect();
    Table::new(numbers_csv(header, rows).into_bytes(), columns)
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

/// A finished CSV as a table; `columns` are the names in its first line, each with whether the
/// column holds numbers. Other columns hold text.
pub fn table_of_csv(csv: Vec<u8>, columns: &[(&str, bool)]) -> Table {
    let holds = |is_number: bool| {
        if is_number {
            Holds::Number
        } else {
            Holds::Text
        }
    };
    Table::new(
        csv,
        columns
            .iter()
            .map(|(name, is_number)| ((*name).to_owned(), holds(*is_number)))
            .collect(),
    )
}

/// Named columns of numbers, all of the same length, as a table.
///
/// # Errors
/// None in practice: writing to memory does not fail.
pub fn table_of_columns(columns: &[(&str, &[f64])]) -> Result<Table, Problem> {
    let header: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let length = columns
        .iter()
        .map(|(_, values)| values.len())
        .min()
        .unwrap_or(0);
    let text = csv(
        &header,
        (0..length).map(|i| {
            columns
                .iter()
                .map(|(_, values)| shortest(values[i]))
                .collect()
        }),
    )?;
    Ok(Table::new(
        text,
        header
            .iter()
            .map(|name| ((*name).to_owned(), Holds::Number))
            .collect(),
    ))
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
