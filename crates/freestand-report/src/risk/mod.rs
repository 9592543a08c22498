//! What failures cost: the text for the console, and the page for the owner.

mod page;
mod text;

pub use page::owners_page;
pub use text::risk_text;
