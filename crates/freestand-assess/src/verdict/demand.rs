//! Demand over capacity, in its parts.

use std::sync::OnceLock;

use freestand::shock_response::{HalfSine, half_sine_severity_ratio};
use rayon::prelude::*;

use crate::capacity::Capacity;
use crate::result::Criterion;
use freestand_inventory::library::Tolerance;
use serde::{Deserialize, Serialize};

/// The half-sine of one landing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Demand {
    pub(super) edge_m_s2: f64,
    pub(super) velocity_change_m_s: f64,
    pub(super) duration_s: f64,
}

/// Demand over capacity in its parts: `max(min(acceleration, velocity_change), spectrum, lift,
/// floor)`.
///
/// The acceleration is that of a peak, or A/A_c of a damage boundary, whose other leg Δv/V_c caps
/// it. The spectrum is that of the pulse that the object withstands.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Terms {
    pub(super) acceleration: f64,
    pub(super) velocity_change: f64,
    pub(super) spectrum: f64,
    pub(super) lift: f64,
    pub(super) floor: f64,
}

impl Terms {
    pub(super) const OVERTURNED: Self = Self {
        acceleration: f64::INFINITY,
        velocity_change: f64::INFINITY,
        spectrum: f64::INFINITY,
        lift: f64::INFINITY,
        floor: f64::INFINITY,
    };

    /// Demand over capacity.
    pub(super) fn ratio(&self) -> f64 {
        if self.lift.is_infinite() {
            return f64::INFINITY;
        }
        self.edge()
            .max(self.spectrum)
            .max(self.lift)
            .max(self.floor)
    }

    /// The part of a peak or a damage boundary.
    fn edge(&self) -> f64 {
        self.acceleration.min(self.velocity_change)
    }

    /// The part that governs.
    pub(super) fn governing(&self, capacity: &Capacity) -> Criterion {
        if self.lift.is_infinite() {
            return Criterion::Overturning;
        }
        let parts = [
            (self.edge(), capacity.edge_criterion()),
            (self.spectrum, Criterion::Spectrum),
            (self.lift, Criterion::EdgeLift),
            (self.floor, Criterion::FloorAcceleration),
        ];
        let largest = parts
            .into_iter()
            .reduce(|most, next| if next.0 > most.0 { next } else { most });
        largest.map_or(capacity.edge_criterion(), |(_, criterion)| criterion)
    }
}

impl Capacity {
    /// `None`: the tolerance has no number that a shock can be compared with.
    pub(super) fn new(tolerance: &Tolerance) -> Option<Self> {
        let Tolerance {
            peak_m_s2,
            duration_s,
            velocity_change_m_s,
            edge_lift_m,
            ..
        } = *tolerance;
        (peak_m_s2.is_some() || edge_lift_m.is_some() || velocity_change_m_s.is_some()).then(|| {
            Self {
                peak_m_s2,
                duration_s,
                velocity_change_m_s,
                edge_lift_m,
                decides: tolerance.confidence.decides(),
            }
        })
    }

    /// The criterion of the shock of the edge.
    pub(super) fn edge_criterion(&self) -> Criterion {
        match (self.peak_m_s2, self.velocity_change_m_s, self.duration_s) {
            (Some(_), Some(_), _) => Criterion::DamageBoundary,
            (Some(_), None, Some(_)) => Criterion::Spectrum,
            (Some(_), None, None) => Criterion::Peak,
            (None, Some(_), _) => Criterion::VelocityChange,
            (None, None, _) => Criterion::EdgeLift,
        }
    }

    /// Whether a comparison needs the shock of the edge.
    pub(super) fn needs_shock(&self) -> bool {
        self.peak_m_s2.is_some() || self.velocity_change_m_s.is_some()
    }

    /// The parts of demand over capacity; `None` where a shock is needed and not known. An object
    /// at rest has no shock: only the acceleration of the floor itself is compared.
    pub(super) fn terms(
        &self,
        demand: Option<Demand>,
        is_at_rest: bool,
        uplift_m: f64,
        floor_m_s2: f64,
        severity_ratio: impl Fn(f64) -> f64,
    ) -> Option<Terms> {
        let lift = self
            .edge_lift_m
            .map_or(0.0, |survived_m| uplift_m / survived_m);
        let floor = self.peak_m_s2.map_or(0.0, |peak| floor_m_s2 / peak);
        let still = Terms {
            acceleration: 0.0,
            velocity_change: f64::INFINITY,
            spectrum: 0.0,
            lift,
            floor,
        };
        if is_at_rest || !self.needs_shock() {
            return Some(still);
        }
        let demand = demand?;
        let change = self
            .velocity_change_m_s
            .map(|limit| demand.velocity_change_m_s / limit);
        let peak = self.peak_m_s2.map(|peak| demand.edge_m_s2 / peak);
        // A peak that belongs to a damage boundary or a pulse is not a criterion by itself.
        let (acceleration, velocity_change) = match (peak, self.duration_s, change) {
            (Some(peak), _, Some(change)) => (peak, change),
            (Some(_), Some(_), None) | (None, _, None) => (0.0, f64::INFINITY),
            (Some(peak), None, None) => (peak, f64::INFINITY),
            (None, _, Some(change)) => (f64::INFINITY, change),
        };
        let survived = peak.zip(self.duration_s);
        let spectrum = survived.map_or(0.0, |(peak, _)| peak * severity_ratio(demand.duration_s));
        Some(Terms {
            acceleration,
            velocity_change,
            spectrum,
            lift,
            floor,
        })
    }

    /// Severity of a pulse of this duration over the tolerated pulse at the same peak; 1 where that
    /// has no duration.
    pub(super) fn severity_ratio(&self, duration_s: f64) -> f64 {
        match self.duration_s {
            Some(survived_s) if duration_s > 0.0 => severity_ratio(duration_s / survived_s),
            _ => 1.0,
        }
    }
}

/// End of the table of severities, as ln of the ratio of durations.
const TABLE_END: f64 = 7.0;

/// Steps of the table between −[`TABLE_END`] and [`TABLE_END`].
const TABLE_STEPS: usize = 2800;

/// The largest ratio of the two shock response spectra of half-sines of equal peak, by the ratio of
/// their durations.
///
/// # Accuracy
/// Interpolated between exact values 0.5 % apart in duration: within 1e-3, which is reached at the
/// kinks of the curve and is far below the spread of a stiffness. Exact outside e^±7.
pub(super) fn severity_ratio(durations_ratio: f64) -> f64 {
    static TABLE: OnceLock<Vec<f64>> = OnceLock::new();
    let exact = |log_ratio: f64| {
        let demand = HalfSine {
            peak_acceleration: 1.0,
            duration_s: log_ratio.exp(),
        };
        half_sine_severity_ratio(
            demand,
            HalfSine {
                peak_acceleration: 1.0,
                duration_s: 1.0,
            },
        )
    };
    let width = 2.0 * TABLE_END / TABLE_STEPS as f64;
    let log_ratio = durations_ratio.ln();
    let place = (log_ratio + TABLE_END) / width;
    if !(place >= 0.0 && place < TABLE_STEPS as f64) {
        return exact(log_ratio);
    }
    let table = TABLE.get_or_init(|| {
        (0..=TABLE_STEPS)
            .into_par_iter()
            .map(|i| exact(-TABLE_END + width * i as f64))
            .collect()
    });
    let (below, share) = (place.floor() as usize, place.fract());
    table[below] + share * (table[below + 1] - table[below])
}

#[cfg(test)]
mod tests {
    use freestand::G0_M_S2;

    use super::*;
    use freestand_inventory::library::Confidence;

    fn tolerance(
        peak_g: Option<f64>,
        duration_s: Option<f64>,
        change: Option<f64>,
        lift: Option<f64>,
    ) -> Tolerance {
        Tolerance {
            peak_m_s2: peak_g.map(|g| g * G0_M_S2),
            duration_s,
            velocity_change_m_s: change,
            edge_lift_m: lift,
            source: "a test".to_owned(),
            confidence: Confidence::Stated,
        }
    }

    fn ratio(
        tolerance: &Tolerance,
        edge_g: f64,
        change: f64,
        duration_s: f64,
        lift_m: f64,
    ) -> (f64, Criterion) {
        let capacity = Capacity::new(tolerance).unwrap();
        let demand = Demand {
            edge_m_s2: edge_g * G0_M_S2,
            velocity_change_m_s: change,
            duration_s,
        };
        let severity = |duration_s: f64| capacity.severity_ratio(duration_s);
        let terms = capacity
            .terms(Some(demand), false, lift_m, 0.3 * G0_M_S2, severity)
            .unwrap();
        (terms.ratio(), terms.governing(&capacity))
    }

    /// The shock of the paper's cabinet (4.1 g, 17.8 ms, 0.5 m/s) is within the boundary of a disk
    /// (70 g, 0.874 m/s); one of 6 g exceeds both legs of the boundary of a card (5 g, 0.343 m/s).
    #[test]
    fn a_boundary_is_an_and() {
        let disk = tolerance(Some(70.0), None, Some(0.874), None);
        assert_eq!(
            ratio(&disk, 4.1, 0.5, 0.0178, 0.0),
            (4.1 / 70.0, Criterion::DamageBoundary)
        );
        let card = tolerance(Some(5.0), None, Some(0.343), None);
        let (both, name) = ratio(&card, 6.0, 0.7, 0.0178, 0.0);
        assert!((both - 1.2).abs() < 1e-12 && name == Criterion::DamageBoundary);
        assert!((ratio(&card, 60.0, 0.2, 0.0178, 0.0).0 - 0.2 / 0.343).abs() < 1e-12);
    }

    /// 4.5 g of 5 g and 0.5 m/s of 1 m/s are within the boundary, but a pulse of 17.8 ms is more
    /// severe than one of 11 ms.
    #[test]
    fn a_boundary_does_not_hide_a_tolerated_pulse() {
        let both = tolerance(Some(5.0), Some(0.011), Some(1.0), None);
        let (most, name) = ratio(&both, 4.5, 0.5, 0.0178, 0.0);
        assert!(most > 0.9 && name == Criterion::Spectrum, "{most} {name:?}");
        let pulse = tolerance(Some(5.0), Some(0.011), None, None);
        assert_eq!(ratio(&pulse, 4.5, 0.5, 0.0178, 0.0).0, most);
    }

    #[test]
    fn alternatives_by_kind_of_data() {
        assert_eq!(
            ratio(
                &tolerance(Some(5.0), None, None, None),
                10.0,
                1.0,
                0.01,
                0.02
            )
            .0,
            2.0
        );
        // The tolerated pulse itself; the table is exact at its node ln 1 = 0.
        let (same, name) = ratio(
            &tolerance(Some(10.0), Some(0.011), None, None),
            10.0,
            1.0,
            0.011,
            0.02,
        );
        assert!(
            (same - 1.0).abs() < 1e-9 && name == Criterion::Spectrum,
            "{same} {name:?}"
        );
        assert_eq!(
            ratio(
                &tolerance(None, None, None, Some(0.05)),
                10.0,
                1.0,
                0.01,
                0.1
            ),
            (2.0, Criterion::EdgeLift)
        );
        // A floor motion of 0.3 g under an object that withstands 0.2 g.
        let (floor, name) = ratio(
            &tolerance(Some(0.2), None, None, None),
            0.1,
            0.01,
            0.01,
            0.0,
        );
        assert!((floor - 1.5).abs() < 1e-12 && name == Criterion::FloorAcceleration);
        assert_eq!(
            Capacity::new(&tolerance(None, Some(0.011), None, None)),
            None
        );
    }

    /// Interpolated and exact values, between the nodes and at the kinks of the curve, differ by
    /// less than the bound.
    #[test]
    fn the_table_of_severities_is_within_its_bound() {
        for i in 0..200 {
            let log_ratio = -4.0 + 0.04 * f64::from(i) + 0.0049;
            let demand = HalfSine {
                peak_acceleration: 1.0,
                duration_s: f64::exp(log_ratio),
            };
            let exact = half_sine_severity_ratio(
                demand,
                HalfSine {
                    peak_acceleration: 1.0,
                    duration_s: 1.0,
                },
            );
            let got = severity_ratio(log_ratio.exp());
            assert!(
                (got / exact - 1.0).abs() < 1e-3,
                "{log_ratio}: {got} {exact}"
            );
        }
    }

    #[test]
    fn a_fall_is_beyond_every_number() {
        assert_eq!(Terms::OVERTURNED.ratio(), f64::INFINITY);
        let capacity = Capacity::new(&tolerance(Some(5.0), None, None, None)).unwrap();
        assert_eq!(
            Terms::OVERTURNED.governing(&capacity),
            Criterion::Overturning
        );
    }
}
