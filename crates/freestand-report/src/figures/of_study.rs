//! The figures of a study.

use rayon::prelude::*;

use super::kind::{FigureKind, MAX_RECORDS, MAX_SYNTHETIC};
use super::profile::{ProfilePicture, floor_profile};
use super::record::{Words, record};
use super::{floor_spectra, history, response, vary};
use crate::ground::simulated_earthquakes;
use freestand_output::figure::page::{Page, draw};
use freestand_output::figure::{Figure, FigureError};
use freestand_study::result::StudyResult;
use freestand_study::study::{Ground, Study};

/// The figures that a result has, in the order of the report: `history` only where an object
/// uplifted, and the first [`MAX_RECORDS`] of recorded ground motions.
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
    let drawn = if matches!(study.ground, Ground::Recorded(_)) {
        MAX_RECORDS
    } else {
        MAX_SYNTHETIC
    };
    kinds.extend((0..result.ground.len().min(drawn)).map(FigureKind::Record));
    if result
        .sensitivity
        .as_ref()
        .is_some_and(|sensitivity| sensitivity.rows.len() > result.levels.len())
    {
        kinds.push(FigureKind::Vary);
    }
    kinds
}

/// Draws one figure.
///
/// # Errors
/// The error of the plot library.
pub fn figure(
    kind: FigureKind,
    study: &Study,
    result: &StudyResult,
) -> Result<Figure, FigureError> {
    let missing = |reason: &str| FigureError {
        figure: kind.name(),
        reason: reason.into(),
    };
    let page = match kind {
        FigureKind::Urs => response::urs(study, result),
        FigureKind::Srs => response::srs(study, result),
        FigureKind::Overturning => response::overturning(study, result),
        FigureKind::FloorSpectra => floor_spectra::floor_spectra(study, result),
        FigureKind::History => history::history(result)
            .ok_or_else(|| missing("no object uplifted, so there is no history"))?,
        FigureKind::FloorProfile => study_profile(study, result).ok_or_else(|| {
            missing(
                "the study gives the motions of the floors, so there is no profile over the height",
            )
        })?,
        FigureKind::Vary => {
            let levels: Vec<String> = study
                .levels
                .iter()
                .map(|level| level.name.clone())
                .collect();
            let sensitivity = result
                .sensitivity
                .as_ref()
                .ok_or_else(|| missing("nothing was varied"))?;
            vary::vary(sensitivity, &levels)
        }
        FigureKind::Record(index) => study_record(index, study, result)
            .ok_or_else(|| missing(&format!("there is no ground motion {}", index + 1)))?,
    };
    draw(page)
}

fn study_profile(study: &Study, result: &StudyResult) -> Option<Page> {
    let profile = result.profile.as_ref()?;
    let picture = ProfilePicture {
        levels_ratio: &profile.levels_ratio,
        height_m: study.building.as_ref().map(|building| building.height_m),
        pfa_g: &profile.pfa_g,
        pga_g: &[],
        code: profile.code.as_ref(),
    };
    Some(floor_profile(&FigureKind::FloorProfile.name(), &picture))
}

/// A ground motion as used; of two components the first.
fn study_record(index: usize, study: &Study, result: &StudyResult) -> Option<Page> {
    let ground = result.ground.get(index)?;
    let name = FigureKind::Record(index).name();
    let (name_of_motion, description, processing) = match &study.ground {
        Ground::Recorded(records) => {
            let used = records.get(index)?;
            let shown = if used.across.is_some() {
                "; the first of the two is drawn"
            } else {
                ""
            };
            let description = format!("{}{shown}", used.description);
            (&used.name, description, used.processing.as_slice())
        }
        Ground::Synthetic(synthetic) => {
            let (target, seed) = (synthetic.target.one_line(), synthetic.seed);
            let description = format!("generated for {target}, seed {seed}");
            (&ground.name, description, &[][..])
        }
        Ground::Simulated(simulated) => {
            let (title, seed) = (simulated_earthquakes(simulated), simulated.request.seed);
            (&ground.name, format!("of {title}, seed {seed}"), &[][..])
        }
        Ground::OnFloors => return None,
    };
    let words = Words {
        name: name_of_motion,
        description: &description,
        processing,
    };
    Some(record(name, words, &ground.motion.along))
}

/// Draws every figure of [`figure_kinds`] on the current thread pool; the figures do not depend on
/// the number of threads.
///
/// # Errors
/// The first figure that cannot be drawn.
pub fn figures(study: &Study, result: &StudyResult) -> Result<Vec<Figure>, FigureError> {
    figure_kinds(study, result)
        .into_par_iter()
        .map(|kind| figure(kind, study, result))
        .collect()
}
