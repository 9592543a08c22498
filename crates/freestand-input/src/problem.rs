//! What is wrong with an input: which file, which line, what, and what to do about it.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::keys::KeyStyle;

/// The kind of a [`Problem`], for programs that must tell them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProblemKind {
    /// A file could not be read or written.
    Io,
    /// A file's format is not known or is broken.
    Format,
    /// A value is missing, has no unit or the wrong one, or lies outside what the models accept.
    Value,
    /// A value that is needed was not given.
    Missing,
    /// The models could not finish.
    Computation,
    /// The caller stopped the calculation before its end.
    Stopped,
}

/// One thing that is wrong, with the place where it was found and a remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// What kind of problem.
    pub kind: ProblemKind,
    /// The file, where there is one.
    pub path: Option<PathBuf>,
    /// Line in that file, counted from 1.
    pub line: Option<usize>,
    /// The keys that it is about. Of several, the one that comes last in a file is to blame.
    pub keys: Vec<&'static str>,
    /// What is wrong; [`keys`](crate::keys) are in backticks.
    pub message: String,
    /// What to do about it; keys as in the message.
    pub hint: Option<String>,
}

impl Problem {
    /// A problem that is not yet tied to a file.
    pub fn new(kind: ProblemKind, message: impl Into<String>) -> Self {
        Self { kind, path: None, line: None, keys: Vec::new(), message: message.into(), hint: None }
    }

    /// A value that is wrong, and what to do about it.
    pub fn value(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::new(ProblemKind::Value, message).hint(hint)
    }

    /// The caller stopped the calculation.
    pub fn stopped() -> Self {
        Self::new(ProblemKind::Stopped, "the calculation was stopped before its end").hint("run it again")
    }

    /// Says which keys it is about, unless that was said already.
    #[must_use]
    pub fn of(mut self, keys: &[&'static str]) -> Self {
        if self.keys.is_empty() {
            self.keys = keys.to_vec();
        }
        self
    }

    /// The same of the value of one key, with which the message begins: `` `damping`: … ``.
    #[must_use]
    pub fn named(mut self, key: &'static str) -> Self {
        self.message = format!("`{key}`: {}", self.message);
        self.of(&[key])
    }

    /// The same with its keys in a style, once and for all: those of a file are shown as the file has them.
    #[must_use]
    pub fn shown(mut self, style: KeyStyle) -> Self {
        self.message = style.shown(&self.message);
        self.hint = self.hint.map(|hint| style.shown(&hint));
        self
    }

    /// Ties the problem to a file, unless it is tied to one already.
    #[must_use]
    pub fn in_file(mut self, path: &Path) -> Self {
        self.path.get_or_insert_with(|| path.to_path_buf());
        self
    }

    /// Ties the problem to a line, counted from 1, unless it is tied to one already.
    #[must_use]
    pub fn at_line(mut self, line: usize) -> Self {
        self.line.get_or_insert(line);
        self
    }

    /// Says what to do about it.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl fmt::Display for Problem {
    /// `file:line: message`, without the hint.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(path) = &self.path {
            write!(f, "{}:", path.display())?;
            if let Some(line) = self.line {
                write!(f, "{line}:")?;
            }
            write!(f, " ")?;
        } else if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        write!(f, "{}", self.message)
    }
}

/// Everything that is wrong, collected while an input is read and reported at once.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Problems {
    /// The problems, in the order in which they were found; as an error, never empty.
    pub problems: Vec<Problem>,
}

impl Problems {
    /// Whether nothing is wrong so far.
    pub fn is_empty(&self) -> bool {
        self.problems.is_empty()
    }

    /// Whether the caller stopped the calculation.
    pub fn is_stopped(&self) -> bool {
        self.problems.iter().any(|problem| problem.kind == ProblemKind::Stopped)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.problems.len()
    }

    /// Adds a problem.
    pub fn push(&mut self, problem: Problem) {
        self.problems.push(problem);
    }

    /// The value; what is wrong with it is kept.
    pub fn keep<T, E: Into<Problems>>(&mut self, result: Result<T, E>) -> Option<T> {
        result.map_err(|error| self.problems.extend(error.into().problems)).ok()
    }

    /// The value of a key; what is wrong with it is kept under that key.
    pub fn keep_named<T>(&mut self, key: &'static str, result: Result<T, Problem>) -> Option<T> {
        self.keep(result.map_err(|problem| problem.named(key)))
    }

    /// The value, where nothing was wrong; a value that is missing has its problem here.
    ///
    /// # Errors
    /// All that is wrong.
    pub fn finish<T>(self, value: Option<T>) -> Result<T, Self> {
        match value {
            Some(value) if self.is_empty() => Ok(value),
            _ => Err(self),
        }
    }
}

impl IntoIterator for Problems {
    type Item = Problem;
    type IntoIter = std::vec::IntoIter<Problem>;

    fn into_iter(self) -> Self::IntoIter {
        self.problems.into_iter()
    }
}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self { problems: vec![problem] }
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
            if let Some(hint) = &problem.hint {
                write!(f, " ({hint})")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Problems {}
impl std::error::Error for Problem {}
