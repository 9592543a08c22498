//! The pulse that a law predicts, calculated fast enough for a fit.

/// A landing on F = K dⁿ (1 + Λḋ) + c ḋ, never below zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Model {
    pub(super) mass_kg: f64,
    pub(super) gravity_m_s2: f64,
    pub(super) speed_m_s: f64,
    pub(super) coefficient_n_mn: f64,
    pub(super) exponent: f64,
    pub(super) damping_n_s_m: f64,
    pub(super) dissipation_s_m: f64,
}

/// Force over mass at equal steps from first contact.
#[derive(Debug, Clone)]
pub(super) struct Predicted {
    step_s: f64,
    accel_m_s2: Vec<f64>,
    /// From first contact to the end of the force.
    pub(super) contact_s: f64,
    pub(super) compression_m: f64,
    /// Velocity on leaving, positive upward.
    pub(super) rebound_m_s: f64,
}

/// Steps per contact: straight lines between them are wrong by (π/STEPS)²/8 = 8e-6 of the peak.
const STEPS: f64 = 400.0;
/// A mass that has not left after this many steps stays.
const LONGEST: usize = 4000;

impl Model {
    fn force_n(&self, d: f64, v: f64) -> f64 {
        if d < 0.0 {
            return 0.0;
        }
        let elastic = self.coefficient_n_mn * if self.exponent == 1.0 { d } else { d.powf(self.exponent) };
        (elastic * (1.0 + self.dissipation_s_m * v) + self.damping_n_s_m * v).max(0.0)
    }

    /// Approximate contact time: that of the undamped power law, Cₙ ≈ 3.
    fn scale_s(&self) -> f64 {
        let n = self.exponent;
        let energy = 0.5 * (n + 1.0) * self.mass_kg * self.speed_m_s.powi(2) / self.coefficient_n_mn;
        3.0 * energy.powf(1.0 / (n + 1.0)) / self.speed_m_s
    }

    /// Classical Runge–Kutta.
    pub(super) fn predict(&self) -> Predicted {
        let step_s = self.scale_s() / STEPS;
        let (m, g, h) = (self.mass_kg, self.gravity_m_s2, step_s);
        let rate = |d: f64, v: f64| g - self.force_n(d, v) / m;
        let (mut d, mut v) = (0.0, self.speed_m_s);
        let mut out = Predicted {
            step_s,
            accel_m_s2: vec![self.force_n(d, v) / m],
            contact_s: 0.0,
            compression_m: 0.0,
            rebound_m_s: 0.0,
        };
        if !(step_s > 0.0 && step_s.is_finite()) {
            return out;
        }
        let mut last = out.accel_m_s2[0];
        let mut fall = 0.0;
        for _ in 0..LONGEST {
            let a1 = rate(d, v);
            let (v2, a2) = (v + 0.5 * h * a1, rate(d + 0.5 * h * v, v + 0.5 * h * a1));
            let (v3, a3) = (v + 0.5 * h * a2, rate(d + 0.5 * h * v2, v + 0.5 * h * a2));
            let (v4, a4) = (v + h * a3, rate(d + h * v3, v + h * a3));
            d += h / 6.0 * (v + 2.0 * (v2 + v3) + v4);
            v += h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
            let accel = self.force_n(d, v) / m;
            out.compression_m = out.compression_m.max(d);
            if v < 0.0 && accel == 0.0 {
                break;
            }
            fall = last - accel;
            last = accel;
            out.accel_m_s2.push(accel);
        }
        // The last force continues to fall at the same rate.
        let share = if fall > 0.0 { (last / fall).min(1.0) } else { 1.0 };
        out.contact_s = ((out.accel_m_s2.len() - 1) as f64 + share) * h;
        out.rebound_m_s = -v;
        out
    }
}

impl Predicted {
    pub(super) fn peak_m_s2(&self) -> f64 {
        self.accel_m_s2.iter().copied().fold(0.0, f64::max)
    }

    /// Force over mass at a time since first contact; zero outside the contact.
    pub(super) fn at(&self, time_s: f64) -> f64 {
        if time_s < 0.0 || time_s >= self.contact_s {
            return 0.0;
        }
        let place = time_s / self.step_s;
        let index = place as usize;
        let share = place - index as f64;
        match (self.accel_m_s2.get(index), self.accel_m_s2.get(index + 1)) {
            (Some(a), Some(b)) => a + share * (b - a),
            (Some(a), None) => {
                let left = self.contact_s / self.step_s - index as f64;
                if left > 0.0 { a * (1.0 - share / left).max(0.0) } else { 0.0 }
            }
            _ => 0.0,
        }
    }
}
