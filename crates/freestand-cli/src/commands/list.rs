//! Flags that say how a list is read: the same in every command that reads one.

use std::path::PathBuf;

use clap::Args;
use freestand_assess::inventory::{CellsRequest, Edit};
use freestand_input::problem::Problems;

/// How the cells of a list are read.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct CellsArgs {
    /// Sheet of the workbook [default: the first with headings of an inventory]
    #[arg(long, value_name = "NAME")]
    pub(crate) sheet: Option<String>,
    /// Mapping file (TOML) that says what columns, floors and numbers of the list mean
    #[arg(long, value_name = "MAP.toml")]
    pub(crate) columns: Option<PathBuf>,
    /// Read a cell as if it contained TEXT; may be given several times. The file is not changed. An edit
    /// of a size, also with the text that the cell has, confirms that size
    #[arg(long, value_name = "CELL=TEXT")]
    pub(crate) edit: Vec<String>,
}

impl CellsArgs {
    /// The cells that are read otherwise.
    ///
    /// # Errors
    /// What is not a cell and its text.
    pub(crate) fn edits(&self) -> Result<Vec<Edit>, Problems> {
        let mut problems = Problems::default();
        let read =
            |text: &String| problems.keep(Edit::parse(text).map_err(|one| one.named("edit")));
        let edits = self.edit.iter().filter_map(read).collect();
        problems.finish(Some(edits))
    }

    /// How the cells of a list are read.
    ///
    /// # Errors
    /// What is not a cell and its text.
    pub(crate) fn request(&self) -> Result<CellsRequest, Problems> {
        Ok(CellsRequest {
            sheet: self.sheet.clone(),
            columns: self.columns.clone(),
            edits: self.edits()?,
        })
    }

    /// A flag that is given.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let given = [
            (self.sheet.is_some(), "--sheet"),
            (self.columns.is_some(), "--columns"),
            (!self.edit.is_empty(), "--edit"),
        ];
        given
            .into_iter()
            .find_map(|(is_given, flag)| is_given.then_some(flag))
    }
}
