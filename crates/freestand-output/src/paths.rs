//! The temporary places of outputs that are not complete yet, and the removal of what a killed
//! process left there.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use freestand_input::{Problem, ProblemKind};

/// The beginning of the name of a staging folder inside an existing target.
pub const STAGING_PREFIX: &str = ".freestand-partial-";

/// [`STAGING_PREFIX`] with our process number. tempfile adds random letters, so that no two threads
/// share a name.
pub fn staging_prefix() -> String {
    format!("{STAGING_PREFIX}{}-", std::process::id())
}

/// `.NAME.partial-` with our process number, for a file or folder next to `path`. It is on the same
/// file system, so that the target appears in one step.
pub fn prefix_next_to(path: &Path) -> Option<OsString> {
    let mut prefix = beginning_next_to(path)?;
    prefix.push(format!("{}-", std::process::id()));
    Some(prefix)
}

fn beginning_next_to(path: &Path) -> Option<OsString> {
    let mut beginning = OsString::from(".");
    beginning.push(path.file_name()?);
    beginning.push(".partial-");
    Some(beginning)
}

/// Removes what killed runs left for `target`: staging folders, or temporary `files`.
///
/// A leftover is removed if its process is gone and its lock is free. Either alone is not enough:
/// processes in other containers are not visible here, and not every file system has locks.
pub fn clear_leftovers(target: &Path, files: bool) {
    let places = [
        (Some(target), Some(STAGING_PREFIX.into())),
        (target.parent(), beginning_next_to(target)),
    ];
    for (folder, beginning) in places {
        let (Some(folder), Some(beginning)) = (folder, beginning) else {
            continue;
        };
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let process = process_of(&entry.file_name(), &beginning);
            let free =
                || fs::File::open(entry.path()).is_ok_and(|leftover| leftover.try_lock().is_ok());
            if process.is_some_and(is_gone) && free() {
                // A leftover that cannot be removed is not a failure of this run.
                let _ = match entry.file_type() {
                    Ok(kind) if kind.is_dir() && !files => fs::remove_dir_all(entry.path()),
                    Ok(kind) if kind.is_file() && files => fs::remove_file(entry.path()),
                    _ => Ok(()),
                };
            }
        }
    }
}

/// The process number in a name `BEGINNING` + `PID-LETTERS`.
fn process_of(name: &OsStr, beginning: &OsStr) -> Option<u32> {
    let (process, _) = name
        .to_str()?
        .strip_prefix(beginning.to_str()?)?
        .split_once('-')?;
    process.parse().ok()
}

/// Whether no such process is running. If that cannot be determined, the answer is no.
fn is_gone(process: u32) -> bool {
    let processes = Path::new("/proc");
    cfg!(target_os = "linux")
        && processes.join("self").exists()
        && !processes.join(process.to_string()).exists()
}

/// The target of a link; any other path unchanged.
pub fn real_path(path: &Path) -> PathBuf {
    let link = fs::symlink_metadata(path).is_ok_and(|data| data.is_symlink());
    link.then(|| fs::canonicalize(path).ok())
        .flatten()
        .unwrap_or_else(|| path.to_path_buf())
}

/// Refuses a link inside a folder of results: whoever made the folder could let it lead anywhere,
/// and what is written or removed through it would be somebody's file.
///
/// # Errors
/// `path` is a link, whether or not its target exists.
pub fn refuse_link(path: &Path) -> Result<(), Problem> {
    if !fs::symlink_metadata(path).is_ok_and(|data| data.is_symlink()) {
        return Ok(());
    }
    Err(Problem::new(
        ProblemKind::Io,
        "is a link, and nothing is written through a link in a folder of results",
    )
    .in_file(path)
    .hint("remove the link, or name another folder with `out`"))
}

/// Refuses links among these names in a folder, and among the folders above them.
///
/// # Errors
/// As [`refuse_link`].
pub fn refuse_links<'n>(
    folder: &Path,
    names: impl IntoIterator<Item = &'n str>,
) -> Result<(), Problem> {
    let mut seen = BTreeSet::new();
    for name in names {
        for part in Path::new(name)
            .ancestors()
            .filter(|part| !part.as_os_str().is_empty())
        {
            if !seen.insert(part) {
                break;
            }
            refuse_link(&folder.join(part))?;
        }
    }
    Ok(())
}

/// Refuses links among everything that lies in a folder, and a folder that is a link.
///
/// # Errors
/// As [`refuse_link`].
pub fn refuse_links_in(folder: &Path) -> Result<(), Problem> {
    refuse_link(folder)?;
    fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .try_for_each(|entry| refuse_link(&entry.path()))
}

/// Refuses an output that would replace an input.
///
/// # Errors
/// `output` is one of `inputs`, which are canonical paths.
pub fn refuse_input(inputs: &[PathBuf], output: &Path, hint: &str) -> Result<(), Problem> {
    if inputs.is_empty() || !fs::canonicalize(output).is_ok_and(|output| inputs.contains(&output)) {
        return Ok(());
    }
    Err(Problem::new(
        ProblemKind::Io,
        "is read by this command; its output would replace it",
    )
    .in_file(output)
    .hint(hint))
}

/// The problem of a path without a file name.
pub fn no_name(path: &Path) -> Problem {
    Problem::new(ProblemKind::Io, "is not the name of a file or folder")
        .in_file(path)
        .hint("name a file or folder to create")
}

/// A problem reported by the file system, with a remedy.
pub fn io_problem(path: &Path, what: &str, error: &io::Error) -> Problem {
    let hint = match error.kind() {
        io::ErrorKind::NotFound => "check that the folder exists",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "check the permissions, or choose another place"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "free space on the disk, or choose another place"
        }
        _ => "choose another place",
    };
    Problem::new(ProblemKind::Io, format!("{what}: {error}"))
        .in_file(path)
        .hint(hint)
}
