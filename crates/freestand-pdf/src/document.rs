//! From an assessment to the bytes of its PDF.

use freestand_study::assess::overview::Overview;
use freestand_study::assess::words::{colours, label, sign};
use freestand_study::assess::{Decision, Head, Row};
use serde_json::Value;
use thiserror::Error;

use crate::block::{Block, Document, Sign};
use crate::object::page;
use crate::summary::summary;
use crate::text::{UNKNOWN, printable};
use crate::typesetter::Typesetter;

/// Objects that get a page: as many take 2.5 GB of memory and a minute. The tables of the assessment hold all of them.
pub const MAX_OBJECTS: usize = 1000;

/// Why there is no PDF.
#[derive(Debug, Error)]
pub enum PdfError {
    /// The data of the document could not be written down.
    #[error("the data of the document: {0}")]
    Data(#[from] serde_json::Error),
    /// The typesetter refused the document: a defect of the template.
    #[error("the typesetter: {0}")]
    Typeset(String),
}

/// The assessment as a PDF: the summary, then a page for each row of `pages`, in their order, up to [`MAX_OBJECTS`] of them.
///
/// Give the most urgent ones first; the summary says how many of how many have a page. The bytes depend on the arguments alone.
/// The embedded fonts have Latin, Greek and Cyrillic letters: other characters are printed as □ and the summary says so.
///
/// # Errors
/// A document that the typesetter refuses: a defect of the template.
pub fn assessment_pdf(head: &Head, overview: &Overview, pages: &[Row<'_>]) -> Result<Vec<u8>, PdfError> {
    let pages = pages.get(..MAX_OBJECTS).unwrap_or(pages);
    let typesetter = Typesetter::new();
    let data = data(&typesetter, head, overview, pages)?;
    typesetter.pdf(data).map_err(PdfError::Typeset)
}

/// The data of the document as the template reads them.
///
/// # Errors
/// None that is known: a text or a number that JSON does not hold.
pub(crate) fn data(
    typesetter: &Typesetter,
    head: &Head,
    overview: &Overview,
    pages: &[Row<'_>],
) -> Result<Vec<u8>, PdfError> {
    let mut document = Document {
        title: "Which objects must be restrained".to_owned(),
        footer: format!("freestand {}", env!("CARGO_PKG_VERSION")),
        signs: Decision::ALL.into_iter().map(|decision| (decision.name(), shown(decision))).collect(),
        summary: summary(head, overview, pages),
        objects: pages.iter().map(page).collect(),
    };
    let mut data = serde_json::to_value(&document)?;
    let missing = make_printable(&mut data, typesetter);
    if missing > 0 {
        document.summary.insert(0, missing_characters(missing));
        data = serde_json::to_value(&document)?;
        make_printable(&mut data, typesetter);
    }
    Ok(serde_json::to_vec(&data)?)
}

fn shown(decision: Decision) -> Sign {
    let colours = colours(decision);
    let hex = |rgb: u32| format!("#{rgb:06x}");
    Sign { symbol: sign(decision), label: label(decision), ink: hex(colours.ink), fill: hex(colours.fill) }
}

fn missing_characters(texts: usize) -> Block {
    Block::List {
        title: "Characters that cannot be shown",
        items: vec![format!(
            "{texts} text(s) have characters that the embedded fonts lack (they hold Latin, Greek and Cyrillic letters); each stands here \
             as {UNKNOWN}. The tables and the HTML report have them as they were written."
        )],
        is_warning: true,
    }
}

/// Every text of the document, at this one place; how many of them had characters that no font has.
fn make_printable(value: &mut Value, typesetter: &Typesetter) -> usize {
    match value {
        Value::String(text) => {
            let (clean, missing) = printable(text, |c| typesetter.has(c));
            *text = clean;
            usize::from(missing)
        }
        Value::Array(values) => values.iter_mut().map(|value| make_printable(value, typesetter)).sum(),
        Value::Object(fields) => fields.values_mut().map(|value| make_printable(value, typesetter)).sum(),
        Value::Null | Value::Bool(_) | Value::Number(_) => 0,
    }
}
