//! An assessment as a PDF: a summary, and a page for each object.
//!
//! Everything here stands behind the feature `typeset`: the typesetter (`typst`) takes twenty minutes to build and 50 MB of
//! binary, so the default build of the workspace sees an empty crate.
#![cfg_attr(
    feature = "typeset",
    doc = "
What an inventory says goes into the document as data, a virtual JSON file that the template reads, and never as markup:
a name that looks like a command is printed as it is written. Fonts are embedded in the program; nothing is read from the
system or a network. There is no clock in it: the same assessment gives the same bytes."
)]

#[cfg(feature = "typeset")]
mod block;
#[cfg(feature = "typeset")]
mod details;
#[cfg(feature = "typeset")]
mod document;
#[cfg(test)]
#[cfg(feature = "typeset")]
mod fixture;
#[cfg(feature = "typeset")]
mod object;
#[cfg(feature = "typeset")]
mod summary;
#[cfg(test)]
#[cfg(feature = "typeset")]
mod tests;
#[cfg(feature = "typeset")]
mod text;
#[cfg(feature = "typeset")]
mod typesetter;

#[cfg(feature = "typeset")]
pub use document::{MAX_OBJECTS, PdfError, assessment_pdf};
