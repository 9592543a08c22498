//! Input files and their fingerprints.

use std::fmt::Write;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

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
        Self { path: path.to_path_buf(), sha256: sha256_hex(bytes) }
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
    Sha256::digest(bytes).iter().fold(String::with_capacity(64), |mut text, byte| {
        // Writing to a String cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// The largest file that is read into memory \[bytes\]: about a hundred million samples, more than
/// any record has.
const MAX_BYTES: u64 = 2 << 30;

/// Reads the bytes of a file. They are read once, because a pipe can be read only once.
pub fn load(path: &Path) -> Result<Vec<u8>, Problem> {
    load_up_to(path, MAX_BYTES, "is longer than 2 GiB", "split the record")
}

/// As [`load`], with another limit of length \[bytes\], and the message and hint for a longer file.
pub fn load_up_to(path: &Path, most: u64, too_long: &str, remedy: &str) -> Result<Vec<u8>, Problem> {
    let io = |what: &str, error: &std::io::Error| {
        Problem::new(ProblemKind::Io, format!("{what}: {error}"))
            .in_file(path)
            .hint("check the path and its permissions")
    };
    let file = File::open(path).map_err(|error| io("cannot open the file", &error))?;
    // On Unix, opening a folder succeeds; only reading it fails, with an unhelpful message.
    if file.metadata().is_ok_and(|data| data.is_dir()) {
        return Err(Problem::new(ProblemKind::Io, "is a folder, not a file")
            .in_file(path)
            .hint("name the file itself"));
    }
    let mut bytes = Vec::new();
    file.take(most + 1).read_to_end(&mut bytes).map_err(|error| io("cannot read the file", &error))?;
    if bytes.len() as u64 > most {
        return Err(Problem::new(ProblemKind::Format, too_long).in_file(path).hint(remedy));
    }
    Ok(bytes)
}
