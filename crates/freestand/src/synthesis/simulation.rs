//! Motions of a point source: noise under a window, with the Fourier amplitudes of the source.

use super::frame::Frame;
use super::noise::noise;
use super::point_source::PointSource;
use super::transform::Filter;
use super::{Parameter, SynthesisError, check_samples, check_step, first};
use crate::motion::Motion;

/// Length of the window in multiples of T_d; at its end it has fallen to 7e-5 (Lam, maximum 0.385)
/// or 2e-4 (Saragoni and Hart, maximum 1).
const WINDOW_DURATIONS: f64 = 4.0;
/// Poles of the acausal low cut, which falls with f⁴.
const LOW_CUT_ORDER: f64 = 2.0;
/// Zeros at both ends, in multiples of order/corner (Boore 2005).
const PAD_RATIO: f64 = 1.5;
/// Share of the pads that is tapered, at their outer ends.
const PAD_TAPER_RATIO: f64 = 0.25;
/// Amplifications are calculated at this many frequencies per decade, with straight lines between
/// them (log–log).
const AMPLIFICATIONS_A_DECADE: f64 = 100.0;

/// The time layout of a simulated motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulationOptions {
    /// Time step \[s\]; at most 0.01 s.
    pub dt_s: f64,
    /// Corner of the low cut 1/(1 + (f_c/f)⁴) \[Hz\]; its pads, 1.5·2/f_c at both ends, remain part
    /// of the motion.
    pub low_cut_hz: f64,
}

impl Default for SimulationOptions {
    /// 0.005 s, 0.05 Hz: pads of 60 s, and amplitudes 0.4 % lower at 0.2 Hz.
    fn default() -> Self {
        Self {
            dt_s: 0.005,
            low_cut_hz: 0.05,
        }
    }
}

impl SimulationOptions {
    /// Each of the two that is out of its range, with the range.
    pub fn faults(&self) -> Vec<SynthesisError> {
        let Self { dt_s, low_cut_hz } = *self;
        let is_cut = (0.01..=0.2).contains(&low_cut_hz);
        let checks = [
            check_step(dt_s),
            Parameter::LowCut.check(is_cut, "from 0.01 to 0.2 Hz", low_cut_hz),
        ];
        checks.into_iter().filter_map(Result::err).collect()
    }
}

/// Makes motions of one point source; quantities that they share are calculated once.
#[derive(Debug, Clone)]
pub struct Simulator {
    options: SimulationOptions,
    window: Vec<f64>,
    pad: usize,
    samples: usize,
    /// Target amplitudes of the bins \[m/s\].
    amplitudes_m_s: Vec<f64>,
    step_hz: f64,
}

impl Simulator {
    /// A simulator for `source` on a site whose Fourier amplitudes are `site_ratio` (period \[s\]
    /// to ratio) times those of rock; 1 for rock.
    ///
    /// # Errors
    /// Parameters out of range, or a site ratio that is not positive and finite.
    pub fn new(
        source: &PointSource,
        site_ratio: impl Fn(f64) -> f64,
        options: &SimulationOptions,
    ) -> Result<Self, SynthesisError> {
        first(source.faults())?;
        first(options.faults())?;
        let SimulationOptions { dt_s, low_cut_hz } = *options;
        let pad_s = PAD_RATIO * LOW_CUT_ORDER / low_cut_hz;
        check_samples((2.0 * pad_s + WINDOW_DURATIONS * source.duration_s()) / dt_s)?;
        let shaking = (WINDOW_DURATIONS * source.duration_s() / dt_s).ceil() as usize;
        let pad = (pad_s / dt_s).round() as usize;
        let window = (0..shaking)
            .map(|k| source.window.at(k as f64 * dt_s / source.duration_s()))
            .collect();
        let samples = shaking + 2 * pad;
        let filter = Filter::new(samples);
        let step_hz = filter.step_hz(dt_s);
        let frequencies_hz: Vec<f64> = (1..=filter.bins()).map(|k| k as f64 * step_hz).collect();
        let amplifications = amplifications(source, &frequencies_hz);
        let mut amplitudes_m_s = vec![0.0];
        for (&frequency_hz, amplification) in frequencies_hz.iter().zip(amplifications) {
            let period_s = 1.0 / frequency_hz;
            let site = site_ratio(period_s);
            Parameter::Other("site_ratio").check(
                site > 0.0,
                "positive and finite at all periods",
                site,
            )?;
            let low_cut = 1.0 / (1.0 + (low_cut_hz / frequency_hz).powf(2.0 * LOW_CUT_ORDER));
            amplitudes_m_s
                .push(source.unamplified_m_s(frequency_hz) * amplification * site * low_cut);
        }
        Ok(Self {
            options: *options,
            window,
            pad,
            samples,
            amplitudes_m_s,
            step_hz,
        })
    }

    /// Zeros before and after the shaking \[s\], in which the low cut rings.
    pub fn pad_s(&self) -> f64 {
        self.pad as f64 * self.options.dt_s
    }

    /// The target amplitude at a frequency, including amplification, site and low cut \[m/s\]:
    /// linear between the bins, `None` above half the sampling rate.
    pub fn amplitude_m_s(&self, frequency_hz: f64) -> Option<f64> {
        let along = frequency_hz / self.step_hz;
        let index = along.floor() as usize;
        let (low, high) = (
            self.amplitudes_m_s.get(index)?,
            self.amplitudes_m_s.get(index + 1)?,
        );
        Some(low + (high - low) * (along - index as f64))
    }

    /// The motion of a [`stream`](super::stream) of `seed`: the same however many motions are made
    /// and on however many threads.
    ///
    /// White noise under the window, with its Fourier amplitudes divided by their rms and
    /// multiplied by the target. The window comes first, then the filter; the reverse order
    /// distorts long periods. Drift is removed at the end.
    ///
    /// # Reference
    /// Boore (2003); pads and low cut Boore (2005), "On pads and filters", BSSA 95.
    ///
    /// # Accuracy
    /// The mean square of the amplitudes of many motions is the target's square.
    ///
    /// # Errors
    /// None with valid options.
    pub fn motion(&self, seed: u64, stream: u64) -> Result<Motion, SynthesisError> {
        self.motion_of(noise(seed, stream))
    }

    fn motion_of(&self, mut noise: impl FnMut() -> f64) -> Result<Motion, SynthesisError> {
        let mut accel = vec![0.0; self.samples];
        for (a, window) in accel[self.pad..].iter_mut().zip(&self.window) {
            *a = window * noise();
        }
        // Of the amplitudes, by Parseval's theorem.
        let rms = accel.iter().map(|a| a * a).sum::<f64>().sqrt();
        Filter::new(self.samples).apply(&mut accel, |k| {
            self.amplitudes_m_s[k] / rms / self.options.dt_s
        });
        let taper = ((self.pad as f64 * PAD_TAPER_RATIO) as usize).max(1);
        let frame = Frame::new(self.samples, 0, self.samples - 1, taper, taper);
        frame.settle(&mut accel);
        Ok(Motion::new(self.options.dt_s, accel)?)
    }
}

/// Amplification at rising frequencies, by straight lines in a log–log table.
fn amplifications(source: &PointSource, frequencies_hz: &[f64]) -> Vec<f64> {
    let (Some(first), Some(last)) = (frequencies_hz.first(), frequencies_hz.last()) else {
        return Vec::new();
    };
    if source.profile.is_none() {
        return vec![1.0; frequencies_hz.len()];
    }
    let steps = ((last / first).log10() * AMPLIFICATIONS_A_DECADE)
        .ceil()
        .max(1.0);
    let ln_step = (last / first).ln() / steps;
    let table: Vec<f64> = (0..=steps as usize)
        .map(|i| {
            source
                .amplification_ratio(first * (i as f64 * ln_step).exp())
                .ln()
        })
        .collect();
    let at = |frequency_hz: &f64| {
        let along = ((frequency_hz / first).ln() / ln_step).clamp(0.0, steps);
        let index = (along as usize).min(table.len() - 2);
        (table[index] + (table[index + 1] - table[index]) * (along - index as f64)).exp()
    };
    frequencies_hz.iter().map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measures::{Integrals, integrals};
    use crate::synthesis::{Preset, Resemblance, stream};

    #[test]
    #[ignore = "seconds: a hundred motions"]
    fn the_mean_amplitude_of_a_hundred_motions_is_the_target() {
        let source = Preset::Victoria.source(6.0, 30e3);
        let options = SimulationOptions {
            dt_s: 0.01,
            ..SimulationOptions::default()
        };
        let simulator = Simulator::new(&source, |_| 1.0, &options).unwrap();
        let motions: Vec<Motion> = (0..100)
            .map(|index| simulator.motion(1, index).unwrap())
            .collect();
        // Bands of a third of an octave to a whole one; in each, the energy of a motion divided by
        // that of the target.
        for (from_hz, to_hz) in [
            (0.1, 0.2),
            (0.4, 0.5),
            (0.9, 1.1),
            (1.8, 2.2),
            (4.5, 5.5),
            (9.0, 11.0),
            (18.0, 22.0),
        ] {
            let ratios: Vec<f64> = motions
                .iter()
                .map(|motion| band_ratio(&source, motion, from_hz, to_hz))
                .collect();
            let mean = ratios.iter().sum::<f64>() / 100.0;
            let variance = ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / 99.0;
            // Seven bands within 2.7 standard errors: 95 % of all seeds.
            assert!(
                (mean - 1.0).abs() < 2.7 * (variance / 100.0).sqrt(),
                "{from_hz} Hz: {mean} ± {}",
                (variance / 100.0).sqrt()
            );
            // The test has power: one independent bin has a standard error of 10 %, known to a
            // seventh from a hundred values; a band of 1 Hz or more contains several of the bins
            // that 3 s of shaking separate.
            let most = if to_hz - from_hz < 0.9 { 0.12 } else { 0.08 };
            assert!(
                (variance / 100.0).sqrt() < most,
                "{from_hz} Hz: {}",
                (variance / 100.0).sqrt()
            );
        }
    }

    /// Mean of |X(f)|²/A(f)² over a band, with X by its definition, a sum over the samples.
    fn band_ratio(source: &PointSource, motion: &Motion, from_hz: f64, to_hz: f64) -> f64 {
        let dt_s = motion.dt_s();
        let frequencies = (0..8).map(|i| from_hz + (to_hz - from_hz) * (f64::from(i) + 0.5) / 8.0);
        let ratio = |frequency_hz: f64| {
            let (mut re, mut im) = (0.0, 0.0);
            for (k, a) in motion.accel_m_s2().iter().enumerate() {
                let (sin, cos) = (std::f64::consts::TAU * frequency_hz * k as f64 * dt_s).sin_cos();
                re += a * cos;
                im += a * sin;
            }
            let low_cut = 1.0 / (1.0 + (0.05 / frequency_hz).powi(4));
            (re * re + im * im) * dt_s * dt_s
                / (source.fourier_amplitude_m_s(frequency_hz) * low_cut).powi(2)
        };
        frequencies.map(ratio).sum::<f64>() / 8.0
    }

    #[test]
    fn a_simulated_motion_is_its_seed_and_index_and_ends_at_rest() {
        for (preset, magnitude, distance_m) in [
            (Preset::Victoria, 5.5, 15e3),
            (Preset::IntraplateHardRock, 6.0, 100e3),
            (Preset::SouthEastAustralia, 7.0, 80e3),
        ] {
            let simulator = Simulator::new(
                &preset.source(magnitude, distance_m),
                |_| 1.0,
                &SimulationOptions::default(),
            )
            .unwrap();
            let motion = simulator.motion(3, 4).unwrap();
            assert_eq!(motion, simulator.motion(3, 4).unwrap());
            assert!(
                motion != simulator.motion(3, 5).unwrap()
                    && motion != simulator.motion(4, 4).unwrap()
            );
            let accel = motion.accel_m_s2();
            let Integrals {
                velocity_m_s: velocity,
                displacement_m: displacement,
            } = integrals(&motion);
            let peak = |values: &[f64]| values.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
            let (n, last) = (accel.len() as f64, accel.len() - 1);
            assert_eq!((accel[0], accel[last]), (0.0, 0.0));
            // n additions of numbers up to the peak, ε each, and the length times the error of the
            // velocity.
            assert!(velocity[last].abs() < n * f64::EPSILON * peak(&velocity));
            let length_s = motion.duration_s();
            assert!(
                displacement[last].abs()
                    < length_s * n * f64::EPSILON * (peak(&velocity) + peak(&displacement))
            );
            // The effect of tapers and baseline is below a thousandth of the peak in the outer
            // quarter of the pads.
            let quiet = (0.25 * simulator.pad_s() / motion.dt_s()) as usize;
            assert!(
                peak(&accel[..quiet]) < 1e-3 * motion.peak_m_s2(),
                "{}",
                peak(&accel[..quiet]) / motion.peak_m_s2()
            );
        }
    }

    #[test]
    fn other_last_digits_of_a_machine_do_not_change_a_simulated_motion() {
        // An ulp or two in every random number and every amplitude of the source.
        let source = Preset::Victoria.source(6.0, 30e3);
        let options = SimulationOptions::default();
        let plain = Simulator::new(&source, |_| 1.0, &options).unwrap();
        let factors: Vec<f64> = std::iter::repeat_with(noise(98, 0))
            .take(1000)
            .map(|n| 1.0 + 1e-15 * n)
            .collect();
        let site = |period_s: f64| factors[((1.0 / period_s) * 9.0) as usize % 1000];
        let nudged = Simulator::new(&source, site, &options).unwrap();
        for index in 0..10 {
            let (mut numbers, mut disturbance) = (noise(1, index), noise(99, index));
            let other = nudged
                .motion_of(|| numbers() * (1.0 + 1e-15 * disturbance()))
                .unwrap();
            let motion = plain.motion(1, index).unwrap();
            let pairs = motion.accel_m_s2().iter().zip(other.accel_m_s2());
            let change = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / motion.peak_m_s2();
            // The disturbance had an effect, and did not grow.
            assert!(change > 0.0 && change < 1e-9, "{change}");
        }
    }

    #[test]
    fn earthquakes_of_one_seed_share_no_noise() {
        let options = SimulationOptions::default();
        let motion = |magnitude: f64, earthquake: u32| {
            let source = Preset::Victoria.source(magnitude, 30e3);
            Simulator::new(&source, |_| 1.0, &options)
                .unwrap()
                .motion(1, stream(earthquake, 0))
                .unwrap()
        };
        let correlation =
            |a: &Motion, b: &Motion| Resemblance::between(a, b).correlation_ratio.abs();
        let first = motion(5.5, 0);
        // Shaking of some 4 s at 5 Hz and above has at least 20 independent numbers: 0.22 at one
        // standard deviation.
        assert!(correlation(&first, &motion(6.0, 1)) < 0.66);
        assert!(
            correlation(&first, &motion(6.0, 0)) > 0.8,
            "the same stream would be seen"
        );
    }

    #[test]
    fn a_site_multiplies_the_amplitudes_at_the_period() {
        let source = Preset::Victoria.source(6.0, 30e3);
        let options = SimulationOptions::default();
        let rock = Simulator::new(&source, |_| 1.0, &options).unwrap();
        let soil = Simulator::new(&source, |period_s| 1.0 + period_s.min(1.0), &options).unwrap();
        // At 2 Hz, T = 0.5 s: 1.5. Straight lines between bins 0.006 Hz apart leave (0.006/2)² of
        // it.
        let ratio = soil.amplitude_m_s(2.0).unwrap() / rock.amplitude_m_s(2.0).unwrap();
        assert!((ratio - 1.5).abs() < 1e-5, "{ratio}");
        // The table of the amplification is good to 1e-4 of it.
        let expected = source.fourier_amplitude_m_s(2.0) / (1.0 + 0.025_f64.powi(4));
        assert!((rock.amplitude_m_s(2.0).unwrap() / expected - 1.0).abs() < 2e-4);
        assert_eq!(rock.amplitude_m_s(101.0), None);
    }

    #[test]
    fn options_out_of_range_are_named() {
        let source = Preset::Victoria.source(6.0, 30e3);
        let name = |options: SimulationOptions, site: f64| match Simulator::new(
            &source,
            |_| site,
            &options,
        ) {
            Err(SynthesisError::Option { parameter, .. }) => parameter.name(),
            other => panic!("{other:?}"),
        };
        let fine = SimulationOptions::default();
        assert_eq!(name(SimulationOptions { dt_s: 0.02, ..fine }, 1.0), "dt_s");
        assert_eq!(
            name(
                SimulationOptions {
                    low_cut_hz: 0.0,
                    ..fine
                },
                1.0
            ),
            "low_cut_hz"
        );
        assert_eq!(
            name(SimulationOptions { dt_s: 1e-5, ..fine }, 1.0),
            "the number of samples"
        );
        assert_eq!(name(fine, f64::NAN), "site_ratio");
    }
}
