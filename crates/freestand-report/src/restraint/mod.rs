//! How strongly an object must be held: the text for the console, and the sheet to print.

pub(crate) mod force;
mod list;
mod report;
mod sheet;
mod sketch;
mod text;
mod words;
mod workbook;

pub use list::{RestrainListReport, restrain_list_report};
pub use report::{RestrainReport, restrain_report};
pub use sheet::{restraint_sheet, restraint_sheets};
pub use text::{restraint_text, restraints_text};
pub use workbook::restraint_workbook;

#[cfg(test)]
mod tests;
