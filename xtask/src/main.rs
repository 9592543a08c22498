//! `cargo xtask test`: everything that has to hold, with all set-up; what the README names and what CI runs.
//! `cargo xtask pdf`: the PDF of an assessment and the command line with it, which the checks above leave out.
//! `cargo xtask validate-shock`: shock response spectra beside public packages, which it fetches from PyPI.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a developer's tool talks to the terminal")]

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

/// A check: a title for people, and a command.
struct Check {
    title: &'static str,
    command: &'static [&'static str],
    environment: &'static [(&'static str, &'static str)],
}

const CHECKS: &[Check] = &[
    Check { title: "formatting", command: &["cargo", "fmt", "--all", "--check"], environment: &[] },
    Check {
        title: "lints",
        command: &["cargo", "clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"],
        environment: &[],
    },
    Check {
        title: "tests",
        command: &["cargo", "test", "--workspace", "--locked", "--lib", "--bins", "--tests"],
        environment: &[],
    },
    Check {
        title: "reference histories, records and damaged records: what was held, what was skipped",
        command: &[
            "cargo",
            "test",
            "--locked",
            "--quiet",
            "--workspace",
            "--test",
            "rocking_cases",
            "--test",
            "real_records",
            "--test",
            "record_measures",
            "--test",
            "mutations",
            "--",
            "--nocapture",
        ],
        environment: &[],
    },
    Check {
        title: "examples in the documentation",
        command: &["cargo", "test", "--workspace", "--locked", "--doc"],
        environment: &[],
    },
    Check {
        title: "documentation",
        command: &["cargo", "doc", "--workspace", "--locked", "--no-deps"],
        environment: &[("RUSTDOCFLAGS", "-D warnings")],
    },
    Check {
        title: "benchmarks compile",
        command: &["cargo", "check", "--workspace", "--locked", "--benches"],
        environment: &[],
    },
];

/// Apart: the typesetter alone takes twenty minutes to build. Both packages are named in one command and with one feature, so that
/// the typesetter is built once.
const PDF_CHECKS: &[Check] = &[
    Check {
        title: "lints, with the feature pdf",
        command: &[
            "cargo",
            "clippy",
            "--package",
            "freestand-pdf",
            "--package",
            "freestand-cli",
            "--features",
            "freestand-cli/pdf",
            "--all-targets",
            "--locked",
            "--",
            "-D",
            "warnings",
        ],
        environment: &[],
    },
    Check {
        title: "tests, with the feature pdf",
        command: &[
            "cargo",
            "test",
            "--package",
            "freestand-pdf",
            "--package",
            "freestand-cli",
            "--features",
            "freestand-cli/pdf",
            "--locked",
            "--lib",
            "--bins",
            "--tests",
        ],
        environment: &[],
    },
];

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        Some("test") => test(),
        Some("pdf") => pdf(),
        Some("validate-shock") => finished(validate_shock(true)),
        _ => {
            eprintln!("usage: cargo xtask test | pdf | validate-shock");
            ExitCode::from(2)
        }
    }
}

/// The workspace. At run time: a target folder may be shared between checkouts.
fn root() -> Option<PathBuf> {
    std::env::var("CARGO_MANIFEST_DIR").ok().map(|manifest| PathBuf::from(manifest).join(".."))
}

fn finished(done: bool) -> ExitCode {
    if done { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Runs a command in `folder` and says when it does not succeed.
fn succeeds(folder: &Path, program: impl AsRef<OsStr>, arguments: &[&str]) -> bool {
    let name = program.as_ref().to_string_lossy().into_owned();
    match Command::new(program).args(arguments).current_dir(folder).status() {
        Ok(status) if status.success() => true,
        Ok(status) => {
            eprintln!("== failed ({status}): {name} {} ==", arguments.join(" "));
            false
        }
        Err(error) => {
            eprintln!("== cannot run {name}: {error} ==");
            false
        }
    }
}

/// Shock response spectra beside pyyeti and endaq. Their environment is made only when asked for by name: a check of
/// every change must not wait for PyPI.
fn validate_shock(fetch: bool) -> bool {
    const PACKAGES: [&str; 2] = ["pyyeti>=1.4,<2", "endaq>=1.5,<2"];
    let Some(root) = root() else {
        eprintln!("run it as `cargo xtask validate-shock`");
        return false;
    };
    let environment = "target/validation-shock";
    let python = root.join(environment).join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if !python.exists() && !fetch {
        println!(
            "== shock response spectra beside pyyeti and endaq: skipped, `cargo xtask validate-shock` fetches them =="
        );
        return true;
    }
    let imports = || Command::new(&python).args(["-c", "import pyyeti, endaq"]).status().is_ok_and(|s| s.success());
    if fetch && !imports() {
        let program = if cfg!(windows) { "python" } else { "python3" };
        let install = [&["-m", "pip", "install", "--quiet"][..], &PACKAGES[..]].concat();
        if !succeeds(&root, program, &["-m", "venv", environment]) || !succeeds(&root, &python, &install) {
            println!("== shock response spectra beside pyyeti and endaq: skipped, they cannot be installed ==");
            return true;
        }
    }
    let binary = if cfg!(windows) { "target/debug/freestand.exe" } else { "target/debug/freestand" };
    succeeds(&root, "cargo", &["build", "--locked", "--package", "freestand-cli"])
        && succeeds(&root, &python, &["validation/shock_response/compare.py", binary])
}

fn test() -> ExitCode {
    let Some(root) = root() else {
        eprintln!("run it as `cargo xtask test`");
        return ExitCode::from(2);
    };
    let start = Instant::now();
    if !all_hold(&root, CHECKS) {
        return ExitCode::FAILURE;
    }
    println!("\n== shock response spectra beside public packages ==");
    if !validate_shock(false) {
        return ExitCode::FAILURE;
    }
    println!("\nall checks passed in {:.0} s", start.elapsed().as_secs_f64());
    ExitCode::SUCCESS
}

fn pdf() -> ExitCode {
    let Some(root) = root() else {
        eprintln!("run it as `cargo xtask pdf`");
        return ExitCode::from(2);
    };
    finished(all_hold(&root, PDF_CHECKS))
}

/// Runs checks until one does not hold.
fn all_hold(root: &Path, checks: &[Check]) -> bool {
    for check in checks {
        println!("\n== {} ==", check.title);
        let began = Instant::now();
        let status = Command::new(check.command[0])
            .args(&check.command[1..])
            .envs(check.environment.iter().copied())
            .current_dir(root)
            .status();
        match status {
            Ok(status) if status.success() => println!("== {}: {:.0} s ==", check.title, began.elapsed().as_secs_f64()),
            Ok(status) => {
                eprintln!("== {} failed ({status}): {} ==", check.title, check.command.join(" "));
                return false;
            }
            Err(error) => {
                eprintln!("== {} cannot run: {}: {error} ==", check.title, check.command[0]);
                return false;
            }
        }
    }
    true
}
