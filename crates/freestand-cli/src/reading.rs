//! Arguments for record files, and how a command gets its motions from them.

use std::path::{Path, PathBuf};

use clap::Args;
use freestand_input::quantity::Dimension;
use freestand_records::formats::ReadOptions;
use freestand_records::processing::parse_target_source;
use freestand_study::recorded::{MotionFiles, ReadMotion, Second, read_recorded};

use crate::failure::{Failure, problem};
use crate::processing::ProcessArgs;
use crate::values::Values;

/// What a record file may not say itself.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Reading records")]
pub(crate) struct ReadArgs {
    /// Unit of acceleration in the file, such as g, m/s2 or gal, where it does not state it
    #[arg(long, value_name = "UNIT")]
    pub(crate) unit: Option<String>,
    /// Time step of columns without a time
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(crate) dt: Option<String>,
    /// Component of a file with several: its name or its number from 1
    #[arg(long, value_name = "NAME|NUMBER")]
    pub(crate) component: Option<String>,
    /// StationXML with the sensitivity of a miniSEED file [default: one beside the file]
    #[arg(long, value_name = "FILE")]
    pub(crate) station_xml: Option<PathBuf>,
    /// Keep the mean of raw records (counts, miniSEED, SAC), which is removed otherwise
    #[arg(long)]
    pub(crate) keep_mean: bool,
    /// Factor on the samples [default: 1]
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true)]
    pub(crate) scale: Option<String>,
    #[command(flatten)]
    pub(crate) process: ProcessArgs,
}

/// The two names of `"1, 2"`.
pub(crate) fn two_names(text: &str) -> Option<(String, String)> {
    let (first, second) = text.split_once(',')?;
    let (first, second) = (first.trim(), second.trim());
    let are_two = !first.is_empty() && !second.is_empty() && !second.contains(',');
    are_two.then(|| (first.to_owned(), second.to_owned()))
}

/// The second horizontal component of records, and the directions in which objects are tried.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Two horizontal components")]
pub(crate) struct SecondArgs {
    /// Take two horizontal components of each file: "both", or two by name or number, such as "1, 2"
    #[arg(long, value_name = "both|NAME, NAME", conflicts_with = "component")]
    pub(crate) components: Option<String>,
    /// Files with the second component, one for each of the first
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "components")]
    pub(crate) across: Vec<PathBuf>,
    /// Step between the directions in which objects are tried, 0 to 180 degrees [default: 15 deg]
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    pub(crate) rotation_step: Option<String>,
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
        let Some(text) = self.components.as_deref() else { return Second::None };
        if text.trim().eq_ignore_ascii_case("both") {
            return Second::SameFile(None);
        }
        match two_names(text) {
            Some(both) => Second::SameFile(Some(both)),
            None => {
                let message = format!("--components: two are expected, not \"{text}\"");
                values.push(problem(message, "write both, or \"1, 2\", or \"N-S, E-W\""));
                Second::None
            }
        }
    }

    /// The step between directions \[degrees\].
    pub(crate) fn rotation_step_deg(&self, values: &mut Values) -> Option<f64> {
        let step_rad = values.positive("--rotation-step", self.rotation_step.as_deref(), Dimension::Angle)?;
        Some(freestand_records::processing::azimuth_deg(step_rad))
    }
}

/// How the vertical record of a motion is read; the flag that names it, `--vertical`, is the command's own.
#[derive(Debug, Clone, Args)]
pub(crate) struct VerticalArgs {
    /// Factor on the vertical samples [default: 1]
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, requires = "vertical")]
    pub(crate) vertical_scale: Option<String>,
    /// Component of the vertical record, where it has several
    #[arg(long, value_name = "NAME|NUMBER", requires = "vertical")]
    pub(crate) vertical_component: Option<String>,
}

impl VerticalArgs {
    /// Unit, step, baseline and filters hold for both records; scale, component and direction do not.
    pub(crate) fn reading(&self, horizontal: &ReadArgs) -> ReadArgs {
        let unscaled =
            ProcessArgs { scale_to: None, scale_to_sa: None, scale_to_spectrum: None, ..horizontal.process.clone() };
        let process = ProcessArgs { azimuth: None, ..unscaled };
        let (component, scale) = (self.vertical_component.clone(), self.vertical_scale.clone());
        ReadArgs { component, scale, process, ..horizontal.clone() }
    }
}

impl ReadArgs {
    /// Refuses flags that no record is read with; the hint is made from their names in a study.
    pub(crate) fn refuse_without_record(&self, hint: impl FnOnce(&str) -> String) -> Result<(), Failure> {
        let flags = [("unit", &self.unit), ("dt", &self.dt), ("component", &self.component), ("scale", &self.scale)];
        let mut given: Vec<&str> =
            flags.into_iter().filter(|(_, value)| value.is_some()).map(|(name, _)| name).collect();
        given.extend(self.station_xml.is_some().then_some("station-xml"));
        let mut keys: Vec<String> = given.iter().map(|&name| name.to_owned()).collect();
        let processing: Vec<&str> =
            self.keep_mean.then_some("keep-mean").into_iter().chain(self.process.given()).collect();
        keys.extend(processing.iter().map(|name| format!("processing.{}", name.replace('-', "_"))));
        given.extend(processing);
        if given.is_empty() {
            return Ok(());
        }
        let message = format!("--{} without --motion", given.join(", --"));
        Err(Failure::usage(message, hint(&keys.join(", "))))
    }

    /// The files with what was said about them; what is wrong goes into `values`.
    pub(crate) fn files(&self, paths: &[PathBuf], values: &mut Values) -> MotionFiles {
        let dt_s = values.any("--dt", self.dt.as_deref(), Dimension::Time);
        // Here and not file by file: a wrong flag is one fault, whatever the number of files.
        values.keep("--unit", ReadOptions { unit: self.unit.clone(), ..ReadOptions::default() }.check());
        values.keep("--dt", ReadOptions { dt_s, ..ReadOptions::default() }.check());
        let scale_ratio = values.any("--scale", self.scale.as_deref(), Dimension::Ratio).unwrap_or(1.0);
        let processing = self.process.processing(self.keep_mean, scale_ratio, values);
        MotionFiles {
            paths: paths.to_vec(),
            read: ReadOptions {
                unit: self.unit.clone(),
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

    /// The files that are read: records, the StationXML that is named, and the target that they are scaled to.
    pub(crate) fn inputs<'a>(&self, records: impl IntoIterator<Item = &'a PathBuf>) -> Vec<PathBuf> {
        let target = self.process.scale_to_spectrum.as_deref().and_then(|text| parse_target_source(text).ok());
        let others = self.station_xml.iter().cloned().chain(target.map(|source| source.path));
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
