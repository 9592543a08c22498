//! What may be wrong in drop tests, as data; `freestand-report` has the sentences.

use freestand::identify::{FittedLaw, Flag};
use freestand_records::notes::Note;
use strum::EnumCount;

/// Something doubtful in a file of drops.
#[derive(Debug, Clone, PartialEq)]
pub struct DropsDoubt {
    /// The file.
    pub path: String,
    /// The drop, where the file has several.
    pub drop: Option<usize>,
    /// What it is.
    pub doubt: DropDoubt,
}

/// Something doubtful in a file of drops, or in one of them.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum DropDoubt {
    /// The file says another drop height than belongs to the impact velocity that was given.
    OtherHeight,
    /// The file says another impact velocity than belongs to the height that was given.
    OtherVelocity,
    /// The file says another number than was given.
    OtherNumber {
        /// Its key.
        key: &'static str,
        /// Its unit.
        unit: &'static str,
        /// In the file.
        said: f64,
        /// What was given, and counts.
        given: f64,
    },
    /// The file says another word than was given.
    OtherWord {
        /// Its key.
        key: &'static str,
        /// In the file.
        said: String,
        /// What was given, and counts.
        given: String,
    },
    /// What was noted when the record was read.
    Record(Note),
    /// The samples are evenly spaced already, by this \[s\].
    EvenlySpaced(f64),
    /// The impact velocity is found from the pulse, so the error of a given one has no effect.
    VelocityErrorUnused,
    /// The record has so many drops.
    Several(usize),
    /// A fault of the record.
    Flag(Flag),
    /// So many samples per contact are few.
    FewSamples(f64),
    /// No pad is that stiff.
    TooStiff,
    /// The estimates of a linear pad differ by this share.
    WideSpread(f64),
    /// The pulse looks like one behind a filter of this corner \[Hz\].
    Filtered(f64),
    /// The pad hardens or softens: its stiffness holds for this compression \[m\].
    Curved(f64),
    /// The zero line is not that of a free fall.
    NoGravity,
    /// Hertz's half space does not apply: the pad is compressed by more than a quarter of its thickness.
    Thin,
    /// The same of the radius of the sphere.
    SmallSphere,
}

/// Something doubtful in all drops together.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum PooledDoubt {
    /// The drops fit different laws.
    OtherLaws {
        /// The law of each.
        laws: Vec<FittedLaw>,
        /// The law of those that are pooled.
        law: FittedLaw,
        /// How many are pooled.
        pooled: usize,
    },
    /// The pad is damped, and a table is not.
    UndampedTable,
    /// The drops are from different heights, and the stiffness depends on the compression.
    OtherHeights,
}

/// In what drops differ too much to be repeats.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum Difference {
    /// What strikes the pad, in their words.
    Impactor(Vec<String>),
    /// The radius of the sphere, from and to \[m\].
    SphereRadius([f64; 2]),
    /// How the pad is held, in their words.
    Boundary(Vec<String>),
    /// The mass, from and to \[kg\].
    Mass([f64; 2]),
}
