//! The figures of a study, as SVG and PNG.
//!
//! Curves of the paper's Fig. 7 (uplift and shock against height), the share of motions that overturn, floor spectra,
//! and one rocking history. Colours after Okabe and Ito, and never colour alone: dashes and markers differ as well.

mod floor_spectra;
mod history;
mod legend;
mod page;
mod response;
mod style;

use rayon::prelude::*;
use thiserror::Error;

use crate::result::StudyResult;
use crate::study::Study;

/// A figure in both of its forms.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name for files: `urs`, `srs`, `overturning`, `floor_spectra`, `history`.
    pub name: &'static str,
    /// What it shows, in a line; also written above the drawing.
    pub title: String,
    /// How to read it, in sentences.
    pub caption: String,
    /// The drawing as an SVG document; its ids begin with the figure's name.
    pub svg: String,
    /// The drawing as a PNG file.
    pub png: Vec<u8>,
}

/// Which figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureKind {
    /// Uplift response spectra: uplift against height.
    Urs,
    /// Shock spectra: edge shock against height.
    Srs,
    /// Share of the motions that overturn against height.
    Overturning,
    /// Acceleration spectra of the ground and the floors.
    FloorSpectra,
    /// One rocking history.
    History,
}

impl FigureKind {
    /// Its name for files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Urs => "urs",
            Self::Srs => "srs",
            Self::Overturning => "overturning",
            Self::FloorSpectra => "floor_spectra",
            Self::History => "history",
        }
    }
}

/// A figure could not be drawn.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the figure {figure} could not be drawn: {reason}")]
pub struct FigureError {
    /// Its name.
    pub figure: &'static str,
    /// What the plot library said.
    pub reason: String,
}

/// The figures that a result has, in the order of the report: `history` only where an object uplifted.
pub fn figure_kinds(result: &StudyResult) -> Vec<FigureKind> {
    let mut kinds = Vec::new();
    if !result.levels.is_empty() {
        kinds.extend([FigureKind::Urs, FigureKind::Srs, FigureKind::Overturning]);
    }
    if !result.ground.is_empty() {
        kinds.push(FigureKind::FloorSpectra);
    }
    if result.history.as_ref().is_some_and(|h| h.time_s.len() > 1) {
        kinds.push(FigureKind::History);
    }
    kinds
}

/// Draws one figure.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn figure(kind: FigureKind, study: &Study, result: &StudyResult) -> Result<Figure, FigureError> {
    let page = match kind {
        FigureKind::Urs => response::urs(study, result),
        FigureKind::Srs => response::srs(study, result),
        FigureKind::Overturning => response::overturning(study, result),
        FigureKind::FloorSpectra => floor_spectra::floor_spectra(study, result),
        FigureKind::History => history::history(result).ok_or_else(|| FigureError {
            figure: kind.name(),
            reason: "no object uplifted, so there is no history".into(),
        })?,
    };
    page::draw(page)
}

/// Draws every figure of [`figure_kinds`], on the threads of the current pool; the figures do not depend on them.
///
/// # Errors
/// The first figure that cannot be drawn.
pub fn figures(study: &Study, result: &StudyResult) -> Result<Vec<Figure>, FigureError> {
    figure_kinds(result).into_par_iter().map(|kind| figure(kind, study, result)).collect()
}
