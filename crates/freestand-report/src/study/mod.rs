//! The results of a study: its files, its page, its figures, and what the console shows.

#[cfg(test)]
mod fixture;
pub mod outputs;
mod page;
pub mod tables;
mod text;

pub use text::{levels_text, sensitivity_text};
