//! Flags for two horizontal components, from one file or from two.

use std::path::PathBuf;

use clap::Args;
use freestand_input::problem::Problem;
use freestand_input::quantity::{Dimension, parse_grid};
use freestand_records::processing::azimuth_deg;
use freestand_study::pair::PairFiles;

use crate::reading::ReadArgs;
use crate::values::{Given, Reads, Values, two_names};

/// Flags for two horizontal components.
#[derive(Debug, Args)]
// A pair is never rotated while it is read: the flag is known only to be refused with a hint.
#[command(
    mut_arg("azimuth", |arg| arg.hide(true)),
    mut_arg("component", |arg| arg.help("Component to read from each of two files, by name or by number (from 1)"))
)]
pub(super) struct PairArgs {
    /// A record with two horizontal components, or two records with one each
    #[arg(value_name = "FILE", required = true, num_args = 1..=2)]
    pub(super) files: Vec<PathBuf>,
    /// The two components to read from one file with several: names or numbers, such as "1, 2"
    #[arg(
        long,
        value_name = "NAME, NAME",
        read = two_names,
        conflicts_with = "component",
        help_heading = "Reading records"
    )]
    components: Option<Given<(String, String)>>,
    #[command(flatten)]
    read: ReadArgs,
}

impl PairArgs {
    /// The files to read; problems are added to `values`.
    pub(super) fn request(&self, values: &mut Values) -> PairFiles {
        PairFiles {
            files: self.read.files(&self.files, values),
            components: values.read(&self.components),
        }
    }

    /// The files that are read.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        self.read.inputs(&self.files)
    }
}

/// Two azimuths \[degrees\], `"0 deg, 90 deg"`.
pub(super) fn azimuths(text: &str) -> Result<(f64, f64), Problem> {
    match parse_grid(text, Dimension::Angle)?[..] {
        [first, second] => Ok((azimuth_deg(first), azimuth_deg(second))),
        _ => Err(Problem::value(
            "two angles are expected",
            "write \"0 deg, 90 deg\", clockwise from north",
        )),
    }
}
