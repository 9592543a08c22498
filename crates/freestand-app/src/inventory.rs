//! `inventory template` and `inventory convert`: a list to fill in, and a list in another format. The file that is
//! written is no part of what is asked.

use std::path::PathBuf;

use freestand_input::problem::Problems;
use freestand_input::words::Choices;
use freestand_input::written::Written;
use freestand_inventory::Target;
use schemars::JsonSchema;
use serde::Serialize;

use crate::files::Files;
use crate::request::{Question, Request as _, one_of, path_without_flag, reader, request};

/// The formats of a list.
pub const FORMATS: Choices<Target> = &[
    (Target::Csv, "csv", "Commas, UTF-8"),
    (Target::Xlsx, "xlsx", "A workbook"),
];

request! { question
    /// A list to fill in.
    pub struct InventoryTemplate {
        /// Write a workbook, with a sheet that explains the columns
        pub xlsx = switch,
        /// Write CSV
        pub csv = switch,
    }
}

request! { question
    /// A list in another format.
    pub struct InventoryConvert {
        /// Inventory (CSV or XLSX)
        #[arg(value_name = "FILE")]
        pub file: Option<Written>,
        /// Format to write
        pub to = "FORMAT" with (value_parser = one_of(FORMATS)),
        /// Sheet of the workbook [default: the first with headings of an inventory]
        pub sheet = "NAME",
    }
}

/// What is to be converted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Conversion {
    /// The list.
    pub file: PathBuf,
    /// Its new format.
    pub to: Target,
    /// The sheet of a workbook.
    pub sheet: Option<String>,
}

impl Question for InventoryTemplate {
    /// The format; `None`: that of the file that is written.
    type Meant = Option<Target>;

    fn resolve(&self, _: &Files) -> Result<Self::Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        read.exclusive("xlsx", "csv");
        let format = match (read.flag("xlsx"), read.flag("csv")) {
            (true, _) => Some(Target::Xlsx),
            (_, true) => Some(Target::Csv),
            _ => None,
        };
        read.problems.finish(Some(format))
    }
}

impl Question for InventoryConvert {
    type Meant = Conversion;

    fn resolve(&self, files: &Files) -> Result<Conversion, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let hint = "name a file, such as objects.csv";
        read.require("file", "no list is named", hint);
        read.require("to", "`to` is missing", "give a format: csv or xlsx");
        let file = path_without_flag(&mut read, "file", files);
        let to = read.choice("to", FORMATS);
        let sheet = read.one("sheet").map(str::to_owned);
        let conversion = file
            .zip(to)
            .map(|(file, to)| Conversion { file, to, sheet });
        read.problems.finish(conversion)
    }
}

/// A list to fill in.
#[derive(Debug, Serialize, JsonSchema)]
pub struct TemplateReport {
    /// Its format.
    pub format: &'static str,
    /// The file that was written.
    pub path: Option<String>,
    /// Its columns.
    pub columns: Vec<ColumnReport>,
    /// The text, if it was not written to a file.
    pub text: Option<String>,
}

/// A column of the list.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ColumnReport {
    /// Its heading.
    pub name: &'static str,
    /// Its unit.
    pub unit: Option<&'static str>,
    /// Whether every row needs it.
    pub required: bool,
    /// What it is.
    pub meaning: &'static str,
}

/// A list in another format.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ConvertReport {
    /// The file that was read.
    pub source: String,
    /// The new format.
    pub format: &'static str,
    /// The file that was written.
    pub path: Option<String>,
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// The text, if it was not written to a file.
    pub text: Option<String>,
}
