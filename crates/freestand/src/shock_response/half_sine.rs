//! The undamped shock response spectrum of a half-sine in closed form, and the severity of one
//! half-sine relative to another.

use std::f64::consts::PI;

use crate::search::golden_maximum;

/// A half-sine acceleration pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSine {
    /// Peak A, in any unit of acceleration (the same for all compared pulses).
    pub peak_acceleration: f64,
    /// Duration T \[s\].
    pub duration_s: f64,
}

fn sinc(x: f64) -> f64 {
    let y = PI * x;
    if y.abs() < 1e-8 { 1.0 } else { y.sin() / y }
}

/// Largest absolute acceleration of an undamped oscillator under a half-sine, divided by the peak
/// of the pulse; `q` = f·T, its frequency times the duration of the pulse.
///
/// With b = 1/(2q) the acceleration is (sin πs − b sin 2πqs)/(1−b²) during the pulse (s = t/T);
/// after it the amplitude is |2b cos(πq)/(1−b²)|. The singularity at q = ½ is removable: both are
/// written with sin(x)/x there. During the pulse the maxima are at s = 2n/(2q+1) and reach
/// sin(πs)/(1−b); there is none for q < ½.
///
/// # Accuracy
/// Rounding only.
///
/// # Example
/// The largest amplification, 1.768 at f·T = 0.81, and the impulsive limit 4 f·T:
/// ```
/// use freestand::shock_response::half_sine_maximax_ratio;
/// assert!((half_sine_maximax_ratio(0.81) - 1.768).abs() < 5e-4);
/// assert!((half_sine_maximax_ratio(0.5) - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// assert!((half_sine_maximax_ratio(1e-4) / 4e-4 - 1.0).abs() < 1e-6);
/// ```
pub fn half_sine_maximax_ratio(q: f64) -> f64 {
    // 2b cos(πq)/(1−b²) = 4q cos(πq)/((2q−1)(2q+1)), and cos(πq) = sin(π(½−q)).
    let residual = (2.0 * PI * q / (2.0 * q + 1.0) * sinc(q - 0.5)).abs();
    if q <= 0.5 {
        return residual;
    }
    // sin(2πn/(2q+1)) is largest for the n that brings 2n/(2q+1) closest to ½.
    let n = (0.25 * (2.0 * q + 1.0)).round().max(1.0);
    let in_pulse = if n == 1.0 {
        // sin(2π/(2q+1)) = sin(πu) with u = (2q−1)/(2q+1), and 1−b = (2q−1)/(2q).
        2.0 * PI * q / (2.0 * q + 1.0) * sinc((2.0 * q - 1.0) / (2.0 * q + 1.0))
    } else {
        (2.0 * PI * n / (2.0 * q + 1.0)).sin() * 2.0 * q / (2.0 * q - 1.0)
    };
    residual.max(in_pulse)
}

/// How severe one half-sine is relative to another: the largest ratio, over all frequencies, of
/// their undamped shock response spectra (maximax). At 1 or less, whatever withstands the reference
/// also withstands the demand.
///
/// **Limits**: for slow components the ratio of the velocity changes, for stiff ones that of the
/// peaks; the result includes both.
///
/// # Reference
/// Undamped half-sine spectra: Ayre, in Harris and Crede, Shock and Vibration Handbook.
///
/// # Accuracy
/// 400 frequencies per decade in which one of the two spectra is not at its limit, with every
/// maximum near the best one refined by golden section: 1e-5 of the ratio.
///
/// # Example
/// The same peak for twice the duration is twice as severe for slow components. For half the
/// duration it is still 50 % more severe for some components: those that are stiff relative to the
/// reference pulse and therefore hardly excited by it, but strongly excited by the shorter one.
/// ```
/// use freestand::shock_response::{HalfSine, half_sine_severity_ratio};
/// let survived = HalfSine { peak_acceleration: 30.0, duration_s: 0.011 };
/// let short = HalfSine { peak_acceleration: 30.0, duration_s: 0.0055 };
/// assert!((half_sine_severity_ratio(survived, survived) - 1.0).abs() < 1e-12);
/// assert!((half_sine_severity_ratio(short, survived) - 1.501).abs() < 1e-3);
/// assert!((half_sine_severity_ratio(survived, short) - 2.0).abs() < 1e-6);
/// ```
pub fn half_sine_severity_ratio(demand: HalfSine, reference: HalfSine) -> f64 {
    let peaks = demand.peak_acceleration / reference.peak_acceleration;
    let velocities = peaks * demand.duration_s / reference.duration_s;
    let ratio = |log_f: f64| {
        let f = log_f.exp();
        peaks * half_sine_maximax_ratio(f * demand.duration_s)
            / half_sine_maximax_ratio(f * reference.duration_s)
    };
    let longest = demand.duration_s.max(reference.duration_s);
    let shortest = demand.duration_s.min(reference.duration_s);
    // Below f·T = 0.01 both spectra are 4fT to 1e-4 and deviate from it alike; above f·T = 30 they
    // are within 2 % of the peak and decay.
    let (from, to) = ((0.01 / longest).ln(), (30.0 / shortest).ln());
    let steps = (400.0 * (to - from) / std::f64::consts::LN_10)
        .ceil()
        .max(2.0) as usize;
    let width = (to - from) / steps as f64;
    let at = |i: usize| from + i as f64 * width;
    let values: Vec<f64> = (0..=steps).map(|i| ratio(at(i))).collect();
    let best = values.iter().copied().fold(peaks.max(velocities), f64::max);
    // The maxima are at kinks of the reference spectrum. A step misses less than 1 % of one, so
    // every maximum within 1 % of the best may be the largest.
    let refined = (1..steps)
        .filter(|&i| {
            values[i] >= values[i - 1] && values[i] >= values[i + 1] && values[i] > 0.99 * best
        })
        .map(|i| golden_maximum(ratio, at(i - 1), at(i + 1)));
    refined.fold(best, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The response itself, sampled: 2e5 points over the pulse put the maximum within (π q/1e5)²/2
    /// of the true one.
    fn sampled(q: f64) -> f64 {
        let b = 1.0 / (2.0 * q);
        let mut peak = (2.0 * b * (PI * q).cos() / (1.0 - b * b)).abs();
        for i in 0..=200_000 {
            let s = f64::from(i) / 200_000.0;
            peak = peak
                .max(((PI * s).sin() - b * (2.0 * PI * q * s).sin()).abs() / (1.0 - b * b).abs());
        }
        peak
    }

    #[test]
    fn closed_form_is_the_largest_sampled_response() {
        for q in [
            0.01, 0.2, 0.4, 0.49, 0.51, 0.7, 0.81, 1.0, 1.3, 1.49, 1.51, 2.0, 2.5, 3.3, 7.7, 20.0,
        ] {
            let (closed, sampled) = (half_sine_maximax_ratio(q), sampled(q));
            assert!(
                (closed / sampled - 1.0).abs() < 1e-6,
                "{q}: {closed} {sampled}"
            );
        }
    }

    #[test]
    fn the_singularity_is_removed() {
        for offset in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
            for q in [0.5 - offset, 0.5 + offset] {
                // S = π/2 + (π/2)(q − ½) + … with a second coefficient of −π/2 − π³/12 = −4.2.
                let expected = 0.5 * PI * (1.0 + (q - 0.5));
                assert!(
                    (half_sine_maximax_ratio(q) - expected).abs() < 5.0 * offset * offset + 1e-14,
                    "{q}"
                );
            }
        }
    }

    /// A component of capacity a_c: the largest half-sine peak that it withstands is 0.565 a_c,
    /// 1/1.76846.
    #[test]
    fn largest_amplification() {
        let largest = (1..4000)
            .map(|i| half_sine_maximax_ratio(0.001 * f64::from(i)))
            .fold(0.0, f64::max);
        // The grid of 0.001 misses the maximum by its curvature, below 1e-5.
        assert!((largest - 1.76846).abs() < 1.5e-5, "{largest}");
    }

    #[test]
    fn severity_has_its_limits_and_scales_with_the_peak() {
        let pulse = |peak_acceleration: f64, duration_s: f64| HalfSine {
            peak_acceleration,
            duration_s,
        };
        let survived = pulse(30.0, 0.011);
        // For a much longer pulse the velocity change governs. For a much shorter one, the ratio at
        // some frequency is nearly the ratio of the peaks times 1.768, and never more.
        assert!((half_sine_severity_ratio(pulse(10.0, 0.11), survived) - 10.0 / 3.0).abs() < 1e-3);
        let short = half_sine_severity_ratio(pulse(30.0, 0.0011), survived);
        assert!((1.0..1.769).contains(&short), "{short}");
        let one = half_sine_severity_ratio(pulse(7.0, 0.004), survived);
        let two = half_sine_severity_ratio(pulse(14.0, 0.004), survived);
        assert!((two / one - 2.0).abs() < 1e-12);
        // Only the ratio of the durations matters.
        let stretched = half_sine_severity_ratio(pulse(7.0, 0.4), pulse(30.0, 1.1));
        assert!((stretched / one - 1.0).abs() < 1e-9, "{stretched} {one}");
    }

    /// A search by brute force on a grid two hundred times finer.
    #[test]
    fn severity_is_the_largest_ratio() {
        for (t, t_ref) in [(0.004, 0.011), (0.02, 0.011), (0.0095, 0.011)] {
            let got = half_sine_severity_ratio(
                HalfSine {
                    peak_acceleration: 1.0,
                    duration_s: t,
                },
                HalfSine {
                    peak_acceleration: 1.0,
                    duration_s: t_ref,
                },
            );
            let brute = (0..400_000)
                .map(|i| 0.5 * 1e5f64.powf(f64::from(i) / 400_000.0))
                .map(|f| half_sine_maximax_ratio(f * t) / half_sine_maximax_ratio(f * t_ref))
                .fold(1f64.max(t / t_ref), f64::max);
            // The grid steps by 3e-5 in ln f and therefore misses the top of a kink by up to 1e-5.
            assert!(
                (-1e-12..1e-5).contains(&(got / brute - 1.0)),
                "{t}: {got} {brute}"
            );
        }
    }
}
