//! The cushions under an object: force against compression, and the landing of a mass on them.
//!
//! A [`ContactLaw`] is the formula; a [`Cushion`] is a law with checked numbers. A cushion pushes
//! and never pulls: where a law would give tension, the force is zero and the contact has ended.

mod curve;
mod history;
mod landing;

pub use curve::{CurveError, CushionTest, StressEnergy, StressEnergyFit};
pub use history::ContactPoint;
pub use landing::Contact;

use thiserror::Error;

use crate::search::bisect;

/// Stiffnesses that pads under an edge have: 10 to 10⁶ N/mm \[N/m\]. What lies outside was written in another unit or
/// belongs to no pad.
pub const PAD_STIFFNESS_N_M: std::ops::RangeInclusive<f64> = 1e4..=1e9;

/// The force of a cushion as a function of its compression d and the rate ḋ (positive while the
/// compression grows).
///
/// With the feature `serde`, a law is read and written under the names of its fields, in SI:
/// `{"linear": {"stiffness_n_m": 4.38e6}}`.
#[derive(Debug, Clone, PartialEq, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "kebab-case")
)]
pub enum ContactLaw {
    /// F = k d.
    Linear {
        /// Stiffness k \[N/m\].
        stiffness_n_m: f64,
    },
    /// F = K dⁿ; a sphere on a thick pad has n = 1.5 (Hertz).
    Power {
        /// Coefficient K \[N/mⁿ\].
        coefficient_n_mn: f64,
        /// Exponent n.
        exponent: f64,
    },
    /// F = k d + c ḋ.
    KelvinVoigt {
        /// Stiffness k \[N/m\].
        stiffness_n_m: f64,
        /// Damping c = 2ζ√(k m) \[N s/m\].
        damping_n_s_m: f64,
    },
    /// F = K dⁿ (1 + Λ ḋ), Hunt and Crossley (1975): the force is zero at the first and at the last
    /// moment of contact.
    HuntCrossley {
        /// Coefficient K \[N/mⁿ\].
        coefficient_n_mn: f64,
        /// Exponent n.
        exponent: f64,
        /// Dissipation Λ \[s/m\].
        dissipation_s_m: f64,
    },
    /// F = (2 k₀ d_b/π) tan(π d/2d_b), Mindlin (1945): a cushion that bottoms at d_b.
    Tangent {
        /// Initial stiffness k₀ \[N/m\].
        stiffness_n_m: f64,
        /// Compression d_b at which the cushion bottoms \[m\].
        bottoming_m: f64,
    },
    /// Straight lines between measured points, from (0, 0); the last line continues past the last
    /// point.
    Tabulated {
        /// Rising compressions \[m\].
        compressions_m: Vec<f64>,
        /// Forces that never fall \[N\].
        forces_n: Vec<f64>,
    },
    /// Undamped laws on top of each other: pad, leg and floor covering carry the same force.
    Series {
        /// The laws.
        parts: Vec<ContactLaw>,
    },
}

/// A [`ContactLaw`] whose numbers are valid. With the feature `serde`, it is read and written as its
/// law, and reading refuses numbers that are not valid.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "ContactLaw", into = "ContactLaw")
)]
pub struct Cushion {
    law: ContactLaw,
}

impl TryFrom<ContactLaw> for Cushion {
    type Error = CushionError;

    fn try_from(law: ContactLaw) -> Result<Self, CushionError> {
        Self::new(law)
    }
}

impl From<Cushion> for ContactLaw {
    fn from(cushion: Cushion) -> Self {
        cushion.law
    }
}

/// Why a [`Cushion`] cannot be created.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CushionError {
    /// A number of the law is out of range.
    #[error("the {name} of the {law} law must be {requirement}, not {value}")]
    Value {
        /// The name of the law.
        law: &'static str,
        /// The name of the number.
        name: &'static str,
        /// The requirement that it does not meet.
        requirement: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A table that is too short, or whose columns differ in length.
    #[error(
        "a force-compression table needs at least one point beyond (0, 0) and as many forces as compressions"
    )]
    ShortTable,
    /// A table whose compressions do not rise or whose force falls.
    #[error("point {number} of the force-compression table: {requirement}")]
    Table {
        /// The point, counted from 1.
        number: usize,
        /// What is wrong.
        requirement: &'static str,
    },
    /// A damped law in series: it would have an inner state, which the model does not cover.
    #[error("cushions in series must be undamped, and the {law} law is damped")]
    DampedSeries {
        /// The law.
        law: &'static str,
    },
    /// No layers in series.
    #[error("a cushion in series needs at least one layer")]
    NoParts,
}

fn within(
    fine: bool,
    law: &'static str,
    name: &'static str,
    requirement: &'static str,
    value: f64,
) -> Result<(), CushionError> {
    let error = CushionError::Value {
        law,
        name,
        requirement,
        value,
    };
    (fine && value.is_finite()).then_some(()).ok_or(error)
}

fn positive(law: &'static str, name: &'static str, value: f64) -> Result<(), CushionError> {
    within(value > 0.0, law, name, "positive", value)
}

fn not_negative(law: &'static str, name: &'static str, value: f64) -> Result<(), CushionError> {
    within(value >= 0.0, law, name, "zero or positive", value)
}

/// Foams and rubbers have exponents between ½ and 5; beyond 20 the calculation loses its accuracy.
fn exponent(law: &'static str, value: f64) -> Result<(), CushionError> {
    let fine = (0.1..=20.0).contains(&value);
    within(fine, law, "exponent", "between 0.1 and 20", value)
}

impl ContactLaw {
    /// The name in flags, files and outputs.
    pub fn name(&self) -> &'static str {
        self.into()
    }

    /// Whether the force depends on the speed.
    pub fn is_damped(&self) -> bool {
        matches!(self, Self::KelvinVoigt { .. } | Self::HuntCrossley { .. })
    }

    fn check(&self) -> Result<(), CushionError> {
        let name = self.name();
        match self {
            Self::Linear { stiffness_n_m } => positive(name, "stiffness", *stiffness_n_m),
            Self::Power {
                coefficient_n_mn,
                exponent: n,
            } => {
                positive(name, "coefficient", *coefficient_n_mn)?;
                exponent(name, *n)
            }
            Self::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            } => {
                positive(name, "stiffness", *stiffness_n_m)?;
                not_negative(name, "damping", *damping_n_s_m)
            }
            Self::HuntCrossley {
                coefficient_n_mn,
                exponent: n,
                dissipation_s_m,
            } => {
                positive(name, "coefficient", *coefficient_n_mn)?;
                exponent(name, *n)?;
                not_negative(name, "dissipation", *dissipation_s_m)
            }
            Self::Tangent {
                stiffness_n_m,
                bottoming_m,
            } => {
                positive(name, "stiffness", *stiffness_n_m)?;
                positive(name, "bottoming compression", *bottoming_m)
            }
            Self::Tabulated {
                compressions_m,
                forces_n,
            } => check_table(compressions_m, forces_n),
            Self::Series { parts } => check_series(parts),
        }
    }

    /// The elastic part of the force at compression `d` > 0 \[N\].
    fn elastic_force_n(&self, d: f64) -> f64 {
        match self {
            Self::Linear { stiffness_n_m } | Self::KelvinVoigt { stiffness_n_m, .. } => {
                stiffness_n_m * d
            }
            Self::Power {
                coefficient_n_mn,
                exponent,
            }
            | Self::HuntCrossley {
                coefficient_n_mn,
                exponent,
                ..
            } => coefficient_n_mn * d.powf(*exponent),
            Self::Tangent {
                stiffness_n_m,
                bottoming_m,
            } => {
                let limit_n = 2.0 * stiffness_n_m * bottoming_m / std::f64::consts::PI;
                if d < *bottoming_m {
                    limit_n * (std::f64::consts::FRAC_PI_2 * d / bottoming_m).tan()
                } else {
                    f64::INFINITY
                }
            }
            Self::Tabulated {
                compressions_m,
                forces_n,
            } => {
                let line = Line::at_compression(compressions_m, forces_n, d);
                line.force_n + line.slope_n_m * (d - line.compression_m)
            }
            Self::Series { parts } => Self::force_in_series_n(parts, d),
        }
    }

    /// The force at which the total compression of the parts is `d`.
    fn force_in_series_n(parts: &[Self], d: f64) -> f64 {
        let together = |force_n: f64| {
            parts
                .iter()
                .map(|part| part.compression_m(force_n))
                .sum::<f64>()
        };
        if d <= 0.0 || !d.is_finite() {
            return 0.0;
        }
        // Parts that all bottom cannot be compressed by more than the sum of their bottoming
        // compressions; beyond it no force is enough.
        let mut most = 1.0;
        while together(most) < d {
            most *= 2.0;
            if most == f64::INFINITY {
                return most;
            }
        }
        bisect(0.0, most, |force_n| together(force_n) >= d)
    }

    /// The compression of an undamped law under a force \[m\].
    fn compression_m(&self, force_n: f64) -> f64 {
        match self {
            Self::Linear { stiffness_n_m } | Self::KelvinVoigt { stiffness_n_m, .. } => {
                force_n / stiffness_n_m
            }
            Self::Power {
                coefficient_n_mn,
                exponent,
            }
            | Self::HuntCrossley {
                coefficient_n_mn,
                exponent,
                ..
            } => (force_n / coefficient_n_mn).powf(exponent.recip()),
            Self::Tangent {
                stiffness_n_m,
                bottoming_m,
            } => {
                let limit_n = 2.0 * stiffness_n_m * bottoming_m / std::f64::consts::PI;
                bottoming_m * std::f64::consts::FRAC_2_PI * (force_n / limit_n).atan()
            }
            Self::Tabulated {
                compressions_m,
                forces_n,
            } => {
                let line = Line::at_force(compressions_m, forces_n, force_n);
                line.compression_m + (force_n - line.force_n) / line.slope_n_m
            }
            Self::Series { parts } => parts.iter().map(|part| part.compression_m(force_n)).sum(),
        }
    }

    /// ∫F dd of the elastic part up to compression `d` > 0 \[J\].
    fn elastic_energy_j(&self, d: f64) -> f64 {
        match self {
            Self::Linear { stiffness_n_m } | Self::KelvinVoigt { stiffness_n_m, .. } => {
                0.5 * stiffness_n_m * d * d
            }
            Self::Power { exponent, .. } | Self::HuntCrossley { exponent, .. } => {
                self.elastic_force_n(d) * d / (exponent + 1.0)
            }
            Self::Tangent {
                stiffness_n_m,
                bottoming_m,
            } => {
                let scale_j = 2.0 * stiffness_n_m * (bottoming_m / std::f64::consts::PI).powi(2);
                let tangent = (std::f64::consts::FRAC_PI_2 * d / bottoming_m).tan();
                if d < *bottoming_m {
                    scale_j * (tangent * tangent).ln_1p()
                } else {
                    f64::INFINITY
                }
            }
            Self::Tabulated {
                compressions_m,
                forces_n,
            } => {
                let line = Line::at_compression(compressions_m, forces_n, d);
                let beyond_m = d - line.compression_m;
                line.energy_j + (line.force_n + 0.5 * line.slope_n_m * beyond_m) * beyond_m
            }
            Self::Series { parts } => {
                let force_n = Self::force_in_series_n(parts, d);
                parts
                    .iter()
                    .map(|part| part.elastic_energy_j(part.compression_m(force_n)))
                    .sum()
            }
        }
    }

    /// The same law with `factor` times the force at every compression, as of pads side by side.
    fn times(&self, factor: f64) -> Self {
        let mut law = self.clone();
        match &mut law {
            Self::Linear { stiffness_n_m } | Self::Tangent { stiffness_n_m, .. } => {
                *stiffness_n_m *= factor
            }
            Self::Power {
                coefficient_n_mn, ..
            }
            | Self::HuntCrossley {
                coefficient_n_mn, ..
            } => {
                *coefficient_n_mn *= factor;
            }
            Self::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            } => {
                *stiffness_n_m *= factor;
                *damping_n_s_m *= factor;
            }
            Self::Tabulated { forces_n, .. } => {
                forces_n.iter_mut().for_each(|force_n| *force_n *= factor)
            }
            Self::Series { parts } => parts.iter_mut().for_each(|part| *part = part.times(factor)),
        }
        law
    }
}

/// A straight line of a table, given by its first point.
struct Line {
    compression_m: f64,
    force_n: f64,
    slope_n_m: f64,
    energy_j: f64,
}

impl Line {
    fn at_compression(compressions_m: &[f64], forces_n: &[f64], d: f64) -> Self {
        Self::piece(
            compressions_m,
            forces_n,
            compressions_m.partition_point(|&x| x <= d),
        )
    }

    fn at_force(compressions_m: &[f64], forces_n: &[f64], force_n: f64) -> Self {
        Self::piece(
            compressions_m,
            forces_n,
            forces_n.partition_point(|&f| f <= force_n),
        )
    }

    /// The line that ends at point `end`; the last line also applies beyond the table.
    fn piece(compressions_m: &[f64], forces_n: &[f64], end: usize) -> Self {
        let end = end.clamp(1, compressions_m.len() - 1);
        let (x, f) = (&compressions_m[..=end], &forces_n[..=end]);
        let energy_j = (1..end)
            .map(|i| 0.5 * (f[i] + f[i - 1]) * (x[i] - x[i - 1]))
            .sum();
        let slope_n_m = (f[end] - f[end - 1]) / (x[end] - x[end - 1]);
        Self {
            compression_m: x[end - 1],
            force_n: f[end - 1],
            slope_n_m,
            energy_j,
        }
    }
}

fn check_table(compressions_m: &[f64], forces_n: &[f64]) -> Result<(), CushionError> {
    if compressions_m.len() != forces_n.len() || compressions_m.len() < 2 {
        return Err(CushionError::ShortTable);
    }
    let refuse = |number: usize, requirement: &'static str| {
        Err(CushionError::Table {
            number,
            requirement,
        })
    };
    if compressions_m[0] != 0.0 || forces_n[0] != 0.0 {
        return refuse(1, "the first point must be (0, 0)");
    }
    for i in 1..compressions_m.len() {
        if !compressions_m[i].is_finite() || !forces_n[i].is_finite() {
            return refuse(i + 1, "compression and force must be finite numbers");
        }
        if compressions_m[i] <= compressions_m[i - 1] {
            return refuse(i + 1, "the compression must rise from point to point");
        }
        if forces_n[i] < forces_n[i - 1] {
            return refuse(
                i + 1,
                "the force falls: use the loading branch only, smoothed if it is noisy",
            );
        }
    }
    let last = forces_n.len() - 1;
    if forces_n[last] <= forces_n[last - 1] {
        return refuse(
            last + 1,
            "the last line must rise, because it continues beyond the table",
        );
    }
    Ok(())
}

fn check_series(parts: &[ContactLaw]) -> Result<(), CushionError> {
    if parts.is_empty() {
        return Err(CushionError::NoParts);
    }
    for part in parts {
        part.check()?;
        if part.is_damped() {
            return Err(CushionError::DampedSeries { law: part.name() });
        }
        if let ContactLaw::Tabulated { forces_n, .. } = part
            && let Some(i) = (1..forces_n.len()).find(|&i| forces_n[i] <= forces_n[i - 1])
        {
            let requirement =
                "the force must rise from point to point, because the table is part of a series";
            return Err(CushionError::Table {
                number: i + 1,
                requirement,
            });
        }
    }
    Ok(())
}

impl Cushion {
    /// A cushion with this law.
    ///
    /// # Errors
    /// Numbers that are out of range for the law.
    pub fn new(law: ContactLaw) -> Result<Self, CushionError> {
        law.check()?;
        Ok(Self { law })
    }

    /// F = k d \[N/m\].
    ///
    /// # Errors
    /// A stiffness that is not positive and finite.
    pub fn linear(stiffness_n_m: f64) -> Result<Self, CushionError> {
        Self::new(ContactLaw::Linear { stiffness_n_m })
    }

    /// Layers on top of each other, which carry the same force: 1/k = Σ 1/kᵢ for springs.
    ///
    /// # Errors
    /// No layers, or several with a damped one among them.
    ///
    /// # Example
    /// ```
    /// use freestand::cushion::Cushion;
    /// let layers = [Cushion::linear(2e6)?, Cushion::linear(2e6)?];
    /// assert!((Cushion::in_series(&layers)?.force_n(1e-3, 0.0) - 1e3).abs() < 1e-9);
    /// # Ok::<(), freestand::cushion::CushionError>(())
    /// ```
    pub fn in_series(layers: &[Self]) -> Result<Self, CushionError> {
        if let [one] = layers {
            return Ok(one.clone());
        }
        let springs = layers
            .iter()
            .filter_map(Self::linear_stiffness_n_m)
            .map(f64::recip)
            .sum::<f64>();
        let mut parts: Vec<ContactLaw> = layers
            .iter()
            .filter(|layer| layer.linear_stiffness_n_m().is_none())
            .map(|layer| layer.law.clone())
            .collect();
        if springs > 0.0 {
            parts.push(ContactLaw::Linear {
                stiffness_n_m: springs.recip(),
            });
        }
        if let [one] = parts.as_slice() {
            return Self::new(one.clone());
        }
        Self::new(ContactLaw::Series { parts })
    }

    /// `count` cushions like this one side by side, which share the load: the pads under one edge.
    pub fn side_by_side(&self, count: u32) -> Self {
        Self {
            law: self.law.times(f64::from(count.max(1))),
        }
    }

    /// The law.
    pub fn law(&self) -> &ContactLaw {
        &self.law
    }

    /// k if the law is F = k d, otherwise `None`.
    pub fn linear_stiffness_n_m(&self) -> Option<f64> {
        match self.law {
            ContactLaw::Linear { stiffness_n_m } => Some(stiffness_n_m),
            _ => None,
        }
    }

    /// Whether the stiffness depends on the compression.
    pub fn is_curved(&self) -> bool {
        match &self.law {
            ContactLaw::Linear { .. } | ContactLaw::KelvinVoigt { .. } => false,
            ContactLaw::Power { exponent, .. } | ContactLaw::HuntCrossley { exponent, .. } => {
                *exponent != 1.0
            }
            _ => true,
        }
    }

    /// The cushion with `factor` times the stiffness and damping at every compression.
    ///
    /// # Errors
    /// A factor that is not positive, or with which the numbers go out of range.
    pub fn times(&self, factor: f64) -> Result<Self, CushionError> {
        Self::new(self.law.times(factor))
    }

    /// The force of the cushion at the compression `compression_m`, which changes at the rate
    /// `speed_m_s` (positive while it grows); never below zero, and zero without compression \[N\].
    ///
    /// # Example
    /// A Kelvin–Voigt pad of 2190 N/mm and 300 N s/m, at 1 mm of growing and 0.1 mm of falling
    /// compression:
    /// ```
    /// use freestand::cushion::{ContactLaw, Cushion};
    /// let law = ContactLaw::KelvinVoigt { stiffness_n_m: 2.19e6, damping_n_s_m: 300.0 };
    /// let pad = Cushion::new(law)?;
    /// assert!((pad.force_n(1e-3, 1.0) - 2490.0).abs() < 1e-9);
    /// assert_eq!(pad.force_n(1e-4, -1.0), 0.0);
    /// # Ok::<(), freestand::cushion::CushionError>(())
    /// ```
    pub fn force_n(&self, compression_m: f64, speed_m_s: f64) -> f64 {
        if compression_m < 0.0 {
            return 0.0;
        }
        let elastic_n = self.law.elastic_force_n(compression_m);
        let force_n = match self.law {
            ContactLaw::KelvinVoigt { damping_n_s_m, .. } => elastic_n + damping_n_s_m * speed_m_s,
            ContactLaw::HuntCrossley {
                dissipation_s_m, ..
            } => elastic_n * (1.0 + dissipation_s_m * speed_m_s),
            _ => elastic_n,
        };
        force_n.max(0.0)
    }

    /// The energy that the compressed cushion releases if it is unloaded slowly, ∫F dd without
    /// damping \[J\].
    pub fn stored_energy_j(&self, compression_m: f64) -> f64 {
        if compression_m > 0.0 {
            self.law.elastic_energy_j(compression_m)
        } else {
            0.0
        }
    }

    /// The compression under a constant force such as a weight \[m\].
    pub fn static_compression_m(&self, force_n: f64) -> f64 {
        self.law.compression_m(force_n)
    }

    /// The laws that carry the load on top of each other, with the compression of each; most
    /// cushions have one.
    pub fn layers_at(&self, compression_m: f64) -> Vec<(&ContactLaw, f64)> {
        match &self.law {
            ContactLaw::Series { parts } => {
                let force_n = self.law.elastic_force_n(compression_m);
                parts
                    .iter()
                    .map(|part| (part, part.compression_m(force_n)))
                    .collect()
            }
            law => vec![(law, compression_m)],
        }
    }

    /// dF/dd at a compression, without damping \[N/m\]: the tangent stiffness.
    pub fn tangent_stiffness_n_m(&self, compression_m: f64) -> f64 {
        self.law.slope_n_m(compression_m)
    }
}

impl ContactLaw {
    fn slope_n_m(&self, d: f64) -> f64 {
        match self {
            Self::Linear { stiffness_n_m } | Self::KelvinVoigt { stiffness_n_m, .. } => {
                *stiffness_n_m
            }
            Self::Power {
                coefficient_n_mn,
                exponent,
            }
            | Self::HuntCrossley {
                coefficient_n_mn,
                exponent,
                ..
            } => coefficient_n_mn * exponent * d.powf(exponent - 1.0),
            Self::Tangent {
                stiffness_n_m,
                bottoming_m,
            } => {
                stiffness_n_m
                    / (std::f64::consts::FRAC_PI_2 * d / bottoming_m)
                        .cos()
                        .powi(2)
            }
            Self::Tabulated {
                compressions_m,
                forces_n,
            } => Line::at_compression(compressions_m, forces_n, d).slope_n_m,
            Self::Series { parts } => {
                let force_n = Self::force_in_series_n(parts, d);
                parts
                    .iter()
                    .map(|part| part.slope_n_m(part.compression_m(force_n)).recip())
                    .sum::<f64>()
                    .recip()
            }
        }
    }
}

#[cfg(test)]
mod tests;
