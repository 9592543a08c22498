//! Uplift response spectra (URS) and the shock spectra (SRS) that follow from them.
//!
//! The rocking response of an object depends on its geometry, its restitution and the motion; mass and stiffness enter
//! afterwards, so one uplift spectrum gives the shock for any of them.

use crate::G0_M_S2;
use crate::block::Block;
use crate::impact::{ImpactModel, Landing};

/// What an object did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The base never passed the uplift threshold.
    NoUplift,
    /// It rocked and did not fall.
    Rocked,
    /// |θ| reached π/2.
    Overturned,
}

impl Outcome {
    /// The word for it in every output: `no-uplift`, `rocked`, `overturned`.
    pub fn name(self) -> &'static str {
        match self {
            Self::NoUplift => "no-uplift",
            Self::Rocked => "rocked",
            Self::Overturned => "overturned",
        }
    }
}

/// One cell of an uplift response spectrum: an object under a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpliftCell {
    /// The object.
    pub block: Block,
    /// What it did.
    pub outcome: Outcome,
    /// Largest |θ| \[rad\]; π/2 when overturned.
    pub peak_rotation_rad: f64,
    /// Impacts until rest or the end.
    pub impact_count: usize,
    /// B sin(peak rotation): lift of the free base edge \[m\].
    pub uplift_m: f64,
    /// Largest rise of the centre of gravity \[m\]; R(1 − cos α) once |θ| passed α.
    pub cg_rise_m: f64,
    /// Largest |ω| just before an impact \[rad/s\]; 0 without impacts.
    pub impact_omega_rad_s: f64,
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

impl UpliftCell {
    /// The shock on a linear cushion `stiffness_n_m` under the landing edge.
    pub fn shock(&self, mass_kg: f64, stiffness_n_m: f64, model: ImpactModel, gravity_m_s2: f64) -> ShockCell {
        let landing = Landing::rocking(&self.block, model);
        let g_at =
            |rise_m: f64| landing.impact(mass_kg, stiffness_n_m, rise_m, gravity_m_s2).edge_acceleration_m_s2 / G0_M_S2;
        let stands = self.outcome != Outcome::Overturned;
        let impact_rise_m = landing.equivalent_rise_m(self.impact_omega_rad_s, gravity_m_s2);
        ShockCell {
            edge_acceleration_g: stands.then(|| g_at(self.cg_rise_m)),
            edge_acceleration_impact_velocity_g: stands.then(|| g_at(impact_rise_m)),
            ceiling_g: g_at(landing.pivot.balance_rise_m()),
        }
    }
}
