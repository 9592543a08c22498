//! The laboratory: cushions from drop tests, static tests and stress–energy curves, and virtual
//! tests of these methods.

pub mod cushion_curve;
pub mod drop_test;
mod figure;
pub mod static_test;
pub mod virtual_test;

use std::path::Path;

pub use figure::{drop_figures, static_figure};
use freestand_input::problem::Problem;
use freestand_output::facts::Facts;

/// A file that gave nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Failed {
    path: String,
    /// Why.
    pub problem: Problem,
}

impl Failed {
    fn new(path: &Path, problem: Problem) -> Self {
        Self { path: path.to_string_lossy().into_owned(), problem }
    }

    /// Its part of a document.
    pub fn facts(&self) -> Facts<'_> {
        Facts::default().key("path", self.path.as_str()).key("reason", self.problem.message.as_str())
    }
}

/// Whether a file or a user calls the impactor a sphere.
fn is_sphere(impactor: Option<&str>) -> bool {
    impactor.is_some_and(|text| text.to_lowercase().starts_with("sphere"))
}
