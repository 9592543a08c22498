//! Finished parts of a long run on disk, from which a resumed run starts.
//!
//! The results of a million objects do not fit into memory. They are written part by part and read
//! again for the outputs, so that a run writes the same bytes whether or not it was interrupted.

use std::fs;
use std::io::{self, BufRead, BufReader};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::result::Assessment;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_inventory::{Inventory, Item};
use freestand_output::folder::write_file;
use freestand_output::paths::{io_problem, refuse_links_in};
use freestand_study::study::Study;
use freestand_study::study::assessment::Dimensions;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Folder of the parts inside the output folder.
pub const PROGRESS: &str = "progress";

/// The file with the key of the run.
const PLAN: &str = "plan";

/// The file that the writing run locks.
const LOCK: &str = "lock";

/// Most objects of a part. A killed run loses the part that it is in: about half a minute on two cores if a fifth of the
/// list is on pads. The objects of a part share the motions of their floors, and stand side by side in the kernels.
const PART: usize = 1024;

/// Objects of a part whose histories are followed one by one, for a tenth of a second and more: some minutes.
const SLOW_PART: usize = 4;

/// Objects of a part of an inventory: as many as have four slow ones among them on average.
pub fn part_size(study: &Study, inventory: &Inventory) -> usize {
    let is_in_space = study.assessment.dimensions == Dimensions::Three;
    let is_slow = |item: &&Item| is_in_space || item.is_followed_alone();
    let slow = inventory.items.iter().filter(is_slow).count();
    let size = (SLOW_PART * inventory.items.len()).checked_div(slow);
    size.unwrap_or(PART).clamp(SLOW_PART, PART)
}

/// Rows of an inventory that are assessed and stored together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// The name of its files, without their endings.
    pub name: String,
    /// Its rows, counted from 0.
    pub rows: Range<usize>,
}

impl Part {
    /// The parts of a run over this many rows, of `size` rows each.
    pub fn of_run(rows: usize, size: usize) -> Vec<Self> {
        ranges(0..rows, size)
            .enumerate()
            .map(|(part, rows)| Self {
                name: format!("{part:06}"),
                rows,
            })
            .collect()
    }

    /// The parts of a shard with these rows, of `size` rows each.
    pub fn of_shard(shard: usize, rows: Range<usize>, size: usize) -> Vec<Self> {
        ranges(rows, size)
            .enumerate()
            .map(|(part, rows)| Self {
                name: format!("{shard:05}-{part:03}"),
                rows,
            })
            .collect()
    }

    /// The file with its results.
    pub fn results_name(&self) -> String {
        format!("{}.jsonl", self.name)
    }

    /// The file with its results so far, where the run was stopped before they were complete.
    fn stopped_name(&self) -> String {
        format!("{}.stopped", self.name)
    }

    /// The file with the worlds of its objects, likewise.
    fn lived_name(&self) -> String {
        format!("{}.lived", self.name)
    }

    /// The file with its outcomes.
    pub fn outcomes_name(&self) -> String {
        format!("{}.csv", self.name)
    }
}

fn ranges(rows: Range<usize>, size: usize) -> impl Iterator<Item = Range<usize>> {
    let end = rows.end;
    rows.step_by(size)
        .map(move |first| first..end.min(first + size))
}

/// A folder of parts.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    /// Locked as long as this lives: two runs in one folder would read each other's parts. `None`: the
    /// folder of a plan, in which each shard has files of its own.
    _lock: Option<fs::File>,
}

impl Store {
    /// Opens the folder for a run with this `key`. Parts of another run are removed; parts of the
    /// same run are kept if `resume` is set.
    pub fn open(folder: &Path, key: &str, resume: bool) -> Result<Self, Problem> {
        let failed =
            |error: io::Error| io_problem(folder, "cannot write the finished parts", &error);
        refuse_links_in(folder)?;
        fs::create_dir_all(folder).map_err(failed)?;
        // Whatever has this name is not truncated.
        let open = fs::OpenOptions::new()
            .write(true)
            .create(true)
            .truncate(false)
            .open(folder.join(LOCK));
        let lock = open.map_err(failed)?;
        // Some file systems cannot lock files: there, two runs cannot be told apart.
        if let Err(fs::TryLockError::WouldBlock) = lock.try_lock() {
            return Err(
                Problem::new(ProblemKind::Io, "another run is writing into this folder")
                    .in_file(folder)
                    .hint("wait until it has finished, or give another folder with `out`"),
            );
        }
        let store = Self {
            folder: folder.to_path_buf(),
            _lock: Some(lock),
        };
        let is_same = fs::read_to_string(folder.join(PLAN)).is_ok_and(|found| found == key);
        if !(is_same && resume) {
            store.clear().map_err(failed)?;
            write_file(&folder.join(PLAN), key.as_bytes(), &[])?;
        }
        Ok(store)
    }

    /// The folder of the shards of a plan, which is made where it does not exist.
    pub fn of_shards(folder: &Path) -> Result<Self, Problem> {
        refuse_links_in(folder)?;
        fs::create_dir_all(folder)
            .map_err(|error| io_problem(folder, "cannot write the finished parts", &error))?;
        Ok(Self {
            folder: folder.to_path_buf(),
            _lock: None,
        })
    }

    /// The names of the files of a run in these parts.
    pub fn names(parts: &[Part]) -> impl Iterator<Item = String> + '_ {
        let of_parts = parts.iter().flat_map(|part| {
            let (results, outcomes) = (part.results_name(), part.outcomes_name());
            [results, outcomes, part.stopped_name(), part.lived_name()]
        });
        [LOCK, PLAN].map(str::to_owned).into_iter().chain(of_parts)
    }

    fn clear(&self) -> io::Result<()> {
        let Ok(entries) = fs::read_dir(&self.folder) else {
            return Ok(());
        };
        for entry in entries {
            let entry = entry?;
            let name = entry.file_name();
            if name.to_str().is_some_and(is_ours) {
                fs::remove_file(entry.path())?;
            }
        }
        Ok(())
    }

    /// Stores a part, which is then complete or absent.
    pub fn write<T: Serialize>(&self, part: &Part, found: &[T]) -> Result<(), Problem> {
        self.write_lines(&part.results_name(), found)?;
        for name in [part.stopped_name(), part.lived_name()] {
            let path = self.folder.join(name);
            match fs::remove_file(&path) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => {
                    return Err(io_problem(
                        &path,
                        "cannot remove a file of an earlier run",
                        &error,
                    ));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Stores what is known of a part that was stopped, and the worlds that a later run goes on from.
    pub(crate) fn write_stopped(
        &self,
        part: &Part,
        found: &[Assessment],
        lived: &[u8],
    ) -> Result<(), Problem> {
        self.write_lines(&part.stopped_name(), found)?;
        write_file(&self.folder.join(part.lived_name()), lived, &[])
    }

    /// The worlds of a part that was stopped; `None`: it was not.
    pub(crate) fn lived(&self, part: &Part) -> Option<Vec<u8>> {
        fs::read(self.folder.join(part.lived_name())).ok()
    }

    fn write_lines<T: Serialize>(&self, name: &str, found: &[T]) -> Result<(), Problem> {
        let path = self.folder.join(name);
        let mut lines = Vec::new();
        for one in found {
            serde_json::to_writer(&mut lines, one).map_err(|error| {
                io_problem(&path, "cannot write a finished part", &error.into())
            })?;
            lines.push(b'\n');
        }
        write_file(&path, &lines, &[])
    }

    /// Stores the outcomes of a part, before the part itself.
    pub fn write_outcomes(&self, part: &Part, rows: &[u8]) -> Result<(), Problem> {
        write_file(&self.folder.join(part.outcomes_name()), rows, &[])
    }

    /// The outcomes of a part; `None` where they are absent.
    pub fn outcomes(&self, part: &Part) -> Option<Vec<u8>> {
        fs::read(self.folder.join(part.outcomes_name())).ok()
    }

    /// Whether the outcomes of a part are stored.
    pub fn has_outcomes(&self, part: &Part) -> bool {
        self.has(&part.outcomes_name())
    }

    /// Whether there is a file of this name.
    pub fn has(&self, name: &str) -> bool {
        self.folder.join(name).is_file()
    }

    /// Puts the file of this name in a second place as well: as a link, or as a copy where links
    /// are not possible.
    pub fn link(&self, name: &str, to: &Path) -> Result<(), Problem> {
        let from = self.folder.join(name);
        fs::hard_link(&from, to)
            .or_else(|_| fs::copy(&from, to).map(|_| ()))
            .map_err(|error| io_problem(&from, "cannot keep a finished part", &error))
    }

    /// A stored part; `None` where it is absent, incomplete or of other objects.
    pub fn read<'a>(
        &self,
        part: &Part,
        ids: impl ExactSizeIterator<Item = &'a str>,
    ) -> Option<Vec<Assessment>> {
        of_these(self.rows(part)?, ids)
    }

    /// What is known of a part that was stopped; `None` as for [`Store::read`].
    pub(crate) fn read_stopped<'a>(
        &self,
        part: &Part,
        ids: impl ExactSizeIterator<Item = &'a str>,
    ) -> Option<Vec<Assessment>> {
        of_these(self.lines(&part.stopped_name())?, ids)
    }

    /// The rows of a stored part; `None` if the part is absent or a row cannot be read.
    pub fn rows<T: DeserializeOwned>(&self, part: &Part) -> Option<Vec<T>> {
        self.lines(&part.results_name())
    }

    fn lines<T: DeserializeOwned>(&self, name: &str) -> Option<Vec<T>> {
        let file = fs::File::open(self.folder.join(name)).ok()?;
        let lines = BufReader::new(file).lines();
        lines
            .map(|line| serde_json::from_str(&line.ok()?).ok())
            .collect()
    }
}

fn of_these<'a>(
    found: Vec<Assessment>,
    ids: impl ExactSizeIterator<Item = &'a str>,
) -> Option<Vec<Assessment>> {
    let is_of_these =
        found.len() == ids.len() && found.iter().zip(ids).all(|(one, id)| one.id == id);
    is_of_these.then_some(found)
}

fn is_ours(name: &str) -> bool {
    let endings = [".jsonl", ".csv", ".stopped", ".lived"].into_iter();
    let mut numbers = endings.filter_map(|ending| name.strip_suffix(ending));
    let number = numbers.next().unwrap_or("");
    name == PLAN || (!number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use freestand_inventory::library::Lookup;
    use freestand_inventory::{ReadOptions, read_inventory};
    use std::os::unix::fs::symlink;

    /// A part has four objects that are followed one by one: round ones, bodies and stacks, or all in three dimensions.
    #[test]
    fn a_part_has_few_slow_objects() {
        let study = |toml| freestand_study::resolve::resolve(toml, None, Path::new("")).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let of = |shapes: &[&str]| {
            let path = folder.path().join("list.csv");
            let mut text = "id,height [mm],thickness [mm],shape,upper_height [mm],upper_thickness [mm],upper_mass [kg],anchored,casters\n".to_owned();
            for (i, shape) in shapes.iter().cycle().take(12).enumerate() {
                text += &format!("o{i},1800,400,{shape}\n");
            }
            fs::write(&path, text).unwrap();
            read_inventory(&path, &ReadOptions::new(&Lookup::NONE)).unwrap()
        };
        let flat = study("[building]\nstoreys = 8\n");
        let size = |shapes: &[&str]| part_size(&flat, &of(shapes));
        for quick in ["box,,,,,", "cylinder,,,,yes,", "cylinder,,,,,free"] {
            assert_eq!(size(&[quick]), PART, "{quick}");
        }
        for slow in ["cylinder,,,,,", "polygon:6,,,,,", "box,500,300,20,,"] {
            assert_eq!(size(&[slow]), SLOW_PART, "{slow}");
            assert_eq!(
                size(&["box,,,,,", "box,,,,,", slow]),
                3 * SLOW_PART,
                "{slow}"
            );
        }
        let space = study("[building]\nstoreys = 8\n[assessment]\ndimensions = \"3d\"\n");
        assert_eq!(part_size(&space, &of(&["box,,,,,"])), SLOW_PART);
    }

    /// Through a link, the lock would truncate the user's file and the clearing would remove files that
    /// happen to have numbers for names.
    #[test]
    fn links_in_the_folder_of_the_parts_are_refused() {
        let parent = tempfile::tempdir().unwrap();
        let (others, progress) = (parent.path().join("others"), parent.path().join("progress"));
        fs::create_dir_all(&others).unwrap();
        for name in ["000001.jsonl", LOCK, PLAN] {
            fs::write(others.join(name), "mine").unwrap();
        }
        let untouched = || {
            ["000001.jsonl", LOCK, PLAN]
                .iter()
                .all(|name| fs::read_to_string(others.join(name)).unwrap() == "mine")
        };
        symlink(&others, &progress).unwrap();
        assert!(
            Store::open(&progress, "key", false).is_err()
                && Store::of_shards(&progress).is_err()
                && untouched()
        );
        fs::remove_file(&progress).unwrap();
        fs::create_dir_all(&progress).unwrap();
        for name in [LOCK, PLAN, "000001.jsonl"] {
            symlink(others.join(name), progress.join(name)).unwrap();
            assert!(
                Store::open(&progress, "key", true).is_err()
                    && Store::of_shards(&progress).is_err(),
                "{name}"
            );
            fs::remove_file(progress.join(name)).unwrap();
            assert!(untouched(), "{name}");
        }
        // What lies in the place of the lock is not truncated.
        fs::write(progress.join(LOCK), "mine").unwrap();
        assert!(Store::open(&progress, "key", false).is_ok());
        assert_eq!(fs::read_to_string(progress.join(LOCK)).unwrap(), "mine");
    }
}
