//! `cargo xtask test`: all checks but for what takes long; the README names it. `cargo xtask test
//! --all`: the rest as well; CI runs it, and there what is skipped has failed. `cargo xtask check
//! NAME [--all]`: one of these checks, with its output as it comes. `cargo xtask arrows`: the first
//! of these checks alone, which takes a second. `cargo xtask validate-shock`: shock response spectra compared with those of public packages, which it fetches from PyPI.
//! `cargo xtask risk-tools`: exported fragilities in pelicun and the OpenQuake engine, which it
//! fetches from PyPI. `cargo xtask ui`: builds the page that `freestand serve` hands out; the
//! result is committed. `cargo xtask generate`: the schemas in docs/schema and the table of bad requests, from the
//! structs of the requests. `cargo xtask wheel [--out DIR]`: the Python package with the program
//! inside, as it is published. `cargo xtask dist [--out DIR]`: an archive and a Debian package of the program. `cargo xtask site [--out DIR]`: all documents as pages in one folder. `cargo xtask python`: its tests alone, on a wheel of the dev
//! profile. `cargo xtask shake-table [--data DIR]`: two rocks on a shake table, measured and calculated; the tests are not
//! in the repository. `cargo xtask same COMMIT`: the outputs of two hundred commands, compared with another
//! commit.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a developer's tool talks to the terminal"
)]

mod arrows;
mod checks;
mod dist;
mod documents;
mod licences;
mod page;
mod python;
mod risk_tools;
mod same;
mod site;
mod source;
mod toolchain;
mod tools;
mod validate_shock;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use checks::Check;

const USAGE: &str = "usage: cargo xtask test [--all] | check NAME [--all] | arrows | ui | generate | wheel [--out DIR] | dist [--out DIR] | \
                     site [--out DIR] | \
                     python [--all] | validate-shock | risk-tools | shake-table [--data DIR] | same COMMIT [WORDS]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(root) = root() else {
        eprintln!("run it as `cargo xtask …`");
        return ExitCode::from(2);
    };
    let (command, rest) = arguments
        .split_first()
        .map_or(("", &[][..]), |(command, rest)| (command.as_str(), rest));
    let (all, rest) = match (command, rest) {
        ("test" | "check" | "python", [others @ .., flag]) if flag == "--all" => (true, others),
        _ => (false, rest),
    };
    if let ("check", [name]) = (command, rest) {
        return match Check::ALL.into_iter().find(|check| check.name() == name) {
            Some(check) => ExitCode::from(check.run(&root, all)),
            None => {
                let names = Check::ALL.map(Check::name).join(", ");
                eprintln!("there is no check {name:?}; checks: {names}");
                ExitCode::from(2)
            }
        };
    }
    let done = match (command, rest) {
        ("test", []) => {
            let strict = std::env::var_os("CI").is_some_and(|value| !value.is_empty());
            Ok(checks::all(&root, checks::Extent { all, strict }))
        }
        ("arrows", []) => checks::arrows(&root).map(|()| true),
        ("ui", []) => page::build(&root).map(|()| true),
        ("generate", []) => checks::generate(&root),
        ("validate-shock", []) => validate_shock::fetch_and_compare(&root).map(|()| true),
        ("risk-tools", []) => risk_tools::fetch_and_compare(&root).map(|()| true),
        ("shake-table", []) if !root.join(SHAKE_TABLE).is_dir() => {
            println!("skipped: the tests of rocks on a shake table are not in {SHAKE_TABLE}");
            Ok(true)
        }
        ("shake-table", []) => shake_table(&root, &root.join(SHAKE_TABLE)),
        ("shake-table", [flag, data]) if flag == "--data" => shake_table(&root, Path::new(data)),
        ("same", [commit]) => same::compare(&root, commit, ""),
        ("same", [commit, filter]) => same::compare(&root, commit, filter),
        ("wheel", []) => wheel(&root, &root.join("target/wheels")),
        ("wheel", [flag, out]) if flag == "--out" => wheel(&root, &PathBuf::from(out)),
        ("dist", []) => dist(&root, &root.join("target/dist")),
        ("dist", [flag, out]) if flag == "--out" => dist(&root, Path::new(out)),
        ("site", []) => site::site(&root, &root.join("target/pages")).map(|()| true),
        ("site", [flag, out]) if flag == "--out" => {
            let out = std::path::absolute(out);
            let out = out.map_err(|error| error.to_string());
            out.and_then(|out| site::site(&root, &out)).map(|()| true)
        }
        ("python", []) => python::test(&root, all).map(|()| true).map_err(told),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

/// Where the tests of rocks on a shake table are, beside the workspace.
const SHAKE_TABLE: &str = "../shared/shake-table";

/// Compares the models with the tests, and writes their scores and the figure of docs/validation.md.
fn shake_table(root: &Path, data: &Path) -> Result<bool, String> {
    let data = std::path::absolute(data).map_err(|error| format!("{}: {error}", data.display()))?;
    let run = [
        "run",
        "--release",
        "--quiet",
        "--locked",
        "--package",
        "freestand-shake-table",
        "--",
    ];
    let status = std::process::Command::new("cargo")
        .args(run)
        .arg(&data)
        .arg(root.join("validation/shake-table"))
        .current_dir(root)
        .status()
        .map_err(|error| format!("cargo: {error}"))?;
    Ok(status.success())
}

/// Builds the wheel that is published, and says where it is.
fn wheel(root: &Path, out: &Path) -> Result<bool, String> {
    // The tools run in folders of their own.
    let out = std::path::absolute(out).map_err(|error| format!("{}: {error}", out.display()))?;
    let wheel = python::wheel(root, &out, python::Profile::Published).map_err(told)?;
    let bytes = std::fs::metadata(&wheel).map_or(0, |data| data.len());
    println!("{}, {:.1} MB", wheel.display(), bytes as f64 / 1e6);
    Ok(true)
}

/// Builds what is given to people without Rust.
fn dist(root: &Path, out: &Path) -> Result<bool, String> {
    let out = std::path::absolute(out).map_err(|error| format!("{}: {error}", out.display()))?;
    dist::dist(root, &out).map(|()| true)
}

fn told(trouble: python::Trouble) -> String {
    match trouble {
        python::Trouble::NotHere(why) => format!("not run: {why}"),
        python::Trouble::Wrong(why) => why,
    }
}

/// The workspace. At run time: a target folder may be shared between checkouts.
fn root() -> Option<PathBuf> {
    Some(
        Path::new(&std::env::var_os("CARGO_MANIFEST_DIR")?)
            .parent()?
            .to_owned(),
    )
}
