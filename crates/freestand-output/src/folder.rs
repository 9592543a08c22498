//! Output folders that are either complete or absent: an incomplete file never has its final name.

use crate::paths::{
    STAGING_PREFIX, clear_leftovers, io_problem, no_name, prefix_next_to, real_path, refuse_input, staging_prefix,
};
use crate::streamed::StreamedFile;
use freestand_input::problem::{Problem, ProblemKind};
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};
use tempfile::TempDir;

/// Manifests: a folder with one of these files was written by freestand.
const MANIFESTS: [&str; 2] = [MANIFEST, "summary.json"];

/// The manifest of most commands.
pub const MANIFEST: &str = "manifest.json";

/// Schema of the manifest of an incomplete folder.
const INCOMPLETE: &str = "freestand.incomplete/1";

/// The largest manifest that is read \[bytes\]. Those of freestand are far smaller; another file of
/// that name may have any size.
const MANIFEST_BYTES: u64 = 64 << 20;

const ANOTHER_FOLDER: &str = "name another folder with `out`";

/// Writes a file under a temporary name next to `path`, then renames it. An existing file is
/// replaced; if anything fails, it is unchanged. Files in `inputs` are never replaced.
///
/// # Errors
/// A folder that does not exist or is not writable, a full disk, or a folder with the file's name.
pub fn write_file(path: &Path, bytes: &[u8], inputs: &[PathBuf]) -> Result<(), Problem> {
    let mut file = StreamedFile::begin(path, inputs)?;
    file.write(bytes)?;
    file.finish()
}

/// An output folder that is not complete yet. Files are written to a staging folder and move to the
/// target on [`commit`](OutputFolder::commit). Dropped without a commit, it removes the staging
/// folder and leaves the target unchanged.
///
/// A manifest in the target lists the files of an earlier run. Only those are replaced.
#[derive(Debug)]
pub struct OutputFolder {
    target: PathBuf,
    /// Removed when dropped, unless it became the target.
    staging: TempDir,
    force: bool,
    /// The inputs, which must not be replaced.
    inputs: Vec<PathBuf>,
    /// Locked so that no other process takes the staging folder for a leftover.
    _lock: Option<fs::File>,
}

impl OutputFolder {
    /// Begins a folder that will become `target`. `force` allows writing into a folder with other
    /// files; those remain, unless an output has the same name. Files in `inputs` are never
    /// replaced.
    ///
    /// # Errors
    /// A file with the target's name, a target with other content (without `force`), a folder that
    /// is not writable, or an input among the files to replace. These are checked here, before
    /// hours of work, and again on commit.
    pub fn stage(target: &Path, force: bool, inputs: &[PathBuf]) -> Result<Self, Problem> {
        // "out/." and "out/.." do not end in a name; an absolute path does.
        let target = real_path(&absolute(target)?);
        let parent = target.parent().ok_or_else(|| no_name(&target))?;
        clear_leftovers(&target, false);
        let place = check_replaceable(&target, force)?;
        let inputs: Vec<PathBuf> = inputs.iter().filter_map(|input| fs::canonicalize(input).ok()).collect();
        for name in place.listed() {
            refuse_input(&inputs, &target.join(name), ANOTHER_FOLDER)?;
        }
        // An existing folder may be a mount point, or its parent may not be writable: the
        // staging folder is made inside it.
        let (folder, prefix) = match place {
            Place::Absent => {
                fs::create_dir_all(parent).map_err(|error| io_problem(parent, "cannot create the folder", &error))?;
                (parent, prefix_next_to(&target).ok_or_else(|| no_name(&target))?)
            }
            Place::Folder { .. } => (target.as_path(), staging_prefix().into()),
        };
        let staging = tempfile::Builder::new().prefix(&prefix).tempdir_in(folder).map_err(|error| {
            // tempfile's message names the temporary folder, which means nothing to the user.
            io_problem(&target, "cannot write the output folder", &error.kind().into())
        })?;
        // If a folder cannot be locked, only the process number shows whose it is.
        let lock = fs::File::open(staging.path()).ok().filter(|folder| folder.try_lock().is_ok());
        Ok(Self { target, staging, force, inputs, _lock: lock })
    }

    /// Checks whether files with these names may be put into the folder; to be called before long
    /// work.
    ///
    /// # Errors
    /// A name that would replace an input or, without `force`, a file that freestand did not write.
    pub fn check(&self, names: &[String]) -> Result<(), Problem> {
        let place = check_replaceable(&self.target, self.force)?;
        for name in names {
            let path = self.target.join(name);
            refuse_input(&self.inputs, &path, ANOTHER_FOLDER)?;
            let in_the_way = |what: &str| {
                Problem::new(ProblemKind::Io, format!("{what}; an output file cannot be written there"))
                    .in_file(&path)
                    .hint(ANOTHER_FOLDER)
            };
            for above in Path::new(name).ancestors().skip(1).filter(|above| !above.as_os_str().is_empty()) {
                let file = fs::symlink_metadata(self.target.join(above)).is_ok_and(|data| !data.is_dir());
                if file && !place.lists(above) {
                    return Err(in_the_way(&format!("{} is not a folder", above.display())));
                }
            }
            match fs::symlink_metadata(&path) {
                Ok(data) if data.is_dir() => return Err(in_the_way("is a folder")),
                Ok(_) if !self.force && !place.lists(Path::new(name)) => {
                    return Err(in_the_way("was not written by freestand")
                        .hint("name another folder with `out`, or replace the file with `force = true`"));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Writes a file in the folder; folders in `name` are made.
    ///
    /// # Errors
    /// A name that leaves the folder or was written before, or a disk that is full.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Problem> {
        let mut file = self.begin(name)?;
        file.write(bytes)?;
        file.finish()
    }

    /// Begins a file in the folder that is written in pieces; folders in `name` are made.
    ///
    /// # Errors
    /// A name that leaves the folder or was begun before, or a disk that is full.
    pub fn begin(&self, name: &str) -> Result<StreamedFile, Problem> {
        let path = self.path_of(name)?;
        // Errors name the final place, not the staging folder.
        let target = self.target.join(name);
        let failed = |error: io::Error| io_problem(&target, "cannot write the file", &error);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(failed)?;
        }
        let file = fs::File::create_new(&path).map_err(|error| match error.kind() {
            io::ErrorKind::AlreadyExists => Problem::new(ProblemKind::Value, "two outputs have this name")
                .in_file(&target)
                .hint("request each output once"),
            _ => failed(error),
        })?;
        Ok(StreamedFile::of(file, &target))
    }

    /// The path of a file until the commit, for writers that need a path.
    ///
    /// # Errors
    /// A name that leaves the folder.
    pub fn path_of(&self, name: &str) -> Result<PathBuf, Problem> {
        if !stays_inside(name) {
            return Err(Problem::new(ProblemKind::Value, format!("\"{name}\" is not a name inside the output folder")));
        }
        Ok(self.staging.path().join(name))
    }

    /// The path of a file until the commit, with its folders created, for a file that is linked and
    /// not written.
    ///
    /// # Errors
    /// A name that leaves the folder, or a disk that is full.
    pub fn place_for(&self, name: &str) -> Result<PathBuf, Problem> {
        let path = self.path_of(name)?;
        let made = path.parent().map_or(Ok(()), fs::create_dir_all);
        made.map_err(|error| io_problem(&self.target.join(name), "cannot write the file", &error))?;
        Ok(path)
    }

    /// The names of the files written so far, sorted, with `/` between folder and file.
    ///
    /// # Errors
    /// A staging folder that was removed.
    pub fn names(&self) -> Result<Vec<String>, Problem> {
        let mut names = Vec::new();
        collect_names(self.staging.path(), "", &mut names)
            .map_err(|error| io_problem(&self.target, "cannot read the output folder", &error))?;
        names.sort_unstable();
        Ok(names)
    }

    /// Moves the files into place and returns the path of the folder.
    ///
    /// # Errors
    /// As [`stage`](OutputFolder::stage), if the target has changed since; it is then left
    /// unchanged. If a file cannot be moved in spite of these checks, the manifest says that the
    /// folder is incomplete and lists the files of this run.
    pub fn commit(mut self) -> Result<PathBuf, Problem> {
        let names = self.names()?;
        self.check(&names)?;
        match check_replaceable(&self.target, self.force)? {
            Place::Absent => {
                fs::rename(self.staging.path(), &self.target)
                    .map_err(|error| io_problem(&self.target, "cannot move the folder into place", &error))?;
                self.staging.disable_cleanup(true);
            }
            Place::Folder { listed } => self.move_in(&names, &listed)?,
        }
        Ok(self.target.clone())
    }

    /// Replaces the files of an earlier run, the manifest last.
    fn move_in(&self, names: &[String], listed: &BTreeSet<String>) -> Result<(), Problem> {
        let failed = |name: &str, error: io::Error| {
            io_problem(&self.target.join(name), "cannot move the file into place; the output is incomplete", &error)
        };
        let (manifests, others): (Vec<&String>, Vec<&String>) =
            names.iter().partition(|name| MANIFESTS.contains(&name.as_str()));
        if let Some(manifest) = manifests.first() {
            // Until all files are in place, this manifest lists old and new files and says that the
            // folder is incomplete.
            let all: BTreeSet<&String> = names.iter().chain(listed).collect();
            let text = serde_json::json!({"schema": INCOMPLETE, "files": all}).to_string();
            let marker = self.staging.path().join(".incomplete");
            fs::write(&marker, text)
                .and_then(|()| fs::rename(&marker, self.target.join(manifest)))
                .map_err(|error| failed(manifest, error))?;
        }
        for name in listed.iter().filter(|name| !names.contains(name)) {
            remove_listed(&self.target, name).map_err(|error| failed(name, error))?;
        }
        for name in others.into_iter().chain(manifests) {
            let to = self.target.join(name);
            to.parent()
                .map_or(Ok(()), fs::create_dir_all)
                .and_then(|()| fs::rename(self.staging.path().join(name), &to))
                .map_err(|error| failed(name, error))?;
        }
        Ok(())
    }
}

/// Begins a long run that writes into `target` itself. The folder is created, and its manifest also
/// lists these `names`, so that the files of a killed run are recognised.
///
/// # Errors
/// As [`OutputFolder::stage`].
pub fn announce(target: &Path, force: bool, names: &[String]) -> Result<(), Problem> {
    let target = real_path(&absolute(target)?);
    let listed = match check_replaceable(&target, force)? {
        Place::Absent => BTreeSet::new(),
        Place::Folder { listed } => listed,
    };
    fs::create_dir_all(&target).map_err(|error| io_problem(&target, "cannot create the folder", &error))?;
    let ours: BTreeSet<&String> = names.iter().chain(&listed).collect();
    let text = serde_json::json!({"schema": INCOMPLETE, "files": ours}).to_string();
    write_file(&target.join(MANIFEST), text.as_bytes(), &[])
}

/// What exists at the path of the output folder.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Place {
    Absent,
    /// A folder that may be written into, with the files in it that freestand wrote.
    Folder {
        listed: BTreeSet<String>,
    },
}

impl Place {
    fn listed(&self) -> impl Iterator<Item = &String> {
        let listed = match self {
            Self::Absent => None,
            Self::Folder { listed } => Some(listed),
        };
        listed.into_iter().flatten()
    }

    fn lists(&self, name: &Path) -> bool {
        self.listed().any(|listed| Path::new(listed) == name)
    }
}

/// Adds the names of all files below `folder`.
fn collect_names(folder: &Path, prefix: &str, names: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type()?.is_dir() {
            collect_names(&entry.path(), &format!("{name}/"), names)?;
        } else {
            names.push(name);
        }
    }
    Ok(())
}

/// Whether a name, joined to a folder, stays below that folder.
fn stays_inside(name: &str) -> bool {
    !name.is_empty() && Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

/// Removes a file that a manifest lists, and folders that become empty. A missing file is not an
/// error.
fn remove_listed(target: &Path, name: &str) -> io::Result<()> {
    match fs::remove_file(target.join(name)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    for above in Path::new(name).ancestors().skip(1).filter(|above| !above.as_os_str().is_empty()) {
        if fs::remove_dir(target.join(above)).is_err() {
            break;
        }
    }
    Ok(())
}

/// Checks whether `target` may become the output folder, and finds the files that freestand wrote.
fn check_replaceable(target: &Path, force: bool) -> Result<Place, Problem> {
    let data = match fs::symlink_metadata(target) {
        Ok(data) => data,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Place::Absent),
        Err(error) => return Err(io_problem(target, "cannot inspect the output folder", &error)),
    };
    if !data.is_dir() {
        let what = if data.is_symlink() { "is a broken link" } else { "is a file" };
        return Err(Problem::new(ProblemKind::Io, format!("{what}, so the output folder cannot be created there"))
            .in_file(target)
            .hint(ANOTHER_FOLDER));
    }
    let manifests: Vec<BTreeSet<String>> = MANIFESTS.iter().filter_map(|name| listed_files(target, name)).collect();
    let mut entries =
        fs::read_dir(target).map_err(|error| io_problem(target, "cannot read the output folder", &error))?;
    let staging = |name: &OsStr| name.to_string_lossy().starts_with(STAGING_PREFIX);
    let empty = entries.all(|entry| entry.is_ok_and(|entry| staging(&entry.file_name())));
    if empty || force || !manifests.is_empty() {
        return Ok(Place::Folder { listed: manifests.into_iter().flatten().collect() });
    }
    Err(Problem::new(ProblemKind::Io, "the folder contains files that freestand did not write")
        .in_file(target)
        .hint("name another folder with `out`, or add to this one with `force = true`"))
}

/// The files that a manifest lists, and the manifest itself; `None` if freestand did not write it.
/// A manifest may be forged: names that leave the folder or pass through a link are ignored.
fn listed_files(target: &Path, manifest: &str) -> Option<BTreeSet<String>> {
    let path = target.join(manifest);
    let small = fs::metadata(&path).is_ok_and(|data| data.is_file() && data.len() <= MANIFEST_BYTES);
    let text = small.then(|| fs::read(&path).ok()).flatten()?;
    let value: serde_json::Value = serde_json::from_slice(&text).ok()?;
    value.get("schema")?.as_str().filter(|schema| schema.starts_with("freestand."))?;
    let files = value.get("files").and_then(serde_json::Value::as_array).into_iter().flatten();
    let in_real_folders = |name: &str| {
        let mut above = Path::new(name).ancestors().skip(1).filter(|above| !above.as_os_str().is_empty());
        above.all(|above| fs::symlink_metadata(target.join(above)).is_ok_and(|data| data.is_dir()))
    };
    let is_folder = |name: &str| fs::symlink_metadata(target.join(name)).is_ok_and(|data| data.is_dir());
    let names = files.filter_map(serde_json::Value::as_str);
    let believed = names.filter(|name| stays_inside(name) && in_real_folders(name) && !is_folder(name));
    Some(believed.chain([manifest]).map(str::to_owned).collect())
}

fn absolute(path: &Path) -> Result<PathBuf, Problem> {
    let path = std::path::absolute(path).map_err(|error| io_problem(path, "is not a path", &error))?;
    // Where the path exists, ".." and links above it are resolved as the system does.
    match (path.file_name(), path.parent()) {
        (Some(_), _) => Ok(path),
        _ => fs::canonicalize(&path).map_err(|error| io_problem(&path, "cannot inspect the output folder", &error)),
    }
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
        write_file(&path, b"one", &[]).unwrap();
        write_file(&path, b"two", &[]).unwrap();
        assert_eq!((fs::read(&path).unwrap(), names(folder.path())), (b"two".to_vec(), vec!["a.csv".to_owned()]));
        let absent = folder.path().join("absent/a.csv");
        let problem = write_file(&absent, b"x", &[]).unwrap_err();
        assert_eq!((problem.path.as_deref(), problem.kind), (Some(absent.as_path()), ProblemKind::Io));
        assert!(problem.hint.unwrap().contains("folder exists"));
        assert!(write_file(folder.path(), b"x", &[]).unwrap_err().message.contains("is a folder"));
        assert_eq!(names(folder.path()), ["a.csv"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_said() {
        let full = Path::new("/dev/full");
        if full.exists() {
            let problem = write_file(full, b"x", &[]).unwrap_err();
            assert!(problem.hint.unwrap().contains("free space"), "{}", problem.message);
        }
    }

    #[test]
    fn a_folder_appears_whole() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("deep/out");
        let folder = OutputFolder::stage(&target, false, &[]).unwrap();
        folder.write("summary.json", br#"{"schema":"freestand.run/1","files":["motions/a.csv"]}"#).unwrap();
        folder.write("motions/a.csv", b"1").unwrap();
        assert!(!target.exists());
        assert_eq!(folder.commit().unwrap(), target);
        assert_eq!(names(&target), ["motions", "summary.json"]);
        assert_eq!(names(target.parent().unwrap()), ["out"]);

        // The files that its manifest lists are replaced.
        let folder = OutputFolder::stage(&target, false, &[]).unwrap();
        folder.write("manifest.json", br#"{"a":[1],"schema":"freestand.assess/1"}"#).unwrap();
        folder.commit().unwrap();
        assert_eq!(names(&target), ["manifest.json"]);

        // Dropped, it leaves the old one as it was.
        let folder = OutputFolder::stage(&target, false, &[]).unwrap();
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
        OutputFolder::stage(&target, false, &[]).unwrap().commit().unwrap();
        for (name, content) in [
            ("thesis.doc", &b"years of work"[..]),
            ("manifest.json", br#"{"schema":"other/1"}"#),
            ("manifest.json", br#"{"note":"schema freestand."}"#),
            ("summary.json", b"\"schema\":\"freestand.run/1\""),
            ("summary.json", b""),
        ] {
            fs::write(target.join(name), content).unwrap();
            let problem = OutputFolder::stage(&target, false, &[]).unwrap_err();
            assert!(problem.hint.unwrap().contains("`force = true`"), "{name}");
            assert_eq!(names(parent.path()), ["out"]);
            fs::remove_file(target.join(name)).unwrap();
        }
        // Something that came while we worked.
        let folder = OutputFolder::stage(&target, false, &[]).unwrap();
        fs::write(target.join("thesis.doc"), "years of work").unwrap();
        assert!(folder.commit().is_err());
        assert_eq!((names(&target), names(parent.path())), (vec!["thesis.doc".to_owned()], vec!["out".to_owned()]));
        // With force we add our files and replace only those with our names.
        fs::create_dir(target.join("motions")).unwrap();
        fs::write(target.join("motions/mine.csv"), "mine").unwrap();
        fs::write(target.join("a"), "old").unwrap();
        let folder = OutputFolder::stage(&target, true, &[]).unwrap();
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
            assert!(OutputFolder::stage(&file, force, &[]).unwrap_err().message.contains("is a file"));
            assert!(OutputFolder::stage(&file.join("out"), force, &[]).is_err());
        }
        assert_eq!(fs::read(&file).unwrap(), b"x");
    }

    fn run(target: &Path, force: bool, files: &[&str]) -> Result<PathBuf, Problem> {
        let folder = OutputFolder::stage(target, force, &[])?;
        for name in files {
            folder.write(name, b"new")?;
        }
        let list: Vec<&str> = files.iter().copied().chain(["summary.json"]).collect();
        let summary = serde_json::json!({"schema": "freestand.run/1", "files": list}).to_string();
        folder.write("summary.json", summary.as_bytes())?;
        folder.commit()
    }

    #[test]
    fn only_what_a_manifest_lists_is_replaced() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("out");
        fs::create_dir_all(target.join("motions")).unwrap();
        fs::write(target.join("thesis.doc"), "years of work").unwrap();
        run(&target, true, &["srs.csv", "motions/a.csv", "old/deep/x"]).unwrap();
        fs::write(target.join("notes.md"), "mine").unwrap();
        fs::write(target.join("motions/mine.csv"), "mine").unwrap();
        run(&target, false, &["srs.csv", "motions/b.csv"]).unwrap();
        assert_eq!(names(&target), ["motions", "notes.md", "srs.csv", "summary.json", "thesis.doc"]);
        assert_eq!(names(&target.join("motions")), ["b.csv", "mine.csv"]);
        // A file that nobody listed is in the way: said before the work, and nothing has changed.
        fs::write(target.join("urs.csv"), "mine").unwrap();
        let folder = OutputFolder::stage(&target, false, &[]).unwrap();
        assert!(folder.check(&["urs.csv".to_owned()]).unwrap_err().hint.unwrap().contains("`force = true`"));
        drop(folder);
        assert!(run(&target, false, &["urs.csv", "motions/c.csv"]).is_err());
        assert!(run(&target, true, &["thesis.doc/x"]).unwrap_err().message.contains("not a folder"));
        assert!(run(&target, true, &["motions"]).unwrap_err().message.contains("is a folder"));
        assert_eq!(names(&target), ["motions", "notes.md", "srs.csv", "summary.json", "thesis.doc", "urs.csv"]);
        assert_eq!(names(&target.join("motions")), ["b.csv", "mine.csv"]);
        run(&target, true, &["urs.csv"]).unwrap();
        assert_eq!(fs::read(target.join("urs.csv")).unwrap(), b"new");
        assert_eq!(names(parent.path()), ["out"]);
    }

    #[test]
    fn a_manifest_does_not_lead_out_of_its_folder() {
        let parent = tempfile::tempdir().unwrap();
        let (target, other) = (parent.path().join("out"), parent.path().join("other"));
        for folder in [&target, &other] {
            fs::create_dir(folder).unwrap();
        }
        fs::write(other.join("precious"), "x").unwrap();
        let absolute = other.join("precious");
        let mut files = vec!["../other/precious", "..", "", "sub", absolute.to_str().unwrap()];
        fs::create_dir(target.join("sub")).unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&other, target.join("link")).unwrap();
            files.push("link/precious");
        }
        let manifest = serde_json::json!({"schema": "freestand.run/1", "files": files}).to_string();
        fs::write(target.join("summary.json"), manifest).unwrap();
        run(&target, false, &["a"]).unwrap();
        assert_eq!(names(&other), ["precious"]);
        assert!(target.join("sub").is_dir());
        #[cfg(unix)]
        assert!(run(&target, true, &["link/a"]).is_err() && names(&other) == ["precious"]);
    }

    #[test]
    fn an_input_is_no_place_for_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let record = folder.path().join("record.csv");
        fs::write(&record, "recorded").unwrap();
        let problem = write_file(&record, b"computed", std::slice::from_ref(&record)).unwrap_err();
        assert!(problem.message.contains("is read by this command"), "{problem}");
        assert_eq!(fs::read(&record).unwrap(), b"recorded");
    }

    #[test]
    fn inputs_are_not_replaced() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("y");
        run(&target, false, &["rec.csv"]).unwrap();
        fs::write(target.join("own.csv"), "mine").unwrap();
        let listed = OutputFolder::stage(&target, true, &[target.join("rec.csv")]).unwrap_err();
        assert!(listed.message.contains("read by this command"));
        let folder = OutputFolder::stage(&target, true, &[target.join("../y/own.csv")]).unwrap();
        assert!(folder.check(&["own.csv".to_owned()]).is_err());
        folder.write("own.csv", b"new").unwrap();
        assert!(folder.commit().is_err());
        assert_eq!(fs::read(target.join("own.csv")).unwrap(), b"mine");
        assert_eq!(names(&target), ["own.csv", "rec.csv", "summary.json"]);
    }

    /// It may be a mount point, which cannot be renamed, and its permissions are the user's.
    #[cfg(unix)]
    #[test]
    fn an_empty_folder_stays_the_same_folder() {
        use std::os::unix::fs::{MetadataExt, PermissionsExt};
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("out");
        fs::create_dir(&target).unwrap();
        fs::set_permissions(&target, fs::Permissions::from_mode(0o750)).unwrap();
        let facts = || fs::metadata(&target).map(|data| (data.ino(), data.mode())).unwrap();
        let before = facts();
        let folder = OutputFolder::stage(&target, false, &[]).unwrap();
        assert_eq!(names(parent.path()), ["out"]);
        folder.write("a", b"1").unwrap();
        folder.commit().unwrap();
        assert_eq!((facts(), names(&target)), (before, vec!["a".to_owned()]));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn leftovers_of_the_dead_are_cleared() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("out");
        // No process has a number above 2^22, the kernel's limit.
        let dead = ".out.partial-4194999-0";
        let others = [".out.partial-1-0", ".out.partial-4194999", ".out2.partial-4194999-0", "out.partial-4194999-0"];
        for name in others.iter().chain([&dead]) {
            fs::create_dir(parent.path().join(name)).unwrap();
            fs::write(parent.path().join(name).join("a"), "x").unwrap();
        }
        fs::write(parent.path().join(".out.partial-4194999-7"), "a file").unwrap();
        drop(OutputFolder::stage(&target, false, &[]).unwrap());
        let left = names(parent.path());
        assert!(!left.contains(&dead.to_owned()) && left.len() == others.len() + 1, "{left:?}");
        // Inside a target that exists they make no content of it, and a lock protects whoever has
        // another kernel's view.
        for name in [".freestand-partial-4194999-0", ".freestand-partial-4194998-0"] {
            fs::create_dir_all(target.join(name)).unwrap();
        }
        let alive = fs::File::open(target.join(".freestand-partial-4194998-0")).unwrap();
        alive.try_lock().unwrap();
        drop(OutputFolder::stage(&target, false, &[]).unwrap());
        assert_eq!(names(&target), [".freestand-partial-4194998-0"]);
    }

    #[test]
    fn an_output_has_one_name() {
        let parent = tempfile::tempdir().unwrap();
        let folder = OutputFolder::stage(&parent.path().join("out"), false, &[]).unwrap();
        folder.write("motions/a", b"1").unwrap();
        assert!(folder.write("motions/a", b"2").unwrap_err().message.contains("two outputs"));
        assert_eq!(folder.names().unwrap(), ["motions/a"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_links() {
        let parent = tempfile::tempdir().unwrap();
        let (real, link) = (parent.path().join("real"), parent.path().join("link"));
        fs::create_dir(&real).unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        let folder = OutputFolder::stage(&link, false, &[]).unwrap();
        folder.write("a", b"1").unwrap();
        folder.commit().unwrap();
        assert_eq!((names(&real), fs::read_link(&link).unwrap()), (vec!["a".to_owned()], real.clone()));
        std::os::unix::fs::symlink(real.join("a"), parent.path().join("file")).unwrap();
        write_file(&parent.path().join("file"), b"2", &[]).unwrap();
        assert_eq!(fs::read(real.join("a")).unwrap(), b"2");
        std::os::unix::fs::symlink(parent.path().join("nothing"), parent.path().join("dangling")).unwrap();
        let problem = OutputFolder::stage(&parent.path().join("dangling"), false, &[]).unwrap_err();
        assert!(problem.message.contains("broken link"));
    }

    #[test]
    fn names_stay_inside() {
        let parent = tempfile::tempdir().unwrap();
        let folder = OutputFolder::stage(&parent.path().join("out"), false, &[]).unwrap();
        for name in ["", "..", "../x", "/etc/x", "a/../../x", "."] {
            assert!(folder.write(name, b"x").is_err(), "{name}");
        }
        assert_eq!(names(folder.staging.path()).len(), 0);
        assert!(OutputFolder::stage(Path::new("/"), true, &[]).is_err());
    }
}
