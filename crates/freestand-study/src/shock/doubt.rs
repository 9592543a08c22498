//! What there is to know beside a shock, as data; `freestand-report` has the sentences.

use freestand::impact::ValidityWarning;
use freestand_input::quantity::{Dimension, format_si};
use strum::EnumCount;

use super::test_points::TestsDoubt;
use crate::cushion::CushionNote;

/// Something that may make a shock wrong, or that was given and is not used.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum ShockDoubt {
    /// The fall starts from rest at the balance point.
    FromRest,
    /// The object is beyond its balance point.
    BeyondBalance(BalancePoint),
    /// A limit of the model of the impact or of the cushion.
    Validity(ValidityWarning),
    /// An object that falls over does not land on its edge.
    EdgeUnused,
    /// An object that falls over starts from its balance point.
    RiseUnused,
    /// The model is for comparison only.
    FreeCorner,
    /// What is missing or doubtful in the tests of the object.
    Tests(TestsDoubt),
    /// The point that was asked for lies outside the object.
    PointOutside,
    /// The component is not compared.
    ComponentNotCompared,
    /// The survived uplift is not compared.
    UpliftNotCompared,
}

/// Where an object stands on one edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BalancePoint {
    /// Rise of the centre of gravity \[m\].
    pub rise_m: f64,
    /// \[rad\]
    pub rotation_rad: f64,
    /// Of the free base edge \[m\].
    pub uplift_m: f64,
}

impl BalancePoint {
    /// Its numbers, as refusals and warnings name it.
    pub fn words(&self) -> String {
        format!(
            "balance point (a rise of the centre of gravity of {}, a rotation of {:.4} rad, an uplift of {})",
            format_si(self.rise_m, Dimension::Length),
            self.rotation_rad,
            format_si(self.uplift_m, Dimension::Length),
        )
    }
}

/// What a reader must know of a shock that is right.
#[derive(Debug, Clone, PartialEq, EnumCount)]
pub enum ShockNote {
    /// How the cushion was read.
    Cushion(CushionNote),
    /// The stiffness that follows from the measured drop acceleration \[N/m\].
    ImpliedStiffness(f64),
    /// There is no largest stiffness.
    NoLargestStiffness(NoLargestStiffness),
}

/// Why there is no largest stiffness at which the verdict is `ok`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoLargestStiffness {
    /// No stiffness helps against the uplift.
    UpliftTooLarge,
    /// No stiffness helps against the velocity change.
    VelocityChangeTooLarge,
    /// At any stiffness the velocity change is below its limit.
    VelocityChangeSmall,
    /// The verdict is `ok` at any stiffness.
    AnyWillDo,
}
