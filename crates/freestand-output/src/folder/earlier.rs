//! What an output folder already holds: the manifests in it, and whether their files are still as
//! they were written.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Component, Path};

use freestand_input::file::sha256_hex;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::words::counted;

use super::{ANOTHER_FOLDER, HASHES, MANIFESTS};
use crate::paths::{STAGING_PREFIX, io_problem, refuse_links};

/// The largest manifest that is read \[bytes\]. Those of freestand are far smaller; another file of
/// that name may have any size.
const MANIFEST_BYTES: u64 = 64 << 20;

const FORCE: &str =
    "name another folder with `out`, or replace what freestand writes with `force = true`";

/// The command of a schema: `freestand.run/1` → `freestand.run`.
pub(super) fn command_of(schema: &str) -> String {
    schema.split('/').next().unwrap_or_default().to_owned()
}

/// The command that a manifest names.
pub(super) fn manifest_command(
    keys: &serde_json::Map<String, serde_json::Value>,
) -> Option<String> {
    let text = |key: &str| keys.get(key).and_then(serde_json::Value::as_str);
    let schema = text("schema").filter(|schema| schema.starts_with("freestand."))?;
    let named = match command_of(schema).as_str() {
        "freestand.manifest" => text("result").unwrap_or(schema),
        "freestand.incomplete" => text("command").unwrap_or_default(),
        _ => schema,
    };
    Some(command_of(named))
}

/// The name of a command as the user types it: `freestand.motion-synth` → `freestand motion-synth`.
fn typed(command: &str) -> String {
    command.replacen('.', " ", 1)
}

/// The hash of a file's bytes.
pub(super) fn hash_of(path: &Path) -> io::Result<String> {
    fs::read(path).map(|bytes| sha256_hex(&bytes))
}

/// What the manifest of an earlier run says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Earlier {
    /// The command that wrote it; empty if an interrupted run did not say.
    pub(super) command: String,
    /// The manifest and its files.
    pub(super) files: BTreeSet<String>,
    /// Files that a run was writing when it was stopped.
    pub(super) in_progress: BTreeSet<String>,
    pub(super) hashes: BTreeMap<String, String>,
}

impl Earlier {
    /// Whether a file is still as the run wrote it. A manifest has no hash of its own.
    pub(super) fn is_as_written(&self, target: &Path, name: &str) -> bool {
        MANIFESTS.contains(&name)
            || self
                .hashes
                .get(name)
                .is_some_and(|hash| hash_of(&target.join(name)).is_ok_and(|found| found == *hash))
    }

    /// The files that exist and are not as they were written.
    fn edited<'a>(&'a self, target: &'a Path) -> impl Iterator<Item = &'a String> {
        self.files.iter().filter(move |name| {
            !self.in_progress.contains(*name)
                && fs::symlink_metadata(target.join(name)).is_ok()
                && !self.is_as_written(target, name)
        })
    }
}

/// What exists at the path of the output folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Place {
    Absent,
    /// A folder that may be written into, with what the manifests in it say.
    Folder {
        earlier: Vec<Earlier>,
    },
}

impl Place {
    fn earlier(&self) -> &[Earlier] {
        match self {
            Self::Absent => &[],
            Self::Folder { earlier } => earlier,
        }
    }

    pub(super) fn listed(&self) -> impl Iterator<Item = &String> {
        self.earlier().iter().flat_map(|one| &one.files)
    }

    pub(super) fn lists(&self, name: &Path) -> bool {
        self.listed().any(|listed| Path::new(listed) == name)
    }

    /// Refuses a folder of another command, and one with files that were edited.
    pub(super) fn check_owner(&self, target: &Path, command: &str) -> Result<(), Problem> {
        if let Some(other) = self
            .earlier()
            .iter()
            .find(|one| !one.command.is_empty() && one.command != command)
        {
            let message = format!("the folder has the results of {}", typed(&other.command));
            return Err(Problem::new(ProblemKind::Io, message)
                .in_file(target)
                .hint(FORCE));
        }
        let mut edited = self.earlier().iter().flat_map(|one| one.edited(target));
        let Some(first) = edited.next() else {
            return Ok(());
        };
        let more = edited.count();
        let others = if more > 0 {
            format!(", like {}", counted(more, "more file"))
        } else {
            String::new()
        };
        Err(Problem::new(
            ProblemKind::Io,
            format!("was changed after freestand wrote it{others}"),
        )
        .in_file(&target.join(first))
        .hint("move it away, name another folder with `out`, or replace it with `force = true`"))
    }
}

/// Checks whether `target` may become the output folder, and finds the files that freestand wrote.
pub(super) fn check_replaceable(target: &Path, force: bool) -> Result<Place, Problem> {
    let data = match fs::symlink_metadata(target) {
        Ok(data) => data,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Place::Absent),
        Err(error) => {
            return Err(io_problem(
                target,
                "cannot inspect the output folder",
                &error,
            ));
        }
    };
    if !data.is_dir() {
        let what = if data.is_symlink() {
            "is a broken link"
        } else {
            "is a file"
        };
        return Err(Problem::new(
            ProblemKind::Io,
            format!("{what}, so the output folder cannot be created there"),
        )
        .in_file(target)
        .hint(ANOTHER_FOLDER));
    }
    // A manifest is read, and written, at its own place.
    refuse_links(target, MANIFESTS)?;
    let earlier: Vec<Earlier> = MANIFESTS
        .iter()
        .filter_map(|name| earlier(target, name))
        .collect();
    let mut entries = fs::read_dir(target)
        .map_err(|error| io_problem(target, "cannot read the output folder", &error))?;
    let staging = |name: &OsStr| name.to_string_lossy().starts_with(STAGING_PREFIX);
    let empty = entries.all(|entry| entry.is_ok_and(|entry| staging(&entry.file_name())));
    if empty || force || !earlier.is_empty() {
        return Ok(Place::Folder { earlier });
    }
    Err(Problem::new(
        ProblemKind::Io,
        "the folder contains files that freestand did not write",
    )
    .in_file(target)
    .hint("name another folder with `out`, or add to this one with `force = true`"))
}

/// What a manifest says; `None` if freestand did not write it. A manifest may be forged: names that
/// leave the folder or pass through a link are ignored.
fn earlier(target: &Path, manifest: &str) -> Option<Earlier> {
    let path = target.join(manifest);
    let small =
        fs::metadata(&path).is_ok_and(|data| data.is_file() && data.len() <= MANIFEST_BYTES);
    let text = small.then(|| fs::read(&path).ok()).flatten()?;
    let value: serde_json::Value = serde_json::from_slice(&text).ok()?;
    let command = manifest_command(value.as_object()?)?;
    let in_real_folders = |name: &str| {
        let mut above = Path::new(name)
            .ancestors()
            .skip(1)
            .filter(|above| !above.as_os_str().is_empty());
        above.all(|above| fs::symlink_metadata(target.join(above)).is_ok_and(|data| data.is_dir()))
    };
    let is_folder =
        |name: &str| fs::symlink_metadata(target.join(name)).is_ok_and(|data| data.is_dir());
    let names = |key: &str| {
        let names = value
            .get(key)
            .and_then(serde_json::Value::as_array)
            .into_iter()
            .flatten();
        let believed = names
            .filter_map(serde_json::Value::as_str)
            .filter(|name| stays_inside(name) && in_real_folders(name) && !is_folder(name));
        believed.map(str::to_owned).collect::<BTreeSet<String>>()
    };
    let mut files = names("files");
    files.insert(manifest.to_owned());
    let hashes = value
        .get(HASHES)
        .and_then(serde_json::Value::as_object)
        .into_iter()
        .flatten();
    let hashes = hashes
        .filter_map(|(name, hash)| Some((name.clone(), hash.as_str()?.to_owned())))
        .collect();
    Some(Earlier {
        command,
        files,
        in_progress: names("in_progress"),
        hashes,
    })
}

/// Whether a name, joined to a folder, stays below that folder.
pub(super) fn stays_inside(name: &str) -> bool {
    !name.is_empty()
        && Path::new(name)
            .components()
            .all(|part| matches!(part, Component::Normal(_)))
}
