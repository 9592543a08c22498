//! A motion with 2, 4, 8 … samples in place of each, on the band-limited curve through its samples.

use crate::motion::Motion;
use crate::signal::resample::upsampled_sinc;

/// Pairs of neighbours that determine a new sample between them, for the second, third … doubling:
/// the less of the band is filled, the fewer are needed.
const PAIRS: [usize; 5] = [16, 8, 6, 6, 6];

/// The largest factor.
pub(super) const MAX_FACTOR: usize = 1 << (PAIRS.len() + 1);

/// The samples of the motion and of every doubling of their rate up to `factor`, a power of two up
/// to [`MAX_FACTOR`]; fewer where the first doubling fails.
///
/// The first doubling fills the band up to its end and uses the whole motion (sinc, by FFT). After
/// it the upper half of the band is empty, and Lagrange's polynomial through a few neighbours, a
/// maximally flat half-band filter, is sufficient.
///
/// # Accuracy
/// 2e-5 of the amplitude at the motion's Nyquist frequency, 1e-7 at 0.8 of it, rounding at low
/// frequencies.
pub(super) fn doublings(arch: pulp::Arch, motion: &Motion, factor: usize) -> Vec<Vec<f64>> {
    let mut series = vec![motion.accel_m_s2().to_vec()];
    if factor < 2 {
        return series;
    }
    let Ok(doubled) = upsampled_sinc(motion, 2) else {
        return series;
    };
    series.push(doubled.accel_m_s2().to_vec());
    for pairs in PAIRS {
        let Some(last) = series.last().filter(|_| 1 << (series.len() - 1) < factor) else {
            break;
        };
        let next = between(arch, last, &weights(pairs));
        series.push(next);
    }
    series
}

/// Lagrange's weights of the neighbours at ±½, ±3/2 … for the middle, nearest first.
fn weights(pairs: usize) -> Vec<f64> {
    let node = |j: usize| (j as f64 + 0.5).powi(2);
    let weight = |j: usize| {
        let others = (0..pairs).filter(|&i| i != j);
        0.5 * others
            .map(|i| node(i) / (node(i) - node(j)))
            .product::<f64>()
    };
    (0..pairs).map(weight).collect()
}

/// One new sample between each pair of neighbours; beyond an end the samples are mirrored through
/// it.
fn between(arch: pulp::Arch, samples: &[f64], weights: &[f64]) -> Vec<f64> {
    let (pairs, last) = (weights.len(), samples.len() - 1);
    let mirrored = |end: f64, index: usize| 2.0 * end - samples[index.min(last)];
    let before = (1..pairs).rev().map(|k| {
        if k <= last {
            mirrored(samples[0], k)
        } else {
            samples[0]
        }
    });
    let after = (1..pairs).map(|k| {
        if k <= last {
            mirrored(samples[last], last - k)
        } else {
            samples[last]
        }
    });
    let wide: Vec<f64> = before.chain(samples.iter().copied()).chain(after).collect();
    let mut fine = Vec::with_capacity(2 * last + 1);
    let mut middles = [0.0; CHUNK];
    for (chunk, own) in samples[..last].chunks(CHUNK).enumerate() {
        let near = &wide[chunk * CHUNK..chunk * CHUNK + own.len() + 2 * pairs - 1];
        let middles = &mut middles[..own.len()];
        arch.dispatch(|| middle(near, weights, middles));
        for (&sample, &middle) in own.iter().zip(middles.iter()) {
            fine.extend([sample, middle]);
        }
    }
    fine.push(samples[last]);
    fine
}

/// New samples that are calculated together; they and their neighbours stay in the cache.
const CHUNK: usize = 512;

/// Σ weight (left + right) for all of `middles`, neighbour by neighbour.
#[inline(always)]
fn middle(near: &[f64], weights: &[f64], middles: &mut [f64]) {
    middles.fill(0.0);
    for (j, weight) in weights.iter().enumerate() {
        let (left, right) = (&near[weights.len() - 1 - j..], &near[weights.len() + j..]);
        for ((middle, left), right) in middles.iter_mut().zip(left).zip(right) {
            *middle += weight * (left + right);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sine that fades in and out, up to 0.8 of the Nyquist frequency: every doubling is on the
    /// curve.
    #[test]
    fn doublings_are_on_the_band_limited_curve() {
        for share in [0.05, 0.4, 0.8] {
            let curve = |k: f64| {
                (-((k - 300.0) / 60.0).powi(2)).exp() * (share * std::f64::consts::PI * k).sin()
            };
            let motion =
                Motion::new(1.0, (0..=600).map(|k| curve(f64::from(k))).collect()).unwrap();
            for (level, series) in doublings(pulp::Arch::new(), &motion, MAX_FACTOR)
                .iter()
                .enumerate()
            {
                let factor = f64::from(1u32 << level);
                assert_eq!(series.len(), 600 * (1 << level) + 1);
                let worst = series
                    .iter()
                    .enumerate()
                    .map(|(k, a)| (a - curve(k as f64 / factor)).abs());
                // The documented accuracy, with a margin for the width of the envelope's own
                // spectrum.
                assert!(worst.fold(0.0, f64::max) < 1e-6, "{share}, {factor}");
            }
        }
    }

    #[test]
    fn two_samples_are_enough_and_weights_sum_to_one() {
        let motion = Motion::new(1.0, vec![1.0, 3.0]).unwrap();
        let series = doublings(pulp::Arch::new(), &motion, MAX_FACTOR);
        assert_eq!(series.last().map(Vec::len), Some(MAX_FACTOR + 1));
        for pairs in PAIRS {
            assert!((2.0 * weights(pairs).iter().sum::<f64>() - 1.0).abs() < 1e-13);
        }
    }
}
