//! The force of a restraint of an object.

use serde::{Deserialize, Serialize};

/// A force for the design of a restraint, and what it asks of anchors or of a bracket.
///
/// With the force F at the height c of the centre of gravity, the weight W, the lever e of the
/// weight and the base B, about the axis that needs more.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RestraintForce {
    /// What kind of source it is by.
    pub kind: RestraintKind,
    /// The clause.
    pub source: String,
    /// Horizontal force F at the centre of gravity \[N\].
    pub force_n: f64,
    /// Force divided by weight.
    pub force_ratio: f64,
    /// Weight H that holds the object down, over its weight: max(0, d − v), with the share d of the
    /// dead load and the deduction v for vertical shaking.
    pub held_weight_ratio: f64,
    /// Ω₀, factor on F for anchors in concrete.
    pub overstrength_ratio: f64,
    /// Tension of all anchors along one edge together, max(0, (F c − H e)/B) \[N\]; 0: the weight
    /// suffices.
    pub anchor_tension_n: f64,
    /// The same in concrete, max(0, (Ω₀ F c − H e)/B) \[N\].
    pub anchor_tension_concrete_n: f64,
    /// Height z_b of a bracket \[m\].
    pub bracket_height_m: f64,
    /// Force of that bracket, F c/z_b; the weight is not counted \[N\].
    pub bracket_force_n: f64,
    /// The same in concrete, Ω₀ F c/z_b \[N\].
    pub bracket_force_concrete_n: f64,
    /// Horizontal force at the feet beside that bracket, F |1 − c/z_b| \[N\].
    pub bracket_base_shear_n: f64,
    /// The formula with its numbers, the factors, and what was assumed.
    pub note: String,
    /// What of it nobody has read in the code: factors and clauses, by their names.
    pub recalled: Vec<String>,
}

/// The kind of source of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum RestraintKind {
    /// A clause of the study's own code.
    OwnCode,
    /// The acceleration of its floor.
    Floor,
    /// A clause of another code, on the study's spectrum.
    OtherCode,
}

impl RestraintKind {
    /// What a number by such a source is.
    pub fn description(self) -> &'static str {
        match self {
            Self::OwnCode => "a clause of the study's code",
            Self::Floor => "the floor of the simulated earthquakes",
            Self::OtherCode => "a clause of another code, for comparison",
        }
    }
}

/// The force that counts for an object: by the study's own code, or by the computed floor where the
/// study has no code. `None`: there is none, or only forces for comparison.
pub fn reported_force(forces: &[RestraintForce]) -> Option<&RestraintForce> {
    forces
        .iter()
        .find(|force| force.kind != RestraintKind::OtherCode)
}

/// The force that anchors and a bracket are designed for: [`reported_force`], or that of the floor
/// where the code's force would not lift the object and that of the floor does.
pub fn design_force(forces: &[RestraintForce]) -> Option<&RestraintForce> {
    let reported = reported_force(forces)?;
    let floor = forces
        .iter()
        .find(|force| force.kind == RestraintKind::Floor && force.anchor_tension_n > 0.0);
    Some(
        floor
            .filter(|_| reported.anchor_tension_n <= 0.0)
            .unwrap_or(reported),
    )
}
