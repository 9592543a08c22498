//! Two horizontal components, from one file or from two.

use std::path::PathBuf;

use clap::Args;
use freestand_study::processing::{Processing, pair_of_one};
use freestand_study::quantity::Dimension;
use freestand_study::recorded::{MotionFiles, name_of};
use freestand_study::records::{Component, MotionFile, read_motions};

use crate::failure::{Failure, problem};
use crate::reading::ReadArgs;
use crate::values::Values;

/// Two horizontal components.
#[derive(Debug, Args)]
pub(super) struct PairArgs {
    /// A record file with two horizontal components, or two files with one each
    #[arg(value_name = "FILE", required = true, num_args = 1..=2)]
    pub(super) files: Vec<PathBuf>,
    /// The two components of one file with several: their names or numbers, such as "1, 2"
    #[arg(long, value_name = "NAME, NAME", conflicts_with = "component", help_heading = "Reading records")]
    components: Option<String>,
    #[command(flatten)]
    pub(super) read: ReadArgs,
}

/// What was read.
pub(super) struct ReadPair {
    files: Vec<MotionFile>,
    component: Option<String>,
    called: Option<(String, String)>,
    pub(super) processing: Processing,
    pub(super) notes: Vec<String>,
}

impl PairArgs {
    /// Both components.
    pub(super) fn read(&self) -> Result<ReadPair, Failure> {
        let mut values = Values::default();
        let MotionFiles { paths, read, component, processing } = self.read.files(&self.files, &mut values);
        if processing.azimuth_deg.is_some() {
            values.push(problem("--azimuth turns what other commands read", "give the direction to turn to with --to"));
        }
        let called = self.called(&mut values);
        values.finish()?;
        let mut files = Vec::new();
        let mut problems = Vec::new();
        for path in &paths {
            match read_motions(path, &read) {
                Ok(file) => files.push(file),
                Err(error) => problems.extend(error.problems),
            }
        }
        if !problems.is_empty() {
            return Err(Failure::Problems(problems));
        }
        let notes = files
            .iter()
            .flat_map(|file| file.notes.iter().map(|note| format!("{}: {note}", file.path.display())))
            .collect();
        Ok(ReadPair { files, component, called, processing, notes })
    }

    fn called(&self, values: &mut Values) -> Option<(String, String)> {
        let text = self.components.as_deref()?;
        if self.files.len() > 1 {
            values.push(problem("--components goes with one file", "choose the same one of each with --component"));
        }
        match text.split(',').map(str::trim).collect::<Vec<_>>()[..] {
            [first, second] if !first.is_empty() && !second.is_empty() => Some((first.to_owned(), second.to_owned())),
            _ => {
                let message = format!("--components: two are expected, not \"{text}\"");
                values.push(problem(message, "write \"1, 2\", or \"N-S, E-W\""));
                None
            }
        }
    }
}

impl ReadPair {
    /// A name for what is made of it: that of the first file.
    pub(super) fn name(&self) -> String {
        self.files.first().map_or_else(String::new, |file| name_of(&file.path))
    }

    /// The two components.
    pub(super) fn components(&self) -> Result<(&Component, &Component), Failure> {
        match self.files.as_slice() {
            [one, two] => Ok((one.select(self.component.as_deref())?, two.select(self.component.as_deref())?)),
            [one] => {
                let called = self.called.as_ref().map(|(first, second)| (first.as_str(), second.as_str()));
                Ok(pair_of_one(one, called)?)
            }
            _ => Err(Failure::usage("one or two files are expected", "name them after the command")),
        }
    }
}

/// Two azimuths \[degrees\], `"0 deg, 90 deg"`.
pub(super) fn azimuths(text: Option<&str>, values: &mut Values) -> Option<(f64, f64)> {
    let list = values.grid("--azimuths", text?, Dimension::Angle)?;
    if let [first, second] = list[..] {
        let degrees = freestand_study::processing::azimuth_deg;
        return Some((degrees(first), degrees(second)));
    }
    values.push(problem("--azimuths: two angles are expected", "write \"0 deg, 90 deg\", clockwise from north"));
    None
}
