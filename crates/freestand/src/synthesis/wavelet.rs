//! Matching by wavelets: the gains of Fourier amplitudes that correspond to scaled wavelets.
//!
//! The continuous wavelet transform of a motion with ψ(t) = e^(−ζω|t|) sin ωt, ω = π, ζ = 0.05,
//! splits it into details, one for each period T (scale s = T/2), whose sum is the motion. A pass
//! multiplies each detail by target/spectrum at its period. Scaling whole details is a filter: the
//! detail of scale s has the Fourier transform A(f)·|ψ̂(2πfs)|² (up to a factor), so the pass
//! multiplies A(f) by `Σ r_k |ψ̂(2πf s_k)|² / Σ |ψ̂(2πf s_k)|²`, which has zero phase. It is
//! calculated as such: two Fourier transforms per pass instead of two for each scale.

use super::{LONGEST_PERIOD_S, MATCHED_PERIODS, SHORTEST_PERIOD_S};
use std::f64::consts::{PI, TAU};

/// Decay of the mother wavelet as a share of its frequency.
const ZETA: f64 = 0.05;
/// Scales beyond the matched periods on each side, whose details do not change: one decade.
const SCALES_OUTSIDE: usize = (MATCHED_PERIODS - 1) / 2;
/// This many of them are scaled with the outermost matched period (a factor of 1.6 in period);
/// otherwise the unchanged details would limit how far the response at that period can change.
const SCALES_HELD: isize = 12;
/// Points of the gain table between two scales; the bandwidth of a wavelet (5 %) contains about 10
/// of them.
const POINTS_PER_SCALE: usize = 8;
const POINTS: usize = (MATCHED_PERIODS - 1 + 2 * SCALES_OUTSIDE) * POINTS_PER_SCALE + 1;

/// Shares of the details of the matched periods in the motion at each of [`POINTS`] frequencies.
pub(super) struct Kernel {
    shares: Vec<[f64; MATCHED_PERIODS]>,
}

/// Gains at the frequencies of the kernel.
pub(super) struct Gains(Vec<f64>);

/// Steps of ln T between two scales.
fn ln_step() -> f64 {
    (LONGEST_PERIOD_S / SHORTEST_PERIOD_S).ln() / (MATCHED_PERIODS - 1) as f64
}

/// |ψ̂|², up to a factor, at the circular frequency `omega` times the scale.
fn mother(omega: f64) -> f64 {
    let a = ZETA * PI;
    let transform = a / (a * a + (omega - PI).powi(2)) - a / (a * a + (omega + PI).powi(2));
    transform * transform
}

impl Kernel {
    pub(super) fn new() -> Self {
        let shares = (0..POINTS)
            .map(|point| {
                let frequency_hz = frequency_hz(point);
                // Scale k has the period e^(k·step) times the shortest; its wavelet peaks at ω s =
                // π, where f = 1/T.
                let weight = |k: isize| {
                    let period_s = SHORTEST_PERIOD_S * (k as f64 * ln_step()).exp();
                    mother(TAU * frequency_hz * period_s / 2.0)
                };
                let outside = SCALES_OUTSIDE as isize;
                let last = MATCHED_PERIODS as isize - 1;
                let mut shares = [0.0; MATCHED_PERIODS];
                let mut sum = 0.0;
                for k in -outside..=last + outside {
                    sum += weight(k);
                    if (-SCALES_HELD..=last + SCALES_HELD).contains(&k) {
                        shares[k.clamp(0, last) as usize] += weight(k);
                    }
                }
                shares.map(|share| share / sum)
            })
            .collect();
        Self { shares }
    }

    /// The gain of a pass, from ln(PSA/target) at the matched periods.
    pub(super) fn gains(&self, ln_ratios: &[f64]) -> Gains {
        let changes: Vec<f64> = ln_ratios
            .iter()
            .map(|ln_ratio| (-ln_ratio).exp_m1())
            .collect();
        let gain = |shares: &[f64; MATCHED_PERIODS]| {
            1.0 + shares
                .iter()
                .zip(&changes)
                .map(|(share, change)| share * change)
                .sum::<f64>()
        };
        Gains(self.shares.iter().map(gain).collect())
    }
}

/// Frequency of a point of the table \[Hz\], falling as periods rise.
fn frequency_hz(point: usize) -> f64 {
    let along = point as f64 / POINTS_PER_SCALE as f64 - SCALES_OUTSIDE as f64;
    1.0 / (SHORTEST_PERIOD_S * (along * ln_step()).exp())
}

impl Gains {
    /// The gain at a frequency, linear in ln f; constant beyond the table, whose ends are within a
    /// hundredth of 1.
    pub(super) fn at(&self, frequency_hz: f64) -> f64 {
        let along = -(frequency_hz * SHORTEST_PERIOD_S).ln() / ln_step() + SCALES_OUTSIDE as f64;
        let along = (along * POINTS_PER_SCALE as f64).clamp(0.0, (POINTS - 1) as f64);
        let index = (along as usize).min(POINTS - 2);
        self.0[index] + (self.0[index + 1] - self.0[index]) * (along - index as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mother_wavelet_has_its_transform() {
        // ∫ e^(−ζπ|t|) sin πt · sin ωt dt, the trapezoid rule at 1 ms to 120 s, where e^(−ζπt) is
        // 7e-9.
        for omega in [0.3, 2.0, PI, 3.5, 9.0] {
            let psi = |t: f64| (-ZETA * PI * t).exp() * (PI * t).sin() * (omega * t).sin();
            let sum = 2.0 * 1e-3 * (1..120_000).map(|k| psi(1e-3 * f64::from(k))).sum::<f64>();
            // The rule is accurate to (ω dt)²/12 of the integral of |ψ|, 1e-5.
            assert!(
                (sum * sum - mother(omega)).abs() < 1e-4 * mother(omega).max(1.0),
                "{omega}: {sum}"
            );
        }
    }

    #[test]
    fn one_ratio_at_all_periods_is_that_gain() {
        let gains = Kernel::new().gains(&[-(1.5_f64.ln()); MATCHED_PERIODS]);
        // Outside the scaled periods only the kernel's tails remain, which fall with the square of
        // the distance in bandwidths.
        for frequency_hz in [0.21, 0.5, 1.0, 5.0, 19.0] {
            assert!(
                (gains.at(frequency_hz) - 1.5).abs() < 0.01,
                "{frequency_hz}: {}",
                gains.at(frequency_hz)
            );
        }
        for frequency_hz in [0.01, 0.08, 50.0, 200.0] {
            assert!(
                (gains.at(frequency_hz) - 1.0).abs() < 0.02,
                "{frequency_hz}: {}",
                gains.at(frequency_hz)
            );
        }
    }

    #[test]
    fn the_table_is_dense_enough() {
        let ln_ratios: [f64; MATCHED_PERIODS] =
            std::array::from_fn(|k| 0.3 * (0.2 * k as f64).sin());
        let gains = Kernel::new().gains(&ln_ratios);
        // Between two points of the table, compared with the sum itself; the second difference of a
        // bell of ten points.
        for frequency_hz in [0.31, 1.07, 4.9] {
            let (mut sum, mut all) = (0.0, 0.0);
            for k in -60..=180_isize {
                let period_s = SHORTEST_PERIOD_S * (k as f64 * ln_step()).exp();
                let weight = mother(PI * frequency_hz * period_s);
                all += weight;
                sum += weight
                    * if (-12..=132).contains(&k) {
                        (-ln_ratios[k.clamp(0, 120) as usize]).exp()
                    } else {
                        1.0
                    };
            }
            assert!(
                (gains.at(frequency_hz) - sum / all).abs() < 1e-3,
                "{frequency_hz}"
            );
        }
    }
}
