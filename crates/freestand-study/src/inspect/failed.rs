//! Files and components that are not in a report.

use std::path::Path;

use super::MotionInfo;
use freestand_input::problem::Problem;
use freestand_output::facts::Facts;

/// A file, or a component of one, that is not in the report.
#[derive(Debug, Clone, PartialEq)]
pub struct Failed {
    /// The file as it was named.
    pub path: String,
    /// Why, with the line where there is one.
    pub reason: String,
    /// The same, for messages.
    pub problem: Problem,
}

impl Failed {
    pub(super) fn new(path: &Path, problem: Problem) -> Self {
        let problem = problem.in_file(path);
        // The report has the path already, unless another file is wrong.
        let elsewhere = problem.path.clone().filter(|other| other != path);
        let reason = Problem { path: elsewhere, ..problem.clone() }.to_string();
        Self { path: path.to_string_lossy().into_owned(), reason, problem }
    }

    /// Its part of the document.
    pub fn facts(&self) -> Facts<'_> {
        let failed = Facts::default().key("path", self.path.as_str()).key("reason", self.reason.as_str());
        failed.key("hint", self.problem.hint.as_deref())
    }
}

/// The results of one file.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) motions: Vec<MotionInfo>,
    pub(super) notes: Vec<String>,
    pub(super) problems: Vec<Problem>,
}
