//! A place with the hazard of its code.

use std::path::PathBuf;

use clap::Arg;
use freestand_input::keys::Words;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;

use crate::files::Files;
use crate::request::{Request as _, path, request};

request! {
    /// A place with the hazard of its code.
    pub struct PlaceKeys {
        /// Place or coordinates ("41.01, 28.97"), with their code and hazard; see freestand place list
        pub place = "NAME",
        /// Spectrum to use instead: a table, or a file of OpenQuake, USGS, EFEHR, AFAD or GEM, in which the
        /// place is the site and the return period chooses the spectrum
        pub spectrum = "FILE",
        /// Site class of the code
        pub site = "CLASS",
        /// Return period in years, where the code has several
        #[arg(long = "return-period", value_name = "YEARS")]
        pub return_period_years: Option<Written>,
    }
}

request! {
    /// The fault of the earthquake, whose velocity pulses are in the worlds.
    pub struct FaultKeys {
        /// Closest distance to the fault on which the earthquake happens, up to 50 km: a share of the worlds
        /// then has a velocity pulse [default: that of a place in New Zealand, else no fault]
        pub fault_distance = "LENGTH",
        /// Magnitude of that earthquake, for its pulses [default: drawn from 6.5 to 7]
        pub fault_magnitude = "M",
    }
}

/// The keys of the fault.
pub(crate) const FAULT_KEYS: [&str; 2] = ["fault_distance", "fault_magnitude"];

impl PlaceKeys {
    /// The words of the place, with the path of the spectrum.
    pub(crate) fn located(&self, read: &mut WordReader<'_>, files: &Files) -> Words {
        let mut words = self.words();
        read.pass(&KEYS);
        match path(read, "spectrum", files) {
            // A study may be in another folder.
            Some(path) if read.has("study") => words.set("spectrum", absolute(path)),
            Some(path) => words.set("spectrum", path.to_string_lossy()),
            // What is wrong with it is told.
            None => words.remove("spectrum"),
        }
        words
    }

    /// The same with the words of its fault.
    pub(crate) fn words_with(
        &self,
        fault: &FaultKeys,
        read: &mut WordReader<'_>,
        files: &Files,
    ) -> Words {
        let mut words = self.located(read, files);
        fault.write(&mut words);
        words
    }

    /// The file of the spectrum.
    pub(crate) fn input(&self, files: &Files) -> Option<PathBuf> {
        files.path_of(self.spectrum.as_ref())
    }
}

/// The keys of the place.
pub(crate) const KEYS: [&str; 4] = ["place", "spectrum", "site", "return_period_years"];

/// A path from the current folder, for words that others read beside a study in another folder.
pub(crate) fn absolute(path: PathBuf) -> String {
    let whole = std::path::absolute(&path).unwrap_or(path);
    whole.to_string_lossy().into_owned()
}

/// Their heading in the help of a command that has a study.
pub const OF_STUDY: &str = "Hazard, in place of that of the study";

/// Puts these keys under a heading of the help.
pub fn under(arg: Arg, heading: &'static str) -> Arg {
    let key = arg.get_id().as_str();
    if KEYS.contains(&key) || FAULT_KEYS.contains(&key) {
        arg.help_heading(heading)
    } else {
        arg
    }
}
