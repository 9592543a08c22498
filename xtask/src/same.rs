//! `cargo xtask same COMMIT`: what many commands print and write, compared with another commit.
//!
//! It builds the program of the commit in a worktree and runs every line of
//! `validation/same/commands.sh` and every command of the documentation with both programs, each
//! time in the same empty folder. Tables must be the same to the byte, JSON documents by value; a
//! difference of texts is printed for a person to read.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::Value;

/// Keys of JSON documents that differ between two runs of one program.
const OF_A_RUN: [&str; 6] = [
    "solve_s",
    "elapsed_s",
    "seconds",
    "version",
    "sha256",
    "bytes",
];

/// Files whose bytes must be the same.
const TO_THE_BYTE: [&str; 7] = ["csv", "parquet", "toml", "at2", "jsonl", "xlsx", "txt"];

/// Folders of the repository that the commands name.
const INPUTS: [&str; 4] = ["validation", "examples", "crates", "fuzz"];

/// What differs.
#[derive(Default)]
struct Differences {
    values: Vec<String>,
    texts: Vec<String>,
    /// Lines that both programs refuse, as those under `# refused` are to be.
    refused: usize,
}

/// Compares the commands that contain the filter, and says whether all values are the same.
pub fn compare(root: &Path, commit: &str, filter: &str) -> Result<bool, String> {
    let work = root.join("target/same");
    make_folder(&work)?;
    let tree = checked_out(root, &work, commit)?;
    let programs = [
        built(&tree, &work.join("target"))?,
        built(root, &root.join("target"))?,
    ];
    let mut lines = commands(root)?;
    lines.retain(|line| line.contains(filter));
    if lines.is_empty() {
        return Err(format!("no command contains {filter:?}"));
    }

    let next = AtomicUsize::new(0);
    let found = Mutex::new(Differences::default());
    let worker = |place: &Path| -> Result<(), String> {
        while let Some(line) = lines.get(next.fetch_add(1, Ordering::Relaxed)) {
            let [old, new] = [0, 1].map(|one| ran(&programs[one], root, place, line));
            let differences = of_runs(line, &old?, &new?);
            let mut found = found.lock().map_err(|error| error.to_string())?;
            differences.texts.iter().for_each(|text| println!("{text}"));
            let values = differences.values.iter();
            values.for_each(|text| println!("NOT THE SAME: {text}"));
            found.values.extend(differences.values);
            found.texts.extend(differences.texts);
            found.refused += differences.refused;
        }
        Ok(())
    };
    let places = [work.join("here-1"), work.join("here-2")];
    std::thread::scope(|scope| {
        let running = places.each_ref().map(|place| scope.spawn(|| worker(place)));
        running.into_iter().try_for_each(|one| match one.join() {
            Ok(done) => done,
            Err(panic) => std::panic::resume_unwind(panic),
        })
    })?;

    let found = found.into_inner().map_err(|error| error.to_string())?;
    println!(
        "{} lines of commands, of which {} end with an error in both: {} differences of values, {} of texts",
        lines.len(),
        found.refused,
        found.values.len(),
        found.texts.len()
    );
    Ok(found.values.is_empty())
}

fn make_folder(path: &Path) -> Result<(), String> {
    std::fs::create_dir_all(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// A worktree of the commit.
fn checked_out(root: &Path, work: &Path, commit: &str) -> Result<PathBuf, String> {
    let git = |at: &Path, arguments: &[&str]| {
        let done = Command::new("git").args(arguments).current_dir(at).output();
        let done = done.map_err(|error| format!("cannot run git: {error}"))?;
        if done.status.success() {
            Ok(String::from_utf8_lossy(&done.stdout).trim().to_owned())
        } else {
            let said = String::from_utf8_lossy(&done.stderr);
            Err(format!("git {}: {said}", arguments.join(" ")))
        }
    };
    let commit = git(root, &["rev-parse", "--verify", commit])?;
    let tree = work.join("tree");
    if tree.exists() {
        git(&tree, &["checkout", "--quiet", "--detach", &commit])?;
    } else {
        let path = tree.to_string_lossy();
        git(root, &["worktree", "prune"])?;
        git(root, &["worktree", "add", "--detach", &path, &commit])?;
    }
    Ok(tree)
}

/// Builds the program of a tree; returns its folder.
fn built(tree: &Path, target: &Path) -> Result<PathBuf, String> {
    let status = Command::new("cargo")
        .args(["build", "--quiet", "--package", "freestand-cli"])
        .current_dir(tree)
        .env("CARGO_TARGET_DIR", target)
        .status();
    match status {
        Ok(status) if status.success() => Ok(target.join("debug")),
        Ok(_) => Err(format!("{} does not compile", tree.display())),
        Err(error) => Err(format!("cannot run cargo: {error}")),
    }
}

/// The lines of the list and the commands of the documentation, each once.
fn commands(root: &Path) -> Result<Vec<String>, String> {
    let docs = root.join("docs");
    let mut pages = vec![root.join("README.md")];
    for entry in std::fs::read_dir(&docs).map_err(|error| format!("docs: {error}"))? {
        pages.push(entry.map_err(|error| format!("docs: {error}"))?.path());
    }
    pages.retain(|page| page.extension().is_some_and(|kind| kind == "md"));
    pages.sort();
    let mut lines = Vec::new();
    for page in pages {
        let text = read(&page)?.replace("\\\n", "");
        let shown = text.lines().filter_map(|line| line.strip_prefix("$ "));
        lines.extend(shown.map(str::to_owned));
    }
    let listed = read(&root.join("validation/same/commands.sh"))?;
    lines.extend(listed.lines().map(str::to_owned));
    let mut seen = BTreeSet::new();
    lines.retain(|line| line.starts_with("freestand ") && seen.insert(line.clone()));
    Ok(lines)
}

/// What a line of commands printed and wrote.
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
    files: BTreeMap<PathBuf, Vec<u8>>,
}

/// Runs a line in a shell that finds the program first, in a folder that holds nothing but links to
/// the inputs.
fn ran(program: &Path, root: &Path, place: &Path, line: &str) -> Result<Run, String> {
    let cannot = |error: Error| format!("{line}: {error}");
    if place.exists() {
        std::fs::remove_dir_all(place).map_err(cannot)?;
    }
    make_folder(place)?;
    for folder in INPUTS {
        #[cfg(unix)]
        std::os::unix::fs::symlink(root.join(folder), place.join(folder)).map_err(cannot)?;
    }
    let path = std::env::var("PATH").unwrap_or_default();
    let done = Command::new("sh")
        .args(["-c", line])
        .current_dir(place)
        .env("PATH", format!("{}:{path}", program.display()))
        .output()
        .map_err(cannot)?;
    let mut files = BTreeMap::new();
    collect(place, place, &mut files).map_err(cannot)?;
    Ok(Run {
        code: done.status.code(),
        stdout: String::from_utf8_lossy(&done.stdout).into_owned(),
        stderr: String::from_utf8_lossy(&done.stderr).into_owned(),
        files,
    })
}

fn collect(
    place: &Path,
    folder: &Path,
    files: &mut BTreeMap<PathBuf, Vec<u8>>,
) -> Result<(), Error> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let (kind, path) = (entry.file_type()?, entry.path());
        if kind.is_dir() {
            collect(place, &path, files)?;
        } else if kind.is_file() {
            let name = path.strip_prefix(place).unwrap_or(&path).to_owned();
            files.insert(name, std::fs::read(&path)?);
        }
    }
    Ok(())
}

fn of_runs(line: &str, old: &Run, new: &Run) -> Differences {
    let mut found = Differences::default();
    let named = |what: String| format!("{line}\n  {what}\n");
    found.refused = usize::from(old.code == new.code && old.code == Some(2));
    if old.code != new.code {
        let what = format!("exit {:?}, now {:?}: {}", old.code, new.code, new.stderr);
        found.values.push(named(what));
    }
    for name in old
        .files
        .keys()
        .filter(|name| !new.files.contains_key(*name))
    {
        found
            .values
            .push(named(format!("{} is gone", name.display())));
    }
    for name in new
        .files
        .keys()
        .filter(|name| !old.files.contains_key(*name))
    {
        found
            .values
            .push(named(format!("{} is new", name.display())));
    }
    let printed = [&old.stdout, &new.stdout].map(|text| text.as_bytes());
    let mut pairs = vec![("output".to_owned(), "json", printed[0], printed[1])];
    for (name, bytes) in &old.files {
        let Some(other) = new.files.get(name) else {
            continue;
        };
        let kind = name.extension().and_then(|kind| kind.to_str());
        pairs.push((
            name.display().to_string(),
            kind.unwrap_or_default(),
            bytes,
            other,
        ));
    }
    for (name, kind, old, new) in pairs.into_iter().filter(|pair| pair.2 != pair.3) {
        if kind == "json"
            && let Some(one) = documents(old)
        {
            // What is no longer JSON differs in value.
            let other = documents(new).unwrap_or_default();
            let mut values = Vec::new();
            differing(&one, &other, &name, &mut values);
            found.values.extend(values.into_iter().map(named));
        } else {
            let text = named(format!("{name}: {}", first_difference(old, new)));
            let is_table = TO_THE_BYTE.contains(&kind);
            let list = if is_table {
                &mut found.values
            } else {
                &mut found.texts
            };
            list.push(text);
        }
    }
    if old.stderr != new.stderr {
        let [old, new] = [&old.stderr, &new.stderr].map(|text| text.as_bytes());
        let text = named(format!("messages: {}", first_difference(old, new)));
        found.texts.push(text);
    }
    found
}

/// The values that differ, with their places in the document.
fn differing(old: &Value, new: &Value, at: &str, found: &mut Vec<String>) {
    match (old, new) {
        (Value::Object(one), Value::Object(other)) => {
            let of_results = |key: &&String| !OF_A_RUN.contains(&key.as_str());
            for key in one.keys().filter(of_results) {
                match other.get(key) {
                    Some(value) => differing(&one[key], value, &format!("{at}/{key}"), found),
                    None => found.push(format!("{at}/{key} is gone")),
                }
            }
            let is_new = |key: &&String| !one.contains_key(*key);
            let new_keys = other.keys().filter(of_results).filter(is_new);
            found.extend(new_keys.map(|key| format!("{at}/{key} is new")));
        }
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            for (place, (one, other)) in one.iter().zip(other).enumerate() {
                differing(one, other, &format!("{at}/{place}"), found);
            }
        }
        _ if old != new => found.push(format!("{at}: {old}, now {new}")),
        _ => {}
    }
}

/// The JSON documents of a text, one after the other; `None`: it is something else.
fn documents(text: &[u8]) -> Option<Value> {
    let documents = serde_json::Deserializer::from_slice(text).into_iter::<Value>();
    documents
        .collect::<Result<Vec<Value>, _>>()
        .ok()
        .filter(|found| !found.is_empty())
        .map(Value::Array)
}

fn first_difference(old: &[u8], new: &[u8]) -> String {
    let [old, new] = [old, new].map(String::from_utf8_lossy);
    let pairs = || old.lines().zip(new.lines());
    let Some(place) = pairs().position(|(one, other)| one != other) else {
        let count = |text: &str| text.lines().count();
        return format!("{} lines, now {}", count(&old), count(&new));
    };
    let line = |text: &str| -> String {
        let line = text.lines().nth(place).unwrap_or_default();
        line.chars().take(300).collect()
    };
    format!(
        "line {}\n    - {}\n    + {}",
        place + 1,
        line(&old),
        line(&new)
    )
}
