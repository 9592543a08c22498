//! What the reader of a study and its result must know, as data: `freestand-report` has the words.

use freestand::impact::ValidityWarning;
use strum::EnumCount;

use crate::building::{BuildingDoubt, BuildingInput};
use crate::doubt::SquatObjects;
use crate::simulated::{OutsideLimits, SimulationAssumption};
use crate::suite::SuiteDoubt;
use crate::target::TargetDoubt;

/// Something that the reader of a study or its result must know.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum StudyDoubt {
    /// About its spectrum.
    Target(TargetDoubt),
    /// About the code of its restraints.
    Restraint(TargetDoubt),
    /// About its building.
    Building(BuildingDoubt),
    /// About its suite.
    Suite(SuiteDoubt),
    /// An earthquake that the preset was not made for.
    OutsideLimits(OutsideLimits),
    /// What its simulation assumes.
    Simulated(SimulationAssumption),
    /// The vertical motion is not used: other motions were given.
    VerticalUnused,
    /// The second axis of the building is not used: the motions have one component.
    AcrossUnused,
    /// It states no storeys: the building is the built-in one.
    BuildingAssumed {
        /// How many it has.
        storeys: usize,
        /// How high it is \[m\].
        height_m: f64,
    },
    /// A limit of the model of the cushion.
    Cushion(ValidityWarning),
    /// Objects that cannot rock through an impact.
    Squat(SquatObjects),
    /// It concerns the other spectrum of the national annex alone.
    OfType {
        /// The number of its type.
        number: u8,
        /// What the reader must know.
        doubt: Box<Self>,
    },
    /// What was noted of records, in the words of their readers.
    OfRecords(String),
    /// The peaks of matched motions are up to so many times that of the target.
    HighPeak(f64),
    /// Histories that could not be calculated.
    Failed(Share),
    /// Histories that had not come to rest at the end.
    Unsettled(Share),
    /// The earthquake is near its fault, and the motions have no pulses.
    NoPulses,
    /// Objects that slide before they uplift.
    Slide(Share, UsedFriction),
    /// Objects whose edge may slip as it lands.
    Slip(Share, UsedFriction),
    /// The requested history cannot be drawn, because of this error.
    NoHistory(String),
}

impl StudyDoubt {
    /// That nobody stated the building.
    pub(crate) fn assumed_building(building: &BuildingInput) -> Self {
        Self::BuildingAssumed {
            storeys: building.storeys,
            height_m: building.height_m,
        }
    }
}

/// Some of all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Share {
    /// How many.
    pub count: usize,
    /// Of how many.
    pub of: usize,
}

/// The friction that objects are compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UsedFriction {
    /// Its coefficient.
    pub ratio: f64,
    /// Whether nobody gave it.
    pub is_assumed: bool,
}
