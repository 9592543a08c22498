//! The files that a study reads, kept in the folder of a plan, so that a shard reads what was planned
//! whatever becomes of the originals.
//!
//! They keep their names and their places relative to each other: names of records are in the
//! outputs, and components of a record are found side by side.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use freestand_input::file::{InputFile, load};
use freestand_input::problem::{Problem, ProblemKind};
use freestand_output::folder::OutputFolder;
use freestand_output::paths::io_problem;
use freestand_study::resolve::motion_paths;
use freestand_study::study::{Ground, Study};
use toml_edit::visit_mut::{VisitMut, visit_document_mut};
use toml_edit::{DocumentMut, Formatted};

/// The folder of these files in the folder of a plan.
const FOLDER: &str = "study";

/// Files, and the lowest folder that has all of them below it.
#[derive(Debug)]
pub(super) struct KeptFiles {
    root: PathBuf,
    files: BTreeSet<PathBuf>,
}

impl KeptFiles {
    /// The files that a study was read from, and `others`.
    ///
    /// # Errors
    /// A path that is not one, or a folder of records that cannot be read.
    pub(super) fn of(
        study: &Study,
        others: impl IntoIterator<Item = PathBuf>,
    ) -> Result<Self, Problem> {
        let hazard = match &study.ground {
            Ground::Simulated(simulated) => simulated.hazard.as_ref(),
            Ground::Synthetic(_) | Ground::Recorded(_) | Ground::OnFloors => None,
        };
        let restraint = study.assessment.restraint_code.as_ref();
        let targets = hazard
            .into_iter()
            .chain(restraint)
            .filter_map(|target| target.file.as_ref());
        let cushion = study.objects.cushion_file.as_ref().map(|(file, _)| file);
        let settings = &study.assessment;
        let libraries = [&settings.library, &settings.cushion_library]
            .into_iter()
            .flatten()
            .cloned();
        let of_inputs = targets
            .chain(cushion)
            .map(|file: &InputFile| file.path.clone());
        let all = study
            .source
            .iter()
            .cloned()
            .chain(motion_paths(study))
            .chain(of_inputs)
            .chain(libraries);
        let mut files = BTreeSet::new();
        for path in all.chain(others).chain(of_suite(study)?) {
            files.insert(absolute(&path)?);
        }
        let mut folders = files.iter().filter_map(|file| file.parent());
        let first = folders.next().unwrap_or(Path::new("/")).to_path_buf();
        let root = folders.fold(first, |root, folder| common(&root, folder));
        Ok(Self { root, files })
    }

    /// The files, by their paths from the root.
    pub(super) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.files.iter()
    }

    /// The name of a file in the folder of a plan.
    ///
    /// # Errors
    /// A file that is not kept, or a name that is not text.
    pub(super) fn name(&self, path: &Path) -> Result<String, Problem> {
        let path = absolute(path)?;
        let below = path.strip_prefix(&self.root).ok().and_then(Path::to_str);
        let below = below
            .filter(|_| self.files.contains(&path))
            .ok_or_else(|| {
                Problem::new(ProblemKind::Io, "cannot be kept in the folder of a plan")
                    .in_file(&path)
                    .hint("give it a name in plain letters")
            })?;
        let parts: Vec<&str> = [FOLDER]
            .into_iter()
            .chain(below.split(std::path::MAIN_SEPARATOR))
            .collect();
        Ok(parts.join("/"))
    }

    /// Copies all files, and `study` in place of the file of the study.
    ///
    /// # Errors
    /// A file that cannot be read, or a disk that is full.
    pub(super) fn write(
        &self,
        folder: &OutputFolder,
        study: (Option<&Path>, &str),
    ) -> Result<(), Problem> {
        let (source, text) = study;
        let source = source.map(absolute).transpose()?;
        for path in self
            .files
            .iter()
            .filter(|path| source.as_ref() != Some(path))
        {
            folder.write(&self.name(path)?, &load(path)?)?;
        }
        match source {
            Some(path) => folder.write(&self.name(&path)?, text.as_bytes()),
            None => folder.write(BUILTIN, text.as_bytes()),
        }
    }

    /// The name of the study in the folder of a plan.
    pub(super) fn study_name(&self, source: Option<&Path>) -> Result<String, Problem> {
        source.map_or_else(|| Ok(BUILTIN.to_owned()), |path| self.name(path))
    }

    /// The text of the study with paths that start at the root of the file system made relative, so
    /// that they name what is kept.
    ///
    /// # Errors
    /// A text that is not TOML.
    pub(super) fn relocated(&self, study: &Study) -> Result<String, Problem> {
        let Some(base) = study.source.as_deref().map(absolute).transpose()? else {
            return Ok(study.toml.clone());
        };
        let base = base.parent().unwrap_or(&self.root);
        let mut document: DocumentMut =
            study.toml.parse().map_err(|error: toml_edit::TomlError| {
                Problem::new(
                    ProblemKind::Format,
                    format!("the study cannot be kept: {}", error.message()),
                )
            })?;
        let mut visitor = Relocate {
            files: &self.files,
            base,
            root: &self.root,
            is_changed: false,
        };
        visit_document_mut(&mut visitor, &mut document);
        Ok(if visitor.is_changed {
            document.to_string()
        } else {
            study.toml.clone()
        })
    }
}

/// The name of the built-in study in the folder of a plan.
const BUILTIN: &str = "study/built-in.toml";

/// All records of the folder from which the motions were selected.
fn of_suite(study: &Study) -> Result<Vec<PathBuf>, Problem> {
    let Some(suite) = study.ground.suite() else {
        return Ok(Vec::new());
    };
    let failed =
        |error: std::io::Error| io_problem(&suite.folder, "cannot read the folder", &error);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(&suite.folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let is_hidden = entry.file_name().to_string_lossy().starts_with('.');
        if !is_hidden && entry.path().is_file() {
            files.push(entry.path());
        }
    }
    Ok(files)
}

struct Relocate<'r> {
    files: &'r BTreeSet<PathBuf>,
    base: &'r Path,
    root: &'r Path,
    is_changed: bool,
}

impl VisitMut for Relocate<'_> {
    fn visit_string_mut(&mut self, node: &mut Formatted<String>) {
        let path = Path::new(node.value());
        let Some(path) = path.is_absolute().then(|| folded(path)) else {
            return;
        };
        // A file, or a folder with files.
        if !self.files.iter().any(|file| file.starts_with(&path)) {
            return;
        }
        let ups = self
            .base
            .strip_prefix(self.root)
            .map_or(0, |below| below.components().count());
        let below = path.strip_prefix(self.root).unwrap_or(Path::new(""));
        let relative: PathBuf = std::iter::repeat_n(Path::new(".."), ups)
            .chain([below])
            .collect();
        if let Some(text) = relative.to_str() {
            let decor = node.decor().clone();
            *node = Formatted::new(text.to_owned());
            *node.decor_mut() = decor;
            self.is_changed = true;
        }
    }
}

/// A path from the root of the file system, without `..`.
pub(super) fn absolute(path: &Path) -> Result<PathBuf, Problem> {
    let path =
        std::path::absolute(path).map_err(|error| io_problem(path, "is not a path", &error))?;
    Ok(folded(&path))
}

fn folded(path: &Path) -> PathBuf {
    let mut folded = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                folded.pop();
            }
            Component::CurDir => {}
            other => folded.push(other),
        }
    }
    folded
}

fn common(a: &Path, b: &Path) -> PathBuf {
    a.components()
        .zip(b.components())
        .take_while(|(a, b)| a == b)
        .map(|(a, _)| a)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder that is given from the root names its copy, from wherever the study is.
    #[test]
    fn paths_from_the_root_become_relative() {
        let files = ["/a/b/study.toml", "/a/c/records/x.AT2", "/a/c/list.csv"].map(PathBuf::from);
        let kept = KeptFiles {
            root: PathBuf::from("/a"),
            files: BTreeSet::from(files),
        };
        assert_eq!(
            kept.name(Path::new("/a/b/../c/list.csv")).unwrap(),
            "study/c/list.csv"
        );
        assert!(kept.name(Path::new("/a/c/other.csv")).is_err());
        let mut study =
            freestand_study::resolve::resolve("[building]\nstoreys = 30\n", None, Path::new(""))
                .unwrap();
        study.source = Some(PathBuf::from("/a/b/study.toml"));
        study.toml =
            "[ground]\nmotions = [\n  \"/a/c/records/x.AT2\", # first\n  \"/z\",\n]\nsuite = \"/a/b/../c/records\"\n"
                .to_owned();
        let expected = study
            .toml
            .replace("/a/c/records/x.AT2", "../c/records/x.AT2")
            .replace("/a/b/../c", "../c");
        assert_eq!(kept.relocated(&study).unwrap(), expected);
        study.toml = "# mine\nname   = 'x'\n".to_owned();
        assert_eq!(kept.relocated(&study).unwrap(), study.toml);
    }

    #[test]
    fn the_lowest_common_folder() {
        assert_eq!(
            common(Path::new("/a/b/c"), Path::new("/a/bc")),
            Path::new("/a")
        );
        assert_eq!(common(Path::new("/a"), Path::new("/b")), Path::new("/"));
    }
}
