//! One component as a reader finds it in a file, and the checks and notes about its step, its peak
//! and its name.

use super::{Component, Direction, ReadOptions};
use crate::notes::{Note, NoteKind};
use crate::text::fixed_width::Block;
use crate::text::lines::Line;
use crate::text::units::GAP;
use freestand::motion::Motion;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::Unit;
use std::collections::HashMap;

/// Time steps that a record may have \[s\]. Real ones are 1 ms to some tenths of a second. A step
/// far outside was written in another unit or is damaged; floor motions at steps of nanoseconds
/// would fill the memory.
const STEPS_S: std::ops::RangeInclusive<f64> = 1e-6..=100.0;

/// Refuses a time step outside 1e-6 s to 100 s.
///
/// # Errors
/// Such a step; the problem is of `kind`.
pub(crate) fn check_step(dt_s: f64, kind: ProblemKind) -> Result<(), Problem> {
    if STEPS_S.contains(&dt_s) {
        return Ok(());
    }
    let (message, hint) = if dt_s > 0.0 {
        let hint = if dt_s > 1.0 {
            "is it in ms?"
        } else {
            "is it in another unit?"
        };
        (
            format!("the time step must be from 1e-6 s to 100 s, not {dt_s:?} s"),
            format!("{hint} state it in s"),
        )
    } else {
        (
            format!("the time step must be positive, not {dt_s} s"),
            "write it in s or ms".to_owned(),
        )
    };
    Err(Problem::new(kind, message).hint(hint))
}

/// One component as a reader finds it in an agency's file; unit and step are known.
pub(crate) struct Found {
    pub(crate) name: String,
    pub(crate) station: Option<String>,
    pub(crate) direction: Option<Direction>,
    /// The unit of the values.
    pub(crate) unit: Unit,
    /// The time step \[s\], and the line that states it, counted from 1.
    pub(crate) step: (f64, usize),
    pub(crate) block: Block,
    pub(crate) is_raw: bool,
}

impl Found {
    /// Values without the offset of an instrument, which point where their name says.
    pub(crate) fn new(name: String, unit: Unit, step: (f64, usize), block: Block) -> Self {
        Self {
            direction: Direction::parse(&name),
            name,
            station: None,
            unit,
            step,
            block,
            is_raw: false,
        }
    }

    /// The component in SI.
    ///
    /// # Errors
    /// A user's unit or time step that contradicts the file's, a step outside 1e-6 s to 100 s,
    /// fewer than two values.
    pub(crate) fn component(self, options: &ReadOptions) -> Result<Component, Problem> {
        let (dt_s, line_of_step) = self.step;
        let Block {
            mut values,
            first_line: line,
        } = self.block;
        if let Some(unit) = options.unit()?
            // The last bit may differ where a factor is a product, such as counts times a scale.
            && (unit.to_si(1.0) - self.unit.to_si(1.0)).abs() > 1e-12 * self.unit.to_si(1.0)
            && unit.symbol != self.unit.symbol
        {
            let message = format!(
                "the record is in {} according to the file, not in {}",
                self.unit.symbol, unit.symbol
            );
            return Err(Problem::value(
                message,
                "leave out `unit`, or correct the file if it is wrong",
            )
            .at_line(line));
        }
        let at_step = |problem: Problem| problem.at_line(line_of_step);
        check_step(dt_s, ProblemKind::Format).map_err(at_step)?;
        if let Some(asked_s) = options.dt_s
            // One part in a million is a difference in printing, not in meaning.
            && (asked_s - dt_s).abs() > 1e-6 * dt_s
        {
            let message =
                format!("the time step is {dt_s} s according to the header, not {asked_s} s");
            let hint = "leave out `dt`, or correct the file if it is wrong";
            return Err(at_step(Problem::value(message, hint)));
        }
        for value in &mut values {
            *value = self.unit.to_si(*value);
        }
        Ok(Component {
            name: self.name,
            station: self.station,
            direction: self.direction,
            unit: self.unit.symbol,
            is_raw: self.is_raw,
            start: None,
            station_xml: None,
            motion: motion(dt_s, values, line)?,
            line_of_first_value: line,
        })
    }
}

/// Adds the channel number to names that several components share: a structure has several sensors
/// in one direction.
pub(crate) fn tell_apart(components: &mut [Component]) {
    let mut uses: HashMap<String, usize> = HashMap::new();
    for component in components.iter() {
        *uses.entry(component.name.to_lowercase()).or_default() += 1;
    }
    for (i, component) in components.iter_mut().enumerate() {
        if uses
            .get(&component.name.to_lowercase())
            .is_some_and(|count| *count > 1)
        {
            component.name = format!("{}, channel {}", component.name, i + 1);
        }
    }
}

/// A note if the largest value differs from the one that the header states \[m/s², any sign\].
///
/// Some agencies print the peak with the opposite sign, and most with three digits, which rounds by
/// up to 1 %.
pub(crate) fn peak_note(component: &Component, header_peak_m_s2: f64) -> Option<Note> {
    peak_note_of(
        &component.name,
        component.motion.peak_m_s2(),
        header_peak_m_s2,
    )
}

/// As [`peak_note`], for a largest value that was found in another way.
pub(crate) fn peak_note_of(name: &str, found: f64, header_peak_m_s2: f64) -> Option<Note> {
    /// Far above any earthquake. Larger values mark a missing value, in any unit.
    const HIGHEST_M_S2: f64 = 1e4;
    let stated = header_peak_m_s2.abs();
    // A header without a peak has 0 or a marker of a missing value.
    let is_stated = stated > 0.0 && stated < HIGHEST_M_S2;
    (is_stated && (found - stated).abs() > 0.01 * stated).then(|| {
        let words = format!(
            "the largest value is {found:.5} m/s2, but the header states a peak of {stated:.5} m/s2"
        );
        Note::of(name, NoteKind::PeakDiffers, words).amount(100.0 * (found - stated) / stated, "%")
    })
}

/// A note if the values do not last as long as the header says \[s\]: the step, the length or the
/// number is wrong.
///
/// Lengths are printed with few digits, may or may not count the last step, and may be those of the
/// uncorrected record. 1 % and two steps allow for all this; a wrong step differs by far more.
pub(crate) fn length_note(component: &Component, stated_s: f64) -> Option<Note> {
    let (dt_s, count) = (component.motion.dt_s(), component.motion.accel_m_s2().len());
    let found_s = count as f64 * dt_s;
    let is_stated = stated_s > 0.0 && stated_s.is_finite();
    (is_stated && (found_s - stated_s).abs() > 2.0 * dt_s + 0.01 * stated_s).then(|| {
        let words = format!(
            "{count} values at {dt_s} s last {found_s:.2} s, but the header states {stated_s:.2} s: the step may be \
             wrong"
        );
        Note::of(&component.name, NoteKind::DurationDiffers, words).amount(100.0 * (found_s - stated_s) / stated_s, "%")
    })
}

/// A note if the file has fewer channels than a header says: `(3 Chns of  3 at Sta)`. Agencies also
/// publish one channel per file, with the same words in it.
pub(crate) fn channels_note(header: &[String], found: usize) -> Option<Note> {
    let stated: usize = header.iter().find_map(|line| {
        let upper = line.to_ascii_uppercase();
        let (before, _) = upper.split_once("CHNS OF")?;
        before
            .rsplit(['(', ' '])
            .find(|word| !word.is_empty())?
            .parse()
            .ok()
    })?;
    let words = || {
        format!("the header states {stated} channels, but the file has {found}: it may be cut off")
    };
    (found < stated).then(|| Note::new(NoteKind::CutOff, words()))
}

/// A note if a file whose layout has three components has fewer.
pub(crate) fn three_note(found: usize) -> Option<Note> {
    let words = || format!("the file has only {found} of three components: it may be cut off");
    (found < 3).then(|| Note::new(NoteKind::CutOff, words()))
}

/// Refuses a sample that is not a number, as binary files may have; `of` stands before the message.
pub(crate) fn refuse_not_finite(values: &[f64], of: &str) -> Result<(), Problem> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(at) => Err(Problem::format(
            format!(
                "{of}sample {} is {}, which marks a missing value",
                at + 1,
                values[at]
            ),
            GAP,
        )),
    }
}

/// A note if no line with `mark` (in lower case) ends the last channel.
pub(crate) fn end_note(bytes: &[u8], mark: &str) -> Option<Note> {
    // Text after the last channel has other lines.
    const MAX: usize = 100;
    let lines = bytes
        .rsplit(|b| matches!(b, b'\n' | b'\r'))
        .map(|bytes| Line { number: 0, bytes });
    let mut last = lines
        .filter(|line| !line.is_blank())
        .take(MAX)
        .take_while(Line::is_text);
    let is_there = last.any(|line| line.text().to_ascii_lowercase().contains(mark));
    let words =
        || format!("the last channel does not end with a line \"{mark}\": the file may be cut off");
    (!is_there).then(|| Note::new(NoteKind::CutOff, words()))
}

/// Samples in m/s² as a motion.
pub(crate) fn motion(dt_s: f64, accel_m_s2: Vec<f64>, line: usize) -> Result<Motion, Problem> {
    check_step(dt_s, ProblemKind::Format).map_err(|problem| problem.at_line(line))?;
    Motion::new(dt_s, accel_m_s2).map_err(|error| {
        Problem::format(error.to_string(), "check that the record is complete").at_line(line)
    })
}
