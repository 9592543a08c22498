//! Ground and floor motions from record files: which format a file has is told from its content, never from its name.

mod at2;
mod bhrc;
mod binary;
mod columns;
mod cosmos;
mod csmip;
mod cwa;
mod dialect;
mod direction;
mod dyna;
mod even_grid;
mod format;
mod fortran;
mod geonet;
mod headings;
mod instant;
mod keyed;
mod knet;
mod lines;
mod mseed;
mod nsmn;
mod pairs;
mod rows;
mod sac;
mod sampling;
mod sigma;
mod smc;
mod stated_step;
mod station_xml;
mod table;
mod unam;
mod units;
mod usc;
mod volumes;
mod write;

pub use direction::Direction;
pub(crate) use lines::load;
pub(crate) use write::{push_shortest, shortest};
pub use write::{write_at2, write_csv};

use crate::error::{Problem, ProblemKind, StudyError};
use crate::quantity::shorten;
use freestand::motion::Motion;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// What the user says about a file that may not say it itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// Unit of acceleration, such as `g` or `cm/s2`. A file that states another one is refused.
    pub unit: Option<String>,
    /// Time step \[s\]. Columns without a header are then all components; otherwise the first is the time.
    pub dt_s: Option<f64>,
    /// Step \[s\] at which the straight lines between unevenly spaced samples are read; without it they are refused. Evenly
    /// spaced samples stay as they are: their step is changed by
    /// [`Processing::resample_dt_s`](crate::processing::Processing::resample_dt_s), on a band-limited curve.
    pub uneven_dt_s: Option<f64>,
    /// StationXML with the sensitivity of a miniSEED file; without it one is looked for beside the file.
    pub station_xml: Option<PathBuf>,
}

impl ReadOptions {
    /// Whether they can be meant, whatever the file.
    ///
    /// # Errors
    /// A unit that is not one of acceleration, or a time step outside 1e-6 s to 100 s.
    pub fn check(&self) -> Result<(), Problem> {
        units::requested(self.unit.as_deref())?;
        let steps = [self.dt_s, self.uneven_dt_s];
        steps.into_iter().flatten().try_for_each(|dt_s| check_step(dt_s, ProblemKind::Value))
    }
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
    /// What was concluded or left out that a reader of results should know.
    pub notes: Vec<String>,
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
    /// Whether these are an instrument's own values, with its offset in them: K-NET, miniSEED, SAC, COSMOS V0. Their mean
    /// is removed before use, unless the user keeps it.
    pub is_raw: bool,
    /// The motion, as the file has it.
    pub motion: Motion,
    /// Line of the first value, counted from 1; 1 in a binary file.
    pub line_of_first_value: usize,
}

/// Reads a record file.
///
/// # Errors
/// A file that cannot be read, whose format is not known, that is broken or has gaps, or that leaves the unit or the time
/// step open where the options do too. Nothing is guessed from the size of values.
pub fn read_motions(path: &Path, options: &ReadOptions) -> Result<MotionFile, StudyError> {
    parse_motions(load(path)?, path, options)
}

/// As [`read_motions`], from bytes in memory; `path` names them in messages, and a miniSEED file's StationXML is looked for
/// beside it.
///
/// # Errors
/// As [`read_motions`].
///
/// # Example
/// ```
/// use freestand_study::records::{ReadOptions, parse_motions};
/// let file = parse_motions(b"time [s],a [g]\n0,0\n0.01,0.5\n".to_vec(), "x.csv".as_ref(), &ReadOptions::default())?;
/// assert_eq!(file.components[0].motion.peak_m_s2(), 0.5 * freestand::G0_M_S2);
/// # Ok::<(), freestand_study::StudyError>(())
/// ```
pub fn parse_motions(mut bytes: Vec<u8>, path: &Path, options: &ReadOptions) -> Result<MotionFile, StudyError> {
    // A wrong flag is no fault of the file.
    options.check()?;
    let read = reader(&mut bytes).map_err(|problem| problem.in_file(path))?;
    let Reading { format, components, notes } = read(&bytes, path, options).map_err(|problem| problem.in_file(path))?;
    Ok(MotionFile { path: path.to_path_buf(), format, components, notes })
}

/// What a reader finds in a file.
struct Reading {
    format: &'static str,
    components: Vec<Component>,
    notes: Vec<String>,
}

/// A family of formats that share a layout.
struct Family {
    /// Looks at the first lines; the first family that says yes reads the file.
    recognises: fn(&[u8]) -> bool,
    read: Reader,
}

type Reader = fn(&[u8], &Path, &ReadOptions) -> Result<Reading, Problem>;

/// Formats that are no text. They are asked first: what they do not recognise must be text.
const BINARY: &[Family] =
    &[Family { recognises: mseed::is_mseed, read: mseed::read }, Family { recognises: sac::is_sac, read: sac::read }];

/// From the most particular signature to the least; what none recognises is columns.
const FAMILIES: &[Family] = &[
    Family { recognises: smc::is_smc, read: smc::read },
    Family { recognises: cosmos::is_cosmos, read: cosmos::read },
    Family { recognises: geonet::is_geonet, read: geonet::read },
    Family { recognises: usc::is_usc, read: usc::read },
    Family { recognises: csmip::is_csmip, read: csmip::read },
    Family { recognises: knet::is_knet, read: knet::read },
    Family { recognises: cwa::is_cwa, read: cwa::read },
    Family { recognises: unam::is_unam, read: unam::read },
    Family { recognises: bhrc::is_bhrc, read: bhrc::read },
    Family { recognises: dyna::is_dyna, read: dyna::read },
    Family { recognises: nsmn::is_nsmn, read: nsmn::read },
    Family { recognises: sigma::is_sigma, read: sigma::read },
    Family { recognises: sac::is_text_sac, read: sac::read_text },
    Family { recognises: at2::is_at2, read: at2::read },
];

/// How much of a text is looked at to tell its format: more than the longest header, 300 lines of 80 characters. A file of
/// one endless line must not be searched for each signature.
const SNIFFED_BYTES: usize = 64 << 10;

/// The reader of the format that the content shows; what is not binary is made sure to be text.
fn reader(bytes: &mut Vec<u8>) -> Result<Reader, Problem> {
    if let Some(family) = BINARY.iter().find(|family| (family.recognises)(bytes)) {
        return Ok(family.read);
    }
    lines::check_text(bytes)?;
    let head = &bytes[..bytes.len().min(SNIFFED_BYTES)];
    Ok(FAMILIES.iter().find(|family| (family.recognises)(head)).map_or(columns::read, |family| family.read))
}

impl MotionFile {
    /// The component called for: by name (capitals do not matter), or by number counted from 1; the only one where
    /// nothing is called for.
    ///
    /// # Errors
    /// Several components and no choice, or a choice that is not there; the message lists what is.
    pub fn select(&self, component: Option<&str>) -> Result<&Component, Problem> {
        let problem = match (component.map(str::trim), self.components.as_slice()) {
            (None, [only]) => return Ok(only),
            (None, all) => format!("has {} components: {}", all.len(), self.listing()),
            (Some(wanted), all) => {
                // A name may be copied from the header with its unit: "a [g]".
                let bare = wanted.split(['[', '(']).next().unwrap_or(wanted).trim();
                let called = |name: &str| -> Vec<&Component> {
                    all.iter()
                        .filter(|one| !name.is_empty() && one.name.to_lowercase() == name.to_lowercase())
                        .collect()
                };
                let named =
                    [called(wanted), called(bare)].into_iter().find(|found| !found.is_empty()).unwrap_or_default();
                match (named.as_slice(), wanted.parse::<usize>()) {
                    ([one], _) => return Ok(one),
                    ([], Ok(number)) if (1..=all.len()).contains(&number) => return Ok(&all[number - 1]),
                    ([], _) => format!("has no component \"{}\": {}", shorten(wanted), self.listing()),
                    _ => format!("has several components \"{}\": {}", shorten(wanted), self.listing()),
                }
            }
        };
        Err(Problem::new(ProblemKind::Value, problem)
            .in_file(&self.path)
            .hint("choose one by name or number (--component, or component in the study)"))
    }

    fn listing(&self) -> String {
        const MOST: usize = 12;
        let mut listed: Vec<String> = self
            .components
            .iter()
            .take(MOST)
            .enumerate()
            .map(|(i, one)| format!("{} {}", i + 1, shorten(&one.name)))
            .collect();
        if self.components.len() > MOST {
            listed.push(format!("and {} more", self.components.len() - MOST));
        }
        listed.join(", ")
    }
}

/// Time steps that a record of the ground or of a floor may have \[s\]. Records have 1 ms to some
/// tenths of a second. Far outside, the step was written in another unit or is damaged, and a building's floors at steps
/// of nanoseconds would fill the memory.
const STEPS_S: std::ops::RangeInclusive<f64> = 1e-6..=100.0;

pub(crate) fn check_step(dt_s: f64, kind: ProblemKind) -> Result<(), Problem> {
    if STEPS_S.contains(&dt_s) {
        return Ok(());
    }
    let (message, hint) = if dt_s > 0.0 {
        let hint = if dt_s > 1.0 { "is it in ms?" } else { "is it in another unit?" };
        (format!("the time step must be from 1e-6 s to 100 s, not {dt_s:?} s"), format!("{hint} state it in s"))
    } else {
        (format!("the time step must be positive, not {dt_s} s"), "write it in s or ms".to_owned())
    };
    Err(Problem::new(kind, message).hint(hint))
}

/// One component as a reader finds it in an agency's file, where unit and step are never open.
struct Found {
    name: String,
    station: Option<String>,
    direction: Option<Direction>,
    /// Name of the unit in the file.
    unit: &'static str,
    /// What one of it is worth \[m/s²\].
    unit_m_s2: f64,
    dt_s: f64,
    values: Vec<f64>,
    /// Line of the first value, counted from 1.
    line: usize,
    is_raw: bool,
}

impl Found {
    /// The component in SI.
    ///
    /// # Errors
    /// A user's unit or time step that contradicts the file's, a step outside 1e-6 s to 100 s, fewer than two values.
    fn component(mut self, options: &ReadOptions) -> Result<Component, Problem> {
        if let Some(unit) = units::requested(options.unit.as_deref())?
            // The last bit may differ where a factor is composed, as in counts times a scale.
            && (unit.to_si(1.0) - self.unit_m_s2).abs() > 1e-12 * self.unit_m_s2
            && unit.symbol != self.unit
        {
            let message = format!("the record is in {} as the file says, not in {}", self.unit, unit.symbol);
            return Err(Problem::new(ProblemKind::Value, message)
                .at_line(self.line)
                .hint("leave out the unit (--unit, or unit in the study), or correct the file if it is wrong"));
        }
        if let Some(dt_s) = options.dt_s
            // One part in a million is a difference in printing, not in meaning.
            && (dt_s - self.dt_s).abs() > 1e-6 * self.dt_s
        {
            let message = format!("the time step is {} s as the header says, not {dt_s} s", self.dt_s);
            return Err(Problem::new(ProblemKind::Value, message)
                .at_line(self.line)
                .hint("leave out the step (--dt, or dt in the study), or correct the file if it is wrong"));
        }
        for value in &mut self.values {
            *value *= self.unit_m_s2;
        }
        Ok(Component {
            name: self.name,
            station: self.station,
            direction: self.direction,
            unit: self.unit,
            is_raw: self.is_raw,
            motion: motion(self.dt_s, self.values, self.line)?,
            line_of_first_value: self.line,
        })
    }
}

/// Adds the place in the file to names that several components share: a structure has several sensors of one direction.
fn tell_apart(components: &mut [Component]) {
    let mut uses: HashMap<String, usize> = HashMap::new();
    for component in components.iter() {
        *uses.entry(component.name.to_lowercase()).or_default() += 1;
    }
    for (i, component) in components.iter_mut().enumerate() {
        if uses.get(&component.name.to_lowercase()).is_some_and(|count| *count > 1) {
            component.name = format!("{}, channel {}", component.name, i + 1);
        }
    }
}

/// What is to be said where the largest value is not the one that the header states \[m/s², any sign\].
///
/// Some agencies print the peak with the opposite sign, and most with three digits: 1 % is what rounding of three can
/// make of it.
fn peak_note(component: &Component, header_peak_m_s2: f64) -> Option<String> {
    let found = component.motion.peak_m_s2();
    let stated = header_peak_m_s2.abs();
    // A header without a peak has 0 or a value that stands for a missing one.
    let is_stated = stated > 0.0 && stated < 1e4;
    (is_stated && (found - stated).abs() > 0.01 * stated).then(|| {
        let name = shorten(&component.name);
        format!("{name}: the largest value is {found:.5} m/s2, but the header states a peak of {stated:.5} m/s2")
    })
}

/// In a binary file nothing stands on a line.
fn without_line(mut problem: Problem) -> Problem {
    problem.line = None;
    problem
}

/// Samples in m/s² as a motion.
fn motion(dt_s: f64, accel_m_s2: Vec<f64>, line: usize) -> Result<Motion, Problem> {
    check_step(dt_s, ProblemKind::Format).map_err(|problem| problem.at_line(line))?;
    Motion::new(dt_s, accel_m_s2).map_err(|error| {
        Problem::new(ProblemKind::Format, error.to_string()).at_line(line).hint("check that the record is complete")
    })
}

/// The file's name without folder and extension, as the name of what is in it.
fn file_stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "motion".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests;
