//! What becomes of one object: one sentence, its numbers, and the text for the console.

mod report;
mod sentence;
mod text;

pub use report::{ObjectReport, object_report};
pub use sentence::AnswerKind;
pub use text::object_text;
