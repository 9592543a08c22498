//! `objects.parquet`: the columns of `objects.csv` with their types, in groups of rows so that
//! memory stays bounded.
//!
//! Numbers are optional doubles, counts optional 64-bit integers, texts optional UTF-8. Where a
//! number is `overturned` it is null, and the Boolean column next to it, `…_overturned`, is `true`;
//! infinity and NaN are never written.

use std::fs::File;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use serde_json::{Map, json};

use crate::inventory::Inventory;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_output::folder::OutputFolder;

use super::Head;
use super::overview::Overview;
use super::table::{COLUMNS, Cell, Kind, Line, carried_cells, carried_names, overturned_name};

/// The file's name.
pub(super) const PARQUET_NAME: &str = "objects.parquet";

/// Rows of a group; with eighty columns about 15 MB before compression.
const GROUP_ROWS: usize = 20_000;

/// Bytes of text after which a group ends early, whatever the length of names and notes.
const GROUP_TEXT_BYTES: usize = 64 << 20;

/// The table as it is written.
pub(super) struct ParquetTable {
    file: SerializedFileWriter<File>,
    columns: Vec<Values>,
    rows: usize,
    text_bytes: usize,
}

/// The values of a column in the group that is being filled, and whether each row has one (1) or is
/// null (0).
struct Values {
    present: Vec<i16>,
    values: Typed,
}

enum Typed {
    Double(Vec<f64>),
    Long(Vec<i64>),
    Flag(Vec<bool>),
    Text(Vec<ByteArray>),
}

impl ParquetTable {
    /// Begins the file.
    pub(super) fn begin(folder: &OutputFolder, head: &Head, inventory: &Inventory) -> Result<Self, Problem> {
        let fields = fields(inventory);
        let types = fields.iter().map(|(name, physical)| field_type(name, *physical)).collect::<Result<_, _>>();
        let schema = types.and_then(|types| Type::group_type_builder("objects").with_fields(types).build());
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_created_by(format!("freestand {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(metadata(head)))
            .build();
        let path = folder.path_of(PARQUET_NAME)?;
        let file = File::create_new(path).map_err(|error| broken(&ParquetError::from(error)))?;
        let writer = schema
            .and_then(|schema| SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties)))
            .map_err(|error| broken(&error))?;
        let columns = fields.iter().map(|(_, physical)| Values::new(*physical)).collect();
        Ok(Self { file: writer, columns, rows: 0, text_bytes: 0 })
    }

    /// One object.
    pub(super) fn row(&mut self, inventory: &Inventory, line: &Line) -> Result<(), Problem> {
        let mut columns = self.columns.iter_mut();
        for column in COLUMNS {
            let cell = (column.cell)(line);
            let overturned = cell == Cell::Overturned;
            let is_known = cell != Cell::Missing;
            self.text_bytes += columns.next().map_or(0, |values| values.push(cell));
            if column.kind == Kind::Ranked
                && let Some(values) = columns.next()
            {
                values.push(if is_known { Cell::Flag(overturned) } else { Cell::Missing });
            }
        }
        for (values, cell) in columns.zip(carried_cells(inventory, line.item)) {
            self.text_bytes += values.push(cell);
        }
        self.rows += 1;
        if self.rows >= GROUP_ROWS || self.text_bytes >= GROUP_TEXT_BYTES { self.end_group() } else { Ok(()) }
    }

    /// Writes the last group, and whether the result is partial.
    pub(super) fn finish(mut self, overview: &Overview) -> Result<(), Problem> {
        if self.rows > 0 {
            self.end_group()?;
        }
        let partial = overview.partial().unwrap_or_else(|| "no".to_owned());
        self.file.append_key_value_metadata(KeyValue::new("freestand.partial".to_owned(), partial));
        self.file.close().map_err(|error| broken(&error))?;
        Ok(())
    }

    fn end_group(&mut self) -> Result<(), Problem> {
        (self.rows, self.text_bytes) = (0, 0);
        write_group(&mut self.file, &mut self.columns).map_err(|error| broken(&error))
    }
}

fn write_group(file: &mut SerializedFileWriter<File>, columns: &mut [Values]) -> Result<(), ParquetError> {
    let mut group = file.next_row_group()?;
    for column in columns {
        let Some(mut writer) = group.next_column()? else { break };
        let present = Some(&column.present[..]);
        match &mut column.values {
            Typed::Double(values) => {
                writer.typed::<DoubleType>().write_batch(values, present, None)?;
                values.clear();
            }
            Typed::Long(values) => {
                writer.typed::<Int64Type>().write_batch(values, present, None)?;
                values.clear();
            }
            Typed::Flag(values) => {
                writer.typed::<BoolType>().write_batch(values, present, None)?;
                values.clear();
            }
            Typed::Text(values) => {
                writer.typed::<ByteArrayType>().write_batch(values, present, None)?;
                values.clear();
            }
        }
        column.present.clear();
        writer.close()?;
    }
    group.close()?;
    Ok(())
}

impl Values {
    fn new(physical: Physical) -> Self {
        let values = match physical {
            Physical::DOUBLE => Typed::Double(Vec::new()),
            Physical::INT64 => Typed::Long(Vec::new()),
            Physical::BOOLEAN => Typed::Flag(Vec::new()),
            _ => Typed::Text(Vec::new()),
        };
        Self { present: Vec::new(), values }
    }

    /// Adds a cell, as null where it is not of the type of this column; returns the bytes of its
    /// text.
    fn push(&mut self, cell: Cell) -> usize {
        let (mut is_present, mut bytes) = (true, 0);
        match (&mut self.values, cell) {
            (Typed::Double(values), Cell::Number(value)) => values.push(value),
            (Typed::Long(values), Cell::Count(value)) => values.push(i64::try_from(value).unwrap_or(i64::MAX)),
            (Typed::Flag(values), Cell::Flag(value)) => values.push(value),
            (Typed::Text(values), Cell::Text(text)) => {
                bytes = text.len();
                values.push(ByteArray::from(text.into_owned().into_bytes()));
            }
            _ => is_present = false,
        }
        self.present.push(is_present.into());
        bytes
    }
}

/// The names and types of all columns, in order.
fn fields(inventory: &Inventory) -> Vec<(String, Physical)> {
    let mut fields = Vec::new();
    for column in COLUMNS {
        let physical = match column.kind {
            Kind::Text | Kind::Decision => Physical::BYTE_ARRAY,
            Kind::Number | Kind::Share | Kind::Ranked => Physical::DOUBLE,
            Kind::Count => Physical::INT64,
            Kind::Flag => Physical::BOOLEAN,
        };
        fields.push((column.name.to_owned(), physical));
        if column.kind == Kind::Ranked {
            fields.push((overturned_name(column), Physical::BOOLEAN));
        }
    }
    fields.extend(carried_names(&inventory.carried).into_iter().map(|name| (name, Physical::BYTE_ARRAY)));
    fields
}

fn field_type(name: &str, physical: Physical) -> Result<Arc<Type>, ParquetError> {
    let logical = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
    let field = Type::primitive_type_builder(name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()?;
    Ok(Arc::new(field))
}

/// Metadata for a reader who has only this file.
fn metadata(head: &Head) -> Vec<KeyValue> {
    let mut columns = Map::new();
    for column in COLUMNS {
        columns.insert(column.name.to_owned(), json!({"unit": column.unit, "meaning": column.meaning}));
    }
    let facts: Map<String, serde_json::Value> =
        head.facts.iter().map(|(name, value)| (name.clone(), value.as_str().into())).collect();
    let values = [
        ("freestand.version", env!("CARGO_PKG_VERSION").to_owned()),
        ("freestand.schema", "freestand.objects/1".to_owned()),
        ("freestand.columns", serde_json::Value::Object(columns).to_string()),
        ("freestand.facts", serde_json::Value::Object(facts).to_string()),
        ("freestand.assumptions", json!(head.assumptions).to_string()),
    ];
    values.into_iter().map(|(key, value)| KeyValue::new(key.to_owned(), value)).collect()
}

fn broken(error: &ParquetError) -> Problem {
    Problem::new(ProblemKind::Io, format!("cannot write {PARQUET_NAME}: {error}"))
}

#[cfg(test)]
mod tests;
