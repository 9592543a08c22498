//! The rigid block rocking on a rigid base (Housner 1963).

/// Equation of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RockingModel {
    /// θ̈ = −p²[(1+ü_v/g) sin(sα−θ) + (ü_h/g) cos(sα−θ)].
    #[default]
    Rigid,
    /// sin x → x, cos x → 1, tan α → α: for tests against closed forms.
    Linearised,
}

/// ω⁺/ω⁻ at an impact, in the motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Restitution {
    /// Housner's ratio of the block ([`crate::block::Block::landing_ratio`]); 0 for a squat block.
    #[default]
    Housner,
    /// A value in (0, 1] for every impact.
    Value(f64),
    /// Housner's ratio times a factor.
    Factor(f64),
}

/// How accurately a history is followed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Accuracy {
    /// For surveys.
    Fast,
    /// The default.
    #[default]
    Standard,
    /// As far as double precision goes.
    Tight,
    /// A relative truncation error per step.
    Tolerance(f64),
}
