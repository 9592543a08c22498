//! Rotation of two horizontal components to other directions, and response spectra over all
//! directions.

use crate::motion::{Motion, MotionError};
use crate::oscillator::{
    OscillatorError, OscillatorState, OscillatorStep, check_damping, step_of_period,
};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use thiserror::Error;

/// Why two components cannot be combined.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RotateError {
    /// Their time steps differ.
    #[error("the components have different time steps, {first_s} s and {second_s} s")]
    Steps {
        /// Time step of the first component \[s\].
        first_s: f64,
        /// Time step of the second component \[s\].
        second_s: f64,
    },
    /// Their numbers of samples differ.
    #[error("the components have different numbers of samples, {first} and {second}")]
    Lengths {
        /// Samples of the first component.
        first: usize,
        /// Samples of the second component.
        second: usize,
    },
    /// They point in nearly the same direction.
    #[error(
        "components at {first_deg} and {second_deg} degrees are too close to parallel for a rotation"
    )]
    Parallel {
        /// Azimuth of the first component \[degrees\].
        first_deg: f64,
        /// Azimuth of the second component \[degrees\].
        second_deg: f64,
    },
    /// An azimuth that is not finite.
    #[error("an azimuth must be a finite number of degrees, not {azimuth_deg}")]
    Azimuth {
        /// The azimuth that was given \[degrees\].
        azimuth_deg: f64,
    },
    /// A percentile outside 0 to 100.
    #[error("a percentile must be from 0 to 100, not {percentile}")]
    Percentile {
        /// The percentile that was given.
        percentile: f64,
    },
    /// Invalid damping, or an invalid period.
    #[error(transparent)]
    Oscillator(#[from] OscillatorError),
    /// The result is not a valid motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// Two horizontal components of one motion, with the same time step and number of samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<'m> {
    first: &'m Motion,
    second: &'m Motion,
}

/// Below this |sin| of the angle between them, an error of one component counts more than double in
/// the rotated one.
const MIN_SINE: f64 = 0.5;

impl<'m> Pair<'m> {
    /// A pair of the two components.
    ///
    /// # Errors
    /// Different time steps (by more than 10⁻⁹) or different numbers of samples.
    pub fn new(first: &'m Motion, second: &'m Motion) -> Result<Self, RotateError> {
        let (first_s, second_s) = (first.dt_s(), second.dt_s());
        if (first_s - second_s).abs() > 1e-9 * first_s {
            return Err(RotateError::Steps { first_s, second_s });
        }
        let (ours, theirs) = (first.accel_m_s2().len(), second.accel_m_s2().len());
        if ours != theirs {
            return Err(RotateError::Lengths {
                first: ours,
                second: theirs,
            });
        }
        Ok(Self { first, second })
    }

    /// The component at `azimuth_deg`, where the two components point to `first_deg` and
    /// `second_deg`; all angles clockwise from north, or all from any other direction.
    ///
    /// `a(θ) = [a₁ sin(φ₂ − θ) + a₂ sin(θ − φ₁)]/sin(φ₂ − φ₁)`, which is
    /// `a₁ cos(θ − φ₁) + a₂ sin(θ − φ₁)` for perpendicular components.
    ///
    /// # Errors
    /// An azimuth that is not finite, or components within 30 degrees of parallel.
    ///
    /// # Example
    /// ```
    /// use freestand::{motion::Motion, signal::rotate::Pair};
    /// let north = Motion::new(0.01, vec![0.0, 1.0])?;
    /// let east = north.clone();
    /// let northeast = Pair::new(&north, &east)?.component_at(0.0, 90.0, 45.0)?;
    /// assert!((northeast.peak_m_s2() - 2f64.sqrt()).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn component_at(
        &self,
        first_deg: f64,
        second_deg: f64,
        azimuth_deg: f64,
    ) -> Result<Motion, RotateError> {
        for azimuth_deg in [first_deg, second_deg, azimuth_deg] {
            if !azimuth_deg.is_finite() {
                return Err(RotateError::Azimuth { azimuth_deg });
            }
        }
        let between = sine_deg(second_deg - first_deg);
        if between.abs() < MIN_SINE {
            return Err(RotateError::Parallel {
                first_deg,
                second_deg,
            });
        }
        let of_first = sine_deg(second_deg - azimuth_deg) / between;
        let of_second = sine_deg(azimuth_deg - first_deg) / between;
        let samples = self.first.accel_m_s2().iter().zip(self.second.accel_m_s2());
        Ok(Motion::new(
            self.first.dt_s(),
            samples.map(|(a, b)| of_first * a + of_second * b).collect(),
        )?)
    }
}

/// Sine of an angle in degrees, exact at multiples of 90: a component rotated to its own azimuth
/// does not change, to the bit.
fn sine_deg(angle_deg: f64) -> f64 {
    let angle = angle_deg.rem_euclid(360.0);
    match angle {
        0.0 | 180.0 => 0.0,
        90.0 => 1.0,
        270.0 => -1.0,
        _ => angle.to_radians().sin(),
    }
}

/// Response spectra of a pair of components over all horizontal directions.
///
/// **Units** and shapes: pseudo-accelerations in m/s², one value for each period, in the order of
/// the request.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectionalSpectrum {
    /// Undamped periods \[s\].
    pub periods_s: Vec<f64>,
    /// RotDnn, one spectrum for each requested percentile nn.
    pub rotd_m_s2: Vec<Vec<f64>>,
    /// Pseudo-acceleration of the first component.
    pub first_m_s2: Vec<f64>,
    /// Pseudo-acceleration of the second component.
    pub second_m_s2: Vec<f64>,
    /// The larger of the two, period by period.
    pub larger_m_s2: Vec<f64>,
    /// The geometric mean of the two.
    pub geometric_mean_m_s2: Vec<f64>,
}

/// Directions over which RotDnn ranks, one degree apart: half a circle, because −a and a have the
/// same response.
pub const DIRECTIONS: usize = 180;

/// Pseudo-accelerations over all horizontal directions: RotDnn for each of `percentiles` (50 is the
/// median, 100 the direction with the largest response), and those of the two components
/// themselves.
///
/// For θ = 0, 1 … 179 degrees, `PSA(θ) = ω² max|u₁ cos θ + u₂ sin θ|` with the displacements u₁, u₂
/// of the oscillator under each component (the response is linear, so they are calculated once); nn
/// is the percentile over θ, interpolated linearly between ranks. At T = 0 the accelerations
/// themselves replace ω²u.
///
/// # Reference
/// Boore (2010), "Orientation-independent, nongeometric-mean measures of seismic intensity from two
/// horizontal components of motion", BSSA 100, 1830–1835. Boore assumes perpendicular components,
/// and so does this function.
///
/// # Accuracy
/// The largest of 180 directions is at most 1/cos 0.5° = 4·10⁻⁵ below that of all.
///
/// # Limitation
/// Peaks are those at the samples, as in
/// [`response_spectrum`](crate::oscillator::response_spectrum).
///
/// # Errors
/// A percentile outside 0 to 100, damping outside 0 ≤ ζ < 1, or a negative or non-finite period.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::rotate::{Pair, directional_spectrum}};
/// let (north, east) = (Motion::new(0.01, vec![0.0, 3.0])?, Motion::new(0.01, vec![0.0, 4.0])?);
/// let spectrum = directional_spectrum(&Pair::new(&north, &east)?, 0.05, &[0.0], &[0.0, 100.0])?;
/// assert!((spectrum.rotd_m_s2[1][0] - 5.0).abs() < 2e-4); // along the motion
/// assert!(spectrum.rotd_m_s2[0][0] < 5.0 * 0.0088); // across it: at most half a degree off
/// assert_eq!(spectrum.larger_m_s2, [4.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn directional_spectrum(
    pair: &Pair<'_>,
    damping_ratio: f64,
    periods_s: &[f64],
    percentiles: &[f64],
) -> Result<DirectionalSpectrum, RotateError> {
    check_damping(damping_ratio)?;
    if let Some(&percentile) = percentiles.iter().find(|p| !(0.0..=100.0).contains(*p)) {
        return Err(RotateError::Percentile { percentile });
    }
    let columns: Vec<Vec<f64>> = periods_s
        .par_iter()
        .map(|&period_s| {
            let (points, scale) = response_points(pair, period_s, damping_ratio)?;
            let mut peaks = peaks_by_direction(&points);
            let (first, second) = (scale * peaks[0], scale * peaks[DIRECTIONS / 2]);
            peaks.sort_unstable_by(f64::total_cmp);
            let mut column = vec![first, second];
            column.extend(percentiles.iter().map(|&nn| scale * percentile(&peaks, nn)));
            Ok(column)
        })
        .collect::<Result<_, OscillatorError>>()?;
    let row = |i: usize| -> Vec<f64> { columns.iter().map(|column| column[i]).collect() };
    let (first_m_s2, second_m_s2) = (row(0), row(1));
    let both = || first_m_s2.iter().zip(&second_m_s2);
    Ok(DirectionalSpectrum {
        periods_s: periods_s.to_vec(),
        rotd_m_s2: (0..percentiles.len()).map(|i| row(i + 2)).collect(),
        larger_m_s2: both().map(|(a, b)| a.max(*b)).collect(),
        geometric_mean_m_s2: both().map(|(a, b)| (a * b).sqrt()).collect(),
        first_m_s2,
        second_m_s2,
    })
}

/// Displacements (u₁, u₂) at every sample and ω², or accelerations and 1 at T = 0.
fn response_points(
    pair: &Pair<'_>,
    period_s: f64,
    damping_ratio: f64,
) -> Result<(Vec<(f64, f64)>, f64), OscillatorError> {
    let (first, second) = (pair.first.accel_m_s2(), pair.second.accel_m_s2());
    if period_s == 0.0 {
        return Ok((
            first.iter().copied().zip(second.iter().copied()).collect(),
            1.0,
        ));
    }
    let step: OscillatorStep = step_of_period(period_s, damping_ratio, pair.first.dt_s())?;
    let (mut one, mut two) = (OscillatorState::default(), OscillatorState::default());
    let points = first.windows(2).zip(second.windows(2)).map(|(a, b)| {
        one = step.advance(one, a[0], a[1]);
        two = step.advance(two, b[0], b[1]);
        (one.displacement_m, two.displacement_m)
    });
    let omega = TAU / period_s;
    Ok((points.collect(), omega * omega))
}

/// max|u₁ cos θ + u₂ sin θ| for θ = 0, 1 … 179 degrees.
///
/// Exact, although only a few points are evaluated in every direction: the peaks of a few of them
/// are lower bounds for all directions, and a point closer to the origin than the smallest bound is
/// never the peak.
fn peaks_by_direction(points: &[(f64, f64)]) -> Vec<f64> {
    const FIRST_LOOK: usize = 15;
    let directions: Vec<(f64, f64)> = (0..DIRECTIONS).map(direction).collect();
    let reach = |(x, y): (f64, f64), (cos, sin): (f64, f64)| (x * cos + y * sin).abs();
    let farthest = |among: &[(f64, f64)], towards: (f64, f64)| {
        among
            .iter()
            .copied()
            .max_by(|&a, &b| reach(a, towards).total_cmp(&reach(b, towards)))
    };
    let corners: Vec<(f64, f64)> = directions
        .iter()
        .step_by(FIRST_LOOK)
        .filter_map(|&towards| farthest(points, towards))
        .collect();
    let bound = |towards: (f64, f64)| {
        corners
            .iter()
            .map(|&corner| reach(corner, towards))
            .fold(0.0, f64::max)
    };
    let least = directions
        .iter()
        .map(|&towards| bound(towards))
        .fold(f64::INFINITY, f64::min);
    // The tiny factor allows for the rounding of |u| relative to that of its components.
    let near = (least * (1.0 - 1e-12)).powi(2);
    let far: Vec<(f64, f64)> = points
        .iter()
        .copied()
        .filter(|(x, y)| x * x + y * y >= near)
        .collect();
    let peak = |&towards: &(f64, f64)| {
        far.iter()
            .map(|&point| reach(point, towards))
            .fold(0.0, f64::max)
    };
    directions.iter().map(peak).collect()
}

/// cos θ and sin θ of whole degrees, exact at 0 and 90.
fn direction(degrees: usize) -> (f64, f64) {
    match degrees {
        0 => (1.0, 0.0),
        90 => (0.0, 1.0),
        _ => {
            let (sin, cos) = (degrees as f64 * PI / 180.0).sin_cos();
            (cos, sin)
        }
    }
}

/// The percentile of sorted values, linear between ranks (Hyndman and Fan's type 7, the default of
/// NumPy).
fn percentile(sorted: &[f64], percentile: f64) -> f64 {
    let rank = percentile / 100.0 * (sorted.len() - 1) as f64;
    let below = (rank.floor() as usize).min(sorted.len() - 1);
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (sorted[above] - sorted[below]) * (rank - below as f64)
}

#[cfg(test)]
mod tests;
