//! The output folder of commands that write a few files and a manifest.

use std::path::PathBuf;

use freestand_study::output::OutputFolder;
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::printer;
use crate::reading::path_text;

/// Files for `--out`, or nowhere without it.
#[derive(Debug)]
pub(crate) struct Files {
    folder: Option<(PathBuf, OutputFolder)>,
}

impl Files {
    /// Begins the folder of `--out`, before any work is done.
    pub(crate) fn begin(global: &GlobalArgs) -> Result<Self, Failure> {
        let folder = match &global.out {
            Some(target) => Some((target.clone(), OutputFolder::stage(target, global.force)?)),
            None => None,
        };
        Ok(Self { folder })
    }

    /// Writes a file and returns where it will be; nothing without `--out`.
    pub(crate) fn write(&self, name: &str, text: impl FnOnce() -> String) -> Result<Option<String>, Failure> {
        let Some((target, folder)) = &self.folder else { return Ok(None) };
        folder.write(name, text().as_bytes())?;
        Ok(Some(path_text(&target.join(name))))
    }

    /// Adds `manifest.json`, the document that is also printed, and puts the folder in its place.
    pub(crate) fn finish<T: Serialize>(self, schema: &str, body: &T, warnings: &[String]) -> Result<(), Failure> {
        let Some((_, folder)) = self.folder else { return Ok(()) };
        folder.write("manifest.json", printer::document(schema, body, warnings)?.as_bytes())?;
        folder.commit()?;
        Ok(())
    }
}
