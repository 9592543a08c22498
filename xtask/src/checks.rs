//! `cargo xtask test`: the checks one after the other, and a table of what they found.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use crate::python::{self, Trouble};
use crate::{arrows, page, risk_tools, source, validate_shock};

/// What a check came to.
enum Outcome {
    Passed,
    Failed,
    Skipped(String),
}

struct Row {
    title: &'static str,
    outcome: Outcome,
    seconds: f64,
}

/// Runs every check, also after one that fails, and prints the table.
pub fn all(root: &Path) -> bool {
    let mut tests = Tests::default();
    let mut rows = Vec::new();
    let mut check = |title, run: &mut dyn FnMut() -> Outcome| {
        println!("\n== {title} ==");
        let start = Instant::now();
        let outcome = run();
        rows.push(Row { title, outcome, seconds: start.elapsed().as_secs_f64() });
    };
    // What takes seconds comes first.
    check("arrows between crates and modules", &mut || of(arrows(root)));
    check("formatting", &mut || of(cargo(root, &["fmt", "--all", "--check"], &[])));
    check("lints, benchmarks included", &mut || {
        of(cargo(root, &["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"], &[]))
    });
    check("tests", &mut || of(tests.run(root, &["--lib", "--bins", "--tests"])));
    check("examples in the documentation", &mut || of(tests.run(root, &["--doc"])));
    check("documentation", &mut || {
        of(cargo(root, &["doc", "--workspace", "--locked", "--no-deps"], &[("RUSTDOCFLAGS", "-D warnings")]))
    });
    check("the page is the one that its sources give", &mut || match page::missing_node() {
        Some(why) => Outcome::Skipped(format!("not compared: {why}")),
        None => of(page::compare(root)),
    });
    check("the page: types and units", &mut || match page::missing_node() {
        Some(why) => Outcome::Skipped(format!("not run: {why}")),
        None => of(page::check(root)),
    });
    check("the page in a browser", &mut || match page::missing_node().or_else(page::missing_browser) {
        Some(why) => Outcome::Skipped(format!("not run: {why}")),
        None => of(page::browse(root)),
    });
    // Its wheel has the program of the dev profile, which the tests have built.
    check("Python package", &mut || match python::test(root) {
        Ok(()) => Outcome::Passed,
        Err(Trouble::NotHere(why)) => Outcome::Skipped(format!("not run, it needs {why}")),
        Err(Trouble::Wrong(problem)) => of(Err(problem)),
    });
    check("shock response spectra beside public packages", &mut || {
        if !validate_shock::is_installed(root) {
            return Outcome::Skipped("`cargo xtask validate-shock` fetches pyyeti and endaq and compares".to_owned());
        }
        // The tests have just built the program. With other targets cargo would choose other features of dependencies
        // and build everything again.
        of(validate_shock::compare(root))
    });
    check("exported fragilities in pelicun and OpenQuake", &mut || {
        if !risk_tools::is_installed(root) {
            return Outcome::Skipped("not run, `cargo xtask risk-tools` fetches them".to_owned());
        }
        of(risk_tools::compare(root))
    });
    print!("\n{}", table(&rows, &tests));
    rows.iter().all(|row| !matches!(row.outcome, Outcome::Failed))
}

fn of(result: Result<(), String>) -> Outcome {
    match result {
        Ok(()) => Outcome::Passed,
        Err(problem) => {
            eprintln!("== failed: {problem} ==");
            Outcome::Failed
        }
    }
}

pub fn arrows(root: &Path) -> Result<(), String> {
    let files = source::read(root, "crates", arrows::wanted)?;
    let (shares, problems) = arrows::check(&files)?;
    println!("{}", shares.join("\n"));
    if problems.is_empty() { Ok(()) } else { Err(problems.join("\n")) }
}

fn cargo(root: &Path, arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), String> {
    let status = Command::new("cargo").args(arguments).envs(environment.iter().copied()).current_dir(root).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{status}: cargo {}", arguments.join(" "))),
        Err(error) => Err(format!("cannot run cargo: {error}")),
    }
}

/// What tests left out: reasons, and which tests gave them. A test says so in a line `skipped: …` on its standard output.
#[derive(Default)]
struct Tests {
    skipped: BTreeMap<String, Vec<String>>,
    ignored: BTreeMap<String, Vec<String>>,
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

impl Tests {
    fn run(&mut self, root: &Path, targets: &[&str]) -> Result<(), String> {
        let mut command = Command::new("cargo");
        // A test program of the Python extension would need the library of Python; its tests are in Python.
        command
            .args(["test", "--workspace", "--exclude", "freestand-py", "--locked", "--no-fail-fast"])
            .args(targets)
            .args(["--", "--show-output"]);
        let mut child = command
            .current_dir(root)
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("cannot run cargo: {error}"))?;
        let mut output = BufReader::new(child.stdout.take().ok_or("cargo test has no output")?);
        let mut bytes = Vec::new();
        while output.read_until(b'\n', &mut bytes).map_err(|error| format!("cargo test: {error}"))? > 0 {
            let line = String::from_utf8_lossy(&bytes);
            if self.shows(line.trim_end()) {
                print!("{line}");
            }
            bytes.clear();
        }
        match child.wait() {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => Err(format!("{status}: cargo test {}", targets.join(" "))),
            Err(error) => Err(format!("cargo test: {error}")),
        }
    }

    /// Takes a line of the test harness in; whether it is for people, who want to see failures and totals.
    fn shows(&mut self, line: &str) -> bool {
        match line {
            "successes:" => self.part = Part::Successes,
            "failures:" => self.part = Part::Failures,
            _ if line.starts_with("test result: ") => self.part = Part::Results,
            _ => {}
        }
        match self.part {
            Part::Failures => true,
            Part::Successes => {
                if let Some(name) = line.strip_prefix("---- ").and_then(|line| line.strip_suffix(" stdout ----")) {
                    name.clone_into(&mut self.test);
                } else if let Some(reason) = line.strip_prefix("skipped: ") {
                    self.skipped.entry(reason.to_owned()).or_default().push(self.test.clone());
                }
                false
            }
            Part::Results => {
                let ignored = line.strip_prefix("test ").and_then(|line| line.split_once(" ... ignored"));
                if let Some((test, reason)) = ignored {
                    let reason = reason.strip_prefix(", ").unwrap_or("no reason given");
                    self.ignored.entry(reason.to_owned()).or_default().push(test.to_owned());
                }
                ignored.is_none() && !line.is_empty() && !line.starts_with("running ") && !line.ends_with(" ... ok")
            }
        }
    }
}

/// What closes the run.
fn table(rows: &[Row], tests: &Tests) -> String {
    let width = rows.iter().map(|row| row.title.len()).max().unwrap_or(0);
    let mut text = format!("{:<width$}  {:<7}  seconds\n", "check", "result");
    for Row { title, outcome, seconds } in rows {
        let outcome = match outcome {
            Outcome::Passed => "passed",
            Outcome::Failed => "FAILED",
            Outcome::Skipped(_) => "skipped",
        };
        text.push_str(&format!("{title:<width$}  {outcome:<7}  {seconds:>7.1}\n"));
    }
    let seconds: f64 = rows.iter().map(|row| row.seconds).sum();
    text.push_str(&format!("{:<width$}  {:<7}  {seconds:>7.1}\n", "all", ""));

    let skipped_checks = rows.iter().filter_map(|row| match &row.outcome {
        Outcome::Skipped(why) => Some(format!("  {}: {why}\n", row.title)),
        _ => None,
    });
    let listed = |tests: &BTreeMap<String, Vec<String>>| -> Vec<String> {
        tests.iter().map(|(why, tests)| format!("  {why}\n    {}\n", tests.join("\n    "))).collect()
    };
    for (title, lines) in [
        ("skipped checks", skipped_checks.collect()),
        ("skipped by tests", listed(&tests.skipped)),
        ("ignored tests", listed(&tests.ignored)),
    ] {
        let lines: Vec<String> = lines;
        text.push_str(&if lines.is_empty() {
            format!("\n{title}: none\n")
        } else {
            format!("\n{title}:\n{}", lines.concat())
        });
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What `cargo test -- --show-output` prints, line by line.
    const OUTPUT: &str = "\nrunning 4 tests\ntest a::passes ... ok\ntest a::slow ... ignored, minutes\ntest b ... ignored\n\
        test a::fails ... FAILED\n\nsuccesses:\n\n---- a::passes stdout ----\nnoise\nskipped: no records in ../shared\n\n\n\
        successes:\n    a::passes\n\nfailures:\n\n---- a::fails stdout ----\nskipped: part of a failure\n\n\
        failures:\n    a::fails\n\ntest result: FAILED. 1 passed; 1 failed; 2 ignored\n";

    #[test]
    fn failures_are_shown_and_what_was_left_out_is_kept() {
        let mut tests = Tests::default();
        let shown: Vec<&str> = OUTPUT.lines().filter(|line| tests.shows(line)).collect();
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
        assert_eq!(tests.skipped, BTreeMap::from([one("no records in ../shared", "a::passes")]));
        assert_eq!(tests.ignored, BTreeMap::from([one("minutes", "a::slow"), one("no reason given", "b")]));
    }

    #[test]
    fn the_table_names_every_check_and_what_was_left_out() {
        let mut tests = Tests::default();
        let row = |title, outcome| Row { title, outcome, seconds: 1.25 };
        let rows = [
            row("lints", Outcome::Passed),
            row("tests", Outcome::Failed),
            row("spectra", Outcome::Skipped("not here".to_owned())),
        ];
        let text = table(&rows, &tests);
        assert!(
            text.contains("lints    passed       1.2\ntests    FAILED       1.2\nspectra  skipped      1.2\n"),
            "{text}"
        );
        assert!(text.contains("  spectra: not here\n"), "{text}");
        assert!(text.ends_with("skipped by tests: none\n\nignored tests: none\n"), "{text}");
        OUTPUT.lines().for_each(|line| _ = tests.shows(line));
        assert!(table(&rows, &tests).ends_with("\nignored tests:\n  minutes\n    a::slow\n  no reason given\n    b\n"));
    }
}
