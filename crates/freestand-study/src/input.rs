//! The files that results are made from, by their fingerprints.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// A file that was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputFile {
    /// The file.
    pub path: PathBuf,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

impl InputFile {
    /// A file of which these are the bytes.
    pub fn new(path: &Path, bytes: &[u8]) -> Self {
        Self { path: path.to_path_buf(), sha256: sha256_hex(bytes) }
    }
}

/// SHA-256 in hexadecimal.
///
/// # Example
/// ```
/// let digest = freestand_study::input::sha256_hex(b"abc");
/// assert!(digest.starts_with("ba7816bf") && digest.len() == 64);
/// ```
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::with_capacity(64), |mut text, byte| {
        // Writing to a String cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}
