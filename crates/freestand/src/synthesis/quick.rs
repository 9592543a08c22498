//! Motions that follow a rough spectrum after a few passes.

use super::matching::{Gain, Layout, Matcher, matched_periods_s, start_amplitude};
use super::noise::noise;
use super::{
    DAMPING_RATIO, LONGEST_PERIOD_S, MATCHED_PERIODS, SHORTEST_PERIOD_S, SynthesisError,
    SynthesisOptions, shaking_layout, windowed_noise,
};
use crate::motion::Motion;
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// Passes: with three, ln Sa at 0.05 s is 0.011 too high in the mean, with four 0.008.
const PASSES: usize = 4;
/// Below this frequency \[Hz\] the window is longer: surface waves come late and last.
const SLOW_BELOW_HZ: f64 = 1.0;
/// By this factor. Integral of v² and how often blocks overturn are then those of thirty passes.
const SLOW_RATIO: f64 = 3.0;
/// Iterations that bring the expected spectrum of the noise to the target.
const START_ITERATIONS: usize = 40;
/// Frequencies above the highest matched one, to which short periods respond too, in the spacing of
/// the matched ones: a factor of 4.6, where the start has fallen by a factor of 600.
const FREQUENCIES_ABOVE: usize = 40;
/// D5–95 of noise under the window, as a share of T_d.
const SIGNIFICANT_RATIO: f64 = 0.754;

/// Makes motions whose spectra follow targets that are as rough as those of records, about ten times
/// as fast as [`synthesize`](super::synthesize).
///
/// The noise starts with the amplitudes at which its *expected* spectrum is the target: the mean
/// square of an oscillator is that of its transfer function under the amplitudes, times the share
/// `1/(1 + T/(4πζD))` that it builds up in the significant duration D, and its peak is
/// `√(2 ln N) + 0.577/√(2 ln N)` standard deviations for N = 1 + D/T maxima. The passes of
/// [`synthesize`](super::synthesize) do the rest: they have only the chance of the one motion left to
/// remove.
///
/// # Reference
/// Davenport (1964), "Note on the distribution of the largest value of a random function", for the
/// peak; Gasparini and Vanmarcke (1976), SIMQKE, for noise whose expected spectrum is a target and for
/// the passes.
///
/// # Accuracy
/// Passes that follow a spectrum to 0.1 in ln Sa are enough where the spectrum itself is drawn with
/// a standard deviation of 0.4 to 0.65; see [`world_motion`](crate::worlds::world_motion).
pub struct QuickMatcher {
    options: SynthesisOptions,
    layout: Layout,
    /// Share of each matched frequency in the mean square of each matched oscillator, per squared
    /// pseudo-velocity amplitude: `[period][frequency]`.
    shares: Vec<Vec<f64>>,
}

impl QuickMatcher {
    /// Prepares for motions of this layout of time.
    ///
    /// # Errors
    /// Options out of range.
    pub fn new(options: &SynthesisOptions) -> Result<Self, SynthesisError> {
        let periods_s = matched_periods_s();
        Ok(Self {
            options: *options,
            layout: shaking_layout(options)?.thinned()?,
            shares: {
                let by_period: Vec<Vec<f64>> =
                    periods_s.iter().map(|&period_s| shares(period_s)).collect();
                (0..MATCHED_PERIODS)
                    .map(|k| by_period.iter().map(|row| row[k]).collect())
                    .collect()
            },
        })
    }

    /// The options.
    pub fn options(&self) -> &SynthesisOptions {
        &self.options
    }

    /// The motion of a stream of random numbers of `seed`, whose PSA follows `target_sa_g`
    /// (period \[s\] to g, 5 % damping) under a window of duration T_d = `envelope_s`. Its mean ln
    /// PSA/target over the periods of `over_s` is 0.
    ///
    /// # Errors
    /// A target that is not positive and finite.
    pub fn motion(
        &self,
        target_sa_g: impl Fn(f64) -> f64,
        envelope_s: f64,
        over_s: &RangeInclusive<f64>,
        (seed, stream): (u64, u64),
    ) -> Result<Motion, SynthesisError> {
        let mut matcher = Matcher::new(&self.layout, &target_sa_g, Gain::AtPeriod)?;
        let start = self.start(&matcher.target_m_s2, SIGNIFICANT_RATIO * envelope_s);
        let [mut accel, slow] = windowed_noise(
            noise(seed, stream),
            &self.options,
            [envelope_s, SLOW_RATIO * envelope_s],
        );
        matcher.blend(&mut accel, &slow, SLOW_BELOW_HZ);
        matcher.shape_noise(&mut accel, &start);
        matcher.follow(accel, PASSES, over_s)
    }

    /// ω times the amplitudes at which noise of this duration is expected to have the spectrum, up to
    /// a factor.
    fn start(&self, target_m_s2: &[f64], duration_s: f64) -> Vec<f64> {
        let squares: Vec<f64> = target_m_s2
            .iter()
            .zip(matched_periods_s())
            .map(|(sa, period_s)| sa * sa / squared_peak_factor(period_s, duration_s))
            .collect();
        let mut amplitudes = squares.clone();
        for _ in 0..START_ITERATIONS {
            let mut expected = vec![0.0; MATCHED_PERIODS];
            for (shares, amplitude) in self.shares.iter().zip(&amplitudes) {
                for (sum, share) in expected.iter_mut().zip(shares) {
                    *sum += share * amplitude;
                }
            }
            for ((amplitude, square), expected) in amplitudes.iter_mut().zip(&squares).zip(expected)
            {
                *amplitude = (*amplitude * square / expected).max(1e-30);
            }
        }
        amplitudes.into_iter().map(f64::sqrt).collect()
    }
}

/// The square of an oscillator's peak, as a share of its stationary mean square, under shaking of a
/// duration.
fn squared_peak_factor(period_s: f64, duration_s: f64) -> f64 {
    let root = (2.0 * (1.0 + duration_s / period_s).ln()).sqrt();
    let built_up = 1.0 / (1.0 + period_s / (4.0 * PI * DAMPING_RATIO * duration_s));
    (root + 0.577 / root).powi(2) * built_up
}

/// Shares of the matched frequencies in the mean square of the oscillator of this period. Frequencies
/// above them count with the highest, those below with the lowest, as the start has them.
fn shares(period_s: f64) -> Vec<f64> {
    let mut shares = vec![0.0; MATCHED_PERIODS];
    let step = (LONGEST_PERIOD_S / SHORTEST_PERIOD_S).ln() / (MATCHED_PERIODS - 1) as f64;
    for index in 0..MATCHED_PERIODS + FREQUENCIES_ABOVE {
        let place = index as f64 - FREQUENCIES_ABOVE as f64;
        let frequency_hz = 1.0 / (SHORTEST_PERIOD_S * (place * step).exp());
        let ratio = frequency_hz * period_s;
        let transfer =
            1.0 / ((1.0 - ratio * ratio).powi(2) + (2.0 * DAMPING_RATIO * ratio).powi(2));
        // The frequencies are equally spaced in ln f: df = f d(ln f).
        shares[index.saturating_sub(FREQUENCIES_ABOVE)] +=
            transfer * frequency_hz * start_amplitude(1.0, frequency_hz).powi(2);
    }
    shares
}
