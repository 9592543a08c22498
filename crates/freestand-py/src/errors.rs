//! Problems as Python exceptions: the classes are those of `freestand/_errors.py`.

use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use pyo3::PyErr;
use pyo3::import_exception;

import_exception!(freestand._errors, BadValue);
import_exception!(freestand._errors, Interrupted);
import_exception!(freestand._errors, ReadError);
import_exception!(freestand._errors, SolveError);
import_exception!(freestand._errors, StudyError);

/// What an exception is made of: message, path, line, hint, arguments.
type Parts = (
    String,
    Option<String>,
    Option<usize>,
    Option<String>,
    Vec<String>,
);

/// Keys as arguments of Python, except in a problem with a file, which shows those of the file.
fn parts(problem: &Problem) -> Parts {
    let style = if problem.path.is_some() {
        KeyStyle::File
    } else {
        KeyStyle::Argument
    };
    let shown = |text: &String| style.shown(text);
    let path = problem
        .path
        .as_ref()
        .map(|path| path.to_string_lossy().into_owned());
    (
        shown(&problem.message),
        path,
        problem.line,
        problem.hint.as_ref().map(shown),
        problem.keys.iter().map(|key| style.name(key)).collect(),
    )
}

/// The exception of one problem.
pub(crate) fn raised(problem: Problem) -> PyErr {
    raised_all(problem)
}

/// The exception of all problems of a request: its class is that of the first one.
pub(crate) fn raised_all(problems: impl Into<Problems>) -> PyErr {
    let problems: Problems = problems.into();
    if problems.is_stopped() {
        return Interrupted::new_err("the calculation was stopped before its end");
    }
    let all: Vec<Parts> = problems.problems.iter().map(parts).collect();
    let (kind, in_file) = problems
        .problems
        .first()
        .map_or((ProblemKind::Value, false), |first| {
            (first.kind, first.path.is_some())
        });
    match kind {
        ProblemKind::Io | ProblemKind::Format => ReadError::new_err((all,)),
        ProblemKind::Value | ProblemKind::Missing if in_file => ReadError::new_err((all,)),
        ProblemKind::Value | ProblemKind::Missing => BadValue::new_err((all,)),
        ProblemKind::Computation | ProblemKind::Stopped => SolveError::new_err((all,)),
    }
}

/// The exception of a study or an inventory that cannot be used, with all its problems.
pub(crate) fn of_study(problems: impl Into<Problems>) -> PyErr {
    let problems: Problems = problems.into();
    if problems.is_stopped() {
        return raised_all(problems);
    }
    StudyError::new_err((problems.problems.iter().map(parts).collect::<Vec<_>>(),))
}
