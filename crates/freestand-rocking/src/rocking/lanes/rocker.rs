//! The constants of a block in the kernel, about each of its edges.

use std::f64::consts::FRAC_PI_2;

/// The constants of a block in the kernel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rocker {
    /// About the right edge (s = 1) and about the left one (s = −1).
    pub(super) edges: [EdgeTerms; 2],
    /// Restitution of a landing on each edge.
    pub(super) restitution: [f64; 2],
}

/// The constants of a block rotating about one edge, in units of the step:
/// ÿ = −(E cos y − D sin y), E = a(1+ü_v/g) + s b ü_h/g, D = b(1+ü_v/g) − s a ü_h/g, a = x² sin α,
/// b = x² cos α.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeTerms {
    pub(super) alpha: f64,
    /// p²h².
    pub(super) x2: f64,
    /// a/b: tan α; infinite where the block at rest touches the wall, so that nothing lifts it.
    pub(super) threshold: f64,
    pub(super) b: f64,
    /// θ_c of the wall, or π/2 without one.
    pub(super) ceiling: f64,
}

impl Rocker {
    pub(super) fn is_symmetric(&self) -> bool {
        let [a, b] = &self.edges;
        a.alpha == b.alpha && a.x2 == b.x2 && a.ceiling == b.ceiling
    }
}

impl EdgeTerms {
    pub(super) fn has_wall(&self) -> bool {
        self.ceiling < FRAC_PI_2
    }

    pub(super) fn touches_wall(&self) -> bool {
        self.ceiling == 0.0
    }

    /// Whether a block at the wall is past its balance point.
    pub(super) fn is_past_balance(&self) -> bool {
        self.ceiling >= self.alpha
    }
}
