//! How strongly an object must be held: the text for the console, and the sheet to print.

mod sheet;
mod sketch;
mod text;

pub use sheet::restraint_sheet;
pub use text::{restraint_text, restraints_text};
