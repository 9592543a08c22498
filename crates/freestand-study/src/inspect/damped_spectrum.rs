//! A response spectrum at one damping.

use freestand::G0_M_S2;
use freestand::oscillator::ResponseSpectrum;
use schemars::JsonSchema;
use serde::Serialize;

/// A response spectrum at one damping.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[expect(
    missing_docs,
    reason = "the names are those of the JSON document and state the units"
)]
pub struct DampedSpectrum {
    pub damping_ratio: f64,
    pub sd_m: Vec<f64>,
    pub psv_m_s: Vec<f64>,
    pub psa_g: Vec<f64>,
    pub sa_g: Vec<f64>,
}

impl DampedSpectrum {
    pub(super) fn new(damping_ratio: f64, spectrum: &ResponseSpectrum) -> Self {
        let in_g = |values: &[f64]| values.iter().map(|a| a / G0_M_S2).collect();
        Self {
            damping_ratio,
            sd_m: spectrum.sd_m.clone(),
            psv_m_s: spectrum.psv_m_s.clone(),
            psa_g: in_g(&spectrum.psa_m_s2),
            sa_g: in_g(&spectrum.sa_m_s2),
        }
    }
}
