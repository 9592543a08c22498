//! What a person wrote, to SI values: quantities with units, located TOML, files with their
//! fingerprints, and everything that is wrong with an input, each problem with its place and its
//! remedy.

pub mod file;
pub mod keys;
pub mod problem;
pub mod quantity;
pub mod toml_reader;
pub mod word_reader;
pub mod words;

pub use problem::{Problem, ProblemKind, Problems};
