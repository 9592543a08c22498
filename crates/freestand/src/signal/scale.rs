//! The factor that scales a motion to a target.

use crate::motion::Motion;
use crate::oscillator::{OscillatorError, response_spectrum};
use thiserror::Error;

/// Why a motion cannot be scaled.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ScaleError {
    /// A target that is not positive and finite.
    #[error("the target must be positive and finite, not {target_m_s2} m/s²")]
    Target {
        /// The target that was given.
        target_m_s2: f64,
    },
    /// A motion of zeros, which no factor scales to a target.
    #[error("the motion has no response at T = {period_s} s: no factor scales it to a target")]
    NoResponse {
        /// The period \[s\]; 0 for the peak acceleration.
        period_s: f64,
    },
    /// A spectrum without periods, or with a number of values that differs from that of the
    /// periods.
    #[error(
        "the number of values of the target spectrum is {targets}, but the number of periods is {periods}"
    )]
    Shape {
        /// Number of periods.
        periods: usize,
        /// Number of values.
        targets: usize,
    },
    /// Invalid damping, or an invalid period.
    #[error(transparent)]
    Oscillator(#[from] OscillatorError),
}

/// A factor above this, or below its inverse, deserves a warning: the scaled record then represents
/// an earthquake of a very different size, which would have another duration and spectral shape.
/// This is a convention, not the limit of any model.
pub const LARGE_FACTOR: f64 = 10.0;

/// The factor that scales the largest |a| of the motion to `target_m_s2`.
///
/// # Errors
/// A target that is not positive and finite, or a motion of zeros.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::scale::factor_to_peak};
/// let motion = Motion::new(0.01, vec![0.0, -4.0, 1.0])?;
/// assert_eq!(factor_to_peak(&motion, 2.0)?, 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn factor_to_peak(motion: &Motion, target_m_s2: f64) -> Result<f64, ScaleError> {
    factor(motion.peak_m_s2(), target_m_s2, 0.0)
}

/// The factor that scales the pseudo-acceleration of the motion at one period to `target_m_s2`.
///
/// # Errors
/// Those of [`factor_to_peak`]; a negative period; damping outside 0 ≤ ζ < 1.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::scale::factor_to_sa};
/// let step = Motion::new(0.01, vec![1.0; 301])?;
/// // A sudden load is doubled by an undamped oscillator, at half its period.
/// assert!((factor_to_sa(&step, 2.0, 0.0, 3.0)? - 1.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn factor_to_sa(
    motion: &Motion,
    period_s: f64,
    damping_ratio: f64,
    target_m_s2: f64,
) -> Result<f64, ScaleError> {
    let spectrum = response_spectrum(motion, damping_ratio, &[period_s])?;
    factor(
        spectrum.psa_m_s2.first().copied().unwrap_or(0.0),
        target_m_s2,
        period_s,
    )
}

/// How well a scaled motion fits a target spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumFit {
    /// The factor.
    pub factor: f64,
    /// Root mean square of `ln(f PSA) − ln target` over the periods: 0 where both have the same
    /// shape.
    pub misfit_ln: f64,
}

/// The factor that brings the pseudo-acceleration spectrum of the motion closest to a target over
/// all `periods_s`: the least squares of `ln(f PSA) − ln target`,
/// `ln f = mean(ln target − ln PSA)`.
///
/// Every period has the same weight, so choose periods that are equally spaced in ln T.
///
/// # Errors
/// Those of [`factor_to_sa`]; no periods, or a number of target values that differs from that of
/// the periods.
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::scale::factor_to_spectrum};
/// let pulse = Motion::new(0.01, vec![0.0, 1.0, 0.0])?;
/// // At T = 0 the spectrum is the peak: the mean of targets of 2 and 8 is 4, in ln.
/// assert!((factor_to_spectrum(&pulse, 0.05, &[0.0, 0.0], &[2.0, 8.0])? - 4.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn factor_to_spectrum(
    motion: &Motion,
    damping_ratio: f64,
    periods_s: &[f64],
    target_m_s2: &[f64],
) -> Result<f64, ScaleError> {
    Ok(fit_to_spectrum(motion, damping_ratio, periods_s, target_m_s2)?.factor)
}

/// The factor of [`factor_to_spectrum`] and the misfit of the scaled spectrum.
///
/// # Errors
/// Those of [`factor_to_spectrum`].
///
/// # Example
/// ```
/// use freestand::{motion::Motion, signal::scale::fit_to_spectrum};
/// let pulse = Motion::new(0.01, vec![0.0, 1.0, 0.0])?;
/// // 4 is a factor of 2 from either target.
/// let fit = fit_to_spectrum(&pulse, 0.05, &[0.0, 0.0], &[2.0, 8.0])?;
/// assert!((fit.misfit_ln - 2f64.ln()).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fit_to_spectrum(
    motion: &Motion,
    damping_ratio: f64,
    periods_s: &[f64],
    target_m_s2: &[f64],
) -> Result<SpectrumFit, ScaleError> {
    if periods_s.is_empty() || periods_s.len() != target_m_s2.len() {
        return Err(ScaleError::Shape {
            periods: periods_s.len(),
            targets: target_m_s2.len(),
        });
    }
    let spectrum = response_spectrum(motion, damping_ratio, periods_s)?;
    let mut ratios_ln = Vec::with_capacity(periods_s.len());
    for ((&period_s, &psa), &target) in periods_s.iter().zip(&spectrum.psa_m_s2).zip(target_m_s2) {
        ratios_ln.push(factor(psa, target, period_s)?.ln());
    }
    let count = periods_s.len() as f64;
    let mean_ln = ratios_ln.iter().sum::<f64>() / count;
    let square = ratios_ln
        .iter()
        .map(|ln| (ln - mean_ln).powi(2))
        .sum::<f64>()
        / count;
    Ok(SpectrumFit {
        factor: mean_ln.exp(),
        misfit_ln: square.sqrt(),
    })
}

fn factor(response_m_s2: f64, target_m_s2: f64, period_s: f64) -> Result<f64, ScaleError> {
    if !(target_m_s2 > 0.0 && target_m_s2.is_finite()) {
        return Err(ScaleError::Target { target_m_s2 });
    }
    let factor = target_m_s2 / response_m_s2;
    // A response of 1e-320 has no finite inverse.
    if factor.is_finite() {
        Ok(factor)
    } else {
        Err(ScaleError::NoResponse { period_s })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion() -> Motion {
        Motion::new(
            0.02,
            (0..400)
                .map(|k| (f64::from(k * k % 37) - 18.0) * 0.1)
                .collect(),
        )
        .unwrap()
    }

    #[test]
    fn a_scaled_motion_meets_its_target() {
        let motion = motion();
        let psa = |motion: &Motion, periods: &[f64]| {
            response_spectrum(motion, 0.02, periods).unwrap().psa_m_s2
        };
        let scaled = motion
            .scaled(factor_to_sa(&motion, 0.7, 0.02, 1.5).unwrap())
            .unwrap();
        // The response is linear, so only a few roundings remain.
        assert!((psa(&scaled, &[0.7])[0] - 1.5).abs() < 1e-14);
        let scaled = motion
            .scaled(factor_to_peak(&motion, 0.25).unwrap())
            .unwrap();
        assert!((scaled.peak_m_s2() - 0.25).abs() < 1e-16);
        // To a spectrum of its own shape 3.5 times as high, and to any other with a mean misfit of
        // 0 in ln.
        let periods: Vec<f64> = (1..40).map(|i| 0.05 * f64::from(i)).collect();
        let own: Vec<f64> = psa(&motion, &periods).iter().map(|a| 3.5 * a).collect();
        assert!((factor_to_spectrum(&motion, 0.02, &periods, &own).unwrap() - 3.5).abs() < 1e-13);
        let target: Vec<f64> = periods.iter().map(|t| 2.0 / (0.3 + t)).collect();
        let scaled = motion
            .scaled(factor_to_spectrum(&motion, 0.02, &periods, &target).unwrap())
            .unwrap();
        let misfit: f64 = psa(&scaled, &periods)
            .iter()
            .zip(&target)
            .map(|(a, b)| (a / b).ln())
            .sum();
        assert!(misfit.abs() < 1e-12, "{misfit:e}");
        // The misfit is that of the scaled motion, and no other factor makes it smaller.
        let rms = |motion: &Motion| {
            let squares = psa(motion, &periods)
                .iter()
                .zip(&target)
                .map(|(a, b)| (a / b).ln().powi(2))
                .sum::<f64>();
            (squares / periods.len() as f64).sqrt()
        };
        let fit = fit_to_spectrum(&motion, 0.02, &periods, &target).unwrap();
        assert!(
            (fit.misfit_ln - rms(&scaled)).abs() < 1e-13 && fit.misfit_ln > 0.1,
            "{fit:?}"
        );
        for other in [0.99, 1.01] {
            assert!(rms(&scaled.scaled(other).unwrap()) > fit.misfit_ln);
        }
        // The same shape: only the rounding of 39 ratios near 3.5 remains.
        assert!(
            fit_to_spectrum(&motion, 0.02, &periods, &own)
                .unwrap()
                .misfit_ln
                < 1e-13
        );
    }

    #[test]
    fn targets_that_cannot_be_met_are_refused() {
        let (motion, zeros) = (motion(), Motion::new(0.02, vec![0.0; 9]).unwrap());
        for target in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                factor_to_peak(&motion, target),
                Err(ScaleError::Target { .. })
            ));
            assert!(matches!(
                factor_to_sa(&motion, 1.0, 0.05, target),
                Err(ScaleError::Target { .. })
            ));
        }
        assert!(matches!(
            factor_to_peak(&zeros, 1.0),
            Err(ScaleError::NoResponse { .. })
        ));
        assert!(matches!(
            factor_to_sa(&zeros, 1.0, 0.05, 1.0),
            Err(ScaleError::NoResponse { .. })
        ));
        assert!(matches!(
            factor_to_sa(&motion, -1.0, 0.05, 1.0),
            Err(ScaleError::Oscillator(_))
        ));
        for (periods, targets) in [(&[][..], &[][..]), (&[1.0][..], &[1.0, 2.0][..])] {
            let refused = factor_to_spectrum(&motion, 0.05, periods, targets);
            assert!(matches!(refused, Err(ScaleError::Shape { .. })));
        }
    }
}
