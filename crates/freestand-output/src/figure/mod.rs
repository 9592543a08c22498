//! Figures as SVG and PNG: pages of panels, legends, and a common style. Colours are those of Okabe
//! and Ito (2008); dashes and markers differ as well.

pub mod legend;
pub mod page;
pub mod style;
pub mod time;

use thiserror::Error;

/// A figure in both of its forms.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name for files: `urs`, `srs`, `overturning`, `floor_spectra`, `history`, `record_01`.
    pub name: String,
    /// What it shows, in a line; also written above the drawing.
    pub title: String,
    /// How to read it, in sentences.
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
    /// Its name.
    pub figure: String,
    /// What the plot library said.
    pub reason: String,
}
