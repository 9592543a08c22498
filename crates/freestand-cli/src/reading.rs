//! Arguments for record files, and how a command gets its motions from them.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse};
use freestand_records::formats::ReadOptions;
use freestand_records::processing::azimuth_deg;
use freestand_study::recorded::{MotionFiles, ReadMotion, Second, read_recorded};

use crate::args::Named;
use crate::failure::{Failure, problem};
use crate::processing::ProcessArgs;
use crate::values::{Given, Reads, Values, two_names};

/// What a record file may not say itself.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Reading records")]
pub(crate) struct ReadArgs {
    /// Unit of acceleration, such as g, m/s2 or gal, of a file that does not state it
    #[arg(long, value_name = "UNIT", read = unit)]
    unit: Option<Given<String>>,
    /// Time step of a file without a column of times
    #[arg(long, value_name = "TIME", read = time_step)]
    dt: Option<Given>,
    /// Component to read from a file with several, by name or by number (from 1)
    #[arg(long, value_name = "NAME|NUMBER")]
    pub(crate) component: Option<String>,
    /// StationXML file with the sensitivity of a miniSEED file [default: the one in the same
    /// folder]
    #[arg(long, value_name = "FILE")]
    pub(crate) station_xml: Option<PathBuf>,
    /// Do not remove the mean of raw records (counts, miniSEED, SAC)
    #[arg(long)]
    pub(crate) keep_mean: bool,
    /// Factor that multiplies the samples [default: 1]
    #[arg(long, any = Dimension::Ratio)]
    scale: Option<Given>,
    #[command(flatten)]
    pub(crate) process: ProcessArgs,
}

/// A unit of acceleration, by its name.
pub(crate) fn unit(text: &str) -> Result<String, Problem> {
    let unit = Some(text.to_owned());
    ReadOptions { unit, ..ReadOptions::default() }.check().map(|()| text.to_owned())
}

/// A time step that a record may have \[s\].
pub(crate) fn time_step(text: &str) -> Result<f64, Problem> {
    let dt_s = parse(text, Dimension::Time)?;
    ReadOptions { dt_s: Some(dt_s), ..ReadOptions::default() }.check().map(|()| dt_s)
}

/// Two components of one file: both that it has, or two by name.
fn components(text: &str) -> Result<Second, Problem> {
    if text.trim().eq_ignore_ascii_case("both") {
        return Ok(Second::SameFile(None));
    }
    let wrong = |one: freestand_input::problem::Problem| one.hint("write both, or \"1, 2\", or \"N-S, E-W\"");
    two_names(text).map(|both| Second::SameFile(Some(both))).map_err(wrong)
}

/// The second horizontal component of records, and the directions in which objects may rock.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Two horizontal components")]
pub(crate) struct SecondArgs {
    /// Use two horizontal components of each file: "both", or two by name or number, such as "1, 2"
    #[arg(long, value_name = "both|NAME, NAME", conflicts_with = "component", read = components)]
    components: Option<Given<Second>>,
    /// Files with the second component, one for each file of the first
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "components")]
    pub(crate) across: Vec<PathBuf>,
    /// Step between the directions, from 0 to 180 degrees, in which objects may rock [default: 15
    /// deg]
    #[arg(long, positive = Dimension::Angle)]
    pub(crate) rotation_step: Option<Given>,
}

impl SecondArgs {
    /// Whether any of the flags that need records was given.
    pub(crate) fn names_records(&self) -> bool {
        self.components.is_some() || !self.across.is_empty()
    }

    /// Where the second component is, for `first` files; what is wrong goes into `values`.
    pub(crate) fn second(&self, first: usize, values: &mut Values) -> Second {
        if !self.across.is_empty() {
            if self.across.len() != first {
                let message = format!("--across: {} files for {first} first components", self.across.len());
                values.push(problem(message, "name one for each, in the same order"));
            }
            return Second::Files(self.across.clone());
        }
        values.read(&self.components).unwrap_or(Second::None)
    }

    /// The step between directions \[degrees\].
    pub(crate) fn rotation_step_deg(&self, values: &mut Values) -> Option<f64> {
        values.read(&self.rotation_step).map(azimuth_deg)
    }
}

/// How the vertical record of a motion is read; the flag that names it, `--vertical`, is the
/// command's own.
#[derive(Debug, Clone, Args)]
pub(crate) struct VerticalArgs {
    /// Factor that multiplies the vertical samples [default: 1]
    #[arg(long, any = Dimension::Ratio, requires = "vertical")]
    vertical_scale: Option<Given>,
    /// Component to read from the vertical record, if it has several
    #[arg(long, value_name = "NAME|NUMBER", requires = "vertical")]
    vertical_component: Option<String>,
}

impl VerticalArgs {
    /// Unit, step, baseline and filters hold for both records; scale, component and direction do
    /// not.
    pub(crate) fn reading(&self, horizontal: &ReadArgs) -> ReadArgs {
        let unscaled =
            ProcessArgs { scale_to: None, scale_to_sa: None, scale_to_spectrum: None, ..horizontal.process.clone() };
        let process = ProcessArgs { azimuth: None, ..unscaled };
        let (component, scale) = (self.vertical_component.clone(), self.vertical_scale.clone());
        ReadArgs { component, scale, process, ..horizontal.clone() }
    }
}

/// Flags that are keys beside `motions` in a study; the others are under `processing`.
const FILE_FLAGS: [&str; 5] = ["unit", "dt", "component", "station-xml", "scale"];

impl Named<ReadArgs> {
    /// Refuses flags that no record is read with; the hint is made from their keys in a study.
    pub(crate) fn refuse_without_record(&self, hint: impl FnOnce(&str) -> String) -> Result<(), Failure> {
        if self.given.is_empty() {
            return Ok(());
        }
        let key = |flag: &String| {
            let table = if FILE_FLAGS.contains(&flag.as_str()) { "" } else { "processing." };
            format!("{table}{}", flag.replace('-', "_"))
        };
        let keys: Vec<String> = self.given.iter().map(key).collect();
        Err(Failure::usage(format!("--{} without --motion", self.given.join(", --")), hint(&keys.join(", "))))
    }
}

impl ReadArgs {
    /// The files with what was said about them; what is wrong goes into `values`.
    pub(crate) fn files(&self, paths: &[PathBuf], values: &mut Values) -> MotionFiles {
        let (unit, dt_s) = (values.read(&self.unit), values.read(&self.dt));
        let scale_ratio = values.read(&self.scale).unwrap_or(1.0);
        let processing = self.process.processing(self.keep_mean, scale_ratio, values);
        MotionFiles {
            paths: paths.to_vec(),
            read: ReadOptions {
                unit,
                dt_s,
                uneven_dt_s: processing.resample_dt_s,
                station_xml: self.station_xml.clone(),
                is_shock: false,
            },
            component: self.component.clone(),
            second: Second::None,
            processing,
        }
    }

    /// The files that are read: records, the StationXML that is named, and the target that they are
    /// scaled to.
    pub(crate) fn inputs<'a>(&self, records: impl IntoIterator<Item = &'a PathBuf>) -> Vec<PathBuf> {
        let others = self.station_xml.iter().cloned().chain(self.process.target_path());
        records.into_iter().cloned().chain(others).collect()
    }

    /// One motion from each file.
    pub(crate) fn read_all(&self, paths: &[PathBuf]) -> Result<Vec<ReadMotion>, Failure> {
        self.read_as(paths, false)
    }

    /// As [`ReadArgs::read_all`], of shocks, whose peaks are beyond those of any floor.
    pub(crate) fn read_shocks(&self, paths: &[PathBuf]) -> Result<Vec<ReadMotion>, Failure> {
        self.read_as(paths, true)
    }

    fn read_as(&self, paths: &[PathBuf], is_shock: bool) -> Result<Vec<ReadMotion>, Failure> {
        let mut values = Values::default();
        let mut files = self.files(paths, &mut values);
        values.finish()?;
        files.read.is_shock = is_shock;
        let (motions, failures) = read_recorded(&files);
        if failures.is_empty() {
            return Ok(motions);
        }
        Err(Failure::Problems(failures.into_iter().map(|(_, problem)| problem).collect()))
    }

    /// The motion of one file.
    pub(crate) fn read_one(&self, path: &Path) -> Result<ReadMotion, Failure> {
        let mut motions = self.read_all(&[path.to_path_buf()])?;
        motions.pop().ok_or_else(|| Failure::computation("the file was read but holds no motion"))
    }
}

/// A path for outputs.
pub(crate) fn path_text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
