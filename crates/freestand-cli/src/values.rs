//! Flags that hold quantities: kept as text by the argument parser, read here so that a wrong one is a problem with a
//! hint, named by its flag, and all of them are reported at once.

use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{self, Dimension};

use crate::failure::Failure;

/// Reads quantities and collects what is wrong with them.
#[derive(Debug, Default)]
pub(crate) struct Values {
    problems: Vec<Problem>,
}

impl Values {
    /// A value read elsewhere; what is wrong with it is named by its flag.
    pub(crate) fn keep<T>(&mut self, flag: &str, result: Result<T, Problem>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(mut problem) => {
                problem.message = format!("{flag}: {}", problem.message);
                self.problems.push(problem);
                None
            }
        }
    }

    /// Any finite value.
    pub(crate) fn any(&mut self, flag: &str, text: Option<&str>, dimension: Dimension) -> Option<f64> {
        self.keep(flag, quantity::parse(text?, dimension))
    }

    /// A value above zero.
    pub(crate) fn positive(&mut self, flag: &str, text: Option<&str>, dimension: Dimension) -> Option<f64> {
        self.keep(flag, quantity::parse_positive(text?, dimension, "the value"))
    }

    /// A value of zero or more.
    pub(crate) fn non_negative(&mut self, flag: &str, text: Option<&str>, dimension: Dimension) -> Option<f64> {
        self.keep(flag, quantity::parse_non_negative(text?, dimension, "the value"))
    }

    /// A grid or a list.
    pub(crate) fn grid(&mut self, flag: &str, text: &str, dimension: Dimension) -> Option<Vec<f64>> {
        self.keep(flag, quantity::parse_grid(text, dimension))
    }

    /// Two lengths, `"0.3 m, 1.2 m"`.
    pub(crate) fn point(&mut self, flag: &str, text: Option<&str>) -> Option<(f64, f64)> {
        let values = self.grid(flag, text?, Dimension::Length)?;
        if let [x, z] = values[..] {
            return Some((x, z));
        }
        let problem = Problem::new(ProblemKind::Value, "two lengths are expected, x and z");
        self.keep(flag, Err(problem.hint("write \"0.3 m, 1.2 m\": from the old pivot, and above the base")))
    }

    /// Notes a problem found elsewhere.
    pub(crate) fn push(&mut self, problem: Problem) {
        self.problems.push(problem);
    }

    /// Fails if anything was wrong.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        if self.problems.is_empty() { Ok(()) } else { Err(Failure::Problems(self.problems)) }
    }
}
