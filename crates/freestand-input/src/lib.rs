//! Converts what a person wrote to SI values: quantities with units, TOML with line numbers, input
//! files with their fingerprints. All problems of an input are collected, each with its place and a
//! remedy.

pub mod file;
pub mod file_names;
pub mod formula;
pub mod keys;
pub mod problem;
pub mod quantity;
pub mod toml_reader;
pub mod word_reader;
pub mod words;
pub mod written;

pub use problem::{Problem, ProblemKind, Problems};
