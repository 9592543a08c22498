//! The libraries of tolerances, cushions and restraints: what objects withstand, what they rest on and what holds
//! them, with the source of every number.
//!
//! All are built-in tables. A user's file with the same columns adds entries and replaces those
//! with the same id. An entry names its source; without a source and a page or clause it is
//! `recalled`. A recalled tolerance may be shown but never decides a verdict. A cushion is a range
//! from which stiffnesses are drawn, and the report says so.

mod collection;
mod cushions;
mod reader;
mod restraints;
mod table;
mod tolerances;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

pub use collection::Library;
pub use cushions::{CushionEntry, CushionLibrary};
pub use restraints::{
    ASSUMED_BETA, Hold, HoldsWhat, RestraintEntry, RestraintKind, RestraintLibrary,
};
pub use tolerances::{Kind, State, ToleranceEntry, ToleranceLibrary, to_tolerance};

use std::path::Path;

use freestand_input::keys::Words;
use freestand_input::problem::Problems;

/// Both libraries, with the user's files.
#[derive(Debug, Clone)]
pub struct Libraries {
    /// What objects withstand.
    pub tolerances: ToleranceLibrary,
    /// What they rest on.
    pub cushions: CushionLibrary,
}

impl Libraries {
    /// The built-in libraries with these files.
    ///
    /// # Errors
    /// A file that cannot be read, or all problems in it.
    pub fn with_files(
        tolerances: Option<&Path>,
        cushions: Option<&Path>,
    ) -> Result<Self, Problems> {
        Ok(Self {
            tolerances: ToleranceLibrary::builtin().with_file(tolerances)?,
            cushions: CushionLibrary::builtin().with_file(cushions)?,
        })
    }

    /// Calls `read` with the lookup that a reader of inventories needs. A fragility is not a
    /// tolerance and is not included.
    pub fn looked_up<T>(&self, read: impl FnOnce(&Lookup) -> T) -> T {
        let names = self
            .tolerances
            .entries()
            .iter()
            .filter(|entry| to_tolerance(entry).is_some());
        read(&Lookup {
            tolerance: &|id| self.tolerances.find(id).and_then(to_tolerance),
            cushion: &|id| self.cushions.prior(id).ok(),
            tolerance_names: &names.map(|entry| entry.id.clone()).collect::<Vec<_>>(),
            cushion_names: &self.cushions.ids().map(str::to_owned).collect::<Vec<_>>(),
        })
    }
}

/// How far a number can be trusted.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    JsonSchema,
    IntoStaticStr,
    VariantArray,
)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum Confidence {
    /// Stated by the user: a data sheet, a test.
    Stated,
    /// Read in the source itself, with the page or clause.
    Primary,
    /// Read in a document that quotes the source.
    Secondary,
    /// An assumption, without a source.
    Assumption,
    /// Quoted from memory, without a source and a page: such a tolerance may be shown but never
    /// decides.
    Recalled,
}

impl Confidence {
    /// Whether a verdict may depend on it.
    pub fn decides(self) -> bool {
        !matches!(self, Self::Recalled)
    }
}

/// The tolerance of one object; `None` for values that are not known. Its parts are those of
/// `demand_capacity` of `freestand shock`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// Peak acceleration \[m/s²\].
    pub peak_m_s2: Option<f64>,
    /// Duration of the half-sine with that peak \[s\].
    pub duration_s: Option<f64>,
    /// Velocity change below which no peak causes damage \[m/s\].
    pub velocity_change_m_s: Option<f64>,
    /// Uplift from which it may fall back without damage \[m\].
    pub edge_lift_m: Option<f64>,
    /// Its source, ready to print: `the inventory`, or `hdd-35-operating: data sheets (class)`.
    pub source: String,
    /// The confidence in its source.
    pub confidence: Confidence,
}

/// An estimate of a cushion, never a measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct CushionPrior {
    /// The cushion as keys of [`freestand_study::cushion`]: the geometric mean of the range, with
    /// the pads per edge.
    pub words: Words,
    /// ln(high/low)/2: the range is taken as that from 16 to 84 %, which contains two of three
    /// pads.
    pub log_sd: f64,
    /// Its source, ready to print.
    pub source: String,
}

impl Confidence {
    /// The name in files and outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// What it means, in a few words.
    pub fn description(self) -> &'static str {
        match self {
            Self::Stated => "stated by the user",
            Self::Primary => "read in the source itself",
            Self::Secondary => "read in a document that quotes the source",
            Self::Assumption => "an assumption, without a source",
            Self::Recalled => "quoted from memory; no verdict depends on such a tolerance",
        }
    }
}

/// Where the entries that an inventory names are looked up.
#[derive(Clone, Copy)]
pub struct Lookup<'a> {
    /// An entry of the tolerance library.
    pub tolerance: &'a (dyn Fn(&str) -> Option<Tolerance> + Sync),
    /// An entry of the cushion library.
    pub cushion: &'a (dyn Fn(&str) -> Option<CushionPrior> + Sync),
    /// All names of the tolerance library, for hints.
    pub tolerance_names: &'a [String],
    /// All names of the cushion library, for hints.
    pub cushion_names: &'a [String],
}

impl Lookup<'_> {
    /// No library: every entry that is named is unknown.
    pub const NONE: Lookup<'static> = Lookup {
        tolerance: &|_| None,
        cushion: &|_| None,
        tolerance_names: &[],
        cushion_names: &[],
    };
}

#[cfg(test)]
mod tests;
