//! What is kept of a block while it is followed.

use super::chatter::Trace;

/// The response of a block so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Record {
    /// Largest rotation about each edge \[rad\], and largest speed of an impact that ends it
    /// \[rad per step\].
    pub(super) sides: [Trace; 2],
    pub(super) impact_count: usize,
    pub(super) state: State,
    /// Whether the block has met a wall since it left the floor.
    pub(super) bounced: bool,
}

/// What a block has to do with walls; apart from its [`Record`], which every event changes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct WallRecord {
    /// Restitution of an impact on the wall beyond each edge.
    pub(super) restitution: [f64; 2],
    /// What presses a block at each wall on it, as the parts of 1 + ü_v/g and of ü_h/g:
    /// −x² sin(α−θ_c) and −s x² cos(α−θ_c).
    pub(super) press: [[f64; 2]; 2],
    /// Largest speed of an impact on each wall \[rad per step\].
    pub(super) speeds: [f64; 2],
    pub(super) impact_count: usize,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum State {
    /// At rest, never lifted.
    #[default]
    Untouched,
    AtRest,
    Moving,
    /// Held by the wall beyond an edge.
    Leaning {
        edge: u8,
        past_balance: bool,
    },
    /// Past its balance point at the end, and bouncing on a wall.
    Bouncing,
    Overturned,
    /// Left to the scalar solver.
    GivenUp,
}
