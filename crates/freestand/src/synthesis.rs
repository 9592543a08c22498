//! Ground motions that are compatible with a target spectrum: shaped noise, or a record, filtered until it fits.
//!
//! Each pass computes the 5 %-damped spectrum exactly, multiplies the Fourier amplitudes at f = 1/T by target/spectrum
//! (phases stay), tapers the ends, removes the drift and looks again; the best pass is kept. What [`Misfit`] says is
//! said of the very motion that is returned, after tapers and baseline.
//!
//! # Accuracy
//! AS 1170.4, kpZ = 0.08, seed 1, motions 0 to 9, [`SynthesisOptions::default`]; means over the ten but for the worst
//! period, which is the largest of all:
//!
//! | class | rms misfit | worst period | target ZPA | PGA | PGV | PGD | D5–95 |
//! |---|---|---|---|---|---|---|---|
//! | Ae | 3.3 % | 15 % | 0.064 g | 0.081 g | 0.046 m/s | 29 mm | 9.8 s |
//! | Be | 3.3 % | 15 % | 0.080 g | 0.101 g | 0.058 m/s | 36 mm | 9.8 s |
//! | Ce | 3.3 % | 14 % | 0.104 g | 0.132 g | 0.081 m/s | 53 mm | 10.1 s |
//! | De | 3.3 % | 15 % | 0.088 g | 0.144 g | 0.122 m/s | 78 mm | 11.1 s |
//! | Ee | 3.4 % | 15 % | 0.088 g | 0.151 g | 0.165 m/s | 118 mm | 11.4 s |
//!
//! Single motions of class De lie at 2.6 to 4.0 % and have a PGA of 0.126 to 0.184 g. Seeds 100 to 109 give 3.5 % on
//! average in every class, 16 % at worst; the window and the low cut were chosen on seed 1 alone. Damped Gauss–Newton
//! steps on the amplitudes after half of the passes, tried without the low cut, got 2.4 %, but at three times the cost
//! and with longer shaking and larger displacement: not taken.
//!
//! # Limitation
//! The code's shapes ask for more than a broad-band motion can give: class De has plateau/ZPA = 3.35, and a motion that
//! fills its plateau and its constant-velocity range has a PGA well above the ZPA, whatever the seed, the number of
//! passes or the step. Matching below 0.05 s does not cure this and spoils the rest. So both [`Misfit::pga_g`] and
//! [`Misfit::target_zpa_g`] are given: state both. For rocking, PGV and 0.3–3 s count for more than PGA.

use crate::G0_M_S2;
use crate::measures::measures;
use crate::motion::{Motion, MotionError};
use crate::oscillator::{OscillatorBank, OscillatorError};
use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlannerScalar};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use thiserror::Error;

/// What makes the random numbers, for outputs: counter-based, so that motion i does not depend on how many are made.
pub const GENERATOR: &str = "ChaCha12Rng (rand_chacha 0.10), seed_from_u64(seed), stream = motion index; \
                             StandardNormal (rand_distr 0.6)";

/// Shortest period that is matched \[s\].
pub const SHORTEST_PERIOD_S: f64 = 0.05;
/// Longest period that is matched \[s\].
pub const LONGEST_PERIOD_S: f64 = 5.0;
/// Number of periods that are matched, equally spaced in log T: 60 a decade, about one for each 5 %-damped bandwidth.
pub const MATCHED_PERIODS: usize = 121;
/// Damping ratio of the target and of the spectra.
pub const DAMPING_RATIO: f64 = 0.05;

/// Each pass multiplies amplitudes below this by f/f₀ \[Hz\]. Without it the passes feed what lies below the longest
/// period, where no oscillator looks: the displacement grows threefold and the fit is no better.
const LOW_CUT_HZ: f64 = 0.15;
/// Corner of the first shaping's roll-off \[Hz\], a little above the shortest period; the passes do the rest.
const HIGH_CORNER_HZ: f64 = 25.0;
/// Cosine tapers of the noise \[s\]: the window starts from zero by itself, so the start can be short.
const TAPER_START_S: f64 = 0.5;
const TAPER_END_S: f64 = 4.0;
/// Cosine tapers of a record, as a share of its length.
const RECORD_TAPER_RATIO: f64 = 0.02;
/// Samples beyond which a request is refused: at 0.005 s an hour and a half.
const MAX_SAMPLES: f64 = 1048576.0;

/// Why no motion was made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SynthesisError {
    /// The target is not a positive finite acceleration.
    #[error("the target spectrum must be positive and finite, not {sa_g} g at T = {period_s} s")]
    Target {
        /// Where the target was asked.
        period_s: f64,
        /// What it gave \[g\].
        sa_g: f64,
    },
    /// An option is out of its range.
    #[error("{name} must be {requirement}, not {value}")]
    Option {
        /// Field of [`SynthesisOptions`].
        name: &'static str,
        /// The range.
        requirement: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// The motion to be matched is shorter than the longest period of the spectrum.
    #[error("a motion of {duration_s} s is too short to be matched up to {LONGEST_PERIOD_S} s")]
    TooShort {
        /// Its duration.
        duration_s: f64,
    },
    /// The motion to be matched has no content to scale at some period.
    #[error("the motion has nothing to scale")]
    NoContent,
    /// The oscillators of the spectrum cannot be made.
    #[error(transparent)]
    Oscillator(#[from] OscillatorError),
    /// The result is not a motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// How a synthetic motion is laid out in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SynthesisOptions {
    /// Time step \[s\]; at most a fifth of the shortest period, 0.01 s.
    pub dt_s: f64,
    /// Zeros before the shaking \[s\].
    pub lead_in_s: f64,
    /// Length of the shaking with its tapers \[s\].
    pub shaking_s: f64,
    /// Zeros after the shaking \[s\].
    pub tail_s: f64,
    /// Duration T_d of the window `e^(−2.4 t/T_d) − e^(−7.2 t/T_d)` that shapes the noise \[s\].
    pub envelope_s: f64,
    /// Passes of the matching.
    pub passes: usize,
}

impl Default for SynthesisOptions {
    /// 0.005 s, 1 s of quiet, 40 s of shaking, 4 s of quiet, T_d = 10 s (D5–95 about 11 s after matching), 30 passes.
    fn default() -> Self {
        Self { dt_s: 0.005, lead_in_s: 1.0, shaking_s: 40.0, tail_s: 4.0, envelope_s: 10.0, passes: 30 }
    }
}

/// How well a motion fits its target, over [`MATCHED_PERIODS`] periods, and what it is like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// Root mean square of PSA/target − 1.
    pub rms_ratio: f64,
    /// PSA/target − 1 where it is largest in size, with its sign.
    pub worst_ratio: f64,
    /// Period of the worst misfit \[s\].
    pub worst_period_s: f64,
    /// Peak ground acceleration of the motion \[g\].
    pub pga_g: f64,
    /// Target at T = 0 \[g\]; a match of the spectrum does not reach it, see the module's limitation.
    pub target_zpa_g: f64,
    /// Significant duration \[s\].
    pub d5_95_s: f64,
    /// Peak ground velocity \[m/s\].
    pub pgv_m_s: f64,
}

/// A motion and how well it fits.
#[derive(Debug, Clone, PartialEq)]
pub struct MatchedMotion {
    /// The motion; starts and ends with zero acceleration, and ends with zero velocity and displacement.
    pub motion: Motion,
    /// Its misfit.
    pub misfit: Misfit,
    /// The pass it comes from, counted from 0 (the scaled start).
    pub pass: usize,
}

/// Synthetic motion number `index` of `seed`, matched to the target PSA `target_sa_g` (period \[s\] to g, 5 % damping).
///
/// Gaussian noise under the window `w(t) = e^(−0.4·6t/T_d) − e^(−1.2·6t/T_d)`, shaped like the target's pseudo-velocity
/// and then matched. The same seed and index give the same motion, however many are made and on however many threads.
///
/// # Reference
/// Lam, Wilson and Hutchinson (2000), "Generation of synthetic earthquake accelerograms using seismological modelling:
/// a review", for the window; Gasparini and Vanmarcke (1976), SIMQKE, for noise matched to a response spectrum by
/// passes in the frequency domain.
///
/// # Accuracy
/// See the [module](self).
///
/// # Errors
/// A target that is not positive and finite, options out of range.
///
/// # Example
/// ```
/// use freestand::code_spectrum::{As1170_4, Edition, SiteClass};
/// use freestand::synthesis::{SynthesisOptions, synthesize};
/// let code = As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500)?;
/// let matched = synthesize(|period_s| code.sa_g(period_s), 1, 0, &SynthesisOptions::default())?;
/// assert!(matched.misfit.rms_ratio < 0.05);
/// assert!(matched.misfit.pga_g > matched.misfit.target_zpa_g); // the trap of the De shape
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn synthesize(
    target_sa_g: impl Fn(f64) -> f64,
    seed: u64,
    index: u64,
    options: &SynthesisOptions,
) -> Result<MatchedMotion, SynthesisError> {
    check_options(options)?;
    let samples = |time_s: f64| (time_s / options.dt_s).round() as usize;
    let (start, shaking, tail) = (samples(options.lead_in_s), samples(options.shaking_s), samples(options.tail_s));
    let end = start + shaking;
    let mut accel = vec![0.0; end + tail + 1];
    let mut noise = noise(seed, index);
    for (k, a) in accel[start..=end].iter_mut().enumerate() {
        let x = 6.0 * k as f64 * options.dt_s / options.envelope_s;
        *a = noise() * ((-0.4 * x).exp() - (-1.2 * x).exp());
    }
    let frame = Frame::new(accel.len(), start, end, samples(TAPER_START_S), samples(TAPER_END_S));
    let mut matcher = Matcher::new(&target_sa_g, options.dt_s, frame)?;
    matcher.shape_noise(&mut accel);
    matcher.run(accel, options.passes)
}

/// The record `seed` matched to the target PSA `target_sa_g` (period \[s\] to g, 5 % damping); its phases stay.
///
/// The first and last 2 % are tapered; the length and the time step stay.
///
/// # Limitation
/// With a time step above 0.01 s peaks between samples are missed at the shortest periods.
///
/// # Errors
/// A target that is not positive and finite, a record shorter than [`LONGEST_PERIOD_S`] or without content.
pub fn match_motion(
    seed: &Motion,
    target_sa_g: impl Fn(f64) -> f64,
    passes: usize,
) -> Result<MatchedMotion, SynthesisError> {
    let duration_s = seed.duration_s();
    let n = seed.accel_m_s2().len();
    // Sixteen samples: enough to taper and to take out two drifts.
    if duration_s < LONGEST_PERIOD_S || n < 16 {
        return Err(SynthesisError::TooShort { duration_s });
    }
    let taper = ((n as f64 * RECORD_TAPER_RATIO) as usize).max(1);
    let frame = Frame::new(n, 0, n - 1, taper, taper);
    let mut matcher = Matcher::new(&target_sa_g, seed.dt_s(), frame)?;
    matcher.run(seed.accel_m_s2().to_vec(), passes)
}

fn check_options(options: &SynthesisOptions) -> Result<(), SynthesisError> {
    let check = |fine: bool, name, requirement, value: f64| {
        if fine && value.is_finite() { Ok(()) } else { Err(SynthesisError::Option { name, requirement, value }) }
    };
    let SynthesisOptions { dt_s, lead_in_s, shaking_s, tail_s, envelope_s, .. } = *options;
    check(dt_s > 0.0 && dt_s <= 0.01, "dt_s", "positive and at most 0.01 s", dt_s)?;
    check(lead_in_s >= 0.0, "lead_in_s", "at least 0 s", lead_in_s)?;
    check(shaking_s >= 2.0 * LONGEST_PERIOD_S, "shaking_s", "at least 10 s, twice the longest period", shaking_s)?;
    check(tail_s >= 0.0, "tail_s", "at least 0 s", tail_s)?;
    check(envelope_s >= 1.0, "envelope_s", "at least 1 s", envelope_s)?;
    let samples = (lead_in_s + shaking_s + tail_s) / dt_s;
    check(samples <= MAX_SAMPLES, "the number of samples", "at most 1048576", samples)
}

/// Standard normal numbers of stream `index` of `seed`.
fn noise(seed: u64, index: u64) -> impl FnMut() -> f64 {
    let mut random = ChaCha12Rng::seed_from_u64(seed);
    random.set_stream(index);
    move || StandardNormal.sample(&mut random)
}

/// Where a motion may move: tapers at both ends of the shaking, and a smooth bell to take drift out with.
struct Frame {
    taper: Vec<f64>,
    bell: Vec<f64>,
    /// Time in samples from the middle of the shaking.
    centre: f64,
}

impl Frame {
    fn new(samples: usize, start: usize, end: usize, taper_start: usize, taper_end: usize) -> Self {
        let rise = |k: usize, over: usize| 0.5 - 0.5 * (PI * (k as f64 / over as f64).min(1.0)).cos();
        let within = |k: usize| (start..=end).contains(&k);
        let taper = |k| if within(k) { rise(k - start, taper_start) * rise(end - k, taper_end) } else { 0.0 };
        // Without the last sample, where the sine of a rounded π would leave 1e-32 instead of zero.
        let bell = |k| {
            if within(k) && k < end { (PI * (k - start) as f64 / (end - start) as f64).sin().powi(2) } else { 0.0 }
        };
        let (taper, bell) = ((0..samples).map(taper).collect(), (0..samples).map(bell).collect());
        Self { taper, bell, centre: 0.5 * (start + end) as f64 }
    }

    /// Subtracts bell·(c₀ + c₁t) so that Σa = 0 and Σta = 0: with zero ends these are the final velocity and
    /// displacement of the trapezoid rule and of the motion that is linear between samples alike. The bell is as long
    /// as the shaking, so what it adds lies far below the periods that are matched.
    fn remove_drift(&self, accel: &mut [f64]) {
        let time = |k: usize| k as f64 - self.centre;
        let (mut sum, mut moment, mut bell0, mut bell1, mut bell2) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (k, (a, bell)) in accel.iter().zip(&self.bell).enumerate() {
            let t = time(k);
            sum += a;
            moment += a * t;
            bell0 += bell;
            bell1 += bell * t;
            bell2 += bell * t * t;
        }
        let determinant = bell0 * bell2 - bell1 * bell1;
        let c0 = (sum * bell2 - moment * bell1) / determinant;
        let c1 = (moment * bell0 - sum * bell1) / determinant;
        for (k, (a, bell)) in accel.iter_mut().zip(&self.bell).enumerate() {
            *a -= bell * (c0 + c1 * time(k));
        }
    }
}

/// Everything that one target and one length of motion need, pass after pass.
struct Matcher {
    dt_s: f64,
    frame: Frame,
    periods_s: Vec<f64>,
    target_m_s2: Vec<f64>,
    target_zpa_g: f64,
    bank: OscillatorBank,
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    spectrum: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    sd_m: Vec<f64>,
    unused: Vec<f64>,
}

impl Matcher {
    fn new(target_sa_g: &impl Fn(f64) -> f64, dt_s: f64, frame: Frame) -> Result<Self, SynthesisError> {
        let target = |period_s: f64| match target_sa_g(period_s) {
            sa_g if sa_g > 0.0 && sa_g.is_finite() => Ok(sa_g),
            sa_g => Err(SynthesisError::Target { period_s, sa_g }),
        };
        let periods_s = matched_periods_s();
        let target_m_s2 = periods_s.iter().map(|&t| target(t).map(|sa_g| sa_g * G0_M_S2)).collect::<Result<_, _>>()?;
        // The scalar planner: its results do not depend on the vector units of the machine.
        let mut planner = FftPlannerScalar::new();
        let length = transform_length(frame.taper.len());
        let (forward, inverse) = (planner.plan_fft_forward(length), planner.plan_fft_inverse(length));
        let scratch = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
        Ok(Self {
            dt_s,
            frame,
            target_zpa_g: target(0.0)?,
            bank: OscillatorBank::new(&periods_s, DAMPING_RATIO, dt_s)?,
            periods_s,
            target_m_s2,
            forward,
            inverse,
            spectrum: vec![Complex::default(); length],
            scratch: vec![Complex::default(); scratch],
            sd_m: Vec::new(),
            unused: Vec::new(),
        })
    }

    /// First shape of white noise: Fourier amplitudes like the target's pseudo-velocity Sa/ω, cut outside its periods.
    fn shape_noise(&mut self, accel: &mut [f64]) {
        let ln_target: Vec<f64> = self.target_m_s2.iter().map(|sa| sa.ln()).collect();
        self.filter(accel, |frequency_hz, place| {
            let low = (frequency_hz * LONGEST_PERIOD_S).min(1.0).powi(2);
            let high = 1.0 / (1.0 + (frequency_hz / HIGH_CORNER_HZ).powi(4));
            place.interpolate(&ln_target).exp() / frequency_hz.max(1.0 / LONGEST_PERIOD_S) * low * high
        });
    }

    fn run(&mut self, mut accel: Vec<f64>, passes: usize) -> Result<MatchedMotion, SynthesisError> {
        for (a, taper) in accel.iter_mut().zip(&self.frame.taper) {
            *a *= taper;
        }
        self.frame.remove_drift(&mut accel);
        // One factor first, so that pass 0 is the start at its best scale.
        let mean = self.ln_ratios(&accel).iter().sum::<f64>() / MATCHED_PERIODS as f64;
        if !mean.is_finite() {
            return Err(SynthesisError::NoContent);
        }
        accel.iter_mut().for_each(|a| *a *= (-mean).exp());
        let (mut best, mut best_rms, mut best_pass, mut best_ln) = (Vec::new(), f64::INFINITY, 0, Vec::new());
        for pass in 0..=passes {
            let ln_ratios = self.ln_ratios(&accel);
            let rms = rms_misfit(&ln_ratios);
            if rms < best_rms {
                best.clone_from(&accel);
                (best_rms, best_pass) = (rms, pass);
                best_ln.clone_from(&ln_ratios);
            }
            if pass < passes {
                self.filter(&mut accel, |frequency_hz, place| {
                    (-place.interpolate(&ln_ratios)).exp() * (frequency_hz / LOW_CUT_HZ).min(1.0)
                });
            }
        }
        let motion = Motion::new(self.dt_s, best)?;
        let misfit = self.misfit(&motion, best_rms, &best_ln);
        Ok(MatchedMotion { motion, misfit, pass: best_pass })
    }

    fn misfit(&self, motion: &Motion, rms_ratio: f64, ln_ratios: &[f64]) -> Misfit {
        let (mut worst_ratio, mut worst_period_s) = (0.0_f64, self.periods_s[0]);
        for (ln_ratio, &period_s) in ln_ratios.iter().zip(&self.periods_s) {
            if ln_ratio.exp_m1().abs() > worst_ratio.abs() {
                (worst_ratio, worst_period_s) = (ln_ratio.exp_m1(), period_s);
            }
        }
        let measures = measures(motion);
        Misfit {
            rms_ratio,
            worst_ratio,
            worst_period_s,
            pga_g: measures.pga_m_s2 / G0_M_S2,
            target_zpa_g: self.target_zpa_g,
            d5_95_s: measures.d5_95_s,
            pgv_m_s: measures.pgv_m_s,
        }
    }

    /// ln(PSA/target) at the matched periods.
    fn ln_ratios(&mut self, accel: &[f64]) -> Vec<f64> {
        self.bank.peaks::<false>(accel, &mut self.sd_m, &mut self.unused);
        let psa = self.sd_m.iter().zip(&self.periods_s).map(|(sd, t)| sd * (TAU / t) * (TAU / t));
        psa.zip(&self.target_m_s2).map(|(psa, target)| (psa / target).ln()).collect()
    }

    /// Multiplies the Fourier amplitudes by `gain(frequency, place among the periods)`, drops the mean, tapers the ends
    /// and removes the drift.
    fn filter(&mut self, accel: &mut [f64], gain: impl Fn(f64, Place) -> f64) {
        let length = self.spectrum.len();
        self.spectrum.fill(Complex::default());
        for (bin, &a) in self.spectrum.iter_mut().zip(accel.iter()) {
            bin.re = a;
        }
        self.forward.process_with_scratch(&mut self.spectrum, &mut self.scratch);
        let step_hz = 1.0 / (length as f64 * self.dt_s);
        self.spectrum[0] = Complex::default();
        for k in 1..=length / 2 {
            let frequency_hz = k as f64 * step_hz;
            let gain = gain(frequency_hz, Place::of(frequency_hz));
            self.spectrum[k] *= gain;
            // The mirror image, which the middle bin does not have.
            if k < length - k {
                self.spectrum[length - k] *= gain;
            }
        }
        self.inverse.process_with_scratch(&mut self.spectrum, &mut self.scratch);
        for ((a, bin), taper) in accel.iter_mut().zip(&self.spectrum).zip(&self.frame.taper) {
            *a = bin.re / length as f64 * taper;
        }
        self.frame.remove_drift(accel);
    }
}

/// Where a frequency lies among the matched periods: between `index` and the next, `fraction` of the way; the ends go on
/// as constants.
#[derive(Clone, Copy)]
struct Place {
    index: usize,
    fraction: f64,
}

impl Place {
    fn of(frequency_hz: f64) -> Self {
        let last = (MATCHED_PERIODS - 1) as f64;
        let along = -(frequency_hz * SHORTEST_PERIOD_S).ln() / (LONGEST_PERIOD_S / SHORTEST_PERIOD_S).ln() * last;
        let along = along.clamp(0.0, last);
        let index = (along as usize).min(MATCHED_PERIODS - 2);
        Self { index, fraction: along - index as f64 }
    }

    fn interpolate(self, values: &[f64]) -> f64 {
        values[self.index] + (values[self.index + 1] - values[self.index]) * self.fraction
    }
}

/// The periods that are matched, rising \[s\].
pub fn matched_periods_s() -> Vec<f64> {
    let span: f64 = LONGEST_PERIOD_S / SHORTEST_PERIOD_S;
    (0..MATCHED_PERIODS).map(|i| SHORTEST_PERIOD_S * span.powf(i as f64 / (MATCHED_PERIODS - 1) as f64)).collect()
}

fn rms_misfit(ln_ratios: &[f64]) -> f64 {
    (ln_ratios.iter().map(|ln_ratio| ln_ratio.exp_m1().powi(2)).sum::<f64>() / ln_ratios.len() as f64).sqrt()
}

/// Least length of the form 2^a, 3·2^a or 9·2^a that holds `samples`: quick to transform and little longer.
fn transform_length(samples: usize) -> usize {
    let above = |factor: usize| factor * samples.div_ceil(factor).next_power_of_two();
    above(1).min(above(3)).min(above(9))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code_spectrum::{As1170_4, Edition, SiteClass};
    use crate::measures::cumulative_trapezoid;
    use crate::oscillator::response_spectrum;

    fn melbourne_de(period_s: f64) -> f64 {
        As1170_4::new(Edition::default(), SiteClass::De, 0.08, 500).unwrap().sa_g(period_s)
    }

    fn motion(index: u64) -> MatchedMotion {
        synthesize(melbourne_de, 1, index, &SynthesisOptions::default()).unwrap()
    }

    #[test]
    fn the_misfit_is_that_of_the_motion_that_is_returned() {
        let MatchedMotion { motion, misfit, .. } = motion(0);
        let spectrum = response_spectrum(&motion, DAMPING_RATIO, &matched_periods_s()).unwrap();
        let errors: Vec<f64> = spectrum
            .periods_s
            .iter()
            .zip(&spectrum.psa_m_s2)
            .map(|(&t, psa)| psa / (melbourne_de(t) * G0_M_S2) - 1.0)
            .collect();
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        // The same numbers by another order of multiplication, and once through ln and exp.
        assert!((misfit.rms_ratio - rms).abs() < 1e-14);
        let worst = errors.iter().map(|e| e.abs()).fold(0.0, f64::max);
        assert!((misfit.worst_ratio.abs() - worst).abs() < 1e-14);
        let at = matched_periods_s().iter().position(|&t| t == misfit.worst_period_s).unwrap();
        assert_eq!(errors[at].abs(), worst);
        assert!((misfit.target_zpa_g - 0.088).abs() < 1e-15);
        assert_eq!(misfit.pga_g, motion.peak_m_s2() / G0_M_S2);
    }

    #[test]
    fn motions_fit_and_have_the_pga_that_the_shape_of_class_de_forces() {
        for index in 0..3 {
            let misfit = motion(index).misfit;
            // The aim is 5 %; the ten motions of the module's table are at 2.6 to 4.0 %.
            assert!(misfit.rms_ratio < 0.05, "{misfit:?}");
            // Broad-band motions amplify by 2.71 at most in 84 of 100 cases (Newmark and Hall, 5 %), so the plateau of
            // 0.2944 g asks for a PGA of 0.109 g, not 0.088; and an oscillator of 0.05 s nearly follows the ground.
            assert!(misfit.pga_g > 0.2944 / 2.71 && misfit.pga_g < melbourne_de(0.05), "{misfit:?}");
        }
    }

    #[test]
    fn a_motion_starts_and_ends_at_rest_after_quiet() {
        let MatchedMotion { motion, .. } = motion(4);
        let accel = motion.accel_m_s2();
        assert_eq!(motion.duration_s(), 45.0);
        assert!(accel[..=200].iter().chain(&accel[8200..]).all(|&a| a == 0.0));
        let velocity = cumulative_trapezoid(motion.dt_s(), accel);
        let displacement = cumulative_trapezoid(motion.dt_s(), &velocity);
        let peak = |values: &[f64]| values.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
        // 9000 additions of numbers up to the peak, ε each, and 45 s of the velocity's error in the displacement.
        assert!(velocity[9000].abs() < 9000.0 * f64::EPSILON * peak(&velocity));
        assert!(displacement[9000].abs() < 45.0 * 9000.0 * f64::EPSILON * (peak(&velocity) + peak(&displacement)));
        // No drift: within three times the spectrum's 59 mm. Without the low cut ten motions had 0.28 m on average.
        assert!(peak(&displacement) < 3.0 * 0.059, "{}", peak(&displacement));
    }

    #[test]
    fn a_motion_is_its_seed_and_index() {
        assert_eq!(motion(2), motion(2));
        let other_seed = synthesize(melbourne_de, 2, 2, &SynthesisOptions::default()).unwrap();
        for other in [motion(3), other_seed] {
            let (a, b) = (motion(2).motion, other.motion);
            let product =
                |a: &Motion, b: &Motion| -> f64 { a.accel_m_s2().iter().zip(b.accel_m_s2()).map(|(a, b)| a * b).sum() };
            let correlation = product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt();
            // Independent narrow-band noise of about 11 s · 10 Hz = 100 samples' worth: 0.1 standard deviation.
            assert!(correlation.abs() < 0.4, "{correlation}");
        }
    }

    #[test]
    fn the_random_numbers_are_those_of_the_named_generator() {
        // Recorded from rand_chacha 0.10.0 and rand_distr 0.6.0. Another value changes every synthetic motion.
        let mut noise = noise(1, 7);
        assert_eq!([noise(), noise(), noise()], [-0.8937706181435281, -0.5479682301173312, 0.04426811833978719]);
    }

    #[test]
    fn a_record_is_matched_with_its_own_step() {
        // The motion of rock, every second sample, brought to the spectrum of deep soil.
        let rock = As1170_4::new(Edition::default(), SiteClass::Be, 0.08, 500).unwrap();
        let rock = synthesize(|t| rock.sa_g(t), 1, 0, &SynthesisOptions::default()).unwrap().motion;
        let record = Motion::new(0.01, rock.accel_m_s2().iter().copied().step_by(2).collect()).unwrap();
        let unmatched = match_motion(&record, melbourne_de, 0).unwrap();
        let matched = match_motion(&record, melbourne_de, 30).unwrap();
        assert_eq!((unmatched.pass, matched.motion.dt_s()), (0, 0.01));
        assert_eq!(matched.motion.accel_m_s2().len(), record.accel_m_s2().len());
        assert!(matched.misfit.rms_ratio < 0.05 && unmatched.misfit.rms_ratio > 0.2, "{matched:?}");
    }

    #[test]
    fn transforms_are_hardly_longer_than_the_motion() {
        assert_eq!([1, 5, 9, 1000, 9001].map(transform_length), [1, 6, 9, 1024, 9216]);
    }

    #[test]
    fn what_cannot_be_matched_is_refused() {
        let fine = SynthesisOptions::default();
        let refused = |options: SynthesisOptions| match synthesize(melbourne_de, 1, 0, &options) {
            Err(SynthesisError::Option { name, .. }) => name,
            other => panic!("{other:?}"),
        };
        assert_eq!(refused(SynthesisOptions { dt_s: 0.02, ..fine }), "dt_s");
        assert_eq!(refused(SynthesisOptions { lead_in_s: f64::NAN, ..fine }), "lead_in_s");
        assert_eq!(refused(SynthesisOptions { shaking_s: 9.0, ..fine }), "shaking_s");
        assert_eq!(refused(SynthesisOptions { tail_s: -1.0, ..fine }), "tail_s");
        assert_eq!(refused(SynthesisOptions { envelope_s: 0.0, ..fine }), "envelope_s");
        assert_eq!(refused(SynthesisOptions { tail_s: 1e9, ..fine }), "the number of samples");
        let target = synthesize(|t| 1.0 - t, 1, 0, &fine);
        assert!(matches!(target, Err(SynthesisError::Target { period_s, .. }) if period_s >= 1.0), "{target:?}");
        let zeros = Motion::new(0.01, vec![0.0; 2000]).unwrap();
        assert_eq!(match_motion(&zeros, melbourne_de, 5), Err(SynthesisError::NoContent));
        let short = Motion::new(0.01, vec![1.0; 200]).unwrap();
        assert!(matches!(match_motion(&short, melbourne_de, 5), Err(SynthesisError::TooShort { .. })));
    }
}
