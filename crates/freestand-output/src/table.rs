//! A table that is written as CSV and, if wanted, as Parquet too: the text, and what each of its
//! columns holds.

use freestand_input::formula::unguarded;
use freestand_input::{Problem, ProblemKind};

use crate::parquet::{ColumnType, ParquetColumn, ParquetFile, ParquetValue};
use crate::units::unit_within;

/// A table as CSV, whose columns have types.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    csv: Vec<u8>,
    columns: Vec<(String, Holds)>,
}

/// What a column holds, as far as its values have shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Holds {
    /// Nothing so far.
    #[default]
    Nothing,
    /// Numbers.
    Number,
    /// Whole numbers.
    Count,
    /// Yes or no.
    Flag,
    /// Texts.
    Text,
    /// Numbers, in whose place this word may stand.
    NumberOr(&'static str),
}

impl Holds {
    /// What a column holds that holds `self` and `other`: whole numbers among numbers are numbers,
    /// and anything else in two types is a text.
    pub(crate) fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Nothing, one) | (one, Self::Nothing) => one,
            (one, other) if one == other => one,
            (Self::Number | Self::Count, Self::Number | Self::Count) => Self::Number,
            (word @ Self::NumberOr(_), Self::Number | Self::Count)
            | (Self::Number | Self::Count, word @ Self::NumberOr(_)) => word,
            _ => Self::Text,
        }
    }

    fn column_type(self, name: &str) -> ColumnType {
        match self {
            Self::Nothing if unit_within(name).is_some() => ColumnType::Number,
            Self::Number | Self::NumberOr(_) => ColumnType::Number,
            Self::Count => ColumnType::Count,
            Self::Flag => ColumnType::Flag,
            Self::Text | Self::Nothing => ColumnType::Text,
        }
    }
}

impl Table {
    /// A table with this text; `columns` are the names of its first line and what they hold.
    pub(crate) fn new(csv: Vec<u8>, columns: Vec<(String, Holds)>) -> Self {
        Self { csv, columns }
    }

    /// The table as Parquet, with the numbers of the CSV to the last bit. An empty cell is a null.
    /// Where a word such as `overturned` is in the place of a number, the number is null, and the
    /// Boolean column next to it, `…_overturned`, is `true`. A column without any value holds
    /// numbers if its name contains a unit, and texts otherwise. Of two columns with the same name,
    /// the second gets a number.
    ///
    /// `schema` names the command, such as `freestand.risk/1`; `facts` are further metadata.
    ///
    /// # Errors
    /// None in practice: the text is ours, and writing to memory does not fail.
    pub fn parquet(
        &self,
        schema: &str,
        facts: impl IntoIterator<Item = (String, String)>,
    ) -> Result<Vec<u8>, Problem> {
        let mut columns: Vec<ParquetColumn> = Vec::new();
        for (name, holds) in &self.columns {
            let holds_type = holds.column_type(name);
            let unit = unit_within(name)
                .filter(|unit| holds_type == ColumnType::Number && !unit.is_empty());
            let described = Some((unit.unwrap_or("–").to_owned(), String::new()));
            let count = columns
                .iter()
                .filter(|one| is_numbered(&one.name, name))
                .count();
            let unique = if count == 0 {
                name.clone()
            } else {
                format!("{name}_{}", count + 1)
            };
            columns.push(ParquetColumn {
                name: unique.clone(),
                holds: holds_type,
                described,
            });
            if let Holds::NumberOr(word) = holds {
                let name = format!("{unique}_{word}");
                columns.push(ParquetColumn {
                    name,
                    holds: ColumnType::Flag,
                    described: None,
                });
            }
        }
        let mut file = ParquetFile::begin(Vec::new(), schema, &columns, facts)?;
        let mut reader = csv::Reader::from_reader(&self.csv[..]);
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(broken)? {
            let cells = self.columns.iter().zip(&record);
            file.row(cells.flat_map(|((name, holds), cell)| {
                let word = match holds {
                    Holds::NumberOr(_) if cell.is_empty() => Some(ParquetValue::Missing),
                    Holds::NumberOr(word) => Some(ParquetValue::Flag(cell == *word)),
                    _ => None,
                };
                [Some(value(cell, holds.column_type(name))), word]
                    .into_iter()
                    .flatten()
            }))?;
        }
        file.finish()
    }
}

/// The problem of a table that cannot be written.
pub fn broken(error: csv::Error) -> Problem {
    Problem::new(
        ProblemKind::Io,
        format!("a table cannot be written: {error}"),
    )
}

/// Whether a column has this name, with a number or without.
fn is_numbered(column: &str, name: &str) -> bool {
    let rest = column.strip_prefix(name);
    rest.is_some_and(|rest| {
        rest.is_empty()
            || rest
                .strip_prefix('_')
                .is_some_and(|rest| rest.parse::<usize>().is_ok())
    })
}

fn value(cell: &str, holds: ColumnType) -> ParquetValue<'_> {
    let read = match holds {
        _ if cell.is_empty() => None,
        ColumnType::Number => cell.parse().ok().map(ParquetValue::Number),
        ColumnType::Count => cell.parse().ok().map(ParquetValue::Count),
        ColumnType::Flag => cell.parse().ok().map(ParquetValue::Flag),
        ColumnType::Text => Some(ParquetValue::Text(unguarded(cell).into())),
    };
    read.unwrap_or(ParquetValue::Missing)
}

/// The CSV.
impl AsRef<[u8]> for Table {
    fn as_ref(&self) -> &[u8] {
        &self.csv
    }
}

/// The CSV.
impl From<Table> for Vec<u8> {
    fn from(table: Table) -> Self {
        table.csv
    }
}

/// The CSV.
impl std::fmt::Display for Table {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&String::from_utf8_lossy(&self.csv))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::facts::{Facts, Value, table};
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;
    use std::io::Write;

    #[test]
    fn a_table_is_written_as_parquet_with_its_types_and_units() {
        let ranked = |value: Option<f64>| Value::NumberOr(value, "overturned");
        let row = |motion: &'static str, uplift_m: Option<f64>, median: Value<'static>| {
            Facts::default()
                .key("motion", motion)
                .key("uplift_m", uplift_m)
                .key("uplift_m_median", median)
                .key("motions", 3_usize)
                .key("is_last", motion == "2")
                .key("ceiling_g", None::<f64>)
                .key("reason", None::<String>)
        };
        let rows = [
            row("1", None, ranked(None)),
            row("2", Some(0.1 + 0.2), ranked(Some(1e-300))),
            row("", Some(2.0), Value::Missing),
        ];
        let one = table(rows).unwrap();
        let bytes = one
            .parquet(
                "freestand.run/1",
                [("freestand.seed".to_owned(), "7".to_owned())],
            )
            .unwrap();
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&bytes).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let metadata = reader
            .metadata()
            .file_metadata()
            .key_value_metadata()
            .unwrap();
        let fact = |key: &str| {
            metadata
                .iter()
                .find(|one| one.key == key)
                .and_then(|one| one.value.clone())
                .unwrap()
        };
        assert_eq!(
            (
                fact("freestand.seed").as_str(),
                fact("freestand.schema").as_str()
            ),
            ("7", "freestand.run/1")
        );
        let units: serde_json::Value = serde_json::from_str(&fact("freestand.columns")).unwrap();
        let unit = |name: &str| units[name]["unit"].as_str().unwrap().to_owned();
        assert_eq!(
            ["uplift_m", "uplift_m_median", "ceiling_g", "motion"].map(unit),
            ["m", "m", "g", "–"]
        );
        let rows: Vec<Vec<(String, Field)>> = reader
            .get_row_iter(None)
            .unwrap()
            .map(|row| {
                row.unwrap()
                    .get_column_iter()
                    .map(|(n, f)| (n.clone(), f.clone()))
                    .collect()
            })
            .collect();
        let names: Vec<&str> = rows[0].iter().map(|(name, _)| name.as_str()).collect();
        let expected = [
            "motion",
            "uplift_m",
            "uplift_m_median",
            "uplift_m_median_overturned",
            "motions",
            "is_last",
        ];
        assert_eq!(names[..6], expected);
        let fields = |row: usize| {
            rows[row]
                .iter()
                .map(|(_, field)| field.clone())
                .collect::<Vec<_>>()
        };
        let text = |text: &str| Field::Str(text.to_owned());
        let (yes, no, null) = (Field::Bool(true), Field::Bool(false), Field::Null);
        let ends = || [null.clone(), null.clone()];
        let first = [
            text("1"),
            null.clone(),
            null.clone(),
            yes.clone(),
            Field::Long(3),
            no.clone(),
        ];
        assert_eq!(fields(0), [&first[..], &ends()].concat());
        let second = [
            text("2"),
            Field::Double(0.1 + 0.2),
            Field::Double(1e-300),
            no.clone(),
            Field::Long(3),
            yes,
        ];
        assert_eq!(fields(1), [&second[..], &ends()].concat());
        let third = [
            null.clone(),
            Field::Double(2.0),
            null.clone(),
            null.clone(),
            Field::Long(3),
            no,
        ];
        assert_eq!(fields(2), [&third[..], &ends()].concat());
        // A column without values holds numbers where its name has a unit.
        let types: Vec<_> = reader
            .metadata()
            .row_group(0)
            .columns()
            .iter()
            .map(|one| one.column_type())
            .collect();
        assert_eq!(
            types[6..],
            [
                parquet::basic::Type::DOUBLE,
                parquet::basic::Type::BYTE_ARRAY
            ]
        );
    }

    #[test]
    fn a_text_that_looks_like_a_formula_is_a_text_in_csv_and_unchanged_in_parquet() {
        let rows = ["=cmd|' /C calc'!A0", "\t=1", "＝1", "-5", "rack"];
        let one = table(rows.map(|id| Facts::default().key("id", id).key("share", -0.5))).unwrap();
        let text = one.to_string();
        assert_eq!(
            text.lines()
                .skip(1)
                .map(|line| line.trim_matches('"'))
                .collect::<Vec<_>>(),
            [
                "'=cmd|' /C calc'!A0,-0.5",
                "'\t=1,-0.5",
                "'＝1,-0.5",
                "'-5,-0.5",
                "rack,-0.5"
            ]
        );
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&one.parquet("freestand.risk/1", []).unwrap())
            .unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let id = |row: parquet::record::Row| {
            row.get_column_iter().next().map(|(_, field)| field.clone())
        };
        let read: Vec<_> = reader
            .get_row_iter(None)
            .unwrap()
            .filter_map(|row| id(row.unwrap()))
            .collect();
        assert_eq!(read, rows.map(|id| Field::Str(id.to_owned())));
    }

    #[test]
    fn the_second_of_two_equal_names_gets_a_number() {
        let numbers =
            crate::rows::table_of_numbers("time_s,at_g,at_g,at_g", [[0.5, 1.0, 2.0, f64::NAN]]);
        let bytes = numbers.parquet("freestand.rock/1", []).unwrap();
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&bytes).unwrap();
        let reader = SerializedFileReader::new(file).unwrap();
        let row = reader.get_row_iter(None).unwrap().next().unwrap().unwrap();
        let cells: Vec<_> = row
            .get_column_iter()
            .map(|(name, field)| (name.as_str(), field.clone()))
            .collect();
        let number = Field::Double;
        assert_eq!(
            cells,
            [
                ("time_s", number(0.5)),
                ("at_g", number(1.0)),
                ("at_g_2", number(2.0)),
                ("at_g_3", Field::Null)
            ]
        );
    }

    #[test]
    fn types_that_meet_in_a_column_make_the_wider_one() {
        let word = Holds::NumberOr("overturned");
        assert_eq!(Holds::Nothing.and(Holds::Flag), Holds::Flag);
        assert_eq!(Holds::Count.and(Holds::Number), Holds::Number);
        assert_eq!(Holds::Number.and(word).and(Holds::Count), word);
        assert_eq!(
            (
                Holds::Number.and(Holds::Text),
                Holds::Flag.and(Holds::Count)
            ),
            (Holds::Text, Holds::Text)
        );
    }
}
