//! What an object stands against what it gets: demand over capacity, taken apart so that a softer pad or a model error can be put
//! in afterwards.

use std::sync::OnceLock;

use freestand::G0_M_S2;
use freestand::damage_boundary::DamageBoundary;
use freestand::shock_response::{HalfSine, half_sine_severity_ratio};
use rayon::prelude::*;

use crate::library::Tolerance;
use crate::words::number;

/// What an object stands, by kind of data.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Capacity {
    pub(super) peak_m_s2: Option<f64>,
    pub(super) duration_s: Option<f64>,
    pub(super) boundary: Option<DamageBoundary>,
    pub(super) velocity_change_m_s: Option<f64>,
    pub(super) edge_lift_m: Option<f64>,
    pub(super) decides: bool,
}

/// The half-sine of one landing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Demand {
    pub(super) edge_m_s2: f64,
    pub(super) velocity_change_m_s: f64,
    pub(super) duration_s: f64,
}

/// Demand over capacity in three parts: `max(min(acceleration · f, velocity_change), lift, floor)`, where f is a factor on the
/// shock of the edge.
///
/// The acceleration is that of a peak or a spectrum, or A/A_c of a damage boundary, whose other leg Δv/V_c caps it: neither that nor a
/// lift depends on the stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Terms {
    pub(super) acceleration: f64,
    pub(super) velocity_change: f64,
    pub(super) lift: f64,
    pub(super) floor: f64,
    /// Duration of the pulse \[s\], which a spectrum depends on; 0 where it does not rock.
    pub(super) duration_s: f64,
}

impl Terms {
    pub(super) const OVERTURNED: Self = Self {
        acceleration: f64::INFINITY,
        velocity_change: f64::INFINITY,
        lift: f64::INFINITY,
        floor: f64::INFINITY,
        duration_s: 0.0,
    };

    /// Demand over capacity with a factor on the shock of the edge.
    pub(super) fn ratio(&self, factor: f64) -> f64 {
        if self.lift.is_infinite() {
            return f64::INFINITY;
        }
        (self.acceleration * factor).min(self.velocity_change).max(self.lift).max(self.floor)
    }

    /// The part that governs.
    pub(super) fn governing(&self, capacity: &Capacity) -> &'static str {
        if self.lift.is_infinite() {
            return "overturning";
        }
        let ratio = self.ratio(1.0);
        if ratio == self.floor && self.floor > 0.0 {
            "floor-acceleration"
        } else if ratio == self.lift && self.lift > 0.0 {
            "edge-lift"
        } else {
            capacity.edge_criterion()
        }
    }
}

impl Capacity {
    /// `None`: nothing that a shock could be compared with.
    pub(super) fn new(tolerance: &Tolerance) -> Option<Self> {
        let Tolerance { peak_m_s2, duration_s, velocity_change_m_s, edge_lift_m, .. } = *tolerance;
        let boundary = peak_m_s2.zip(velocity_change_m_s).and_then(|(a, v)| DamageBoundary::new(a, v).ok());
        (peak_m_s2.is_some() || edge_lift_m.is_some() || velocity_change_m_s.is_some()).then(|| Self {
            peak_m_s2,
            duration_s,
            boundary,
            velocity_change_m_s,
            edge_lift_m,
            decides: tolerance.confidence.decides(),
        })
    }

    /// The criterion of the shock of the edge.
    pub(super) fn edge_criterion(&self) -> &'static str {
        match (self.boundary.is_some(), self.duration_s.is_some(), self.peak_m_s2.is_some()) {
            (true, _, _) => "damage-boundary",
            (false, true, true) => "spectrum",
            (false, _, true) => "peak",
            (false, _, false) if self.velocity_change_m_s.is_some() => "velocity-change",
            _ => "edge-lift",
        }
    }

    /// Whether the shock of the edge has to be known.
    pub(super) fn needs_shock(&self) -> bool {
        self.peak_m_s2.is_some() || self.velocity_change_m_s.is_some()
    }

    /// The parts of demand over capacity; `None` where a shock is needed and not known. An object that never leaves the floor has
    /// none: it asks only whether the floor's own acceleration is stood.
    pub(super) fn terms(
        &self,
        demand: Option<Demand>,
        is_at_rest: bool,
        uplift_m: f64,
        floor_m_s2: f64,
        severity_ratio: impl Fn(f64) -> f64,
    ) -> Option<Terms> {
        let lift = self.edge_lift_m.map_or(0.0, |survived_m| uplift_m / survived_m);
        let floor = self.peak_m_s2.map_or(0.0, |peak| floor_m_s2 / peak);
        let still = Terms { acceleration: 0.0, velocity_change: f64::INFINITY, lift, floor, duration_s: 0.0 };
        if is_at_rest || !self.needs_shock() {
            return Some(still);
        }
        let demand = demand?;
        let change = self.velocity_change_m_s.map(|limit| demand.velocity_change_m_s / limit);
        // A boundary and a survived pulse: both must be exceeded for the one, the spectrum decides for the other.
        let (acceleration, velocity_change) = match (self.peak_m_s2, self.duration_s, change) {
            (Some(peak), _, Some(change)) => (demand.edge_m_s2 / peak, change),
            (Some(peak), Some(_), None) => (demand.edge_m_s2 / peak * severity_ratio(demand.duration_s), f64::INFINITY),
            (Some(peak), None, None) => (demand.edge_m_s2 / peak, f64::INFINITY),
            (None, _, Some(change)) => (f64::INFINITY, change),
            (None, _, None) => return Some(still),
        };
        Some(Terms { acceleration, velocity_change, lift, floor, duration_s: demand.duration_s })
    }

    /// Severity of a pulse of a duration over the survived one at the same peak; 1 where no duration is known.
    pub(super) fn severity_ratio(&self, duration_s: f64) -> f64 {
        match self.duration_s {
            Some(survived_s) if self.boundary.is_none() && duration_s > 0.0 => severity_ratio(duration_s / survived_s),
            _ => 1.0,
        }
    }

    /// In words: `5 g, 11 ms half-sine`.
    pub(super) fn words(&self) -> String {
        let mut words: Vec<String> = Vec::new();
        words.extend(self.peak_m_s2.map(|peak| format!("{} g", number(peak / G0_M_S2, 4))));
        words.extend(self.duration_s.map(|s| format!("{} ms half-sine", number(1e3 * s, 4))));
        words.extend(self.velocity_change_m_s.map(|v| format!("{} m/s", number(v, 4))));
        words.extend(self.edge_lift_m.map(|m| format!("edge lift {} mm", number(1e3 * m, 4))));
        words.join(", ")
    }
}

/// Ends of the table of severities, in ln of the ratio of durations.
const TABLE_END: f64 = 7.0;

/// Steps of the table between −[`TABLE_END`] and [`TABLE_END`].
const TABLE_STEPS: usize = 1400;

/// The largest ratio of the two shock response spectra of half-sines of equal peak, by the ratio of their durations.
///
/// # Accuracy
/// Interpolated between exact values 1 % apart in duration: within 1e-3, which is far below the spread of a stiffness. Outside
/// e^±7 the exact one.
pub(super) fn severity_ratio(durations_ratio: f64) -> f64 {
    static TABLE: OnceLock<Vec<f64>> = OnceLock::new();
    let exact = |log_ratio: f64| {
        let demand = HalfSine { peak_acceleration: 1.0, duration_s: log_ratio.exp() };
        half_sine_severity_ratio(demand, HalfSine { peak_acceleration: 1.0, duration_s: 1.0 })
    };
    let width = 2.0 * TABLE_END / TABLE_STEPS as f64;
    let log_ratio = durations_ratio.ln();
    let place = (log_ratio + TABLE_END) / width;
    if !(place >= 0.0 && place < TABLE_STEPS as f64) {
        return exact(log_ratio);
    }
    let table =
        TABLE.get_or_init(|| (0..=TABLE_STEPS).into_par_iter().map(|i| exact(-TABLE_END + width * i as f64)).collect());
    let (below, share) = (place.floor() as usize, place.fract());
    table[below] + share * (table[below + 1] - table[below])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::library::Confidence;

    fn tolerance(peak_g: Option<f64>, duration_s: Option<f64>, change: Option<f64>, lift: Option<f64>) -> Tolerance {
        Tolerance {
            peak_m_s2: peak_g.map(|g| g * G0_M_S2),
            duration_s,
            velocity_change_m_s: change,
            edge_lift_m: lift,
            source: "a test".to_owned(),
            confidence: Confidence::Stated,
        }
    }

    fn ratio(tolerance: &Tolerance, edge_g: f64, change: f64, duration_s: f64, lift_m: f64) -> (f64, &'static str) {
        let capacity = Capacity::new(tolerance).unwrap();
        let demand = Demand { edge_m_s2: edge_g * G0_M_S2, velocity_change_m_s: change, duration_s };
        let severity = |duration_s: f64| capacity.severity_ratio(duration_s);
        let terms = capacity.terms(Some(demand), false, lift_m, 0.3 * G0_M_S2, severity).unwrap();
        (terms.ratio(1.0), terms.governing(&capacity))
    }

    /// SHOCK.md 3d: the paper's cabinet (4.1 g, 17.8 ms, 0.5 m/s) passes a disk of 70 g, 0.874 m/s and fails a card of 5 g, 0.343 m/s on
    /// both legs when it has 6 g.
    #[test]
    fn a_boundary_is_an_and() {
        let disk = tolerance(Some(70.0), None, Some(0.874), None);
        assert_eq!(ratio(&disk, 4.1, 0.5, 0.0178, 0.0), (4.1 / 70.0, "damage-boundary"));
        let card = tolerance(Some(5.0), None, Some(0.343), None);
        let (both, name) = ratio(&card, 6.0, 0.7, 0.0178, 0.0);
        assert!((both - 1.2).abs() < 1e-12 && name == "damage-boundary");
        assert!((ratio(&card, 60.0, 0.2, 0.0178, 0.0).0 - 0.2 / 0.343).abs() < 1e-12);
    }

    #[test]
    fn alternatives_by_kind_of_data() {
        assert_eq!(ratio(&tolerance(Some(5.0), None, None, None), 10.0, 1.0, 0.01, 0.02).0, 2.0);
        // The same pulse as the one that was survived; the table is exact at its node ln 1 = 0.
        let (same, name) = ratio(&tolerance(Some(10.0), Some(0.011), None, None), 10.0, 1.0, 0.011, 0.02);
        assert!((same - 1.0).abs() < 1e-9 && name == "spectrum", "{same} {name}");
        assert_eq!(ratio(&tolerance(None, None, None, Some(0.05)), 10.0, 1.0, 0.01, 0.1), (2.0, "edge-lift"));
        // A floor of 0.3 g on an object that stands 0.2 g.
        let (floor, name) = ratio(&tolerance(Some(0.2), None, None, None), 0.1, 0.01, 0.01, 0.0);
        assert!((floor - 1.5).abs() < 1e-12 && name == "floor-acceleration");
        assert_eq!(Capacity::new(&tolerance(None, Some(0.011), None, None)), None);
    }

    /// Interpolated against exact, between the nodes and at the kinks of the curve: the bound that is stated.
    #[test]
    fn the_table_of_severities_is_within_its_bound() {
        for i in 0..200 {
            let log_ratio = -4.0 + 0.04 * f64::from(i) + 0.0049;
            let demand = HalfSine { peak_acceleration: 1.0, duration_s: f64::exp(log_ratio) };
            let exact = half_sine_severity_ratio(demand, HalfSine { peak_acceleration: 1.0, duration_s: 1.0 });
            let got = severity_ratio(log_ratio.exp());
            assert!((got / exact - 1.0).abs() < 1e-3, "{log_ratio}: {got} {exact}");
        }
    }

    #[test]
    fn a_fall_is_beyond_every_number() {
        assert_eq!(Terms::OVERTURNED.ratio(1e-9), f64::INFINITY);
        let capacity = Capacity::new(&tolerance(Some(5.0), None, None, None)).unwrap();
        assert_eq!(Terms::OVERTURNED.governing(&capacity), "overturning");
    }
}
