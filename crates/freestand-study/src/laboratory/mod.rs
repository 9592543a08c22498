//! The laboratory: cushions from drop tests, static tests and stress–energy curves, and virtual tests of the methods.

pub mod cushion_curve;
pub mod drop_test;
mod figure;
pub mod static_test;
pub mod virtual_test;

pub use figure::{drop_figures, static_figure};
