//! The one writer of Parquet files: a table of typed columns, written in groups of rows so that memory
//! stays bounded.
//!
//! Numbers are optional doubles, whole numbers optional 64-bit integers, texts optional UTF-8, flags
//! optional Booleans. The same rows give the same bytes: the format version, the compression (Zstandard,
//! level 3) and the groups (65,536 rows) are fixed, and nothing depends on the clock. The metadata have
//! the version of the program and the unit of every column.

use std::borrow::Cow;
use std::io::Write;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use serde_json::{Map, json};

use freestand_input::problem::{Problem, ProblemKind};

/// Rows of a group.
const GROUP_ROWS: usize = 65_536;

/// Bytes of text after which a group ends early, whatever the length of names and notes.
const GROUP_TEXT_BYTES: usize = 64 << 20;

/// Zstandard: higher levels take longer and save little.
const ZSTD_LEVEL: i32 = 3;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnType {
    /// Numbers.
    Number,
    /// Whole numbers.
    Count,
    /// Yes or no.
    Flag,
    /// Texts.
    Text,
}

/// A column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ParquetColumn {
    /// Its name.
    pub name: String,
    /// What it holds.
    pub holds: ColumnType,
    /// Its unit and what it means, for the metadata; `None`: its name says all.
    pub described: Option<(String, String)>,
}

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub enum ParquetValue<'a> {
    /// Nothing: a null.
    Missing,
    /// A number; one that is not finite becomes a null.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// Yes or no.
    Flag(bool),
    /// A text.
    Text(Cow<'a, str>),
}

/// The metadata of a table of results: its seed, and the files that were read, each with its name and
/// its SHA-256, as JSON.
pub fn provenance(
    seed: Option<u64>,
    inputs: impl IntoIterator<Item = (String, Option<String>)>,
) -> Vec<(String, String)> {
    let inputs: Vec<_> = inputs
        .into_iter()
        .map(|(name, sha256)| json!({"name": name, "sha256": sha256}))
        .collect();
    let seed = seed.map(|seed| ("freestand.seed".to_owned(), seed.to_string()));
    seed.into_iter()
        .chain([(
            "freestand.inputs".to_owned(),
            serde_json::Value::from(inputs).to_string(),
        )])
        .collect()
}

/// A file as it is written.
pub struct ParquetFile<W: Write + Send> {
    file: SerializedFileWriter<W>,
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
    Number(Vec<f64>),
    Count(Vec<i64>),
    Flag(Vec<bool>),
    Text(Vec<ByteArray>),
}

impl<W: Write + Send> ParquetFile<W> {
    /// Begins a file. `schema` names what the table is, such as `freestand.objects/1`; `facts` are
    /// further metadata: names and texts.
    ///
    /// # Errors
    /// Two columns with the same name, or a disk that is full.
    pub fn begin(
        file: W,
        schema: &str,
        columns: &[ParquetColumn],
        facts: impl IntoIterator<Item = (String, String)>,
    ) -> Result<Self, Problem> {
        let types = columns
            .iter()
            .map(|column| field_type(&column.name, column.holds))
            .collect::<Result<_, _>>();
        let table = schema.strip_prefix("freestand.").unwrap_or(schema);
        let table = table.split('/').next().unwrap_or_default();
        let group =
            types.and_then(|types| Type::group_type_builder(table).with_fields(types).build());
        let described = columns
            .iter()
            .filter_map(|column| Some((&column.name, column.described.as_ref()?)));
        let units: Map<String, serde_json::Value> = described
            .map(|(name, (unit, meaning))| {
                (name.clone(), json!({"unit": unit, "meaning": meaning}))
            })
            .collect();
        let own = [
            ("freestand.version", env!("CARGO_PKG_VERSION").to_owned()),
            ("freestand.schema", schema.to_owned()),
            (
                "freestand.columns",
                serde_json::Value::Object(units).to_string(),
            ),
        ];
        let own = own.into_iter().map(|(key, value)| (key.to_owned(), value));
        let metadata = own
            .chain(facts)
            .map(|(key, value)| KeyValue::new(key, value))
            .collect();
        let properties = ZstdLevel::try_new(ZSTD_LEVEL).map(|level| {
            WriterProperties::builder()
                .set_compression(Compression::ZSTD(level))
                .set_created_by(format!("freestand {}", env!("CARGO_PKG_VERSION")))
                .set_key_value_metadata(Some(metadata))
                .build()
        });
        let writer = group
            .and_then(|group| {
                SerializedFileWriter::new(file, Arc::new(group), Arc::new(properties?))
            })
            .map_err(|error| broken(&error))?;
        let columns = columns
            .iter()
            .map(|column| Values::new(column.holds))
            .collect();
        Ok(Self {
            file: writer,
            columns,
            rows: 0,
            text_bytes: 0,
        })
    }

    /// Adds a row: a value for each column, in their order. A value that is not of the type of its
    /// column, or is absent, is a null.
    ///
    /// # Errors
    /// A disk that is full.
    pub fn row<'a>(
        &mut self,
        values: impl IntoIterator<Item = ParquetValue<'a>>,
    ) -> Result<(), Problem> {
        let values = values
            .into_iter()
            .chain(std::iter::repeat(ParquetValue::Missing));
        for (column, value) in self.columns.iter_mut().zip(values) {
            self.text_bytes += column.push(value);
        }
        self.rows += 1;
        if self.rows >= GROUP_ROWS || self.text_bytes >= GROUP_TEXT_BYTES {
            self.end_group()
        } else {
            Ok(())
        }
    }

    /// Adds to the metadata what is known at the end only.
    pub fn note(&mut self, name: &str, text: String) {
        self.file
            .append_key_value_metadata(KeyValue::new(name.to_owned(), text));
    }

    /// Writes the last group and the end of the file.
    ///
    /// # Errors
    /// A disk that is full.
    pub fn finish(mut self) -> Result<W, Problem> {
        if self.rows > 0 {
            self.end_group()?;
        }
        self.file.into_inner().map_err(|error| broken(&error))
    }

    fn end_group(&mut self) -> Result<(), Problem> {
        (self.rows, self.text_bytes) = (0, 0);
        write_group(&mut self.file, &mut self.columns).map_err(|error| broken(&error))
    }
}

fn write_group<W: Write + Send>(
    file: &mut SerializedFileWriter<W>,
    columns: &mut [Values],
) -> Result<(), ParquetError> {
    let mut group = file.next_row_group()?;
    for column in columns {
        let Some(mut writer) = group.next_column()? else {
            break;
        };
        let present = Some(&column.present[..]);
        match &mut column.values {
            Typed::Number(values) => {
                writer
                    .typed::<DoubleType>()
                    .write_batch(values, present, None)?;
                values.clear();
            }
            Typed::Count(values) => {
                writer
                    .typed::<Int64Type>()
                    .write_batch(values, present, None)?;
                values.clear();
            }
            Typed::Flag(values) => {
                writer
                    .typed::<BoolType>()
                    .write_batch(values, present, None)?;
                values.clear();
            }
            Typed::Text(values) => {
                writer
                    .typed::<ByteArrayType>()
                    .write_batch(values, present, None)?;
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
    fn new(holds: ColumnType) -> Self {
        let values = match holds {
            ColumnType::Number => Typed::Number(Vec::new()),
            ColumnType::Count => Typed::Count(Vec::new()),
            ColumnType::Flag => Typed::Flag(Vec::new()),
            ColumnType::Text => Typed::Text(Vec::new()),
        };
        Self {
            present: Vec::new(),
            values,
        }
    }

    /// Adds a value; returns the bytes of its text.
    fn push(&mut self, value: ParquetValue) -> usize {
        let (mut is_present, mut bytes) = (true, 0);
        match (&mut self.values, value) {
            (Typed::Number(values), ParquetValue::Number(value)) if value.is_finite() => {
                values.push(value)
            }
            (Typed::Count(values), ParquetValue::Count(value)) => {
                values.push(i64::try_from(value).unwrap_or(i64::MAX))
            }
            (Typed::Flag(values), ParquetValue::Flag(value)) => values.push(value),
            (Typed::Text(values), ParquetValue::Text(text)) => {
                bytes = text.len();
                values.push(ByteArray::from(text.into_owned().into_bytes()));
            }
            _ => is_present = false,
        }
        self.present.push(is_present.into());
        bytes
    }
}

fn field_type(name: &str, holds: ColumnType) -> Result<Arc<Type>, ParquetError> {
    let physical = match holds {
        ColumnType::Number => Physical::DOUBLE,
        ColumnType::Count => Physical::INT64,
        ColumnType::Flag => Physical::BOOLEAN,
        ColumnType::Text => Physical::BYTE_ARRAY,
    };
    let logical = (holds == ColumnType::Text).then_some(LogicalType::String);
    let field = Type::primitive_type_builder(name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()?;
    Ok(Arc::new(field))
}

fn broken(error: &ParquetError) -> Problem {
    Problem::new(
        ProblemKind::Io,
        format!("a Parquet table cannot be written: {error}"),
    )
    .hint("free space on the disk, or choose another place")
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    fn column(name: &str, holds: ColumnType) -> ParquetColumn {
        ParquetColumn {
            name: name.to_owned(),
            holds,
            described: Some(("m".to_owned(), "a length".to_owned())),
        }
    }

    /// Types, nulls, groups of 65,536 rows, Zstandard, and the same bytes again.
    #[test]
    fn values_come_back_in_groups() {
        let columns = [
            column("height_m", ColumnType::Number),
            column("count", ColumnType::Count),
            column("sensitive", ColumnType::Flag),
            column("motion", ColumnType::Text),
        ];
        let write = || {
            let facts = [("freestand.study".to_owned(), "a.toml".to_owned())];
            let mut file =
                ParquetFile::begin(Vec::new(), "freestand.rows/1", &columns, facts).unwrap();
            file.row([
                ParquetValue::Number(0.1 + 0.2),
                ParquetValue::Count(7),
                ParquetValue::Flag(true),
                ParquetValue::Text("ü\n".into()),
            ])
            .unwrap();
            file.row([ParquetValue::Number(f64::NAN), ParquetValue::Number(1.0)])
                .unwrap();
            for _ in 2..65_537 {
                file.row([ParquetValue::Missing]).unwrap();
            }
            file.note("freestand.partial", "no".to_owned());
            file.finish().unwrap()
        };
        let bytes = write();
        assert_eq!(bytes, write());
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&bytes).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let metadata = reader.metadata();
        assert_eq!(
            (metadata.num_row_groups(), metadata.row_group(0).num_rows()),
            (2, 65_536)
        );
        assert!(matches!(
            metadata.row_group(0).column(0).compression(),
            Compression::ZSTD(_)
        ));
        let values = metadata.file_metadata().key_value_metadata().unwrap();
        let value = |key: &str| {
            values
                .iter()
                .find(|one| one.key == key)
                .and_then(|one| one.value.as_deref())
                .unwrap()
        };
        assert_eq!(
            (value("freestand.study"), value("freestand.partial")),
            ("a.toml", "no")
        );
        assert!(
            value("freestand.columns").contains(r#""height_m":{"unit":"m","meaning":"a length"}"#)
        );
        let rows: Vec<Vec<Field>> = reader
            .get_row_iter(None)
            .unwrap()
            .take(3)
            .map(|row| {
                row.unwrap()
                    .get_column_iter()
                    .map(|(_, field)| field.clone())
                    .collect()
            })
            .collect();
        let first = [
            Field::Double(0.1 + 0.2),
            Field::Long(7),
            Field::Bool(true),
            Field::Str("ü\n".to_owned()),
        ];
        assert_eq!(
            (rows[0].as_slice(), rows[1].as_slice()),
            (first.as_slice(), [const { Field::Null }; 4].as_slice())
        );
    }
}
