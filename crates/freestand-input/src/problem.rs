//! Problems with an input: the file, the line, what is wrong, and a remedy.

use std::borrow::Cow;
use std::fmt;
use std::path::{Path, PathBuf};

use crate::keys::KeyStyle;

/// The kind of a [`Problem`], for programs that must tell them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProblemKind {
    /// A file could not be read or written.
    Io,
    /// The format of a file is unknown, or the file is damaged.
    Format,
    /// A value is malformed, has no unit or a wrong one, or is outside the range of the models.
    Value,
    /// A required value was not given.
    Missing,
    /// The calculation failed.
    Computation,
    /// The caller stopped the calculation before its end.
    Stopped,
}

/// One problem, with the place where it was found and a remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The kind of problem.
    pub kind: ProblemKind,
    /// The file, if there is one.
    pub path: Option<PathBuf>,
    /// Line in that file, counted from 1.
    pub line: Option<usize>,
    /// The keys that it is about. If there are several, the line is that of the last one in the
    /// file.
    pub keys: Vec<Cow<'static, str>>,
    /// What is wrong; [`keys`](crate::keys) are in backticks.
    pub message: String,
    /// The remedy; keys are written as in the message.
    pub hint: Option<String>,
}

impl Problem {
    /// A problem that is not yet tied to a file.
    pub fn new(kind: ProblemKind, message: impl Into<String>) -> Self {
        Self {
            kind,
            path: None,
            line: None,
            keys: Vec::new(),
            message: message.into(),
            hint: None,
        }
    }

    /// A problem with a value, and its remedy.
    pub fn value(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::new(ProblemKind::Value, message).hint(hint)
    }

    /// A problem with the format of a file, and its remedy.
    pub fn format(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::new(ProblemKind::Format, message).hint(hint)
    }

    /// The caller stopped the calculation.
    pub fn stopped() -> Self {
        Self::new(
            ProblemKind::Stopped,
            "the calculation was stopped before its end",
        )
        .hint("run it again")
    }

    /// Sets the keys that it is about, unless they are already set.
    #[must_use]
    pub fn of(mut self, keys: &[&'static str]) -> Self {
        if self.keys.is_empty() {
            self.keys = keys.iter().map(|&key| Cow::Borrowed(key)).collect();
        }
        self
    }

    /// As [`Problem::of`], of a key that is not known.
    #[must_use]
    pub fn of_key(mut self, key: String) -> Self {
        if self.keys.is_empty() {
            self.keys.push(Cow::Owned(key));
        }
        self
    }

    /// Makes the problem one with the value of this key: the message then begins with the key,
    /// `` `damping`: … ``.
    #[must_use]
    pub fn named(mut self, key: &'static str) -> Self {
        self.message = format!("`{key}`: {}", self.message);
        self.of(&[key])
    }

    /// The problem of a key that somebody reads under another name.
    #[must_use]
    pub fn renamed(mut self, from: &str, to: &'static str) -> Self {
        let (from_key, to_key) = (format!("`{from}`"), format!("`{to}`"));
        self.message = self.message.replace(&from_key, &to_key);
        self.hint = self.hint.map(|hint| hint.replace(&from_key, &to_key));
        for key in &mut self.keys {
            if key == from {
                *key = Cow::Borrowed(to);
            }
        }
        self
    }

    /// Whether it is about this key.
    pub fn is_about(&self, key: &str) -> bool {
        self.keys.iter().any(|one| one == key)
    }

    /// The first of the keys that it is about.
    pub fn key(&self) -> Option<&str> {
        self.keys.first().map(Cow::as_ref)
    }

    /// Writes the keys in a style, for good: a problem in a file then always shows the keys of that
    /// file.
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

    /// Sets the hint.
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

/// All problems of an input, collected while it is read and reported together.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Problems {
    /// The problems, in the order in which they were found; as an error, never empty.
    pub problems: Vec<Problem>,
}

impl Problems {
    /// Whether there are no problems so far.
    pub fn is_empty(&self) -> bool {
        self.problems.is_empty()
    }

    /// Whether the caller stopped the calculation.
    pub fn is_stopped(&self) -> bool {
        self.problems
            .iter()
            .any(|problem| problem.kind == ProblemKind::Stopped)
    }

    /// The number of problems.
    pub fn len(&self) -> usize {
        self.problems.len()
    }

    /// Adds a problem.
    pub fn push(&mut self, problem: Problem) {
        self.problems.push(problem);
    }

    /// The value of a result; its problems are collected.
    pub fn keep<T, E: Into<Problems>>(&mut self, result: Result<T, E>) -> Option<T> {
        result
            .map_err(|error| self.problems.extend(error.into().problems))
            .ok()
    }

    /// The value of a result; its problem is collected under this key.
    pub fn keep_named<T>(&mut self, key: &'static str, result: Result<T, Problem>) -> Option<T> {
        self.keep(result.map_err(|problem| problem.named(key)))
    }

    /// Adds the problems of a comparison of values. It leaves out those about a key that has a problem
    /// already.
    pub fn keep_comparisons(&mut self, compared: Result<(), Self>) {
        let own = self.len();
        for problem in compared.err().into_iter().flatten() {
            let mut before = self.problems.iter().take(own);
            if !before.any(|one| one.keys.iter().any(|key| problem.is_about(key))) {
                self.problems.push(problem);
            }
        }
    }

    /// The value, if there are no problems. If the value is `None`, its problem must have been
    /// collected.
    ///
    /// # Errors
    /// All collected problems.
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

impl FromIterator<Problem> for Problems {
    fn from_iter<I: IntoIterator<Item = Problem>>(problems: I) -> Self {
        Self {
            problems: problems.into_iter().collect(),
        }
    }
}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self {
            problems: vec![problem],
        }
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
