//! The rows of `objects.csv` as JSON.

use std::fs::File;
use std::path::Path;

use serde_json::{Map, Value};

use freestand_assess::result::Assessment;
use freestand_input::formula::unguarded;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_inventory::{Inventory, Item};
use freestand_output::answer::{Described, explained, object};
use freestand_output::paths::io_problem;
use freestand_study::result::Ranked;

use super::csv::{CSV_NAME, OVERTURNED};
use super::table::{COLUMNS, Cell, Column, Kind, Line, ROW, carried_cells, carried_names};

/// Calls `each` with every row of the `objects.csv` in `folder`: an object with the columns as keys,
/// and the number of its row in the inventory.
///
/// The file is read because it is the only place of the rows of a finished run. A row has its rank once every
/// object is assessed; then the results are not in memory, their parts are removed when the folder is complete,
/// `objects.parquet` is written only on request, and a run that finds its folder complete calculates nothing.
/// Rows that are printed while files are written would stand in a document of a run that then fails.
///
/// Numbers are numbers, or `"overturned"` where that ranks above every number; an empty field is
/// null.
///
/// # Errors
/// A file that cannot be read or is not that of `inventory`, or the first error of `each`.
pub fn object_rows<E: From<Problem>>(
    folder: &Path,
    inventory: &Inventory,
    mut each: impl FnMut(&Map<String, Value>) -> Result<(), E>,
) -> Result<(), E> {
    let path = folder.join(CSV_NAME);
    let file = File::open(&path).map_err(|error| io_problem(&path, "cannot be read", &error))?;
    let mut reader = csv::Reader::from_reader(std::io::BufReader::new(file));
    let changed = || {
        Problem::new(ProblemKind::Format, "is not the table that this run wrote")
            .in_file(&path)
            .hint("run the assessment again, and leave the file as it is until it has ended")
    };
    let header = reader.headers().map_err(|_| changed())?.clone();
    let kinds: Vec<Kind> = (0..header.len())
        .map(|i| COLUMNS.get(i).map_or(Kind::Text, |column| column.kind))
        .collect();
    let mut items = inventory.items.iter();
    for record in reader.into_records() {
        let (record, item) = (
            record.map_err(|_| changed())?,
            items.next().ok_or_else(changed)?,
        );
        let mut row = Map::new();
        for ((name, kind), field) in header.iter().zip(&kinds).zip(&record) {
            row.insert(name.to_owned(), value(*kind, field).ok_or_else(changed)?);
        }
        row.insert(ROW.to_owned(), Value::from(item.row));
        each(&row)?;
    }
    if items.next().is_some() {
        Err(changed().into())
    } else {
        Ok(())
    }
}

/// The schema of a row; columns that only the inventory has are carried through as texts.
pub fn row_schema() -> Value {
    let column = |column: &Column| {
        let schema = match column.kind {
            Kind::Text | Kind::Decision => Option::<String>::schema(),
            Kind::Number | Kind::Share => f64::schema(),
            Kind::Count => Option::<usize>::schema(),
            Kind::Ranked => Ranked::schema(),
            Kind::Flag => Option::<bool>::schema(),
        };
        (
            column.name.to_owned(),
            explained(schema, column.meaning, ""),
        )
    };
    let row = (ROW.to_owned(), usize::schema());
    let mut schema = object(COLUMNS.iter().map(column).chain([row]).collect());
    schema["additionalProperties"] = Option::<String>::schema();
    schema
}

/// Rows of `objects.csv` as JSON, before there is a file.
pub struct JsonRows<'i> {
    inventory: &'i Inventory,
    carried: Vec<String>,
}

impl<'i> JsonRows<'i> {
    /// For the rows of this list.
    pub fn new(inventory: &'i Inventory) -> Self {
        Self {
            inventory,
            carried: carried_names(&inventory.carried),
        }
    }

    /// The row of an object, as [`object_rows`] reads it.
    pub fn row(&self, item: &Item, rank: usize, found: &Assessment) -> Map<String, Value> {
        let line = Line {
            item,
            found: Some((rank, found)),
        };
        let own = COLUMNS
            .iter()
            .map(|column| (column.name.to_owned(), json((column.cell)(&line))));
        let carried = self
            .carried
            .iter()
            .cloned()
            .zip(carried_cells(self.inventory, item).map(json));
        let row = (ROW.to_owned(), Value::from(item.row));
        own.chain(carried).chain([row]).collect()
    }
}

fn json(cell: Cell) -> Value {
    match cell {
        Cell::Text(text) => Value::from(text.into_owned()),
        Cell::Number(value) => Value::from(value),
        Cell::Count(value) => Value::from(value),
        Cell::Overturned => Value::from(OVERTURNED),
        Cell::Flag(value) => Value::from(value),
        Cell::Missing => Value::Null,
    }
}

/// A field as a value; `None` where it is none of its kind.
fn value(kind: Kind, field: &str) -> Option<Value> {
    if field.is_empty() {
        return Some(Value::Null);
    }
    match kind {
        Kind::Text | Kind::Decision => Some(Value::from(unguarded(field))),
        Kind::Ranked if field == OVERTURNED => Some(Value::from(OVERTURNED)),
        Kind::Number | Kind::Share | Kind::Ranked => field.parse::<f64>().ok().map(Value::from),
        Kind::Count => field.parse::<u64>().ok().map(Value::from),
        Kind::Flag => field.parse::<bool>().ok().map(Value::from),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assessment::fixture::{
        HOSTILE, TABLES, hostile_items, inventory, item, read, written,
    };

    fn rows(inventory: &Inventory) -> Vec<Map<String, Value>> {
        let (folder, _) = written(inventory, inventory.items.len(), TABLES);
        let mut rows = Vec::new();
        object_rows(&folder.path().join("out"), inventory, |row| {
            rows.push(row.clone());
            Ok::<(), Problem>(())
        })
        .unwrap();
        // Every field of the file is there under its header.
        let bytes = read(&folder, CSV_NAME);
        let mut reader = csv::Reader::from_reader(&bytes[..]);
        let header = reader.headers().unwrap().clone();
        for row in &rows {
            assert_eq!(row.len(), header.len() + 1);
            assert!(header.iter().all(|name| row.contains_key(name)));
        }
        rows
    }

    #[test]
    fn values_have_their_types() {
        let rows = rows(&inventory((0..4).map(item).collect()));
        let first = &rows[0];
        assert_eq!(
            (
                first["row"].as_u64(),
                first["rank"].as_u64(),
                rows[3]["row"].as_u64()
            ),
            (Some(2), Some(4), Some(5))
        );
        assert_eq!(
            (first["id"].as_str(), first["quantity"].as_u64()),
            (Some("O-0000"), Some(1))
        );
        assert_eq!(
            (first["falls"].as_str(), first["close_call"].as_bool()),
            (Some("falls"), Some(false))
        );
        assert_eq!(
            (
                first["restraint_force_n"].as_f64(),
                first["width_m"].is_null()
            ),
            (Some(410.0), true)
        );
        assert_eq!(
            first["edge_acceleration_g_p84"].as_str(),
            Some("overturned")
        );
        assert_eq!(
            (
                rows[1]["life_safety"].as_str(),
                rows[0]["life_safety"].is_null()
            ),
            (Some("high"), true)
        );
        // A carried number stays the text of the inventory, without the mark for spreadsheets.
        assert_eq!(first["rank (inventory)"].as_str(), Some("-12"));
    }

    /// A row that is told when its object is finished is the one that is read later.
    #[test]
    fn rows_before_there_is_a_file_are_the_same() {
        let inventory = inventory(hostile_items());
        let told = JsonRows::new(&inventory);
        for (read, row) in rows(&inventory)
            .iter()
            .zip(crate::assessment::fixture::rows(
                &inventory,
                inventory.items.len(),
            ))
        {
            assert_eq!(*read, told.row(row.item, row.rank, &row.found));
        }
    }

    #[test]
    fn texts_are_those_of_the_inventory() {
        let rows = rows(&inventory(hostile_items()));
        for (row, text) in rows.iter().zip(HOSTILE) {
            assert_eq!(row["notes"].as_str(), Some(text));
        }
    }

    #[test]
    fn another_table_is_refused() {
        let (folder, _) = written(&inventory((0..3).map(item).collect()), 3, TABLES);
        let more = inventory((0..4).map(item).collect());
        let problem =
            object_rows(&folder.path().join("out"), &more, |_| Ok::<(), Problem>(())).unwrap_err();
        assert!(
            problem
                .to_string()
                .contains("is not the table that this run wrote"),
            "{problem}"
        );
    }
}
