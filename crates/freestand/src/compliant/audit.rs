//! The energy balance of a history.

use super::equation::{Body, DASHPOT, DRAG, Grip, SLIP, State, WORK};

/// The energy of a block relative to its base, at the end of a history.
///
/// Kinetic + potential + stored + dissipated + lost − work of the base equals the initial energy up
/// to the error of the integration: `residual_ratio`. The dissipated parts are integrated together
/// with the motion; none is calculated as the remainder of a sum.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EnergyAudit {
    /// Energy at the start, relative to unloaded cushions \[J\].
    pub initial_j: f64,
    /// Kinetic energy ½m v² + ½I ω², relative to the base \[J\].
    pub kinetic_j: f64,
    /// Potential energy m g z \[J\].
    pub potential_j: f64,
    /// Energy stored in cushions and tangential springs \[J\].
    pub stored_j: f64,
    /// Dissipated by the dashpots of the cushions \[J\].
    pub cushion_dissipation_j: f64,
    /// Dissipated by tangential dashpots \[J\].
    pub tangential_dissipation_j: f64,
    /// Dissipated by slip \[J\].
    pub friction_j: f64,
    /// Energy left in cushions and tangential springs where a contact ended; they recover without
    /// the block \[J\].
    pub lost_at_separation_j: f64,
    /// Work done by the base: −m ∫(ü_h ẋ + ü_v ż) dt \[J\].
    pub base_work_j: f64,
    /// The reference for the error: largest kinetic energy, plus all that was dissipated and lost
    /// and the work of the weight on the cushions \[J\].
    pub turnover_j: f64,
    /// The largest error of the balance at any time, divided by the turnover.
    pub residual_ratio: f64,
}

/// The running balance of a history.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Ledger {
    pub(super) audit: EnergyAudit,
    worst_j: f64,
    max_kinetic_j: f64,
    rest_j: f64,
}

impl Ledger {
    pub(super) fn open(body: &Body, grips: &[Grip], y: &State) -> Self {
        let mut ledger = Self::default();
        let weight_n = body.mass * body.gravity;
        ledger.rest_j = weight_n * body.cushion.static_compression_m(0.5 * weight_n);
        ledger.enter(body, grips, y);
        ledger.audit.initial_j = ledger.balance_j();
        ledger.worst_j = 0.0;
        ledger
    }

    /// Everything accounted for, less the initial energy.
    fn balance_j(&self) -> f64 {
        let a = &self.audit;
        let dissipated_j = a.cushion_dissipation_j + a.tangential_dissipation_j + a.friction_j + a.lost_at_separation_j;
        a.kinetic_j + a.potential_j + a.stored_j + dissipated_j - a.base_work_j - a.initial_j
    }

    /// Adds the state at the end of a step.
    pub(super) fn enter(&mut self, body: &Body, grips: &[Grip], y: &State) {
        let a = &mut self.audit;
        (a.kinetic_j, a.potential_j) = body.mechanical_j(y);
        a.stored_j = body.stored_j(grips, y);
        a.base_work_j = y[WORK];
        (a.cushion_dissipation_j, a.tangential_dissipation_j, a.friction_j) = (y[DASHPOT], y[DRAG], y[SLIP]);
        self.max_kinetic_j = self.max_kinetic_j.max(a.kinetic_j);
        self.worst_j = self.worst_j.max(self.balance_j().abs());
    }

    pub(super) fn lose(&mut self, energy_j: f64) {
        self.audit.lost_at_separation_j += energy_j;
    }

    pub(super) fn close(mut self) -> EnergyAudit {
        let a = &mut self.audit;
        let dissipated_j = a.cushion_dissipation_j + a.tangential_dissipation_j + a.friction_j + a.lost_at_separation_j;
        a.turnover_j = self.max_kinetic_j + dissipated_j + self.rest_j;
        a.residual_ratio = self.worst_j / a.turnover_j;
        self.audit
    }
}
