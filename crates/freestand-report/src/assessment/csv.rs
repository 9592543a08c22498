//! `objects.csv`, written row by row.

use std::mem;

use freestand_input::formula::guarded;
use freestand_input::problem::Problem;
use freestand_input::words::push_shortest;
use freestand_inventory::Inventory;
use freestand_output::folder::OutputFolder;
use freestand_output::rows::{broken, csv_writer};
use freestand_output::streamed::StreamedFile;

use super::table::{COLUMNS, Cell, Line, carried_cells, carried_names};

/// The file's name.
pub(super) const CSV_NAME: &str = "objects.csv";

/// Bytes that are collected before they are written.
const CHUNK_BYTES: usize = 1 << 20;

/// The table as it is written.
pub(super) struct CsvTable {
    file: StreamedFile,
    pending: csv::Writer<Vec<u8>>,
    bytes: usize,
    text: String,
}

impl CsvTable {
    /// Begins the file with its header.
    pub(super) fn begin(folder: &OutputFolder, inventory: &Inventory) -> Result<Self, Problem> {
        let file = folder.begin(CSV_NAME)?;
        let mut table = Self {
            file,
            pending: csv_writer(),
            bytes: 0,
            text: String::new(),
        };
        for column in COLUMNS.iter() {
            table.field(&Cell::text(column.name))?;
        }
        for name in carried_names(&inventory.carried) {
            table.field(&Cell::text(&name))?;
        }
        table.end_row()?;
        Ok(table)
    }

    /// One object.
    pub(super) fn row(&mut self, inventory: &Inventory, line: &Line) -> Result<(), Problem> {
        for column in COLUMNS.iter() {
            self.field(&(column.cell)(line))?;
        }
        for cell in carried_cells(inventory, line.item) {
            self.field(&cell)?;
        }
        self.end_row()
    }

    /// Writes the rest.
    pub(super) fn finish(mut self) -> Result<(), Problem> {
        self.flush()?;
        self.file.finish()
    }

    fn field(&mut self, cell: &Cell) -> Result<(), Problem> {
        self.text.clear();
        push_field(&mut self.text, cell);
        self.bytes += self.text.len();
        self.pending.write_field(&self.text).map_err(broken)
    }

    fn end_row(&mut self) -> Result<(), Problem> {
        self.pending.write_record(None::<&[u8]>).map_err(broken)?;
        if self.bytes > CHUNK_BYTES {
            self.flush()
        } else {
            Ok(())
        }
    }

    fn flush(&mut self) -> Result<(), Problem> {
        self.bytes = 0;
        let pending = mem::replace(&mut self.pending, csv_writer());
        let bytes = pending
            .into_inner()
            .map_err(|error| broken(csv::Error::from(error.into_error())))?;
        self.file.write(&bytes)
    }
}

/// A cell as a field.
pub(super) fn push_field(out: &mut String, cell: &Cell) {
    match cell {
        Cell::Text(text) => out.push_str(&guarded(text)),
        Cell::Number(value) => push_shortest(out, *value),
        Cell::Count(value) => out.push_str(&value.to_string()),
        Cell::Flag(value) => out.push_str(if *value { "true" } else { "false" }),
        Cell::Overturned => out.push_str(OVERTURNED),
        Cell::Missing => {}
    }
}

/// The value of a ranked number where the object overturns.
pub(super) const OVERTURNED: &str = "overturned";
