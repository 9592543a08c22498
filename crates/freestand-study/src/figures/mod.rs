//! The figures of a study, as SVG and PNG.
//!
//! Curves of the paper's Fig. 7 (uplift and shock against height), the share of motions that overturn, floor spectra,
//! one rocking history, recorded motions, and the response spectrum of a motion. Colours after Okabe and Ito, and never colour alone: dashes and markers differ as well.

mod code_spectrum;
mod compliant;
mod floor_profile;
mod floor_response;
mod floor_spectra;
mod history;
mod laboratory;
mod legend;
mod matched;
mod page;
mod record;
mod response;
mod response_spectrum;
mod shock_spectrum;
mod style;
mod time;
mod vary;

use rayon::prelude::*;
use thiserror::Error;

use freestand::motion::Motion;

pub use shock_spectrum::{BoundaryPicture, ShockCurve};

use crate::inspect::DampedSpectrum;
use crate::result::StudyResult;
use crate::study::{Ground, Study};

pub use code_spectrum::CodePicture;
pub use compliant::Trace;
pub use floor_profile::ProfilePicture;
pub use matched::MatchedPicture;

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
    /// Peak floor accelerations up the height.
    FloorProfile,
    /// One rocking history.
    History,
    /// A ground motion, counted from 0.
    Record(usize),
    /// What the result owes to each assumption.
    Vary,
}

/// Recorded ground motions that a study draws; with more of them, the first.
pub const MOST_RECORDS: usize = 6;

/// Motions that were made for a study and are drawn: they are all of one kind.
pub const MOST_SYNTHETIC: usize = 2;

impl FigureKind {
    /// Its name for files.
    pub fn name(self) -> String {
        match self {
            Self::Urs => "urs".to_owned(),
            Self::Srs => "srs".to_owned(),
            Self::Overturning => "overturning".to_owned(),
            Self::FloorSpectra => "floor_spectra".to_owned(),
            Self::FloorProfile => "floor_profile".to_owned(),
            Self::History => "history".to_owned(),
            Self::Record(index) => format!("record_{:02}", index + 1),
            Self::Vary => "vary".to_owned(),
        }
    }
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

/// The figures that a result has, in the order of the report: `history` only where an object uplifted, and the first
/// [`MOST_RECORDS`] of recorded ground motions.
pub fn figure_kinds(study: &Study, result: &StudyResult) -> Vec<FigureKind> {
    let mut kinds = Vec::new();
    if !result.levels.is_empty() {
        kinds.extend([FigureKind::Urs, FigureKind::Srs, FigureKind::Overturning]);
    }
    if !result.motions.is_empty() {
        kinds.push(FigureKind::FloorSpectra);
    }
    if result.profile.is_some() {
        kinds.push(FigureKind::FloorProfile);
    }
    if result.history.as_ref().is_some_and(|h| h.time_s.len() > 1) {
        kinds.push(FigureKind::History);
    }
    let drawn = if matches!(study.ground, Ground::Recorded(_)) { MOST_RECORDS } else { MOST_SYNTHETIC };
    kinds.extend((0..result.ground.len().min(drawn)).map(FigureKind::Record));
    if result.sensitivity.as_ref().is_some_and(|sensitivity| sensitivity.rows.len() > result.levels.len()) {
        kinds.push(FigureKind::Vary);
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
        FigureKind::FloorProfile => study_profile(study, result)
            .ok_or_else(|| FigureError { figure: kind.name(), reason: "the motions of the floors are given".into() })?,
        FigureKind::Vary => {
            let levels: Vec<String> = study.levels.iter().map(|level| level.name.clone()).collect();
            let sensitivity = result
                .sensitivity
                .as_ref()
                .ok_or_else(|| FigureError { figure: kind.name(), reason: "nothing was varied".into() })?;
            vary::vary(sensitivity, &levels)
        }
        FigureKind::Record(index) => study_record(index, study, result).ok_or_else(|| FigureError {
            figure: kind.name(),
            reason: format!("there is no ground motion {}", index + 1),
        })?,
    };
    page::draw(page)
}

fn points(levels_ratio: &[f64], accel_g: &[f64]) -> Vec<(f64, f64)> {
    levels_ratio.iter().copied().zip(accel_g.iter().copied()).collect()
}

fn study_profile(study: &Study, result: &StudyResult) -> Option<page::Page> {
    let profile = result.profile.as_ref()?;
    let code = profile.code.as_ref().map(|code| (code.clause, points(&profile.levels_ratio, &code.accel_g)));
    let picture = ProfilePicture {
        title: "Peak floor accelerations",
        levels_ratio: &profile.levels_ratio,
        height_m: study.building.as_ref().map(|building| building.height_m),
        pfa_g: &profile.pfa_g,
        pga_g: &[],
        code: code.as_ref().map(|(clause, line)| (*clause, &line[..])),
    };
    Some(floor_profile::floor_profile(&FigureKind::FloorProfile.name(), &picture))
}

/// A ground motion as it is used; of two components the first.
fn study_record(index: usize, study: &Study, result: &StudyResult) -> Option<page::Page> {
    let ground = result.ground.get(index)?;
    let name = FigureKind::Record(index).name();
    let page = match &study.ground {
        Ground::Recorded(records) => {
            let record = records.get(index)?;
            let shown = if record.across.is_some() { "; the first of the two is drawn" } else { "" };
            let description = format!("{}{shown}", record.description);
            let words = Words { name: &record.name, description: &description, processing: &record.processing };
            record::record(name, words, &ground.motion.along)
        }
        Ground::Synthetic(synthetic) => {
            let description = format!("made for {}, seed {}", synthetic.target.one_line(), synthetic.seed);
            let words = Words { name: &ground.name, description: &description, processing: &[] };
            record::record(name, words, &ground.motion.along)
        }
        Ground::OnFloors => return None,
    };
    Some(page)
}

/// What is said about a motion in its figure.
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// Its name.
    pub name: &'a str,
    /// Format, component, station; may be empty.
    pub description: &'a str,
    /// What was done to the samples, one step each.
    pub processing: &'a [String],
}

/// Draws a motion: acceleration, velocity and displacement with their peaks, and its Husid curve.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn record_figure(words: Words<'_>, motion: &Motion) -> Result<Figure, FigureError> {
    page::draw(record::record("record".to_owned(), words, motion))
}

/// Draws response spectra of one motion at one or several dampings: PSA, PSV and SD against period.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn response_spectrum_figure(
    words: Words<'_>,
    periods_s: &[f64],
    spectra: &[&DampedSpectrum],
) -> Result<Figure, FigureError> {
    page::draw(response_spectrum::response_spectrum(words, periods_s, spectra))
}

/// Draws the spectra of motions against their target.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn matched_figure(picture: &MatchedPicture<'_>) -> Result<Figure, FigureError> {
    page::draw(matched::matched(picture))
}

/// Draws the spectrum of a code, and what it gives parts up the height of a building.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn code_spectrum_figure(picture: &CodePicture<'_>) -> Result<Figure, FigureError> {
    page::draw(code_spectrum::code_spectrum(picture))
}

/// Draws the loops of drop tests: force and acceleration against compression.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn drop_figures(report: &crate::drop_test::DropsReport) -> Result<Vec<Figure>, FigureError> {
    laboratory::drops(report).into_iter().map(page::draw).collect()
}

/// Draws the curves of static tests.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn static_figure(report: &crate::static_test::StaticsReport) -> Result<Figure, FigureError> {
    page::draw(laboratory::statics(report))
}

/// Draws a landing on cushions: edge accelerations, forces and rotation against time.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn trace_figure(trace: &Trace<'_>) -> Result<Figure, FigureError> {
    page::draw(compliant::trace(trace))
}

/// Draws peak floor accelerations up the height of a building.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn floor_profile_figure(picture: &ProfilePicture<'_>) -> Result<Figure, FigureError> {
    page::draw(floor_profile::floor_profile("profile", picture))
}

/// Draws response spectra of floors, the median over so many `motions`.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn floor_response_figure(
    report: &crate::floor::SpectraReport,
    height_m: f64,
    motions: usize,
) -> Result<Figure, FigureError> {
    page::draw(floor_response::floor_response(report, height_m, motions))
}

/// Draws shock response spectra over frequency; `label` is that of the values, with their unit.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn shock_spectrum_figure(title: &str, label: &str, curves: &[ShockCurve]) -> Result<Figure, FigureError> {
    page::draw(shock_spectrum::shock_spectrum(title, label, curves))
}

/// Draws a damage boundary and a demand.
///
/// # Errors
/// What the plot library says when it cannot draw.
pub fn damage_boundary_figure(picture: &BoundaryPicture) -> Result<Figure, FigureError> {
    page::draw(shock_spectrum::damage_boundary(picture))
}

/// Draws every figure of [`figure_kinds`], on the threads of the current pool; the figures do not depend on them.
///
/// # Errors
/// The first figure that cannot be drawn.
pub fn figures(study: &Study, result: &StudyResult) -> Result<Vec<Figure>, FigureError> {
    figure_kinds(study, result).into_par_iter().map(|kind| figure(kind, study, result)).collect()
}
