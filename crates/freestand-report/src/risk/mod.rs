//! What failures cost: the JSON document, the text for the console, and the page for the owner.

mod answer;
mod doubts;
mod page;
mod text;
mod words;

pub use answer::RiskAnswer;
pub use doubts::warnings;
pub use page::owners_page;
pub use text::risk_text;
