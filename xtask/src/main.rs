//! `cargo xtask test`: everything that has to hold, with all set-up; what the README names and what CI runs.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a developer's tool talks to the terminal")]

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

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        Some("test") => test(),
        _ => {
            eprintln!("usage: cargo xtask test");
            ExitCode::from(2)
        }
    }
}

fn test() -> ExitCode {
    // At run time: a target folder may be shared between checkouts.
    let Ok(manifest) = std::env::var("CARGO_MANIFEST_DIR") else {
        eprintln!("run it as `cargo xtask test`");
        return ExitCode::from(2);
    };
    let root = std::path::Path::new(&manifest).join("..");
    let start = Instant::now();
    for check in CHECKS {
        println!("\n== {} ==", check.title);
        let began = Instant::now();
        let status = Command::new(check.command[0])
            .args(&check.command[1..])
            .envs(check.environment.iter().copied())
            .current_dir(&root)
            .status();
        match status {
            Ok(status) if status.success() => println!("== {}: {:.0} s ==", check.title, began.elapsed().as_secs_f64()),
            Ok(status) => {
                eprintln!("== {} failed ({status}): {} ==", check.title, check.command.join(" "));
                return ExitCode::FAILURE;
            }
            Err(error) => {
                eprintln!("== {} cannot run: {}: {error} ==", check.title, check.command[0]);
                return ExitCode::FAILURE;
            }
        }
    }
    println!("\nall checks passed in {:.0} s", start.elapsed().as_secs_f64());
    ExitCode::SUCCESS
}
