//! The page of `freestand serve`: built with Node, checked, and tried in a browser. The built page is
//! committed, so that only who changes it needs Node.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The sources of the page.
const UI: &str = "crates/freestand-page/ui";

/// What the build makes, in `dist`; each also packed, as `.gz`.
const BUILT: [&str; 5] = [
    "index.html",
    "assets/app.js",
    "assets/film.js",
    "assets/app.css",
    "assets/icon.svg",
];

/// Names of the browser that drives the page.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Builds the page into `dist`.
pub fn build(root: &Path) -> Result<(), String> {
    if let Some(why) = missing_node() {
        return Err(why);
    }
    install(root)?;
    npm(root, &["run", "build"])
}

/// Why Node cannot be used; `None`: it can.
pub fn missing_node() -> Option<String> {
    let Some(version) = printed("node", &["--version"]) else {
        return Some("Node is not installed (20.19 or later; 22.12 or later)".to_owned());
    };
    let numbers: Vec<u32> = version
        .trim_start_matches('v')
        .split('.')
        .map_while(|number| number.trim().parse().ok())
        .collect();
    let is_new_enough = match numbers.as_slice() {
        [20, minor, ..] => *minor >= 19,
        [22, minor, ..] => *minor >= 12,
        [major, ..] => *major > 22,
        [] => false,
    };
    (!is_new_enough).then(|| {
        format!(
            "Node {} is too old (20.19 or later; 22.12 or later)",
            version.trim()
        )
    })
}

/// Why no browser can be used; `None`: one can.
pub fn missing_browser() -> Option<String> {
    let hint = "Chromium is not installed (Debian: apt-get install chromium)";
    browser().is_none().then(|| hint.to_owned())
}

fn browser() -> Option<&'static str> {
    BROWSERS
        .into_iter()
        .find(|name| printed(name, &["--version"]).is_some())
}

/// Builds the page anew beside the one that is committed, which others may be compiling in, and compares
/// both byte for byte. Packed files are compared by a test of `freestand-page`: their bytes depend on the
/// packer.
pub fn compare(root: &Path) -> Result<(), String> {
    install(root)?;
    let made = target(root).join("page");
    let folder = made.display().to_string();
    npm(
        root,
        &["run", "build", "--", "--outDir", &folder, "--emptyOutDir"],
    )?;
    let read = |path: PathBuf| {
        std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let mut different = Vec::new();
    for name in BUILT {
        if read(made.join(name))? != read(root.join(UI).join("dist").join(name))? {
            different.push(name);
        }
    }
    if different.is_empty() {
        return Ok(());
    }
    Err(format!(
        "{}: not what its sources give; commit the result of `cargo xtask ui`",
        different.join(", ")
    ))
}

fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from)
}

/// Types of the page, and its tests without a browser.
pub fn check(root: &Path) -> Result<(), String> {
    install(root)?;
    npm(root, &["run", "check"])?;
    npm(root, &["test"])
}

/// What people do on the page, in a browser, with the program that the tests have just built; all of
/// it, or without what takes long.
pub fn browse(root: &Path, all: bool) -> Result<(), String> {
    install(root)?;
    let browser = browser().ok_or("no browser")?;
    let path = printed("which", &[browser]).ok_or("no browser")?;
    let program = target(root)
        .join("debug")
        .join(format!("freestand{}", std::env::consts::EXE_SUFFIX));
    let environment = [
        ("FREESTAND", program.display().to_string()),
        ("CHROMIUM", path.trim().to_owned()),
    ];
    let extent: &[&str] = if all { &["--", "--all"] } else { &[] };
    run(
        root,
        "npm",
        &[&["run", "browser"], extent].concat(),
        &environment,
    )
}

/// Installs the packages of the lock file, unless they are those that were installed last.
fn install(root: &Path) -> Result<(), String> {
    let folder = root.join(UI);
    let lock = folder.join("package-lock.json");
    let wanted = std::fs::read(&lock).map_err(|error| format!("{}: {error}", lock.display()))?;
    // `npm ci` removes the folder, and with it this mark.
    let mark = folder.join("node_modules/.installed-lock");
    if std::fs::read(&mark).is_ok_and(|installed| installed == wanted) {
        return Ok(());
    }
    npm(root, &["ci", "--no-audit", "--no-fund"])?;
    std::fs::write(&mark, wanted).map_err(|error| format!("{}: {error}", mark.display()))
}

fn npm(root: &Path, arguments: &[&str]) -> Result<(), String> {
    run(root, "npm", arguments, &[])
}

fn run(
    root: &Path,
    program: &str,
    arguments: &[&str],
    environment: &[(&str, String)],
) -> Result<(), String> {
    let environment = environment
        .iter()
        .map(|(name, value)| (*name, value.as_str()));
    let status = Command::new(program)
        .args(arguments)
        .envs(environment)
        .current_dir(root.join(UI))
        .status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{status}: {program} {}", arguments.join(" "))),
        Err(error) => Err(format!("cannot run {program}: {error}")),
    }
}

/// What a program prints; `None` where it is not there, or fails.
fn printed(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program)
        .args(arguments)
        .stderr(Stdio::null())
        .output()
        .ok()?;
    output
        .status
        .success()
        .then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}
