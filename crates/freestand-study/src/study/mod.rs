//! A resolved study: validated, in SI units, with its files loaded.

pub mod assessment;
mod doubt;

use std::path::PathBuf;
use std::sync::Arc;

use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{Accuracy, Restitution};
use freestand::worlds::NearFault;

pub use crate::building::BuildingInput;
use crate::building::PeriodFrom;
use crate::cushion::EdgeCushion;
use crate::matched::{Matched, synthetic_name};
use crate::simulated::{FoundEarthquake, SimulatedRequest};
use crate::suite::Suite;
use crate::target::Target;
pub use doubt::{Share, StudyDoubt, UsedFriction};
use freestand_input::file::InputFile;
use freestand_input::keys::Words;
use freestand_records::horizontal::HorizontalMotion;
use serde::{Deserialize, Serialize};
use strum::EnumCount;

/// Default seed of the random numbers.
pub const DEFAULT_SEED: u64 = 1;

/// Default of the vertical acceleration of floors over that of the ground: at the columns of a building
/// they move vertically as the ground does.
pub const DEFAULT_VERTICAL_AMPLIFICATION: f64 = 1.0;

/// Default number of motions that are generated.
pub const DEFAULT_MOTIONS: u64 = 10;

/// Everything that [`run`](crate::run::run) needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The file that it was read from; `None` for the built-in study.
    pub source: Option<PathBuf>,
    /// Whether it is the built-in study, because no study was given.
    pub is_builtin: bool,
    /// Whether nobody stated the place, or the hazard or the motions in another way: it is that of the
    /// built-in study.
    pub place_is_assumed: bool,
    /// Whether nobody stated the building: it is that of the built-in study.
    pub building_is_assumed: bool,
    /// Everything about the shaking that nobody stated.
    pub assumed: Vec<Assumed>,
    /// The study as TOML text: what `source` held, or the built-in study.
    pub toml: String,
    /// The motions at the base of the building.
    pub ground: Ground,
    /// The motions by the other spectrum of the national annex, where that has two.
    pub other_ground: Option<Ground>,
    /// Horizontal directions in which every object is tried, counted from the first component
    /// \[degrees\]: `[0]` unless the motions have two.
    pub directions_deg: Vec<f64>,
    /// What the building is called, in words; `None`: not given.
    pub building_name: Option<String>,
    /// The building that they pass through; `None` where the motions of the floors are given.
    pub building: Option<BuildingInput>,
    /// The floors of interest, in the order given.
    pub levels: Vec<Level>,
    /// Vertical acceleration of the floors above the ground, divided by that of the ground.
    pub vertical_amplification_ratio: f64,
    /// Floors by the names that lists of objects use, with those of `levels` beside them.
    pub floors: Vec<NamedFloor>,
    /// Whether floor 1 of a list is the ground; `None`: the list decides.
    pub first_floor: Option<FirstFloor>,
    /// The objects on these floors.
    pub objects: Objects,
    /// What is written to files.
    pub outputs: Outputs,
    /// How an inventory is assessed on its floors.
    pub assessment: crate::study::assessment::Settings,
    /// What the reader of the result must know.
    pub doubts: Vec<StudyDoubt>,
}

impl Study {
    /// What was assumed about the shaking at a level; on the ground no building matters.
    pub fn assumed_at(&self, level_ratio: f64) -> impl Iterator<Item = &Assumed> {
        let all = self.assumed.iter();
        all.filter(move |one| !one.is_of_building() || level_ratio > 0.0)
    }

    /// What the reader must know, with a building that nobody stated.
    pub fn and_assumed_building(&self) -> Vec<StudyDoubt> {
        let building = self.building.as_ref().filter(|_| self.building_is_assumed);
        let assumed = building.map(StudyDoubt::assumed_building);
        self.doubts.iter().cloned().chain(assumed).collect()
    }

    /// What nobody stated of the shaking at a level; `None`: everything is stated. On the ground no building
    /// matters.
    pub fn unstated(&self, level_ratio: f64) -> Option<Unstated> {
        match (
            self.place_is_assumed,
            self.building_is_assumed && level_ratio > 0.0,
        ) {
            (true, true) => Some(Unstated::Both),
            (true, false) => Some(Unstated::Place),
            (false, true) => Some(Unstated::Building),
            (false, false) => None,
        }
    }

    /// The same study with the other spectrum of its national annex, where that has two; restraints are designed
    /// as in this one.
    pub fn alternative(&self) -> Option<Self> {
        let ground = self.other_ground.clone()?;
        let restraint_code = self.restraint_target().cloned();
        let assessment = crate::study::assessment::Settings {
            restraint_code,
            ..self.assessment.clone()
        };
        Some(Self {
            ground,
            other_ground: None,
            assessment,
            ..self.clone()
        })
    }

    /// The code by which restraints are designed: that of `[restraint]`, else that of the motions.
    pub fn restraint_target(&self) -> Option<&Target> {
        self.assessment
            .restraint_code
            .as_ref()
            .or_else(|| self.ground.code_spectrum())
    }
}

/// Something about the shaking that nobody stated.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum Assumed {
    /// The hazard of this place; `None`: of the built-in study.
    Place(Option<String>),
    /// The class of the site, with what it is: `site class C`.
    Site(String),
    /// The return period \[years\].
    ReturnPeriod(u32),
    /// That there is no vertical motion.
    NoVertical,
    /// The building, by the number of its storeys.
    Building(usize),
    /// The height of every storey \[m\].
    StoreyHeight(f64),
    /// The period of the building.
    FirstPeriod {
        /// The period \[s\].
        period_s: f64,
        /// What it is from.
        from: PeriodFrom,
    },
    /// The damping of the building.
    Damping(f64),
    /// The deformation of the building: that of walls and frames.
    WallsAndFrames,
}

impl Assumed {
    /// Whether it is of the building.
    pub fn is_of_building(&self) -> bool {
        match self {
            Self::Place(_) | Self::Site(_) | Self::ReturnPeriod(_) | Self::NoVertical => false,
            Self::Building(_)
            | Self::StoreyHeight(_)
            | Self::FirstPeriod { .. }
            | Self::Damping(_)
            | Self::WallsAndFrames => true,
        }
    }
}

/// What a study leaves to the built-in study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Unstated {
    /// The place, and every other hazard.
    Place,
    /// The building.
    Building,
    /// Both.
    Both,
}

impl Unstated {
    /// What is missing.
    pub fn words(self) -> &'static str {
        match self {
            Self::Place => "the place",
            Self::Building => "the building",
            Self::Both => "the place and the building",
        }
    }

    /// The keys that state it.
    pub fn keys(self) -> &'static str {
        match self {
            Self::Place => "place",
            Self::Building => "storeys",
            Self::Both => "place and storeys",
        }
    }
}

/// A floor by its names.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedFloor {
    /// Its name and its aliases.
    pub names: Vec<String>,
    /// Its elevation over that of the top one, at least 0.
    pub level_ratio: f64,
}

/// Whether floor 1 is the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FirstFloor {
    /// Floor 1 is the ground.
    Ground,
    /// Floor 1 is the first above the ground.
    Above,
}

impl FirstFloor {
    /// The values with their names in files.
    pub const ALL: [(&'static str, Self); 2] = [("ground", Self::Ground), ("above", Self::Above)];
}

/// Where the ground motions come from.
#[derive(Debug, Clone, PartialEq)]
pub enum Ground {
    /// Matched to a code spectrum.
    Synthetic(SyntheticGround),
    /// Simulated from magnitudes and distances.
    Simulated(SimulatedGround),
    /// Read from files.
    Recorded(Vec<RecordedMotion>),
    /// Unknown: the motions of the floors are given, with the levels.
    OnFloors,
}

impl Ground {
    /// The names of the motions in the outputs; `levels` are those of the study.
    pub fn names(&self, levels: &[Level]) -> Vec<String> {
        let names =
            |motions: &[RecordedMotion]| motions.iter().map(|motion| motion.name.clone()).collect();
        match self {
            Self::Synthetic(synthetic) => (0..synthetic.count).map(synthetic_name).collect(),
            Self::Simulated(simulated) => simulated
                .motions()
                .map(|(found, index)| found.motion_name(index))
                .collect(),
            Self::Recorded(motions) => names(motions),
            // Every level has as many motions, and those at one place in the lists belong together.
            Self::OnFloors => levels
                .first()
                .map_or_else(Vec::new, |level| names(&level.motions)),
        }
    }

    /// Every motion that was read from a file: those of the ground, then those of the floors, level
    /// by level.
    pub fn recorded<'a>(&'a self, levels: &'a [Level]) -> impl Iterator<Item = &'a RecordedMotion> {
        let ground = match self {
            Self::Recorded(motions) => motions.as_slice(),
            Self::Synthetic(_) | Self::Simulated(_) | Self::OnFloors => &[],
        };
        ground
            .iter()
            .chain(levels.iter().flat_map(|level| &level.motions))
    }

    /// The spectrum that the motions are made for, or matched to.
    pub fn target(&self) -> Option<&Target> {
        match self {
            Self::Synthetic(synthetic) => Some(&synthetic.target),
            Self::Recorded(motions) => motions
                .iter()
                .find_map(|motion| Some(&motion.matched.as_ref()?.target)),
            Self::Simulated(_) | Self::OnFloors => None,
        }
    }

    /// How the motions were selected from a folder, if they were.
    pub fn suite(&self) -> Option<&Suite> {
        match self {
            Self::Recorded(motions) => motions.iter().find_map(|motion| motion.suite.as_deref()),
            Self::Synthetic(_) | Self::Simulated(_) | Self::OnFloors => None,
        }
    }

    /// The code spectrum for this ground: the target, the spectrum that records were selected for,
    /// or the one whose rock spectrum the simulated earthquakes fit.
    pub fn code_spectrum(&self) -> Option<&Target> {
        match self {
            Self::Simulated(simulated) => simulated.hazard.as_ref(),
            _ => self.target().or_else(|| Some(&self.suite()?.target)),
        }
    }

    /// Seed of the random numbers, where there are any.
    pub fn seed(&self) -> Option<u64> {
        match self {
            Self::Synthetic(synthetic) => Some(synthetic.seed),
            Self::Simulated(simulated) => Some(simulated.request.seed),
            Self::Recorded(_) | Self::OnFloors => None,
        }
    }

    /// Whether the motions have vertical components.
    pub fn has_vertical(&self) -> bool {
        match self {
            Self::Synthetic(synthetic) => synthetic.vertical != VerticalTarget::None,
            Self::Recorded(motions) => motions.iter().any(|motion| motion.vertical.is_some()),
            Self::Simulated(_) | Self::OnFloors => false,
        }
    }

    /// Whether the motions have two horizontal components.
    pub fn has_two_components(&self, levels: &[Level]) -> bool {
        self.recorded(levels).any(|motion| motion.across.is_some())
    }
}

/// Motions matched to a spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticGround {
    /// The target.
    pub target: Target,
    /// How many motions.
    pub count: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// The target of the vertical motions.
    pub vertical: VerticalTarget,
    /// The fault of the earthquake, if one is known: its pulses are in the worlds.
    pub near_fault: Option<NearFault>,
}

/// The target of vertical motions that are made with synthetic ones.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum VerticalTarget {
    /// There is no vertical motion.
    #[default]
    None,
    /// This share of the horizontal target, above 0, at every period.
    Ratio(f64),
    /// The vertical spectrum of the code.
    Code,
}

impl VerticalTarget {
    /// The vertical target at a period \[g\]; `None` without one.
    pub fn sa_g(self, target: &Target, period_s: f64) -> Option<f64> {
        match self {
            Self::None => None,
            Self::Ratio(ratio) => Some(ratio * target.spectrum.sa_g(period_s)),
            Self::Code => target.spectrum.vertical_sa_g(period_s),
        }
    }
}

/// Motions of point sources.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedGround {
    /// Source, path, site, count and seed.
    pub request: SimulatedRequest,
    /// The earthquakes, with their distances.
    pub earthquakes: Vec<FoundEarthquake>,
    /// The code spectrum at the site, if distances were searched for that fit its rock spectrum.
    pub hazard: Option<Target>,
}

impl SimulatedGround {
    /// Every motion: its earthquake, and its number among those of the earthquake.
    pub fn motions(&self) -> impl Iterator<Item = (&FoundEarthquake, u64)> {
        self.earthquakes
            .iter()
            .flat_map(|found| (0..self.request.count).map(move |index| (found, index)))
    }
}

/// One motion read from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedMotion {
    /// A name for the outputs, never a path.
    pub name: String,
    /// The file.
    pub path: PathBuf,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
    /// Format and component, in words.
    pub description: String,
    /// Factor that the samples were multiplied by.
    pub scale_ratio: f64,
    /// The StationXML file with the sensitivity of the instrument, if the record needed one.
    pub station_xml: Vec<InputFile>,
    /// The file with the spectrum that the samples were scaled to, if any.
    pub scale_target: Option<InputFile>,
    /// What was done to the samples, one step each, in words.
    pub processing: Vec<String>,
    /// The spectrum that it was matched to, if any.
    pub matched: Option<Matched>,
    /// The suite that it was selected for, with its factor, if any; all records of a study share it.
    pub suite: Option<Arc<Suite>>,
    /// The samples, as used.
    pub motion: Motion,
    /// The second horizontal component, at right angles to the first, if any.
    pub across: Option<SecondComponent>,
    /// The vertical component, positive upward, if it is used.
    pub vertical: Option<SecondComponent>,
}

/// The second horizontal component of a recorded motion, or its vertical one.
#[derive(Debug, Clone, PartialEq)]
pub struct SecondComponent {
    /// The file, if it is not that of the first component.
    pub file: Option<InputFile>,
    /// The samples, as used.
    pub motion: Motion,
}

impl RecordedMotion {
    /// Its component or components.
    pub fn as_used(&self) -> HorizontalMotion {
        let across = self.across.as_ref().map(|second| second.motion.clone());
        HorizontalMotion {
            along: self.motion.clone(),
            across,
        }
    }

    /// The files that were read in addition to its own.
    pub fn other_inputs(&self) -> impl Iterator<Item = &InputFile> {
        let second = self.across.as_ref().and_then(|second| second.file.as_ref());
        let matched = self.matched.as_ref().map(|matched| &matched.target);
        let target = matched
            .or_else(|| Some(&self.suite.as_ref()?.target))
            .and_then(|target| target.file.as_ref());
        let vertical = self
            .vertical
            .as_ref()
            .and_then(|vertical| vertical.file.as_ref());
        self.station_xml
            .iter()
            .chain(&self.scale_target)
            .chain(target)
            .chain(second)
            .chain(vertical)
    }
}

/// A floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Its name in the outputs, e.g. `roof`.
    pub name: String,
    /// Height above the ground as a share of the building's: 0 ground, 1 roof. `None` if its
    /// motions are given without its height.
    pub level_ratio: Option<f64>,
    /// Its motions, if they are given and not computed.
    pub motions: Vec<RecordedMotion>,
}

/// The grid of objects.
#[derive(Debug, Clone, PartialEq)]
pub struct Objects {
    /// Heights \[m\].
    pub heights_m: Vec<f64>,
    /// Thicknesses \[m\].
    pub thicknesses_m: Vec<f64>,
    /// Every object of the grid: thickness by thickness within each height.
    pub blocks: Vec<Block>,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// The cushion under one edge.
    pub cushion: EdgeCushion,
    /// The cushion file that it was read from, and its words.
    pub cushion_file: Option<(InputFile, Words)>,
    /// Restitution.
    pub restitution: Restitution,
    /// Accuracy of the rocking solver.
    pub accuracy: Accuracy,
    /// Shock tolerance of the objects, if it was given \[m/s²\].
    pub tolerance_m_s2: Option<f64>,
    /// Coefficient of friction for the warnings about sliding, if it was given.
    pub friction: Option<f64>,
}

/// What is written in addition to the tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Outputs {
    /// SVG and PNG figures.
    pub figures: bool,
    /// `report.html`.
    pub report: bool,
    /// The tables of results as Parquet too.
    pub parquet: bool,
    /// Whether the cards of objects in the report of a list are printed.
    pub cards: bool,
    /// Who signs for the report of a list.
    pub title: TitleBlock,
    /// The object whose rocking history is drawn; `None`: chosen by the program.
    pub history: Option<HistoryChoice>,
}

/// Who signs for a report; what is not stated is a line to be filled in by hand. The date is not the
/// clock's: equal runs write equal files.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TitleBlock {
    /// The date.
    pub date: Option<String>,
    /// Who prepared it.
    pub preparer: Option<String>,
    /// The revision.
    pub revision: Option<String>,
}

/// The object whose rocking history is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct HistoryChoice {
    /// Name of the level.
    pub level: String,
    /// Name of the motion; `None`: the first.
    pub motion: Option<String>,
    /// Height \[m\].
    pub height_m: f64,
    /// Thickness \[m\].
    pub thickness_m: f64,
}
