//! Uplift response spectra (URS) and the shock spectra (SRS) that follow from them.
//!
//! The rocking response of an object depends on its geometry, its restitution and the motion; mass and stiffness enter
//! afterwards, so one uplift spectrum gives the shock for any of them.

use rayon::prelude::*;

use crate::G0_M_S2;
use crate::block::Block;
use crate::impact::{ImpactModel, Landing};
use crate::rocking::{Base, Outcome, Rocking, RockingError, RockingOptions, SideExtremes, StopReason, rock};

/// One cell of an uplift response spectrum: an object under a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpliftCell {
    /// The object.
    pub block: Block,
    /// What it did.
    pub outcome: Outcome,
    /// Why its history stopped.
    pub stop: StopReason,
    /// Largest |θ| \[rad\]; π/2 when overturned.
    pub peak_rotation_rad: f64,
    /// Impacts until rest or the end.
    pub impact_count: usize,
    /// B sin(peak rotation): lift of the free base edge \[m\].
    pub uplift_m: f64,
    /// Largest rise of the centre of gravity \[m\]; R(1 − cos α) once |θ| passed α.
    pub cg_rise_m: f64,
    /// Extremes on the right and the left edge, from which the shock follows.
    pub sides: [SideExtremes; 2],
}

/// The shock that belongs to an [`UpliftCell`], for a mass and a stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShockCell {
    /// a_edge from the largest rise of the centre of gravity (the paper's source); `None` for overturned objects \[g\].
    pub edge_acceleration_g: Option<f64>,
    /// a_edge from the largest velocity before an impact; `None` for overturned objects \[g\].
    pub edge_acceleration_impact_velocity_g: Option<f64>,
    /// The `uplift` shock at the balance point: no record can give more \[g\].
    pub ceiling_g: f64,
}

/// The uplift response spectrum of `base` over `blocks`: one cell for each, in their order.
///
/// Blocks are followed in parallel on the current thread pool; every cell is computed on its own, so the result does not
/// depend on the number of threads.
///
/// # Errors
/// Each cell has its own: see [`rock`].
pub fn uplift_spectrum(
    blocks: &[Block],
    base: Base,
    options: &RockingOptions,
) -> Vec<Result<UpliftCell, RockingError>> {
    blocks.par_iter().map(|block| Ok(UpliftCell::new(*block, &rock(block, base, options)?))).collect()
}

impl UpliftCell {
    /// What a spectrum keeps of a history.
    pub fn new(block: Block, rocking: &Rocking) -> Self {
        Self {
            block,
            outcome: rocking.outcome,
            stop: rocking.stop,
            peak_rotation_rad: rocking.peak_rotation_rad,
            impact_count: rocking.impacts.len(),
            uplift_m: rocking.uplift_m,
            cg_rise_m: rocking.cg_rise_m,
            sides: rocking.sides,
        }
    }

    /// Largest |ω| just before an impact \[rad/s\]; 0 without impacts.
    pub fn impact_omega_rad_s(&self) -> f64 {
        self.sides.iter().fold(0.0, |most: f64, side| most.max(side.impact_omega_rad_s))
    }

    /// The shock on a linear cushion `stiffness_n_m` under the landing edge: the harder of the landings off the two
    /// edges, which are alike unless the centre of gravity is off the middle.
    pub fn shock(&self, mass_kg: f64, stiffness_n_m: f64, model: ImpactModel, gravity_m_s2: f64) -> ShockCell {
        let stands = self.outcome != Outcome::Overturned;
        let landings = landings(&self.block, model);
        let largest = |rise_m: &dyn Fn(&Landing, SideExtremes) -> f64| {
            let shocks = landings.iter().zip(self.sides).map(|(landing, side)| {
                let rise_m = rise_m(landing, side);
                landing.impact(mass_kg, stiffness_n_m, rise_m, gravity_m_s2).edge_acceleration_m_s2 / G0_M_S2
            });
            shocks.fold(0.0, f64::max)
        };
        let uplift = |landing: &Landing, side: SideExtremes| landing.pivot.largest_rise_m(side.peak_rotation_rad);
        let velocity =
            |landing: &Landing, side: SideExtremes| landing.equivalent_rise_m(side.impact_omega_rad_s, gravity_m_s2);
        ShockCell {
            edge_acceleration_g: stands.then(|| largest(&uplift)),
            edge_acceleration_impact_velocity_g: stands.then(|| largest(&velocity)),
            ceiling_g: largest(&|landing, _| landing.pivot.balance_rise_m()),
        }
    }
}

/// The landings of a rocking block, off its right edge and off its left one.
pub fn landings(block: &Block, model: ImpactModel) -> [Landing; 2] {
    [block.mirrored(), *block].map(|block| Landing::rocking(&block, model))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Motion;

    /// The ceilings that are known: 150 kg on 4380 N/mm.
    #[test]
    fn ceiling_is_the_shock_at_the_balance_point() {
        for (thickness_m, height_m, expected) in [(0.2, 1.5, 1.45), (0.4, 1.5, 5.72), (0.6, 2.0, 8.32)] {
            let block = Block::uniform(height_m, thickness_m).unwrap();
            let still = Motion::new(0.01, vec![0.0; 3]).unwrap();
            let base = Base { horizontal: Some(&still), vertical: None };
            let cells = uplift_spectrum(&[block], base, &RockingOptions::default());
            let cell = cells[0].unwrap();
            assert_eq!(cell.outcome, Outcome::NoUplift);
            let shock = cell.shock(150.0, 4.38e6, ImpactModel::Paper, G0_M_S2);
            // Two decimals are known.
            assert!((shock.ceiling_g - expected).abs() < 5e-3, "{}", shock.ceiling_g);
            assert_eq!(shock.edge_acceleration_g, Some(0.0));
        }
    }

    /// An overturned object has no shock, and its uplift is its whole base.
    #[test]
    fn overturned_cells_carry_no_shock() {
        let block = Block::uniform(2.0, 0.2).unwrap();
        let push = Motion::new(0.01, vec![0.5 * G0_M_S2; 400]).unwrap();
        let base = Base { horizontal: Some(&push), vertical: None };
        let cell = uplift_spectrum(&[block], base, &RockingOptions::default())[0].unwrap();
        assert_eq!((cell.outcome, cell.uplift_m), (Outcome::Overturned, 0.2));
        let shock = cell.shock(150.0, 4.38e6, ImpactModel::Paper, G0_M_S2);
        assert_eq!((shock.edge_acceleration_g, shock.edge_acceleration_impact_velocity_g), (None, None));
    }
}
