//! Trims two components to the times that both have.

use freestand::motion::Motion;

use super::raw::take_mean;
use super::refused;
use crate::formats::Component;
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;
use freestand_input::words::number;

/// Clocks of two channels may differ by this fraction of a sample without a note: they agree to
/// some microseconds, and times in columns to their last digit.
const SAME_TIME: f64 = 0.05;

const ONE_RECORD: &str = "give two components of one record";

/// One of two components with the same start and number of samples; the mean of a raw one is
/// removed.
#[derive(Debug)]
pub(super) struct Aligned {
    /// The motion.
    pub(super) motion: Motion,
    /// What was done to it without a request; notes about both are with the first.
    pub(super) notes: Vec<Note>,
}

/// Trims two components to the times that both have; `names` are their names in words.
///
/// # Errors
/// Components that do not overlap in time. Different time steps are left for the next step to
/// refuse.
pub(super) fn aligned(
    (first, second): (&Component, &Component),
    names: (&str, &str),
    keep_mean: bool,
) -> Result<[Aligned; 2], Problem> {
    let mut both = Vec::new();
    let later = later_by((first, second), names, &mut both)?;
    let skipped = |by: i64| usize::try_from(by).unwrap_or(0);
    let (skip_1, skip_2) = (skipped(later), skipped(-later));
    let left = |component: &Component, skip: usize| {
        component.motion.accel_m_s2().len().saturating_sub(skip)
    };
    let (left_1, left_2) = (left(first, skip_1), left(second, skip_2));
    let length = left_1.min(left_2);
    let mut one = cut(first, names.0, skip_1..skip_1 + length, keep_mean)?;
    let mut two = cut(second, names.1, skip_2..skip_2 + length, keep_mean)?;
    if let Some(note) = one_step(&one.motion, &two.motion, names) {
        two.motion = Motion::new(one.motion.dt_s(), two.motion.accel_m_s2().to_vec())
            .map_err(|error| refused("the time step", error, ONE_RECORD))?;
        two.notes.insert(0, note);
    }
    if one.motion.accel_m_s2() == two.motion.accel_m_s2() && one.motion.peak_m_s2() > 0.0 {
        let words = format!("components {} and {} are identical", names.0, names.1);
        both.push(Note::new(NoteKind::Identical, words));
    }
    one.notes.splice(..0, both);
    Ok([one, two])
}

/// Samples by which the second component begins later than the first, from their start times;
/// negative if earlier.
fn later_by(
    (first, second): (&Component, &Component),
    names: (&str, &str),
    both: &mut Vec<Note>,
) -> Result<i64, Problem> {
    let (Some(start_1), Some(start_2)) = (first.start, second.start) else {
        return Ok(0);
    };
    let (start_1_s, start_2_s) = (start_1.seconds(), start_2.seconds());
    let later = (start_2_s - start_1_s) / first.motion.dt_s();
    let whole = later.round();
    let longest = first
        .motion
        .accel_m_s2()
        .len()
        .max(second.motion.accel_m_s2().len());
    if whole.abs() >= longest as f64 {
        let after_s = number(start_2_s - start_1_s, 6);
        let message = format!(
            "component {} begins {after_s} s after {}: they have no time in common",
            names.1, names.0
        );
        return Err(Problem::value(message, ONE_RECORD));
    }
    if (later - whole).abs() > SAME_TIME {
        let part = number((later - whole).abs(), 2);
        let words = format!(
            "components {} and {} are {part} of a sample apart",
            names.0, names.1
        );
        both.push(Note::new(NoteKind::Apart, words));
    }
    Ok(whole as i64)
}

/// A note if two steps differ by so little that the last samples still coincide: recordings of one
/// clock whose times were rounded. `None` if the steps are equal or differ by more.
fn one_step(one: &Motion, two: &Motion, names: (&str, &str)) -> Option<Note> {
    let (dt_s, other_s) = (one.dt_s(), two.dt_s());
    let intervals = one.accel_m_s2().len().saturating_sub(1) as f64;
    let drift = (dt_s - other_s).abs() * intervals / dt_s.min(other_s);
    let is_one = dt_s != other_s && drift < SAME_TIME;
    is_one.then(|| {
        let words = format!(
            "time step of {} taken as {dt_s} s, that of {}, in place of {other_s} s: they differ by {} of a sample at \
             the end",
            names.1,
            names.0,
            number(drift, 2)
        );
        Note::new(NoteKind::StepsDiffer, words)
    })
}

/// The samples of a component that are kept, without the mean for a raw one, and what was done.
fn cut(
    component: &Component,
    name: &str,
    kept: std::ops::Range<usize>,
    keep_mean: bool,
) -> Result<Aligned, Problem> {
    let mut notes = Vec::new();
    let mut motion = component.motion.clone();
    let samples = motion.accel_m_s2();
    let (skip, surplus) = (kept.start, samples.len().saturating_sub(kept.end));
    if skip > 0 || surplus > 0 {
        let within = samples.get(kept).unwrap_or_default().to_vec();
        motion = Motion::new(motion.dt_s(), within)
            .map_err(|error| refused("the time in common", error, ONE_RECORD))?;
        for (count, end, why) in [
            (skip, "first", "begins later"),
            (surplus, "last", "ends earlier"),
        ] {
            let samples = match count {
                0 => continue,
                1 => format!("{end} sample"),
                _ => format!("{end} {count} samples"),
            };
            let words = format!("{samples} of {name} left out: the other component {why}");
            notes.push(Note::new(NoteKind::Trimmed, words));
        }
    }
    if component.is_raw && !keep_mean {
        let (centred, note) = take_mean(&motion, &format!(" from {name}"))?;
        notes.push(note);
        motion = centred;
    }
    Ok(Aligned { motion, notes })
}

#[cfg(test)]
mod tests;
