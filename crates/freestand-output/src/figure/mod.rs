//! Figures as SVG and PNG: pages of panels, legends, and a common style. Colours are those of Okabe
//! and Ito (2008); dashes and markers differ as well.

pub mod legend;
pub mod mark;
pub mod page;
mod raster;
pub mod style;
pub mod time;

use freestand_input::problem::{Problem, ProblemKind};
use thiserror::Error;

/// A figure as SVG and PNG.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name, also of its files: `urs`, `srs`, `overturning`, `floor_spectra`, `history`,
    /// `record_01`.
    pub name: String,
    /// Title: what the figure shows, in one line; also written above the drawing.
    pub title: String,
    /// Caption: how to read the figure, in sentences.
    pub caption: String,
    /// The drawing as an SVG document; its ids begin with the figure's name.
    pub svg: String,
    /// The drawing as a PNG file.
    pub png: Vec<u8>,
}

/// A figure could not be drawn.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the figure {figure} could not be drawn: {reason}")]
pub struct FigureError {
    /// Name of the figure.
    pub figure: String,
    /// The error of the plot library.
    pub reason: String,
}

impl From<FigureError> for Problem {
    fn from(error: FigureError) -> Self {
        Self::new(ProblemKind::Computation, error.to_string())
    }
}
