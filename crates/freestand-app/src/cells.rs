//! How a list is read: its cells, and the user's own libraries.

use std::path::PathBuf;

use clap::ArgAction;
use freestand_input::problem::Problem;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_inventory::{CellsRequest, Edit};

use crate::files::Files;
use crate::request::{path, request};

request! {
    /// How the cells of a list are read.
    pub struct CellKeys {
        /// Sheet of the workbook [default: the first with headings of an inventory]
        pub sheet = "NAME",
        /// Mapping file (TOML) that says what columns, floors and numbers of the list mean
        pub columns = "FILE.toml",
        /// Read a cell as if it contained TEXT; may be given several times. The file is not changed. An edit
        /// of a size, also with the text that the cell has, confirms that size
        #[arg(long, alias = "edits", value_name = "CELL=TEXT", action = ArgAction::Append)]
        pub edit: Vec<Written>,
    }
}

impl CellKeys {
    /// What is asked of the cells.
    pub fn cells(&self, read: &mut WordReader<'_>, files: &Files) -> CellsRequest {
        read.pass(&["edit"]);
        let edits = self.edit.iter().map(edit);
        CellsRequest {
            sheet: read.one("sheet").map(str::to_owned),
            columns: path(read, "columns", files),
            edits: edits.filter_map(|edit| read.keep("edit", edit)).collect(),
        }
    }

    /// The mapping file.
    pub(crate) fn inputs(&self, files: &Files) -> Vec<PathBuf> {
        files.path_of(self.columns.as_ref()).into_iter().collect()
    }
}

request! {
    /// The user's own libraries.
    pub struct Libraries {
        /// Your own tolerance library (CSV); its entries replace built-in entries with the same id
        pub library = "FILE.csv",
        /// Your own cushion library (CSV); its entries replace built-in entries with the same id
        pub cushion_library = "FILE.csv",
    }
}

impl Libraries {
    /// The files of tolerances and of cushions.
    pub(crate) fn paths(&self, read: &mut WordReader<'_>, files: &Files) -> [Option<PathBuf>; 2] {
        ["library", "cushion_library"].map(|key| path(read, key, files))
    }
}

/// A cell and its text: `D7=900 mm`, or a list of both, whose text may contain anything.
fn edit(written: &Written) -> Result<Edit, Problem> {
    let is_plain = |one: &Written| matches!(one, Written::Text(_) | Written::Number(_));
    match written {
        Written::List(both) if both.iter().all(is_plain) && both.len() == 2 => {
            let mut both = both.iter().map(Written::text);
            let (cell, text) = (both.next(), both.next());
            Edit::new(&cell.unwrap_or_default(), &text.unwrap_or_default())
        }
        one if is_plain(one) => Edit::parse(&one.text()),
        _ => Err(Problem::value(
            "a cell and its text are expected",
            "write a list of both, or a text such as \"D7=900 mm\"",
        )),
    }
}
