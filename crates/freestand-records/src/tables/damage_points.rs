//! Test points of a damage boundary (ASTM D3332): velocity change, peak acceleration, and whether
//! the object was damaged.

use std::path::Path;

use super::building::load_table;
use crate::text::cells::Cells;
use crate::text::headings::Heading;

use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, shorten};

const HINT: &str = "name the columns and their units, such as \
                    \"velocity change [m/s],peak acceleration [g],damaged,method\"";

/// A method of ASTM D3332.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TestMethod {
    /// Short pulses, for the critical velocity change.
    A,
    /// Long pulses, for the critical acceleration.
    B,
}

impl std::fmt::Display for TestMethod {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::A => "A",
            Self::B => "B",
        })
    }
}

/// One shock of a test; `None` if the file does not state it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamageRow {
    /// Its line, from 1.
    pub line: usize,
    /// Velocity change \[m/s\].
    pub velocity_change_m_s: f64,
    /// Peak acceleration \[m/s²\].
    pub peak_acceleration_m_s2: f64,
    /// Whether the object was damaged.
    pub damaged: bool,
    /// Method of the test.
    pub method: Option<TestMethod>,
    /// Duration of the pulse \[s\].
    pub duration_s: Option<f64>,
}

/// Reads a file of such points.
///
/// # Errors
/// A missing column, or a cell that cannot be read.
pub fn load_damage_points(path: &Path) -> Result<Vec<DamageRow>, Problem> {
    read_damage_points(&load_table(path)?).map_err(|problem| problem.in_file(path))
}

fn read_damage_points(bytes: &[u8]) -> Result<Vec<DamageRow>, Problem> {
    let cells = Cells::read(bytes, HINT)?;
    let velocity_change = cells.needed(Dimension::Velocity, "a velocity change")?;
    let peak = cells.needed(Dimension::Acceleration, "a peak acceleration")?;
    let named =
        |word: &'static str| move |heading: &Heading| heading.name.to_lowercase().starts_with(word);
    let damaged = cells.only(named("damage"), "about damage")?;
    let damaged = damaged.ok_or_else(|| cells.missing("whether there was damage"))?;
    let method = cells.only(named("method"), "a method")?;
    let duration = cells.only(|heading| heading.measures(Dimension::Time), "a duration")?;
    let rows = cells.rows.iter().map(|row| {
        let duration = duration.filter(|&column| !row.text(column).is_empty());
        Ok(DamageRow {
            line: row.line,
            velocity_change_m_s: cells.positive(row, velocity_change, "velocity change")?,
            peak_acceleration_m_s2: cells.positive(row, peak, "peak acceleration")?,
            damaged: is_damaged(row.text(damaged)).map_err(|problem| problem.at_line(row.line))?,
            method: method_of(method.map_or("", |column| row.text(column)))
                .map_err(|problem| problem.at_line(row.line))?,
            duration_s: duration
                .map(|column| cells.positive(row, column, "duration"))
                .transpose()?,
        })
    });
    rows.collect()
}

fn is_damaged(text: &str) -> Result<bool, Problem> {
    match text.to_lowercase().as_str() {
        "1" | "yes" | "y" | "true" => Ok(true),
        "0" | "no" | "n" | "false" => Ok(false),
        other => {
            let message = format!(
                "\"{}\" does not say whether there was damage",
                shorten(other)
            );
            Err(Problem::format(
                message,
                "write 0 or 1, yes or no, true or false",
            ))
        }
    }
}

fn method_of(text: &str) -> Result<Option<TestMethod>, Problem> {
    match text.to_uppercase().as_str() {
        "" => Ok(None),
        "A" => Ok(Some(TestMethod::A)),
        "B" => Ok(Some(TestMethod::B)),
        other => {
            let message = format!("\"{}\" is not a method of ASTM D3332", shorten(other));
            let hint =
                "write A (short pulses, critical velocity change) or B (critical acceleration)";
            Err(Problem::format(message, hint))
        }
    }
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
        assert_eq!(
            (rows[0].method, rows[0].damaged, rows[0].duration_s),
            (Some(TestMethod::A), false, Some(2e-3))
        );
        assert_eq!(
            (rows[1].method, rows[1].damaged, rows[1].duration_s),
            (None, true, None)
        );
        let german =
            read_damage_points(b"velocity change [m/s];peak [g];damaged\n0,6;200;0\n").unwrap();
        assert!((german[0].velocity_change_m_s - 0.6).abs() < 1e-15);
    }

    #[test]
    fn what_is_no_point_is_refused_with_its_line() {
        const NAMES: &str = "velocity change [m/s],peak [g],damaged,method\n";
        let cases = [
            ("", "empty"),
            (
                "velocity change,peak [g],damaged\n1,2,0\n",
                "no column holds a velocity change",
            ),
            (
                "velocity change [m/s],peak [g]\n1,2\n",
                "whether there was damage",
            ),
            (
                "v [m/s],w [m/s],peak [g],damaged\n1,1,2,0\n",
                "both a velocity change",
            ),
            (
                &format!("{NAMES}1,2,maybe,A\n"),
                "line 2: \"maybe\" does not say",
            ),
            (
                &format!("{NAMES}1,2,0,A\n1,2,0,C\n"),
                "line 3: \"C\" is not a method",
            ),
            (
                &format!("{NAMES}1,-2,0,A\n"),
                "line 2: the peak acceleration is \"-2\"",
            ),
            (&format!("{NAMES}1,nan,0,A\n"), "not a positive number"),
            (
                &format!("{NAMES}1,2,0\n"),
                "this row has 3 cells, but the header has 4",
            ),
        ];
        for (text, said) in cases {
            let problem = read_damage_points(text.as_bytes()).unwrap_err();
            assert!(
                problem.to_string().contains(said) && problem.hint.is_some(),
                "{problem}"
            );
        }
    }
}
