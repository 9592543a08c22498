//! Names for files in the making, and what is left of them when a process is killed.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use freestand_input::{Problem, ProblemKind};

/// Begins the name of a staging folder inside a target that exists; a number of the process and of the folder follow.
pub const STAGING_PREFIX: &str = ".freestand-partial-";

/// Removes the staging folders (or `files` under a temporary name) of runs that were killed: those for `target` whose
/// process is gone and whose lock is free. Either alone is not enough: another container's processes are
/// not seen here, and not every file system can lock.
pub fn clear_leftovers(target: &Path, files: bool) {
    let beside = target.file_name().map(|name| format!(".{}.partial-", name.to_string_lossy()));
    for (folder, prefix) in [(Some(target), Some(STAGING_PREFIX.to_owned())), (target.parent(), beside)] {
        let (Some(folder), Some(prefix)) = (folder, prefix) else { continue };
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let name = entry.file_name();
            let process = name.to_str().and_then(|name| process_of(name.strip_prefix(&prefix)?));
            let free = || fs::File::open(entry.path()).is_ok_and(|leftover| leftover.try_lock().is_ok());
            if process.is_some_and(is_gone) && free() {
                // A leftover that cannot be removed is untidy, not a failure of this run.
                let _ = match entry.file_type() {
                    Ok(kind) if kind.is_dir() && !files => fs::remove_dir_all(entry.path()),
                    Ok(kind) if kind.is_file() && files => fs::remove_file(entry.path()),
                    _ => Ok(()),
                };
            }
        }
    }
}

/// The process of a name's `PID-N`.
fn process_of(suffix: &str) -> Option<u32> {
    let (process, count) = suffix.split_once('-')?;
    count.parse::<u64>().ok()?;
    process.parse().ok()
}

/// Whether no such process runs; where that cannot be known, it may run.
fn is_gone(process: u32) -> bool {
    let processes = Path::new("/proc");
    cfg!(target_os = "linux") && processes.join("self").exists() && !processes.join(process.to_string()).exists()
}

/// `.NAME.KIND-PID-N` in the same folder: on the same file system, so that the renaming is one step.
pub fn beside(path: &Path, kind: &str) -> Option<PathBuf> {
    let mut name = OsString::from(".");
    name.push(path.file_name()?);
    name.push(OsStr::new(&format!(".{kind}-{}", unique_suffix())));
    Some(path.with_file_name(name))
}

/// `PID-N`: N keeps two threads apart that write to one name.
pub fn unique_suffix() -> String {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    format!("{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed))
}

/// What a link names, where there is one; the path itself otherwise.
pub fn real_path(path: &Path) -> PathBuf {
    let link = fs::symlink_metadata(path).is_ok_and(|data| data.is_symlink());
    link.then(|| fs::canonicalize(path).ok()).flatten().unwrap_or_else(|| path.to_path_buf())
}

/// Refuses an output in the place of an input.
///
/// # Errors
/// `output` is one of `inputs`, which are canonical paths.
pub fn refuse_input(inputs: &[PathBuf], output: &Path, hint: &str) -> Result<(), Problem> {
    if inputs.is_empty() || !fs::canonicalize(output).is_ok_and(|output| inputs.contains(&output)) {
        return Ok(());
    }
    Err(Problem::new(ProblemKind::Io, "is read by this command, and its output would replace it")
        .in_file(output)
        .hint(hint))
}

/// A path without a file name.
pub fn no_name(path: &Path) -> Problem {
    Problem::new(ProblemKind::Io, "is no name for an output").in_file(path).hint("name a file or folder to be made")
}

/// A failure of the file system, with a remedy.
pub fn io_problem(path: &Path, what: &str, error: &io::Error) -> Problem {
    let hint = match error.kind() {
        io::ErrorKind::NotFound => "check that the folder exists",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "check the permissions, or choose another place"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "make room on the disk, or choose another place",
        _ => "choose another place",
    };
    Problem::new(ProblemKind::Io, format!("{what}: {error}")).in_file(path).hint(hint)
}
