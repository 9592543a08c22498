//! Velocity pulses as they are recorded near faults, and motions to which one is added.

use std::f64::consts::{PI, TAU};

use super::SynthesisOptions;
use super::frame::Frame;
use crate::motion::{Motion, MotionError};

/// Samples in one period of a pulse alone: its oscillators need ten in theirs, and the shortest of them has
/// 0.05 of its period.
const SAMPLES: f64 = 200.0;
/// Zeros after a pulse alone, in its periods: half a period of the longest oscillator that is asked of it.
const TAIL: f64 = 10.0;

/// The velocity pulse of Mavroeidis and Papageorgiou (2003), less the part that would leave a displacement.
///
/// v(u) = V w(u) \[cos(2πu/T + ν) − c\], w(u) = ½ \[1 + cos(2πu/(γT))\], |u| ≤ γT/2,
///
/// c = −cos ν sin(πγ) / (πγ(γ² − 1))
///
/// u is the time from its centre. Velocity, acceleration and displacement are zero at both ends: c takes the
/// displacement A T cos ν sin(πγ)/(2π(γ² − 1)) of the original away, spread as w is, and is at most 0.05 for γ ≥ 2.
///
/// # Reference
/// Mavroeidis and Papageorgiou (2003), "A mathematical representation of near-fault ground motions", BSSA 93(3),
/// Eq. (1); Dabaghi and Der Kiureghian (2014), PEER 2014/16, for the zero displacement. Recalled, except for the form of
/// v(u), which was read in a public program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VelocityPulse {
    /// T: its period \[s\].
    pub period_s: f64,
    /// γ: its length over its period, above 1.
    pub cycles: f64,
    /// ν: its phase at the centre \[rad\].
    pub phase_rad: f64,
}

impl VelocityPulse {
    /// How long it lasts \[s\].
    pub fn duration_s(&self) -> f64 {
        self.cycles * self.period_s
    }

    /// c: what takes the displacement away, over the amplitude.
    fn offset_ratio(&self) -> f64 {
        let cycles = self.cycles;
        -self.phase_rad.cos() * (PI * cycles).sin() / (PI * cycles * (cycles * cycles - 1.0))
    }

    /// The velocity at a time from the centre, over the amplitude V.
    ///
    /// # Example
    /// ```
    /// use freestand::synthesis::VelocityPulse;
    /// let pulse = VelocityPulse { period_s: 2.0, cycles: 2.0, phase_rad: 0.0 };
    /// assert_eq!(pulse.velocity_ratio(0.0), 1.0);
    /// assert_eq!(pulse.velocity_ratio(-2.0), 0.0);
    /// ```
    pub fn velocity_ratio(&self, from_centre_s: f64) -> f64 {
        if from_centre_s.abs() >= 0.5 * self.duration_s() {
            return 0.0;
        }
        let window = 0.5 + 0.5 * (TAU * from_centre_s / self.duration_s()).cos();
        let phase = TAU * from_centre_s / self.period_s + self.phase_rad;
        window * (phase.cos() - self.offset_ratio())
    }

    /// The acceleration at a time from the centre, over the amplitude V \[1/s\].
    pub fn accel_per_s(&self, from_centre_s: f64) -> f64 {
        if from_centre_s.abs() >= 0.5 * self.duration_s() {
            return 0.0;
        }
        let rate = TAU / self.duration_s();
        let (sin, cos) = (rate * from_centre_s).sin_cos();
        let phase = TAU * from_centre_s / self.period_s + self.phase_rad;
        -0.5 * rate * sin * (phase.cos() - self.offset_ratio())
            - (0.5 + 0.5 * cos) * TAU / self.period_s * phase.sin()
    }

    /// The pulse with an amplitude of 1 m/s and nothing else, with quiet after it.
    ///
    /// # Errors
    /// A period or a number of cycles that is no positive number.
    pub fn alone(&self) -> Result<Motion, MotionError> {
        let steps = (self.cycles * SAMPLES).ceil();
        let dt_s = self.duration_s() / steps;
        let at = |k: usize| self.accel_per_s((k as f64 - 0.5 * steps) * dt_s);
        let samples = (0..=steps as usize).map(at).collect();
        Motion::new(dt_s, samples)?.with_zero_tail(TAIL * self.period_s)
    }
}

/// A motion of [`synthesize`](super::synthesize) to which a pulse of this amplitude is added, of either sign
/// \[m/s\].
///
/// The pulse is early, as those of forward directivity are: its centre is at the peak of the window of the noise, or,
/// if it is long, it begins with the shaking. Rounding apart, the final velocity and displacement stay zero.
///
/// # Errors
/// A pulse whose numbers have no end.
pub fn with_pulse(
    motion: &Motion,
    pulse: &VelocityPulse,
    amplitude_m_s: f64,
    options: &SynthesisOptions,
) -> Result<Motion, MotionError> {
    let dt_s = motion.dt_s();
    let centre_s =
        options.lead_in_s + (WINDOW_PEAK_RATIO * options.envelope_s).max(0.5 * pulse.duration_s());
    let mut accel = motion.accel_m_s2().to_vec();
    for (k, a) in accel.iter_mut().enumerate() {
        *a += amplitude_m_s * pulse.accel_per_s(k as f64 * dt_s - centre_s);
    }
    let samples = |time_s: f64| (time_s / dt_s).round() as usize;
    let start = samples(options.lead_in_s);
    let end = (start + samples(options.shaking_s)).min(accel.len().saturating_sub(1));
    Frame::new(accel.len(), start, end, 1, 1).remove_drift(&mut accel);
    Motion::new(dt_s, accel)
}

/// Where the window e^(−2.4t/T_d) − e^(−7.2t/T_d) has its peak: ln 3/4.8 of T_d.
const WINDOW_PEAK_RATIO: f64 = 0.228_877_560_139_189_2;

#[cfg(test)]
mod tests;
