//! Columns of numbers, one row per line, to the end of the file.

use super::fixed_width::Format;
use super::gaps::Markers;
use super::line_width::LineWidth;
use super::lines::Lines;
use crate::notes::Note;
use freestand_input::problem::Problem;
use freestand_input::words::counted;

/// Columns of equal length.
pub(crate) struct Rows {
    pub(crate) columns: Vec<Vec<f64>>,
    /// Line of the first row, counted from 1; 0 before there is one.
    pub(crate) first_line: usize,
    /// One for each column.
    markers: Vec<Markers>,
}

impl Rows {
    pub(crate) fn of_width(width: usize) -> Self {
        let markers = (0..width).map(|_| Markers::default()).collect();
        Self {
            columns: vec![Vec::new(); width],
            first_line: 0,
            markers,
        }
    }

    /// How many rows there are.
    pub(crate) fn count(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Adds the numbers of a line.
    ///
    /// # Errors
    /// More or fewer numbers than columns, a number that is not a value in any unit.
    pub(crate) fn push(&mut self, row: &[f64], line: usize) -> Result<(), Problem> {
        if row.len() != self.columns.len() {
            let values = counted(self.columns.len(), "value");
            let message = format!("a row must have {values}, but this one has {}", row.len());
            return Err(Problem::format(
                message,
                "the file may be cut off or damaged: fetch it again",
            )
            .at_line(line));
        }
        for (markers, value) in self.markers.iter_mut().zip(row) {
            markers.see(*value, line)?;
        }
        if self.first_line == 0 {
            self.first_line = line;
        }
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(*value);
        }
        Ok(())
    }

    /// Notes about values that may mark missing values, once all rows are there.
    ///
    /// # Errors
    /// A value that marks a missing value.
    pub(crate) fn judge(&self) -> Result<Vec<Note>, Problem> {
        let judged = self
            .markers
            .iter()
            .zip(&self.columns)
            .map(|(markers, column)| markers.judge(column));
        judged.filter_map(Result::transpose).collect()
    }

    /// The rows, if there are any; `lines` is where they end.
    ///
    /// # Errors
    /// No rows.
    pub(crate) fn not_empty(self, lines: &Lines<'_>) -> Result<Self, Problem> {
        if self.first_line == 0 {
            Err(no_row(lines))
        } else {
            Ok(self)
        }
    }
}

/// The problem of a header without rows.
pub(crate) fn no_row(lines: &Lines<'_>) -> Problem {
    Problem::format(
        "no row of numbers follows the header",
        "the file may be cut off: fetch it again",
    )
    .at_line(lines.line_number().max(1))
}

/// Reads each remaining line that is not blank as one row of `format`.
///
/// # Errors
/// No rows, a field that is not a number, a line that is too short although the others are not;
/// otherwise as [`Rows::push`] and [`Rows::judge`].
pub(crate) fn read(
    lines: &mut Lines<'_>,
    format: Format,
    notes: &mut Vec<Note>,
) -> Result<Rows, Problem> {
    let (mut rows, mut row, mut line_width) = (
        Rows::of_width(format.per_line),
        Vec::new(),
        LineWidth::default(),
    );
    for line in lines.filled() {
        row.clear();
        let by_column = format.read_line(&line, format.per_line, &mut row)?;
        line_width.see(&line, format.per_line * format.width, by_column);
        rows.push(&row, line.number)?;
    }
    line_width.check()?;
    notes.extend(rows.judge()?);
    rows.not_empty(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::lines::lines;

    #[test]
    fn rows_are_read_by_column_and_odd_ones_refused() {
        let read = |text: &str| {
            read(
                &mut lines(text.as_bytes()),
                Format::new(2, 8),
                &mut Vec::new(),
            )
            .map(|rows| (rows.columns, rows.first_line))
            .map_err(|problem| problem.to_string())
        };
        // Exact: each value is the nearest f64 to the decimal number.
        let touching = "\n   0.000-999.999\r\n   0.0051234.567\n\n";
        assert_eq!(
            read(touching),
            Ok((vec![vec![0.0, 0.005], vec![-999.999, 1234.567]], 2))
        );
        for (text, line) in [
            ("\n \n", "line 2: no row"),
            ("", "line 1: no row"),
            (
                "   0.000   1.000\n   0.005\n",
                "line 2: a row must have 2 values",
            ),
            (
                "   0.000   1.000\n   0.005   1.000   1.000\n",
                "line 2: a row must have 2 values",
            ),
            (
                "   0.000   1.000\n   0.005-999.000\n",
                "line 2: \"-999\" marks a missing value",
            ),
            ("   0.000     x\n", "line 1: "),
        ] {
            assert!(read(text).unwrap_err().starts_with(line), "{text}");
        }
    }
}
