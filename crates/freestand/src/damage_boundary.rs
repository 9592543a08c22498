//! The damage boundary of ASTM D3332: a shock causes damage only if both its peak and its velocity
//! change are too large.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use thiserror::Error;

/// A damage boundary: critical acceleration and critical velocity change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamageBoundary {
    acceleration_m_s2: f64,
    velocity_change_m_s: f64,
}

/// Why a [`DamageBoundary`] cannot be created.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum DamageBoundaryError {
    /// One of the two numbers that define it is not positive and finite.
    #[error("the {what} must be positive and finite, not {value}")]
    NotPositive {
        /// The name of the number, with its unit.
        what: &'static str,
        /// The value that was given.
        value: f64,
    },
}

fn positive(what: &'static str, value: f64) -> Result<f64, DamageBoundaryError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(DamageBoundaryError::NotPositive { what, value })
    }
}

/// The velocity change, divided by the critical one, at which a test for the critical acceleration
/// is run: π/2, the 1.57 of ASTM D3332. There the exact boundary of a component under a rectangular
/// pulse reaches its horizontal part, the critical acceleration.
pub const KNEE_RATIO: f64 = FRAC_PI_2;

impl DamageBoundary {
    /// From test results: A_c \[m/s²\] and V_c \[m/s\].
    ///
    /// # Errors
    /// A number that is not positive and finite.
    ///
    /// # Example
    /// A shock of 30 g for 2 ms does not damage an object that withstands 20 g at any duration and
    /// 0.6 m/s at any peak:
    /// ```
    /// use freestand::damage_boundary::DamageBoundary;
    /// let boundary = DamageBoundary::new(20.0 * 9.80665, 0.6)?;
    /// let (a, dv) = (30.0 * 9.80665, 0.37);
    /// assert!((boundary.demand_ratio(a, dv) - 0.37 / 0.6).abs() < 1e-15);
    /// # Ok::<(), freestand::damage_boundary::DamageBoundaryError>(())
    /// ```
    pub fn new(
        acceleration_m_s2: f64,
        velocity_change_m_s: f64,
    ) -> Result<Self, DamageBoundaryError> {
        Ok(Self {
            acceleration_m_s2: positive("critical acceleration in m/s²", acceleration_m_s2)?,
            velocity_change_m_s: positive("critical velocity change in m/s", velocity_change_m_s)?,
        })
    }

    /// A_c: no shock with a smaller peak causes damage \[m/s²\].
    pub fn acceleration_m_s2(&self) -> f64 {
        self.acceleration_m_s2
    }

    /// V_c: no shock with a smaller velocity change causes damage \[m/s\].
    pub fn velocity_change_m_s(&self) -> f64 {
        self.velocity_change_m_s
    }

    /// Demand/capacity, min(A/A_c, Δv/V_c): both must be exceeded, so a value of 1 or less is safe
    /// (the rectangular corner of ASTM D3332).
    pub fn demand_ratio(&self, acceleration_m_s2: f64, velocity_change_m_s: f64) -> f64 {
        (acceleration_m_s2 / self.acceleration_m_s2)
            .min(velocity_change_m_s / self.velocity_change_m_s)
    }

    /// The peak above which a shock with this velocity change causes damage \[m/s²\], with the
    /// rounded knee of an undamped component under rectangular pulses: 2A sin(ωV/(2A)) = a_c, where
    /// a_c = 2 A_c and ω = a_c/V_c. `None` at or below V_c, where no peak causes damage. At (π/2)
    /// V_c and above it is A_c.
    ///
    /// # Accuracy
    /// Rounding.
    ///
    /// # Example
    /// ```
    /// use freestand::damage_boundary::DamageBoundary;
    /// let boundary = DamageBoundary::of_component(100.0, 40.0 * 9.80665)?;
    /// let critical_m_s = boundary.velocity_change_m_s();
    /// let at = |ratio: f64| boundary.knee_acceleration_m_s2(ratio * critical_m_s);
    /// assert!(at(1.2).is_some_and(|a| (a / (40.0 * 9.80665) - 0.58437).abs() < 1e-5));
    /// assert_eq!((at(0.99), at(2.0)), (None, Some(20.0 * 9.80665)));
    /// # Ok::<(), freestand::damage_boundary::DamageBoundaryError>(())
    /// ```
    pub fn knee_acceleration_m_s2(&self, velocity_change_m_s: f64) -> Option<f64> {
        let ratio = velocity_change_m_s / self.velocity_change_m_s;
        if ratio.is_nan() || ratio <= 1.0 {
            return None;
        }
        if ratio >= KNEE_RATIO {
            return Some(self.acceleration_m_s2);
        }
        // With x = ωV/(2A): sin(x)/x = 1/ratio, which falls from 1 at x = 0 to 2/π at π/2; A = a_c
        // ratio/(2x).
        let (mut low, mut high) = (0.0, FRAC_PI_2);
        for _ in 0..60 {
            let x = 0.5 * (low + high);
            if x.sin() * ratio > x {
                low = x
            } else {
                high = x
            }
        }
        Some(self.acceleration_m_s2 * ratio / low.max(f64::MIN_POSITIVE)).filter(|a| a.is_finite())
    }

    /// The boundary of an undamped component of frequency f and capacity a_c, the largest
    /// acceleration that the component itself withstands, under rectangular pulses, which amplify
    /// most: A_c = a_c/2, V_c = a_c/ω.
    ///
    /// # Reference
    /// From the undamped oscillator under a rectangular pulse: residual 2A|sin πfT|, maximax 2A for
    /// fT ≥ ½. It explains the 1.57 of ASTM D3332.
    ///
    /// # Errors
    /// A number that is not positive and finite.
    ///
    /// # Example
    /// 100 Hz and 40 g: V_c = 0.62431 m/s, A_c = 20 g.
    /// ```
    /// use freestand::damage_boundary::DamageBoundary;
    /// let boundary = DamageBoundary::of_component(100.0, 40.0 * 9.80665)?;
    /// assert!((boundary.velocity_change_m_s() - 0.62431).abs() < 5e-6);
    /// assert!((boundary.acceleration_m_s2() / 9.80665 - 20.0).abs() < 1e-12);
    /// # Ok::<(), freestand::damage_boundary::DamageBoundaryError>(())
    /// ```
    pub fn of_component(
        frequency_hz: f64,
        capacity_m_s2: f64,
    ) -> Result<Self, DamageBoundaryError> {
        let frequency_hz = positive("frequency in Hz", frequency_hz)?;
        let capacity_m_s2 = positive("capacity in m/s²", capacity_m_s2)?;
        Self::new(0.5 * capacity_m_s2, capacity_m_s2 / (TAU * frequency_hz))
    }
}

/// Largest amplification of an undamped component by a half-sine of any duration; it occurs at fT =
/// 0.80994.
pub const HALF_SINE_LARGEST_RATIO: f64 = 1.768_457_653_993_67;

/// The peak of a half-sine of any duration that a component of capacity a_c withstands without
/// damping, 0.56546 a_c \[m/s²\].
pub fn half_sine_floor_m_s2(capacity_m_s2: f64) -> f64 {
    capacity_m_s2 / HALF_SINE_LARGEST_RATIO
}

/// The duration of a half-sine with a given peak and velocity change, πΔv/(2A) \[s\].
///
/// # Example
/// ```
/// let t = freestand::damage_boundary::half_sine_duration_s(30.0 * 9.80665, 2.0602);
/// assert!((t - 0.011).abs() < 1e-6);
/// ```
pub fn half_sine_duration_s(peak_acceleration_m_s2: f64, velocity_change_m_s: f64) -> f64 {
    PI * velocity_change_m_s / (2.0 * peak_acceleration_m_s2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shock_response::half_sine_maximax_ratio;

    /// a_c = 40 g at 100 Hz: the curve calculated by hand, to half a unit of the last digit.
    #[test]
    fn the_knee_of_a_component() {
        let (g, a_c) = (9.80665, 40.0 * 9.80665);
        let boundary = DamageBoundary::of_component(100.0, a_c).unwrap();
        for (ratio, expected) in [(1.05, 0.97509), (1.2, 0.58437), (1.4, 0.50998)] {
            let a = boundary
                .knee_acceleration_m_s2(ratio * boundary.velocity_change_m_s())
                .unwrap();
            assert!((a / a_c - expected).abs() < 5.1e-6, "{ratio}: {}", a / a_c);
            // The equation itself.
            let left =
                2.0 * a * (TAU * 100.0 * ratio * boundary.velocity_change_m_s() / (2.0 * a)).sin();
            assert!((left / a_c - 1.0).abs() < 1e-13);
        }
        let knee_m_s = KNEE_RATIO * boundary.velocity_change_m_s();
        // a_c/(4f) = 0.980665, within half a unit of the printed digits.
        assert!((knee_m_s - 0.98067).abs() < 5.1e-6);
        assert_eq!(boundary.knee_acceleration_m_s2(knee_m_s), Some(20.0 * g));
        let before = boundary
            .knee_acceleration_m_s2(knee_m_s * (1.0 - 1e-9))
            .unwrap();
        assert!((before / (20.0 * g) - 1.0).abs() < 1e-8);
    }

    #[test]
    fn near_the_critical_velocity_the_peak_grows_beyond_all_bounds() {
        let boundary = DamageBoundary::new(1.0, 1.0).unwrap();
        // sin(x)/x = 1 − x²/6: x = √(6·1e-6), A = ratio/x.
        let a = boundary.knee_acceleration_m_s2(1.0 + 1e-6).unwrap();
        assert!((a * 6e-6f64.sqrt() - 1.0).abs() < 1e-5, "{a}");
        assert_eq!(boundary.knee_acceleration_m_s2(1.0), None);
        assert_eq!(boundary.knee_acceleration_m_s2(f64::NAN), None);
        assert!(
            boundary
                .knee_acceleration_m_s2(1.0 + f64::EPSILON)
                .is_none_or(f64::is_finite)
        );
    }

    /// Both must be exceeded: either may be exceeded alone.
    #[test]
    fn both_must_be_exceeded() {
        let boundary = DamageBoundary::new(200.0, 0.5).unwrap();
        assert_eq!(boundary.demand_ratio(2000.0, 0.4), 0.8);
        assert_eq!(boundary.demand_ratio(100.0, 5.0), 0.5);
        assert_eq!(boundary.demand_ratio(400.0, 0.75), 1.5);
        assert!(
            DamageBoundary::new(0.0, 1.0).is_err()
                && DamageBoundary::new(1.0, f64::INFINITY).is_err()
        );
        assert!(DamageBoundary::of_component(-1.0, 1.0).is_err());
    }

    /// The constant is the largest value of the closed form. The curve is flat there: 5e-5 in fT
    /// changes it by 1e-8.
    #[test]
    fn half_sine_floor() {
        let largest = (8000..8200)
            .map(|i| half_sine_maximax_ratio(1e-4 * f64::from(i)))
            .fold(0.0, f64::max);
        assert!(
            (largest - HALF_SINE_LARGEST_RATIO).abs() < 2e-8,
            "{largest}"
        );
        assert!((half_sine_floor_m_s2(1.0) - 0.56546).abs() < 5e-6);
    }
}
