//! Filters by the gains of Fourier amplitudes, prepared once and used many times.

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlannerScalar};
use std::f64::consts::PI;
use std::sync::Arc;

/// Filters of motions of one length with their work space.
///
/// The N samples of a real motion are packed into h = N/2 complex ones, its even samples plus i times its odd
/// ones, whose transform Z is half the work. With E and O the transforms of the even and the odd samples, Z =
/// E + iO, and the transform of the motion is X_k = E_k + e^(−iθ) O_k, θ = πk/h. Gains g of X are, for Z and without
/// X, `Z_k ← (s − d sin θ) Z_k + i d cos θ Z*_(h−k)`, with s = g_k + g_(h−k) and d = g_k − g_(h−k), up to a factor
/// of 2.
#[derive(Clone)]
pub(super) struct Filter {
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    /// sin θ and cos θ, to the middle.
    turns: Arc<[(f64, f64)]>,
    /// Of the bins from zero frequency to half the sampling rate.
    gains: Vec<f64>,
    packed: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Filter {
    /// A filter for motions of up to `samples` samples.
    pub(super) fn new(samples: usize) -> Self {
        // The scalar planner: its results do not depend on the vector units of the processor.
        let mut planner = FftPlannerScalar::new();
        let half = transform_length(samples) / 2;
        let (forward, inverse) = (
            planner.plan_fft_forward(half),
            planner.plan_fft_inverse(half),
        );
        let scratch = forward
            .get_inplace_scratch_len()
            .max(inverse.get_inplace_scratch_len());
        let turn = |k: usize| (PI * k as f64 / half as f64).sin_cos();
        Self {
            forward,
            inverse,
            turns: (0..=half / 2).map(turn).collect(),
            gains: vec![0.0; half + 1],
            packed: vec![Complex::default(); half],
            scratch: vec![Complex::default(); scratch],
        }
    }

    /// Number of bins above zero frequency.
    pub(super) fn bins(&self) -> usize {
        self.packed.len()
    }

    /// Spacing of the bins \[Hz\].
    pub(super) fn step_hz(&self, dt_s: f64) -> f64 {
        1.0 / ((2 * self.bins()) as f64 * dt_s)
    }

    /// Multiplies the Fourier amplitudes of `accel`, with zeros appended, by `gain(k)` for bins 1 to the last, and by
    /// 0 at zero frequency.
    pub(super) fn apply(&mut self, accel: &mut [f64], gain: impl Fn(usize) -> f64) {
        let half = self.bins();
        let per_length = 1.0 / (2 * half) as f64;
        for (k, scaled) in self.gains.iter_mut().enumerate().skip(1) {
            *scaled = gain(k) * per_length;
        }
        self.packed.fill(Complex::default());
        let (pairs, single) = accel.as_chunks::<2>();
        for (packed, [re, im]) in self.packed.iter_mut().zip(pairs) {
            *packed = Complex::new(*re, *im);
        }
        if let ([re], Some(packed)) = (single, self.packed.get_mut(pairs.len())) {
            *packed = Complex::new(*re, 0.0);
        }
        self.forward
            .process_with_scratch(&mut self.packed, &mut self.scratch);
        for (k, (sin, cos)) in self.turns.iter().enumerate() {
            // The packed bins are periodic: bin `half` is bin 0.
            let mirrored = (half - k) % half;
            let (one, other) = (self.packed[k], self.packed[mirrored]);
            let (sum, difference) = (
                self.gains[k] + self.gains[half - k],
                self.gains[k] - self.gains[half - k],
            );
            let across = difference * cos;
            let turned = |own: Complex<f64>, factor: f64, from: Complex<f64>| {
                Complex::new(
                    own.re * factor + from.im * across,
                    own.im * factor + from.re * across,
                )
            };
            self.packed[k] = turned(one, sum - difference * sin, other);
            self.packed[mirrored] = turned(other, sum + difference * sin, one);
        }
        self.inverse
            .process_with_scratch(&mut self.packed, &mut self.scratch);
        let (pairs, single) = accel.as_chunks_mut::<2>();
        if let ([re], Some(packed)) = (single, self.packed.get(pairs.len())) {
            *re = packed.re;
        }
        for (pair, packed) in pairs.iter_mut().zip(&self.packed) {
            *pair = [packed.re, packed.im];
        }
    }
}

/// The smallest length of the form 2^a, 3·2^a or 9·2^a, a > 0, that is at least `samples`: fast to
/// transform and little longer.
fn transform_length(samples: usize) -> usize {
    let above = |factor: usize| 2 * factor * samples.div_ceil(2 * factor).next_power_of_two();
    above(1).min(above(3)).min(above(9))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_are_hardly_longer_than_the_motion() {
        assert_eq!(
            [1, 5, 9, 1000, 9001].map(transform_length),
            [2, 6, 12, 1024, 9216]
        );
    }

    /// The definition: every bin of the samples with zeros appended, times its gain, and back.
    #[test]
    fn a_filter_multiplies_the_amplitudes_of_bins() {
        for samples in [2, 3, 5, 11, 17] {
            let accel: Vec<f64> = (0..samples).map(|k| f64::from(k * k % 7) - 2.0).collect();
            let mut filter = Filter::new(accel.len());
            let length = 2 * filter.bins();
            let gain = |k: usize| 1.0 / (1.0 + (k * k) as f64) + 0.3 * (k % 3) as f64;
            let turn = |k: usize, n: usize| {
                Complex::cis(-2.0 * PI * (k * n % length) as f64 / length as f64)
            };
            let bin = |k: usize| -> Complex<f64> {
                accel.iter().enumerate().map(|(n, a)| turn(k, n) * a).sum()
            };
            let filtered = |n: usize| {
                let gain_of = |k: usize| gain(k.min(length - k));
                let sum: Complex<f64> = (1..length)
                    .map(|k| bin(k) * gain_of(k) * turn(k, n).conj())
                    .sum();
                sum.re / length as f64
            };
            let mut found = accel.clone();
            filter.apply(&mut found, gain);
            for (n, found) in found.iter().enumerate() {
                // Up to 17 bins of 17 samples of at most 4, and back.
                assert!(
                    (found - filtered(n)).abs() < 1e-13,
                    "{samples} {n}: {found}"
                );
            }
        }
    }
}
