//! The time after the motion: when an object on cushions has come to rest, and whether one that has
//! not may still fall.

use super::audit::Ledger;

/// How long the object must be calm to count as at rest \[s\].
const CALM_S: f64 = 0.25;

/// The kinetic energy of a calm object, in units of the work of its weight on its cushions. Lifting
/// an edge takes a quarter of that work.
const CALM_RATIO: f64 = 1e-3;

/// How long after the motion an object is followed that certainly does not fall any more and is not calm: on
/// cushions without damping it rings for ever \[s\].
const CERTAIN_S: f64 = 5.0;

/// Share of the energy of a rigid body at its balance point below which it certainly swings back: on
/// cushions the balance point is a little lower.
const CERTAIN_RATIO: f64 = 0.9;

/// The end of a history after the motion.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Tail {
    /// The work of the weight on the cushions \[J\].
    rest_j: f64,
    /// Energy at rest, relative to unloaded cushions \[J\].
    stands_j: f64,
    /// Energy that takes the object from rest to its balance point \[J\].
    balance_j: f64,
    /// Whether a calm object ends the history.
    ends: bool,
    /// Whether the floor stands still for good.
    is_quiet: bool,
    quiet_since_s: Option<f64>,
    calm_since_s: Option<f64>,
    /// Whether the history has nothing more to tell: the object is at rest, or it is certain that it stays
    /// upright.
    pub(crate) is_over: bool,
}

impl Tail {
    pub(crate) fn new(rest_j: f64, stands_j: f64, balance_j: f64, ends: bool) -> Self {
        Self {
            rest_j,
            stands_j,
            balance_j,
            ends,
            ..Self::default()
        }
    }

    /// The floor stands still from now on.
    pub(crate) fn begin(&mut self) {
        self.is_quiet = true;
    }

    /// A step after the motion has ended; `is_held`: all its feet carry it, or a wall does.
    pub(crate) fn step(&mut self, time_s: f64, ledger: &Ledger, is_held: impl FnOnce() -> bool) {
        if !(self.is_quiet && self.ends) {
            return;
        }
        let quiet_since_s = *self.quiet_since_s.get_or_insert(time_s);
        if time_s - quiet_since_s >= CERTAIN_S && self.stays_up(ledger) {
            self.is_over = true;
        } else if ledger.audit.kinetic_j > CALM_RATIO * self.rest_j || !is_held() {
            self.calm_since_s = None;
        } else {
            self.is_over = time_s - *self.calm_since_s.get_or_insert(time_s) >= CALM_S;
        }
    }

    /// Whether the history ended before it was certain that the object stays upright.
    pub(crate) fn is_open(&self, ledger: &Ledger) -> bool {
        !self.is_over && !self.stays_up(ledger)
    }

    /// Whether the object has too little energy to fall on a floor that stands still.
    fn stays_up(&self, ledger: &Ledger) -> bool {
        let audit = &ledger.audit;
        let above_j = audit.kinetic_j + audit.potential_j + audit.stored_j - self.stands_j;
        above_j < CERTAIN_RATIO * self.balance_j - self.rest_j
    }
}
