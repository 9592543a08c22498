//! How strongly an object must be held: the text for the console, and the sheet to print.

mod list;
mod report;
mod sheet;
mod sketch;
mod text;
mod words;

pub use list::{RestrainListReport, restrain_list_report};
pub use report::{RestrainReport, restrain_report};
pub use sheet::restraint_sheet;
pub use text::{restraint_text, restraints_text};

#[cfg(test)]
mod tests;
