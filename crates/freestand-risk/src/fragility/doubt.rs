//! What to know beside fragilities and hazards, as data: `freestand-report` has the words.

use freestand::fragility::{Crossing, LimitState, NoInterval, ShockFitError};
use freestand_inventory::too_mild::TooMild;
use freestand_records::tables::hazard::Statistic;
use strum::EnumCount;

use super::measure::Measure;

/// What to know beside curves.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum CurveDoubt {
    /// Objects that may fail more often than their curves say.
    TooMild {
        /// Why.
        why: TooMild,
        /// Their ids.
        ids: Vec<String>,
    },
    /// A more severe limit state is more probable than a milder one, which cannot be: the curves then
    /// give a loss that is wrong.
    Contradiction {
        /// The curves of the first such object.
        first: Contradiction,
        /// The ids of the others.
        also: Vec<String>,
    },
    /// What to know beside the fit of an object.
    Fit {
        /// Its id.
        id: String,
        /// What it is.
        doubt: FitDoubt,
    },
}

/// Where a more severe limit state of an object is more probable than a milder one.
#[derive(Debug, Clone, PartialEq)]
pub struct Contradiction {
    /// The object.
    pub id: String,
    /// The measure of the intensities.
    pub measure: Measure,
    /// The lowest intensity at which it is.
    pub from: f64,
    /// The highest one.
    pub to: f64,
    /// The milder limit state.
    pub mild: LimitState,
    /// The more severe one.
    pub severe: LimitState,
    /// Where their curves cross, if they do.
    pub crossing: Option<f64>,
}

/// What to know beside the fit of an object.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum FitDoubt {
    /// Its outcomes were fitted, because its shocks cannot be.
    NotByShock(ShockFitError),
    /// Runs that could not be calculated.
    Unresolved {
        /// How many.
        runs: usize,
        /// What the table says of them: each reason once.
        reasons: Vec<String>,
    },
    /// Two curves cross within the intensities of the runs.
    Crossing(Crossing),
    /// The curves do not fit.
    Misfit {
        /// The probability of runs that fit as badly.
        p_value: f64,
    },
    /// A limit state is not more frequent at higher intensities.
    NotIncreasing(LimitState),
    /// Some runs reach a limit state at one intensity alone.
    OnlyBounds(LimitState),
    /// A lognormal curve has no 95 % interval.
    NoInterval {
        /// Its limit state.
        state: LimitState,
        /// Why.
        why: NoInterval,
    },
    /// So few motions that the intervals are too narrow.
    FewMotions(usize),
    /// Many samples have no curve.
    FailedSamples {
        /// How many.
        failed: usize,
        /// Of how many.
        samples: usize,
    },
}

/// What to know beside a hazard.
#[derive(Debug, Clone, PartialEq, Eq, EnumCount)]
pub enum HazardDoubt {
    /// Coordinates are given, and its file has no sites.
    IdleSite,
    /// So many points were left out because their probability is 1.
    CertainPoints(usize),
    /// So many points were left out because a stronger motion is as frequent.
    EqualPoints(usize),
    /// The site of the file is so far from the coordinates that were asked for.
    SiteAway {
        /// The distance \[m\].
        metres: u32,
    },
    /// The file is this in place of the mean of its hazard model.
    OtherThanMean(Statistic),
    /// It consists of the design accelerations of a code.
    DesignAccelerations,
    /// It goes through the few return periods of a place.
    SlopeOfPlace,
    /// Nobody stated the class of the site: this one was used.
    AssumedSite(String),
}

/// A column of a table that nothing reads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnusedColumn {
    /// Its heading.
    pub heading: String,
    /// The known name that is probably meant.
    pub near: Option<String>,
}
