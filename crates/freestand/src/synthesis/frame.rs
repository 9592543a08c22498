//! The time window in which a synthetic motion may change, and the removal of its drift.

use std::f64::consts::PI;

/// Sums that are taken side by side.
const ABREAST: usize = 8;

/// The window of a motion: tapers at both ends of the shaking, and a smooth bell for the removal of
/// drift.
pub(super) struct Frame {
    pub(super) taper: Vec<f64>,
    bell: Vec<f64>,
    /// bell·t.
    bell_time: Vec<f64>,
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
        let time = |k: usize| k as f64 - centre;
        let bell_time: Vec<f64> = (0..samples).map(|k| bell[k] * time(k)).collect();
        let moments = [
            bell.iter().sum(),
            bell_time.iter().sum(),
            (0..samples).map(|k| bell_time[k] * time(k)).sum(),
        ];
        Self {
            taper: (0..samples).map(taper).collect(),
            bell,
            bell_time,
            moments,
            centre,
        }
    }

    /// Tapers both ends, and removes the drift.
    pub(super) fn settle(&self, accel: &mut [f64]) {
        for (a, taper) in accel.iter_mut().zip(&self.taper) {
            *a *= taper;
        }
        self.remove_drift(accel);
    }

    /// Subtracts bell·(c₀ + c₁t) so that Σa = 0 and Σta = 0. With zero ends these are the final
    /// velocity and displacement, both by the trapezoid rule and of the motion that is linear
    /// between samples. The bell is as long as the shaking, so its frequencies are far below the
    /// matched range.
    pub(super) fn remove_drift(&self, accel: &mut [f64]) {
        let (sum, moment) = self.moments_of(accel);
        let [bell0, bell1, bell2] = self.moments;
        let determinant = bell0 * bell2 - bell1 * bell1;
        let c0 = (sum * bell2 - moment * bell1) / determinant;
        let c1 = (moment * bell0 - sum * bell1) / determinant;
        let slope = self.bell.iter().zip(&self.bell_time);
        for (a, (bell, bell_time)) in accel.iter_mut().zip(slope) {
            *a -= bell * c0 + bell_time * c1;
        }
    }

    /// Σa and Σta, side by side: one sum would wait for the sample before it.
    fn moments_of(&self, accel: &[f64]) -> (f64, f64) {
        let (abreast, rest) = accel.as_chunks::<ABREAST>();
        let (mut sums, mut moments) = ([0.0; ABREAST], [0.0; ABREAST]);
        for (place, accel) in abreast.iter().enumerate() {
            let time = (place * ABREAST) as f64 - self.centre;
            for lane in 0..ABREAST {
                sums[lane] += accel[lane];
                moments[lane] += accel[lane] * (time + lane as f64);
            }
        }
        let begun = ABREAST * abreast.len();
        for (k, a) in rest.iter().enumerate() {
            sums[k] += a;
            moments[k] += a * ((begun + k) as f64 - self.centre);
        }
        (sums.iter().sum(), moments.iter().sum())
    }
}
