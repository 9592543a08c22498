//! The history of a landing in time, for virtual tests and for plots.

use super::Cushion;

/// One instant of a landing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Time since first contact \[s\].
    pub time_s: f64,
    /// Compression d \[m\].
    pub compression_m: f64,
    /// Rate of compression ḋ, positive while the compression grows \[m/s\].
    pub speed_m_s: f64,
    /// Force of the cushion \[N\].
    pub force_n: f64,
}

/// Integration steps per contact without gravity: 1e-12 of the compression for smooth laws, 1e-9
/// for the root of a Hertz law at first contact.
const STEPS: f64 = 4000.0;
/// Largest step in radians of the frequency √(F′/m) at the compression that the step reaches: a
/// cushion that bottoms is many times stiffer there than on average.
const MAX_ANGLE: f64 = 2e-3;
/// Smallest step as a share of the usual one.
const MIN_SHARE: f64 = 1e-4;
/// Largest number of steps: a limit for cushions for which no step is small enough.
const MAX_STEPS: u32 = 1_000_000;
/// A mass that has not left the cushion after this many contact times stays on it.
const LONGEST: f64 = 8.0;

impl Cushion {
    /// m d̈ = m g − F(d, ḋ) from first contact until the force is zero again, or for 8 contact
    /// times where the weight keeps the mass down. One point for each step; the last point is where
    /// the force ends.
    ///
    /// **Units**: kg, m/s, m/s²; `gravity_m_s2` = 0 gives the closed forms of [`Cushion::land`].
    ///
    /// # Accuracy
    /// Classical Runge–Kutta with 4000 steps per contact time, and smaller steps where the cushion
    /// stiffens. The largest force among the points is that of [`Cushion::land`] to 2e-6, even for
    /// a tangent law at a thousand times its initial stiffness; a kink of a table causes an error
    /// of the same size. For a cushion that bottoms more strongly than that, no history is
    /// reliable.
    pub fn landing_history(
        &self,
        mass_kg: f64,
        speed_m_s: f64,
        gravity_m_s2: f64,
    ) -> Vec<ContactPoint> {
        let contact_s = self.land(mass_kg, speed_m_s).duration_s;
        let common_s = contact_s / STEPS;
        let deepest_m = self.deepest_m(mass_kg, speed_m_s, gravity_m_s2);
        let acceleration = |d: f64, v: f64| gravity_m_s2 - self.force_n(d, v) / mass_kg;
        let at = |time_s: f64, d: f64, v: f64| ContactPoint {
            time_s,
            compression_m: d,
            speed_m_s: v,
            force_n: self.force_n(d, v),
        };
        let mut points = vec![at(0.0, 0.0, speed_m_s)];
        if !(common_s > 0.0 && common_s.is_finite()) {
            return points;
        }
        let (mut time_s, mut d, mut v) = (0.0, 0.0, speed_m_s);
        for _ in 0..MAX_STEPS {
            let (d0, v0) = (d, v);
            let ahead_m = (d0 + 2.0 * v0.abs() * common_s).min(deepest_m.max(d0));
            let omega = (self.tangent_stiffness_n_m(ahead_m) / mass_kg).sqrt();
            // The smaller of the two, also where the stiffness is infinite or NaN.
            let step_s = common_s.min((MAX_ANGLE / omega).max(MIN_SHARE * common_s));
            time_s += step_s;
            let (k1, a1) = (v0, acceleration(d0, v0));
            let (k2, a2) = (
                v0 + 0.5 * step_s * a1,
                acceleration(d0 + 0.5 * step_s * k1, v0 + 0.5 * step_s * a1),
            );
            let (k3, a3) = (
                v0 + 0.5 * step_s * a2,
                acceleration(d0 + 0.5 * step_s * k2, v0 + 0.5 * step_s * a2),
            );
            let (k4, a4) = (
                v0 + step_s * a3,
                acceleration(d0 + step_s * k3, v0 + step_s * a3),
            );
            d += step_s / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
            v += step_s / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
            let point = at(time_s, d, v);
            if v < 0.0 && point.force_n == 0.0 {
                points.push(Self::last(&points, point));
                break;
            }
            points.push(point);
            if time_s > LONGEST * contact_s {
                break;
            }
        }
        points
    }

    /// An estimate of the largest compression, including the work of the weight on the way.
    fn deepest_m(&self, mass_kg: f64, speed_m_s: f64, gravity_m_s2: f64) -> f64 {
        let mut deepest_m = self.land(mass_kg, speed_m_s).compression_m;
        if gravity_m_s2 > 0.0 {
            for _ in 0..3 {
                let speed_m_s = (speed_m_s * speed_m_s + 2.0 * gravity_m_s2 * deepest_m).sqrt();
                deepest_m = self.land(mass_kg, speed_m_s).compression_m;
            }
        }
        deepest_m
    }

    /// The point between two steps at which the force ends, on the line through the last two
    /// forces.
    fn last(points: &[ContactPoint], beyond: ContactPoint) -> ContactPoint {
        let [.., before, last] = points else {
            return beyond;
        };
        let fall = before.force_n - last.force_n;
        let share = if fall > 0.0 {
            (last.force_n / fall).min(1.0)
        } else {
            1.0
        };
        let between = |a: f64, b: f64| a + share * (b - a);
        ContactPoint {
            time_s: between(last.time_s, beyond.time_s),
            compression_m: between(last.compression_m, beyond.compression_m),
            speed_m_s: between(last.speed_m_s, beyond.speed_m_s),
            force_n: 0.0,
        }
    }
}
