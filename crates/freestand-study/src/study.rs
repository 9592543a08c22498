//! A study as it is meant: validated, in SI units, with its files loaded.

use std::path::PathBuf;

use freestand::block::Block;
use freestand::motion::Motion;
use freestand::rocking::{Accuracy, Restitution};

use crate::cushion::{CushionWords, EdgeCushion};
use crate::input::InputFile;

/// Everything that `run` needs, and nothing that it does not.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The file that it was read from; `None` for the built-in study.
    pub source: Option<PathBuf>,
    /// The study as TOML text: what `source` held, or the built-in study.
    pub toml: String,
    /// The motions at the base of the building.
    pub ground: Ground,
    /// The building that they pass through.
    pub building: BuildingInput,
    /// The floors that are looked at, in the order given.
    pub levels: Vec<Level>,
    /// The objects that stand on them.
    pub objects: Objects,
    /// What is written.
    pub outputs: Outputs,
    /// What the reader of the result must know: assumptions and doubts, one sentence each.
    pub warnings: Vec<String>,
}

/// Where the ground motions come from.
#[derive(Debug, Clone, PartialEq)]
pub enum Ground {
    /// Matched to a code spectrum.
    Synthetic(SyntheticGround),
    /// Read from files.
    Recorded(Vec<RecordedMotion>),
}

impl Ground {
    /// The names of the motions in the outputs.
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Synthetic(synthetic) => (0..synthetic.count).map(synthetic_name).collect(),
            Self::Recorded(motions) => motions.iter().map(|motion| motion.name.clone()).collect(),
        }
    }
}

/// The name of a synthetic motion, counted from 0.
pub fn synthetic_name(index: usize) -> String {
    format!("synthetic-{:02}", index + 1)
}

/// Motions matched to the AS 1170.4 spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticGround {
    /// The target.
    pub spectrum: freestand::code_spectrum::CodeSpectrum,
    /// The city whose hazard factor was taken, for the report.
    pub city: Option<String>,
    /// How many motions.
    pub count: usize,
    /// Seed of the random numbers.
    pub seed: u64,
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
    /// StationXML with the sensitivities of its counts, where they came from one.
    pub station_xml: Vec<InputFile>,
    /// The file with the spectrum that they were scaled to, where there was one.
    pub scale_target: Option<InputFile>,
    /// What was done to the samples, one step each, in words.
    pub processing: Vec<String>,
    /// The samples, as used.
    pub motion: Motion,
}

impl RecordedMotion {
    /// The files that were read beside its own.
    pub fn other_inputs(&self) -> impl Iterator<Item = &InputFile> {
        self.station_xml.iter().chain(&self.scale_target)
    }
}

/// The building, as the shear-flexure beam takes it.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildingInput {
    /// Number of storeys.
    pub storeys: usize,
    /// Height of one storey \[m\].
    pub storey_height_m: f64,
    /// The beam: period, damping, α₀, modes.
    pub beam: freestand::building::Building,
    /// How the period came about, in words for the report.
    pub period_note: String,
}

/// A floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Its name in the outputs, e.g. `roof`.
    pub name: String,
    /// Height above the ground as a share of the building's: 0 ground, 1 roof.
    pub level_ratio: f64,
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
    /// What stands under one edge.
    pub cushion: EdgeCushion,
    /// The cushion file that it was read from, and its words.
    pub cushion_file: Option<(InputFile, CushionWords)>,
    /// Restitution of the motion.
    pub restitution: Restitution,
    /// Accuracy of the rocking solver.
    pub accuracy: Accuracy,
    /// Shock that the objects stand, where it is known \[m/s²\].
    pub tolerance_m_s2: Option<f64>,
    /// Coefficient of friction that sliding is judged by, where it is known.
    pub friction: Option<f64>,
}

/// What is written beside the tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Outputs {
    /// SVG and PNG figures.
    pub figures: bool,
    /// `report.html`.
    pub report: bool,
    /// The object whose rocking history is drawn; `None`: chosen by the program.
    pub history: Option<HistoryChoice>,
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
