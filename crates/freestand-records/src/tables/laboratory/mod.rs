//! Files from a laboratory: columns of force and displacement, and facts about the test in
//! comments.

use crate::text::headings::{headings_of, in_si, only};
use crate::text::lines::{check_text, lines};
use crate::text::table;
use freestand_input::file::load;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::Dimension;
use std::path::Path;

/// Force and displacement in the order of the test.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceDisplacement {
    /// Force \[N\].
    pub force_n: Vec<f64>,
    /// Displacement \[m\].
    pub displacement_m: Vec<f64>,
    /// Facts from the comments: key, value, line.
    pub said: Vec<(String, String, usize)>,
}

/// `# key: value` lines of a text, keys in lower case.
pub fn comments(bytes: &[u8]) -> Vec<(String, String, usize)> {
    let said = lines(bytes).take_while(|line| line.is_comment() || line.is_blank() || line.number == 1);
    said.filter_map(|line| {
        let text = line.text();
        let (key, value) = text.trim_start().strip_prefix('#')?.split_once(':')?;
        Some((key.trim().to_lowercase(), value.trim().to_owned(), line.number))
    })
    .collect()
}

/// Reads a static test. The header must name one column of force and one of displacement, with
/// units.
pub fn load_static(path: &Path) -> Result<ForceDisplacement, Problem> {
    let mut bytes = load(path)?;
    check_text(&mut bytes).and_then(|()| read_static(&bytes)).map_err(|problem| problem.in_file(path))
}

fn read_static(bytes: &[u8]) -> Result<ForceDisplacement, Problem> {
    let table = table::read(bytes)?;
    let wanted = "name the columns and their units, such as \"displacement [mm],force [N]\"";
    let Some((headings, line)) = headings_of(&table) else {
        return Err(Problem::new(ProblemKind::Format, "the columns have no names").hint(wanted));
    };
    let column = |dimension: Dimension, what: &str| -> Result<Vec<f64>, Problem> {
        let found = only(&headings, line, |heading| heading.measures(dimension), &format!("a {what}"))?;
        found.map(|index| in_si(&table, &headings, index)).ok_or_else(|| {
            let message = format!("no column holds a {what} with its unit");
            Problem::new(ProblemKind::Format, message).at_line(line).hint(wanted)
        })
    };
    let force_n = column(Dimension::Force, "force")?;
    let displacement_m = column(Dimension::Length, "displacement")?;
    Ok(ForceDisplacement { force_n, displacement_m, said: comments(bytes) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_their_units() {
        let text = "# impactor: sphere\n# Boundary: glued\ntime [s],Load [kN],LVDT [mm]\n0,0,0\n1,0.5,0.25\n";
        let read = read_static(text.as_bytes()).unwrap();
        assert_eq!((read.force_n, read.displacement_m), (vec![0.0, 500.0], vec![0.0, 0.25e-3]));
        assert_eq!(read.said[1], ("boundary".to_owned(), "glued".to_owned(), 2));
        for text in ["0,0\n1,2\n", "force [N],x\n0,0\n1,1\n", "force [N],load [kN],d [mm]\n0,0,0\n1,1,1\n"] {
            assert!(read_static(text.as_bytes()).unwrap_err().hint.is_some(), "{text}");
        }
    }
}
