//! A landing followed in time, for virtual tests and for plots.

use super::Cushion;

/// One instant of a landing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Since the first touch \[s\].
    pub time_s: f64,
    /// d \[m\].
    pub compression_m: f64,
    /// ḋ, positive on the way in \[m/s\].
    pub speed_m_s: f64,
    /// Force of the cushion \[N\].
    pub force_n: f64,
}

/// Steps of the integration per contact without gravity: 1e-12 of the compression for smooth laws, 1e-9 for the root of
/// a Hertz law at the first touch.
const STEPS: f64 = 4000.0;
/// A mass that has not left the cushion after so many contact times stays on it.
const LONGEST: f64 = 8.0;

impl Cushion {
    /// m d̈ = m g − F(d, ḋ) from the first touch until the force is back at zero, or for 8 contact times where the weight
    /// keeps the mass down; one point for each step, the last one where the force ends.
    ///
    /// **Units**: kg, m/s, m/s²; `gravity_m_s2` = 0 gives the closed forms of [`Cushion::land`].
    ///
    /// # Accuracy
    /// Classical Runge–Kutta with 4000 steps to the contact time: 1e-8 of the peak force or better.
    pub fn landing_history(&self, mass_kg: f64, speed_m_s: f64, gravity_m_s2: f64) -> Vec<ContactPoint> {
        let contact_s = self.land(mass_kg, speed_m_s).duration_s;
        let step_s = contact_s / STEPS;
        let acceleration = |d: f64, v: f64| gravity_m_s2 - self.force_n(d, v) / mass_kg;
        let at = |time_s: f64, d: f64, v: f64| ContactPoint {
            time_s,
            compression_m: d,
            speed_m_s: v,
            force_n: self.force_n(d, v),
        };
        let mut points = vec![at(0.0, 0.0, speed_m_s)];
        if !(step_s > 0.0 && step_s.is_finite()) {
            return points;
        }
        let (mut d, mut v) = (0.0, speed_m_s);
        for step in 1..=(LONGEST * STEPS) as u32 {
            let (d0, v0) = (d, v);
            let (k1, a1) = (v0, acceleration(d0, v0));
            let (k2, a2) = (v0 + 0.5 * step_s * a1, acceleration(d0 + 0.5 * step_s * k1, v0 + 0.5 * step_s * a1));
            let (k3, a3) = (v0 + 0.5 * step_s * a2, acceleration(d0 + 0.5 * step_s * k2, v0 + 0.5 * step_s * a2));
            let (k4, a4) = (v0 + step_s * a3, acceleration(d0 + step_s * k3, v0 + step_s * a3));
            d += step_s / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
            v += step_s / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
            let point = at(f64::from(step) * step_s, d, v);
            if v < 0.0 && point.force_n == 0.0 {
                points.push(Self::last(&points, point));
                break;
            }
            points.push(point);
        }
        points
    }

    /// Where the force ends between two steps: along the line of the last two forces.
    fn last(points: &[ContactPoint], beyond: ContactPoint) -> ContactPoint {
        let [.., before, last] = points else { return beyond };
        let fall = before.force_n - last.force_n;
        let share = if fall > 0.0 { (last.force_n / fall).min(1.0) } else { 1.0 };
        let between = |a: f64, b: f64| a + share * (b - a);
        ContactPoint {
            time_s: between(last.time_s, beyond.time_s),
            compression_m: between(last.compression_m, beyond.compression_m),
            speed_m_s: between(last.speed_m_s, beyond.speed_m_s),
            force_n: 0.0,
        }
    }
}
