//! Tests of cushion curves (ASTM D1596): static stress, drop height, thickness and peak
//! acceleration in columns.

use std::path::Path;

use super::building::load_table;
use crate::text::headings::{Heading, in_si, names_of, no_column, only};

use crate::text::table;

use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;

const HINT: &str = "name the columns and their units, such as \
                    \"static stress [kPa],drop height [mm],thickness [mm],peak acceleration [g]\"";

/// One drop on a cushion; `None` if the file does not have the column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveRow {
    /// Its line, from 1.
    pub line: usize,
    /// Static stress mg/A \[Pa\].
    pub static_stress_pa: f64,
    /// Drop height \[m\].
    pub drop_height_m: Option<f64>,
    /// Thickness of the cushion \[m\].
    pub thickness_m: Option<f64>,
    /// Peak acceleration \[m/s²\].
    pub peak_acceleration_m_s2: f64,
}

/// Reads a file of such tests.
///
/// # Errors
/// No table, or no column of stress or acceleration with its unit.
pub fn load_curve(path: &Path) -> Result<Vec<CurveRow>, Problem> {
    read_curve(&load_table(path)?).map_err(|problem| problem.in_file(path))
}

fn read_curve(bytes: &[u8]) -> Result<Vec<CurveRow>, Problem> {
    let table = table::read(bytes).map_err(|problem| problem.hint(HINT))?;
    let (headings, line) = names_of(&table, HINT)?;
    let column = |dimension: Dimension, words: &[&str]| -> Result<Option<Vec<f64>>, Problem> {
        let is_it = |heading: &Heading| {
            let name = heading.name.to_lowercase();
            heading.measures(dimension)
                && (words.is_empty() || words.iter().any(|word| name.contains(word)))
        };
        let found = only(&headings, line, is_it, dimension.with_article())?;
        Ok(found.map(|index| in_si(&table, &headings, index)))
    };
    let missing = |what: &str| no_column(what, HINT).at_line(line);
    let stress = column(Dimension::Pressure, &[])?.ok_or_else(|| missing("static stress"))?;
    let peak = column(Dimension::Acceleration, &[])?.ok_or_else(|| missing("peak acceleration"))?;
    let heights = column(Dimension::Length, &["height", "drop", "fall"])?;
    let thicknesses = column(Dimension::Length, &["thick"])?;
    let at = |column: &Option<Vec<f64>>, row: usize| {
        column.as_ref().and_then(|column| column.get(row).copied())
    };
    let rows = table
        .lines_of_rows(bytes)
        .zip(stress.into_iter().zip(peak))
        .enumerate();
    Ok(rows
        .map(
            |(row, (line, (static_stress_pa, peak_acceleration_m_s2)))| CurveRow {
                line,
                static_stress_pa,
                drop_height_m: at(&heights, row),
                thickness_m: at(&thicknesses, row),
                peak_acceleration_m_s2,
            },
        )
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use freestand::G0_M_S2;

    #[test]
    fn columns_are_found_by_unit_and_name() {
        let text = "# foam\nthickness [mm],static stress [kPa],drop height [cm],peak acceleration \
                    [g]\n50,3,60,42\n50,6,60,38\n";
        let rows = read_curve(text.as_bytes()).unwrap();
        assert_eq!(rows.len(), 2);
        assert_eq!((rows[1].line, rows[1].static_stress_pa), (4, 6e3));
        assert_eq!(
            (rows[1].drop_height_m, rows[1].thickness_m),
            (Some(0.6), Some(0.05))
        );
        assert!((rows[1].peak_acceleration_m_s2 / G0_M_S2 - 38.0).abs() < 1e-12);
        let bare = read_curve(b"stress [kPa],G [g]\n3,42\n4,40\n").unwrap();
        assert_eq!((bare[0].drop_height_m, bare[0].thickness_m), (None, None));
        assert!(read_curve(b"a,b\n1,2\n3,4\n").is_err());
    }
}
