//! What there is to know beside the history of an object, as data: `freestand-report` has the words.

use std::ops::RangeInclusive;

use freestand::impact::ValidityWarning;
use strum::EnumCount;

use crate::cushion::CushionNote;

/// A size that hardly any object has.
#[derive(Debug, Clone, PartialEq)]
pub struct UnlikelySize {
    /// Its key.
    pub key: &'static str,
    /// The size \[m\].
    pub size_m: f64,
    /// What objects have \[m\].
    pub usual_m: RangeInclusive<f64>,
}

/// Something that may make a history wrong.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum HistoryDoubt {
    /// A size that hardly any object has.
    Size(UnlikelySize),
    /// A limit of a model.
    Validity(ValidityWarning),
    /// More friction is needed than the coefficient that was assumed.
    SlidesByAssumption(ValidityWarning),
    /// The contact would have to pull the object down.
    LeavesTheFloor,
    /// The object is neither at rest nor down at the end.
    Unresolved,
    /// A wall that the object cannot touch.
    WallOutOfReach {
        /// `left` or `right`.
        side: &'static str,
        /// Its distance \[m\].
        gap_m: f64,
        /// The height of the object \[m\].
        height_m: f64,
    },
    /// The object meets a wall past its balance point.
    WallPastBalance {
        /// `left` or `right`.
        side: &'static str,
        /// Where it touches the wall \[rad\].
        angle_rad: f64,
        /// Its balance point \[rad\].
        balance_rad: f64,
    },
    /// Nobody gave the cushion of the walls: what happens beside the softest and least damped one that may be
    /// there, and beside the stiffest and most damped one.
    WallCushionAssumed([BesideWall; 2]),
    /// A slightly weaker or stronger motion ends otherwise.
    OtherOutcomeNearby,
    /// Cushions without damping under a motion.
    Undamped,
    /// The cushions do not keep the object upright at rest.
    TooSoft,
    /// The energy balance does not close: its error over the energy exchanged.
    EnergyError(f64),
    /// A coefficient that nobody gave.
    Assumed {
        /// Its key.
        key: &'static str,
        /// Its value.
        ratio: f64,
    },
    /// It may overturn at a low stop.
    Trips {
        /// The speed at which it reaches its clearance \[m/s\].
        speed_m_s: f64,
        /// The speed from which a low stop overturns it \[m/s\].
        trip_m_s: f64,
    },
    /// It still slides or rolls at the end.
    StillMoves,
    /// Whether it rocks across depends on a width that is not known.
    MayRockAcross,
    /// The flat base of a scan is much narrower than the scan.
    NarrowBase(NarrowBase),
    /// A body that stands on next to nothing: the rise of its centre of gravity until it falls \[m\].
    HardlyStands(f64),
    /// A body on its hull that still moves long after the motion.
    UnresolvedOnHull,
}

/// What an object does beside a wall with some cushion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BesideWall {
    /// The stiffness of the wall over that of an edge.
    pub stiffness_ratio: f64,
    /// ζ_w.
    pub damping_ratio: f64,
    /// How it ends.
    pub outcome: &'static str,
    /// Its largest tilt \[rad\].
    pub tilt_rad: f64,
}

/// A flat base where it is narrowest over the width of the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NarrowBase {
    /// The width of the base \[m\].
    pub base_m: f64,
    /// The width of the body in this direction \[m\].
    pub plan_m: f64,
}

/// What a reader must know of a history that is right.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum HistoryNote {
    /// It leans on a wall at the end.
    Leans,
    /// The base is rigid: pads serve for the shock alone.
    PadsForShockAlone,
    /// One history is worth less than shares over many.
    OneRealisation,
    /// The model falls too seldom.
    Underestimates,
    /// The model has not been tested on such bodies.
    Untested,
    /// The underside of a scan is taken to be flat.
    FlatUnderside,
    /// A scan was turned by this to stand \[rad\].
    Turned(f64),
    /// The convex hull takes the place of a scan.
    HullOfScan,
    /// How the cushion was read.
    Cushion(CushionNote),
}

/// Something that may make rows of spectra wrong.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum SpectrumDoubt {
    /// Objects that cannot rock through an impact.
    Squat(SquatObjects),
    /// A size that hardly any object has.
    Size(UnlikelySize),
    /// A limit of the model of the cushion.
    Validity(ValidityWarning),
    /// The same of the landing with the largest compression.
    OfDeepestLanding(ValidityWarning),
    /// Histories that could not be calculated, of how many.
    Failed {
        /// How many.
        failed: usize,
        /// Of how many.
        total: usize,
    },
    /// Histories that an error of the motion may change, of how many.
    Sensitive {
        /// How many.
        sensitive: usize,
        /// Of how many.
        total: usize,
    },
}

/// Something that may make what is calculated from motions wrong.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum MotionDoubt {
    /// What was noted of records, in the words of their readers.
    OfRecords(String),
    /// A component points in another direction than its file states.
    OtherDirection {
        /// The component.
        component: String,
        /// As the file states \[degrees\].
        stated_deg: f64,
        /// As it is used \[degrees\].
        used_deg: f64,
    },
    /// The shortest period has few steps.
    FewSteps {
        /// The period \[s\].
        shortest_s: f64,
        /// The step of the record \[s\].
        dt_s: f64,
        /// In how many parts each is divided.
        upsample: usize,
        /// In how many it should be.
        needed: f64,
    },
    /// The pulse is so long that the fastest oscillators have few samples in a period.
    LongPulse,
}

/// Squat objects of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SquatObjects {
    /// How many.
    pub count: usize,
    /// Of how many.
    pub objects: usize,
    /// The height of the first \[m\].
    pub height_m: f64,
    /// Its thickness \[m\].
    pub thickness_m: f64,
    /// Housner's ratio of the first.
    pub landing_ratio: f64,
}
