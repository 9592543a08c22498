//! Repeated drops on one pad: one stiffness and its confidence interval.

use rand::RngExt;
use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::SeedableRng;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// The result of one drop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PooledDrop {
    /// Stiffness k \[N/m\].
    pub stiffness_n_m: f64,
    /// Standard deviation of ln k.
    pub error_ratio: f64,
    /// Exponent n.
    pub exponent: f64,
}

/// One stiffness from several drops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pooled {
    /// Weighted mean of ln k, as a stiffness \[N/m\].
    pub stiffness_n_m: f64,
    /// The 95 % confidence interval of the stiffness \[N/m\].
    pub ci95_n_m: (f64, f64),
    /// Weighted mean of n.
    pub exponent: f64,
    /// Standard deviation of ln k among the drops; `None` for one drop.
    pub scatter_ratio: Option<f64>,
    /// Number of drops.
    pub count: usize,
}

/// Resamples of the bootstrap, which determine its standard deviation to 2 %.
const RESAMPLES: u32 = 2000;
/// 97.5 % quantile of the normal distribution: half of a 95 % interval in standard errors.
pub const NORMAL_975: f64 = 1.959_963_984_540_054;

/// Pools drops on one pad: the mean of ln k with the weights 1/(sᵢ² + τ²), where τ is the scatter
/// that the errors sᵢ of the drops do not explain. The interval is the wider of two: Student's t
/// times the bootstrap's standard deviation over the drops, and the drops' own errors, which
/// repeats do not reduce because height and mass are the same in all of them. `None` without drops.
///
/// The random numbers depend on `seed` alone.
///
/// # Reference
/// DerSimonian and Laird (1986) for τ; Efron and Tibshirani (1993) for the bootstrap.
///
/// # Example
/// Two drops that agree exactly have the interval of one:
/// ```
/// use freestand::identify::{PooledDrop, pool_drops};
/// let one = PooledDrop { stiffness_n_m: 2e6, error_ratio: 0.01, exponent: 1.0 };
/// let pooled = pool_drops(&[one, one], 1).unwrap();
/// assert!((pooled.ci95_n_m.1 / 2e6 - (0.01_f64 * 1.959964).exp()).abs() < 1e-9);
/// ```
pub fn pool_drops(drops: &[PooledDrop], seed: u64) -> Option<Pooled> {
    let count = drops.len();
    if count == 0 {
        return None;
    }
    let logs: Vec<f64> = drops.iter().map(|drop| drop.stiffness_n_m.ln()).collect();
    let own: Vec<f64> = drops
        .iter()
        .map(|drop| drop.error_ratio.max(1e-9))
        .collect();
    let weights = weights(&logs, &own);
    let total: f64 = weights.iter().sum();
    let weighted =
        |of: &dyn Fn(usize) -> f64| (0..count).map(|i| weights[i] * of(i)).sum::<f64>() / total;
    let mean = weighted(&|i| logs[i]);
    let within = NORMAL_975 * weighted(&|i| own[i] * own[i]).sqrt();
    let between = if count > 1 {
        student(count) * bootstrap_error(&logs, &weights, seed)
    } else {
        0.0
    };
    let half = within.max(between);
    let scatter = (count > 1).then(|| {
        let middle = logs.iter().sum::<f64>() / count as f64;
        (logs.iter().map(|x| (x - middle).powi(2)).sum::<f64>() / (count - 1) as f64).sqrt()
    });
    Some(Pooled {
        stiffness_n_m: mean.exp(),
        ci95_n_m: ((mean - half).exp(), (mean + half).exp()),
        exponent: weighted(&|i| drops[i].exponent),
        scatter_ratio: scatter,
        count,
    })
}

/// 1/(sᵢ² + τ²).
fn weights(logs: &[f64], own: &[f64]) -> Vec<f64> {
    let plain: Vec<f64> = own.iter().map(|s| 1.0 / (s * s)).collect();
    let total: f64 = plain.iter().sum();
    let mean = plain.iter().zip(logs).map(|(w, x)| w * x).sum::<f64>() / total;
    let q: f64 = plain
        .iter()
        .zip(logs)
        .map(|(w, x)| w * (x - mean).powi(2))
        .sum();
    let squares: f64 = plain.iter().map(|w| w * w).sum();
    let below = total - squares / total;
    let tau2 = if below > 0.0 {
        ((q - (logs.len() - 1) as f64) / below).max(0.0)
    } else {
        0.0
    };
    own.iter().map(|s| 1.0 / (s * s + tau2)).collect()
}

/// The standard deviation of the weighted mean over resampled drops, with n/(n−1) for the small
/// sample.
fn bootstrap_error(logs: &[f64], weights: &[f64], seed: u64) -> f64 {
    let count = logs.len();
    let mut random = ChaCha12Rng::seed_from_u64(seed);
    let means: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let (mut sum, mut total) = (0.0, 0.0);
            for _ in 0..count {
                let i = random.random_range(0..count);
                sum += weights[i] * logs[i];
                total += weights[i];
            }
            sum / total
        })
        .collect();
    let mean = means.iter().sum::<f64>() / f64::from(RESAMPLES);
    let variance = means.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(RESAMPLES - 1);
    (variance * count as f64 / (count - 1) as f64).sqrt()
}

/// 97.5 % quantile of Student's t.
fn student(count: usize) -> f64 {
    StudentsT::new(0.0, 1.0, (count - 1) as f64).map_or(NORMAL_975, |t| t.inverse_cdf(0.975))
}
