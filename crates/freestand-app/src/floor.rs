//! `floor`: how the floors of a building move.

use std::path::{Path, PathBuf};

use freestand::synthesis::DAMPING_RATIO;
use freestand_input::keys::Words;
use freestand_input::problem::Problems;
use freestand_input::quantity::{Dimension, parse_grid};
use freestand_input::word_reader::WordReader;
use freestand_input::written::Written;
use freestand_report::doubts::target_doubt;
use freestand_study::building::{self, BuildingInput};
use freestand_study::floor::{DEFAULT_LEVELS, FloorRequest, SpectraRequest, every_floor};
use freestand_study::recorded::{MotionFiles, ReadMotion, Second, Upward};
use freestand_study::target::{Target, usual_periods_s};

use crate::files::Files;
use crate::records::{NamedRecords, Records};
use crate::request::{Question, Request, reader, request};
use crate::second::{SecondKeys, beside};
use crate::target::TargetKeys;

/// The schema of the response.
pub const SCHEMA: &str = "freestand.floor/1";

/// The largest number of levels of one call: each is a motion in memory.
const MAX_LEVELS: usize = 1000;

request! { question
    /// The motions of the floors of a building.
    // Known only to be refused with a hint.
    #[command(mut_arg("rotation_step", |arg| arg.hide(true)))]
    pub struct Floor {
        /// Records of the ground motion; of several, medians are printed
        #[arg(long, value_name = "FILE", num_args = 1..)]
        pub motion: Vec<Written>,
        /// The building.
        #[command(flatten)]
        pub building: BuildingKeys,
        /// Levels as shares of the height (0 is the ground, 1 the roof), or "all" for every floor [default: 0.5, 1]
        pub levels = "GRID|all",
        /// Duration of the zeros appended to the record, during which the building comes to rest
        /// [default: 0 s]
        pub tail = "TIME",
        /// Find peaks of the floors at N points in each sample interval; the ground stays linear
        /// between its samples [default: 1]
        pub upsample = "N",
        /// Also give response spectra of the levels
        pub spectra = switch,
        /// Damping ratios of the spectra [default: 5 %]
        pub spectrum_damping = "LIST",
        /// Periods of the spectra: from:to:count or a list [default: 0 s and 121 from 0.05 s to 5 s]
        pub periods = "GRID",
        /// Files with the vertical component, one for each --motion, or "record": the vertical component
        /// of each file of --motion; processed and scaled as the horizontal one
        #[arg(long, value_name = "FILE", num_args = 1..)]
        pub vertical: Vec<Written>,
        /// Vertical acceleration of the floors above the ground, divided by that of the ground: 1 at
        /// columns, more in the middle of a slab [default: 1]
        pub vertical_amplification = "RATIO",
        /// The second components of the records.
        #[command(flatten)]
        pub second: SecondKeys,
        /// How the records are read.
        #[command(flatten)]
        pub records: Records,
        /// The code whose accelerations of rigid parts are compared with the floors.
        #[command(flatten)]
        pub target: TargetKeys,
    }
}

request! {
    /// A building: its height and its period, or a table of storeys or of modes.
    pub struct BuildingKeys under "Building" {
        /// Number of storeys [default: 30]
        pub storeys = "N",
        /// Height of a storey [default: 3.2 m]
        pub storey_height = "LENGTH",
        /// Height of the building, in place of --storey-height
        pub height = "LENGTH",
        /// Fundamental period [default: from the height, by the code]
        pub period = "TIME",
        /// Structure, for the period by the code: steel-moment, concrete-moment, steel-braced, other [default:
        /// other]
        pub frame = "FRAME",
        /// Code of the formula for the period: as1170.4, nzs1170.5, asce7, eurocode8 [default: --code]
        pub period_code = "CODE",
        /// Damping ratio of every mode for which a table states none [default: 5 %]
        pub damping = "RATIO",
        /// Rayleigh damping, with that ratio at two modes, such as "1, 3"
        pub rayleigh_modes = "N, N",
        /// α₀ = H√(GA/EI): 0 for a flexural wall, 5 for walls with frames, 20 and more for a frame [default: 5]
        pub shear_flexure = "RATIO",
        /// Number of modes [default: 10, or the number of storeys]
        pub modes = "N",
        /// Table of storeys from the ground up: height, mass and stiffness with their units
        pub storey_table = "FILE",
        /// Table of modes: period, participation factor, and the shape at each floor in a column headed by its
        /// height
        pub mode_table = "FILE",
        /// Fundamental period along the second axis [default: the same as along the first]
        pub across_period = "TIME",
        /// α₀ along the second axis
        pub across_shear_flexure = "RATIO",
        /// Table of storeys for the second axis
        pub across_storey_table = "FILE",
        /// Table of modes for the second axis
        pub across_mode_table = "FILE",
    }
}

/// What is asked, in SI.
#[derive(Debug)]
pub struct Meant {
    /// The building and its levels.
    pub floors: FloorRequest,
    /// The motions of the ground.
    pub motions: Vec<ReadMotion>,
    /// What the code of the comparison leaves open.
    pub warnings: Vec<String>,
    /// The files that were read.
    pub inputs: Vec<PathBuf>,
}

/// What is asked, with records that have not been read.
struct Judged<'f> {
    floors: FloorRequest,
    target: Option<Target>,
    named: NamedRecords<'f>,
    how: MotionFiles,
    inputs: Vec<PathBuf>,
}

impl Question for Floor {
    type Meant = Meant;

    fn resolve(&self, files: &Files) -> Result<Meant, Problems> {
        let judged = self.judged(files)?;
        Ok(Meant {
            motions: judged.named.read_as(&judged.how)?,
            floors: judged.floors,
            warnings: judged
                .target
                .iter()
                .flat_map(|target| target.doubts.iter().map(target_doubt))
                .collect(),
            inputs: judged.inputs,
        })
    }

    fn check(&self, files: &Files) -> Result<(), Problems> {
        self.judged(files).map(drop)
    }
}

impl Floor {
    fn judged<'f>(&self, files: &'f Files) -> Result<Judged<'f>, Problems> {
        let words = self.words();
        let mut read = reader::<Self>(&words, &self.unknown);
        if read.has("rotation_step") {
            read.note(
                &["rotation_step"],
                "`rotation_step` applies to objects, not to floors",
                "leave it out: the largest value of all directions is found without steps",
            );
        }
        if self.motion.is_empty() {
            let hint = "name the records of the ground with `motion`";
            read.missing(&["motion"], "no motion is named", hint);
        }
        let named = self.records.named_alone(&mut read, &self.motion, files);
        let mut how = named.how().clone();
        how.vertical = self.upward(&mut read, files);
        how.second = self.second.second(&mut read, self.motion.len(), files);
        let mut inputs = named.paths();
        if let Second::Files(across) = &how.second {
            inputs.extend(across.iter().cloned());
        }
        if let Upward::Files(vertical) = &how.vertical {
            inputs.extend(vertical.iter().cloned());
        }
        inputs.extend(self.records.inputs(files));
        inputs.extend(self.target.inputs(files));

        let target = self.target.is_given();
        let target = target.then(|| self.target.target(&mut read, files));
        let building = self.building(&mut read, files);
        let levels = levels(&mut read);
        let floors = building.map(|building| {
            let tables = building.tables.iter();
            inputs.extend(tables.map(|table| table.file.path.clone()));
            if building.across.is_some() && matches!(how.second, Second::None) {
                read.note(
                    &["components"],
                    "a second axis of the building needs a second component of the motion",
                    "name it with `components = both`, or with `across`",
                );
            }
            FloorRequest {
                is_storeys: levels.is_none(),
                levels_ratio: levels
                    .unwrap_or_else(|| every_floor(&building.along, building.storeys)),
                tail_s: read.non_negative("tail", Dimension::Time).unwrap_or(0.0),
                upsample: read.whole_within("upsample", 1..).unwrap_or(1),
                spectra: spectra(&mut read),
                vertical_amplification_ratio: self.amplification(&mut read),
                building,
                code: target
                    .iter()
                    .flatten()
                    .map(|target| target.spectrum.clone())
                    .next(),
            }
        });
        let floors = read.problems.finish(floors)?;
        Ok(Judged {
            floors,
            target: target.flatten(),
            named,
            how,
            inputs,
        })
    }

    fn building(&self, read: &mut WordReader<'_>, files: &Files) -> Option<BuildingInput> {
        let mut words = Words::default();
        self.building.write(&mut words);
        let keys: Vec<&'static str> = words.entries().map(|(key, _)| key).collect();
        read.pass(&keys);
        let keys = &self.building;
        for (key, table) in [
            ("storey_table", &keys.storey_table),
            ("mode_table", &keys.mode_table),
            ("across_storey_table", &keys.across_storey_table),
            ("across_mode_table", &keys.across_mode_table),
        ] {
            if let Some(name) = table {
                let path = read.keep(key, files.path(&name.text()))?;
                words.set(key, path.to_string_lossy());
            }
        }
        let building = building::resolve(&words, Path::new(""), self.target.period_code());
        read.problems.keep(building)
    }

    /// Where the vertical components are.
    fn upward(&self, read: &mut WordReader<'_>, files: &Files) -> Upward {
        match self.vertical.as_slice() {
            [] => Upward::None,
            [only] if only.text() == "record" => {
                read.pass(&["vertical"]);
                Upward::SameFile
            }
            all => Upward::Files(beside(read, ("vertical", all), self.motion.len(), files)),
        }
    }

    fn amplification(&self, read: &mut WordReader<'_>) -> Option<f64> {
        let ratio = read.positive("vertical_amplification", Dimension::Ratio);
        if ratio.is_some() && self.vertical.is_empty() {
            read.note(
                &["vertical_amplification"],
                "`vertical_amplification` needs `vertical`",
                "name the vertical records, or leave it out",
            );
        }
        ratio
    }
}

/// The spectra of the levels, if they are wanted.
fn spectra(read: &mut WordReader<'_>) -> Option<SpectraRequest> {
    let damping_ratios = read.grid("spectrum_damping", Dimension::Ratio);
    let periods_s = read.grid("periods", Dimension::Time);
    let is_wanted = read.flag("spectra");
    for key in ["spectrum_damping", "periods"] {
        if read.has(key) && !is_wanted {
            read.note(
                &[key],
                format!("`{key}` needs `spectra`"),
                "ask for the spectra of the levels, or leave it out",
            );
        }
    }
    is_wanted.then(|| SpectraRequest {
        damping_ratios: damping_ratios.unwrap_or_else(|| vec![DAMPING_RATIO]),
        periods_s: periods_s.unwrap_or_else(usual_periods_s),
    })
}

/// Shares of the height; `None`: every floor.
fn levels(read: &mut WordReader<'_>) -> Option<Vec<f64>> {
    let text = read.text("levels").unwrap_or(DEFAULT_LEVELS);
    if text.trim().eq_ignore_ascii_case("all") {
        return None;
    }
    let levels = if read.has("levels") {
        read.grid("levels", Dimension::Ratio)
    } else {
        read.keep("levels", parse_grid(DEFAULT_LEVELS, Dimension::Ratio))
    };
    let levels = levels.unwrap_or_default();
    if let Some(outside) = levels.iter().find(|x| !(0.0..=1.0).contains(*x)) {
        read.note(
            &["levels"],
            format!("`levels`: {outside} is not a share of the height"),
            "give levels from 0 (the ground) to 1 (the roof)",
        );
    }
    if levels.len() > MAX_LEVELS {
        read.note(
            &["levels"],
            format!("`levels`: {} levels are too many", levels.len()),
            format!("give at most {MAX_LEVELS} levels"),
        );
    }
    Some(levels)
}
