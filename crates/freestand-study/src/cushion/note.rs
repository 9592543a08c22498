//! How the description of a cushion was read, as data; `freestand-report` has the sentences.

use freestand::cushion::Cushion;
use serde::{Deserialize, Serialize};
use strum::EnumCount;

use crate::law::Secant;

/// How the description of a cushion was read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, EnumCount)]
#[serde(rename_all = "kebab-case")]
pub enum CushionNote {
    /// The exponent was not given: that of a sphere.
    HertzExponent,
    /// A stiffness without an exponent in its unit.
    Secant(Secant),
    /// Pads side by side.
    Pads {
        /// How many.
        count: u32,
        /// One of them.
        pad: Cushion,
        /// All of them.
        edge: Cushion,
    },
    /// A damping that follows from its ratio.
    DampingRatio {
        /// ζ.
        ratio: f64,
        /// The mass that it refers to \[kg\].
        mass_kg: f64,
        /// Under the edge \[N s/m\].
        damping_n_s_m: f64,
    },
    /// Layers in series.
    InSeries {
        /// Each of them.
        layers: Vec<Cushion>,
        /// All of them.
        whole: Cushion,
    },
}
