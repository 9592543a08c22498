//! Raw records, which include the offset of their instrument.

use freestand::motion::Motion;
use freestand::signal::baseline::{Baseline, corrected};

use super::{Processing, refused};
use crate::formats::Component;
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;

/// The samples; those of a raw record without their mean.
pub(super) fn without_mean(
    component: &Component,
    processing: &Processing,
    notes: &mut Vec<Note>,
) -> Result<Motion, Problem> {
    if !component.is_raw || processing.keep_mean {
        return Ok(component.motion.clone());
    }
    let (motion, note) = take_mean(&component.motion, "")?;
    notes.push(note);
    Ok(motion)
}

/// The motion without its mean, and the note about it; `from` says what else it belongs to.
pub(super) fn take_mean(motion: &Motion, from: &str) -> Result<(Motion, Note), Problem> {
    let centred = corrected(motion, Baseline::Mean)
        .map_err(|error| refused("the mean", error, "check the values"))?;
    let mean_m_s2 = motion.mean_m_s2();
    let words = format!("mean of {mean_m_s2:.6} m/s2 removed{from} (raw record)");
    Ok((
        centred,
        Note::new(NoteKind::MeanRemoved, words).amount(mean_m_s2, "m/s2"),
    ))
}
