//! Writes the rows of a long table while they are calculated: to CSV files, JSON documents and
//! standard output.

use std::path::{Path, PathBuf};

use freestand_output::facts::{csv_header, csv_rows, json_rows};
use freestand_output::streamed::{StreamedFile, rows_head, rows_tail};
use freestand_study::spectrum::SpectrumChunk;
use serde::Serialize;

use crate::failure::Failure;
use crate::files::{Files, RESULT};
use crate::printer::Printer;

/// Name of the table in the output folder.
pub(crate) const ROWS: &str = "rows.csv";

/// The outputs that receive the rows.
#[derive(Debug)]
pub(crate) struct Rows {
    schema: &'static str,
    tables: Vec<StreamedFile>,
    documents: Vec<StreamedFile>,
    print: bool,
    printer: Printer,
    /// Whether nothing has been written yet.
    first: bool,
}

impl Rows {
    /// Begins every requested output, before any work is done.
    pub(crate) fn begin(
        schema: &'static str,
        printer: &Printer,
        files: &Files,
        csv: Option<&Path>,
        inputs: &[PathBuf],
    ) -> Result<Self, Failure> {
        let csv = csv.map(|path| StreamedFile::begin(path, inputs)).transpose()?;
        let tables = csv.into_iter().chain(files.begin_file(ROWS)?).collect();
        let documents = files.begin_file(RESULT)?.into_iter().collect();
        Ok(Self { schema, tables, documents, print: printer.json(), printer: printer.clone(), first: true })
    }

    /// Appends the rows of a chunk to every output.
    pub(crate) fn write(&mut self, chunk: &SpectrumChunk) -> Result<(), Failure> {
        if !self.tables.is_empty() {
            if self.first && chunk.objects() > 0 {
                self.table(&csv_header(&chunk.row(0))?)?;
            }
            for piece in chunk.pieces(|rows| csv_rows(rows)) {
                self.table(&piece?)?;
            }
        }
        if self.print || !self.documents.is_empty() {
            for (i, piece) in chunk.pieces(|rows| json_rows(rows)).into_iter().enumerate() {
                let mut piece = piece?;
                if self.first && i == 0 {
                    // No comma precedes the first member of an array.
                    piece.splice(0..1, rows_head(self.schema)?.into_bytes());
                }
                self.document(&piece)?;
            }
        }
        self.first = false;
        Ok(())
    }

    /// Ends every output: writes the keys that follow the rows in the document and the manifest,
    /// then prints the rest of the document, or the text, and the warnings.
    pub(crate) fn finish<T: Serialize>(
        mut self,
        files: Files,
        printer: &Printer,
        others: &T,
        warnings: &[String],
        text: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        if self.first {
            self.document(rows_head(self.schema)?.as_bytes())?;
        }
        let tail = rows_tail(self.schema, others, warnings)?;
        for document in &mut self.documents {
            document.write(tail.as_bytes())?;
        }
        for file in self.tables.into_iter().chain(self.documents) {
            file.finish()?;
        }
        files.finish_result(self.schema, warnings)?;
        if !printer.json() {
            printer.print(&text())?;
        } else if self.print {
            printer.print(&tail)?;
        }
        printer.warn(warnings);
        Ok(())
    }

    fn table(&mut self, piece: &[u8]) -> Result<(), Failure> {
        for table in &mut self.tables {
            table.write(piece)?;
        }
        Ok(())
    }

    fn document(&mut self, piece: &[u8]) -> Result<(), Failure> {
        for document in &mut self.documents {
            document.write(piece)?;
        }
        if !self.print {
            return Ok(());
        }
        match self.printer.print_bytes(piece) {
            // The reader has closed the pipe, but the files must be completed.
            Err(Failure::BrokenPipe) if !self.tables.is_empty() || !self.documents.is_empty() => self.print = false,
            other => other?,
        }
        Ok(())
    }
}
