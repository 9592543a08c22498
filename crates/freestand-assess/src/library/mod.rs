//! What objects stand and what they stand on, with the source of every number: the tolerance library and the cushion library.
//!
//! Both are tables in the program that a file of the user's, with the same columns, adds to and overrides by id. An entry says
//! where its numbers are from; one without a source and a page or clause is `recalled`. A tolerance that is recalled may be shown, it
//! never decides; a cushion is a range from which stiffnesses are drawn, and its page says that it is one.

mod cushions;
mod entry;
mod reader;
mod sheet;
mod tolerances;

use serde::{Deserialize, Serialize};

pub use cushions::{CUSHION_COLUMNS, CushionEntry, CushionLibrary};
pub use entry::{Kind, State, TOLERANCE_COLUMNS, ToleranceEntry, to_tolerance};
pub use tolerances::Library;

use std::path::Path;

use freestand_input::problem::Problems;
use freestand_study::cushion::CushionWords;

/// Both libraries, with what files of the user put over them.
#[derive(Debug, Clone)]
pub struct Libraries {
    /// What objects stand.
    pub tolerances: Library,
    /// What they stand on.
    pub cushions: CushionLibrary,
}

impl Libraries {
    /// The built-in ones, under the files that are named.
    ///
    /// # Errors
    /// A file that cannot be read, or everything that is wrong with it.
    pub fn with_files(tolerances: Option<&Path>, cushions: Option<&Path>) -> Result<Self, Problems> {
        Ok(Self {
            tolerances: tolerances.map_or_else(|| Ok(Library::builtin()), Library::with_file)?,
            cushions: cushions.map_or_else(|| Ok(CushionLibrary::builtin()), CushionLibrary::with_file)?,
        })
    }

    /// What a reader of inventories looks names up in. A fragility is no tolerance, and is not among the names.
    pub fn looked_up<T>(&self, read: impl FnOnce(&Lookup) -> T) -> T {
        let names = self.tolerances.entries().iter().filter(|entry| to_tolerance(entry).is_some());
        read(&Lookup {
            tolerance: &|id| self.tolerances.find(id).and_then(to_tolerance),
            cushion: &|id| self.cushions.prior(id).ok(),
            tolerance_names: &names.map(|entry| entry.id.clone()).collect::<Vec<_>>(),
            cushion_names: &self.cushions.entries().iter().map(|entry| entry.id.clone()).collect::<Vec<_>>(),
        })
    }
}

/// How sure a number is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Confidence {
    /// Stated by the user: a data sheet, a test.
    Stated,
    /// Read at its source, with the page or clause.
    Primary,
    /// Read where it is quoted.
    Secondary,
    /// A placeholder that the user knows to be one.
    Assumption,
    /// Remembered, without a source and a page: a tolerance of it may be shown, it never decides.
    Recalled,
}

impl Confidence {
    /// Whether a verdict may rest on it.
    pub fn decides(self) -> bool {
        !matches!(self, Self::Recalled)
    }
}

/// What one object stands; `None` where nobody says. The kinds are those of [`freestand_study::shock::DemandCapacity`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tolerance {
    /// Peak acceleration \[m/s²\].
    pub peak_m_s2: Option<f64>,
    /// Duration of the half-sine of that peak that it stands \[s\].
    pub duration_s: Option<f64>,
    /// Velocity change below which no peak does harm \[m/s\].
    pub velocity_change_m_s: Option<f64>,
    /// Lift of one edge from which it may fall back \[m\].
    pub edge_lift_m: Option<f64>,
    /// Where it comes from, ready to print: `the inventory`, or `hdd-35-operating: data sheets (class)`.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// What is known beforehand of a cushion: never a measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct CushionPrior {
    /// The cushion in the words of [`freestand_study::cushion`]: the geometric mean of the range, with the pads per edge.
    pub words: CushionWords,
    /// ln(high/low)/2: the range is read as the one from 16 to 84 %, so that it holds two pads of three.
    pub log_sd: f64,
    /// Where it comes from, ready to print.
    pub source: String,
}

impl Confidence {
    /// All, the surest first.
    pub const ALL: [Self; 5] = [Self::Stated, Self::Primary, Self::Secondary, Self::Assumption, Self::Recalled];

    /// The name in files and outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stated => "stated",
            Self::Primary => "primary",
            Self::Secondary => "secondary",
            Self::Assumption => "assumption",
            Self::Recalled => "recalled",
        }
    }

    /// What it means, in a few words.
    pub fn description(self) -> &'static str {
        match self {
            Self::Stated => "stated by the user",
            Self::Primary => "read at its source",
            Self::Secondary => "read where it is quoted",
            Self::Assumption => "a placeholder, chosen and not found",
            Self::Recalled => "remembered, not read: no tolerance of it decides",
        }
    }
}

/// The ids that were likely meant by one that is not there, three at most.
fn nearest_ids<'a>(id: &str, ids: &[&'a str]) -> Vec<&'a str> {
    let wanted = id.to_lowercase();
    let mut near: Vec<&str> = freestand_input::words::nearest(&wanted, ids).into_iter().collect();
    let words: Vec<&str> = wanted.split(|c: char| !c.is_alphanumeric()).filter(|word| word.len() > 2).collect();
    let shared = |candidate: &str| words.iter().filter(|word| candidate.contains(**word)).count();
    let mut others: Vec<&str> = ids.iter().copied().filter(|id| shared(id) > 0 && !near.contains(id)).collect();
    others.sort_by_key(|id| std::cmp::Reverse(shared(id)));
    near.extend(others);
    near.truncate(3);
    near
}

/// Where the entries that an inventory names are looked up.
#[derive(Clone, Copy)]
pub struct Lookup<'a> {
    /// An entry of the tolerance library.
    pub tolerance: &'a dyn Fn(&str) -> Option<Tolerance>,
    /// An entry of the cushion library.
    pub cushion: &'a dyn Fn(&str) -> Option<CushionPrior>,
    /// All names of the tolerance library, for hints.
    pub tolerance_names: &'a [String],
    /// All names of the cushion library, for hints.
    pub cushion_names: &'a [String],
}

impl Lookup<'_> {
    /// No library: every entry that is named is unknown.
    pub const NONE: Lookup<'static> =
        Lookup { tolerance: &|_| None, cushion: &|_| None, tolerance_names: &[], cushion_names: &[] };
}

#[cfg(test)]
mod tests;
