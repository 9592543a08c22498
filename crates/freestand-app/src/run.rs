//! `run` and `check`: a whole study.

use std::path::PathBuf;

use clap::ArgAction;
use freestand_input::problem::Problems;
use freestand_input::quantity::Dimension;
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_records::processing::azimuth_deg;
use freestand_study::recorded::MotionFiles;
use freestand_study::resolve::{Overrides, StudySource, builtin, is_study_file};
use freestand_study::study::Study;
use freestand_study::vary::{Variation, default_variations, parse_variation};

use crate::files::Files;
use crate::place::{self, PlaceKeys};
use crate::records::Records;
use crate::request::{Question, Request as _, reader, request, seed};
use crate::second::SecondKeys;
use crate::study;

/// The schema of the response of `check`.
pub const CHECK_SCHEMA: &str = "freestand.check/1";

request! { question
    /// A study that is explained.
    #[command(mut_args(|arg| place::under(arg, place::OF_STUDY)))]
    pub struct CheckStudy {
        /// Study file (TOML) [default: the built-in study]
        #[arg(value_name = "STUDY.toml")]
        pub study: Option<Written>,
        /// A place.
        #[command(flatten)]
        pub hazard: PlaceKeys,

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

request! { question
    /// A study that is run.
    #[command(mut_args(|arg| place::under(arg, place::OF_STUDY)))]
    pub struct Run {
        /// Study file (TOML) [default: the built-in study]
        #[arg(value_name = "STUDY.toml")]
        pub study: Option<Written>,
        /// A place.
        #[command(flatten)]
        pub hazard: PlaceKeys,
        /// Records that replace the ground motions of the study
        #[arg(long, value_name = "FILE", num_args = 1..)]
        pub motion: Vec<Written>,
        /// How the records are read.
        #[command(flatten)]
        pub records: Records,
        /// Their second components.
        #[command(flatten)]
        pub second: SecondKeys,
        /// Run the study again with one value changed at a time: the usual values of damping, period,
        /// shear_flexure, seed and site, or the values named, such as "damping = 2 %, 10 %"
        #[arg(
            long,
            value_name = "KEY[= VALUE, …]",
            num_args = 0..,
            default_missing_value = "true",
            action = ArgAction::Append
        )]
        pub vary: Vec<Written>,
        /// Write each table of results as Parquet too; the same as parquet = true in the table of outputs
        pub parquet = switch,

        /// Seed of the random numbers.
        #[arg(skip)]
        pub seed: Option<Written>,
    }
}

/// A study that has not been read, with what takes the place of its keys.
#[derive(Debug, Clone)]
pub struct StudyMeant {
    source: Option<StudySource>,
    /// What takes the place of its keys.
    pub overrides: Overrides,
    /// Its file.
    pub inputs: Vec<PathBuf>,
}

impl StudyMeant {
    /// The study.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn study(&self) -> Result<Study, Problems> {
        match &self.source {
            Some(source) => source.load(&self.overrides),
            None => builtin(&self.overrides),
        }
    }
}

/// A study, and how it is run.
#[derive(Debug, Clone)]
pub struct Meant {
    /// The study.
    pub study: StudyMeant,
    /// What is changed, one at a time; `None`: nothing.
    pub variations: Option<Vec<Variation>>,
    with_parquet: bool,
}

impl Meant {
    /// The study, with the outputs that were asked for.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn study(&self) -> Result<Study, Problems> {
        let mut study = self.study.study()?;
        study.outputs.parquet |= self.with_parquet;
        Ok(study)
    }
}

impl Question for CheckStudy {
    type Meant = StudyMeant;

    fn resolve(&self, files: &Files) -> Result<StudyMeant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let meant = study_meant(&mut read, &self.hazard, self.study.as_ref(), files);
        read.problems.finish(Some(meant))
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

impl Question for Run {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        let mut study = study_meant(&mut read, &self.hazard, self.study.as_ref(), files);
        let named = self.records.named_alone(&mut read, &self.motion, files);
        if self.motion.is_empty() {
            for key in ["components", "across"] {
                if read.has(key) {
                    read.note(
                        &[key],
                        format!("`{key}` needs records"),
                        "name them with `motion`, or write it next to the motions of the study",
                    );
                }
            }
            read.pass(&["components", "across"]);
        } else {
            study.overrides.motions = Some(MotionFiles {
                second: self.second.second(&mut read, self.motion.len(), files),
                paths: named.paths(),
                ..named.how().clone()
            });
        }
        // Before a study without a flag, `motion` takes it for a second record.
        for path in named.paths().iter().filter(|path| is_study_file(path)) {
            let path = path.display();
            read.note(
                &["motion"],
                format!("`motion`: {path} is a study, not a record"),
                format!("put the study first: freestand run {path} --motion FILE"),
            );
        }
        let step = read.positive("rotation_step", Dimension::Angle);
        study.overrides.rotation_step_deg = step.map(azimuth_deg);
        let meant = Meant {
            study,
            variations: variations(&mut read),
            with_parquet: read.flag("parquet"),
        };
        read.problems.finish(Some(meant))
    }

    fn set_seed(&mut self, seed: Option<Written>) {
        self.seed = seed;
    }
}

fn study_meant(
    read: &mut WordReader<'_>,
    hazard: &PlaceKeys,
    name: Option<&Written>,
    files: &Files,
) -> StudyMeant {
    let words = hazard.located(read, files);
    StudyMeant {
        overrides: Overrides {
            seed: seed(read),
            hazard: words,
            ..Overrides::default()
        },
        source: study::source_without_flag(read, files),
        inputs: files
            .path_of(name)
            .into_iter()
            .chain(hazard.input(files))
            .collect(),
    }
}

/// The variations: those that were named, or the usual ones.
fn variations(read: &mut WordReader<'_>) -> Option<Vec<Variation>> {
    read.pass(&["vary"]);
    let words = read.words;
    let texts: Vec<&str> = words.all("vary").filter(|text| *text != "false").collect();
    if texts.is_empty() {
        return None;
    }
    if texts.iter().all(|text| *text == "true") {
        return Some(default_variations());
    }
    let named = texts.into_iter().filter(|text| *text != "true");
    let variations = named.filter_map(|text| read.keep("vary", parse_variation(text)));
    Some(variations.collect())
}
