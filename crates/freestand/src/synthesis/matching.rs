//! Passes in the frequency domain that match a motion to a target spectrum.

use super::frame::Frame;
use super::transform::Filter;
use super::wavelet::Kernel;
use super::{
    DAMPING_RATIO, LONGEST_PERIOD_S, MATCHED_PERIODS, MAX_SAMPLES, MatchedMotion, Misfit,
    Parameter, SHORTEST_PERIOD_S, SynthesisError,
};
use crate::G0_M_S2;
use crate::measures::measures;
use crate::motion::Motion;
use crate::oscillator::DisplacementBank;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// Each pass multiplies amplitudes below this by f/f₀ \[Hz\]. Without it the passes amplify periods
/// beyond the longest matched one, which no oscillator controls: the displacement grows threefold
/// and the fit is no better.
const LOW_CUT_HZ: f64 = 0.15;
/// A pass with momentum cuts as so many plain passes do: eight take the place of thirty.
const PLAIN_PASSES: i32 = 4;
/// Roll-off corner of the first shaping \[Hz\], a little above the highest matched frequency; the
/// passes do the rest.
const HIGH_CORNER_HZ: f64 = 25.0;
/// A pass is better than the best so far if its rms is smaller by this share. Passes that have
/// converged differ by rounding, and the choice of the best must not depend on the processor.
const BETTER_BY_RATIO: f64 = 1e-6;
/// Longest time step of the oscillators of the spectrum \[s\]: a tenth of the shortest period. With
/// a record's own step of 0.02 s they would miss up to a quarter of their peaks.
const LONGEST_STEP_S: f64 = 0.005;
/// The largest number of points for the oscillators.
const MAX_POINTS: f64 = 16.0 * MAX_SAMPLES;

/// How a ratio of spectra becomes a gain of Fourier amplitudes.
pub(super) enum Gain {
    /// The ratio at T = 1/f, with the low cut.
    AtPeriod,
    /// Wavelets scaled by the ratio at their period.
    Wavelets(Kernel),
}

/// What all motions of one length and time step share, prepared once.
pub(super) struct Layout {
    dt_s: f64,
    pub(super) frame: Frame,
    periods_s: Vec<f64>,
    bank: DisplacementBank,
    /// Steps of the oscillators for each step of the motion.
    substeps: usize,
    filter: Filter,
    /// The frequencies of the filter, from zero to half the sampling rate.
    bins: Vec<Bin>,
    /// The first bin above the matched frequencies.
    above: usize,
}

impl Layout {
    /// The same with oscillators that are quick.
    pub(super) fn quick(self) -> Result<Self, SynthesisError> {
        let step_s = self.dt_s / self.substeps as f64;
        Ok(Self {
            bank: DisplacementBank::quick(&self.periods_s, DAMPING_RATIO, step_s)?,
            ..self
        })
    }
}

/// The motion that fits best so far.
struct Best {
    accel: Vec<f64>,
    ln_ratios: Vec<f64>,
    rms: f64,
}

impl Default for Best {
    fn default() -> Self {
        Self {
            accel: Vec::new(),
            ln_ratios: Vec::new(),
            rms: f64::INFINITY,
        }
    }
}

impl Best {
    /// Keeps a motion that fits better, and says whether it does.
    fn consider(&mut self, accel: &[f64], ln_ratios: &[f64]) -> bool {
        let rms = rms_misfit(ln_ratios);
        let is_better = rms < self.rms * (1.0 - BETTER_BY_RATIO);
        if is_better {
            accel.clone_into(&mut self.accel);
            ln_ratios.clone_into(&mut self.ln_ratios);
            self.rms = rms;
        }
        is_better
    }
}

/// A frequency of the filter.
#[derive(Clone, Copy)]
struct Bin {
    frequency_hz: f64,
    place: Place,
}

impl Layout {
    pub(super) fn new(dt_s: f64, frame: Frame) -> Result<Self, SynthesisError> {
        // A step of 0.005 s except for its last digits counts as 0.005 s.
        let substeps = (dt_s / LONGEST_STEP_S - 1e-9).ceil().max(1.0);
        let points = substeps * frame.taper.len() as f64;
        let steps = Parameter::Other("the number of samples at steps of 0.005 s");
        steps.check(points <= MAX_POINTS, "at most 16777216", points)?;
        let periods_s = matched_periods_s();
        let filter = Filter::new(frame.taper.len());
        let step_hz = filter.step_hz(dt_s);
        let bin = |k: usize| {
            let frequency_hz = k as f64 * step_hz;
            Bin {
                frequency_hz,
                place: Place::of(frequency_hz),
            }
        };
        let bins: Vec<Bin> = (0..=filter.bins()).map(bin).collect();
        let above = bins.partition_point(|bin| bin.frequency_hz < 1.0 / SHORTEST_PERIOD_S);
        Ok(Self {
            dt_s,
            bank: DisplacementBank::new(&periods_s, DAMPING_RATIO, dt_s / substeps)?,
            substeps: substeps as usize,
            bins,
            above,
            periods_s,
            filter,
            frame,
        })
    }
}

/// The passes of one motion.
pub(super) struct Matcher<'a> {
    layout: &'a Layout,
    gain: Gain,
    pub(super) target_m_s2: Vec<f64>,
    target_zpa_g: f64,
    filter: Filter,
    fine: Vec<f64>,
}

/// How a pass changes the logarithms of the amplitudes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pass {
    /// The share that it removes of what is missed, ln PSA/target.
    pub(super) step: f64,
    /// The share that it repeats of the change before.
    pub(super) momentum: f64,
}

impl<'a> Matcher<'a> {
    pub(super) fn new(
        layout: &'a Layout,
        target_sa_g: &impl Fn(f64) -> f64,
        gain: Gain,
    ) -> Result<Self, SynthesisError> {
        let target = |period_s: f64| match target_sa_g(period_s) {
            sa_g if sa_g > 0.0 && sa_g.is_finite() => Ok(sa_g),
            sa_g => Err(SynthesisError::Target { period_s, sa_g }),
        };
        let target_m_s2 = layout
            .periods_s
            .iter()
            .map(|&t| target(t).map(|sa_g| sa_g * G0_M_S2))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            layout,
            gain,
            target_m_s2,
            target_zpa_g: target(0.0)?,
            filter: layout.filter.clone(),
            fine: Vec::new(),
        })
    }

    /// First shape of white noise: Fourier amplitudes like the target's pseudo-velocity Sa/ω, cut
    /// off outside its periods.
    pub(super) fn shape_noise(&mut self, accel: &mut [f64]) {
        let ln_target: Vec<f64> = self.target_m_s2.iter().map(|sa| sa.ln()).collect();
        self.amplify_each(accel, |frequency_hz, place| {
            let low = (frequency_hz * LONGEST_PERIOD_S).min(1.0).powi(2);
            let high = 1.0 / (1.0 + (frequency_hz / HIGH_CORNER_HZ).powi(4));
            place.interpolate(&ln_target).exp() / frequency_hz.max(1.0 / LONGEST_PERIOD_S)
                * low
                * high
        });
    }

    /// Passes with momentum, then the factor that takes the mean of ln PSA/target over the periods of
    /// `over_s` to 0. A pass changes the logarithms of the amplitudes by its [`Pass::step`] and
    /// [`Pass::momentum`], and cuts low frequencies as [`PLAIN_PASSES`] passes do.
    pub(super) fn follow(
        &mut self,
        accel: Vec<f64>,
        passes: &[Pass],
        over_s: &RangeInclusive<f64>,
    ) -> Result<Motion, SynthesisError> {
        let layout = self.layout;
        let mut ln_gains = vec![0.0; MATCHED_PERIODS];
        let mut next = passes.iter();
        let (best, _) = self.best_of(accel, passes.len(), |matcher, accel, ln_ratios| {
            let Pass { step, momentum } = next.next().copied().unwrap_or_default();
            for (ln_gain, ln_ratio) in ln_gains.iter_mut().zip(ln_ratios) {
                *ln_gain = momentum * *ln_gain - step * ln_ratio;
            }
            let gains: Vec<f64> = ln_gains.iter().map(|ln| ln.exp()).collect();
            matcher.amplify(accel, |k| {
                // The bins above have one gain, and are most of them.
                if k >= layout.above {
                    return gains[0];
                }
                let Bin {
                    frequency_hz,
                    place,
                } = layout.bins[k];
                place.interpolate(&gains) * (frequency_hz / LOW_CUT_HZ).min(1.0).powi(PLAIN_PASSES)
            });
        });
        let of_mean: Vec<f64> = best
            .ln_ratios
            .into_iter()
            .zip(&self.layout.periods_s)
            .filter(|(_, period_s)| over_s.contains(period_s))
            .map(|(ln_ratio, _)| ln_ratio)
            .collect();
        let mean = of_mean.iter().sum::<f64>() / of_mean.len() as f64;
        let accel = best.accel.iter().map(|a| a * (-mean).exp()).collect();
        Ok(Motion::new(self.layout.dt_s, accel)?)
    }

    pub(super) fn run(
        &mut self,
        mut accel: Vec<f64>,
        passes: usize,
    ) -> Result<MatchedMotion, SynthesisError> {
        self.layout.frame.settle(&mut accel);
        // One factor first, so that pass 0 is the start at its best scale.
        let mean = self.ln_ratios(&accel).iter().sum::<f64>() / MATCHED_PERIODS as f64;
        if !mean.is_finite() {
            return Err(SynthesisError::NoContent);
        }
        accel.iter_mut().for_each(|a| *a *= (-mean).exp());
        let (best, pass) = self.best_of(accel, passes, Self::pass);
        let motion = Motion::new(self.layout.dt_s, best.accel)?;
        let misfit = self.described(&motion, &best.ln_ratios);
        Ok(MatchedMotion {
            motion,
            misfit,
            pass,
        })
    }

    /// The best motion of a start and so many passes, each of which changes a motion by its ln PSA/target;
    /// and after how many passes it was.
    fn best_of(
        &mut self,
        mut accel: Vec<f64>,
        passes: usize,
        mut pass: impl FnMut(&mut Self, &mut [f64], &[f64]),
    ) -> (Best, usize) {
        let (mut best, mut best_pass) = (Best::default(), 0);
        for done in 0..=passes {
            let ln_ratios = self.ln_ratios(&accel);
            if best.consider(&accel, &ln_ratios) {
                best_pass = done;
            }
            if done < passes {
                pass(self, &mut accel, &ln_ratios);
            }
        }
        (best, best_pass)
    }

    fn pass(&mut self, accel: &mut [f64], ln_ratios: &[f64]) {
        let gains = match &self.gain {
            Gain::AtPeriod => None,
            Gain::Wavelets(kernel) => Some(kernel.gains(ln_ratios)),
        };
        self.amplify_each(accel, |frequency_hz, place| match &gains {
            None => (-place.interpolate(ln_ratios)).exp() * (frequency_hz / LOW_CUT_HZ).min(1.0),
            Some(gains) => gains.at(frequency_hz),
        });
    }

    /// The misfit of a motion as given.
    pub(super) fn misfit(&mut self, motion: &Motion) -> Misfit {
        let ln_ratios = self.ln_ratios(motion.accel_m_s2());
        self.described(motion, &ln_ratios)
    }

    fn described(&self, motion: &Motion, ln_ratios: &[f64]) -> Misfit {
        let (mut worst_ratio, mut worst_period_s) = (0.0_f64, self.layout.periods_s[0]);
        for (ln_ratio, &period_s) in ln_ratios.iter().zip(&self.layout.periods_s) {
            if ln_ratio.exp_m1().abs() > worst_ratio.abs() {
                (worst_ratio, worst_period_s) = (ln_ratio.exp_m1(), period_s);
            }
        }
        let measures = measures(motion);
        Misfit {
            rms_ratio: rms_misfit(ln_ratios),
            worst_ratio,
            worst_period_s,
            pga_g: measures.pga_m_s2 / G0_M_S2,
            target_zpa_g: self.target_zpa_g,
            d5_95_s: measures.d5_95_s,
            pgv_m_s: measures.pgv_m_s,
        }
    }

    /// ln(PSA/target) at the matched periods, of the motion that is linear between its samples.
    fn ln_ratios(&mut self, accel: &[f64]) -> Vec<f64> {
        let Layout {
            substeps,
            bank,
            periods_s,
            ..
        } = self.layout;
        let looked_at = if *substeps == 1 {
            accel
        } else {
            self.fine.clear();
            for (a, b) in accel.iter().zip(accel.iter().skip(1)) {
                let at = |step: usize| a + (b - a) * (step as f64 / *substeps as f64);
                self.fine.extend((0..*substeps).map(at));
            }
            self.fine.extend(accel.last());
            &self.fine
        };
        let sd_m = bank.peaks_m(looked_at);
        let psa = sd_m
            .iter()
            .zip(periods_s)
            .map(|(sd, t)| sd * (TAU / t) * (TAU / t));
        psa.zip(&self.target_m_s2)
            .map(|(psa, target)| (psa / target).ln())
            .collect()
    }

    /// [`Matcher::amplify`] by a gain of the frequency of a bin and its place among the matched periods.
    fn amplify_each(&mut self, accel: &mut [f64], gain: impl Fn(f64, Place) -> f64) {
        let bins = &self.layout.bins;
        self.amplify(accel, |k| gain(bins[k].frequency_hz, bins[k].place));
    }

    /// Multiplies the Fourier amplitudes of bins by their gains, drops the mean, tapers the ends
    /// and removes the drift.
    fn amplify(&mut self, accel: &mut [f64], gain: impl Fn(usize) -> f64) {
        self.filter.apply(accel, gain);
        self.layout.frame.settle(accel);
    }
}

/// The position of a frequency among the matched periods: between `index` and the next one, at
/// `fraction` of the way; constant beyond the ends.
#[derive(Clone, Copy)]
struct Place {
    index: usize,
    fraction: f64,
}

impl Place {
    fn of(frequency_hz: f64) -> Self {
        let last = (MATCHED_PERIODS - 1) as f64;
        let along = -(frequency_hz * SHORTEST_PERIOD_S).ln()
            / (LONGEST_PERIOD_S / SHORTEST_PERIOD_S).ln()
            * last;
        let along = along.clamp(0.0, last);
        let index = (along as usize).min(MATCHED_PERIODS - 2);
        Self {
            index,
            fraction: along - index as f64,
        }
    }

    fn interpolate(self, values: &[f64]) -> f64 {
        values[self.index] + (values[self.index + 1] - values[self.index]) * self.fraction
    }
}

/// The matched periods, rising \[s\].
pub fn matched_periods_s() -> Vec<f64> {
    let span: f64 = LONGEST_PERIOD_S / SHORTEST_PERIOD_S;
    (0..MATCHED_PERIODS)
        .map(|i| SHORTEST_PERIOD_S * span.powf(i as f64 / (MATCHED_PERIODS - 1) as f64))
        .collect()
}

fn rms_misfit(ln_ratios: &[f64]) -> f64 {
    (ln_ratios
        .iter()
        .map(|ln_ratio| ln_ratio.exp_m1().powi(2))
        .sum::<f64>()
        / ln_ratios.len() as f64)
        .sqrt()
}
