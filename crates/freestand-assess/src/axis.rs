//! The sides of an object.

use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// The side of an object that lies in the plane of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// The thickness.
    Thickness,
    /// The width.
    Width,
}

impl Axis {
    /// The name in outputs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}
