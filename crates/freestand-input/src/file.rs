//! Input files and their fingerprints.

use std::fmt::Write;
use std::fs::File;
use std::io::{IsTerminal, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::OnceLock;

use sha2::{Digest, Sha256};

use crate::problem::{Problem, ProblemKind};

/// A file that was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputFile {
    /// The path of the file.
    pub path: PathBuf,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

impl InputFile {
    /// Describes a file that has these bytes.
    pub fn new(path: &Path, bytes: &[u8]) -> Self {
        Self {
            path: path.to_path_buf(),
            sha256: sha256_hex(bytes),
        }
    }
}

/// SHA-256 in hexadecimal.
///
/// # Example
/// ```
/// let digest = freestand_input::file::sha256_hex(b"abc");
/// assert!(digest.starts_with("ba7816bf") && digest.len() == 64);
/// ```
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .fold(String::with_capacity(64), |mut text, byte| {
            // Writing to a String cannot fail.
            let _ = write!(text, "{byte:02x}");
            text
        })
}

/// The name of a file without its folder, as far as it is text.
pub fn file_name(path: &Path) -> Option<String> {
    path.file_name()
        .map(|name| name.to_string_lossy().into_owned())
}

/// The path of a file that is read where its name says, relative to the current folder.
///
/// # Errors
/// None: others who find files by their names refuse some.
pub fn as_named(name: &str) -> Result<PathBuf, Problem> {
    Ok(PathBuf::from(name))
}

/// The only folder from which this process reads input files, where there is one.
static ONLY_FOLDER: OnceLock<PathBuf> = OnceLock::new();

/// From now on this process reads input files from this folder only, wherever they are named: a flag, a
/// study, or a file that a study names. A program that answers others calls it before it answers.
///
/// The first folder counts; a process has one.
pub fn read_only_from(folder: &Path) {
    let _ = ONLY_FOLDER.set(folder.to_path_buf());
}

/// Refuses a path outside of the only folder from which this process reads, and one in it at which
/// there is nothing. It says the same in both cases, and so does not tell what else there is on the
/// machine. Everything that opens an input file calls it.
///
/// # Errors
/// Such a path.
pub fn check_allowed(path: &Path) -> Result<(), Problem> {
    ONLY_FOLDER
        .get()
        .map_or(Ok(()), |folder| check_in(folder, path))
}

fn check_in(folder: &Path, path: &Path) -> Result<(), Problem> {
    // Only this process writes into the folder, and no links: a path without `..` stays in it.
    let climbs = path.components().any(|part| part == Component::ParentDir);
    if path.starts_with(folder) && !climbs && path.exists() {
        return Ok(());
    }
    // The name as it was written, as far as that is known: the folder itself concerns nobody.
    let named = path
        .strip_prefix(folder)
        .ok()
        .and_then(Path::file_name)
        .map_or(path, Path::new);
    Err(Problem::new(
        ProblemKind::Io,
        format!("{} is not a file of this request", named.display()),
    )
    .hint("upload the file with the request, and name it without a folder"))
}

/// The largest file that is read into memory \[bytes\]: about a hundred million samples, more than
/// any record has.
const MAX_BYTES: u64 = 2 << 30;

/// Reads the bytes of a file. They are read once, because a pipe can be read only once.
pub fn load(path: &Path) -> Result<Vec<u8>, Problem> {
    load_up_to(path, MAX_BYTES, "is longer than 2 GiB", "split the record")
}

/// As [`load`], with another limit of length \[bytes\], and the message and hint for a longer file.
pub fn load_up_to(
    path: &Path,
    most: u64,
    too_long: &str,
    remedy: &str,
) -> Result<Vec<u8>, Problem> {
    let io = |what: &str, error: &std::io::Error| {
        Problem::new(ProblemKind::Io, format!("{what}: {error}"))
            .in_file(path)
            .hint("check the path and its permissions")
    };
    check_allowed(path)?;
    if is_named_pipe(path) {
        return Err(Problem::new(
            ProblemKind::Io,
            "is a named pipe, not a file: reading it might never end",
        )
        .in_file(path)
        .hint("give a regular file"));
    }
    let file = File::open(path).map_err(|error| io("cannot open the file", &error))?;
    // On Unix, opening a folder succeeds; only reading it fails, with an unhelpful message.
    if file.metadata().is_ok_and(|data| data.is_dir()) {
        return Err(Problem::new(ProblemKind::Io, "is a folder, not a file")
            .in_file(path)
            .hint("name the file itself"));
    }
    if is_endless(&file) {
        return Err(Problem::new(ProblemKind::Io, "is a device, not a file")
            .in_file(path)
            .hint("name the file itself"));
    }
    let mut bytes = Vec::new();
    file.take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| io("cannot read the file", &error))?;
    if bytes.len() as u64 > most {
        return Err(Problem::format(too_long, remedy).in_file(path));
    }
    Ok(bytes)
}

/// Whether a file is a pipe that has a name in a folder: opening it waits for a writer. A pipe of a
/// shell, such as `/dev/stdin` or `<(...)`, has no name of its own and already has its writer.
#[cfg(unix)]
fn is_named_pipe(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt;
    let real = path
        .canonicalize()
        .ok()
        .filter(|real| !real.starts_with("/dev/fd"));
    real.and_then(|real| real.metadata().ok())
        .is_some_and(|data| data.file_type().is_fifo())
}

#[cfg(not(unix))]
fn is_named_pipe(_: &Path) -> bool {
    false
}

/// Whether a file is a device, such as /dev/zero: it may have no end. A terminal ends with Ctrl-D.
#[cfg(unix)]
fn is_endless(file: &File) -> bool {
    use std::os::unix::fs::FileTypeExt;
    let kind = file.metadata().map(|data| data.file_type());
    kind.is_ok_and(|kind| kind.is_char_device() || kind.is_block_device()) && !file.is_terminal()
}

#[cfg(not(unix))]
fn is_endless(_: &File) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_is_not_read() {
        // Without an end: a test that reads it takes two gigabytes, and fails by its message.
        let problem = load(Path::new("/dev/zero")).unwrap_err();
        assert_eq!(
            (problem.kind, problem.message.as_str()),
            (ProblemKind::Io, "is a device, not a file")
        );
        assert!(problem.hint.is_some());
    }

    #[cfg(unix)]
    #[test]
    fn a_named_pipe_is_refused_and_that_of_a_shell_read() {
        use std::process::Command;
        let folder = tempfile::tempdir().unwrap();
        let (pipe, link) = (
            folder.path().join("motion.csv"),
            folder.path().join("link.csv"),
        );
        assert!(
            Command::new("mkfifo")
                .arg(&pipe)
                .status()
                .unwrap()
                .success()
        );
        std::os::unix::fs::symlink(&pipe, &link).unwrap();
        for path in [pipe, link] {
            let problem = load(&path).unwrap_err();
            assert_eq!(
                (problem.kind, problem.path.as_deref()),
                (ProblemKind::Io, Some(path.as_path()))
            );
            assert_eq!(problem.hint.as_deref(), Some("give a regular file"));
        }
        let (reader, mut writer) = std::io::pipe().unwrap();
        std::io::Write::write_all(&mut writer, b"id").unwrap();
        drop(writer);
        let path = format!("/dev/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&reader));
        assert_eq!(load(Path::new(&path)), Ok(b"id".to_vec()));
    }

    #[test]
    fn a_folder_is_not_left() {
        let folder = tempfile::tempdir().unwrap();
        let (inside, outside) = (folder.path().join("r1"), folder.path().join("r2"));
        for folder in [&inside, &outside] {
            std::fs::create_dir(folder).unwrap();
            std::fs::write(folder.join("list.csv"), "id").unwrap();
        }
        assert!(check_in(&inside, &inside.join("list.csv")).is_ok());
        assert!(check_in(&inside, &inside).is_ok());
        let missing = check_in(&inside, &inside.join("gone.csv")).unwrap_err();
        assert_eq!(missing.message, "gone.csv is not a file of this request");
        for path in [
            "../r2/list.csv",
            "/etc/passwd",
            "/no/such/file",
            "../r1/list.csv",
        ] {
            let problem = check_in(&inside, &inside.join(path)).unwrap_err();
            // A file that is there is refused in the same words as one that is not.
            assert!(
                problem.message.ends_with("is not a file of this request"),
                "{problem}"
            );
            assert!(
                !problem.message.contains(&*inside.to_string_lossy()),
                "{problem}"
            );
        }
        // The beginning of a name is not a folder.
        let longer = folder.path().join("r11");
        std::fs::write(&longer, "x").unwrap();
        assert!(check_in(&inside, &longer).is_err());
        // Without such a folder everything is read.
        assert!(check_allowed(&outside.join("list.csv")).is_ok());
    }
}
