//! Why an object may fail more often than its calculation says.

use freestand_input::words::Choices;
use serde::{Deserialize, Serialize};

/// Why the calculation of an object is too mild: it may fall where it stands there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum TooMild {
    /// Its base is round, and it is followed as the square prism around it.
    Round,
    /// On its pads, its feet pass through the wall beside it.
    FeetPassWall,
    /// It rolls or slides: an assessment judges its path, and a fragility only what a stop does to it.
    Glides,
}

/// The names of these reasons in tables, and their words.
pub const TOO_MILD: Choices<TooMild> = &[
    (
        TooMild::Round,
        "round",
        "round: not calculated in three dimensions, but as the square prism around it",
    ),
    (
        TooMild::FeetPassWall,
        "feet-pass-wall",
        "beside a wall, through which its feet pass in the calculation",
    ),
    (
        TooMild::Glides,
        "rolls-or-slides",
        "free to roll or slide, which counts only where a stop overturns it",
    ),
];

impl TooMild {
    /// What is calculated, after "It is".
    pub fn words(self) -> &'static str {
        TOO_MILD
            .iter()
            .find(|one| one.0 == self)
            .map_or("", |one| one.2)
    }
}
