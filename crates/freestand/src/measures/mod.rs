//! Intensity measures of a motion: peaks, energy, duration, spectral content, and measures for a
//! rocking block.

mod excursions;
mod rocking;
mod spectral;

pub use excursions::{Excursion, excursions};
pub use rocking::{RockingMeasures, rocking_measures};
pub use spectral::{SpectralMeasures, mean_period_s, spectral_measures};

use crate::G0_M_S2;
use crate::motion::Motion;
use std::f64::consts::PI;

/// Strength and duration of a motion.
///
/// **Units** are in the names. Velocity and displacement are integrals from rest without baseline
/// correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// Peak ground acceleration, max|a| \[m/s²\].
    pub pga_m_s2: f64,
    /// The sample with the peak ground acceleration, including its sign \[m/s²\].
    pub pga_signed_m_s2: f64,
    /// Index of the first sample that reaches the PGA, from 0.
    pub pga_index: usize,
    /// Peak ground velocity, max|∫a dt| \[m/s\].
    pub pgv_m_s: f64,
    /// Peak ground displacement, max|∫∫a dt²| \[m\].
    pub pgd_m: f64,
    /// Arias intensity, π/(2g) ∫a² dt \[m/s\].
    pub arias_m_s: f64,
    /// Cumulative absolute velocity, ∫|a| dt \[m/s\].
    pub cav_m_s: f64,
    /// Standardised CAV: ∫|a| dt over the windows of 1 s in which |a| exceeds
    /// [`CAV_STD_M_S2`] \[m/s\]. The windows are counted from the first sample and contain the
    /// sample intervals that begin in them; the last one counts like the others, however short it
    /// is.
    pub cav_std_m_s: f64,
    /// Root mean square acceleration over the whole motion, √(∫a² dt / duration) \[m/s²\].
    pub rms_m_s2: f64,
    /// Specific energy density, ∫v² dt \[m²/s\].
    pub specific_energy_density_m2_s: f64,
    /// Bracketed duration: time from the first to the last crossing of [`BRACKET_M_S2`] by
    /// |a| \[s\]; 0 where |a| does not exceed it.
    pub bracketed_duration_s: f64,
    /// Uniform duration: total time for which |a| exceeds [`BRACKET_M_S2`] \[s\].
    pub uniform_duration_s: f64,
    /// Significant duration: time between 5 % and 75 % of the Arias intensity \[s\]; 0 for a motion
    /// of zeros.
    pub d5_75_s: f64,
    /// Significant duration: time between 5 % and 95 % of the Arias intensity \[s\]; 0 for a motion
    /// of zeros.
    pub d5_95_s: f64,
}

/// Level of |a| above which a window counts in the standardised CAV, 0.025 g \[m/s²\].
pub const CAV_STD_M_S2: f64 = 0.025 * G0_M_S2;

/// Level of the bracketed and the uniform duration, 0.05 g \[m/s²\]; for other levels use
/// [`excursions`].
pub const BRACKET_M_S2: f64 = 0.05 * G0_M_S2;

/// The [`Measures`] of a motion, with every integral by the trapezoid rule on its samples.
///
/// The significant durations interpolate the normalised integral of a² ([`husid`]) linearly between
/// samples; the bracketed and uniform durations interpolate the motion itself.
///
/// # Reference
/// Arias (1970); Husid (1969); Trifunac and Brady (1975) for the 5–95 % duration; EPRI (1988) for
/// the CAV, Reed and Kennedy (EPRI TR-100082, 1991) for the standardised one; Bolt (1973) for the
/// bracketed and the uniform duration.
///
/// # Limitation
/// The velocity and displacement of a motion with an offset drift; correct the baseline first.
///
/// # Example
/// ```
/// use freestand::{measures::measures, motion::Motion};
/// let pulse = Motion::new(0.5, vec![0.0, 2.0, 2.0, 0.0])?;
/// let m = measures(&pulse);
/// assert_eq!((m.pga_m_s2, m.pga_index, m.pgv_m_s, m.cav_m_s), (2.0, 1, 2.0, 2.0));
/// # Ok::<(), freestand::motion::MotionError>(())
/// ```
pub fn measures(motion: &Motion) -> Measures {
    let (dt_s, accel) = (motion.dt_s(), motion.accel_m_s2());
    let pga_m_s2 = motion.peak_m_s2();
    let pga_index = accel.iter().position(|a| a.abs() == pga_m_s2).unwrap_or(0);
    let Integrals {
        velocity_m_s: velocity,
        displacement_m: displacement,
    } = integrals(motion);
    let energy = cumulative_trapezoid(dt_s, &squares(accel));
    let total = energy[energy.len() - 1];
    let start_s = crossing_time_s(dt_s, &energy, 0.05 * total);
    let above = excursions(motion, BRACKET_M_S2);
    let bracket = above.first().zip(above.last());
    Measures {
        pga_m_s2,
        pga_signed_m_s2: accel[pga_index],
        pga_index,
        pgv_m_s: peak(&velocity),
        pgd_m: peak(&displacement),
        arias_m_s: PI / (2.0 * G0_M_S2) * total,
        cav_m_s: accel.windows(2).map(|pair| trapezoid_abs(dt_s, pair)).sum(),
        cav_std_m_s: cav_std_m_s(dt_s, accel),
        rms_m_s2: (total / motion.duration_s()).sqrt(),
        specific_energy_density_m2_s: cumulative_trapezoid(dt_s, &squares(&velocity))
            .last()
            .copied()
            .unwrap_or(0.0),
        bracketed_duration_s: bracket.map_or(0.0, |(first, last)| last.to_s - first.from_s),
        // Added to 0, because an empty sum is -0.
        uniform_duration_s: above
            .iter()
            .fold(0.0, |sum, one| sum + (one.to_s - one.from_s)),
        d5_75_s: crossing_time_s(dt_s, &energy, 0.75 * total) - start_s,
        d5_95_s: crossing_time_s(dt_s, &energy, 0.95 * total) - start_s,
    }
}

/// The Husid curve: ∫a² dt up to each sample as a share of the total, from 0 to 1; zeros for a
/// motion of zeros.
///
/// # Reference
/// Husid (1969).
///
/// # Example
/// ```
/// use freestand::{measures::husid, motion::Motion};
/// assert_eq!(husid(&Motion::new(1.0, vec![1.0, -1.0, 0.0])?), [0.0, 2.0 / 3.0, 1.0]);
/// # Ok::<(), freestand::motion::MotionError>(())
/// ```
pub fn husid(motion: &Motion) -> Vec<f64> {
    let mut curve = cumulative_trapezoid(motion.dt_s(), &squares(motion.accel_m_s2()));
    let total = curve[curve.len() - 1];
    if total > 0.0 {
        curve.iter_mut().for_each(|value| *value /= total);
    }
    curve
}

/// Times at which the Husid curve reaches 5 % and 95 % \[s\]; their difference is the 5–95 %
/// duration.
pub fn significant_span_s(motion: &Motion) -> (f64, f64) {
    let curve = husid(motion);
    (
        crossing_time_s(motion.dt_s(), &curve, 0.05),
        crossing_time_s(motion.dt_s(), &curve, 0.95),
    )
}

fn cav_std_m_s(dt_s: f64, accel: &[f64]) -> f64 {
    let (mut sum, mut window, mut integral, mut peak) = (0.0, 0.0, 0.0, 0.0_f64);
    for (i, pair) in accel.windows(2).enumerate() {
        // Rounding must not make ten steps of 0.1 s end short of a second.
        let now = (i as f64 * dt_s * (1.0 + 1e-12)).floor();
        if now != window {
            sum += if peak > CAV_STD_M_S2 { integral } else { 0.0 };
            (window, integral, peak) = (now, 0.0, 0.0);
        }
        integral += trapezoid_abs(dt_s, pair);
        peak = peak.max(pair[0].abs()).max(pair[1].abs());
    }
    sum + if peak > CAV_STD_M_S2 { integral } else { 0.0 }
}

fn trapezoid_abs(dt_s: f64, pair: &[f64]) -> f64 {
    0.5 * dt_s * (pair[0].abs() + pair[1].abs())
}

fn squares(values: &[f64]) -> Vec<f64> {
    values.iter().map(|a| a * a).collect()
}

/// The length of the longest of the vectors with these components. Squares are compared, because a root for each
/// takes long.
///
/// # Example
/// ```
/// use freestand::measures::longest;
/// assert_eq!(longest(&[1.0, -3.0, 2.0], &[0.0, 4.0, 4.4]), 5.0);
/// ```
pub fn longest(along: &[f64], across: &[f64]) -> f64 {
    const ABREAST: usize = 8;
    let square = |(a, b): (&f64, &f64)| a * a + b * b;
    let larger = |most: f64, square: f64| if square > most { square } else { most };
    let mut most = [0.0; ABREAST];
    let both = along
        .chunks_exact(ABREAST)
        .zip(across.chunks_exact(ABREAST));
    for (along, across) in both {
        for lane in 0..ABREAST {
            most[lane] = larger(most[lane], square((&along[lane], &across[lane])));
        }
    }
    let rest = along.len().min(across.len()) / ABREAST * ABREAST;
    let rest = along[rest..].iter().zip(&across[rest..]).map(square);
    let most = most.into_iter().chain(rest).fold(0.0, larger);
    let mut both = along.iter().zip(across);
    let found = both.find(|both| square(*both) == most);
    found.map_or(0.0, |(a, b)| a.hypot(*b))
}

/// The length of the longest of the vectors whose components are the running integrals of these values, as
/// [`cumulative_trapezoid`] gives them but for rounding; 0 of fewer than two values.
///
/// **Units**: those of the values times s.
///
/// # Example
/// ```
/// use freestand::measures::longest_integral;
/// assert_eq!(longest_integral(1.0, &[0.0, 6.0, -6.0], &[0.0, 8.0, -8.0]), 5.0);
/// ```
pub fn longest_integral(dt_s: f64, along: &[f64], across: &[f64]) -> f64 {
    /// Intervals that are summed from zero, so that only one addition in four waits for the one before.
    const ABREAST: usize = 4;
    let (mut before, mut longest, mut most) = ([0.0; 2], [0.0; 2], 0.0);
    let samples = along.len().min(across.len());
    let wholes = samples.saturating_sub(1) / ABREAST;
    for place in 0..wholes {
        let from = place * ABREAST;
        let integrals = |values: &[f64], before: f64| {
            let values = &values[from..=from + ABREAST];
            let mut sums: [f64; ABREAST] =
                std::array::from_fn(|k| 0.5 * dt_s * (values[k] + values[k + 1]));
            for k in 1..ABREAST {
                sums[k] += sums[k - 1];
            }
            sums.map(|sum| before + sum)
        };
        let both = [integrals(along, before[0]), integrals(across, before[1])];
        let square = |k: usize| both[0][k] * both[0][k] + both[1][k] * both[1][k];
        let squares: [f64; ABREAST] = std::array::from_fn(square);
        if squares.iter().any(|square| *square > most) {
            for (k, square) in squares.into_iter().enumerate() {
                if square > most {
                    (most, longest) = (square, both.map(|sums| sums[k]));
                }
            }
        }
        before = both.map(|sums| sums[ABREAST - 1]);
    }
    let from = wholes * ABREAST;
    let rest = |values: &[f64], k: usize| 0.5 * dt_s * (values[k] + values[k + 1]);
    for k in from..samples.saturating_sub(1) {
        before = [before[0] + rest(along, k), before[1] + rest(across, k)];
        let square = before[0] * before[0] + before[1] * before[1];
        if square > most {
            (most, longest) = (square, before);
        }
    }
    f64::hypot(longest[0], longest[1])
}

/// Running integral of `values` by the trapezoid rule; starts at 0 and has as many values as the
/// input.
///
/// # Example
/// ```
/// use freestand::measures::cumulative_trapezoid;
/// assert_eq!(cumulative_trapezoid(0.5, &[0.0, 2.0, 2.0]), [0.0, 0.5, 1.5]);
/// ```
pub fn cumulative_trapezoid(dt_s: f64, values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut before = None;
    values
        .iter()
        .map(|&value| {
            sum += before.map_or(0.0, |b: f64| 0.5 * dt_s * (b + value));
            before = Some(value);
            sum
        })
        .collect()
}

/// The velocity and the displacement of a motion at its samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Integrals {
    /// Velocity, ∫a dt \[m/s\].
    pub velocity_m_s: Vec<f64>,
    /// Displacement, ∫∫a dt² \[m\].
    pub displacement_m: Vec<f64>,
}

/// The [`Integrals`] of a motion from rest, both by [`cumulative_trapezoid`] and without baseline
/// correction: their peaks are the PGV and the PGD of [`measures`].
///
/// # Accuracy
/// Where straight lines join the samples, the velocity is exact, and the displacement is too large by
/// (a − a₀) dt²/12, with the acceleration a of its sample and a₀ of the first.
///
/// # Example
/// ```
/// use freestand::{measures::integrals, motion::Motion};
/// let found = integrals(&Motion::new(0.5, vec![0.0, 2.0, 2.0])?);
/// assert_eq!((found.velocity_m_s, found.displacement_m), (vec![0.0, 0.5, 1.5], vec![0.0, 0.125, 0.625]));
/// # Ok::<(), freestand::motion::MotionError>(())
/// ```
pub fn integrals(motion: &Motion) -> Integrals {
    let velocity_m_s = cumulative_trapezoid(motion.dt_s(), motion.accel_m_s2());
    Integrals {
        displacement_m: cumulative_trapezoid(motion.dt_s(), &velocity_m_s),
        velocity_m_s,
    }
}

fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |peak: f64, v| peak.max(v.abs()))
}

/// Time at which the rising curve first reaches `level`.
fn crossing_time_s(dt_s: f64, rising: &[f64], level: f64) -> f64 {
    let Some(after) = rising
        .iter()
        .position(|&value| value >= level)
        .filter(|&i| i > 0)
    else {
        return 0.0;
    };
    let (below, above) = (rising[after - 1], rising[after]);
    ((after - 1) as f64 + (level - below) / (above - below)) * dt_s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_acceleration_has_measures_by_hand() {
        // 3 m/s² for 10 s: v = 30, d = 150, ∫a² = 90, durations 7 s and 9 s. The velocity is
        // linear, so the second trapezoid rule is exact as well; 100 additions leave a few ε.
        let motion = Motion::new(0.1, vec![-3.0; 101]).unwrap();
        let m = measures(&motion);
        let near =
            |value: f64, want: f64| assert!((value / want - 1.0).abs() < 1e-13, "{value} {want}");
        assert_eq!((m.pga_m_s2, m.pga_signed_m_s2, m.pga_index), (3.0, -3.0, 0));
        near(m.pgv_m_s, 30.0);
        near(m.pgd_m, 150.0);
        near(m.arias_m_s, 45.0 * PI / 9.80665);
        near(m.cav_m_s, 30.0);
        near(m.d5_75_s, 7.0);
        near(m.d5_95_s, 9.0);
        near(m.cav_std_m_s, 30.0);
        near(m.rms_m_s2, 3.0);
        near(m.bracketed_duration_s, 10.0);
        near(m.uniform_duration_s, 10.0);
        // ∫(3t)² dt = 3·10³; the trapezoid rule adds 9 dt²/6 per second: 0.15.
        near(m.specific_energy_density_m2_s, 3000.0 + 0.15);
    }

    #[test]
    fn the_standardised_cav_leaves_quiet_seconds_out_and_counts_the_last_part() {
        // 0.02 g in the first and the third second, 0.03 g in the second and in the remaining half.
        // The sample at 1 s belongs to the intervals on both sides, as does the one at 2 s; both
        // have the lower value.
        let g = G0_M_S2;
        let accel: Vec<f64> = (0..=35)
            .map(|i| {
                if (11..20).contains(&i) || i > 30 {
                    0.03 * g
                } else {
                    0.02 * g
                }
            })
            .collect();
        let m = measures(&Motion::new(0.1, accel).unwrap());
        // Second 1: nine samples of 0.03 and two halves of 0.02; the half second: five intervals,
        // half of one sample low.
        let want = 0.1 * g * (9.0 * 0.03 + 0.02) + 0.1 * g * (4.5 * 0.03 + 0.5 * 0.02);
        assert!(
            (m.cav_std_m_s / want - 1.0).abs() < 1e-13,
            "{} {want}",
            m.cav_std_m_s
        );
    }

    #[test]
    fn the_husid_curve_and_its_span_agree_with_the_duration() {
        let motion = Motion::new(
            0.02,
            (0..500)
                .map(|k| (0.1 * k as f64).sin() * k as f64)
                .collect(),
        )
        .unwrap();
        let curve = husid(&motion);
        assert!(
            curve[0] == 0.0 && curve[499] == 1.0 && curve.windows(2).all(|pair| pair[0] <= pair[1])
        );
        let (from_s, to_s) = significant_span_s(&motion);
        // Two quotients of the same sums: a few ε of 10 s.
        assert!((to_s - from_s - measures(&motion).d5_95_s).abs() < 1e-13);
    }

    #[test]
    fn durations_interpolate_between_samples() {
        // a² = 1, 1, 0 at 0, 1, 2 s: Husid 0, 1, 1.5; 5 % at 0.075 s, 75 % at 1.25 s, 95 % at
        // 1.85 s.
        let m = measures(&Motion::new(1.0, vec![1.0, -1.0, 0.0]).unwrap());
        assert!(
            (m.d5_75_s - 1.175).abs() < 1e-15 && (m.d5_95_s - 1.775).abs() < 1e-15,
            "{m:?}"
        );
    }

    #[test]
    fn a_motion_of_zeros_has_no_duration() {
        let m = measures(&Motion::new(0.1, vec![0.0; 5]).unwrap());
        assert_eq!(
            (m.pga_m_s2, m.pga_index, m.arias_m_s, m.d5_75_s, m.d5_95_s),
            (0.0, 0, 0.0, 0.0, 0.0)
        );
    }

    #[test]
    fn quiet_before_and_after_does_not_change_the_durations() {
        let shake: Vec<f64> = (0..50).map(|k| (k as f64).sin()).collect();
        let mut padded = vec![0.0; 30];
        padded.extend(&shake);
        // The motion ends at sin(49) ≠ 0: compare only padded motions, so that the last interval is
        // the same.
        let short = measures(
            &Motion::new(0.1, padded.clone())
                .unwrap()
                .with_zero_tail(1.0)
                .unwrap(),
        );
        padded.splice(0..0, vec![0.0; 70]);
        let long = measures(
            &Motion::new(0.1, padded)
                .unwrap()
                .with_zero_tail(9.0)
                .unwrap(),
        );
        // Times up to 13 s carry 2e-15 each.
        assert!((short.d5_95_s - long.d5_95_s).abs() < 1e-14);
        assert_eq!(
            (short.arias_m_s, short.cav_m_s),
            (long.arias_m_s, long.cav_m_s)
        );
    }
}
