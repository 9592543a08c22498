//! A Fourier transform and its inverse, prepared once and used many times.

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlannerScalar};
use std::sync::Arc;

/// Transforms of one length with their work space.
pub(super) struct Transform {
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    pub(super) bins: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Transform {
    /// A transform for motions of up to `samples` samples.
    pub(super) fn new(samples: usize) -> Self {
        // The scalar planner: its results do not depend on the vector units of the processor.
        let mut planner = FftPlannerScalar::new();
        let length = transform_length(samples);
        let (forward, inverse) = (
            planner.plan_fft_forward(length),
            planner.plan_fft_inverse(length),
        );
        let scratch = forward
            .get_inplace_scratch_len()
            .max(inverse.get_inplace_scratch_len());
        Self {
            forward,
            inverse,
            bins: vec![Complex::default(); length],
            scratch: vec![Complex::default(); scratch],
        }
    }

    /// Number of bins.
    pub(super) fn length(&self) -> usize {
        self.bins.len()
    }

    /// Spacing of the bins \[Hz\].
    pub(super) fn step_hz(&self, dt_s: f64) -> f64 {
        1.0 / (self.length() as f64 * dt_s)
    }

    /// The bins of `accel`, with zeros appended.
    pub(super) fn forward(&mut self, accel: &[f64]) {
        self.bins.fill(Complex::default());
        for (bin, &a) in self.bins.iter_mut().zip(accel) {
            bin.re = a;
        }
        self.forward
            .process_with_scratch(&mut self.bins, &mut self.scratch);
    }

    /// Multiplies the amplitudes by `gain(k)` for bins 1 to the middle, and by 0 at zero frequency.
    pub(super) fn multiply(&mut self, mut gain: impl FnMut(usize) -> f64) {
        let length = self.length();
        self.bins[0] = Complex::default();
        for k in 1..=length / 2 {
            let gain = gain(k);
            self.bins[k] *= gain;
            // The mirror image, which the middle bin does not have.
            if k < length - k {
                self.bins[length - k] *= gain;
            }
        }
    }

    /// The inverse transform, back to samples.
    pub(super) fn inverse(&mut self, accel: &mut [f64]) {
        self.inverse
            .process_with_scratch(&mut self.bins, &mut self.scratch);
        let length = self.length() as f64;
        for (a, bin) in accel.iter_mut().zip(&self.bins) {
            *a = bin.re / length;
        }
    }
}

/// The smallest length of the form 2^a, 3·2^a or 9·2^a that is at least `samples`: fast to
/// transform and little longer.
fn transform_length(samples: usize) -> usize {
    let above = |factor: usize| factor * samples.div_ceil(factor).next_power_of_two();
    above(1).min(above(3)).min(above(9))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_are_hardly_longer_than_the_motion() {
        assert_eq!(
            [1, 5, 9, 1000, 9001].map(transform_length),
            [1, 6, 9, 1024, 9216]
        );
    }
}
