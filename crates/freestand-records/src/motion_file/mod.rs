//! What is read from a record file: options, components, and what is checked and noted about each.

mod doubts;
mod found;

pub use crate::text::direction::Direction;
pub(crate) use doubts::doubts;

pub(crate) use found::{
    Found, channels_note, check_step, end_note, length_note, motion, peak_note, peak_note_of,
    refuse_not_finite, tell_apart, three_note,
};

use crate::notes::{Note, NoteKind};
use crate::text::sensitivity::Sensitivity;
use crate::text::units;
use freestand::motion::Motion;
use freestand_input::file::InputFile;
use freestand_input::problem::{Problem, ProblemKind};
use freestand_input::quantity::{Unit, shorten};
use std::path::{Path, PathBuf};

/// What the user states about a file that may not state it itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// Unit of acceleration, such as `g` or `cm/s2`. A file that states another one is refused.
    pub unit: Option<String>,
    /// Time step \[s\]. With it, all columns without a header are components; without it, the first
    /// is the time.
    pub dt_s: Option<f64>,
    /// Step \[s\] to which unevenly spaced samples are interpolated on straight lines; without it
    /// they are refused. Evenly spaced samples stay as they are:
    /// [`Processing::resample_dt_s`](crate::processing::Processing::resample_dt_s) changes their
    /// step, on a band-limited curve.
    pub uneven_dt_s: Option<f64>,
    /// StationXML with the sensitivity of a miniSEED file. Without it, the program looks for one
    /// next to the file.
    pub station_xml: Option<PathBuf>,
    /// Of the sensor of a shock whose column is in volts.
    pub sensitivity: Option<Sensitivity>,
    /// The file holds a shock, not a motion of the ground or a floor: hundreds of g need no note.
    pub is_shock: bool,
}

impl ReadOptions {
    /// The unit that the user states.
    pub(crate) fn unit(&self) -> Result<Option<&'static Unit>, Problem> {
        units::requested(self.unit.as_deref())
    }

    /// Checks what can be checked without a file.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        self.unit()?;
        let steps = [self.dt_s, self.uneven_dt_s];
        steps
            .into_iter()
            .flatten()
            .try_for_each(|dt_s| check_step(dt_s, ProblemKind::Value))
    }
}

/// A unit of acceleration, by its name.
///
/// # Errors
/// Another name.
pub fn parse_unit(text: &str) -> Result<String, Problem> {
    units::requested(Some(text)).map(|_| text.to_owned())
}

/// A record file, read.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionFile {
    /// Where it was read.
    pub path: PathBuf,
    /// What it is, such as `PEER AT2`, `COSMOS V1`, `columns` or `CSV`.
    pub format: &'static str,
    /// Its motions, in the order of the file; never empty.
    pub components: Vec<Component>,
    /// Notes for readers of the results: what was concluded or left out.
    pub notes: Vec<Note>,
}

/// One motion of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Component {
    /// Direction or column name, as the file has it; else the name of the file, or `component 2`.
    pub name: String,
    /// Station, where the file names it.
    pub station: Option<String>,
    /// Which way it points, where the file says so.
    pub direction: Option<Direction>,
    /// The unit in the file; the motion itself is in m/s².
    pub unit: &'static str,
    /// Whether the values include the offset of the instrument: K-NET, miniSEED, SAC, COSMOS V0.
    /// Their mean is removed before use, unless the user keeps it.
    pub is_raw: bool,
    /// Time of the first value, if the file states it. The motion itself begins at 0.
    pub start: Option<Start>,
    /// The StationXML with the sensitivity of its counts, where they were scaled by one.
    pub station_xml: Option<InputFile>,
    /// The motion, as the file has it.
    pub motion: Motion,
    /// Line of the first value, counted from 1; 1 in a binary file.
    pub line_of_first_value: usize,
}

/// Time of the first value of a component \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Start {
    /// As in the time column.
    Column(f64),
    /// Since the beginning of 1970, in UTC.
    Date(f64),
}

impl Start {
    /// The time \[s\]; two components of one file can be compared by it.
    pub fn seconds(self) -> f64 {
        match self {
            Self::Column(seconds) | Self::Date(seconds) => seconds,
        }
    }
}

/// What a reader finds in a file.
pub(crate) struct Reading {
    pub(crate) format: &'static str,
    pub(crate) components: Vec<Component>,
    pub(crate) notes: Vec<Note>,
}

impl Reading {
    /// # Errors
    /// No component: every file must have at least one.
    pub(crate) fn with_components(self) -> Result<Self, Problem> {
        if self.components.is_empty() {
            return Err(Problem::format(
                "holds no acceleration record",
                "the file may be cut off or damaged: fetch it again, or use the acceleration \
                 file of the same record",
            ));
        }
        Ok(self)
    }
}

impl MotionFile {
    /// The StationXML files by which its components were scaled, each once.
    pub fn station_xml(&self) -> Vec<InputFile> {
        let mut files: Vec<InputFile> = Vec::new();
        for file in self
            .components
            .iter()
            .filter_map(|one| one.station_xml.as_ref())
        {
            if !files.contains(file) {
                files.push(file.clone());
            }
        }
        files
    }

    /// Adds a note if a StationXML was named but not used.
    pub(crate) fn with_unused(mut self, options: &ReadOptions) -> Self {
        if let Some(xml) = &options.station_xml
            && self.station_xml().is_empty()
        {
            let words = format!(
                "{} was not used: a {} record does not need a StationXML file",
                xml.display(),
                self.format
            );
            self.notes.push(Note::new(NoteKind::XmlUnused, words));
        }
        self
    }

    /// The component with this name (capitals do not matter) or number (counted from 1); without a
    /// choice, the only one.
    ///
    /// # Errors
    /// Several components and no choice, or no such component; the message lists those that exist.
    pub fn select(&self, component: Option<&str>) -> Result<&Component, Problem> {
        let problem = match (component.map(str::trim), self.components.as_slice()) {
            (None, [only]) => return Ok(only),
            (None, all) => format!("has {} components: {}", all.len(), self.listing()),
            (Some(wanted), all) => {
                // A name may be copied from the header with its unit: "a [g]".
                let bare = wanted.split(['[', '(']).next().unwrap_or(wanted).trim();
                let called = |name: &str| -> Vec<&Component> {
                    all.iter()
                        .filter(|one| {
                            !name.is_empty() && one.name.to_lowercase() == name.to_lowercase()
                        })
                        .collect()
                };
                let named = [called(wanted), called(bare)]
                    .into_iter()
                    .find(|found| !found.is_empty())
                    .unwrap_or_default();
                match (named.as_slice(), wanted.parse::<usize>()) {
                    ([one], _) => return Ok(one),
                    ([], Ok(number)) if (1..=all.len()).contains(&number) => {
                        return Ok(&all[number - 1]);
                    }
                    ([], _) => format!(
                        "has no component \"{}\": {}",
                        shorten(wanted),
                        self.listing()
                    ),
                    _ => format!(
                        "has several components \"{}\": {}",
                        shorten(wanted),
                        self.listing()
                    ),
                }
            }
        };
        Err(
            Problem::value(problem, "choose one by name or number with `component`")
                .in_file(&self.path),
        )
    }

    fn listing(&self) -> String {
        const MAX: usize = 12;
        let mut listed: Vec<String> = self
            .components
            .iter()
            .take(MAX)
            .enumerate()
            .map(|(i, one)| format!("{} {}", i + 1, shorten(&one.name)))
            .collect();
        if self.components.len() > MAX {
            listed.push(format!("and {} more", self.components.len() - MAX));
        }
        listed.join(", ")
    }
}

/// Removes the line: a binary file does not have lines.
pub(crate) fn without_line(mut problem: Problem) -> Problem {
    problem.line = None;
    problem
}

/// The file's name without folder and extension, which names a component without a name of its own.
pub(crate) fn file_stem(path: &Path) -> String {
    path.file_stem().map_or_else(
        || "motion".to_owned(),
        |stem| stem.to_string_lossy().into_owned(),
    )
}
