//! How the columns of a list were understood.

use schemars::JsonSchema;
use serde::Serialize;

/// A known column, as it was understood; the columns of the document of `freestand inventory check`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ColumnRead {
    /// Its letter in a spreadsheet: `F`.
    #[serde(rename = "column")]
    pub letter: String,
    /// Its heading in the file.
    pub heading: String,
    /// The row of its heading: a sheet may have several tables.
    pub header_row: u32,
    /// Its name in freestand.
    pub name: &'static str,
    /// The unit of its bare numbers; `None`: it has none, or each cell has its own.
    pub unit: Option<String>,
    /// Where the unit comes from: `mapping`, `heading`, `unit-row`, `sentence`, `cells`,
    /// `plausibility`, or `cell` where each cell has its own.
    pub unit_source: Option<&'static str>,
    /// The decimal sign: `point`, `comma` or `mixed`; `None`: no number needs one.
    pub dialect: Option<&'static str>,
    /// Cells with a value.
    pub values: usize,
    /// Cells that are empty or say that the value is not known.
    pub missing: usize,
}

/// A column of the file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[expect(missing_docs, reason = "the names are those of the JSON document")]
pub struct HeadingReport {
    /// Its letter.
    pub column: String,
    pub heading: String,
    /// What it was taken for; `None`: it is not read.
    pub name: Option<&'static str>,
    pub unit: Option<String>,
    /// The row of its heading.
    pub header_row: u32,
    /// Up to five different texts of its cells.
    pub samples: Vec<String>,
}
