//! What the user sees: one JSON document or a table on standard output, everything else on standard
//! error.

use std::io::{self, IsTerminal, Write};
use std::sync::Arc;

use freestand_input::keys::KeyStyle;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::toml_reader::one_line;
pub(crate) use freestand_input::words::significant;
use freestand_output::json::document;
use freestand_study::recorded::Failed;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use crate::args::GlobalArgs;
use crate::failure::Failure;
use crate::session::Session;
use crate::stop::Stop;

/// Prints the result of a command, or keeps it for who asked for the command in another way than on
/// the command line.
#[derive(Debug, Clone)]
pub(crate) struct Printer {
    json: bool,
    quiet: bool,
    verbose: bool,
    session: Option<Arc<Session>>,
}

impl Printer {
    pub(crate) fn new(global: &GlobalArgs) -> Self {
        Self {
            json: global.json,
            quiet: global.quiet,
            verbose: global.verbose,
            session: None,
        }
    }

    /// For a command whose document is kept in `session`.
    #[cfg(feature = "page")]
    pub(crate) fn keeping(session: Arc<Session>) -> Self {
        Self {
            json: true,
            quiet: true,
            verbose: false,
            session: Some(session),
        }
    }

    /// Prints a text, or keeps it.
    pub(crate) fn print(&self, text: &str) -> Result<(), Failure> {
        self.print_bytes(text.as_bytes())
    }

    /// Prints UTF-8, or keeps it.
    pub(crate) fn print_bytes(&self, bytes: &[u8]) -> Result<(), Failure> {
        match &self.session {
            None => print_bytes(bytes),
            Some(session) => {
                session.keep(bytes);
                Ok(())
            }
        }
    }

    /// Whether the user wants to stop the command.
    pub(crate) fn stop(&self) -> Stop {
        self.session
            .as_ref()
            .map_or_else(Stop::listen, |session| session.stop.clone())
    }

    /// Who asked for the command, if it was not the command line.
    pub(crate) fn session(&self) -> Option<&Session> {
        self.session.as_deref()
    }

    /// Prints the result, as JSON (`body` with `schema` and `warnings`) or as text, and then the
    /// warnings.
    pub(crate) fn result<T: Serialize>(
        &self,
        schema: &str,
        body: &T,
        warnings: &[String],
        text: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        if self.json {
            self.print(&document(schema, body, warnings)?)?;
        } else {
            self.print(&text())?;
        }
        self.warn(warnings);
        Ok(())
    }

    /// Whether the result is printed as one JSON document.
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    /// Prints the warnings, one line for each.
    pub(crate) fn warn(&self, warnings: &[String]) {
        if !self.quiet {
            for warning in warnings {
                error_line(&format!("warning: {}", KeyStyle::Flag.shown(warning)));
            }
        }
    }

    /// Prints what the user should know besides the result, unless `--quiet` is given.
    pub(crate) fn note(&self, text: &str) {
        if !self.quiet {
            error_line(text);
        }
    }

    /// Prints the problems of a list on standard error, one line for each.
    pub(crate) fn said(&self, lines: &[String]) {
        if !self.quiet {
            for line in lines {
                error_line(&one_line(&KeyStyle::Flag.shown(line)));
            }
        }
    }

    /// Prints the problems of the files that failed; where the document is kept, it names them.
    pub(crate) fn failed(&self, failed: &[Failed]) {
        if self.session.is_none() {
            failed.iter().for_each(|one| print_problem(&one.problem));
        }
    }

    /// Prints a detail if `-v` is given.
    pub(crate) fn detail(&self, text: &str) {
        if self.verbose {
            error_line(text);
        }
    }

    /// A progress bar on standard error. It is hidden if no terminal shows it, or if rows that are
    /// `printed` to the same terminal would break it up.
    pub(crate) fn progress_bar(&self, printed: bool) -> ProgressBar {
        self.bar(printed, "{msg:20} [{bar:40}] {pos}/{len} {eta}")
    }

    /// The same for work that tells the share of its effort: its message has the numbers.
    pub(crate) fn effort_bar(&self) -> ProgressBar {
        self.bar(false, "[{bar:40}] {msg}")
    }

    fn bar(&self, printed: bool, template: &str) -> ProgressBar {
        if self.quiet || !io::stderr().is_terminal() || (printed && io::stdout().is_terminal()) {
            return ProgressBar::hidden();
        }
        let style = ProgressStyle::with_template(template);
        ProgressBar::new(0).with_style(
            style
                .unwrap_or_else(|_| ProgressStyle::default_bar())
                .progress_chars("=> "),
        )
    }
}

/// Writes a text to standard output and flushes it.
pub(crate) fn print_text(text: &str) -> Result<(), Failure> {
    print_bytes(text.as_bytes())
}

/// Writes UTF-8 to standard output and flushes it.
fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)
        .and_then(|()| out.flush())
        .map_err(|error| Failure::output(&error))
}

/// Writes a line to standard error. If that is closed, the failure cannot be reported anywhere.
fn error_line(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Prints each problem as an `error:` line and a `hint:` line.
pub(crate) fn print_failure(failure: &Failure) {
    let Failure::Problems(problems) = failure else {
        return;
    };
    problems.iter().for_each(print_problem);
}

fn print_problem(problem: &Problem) {
    error_line(&format!(
        "error: {}",
        one_line(&KeyStyle::Flag.shown(&problem.to_string()))
    ));
    error_line(&format!(
        "hint: {}",
        one_line(&KeyStyle::Flag.shown(hint_of(problem)))
    ));
}

/// What to do about a problem.
pub(crate) fn hint_of(problem: &Problem) -> &str {
    problem.hint.as_deref().unwrap_or(match problem.kind {
        ProblemKind::Io => "check the path and its permissions",
        ProblemKind::Format => "check that the file is complete and of a supported format",
        ProblemKind::Value | ProblemKind::Missing => "--help shows what is accepted",
        ProblemKind::Computation => "check that the input is physically possible",
        ProblemKind::Stopped => "run it again",
    })
}
