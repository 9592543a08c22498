//! The output folder of commands that write a few files and a manifest.

use std::path::PathBuf;

use freestand_output::figure::{Figure, FigureError};
use freestand_output::folder::{MANIFEST, OutputFolder};
use freestand_output::json::document;
use freestand_output::streamed::StreamedFile;
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;
use crate::reading::path_text;

/// The files of `--out`; without it, nothing is written.
#[derive(Debug)]
pub(crate) struct Files {
    folder: Option<(PathBuf, OutputFolder)>,
    printer: Printer,
}

impl Files {
    /// Prepares the folder of `--out` before any work is done; `inputs` are the files that the
    /// command reads.
    pub(crate) fn begin(global: &GlobalArgs, inputs: &[PathBuf]) -> Result<Self, Failure> {
        let folder = match &global.out {
            Some(target) => Some((target.clone(), OutputFolder::stage(target, global.force, inputs)?)),
            None => None,
        };
        Ok(Self { folder, printer: Printer::new(global) })
    }

    /// Whether there is a folder to write to.
    pub(crate) fn wanted(&self) -> bool {
        self.folder.is_some()
    }

    /// Writes a file and returns its final path; does nothing without `--out`.
    pub(crate) fn write<B: AsRef<[u8]>>(
        &self,
        name: &str,
        bytes: impl FnOnce() -> B,
    ) -> Result<Option<String>, Failure> {
        let Some((target, folder)) = &self.folder else { return Ok(None) };
        folder.write(name, bytes().as_ref())?;
        Ok(Some(path_text(&target.join(name))))
    }

    /// Draws a figure and writes it as SVG and PNG; does nothing without `--out`.
    pub(crate) fn figure(&self, name: &str, draw: impl FnOnce() -> Result<Figure, FigureError>) -> Result<(), Failure> {
        if self.wanted() {
            self.drawn(name, &draw()?)?;
        }
        Ok(())
    }

    /// Writes a figure as SVG and PNG and returns their final paths; does nothing without `--out`.
    pub(crate) fn drawn(&self, name: &str, figure: &Figure) -> Result<Vec<String>, Failure> {
        let svg = self.write(&format!("{name}.svg"), || &figure.svg)?;
        let png = self.write(&format!("{name}.png"), || &figure.png)?;
        Ok(svg.into_iter().chain(png).collect())
    }

    /// Begins a file that is written in pieces; `None` without `--out`.
    pub(crate) fn begin_file(&self, name: &str) -> Result<Option<StreamedFile>, Failure> {
        Ok(self.folder.as_ref().map(|(_, folder)| folder.begin(name)).transpose()?)
    }

    /// The final path of a file; `None` without `--out`.
    pub(crate) fn path(&self, name: &str) -> Option<String> {
        self.folder.as_ref().map(|(target, _)| path_text(&target.join(name)))
    }

    /// Ends a command: writes its document as `result.json`, with a short manifest, and prints the
    /// result.
    pub(crate) fn print<T: Serialize>(
        self,
        printer: &Printer,
        schema: &str,
        body: &T,
        warnings: &[String],
        text: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        if let Some((_, folder)) = &self.folder {
            folder.write(RESULT, document(schema, body, warnings)?.as_bytes())?;
        }
        self.finish_result(schema, warnings)?;
        printer.result(schema, body, warnings, text)
    }

    /// Adds the short manifest of a command whose document has been written as [`RESULT`], and
    /// moves the folder into place.
    pub(crate) fn finish_result(self, schema: &str, warnings: &[String]) -> Result<(), Failure> {
        self.finish("freestand.manifest/1", &serde_json::json!({"result": schema}), warnings)
    }

    /// Adds `manifest.json`, which is the printed document with the names of all files, and moves
    /// the folder into place.
    pub(crate) fn finish<T: Serialize>(self, schema: &str, body: &T, warnings: &[String]) -> Result<(), Failure> {
        let Some((_, folder)) = self.folder else { return Ok(()) };
        let mut names = folder.names()?;
        names.push(MANIFEST.to_owned());
        names.sort_unstable();
        let manifest = Listed { body, files: names };
        folder.write(MANIFEST, document(schema, &manifest, warnings)?.as_bytes())?;
        if let Some(note) = folder.commit()?.note() {
            self.printer.note(&note);
        }
        Ok(())
    }
}

/// The file in the output folder with the document that `--json` prints.
pub(crate) const RESULT: &str = "result.json";

/// A document with the files that were written. From this list, the next run knows which files it
/// may replace.
#[derive(Debug, Serialize)]
struct Listed<'a, T> {
    #[serde(flatten)]
    body: &'a T,
    files: Vec<String>,
}
