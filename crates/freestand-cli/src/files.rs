//! The output folder of commands that write a few files and a manifest.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::Problem;
use freestand_input::file::{load, sha256_hex};
use freestand_output::figure::{Figure, FigureError};
use freestand_output::folder::{MANIFEST, OutputFolder, write_file};
use freestand_output::json::document;
use freestand_output::parquet::provenance;
use freestand_output::streamed::StreamedFile;
use freestand_output::table::Table;
use serde::Serialize;
use serde_json::Value;

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer::Printer;

/// The files of `--out`; without it, nothing is written.
#[derive(Debug)]
pub(crate) struct Files {
    folder: Option<Folder>,
    printer: Printer,
    /// What is said of Parquet tables; `None`: tables are CSV only.
    parquet: Option<OfParquet>,
}

/// A folder before its files are in place.
#[derive(Debug)]
struct Folder {
    /// Where it will be.
    target: PathBuf,
    staged: OutputFolder,
}

/// What Parquet tables say about themselves.
#[derive(Debug)]
struct OfParquet {
    schema: &'static str,
    facts: Vec<(String, String)>,
}

/// How tables are written.
#[derive(Debug, Default, Args)]
pub(crate) struct TableArgs {
    /// Write each table of --out as Parquet too, with the units in its metadata
    #[arg(long)]
    pub(crate) parquet: bool,
}

/// Refuses two outputs in one file, of which the second would replace the first.
pub(crate) fn refuse_one_for_two(
    (flag, path): (&str, Option<&Path>),
    (other_flag, other): (&str, Option<&Path>),
) -> Result<(), Failure> {
    match path.zip(other) {
        Some((path, other)) if path == other => Err(Failure::usage(
            format!("{flag} and {other_flag} name one file, {}", path.display()),
            "give each a file of its own",
        )),
        _ => Ok(()),
    }
}

impl TableArgs {
    /// Refuses the flag where no folder is named.
    fn check(&self, global: &GlobalArgs) -> Result<(), Failure> {
        if self.parquet && global.out.is_none() {
            let hint = "add --out DIR";
            return Err(Failure::usage(
                "--parquet writes tables to a folder, and --out is not given",
                hint,
            ));
        }
        Ok(())
    }
}

impl Files {
    /// Prepares the folder of `--out` before any work is done; `inputs` are the files that the
    /// command reads.
    pub(crate) fn begin(global: &GlobalArgs, inputs: &[PathBuf]) -> Result<Self, Failure> {
        let folder = match &global.out {
            Some(target) => Some(Folder {
                target: target.clone(),
                staged: OutputFolder::stage(target, global.force, inputs)?,
            }),
            None => None,
        };
        Ok(Self {
            folder,
            printer: Printer::new(global),
            parquet: None,
        })
    }

    /// The same, of a command that writes tables; `schema` names its document, and `seed` is that of
    /// its random numbers, if it draws any.
    pub(crate) fn with_tables(
        global: &GlobalArgs,
        inputs: &[PathBuf],
        tables: &TableArgs,
        schema: &'static str,
        seed: Option<u64>,
    ) -> Result<Self, Failure> {
        tables.check(global)?;
        let facts = tables.parquet.then(|| fingerprints(inputs)).transpose()?;
        let parquet = facts.map(|inputs| OfParquet {
            schema,
            facts: provenance(seed, inputs),
        });
        Ok(Self {
            parquet,
            ..Self::begin(global, inputs)?
        })
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
        let Some(Folder { target, staged }) = &self.folder else {
            return Ok(None);
        };
        staged.write(name, bytes().as_ref())?;
        Ok(Some(path_text(&target.join(name))))
    }

    /// Writes a table as `NAME.csv`, and as `NAME.parquet` if wanted; does nothing without `--out`.
    pub(crate) fn table(
        &self,
        name: &str,
        table: impl FnOnce() -> Result<Table, Problem>,
    ) -> Result<(), Failure> {
        if !self.wanted() {
            return Ok(());
        }
        let table = table()?;
        if let Some(OfParquet { schema, facts }) = &self.parquet {
            let bytes = table.parquet(schema, facts.clone())?;
            self.write(&format!("{name}.parquet"), || bytes)?;
        }
        self.write(&format!("{name}.csv"), || table)?;
        Ok(())
    }

    /// Draws a figure and writes it as SVG and PNG; does nothing without `--out`.
    pub(crate) fn figure(
        &self,
        name: &str,
        draw: impl FnOnce() -> Result<Figure, FigureError>,
    ) -> Result<(), Failure> {
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
        Ok(self
            .folder
            .as_ref()
            .map(|folder| folder.staged.begin(name))
            .transpose()?)
    }

    /// The final path of a file; `None` without `--out`.
    pub(crate) fn path(&self, name: &str) -> Option<String> {
        self.folder
            .as_ref()
            .map(|folder| path_text(&folder.target.join(name)))
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
        if let Some(Folder { staged: folder, .. }) = &self.folder {
            folder.write(
                RESULT,
                document(schema, &without_timing(body)?, warnings)?.as_bytes(),
            )?;
            if let Some(session) = printer.session() {
                let mut names = folder.names()?;
                names.push(MANIFEST.to_owned());
                session.files(&names, false);
            }
        }
        self.finish_result(schema, warnings)?;
        printer.result(schema, body, warnings, text)
    }

    /// Adds the short manifest of a command whose document has been written as [`RESULT`], and
    /// moves the folder into place.
    pub(crate) fn finish_result(self, schema: &str, warnings: &[String]) -> Result<(), Failure> {
        self.finish(
            "freestand.manifest/1",
            &serde_json::json!({"result": schema}),
            warnings,
        )
    }

    /// Adds `manifest.json`, which is the printed document with the names of all files, and moves
    /// the folder into place.
    pub(crate) fn finish<T: Serialize>(
        self,
        schema: &str,
        body: &T,
        warnings: &[String],
    ) -> Result<(), Failure> {
        let Some(Folder { staged: folder, .. }) = self.folder else {
            return Ok(());
        };
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

/// Writes a table to a file that the user named: as Parquet if the name ends in `.parquet`, otherwise
/// as CSV.
pub(crate) fn write_table(
    path: &Path,
    table: Table,
    schema: &str,
    inputs: &[PathBuf],
) -> Result<(), Problem> {
    let is_parquet = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("parquet"));
    let bytes = if is_parquet {
        table.parquet(schema, provenance(None, fingerprints(inputs)?))?
    } else {
        table.into()
    };
    write_file(path, &bytes, inputs)
}

/// The names and SHA-256 of the files that a command reads.
pub(crate) fn fingerprints(inputs: &[PathBuf]) -> Result<Vec<(String, Option<String>)>, Problem> {
    let one = |path: &PathBuf| {
        // A pipe cannot be read again.
        let sha256 = if path.is_file() {
            Some(sha256_hex(&load(path)?))
        } else {
            None
        };
        Ok((
            path.file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
            sha256,
        ))
    };
    inputs.iter().map(one).collect()
}

/// A body without the time that its calculation took: equal runs write equal files.
pub(crate) fn without_timing<T: Serialize>(body: &T) -> Result<Value, Failure> {
    let defect = |error| Failure::computation(format!("the result is not JSON: {error}"));
    let mut body = serde_json::to_value(body).map_err(defect)?;
    if let Some(timing) = body.get_mut("timing").and_then(Value::as_object_mut) {
        timing.retain(|name, _| !name.ends_with("_s"));
    }
    Ok(body)
}

/// The file in the output folder with the document that `--json` prints, without the seconds of its `timing`.
pub(crate) const RESULT: &str = "result.json";

/// A document with the files that were written. From this list, the next run knows which files it
/// may replace.
#[derive(Debug, Serialize)]
struct Listed<'a, T> {
    #[serde(flatten)]
    body: &'a T,
    files: Vec<String>,
}

/// A path as text for outputs.
pub(crate) fn path_text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
