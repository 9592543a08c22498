//! One contact element: its share of a cushion, in contact and after it.

use crate::cushion::{ContactLaw, Cushion};

/// After so many relaxation times a cushion has recovered: e⁻⁵⁰ of a compression is below its rounding, and an
/// underflow takes long.
const RECOVERED: f64 = 50.0;

/// A share of a cushion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pad<'a> {
    pub(crate) cushion: &'a Cushion,
    pub(crate) share: f64,
}

impl Pad<'_> {
    /// The law of an element, continued into tension, so that the step that finds the end of a
    /// contact sees no kink.
    pub(crate) fn push(&self, d: f64, rate: f64) -> f64 {
        self.push_and_elastic(d, rate)[0]
    }

    /// [`Pad::push`] and its elastic part.
    pub(crate) fn push_and_elastic(&self, d: f64, rate: f64) -> [f64; 2] {
        let elastic = if d < 0.0 {
            -self.cushion.force_n(-d, 0.0)
        } else {
            self.cushion.force_n(d, 0.0)
        };
        let force = match self.cushion.law() {
            ContactLaw::KelvinVoigt { damping_n_s_m, .. } => elastic + damping_n_s_m * rate,
            ContactLaw::HuntCrossley {
                dissipation_s_m, ..
            } => elastic * (1.0 + dissipation_s_m * rate),
            _ => elastic,
        };
        [self.share * force, self.share * elastic]
    }

    /// Whether a damped law has no force without compression, so that a contact can end there as
    /// well.
    pub(crate) fn loses_force_at_touch(&self) -> bool {
        matches!(self.cushion.law(), ContactLaw::HuntCrossley { .. })
    }

    /// Whether the force depends on the rate of compression.
    pub(crate) fn is_damped(&self) -> bool {
        self.cushion.law().is_damped()
    }

    /// k and c where the force is k d + c ḋ.
    pub(crate) fn linear(&self) -> Option<[f64; 2]> {
        match *self.cushion.law() {
            ContactLaw::Linear { stiffness_n_m } => Some([self.share * stiffness_n_m, 0.0]),
            ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            } => Some([self.share * stiffness_n_m, self.share * damping_n_s_m]),
            _ => None,
        }
    }

    /// The elastic part of [`Pad::push`].
    pub(crate) fn elastic(&self, d: f64) -> f64 {
        self.share
            * if d < 0.0 {
                -self.cushion.force_n(-d, 0.0)
            } else {
                self.cushion.force_n(d, 0.0)
            }
    }

    /// Rate of the normal force of a contact, from the derivatives of its compression.
    pub(crate) fn push_rate(&self, d: f64, rate: f64, acceleration: f64) -> f64 {
        let slope = self.share * self.cushion.tangent_stiffness_n_m(d.abs());
        match self.cushion.law() {
            ContactLaw::KelvinVoigt { damping_n_s_m, .. } => {
                slope * rate + self.share * damping_n_s_m * acceleration
            }
            ContactLaw::HuntCrossley {
                dissipation_s_m, ..
            } => {
                slope * rate * (1.0 + dissipation_s_m * rate)
                    + self.elastic(d) * dissipation_s_m * acceleration
            }
            _ => slope * rate,
        }
    }

    /// Energy in the cushion of a contact.
    pub(crate) fn pressed_j(&self, d: f64) -> f64 {
        self.share * self.cushion.stored_energy_j(d.abs())
    }

    /// Position of the surface of an element without contact: a massless cushion recovers as its
    /// dashpot allows.
    pub(crate) fn surface(&self, since_s: f64, compression_m: f64, time_s: f64) -> f64 {
        if compression_m <= 0.0 {
            return 0.0;
        }
        let gone_s = time_s - since_s;
        match self.cushion.law() {
            ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            } => {
                let recovered = stiffness_n_m / damping_n_s_m * gone_s;
                if recovered > RECOVERED {
                    0.0
                } else {
                    compression_m * (-recovered).exp()
                }
            }
            ContactLaw::HuntCrossley {
                dissipation_s_m, ..
            } => (compression_m - gone_s / dissipation_s_m).max(0.0),
            _ => 0.0,
        }
    }

    /// How long after a contact [`Pad::surface`] is not yet that of the unloaded cushion.
    pub(crate) fn recovery_s(&self, compression_m: f64) -> f64 {
        if compression_m <= 0.0 {
            return f64::NEG_INFINITY;
        }
        match self.cushion.law() {
            ContactLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            } => RECOVERED * damping_n_s_m / stiffness_n_m,
            ContactLaw::HuntCrossley {
                dissipation_s_m, ..
            } => compression_m * dissipation_s_m,
            _ => f64::NEG_INFINITY,
        }
    }

    /// How much longer an element pushes, of the order of 1: an undamped cushion pushes while it is
    /// compressed, a damped one while its force is positive. `unit_m` and `weight_n` are the units
    /// of compression and force.
    pub(crate) fn pushes(&self, d: f64, normal_n: f64, (unit_m, weight_n): (f64, f64)) -> f64 {
        let pushes = if self.is_damped() {
            normal_n / weight_n
        } else {
            d / unit_m
        };
        if self.loses_force_at_touch() {
            pushes.min(d / unit_m)
        } else {
            pushes
        }
    }

    /// Whether a contact past its event has ended.
    pub(crate) fn is_over(&self, d: f64, normal_n: f64) -> bool {
        let is_over = if self.is_damped() {
            normal_n < 0.0
        } else {
            d < 0.0
        };
        is_over || (self.loses_force_at_touch() && d < 0.0)
    }
}

/// The two kinks of a law that enclose a compression; infinite where there is none.
pub(crate) fn between_kinks(kinks_m: &[f64], d: f64) -> (f64, f64) {
    let above = kinks_m
        .iter()
        .copied()
        .filter(|&kink| kink > d)
        .fold(f64::INFINITY, f64::min);
    let below = kinks_m
        .iter()
        .copied()
        .filter(|&kink| kink > 0.0 && kink <= d);
    (below.fold(f64::NEG_INFINITY, f64::max), above)
}
