//! Finished parts of a long run, on disk: what a kill leaves, and what `--resume` goes on from.
//!
//! Results of a million objects do not fit the memory: they are written part by part and read again for the outputs, so that a run that
//! was interrupted and one that was not write the same bytes.

use std::fs;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

use super::result::Assessment;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_output::paths::io_problem;

/// Folder of the parts inside the output folder.
pub(super) const PROGRESS: &str = "progress";

/// What the parts are of.
const PLAN: &str = "plan";

/// Locked by the run that writes.
const LOCK: &str = "lock";

/// A folder of parts.
#[derive(Debug)]
pub(super) struct Store {
    folder: PathBuf,
    /// Held while we live: two runs in one folder would read each other's parts.
    _lock: fs::File,
}

impl Store {
    /// Opens the folder for a run with this `key`; parts of another run are cleared, those of the same one kept only if `resume`.
    pub(super) fn open(folder: &Path, key: &str, resume: bool) -> Result<Self, Problem> {
        let failed = |error: io::Error| io_problem(folder, "cannot write the finished parts", &error);
        fs::create_dir_all(folder).map_err(failed)?;
        let lock = fs::File::create(folder.join(LOCK)).map_err(failed)?;
        // Where files cannot be locked at all, nobody can be told apart.
        if let Err(fs::TryLockError::WouldBlock) = lock.try_lock() {
            return Err(Problem::new(ProblemKind::Io, "another assessment writes into this folder")
                .in_file(folder)
                .hint("wait for it, or name another folder with --out"));
        }
        let store = Self { folder: folder.to_path_buf(), _lock: lock };
        let is_same = fs::read_to_string(folder.join(PLAN)).is_ok_and(|found| found == key);
        if !(is_same && resume) {
            store.clear().map_err(failed)?;
        }
        if !(is_same && resume) {
            store.put(PLAN, |file| file.write_all(key.as_bytes())).map_err(failed)?;
        }
        Ok(store)
    }

    /// The files of a run in `parts` parts, by their names in the folder.
    pub(super) fn names(parts: usize) -> impl Iterator<Item = String> {
        [LOCK, PLAN].map(str::to_owned).into_iter().chain((0..parts).map(part_name))
    }

    fn clear(&self) -> io::Result<()> {
        let Ok(entries) = fs::read_dir(&self.folder) else { return Ok(()) };
        for entry in entries {
            let entry = entry?;
            let name = entry.file_name();
            if name.to_str().is_some_and(is_ours) {
                fs::remove_file(entry.path())?;
            }
        }
        Ok(())
    }

    /// Writes a file under a temporary name and gives it its own: it is whole or absent.
    fn put(&self, name: &str, write: impl FnOnce(&mut io::BufWriter<fs::File>) -> io::Result<()>) -> io::Result<()> {
        let temporary = self.folder.join(format!("{name}{TEMPORARY}"));
        let mut file = io::BufWriter::new(fs::File::create(&temporary)?);
        write(&mut file)?;
        file.into_inner()?.sync_data()?;
        fs::rename(temporary, self.folder.join(name))
    }

    /// Keeps a part.
    pub(super) fn write(&self, part: usize, found: &[Assessment]) -> Result<(), Problem> {
        let name = part_name(part);
        self.put(&name, |file| {
            for one in found {
                serde_json::to_writer(&mut *file, one)?;
                file.write_all(b"\n")?;
            }
            Ok(())
        })
        .map_err(|error| io_problem(&self.folder.join(&name), "cannot write a finished part", &error))
    }

    /// The file of this name in a second place as well: a link, or a copy where the file system has none.
    pub(super) fn link(&self, name: &str, to: &Path) -> Result<(), Problem> {
        let from = self.folder.join(name);
        fs::hard_link(&from, to)
            .or_else(|_| fs::copy(&from, to).map(|_| ()))
            .map_err(|error| io_problem(&from, "cannot keep a finished part", &error))
    }

    /// A part as it was kept; `None` where it is absent, cut short or of other objects.
    pub(super) fn read<'a>(&self, part: usize, ids: impl ExactSizeIterator<Item = &'a str>) -> Option<Vec<Assessment>> {
        let file = fs::File::open(self.folder.join(part_name(part))).ok()?;
        let lines = BufReader::new(file).lines();
        let found: Option<Vec<Assessment>> = lines.map(|line| serde_json::from_str(&line.ok()?).ok()).collect();
        found.filter(|found| found.len() == ids.len() && found.iter().zip(ids).all(|(one, id)| one.id == id))
    }
}

/// End of the name of a file in the making.
const TEMPORARY: &str = ".new";

fn part_name(part: usize) -> String {
    format!("{part:06}.jsonl")
}

fn is_ours(name: &str) -> bool {
    let name = name.strip_suffix(TEMPORARY).unwrap_or(name);
    let number = name.strip_suffix(".jsonl").unwrap_or("");
    name == PLAN || (!number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
}
