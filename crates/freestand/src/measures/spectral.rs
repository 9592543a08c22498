//! Measures from response and Fourier spectra.

use std::f64::consts::TAU;

use rustfft::FftPlannerScalar;
use rustfft::num_complex::Complex;

use crate::motion::Motion;
use crate::oscillator::{DAMPING_RATIO, response_spectrum};

/// Measures of the frequency content of a motion; 5 % damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectralMeasures {
    /// Housner's spectrum intensity, SI = ∫ PSV dT from 0.1 s to 2.5 s \[m\].
    pub housner_m: f64,
    /// Acceleration spectrum intensity, ASI = ∫ PSA dT from 0.1 s to 0.5 s \[m/s\].
    pub asi_m_s: f64,
    /// Mean period Tm, [`mean_period_s`] \[s\].
    pub mean_period_s: Option<f64>,
    /// Predominant period: the period of the largest PSA from 0.05 s to 5 s, to 3 % \[s\]; `None`
    /// for a motion of zeros.
    pub predominant_period_s: Option<f64>,
}

/// Number of periods for each factor of 5, evenly spaced in the logarithm.
const PER_FACTOR: i32 = 60;
/// The period of step 0 \[s\]; that of step 60 is 0.5 s, that of step 120 is 2.5 s.
const FIRST_S: f64 = 0.1;
/// The steps of the periods from 0.05 s to 5 s.
const STEPS: std::ops::RangeInclusive<i32> = -26..=146;

/// The [`SpectralMeasures`] of a motion.
///
/// SI and ASI are integrals by the trapezoid rule in ln T, on 121 and 61 periods, each 2.7 % longer
/// than the one before, with peaks at the samples. SI over this range is also called VSI.
///
/// # Reference
/// Housner (1952), "Spectrum intensities of strong-motion earthquakes"; Von Thun, Roehm, Scott and
/// Wilson (1988) for the ASI; Rathje, Abrahamson and Bray (1998) for Tm.
///
/// # Accuracy
/// Compared with periods every 0.0005 s the rule is wrong by less than 7e-4 for five recorded
/// earthquakes (El Centro 1940, Imperial Valley 1979, Loma Prieta, Northridge, Tabas).
///
/// # Limitation
/// At periods below ten time steps the peaks between samples are missed; with steps above 0.01 s
/// this affects the lower end of SI and ASI.
///
/// # Example
/// ```
/// use freestand::{measures::spectral_measures, motion::Motion};
/// let phase = |i: i32| std::f64::consts::TAU * 0.01 * f64::from(i) / 0.5;
/// let sine = (0..2000).map(|i| phase(i).sin()).collect();
/// let m = spectral_measures(&Motion::new(0.01, sine)?);
/// assert!(m.predominant_period_s.is_some_and(|period_s| (period_s / 0.5 - 1.0).abs() < 0.03));
/// # Ok::<(), freestand::motion::MotionError>(())
/// ```
pub fn spectral_measures(motion: &Motion) -> SpectralMeasures {
    let periods_s: Vec<f64> = STEPS.map(period_s).collect();
    // The periods and the damping are those above and a motion's time step is positive, so there is
    // no error.
    let sd_m = response_spectrum(motion, DAMPING_RATIO, &periods_s)
        .map(|spectrum| spectrum.sd_m)
        .unwrap_or_default();
    let power = |n: i32| -> Vec<f64> {
        periods_s
            .iter()
            .zip(&sd_m)
            .map(|(t, sd)| (TAU / t).powi(n) * sd)
            .collect()
    };
    let (psv_m_s, psa_m_s2) = (power(1), power(2));
    let largest = psa_m_s2.iter().copied().fold(0.0, f64::max);
    let at = psa_m_s2.iter().position(|&psa| psa == largest && psa > 0.0);
    SpectralMeasures {
        housner_m: integral(&periods_s, &psv_m_s, 2),
        asi_m_s: integral(&periods_s, &psa_m_s2, 1),
        mean_period_s: mean_period_s(motion),
        predominant_period_s: at.and_then(|i| periods_s.get(i).copied()),
    }
}

fn period_s(step: i32) -> f64 {
    FIRST_S * 5f64.powf(f64::from(step) / f64::from(PER_FACTOR))
}

/// ∫ dT from 0.1 s over this many factors of 5.
fn integral(periods_s: &[f64], values: &[f64], factors: i32) -> f64 {
    let width = 5f64.ln() / f64::from(PER_FACTOR);
    let steps = STEPS.zip(periods_s.iter().zip(values));
    let within: Vec<f64> = steps
        .filter(|(step, _)| (0..=factors * PER_FACTOR).contains(step))
        .map(|(_, (t, value))| t * value)
        .collect();
    width
        * within
            .windows(2)
            .map(|pair| 0.5 * (pair[0] + pair[1]))
            .sum::<f64>()
}

/// Largest spacing of the frequencies in the mean period \[Hz\].
const RESOLUTION_HZ: f64 = 0.05;

/// Mean period Tm = Σ C²/f / Σ C² over 0.25 Hz ≤ f ≤ 20 Hz, with C the Fourier amplitudes of the
/// acceleration \[s\]; `None` where the motion has no content in that band.
///
/// The transform is that of the motion itself; a motion shorter than 20 s is extended to 20 s with
/// zeros, so that the frequencies are no more than 0.05 Hz apart, as Rathje et al. (2004) require.
///
/// # Reference
/// Rathje, Abrahamson and Bray (1998), "Simplified frequency content estimates of earthquake ground
/// motions", J. Geotech. Geoenviron. Eng. 124; Rathje, Faraj, Russell and Bray (2004), Earthquake
/// Spectra 20.
pub fn mean_period_s(motion: &Motion) -> Option<f64> {
    let accel = motion.accel_m_s2();
    // A time step of microseconds would require millions of zeros; the limit makes the resolution
    // coarser there.
    let at_least = (1.0 / (RESOLUTION_HZ * motion.dt_s())).ceil().min(4e6) as usize;
    let count = accel.len().max(at_least);
    let mut spectrum: Vec<Complex<f64>> = accel.iter().map(|&a| Complex::new(a, 0.0)).collect();
    spectrum.resize(count, Complex::new(0.0, 0.0));
    // Without vector instructions, whose last bits differ between processors.
    FftPlannerScalar::new()
        .plan_fft_forward(count)
        .process(&mut spectrum);
    let df_hz = 1.0 / (count as f64 * motion.dt_s());
    let (mut over_f, mut sum) = (0.0, 0.0);
    for (k, value) in spectrum.iter().enumerate().take(count / 2 + 1).skip(1) {
        let f_hz = k as f64 * df_hz;
        // A frequency that is 0.25 or 20 Hz except for rounding belongs to the band.
        if (0.25 * (1.0 - 1e-12)..=20.0 * (1.0 + 1e-12)).contains(&f_hz) {
            over_f += value.norm_sqr() / f_hz;
            sum += value.norm_sqr();
        }
    }
    (sum > 0.0).then(|| over_f / sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oscillator::response_spectrum;

    fn sines(parts: &[(f64, f64)], dt_s: f64, n: usize) -> Motion {
        let at = |i: usize| {
            parts
                .iter()
                .map(|(size, f_hz)| size * (TAU * f_hz * i as f64 * dt_s).sin())
                .sum()
        };
        Motion::new(dt_s, (0..n).map(at).collect()).unwrap()
    }

    #[test]
    fn the_mean_period_weighs_by_the_square_of_the_amplitude() {
        // Whole numbers of cycles: two lines of 3² and 1² at 2 and 8 Hz, and one outside the band.
        // Only rounding in the FFT.
        let motion = sines(&[(3.0, 2.0), (1.0, 8.0), (9.0, 30.0)], 0.01, 4000);
        let want = (9.0 / 2.0 + 1.0 / 8.0) / 10.0;
        assert!((mean_period_s(&motion).unwrap() / want - 1.0).abs() < 1e-12);
        assert_eq!(
            mean_period_s(&Motion::new(0.01, vec![0.0; 100]).unwrap()),
            None
        );
    }

    #[test]
    fn a_short_record_is_padded_to_the_resolution() {
        // One cycle of 1 Hz in 1 s, whose spectrum is a broad hump; with the zeros of the function
        // or with zeros added by hand.
        let short = sines(&[(1.0, 1.0)], 0.01, 100);
        let mut accel = short.accel_m_s2().to_vec();
        accel.resize(2000, 0.0);
        assert_eq!(
            mean_period_s(&short),
            mean_period_s(&Motion::new(0.01, accel).unwrap())
        );
    }

    #[test]
    fn spectrum_intensities_are_those_of_the_response_spectrum() {
        let motion = sines(&[(1.0, 1.3), (0.7, 3.1)], 0.005, 3000);
        let m = spectral_measures(&motion);
        let fine: Vec<f64> = (0..=2400).map(|i| 0.1 + 0.001 * f64::from(i)).collect();
        let spectrum = response_spectrum(&motion, 0.05, &fine).unwrap();
        let trapezoid =
            |values: &[f64]| 0.001 * values.windows(2).map(|p| 0.5 * (p[0] + p[1])).sum::<f64>();
        // The resonances of sines are the sharpest peaks of any spectrum, 10 % wide where the
        // periods are 2.7 % apart.
        assert!((m.housner_m / trapezoid(&spectrum.psv_m_s) - 1.0).abs() < 3e-3);
        assert!((m.asi_m_s / trapezoid(&spectrum.psa_m_s2[..=400]) - 1.0).abs() < 3e-3);
    }

    #[test]
    fn a_motion_of_zeros_has_no_periods() {
        let m = spectral_measures(&Motion::new(0.01, vec![0.0; 50]).unwrap());
        assert_eq!((m.housner_m, m.asi_m_s), (0.0, 0.0));
        assert_eq!((m.mean_period_s, m.predominant_period_s), (None, None));
    }
}
