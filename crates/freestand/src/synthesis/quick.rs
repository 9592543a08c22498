//! Motions that follow a rough spectrum after a few passes.

use super::matching::{Gain, Layout, Matcher, Pass};
use super::noise::noise;
use super::{SynthesisError, SynthesisOptions, shaking_layout, window, windowed};
use crate::motion::Motion;
use std::ops::RangeInclusive;

/// Passes of a motion by a standard normal number: six below the first of these, eight below the
/// second, else nine. A quarter, a quarter and a half, because of thirty plain passes the best is the
/// last for half of the motions and for the others a much earlier one, which shakes for less long.
const FEWER_PASSES_BELOW: [(f64, usize); 2] = [(-0.6745, 6), (0.0, 8)];
const MOST_PASSES: usize = 9;
/// What a pass changes the logarithm of an amplitude by, per ln PSA/target, and the share of the change
/// before that it repeats. The first and the last pass are plain ones.
///
/// A period that cannot be followed, such as a valley between peaks, keeps its ratio r from pass to
/// pass: thirty plain passes change the logarithm of its amplitude by −30 r, and that is what lengthens
/// the shaking. Nine of these change it by −29.5 r, eight by −25 r and six by −16 r.
const STEP: f64 = 1.88;
const MOMENTUM: f64 = 0.6;

/// Makes motions whose spectra follow targets that are as rough as those of records, eight times
/// as fast as [`synthesize`](super::synthesize), with the statistics of its motions.
///
/// The passes of [`synthesize`](super::synthesize) from the same noise, with momentum between the first
/// and the last; the oscillators are in single precision, and those of long periods see a share of the
/// samples. The pass that fits best is kept.
///
/// # Reference
/// Polyak (1964), "Some methods of speeding up the convergence of iteration methods", for the momentum.
///
/// # Accuracy
/// For spectra with the deviations of [`GroundSpread`](crate::worlds::GroundSpread), the example
/// `world_motions` of the benches compares 4000 worlds with those of thirty passes.
pub struct QuickMatcher {
    options: SynthesisOptions,
    layout: Layout,
    window: Vec<f64>,
}

impl QuickMatcher {
    /// Prepares for motions of this layout of time; its number of passes is not used.
    ///
    /// # Errors
    /// Options out of range.
    pub fn new(options: &SynthesisOptions) -> Result<Self, SynthesisError> {
        Ok(Self {
            options: *options,
            layout: shaking_layout(options)?.quick()?,
            window: window(options),
        })
    }

    /// The options.
    pub fn options(&self) -> &SynthesisOptions {
        &self.options
    }

    /// The motion of a stream of random numbers of `seed`, whose PSA follows `target_sa_g`
    /// (period \[s\] to g, 5 % damping). Its mean ln PSA/target over the periods of `over_s` is 0.
    ///
    /// # Errors
    /// A target that is not positive and finite.
    pub fn motion(
        &self,
        target_sa_g: impl Fn(f64) -> f64,
        over_s: &RangeInclusive<f64>,
        seed: u64,
        stream: u64,
    ) -> Result<Motion, SynthesisError> {
        let mut matcher = Matcher::new(&self.layout, &target_sa_g, Gain::AtPeriod)?;
        let (mut accel, drawn) = self.noise(seed, stream);
        let fewer = FEWER_PASSES_BELOW.iter().find(|(below, _)| drawn < *below);
        let passes = fewer.map_or(MOST_PASSES, |(_, passes)| *passes);
        matcher.shape_noise(&mut accel);
        matcher.follow(accel, &steps(passes), over_s)
    }

    /// Noise under the window, and one number more. Apart from what depends on the target, which is compiled with
    /// the crate that has it and is optimised as that is.
    fn noise(&self, seed: u64, stream: u64) -> (Vec<f64>, f64) {
        let mut noise = noise(seed, stream);
        let accel = windowed(&mut noise, &self.window, &self.options);
        (accel, noise())
    }
}

/// So many passes with momentum, of which the first and the last are plain.
fn steps(passes: usize) -> Vec<Pass> {
    const PLAIN: Pass = Pass {
        step: 1.0,
        momentum: 0.0,
    };
    let with_momentum = Pass {
        step: STEP,
        momentum: MOMENTUM,
    };
    let mut steps = vec![with_momentum; passes];
    steps[0] = PLAIN;
    steps[passes - 1] = PLAIN;
    steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_passes_with_momentum_change_amplitudes_as_much_as_many_plain_ones() {
        let of_constant_ratio = |passes: usize| {
            let (mut change, mut sum) = (0.0, 0.0);
            for Pass { step, momentum } in steps(passes) {
                change = momentum * change - step;
                sum += change;
            }
            (sum * 10.0_f64).round() / 10.0
        };
        assert_eq!([6, 8, 9].map(of_constant_ratio), [-16.0, -24.9, -29.5]);
    }
}
