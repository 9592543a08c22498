//! The classical pulses of shock tests.

use std::f64::consts::PI;

use thiserror::Error;

use crate::motion::{Motion, MotionError};

use super::{
    ResponseKind, ShockResponseError, ShockSpectrum, ShockSpectrumOptions, shock_spectrum,
};

/// The shape of a pulse; s = t/T.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PulseShape {
    /// A sin πs.
    HalfSine,
    /// A sin² πs, a raised cosine.
    Haversine,
    /// A(1 − s).
    InitialPeakSawtooth,
    /// A s.
    TerminalPeakSawtooth,
    /// A.
    Rectangle,
    /// Rises to A in the first tenth of the duration and falls in the last tenth.
    Trapezoid,
}

impl PulseShape {
    /// All shapes.
    pub const ALL: [Self; 6] = [
        Self::HalfSine,
        Self::Haversine,
        Self::InitialPeakSawtooth,
        Self::TerminalPeakSawtooth,
        Self::Rectangle,
        Self::Trapezoid,
    ];

    /// Mean acceleration divided by the peak.
    fn mean_ratio(self) -> f64 {
        match self {
            Self::HalfSine => 2.0 / PI,
            Self::Haversine | Self::InitialPeakSawtooth | Self::TerminalPeakSawtooth => 0.5,
            Self::Rectangle => 1.0,
            Self::Trapezoid => 1.0 - TRAPEZOID_RISE,
        }
    }

    /// Acceleration divided by its peak at s; where it jumps, the mean of both sides.
    fn ratio(self, s: f64) -> f64 {
        if !(0.0..=1.0).contains(&s) {
            return 0.0;
        }
        let ratio = match self {
            Self::HalfSine => (PI * s).sin(),
            Self::Haversine => (PI * s).sin().powi(2),
            Self::InitialPeakSawtooth => 1.0 - s,
            Self::TerminalPeakSawtooth => s,
            Self::Rectangle => 1.0,
            Self::Trapezoid => (s.min(1.0 - s) / TRAPEZOID_RISE).min(1.0),
        };
        let jumps = match self {
            Self::InitialPeakSawtooth => s == 0.0,
            Self::TerminalPeakSawtooth => s == 1.0,
            Self::Rectangle => s == 0.0 || s == 1.0,
            _ => false,
        };
        if jumps { 0.5 * ratio } else { ratio }
    }
}

/// Share of its duration during which a trapezoid rises, and falls.
const TRAPEZOID_RISE: f64 = 0.1;

/// A pulse of base acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    shape: PulseShape,
    peak_acceleration_m_s2: f64,
    duration_s: f64,
}

/// Why a [`Pulse`] cannot be created.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PulseError {
    /// A peak that is zero or not finite.
    #[error("the peak of a pulse must be finite and not zero, not {peak_acceleration_m_s2} m/s²")]
    Peak {
        /// The peak that was given.
        peak_acceleration_m_s2: f64,
    },
    /// A duration that is not positive and finite.
    #[error("the duration of a pulse must be positive and finite, not {duration_s} s")]
    Duration {
        /// The duration that was given.
        duration_s: f64,
    },
}

impl Pulse {
    /// A pulse with a peak, which may be negative, and a duration.
    ///
    /// # Errors
    /// A peak that is zero or not finite, or a duration that is not positive and finite.
    ///
    /// # Example
    /// 30 g for 11 ms, the half-sine of many data sheets: 2AT/π = 2.06 m/s.
    /// ```
    /// use freestand::shock_response::{Pulse, PulseShape};
    /// let pulse = Pulse::new(PulseShape::HalfSine, 30.0 * freestand::G0_M_S2, 0.011)?;
    /// assert!((pulse.velocity_change_m_s() - 2.0602).abs() < 1e-4);
    /// # Ok::<(), freestand::shock_response::PulseError>(())
    /// ```
    pub fn new(
        shape: PulseShape,
        peak_acceleration_m_s2: f64,
        duration_s: f64,
    ) -> Result<Self, PulseError> {
        if !(peak_acceleration_m_s2.is_finite() && peak_acceleration_m_s2 != 0.0) {
            return Err(PulseError::Peak {
                peak_acceleration_m_s2,
            });
        }
        if !(duration_s > 0.0 && duration_s.is_finite()) {
            return Err(PulseError::Duration { duration_s });
        }
        Ok(Self {
            shape,
            peak_acceleration_m_s2,
            duration_s,
        })
    }

    /// The shape.
    pub fn shape(&self) -> PulseShape {
        self.shape
    }

    /// Peak acceleration A \[m/s²\].
    pub fn peak_acceleration_m_s2(&self) -> f64 {
        self.peak_acceleration_m_s2
    }

    /// Duration T \[s\].
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Acceleration at a time from the start of the pulse \[m/s²\]; where it jumps, the mean of
    /// both sides.
    pub fn acceleration_m_s2(&self, time_s: f64) -> f64 {
        self.peak_acceleration_m_s2 * self.shape.ratio(time_s / self.duration_s)
    }

    /// The integral of the pulse \[m/s\]: half-sine 2AT/π, haversine and sawtooths AT/2, rectangle
    /// AT, trapezoid 0.9 AT.
    pub fn velocity_change_m_s(&self) -> f64 {
        self.shape.mean_ratio() * self.peak_acceleration_m_s2 * self.duration_s
    }

    /// The pulse as samples, with `steps` (at least 1) over its duration. Corners are on samples
    /// where `steps` is a multiple of 10. A jump becomes a straight line over two steps, centred on
    /// the jump, so that the velocity change does not change.
    ///
    /// # Errors
    /// More samples than a motion may have.
    pub fn sampled(&self, steps: usize) -> Result<Motion, MotionError> {
        let steps = steps.max(1);
        let sample =
            |k: usize| self.peak_acceleration_m_s2 * self.shape.ratio(k as f64 / steps as f64);
        Motion::new(
            self.duration_s / steps as f64,
            (0..=steps).map(sample).collect(),
        )
    }
}

/// Smallest number of steps of a pulse: the straight lines between samples reduce a half-sine by
/// (π/2000)²/12 = 2e-7.
const STEPS: f64 = 2000.0;
/// Samples per period of the fastest oscillator: its peak is missed by at most 1 − cos(π/512) =
/// 2e-5.
const STEPS_PER_PERIOD: f64 = 512.0;
/// Largest number of steps of a pulse.
const MAX_STEPS: f64 = 4e6;

/// Shock response spectrum of a pulse, sampled finely enough for the highest of the frequencies.
///
/// # Accuracy
/// 6e-5 of the peak where f T is below 8000; above that, see [`ShockSpectrum::samples_per_period`].
///
/// # Errors
/// Those of [`shock_spectrum`].
///
/// # Example
/// A rectangular pulse is doubled by stiff components without damping:
/// ```
/// use freestand::shock_response::{Peak, Pulse, PulseShape, ResponseKind, pulse_spectrum};
/// let rectangle = Pulse::new(PulseShape::Rectangle, 1.0, 0.01)?;
/// let kind = ResponseKind::AbsoluteAcceleration;
/// let spectrum = pulse_spectrum(&rectangle, &[50.0, 200.0], kind, 0.0)?;
/// assert!(spectrum.peaks.iter().all(|one| (one.peak(Peak::Maximax) - 2.0).abs() < 1e-4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn pulse_spectrum(
    pulse: &Pulse,
    frequencies_hz: &[f64],
    kind: ResponseKind,
    damping_ratio: f64,
) -> Result<ShockSpectrum, ShockResponseError> {
    let highest_hz = frequencies_hz.iter().copied().fold(0.0, f64::max);
    let needed = (STEPS_PER_PERIOD * highest_hz * pulse.duration_s).clamp(STEPS, MAX_STEPS);
    let steps = 10 * (needed / 10.0).ceil() as usize;
    let options = ShockSpectrumOptions {
        kind,
        damping_ratio,
        upsample: false,
    };
    let overflow = ShockResponseError::Overflow {
        frequency_hz: highest_hz,
    };
    let motion = pulse.sampled(steps).map_err(|_| overflow)?;
    shock_spectrum(&motion, frequencies_hz, options)
}

#[cfg(test)]
mod tests {
    use super::super::Peak;
    use super::*;

    /// The closed forms of the velocity change agree with the sum of the samples.
    #[test]
    fn velocity_change_is_the_integral() {
        for shape in PulseShape::ALL {
            let pulse = Pulse::new(shape, -300.0, 0.006).unwrap();
            let motion = pulse.sampled(4000).unwrap();
            let accel = motion.accel_m_s2();
            // Straight lines between samples and to zero beyond the ends.
            let sum: f64 = accel.iter().sum::<f64>() * motion.dt_s();
            // A half-sine of 4000 straight lines lacks (π/4000)²/12 = 5e-8 of its area.
            assert!(
                (sum / pulse.velocity_change_m_s() - 1.0).abs() < 1e-7,
                "{shape:?}"
            );
        }
    }

    #[test]
    fn a_pulse_has_its_peak_and_nothing_outside() {
        for shape in PulseShape::ALL {
            let pulse = Pulse::new(shape, 2.0, 4.0).unwrap();
            let peak = pulse.sampled(1000).unwrap().peak_m_s2();
            // A sawtooth reaches its peak one sample from its jump.
            assert!((peak - 2.0).abs() <= 2.1e-3, "{shape:?}: {peak}");
            assert_eq!(
                (
                    pulse.acceleration_m_s2(-1e-9),
                    pulse.acceleration_m_s2(4.0 + 1e-9)
                ),
                (0.0, 0.0)
            );
        }
        assert!(Pulse::new(PulseShape::Rectangle, 0.0, 1.0).is_err());
        assert!(Pulse::new(PulseShape::Rectangle, 1.0, f64::NAN).is_err());
    }

    /// Undamped, after any pulse: ω |∫ a(t) e^(iωt) dt|.
    #[test]
    fn residual_is_the_transform_of_the_pulse() {
        for shape in PulseShape::ALL {
            let pulse = Pulse::new(shape, 1.0, 0.011).unwrap();
            let frequencies = [3.0, 40.0, 91.0, 133.3, 500.0];
            let spectrum = pulse_spectrum(
                &pulse,
                &frequencies,
                ResponseKind::AbsoluteAcceleration,
                0.0,
            )
            .unwrap();
            for (f, peaks) in frequencies.iter().zip(&spectrum.peaks) {
                // Midpoint rule with 200 000 parts: jumps and corners are between the points.
                let omega = 2.0 * PI * f;
                let (mut cos, mut sin) = (0.0, 0.0);
                let h = 0.011 / 2e5;
                for k in 0..200_000 {
                    let t = h * (f64::from(k) + 0.5);
                    let a = pulse.acceleration_m_s2(t);
                    (cos, sin) = (
                        cos + a * (omega * t).cos() * h,
                        sin + a * (omega * t).sin() * h,
                    );
                }
                let expected = omega * f64::hypot(cos, sin);
                let residual = peaks.peak(Peak::Residual);
                // Jumps extend over two of at least 512 steps per period: (2π/512)²/6 = 2.5e-5 of
                // each, and a pulse has two at most.
                assert!(
                    (residual - expected).abs() < 6e-5,
                    "{shape:?} at {f}: {residual} {expected}"
                );
            }
        }
    }
}
