//! Values that mark missing values.

use super::fortran::is_gap_mark;
use super::units::missing;
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;

/// Whether a number cannot be a value in any unit, such as 1.7E38. -999 and similar may be ordinary
/// values in mm/s² or counts.
pub(crate) fn is_no_value(value: f64) -> bool {
    value.abs() >= 1e30 || value.is_nan()
}

/// The first of `values` that marks a missing value: it is not a value in any unit, or it is a
/// marker by `is_marker` and larger than twice every other value. A series that reaches half of 999
/// may well reach 999.
pub(crate) fn gap(values: &[f64], is_marker: impl Fn(f64) -> bool) -> Option<usize> {
    let first = values
        .iter()
        .position(|&value| is_no_value(value) || is_marker(value))?;
    let others = values
        .iter()
        .filter(|value| !is_no_value(**value) && !is_marker(**value));
    let peak = others.fold(0.0f64, |peak, value| peak.max(value.abs()));
    let is_gap = |value: f64| is_no_value(value) || is_marker(value) && value.abs() > 2.0 * peak;
    values
        .iter()
        .skip(first)
        .position(|&value| is_gap(value))
        .map(|at| first + at)
}

/// A note about a value that may mark a missing value but is read as a value.
pub(crate) fn ordinary_note(value: f64, line: usize) -> Note {
    let words = format!(
        "{value} is read as a value because others are as large; it may mark a missing value"
    );
    Note::at(line, NoteKind::GapMark, words)
}

/// The values of a column that may mark missing values, collected line by line and judged at the
/// end.
#[derive(Debug, Default)]
pub(crate) struct Markers {
    /// The first, and its line.
    first: Option<(f64, usize)>,
}

impl Markers {
    /// Adds a value of a line.
    ///
    /// # Errors
    /// A value that cannot be one in any unit.
    pub(crate) fn see(&mut self, value: f64, line: usize) -> Result<(), Problem> {
        if is_no_value(value) {
            return Err(missing(&value.to_string(), line));
        }
        if is_gap_mark(value) {
            self.first.get_or_insert((value, line));
        }
        Ok(())
    }

    /// A note, once all `values` of the column are there.
    ///
    /// # Errors
    /// A value that marks a missing value.
    pub(crate) fn judge(&self, values: &[f64]) -> Result<Option<Note>, Problem> {
        match self.first {
            Some((value, line)) if gap(values, is_gap_mark).is_some() => {
                Err(missing(&value.to_string(), line))
            }
            first => Ok(first.map(|(value, line)| ordinary_note(value, line))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fortran::is_missing_value;
    use super::*;

    #[test]
    fn nothing_but_nines_marks_a_gap() {
        let marks = [
            9999.99, -9999.99, 999.9, 999.99, 99999.0, -99999.9, 9999.0, 999_999.0, -999.0,
            9999.999,
        ];
        for value in marks {
            assert!(is_gap_mark(value), "{value}");
            assert_eq!(gap(&[1.0, value, 2.0], is_gap_mark), Some(1), "{value}");
        }
        for value in [
            999.0, 99.99, 9998.99, 9.999, 9990.0, 1000.0, 999.95, 0.0, 1e-9,
        ] {
            assert!(!is_gap_mark(value), "{value}");
        }
        assert_eq!(gap(&[1.0, 9999.99, 6000.0], is_gap_mark), None);
    }

    #[test]
    fn what_stands_out_is_a_gap_and_what_does_not_is_a_value() {
        for (values, at) in [
            (&[1.0, -999.0, 2.0][..], Some(1)),
            (&[1.0, -999.0, -999.0, 499.0], Some(1)),
            (&[-999.0, -999.0], Some(0)),
            (&[0.5, -32768.0, 999.0], Some(1)),
            // Beyond twice the others is 499.5.
            (&[1.0, -999.0, 499.5], None),
            (&[-990.0, -999.0, -1004.0, 12.0], None),
            (&[-9999.0, 12000.0, -32768.0, 20000.0], None),
            // One of two markers stands out.
            (&[800.0, -999.0, -9999.0], Some(2)),
            (&[-990.0, -999.0, 1.7e38], Some(2)),
            (&[-990.0, f64::NAN], Some(1)),
            (&[], None),
        ] {
            assert_eq!(gap(values, is_missing_value), at, "{values:?}");
        }
    }
}
