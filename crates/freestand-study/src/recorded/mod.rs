//! Ground motions from record files: reads them, chooses components, scales and names them.

mod copies;
mod folder;
mod pairing;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use freestand::motion::Motion;
use freestand::rocking::Base;
use freestand::signal::rotate::Pair;

pub use copies::refuse_copies;
pub(crate) use folder::{Folder, read_folder};

use crate::study::{RecordedMotion, SecondComponent};
use crate::unsolved::rocking_problem;
use freestand_input::file::load;
use freestand_input::file::{InputFile, sha256_hex};
use freestand_input::file_names;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::word_reader::WordReader;
use freestand_input::words::number;
use freestand_output::answer_of;
use freestand_records::formats::{
    Component, Direction, MotionFile, ReadOptions, Start, parse_motions, parse_unit,
};
use freestand_records::notes::{Note, NoteKind};
use freestand_records::processing::{
    Processed, Processing, Scale, not_perpendicular, pair_of_one, process, process_file,
    process_pair, read_step, standstill_note,
};

/// Files whose motions are used.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionFiles {
    /// The files, in order.
    pub paths: Vec<PathBuf>,
    /// Values for files that do not state them.
    pub read: ReadOptions,
    /// Which component of each; `None`: each has only one.
    pub component: Option<String>,
    /// Where the second horizontal component comes from.
    pub second: Second,
    /// Where the vertical component comes from.
    pub vertical: Upward,
    /// What is done to the samples.
    pub processing: Processing,
}

impl MotionFiles {
    /// How a person wrote that files are read and processed; `find` gives the path of a file that is named. What no
    /// file allows is added to the problems of the reader. The files themselves are not yet named.
    pub fn read(
        reader: &mut WordReader<'_>,
        find: impl Fn(&str) -> Result<PathBuf, Problem>,
    ) -> Self {
        let (unit, dt_s) = (reader.read("unit", parse_unit), read_step(reader, "dt"));
        let station_xml = reader.read("station_xml", &find);
        let processing = Processing::read(reader, find);
        let uneven_dt_s = processing.resample_dt_s;
        Self {
            paths: Vec::new(),
            read: ReadOptions {
                unit,
                dt_s,
                uneven_dt_s,
                station_xml,
                ..ReadOptions::default()
            },
            component: reader.text("component").map(str::to_owned),
            second: Second::None,
            vertical: Upward::None,
            processing,
        }
    }
}

/// The place of the second horizontal component of each motion.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum Second {
    /// There is none: objects are computed in one direction.
    #[default]
    None,
    /// In the same file; the names or numbers of both, or `None` if only two are possible.
    SameFile(Option<(String, String)>),
    /// In these files, one for each of the first.
    Files(Vec<PathBuf>),
}

/// The place of the vertical component of each motion.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum Upward {
    /// It is not used.
    #[default]
    None,
    /// It may be the motion itself: whoever reads it does not shake a floor sideways with it. With the key that
    /// chooses a component of its file.
    Itself(&'static str),
    /// In the same file.
    SameFile,
    /// In these files, one for each of the first.
    Files(Vec<PathBuf>),
}

/// A motion, and the notes of its reader.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadMotion {
    /// The motion.
    pub motion: RecordedMotion,
    /// What the reader concluded or ignored.
    pub notes: Vec<Note>,
    /// A warning for when the motion is written to a file: see [`start_note`].
    pub start_note: Option<Note>,
    /// The unit of acceleration in the file; the motion itself is in m/s².
    pub unit: &'static str,
}

impl ReadMotion {
    /// Its notes, each with its name.
    pub fn named_notes(&self) -> impl Iterator<Item = (&str, &Note)> {
        self.notes
            .iter()
            .map(|note| (self.motion.name.as_str(), note))
    }
}

/// A warning for when the motion of a file with a time column is written to another file: times are
/// then counted from the first sample, so that they and the time step lose no digit.
pub fn start_note(file: &MotionFile) -> Option<Note> {
    let start_s = file.components.iter().find_map(|one| match one.start {
        Some(Start::Column(seconds)) => Some(seconds),
        Some(Start::Date(_)) | None => None,
    })?;
    (start_s != 0.0).then(|| {
        let start = number(start_s, 9);
        let words = format!(
            "the time column begins at {start} s, but the times of the written motion begin at 0 s"
        );
        Note::new(NoteKind::StartsLater, words)
    })
}

/// A file, or a component of one, that is not in a report.
#[derive(Debug, Clone, PartialEq)]
pub struct Failed {
    /// The file as it was named.
    pub path: String,
    /// Why, with the line where there is one.
    pub reason: String,
    /// The same, for messages.
    pub problem: Problem,
}

impl Failed {
    pub(crate) fn new(path: &Path, problem: Problem) -> Self {
        let problem = problem.in_file(path);
        // The report has the path already, unless another file is wrong.
        let elsewhere = problem.path.clone().filter(|other| other != path);
        let reason = Problem {
            path: elsewhere,
            ..problem.clone()
        }
        .to_string();
        Self {
            path: path.to_string_lossy().into_owned(),
            reason,
            problem,
        }
    }
}

answer_of!(Failed as failed {
    path: String;
    reason: String;
});

/// Reads all files.
///
/// # Errors
/// The problems of all files.
pub fn read_all(files: &MotionFiles) -> Result<Vec<ReadMotion>, Problems> {
    let (motions, failures) = read_recorded(files);
    failures
        .into_iter()
        .map(|(_, problem)| problem)
        .collect::<Problems>()
        .finish(Some(motions))
}

/// Reads all files; each problem is listed with the index of its file.
pub(crate) fn read_recorded(files: &MotionFiles) -> (Vec<ReadMotion>, Vec<(usize, Problem)>) {
    let (mut motions, mut failures) = (Vec::new(), Vec::new());
    let mut names = HashSet::new();
    for (index, path) in files.paths.iter().enumerate() {
        match read_one(index, path, files) {
            Ok(mut read) => {
                read.motion.name = file_names::unique(&read.motion.name, &mut names);
                motions.push(read);
            }
            Err(problems) => failures.extend(problems.into_iter().map(|problem| (index, problem))),
        }
    }
    (motions, failures)
}

fn read_one(index: usize, path: &Path, files: &MotionFiles) -> Result<ReadMotion, Problems> {
    let loaded = Loaded::read(path, files)?;
    let missing = |what: &str| {
        let problem = Problem::new(
            ProblemKind::Value,
            format!("there is no file with its {what} component"),
        );
        problem
            .in_file(path)
            .hint("name one for each motion, in the same order")
    };
    let mut read = match &files.second {
        Second::None => loaded.motion(Used::Chosen, files)?,
        Second::SameFile(called) => {
            let called = called
                .as_ref()
                .map(|(first, second)| (first.as_str(), second.as_str()));
            loaded.motion(Used::Two(called), files)?
        }
        Second::Files(paths) => {
            let Some(second_path) = paths.get(index) else {
                return Err(missing("second").into());
            };
            let second = Loaded::read(second_path, files)?;
            loaded.motion(Used::With(&second), files)?
        }
    };
    match &files.vertical {
        Upward::None | Upward::Itself(_) => {}
        Upward::SameFile => {
            read.motion.vertical = Some(loaded.vertical(None, &read.motion, files)?)
        }
        Upward::Files(paths) => {
            let Some(vertical_path) = paths.get(index) else {
                return Err(missing("vertical").into());
            };
            let other = Loaded::read(vertical_path, files)?;
            read.motion.vertical = Some(loaded.vertical(Some(&other), &read.motion, files)?);
        }
    }
    Ok(read)
}

/// A file as it was read.
struct Loaded {
    file: MotionFile,
    sha256: String,
}

/// Which components of a file are used.
#[derive(Clone, Copy)]
enum Used<'a> {
    /// The chosen one, or the only one; two of them turned to an azimuth.
    Chosen,
    /// Two of the file: those called so, or the only two that are horizontal.
    Two(Option<(&'a str, &'a str)>),
    /// Its own, and across it that of another file.
    With(&'a Loaded),
}

impl Loaded {
    fn read(path: &Path, files: &MotionFiles) -> Result<Self, Problems> {
        let bytes = load(path)?;
        let sha256 = sha256_hex(&bytes);
        Ok(Self {
            file: parse_motions(bytes, path, &files.read)?,
            sha256,
        })
    }

    /// The components, processed.
    fn motion(&self, used: Used<'_>, files: &MotionFiles) -> Result<ReadMotion, Problem> {
        let Self { file, sha256 } = self;
        let path = file.path.as_path();
        let in_file = |problem: Problem| problem.in_file(path);
        let (processed, chosen, across) = match used {
            Used::Chosen => {
                self.check_direction(files)?;
                let (processed, chosen) =
                    process_file(file, files.component.as_deref(), &files.processing)
                        .map_err(in_file)?;
                (processed, chosen, None)
            }
            Used::Two(called) => {
                let (first, second) = pair_of_one(file, called).map_err(in_file)?;
                let (processed, across) =
                    both(first, second, (&first.name, &second.name), files).map_err(in_file)?;
                (
                    processed,
                    chosen_words(first, second),
                    Some(SecondComponent {
                        file: None,
                        motion: across,
                    }),
                )
            }
            Used::With(other) => {
                let second_path = &other.file.path;
                let component = files.component.as_deref();
                let first = file.select(component).map_err(in_file)?;
                let second = other
                    .file
                    .select(component)
                    .map_err(|problem| problem.in_file(second_path))?;
                let names = (name_of(path), name_of(second_path));
                let (processed, across) =
                    both(first, second, (&names.0, &names.1), files).map_err(in_file)?;
                let input = InputFile {
                    path: second_path.clone(),
                    sha256: other.sha256.clone(),
                };
                let words = format!(", with {} across", names.1);
                (
                    processed,
                    words,
                    Some(SecondComponent {
                        file: Some(input),
                        motion: across,
                    }),
                )
            }
        };
        let scale_target = match &files.processing.scale {
            Scale::Spectrum(target) => target.file.clone(),
            _ => None,
        };
        let motion = RecordedMotion {
            name: name_of(path),
            path: path.to_path_buf(),
            sha256: sha256.clone(),
            description: format!("{}{chosen}", file.format),
            scale_ratio: processed.scale_ratio,
            station_xml: file.station_xml(),
            scale_target,
            processing: processed.steps,
            matched: None,
            suite: None,
            motion: processed.motion,
            across,
            vertical: None,
        };
        // Two components that were turned to an azimuth are of one file and have the same unit.
        let component = file
            .select(files.component.as_deref())
            .ok()
            .or(file.components.first());
        let unit = component.map_or("m/s2", |component| component.unit);
        let mut notes: Vec<Note> = file.notes.iter().cloned().chain(processed.notes).collect();
        if !files.read.is_shock {
            notes.extend(
                [
                    Some(&motion.motion),
                    motion.across.as_ref().map(|one| &one.motion),
                ]
                .into_iter()
                .flatten()
                .filter_map(standstill_note),
            );
        }
        Ok(ReadMotion {
            motion,
            notes,
            start_note: start_note(file),
            unit,
        })
    }

    /// Refuses a vertical component where a floor is shaken sideways.
    fn check_direction(&self, files: &MotionFiles) -> Result<(), Problem> {
        if files.processing.azimuth_deg.is_some() {
            return Ok(());
        }
        let chosen = self.file.select(files.component.as_deref());
        match files.vertical {
            Upward::Itself(key) => chosen.map(|_| ()).map_err(|problem| {
                let hint = format!("choose one by name or number with `{key}`");
                problem.hint(hint)
            }),
            _ => horizontal(chosen?).map_err(|problem| {
                problem
                    .in_file(&self.file.path)
                    .hint("choose a horizontal one with `component`; a vertical motion is given with `vertical`")
            }),
        }
    }

    /// The vertical component that belongs to a horizontal motion: of this file, or of another one.
    /// It is processed in the same way, and scaled by the same factor.
    fn vertical(
        &self,
        other: Option<&Self>,
        horizontal: &RecordedMotion,
        files: &MotionFiles,
    ) -> Result<SecondComponent, Problem> {
        let file = &other.unwrap_or(self).file;
        let in_file = |problem: Problem| problem.in_file(&file.path);
        let mut upward = file
            .components
            .iter()
            .filter(|component| component.direction == Some(Direction::Up));
        let component = match (
            upward.next(),
            upward.next(),
            other,
            file.components.as_slice(),
        ) {
            (Some(up), None, ..) => up,
            // A file that is named as the vertical one need not say so.
            (None, _, Some(_), [only]) => only,
            _ => {
                let problem = Problem::new(
                    ProblemKind::Value,
                    "does not have exactly one vertical component",
                );
                return Err(in_file(problem)
                    .hint("name a file with only the vertical component in `vertical`, or leave `vertical` out"));
            }
        };
        let processing = Processing {
            azimuth_deg: None,
            scale: Scale::Factor(horizontal.scale_ratio),
            ..files.processing.clone()
        };
        let motion = process(component, &processing).map_err(in_file)?.motion;
        let base = Base {
            horizontal: Some(&horizontal.motion),
            vertical: Some(&motion),
        };
        base.check()
            .map_err(|error| in_file(rocking_problem(error)))?;
        let input = other.map(|other| InputFile {
            path: other.file.path.clone(),
            sha256: other.sha256.clone(),
        });
        Ok(SecondComponent {
            file: input,
            motion,
        })
    }
}

/// Refuses a vertical component.
fn horizontal(component: &Component) -> Result<(), Problem> {
    if component.direction != Some(Direction::Up) {
        return Ok(());
    }
    Err(Problem::value(
        format!("component {} is vertical", shorten(&component.name)),
        "name two horizontal components",
    ))
}

/// Both components processed; the steps of the second follow those of the first.
fn both(
    first: &Component,
    second: &Component,
    names: (&str, &str),
    files: &MotionFiles,
) -> Result<(Processed, Motion), Problem> {
    [first, second].into_iter().try_for_each(horizontal)?;
    if files.processing.azimuth_deg.is_some() {
        return Err(Problem::new(
            ProblemKind::Value,
            "two components are used in all directions, not turned to one",
        )
        .hint("leave the azimuth out, or the second component"));
    }
    let (mut one, two) = process_pair((first, second), names, &files.processing)?;
    Pair::new(&one.motion, &two.motion).map_err(|error| {
        Problem::new(ProblemKind::Value, error.to_string()).hint(
            "resample one of them to the step of the other first, with the command motion convert",
        )
    })?;
    one.steps.extend(
        two.steps
            .into_iter()
            .map(|step| format!("{}: {step}", names.1)),
    );
    one.notes.extend(two.notes);
    one.notes.extend(not_perpendicular(first, second));
    Ok((one, two.motion))
}

fn chosen_words(first: &Component, second: &Component) -> String {
    format!(", components {} and {}", first.name, second.name)
}

/// The file's name without its extension; characters that are unsafe in a file name are replaced by
/// `-`.
pub fn name_of(path: &Path) -> String {
    let stem = path
        .file_stem()
        .map_or_else(|| "motion".into(), |stem| stem.to_string_lossy());
    file_names::made_of(&stem, "-_.", '-').unwrap_or_else(|| "motion".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_has_a_name_that_a_file_can_have() {
        for (path, name) in [
            ("x/quake one.csv", "quake-one"),
            ("x/CON.AT2", "CON-"),
            ("x/...", "motion"),
            ("x/RSN6_A:B.AT2", "RSN6_A-B"),
        ] {
            assert_eq!(name_of(Path::new(path)), name, "{path}");
        }
    }

    /// A floor is shaken sideways; only who says so reads a vertical component alone.
    #[test]
    fn a_vertical_component_is_no_floor_motion() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("three.csv");
        std::fs::write(
            &path,
            "time [s],N [g],E [g],UD [g]\n0,0,0,0\n0.01,0.5,0.4,0.3\n",
        )
        .unwrap();
        let read = |component: Option<&str>, vertical| {
            let words = freestand_input::keys::Words::default();
            let files = MotionFiles::read(
                &mut WordReader::new(&words),
                freestand_input::file::as_named,
            );
            let component = component.map(str::to_owned);
            read_all(&MotionFiles {
                paths: vec![path.clone()],
                component,
                vertical,
                ..files
            })
        };
        for component in ["UD", "3"] {
            let refused = read(Some(component), Upward::None).unwrap_err();
            assert_eq!(refused.problems[0].message, "component UD is vertical");
            assert!(read(Some(component), Upward::Itself("vertical_component")).is_ok());
        }
        assert!(read(Some("E"), Upward::None).is_ok());
        let unclear = read(None, Upward::Itself("vertical_component")).unwrap_err();
        let hint = unclear.problems[0].hint.as_deref();
        assert_eq!(
            hint,
            Some("choose one by name or number with `vertical_component`")
        );
    }

    /// A pipe gives its bytes once: they are read and fingerprinted from one reading, as they came.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_pipe_is_read_once() {
        use std::io::Write as _;
        use std::os::fd::AsRawFd as _;

        let (end, mut start) = std::io::pipe().unwrap();
        let text = b"\xEF\xBB\xBFtime [s],a [g]\n0,0\n0.01,0.5\n";
        // So few bytes wait in the pipe itself. Its start is then closed, so that a reading ends.
        start.write_all(text).unwrap();
        drop(start);
        let files = MotionFiles {
            paths: vec![format!("/dev/fd/{}", end.as_raw_fd()).into()],
            read: ReadOptions::default(),
            component: None,
            second: Second::None,
            vertical: Default::default(),
            processing: Processing::default(),
        };
        let (motions, failures) = read_recorded(&files);
        assert_eq!(
            (failures.len(), motions[0].motion.sha256.as_str()),
            (0, sha256_hex(text).as_str())
        );
    }
}
