//! A taper: the motion fades in and out.

use crate::motion::{Motion, MotionError};
use std::f64::consts::PI;
use thiserror::Error;

/// Why a motion cannot be tapered.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TaperError {
    /// A share that is not above 0, or is above one half.
    #[error(
        "the share of a taper at each end must be above 0 and at most one half, not {share_ratio}"
    )]
    Share {
        /// The share that was given.
        share_ratio: f64,
    },
    /// The result is not a valid motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// The motion multiplied by a cosine (Tukey) window: `½ (1 − cos(π t/t_r))` over
/// `t_r = share_ratio` times its duration at each end, and 1 between. The first and the last sample
/// become zero.
///
/// # Reference
/// Tukey (1967); `scipy.signal.windows.tukey(n, 2 * share_ratio)`.
///
/// # Errors
/// A share that is not above 0, or is above ½.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::taper::tapered};
/// let motion = tapered(&Motion::new(0.01, vec![2.0; 9])?, 0.25)?;
/// assert!((motion.accel_m_s2()[1] - 1.0).abs() < 1e-15); // halfway up after an eighth
/// let accel = motion.accel_m_s2();
/// assert_eq!((accel[0], accel[4], accel[8]), (0.0, 2.0, 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn tapered(motion: &Motion, share_ratio: f64) -> Result<Motion, TaperError> {
    if !(share_ratio > 0.0 && share_ratio <= 0.5) {
        return Err(TaperError::Share { share_ratio });
    }
    let accel = motion.accel_m_s2();
    let last = accel.len() - 1;
    let ramp = share_ratio * last as f64;
    let weight = |k: usize| {
        let from_end = k.min(last - k) as f64;
        if from_end < ramp {
            0.5 * (1.0 - (PI * from_end / ramp).cos())
        } else {
            1.0
        }
    };
    Ok(Motion::new(
        motion.dt_s(),
        accel
            .iter()
            .enumerate()
            .map(|(k, a)| a * weight(k))
            .collect(),
    )?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_is_that_of_scipy() {
        // scipy 1.17.1: scipy.signal.windows.tukey(12, 2 * share)
        let cases: [(f64, [f64; 6]); 3] = [
            (0.1, [0.0, 0.9797464868072487, 1.0, 1.0, 1.0, 1.0]),
            (
                0.25,
                [0.0, 0.29229249349905684, 0.8274303669726426, 1.0, 1.0, 1.0],
            ),
            (
                0.5,
                [
                    0.0,
                    0.07937323358440945,
                    0.29229249349905684,
                    0.5711574191366425,
                    0.8274303669726426,
                    0.9797464868072487,
                ],
            ),
        ];
        for (share, want) in cases {
            let motion = tapered(&Motion::new(0.01, vec![1.0; 12]).unwrap(), share).unwrap();
            let accel = motion.accel_m_s2();
            for (k, want) in want.into_iter().enumerate() {
                // One cosine, and the asymmetry of SciPy's own result.
                assert!(
                    (accel[k] - want).abs() < 1e-15 && accel[k] == accel[11 - k],
                    "{share} {k} {}",
                    accel[k]
                );
            }
        }
    }

    #[test]
    fn shares_that_are_none_are_refused() {
        let motion = Motion::new(0.01, vec![1.0; 12]).unwrap();
        for share_ratio in [0.0, -0.05, 0.500001, 5.0, f64::NAN] {
            assert!(
                matches!(tapered(&motion, share_ratio), Err(TaperError::Share { .. })),
                "{share_ratio}"
            );
        }
    }
}
