//! The Fourier transform of a motion and its inverse, prepared once and used many times.

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlannerScalar};
use std::f64::consts::TAU;
use std::sync::Arc;

const I: Complex<f64> = Complex::new(0.0, 1.0);

/// Transforms of one length with their work space.
///
/// A real motion of N samples is a complex one of N/2, its even samples plus i times its odd ones,
/// whose transform is half the work: with E and O the transforms of the even and the odd samples, X =
/// E + e^(−2πik/N) O.
#[derive(Clone)]
pub(super) struct Transform {
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    /// e^(−2πik/N), to the middle bin.
    turns: Arc<[Complex<f64>]>,
    /// From zero frequency to the middle bin.
    pub(super) bins: Vec<Complex<f64>>,
    packed: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Transform {
    /// A transform for motions of up to `samples` samples.
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
        let turn = |k: usize| Complex::cis(-TAU * k as f64 / (2 * half) as f64);
        Self {
            forward,
            inverse,
            turns: (0..=half).map(turn).collect(),
            bins: vec![Complex::default(); half + 1],
            packed: vec![Complex::default(); half],
            scratch: vec![Complex::default(); scratch],
        }
    }

    /// Number of samples that are transformed.
    pub(super) fn length(&self) -> usize {
        2 * self.packed.len()
    }

    /// Spacing of the bins \[Hz\].
    pub(super) fn step_hz(&self, dt_s: f64) -> f64 {
        1.0 / (self.length() as f64 * dt_s)
    }

    /// The bins of `accel`, with zeros appended.
    pub(super) fn forward(&mut self, accel: &[f64]) {
        self.packed.fill(Complex::default());
        for (packed, two) in self.packed.iter_mut().zip(accel.chunks(2)) {
            *packed = Complex::new(two[0], two.get(1).copied().unwrap_or(0.0));
        }
        self.forward
            .process_with_scratch(&mut self.packed, &mut self.scratch);
        // The packed bins are periodic: bin `half` is bin 0.
        let first = self.packed[0];
        let ones = self.packed.iter().chain([&first]);
        let mirrored = [&first].into_iter().chain(self.packed.iter().rev());
        for (((bin, turn), one), mirrored) in self
            .bins
            .iter_mut()
            .zip(&*self.turns)
            .zip(ones)
            .zip(mirrored)
        {
            let mirrored = mirrored.conj();
            let (even, i_odd) = ((one + mirrored) * 0.5, (one - mirrored) * 0.5);
            *bin = even - turn * I * i_odd;
        }
    }

    /// Multiplies the amplitudes by `gain(k)` for bins 1 to the middle, and by 0 at zero frequency.
    pub(super) fn multiply(&mut self, mut gain: impl FnMut(usize) -> f64) {
        self.bins[0] = Complex::default();
        for (k, bin) in self.bins.iter_mut().enumerate().skip(1) {
            *bin *= gain(k);
        }
    }

    /// The energy of all bins, those of negative frequencies too.
    pub(super) fn energy(&self) -> f64 {
        let of = |bin: Option<&Complex<f64>>| bin.map_or(0.0, Complex::norm_sqr);
        let both: f64 = self.bins.iter().map(Complex::norm_sqr).sum();
        2.0 * both - of(self.bins.first()) - of(self.bins.last())
    }

    /// The inverse transform, back to samples.
    pub(super) fn inverse(&mut self, accel: &mut [f64]) {
        let mirrored = self.bins.iter().rev();
        for (((packed, one), mirrored), turn) in self
            .packed
            .iter_mut()
            .zip(&self.bins)
            .zip(mirrored)
            .zip(&*self.turns)
        {
            let mirrored = mirrored.conj();
            let (even, odd) = (one + mirrored, (one - mirrored) * turn.conj());
            *packed = even + I * odd;
        }
        self.inverse
            .process_with_scratch(&mut self.packed, &mut self.scratch);
        let length = self.length() as f64;
        for (two, packed) in accel.chunks_mut(2).zip(&self.packed) {
            for (a, part) in two.iter_mut().zip([packed.re, packed.im]) {
                *a = part / length;
            }
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

    #[test]
    fn the_bins_are_those_of_the_definition_and_the_inverse_returns() {
        let accel: Vec<f64> = (0..11).map(|k| f64::from(k * k % 7) - 2.0).collect();
        let mut transform = Transform::new(accel.len());
        assert_eq!((transform.length(), transform.bins.len()), (12, 7));
        transform.forward(&accel);
        for (k, bin) in transform.bins.iter().enumerate() {
            let turn = |n: usize| Complex::cis(-TAU * (k * n) as f64 / 12.0);
            let sum: Complex<f64> = accel.iter().enumerate().map(|(n, a)| turn(n) * a).sum();
            // Eleven terms of at most 4.
            assert!((bin - sum).norm() < 1e-14 * 44.0, "{k}: {bin} {sum}");
        }
        // Parseval.
        let energy: f64 = accel.iter().map(|a| 12.0 * a * a).sum();
        assert!((transform.energy() / energy - 1.0).abs() < 1e-14);
        let mut back = vec![0.0; accel.len()];
        transform.inverse(&mut back);
        for (a, b) in accel.iter().zip(&back) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
    }
}
