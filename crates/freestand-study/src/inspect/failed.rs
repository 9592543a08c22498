//! What of several files is in a report, and what is not.

use std::path::Path;

use serde::Serialize;

use super::MotionInfo;
use freestand_input::problem::Problem;

/// A file, or a component of one, that is not in the report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Failed {
    /// The file as it was named.
    pub path: String,
    /// Why, with the line where there is one.
    pub reason: String,
    /// What to do about it.
    pub hint: Option<String>,
    /// The same, for messages.
    #[serde(skip)]
    pub problem: Problem,
}

impl Failed {
    pub(super) fn new(path: &Path, problem: Problem) -> Self {
        let problem = problem.in_file(path);
        // The path stands beside, unless it is another file that is wrong.
        let elsewhere = problem.path.clone().filter(|other| other != path);
        let reason = Problem { path: elsewhere, ..problem.clone() }.to_string();
        Self { path: path.to_string_lossy().into_owned(), reason, hint: problem.hint.clone(), problem }
    }
}

/// What came of one file.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) motions: Vec<MotionInfo>,
    pub(super) notes: Vec<String>,
    pub(super) problems: Vec<Problem>,
}
