//! Pairs of time and value, several on a line, from digitised film: the times need not be equally
//! spaced.

use super::even_grid::{Uneven, common_step, on_even_grid};
use super::fortran::{Number, bad_field, fields, is_missing_value, number};
use super::gaps::Markers;
use super::lines::{Line, Lines};
use super::sampling::time_step;
use super::units::missing;
use crate::notes::{Note, NoteKind};
use freestand_input::problem::Problem;

/// The most samples that interpolation may make without a step from the user: hours at 1 ms, or 10
/// s between two points. A damaged time must not fill the memory.
const MAX_SAMPLES_UNASKED: f64 = 1e7;
const MAX_SAMPLES_PER_POINT: f64 = 1e4;

/// A series of pairs.
#[derive(Default)]
pub(crate) struct Pairs {
    pub(crate) times_s: Vec<f64>,
    pub(crate) values: Vec<f64>,
    /// The finest printed digit of the times counts 10^this.
    last_digit_exponent: i32,
    /// Line of the first pair, counted from 1.
    pub(crate) first_line: usize,
    pairs_per_line: usize,
    /// Notes about the values.
    pub(crate) notes: Vec<Note>,
}

/// Reads pairs up to the next line of text, which is left unread.
///
/// # Errors
/// A field that is not a number, a value that marks a missing value, half a pair.
pub(crate) fn read(rest: &mut Lines<'_>) -> Result<Pairs, Problem> {
    let mut found = Pairs {
        pairs_per_line: 1,
        ..Pairs::default()
    };
    let mut markers = Markers::default();
    for line in rest
        .leading(|line| !line.is_text())
        .filter(|line| !line.is_blank())
    {
        let numbers = numbers_of(&line)?;
        if found.first_line == 0 {
            found.first_line = line.number;
            found.pairs_per_line = (numbers.len() / 2).max(1);
        }
        for pair in numbers.chunks(2) {
            let [time, value] = pair else {
                return Err(Problem::format(
                    "a time without a value ends the line",
                    "the file may be damaged: fetch it again",
                )
                .at_line(line.number));
            };
            if is_missing_value(time.value) {
                return Err(missing(&time.value.to_string(), line.number));
            }
            markers.see(value.value, line.number)?;
            found.last_digit_exponent = found.last_digit_exponent.min(time.last_digit_exponent);
            found.times_s.push(time.value);
            found.values.push(value.value);
        }
    }
    found.notes.extend(markers.judge(&found.values)?);
    Ok(found)
}

/// The numbers of a line in which fields may touch.
fn numbers_of(line: &Line<'_>) -> Result<Vec<Number>, Problem> {
    let mut numbers = Vec::new();
    match fields(line.bytes, |number| numbers.push(number)) {
        Ok(()) => Ok(numbers),
        Err(bad) => by_points(line.bytes).ok_or_else(|| bad_field(&bad, line.number)),
    }
}

/// All fields of a Fortran format have the same number of decimals, so each ends as far after its
/// point as the last one does: `10.020 -.123100.005` in 7 columns each.
fn by_points(line: &[u8]) -> Option<Vec<Number>> {
    let line = line.trim_ascii_end();
    let points: Vec<usize> = line
        .iter()
        .enumerate()
        .filter(|(_, b)| **b == b'.')
        .map(|(at, _)| at)
        .collect();
    let decimals = line.len() - 1 - points.last()?;
    let mut from = 0;
    points
        .iter()
        .map(|point| {
            let end = point + 1 + decimals;
            let field = line.get(from..end)?;
            from = end;
            number(field.trim_ascii())
        })
        .collect()
}

/// The samples of a record at even steps.
pub(crate) struct Even {
    pub(crate) dt_s: f64,
    pub(crate) values: Vec<f64>,
    /// How they were interpolated.
    pub(crate) note: Option<Note>,
}

impl Pairs {
    /// The values at equal steps \[s\]: unchanged where the times are equally spaced, else
    /// interpolated on straight lines between the points. The step is then `asked_s`, or the
    /// longest that keeps every point. `room` is the largest number of samples.
    ///
    /// # Errors
    /// Times that do not increase, too many samples.
    pub(crate) fn evenly(
        self,
        name: &str,
        asked_s: Option<f64>,
        room: usize,
    ) -> Result<Even, Problem> {
        let uneven = match time_step(&self.times_s, self.last_digit_exponent) {
            Ok(dt_s) => {
                return Ok(Even {
                    dt_s,
                    values: self.values,
                    note: None,
                });
            }
            Err(uneven) => uneven,
        };
        if self.times_s.len() < 2 {
            return Err(self.problem(uneven));
        }
        let step = asked_s.or_else(|| common_step(&self.times_s, self.last_digit_exponent));
        let span_s = self.times_s[self.times_s.len() - 1] - self.times_s[0];
        let most = MAX_SAMPLES_UNASKED.min(MAX_SAMPLES_PER_POINT * self.times_s.len() as f64);
        let Some(dt_s) = step.filter(|dt_s| asked_s.is_some() || span_s / dt_s <= most) else {
            let message = format!(
                "the record is unevenly sampled, and its {span_s} s are too long to interpolate without a step"
            );
            return Err(Problem::format(
                message,
                "give a step for interpolation, such as `resample = \"0.005 s\"`",
            )
            .at_line(self.first_line));
        };
        let values = on_even_grid(&self.times_s, &self.values, dt_s, room)
            .map_err(|uneven| self.problem(uneven))?;
        let points = self.times_s.len();
        let words = format!(
            "{points} points at uneven times were interpolated on straight lines to steps of {dt_s} s"
        );
        Ok(Even {
            dt_s,
            values,
            note: Some(Note::of(name, NoteKind::Interpolated, words)),
        })
    }

    fn problem(&self, uneven: Uneven) -> Problem {
        Problem::format(uneven.message, uneven.hint)
            .at_line(self.first_line + uneven.row / self.pairs_per_line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::lines::lines;

    #[test]
    fn fields_touch_where_a_time_needs_all_its_columns() {
        let text = "  99.990   .123100.005  -.124100.020-10.125\n/& end";
        let found = read(&mut lines(text.as_bytes())).unwrap();
        // Exact: each is the nearest number to its decimals.
        assert_eq!(found.times_s, [99.99, 100.005, 100.02]);
        assert_eq!(found.values, [0.123, -0.124, -10.125]);
        let told = |text: &str| {
            read(&mut lines(text.as_bytes()))
                .map(|pairs| pairs.values)
                .unwrap_err()
                .to_string()
        };
        assert!(told("  1.000   .123\n  2.000\n").contains("line 2: a time without a value"));
        assert!(told("  1.000-999.00\n").contains("line 1: \"-999\" marks a missing"));
    }

    #[test]
    fn uneven_points_are_straight_lines() {
        let pairs = |text: &str| read(&mut lines(text.as_bytes())).unwrap();
        let Even { dt_s, values, note } = pairs("0.000 1.0 0.020 3.0 0.050 0.0\n")
            .evenly("up", None, 1000)
            .unwrap();
        // The common step of 20 ms and 50 ms is 10 ms. Rounding of one product and one sum.
        assert_eq!((dt_s, values.len()), (0.01, 6));
        for (found, expected) in values.iter().zip([1.0, 2.0, 3.0, 2.0, 1.0, 0.0]) {
            assert!((found - expected).abs() < 1e-14);
        }
        assert!(note.unwrap().to_string().contains("3 points"));
        let Even { dt_s, values, note } = pairs("0.010 1.0 0.020 3.0 0.030 0.0\n")
            .evenly("up", None, 1000)
            .unwrap();
        assert_eq!((dt_s, values, note), (0.01, vec![1.0, 3.0, 0.0], None));
        let Even { dt_s, values, .. } = pairs("0.000 1.0 0.020 3.0 0.050 0.0\n")
            .evenly("up", Some(0.025), 1000)
            .unwrap();
        assert_eq!((dt_s, values.len()), (0.025, 3));
        assert!(
            (values[1] - 2.5).abs() < 1e-14,
            "a sixth of the way from 3 to 0"
        );
        let long = "0.000 1.0 0.001 2.0\n99999.999 1.0 0.0 0.0\n";
        assert!(
            pairs(long)
                .evenly("up", None, 1000)
                .err()
                .unwrap()
                .to_string()
                .contains("does not increase")
        );
        let long = "0.000 1.0 0.001 2.0\n99999.999 1.0\n";
        let problem = pairs(long).evenly("up", None, 1000).err().unwrap();
        assert!(problem.hint.unwrap().contains("`resample = "));
        let damaged = pairs("0.000 1.0 0.001 2.0\n1000000000.0 1.0\n");
        assert!(
            damaged
                .evenly("up", Some(1e-6), 1000)
                .err()
                .unwrap()
                .to_string()
                .contains("too long for steps")
        );
    }
}
