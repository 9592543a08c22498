//! Columns of a Fortran format, one row a line, to the end of the file.

use super::format::Format;
use super::gaps::Markers;
use super::lines::Lines;
use super::setting::Setting;
use crate::error::{Problem, ProblemKind};

/// Columns of equal length.
pub(super) struct Rows {
    pub(super) columns: Vec<Vec<f64>>,
    /// Line of the first row, counted from 1.
    pub(super) first_line: usize,
    /// What is to be said of the values.
    pub(super) notes: Vec<String>,
}

/// Reads every line that is left as one row of `format`; blank lines hold none.
///
/// # Errors
/// No row at all, a field that is no number, a value that stands for a missing one, a row with more or fewer values,
/// or one too short for its fields where the others are not.
pub(super) fn read(lines: &mut Lines<'_>, format: Format) -> Result<Rows, Problem> {
    let mut columns: Vec<Vec<f64>> = vec![Vec::new(); format.per_line];
    let mut markers: Vec<Markers> = columns.iter().map(|_| Markers::default()).collect();
    let (mut row, mut first_line, mut setting) = (Vec::new(), 0, Setting::default());
    for line in lines.by_ref() {
        if line.is_blank() {
            continue;
        }
        row.clear();
        let by_column = format.read_line(&line, format.per_line, &mut row)?;
        setting.see(&line, format, format.per_line, by_column);
        if row.len() != columns.len() {
            let message = format!("a row has {} values, this one {}", columns.len(), row.len());
            return Err(Problem::new(ProblemKind::Format, message)
                .at_line(line.number)
                .hint("the file may be cut off or damaged: fetch it again"));
        }
        for (markers, value) in markers.iter_mut().zip(&row) {
            markers.see(*value, line.number)?;
        }
        if first_line == 0 {
            first_line = line.number;
        }
        for (column, value) in columns.iter_mut().zip(&row) {
            column.push(*value);
        }
    }
    if first_line == 0 {
        return Err(Problem::new(ProblemKind::Format, "no row of numbers follows the header")
            .at_line(lines.line_number().max(1))
            .hint("the file may be cut off: fetch it again"));
    }
    setting.check()?;
    let mut notes = Vec::new();
    for (markers, column) in markers.iter().zip(&columns) {
        notes.extend(markers.judge(column)?);
    }
    Ok(Rows { columns, first_line, notes })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::records::lines::lines;

    #[test]
    fn rows_are_read_by_column_and_odd_ones_refused() {
        let read = |text: &str| {
            read(&mut lines(text.as_bytes()), Format::new(2, 8))
                .map(|rows| (rows.columns, rows.first_line))
                .map_err(|problem| problem.to_string())
        };
        // Exact: each value is the nearest f64 to the decimal number.
        let touching = "\n   0.000-999.999\r\n   0.0051234.567\n\n";
        assert_eq!(read(touching), Ok((vec![vec![0.0, 0.005], vec![-999.999, 1234.567]], 2)));
        for (text, line) in [
            ("\n \n", "line 2: no row"),
            ("", "line 1: no row"),
            ("   0.000   1.000\n   0.005\n", "line 2: a row has 2 values"),
            ("   0.000   1.000\n   0.005   1.000   1.000\n", "line 2: a row has 2 values"),
            ("   0.000   1.000\n   0.005-999.000\n", "line 2: \"-999\" stands for a missing value"),
            ("   0.000     x\n", "line 1: "),
        ] {
            assert!(read(text).unwrap_err().starts_with(line), "{text}");
        }
    }
}
