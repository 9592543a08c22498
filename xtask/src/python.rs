//! The Python package: its wheel, with the program inside, and its tests.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::checks;

/// The environment with all that builds and tests the package, in the workspace.
const ENVIRONMENT: &str = "target/venv";
/// The crate.
const CRATE: &str = "crates/freestand-py";

/// What builds a wheel.
const BUILD: [&str; 1] = ["maturin>=1.16,<2"];
/// What its tests use.
const TEST: [&str; 8] = [
    "numpy>=1.26",
    "pytest>=8",
    "jsonschema>=4.18",
    "mypy>=1.15,<3",
    "pandas>=2.1",
    "pyarrow>=15",
    "xarray>=2024.1",
    "matplotlib>=3.8",
];

/// A level of compression: ten attempts of Zopfli.
const ZOPFLI: i64 = 19;

/// The level of the last piece that is compiled, which is the level of the passes over the whole. Rust's own linker, the
/// default on this target alone, keeps one of several equal functions:
/// nothing here compares the addresses of functions.
const LAST_PIECE: &[&str] = if cfg!(all(
    target_os = "linux",
    target_arch = "x86_64",
    target_env = "gnu"
)) {
    &["--", "-C", "opt-level=3", "-C", "link-arg=-Wl,--icf=all"]
} else {
    &["--", "-C", "opt-level=3"]
};

/// What Cargo is told to build the program that is published.
pub fn published_program() -> Vec<&'static str> {
    let package = [
        "rustc",
        "--locked",
        "--package",
        "freestand-cli",
        "--bin",
        "freestand",
    ];
    [&package[..], &["--profile", "published"], LAST_PIECE].concat()
}

/// What makes pages of its docstrings.
const PAGES: [&str; 1] = ["pdoc>=16,<17"];

/// Packages for the tests of Dask, polars and DuckDB and for the notebooks, which are left out if
/// the packages cannot be installed.
const MORE: [&str; 7] = [
    "distributed>=2026.8",
    "dask-jobqueue>=0.9",
    "duckdb>=1.3",
    "markdown>=3.5",
    "obspy>=1.4",
    "polars>=1.0",
    "scipy>=1.11",
];

/// How the program and the extension are compiled.
#[derive(Clone, Copy, PartialEq)]
pub enum Profile {
    /// As for tests: what computes is optimised.
    Dev,
    /// As it is published: small, and what computes is optimised.
    Published,
}

/// Why there is no package: it cannot be built here, or it is wrong.
pub enum Trouble {
    NotHere(String),
    Wrong(String),
}

/// Builds a wheel into a folder, and returns its path.
pub fn wheel(root: &Path, out: &Path, profile: Profile) -> Result<PathBuf, Trouble> {
    install(root, &BUILD)?;
    let folder = match profile {
        Profile::Dev => {
            // The program as the tests build it: built alone it would have other features, and be
            // compiled again.
            run(
                root,
                "cargo",
                &[&["test", "--no-run", "--test", "cli"], &checks::TESTED[..]].concat(),
            )?;
            "debug"
        }
        Profile::Published => {
            run(root, "cargo", &published_program())?;
            "published"
        }
    };
    let name = if cfg!(windows) {
        "freestand.exe"
    } else {
        "freestand"
    };
    let scripts = root.join(CRATE).join("freestand.data/scripts");
    let program = scripts.join(name);
    let copied = std::fs::create_dir_all(&scripts)
        .and_then(|()| std::fs::copy(target(root).join(folder).join(name), &program));
    copied.map_err(|error| {
        Trouble::Wrong(format!(
            "cannot copy the program to {}: {error}",
            scripts.display()
        ))
    })?;
    // Without it the wheel is larger, and as good.
    _ = Command::new("strip")
        .arg(&program)
        .stderr(Stdio::null())
        .status();
    let empty = |path: PathBuf| {
        path.extension()
            .is_some_and(|ending| ending == "whl")
            .then(|| std::fs::remove_file(path))
    };
    std::fs::read_dir(out)
        .into_iter()
        .flatten()
        .flatten()
        .for_each(|file| _ = empty(file.path()));
    let (name, last): (_, &[&str]) = match profile {
        Profile::Dev => ("dev", &[]),
        Profile::Published => ("published", LAST_PIECE),
    };
    let (manifest, out_text) = (
        format!("{CRATE}/extension/Cargo.toml"),
        out.to_string_lossy(),
    );
    let arguments = [
        &["build", "--locked", "--profile", name][..],
        &["--manifest-path", &manifest, "--out", &out_text],
        &["--compression-level", "1"],
        last,
    ]
    .concat();
    run(root, tool(root, "maturin"), &arguments)?;
    let wheels = std::fs::read_dir(out)
        .map_err(|error| Trouble::Wrong(format!("{}: {error}", out.display())))?;
    let found = wheels
        .flatten()
        .map(|file| file.path())
        .find(|path| path.extension().is_some_and(|end| end == "whl"));
    let wheel = found
        .ok_or_else(|| Trouble::Wrong(format!("maturin wrote no wheel into {}", out.display())))?;
    if profile == Profile::Published {
        pack(&wheel).map_err(|error| Trouble::Wrong(format!("{}: {error}", wheel.display())))?;
    }
    Ok(wheel)
}

/// Compresses a wheel as strongly as every installer can read, which takes minutes. Its files stay as they are, and
/// so does the list of their checksums in it.
fn pack(wheel: &Path) -> zip::result::ZipResult<()> {
    let mut read = zip::ZipArchive::new(std::fs::File::open(wheel)?)?;
    let packed = wheel.with_extension("packed");
    let mut write = zip::ZipWriter::new(std::fs::File::create(&packed)?);
    for index in 0..read.len() {
        let mut file = read.by_index(index)?;
        let name = file.name()?.into_owned();
        let options = file
            .options()
            .compression_method(zip::CompressionMethod::Deflated)
            .compression_level(Some(ZOPFLI));
        write.start_file(name, options)?;
        std::io::copy(&mut file, &mut write)?;
    }
    write.finish()?;
    // Windows does not replace a file that is open.
    drop(read);
    std::fs::rename(packed, wheel)?;
    Ok(())
}

/// Builds the wheel, installs it, and runs its tests and the checks of its types. All of it: with
/// the wheel that is published, the tests that are marked `long`, and the notebooks.
pub fn test(root: &Path, all: bool) -> Result<(), Trouble> {
    install(root, &[&BUILD[..], &TEST[..]].concat())?;
    let more = install(root, &MORE);
    let (profile, marked) = if all {
        (Profile::Published, "")
    } else {
        for part in [
            "the wheel as it is published",
            "its tests that are marked `long`",
            "the comparison of its stub with the module",
            "the notebooks",
        ] {
            println!("left out: {part}");
        }
        (Profile::Dev, "not long")
    };
    put_in(root, profile)?;
    let python = python(root);
    let package = root.join(CRATE);
    let mut wrong = Vec::new();
    let mut checks = vec![
        vec!["-m", "pytest", "--quiet", "-rs", "-m", marked],
        vec!["-m", "mypy", "python/freestand", "tests/typed.py"],
    ];
    if all {
        checks.push(vec![
            "-m",
            "mypy.stubtest",
            "freestand._freestand",
            "--concise",
        ]);
    }
    for arguments in checks {
        match run(&package, &python, &arguments) {
            Ok(()) => {}
            Err(Trouble::Wrong(problem) | Trouble::NotHere(problem)) => wrong.push(problem),
        }
    }
    match more {
        Ok(()) if !all => {}
        // Their pages are made as docs/python.md says.
        Ok(()) => match run(root, &python, &["examples/notebooks/run.py"]) {
            Ok(()) => {}
            Err(Trouble::Wrong(problem) | Trouble::NotHere(problem)) => wrong.push(problem),
        },
        Err(Trouble::NotHere(why) | Trouble::Wrong(why)) => {
            println!(
                "skipped: the tests of Dask, polars and DuckDB and the notebooks, which need {}: {why}",
                MORE.join(", ")
            );
        }
    }
    if wrong.is_empty() {
        Ok(())
    } else {
        Err(Trouble::Wrong(wrong.join("\n")))
    }
}

/// Builds the wheel and installs it in the environment.
fn put_in(root: &Path, profile: Profile) -> Result<(), Trouble> {
    let wheel = wheel(root, &root.join("target/wheels-tested"), profile)?;
    let pip = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "--no-deps",
        "--force-reinstall",
    ];
    run(
        root,
        python(root),
        &[&pip[..], &[&*wheel.to_string_lossy()]].concat(),
    )
}

/// The pages of a site about the package: `python/` from its docstrings, `notebooks/` with their results.
pub fn pages(root: &Path, site: &Path) -> Result<(), String> {
    let made = || {
        install(root, &[&BUILD[..], &TEST[..], &PAGES[..]].concat())?;
        install(root, &MORE)?;
        put_in(root, Profile::Dev)?;
        let [package, notebooks] =
            ["python", "notebooks"].map(|name| site.join(name).to_string_lossy().into_owned());
        let pdoc = ["-m", "pdoc", "--docformat", "numpy", "--output-directory"];
        run(
            root,
            python(root),
            &[&pdoc[..], &[&package, "freestand"]].concat(),
        )?;
        let run_all = ["examples/notebooks/run.py", "--out", &notebooks];
        run(root, python(root), &run_all)
    };
    made().map_err(|trouble| match trouble {
        Trouble::NotHere(why) | Trouble::Wrong(why) => why,
    })
}

pub fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from)
}

fn tool(root: &Path, name: &str) -> PathBuf {
    let (folder, ending) = if cfg!(windows) {
        ("Scripts", ".exe")
    } else {
        ("bin", "")
    };
    root.join(ENVIRONMENT)
        .join(folder)
        .join(format!("{name}{ending}"))
}

fn python(root: &Path) -> PathBuf {
    tool(root, "python")
}

/// Makes the environment and fetches packages, where they are missing.
fn install(root: &Path, packages: &[&str]) -> Result<(), Trouble> {
    let not_here = |problem: Trouble| match problem {
        Trouble::Wrong(why) | Trouble::NotHere(why) => {
            Trouble::NotHere(format!("Python 3.10 or later with pip: {why}"))
        }
    };
    if !python(root).exists() {
        let program = if cfg!(windows) { "python" } else { "python3" };
        run(
            root,
            program,
            &["-c", "import sys; sys.exit(sys.version_info < (3, 10))"],
        )
        .map_err(not_here)?;
        run(root, program, &["-m", "venv", ENVIRONMENT]).map_err(not_here)?;
    }
    // Asking pip takes seconds, so that the answer is kept.
    let mark = root
        .join(ENVIRONMENT)
        .join(format!("installed-{}", packages.len()));
    let wanted = packages.join("\n");
    if std::fs::read_to_string(&mark).is_ok_and(|found| found == wanted) {
        return Ok(());
    }
    let pip = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
    ];
    run(root, python(root), &[&pip[..], packages].concat()).map_err(not_here)?;
    std::fs::write(&mark, wanted)
        .map_err(|error| Trouble::Wrong(format!("{}: {error}", mark.display())))
}

/// Runs a command in a folder.
fn run(folder: &Path, program: impl AsRef<OsStr>, arguments: &[&str]) -> Result<(), Trouble> {
    let name = format!(
        "{} {}",
        program.as_ref().to_string_lossy(),
        arguments.join(" ")
    );
    match Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .env_remove("VIRTUAL_ENV")
        .status()
    {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(Trouble::Wrong(format!("{status}: {name}"))),
        Err(error) => Err(Trouble::NotHere(format!("cannot run {name}: {error}"))),
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Read as _, Write as _};

    use super::*;

    #[test]
    fn a_packed_wheel_has_the_same_files() {
        let wheel = std::env::temp_dir().join(format!("packed-{}.whl", std::process::id()));
        let mut write = zip::ZipWriter::new(std::fs::File::create(&wheel).unwrap());
        let stored = zip::write::SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Deflated)
            .compression_level(Some(1))
            .unix_permissions(0o755);
        let text = "freestand ".repeat(1000);
        write
            .start_file("freestand.data/scripts/freestand", stored)
            .unwrap();
        write.write_all(text.as_bytes()).unwrap();
        write.finish().unwrap();
        let before = std::fs::metadata(&wheel).unwrap().len();
        pack(&wheel).unwrap();
        assert!(std::fs::metadata(&wheel).unwrap().len() < before);
        let mut read = zip::ZipArchive::new(std::fs::File::open(&wheel).unwrap()).unwrap();
        let mut file = read.by_name("freestand.data/scripts/freestand").unwrap();
        // What installers run has to stay executable.
        assert_eq!(file.unix_mode().unwrap() & 0o777, 0o755);
        let mut found = String::new();
        file.read_to_string(&mut found).unwrap();
        assert_eq!(found, text);
        drop(file);
        drop(read);
        std::fs::remove_file(wheel).unwrap();
    }
}
