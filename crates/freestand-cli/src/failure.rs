//! Why a command could not run: problems, each with what to do about it.

use clap::error::ErrorKind;
use freestand_input::problem::{Problem, ProblemKind, Problems};

/// Ends a command with status 2 (130 when it was stopped), or quietly where nobody reads on.
#[derive(Debug)]
pub(crate) enum Failure {
    /// What is wrong, never empty.
    Problems(Vec<Problem>),
    /// The user stopped it; whether part of the result was printed before.
    Stopped { printed: bool },
    /// The user stopped it, and what was finished has been written.
    StoppedAfterWriting,
    /// Standard output was closed by its reader.
    BrokenPipe,
}

impl Failure {
    /// A wrong argument.
    pub(crate) fn usage(message: impl Into<String>, hint: impl Into<String>) -> Self {
        problem(message, hint).into()
    }

    /// The models could not finish.
    pub(crate) fn computation(message: impl Into<String>) -> Self {
        Problem::new(ProblemKind::Computation, message).into()
    }

    /// Standard output cannot be written.
    pub(crate) fn output(error: &std::io::Error) -> Self {
        if error.kind() == std::io::ErrorKind::BrokenPipe {
            return Self::BrokenPipe;
        }
        Problem::new(ProblemKind::Io, format!("cannot write the output: {error}"))
            .hint("is the disk full, or the output closed?")
            .into()
    }
}

/// What is wrong with an argument, and what to do about it.
pub(crate) fn problem(message: impl Into<String>, hint: impl Into<String>) -> Problem {
    Problem::new(ProblemKind::Value, message).hint(hint)
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        Self::Problems(vec![problem])
    }
}

impl From<Problems> for Failure {
    fn from(error: Problems) -> Self {
        Self::Problems(error.problems)
    }
}

/// What clap found wrong with the arguments, as one message and one hint.
///
/// clap prints the message, then `tip:` lines, a usage line and a pointer to `--help`, apart by
/// blank lines.
pub(crate) fn usage(error: &clap::Error) -> Failure {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return Failure::usage("a command is missing", "--help lists the commands");
    }
    let text = error.render().to_string();
    let mut paragraphs = text.split("\n\n").map(|paragraph| {
        paragraph.lines().map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
    });
    let message = paragraphs.next().unwrap_or_default();
    let message = message.strip_prefix("error: ").unwrap_or(&message).to_owned();
    let rest: Vec<String> = paragraphs.collect();
    // "to pass '-1' as a value, use '-- -1'" is true of no flag of ours.
    let tip =
        rest.iter().find_map(|paragraph| paragraph.strip_prefix("tip: ")).filter(|tip| !tip.starts_with("to pass "));
    let usage = rest.iter().find_map(|paragraph| paragraph.strip_prefix("Usage: "));
    let hint = match (tip, usage) {
        (Some(tip), _) => tip.replace(" tip: ", "; "),
        (None, Some(usage)) => format!("usage: {usage}; --help says more"),
        (None, None) => "--help says more".to_owned(),
    };
    Failure::usage(message, hint)
}
