//! The damage boundary of an object, with the demand of a landing.

use freestand::G0_M_S2;
use freestand::damage_boundary::{DamageBoundary, KNEE_RATIO};
use freestand::impact::Impact;

use super::ShockRequest;
use super::verdict::boundary;
use freestand_output::answer;

/// A damage boundary and a demand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamageBoundaryReport {
    /// `test points` of a file, `tests` as stated, or `component` where it follows from a frequency
    /// and a capacity.
    source: &'static str,
    /// The boundary.
    pub boundary: DamageBoundary,
    /// Velocity change \[m/s\] and peak \[m/s²\].
    pub demand: (f64, f64),
}

answer! {
    /// A damage boundary, with the demand.
    pub struct BoundaryAnswer of (report: &DamageBoundaryReport) {
        source: &'static str => "damage boundary from";
        critical_acceleration_g: f64 =
            report.boundary.acceleration_m_s2() / G0_M_S2 => "  critical acceleration";
        critical_velocity_change_m_s: f64 =
            report.boundary.velocity_change_m_s() => "  critical velocity change";
        /// Beyond the knee, at (π/2) V_c, the critical acceleration alone is the boundary.
        knee_velocity_change_m_s: f64 = KNEE_RATIO * report.boundary.velocity_change_m_s();
        /// min(A/A_c, Δv/V_c).
        demand_ratio: f64 = report.demand_ratio();
    }
}

impl DamageBoundaryReport {
    /// The boundary of a request and the demand; `None` if no boundary is known.
    pub(super) fn new(request: &ShockRequest, edge_m_s2: f64, impact: &Impact) -> Option<Self> {
        let of_component = || {
            let (frequency_hz, capacity) = (
                request.component_frequency_hz?,
                request.component_capacity_m_s2?,
            );
            Some((
                "component",
                DamageBoundary::of_component(frequency_hz, capacity).ok()?,
            ))
        };
        let tests = if request.boundary_tests.is_some() {
            "test points"
        } else {
            "tests"
        };
        let (source, boundary) = boundary(request)
            .map(|one| (tests, one))
            .or_else(of_component)?;
        Some(Self {
            source,
            boundary,
            demand: (impact.velocity_change_m_s, edge_m_s2),
        })
    }

    /// min(A/A_c, Δv/V_c).
    pub fn demand_ratio(&self) -> f64 {
        self.boundary.demand_ratio(self.demand.1, self.demand.0)
    }
}
