//! The energy balance of a history.

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

/// Where the energy is at one instant, as in [`EnergyAudit`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Energies {
    pub(crate) kinetic_j: f64,
    pub(crate) potential_j: f64,
    pub(crate) stored_j: f64,
    pub(crate) base_work_j: f64,
    pub(crate) cushion_dissipation_j: f64,
    pub(crate) tangential_dissipation_j: f64,
    pub(crate) friction_j: f64,
}

/// The running balance of a history.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Ledger {
    pub(crate) audit: EnergyAudit,
    worst_j: f64,
    max_kinetic_j: f64,
    rest_j: f64,
}

impl Ledger {
    /// Begins with the energies at the start; `rest_j` is the work of the weight on the cushions.
    pub(crate) fn open(rest_j: f64, energies: &Energies) -> Self {
        let mut ledger = Self {
            rest_j,
            ..Self::default()
        };
        ledger.enter(energies);
        ledger.audit.initial_j = ledger.balance_j();
        ledger.worst_j = 0.0;
        ledger
    }

    /// Everything accounted for, less the initial energy.
    fn balance_j(&self) -> f64 {
        let a = &self.audit;
        let dissipated_j = a.cushion_dissipation_j
            + a.tangential_dissipation_j
            + a.friction_j
            + a.lost_at_separation_j;
        a.kinetic_j + a.potential_j + a.stored_j + dissipated_j - a.base_work_j - a.initial_j
    }

    /// Adds the energies at the end of a step.
    pub(crate) fn enter(&mut self, now: &Energies) {
        let a = &mut self.audit;
        (a.kinetic_j, a.potential_j, a.stored_j) = (now.kinetic_j, now.potential_j, now.stored_j);
        a.base_work_j = now.base_work_j;
        (
            a.cushion_dissipation_j,
            a.tangential_dissipation_j,
            a.friction_j,
        ) = (
            now.cushion_dissipation_j,
            now.tangential_dissipation_j,
            now.friction_j,
        );
        self.max_kinetic_j = self.max_kinetic_j.max(a.kinetic_j);
        self.worst_j = self.worst_j.max(self.balance_j().abs());
    }

    pub(crate) fn lose(&mut self, energy_j: f64) {
        self.audit.lost_at_separation_j += energy_j;
    }

    pub(crate) fn close(mut self) -> EnergyAudit {
        let a = &mut self.audit;
        let dissipated_j = a.cushion_dissipation_j
            + a.tangential_dissipation_j
            + a.friction_j
            + a.lost_at_separation_j;
        a.turnover_j = self.max_kinetic_j + dissipated_j + self.rest_j;
        a.residual_ratio = self.worst_j / a.turnover_j;
        self.audit
    }
}
