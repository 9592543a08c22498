//! Records of motions: how they are read and processed.

use std::path::PathBuf;

use freestand::motion::Motion;
use freestand_input::file::as_named;
use freestand_input::keys::Words;
use freestand_input::problem::{Problem, ProblemKind, Problems};
use freestand_input::quantity::{Dimension, shorten};
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_records::notes::Note;
use freestand_records::processing::{Processing, parse_target_source};
use freestand_study::recorded::{MotionFiles, ReadMotion, Second, Upward, read_all};

use crate::files::{Content, Files, not_sent};
use crate::request::{Request, request};

request! {
    /// How records are read and processed; the processing is in the order of its options.
    pub struct Records under "Reading records" {
        /// Unit of acceleration, such as g, m/s2 or gal, of a file that does not state it
        pub unit = "UNIT",
        /// Time step of a file without a column of times
        pub dt = "TIME",
        /// Component to read from a file with several, by name or by number (from 1)
        pub component = "NAME|NUMBER",
        /// StationXML file with the sensitivity of a miniSEED file [default: the one in the same folder]
        pub station_xml = "FILE",
        /// Do not remove the mean of raw records (counts, miniSEED, SAC)
        pub keep_mean = switch,
        /// Factor that multiplies the samples [default: 1]
        pub scale = "RATIO",
        /// Rotate the two horizontal components of a file to this azimuth, clockwise from north
        #[arg(
            long,
            value_name = "ANGLE",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub azimuth: Option<Written>,
        /// Baseline to remove: mean, pre-event:5s, linear, quadratic, cubic, poly:N, graizer, graizer:N:5s, boore:T1:T2
        ///
        /// mean and pre-event remove a constant: the mean of the record or of its first seconds. linear, quadratic,
        /// cubic and poly:N remove a polynomial fitted to the acceleration. graizer removes the derivative of a
        /// polynomial fitted to the velocity, of degree 2 or N, from 0 s or from the time given (Graizer 1979). boore
        /// removes two offsets, one from T1 to T2 and one after T2, so that the velocity ends near zero (Iwan 1985,
        /// Boore 2001).
        #[arg(
            long,
            value_name = "BASELINE",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub baseline: Option<Written>,
        /// Length of the cosine taper at each end, as a share of the record
        #[arg(
            long,
            value_name = "RATIO",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub taper: Option<Written>,
        /// Corner frequency of a high-pass filter
        ///
        /// A Butterworth filter is run forwards and backwards: it shifts nothing in time and halves the amplitude at the
        /// corner. Zeros are added before and after the record for a time of 1.5 × order / corner, and are kept, so that
        /// the record starts earlier (Boore 2005).
        #[arg(
            long,
            value_name = "FREQUENCY",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub low_cut: Option<Written>,
        /// Corner frequency of a low-pass filter of the same kind
        #[arg(
            long,
            value_name = "FREQUENCY",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub high_cut: Option<Written>,
        /// Order of the filters, from 1 to 10 [default: 4]
        #[arg(
            long,
            value_name = "N",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub filter_order: Option<Written>,
        /// New time step, by band-limited interpolation (by straight lines if samples are unevenly spaced)
        #[arg(
            long,
            value_name = "TIME",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub resample: Option<Written>,
        /// Scale to this peak acceleration, such as "0.3 g"
        #[arg(
            long,
            value_name = "ACCELERATION",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub scale_to: Option<Written>,
        /// Scale to a pseudo-acceleration, such as "0.4 g at 1.2 s", or "0.4 g at 1.2 s, 2 %" for a damping other than 5 %
        #[arg(
            long,
            value_name = "ACCELERATION at PERIOD",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub scale_to_sa: Option<Written>,
        /// Scale to the spectrum of a file, such as target.csv; "target.csv, 0.1 s to 2 s, 2 %" uses a part of it and a
        /// damping of 2 %
        ///
        /// The file has columns of periods and pseudo-accelerations with units in their headings, such as `period [s];
        /// PSA [g]`, or is the spectrum.csv of `freestand motion spectrum --out`. The factor minimises the squared error of
        /// ln PSA, in which every period of the file has the same weight. The damping is that of the file if it states
        /// exactly one, and otherwise 5 %.
        #[arg(
            long,
            value_name = "FILE[, PERIODS][, DAMPING]",
            hide_short_help = true,
            help_heading = "Processing records, in this order"
        )]
        pub scale_to_spectrum: Option<Written>,
    }
}

request! {
    /// How vertical records are read.
    pub struct VerticalRecords {
        /// Factor that multiplies the vertical samples [default: 1]
        pub vertical_scale = "RATIO",
        /// Component to read from the vertical record, if it has several
        pub vertical_component = "NAME|NUMBER",
    }
}

/// The records of a request, checked but for what is in them.
pub(crate) struct NamedRecords<'f> {
    files: &'f Files,
    how: MotionFiles,
    upward: MotionFiles,
    horizontal: Vec<String>,
    vertical: Vec<String>,
}

/// A motion, and what its reader concluded.
#[derive(Debug, Clone, PartialEq)]
pub struct OneMotion {
    /// Its name.
    pub name: String,
    /// Its samples.
    pub motion: Motion,
    /// What the reader concluded or doubts.
    pub notes: Vec<Note>,
    /// What was done to the samples.
    pub processing: Vec<String>,
    /// The second horizontal component of its file.
    pub(crate) across: Option<Motion>,
}

impl From<ReadMotion> for OneMotion {
    fn from(ReadMotion { motion, notes, .. }: ReadMotion) -> Self {
        Self {
            name: motion.name,
            motion: motion.motion,
            across: motion.across.map(|across| across.motion),
            notes,
            processing: motion.processing,
        }
    }
}

/// The motions of a request.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadMotions {
    /// The horizontal motions.
    pub horizontal: Vec<OneMotion>,
    /// The second horizontal component of the last of them.
    pub across: Option<Motion>,
    /// The record of that component, if it has one of its own.
    second: Vec<OneMotion>,
    /// The vertical motions.
    pub vertical: Vec<OneMotion>,
    /// The files that were read.
    pub inputs: Vec<PathBuf>,
}

impl Records {
    /// As [`Records::named`], without vertical records.
    pub(crate) fn named_alone<'f>(
        &self,
        read: &mut WordReader<'_>,
        motion: &[Written],
        files: &'f Files,
    ) -> NamedRecords<'f> {
        self.named(read, motion, (&[], &VerticalRecords::default()), files)
    }

    /// How the records that a request names are read; what no file allows is a problem.
    pub(crate) fn named<'f>(
        &self,
        read: &mut WordReader<'_>,
        motion: &[Written],
        (vertical, how_vertical): (&[Written], &VerticalRecords),
        files: &'f Files,
    ) -> NamedRecords<'f> {
        let words = self.words();
        let keys: Vec<&'static str> = words.entries().map(|(key, _)| key).collect();
        read.pass(&["motion", "vertical"]);
        read.pass(&keys);
        if motion.is_empty() && vertical.is_empty() && !keys.is_empty() {
            let named = keys
                .iter()
                .map(|key| format!("`{key}`"))
                .collect::<Vec<_>>()
                .join(", ");
            read.note(
                &keys,
                format!("{named}: there is no record to read"),
                "name the record, or leave it out",
            );
        }
        // Some commands take them without a flag that a message could name.
        for (key, names) in [("motion", motion), ("vertical", vertical)] {
            for name in names.iter().map(Written::text) {
                let found = files.find(&name).map_err(|problem| problem.of(&[key]));
                read.problems.keep(found.map_err(Problems::from));
            }
        }
        let own = vertical_words(&words, (vertical, how_vertical), read);
        let how = |words: &Words| {
            let mut reader = WordReader::new(words);
            let how = MotionFiles::read(&mut reader, |name| files.path(name));
            (how, reader.problems)
        };
        let (horizontally, problems) = how(&words);
        problems
            .into_iter()
            .for_each(|problem| read.problems.push(problem));
        // What is wrong for both has been said; its scale is its own.
        let (upward, problems) = how(&own);
        let of_scale = problems
            .into_iter()
            .filter(|problem| problem.is_about("scale"));
        of_scale.for_each(|problem| {
            read.problems
                .push(problem.renamed("scale", "vertical_scale"))
        });
        NamedRecords {
            files,
            how: horizontally,
            upward: MotionFiles {
                vertical: Upward::Itself("vertical_component"),
                ..upward
            },
            horizontal: motion.iter().map(Written::text).collect(),
            vertical: vertical.iter().map(Written::text).collect(),
        }
    }

    /// The motions of these files, in any direction.
    ///
    /// # Errors
    /// All problems of these options, or else of the files.
    pub fn read_files(&self, paths: Vec<PathBuf>) -> Result<Vec<ReadMotion>, Problems> {
        let words = self.words();
        let mut read = WordReader::new(&words);
        let files = MotionFiles {
            paths,
            vertical: Upward::Itself("component"),
            ..MotionFiles::read(&mut read, as_named)
        };
        read_all(&read.problems.finish(Some(files))?)
    }

    /// What is done to the samples of a motion.
    ///
    /// # Errors
    /// All problems of these options.
    pub fn processing(&self) -> Result<Processing, Problems> {
        let words = self.words();
        let mut read = WordReader::new(&words);
        let processing = Processing::read(&mut read, as_named);
        read.problems.finish(Some(processing))
    }

    /// The files that these options name: StationXML, and the target that records are scaled to.
    pub(crate) fn inputs(&self, files: &Files) -> Vec<PathBuf> {
        let target = self.scale_to_spectrum.as_ref().map(Written::text);
        let target = target
            .and_then(|text| parse_target_source(&text).ok())
            .and_then(|target| files.path(&target.path.to_string_lossy()).ok());
        let station_xml = files.path_of(self.station_xml.as_ref());
        station_xml.into_iter().chain(target).collect()
    }
}

/// How the vertical record is read: unit, step, baseline and filters are those of the horizontal one; its scale and
/// its component are its own, and it is not rotated.
fn vertical_words(
    words: &Words,
    (vertical, how): (&[Written], &VerticalRecords),
    read: &mut WordReader<'_>,
) -> Words {
    let mut own = words.clone();
    for key in [
        "component",
        "scale",
        "azimuth",
        "scale_to",
        "scale_to_sa",
        "scale_to_spectrum",
    ] {
        own.remove(key);
    }
    let scale = read.quantity("vertical_scale", Dimension::Ratio);
    read.text("vertical_component");
    for key in ["vertical_scale", "vertical_component"] {
        if read.has(key) && vertical.is_empty() {
            read.note(
                &[key],
                format!("`{key}` needs `vertical`"),
                "name the vertical record, or leave it out",
            );
        }
    }
    if let Some(component) = &how.vertical_component {
        own.write("component", component);
    }
    if let Some(ratio) = scale {
        own.write("scale", &Written::Number(ratio));
    }
    own
}

impl NamedRecords<'_> {
    /// Whether there is neither a horizontal nor a vertical record.
    pub(crate) fn is_none(&self) -> bool {
        self.horizontal.is_empty() && self.vertical.is_empty()
    }

    /// How the horizontal records are read.
    pub(crate) fn how(&self) -> &MotionFiles {
        &self.how
    }

    /// The number of horizontal records.
    pub(crate) fn count(&self) -> usize {
        self.horizontal.len()
    }

    /// The motions. `second` says where the second horizontal component is; `across` names the record of it.
    pub(crate) fn read(
        &self,
        second: Second,
        across: Option<&str>,
    ) -> Result<ReadMotions, Problems> {
        let how = MotionFiles {
            second,
            ..self.how.clone()
        };
        let across: Vec<String> = across.map(str::to_owned).into_iter().collect();
        let mut problems = Problems::default();
        let of = |motions: Vec<ReadMotion>| motions.into_iter().map(OneMotion::from).collect();
        let horizontal = problems.keep(self.motions("motion", &self.horizontal, &how).map(of));
        let second = problems.keep(self.motions("motion_y", &across, &self.how).map(of));
        let vertical = problems.keep(self.verticals().map(of));
        let ((horizontal, second), vertical): ((Vec<OneMotion>, Vec<OneMotion>), _) =
            problems.finish(horizontal.zip(second).zip(vertical))?;
        let last = horizontal.last().and_then(|one| one.across.clone());
        let names = self.horizontal.iter().chain(&across).chain(&self.vertical);
        Ok(ReadMotions {
            inputs: self.paths_of(names),
            across: second.first().map(|one| one.motion.clone()).or(last),
            second,
            horizontal,
            vertical,
        })
    }

    /// The motions as shocks, which may have larger peaks than those of any floor, in any direction.
    pub(crate) fn shocks(&self) -> Result<Vec<ReadMotion>, Problems> {
        let mut how = self.how.clone();
        how.read.is_shock = true;
        how.vertical = Upward::Itself("component");
        self.read_as(&how)
    }

    /// The motions in any direction.
    pub(crate) fn in_any_direction(&self) -> Result<Vec<ReadMotion>, Problems> {
        self.read_as(&MotionFiles {
            vertical: Upward::Itself("component"),
            ..self.how.clone()
        })
    }

    /// The only motion, in any direction.
    pub(crate) fn one(&self) -> Result<ReadMotion, Problems> {
        let missing = || {
            let message = "the file was read but contains no motion";
            Problem::new(ProblemKind::Computation, message).into()
        };
        self.in_any_direction()?.pop().ok_or_else(missing)
    }

    /// The horizontal motions, read in this way.
    pub(crate) fn read_as(&self, how: &MotionFiles) -> Result<Vec<ReadMotion>, Problems> {
        self.motions("motion", &self.horizontal, how)
    }

    /// The vertical motions.
    pub(crate) fn verticals(&self) -> Result<Vec<ReadMotion>, Problems> {
        self.motions("vertical", &self.vertical, &self.upward)
    }

    /// The files of all records.
    pub(crate) fn all_paths(&self) -> Vec<PathBuf> {
        self.paths_of(self.horizontal.iter().chain(&self.vertical))
    }

    /// The files of the horizontal records.
    pub(crate) fn paths(&self) -> Vec<PathBuf> {
        self.paths_of(&self.horizontal)
    }

    fn paths_of<'n>(&self, names: impl IntoIterator<Item = &'n String>) -> Vec<PathBuf> {
        let names = names.into_iter();
        names
            .filter_map(|name| self.files.path(name).ok())
            .collect()
    }

    /// The motions that a request calls by these names.
    fn motions(
        &self,
        key: &'static str,
        names: &[String],
        how: &MotionFiles,
    ) -> Result<Vec<ReadMotion>, Problems> {
        let (mut read, mut paths) = (Vec::new(), Vec::new());
        let mut problems = Problems::default();
        for name in names {
            match problems.keep_named(key, self.files.find(name)) {
                Some(Content::Motion(motion)) => read.push(*motion),
                Some(Content::At(path)) => paths.push(path),
                Some(Content::Text(_) | Content::Mesh(_)) => {
                    problems.push(not_sent(name).named(key))
                }
                None => {}
            }
        }
        problems.finish(Some(()))?;
        if !paths.is_empty() {
            read.extend(read_all(&MotionFiles {
                paths,
                ..how.clone()
            })?);
        }
        Ok(read)
    }
}

impl ReadMotions {
    /// All motions, in the order in which they were read.
    fn all(&self) -> impl Iterator<Item = &OneMotion> {
        let all = self.vertical.iter().chain(&self.horizontal);
        all.chain(&self.second)
    }

    /// What the reader concluded or doubts, each with the name of the motion.
    pub fn warnings(&self) -> Vec<String> {
        let named = |one: &OneMotion| {
            let notes = one.notes.iter();
            notes
                .map(|note| format!("{}: {note}", one.name))
                .collect::<Vec<_>>()
        };
        self.all().flat_map(named).collect()
    }

    /// What was done to the samples, each step with the name of the motion.
    pub fn processing(&self) -> Vec<String> {
        let named = |one: &OneMotion| {
            let steps = one.processing.iter();
            steps
                .map(|step| format!("{}: {step}", one.name))
                .collect::<Vec<_>>()
        };
        self.all().flat_map(named).collect()
    }
}

/// Two components of one file: `both`, or two by name or number.
pub(crate) fn components(text: &str) -> Result<Second, Problem> {
    if text.trim().eq_ignore_ascii_case("both") {
        return Ok(Second::SameFile(None));
    }
    match text.split(',').map(str::trim).collect::<Vec<_>>()[..] {
        [first, second] if !first.is_empty() && !second.is_empty() => Ok(Second::SameFile(Some((
            first.to_owned(),
            second.to_owned(),
        )))),
        _ => {
            let message = format!(
                "two names or numbers are expected, not \"{}\"",
                shorten(text)
            );
            Err(Problem::value(
                message,
                "write both, or \"1, 2\", or \"N-S, E-W\"",
            ))
        }
    }
}
