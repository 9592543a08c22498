//! Why an object may fail more often than its calculation says.

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr, VariantArray};

/// Why the calculation of an object is too mild: it may fall where it stands there. Tables have its name.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Serialize,
    Deserialize,
    EnumString,
    IntoStaticStr,
    VariantArray,
)]
#[strum(serialize_all = "kebab-case")]
pub enum TooMild {
    /// Its base is round: in three dimensions on its rim no test stands behind the model, and beside a wall lower than
    /// it, it is followed as the square prism around it.
    Round,
    /// It is followed on the points of its hull, and tests on a shake table fell more often.
    OnHull,
    /// It was scanned, but not the side on which it stands, or its scan has holes.
    UnseenBase,
    /// It touches a wall and stays by its calculation in a plane on a rigid base, but not in three dimensions on a stiff
    /// floor.
    TouchesWall,
    /// It rolls or slides: an assessment judges its path, and a fragility only what a stop does to it.
    #[strum(serialize = "rolls-or-slides")]
    Glides,
}

impl TooMild {
    /// The name in tables.
    pub fn name(self) -> &'static str {
        self.into()
    }
}
