//! Demand/capacity of one landing, by every kind of tolerance that is known of the object.

use freestand::cushion::Cushion;
use freestand::damage_boundary::{DamageBoundary, half_sine_duration_s};
use freestand::impact::{Impact, Landing};
use freestand::shock_response::{
    HalfSine, Peak, Pulse, PulseShape, ResponseKind, half_sine_severity_ratio, pulse_spectrum,
};
use freestand_output::answer;

use super::ShockRequest;
use super::doubt::NoLargestStiffness;

answer! {
    /// Demand divided by capacity, by each kind of tolerance that is known.
    pub struct DemandCapacity {
        /// A/A_c.
        peak: Option<f64>,
        /// Δv/V_c.
        velocity_change: Option<f64>,
        /// min(A/A_c, Δv/V_c): only a shock that exceeds both is beyond the damage boundary.
        damage_boundary: Option<f64>,
        /// The largest ratio of the two shock response spectra over frequency.
        spectrum: Option<f64>,
        /// The response of the component over the acceleration that it withstands.
        component: Option<f64>,
        /// The uplift over the one that the object survived.
        edge_lift: Option<f64>,
    }
}

impl DemandCapacity {
    /// The largest of those that apply, and its name. A peak that is part of a boundary or of a
    /// pulse does not apply on its own.
    fn governing(&self) -> Option<(f64, &'static str)> {
        let is_part = self.damage_boundary.is_some() || self.spectrum.is_some();
        let kinds = [
            (self.peak.filter(|_| !is_part), "peak"),
            (self.damage_boundary, "damage-boundary"),
            (self.spectrum, "spectrum"),
            (self.component, "component"),
            (self.edge_lift, "edge-lift"),
        ];
        let known = kinds
            .into_iter()
            .filter_map(|(ratio, name)| Some((ratio?, name)));
        known.reduce(|most, next| if next.0 > most.0 { next } else { most })
    }
}

/// All kinds, with the one that governs.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Compared {
    pub(super) demand_capacity: DemandCapacity,
    pub(super) ratio: f64,
    pub(super) governing: &'static str,
}

/// Damping of a component: Q = 10.
const COMPONENT_DAMPING_RATIO: f64 = freestand::oscillator::DAMPING_RATIO;

/// The response of a component of this frequency to the half-sine of the same peak and velocity
/// change \[m/s²\].
fn component_m_s2(frequency_hz: f64, edge_m_s2: f64, velocity_change_m_s: f64) -> Option<f64> {
    let duration_s = half_sine_duration_s(edge_m_s2, velocity_change_m_s);
    // With a hundred periods or more in the pulse the response is the pulse, to 3e-5.
    let frequency_hz = frequency_hz.min(100.0 / duration_s);
    let pulse = Pulse::new(PulseShape::HalfSine, edge_m_s2, duration_s).ok()?;
    let kind = ResponseKind::AbsoluteAcceleration;
    let spectrum = pulse_spectrum(&pulse, &[frequency_hz], kind, COMPONENT_DAMPING_RATIO).ok()?;
    Some(spectrum.peaks.first()?.peak(Peak::Maximax))
}

/// The damage boundary of tests, A_c and V_c; `None` where it is not known.
pub(super) fn boundary(request: &ShockRequest) -> Option<DamageBoundary> {
    DamageBoundary::new(
        request.tolerance_m_s2?,
        request.tolerance_velocity_change_m_s?,
    )
    .ok()
}

/// Compares the landing with every kind of tolerance; `None`: there is nothing to compare.
///
/// A velocity change makes the peak part of a damage boundary, a duration makes it part of a
/// spectrum; without both it is a kind of its own. An uplift is compared without any impact model.
pub(super) fn compared(
    request: &ShockRequest,
    edge_m_s2: f64,
    uplift_m: Option<f64>,
    impact: Option<&Impact>,
) -> Option<Compared> {
    let peak = request
        .tolerance_m_s2
        .map(|tolerance| edge_m_s2 / tolerance);
    let velocity_change = request
        .tolerance_velocity_change_m_s
        .zip(impact)
        .map(|(limit, impact)| impact.velocity_change_m_s / limit);
    let damage_boundary = boundary(request)
        .zip(impact)
        .map(|(one, impact)| one.demand_ratio(edge_m_s2, impact.velocity_change_m_s));
    let survived = request.tolerance_m_s2.zip(request.tolerance_duration_s);
    let spectrum = survived
        .zip(impact)
        .map(|((peak_acceleration, duration_s), impact)| {
            // The half-sine of the same peak and velocity change: on a spring it is the pulse itself.
            let demand_s = half_sine_duration_s(edge_m_s2, impact.velocity_change_m_s);
            half_sine_severity_ratio(
                HalfSine {
                    peak_acceleration: edge_m_s2,
                    duration_s: demand_s,
                },
                HalfSine {
                    peak_acceleration,
                    duration_s,
                },
            )
        });
    let component = request
        .component_frequency_hz
        .zip(request.component_capacity_m_s2)
        .zip(impact);
    let component = component.and_then(|((frequency_hz, capacity_m_s2), impact)| {
        Some(component_m_s2(frequency_hz, edge_m_s2, impact.velocity_change_m_s)? / capacity_m_s2)
    });
    let edge_lift = request
        .tolerance_edge_lift_m
        .zip(uplift_m)
        .map(|(survived_m, uplift_m)| uplift_m / survived_m);
    let demand_capacity = DemandCapacity {
        peak,
        velocity_change,
        damage_boundary,
        spectrum,
        component,
        edge_lift,
    };
    demand_capacity
        .governing()
        .map(|(ratio, governing)| Compared {
            demand_capacity,
            ratio,
            governing,
        })
}

/// The largest stiffness at which the verdict is still `ok` for this rise, or why there is none.
///
/// By the peak alone it is m_eff (a/v)². The other criteria grow with the stiffness too (the peak
/// rises, the pulse shortens, the velocity change stays), so bisection of demand/capacity finds
/// their limit. An uplift does not depend on the stiffness, and a component may respond less to a
/// shorter pulse: its limit is the first one from below.
pub(super) fn max_stiffness(
    request: &ShockRequest,
    landing: &Landing,
    rise_m: f64,
    uplift_m: Option<f64>,
) -> Result<Option<f64>, NoLargestStiffness> {
    let (mass_kg, gravity) = (request.mass_kg, request.gravity_m_s2);
    let others = [
        request.tolerance_duration_s,
        request.tolerance_velocity_change_m_s,
        request.component_frequency_hz,
        request.tolerance_edge_lift_m,
    ];
    if let (Some(tolerance_m_s2), true) =
        (request.tolerance_m_s2, others.iter().all(Option::is_none))
    {
        let largest = landing.max_stiffness_n_m(mass_kg, rise_m, gravity, tolerance_m_s2);
        return Ok(Some(largest).filter(|k| k.is_finite()));
    }
    if others.iter().all(Option::is_none) {
        return Ok(None);
    }
    let exceeded = |log_k: f64| {
        let Ok(spring) = Cushion::linear(log_k.exp()) else {
            return false;
        };
        let impact = landing.impact(mass_kg, &spring, rise_m, gravity);
        compared(
            request,
            impact.edge_acceleration_m_s2,
            uplift_m,
            Some(&impact),
        )
        .is_some_and(|found| found.ratio > 1.0)
    };
    // From far below any pad to a thousand times the stiffest steel column.
    let (mut low, mut high) = (1e-2f64.ln(), 1e14f64.ln());
    if exceeded(low) {
        let lift = request
            .tolerance_edge_lift_m
            .zip(uplift_m)
            .is_some_and(|(survived_m, lift_m)| lift_m > survived_m);
        return Err(if lift {
            NoLargestStiffness::UpliftTooLarge
        } else {
            NoLargestStiffness::VelocityChangeTooLarge
        });
    }
    // The first stiffness at which a tolerance is exceeded, in steps of a factor of 1.3: no peak of
    // a response curve is narrower.
    let steps = 128;
    let grid = |i: usize| low + (high - low) * i as f64 / f64::from(steps);
    let Some(first) = (1..=steps as usize).find(|&i| exceeded(grid(i))) else {
        return Err(if request.tolerance_velocity_change_m_s.is_some() {
            NoLargestStiffness::VelocityChangeSmall
        } else {
            NoLargestStiffness::AnyWillDo
        });
    };
    (low, high) = (grid(first - 1), grid(first));
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if exceeded(middle) {
            high = middle
        } else {
            low = middle
        }
    }
    Ok(Some(low.exp()))
}
