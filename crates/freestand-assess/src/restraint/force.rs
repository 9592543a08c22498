//! The force of a restraint of an object, and what follows from it.

use serde::{Deserialize, Serialize};

use super::RestraintAxis;
use super::footing::Footing;
use super::source::{Source, SourceKind};

/// Coefficient of friction with which feet that are not fixed may carry a force: an assumption, low
/// for rubber or steel on a dry floor.
pub const FOOT_FRICTION_RATIO: f64 = 0.3;

/// A force for the design of a restraint, with the numbers that lead to it, and what it asks of anchors or
/// of a bracket.
///
/// With the force F at the height c of the centre of gravity, the weight W, the lever e of the
/// weight and the base B, about the axis that needs more.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RestraintForce {
    /// Who asks for it.
    pub source: Source,
    /// W \[N\].
    pub weight_n: f64,
    /// c \[m\].
    pub cg_height_m: f64,
    /// The axis that needs more tension; `None` for an object without a side.
    pub axis: Option<RestraintAxis>,
    /// How the object stands on its anchors.
    pub footing: Footing,
    /// Horizontal force F at the centre of gravity \[N\].
    pub force_n: f64,
    /// Share d of the dead load that holds the object down.
    pub dead_load_ratio: f64,
    /// Weight H that holds the object down, over its weight: max(0, d − v), with the deduction v for
    /// vertical shaking.
    pub held_weight_ratio: f64,
    /// Tension of all anchors along one edge together, max(0, (F c − H e)/B) \[N\]; 0: the weight
    /// suffices.
    pub anchor_tension_n: f64,
    /// The same in concrete, max(0, (Ω₀ F c − H e)/B) \[N\].
    pub anchor_tension_concrete_n: f64,
    /// Height z_b of a bracket \[m\].
    pub bracket_height_m: f64,
    /// The height that the study states for it, where the object is lower \[m\].
    pub too_high_bracket_m: Option<f64>,
    /// Force of that bracket, F c/z_b; the weight is not counted \[N\].
    pub bracket_force_n: f64,
    /// The same in concrete, Ω₀ F c/z_b \[N\].
    pub bracket_force_concrete_n: f64,
    /// Horizontal force at the feet beside that bracket, F |1 − c/z_b| \[N\].
    pub bracket_base_shear_n: f64,
}

impl RestraintForce {
    /// F/W.
    pub fn force_ratio(&self) -> f64 {
        self.source.part.force_ratio
    }

    /// F c \[N m\].
    pub fn overturning_moment_n_m(&self) -> f64 {
        self.force_n * self.cg_height_m
    }

    /// H e, of the weight that holds the object down \[N m\]; 0 without an axis.
    pub fn resisting_moment_n_m(&self) -> f64 {
        self.held_n() * self.weight_lever_m()
    }

    /// Distance of the anchors from the edge about the axis \[m\].
    pub fn inset_m(&self) -> f64 {
        self.of_axis(|axis| axis.inset_m(self.footing.inset_m))
    }

    /// Lever of the weight about the line about which the object tips \[m\].
    pub fn weight_lever_m(&self) -> f64 {
        self.of_axis(|axis| axis.lever_of_weight_m(self.footing))
    }

    /// Lever of the anchors along one edge about that line \[m\].
    pub fn anchor_lever_m(&self) -> f64 {
        self.of_axis(|axis| axis.anchor_lever_m(self.footing))
    }

    /// What friction may carry at feet that are not fixed \[N\].
    pub fn foot_friction_n(&self) -> f64 {
        FOOT_FRICTION_RATIO * self.held_n()
    }

    /// H \[N\].
    fn held_n(&self) -> f64 {
        self.held_weight_ratio * self.weight_n
    }

    fn of_axis(&self, value: impl Fn(&RestraintAxis) -> f64) -> f64 {
        self.axis.as_ref().map_or(0.0, value)
    }
}

/// The force that counts for an object: by the study's own code, or by the computed floor where the
/// study has no code. `None`: there is none, or only forces for comparison.
pub fn reported_force(forces: &[RestraintForce]) -> Option<&RestraintForce> {
    forces
        .iter()
        .find(|force| force.source.kind != SourceKind::OtherCode)
}

/// The force that anchors and a bracket are designed for: [`reported_force`], or that of the floor
/// where the code's force would not lift the object and that of the floor does.
pub fn design_force(forces: &[RestraintForce]) -> Option<&RestraintForce> {
    let reported = reported_force(forces)?;
    let floor = forces
        .iter()
        .find(|force| force.source.kind == SourceKind::Floor && force.anchor_tension_n > 0.0);
    Some(
        floor
            .filter(|_| reported.anchor_tension_n <= 0.0)
            .unwrap_or(reported),
    )
}
