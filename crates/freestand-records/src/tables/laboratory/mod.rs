//! Files from a laboratory: columns of force and displacement, and facts about the test in
//! comments.

mod clock;
mod lvm;

use crate::text::headings::{Heading, in_si, names_of, no_column, only};
use crate::text::lines::{check_text, lines};
use crate::text::sensitivity::{Sensitivity, no_sensitivity, not_in_volts, volts_of_heading};
use crate::text::table;
use freestand_input::file;
use freestand_input::problem::Problem;
use freestand_input::quantity::Dimension;
use std::path::Path;

/// Force and displacement in the order of the test.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceDisplacement {
    /// Force \[N\].
    pub force_n: Vec<f64>,
    /// Displacement \[m\].
    pub displacement_m: Vec<f64>,
    /// Facts from the comments.
    pub comments: Vec<Comment>,
}

/// A line `# key: value`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Comment {
    /// In lower case.
    pub key: String,
    /// As it was written.
    pub value: String,
    /// Its line, from 1.
    pub line: usize,
}

/// The comments at the head of a text.
pub fn comments(bytes: &[u8]) -> Vec<Comment> {
    let head =
        lines(bytes).take_while(|line| line.is_comment() || line.is_blank() || line.number == 1);
    head.filter_map(|line| {
        let text = line.text();
        let (key, value) = text.trim_start().strip_prefix('#')?.split_once(':')?;
        Some(Comment {
            key: key.trim().to_lowercase(),
            value: value.trim().to_owned(),
            line: line.number,
        })
    })
    .collect()
}

/// A file of a laboratory as a plain table of numbers, on the same lines: UTF-16, measurement files of LabVIEW, and times
/// of the day in the first column.
///
/// # Errors
/// A file that cannot be read, or is not text.
pub fn load(path: &Path) -> Result<Vec<u8>, Problem> {
    let mut bytes = file::load(path)?;
    let plain = || {
        check_text(&mut bytes)?;
        let table = lvm::plain(&bytes)?;
        Ok(table.or_else(|| clock::in_seconds(&bytes)).unwrap_or(bytes))
    };
    plain().map_err(|problem: Problem| problem.in_file(path))
}

/// Reads a static test. The header must name one column of force and one of displacement, with units; a column in volts
/// needs the sensitivity of its sensor.
///
/// # Errors
/// A file that is not such a table.
pub fn load_static(
    path: &Path,
    sensitivities: &[Sensitivity],
) -> Result<ForceDisplacement, Problem> {
    read_static(&load(path)?, sensitivities).map_err(|problem| problem.in_file(path))
}

fn read_static(bytes: &[u8], sensitivities: &[Sensitivity]) -> Result<ForceDisplacement, Problem> {
    let table = table::read(bytes)?;
    let wanted = "name the columns and their units, such as \"displacement [mm],force [N]\"";
    let (headings, line) = names_of(&table, wanted)?;
    let is_volts = |heading: &Heading| volts_of_heading(heading).is_some();
    let has = |dimension: Dimension| headings.iter().any(|heading| heading.measures(dimension));
    // A column in volts is what the other columns are not, or what its name says where there are two.
    let is_in_volts = |heading: &Heading, dimension: Dimension| {
        let other = if dimension == Dimension::Force {
            Dimension::Length
        } else {
            Dimension::Force
        };
        is_volts(heading) && (has(other) || heading.is_force() == (dimension == Dimension::Force))
    };
    let column = |dimension: Dimension, what: &str, example: &str| -> Result<Vec<f64>, Problem> {
        let what_it_is = format!("a {what}");
        let sensor = sensitivities
            .iter()
            .find(|one| one.dimension() == dimension);
        let measures = |heading: &Heading| heading.measures(dimension);
        if let Some(index) = only(&headings, line, measures, &what_it_is)? {
            if sensor.is_some() {
                return Err(not_in_volts(&format!("the {what}")).at_line(line));
            }
            return Ok(in_si(&table, &headings, index));
        }
        let is_it = |heading: &Heading| is_in_volts(heading, dimension);
        let Some(index) = only(&headings, line, is_it, &what_it_is)? else {
            return Err(no_column(what, wanted).at_line(line));
        };
        let (Some(sensor), Some(volts)) = (sensor, volts_of_heading(&headings[index])) else {
            return Err(no_sensitivity(&headings[index], line, example));
        };
        Ok(in_si(&table, &headings, index)
            .into_iter()
            .map(|value| sensor.si_of(value * volts))
            .collect())
    };
    let force_n = column(Dimension::Force, "force", "2 mV/N")?;
    let displacement_m = column(Dimension::Length, "displacement", "1 V/mm")?;
    Ok(ForceDisplacement {
        force_n,
        displacement_m,
        comments: comments(bytes),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::sensitivity::parse_sensitivity;

    #[test]
    fn columns_are_found_by_their_units() {
        let text = "# impactor: sphere\n# Boundary: glued\ntime [s],Load [kN],LVDT [mm]\n0,0,0\n1,0.5,0.25\n";
        let read = read_static(text.as_bytes(), &[]).unwrap();
        assert_eq!(
            (read.force_n, read.displacement_m),
            (vec![0.0, 500.0], vec![0.0, 0.25e-3])
        );
        let boundary = Comment {
            key: "boundary".to_owned(),
            value: "glued".to_owned(),
            line: 2,
        };
        assert_eq!(read.comments[1], boundary);
        for text in [
            "0,0\n1,2\n",
            "force [N],x\n0,0\n1,1\n",
            "force [N],load [kN],d [mm]\n0,0,0\n1,1,1\n",
        ] {
            assert!(
                read_static(text.as_bytes(), &[])
                    .unwrap_err()
                    .hint
                    .is_some(),
                "{text}"
            );
        }
    }
    /// 2 mV/N and 0.5 V/mm: 10 mV are 5 N, 0.25 V are 0.5 mm.
    #[test]
    fn volts_need_their_sensor() {
        let sensors = ["2 mV/N", "0.5 V/mm"].map(|text| parse_sensitivity(text).unwrap());
        for (text, sensors) in [
            ("d [mm],Cell [mV]\n0,0\n0.5,10\n", &sensors[..1]),
            ("LVDT [V],load [mV]\n0,0\n0.25,10\n", &sensors),
            ("LVDT [V],load [N]\n0,0\n0.25,5\n", &sensors[1..]),
        ] {
            let read = read_static(text.as_bytes(), sensors).unwrap();
            for (found, expected) in [(read.force_n[1], 5.0), (read.displacement_m[1], 0.5e-3)] {
                assert!((found / expected - 1.0).abs() < 1e-12, "{text}: {found}");
            }
            let problem = read_static(text.as_bytes(), &[]).unwrap_err();
            assert!(
                problem.message.contains("is in volts") && problem.line == Some(1),
                "{problem:?}"
            );
        }
        // A sensitivity without effect.
        assert!(
            read_static(b"d [mm],load [N]\n0,0\n0.5,5\n", &sensors)
                .unwrap_err()
                .message
                .contains("not in volts")
        );
    }
}
