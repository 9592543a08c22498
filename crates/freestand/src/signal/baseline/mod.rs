//! Baseline correction: an offset that an instrument adds makes velocity and displacement drift.

use crate::measures::cumulative_trapezoid;
use crate::motion::{Motion, MotionError, mean};
use thiserror::Error;

/// The highest degree of a polynomial.
pub const MAX_DEGREE: usize = 10;

/// Why a baseline cannot be removed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BaselineError {
    /// The degree is outside the range of the correction.
    #[error("the degree of a baseline must be {least} to {MAX_DEGREE}, not {degree}")]
    Degree {
        /// The lowest degree.
        least: usize,
        /// The degree that was given.
        degree: usize,
    },
    /// A time outside the motion, or one that leaves too little of it.
    #[error("{name} must be {range} the motion of {duration_s} s, not {time_s} s")]
    Time {
        /// The name of the time.
        name: &'static str,
        /// Its range, in words.
        range: &'static str,
        /// Length of the motion \[s\].
        duration_s: f64,
        /// The time that was given \[s\].
        time_s: f64,
    },
    /// Fewer samples than the polynomial has coefficients.
    #[error(
        "the number of samples must be above {degree}, the degree of the polynomial, not {samples}"
    )]
    TooShort {
        /// The degree.
        degree: usize,
        /// Samples that it would be fitted to.
        samples: usize,
    },
    /// The result is not a valid motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// A baseline to be subtracted from an acceleration history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Baseline {
    /// The mean of all samples.
    Mean,
    /// The mean of the first seconds, before the earthquake arrives (zeroth-order correction).
    PreEvent {
        /// End of the quiet part \[s\].
        until_s: f64,
    },
    /// The polynomial that fits the acceleration best (least squares).
    Polynomial {
        /// Its degree, 0 to 10.
        degree: usize,
    },
    /// The derivative of the polynomial that fits the velocity best from a given time on and is
    /// zero there: the velocity continues without a step and oscillates about zero.
    Graizer {
        /// Degree of the polynomial in the velocity, 1 to 10.
        degree: usize,
        /// Time at which the baseline begins to drift \[s\].
        from_s: f64,
    },
    /// Two offsets, one during the strong shaking and one after it, such that the final velocity is
    /// about zero.
    Boore2001 {
        /// Time at which the strong shaking begins \[s\].
        t1_s: f64,
        /// Time at which it ends \[s\].
        t2_s: f64,
    },
}

/// The motion less its baseline.
///
/// * `Mean`, `PreEvent`: `a − ā`.
/// * `Polynomial`: `a − p(t)`, with p the least-squares fit of the samples.
/// * `Graizer`: `a − p′(t)` for t ≥ t₀, where p, with p(t₀) = 0, minimises the squares of `v − p`.
/// * `Boore2001`: a straight line `v₀ + a_f t` is fitted to the velocity after t₂; `a_f` is
///   subtracted after t₂, and `a_m = v_line(t₂)/(t₂ − t₁)` between t₁ and t₂. Both times are
///   rounded to samples; the value at such a sample is the mean of both sides, so that the
///   trapezoid rule on the result gives this velocity.
///
/// The velocity is the integral of the uncorrected record, from rest, by the trapezoid rule.
///
/// # Reference
/// Graizer (1979), Izv. Earth Physics 15, 771–775 (the constraint at t₀ is an addition of this
/// program: without it the derivative leaves a constant in the velocity). Iwan, Moser and Peng
/// (1985), BSSA 75, 1225–1246; Boore (2001), BSSA 91, 1199–1211, for free t₁ and t₂.
///
/// # Accuracy
/// Polynomials are built orthogonal on the samples (Forsythe 1957), so that degree 10 on a million
/// samples keeps ten digits; powers of t would have none left.
///
/// # Errors
/// A degree or a time outside its range, or too few samples for the degree.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::baseline::{Baseline, corrected}};
/// let drifting = Motion::new(0.01, (0..100).map(|k| 0.5 + 0.02 * f64::from(k)).collect())?;
/// let straight = corrected(&drifting, Baseline::Polynomial { degree: 1 })?;
/// assert!(straight.peak_m_s2() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn corrected(motion: &Motion, baseline: Baseline) -> Result<Motion, BaselineError> {
    let removed = match baseline {
        Baseline::Mean => vec![motion.mean_m_s2(); motion.accel_m_s2().len()],
        Baseline::PreEvent { until_s } => pre_event(motion, until_s)?,
        Baseline::Polynomial { degree } => polynomial(motion, degree)?,
        Baseline::Graizer { degree, from_s } => graizer(motion, degree, from_s)?,
        Baseline::Boore2001 { t1_s, t2_s } => two_offsets(motion, t1_s, t2_s)?,
    };
    let accel_m_s2 = motion
        .accel_m_s2()
        .iter()
        .zip(removed)
        .map(|(a, b)| a - b)
        .collect();
    Ok(Motion::new(motion.dt_s(), accel_m_s2)?)
}

fn pre_event(motion: &Motion, until_s: f64) -> Result<Vec<f64>, BaselineError> {
    let accel = motion.accel_m_s2();
    let duration_s = motion.duration_s();
    if !(until_s > 0.0 && until_s <= duration_s) {
        return Err(BaselineError::Time {
            name: "the quiet time",
            range: "within",
            duration_s,
            time_s: until_s,
        });
    }
    // Samples before that time; the tiny factor allows for a time that is a whole number of steps
    // except for its last bit.
    let quiet = (until_s / motion.dt_s() * (1.0 - 4.0 * f64::EPSILON)).ceil() as usize;
    Ok(vec![
        mean(&accel[..quiet.clamp(1, accel.len())]);
        accel.len()
    ])
}

fn polynomial(motion: &Motion, degree: usize) -> Result<Vec<f64>, BaselineError> {
    let accel = motion.accel_m_s2();
    check_degree(degree, 0, accel.len())?;
    let fit = Fit::new(
        degree,
        accel
            .iter()
            .enumerate()
            .map(|(k, &a)| (place(k, accel.len()), a, 1.0)),
    );
    Ok((0..accel.len())
        .map(|k| fit.value_and_slope(place(k, accel.len())).0)
        .collect())
}

fn graizer(motion: &Motion, degree: usize, from_s: f64) -> Result<Vec<f64>, BaselineError> {
    let (dt_s, accel) = (motion.dt_s(), motion.accel_m_s2());
    let duration_s = motion.duration_s();
    if !(from_s >= 0.0 && from_s < duration_s) {
        return Err(BaselineError::Time {
            name: "the start of the fit",
            range: "within",
            duration_s,
            time_s: from_s,
        });
    }
    let from = sample_near(from_s, dt_s, accel.len());
    let velocity = cumulative_trapezoid(dt_s, accel);
    let fitted = &velocity[from..];
    check_degree(degree, 1, fitted.len().saturating_sub(1))?;
    // p = τ q with τ = t − t₀: the least squares of v − τ q are those of v/τ − q with weights τ².
    let samples = fitted.iter().enumerate().skip(1).map(|(k, v)| {
        let tau_s = k as f64 * dt_s;
        (place(k, fitted.len()), v / tau_s, tau_s * tau_s)
    });
    let fit = Fit::new(degree - 1, samples);
    let span_s = (fitted.len() - 1) as f64 * dt_s;
    let mut removed = vec![0.0; accel.len()];
    for (k, removed) in removed[from..].iter_mut().enumerate() {
        let (q, slope) = fit.value_and_slope(place(k, fitted.len()));
        *removed = q + k as f64 * dt_s * slope * 2.0 / span_s;
    }
    // The sample at t₀ has a baseline on its right only.
    if from > 0 {
        removed[from] *= 0.5;
    }
    Ok(removed)
}

fn two_offsets(motion: &Motion, t1_s: f64, t2_s: f64) -> Result<Vec<f64>, BaselineError> {
    let (dt_s, accel) = (motion.dt_s(), motion.accel_m_s2());
    let duration_s = motion.duration_s();
    let wrong = |name, range, time_s| BaselineError::Time {
        name,
        range,
        duration_s,
        time_s,
    };
    if !(t1_s >= 0.0 && t1_s < duration_s) {
        return Err(wrong("t1", "within", t1_s));
    }
    let (first, second) = (
        sample_near(t1_s, dt_s, accel.len()),
        sample_near(t2_s, dt_s, accel.len()),
    );
    // A line through fewer than ten samples does not average anything.
    if !(t2_s < duration_s && second > first && accel.len() - second > MIN_AFTER) {
        return Err(wrong(
            "t2",
            "after t1, with ten samples after it, within",
            t2_s,
        ));
    }
    let velocity = cumulative_trapezoid(dt_s, accel);
    // The velocity at t₂ itself contains half a step of both offsets.
    let after = &velocity[second + 1..];
    let line = Fit::new(
        1,
        after
            .iter()
            .enumerate()
            .map(|(k, &v)| (place(k, after.len()), v, 1.0)),
    );
    let one_before = -1.0 - 2.0 / (after.len() - 1) as f64;
    let (at_second_m_s, slope) = line.value_and_slope(one_before);
    let final_m_s2 = slope * 2.0 / ((after.len() - 1) as f64 * dt_s);
    let strong_m_s2 = at_second_m_s / ((second - first) as f64 * dt_s);
    let mut removed = vec![0.0; accel.len()];
    removed[first..second].fill(strong_m_s2);
    removed[second..].fill(final_m_s2);
    if first > 0 {
        removed[first] = 0.5 * strong_m_s2;
    }
    removed[second] = 0.5 * (strong_m_s2 + final_m_s2);
    Ok(removed)
}

const MIN_AFTER: usize = 10;

fn check_degree(degree: usize, least: usize, samples: usize) -> Result<(), BaselineError> {
    if !(least..=MAX_DEGREE).contains(&degree) {
        return Err(BaselineError::Degree { least, degree });
    }
    if samples <= degree {
        return Err(BaselineError::TooShort { degree, samples });
    }
    Ok(())
}

/// Index of the sample nearest to a time.
fn sample_near(time_s: f64, dt_s: f64, samples: usize) -> usize {
    ((time_s / dt_s).round() as usize).min(samples - 1)
}

/// Position of sample `k` of `samples` on the interval from −1 to 1.
fn place(k: usize, samples: usize) -> f64 {
    2.0 * k as f64 / (samples - 1) as f64 - 1.0
}

/// A least-squares polynomial, as a sum of polynomials that are orthogonal on the samples:
/// `p₀ = 1`, `p_{k+1} = (x − α_k) p_k − β_k p_{k−1}`.
struct Fit {
    alpha: [f64; MAX_DEGREE + 1],
    beta: [f64; MAX_DEGREE + 1],
    coefficient: [f64; MAX_DEGREE + 1],
    degree: usize,
}

impl Fit {
    /// Fits samples (x, y, weight).
    fn new(degree: usize, samples: impl Iterator<Item = (f64, f64, f64)> + Clone) -> Self {
        let zeros = [0.0; MAX_DEGREE + 1];
        let mut fit = Self {
            alpha: zeros,
            beta: zeros,
            coefficient: zeros,
            degree: 0,
        };
        let mut norm_before = 0.0;
        for k in 0..=degree.min(MAX_DEGREE) {
            fit.degree = k;
            let (mut norm, mut moment, mut product) = (0.0, 0.0, 0.0);
            for (x, y, weight) in samples.clone() {
                let p = fit.last(x);
                norm += weight * p * p;
                moment += weight * x * p * p;
                // The residual of the lower degrees, which keeps more digits than y itself.
                product += weight * p * (y - fit.value_and_slope(x).0);
            }
            fit.coefficient[k] = product / norm;
            fit.alpha[k] = moment / norm;
            fit.beta[k] = if k == 0 { 0.0 } else { norm / norm_before };
            norm_before = norm;
        }
        fit
    }

    /// The polynomial of the highest degree so far.
    fn last(&self, x: f64) -> f64 {
        let (mut before, mut p) = (0.0, 1.0);
        for k in 0..self.degree {
            (before, p) = (p, (x - self.alpha[k]) * p - self.beta[k] * before);
        }
        p
    }

    fn value_and_slope(&self, x: f64) -> (f64, f64) {
        let (mut before, mut p) = ((0.0, 0.0), (1.0, 0.0));
        let (mut value, mut slope) = (self.coefficient[0], 0.0);
        for k in 0..self.degree {
            let next = (
                (x - self.alpha[k]) * p.0 - self.beta[k] * before.0,
                p.0 + (x - self.alpha[k]) * p.1 - self.beta[k] * before.1,
            );
            (before, p) = (p, next);
            value += self.coefficient[k + 1] * p.0;
            slope += self.coefficient[k + 1] * p.1;
        }
        (value, slope)
    }
}

#[cfg(test)]
mod tests;
