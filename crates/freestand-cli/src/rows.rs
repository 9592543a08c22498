//! Writes the rows of a long table while they are calculated: to CSV files, JSON documents and
//! standard output.

use std::path::{Path, PathBuf};

use freestand_output::facts::{
    JsonColumn, csv_header, csv_rows, json_columns, json_rows, parquet_columns, parquet_values,
};
use freestand_output::parquet::{ParquetFile, provenance};
use freestand_output::streamed::{StreamedFile, rows_head, rows_in_columns, rows_tail};
use freestand_study::spectrum::{SpectrumChunk, column_type};
use serde::Serialize;

use crate::failure::Failure;
use crate::files::{Files, RESULT, fingerprints, without_timing};
use crate::printer::Printer;

/// Name of the table in the output folder.
pub(crate) const ROWS: &str = "rows.csv";

/// The outputs that receive the rows.
pub(crate) struct Rows {
    schema: &'static str,
    tables: Vec<StreamedFile>,
    documents: Vec<StreamedFile>,
    parquet: Option<Parquet>,
    /// The document by columns, if the request asked for that shape.
    columns: Option<Vec<JsonColumn>>,
    print: bool,
    printer: Printer,
    /// Whether nothing has been written yet.
    first: bool,
}

/// A Parquet table, whose columns are known with its first row.
enum Parquet {
    Waiting(StreamedFile, Vec<PathBuf>),
    Begun(Box<ParquetFile<StreamedFile>>),
}

impl Parquet {
    /// Appends the rows of a chunk.
    fn write(self, schema: &str, chunk: &SpectrumChunk) -> Result<Self, Failure> {
        let mut file = match self {
            Self::Begun(file) => file,
            Self::Waiting(file, _) if chunk.objects() == 0 => {
                return Ok(Self::Waiting(file, Vec::new()));
            }
            Self::Waiting(file, inputs) => {
                let columns = parquet_columns(&chunk.row(0), column_type);
                let facts = provenance(None, fingerprints(&inputs)?);
                Box::new(ParquetFile::begin(file, schema, &columns, facts)?)
            }
        };
        for row in chunk.rows() {
            file.row(parquet_values(&row))?;
        }
        Ok(Self::Begun(file))
    }
}

impl Rows {
    /// Begins every requested output, before any work is done.
    pub(crate) fn begin(
        schema: &'static str,
        printer: &Printer,
        files: &Files,
        (csv, parquet): (Option<&Path>, Option<&Path>),
        inputs: &[PathBuf],
    ) -> Result<Self, Failure> {
        let csv = csv
            .map(|path| StreamedFile::begin(path, inputs))
            .transpose()?;
        let tables = csv.into_iter().chain(files.begin_file(ROWS)?).collect();
        let documents = files.begin_file(RESULT)?.into_iter().collect();
        let parquet = parquet
            .map(|path| StreamedFile::begin(path, inputs))
            .transpose()?;
        let parquet = parquet.map(|file| Parquet::Waiting(file, inputs.to_vec()));
        let columns = printer
            .session()
            .filter(|session| session.wants_columns())
            .map(|_| Vec::new());
        let (print, printer) = (printer.json() && columns.is_none(), printer.clone());
        Ok(Self {
            schema,
            tables,
            documents,
            parquet,
            columns,
            print,
            printer,
            first: true,
        })
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
        if let Some(parquet) = self.parquet.take() {
            self.parquet = Some(parquet.write(self.schema, chunk)?);
        }
        if let Some(columns) = &mut self.columns {
            for piece in chunk.pieces(|rows| json_columns(rows)) {
                let piece = piece?;
                match columns.is_empty() {
                    true => *columns = piece,
                    false => columns
                        .iter_mut()
                        .zip(piece)
                        .for_each(|((_, all), (_, more))| all.extend(more)),
                }
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
        let kept = rows_tail(self.schema, &without_timing(others)?, warnings)?;
        for document in &mut self.documents {
            document.write(kept.as_bytes())?;
        }
        for file in self.tables.into_iter().chain(self.documents) {
            file.finish()?;
        }
        match self.parquet {
            Some(Parquet::Begun(file)) => file.finish()?.finish()?,
            Some(Parquet::Waiting(..)) | None => {}
        }
        files.finish_result(self.schema, warnings)?;
        if let Some((session, columns)) = printer.session().zip(self.columns.as_ref()) {
            session.keep(&rows_in_columns(self.schema, columns, &tail)?);
            session.told_in_columns();
        } else if !printer.json() {
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
            Err(Failure::BrokenPipe)
                if !self.tables.is_empty()
                    || !self.documents.is_empty()
                    || self.parquet.is_some() =>
            {
                self.print = false
            }
            other => other?,
        }
        Ok(())
    }
}
