//! Intensity measures of a motion: peaks, energy and duration.

use crate::G0_M_S2;
use crate::motion::Motion;
use std::f64::consts::PI;

/// How strong and how long a motion is.
///
/// **Units** in the names. Velocity and displacement are integrals from rest with no baseline correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// Peak ground acceleration, max|a| \[m/s²\].
    pub pga_m_s2: f64,
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
    /// Significant duration: time between 5 % and 75 % of the Arias intensity \[s\]; 0 for a motion of zeros.
    pub d5_75_s: f64,
    /// Significant duration: time between 5 % and 95 % of the Arias intensity \[s\]; 0 for a motion of zeros.
    pub d5_95_s: f64,
}

/// The [`Measures`] of a motion, every integral by the trapezoid rule on its samples.
///
/// The durations interpolate the normalised integral of a² (the Husid curve) linearly between samples.
///
/// # Reference
/// Arias (1970); Husid (1969); Trifunac and Brady (1975) for the 5–95 % duration; EPRI (1988) for the CAV.
///
/// # Limitation
/// A record with an offset gives a velocity and displacement that drift; correct the baseline first.
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
    let velocity = cumulative_trapezoid(dt_s, accel);
    let displacement = cumulative_trapezoid(dt_s, &velocity);
    let squares: Vec<f64> = accel.iter().map(|a| a * a).collect();
    let husid = cumulative_trapezoid(dt_s, &squares);
    let total = husid[husid.len() - 1];
    let start_s = crossing_time_s(dt_s, &husid, 0.05 * total);
    Measures {
        pga_m_s2,
        pga_index: accel.iter().position(|a| a.abs() == pga_m_s2).unwrap_or(0),
        pgv_m_s: peak(&velocity),
        pgd_m: peak(&displacement),
        arias_m_s: PI / (2.0 * G0_M_S2) * total,
        cav_m_s: accel.windows(2).map(|pair| 0.5 * dt_s * (pair[0].abs() + pair[1].abs())).sum(),
        d5_75_s: crossing_time_s(dt_s, &husid, 0.75 * total) - start_s,
        d5_95_s: crossing_time_s(dt_s, &husid, 0.95 * total) - start_s,
    }
}

/// Running integral of `values` by the trapezoid rule; starts at 0 and has as many values.
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

fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |peak: f64, v| peak.max(v.abs()))
}

/// Time at which the rising curve first reaches `level`.
fn crossing_time_s(dt_s: f64, rising: &[f64], level: f64) -> f64 {
    let Some(after) = rising.iter().position(|&value| value >= level).filter(|&i| i > 0) else { return 0.0 };
    let (below, above) = (rising[after - 1], rising[after]);
    ((after - 1) as f64 + (level - below) / (above - below)) * dt_s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_acceleration_has_measures_by_hand() {
        // 3 m/s² for 10 s: v = 30, d = 150, ∫a² = 90, durations 7 s and 9 s. The velocity is linear, so the second
        // trapezoid rule is exact as well; 100 additions leave a few ε.
        let motion = Motion::new(0.1, vec![-3.0; 101]).unwrap();
        let m = measures(&motion);
        let near = |value: f64, want: f64| assert!((value / want - 1.0).abs() < 1e-13, "{value} {want}");
        assert_eq!((m.pga_m_s2, m.pga_index), (3.0, 0));
        near(m.pgv_m_s, 30.0);
        near(m.pgd_m, 150.0);
        near(m.arias_m_s, 45.0 * PI / 9.80665);
        near(m.cav_m_s, 30.0);
        near(m.d5_75_s, 7.0);
        near(m.d5_95_s, 9.0);
    }

    #[test]
    fn durations_interpolate_between_samples() {
        // a² = 1, 1, 0 at 0, 1, 2 s: Husid 0, 1, 1.5; 5 % at 0.075 s, 75 % at 1.25 s, 95 % at 1.85 s.
        let m = measures(&Motion::new(1.0, vec![1.0, -1.0, 0.0]).unwrap());
        assert!((m.d5_75_s - 1.175).abs() < 1e-15 && (m.d5_95_s - 1.775).abs() < 1e-15, "{m:?}");
    }

    #[test]
    fn a_motion_of_zeros_has_no_duration() {
        let m = measures(&Motion::new(0.1, vec![0.0; 5]).unwrap());
        assert_eq!((m.pga_m_s2, m.pga_index, m.arias_m_s, m.d5_75_s, m.d5_95_s), (0.0, 0, 0.0, 0.0, 0.0));
    }

    #[test]
    fn quiet_before_and_after_does_not_change_the_durations() {
        let shake: Vec<f64> = (0..50).map(|k| (k as f64).sin()).collect();
        let mut padded = vec![0.0; 30];
        padded.extend(&shake);
        // The motion ends at sin(49) ≠ 0: hold on to the same last interval by comparing padded motions only.
        let short = measures(&Motion::new(0.1, padded.clone()).unwrap().with_zero_tail(1.0).unwrap());
        padded.splice(0..0, vec![0.0; 70]);
        let long = measures(&Motion::new(0.1, padded).unwrap().with_zero_tail(9.0).unwrap());
        // Times up to 13 s carry 2e-15 each.
        assert!((short.d5_95_s - long.d5_95_s).abs() < 1e-14);
        assert_eq!((short.arias_m_s, short.cav_m_s), (long.arias_m_s, long.cav_m_s));
    }
}
