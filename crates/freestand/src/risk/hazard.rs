//! How often motions of an intensity happen.

use thiserror::Error;

/// A point of a hazard curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HazardPoint {
    /// Intensity.
    pub intensity: f64,
    /// Mean number of motions per year that are as strong or stronger.
    pub annual_rate: f64,
}

/// What is assumed of λ above the last point of a hazard curve, where nothing is known but that it
/// falls from the rate of that point to 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tail {
    /// No motion is stronger than the last point: the least.
    Absent,
    /// The last segment goes on, λ = a x^−k.
    Continued,
    /// Every motion above the last point is as strong as any: the most.
    Level,
}

/// Annual rate of exceedance λ(x) of an intensity.
#[derive(Debug, Clone, PartialEq)]
pub enum Hazard {
    /// Points with rising intensity and falling rate; between two of them λ = a x^−k, and so above
    /// the last. Nothing is assumed below the first.
    Points(Vec<HazardPoint>),
    /// λ = k₀ (x/reference)^−k for every x.
    PowerLaw {
        /// k₀, rate at the reference \[1/year\].
        rate: f64,
        /// Intensity to which k₀ belongs.
        reference: f64,
        /// k.
        exponent: f64,
    },
}

/// Why numbers are no hazard curve.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum HazardError {
    /// Fewer than two points.
    #[error("a hazard curve needs at least two points, and there are {points}")]
    TooFew {
        /// Number of points.
        points: usize,
    },
    /// A value that has no logarithm.
    #[error("point {point}: {name} must be positive and finite, not {value}")]
    Value {
        /// The point, counted from 1.
        point: usize,
        /// What the value is.
        name: &'static str,
        /// The value.
        value: f64,
    },
    /// Intensities that do not rise.
    #[error("point {point}: the intensity {value} is not above the one before it, {before}")]
    NotRising {
        /// The point, counted from 1.
        point: usize,
        /// Its intensity.
        value: f64,
        /// The intensity before it.
        before: f64,
    },
    /// Rates that do not fall.
    #[error("point {point}: the rate {value} is not below the one before it, {before}")]
    NotFalling {
        /// The point, counted from 1.
        point: usize,
        /// Its rate.
        value: f64,
        /// The rate before it.
        before: f64,
    },
}

impl HazardError {
    /// The point with the problem, counted from 1.
    pub fn point(self) -> Option<usize> {
        match self {
            Self::TooFew { .. } => None,
            Self::Value { point, .. }
            | Self::NotRising { point, .. }
            | Self::NotFalling { point, .. } => Some(point),
        }
    }
}

fn positive(point: usize, name: &'static str, value: f64) -> Result<(), HazardError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(HazardError::Value { point, name, value })
    }
}

impl Hazard {
    /// A curve through points.
    ///
    /// # Errors
    /// Fewer than two points, values that are not positive, intensities that do not rise, or rates
    /// that do not fall.
    pub fn points(points: Vec<HazardPoint>) -> Result<Self, HazardError> {
        for (i, at) in points.iter().enumerate() {
            positive(i + 1, "the intensity", at.intensity)?;
            positive(i + 1, "the rate", at.annual_rate)?;
        }
        for (i, pair) in points.windows(2).enumerate() {
            let (point, (before, at)) = (i + 2, (pair[0], pair[1]));
            if at.intensity <= before.intensity {
                return Err(HazardError::NotRising {
                    point,
                    value: at.intensity,
                    before: before.intensity,
                });
            }
            if at.annual_rate >= before.annual_rate {
                return Err(HazardError::NotFalling {
                    point,
                    value: at.annual_rate,
                    before: before.annual_rate,
                });
            }
        }
        if points.len() < 2 {
            return Err(HazardError::TooFew {
                points: points.len(),
            });
        }
        Ok(Self::Points(points))
    }

    /// λ = k₀ (x/reference)^−k.
    ///
    /// # Errors
    /// A number that is not positive and finite.
    pub fn power_law(rate: f64, reference: f64, exponent: f64) -> Result<Self, HazardError> {
        positive(1, "the rate", rate)?;
        positive(1, "the reference", reference)?;
        positive(1, "the exponent", exponent)?;
        Ok(Self::PowerLaw {
            rate,
            reference,
            exponent,
        })
    }

    /// λ(x) \[1/year\]. Below the first point the rate of the first point; above the last one the
    /// last segment goes on.
    ///
    /// # Example
    /// λ = 1e-2 at 0.1 and 1e-4 at 1, so k = 2:
    /// ```
    /// use freestand::risk::{Hazard, HazardPoint, Tail};
    /// let point = |intensity, annual_rate| HazardPoint { intensity, annual_rate };
    /// let hazard = Hazard::points(vec![point(0.1, 1e-2), point(1.0, 1e-4)])?;
    /// assert!((hazard.annual_rate(0.5) / 4e-4 - 1.0).abs() < 1e-12);
    /// assert!((hazard.annual_rate(10.0) / 1e-6 - 1.0).abs() < 1e-12);
    /// assert_eq!(hazard.annual_rate_with(10.0, Tail::Absent), 0.0);
    /// assert_eq!(hazard.annual_rate_with(10.0, Tail::Level), 1e-4);
    /// # Ok::<(), freestand::risk::HazardError>(())
    /// ```
    pub fn annual_rate(&self, intensity: f64) -> f64 {
        self.annual_rate_with(intensity, Tail::Continued)
    }

    /// λ(x) with another assumption above the last point \[1/year\].
    pub fn annual_rate_with(&self, intensity: f64, tail: Tail) -> f64 {
        match self {
            Self::PowerLaw {
                rate,
                reference,
                exponent,
            } => rate * (intensity / reference).powf(-exponent),
            Self::Points(points) => {
                let above = points.partition_point(|point| point.intensity < intensity);
                match (
                    above.checked_sub(1).and_then(|below| points.get(below)),
                    points.get(above),
                ) {
                    (None, None) => 0.0,
                    (None, Some(first)) => first.annual_rate,
                    (Some(low), Some(high)) => {
                        let exponent = exponent_between(*low, *high);
                        low.annual_rate * (intensity / low.intensity).powf(-exponent)
                    }
                    (Some(last), None) => match tail {
                        Tail::Absent => 0.0,
                        Tail::Level => last.annual_rate,
                        Tail::Continued => {
                            let exponent = last_exponent(points);
                            last.annual_rate * (intensity / last.intensity).powf(-exponent)
                        }
                    },
                }
            }
        }
    }
}

/// k of the last segment.
pub(super) fn last_exponent(points: &[HazardPoint]) -> f64 {
    points
        .last_chunk()
        .map_or(0.0, |[low, high]| exponent_between(*low, *high))
}

/// k of the first segment; of a power law its own.
pub(super) fn first_exponent(hazard: &Hazard) -> f64 {
    match hazard {
        Hazard::Points(points) => points
            .first_chunk()
            .map_or(0.0, |[low, high]| exponent_between(*low, *high)),
        Hazard::PowerLaw { exponent, .. } => *exponent,
    }
}

/// k of λ = a x^−k between two points.
pub(super) fn exponent_between(low: HazardPoint, high: HazardPoint) -> f64 {
    (low.annual_rate / high.annual_rate).ln() / (high.intensity / low.intensity).ln()
}
