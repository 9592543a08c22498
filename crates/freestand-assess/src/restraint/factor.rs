//! The factors of a force, and who says so, as data: `freestand-report` has their symbols and the words.

use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// A factor of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Factor {
    /// What it is.
    pub key: FactorKey,
    /// Its value; accelerations in g.
    pub value: f64,
    /// Who says so.
    pub source: FactorSource,
}

/// What the factors of the codes are, by their names in outputs; each code has its own symbols.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum FactorKey {
    /// The acceleration of the ground \[g\].
    GroundAcceleration,
    /// The acceleration of the floor \[g\].
    FloorAcceleration,
    /// S_DS \[g\].
    Sds,
    /// z/h.
    LevelRatio,
    /// What the height of the floor adds.
    Height,
    /// The period of the part over that of the building.
    PeriodRatio,
    /// Amplification of the part.
    Amplification,
    /// Reduction for the ductility of the part.
    Response,
    /// Importance of the part.
    Importance,
    /// Ω₀, for anchors in concrete.
    Overstrength,
    /// C_AR of ASCE 7-22.
    Resonance,
    /// R_po of ASCE 7-22.
    Strength,
    /// Reduction for the ductility of the building.
    BuildingDuctility,
}

impl FactorKey {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Whether it is an acceleration \[g\].
    pub fn is_acceleration(self) -> bool {
        matches!(
            self,
            Self::GroundAcceleration | Self::FloorAcceleration | Self::Sds
        )
    }
}

/// Who states a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FactorSource {
    /// The user.
    Given,
    /// freestand.
    Assumed(Assumed),
    /// It follows from this.
    Found(Found),
    /// It was read where the row of the component says.
    Read,
    /// Nobody has read it: an engineer must confirm it.
    Recalled(Recalled),
}

/// Why freestand assumes a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Assumed {
    /// An ordinary object.
    Ordinary,
    /// Life safety is rated high.
    LifeSafety,
    /// A rigid bracket.
    RigidBracket,
    /// A flexible bracket, whose period is not known.
    FlexibleBracket,
    /// A flexible bracket, by which the part is in resonance with the building.
    Resonance,
    /// A rigid part.
    RigidPart,
    /// A part that does not yield.
    Elastic,
    /// The object stands on or below the ground.
    AtGrade,
    /// The ductility of the building is not known.
    UnknownDuctility,
}

/// What a factor follows from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Found {
    /// The hazard.
    Hazard,
    /// The simulated earthquakes.
    Worlds,
    /// The floor.
    Floor,
    /// The floor, by a line over the height.
    FloorAlongLine,
    /// The floor and the period of the building.
    FloorAndPeriod,
    /// The floor alone: the period of the building is not known.
    FloorWithoutPeriod,
}

/// What a factor stands for that nobody has read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Recalled {
    /// An ordinary object.
    Ordinary,
    /// The row of the component.
    Row,
    /// Anchors in concrete, for which most codes have rules of their own.
    Concrete,
    /// A connection that is not shown to be ductile.
    BrittleConnection,
    /// Anchorage of floor-supported cabinets and book stacks.
    Cabinet,
    /// No reduction, where a code has one for floor-supported cabinets alone.
    NoCabinet,
    /// A period up to 0.75 s.
    ShortPeriod,
    /// The factor of the row of ASCE 7-16, from which the table of the code descends.
    RowOfAsce7_16,
    /// A flexible bracket: an elastic part in resonance.
    Resonance,
    /// A rigid part.
    RigidPart,
    /// A part that does not yield.
    Elastic,
    /// A building that does not yield.
    ElasticBuilding,
}

impl Factor {
    /// The stated value, or this one by its source.
    pub(super) fn new(
        key: FactorKey,
        stated: Option<f64>,
        value: f64,
        source: FactorSource,
    ) -> Self {
        match stated {
            Some(value) => Self {
                key,
                value,
                source: FactorSource::Given,
            },
            None => Self { key, value, source },
        }
    }

    /// The stated value, or else that of the row; `is_read` says whether somebody has read the row.
    pub(super) fn of_row(key: FactorKey, stated: Option<f64>, value: f64, is_read: bool) -> Self {
        let source = if is_read {
            FactorSource::Read
        } else {
            FactorSource::Recalled(Recalled::Row)
        };
        Self::new(key, stated, value, source)
    }

    /// A value that follows from something else.
    pub(super) fn found(key: FactorKey, value: f64, from: Found) -> Self {
        Self::new(key, None, value, FactorSource::Found(from))
    }
}
