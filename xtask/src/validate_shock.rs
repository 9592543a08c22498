//! Shock response spectra beside public packages, pyyeti and endaq, which are fetched from PyPI only when asked for by name:
//! a check of every change must not wait for it.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

const PACKAGES: [&str; 2] = ["pyyeti>=1.4,<2", "endaq>=1.5,<2"];
/// Their Python environment, in the workspace.
const ENVIRONMENT: &str = "target/validation-shock";

fn python(root: &Path) -> PathBuf {
    root.join(ENVIRONMENT).join(if cfg!(windows) {
        "Scripts/python.exe"
    } else {
        "bin/python"
    })
}

/// Whether the packages are at hand.
pub fn is_installed(root: &Path) -> bool {
    let import = Command::new(python(root))
        .args(["-c", "import pyyeti, endaq"])
        .output();
    import.is_ok_and(|output| output.status.success())
}

/// Fetches the packages where they are missing, builds the program and compares.
pub fn fetch_and_compare(root: &Path) -> Result<(), String> {
    if !is_installed(root) {
        let failed = |error| {
            format!("pyyeti and endaq cannot be installed, so nothing was compared: {error}")
        };
        let program = if cfg!(windows) { "python" } else { "python3" };
        run(root, program, &["-m", "venv", ENVIRONMENT]).map_err(failed)?;
        let install = [&["-m", "pip", "install", "--quiet"][..], &PACKAGES[..]].concat();
        run(root, python(root), &install).map_err(failed)?;
    }
    run(
        root,
        "cargo",
        &["build", "--locked", "--package", "freestand-cli"],
    )?;
    compare(root)
}

/// Compares the program, as it was built last, with the packages.
pub fn compare(root: &Path) -> Result<(), String> {
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let binary = target.join(if cfg!(windows) {
        "debug/freestand.exe"
    } else {
        "debug/freestand"
    });
    run(
        root,
        python(root),
        &[
            "validation/shock_response/compare.py",
            &binary.to_string_lossy(),
        ],
    )
}

/// Runs a command in the workspace.
fn run(root: &Path, program: impl AsRef<OsStr>, arguments: &[&str]) -> Result<(), String> {
    let name = format!(
        "{} {}",
        program.as_ref().to_string_lossy(),
        arguments.join(" ")
    );
    match Command::new(program)
        .args(arguments)
        .current_dir(root)
        .status()
    {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{status}: {name}")),
        Err(error) => Err(format!("cannot run {name}: {error}")),
    }
}
