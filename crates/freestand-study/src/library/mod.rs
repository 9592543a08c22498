//! What objects stand and what they stand on, with the source of every number: the tolerance library and the cushion library.

use serde::{Deserialize, Serialize};

use crate::cushion::CushionWords;

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
    /// Remembered, without a source and a page: may be shown, never decides.
    Recalled,
}

impl Confidence {
    /// Whether a verdict may rest on it.
    pub fn decides(self) -> bool {
        !matches!(self, Self::Recalled)
    }
}

/// What one object stands; `None` where nobody says. The kinds are those of [`crate::shock::DemandCapacity`].
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

/// What stands under an object where nobody measured it: an entry of the cushion library.
#[derive(Debug, Clone, PartialEq)]
pub struct CushionPrior {
    /// Of one pad, or of all that is under an edge.
    pub words: CushionWords,
    /// Half a 16–84 % range of the stiffness in ln k.
    pub log_sd: f64,
    /// Where it comes from, ready to print.
    pub source: String,
}
