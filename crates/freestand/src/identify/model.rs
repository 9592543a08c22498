//! The pulse that a law predicts, calculated fast enough for a fit.

use super::filter::LowPass;

/// Terms of a curve beyond the first: x² to x⁵.
pub(super) const SHAPES: usize = 4;

/// A landing on F = f(d) (1 + Λḋ) + c ḋ, never below zero, as an instrument shows it. f is K dⁿ, or with n = 1
/// the polynomial K D (x + Σ qⱼ (xʲ − x)) in x = d/D, whose secant at D is K for any q.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Model {
    pub(super) mass_kg: f64,
    pub(super) gravity_m_s2: f64,
    pub(super) speed_m_s: f64,
    pub(super) coefficient_n_mn: f64,
    pub(super) exponent: f64,
    pub(super) damping_n_s_m: f64,
    pub(super) dissipation_s_m: f64,
    /// q₂ to q₅, for n = 1.
    pub(super) shape: [f64; SHAPES],
    /// D.
    pub(super) reference_m: f64,
    pub(super) filter: Option<LowPass>,
}

/// Force over mass at equal steps from first contact.
#[derive(Debug, Clone)]
pub(super) struct Predicted {
    step_s: f64,
    accel_m_s2: Vec<f64>,
    /// From first contact to the end of the force.
    pub(super) contact_s: f64,
    /// The largest force over mass before the filter.
    pub(super) force_peak_m_s2: f64,
    /// From first contact to the end of what the instrument shows.
    pub(super) end_s: f64,
    pub(super) compression_m: f64,
    /// Velocity on leaving, positive upward.
    pub(super) rebound_m_s: f64,
}

/// Steps per contact: straight lines between them are wrong by (π/STEPS)²/8 = 8e-6 of the peak.
const STEPS: f64 = 400.0;
/// A mass that has not left after this many steps stays.
const LONGEST: usize = 4000;
/// The response of a filter has died away after this many periods of its corner: e^(−2π · 2 · sin(π/8)) = 0.8 % of
/// what is left at the end of the force, which is nothing but its tail.
const TAIL: f64 = 2.0;

impl Model {
    fn force_n(&self, d: f64, v: f64) -> f64 {
        if d < 0.0 {
            return 0.0;
        }
        (self.elastic_n(d) * (1.0 + self.dissipation_s_m * v) + self.damping_n_s_m * v).max(0.0)
    }

    /// f(d).
    pub(super) fn elastic_n(&self, d: f64) -> f64 {
        if self.exponent != 1.0 {
            return self.coefficient_n_mn * d.powf(self.exponent);
        }
        let x = d / self.reference_m;
        let shape = self.shape.iter().rev().fold(0.0, |sum, q| (sum + q) * x);
        self.coefficient_n_mn * d * (1.0 - self.shape.iter().sum::<f64>() + shape)
    }

    /// df/dd at the origin; `None` where it is infinite.
    pub(super) fn initial_n_m(&self) -> Option<f64> {
        if self.exponent != 1.0 {
            return (self.exponent > 1.0).then_some(0.0);
        }
        Some(self.coefficient_n_mn * (1.0 - self.shape.iter().sum::<f64>()))
    }

    /// k₃ of f = k d + k₃ d³.
    pub(super) fn cubic_n_m3(&self) -> f64 {
        self.coefficient_n_mn * self.shape[1] / (self.reference_m * self.reference_m)
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
            force_peak_m_s2: 0.0,
            end_s: 0.0,
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
        out.force_peak_m_s2 = out.peak_m_s2();
        out.end_s = out.contact_s;
        if let Some(filter) = self.filter {
            out.show(filter);
        }
        out
    }
}

impl Predicted {
    /// Replaces the force by what a filter shows of it.
    fn show(&mut self, filter: LowPass) {
        let tail = (TAIL / (filter.corner_hz * self.step_s)).ceil().min(LONGEST as f64) as usize;
        // The force ends within the next step.
        self.accel_m_s2.resize(self.accel_m_s2.len() + 1 + tail, 0.0);
        filter.apply(&mut self.accel_m_s2, self.step_s);
        self.end_s = (self.accel_m_s2.len() - 1) as f64 * self.step_s;
    }

    pub(super) fn peak_m_s2(&self) -> f64 {
        self.accel_m_s2.iter().copied().fold(0.0, f64::max)
    }

    /// Force over mass, as the instrument shows it, at a time since first contact; zero outside the contact.
    pub(super) fn at(&self, time_s: f64) -> f64 {
        if time_s < 0.0 || time_s >= self.end_s {
            return 0.0;
        }
        let place = time_s / self.step_s;
        let index = place as usize;
        let share = place - index as f64;
        match (self.accel_m_s2.get(index), self.accel_m_s2.get(index + 1)) {
            (Some(a), Some(b)) => a + share * (b - a),
            (Some(a), None) => {
                let left = self.end_s / self.step_s - index as f64;
                if left > 0.0 { a * (1.0 - share / left).max(0.0) } else { 0.0 }
            }
            _ => 0.0,
        }
    }
}
