//! Two horizontal components, from one file or from two.

use std::path::PathBuf;

use clap::Args;
use freestand_input::quantity::Dimension;
use freestand_study::pair::PairFiles;

use crate::failure::problem;
use crate::reading::{ReadArgs, two_names};
use crate::values::Values;

/// Two horizontal components.
#[derive(Debug, Args)]
// A pair is never turned as it is read; the flag stays known so that its error says what to do instead.
#[command(
    mut_arg("azimuth", |arg| arg.hide(true)),
    mut_arg("component", |arg| arg.help("The component of each of two files with several: its name or its number from 1"))
)]
pub(super) struct PairArgs {
    /// A record file with two horizontal components, or two files with one each
    #[arg(value_name = "FILE", required = true, num_args = 1..=2)]
    pub(super) files: Vec<PathBuf>,
    /// The two components of one file with several: their names or numbers, such as "1, 2"
    #[arg(long, value_name = "NAME, NAME", conflicts_with = "component", help_heading = "Reading records")]
    components: Option<String>,
    #[command(flatten)]
    read: ReadArgs,
}

impl PairArgs {
    /// What is to be read; what is wrong goes into `values`.
    pub(super) fn request(&self, values: &mut Values) -> PairFiles {
        PairFiles { files: self.read.files(&self.files, values), components: self.called(values) }
    }

    /// The files that are read.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        self.read.inputs(&self.files)
    }

    fn called(&self, values: &mut Values) -> Option<(String, String)> {
        let text = self.components.as_deref()?;
        let both = two_names(text);
        if both.is_none() {
            let message = format!("--components: two are expected, not \"{text}\"");
            values.push(problem(message, "write \"1, 2\", or \"N-S, E-W\""));
        }
        both
    }
}

/// Two azimuths \[degrees\], `"0 deg, 90 deg"`.
pub(super) fn azimuths(text: Option<&str>, values: &mut Values) -> Option<(f64, f64)> {
    let list = values.grid("--azimuths", text?, Dimension::Angle)?;
    if let [first, second] = list[..] {
        let degrees = freestand_records::processing::azimuth_deg;
        return Some((degrees(first), degrees(second)));
    }
    values.push(problem("--azimuths: two angles are expected", "write \"0 deg, 90 deg\", clockwise from north"));
    None
}
