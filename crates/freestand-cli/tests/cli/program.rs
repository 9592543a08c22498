//! Runs the program for all tests, and reads what it returns.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

pub(crate) const PROGRAM: &str = env!("CARGO_BIN_EXE_freestand");

/// The program, to be called in `folder`.
pub(crate) fn command(folder: &Path) -> Command {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder);
    command
}

/// Runs freestand in `folder`.
pub(crate) fn execute(folder: &Path, args: &[&str]) -> Output {
    command(folder).args(args).output().unwrap()
}

/// Runs freestand in `folder` and returns its status and output as text.
pub(crate) fn freestand_in(folder: &Path, args: &[&str]) -> String {
    shown(args, &execute(folder, args))
}

/// Runs freestand in the folder of the tests and returns its status and output as text.
pub(crate) fn freestand(args: &[&str]) -> String {
    freestand_in(Path::new("."), args)
}

/// A command, its exit status and what it printed: the text of a snapshot.
pub(crate) fn shown(args: &[&str], output: &Output) -> String {
    let text = |bytes: &[u8]| {
        String::from_utf8(bytes.to_vec())
            .unwrap()
            .trim_end()
            .to_owned()
    };
    format!(
        "$ freestand {}\nexit status {}\n--- stdout\n{}\n--- stderr\n{}",
        args.join(" "),
        output.status.code().unwrap(),
        text(&output.stdout),
        text(&output.stderr)
    )
}

/// The document that a command printed.
pub(crate) fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)))
}

/// The document of a command in which nothing failed.
pub(crate) fn document(folder: &Path, args: &[&str]) -> Value {
    let output = execute(folder, &[args, &["--json"]].concat());
    assert_eq!(
        output.status.code(),
        Some(0),
        "{args:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    json(&output)
}

/// The error line of a command that cannot run, which also has a hint.
pub(crate) fn refused(folder: &Path, args: &[&str]) -> String {
    let output = execute(folder, args);
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        (output.status.code(), output.stdout.len()),
        (Some(2), 0),
        "{args:?}: {text}"
    );
    assert!(text.contains("\nhint: "), "{text}");
    text.lines().next().unwrap().to_owned()
}

/// The names in a folder, sorted.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort_unstable();
    names
}

/// A folder with the files of a test.
pub(crate) fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// The folder of the repository.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The folder with what the repository may not hold.
pub(crate) fn shared() -> PathBuf {
    std::env::var_os("FREESTAND_SHARED").map_or_else(|| root().join("../shared"), PathBuf::from)
}

/// A record of the repository.
pub(crate) fn record(name: &str) -> PathBuf {
    root()
        .join("validation/rocking/records")
        .join(format!("{name}.csv"))
}

/// `--duration` up to the last sample of a record: the known answers end there, and the program goes on.
pub(crate) fn to_its_end(record: &Path) -> String {
    let text = std::fs::read_to_string(record).unwrap();
    let dt_s: f64 = text
        .split_whitespace()
        .find_map(|word| word.strip_prefix("dt="))
        .unwrap()
        .parse()
        .unwrap();
    let samples = text.lines().filter(|line| !line.starts_with('#')).count();
    format!("--duration={} s", (samples - 1) as f64 * dt_s)
}
