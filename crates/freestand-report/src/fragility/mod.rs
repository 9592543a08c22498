//! Fragilities: their curves, what is told of runs, and what there is to know besides.

mod answer;
mod curves;
pub(crate) mod doubts;
mod exports;
mod runs;

pub use answer::FragilityAnswer;
pub use curves::curves_text;
pub use doubts::warnings;
pub use exports::{ExportFiles, export_files};
pub use runs::{RunsAnswer, left_out_table};
