//! Two horizontal components from record files: reads and turns them.

use std::path::PathBuf;

use crate::doubt::MotionDoubt;
use crate::recorded::{MotionFiles, name_of, start_note};
use freestand_input::file::file_name;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::shorten;
use freestand_input::words::number;
use freestand_records::formats::{Component, Direction, MotionFile, read_motions};
use freestand_records::notes::Note;
use freestand_records::processing::{
    Bearing, Processed, azimuth_of, pair_of_one, turned, with_azimuths,
};

/// Record files with two horizontal components.
#[derive(Debug, Clone, PartialEq)]
pub struct PairFiles {
    /// One file with both, or two files with one each; with two, `component` is the one to use of
    /// each.
    pub files: MotionFiles,
    /// The two of one file, by name or number; `None` if only two are possible.
    pub components: Option<(String, String)>,
}

/// Files with two horizontal components, read.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadPair {
    /// What was asked for.
    pub request: PairFiles,
    /// One file or two.
    pub files: Vec<MotionFile>,
}

/// Reads the files of a pair.
///
/// # Errors
/// Not one file or two, one file twice, a choice of components that contradicts them, an azimuth
/// (the direction to turn to is that of a [`RotateRequest`]), and the problems of both files.
pub fn read_pair(request: &PairFiles) -> Result<ReadPair, Problems> {
    request.check()?;
    refuse_same_file(&request.files.paths)?;
    let mut problems = Problems::default();
    let read = |path: &PathBuf| problems.keep(read_motions(path, &request.files.read));
    let files = request.files.paths.iter().filter_map(read).collect();
    problems.finish(Some(ReadPair {
        request: request.clone(),
        files,
    }))
}

impl PairFiles {
    /// Refuses what does not go together, before a file is read.
    ///
    /// # Errors
    /// Each contradiction, under its key.
    pub fn check(&self) -> Result<(), Problems> {
        let is_one = self.files.paths.len() == 1;
        let wrong = [
            (
                !matches!(self.files.paths.len(), 1 | 2),
                "motion",
                "give one or two files",
                "one file with both components, or two files with one each",
            ),
            (
                self.files.processing.azimuth_deg.is_some(),
                "azimuth",
                "`azimuth` cannot be combined with a pair, which is read without turning it",
                "turn the pair with the command motion rotate",
            ),
            (
                self.components.is_some() && self.files.paths.len() == 2,
                "components",
                "`components` chooses two components of one file, but two files are given",
                "choose one of each file with `component`",
            ),
            (
                self.files.component.is_some() && is_one,
                "component",
                "`component` chooses one component of each of two files, but one file is given",
                "choose two of the file with `components`",
            ),
        ];
        let found = wrong.into_iter().filter(|(is_wrong, ..)| *is_wrong);
        found
            .map(|(_, key, message, hint)| Problem::value(message, hint).of(&[key]))
            .collect::<Problems>()
            .finish(Some(()))
    }
}

/// Of one file given twice, the same component would be used for both.
fn refuse_same_file(paths: &[PathBuf]) -> Result<(), Problem> {
    let [first, second] = paths else {
        return Ok(());
    };
    let real = |path: &PathBuf| std::fs::canonicalize(path).ok();
    match (real(first), real(second)) {
        // A device or a pipe may give other bytes each time.
        (Some(one), Some(two)) if one == two && one.is_file() => {
            let message = "is given twice: a pair is two files, or two components of one file";
            let hint =
                "give it once; if it has more than two components, choose them with `components`";
            Err(Problem::value(message, hint).in_file(second))
        }
        _ => Ok(()),
    }
}

impl ReadPair {
    /// The two components.
    ///
    /// # Errors
    /// The errors of [`MotionFile::select`] and [`pair_of_one`], or a vertical component.
    pub fn components(&self) -> Result<(&Component, &Component), Problem> {
        let pair = match self.files.as_slice() {
            [one, two] => {
                let component = self.request.files.component.as_deref();
                Ok((one.select(component)?, two.select(component)?))
            }
            [one] => {
                let called = self.request.components.as_ref();
                pair_of_one(
                    one,
                    called.map(|(first, second)| (first.as_str(), second.as_str())),
                )
            }
            _ => Err(Problem::value(
                "give one or two files",
                "read them with read_pair",
            )),
        }?;
        match [pair.0, pair.1].into_iter().find(|one| one.direction == Some(Direction::Up)) {
            Some(up) => Err(Problem::new(ProblemKind::Value, format!("component {} is vertical", shorten(&up.name)))
                .hint("choose the two horizontal ones with `components`, or with `component` of two files")),
            None => Ok(pair),
        }
    }

    /// The names of the two components for texts: if they are equal, with the names of their files,
    /// and if those are equal too, with their paths.
    pub fn names(&self, components: (&Component, &Component)) -> (String, String) {
        let (one, two) = (components.0.name.clone(), components.1.name.clone());
        match self.files.as_slice() {
            [first, second] if one == two => {
                let short = |file: &MotionFile| {
                    file_name(&file.path)
                        .unwrap_or_else(|| file.path.to_string_lossy().into_owned())
                };
                let mut files = (short(first), short(second));
                if files.0 == files.1 {
                    files = (
                        first.path.display().to_string(),
                        second.path.display().to_string(),
                    );
                }
                (
                    format!("{one} of {}", files.0),
                    format!("{two} of {}", files.1),
                )
            }
            _ => (one, two),
        }
    }

    /// What the readers concluded or ignored, file by file.
    pub fn notes(&self) -> Vec<String> {
        let of = |file: &MotionFile| {
            let path = file.path.display().to_string();
            file.notes
                .iter()
                .map(move |note| format!("{path}: {note}"))
                .collect::<Vec<_>>()
        };
        self.files.iter().flat_map(of).collect()
    }
}

/// A direction to turn to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotateRequest {
    /// The direction \[degrees clockwise from north\].
    pub azimuth_deg: f64,
    /// Azimuths of the two components \[degrees\]; `None`: as the files state them.
    pub azimuths_deg: Option<(f64, f64)>,
}

/// The component of a pair in another direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Rotated {
    /// A name for outputs: that of the first file and the azimuth.
    pub name: String,
    /// The first file.
    pub path: PathBuf,
    /// The direction in which it points \[degrees clockwise from north\].
    pub azimuth_deg: f64,
    /// The motion, and what was done.
    pub processed: Processed,
    /// What the readers concluded or ignored, and what was noted of the processing.
    pub doubts: Vec<MotionDoubt>,
}

/// Turns a pair to an azimuth and processes it.
///
/// # Errors
/// An azimuth that neither the file nor the request states; otherwise as [`ReadPair::components`]
/// and [`turned`].
pub fn rotate(read: &ReadPair, request: &RotateRequest) -> Result<Rotated, Problem> {
    let components = read.components()?;
    let (first, second) = with_azimuths(components, request.azimuths_deg)?;
    let names = read.names(components);
    let names = (names.0.as_str(), names.1.as_str());
    let processed = turned(
        first,
        second,
        names,
        request.azimuth_deg,
        &read.request.files.processing,
    )?;
    let path = read
        .files
        .first()
        .map(|file| file.path.clone())
        .unwrap_or_default();
    let mut notes = read.notes();
    let start =
        |file: &MotionFile| start_note(file).map(|note| format!("{}: {note}", file.path.display()));
    notes.extend(read.files.iter().filter_map(start));
    notes.extend(processed.notes.iter().map(Note::to_string));
    let named = [(names.0, first), (names.1, second)];
    let notes = notes.into_iter().map(MotionDoubt::OfRecords);
    let doubts = notes.chain(named.into_iter().filter_map(contradicted));
    let name = format!(
        "{}-{}deg",
        name_of(&path),
        number(request.azimuth_deg.rem_euclid(360.0), 6)
    );
    Ok(Rotated {
        name,
        path,
        azimuth_deg: request.azimuth_deg,
        processed,
        doubts: doubts.collect(),
    })
}

/// What a file says of a direction, where the request says otherwise.
fn contradicted((name, (component, used_deg)): (&str, Bearing<'_>)) -> Option<MotionDoubt> {
    let stated_deg = azimuth_of(component)?;
    let turn_deg = (stated_deg - used_deg).rem_euclid(360.0);
    (turn_deg.min(360.0 - turn_deg) > AZIMUTH_TOLERANCE_DEG).then(|| MotionDoubt::OtherDirection {
        component: shorten(name).to_string(),
        stated_deg,
        used_deg,
    })
}

/// Files round the azimuths of their components to whole degrees.
const AZIMUTH_TOLERANCE_DEG: f64 = 0.5;

#[cfg(test)]
mod tests;
