//! The results of a study: its files, its page, its figures, and what the console shows.

pub mod check;
#[cfg(test)]
mod fixture;
pub mod outputs;
mod page;
mod sensitivity;
pub mod summary;
pub mod tables;
mod text;

pub use text::{levels_text, sensitivity_text};
