//! Every record of a folder: which files are records, and which two files are one.

use std::collections::HashSet;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use freestand_input::file::{self, check_allowed};
use freestand_input::file_names;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::words::counted;
use freestand_records::formats::{Component, Direction, ReadOptions};
use rayon::prelude::*;

use super::pairing::{Single, pairs};
use super::{Failed, Loaded, MotionFiles, ReadMotion, Second, Used};
use crate::suite::{LeftOut, MAX_FILES};

/// What a folder holds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Folder {
    /// The records in the order of the names of their files: all with two horizontal components, or
    /// all with one.
    pub(crate) motions: Vec<ReadMotion>,
    /// Files that cannot be read, and records that cannot be used.
    pub(crate) left_out: Vec<LeftOut>,
    /// Files that are not horizontal motions: what they are for, by their name.
    pub(crate) skipped: Vec<String>,
}

/// Endings of files that describe records or show them.
const NOT_RECORDS: [&str; 19] = [
    "xml", "json", "md", "toml", "html", "htm", "pdf", "doc", "docx", "xls", "xlsx", "zip", "gz",
    "png", "jpg", "svg", "py", "m", "rst",
];
/// Velocities and displacements that PEER delivers with its accelerations.
const NOT_ACCELERATIONS: [&str; 2] = ["vt2", "dt2"];
/// Beginnings of the names of texts and tables about records.
const ABOUT_RECORDS: [&str; 6] = [
    "readme",
    "index",
    "license",
    "licence",
    "_searchresults",
    "_readme",
];

/// Whether a file is one that folders of records contain besides records, judged by its name.
fn is_record(path: &Path) -> bool {
    let lower = |part: Option<&OsStr>| {
        part.map_or_else(String::new, |part| part.to_string_lossy().to_lowercase())
    };
    let (name, extension) = (lower(path.file_name()), lower(path.extension()));
    let other = NOT_RECORDS
        .iter()
        .chain(&NOT_ACCELERATIONS)
        .any(|ending| *ending == extension);
    !other && !ABOUT_RECORDS.iter().any(|start| name.starts_with(start))
}

fn file_name(path: &Path) -> String {
    file::file_name(path).unwrap_or_default()
}

/// Paths of records, sorted by name, and names of other files. Hidden files are passed over.
fn list(folder: &Path) -> Result<(Vec<PathBuf>, Vec<String>), Problem> {
    const HINT: &str = "name a folder with record files";
    let failed = |error: std::io::Error| {
        let message = if folder.exists() {
            format!("cannot be read as a folder: {error}")
        } else {
            "does not exist".to_owned()
        };
        Problem::new(ProblemKind::Io, message)
            .in_file(folder)
            .hint(HINT)
    };
    check_allowed(folder)?;
    let mut paths: Vec<PathBuf> = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        paths.push(entry.map_err(failed)?.path());
    }
    paths.retain(|path| !file_name(path).starts_with('.'));
    paths.sort();
    let (records, others): (Vec<PathBuf>, Vec<PathBuf>) = paths
        .into_iter()
        .partition(|path| !path.is_dir() && is_record(path));
    if records.len() > MAX_FILES {
        let message = format!(
            "has {} files; a suite is selected from at most {MAX_FILES}",
            records.len()
        );
        return Err(Problem::new(ProblemKind::Value, message)
            .in_file(folder)
            .hint("move some of them out of the folder"));
    }
    Ok((records, others.iter().map(|path| file_name(path)).collect()))
}

/// Reads every record of a folder; `files` says how, and not which. What cannot be used is left out.
///
/// A record has two horizontal components where its file has two, or where two files with one each
/// belong together ([`pairs`]); it has one where `component` or an azimuth chooses one of each file,
/// which are then not paired. All records have two or all have one: the fewer are left out, at equal
/// numbers those with one; where both are asked for, always those with one.
///
/// # Errors
/// A folder that cannot be read, or that has too many files.
pub(crate) fn read_folder(folder: &Path, files: &MotionFiles) -> Result<Folder, Problem> {
    let (paths, skipped) = list(folder)?;
    let loaded: Vec<Result<Loaded, Problems>> =
        paths.par_iter().map(|path| read(path, files)).collect();
    let mut found = Folder {
        motions: Vec::new(),
        left_out: Vec::new(),
        skipped,
    };
    let mut all: Vec<Loaded> = Vec::new();
    for (path, one) in paths.iter().zip(loaded) {
        match one {
            // The same earthquake twice would count as two.
            Ok(one) if let Some(same) = all.iter().find(|other| other.sha256 == one.sha256) => {
                let reason = format!("is the same as {}", file_name(&same.file.path));
                found.left_out.push(LeftOut {
                    file: file_name(path),
                    reason,
                });
            }
            Ok(one) => all.push(one),
            Err(problems) => found
                .left_out
                .extend(problems.into_iter().next().map(|why| left_out(path, why))),
        }
    }
    let records = found.records(&all, files);
    let motions: Vec<(PathBuf, Result<ReadMotion, Problem>)> = records
        .into_par_iter()
        .map(|(one, used)| (one.file.path.clone(), one.motion(used, files)))
        .collect();
    for (path, motion) in motions {
        match motion {
            Ok(motion) => found.motions.push(motion),
            Err(problem) => found.left_out.push(left_out(&path, problem)),
        }
    }
    found.leave_out_the_fewer(matches!(files.second, Second::SameFile(_)));
    found.left_out.sort_by(|a, b| a.file.cmp(&b.file));
    found.skipped.sort();
    let mut names = HashSet::new();
    for read in &mut found.motions {
        read.motion.name = file_names::unique(&read.motion.name, &mut names);
    }
    Ok(found)
}

/// A file; unit and time step are for those that do not state their own, whatever others state.
fn read(path: &Path, files: &MotionFiles) -> Result<Loaded, Problems> {
    Loaded::read(path, files).or_else(|problems| {
        let stated = ReadOptions {
            unit: None,
            dt_s: None,
            ..files.read.clone()
        };
        Loaded::read(
            path,
            &MotionFiles {
                read: stated,
                ..files.clone()
            },
        )
        .map_err(|_| problems)
    })
}

fn left_out(path: &Path, problem: Problem) -> LeftOut {
    LeftOut {
        file: file_name(path),
        reason: Failed::new(path, problem).reason,
    }
}

impl Folder {
    /// The records, each with the components that are used, in the order of the files.
    fn records<'a>(
        &mut self,
        read: &'a [Loaded],
        files: &'a MotionFiles,
    ) -> Vec<(&'a Loaded, Used<'a>)> {
        let is_one_chosen = files.component.is_some() || files.processing.azimuth_deg.is_some();
        let called = match &files.second {
            Second::SameFile(Some((first, second))) => Some((first.as_str(), second.as_str())),
            Second::SameFile(None) | Second::Files(_) | Second::None => None,
        };
        let (mut records, mut alone) = (Vec::new(), Vec::new());
        for (index, one) in read.iter().enumerate() {
            let name = file_name(&one.file.path);
            match one.file.components.as_slice() {
                [only] => match horizontal(&name, only) {
                    Some(_) if is_one_chosen => records.push((index, Used::Chosen)),
                    Some(single) => alone.push((index, single)),
                    None => self.skipped.push(name),
                },
                _ if is_one_chosen => records.push((index, Used::Chosen)),
                _ => records.push((index, Used::Two(called))),
            }
        }
        let (indices, singles): (Vec<usize>, Vec<Single>) = alone.into_iter().unzip();
        for (first, second) in pairs(&singles) {
            let used = second
                .and_then(|second| read.get(*indices.get(second)?))
                .map_or(Used::Chosen, Used::With);
            records.extend(indices.get(first).map(|&index| (index, used)));
        }
        records.sort_by_key(|(index, _)| *index);
        records
            .into_iter()
            .filter_map(|(index, used)| Some((read.get(index)?, used)))
            .collect()
    }

    fn leave_out_the_fewer(&mut self, both_are_asked: bool) {
        let has_two = |read: &ReadMotion| read.motion.across.is_some();
        let two = self.motions.iter().filter(|read| has_two(read)).count();
        let one = self.motions.len() - two;
        let keeps_two = both_are_asked || two >= one;
        let reason = match (keeps_two, two) {
            (true, 0) => {
                "has one horizontal component, and no other file has its second".to_owned()
            }
            (true, _) => {
                let others = counted(two, "other record");
                format!(
                    "has one horizontal component, but {others} have two; `component = 1` uses one of each file"
                )
            }
            (false, _) => {
                let others = counted(one, "record");
                format!(
                    "has two horizontal components, but {others} of the folder have one; choose one with `component`"
                )
            }
        };
        let reason = freestand_input::keys::KeyStyle::File.shown(&reason);
        let (kept, dropped) = std::mem::take(&mut self.motions)
            .into_iter()
            .partition(|read| has_two(read) == keeps_two);
        self.motions = kept;
        let dropped: Vec<ReadMotion> = dropped;
        self.left_out.extend(dropped.iter().map(|read| LeftOut {
            file: file_name(&read.motion.path),
            reason: reason.clone(),
        }));
    }
}

/// The component as one of a pair, unless it is vertical.
fn horizontal(file_name: &str, component: &Component) -> Option<Single> {
    let single = Single::new(file_name, component);
    let is_up = component.direction == Some(Direction::Up)
        || (component.direction.is_none() && single.is_vertical());
    (!is_up).then_some(single)
}
