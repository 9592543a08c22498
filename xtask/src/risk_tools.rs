//! Exported fragilities in the programs that they are for, pelicun and the OpenQuake engine, which are fetched from PyPI only
//! when asked for by name: a check of every change must not wait for it.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

/// pelicun with what it needs, and what OpenQuake needs: its own list without GDAL, for which there is no wheel and which a
/// calculation of damage never imports.
const PACKAGES: [&str; 19] = [
    "pelicun==3.10.0",
    "simcenter-dlml==3.2.*",
    "numpy>=2.2.6,<2.3",
    "h5py>=3.13",
    "django>=4.2,<5",
    "psutil",
    "requests",
    "pyzmq~=26.0",
    "h3>=4.4",
    "decorator~=5.1.1",
    "pillow~=12.2.0",
    "toml~=0.10.2",
    "numba~=0.61.2",
    "alpha_shapes~=1.1.0",
    "docutils~=0.19.0",
    "django_cors_headers~=4.3.1",
    "pyproj~=3.7.2",
    "geopandas~=1.1.3",
    "fiona~=1.10.1",
];
const OPENQUAKE: &str = "openquake.engine==3.26.2";
/// Their Python environment, in the workspace.
const ENVIRONMENT: &str = "target/risk-tools";

fn python(root: &Path) -> PathBuf {
    root.join(ENVIRONMENT).join(if cfg!(windows) {
        "Scripts/python.exe"
    } else {
        "bin/python"
    })
}

/// Whether both programs are at hand. OpenQuake is installed last.
pub fn is_installed(root: &Path) -> bool {
    let ask = "import importlib.metadata as m; m.version('pelicun'); m.version('openquake.engine')";
    let import = Command::new(python(root)).args(["-c", ask]).output();
    import.is_ok_and(|output| output.status.success())
}

/// Fetches the programs where they are missing, builds freestand and compares.
pub fn fetch_and_compare(root: &Path) -> Result<(), String> {
    if !is_installed(root) {
        let failed = |error| {
            format!("pelicun and OpenQuake cannot be installed, so nothing was compared: {error}")
        };
        let program = if cfg!(windows) { "python" } else { "python3" };
        run(root, program, &["-m", "venv", ENVIRONMENT]).map_err(failed)?;
        let pip = [
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
        ];
        run(root, python(root), &[&pip[..], &PACKAGES[..]].concat()).map_err(failed)?;
        run(
            root,
            python(root),
            &[&pip[..], &["--no-deps", OPENQUAKE]].concat(),
        )
        .map_err(failed)?;
    }
    run(
        root,
        "cargo",
        &["build", "--locked", "--package", "freestand-cli"],
    )?;
    compare(root)
}

/// Compares freestand, as it was built last, with both programs.
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
            "-u",
            "validation/risk_tools/compare.py",
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
