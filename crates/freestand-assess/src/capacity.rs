//! What an object withstands, as numbers.

use serde::{Deserialize, Serialize};

/// The tolerance of an object as numbers that a demand is divided by.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Capacity {
    /// Peak of the acceleration \[m/s²\].
    pub peak_m_s2: Option<f64>,
    /// Duration of the half-sine with that peak \[s\].
    pub duration_s: Option<f64>,
    /// Change of the velocity \[m/s\].
    pub velocity_change_m_s: Option<f64>,
    /// Uplift of an edge \[m\].
    pub edge_lift_m: Option<f64>,
    /// Whether a verdict may depend on its source; `false` for a recalled one.
    pub decides: bool,
}
