//! The landing of a mass on a cushion: peak force, compression, contact time and restitution.

use std::f64::consts::PI;

use statrs::function::gamma::ln_gamma;

use super::{ContactLaw, Cushion};
use crate::integration::unit_integral;
use crate::search::{bisect, golden_maximum};

/// Λv below which rounding hides the damping.
const NEGLIGIBLE: f64 = 1e-15;

/// The result of the landing of a mass on a cushion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Largest force \[N\].
    pub peak_force_n: f64,
    /// Largest compression \[m\].
    pub compression_m: f64,
    /// Time from first contact until the force is zero again \[s\].
    pub duration_s: f64,
    /// Restitution e: rebound velocity divided by impact velocity.
    pub restitution_ratio: f64,
}

impl Cushion {
    /// The landing of `mass_kg` at `speed_m_s`; gravity during the contact is neglected.
    ///
    /// **Laws**, with v the speed and E = ½mv²: linear d = v√(m/k), F = v√(km), T = π√(m/k); power
    /// d = [(n+1)E/K]^(1/(n+1)), T = Cₙ d/v with Cₙ = 2√π Γ(1+1/(n+1))/Γ(½+1/(n+1)); Kelvin–Voigt
    /// and Hunt–Crossley in closed form up to one root; tangent F =
    /// (2k₀d_b/π)√(exp(π²E/(2k₀d_b²)) − 1); table and series from their energy.
    ///
    /// **Units**: kg, m/s. A force too large for a floating-point number is infinite (a tangent law
    /// far beyond its bottoming).
    ///
    /// # Accuracy
    /// Rounding for the closed forms; 1e-10 where the duration is an integral.
    ///
    /// # Reference
    /// Hunt and Crossley (1975); Mindlin (1945) for the tangent law; Landau and Lifshitz, Mechanics
    /// §11, for the power law.
    ///
    /// # Example
    /// The steel plate of the pad tests from 100 mm: 349.8 g, 0.572 mm, 1.283 ms.
    /// ```
    /// use freestand::{cushion::Cushion, G0_M_S2};
    /// let contact = Cushion::linear(2.19e6)?.land(0.365, (2.0 * G0_M_S2 * 0.1f64).sqrt());
    /// assert!((contact.peak_force_n / 0.365 / G0_M_S2 - 349.808).abs() < 1e-3);
    /// assert!((contact.compression_m - 0.571741e-3).abs() < 1e-9);
    /// assert!((contact.duration_s - 1.282550e-3).abs() < 1e-9);
    /// # Ok::<(), freestand::cushion::CushionError>(())
    /// ```
    pub fn land(&self, mass_kg: f64, speed_m_s: f64) -> Contact {
        let (m, v) = (mass_kg, speed_m_s.abs());
        match &self.law {
            _ if v == 0.0 => Contact::none(),
            ContactLaw::Linear { stiffness_n_m } => {
                let omega = (stiffness_n_m / m).sqrt();
                Contact::elastic(m * v * omega, v / omega, PI / omega)
            }
            ContactLaw::Power {
                coefficient_n_mn,
                exponent,
            } => power(*coefficient_n_mn, *exponent, m, v),
            ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            } => kelvin_voigt(
                (stiffness_n_m / m).sqrt(),
                0.5 * damping_n_s_m / (stiffness_n_m * m).sqrt(),
                m,
                v,
            ),
            ContactLaw::HuntCrossley {
                coefficient_n_mn,
                exponent,
                dissipation_s_m,
            } => {
                if dissipation_s_m * v < NEGLIGIBLE {
                    return power(*coefficient_n_mn, *exponent, m, v);
                }
                HuntCrossley::new(*coefficient_n_mn, *exponent, *dissipation_s_m, m, v).contact()
            }
            law => by_energy(law, m, v),
        }
    }
}

impl Cushion {
    /// Only the peak force of [`Cushion::land`], which takes less work \[N\].
    pub fn peak_force_n(&self, mass_kg: f64, speed_m_s: f64) -> f64 {
        let (m, v) = (mass_kg, speed_m_s.abs());
        match &self.law {
            _ if v == 0.0 => 0.0,
            ContactLaw::HuntCrossley {
                coefficient_n_mn,
                exponent,
                dissipation_s_m,
            } if dissipation_s_m * v >= NEGLIGIBLE => {
                HuntCrossley::new(*coefficient_n_mn, *exponent, *dissipation_s_m, m, v)
                    .peak_force_n()
            }
            law @ (ContactLaw::Tangent { .. }
            | ContactLaw::Tabulated { .. }
            | ContactLaw::Series { .. }) => law.deepest(0.5 * m * v * v).1,
            _ => self.land(m, v).peak_force_n,
        }
    }
}

impl Contact {
    fn none() -> Self {
        Self {
            peak_force_n: 0.0,
            compression_m: 0.0,
            duration_s: 0.0,
            restitution_ratio: 1.0,
        }
    }

    fn elastic(peak_force_n: f64, compression_m: f64, duration_s: f64) -> Self {
        Self {
            peak_force_n,
            compression_m,
            duration_s,
            restitution_ratio: 1.0,
        }
    }
}

fn power(coefficient: f64, n: f64, m: f64, v: f64) -> Contact {
    let d = (0.5 * (n + 1.0) * m * v * v / coefficient).powf(1.0 / (n + 1.0));
    let share = 1.0 / (n + 1.0);
    let c_n = 2.0 * PI.sqrt() * (ln_gamma(1.0 + share) - ln_gamma(0.5 + share)).exp();
    Contact::elastic(coefficient * d.powf(n), d, c_n * d / v)
}

/// ω = √(k/m), ζ = c/(2√(km)); with ζ = cos φ the compression peaks at φ/(sω) and the force ends at
/// 2φ/(sω).
fn kelvin_voigt(omega: f64, zeta: f64, m: f64, v: f64) -> Contact {
    // φ/s = acos ζ/√(1−ζ²), or acosh ζ/√(ζ²−1) above the critical damping: asin(s)/s, whose next
    // term is 15s⁶/336.
    let s2 = (1.0 - zeta) * (1.0 + zeta);
    let angle = if s2.abs() < 1e-4 {
        1.0 + s2 * (1.0 / 6.0 + 0.075 * s2)
    } else if s2 > 0.0 {
        s2.sqrt().atan2(zeta) / s2.sqrt()
    } else {
        zeta.acosh() / (-s2).sqrt()
    };
    let compression_m = v / omega * (-zeta * angle).exp();
    let separation = 2.0 * angle;
    let peak_force_n = if zeta < 0.5 {
        let s = s2.sqrt();
        let peak = (s * (1.0 - 4.0 * zeta * zeta)).atan2(zeta * (3.0 - 4.0 * zeta * zeta)) / s;
        m * v * omega * (-zeta * peak).exp()
    } else {
        2.0 * zeta * m * v * omega
    };
    Contact {
        peak_force_n,
        compression_m,
        duration_s: separation / omega,
        restitution_ratio: (-zeta * separation).exp(),
    }
}

/// A landing on F = K dⁿ(1 + Λḋ) as a function of the relative speed u = ḋ/v from 1 to −e: dⁿ⁺¹ =
/// (n+1) m v/(KΛ) · g(u) with g(u) = 1 − u − ln((1+c)/(1+cu))/c, c = Λv.
struct HuntCrossley {
    n: f64,
    c: f64,
    m: f64,
    v: f64,
    coefficient: f64,
    /// (n+1) m v/(KΛ).
    scale: f64,
    /// e.
    rebound: f64,
}

/// x − ln(1 + x), as a series where the difference would lose its digits.
fn minus_ln_1p(x: f64) -> f64 {
    if x.abs() > 0.05 {
        return x - x.ln_1p();
    }
    // x²/2 − x³/3 + …: 0.05¹⁴ = 6e-19.
    (2..16)
        .rev()
        .fold(0.0, |sum, k| 1.0 / f64::from(k) - x * sum)
        * x
        * x
}

impl HuntCrossley {
    fn new(coefficient: f64, n: f64, dissipation: f64, m: f64, v: f64) -> Self {
        let c = dissipation * v;
        let mut landing = Self {
            n,
            c,
            m,
            v,
            coefficient,
            scale: (n + 1.0) * m * v / (coefficient * dissipation),
            rebound: 1.0,
        };
        // The elastic part of the force returns at most all of the energy, and the force ends where
        // 1 + cu does.
        let most = (1.0_f64).min(1.0 / c);
        landing.rebound = bisect(0.0, most, |e| landing.g(1.0 + e, -e) <= 0.0);
        landing
    }

    /// g at u, calculated from 1 − u, which keeps its digits where the contact begins.
    fn g(&self, fall: f64, u: f64) -> f64 {
        let y = self.c * fall / (1.0 + self.c * u);
        if y.is_finite() {
            (minus_ln_1p(y) + self.c * u * y) / self.c
        } else {
            f64::NEG_INFINITY
        }
    }

    fn compression_m(&self, g: f64) -> f64 {
        (self.scale * g.max(0.0)).powf(1.0 / (self.n + 1.0))
    }

    fn force_n(&self, g: f64, u: f64) -> f64 {
        self.coefficient * self.compression_m(g).powf(self.n) * (1.0 + self.c * u)
    }

    /// ∫ m v du/F from u = 1 − δ, with δ = zⁿ⁺¹·`length`: the root of the force at the end of the
    /// contact cancels.
    fn time_s(&self, length: f64, g: impl Fn(f64) -> f64, u: impl Fn(f64) -> f64) -> f64 {
        let power = self.n + 1.0;
        unit_integral(|z| {
            let delta = length * z.powf(power);
            let force_n = self.force_n(g(delta), u(delta));
            if force_n > 0.0 {
                self.m * self.v * length * power * z.powf(self.n) / force_n
            } else {
                0.0
            }
        })
    }

    fn peak_force_n(&self) -> f64 {
        golden_maximum(|u| self.force_n(self.g(1.0 - u, u), u), 0.0, 1.0)
    }

    fn contact(&self) -> Contact {
        let e = self.rebound;
        let inwards_s = self.time_s(1.0, |delta| self.g(delta, 1.0 - delta), |delta| 1.0 - delta);
        // Near the end g is its slope there times δ; the difference in the formula would be lost in
        // rounding.
        let slope = self.c * e / (1.0 - self.c * e);
        let g = |delta: f64| {
            if delta < 1e-8 * e {
                slope * delta
            } else {
                self.g(1.0 + e - delta, delta - e)
            }
        };
        let outwards_s = self.time_s(e, g, |delta| delta - e);
        Contact {
            peak_force_n: self.peak_force_n(),
            compression_m: self.compression_m(self.g(1.0, 0.0)),
            duration_s: inwards_s + outwards_s,
            restitution_ratio: e,
        }
    }
}

/// An undamped law: the compression at which the stored energy is ½mv², and T = 2∫dd/ḋ.
fn by_energy(law: &ContactLaw, m: f64, v: f64) -> Contact {
    let energy_j = 0.5 * m * v * v;
    let (max_m, force_n) = law.deepest(energy_j);
    if !force_n.is_finite() {
        // The mass rebounds at once where the cushion bottoms.
        return Contact::elastic(f64::INFINITY, max_m, 2.0 * max_m / v);
    }
    // d = d_max(1 − s²) removes the root of the speed from the integral; the kinks of a table
    // divide it.
    let time_s = |from: f64, to: f64| {
        unit_integral(|x| {
            let s = from + (to - from) * x;
            let short_m = max_m * s * s;
            let gap_j = if s < 1e-4 {
                0.5 * (force_n + law.elastic_force_n(max_m - short_m)) * short_m
            } else {
                energy_j - law.elastic_energy_j(max_m - short_m)
            };
            if gap_j > 0.0 {
                (to - from) * 2.0 * max_m * s / (2.0 * gap_j / m).sqrt()
            } else {
                0.0
            }
        })
    };
    let kinks = law
        .kinks_m()
        .into_iter()
        .filter(|&d| d < max_m)
        .map(|d| (1.0 - d / max_m).sqrt());
    let mut stops: Vec<f64> = kinks.chain([0.0, 1.0]).collect();
    stops.sort_by(f64::total_cmp);
    let half_s: f64 = stops
        .windows(2)
        .filter(|pair| pair[1] > pair[0])
        .map(|pair| time_s(pair[0], pair[1]))
        .sum();
    Contact::elastic(force_n, max_m, 2.0 * half_s)
}

impl ContactLaw {
    /// The compression that stores a given energy, and the force there.
    fn deepest(&self, energy_j: f64) -> (f64, f64) {
        match self {
            Self::Tangent {
                stiffness_n_m,
                bottoming_m,
            } => {
                let limit_n = 2.0 * stiffness_n_m * bottoming_m / PI;
                let tangent = (energy_j * PI / (limit_n * bottoming_m)).exp_m1().sqrt();
                (
                    bottoming_m * std::f64::consts::FRAC_2_PI * tangent.atan(),
                    limit_n * tangent,
                )
            }
            law => {
                // Twice the energy is at most twice as deep, because forces never fall.
                let beyond = |d: f64| law.elastic_energy_j(d) >= energy_j;
                let mut high: f64 = 1e-3;
                while high.is_finite() && !beyond(high) {
                    high *= 2.0;
                }
                let max_m = bisect(0.0, high, beyond);
                (max_m, law.elastic_force_n(max_m))
            }
        }
    }

    /// Compressions at which the slope of the force changes abruptly.
    pub(crate) fn kinks_m(&self) -> Vec<f64> {
        match self {
            Self::Tabulated { compressions_m, .. } => compressions_m.clone(),
            Self::Series { parts } => {
                let of = |part: &Self| -> Vec<f64> {
                    let forces = part.kinks_m().into_iter().map(|d| part.elastic_force_n(d));
                    forces.map(|force_n| self.compression_m(force_n)).collect()
                };
                parts.iter().flat_map(of).collect()
            }
            _ => Vec::new(),
        }
    }
}
