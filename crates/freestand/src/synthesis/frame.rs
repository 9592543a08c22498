//! The time window in which a synthetic motion may change, and the removal of its drift.

use std::f64::consts::PI;

/// The window of a motion: tapers at both ends of the shaking, and a smooth bell for the removal of
/// drift.
pub(super) struct Frame {
    pub(super) taper: Vec<f64>,
    bell: Vec<f64>,
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
        let (taper, bell) = (
            (0..samples).map(taper).collect(),
            (0..samples).map(bell).collect(),
        );
        Self {
            taper,
            bell,
            centre: 0.5 * (start + end) as f64,
        }
    }

    /// Subtracts bell·(c₀ + c₁t) so that Σa = 0 and Σta = 0. With zero ends these are the final
    /// velocity and displacement, both by the trapezoid rule and of the motion that is linear
    /// between samples. The bell is as long as the shaking, so its frequencies are far below the
    /// matched range.
    pub(super) fn remove_drift(&self, accel: &mut [f64]) {
        let time = |k: usize| k as f64 - self.centre;
        let (mut sum, mut moment, mut bell0, mut bell1, mut bell2) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (k, (a, bell)) in accel.iter().zip(&self.bell).enumerate() {
            let t = time(k);
            sum += a;
            moment += a * t;
            bell0 += bell;
            bell1 += bell * t;
            bell2 += bell * t * t;
        }
        let determinant = bell0 * bell2 - bell1 * bell1;
        let c0 = (sum * bell2 - moment * bell1) / determinant;
        let c1 = (moment * bell0 - sum * bell1) / determinant;
        for (k, (a, bell)) in accel.iter_mut().zip(&self.bell).enumerate() {
            *a -= bell * (c0 + c1 * time(k));
        }
    }
}
