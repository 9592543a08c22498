//! One component as readers find it in a file, and what is checked and said of each: its step, its peak, its name.

use super::{Component, Direction, ReadOptions, units};
use crate::error::{Problem, ProblemKind};
use crate::quantity::{Unit, shorten};
use freestand::motion::Motion;
use std::collections::HashMap;

/// Time steps that a record of the ground or of a floor may have \[s\]. Records have 1 ms to some
/// tenths of a second. Far outside, the step was written in another unit or is damaged, and a building's floors at steps
/// of nanoseconds would fill the memory.
const STEPS_S: std::ops::RangeInclusive<f64> = 1e-6..=100.0;

pub(crate) fn check_step(dt_s: f64, kind: ProblemKind) -> Result<(), Problem> {
    if STEPS_S.contains(&dt_s) {
        return Ok(());
    }
    let (message, hint) = if dt_s > 0.0 {
        let hint = if dt_s > 1.0 { "is it in ms?" } else { "is it in another unit?" };
        (format!("the time step must be from 1e-6 s to 100 s, not {dt_s:?} s"), format!("{hint} state it in s"))
    } else {
        (format!("the time step must be positive, not {dt_s} s"), "write it in s or ms".to_owned())
    };
    Err(Problem::new(kind, message).hint(hint))
}

/// One component as a reader finds it in an agency's file, where unit and step are not open any more.
pub(super) struct Found {
    pub(super) name: String,
    pub(super) station: Option<String>,
    pub(super) direction: Option<Direction>,
    /// The unit of the values.
    pub(super) unit: Unit,
    pub(super) dt_s: f64,
    /// Line that states the step, counted from 1.
    pub(super) line_of_step: usize,
    pub(super) values: Vec<f64>,
    /// Line of the first value, counted from 1.
    pub(super) line: usize,
    pub(super) is_raw: bool,
}

impl Found {
    /// The component in SI.
    ///
    /// # Errors
    /// A user's unit or time step that contradicts the file's, a step outside 1e-6 s to 100 s, fewer than two values.
    pub(super) fn component(mut self, options: &ReadOptions) -> Result<Component, Problem> {
        if let Some(unit) = units::requested(options.unit.as_deref())?
            // The last bit may differ where a factor is composed, as in counts times a scale.
            && (unit.to_si(1.0) - self.unit.to_si(1.0)).abs() > 1e-12 * self.unit.to_si(1.0)
            && unit.symbol != self.unit.symbol
        {
            let message = format!("the record is in {} as the file says, not in {}", self.unit.symbol, unit.symbol);
            return Err(Problem::new(ProblemKind::Value, message)
                .at_line(self.line)
                .hint("leave out the unit (--unit, or unit in the study), or correct the file if it is wrong"));
        }
        let at_step = |problem: Problem| problem.at_line(self.line_of_step);
        check_step(self.dt_s, ProblemKind::Format).map_err(at_step)?;
        if let Some(dt_s) = options.dt_s
            // One part in a million is a difference in printing, not in meaning.
            && (dt_s - self.dt_s).abs() > 1e-6 * self.dt_s
        {
            let message = format!("the time step is {} s as the header says, not {dt_s} s", self.dt_s);
            return Err(at_step(Problem::new(ProblemKind::Value, message))
                .hint("leave out the step (--dt, or dt in the study), or correct the file if it is wrong"));
        }
        for value in &mut self.values {
            *value = self.unit.to_si(*value);
        }
        Ok(Component {
            name: self.name,
            station: self.station,
            direction: self.direction,
            unit: self.unit.symbol,
            is_raw: self.is_raw,
            start_s: None,
            station_xml: None,
            motion: motion(self.dt_s, self.values, self.line)?,
            line_of_first_value: self.line,
        })
    }
}

/// Adds the place in the file to names that several components share: a structure has several sensors of one direction.
pub(super) fn tell_apart(components: &mut [Component]) {
    let mut uses: HashMap<String, usize> = HashMap::new();
    for component in components.iter() {
        *uses.entry(component.name.to_lowercase()).or_default() += 1;
    }
    for (i, component) in components.iter_mut().enumerate() {
        if uses.get(&component.name.to_lowercase()).is_some_and(|count| *count > 1) {
            component.name = format!("{}, channel {}", component.name, i + 1);
        }
    }
}

/// What is to be said where the largest value is not the one that the header states \[m/s², any sign\].
///
/// Some agencies print the peak with the opposite sign, and most with three digits: 1 % is what rounding of three can
/// make of it.
pub(super) fn peak_note(component: &Component, header_peak_m_s2: f64) -> Option<String> {
    peak_note_of(&component.name, component.motion.peak_m_s2(), header_peak_m_s2)
}

/// As [`peak_note`], of a largest value that was found otherwise.
pub(super) fn peak_note_of(name: &str, found: f64, header_peak_m_s2: f64) -> Option<String> {
    /// Far above any earthquake: values that stand for a missing one, in whatever unit.
    const HIGHEST_M_S2: f64 = 1e4;
    let stated = header_peak_m_s2.abs();
    // A header without a peak has 0 or a value that stands for a missing one.
    let is_stated = stated > 0.0 && stated < HIGHEST_M_S2;
    (is_stated && (found - stated).abs() > 0.01 * stated).then(|| {
        let name = shorten(name);
        format!("{name}: the largest value is {found:.5} m/s2, but the header states a peak of {stated:.5} m/s2")
    })
}

/// Samples in m/s² as a motion.
pub(super) fn motion(dt_s: f64, accel_m_s2: Vec<f64>, line: usize) -> Result<Motion, Problem> {
    check_step(dt_s, ProblemKind::Format).map_err(|problem| problem.at_line(line))?;
    Motion::new(dt_s, accel_m_s2).map_err(|error| {
        Problem::new(ProblemKind::Format, error.to_string()).at_line(line).hint("check that the record is complete")
    })
}
