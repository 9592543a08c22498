//! An acceleration history: equally spaced samples, linear between them.

use thiserror::Error;

use crate::vector::largest;

/// Base acceleration against time: equally spaced samples, linear between them; the first sample is
/// at t = 0.
///
/// **Units**: seconds and m/s². A `Motion` always holds at least two samples, all of them finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    dt_s: f64,
    accel_m_s2: Vec<f64>,
}

/// The largest number of samples that a motion may have: a guard against absurd time steps and
/// tails.
pub const MAX_SAMPLES: usize = 100_000_000;

/// Why samples do not define a [`Motion`].
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MotionError {
    /// The time step is not a positive finite number.
    #[error("the time step must be positive and finite, not {dt_s} s")]
    TimeStep {
        /// The step that was given.
        dt_s: f64,
    },
    /// A single sample has no duration.
    #[error("a motion needs at least 2 samples, not {samples}")]
    TooShort {
        /// Number of samples that were given.
        samples: usize,
    },
    /// More samples than [`MAX_SAMPLES`].
    #[error("{samples:.0} samples exceed the {MAX_SAMPLES} that a motion may have")]
    TooLong {
        /// Number of samples that the motion would have.
        samples: f64,
    },
    /// A sample is NaN or infinite.
    #[error("sample {index} (counted from 0) is {value}, not a finite acceleration")]
    NotFinite {
        /// Index of the first such sample, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
}

impl Motion {
    /// A motion with samples `accel_m_s2` at intervals of `dt_s` seconds.
    ///
    /// # Errors
    /// A time step that is not positive and finite, fewer than two samples, or a sample that is not
    /// finite.
    ///
    /// # Example
    /// ```
    /// let motion = freestand_rocking::motion::Motion::new(0.5, vec![0.0, -2.0, 1.0])?;
    /// assert_eq!(motion.duration_s(), 1.0);
    /// assert_eq!(motion.peak_m_s2(), 2.0);
    /// # Ok::<(), freestand_rocking::motion::MotionError>(())
    /// ```
    pub fn new(dt_s: f64, accel_m_s2: Vec<f64>) -> Result<Self, MotionError> {
        if !(dt_s > 0.0 && dt_s.is_finite()) {
            return Err(MotionError::TimeStep { dt_s });
        }
        if accel_m_s2.len() < 2 {
            return Err(MotionError::TooShort {
                samples: accel_m_s2.len(),
            });
        }
        // Without a way out the loop is one of vectors.
        let is_finite = accel_m_s2.iter().fold(true, |all, a| all & a.is_finite());
        if !is_finite && let Some(index) = accel_m_s2.iter().position(|a| !a.is_finite()) {
            return Err(MotionError::NotFinite {
                index,
                value: accel_m_s2[index],
            });
        }
        Ok(Self { dt_s, accel_m_s2 })
    }

    /// Time between samples \[s\].
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// The samples \[m/s²\].
    pub fn accel_m_s2(&self) -> &[f64] {
        &self.accel_m_s2
    }

    /// Time of the last sample \[s\].
    pub fn duration_s(&self) -> f64 {
        (self.accel_m_s2.len() - 1) as f64 * self.dt_s
    }

    /// Largest absolute sample (PGA of a ground motion, PFA of a floor motion) \[m/s²\].
    pub fn peak_m_s2(&self) -> f64 {
        largest(&self.accel_m_s2, f64::abs).max(0.0)
    }

    /// Mean of the samples, `Σ aₖ/n`: the zero line of a record that swings evenly about
    /// it \[m/s²\].
    ///
    /// # Example
    /// ```
    /// let motion = freestand_rocking::motion::Motion::new(0.5, vec![1.0, -2.0, 4.0])?;
    /// assert_eq!(motion.mean_m_s2(), 1.0);
    /// # Ok::<(), freestand_rocking::motion::MotionError>(())
    /// ```
    pub fn mean_m_s2(&self) -> f64 {
        mean(&self.accel_m_s2)
    }

    /// Acceleration at any time: linear between samples, zero outside them \[m/s²\].
    pub fn at_m_s2(&self, time_s: f64) -> f64 {
        let position = time_s / self.dt_s;
        if !(0.0..=(self.accel_m_s2.len() - 1) as f64).contains(&position) {
            return 0.0;
        }
        let index = (position as usize).min(self.accel_m_s2.len() - 2);
        let (from, to) = (self.accel_m_s2[index], self.accel_m_s2[index + 1]);
        from + (to - from) * (position - index as f64)
    }

    /// The motion multiplied by `factor`.
    ///
    /// # Errors
    /// A factor that makes a sample infinite or NaN.
    pub fn scaled(&self, factor: f64) -> Result<Self, MotionError> {
        Self::new(
            self.dt_s,
            self.accel_m_s2.iter().map(|a| a * factor).collect(),
        )
    }

    /// The same motion with `factor` samples in place of each, linear between the old ones, as a
    /// motion is by definition; factors of 0 and 1 change nothing.
    ///
    /// A response to it has the same values at the old samples, and its peaks are also searched for
    /// between them. For the values that a digitised record had between its samples, use
    /// `freestand::signal::resample::upsampled_sinc`.
    pub fn upsampled(&self, factor: usize) -> Self {
        let factor = factor.max(1);
        let mut accel_m_s2 = Vec::with_capacity((self.accel_m_s2.len() - 1) * factor + 1);
        for pair in self.accel_m_s2.windows(2) {
            for i in 0..factor {
                let share = i as f64 / factor as f64;
                accel_m_s2.push(pair[0] * (1.0 - share) + pair[1] * share);
            }
        }
        accel_m_s2.extend(self.accel_m_s2.last());
        Self {
            dt_s: self.dt_s / factor as f64,
            accel_m_s2,
        }
    }

    /// The motion followed by zeros for at least `tail_s` ≥ 0 seconds.
    ///
    /// # Errors
    /// A tail that makes the motion longer than [`MAX_SAMPLES`], or that is negative or not finite.
    pub fn with_zero_tail(&self, tail_s: f64) -> Result<Self, MotionError> {
        let extra = (tail_s / self.dt_s).ceil();
        let samples = self.accel_m_s2.len() as f64 + extra;
        if !(extra >= 0.0 && samples <= MAX_SAMPLES as f64) {
            return Err(MotionError::TooLong { samples });
        }
        let extra = extra as usize;
        let mut accel_m_s2 = Vec::with_capacity(self.accel_m_s2.len() + extra);
        accel_m_s2.extend_from_slice(&self.accel_m_s2);
        accel_m_s2.resize(self.accel_m_s2.len() + extra, 0.0);
        Ok(Self {
            dt_s: self.dt_s,
            accel_m_s2,
        })
    }
}

/// The mean of one or more values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_that_of_all_samples_and_scales_with_them() {
        let motion = Motion::new(0.01, vec![0.5, -3.0, 0.25, 4.25]).unwrap();
        // 2/4: binary fractions, so that no sum is rounded.
        assert_eq!(
            (motion.mean_m_s2(), motion.scaled(-2.0).unwrap().mean_m_s2()),
            (0.5, -1.0)
        );
        assert_eq!(motion.with_zero_tail(0.04).unwrap().mean_m_s2(), 0.25);
    }
}
