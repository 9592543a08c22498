//! What is reported of a fit: its law, its damping, its place among the others.

use super::fit::Fit;
use super::model::Elastic;
use super::{Candidate, FittedLaw};
use crate::cushion::ContactLaw;

/// Points of the table of a law without a formula of [`ContactLaw`].
const TABLE_POINTS: u32 = 32;

pub(super) fn candidate(fit: &Fit) -> Candidate {
    Candidate {
        law: fit.law,
        secant_n_m: fit.secant_n_m,
        exponent: fit.model.exponent(),
        damping_ratio: fit.damping_ratio,
        residual_ratio: fit.residual_ratio,
        chi_squared: fit.chi_squared,
    }
}

pub(super) fn law_of(fit: &Fit) -> ContactLaw {
    let model = &fit.model;
    let Elastic::Power {
        coefficient_n_mn,
        exponent,
    } = model.elastic
    else {
        return table_of(fit);
    };
    match fit.law {
        FittedLaw::Linear => ContactLaw::Linear {
            stiffness_n_m: coefficient_n_mn,
        },
        FittedLaw::KelvinVoigt => ContactLaw::KelvinVoigt {
            stiffness_n_m: coefficient_n_mn,
            damping_n_s_m: model.damping_n_s_m.max(0.0),
        },
        FittedLaw::HuntCrossley => ContactLaw::HuntCrossley {
            coefficient_n_mn,
            exponent,
            dissipation_s_m: model.dissipation_s_m.max(0.0),
        },
        FittedLaw::Power | FittedLaw::DampedPower => ContactLaw::Power {
            coefficient_n_mn,
            exponent,
        },
        FittedLaw::Cubic | FittedLaw::Tabulated => table_of(fit),
    }
}

/// The elastic force up to the largest compression of the test: a measured curve says nothing about what is beyond.
fn table_of(fit: &Fit) -> ContactLaw {
    let deepest_m = fit.predicted.compression_m;
    let at = |i: u32| deepest_m * f64::from(i) / f64::from(TABLE_POINTS);
    let compressions_m: Vec<f64> = (0..=TABLE_POINTS).map(at).collect();
    let mut forces_n: Vec<f64> = Vec::with_capacity(compressions_m.len());
    for &d in &compressions_m {
        // The force of a pad never falls; the noise of a fit is not allowed to.
        let before = forces_n.last().copied().unwrap_or(0.0);
        let least = if forces_n.is_empty() {
            0.0
        } else {
            before * (1.0 + 1e-9) + 1e-9
        };
        forces_n.push(fit.model.elastic_n(d).max(least));
    }
    ContactLaw::Tabulated {
        compressions_m,
        forces_n,
    }
}

/// ζ, or for Hunt–Crossley that of the Kelvin–Voigt pad with the same restitution: e = exp(−2ζ acos
/// ζ/√(1−ζ²)).
pub(super) fn damping_ratio(fit: &Fit) -> f64 {
    match fit.law {
        // A law has no negative damping, and this number must agree with the law.
        FittedLaw::KelvinVoigt | FittedLaw::Tabulated => fit.damping_ratio.max(0.0),
        FittedLaw::HuntCrossley => {
            let e = fit.predicted.rebound_m_s / fit.model.speed_m_s;
            let of = |zeta: f64| (-2.0 * zeta * zeta.acos() / (1.0 - zeta * zeta).sqrt()).exp();
            if e >= 1.0 {
                0.0
            } else {
                crate::search::bisect(0.0, 0.999, |zeta| of(zeta) <= e)
            }
        }
        _ => 0.0,
    }
}
