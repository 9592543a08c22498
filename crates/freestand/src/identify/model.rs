//! The pulse that a law predicts, calculated fast enough for a fit.

use super::filter::LowPass;
use std::cmp::Ordering;

/// Pieces of a curve without a formula.
pub(super) const PIECES: usize = 24;

/// The elastic force f(d) of a pad.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "a few live at a time, and a copy is cheaper than an allocation in every step"
)]
pub(super) enum Elastic {
    /// K dⁿ.
    Power {
        coefficient_n_mn: f64,
        exponent: f64,
    },
    /// k d + k₃ d³.
    Cubic { initial_n_m: f64, cubic_n_m3: f64 },
    /// The tangent stiffness at equal distances, linear between them and constant after the last, and the force there.
    Curve {
        step_m: f64,
        tangents_n_m: [f64; PIECES + 1],
        forces_n: [f64; PIECES + 1],
    },
}

impl Elastic {
    /// A curve whose tangents have these ratios, and whose secant at its last point is `secant_n_m`.
    pub(super) fn curve(secant_n_m: f64, depth_m: f64, ratios: &[f64; PIECES + 1]) -> Self {
        let step_m = depth_m / PIECES as f64;
        let means = ratios.windows(2).map(|pair| 0.5 * pair.iter().sum::<f64>());
        let scale = secant_n_m * PIECES as f64 / means.clone().sum::<f64>();
        let mut forces_n = [0.0; PIECES + 1];
        let mut sum = 0.0;
        for (force_n, mean) in forces_n.iter_mut().skip(1).zip(means) {
            sum += scale * mean * step_m;
            *force_n = sum;
        }
        Self::Curve {
            step_m,
            tangents_n_m: ratios.map(|ratio| scale * ratio),
            forces_n,
        }
    }

    fn force_n(&self, d: f64) -> f64 {
        match self {
            Self::Power {
                coefficient_n_mn,
                exponent: 1.0,
            } => coefficient_n_mn * d,
            Self::Power {
                coefficient_n_mn,
                exponent,
            } => coefficient_n_mn * d.powf(*exponent),
            Self::Cubic {
                initial_n_m,
                cubic_n_m3,
            } => d * (initial_n_m + cubic_n_m3 * d * d),
            Self::Curve {
                step_m,
                tangents_n_m,
                forces_n,
            } => {
                let piece = ((d / step_m) as usize).min(PIECES);
                let into = d - piece as f64 * step_m;
                let [tangent, next] = [piece, (piece + 1).min(PIECES)].map(|i| tangents_n_m[i]);
                forces_n[piece] + into * (tangent + 0.5 * (next - tangent) * into / step_m)
            }
        }
    }
}

/// A landing on F = f(d) (1 + Λḋ) + c ḋ, never below zero, as an instrument shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Model {
    pub(super) mass_kg: f64,
    pub(super) gravity_m_s2: f64,
    pub(super) speed_m_s: f64,
    pub(super) elastic: Elastic,
    pub(super) damping_n_s_m: f64,
    pub(super) dissipation_s_m: f64,
    /// About the largest compression.
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
        self.elastic.force_n(d)
    }

    /// n of a power law; 1 of every other one.
    pub(super) fn exponent(&self) -> f64 {
        match self.elastic {
            Elastic::Power { exponent, .. } => exponent,
            Elastic::Cubic { .. } | Elastic::Curve { .. } => 1.0,
        }
    }

    /// df/dd at the origin; `None` where it is infinite.
    pub(super) fn initial_n_m(&self) -> Option<f64> {
        match self.elastic {
            Elastic::Power {
                coefficient_n_mn,
                exponent,
            } => match exponent.total_cmp(&1.0) {
                Ordering::Less => None,
                Ordering::Equal => Some(coefficient_n_mn),
                Ordering::Greater => Some(0.0),
            },
            Elastic::Cubic { initial_n_m, .. } => Some(initial_n_m),
            Elastic::Curve { tangents_n_m, .. } => tangents_n_m.first().copied(),
        }
    }

    /// Approximate contact time: that of the undamped power law, Cₙ ≈ 3.
    fn scale_s(&self) -> f64 {
        let n = self.exponent();
        let coefficient_n_mn = self.elastic_n(self.reference_m) / self.reference_m.powf(n);
        let energy = 0.5 * (n + 1.0) * self.mass_kg * self.speed_m_s.powi(2) / coefficient_n_mn;
        3.0 * energy.powf(1.0 / (n + 1.0)) / self.speed_m_s
    }

    /// Classical Runge–Kutta.
    pub(super) fn predict(&self) -> Predicted {
        let step_s = self.scale_s() / STEPS;
        let (m, g, h) = (self.mass_kg, self.gravity_m_s2, step_s);
        let shown = |d: f64, v: f64| self.force_n(d, v) / m;
        let rate = |d: f64, v: f64| g - shown(d, v);
        let (mut d, mut v) = (0.0, self.speed_m_s);
        let mut out = Predicted {
            step_s,
            accel_m_s2: vec![shown(d, v)],
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
            let a1 = g - last;
            let (v2, a2) = (v + 0.5 * h * a1, rate(d + 0.5 * h * v, v + 0.5 * h * a1));
            let (v3, a3) = (v + 0.5 * h * a2, rate(d + 0.5 * h * v2, v + 0.5 * h * a2));
            let (v4, a4) = (v + h * a3, rate(d + h * v3, v + h * a3));
            d += h / 6.0 * (v + 2.0 * (v2 + v3) + v4);
            v += h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
            let accel = shown(d, v);
            out.compression_m = out.compression_m.max(d);
            if v < 0.0 && accel == 0.0 {
                break;
            }
            fall = last - accel;
            last = accel;
            out.accel_m_s2.push(accel);
        }
        // The last force continues to fall at the same rate.
        let share = if fall > 0.0 {
            (last / fall).min(1.0)
        } else {
            1.0
        };
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
        let tail = (TAIL / (filter.corner_hz * self.step_s))
            .ceil()
            .min(LONGEST as f64) as usize;
        // The force ends within the next step.
        self.accel_m_s2
            .resize(self.accel_m_s2.len() + 1 + tail, 0.0);
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
                if left > 0.0 {
                    a * (1.0 - share / left).max(0.0)
                } else {
                    0.0
                }
            }
            _ => 0.0,
        }
    }
}
