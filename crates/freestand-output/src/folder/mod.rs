//! Output folders that are either complete or absent: an incomplete file never has its final name.
//!
//! A folder belongs to the command of its manifest. That command replaces its own files again, but
//! only while they are as it wrote them: the manifest has their hashes. Nothing else in the folder
//! is replaced or removed. With `force`, files of the same names are replaced all the same; what is
//! not in the manifest, or was edited, is never removed.

mod earlier;

use crate::paths::{
    clear_leftovers, io_problem, no_name, prefix_next_to, real_path, refuse_input, refuse_links,
    staging_prefix,
};
use crate::streamed::StreamedFile;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::counted;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

use earlier::{
    Earlier, Place, check_replaceable, command_of, hash_of, manifest_command, stays_inside,
};

/// Manifests: a folder with one of these files was written by freestand.
const MANIFESTS: [&str; 3] = [MANIFEST, "summary.json", PLAN];

/// The manifest of most commands.
pub const MANIFEST: &str = "manifest.json";

/// The manifest of an assessment that is divided into shards.
pub const PLAN: &str = "plan.json";

/// Schema of the manifest of an incomplete folder.
const INCOMPLETE: &str = "freestand.incomplete/1";

/// The key of a manifest with the hash of each file.
const HASHES: &str = "files_sha256";

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
/// A manifest in the target lists the files of an earlier run and their hashes. Only those are
/// replaced.
#[derive(Debug)]
pub struct OutputFolder {
    target: PathBuf,
    /// Removed when dropped, unless it became the target.
    staging: TempDir,
    force: bool,
    /// The command, if it is known before its manifest is written.
    command: Option<String>,
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
        let inputs: Vec<PathBuf> = inputs
            .iter()
            .filter_map(|input| fs::canonicalize(input).ok())
            .collect();
        for name in place.listed() {
            refuse_input(&inputs, &target.join(name), ANOTHER_FOLDER)?;
        }
        // An existing folder may be a mount point, or its parent may not be writable: the
        // staging folder is made inside it.
        let (folder, prefix) = match place {
            Place::Absent => {
                fs::create_dir_all(parent)
                    .map_err(|error| io_problem(parent, "cannot create the folder", &error))?;
                (
                    parent,
                    prefix_next_to(&target).ok_or_else(|| no_name(&target))?,
                )
            }
            Place::Folder { .. } => (target.as_path(), staging_prefix().into()),
        };
        let staging = tempfile::Builder::new()
            .prefix(&prefix)
            .tempdir_in(folder)
            .map_err(|error| {
                // tempfile's message names the temporary folder, which means nothing to the user.
                io_problem(
                    &target,
                    "cannot write the output folder",
                    &error.kind().into(),
                )
            })?;
        // If a folder cannot be locked, only the process number shows whose it is.
        let lock = fs::File::open(staging.path())
            .ok()
            .filter(|folder| folder.try_lock().is_ok());
        Ok(Self {
            target,
            staging,
            force,
            command: None,
            inputs,
            _lock: lock,
        })
    }

    /// The same folder, of the command with this schema: refuses at once, before long work, what
    /// [`commit`](Self::commit) would refuse.
    ///
    /// # Errors
    /// Without `force`: a folder of another command, or one in which a file of the earlier run was
    /// edited.
    pub fn of_command(mut self, schema: &str) -> Result<Self, Problem> {
        let command = command_of(schema);
        if !self.force {
            check_replaceable(&self.target, false)?.check_owner(&self.target, &command)?;
        }
        self.command = Some(command);
        Ok(self)
    }

    /// Checks whether files with these names may be put into the folder; to be called before long
    /// work.
    ///
    /// # Errors
    /// A name that would replace an input or, without `force`, a file that freestand did not write.
    pub fn check(&self, names: &[String]) -> Result<(), Problem> {
        let place = check_replaceable(&self.target, self.force)?;
        refuse_links(&self.target, names.iter().map(String::as_str))?;
        for name in names {
            let path = self.target.join(name);
            refuse_input(&self.inputs, &path, ANOTHER_FOLDER)?;
            let in_the_way = |what: &str| {
                Problem::new(
                    ProblemKind::Io,
                    format!("{what}; an output file cannot be written there"),
                )
                .in_file(&path)
                .hint(ANOTHER_FOLDER)
            };
            for above in Path::new(name)
                .ancestors()
                .skip(1)
                .filter(|above| !above.as_os_str().is_empty())
            {
                let file =
                    fs::symlink_metadata(self.target.join(above)).is_ok_and(|data| !data.is_dir());
                if file && !place.lists(above) {
                    return Err(in_the_way(&format!("{} is not a folder", above.display())));
                }
            }
            match fs::symlink_metadata(&path) {
                Ok(data) if data.is_dir() => return Err(in_the_way("is a folder")),
                Ok(_) if !self.force && !place.lists(Path::new(name)) => {
                    return Err(in_the_way("was not written by freestand").hint(
                        "name another folder with `out`, or replace the file with `force = true`",
                    ));
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
            io::ErrorKind::AlreadyExists => {
                Problem::new(ProblemKind::Value, "two outputs have this name")
                    .in_file(&target)
                    .hint("request each output once")
            }
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
            return Err(Problem::new(
                ProblemKind::Value,
                format!("\"{name}\" is not a name inside the output folder"),
            ));
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

    /// Moves the files into place. The manifest gets the hashes of all other files.
    ///
    /// # Errors
    /// As [`stage`](OutputFolder::stage), if the target has changed since; it is then left
    /// unchanged. If a file cannot be moved in spite of these checks, the manifest says that the
    /// folder is incomplete and lists the files of this run.
    pub fn commit(mut self) -> Result<Committed, Problem> {
        let names = self.names()?;
        self.check(&names)?;
        let hashes = self.hashes(&names)?;
        let found = self.add_hashes(&names, &hashes)?;
        let command = found.or(self.command.take());
        let place = check_replaceable(&self.target, self.force)?;
        if let Some(command) = command.as_deref().filter(|_| !self.force) {
            place.check_owner(&self.target, command)?;
        }
        let removed = match place {
            Place::Absent => {
                fs::rename(self.staging.path(), &self.target).map_err(|error| {
                    io_problem(&self.target, "cannot move the folder into place", &error)
                })?;
                self.staging.disable_cleanup(true);
                Vec::new()
            }
            Place::Folder { earlier } => {
                let own: Vec<Earlier> = earlier
                    .into_iter()
                    .filter(|one| command.as_ref().is_none_or(|own| one.command == *own))
                    .collect();
                self.move_in(&names, &own, command.as_deref())?
            }
        };
        Ok(Committed {
            folder: self.target.clone(),
            removed,
        })
    }

    /// The hash of each file written so far, except manifests.
    fn hashes(&self, names: &[String]) -> Result<BTreeMap<String, String>, Problem> {
        let mut hashes = BTreeMap::new();
        for name in names
            .iter()
            .filter(|name| !MANIFESTS.contains(&name.as_str()))
        {
            let hash = hash_of(&self.staging.path().join(name)).map_err(|error| {
                io_problem(
                    &self.target.join(name),
                    "cannot read the file again",
                    &error,
                )
            })?;
            hashes.insert(name.clone(), hash);
        }
        Ok(hashes)
    }

    /// Adds the hashes to the manifest, and returns the command that it names.
    fn add_hashes(
        &self,
        names: &[String],
        hashes: &BTreeMap<String, String>,
    ) -> Result<Option<String>, Problem> {
        let Some(manifest) = MANIFESTS
            .into_iter()
            .find(|manifest| names.iter().any(|name| name == manifest))
        else {
            return Ok(None);
        };
        let path = self.staging.path().join(manifest);
        let failed = |error: io::Error| {
            io_problem(
                &self.target.join(manifest),
                "cannot write the manifest",
                &error,
            )
        };
        let text = fs::read(&path).map_err(failed)?;
        // A manifest that is not an object is not ours to change.
        let Ok(serde_json::Value::Object(mut keys)) = serde_json::from_slice(&text) else {
            return Ok(None);
        };
        let command = manifest_command(&keys);
        keys.insert(HASHES.to_owned(), serde_json::json!(hashes));
        let mut text = serde_json::to_string_pretty(&keys).map_err(|error| failed(error.into()))?;
        text.push('\n');
        fs::write(&path, text).map_err(failed)?;
        Ok(command)
    }

    /// Replaces the files of an earlier run, the manifest last; returns the names of the files that
    /// it removed.
    fn move_in(
        &self,
        names: &[String],
        earlier: &[Earlier],
        command: Option<&str>,
    ) -> Result<Vec<String>, Problem> {
        let failed = |name: &str, error: io::Error| {
            io_problem(
                &self.target.join(name),
                "cannot move the file into place; the output is incomplete",
                &error,
            )
        };
        let (manifests, others): (Vec<&String>, Vec<&String>) = names
            .iter()
            .partition(|name| MANIFESTS.contains(&name.as_str()));
        // An edited file, which is here only with `force`, is the user's: it stays.
        let goes = |one: &&Earlier, name: &str| {
            !names.iter().any(|new| new == name)
                && (one.in_progress.contains(name) || one.is_as_written(&self.target, name))
        };
        let removed: BTreeSet<&String> = earlier
            .iter()
            .flat_map(|one| one.files.iter().filter(move |name| goes(&one, name)))
            .filter(|name| !MANIFESTS.contains(&name.as_str()) || !manifests.is_empty())
            .collect();
        if let Some(manifest) = manifests.first() {
            // Until all files are in place, this manifest lists old and new files and says that the
            // folder is incomplete.
            let all: BTreeSet<&String> = names.iter().chain(removed.iter().copied()).collect();
            let text = incomplete(command.unwrap_or_default(), &all, &all, &BTreeMap::new());
            let marker = self.staging.path().join(".incomplete");
            fs::write(&marker, text)
                .and_then(|()| fs::rename(&marker, self.target.join(manifest)))
                .map_err(|error| failed(manifest, error))?;
        }
        for name in &removed {
            remove_listed(&self.target, name).map_err(|error| failed(name, error))?;
        }
        for name in others.into_iter().chain(manifests) {
            let to = self.target.join(name);
            to.parent()
                .map_or(Ok(()), fs::create_dir_all)
                .and_then(|()| fs::rename(self.staging.path().join(name), &to))
                .map_err(|error| failed(name, error))?;
        }
        let was_result = |name: &&String| {
            !MANIFESTS.contains(&name.as_str())
                && earlier.iter().all(|one| !one.in_progress.contains(*name))
        };
        Ok(removed.into_iter().filter(was_result).cloned().collect())
    }
}

/// A folder that is complete.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Committed {
    /// Its path.
    pub folder: PathBuf,
    /// The files of the earlier run that this one did not write again and that were removed.
    pub removed: Vec<String>,
}

impl Committed {
    /// What to tell the user about removed files: at most six by name.
    pub fn note(&self) -> Option<String> {
        removed_note(&self.removed)
    }
}

/// `removed synthetic-03.csv of the earlier run`, with at most six names.
pub fn removed_note(removed: &[String]) -> Option<String> {
    const NAMED: usize = 6;
    let named = removed
        .iter()
        .take(NAMED)
        .map(String::as_str)
        .collect::<Vec<_>>()
        .join(", ");
    let more = removed.len().saturating_sub(NAMED);
    match (removed.is_empty(), more) {
        (true, _) => None,
        (_, 0) => Some(format!("removed {named} of the earlier run")),
        _ => Some(format!(
            "removed {named} and {} of the earlier run",
            counted(more, "more file")
        )),
    }
}

/// Begins a long run of the command with this schema that writes into `target` itself. The folder is
/// created, and its manifest also lists these `names` as in progress, so that the files of a killed
/// run are recognised.
///
/// # Errors
/// As [`OutputFolder::stage`] and [`OutputFolder::of_command`].
pub fn announce(target: &Path, force: bool, schema: &str, names: &[String]) -> Result<(), Problem> {
    let target = real_path(&absolute(target)?);
    let command = command_of(schema);
    let place = check_replaceable(&target, force)?;
    if !force {
        place.check_owner(&target, &command)?;
    }
    let earlier = match place {
        Place::Absent => Vec::new(),
        Place::Folder { earlier } => earlier,
    };
    refuse_links(&target, names.iter().map(String::as_str))?;
    let own = || earlier.iter().filter(|one| one.command == command);
    fs::create_dir_all(&target)
        .map_err(|error| io_problem(&target, "cannot create the folder", &error))?;
    let files: BTreeSet<&String> = names
        .iter()
        .chain(own().flat_map(|one| &one.files))
        .collect();
    let in_progress: BTreeSet<&String> = names
        .iter()
        .chain(own().flat_map(|one| &one.in_progress))
        .collect();
    // What is in progress has no hash; the outputs of the earlier run keep theirs.
    let hashes = own()
        .flat_map(|one| &one.hashes)
        .filter(|(name, _)| !in_progress.contains(name))
        .collect();
    let text = incomplete(&command, &files, &in_progress, &hashes);
    write_file(&target.join(MANIFEST), text.as_bytes(), &[])
}

/// The manifest of a folder that is not complete.
fn incomplete(
    command: &str,
    files: &BTreeSet<&String>,
    in_progress: &BTreeSet<&String>,
    hashes: &BTreeMap<&String, &String>,
) -> String {
    serde_json::json!({
        "schema": INCOMPLETE,
        "command": command,
        "files": files,
        "in_progress": in_progress,
        HASHES: hashes,
    })
    .to_string()
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

/// Removes a file that a manifest lists, and folders that become empty. A missing file is not an
/// error.
fn remove_listed(target: &Path, name: &str) -> io::Result<()> {
    match fs::remove_file(target.join(name)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    for above in Path::new(name)
        .ancestors()
        .skip(1)
        .filter(|above| !above.as_os_str().is_empty())
    {
        if fs::remove_dir(target.join(above)).is_err() {
            break;
        }
    }
    Ok(())
}

fn absolute(path: &Path) -> Result<PathBuf, Problem> {
    let path =
        std::path::absolute(path).map_err(|error| io_problem(path, "is not a path", &error))?;
    // Where the path exists, ".." and links above it are resolved as the system does.
    match (path.file_name(), path.parent()) {
        (Some(_), _) => Ok(path),
        _ => fs::canonicalize(&path)
            .map_err(|error| io_problem(&path, "cannot inspect the output folder", &error)),
    }
}

#[cfg(test)]
mod tests;
