//! Test points of a damage boundary (ASTM D3332): velocity change, peak acceleration, and whether
//! the object was damaged.

use std::path::Path;

use crate::text::headings::{Heading, heading};
use crate::text::lines::{Line, check_text, lines};
use crate::text::table::quoted_cells;
use freestand_input::file::load;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Dimension, shorten};

const HINT: &str = "name the columns and their units, such as \
                    \"velocity change [m/s],peak acceleration [g],damaged,method\"";

/// One shock of a test; `None` if the file does not state it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamageRow {
    /// Its line, from 1.
    pub line: usize,
    /// \[m/s\].
    pub velocity_change_m_s: f64,
    /// \[m/s²\].
    pub peak_acceleration_m_s2: f64,
    /// Whether the object was damaged.
    pub damaged: bool,
    /// `'A'` or `'B'`.
    pub method: Option<char>,
    /// \[s\].
    pub duration_s: Option<f64>,
}

/// Reads a file of such points.
///
/// # Errors
/// A missing column, or a cell that cannot be read.
pub fn load_damage_points(path: &Path) -> Result<Vec<DamageRow>, Problem> {
    let mut bytes = load(path)?;
    check_text(&mut bytes).and_then(|()| read_damage_points(&bytes)).map_err(|problem| problem.in_file(path))
}

fn wrong(line: usize, message: String) -> Problem {
    Problem::new(ProblemKind::Format, message).at_line(line)
}

/// The places of the columns.
struct Columns {
    separator: u8,
    headings: Vec<Heading>,
    velocity_change: usize,
    peak: usize,
    damaged: usize,
    method: Option<usize>,
    duration: Option<usize>,
}

fn columns(line: &Line<'_>) -> Result<Columns, Problem> {
    let text = line.text();
    let separator = [b';', b'\t'].into_iter().find(|byte| text.as_bytes().contains(byte)).unwrap_or(b',');
    let headings: Vec<Heading> = quoted_cells(&text, separator).iter().map(|cell| heading(cell)).collect();
    let only = |is_it: &dyn Fn(&Heading) -> bool, what: &str| -> Result<Option<usize>, Problem> {
        let mut found = headings.iter().enumerate().filter(|(_, heading)| is_it(heading));
        let first = found.next();
        if let (Some((_, one)), Some((_, other))) = (first, found.next()) {
            let names = format!("\"{}\" and \"{}\"", shorten(&one.name), shorten(&other.name));
            return Err(
                wrong(line.number, format!("{names} are both {what}")).hint("keep only one of them in the file")
            );
        }
        Ok(first.map(|(index, _)| index))
    };
    let of = |dimension: Dimension| move |heading: &Heading| heading.unit.is_some_and(|u| u.dimension == dimension);
    let named = |word: &'static str| move |heading: &Heading| heading.name.to_lowercase().starts_with(word);
    let needed = |found: Option<usize>, what: &str| {
        found.ok_or_else(|| wrong(line.number, format!("no column holds {what}")).hint(HINT))
    };
    Ok(Columns {
        velocity_change: needed(
            only(&of(Dimension::Velocity), "a velocity change")?,
            "a velocity change with its unit",
        )?,
        peak: needed(only(&of(Dimension::Acceleration), "a peak acceleration")?, "a peak acceleration with its unit")?,
        damaged: needed(only(&named("damage"), "about damage")?, "whether there was damage")?,
        method: only(&named("method"), "a method")?,
        duration: only(&of(Dimension::Time), "a duration")?,
        separator,
        headings,
    })
}

fn read_damage_points(bytes: &[u8]) -> Result<Vec<DamageRow>, Problem> {
    let mut rest = lines(bytes).filter(|line| !line.is_blank() && !line.is_comment());
    let header = rest.next().ok_or_else(|| Problem::new(ProblemKind::Format, "the file is empty").hint(HINT))?;
    let columns = columns(&header)?;
    rest.map(|line| row(&line, &columns)).collect()
}

fn row(line: &Line<'_>, columns: &Columns) -> Result<DamageRow, Problem> {
    let cells = quoted_cells(&line.text(), columns.separator);
    if cells.len() != columns.headings.len() {
        let message = format!("{} cells under {} headings", cells.len(), columns.headings.len());
        return Err(wrong(line.number, message).hint("write one point per line"));
    }
    let cell = |index: usize| cells.get(index).map_or("", String::as_str);
    let number = |index: usize, what: &str| -> Result<f64, Problem> {
        let text = cell(index);
        // Where semicolons separate the cells, a comma is a decimal sign.
        let plain = if columns.separator == b';' { text.replace(',', ".") } else { text.to_owned() };
        let unit = columns.headings.get(index).and_then(|heading| heading.unit);
        let value = plain.parse::<f64>().ok().zip(unit).map(|(value, unit)| unit.to_si(value));
        value.filter(|value| *value > 0.0 && value.is_finite()).ok_or_else(|| {
            wrong(line.number, format!("the {what} is \"{}\", not a positive number", shorten(text)))
                .hint("correct the row, or make it a comment with #")
        })
    };
    let damaged = match cell(columns.damaged).to_lowercase().as_str() {
        "1" | "yes" | "y" | "true" => true,
        "0" | "no" | "n" | "false" => false,
        other => {
            let message = format!("\"{}\" does not say whether there was damage", shorten(other));
            return Err(wrong(line.number, message).hint("write 0 or 1, yes or no, true or false"));
        }
    };
    let method = match columns.method.map_or("", cell).to_uppercase().as_str() {
        "" => None,
        "A" => Some('A'),
        "B" => Some('B'),
        other => {
            let message = format!("\"{}\" is not a method of ASTM D3332", shorten(other));
            let hint = "write A (short pulses, critical velocity change) or B (critical acceleration)";
            return Err(wrong(line.number, message).hint(hint));
        }
    };
    let duration = columns.duration.filter(|&index| !cell(index).is_empty());
    Ok(DamageRow {
        line: line.number,
        velocity_change_m_s: number(columns.velocity_change, "velocity change")?,
        peak_acceleration_m_s2: number(columns.peak, "peak acceleration")?,
        damaged,
        method,
        duration_s: duration.map(|index| number(index, "duration")).transpose()?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use freestand::G0_M_S2;

    #[test]
    fn cells_are_read_with_their_units() {
        let text = "# unit 3\nmethod,damaged,peak acceleration [g],\"velocity change [cm/s]\",duration [ms]\n\n\
                    A,no,200,60,2\n# fuse blown\n,TRUE,\"30\",150,\n";
        let rows = read_damage_points(text.as_bytes()).unwrap();
        assert_eq!(rows.iter().map(|row| row.line).collect::<Vec<_>>(), [4, 6]);
        assert!((rows[0].velocity_change_m_s - 0.6).abs() < 1e-15);
        assert!((rows[0].peak_acceleration_m_s2 / G0_M_S2 - 200.0).abs() < 1e-12);
        assert_eq!((rows[0].method, rows[0].damaged, rows[0].duration_s), (Some('A'), false, Some(2e-3)));
        assert_eq!((rows[1].method, rows[1].damaged, rows[1].duration_s), (None, true, None));
        let german = read_damage_points(b"velocity change [m/s];peak [g];damaged\n0,6;200;0\n").unwrap();
        assert!((german[0].velocity_change_m_s - 0.6).abs() < 1e-15);
    }

    #[test]
    fn what_is_no_point_is_refused_with_its_line() {
        const NAMES: &str = "velocity change [m/s],peak [g],damaged,method\n";
        let cases = [
            ("", "empty"),
            ("velocity change,peak [g],damaged\n1,2,0\n", "no column holds a velocity change"),
            ("velocity change [m/s],peak [g]\n1,2\n", "whether there was damage"),
            ("v [m/s],w [m/s],peak [g],damaged\n1,1,2,0\n", "both a velocity change"),
            (&format!("{NAMES}1,2,maybe,A\n"), "line 2: \"maybe\" does not say"),
            (&format!("{NAMES}1,2,0,A\n1,2,0,C\n"), "line 3: \"C\" is not a method"),
            (&format!("{NAMES}1,-2,0,A\n"), "line 2: the peak acceleration is \"-2\""),
            (&format!("{NAMES}1,nan,0,A\n"), "not a positive number"),
            (&format!("{NAMES}1,2,0\n"), "3 cells under 4 headings"),
        ];
        for (text, said) in cases {
            let problem = read_damage_points(text.as_bytes()).unwrap_err();
            assert!(problem.to_string().contains(said) && problem.hint.is_some(), "{problem}");
        }
    }
}
