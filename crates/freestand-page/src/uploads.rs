//! Files that were uploaded: kept in a private temporary folder until the server ends.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use freestand_input::file_names;
use http_body_util::{BodyDataStream, BodyExt};
use hyper::Request;
use hyper::body::Incoming;
use hyper::header::CONTENT_TYPE;
use multer::{Constraints, Multipart, SizeLimit};
use serde::Serialize;
use sha2::{Digest, Sha256};
use tempfile::TempDir;
use tokio::time::timeout;

use crate::assets::hex;
use crate::reply::{Refusal, Status};
use crate::{Kind, Program};

/// Largest file: 64 MiB.
pub const MAX_FILE_BYTES: u64 = 64 << 20;

/// All files together: 256 MiB.
pub const MAX_TOTAL_BYTES: u64 = 256 << 20;

/// How long the next piece of an upload may take to arrive: long enough for a slow connection,
/// short enough to drop a client that has stopped sending.
const PIECE_TIME: Duration = Duration::from_secs(10);

/// The beginning of the names of the folders of servers.
const PREFIX: &str = "freestand-page-";

/// The file in such a folder that its server locks.
const LOCK: &str = "server.lock";

/// Age at which a folder without a locked file is a leftover: a server that starts has just made its
/// folder and not locked it yet.
const LEFTOVER_AGE: Duration = Duration::from_secs(10);

/// The files; each is in a folder of its own, under the name that the user gave it.
pub(crate) struct Uploads {
    folder: TempDir,
    /// Locked as long as the server lives.
    _lock: File,
    kept: Mutex<Kept>,
}

#[derive(Default)]
struct Kept {
    bytes: u64,
    files: Vec<(String, PathBuf)>,
}

/// A file as it is reported back.
#[derive(Debug, Serialize)]
pub(crate) struct Uploaded {
    id: String,
    name: String,
    bytes: u64,
    sha256: String,
    kind: Kind,
}

impl Uploads {
    /// In a new folder; those that servers left which were killed are removed.
    pub(crate) fn new() -> std::io::Result<Self> {
        clear_leftovers(&std::env::temp_dir());
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX);
        // Uploaded files and results concern nobody else on the machine.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
        let folder = builder.tempdir()?;
        let lock = File::create_new(folder.path().join(LOCK))?;
        // Where files cannot be locked, what a killed server leaves stays.
        let _ = lock.try_lock();
        Ok(Self {
            folder,
            _lock: lock,
            kept: Mutex::default(),
        })
    }

    /// Removes everything, also while work still holds the files.
    pub(crate) fn remove(&self) {
        // At the end there is nobody to tell.
        let _ = std::fs::remove_dir_all(self.folder.path());
    }

    /// The folder of everything.
    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The paths of these files in one folder, so that one of them can name another. The same files
    /// get the same folder, so that a job that continues another has the same inputs.
    pub(crate) fn together(&self, ids: &[&str]) -> Result<Vec<PathBuf>, Refusal> {
        // Of fixed length, however many files there are.
        let digest = hex(&Sha256::digest(ids.join(" ")));
        let folder = self
            .folder
            .path()
            .join(format!("together-{}", digest.get(..16).unwrap_or_default()));
        let mut paths: Vec<PathBuf> = Vec::with_capacity(ids.len());
        for id in ids {
            let path = self.path(id)?;
            let Some(name) = path.file_name() else {
                continue;
            };
            let own = folder.join(name);
            if paths.contains(&own) {
                let message = format!("two files of the request are called {}", name.display());
                return Err(Refusal::new(
                    Status::BadInput,
                    "value",
                    message,
                    "rename one of them",
                ));
            }
            paths.push(own);
        }
        let _kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        std::fs::create_dir_all(&folder).map_err(|error| unwritten(&error))?;
        for (id, own) in ids.iter().zip(&paths) {
            let from = self
                .folder
                .path()
                .join(id)
                .join(own.file_name().unwrap_or_default());
            let made = if own.exists() {
                Ok(())
            } else {
                std::fs::hard_link(&from, own)
            };
            made.or_else(|_| std::fs::copy(&from, own).map(|_| ()))
                .map_err(|error| unwritten(&error))?;
        }
        Ok(paths)
    }

    /// The path of a file.
    pub(crate) fn path(&self, id: &str) -> Result<PathBuf, Refusal> {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let found = kept
            .files
            .iter()
            .find(|(own, _)| own == id)
            .map(|(_, path)| path.clone());
        found.ok_or_else(|| {
            Refusal::new(
                Status::BadInput,
                "missing",
                format!("there is no file {id:?}"),
                "upload the file again",
            )
        })
    }

    /// Keeps every file of a form.
    pub(crate) async fn receive(
        &self,
        request: Request<Incoming>,
        program: &Program,
    ) -> Result<Vec<Uploaded>, Refusal> {
        let of_type = request
            .headers()
            .get(CONTENT_TYPE)
            .and_then(|text| text.to_str().ok())
            .unwrap_or_default();
        let Ok(boundary) = multer::parse_boundary(of_type) else {
            let hint = "send the files as multipart/form-data";
            return Err(Refusal::new(
                Status::UnsupportedType,
                "type",
                "files come in a form",
                hint,
            ));
        };
        let limits = SizeLimit::new()
            .whole_stream(MAX_TOTAL_BYTES)
            .per_field(MAX_FILE_BYTES);
        let stream = BodyDataStream::new(request.into_body().map_err(std::io::Error::other));
        let mut form =
            Multipart::with_constraints(stream, boundary, Constraints::new().size_limit(limits));
        let mut uploaded = Vec::new();
        while let Some(mut field) = arrived(form.next_field()).await? {
            let Some(name) = field.file_name().map(clean) else {
                continue;
            };
            let mut staged = tempfile::NamedTempFile::new_in(self.folder.path())
                .map_err(|error| unwritten(&error))?;
            let (mut sha, mut bytes) = (Sha256::new(), 0u64);
            while let Some(chunk) = arrived(field.chunk()).await? {
                sha.update(&chunk);
                bytes += chunk.len() as u64;
                staged
                    .write_all(&chunk)
                    .map_err(|error| unwritten(&error))?;
            }
            uploaded.push(
                self.keep(staged, name, bytes, hex(&sha.finalize()), program)
                    .await?,
            );
        }
        if uploaded.is_empty() {
            let hint = "choose one file or more";
            return Err(Refusal::new(
                Status::BadInput,
                "missing",
                "the form has no file",
                hint,
            ));
        }
        Ok(uploaded)
    }

    async fn keep(
        &self,
        staged: tempfile::NamedTempFile,
        name: String,
        bytes: u64,
        sha256: String,
        program: &Program,
    ) -> Result<Uploaded, Refusal> {
        let (id, path) = {
            let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
            if kept.bytes + bytes > MAX_TOTAL_BYTES {
                return Err(too_large(
                    format!("all files together exceed {}", mebibytes(MAX_TOTAL_BYTES)),
                    "start freestand serve again",
                ));
            }
            let id = format!("f{}", kept.files.len() + 1);
            let folder = self.folder.path().join(&id);
            std::fs::create_dir(&folder).map_err(|error| unwritten(&error))?;
            let path = folder.join(&name);
            let _file: File = staged
                .persist(&path)
                .map_err(|error| unwritten(&error.error))?;
            kept.bytes += bytes;
            kept.files.push((id.clone(), path.clone()));
            (id, path)
        };
        // Reading a large file takes seconds, in which the threads of the server answer others.
        let kind = program.kind;
        let kind = tokio::task::spawn_blocking(move || kind(&path))
            .await
            .unwrap_or(Kind::Unknown);
        Ok(Uploaded {
            id,
            name,
            bytes,
            sha256,
            kind,
        })
    }
}

/// Removes the folders of servers that were killed: their lock is free. A folder of another user cannot
/// be opened, and a link is not followed.
fn clear_leftovers(temporary: &Path) {
    for entry in std::fs::read_dir(temporary).into_iter().flatten().flatten() {
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if !is_folder || !entry.file_name().to_string_lossy().starts_with(PREFIX) {
            continue;
        }
        let lock = File::open(entry.path().join(LOCK));
        let is_old = |lock: &File| {
            let made = lock.metadata().and_then(|data| data.modified()).ok();
            made.and_then(|made| made.elapsed().ok())
                .is_some_and(|age| age >= LEFTOVER_AGE)
        };
        if lock.is_ok_and(|lock| is_old(&lock) && lock.try_lock().is_ok()) {
            let _ = std::fs::remove_dir_all(entry.path());
        }
    }
}

/// The last part of a name, without what a file system takes for something else.
fn clean(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    file_names::made_of(last, " ._-+()", '_').unwrap_or_else(|| "file".to_owned())
}

fn too_large(message: String, hint: &str) -> Refusal {
    Refusal::new(Status::TooLarge, "size", message, hint)
}

/// A size in MiB.
fn mebibytes(bytes: u64) -> String {
    format!("{} MiB", bytes >> 20)
}

fn refused(error: &multer::Error) -> Refusal {
    match error {
        multer::Error::FieldSizeExceeded { .. } => too_large(
            format!("the file is larger than {}", mebibytes(MAX_FILE_BYTES)),
            "use the command line for large files",
        ),
        multer::Error::StreamSizeExceeded { .. } => too_large(
            format!(
                "the files together are larger than {}",
                mebibytes(MAX_TOTAL_BYTES)
            ),
            "use the command line for large files",
        ),
        error => Refusal::new(
            Status::BadInput,
            "format",
            format!("the form cannot be read: {error}"),
            "send the files as multipart/form-data",
        ),
    }
}

/// A piece of a form, or a refusal if it takes too long to arrive.
async fn arrived<T>(piece: impl Future<Output = Result<T, multer::Error>>) -> Result<T, Refusal> {
    let late = || {
        let message = format!(
            "no data of the upload arrived for {} s",
            PIECE_TIME.as_secs()
        );
        Refusal::new(Status::BadInput, "value", message, "upload the files again")
    };
    timeout(PIECE_TIME, piece)
        .await
        .map_err(|_| late())?
        .map_err(|error| refused(&error))
}

fn unwritten(error: &std::io::Error) -> Refusal {
    let hint = "check that the folder for temporary files is not full and can be written";
    Refusal::new(
        Status::Defect,
        "io",
        format!("the file cannot be kept: {error}"),
        hint,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_folder_of_a_killed_server_is_removed_and_no_other() {
        let temporary = tempfile::tempdir().unwrap();
        let folder = |name: &str, age: Duration| {
            let path = temporary.path().join(name);
            std::fs::create_dir(&path).unwrap();
            let lock = File::create_new(path.join(LOCK)).unwrap();
            lock.set_modified(std::time::SystemTime::now() - age)
                .unwrap();
            lock
        };
        let (old, young) = (LEFTOVER_AGE * 2, Duration::ZERO);
        let alive = folder("freestand-page-alive", old);
        alive.try_lock().unwrap();
        drop(folder("freestand-page-killed", old));
        drop(folder("freestand-page-starting", young));
        drop(folder("somebody-else", old));
        std::fs::create_dir(temporary.path().join("freestand-page-of-another-kind")).unwrap();
        clear_leftovers(temporary.path());
        let left = std::fs::read_dir(temporary.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name());
        let mut left: Vec<_> = left.map(|name| name.into_string().unwrap()).collect();
        left.sort_unstable();
        let expected = [
            "freestand-page-alive",
            "freestand-page-of-another-kind",
            "freestand-page-starting",
        ];
        assert_eq!(left, [&expected[..], &["somebody-else"]].concat());
    }

    #[cfg(unix)]
    #[test]
    fn uploads_are_private() {
        use std::os::unix::fs::PermissionsExt;
        let uploads = Uploads::new().unwrap();
        let mode = std::fs::metadata(uploads.folder())
            .unwrap()
            .permissions()
            .mode();
        assert_eq!(mode & 0o777, 0o700);
        uploads.remove();
        assert!(!uploads.folder().exists());
    }

    #[test]
    fn names_are_no_paths() {
        assert_eq!(clean("../../etc/passwd"), "passwd");
        assert_eq!(
            clean("C:\\lists\\Spital Übersicht.xlsx"),
            "Spital Übersicht.xlsx"
        );
        assert_eq!(clean("..."), "file");
        assert_eq!(clean("CON.csv"), "CON_.csv");
        assert_eq!(clean("list.csv. "), "list.csv");
        assert_eq!(clean("a\0b<c>.csv"), "a_b_c_.csv");
        assert!(clean(&format!("{}.csv", "x".repeat(300))).ends_with("x.csv"));
    }
}
