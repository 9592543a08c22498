//! The time window in which a synthetic motion may change, and the removal of its drift.

use std::f64::consts::PI;

/// The window of a motion: tapers at both ends of the shaking, and a smooth bell for the removal of
/// drift.
pub(super) struct Frame {
    pub(super) taper: Vec<f64>,
    bell: Vec<f64>,
    /// Σ bell·tⁿ for n = 0, 1, 2.
    moments: [f64; 3],
    /// The middle of the shaking, in samples.
    centre: f64,
}

impl Frame {
    pub(super) fn new(
        samples: usize,
        start: usize,
        end: usize,
        taper_start: usize,
        taper_end: usize,
    ) -> Self {
        let rise =
            |k: usize, over: usize| 0.5 - 0.5 * (PI * (k as f64 / over as f64).min(1.0)).cos();
        let within = |k: usize| (start..=end).contains(&k);
        let taper = |k| {
            if within(k) {
                rise(k - start, taper_start) * rise(end - k, taper_end)
            } else {
                0.0
            }
        };
        // Without the last sample, where the sine of a rounded π would give 1e-32 instead of zero.
        let bell = |k| {
            if within(k) && k < end {
                (PI * (k - start) as f64 / (end - start) as f64)
                    .sin()
                    .powi(2)
            } else {
                0.0
            }
        };
        let centre = 0.5 * (start + end) as f64;
        let bell: Vec<f64> = (0..samples).map(bell).collect();
        let mut moments = [0.0; 3];
        for (k, bell) in bell.iter().enumerate() {
            let t = k as f64 - centre;
            moments[0] += bell;
            moments[1] += bell * t;
            moments[2] += bell * t * t;
        }
        Self {
            taper: (0..samples).map(taper).collect(),
            bell,
            moments,
            centre,
        }
    }

    /// Subtracts bell·(c₀ + c₁t) so that Σa = 0 and Σta = 0. With zero ends these are the final
    /// velocity and displacement, both by the trapezoid rule and of the motion that is linear
    /// between samples. The bell is as long as the shaking, so its frequencies are far below the
    /// matched range.
    pub(super) fn remove_drift(&self, accel: &mut [f64]) {
        let time = |k: usize| k as f64 - self.centre;
        let (mut sum, mut moment) = (0.0, 0.0);
        for (k, a) in accel.iter().enumerate() {
            sum += a;
            moment += a * time(k);
        }
        let [bell0, bell1, bell2] = self.moments;
        let determinant = bell0 * bell2 - bell1 * bell1;
        let c0 = (sum * bell2 - moment * bell1) / determinant;
        let c1 = (moment * bell0 - sum * bell1) / determinant;
        for (k, (a, bell)) in accel.iter_mut().zip(&self.bell).enumerate() {
            *a -= bell * (c0 + c1 * time(k));
        }
    }
}
