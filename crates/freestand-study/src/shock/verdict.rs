//! Demand over capacity of one landing, by all that is known of what the object stands.

use freestand::cushion::Cushion;
use freestand::impact::{Impact, Landing};
use freestand::shock_response::{HalfSine, half_sine_severity_ratio};
use serde::Serialize;

use super::ShockRequest;

/// What was known of the tolerance, each as demand over capacity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DemandCapacity {
    /// A/A_c.
    pub peak: f64,
    /// Δv/V_c.
    pub velocity_change: Option<f64>,
    /// min(A/A_c, Δv/V_c): the damage boundary is an AND.
    pub damage_boundary: Option<f64>,
    /// The largest ratio of the two shock response spectra over frequency.
    pub spectrum: Option<f64>,
}

/// Demand over capacity for each kind of tolerance, the largest of those that apply, and its name.
///
/// A velocity change makes the peak part of a damage boundary, a duration makes it part of a spectrum; the bare peak
/// governs only where nothing else is known.
pub(super) fn verdict(
    request: &ShockRequest,
    edge_m_s2: f64,
    impact: Option<&Impact>,
) -> Option<(DemandCapacity, f64, &'static str)> {
    let tolerance = request.tolerance_m_s2?;
    let peak = edge_m_s2 / tolerance;
    let velocity_change =
        request.tolerance_velocity_change_m_s.zip(impact).map(|(limit, impact)| impact.velocity_change_m_s / limit);
    let damage_boundary = velocity_change.map(|ratio| ratio.min(peak));
    let spectrum = request.tolerance_duration_s.zip(impact).map(|(duration_s, impact)| {
        half_sine_severity_ratio(
            HalfSine { peak_acceleration: edge_m_s2, duration_s: impact.pulse_duration_s },
            HalfSine { peak_acceleration: tolerance, duration_s },
        )
    });
    let all = DemandCapacity { peak, velocity_change, damage_boundary, spectrum };
    let (ratio, name) = match (damage_boundary, spectrum) {
        (None, None) => (peak, "peak"),
        (Some(boundary), Some(spectrum)) if boundary >= spectrum => (boundary, "damage-boundary"),
        (_, Some(spectrum)) => (spectrum, "spectrum"),
        (Some(boundary), None) => (boundary, "damage-boundary"),
    };
    Some((all, ratio, name))
}

/// The largest stiffness at which the verdict still is `ok` for this rise, or why there is none.
///
/// By the peak alone it is m_eff (a/v)². The other criteria grow with the stiffness too (the peak rises, the pulse
/// shortens, the velocity change stays), so their limit is found by bisection of the verdict's own ratio.
pub(super) fn max_stiffness(
    request: &ShockRequest,
    landing: &Landing,
    rise_m: f64,
    tolerance_m_s2: f64,
) -> (Option<f64>, Option<&'static str>) {
    let (mass_kg, gravity) = (request.mass_kg, request.gravity_m_s2);
    if request.tolerance_duration_s.is_none() && request.tolerance_velocity_change_m_s.is_none() {
        let largest = landing.max_stiffness_n_m(mass_kg, rise_m, gravity, tolerance_m_s2);
        return (Some(largest).filter(|k| k.is_finite()), None);
    }
    let exceeded = |log_k: f64| {
        let Ok(spring) = Cushion::linear(log_k.exp()) else { return false };
        let impact = landing.impact(mass_kg, &spring, rise_m, gravity);
        verdict(request, impact.edge_acceleration_m_s2, Some(&impact)).is_some_and(|(_, ratio, _)| ratio > 1.0)
    };
    // From a feather to a thousand times the stiffest steel column.
    let (mut low, mut high) = (1e-2f64.ln(), 1e14f64.ln());
    if exceeded(low) {
        return (None, Some("no stiffness brings the verdict to ok: the velocity change does not depend on it"));
    }
    if !exceeded(high) {
        return (None, Some("no stiffness takes the verdict beyond ok: the velocity change is below its limit"));
    }
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if exceeded(middle) { high = middle } else { low = middle }
    }
    (Some(low.exp()), None)
}
