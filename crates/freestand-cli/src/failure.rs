//! Why a command could not run: its problems, each with a remedy.

use clap::error::ErrorKind;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_output::figure::FigureError;

/// Ends a command with status 2 (130 if it was stopped), or silently if the output was closed.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The problems; never empty.
    Problems(Vec<Problem>),
    /// The user stopped it; `printed` tells whether part of the result was already printed.
    Stopped { printed: bool },
    /// The user stopped it after the finished part was written.
    StoppedAfterWriting,
    /// The user stopped the runs of an inventory; the finished runs are kept.
    StoppedKeepingRuns,
    /// The user stopped a shard, of which the finished parts are kept.
    StoppedInShard,
    /// Standard output was closed by its reader.
    BrokenPipe,
}

impl Failure {
    /// A wrong argument.
    pub(crate) fn usage(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Problem::value(message, hint).into()
    }

    /// A calculation that failed.
    pub(crate) fn computation(message: impl Into<String>) -> Self {
        Problem::new(ProblemKind::Computation, message).into()
    }

    /// Standard output cannot be written.
    pub(crate) fn output(error: &std::io::Error) -> Self {
        if error.kind() == std::io::ErrorKind::BrokenPipe {
            return Self::BrokenPipe;
        }
        Problem::new(ProblemKind::Io, format!("cannot write the output: {error}"))
            .hint("check that the disk is not full and that the output is still open")
            .into()
    }
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        Self::Problems(vec![problem])
    }
}

impl From<FigureError> for Failure {
    fn from(error: FigureError) -> Self {
        Problem::from(error).into()
    }
}

impl From<Problems> for Failure {
    fn from(error: Problems) -> Self {
        Self::Problems(error.problems)
    }
}

/// Converts an error of clap to one message and one hint.
///
/// clap prints the message, then `tip:` lines, a usage line and a reference to `--help`, separated
/// by blank lines.
pub(crate) fn usage(error: &clap::Error) -> Failure {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return Failure::usage("a command is missing", "--help lists the commands");
    }
    let text = error.render().to_string();
    let mut paragraphs = text.split("\n\n").map(|paragraph| {
        paragraph
            .lines()
            .map(str::trim)
            .filter(|line| !line.is_empty())
            .collect::<Vec<_>>()
            .join(" ")
    });
    let message = paragraphs.next().unwrap_or_default();
    let message = message
        .strip_prefix("error: ")
        .unwrap_or(&message)
        .to_owned();
    let rest: Vec<String> = paragraphs.collect();
    // The tip "to pass '-1' as a value, use '-- -1'" is wrong for all our flags.
    let tip = rest
        .iter()
        .find_map(|paragraph| paragraph.strip_prefix("tip: "))
        .filter(|tip| !tip.starts_with("to pass "));
    let usage = rest
        .iter()
        .find_map(|paragraph| paragraph.strip_prefix("Usage: "));
    let hint = match (tip, usage) {
        (Some(tip), _) => tip.replace(" tip: ", "; "),
        (None, Some(usage)) => format!("usage: {usage}; see --help"),
        (None, None) => "see --help".to_owned(),
    };
    Failure::usage(message, hint)
}
