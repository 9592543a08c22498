//! How an object stands on its anchors.

use serde::{Deserialize, Serialize};

/// The line about which an object tips that its anchors hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pivot {
    /// The edge of its base.
    #[default]
    Edge,
    /// Its feet, through which the anchors go: it touches the floor nowhere else.
    Feet,
}

impl Pivot {
    /// Every value with its name and its meaning.
    pub const ALL: [(Self, &'static str, &'static str); 2] = [
        (Self::Edge, "edge", "the edge of the base"),
        (
            Self::Feet,
            "feet",
            "the feet, which are fixed by the anchors",
        ),
    ];
}

/// How an object stands on its anchors.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Footing {
    /// Distance of the anchors from the edge, inwards; `None`: it is assumed \[m\].
    pub inset_m: Option<f64>,
    /// The line about which it tips.
    pub pivot: Pivot,
}
