//! What may be wrong with a building, and what its period is from, as data: `freestand-report` has the words.

use freestand::building::ModalDoubt;
use freestand::code_spectrum::{FrameKind, PeriodCode};
use strum::EnumCount;

/// Something that may make a building differ from the one that is meant.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum BuildingDoubt {
    /// The heights of a table look like elevations.
    LooksLikeElevations {
        /// The file.
        file: String,
    },
    /// The modes of a table.
    Modes {
        /// The file.
        file: String,
        /// What is wrong with them.
        doubt: ModalDoubt,
    },
    /// It is higher than buildings for which the formula of the period is.
    TooHigh {
        /// Whose formula it is.
        code: PeriodCode,
        /// Of those buildings \[m\].
        greatest_m: f64,
        /// Of this one \[m\].
        height_m: f64,
    },
    /// The formula of the period was not checked against its text.
    FormulaUnread(PeriodCode),
}

/// What the period of a building is from.
#[derive(Debug, Clone, Copy, PartialEq, EnumCount)]
pub enum PeriodFrom {
    /// It was given.
    Given,
    /// A table of storeys.
    Storeys,
    /// A table of modes.
    Modes,
    /// The formula of a code.
    Formula {
        /// The code.
        code: PeriodCode,
        /// The kind of structure.
        frame: FrameKind,
        /// The height of the building \[m\].
        height_m: f64,
    },
}
