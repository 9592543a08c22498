//! `objects.parquet`: the columns of `objects.csv` with their types.
//!
//! Where a number is `overturned` it is null, and the Boolean column next to it, `…_overturned`, is
//! `true`.

use std::fs::File;

use serde_json::{Map, json};

use freestand_input::problem::Problem;
use freestand_inventory::Inventory;
use freestand_output::folder::OutputFolder;
use freestand_output::parquet::{ColumnType, ParquetColumn, ParquetFile, ParquetValue};
use freestand_output::paths::io_problem;

use super::Head;
use super::overview::Overview;
use super::table::{COLUMNS, Cell, Kind, Line, carried_cells, carried_names, overturned_name};

/// The file's name.
pub(super) const PARQUET_NAME: &str = "objects.parquet";

/// The table as it is written.
pub(super) struct ParquetTable {
    file: ParquetFile<File>,
}

impl ParquetTable {
    /// Begins the file.
    pub(super) fn begin(
        folder: &OutputFolder,
        head: &Head,
        inventory: &Inventory,
    ) -> Result<Self, Problem> {
        let path = folder.path_of(PARQUET_NAME)?;
        let file = File::create_new(&path)
            .map_err(|error| io_problem(&path, "cannot write the file", &error))?;
        Ok(Self {
            file: ParquetFile::begin(
                file,
                "freestand.objects/1",
                &columns(inventory),
                facts(head),
            )?,
        })
    }

    /// One object.
    pub(super) fn row(&mut self, inventory: &Inventory, line: &Line) -> Result<(), Problem> {
        let of_column = |column: &super::table::Column| {
            let cell = (column.cell)(line);
            let overturned = match cell {
                Cell::Missing => ParquetValue::Missing,
                _ => ParquetValue::Flag(cell == Cell::Overturned),
            };
            [
                Some(value(cell)),
                (column.kind == Kind::Ranked).then_some(overturned),
            ]
            .into_iter()
            .flatten()
        };
        let own = COLUMNS.iter().flat_map(of_column);
        self.file
            .row(own.chain(carried_cells(inventory, line.item).map(value)))
    }

    /// Ends the file, with whether the result is partial.
    pub(super) fn finish(mut self, overview: &Overview) -> Result<(), Problem> {
        self.file.note(
            "freestand.partial",
            overview.partial().unwrap_or_else(|| "no".to_owned()),
        );
        self.file.finish().map(drop)
    }
}

fn value(cell: Cell<'_>) -> ParquetValue<'_> {
    match cell {
        Cell::Text(text) => ParquetValue::Text(text),
        Cell::Number(value) => ParquetValue::Number(value),
        Cell::Count(count) => ParquetValue::Count(count),
        Cell::Flag(flag) => ParquetValue::Flag(flag),
        Cell::Overturned | Cell::Missing => ParquetValue::Missing,
    }
}

/// All columns, in order.
fn columns(inventory: &Inventory) -> Vec<ParquetColumn> {
    let mut columns = Vec::new();
    for column in COLUMNS.iter() {
        let holds = match column.kind {
            Kind::Text | Kind::Decision => ColumnType::Text,
            Kind::Number | Kind::Share | Kind::Ranked => ColumnType::Number,
            Kind::Count => ColumnType::Count,
            Kind::Flag => ColumnType::Flag,
        };
        let described = Some((column.unit.to_owned(), column.meaning.to_owned()));
        columns.push(ParquetColumn {
            name: column.name.to_owned(),
            holds,
            described,
        });
        if column.kind == Kind::Ranked {
            columns.push(ParquetColumn {
                name: overturned_name(column),
                holds: ColumnType::Flag,
                described: None,
            });
        }
    }
    let carried = carried_names(&inventory.carried).into_iter();
    columns.extend(carried.map(|name| ParquetColumn {
        name,
        holds: ColumnType::Text,
        described: None,
    }));
    columns
}

/// Metadata for a reader who has only this file.
fn facts(head: &Head) -> [(String, String); 2] {
    let facts: Map<String, serde_json::Value> = head
        .facts
        .iter()
        .map(|(name, value)| (name.clone(), value.as_str().into()))
        .collect();
    [
        (
            "freestand.facts".to_owned(),
            serde_json::Value::Object(facts).to_string(),
        ),
        (
            "freestand.assumptions".to_owned(),
            json!(head.assumptions).to_string(),
        ),
    ]
}

#[cfg(test)]
mod tests;
