//! Output that is either complete or not there: nothing half-written is ever found under the name that was asked for.

use crate::error::{Problem, ProblemKind};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Files by which we know a folder as ours.
const MANIFESTS: [&str; 2] = ["manifest.json", "summary.json"];

/// Most of a manifest that is read to see whose it is. Ours are far shorter; a stranger's may be of any size.
const MANIFEST_BYTES: u64 = 64 << 20;

/// Writes a file under a temporary name beside `path`, then gives it its name. A file that was there is replaced; if
/// anything fails it stays as it was.
///
/// # Errors
/// A folder that is absent or may not be written, a full disk, or a folder in the file's place.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Problem> {
    let failed = |error: io::Error| io_problem(path, "cannot write the file", &error);
    if path.is_dir() {
        return Err(Problem::new(ProblemKind::Io, "is a folder, a file is to be written there")
            .in_file(path)
            .hint("name a file"));
    }
    // A device such as /dev/null or a pipe is written into, not replaced by a file.
    if fs::metadata(path).is_ok_and(|data| !data.is_file()) {
        return fs::write(path, bytes).map_err(failed);
    }
    // A link stays a link: the file that it names is the one to replace.
    let path = &real_path(path);
    let temporary = beside(path, "partial").ok_or_else(|| no_name(path))?;
    let result = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path));
    if result.is_err() {
        // The first error is the one to report; what could not be written may well not be there to remove.
        let _ = fs::remove_file(&temporary);
    }
    result.map_err(failed)
}

/// An output folder in the making. What is written goes to a folder beside the target, which takes its place on
/// [`commit`](OutputFolder::commit); dropped without it, everything is removed and the target is untouched.
#[derive(Debug)]
pub struct OutputFolder {
    target: PathBuf,
    staging: PathBuf,
    force: bool,
    committed: bool,
}

impl OutputFolder {
    /// Begins a folder that will be `target`. `force` allows to write into a folder with other
    /// files, which stay.
    ///
    /// # Errors
    /// A file in the target's place, a target with content that is not ours (without `force`), or a parent folder that
    /// may not be written. All this is found now, before hours of work, and again on commit.
    pub fn stage(target: &Path, force: bool) -> Result<Self, Problem> {
        // "out/." and "out/.." have no name that a sibling could be made from; absolute paths settle "." too.
        let target = real_path(&absolute(target)?);
        check_replaceable(&target, force)?;
        let parent = target.parent().ok_or_else(|| no_name(&target))?;
        fs::create_dir_all(parent).map_err(|error| io_problem(parent, "cannot make the folder", &error))?;
        let staging = beside(&target, "partial").ok_or_else(|| no_name(&target))?;
        // One left over from a killed run that had our process number is ours to clear.
        remove_if_there(&staging).map_err(|error| io_problem(&staging, "cannot clear the folder", &error))?;
        fs::create_dir(&staging).map_err(|error| io_problem(&target, "cannot make the folder", &error))?;
        Ok(Self { target, staging, force, committed: false })
    }

    /// Writes a file in the folder; folders in `name` are made.
    ///
    /// # Errors
    /// A name that leaves the folder, or a disk that is full.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Problem> {
        let path = self.path_of(name)?;
        // Errors name the place that the user knows, not the staging folder.
        let failed = |error: io::Error| io_problem(&self.target.join(name), "cannot write the file", &error);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(failed)?;
        }
        fs::write(&path, bytes).map_err(failed)
    }

    /// Where a file of the folder is until the commit, for writers that need a path of their own.
    ///
    /// # Errors
    /// A name that leaves the folder.
    pub fn path_of(&self, name: &str) -> Result<PathBuf, Problem> {
        let relative = Path::new(name);
        let inside = relative.components().all(|part| matches!(part, Component::Normal(_)));
        if name.is_empty() || !inside {
            return Err(Problem::new(ProblemKind::Value, format!("\"{name}\" is no name inside the output folder")));
        }
        Ok(self.staging.join(relative))
    }

    /// Puts the folder in its place and returns its path.
    ///
    /// # Errors
    /// As [`stage`](OutputFolder::stage), if the target has changed since. The target is then as it was.
    pub fn commit(mut self) -> Result<PathBuf, Problem> {
        let place = check_replaceable(&self.target, self.force)?;
        let failed = |error: io::Error| io_problem(&self.target, "cannot put the folder in place", &error);
        match place {
            Place::Free => fs::rename(&self.staging, &self.target).map_err(failed)?,
            Place::Ours => {
                let old = beside(&self.target, "old").ok_or_else(|| no_name(&self.target))?;
                remove_if_there(&old).map_err(failed)?;
                fs::rename(&self.target, &old).map_err(failed)?;
                if let Err(error) = fs::rename(&self.staging, &self.target) {
                    // Back to what was there; if even that fails, the first error says where the trouble is.
                    let _ = fs::rename(&old, &self.target);
                    return Err(failed(error));
                }
                // The results are in place: an old folder that cannot be removed is untidy, not a failure of the run.
                let _ = fs::remove_dir_all(&old);
            }
            // Somebody else's files stay: ours move in among them, one by one.
            Place::Foreign => move_into(&self.staging, &self.target).map_err(failed)?,
        }
        // With strangers' files the emptied staging folder is left for `drop` to remove.
        self.committed = !matches!(place, Place::Foreign);
        Ok(self.target.clone())
    }
}

/// What stands where the output folder is to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// Nothing, or an empty folder.
    Free,
    /// Results of an earlier run.
    Ours,
    /// Other files, and leave to write among them.
    Foreign,
}

/// Moves every file below `from` to the same place below `to`, replacing files of the same name.
fn move_into(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            move_into(&entry.path(), &target)?;
        } else {
            fs::rename(entry.path(), &target)?;
        }
    }
    Ok(())
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        if !self.committed {
            let _ = fs::remove_dir_all(&self.staging);
        }
    }
}

/// Whether `target` may become our output folder.
fn check_replaceable(target: &Path, force: bool) -> Result<Place, Problem> {
    let data = match fs::symlink_metadata(target) {
        Ok(data) => data,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Place::Free),
        Err(error) => return Err(io_problem(target, "cannot look at the output folder", &error)),
    };
    if !data.is_dir() {
        let what = if data.is_symlink() { "is a link to nothing" } else { "is a file" };
        return Err(Problem::new(ProblemKind::Io, format!("{what}, the output folder is to be there"))
            .in_file(target)
            .hint("name another folder with --out"));
    }
    let mut entries =
        fs::read_dir(target).map_err(|error| io_problem(target, "cannot read the output folder", &error))?;
    if entries.next().is_none() {
        return Ok(Place::Free);
    }
    if MANIFESTS.iter().any(|name| is_our_manifest(&target.join(name))) {
        return Ok(Place::Ours);
    }
    if force {
        return Ok(Place::Foreign);
    }
    Err(Problem::new(ProblemKind::Io, "the folder holds files that are not results of freestand")
        .in_file(target)
        .hint("name another folder with --out, or write among them with --force"))
}

/// Whether the file is a JSON object whose `"schema"` begins with `freestand.`.
fn is_our_manifest(path: &Path) -> bool {
    let small = fs::metadata(path).is_ok_and(|data| data.is_file() && data.len() <= MANIFEST_BYTES);
    let Some(text) = small.then(|| fs::read(path).ok()).flatten() else { return false };
    let value: Option<serde_json::Value> = serde_json::from_slice(&text).ok();
    value.is_some_and(|value| {
        value.get("schema").and_then(serde_json::Value::as_str).is_some_and(|schema| schema.starts_with("freestand."))
    })
}

/// `.NAME.KIND-PID-N` in the same folder: on the same file system, so that the renaming is one step. N keeps two threads
/// apart that write to one name.
fn beside(path: &Path, kind: &str) -> Option<PathBuf> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let mut name = OsString::from(".");
    name.push(path.file_name()?);
    name.push(OsStr::new(&format!(".{kind}-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed))));
    Some(path.with_file_name(name))
}

/// What a link names, where there is one; the path itself otherwise.
fn real_path(path: &Path) -> PathBuf {
    let link = fs::symlink_metadata(path).is_ok_and(|data| data.is_symlink());
    link.then(|| fs::canonicalize(path).ok()).flatten().unwrap_or_else(|| path.to_path_buf())
}

fn absolute(path: &Path) -> Result<PathBuf, Problem> {
    let path = std::path::absolute(path).map_err(|error| io_problem(path, "is no path", &error))?;
    // Where the path exists, ".." and links above it are resolved as the system does.
    match (path.file_name(), path.parent()) {
        (Some(_), _) => Ok(path),
        _ => fs::canonicalize(&path).map_err(|error| io_problem(&path, "cannot look at the output folder", &error)),
    }
}

fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_dir_all(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        other => other,
    }
}

fn no_name(path: &Path) -> Problem {
    Problem::new(ProblemKind::Io, "is no name for an output").in_file(path).hint("name a file or folder to be made")
}

fn io_problem(path: &Path, what: &str, error: &io::Error) -> Problem {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_whole_or_not_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        write_file(&path, b"one").unwrap();
        write_file(&path, b"two").unwrap();
        assert_eq!((fs::read(&path).unwrap(), names(folder.path())), (b"two".to_vec(), vec!["a.csv".to_owned()]));
        let absent = folder.path().join("absent/a.csv");
        let problem = write_file(&absent, b"x").unwrap_err();
        assert_eq!((problem.path.as_deref(), problem.kind), (Some(absent.as_path()), ProblemKind::Io));
        assert!(problem.hint.unwrap().contains("folder exists"));
        assert!(write_file(folder.path(), b"x").unwrap_err().message.contains("is a folder"));
        assert_eq!(names(folder.path()), ["a.csv"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_said() {
        let full = Path::new("/dev/full");
        if full.exists() {
            let problem = write_file(full, b"x").unwrap_err();
            assert!(problem.hint.unwrap().contains("make room"), "{}", problem.message);
        }
    }

    #[test]
    fn a_folder_appears_whole() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("deep/out");
        let folder = OutputFolder::stage(&target, false).unwrap();
        folder.write("summary.json", br#"{"schema":"freestand.run/1"}"#).unwrap();
        folder.write("motions/a.csv", b"1").unwrap();
        assert!(!target.exists());
        assert_eq!(folder.commit().unwrap(), target);
        assert_eq!(names(&target), ["motions", "summary.json"]);
        assert_eq!(names(target.parent().unwrap()), ["out"]);

        // Ours is replaced as a whole; files of the old run do not stay.
        let folder = OutputFolder::stage(&target, false).unwrap();
        folder.write("manifest.json", br#"{"a":[1],"schema":"freestand.assess/1"}"#).unwrap();
        folder.commit().unwrap();
        assert_eq!(names(&target), ["manifest.json"]);

        // Dropped, it leaves the old one as it was.
        let folder = OutputFolder::stage(&target, false).unwrap();
        folder.write("x", b"1").unwrap();
        drop(folder);
        assert_eq!(
            (names(&target), names(target.parent().unwrap())),
            (vec!["manifest.json".to_owned()], vec!["out".to_owned()])
        );
    }

    #[test]
    fn what_is_not_ours_is_not_touched() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("out");
        fs::create_dir(&target).unwrap();
        OutputFolder::stage(&target, false).unwrap().commit().unwrap();
        for (name, content) in [
            ("thesis.doc", &b"years of work"[..]),
            ("manifest.json", br#"{"schema":"other/1"}"#),
            ("manifest.json", br#"{"note":"schema freestand."}"#),
            ("summary.json", b"\"schema\":\"freestand.run/1\""),
            ("summary.json", b""),
        ] {
            fs::write(target.join(name), content).unwrap();
            let problem = OutputFolder::stage(&target, false).unwrap_err();
            assert!(problem.hint.unwrap().contains("--force"), "{name}");
            assert_eq!(names(parent.path()), ["out"]);
            fs::remove_file(target.join(name)).unwrap();
        }
        // Something that came while we worked.
        let folder = OutputFolder::stage(&target, false).unwrap();
        fs::write(target.join("thesis.doc"), "years of work").unwrap();
        assert!(folder.commit().is_err());
        assert_eq!((names(&target), names(parent.path())), (vec!["thesis.doc".to_owned()], vec!["out".to_owned()]));
        // With --force we move in beside it, and replace only what has our names.
        fs::create_dir(target.join("motions")).unwrap();
        fs::write(target.join("motions/mine.csv"), "mine").unwrap();
        fs::write(target.join("a"), "old").unwrap();
        let folder = OutputFolder::stage(&target, true).unwrap();
        folder.write("a", b"1").unwrap();
        folder.write("motions/b", b"2").unwrap();
        folder.commit().unwrap();
        assert_eq!(
            (names(&target), names(parent.path())),
            (vec!["a", "motions", "thesis.doc"].into_iter().map(str::to_owned).collect(), vec!["out".to_owned()])
        );
        assert_eq!(names(&target.join("motions")), ["b", "mine.csv"]);
        assert_eq!(fs::read(target.join("a")).unwrap(), b"1");
        // A file in the folder's place stays, whatever is asked.
        let file = parent.path().join("file");
        fs::write(&file, "x").unwrap();
        for force in [false, true] {
            assert!(OutputFolder::stage(&file, force).unwrap_err().message.contains("is a file"));
            assert!(OutputFolder::stage(&file.join("out"), force).is_err());
        }
        assert_eq!(fs::read(&file).unwrap(), b"x");
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_links() {
        let parent = tempfile::tempdir().unwrap();
        let (real, link) = (parent.path().join("real"), parent.path().join("link"));
        fs::create_dir(&real).unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        let folder = OutputFolder::stage(&link, false).unwrap();
        folder.write("a", b"1").unwrap();
        folder.commit().unwrap();
        assert_eq!((names(&real), fs::read_link(&link).unwrap()), (vec!["a".to_owned()], real.clone()));
        std::os::unix::fs::symlink(real.join("a"), parent.path().join("file")).unwrap();
        write_file(&parent.path().join("file"), b"2").unwrap();
        assert_eq!(fs::read(real.join("a")).unwrap(), b"2");
        std::os::unix::fs::symlink(parent.path().join("nothing"), parent.path().join("dangling")).unwrap();
        let problem = OutputFolder::stage(&parent.path().join("dangling"), false).unwrap_err();
        assert!(problem.message.contains("link to nothing"));
    }

    #[test]
    fn names_stay_inside() {
        let parent = tempfile::tempdir().unwrap();
        let folder = OutputFolder::stage(&parent.path().join("out"), false).unwrap();
        for name in ["", "..", "../x", "/etc/x", "a/../../x", "."] {
            assert!(folder.write(name, b"x").is_err(), "{name}");
        }
        assert_eq!(names(&folder.staging).len(), 0);
        assert!(OutputFolder::stage(Path::new("/"), true).is_err());
    }
}
