//! Who asks for a force, as data: `freestand-report` has the formulas and the words.

use freestand::code_spectrum::part_forces::PartForce;
use serde::{Deserialize, Serialize};

use super::components::Component;
use super::factor::{Factor, FactorKey, FactorSource};

/// A force by one source.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// What kind of source it is.
    pub kind: SourceKind,
    /// Its clause.
    pub clause: Clause,
    /// Force over weight, with the result of the formula and its limits.
    pub part: PartForce,
    /// Share of the weight that is deducted for vertical shaking.
    pub vertical_ratio: f64,
    /// What the formula is made from: the hazard, the floor, the part.
    pub factors: Vec<Factor>,
    /// The row of ASCE 7 whose factors are used.
    pub component: Option<&'static Component>,
    /// What the reader must know.
    pub remarks: Vec<Remark>,
    /// What nobody has read, beside the factors that say so: what an engineer must confirm.
    pub to_confirm: Vec<Unread>,
}

impl Source {
    /// This factor of its formula.
    pub fn factor(&self, key: FactorKey) -> Option<&Factor> {
        self.factors.iter().find(|factor| factor.key == key)
    }

    /// Ω₀, factor on the force of anchors in concrete.
    pub fn overstrength_ratio(&self) -> f64 {
        self.factor(FactorKey::Overstrength)
            .map_or(1.0, |factor| factor.value)
    }

    /// Whether nobody has read something of it in the code.
    pub fn is_recalled(&self) -> bool {
        let is_recalled = |factor: &Factor| matches!(factor.source, FactorSource::Recalled(_));
        !self.to_confirm.is_empty() || self.factors.iter().any(is_recalled)
    }
}

/// The kind of source of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SourceKind {
    /// A clause of the study's own code.
    OwnCode,
    /// The acceleration of its floor.
    Floor,
    /// A clause of another code, on the study's spectrum.
    OtherCode,
}

/// The clauses that give forces on parts, and the accelerations of floors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Clause {
    /// AS 1170.4-2007, section 8.
    As1170_4,
    /// ASCE 7-16, 13.3.1.
    Asce7_16,
    /// ASCE 7-22, 13.3.1.
    Asce7_22,
    /// EN 1998-1, 4.3.5.2.
    Eurocode8,
    /// NTC 2018, 7.2.3.
    Ntc2018,
    /// NZS 1170.5, section 8.
    Nzs1170_5,
    /// TBDY 2018, chapter 6.
    Tbdy2018,
    /// TS 1170.5, section 8.
    Ts1170_5,
    /// An acceleration of the floor that the user gives.
    GivenFloor,
    /// The acceleration of the floor in the simulated earthquakes.
    ComputedFloor,
}

/// What the reader of a force must know.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Remark {
    /// The acceleration of the ground is that of the study's spectrum, which is by another code.
    OtherSpectrum,
    /// The height of the building is not known.
    TallBuilding,
    /// The factors are those of the row of the component.
    Row,
    /// The clause is that of the edition in force, the spectrum by an older one.
    OlderSpectrum,
    /// The code leaves acceleration and behaviour factor to others.
    LeftOpen,
    /// What would lower the force is not used.
    NoReserve,
    /// There are no factors for ductility or importance.
    NoReduction,
    /// It is so many times the force by this clause.
    AboveCode {
        /// How many times.
        ratio: f64,
        /// The clause.
        clause: Clause,
    },
}

/// What nobody has read in a code, beside factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Unread {
    /// The formula of the clause and its limits.
    Formula,
    /// The weight that holds the object down by ASCE 7.
    LoadCombination,
    /// That tables which were read in another edition are still the same.
    OtherEdition,
    /// What the object is: nobody has named it.
    Component,
    /// The acceleration of the floor, which the code takes from an analysis of the building.
    FloorAcceleration,
    /// The factor of the height, which is that of ASCE 7-22.
    Height,
}
