//! Why a command could not run: its problems, each with a remedy.

use clap::error::ErrorKind;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_output::figure::FigureError;

/// Ends a command with status 2 (130 if it was stopped), or silently if the output was closed.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The problems; never empty.
    Problems(Vec<Problem>),
    /// The user stopped it.
    Stopped(Left),
    /// Standard output was closed by its reader.
    BrokenPipe,
}

/// What is left of a command that the user stopped.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Left {
    /// Nothing.
    Nothing,
    /// What was printed before.
    Printed,
    /// The files of what was finished.
    Written,
    /// The finished runs of an inventory.
    Runs,
    /// The finished parts of a shard.
    Parts,
}

impl Left {
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Nothing => "nothing was written; the results of an earlier run are unchanged",
            Self::Printed => {
                "the printed output is incomplete; no file was written, and earlier results are unchanged"
            }
            Self::Written => {
                "what is known so far was written, and every world is kept; continue with --resume"
            }
            Self::Runs => "the finished runs are kept; continue with --resume",
            Self::Parts => {
                "the finished parts of the shard are kept; the same command continues it"
            }
        }
    }
}

impl Failure {
    /// A wrong argument.
    pub(crate) fn usage(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Problem::value(message, hint).into()
    }

    /// What it leaves, where the user stopped it.
    pub(crate) fn leaving(self, left: Left) -> Self {
        match self {
            Self::Stopped(_) => Self::Stopped(left),
            other => other,
        }
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
        Problems::from(problem).into()
    }
}

impl From<FigureError> for Failure {
    fn from(error: FigureError) -> Self {
        Problem::from(error).into()
    }
}

impl From<Problems> for Failure {
    fn from(error: Problems) -> Self {
        if error.is_stopped() {
            Self::Stopped(Left::Nothing)
        } else {
            Self::Problems(error.problems)
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A program that was stopped ends with 130, whatever it was doing.
    #[test]
    fn work_that_was_stopped_is_no_problem() {
        let stopped = Failure::from(Problem::stopped());
        assert!(matches!(stopped, Failure::Stopped(Left::Nothing)));
        let kept = stopped.leaving(Left::Runs);
        assert!(matches!(kept, Failure::Stopped(Left::Runs)));
        let wrong = Failure::usage("wrong", "right").leaving(Left::Runs);
        assert!(matches!(wrong, Failure::Problems(_)));
    }
}
