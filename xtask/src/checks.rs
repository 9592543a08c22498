//! `cargo xtask test`: all checks but for what takes long, and a table of what they found. With
//! `--all`, the rest as well.
//!
//! Compilers use the whole processor; a browser, Python and Node mostly wait, and use one core.
//! Therefore two rows of checks run at the same time. Every check is a program of its own, whose
//! output is collected and printed when the check ends.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Command, ExitStatus};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

use crate::python::{self, Trouble};
use crate::{arrows, documents, licences, page, risk_tools, source, toolchain, validate_shock};

/// The exit status of a check that cannot run here. The last line of its output is the reason.
const NOT_RUN: u8 = 3;

/// The longest that a check may take. What hangs is stopped before whatever waits for all of them
/// gives up, and its output says where it was. The slowest check takes a third of it.
const LIMIT: Duration = Duration::from_secs(45 * 60);

/// What may be left out even under `CI`, and why: a part of the reason that a check or a test gives.
/// Anything else that is left out there counts as failed, because nobody would notice.
const OPTIONAL: [(&str, &str); 9] = [
    (
        "`cargo install cargo-deny`",
        "a tool that takes minutes to build",
    ),
    ("$FREESTAND_SHARED", "records that are not ours to publish"),
    (
        "`cargo xtask validate-shock`",
        "fetches its tools on demand",
    ),
    ("`cargo xtask risk-tools`", "fetches its tools on demand"),
    (
        "this processor has no",
        "vector units that not every processor has",
    ),
    ("the vector units of x86-64", "other processors"),
    ("could not import 'tomllib'", "not in Python 3.10"),
    ("looks for processes in /proc", "Linux alone has it"),
    (
        "hanging up is ignored",
        "what `nohup` starts cannot be hung up",
    ),
];

/// What the names of tests have in common that are run by hand, after a change of what they try: they
/// take tens of minutes and print figures.
const CAMPAIGN: &str = "campaign_of";

/// All packages that have tests. The benchmarks have none, and would request other features of
/// shared dependencies, so that the Python package could not share them.
pub const TESTED: [&str; 4] = ["--workspace", "--exclude", "freestand-benches", "--locked"];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Check {
    Arrows,
    Toolchain,
    Features,
    Formatting,
    Lints,
    Compiling,
    Tests,
    Examples,
    Documentation,
    PageBuilt,
    PageTypes,
    PageBrowsed,
    Python,
    Shock,
    RiskTools,
    Licences,
}

/// Two rows that run side by side. The first part of the first row compiles the program; the second
/// part of each row needs it.
const ROWS: [[&[Check]; 2]; 2] = [
    [
        &[
            Check::Arrows,
            Check::Toolchain,
            Check::Features,
            Check::Lints,
            Check::Compiling,
        ],
        &[Check::Tests, Check::Examples, Check::Documentation],
    ],
    [
        &[Check::Formatting, Check::PageBuilt],
        &[
            Check::PageBrowsed,
            Check::Python,
            Check::PageTypes,
            Check::Shock,
            Check::RiskTools,
            Check::Licences,
        ],
    ],
];

/// Writes what follows from the structs of the requests: their tests compare it.
pub fn generate(root: &Path) -> Result<bool, String> {
    let tests = ["--test", "all", "--", "requests", "schemas"];
    let status = Command::new("cargo")
        .args([&["test", "--quiet"], &TESTED[..], &tests].concat())
        .env("FREESTAND_WRITE", "1")
        .current_dir(root)
        .status()
        .map_err(|error| format!("cannot run cargo: {error}"))?;
    Ok(status.success())
}

/// How much is checked, and how strictly.
#[derive(Debug, Clone, Copy)]
pub struct Extent {
    /// Also what takes long.
    pub all: bool,
    /// What is skipped has failed, unless it is optional.
    pub strict: bool,
}

/// The result of a check.
#[derive(Debug, PartialEq)]
enum Outcome {
    Passed,
    Failed,
    Skipped(String),
}

impl Outcome {
    fn word(&self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Failed => "FAILED",
            Self::Skipped(_) => "skipped",
        }
    }
}

struct Row {
    title: &'static str,
    outcome: Outcome,
    seconds: f64,
    left_out: LeftOut,
}

impl Check {
    pub const ALL: [Self; 16] = [
        Self::Arrows,
        Self::Toolchain,
        Self::Features,
        Self::Formatting,
        Self::Lints,
        Self::Compiling,
        Self::Tests,
        Self::Examples,
        Self::Documentation,
        Self::PageBuilt,
        Self::PageTypes,
        Self::PageBrowsed,
        Self::Python,
        Self::Shock,
        Self::RiskTools,
        Self::Licences,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arrows => "arrows",
            Self::Toolchain => "toolchain",
            Self::Features => "features",
            Self::Formatting => "formatting",
            Self::Lints => "lints",
            Self::Compiling => "compiling",
            Self::Tests => "tests",
            Self::Examples => "examples",
            Self::Documentation => "documentation",
            Self::PageBuilt => "page-built",
            Self::PageTypes => "page-types",
            Self::PageBrowsed => "page-browsed",
            Self::Python => "python",
            Self::Shock => "shock",
            Self::RiskTools => "risk-tools",
            Self::Licences => "licences",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Arrows => "arrows between crates and modules",
            Self::Toolchain => "the version of Rust",
            Self::Features => "tests and Python package share dependencies",
            Self::Formatting => "formatting",
            Self::Lints => "lints, benchmarks included",
            Self::Compiling => "the program and the tests compile",
            Self::Tests => "tests",
            Self::Examples => "examples in the documentation",
            Self::Documentation => "documentation",
            Self::PageBuilt => "the built page matches its sources",
            Self::PageTypes => "the page: types and units",
            Self::PageBrowsed => "the page in a browser",
            Self::Python => "Python package",
            Self::Shock => "shock response spectra compared with public packages",
            Self::RiskTools => "exported fragilities in pelicun and OpenQuake",
            Self::Licences => "licences and sources of dependencies",
        }
    }

    /// The command that runs it: cargo or this program.
    fn command(self, root: &Path, all: bool) -> Result<Command, String> {
        let cargo = |arguments: &[&str]| {
            let mut command = Command::new("cargo");
            command.args(arguments).current_dir(root);
            command
        };
        let tested = |kind, more: &[&str]| {
            cargo(
                &[
                    &["test", kind, "--no-fail-fast"],
                    &TESTED[..],
                    &["--"],
                    more,
                ]
                .concat(),
            )
        };
        Ok(match self {
            Self::Formatting => cargo(&["fmt", "--all", "--check"]),
            Self::Lints => cargo(&[
                "clippy",
                "--workspace",
                "--all-targets",
                "--locked",
                "--quiet",
                "--",
                "-D",
                "warnings",
            ]),
            // `--tests` leaves out what has `test = false`, and examples, which the lints compile.
            Self::Compiling => {
                cargo(&[&["test", "--tests", "--quiet", "--no-run"], &TESTED[..]].concat())
            }
            Self::Tests if all => tested(
                "--tests",
                &["--show-output", "--include-ignored", "--skip", CAMPAIGN],
            ),
            Self::Tests => tested("--tests", &["--show-output"]),
            // With their output, each would be compiled alone.
            Self::Examples => tested("--doc", &[]),
            Self::Arrows
            | Self::Toolchain
            | Self::Documentation
            | Self::Features
            | Self::PageBuilt
            | Self::PageTypes
            | Self::PageBrowsed
            | Self::Python
            | Self::Shock
            | Self::RiskTools
            | Self::Licences => {
                let program = std::env::current_exe()
                    .map_err(|error| format!("cannot find xtask: {error}"))?;
                let mut command = Command::new(program);
                command.args(["check", self.name()]).current_dir(root);
                if all {
                    command.arg("--all");
                }
                command
            }
        })
    }

    /// Runs it and prints its findings, for `cargo xtask check NAME`. Returns the exit status.
    pub fn run(self, root: &Path, all: bool) -> u8 {
        match self.done(root, all) {
            Ok(()) => 0,
            Err(Problem::Wrong(problem)) => {
                eprintln!("{problem}");
                1
            }
            Err(Problem::NotHere(why)) => {
                println!("{why}");
                NOT_RUN
            }
        }
    }

    fn done(self, root: &Path, all: bool) -> Result<(), Problem> {
        let not_here = |why: Option<String>| {
            why.map_or(Ok(()), |why| {
                Err(Problem::NotHere(format!("not run: {why}")))
            })
        };
        match self {
            Self::Formatting | Self::Lints | Self::Compiling | Self::Tests | Self::Examples => {
                let status = self
                    .command(root, all)?
                    .status()
                    .map_err(|error| format!("cannot run cargo: {error}"))?;
                return if status.success() {
                    Ok(())
                } else {
                    Err(Problem::Wrong(status.to_string()))
                };
            }
            Self::Arrows => arrows(root)?,
            Self::Toolchain => {
                toolchain::check(root)?;
                not_here(toolchain::differs(root)?)?;
            }
            Self::Documentation => {
                documents::check(root)?;
                let status = Command::new("cargo")
                    .args(["doc", "--workspace", "--locked", "--no-deps", "--quiet"])
                    .env("RUSTDOCFLAGS", "-D warnings")
                    .current_dir(root)
                    .status()
                    .map_err(|error| format!("cannot run cargo: {error}"))?;
                if !status.success() {
                    return Err(Problem::Wrong(status.to_string()));
                }
            }
            Self::Features => features(root)?,
            Self::PageBuilt => {
                not_here(page::missing_node())?;
                page::compare(root)?;
            }
            Self::PageTypes => {
                not_here(page::missing_node())?;
                page::check(root)?;
            }
            Self::PageBrowsed => {
                not_here(page::missing_node().or_else(page::missing_browser))?;
                page::browse(root, all)?;
            }
            Self::Python => match python::test(root, all) {
                Ok(()) => {}
                Err(Trouble::NotHere(why)) => not_here(Some(format!("it needs {why}")))?,
                Err(Trouble::Wrong(problem)) => return Err(Problem::Wrong(problem)),
            },
            Self::Shock if !validate_shock::is_installed(root) => {
                not_here(Some(
                    "`cargo xtask validate-shock` fetches pyyeti and endaq and compares".to_owned(),
                ))?;
            }
            Self::Shock => validate_shock::compare(root)?,
            Self::RiskTools if !risk_tools::is_installed(root) => {
                not_here(Some("`cargo xtask risk-tools` fetches them".to_owned()))?;
            }
            Self::RiskTools => risk_tools::compare(root)?,
            Self::Licences => {
                not_here(licences::missing())?;
                licences::check(root)?;
            }
        }
        Ok(())
    }
}

/// Why a check did not pass.
enum Problem {
    NotHere(String),
    Wrong(String),
}

impl From<String> for Problem {
    fn from(problem: String) -> Self {
        Self::Wrong(problem)
    }
}

/// Runs every check, also after one that fails, and prints the table.
pub fn all(root: &Path, extent: Extent) -> bool {
    let start = Instant::now();
    let [[compiling, tests], [others, other_tests]] = ROWS;
    let (compiled, is_compiled) = mpsc::channel::<()>();
    let rows = std::thread::scope(|scope| {
        let other = scope.spawn(move || {
            let mut rows = in_a_row(others, root, extent);
            // Nothing is sent: it ends when the sender is dropped.
            let _ = is_compiled.recv();
            rows.extend(in_a_row(other_tests, root, extent));
            rows
        });
        let mut rows = in_a_row(compiling, root, extent);
        drop(compiled);
        rows.extend(in_a_row(tests, root, extent));
        match other.join() {
            Ok(found) => rows.extend(found),
            Err(panic) => std::panic::resume_unwind(panic),
        }
        rows
    });
    print!("\n{}", table(&rows, start.elapsed().as_secs_f64()));
    rows.iter()
        .all(|row| !matches!(row.outcome, Outcome::Failed))
}

/// Runs one check after the other. The output of each is printed when it ends.
fn in_a_row(checks: &[Check], root: &Path, extent: Extent) -> Vec<Row> {
    let run = |check: &Check| {
        println!("== begun: {} ==", check.title());
        let start = Instant::now();
        let mut text = String::new();
        let mut left_out = LeftOut::default();
        let ended = check.command(root, extent.all).and_then(|command| {
            printed(command, LIMIT, |line| {
                let is_shown = if matches!(check, Check::Tests | Check::Examples) {
                    left_out.test_shows(line.trim_end())
                } else {
                    left_out.read(line.trim_end(), check.title());
                    true
                };
                if is_shown {
                    text.push_str(line);
                }
            })
        });
        let mut outcome = match ended {
            Ok(status) if status.success() => Outcome::Passed,
            Ok(status) if status.code() == Some(NOT_RUN.into()) => {
                Outcome::Skipped(text.lines().last().unwrap_or_default().to_owned())
            }
            Ok(status) => {
                text.push_str(&format!("== failed: {status} ==\n"));
                Outcome::Failed
            }
            Err(problem) => {
                text.push_str(&format!("== failed: {problem} ==\n"));
                Outcome::Failed
            }
        };
        let missing = missing(&outcome, &left_out);
        if extent.strict && !missing.is_empty() {
            text.push_str(&format!(
                "== failed: skipped where nothing may be: {} ==\n",
                missing.join("; ")
            ));
            outcome = Outcome::Failed;
        }
        let row = Row {
            title: check.title(),
            outcome,
            seconds: start.elapsed().as_secs_f64(),
            left_out,
        };
        // In one piece, so that a check that runs at the same time does not print between the
        // lines.
        print!(
            "\n== {}: {}, {:.0} s ==\n{text}",
            row.title,
            row.outcome.word(),
            row.seconds
        );
        row
    };
    checks.iter().map(run).collect()
}

/// The reasons for what was skipped and is not optional.
fn missing<'a>(outcome: &'a Outcome, left_out: &'a LeftOut) -> Vec<&'a str> {
    let check = match outcome {
        Outcome::Skipped(why) => Some(why),
        Outcome::Passed | Outcome::Failed => None,
    };
    let is_optional = |why: &str| OPTIONAL.iter().any(|(part, _)| why.contains(part));
    let reasons = check.into_iter().chain(left_out.skipped.keys());
    reasons
        .map(String::as_str)
        .filter(|why| !is_optional(why))
        .collect()
}

/// Runs a command and passes its lines on, those of standard output and standard error in the order
/// in which they came. A command that has not ended at the limit is killed.
fn printed(
    mut command: Command,
    limit: Duration,
    mut line: impl FnMut(&str),
) -> Result<ExitStatus, String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let cannot = |error: std::io::Error| format!("cannot run {program}: {error}");
    let (output, input) = std::io::pipe().map_err(cannot)?;
    let error = input.try_clone().map_err(cannot)?;
    let mut child = command
        .stdout(input)
        .stderr(error)
        .spawn()
        .map_err(cannot)?;
    // The command holds ends of the pipe. Unless they are closed, the lines do not end when the
    // child ends.
    drop(command);
    let (lines, came) = mpsc::channel();
    std::thread::spawn(move || {
        BufReader::new(output)
            .split(b'\n')
            .try_for_each(|bytes| lines.send(bytes))
    });
    let end = Instant::now() + limit;
    loop {
        match came.recv_timeout(end.saturating_duration_since(Instant::now())) {
            Ok(bytes) => line(&format!(
                "{}\n",
                String::from_utf8_lossy(&bytes.map_err(|error| error.to_string())?)
            )),
            Err(RecvTimeoutError::Disconnected) => {
                return child.wait().map_err(|error| error.to_string());
            }
            Err(RecvTimeoutError::Timeout) => {
                // What the command started goes on, but nobody waits for it.
                child.kill().and_then(|()| child.wait()).map_err(cannot)?;
                return Err(format!(
                    "not ended after {} minutes, and stopped",
                    limit.as_secs() / 60
                ));
            }
        }
    }
}

pub fn arrows(root: &Path) -> Result<(), String> {
    let files = source::read(root, "crates", arrows::wanted)?;
    // Whoever reads the wrong folder finds nothing wrong in it.
    if files.len() <= 300 {
        return Err(format!("only {} files were read", files.len()));
    }
    let (shares, problems) = arrows::check(&files)?;
    println!("{}", shares.join("\n"));
    if problems.is_empty() {
        Ok(())
    } else {
        Err(problems.join("\n"))
    }
}

/// Checks that the Python package requests the same features of every dependency as the tests. If
/// one differs, everything that depends on it is compiled twice, which is most of the workspace.
fn features(root: &Path) -> Result<(), String> {
    let tested = packages(root, &[&TESTED[..], &["-e", "normal,build,dev"]].concat())?;
    let ours = packages(
        root,
        &[
            "--locked",
            "--package",
            "freestand-py",
            "-e",
            "normal,build",
        ],
    )?;
    let others: Vec<&str> = ours.difference(&tested).map(String::as_str).collect();
    if others.is_empty() {
        return Ok(());
    }
    let hint = "the tests use these packages with other features: request the same ones in a manifest (`cargo tree -e \
                features -i NAME` says which package requests a feature)";
    Err(format!(
        "dependencies of the Python package that the tests do not share: {}\n{hint}",
        others.join(", ")
    ))
}

/// The packages that `cargo tree` lists, with versions and features.
fn packages(root: &Path, selected: &[&str]) -> Result<BTreeSet<String>, String> {
    let output = Command::new("cargo")
        .args([
            "tree",
            "--prefix",
            "none",
            "--no-dedupe",
            "--format",
            "{p} {f}",
        ])
        .args(selected)
        .current_dir(root)
        .output()
        .map_err(|error| format!("cannot run cargo: {error}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(String::from_utf8_lossy(&output.stdout)
        .lines()
        .map(str::to_owned)
        .collect())
}

/// What was left out: reasons, and the tests or checks that gave them.
#[derive(Default)]
struct LeftOut {
    /// What cannot run here says so in a line `skipped: REASON`.
    skipped: BTreeMap<String, Vec<String>>,
    /// What takes long: tests that are marked `#[ignore = "REASON"]`, and parts of other checks,
    /// which say so in a line `left out: PART`.
    long: BTreeMap<String, Vec<String>>,
    part: Part,
    /// The test whose output is being read.
    test: String,
}

/// Parts of what the test harness prints.
#[derive(Default, PartialEq)]
enum Part {
    /// A line for each test, and totals.
    #[default]
    Results,
    /// The output of tests that passed.
    Successes,
    /// The output of tests that failed.
    Failures,
}

impl LeftOut {
    /// Takes a line of a test or of a check in. `SKIPPED [1] FILE:LINE: REASON` is what pytest says.
    fn read(&mut self, line: &str, whose: &str) {
        let pytest = || Some(line.strip_prefix("SKIPPED [")?.split_once("] ")?.1);
        if let Some(why) = line.strip_prefix("skipped: ").or_else(pytest) {
            add(&mut self.skipped, why, whose);
        } else if let Some(part) = line.strip_prefix("left out: ") {
            add(&mut self.long, whose, part);
        }
    }

    /// Takes a line of the test harness in; whether it is for people, who want to see failures and
    /// totals.
    fn test_shows(&mut self, line: &str) -> bool {
        match line {
            "successes:" => self.part = Part::Successes,
            "failures:" => self.part = Part::Failures,
            _ if line.starts_with("test result: ") => self.part = Part::Results,
            _ => {}
        }
        match self.part {
            Part::Failures => true,
            Part::Successes => {
                if let Some(name) = line
                    .strip_prefix("---- ")
                    .and_then(|line| line.strip_suffix(" stdout ----"))
                {
                    name.clone_into(&mut self.test);
                } else {
                    self.read(line, &self.test.clone());
                }
                false
            }
            Part::Results => {
                let ignored = line
                    .strip_prefix("test ")
                    .and_then(|line| line.split_once(" ... ignored"));
                if let Some((test, reason)) = ignored {
                    let reason = reason.strip_prefix(", ").unwrap_or("no reason given");
                    // Campaigns are no part of any run.
                    if !test.contains(CAMPAIGN) {
                        add(&mut self.long, reason, test);
                    }
                }
                ignored.is_none()
                    && !line.is_empty()
                    && !line.starts_with("running ")
                    && !line.ends_with(" ... ok")
            }
        }
    }
}

fn add(to: &mut BTreeMap<String, Vec<String>>, why: &str, what: &str) {
    to.entry(why.to_owned()).or_default().push(what.to_owned());
}

/// The table at the end of a run.
fn table(rows: &[Row], all_s: f64) -> String {
    let width = rows.iter().map(|row| row.title.len()).max().unwrap_or(0);
    let mut text = format!("{:<width$}  {:<7}  seconds\n", "check", "result");
    for Row {
        title,
        outcome,
        seconds,
        ..
    } in rows
    {
        text.push_str(&format!(
            "{title:<width$}  {:<7}  {seconds:>7.1}\n",
            outcome.word()
        ));
    }
    text.push_str(&format!(
        "{:<width$}  {:<7}  {all_s:>7.1}\n",
        "total, two checks at a time", ""
    ));

    let skipped_checks = rows.iter().filter_map(|row| match &row.outcome {
        Outcome::Skipped(why) => Some(format!("  {}: {why}\n", row.title)),
        _ => None,
    });
    let listed = |of: fn(&LeftOut) -> &BTreeMap<String, Vec<String>>| -> Vec<String> {
        rows.iter()
            .flat_map(|row| of(&row.left_out))
            .map(|(why, what)| format!("  {why}\n    {}\n", what.join("\n    ")))
            .collect()
    };
    for (title, lines) in [
        ("skipped checks", skipped_checks.collect()),
        ("skipped by tests", listed(|left_out| &left_out.skipped)),
        ("long", listed(|left_out| &left_out.long)),
    ] {
        let lines: Vec<String> = lines;
        text.push_str(&if lines.is_empty() {
            format!("\n{title}: none\n")
        } else {
            format!("\n{title}:\n{}", lines.concat())
        });
    }
    let long: usize = rows
        .iter()
        .flat_map(|row| row.left_out.long.values())
        .map(Vec::len)
        .sum();
    if long > 0 {
        text.push_str(&format!(
            "\nleft out: {long} long tests and parts of checks; `cargo xtask test --all` runs them\n"
        ));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both outputs of a command are read, up to a last line without a line end, and its status.
    #[cfg(unix)]
    #[test]
    fn a_command_is_read_to_its_end() {
        let mut command = Command::new("sh");
        command.args(["-c", "echo one; echo two >&2; printf three; exit 3"]);
        let mut text = String::new();
        let status = printed(command, LIMIT, |line| text.push_str(line)).unwrap();
        assert_eq!(
            (text.as_str(), status.code()),
            ("one\ntwo\nthree\n", Some(NOT_RUN.into()))
        );
        assert!(
            printed(Command::new("no-such-program"), LIMIT, |_| {})
                .unwrap_err()
                .contains("no-such-program")
        );
    }

    /// What hangs is stopped, and what it printed before is kept.
    #[cfg(unix)]
    #[test]
    fn a_command_that_hangs_is_stopped() {
        let mut command = Command::new("sh");
        command.args(["-c", "echo one; exec sleep 3600"]);
        let mut text = String::new();
        let problem =
            printed(command, Duration::from_secs(1), |line| text.push_str(line)).unwrap_err();
        assert_eq!(
            (text.as_str(), problem.as_str()),
            ("one\n", "not ended after 0 minutes, and stopped")
        );
    }

    /// Each check runs once, in one of the rows.
    #[test]
    fn every_check_has_its_place() {
        let mut placed: Vec<Check> = ROWS.into_iter().flatten().flatten().copied().collect();
        placed.sort_by_key(|check| check.name());
        let mut all = Check::ALL.to_vec();
        all.sort_by_key(|check| check.name());
        assert_eq!(placed, all);
    }

    /// What `cargo test -- --show-output` prints, line by line.
    const OUTPUT: &str = "\nrunning 4 tests\ntest a::passes ... ok\ntest a::slow ... ignored, minutes\ntest b ... ignored\n\
        test a::fails ... FAILED\n\nsuccesses:\n\n---- a::passes stdout ----\nnoise\nskipped: no records in ../shared\n\n\n\
        successes:\n    a::passes\n\nfailures:\n\n---- a::fails stdout ----\nskipped: part of a failure\n\n\
        failures:\n    a::fails\n\ntest result: FAILED. 1 passed; 1 failed; 2 ignored\n";

    fn left_out(output: &str) -> LeftOut {
        let mut left_out = LeftOut::default();
        output
            .lines()
            .for_each(|line| _ = left_out.test_shows(line));
        left_out
    }

    #[test]
    fn failures_are_shown_and_what_was_left_out_is_kept() {
        let mut tests = LeftOut::default();
        let shown: Vec<&str> = OUTPUT
            .lines()
            .filter(|line| tests.test_shows(line))
            .collect();
        assert_eq!(
            shown,
            [
                "test a::fails ... FAILED",
                "failures:",
                "",
                "---- a::fails stdout ----",
                "skipped: part of a failure",
                "",
                "failures:",
                "    a::fails",
                "",
                "test result: FAILED. 1 passed; 1 failed; 2 ignored"
            ]
        );
        let one = |why: &str, test: &str| (why.to_owned(), vec![test.to_owned()]);
        assert_eq!(
            tests.skipped,
            BTreeMap::from([one("no records in ../shared", "a::passes")])
        );
        assert_eq!(
            tests.long,
            BTreeMap::from([one("minutes", "a::slow"), one("no reason given", "b")])
        );
    }

    /// What other checks say of their parts.
    #[test]
    fn a_check_says_what_it_left_out() {
        let mut check = LeftOut::default();
        for line in [
            "ok: a story",
            "skipped: the notebooks",
            "SKIPPED [1] tests/test_dask.py:19: no Dask",
            "left out: phone, dark",
        ] {
            check.read(line, "Python");
        }
        let whys: Vec<&str> = check.skipped.keys().map(String::as_str).collect();
        assert_eq!(whys, ["tests/test_dask.py:19: no Dask", "the notebooks"]);
        assert_eq!(check.long["Python"], ["phone, dark"]);
    }

    /// In CI a check or a test that is skipped has failed, unless it is optional; what takes long
    /// is left out on purpose.
    #[test]
    fn what_is_skipped_and_not_optional_is_missing() {
        let skipped = |why: &str| Outcome::Skipped(why.to_owned());
        let nothing = LeftOut::default();
        let node = skipped("not run: Node is not installed");
        assert_eq!(missing(&node, &nothing), ["not run: Node is not installed"]);
        let shock = skipped("not run: `cargo xtask validate-shock` fetches pyyeti and endaq");
        assert!(missing(&shock, &nothing).is_empty());
        let tests = left_out(OUTPUT);
        assert_eq!(
            missing(&Outcome::Passed, &tests),
            ["no records in ../shared"]
        );
        let records = OUTPUT.replace("../shared", "$FREESTAND_SHARED/records (../shared)");
        assert!(missing(&Outcome::Passed, &left_out(&records)).is_empty());
    }

    #[test]
    fn the_table_names_every_check_and_what_was_left_out() {
        let row = |title, outcome, left_out| Row {
            title,
            outcome,
            seconds: 1.25,
            left_out,
        };
        let rows = |tests| {
            [
                row("lints", Outcome::Passed, LeftOut::default()),
                row("tests", Outcome::Failed, tests),
                row(
                    "spectra",
                    Outcome::Skipped("not here".to_owned()),
                    LeftOut::default(),
                ),
            ]
        };
        let text = table(&rows(LeftOut::default()), 2.5);
        assert!(
            text.contains(
                "lints    passed       1.2\ntests    FAILED       1.2\nspectra  skipped      1.2\n"
            ),
            "{text}"
        );
        assert!(text.contains("  spectra: not here\n"), "{text}");
        assert!(
            text.ends_with("skipped by tests: none\n\nlong: none\n"),
            "{text}"
        );
        let text = table(&rows(left_out(OUTPUT)), 2.5);
        assert!(
            text.ends_with(
                "\nlong:\n  minutes\n    a::slow\n  no reason given\n    b\n\n\
                 left out: 2 long tests and parts of checks; `cargo xtask test --all` runs them\n"
            ),
            "{text}"
        );
    }
}
