//! Outputs that appear complete or not at all: staged folders, streamed files, facts, tables, JSON,
//! HTML and figures. Nothing in this crate is about earthquakes.

pub mod answer;
pub mod facts;
pub mod figure;
pub mod folder;
pub mod html;
pub mod json;
pub mod parquet;
pub mod paths;
pub mod rows;
pub mod streamed;
pub mod table;
mod units;
